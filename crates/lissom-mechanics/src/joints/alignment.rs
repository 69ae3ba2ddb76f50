//! Directions of a slider's tip that remain perpendicular to its line: the tip rotates with the tangent, or with the sections as
//! well.
//!
//! Legend: d = R_t e direction of the tip, y(s) = Σ w_k⁽ᵖ⁾(s) u_k perpendicular vector: the tangent with positions u_k = x_k and
//! p = 1, or an axis of the sections with their directions u_k = R_k g_k and p = 0; o_k the point of a node in its axes.
//!
//! ```text
//! c = d · y = 0,      c̈ = d̈ · y + 2 ḋ · ẏ + d · ÿ
//! forces Bᵀ μ: tip e × R_tᵀ y μ,   node k: w_k⁽ᵖ⁾ [R_kᵀ d, o_k × R_kᵀ d] μ or w_k⁽ᵖ⁾ g_k × R_kᵀ d μ,   s: d · y' μ
//! ```
//!
//! The weights of a tangent sum to zero, so that its forces are a couple, balanced by the moment on the tip: momentum and
//! angular momentum are conserved.

use lissom_motion::{Matrix3, Vector3, skew};

use super::slider::{CarriedPoint, LOCAL, LinePosition, OWN, Row, TIP};
use crate::joints::evaluation_point::Increments;
use crate::kinematics::{Kinematics, NodeMotion};

/// Vector to which a direction of the tip remains perpendicular.
#[derive(Clone, Debug, PartialEq)]
pub enum Across {
    /// The tangent of the line.
    Tangent,
    /// Directions fixed to the nodes, in their axes, interpolated as their positions are.
    Sections(Vec<Vector3>),
}

/// A direction of the tip, in its axes, and the vector to which it remains perpendicular.
#[derive(Clone, Debug, PartialEq)]
pub struct Alignment {
    /// A unit vector in the axes of the tip.
    pub direction: Vector3,
    /// The vector on the line that it is perpendicular to.
    pub across: Across,
}

/// An alignment of a slider with these nodes and this tip.
#[derive(Clone, Copy)]
pub(crate) struct Aligned<'a> {
    pub alignment: &'a Alignment,
    pub nodes: &'a [CarriedPoint],
    pub tip: &'a CarriedPoint,
}

/// Second time derivative of a direction, without angular acceleration, in inertial axes.
fn turning(motion: &NodeMotion, direction: &Vector3) -> [Vector3; 2] {
    let spin = motion.twist.fixed_rows::<3>(3).into_owned();
    let rate = spin.cross(direction);
    [rate, spin.cross(&rate)].map(|own| motion.frame.rotation.apply(&own))
}

