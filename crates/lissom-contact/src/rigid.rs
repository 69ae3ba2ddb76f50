//! Rigid contact of two solids in one point: constraints of velocities that are released while the solids are apart.
//!
//! Legend, beside that of a [point](crate::point): λ multipliers, N = -λ normal force, f = -λ force on the tip; γ rate of return.
//!
//! ```text
//! slides or is saturated:   n·u + γ (g - g₀) = 0
//! sticks:                   u + γ (g - g₀) n = 0
//! ```
//!
//! γ (g - g₀) removes the drift of the gap that integrating velocities leaves; it is zero up to the errors of the scheme. g₀ is the
//! penetration as drawn, which is at most round-off: to press solids apart from there would supply energy. The impacts, and
//! which of the modes applies, are computed by `Simulation`; friction while it slides is an element, `elements::rigid_friction`.

use std::sync::Arc;

use lissom_motion::{Matrix3, Vector3, skew};
use nalgebra::SMatrix;

use crate::force_over_gap::{NOTHING, PENETRATION};
use crate::geometry::gap::{Gap, Matrix3x6, Pair};
use crate::point::{ContactPoint, PointMotion};
use crate::reading::ContactReading;
use lissom_mechanics::joints::constraint::{Constraint, Level, Port};
use lissom_mechanics::joints::evaluation_point::Increments;
use lissom_mechanics::kinematics::local_derivatives::add_block;
use lissom_mechanics::kinematics::{CarriedFrame, DiscreteValueId, Kinematics, NodeId, Quantity};
use lissom_mechanics::law::VisitLaw;

/// γ [1/s].
const RETURN_RATE: f64 = 10.0;
/// Forces below this fraction of the largest are zero: the shares of contacts that repeat each other are not known better.
const NO_FORCE: f64 = 2e-7;
/// Velocities below this fraction of the velocity of rest are zero.
const REST_FRACTION: f64 = 1e-3;

/// Local unknowns: those of two nodes.
const SIZE: usize = 12;

/// Names of the equations of a contact: the normal one, then those of sticking.
pub const EQUATIONS: [&str; 4] = [
    "no penetration",
    "sticking along the first axis",
    "sticking along the second axis",
    "sticking along the third axis",
];

/// Whether two solids touch, and how.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Apart, or touching without a force.
    Open,
    /// Touching; the tip slides, or there is no friction.
    Sliding,
    /// Touching, without sliding.
    Sticking,
    /// Touching without sliding, with the largest friction in a fixed direction: other contacts keep the part from sliding.
    Saturated,
    /// Touching without a force: other contacts keep the gap.
    Kept,
}

impl Mode {
    /// The held value of a mode.
    pub fn number(self) -> f64 {
        f64::from(self as u8)
    }

    /// Whether it has equations.
    pub fn is_closed(self) -> bool {
        matches!(self, Self::Sliding | Self::Sticking | Self::Saturated)
    }

    fn of_number(number: f64) -> Self {
        [Self::Open, Self::Sliding, Self::Sticking, Self::Saturated, Self::Kept]
            .into_iter()
            .find(|mode| mode.number() == number)
            .unwrap_or(Self::Open)
    }
}

/// Law of a rigid contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidLaw {
    /// Normal velocity after an impact over that before.
    pub restitution: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Impacts slower than this do not rebound [m/s].
    pub rest_velocity: f64,
}

/// Held values of a rigid contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidState {
    /// Number of its [`Mode`].
    pub mode: DiscreteValueId,
    /// Gap at which it touches, zero up to the errors of the scheme [m].
    pub offset: DiscreteValueId,
    /// Gap at the start if the solids penetrate each other there, otherwise zero, g₀ [m].
    pub drawn: DiscreteValueId,
    /// Largest normal force of all contacts that touched when its mode was determined [N].
    pub scale: DiscreteValueId,
    /// Direction against which friction acts, while it slides or is saturated; base's axes.
    pub direction: [DiscreteValueId; 3],
}

/// A rigid contact of two solids.
#[derive(Debug)]
pub struct RigidContact {
    /// Name in the model.
    pub name: String,
    /// Law.
    pub law: RigidLaw,
    /// Held values.
    pub held: RigidState,
    /// The normal multiplier; those of sticking follow, if there is friction.
    pub first_multiplier: usize,
    point: ContactPoint,
}

/// A vector of the sliding at a contact, with derivatives with respect to η, and with respect to η̇.
pub(crate) struct Varied {
    pub(crate) value: Vector3,
    pub(crate) by: [Matrix3x6; 2],
}

