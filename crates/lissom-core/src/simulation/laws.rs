//! Resolution of scalar laws by the steps. A pulse between the stages of a step, or an oscillation with the step as its period,
//! appears in no residual and in no error estimate: it would be ignored or misinterpreted without notice. The same applies to
//! jumps that are neither known in advance nor switches.
//!
//! Legend: f law, t time, x its arguments, σ = 0 … 1 step fraction, H cubic through values and slopes at both ends.
//!
//! ```text
//! f(σ) = f(t(σ), x(σ)),      x(σ) cubic on the dense output,      |f - H| ≤ part · max |f|
//! ```
//!
//! The step is bisected until bounds of the values over the range of the arguments, or of the second derivative, exclude features
//! that the samples do not show:
//!
//! ```text
//! |f - line through its ends| ≤ max |f''(σ)| (σ₁ - σ₀)²/8
//! ```
//!
//! A feature that the ends of no interval determine, however short, is a jump. Functions of time are laws without arguments: they
//! are examined before a step, which ends at their jumps; laws of the motion afterwards. The second derivative of a function of time
//! is bounded over many steps at once.

use std::f64::consts::PI;

use lissom_motion::{Rotation, Vector3, Vector6};
use serde::{Deserialize, Serialize};

use crate::integrator::dense;
use crate::kinematics::{Kinematics, Layout, Quantity};
use crate::law::{EVERYTHING, Enclosure, Interval, NARROW_BOUNDS, ScalarLaw, hull};
use crate::registry::{Function, TimeFunction};
use crate::round_off;
use crate::scaling::extent;
use crate::signals::MAX_ARGUMENTS;
use crate::system::{State, System};

/// A law that deviates by more than this fraction of its largest value from the interpolation of a step's ends is not
/// resolved: a sine with 4.4 steps a period.
pub(crate) const DEPARTURE: f64 = 0.01;
/// Maximum number of intervals within one step.
pub(crate) const MAX_INTERVALS: usize = 256;
/// Bisections of an interval after which the remaining feature is a jump.
const MAX_HALVINGS: usize = 30;
/// Law values beyond those at the ends of a planned step by more than this fraction of its magnitude are reported: a sine with five
/// steps a period.
const EXCESS: f64 = 0.2;
/// A jump before this step fraction, in a step that should end at the switch, has been missed.
const NEAR_END: f64 = 0.9;
/// Arguments that depart by more than this fraction of their range from a cubic are not smooth.
const ARGUMENT_DEPARTURE: f64 = 0.05;
/// Number of steps over which the second derivative of a function of time is bounded at once.
const SPAN: f64 = 32.0;
/// Number of future steps that contribute to the magnitude of an unbounded law.
const STEPS_AHEAD: u32 = 64;
/// Angle between the phases of neighbouring numbers of a disturbed motion, that no sum of a few follows a pattern [rad].
const PHASE: f64 = 2.4;
/// Step fractions at which arguments are evaluated.
const SAMPLES: [f64; 4] = [0.0, 0.25, 0.75, 1.0];

/// Coefficients of a polynomial of the step fraction, the constant one first.
type Cubic = [f64; 4];

/// A function of time is a law without arguments.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OfTime<'f>(pub(crate) &'f dyn TimeFunction);

impl ScalarLaw for OfTime<'_> {
    fn value(&self, time: f64, _: &[f64]) -> f64 {
        self.0.value(time)
    }

    fn bounds(&self, [from, to]: Interval, _: &[Interval]) -> Option<Interval> {
        self.0.bounds(from, to)
    }

    fn enclosure(&self, time: &Enclosure, _: &[Enclosure]) -> Option<Enclosure> {
        let [from, to] = time.value;
        // The parameter is the time.
        let second = self.0.curvature(from, to)?;
        Some(Enclosure { value: EVERYTHING, first: EVERYTHING, second })
    }
}

/// A law over an interval of a parameter σ.
#[derive(Clone, Copy)]
pub(crate) struct Course<'l> {
    law: &'l dyn ScalarLaw,
    /// Time at σ = 0, and duration over a unit of σ [s].
    time: [f64; 2],
    arguments: &'l [Cubic],
}

/// Result for an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Found {
    /// No feature except those that its ends determine.
    Nothing,
    /// A feature that the ends of shorter intervals determine.
    Hidden,
    /// A jump, located at the first floating-point number after it.
    Jump(f64),
}

