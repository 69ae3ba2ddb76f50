//! Flexible multibody dynamics in index-3 form: elements and joints in SI that are independent of the time step,
//! schemes for unit steps, and the module `scaling`, which combines them.
//!
//! This crate opens no file, prints nothing and reads no clock.

pub use lissom_contact as contact;
pub use lissom_flexible as flexible;
pub use lissom_mechanics::{
    catalogued, compliance, elements, evaluation, instants, joints, kinematics, law, number, ports, registry,
    relation, round_off, signals, units, wheels,
};
pub use lissom_motion as motion;
pub use lissom_solver::interrupt;
pub use lissom_system as system;
pub use lissom_system::{schemes, solver_features, tuning};

pub mod assembly;
mod bytes;
pub mod catalogue;
pub mod consistent;
pub(crate) mod control;
pub mod diagnostics;
pub mod differentiation;
mod energy_balance;
pub mod errors;
mod impacts;
pub(crate) mod integrator;
mod iterate;
pub(crate) mod judge;
pub mod linearized;
pub(crate) mod monitors;
pub mod newton;
mod node_motion;
pub mod path;
pub mod saddle_point;
pub mod scaling;
pub mod settings;
pub mod simulation;
mod spin;

pub use energy_balance::EnergyBalance;

/// The linear solvers, by name.
pub mod solvers {
    pub use lissom_solver::{KINDS, SolverKind, in_parallel, kind};
}
