//! Rolling without sliding: a velocity constraint with its forces.
//!
//! Legend: (R, x) tip's joint frame in the base's, V twists in the frames' own axes, A = Ad((R, x)⁻¹), η variation of the tip's
//! frame relative to the base's, b_k see `contact::wheel_on_plane`, Λ_k impulses: coordinates without mass whose rates are the
//! forces of the plane that prevent sliding.
//!
//! ```text
//! rows of the tip's frame Σ Λ̇_k b_k,   of the base's -Aᵀ Σ Λ̇_k b_k,   of Λ_k:  b_k·(V_tip - A V_base) = 0
//! ```
//!
//! A velocity constraint is not the derivative of a position constraint, and so it has no multiplier. With impulses for
//! coordinates the derivative with respect to velocities is symmetric, [0 Bᵀ; B 0], and the equation holds at every stage
//! of a scheme: the forces do no work there. With a linear creep law of coefficient c there are no impulses, but forces in
//! place of Λ̇_k, b_k·(V_tip - A V_base)/c.

use lissom_motion::{Matrix6, Vector6, lie_bracket_matrix};

use super::frame_pair::{FramePair, RelativeMotion};
use super::{Element, Tangents, Unknowns, add_block};
use crate::contact::wheel_on_plane::{Contact, DIRECTIONS};
use crate::kinematics::{CarriedFrame, CoordinateId, Kinematics};

/// A wheel on a plane.
#[derive(Clone, Debug)]
pub struct Rolling {
    frames: FramePair,
    /// None with creep.
    impulses: Vec<CoordinateId>,
    contact: Contact,
}

/// Relative motion of the two joint frames, and the forces that oppose sliding.
struct Rolled {
    motion: RelativeMotion,
    /// b_k.
    rows: [Vector6; DIRECTIONS],
    forces: [f64; DIRECTIONS],
}

impl Rolled {
    /// On the left-hand side.
    fn wrench(&self) -> Vector6 {
        self.forces[0] * self.rows[0] + self.forces[1] * self.rows[1]
    }
}

impl Rolling {
    /// Between a joint's frames; `impulses` are empty if the contact creeps.
    pub fn new(frames: [CarriedFrame; 2], impulses: Vec<CoordinateId>, contact: Contact) -> Self {
        Self { frames: FramePair::new(frames), impulses, contact }
    }

    fn rolled(&self, at: &Kinematics) -> Rolled {
        let motion = self.frames.motion(at);
        let rows = self.contact.rows(&motion.rotation, 0.0);
        let forces = match self.impulses[..] {
            [first, second] => [first, second].map(|impulse| at.coordinates[impulse].rate),
            _ => rows.map(|row| row.dot(&motion.twist) / self.contact.creep),
        };
        Rolled { motion, rows, forces }
    }

    /// Wrench of the plane on the tip in the tip's joint frame, which prevents sliding [N, N m].
    pub fn wrench(&self, at: &Kinematics) -> Vector6 {
        -self.rolled(at).wrench()
    }
}

impl Element for Rolling {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns { nodes: &self.frames.nodes, coordinates: &self.impulses, multipliers: &[] }
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let of = self.rolled(at);
        self.frames.add_wrench(&of.motion, &of.wrench(), out);
        for (k, row) in of.rows.iter().enumerate().take(self.impulses.len()) {
            out[12 + k] += row.dot(&of.motion.twist);
        }
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let of = self.rolled(at);
        let wrench = of.wrench();
        let (mut by_place, turns) = self.contact.derivatives(
            &of.motion.rotation,
            (0.0, &Vector6::zeros()),
            &of.forces,
            &of.motion.twist,
        );
        // δ(b_k·η̇) with δη̇ = -ad(A V_base) η.
        let bracket = lie_bracket_matrix(&of.motion.carried);
        let slides = [0, 1].map(|k| turns[k] - bracket.tr_mul(&of.rows[k]));
        let mut by_rate = Matrix6::zeros();
        if self.impulses.is_empty() {
            for (row, slide) in of.rows.iter().zip(&slides) {
                by_place += row * slide.transpose() / self.contact.creep;
                by_rate += row * row.transpose() / self.contact.creep;
            }
        }
        self.frames.add_derivatives(&of.motion, &wrench, (&by_place, &by_rate), out);
        let columns = self.frames.columns(&of.motion);
        let size = out.size();
        for (j, columns) in columns.iter().enumerate() {
            for k in 0..self.impulses.len() {
                let by_place = slides[k].transpose() * columns;
                let by_rate = of.rows[k].transpose() * columns;
                add_block(&mut out.stiffness, size, (12 + k, 6 * j), &by_place);
                add_block(&mut out.damping, size, (12 + k, 6 * j), &by_rate);
                add_block(&mut out.damping, size, (6 * j, 12 + k), &by_rate.transpose());
            }
        }
    }
}