impl<'l> Course<'l> {
    /// A function of time; the parameter is the time [s].
    pub(crate) fn of_time(law: &'l OfTime<'l>) -> Self {
        Self { law, time: [0.0, 1.0], arguments: &[] }
    }

    fn time(&self, share: f64) -> f64 {
        self.time[0] + share * self.time[1]
    }

    /// Value at the parameter σ.
    pub(crate) fn value(&self, share: f64) -> f64 {
        let mut arguments = [0.0; MAX_ARGUMENTS];
        for (argument, cubic) in arguments.iter_mut().zip(self.arguments) {
            *argument = at(cubic, share);
        }
        self.law.value(self.time(share), &arguments[..self.arguments.len()])
    }

    /// Bounds of the value over an interval.
    fn bounds(&self, [from, to]: Interval) -> Option<Interval> {
        let mut arguments = [[0.0; 2]; MAX_ARGUMENTS];
        for (argument, cubic) in arguments.iter_mut().zip(self.arguments) {
            *argument = range(cubic, [from, to]);
        }
        self.law.bounds([self.time(from), self.time(to)], &arguments[..self.arguments.len()])
    }

    /// The largest magnitude for all times and arguments, or that at the ends.
    fn everywhere(&self) -> Magnitude {
        let count = self.arguments.len();
        let bounds = self.law.bounds(EVERYTHING, &[EVERYTHING; MAX_ARGUMENTS][..count]);
        let everywhere = bounds.map_or(0.0, largest);
        let ends = largest([self.value(0.0), self.value(1.0)]);
        Magnitude { value: ends.max(everywhere), is_bounded: everywhere > 0.0 }
    }

    /// The largest magnitude of a law that is not bounded, where the time or one argument takes all values and the others those of
    /// the interval from `from` on. Times of the next steps are included: the values of a law that starts smoothly may be round-off.
    fn magnitude(&self, from: f64) -> f64 {
        let count = self.arguments.len();
        let of =
            |time: Interval, arguments: &[Interval]| self.law.bounds(time, arguments).map_or(0.0, largest);
        let mut arguments = [[0.0; 2]; MAX_ARGUMENTS];
        for (argument, cubic) in arguments.iter_mut().zip(self.arguments) {
            *argument = range(cubic, [from, 1.0]);
        }
        let time = [self.time(0.0), self.time(1.0)];
        let ahead = [time[0], self.time(f64::from(STEPS_AHEAD))];
        let mut magnitude = 0.0_f64;
        for times in [EVERYTHING, ahead] {
            magnitude = magnitude.max(of(times, &arguments[..count]));
        }
        for k in 0..count {
            let own = std::mem::replace(&mut arguments[k], EVERYTHING);
            magnitude = magnitude.max(of(time, &arguments[..count]));
            arguments[k] = own;
        }
        magnitude
    }

    /// Width of the bounds within an interval, if they are available.
    fn width(&self, [from, to]: Interval) -> Option<f64> {
        let inside = round_off::STEP_END * (to - from);
        self.bounds([from + inside, to - inside]).map(|[low, high]| high - low)
    }

    /// Largest distance within an interval from the straight line between its ends, if a bound is known.
    fn bend(&self, [from, to]: Interval) -> Option<f64> {
        if !self.law.has_enclosure() {
            return None;
        }
        let inside = round_off::STEP_END * (to - from);
        let [from, to] = [from + inside, to - inside];
        let mut arguments = [Enclosure::of_constant([0.0; 2]); MAX_ARGUMENTS];
        for (argument, cubic) in arguments.iter_mut().zip(self.arguments) {
            *argument = enclosure(cubic, [from, to]);
        }
        let time = Enclosure::of_line([self.time(from), self.time(to)], self.time[1]);
        let enclosure = self.law.enclosure(&time, &arguments[..self.arguments.len()])?;
        Some(bend(enclosure.second, to - from))
    }

    /// Whether values within an interval may deviate from those at its ends by more than `least`.
    fn may_hide(&self, within: Interval, least: f64) -> bool {
        let is_wide = |width: f64| width > least;
        self.width(within).is_some_and(is_wide) && self.bend(within).is_none_or(is_wide)
    }

