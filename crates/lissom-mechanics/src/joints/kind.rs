//! What a kind of joint states about itself, and how its equations are made.

use std::sync::Arc;

use lissom_motion::{Rotation, Vector3};

use super::AnyJoint;
use super::generalized_coordinates::FreeCoordinate;
use crate::kinematics::Quantity;
use crate::registry::{Function, Parameter, ParameterError, Parameters};
use crate::relation::Relation;

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

/// Position of the tip's joint frame at the start, seen from the base's joint frame.
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
