//! A motion with more energy than loads and drives have supplied.

use super::monitor::{Accepted, Beginning, Monitor};
use crate::errors::{Warning, report_since};
use crate::settings::Problem;

/// Has no state: the energy balance is part of the simulation's state.
struct EnergySurplus;

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    beginning.problem.settings.scheme.dynamic.then(|| Box::new(EnergySurplus) as Box<dyn Monitor>)
}

impl Monitor for EnergySurplus {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        let [_, after] = step.energy_balance;
        let (surplus, turned_over) = (after.surplus, after.turned_over);
        let Problem { system, settings } = step.problem;
        let (now, remedy) = (step.end.kinematics.time, || {
            settings.resolution_remedy(!system.contacts().is_empty()).to_owned()
        });
        // A surplus at the start may be small compared with what follows.
        report_since!(
            warnings,
            now,
            after.is_noteworthy(),
            EnergySurplus { surplus, turned_over, remedy: remedy() }
        );
    }
}
