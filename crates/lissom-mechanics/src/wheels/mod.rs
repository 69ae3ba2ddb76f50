//! Wheels that roll on planes and rails: their geometry and the forces of creep. Independent of elements, joints and systems.

pub mod creep_law;
pub mod profile;
pub mod wheel_on_plane;
pub mod wheel_on_rail;

pub use creep_law::CreepLaw;
pub use wheel_on_plane::Contact;
