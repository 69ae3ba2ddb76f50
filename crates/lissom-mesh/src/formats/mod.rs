//! Readers of files, and what they share.

pub(crate) mod abaqus;
pub(crate) mod abaqus_sets;
pub(crate) mod abaqus_types;
pub(crate) mod draft;
pub(crate) mod fields;
pub(crate) mod gmsh;
pub(crate) mod gmsh_types;
pub(crate) mod obj;
pub(crate) mod read;
pub(crate) mod set_budget;
