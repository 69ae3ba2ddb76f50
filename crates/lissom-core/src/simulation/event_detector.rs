//! Event detection: monitors the switching functions of events, and of forces with kinks or jumps, for changes of sign within a
//! step. A step across such an instant is repeated and ends there.
//!
//! ```text
//! g(t*) = 0:    t* on the cubics between the ends of the step by bisection, then
//!               t* ← t* - g/ġ with the step to t* solved again, to 1e-10 of the step
//! ```
//!
//! A function that jumps, such as sign(x), has no slope there. Bisection on the cubics of the step to t*, extrapolated
//! beyond its end, then checks whether the jump is at its end.
//!
//! A root at the end of a step shows no change of sign there, or one that is lost in round-off. It is found where the tangent at
//! the end crosses zero, if the step started at a clearly nonzero value. The next step could detect it only after its first
//! millionth.
//!
//! Corners that meet a plane together cross zero at one instant, up to round-off. Functions that would cross within the first millionth
//! of the step after a root cross at that root: with the branches of a few corners the motion beyond it would be a rotation. Their values
//! have no sign up to what remained to zero, until they are beyond it.
//!
//! Between two steps each function has a branch, the sign 1 or -1. Functions and forces are continued from their branch over the whole
//! step, so that it is smooth; results beyond the root are not used. At the root the branch changes regardless of round-off, so that
//! the same root is not found again.

use serde::{Deserialize, Serialize};

use crate::integrator::dense::DenseOutput;
use crate::kinematics::{Kinematics, Switch};
use crate::law::hull;
use crate::round_off;
use crate::signals::event::{Event, Occurrence};
use crate::system::{State, System};

/// Step fractions at which signs are checked. Functions that cross zero and return between two of them are detected from the
/// polynomial through their values there.
const INSTANTS: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];
/// Number of intervals of a step in which the minimum of this polynomial is searched for.
const GRID: usize = 32;
/// Values smaller than this fraction of the largest so far have no sign.
const NOISE: f64 = 1e-9;
/// Maximum number of repeated steps for one root: three are usual.
const MAX_REFINEMENTS: usize = 30;
/// A refinement after which more than this fraction of the function's value remains beyond the root is slow.
const SLOW_REFINEMENT: f64 = 0.1;
/// Changes of sign within a longest step above which the motion slides along the switching surface.
const MAX_CROSSINGS: usize = 1000;

/// Maximum number of branch changes at the start of one step: beyond it, the motion slides along a switching surface.
const MAX_SWITCHES_AT_START: usize = 8;

/// State of the switching functions between two steps.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct EventState {
    /// Branches: 1 above zero, -1 below, the level of laws with levels, 0 if not yet known.
    sides: Vec<f64>,
    /// The branches before the last change.
    before: Vec<f64>,
    /// Largest magnitude so far.
    largest: Vec<f64>,
    /// Magnitude before zero of functions whose branch changed so shortly before their root, until they are beyond it.
    remaining: Vec<f64>,
    /// Events that happened.
    pub(crate) occurrences: Vec<Occurrence>,
    /// The event that ends the run at the state, if one does.
    pub(crate) stopped_by: Option<usize>,
    /// Whether a force has switched at the state: the motion may then be much faster than before.
    pub(crate) has_switched: bool,
    /// Number of steps that ended at each kink or jump of a force, in the order of the switches.
    ended: Vec<usize>,
    /// Number of these steps from which they are examined for laws that end many.
    examined_from: usize,
    /// Start of the time window in which crossings are counted [s], and their number.
    recent: (f64, usize),
}

impl EventState {
    /// Whether twice as many steps, and at least `first`, have ended at kinks and jumps as at the last time this was so.
    pub(crate) fn is_examination_due(&mut self, first: usize) -> bool {
        let ended: usize = self.ended.iter().sum();
        let is_due = ended >= self.examined_from.max(first);
        if is_due {
            self.examined_from = 2 * ended;
        }
        is_due
    }

    /// Number of steps that ended at each switch; those at which none ended may be missing.
    pub(crate) fn ended(&self) -> &[usize] {
        &self.ended
    }

