//! Rolling without sliding, a constraint of velocities: the point in which a wheel touches a plane is at rest relative to the plane.
//!
//! Legend: (R, x) tip's joint frame in the base's, V twists in the frames' own axes, A = Ad((R, x)⁻¹), η variation of the tip's
//! frame relative to the base's, b_k see `contact::wheel_on_plane`, μ_k forces of the plane that prevent sliding.
//!
//! ```text
//! b_k·(V_tip - A V_base) = 0,      forces on the tip's frame Σ μ_k b_k,   on the base's -Aᵀ Σ μ_k b_k
//! ```
//!
//! The equations hold at every stage of a scheme, so that the forces do no work there. They are not derivatives of equations of
//! positions: a wheel that has rolled round a closed path is turned.

use lissom_motion::{Matrix6, Vector6, lie_bracket_matrix};

use super::constraint::{Constraint, Level, Port};
use super::evaluation_point::Increments;
use super::frame_pair::{FramePair, RelativeMotion};
use crate::kinematics::local_derivatives::add_block;
use crate::kinematics::{CarriedFrame, Kinematics, Quantity};
use crate::wheels::wheel_on_plane::{Contact, DIRECTIONS};

/// Names of the equations.
pub const EQUATIONS: [&str; DIRECTIONS] = ["rolling along the first axis", "rolling along the second axis"];

/// A wheel that rolls on a plane.
#[derive(Debug)]
pub struct NoSlip {
    name: String,
    frames: FramePair,
    contact: Contact,
    first_multiplier: usize,
}

impl NoSlip {
    /// Between the frames of the joint of this name.
    pub fn new(name: String, frames: [CarriedFrame; 2], contact: Contact, first_multiplier: usize) -> Self {
        Self { name, frames: FramePair::new(frames), contact, first_multiplier }
    }

    /// Wrench of the plane on the tip in the tip's joint frame [N, N m], for the two multipliers.
    pub(crate) fn wrench(&self, at: &Kinematics, multipliers: &[f64]) -> Vector6 {
        -self.of(&self.frames.motion(at), multipliers)
    }

    /// Σ μ_k b_k.
    fn of(&self, motion: &RelativeMotion, multipliers: &[f64]) -> Vector6 {
        let rows = self.contact.rows(&motion.rotation, 0.0);
        rows.iter().zip(multipliers).map(|(row, mu)| *mu * row).sum()
    }

    /// ∂(Σ μ_k b_k)/∂η, and the rows ∂(b_k·η̇)/∂η.
    fn derivatives(
        &self,
        motion: &RelativeMotion,
        multipliers: [f64; DIRECTIONS],
    ) -> (Matrix6, [Vector6; DIRECTIONS]) {
        let still = (0.0, &Vector6::zeros());
        let (by_place, turns) =
            self.contact.derivatives(&motion.rotation, still, &multipliers, &motion.twist);
        // δ(b_k·η̇) with δη̇ = -ad(A V_base) η.
        let bracket = lie_bracket_matrix(&motion.carried);
        let rows = self.contact.rows(&motion.rotation, 0.0);
        (by_place, std::array::from_fn(|k| turns[k] - bracket.tr_mul(&rows[k])))
    }

    /// Rows with respect to η as rows with respect to the twelve local unknowns of base and tip.
    fn add_rows(&self, motion: &RelativeMotion, rows: &[Vector6; DIRECTIONS], out: &mut [f64]) {
        for (j, columns) in self.frames.columns(motion).iter().enumerate() {
            for (k, row) in rows.iter().enumerate() {
                add_block(out, 12, (k, 6 * j), &(row.transpose() * columns));
            }
        }
    }
}

impl Constraint for NoSlip {
    fn name(&self) -> &str {
        &self.name
    }

    fn level(&self) -> Level {
        Level::Velocity
    }

    fn first_multiplier(&self) -> usize {
        self.first_multiplier
    }

    fn equations(&self) -> usize {
        DIRECTIONS
    }

    fn quantity(&self, _equation: usize) -> Quantity {
        Quantity::Length
    }

    fn ports(&self) -> usize {
        self.frames.nodes.len()
    }

    fn port(&self, _arrangement: usize, index: usize) -> Port {
        Port::Node(self.frames.nodes[index])
    }

    fn violation(&self, _at: &Kinematics, out: &mut [f64]) {
        out.fill(0.0);
    }

    fn violation_change(&self, _increments: &Increments<'_>, _time_elapsed: (f64, f64), out: &mut [f64]) {
        out.fill(0.0);
    }

    fn gradient(&self, at: &Kinematics, out: &mut [f64]) {
        let motion = self.frames.motion(at);
        self.add_rows(&motion, &self.contact.rows(&motion.rotation, 0.0), out);
    }

    fn constraint_hessian(&self, at: &Kinematics, multipliers: &[f64], out: &mut [f64]) {
        let motion = self.frames.motion(at);
        let forces = [multipliers[0], multipliers[1]];
        let (by_place, _) = self.derivatives(&motion, forces);
        self.frames.add_stiffness(&motion, (&self.of(&motion, &forces), &by_place), (12, out));
    }

    fn rate_derivatives(&self, at: &Kinematics, out: &mut [f64]) {
        let motion = self.frames.motion(at);
        let (_, slides) = self.derivatives(&motion, [0.0; DIRECTIONS]);
        self.add_rows(&motion, &slides, out);
    }

    fn acceleration(&self, at: &Kinematics, out: &mut [f64]) {
        let mut rows = [0.0; DIRECTIONS * 12];
        self.rate_derivatives(at, &mut rows);
        let twists = self.frames.nodes.map(|node| at.nodes[node].twist);
        for (value, row) in out.iter_mut().zip(rows.chunks_exact(12)) {
            *value = row
                .iter()
                .zip(twists.iter().flat_map(|twist| twist.iter()))
                .map(|(by, rate)| by * rate)
                .sum();
        }
    }
}
