//! Derivatives of recorded numbers by the unknowns they depend on. Those of measurements, signals, expressions and drives are
//! exact; those of reactions, of section forces and of accelerations of coordinates are differences of sixth order, exact to
//! about twelve digits:
//!
//! ```text
//! f' ≈ (3/4 (f₁ - f₋₁) - 3/20 (f₂ - f₋₂) + 1/60 (f₃ - f₋₃)) / h
//! ```

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use lissom_core::joints::slider::Slider;
use lissom_core::kinematics::{CoordinateId, GROUND, Kinematics, LOCKED, NodeId};
use lissom_core::linear::{LinearModel, OutputDerivatives};
use lissom_core::signals::measurement::Component;
use lissom_core::signals::{Argument, SignalFunction};
use lissom_core::system::{State, System};
use lissom_motion::{Motion, Vector6};

use crate::channels::{Channel, Source};

/// Angle, and part of a length, by which positions are moved, and part of the units of velocities and forces, since creep
/// forces saturate with both: far above round-off, and its sixth power far below.
const APART: f64 = 2e-3;
/// Weights of the differences.
const WEIGHTS: [f64; 3] = [0.75, -0.15, 1.0 / 60.0];

/// The unknowns a channel depends on.
struct Touched {
    nodes: BTreeSet<NodeId>,
    coordinates: BTreeSet<CoordinateId>,
    multipliers: Range<usize>,
}

impl Channel {
    /// Derivatives of its components at the state of `model`, in its unknowns; none of energies, momenta, powers, springs and
    /// accumulated numbers.
    pub fn derivatives(&self, model: &LinearModel<'_>) -> Option<Vec<OutputDerivatives>> {
        let state = State {
            kinematics: model.kinematics().clone(),
            multipliers: model.multipliers().to_vec(),
            violations: Vec::new(),
            algorithmic: Vec::new(),
            time_remainder: 0.0,
            position_remainders: Vec::new(),
            accumulated: Vec::new(),
        };
        let found = self.derivatives_at(model.system(), &state, model.length())?;
        Some(found.into_iter().map(|output| model.along_departures(output)).collect())
    }

    /// Derivatives of its components by positions, velocities, accelerations, multipliers and held values at a state; exact
    /// where there are formulas, otherwise by differences. `length` [m] is of the size of the model.
    pub(crate) fn derivatives_at(
        &self,
        system: &System,
        state: &State,
        length: f64,
    ) -> Option<Vec<OutputDerivatives>> {
        self.exact_derivatives(system, state, length).or_else(|| self.differences(system, state, length))
    }

    /// Derivatives by formulas; those of an expression by the chain rule.
    pub(crate) fn exact_derivatives(
        &self,
        system: &System,
        state: &State,
        length: f64,
    ) -> Option<Vec<OutputDerivatives>> {
        let at = &state.kinematics;
        let multiplier_row = |multiplier: usize| system.layout().coordinate_count() + multiplier;
        if let Some(measurements) = self.source.measurements() {
            return Some(measurements.iter().map(|own| derivatives_of(own, system, at)).collect());
        }
        let mut own = OutputDerivatives::default();
        match &self.source {
            Source::Signal(argument) => add_argument(&mut own, *argument, system, at),
            Source::Expression(formula, arguments) => {
                let (mut values, mut of_arguments) = (Vec::new(), Vec::new());
                for (channel, index) in arguments {
                    let mut all = Vec::new();
                    channel.evaluate(system, state, &mut all);
                    values.push(all.get(*index).copied()?);
                    of_arguments
                        .push(channel.derivatives_at(system, state, length)?.into_iter().nth(*index)?);
                }
                let mut gradient = vec![0.0; values.len()];
                formula.gradient(at.time, &values, &[], &mut gradient);
                for (of, factor) in of_arguments.iter().zip(gradient) {
                    add_scaled(&mut own, of, factor);
                }
            }
            // The force of a drive is minus its multiplier, its power that times the rate.
            Source::Drive(index) => {
                own.by_multiplier.insert(multiplier_row(system.drives()[*index].multiplier), -1.0);
            }
            Source::DrivePower(index) => {
                let drive = &system.drives()[*index];
                let coordinate = drive.prescribed.coordinate;
                let row = system.layout().row_of_coordinate(coordinate);
                own.by_multiplier.insert(multiplier_row(drive.multiplier), -at.coordinates[coordinate].rate);
                own.by_rate.insert(row, -state.multipliers[drive.multiplier]);
            }
            _ => return None,
        }
        Some(vec![own])
    }

