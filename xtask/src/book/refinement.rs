//! Solutions to more digits than those of a solver: iterative refinement with residuals and solution in extended
//! precision, for measuring the error of a solution of any solver.

use lissom_solver::{LinearSolver, Pattern, Scalar};

use super::extended::Extended;

/// Maximum number of rounds; each adds as many digits as the solver has.
const ROUNDS: usize = 40;
/// Corrections below this fraction of the solution are irrelevant for any comparison.
const ENOUGH: f64 = 1e-20;

/// A solution by the solver, and its error.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Refined<S> {
    /// Solution of the solver.
    pub(super) solved: Vec<S>,
    /// Error of each unknown, `solved - exact`.
    pub(super) errors: Vec<S>,
    /// Whether refinement converged: otherwise the errors are lower bounds at best.
    pub(super) converged: bool,
}

/// Solves `A x = b` for the matrix with these values, which the solver factored last, and computes the error of the
/// solution [Wilkinson 1963; Higham 2002, chapter 12].
///
/// # Panics
/// If a slice has the wrong length.
pub(super) fn refined_solution<S: Scalar>(
    solver: &mut dyn LinearSolver<S>,
    pattern: &Pattern,
    values: &[S],
    right_hand_side: &[S],
) -> Refined<S> {
    assert!(values.len() == pattern.entries() && right_hand_side.len() == pattern.size());
    let mut solved = right_hand_side.to_vec();
    solver.solve(&mut solved);
    let mut exact: Vec<[Extended; 2]> =
        solved.iter().map(|value| value.parts().map(Extended::from)).collect();
    let mut correction = vec![S::zero(); solved.len()];
    let mut converged = solved.is_empty();
    let mut last = f64::INFINITY;
    for _ in 0..ROUNDS {
        residual(pattern, values, &exact, right_hand_side, &mut correction);
        solver.solve(&mut correction);
        // Each unknown individually, so that large ones do not hide the errors of small ones.
        let size = exact
            .iter()
            .zip(&correction)
            .map(|(value, change)| change.magnitude() / magnitude(value).max(f64::MIN_POSITIVE))
            .fold(0.0, f64::max);
        if !size.is_finite() || size > 0.5 * last {
            break;
        }
        for (value, change) in exact.iter_mut().zip(&correction) {
            for (part, change) in value.iter_mut().zip(change.parts()) {
                *part = *part + Extended::from(change);
            }
        }
        last = size;
        if size <= ENOUGH {
            break;
        }
    }
    converged |= last <= 1e-12;
    let error = |(value, exact): (&S, &[Extended; 2])| {
        let [real, imaginary] = value.parts();
        let rest = |part: f64, exact: Extended| (Extended::from(part) - exact).to_f64();
        S::from_parts(rest(real, exact[0]), rest(imaginary, exact[1]))
    };
    let errors = solved.iter().zip(&exact).map(error).collect();
    Refined { solved, errors, converged }
}

fn magnitude(value: &[Extended; 2]) -> f64 {
    value[0].to_f64().abs() + value[1].to_f64().abs()
}

/// `b - A x`, rounded once.
fn residual<S: Scalar>(
    pattern: &Pattern,
    values: &[S],
    solution: &[[Extended; 2]],
    right_hand_side: &[S],
    out: &mut [S],
) {
    let mut sums: Vec<[Extended; 2]> =
        right_hand_side.iter().map(|value| value.parts().map(Extended::from)).collect();
    for (column, [x, y]) in solution.iter().enumerate() {
        let start = pattern.column_starts()[column];
        for (offset, &row) in pattern.column(column).iter().enumerate() {
            let [a, b] = values[start + offset].parts().map(Extended::from);
            let sum = &mut sums[row];
            sum[0] = sum[0] - a * *x;
            if S::COMPLEX {
                sum[0] = sum[0] + b * *y;
                sum[1] = sum[1] - a * *y - b * *x;
            }
        }
    }
    for (value, [real, imaginary]) in out.iter_mut().zip(sums) {
        *value = S::from_parts(real.to_f64(), imaginary.to_f64());
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use num_complex::Complex64;

    use lissom_solver::{Structure, kind};

    use super::*;

    /// Hilbert matrices times 360360: exact integers up to size 8 with a large condition number (1e10).
    fn matrix(size: usize) -> (Structure, Vec<f64>) {
        let pattern = Pattern::from_entries(size, (0..size).flat_map(|i| (0..size).map(move |j| (i, j))));
        let values = (0..size * size).map(|k| 360_360.0 / (1 + k / size + k % size) as f64).collect();
        (Structure::ungrouped(Arc::new(pattern)), values)
    }

    #[test]
    fn errors_are_found() {
        let (structure, values) = matrix(7);
        let pattern = &structure.pattern;
        let known = [1.0, -2.0, 3.0, -4.0, 5.0, -6.0, 7.0];
        let mut b = [0.0; 7];
        pattern.multiply(&values, &known, &mut b);
        let mut solver = (kind("pivoting").unwrap().real)(&structure);
        solver.factor(&values).unwrap();
        let refined = refined_solution(&mut *solver, pattern, &values, &b);
        assert!(refined.converged);
        let worst = refined.errors.iter().fold(0.0_f64, |most, error| most.max(error.abs()));
        assert!(worst > 1e-13 && worst < 1e-4, "{worst:e}");
        for ((solved, error), known) in refined.solved.iter().zip(&refined.errors).zip(known) {
            assert!((solved - error - known).abs() < 1e-13, "the right-hand side is exact");
        }
    }

    #[test]
    fn complex_errors_are_found() {
        let (structure, values) = matrix(6);
        let pattern = &structure.pattern;
        let values: Vec<Complex64> =
            values.iter().map(|&value| Complex64::new(value, -2.0 * value)).collect();
        let known = [1, 2, 3, 4, 5, 6].map(|k| Complex64::new(f64::from(k), f64::from(-k * k)));
        let mut b = [Complex64::default(); 6];
        pattern.multiply(&values, &known, &mut b);
        let mut solver = (kind("pivoting").unwrap().complex)(&structure);
        solver.factor(&values).unwrap();
        let refined = refined_solution(&mut *solver, pattern, &values, &b);
        assert!(refined.converged);
        for ((solved, error), known) in refined.solved.iter().zip(&refined.errors).zip(known) {
            assert!((solved - error - known).norm() < 1e-12 * known.norm());
        }
    }

    #[test]
    fn a_solver_of_another_matrix_is_reported() {
        let (structure, values) = matrix(4);
        let mut solver = (kind("pivoting").unwrap().real)(&structure);
        solver.factor(&values).unwrap();
        let other: Vec<f64> = values.iter().map(|value| -value).collect();
        let refined = refined_solution(&mut *solver, &structure.pattern, &other, &[1.0, 2.0, 3.0, 4.0]);
        assert!(!refined.converged);
    }
}
