//! What the user asks for: consistent initial values, time steps, load steps, a count of freedoms.

mod anderson;
pub mod assembly;
pub(crate) mod compliance;
pub mod conditioning;
mod corrections;
mod differentiation;
pub mod dynamics;
mod equations;
pub mod equilibrium;
mod factorization;
pub mod factorization_study;
mod held_values;
pub mod initial;
pub(crate) mod loops;
pub mod mobility;
pub mod path;
pub mod phase;
mod predictor;
mod projection;
mod sensitivity;
mod singular_positions;
pub(crate) mod snapshot_parts;
mod stability;
mod step_error;
mod whereabouts;
mod workspace;

pub use conditioning::{Condition, ConditionMethod};
pub use differentiation::Sensitivities;
pub(crate) use dynamics::warn;
pub use dynamics::{Settings, Simulation, StepReport, Totals};
pub use held_values::InputError;
pub use initial::InitialError;
pub use mobility::{Mobility, Redundant};
pub use phase::{Phase, Stopwatch, Unwatched};
pub use step_error::StepError;
pub use whereabouts::Whereabouts;