impl RigidContact {
    /// Between the frames of two solids: base and tip.
    pub fn new(
        name: String,
        frames: [CarriedFrame; 2],
        (pair, law): (Arc<dyn Pair>, RigidLaw),
        (held, first_multiplier): (RigidState, usize),
    ) -> Self {
        Self { name, law, held, first_multiplier, point: ContactPoint::new(frames, pair) }
    }

    /// Nodes of base and tip.
    pub fn nodes(&self) -> &[NodeId; 2] {
        &self.point.frames.nodes
    }

    /// Number of its multipliers.
    pub fn multiplier_count(&self) -> usize {
        if self.has_friction() { EQUATIONS.len() } else { 1 }
    }

    /// Whether there is friction.
    pub fn has_friction(&self) -> bool {
        self.law.friction > 0.0
    }

    /// The velocity below which it is at rest [m/s].
    pub fn still(&self) -> f64 {
        REST_FRACTION * self.law.rest_velocity
    }

    /// Force that is zero [N].
    pub fn no_force(&self, at: &Kinematics) -> f64 {
        NO_FORCE * at.held.get(self.held.scale.index()).copied().unwrap_or(0.0)
    }

    /// The mode.
    pub fn mode(&self, at: &Kinematics) -> Mode {
        at.held.get(self.held.mode.index()).map_or(Mode::Open, |number| Mode::of_number(*number))
    }

    /// Gap at which it touches [m].
    pub fn offset(&self, at: &Kinematics) -> f64 {
        at.held.get(self.held.offset.index()).copied().unwrap_or(0.0)
    }

    /// The gap beyond that as drawn, g - g₀ [m].
    fn drift(&self, at: &Kinematics, gap: f64) -> f64 {
        gap - at.held.get(self.held.drawn.index()).copied().unwrap_or(0.0)
    }

    /// The direction against which friction acts, in the base's axes; within the tangent plane only where it was set.
    pub fn direction(&self, at: &Kinematics) -> Vector3 {
        Vector3::from_fn(|k, _| at.held.get(self.held.direction[k].index()).copied().unwrap_or(0.0))
    }

    /// Gap and motion at the point of contact.
    pub fn touching(&self, at: &Kinematics) -> PointMotion {
        self.point.motion(at)
    }

    /// Force on the tip in the base's axes, without friction of sliding, for all multipliers [N].
    fn constraint_force(&self, mode: Mode, normal: &Vector3, multipliers: &[f64]) -> Vector3 {
        let of = |k: usize| multipliers.get(self.first_multiplier + k).copied().unwrap_or(0.0);
        match mode {
            Mode::Open | Mode::Kept => Vector3::zeros(),
            Mode::Sliding | Mode::Saturated => -of(0) * normal,
            Mode::Sticking => -Vector3::new(of(1), of(2), of(3)),
        }
    }

    /// Normal force and friction on the tip in the base's axes, for all multipliers [N].
    pub fn forces(&self, at: &Kinematics, multipliers: &[f64]) -> (f64, Vector3) {
        self.forces_of(&self.touching(at), at, multipliers)
    }

    fn forces_of(&self, touching: &PointMotion, at: &Kinematics, multipliers: &[f64]) -> (f64, Vector3) {
        let n = touching.gap.normal;
        let mode = self.mode(at);
        let force = self.constraint_force(mode, &n, multipliers);
        let normal = n.dot(&force);
        let friction = match mode {
            Mode::Sliding | Mode::Saturated if self.has_friction() => {
                -self.law.friction * normal * self.slip_direction(at, touching).value
            }
            Mode::Sticking => force - normal * n,
            _ => Vector3::zeros(),
        };
        (normal, friction)
    }

    /// What it reports, for all multipliers.
    pub fn reading(&self, at: &Kinematics, multipliers: &[f64]) -> ContactReading {
        let touching = self.touching(at);
        let (normal, friction) = self.forces_of(&touching, at, multipliers);
        let (base, axes) = (self.point.frames.base_frame(at), self.point.frames.base_rotation(at));
        let mode = self.mode(at);
        ContactReading {
            gap: touching.gap.value,
            normal,
            force: axes * (normal * touching.gap.normal + friction),
            friction: axes * friction,
            slip: touching.sliding().norm(),
            point: base.transform_point(&touching.gap.point),
            is_touching: mode != Mode::Open,
            is_sliding: mode == Mode::Sliding,
        }
    }

