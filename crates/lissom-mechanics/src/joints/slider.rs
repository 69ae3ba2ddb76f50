//! Slider along a beam: a point of the tip remains on the line through the beam's nodes, at any position along it.
//!
//! Legend: x_t the tip's point, s the coordinate, x(s) = Σ w_k(s) x_k the line (see `centerline`), R_k rotation of a node, o_k
//! its section's point in its axes, m_k = R_kᵀ μ, a_k and v_k acceleration and velocity of a point.
//!
//! ```text
//! c = x_t - Σ w_k(s) x_k = 0  in inertial axes,      c̈ = a_t - Σ (w_k a_k + 2 w_k' ṡ v_k + w_k'' ṡ² x_k + w_k' s̈ x_k)
//! forces Bᵀ μ: tip [m_t, o_t × m_t],   node k: -w_k [m_k, o_k × m_k],   s: -Σ w_k' x_k · μ
//! ```
//!
//! The force on the beam acts at its point x(s), without moments on sections: with Σ w_k = 1 and Σ w_k x_k = x(s) momentum and
//! angular momentum are conserved. The row of s requires that the force is perpendicular to the line. Equations of a tip that
//! rotates with the line or with the sections are those of `alignment`.

use lissom_motion::{Matrix3, Vector3, Vector6, screw, skew};

use super::MAX_EQUATIONS;
use super::alignment::{Aligned, Alignment};
use super::centerline::{Centerline, SUPPORT, Support};
use super::constraint::{Constraint, Port};
use super::kind::{Build, JointKind};
use crate::joints::evaluation_point::Increments;
use crate::kinematics::local_derivatives::LocalDerivatives;
use crate::kinematics::{CoordinateId, Kinematics, NodeId, NodeMotion, Quantity};
use crate::ports::{PortDeclaration, PortType, Ports};
use crate::registry::{ParameterType, unitless};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "slider",
    summary: "A point of the tip slides along a flexible beam or a chain of beams, across element boundaries.",
    sample: "",
    parameters: &[unitless(
        "orientation",
        ParameterType::Choice(&["free", "tangent", "section"]),
        "Rotation of the tip: \"free\"; with the line's \"tangent\", about which it rotates freely; or with the beam's \"section\", as on a spline shaft.",
    )
    .or_word("free")],
    ports: Ports(&[
        PortDeclaration::required(
            "beams",
            PortType::Beams,
            "beams along which it slides; each starts at the end of the previous one",
        )
        .sample("beams = [\"my_beam\"]"),
        PortDeclaration::required(
            "tip",
            PortType::Node { moves: false, axes: false },
            "the node that slides",
        )
        .sample("tip = \"my_body\""),
        PortDeclaration::optional(
            "at",
            PortType::Location { of: &["tip"], default: &["tip"] },
            "location on the beam at the start; default: the tip node's position",
        )
        .listed("at (default: the tip's position)"),
    ]),
    build: Build::AlongBeams,
};

/// Number of equations that keep the point on the line.
pub(crate) const ON_LINE: usize = 3;
/// Index of the tip among the local nodes.
pub const TIP: usize = SUPPORT;
/// Index of the coordinate among the local unknowns.
pub const OWN: usize = 6 * (SUPPORT + 1);
/// Number of local unknowns: four nodes of the beam, the tip, the coordinate.
pub const LOCAL: usize = OWN + 1;

/// One value per local unknown.
pub type Row = [f64; LOCAL];

/// A point fixed to a node.
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

    /// Position of the point [m].
    pub fn place(&self, at: &Kinematics) -> Vector3 {
        self.motion(at).frame.transform_point(&self.point)
    }

    /// Change of position of the point since the start of a step, without cancellation [m].
    pub(super) fn shift(&self, increments: &Increments<'_>) -> Vector3 {
        let change = &increments.nodes[self.node];
        let local = change.shift + change.turn * self.point;
        self.motion(increments.start).frame.rotation.apply(&local)
    }
}

