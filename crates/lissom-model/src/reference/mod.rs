//! The reference of the model file, for users and for other programs: pages, schema, typed entries in Rust and Python.

pub(crate) mod forms;
pub(crate) mod manual;
pub(crate) mod model_axes;
pub(crate) mod python_entries;
pub(crate) mod schema;
pub(crate) mod typed_entries;
