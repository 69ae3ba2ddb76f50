//! Mean motion of a set of nodes: a body follows it, and the set deforms freely; distributing coupling, or RBE3.
//!
//! Legend: x_i positions of the nodes, w_i their shares with Σ w_i = 1, (R, x) frame of the body, X_i positions of the nodes in it at
//! the start, o = Σ w_i X_i and ξ_i = X_i - o, J = Σ w_i (ξ_i·ξ_i I - ξ_i ξ_iᵀ), η_i = Rᵀ (x_i - x), μ = (f, m) multipliers, s_i =
//! (J⁻¹ m) × ξ_i.
//!
//! ```text
//! Σ w_i x_i - x - R o = 0  in inertial axes,      J⁻¹ Σ w_i ξ_i × η_i = 0  in those of the body
//! forces Bᵀ μ:  node i  w_i (f + R s_i),      body  -f  and the moment  -o × Rᵀ f + Σ w_i s_i × η_i  in its axes
//! ```
//!
//! The second equation is the condition of the rotation of least squares (polar decomposition) of the set; for a rigid set that turns
//! by small φ relative to the body it is φ. With the shares of a uniform force per area the first equation is the mean over the area,
//! and a force on the body is spread uniformly.

use lissom_motion::{Matrix3, Rotation, Vector3, Vector6, skew};

use super::constraint::{Constraint, Port};
use super::evaluation_point::Increments;
use super::kind::{Build, JointKind};
use crate::kinematics::local_derivatives::add_block;
use crate::kinematics::{Kinematics, NodeId, NodeMotion, Quantity};
use crate::ports::{PortDeclaration, PortType, Ports};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "mean_motion",
    summary: "A body has the mean motion of a set of nodes of a shell or solid, which deforms freely (distributing coupling, RBE3).",
    sample: "",
    parameters: &[],
    ports: Ports(&[
        PortDeclaration::required(
            "base",
            PortType::Set,
            "set of nodes that the body follows, such as \"block.east\"",
        )
        .sample("base = \"my_solid.east\""),
        PortDeclaration::required("tip", PortType::Node { moves: true, axes: true }, "body that follows it")
            .sample("tip = \"my_body\""),
    ]),
    build: Build::MeanOfSet,
};

/// Names of the equations.
pub const EQUATIONS: [&str; 6] =
    ["force along x", "force along y", "force along z", "moment about 1", "moment about 2", "moment about 3"];

/// A node of the set.
#[derive(Clone, Copy, Debug)]
struct Member {
    node: NodeId,
    share: f64,
    /// ξ [m].
    from_middle: Vector3,
}

/// A body with the mean motion of a set of nodes.
#[derive(Debug)]
pub struct MeanMotion {
    /// Name in the model.
    pub name: String,
    /// Position of its first multiplier among all.
    pub first_multiplier: usize,
    body: NodeId,
    members: Vec<Member>,
    /// o [m].
    middle: Vector3,
    /// J⁻¹ [1/m²].
    flexibility: Matrix3,
}

impl MeanMotion {
    /// Nodes with their shares, whose sum is one, and their positions in the frame of the body [m]. None if the set has no rotation:
    /// if its nodes are on a line.
    pub fn new(
        (name, first_multiplier): (&str, usize),
        body: NodeId,
        set: &[(NodeId, f64, Vector3)],
    ) -> Option<Self> {
        let middle: Vector3 = set.iter().map(|(_, share, place)| *share * place).sum();
        let member = |&(node, share, place): &(NodeId, f64, Vector3)| Member {
            node,
            share,
            from_middle: place - middle,
        };
        let members: Vec<Member> = set.iter().map(member).collect();
        let inertia: Matrix3 = members.iter().map(|own| -own.share * skew(&own.from_middle).pow(2)).sum();
        let sizes = inertia.symmetric_eigenvalues();
        // On a line one of them vanishes; with the digits of a text it is below the square of those.
        let flexibility = inertia.try_inverse().filter(|_| sizes.min() > 1e-9 * sizes.max())?;
        Some(Self { name: name.to_owned(), first_multiplier, body, members, middle, flexibility })
    }

