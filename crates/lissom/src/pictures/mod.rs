//! Pictures of mechanisms: their geometry, pictures of single instants, and the page with the moving mechanism.

pub mod geometry;
pub mod picture;
pub mod view;
