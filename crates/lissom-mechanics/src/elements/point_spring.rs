//! Spring and damper between two points of two nodes, along the line that joins them.
//!
//! ```text
//! Δ = x_B - x_A,   ℓ = |Δ|,   u = Δ/ℓ,   F = k (ℓ - ℓ₀) + c ℓ̇, or another law of ℓ - ℓ₀ and ℓ̇
//! ```

use lissom_motion::{Matrix3, Motion, Vector3, skew};
use nalgebra::{RowVector6, SMatrix};

use super::contribution::Contribution;
use super::force_law::{ForceLaw, PRELOAD_FORCE, Response, SIDE_OF_LENGTH};
use super::initial_model::InitialModel;
use super::kind::{Attached, ElementKind};
use super::law_of_distance::{self, LawOfDistance};
use super::{Capabilities, Element, Energy, ForceLaws, Load, Spring, Tangents, Unknowns, add_block};
use crate::evaluation::switch_states::SwitchStates;
use crate::kinematics::step_stages::{STAGES, StepStages, above_round_off};
use crate::kinematics::{CarriedFrame, Kinematics, NodeId, NodeMotion, Switch, split};
use crate::law::VisitLaw;
use crate::number::Written;
use crate::ports::Ports;
use crate::registry::ParameterType::NotNegative;
use crate::registry::{ParameterError, ParameterType, Parameters, optional};
use crate::signals::measurement::Gradient;

/// Registry entry.
pub(crate) const KIND: ElementKind = ElementKind {
    name: "point",
    summary: "Spring and damper between two points, along the line through them.",
    sample: "stiffness = 100.0\ndamping = 1.0",
    parameters: &[
        optional("stiffness", NotNegative, "N/m", "Stiffness.").or_number(0.0),
        optional("damping", NotNegative, "N s/m", "Damping.").or_number(0.0),
        optional(
            "force",
            ParameterType::Force(&["elongation", "rate"]),
            "N",
            "Force over `elongation` and `rate`, in addition to `stiffness`; a table is over `elongation`.",
        ),
        optional(
            "damper_force",
            ParameterType::Force(&["rate", "elongation"]),
            "N",
            "Force over `rate` and `elongation`, in addition to `damping`; a table is over `rate`.",
        ),
        SIDE_OF_LENGTH,
        optional("limits", ParameterType::Range, "N", "Minimum and maximum force; default: none."),
        optional("backlash", NotNegative, "m", "Width of the backlash about the free length, without force.")
            .or_number(0.0),
        optional("length", NotNegative, "m", "Free length; default: the length at the start."),
        PRELOAD_FORCE,
    ],
    ports: Ports::TWO_LOCATIONS,
    build,
};

/// Spring and damper between two points.
#[derive(Clone, Debug)]
pub(crate) struct PointSpring {
    nodes: [NodeId; 2],
    points: [Vector3; 2],
    law: ForceLaw,
    length: f64,
    switch_states: SwitchStates,
}

fn build(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
) -> Result<Contribution, ParameterError> {
    let (nodes, points) = attached.two_nodes()?;
    let [a, b] = [0, 1].map(|i| model.frame(nodes[i]).transform_point(&points[i]));
    let distance = (b - a).norm();
    if distance == 0.0 {
        return Err(ParameterError::new(
            "tip",
            "is at the same position as `base`: the spring has no direction",
        ));
    }
    let law = ForceLaw::new(parameters, ["force", "damper_force"])?;
    let length = law.rest(parameters, "length", [distance; 2])?;
    if length < 0.0 {
        let problem =
            format!("needs a length without force of {} m: give a larger `stiffness`", Written(length));
        return Err(ParameterError::new("preload", problem));
    }
    Ok(Contribution::of(
        model,
        PointSpring { nodes, points, law, length, switch_states: SwitchStates::default() },
    ))
}

/// Motion of an attachment point in inertial axes.
pub(super) struct Point {
    pub(super) position: Vector3,
    pub(super) velocity: Vector3,
    /// Velocity in the node's body axes.
    pub(super) local_velocity: Vector3,
    pub(super) rotation: Matrix3,
    pub(super) offset: Vector3,
}

impl Point {
    /// A point of the ground.
    pub(super) fn fixed(position: &Vector3) -> Self {
        let none = Vector3::zeros();
        let rotation = Matrix3::identity();
        Self { position: *position, velocity: none, local_velocity: none, rotation, offset: *position }
    }

    pub(super) fn new(node: &NodeMotion, offset: &Vector3) -> Self {
        let (v, w) = split(&node.twist);
        let local_velocity = v + w.cross(offset);
        Self {
            position: node.frame.transform_point(offset),
            velocity: node.frame.rotation.apply(&local_velocity),
            local_velocity,
            rotation: node.frame.rotation.matrix(),
            offset: *offset,
        }
    }

