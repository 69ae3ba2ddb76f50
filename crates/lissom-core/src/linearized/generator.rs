//! The generator G of the transformation of a rotor's displacements to axes at rest: see `multiblade`.

use std::collections::{BTreeMap, BTreeSet};

use lissom_solver::Pattern;
use nalgebra::DMatrix;
use num_complex::Complex64;

use super::mode::Mode;

/// Terms of the series of exp(-ψ G).
const TERMS: u32 = 40;

/// The generator of the transformation to axes at rest, by column: rows with values.
#[derive(Clone, Debug)]
pub(super) struct Generator {
    pub(super) columns: Vec<Vec<(usize, f64)>>,
    /// Rate of rotation [rad/s].
    pub(super) rate: f64,
}

impl Generator {
    pub(super) fn apply(&self, vector: &[Complex64]) -> Vec<Complex64> {
        let mut product = vec![Complex64::default(); vector.len()];
        for (column, value) in self.columns.iter().zip(vector) {
            for &(row, entry) in column {
                product[row] += entry * value;
            }
        }
        product
    }

    /// exp(-ψ G) z.
    pub(super) fn turned(&self, angle: f64, vector: &[Complex64]) -> Vec<Complex64> {
        let mut sum = vector.to_vec();
        let mut term = vector.to_vec();
        for k in 1..=TERMS {
            term = self.apply(&term);
            for (sum, term) in sum.iter_mut().zip(&mut term) {
                *term *= -angle / f64::from(k);
                *sum += *term;
            }
        }
        sum
    }

    /// Displacements, velocities and accelerations in the axes of the nodes after a rotation of the model by `angle`, for a
    /// mode in axes at rest.
    pub(super) fn in_nodes(&self, mode: &Mode, angle: f64) -> [Vec<Complex64>; 3] {
        let forward = |vector: &[Complex64]| {
            let turned = self.apply(vector);
            vector
                .iter()
                .zip(turned)
                .map(|(value, turned)| mode.eigenvalue * value - self.rate * turned)
                .collect()
        };
        let rates: Vec<Complex64> = forward(&mode.shape);
        let accelerations: Vec<Complex64> = forward(&rates);
        [mode.shape.clone(), rates, accelerations].map(|vector| self.turned(angle, &vector))
    }

    /// Adds `factor` times A G to `sum`, for a matrix A on `pattern`.
    pub(super) fn multiply(
        &self,
        (pattern, values): (&Pattern, &[f64]),
        factor: f64,
        sum: &mut BTreeMap<(usize, usize), f64>,
    ) {
        for (column, own) in self.columns.iter().enumerate() {
            for &(middle, entry) in own {
                for at in pattern.column_starts()[middle]..pattern.column_starts()[middle + 1] {
                    let value = factor * values[at] * entry;
                    if value != 0.0 {
                        *sum.entry((column, pattern.row_indices()[at])).or_default() += value;
                    }
                }
            }
        }
    }

    /// For each column the rows that exp(ψ G) connects with it, in ascending order.
    pub(super) fn closed_sets(&self) -> Vec<Vec<usize>> {
        let of = |first: usize| {
            let mut rows = BTreeSet::from([first]);
            let mut open = vec![first];
            while let Some(column) = open.pop() {
                open.extend(self.columns[column].iter().map(|&(row, _)| row).filter(|&row| rows.insert(row)));
            }
            rows.into_iter().collect()
        };
        (0..self.columns.len()).map(of).collect()
    }

    /// exp(ψ G) by column, for the rows `closed_sets` of each.
    pub(super) fn exponential(&self, angle: f64, closed_sets: &[Vec<usize>]) -> Vec<Vec<(usize, f64)>> {
        let of = |(column, rows): (usize, &Vec<usize>)| {
            let position = |row: usize| rows.binary_search(&row);
            let generator = DMatrix::from_fn(rows.len(), rows.len(), |i, j| {
                let entries = self.columns[rows[j]].iter().filter(|(row, _)| *row == rows[i]);
                angle * entries.map(|(_, value)| value).sum::<f64>()
            });
            let exponential = generator.exp();
            let own = position(column).unwrap_or(0);
            rows.iter().zip(exponential.column(own).iter()).map(|(&row, &value)| (row, value)).collect()
        };
        closed_sets.iter().enumerate().map(of).collect()
    }

    pub(super) fn squared(&self) -> Self {
        let columns = self.columns.iter().map(|column| {
            let mut sum: BTreeMap<usize, f64> = BTreeMap::new();
            for &(middle, value) in column {
                for &(row, entry) in &self.columns[middle] {
                    *sum.entry(row).or_default() += entry * value;
                }
            }
            sum.into_iter().collect()
        });
        Self { columns: columns.collect(), rate: self.rate }
    }
}
