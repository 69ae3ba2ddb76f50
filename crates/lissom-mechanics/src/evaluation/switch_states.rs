//! The sides of an element's switches, at which its forces have a kink or a jump and steps end. Within a step the forces
//! are continued from the side at its start.

use crate::kinematics::Kinematics;

/// Location of the frozen states of an element's switches; none until the system is built.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SwitchStates {
    held: Option<(usize, usize)>,
}

impl SwitchStates {
    /// `count` sides, stored from the held value `first` on.
    pub fn held_at(first: usize, count: usize) -> Self {
        Self { held: Some((first, count)) }
    }

    /// The sides at a configuration: 1 above, -1 below, those of levels ([`Switch`](crate::kinematics::Switch)), 0 where the switch
    /// decides by itself.
    pub fn of<'k>(&self, at: &'k Kinematics) -> &'k [f64] {
        let held = self.held.and_then(|(first, count)| at.held.get(first..first + count));
        held.unwrap_or_default()
    }
}

/// Whether a switch with this frozen state is on its upper branch; none if it decides by itself.
pub fn frozen_branch(side: Option<&f64>) -> Option<bool> {
    side.filter(|side| **side != 0.0).map(|side| *side > 0.0)
}

/// Whether a switch of this value is on its upper branch, given its frozen state if there is one.
pub fn is_on_upper_branch(side: Option<&f64>, value: f64) -> bool {
    frozen_branch(side).unwrap_or(value > 0.0)
}
