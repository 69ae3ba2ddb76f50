//! Derivatives by differences of sixth order, exact to about twelve digits, of quantities without formulas for them: accelerations of
//! coordinates, and motions of sections between nodes.
//!
//! ```text
//! f' ≈ (3/4 (f₁ - f₋₁) - 3/20 (f₂ - f₋₂) + 1/60 (f₃ - f₋₃)) / h
//! ```

use std::ops::Bound;

use lissom_mechanics::kinematics::{GROUND, LOCKED, NodeId};
use lissom_motion::{Motion, Vector6};
use lissom_system::OutputDerivatives;
use lissom_system::{State, System};

use super::Evaluation;
use super::derivatives::add;
use super::touched::Touched;
use crate::outputs::channels::Channel;

/// Angle, and part of a length, by which positions are moved, and part of the units of velocities: far above round-off, and its sixth
/// power far below.
const APART: f64 = 2e-3;
/// Weights of the differences.
const WEIGHTS: [f64; 3] = [0.75, -0.15, 1.0 / 60.0];

/// Derivatives of a channel by differences; none where it does not state what it depends on.
pub(super) fn of(channel: &Channel, at: &Evaluation<'_>, length: f64) -> Option<Vec<OutputDerivatives>> {
    let Evaluation { system, state } = *at;
    let layout = system.layout();
    let touched = channel.quantity.touched(system)?;
    let state = state.clone();
    let length = touched_length(&touched, &state).unwrap_or(length);
    let mut difference = Difference { channel, system, state };
    let mut outputs = vec![OutputDerivatives::default(); channel.components.len()];
    for &node in touched.nodes.iter().filter(|&&node| node != GROUND) {
        for (k, &row) in layout.rows_of_node(node).iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
            let row = row as usize;
            let unit = if k < 3 { length } else { 1.0 };
            let along = Vector6::ith(k, 1.0);
            let found = difference.of(APART * unit, |state, change| {
                let own = &mut state.kinematics.nodes[node];
                own.frame = own.frame * Motion::exponential(&(change * along));
            });
            outputs.iter_mut().zip(found).for_each(|(output, value)| add(&mut output.by_place, row, value));
            let found = difference
                .of(APART * unit, |state, change| state.kinematics.nodes[node].twist += change * along);
            outputs.iter_mut().zip(found).for_each(|(output, value)| add(&mut output.by_rate, row, value));
            let found = difference
                .of(unit, |state, change| state.kinematics.nodes[node].acceleration += change * along);
            outputs
                .iter_mut()
                .zip(found)
                .for_each(|(output, value)| add(&mut output.by_acceleration, row, value));
        }
    }
    for &coordinate in &touched.coordinates {
        let row = layout.row_of_coordinate(coordinate);
        let found =
            difference.of(APART, |state, change| state.kinematics.coordinates[coordinate].value += change);
        outputs.iter_mut().zip(found).for_each(|(output, value)| add(&mut output.by_place, row, value));
        let found =
            difference.of(APART, |state, change| state.kinematics.coordinates[coordinate].rate += change);
        outputs.iter_mut().zip(found).for_each(|(output, value)| add(&mut output.by_rate, row, value));
        let found = difference
            .of(1.0, |state, change| state.kinematics.coordinates[coordinate].acceleration += change);
        outputs
            .iter_mut()
            .zip(found)
            .for_each(|(output, value)| add(&mut output.by_acceleration, row, value));
    }
    Some(outputs)
}

/// The smallest distance between two of several nodes [m].
fn touched_length(touched: &Touched, state: &State) -> Option<f64> {
    let place = |node: &NodeId| state.kinematics.nodes[*node].frame.position;
    let pairs = touched.nodes.iter().flat_map(|one| {
        touched.nodes.range((Bound::Excluded(one), Bound::Unbounded)).map(move |other| (one, other))
    });
    let distances = pairs.map(|(one, other)| (place(one) - place(other)).norm());
    distances.filter(|&distance| distance > 0.0).reduce(f64::min)
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
