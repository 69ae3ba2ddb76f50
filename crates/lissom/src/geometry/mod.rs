//! What a model looks like in space: surfaces of parts and symbols, and where they are in the frames of a motion. Pictures
//! and files for other programs are made of it. Knows no pictures.

mod mesh;
mod model;
mod sweep;

pub use mesh::{Mesh, turn_to};
pub(crate) use model::span;
pub use model::{Carrier, Colour, Geometry, Piece, Role, poses_at};
pub use sweep::Sweep;
