//! What must hold: joints between two nodes, and prescribed relative motions.
//!
//! A joint sees only the relative motion of two joint frames, one carried by its base node and one by
//! its tip node, and its own algebraic coordinates. It knows no step size, no scheme, no scaling, and
//! not even where it is. `attached` turns its answers into rows of the system.

pub(crate) mod alignment;
pub mod attached;
pub(crate) mod base_axes;
pub mod blocks;
pub mod cam;
pub(crate) mod centerline;
pub mod clamp;
pub mod constant_velocity;
pub mod contact;
pub mod coupling;
pub mod cylindrical;
pub mod derivatives;
pub mod distance;
pub mod equation;
pub mod gear;
pub mod generalized_coordinates;
pub mod generic;
pub mod inline;
pub mod moved;
pub mod parallel_axes;
pub mod perpendicular_axes;
pub mod planar;
pub mod point_in_plane;
pub mod point_on_line;
pub mod prescribed;
pub mod prescribed_displacement;
pub mod prescribed_motion;
pub mod prescribed_rotation;
pub(crate) mod primitives;
pub mod prismatic;
pub mod revolute;
pub mod rigid_link;
pub mod rolling;
pub mod screw;
pub(crate) mod singly;
pub mod slider;
pub mod spherical;
pub(crate) mod step_stages;
pub mod swing_arm;
pub mod universal;
pub mod wheel_on_rail;

use std::sync::Arc;

use lissom_motion::{Matrix3, Motion, Real, Rotation, Screw, Vector3, Vector6};
use nalgebra::{SMatrix, SVector};

use attached::AttachedJoint;
use blocks::Batches;
use contact::Contact;
use coupling::Relation;
use generalized_coordinates::FreeCoordinate;
use moved::{Moved, OwnMoved};
use wheel_on_rail::contact::RailContact;

use crate::elements::creep_force::CreepLaw;
use crate::registry::{Function, Parameter, ParameterError, Parameters};

/// Most equations a joint may have.
pub const MOST_EQUATIONS: usize = 6;
/// Most algebraic coordinates a joint may have.
pub const MOST_COORDINATES: usize = 2;

/// Most numbers of its own that the equations of a joint hold.
pub const MOST_NUMBERS: usize = 10;

/// What an equation or a coordinate of a joint is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// [m]
    Length,
    /// [rad]
    Angle,
    /// A first-order state, in units of its own.
    State,
}

impl Quantity {
    /// What a joint's relative coordinate of this quantity is called.
    pub fn relative(self) -> &'static str {
        match self {
            Self::Length => "displacement",
            Self::Angle => "rotation",
            Self::State => "state",
        }
    }
}

/// Motion of the tip's joint frame in the base's joint frame, and its change since the start of the
/// step, computed from the increments without cancellation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relative {
    /// Relative rotation now.
    pub rotation: Matrix3,
    /// Relative position now [m].
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

/// An algebraic coordinate of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coordinate {
    /// Name within the joint.
    pub name: &'static str,
    /// What it is.
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

/// The joint's own coordinates now, and their change since the start of the step [rad, m].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Own {
    /// Values now.
    pub value: [f64; MOST_COORDINATES],
    /// Change since the start of the step.
    pub change: [f64; MOST_COORDINATES],
}

/// One number per equation.
pub type Equations = [f64; MOST_EQUATIONS];

/// Derivatives of the equations: with respect to the body variation η of the relative motion
/// (translation, rotation), and to the joint's own coordinates. Unused rows and columns stay zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gradient {
    /// ∂c/∂η.
    pub relative: SMatrix<f64, MOST_EQUATIONS, 6>,
    /// ∂c/∂φ.
    pub own: SMatrix<f64, MOST_EQUATIONS, MOST_COORDINATES>,
}

impl Gradient {
    /// All zero.
    pub fn zeros() -> Self {
        Self { relative: SMatrix::zeros(), own: SMatrix::zeros() }
    }
}

/// Derivatives of (∂c/∂(η, φ))ᵀ μ with respect to (η, φ).
pub type Curvature = SMatrix<f64, 8, 8>;

