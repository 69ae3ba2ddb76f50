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

use lissom_motion::{Motion, Rotation, Vector3, Vector6, rotation_part, screw, translation_part};

use crate::kinematics::{AxisSpin, Kinematics, LOCKED, Layout, NodeId, NodeMotion, Rotor};
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
                .map(|own| layout.coordinate_count() + own.first_multiplier)
                .collect(),
            rotor: rotor.clone(),
            angle: 0.0,
            rate: 0.0,
            of_tangent: 0.0,
            is_complete: true,
            is_still: true,
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
        self.rate = self.rotor.axis.dot(&rotation_part(&from.twist));
        self.is_still = self.is_complete && 32.0 * (size * self.rate).abs() > MAX_TURN;
    }

    /// Angle of the drift after `time` [s].
    fn angle_after(&self, time: f64) -> f64 {
        self.angle + self.rate * time
    }

    /// The motion of S at the start.
    fn still(&self, from: &NodeMotion) -> NodeMotion {
        let (axes, twist) = self.rotor.parts(&from.twist);
        let [twist, acceleration] =
            [twist, from.acceleration + across(&axes, &twist)].map(|own| self.rotor.turned(self.angle, &own));
        NodeMotion { frame: from.frame * self.turn_by(-self.angle), twist, acceleration }
    }

    fn turn_by(&self, angle: f64) -> Motion {
        Motion::new(Rotation::about_axis(&self.rotor.axis, angle), Vector3::zeros())
    }

    /// Second derivative of the increments at the start.
    pub(crate) fn start_curvature(&self, from: &NodeMotion) -> Vector6 {
        self.still(from).acceleration
    }

    /// Motion after `time` [s] from the start, and its change since then.
    pub(crate) fn depart(&self, from: &NodeMotion, time: f64, departure: &Departure) -> (NodeMotion, Motion) {
        let (still, angle) = (self.still(from), self.angle_after(time));
        let Departure { place, rate, curvature } = departure;
        let reached = depart(&still, time, place, [rate, curvature]);
        let change = Motion::exponential(&(time * still.twist)) * Motion::exponential(place);
        let change = self.turn_by(-self.angle) * change * self.turn_by(angle);
        let axes = self.rate * self.rotor.axis;
        let [twist, acceleration] =
            [reached.twist, reached.acceleration].map(|own| self.rotor.turned(-angle, &own));
        let node = NodeMotion {
            frame: from.frame * change,
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
            let own = &mut values[row - first..row - first + 3];
            let turned = Rotation::about_axis(&triple.axis, angle).apply(&Vector3::from_column_slice(own));
            own.copy_from_slice(turned.as_slice());
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

/// Cross products of both parts of a twist.
fn across(axes: &Vector3, twist: &Vector6) -> Vector6 {
    screw(&axes.cross(&translation_part(twist)), &axes.cross(&rotation_part(twist)))
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
        self.all.iter().filter(|own| own.is_still)
    }

    /// Uses axes that do not spin for no node.
    pub(crate) fn clear(&mut self) {
        self.all.clear();
    }

    /// Excludes rotors of which equations in their axes are among these omitted ones, by unknown, from the next step on.
    pub(crate) fn omit(&mut self, omitted: &[usize]) {
        for own in &mut self.all {
            let is_omitted = |row: &usize| (*row..row + 3).any(|row| omitted.contains(&row));
            own.is_complete = !own.triples.iter().any(is_omitted);
        }
    }

    /// Begins a step of `size` [s].
    pub(crate) fn begin(&mut self, start: &Kinematics, size: f64) {
        self.all.iter_mut().for_each(|own| own.begin(&start.nodes[own.rotor.node], size));
    }

    /// The tangent is assembled `time` [s] after the start of the step.
    pub(crate) fn note_tangent(&mut self, time: f64) {
        self.all.iter_mut().for_each(|own| own.of_tangent = own.angle_after(time));
    }

    /// Drift at a time after the start [s], for derivatives.
    pub(crate) fn write_drifts(&self, start: &Kinematics, time: f64, out: &mut Vec<AxisSpin>) {
        out.clear();
        out.extend(self.iter().map(|own| AxisSpin {
            node: own.node(),
            spin: own.rate * own.rotor.axis,
            drift: own.rotor.turned(-own.angle_after(time), &own.still(&start.nodes[own.node()]).twist),
        }));
    }

    /// Turns components by row, of the nodes and, if there are so many rows, of equations in their axes.
    pub(crate) fn turn(&self, values: &mut [f64], [from, to]: [Axes; 2]) {
        for own in self.iter() {
            let angle = own.angle_in(from) - own.angle_in(to);
            own.turn_node(values, angle);
            if values.len() > self.first_multiplier && own.is_complete {
                own.turn_triples(values, 0, angle);
            }
        }
    }

    /// Turns multipliers, given without the other unknowns.
    pub(crate) fn turn_multipliers(&self, multipliers: &mut [f64], [from, to]: [Axes; 2]) {
        for own in self.iter().filter(|own| own.is_complete) {
            own.turn_triples(multipliers, self.first_multiplier, own.angle_in(from) - own.angle_in(to));
        }
    }

    /// Whether there are none.
    pub(crate) fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// The rotor of a node, if its increments are in axes that do not spin.
    pub(crate) fn of(&self, node: NodeId) -> Option<&Spin> {
        self.iter().find(|own| own.node() == node)
    }

    /// Squared angular velocity of a node that steps must resolve [rad²/s²].
    pub(crate) fn turning(&self, node: NodeId, twist: &Vector6) -> f64 {
        self.of(node).map_or_else(|| rotation_part(twist).norm_squared(), |own| own.rotor.swing(twist))
    }

    /// A twist at a time after the start [s], of rotors in axes of the start that do not spin.
    pub(crate) fn seen_from_start(&self, node: NodeId, time: f64, twist: &Vector6) -> Vector6 {
        self.of(node).map_or(*twist, |own| own.rotor.turned(own.rate * time, twist))
    }

    /// Angles at which the tangent in use was assembled.
    pub(crate) fn angles_of_tangent(&self) -> Vec<f64> {
        self.all.iter().map(|own| own.of_tangent).collect()
    }

    /// Restores these angles.
    pub(crate) fn restore(&mut self, angles: &[f64]) {
        self.all.iter_mut().zip(angles).for_each(|(own, angle)| own.of_tangent = *angle);
    }
}

#[cfg(test)]
#[path = "../tests/unit/spin.rs"]
mod tests;