    /// Rows of three velocities of the tip's point, along the orthonormal columns of `axes` in the base's axes, by the unknowns of
    /// both nodes.
    pub fn rows(&self, touching: &PointMotion, axes: &Matrix3) -> SMatrix<f64, 3, SIZE> {
        let by_twist = axes.transpose() * touching.velocity_by_twist();
        let mut out = SMatrix::<f64, 3, SIZE>::zeros();
        for (j, columns) in self.point.frames.columns(&touching.relative).iter().enumerate() {
            out.fixed_columns_mut::<6>(6 * j).copy_from(&(by_twist * columns));
        }
        out
    }

    /// Accelerations along these axes that remain without accelerations of the nodes; the first is the normal [m/s²].
    pub fn remaining_acceleration(&self, at: &Kinematics, touching: &PointMotion, axes: &Matrix3) -> Vector3 {
        let mut place = axes.transpose() * touching.velocity_by_place();
        place.set_row(0, &touching.rate_by(&touching.velocity_by())[0]);
        let mut out = Vector3::zeros();
        for (columns, node) in
            self.point.frames.columns(&touching.relative).iter().zip(self.point.frames.nodes)
        {
            out += place * columns * at.nodes[node].twist;
        }
        out
    }

    /// The direction of sliding, continued beyond zero.
    ///
    /// Legend: a reference direction in the tangent plane, e = n × a, v₀ velocity that is zero.
    ///
    /// ```text
    /// (q a + (s·e) e)/r,      q² = (s·a)² + v₀²,      r² = q² + (s·e)²
    /// ```
    pub(crate) fn slip_direction(&self, at: &Kinematics, touching: &PointMotion) -> Varied {
        let n = touching.gap.normal;
        let normal_by = touching.gap.normal_by;
        let sliding = touching.sliding();
        let sliding_by = touching.sliding_by(&touching.velocity_by());
        let reference = self.direction(at);
        let tangent = reference - n * n.dot(&reference);
        let length = tangent.norm();
        if length <= 0.0 {
            return Varied { value: Vector3::zeros(), by: [Matrix3x6::zeros(); 2] };
        }
        let a = tangent / length;
        let e = n.cross(&a);
        let tangent_by = -n.dot(&reference) * normal_by - n * (reference.transpose() * normal_by);
        let a_by = (Matrix3::identity() - a * a.transpose()) * tangent_by / length;
        let e_by = -skew(&a) * normal_by + skew(&n) * a_by;
        let (along, aside) = (sliding.dot(&a), sliding.dot(&e));
        let still = self.still();
        let q = along.hypot(still);
        let r = q.hypot(aside);
        let value = (q * a + aside * e) / r;
        let by = [0, 1].map(|k| {
            let (mut along_by, mut aside_by) = (a.transpose() * sliding_by[k], e.transpose() * sliding_by[k]);
            if k == 0 {
                along_by += sliding.transpose() * a_by;
                aside_by += sliding.transpose() * e_by;
            }
            let q_by = along_by * (along / q);
            let r_by = (q_by * q + aside_by * aside) / r;
            let mut sum = a * q_by + e * aside_by - value * r_by;
            if k == 0 {
                sum += a_by * q + e_by * aside;
            }
            sum / r
        });
        Varied { value, by }
    }

    /// Adds the forces of a force on the tip, on the left-hand side, to those on both nodes.
    pub(crate) fn add_force(&self, touching: &PointMotion, force: &Vector3, out: &mut [f64]) {
        self.point.add_force(touching, force, out);
    }

    /// Adds their derivatives to local matrices with rows of `size`.
    pub(crate) fn add_derivatives(
        &self,
        touching: &PointMotion,
        by: (&Vector3, &[Matrix3x6; 2]),
        matrices: (usize, &mut [f64], &mut [f64]),
    ) {
        self.point.add_derivatives(touching, by, matrices);
    }

    /// Rows with respect to η as rows with respect to the unknowns of both nodes.
    fn add_rows<const N: usize>(&self, touching: &PointMotion, rows: &SMatrix<f64, N, 6>, out: &mut [f64]) {
        for (j, columns) in self.point.frames.columns(&touching.relative).iter().enumerate() {
            add_block(out, SIZE, (0, 6 * j), &(rows * columns));
        }
    }

    /// The products of rows with the twists of the nodes.
    fn by_twists(&self, at: &Kinematics, rows: &[f64], out: &mut [f64]) {
        for (value, row) in out.iter_mut().zip(rows.chunks_exact(SIZE)) {
            let twists = self.point.frames.nodes.iter().flat_map(|&node| at.nodes[node].twist.iter());
            *value = row.iter().zip(twists).map(|(by, rate)| by * rate).sum();
        }
    }

