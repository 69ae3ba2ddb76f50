//! Whether steps that solve for all touches at once damp the motion between touches. The scheme is of first order: of each step it loses
//!
//! ```text
//! L = ½ (v' - v)ᵀ M (v' - v)
//! ```
//!
//! Legend: v, v' velocities at its start and end, M inertias. Parts that touch, and those that joints or
//! elements connect with them, are left out: their impacts are meant to lose energy.

use serde::{Deserialize, Serialize};

use super::monitor::{Accepted, Beginning, Monitor};
use crate::bytes::{from_bytes, to_bytes};
use crate::elements::inertia::Inertia;
use crate::errors::{Warning, report_since};
use crate::kinematics::{GROUND, Kinematics, Subject, split};

/// Loss over the energy exchanged above which it is reported.
const NOTEWORTHY: f64 = 0.05;

/// Energy lost so far.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct SchemeDamping {
    /// Energy lost by all parts [J].
    lost: f64,
    /// By inertia [J].
    by_inertia: Vec<f64>,
    /// Labels of the components of the model that touch something, in ascending order.
    #[serde(skip)]
    touching: Vec<usize>,
}

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let system = beginning.problem.system;
    let is_examined = beginning.is_planned_motion() && !system.contacts().is_empty();
    let own =
        SchemeDamping { lost: 0.0, by_inertia: vec![0.0; system.inertias().len()], touching: Vec::new() };
    is_examined.then(|| Box::new(own) as Box<dyn Monitor>)
}

/// Loss of a part between two configurations [J].
fn loss(inertia: &Inertia, [from, to]: [&Kinematics; 2]) -> f64 {
    let [before, after] = [from, to].map(|at| &at.nodes[inertia.node()]);
    let (velocity, spin) = split(&before.twist);
    let turned = |vector| after.frame.rotation.apply_inverse(&before.frame.rotation.apply(vector));
    let (velocity, spin) = (turned(&velocity), turned(&spin));
    let mut change = after.twist;
    for k in 0..3 {
        change[k] -= velocity[k];
        change[3 + k] -= spin[k];
    }
    0.5 * change.dot(&(inertia.mass() * change))
}

/// Finds the components that touch something.
fn find_touching(step: &Accepted<'_>, labels: &mut Vec<usize>) {
    labels.clear();
    let (system, ends) = (step.problem.system, [step.start, step.end]);
    let Some(contacts) = &step.integrator.work.contacts else { return };
    let touches = ends.iter().flat_map(|end| &end.touches);
    let parts = touches.flat_map(|touch| touch.key.parts);
    let label = |part: u32| contacts.label_of(system.layout(), system.contacts().parts[part as usize].node);
    labels.extend(parts.filter_map(label));
    labels.sort_unstable();
    labels.dedup();
}

impl Monitor for SchemeDamping {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        let system = step.problem.system;
        let ends = [&step.start.kinematics, &step.end.kinematics];
        find_touching(step, &mut self.touching);
        let Some(contacts) = &step.integrator.work.contacts else { return };
        for (own, inertia) in self.by_inertia.iter_mut().zip(system.inertias()) {
            let label = contacts.label_of(system.layout(), inertia.node());
            if label.is_some_and(|label| self.touching.binary_search(&label).is_err()) {
                let lost = loss(inertia, ends);
                *own += lost;
                self.lost += lost;
            }
        }
        let exchanged = step.energy_balance[1].turned_over;
        let share = if exchanged > 0.0 { self.lost / exchanged } else { 0.0 };
        let most = self.by_inertia.iter().enumerate().max_by(|one, other| one.1.total_cmp(other.1));
        let part = most.map_or(GROUND, |(index, _)| system.inertias()[index].node());
        let name = || Subject::new("node", system.layout().name_of_node(part));
        let (lost, is_noteworthy) = (self.lost, share > NOTEWORTHY);
        report_since!(warnings, ends[1].time, is_noteworthy, SchemeDamps { lost, share, part: name() });
    }

    fn save(&self) -> Vec<u8> {
        to_bytes(self)
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        let count = self.by_inertia.len();
        from_bytes(saved, self) && self.by_inertia.len() == count
    }
}
