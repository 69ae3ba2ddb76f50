//! Rigid motions: exponential, logarithm, composition, and their adjoint action on twists and wrenches. Derivatives
//! of the exponential are elsewhere.

use std::ops::Mul;

use crate::pose::Pose;
use crate::{Matrix3, Matrix6, Rotation, Vector3, Vector6, skew};

/// A rigid motion, or the frame to which it moves the base frame: it maps body coordinates `X` to `position +
/// rotation X`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Rotation of the body frame.
    pub rotation: Rotation,
    /// Position of the body frame's origin \[m\].
    pub position: Vector3,
}

impl Motion {
    /// The identity.
    pub const IDENTITY: Self = Self { rotation: Rotation::IDENTITY, position: Vector3::new(0.0, 0.0, 0.0) };

    /// The identity.
    #[inline]
    pub fn identity() -> Self {
        Self::IDENTITY
    }

    /// The motion of this rotation and position.
    #[inline]
    pub fn new(rotation: Rotation, position: Vector3) -> Self {
        Self { rotation, position }
    }

    /// A translation.
    #[inline]
    pub fn translation(position: Vector3) -> Self {
        Self { rotation: Rotation::IDENTITY, position }
    }

    /// The motion reached in unit time with the constant body twist `ψ = (u; θ)`: rotation `exp(θ̃)`, position
    /// `u + b θ × u + c θ × (θ × u)`.
    #[inline]
    pub fn exponential(psi: &Vector6) -> Self {
        Pose::exponential(psi.into()).into()
    }

    /// The twist `ψ = (u; θ)` with `exp(ψ)` equal to this motion and `|θ| ≤ π` (see [`Rotation::logarithm`]):
    /// `u = x - θ × x/2 + e θ × (θ × x)`.
    #[inline]
    pub fn logarithm(&self) -> Vector6 {
        Pose::from(self).logarithm().into()
    }

    /// The inverse motion.
    #[inline]
    pub fn inverse(&self) -> Self {
        Pose::from(self).inverse().into()
    }

    /// This motion relative to `base`: `base⁻¹ self`. Exactly independent of the common position.
    #[inline]
    pub fn relative_to(&self, base: &Self) -> Self {
        Pose::from(self).relative_to(base.into()).into()
    }

    /// The position `x + R X` of the body point `X`.
    #[inline]
    pub fn transform_point(&self, point: &Vector3) -> Vector3 {
        self.position + self.rotation.apply(point)
    }

    /// The body coordinates `Rᵀ (y - x)` of the position `y`.
    #[inline]
    pub fn inverse_transform_point(&self, place: &Vector3) -> Vector3 {
        self.rotation.apply_inverse(&(place - self.position))
    }

    /// `Ad_H = [[R, x̃R], [0, R]]`: maps body twists to the base frame.
    #[inline]
    pub fn adjoint(&self) -> Matrix6 {
        let rotation: Matrix3 = self.rotation.matrix();
        let mut matrix = Matrix6::zeros();
        matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&rotation);
        matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&(skew(&self.position) * rotation));
        matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&rotation);
        matrix
    }

    /// `Ad_H v` of the body twist `v`: `(R u + x × R θ; R θ)`.
    #[inline]
    pub fn adjoint_times(&self, twist: &Vector6) -> Vector6 {
        Pose::from(self).adjoint_times(twist.into()).into()
    }

    /// `Ad_H⁻¹ v` of the base twist `v`: `(Rᵀ (u - x × θ); Rᵀ θ)`.
    #[inline]
    pub fn adjoint_inverse_times(&self, twist: &Vector6) -> Vector6 {
        Pose::from(self).adjoint_inverse_times(twist.into()).into()
    }

    /// `Ad_Hᵀ w` of the base wrench `w = (n; m)`: the same wrench in the body frame, `(Rᵀ n; Rᵀ (m - x × n))`.
    #[inline]
    pub fn adjoint_transpose_times(&self, wrench: &Vector6) -> Vector6 {
        Pose::from(self).adjoint_transpose_times(wrench.into()).into()
    }

    /// `Ad_H⁻ᵀ w` of the body wrench `w = (n; m)`: the same wrench in the base frame, `(R n; R m + x × R n)`.
    #[inline]
    pub fn adjoint_inverse_transpose_times(&self, wrench: &Vector6) -> Vector6 {
        Pose::from(self).adjoint_inverse_transpose_times(wrench.into()).into()
    }
}

impl From<&Motion> for Pose<f64> {
    #[inline]
    fn from(motion: &Motion) -> Self {
        Self::new((&motion.rotation).into(), (&motion.position).into())
    }
}

impl From<Pose<f64>> for Motion {
    #[inline]
    fn from(pose: Pose<f64>) -> Self {
        Self { rotation: pose.rotation.into(), position: pose.position.into() }
    }
}

impl Default for Motion {
    #[inline]
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Mul for Motion {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        (Pose::from(&self) * Pose::from(&other)).into()
    }
}
