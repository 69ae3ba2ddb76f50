//! Geometry of a model: surfaces of parts and symbols, and their poses in the frames of a motion. Used by pictures and
//! files for other programs.

mod mesh;
mod model;
mod normals;
mod shell_elements;
mod solid_elements;
mod sweep;

pub use mesh::{Mesh, turn_to};
pub(crate) use model::span;
pub use model::{Carrier, Colour, Geometry, Piece, Role, poses_at};
pub use normals::{Edge, Normals, normal};
pub use shell_elements::{Layer, ShellElements, at_rest};
pub use solid_elements::SolidElements;
pub use sweep::Sweep;
