//! Description of a kind of joint, and the construction of its equations.

use std::sync::Arc;

use lissom_motion::{Rotation, Vector3};

use super::AnyJoint;
use super::generalized_coordinates::FreeCoordinate;
use crate::kinematics::Quantity;
use crate::registry::{Function, Parameter, ParameterError, Parameters};
use crate::relation::Relation;

/// Initial arrangement of the joint frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frames {
    /// Both at one point; their orientation is arbitrary.
    Point,
    /// Both at one point, third axis along `axis`.
    Axis,
    /// Both at one point, first axis along `axis`, second along `second_axis`.
    TwoAxes,
    /// The same; along the inertial axes if none is given.
    GivenOrGlobalAxes,
    /// One at the base's point, one at the tip node; third axis along `axis`.
    SpanWithAxis,
    /// One at the base's point, one at the tip node; their orientation is arbitrary.
    Span,
}

/// Initial position of the tip's joint frame relative to the base's joint frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geometry {
    /// From the base's point to the tip's point, in the base's joint frame [m].
    pub span: Vector3,
    /// Whether the tip node can only move in the joint frame's plane of the first two axes.
    pub planar: bool,
    /// The base's joint frame at the start, in inertial axes.
    pub axes: Rotation,
}

/// Builds the equations of a joint.
pub type MakeJoint = fn(&Parameters, &Geometry) -> Result<Box<dyn AnyJoint>, ParameterError>;

/// Builds a relation between coordinates with these initial values [rad, m].
pub type MakeRelation = fn(&Parameters, &[f64]) -> Result<Arc<dyn Relation>, ParameterError>;

/// Builds coordinates that are not between nodes.
pub type MakeFree = fn(&Parameters) -> Result<Vec<FreeCoordinate>, ParameterError>;

/// The coordinates of a relation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coupled {
    /// One of a joint, and one of another joint.
    Two,
    /// Those in its expression.
    Named,
}

/// Construction of a joint.
#[derive(Clone, Copy, Debug)]
pub enum Build {
    /// Between two nodes.
    Relative(Frames, MakeJoint),
    /// Prescribes an algebraic coordinate of another joint, of this quantity, as a function of time.
    Coordinate(Quantity, fn(&Parameters) -> Result<Function, ParameterError>),
    /// Prescribes the whole motion of a node relative to another.
    Motion,
    /// Constrains a point of the tip to slide along beams.
    AlongBeams,
    /// Has coordinates of its own, not between nodes.
    Free(MakeFree),
    /// Relates algebraic coordinates of other joints.
    Coupling(Coupled, MakeRelation),
}

/// A kind of joint, as used by the model file and the tests.
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
    /// Its construction.
    pub build: Build,
}