    /// Whether values within an interval are beyond those at its ends by more than [`EXCESS`] of the `magnitude`, as far as bounds
    /// and samples show.
    fn exceeds_its_ends(&self, whole: Interval, magnitude: f64) -> bool {
        let inside = round_off::STEP_END * (whole[1] - whole[0]);
        let [low, high] = hull(&[whole[0] + inside, whole[1] - inside].map(|share| self.value(share)));
        let is_beyond = |value: f64| value < low - EXCESS * magnitude || value > high + EXCESS * magnitude;
        let is_found = |[from, to]: Interval| {
            let value = self.value(0.5 * (from + to));
            value.is_finite() && is_beyond(value)
        };
        let may_be = |within: Interval| {
            let [from, to] = within.map(|share| share.clamp(whole[0] + inside, whole[1] - inside));
            self.bounds([from, to]).is_some_and(|bounds| bounds.into_iter().any(is_beyond))
                && self.may_hide(within, NARROW_BOUNDS * magnitude)
        };
        search(whole, is_found, may_be)
    }

    /// Features within an interval that the values and slopes at its ends do not determine to `part` of its `magnitude`.
    pub(crate) fn found(&self, whole: Interval, magnitude: f64, part: f64) -> Found {
        let is_flat = || self.width(whole).is_some_and(|width| width <= part * magnitude);
        if magnitude == 0.0 || is_flat() {
            return Found::Nothing;
        }
        let expected = self.interpolated(whole);
        let is_found = |within: Interval| {
            // The middle of a half is a quarter of the interval before it.
            let shares: &[f64] = if within == whole { &[0.25, 0.5, 0.75] } else { &[0.25, 0.75] };
            self.departure(&expected, within, shares) > part * magnitude
        };
        // A law with kinks, for example of a contact, may act between two samples only.
        let least = if self.law.is_smooth() { NARROW_BOUNDS } else { part } * magnitude;
        let may_be = |within: Interval| self.may_hide(within, least);
        if search(whole, is_found, may_be) {
            self.jump(whole, magnitude).map_or(Found::Hidden, Found::Jump)
        } else {
            Found::Nothing
        }
    }

    /// First floating-point number after a jump: a feature that the ends of no interval determine, however short.
    fn jump(&self, [mut from, mut to]: Interval, magnitude: f64) -> Option<f64> {
        for _ in 0..MAX_HALVINGS {
            let middle = 0.5 * (from + to);
            let is_resolved = |half: Interval| {
                self.departure(&self.interpolated(half), half, &[0.25, 0.5, 0.75]) <= DEPARTURE * magnitude
            };
            if !is_resolved([from, middle]) {
                to = middle;
            } else if !is_resolved([middle, to]) {
                from = middle;
            } else {
                return None;
            }
        }
        while from.next_up() < to {
            let middle = 0.5 * (from + to);
            if (self.value(middle) - self.value(from)).abs() > (self.value(to) - self.value(middle)).abs() {
                to = middle;
            } else {
                from = middle;
            }
        }
        Some(to)
    }

    /// The interval, and the cubic over it through values and slopes at its ends.
    fn interpolated(&self, [from, to]: Interval) -> (Interval, Cubic) {
        let inside = round_off::STEP_END * (to - from);
        let [from, to] = [from + inside, to - inside];
        // The slope of the parabola through three values, times the length.
        let end = |at: f64, towards: f64| {
            let [value, near, next] = [0.0, round_off::SLOPE_OFFSET, 2.0 * round_off::SLOPE_OFFSET]
                .map(|share| self.value(at + towards * share * (to - from)));
            (value, towards * (4.0 * near - 3.0 * value - next) / (2.0 * round_off::SLOPE_OFFSET))
        };
        let ((start, first), (end, last)) = (end(from, 1.0), end(to, -1.0));
        let change = end - start;
        ([from, to], [start, first, 3.0 * change - 2.0 * first - last, first + last - 2.0 * change])
    }

    /// Largest deviation from a cubic at these fractions of an interval.
    fn departure(
        &self,
        ([from, to], cubic): &(Interval, Cubic),
        [start, end]: Interval,
        shares: &[f64],
    ) -> f64 {
        let departure = |share: &f64| {
            let parameter = start + share * (end - start);
            let expected = at(cubic, ((parameter - from) / (to - from)).clamp(0.0, 1.0));
            (self.value(parameter) - expected).abs()
        };
        // Values that are not finite are reported elsewhere.
        shares.iter().map(departure).fold(0.0, f64::max)
    }