    /// Sets the branches of these functions above zero.
    pub(crate) fn rise(&mut self, indices: impl Iterator<Item = usize>) {
        for index in indices {
            if let Some(side) = self.sides.get_mut(index) {
                *side = 1.0;
            }
        }
    }
}

/// An instant within a step at which switching functions cross zero.
#[derive(Clone, Debug)]
pub(crate) struct LocatedRoot {
    /// Size of the step that ends there [s]; zero if the step begins there.
    pub(crate) size: f64,
    /// Size of the step in which the root was found [s].
    whole: f64,
    /// Indices of the functions that cross zero.
    pub(crate) indices: Vec<usize>,
    /// Whether the functions jump there.
    is_jump: bool,
    refinements: usize,
    /// Largest size whose step ends before the root, and smallest one whose step ends beyond it [s].
    bracket: [f64; 2],
    /// Magnitude of the function at the end of the last step that was tried.
    remaining: f64,
}

impl LocatedRoot {
    /// In a step of `whole` [s], at this fraction of it.
    fn new(share: f64, whole: f64, indices: Vec<usize>, is_jump: bool) -> Self {
        let (size, bracket) = (share * whole, [0.0, whole]);
        Self { size, whole, indices, is_jump, refinements: 0, bracket, remaining: f64::INFINITY }
    }

    /// Size of the next step to try after one that ended at `value` of the function, `is_beyond` the root, and proposes `size` [s].
    /// A force that begins at the root may stop the motion just beyond it, where the slope of the function does not determine the root.
    fn bracketed(&mut self, size: f64, value: f64, is_beyond: bool) -> f64 {
        let [low, high] = &mut self.bracket;
        if is_beyond {
            *high = high.min(self.size);
        } else {
            *low = low.max(self.size);
        }
        let last = std::mem::replace(&mut self.remaining, value.abs());
        let is_slow = is_beyond && value.abs() > SLOW_REFINEMENT * last;
        let is_within = size >= *low && size <= *high;
        if *low < *high && (is_slow || !is_within) { 0.5 * (*low + *high) } else { size }
    }
}

/// The switching functions of one simulation: those of events, then those of signals, then those of elements.
pub(crate) struct EventDetector {
    pub(crate) known: EventState,
    /// Whether kinks and jumps of forces are monitored in addition to events.
    has_switches: bool,
    /// Number of branch changes at the start of the present step.
    switched_at_start: usize,
    /// For each value the index of the first one in its group. The first one stores the group's largest magnitude.
    leaders: Vec<usize>,
    values: Vec<Switch>,
    /// The values at each of the [`INSTANTS`].
    samples: [Vec<Switch>; INSTANTS.len()],
    /// Functions that may cross zero within the step: only these are evaluated at further step fractions.
    are_near: Vec<bool>,
    /// Step fractions at which signs are checked, each with the index of its sample if there is one.
    instants: Vec<(f64, Option<usize>)>,
    between: State,
}

impl EventDetector {
    /// Detector at the start of a motion; kinks and jumps of forces are monitored if `has_switches`.
    pub(crate) fn new(system: &System, start: &State, has_switches: bool) -> Self {
        let mut detector = Self::of_nothing(start);
        detector.has_switches = has_switches;
        values_at(system, start, has_switches, &mut detector.values);
        let of_elements = if has_switches { system.leaders_of_switches() } else { Vec::new() };
        let first = detector.values.len() - of_elements.len();
        detector.leaders = (0..first).chain(of_elements.into_iter().map(|leader| first + leader)).collect();
        detector.known.sides = vec![0.0; detector.values.len()];
        detector.known.before = vec![0.0; detector.values.len()];
        detector.known.largest = vec![0.0; detector.values.len()];
        // One that stays at zero, as the displacement of a joint that starts at its stop and neither presses nor leaves it, would otherwise
        // have the signs of its round-off.
        detector.known.largest[first..].fill(round_off::INCREMENT / NOISE);
        detector.known.remaining = vec![0.0; detector.values.len()];
        detector.known.recent.0 = start.kinematics.time;
        detector.note(0..0, &[]);
        detector
    }

