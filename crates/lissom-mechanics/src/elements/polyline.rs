//! Length of a polyline through points that nodes or the ground carry, less its free length: what springs between two points and ropes
//! resist.
//!
//! Legend: x_p positions, Δ_i = x_{i+1} - x_i with length ℓ_i and direction u_i, L free length, L₀(t) as given, q_d coordinates of drums
//! with initial values q_d0, r_d length paid out per unit.
//!
//! ```text
//! e = Σ ℓ_i - L,   ė = Σ u_i·Δ̇_i - L̇,   L = L₀(t) + Σ r_d (q_d - q_d0)
//! ∂e:   at positions  g_p = ∂Σℓ/∂x_p = u_{p-1} - u_p,   at drums  ∂e/∂q_d = -r_d,      δu_i = (1 - u_i u_iᵀ)/ℓ_i δΔ_i
//! ```

use lissom_motion::{Matrix3, Motion, Vector3, skew};
use nalgebra::{RowVector6, SMatrix};

use super::force_law::ForceLaw;
use super::law_of_distance::{self, LawOfDistance};
use super::over_measure::{Measure, StageForce};
use super::{Limit, LimitKind, Tangents, Unknowns, add_block};
use crate::kinematics::step_stages::{STAGES, StepStages, above_round_off};
use crate::kinematics::{CarriedFrame, CoordinateId, Kinematics, NodeId, NodeMotion, split};
use crate::law::VisitLaw;
use crate::registry::Function;
use crate::signals::measurement::Gradient;

/// A polyline through at most `N` points.
#[derive(Clone, Debug)]
pub(super) struct Polyline<const N: usize> {
    pub(super) nodes: Vec<NodeId>,
    /// Points in their order along the line: the index of the node, none for the ground, and the point on it.
    pub(super) places: Vec<(Option<usize>, Vector3)>,
    /// Free length L₀ [m].
    pub(super) length: Function,
    /// Coordinates of drums, and for each the length paid out per unit and its initial value.
    pub(super) drums: Vec<CoordinateId>,
    pub(super) pays_out: Vec<[f64; 2]>,
    /// Frames at both ends, unless it slides over its points as a rope.
    pub(super) frames: Option<[CarriedFrame; 2]>,
}

/// Motion of a point in inertial axes.
pub(super) struct Point {
    pub(super) position: Vector3,
    pub(super) velocity: Vector3,
    /// Velocity in the node's body axes.
    local_velocity: Vector3,
    pub(super) rotation: Matrix3,
    pub(super) offset: Vector3,
}

impl Point {
    /// A point of the ground.
    fn fixed(position: &Vector3) -> Self {
        let none = Vector3::zeros();
        let rotation = Matrix3::identity();
        Self { position: *position, velocity: none, local_velocity: none, rotation, offset: *position }
    }

    fn new(node: &NodeMotion, offset: &Vector3) -> Self {
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
    fn turning(&self, direction: &Vector3) -> RowVector6<f64> {
        let by_rotation = -direction.transpose() * (self.rotation * skew(&self.local_velocity));
        let mut row = RowVector6::zeros();
        row.fixed_columns_mut::<3>(3).copy_from(&by_rotation);
        row
    }
}

/// A straight part of the line.
#[derive(Clone, Copy, Default)]
struct Segment {
    direction: Vector3,
    length: f64,
    speed: Vector3,
}

/// The line at one instant.
pub(super) struct Shape<const N: usize> {
    points: [Point; N],
    segments: [Segment; N],
    /// Number of points.
    count: usize,
    /// Elongation and its rate [m, m/s].
    motion: [f64; 2],
    /// Free length and its rate [m, m/s].
    free: [f64; 2],
}

impl<const N: usize> Shape<N> {
    fn segments(&self) -> &[Segment] {
        if N == 2 { &self.segments[..1] } else { &self.segments[..self.count - 1] }
    }

    /// Difference of a quantity of the segments before and after the point `index`.
    fn difference(&self, index: usize, of: impl Fn(&Segment) -> Vector3) -> Vector3 {
        let before = index.checked_sub(1).map_or_else(Vector3::zeros, |before| of(&self.segments[before]));
        before - self.segments().get(index).map_or_else(Vector3::zeros, of)
    }

    /// Derivative of the length with respect to the point `index`.
    fn pull(&self, index: usize) -> Vector3 {
        self.difference(index, |segment| segment.direction)
    }
}

impl Polyline<2> {
    /// The straight line between points of two nodes.
    pub(super) fn between(nodes: [NodeId; 2], [from, to]: [Vector3; 2], length: Function) -> Self {
        let places = vec![(Some(0), from), (Some(1), to)];
        let (drums, pays_out) = (Vec::new(), Vec::new());
        let frame = |node, point| CarriedFrame { node, offset: Motion::translation(point) };
        let frames = Some([frame(nodes[0], from), frame(nodes[1], to)]);
        Self { nodes: nodes.to_vec(), places, length, drums, pays_out, frames }
    }
}

impl<const N: usize> Polyline<N> {
    /// The points, from the motions of their nodes.
    #[inline]
    pub(super) fn points<'k>(&self, motion: impl Fn(NodeId) -> &'k NodeMotion) -> [Point; N] {
        std::array::from_fn(|index| match self.places.get(index) {
            Some((Some(node), place)) => Point::new(motion(self.nodes[*node]), place),
            Some((None, place)) => Point::fixed(place),
            None => Point::fixed(&Vector3::zeros()),
        })
    }

