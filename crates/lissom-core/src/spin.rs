//! Departures of rotors in axes that do not spin with them.
//!
//! Increments of a node are in its body axes, in which what is constant in space turns with it: a step would have to resolve the
//! revolution, and one tangent could not serve all stages. The increments of a [`Rotor`] are those of a frame that does not spin, from
//! which the rotor is turned about its axis as far as it would be at the angular velocity of the start:
//!
//! Legend: a axis, f angle about it and W angular velocity about it at the start of the step; P(t) rotation about a by f + W t; (R, x)
//! frame of the rotor, v, ω its twist; S, v_S, ω_S the same of the frame that does not spin.
//!
//! ```text
//! R = S P,      v = Pᵀ v_S,      ω = Pᵀ ω_S + W a,      v̇ = Pᵀ v̇_S - W a × v,      ω̇ = Pᵀ ω̇_S - W a × ω
//! ```
//!
//! S moves as other nodes do. What remains of the spin is a slow rotation of S about a. Residuals at every stage, and multipliers of
//! equations in axes of the rotor, are turned into the axes of the tangent, and corrections into those of S. With another f or W, and for
//! nodes that are not symmetric, solutions are as valid, but tangents serve less long. A drift with a constant twist of the rotor, instead
//! of S, would not do: its axis would move round a cone once in a revolution, which no step resolves.

use std::f64::consts::PI;

use lissom_motion::{Motion, Rotation, Vector3, Vector6, rotation_part, screw};

use crate::kinematics::{AxisSpin, Kinematics, LOCKED, Layout, NodeId, NodeMotion, Rotor, across};
use crate::node_motion::depart;
use crate::schemes::{Parametrization, Scheme};

/// A node that rotates in one step by more than a quarter of a turn is not resolved by any of the schemes [rad].
pub(crate) const MAX_TURN: f64 = 0.5 * PI;

/// A rotor in the present step.
#[derive(Clone, Debug)]
pub(crate) struct Spin {
    rotor: Rotor,
    rows: [usize; 6],
    /// First multiplier's row of each of its triples.
    triples: Vec<usize>,
    /// f [rad].
    angle: f64,
    /// W [rad/s].
    rate: f64,
    /// Frame of the rotor, and the motion of S, at the start of the step.
    frame: Motion,
    still: NodeMotion,
    /// Angle at which the tangent in use was assembled [rad].
    of_tangent: f64,
    /// Whether its equations are all in use.
    is_complete: bool,
    /// Whether increments of the step are in axes that do not spin: otherwise they are those of other nodes.
    is_still: bool,
}

/// Departure from the drift of a node with its rates.
pub(crate) struct Departure {
    pub(crate) place: Vector6,
    pub(crate) rate: Vector6,
    pub(crate) curvature: Vector6,
}

impl Spin {
    /// The rotors of a model, for schemes with departures from a drift.
    pub(crate) fn all(layout: &Layout, scheme: &Scheme) -> Vec<Self> {
        let departs = scheme.dynamic
            && scheme.tableau.is_none()
            && scheme.parametrization == Parametrization::RelativeToDrift;
        let of = |rotor: &Rotor| Self {
            rows: layout.rows_of_node(rotor.node).map(|row| row as usize),
            triples: rotor
                .triples
                .iter()
                .map(|triple| layout.coordinate_count() + triple.first_multiplier)
                .collect(),
            rotor: rotor.clone(),
            angle: 0.0,
            rate: 0.0,
            frame: Motion::identity(),
            still: NodeMotion {
                frame: Motion::identity(),
                twist: Vector6::zeros(),
                acceleration: Vector6::zeros(),
            },
            of_tangent: 0.0,
            is_complete: true,
            is_still: false,
        };
        let is_free = |rotor: &&Rotor| layout.rows_of_node(rotor.node).iter().all(|&row| row != LOCKED);
        layout.rotors.iter().filter(|_| departs).filter(is_free).map(of).collect()
    }

    /// Rows of the node.
    pub(crate) fn rows(&self) -> &[usize; 6] {
        &self.rows
    }

    /// The node.
    pub(crate) fn node(&self) -> NodeId {
        self.rotor.node
    }

