//! Spanning tree of the joints, from the ground outwards. Moving a coordinate to a value rotates or shifts everything beyond its joint
//! as one rigid body.

use lissom_motion::{Motion, Vector6};
use nalgebra::{DMatrix, DVector};

use super::closing::Pose;
use super::groups::Groups;
use crate::joints::attached::AttachedJoint;
use crate::joints::{JointCoordinates, Relative};
use crate::kinematics::{CoordinateId, Quantity};
use crate::system::System;
use crate::tuning::MAX_ITERATIONS;

/// Added to the squared gradients of a joint, so that dependent equations have a solution too.
const REGULARIZATION: f64 = 1e-12;

/// A tree of rigid groups.
pub(super) struct Tree<'a> {
    groups: &'a Groups,
    /// By joint: the groups beyond it, and whether its tip is among them; none for joints that close loops.
    beyond: Vec<Option<(Vec<usize>, bool)>>,
}

impl<'a> Tree<'a> {
    /// Joints of the coordinates in `first` are added to the tree before all others.
    pub(super) fn new(system: &System, groups: &'a Groups, first: &[CoordinateId]) -> Self {
        let joints = system.joints();
        let is_first = |joint: &AttachedJoint| joint.coordinates.iter().any(|own| first.contains(own));
        let mut order: Vec<usize> = (0..joints.len()).collect();
        order.sort_by_key(|&index| !is_first(&joints[index]));
        let count = groups.all.len();
        // All fixed groups are one.
        let mut root: Vec<usize> = (0..count).collect();
        let fixed: Vec<usize> = (0..count).filter(|&group| groups.all[group].is_fixed()).collect();
        for &group in &fixed {
            root[group] = fixed[0];
        }
        let mut neighbours: Vec<Vec<(usize, usize)>> = vec![Vec::new(); count];
        for index in order {
            let [base, tip] = joints[index].frames.map(|frame| groups.of_node[frame.node.index()].0);
            let (from, to) = (root[base], root[tip]);
            if from != to {
                root.iter_mut().filter(|own| **own == to).for_each(|own| *own = from);
                neighbours[base].push((tip, index));
                neighbours[tip].push((base, index));
            }
        }
        let mut beyond: Vec<Option<(Vec<usize>, bool)>> = vec![None; joints.len()];
        let mut seen = vec![false; count];
        let mut visited: Vec<(usize, usize, usize)> = Vec::new();
        for start in fixed.iter().copied().chain(0..count) {
            if seen[start] {
                continue;
            }
            seen[start] = true;
            let mut waiting = vec![start];
            while let Some(group) = waiting.pop() {
                for &(next, joint) in &neighbours[group] {
                    if !seen[next] {
                        seen[next] = true;
                        visited.push((next, group, joint));
                        waiting.push(next);
                    }
                }
            }
        }
        // From the leaves inwards: the groups beyond a group are beyond its own joint, too.
        let mut hanging: Vec<Vec<usize>> = (0..count).map(|group| vec![group]).collect();
        for (group, parent, joint) in visited.into_iter().rev() {
            let own = hanging[group].clone();
            hanging[parent].extend(&own);
            let tip_is_beyond = groups.of_node[joints[joint].frames[1].node.index()].0 == group;
            beyond[joint] = Some((own, tip_is_beyond));
        }
        Self { groups, beyond }
    }

    /// Moves a coordinate to a value. If its joint closes a loop, only the coordinate is changed.
    pub(super) fn bring(
        &self,
        system: &System,
        pose: &mut Pose,
        coordinate: CoordinateId,
        value: f64,
        length: f64,
    ) {
        let owner = |joint: &AttachedJoint| joint.coordinates.contains(&coordinate);
        let found = system.joints().iter().position(owner);
        let before = std::mem::replace(&mut pose.coordinates[coordinate.index()], value);
        let Some((index, (groups, tip_is_beyond))) =
            found.and_then(|index| Some((index, self.beyond[index].as_ref()?)))
        else {
            return;
        };
        if before == value || groups.iter().any(|&group| self.groups.all[group].is_fixed()) {
            return;
        }
        let joint = &system.joints()[index];
        let [base, tip] = joint.frames.map(|frame| {
            let (group, place) = self.groups.of_node[frame.node.index()];
            pose.frames[group] * self.groups.all[group].nodes[place].1 * frame.offset
        });
        let mut own = JointCoordinates::default();
        for (k, &coordinate) in joint.coordinates.iter().enumerate() {
            own.value[k] = pose.coordinates[coordinate.index()];
        }
        let Some(relative) = in_place(joint, tip.relative_to(&base), &own, length) else { return };
        let shift = if *tip_is_beyond {
            base * relative * tip.inverse()
        } else {
            tip * relative.inverse() * base.inverse()
        };
        for &group in groups {
            let moved = shift * pose.frames[group];
            // Over many stages the round-off of rotations would grow exponentially.
            pose.frames[group] = Motion::new(moved.rotation.normalized(), moved.position);
        }
    }
}

/// Relative motion nearest to `start` that satisfies the equations of a joint with the coordinates `own`.
fn in_place(joint: &AttachedJoint, start: Motion, own: &JointCoordinates, length: f64) -> Option<Motion> {
    let equations = joint.equations();
    let unit = |k: usize| if k < 3 { length } else { 1.0 };
    let mut relative = start;
    for _ in 0..MAX_ITERATIONS {
        let configuration = (Relative::at_start(&relative), *own);
        let scale = |equation: usize| match joint.joint().equation_quantity(equation) {
            Quantity::Angle => 1.0,
            Quantity::Length | Quantity::State => length.recip(),
        };
        let violation = joint.joint().violation(&configuration.0, own);
        let right = DVector::from_fn(equations, |i, _| -scale(i) * violation[i]);
        if right.amax() < 1e-14 {
            break;
        }
        let gradient = joint.own_gradient(&configuration);
        let rows = DMatrix::from_fn(equations, 6, |i, j| scale(i) * gradient.relative[(i, j)] * unit(j));
        // The shortest step. A singular value decomposition need not end.
        let square = &rows * rows.transpose() + DMatrix::identity(equations, equations) * REGULARIZATION;
        let step = rows.tr_mul(&square.cholesky()?.solve(&right));
        let step = Vector6::from_fn(|k, _| unit(k) * step[k]);
        relative = relative * Motion::exponential(&step);
        relative.rotation = relative.rotation.normalized();
    }
    relative.position.iter().all(|value| value.is_finite()).then_some(relative)
}
