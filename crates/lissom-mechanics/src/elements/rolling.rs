//! Creep of a rolling wheel: the plane opposes sliding by forces proportional to the sliding velocity.
//!
//! Legend: (R, x) tip's joint frame in the base's, V twists in the frames' own axes, A = Ad((R, x)⁻¹), η variation of the tip's
//! frame relative to the base's, b_k see `contact::wheel_on_plane`, c creep.
//!
//! ```text
//! f_k = b_k·(V_tip - A V_base)/c,      forces on the tip's frame Σ f_k b_k,   on the base's -Aᵀ Σ f_k b_k
//! ```
//!
//! Without creep the wheel does not slide, see `joints::no_slip`.

use lissom_motion::{Matrix6, Vector6, lie_bracket_matrix};

use super::{Element, Tangents, Unknowns};
use crate::joints::frame_pair::{FramePair, RelativeMotion};
use crate::kinematics::{CarriedFrame, Kinematics};
use crate::wheels::wheel_on_plane::{Contact, DIRECTIONS};

/// A wheel that creeps on a plane.
#[derive(Clone, Debug)]
pub struct RollingCreep {
    frames: FramePair,
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

impl RollingCreep {
    /// Between a joint's frames.
    pub fn new(frames: [CarriedFrame; 2], contact: Contact) -> Self {
        Self { frames: FramePair::new(frames), contact }
    }

    fn rolled(&self, at: &Kinematics) -> Rolled {
        let motion = self.frames.motion(at);
        let rows = self.contact.rows(&motion.rotation, 0.0);
        let forces = rows.map(|row| row.dot(&motion.twist) / self.contact.creep);
        Rolled { motion, rows, forces }
    }

    /// Wrench of the plane on the tip in the tip's joint frame, which opposes sliding [N, N m].
    pub fn wrench(&self, at: &Kinematics) -> Vector6 {
        -self.rolled(at).wrench()
    }
}

impl Element for RollingCreep {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.frames.nodes)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let of = self.rolled(at);
        self.frames.add_wrench(&of.motion, &of.wrench(), out);
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let of = self.rolled(at);
        let (mut by_place, turns) = self.contact.derivatives(
            &of.motion.rotation,
            (0.0, &Vector6::zeros()),
            &of.forces,
            &of.motion.twist,
        );
        // δ(b_k·η̇) with δη̇ = -ad(A V_base) η.
        let bracket = lie_bracket_matrix(&of.motion.carried);
        let mut by_rate = Matrix6::zeros();
        for (row, turn) in of.rows.iter().zip(&turns) {
            let slide = turn - bracket.tr_mul(row);
            by_place += row * slide.transpose() / self.contact.creep;
            by_rate += row * row.transpose() / self.contact.creep;
        }
        let size = out.size();
        self.frames.add_stiffness(&of.motion, (&of.wrench(), &by_place), (size, &mut out.stiffness));
        self.frames.add_damping(&of.motion, &by_rate, (size, &mut out.damping));
    }
}
