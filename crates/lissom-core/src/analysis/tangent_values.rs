//! Values of a tangent on its pattern.

use num_complex::Complex64;

use crate::schemes::Coupling;

/// Values of a tangent on its pattern.
#[derive(Clone, Debug, PartialEq)]
pub enum TangentValues {
    /// Of a scheme of one stage.
    Real(Vec<f64>),
    /// Of the complex form of a scheme of two stages.
    Complex(Vec<Complex64>),
}

impl TangentValues {
    /// Room for the tangent of a scheme.
    pub(crate) fn zeros(coupling: &Coupling, entries: usize) -> Self {
        match coupling {
            Coupling::Single(_) => Self::Real(vec![0.0; entries]),
            Coupling::Pair { .. } => Self::Complex(vec![Complex64::default(); entries]),
        }
    }
}