    /// Longest interval from `from` that is resolved except for jumps: `size`, or less by halving.
    pub(crate) fn longest(&self, [from, mut size]: [f64; 2], magnitude: f64, part: f64) -> f64 {
        for _ in 0..MAX_HALVINGS {
            if self.found([from, from + size], magnitude, part) != Found::Hidden {
                break;
            }
            size *= 0.5;
        }
        size
    }
}

/// Whether `is_found` is true in a part of an interval, which is bisected where `may_be` is true.
fn search(whole: Interval, is_found: impl Fn(Interval) -> bool, may_be: impl Fn(Interval) -> bool) -> bool {
    // Capacity for the pending halves of an interval that is bisected MAX_HALVINGS times.
    let mut open = [whole; MAX_HALVINGS + 2];
    let (mut last, mut looks) = (1, 0);
    while last > 0 {
        last -= 1;
        looks += 1;
        let [from, to] = open[last];
        if is_found([from, to]) {
            return true;
        }
        if looks < MAX_INTERVALS && last + 2 <= open.len() && may_be([from, to]) {
            let middle = 0.5 * (from + to);
            (open[last], open[last + 1]) = ([middle, to], [from, middle]);
            last += 2;
        }
    }
    false
}

/// Magnitudes of all laws, from the steps so far.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Magnitudes {
    functions: Vec<FunctionMagnitude>,
    laws: Vec<Magnitude>,
}

impl Magnitudes {
    /// Gives the first law of each group the largest magnitude of all at a state.
    fn share(&mut self, system: &System, at: &State, leader_of: impl Fn(usize) -> usize) {
        let mut index = 0;
        system.laws(&at.kinematics, &mut |law, values| {
            if let Some(leader) = self.laws.get_mut(leader_of(index)).filter(|_| leader_of(index) != index) {
                let value = largest([law.value(at.kinematics.time, values); 2]);
                leader.value = leader.value.max(value);
            }
            index += 1;
        });
    }
}

/// Largest magnitude so far, or over all arguments for bounded laws.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Magnitude {
    value: f64,
    is_bounded: bool,
}

/// Magnitude and curvature of a function of time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct FunctionMagnitude {
    magnitude: f64,
    /// Interval over which its second derivative is bounded [s], and the bound of its magnitude; infinite if unknown.
    span: Interval,
    curvature: f64,
}

/// Resolution checks of the scalar laws of a system.
pub(crate) struct Laws {
    pub(crate) magnitudes: Magnitudes,
    between: State,
    /// Arguments of all laws, one sample after the other, and at the middle of the step.
    arguments: Vec<f64>,
    middle: Vec<f64>,
    cubics: Vec<Cubic>,
    /// For each law of a signal or an element the index of the first one of its group, as its own where it has none.
    leaders: Vec<usize>,
    /// Length of the model [m].
    length: f64,
    /// Changes of the values of all laws by the round-off of the motion.
    noise: Vec<f64>,
}

impl Laws {
    /// Initial magnitudes, for steps of up to `longest` [s]. Unbounded functions of time are evaluated over the first steps: the
    /// first values of a function that starts smoothly may be round-off.
    pub(crate) fn new(system: &System, start: &State, longest: f64) -> Self {
        let now = start.kinematics.time;
        let magnitude = |function: &Function| {
            if function.is_constant() {
                return 0.0;
            }
            let everywhere = function.bounds(now, f64::INFINITY).map_or(0.0, largest);
            let ahead = (0..=STEPS_AHEAD).map(|k| function.value(now + f64::from(k) * longest));
            if everywhere > 0.0 {
                everywhere
            } else {
                ahead.map(|value| largest([value; 2])).fold(0.0, f64::max)
            }
        };
        let functions = system.functions.iter().map(|(_, function)| FunctionMagnitude {
            magnitude: magnitude(function),
            span: [f64::INFINITY; 2],
            curvature: f64::INFINITY,
        });
        let magnitudes = Magnitudes { functions: functions.collect(), laws: Vec::new() };
        let (between, arguments, middle, cubics) = (start.clone(), Vec::new(), Vec::new(), Vec::new());
        let first = system.signals().names_of_laws().len();
        let of_elements = system.leaders_of_laws(&start.kinematics).into_iter().map(|leader| first + leader);
        let leaders = (0..first).chain(of_elements).collect();
        let (length, noise) = (extent(system, &start.kinematics), Vec::new());
        Self { magnitudes, between, arguments, middle, cubics, leaders, length, noise }
    }

