//! Springs between two points that pass zero length within a step: there the direction of their force reverses, which is not located.

use super::monitor::{Accepted, Beginning, Monitor};
use crate::errors::{Warning, warn};

/// Reports the first spring. Has no state.
struct ZeroLengths;

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let at = &beginning.state.kinematics;
    let mut springs = beginning.problem.system.elements_with(|own| own.spring);
    let applies = beginning.problem.settings.scheme.dynamic && springs.any(|own| own.span(at).is_some());
    applies.then(|| Box::new(ZeroLengths) as Box<dyn Monitor>)
}

impl Monitor for ZeroLengths {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        let (system, [start, end]) = (step.problem.system, [step.start, step.end].map(|own| &own.kinematics));
        let reversed = system.elements_with(|own| own.spring).find_map(|spring| {
            let (nodes, before) = spring.span(start)?;
            let (_, after) = spring.span(end)?;
            (before.dot(&after) < 0.0).then_some(nodes)
        });
        if let Some(nodes) = reversed {
            let [base, tip] = nodes.map(|node| system.layout().name_of_node(node).to_owned());
            warn(warnings, Warning::SpringThroughZero { time: end.time, base, tip });
        }
    }
}
