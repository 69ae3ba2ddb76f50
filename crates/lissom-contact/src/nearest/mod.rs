//! Contact of two curves where they are nearest, without friction: of a beam with another, with a ball or a capsule.
//!
//! Legend: P_a points of both curves, which nodes carry, W_a their weights, negative for the base, p = (s, t) parameters of both curves,
//! D = Σ W_a P_a from base to tip, h = |D|, n = D/h, Q = I - n nᵀ, r sum of the radii, g = h - r gap, φ_a = W_a n, N normal force,
//! χ product of the shares of both intervals, see [`CarriedCurve`].
//!
//! ```text
//! g = min h - r,   δg = Σ φ_a·δP_a,      G = ∂²g/∂P² = h_PP - h_Pp h_pp⁻¹ h_pP
//! h_ab = W_a W_b Q/h,   h_ap = ∂W_a/∂p n + W_a Q D_p/h,   h_pq = n·D_pq + D_p·Q D_q/h
//! forces on the left-hand side: -χ N φ_a,      energy χ P(-g),      δp = -h_pp⁻¹ h_pP δP
//! ```

mod carried_curve;
mod nearest_points;

pub use carried_curve::{CarriedCurve, CarriedPoint};

use lissom_motion::{Matrix3, Vector3, rotation_part, skew, translation_part};
use nalgebra::Matrix3x6;

use super::least_distance::PARALLEL;
use crate::force_over_gap::{Distance, ForceOverGap};
use crate::geometry::gap::side_by_side;
use crate::reading::{ContactElement, ContactReading};
use lissom_mechanics::compliance::Compliance;
use lissom_mechanics::elements::{
    Capabilities, Element, Energy, ForceLaws, Limit, LimitKind, Spring, Tangents, Unknowns, Validity,
    add_block,
};
use lissom_mechanics::evaluation::switch_states::{SwitchStates, frozen_branch, is_on_upper_branch};
use lissom_mechanics::joints::centerline::SUPPORT;
use lissom_mechanics::kinematics::{GROUND, Kinematics, NodeId, Switch};
use lissom_mechanics::law::{Interval, VisitLaw};
use lissom_mechanics::signals::measurement::Gradient;
use nearest_points::{Nearest, Placed, chord_distance, nearest};

/// Points of both curves.
const MAX_POINTS: usize = 2 * SUPPORT;
/// Numbers of the law: two ends of the tip and one of the base.
const ARGUMENTS: usize = 9;

/// Two curves that may touch where they are nearest.
#[derive(Clone, Debug)]
pub struct NearestContact {
    /// Tip and base.
    curves: [CarriedCurve; 2],
    /// Radius of the base, and r [m].
    base_radius: f64,
    radius: f64,
    compliance: Compliance,
    /// Relative increase of the normal force per penetration velocity [s/m].
    dissipation: f64,
    /// Nodes, each once, without the ground; and the slot of each point among them.
    nodes: Vec<NodeId>,
    slots: Vec<Option<usize>>,
    switch_states: SwitchStates,
}

/// The curves where they are nearest.
struct Touch {
    count: usize,
    /// W_a, and their derivatives by s and t.
    weights: [f64; MAX_POINTS],
    weights_by: [[f64; 2]; MAX_POINTS],
    distance: f64,
    /// y [m].
    base: Vector3,
    /// n.
    normal: Vector3,
    /// Q D_p/h + terms along n: the parts of h_ap by W_a.
    across_by: [Vector3; 2],
    /// h_pp⁻¹ of the free parameters, zero for others.
    inverse: [[f64; 2]; 2],
    /// χ and its derivatives by s and t.
    share: [f64; 3],
    is_touching: bool,
    /// ġ [m/s].
    rate: f64,
    /// Relative velocity of the points that touch [m/s].
    velocity: Vector3,
    /// N and its derivatives by penetration and its rate.
    force: [f64; 3],
}

