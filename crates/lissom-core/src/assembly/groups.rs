//! Rigid bodies of an assembly: a node, or the nodes of beams that share nodes.

use lissom_motion::{Motion, Vector3};

use crate::kinematics::{GROUND, Kinematics, LOCKED, NodeId};
use crate::system::System;

/// A rigid body of the assembly.
pub(super) struct RigidGroup {
    /// Nodes of the body, and their frames relative to the group's.
    pub(super) nodes: Vec<(NodeId, Motion)>,
    /// Frame of the body as modelled: at the centre of its points, with the axes of its first node.
    pub(super) frame: Motion,
    /// ρ, root mean square distance of its points from their centre [m].
    pub(super) radius: f64,
    /// Free translations and rotations, in its axes.
    pub(super) free: [bool; 6],
}

impl RigidGroup {
    /// Whether it cannot move.
    pub(super) fn is_fixed(&self) -> bool {
        self.free == [false; 6]
    }
}

/// All rigid bodies of an assembly.
pub(super) struct Groups {
    pub(super) all: Vec<RigidGroup>,
    /// The group of every node, and the index of the node there.
    pub(super) of_node: Vec<(usize, usize)>,
    /// Size of the model: root mean square distance of all points from their centre [m].
    pub(super) length: f64,
}

impl Groups {
    pub(super) fn new(system: &System, at: &Kinematics, rigid: &[&[NodeId]], fixed: &[NodeId]) -> Self {
        let count = at.nodes.len();
        let mut first: Vec<NodeId> = NodeId::first(count).collect();
        for nodes in rigid {
            for pair in nodes.windows(2) {
                let (a, b) = (root(&first, pair[0]), root(&first, pair[1]));
                first[a.max(b).index()] = a.min(b);
            }
        }
        let mut points: Vec<Vec<Vector3>> = vec![Vec::new(); count];
        for (node, motion) in NodeId::enumerate(&at.nodes).filter(|&(node, _)| node != GROUND) {
            points[root(&first, node).index()].push(motion.frame.position);
        }
        for frame in system.joints().iter().flat_map(|joint| joint.frames) {
            let place = at.nodes[frame.node].frame.transform_point(&frame.offset.position);
            points[root(&first, frame.node).index()].push(place);
        }
        let everything: Vec<Vector3> = points.concat();
        let (_, spread) = center_and_radius(&everything);
        let length = if spread > 0.0 { spread } else { 1.0 };
        let mut all: Vec<RigidGroup> = Vec::new();
        let mut of_node = vec![(0, 0); count];
        let mut of_root = vec![usize::MAX; count];
        for node in NodeId::first(count) {
            let own = root(&first, node);
            let index = &mut of_root[own.index()];
            if *index == usize::MAX {
                *index = all.len();
                all.push(group(system, at, own, &points[own.index()], length));
            }
            let group = &mut all[*index];
            of_node[node.index()] = (*index, group.nodes.len());
            group.nodes.push((node, at.nodes[node].frame.relative_to(&group.frame)));
        }
        for &node in fixed.iter().chain([&GROUND]) {
            all[of_node[node.index()].0].free = [false; 6];
        }
        Self { all, of_node, length }
    }

    /// Sets the positions of the nodes of all groups that can move.
    pub(super) fn place(&self, frames: &[Motion], at: &mut Kinematics) {
        for (group, frame) in self.all.iter().zip(frames).filter(|(group, _)| !group.is_fixed()) {
            for &(node, place) in &group.nodes {
                at.nodes[node].frame = *frame * place;
            }
        }
    }
}

fn group(system: &System, at: &Kinematics, node: NodeId, points: &[Vector3], length: f64) -> RigidGroup {
    let free = system.layout().rows_of_node(node).map(|row| row != LOCKED);
    let frame = at.nodes[node].frame;
    let (center, radius) = center_and_radius(points);
    let turns = free[3..].iter().any(|is_free| *is_free);
    RigidGroup {
        nodes: Vec::new(),
        frame: if turns { Motion::new(frame.rotation, center) } else { frame },
        // A part with a single point has no radius: the model's size weights its rotation.
        radius: if radius > 0.0 { radius } else { length },
        free,
    }
}

fn center_and_radius(points: &[Vector3]) -> (Vector3, f64) {
    let count = points.len().max(1) as f64;
    let center = points.iter().sum::<Vector3>() / count;
    let square = points.iter().map(|point| (point - center).norm_squared()).sum::<f64>() / count;
    (center, square.sqrt())
}

/// The first of the nodes that are rigidly connected to `node`.
fn root(first: &[NodeId], mut node: NodeId) -> NodeId {
    while first[node.index()] != node {
        node = first[node.index()];
    }
    node
}
