//! Length of a rope over sheaves with a radius, over which it slides without friction, and onto drums at its ends, less its free length.
//!
//! Legend: c centres, a axes, ρ radii, positive where the rope turns about the axis in the positive sense from its first point to its last,
//! and zero for points; d = c_j - c_i for the span from i to j, κ = a_i·a_j; u_e direction of the tangent as seen along the axis of its end
//! e, α_e its angle about the axis in axes of the node, P_e the point where it touches, u direction between these points.
//!
//! ```text
//! k_i = ρ_j κ - ρ_i,   k_j = ρ_j - ρ_i κ,   D_e = |a_e × d|,   ℓ_e² = D_e² - k_e²,   u_e = (ℓ_e (a_e × d) × a_e - k_e a_e × d)/D_e²
//! P_e = c_e + ρ_e u_e × a_e,      length = Σ |P_j - P_i| + ρ_i α_i - ρ_j α_j
//! δ|P_j - P_i| + ρ_i δα_i - ρ_j δα_j = u·(δx_Pj - δx_Pi) + m_j δα_j - m_i δα_i,   m_e = ρ_e (u·u_e - 1),   δα_e = (a_e × u_e)/ℓ_e·δd + …
//! ```
//!
//! x_P is the point of the body at P: the tension acts there, along u. Terms with m are of second order in the angle between the rope and
//! the plane of a sheave, and zero in this plane. They make the force the gradient of the length.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4, FRAC_PI_8, PI, TAU};
use std::ops::Neg;
use std::sync::Arc;

use lissom_motion::{Matrix3, Vector3, Vector6, skew};
use nalgebra::SMatrix;

use super::kind::Sheave;
use super::over_measure::{Measure, StageForce};
use super::polyline::{Point, Polyline, length_of_rope};
use super::rope::MAX_PLACES;
use super::{Limit, LimitKind, Place, Tangents, Unknowns, add_block};
use crate::dual::{Dual, Number, Three, cross, dot, sum, times};
use crate::kinematics::step_stages::{STAGES, StepStages, above_round_off};
use crate::kinematics::{CoordinateId, Kinematics, MAX_NODES, USUAL_UNKNOWNS};
use crate::registry::{Constant, Function, ParameterError};
use crate::round_off;
use crate::signals::measurement::Gradient;

/// A sheave or drum.
#[derive(Clone, Debug)]
struct Wheel {
    /// ρ [m].
    radius: f64,
    /// Axis, and two perpendicular directions, in axes of the node.
    axis: Vector3,
    across: [Vector3; 2],
    /// Angle of a drum's span at the start, or least wrap angle of a sheave that is distinguished from one more turn [rad].
    from: f64,
    /// Coordinate of a drum's joint, its sign about the axis, and its initial value.
    drum: Option<(CoordinateId, f64, f64)>,
}

/// A rope over sheaves.
#[derive(Clone, Debug)]
pub(super) struct Reeving {
    line: Polyline<MAX_PLACES>,
    /// Sheaves and drums, one entry for each point of the line.
    wheels: Vec<Option<Wheel>>,
}

/// Tangent between two sheaves, and the derivatives of its part of the length.
#[derive(Clone, Copy)]
struct Span<T> {
    length: T,
    /// u_e.
    directions: [Three<T>; 2],
    /// u.
    along: Three<T>,
    /// With respect to the centre of its end; the opposite with respect to that of its start.
    force: Three<T>,
    /// With respect to rotations of start and end about their centres.
    moments: [Three<T>; 2],
}

