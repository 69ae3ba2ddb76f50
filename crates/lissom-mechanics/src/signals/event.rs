//! Events: instants at which a signal crosses zero. They may end a run, and change held values.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::{Argument, DiscreteValueId, Graph, SignalId, with_scratch};
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
    /// Index of the event in the order of the system's events.
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
            self.evaluate_events(at, |values| {
                self.events.iter().map(|event| values[event.root.index()]).for_each(visit);
            });
        }
    }

    /// Passes the values of the events that `are_wanted` alone, with their indices.
    pub fn event_values_of(&self, at: &Kinematics, are_wanted: &[bool], mut visit: impl FnMut(usize, f64)) {
        let wanted = || self.events.iter().enumerate().zip(are_wanted).filter(|(_, is_wanted)| **is_wanted);
        if wanted().next().is_none() {
            return;
        }
        with_scratch(self.signals.len(), |are_read| {
            wanted().for_each(|((_, event), _)| are_read[event.root.index()] = 1.0);
            self.mark_arguments(are_read);
            let read = self.of_events.iter().copied().filter(|id| are_read[id.index()] != 0.0);
            self.evaluate_with(at, (read, |_| &[]), |values| {
                wanted().for_each(|((index, event), _)| visit(index, values[event.root.index()]));
            });
        });
    }

    /// Marks the signals on which marked ones depend between samples: 1 for these, and 0 for others.
    fn mark_arguments(&self, are_read: &mut [f64]) {
        for id in SignalId::first(self.signals.len()).rev() {
            let signal = &self.signals[id];
            if are_read[id.index()] == 0.0 || signal.sampling.is_some() {
                continue;
            }
            for argument in &signal.arguments {
                if let Argument::Signal(earlier) = argument {
                    are_read[earlier.index()] = 1.0;
                }
            }
        }
    }

    /// Signals on which the roots of events depend, including themselves, in their order.
    pub(super) fn signals_of_events(&self) -> Vec<SignalId> {
        let mut are_read = vec![0.0; self.signals.len()];
        self.events.iter().for_each(|event| are_read[event.root.index()] = 1.0);
        self.mark_arguments(&mut are_read);
        SignalId::first(self.signals.len()).filter(|id| are_read[id.index()] != 0.0).collect()
    }

    /// Subject of each switch of a signal, in the order of the switches.
    pub fn names_of_switches(&self) -> Vec<Subject> {
        let names = |signal: &super::Signal| std::iter::repeat_n(signal.in_words(), signal.switch_count());
        self.signals.iter().flat_map(names).collect()
    }

    /// Appends switching functions, which change their sign where a signal has a kink or a jump, in the order of the
    /// sides.
    pub fn switches(&self, at: &Kinematics, out: &mut Vec<Switch>) {
        if self.switch_count() == 0 {
            return;
        }
        self.evaluate(at, |values| {
            for (id, signal) in SignalId::enumerate(&self.signals) {
                let Some(law) = signal.law() else { continue };
                let mut arguments = [0.0; super::MAX_ARGUMENTS];
                self.gather(signal, at, values, &mut arguments);
                let arguments = &arguments[..signal.arguments.len()];
                law.switches(at.time, arguments, self.sides(id, at), out);
            }
        });
    }
}

#[cfg(test)]
#[path = "../../tests/unit/signals/event.rs"]
mod tests;
