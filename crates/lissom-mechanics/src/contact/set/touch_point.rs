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
//! Where a step does not resolve a touch, h > T/500 with its duration T, an impact has the restitution e by a bias b of the velocity
//! [Moreau 1988; Castro, Permenter and Han 2022 for the near-rigid force]. The scheme would damp longer touches, too. Of an impact at
//! the velocity v, with a the velocity that other forces add in the step:
//!
//! ```text
//! f_n = max(0, b - d_n/h)/(R h),      R = w/100,      b = min(-φ/h, v_rest)
//! impact:   b = u + (u + v + a)/100,      u = min(e v, √(a² + v²) - a)
//! ```
//!
//! The energy of a pair changes by (u² - v² + 2 a u)/(2 w), which the limit of u keeps from being a gain. Rebounds of several impacts at
//! once are weakened until the whole step gains none.

use lissom_motion::{Matrix3, Vector3, Vector6};
use nalgebra::Vector2;

use super::{Impact, TouchLaw, placed};
use crate::contact::gap::Matrix3x6;
use crate::contact::solids::Meeting;
use crate::kinematics::{Kinematics, MotionChange, NodeId, Touch, TouchKey, split};

/// σ: a bristle moves a free part by a tenth of the step's displacement at most.
const BRISTLE_SHARE: f64 = 0.1;
/// Steps longer than this share of a touch lose more than 1 % of its velocity: (π h/T)²/2 per period 2 T/π.
const RESOLVED_SHARE: f64 = 0.002;
/// R over w: share of the effective mass that a near-rigid touch yields.
const NEAR_RIGID: f64 = 0.01;

/// What a point needs of a step.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// Length h [s].
    pub size: f64,
    /// Inverse effective mass w of both parts [1/kg].
    pub compliance: f64,
}

/// Bias and resistance of a touch that a step does not resolve.
#[derive(Clone, Copy, Debug, PartialEq)]
struct NearRigid {
    /// b [m/s], and without a rebound.
    bias: f64,
    plain: f64,
    /// R h² [m/N].
    yielding: f64,
}

/// Where a point is at the start of the step, in inertial axes.
#[derive(Clone, Copy, Debug)]
struct Place {
    /// Rows t₁, t₂, n.
    axes: Matrix3,
    /// Point of contact [m].
    point: Vector3,
    /// From the nodes' positions to it [m].
    arms: [Vector3; 2],
    /// φ [m].
    gap: f64,
    /// Penetration at which the solids are within each other [m].
    deepest: f64,
}

/// A point at which two parts may touch in a step.
#[derive(Clone, Copy, Debug)]
pub struct TouchPoint {
    /// Where it is.
    pub key: TouchKey,
    /// Nodes of base and tip.
    pub nodes: [NodeId; 2],
    /// Whether the tip is the first part of the contact.
    is_reversed: bool,
    place: Place,
    size: f64,
    law: TouchLaw,
    /// Dissipation factor a [s/m].
    dissipation: f64,
    near_rigid: Option<NearRigid>,
    /// z.
    bristle: [f64; 2],
    /// K [N/m].
    stiffness: f64,
    is_new: bool,
    impact_velocity: f64,
    /// μ N [N].
    pub bound: f64,
}

/// Force at a point at some displacement, in its axes.
#[derive(Clone, Copy, Debug, Default)]
pub struct TouchState {
    /// d [m].
    pub displacement: Vector3,
    /// f, on the tip [N].
    pub force: Vector3,
    /// -∂f/∂d [N/m].
    pub slope: Matrix3,
    /// Whether the bristle slips.
    slips: bool,
}

