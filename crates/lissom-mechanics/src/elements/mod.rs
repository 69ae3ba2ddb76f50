//! Forces: inertia, stiffness, loads.
//!
//! An element computes forces and their derivatives from positions, twists and accelerations in SI. It is independent
//! of time step, scheme and scaling.

mod bearing;
pub mod bushing;
pub mod contribution;
pub mod coordinate_dynamics;
pub(crate) mod coordinate_spring;
pub mod creep_force;
pub mod force;
mod force_between;
pub mod force_law;
pub mod friction;
pub mod gear_friction;
pub mod gyrostat;
pub mod inertia;
mod inertia_blocks;
pub mod initial_model;
pub(crate) mod joint_load;
pub mod kind;
mod kinds;
pub mod latch;
mod law_of_distance;
pub mod local_load;
pub mod mass_distribution;
pub mod moment;
mod over_measure;
pub(crate) mod point_spring;
mod polyline;
pub mod quadrature;
mod reactions;
pub mod reeving;
pub mod rolling;
pub mod rolling_contact;
pub mod rope;
pub mod shape;
pub mod stop;
pub mod tyre;

pub use contribution::Contribution;
pub use initial_model::InitialModel;
pub use kind::{Attached, ElementKind, Sheave};
pub use kinds::{LOADS, SPRINGS};

pub use crate::evaluation::capabilities::{
    Bristle, Capabilities, Deformable, ForceLaws, Load, OwnInertia, Spring, StrainSlopes, Symmetric,
};
pub use crate::evaluation::element::{Element, Energy, Tangents, Unknowns, is_same};
pub use crate::evaluation::limits::{Limit, LimitKind, Place, Validity};
pub use crate::evaluation::report::Report;
pub use crate::kinematics::local_derivatives::add_block;
