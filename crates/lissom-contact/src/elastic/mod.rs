//! Compliant contact of two solids in one point, with friction that sticks.
//!
//! Legend, beside that of a [point](crate::point): N normal force, z deflection of the bristles in the axes of the base (first-order
//! states), z_c deflection at which they slip, μ(s) = μ + (μ_s - μ) exp(-(|s|/v_s)²).
//!
//! ```text
//! f = N n - N μ(s) ⌊⌊z_t/z_c⌋ + max(0, 1 - |z_t|²/z_c²) d⌋,      z_t = z - n (n·z),      d = (s/v_s)/√(1 + |s|²/v_s²)
//! z' = s - α(|z|/z_c) max(0, s·ẑ) ẑ in contact,  0 without,      ẑ = z/|z|,      α(r) = 0 below r₀, r from 1 on, cubic between
//! ⌊a⌋ = a/max(1, |a|)
//! ```
//!
//! Bristles deflect elastically below r₀ z_c, so that a sticking part does not creep, and yield from there to z_c, at which they slip
//! [Dupont, Armstrong and Hayward 2000; here in two directions]. A step of a given size may overshoot z_c: α above 1 returns them, and the
//! force remains at its limit. The term with d damps vibrations of a sticking part, and vanishes where bristles slip. Without contact
//! bristles keep their deflection.

pub mod resistance;

use std::sync::Arc;

use lissom_motion::{Matrix3, Matrix6, Vector3, Vector6, lie_bracket_matrix, rotation_part, screw, skew};
use nalgebra::SMatrix;

use self::resistance::ContactResistance;
use crate::geometry::gap::{Matrix3x6, Pair, side_by_side};
use crate::law::Coulomb;
use crate::point::{ContactPoint, MovingSurface, PointMotion};
use crate::reading::{ContactElement, ContactReading};
use lissom_mechanics::compliance::Compliance;
use lissom_mechanics::elements::force_law::Response;
use lissom_mechanics::elements::{
    Capabilities, Contribution, Element, Energy, ForceLaws, Limit, LimitKind, Place, Spring, StrainSlopes,
    Tangents, Unknowns, Validity, add_block,
};
use lissom_mechanics::evaluation::capabilities::Load;
use lissom_mechanics::evaluation::switch_states::{SwitchStates, frozen_branch, is_on_upper_branch};
use lissom_mechanics::joints::frame_pair::RelativeMotion;
use lissom_mechanics::kinematics::{CarriedFrame, CoordinateId, DiscreteValueId, Kinematics, NodeId, Switch};
use lissom_mechanics::law::VisitLaw;
use lissom_mechanics::signals::measurement::{Gradient, MAX_COMPONENTS, Measurement};

/// Rows of the states of the bristles, after two nodes.
const BRISTLES: usize = 12;

/// r₀: share of the deflection at slip below which bristles are elastic.
const ELASTIC_SHARE: f64 = 0.8;
/// Share of the deflection at slip from which bristles are reported to slip.
const SLIPPING: f64 = 0.95;

/// Dissipation of the normal force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dissipation {
    /// The factor a [s/m].
    Factor(f64),
    /// The factor is A/v with the velocity v at which the contact began, which an event sets.
    AtTouch {
        /// A.
        relative: f64,
        /// v [m/s].
        velocity: DiscreteValueId,
        /// Smallest v [m/s].
        least: f64,
    },
}

/// Dry friction by bristles.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactFriction {
    /// Deflection of the bristles in the axes of the base.
    pub bristles: Vec<CoordinateId>,
    /// Limit of the friction.
    pub law: Coulomb,
    /// Deflection at which the bristles slip, z_c [m].
    pub deflection: f64,
}

/// The part of the sliding velocity by which bristles yield, with its derivatives by sliding velocity and deflection.
#[derive(Default)]
pub(super) struct Yielding {
    pub(super) rate: Vector3,
    pub(super) by_sliding: Matrix3,
    pub(super) by_bristles: Matrix3,
}