impl TouchPoint {
    /// The point of a meeting of two parts with these nodes at the start of a step, which continues a touch if there was one. None if
    /// its gap is larger than `reach` [m].
    pub fn at(
        (key, meeting, law): (TouchKey, &Meeting, &TouchLaw),
        nodes: [NodeId; 2],
        (start, step): (&Kinematics, Step),
        (reach, before): (f64, Option<&Touch>),
    ) -> Option<Self> {
        let (base, tip) = placed(meeting, nodes, start);
        // Of curves the value alone costs as much.
        let gap = meeting.pair.gap(&tip.position, &tip.rotation.matrix());
        if gap.value > reach {
            return None;
        }
        let normal = base.rotation.apply(&gap.normal);
        let point = base.transform_point(&gap.point);
        let axes = axes_of(&normal);
        let nodes = meeting.sides.map(|side| nodes[side]);
        let arms = nodes.map(|node| point - start.nodes[node].frame.position);
        let velocity = |k: usize| {
            let motion = &start.nodes[nodes[k]];
            motion.velocity_at(&motion.frame.rotation.apply_inverse(&arms[k]))
        };
        let closing = normal.dot(&(velocity(0) - velocity(1)));
        let impact_velocity = before.map_or(closing.max(0.0), |touch| touch.impact_velocity);
        let resolved_bristle = 1.0 / (BRISTLE_SHARE * step.size * step.size * step.compliance);
        let is_linear = law.compliance.exponent == 1.0;
        let stiffness =
            if is_linear { resolved_bristle.min(law.compliance.stiffness) } else { resolved_bristle };
        // A shorter step has stiffer bristles: neither their force nor their energy increases.
        let bristle = before.map_or([0.0; 2], |touch| {
            let kept = (touch.stiffness / stiffness).min(1.0);
            carried_bristle(&axes, &(kept * Vector3::from(touch.bristle)))
        });
        let mut found = Self {
            key,
            nodes,
            is_reversed: meeting.sides == [1, 0],
            place: Place { axes, point, arms, gap: gap.value, deepest: meeting.pair.deepest() },
            size: step.size,
            law: *law,
            dissipation: law.impact.factor(impact_velocity),
            near_rigid: None,
            bristle,
            stiffness,
            is_new: before.is_none(),
            impact_velocity,
            bound: 0.0,
        };
        if let Impact::Restitution { rest_velocity, .. } = law.impact
            && step.size
                > RESOLVED_SHARE
                    * law.compliance.duration(1.0 / step.compliance, impact_velocity.max(rest_velocity))
        {
            let plain = (-gap.value / step.size).min(rest_velocity);
            found.near_rigid = Some(NearRigid {
                bias: plain,
                plain,
                yielding: NEAR_RIGID * step.compliance * step.size * step.size,
            });
        }
        found.bound = found.friction_bound(before.map_or(0.0, |touch| touch.normal), 0.0);
        Some(found)
    }

    /// Gives an impact that began in this step its restitution. Whether that changes its force.
    pub fn rebound(&mut self, state: &TouchState) -> bool {
        let Impact::Restitution { coefficient, rest_velocity, .. } = self.law.impact else { return false };
        let Some(NearRigid { bias, yielding, plain }) = &mut self.near_rigid else { return false };
        let arrival = self.impact_velocity;
        // Once per step: a rebound may have been weakened.
        if *bias != *plain || !(self.is_new && state.force.z > 0.0 && arrival > rest_velocity) {
            return false;
        }
        let free = (state.displacement.z - *yielding / NEAR_RIGID * state.force.z) / self.size;
        let gained = (-free - arrival).max(0.0);
        let departure = (coefficient * arrival).min(gained.hypot(arrival) - gained);
        let needed = departure + NEAR_RIGID * (departure + arrival + gained);
        let is_changed = needed > *bias;
        *bias = bias.max(needed);
        is_changed
    }

    /// Reduces the rebound of an impact to a share. Whether there is one.
    pub fn weaken(&mut self, share: f64) -> bool {
        let Some(NearRigid { bias, plain, .. }) = &mut self.near_rigid else { return false };
        let has_rebound = *bias != *plain;
        // A rebound of nothing remains one.
        if has_rebound {
            *bias = (*plain + share * (*bias - *plain)).max(plain.next_up());
        }
        has_rebound
    }

    /// Energy that a near-rigid touch supplies over the step, to the motion of its parts and to its bristle [J].
    pub fn supplied(&self, state: &TouchState) -> f64 {
        if self.near_rigid.is_none() {
            return 0.0;
        }
        let [before, after] = [Vector2::from(self.bristle), self.bristle_at(state)].map(|z| z.norm_squared());
        state.force.dot(&state.displacement) + 0.5 * self.stiffness * (after - before)
    }

    /// Deflection of the bristle at the end of the step [m].
    fn bristle_at(&self, state: &TouchState) -> Vector2<f64> {
        match (self.law.friction, state.slips) {
            (None, _) => Vector2::zeros(),
            (Some(_), false) => Vector2::from(self.bristle) + state.displacement.xy(),
            (Some(_), true) => -state.force.xy() / self.stiffness,
        }
    }

    /// μ(s) N at a normal force [N] and a sliding velocity [m/s].
    fn friction_bound(&self, normal: f64, velocity: f64) -> f64 {
        self.law.friction.map_or(0.0, |friction| friction.coefficient(velocity) * normal)
    }

    /// Sets the bound of the friction to that of a state. Returns by how much it changed [N].
    pub fn update_bound(&mut self, state: &TouchState) -> f64 {
        let velocity = state.displacement.xy().norm() / self.size;
        let bound = self.friction_bound(state.force.z, velocity);
        let change = bound - self.bound;
        self.bound = bound;
        change
    }

