//! Pressures of fluids that cannot be pulled.

use super::monitor::{Accepted, Beginning, Monitor};
use crate::errors::{Warning, warn};

/// Reports the first pressure below its limit. Has no state.
struct Cavitation;

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let has_limits = !beginning.problem.system.limited_pressures().is_empty();
    has_limits.then(|| Box::new(Cavitation) as Box<dyn Monitor>)
}

impl Monitor for Cavitation {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        let (system, at) = (step.problem.system, &step.end.kinematics);
        let below = system.limited_pressures().iter().find_map(|own| {
            let pressure = system.signals().measured(own.pressure, at);
            (pressure < own.limit).then(|| Warning::Cavitation {
                time: at.time,
                node: own.node.clone(),
                pressure,
            })
        });
        if let Some(warning) = below {
            warn(warnings, warning);
        }
    }
}