    /// Derivatives by differences.
    fn differences(&self, system: &System, state: &State, length: f64) -> Option<Vec<OutputDerivatives>> {
        let layout = system.layout();
        let touched = touched(&self.source, system)?;
        let state = state.clone();
        let length = touched_length(&touched, &state).unwrap_or(length);
        let mut difference = Difference { channel: self, system, state };
        let mut outputs = vec![OutputDerivatives::default(); self.components.len()];
        for &node in touched.nodes.iter().filter(|&&node| node != GROUND) {
            for (k, &row) in layout.rows_of_node(node).iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
                let row = row as usize;
                let unit = if k < 3 { length } else { 1.0 };
                let along = Vector6::ith(k, 1.0);
                let found = difference.of(APART * unit, |state, change| {
                    let own = &mut state.kinematics.nodes[node];
                    own.frame = own.frame * Motion::exponential(&(change * along));
                });
                keep(&mut outputs, &found, row, |output| &mut output.by_place);
                let found = difference
                    .of(APART * unit, |state, change| state.kinematics.nodes[node].twist += change * along);
                keep(&mut outputs, &found, row, |output| &mut output.by_rate);
                let found = difference
                    .of(unit, |state, change| state.kinematics.nodes[node].acceleration += change * along);
                keep(&mut outputs, &found, row, |output| &mut output.by_acceleration);
            }
        }
        for &coordinate in &touched.coordinates {
            let row = layout.row_of_coordinate(coordinate);
            let found = difference
                .of(APART, |state, change| state.kinematics.coordinates[coordinate].value += change);
            keep(&mut outputs, &found, row, |output| &mut output.by_place);
            let found =
                difference.of(APART, |state, change| state.kinematics.coordinates[coordinate].rate += change);
            keep(&mut outputs, &found, row, |output| &mut output.by_rate);
            let found = difference
                .of(1.0, |state, change| state.kinematics.coordinates[coordinate].acceleration += change);
            keep(&mut outputs, &found, row, |output| &mut output.by_acceleration);
        }
        for multiplier in touched.multipliers {
            let unit = difference.state.multipliers[multiplier].abs().max(1.0);
            let found = difference.of(APART * unit, |state, change| state.multipliers[multiplier] += change);
            let row = layout.coordinate_count() + multiplier;
            keep(&mut outputs, &found, row, |output| &mut output.by_multiplier);
        }
        Some(outputs)
    }
}

fn touched(source: &Source, system: &System) -> Option<Touched> {
    let mut touched = Touched { nodes: BTreeSet::new(), coordinates: BTreeSet::new(), multipliers: 0..0 };
    match source {
        Source::BetweenNodes(section) => touched.nodes.extend(section.nodes()),
        Source::Section(section) => touched.nodes.extend(section.nodes()),
        Source::Joint(index, _) | Source::Contact(index) => {
            let joint = &system.joints()[*index];
            touched.nodes.extend(joint.frames.iter().chain(&joint.output_frames).map(|frame| frame.node));
            touched.coordinates.extend(&joint.coordinates);
            // Forces against sliding are their rates.
            touched.coordinates.extend(&joint.impulses);
            touched.multipliers = joint.first_multiplier..joint.first_multiplier + joint.equations();
        }
        Source::Recovered(unknowns, _) => {
            touched.nodes.extend(unknowns.nodes());
            touched.coordinates.extend(unknowns.coordinates());
        }
        Source::Slider(index) => {
            let slider = &system.sliders()[*index];
            let (first, count) = (slider.first_multiplier, slider.equations());
            touched.multipliers = first..first + count;
            if count > 3 {
                // Its moment turns with the tip and with the line.
                return None;
            }
        }
        Source::Coupling(index) => {
            let coupling = &system.couplings()[*index];
            touched.coordinates.extend(&coupling.coordinates);
            touched.multipliers = coupling.multiplier..coupling.multiplier + 1;
        }
        Source::FreeAccelerations(coordinates) => {
            touched.coordinates.extend(coordinates);
            let is_own = |slider: &&Slider| coordinates.contains(&slider.coordinate);
            touched.nodes.extend(system.sliders().iter().filter(is_own).flat_map(Slider::carriers));
        }
        Source::Accelerations(coordinates) => {
            for joint in coordinates.iter().map(|&(joint, _)| &system.joints()[joint]) {
                touched.nodes.extend(joint.frames.map(|frame| frame.node));
                touched.coordinates.extend(&joint.coordinates);
            }
        }
        Source::Expression(..)
        | Source::Signal(_)
        | Source::Drive(_)
        | Source::DrivePower(_)
        | Source::Measured(_)
        | Source::Line(_)
        | Source::Coordinates(_)
        | Source::Modal(_)
        | Source::Angle(_)
        | Source::Spring(..)
        | Source::Power(_)
        | Source::Accumulated(_)
        | Source::Energy
        | Source::Momentum(_) => {
            return None;
        }
    }
    Some(touched)
}

