//! Models from files of other programs: read into a [`Robot`], written as a text of the model file that a person can go on
//! with. A new format is one file that makes a [`Robot`].

mod model_text;
mod urdf;

use std::collections::BTreeMap;

use lissom_motion::{Matrix3, Motion, Vector3, Vector6};

pub use model_text::{Options, Root, model_text};
pub use urdf::from_urdf;

/// Bodies in a tree of joints.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    /// Its name.
    pub name: String,
    /// Its links; the first is the root.
    pub links: Vec<Link>,
    /// Its joints, each after the one that carries its parent.
    pub joints: Vec<RobotJoint>,
}

/// A link with its inertia, none for a mere frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Its name.
    pub name: String,
    /// Its mass.
    pub inertia: Option<LinkInertia>,
}

/// Mass of a link in its own frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkInertia {
    /// Mass [kg].
    pub mass: f64,
    /// Centre of mass [m].
    pub centre: Vector3,
    /// Inertia about the centre of mass, in the link's axes [kg m²].
    pub inertia: Matrix3,
}

/// What a joint leaves free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Freedom {
    /// Nothing.
    Fixed,
    /// The rotation about its axis.
    Rotation,
    /// The displacement along its axis.
    Displacement,
    /// Everything.
    Floating,
}

/// A joint between two links.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotJoint {
    /// Its name.
    pub name: String,
    /// What it leaves free.
    pub freedom: Freedom,
    /// Index of the link that carries it.
    pub parent: usize,
    /// Index of the link that it carries.
    pub child: usize,
    /// Place of the child's frame in the parent's at zero.
    pub origin: Motion,
    /// Direction of the axis in the child's frame, of length one.
    pub axis: Vector3,
    /// Least and greatest value [rad, m].
    pub range: Option<[f64; 2]>,
    /// Greatest torque or force of its motor [N m, N].
    pub effort: Option<f64>,
    /// Viscous friction [N m s/rad, N s/m].
    pub damping: f64,
    /// Coulomb friction [N m, N].
    pub friction: f64,
    /// The joint that it follows by a factor and an offset.
    pub follows: Option<(String, f64, f64)>,
}

impl RobotJoint {
    /// Whether it has a coordinate.
    pub fn moves(&self) -> bool {
        matches!(self.freedom, Freedom::Rotation | Freedom::Displacement)
    }
}

/// Values of joints and their rates at the start, by name; those that are not named are zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pose {
    /// Rotations and displacements [rad, m].
    pub values: BTreeMap<String, f64>,
    /// Their rates [rad/s, m/s].
    pub rates: BTreeMap<String, f64>,
    /// Twist of the root in its own axes, for robots whose root moves freely [m/s, rad/s].
    pub root_twist: Vector6,
}

/// What cannot be imported.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct ImportError {
    /// What is wrong, where, and what to do.
    pub message: String,
}

impl ImportError {
    fn new(message: impl Into<String>) -> Self {
        Self { message: message.into() }
    }
}
