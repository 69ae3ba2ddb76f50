//! The force at a point of contact over the displacement of the tip's point relative to the base's in a step.
//!
//! Legend, with axes t₁, t₂, n fixed in the step and n out of the base: d displacement, φ gap at the start of the step, h its length,
//! w inverse effective mass, z deflection of the bristle at the start, K its stiffness, N bound of the normal force.
//!
//! ```text
//! x = -φ - d_n,      f_n = P'(x) max(0, 1 - a d_n/h)
//! s = K (z + d_t),   f_t = -s where |s| ≤ μ N,   -μ N s/|s| otherwise
//! K = min(k, 1/(σ h² w)),      σ = 0.1
//! ```
//!
//! A bristle is no stiffer than a step resolves; it returns to the bound where it slips, so that a sticking part does not creep. With N
//! fixed the force is minus the gradient of a convex function of d, and K + ∂²P positive semidefinite.
//!
//! Where a step does not resolve a touch, h > T/500 with its duration T, the scheme would damp an impact, and an impact with restitution
//! stops in its first step instead, see [`impact`](super::impact). Its force is near-rigid then, with x = -φ - δ - d_n:
//!
//! ```text
//! f_n = max(0, x) max(1/(R h²), k),      R = w/10⁴,      K = 1/(σ h² w),      no friction if the impact gives it
//! ```
//!
//! It is not softer than the elastic force of the next step, which would have more energy.
//!
//! A touch that appears with a penetration, as where a corner changes its face, has no energy: its relief δ is this penetration. The same
//! holds for a penetration that jumps.

use lissom_motion::{Matrix3, Motion, Vector3, Vector6, skew};
use nalgebra::Vector2;

use super::near_points::SHORT;
use crate::contact::forms::Meeting;
use crate::contact::geometry::gap::Matrix3x6;
use crate::contact::law::Impact;
use crate::contact::set::{TouchLaw, placed};
use crate::impacts::tangents;
use crate::kinematics::{Kinematics, LOCKED, Layout, MotionChange, NodeId, split};
use crate::system::{Touch, TouchKey};

/// σ: a bristle moves a free part by a tenth of the step's displacement at most.
const BRISTLE_SHARE: f64 = 0.1;
/// Steps longer than this share of a touch lose more than 1 % of its velocity: (π h/T)²/2 per period 2 T/π.
const RESOLVED_SHARE: f64 = 0.002;
/// Velocity of impact of laws without a velocity of rest below which touches have the same duration [m/s].
const SLOWEST_IMPACT: f64 = 1e-3;
/// Largest product of the dissipation factor and the velocity of impact of touches that steps do not resolve: parts at rest with a
/// small restitution would take seconds to sink to their depth.
const SETTLING: f64 = 0.1;
/// R over w of a touch in the first step of an impact.
const NEAR_RIGID: f64 = 1e-4;

/// What a point needs of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepOfPoint {
    /// Length h [s].
    pub(crate) size: f64,
    /// Length of the planned step that contains it [s].
    pub(crate) planned: f64,
    /// Inverse effective mass w of both parts [1/kg].
    pub(crate) compliance: f64,
    /// Radius of the smaller part [m].
    pub(crate) radius: f64,
    /// Whether the motion begins: parts that overlap then are pushed apart.
    pub(crate) is_first: bool,
}

/// Where a point is at the start of the step, in inertial axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Rows t₁, t₂, n.
    axes: Matrix3,
    /// Point of contact [m].
    point: Vector3,
    /// From the nodes' positions to it [m].
    arms: [Vector3; 2],
    /// φ [m].
    pub(crate) gap: f64,
    /// Penetration at which the solids are within each other [m].
    deepest: f64,
}

impl Place {
    /// The point of a meeting of two parts whose nodes have these frames; none if its gap is larger than `reach` [m].
    pub(crate) fn of(meeting: &Meeting, frames: [Motion; 2], reach: f64) -> Option<Self> {
        Self::within(meeting, frames, reach).ok()
    }

