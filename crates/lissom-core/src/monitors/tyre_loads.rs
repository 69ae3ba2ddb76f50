//! Whether tyres carry loads for which they have data.

use super::monitor::{Accepted, Beginning, Monitor};
use crate::errors::{Warning, warn};

/// Reports the first tyre whose load is too large. Has no state.
struct TyreLoads;

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let mut springs = beginning.problem.system.elements_with(|own| own.spring);
    let has_data = springs.any(|spring| spring.largest_load().is_some());
    has_data.then(|| Box::new(TyreLoads) as Box<dyn Monitor>)
}

impl Monitor for TyreLoads {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        let (system, at) = (step.problem.system, &step.end.kinematics);
        let beyond = system.elements_with(|own| own.spring).find_map(|spring| {
            let limit = spring.largest_load()?;
            let load = spring.slip(at)[4];
            let part = || system.layout().name_of_node(spring.unknowns().nodes[1]).to_owned();
            (load > limit).then(|| Warning::TyreBeyondData { time: at.time, part: part(), load, limit })
        });
        if let Some(warning) = beyond {
            warn(warnings, warning);
        }
    }
}
