//! Exchange with other programs: results in their formats, robot descriptions, and models as units of co-simulation.

pub mod export;
pub mod fmu;
pub mod import;