    /// Empty detector, for studies without motion.
    pub(crate) fn of_nothing(start: &State) -> Self {
        Self {
            known: EventState::default(),
            has_switches: false,
            switched_at_start: 0,
            leaders: Vec::new(),
            values: Vec::new(),
            samples: Default::default(),
            are_near: Vec::new(),
            instants: Vec::new(),
            between: start.clone(),
        }
    }

    /// Whether there are switching functions.
    pub(crate) fn is_empty(&self) -> bool {
        self.known.sides.is_empty()
    }

    /// Indices of the switching functions of forces.
    fn of_switches(&self, system: &System, at: &Kinematics) -> std::ops::Range<usize> {
        let events = system.signals().events().len();
        let count = if self.has_switches { at.held.len() - system.signals().first_side() } else { 0 };
        events..events + count
    }

    /// Whether all switches are frozen on their known branches.
    pub(crate) fn has_frozen_switches(&self, system: &System, at: &Kinematics) -> bool {
        let sides = self.known.sides.get(self.of_switches(system, at)).unwrap_or_default();
        let held = &at.held[system.signals().first_side()..];
        sides == held
    }

    /// Freezes all switches on their known branches.
    pub(crate) fn freeze_switches(&self, system: &System, at: &mut Kinematics) {
        let sides = self.known.sides.get(self.of_switches(system, at)).unwrap_or_default();
        let held = &mut at.held[system.signals().first_side()..];
        held.iter_mut().zip(sides).for_each(|(held, side)| *held = *side);
    }

    /// Records the branches of all values that have none yet, or are neither in `kept` nor in `but`.
    fn note(&mut self, kept: std::ops::Range<usize>, but: &[usize]) {
        let known = &mut self.known;
        for (&leader, value) in self.leaders.iter().zip(&self.values) {
            known.largest[leader] = known.largest[leader].max(value.number.abs());
        }
        for (k, value) in self.values.iter().enumerate() {
            known.largest[k] = known.largest[self.leaders[k]];
            let is_free = known.sides[k] == 0.0 || !(kept.contains(&k) || but.contains(&k));
            if is_free && value.number.abs() > NOISE * known.largest[k] {
                known.sides[k] = value.side();
            }
            if known.sides[k].signum() * value.number > 0.0 {
                known.remaining[k] = 0.0;
            }
        }
    }

    /// Magnitude up to which value `k` has no sign.
    fn noise(&self, k: usize) -> f64 {
        self.known.remaining[k].max(NOISE * self.known.largest[k])
    }

    /// Whether value `k` has crossed zero in a monitored direction.
    fn has_passed(&self, events: &[Event], k: usize) -> bool {
        let (value, side) = (self.values[k].number, self.known.sides[k]);
        value.abs() > self.noise(k)
            && side != 0.0
            && (value > 0.0) != (side > 0.0)
            && events.get(k).is_none_or(|event| event.direction.allows(value > 0.0))
    }

    /// Changes the branch of value `k` to that beyond its zero, at a state where its value is `number`.
    fn cross(&mut self, k: usize, number: f64) {
        let side = self.known.sides[k];
        self.known.remaining[k] = (side.signum() * number).max(0.0);
        self.known.before[k] = std::mem::replace(&mut self.known.sides[k], self.values[k].beyond(side));
    }

    fn any_has_passed(&self, events: &[Event]) -> bool {
        (0..self.values.len()).any(|k| self.has_passed(events, k))
    }

    /// Indices of the values that have crossed zero.
    fn passed(&self, events: &[Event]) -> Vec<usize> {
        (0..self.values.len()).filter(|&k| self.has_passed(events, k)).collect()
    }

    /// Evaluates all functions at a step fraction.
    fn at(&mut self, system: &System, step: DenseOutput<'_>, share: f64) {
        let state = state_at(step, share, &mut self.between);
        values_at(system, state, self.has_switches, &mut self.values);
    }

    /// Evaluates the functions that are near zero; others keep their values.
    fn near_at(&mut self, system: &System, step: DenseOutput<'_>, share: f64) {
        let state = state_at(step, share, &mut self.between);
        update_values_at(system, state, (self.has_switches, &self.are_near), &mut self.values);
    }

