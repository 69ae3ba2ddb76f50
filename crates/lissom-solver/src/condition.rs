//! Estimate of the condition number of a factored matrix in the 1-norm, from a few solves with any solver.
//!
//! Hager 1984, with the refinements of Higham 1988 (ACM Trans. Math. Softw. 14, 381): a lower bound, nearly always
//! within a factor of three. For complex numbers the sign is their direction x/|x| [Higham and Tisseur 2000].

use crate::pattern::Pattern;
use crate::scalar::Scalar;
use crate::solver::LinearSolver;

/// More rounds hardly ever change the estimate (Higham 1988, section 3).
const ROUNDS: usize = 5;

/// Estimates `‖A‖₁ ‖A⁻¹‖₁` for the matrix with these values, which the solver factored last.
///
/// # Panics
/// If the number of values is not that of the entries in the pattern.
pub fn condition_estimate<S: Scalar>(
    solver: &mut dyn LinearSolver<S>,
    pattern: &Pattern,
    values: &[S],
) -> f64 {
    assert_eq!(values.len(), pattern.entries(), "one value for each entry of the pattern");
    let norm = pattern
        .column_starts()
        .windows(2)
        .map(|range| one_norm(&values[range[0]..range[1]]))
        .fold(0.0, f64::max);
    norm * inverse_norm(solver, pattern.size())
}

fn inverse_norm<S: Scalar>(solver: &mut dyn LinearSolver<S>, size: usize) -> f64 {
    if size == 0 {
        return 0.0;
    }
    let mut vector = vec![S::from_real(1.0 / size as f64); size];
    solver.solve(&mut vector);
    let mut estimate = one_norm(&vector);
    let mut signs = vec![S::zero(); size];
    let mut unit = usize::MAX;
    for _ in 0..ROUNDS {
        let unchanged = update_signs(&vector, &mut signs);
        if unchanged {
            break;
        }
        // Solved with the adjoint: conjugated before and after the transposed solution.
        vector.iter_mut().zip(&signs).for_each(|(value, &sign)| *value = conjugate(sign));
        solver.solve_transposed(&mut vector);
        let steepest = (0..size)
            .fold(0, |best, index| if modulus(vector[index]) > modulus(vector[best]) { index } else { best });
        if steepest == unit {
            break;
        }
        unit = steepest;
        vector.fill(S::zero());
        vector[unit] = S::one();
        solver.solve(&mut vector);
        let next = one_norm(&vector);
        if next <= estimate {
            break;
        }
        estimate = next;
    }
    estimate.max(alternating_probe(solver, &mut vector))
}

/// Higham's safeguard against cancellation: growing numbers with alternating signs.
fn alternating_probe<S: Scalar>(solver: &mut dyn LinearSolver<S>, vector: &mut [S]) -> f64 {
    let size = vector.len();
    for (index, value) in vector.iter_mut().enumerate() {
        let size_of_it = 1.0 + index as f64 / (size.max(2) - 1) as f64;
        *value = S::from_real(if index % 2 == 0 { size_of_it } else { -size_of_it });
    }
    solver.solve(vector);
    2.0 * one_norm(vector) / (3.0 * size as f64)
}

fn modulus<S: Scalar>(value: S) -> f64 {
    let [real, imaginary] = value.parts();
    real.hypot(imaginary)
}

fn conjugate<S: Scalar>(value: S) -> S {
    let [real, imaginary] = value.parts();
    S::from_parts(real, -imaginary)
}

fn one_norm<S: Scalar>(vector: &[S]) -> f64 {
    vector.iter().map(|&value| modulus(value)).sum()
}

/// Writes the signs of the numbers and returns whether they are unchanged.
fn update_signs<S: Scalar>(vector: &[S], signs: &mut [S]) -> bool {
    let mut unchanged = true;
    for (sign, &value) in signs.iter_mut().zip(vector) {
        let size = modulus(value);
        let [real, imaginary] = value.parts();
        let new = if size > 0.0 { S::from_parts(real / size, imaginary / size) } else { S::one() };
        unchanged &= new == *sign;
        *sign = new;
    }
    unchanged
}