/// Orientation of the tip of a slider.
#[derive(Clone, Debug, PartialEq)]
pub enum Orientation {
    /// Free rotation.
    Free,
    /// Aligned with the tangent, about which it rotates freely.
    Tangent,
    /// Aligned with the sections: each node carries this axis, in its own axes, perpendicular to the line.
    Section(Vec<Vector3>),
}

/// A slider with its location in the system.
#[derive(Debug)]
pub struct Slider {
    /// Name in the model.
    pub name: String,
    /// Nodes along the beams, with the points of their sections.
    pub nodes: Vec<CarriedPoint>,
    /// The line through the nodes.
    pub line: Centerline,
    /// The sliding point.
    pub tip: CarriedPoint,
    /// Arc length of the undeformed beams up to the point [m].
    pub coordinate: CoordinateId,
    /// Directions of the tip that remain perpendicular to the line or to an axis of the sections.
    pub alignments: Vec<Alignment>,
    /// First multiplier of the slider among all; three are the force on the beam in inertial axes [N], and one is for each direction.
    pub first_multiplier: usize,
}

/// Location of a slider on the line.
pub struct LinePosition {
    pub(super) support: Support,
}

impl LinePosition {
    /// Local nodes of the beam, each with its weight in a derivative with respect to s.
    pub(super) fn weights(&self, derivative: usize) -> impl Iterator<Item = (usize, f64)> + use<> {
        let Support { count, weights, .. } = self.support;
        (0..count).map(move |k| (k, weights[derivative][k]))
    }
}

impl Slider {
    /// Number of equations.
    pub fn equations(&self) -> usize {
        ON_LINE + self.alignments.len()
    }

    fn aligned(&self) -> impl Iterator<Item = (usize, Aligned<'_>)> {
        let all =
            self.alignments.iter().map(|alignment| Aligned { alignment, nodes: &self.nodes, tip: &self.tip });
        (ON_LINE..).zip(all)
    }

    /// Force and moment on the tip's point for given multipliers, in inertial axes [N, N m].
    pub fn reaction(&self, at: &Kinematics, multipliers: &[f64]) -> [Vector3; 2] {
        let place = self.place(at);
        let moments = self.aligned().map(|(e, own)| -own.moment(&place, at, multipliers[e]));
        [-Vector3::from_column_slice(&multipliers[..ON_LINE]), moments.sum()]
    }

    /// Derivatives of [`reaction`](Self::reaction), force and moment. With the moment M_t of the alignments on the tip's node in its
    /// axes on the left-hand side:
    ///
    /// ```text
    /// moment = -R_t M_t,      δ(R_t M_t) = R_t (δM_t + θ_t × M_t)
    /// ```
    pub fn reaction_derivatives(&self, at: &Kinematics, multipliers: &[f64]) -> LocalDerivatives<6> {
        let place = self.place(at);
        let Support { first, count, .. } = place.support;
        let mut nodes: Vec<NodeId> = self.nodes[first..first + count].iter().map(|own| own.node).collect();
        nodes.push(self.tip.node);
        let mut out = LocalDerivatives::zero(nodes, vec![self.coordinate], self.equations());
        for k in 0..ON_LINE {
            out.by_multiplier[k][k] = -1.0;
        }
        let axes = self.tip.motion(at).frame.rotation;
        let moment = |column: &dyn Fn(usize) -> f64| {
            let own = Vector3::from_fn(|i, _| column(6 * TIP + 3 + i));
            screw(&Vector3::zeros(), &-axes.apply(&own))
        };
        let mut sum = Vector3::zeros();
        for (e, own) in self.aligned() {
            let row = own.gradient(&place, at);
            out.by_multiplier[e] += moment(&|local| row[local]);
            sum += multipliers[e] * Vector3::from_fn(|i, _| row[6 * TIP + 3 + i]);
        }
        let mut of_alignments = [0.0; MAX_EQUATIONS];
        of_alignments[ON_LINE..self.equations()].copy_from_slice(&multipliers[ON_LINE..self.equations()]);
        let hessian = self.row_derivatives(&place, at, &of_alignments);
        let locals = (0..6 * count).chain(6 * TIP..=OWN);
        for (column, local) in out.by_place.iter_mut().zip(locals) {
            *column += moment(&|row| hessian[row][local]);
        }
        for k in 0..3 {
            let turned = axes.apply(&Vector3::ith(k, 1.0).cross(&sum));
            out.by_place[6 * count + 3 + k] -= screw(&Vector3::zeros(), &turned);
        }
        out
    }