    /// Free length and its rate [m, m/s].
    pub(super) fn free(&self, at: &Kinematics) -> [f64; 2] {
        let mut free = [self.length.value(at.time), self.length.first_derivative(at.time)];
        for (&drum, [radius, start]) in self.drums.iter().zip(&self.pays_out) {
            free[0] += radius * (at.coordinates[drum].value - start);
            free[1] += radius * at.coordinates[drum].rate;
        }
        free
    }

    /// Points that nodes carry: their index, and that of the node.
    fn carried(&self) -> impl Iterator<Item = (usize, usize)> {
        self.places.iter().enumerate().filter_map(|(index, (node, _))| Some((index, (*node)?)))
    }

    /// Adds the forces of pulls on all points [N, inertial axes].
    fn add_pulls(&self, shape: &Shape<N>, pull: impl Fn(usize) -> Vector3, out: &mut [f64]) {
        for (index, node) in self.carried() {
            let point = &shape.points[index];
            let local = point.rotation.tr_mul(&pull(index));
            let moment = point.offset.cross(&local);
            for k in 0..3 {
                out[6 * node + k] += local[k];
                out[6 * node + 3 + k] += moment[k];
            }
        }
    }

    /// Adds the forces of a tension on drums.
    pub(super) fn add_winding(&self, tension: f64, out: &mut [f64]) {
        for (k, [radius, _]) in self.pays_out.iter().enumerate() {
            out[6 * self.nodes.len() + k] -= radius * tension;
        }
    }
}

