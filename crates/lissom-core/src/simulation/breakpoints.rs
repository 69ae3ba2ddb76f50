//! Steps that end at breakpoints (kinks and jumps) of functions of time: of loads, and of prescribed motions.
//!
//! A step across a jump would include it at one of its stages, late or early by a fraction of the step: an error of first order in
//! every velocity. Therefore a step ends as close before it as floating-point numbers allow, and no stage includes it. Accelerations,
//! and the scheme's history of them, then jump as forces do. A step also ends at a kink, where only the slope changes, without any
//! jump.

use crate::instants::TIME_TOLERANCE;
use crate::registry::Function;
use crate::round_off;
use crate::system::System;

/// A value jumps if it changes by more than this multiple of the change expected from the slopes on both sides [-].
const STEEP: f64 = 10.0;
/// A step ends before a jump by this multiple of the round-off of the time.
const ROUNDINGS: f64 = 8.0;

/// An instant at which a function of time is not smooth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Breakpoint {
    /// When [s].
    pub(crate) time: f64,
    /// Whether a value jumps, not only its slope.
    jumps: bool,
    /// The first instant after it [s]: `time`, or the next floating-point number if a function may still have its former value there.
    behind: f64,
}

impl Breakpoint {
    /// A jump at `time` [s].
    pub(crate) fn jump(time: f64) -> Self {
        Self { time, jumps: true, behind: time }
    }
}

/// End of a step at a breakpoint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StopTime {
    /// End of the step [s].
    pub(crate) end: f64,
    /// Time to which the clock is then set [s].
    pub(crate) clock: f64,
    /// The jump between the two [s], if there is one.
    pub(crate) jump: Option<f64>,
}

/// All breakpoints of a system, in ascending order. Times closer than a fraction of the step, `step` [s], are merged.
pub(crate) fn of(system: &System, step: f64) -> Vec<Breakpoint> {
    let near = TIME_TOLERANCE * step;
    let mut jumps: Vec<f64> = Vec::new();
    let mut known: Vec<f64> = Vec::new();
    let mut late: Vec<f64> = Vec::new();
    for (_, function) in &system.functions {
        let breakpoints = function.breakpoints();
        jumps.extend(breakpoints.iter().filter(|breakpoint| jumps_at(function, **breakpoint, near)));
        late.extend(breakpoints.iter().filter(|breakpoint| jumps_behind(function, **breakpoint)));
        known.extend(breakpoints);
    }
    for times in [&mut jumps, &mut known, &mut late] {
        times.sort_by(f64::total_cmp);
    }
    let has = |times: &[f64], time: f64| times.binary_search_by(|probe| probe.total_cmp(&time)).is_ok();
    let mut breakpoints: Vec<Breakpoint> = Vec::new();
    for time in system.breakpoints() {
        // For a function without a name it is unknown whether it jumps.
        let (jumps, is_known) = (has(&jumps, time), has(&known, time));
        let behind = if is_known && !has(&late, time) { time } else { time.next_up() };
        let jumps = jumps || !is_known;
        match breakpoints.last_mut() {
            Some(last) if time - last.time <= near => {
                *last = Breakpoint { time, jumps: last.jumps || jumps, behind };
            }
            _ => breakpoints.push(Breakpoint { time, jumps, behind }),
        }
    }
    breakpoints
}

/// Whether a function jumps at `breakpoint`, by its values on both sides.
fn jumps_at(function: &Function, breakpoint: f64, aside: f64) -> bool {
    let [before, after] = [breakpoint - aside, breakpoint + aside];
    let change = (function.value(after) - function.value(before)).abs();
    let slope = function.first_derivative(before).abs().max(function.first_derivative(after).abs());
    let size = function.value(after).abs().max(function.value(before).abs());
    change > STEEP * 2.0 * aside * slope + round_off::FUNCTION * size
}

/// Whether a function has its former value at `breakpoint`, and jumps immediately after it.
fn jumps_behind(function: &Function, breakpoint: f64) -> bool {
    let [at, next] = [breakpoint, breakpoint.next_up()].map(|time| function.value(time));
    (next - at).abs() > round_off::FUNCTION * at.abs().max(next.abs())
}

/// The breakpoint at which a step from the time `now` [s] has to end before `limit` [s]. A jump at `limit` itself is included, because
/// forces contain it: an equilibrium before a jump is independent of it. `longest` is the longest step [s].
pub(crate) fn stop_time(
    breakpoints: &[Breakpoint],
    [now, limit]: [f64; 2],
    longest: f64,
    is_motion: bool,
) -> Option<StopTime> {
    let near = TIME_TOLERANCE * longest;
    let begin = breakpoints.partition_point(|breakpoint| breakpoint.time <= now + near);
    let is_met = |breakpoint: &&Breakpoint| {
        breakpoint.time < limit - near || (breakpoint.jumps && breakpoint.time <= limit + near)
    };
    let breakpoint =
        breakpoints[begin..].iter().take_while(|breakpoint| breakpoint.time <= limit + near).find(is_met)?;
    if !(breakpoint.jumps && is_motion) {
        let end = breakpoint.time.next_down();
        return Some(StopTime { end, clock: end, jump: None });
    }
    let aside = ROUNDINGS * f64::EPSILON * breakpoint.time.abs().max(now.abs());
    let is_end = (breakpoint.time - limit).abs() <= near;
    // The work of the next step begins with the loads after the jump.
    let clock = if is_end { limit } else { breakpoint.behind };
    Some(StopTime { end: breakpoint.time.min(limit) - aside, clock, jump: Some(breakpoint.time) })
}