/// The equations of a joint. What is evaluated often is written over one number or several side by side.
pub trait Joint: Copy + Send + Sync + std::fmt::Debug + 'static {
    /// Its algebraic coordinates.
    const COORDINATES: &'static [Coordinate] = &[];
    /// Most equations that a joint of the kind has; what is said of further ones is not looked at.
    const MOST: usize = MOST_EQUATIONS;
    /// How many equations are lengths; they come first, angles follow.
    const LENGTHS: usize = 3;

    /// Name of each equation.
    fn equations(&self) -> &'static [&'static str];

    /// Numbers of its own that the equations hold.
    fn numbers(&self) -> [f64; MOST_NUMBERS] {
        [0.0; MOST_NUMBERS]
    }

    /// Coordinates at the start, and the relative motion for which they satisfy the equations.
    fn initial(&self) -> ([f64; MOST_COORDINATES], Motion) {
        ([0.0; MOST_COORDINATES], Motion::identity())
    }

    /// The contact in which the tip does not slide on the base, for joints that roll. Default: it is none of them.
    fn contact(&self) -> Option<Contact> {
        None
    }

    /// Violation c of the equations, evaluated outright.
    fn violation(&self, relative: &Relative, own: &Own) -> Equations;

    /// Change of the violation since the start of the step, from the changes of `moved` and `own`, without
    /// cancellation. Hot: inlined always.
    fn violation_change<R: Real>(
        moved: &Moved<R>,
        own: &OwnMoved<R>,
        numbers: &[R; MOST_NUMBERS],
    ) -> [R; MOST_EQUATIONS];

    /// (∂c/∂(η, φ))ᵀ μ: the wrench on the tip's joint frame, and the forces on the coordinates. Hot: inlined always.
    fn wrench<R: Real>(
        moved: &Moved<R>,
        own: &OwnMoved<R>,
        numbers: &[R; MOST_NUMBERS],
        mu: &[R; MOST_EQUATIONS],
    ) -> (Screw<R>, [R; MOST_COORDINATES]);

    /// ∂c/∂(η, φ); `out` is zero on entry.
    fn gradient(&self, relative: &Relative, own: &Own, out: &mut Gradient);

    /// Derivative of the constraint forces at constant multipliers μ; `out` is zero on entry.
    fn curvature(&self, relative: &Relative, own: &Own, mu: &Equations, out: &mut Curvature);
}

/// A joint of any kind.
pub trait AnyJoint: Send + Sync + std::fmt::Debug {
    /// See [`Joint::equations`].
    fn equations(&self) -> &'static [&'static str];
    /// What an equation is: see [`Joint::LENGTHS`].
    fn equation_quantity(&self, equation: usize) -> Quantity;
    /// See [`Joint::COORDINATES`].
    fn coordinates(&self) -> &'static [Coordinate];
    /// See [`Joint::initial`].
    fn initial(&self) -> ([f64; MOST_COORDINATES], Motion);
    /// See [`Joint::contact`].
    fn contact(&self) -> Option<Contact>;
    /// The contact of a wheel with a rail, for joints that are one. Default: it is none.
    fn rail_contact(&self) -> Option<&RailContact> {
        None
    }
    /// The law of creep in that contact, if there is one.
    fn creep(&self) -> Option<&CreepLaw> {
        None
    }
    /// See [`Joint::violation`].
    fn violation(&self, relative: &Relative, own: &Own) -> Equations;
    /// See [`Joint::violation_change`].
    fn violation_change(&self, relative: &Relative, own: &Own) -> Equations;
    /// See [`Joint::wrench`].
    fn wrench(
        &self,
        relative: &Relative,
        own: &Own,
        mu: &Equations,
    ) -> (Vector6, SVector<f64, MOST_COORDINATES>);
    /// See [`Joint::gradient`].
    fn gradient(&self, relative: &Relative, own: &Own, out: &mut Gradient);
    /// See [`Joint::curvature`].
    fn curvature(&self, relative: &Relative, own: &Own, mu: &Equations, out: &mut Curvature);
    /// Adds the joint, the one of this index, to the batch of its kind.
    fn enter(&self, index: usize, attached: &AttachedJoint, batches: &mut Batches);
}