/// The tangent over `d` between two sheaves, and whether it exists.
fn tangent<T: Number>(d: Three<T>, axes: [Three<T>; 2], radii: [f64; 2]) -> (Span<T>, bool) {
    let zero = [T::constant(0.0); 3];
    let minus = |own: Three<T>| own.map(Neg::neg);
    let cosine = dot(axes[0], axes[1]);
    let (mut directions, mut arms, mut lengths) = ([zero; 2], [zero; 2], [T::constant(1.0); 2]);
    let (mut chord, mut exists) = (d, true);
    for e in [0, 1] {
        if radii[e] == 0.0 {
            continue;
        }
        let sign = [1.0, -1.0][e];
        let k = cosine.scaled(radii[1 - e]).plus(-radii[e]).scaled(sign);
        let across = cross(axes[e], d);
        let square = dot(across, across);
        let remaining = square - k * k;
        // Circles that overlap have no tangent; any finite value is better for Newton's method than NaN.
        let is_there = remaining.value() > 1e-12 * square.value();
        exists &= is_there;
        lengths[e] = if is_there {
            remaining.square_root()
        } else {
            T::constant(1e-6 * square.value().sqrt().max(f64::MIN_POSITIVE))
        };
        let in_plane = times(cross(across, axes[e]), lengths[e] / square);
        directions[e] = sum(in_plane, times(across, -k / square));
        arms[e] = cross(directions[e], axes[e]).map(|own| own.scaled(radii[e]));
        chord = sum(chord, arms[e].map(|own| own.scaled(-sign)));
    }
    let length = dot(chord, chord).plus(f64::MIN_POSITIVE).square_root();
    let along = times(chord, T::constant(1.0) / length);
    let excess = [0, 1].map(|e| {
        if radii[e] == 0.0 { zero[0] } else { dot(along, directions[e]).plus(-1.0).scaled(radii[e]) }
    });
    let beside = [0, 1].map(|e| times(cross(axes[e], directions[e]), excess[e] / lengths[e]));
    let twist = excess[1].scaled(radii[0]) / lengths[1] + excess[0].scaled(radii[1]) / lengths[0];
    let twist = times(cross(axes[0], axes[1]), twist);
    let first = sum(sum(cross(along, arms[0]), cross(d, beside[0])), twist);
    let second = sum(cross(arms[1], along), minus(sum(cross(d, beside[1]), twist)));
    let force = sum(along, sum(beside[1], minus(beside[0])));
    (Span { length, directions, along, force, moments: [first, second] }, exists)
}

/// An angle in the interval of one turn from `from` on.
fn in_turn(angle: f64, from: f64) -> f64 {
    from + (angle - from).rem_euclid(TAU)
}

/// Angle from one direction to another about an axis [rad].
fn angle_about(axis: &Vector3, from: &Vector3, to: &Vector3) -> f64 {
    axis.dot(&from.cross(to)).atan2(from.dot(to))
}

/// The rope at one instant.
pub(super) struct Shape {
    points: [Point; MAX_PLACES],
    spans: [Span<f64>; MAX_PLACES - 1],
    count: usize,
    /// Whether each span exists.
    exists: bool,
    twists: [Vector6; MAX_NODES],
    /// Derivatives of the length by the nodes.
    slopes: [f64; 6 * MAX_NODES],
    /// Elongation and its rate, free length and its rate [m, m/s].
    motion: [f64; 2],
    free: [f64; 2],
}

impl Shape {
    fn speed(&self, span: usize) -> Vector3 {
        self.points[span + 1].velocity - self.points[span].velocity
    }

    fn spans(&self) -> &[Span<f64>] {
        &self.spans[..self.count - 1]
    }
}

/// What is wrong with a rope at one of its points, counted from 1 on.
pub(super) fn fault_at(point: usize, problem: &str) -> ParameterError {
    ParameterError::new("along", format!("has a sheave at point {point} {problem}"))
}

