//! Models from files of other programs, and back: read into a [`Robot`], written as the text of a model file for further editing.
//! A new format is one file that builds a [`Robot`], and a branch in [`from_description`]. [`from_model`] builds a [`Robot`] from
//! a model, which [`to_urdf`] writes.

mod contacts;
mod description;
mod from_model;
mod include;
mod joint_text;
mod keyframes;
mod massless;
mod mjcf;
mod model_text;
mod motors;
mod order;
mod sdf;
mod sensors;
mod start;
mod to_urdf;
mod urdf;
mod visuals;
mod xml;

use lissom_core::diagnostics::Diagnose;
use std::collections::{BTreeMap, BTreeSet};

use lissom_motion::{Matrix3, Motion, Rotation, Vector3, Vector6};

pub use contacts::{ContactPair, ContactRules, Touch, TouchLaw};
pub use description::{from_description, from_file};
pub use from_model::{ModelRobot, from_model};
pub use keyframes::Keyframe;
pub use mjcf::from_mjcf;
pub use model_text::{Options, Root, Unsupported, model_text, omissions};
pub use motors::{Motor, Motors};
pub use sdf::from_sdf;
pub use sensors::{Measured, MotionKind, Sensor};
pub use start::{ChosenStart, chosen_starts};
pub use to_urdf::to_urdf;
pub use urdf::from_urdf;
pub use visuals::{Visual, VisualShape};

/// Numbers for the model file, without the sign of negative zeros.
fn list(vector: &Vector3) -> String {
    let [x, y, z] = [vector.x + 0.0, vector.y + 0.0, vector.z + 0.0];
    format!("[{x:?}, {y:?}, {z:?}]")
}

/// The smallest rotation from z to a unit vector.
fn from_z(direction: &Vector3) -> Rotation {
    let across = Vector3::z().cross(direction);
    let angle = across.norm().atan2(direction.z);
    // For directions along z the axis is not unique: any perpendicular one is valid.
    Rotation::about_axis(&across.try_normalize(1e-14).unwrap_or_else(Vector3::x), angle)
}

/// Bodies in a tree of joints.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Robot {
    /// Name of the robot.
    pub name: String,
    /// Acceleration of gravity, in global axes [m/s²].
    pub gravity: Vector3,
    /// Links of the robot; the first is the root.
    pub links: Vec<Link>,
    /// What the root is.
    pub root: RobotRoot,
    /// Joints of the robot, each after the parent joint.
    pub joints: Vec<RobotJoint>,
    /// Joints that close loops.
    pub closures: Vec<Closure>,
    /// Ropes over points of links.
    pub ropes: Vec<Rope>,
    /// Tendons that act on sums of joint coordinates.
    pub tendons: Vec<JointTendon>,
    /// How links touch each other, besides [`Visual::touch`] of their shapes.
    pub contacts: ContactRules,
    /// Links whose weight is compensated.
    pub compensations: Vec<WeightCompensation>,
    /// Positions of all joints at which it may start.
    pub keyframes: Vec<Keyframe>,
    /// Motors, which are omitted unless they are requested.
    pub motors: Vec<Motor>,
    /// Sensors, which become outputs.
    pub sensors: Vec<Sensor>,
    /// Contents of the description that are omitted from the model, one sentence each.
    pub left_out: Vec<String>,
    /// Elements that act on the robot and cannot be modelled, one sentence each: rejected unless their omission is
    /// requested.
    pub unsupported: Vec<String>,
    /// Faults of the description, one sentence each: a robot that has any is rejected by [`model_text`].
    pub obstacles: Vec<String>,
}

/// The first link of a robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RobotRoot {
    /// The world, which cannot move.
    World,
    /// A link with this pose in global axes [m].
    Link(Motion),
}

impl Default for RobotRoot {
    fn default() -> Self {
        Self::Link(Motion::identity())
    }
}

impl RobotRoot {
    /// Pose in global axes [m].
    pub fn pose(&self) -> Motion {
        match self {
            Self::World => Motion::identity(),
            Self::Link(pose) => *pose,
        }
    }
}

impl Robot {
    /// Whether the root is the world.
    pub fn is_root_the_world(&self) -> bool {
        self.root == RobotRoot::World
    }

