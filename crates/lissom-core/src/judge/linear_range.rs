//! Whether superelements deform no more than their linear matrices can tell.

use super::Warning;
use crate::elements::LinearRange;
use crate::system::{State, System};

/// Adds the first superelement that leaves its linear range, if no other was told.
pub(crate) fn tell(system: &System, state: &State, warnings: &mut Vec<Warning>) {
    let Some(LinearRange { part, node, is_spin }) =
        system.linear_range(&state.kinematics).filter(|own| own.part > 1.0)
    else {
        return;
    };
    let known = warnings.iter_mut().find_map(|warning| match warning {
        Warning::BeyondLinear { largest, .. } if !is_spin => Some(largest),
        Warning::TurnsFast { largest, .. } if is_spin => Some(largest),
        _ => None,
    });
    if let Some(largest) = known {
        *largest = largest.max(part);
        return;
    }
    let interface = system.layout().name_of_node(node).to_owned();
    let (time, largest) = (state.kinematics.time, part);
    warnings.push(if is_spin {
        Warning::TurnsFast { time, interface, largest }
    } else {
        Warning::BeyondLinear { time, interface, largest }
    });
}
