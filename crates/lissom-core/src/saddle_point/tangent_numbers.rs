//! Values of a factored tangent as plain numbers, for snapshots.

use num_complex::Complex64;
use serde::{Deserialize, Serialize};

/// Values of a tangent as plain numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum TangentNumbers {
    /// Values of one stage, or of a real eigenvalue of several.
    Real(Vec<f64>),
    /// Values of a pair of complex conjugate eigenvalues: real and imaginary part.
    Complex(Vec<[f64; 2]>),
}

impl TangentNumbers {
    /// From complex values.
    pub(crate) fn of_complex(values: &[Complex64]) -> Self {
        Self::Complex(values.iter().map(|value| [value.re, value.im]).collect())
    }
}