impl Reeving {
    /// The rope of a `line` with `sheaves` at some of its points, and coordinates of the joints of drums among them.
    pub(super) fn new(
        points: &[Point; MAX_PLACES],
        line: Polyline<MAX_PLACES>,
        sheaves: &[(usize, Sheave)],
        coordinates: Vec<(CoordinateId, f64)>,
    ) -> Result<Self, ParameterError> {
        let count = line.places.len();
        let mut coordinates = coordinates.into_iter();
        let mut wheels = vec![None; count];
        for (index, own) in sheaves {
            let (point, rotation) = (index + 1, points[*index].rotation);
            let axis = own.axis.normalize();
            let neighbours = [*index, index + 1].map(|end| {
                let start = end.checked_sub(1).filter(|_| end < count)?;
                Some(axis.cross(&(points[end].position - points[start].position)).normalize())
            });
            let is_positive = match (own.is_positive, neighbours) {
                (Some(given), _) => given,
                (None, [Some(before), Some(after)]) => {
                    let sine = axis.dot(&before.cross(&after));
                    if sine.is_nan() || sine.abs() < round_off::GIVEN {
                        return Err(fault_at(
                            point,
                            "whose side does not follow from its neighbours, which are in line with it: specify `sense`",
                        ));
                    }
                    sine > 0.0
                }
                _ => {
                    return Err(fault_at(
                        point,
                        "at an end of the rope, on which it is wound: specify `sense`",
                    ));
                }
            };
            let across = axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize();
            let local = |own: Vector3| rotation.tr_mul(&own);
            let drum = own.turns.and_then(|sign| {
                let (coordinate, start) = coordinates.next()?;
                Some((coordinate, sign, start))
            });
            wheels[*index] = Some(Wheel {
                radius: if is_positive { own.radius } else { -own.radius },
                axis: local(axis),
                across: [local(across), local(axis.cross(&across))],
                from: 0.0,
                drum,
            });
        }
        let mut reeving = Self { line, wheels };
        reeving.begin(points)?;
        Ok(reeving)
    }

    /// Stores the angles at the start.
    fn begin(&mut self, points: &[Point; MAX_PLACES]) -> Result<(), ParameterError> {
        let (spans, exists) = self.spans(points);
        let (wheels, last) = (self.wheels.clone(), self.wheels.len() - 1);
        for (index, own) in wheels.iter().enumerate() {
            let Some(own) = own else { continue };
            if !exists {
                return Err(fault_at(index + 1, "that overlaps a neighbour: move them apart"));
            }
            if let Some(angle) = self.fleet(points, &spans, index) {
                let problem = format!(
                    "whose plane the rope leaves at {:.0} degrees: turn `axis`, or move the neighbours into the plane",
                    angle.to_degrees()
                );
                return Err(fault_at(index + 1, &problem));
            }
            let from = if index == 0 || index == last {
                self.angle(points, &spans, index, own)
            } else {
                let wrap = in_turn(self.angle(points, &spans, index, own), 0.0);
                // It is taken to pass the sheave on its other side.
                if wrap > TAU - FRAC_PI_4 {
                    let problem = format!(
                        "that it would wrap by {:.0} degrees: it passes on the other side. Specify the other `sense`, or remove the sheave",
                        wrap.to_degrees()
                    );
                    return Err(fault_at(index + 1, &problem));
                }
                -(0.5 * PI).min(0.5 * (TAU - wrap))
            };
            if let Some(wheel) = &mut self.wheels[index] {
                wheel.from = from;
            }
        }
        Ok(())
    }

    /// Length at the start without what is wound on drums [m].
    pub(super) fn initial_length(&self, points: &[Point; MAX_PLACES]) -> f64 {
        let start = |own| {
            let drums = self.wheels.iter().flatten().filter_map(|wheel| wheel.drum);
            drums.filter(|drum| drum.0 == own).map(|drum| drum.2).next().unwrap_or_default()
        };
        self.length(points, &self.spans(points).0, start)
    }

    /// Sets the free length [m].
    pub(super) fn set_length(&mut self, length: f64) {
        self.line.length = Arc::new(Constant(length));
    }

    /// Axis in inertial axes and signed radius.
    fn wheel(&self, points: &[Point; MAX_PLACES], index: usize) -> (Vector3, f64) {
        let none = (Vector3::zeros(), 0.0);
        self.wheels[index].as_ref().map_or(none, |own| (points[index].rotation * own.axis, own.radius))
    }

