//! Natural modes: options, results and errors.

use num_complex::Complex64;

use super::model::LinearError;
use crate::diagnostics::diagnostics;

/// Damping ratio below which growth is distinguished from round-off.
const GROWING: f64 = -1e-7;

/// Damping ratio from which on a mode of first-order states is a decay, also where two of them are coupled a little.
pub(super) const OVERDAMPED: f64 = 0.9;

/// Options of a search for modes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeOptions {
    /// Maximum number of modes.
    pub count: usize,
    /// Frequency near which they are searched for [Hz]; none for the lowest ones.
    pub shift: Option<f64>,
}

/// Kind of motion of a mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModeKind {
    /// Eigenvalue zero to round-off: a motion without stiffness.
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
    /// Name of the kind in `modes.csv`.
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
    /// Kind of the mode.
    pub kind: ModeKind,
    /// Body-frame displacements and rotations of the nodes and changes of the coordinates by row, normalised to unit modal
    /// mass ηᴴMη = 1 kg if the mode has mass.
    pub shape: Vec<Complex64>,
    /// Residual of the shifted and inverted problem, relative to its eigenvalue.
    pub residual: f64,
}

/// Whether modes may have been missed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Completeness {
    /// A count of negative pivots shows that none has been missed.
    Counted,
    /// The count shows that this number was missed.
    Missing(usize),
    /// The matrices of the count could not be factored, or contradict each other.
    Unknown,
    /// With damping, gyroscopic terms or an unsymmetric stiffness pivots do not count modes.
    NotCounted,
}

impl Completeness {
    /// Name of the completeness in `summary.json`.
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
    /// The modes: fewer than requested if there are no more.
    pub modes: Vec<Mode>,
    /// Whether some may have been missed.
    pub completeness: Completeness,
}

diagnostics! {
    /// Why there are no modes.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    Failure ModeError {
        /// Nothing has mass.
        NoMass {} => "no-mass" {
            cause: ("the model has no mass, and therefore no natural modes"),
            remedy: "specify masses of bodies or sections",
            meaning: "A model without mass has no natural modes.",
        }
        /// No mode at all is requested.
        NothingAsked {} => "no-mode-requested" {
            cause: ("no mode is requested"),
            remedy: "set `count` to at least 1",
            meaning: "The requested number of modes is zero.",
        }
        /// The small eigenvalue problem of the search has no solution.
        NotConverged {} => "modes-not-converged" {
            cause: ("the search for modes did not converge"),
            remedy: "request fewer modes, or those near another frequency by `shift`",
            meaning: "The eigenvalue problem of the search for modes was not solved.",
        }
    }
    wraps {
        /// A factorisation stopped.
        Linear(LinearError), (error) => error.diagnostic(),
    }
}

impl From<LinearError> for ModeError {
    fn from(error: LinearError) -> Self {
        Self::Linear(error)
    }
}

impl Mode {
    /// Mode of an eigenvalue, which is exactly zero for a rigid mode.
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
