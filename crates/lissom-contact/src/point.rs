//! A point at which two solids may touch, and the motion there with its derivatives. It knows neither laws nor how contacts are solved.
//!
//! Legend: g gap, n normal and p point of contact in the axes of the base's solid, see [`geometry::gap`](crate::geometry::gap); (R, x)
//! tip's frame in the base's, d = Rᵀ(p - x); (v, ω) relative twist in the tip's axes, c = v + ω × d, u = R c velocity of the tip's
//! point, s = u - n (n·u) sliding velocity, of a surface that moves along itself at w with u - w on the base and u + R w on the tip in the
//! place of u; f force on the tip in the base's axes; η variation of the tip's frame.
//!
//! ```text
//! wrench on the tip's frame:  (Rᵀ f, d × Rᵀ f)
//! δd = Rᵀδp - η_v + d × η_θ,      δu = R (δc - c × η_θ),      δ(Rᵀf) = Rᵀδf + Rᵀf × η_θ
//! at fixed twists of the nodes:   δη̇ = -ad(A V_base) η
//! ```

use std::sync::Arc;

use lissom_motion::{
    Matrix3, Matrix6, Vector3, Vector6, lie_bracket_matrix, rotation_part, screw, skew, translation_part,
};
use nalgebra::RowVector6;

use lissom_mechanics::compliance::Compliance;
use lissom_mechanics::joints::frame_pair::{FramePair, RelativeMotion};
use lissom_mechanics::kinematics::{CarriedFrame, Kinematics};
use lissom_mechanics::law::VisitLaw;

use crate::force_over_gap::ForceOverGap;
use crate::geometry::gap::{Gap, MAX_ARGUMENTS, Matrix3x6, Pair, side_by_side};

/// A point at which two solids may touch: their frames, base and tip, and the gap.
#[derive(Clone, Debug)]
pub(crate) struct ContactPoint {
    pub(crate) frames: FramePair,
    pub(crate) pair: Arc<dyn Pair>,
    pub(crate) surface: Option<MovingSurface>,
}

/// A surface of one of both solids that moves along itself, as that of a belt.
#[derive(Clone, Copy, Debug)]
pub struct MovingSurface {
    /// Whether it is the tip's.
    pub is_tip: bool,
    /// w [m/s], in the axes of the frame of its solid.
    pub velocity: Vector3,
}

/// Motion at the point of contact.
pub struct PointMotion {
    pub(crate) relative: RelativeMotion,
    /// The gap.
    pub gap: Gap,
    /// d [m].
    pub(crate) arm: Vector3,
    /// c, in the tip's axes.
    carried: Vector3,
    /// u [m/s], base's axes.
    pub velocity: Vector3,
    surface: Option<MovingSurface>,
}

impl ContactPoint {
    pub(crate) fn new(frames: [CarriedFrame; 2], pair: Arc<dyn Pair>) -> Self {
        Self { frames: FramePair::new(frames), pair, surface: None }
    }

    pub(crate) fn motion(&self, at: &Kinematics) -> PointMotion {
        let relative = self.frames.motion(at);
        let gap = self.pair.gap(&relative.position, &relative.rotation);
        let arm = relative.rotation.tr_mul(&(gap.point - relative.position));
        let carried = translation_part(&relative.twist) + rotation_part(&relative.twist).cross(&arm);
        let velocity = relative.rotation * carried;
        PointMotion { relative, gap, arm, carried, velocity, surface: self.surface }
    }

    /// Gap [m].
    pub(crate) fn gap(&self, at: &Kinematics) -> f64 {
        let relative = self.frames.relative(at);
        self.pair.value(&relative.position, &relative.rotation.matrix())
    }

    /// Passes the force over the gap as a law.
    pub(crate) fn laws(&self, compliance: Compliance, at: &Kinematics, visit: &mut VisitLaw<'_>) {
        let relative = self.frames.relative(at);
        let mut arguments = [0.0; MAX_ARGUMENTS];
        let (x, rotation) = arguments.split_at_mut(3);
        x.copy_from_slice(relative.position.as_slice());
        rotation.copy_from_slice(relative.rotation.matrix().as_slice());
        let law = ForceOverGap { gap: &*self.pair, compliance };
        visit(&law, &arguments[..self.pair.arguments()]);
    }

    /// Adds the forces of a force on the tip, on the left-hand side, to those on both nodes.
    pub(crate) fn add_force(&self, motion: &PointMotion, force: &Vector3, out: &mut [f64]) {
        self.frames.add_wrench(&motion.relative, &-motion.wrench(force), out);
    }

