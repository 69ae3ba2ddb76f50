//! Rigid motions: exponential, logarithm, composition, and their adjoint action on twists and wrenches.
//! Knows no derivative of the exponential.

use std::ops::Mul;

use crate::coefficients::{HalfAngle, exponential_values, inverse_coefficients};
use crate::{Matrix3, Matrix6, Rotation, Vector3, Vector6, rotation_part, screw, skew, translation_part};

/// A rigid motion, or the frame it moves the base frame to: body coordinates `X` go to `position + rotation X`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Rotation of the body frame.
    pub rotation: Rotation,
    /// Position of the body frame's origin \[m\].
    pub position: Vector3,
}

impl Motion {
    /// No motion.
    pub const IDENTITY: Self = Self { rotation: Rotation::IDENTITY, position: Vector3::new(0.0, 0.0, 0.0) };

    /// No motion.
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
        let (u, theta) = (translation_part(psi), rotation_part(psi));
        let q = theta.norm_squared();
        let half = HalfAngle::from_square(q);
        let [b, c] = exponential_values(q, half);
        Self { rotation: Rotation::from_half_angle(&theta, half), position: stretch(&u, &theta, b, c) }
    }

    /// The twist `ψ = (u; θ)` with `exp(ψ)` equal to this motion and `|θ| ≤ π` (see [`Rotation::logarithm`]):
    /// `u = x - θ × x/2 + e θ × (θ × x)`.
    #[inline]
    pub fn logarithm(&self) -> Vector6 {
        let theta = self.rotation.logarithm();
        let [e] = inverse_coefficients::<1>(theta.norm_squared());
        screw(&stretch(&self.position, &theta, -0.5, e), &theta)
    }

    /// The motion back.
    #[inline]
    pub fn inverse(&self) -> Self {
        Self { rotation: self.rotation.inverse(), position: -self.rotation.apply_inverse(&self.position) }
    }

    /// This motion as seen from `base`: `base⁻¹ self`. Exactly free of the common position.
    #[inline]
    pub fn relative_to(&self, base: &Self) -> Self {
        Self {
            rotation: base.rotation.inverse() * self.rotation,
            position: base.rotation.apply_inverse(&(self.position - base.position)),
        }
    }

    /// The place `x + R X` of the body point `X`.
    #[inline]
    pub fn transform_point(&self, point: &Vector3) -> Vector3 {
        self.position + self.rotation.apply(point)
    }

    /// The body coordinates `Rᵀ (y - x)` of the place `y`.
    #[inline]
    pub fn inverse_transform_point(&self, place: &Vector3) -> Vector3 {
        self.rotation.apply_inverse(&(place - self.position))
    }

    /// The displacement `(exp(ψ) - I) X` of the body point `X` by the increment `ψ`, in the body frame before the
    /// increment; accurate relative to `u + θ × X` for the smallest `ψ`.
    #[inline]
    pub fn displacement_of_point(psi: &Vector6, point: &Vector3) -> Vector3 {
        let (u, theta) = (translation_part(psi), rotation_part(psi));
        let q = theta.norm_squared();
        let [b, c] = exponential_values(q, HalfAngle::from_square(q));
        stretch(&(u + theta.cross(point)), &theta, b, c)
    }

    /// `Ad_H = [[R, x̃R], [0, R]]`: takes body twists to the base frame.
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
        let theta = self.rotation.apply(&rotation_part(twist));
        let u = self.rotation.apply(&translation_part(twist)) + self.position.cross(&theta);
        screw(&u, &theta)
    }

    /// `Ad_H⁻¹ v` of the base twist `v`: `(Rᵀ (u - x × θ); Rᵀ θ)`.
    #[inline]
    pub fn adjoint_inverse_times(&self, twist: &Vector6) -> Vector6 {
        let (u, theta) = (translation_part(twist), rotation_part(twist));
        screw(
            &self.rotation.apply_inverse(&(u - self.position.cross(&theta))),
            &self.rotation.apply_inverse(&theta),
        )
    }

    /// `Ad_Hᵀ w` of the base wrench `w = (n; m)`: the same wrench in the body frame, `(Rᵀ n; Rᵀ (m - x × n))`.
    #[inline]
    pub fn adjoint_transpose_times(&self, wrench: &Vector6) -> Vector6 {
        let (n, m) = (translation_part(wrench), rotation_part(wrench));
        screw(&self.rotation.apply_inverse(&n), &self.rotation.apply_inverse(&(m - self.position.cross(&n))))
    }

    /// `Ad_H⁻ᵀ w` of the body wrench `w = (n; m)`: the same wrench in the base frame, `(R n; R m + x × R n)`.
    #[inline]
    pub fn adjoint_inverse_transpose_times(&self, wrench: &Vector6) -> Vector6 {
        let n = self.rotation.apply(&translation_part(wrench));
        let m = self.rotation.apply(&rotation_part(wrench)) + self.position.cross(&n);
        screw(&n, &m)
    }
}

/// `v + β θ × v + γ θ × (θ × v)`.
#[inline]
fn stretch(v: &Vector3, theta: &Vector3, beta: f64, gamma: f64) -> Vector3 {
    let p = theta.cross(v);
    v + p * beta + theta.cross(&p) * gamma
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
        Self {
            rotation: self.rotation * other.rotation,
            position: self.position + self.rotation.apply(&other.position),
        }
    }
}
