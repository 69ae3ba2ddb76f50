//! The point in which a wheel touches a plane, and the velocity there.
//!
//! Legend as in [`super::rolling`], and T_k = Rᵀe_k the plane's axes in the tip's axes, p the point of contact from the
//! wheel's centre, (v, w) twist of the wheel relative to the plane, both in the tip's axes.
//!
//! ```text
//! p = r (u a - N)/S - ρ N - g N,      s_k = T_k·(v + w × p) = b_k·(v, w),      b_k = (T_k, p × T_k)
//! ∂N/∂η_θ = Ñ,      ∂p/∂N = r [(a aᵀ - I)/S + (u a - N) u aᵀ/S³] - (ρ + g) I,      ∂p/∂g = -N
//! ```
//!
//! g is the gap between wheel and plane, zero for a rigid contact. With it the point is in the plane above or below the lowest point
//! of the undeformed rim.

use lissom_motion::{Matrix3, Matrix6, Real, Vector3, Vector6, screw, skew};

use crate::kinematics::split;
use crate::round_off;

/// Directions in which the contact may slide.
pub const DIRECTIONS: usize = 2;

/// Sine S of the angle between the wheel's axis and the normal, from its cosine.
#[expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]
#[inline(always)]
pub(crate) fn upright<R: Real>(cosine: R) -> R {
    cosine.like(1.0 + round_off::SQUARE).minus_product(cosine, cosine).square_root()
}

/// A wheel on a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Axis of the wheel in the tip's joint frame.
    pub axis: Vector3,
    /// 1 if the wheel is on the side of the plane to which the base's third axis points, otherwise -1.
    pub side: f64,
    /// Radius [m].
    pub radius: f64,
    /// Radius of the rounding of the rim [m].
    pub rim: f64,
    /// Coefficient of friction; infinite if there is no limit.
    pub friction: f64,
    /// Sliding velocity per force [m/(N s)]; 0 without sliding.
    pub creep: f64,
}

/// The contact at a relative rotation, in the tip's axes.
struct Touch {
    /// N.
    normal: Vector3,
    /// T_k.
    along: [Vector3; DIRECTIONS],
    /// p [m].
    point: Vector3,
    cosine: f64,
    upright: f64,
}

impl Contact {
    fn touch(&self, rotation: &Matrix3) -> Touch {
        let row = |k: usize| rotation.row(k).transpose();
        let normal = self.side * row(2);
        let cosine = normal.dot(&self.axis);
        let upright = upright(cosine);
        let down = (cosine * self.axis - normal) / upright;
        let point = self.radius * down - self.rim * normal;
        Touch { normal, along: [row(0), row(1)], point, cosine, upright }
    }

    /// Direction from the wheel's centre to the middle of the rim at the point of contact, in the plane's axes.
    pub fn down(&self, rotation: &Matrix3) -> Vector3 {
        let Touch { normal, cosine, upright, .. } = self.touch(rotation);
        rotation * ((cosine * self.axis - normal) / upright)
    }

    /// b_k: derivatives of the sliding velocities with respect to the relative twist, in the tip's joint frame, at a gap [m].
    pub fn rows(&self, rotation: &Matrix3, gap: f64) -> [Vector6; DIRECTIONS] {
        let touch = self.touch(rotation);
        let point = touch.point - gap * touch.normal;
        touch.along.map(|along| screw(&along, &point.cross(&along)))
    }

    /// ∂(Σ f_k b_k)/∂η, and the rows ∂(b_k·(v, w))/∂η at a constant relative twist; with the gap [m] and its derivative with respect
    /// to η.
    pub fn derivatives(
        &self,
        rotation: &Matrix3,
        (gap, gap_row): (f64, &Vector6),
        forces: &[f64; DIRECTIONS],
        twist: &Vector6,
    ) -> (Matrix6, [Vector6; DIRECTIONS]) {
        let touch = self.touch(rotation);
        let (gap_by_place, gap_by_turn) = split(gap_row);
        let by_place = -touch.normal * gap_by_place.transpose();
        let by_normal = self.point_by_normal(&touch) - gap * Matrix3::identity();
        let by_turn = by_normal * skew(&touch.normal) - touch.normal * gap_by_turn.transpose();
        let force = forces[0] * touch.along[0] + forces[1] * touch.along[1];
        let arm = skew(&(touch.point - gap * touch.normal));
        let mut wrench = Matrix6::zeros();
        wrench.fixed_view_mut::<3, 3>(0, 3).copy_from(&skew(&force));
        wrench.fixed_view_mut::<3, 3>(3, 0).copy_from(&(-skew(&force) * by_place));
        let moment = arm * skew(&force) - skew(&force) * by_turn;
        wrench.fixed_view_mut::<3, 3>(3, 3).copy_from(&moment);
        let (linear, angular) = split(twist);
        let rows = touch.along.map(|along| {
            let turned = skew(&along);
            let row = turned.tr_mul(&linear) + (arm * turned - turned * by_turn).tr_mul(&angular);
            screw(&(-turned * by_place).tr_mul(&angular), &row)
        });
        (wrench, rows)
    }

    /// Gap between wheel and plane [m], and its derivative with respect to η.
    pub fn gap(&self, rotation: &Matrix3, position: &Vector3) -> (f64, Vector6) {
        let touch = self.touch(rotation);
        let gap = self.side * position.z - self.radius * touch.upright - self.rim;
        let lever = self.radius * touch.cosine / touch.upright;
        (gap, screw(&touch.normal, &(lever * self.axis.cross(&touch.normal))))
    }

    /// Second derivative of the gap with respect to η.
    pub(crate) fn gap_hessian(&self, rotation: &Matrix3) -> Matrix6 {
        let Touch { normal, cosine, upright, .. } = self.touch(rotation);
        let turned = skew(&normal);
        // d(u/S)/du = 1/S³, apart from the round-off that keeps S from vanishing.
        let slope = (1.0 + cosine * cosine / (upright * upright)) / upright;
        let tilting = slope * self.axis.cross(&normal) * (self.axis.transpose() * turned)
            + cosine / upright * skew(&self.axis) * turned;
        let mut hessian = Matrix6::zeros();
        hessian.fixed_view_mut::<3, 3>(0, 3).copy_from(&turned);
        hessian.fixed_view_mut::<3, 3>(3, 3).copy_from(&(self.radius * tilting));
        hessian
    }

    /// ∂p/∂N.
    fn point_by_normal(&self, touch: &Touch) -> Matrix3 {
        let Touch { normal, cosine, upright, .. } = touch;
        let axis = self.axis;
        let down = *cosine * axis - normal;
        let ring = (axis * axis.transpose() - Matrix3::identity()) / *upright
            + down * axis.transpose() * (cosine / upright.powi(3));
        self.radius * ring - self.rim * Matrix3::identity()
    }
}

#[cfg(test)]
#[path = "../../tests/unit/wheels/wheel_on_plane.rs"]
mod tests;
