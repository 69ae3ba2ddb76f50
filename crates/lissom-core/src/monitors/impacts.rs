//! Steps of planned size do not end at switches of forces. If a motion meets a contact that is shorter than the steps, a
//! scheme dissipates its energy silently; this is detected from the rates at which switches are crossed.
//!
//! Legend: g switching function, at whose zero a force has a kink or a jump (a gap), ω frequency of the contact, h step.
//!
//! A resolved contact slows an approach ġ like cos ωt. An approach that has lost half of its rate two steps after g has
//! crossed zero has ωh > π/6, and one that reverses without having crossed it was stopped within a step. A contact that is over
//! after less than six of its longest steps has ωh > π/6 at its end.

use serde::{Deserialize, Serialize};

use super::monitor::{Accepted, Beginning, Monitor};
use crate::bytes::{read_bytes, to_bytes};
use crate::errors::{Warning, report};
use crate::kinematics::{Kinematics, Switch};
use crate::system::System;

/// The rate is checked at the ends of steps until so many whole steps after a crossing.
const STEPS: f64 = 2.0;
/// A contact of fewer steps than this is not resolved.
const RESOLVED: f64 = 6.0;
/// A step that is shorter than this fraction of the one before it was ended early, by an event or a record.
const EARLY_END: f64 = 0.5;
/// Approaches slower than this fraction of the fastest one of the same switch have no significant energy: a
/// hundredth.
const SLOW_APPROACH: f64 = 0.1;

/// State of one switch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Approach {
    value: f64,
    rate: Option<f64>,
    fastest: f64,
    /// Size of a whole step [s].
    step: f64,
    /// Rate at the last crossing of zero, and the duration since then [s].
    passed: Option<(f64, f64)>,
    /// Rate at the last crossing, the duration since then [s] and the longest step since then [s].
    crossed: Option<(f64, f64, f64)>,
    /// Rate and end [s] of the fastest approach that was stopped.
    stopped: Option<(f64, f64)>,
}

/// Crossing rates of the switches of one simulation.
#[derive(Default)]
struct Impacts {
    time: f64,
    approaches: Vec<Approach>,
    values: Vec<Switch>,
}

impl Impacts {
    /// At the start of a motion with steps of planned size.
    fn new(system: &System, at: &Kinematics) -> Self {
        let mut impacts = Self { time: at.time, ..Self::default() };
        values_at(system, at, &mut impacts.values);
        let of = |switch: &Switch| Approach { value: position(switch), ..Approach::default() };
        impacts.approaches = impacts.values.iter().map(of).collect();
        impacts
    }

    /// After an accepted step: the first switch that stopped an approach faster than steps resolve, and when [s]. An
    /// approach that was fast at the start of a motion may be slow compared with what follows, and is then not reported.
    fn follow(&mut self, system: &System, at: &Kinematics) -> Option<(usize, f64)> {
        values_at(system, at, &mut self.values);
        let duration = at.time - self.time;
        self.time = at.time;
        for (approach, switch) in self.approaches.iter_mut().zip(&self.values) {
            approach.accept(position(switch), duration, at.time);
        }
        let found = self.approaches.iter().enumerate().filter_map(|(which, approach)| {
            let (rate, time) = approach.stopped?;
            (rate >= SLOW_APPROACH * approach.fastest).then_some((which, time))
        });
        found.min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    if !beginning.is_planned_motion() {
        return None;
    }
    let impacts = Impacts::new(beginning.problem.system, &beginning.state.kinematics);
    (!impacts.approaches.is_empty()).then(|| Box::new(impacts) as Box<dyn Monitor>)
}

impl Monitor for Impacts {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        let system = step.problem.system;
        let found = self.follow(system, &step.end.kinematics);
        report(
            warnings,
            |warning| matches!(warning, Warning::ContactTooShort { .. }),
            |known| {
                let (which, time) = found?;
                let reported = || {
                    let what = system.name_of_switch(which);
                    // Laws of signals and local loads are no contacts.
                    let is_law = !what.kind.is_empty();
                    let effect = if is_law {
                        "ends a motion at a kink or jump within two steps: they do not resolve it"
                    } else {
                        "stops the colliding part within two steps: such a short contact is not resolved"
                    };
                    Warning::ContactTooShort { time, what, effect: effect.to_owned() }
                };
                Some(known.cloned().unwrap_or_else(reported))
            },
        );
    }

    fn save(&self) -> Vec<u8> {
        to_bytes(&(self.time, &self.approaches))
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        let count = self.approaches.len();
        let learned: Option<(_, Vec<_>)> =
            read_bytes(saved).filter(|(_, own): &(_, Vec<_>)| own.len() == count);
        learned.map(|learned| (self.time, self.approaches) = learned).is_some()
    }
}

impl Approach {
    /// Records the value at `time` [s], after a step of this duration [s].
    fn accept(&mut self, value: f64, duration: f64, time: f64) {
        let entry = self.passed.map(|(entry, _)| entry);
        let crossed = self.crossed.map(|(entry, ..)| entry);
        let last = self.rate;
        if self.is_stopped(value, duration) {
            let rate = entry.or(crossed).or(last).unwrap_or(0.0).abs();
            if self.stopped.is_none_or(|(fastest, _)| rate > fastest) {
                self.stopped = Some((rate, time));
            }
        }
    }

    /// Records the value after a step of this duration [s], and returns whether the motion was stopped too fast.
    fn is_stopped(&mut self, value: f64, duration: f64) -> bool {
        let before = std::mem::replace(&mut self.value, value);
        let rate = (value - before) / duration;
        self.step = duration.max(EARLY_END * self.step);
        let Some(last) = self.rate.replace(rate) else { return false };
        self.fastest = self.fastest.max(last.abs());
        let is_slow = last.abs() < SLOW_APPROACH * self.fastest;
        // A step that ends at an event ends at zero.
        let is_beyond = |place: f64| before != 0.0 && (place == 0.0 || (before > 0.0) != (place > 0.0));
        let mut is_short = false;
        if let Some((_, since, longest)) = &mut self.crossed {
            *since += duration;
            *longest = longest.max(duration);
            is_short = is_beyond(value) && *since < RESOLVED * *longest;
        }
        if is_beyond(value) {
            self.crossed = (!is_slow).then_some((last, 0.0, 0.0));
        }
        if is_beyond(value) || is_beyond(before + last * duration) {
            // It has crossed, or should have: where the rate `last` leads to zero.
            let since = (duration + before / last).clamp(0.0, duration);
            self.passed = (!is_slow).then_some((last, since - duration));
        }
        let Some((entry, since)) = &mut self.passed else { return is_short };
        *since += duration;
        // An approach through a contact that is resolved retains more than half of its rate at the next ends of steps.
        let is_stopped = is_short || rate / *entry < 0.5;
        // The step with the crossing itself contains two motions.
        let is_over = *since >= STEPS * self.step || is_stopped;
        if is_over {
            self.passed = None;
        }
        is_stopped
    }
}

/// The distance from where a force switches; laws with levels stop nothing.
fn position(switch: &Switch) -> f64 {
    if switch.levels.is_some() { 0.0 } else { switch.number }
}

fn values_at(system: &System, at: &Kinematics, out: &mut Vec<Switch>) {
    out.clear();
    system.signals().switches(at, out);
    system.switches(at, out);
}

#[cfg(test)]
#[path = "../../tests/unit/monitors/impacts.rs"]
mod tests;