    /// Derivative of the position (or velocity) with respect to the node's body-frame degrees of freedom.
    pub(super) fn gradient(&self) -> SMatrix<f64, 3, 6> {
        let mut gradient = SMatrix::<f64, 3, 6>::zeros();
        gradient.fixed_view_mut::<3, 3>(0, 0).copy_from(&self.rotation);
        gradient.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-self.rotation * skew(&self.offset)));
        gradient
    }

    /// Derivative of the velocity along a `direction` with respect to the node's position, with which the velocity rotates:
    /// δ(R v) = -R ṽ δθ.
    pub(super) fn turning(&self, direction: &Vector3) -> RowVector6<f64> {
        let by_rotation = -direction.transpose() * (self.rotation * skew(&self.local_velocity));
        let mut row = RowVector6::zeros();
        row.fixed_columns_mut::<3>(3).copy_from(&by_rotation);
        row
    }
}

impl PointSpring {
    fn points(&self, at: &Kinematics) -> [Point; 2] {
        [0, 1].map(|i| Point::new(&at.nodes[self.nodes[i]], &self.points[i]))
    }

    /// Direction, length, its rate and the tension with its derivatives.
    fn tension(&self, at: &Kinematics, [a, b]: &[Point; 2]) -> (Vector3, f64, f64, Response) {
        let span = b.position - a.position;
        // The direction of a spring of zero length is undefined; any finite value is better for Newton's method than
        // NaN.
        let length = span.norm().max(f64::MIN_POSITIVE);
        let direction = span / length;
        let rate = direction.dot(&(b.velocity - a.velocity));
        (direction, length, rate, self.law.evaluate(length - self.length, rate, self.switch_states.of(at)))
    }
}

/// Adds the forces of a pull on the base's point, and the opposite one on the tip's [N, inertial axes].
pub(super) fn add_pull(points: &[Point; 2], pull: &Vector3, out: &mut [f64]) {
    for (i, sign) in [(0, -1.0), (1, 1.0)] {
        let local = points[i].rotation.tr_mul(&(sign * pull));
        let moment = points[i].offset.cross(&local);
        for k in 0..3 {
            out[6 * i + k] += local[k];
            out[6 * i + 3 + k] += moment[k];
        }
    }
}

impl Element for PointSpring {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.nodes)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let points = self.points(at);
        let (direction, _, _, tension) = self.tension(at, &points);
        add_pull(&points, &(tension.force * direction), out);
    }

    /// The elongation is integrated; the remaining error is corrected along the relative velocities of the points.
    fn stage_forces(&self, step: &StepStages<'_>, out: &mut [&mut [f64]; STAGES]) {
        let [a, b] = self.points(step.start);
        let before = b.position - a.position;
        let moved = |point: &Point, node: NodeId| {
            let change = &step.changes[node];
            point.rotation * (change.shift + change.turn * point.offset)
        };
        let moves = [moved(&a, self.nodes[0]), moved(&b, self.nodes[1])];
        let change = moves[1] - moves[0];
        let length = before.norm();
        let longer = change.dot(&(2.0 * before + change)) / (length + (before + change).norm());
        let points = step.stages.map(|at| self.points(at));
        let speeds = [0, 1].map(|j| points[j][1].velocity - points[j][0].velocity);
        let tensions = [0, 1].map(|j| self.tension(step.stages[j], &points[j]));
        let (inverse, shares) = step.shares(speeds.map(|speed| speed.norm_squared()));
        let missed = longer - step.whole(tensions.map(|(_, _, rate, _)| rate));
        let round_off = 16.0 * f64::EPSILON * (moves[0].norm() + moves[1].norm());
        let missed = missed * above_round_off(missed.abs(), round_off);
        let rates = [0, 1].map(|j| tensions[j].2 + shares[j] * missed);
        let lengths = step.at_stages(length, rates);
        for j in 0..STAGES {
            let sides = self.switch_states.of(step.stages[j]);
            let tension = self.law.evaluate(lengths[j] - self.length, rates[j], sides).force;
            let pull = tension * (tensions[j].0 + missed * inverse * speeds[j]);
            add_pull(&points[j], &pull, out[j]);
        }
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let points = self.points(at);
        let (u, length, _, response) = self.tension(at, &points);
        let tension = response.force;
        let across = (Matrix3::identity() - u * u.transpose()) / length;
        let speed = points[1].velocity - points[0].velocity;
        // δF u = [F across + k u uᵀ + c u (across Δ̇)ᵀ] δΔ + c u uᵀ δΔ̇
        let by_span = tension * across
            + response.stiffness * u * u.transpose()
            + response.damping * u * (across * speed).transpose();
        let by_speed = response.damping * u * u.transpose();
        let signs = [-1.0, 1.0];
        let gradients = [points[0].gradient(), points[1].gradient()];
        for i in 0..2 {
            for j in 0..2 {
                let sign = signs[i] * signs[j];
                // Δ̇ rotates with the node: δ(R v) = -R ṽ δθ.
                let mut turning = SMatrix::<f64, 3, 6>::zeros();
                turning
                    .fixed_view_mut::<3, 3>(0, 3)
                    .copy_from(&(-points[j].rotation * skew(&points[j].local_velocity)));
                let mut stiffness =
                    sign * gradients[i].transpose() * (by_span * gradients[j] + by_speed * turning);
                if i == j {
                    // The force in the axes of the rotating node: δ(Rᵀ t) = (Rᵀ t)~ δθ.
                    let local = skew(&points[i].rotation.tr_mul(&(signs[i] * tension * u)));
                    let moment = skew(&points[i].offset) * local;
                    for row in 0..3 {
                        for column in 0..3 {
                            stiffness[(row, 3 + column)] += local[(row, column)];
                            stiffness[(3 + row, 3 + column)] += moment[(row, column)];
                        }
                    }
                }
                let damping = sign * gradients[i].transpose() * by_speed * gradients[j];
                add_block(&mut out.stiffness, 12, (6 * i, 6 * j), &stiffness);
                add_block(&mut out.damping, 12, (6 * i, 6 * j), &damping);
            }
        }
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        let (_, length, _, _) = self.tension(at, &self.points(at));
        Energy { strain: self.law.energy(length - self.length), ..Energy::default() }
    }

    fn switch_states(&mut self) -> Option<&mut SwitchStates> {
        Some(&mut self.switch_states)
    }

    fn capabilities(&self) -> Capabilities<'_> {
        let frame =
            |i: usize| CarriedFrame { node: self.nodes[i], offset: Motion::translation(self.points[i]) };
        Capabilities {
            load: Some(self),
            spring: Some(self),
            frames: Some([frame(0), frame(1)]),
            laws: Some(self),
            ..Capabilities::default()
        }
    }
}