    /// Begins a step of `size` [s] from this motion. Where it turns little, other axes gain nothing.
    fn begin(&mut self, from: &NodeMotion, size: f64) {
        self.angle = self.rotor.angle(&from.frame.rotation);
        let (axes, twist) = self.rotor.parts(&from.twist);
        self.rate = self.rotor.axis.dot(&axes);
        self.is_still = self.is_complete && 32.0 * (size * self.rate).abs() > MAX_TURN;
        let acceleration = from.acceleration + across(&axes, &twist);
        let [twist, acceleration] =
            [twist, acceleration].map(|vector| self.rotor.turned(self.angle, &vector));
        let frame = from.frame * self.turn_by(-self.angle);
        (self.frame, self.still) = (from.frame, NodeMotion { frame, twist, acceleration });
    }

    /// Angle of the drift after `time` [s].
    fn angle_after(&self, time: f64) -> f64 {
        self.angle + self.rate * time
    }

    fn turn_by(&self, angle: f64) -> Motion {
        Motion::new(Rotation::about_axis(&self.rotor.axis, angle), Vector3::zeros())
    }

    /// Second derivative of the increments at the start.
    pub(crate) fn start_curvature(&self) -> &Vector6 {
        &self.still.acceleration
    }

    /// Motion after `time` [s] from the start, and its change since then.
    pub(crate) fn depart(&self, time: f64, departure: &Departure) -> (NodeMotion, Motion) {
        let angle = self.angle_after(time);
        let Departure { place, rate, curvature } = departure;
        let reached = depart(&self.still, time, place, [rate, curvature]);
        let change = Motion::exponential(&(time * self.still.twist)) * Motion::exponential(place);
        let change = self.turn_by(-self.angle) * change * self.turn_by(angle);
        let axes = self.rate * self.rotor.axis;
        let [twist, acceleration] =
            [reached.twist, reached.acceleration].map(|vector| self.rotor.turned(-angle, &vector));
        let node = NodeMotion {
            frame: self.frame * change,
            twist: twist + screw(&Vector3::zeros(), &axes),
            acceleration: acceleration - across(&axes, &twist),
        };
        (node, change)
    }

    /// Turns components of the node about the axis.
    fn turn_node(&self, values: &mut [f64], angle: f64) {
        let turned = self.rotor.turned(angle, &self.of_rows(values));
        self.rows.iter().zip(turned.iter()).for_each(|(&row, value)| values[row] = *value);
    }

    /// Turns components of equations in axes of the rotor; `first` is the row of the first of `values`.
    fn turn_triples(&self, values: &mut [f64], first: usize, angle: f64) {
        for (&row, triple) in self.triples.iter().zip(&self.rotor.triples) {
            let components = &mut values[row - first..row - first + 3];
            let before = Vector3::from_column_slice(components);
            let turned = Rotation::about_axis(&triple.axis, angle).apply(&before);
            components.copy_from_slice(turned.as_slice());
        }
    }

    /// Angle of axes.
    fn angle_in(&self, axes: Axes) -> f64 {
        match axes {
            Axes::Body(time) => self.angle_after(time),
            Axes::Tangent => self.of_tangent,
            Axes::Still => 0.0,
        }
    }

    /// Components of the node.
    fn of_rows(&self, values: &[f64]) -> Vector6 {
        Vector6::from_fn(|k, _| values[self.rows[k]])
    }

    /// Components of the node, given in axes of the tangent.
    pub(crate) fn in_still_axes(&self, values: &[f64]) -> Vector6 {
        self.rotor.turned(self.of_tangent, &self.of_rows(values))
    }

    /// Components of the node that a function gives by row.
    pub(crate) fn by_row(&self, of: impl Fn(usize) -> f64) -> Vector6 {
        Vector6::from_fn(|k, _| of(self.rows[k]))
    }
}

/// All rotors in a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Spins {
    all: Vec<Spin>,
    /// First row of the multipliers.
    first_multiplier: usize,
}

/// Axes in which components of rotors are.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Axes {
    /// Body axes of the node, this time after the start of the step [s].
    Body(f64),
    /// Body axes of the node where the tangent in use was assembled.
    Tangent,
    /// Axes that do not spin.
    Still,
}

