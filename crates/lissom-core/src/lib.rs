//! Flexible multibody dynamics in index-3 form: elements and joints in SI that are independent of the time step,
//! schemes for unit steps, and the module `scaling`, which combines them.
//!
//! This crate opens no file, prints nothing and reads no clock.

pub use lissom_mechanics::{
    contact, elements, evaluation, instants, joints, kinematics, law, number, registry, relation, round_off,
    signals,
};
pub use lissom_system as system;

pub mod analysis;
mod bytes;
pub mod catalogue;
pub mod catalogued;
pub(crate) mod control;
pub mod diagnostics;
pub(crate) mod integrator;
pub mod interrupt;
pub mod judge;
pub mod linear;
pub(crate) mod monitors;
pub mod newton;
mod node_motion;
pub mod saddle_point;
pub mod scaling;
pub mod schemes;
pub mod solver_features;
pub mod stepping;
pub mod tuning;

/// The linear solvers, by name.
pub mod solvers {
    pub use lissom_solver::{KINDS, SolverKind, kind};
}