    /// The magnitude of a function of time, including its values at the ends of a step [s].
    pub(crate) fn magnitude_of_function(&mut self, index: usize, function: &Function, ends: Interval) -> f64 {
        let magnitude = &mut self.magnitudes.functions[index].magnitude;
        *magnitude = magnitude.max(largest(ends.map(|time| function.value(time))));
        *magnitude
    }

    /// Whether a function of time is a straight line over a step [s], to `part` of its magnitude.
    pub(crate) fn is_straight(
        &mut self,
        index: usize,
        function: &Function,
        step @ [from, to]: Interval,
        part: f64,
    ) -> bool {
        let bound = |[from, to]: Interval| {
            function.curvature(from, to).map_or(f64::INFINITY, |bounds| bend(bounds, 1.0))
        };
        let known = self.magnitudes.functions[index];
        if !(known.span[0] <= from && to <= known.span[1]) {
            let span = [from, from + SPAN * (to - from)];
            self.magnitude_of_function(index, function, span);
            let known = &mut self.magnitudes.functions[index];
            (known.span, known.curvature) = (span, bound(span));
        }
        let FunctionMagnitude { magnitude, curvature, .. } = self.magnitudes.functions[index];
        let is_small = |bend: f64| bend * (to - from) * (to - from) <= part * magnitude;
        is_small(curvature) || is_small(bound(step))
    }

