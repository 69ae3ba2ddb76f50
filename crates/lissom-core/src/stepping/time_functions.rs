//! Whether steps resolve functions of time. A pulse between the stages of a step, or an oscillation with the step as its
//! period, appears in no residual and in no error estimate: it would be ignored or misinterpreted without notice. The same
//! applies to a jump that no line of time under `step` or `sign` reports.
//!
//! A function is determined by the ends of an interval if the cubic through values and slopes there reproduces its values:
//!
//! ```text
//! |f(t) - H(t)| ≤ DEPARTURE · max |f|
//! ```
//!
//! It is sampled by halving an interval, as long as its bounds allow more than the samples show. A feature that is not determined
//! by the ends of any interval, however short, is a jump: a step ends there, as at known ones, see `breakpoints`. Adaptive steps
//! are so short that their ends determine the rest; a warning reports planned ones that are not.

use std::sync::Arc;

use crate::instants::SAME;
use crate::registry::TimeFunction;
use crate::system::System;

/// A function that deviates by more than this fraction of its largest value from the interpolation of a step's ends is not
/// resolved: a sine with 4.4 steps a period.
pub(super) const DEPARTURE: f64 = 0.01;
/// If bounds are narrower than this fraction of the largest value, nothing is missed between the samples.
const NARROW: f64 = 0.1;
/// Maximum number of intervals within one step, and in the search for the largest value.
const MAX_INTERVALS: usize = 256;
/// Maximum number of pending intervals, which limits the halvings of an interval.
const MAX_PENDING: usize = 64;
/// Halvings of an interval after which the remaining feature is a jump.
const MAX_HALVINGS: usize = 30;
/// Halvings of a step in which jumps beside fast motions are searched for.
const FURTHER: i32 = 6;
/// Maximum number of intervals in a block.
const MAX_INTERVALS_IN_BLOCK: usize = 16 * MAX_INTERVALS;
/// Values and slopes at the ends are evaluated by this fraction of the interval inside: a jump at an end belongs to the
/// neighbour.
const INSIDE: f64 = 1e-6;
/// Blocks begin this fraction of a step before one of them: the golden section, which is no simple fraction of a
/// step.
const ASIDE: f64 = 0.381_966;
/// Number of planned steps that are sampled together; adaptive ones are as many of the longest.
pub(super) const BLOCK: [f64; 2] = [64.0, 1.0];
/// Number of blocks for which the largest value is found together.
pub(super) const WINDOW: f64 = 64.0;

/// Properties of the functions of a system. All of them follow from the start time of the motion and the size of
/// steps.
#[derive(Clone, Debug, Default)]
pub(crate) struct TimeFunctions {
    /// Largest magnitude of each function since the beginning, up to the end of each window.
    sizes: Vec<Vec<f64>>,
    /// Start and end of the last sampled block [s].
    block: Option<[f64; 2]>,
    /// Start of its first interval that is not determined by the ends of a step [s], with the function's index.
    pub(super) hidden: Option<(f64, usize)>,
}

/// Result for an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Found {
    /// No feature except those that its ends determine.
    Nothing,
    /// A feature that the ends of shorter intervals determine.
    Hidden,
    /// A jump, at the first number after it [s].
    Jump(f64),
}

/// Result for a block.
#[derive(Debug, Default)]
struct Scan {
    looks: usize,
    hidden: Option<f64>,
    jumps: Vec<f64>,
}

impl TimeFunctions {
    /// Magnitudes of the functions of a motion that began at `origin` [s], up to two windows of this length beyond
    /// `time`.
    pub(super) fn sizes(&mut self, system: &System, origin: f64, time: f64, window: f64) -> &[f64] {
        let index = ((time - origin) / window).max(0.0) as usize;
        while self.sizes.len() < index + 2 {
            let from = origin + self.sizes.len() as f64 * window;
            let before = self.sizes.last();
            let largest = system.functions.iter().enumerate().map(|(k, (_, function))| {
                largest(&**function, from, from + window).max(before.map_or(0.0, |sizes| sizes[k]))
            });
            let largest = largest.collect();
            self.sizes.push(largest);
        }
        &self.sizes[index + 1]
    }

