//! Rolling without sliding: a constraint between velocities, with the forces that hold it.
//!
//! Legend: (R, x) tip's joint frame in the base's, V twists in the frames' own axes, A = Ad((R, x)⁻¹), η variation of
//! the tip's frame relative to the base's, b_k see `joints::contact`, Λ_k impulses: coordinates without mass whose rates
//! are the forces of the plane against sliding.
//!
//! ```text
//! rows of the tip's frame Σ Λ̇_k b_k,   of the base's -Aᵀ Σ Λ̇_k b_k,   of Λ_k:  b_k·(V_tip - A V_base) = 0
//! ```
//!
//! A constraint between velocities is no derivative of one between places, and so it has no multiplier among those.
//! With impulses for coordinates the matrix by velocities is symmetric, [0 Bᵀ; B 0], and the equation holds at every stage
//! of a scheme: the forces do no work there. With a linear law of creep c there are no impulses, but forces in place of
//! Λ̇_k, b_k·(V_tip - A V_base)/c.

use lissom_motion::{Matrix3, Matrix6, Vector6, lie_bracket_matrix, rotation_part, skew, translation_part};

use super::{Element, Energy, Tangents, add_block};
use crate::joints::attached::CarriedFrame;
use crate::joints::contact::{Contact, DIRECTIONS};
use crate::system::{CoordinateId, Kinematics, NodeId};

/// A wheel on a plane.
#[derive(Clone, Debug)]
pub(crate) struct Rolling {
    nodes: [NodeId; 2],
    frames: [CarriedFrame; 2],
    /// None where it creeps.
    impulses: Vec<CoordinateId>,
    contact: Contact,
}

/// Relative motion of the two joint frames.
struct Rolled {
    /// A.
    to_tip: Matrix6,
    rotation: Matrix3,
    /// b_k.
    rows: [Vector6; DIRECTIONS],
    /// V_tip - A V_base, and A V_base.
    twist: Vector6,
    carried: Vector6,
    forces: [f64; DIRECTIONS],
}

impl Rolled {
    /// On the left-hand side.
    fn wrench(&self) -> Vector6 {
        self.forces[0] * self.rows[0] + self.forces[1] * self.rows[1]
    }
}

impl Rolling {
    /// Of a joint's frames; `impulses` are empty where the contact creeps.
    pub(crate) fn new(frames: [CarriedFrame; 2], impulses: Vec<CoordinateId>, contact: Contact) -> Self {
        Self { nodes: frames.map(|frame| frame.node), frames, impulses, contact }
    }

    fn rolled(&self, at: &Kinematics) -> Rolled {
        let [base, tip] = self.frames.map(|frame| at.nodes[frame.node].frame * frame.offset);
        let twists = self.frames.map(|frame| frame.offset.adjoint_inverse_times(&at.nodes[frame.node].twist));
        let relative = tip.relative_to(&base);
        let to_tip = relative.inverse().adjoint();
        let carried = to_tip * twists[0];
        let (rotation, twist) = (relative.rotation.matrix(), twists[1] - carried);
        let rows = self.contact.rows(&rotation);
        let forces = match self.impulses[..] {
            [first, second] => [first, second].map(|impulse| at.coordinates[impulse].rate),
            _ => rows.map(|row| row.dot(&twist) / self.contact.creep),
        };
        Rolled { to_tip, rotation, rows, twist, carried, forces }
    }

    /// Wrench on the tip in the tip's joint frame, by which the plane keeps it from sliding [N, N m].
    pub(crate) fn wrench(&self, at: &Kinematics) -> Vector6 {
        -self.rolled(at).wrench()
    }

    /// Ad of the frames' offsets, inverse: from variations of the nodes to those of the frames.
    fn carry(&self) -> [Matrix6; 2] {
        self.frames.map(|frame| frame.offset.inverse().adjoint())
    }
}

impl Element for Rolling {
    fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    fn coordinates(&self) -> &[CoordinateId] {
        &self.impulses
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let of = self.rolled(at);
        let wrench = of.wrench();
        let carry = self.carry();
        let on = [carry[0].tr_mul(&-of.to_tip.tr_mul(&wrench)), carry[1].tr_mul(&wrench)];
        for (side, wrench) in on.iter().enumerate() {
            for k in 0..6 {
                out[6 * side + k] += wrench[k];
            }
        }
        for (k, row) in of.rows.iter().enumerate().take(self.impulses.len()) {
            out[12 + k] += row.dot(&of.twist);
        }
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let of = self.rolled(at);
        let wrench = of.wrench();
        let (mut by_place, turns) = self.contact.derivatives(&of.rotation, &of.forces, &of.twist);
        // δ(b_k·η̇) with δη̇ = -ad(A V_base) η.
        let bracket = lie_bracket_matrix(&of.carried);
        let slides = [0, 1].map(|k| turns[k] - bracket.tr_mul(&of.rows[k]));
        let mut by_rate = Matrix6::zeros();
        if self.impulses.is_empty() {
            for (row, slide) in of.rows.iter().zip(&slides) {
                by_place += row * slide.transpose() / self.contact.creep;
                by_rate += row * row.transpose() / self.contact.creep;
            }
        }

        // ad(η)ᵀ w as a matrix on η.
        let mut coadjoint = Matrix6::zeros();
        let (force, moment) = (skew(&translation_part(&wrench)), skew(&rotation_part(&wrench)));
        coadjoint.fixed_view_mut::<3, 3>(0, 3).copy_from(&force);
        coadjoint.fixed_view_mut::<3, 3>(3, 0).copy_from(&force);
        coadjoint.fixed_view_mut::<3, 3>(3, 3).copy_from(&moment);
        let carry = self.carry();
        // Columns: η = ξ_tip - A ξ_base.
        let columns = [-of.to_tip * carry[0], carry[1]];
        let place_rows = [
            carry[0].transpose() * of.to_tip.transpose() * (coadjoint - by_place),
            carry[1].transpose() * by_place,
        ];
        let size = 12 + self.impulses.len();
        for j in 0..2 {
            for (i, rows) in place_rows.iter().enumerate() {
                let by_rate = columns[i].transpose() * by_rate * columns[j];
                add_block(&mut out.stiffness, size, (6 * i, 6 * j), &(rows * columns[j]));
                add_block(&mut out.damping, size, (6 * i, 6 * j), &by_rate);
            }
            for k in 0..self.impulses.len() {
                let by_place = slides[k].transpose() * columns[j];
                let by_rate = of.rows[k].transpose() * columns[j];
                add_block(&mut out.stiffness, size, (12 + k, 6 * j), &by_place);
                add_block(&mut out.damping, size, (12 + k, 6 * j), &by_rate);
                add_block(&mut out.damping, size, (6 * j, 12 + k), &by_rate.transpose());
            }
        }
    }

    fn energy(&self, _: &Kinematics) -> Energy {
        Energy::default()
    }
}