    fn spans(&self, points: &[Point; MAX_PLACES]) -> ([Span<f64>; MAX_PLACES - 1], bool) {
        let none = [0.0; 3];
        let none = Span { length: 0.0, directions: [none; 2], along: none, force: none, moments: [none; 2] };
        let (mut spans, mut all_exist) = ([none; MAX_PLACES - 1], true);
        for (index, span) in spans[..self.wheels.len() - 1].iter_mut().enumerate() {
            let d = points[index + 1].position - points[index].position;
            let [(a, r), (b, s)] = [index, index + 1].map(|end| self.wheel(points, end));
            let exists;
            (*span, exists) = tangent(d.into(), [a.into(), b.into()], [r, s]);
            all_exist &= exists;
        }
        (spans, all_exist)
    }

    /// Angle of a drum's span in axes of the node, without whole turns, or wrap angle of a sheave in the sense of the rope [rad].
    fn angle(&self, points: &[Point; MAX_PLACES], spans: &[Span<f64>], index: usize, own: &Wheel) -> f64 {
        let before = index.checked_sub(1).map(|before| Vector3::from(spans[before].directions[1]));
        let after = (index + 1 < self.wheels.len()).then(|| Vector3::from(spans[index].directions[0]));
        match (before, after) {
            (Some(before), Some(after)) => {
                let (axis, radius) = self.wheel(points, index);
                angle_about(&axis, &before, &after) * radius.signum()
            }
            (one, other) => {
                let direction = points[index].rotation.tr_mul(&one.or(other).unwrap_or_default());
                own.across[1].dot(&direction).atan2(own.across[0].dot(&direction))
            }
        }
    }

    /// Angles by which a drum's span has turned relative to the node and to the carrier, or the wrap angle of a sheave in both places [rad].
    fn turned(
        &self,
        points: &[Point; MAX_PLACES],
        spans: &[Span<f64>],
        (index, own): (usize, &Wheel),
        coordinate: impl Fn(CoordinateId) -> f64,
    ) -> [f64; 2] {
        let angle = self.angle(points, spans, index, own);
        if index > 0 && index + 1 < self.wheels.len() {
            return [in_turn(angle, own.from); 2];
        }
        let unwound = own.drum.map_or(0.0, |(drum, sign, start)| sign * (coordinate(drum) - start));
        let departure = in_turn(angle - own.from + unwound, -PI);
        [departure - unwound, departure]
    }

    fn length(
        &self,
        points: &[Point; MAX_PLACES],
        spans: &[Span<f64>],
        coordinate: impl Fn(CoordinateId) -> f64 + Copy,
    ) -> f64 {
        let mut length: f64 = spans[..self.wheels.len() - 1].iter().map(|own| own.length).sum();
        for (index, own) in self.wheels.iter().enumerate() {
            let Some(own) = own else { continue };
            let [angle, _] = self.turned(points, spans, (index, own), coordinate);
            length += angle
                * match index {
                    0 => own.radius,
                    last if last + 1 == self.wheels.len() => -own.radius,
                    _ => own.radius.abs(),
                };
        }
        length
    }

    /// Angle between the rope and the plane of a sheave, if it is too large [rad].
    fn fleet(&self, points: &[Point; MAX_PLACES], spans: &[Span<f64>], index: usize) -> Option<f64> {
        let (axis, _) = self.wheel(points, index);
        let neighbours =
            index.checked_sub(1).into_iter().chain((index + 1 < self.wheels.len()).then_some(index));
        let sine =
            neighbours.map(|span| axis.dot(&Vector3::from(spans[span].along)).abs()).fold(0.0, f64::max);
        (sine > FRAC_1_SQRT_2).then(|| sine.min(1.0).asin())
    }

    /// Adds a force at the point `index` and a moment about it, in inertial axes.
    fn add(
        &self,
        shape: &[Point; MAX_PLACES],
        index: usize,
        (force, moment): (Vector3, Vector3),
        out: &mut [f64],
    ) {
        let Some(node) = self.line.places[index].0 else { return };
        let point = &shape[index];
        let local = point.rotation.tr_mul(&force);
        let moment = point.offset.cross(&local) + point.rotation.tr_mul(&moment);
        for k in 0..3 {
            out[6 * node + k] += local[k];
            out[6 * node + 3 + k] += moment[k];
        }
    }

