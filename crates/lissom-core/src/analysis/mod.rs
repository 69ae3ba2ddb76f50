//! What the user asks for: consistent initial values, time steps, load steps.

pub mod dynamics;
mod equations;
mod factorization;
pub mod initial;
mod step_error;

pub use dynamics::{Settings, Simulation, StepReport, Totals};
pub use initial::InitialError;
pub use step_error::StepError;