impl NearestContact {
    /// Between the curves of base and tip with their radii [m].
    pub fn new(
        [base, tip]: [CarriedCurve; 2],
        [base_radius, tip_radius]: [f64; 2],
        (compliance, dissipation): (Compliance, f64),
    ) -> Self {
        let radius = base_radius + tip_radius;
        let mut nodes: Vec<NodeId> = Vec::new();
        let all = tip.points().iter().chain(base.points());
        for (node, _) in all.clone() {
            if *node != GROUND && !nodes.contains(node) {
                nodes.push(*node);
            }
        }
        let slots = all.map(|(node, _)| nodes.iter().position(|own| own == node)).collect();
        let switch_states = SwitchStates::default();
        Self {
            curves: [tip, base],
            base_radius,
            radius,
            compliance,
            dissipation,
            nodes,
            slots,
            switch_states,
        }
    }

    fn points(&self) -> impl Iterator<Item = &(NodeId, Vector3)> {
        self.curves[0].points().iter().chain(self.curves[1].points())
    }

    fn nearest(&self, at: &Kinematics) -> Nearest {
        nearest(&self.curves.each_ref().map(|curve| {
            let mut points = [Vector3::zeros(); SUPPORT];
            for (place, (node, point)) in points.iter_mut().zip(curve.points()) {
                *place = at.nodes[*node].frame.transform_point(point);
            }
            Placed { curve, points }
        }))
    }

    fn touch(&self, at: &Kinematics) -> Touch {
        let Nearest { on, is_free } = self.nearest(at);
        let tips = self.curves[0].points().len();
        let mut weights = [0.0; MAX_POINTS];
        let mut weights_by = [[0.0; 2]; MAX_POINTS];
        for (side, sign) in [(0, 1.0), (1, -1.0)] {
            for k in 0..self.curves[side].points().len() {
                let own = &on[side].weights.0;
                weights[side * tips + k] = sign * own[0][k];
                weights_by[side * tips + k][side] = sign * own[1][k];
            }
        }
        let difference = on[0].place[0] - on[1].place[0];
        let distance = difference.norm();
        // Where the curves meet every direction is normal.
        let normal = if distance > 0.0 { difference / distance } else { Vector3::x() };
        let across = (Matrix3::identity() - normal * normal.transpose()) / distance.max(f64::MIN_POSITIVE);
        let along = [on[0].place[1], -on[1].place[1]];
        let across_by = along.map(|along| across * along);
        let bend = [normal.dot(&on[0].place[2]), -normal.dot(&on[1].place[2])];
        let entry = |p: usize, q: usize| along[p].dot(&across_by[q]) + if p == q { bend[p] } else { 0.0 };
        let [a, b, d] = [entry(0, 0), entry(0, 1), entry(1, 1)];
        let inverse = match is_free {
            [true, true] if a * d - b * b > PARALLEL * a * d => {
                let determinant = a * d - b * b;
                [[d / determinant, -b / determinant], [-b / determinant, a / determinant]]
            }
            [true, _] if a > 0.0 => [[1.0 / a, 0.0], [0.0; 2]],
            [false, true] if d > 0.0 => [[0.0; 2], [0.0, 1.0 / d]],
            _ => [[0.0; 2]; 2],
        };
        let shares = [0, 1].map(|side| self.curves[side].share(on[side].parameter));
        let share = [shares[0][0] * shares[1][0], shares[0][1] * shares[1][0], shares[0][0] * shares[1][1]];
        let velocity: Vector3 = self
            .points()
            .zip(weights)
            .map(|((node, point), weight)| weight * at.nodes[*node].velocity_at(point))
            .sum();
        let rate = normal.dot(&velocity);
        let gap = distance - self.radius;
        let is_touching = is_on_upper_branch(self.switch_states.of(at).first(), -gap);
        let force = if is_touching { self.compliance.force(-gap, -rate, self.dissipation) } else { [0.0; 3] };
        Touch {
            count: self.slots.len(),
            weights,
            weights_by,
            distance,
            base: on[1].place[0],
            normal,
            across_by,
            inverse,
            share,
            is_touching,
            rate,
            velocity,
            force,
        }
    }

    /// Derivatives of a point by the variation of its node: R [I, -c̃].
    fn carried(at: &Kinematics, (node, point): &CarriedPoint) -> Matrix3x6<f64> {
        let rotation = at.nodes[*node].frame.rotation.matrix();
        side_by_side(&rotation, &(-rotation * skew(point)))
    }
}

impl Touch {
    /// h_ap.
    fn by_parameter(&self, a: usize, p: usize) -> Vector3 {
        self.weights_by[a][p] * self.normal + self.weights[a] * self.across_by[p]
    }

