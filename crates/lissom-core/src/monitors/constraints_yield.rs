//! Constraints that are violated by more than the error of the solution, and by less than the limit of failure: they are
//! redundant or contradictory, and are regularised.

use super::monitor::{Accepted, Beginning, Monitor};
use crate::errors::Warning;
use crate::errors::warn;
use crate::judge::Judge;

/// Has no state.
struct ConstraintsYield;

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let has_constraints = !beginning.problem.system.layout().multiplier_rows().is_empty();
    has_constraints.then(|| Box::new(ConstraintsYield) as Box<dyn Monitor>)
}

impl Monitor for ConstraintsYield {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        let judge = Judge::new(step.problem, &step.integrator.representative);
        if let Some(warning) = judge.regularized(step.end, step.violation) {
            warn(warnings, warning);
        }
    }
}