    /// Adds the second derivatives of the length times a `tension`: derivatives of the forces by displacements in axes of the nodes.
    fn add_curvature(&self, shape: &Shape, tension: f64, size: usize, out: &mut [f64]) {
        for (index, span) in shape.spans().iter().enumerate() {
            let ends = [index, index + 1];
            let [(a, r), (b, s)] = ends.map(|end| self.wheel(&shape.points, end));
            let d = shape.points[index + 1].position - shape.points[index].position;
            let variables = |own: Vector3, from: usize| -> Three<Dual<9>> {
                std::array::from_fn(|k| Dual::variable(own[k], from + k))
            };
            let (slopes, _) = tangent(variables(d, 0), [variables(a, 3), variables(b, 6)], [r, s]);
            let matrix = |own: Three<Dual<9>>| SMatrix::<f64, 3, 9>::from_fn(|i, k| tension * own[i].by[k]);
            let (force, moments) = (matrix(slopes.force), slopes.moments.map(matrix));
            // Displacements and rotations of both nodes change d and the axes.
            let inputs = [0, 1].map(|e| {
                let (point, sign) = (&shape.points[ends[e]], [-1.0, 1.0][e]);
                let mut by = SMatrix::<f64, 9, 6>::zeros();
                by.fixed_view_mut::<3, 6>(0, 0).copy_from(&(sign * point.gradient()));
                let axis = self.wheels[ends[e]].as_ref().map_or_else(Vector3::zeros, |own| own.axis);
                by.fixed_view_mut::<3, 3>(3 + 3 * e, 3).copy_from(&(-point.rotation * skew(&axis)));
                by
            });
            for e in [0, 1] {
                let Some(row) = self.line.places[ends[e]].0 else { continue };
                let (point, sign) = (&shape.points[ends[e]], [-1.0, 1.0][e]);
                let offset = skew(&point.offset);
                let local = |own: Three<f64>| skew(&point.rotation.tr_mul(&(tension * Vector3::from(own))));
                // The force in the axes of the rotating node: δ(Rᵀ f) = (Rᵀ f)~ δθ.
                let turned: Matrix3 = sign * local(span.force);
                add_block(out, size, (6 * row, 6 * row + 3), &turned);
                let moment: Matrix3 = offset * turned + local(span.moments[e]);
                add_block(out, size, (6 * row + 3, 6 * row + 3), &moment);
                for (c, by) in inputs.iter().enumerate() {
                    let Some(column) = self.line.places[ends[c]].0 else { continue };
                    let force: SMatrix<f64, 3, 6> = sign * point.rotation.tr_mul(&(force * by));
                    let moment = offset * force + point.rotation.tr_mul(&(moments[e] * by));
                    add_block(out, size, (6 * row, 6 * column), &force);
                    add_block(out, size, (6 * row + 3, 6 * column), &moment);
                }
            }
        }
    }

    /// Adds the forces of a tension at the nodes.
    fn add_slopes(shape: &Shape, tension: f64, out: &mut [f64]) {
        out.iter_mut().zip(&shape.slopes).for_each(|(out, slope)| *out += tension * slope);
    }
}

impl Measure for Reeving {
    type Reading = Shape;

