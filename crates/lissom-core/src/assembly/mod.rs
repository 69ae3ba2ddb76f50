//! Assembly: changes approximate initial positions as little as possible so that all joints close.
//!
//! Parts move as rigid bodies. With the displacement u of the centre of a part's points and its rotation vector θ, the
//! change is measured by
//!
//! ```text
//! Σ over parts  |u|² + ρ² |θ|²,     ρ² the mean square distance of the part's points from their centre
//! ```
//!
//! which is the mean square displacement of the points, except that it does not depend on the direction of the axis of rotation.
//! It needs no masses and does not depend on units or axes. The points of a part are its nodes and the positions of its joints.

mod closing;
mod columns;
mod groups;
mod tree;

use std::ops::Deref;

use self::closing::{Closing, Pose};
use self::groups::Groups;
use self::tree::Tree;
use crate::diagnostics::{Value, diagnostics};
use crate::errors::MAX_LISTED;
use crate::joints::attached::AttachedJoint;
use crate::joints::{JointCoordinates, Relative};
use crate::kinematics::{CoordinateId, Kinematics, NodeId, Quantity, Subject};
use crate::system::System;

/// Largest change of a held angle between two closings [rad], so that a loop stays in its assembly mode.
const TURN: f64 = 0.1;
/// Largest change of a held displacement between two closings, relative to the size of the model.
const SHIFT: f64 = 0.05;
/// Maximum number of stages in which held coordinates are moved to their values.
const MOST_STAGES: f64 = 1000.0;
/// Smallest gap that is reported, relative to the largest.
const MIN_REPORTED: f64 = 0.05;

/// Request of an assembly.
#[derive(Clone, Debug, PartialEq)]
pub struct Request<'a> {
    /// Sets of nodes that move together as a rigid body, such as the nodes of each beam; a node may be in several.
    pub rigid: Vec<&'a [NodeId]>,
    /// Nodes that stay where they are.
    pub fixed: Vec<NodeId>,
    /// Coordinates of joints and the values to which they are moved [rad, m]. Driven coordinates are moved to the initial values of
    /// their drives, unless they are listed here.
    pub values: Vec<(CoordinateId, f64)>,
    /// Largest gap of a closed joint, relative to the size of the model; for angles [rad].
    pub tolerance: f64,
}

/// A joint that does not close.
#[derive(Clone, Debug, PartialEq)]
pub struct Gap {
    /// Name of the joint.
    pub joint: String,
    /// Violated lengths of the joint, as one distance [m]; none if they are satisfied.
    pub distance: Option<f64>,
    /// Violated angles of the joint, as one angle [rad]; none if they are satisfied.
    pub angle: Option<f64>,
}

impl std::fmt::Display for Gap {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "`{}` by ", self.joint)?;
        match (self.distance.map(crate::number::Written), self.angle.map(crate::number::Written)) {
            (Some(distance), None) => write!(f, "{distance:.3e} m"),
            (Some(distance), Some(angle)) => write!(f, "{distance:.3e} m and {angle:.3e} rad"),
            (None, angle) => write!(f, "{:.3e} rad", angle.unwrap_or(crate::number::Written(0.0))),
        }
    }
}

/// Result of an assembly.
#[derive(Clone, Debug, PartialEq)]
pub struct Assembled {
    /// Gaps before the assembly, except for round-off.
    pub gaps: Vec<Gap>,
    /// Largest remaining violation [m, rad].
    pub left: f64,
    /// Displacement [m] and rotation [rad] of every node.
    pub moved: Vec<(f64, f64)>,
    /// Whether no smaller change nearby closes the joints. Always false if coordinates were moved to values.
    pub is_least: bool,
}

diagnostics! {
    /// Joints that do not close.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    Failure AssemblyError {
        /// Joints stay open.
        Open {
            /// The open joints, the widest gap first.
            gaps: Gaps,
        } => "joints-do-not-close" {
            subject: Subject::new("joint", gaps.first().map_or("", |gap| &gap.joint)),
            cause: ("the joints do not close; at the best approximation these remain open: {}", in_words(gaps)),
            remedy: "",
            meaning: "No positions were found at which all joints close.",
            advice: "Check the dimensions of the parts and the coordinates that are held.",
        }
        /// Joints close only with frames that point in opposite directions.
        UpsideDown {
            /// Name of the joint.
            joint: String,
        } => "joint-upside-down" {
            subject: Subject::new("joint", joint),
            cause: ("`{joint}` closes upside down only: the axes of base and tip point opposite ways"),
            remedy: "",
            meaning: "A joint closes only if the axes of its base and tip point opposite ways.",
            advice: "Reverse the axis of the joint on one of its parts.",
        }
    }
}

/// Gaps, the widest first.
#[derive(Clone, Debug, PartialEq)]
pub struct Gaps(pub Vec<Gap>);

impl Deref for Gaps {
    type Target = [Gap];

    fn deref(&self) -> &[Gap] {
        &self.0
    }
}

impl From<&Gaps> for Value {
    fn from(gaps: &Gaps) -> Self {
        Self::Text(in_words(gaps))
    }
}

fn in_words(gaps: &[Gap]) -> String {
    let named: Vec<String> = gaps.iter().take(MAX_LISTED).map(Gap::to_string).collect();
    let more = gaps.len().saturating_sub(MAX_LISTED);
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    named.join(", ") + &rest
}

