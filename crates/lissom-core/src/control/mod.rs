//! Step length, determined only here. A control proposes the size of an attempt, reviews its result, and proposes a shorter one
//! if it is not accepted.
//!
//! Planned steps have one size, and are bisected if they have no solution. Adaptive steps are as long as their estimated error
//! allows, load steps as long as Newton's method contracts well and the work of the loads is stored as energy.

mod adaptive;
mod interface;
mod load;
mod planned;

pub(crate) use interface::{Control, Review};

use crate::settings::Settings;
use crate::solver_features::SolverFeature;

/// The control required by the settings.
pub(crate) fn of(settings: &Settings) -> Box<dyn Control> {
    match settings.control {
        Some(control) if settings.scheme.dynamic => {
            Box::new(adaptive::Adaptive::new(control, settings.step_size))
        }
        Some(control) => Box::new(load::LoadSteps::new(control, settings.step_size)),
        None => {
            let may_bisect =
                settings.limits.disabled.allows(SolverFeature::StepBisection) && !settings.solver.is_strict;
            Box::new(planned::Planned::new(settings.step_size, may_bisect))
        }
    }
}