    fn unknowns(&self) -> Unknowns<'_> {
        self.line.unknowns()
    }

    fn read(&self, at: &Kinematics) -> Shape {
        let points = self.line.points(|node| &at.nodes[node]);
        let (spans, exists) = self.spans(&points);
        let length = self.length(&points, &spans, |own| at.coordinates[own].value);
        let (count, free) = (self.wheels.len(), self.line.free(at));
        let mut slopes = [0.0; 6 * MAX_NODES];
        for (index, span) in spans[..count - 1].iter().enumerate() {
            let force = Vector3::from(span.force);
            self.add(&points, index, (-force, span.moments[0].into()), &mut slopes);
            self.add(&points, index + 1, (force, span.moments[1].into()), &mut slopes);
        }
        let nodes = &self.line.nodes;
        let twists: [Vector6; MAX_NODES] =
            std::array::from_fn(|k| nodes.get(k).map_or_else(Vector6::zeros, |&node| at.nodes[node].twist));
        let all = twists.iter().flat_map(Vector6::iter);
        let rate: f64 = slopes.iter().zip(all).map(|(slope, twist)| slope * twist).sum();
        let motion = [length - free[0], rate - free[1]];
        Shape { points, spans, count, exists, twists, slopes, motion, free }
    }

    fn motion(shape: &Shape) -> [f64; 2] {
        shape.motion
    }

    fn gradients(&self, shape: &Shape) -> [Gradient; 2] {
        let (mut elongation, mut rate) = (Gradient::zero(), Gradient::zero());
        let size = 6 * self.line.nodes.len();
        elongation.by_place[..size].copy_from_slice(&shape.slopes[..size]);
        self.line.add_winding(1.0, &mut elongation.by_place);
        let mut curvature = [0.0; USUAL_UNKNOWNS * USUAL_UNKNOWNS];
        self.add_curvature(shape, 1.0, size, &mut curvature);
        let twists = shape.twists.iter().flat_map(Vector6::iter);
        for (row, twist) in curvature.chunks_exact(size).zip(twists) {
            rate.by_place.iter_mut().zip(row).for_each(|(sum, own)| *sum += twist * own);
        }
        rate.by_rate = elongation.by_place;
        [elongation, rate]
    }

    fn add_force(&self, shape: &Shape, tension: f64, out: &mut [f64]) {
        Self::add_slopes(shape, tension, out);
        self.line.add_winding(tension, out);
    }

    fn add_bend(&self, shape: &Shape, tension: f64, out: &mut Tangents) {
        let size = out.size();
        self.add_curvature(shape, tension, size, &mut out.stiffness);
    }

    /// The length is integrated as that of ropes over points.
    fn stage_forces(&self, step: &StepStages<'_>, force: &StageForce<'_>, out: &mut [&mut [f64]; STAGES]) {
        let [start, end] = [step.start, step.end].map(|at| self.read(at));
        let whole = |shape: &Shape| shape.motion[0] + shape.free[0];
        let shapes = step.stages.map(|at| self.read(at));
        let rates = shapes.each_ref().map(|shape| shape.motion[1] + shape.free[1]);
        let square =
            |shape: &Shape| (0..shape.count - 1).map(|span| shape.speed(span).norm_squared()).sum::<f64>();
        let (inverse, shares) = step.shares([square(&shapes[0]), square(&shapes[1])]);
        let missed = whole(&end) - whole(&start) - step.whole(rates);
        let round_off = 64.0 * f64::EPSILON * (whole(&end).abs() + TAU * step.length);
        let missed = missed * above_round_off(missed.abs(), round_off);
        let rates = [0, 1].map(|j| rates[j] + shares[j] * missed);
        let lengths = step.at_stages(whole(&start), rates);
        for j in 0..STAGES {
            let shape = &shapes[j];
            let tension = force(j, [lengths[j] - shape.free[0], rates[j] - shape.free[1]]);
            self.add_force(shape, tension, out[j]);
            for span in 0..shape.count - 1 {
                let along = tension * missed * inverse * shape.speed(span);
                self.add(&shape.points, span, (-along, Vector3::zeros()), out[j]);
                self.add(&shape.points, span + 1, (along, Vector3::zeros()), out[j]);
            }
        }
    }

    fn breakpoints(&self) -> Option<Vec<f64>> {
        self.line.breakpoints()
    }

    const LIMITS: &'static [LimitKind] = &[LimitKind::Slack, LimitKind::Stretch, LimitKind::Sheave];

    fn limit(
        &self,
        kind: LimitKind,
        [_, at]: [&Kinematics; 2],
        force: &dyn Fn([f64; 2], &Kinematics) -> f64,
    ) -> Option<Limit<'_>> {
        if kind != LimitKind::Sheave {
            return Some(length_of_rope(kind, self, at, &self.line.length));
        }
        let shape = self.read(at);
        if force(shape.motion, at) == 0.0 {
            return None;
        }
        let (index, how) = self.off_sheave(&shape, |own| at.coordinates[own].value)?;
        Some(Limit { value: 1.0, limit: 0.0, place: Place::Point(index, how) })
    }
}

