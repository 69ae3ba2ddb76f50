//! Natural modes: options, results and errors.

use crate::diagnostics::{Diagnose, Diagnostic};
use num_complex::Complex64;

use super::model::LinearError;

/// Growth is distinguished from round-off by a damping ratio below this.
const GROWING: f64 = -1e-7;

/// The request.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeOptions {
    /// How many modes, at most.
    pub count: usize,
    /// Frequency near which they are sought [Hz]; none for the lowest ones.
    pub shift: Option<f64>,
}

/// What a mode does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModeKind {
    /// Eigenvalue zero to round-off: a motion that nothing resists.
    Rigid,
    /// A pair of complex eigenvalues that do not grow.
    Oscillation,
    /// A real eigenvalue below zero: overdamped.
    Decay,
    /// A real eigenvalue above zero: an unstable equilibrium.
    Divergence,
    /// A pair of complex eigenvalues that grow.
    Flutter,
}

impl ModeKind {
    /// The word in `modes.csv`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rigid => "rigid",
            Self::Oscillation => "oscillation",
            Self::Decay => "decay",
            Self::Divergence => "divergence",
            Self::Flutter => "flutter",
        }
    }

    /// Whether it grows.
    pub fn is_unstable(self) -> bool {
        matches!(self, Self::Divergence | Self::Flutter)
    }
}

/// A natural mode η(t) = Re(shape e^{st}).
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// Eigenvalue s [1/s], the one with the imaginary part not below zero.
    pub eigenvalue: Complex64,
    /// |s|/(2π) [Hz]: with damping the frequency of the undamped oscillator of the same stiffness and mass. 0 for a rigid mode.
    pub frequency: f64,
    /// Damping ratio -Re s/|s|: 1 for a decay, -1 for a divergence. 0 for a rigid mode.
    pub damping: f64,
    /// What it does.
    pub kind: ModeKind,
    /// Body-frame displacements and rotations of the nodes and changes of the coordinates by row, normalised to unit modal
    /// mass ηᴴMη = 1 kg where the mode has mass.
    pub shape: Vec<Complex64>,
    /// Residual of the shifted and inverted problem, relative to its eigenvalue.
    pub residual: f64,
}

/// Whether modes may have been missed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Completeness {
    /// A count of negative pivots shows that none has been missed.
    Counted,
    /// The count shows that so many were missed.
    Missing(usize),
    /// The matrices of the count could not be factored, or contradict each other.
    Unknown,
    /// With damping, gyroscopic terms or an unsymmetric stiffness pivots count nothing.
    NotCounted,
}

impl Completeness {
    /// The word in `summary.json`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Counted => "counted",
            Self::Missing(_) => "missing",
            Self::Unknown => "unknown",
            Self::NotCounted => "not counted",
        }
    }
}

/// Modes by ascending square of frequency, unstable ones first.
#[derive(Clone, Debug, PartialEq)]
pub struct Modes {
    /// The modes: fewer than asked for where there are no more.
    pub modes: Vec<Mode>,
    /// Whether some may have been missed.
    pub completeness: Completeness,
}

/// Modes that do not exist.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ModeError {
    /// Nothing has mass.
    #[error("the model has no mass, and so no natural modes: give bodies or sections a mass")]
    NoMass,
    /// No mode at all is asked for.
    #[error("no mode is asked for: `count` must be at least 1")]
    NothingAsked,
    /// A factorisation stopped.
    #[error(transparent)]
    Linear(#[from] LinearError),
    /// The small eigenvalue problem of the search has no solution.
    #[error(
        "the search for modes did not converge; ask for fewer modes, or for those near another frequency by `shift`"
    )]
    NotConverged,
}

impl Diagnose for ModeError {
    fn diagnostic(&self) -> Diagnostic {
        match self {
            Self::Linear(error) => error.diagnostic(),
            _ => Diagnostic::uncatalogued(self),
        }
    }
}

impl Mode {
    /// From an eigenvalue, which is exactly zero for a rigid mode.
    pub(super) fn new(eigenvalue: Complex64, shape: Vec<Complex64>, residual: f64) -> Self {
        let size = eigenvalue.norm();
        let damping = if size > 0.0 { 0.0 - eigenvalue.re / size } else { 0.0 };
        let kind = match (eigenvalue.re, eigenvalue.im) {
            _ if size == 0.0 => ModeKind::Rigid,
            (re, 0.0) if re > 0.0 => ModeKind::Divergence,
            (_, 0.0) => ModeKind::Decay,
            _ if damping < GROWING => ModeKind::Flutter,
            _ => ModeKind::Oscillation,
        };
        Self { eigenvalue, frequency: size / std::f64::consts::TAU, damping, kind, shape, residual }
    }
}