    /// Adds their derivatives to local matrices with rows of `size`, by those of the force in the base's axes with respect to η and η̇.
    pub(crate) fn add_derivatives(
        &self,
        motion: &PointMotion,
        (force, by): (&Vector3, &[Matrix3x6; 2]),
        (size, stiffness, damping): (usize, &mut [f64], &mut [f64]),
    ) {
        let wrench = -motion.wrench(force);
        let by_place = -motion.wrench_by(force, &by[0], true);
        self.frames.add_stiffness(&motion.relative, (&wrench, &by_place), (size, stiffness));
        let by_rate = -motion.wrench_by(force, &by[1], false);
        self.frames.add_damping(&motion.relative, &by_rate, (size, damping));
    }
}

impl PointMotion {
    /// n·u [m/s].
    pub fn rate(&self) -> f64 {
        self.gap.normal.dot(&self.velocity)
    }

    /// s [m/s].
    pub fn sliding(&self) -> Vector3 {
        let velocity = self.velocity - self.driven();
        velocity - self.gap.normal * self.gap.normal.dot(&velocity)
    }

    /// Velocity that a moving surface gives a point that sticks to it, base's axes [m/s]: w, or -R w.
    pub(crate) fn driven(&self) -> Vector3 {
        match &self.surface {
            None => Vector3::zeros(),
            Some(MovingSurface { is_tip: false, velocity }) => *velocity,
            Some(MovingSurface { velocity, .. }) => -self.relative.rotation * velocity,
        }
    }

    /// The wrench on the tip's frame of a force on the tip.
    pub(crate) fn wrench(&self, force: &Vector3) -> Vector6 {
        let local = self.relative.rotation.tr_mul(force);
        screw(&local, &self.arm.cross(&local))
    }

    /// ∂d/∂η.
    fn arm_by(&self) -> Matrix3x6 {
        self.relative.rotation.transpose() * self.gap.point_by
            + side_by_side(&-Matrix3::identity(), &skew(&self.arm))
    }

    /// ∂u/∂η̇.
    pub(crate) fn velocity_by_twist(&self) -> Matrix3x6 {
        self.relative.rotation * side_by_side(&Matrix3::identity(), &-skew(&self.arm))
    }

    /// ∂u/∂η at fixed twists of the nodes.
    pub(crate) fn velocity_by_place(&self) -> Matrix3x6 {
        let by_twist = side_by_side(&Matrix3::identity(), &-skew(&self.arm));
        let bracket = lie_bracket_matrix(&self.relative.carried);
        let carried_by = -by_twist * bracket + skew(&rotation_part(&self.relative.twist)) * self.arm_by();
        let turned = side_by_side(&Matrix3::zeros(), &skew(&self.carried));
        self.relative.rotation * (carried_by - turned)
    }

    /// ∂g/∂η.
    pub(crate) fn gap_by(&self) -> RowVector6<f64> {
        self.wrench(&self.gap.normal).transpose()
    }

    /// ∂u/∂η and ∂u/∂η̇.
    pub(crate) fn velocity_by(&self) -> [Matrix3x6; 2] {
        [self.velocity_by_place(), self.velocity_by_twist()]
    }

    /// ∂(n·u)/∂η and ∂(n·u)/∂η̇, by those of u.
    pub(crate) fn rate_by(&self, velocity_by: &[Matrix3x6; 2]) -> [RowVector6<f64>; 2] {
        let [mut by_place, by_rate] = velocity_by.map(|by| self.gap.normal.transpose() * by);
        by_place += self.velocity.transpose() * self.gap.normal_by;
        [by_place, by_rate]
    }

    /// ∂s/∂η and ∂s/∂η̇, by those of u.
    pub(crate) fn sliding_by(&self, velocity_by: &[Matrix3x6; 2]) -> [Matrix3x6; 2] {
        let Gap { normal: n, normal_by, .. } = &self.gap;
        let across = Matrix3::identity() - n * n.transpose();
        let [mut by_place, by_rate] = velocity_by.map(|by| across * by);
        let velocity = self.velocity - self.driven();
        by_place = by_place - n.dot(&velocity) * normal_by - n * (velocity.transpose() * normal_by);
        if let Some(MovingSurface { is_tip: true, velocity }) = &self.surface {
            by_place -= across * self.relative.rotation * side_by_side(&Matrix3::zeros(), &skew(velocity));
        }
        [by_place, by_rate]
    }

    /// Derivative of the wrench of a force on the tip with respect to a variation, by that of the force in the base's axes; `moves`: with
    /// respect to η.
    pub(crate) fn wrench_by(&self, force: &Vector3, force_by: &Matrix3x6, moves: bool) -> Matrix6 {
        let rotation = &self.relative.rotation;
        let local = rotation.tr_mul(force);
        let mut local_by = rotation.transpose() * force_by;
        let mut arm_by = Matrix3x6::zeros();
        if moves {
            local_by += side_by_side(&Matrix3::zeros(), &skew(&local));
            arm_by = self.arm_by();
        }
        let mut both = Matrix6::zeros();
        both.fixed_rows_mut::<3>(0).copy_from(&local_by);
        both.fixed_rows_mut::<3>(3).copy_from(&(skew(&self.arm) * local_by - skew(&local) * arm_by));
        both
    }
}
