//! Whether tyres carry loads for which they have data, on roads that their contact resolves.

use super::monitor::{Accepted, Beginning, Monitor};
use crate::elements::Spring;
use crate::errors::{Warning, warn};

/// Reports the first tyre whose load is too large, and the first one on a road that is too uneven. Has no state.
struct TyreLoads;

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let mut springs = beginning.problem.system.elements_with(|own| own.spring);
    let has_tyres = springs.any(Spring::has_slip);
    has_tyres.then(|| Box::new(TyreLoads) as Box<dyn Monitor>)
}

impl Monitor for TyreLoads {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        let (system, at) = (step.problem.system, &step.end.kinematics);
        for tyre in system.elements_with(|element| element.spring).filter(|spring| spring.has_slip()) {
            let part = || system.layout().name_of_node(tyre.unknowns().nodes[1]).to_owned();
            let [[load, limit], [deviation, largest]] = tyre.tyre_limits(at);
            if load > limit {
                warn(warnings, Warning::TyreBeyondData { time: at.time, part: part(), load, limit });
            }
            if deviation > largest {
                let (part, limit) = (part(), largest);
                warn(warnings, Warning::RoadBeyondContact { time: at.time, part, deviation, limit });
            }
        }
    }
}
