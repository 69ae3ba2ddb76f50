//! Chains of joints through massless links, by which descriptions represent a joint with several coordinates, and the
//! corresponding joint of the model.

use std::fmt::Write;

use lissom_motion::Motion;

use super::joint_text::{Placed, write_effort};
use super::model_text::list;
use super::{Freedom, ImportError, Robot, RobotJoint};

/// Allowed deviation of two unit vectors from a right angle or from being parallel, and of positions from each other
/// [m].
const NEAR: f64 = 1e-9;

/// Joint that replaces a chain.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// Two rotations about axes that cross at a right angle.
    Universal,
    /// A rotation about an axis and a displacement along it.
    Cylindrical,
    /// Two displacements in a plane, without resistance, and a rotation about its normal.
    Planar,
}

/// Joints that are replaced by one.
pub(super) struct Composite {
    kind: Kind,
    /// Indices of the robot's joints, from the base to the tip.
    pub(super) joints: Vec<usize>,
    /// Groups of links between them.
    pub(super) inner_groups: Vec<usize>,
    /// Index of the rotation among them.
    rotation: usize,
}

impl Composite {
    /// Index, from 1, of the coordinate of the model's joint for the robot's joint `index`, if it has several.
    pub(super) fn coordinate(&self, index: usize) -> Option<usize> {
        match self.kind {
            Kind::Universal => self.joints.iter().position(|joint| *joint == index).map(|place| place + 1),
            // The angle is the first.
            Kind::Cylindrical => Some(if index == self.rotation { 1 } else { 2 }),
            Kind::Planar => None,
        }
    }

    /// Whether its coordinates are zero at the start, independent of the robot's.
    pub(super) fn counts_from_the_start(&self) -> bool {
        self.kind == Kind::Universal
    }

    /// Writes the joint of the model.
    pub(super) fn write(
        &self,
        text: &mut String,
        robot: &[RobotJoint],
        name: &str,
        [base, tip]: [&str; 2],
        placed: &[Placed],
    ) {
        let (kind, at, axis) = match self.kind {
            Kind::Universal => ("universal", self.joints[0], self.joints[0]),
            Kind::Cylindrical => ("cylindrical", self.rotation, self.rotation),
            Kind::Planar => ("planar", self.rotation, self.rotation),
        };
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "\n[joints.{name}]\nkind = \"{kind}\"\nbase = \"{base}\"\ntip = \"{tip}\"\nat = {}\naxis = {}\n",
            list(&placed[at].at),
            list(&placed[axis].axis),
        );
        if self.kind == Kind::Universal {
            let _ = writeln!(text, "second_axis = {}", list(&placed[self.joints[1]].axis));
        }
        for &index in self.joints.iter().filter(|_| !self.counts_from_the_start()) {
            let key = match robot[index].freedom {
                Freedom::Displacement if self.kind == Kind::Planar => continue,
                Freedom::Displacement => "displacement",
                _ => "angle",
            };
            if placed[index].value != 0.0 {
                let _ = writeln!(text, "{key} = {:?}", placed[index].value);
            }
        }
        self.joints.iter().for_each(|&index| write_effort(text, &robot[index]));
    }
}

/// Chains of joints through groups of massless links. `frames` are those of links at the start, `groups` the groups of links,
/// `massive` states which groups have mass.
///
/// # Errors
/// If no joint of the model corresponds to a chain.
pub(super) fn composites(
    robot: &Robot,
    frames: &[Motion],
    groups: &[usize],
    massive: &[bool],
) -> Result<Vec<Composite>, ImportError> {
    let moving = |joint: &RobotJoint| joint.freedom != Freedom::Fixed;
    let ends = |group: usize| {
        let into = robot.joints.iter().position(|joint| moving(joint) && groups[joint.child] == group);
        let mut out = (0..robot.joints.len())
            .filter(|&index| moving(&robot.joints[index]) && groups[robot.joints[index].parent] == group);
        (into, out.next(), out.next())
    };
    let is_inner = |group: usize| {
        // Two joints with coordinates, and no other joint.
        !massive[group]
            && matches!(ends(group), (Some(into), Some(out), None)
                if robot.joints[into].moves() && robot.joints[out].moves())
    };
    let mut all = Vec::new();
    for first in 0..robot.joints.len() {
        let joint = &robot.joints[first];
        if !joint.moves() || !is_inner(groups[joint.child]) || is_inner(groups[joint.parent]) {
            continue;
        }
        let (mut joints, mut inner_groups) = (vec![first], Vec::new());
        let mut group = groups[joint.child];
        while is_inner(group) {
            let (_, Some(next), _) = ends(group) else { break };
            inner_groups.push(group);
            joints.push(next);
            group = groups[robot.joints[next].child];
        }
        let (kind, rotation) = kind(robot, frames, &joints).ok_or_else(|| {
            let names: Vec<String> = joints.iter().map(|&index| format!("`{}`", robot.joints[index].name)).collect();
            ImportError::new(format!(
                "the joints {} have no mass between them, and no joint of a model has the same degrees of freedom: supported are two \
                 rotations about axes that intersect at a right angle, a displacement along the axis of a rotation, and two \
                 displacements in a plane with a rotation about its normal; add mass to the links between them",
                names.join(", ")
            ))
        })?;
        all.push(Composite { kind, joints, inner_groups, rotation });
    }
    Ok(all)
}

/// The kind of joint that replaces a chain, and which of its joints is the rotation.
fn kind(robot: &Robot, frames: &[Motion], chain: &[usize]) -> Option<(Kind, usize)> {
    let axis = |index: usize| {
        let joint = &robot.joints[index];
        frames[joint.child].rotation.apply(&joint.axis)
    };
    let at = |index: usize| {
        let joint = &robot.joints[index];
        frames[joint.child].transform_point(&joint.anchor)
    };
    let rotations: Vec<usize> =
        chain.iter().copied().filter(|&index| robot.joints[index].freedom == Freedom::Rotation).collect();
    match (chain, rotations.as_slice()) {
        (&[first, second], [_, _]) => {
            let meets = (at(first) - at(second)).norm() < NEAR && axis(first).dot(&axis(second)).abs() < NEAR;
            meets.then_some((Kind::Universal, first))
        }
        (&[first, second], &[rotation]) => {
            let along = (axis(first) - axis(second)).norm() < NEAR;
            along.then_some((Kind::Cylindrical, rotation))
        }
        (&[_, _, _], &[rotation]) => {
            let slides: Vec<usize> = chain.iter().copied().filter(|&index| index != rotation).collect();
            let bare = |index: usize| {
                let joint = &robot.joints[index];
                let resisting = [joint.stiffness, joint.damping, joint.friction, joint.armature];
                let leads = robot
                    .joints
                    .iter()
                    .any(|other| other.follows.as_ref().is_some_and(|(leader, _, _)| *leader == joint.name));
                resisting.iter().all(|value| *value == 0.0)
                    && joint.range.is_none()
                    && joint.follows.is_none()
                    && !leads
            };
            let across = |one: usize, other: usize| axis(one).dot(&axis(other)).abs() < NEAR;
            let plane = across(slides[0], slides[1])
                && slides.iter().all(|&slide| bare(slide) && across(slide, rotation));
            plane.then_some((Kind::Planar, rotation))
        }
        _ => None,
    }
}
