//! Values of a tangent on its pattern.

use num_complex::Complex64;

use crate::schemes::StageSystem;

/// Values of a tangent on its pattern.
#[derive(Clone, Debug, PartialEq)]
pub enum TangentValues {
    /// Values of one stage, or of a real eigenvalue of several.
    Real(Vec<f64>),
    /// Values of a pair of complex conjugate eigenvalues.
    Complex(Vec<Complex64>),
}

impl TangentValues {
    /// Zeros for the tangent of a decoupled system of the stages.
    pub(crate) fn zeros(system: &StageSystem, entries: usize) -> Self {
        match system {
            StageSystem::Real(_) => Self::Real(vec![0.0; entries]),
            StageSystem::Complex(_) => Self::Complex(vec![Complex64::default(); entries]),
        }
    }
}
