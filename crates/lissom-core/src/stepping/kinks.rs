//! Steps that end at kinks and jumps of functions of time: of loads, and of prescribed motions.
//!
//! A step across a jump sees it at one of its stages, late or early by part of the step: an error of first order in every
//! velocity. So a step ends as close before it as numbers allow, that its last stage does not see it either, and accelerations, with what a scheme remembers of them, jump as forces do. At a kink, which changes the slope
//! alone, a step ends, and nothing jumps.

use crate::analysis::{Simulation, StepError};
use crate::instants::SAME;
use crate::registry::Function;
use crate::system::System;

/// A value that changes by more than this times what slopes on both sides let expect has jumped [-].
const STEEP: f64 = 10.0;
/// Changes below this part of the value are round-off [-].
const ROUND_OFF: f64 = 1e-12;
/// A step ends this many roundings of the time before a jump.
const ROUNDINGS: f64 = 8.0;

/// When functions of time are not smooth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Kink {
    /// When [s].
    pub(crate) time: f64,
    /// Whether a value jumps, not its slope alone.
    jumps: bool,
}

impl Kink {
    /// A jump at `time` [s].
    pub(crate) fn jump(time: f64) -> Self {
        Self { time, jumps: true }
    }
}

/// Where a step ends because of a kink.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Landing {
    /// End of the step [s].
    pub(crate) end: f64,
    /// What the clock is set to there [s].
    pub(crate) clock: f64,
    /// The jump that lies between the two [s], if there is one.
    jump: Option<f64>,
}

/// All kinks of a system, in ascending order. Times closer than a part of the step, `step` [s], are one.
pub(crate) fn of(system: &System, step: f64) -> Vec<Kink> {
    let near = SAME * step;
    let mut jumps: Vec<f64> = Vec::new();
    let mut known: Vec<f64> = Vec::new();
    for (_, function) in &system.functions {
        let kinks = function.kinks();
        jumps.extend(kinks.iter().filter(|kink| jumps_at(function, **kink, near)));
        known.extend(kinks);
    }
    jumps.sort_by(f64::total_cmp);
    known.sort_by(f64::total_cmp);
    let has = |times: &[f64], time: f64| times.binary_search_by(|probe| probe.total_cmp(&time)).is_ok();
    let mut kinks: Vec<Kink> = Vec::new();
    for time in system.kinks() {
        // Of a function without a name it is not known.
        let jumps = has(&jumps, time) || !has(&known, time);
        match kinks.last_mut() {
            Some(last) if time - last.time <= near => *last = Kink { time, jumps: last.jumps || jumps },
            _ => kinks.push(Kink { time, jumps }),
        }
    }
    kinks
}

/// Whether a function jumps at `kink`, seen from both sides.
fn jumps_at(function: &Function, kink: f64, aside: f64) -> bool {
    let [before, after] = [kink - aside, kink + aside];
    let change = (function.value(after) - function.value(before)).abs();
    let slope = function.first_derivative(before).abs().max(function.first_derivative(after).abs());
    let size = function.value(after).abs().max(function.value(before).abs());
    change > STEEP * 2.0 * aside * slope + ROUND_OFF * size
}

impl Simulation {
    /// Where a step from the time `now` [s] is to end before its end at `limit` [s], because of a kink between; a jump at
    /// its end counts. `longest` is the longest step [s].
    pub(super) fn landing(&self, now: f64, limit: f64, longest: f64) -> Option<Landing> {
        let near = SAME * longest;
        let begin = self.kinks.partition_point(|kink| kink.time <= now + near);
        let is_met = |kink: &&Kink| kink.time < limit - near || (kink.jumps && kink.time <= limit + near);
        let kink = self.kinks[begin..].iter().take_while(|kink| kink.time <= limit + near).find(is_met)?;
        if !kink.jumps {
            let end = kink.time.next_down();
            return Some(Landing { end, clock: end, jump: None });
        }
        let aside = ROUNDINGS * f64::EPSILON * kink.time.abs().max(now.abs());
        let is_end = (kink.time - limit).abs() <= near;
        // The work of the next step begins with the loads behind the jump.
        let clock = if is_end { limit } else { kink.time };
        Some(Landing { end: kink.time.min(limit) - aside, clock, jump: Some(kink.time) })
    }

    /// After a step that ended at a kink: sets the clock, and lets accelerations jump.
    ///
    /// # Errors
    /// If there are no consistent accelerations on one of the sides.
    pub(super) fn pass_kink(&mut self, landing: &Landing, longest: f64) -> Result<(), StepError> {
        if let Some(jump) = landing.jump {
            let aside = SAME * longest;
            self.jump_between(jump - aside, jump + aside)
                .map_err(|error| StepError::Velocities { time: landing.clock, error })?;
            // The end of the step no longer determines the start of the next one.
            self.is_last_step_known &= self.method_memory.is_none();
        }
        (self.state.kinematics.time, self.state.time_remainder) = (landing.clock, 0.0);
        self.work.forget_predictions();
        Ok(())
    }
}