    /// As [`of`](Self::of); the gap if it is larger than `reach` [m].
    pub(crate) fn within(meeting: &Meeting, frames: [Motion; 2], reach: f64) -> Result<Self, f64> {
        let (base, tip) = placed(meeting, frames);
        // Of curves the value alone costs as much.
        let gap = meeting.pair.gap(&tip.position, &tip.rotation.matrix());
        if gap.value > reach {
            return Err(gap.value);
        }
        let normal = base.rotation.apply(&gap.normal);
        let point = base.transform_point(&gap.point);
        let arms = meeting.sides.map(|side| point - frames[side].position);
        Ok(Self { axes: axes_of(&normal), point, arms, gap: gap.value, deepest: meeting.pair.deepest() })
    }

    /// Normal in inertial axes towards the second of both parts.
    pub(crate) fn normal(&self, meeting: &Meeting) -> Vector3 {
        let normal = self.axes.row(2).transpose();
        if meeting.sides == [1, 0] { -normal } else { normal }
    }

    /// Velocity of the tip's point relative to the base's in the axes of the point, for velocities and angular velocities of both parts in
    /// inertial axes [m/s].
    pub(crate) fn relative_velocity(&self, meeting: &Meeting, twists: [[Vector3; 2]; 2]) -> Vector3 {
        let of = |k: usize| {
            let [velocity, spin] = twists[meeting.sides[k]];
            velocity + spin.cross(&self.arms[k])
        };
        self.axes * (of(1) - of(0))
    }
}

/// Progress of a touch at the start of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Phase {
    /// The parts touched at the end of the last step.
    Lasting,
    /// They did not.
    Beginning,
    /// They did not, and approach so fast that the impact has a restitution, which the step does not resolve.
    Impact,
}

/// What the force of a touch in a step depends on beside its law.
#[derive(Clone, Copy, Debug)]
struct Response {
    /// Dissipation factor a [s/m].
    dissipation: f64,
    /// δ [m].
    relief: f64,
    /// 1/(R h²), in the first step of an impact [N/m].
    near_rigid: Option<f64>,
    /// z.
    bristle: [f64; 2],
    /// K [N/m].
    stiffness: f64,
}

/// A point at which two parts may touch in a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TouchPoint {
    /// Where it is.
    pub(crate) key: TouchKey,
    /// Nodes of base and tip.
    pub(crate) nodes: [NodeId; 2],
    /// Whether the tip is the first part of the contact.
    is_reversed: bool,
    /// Velocity that a moving surface gives a tip that sticks to it, relative to the base [m/s].
    driven: Vector3,
    /// Whether the parts may touch soon.
    pub(crate) is_close: bool,
    place: Place,
    size: f64,
    law: TouchLaw,
    response: Response,
    /// Inverse effective mass w [1/kg].
    pub(crate) compliance: f64,
    pub(crate) phase: Phase,
    /// Whether the touch is shorter than what the step resolves.
    pub(crate) is_unresolved: bool,
    /// Velocity at which the parts approach at the start of the step [m/s].
    pub(crate) approach: f64,
    impact_velocity: f64,
    /// μ N [N].
    pub(crate) bound: f64,
}

/// Force at a point at some displacement, in its axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct TouchState {
    /// d [m].
    pub(crate) displacement: Vector3,
    /// f, on the tip [N].
    pub(crate) force: Vector3,
    /// -∂f/∂d [N/m].
    pub(crate) slope: Matrix3,
    /// Whether the bristle slips.
    slips: bool,
}