/// Adds the derivatives of an argument of signals.
fn add_argument(out: &mut OutputDerivatives, argument: Argument, system: &System, at: &Kinematics) {
    let graph = system.signals();
    let measured = |index: usize| derivatives_of(&graph.measurements[index], system, at);
    match argument {
        Argument::Held(held) => *out.by_held.entry(held).or_insert(0.0) += 1.0,
        Argument::Measured(index) => add_scaled(out, &measured(index), 1.0),
        Argument::Signal(signal) => graph.evaluate(at, |values| {
            graph.differentiate_by_all(signal, at, values, |argument, derivative| match argument {
                Argument::Held(held) => *out.by_held.entry(held).or_insert(0.0) += derivative,
                Argument::Measured(index) => add_scaled(out, &measured(index), derivative),
                Argument::Signal(_) => {}
            });
        }),
    }
}

/// Adds `factor` times other derivatives.
fn add_scaled(out: &mut OutputDerivatives, other: &OutputDerivatives, factor: f64) {
    for (own, other) in [
        (&mut out.by_place, &other.by_place),
        (&mut out.by_rate, &other.by_rate),
        (&mut out.by_acceleration, &other.by_acceleration),
        (&mut out.by_multiplier, &other.by_multiplier),
        (&mut out.by_held, &other.by_held),
    ] {
        for (&row, value) in other {
            *own.entry(row).or_insert(0.0) += factor * value;
        }
    }
}

/// Derivatives of a component of a measurement, by row.
fn derivatives_of(of: &Component, system: &System, at: &Kinematics) -> OutputDerivatives {
    let layout = system.layout();
    let nodes = of.of.nodes().iter().flat_map(|&node| layout.rows_of_node(node).iter().copied());
    let coordinates = of.of.coordinates().iter().map(|&own| layout.row_of_coordinate(own) as u32);
    let gradient = of.gradient(at);
    let mut output = OutputDerivatives::default();
    for (slot, row) in nodes.chain(coordinates).enumerate().filter(|&(_, row)| row != LOCKED) {
        for (own, value) in [
            (&mut output.by_place, gradient.by_place[slot]),
            (&mut output.by_rate, gradient.by_rate[slot]),
            (&mut output.by_acceleration, gradient.by_acceleration[slot]),
        ] {
            if value != 0.0 {
                *own.entry(row as usize).or_insert(0.0) += value;
            }
        }
    }
    output
}

/// The smallest distance between two of several nodes [m].
fn touched_length(touched: &Touched, state: &State) -> Option<f64> {
    let place = |node: &NodeId| state.kinematics.nodes[*node].frame.position;
    let pairs =
        touched.nodes.iter().flat_map(|one| touched.nodes.range(one + 1..).map(move |other| (one, other)));
    let distances = pairs.map(|(one, other)| (place(one) - place(other)).norm());
    distances.filter(|&distance| distance > 0.0).reduce(f64::min)
}

fn keep(
    outputs: &mut [OutputDerivatives],
    found: &[f64],
    row: usize,
    of: fn(&mut OutputDerivatives) -> &mut BTreeMap<usize, f64>,
) {
    for (output, &value) in outputs.iter_mut().zip(found) {
        if value != 0.0 {
            *of(output).entry(row).or_insert(0.0) += value;
        }
    }
}

/// A channel at neighbouring states.
struct Difference<'c> {
    channel: &'c Channel,
    system: &'c System,
    state: State,
}

impl Difference<'_> {
    /// Derivatives of all components as `change` moves the state, from differences `apart`.
    fn of(&mut self, apart: f64, change: impl Fn(&mut State, f64)) -> Vec<f64> {
        let mut sums = vec![0.0; self.channel.components.len()];
        for (k, weight) in WEIGHTS.iter().enumerate() {
            let distance = (k + 1) as f64 * apart;
            let [ahead, behind] = [distance, -distance].map(|distance| {
                let mut moved = self.state.clone();
                change(&mut moved, distance);
                let mut values = Vec::new();
                self.channel.evaluate(self.system, &moved, &mut values);
                values
            });
            for (sum, (ahead, behind)) in sums.iter_mut().zip(ahead.iter().zip(&behind)) {
                *sum += weight * (ahead - behind) / apart;
            }
        }
        sums
    }
}
