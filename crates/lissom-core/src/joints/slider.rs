//! Slider along a beam: a point of the tip stays on the line through the beam's nodes, wherever along it.
//!
//! Legend: x_t the tip's point, s the coordinate, x(s) = Σ w_k(s) x_k the line (see `centerline`), R_k rotation of a node, o_k
//! its section's point in its axes, m_k = R_kᵀ μ, a_k and v_k acceleration and velocity of a point.
//!
//! ```text
//! c = x_t - Σ w_k(s) x_k = 0  in inertial axes,      c̈ = a_t - Σ (w_k a_k + 2 w_k' ṡ v_k + w_k'' ṡ² x_k + w_k' s̈ x_k)
//! forces Bᵀ μ: tip [m_t, o_t × m_t],   node k: -w_k [m_k, o_k × m_k],   s: -Σ w_k' x_k · μ
//! ```
//!
//! The beam takes the force at its point x(s), without moments on sections: Σ w_k = 1 and Σ w_k x_k = x(s) leave momentum and
//! angular momentum what they were. The row of s says that the force stands across the line.

use lissom_motion::{Matrix3, Vector3, Vector6, skew};

use super::attached::Increments;
use super::centerline::{Centerline, SUPPORT, Support};
use super::{Build, JointKind};
use crate::system::{CoordinateId, Kinematics, NodeId, NodeMotion};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "slider",
    summary: "A point of the tip slides along a flexible beam or a chain of beams, past the borders of elements.",
    sample: "",
    parameters: &[],
    build: Build::AlongBeams,
};

/// Equations of a slider.
pub(crate) const EQUATIONS: usize = 3;
/// The tip among the local nodes.
const TIP: usize = SUPPORT;
/// The coordinate's local unknown.
pub(crate) const OWN: usize = 6 * (SUPPORT + 1);
/// Local unknowns: four nodes of the beam, the tip, the coordinate.
pub(crate) const LOCAL: usize = OWN + 1;

/// One number per local unknown.
pub(crate) type Row = [f64; LOCAL];

/// A point that a node carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarriedPoint {
    /// The node.
    pub node: NodeId,
    /// The point in the node's frame [m].
    pub point: Vector3,
}

impl CarriedPoint {
    fn motion<'a>(&self, at: &'a Kinematics) -> &'a NodeMotion {
        &at.nodes[self.node]
    }

    /// Its place [m].
    pub fn place(&self, at: &Kinematics) -> Vector3 {
        self.motion(at).frame.transform_point(&self.point)
    }

    /// Its change of place since the start of a step, without cancellation [m].
    fn shift(&self, increments: &Increments<'_>) -> Vector3 {
        let change = &increments.nodes[self.node];
        let local = change.shift + change.turn * self.point;
        self.motion(increments.start).frame.rotation.apply(&local)
    }
}

/// A slider with its place in the system.
#[derive(Debug)]
pub struct Slider {
    /// Name in the model.
    pub name: String,
    /// Nodes along the beams, with the points of their sections.
    pub(crate) nodes: Vec<CarriedPoint>,
    pub(crate) line: Centerline,
    /// What slides.
    pub tip: CarriedPoint,
    /// Arc length of the undeformed beams up to the point [m].
    pub coordinate: CoordinateId,
    /// Its first multiplier among all; there are three, the force on the beam in inertial axes [N].
    pub first_multiplier: usize,
    /// By interval between nodes: local row, local column and position in the tangent's pattern of every entry that is there;
    /// multipliers follow the local unknowns.
    pub(crate) entries: Vec<Vec<(usize, usize, usize)>>,
}

/// Where a slider is.
pub(crate) struct Place {
    /// Between which nodes.
    pub(crate) interval: usize,
    support: Support,
}

impl Slider {
    /// Length of the undeformed beams [m].
    pub fn length(&self) -> f64 {
        self.line.length()
    }

    /// Where it is.
    pub(crate) fn place(&self, at: &Kinematics) -> Place {
        let s = at.coordinates[self.coordinate].value;
        Place { interval: self.line.interval(s), support: self.line.at(s) }
    }

    fn carried(&self, place: &Place, local: usize) -> &CarriedPoint {
        if local == TIP { &self.tip } else { &self.nodes[place.support.first + local] }
    }

    /// Local nodes of the beam, each with the factor of its place in a derivative of c by s.
    fn on_beam(place: &Place, derivative: usize) -> impl Iterator<Item = (usize, f64)> {
        let Support { count, weights, .. } = place.support;
        (0..count).map(move |k| (k, -weights[derivative][k]))
    }

    /// The same for c itself, and the tip.
    fn all(place: &Place) -> impl Iterator<Item = (usize, f64)> {
        Self::on_beam(place, 0).chain([(TIP, 1.0)])
    }

    /// Nodes by local number in an interval.
    pub(crate) fn nodes_of(&self, interval: usize) -> [Option<NodeId>; SUPPORT + 1] {
        let (first, count) = self.line.nodes_of(interval);
        std::array::from_fn(|k| match k {
            TIP => Some(self.tip.node),
            _ if k < count => Some(self.nodes[first + k].node),
            _ => None,
        })
    }

