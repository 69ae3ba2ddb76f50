//! The words of a model file: its tables, keys and the forms of values, and what is meant by words of other programs.

pub(crate) mod keys;
pub(crate) mod part_tables;
pub(crate) mod solid_kinds;
pub(crate) mod suggest;
pub(crate) mod synonyms;
pub(crate) mod top_level;
pub(crate) mod value_types;