/// Moves nodes and coordinates of `at` until all joints and relations are satisfied and the coordinates have the requested values.
///
/// # Errors
/// If no such positions are found; `at` is then unchanged.
pub fn assemble(
    system: &System,
    at: &mut Kinematics,
    request: &Request<'_>,
) -> Result<Assembled, AssemblyError> {
    let groups = Groups::new(system, at, &request.rigid, &request.fixed);
    let values = held_values(system, at, request);
    let held: Vec<CoordinateId> = values.iter().map(|&(coordinate, _)| coordinate).collect();
    let drawn = at.clone();
    let mut closing = Closing::new(system, at, &groups, &held);
    let drawn_pose = closing.as_modelled(at);
    let gaps = closing.gaps(&drawn_pose, request.tolerance);
    let mut pose = closing.close(drawn_pose.clone(), request.tolerance);
    let mut is_least = false;
    if closing.largest(&pose) <= request.tolerance
        && let Some(nearest) = closing.nearest(pose.clone(), &drawn_pose, request.tolerance)
    {
        (pose, is_least) = (nearest, true);
    }
    let stages = stages(system, &pose, &values, closing.length());
    if stages > 0 {
        let tree = Tree::new(system, &groups, &held);
        let start = pose.coordinates.clone();
        for stage in 1..=stages {
            let share = stage as f64 / stages as f64;
            for &(coordinate, value) in &values {
                let wanted = if stage == stages {
                    value
                } else {
                    start[coordinate.index()] + share * (value - start[coordinate.index()])
                };
                tree.bring(system, &mut pose, coordinate, wanted, closing.length());
            }
            pose = closing.close(pose, request.tolerance);
        }
        is_least = false;
    }
    let left = closing.gaps(&pose, request.tolerance);
    if !left.is_empty() {
        return Err(AssemblyError::Open { gaps: Gaps(left) });
    }
    closing.place(&pose, at);
    if let Some(joint) = upside_down(system, at) {
        *at = drawn;
        return Err(AssemblyError::UpsideDown { joint });
    }
    let mut violations = vec![0.0; system.layout().multiplier_count];
    system.violations(at, &mut violations);
    let moved = drawn.nodes.iter().zip(&at.nodes).map(|(before, after)| {
        let turn = (before.frame.rotation.inverse() * after.frame.rotation).logarithm().norm();
        ((after.frame.position - before.frame.position).norm(), turn)
    });
    Ok(Assembled {
        gaps,
        left: violations.iter().fold(0.0, |most: f64, value| most.max(value.abs())),
        moved: moved.collect(),
        is_least,
    })
}

/// The requested values, and the initial values of drives.
fn held_values(system: &System, at: &Kinematics, request: &Request<'_>) -> Vec<(CoordinateId, f64)> {
    let mut values = request.values.clone();
    for drive in system.drives() {
        let coordinate = drive.prescribed.coordinate;
        if values.iter().all(|&(known, _)| known != coordinate) {
            values.push((coordinate, drive.prescribed.value.value(at.time)));
        }
    }
    values
}

/// Number of stages in which the coordinates are moved to their values.
fn stages(system: &System, pose: &Pose, values: &[(CoordinateId, f64)], length: f64) -> usize {
    let of = |&(coordinate, value): &(CoordinateId, f64)| {
        let way = (value - pose.coordinates[coordinate.index()]).abs();
        match system.layout().coordinate_quantity(coordinate) {
            Quantity::Angle => way / TURN,
            Quantity::Length | Quantity::State => way / (SHIFT * length),
        }
    };
    let most = values.iter().map(of).fold(0.0, f64::max);
    // Counts are small and not negative; a value that is NaN requires no stage and leaves a gap.
    most.min(MOST_STAGES).ceil() as usize
}

/// Joint whose angle equations are satisfied only because sines of half a turn vanish: their gradient has lost rank.
fn upside_down(system: &System, at: &Kinematics) -> Option<String> {
    const LOST: f64 = 1e-3;
    let least = |joint: &AttachedJoint, configuration: &(Relative, JointCoordinates)| {
        let gradient = joint.own_gradient(configuration).relative;
        let is_angle = |&equation: &usize| joint.joint().equation_quantity(equation) == Quantity::Angle;
        let angles: Vec<usize> = (0..joint.equations()).filter(is_angle).collect();
        let rows = nalgebra::DMatrix::from_fn(angles.len(), 3, |i, j| gradient[(angles[i], 3 + j)]);
        (!angles.is_empty()).then(|| rows.singular_values().min())
    };
    let is_lost = |joint: &&AttachedJoint| {
        let [found, built] =
            [joint.evaluate_absolute(at), joint.as_built()].map(|place| least(joint, &place));
        found.zip(built).is_some_and(|(found, built)| found < LOST * built)
    };
    system.joints().iter().find(is_lost).map(|joint| joint.name.clone())
}

/// Gap of this distance and angle, of which the values beyond the tolerance are kept; NaN is kept.
fn gap(joint: &str, (distance, angle): (f64, f64), (length, tolerance): (f64, f64)) -> Option<Gap> {
    let beyond = |value: f64, unit: f64| if value <= tolerance { None } else { Some(value * unit) };
    let (distance, angle) = (beyond(distance, length), beyond(angle, 1.0));
    (distance.is_some() || angle.is_some()).then(|| Gap { joint: joint.to_owned(), distance, angle })
}