    /// d for the motion of both nodes in the step, from the `start`: displacements of the nodes, and rotations at the twists of the end.
    pub fn displacement(&self, start: &Kinematics, at: &Kinematics, changes: &[MotionChange]) -> Vector3 {
        let of = |k: usize| {
            let node = self.nodes[k];
            let shift = start.nodes[node].frame.rotation.apply(&changes[node].shift);
            shift + self.size * at.nodes[node].angular_velocity().cross(&self.place.arms[k])
        };
        self.place.axes * (of(1) - of(0))
    }

    /// The change of d by increments of both nodes in the axes of their bodies.
    pub fn change(&self, at: &Kinematics, increment: impl Fn(NodeId) -> Vector6) -> Vector3 {
        let of = |k: usize| {
            let node = self.nodes[k];
            let (shift, turn) = split(&increment(node));
            let rotation = &at.nodes[node].frame.rotation;
            rotation.apply(&shift) + rotation.apply(&turn).cross(&self.place.arms[k])
        };
        self.place.axes * (of(1) - of(0))
    }

    /// ∂d by increments of one of both nodes, in the axes of its body.
    pub fn gradient(&self, side: usize, at: &Kinematics) -> Matrix3x6 {
        let rotation = at.nodes[self.nodes[side]].frame.rotation.matrix();
        let sign = if side == 1 { 1.0 } else { -1.0 };
        let mut all = Matrix3x6::zeros();
        for row in 0..3 {
            let axis = self.place.axes.row(row).transpose();
            all.fixed_view_mut::<1, 3>(row, 0).copy_from(&(sign * axis.transpose() * rotation));
            let moment = self.place.arms[side].cross(&axis);
            all.fixed_view_mut::<1, 3>(row, 3).copy_from(&(sign * moment.transpose() * rotation));
        }
        all
    }

    /// Force and moment about its node at the start on one of both parts, in the axes of its body.
    pub fn wrench(&self, side: usize, state: &TouchState, at: &Kinematics) -> [Vector3; 2] {
        let sign = if side == 1 { 1.0 } else { -1.0 };
        let force = sign * self.place.axes.tr_mul(&state.force);
        let moment = self.place.arms[side].cross(&force);
        let rotation = &at.nodes[self.nodes[side]].frame.rotation;
        [rotation.apply_inverse(&force), rotation.apply_inverse(&moment)]
    }

    /// Force at a displacement, without its slope.
    pub fn force(&self, displacement: &Vector3) -> Vector3 {
        self.evaluate(displacement).force
    }

    /// Normal force at a displacement, and its decrease by the displacement.
    fn normal(&self, displacement: f64) -> [f64; 2] {
        if let Some(NearRigid { bias, yielding, .. }) = self.near_rigid {
            let closing = bias * self.size - displacement;
            return if closing > 0.0 { [closing / yielding, 1.0 / yielding] } else { [0.0; 2] };
        }
        let depth = -self.place.gap - displacement;
        if depth <= 0.0 {
            return [0.0; 2];
        }
        let [force, by_depth, by_closing] =
            self.law.compliance.force(depth, -displacement / self.size, self.dissipation);
        [force, by_depth + by_closing / self.size]
    }

    /// Force at a displacement, with its slope, and with the bound of the friction that belongs to it.
    pub fn evaluate_with_bound(&mut self, displacement: &Vector3) -> TouchState {
        let normal = self.normal(displacement.z);
        self.bound = self.friction_bound(normal[0], displacement.xy().norm() / self.size);
        self.state(displacement, normal)
    }

    /// Force at a displacement, with its slope.
    pub fn evaluate(&self, displacement: &Vector3) -> TouchState {
        self.state(displacement, self.normal(displacement.z))
    }

    fn state(&self, displacement: &Vector3, [normal, by_normal]: [f64; 2]) -> TouchState {
        let mut state = TouchState { displacement: *displacement, ..TouchState::default() };
        state.force.z = normal;
        state.slope[(2, 2)] = by_normal;
        if self.bound <= 0.0 {
            state.slips = true;
            return state;
        }
        let pull: [f64; 2] = std::array::from_fn(|k| self.stiffness * (self.bristle[k] + displacement[k]));
        let size = (pull[0] * pull[0] + pull[1] * pull[1]).sqrt();
        state.slips = size > self.bound;
        for k in 0..2 {
            state.force[k] = if state.slips { -self.bound * pull[k] / size } else { -pull[k] };
            for l in 0..2 {
                let identity = if k == l { 1.0 } else { 0.0 };
                state.slope[(k, l)] = if state.slips {
                    self.bound * self.stiffness / size * (identity - pull[k] * pull[l] / (size * size))
                } else {
                    identity * self.stiffness
                };
            }
        }
        state
    }

    /// Whether both parts touch at a state.
    fn is_touching(&self, state: &TouchState) -> bool {
        state.force.z > 0.0 || self.near_rigid.is_none() && self.place.gap + state.displacement.z < 0.0
    }

