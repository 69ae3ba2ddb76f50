//! Motion of nodes and coordinates, in SI. Independent of topology and time step.

use std::sync::Arc;

use lissom_motion::{Matrix3, Motion, Rotation, Vector3, Vector6, axial, skew};

use super::ids::indexed_by;
use super::{CoordinateId, NodeId};
use crate::units::Unit;

/// The ground: node 0 of every system, without degrees of freedom.
pub const GROUND: NodeId = NodeId::new(0);

indexed_by! {
    NodeId: NodeMotion, Motion, MotionChange;
    CoordinateId: CoordinateMotion;
}

/// A node: pose, twist and acceleration of its body frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeMotion {
    /// Pose of the body frame in the inertial frame.
    pub frame: Motion,
    /// Twist in the body frame: velocity [m/s], angular velocity [rad/s].
    pub twist: Vector6,
    /// Time derivative of the twist's components [m/s², rad/s²].
    pub acceleration: Vector6,
}

impl NodeMotion {
    /// A node at rest.
    pub fn at_rest(frame: Motion) -> Self {
        Self { frame, twist: Vector6::zeros(), acceleration: Vector6::zeros() }
    }

    /// Velocity of the body's point `offset` [m, body frame], in the inertial frame [m/s].
    pub fn velocity_at(&self, offset: &Vector3) -> Vector3 {
        let (v, w) = split(&self.twist);
        self.frame.rotation.apply(&(v + w.cross(offset)))
    }

    /// Acceleration of the body's point `offset` [m, body frame], in the inertial frame [m/s²].
    pub fn acceleration_at(&self, offset: &Vector3) -> Vector3 {
        let (v, w) = split(&self.twist);
        let (dv, dw) = split(&self.acceleration);
        let local = dv + dw.cross(offset) + w.cross(&(v + w.cross(offset)));
        self.frame.rotation.apply(&local)
    }

    /// Angular velocity in the inertial frame [rad/s].
    pub fn angular_velocity(&self) -> Vector3 {
        self.frame.rotation.apply(&split(&self.twist).1)
    }
}

/// Where the stresses of the geometric stiffness are from. Those of an iterate far from equilibrium are meaningless: they can be larger
/// than any in the motion, because a small rotation stretches a stiff element [cf. Magisano, Leonetti and Garcea 2017].
#[derive(Clone, Copy, Debug)]
pub struct Stressed<'a> {
    /// The configuration whose stresses are used: the iterate itself, or, while iterations are far from equilibrium, the start of the
    /// step.
    pub at: &'a Kinematics,
    /// The configuration from which an element may instead predict them linearly up to the iterate.
    pub previous: Option<&'a Kinematics>,
}

impl<'a> From<&'a Kinematics> for Stressed<'a> {
    fn from(at: &'a Kinematics) -> Self {
        Self { at, previous: None }
    }
}

/// Translation and rotation parts of a twist or wrench.
pub fn split(screw: &Vector6) -> (Vector3, Vector3) {
    (Vector3::new(screw[0], screw[1], screw[2]), Vector3::new(screw[3], screw[4], screw[5]))
}

/// A change of motion H⁻¹ H' = (E, p), stored as E - I and p so that small changes keep their digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionChange {
    /// E - I.
    pub turn: Matrix3,
    /// p [m].
    pub shift: Vector3,
}

impl MotionChange {
    /// No change.
    pub fn none() -> Self {
        Self { turn: Matrix3::zeros(), shift: Vector3::zeros() }
    }

    /// exp ψ.
    pub fn exponential(psi: &Vector6) -> Self {
        Self::of(&Motion::exponential(psi))
    }

    /// A motion as a change. With the unit quaternion (w, v), E - I = 2 (w ṽ + ṽ²): no cancellation.
    pub fn of(motion: &Motion) -> Self {
        let [w, x, y, z] = motion.rotation.quaternion();
        let v = Vector3::new(x, y, z);
        let turn = skew(&(2.0 * w * v)) + 2.0 * v * v.transpose()
            - Matrix3::from_diagonal_element(2.0 * v.norm_squared());
        Self { turn, shift: motion.position }
    }

