//! Basic types of elements, joints and signals: indices, motions and their changes, frames, numbering, and the stages of a
//! step. Independent of elements, joints and the system.

mod carried_frame;
pub mod lanes;
mod layout;
pub mod local_derivatives;
mod motion;
mod quantity;
pub mod step_stages;
mod subject;
pub mod switch;
pub mod work;

pub use carried_frame::CarriedFrame;
pub use layout::{Freedoms, LOCKED, Layout};
pub use motion::split;
pub use motion::{
    CoordinateId, CoordinateMotion, GROUND, HeldId, Kinematics, MotionChange, NodeId, NodeMotion,
};
pub use quantity::Quantity;
pub use step_stages::StepStages;
pub use subject::Subject;
pub use switch::Switch;
