//! Solids of bodies: their volume and inertia, their surfaces, and the parts with which every two of them touch. A further form is
//! a variant in `form`, and rows of the table in `meeting`.

mod form;
mod meeting;
mod parts;
#[cfg(test)]
pub(crate) mod samples;
mod solid;

pub use form::{Form, FormKind, PlacedSolid, Triangles, spacing_of_rounds};
pub use meeting::{Meeting, meetings, parts_between};
pub use solid::Solid;
