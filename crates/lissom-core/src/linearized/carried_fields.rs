//! Velocity fields of parts that rotate on a support which gives way, such as a rotor on a tower that its thrust bends: the axis of
//! the rotation moves with the support.
//!
//! ```text
//! V = Ad(H H₀⁻¹) V₀      H, H₀ frames of the node of the support that carries the joint, now and at the start
//! ```

use lissom_motion::{Motion, Vector6, lie_bracket};
use num_complex::Complex64;

use crate::kinematics::{Kinematics, LOCKED, NodeId};
use crate::round_off;
use crate::system::{Linearization, System};

/// The velocity field of each node.
pub(super) struct CarriedFields {
    /// At the start, in inertial axes.
    fields: Vec<Vector6>,
    /// The node that carries the axis, and the inverse of its frame at the start.
    carriers: Vec<Option<(NodeId, Motion)>>,
}

impl CarriedFields {
    /// The fields of a state. A rotating part is carried by the node at rest to which a joint connects it or a part that moves as it does.
    pub(super) fn new(system: &System, at: &Kinematics) -> Self {
        let fields: Vec<Vector6> =
            at.nodes.iter().map(|node| node.frame.adjoint_times(&node.twist)).collect();
        let largest = fields.iter().map(Vector6::amax).fold(0.0, f64::max);
        let is_same = |a: &Vector6, b: &Vector6| (a - b).amax() <= round_off::GIVEN * largest;
        let zero = Vector6::zeros();
        let mut supports: Vec<(Vector6, NodeId)> = Vec::new();
        for joint in system.joints() {
            let nodes = joint.output_frames.map(|frame| frame.node);
            for [support, rotor] in [nodes, [nodes[1], nodes[0]]] {
                let field = fields[rotor.index()];
                let is_between = is_same(&fields[support.index()], &zero) && !is_same(&field, &zero);
                if is_between && !supports.iter().any(|(known, _)| is_same(known, &field)) {
                    supports.push((field, support));
                }
            }
        }
        let carrier = |field: &Vector6| {
            let (_, node) = supports.iter().find(|(known, _)| is_same(known, field))?;
            Some((*node, at.nodes[*node].frame.inverse()))
        };
        let carriers = fields.iter().map(carrier).collect();
        Self { fields, carriers }
    }

    /// What the tangent of constant fields lacks: to each row of a support's increments ψ a column of forces, because the fields are carried
    /// with it.
    ///
    /// ```text
    /// V = V₀ + ad_V (δ - A ψ),  A = Ad(H⁻¹ S)      that is, rates -z and accelerations -ad_V (-z), z = ad_V A ψ, relative to the drift
    /// ```
    pub(super) fn columns(
        &self,
        system: &System,
        at: &Kinematics,
        parts: &Linearization,
    ) -> Vec<(usize, Vec<Complex64>)> {
        let (layout, pattern) = (system.layout(), &system.structure().pattern);
        let mut supports: Vec<NodeId> = self.carriers.iter().flatten().map(|(support, _)| *support).collect();
        supports.sort_unstable();
        supports.dedup();
        let mut columns = Vec::new();
        for (support, axis) in supports.into_iter().flat_map(|own| (0..6).map(move |axis| (own, axis))) {
            let row = layout.rows_of_node(support)[axis];
            if row == LOCKED {
                continue;
            }
            let mut sum = vec![Complex64::default(); pattern.size()];
            for (node, _) in
                NodeId::enumerate(&self.carriers).filter(|(_, own)| own.is_some_and(|own| own.0 == support))
            {
                let own = &at.nodes[node];
                let moved = own
                    .frame
                    .adjoint_inverse_times(&at.nodes[support].frame.adjoint_times(&Vector6::ith(axis, 1.0)));
                let rate = -lie_bracket(&own.twist, &moved);
                let acceleration = -lie_bracket(&own.twist, &rate);
                for (k, &column) in
                    layout.rows_of_node(node).iter().enumerate().filter(|(_, row)| **row != LOCKED)
                {
                    let column = column as usize;
                    for entry in pattern.column_starts()[column]..pattern.column_starts()[column + 1] {
                        let force = parts.damping[entry] * rate[k] + parts.mass[entry] * acceleration[k];
                        sum[pattern.row_indices()[entry]] += force;
                    }
                }
            }
            columns.push((row as usize, sum));
        }
        columns
    }

    /// Sets the twists of all nodes at their present frames.
    pub(super) fn apply(&self, at: &mut Kinematics) {
        for (node, (field, carrier)) in NodeId::enumerate(self.fields.iter().zip(&self.carriers)) {
            let moved = carrier.map(|(support, start)| at.nodes[support].frame * start);
            let field = moved.map_or(*field, |moved| moved.adjoint_times(field));
            let frame = at.nodes[node].frame;
            at.nodes[node].twist = frame.adjoint_inverse_times(&field);
        }
    }
}
