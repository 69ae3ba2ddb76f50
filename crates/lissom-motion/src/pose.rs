//! Rigid motions over any [`Real`]: exponential, logarithm, composition and adjoint action. Derivatives of the
//! exponential are elsewhere.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::ops::Mul;

use crate::coefficients::{HalfAngle, exponential_values, inverse_coefficients};
use crate::dual::DualMatrix;
use crate::real::Real;
use crate::screw::Screw;
use crate::screw_operators::InverseTangent;
use crate::square::Square;
use crate::triple::Triple;
use crate::versor::Versor;

/// A rigid motion, see [`crate::Motion`].
#[derive(Clone, Copy, Debug)]
pub struct Pose<R> {
    /// Rotation of the body frame.
    pub rotation: Versor<R>,
    /// Position of the body frame's origin \[m\].
    pub position: Triple<R>,
}

impl<R: Real> Pose<R> {
    /// From both parts.
    #[inline(always)]
    pub fn new(rotation: Versor<R>, position: Triple<R>) -> Self {
        Self { rotation, position }
    }

    /// From the quaternion, scalar part first, and the position.
    #[inline(always)]
    pub fn from_components(components: [R; 7]) -> Self {
        let [scalar, a, b, c, x, y, z] = components;
        Self::new(Versor { scalar, vector: Triple::new(a, b, c) }, Triple::new(x, y, z))
    }

    /// The quaternion, scalar part first, and the position.
    #[inline(always)]
    pub fn components(self) -> [R; 7] {
        let (v, p) = (self.rotation.vector, self.position);
        [self.rotation.scalar, v.x, v.y, v.z, p.x, p.y, p.z]
    }

    /// The motion reached in unit time with the constant body twist `ψ`: rotation `exp(θ̃)`, position
    /// `u + b θ × u + c θ × (θ × u)`.
    #[inline(always)]
    pub fn exponential(psi: Screw<R>) -> Self {
        let Screw { translation: u, rotation: theta } = psi;
        let q = theta.norm_squared();
        let half = HalfAngle::from_square(q);
        let [b, c] = exponential_values(q, half);
        Self { rotation: Versor::from_half_angle(theta, half), position: stretch(u, theta, b, c) }
    }

    /// The twist `ψ = (u; θ)` with `exp(ψ)` equal to this motion and `|θ| ≤ π`:
    /// `u = x - θ × x/2 + e θ × (θ × x)`.
    #[inline(always)]
    pub fn logarithm(self) -> Screw<R> {
        let theta = self.rotation.logarithm();
        let q = theta.norm_squared();
        let [e] = inverse_coefficients::<R, 1>(q);
        Screw::new(stretch(self.position, theta, q.like(-0.5), e), theta)
    }

    /// The logarithm `d` and `T(d)⁻¹`.
    #[inline(always)]
    pub fn logarithm_and_inverse_tangent(self) -> (Screw<R>, InverseTangent<R>) {
        let theta = self.rotation.logarithm();
        let q = theta.norm_squared();
        let coefficients = inverse_coefficients::<R, 2>(q);
        let d = Screw::new(stretch(self.position, theta, q.like(-0.5), coefficients[0]), theta);
        (d, InverseTangent::with_coefficients(d, coefficients))
    }

    /// The inverse motion.
    #[inline(always)]
    pub fn inverse(self) -> Self {
        Self { rotation: self.rotation.inverse(), position: -self.rotation.apply_inverse(self.position) }
    }

    /// This motion relative to `base`: `base⁻¹ self`. Exactly independent of the common position.
    #[inline(always)]
    pub fn relative_to(self, base: Self) -> Self {
        Self {
            rotation: base.rotation.inverse() * self.rotation,
            position: base.rotation.apply_inverse(self.position - base.position),
        }
    }

    /// `Ad_H v` of the body twist `v`: `(R u + x × R θ; R θ)`.
    #[inline(always)]
    pub fn adjoint_times(self, twist: Screw<R>) -> Screw<R> {
        let theta = self.rotation.apply(twist.rotation);
        Screw::new(self.rotation.apply(twist.translation).plus_cross(self.position, theta), theta)
    }

    /// `Ad_H⁻¹ v` of the base twist `v`: `(Rᵀ (u - x × θ); Rᵀ θ)`.
    #[inline(always)]
    pub fn adjoint_inverse_times(self, twist: Screw<R>) -> Screw<R> {
        let Screw { translation: u, rotation: theta } = twist;
        Screw::new(
            self.rotation.apply_inverse(u.plus_cross(theta, self.position)),
            self.rotation.apply_inverse(theta),
        )
    }

    /// `Ad_H⁻¹ v - v`, without cancellation for small motions.
    #[inline(always)]
    pub fn adjoint_inverse_gain(self, twist: Screw<R>) -> Screw<R> {
        let Screw { translation: u, rotation: theta } = twist;
        let carried = theta.cross(self.position);
        Screw::new(
            self.rotation.apply_inverse_gain(u + carried) + carried,
            self.rotation.apply_inverse_gain(theta),
        )
    }

    /// The twist matrix `Ad_H⁻¹ = [[Rᵀ, -Rᵀx̃], [0, Rᵀ]]`: maps base twists to the body frame.
    #[inline(always)]
    pub fn adjoint_inverse(self) -> DualMatrix<R> {
        let one = Square::diagonal(self.position.x.like(1.0));
        let turned = Square { rows: self.rotation.minus_identity_rows() } + one;
        let real = turned.transposed();
        DualMatrix { real, dual: -real.times(Square::skew(self.position)) }
    }

    /// `Ad_Hᵀ w` of the base wrench `w = (n; m)`: `(Rᵀ n; Rᵀ (m - x × n))`.
    #[inline(always)]
    pub fn adjoint_transpose_times(self, wrench: Screw<R>) -> Screw<R> {
        let Screw { translation: n, rotation: m } = wrench;
        Screw::new(
            self.rotation.apply_inverse(n),
            self.rotation.apply_inverse(m.plus_cross(n, self.position)),
        )
    }

    /// `Ad_H⁻ᵀ w` of the body wrench `w = (n; m)`: `(R n; R m + x × R n)`.
    #[inline(always)]
    pub fn adjoint_inverse_transpose_times(self, wrench: Screw<R>) -> Screw<R> {
        let n = self.rotation.apply(wrench.translation);
        Screw::new(n, self.rotation.apply(wrench.rotation).plus_cross(self.position, n))
    }
}

/// `v + β θ × v + γ θ × (θ × v)`.
#[inline(always)]
pub(crate) fn stretch<R: Real>(v: Triple<R>, theta: Triple<R>, beta: R, gamma: R) -> Triple<R> {
    let p = theta.cross(v);
    v.plus_scaled(p, beta).plus_scaled(theta.cross(p), gamma)
}

impl<R: Real> Mul for Pose<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self {
            rotation: self.rotation * other.rotation,
            position: self.position + self.rotation.apply(other.position),
        }
    }
}