impl Aligned<'_> {
    /// Order of the derivative of the nodes' vectors with respect to s in the perpendicular vector.
    fn order(&self) -> usize {
        usize::from(self.alignment.across == Across::Tangent)
    }

    fn motion<'m>(&self, node: usize, at: &'m Kinematics) -> &'m NodeMotion {
        &at.nodes[self.nodes[node].node]
    }

    /// u_k.
    pub(crate) fn vector(&self, node: usize, at: &Kinematics) -> Vector3 {
        match &self.alignment.across {
            Across::Tangent => self.nodes[node].place(at),
            Across::Sections(directions) => self.motion(node, at).frame.rotation.apply(&directions[node]),
        }
    }

    /// Change of u_k since the start of a step, without cancellation.
    fn vector_change(&self, node: usize, increments: &Increments<'_>) -> Vector3 {
        match &self.alignment.across {
            Across::Tangent => self.nodes[node].shift(increments),
            Across::Sections(directions) => {
                let own = self.nodes[node].node;
                let local = increments.nodes[own].turn * directions[node];
                increments.start.nodes[own].frame.rotation.apply(&local)
            }
        }
    }

    /// u̇_k, and the terms of ü_k without accelerations of the node.
    fn vector_rates(&self, node: usize, at: &Kinematics) -> [Vector3; 2] {
        let motion = self.motion(node, at);
        match &self.alignment.across {
            Across::Tangent => {
                let point = &self.nodes[node].point;
                let still = NodeMotion { acceleration: lissom_motion::Vector6::zeros(), ..*motion };
                [motion.velocity_at(point), still.acceleration_at(point)]
            }
            Across::Sections(directions) => turning(motion, &directions[node]),
        }
    }

    /// Derivative of u_k with respect to translation and rotation of its node in body axes: R_k [I, -õ] or R_k [0,
    /// -g̃].
    fn vector_gradient(&self, node: usize, at: &Kinematics) -> [Matrix3; 2] {
        let axes = self.motion(node, at).frame.rotation.matrix();
        match &self.alignment.across {
            Across::Tangent => [axes, -axes * skew(&self.nodes[node].point)],
            Across::Sections(directions) => [Matrix3::zeros(), -axes * skew(&directions[node])],
        }
    }

    /// d.
    fn direction(&self, at: &Kinematics) -> Vector3 {
        at.nodes[self.tip.node].frame.rotation.apply(&self.alignment.direction)
    }

    /// A derivative of y with respect to s.
    fn across(&self, place: &LinePosition, derivative: usize, at: &Kinematics) -> Vector3 {
        place.support.sum(self.order() + derivative, |node| self.vector(node, at))
    }

    /// c, evaluated from absolute positions.
    pub(crate) fn violation(&self, place: &LinePosition, at: &Kinematics) -> f64 {
        self.direction(at).dot(&self.across(place, 0, at))
    }

    /// Change of c since the start of a step, without cancellation. `slid` is the change of y due to s only, for the vectors at
    /// the start.
    pub(crate) fn violation_change(
        &self,
        after: &LinePosition,
        slid: impl Fn(usize, &dyn Fn(usize) -> Vector3) -> Vector3,
        increments: &Increments<'_>,
    ) -> f64 {
        let start = increments.start;
        let order = self.order();
        let own = self.tip.node;
        let before = self.direction(start);
        let turned =
            start.nodes[own].frame.rotation.apply(&(increments.nodes[own].turn * self.alignment.direction));
        let increment = after.support.sum(order, |node| self.vector_change(node, increments));
        let slid = slid(order, &|node| self.vector(node, start));
        let at_end = after.support.sum(order, |node| self.vector(node, start)) + increment;
        turned.dot(&at_end) + before.dot(&(increment + slid))
    }

    /// B.
    pub(crate) fn gradient(&self, place: &LinePosition, at: &Kinematics) -> Row {
        let mut row = [0.0; LOCAL];
        let direction = self.direction(at);
        for (k, weight) in place.weights(self.order()) {
            let own = self.vector_gradient(place.support.first + k, at);
            for (part, block) in own.iter().enumerate() {
                let entries = weight * block.tr_mul(&direction);
                row[6 * k + 3 * part..6 * k + 3 * part + 3].copy_from_slice(entries.as_slice());
            }
        }
        let tip = at.nodes[self.tip.node].frame.rotation;
        let moment = self.alignment.direction.cross(&tip.apply_inverse(&self.across(place, 0, at)));
        row[6 * TIP + 3..6 * TIP + 6].copy_from_slice(moment.as_slice());
        row[OWN] = direction.dot(&self.across(place, 1, at));
        row
    }

    /// Adds the derivatives of Bᵀ μ at a constant multiplier.
    pub(crate) fn add_hessian(&self, place: &LinePosition, at: &Kinematics, mu: f64, out: &mut [Row; LOCAL]) {
        let mut add = |row: usize, column: usize, block: &Matrix3| {
            for i in 0..3 {
                for j in 0..3 {
                    out[row + i][column + j] += mu * block[(i, j)];
                }
            }
        };
        let rotation = at.nodes[self.tip.node].frame.rotation;
        let axes = rotation.matrix();
        let direction = self.direction(at);
        let own = skew(&self.alignment.direction);
        let turns = 6 * TIP + 3;
        // δd = -R ẽ δθ, and y in the axes of the rotating tip: δ(Rᵀ y) = (Rᵀ y)~ δθ.
        let by_tip = -axes * own;
        add(turns, turns, &(own * skew(&rotation.apply_inverse(&self.across(place, 0, at)))));
        for (k, weight) in place.weights(self.order()) {
            let node = place.support.first + k;
            let force = weight * self.motion(node, at).frame.rotation.apply_inverse(&direction);
            let turned = skew(&force);
            match &self.alignment.across {
                Across::Tangent => {
                    add(6 * k, 6 * k + 3, &turned);
                    add(6 * k + 3, 6 * k + 3, &(skew(&self.nodes[node].point) * turned));
                }
                Across::Sections(directions) => {
                    add(6 * k + 3, 6 * k + 3, &(skew(&directions[node]) * turned));
                }
            }
            for (part, block) in self.vector_gradient(node, at).iter().enumerate() {
                let mixed: Matrix3 = weight * block.transpose() * by_tip;
                add(6 * k + 3 * part, turns, &mixed);
                add(turns, 6 * k + 3 * part, &mixed.transpose());
            }
        }
        let mut along = |row: usize, value: f64| {
            out[row][OWN] += mu * value;
            out[OWN][row] += mu * value;
        };
        for (k, weight) in place.weights(self.order() + 1) {
            for (part, block) in self.vector_gradient(place.support.first + k, at).iter().enumerate() {
                let entries = weight * block.tr_mul(&direction);
                (0..3).for_each(|i| along(6 * k + 3 * part + i, entries[i]));
            }
        }
        let moment = by_tip.tr_mul(&self.across(place, 1, at));
        (0..3).for_each(|i| along(turns + i, moment[i]));
        out[OWN][OWN] += mu * direction.dot(&self.across(place, 2, at));
    }

    /// The terms of c̈ other than B v̇.
    pub(crate) fn acceleration(&self, place: &LinePosition, at: &Kinematics, rate: f64) -> f64 {
        let order = self.order();
        let [turning, bending] = turning(&at.nodes[self.tip.node], &self.alignment.direction);
        let of = |derivative: usize, part: usize| {
            place.support.sum(order + derivative, |node| self.vector_rates(node, at)[part])
        };
        let speed = of(0, 0) + rate * self.across(place, 1, at);
        let acceleration = of(0, 1) + 2.0 * rate * of(1, 0) + rate * rate * self.across(place, 2, at);
        bending.dot(&self.across(place, 0, at))
            + 2.0 * turning.dot(&speed)
            + self.direction(at).dot(&acceleration)
    }

    /// Moment on the tip for a multiplier, in inertial axes [N m].
    pub(crate) fn moment(&self, place: &LinePosition, at: &Kinematics, mu: f64) -> Vector3 {
        mu * self.direction(at).cross(&self.across(place, 0, at))
    }
}