/// Friction per normal force, with its derivatives by the sliding velocity and by the tangential deflection of the bristles.
pub(super) struct Share {
    pub(super) force: Vector3,
    pub(super) by_sliding: Matrix3,
    pub(super) by_bristles: Matrix3,
}

/// States of the bristles of a contact: components of a vector.
pub(super) const STATES: usize = 3;

impl ContactFriction {
    /// Friction with bristles that are states of the contribution, by this name and a number.
    pub fn with_bristles(&self, name: &str, contribution: &mut Contribution) -> Self {
        let state = |k: usize| contribution.add_state(format!("{name} {k}"), 0.0, self.deflection);
        Self { bristles: (1..=STATES).map(state).collect(), ..*self }
    }

    pub(super) fn yielding(&self, bristles: &Vector3, sliding: &Vector3) -> Yielding {
        let length = bristles.norm();
        let beyond = (length / self.deflection - ELASTIC_SHARE) / (1.0 - ELASTIC_SHARE);
        if beyond <= 0.0 {
            return Yielding::default();
        }
        let direction = bristles / length;
        let along = sliding.dot(&direction);
        if along <= 0.0 {
            return Yielding::default();
        }
        let (share, slope) = if beyond < 1.0 {
            let slope = 6.0 * beyond * (1.0 - beyond) / ((1.0 - ELASTIC_SHARE) * self.deflection);
            (beyond * beyond * (3.0 - 2.0 * beyond), slope)
        } else {
            (length / self.deflection, 1.0 / self.deflection)
        };
        let outer = direction * direction.transpose();
        let turn = (Matrix3::identity() - outer) / length;
        Yielding {
            rate: share * along * direction,
            by_sliding: share * outer,
            by_bristles: slope * along * outer
                + share * (direction * (sliding.transpose() * turn) + along * turn),
        }
    }

    /// Whether bristles of this deflection [m] slip.
    pub(super) fn slips(&self, bristles: &Vector3) -> bool {
        bristles.norm() > SLIPPING * self.deflection
    }

    /// Opposed to the sliding of the tip.
    pub(super) fn share(&self, bristles: &Vector3, sliding: &Vector3, normal: &Vector3) -> Share {
        let velocity = self.law.stribeck;
        let squared = sliding.norm_squared() / (velocity * velocity);
        let more = self.law.excess(sliding.norm_squared());
        let coefficient = self.law.sliding + more;
        let tangential = bristles - normal * normal.dot(bristles);
        let relative = tangential / self.deflection;
        let root = 1.0 / (1.0 + squared).sqrt();
        let damping = sliding / velocity * root;
        let (remaining, slope) = match 1.0 - relative.norm_squared() {
            remaining if remaining > 0.0 => (remaining, 1.0),
            _ => (0.0, 0.0),
        };
        let direction = limited(relative);
        let total = limited(direction.value + remaining * damping);
        let damping_by = (Matrix3::identity() - damping * damping.transpose()) * (root / velocity);
        Share {
            force: coefficient * total.value,
            by_sliding: coefficient * remaining * (total.by * damping_by)
                - total.value * sliding.transpose() * (2.0 * more / (velocity * velocity)),
            by_bristles: total.by
                * (direction.by - damping * relative.transpose() * (2.0 * slope))
                * (coefficient / self.deflection),
        }
    }
}

/// A vector of at most unit length, with its derivative.
struct Limited {
    value: Vector3,
    by: Matrix3,
}

/// The vector, or its direction if it is longer than one.
fn limited(vector: Vector3) -> Limited {
    let length = vector.norm();
    if length <= 1.0 {
        return Limited { value: vector, by: Matrix3::identity() };
    }
    let unit = vector / length;
    Limited { value: unit, by: (Matrix3::identity() - unit * unit.transpose()) / length }
}