    /// Σ_q (h_pp⁻¹)_pq h_aq: minus the derivatives of p by P_a.
    fn moved(&self, a: usize) -> [Vector3; 2] {
        let by = [0, 1].map(|p| self.by_parameter(a, p));
        [0, 1].map(|p: usize| self.inverse[p][0] * by[0] + self.inverse[p][1] * by[1])
    }

    /// G_ab.
    fn bend(&self, a: usize, b: usize) -> Matrix3 {
        let across = Matrix3::identity() - self.normal * self.normal.transpose();
        let moved = self.moved(b);
        let mut sum = self.weights[a] * self.weights[b] / self.distance.max(f64::MIN_POSITIVE) * across;
        for (p, moved) in moved.iter().enumerate() {
            sum -= self.by_parameter(a, p) * moved.transpose();
        }
        sum
    }
}

impl Element for NearestContact {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.nodes)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let touch = self.touch(at);
        let force = touch.share[0] * touch.force[0];
        if force == 0.0 {
            return;
        }
        for (a, (slot, point)) in self.slots.iter().zip(self.points()).enumerate() {
            let Some(slot) = slot else { continue };
            let own = Self::carried(at, point).tr_mul(&(-force * touch.weights[a] * touch.normal));
            out[6 * slot..6 * slot + 6].iter_mut().zip(&own).for_each(|(sum, own)| *sum += own);
        }
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let touch = self.touch(at);
        if !touch.is_touching {
            return;
        }
        let (n, size) = (touch.normal, out.size());
        let ([force, by_depth, by_closing], [share, share_by_s, share_by_t]) = (touch.force, touch.share);
        let mut velocities = [Vector3::zeros(); MAX_POINTS];
        for (velocity, (node, point)) in velocities.iter_mut().zip(self.points()) {
            *velocity = at.nodes[*node].velocity_at(point);
        }
        // Derivatives of χ N by P_b and by its velocity.
        let mut by_place = [Vector3::zeros(); MAX_POINTS];
        for (b, by_place) in by_place.iter_mut().enumerate().take(touch.count) {
            let mut rate_by = Vector3::zeros();
            for (a, velocity) in velocities.iter().enumerate().take(touch.count) {
                rate_by += touch.bend(a, b).tr_mul(velocity);
            }
            let moved = touch.moved(b);
            *by_place = -share * (by_depth * touch.weights[b] * n + by_closing * rate_by)
                - force * (share_by_s * moved[0] + share_by_t * moved[1]);
        }
        let by_rate = |b: usize| -share * by_closing * touch.weights[b] * n;
        for (b, (column, point)) in self.slots.iter().zip(self.points()).enumerate() {
            let Some(column) = column else { continue };
            let columns = Self::carried(at, point);
            let node = &at.nodes[point.0];
            let rotation = node.frame.rotation.matrix();
            // Of the velocity of the point by the rotation of its node.
            let (v, w) = (translation_part(&node.twist), rotation_part(&node.twist));
            let turning = side_by_side(&Matrix3::zeros(), &(-rotation * skew(&(v + w.cross(&point.1)))));
            for (a, (row, own)) in self.slots.iter().zip(self.points()).enumerate() {
                let Some(row) = row else { continue };
                let rows = Self::carried(at, own);
                let direction = touch.weights[a] * n;
                let by = -share * force * touch.bend(a, b) - direction * by_place[b].transpose();
                let by_speed = -direction * by_rate(b).transpose();
                let mut block = rows.tr_mul(&(by * columns + by_speed * turning));
                if a == b {
                    // Rᵀ f turns with the node.
                    let local = rotation.tr_mul(&(-share * force * direction));
                    let turned = side_by_side(&Matrix3::zeros(), &skew(&local));
                    block += side_by_side(&Matrix3::identity(), &-skew(&own.1)).tr_mul(&turned);
                }
                let place = (6 * row, 6 * column);
                add_block(&mut out.stiffness, size, place, &block);
                add_block(&mut out.damping, size, place, &rows.tr_mul(&(by_speed * columns)));
            }
        }
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        if self.is_idle(at) {
            return Energy::default();
        }
        let touch = self.touch(at);
        let depth = self.radius - touch.distance;
        let strain = if touch.is_touching { touch.share[0] * self.compliance.energy(depth) } else { 0.0 };
        Energy { strain, ..Energy::default() }
    }

    fn switch_states(&mut self) -> Option<&mut SwitchStates> {
        Some(&mut self.switch_states)
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { spring: Some(self), validity: Some(self), laws: Some(self), ..Capabilities::default() }
    }
}

