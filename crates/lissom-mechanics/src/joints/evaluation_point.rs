//! The point at which constraints, residual and tangent are evaluated, and the unknowns of their derivatives.

use super::derivatives::IncrementTangent;
use super::starts::JointStarts;
use crate::kinematics::{AxisSpin, Kinematics, MotionChange, NodeMotion, Quantity, Stressed};

/// Changes since the start of the step.
#[derive(Clone, Copy, Debug)]
pub struct Increments<'a> {
    /// The start of the step.
    pub start: &'a Kinematics,
    /// Change of every node's motion.
    pub nodes: &'a [MotionChange],
    /// Change of every coordinate.
    pub coordinates: &'a [f64],
    /// Values of joints at the start, if they have been stored.
    pub joints: Option<&'a JointStarts>,
}

/// Evaluation point of residual and tangent.
#[derive(Clone, Copy, Debug)]
pub struct Point<'a> {
    /// Positions, twists and accelerations.
    pub at: &'a Kinematics,
    /// Where the stresses of the geometric stiffness are from.
    pub stressed: Stressed<'a>,
    /// Changes since the start of the step.
    pub increments: Increments<'a>,
    /// Multipliers [N, N m].
    pub multipliers: &'a [f64],
    /// Violations at the start of the step.
    pub violations: &'a [f64],
    /// The augmented Lagrangian term.
    pub augmentation: Augmentation,
}

/// Forces from violations in the augmented Lagrangian term, and the units in which constraints of velocities are violated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Augmentation {
    /// Force per violation of a length [N/m].
    pub weight: f64,
    /// The length that represents a radian: the weight of an angle's violation contains its square [m].
    pub radian: f64,
    /// Time in which a violated constraint of velocities displaces its parts by its violation [s].
    pub lapse: f64,
    /// Violation per force of a constraint that is released [m/N].
    pub compliance: f64,
}

impl Augmentation {
    /// No forces.
    pub fn none() -> Self {
        Self::of_lengths(1.0)
    }

    /// No forces, if a radian is represented by the length `radian` [m].
    pub fn of_lengths(radian: f64) -> Self {
        Self { weight: 0.0, radian, lapse: 1.0, compliance: 1.0 }
    }

    /// Weight of an equation's violation relative to that of a length: 1 or [m²].
    pub fn relative(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::Length | Quantity::State => 1.0,
            Quantity::Angle => self.radian * self.radian,
        }
    }
}

/// Unknowns of derivatives.
#[derive(Clone, Copy, Debug)]
pub enum Chart<'a> {
    /// Body variations at the point of linearisation.
    Body,
    /// Increments ψ of each node from the start of the step, H = H_start exp ψ: δh = T(ψ) δψ, T given by node.
    Increments(&'a [IncrementTangent]),
    /// Increments ψ̂ relative to extrapolation with each node's twist V, at ψ̂ = 0: δV = δψ̂' + ad_V δψ̂ and δV̇ = δψ̂'' +
    /// ad_V δψ̂'. Those of some nodes are in axes that do not spin, see [`AxisSpin`].
    RelativeToDrift(&'a [NodeMotion], &'a [AxisSpin]),
}
