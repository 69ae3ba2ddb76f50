//! Signals: numbers computed from time, inputs, first-order states and measurements of the motion, each evaluated once
//! per stage, with exact derivatives. They are the sizes of loads and the derivatives of states.
//!
//! Legend: s signal, m measurement, q positions, v velocities.
//!
//! ```text
//! s_i = f_i(t, held, s_j (j < i), m_k),      ∂s_i/∂q = Σ_j ∂f_i/∂s_j ∂s_j/∂q + Σ_k ∂f_i/∂m_k ∂m_k/∂q
//! ```
//!
//! Derivatives are accumulated backwards through the graph. Held values are constant within a step: inputs, and
//! signals with a sample period between two samples.

pub mod coordinate;
pub mod delay;
pub mod event;
pub mod failure;
pub mod frame_quantity;
pub mod measurement;
mod moving_frame;
pub mod unit_ports;

use std::collections::BTreeSet;
use std::fmt;
use std::sync::Arc;

use crate::instants;
use crate::kinematics::{Kinematics, Subject, Switch, indexed_by};
use crate::law::{Enclosure, Interval, ScalarLaw, VisitLaw};
use measurement::Component;
use unit_ports::{UnitPorts, UnitValue};

pub use moving_frame::MovingFrame;

pub use crate::kinematics::{DiscreteValueId, MeasurementId, SignalId};

/// Maximum number of arguments of a signal.
pub const MAX_ARGUMENTS: usize = 64;

/// Number of values stored on the stack; larger graphs allocate when they are evaluated.
const ON_STACK: usize = 64;

/// A function of time and of arguments, with exact derivatives with respect to the arguments.
pub trait SignalFunction: Send + Sync + fmt::Debug {
    /// Value at `time` [s], continued from known `sides` of the function's switches; 0, or no sides, if unknown.
    fn value(&self, time: f64, arguments: &[f64], sides: &[f64]) -> f64;
    /// Derivatives with respect to the arguments at `time` [s], written to `out`, one for each argument.
    fn gradient(&self, time: f64, arguments: &[f64], sides: &[f64], out: &mut [f64]);
    /// Number of kinks and jumps that [`switches`](Self::switches) reports. Default: none.
    fn switch_count(&self) -> usize {
        0
    }
    /// Appends switching functions, which change their sign where the function has a kink or a jump; 0 at all times if
    /// these are among the known [`breakpoints`](Self::breakpoints).
    fn switches(&self, _time: f64, _arguments: &[f64], _sides: &[f64], _out: &mut Vec<Switch>) {}
    /// Whether it is a polynomial of low degree, which has no feature that its values at a few points do not show.
    fn is_polynomial(&self) -> bool {
        false
    }
    /// Bounds of the value over intervals of time [s] and of the arguments. Default: none are known.
    fn bounds(&self, _time: Interval, _arguments: &[Interval]) -> Option<Interval> {
        None
    }
    /// Bounds of the value and of its derivatives along a path, given those of time and of the arguments. Default: none are known.
    fn enclosure(&self, _time: &Enclosure, _arguments: &[Enclosure]) -> Option<Enclosure> {
        None
    }
    /// Known breakpoints [s], for all arguments. Default: none.
    fn breakpoints(&self) -> &[f64] {
        &[]
    }
}

impl ScalarLaw for &(dyn SignalFunction + '_) {
    fn value(&self, time: f64, arguments: &[f64]) -> f64 {
        SignalFunction::value(*self, time, arguments, &[])
    }

    fn is_smooth(&self) -> bool {
        self.switch_count() == 0
    }

    fn bounds(&self, time: Interval, arguments: &[Interval]) -> Option<Interval> {
        SignalFunction::bounds(*self, time, arguments)
    }

    fn enclosure(&self, time: &Enclosure, arguments: &[Enclosure]) -> Option<Enclosure> {
        SignalFunction::enclosure(*self, time, arguments)
    }
}

/// Source of an argument of a signal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Argument {
    /// A held value.
    Held(DiscreteValueId),
    /// An earlier signal.
    Signal(SignalId),
    /// A measurement.
    Measured(MeasurementId),
}

/// A signal that is evaluated only at samples, and constant in between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// The held value that stores it.
    pub held: DiscreteValueId,
    /// Sample period, from the start of the simulation [s].
    pub period: f64,
}