    /// Position of the mean of the set in the frame of the body [m].
    pub fn middle(&self) -> Vector3 {
        self.middle
    }

    /// Force on the body and moment about the mean of the set, inertial axes [N, N m].
    pub fn reaction(&self, at: &Kinematics, multipliers: &[f64]) -> [Vector3; 2] {
        let frame = at.nodes[self.body].frame;
        let (force, arm) = self.of(multipliers);
        let moment: Vector3 =
            self.members.iter().map(|own| own.share * own.lever(&arm).cross(&self.seen(own, at))).sum();
        [force, -frame.rotation.apply(&moment)]
    }

    /// f and J⁻¹ m.
    fn of(&self, multipliers: &[f64]) -> (Vector3, Vector3) {
        let [force, moment] = [0, 3].map(|first| Vector3::from_column_slice(&multipliers[first..first + 3]));
        (force, self.flexibility * moment)
    }

    /// η.
    fn seen(&self, own: &Member, at: &Kinematics) -> Vector3 {
        at.nodes[self.body].frame.inverse_transform_point(&at.nodes[own.node].frame.position)
    }

    /// J⁻¹ Σ w ξ × (vector of each node).
    fn turned(&self, of: impl Fn(&Member) -> Vector3) -> Vector3 {
        let sum: Vector3 = self.members.iter().map(|own| own.share * own.from_middle.cross(&of(own))).sum();
        self.flexibility * sum
    }

    /// Σ w (vector of each node).
    fn mean(&self, of: impl Fn(&Member) -> Vector3) -> Vector3 {
        self.members.iter().map(|own| own.share * of(own)).sum()
    }

    /// First local unknown of the body.
    fn own(&self) -> usize {
        6 * self.members.len()
    }
}

impl Member {
    /// s.
    fn lever(&self, arm: &Vector3) -> Vector3 {
        arm.cross(&self.from_middle)
    }

    fn axes(&self, at: &Kinematics) -> Rotation {
        at.nodes[self.node].frame.rotation
    }
}

/// Writes both parts of the violations.
fn write(parts: [Vector3; 2], out: &mut [f64]) {
    for (out, part) in out.chunks_exact_mut(3).zip(parts) {
        out.copy_from_slice(part.as_slice());
    }
}

impl Constraint for MeanMotion {
    fn name(&self) -> &str {
        &self.name
    }

    fn first_multiplier(&self) -> usize {
        self.first_multiplier
    }

    fn equations(&self) -> usize {
        EQUATIONS.len()
    }

    fn quantity(&self, equation: usize) -> Quantity {
        if equation < 3 { Quantity::Length } else { Quantity::Angle }
    }

    fn ports(&self) -> usize {
        self.members.len() + 1
    }

    fn port(&self, _arrangement: usize, index: usize) -> Port {
        Port::Node(self.members.get(index).map_or(self.body, |own| own.node))
    }

    fn size(&self) -> usize {
        6 * self.ports()
    }

    fn sides(&self) -> Vec<Vec<NodeId>> {
        vec![self.members.iter().map(|own| own.node).collect(), vec![self.body]]
    }

    fn violation(&self, at: &Kinematics, out: &mut [f64]) {
        let body = at.nodes[self.body].frame;
        let beside = self.mean(|own| at.nodes[own.node].frame.position - body.transform_point(&self.middle));
        write([beside, self.turned(|own| self.seen(own, at))], out);
    }