impl TouchPoint {
    /// The point of a meeting of two parts with these nodes at a place in a step, which continues a touch if there was one.
    pub(crate) fn at(
        (key, meeting, law): (TouchKey, &Meeting, &TouchLaw),
        nodes: [NodeId; 2],
        (start, step): (&Kinematics, StepOfPoint),
        (place, before): (Place, Option<&Touch>),
    ) -> Self {
        let driven = law.surface.map_or_else(Vector3::zeros, |(side, velocity)| {
            let sign = if meeting.sides[0] == side { 1.0 } else { -1.0 };
            sign * start.nodes[nodes[side]].frame.rotation.apply(&velocity)
        });
        let nodes = meeting.sides.map(|side| nodes[side]);
        let Place { axes, arms, gap, .. } = place;
        let normal = axes.row(2).transpose();
        let velocity = |k: usize| {
            let motion = &start.nodes[nodes[k]];
            motion.velocity_at(&motion.frame.rotation.apply_inverse(&arms[k]))
        };
        let closing = normal.dot(&(velocity(0) - velocity(1)));
        let impact_velocity = before.map_or(closing.max(0.0), |touch| touch.impact_velocity);
        let rest_velocity = law.impact.rest_velocity();
        let velocity = impact_velocity.max(rest_velocity.unwrap_or(SLOWEST_IMPACT));
        let duration = law.compliance.duration(1.0 / step.compliance, velocity);
        let is_unresolved = step.size > RESOLVED_SHARE * duration;
        let is_new = before.is_none();
        let relief = match before {
            Some(touch) => {
                // Beyond what turns and curvatures explain the gap has jumped, as where another part of an edge is nearest now.
                let motions = nodes.iter().zip(&arms).map(|(&node, arm)| {
                    let (velocity, spin) = split(&start.nodes[node].twist);
                    [velocity.norm() + spin.norm() * arm.norm(), spin.norm()]
                });
                let [speed, spin] = motions.fold([0.0; 2], |sum, own| [sum[0] + own[0], sum[1] + own[1]]);
                let path = step.size * speed;
                let curved = path * (step.size * spin + path / step.radius);
                let allowed = curved + step.size * rest_velocity.unwrap_or(SLOWEST_IMPACT);
                let deeper = touch.gap - gap;
                touch.relief + if deeper > allowed { deeper } else { 0.0 }
            }
            None if step.is_first => 0.0,
            None => (-gap).max(0.0),
        };
        let is_impact = is_unresolved && is_new && rest_velocity.is_some_and(|rest| closing > rest);
        let resolved = 1.0 / (step.size * step.size * step.compliance);
        // Parts of a planned step keep its bristles.
        let planned = 1.0 / (step.planned * step.planned * step.compliance);
        let phase = match before {
            Some(_) => Phase::Lasting,
            None if is_impact => Phase::Impact,
            None => Phase::Beginning,
        };
        let is_rigid = is_unresolved && is_new && rest_velocity.is_some() && (is_impact || gap >= 0.0);
        let resolved_bristle = if is_rigid { resolved } else { planned } / BRISTLE_SHARE;
        let is_soft = law.compliance.exponent == 1.0 && is_unresolved && !is_rigid;
        let stiffness =
            if is_soft { resolved_bristle.min(law.compliance.stiffness) } else { resolved_bristle };
        // A shorter step has stiffer bristles: neither their force nor their energy increases.
        let bristle = before.map_or([0.0; 2], |touch| {
            let kept = (touch.stiffness / stiffness).min(1.0);
            carried_bristle(&axes, &(kept * Vector3::from(touch.bristle)))
        });
        let response = Response {
            dissipation: law.impact.factor(impact_velocity, is_unresolved.then_some(SETTLING)),
            relief,
            near_rigid: is_rigid.then_some((resolved / NEAR_RIGID).max(law.compliance.linear_stiffness())),
            bristle,
            stiffness,
        };
        let mut found = Self {
            key,
            nodes,
            is_reversed: meeting.sides == [1, 0],
            driven,
            is_close: gap < SHORT * step.radius,
            place,
            size: step.size,
            law: *law,
            response,
            compliance: step.compliance,
            phase,
            is_unresolved,
            approach: closing,
            impact_velocity,
            bound: 0.0,
        };
        found.bound = found.friction_bound(before.map_or(0.0, |touch| touch.normal), 0.0);
        found
    }

    /// This point at another configuration.
    pub(crate) fn placed_at(&self, meeting: &Meeting, at: &Kinematics) -> Self {
        let mut nodes = self.nodes;
        for (side, node) in meeting.sides.into_iter().zip(self.nodes) {
            nodes[side] = node;
        }
        let frames = nodes.map(|node| at.nodes[node].frame);
        let place = Place::of(meeting, frames, f64::INFINITY).unwrap_or(self.place);
        Self { place, ..*self }
    }

    /// Velocity of the tip's point relative to the base's surface, in the axes of the point [m/s].
    pub(crate) fn velocity(&self, at: &Kinematics) -> Vector3 {
        let of = |k: usize| {
            let motion = &at.nodes[self.nodes[k]];
            motion.velocity_at(&motion.frame.rotation.apply_inverse(&self.place.arms[k]))
        };
        self.place.axes * (of(1) - of(0)) - self.drift()
    }

