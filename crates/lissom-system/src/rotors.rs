//! Which nodes are symmetric about an axis, with all that is attached to them.
//!
//! A node is a rotor if its inertia is the same in all axes that are turned about one axis through it, as far as round-off, and if each
//! element and joint on it is symmetric about that axis, too, and no signal measures it or its angle. Nothing in the motion of the model
//! then depends on how far it has turned, and no event can occur at an angle. All others stay as they are.

use lissom_mechanics::evaluation::capabilities::Symmetric;
use lissom_mechanics::joints::attached::AttachedJoint;
use lissom_mechanics::joints::{cylindrical, revolute, spherical};
use lissom_mechanics::kinematics::{CoordinateId, Kinematics, LOCKED, NodeId, Rotor, Triple, is_along};
use lissom_mechanics::round_off::COINCIDENT;
use lissom_motion::{Matrix6, Rotation, Vector3};

use crate::System;

impl System {
    /// The rotors of the model, at its start.
    pub fn find_rotors(&self, start: &Kinematics) -> Vec<Rotor> {
        // Forces of touches are at points of the parts.
        if !self.contacts.is_empty() {
            return Vec::new();
        }
        let is_free = |node: &NodeId| self.layout.rows_of_node(*node).iter().all(|&row| row != LOCKED);
        let about_axes = self.joints().iter().filter(|joint| has_axis(joint));
        let mut nodes: Vec<NodeId> =
            about_axes.flat_map(|joint| joint.frames.each_ref().map(|frame| frame.node)).collect();
        nodes.sort_unstable_by_key(|node| node.index());
        nodes.dedup();
        let candidates = nodes.into_iter().filter(is_free).filter_map(|node| self.rotor(node, start));
        let candidates: Vec<(Rotor, usize)> = candidates.collect();
        if candidates.is_empty() {
            return Vec::new();
        }
        let attached = self.attached();
        let is_complete = |(rotor, symmetric): &(Rotor, usize)| attached[rotor.node.index()] == *symmetric;
        candidates.into_iter().filter(is_complete).map(|(rotor, _)| rotor).collect()
    }

    /// Rotors on which symmetric springs act.
    pub fn sprung_rotors(&self) -> Vec<Rotor> {
        let is_sprung = |rotor: &&Rotor| {
            let springs = self.elements_with(|can| can.spring.and(can.symmetry));
            springs.into_iter().any(|spring| spring.is_symmetric_about(rotor.node, &rotor.axis))
        };
        self.layout.rotors.iter().filter(is_sprung).cloned().collect()
    }

    /// The node as a rotor, and how many inertias, joints and elements on it are symmetric; none if an inertia or a joint is not.
    fn rotor(&self, node: NodeId, start: &Kinematics) -> Option<(Rotor, usize)> {
        let on_node = |joint: &&AttachedJoint| joint.frames.iter().any(|frame| frame.node == node);
        let joints: Vec<&AttachedJoint> = self.joints().iter().filter(on_node).collect();
        let of_joint = joints.iter().find(|joint| has_axis(joint))?;
        let frame = of_joint.frames.iter().find(|frame| frame.node == node)?;
        let axis = frame.offset.rotation.apply(&Vector3::z());
        let inertias: Vec<_> = self.inertias.iter().filter(|inertia| inertia.node() == node).collect();
        if inertias.is_empty() || !inertias.iter().all(|inertia| is_round(inertia.mass(), &axis)) {
            return None;
        }
        let mut triples = Vec::new();
        for joint in &joints {
            triples.extend(triples_of(joint, node, &axis)?);
        }
        if self.is_measured(node, &of_joint.coordinates, start) {
            return None;
        }
        let is_symmetric = |element: &&dyn Symmetric| element.is_symmetric_about(node, &axis);
        let symmetric = self.elements_with(|can| can.symmetry).filter(is_symmetric).count();
        let first = start.nodes[node].frame.rotation;
        Some((Rotor { node, axis, first, triples }, inertias.len() + joints.len() + symmetric))
    }

    /// Whether signals depend on the motion of a node, or on the values of these coordinates.
    fn is_measured(&self, node: NodeId, coordinates: &[CoordinateId], start: &Kinematics) -> bool {
        self.signals().measurements.iter().any(|measured| {
            let is_of_axis = measured.of.coordinates().iter().any(|other| coordinates.contains(other));
            measured.of.nodes().contains(&node)
                || is_of_axis && measured.gradient(start).by_place.iter().any(|value| *value != 0.0)
        })
    }
}

/// Whether the tip of a joint turns about the third axis alone.
fn has_axis(joint: &AttachedJoint) -> bool {
    [revolute::KIND.name, cylindrical::KIND.name].contains(&joint.kind)
}

/// Equations of a joint in axes of a node that is its tip; none if the joint is not symmetric about the axis.
fn triples_of(joint: &AttachedJoint, node: NodeId, axis: &Vector3) -> Option<Vec<Triple>> {
    let [base, tip] = joint.frames;
    if base.node == tip.node || !(has_axis(joint) || joint.kind == spherical::KIND.name) {
        return None;
    }
    let of_node = if tip.node == node { tip } else { base };
    let is_about = !has_axis(joint) || is_along(&of_node.offset.rotation.apply(&Vector3::z()), axis);
    if !is_about || !is_along(&of_node.offset.position, axis) {
        return None;
    }
    if base.node == node {
        return Some(Vec::new());
    }
    let axis = tip.offset.rotation.apply_inverse(axis);
    let of = |first: usize| Triple { first_multiplier: joint.first_multiplier + first, axis };
    Some((0..joint.equations()).step_by(3).map(of).collect())
}

/// Whether a mass matrix is the same in axes that are turned about this one.
fn is_round(mass: &Matrix6, axis: &Vector3) -> bool {
    // An angle that is no share of a revolution.
    let turn = Rotation::about_axis(axis, 1.0).matrix();
    let mut both = Matrix6::zeros();
    both.fixed_view_mut::<3, 3>(0, 0).copy_from(&turn);
    both.fixed_view_mut::<3, 3>(3, 3).copy_from(&turn);
    let difference = both * mass * both.transpose() - mass;
    let parts = [(0, 0), (0, 3), (3, 3)].map(|at| difference.fixed_view::<3, 3>(at.0, at.1).norm());
    let [masses, moments] = [0, 3].map(|at| mass.fixed_view::<3, 3>(at, at).norm());
    let sizes = [masses, (masses * moments).sqrt(), moments];
    parts.iter().zip(sizes).all(|(part, size)| *part <= COINCIDENT * size)
}
