//! Spring and damper between two points of two nodes, along the line that joins them.
//!
//! ```text
//! Δ = x_B - x_A,   ℓ = |Δ|,   u = Δ/ℓ,   F = k (ℓ - ℓ₀) + c ℓ̇
//! ```

use lissom_motion::{Matrix3, Vector3, rotation_tangent, skew};
use nalgebra::SMatrix;

use super::interval::Interval;
use super::{Attached, Attachment, Element, ElementKind, Energy, Tangents, add_block};
use crate::registry::{Parameter, ParameterError, ParameterType, Parameters};
use crate::system::state::split;
use crate::system::{Builder, Kinematics, NodeId, NodeMotion};

/// Registry entry.
pub const KIND: ElementKind = ElementKind {
    name: "point",
    summary: "Spring and damper between two points, along the line that joins them.",
    sample: "stiffness = 100.0\ndamping = 1.0",
    parameters: &[
        Parameter::optional("stiffness", ParameterType::NotNegative, "N/m", "Stiffness; default 0."),
        Parameter::optional("damping", ParameterType::NotNegative, "N s/m", "Damping; default 0."),
        Parameter::optional(
            "length",
            ParameterType::NotNegative,
            "m",
            "Length at which it is free of force; default: the length at the start.",
        ),
    ],
    attachment: Attachment::TwoNodes,
    build,
};

/// Spring and damper between two points.
#[derive(Clone, Debug, PartialEq)]
pub struct PointSpring {
    nodes: [NodeId; 2],
    points: [Vector3; 2],
    stiffness: f64,
    damping: f64,
    length: f64,
}

fn build(builder: &mut Builder, attached: Attached, parameters: &Parameters) -> Result<(), ParameterError> {
    let (nodes, points) = attached.two_nodes()?;
    let [a, b] = [0, 1].map(|i| builder.initial_frame(nodes[i]).transform_point(&points[i]));
    let distance = (b - a).norm();
    if distance == 0.0 {
        return Err(ParameterError::new(
            "tip",
            "is at the same place as `base`: the spring has no direction",
        ));
    }
    builder.add_element(PointSpring {
        nodes,
        points,
        stiffness: parameters.number_or("stiffness", 0.0)?,
        damping: parameters.number_or("damping", 0.0)?,
        length: parameters.number_or("length", distance)?,
    });
    Ok(())
}

/// Motion of an attachment point in inertial axes.
struct Point {
    position: Vector3,
    velocity: Vector3,
    /// Velocity in the node's body axes.
    local_velocity: Vector3,
    rotation: Matrix3,
    offset: Vector3,
}

impl Point {
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

    /// Derivative of the position (or velocity) with respect to the node's body-frame freedoms.
    fn gradient(&self) -> SMatrix<f64, 3, 6> {
        let mut gradient = SMatrix::<f64, 3, 6>::zeros();
        gradient.fixed_view_mut::<3, 3>(0, 0).copy_from(&self.rotation);
        gradient.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-self.rotation * skew(&self.offset)));
        gradient
    }
}

impl PointSpring {
    fn points(&self, at: &Kinematics) -> [Point; 2] {
        [0, 1].map(|i| Point::new(&at.nodes[self.nodes[i]], &self.points[i]))
    }

    /// Direction, length, its rate and the tension.
    fn tension(&self, [a, b]: &[Point; 2]) -> (Vector3, f64, f64, f64) {
        let span = b.position - a.position;
        // The direction of a spring of no length is undefined; any finite answer serves Newton better
        // than NaN.
        let length = span.norm().max(f64::MIN_POSITIVE);
        let direction = span / length;
        let rate = direction.dot(&(b.velocity - a.velocity));
        (direction, length, rate, self.stiffness * (length - self.length) + self.damping * rate)
    }
}

impl Element for PointSpring {
    fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let points = self.points(at);
        let (direction, _, _, tension) = self.tension(&points);
        for (i, sign) in [(0, -1.0), (1, 1.0)] {
            let local = points[i].rotation.tr_mul(&(sign * tension * direction));
            let moment = points[i].offset.cross(&local);
            for k in 0..3 {
                out[6 * i + k] += local[k];
                out[6 * i + 3 + k] += moment[k];
            }
        }
    }

    /// Over H exp(τ ψ) a carried point X moves by R T(θ)ᵀ (u + θ × X), so with the mean span as direction the
    /// change of length is exactly linear in the increments: ℓ_b - ℓ_a = (Δ_a + Δ_b)·(Δ_b - Δ_a)/(ℓ_a + ℓ_b).
    fn mean_forces(&self, interval: &Interval<'_>, out: &mut [f64]) {
        let [from, to] = [interval.from, interval.to].map(|at| {
            let [a, b] = self.points(at);
            b.position - a.position
        });
        let (before, after) = (from.norm(), to.norm());
        let change = after - before;
        let tension = self.stiffness * (0.5 * (before + after) - self.length + interval.dissipation * change)
            + self.damping * interval.rate() * change;
        let pull = tension / (before + after).max(f64::MIN_POSITIVE) * (from + to);
        for (i, sign) in [(0, -1.0), (1, 1.0)] {
            let node = self.nodes[i];
            let theta = split(&interval.increments[node]).1;
            let local = interval.from.nodes[node].frame.rotation.apply_inverse(&(sign * pull));
            let local = rotation_tangent(&theta) * local;
            let moment = self.points[i].cross(&local);
            for k in 0..3 {
                out[6 * i + k] += local[k];
                out[6 * i + 3 + k] += moment[k];
            }
        }
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let points = self.points(at);
        let (u, length, _, tension) = self.tension(&points);
        let across = (Matrix3::identity() - u * u.transpose()) / length;
        let speed = points[1].velocity - points[0].velocity;
        // δF u = [F across + k u uᵀ + c u (across Δ̇)ᵀ] δΔ + c u uᵀ δΔ̇
        let by_span = tension * across
            + self.stiffness * u * u.transpose()
            + self.damping * u * (across * speed).transpose();
        let by_speed = self.damping * u * u.transpose();
        let signs = [-1.0, 1.0];
        let gradients = [points[0].gradient(), points[1].gradient()];
        for i in 0..2 {
            for j in 0..2 {
                let sign = signs[i] * signs[j];
                // Δ̇ turns with the node: δ(R v) = -R ṽ δθ.
                let mut turning = SMatrix::<f64, 3, 6>::zeros();
                turning
                    .fixed_view_mut::<3, 3>(0, 3)
                    .copy_from(&(-points[j].rotation * skew(&points[j].local_velocity)));
                let mut stiffness =
                    sign * gradients[i].transpose() * (by_span * gradients[j] + by_speed * turning);
                if i == j {
                    // The force seen from the turning node: δ(Rᵀ t) = (Rᵀ t)~ δθ.
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
        let (_, length, _, _) = self.tension(&self.points(at));
        Energy { strain: 0.5 * self.stiffness * (length - self.length).powi(2), ..Energy::default() }
    }
}