    /// This change, then `next` relative to the changed frame: (E₁ E₂ - I, p₁ + E₁ p₂).
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        Self {
            turn: self.turn + next.turn + self.turn * next.turn,
            shift: self.shift + next.shift + self.turn * next.shift,
        }
    }

    /// H_base⁻¹ H for two changes (E, p).
    #[must_use]
    pub fn relative_to(&self, base: &Self) -> Self {
        let back = base.turn.transpose();
        let shift = self.shift - base.shift;
        Self { turn: back + self.turn + back * self.turn, shift: shift + back * shift }
    }

    /// log H of a small change, without cancellation: relative error |θ|⁶/20.
    pub fn small_logarithm(&self) -> Vector6 {
        let sine = axial(&self.turn);
        let square = sine.norm_squared();
        let theta = sine * (1.0 + square * (1.0 / 6.0 + square * 0.075));
        Motion::new(Rotation::exponential(&theta), self.shift).logarithm()
    }

    /// Change of a frame fixed at `offset`: O⁻¹ (E, p) O.
    #[must_use]
    pub fn carried_at(&self, offset: &Motion) -> Self {
        if offset.rotation == Rotation::IDENTITY {
            return Self { turn: self.turn, shift: self.shift + self.turn * offset.position };
        }
        let axes = offset.rotation.matrix();
        Self {
            turn: axes.tr_mul(&(self.turn * axes)),
            shift: axes.tr_mul(&(self.shift + self.turn * offset.position)),
        }
    }
}

/// A scalar algebraic coordinate and its rates.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CoordinateMotion {
    /// Value [rad, m].
    pub value: f64,
    /// First time derivative [rad/s, m/s].
    pub rate: f64,
    /// Second time derivative [rad/s², m/s²].
    pub acceleration: f64,
}

/// All nodes and coordinates at one instant.
#[derive(Debug, PartialEq)]
pub struct Kinematics {
    /// Time [s].
    pub time: f64,
    /// Time since the start of the step [s]; exact although `time` is rounded.
    pub elapsed: f64,
    /// One entry per node; node 0 is the ground.
    pub nodes: Vec<NodeMotion>,
    /// One entry per algebraic coordinate and first-order state.
    pub coordinates: Vec<CoordinateMotion>,
    /// Held values, constant within a step: inputs, and signals between two samples.
    pub held: Vec<f64>,
    /// Multipliers for elements whose forces depend on them [N, N m]; empty if there are no such elements.
    pub multipliers: Vec<f64>,
    /// The running units of the simulation, by which signals are evaluated here; empty before they are started.
    pub units: Vec<Arc<dyn Unit>>,
}

impl Kinematics {
    /// Sets all velocities and accelerations to zero.
    pub fn stop(&mut self) {
        for node in &mut self.nodes {
            node.twist.fill(0.0);
            node.acceleration.fill(0.0);
        }
        for coordinate in &mut self.coordinates {
            (coordinate.rate, coordinate.acceleration) = (0.0, 0.0);
        }
    }
}

impl Clone for Kinematics {
    fn clone(&self) -> Self {
        Self {
            time: self.time,
            elapsed: self.elapsed,
            nodes: self.nodes.clone(),
            coordinates: self.coordinates.clone(),
            held: self.held.clone(),
            multipliers: self.multipliers.clone(),
            units: self.units.clone(),
        }
    }

    /// Copies into the present allocations.
    fn clone_from(&mut self, from: &Self) {
        (self.time, self.elapsed) = (from.time, from.elapsed);
        self.nodes.clone_from(&from.nodes);
        self.coordinates.clone_from(&from.coordinates);
        self.held.clone_from(&from.held);
        self.multipliers.clone_from(&from.multipliers);
        self.units.clone_from(&from.units);
    }
}

impl Kinematics {
    /// Makes these multipliers available to elements, if any depends on them.
    pub fn show_multipliers(&mut self, multipliers: &[f64]) {
        if !self.multipliers.is_empty() {
            self.multipliers.copy_from_slice(multipliers);
        }
    }
}