/// Two solids that may touch.
#[derive(Clone, Debug)]
pub struct Contact {
    name: String,
    point: ContactPoint,
    compliance: Compliance,
    dissipation: Dissipation,
    friction: Option<ContactFriction>,
    resistance: Option<ContactResistance>,
    /// Deflections of the bristles, those of friction first.
    bristles: Vec<CoordinateId>,
    switch_states: SwitchStates,
}

/// Gap and rate of a contact, for events.
pub struct ContactMotion(Contact);

impl ContactMotion {
    /// States of this contact.
    pub fn new(contact: &Contact) -> Self {
        Self(Contact { friction: None, resistance: None, bristles: Vec::new(), ..contact.clone() })
    }
}

impl Measurement for ContactMotion {
    fn nodes(&self) -> &[NodeId] {
        &self.0.point.frames.nodes
    }

    fn component_count(&self) -> usize {
        2
    }

    fn values(&self, at: &Kinematics) -> [f64; MAX_COMPONENTS] {
        let [gap, rate, _] = self.0.spring_motion(at);
        [gap, rate, 0.0, 0.0, 0.0, 0.0]
    }

    fn value(&self, component: usize, at: &Kinematics) -> f64 {
        if component == 0 { self.0.point.gap(at) } else { self.values(at)[component] }
    }

    fn gradient(&self, component: usize, at: &Kinematics) -> Gradient {
        self.0.spring_gradients(at).map_or_else(Gradient::zero, |all| all[component])
    }
}

/// Motion at the point of contact, and the force.
struct Touch {
    at: PointMotion,
    is_touching: bool,
    /// s.
    sliding: Vector3,
    /// N and its derivatives by penetration and its rate.
    normal_force: [f64; 3],
    /// z; zero without friction.
    bristles: Vector3,
    /// z' as the law determines it.
    deflecting: Vector3,
    /// f, on the tip in the base's axes.
    force: Vector3,
    /// Against rolling and spinning; zero without.
    rotation: Rotating,
}

/// Relative rotation at the point of contact, in the axes of the base.
#[derive(Default)]
struct Rotating {
    /// Angular velocity of the tip relative to the base.
    spin: Vector3,
    bristles: Vector3,
    /// Rate of the bristles as the law determines it.
    deflecting: Vector3,
    /// Moment on the tip.
    moment: Vector3,
}

impl Touch {
    /// The wrench on the tip's frame.
    fn wrench(&self) -> Vector6 {
        let turned = |vector: &Vector3| self.at.relative.rotation.tr_mul(vector);
        let force = turned(&self.force);
        screw(&force, &(self.at.arm.cross(&force) + turned(&self.rotation.moment)))
    }
}

impl Contact {
    /// Between the frames of two solids: base and tip.
    pub fn new(
        frames: [CarriedFrame; 2],
        pair: Arc<dyn Pair>,
        (compliance, dissipation): (Compliance, Dissipation),
        friction: Option<ContactFriction>,
    ) -> Self {
        let point = ContactPoint::new(frames, pair);
        let bristles = friction.as_ref().map_or_else(Vec::new, |friction| friction.bristles.clone());
        let (resistance, switch_states) = (None, SwitchStates::default());
        let name = String::new();
        Self { name, point, compliance, dissipation, friction, resistance, bristles, switch_states }
    }

    /// Sets the name that warnings contain.
    pub fn with_name(mut self, name: &str) -> Self {
        name.clone_into(&mut self.name);
        self
    }

    /// Adds resistance to rolling and spinning.
    pub fn with_resistance(mut self, resistance: ContactResistance) -> Self {
        self.bristles.extend(&resistance.bristles.bristles);
        self.resistance = Some(resistance);
        self
    }

    /// Adds a surface that moves along itself.
    pub fn with_surface(mut self, surface: MovingSurface) -> Self {
        self.point.surface = Some(surface);
        self
    }

    pub(super) fn name(&self) -> &str {
        &self.name
    }