impl Load for PointSpring {
    fn is_active(&self) -> bool {
        self.law.is_active()
    }
}

impl Spring for PointSpring {
    fn span(&self, at: &Kinematics) -> Option<([NodeId; 2], Vector3)> {
        let [a, b] = self.points(at);
        let at_zero = self.law.evaluate(-self.length, 0.0, self.switch_states.of(at)).force;
        (at_zero != 0.0).then(|| (self.nodes, b.position - a.position))
    }

    fn dissipates(&self) -> bool {
        self.law.depends_on_rate()
    }

    fn spring_motion(&self, at: &Kinematics) -> [f64; 3] {
        let (_, length, rate, tension) = self.tension(at, &self.points(at));
        [length - self.length, rate, tension.force]
    }

    fn spring_gradients(&self, at: &Kinematics) -> [Gradient; 3] {
        let points = self.points(at);
        let (u, length, _, response) = self.tension(at, &points);
        let speed = points[1].velocity - points[0].velocity;
        // ℓ̇ = u·Δ̇, and δu = (Δ̇ across u)/ℓ at fixed Δ̇.
        let turned = (speed - u.dot(&speed) * u) / length;
        let (mut elongation, mut rate) = (Gradient::zero(), Gradient::zero());
        for (i, sign) in [(0, -1.0), (1, 1.0)] {
            let along = sign * u.transpose() * points[i].gradient();
            let by_place = sign * (turned.transpose() * points[i].gradient() + points[i].turning(&u));
            let slots = 6 * i..6 * i + 6;
            elongation.by_place[slots.clone()].copy_from_slice(along.as_slice());
            rate.by_rate[slots.clone()].copy_from_slice(along.as_slice());
            rate.by_place[slots].copy_from_slice(by_place.as_slice());
        }
        response.gradients([elongation, rate])
    }
}

impl ForceLaws for PointSpring {
    fn switch_count(&self) -> usize {
        self.law.switch_count()
    }

    fn switches(&self, at: &Kinematics, out: &mut Vec<Switch>) {
        let (_, length, rate, _) = self.tension(at, &self.points(at));
        self.law.switches(length - self.length, rate, self.switch_states.of(at), out);
    }

    fn laws(&self, at: &Kinematics, visit: &mut VisitLaw<'_>) {
        if !self.law.is_linear() {
            let [a, b] = self.points(at);
            let law = LawOfDistance { law: &self.law, length: self.length };
            visit(&law, &law_of_distance::arguments(&(b.position - a.position), &(b.velocity - a.velocity)));
        }
    }
}
