//! Whether superelements remain in the range of deformations and loads for which their linear matrices are valid.

use super::monitor::{Accepted, Beginning, Monitor};
use crate::elements::{LinearLimit, LinearRange};
use crate::errors::Warning;
use crate::kinematics::Kinematics;
use crate::system::{State, System};

/// Reports the first superelement that leaves its linear range in each respect. Has no state.
struct LinearRanges;

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    // Every superelement has a deformation.
    linear_range(beginning.problem.system, LinearLimit::Deformation, &beginning.state.kinematics)?;
    Some(Box::new(LinearRanges))
}

/// The element that exceeds the range of its linear law most; none if no element is linear in a frame of its own.
fn linear_range(system: &System, limit: LinearLimit, at: &Kinematics) -> Option<LinearRange> {
    let parts =
        system.elements_with(|own| own.deformation).filter_map(|element| element.linear_range(limit, at));
    parts.reduce(|most, own| if own.part > most.part { own } else { most })
}

impl Monitor for LinearRanges {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        let (system, state) = (step.problem.system, step.end);
        for limit in LinearLimit::ALL {
            let found = linear_range(system, limit, &state.kinematics).filter(|own| own.part > 1.0);
            if let Some(found) = found {
                check_element(system, state, (limit, found), warnings);
            }
        }
    }
}

fn check_element(
    system: &System,
    state: &State,
    (limit, found): (LinearLimit, LinearRange),
    warnings: &mut Vec<Warning>,
) {
    let LinearRange { part, node } = found;
    let known = warnings.iter_mut().find_map(|warning| match (limit, warning) {
        (LinearLimit::Deformation, Warning::BeyondLinear { largest, .. })
        | (LinearLimit::Spin, Warning::TurnsFast { largest, .. })
        | (LinearLimit::Load, Warning::LoadStiffness { largest, .. })
        | (LinearLimit::Moment, Warning::MomentStiffness { largest, .. })
        | (LinearLimit::LeftOut, Warning::ModesLeftOut { largest, .. }) => Some(largest),
        _ => None,
    });
    if let Some(largest) = known {
        *largest = largest.max(part);
        return;
    }
    let interface = system.layout().name_of_node(node).to_owned();
    let (time, largest) = (state.kinematics.time, part);
    warnings.push(match limit {
        LinearLimit::Deformation => Warning::BeyondLinear { time, interface, largest },
        LinearLimit::Spin => Warning::TurnsFast { time, interface, largest },
        LinearLimit::Load => Warning::LoadStiffness { time, interface, largest },
        LinearLimit::Moment => Warning::MomentStiffness { time, interface, largest },
        LinearLimit::LeftOut => Warning::ModesLeftOut { time, interface, largest },
    });
}
