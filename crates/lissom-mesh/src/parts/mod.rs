//! Meshes of shells and solids in metres, from files, patches and blocks, with their sets, faces and shares.

pub(crate) mod block;
pub(crate) mod connection;
pub(crate) mod join;
pub(crate) mod meshed_part;
pub(crate) mod part;
pub(crate) mod patch;
pub(crate) mod raise;
pub(crate) mod region;
pub(crate) mod sizes;