    /// Declares that only one function is near zero.
    fn follow_only(&mut self, which: usize) {
        self.are_near.clear();
        self.are_near.resize(self.values.len(), false);
        self.are_near[which] = true;
    }

    /// First instant of the step of `size` [s] at which a function crosses zero.
    pub(crate) fn crossing(
        &mut self,
        system: &System,
        step: DenseOutput<'_>,
        size: f64,
    ) -> Option<LocatedRoot> {
        let events = system.signals().events();
        for (index, instant) in INSTANTS.into_iter().enumerate() {
            self.at(system, step, instant);
            self.samples[index].clone_from(&self.values);
        }
        let mut before = 0.0;
        self.find_instants(events);
        for index in 0..self.instants.len() {
            let (instant, sample) = self.instants[index];
            self.values.clone_from(&self.samples[sample.unwrap_or(0)]);
            if sample.is_none() {
                self.near_at(system, step, instant);
            }
            if !self.any_has_passed(events) {
                before = instant;
                continue;
            }
            let mut after = instant;
            while after - before > 0.5 * round_off::ROOT {
                let middle = 0.5 * (before + after);
                self.near_at(system, step, middle);
                if self.any_has_passed(events) { after = middle } else { before = middle }
            }
            self.near_at(system, step, after);
            let mut indices = self.passed(events);
            let are_switches = indices.iter().all(|k| *k >= events.len());
            let share = match after {
                // The step begins at the switch: a step of zero length is not needed.
                after if after < round_off::STEP_END && are_switches => {
                    self.near_at(system, step, round_off::STEP_END);
                    indices.extend(self.passed(events).into_iter().filter(|k| *k >= events.len()));
                    indices.sort_unstable();
                    indices.dedup();
                    0.0
                }
                after if after > 1.0 - round_off::ROOT => 1.0,
                after => after.max(round_off::STEP_END),
            };
            // A continuous function is still within its noise here.
            let is_jump =
                self.values[indices[0]].number.abs() > round_off::STEP_END * self.known.largest[indices[0]];
            return Some(LocatedRoot::new(share, size, indices, is_jump));
        }
        self.root_at_end(system, step, size)
    }

    /// Stores the step fractions at which signs are checked: the samples after the start, and the minimum of the polynomial
    /// through the samples of a function, if the polynomial crosses zero there and no sample does. Declares which functions are near
    /// zero: of many possible contacts the root of one does not concern the others.
    fn find_instants(&mut self, events: &[Event]) {
        let mut instants = std::mem::take(&mut self.instants);
        self.are_near.clear();
        self.are_near.resize(self.values.len(), false);
        instants.clear();
        instants.extend(INSTANTS.into_iter().enumerate().skip(1).map(|(index, at)| (at, Some(index))));
        for k in 0..self.values.len() {
            let side = self.known.sides[k];
            if side == 0.0 || events.get(k).is_some_and(|event| !event.direction.allows(side < 0.0)) {
                continue;
            }
            let samples: [f64; INSTANTS.len()] =
                std::array::from_fn(|index| side.signum() * self.samples[index][k].number);
            let [low, high] = hull(&samples);
            // Otherwise the function would have to change by more between two samples than over the whole step.
            self.are_near[k] = low <= high - low || low.is_nan() || high.is_nan();
            if low < -NOISE * self.known.largest[k] || !self.are_near[k] {
                continue;
            }
            let polynomial = |cell: usize| quartic(&samples, cell as f64 / GRID as f64);
            let lowest = (1..GRID).min_by(|&a, &b| polynomial(a).total_cmp(&polynomial(b)));
            if let Some(cell) = lowest.filter(|&cell| polynomial(cell) < 0.0) {
                instants.push((cell as f64 / GRID as f64, None));
            }
        }
        instants.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        self.instants = instants;
    }