    /// With the changes (E, p) of the body and p_i of the nodes, each in its axes at the start:
    ///
    /// ```text
    /// Δη_i = (Eᵀ - I) η_i + Eᵀ (Rᵀ R_i p_i - p)
    /// ```
    fn violation_change(&self, increments: &Increments<'_>, _time_elapsed: (f64, f64), out: &mut [f64]) {
        let start = increments.start;
        let axes = start.nodes[self.body].frame.rotation;
        let change = &increments.nodes[self.body];
        let moved = |own: &Member| {
            let shift = own.axes(start).apply(&increments.nodes[own.node].shift);
            axes.apply_inverse(&shift) - change.shift
        };
        let beside = self.mean(moved) - change.turn * self.middle;
        let back = change.turn.transpose();
        let turned = self.turned(|own| {
            let moved = moved(own);
            back * (self.seen(own, start) + moved) + moved
        });
        write([axes.apply(&beside), turned], out);
    }

    fn gradient(&self, at: &Kinematics, out: &mut [f64]) {
        let (size, body) = (self.size(), self.own());
        let frame = at.nodes[self.body].frame;
        let axes = frame.rotation.matrix();
        for (k, own) in self.members.iter().enumerate() {
            let to_node = own.axes(at).matrix();
            add_block(out, size, (0, 6 * k), &(own.share * to_node));
            let turning = own.share * self.flexibility * skew(&own.from_middle);
            add_block(out, size, (3, 6 * k), &(turning * axes.transpose() * to_node));
            // The rows of the body's rotation: ξ × (η × θ).
            add_block(out, size, (3, body + 3), &(turning * skew(&self.seen(own, at))));
        }
        add_block(out, size, (0, body), &-axes);
        add_block(out, size, (0, body + 3), &(axes * skew(&self.middle)));
    }

    fn constraint_hessian(&self, at: &Kinematics, multipliers: &[f64], out: &mut [f64]) {
        let (size, body) = (self.size(), self.own());
        let (force, arm) = self.of(multipliers);
        let frame = at.nodes[self.body].frame;
        let axes = frame.rotation.matrix();
        let pull = skew(&frame.rotation.apply_inverse(&force));
        add_block(out, size, (body, body + 3), &-pull);
        add_block(out, size, (body + 3, body + 3), &-(skew(&self.middle) * pull));
        for (k, own) in self.members.iter().enumerate() {
            let lever = own.share * own.lever(&arm);
            let to_node = own.axes(at).matrix();
            let local = own.axes(at).apply_inverse(&(own.share * force + axes * lever));
            add_block(out, size, (6 * k, 6 * k + 3), &skew(&local));
            let across = skew(&lever) * axes.transpose() * to_node;
            add_block(out, size, (6 * k, body + 3), &across.transpose());
            add_block(out, size, (body + 3, 6 * k), &across);
            let turning = skew(&lever) * skew(&self.seen(own, at));
            add_block(out, size, (body + 3, body + 3), &turning);
        }
    }

    /// With velocities and accelerations of the nodes relative to the body's origin, v and a in its axes, and its angular velocity ω:
    ///
    /// ```text
    /// η̈ = a - 2 ω × v - ω̇ × η + ω × (ω × η)
    /// ```
    fn acceleration(&self, at: &Kinematics, out: &mut [f64]) {
        let coasting = |node: NodeId| NodeMotion { acceleration: Vector6::zeros(), ..at.nodes[node] };
        let (body, zero) = (coasting(self.body), Vector3::zeros());
        let of = |own: &Member| coasting(own.node).acceleration_at(&zero);
        let beside = self.mean(of) - body.acceleration_at(&self.middle);
        let spin = body.frame.rotation.apply_inverse(&body.angular_velocity());
        let turned = self.turned(|own| {
            let velocity = at.nodes[own.node].velocity_at(&zero) - body.velocity_at(&zero);
            let acceleration = of(own) - body.acceleration_at(&zero);
            let [velocity, acceleration] =
                [velocity, acceleration].map(|own| body.frame.rotation.apply_inverse(&own));
            acceleration - 2.0 * spin.cross(&velocity) + spin.cross(&spin.cross(&self.seen(own, at)))
        });
        write([beside, turned], out);
    }
}