/// How a signal follows from its arguments.
#[derive(Clone, Debug)]
pub enum Function {
    /// A function of the model.
    Own(Arc<dyn SignalFunction>),
    /// A value of a unit, which reports its jumps by event indicators. Nothing else is known of it.
    OfUnit(UnitValue),
}

/// A signal of a system.
#[derive(Clone, Debug)]
pub struct Signal {
    /// Subject of messages: the signal, or the entry of which this is an expression.
    pub subject: Subject,
    /// Expression of the signal, for messages.
    pub text: String,
    /// Function of the signal.
    pub function: Function,
    /// Arguments of the function.
    pub arguments: Vec<Argument>,
    /// For a sampled signal.
    pub sampling: Option<Sampling>,
}

indexed_by! {
    DiscreteValueId: (String, f64);
    SignalId: Signal;
    MeasurementId: Component;
}

impl Signal {
    /// The signal with its expression.
    fn in_words(&self) -> Subject {
        self.subject.clone().called(format!("{} = {}", self.subject, self.text))
    }

    /// Function of the model, if it is not sampled.
    fn law(&self) -> Option<&dyn SignalFunction> {
        match &self.function {
            Function::Own(function) if self.sampling.is_none() => Some(&**function),
            _ => None,
        }
    }

    /// Number of kinks and jumps between samples.
    fn switch_count(&self) -> usize {
        self.law().map_or(0, SignalFunction::switch_count)
    }
}

/// A signal that is not finite.
#[derive(Clone, Debug, PartialEq)]
pub struct SignalError {
    /// The signal with its expression.
    pub signal: Subject,
    /// Value of the signal.
    pub value: f64,
    /// Time [s].
    pub time: f64,
}

/// All signals of a system, each after those to which it refers.
#[derive(Default)]
pub struct Graph {
    /// Signals, each after those on which it depends.
    pub signals: Vec<Signal>,
    /// Measurements of the motion that signals depend on.
    pub measurements: Vec<Component>,
    /// Names of the held values, and what they are at the start.
    pub held: Vec<(String, f64)>,
    /// Held values that are quantities of the state at samples.
    pub readings: Vec<DiscreteValueId>,
    /// Units of other programs.
    pub units: Vec<UnitPorts>,
    /// Delayed signals.
    pub delays: Vec<delay::Delay>,
    /// Events.
    pub events: Vec<event::Event>,
    /// Offsets of the sides of each signal's switches among the held values, after inputs and samples, and the end of
    /// the last ones; those of elements follow.
    first_sides: Vec<usize>,
    /// Signals on which events depend.
    of_events: Vec<SignalId>,
}

impl Graph {
    /// The signals.
    pub fn signals(&self) -> &[Signal] {
        &self.signals
    }

    /// Names of the inputs: held values that are neither samples nor readings, nor values of a delayed signal.
    pub fn input_names(&self) -> impl Iterator<Item = &str> {
        let is_input = |&held: &DiscreteValueId| {
            !self.readings.contains(&held)
                && !self.is_of_window(held.index())
                && !self.signals.iter().any(|signal| signal.sampling.is_some_and(|own| own.held == held))
        };
        DiscreteValueId::first(self.held.len()).filter(is_input).map(|held| self.held[held].0.as_str())
    }

    /// The input called `name`.
    pub fn input(&self, name: &str) -> Option<DiscreteValueId> {
        let name = self.input_names().find(|known| *known == name)?;
        self.held.iter().position(|(known, _)| known == name).map(DiscreteValueId::new)
    }

    /// The signal called `name`; its parts, of which messages name the same entry, are before it.
    pub fn signal(&self, name: &str) -> Option<SignalId> {
        let is_named = |signal: &Signal| signal.subject.kind == "signal" && signal.subject.name == name;
        self.signals.iter().rposition(is_named).map(SignalId::new)
    }

    /// Whether any signal is sampled, or a unit is advanced at samples.
    pub fn has_samples(&self) -> bool {
        self.periods().next().is_some()
    }

