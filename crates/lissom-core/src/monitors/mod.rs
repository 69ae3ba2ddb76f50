//! Monitors check every accepted step and report warnings. They do not change the motion.
//!
//! A monitor is one file and one line of `KINDS`. Its state is part of snapshots, under its name: a snapshot that was taken
//! without a monitor can be restored with it.

mod beam_strains;
pub(crate) mod constraint_rates;
pub(crate) mod contact;
mod drives;
mod energy_drift;
mod energy_surplus;
mod equilibrium_jump;
mod impacts;
mod instants;
pub(crate) mod limits;
mod monitor;
mod pairs;
mod penetration;
mod redundant_misfit;
mod resolution;
mod sampled_steps;
mod scheme_damping;
mod section_forces;
pub(crate) mod singular_positions;
pub(crate) mod stability;
mod table_ranges;
mod unresolved_forces;

use std::any::Any;

use monitor::Monitor;
pub(crate) use monitor::{Accepted, Beginning};
pub(crate) use penetration::overlap;

use crate::errors::StepError;
use crate::errors::Warning;
use crate::kinematics::Kinematics;
use crate::settings::Problem;

/// A kind of monitor.
struct Kind {
    /// Name of the kind in snapshots.
    name: &'static str,
    /// The monitor of a simulation, if it applies.
    begin: fn(&Beginning<'_>) -> Option<Box<dyn Monitor>>,
}

/// All monitors, in the order in which they check a step.
const KINDS: &[Kind] = &[
    Kind { name: "contact-run", begin: contact::begin_run },
    Kind { name: "constraint-rates", begin: constraint_rates::begin },
    Kind { name: "resolution", begin: resolution::begin },
    Kind { name: "scheme-damping", begin: scheme_damping::begin },
    Kind { name: "contact", begin: contact::begin },
    Kind { name: "limits", begin: limits::begin },
    Kind { name: "redundant-misfit", begin: redundant_misfit::begin },
    Kind { name: "drives", begin: drives::begin },
    Kind { name: "energy-drift", begin: energy_drift::begin },
    Kind { name: "energy-surplus", begin: energy_surplus::begin },
    Kind { name: "equilibrium-jump", begin: equilibrium_jump::begin },
    Kind { name: "singular-positions", begin: singular_positions::begin },
    Kind { name: "impacts", begin: impacts::begin },
    Kind { name: "penetration", begin: penetration::begin },
    Kind { name: "beam-strains", begin: beam_strains::begin },
    Kind { name: "section-forces", begin: section_forces::begin },
    Kind { name: "unresolved-forces", begin: unresolved_forces::begin },
    Kind { name: "stability", begin: stability::begin },
    Kind { name: "table-ranges", begin: table_ranges::begin },
];

/// The monitors of one simulation.
pub(crate) struct Monitors {
    monitors: Vec<(&'static str, Box<dyn Monitor>)>,
}

impl Monitors {
    /// Monitors that apply.
    pub(crate) fn new(beginning: &Beginning<'_>) -> Self {
        let begin = |kind: &Kind| Some((kind.name, (kind.begin)(beginning)?));
        Self { monitors: KINDS.iter().filter_map(begin).collect() }
    }

    /// Passes a step to all monitors.
    pub(crate) fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        for (_, monitor) in &mut self.monitors {
            monitor.accept(step, warnings);
        }
    }

    /// The first cause of a failure at `time` [s] that a monitor recognises.
    pub(crate) fn cause(&mut self, problem: Problem<'_>, at: &Kinematics, time: f64) -> Option<StepError> {
        self.monitors.iter_mut().find_map(|(_, monitor)| monitor.cause(problem, at, time))
    }

    /// The monitor of that type, if there is one.
    pub(crate) fn get<M: Monitor>(&self) -> Option<&M> {
        self.monitors.iter().find_map(|(_, monitor)| (&**monitor as &dyn Any).downcast_ref())
    }

    /// The state of all monitors, by name.
    pub(crate) fn save(&self) -> Vec<(String, Vec<u8>)> {
        let saved = |(name, monitor): &(&str, Box<dyn Monitor>)| ((*name).to_owned(), monitor.save());
        self.monitors.iter().map(saved).filter(|(_, saved)| !saved.is_empty()).collect()
    }

    /// Restores their state; a monitor without saved state begins anew. Whether all could be read.
    pub(crate) fn restore(&mut self, saved: &[(String, Vec<u8>)]) -> bool {
        self.monitors.iter_mut().all(|(name, monitor)| {
            let own = saved.iter().find(|(known, _)| known == name);
            own.is_none_or(|(_, saved)| monitor.restore(saved))
        })
    }
}

#[cfg(test)]
#[path = "../../tests/unit/monitors/mod.rs"]
mod tests;
