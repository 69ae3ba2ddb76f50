//! Description of a kind of joint, and the construction of its equations.

use std::sync::Arc;

use lissom_motion::{Rotation, Vector3};

use super::AnyJoint;
use super::generalized_coordinates::FreeCoordinate;
use crate::ports::Ports;
use crate::registry::{Function, Parameter, ParameterError, Parameters};
use crate::relation::Relation;

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

/// Construction of a joint.
#[derive(Clone, Copy, Debug)]
pub enum Build {
    /// Between two nodes.
    Relative(MakeJoint),
    /// Prescribes an algebraic coordinate of another joint as a function of time.
    Coordinate(fn(&Parameters) -> Result<Function, ParameterError>),
    /// Prescribes the whole motion of a node relative to another.
    Motion,
    /// Constrains a point of the tip to slide along beams.
    AlongBeams,
    /// Gives a body the mean motion of a set of nodes.
    MeanOfSet,
    /// Has coordinates of its own, not between nodes.
    Free(MakeFree),
    /// Relates algebraic coordinates of other joints.
    Coupling(MakeRelation),
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
    /// Parameters in addition to its ports.
    pub parameters: &'static [Parameter],
    /// Ports of the kind.
    pub ports: Ports,
    /// Construction of the joint.
    pub build: Build,
}
