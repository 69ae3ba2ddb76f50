//! Results of a run in files.

pub(crate) mod checkpoint;
pub(crate) mod folder;
pub(crate) mod page;
pub(crate) mod recorded_modes;
pub mod summary;
