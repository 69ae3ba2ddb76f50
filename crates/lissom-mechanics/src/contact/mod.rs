//! Geometry and laws of contact between wheels, planes and rails. Independent of elements, joints and systems.

pub mod creep_law;
pub mod profile;
pub mod wheel_on_plane;
pub mod wheel_on_rail;

pub use creep_law::CreepLaw;
pub use wheel_on_plane::Contact;