    /// Whether the solids are apart, as far as it is known without what a contact needs: by their frozen switch, otherwise by the gap
    /// of a point.
    #[inline]
    fn is_apart(&self, at: &Kinematics) -> bool {
        let frozen = frozen_branch(self.switch_states.of(at).first());
        frozen.map_or_else(
            || self.point.pair.reach() == 0.0 && self.point.gap(at) >= 0.0,
            |is_touching| !is_touching,
        )
    }

    fn dissipation(&self, at: &Kinematics) -> f64 {
        match self.dissipation {
            Dissipation::Factor(factor) => factor,
            Dissipation::AtTouch { relative, velocity, least } => {
                relative / at.held.get(velocity.index()).map_or(least, |velocity| velocity.max(least))
            }
        }
    }

    fn touch(&self, at: &Kinematics) -> Touch {
        let motion = self.point.motion(at);
        let (depth, n, sliding) = (-motion.gap.value, motion.gap.normal, motion.sliding());
        let is_touching = is_on_upper_branch(self.switch_states.of(at).first(), depth);
        let normal_force = if is_touching {
            self.compliance.force(depth, -motion.rate(), self.dissipation(at))
        } else {
            [0.0; 3]
        };
        let (mut bristles, mut deflecting) = (Vector3::zeros(), Vector3::zeros());
        let mut force = normal_force[0] * n;
        if let Some(friction) = &self.friction {
            bristles = Vector3::from_fn(|k, _| at.coordinates[friction.bristles[k]].value);
            if is_touching {
                deflecting = sliding - friction.yielding(&bristles, &sliding).rate;
                force -= normal_force[0] * friction.share(&bristles, &sliding, &n).force;
            }
        }
        let rotation = self.rotating(&motion.relative, (&n, is_touching.then_some(normal_force[0])), at);
        Touch { at: motion, is_touching, sliding, normal_force, bristles, deflecting, force, rotation }
    }

    fn rotating(
        &self,
        motion: &RelativeMotion,
        (normal, force): (&Vector3, Option<f64>),
        at: &Kinematics,
    ) -> Rotating {
        let Some(resistance) = &self.resistance else { return Rotating::default() };
        let of = &resistance.bristles;
        let bristles = Vector3::from_fn(|k, _| at.coordinates[of.bristles[k]].value);
        let spin = motion.rotation * rotation_part(&motion.twist);
        let mut rotating = Rotating { spin, bristles, ..Rotating::default() };
        if let Some(force) = force {
            rotating.deflecting = spin - of.yielding(&bristles, &spin).rate;
            rotating.moment = force * resistance.moment(&bristles, &spin, normal).value;
        }
        rotating
    }

    /// Energy of the bristles per normal force [m].
    fn deflected(&self, touch: &Touch) -> f64 {
        let of_friction = self.friction.as_ref().map_or(0.0, |friction| {
            0.5 * friction.law.at_rest / friction.deflection * touch.bristles.norm_squared()
        });
        let rotation = &touch.rotation;
        let resistance = self.resistance.as_ref();
        of_friction + resistance.map_or(0.0, |resistance| resistance.deflected(&rotation.bristles))
    }

    /// First row of the bristles against rotation.
    fn first_rotation(&self) -> usize {
        BRISTLES + if self.friction.is_some() { 3 } else { 0 }
    }