    /// Length of the undeformed beams [m].
    pub fn length(&self) -> f64 {
        self.line.length()
    }

    /// Present location of the slider.
    pub fn place(&self, at: &Kinematics) -> LinePosition {
        let s = at.coordinates[self.coordinate].value;
        LinePosition { support: self.line.at(s) }
    }

    fn carried(&self, place: &LinePosition, local: usize) -> &CarriedPoint {
        if local == TIP { &self.tip } else { &self.nodes[place.support.first + local] }
    }

    /// Local nodes of the beam, each with the factor of its position in a derivative of c with respect to s.
    fn on_beam(place: &LinePosition, derivative: usize) -> impl Iterator<Item = (usize, f64)> {
        place.weights(derivative).map(|(k, weight)| (k, -weight))
    }

    /// Local nodes with their factors for c itself, including the tip.
    fn all(place: &LinePosition) -> impl Iterator<Item = (usize, f64)> {
        Self::on_beam(place, 0).chain([(TIP, 1.0)])
    }

    /// Violations, evaluated from absolute positions [m, rad]; those of missing equations are zero.
    fn violations(&self, at: &Kinematics) -> Vector6 {
        let place = self.place(at);
        let beside = self.tip.place(at) - self.along(&place, 0, at);
        let mut violation = filled(&beside);
        self.aligned().for_each(|(e, own)| violation[e] = own.violation(&place, at));
        violation
    }

    /// Change of the violations since the start of the step, without cancellation [m, rad].
    fn violation_changes(&self, increments: &Increments<'_>) -> Vector6 {
        let start = increments.start.coordinates[self.coordinate].value;
        let change = increments.coordinates[self.coordinate.index()];
        let (s, slide) = (start + change, (start, change));
        let after = LinePosition { support: self.line.at(s) };
        let increment = after.support.sum(0, |node| self.nodes[node].shift(increments));
        let slid = self.line.change(0, slide, |node| self.nodes[node].place(increments.start));
        let mut violation = filled(&(self.tip.shift(increments) - increment - slid));
        for (e, own) in self.aligned() {
            let slid =
                |derivative: usize, of: &dyn Fn(usize) -> Vector3| self.line.change(derivative, slide, of);
            violation[e] = own.violation_change(&after, slid, increments);
        }
        violation
    }

    /// A derivative of x(s) with respect to s.
    fn along(&self, place: &LinePosition, derivative: usize, at: &Kinematics) -> Vector3 {
        place.support.sum(derivative, |node| self.nodes[node].place(at))
    }