    /// Normal in inertial axes towards the second of both parts with these nodes, and its velocity relative to the first [m/s].
    pub(crate) fn motion_of_second(&self, at: &Kinematics, nodes: [NodeId; 2]) -> [Vector3; 2] {
        let normal = self.place.axes.row(2).transpose();
        let of = |k: usize| {
            let motion = &at.nodes[nodes[k]];
            motion.velocity_at(&motion.frame.inverse().transform_point(&self.place.point))
        };
        [if self.is_reversed { -normal } else { normal }, of(1) - of(0)]
    }

    /// Velocity of a moving surface, in the axes of the point [m/s].
    fn drift(&self) -> Vector3 {
        (self.place.axes * self.driven).xy().push(0.0)
    }

    /// A force at another configuration of the point, along the axes of this one: its normal part remains along the normal, so that it has
    /// no moment about the centre of a ball.
    pub(crate) fn turned(&self, from: &Self, force: &Vector3) -> Vector3 {
        let tangential = from.place.axes.tr_mul(&force.xy().push(0.0));
        (self.place.axes * tangential).xy().push(force.z)
    }

    /// Coefficient of restitution, if the law has one.
    pub(crate) fn restitution(&self) -> Option<f64> {
        match self.law.impact {
            Impact::Restitution { coefficient, .. } => Some(coefficient),
            Impact::Dissipation(_) => None,
        }
    }

    /// Velocity of slow impacts, which do not rebound [m/s].
    pub(crate) fn rest_velocity(&self) -> f64 {
        self.law.impact.rest_velocity().unwrap_or(0.0)
    }

    /// Whether the touch lasted, or began at rest, before a step of `size` [s].
    pub(crate) fn lasts_from(&self, size: f64) -> bool {
        let rest = self.rest_velocity();
        self.is_unresolved
            && (self.phase == Phase::Lasting || self.approach <= rest && self.place.gap <= rest * size)
    }

    /// Gap at the end of the step beyond the penetration without force [m].
    pub(crate) fn distance_at(&self, state: &TouchState) -> f64 {
        self.gap_at(state) + self.response.relief
    }

    /// Gap at the configuration of the point [m].
    pub(crate) fn gap(&self) -> f64 {
        self.place.gap
    }

    /// Adds the wrenches of a force on the tip, in the axes of the point, by row.
    pub(crate) fn add_wrenches(
        &self,
        force: &Vector3,
        (at, layout): (&Kinematics, &Layout),
        out: &mut [f64],
    ) {
        if *force == Vector3::zeros() {
            return;
        }
        for (side, node) in self.nodes.into_iter().enumerate() {
            let [force, moment] = self.wrench(side, force, at);
            for (&row, value) in layout.rows_of_node(node).iter().zip(force.iter().chain(moment.iter())) {
                if row != LOCKED {
                    out[row as usize] += value;
                }
            }
        }
    }

    /// Deflection of the bristle at the end of the step [m].
    fn bristle_at(&self, state: &TouchState) -> Vector2<f64> {
        match (self.law.friction, state.slips) {
            (None, _) => Vector2::zeros(),
            (Some(_), false) => Vector2::from(self.response.bristle) + state.displacement.xy(),
            (Some(_), true) => -state.force.xy() / self.response.stiffness,
        }
    }

    /// μ(s) N at a normal force [N] and a sliding velocity [m/s].
    fn friction_bound(&self, normal: f64, velocity: f64) -> f64 {
        if self.phase == Phase::Impact { 0.0 } else { self.friction_of(normal, velocity) }
    }

    /// μ(s) N at a normal force or impulse and a sliding velocity [m/s], also in an impact.
    pub(crate) fn friction_of(&self, normal: f64, velocity: f64) -> f64 {
        self.law.friction.map_or(0.0, |friction| friction.coefficient(velocity) * normal)
    }

    /// Sets the bound of the friction to that of a state. Returns by how much it changed [N].
    pub(crate) fn update_bound(&mut self, state: &TouchState) -> f64 {
        let velocity = state.displacement.xy().norm() / self.size;
        let bound = self.friction_bound(state.force.z, velocity);
        let change = bound - self.bound;
        self.bound = bound;
        change
    }

