//! Two frames fixed to nodes, and the forces on the nodes from their relative motion.
//!
//! Legend: (R, x) tip's frame in the base's, A = Ad((R, x)⁻¹), V twists in the frames' own axes, η variation of the tip's frame
//! relative to the base's, w a wrench on the tip's frame.
//!
//! ```text
//! η = ξ_tip - A ξ_base,      wrench on the base's frame -Aᵀ w,      δ(Aᵀ w) = Aᵀ (δw - ad(η)ᵀ w)
//! ```

use lissom_motion::{Matrix3, Matrix6, Motion, Vector3, Vector6, rotation_part, skew, translation_part};

use crate::kinematics::local_derivatives::add_block;
use crate::kinematics::{CarriedFrame, Kinematics, NodeId};

/// Base's and tip's frame.
#[derive(Clone, Copy, Debug)]
pub struct FramePair {
    /// Nodes of base and tip.
    pub nodes: [NodeId; 2],
    pub(crate) frames: [CarriedFrame; 2],
}

/// Relative motion of the two frames.
pub struct RelativeMotion {
    /// A.
    to_tip: Matrix6,
    /// (R, x).
    pub(crate) relative: Motion,
    /// Rotation matrix of the tip in the base.
    pub rotation: Matrix3,
    /// x [m].
    pub position: Vector3,
    /// V_tip - A V_base.
    pub twist: Vector6,
    /// A V_base.
    pub carried: Vector6,
}

impl FramePair {
    /// Pair of the frames of base and tip.
    pub fn new(frames: [CarriedFrame; 2]) -> Self {
        Self { nodes: frames.map(|frame| frame.node), frames }
    }

    /// (R, x).
    pub fn relative(&self, at: &Kinematics) -> Motion {
        let [base, tip] = self.frames.map(|frame| frame.frame(at));
        tip.relative_to(&base)
    }

    /// Relative motion at a configuration.
    pub fn motion(&self, at: &Kinematics) -> RelativeMotion {
        let twists = self.frames.map(|frame| frame.offset.adjoint_inverse_times(&at.nodes[frame.node].twist));
        let relative = self.relative(at);
        let to_tip = relative.inverse().adjoint();
        let carried = to_tip * twists[0];
        RelativeMotion {
            to_tip,
            relative,
            rotation: relative.rotation.matrix(),
            position: relative.position,
            twist: twists[1] - carried,
            carried,
        }
    }

    /// From the axes of the base's frame to global ones.
    pub fn base_rotation(&self, at: &Kinematics) -> Matrix3 {
        (at.nodes[self.nodes[0]].frame.rotation * self.frames[0].offset.rotation).matrix()
    }

    /// The base's frame in the inertial frame.
    pub fn base_frame(&self, at: &Kinematics) -> Motion {
        self.frames[0].frame(at)
    }

    /// Inverse Ad of the frames' offsets: from variations of the nodes to those of the frames.
    fn carry(&self) -> [Matrix6; 2] {
        self.frames.map(|frame| frame.offset.inverse().adjoint())
    }

    /// Derivatives of η with respect to variations of base and tip.
    pub fn columns(&self, motion: &RelativeMotion) -> [Matrix6; 2] {
        let carry = self.carry();
        [-motion.to_tip * carry[0], carry[1]]
    }

    /// Adds the forces on both nodes from a wrench on the tip's frame and the opposite one on the base's.
    pub fn add_wrench(&self, motion: &RelativeMotion, wrench: &Vector6, out: &mut [f64]) {
        let carry = self.carry();
        let on = [carry[0].tr_mul(&-motion.to_tip.tr_mul(wrench)), carry[1].tr_mul(wrench)];
        for (out, value) in out.iter_mut().zip(on.iter().flat_map(|wrench| wrench.iter())) {
            *out += value;
        }
    }

    /// Adds their derivatives with respect to variations of the nodes, from those of the wrench with respect to η, to a local
    /// matrix with rows of `size`.
    pub fn add_stiffness(
        &self,
        motion: &RelativeMotion,
        (wrench, by_place): (&Vector6, &Matrix6),
        (size, out): (usize, &mut [f64]),
    ) {
        // ad(η)ᵀ w as a matrix on η.
        let mut coadjoint = Matrix6::zeros();
        let (force, moment) = (skew(&translation_part(wrench)), skew(&rotation_part(wrench)));
        coadjoint.fixed_view_mut::<3, 3>(0, 3).copy_from(&force);
        coadjoint.fixed_view_mut::<3, 3>(3, 0).copy_from(&force);
        coadjoint.fixed_view_mut::<3, 3>(3, 3).copy_from(&moment);
        let (carry, columns) = (self.carry(), self.columns(motion));
        let rows_of = [
            carry[0].transpose() * motion.to_tip.transpose() * (coadjoint - by_place),
            carry[1].transpose() * by_place,
        ];
        for (j, column) in columns.iter().enumerate() {
            for (i, rows) in rows_of.iter().enumerate() {
                add_block(out, size, (6 * i, 6 * j), &(rows * column));
            }
        }
    }

    /// Adds their derivatives with respect to twists of the nodes, from those of the wrench with respect to η̇, likewise.
    pub fn add_damping(&self, motion: &RelativeMotion, by_rate: &Matrix6, (size, out): (usize, &mut [f64])) {
        let columns = self.columns(motion);
        for (i, row) in columns.iter().enumerate() {
            for (j, column) in columns.iter().enumerate() {
                add_block(out, size, (6 * i, 6 * j), &(row.transpose() * by_rate * column));
            }
        }
    }
}
