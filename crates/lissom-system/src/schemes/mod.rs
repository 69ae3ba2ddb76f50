//! Time integration for steps of unit length: no formula here contains the step size.
//!
//! A scheme is a table of coefficients: at each stage, velocity and acceleration are linear combinations of the
//! increments since the start of the step (the unknowns) and of the state at the start.

pub mod backward_euler;
pub mod collocation;
pub mod dense_polynomial;
pub mod energy_decaying;
pub mod generalized_alpha;
pub mod radau_iia;
pub mod relaxation;
mod scheme;
pub mod statics;

pub use dense_polynomial::DensePolynomial;
pub use scheme::{
    Combination, ContactSolution, Coupling, Decoupled, ErrorEstimate, MAX_STAGES, Parametrization, Scheme,
    SchemeError, SchemeKind, Stage, StageSystem, Tableau, Weights,
};

/// All schemes for dynamics, one line each; the first is the default with steps of given size.
pub static KINDS: &[SchemeKind] = &[
    generalized_alpha::KIND,
    generalized_alpha::HHT_KIND,
    radau_iia::KIND,
    radau_iia::FIFTH_ORDER_KIND,
    radau_iia::NINTH_ORDER_KIND,
    radau_iia::THIRTEENTH_ORDER_KIND,
    energy_decaying::KIND,
    backward_euler::KIND,
];

/// The scheme kind of that name.
pub fn kind(name: &str) -> Option<&'static SchemeKind> {
    KINDS.iter().find(|kind| kind.name == name)
}
