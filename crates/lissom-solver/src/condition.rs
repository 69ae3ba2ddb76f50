//! Estimate of the condition number of a factored matrix in the 1-norm, from a few solves. Knows no solver.
//!
//! Hager 1984, with the refinements of Higham 1988 (ACM Trans. Math. Softw. 14, 381): a lower bound, nearly
//! always within a factor of three.

use crate::pattern::Pattern;
use crate::solver::LinearSolver;

/// More rounds hardly ever change the estimate (Higham 1988, section 3).
const ROUNDS: usize = 5;

/// Estimates `‖A‖₁ ‖A⁻¹‖₁` for the matrix with these values, which the solver has factored last.
///
/// # Panics
/// If the number of values is not that of the entries in the pattern.
pub fn condition_estimate(solver: &mut dyn LinearSolver<f64>, pattern: &Pattern, values: &[f64]) -> f64 {
    assert_eq!(values.len(), pattern.entries(), "one value for each entry of the pattern");
    let norm = pattern
        .column_starts()
        .windows(2)
        .map(|range| values[range[0]..range[1]].iter().map(|value| value.abs()).sum())
        .fold(0.0, f64::max);
    norm * inverse_norm(solver, pattern.size())
}

fn inverse_norm(solver: &mut dyn LinearSolver<f64>, size: usize) -> f64 {
    if size == 0 {
        return 0.0;
    }
    let mut vector = vec![1.0 / size as f64; size];
    solver.solve(&mut vector);
    let mut estimate = one_norm(&vector);
    let mut signs = vec![0.0; size];
    let mut unit = usize::MAX;
    for _ in 0..ROUNDS {
        let unchanged = update_signs(&vector, &mut signs);
        if unchanged {
            break;
        }
        vector.copy_from_slice(&signs);
        solver.solve_transposed(&mut vector);
        let steepest = (0..size).fold(
            0,
            |best, index| {
                if vector[index].abs() > vector[best].abs() { index } else { best }
            },
        );
        if steepest == unit {
            break;
        }
        unit = steepest;
        vector.fill(0.0);
        vector[unit] = 1.0;
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
fn alternating_probe(solver: &mut dyn LinearSolver<f64>, vector: &mut [f64]) -> f64 {
    let size = vector.len();
    for (index, value) in vector.iter_mut().enumerate() {
        let size_of_it = 1.0 + index as f64 / (size.max(2) - 1) as f64;
        *value = if index % 2 == 0 { size_of_it } else { -size_of_it };
    }
    solver.solve(vector);
    2.0 * one_norm(vector) / (3.0 * size as f64)
}

fn one_norm(vector: &[f64]) -> f64 {
    vector.iter().map(|value| value.abs()).sum()
}

/// Writes the signs of the numbers and tells whether they were so before.
fn update_signs(vector: &[f64], signs: &mut [f64]) -> bool {
    let mut unchanged = true;
    for (sign, value) in signs.iter_mut().zip(vector) {
        let new = if *value < 0.0 { -1.0 } else { 1.0 };
        unchanged &= new == *sign;
        *sign = new;
    }
    unchanged
}