    /// Samples the block around a step of `step` [s] from `from` on, unless it was the last one sampled; returns the jumps in
    /// it.
    pub(super) fn look_ahead(
        &mut self,
        system: &System,
        origin: f64,
        from: f64,
        [step, length]: [f64; 2],
    ) -> Vec<f64> {
        let from = from + SAME * step;
        if self.block.is_some_and(|[first, last]| first <= from && from + (1.0 + 0.5 * ASIDE) * step <= last)
        {
            return Vec::new();
        }
        let first = origin + ((from - origin) / length).floor() * length;
        // Jumps often are at ends of steps, and are then detected within the sampled intervals. A step in two blocks belongs to
        // the earlier one.
        let block = [(first - ASIDE * step).max(origin), first + length + (1.0 + ASIDE) * step];
        let sizes = self.sizes(system, origin, from, WINDOW * length).to_vec();
        let (mut hidden, mut jumps) = (None, Vec::new());
        for (index, ((_, function), size)) in system.functions.iter().zip(sizes).enumerate() {
            let mut scan = Scan::default();
            scan.look(&**function, block, step, size);
            let sooner = |time: &f64| hidden.is_none_or(|(known, _)| *time < known);
            hidden = scan.hidden.filter(sooner).map(|time| (time, index)).or(hidden);
            // A drive that jumps is reported, see `judge::drives`, and not treated here.
            if !system.drives().iter().any(|drive| Arc::ptr_eq(&drive.prescribed.value, function)) {
                jumps.append(&mut scan.jumps);
            }
        }
        (self.block, self.hidden) = (Some(block), hidden);
        jumps
    }

    /// The longest step of `size` [s] or less, obtained by halving, from `from` on whose ends determine the functions within
    /// it, except for jumps.
    pub(super) fn longest_resolved(
        &mut self,
        system: &System,
        origin: f64,
        (from, size): (f64, f64),
        part: f64,
        window: f64,
    ) -> f64 {
        let sizes = self.sizes(system, origin, from, window);
        let mut longest = size;
        for ((_, function), &largest) in system.functions.iter().zip(sizes) {
            for _ in 0..MAX_HALVINGS {
                if found(&**function, [from, from + longest], largest, part) != Found::Hidden {
                    break;
                }
                longest *= 0.5;
            }
        }
        longest
    }
}

impl Scan {
    /// Samples a block of steps, between the known breakpoints.
    fn look(&mut self, function: &dyn TimeFunction, [from, to]: [f64; 2], step: f64, size: f64) {
        if function.is_constant() || size == 0.0 {
            return;
        }
        let breakpoints = function.breakpoints();
        let inside = breakpoints.iter().copied().filter(|breakpoint| *breakpoint > from && *breakpoint < to);
        let mut begin = from;
        for end in inside.chain([to]) {
            self.look_between(function, [begin, end], step, size);
            begin = end;
        }
    }

    fn look_between(&mut self, function: &dyn TimeFunction, [from, to]: [f64; 2], step: f64, size: f64) {
        self.looks += 1;
        let length = to - from;
        if self.looks > MAX_INTERVALS_IN_BLOCK || length <= SAME * step {
            return;
        }
        let is_reported = || {
            let part = [from, to];
            is_narrow(function, part, size) && departure(function, part, part) <= DEPARTURE * size
        };
        let mut middle = 0.5 * (from + to);
        if length > (1.0 + SAME) * step {
            if is_reported() {
                return;
            }
        } else {
            match found(function, [from, to], size, DEPARTURE) {
                Found::Nothing => return,
                Found::Hidden => {
                    // Between two breakpoints a step is shorter, and its error is less significant.
                    let part = DEPARTURE * (step / length).max(1.0);
                    if found(function, [from, to], size, part) == Found::Hidden {
                        self.hidden = Some(self.hidden.map_or(middle, |known| known.min(middle)));
                    }
                    if length < step * 0.5_f64.powi(FURTHER) {
                        return;
                    }
                }
                Found::Jump(time) => {
                    // A jump at an end is a known one.
                    if (time - from).min(to - time) <= SAME * step {
                        return;
                    }
                    self.jumps.push(time);
                    middle = time;
                }
            }
        }
        self.look_between(function, [from, middle], step, size);
        self.look_between(function, [middle, to], step, size);
    }
}