    /// Whether the root and all that is fixed to it have mass, and it is not the world: it is a matter of choice whether it moves.
    pub fn may_float(&self) -> bool {
        let mut fixed = BTreeSet::from([0]);
        for joint in self.joints.iter().filter(|joint| joint.freedom == Freedom::Fixed) {
            if fixed.contains(&joint.parent) {
                fixed.insert(joint.child);
            }
        }
        let has_mass = fixed.iter().any(|&link| self.links[link].inertia.is_some());
        !self.is_root_the_world() && has_mass && self.links[0].name != "world"
    }

    /// Whether nothing moves unless the root does: a thing and no machine.
    pub fn is_object(&self) -> bool {
        self.may_float() && self.joints.iter().all(|joint| joint.freedom == Freedom::Fixed)
    }

    /// Indices of joints by name; of several of one name, the first.
    fn joint_index(&self) -> BTreeMap<&str, usize> {
        let mut index = BTreeMap::new();
        for (own, joint) in self.joints.iter().enumerate() {
            index.entry(joint.name.as_str()).or_insert(own);
        }
        index
    }

    /// The value of a reading; none, and an obstacle, if it failed.
    fn keep<T>(&mut self, read: Result<T, ImportError>) -> Option<T> {
        read.map_err(|error| self.obstacles.push(error.message)).ok()
    }
}

/// A joint between two links, which closes a loop of the tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Closure {
    /// Name of the closure.
    pub name: String,
    /// Whether it also locks the rotation, relative to that of the reference position.
    pub locks_rotation: bool,
    /// Indices of the two links.
    pub links: [usize; 2],
    /// The common point in the frame of the first link [m]; at the reference position the second one has it at the same
    /// position.
    pub anchor: Vector3,
    /// Location of the closure in the description.
    pub source: String,
}

/// A rope over points of links, which pulls where it is longer than its free length.
#[derive(Clone, Debug, PartialEq)]
pub struct Rope {
    /// Name of the rope.
    pub name: String,
    /// Points over which it passes: the link, and the point in its frame [m].
    pub along: Vec<(usize, Vector3)>,
    /// Free length [m].
    pub length: f64,
    /// Stiffness [N/m]; none for the stiffness of stops.
    pub stiffness: Option<f64>,
}

/// A tendon whose length is a sum of joint coordinates, with a spring and limits.
#[derive(Clone, Debug, PartialEq)]
pub struct JointTendon {
    /// Name of the tendon.
    pub name: String,
    /// Joints by index, with their factors [1, m].
    pub terms: Vec<(usize, f64)>,
    /// Lengths at which its stops begin.
    pub range: Option<[f64; 2]>,
    /// Stiffness of its spring.
    pub stiffness: f64,
    /// Lengths between which the spring is free of force.
    pub rest: [f64; 2],
}

/// A force that compensates the weight of a link, at its centre of mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeightCompensation {
    /// Index of the link.
    pub link: usize,
    /// Share of the weight that is compensated.
    pub share: f64,
}

/// A link with its inertia; none for a frame without mass.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Name of the link.
    pub name: String,
    /// Mass of the link.
    pub inertia: Option<LinkInertia>,
    /// What is drawn of it.
    pub visuals: Vec<Visual>,
    /// Shapes for collisions, which are drawn where no file of `visuals` can be.
    pub collisions: Vec<Visual>,
    /// Location of the link in the description, such as `line 3`; may be empty.
    pub source: String,
    /// Whether it is only between two joints of one body.
    pub is_between: bool,
}

impl Link {
    /// A link that is not drawn.
    fn new(name: String, inertia: Option<LinkInertia>, source: String) -> Self {
        Self { name, inertia, visuals: Vec::new(), collisions: Vec::new(), source, is_between: false }
    }
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

impl LinkInertia {
    /// A mass whose moments xx, yy, zz, xy, xz, yz about its centre are in the axes of `frame`; none if all are zero.
    fn placed(mass: f64, [xx, yy, zz, xy, xz, yz]: [f64; 6], frame: &Motion) -> Option<Self> {
        let own = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        let turn = frame.rotation.matrix();
        let has_any = mass != 0.0 || own.iter().any(|value| *value != 0.0);
        has_any.then(|| Self { mass, centre: frame.position, inertia: turn * own * turn.transpose() })
    }
}

/// Freedom of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Freedom {
    /// Nothing.
    Fixed,
    /// The rotation about its axis.
    Rotation,
    /// The displacement along its axis.
    Displacement,
    /// All rotations about a point.
    Ball,
    /// Everything.
    Floating,
}