    /// Adds the derivatives of the moment against rotation and of the rates of its bristles.
    fn add_resistance(&self, touch: &Touch, force_by: &[nalgebra::RowVector6<f64>; 2], out: &mut Tangents) {
        let Some(resistance) = &self.resistance else { return };
        let (motion, rotating) = (&touch.at.relative, &touch.rotation);
        let (n, force) = (&touch.at.gap.normal, touch.normal_force[0]);
        let of = resistance.moment(&rotating.bristles, &rotating.spin, n);
        let yielding = resistance.bristles.yielding(&rotating.bristles, &rotating.spin);
        let rotation = &motion.rotation;
        let own = side_by_side(&Matrix3::zeros(), &Matrix3::identity());
        // At fixed twists of the nodes.
        let turning = skew(&rotation_part(&motion.twist));
        let spin_by = [
            rotation
                * (-own * lie_bracket_matrix(&motion.carried) - side_by_side(&Matrix3::zeros(), &turning)),
            rotation * own,
        ];
        let mut moment_by = [0, 1].map(|k| of.value * force_by[k] + force * of.by_spin * spin_by[k]);
        moment_by[0] += force * of.by_normal * touch.at.gap.normal_by;
        let local = rotation.tr_mul(&rotating.moment);
        let mut wrench_by = moment_by.map(|of| rotation.transpose() * of);
        wrench_by[0] += side_by_side(&Matrix3::zeros(), &skew(&local));
        let full = |by: &Matrix3x6| {
            let mut both = Matrix6::zeros();
            both.fixed_rows_mut::<3>(3).copy_from(by);
            both
        };
        let (size, wrench) = (out.size(), screw(&Vector3::zeros(), &local));
        self.point.frames.add_stiffness(
            motion,
            (&-wrench, &-full(&wrench_by[0])),
            (size, &mut out.stiffness),
        );
        self.point.frames.add_damping(motion, &-full(&wrench_by[1]), (size, &mut out.damping));
        let first = self.first_rotation();
        let by_bristles = rotation.transpose() * of.by_bristles * force;
        let deflecting_by = Matrix3::identity() - yielding.by_sliding;
        for (j, columns) in self.point.frames.columns(motion).iter().enumerate() {
            let block = -columns.fixed_rows::<3>(3).transpose() * by_bristles;
            add_block(&mut out.stiffness, size, (6 * j, first), &block);
            let rows = [-deflecting_by * spin_by[0] * columns, -deflecting_by * spin_by[1] * columns];
            add_block(&mut out.stiffness, size, (first, 6 * j), &rows[0]);
            add_block(&mut out.damping, size, (first, 6 * j), &rows[1]);
        }
        add_block(&mut out.stiffness, size, (first, first), &yielding.by_bristles);
    }
}