    /// Periods of sampled signals and units [s].
    fn periods(&self) -> impl Iterator<Item = f64> + '_ {
        let of_signals = self.signals.iter().filter_map(|signal| signal.sampling.map(|own| own.period));
        of_signals.chain(self.units.iter().filter_map(|unit| unit.sampled().map(|own| own.period)))
    }

    /// Calls `with` with the values of all signals at a configuration, continued from the sides of their switches.
    pub fn evaluate<T>(&self, at: &Kinematics, with: impl FnOnce(&[f64]) -> T) -> T {
        let all = SignalId::first(self.signals.len());
        self.evaluate_with(at, (all, |signal| self.sides(signal, at)), with)
    }

    /// Calls `with` with the values of the signals on which events depend, each switch on the side of its present value; others are zero.
    pub(crate) fn evaluate_events<T>(&self, at: &Kinematics, with: impl FnOnce(&[f64]) -> T) -> T {
        self.evaluate_with(at, (self.of_events.iter().copied(), |_| &[]), with)
    }

    fn evaluate_with<'k, T>(
        &self,
        at: &'k Kinematics,
        (signals, sides): (impl Iterator<Item = SignalId>, impl Fn(SignalId) -> &'k [f64]),
        with: impl FnOnce(&[f64]) -> T,
    ) -> T {
        with_scratch(self.signals.len(), |values| {
            for id in signals {
                values[id.index()] = match self.signals[id].sampling {
                    Some(Sampling { held, .. }) => at.held[held.index()],
                    None => self.compute(id, at, values, sides(id)),
                };
            }
            with(values)
        })
    }

    /// Value of one signal.
    pub fn value(&self, signal: SignalId, at: &Kinematics) -> f64 {
        self.evaluate(at, |values| values[signal.index()])
    }

    /// Signals between samples that are no polynomials.
    fn laws_of_signals(&self) -> impl Iterator<Item = (&Signal, &dyn SignalFunction)> {
        let laws = self.signals.iter().filter_map(|signal| Some((signal, signal.law()?)));
        laws.filter(|(_, law)| !law.is_polynomial())
    }

    /// Passes the laws of signals between samples to `visit`, with their arguments, except for polynomials.
    pub fn laws(&self, at: &Kinematics, visit: &mut VisitLaw<'_>) {
        if self.laws_of_signals().next().is_none() {
            return;
        }
        self.evaluate(at, |values| {
            for (signal, law) in self.laws_of_signals() {
                let mut arguments = [0.0; MAX_ARGUMENTS];
                self.gather(signal, at, values, &mut arguments);
                visit(&law, &arguments[..signal.arguments.len()]);
            }
        });
    }

    /// Description of each of these laws.
    pub fn names_of_laws(&self) -> Vec<Subject> {
        self.laws_of_signals().map(|(signal, _)| signal.in_words()).collect()
    }

    /// Value of a measurement.
    pub fn measured(&self, measurement: MeasurementId, at: &Kinematics) -> f64 {
        self.measurements[measurement].value(at)
    }

    /// The expression of a signal, evaluated even if it is sampled.
    fn compute(&self, id: SignalId, at: &Kinematics, values: &[f64], sides: &[f64]) -> f64 {
        let signal = &self.signals[id];
        with_arguments(signal.arguments.len(), |arguments| {
            self.gather(signal, at, values, arguments);
            match &signal.function {
                Function::Own(function) => function.value(at.time, arguments, sides),
                Function::OfUnit(value) => value.value(at, arguments),
            }
        })
    }

    /// Initial held values: inputs, samples, and the sides of the switches of signals, which are unknown.
    pub fn held_at_start(&mut self) -> Vec<f64> {
        self.of_events = self.signals_of_events();
        let mut values: Vec<f64> = self.held.iter().map(|&(_, start)| start).collect();
        self.first_sides.clear();
        for signal in &self.signals {
            self.first_sides.push(values.len());
            values.resize(values.len() + signal.switch_count(), 0.0);
        }
        self.first_sides.push(values.len());
        values
    }

    /// Index of the first side of a switch among the held values.
    pub fn first_side(&self) -> usize {
        self.held.len()
    }

    /// Number of switches of signals between samples.
    pub fn switch_count(&self) -> usize {
        self.first_sides.last().map_or(0, |end| end - self.first_side())
    }

    /// Sides of a signal's switches.
    fn sides<'k>(&self, signal: SignalId, at: &'k Kinematics) -> &'k [f64] {
        match self.first_sides.get(signal.index()..signal.index() + 2) {
            Some(&[first, end]) => at.held.get(first..end).unwrap_or_default(),
            _ => &[],
        }
    }

    fn gather(&self, signal: &Signal, at: &Kinematics, values: &[f64], out: &mut [f64]) {
        for (value, argument) in out.iter_mut().zip(&signal.arguments) {
            *value = match *argument {
                Argument::Held(held) => at.held[held.index()],
                Argument::Signal(earlier) => values[earlier.index()],
                Argument::Measured(measurement) => self.measurements[measurement].value(at),
            };
        }
    }

    /// Passes the derivatives of a signal with respect to its measurements, if nonzero, to `add`; `values` are those of
    /// all signals.
    pub fn differentiate(
        &self,
        root: SignalId,
        at: &Kinematics,
        values: &[f64],
        mut add: impl FnMut(MeasurementId, f64),
    ) {
        self.differentiate_by_all(root, at, values, |argument, derivative| {
            if let Argument::Measured(measurement) = argument {
                add(measurement, derivative);
            }
        });
    }

    /// Passes the derivatives of a signal with respect to its held values as well.
    pub fn differentiate_by_all(
        &self,
        root: SignalId,
        at: &Kinematics,
        values: &[f64],
        mut add: impl FnMut(Argument, f64),
    ) {
        with_scratch(root.index() + 1, |adjoints| {
            adjoints[root.index()] = 1.0;
            for id in SignalId::first(root.index() + 1).rev() {
                let (signal, adjoint) = (&self.signals[id], adjoints[id.index()]);
                if adjoint == 0.0 || signal.sampling.is_some() {
                    continue;
                }
                let (mut arguments, mut gradient) = ([0.0; MAX_ARGUMENTS], [0.0; MAX_ARGUMENTS]);
                let count = signal.arguments.len();
                self.gather(signal, at, values, &mut arguments);
                let (from, out) = (&arguments[..count], &mut gradient[..count]);
                match &signal.function {
                    Function::Own(function) => function.gradient(at.time, from, self.sides(id, at), out),
                    Function::OfUnit(value) => value.gradient(at, from, out),
                }
                for (argument, derivative) in signal.arguments.iter().zip(&gradient) {
                    match *argument {
                        Argument::Signal(earlier) => adjoints[earlier.index()] += adjoint * derivative,
                        Argument::Held(_) | Argument::Measured(_) => add(*argument, adjoint * derivative),
                    }
                }
            }
        });
    }

    /// Measurements on which a signal depends between samples.
    pub fn measurements_of(&self, root: SignalId) -> BTreeSet<MeasurementId> {
        let reached = self.reached_from(std::iter::once(root));
        let arguments = reached.iter().flat_map(|&index| &self.signals[index].arguments);
        let measured = arguments.filter_map(|argument| match *argument {
            Argument::Measured(measurement) => Some(measurement),
            Argument::Held(_) | Argument::Signal(_) => None,
        });
        measured.collect()
    }

    /// Known breakpoints of signals between samples [s], their own or those of signals on which they depend.
    pub fn breakpoints_of(&self, roots: impl Iterator<Item = SignalId>) -> Vec<f64> {
        let reached = self.reached_from(roots);
        let laws = reached.iter().filter_map(|&index| self.signals[index].law());
        laws.flat_map(SignalFunction::breakpoints).copied().collect()
    }

    /// Signals on which some depend between samples, including themselves.
    fn reached_from(&self, roots: impl Iterator<Item = SignalId>) -> BTreeSet<SignalId> {
        let (mut open, mut seen): (Vec<_>, _) = (roots.collect(), BTreeSet::new());
        while let Some(index) = open.pop() {
            if self.signals[index].sampling.is_some() || !seen.insert(index) {
                continue;
            }
            open.extend(self.signals[index].arguments.iter().filter_map(|argument| match *argument {
                Argument::Signal(earlier) => Some(earlier),
                Argument::Held(_) | Argument::Measured(_) => None,
            }));
        }
        seen
    }

    /// Takes the first samples, at the start, from the initial values of the samples.
    ///
    /// # Errors
    /// If a signal is not finite; all held values are then unchanged.
    pub fn begin(&self, at: &mut Kinematics) -> Result<(), SignalError> {
        let before = at.held.clone();
        self.set_values_before_first_sample(at);
        let begun = self.sample(at, 0.0);
        if begun.is_err() {
            at.held = before;
        }
        begun
    }

    /// Whether a sample is due at `time` [s], `elapsed` [s] after the start.
    pub fn is_sample_due(&self, time: f64, elapsed: f64) -> bool {
        self.periods().any(|period| instants::is_due(time, elapsed, period))
    }

    /// Sets sampled signals to their values before the first sample.
    pub fn set_values_before_first_sample(&self, at: &mut Kinematics) {
        for Sampling { held, .. } in self.signals.iter().filter_map(|signal| signal.sampling) {
            at.held[held.index()] = self.held[held].1;
        }
    }

    /// Takes the samples that are due `elapsed` [s] after the start. Signals are sampled in their order, so that a
    /// sample uses those taken before it at the same instant. Arguments that are held values have their values before
    /// this instant: the previous sample of a signal.
    ///
    /// # Errors
    /// If a signal is not finite; all held values are then unchanged.
    pub fn sample(&self, at: &mut Kinematics, elapsed: f64) -> Result<(), SignalError> {
        let before = at.held.clone();
        let mut values = vec![0.0; self.signals.len()];
        for (id, signal) in SignalId::enumerate(&self.signals) {
            values[id.index()] = match signal.sampling {
                Some(Sampling { held, period }) if !instants::is_due(at.time, elapsed, period) => {
                    at.held[held.index()]
                }
                _ => self.compute(id, at, &values, self.sides(id, at)),
            };
        }
        for (signal, value) in self.signals.iter().zip(values) {
            if let Some(Sampling { held, .. }) = signal.sampling {
                at.held[held.index()] = value;
            }
        }
        let checked = self.check(at);
        if checked.is_err() {
            at.held = before;
        }
        checked
    }

    /// Whether all signals are finite.
    ///
    /// # Errors
    /// The first that is not.
    pub fn check(&self, at: &Kinematics) -> Result<(), SignalError> {
        // The cause of a delayed signal that is not finite is its expression.
        let is_delayed = |index: usize| self.delays.iter().any(|delay| delay.signal.index() == index);
        let infinite = |values: &[f64]| {
            let mut all = (0..values.len()).filter(|&index| !values[index].is_finite());
            let first = all.next()?;
            Some(if is_delayed(first) {
                all.find(|&index| !is_delayed(index)).unwrap_or(first)
            } else {
                first
            })
        };
        self.evaluate(at, |values| match infinite(values) {
            None => Ok(()),
            Some(index) => {
                let signal = self.signals[index].in_words();
                Err(SignalError { signal, value: values[index], time: at.time })
            }
        })
    }

    /// For each sampled signal, the sampling instant that is nearest to `time` [s].
    pub fn nearest_samples(&self, origin: f64, time: f64) -> impl Iterator<Item = f64> + '_ {
        self.periods().map(move |period| origin + ((time - origin) / period).round().max(0.0) * period)
    }

    /// The first instant after `time` [s] at which a sample is due, if the first samples are taken at `origin` [s].
    pub fn next_sample(&self, origin: f64, time: f64) -> Option<f64> {
        let next = |period: f64| {
            let aside = instants::tolerance(time, period);
            origin + (((time - origin + aside) / period).floor() + 1.0) * period
        };
        self.periods().map(next).min_by(f64::total_cmp)
    }
}

/// Calls `with` with the arguments of a function, all zero: most functions have few, and to clear all is as expensive as a short
/// function.
pub(crate) fn with_arguments<T>(count: usize, with: impl FnOnce(&mut [f64]) -> T) -> T {
    match [0.0; 8].get_mut(..count) {
        Some(few) => with(few),
        None => with(&mut [0.0; MAX_ARGUMENTS][..count]),
    }
}

/// Calls `with` with this number of zeros.
fn with_scratch<T>(count: usize, with: impl FnOnce(&mut [f64]) -> T) -> T {
    if count <= ON_STACK { with(&mut [0.0; ON_STACK][..count]) } else { with(&mut vec![0.0; count]) }
}