/// The largest magnitude of a function between two times, within a factor of two if it has bounds.
fn largest(function: &dyn TimeFunction, from: f64, to: f64) -> f64 {
    if function.is_constant() {
        return 0.0;
    }
    let size = |time: f64| {
        let value = function.value(time).abs();
        if value.is_finite() { value } else { 0.0 }
    };
    let part = (to - from) / MAX_INTERVALS as f64;
    let mut found = (0..=MAX_INTERVALS).map(|k| size(from + k as f64 * part)).fold(0.0, f64::max);
    let most = |[from, to]: [f64; 2]| {
        let [low, high] = function.bounds(from, to)?;
        Some(high.max(-low))
    };
    let mut open: Vec<(f64, [f64; 2])> =
        most([from, to]).into_iter().map(|most| (most, [from, to])).collect();
    for _ in 0..MAX_INTERVALS {
        let Some(index) = (0..open.len()).max_by(|&a, &b| open[a].0.total_cmp(&open[b].0)) else { break };
        let (bound, [from, to]) = open.swap_remove(index);
        if bound <= 2.0 * found {
            break;
        }
        let middle = 0.5 * (from + to);
        found = found.max(size(middle));
        let halves = [[from, middle], [middle, to]];
        open.extend(halves.into_iter().filter_map(|half| Some((most(half)?, half))));
    }
    found
}

/// Whether bounds show that a function remains in a narrow range between two times; also if it has none.
fn is_narrow(function: &dyn TimeFunction, [from, to]: [f64; 2], size: f64) -> bool {
    let inside = INSIDE * (to - from);
    function.bounds(from + inside, to - inside).is_none_or(|[low, high]| high - low <= NARROW * size)
}

/// Features of a function between two times that its values and slopes there do not determine to `part` of its largest
/// value.
fn found(function: &dyn TimeFunction, whole: [f64; 2], size: f64, part: f64) -> Found {
    if function.is_constant() || size == 0.0 {
        return Found::Nothing;
    }
    let mut open = [whole; MAX_PENDING];
    let (mut last, mut looks) = (1, 0);
    while last > 0 {
        last -= 1;
        let within = open[last];
        looks += 1;
        if departure(function, whole, within) > part * size {
            return jump(function, whole, size).map_or(Found::Hidden, Found::Jump);
        }
        if looks < MAX_INTERVALS && last + 2 <= MAX_PENDING && !is_narrow(function, within, size) {
            let middle = 0.5 * (within[0] + within[1]);
            (open[last], open[last + 1]) = ([middle, within[1]], [within[0], middle]);
            last += 2;
        }
    }
    Found::Nothing
}

/// The first number after a jump: where part of an interval is determined by the ends of no interval, however short.
fn jump(function: &dyn TimeFunction, [mut from, mut to]: [f64; 2], size: f64) -> Option<f64> {
    for _ in 0..MAX_HALVINGS {
        let middle = 0.5 * (from + to);
        let is_reported = |half: [f64; 2]| departure(function, half, half) <= DEPARTURE * size;
        if !is_reported([from, middle]) {
            to = middle;
        } else if !is_reported([middle, to]) {
            from = middle;
        } else {
            return None;
        }
    }
    let value = |time: f64| function.value(time);
    while from.next_up() < to {
        let middle = 0.5 * (from + to);
        if (value(middle) - value(from)).abs() > (value(to) - value(middle)).abs() {
            to = middle;
        } else {
            from = middle;
        }
    }
    Some(to)
}

