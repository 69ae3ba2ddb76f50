//! Constraints: joints between two nodes, and prescribed relative motions.
//!
//! A joint depends only on the relative motion of two joint frames, one fixed to its base node and one to its tip
//! node, and on its own algebraic coordinates. It is independent of step size, scheme, scaling and absolute position.
//! `attached` transforms its results to rows of the system.

pub mod alignment;
mod any_joint;
pub mod attached;
pub(crate) mod base_axes;
pub mod blocks;
pub mod cam;
pub mod centerline;
pub mod clamp;
pub mod constant_velocity;
pub mod constraint;
pub mod coupling;
pub mod cylindrical;
pub mod derivatives;
pub mod distance;
pub mod drive;
pub mod equation;
pub mod evaluation_point;
pub mod frame_pair;
pub mod gear;
pub mod generalized_coordinates;
pub mod generic;
pub mod inline;
pub mod kind;
mod kinds;
pub mod latch;
pub mod mean_motion;
pub mod no_slip;
pub mod parallel_axes;
pub mod perpendicular_axes;
pub mod planar;
pub mod point_in_plane;
pub mod point_on_line;
pub mod prescribed;
pub mod prescribed_displacement;
pub mod prescribed_motion;
pub mod prescribed_rotation;
pub mod primitives;
pub mod prismatic;
mod product;
pub mod relative_increment;
pub(crate) mod relative_jets;
pub mod revolute;
pub mod rigid_link;
pub mod rolling;
pub(crate) mod scalar_batch;
pub mod screw;
pub mod slider;
pub mod spherical;
pub mod starts;
pub mod step_stages;
pub mod swing_arm;
pub mod telescopic_rod;
pub mod universal;
mod variations;
pub mod wheel_on_rail;

pub use any_joint::AnyJoint;
pub use constraint::Constraint;
pub use drive::Drive;
pub use kind::{Build, Geometry, JointKind, MakeFree, MakeJoint, MakeRelation};
pub use kinds::KINDS;

use lissom_motion::{Matrix3, Motion, Real, Screw, Vector3};
use nalgebra::SMatrix;

use crate::wheels::wheel_on_plane::Contact;
use relative_increment::{CoordinateIncrement, RelativeIncrement};

use crate::kinematics::Quantity;

/// Maximum number of equations of a joint.
pub const MAX_EQUATIONS: usize = 6;
/// Maximum number of algebraic coordinates of a joint.
pub const MAX_COORDINATES: usize = 2;

/// Maximum number of constants in the equations of a joint.
pub const MAX_CONSTANTS: usize = 10;

/// Motion of the tip's joint frame in the base's joint frame, and its change since the start of the
/// step, computed from the increments without cancellation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relative {
    /// Present relative rotation.
    pub rotation: Matrix3,
    /// Present relative position [m].
    pub position: Vector3,
    /// Change of the rotation matrix since the start of the step.
    pub rotation_change: Matrix3,
    /// Change of the position since the start of the step [m].
    pub position_change: Vector3,
}

impl Relative {
    /// A relative motion that has not changed.
    pub fn at_start(motion: &Motion) -> Self {
        Self {
            rotation: motion.rotation.matrix(),
            position: motion.position,
            rotation_change: Matrix3::zeros(),
            position_change: Vector3::zeros(),
        }
    }

    /// Relative rotation at the start of the step.
    pub(crate) fn start_rotation(&self) -> Matrix3 {
        self.rotation - self.rotation_change
    }
}

/// Positive on the branch of solutions that a joint can reach, negative on another.
pub type Branch = fn(&Relative) -> f64;

/// An algebraic coordinate of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coordinate {
    /// Name within the joint.
    pub name: &'static str,
    /// Quantity of the coordinate.
    pub quantity: Quantity,
}

impl Coordinate {
    /// A relative rotation.
    pub const fn rotation(name: &'static str) -> Self {
        Self { name, quantity: Quantity::Angle }
    }

    /// A relative displacement.
    pub const fn displacement(name: &'static str) -> Self {
        Self { name, quantity: Quantity::Length }
    }
}

/// The joint's own coordinates, and their change since the start of the step [rad, m].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointCoordinates {
    /// Present values.
    pub value: [f64; MAX_COORDINATES],
    /// Change since the start of the step.
    pub change: [f64; MAX_COORDINATES],
}

/// One value per equation.
pub type Equations = [f64; MAX_EQUATIONS];

/// Derivatives of the equations with respect to the body variation η of the relative motion (translation, rotation),
/// and to the joint's own coordinates. Unused rows and columns are zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gradient {
    /// ∂c/∂η.
    pub relative: SMatrix<f64, MAX_EQUATIONS, 6>,
    /// ∂c/∂φ.
    pub own: SMatrix<f64, MAX_EQUATIONS, MAX_COORDINATES>,
}

impl Gradient {
    /// All zero.
    pub fn zeros() -> Self {
        Self { relative: SMatrix::zeros(), own: SMatrix::zeros() }
    }
}

/// Derivatives of (∂c/∂(η, φ))ᵀ μ with respect to (η, φ).
pub type ConstraintHessian = SMatrix<f64, 8, 8>;

/// Number of equations. Lengths are first, followed by angles.
#[derive(Clone, Copy, Debug)]
pub struct EquationCount {
    pub(crate) lengths: usize,
    pub(crate) angles: usize,
}

impl EquationCount {
    /// Number of both.
    pub(crate) const fn sum(self) -> usize {
        self.lengths + self.angles
    }
}

/// The equations of a joint. Frequently evaluated formulas are written for one number or several side by side.
pub trait Joint: Copy + Send + Sync + std::fmt::Debug + 'static {
    /// Algebraic coordinates of the joint.
    const COORDINATES: &'static [Coordinate] = &[];
    /// Maximum number of equations of the kind; results for further ones are ignored.
    const EQUATIONS: EquationCount = EquationCount { lengths: 3, angles: 3 };

    /// Name of each equation.
    fn equations(&self) -> &'static [&'static str];

    /// Constants in the equations.
    fn constants(&self) -> [f64; MAX_CONSTANTS] {
        [0.0; MAX_CONSTANTS]
    }

    /// Initial coordinates, and the relative motion for which they satisfy the equations: violations are changes since then.
    fn initial(&self) -> ([f64; MAX_COORDINATES], Motion) {
        ([0.0; MAX_COORDINATES], Motion::identity())
    }

    /// For joints with an equation that vanishes in a pose they can reach, beyond which it has a second branch of solutions: a
    /// function that is positive on the branch of the joint and negative on the other. Default: there is no such pose.
    fn branch(&self) -> Option<Branch> {
        None
    }

    /// The contact in which the tip does not slide on the base, for rolling joints. Default: none.
    fn contact(&self) -> Option<Contact> {
        None
    }

    /// Change of the violation since the start of the step, from the changes of `increment` and `own`, without
    /// cancellation. Called often: inlined always.
    fn violation_change<R: Real>(
        increment: &RelativeIncrement<R>,
        own: &CoordinateIncrement<R>,
        constants: &[R; MAX_CONSTANTS],
    ) -> [R; MAX_EQUATIONS];

    /// (∂c/∂(η, φ))ᵀ μ: the wrench on the tip's joint frame, and the forces on the coordinates. Called often: inlined
    /// always.
    fn wrench<R: Real>(
        increment: &RelativeIncrement<R>,
        own: &CoordinateIncrement<R>,
        constants: &[R; MAX_CONSTANTS],
        mu: &[R; MAX_EQUATIONS],
    ) -> (Screw<R>, [R; MAX_COORDINATES]);
}