    /// Longest fraction of a solved step whose ends determine all laws of the motion: 1, or less by halving, or up to a jump. With
    /// `has_switched`, a jump at the start of the step is attributed to the switch there.
    pub(crate) fn longest_resolved(
        &mut self,
        system: &System,
        step: (&State, &State),
        part: f64,
        has_switched: bool,
    ) -> f64 {
        let begin = if has_switched { round_off::SLOPE_OFFSET } else { 0.0 };
        let find = |course: &Course<'_>, magnitude| {
            let longest = match course.found([begin, 1.0], magnitude, part) {
                Found::Hidden => begin + course.longest([begin, 0.5], magnitude, part),
                // A switch was missed: its detection is likely if the next attempt ends shortly after the jump.
                Found::Jump(share) if share < NEAR_END && !course.law.is_smooth() => share / NEAR_END,
                Found::Nothing | Found::Jump(_) => 1.0,
            };
            (longest < 1.0).then_some(longest)
        };
        self.examine(system, step, part, find).map_or(1.0, |(_, longest)| longest)
    }

    /// The index of a law of the motion that a solved step of planned size does not resolve: a smooth one that its ends do not
    /// determine, or another one with values far beyond those at the ends.
    pub(crate) fn unresolved(&mut self, system: &System, step: (&State, &State)) -> Option<usize> {
        let find = |course: &Course<'_>, magnitude| {
            let is_found = if course.law.is_smooth() {
                course.found([0.0, 1.0], magnitude, DEPARTURE) == Found::Hidden
            } else {
                // A kink or a jump alone is an error of the order of a planned step.
                course.exceeds_its_ends([0.0, 1.0], magnitude)
            };
            is_found.then_some(0.0)
        };
        self.examine(system, step, DEPARTURE, find).map(|(index, _)| index)
    }

    /// Fits the cubics of all arguments of laws of the motion over a solved step. Returns whether there are any laws.
    fn sample(&mut self, system: &System, (from, to): (&State, &State)) -> bool {
        self.arguments.clear();
        self.cubics.clear();
        let mut laws = 0;
        for share in SAMPLES {
            let arguments = &mut self.arguments;
            let mut gather = |_: &dyn ScalarLaw, values: &[f64]| {
                laws += 1;
                arguments.extend_from_slice(values);
            };
            if share == 0.0 || share == 1.0 {
                system.laws(if share == 0.0 { &from.kinematics } else { &to.kinematics }, &mut gather);
            } else {
                dense::at_share(from, to, share, &mut self.between);
                system.laws(&self.between.kinematics, &mut gather);
            }
            if arguments.is_empty() {
                // There may be laws that depend on time only, such as signals.
                return laws > 0;
            }
        }
        let count = self.arguments.len() / SAMPLES.len();
        for k in 0..count {
            let values: [f64; SAMPLES.len()] =
                std::array::from_fn(|sample| self.arguments[sample * count + k]);
            self.cubics.push(through(values));
        }
        true
    }

    /// The law of the motion with the smallest step fraction that `find` returns for its course and its magnitude, with its index.
    /// What the round-off of the motion explains to this `part` is no feature. The arguments of such a law are verified: if they jump,
    /// such as angles at half a turn, cubics do not represent them, and the law is skipped.
    fn examine(
        &mut self,
        system: &System,
        (from, to): (&State, &State),
        part: f64,
        find: impl Fn(&Course<'_>, f64) -> Option<f64>,
    ) -> Option<(usize, f64)> {
        if !self.sample(system, (from, to)) {
            return None;
        }
        let Self { magnitudes, between, arguments, middle, cubics, leaders, noise, length } = self;
        let leader_of = |index: usize| leaders.get(index).copied().unwrap_or(index);
        let time = [from.kinematics.time, to.kinematics.time - from.kinematics.time];
        let (mut next, mut index, mut first) = (0, 0, None);
        middle.clear();
        noise.clear();
        if magnitudes.laws.is_empty() {
            let mut next = 0;
            system.laws(&to.kinematics, &mut |law, values| {
                let own = next..next + values.len();
                next = own.end;
                magnitudes.laws.push(Course { law, time, arguments: &cubics[own] }.everywhere());
            });
        }
        if leaders.iter().enumerate().any(|(index, leader)| index != *leader) {
            magnitudes.share(system, to, leader_of);
        }
        system.laws(&to.kinematics, &mut |law, values| {
            let own = next..next + values.len();
            let course = Course { law, time, arguments: &cubics[own.clone()] };
            (next, index) = (own.end, index + 1);
            let of_group = magnitudes.laws[leader_of(index - 1)].value;
            let magnitude = &mut magnitudes.laws[index - 1];
            magnitude.value = magnitude.value.max(of_group);
            let is_bounded = magnitude.is_bounded;
            if !is_bounded && !law.is_smooth() && course.bounds([0.0, 1.0]) == Some([0.0; 2]) {
                // Solids that stay apart: the force is zero over the whole step.
                return;
            }
            if !is_bounded {
                magnitude.value = magnitude.value.max(largest([course.value(1.0); 2]));
            }
            // Solids in free flight: over the way the bounds of the force would be those of solids within each other.
            let is_flight =
                !is_bounded && !law.is_smooth() && [0.0, 1.0].iter().all(|&end| course.value(end) == 0.0);
            let of_flight = if is_flight { course.magnitude(1.0) } else { 0.0 };
            let mut found = None;
            if of_flight > 0.0 {
                found = find(&course, of_flight);
            } else if magnitude.value > 0.0 {
                found = find(&course, magnitude.value);
            }
            if !is_bounded && of_flight == 0.0 && (found.is_some() || magnitude.value == 0.0) {
                magnitude.value = magnitude.value.max(course.magnitude(0.0));
                found = find(&course, magnitude.value);
            }
            let Some(mut share) = found else { return };
            if noise.is_empty() {
                add_noise(system, [from, to], (*length, time[1]), between, [noise, arguments]);
            }
            let least = noise[index - 1] / part;
            if least > magnitude.value.max(of_flight) {
                let Some(found) = find(&course, least) else { return };
                share = found;
            }
            if middle.is_empty() {
                dense::at_share(from, to, 0.5, between);
                system.laws(&between.kinematics, &mut |_, values| middle.extend_from_slice(values));
            }
            let are_smooth = cubics[own.clone()]
                .iter()
                .zip(&middle[own])
                .all(|(cubic, value)| passes_through(cubic, *value));
            if are_smooth && first.is_none_or(|(_, known)| share < known) {
                first = Some((index - 1, share));
            }
        });
        first
    }
}

/// Changes of the values of all laws at two states if their motions change by their round-off, for a model of this `length` [m] and a step
/// of `size` [s]. At rest the values of a law, such as the flow between equal pressures, are nothing else.
fn add_noise(
    system: &System,
    ends: [&State; 2],
    (length, size): (f64, f64),
    moved: &mut State,
    [noise, exact]: [&mut Vec<f64>; 2],
) {
    let values = |at: &Kinematics, visit: &mut dyn FnMut(usize, f64)| {
        let mut index = 0;
        system.laws(at, &mut |law, arguments| {
            visit(index, law.value(at.time, arguments));
            index += 1;
        });
    };
    for end in ends {
        exact.clear();
        values(&end.kinematics, &mut |_, value| exact.push(value));
        noise.resize(exact.len(), 0.0);
        for phase in [0.0, 0.5 * PI] {
            moved.clone_from(end);
            disturb(system.layout(), &mut moved.kinematics, (length, size), phase);
            values(&moved.kinematics, &mut |index, value| {
                let change = (value - exact[index]).abs();
                noise[index] += if change.is_finite() { change } else { 0.0 };
            });
        }
    }
}

