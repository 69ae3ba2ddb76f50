//! Flexible multibody dynamics in index-3 form: elements and joints in SI that know no time step,
//! schemes for unit steps, and one place, `scaling`, where they meet.
//!
//! This crate opens no file, prints nothing and reads no clock.

pub mod analysis;
pub mod contact;
mod dual;
pub mod elements;
pub(crate) mod equilibration;
pub mod evaluation;
pub mod instants;
pub mod interrupt;
pub mod joints;
pub mod judge;
pub mod kinematics;
pub mod linear;
pub mod mechanisms;
pub mod newton;
mod node_motion;
pub mod numbers;
pub mod registry;
pub mod relation;
pub mod scaling;
pub mod schemes;
pub mod signals;
pub mod stepping;
pub mod system;

/// The linear solvers, by name.
pub mod solvers {
    pub use lissom_solver::{KINDS, SolverKind, kind};
}