    /// Event whose root is at the end of the step of `size` [s], or so shortly before it that its sign is uncertain there. The
    /// present values must be those at the end.
    fn root_at_end(&mut self, system: &System, step: DenseOutput<'_>, size: f64) -> Option<LocatedRoot> {
        let events = system.signals().events();
        let is_doubtful = |detector: &Self, k: usize| {
            let side = detector.known.sides[k];
            detector.values[k].number.abs() <= round_off::STEP_END * detector.known.largest[k]
                && side != 0.0
                && events[k].direction.allows(side < 0.0)
        };
        let doubtful: Vec<(usize, f64)> =
            (0..events.len()).filter(|&k| is_doubtful(self, k)).map(|k| (k, self.values[k].number)).collect();
        if doubtful.is_empty() {
            return None;
        }
        self.at(system, step, 1.0 - round_off::SLOPE_OFFSET);
        let beside = self.values.clone();
        self.at(system, step, INSTANTS[3]);
        let mut roots = Vec::new();
        for (k, end) in doubtful {
            let (side, noise) = (self.known.sides[k], NOISE * self.known.largest[k]);
            let rate = (end - beside[k].number) / round_off::SLOPE_OFFSET;
            // The root requires a clearly nonzero value on the known branch, and a rate towards zero.
            if side * self.values[k].number <= noise || side * rate >= 0.0 {
                continue;
            }
            let beyond = -end / rate;
            if end.abs() <= round_off::OPERATIONS * self.known.largest[k] || beyond.abs() <= round_off::ROOT {
                roots.push((k, 1.0));
            } else if beyond < 0.0 && beyond > INSTANTS[3] - 1.0 {
                roots.push((k, 1.0 + beyond));
            }
        }
        let share = roots.iter().map(|root| root.1).reduce(f64::min)?;
        let indices =
            roots.iter().filter(|root| root.1 <= share + round_off::ROOT).map(|root| root.0).collect();
        Some(LocatedRoot::new(share, size, indices, false))
    }

    /// Changes the branches of forces that switch at the start of the step. Returns false if they switch repeatedly: the
    /// motion slides along the switching surface.
    pub(crate) fn switch_at_start(&mut self, indices: &[usize]) -> bool {
        for &k in indices {
            self.cross(k, self.samples[0][k].number);
        }
        self.known.has_switched = true;
        self.switched_at_start += 1;
        self.switched_at_start <= MAX_SWITCHES_AT_START
    }

    /// Adds the functions that cross zero within the first millionth of the next step, as those of corners that meet a plane together:
    /// with the branches of a few of them the motion beyond the root would be another one. `step` must end at the root.
    pub(crate) fn join_simultaneous(
        &mut self,
        system: &System,
        step: DenseOutput<'_>,
        located: &mut LocatedRoot,
    ) {
        let events = system.signals().events();
        self.at(system, step, 1.0 + round_off::SLOPE_OFFSET);
        let beyond = self.values.clone();
        self.at(system, step, 1.0);
        let ahead = round_off::STEP_END * located.whole / (round_off::SLOPE_OFFSET * located.size);
        for k in 0..self.values.len() {
            let side = self.known.sides[k].signum();
            let [start, end, beyond] =
                [self.samples[0][k], self.values[k], beyond[k]].map(|value| side * value.number);
            let is_allowed = events.get(k).is_none_or(|event| event.direction.allows(side < 0.0));
            // A function that only touches zero has no root.
            let is_crossing = start > self.noise(k) && beyond < 0.0 && end <= ahead * (end - beyond);
            if is_allowed && is_crossing && !located.indices.contains(&k) {
                located.indices.push(k);
            }
        }
    }

