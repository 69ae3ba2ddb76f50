//! Whether superelements deform no more than their linear matrices can tell.

use super::Warning;
use crate::system::{State, System};

/// Adds the first superelement that leaves its linear range, if no other was told.
pub(crate) fn tell(system: &System, state: &State, warnings: &mut Vec<Warning>) {
    let Some((part, node)) = system.linear_range(&state.kinematics).filter(|(part, _)| *part > 1.0) else {
        return;
    };
    let known = warnings.iter_mut().find_map(|warning| match warning {
        Warning::BeyondLinear { largest, .. } => Some(largest),
        _ => None,
    });
    if let Some(largest) = known {
        *largest = largest.max(part);
        return;
    }
    let interface = system.layout().name_of_node(node).to_owned();
    warnings.push(Warning::BeyondLinear { time: state.kinematics.time, interface, largest: part });
}