/// What the motor of a joint is designed for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotorRating {
    /// Least and greatest torque or force of all motors together [N m, N].
    pub effort: Option<[f64; 2]>,
    /// Maximum speed [rad/s, m/s]; it is not enforced.
    pub speed: Option<f64>,
}

/// A spring between the links of a joint; none if its stiffness is zero.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointSpring {
    /// Stiffness [N m/rad, N/m].
    pub stiffness: f64,
    /// Value of the coordinate at which it is free of force [rad, m].
    pub rest: f64,
}

/// A joint between two links.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotJoint {
    /// Name of the joint.
    pub name: String,
    /// Freedom of the joint.
    pub freedom: Freedom,
    /// Index of the parent link.
    pub parent: usize,
    /// Index of the child link.
    pub child: usize,
    /// Pose of the child's frame in the parent's at the reference value.
    pub origin: Motion,
    /// Direction of the axis in the child's frame, a unit vector.
    pub axis: Vector3,
    /// A point of the axis in the child's frame [m].
    pub anchor: Vector3,
    /// Value of the coordinate at which the child's frame is at `origin` [rad, m].
    pub reference: f64,
    /// Least and greatest value [rad, m].
    pub range: Option<[f64; 2]>,
    /// What its motor is designed for.
    pub rating: MotorRating,
    /// The spring at the joint.
    pub spring: JointSpring,
    /// Viscous friction [N m s/rad, N s/m].
    pub damping: f64,
    /// Coulomb friction [N m, N].
    pub friction: f64,
    /// Inertia of the motor's rotor, with respect to the coordinate [kg m², kg].
    pub armature: f64,
    /// The joint that it follows by a factor and an offset.
    pub follows: Option<(String, f64, f64)>,
    /// Location of the joint in the description, such as `line 3`; may be empty.
    pub source: String,
}

impl RobotJoint {
    /// A joint without friction, limits or springs, along x.
    fn new(name: String, freedom: Freedom, parent: usize, child: usize, origin: Motion) -> Self {
        Self {
            name,
            freedom,
            parent,
            child,
            origin,
            axis: Vector3::x(),
            anchor: Vector3::zeros(),
            reference: 0.0,
            range: None,
            rating: MotorRating::default(),
            spring: JointSpring::default(),
            damping: 0.0,
            friction: 0.0,
            armature: 0.0,
            follows: None,
            source: String::new(),
        }
    }

    /// Whether its limits are apart.
    fn has_stop(&self) -> bool {
        self.range.is_some_and(|[low, high]| low < high)
    }

    /// Whether it has a coordinate.
    pub fn moves(&self) -> bool {
        matches!(self.freedom, Freedom::Rotation | Freedom::Displacement)
    }
}

/// Initial values of joints and their rates, by name; others have their reference value, and zero rate.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pose {
    /// Rotations and displacements [rad, m].
    pub values: BTreeMap<String, f64>,
    /// Their rates [rad/s, m/s].
    pub rates: BTreeMap<String, f64>,
    /// Twist of the root in its own axes, for robots with a free root [m/s, rad/s].
    pub root_twist: Vector6,
}

/// An error of an import.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", self.diagnostic())]
pub struct ImportError {
    /// The error, its location, and the remedy.
    pub message: String,
}

impl ImportError {
    fn new(message: impl Into<String>) -> Self {
        Self { message: message.into() }
    }

    /// All obstacles in one error, each on a line of its own if there are several.
    fn of(obstacles: &[String]) -> Self {
        match obstacles {
            [only] => Self::new(only),
            all => Self::new(format!("{} obstacles:\n  - {}", all.len(), all.join("\n  - "))),
        }
    }
}