    /// Whether the step that was solved to end at the root does so. If not, `located` is updated.
    pub(crate) fn is_met(
        &mut self,
        system: &System,
        step: DenseOutput<'_>,
        located: &mut LocatedRoot,
    ) -> bool {
        let first = located.indices[0];
        self.follow_only(first);
        located.refinements += 1;
        if located.is_jump {
            let size = located.size * self.jump(system, step, first, located);
            let is_there = size == located.size || located.refinements > MAX_REFINEMENTS;
            if !is_there {
                located.size = size.clamp(round_off::STEP_END * located.whole, located.whole);
            }
            return is_there;
        }
        self.near_at(system, step, 1.0 - 1e-3);
        let earlier = self.values[first].number;
        self.near_at(system, step, 1.0);
        let value = self.values[first].number;
        let change = -value * 1e-3 * located.size / (value - earlier);
        // Below its noise the value of a slow function does not decrease further.
        let is_lost = value.abs() <= self.noise(first) && value.abs() > SLOW_REFINEMENT * located.remaining;
        let is_there = is_lost || change.abs() <= round_off::ROOT * located.whole || change.is_nan();
        if is_there || located.refinements > MAX_REFINEMENTS {
            return true;
        }
        let side = self.known.sides[first];
        let size = located.bracketed(located.size + change, value, side * value < 0.0);
        let size = size.clamp(round_off::STEP_END * located.whole, located.whole);
        let is_moved = size != located.size;
        located.size = size;
        !is_moved
    }

    /// Step fraction at which function `which` jumps near the end of a step: 1 if it jumps just before the end, to the accuracy.
    fn jump(&mut self, system: &System, step: DenseOutput<'_>, which: usize, located: &LocatedRoot) -> f64 {
        let events = system.signals().events();
        let unit = located.whole / located.size;
        let (accuracy, most) = (2.0 * round_off::ROOT * unit, unit - 1.0);
        let passes = |detector: &mut Self, share: f64| {
            detector.near_at(system, step, share);
            detector.has_passed(events, which)
        };
        let is_early = !passes(self, 1.0);
        // Double the distance from the end until it contains the jump.
        let (mut near, mut far) = (0.0, accuracy);
        let share = |distance: f64| if is_early { 1.0 + distance } else { 1.0 - distance };
        let bound = if is_early { most } else { 1.0 };
        while far < bound && passes(self, share(far)) != is_early {
            (near, far) = (far, 2.0 * far);
        }
        if !is_early && near == 0.0 {
            return 1.0;
        }
        let mut far = far.min(bound);
        while far - near > 0.25 * accuracy {
            let middle = 0.5 * (near + far);
            if passes(self, share(middle)) == is_early { far = middle } else { near = middle }
        }
        // The result is just beyond the jump.
        share(if is_early { far } else { near })
    }

    /// Records the end of an accepted step, and the functions that crossed zero there. Returns the events that occurred.
    ///
    /// # Errors
    /// The index of a function that crosses zero too often.
    pub(crate) fn accept(
        &mut self,
        system: &System,
        state: &State,
        located: Option<&LocatedRoot>,
        longest: f64,
    ) -> Result<Vec<usize>, usize> {
        self.switched_at_start = 0;
        let events = system.signals().events();
        let indices: &[usize] = located.map_or(&[], |located| &located.indices);
        values_at(system, state, self.has_switches, &mut self.values);
        self.note(self.of_switches(system, &state.kinematics), indices);
        let time = state.kinematics.time;
        // A law that moves from level to level does not slide, however often others switch.
        let mut has_progressed = false;
        for &k in indices {
            let before = self.known.before[k];
            self.cross(k, self.values[k].number);
            has_progressed |= self.values[k].levels.is_some() && self.known.sides[k] != before;
        }
        let known = &mut self.known;
        known.stopped_by = None;
        known.has_switched = indices.iter().any(|&k| k >= events.len() || !events[k].sets.is_empty());
        let mut happened = Vec::new();
        for &k in indices {
            if let Some(event) = events.get(k) {
                happened.push(k);
                known.occurrences.push(Occurrence { event: k, time });
                if event.stops {
                    known.stopped_by.get_or_insert(k);
                }
            } else {
                let switch = k - events.len();
                known.ended.resize(known.ended.len().max(switch + 1), 0);
                known.ended[switch] += 1;
            }
        }
        if time - known.recent.0 > longest || has_progressed {
            known.recent = (time, 0);
        }
        known.recent.1 += indices.len();
        if known.recent.1 > MAX_CROSSINGS { Err(indices[0]) } else { Ok(happened) }
    }

