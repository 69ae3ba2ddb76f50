//! Events: instants at which a signal crosses zero. They may end a run, and change held values.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::{DiscreteValueId, Graph, SignalId};
use crate::kinematics::{Kinematics, Subject, Switch};

/// Direction in which a signal crosses zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// From below.
    Rising,
    /// From above.
    Falling,
    /// From either side.
    Both,
}

impl Direction {
    /// Whether a signal that is above zero after the crossing, or below, has crossed it in this direction.
    pub fn allows(self, is_above: bool) -> bool {
        match self {
            Self::Rising => is_above,
            Self::Falling => !is_above,
            Self::Both => true,
        }
    }
}

/// Actions when a signal crosses zero.
#[derive(Clone, Debug)]
pub struct Event {
    /// Name in messages and results.
    pub name: String,
    /// The signal that crosses zero.
    pub root: SignalId,
    /// Direction of the crossing.
    pub direction: Direction,
    /// Whether the run ends there.
    pub stops: bool,
    /// Held values that change there, and the signals that are assigned to them.
    pub sets: Vec<(DiscreteValueId, SignalId)>,
}

/// An event that happened.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Occurrence {
    /// Its index in the order of the system's events.
    pub event: usize,
    /// When [s].
    pub time: f64,
}

impl fmt::Display for Direction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Rising => "rising",
            Self::Falling => "falling",
            Self::Both => "both",
        })
    }
}

impl Graph {
    /// The events.
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// Passes on the values whose crossings of zero are events, in the order of the events. They are not continued from a side,
    /// because a continued one never jumps, and crosses zero where the signal only touches it.
    pub fn event_values(&self, at: &Kinematics, visit: impl FnMut(f64)) {
        if !self.events.is_empty() {
            self.evaluate_as_they_are(at, |values| {
                self.events.iter().map(|event| values[event.root.index()]).for_each(visit);
            });
        }
    }

    /// Subject of each switch of a signal, in the order of the switches.
    pub fn names_of_switches(&self) -> Vec<Subject> {
        let sampled_apart = self.signals.iter().filter(|signal| signal.sampling.is_none());
        let names =
            |signal: &super::Signal| std::iter::repeat_n(signal.in_words(), signal.function.switch_count());
        sampled_apart.flat_map(names).collect()
    }

    /// Appends switching functions, which change their sign where a signal has a kink or a jump, in the order of the
    /// sides.
    pub fn switches(&self, at: &Kinematics, out: &mut Vec<Switch>) {
        if self.first_sides.last() == self.first_sides.first() {
            return;
        }
        self.evaluate(at, |values| {
            let signals = SignalId::enumerate(&self.signals);
            for (id, signal) in signals.filter(|(_, one)| one.sampling.is_none()) {
                let mut arguments = [0.0; super::MAX_ARGUMENTS];
                self.gather(signal, at, values, &mut arguments);
                let arguments = &arguments[..signal.arguments.len()];
                signal.function.switches(at.time, arguments, self.sides(id, at), out);
            }
        });
    }
}