impl Element for Contact {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns { nodes: &self.point.frames.nodes, coordinates: &self.bristles, multipliers: &[] }
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        if self.is_apart(at) {
            for (force, &bristle) in out[BRISTLES..].iter_mut().zip(&self.bristles) {
                *force += at.coordinates[bristle].rate;
            }
            return;
        }
        let touch = self.touch(at);
        if touch.is_touching {
            self.point.frames.add_wrench(&touch.at.relative, &-touch.wrench(), out);
        }
        for (k, &bristle) in self.bristles.iter().enumerate() {
            let first = self.first_rotation() - BRISTLES;
            let of = if k < first { touch.deflecting[k] } else { touch.rotation.deflecting[k - first] };
            out[BRISTLES + k] += at.coordinates[bristle].rate - of;
        }
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let size = out.size();
        for k in 0..self.bristles.len() {
            out.damping[(BRISTLES + k) * size + BRISTLES + k] += 1.0;
        }
        if self.is_apart(at) {
            return;
        }
        let touch = self.touch(at);
        if !touch.is_touching {
            return;
        }
        let (n, normal_by) = (touch.at.gap.normal, touch.at.gap.normal_by);
        let [force, by_depth, by_closing] = touch.normal_force;
        let velocity_by = touch.at.velocity_by();
        let (rate_by, sliding_by) = (touch.at.rate_by(&velocity_by), touch.at.sliding_by(&velocity_by));
        // N by η and η̇.
        let force_by = [-by_depth * touch.at.gap_by() - by_closing * rate_by[0], -by_closing * rate_by[1]];
        let mut direction = n;
        let mut force_derivatives = [force * normal_by, Matrix3x6::zeros()];
        let mut by_bristles = Matrix3::zeros();
        if let Some(friction) = &self.friction {
            let share = friction.share(&touch.bristles, &touch.sliding, &n);
            direction -= share.force;
            let along = n.dot(&touch.bristles);
            let turned = along * normal_by + n * (touch.bristles.transpose() * normal_by);
            force_derivatives[0] += share.by_bristles * turned * force;
            for (of, sliding_by) in force_derivatives.iter_mut().zip(&sliding_by) {
                *of -= force * share.by_sliding * sliding_by;
            }
            by_bristles = share.by_bristles * (n * n.transpose() - Matrix3::identity()) * force;
        }
        for (of, own) in force_derivatives.iter_mut().zip(&force_by) {
            *of += direction * own;
        }
        self.add_resistance(&touch, &force_by, out);
        let size = out.size();
        let matrices = (size, &mut out.stiffness[..], &mut out.damping[..]);
        self.point.add_derivatives(&touch.at, (&touch.force, &force_derivatives), matrices);
        let Some(friction) = &self.friction else { return };
        let columns = self.point.frames.columns(&touch.at.relative);
        let yielding = friction.yielding(&touch.bristles, &touch.sliding);
        let deflecting_by = Matrix3::identity() - yielding.by_sliding;
        let wrench_by_bristles = {
            let local = touch.at.relative.rotation.transpose() * by_bristles;
            let mut both = SMatrix::<f64, 6, 3>::zeros();
            both.fixed_rows_mut::<3>(0).copy_from(&local);
            both.fixed_rows_mut::<3>(3).copy_from(&(skew(&touch.at.arm) * local));
            both
        };
        for (j, columns) in columns.iter().enumerate() {
            let block = -columns.transpose() * wrench_by_bristles;
            add_block(&mut out.stiffness, size, (6 * j, BRISTLES), &block);
            let rows = [-deflecting_by * sliding_by[0] * columns, -deflecting_by * sliding_by[1] * columns];
            add_block(&mut out.stiffness, size, (BRISTLES, 6 * j), &rows[0]);
            add_block(&mut out.damping, size, (BRISTLES, 6 * j), &rows[1]);
        }
        add_block(&mut out.stiffness, size, (BRISTLES, BRISTLES), &yielding.by_bristles);
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        if self.is_apart(at) {
            return Energy::default();
        }
        let touch = self.touch(at);
        let mut strain = 0.0;
        if touch.is_touching {
            let [force, ..] = self.compliance.force(-touch.at.gap.value, 0.0, 0.0);
            strain = self.compliance.energy(-touch.at.gap.value) + force * self.deflected(&touch);
        }
        Energy { strain, ..Energy::default() }
    }

    fn switch_states(&mut self) -> Option<&mut SwitchStates> {
        Some(&mut self.switch_states)
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities {
            spring: Some(self),
            validity: Some(self),
            laws: Some(self),
            strain: Some(self),
            load: Some(self),
            ..Capabilities::default()
        }
    }
}

/// What drives a moving surface works against its friction.
impl Load for Contact {
    fn is_active(&self) -> bool {
        self.point.surface.is_some()
    }

    fn power(&self, at: &Kinematics) -> f64 {
        if self.is_apart(at) {
            return 0.0;
        }
        let touch = self.touch(at);
        (touch.force - touch.normal_force[0] * touch.at.gap.normal).dot(&touch.at.driven())
    }

    fn work(&self, from: &Kinematics, to: &Kinematics) -> f64 {
        0.5 * (to.time - from.time) * (self.power(from) + self.power(to))
    }
}

impl ContactElement for Contact {
    fn reading(&self, at: &Kinematics) -> ContactReading {
        let touch = self.touch(at);
        let base = self.point.frames.base_rotation(at);
        let normal = touch.normal_force[0];
        let along = normal * touch.at.gap.normal;
        ContactReading {
            gap: touch.at.gap.value,
            normal,
            force: base * touch.force,
            friction: base * (touch.force - along),
            slip: touch.sliding.norm(),
            point: self.point.frames.base_frame(at).transform_point(&touch.at.gap.point),
            is_touching: touch.is_touching,
            is_sliding: touch.is_touching
                && self.friction.as_ref().is_none_or(|friction| friction.slips(&touch.bristles)),
        }
    }
}