    /// Updates the branches of functions that jumped because a law has changed its level at the state. Returns whether any has.
    pub(crate) fn follow_levels(&mut self, system: &System, state: &State) -> bool {
        values_at(system, state, self.has_switches, &mut self.values);
        let mut has_jumped = false;
        for k in self.of_switches(system, &state.kinematics) {
            if self.has_passed(&[], k) {
                self.known.before[k] = self.known.sides[k];
                self.known.sides[k] = self.values[k].side();
                has_jumped = true;
            }
        }
        has_jumped
    }

    /// Whether one of these values belongs to a law with levels.
    pub(crate) fn have_levels(&self, indices: &[usize]) -> bool {
        indices.iter().any(|&k| self.values[k].levels.is_some())
    }

    /// Whether a value is on the branch of function `k`.
    pub(crate) fn is_beyond(&self, k: usize, value: f64) -> bool {
        self.known.sides[k] * value > 0.0
    }

    /// Determines the branches of functions anew after they may have jumped at a state: those of their values, or where these are zero
    /// up to round-off those `ahead`, shortly after the state. Until it is on its branch a value has no sign.
    pub(crate) fn restart(&mut self, system: &System, [state, ahead]: [&State; 2], indices: &[usize]) {
        values_at(system, ahead, self.has_switches, &mut self.values);
        let ahead = self.values.clone();
        values_at(system, state, self.has_switches, &mut self.values);
        for &k in indices {
            let value = self.values[k].number;
            let is_zero = value.abs() <= NOISE * self.known.largest[k];
            let towards = if is_zero { ahead[k].number - value } else { value };
            self.known.sides[k] = if towards == 0.0 { 0.0 } else { towards.signum() };
            self.known.remaining[k] = if is_zero { value.abs() } else { 0.0 };
        }
        self.note(self.of_switches(system, &state.kinematics), indices);
    }

    /// Updates the branches of events after inputs have changed at the state; no event occurs.
    pub(crate) fn renew(&mut self, system: &System, state: &State, happened: &[usize]) {
        values_at(system, state, self.has_switches, &mut self.values);
        self.note(self.of_switches(system, &state.kinematics), happened);
    }
}

/// The polynomial through values at the [`INSTANTS`], by Neville's scheme.
fn quartic(values: &[f64; INSTANTS.len()], at: f64) -> f64 {
    let mut values = *values;
    for order in 1..INSTANTS.len() {
        for k in 0..INSTANTS.len() - order {
            let (from, to) = (INSTANTS[k], INSTANTS[k + order]);
            values[k] += (at - from) / (to - from) * (values[k + 1] - values[k]);
        }
    }
    values[0]
}

/// The state at a step fraction, which is stored `between` the ends if it is none of them.
fn state_at<'s>(step: DenseOutput<'s>, share: f64, between: &'s mut State) -> &'s State {
    let (start, end) = (step.from.kinematics.time, step.to.kinematics.time);
    if share == 0.0 || share == 1.0 {
        return if share == 0.0 { step.from } else { step.to };
    } else if share < 1.0 {
        step.interpolate(start + share * (end - start), between);
    } else {
        step.at(share, between);
    }
    between
}

/// Evaluates the monitored functions that `are_near` at a state; others keep their values.
fn update_values_at(
    system: &System,
    state: &State,
    (has_switches, are_near): (bool, &[bool]),
    out: &mut Vec<Switch>,
) {
    let (signals, at) = (system.signals(), &state.kinematics);
    signals.event_values_of(at, are_near, |index, value| out[index] = value.into());
    if has_switches {
        let (first, end) = (signals.events().len(), out.len());
        let count = signals.switch_count();
        if are_near[first..first + count].contains(&true) {
            signals.switches(at, out);
            out.copy_within(end.., first);
            out.truncate(end);
        }
        system.update_switches(at, (first + count, are_near), out);
    }
}

/// Evaluates all monitored functions at a state.
fn values_at(system: &System, state: &State, has_switches: bool, out: &mut Vec<Switch>) {
    out.clear();
    system.signals().event_values(&state.kinematics, |value| out.push(value.into()));
    if has_switches {
        system.signals().switches(&state.kinematics, out);
        system.switches(&state.kinematics, out);
    }
}
