//! All tests of the crate that need no process of their own, in one program: it is linked once.

mod document;
mod fuzz;
mod meshes;
mod parts;
mod support;
mod tables;