impl Spring for Contact {
    fn dissipates(&self) -> bool {
        self.friction.is_some()
            || self.resistance.is_some()
            || match self.dissipation {
                Dissipation::Factor(factor) => factor > 0.0,
                Dissipation::AtTouch { relative, .. } => relative > 0.0,
            }
    }

    /// Gap, its rate and the normal force.
    fn spring_motion(&self, at: &Kinematics) -> [f64; 3] {
        let touch = self.touch(at);
        [touch.at.gap.value, touch.at.rate(), touch.normal_force[0]]
    }

    fn spring_gradients(&self, at: &Kinematics) -> Option<[Gradient; 3]> {
        let touch = self.touch(at);
        let gap_by = touch.at.gap_by().transpose();
        let rate_by = touch.at.rate_by(&touch.at.velocity_by());
        let (mut gap, mut rate) = (Gradient::zero(), Gradient::zero());
        for (j, columns) in self.point.frames.columns(&touch.at.relative).iter().enumerate() {
            let slots = 6 * j..6 * j + 6;
            gap.by_place[slots.clone()].copy_from_slice(columns.tr_mul(&gap_by).as_slice());
            rate.by_place[slots.clone()].copy_from_slice((rate_by[0] * columns).as_slice());
            rate.by_rate[slots].copy_from_slice((rate_by[1] * columns).as_slice());
        }
        let [force, by_depth, by_closing] = touch.normal_force;
        Some(Response { force, stiffness: -by_depth, damping: -by_closing }.gradients([gap, rate]))
    }
}

impl Validity for Contact {
    fn limits(&self) -> &'static [LimitKind] {
        &[LimitKind::Depth, LimitKind::Hollow]
    }

    fn limit(&self, kind: LimitKind, [_, at]: [&Kinematics; 2]) -> Option<Limit<'_>> {
        let pair = &self.point.pair;
        let [value, limit] = match kind {
            LimitKind::Depth if pair.deepest().is_finite() && !self.is_apart(at) => {
                [-self.point.gap(at), 0.5 * pair.deepest()]
            }
            LimitKind::Hollow => {
                let found = pair.hollow(&self.point.frames.relative(at).position)?;
                [found.remaining, found.depth]
            }
            _ => return None,
        };
        Some(Limit { value, limit, place: Place::Contact(&self.name) })
    }
}

impl ForceLaws for Contact {
    fn switch_count(&self) -> usize {
        1
    }

    fn is_idle(&self, at: &Kinematics) -> bool {
        self.is_apart(at)
    }

    fn switches(&self, at: &Kinematics, out: &mut Vec<Switch>) {
        out.push((-self.point.gap(at)).into());
    }

    fn laws(&self, at: &Kinematics, visit: &mut VisitLaw<'_>) {
        self.point.laws(self.compliance, at, visit);
    }
}

impl StrainSlopes for Contact {
    /// Friction is not the derivative of the energy of the bristles.
    fn strain_slopes(&self, fall: &Kinematics, out: &mut [f64]) {
        let touch = self.touch(fall);
        if !touch.is_touching {
            return;
        }
        let [force, stiffness, _] = self.compliance.force(-touch.at.gap.value, 0.0, 0.0);
        let slope = -(force + stiffness * self.deflected(&touch)) * touch.at.gap_by().transpose();
        self.point.frames.add_wrench(&touch.at.relative, &slope, out);
        if let Some(friction) = &self.friction {
            for (k, bristle) in touch.bristles.iter().enumerate() {
                out[BRISTLES + k] += force * friction.law.at_rest / friction.deflection * bristle;
            }
        }
        if let Some(resistance) = &self.resistance {
            for (k, bristle) in touch.rotation.bristles.iter().enumerate() {
                out[self.first_rotation() + k] += force * resistance.stiffness() * bristle;
            }
        }
    }
}

#[cfg(test)]
#[path = "../../tests/unit/elastic/mod.rs"]
mod tests;
