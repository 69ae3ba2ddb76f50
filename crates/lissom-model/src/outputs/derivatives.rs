//! Derivatives of recorded quantities by row of the system.

use std::collections::BTreeMap;

use lissom_mechanics::kinematics::local_derivatives::LocalDerivatives;
use lissom_mechanics::kinematics::{CoordinateId, Kinematics, LOCKED, MeasurementId, NodeId};
use lissom_mechanics::signals::Argument;
use lissom_mechanics::signals::measurement::{Component, Gradient};
use lissom_system::OutputDerivatives;
use lissom_system::System;
use lissom_system::energy_derivatives::Slopes;

/// Row of a multiplier.
pub(super) fn multiplier_row(system: &System, multiplier: usize) -> usize {
    system.layout().coordinate_count() + multiplier
}

/// Adds to an entry.
pub(super) fn add(to: &mut BTreeMap<usize, f64>, row: usize, value: f64) {
    if value != 0.0 {
        *to.entry(row).or_insert(0.0) += value;
    }
}

/// Adds `factor` times the derivatives of an argument of signals.
pub(super) fn add_argument(
    out: &mut OutputDerivatives,
    factor: f64,
    argument: Argument,
    system: &System,
    at: &Kinematics,
) {
    let graph = system.signals();
    let measured = |id: MeasurementId| of_component(&graph.measurements[id], system, at);
    match argument {
        Argument::Held(held) => *out.by_held.entry(held).or_insert(0.0) += factor,
        Argument::Measured(index) => add_scaled(out, &measured(index), factor),
        Argument::Signal(signal) => graph.evaluate(at, |values| {
            graph.differentiate_by_all(signal, at, values, |argument, derivative| match argument {
                Argument::Held(held) => *out.by_held.entry(held).or_insert(0.0) += factor * derivative,
                Argument::Measured(index) => add_scaled(out, &measured(index), factor * derivative),
                Argument::Signal(_) => {}
            });
        }),
    }
}

/// Adds `factor` times other derivatives.
pub(super) fn add_scaled(out: &mut OutputDerivatives, other: &OutputDerivatives, factor: f64) {
    add_each(&mut out.by_place, &other.by_place, factor);
    add_each(&mut out.by_rate, &other.by_rate, factor);
    add_each(&mut out.by_acceleration, &other.by_acceleration, factor);
    add_each(&mut out.by_multiplier, &other.by_multiplier, factor);
    add_each(&mut out.by_held, &other.by_held, factor);
}

fn add_each<K: Ord + Copy>(out: &mut BTreeMap<K, f64>, other: &BTreeMap<K, f64>, factor: f64) {
    for (&key, value) in other {
        *out.entry(key).or_insert(0.0) += factor * value;
    }
}

/// Derivatives of a component of a measurement, by row.
pub(super) fn of_component(of: &Component, system: &System, at: &Kinematics) -> OutputDerivatives {
    of_gradient(&of.gradient(at), (of.of.nodes(), of.of.coordinates()), system)
}

/// A gradient with respect to some nodes and coordinates, by row.
pub(super) fn of_gradient(
    gradient: &Gradient,
    (nodes, coordinates): (&[NodeId], &[CoordinateId]),
    system: &System,
) -> OutputDerivatives {
    let layout = system.layout();
    let nodes = nodes.iter().flat_map(|&node| layout.rows_of_node(node).iter().copied());
    let coordinates = coordinates.iter().map(|&own| layout.row_of_coordinate(own) as u32);
    let mut output = OutputDerivatives::default();
    for (slot, row) in nodes.chain(coordinates).enumerate().filter(|&(_, row)| row != LOCKED) {
        add(&mut output.by_place, row as usize, gradient.by_place[slot]);
        add(&mut output.by_rate, row as usize, gradient.by_rate[slot]);
        add(&mut output.by_acceleration, row as usize, gradient.by_acceleration[slot]);
    }
    output
}

/// Derivatives of several numbers of a joint, by row.
pub(super) fn of_local<const N: usize>(
    of: &LocalDerivatives<N>,
    first_multiplier: usize,
    system: &System,
) -> Vec<OutputDerivatives> {
    let layout = system.layout();
    let nodes = of.nodes.iter().flat_map(|&node| layout.rows_of_node(node).iter().copied());
    let coordinates = of.coordinates.iter().map(|&own| layout.row_of_coordinate(own) as u32);
    let mut outputs = vec![OutputDerivatives::default(); N];
    for (slot, row) in nodes.chain(coordinates).enumerate().filter(|&(_, row)| row != LOCKED) {
        for (k, output) in outputs.iter_mut().enumerate() {
            add(&mut output.by_place, row as usize, of.by_place[slot][k]);
            add(&mut output.by_rate, row as usize, of.by_rate[slot][k]);
        }
    }
    for (equation, column) in of.by_multiplier.iter().enumerate() {
        let row = multiplier_row(system, first_multiplier + equation);
        outputs
            .iter_mut()
            .zip(column)
            .for_each(|(output, &value)| add(&mut output.by_multiplier, row, value));
    }
    outputs
}

/// Derivatives of a number of the whole model.
pub(super) fn of_slopes(of: &Slopes) -> OutputDerivatives {
    let mut output = OutputDerivatives::default();
    for (row, (&by_place, &by_rate)) in of.by_place.iter().zip(&of.by_rate).enumerate() {
        add(&mut output.by_place, row, by_place);
        add(&mut output.by_rate, row, by_rate);
    }
    output
}