impl ContactElement for NearestContact {
    fn reading(&self, at: &Kinematics) -> ContactReading {
        let touch = self.touch(at);
        let normal = touch.share[0] * touch.force[0];
        ContactReading {
            gap: touch.distance - self.radius,
            normal,
            force: normal * touch.normal,
            friction: Vector3::zeros(),
            slip: (touch.velocity - touch.rate * touch.normal).norm(),
            point: touch.base + self.base_radius * touch.normal,
            is_touching: touch.is_touching && touch.share[0] > 0.5,
            is_sliding: touch.is_touching && touch.share[0] > 0.5,
        }
    }
}

impl Spring for NearestContact {
    fn dissipates(&self) -> bool {
        self.dissipation > 0.0
    }

    fn spring_motion(&self, at: &Kinematics) -> [f64; 3] {
        let touch = self.touch(at);
        [touch.distance - self.radius, touch.rate, touch.share[0] * touch.force[0]]
    }

    fn spring_gradients(&self, _: &Kinematics) -> Option<[Gradient; 3]> {
        None
    }
}

impl Validity for NearestContact {
    fn limits(&self) -> &'static [LimitKind] {
        &[LimitKind::Depth]
    }

    /// Beyond the axes the force would be in the opposite direction.
    fn limit(&self, kind: LimitKind, [_, at]: [&Kinematics; 2]) -> Option<Limit<'_>> {
        if kind != LimitKind::Depth || self.is_idle(at) {
            return None;
        }
        let depth = self.radius - self.touch(at).distance;
        Some(Limit::of_element(depth, 0.5 * self.radius))
    }
}

impl ForceLaws for NearestContact {
    fn switch_count(&self) -> usize {
        1
    }

    fn is_idle(&self, at: &Kinematics) -> bool {
        frozen_branch(self.switch_states.of(at).first()) == Some(false)
    }

    fn switches(&self, at: &Kinematics, out: &mut Vec<Switch>) {
        let [tip, base] = self.nearest(at).on;
        out.push((self.radius - (tip.place[0] - base.place[0]).norm()).into());
    }

    fn laws(&self, at: &Kinematics, visit: &mut VisitLaw<'_>) {
        let place = |(node, point): &CarriedPoint| at.nodes[*node].frame.transform_point(point);
        let ends = self.curves.each_ref().map(|curve| {
            if let Some(ends) = curve.end_points() {
                return ends.map(|k| place(&curve.points()[k]));
            }
            let weights = curve.weights(0.0).0[0];
            let point: Vector3 =
                weights.iter().zip(curve.points()).map(|(weight, own)| *weight * place(own)).sum();
            [point; 2]
        });
        let [tip, base] = ends;
        let mut arguments = [0.0; ARGUMENTS];
        for (k, vector) in [tip[0] - base[0], tip[1] - base[0], base[1] - base[0]].iter().enumerate() {
            arguments[3 * k..3 * k + 3].copy_from_slice(vector.as_slice());
        }
        let gap = ChordDistance { radius: self.radius };
        visit(&ForceOverGap { gap, compliance: self.compliance }, &arguments);
    }
}

/// The distance of the straight lines between the ends of both curves, as a function of these ends: it changes by no more than they do.
struct ChordDistance {
    radius: f64,
}

impl Distance for ChordDistance {
    fn at(&self, arguments: &[f64]) -> f64 {
        let [from, to, base] = [0, 3, 6].map(|k| Vector3::from_column_slice(&arguments[k..k + 3]));
        chord_distance([from, to], &base) - self.radius
    }

    fn range(&self, arguments: &[Interval]) -> Interval {
        let middle: [f64; ARGUMENTS] = std::array::from_fn(|k| 0.5 * (arguments[k][0] + arguments[k][1]));
        let half = |from: usize| {
            let all = &arguments[from..from + 3];
            all.iter().map(|[low, high]| 0.25 * (high - low) * (high - low)).sum::<f64>().sqrt()
        };
        let change = half(0).max(half(3)) + half(6);
        let gap = self.at(&middle);
        [gap - change, gap + change]
    }
}