    /// Violation, evaluated outright [m].
    pub fn violation(&self, at: &Kinematics) -> Vector3 {
        self.tip.place(at) - self.along(&self.place(at), 0, at)
    }

    /// Change of the violation since the start of the step, without cancellation [m].
    pub(crate) fn violation_change(&self, increments: &Increments<'_>) -> Vector3 {
        let start = increments.start.coordinates[self.coordinate].value;
        let change = increments.coordinates[self.coordinate];
        let moved = self.line.at(start + change).sum(0, |node| self.nodes[node].shift(increments));
        let slid = self.line.change(start, change, |node| self.nodes[node].place(increments.start));
        self.tip.shift(increments) - moved - slid
    }

    /// A derivative of x(s) by s.
    fn along(&self, place: &Place, derivative: usize, at: &Kinematics) -> Vector3 {
        place.support.sum(derivative, |node| self.nodes[node].place(at))
    }

    /// B by equation.
    pub(crate) fn gradient(&self, place: &Place, at: &Kinematics) -> [Row; EQUATIONS] {
        let mut rows = [[0.0; LOCAL]; EQUATIONS];
        for (k, factor) in Self::all(place) {
            let own = self.carried(place, k);
            let axes = own.motion(at).frame.rotation.matrix();
            let turning = -axes * skew(&own.point);
            for (e, row) in rows.iter_mut().enumerate() {
                for i in 0..3 {
                    row[6 * k + i] = factor * axes[(e, i)];
                    row[6 * k + 3 + i] = factor * turning[(e, i)];
                }
            }
        }
        let tangent = self.along(place, 1, at);
        for (row, slope) in rows.iter_mut().zip(tangent.iter()) {
            row[OWN] = -slope;
        }
        rows
    }

    /// Derivatives of Bᵀ μ at constant multipliers, by row and column of the local unknowns.
    pub(crate) fn curvature(&self, place: &Place, at: &Kinematics, mu: &Vector3) -> [Row; LOCAL] {
        let mut out = [[0.0; LOCAL]; LOCAL];
        let local_force = |k: usize| {
            let own = self.carried(place, k);
            (own.motion(at).frame.rotation.apply_inverse(mu), own.point)
        };
        for (k, factor) in Self::all(place) {
            let (force, point) = local_force(k);
            // δ(Rᵀ μ) = m̃ δθ in body axes.
            let turned: Matrix3 = factor * skew(&force);
            let moment = skew(&point) * turned;
            for i in 0..3 {
                for j in 0..3 {
                    out[6 * k + i][6 * k + 3 + j] = turned[(i, j)];
                    out[6 * k + 3 + i][6 * k + 3 + j] = moment[(i, j)];
                }
            }
        }
        for (k, factor) in Self::on_beam(place, 1) {
            let (force, point) = local_force(k);
            let moment = point.cross(&force);
            for i in 0..3 {
                for (row, value) in [(6 * k + i, factor * force[i]), (6 * k + 3 + i, factor * moment[i])] {
                    out[row][OWN] = value;
                    out[OWN][row] = value;
                }
            }
        }
        out[OWN][OWN] = -self.along(place, 2, at).dot(mu);
        out
    }

    /// Rates of the local unknowns.
    pub(crate) fn speeds(&self, place: &Place, at: &Kinematics) -> Row {
        let mut speeds = [0.0; LOCAL];
        for (k, _) in Self::all(place) {
            let twist = self.carried(place, k).motion(at).twist;
            speeds[6 * k..6 * k + 6].copy_from_slice(twist.as_slice());
        }
        speeds[OWN] = at.coordinates[self.coordinate].rate;
        speeds
    }

    /// s̈ as it follows from the accelerations of nodes, by the least squares of c̈ = 0 [m/s²]. Schemes know that of a massless
    /// coordinate to a lower order.
    pub fn coordinate_acceleration(&self, at: &Kinematics) -> f64 {
        let place = self.place(at);
        let gradient = self.gradient(&place, at);
        let mut missing = self.acceleration(at);
        for (k, _) in Self::all(&place) {
            let acceleration = self.carried(&place, k).motion(at).acceleration;
            for (e, row) in gradient.iter().enumerate() {
                missing[e] += (0..6).map(|i| row[6 * k + i] * acceleration[i]).sum::<f64>();
            }
        }
        let tangent = self.along(&place, 1, at);
        tangent.dot(&missing) / tangent.norm_squared()
    }

    /// What c̈ holds besides B v̇ [m/s²].
    pub(crate) fn acceleration(&self, at: &Kinematics) -> Vector3 {
        let place = self.place(at);
        let rate = at.coordinates[self.coordinate].rate;
        let mut sum = -rate * rate * self.along(&place, 2, at);
        for (k, factor) in Self::all(&place) {
            let own = self.carried(&place, k);
            let unaccelerated = NodeMotion { acceleration: Vector6::zeros(), ..*own.motion(at) };
            sum += factor * unaccelerated.acceleration_at(&own.point);
        }
        for (k, factor) in Self::on_beam(&place, 1) {
            let own = self.carried(&place, k);
            sum += 2.0 * rate * factor * own.motion(at).velocity_at(&own.point);
        }
        sum
    }
}
