//! Bytes of archives, arrays, tables and stored values.

pub(crate) mod archive;
pub(crate) mod npy;
pub(crate) mod parquet;
pub mod sealed;
pub(crate) mod tags;
pub(crate) mod unarchive;
