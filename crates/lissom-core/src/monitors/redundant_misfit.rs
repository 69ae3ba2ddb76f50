//! Redundant constraints whose geometry does not fit the others: they are violated by more than the error of the solution, and by less
//! than the limit of failure.

use super::monitor::{Accepted, Beginning, Monitor};
use crate::errors::Warning;
use crate::errors::warn;
use crate::integrator::Integrator;
use crate::judge::Judge;

/// Has no state.
struct RedundantMisfit;

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let has_constraints = !beginning.problem.system.layout().multiplier_rows().is_empty();
    has_constraints.then(|| Box::new(RedundantMisfit) as Box<dyn Monitor>)
}

impl Monitor for RedundantMisfit {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        let Integrator { representative, work, .. } = &*step.integrator;
        let judge = Judge::new(step.problem, representative, (&work.redundancy, &work.unit.spins));
        if let Some(warning) = judge.misfit(step.end, step.violation) {
            warn(warnings, warning);
        }
    }
}