/// Deviation of a function, at three instants of `part`, from the cubic through its values and slopes at the ends of
/// `whole`.
fn departure(function: &dyn TimeFunction, [from, to]: [f64; 2], part: [f64; 2]) -> f64 {
    let inside = INSIDE * (to - from);
    let (from, to) = (from + inside, to - inside);
    let length = to - from;
    let [one, other] =
        [from, to].map(|time| (function.value(time), length * function.first_derivative(time)));
    let departure = |share: f64| {
        let time = part[0] + share * (part[1] - part[0]);
        let x = ((time - from) / length).clamp(0.0, 1.0);
        let y = 1.0 - x;
        let cubic = y * y * (1.0 + 2.0 * x) * one.0
            + x * x * (1.0 + 2.0 * y) * other.0
            + x * y * (y * one.1 - x * other.1);
        (function.value(time) - cubic).abs()
    };
    // A value that is not finite is reported elsewhere.
    [0.25, 0.5, 0.75].map(departure).into_iter().fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A function by its value and slope, with bounds of half width `wide` about zero, if given.
    #[derive(Debug)]
    struct By {
        value: fn(f64) -> f64,
        slope: fn(f64) -> f64,
        bounds: fn(f64, f64) -> [f64; 2],
    }

    impl TimeFunction for By {
        fn value(&self, time: f64) -> f64 {
            (self.value)(time)
        }
        fn first_derivative(&self, time: f64) -> f64 {
            (self.slope)(time)
        }
        fn second_derivative(&self, _: f64) -> f64 {
            0.0
        }
        fn bounds(&self, from: f64, to: f64) -> Option<[f64; 2]> {
            Some((self.bounds)(from, to))
        }
    }

    /// exp(-((t - 1)/1e-4)²).
    const PULSE: By = By {
        value: |t| (-((t - 1.0) / 1e-4).powi(2)).exp(),
        slope: |t| -2.0 * (t - 1.0) / 1e-8 * (-((t - 1.0) / 1e-4).powi(2)).exp(),
        bounds: |from, to| {
            let of = |t: f64| (-((t - 1.0) / 1e-4).powi(2)).exp();
            let high = if from < 1.0 && to > 1.0 { 1.0 } else { of(from).max(of(to)) };
            [of(from).min(of(to)), high]
        },
    };
    /// 1000 periods a second.
    const FAST: By = By {
        value: |t| (std::f64::consts::TAU * 1e3 * t + 0.5).sin(),
        slope: |t| std::f64::consts::TAU * 1e3 * (std::f64::consts::TAU * 1e3 * t + 0.5).cos(),
        bounds: |_, _| [-1.0, 1.0],
    };
    const JUMP: By = By {
        value: |t| f64::from(u8::from(t > 0.3)),
        slope: |_| 0.0,
        bounds: |from, to| [f64::from(u8::from(from > 0.3)), f64::from(u8::from(to > 0.3))],
    };

    fn scanned(function: &By, block: [f64; 2], step: f64) -> Scan {
        let mut scan = Scan::default();
        scan.look(function, block, step, 1.0);
        scan
    }

    #[test]
    fn a_pulse_between_the_stages_of_a_step_is_found() {
        assert!(largest(&PULSE, 0.0, 3.0) > 0.5);
        assert_eq!(found(&PULSE, [0.0, 1.7], 1.0, DEPARTURE), Found::Hidden);
        assert_eq!(found(&PULSE, [0.0, 0.999], 1.0, DEPARTURE), Found::Nothing);
        assert_eq!(found(&PULSE, [0.99998, 1.00001], 1.0, DEPARTURE), Found::Nothing);
        let Scan { hidden, jumps, .. } = scanned(&PULSE, [0.0, 64e-3 * 40.0], 1e-3);
        assert!((hidden.expect("it is there") - 1.0).abs() < 2e-3, "{hidden:?}");
        assert!(jumps.is_empty(), "{jumps:?}");
        assert_eq!(scanned(&PULSE, [0.9, 0.9 + 64e-2], 1e-5).hidden, None);
    }

    #[test]
    fn an_oscillation_with_the_step_as_its_period_is_found() {
        assert!(scanned(&FAST, [0.0, 64e-3], 1e-3).hidden.is_some());
        assert_eq!(scanned(&FAST, [0.0, 64e-4], 1e-4).hidden, None);
    }

    #[test]
    fn jumps_are_found_to_the_last_bit() {
        assert_eq!(found(&JUMP, [0.0, 1.0], 1.0, DEPARTURE), Found::Jump(0.3_f64.next_up()));
        let Scan { hidden, jumps, .. } = scanned(&JUMP, [0.0, 6.37], 0.1);
        assert_eq!((hidden, jumps.as_slice()), (None, &[0.3_f64.next_up()][..]));
    }
}
