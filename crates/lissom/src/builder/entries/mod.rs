//! The entries of a model, one type per kind. The other files of this folder are generated from the program's tables.

#![allow(clippy::doc_markdown, reason = "the words are those of the tables")]

pub mod analyses;
pub mod contacts;
pub(crate) mod feedback;
pub mod hydraulics;
pub mod joints;
pub mod loads;
pub mod motions;
pub mod outputs;
pub mod parts;
pub mod sections;
pub mod springs;
pub mod words;
