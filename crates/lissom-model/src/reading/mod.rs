//! Readers of values: numbers, vectors, expressions, tables and functions, in the units and axes of the model file.

mod coefficients;
mod force_values;
pub(crate) mod function_values;
mod height_fields;
pub(crate) mod local_tables;
pub(crate) mod mesh_nodes;
pub(crate) mod node_reference;
pub(crate) mod reader;
pub(crate) mod table_values;
mod values;