    /// Adds the derivatives of Bᵀ λ for a force on the tip and its derivative.
    fn add_hessian(&self, touching: &PointMotion, force: &Vector3, force_by: &Matrix3x6, out: &mut [f64]) {
        let by_place = touching.wrench_by(force, force_by, true);
        self.point.frames.add_stiffness(
            &touching.relative,
            (&-touching.wrench(force), &-by_place),
            (SIZE, out),
        );
    }
}

/// Keeps two solids that touch from penetrating each other, and from separating and sliding while their contact sticks.
#[derive(Clone, Debug)]
pub struct RigidConstraint {
    /// The contact.
    pub contact: Arc<RigidContact>,
    /// Whether it acts while the contact sticks, in all three directions; otherwise while it does not, along the normal.
    pub sticks: bool,
}

impl RigidConstraint {
    /// Calls `add` with the motion at the point, unless it is released.
    fn acting(&self, at: &Kinematics, add: impl FnOnce(&RigidContact, &PointMotion)) {
        if !self.is_released(at) {
            add(&self.contact, &self.contact.touching(at));
        }
    }
}

impl Constraint for RigidConstraint {
    fn name(&self) -> &str {
        &self.contact.name
    }

    fn level(&self) -> Level {
        Level::Velocity
    }

    fn is_released(&self, at: &Kinematics) -> bool {
        match self.contact.mode(at) {
            Mode::Sticking => !self.sticks,
            Mode::Sliding | Mode::Saturated => self.sticks,
            Mode::Open | Mode::Kept => true,
        }
    }

    fn first_multiplier(&self) -> usize {
        self.contact.first_multiplier + usize::from(self.sticks)
    }

    fn equations(&self) -> usize {
        if self.sticks { 3 } else { 1 }
    }

    fn quantity(&self, _equation: usize) -> Quantity {
        Quantity::Length
    }

    fn ports(&self) -> usize {
        self.contact.point.frames.nodes.len()
    }

    fn port(&self, _arrangement: usize, index: usize) -> Port {
        Port::Node(self.contact.point.frames.nodes[index])
    }

    fn violation(&self, _at: &Kinematics, out: &mut [f64]) {
        out.fill(0.0);
    }

    fn violation_change(&self, _increments: &Increments<'_>, _time_elapsed: (f64, f64), out: &mut [f64]) {
        out.fill(0.0);
    }

    fn gradient(&self, at: &Kinematics, out: &mut [f64]) {
        self.acting(at, |contact, touching| {
            if self.sticks {
                contact.add_rows(touching, &touching.velocity_by_twist(), out);
            } else {
                contact.add_rows(touching, &touching.gap_by(), out);
            }
        });
    }

    fn constraint_hessian(&self, at: &Kinematics, multipliers: &[f64], out: &mut [f64]) {
        self.acting(at, |contact, touching| {
            let (force, by) = if self.sticks {
                (-Vector3::from_column_slice(&multipliers[..3]), Matrix3x6::zeros())
            } else {
                let normal_force = -multipliers[0];
                (normal_force * touching.gap.normal, normal_force * touching.gap.normal_by)
            };
            contact.add_hessian(touching, &force, &by, out);
        });
    }

    fn rate_derivatives(&self, at: &Kinematics, out: &mut [f64]) {
        self.acting(at, |contact, touching| {
            if self.sticks {
                let Gap { value, normal, normal_by, .. } = touching.gap;
                let returning = normal * touching.gap_by() + contact.drift(at, value) * normal_by;
                contact.add_rows(touching, &(touching.velocity_by_place() + RETURN_RATE * returning), out);
            } else {
                let rows = touching.rate_by(&touching.velocity_by())[0] + RETURN_RATE * touching.gap_by();
                contact.add_rows(touching, &rows, out);
            }
        });
    }

    fn time_derivative(&self, at: &Kinematics, out: &mut [f64]) {
        self.acting(at, |contact, touching| {
            let returning = RETURN_RATE * contact.drift(at, touching.gap.value);
            if self.sticks {
                out.copy_from_slice((returning * touching.gap.normal).as_slice());
            } else {
                out[0] = returning;
            }
        });
    }

    fn acceleration(&self, at: &Kinematics, out: &mut [f64]) {
        let mut rows = [0.0; 3 * SIZE];
        self.rate_derivatives(at, &mut rows[..self.equations() * SIZE]);
        self.contact.by_twists(at, &rows, out);
    }

    /// Passes the penetration as a law while the solids are apart.
    fn laws(&self, at: &Kinematics, visit: &mut VisitLaw<'_>) {
        if !self.sticks {
            let compliance = if self.contact.mode(at) == Mode::Open { PENETRATION } else { NOTHING };
            self.contact.point.laws(compliance, at, visit);
        }
    }
}
