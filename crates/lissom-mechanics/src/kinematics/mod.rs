//! Basic types of elements, joints and signals: indices, motions and their changes, frames, numbering, and the stages of a
//! step. Independent of elements, joints and the system.

mod carried_frame;
mod ids;
pub mod lanes;
mod layout;
pub mod local_derivatives;
mod motion;
mod quantity;
mod rotor;
pub mod step_stages;
mod subject;
pub mod switch;
pub mod work;

pub use carried_frame::CarriedFrame;
pub(crate) use ids::indexed_by;
pub use ids::{CoordinateId, DiscreteValueId, MeasurementId, NodeId, SignalId};
pub use layout::{Freedoms, LOCKED, Layout, MAX_NODES, USUAL_UNKNOWNS};
pub use motion::split;
pub use motion::{CoordinateMotion, GROUND, Kinematics, MotionChange, NodeMotion, Stressed};
pub use quantity::Quantity;
pub use rotor::{AxisSpin, Rotor, Triple, across, is_along};
pub use step_stages::StepStages;
pub use subject::Subject;
pub use switch::Switch;
