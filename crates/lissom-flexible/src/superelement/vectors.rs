//! Vectors over the unknowns of a superelement: six components per interface, then the modal coordinates.

use lissom_motion::Vector3;
use nalgebra::DMatrix;

/// Three components of a vector.
pub(super) fn three(values: &[f64], first: usize) -> Vector3 {
    Vector3::new(values[first], values[first + 1], values[first + 2])
}

/// Adds to three components of a vector.
pub(super) fn add(values: &mut [f64], first: usize, vector: &Vector3) {
    for k in 0..3 {
        values[first + k] += vector[k];
    }
}

/// Replaces three components of a vector.
pub(super) fn set(values: &mut [f64], first: usize, vector: &Vector3) {
    values[first..first + 3].copy_from_slice(vector.as_slice());
}

/// y += A x.
pub(super) fn product(matrix: &DMatrix<f64>, x: &[f64], y: &mut [f64]) {
    for (column, &value) in matrix.column_iter().zip(x).filter(|(_, value)| **value != 0.0) {
        for (sum, entry) in y.iter_mut().zip(column.iter()) {
            *sum += entry * value;
        }
    }
}
