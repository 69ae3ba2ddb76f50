//! Contact of parts in SI: the forms that touch, the points at which they do, and what acts there. Independent of system, scheme and
//! time step.
//!
//! - [`geometry`]: gaps with their derivatives, of surfaces, curves and points.
//! - [`forms`]: forms of parts, and the pairs of them that can touch.
//! - [`point`]: a point where two forms may touch, and the motion there.
//! - [`reading`]: what contacts report, however they are solved.
//! - [`elastic`], [`nearest`], [`of_beams`], [`of_shells`]: elements.
//! - [`rigid`]: a constraint, with [`rigid_friction`].
//! - [`set`]: what schemes need that solve for all touches of a step at once.
//!
//! This crate opens no file, prints nothing and reads no clock.

pub mod elastic;
pub(crate) mod force_over_gap;
pub mod forms;
pub mod geometry;
pub mod law;
mod least_distance;
pub mod nearest;
pub mod of_beams;
pub mod of_shells;
pub mod point;
pub mod reading;
pub mod rigid;
pub mod rigid_friction;
pub mod set;