    /// d, relative to a moving surface, for the motion of both nodes in the step, from the `start`: displacements of the nodes, and
    /// rotations at the twists of the end.
    pub(crate) fn displacement(
        &self,
        start: &Kinematics,
        at: &Kinematics,
        changes: &[MotionChange],
    ) -> Vector3 {
        let of = |k: usize| {
            let node = self.nodes[k];
            let shift = start.nodes[node].frame.rotation.apply(&changes[node].shift);
            shift + self.size * at.nodes[node].angular_velocity().cross(&self.place.arms[k])
        };
        self.place.axes * (of(1) - of(0)) - self.size * self.drift()
    }

    /// The change of d by increments of both nodes in the axes of their bodies.
    pub(crate) fn change(&self, at: &Kinematics, increment: impl Fn(NodeId) -> Vector6) -> Vector3 {
        let of = |k: usize| {
            let node = self.nodes[k];
            let (shift, turn) = split(&increment(node));
            let rotation = &at.nodes[node].frame.rotation;
            rotation.apply(&shift) + rotation.apply(&turn).cross(&self.place.arms[k])
        };
        self.place.axes * (of(1) - of(0))
    }

    /// ∂d by increments of one of both nodes, in the axes of its body.
    pub(crate) fn gradient(&self, side: usize, at: &Kinematics) -> Matrix3x6 {
        let rotation = &at.nodes[self.nodes[side]].frame.rotation;
        let sign = if side == 1 { 1.0 } else { -1.0 };
        let axes = sign * self.place.axes * rotation.matrix();
        let arm = rotation.apply_inverse(&self.place.arms[side]);
        let mut all = Matrix3x6::zeros();
        all.fixed_columns_mut::<3>(0).copy_from(&axes);
        all.fixed_columns_mut::<3>(3).copy_from(&(axes * skew(&-arm)));
        all
    }

    /// Force and moment about its node at the start on one of both parts, in the axes of its body.
    fn wrench(&self, side: usize, force: &Vector3, at: &Kinematics) -> [Vector3; 2] {
        let sign = if side == 1 { 1.0 } else { -1.0 };
        let force = sign * self.place.axes.tr_mul(force);
        let moment = self.place.arms[side].cross(&force);
        let rotation = &at.nodes[self.nodes[side]].frame.rotation;
        [rotation.apply_inverse(&force), rotation.apply_inverse(&moment)]
    }

    /// Force at a displacement, without its slope.
    pub(crate) fn force(&self, displacement: &Vector3) -> Vector3 {
        self.evaluate(displacement).force
    }

    /// Normal force at a displacement, and its decrease by the displacement.
    fn normal(&self, displacement: f64) -> [f64; 2] {
        let depth = -self.place.gap - self.response.relief - displacement;
        if depth <= 0.0 {
            return [0.0; 2];
        }
        if let Some(stiffness) = self.response.near_rigid {
            return [stiffness * depth, stiffness];
        }
        let [force, by_depth, by_closing] =
            self.law.compliance.force(depth, -displacement / self.size, self.response.dissipation);
        [force, by_depth + by_closing / self.size]
    }

    /// Force at a displacement, with its slope, and with the bound of the friction that belongs to it.
    pub(crate) fn evaluate_with_bound(&mut self, displacement: &Vector3) -> TouchState {
        let normal = self.normal(displacement.z);
        self.bound = self.friction_bound(normal[0], displacement.xy().norm() / self.size);
        self.state(displacement, normal)
    }

    /// Force at a displacement, with its slope.
    pub(crate) fn evaluate(&self, displacement: &Vector3) -> TouchState {
        self.state(displacement, self.normal(displacement.z))
    }

    fn state(&self, displacement: &Vector3, [normal, by_normal]: [f64; 2]) -> TouchState {
        let mut state = TouchState { displacement: *displacement, ..TouchState::default() };
        state.force.z = normal;
        state.slope[(2, 2)] = by_normal;
        let pull = [0, 1].map(|k| self.response.stiffness * (self.response.bristle[k] + displacement[k]));
        add_friction(pull, self.response.stiffness, self.bound, &mut state);
        state
    }

    /// Whether both parts touch at a state.
    fn is_touching(&self, state: &TouchState) -> bool {
        state.force.z > 0.0
            || self.response.near_rigid.is_none() && self.gap_at(state) + self.response.relief < 0.0
    }

