//! Estimate of the condition number of a factored matrix in the 1-norm, from a few solves with any solver.
//!
//! Hager 1984, with the refinements of Higham 1988 (ACM Trans. Math. Softw. 14, 381): a lower bound, nearly always
//! within a factor of three. For complex numbers the sign is their direction x/|x| [Higham and Tisseur 2000].

use crate::pattern::Pattern;
use crate::scalar::Scalar;
use crate::solver::LinearSolver;

/// More rounds hardly ever change the estimate (Higham 1988, section 3).
const ROUNDS: usize = 5;
/// Sweeps that balance rows and columns: the first one finds the order of magnitude.
const SWEEPS: usize = 10;

/// Estimates `‖A‖₁ ‖A⁻¹‖₁` for `A = D⁻¹ Â D`, where Â has these values and was factored last by the solver. D has the units of the
/// unknowns on its diagonal: 1, except for the `free` ones, whose units are arbitrary. Theirs make row and column equally large, which
/// is the best choice except for a factor, whatever the units of Â.
///
/// # Panics
/// If the number of values is not that of the entries in the pattern.
pub fn condition_estimate<S: Scalar>(
    solver: &mut dyn LinearSolver<S>,
    pattern: &Pattern,
    values: &[S],
    free: &[usize],
) -> f64 {
    assert_eq!(values.len(), pattern.entries(), "one value for each entry of the pattern");
    let units = &balanced_units(pattern, values, free)[..];
    let (starts, rows) = (pattern.column_starts(), pattern.row_indices());
    let norm = (0..pattern.size())
        .map(|column| {
            let entries = starts[column]..starts[column + 1];
            entries.map(|k| modulus(values[k]) * units[column] / units[rows[k]]).sum()
        })
        .fold(0.0, f64::max);
    norm * inverse_norm(&mut InUnits { solver, units })
}

/// Units in which the rows and columns of the `free` unknowns have one norm without their diagonal [Osborne 1960]; 1 for all others.
fn balanced_units<S: Scalar>(pattern: &Pattern, values: &[S], free: &[usize]) -> Vec<f64> {
    let size = pattern.size();
    let mut units = vec![1.0; size];
    if free.is_empty() {
        return units;
    }
    let mut is_free = vec![false; size];
    for &unknown in free {
        is_free[unknown] = true;
    }
    let starts = pattern.column_starts();
    let positions =
        (0..size).flat_map(|column| (starts[column]..starts[column + 1]).map(move |k| (column, k)));
    let rows = pattern.row_indices();
    let counts = positions.filter(|&(column, k)| rows[k] != column && (is_free[rows[k]] || is_free[column]));
    let entries: Vec<(usize, usize, f64)> =
        counts.map(|(column, k)| (rows[k], column, modulus(values[k]))).collect();
    let (mut of_columns, mut of_rows) = (vec![0.0; size], vec![0.0; size]);
    for _ in 0..SWEEPS {
        of_columns.fill(0.0);
        of_rows.fill(0.0);
        for &(row, column, value) in &entries {
            let value = value * units[column] / units[row];
            of_columns[column] += value;
            of_rows[row] += value;
        }
        for &unknown in free {
            let factor = (of_rows[unknown] / of_columns[unknown]).sqrt();
            // An unknown that no other equation contains has any unit.
            if factor.is_normal() {
                units[unknown] *= factor;
            }
        }
    }
    units
}

/// A solver for D⁻¹ Â D.
struct InUnits<'a, S> {
    solver: &'a mut dyn LinearSolver<S>,
    units: &'a [f64],
}

impl<S: Scalar> InUnits<'_, S> {
    fn solve(&mut self, vector: &mut [S]) {
        vector.iter_mut().zip(self.units).for_each(|(value, &unit)| *value *= S::from_real(unit));
        self.solver.solve(vector);
        vector.iter_mut().zip(self.units).for_each(|(value, &unit)| *value *= S::from_real(unit.recip()));
    }

    fn solve_transposed(&mut self, vector: &mut [S]) {
        vector.iter_mut().zip(self.units).for_each(|(value, &unit)| *value *= S::from_real(unit.recip()));
        self.solver.solve_transposed(vector);
        vector.iter_mut().zip(self.units).for_each(|(value, &unit)| *value *= S::from_real(unit));
    }
}

fn inverse_norm<S: Scalar>(solver: &mut InUnits<'_, S>) -> f64 {
    let size = solver.units.len();
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
fn alternating_probe<S: Scalar>(solver: &mut InUnits<'_, S>, vector: &mut [S]) -> f64 {
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
