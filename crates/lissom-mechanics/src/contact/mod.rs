//! Geometry and laws of contact between solids, and between wheels, planes and rails. Independent of elements, joints and systems.

pub mod compliance;
pub mod creep_law;
pub mod curves;
pub(crate) mod force_over_gap;
pub mod gap;
pub mod hollow;
pub mod pairs;
pub mod profile;
pub mod set;
pub mod solids;
pub mod surfaces;
pub mod wheel_on_plane;
pub mod wheel_on_rail;

pub use creep_law::CreepLaw;
pub use wheel_on_plane::Contact;