impl Spins {
    pub(crate) fn new(layout: &Layout, scheme: &Scheme) -> Self {
        Self { all: Spin::all(layout, scheme), first_multiplier: layout.coordinate_count() }
    }

    /// Rotors whose increments are in axes that do not spin.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &Spin> {
        self.all.iter().filter(|spin| spin.is_still)
    }

    /// Uses axes that do not spin for no node.
    pub(crate) fn clear(&mut self) {
        self.all.clear();
    }

    /// Excludes rotors of which equations in their axes are among these omitted ones, by unknown, from the next step on.
    pub(crate) fn omit(&mut self, omitted: &[usize]) {
        for spin in &mut self.all {
            let is_omitted = |row: &usize| (*row..row + 3).any(|row| omitted.contains(&row));
            spin.is_complete = !spin.triples.iter().any(is_omitted);
        }
    }

    /// Begins a step of `size` [s].
    pub(crate) fn begin(&mut self, start: &Kinematics, size: f64) {
        self.all.iter_mut().for_each(|spin| spin.begin(&start.nodes[spin.rotor.node], size));
    }

    /// The tangent is assembled `time` [s] after the start of the step.
    pub(crate) fn note_tangent(&mut self, time: f64) {
        self.all.iter_mut().for_each(|spin| spin.of_tangent = spin.angle_after(time));
    }

    /// Drift at a time after the start [s], for derivatives.
    pub(crate) fn write_drifts(&self, time: f64, out: &mut Vec<AxisSpin>) {
        out.clear();
        out.extend(self.iter().map(|spin| AxisSpin {
            node: spin.node(),
            spin: spin.rate * spin.rotor.axis,
            drift: spin.rotor.turned(-spin.angle_after(time), &spin.still.twist),
        }));
    }

    /// Turns components by row, of the nodes and, if there are so many rows, of equations in their axes.
    pub(crate) fn turn(&self, values: &mut [f64], [from, to]: [Axes; 2]) {
        for spin in self.iter() {
            let angle = spin.angle_in(from) - spin.angle_in(to);
            spin.turn_node(values, angle);
            if values.len() > self.first_multiplier && spin.is_complete {
                spin.turn_triples(values, 0, angle);
            }
        }
    }

    /// Turns multipliers, given without the other unknowns.
    pub(crate) fn turn_multipliers(&self, multipliers: &mut [f64], [from, to]: [Axes; 2]) {
        for spin in self.iter().filter(|spin| spin.is_complete) {
            spin.turn_triples(multipliers, self.first_multiplier, spin.angle_in(from) - spin.angle_in(to));
        }
    }

    /// Whether there are none.
    pub(crate) fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// The rotor of a node, whose increments are in axes that do not spin in all steps that turn it far: independent of the last step,
    /// which a restored simulation does not know.
    fn of(&self, node: NodeId) -> Option<&Spin> {
        self.all.iter().find(|spin| spin.is_complete && spin.node() == node)
    }

    /// Squared angular velocity of a node that steps must resolve [rad²/s²].
    pub(crate) fn turning(&self, node: NodeId, twist: &Vector6) -> f64 {
        self.of(node).map_or_else(|| rotation_part(twist).norm_squared(), |spin| spin.rotor.swing(twist))
    }

    /// A twist at a time after the start [s], of rotors in axes of the start that do not spin.
    pub(crate) fn seen_from_start(&self, node: NodeId, time: f64, twist: &Vector6) -> Vector6 {
        self.of(node).map_or(*twist, |spin| spin.rotor.turned(spin.rate * time, twist))
    }

    /// Angles at which the tangent in use was assembled.
    pub(crate) fn angles_of_tangent(&self) -> Vec<f64> {
        self.all.iter().map(|spin| spin.of_tangent).collect()
    }

    /// Restores these angles.
    pub(crate) fn restore(&mut self, angles: &[f64]) {
        self.all.iter_mut().zip(angles).for_each(|(spin, angle)| spin.of_tangent = *angle);
    }
}

#[cfg(test)]
#[path = "../tests/unit/spin.rs"]
mod tests;