impl Reeving {
    /// The first point at which it no longer lies on its sheave, and how.
    fn off_sheave(
        &self,
        shape: &Shape,
        value: impl Fn(CoordinateId) -> f64 + Copy,
    ) -> Option<(usize, String)> {
        if !shape.exists {
            return Some((1, "has no tangent between two sheaves or drums, which overlap".to_owned()));
        }
        for (index, own) in self.wheels.iter().enumerate() {
            let Some(own) = own else { continue };
            if let Some(angle) = self.fleet(&shape.points, shape.spans(), index) {
                let angle = angle.to_degrees();
                return Some((index, format!("leaves the plane of the sheave at {angle:.0} degrees")));
            }
            let is_end = index == 0 || index + 1 == shape.count;
            let [_, angle] = self.turned(&shape.points, shape.spans(), (index, own), value);
            let degrees = angle.to_degrees();
            // A direction that is nearly reversed could have turned either way.
            if is_end && angle.abs() > PI - FRAC_PI_8 {
                let cause = if own.drum.is_some() {
                    "relative to the carrier of its drum"
                } else {
                    "relative to its drum without `joint`"
                };
                return Some((index, format!("has turned by {degrees:.1} degrees {cause}")));
            }
            if !is_end && (angle < -round_off::EQUILIBRIUM || angle > own.from + TAU - FRAC_PI_8) {
                return Some((
                    index,
                    format!("no longer lies on the sheave: its wrap angle is {degrees:.1} degrees"),
                ));
            }
        }
        None
    }
}

/// The line of a rope in its initial position, for pictures: for each of its points the sequence along the arc, or the point itself. None
/// if it has no such line.
#[must_use]
pub fn path(points: &[Vector3], sheaves: &[(usize, Sheave)]) -> Option<Vec<Vec<Vector3>>> {
    if points.len() > MAX_PLACES || points.len() < 2 {
        return None;
    }
    let places = points.iter().map(|point| (None, *point)).collect();
    let length: Function = Arc::new(Constant(0.0));
    let line =
        Polyline { nodes: Vec::new(), places, length, drums: Vec::new(), pays_out: Vec::new(), frames: None };
    let points = line.points(|_| unreachable!("all points are on the ground"));
    let reeving = Reeving::new(&points, line, sheaves, Vec::new()).ok()?;
    let (spans, _) = reeving.spans(&points);
    let of_point = |(index, own): (usize, &Option<Wheel>)| {
        let centre = points[index].position;
        let Some(wheel) = own else { return vec![centre] };
        let is_end = index == 0 || index + 1 == reeving.wheels.len();
        let wrap = if is_end { 0.0 } else { reeving.turned(&points, &spans, (index, wheel), |_| 0.0)[0] };
        let direction = if index == 0 { spans[0].directions[0] } else { spans[index - 1].directions[1] };
        let arm = wheel.radius * Vector3::from(direction).cross(&wheel.axis);
        let count = if is_end { 0 } else { (wrap / PI * 18.0 - 1e-6).ceil().max(1.0) as u32 };
        let share = |k: u32| wrap * wheel.radius.signum() * f64::from(k) / f64::from(count.max(1));
        (0..=count)
            .map(|k| centre + lissom_motion::Rotation::about_axis(&wheel.axis, share(k)).apply(&arm))
            .collect()
    };
    Some(reeving.wheels.iter().enumerate().map(of_point).collect())
}

#[cfg(test)]
#[path = "../../tests/unit/elements/reeving.rs"]
mod tests;