impl<const N: usize> Measure for Polyline<N> {
    type Reading = Shape<N>;

    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns { nodes: &self.nodes, coordinates: &self.drums, multipliers: &[] }
    }

    fn read(&self, at: &Kinematics) -> Shape<N> {
        let points = self.points(|node| &at.nodes[node]);
        let count = if N == 2 { N } else { self.places.len() };
        let mut segments = [Segment::default(); N];
        for (segment, pair) in segments.iter_mut().zip(points[..count].windows(2)) {
            let span = pair[1].position - pair[0].position;
            // Without length it has no direction; any finite value is better for Newton's method than NaN.
            let length = span.norm().max(f64::MIN_POSITIVE);
            *segment =
                Segment { direction: span / length, length, speed: pair[1].velocity - pair[0].velocity };
        }
        let length: f64 = segments[..count - 1].iter().map(|own| own.length).sum();
        let rate: f64 = segments[..count - 1].iter().map(|own| own.direction.dot(&own.speed)).sum();
        let free = self.free(at);
        Shape { points, segments, count, motion: [length - free[0], rate - free[1]], free }
    }

    fn motion(shape: &Shape<N>) -> [f64; 2] {
        shape.motion
    }

    fn gradients(&self, shape: &Shape<N>) -> [Gradient; 2] {
        let (mut elongation, mut rate) = (Gradient::zero(), Gradient::zero());
        let add = |sum: &mut [f64], node: usize, row: &RowVector6<f64>| {
            sum[6 * node..].iter_mut().zip(row.iter()).for_each(|(sum, value)| *sum += value);
        };
        let turned = |segment: &Segment| {
            let Segment { direction, length, speed } = segment;
            (speed - direction.dot(speed) * direction) / *length
        };
        for (index, node) in self.carried() {
            let (point, pull) = (&shape.points[index], shape.pull(index));
            let gradient = point.gradient();
            add(&mut elongation.by_place, node, &(pull.transpose() * gradient));
            let by_place = shape.difference(index, turned).transpose() * gradient + point.turning(&pull);
            add(&mut rate.by_place, node, &by_place);
        }
        for (k, [radius, _]) in self.pays_out.iter().enumerate() {
            elongation.by_place[6 * self.nodes.len() + k] = -radius;
        }
        rate.by_rate = elongation.by_place;
        [elongation, rate]
    }

    fn add_force(&self, shape: &Shape<N>, tension: f64, out: &mut [f64]) {
        self.add_pulls(shape, |index| tension * shape.pull(index), out);
        self.add_winding(tension, out);
    }

    fn add_bend(&self, shape: &Shape<N>, tension: f64, out: &mut Tangents) {
        let size = out.size();
        for (index, node) in self.carried() {
            let (point, pull) = (&shape.points[index], shape.pull(index));
            // The force in the axes of the rotating node: δ(Rᵀ f) = (Rᵀ f)~ δθ.
            let local = skew(&point.rotation.tr_mul(&(tension * pull)));
            add_block(&mut out.stiffness, size, (6 * node, 6 * node + 3), &local);
            add_block(&mut out.stiffness, size, (6 * node + 3, 6 * node + 3), &(skew(&point.offset) * local));
        }
        let gradients = shape.points.each_ref().map(Point::gradient);
        for (index, segment) in shape.segments().iter().enumerate() {
            let u = segment.direction;
            let across = (Matrix3::identity() - u * u.transpose()) * (tension / segment.length);
            let ends = [(index, -1.0), (index + 1, 1.0)];
            for (a, sign) in ends {
                let Some(row) = self.places[a].0 else { continue };
                let rows = gradients[a].tr_mul(&(sign * across));
                for (b, other) in ends {
                    let Some(column) = self.places[b].0 else { continue };
                    let block = other * rows * gradients[b];
                    add_block(&mut out.stiffness, size, (6 * row, 6 * column), &block);
                }
            }
        }
    }

    /// The length is integrated; the remaining error is corrected along the relative velocities of the points. The length paid out by a
    /// winch is known exactly, as are coordinates.
    fn stage_forces(&self, step: &StepStages<'_>, force: &StageForce<'_>, out: &mut [&mut [f64]; STAGES]) {
        let start = self.read(step.start);
        let mut moves = [Vector3::zeros(); N];
        for (index, node) in self.carried() {
            let (change, point) = (&step.changes[self.nodes[node]], &start.points[index]);
            moves[index] = point.rotation * (change.shift + change.turn * point.offset);
        }
        let longer: f64 = (start.segments().iter().zip(moves.windows(2)))
            .map(|(segment, moves)| {
                let (before, change) = (segment.length * segment.direction, moves[1] - moves[0]);
                change.dot(&(2.0 * before + change)) / (segment.length + (before + change).norm())
            })
            .sum();
        let shapes = step.stages.map(|at| self.read(at));
        let rates = shapes.each_ref().map(|shape| shape.motion[1] + shape.free[1]);
        let square =
            |shape: &Shape<N>| shape.segments().iter().map(|own| own.speed.norm_squared()).sum::<f64>();
        let (inverse, shares) = step.shares([square(&shapes[0]), square(&shapes[1])]);
        let missed = longer - step.whole(rates);
        let round_off = 16.0 * f64::EPSILON * moves.iter().map(Vector3::norm).sum::<f64>();
        let missed = missed * above_round_off(missed.abs(), round_off);
        let rates = [0, 1].map(|j| rates[j] + shares[j] * missed);
        let lengths = step.at_stages(start.motion[0] + start.free[0], rates);
        for j in 0..STAGES {
            let shape = &shapes[j];
            let tension = force(j, [lengths[j] - shape.free[0], rates[j] - shape.free[1]]);
            let along = |segment: &Segment| segment.direction + missed * inverse * segment.speed;
            self.add_pulls(shape, |index| tension * shape.difference(index, along), out[j]);
            self.add_winding(tension, out[j]);
        }
    }

    /// A winch supplies energy.
    fn breakpoints(&self) -> Option<Vec<f64>> {
        (!self.length.is_constant()).then(|| self.length.breakpoints())
    }

    fn visit(&self, law: &ForceLaw, shape: &Shape<N>, visit: &mut VisitLaw<'_>) {
        if self.frames.is_none() {
            visit(law, &shape.motion);
            return;
        }
        let segment = &shape.segments[0];
        let law = LawOfDistance { law, length: shape.free[0] };
        visit(&law, &law_of_distance::arguments(&(segment.length * segment.direction), &segment.speed));
    }

    fn frames(&self) -> Option<[CarriedFrame; 2]> {
        self.frames
    }

    const LIMITS: &'static [LimitKind] = &[LimitKind::Slack, LimitKind::Stretch, LimitKind::Reversal];

    fn limit(
        &self,
        kind: LimitKind,
        step: [&Kinematics; 2],
        force: &dyn Fn([f64; 2], &Kinematics) -> f64,
    ) -> Option<Limit<'_>> {
        match (kind, &self.frames) {
            (LimitKind::Slack | LimitKind::Stretch, None) => {
                Some(length_of_rope(kind, self, step[1], &self.length))
            }
            (LimitKind::Reversal, Some(ends)) => {
                let span = |at: &Kinematics| {
                    let [a, b] =
                        ends.map(|own| at.nodes[own.node].frame.transform_point(&own.offset.position));
                    (force([-self.free(at)[0], 0.0], at) != 0.0).then(|| b - a)
                };
                let [before, after] = [span(step[0])?, span(step[1])?];
                Some(Limit::of_element(-before.dot(&after), 0.0))
            }
            _ => None,
        }
    }
}

/// How much longer or shorter a rope is than the way along its points.
pub(super) fn length_of_rope<M: Measure>(
    kind: LimitKind,
    measure: &M,
    at: &Kinematics,
    length: &Function,
) -> Limit<'static> {
    let [elongation, _] = M::motion(&measure.read(at));
    let sign = if kind == LimitKind::Slack { -1.0 } else { 1.0 };
    Limit::of_element(sign * elongation, length.value(at.time))
}