/// Changes every number of a motion by as much as a step does not determine, so that one of two phases that differ by a quarter of a turn
/// is not small.
fn disturb(layout: &Layout, at: &mut Kinematics, (length, size): (f64, f64), mut phase: f64) {
    let mut by = |scale: f64| {
        phase += PHASE;
        round_off::INCREMENT * scale * phase.sin()
    };
    for node in at.nodes.iter_mut().skip(1) {
        let far = length.max(node.frame.position.amax());
        node.frame.position += Vector3::from_fn(|_, _| by(far));
        node.frame.rotation = node.frame.rotation * Rotation::exponential(&Vector3::from_fn(|_, _| by(1.0)));
        node.twist += Vector6::from_fn(|k, _| by(if k < 3 { far } else { 1.0 } / size));
    }
    let mut states = layout.states.iter().peekable();
    for (coordinate, motion) in layout.coordinates().zip(&mut at.coordinates) {
        let scale = match states.next_if(|(state, _)| *state == coordinate) {
            Some(&(_, magnitude)) => magnitude,
            None if layout.coordinate_quantity(coordinate) == Quantity::Length => length,
            None => 1.0,
        };
        let scale = scale.max(motion.value.abs());
        motion.value += by(scale);
        motion.rate += by(scale / size);
    }
}

/// Whether a cubic has approximately this value in its middle.
fn passes_through(cubic: &Cubic, value: f64) -> bool {
    let [low, high] = range(cubic, [0.0, 1.0]);
    let allowed = ARGUMENT_DEPARTURE * (high - low) + round_off::FUNCTION * high.abs().max(low.abs());
    (at(cubic, 0.5) - value).abs() <= allowed
}

/// The largest magnitude within an interval; zero if it is infinite.
fn largest(interval: Interval) -> f64 {
    let largest = interval[0].abs().max(interval[1].abs());
    if largest.is_finite() { largest } else { 0.0 }
}

fn at([a, b, c, d]: &Cubic, share: f64) -> f64 {
    a + share * (b + share * (c + share * d))
}

/// Range of a cubic over an interval: that of its Bézier points.
fn range(cubic: &Cubic, [from, to]: Interval) -> Interval {
    let [_, b, c, d] = cubic;
    let third = |x: f64| (b + x * (2.0 * c + x * 3.0 * d)) * (to - from) / 3.0;
    let (start, end) = (at(cubic, from), at(cubic, to));
    hull(&[start, start + third(from), end - third(to), end])
}

/// Bounds of a cubic and of its derivatives over an interval.
fn enclosure(cubic: &Cubic, [from, to]: Interval) -> Enclosure {
    let [_, b, c, d] = cubic;
    let slope = |x: f64| b + x * (2.0 * c + x * 3.0 * d);
    let bend = |x: f64| 2.0 * c + 6.0 * d * x;
    let (start, end) = (slope(from), slope(to));
    Enclosure {
        value: range(cubic, [from, to]),
        // The Bézier points of a parabola.
        first: hull(&[start, start + 0.5 * (to - from) * bend(from), end]),
        second: hull(&[bend(from), bend(to)]),
    }
}

/// Largest distance of a function from the straight line between its ends over a length, given bounds of its second derivative.
fn bend(second: Interval, length: f64) -> f64 {
    second[0].abs().max(second[1].abs()) * length * length / 8.0
}

/// The cubic through values at the [`SAMPLES`].
fn through(values: [f64; 4]) -> Cubic {
    let first: [f64; 3] =
        std::array::from_fn(|k| (values[k + 1] - values[k]) / (SAMPLES[k + 1] - SAMPLES[k]));
    let second: [f64; 2] = std::array::from_fn(|k| (first[k + 1] - first[k]) / (SAMPLES[k + 2] - SAMPLES[k]));
    let third = (second[1] - second[0]) / (SAMPLES[3] - SAMPLES[0]);
    let [x, y] = [SAMPLES[1], SAMPLES[2]];
    [values[0], first[0] - x * second[0] + x * y * third, second[0] - (x + y) * third, third]
}

#[cfg(test)]
#[path = "../../tests/unit/simulation/laws.rs"]
mod tests;
