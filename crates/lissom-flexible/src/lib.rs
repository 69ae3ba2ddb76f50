//! Flexible elements in SI: beams, shells, solids and parts reduced to their modes. Independent of system and scheme.
//!
//! This crate opens no file, prints nothing and reads no clock.

pub mod beam;
pub mod pressure;
pub mod shell;
pub mod solid;
pub mod superelement;