    /// Gap at the end of the step [m].
    pub(crate) fn gap_at(&self, state: &TouchState) -> f64 {
        self.place.gap + state.displacement.z
    }

    /// Elastic energy of the touch and its bristle at the end of the step, with which the next one continues [J].
    pub(crate) fn energy(&self, state: &TouchState) -> f64 {
        if !self.is_touching(state) {
            return 0.0;
        }
        let depth = -self.gap_at(state) - self.response.relief;
        let bristle =
            if self.response.near_rigid.is_some() { 0.0 } else { self.bristle_at(state).norm_squared() };
        self.law.compliance.energy(depth) + 0.5 * self.response.stiffness * bristle
    }

    /// The touch at the end of the step, if both parts touch then.
    pub(crate) fn end(&self, state: &TouchState) -> Option<Touch> {
        self.is_touching(state).then(|| self.touch(state))
    }

    /// The touch at the end of the step, in which an impact gave the velocity and the impulse of a `state` at a point at its end.
    pub(crate) fn end_of_impact(&self, state: &TouchState, (point, impact): (&Self, &TouchState)) -> Touch {
        let force = impact.force / self.size;
        let of = Self { place: point.place, ..*self }.touch(&TouchState { force, ..*impact });
        Touch {
            slip: impact.displacement.xy().norm(),
            continues: state.force.z > 0.0,
            ..Touch {
                force: of.force,
                friction: of.friction,
                normal: of.normal,
                point: of.point,
                is_sliding: of.is_sliding,
                ..self.touch(state)
            }
        }
    }

    fn touch(&self, state: &TouchState) -> Touch {
        let sign = if self.is_reversed { -1.0 } else { 1.0 };
        let gap = self.gap_at(state);
        let has_friction = self.law.friction.is_some();
        let bristle = if self.response.near_rigid.is_some() {
            Vector3::zeros()
        } else {
            self.bristle_at(state).push(0.0)
        };
        let tangential = state.force.xy().push(0.0);
        Touch {
            key: self.key,
            gap,
            deepest: self.place.deepest,
            point: self.place.point.into(),
            force: (sign * self.place.axes.tr_mul(&state.force)).into(),
            friction: (sign * self.place.axes.tr_mul(&tangential)).into(),
            normal: state.force.z,
            bristle: self.place.axes.tr_mul(&bristle).into(),
            stiffness: self.response.stiffness,
            // A penetration that decreases needs no relief any more.
            relief: self.response.relief.min(-gap).max(0.0),
            slip: state.displacement.xy().norm() / self.size,
            is_sliding: !has_friction || state.slips,
            impact_velocity: self.impact_velocity,
            energy: self.energy(state),
            supplied: tangential.dot(&self.drift()),
            continues: true,
        }
    }
}

/// Adds friction to a state: minus a pull of this stiffness, limited to a bound.
pub(crate) fn add_friction(pull: [f64; 2], stiffness: f64, bound: f64, state: &mut TouchState) {
    if bound <= 0.0 {
        state.slips = true;
        return;
    }
    let size = (pull[0] * pull[0] + pull[1] * pull[1]).sqrt();
    state.slips = size > bound;
    for k in 0..2 {
        state.force[k] = if state.slips { -bound * pull[k] / size } else { -pull[k] };
        for l in 0..2 {
            let identity = if k == l { 1.0 } else { 0.0 };
            state.slope[(k, l)] = if state.slips {
                bound * stiffness / size * (identity - pull[k] * pull[l] / (size * size))
            } else {
                identity * stiffness
            };
        }
    }
}

/// Two tangents and the normal, as rows.
fn axes_of(normal: &Vector3) -> Matrix3 {
    let [first, second] = tangents(normal);
    Matrix3::from_rows(&[first.transpose(), second.transpose(), normal.transpose()])
}

/// A deflection in the tangent plane of these axes, rotated with the normal.
fn carried_bristle(axes: &Matrix3, bristle: &Vector3) -> [f64; 2] {
    let along = axes * bristle;
    let (length, kept) = (bristle.norm(), along.xy().norm());
    let factor = if kept > 0.0 { length / kept } else { 0.0 };
    [factor * along.x, factor * along.y]
}

#[cfg(test)]
#[path = "../../../tests/unit/integrator/contacts/touch_point.rs"]
mod tests;