    /// B by equation.
    fn rows(&self, place: &LinePosition, at: &Kinematics) -> [Row; MAX_EQUATIONS] {
        let mut rows = [[0.0; LOCAL]; MAX_EQUATIONS];
        for (k, factor) in Self::all(place) {
            let own = self.carried(place, k);
            let axes = own.motion(at).frame.rotation.matrix();
            let turning = -axes * skew(&own.point);
            for (e, row) in rows.iter_mut().take(ON_LINE).enumerate() {
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
        self.aligned().for_each(|(e, own)| rows[e] = own.gradient(place, at));
        rows
    }

    /// Derivatives of Bᵀ μ at constant multipliers, by row and column of the local unknowns.
    fn row_derivatives(&self, place: &LinePosition, at: &Kinematics, multipliers: &[f64]) -> [Row; LOCAL] {
        let mut out = [[0.0; LOCAL]; LOCAL];
        let mu = &Vector3::from_column_slice(&multipliers[..ON_LINE]);
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
        self.aligned().for_each(|(e, own)| own.add_hessian(place, at, multipliers[e], &mut out));
        out
    }

    /// Nodes on whose motion it depends: those along the beams, and that of the sliding point.
    pub fn carriers(&self) -> impl Iterator<Item = NodeId> + '_ {
        self.nodes.iter().chain([&self.tip]).map(|point| point.node)
    }

    /// s̈ from the accelerations of nodes, by the least squares of c̈ = 0 [m/s²]. Schemes compute that of a massless coordinate
    /// to a lower order.
    pub fn coordinate_acceleration(&self, at: &Kinematics) -> f64 {
        let place = self.place(at);
        let gradient = self.rows(&place, at);
        let mut missing = self.accelerations(at).fixed_rows::<ON_LINE>(0).into_owned();
        for (k, _) in Self::all(&place) {
            let acceleration = self.carried(&place, k).motion(at).acceleration;
            for (e, row) in gradient.iter().take(ON_LINE).enumerate() {
                missing[e] += (0..6).map(|i| row[6 * k + i] * acceleration[i]).sum::<f64>();
            }
        }
        let tangent = self.along(&place, 1, at);
        tangent.dot(&missing) / tangent.norm_squared()
    }

    /// The terms of c̈ other than B v̇ [m/s², rad/s²].
    fn accelerations(&self, at: &Kinematics) -> Vector6 {
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
        let mut out = filled(&sum);
        self.aligned().for_each(|(e, own)| out[e] = own.acceleration(&place, at, rate));
        out
    }
}

impl Constraint for Slider {
    fn name(&self) -> &str {
        &self.name
    }

    fn first_multiplier(&self) -> usize {
        self.first_multiplier
    }

    fn equations(&self) -> usize {
        self.equations()
    }

    fn quantity(&self, equation: usize) -> Quantity {
        if equation < ON_LINE { Quantity::Length } else { Quantity::Angle }
    }

    fn arrangements(&self) -> usize {
        self.line.intervals()
    }

    fn arrangement(&self, at: &Kinematics) -> usize {
        self.line.interval(at.coordinates[self.coordinate].value)
    }

    fn ports(&self) -> usize {
        SUPPORT + 2
    }

    fn port(&self, interval: usize, index: usize) -> Port {
        let (first, count) = self.line.nodes_of(interval);
        match index {
            TIP => Port::Node(self.tip.node),
            _ if index < count => Port::Node(self.nodes[first + index].node),
            _ if index < TIP => Port::NoNode,
            _ => Port::Coordinate(self.coordinate),
        }
    }

    fn size(&self) -> usize {
        LOCAL
    }

    /// The sliding node, and all nodes of the beams together: it acts on different ones of these as it moves.
    fn sides(&self) -> Vec<Vec<NodeId>> {
        vec![vec![self.tip.node], self.nodes.iter().map(|point| point.node).collect()]
    }

    fn violation(&self, at: &Kinematics, out: &mut [f64]) {
        out.copy_from_slice(&self.violations(at).as_slice()[..self.equations()]);
    }

    fn violation_change(&self, increments: &Increments<'_>, _time_elapsed: (f64, f64), out: &mut [f64]) {
        out.copy_from_slice(&self.violation_changes(increments).as_slice()[..self.equations()]);
    }

    fn gradient(&self, at: &Kinematics, out: &mut [f64]) {
        let rows = self.rows(&self.place(at), at);
        out.copy_from_slice(&rows.as_flattened()[..out.len()]);
    }

    fn constraint_hessian(&self, at: &Kinematics, multipliers: &[f64], out: &mut [f64]) {
        out.copy_from_slice(self.row_derivatives(&self.place(at), at, multipliers).as_flattened());
    }

    fn acceleration(&self, at: &Kinematics, out: &mut [f64]) {
        out.copy_from_slice(&self.accelerations(at).as_slice()[..self.equations()]);
    }
}

/// Values by equation, of which the first are given.
fn filled(on_line: &Vector3) -> Vector6 {
    let mut all = Vector6::zeros();
    all.fixed_rows_mut::<ON_LINE>(0).copy_from(on_line);
    all
}