impl<J: Joint> AnyJoint for J {
    fn equations(&self) -> &'static [&'static str] {
        Joint::equations(self)
    }

    fn equation_quantity(&self, equation: usize) -> Quantity {
        if equation < J::LENGTHS { Quantity::Length } else { Quantity::Angle }
    }

    fn coordinates(&self) -> &'static [Coordinate] {
        J::COORDINATES
    }

    fn initial(&self) -> ([f64; MOST_COORDINATES], Motion) {
        Joint::initial(self)
    }

    fn contact(&self) -> Option<Contact> {
        Joint::contact(self)
    }

    fn violation(&self, relative: &Relative, own: &Own) -> Equations {
        Joint::violation(self, relative, own)
    }

    fn violation_change(&self, relative: &Relative, own: &Own) -> Equations {
        J::violation_change(&relative.into(), &own.into(), &self.numbers())
    }

    fn wrench(
        &self,
        relative: &Relative,
        own: &Own,
        mu: &Equations,
    ) -> (Vector6, SVector<f64, MOST_COORDINATES>) {
        let (wrench, forces) = J::wrench(&relative.into(), &own.into(), &self.numbers(), mu);
        (wrench.into(), forces.into())
    }

    fn gradient(&self, relative: &Relative, own: &Own, out: &mut Gradient) {
        Joint::gradient(self, relative, own, out);
    }

    fn curvature(&self, relative: &Relative, own: &Own, mu: &Equations, out: &mut Curvature) {
        Joint::curvature(self, relative, own, mu, out);
    }

    fn enter(&self, index: usize, attached: &AttachedJoint, batches: &mut Batches) {
        batches.enter(*self, index, attached);
    }
}

/// How the joint frames are laid at the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frames {
    /// Both at one point; their direction does not matter.
    Point,
    /// Both at one point, third axis along `axis`.
    Axis,
    /// Both at one point, first axis along `axis`, second along `second_axis`.
    TwoAxes,
    /// The same; along the global axes where none is given.
    GivenOrGlobalAxes,
    /// One at the base's point, one at the tip node; third axis along `axis`.
    SpanWithAxis,
    /// One at the base's point, one at the tip node; their direction does not matter.
    Span,
}

/// Place of the tip's joint frame at the start, seen from the base's joint frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geometry {
    /// From the base's point to the tip's point, in the base's joint frame [m].
    pub span: Vector3,
    /// Whether the tip node can only move in the joint frame's plane of the first two axes.
    pub planar: bool,
    /// The base's joint frame at the start, in inertial axes.
    pub axes: Rotation,
}

/// Makes the equations of a joint.
pub type MakeJoint = fn(&Parameters, &Geometry) -> Result<Box<dyn AnyJoint>, ParameterError>;

/// Makes a relation between coordinates; they have these values at the start [rad, m].
pub type MakeRelation = fn(&Parameters, &[f64]) -> Result<Arc<dyn Relation>, ParameterError>;

/// Makes coordinates that are not between nodes.
pub type MakeFree = fn(&Parameters) -> Result<Vec<FreeCoordinate>, ParameterError>;

/// Which coordinates a relation is between.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coupled {
    /// One of a joint, and one of another joint.
    Two,
    /// Those that its expression names.
    Named,
}

/// How a joint is made.
#[derive(Clone, Copy, Debug)]
pub enum Build {
    /// Between two nodes.
    Relative(Frames, MakeJoint),
    /// Prescribes an algebraic coordinate of another joint, of this quantity, as a function of time.
    Coordinate(Quantity, fn(&Parameters) -> Result<Function, ParameterError>),
    /// Prescribes the whole motion of a node relative to another.
    Motion,
    /// Lets a point of the tip slide along beams.
    AlongBeams,
    /// Has coordinates of its own, not between nodes.
    Free(MakeFree),
    /// Relates algebraic coordinates of other joints.
    Coupling(Coupled, MakeRelation),
}

/// A kind of joint, as the model file and the tests know it.
#[derive(Clone, Copy, Debug)]
pub struct JointKind {
    /// Name in the model file.
    pub name: &'static str,
    /// One sentence.
    pub summary: &'static str,
    /// A minimal model-file entry of its own parameters.
    pub sample: &'static str,
    /// Parameters beyond base, tip, at and the axes.
    pub parameters: &'static [Parameter],
    /// How it is made.
    pub build: Build,
}

/// All kinds of joints, one line each.
pub static KINDS: &[JointKind] = &[
    cam::KIND,
    clamp::KIND,
    constant_velocity::KIND,
    cylindrical::KIND,
    distance::KIND,
    equation::KIND,
    gear::KIND,
    generalized_coordinates::KIND,
    generic::KIND,
    inline::KIND,
    parallel_axes::KIND,
    perpendicular_axes::KIND,
    planar::KIND,
    point_in_plane::KIND,
    point_on_line::KIND,
    prescribed_displacement::KIND,
    prescribed_motion::KIND,
    prescribed_rotation::KIND,
    prismatic::KIND,
    revolute::KIND,
    rigid_link::KIND,
    rolling::KIND,
    screw::KIND,
    slider::KIND,
    spherical::KIND,
    swing_arm::KIND,
    universal::KIND,
    wheel_on_rail::KIND,
];