    /// The touch at the end of the step, if both parts touch then.
    pub fn end(&self, state: &TouchState) -> Option<Touch> {
        if !self.is_touching(state) {
            return None;
        }
        let sign = if self.is_reversed { -1.0 } else { 1.0 };
        let (d, gap) = (&state.displacement, self.place.gap + state.displacement.z);
        let has_friction = self.law.friction.is_some();
        let bristle = self.bristle_at(state).push(0.0);
        let tangential = state.force.xy().push(0.0);
        let elastic = if self.near_rigid.is_none() { self.law.compliance.energy(-gap) } else { 0.0 };
        Some(Touch {
            key: self.key,
            gap,
            deepest: self.place.deepest,
            point: self.place.point.into(),
            force: (sign * self.place.axes.tr_mul(&state.force)).into(),
            friction: (sign * self.place.axes.tr_mul(&tangential)).into(),
            normal: state.force.z,
            bristle: self.place.axes.tr_mul(&bristle).into(),
            stiffness: self.stiffness,
            slip: d.xy().norm() / self.size,
            is_sliding: !has_friction || state.slips,
            impact_velocity: self.impact_velocity,
            energy: elastic + 0.5 * self.stiffness * bristle.norm_squared(),
        })
    }
}

/// Two tangents and the normal, as rows.
fn axes_of(normal: &Vector3) -> Matrix3 {
    let first = normal.cross(&Vector3::ith(normal.iamin(), 1.0)).normalize();
    let second = normal.cross(&first);
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
mod tests {
    use lissom_motion::Motion;

    use super::super::{ContactRule, ContactSet, Coulomb, TouchingPart};
    use super::*;
    use crate::contact::compliance::Compliance;
    use crate::contact::solids::{Form, PlacedSolid, Solid};
    use crate::kinematics::{GROUND, NodeMotion};

    /// A ball that touches a plane, with a law.
    fn point(impact: Impact, exponent: f64, size: f64) -> TouchPoint {
        let placed = |form| vec![PlacedSolid { form, frame: Motion::IDENTITY }];
        let parts = vec![
            TouchingPart::new(GROUND, placed(Form::HalfSpace)),
            TouchingPart::new(NodeId::new(1), placed(Form::Solid(Solid::Sphere(0.1)))),
        ];
        let compliance = Compliance { stiffness: 1e5, exponent };
        let friction = Some(Coulomb { sliding: 0.3, at_rest: 0.3, stribeck: 0.01 });
        let law = TouchLaw { compliance, impact, friction };
        let rules = vec![ContactRule { name: "floor".to_owned(), parts: vec![0, 1], law, materials: None }];
        let set = ContactSet { parts, rules };
        let above = Motion::translation(Vector3::new(0.0, 0.0, 0.099));
        let at = Kinematics {
            time: 0.0,
            elapsed: 0.0,
            nodes: [Motion::identity(), above].map(NodeMotion::at_rest).to_vec(),
            coordinates: Vec::new(),
            held: Vec::new(),
            multipliers: Vec::new(),
            touches: Vec::new(),
        };
        let meetings = set.meetings_of(0, [0, 1]).expect("solids").expect("they touch");
        let (meeting, law) = &meetings[0];
        let step = Step { size, compliance: 2.0 };
        let nodes = [GROUND, NodeId::new(1)];
        TouchPoint::at((TouchKey::default(), meeting, law), nodes, (&at, step), (0.1, None)).expect("near")
    }

    /// Slopes are those of differences, sticking and sliding, resolved and near-rigid, and never negative.
    #[test]
    fn slopes_are_those_of_differences() {
        let restitution = Impact::Restitution { coefficient: 0.5, relative: 1.0, rest_velocity: 1e-3 };
        for (impact, exponent) in
            [(Impact::Dissipation(0.5), 1.0), (Impact::Dissipation(0.2), 1.5), (restitution, 1.0)]
        {
            for (d, slips) in
                [(Vector3::new(1e-8, -2e-8, 1e-7), false), (Vector3::new(1e-3, -2e-3, -1e-5), true)]
            {
                let mut point = point(impact, exponent, 1e-3);
                let state = point.evaluate_with_bound(&d);
                assert!(state.force.z > 0.0 && state.slips == slips, "{impact:?} {d:?} {state:?}");
                let force = state.force.xy().norm();
                assert!(force <= 0.3 * state.force.z * (1.0 + 1e-12), "{force}");
                let step = 1e-10;
                for k in 0..3 {
                    let aside = step * Vector3::ith(k, 1.0);
                    let difference = (point.force(&(d - aside)) - point.force(&(d + aside))) / (2.0 * step);
                    let error = (difference - state.slope.column(k)).norm();
                    assert!(error < 1e-5 * state.slope.norm(), "{impact:?} {k} {error}");
                }
                assert!(state.slope.symmetric_eigenvalues().min() >= -1e-9 * state.slope.norm());
            }
        }
    }
}
