//! The tangent operator `T(d)` of the exponential, its inverse, and the derivatives of both.
//! Selects coefficients and packs twists and wrenches; the formulas are in `operator`.
//!
//! `T = I - b d̃ + c d̃²` and `T⁻¹ = I + d̃/2 + e d̃²` with `d` the rotation vector for SO(3), and the twist as a dual
//! vector for SE(3).

use crate::dual::DualVector;
use crate::operator::{self, Pair};
use crate::screw::Screw;
use crate::screw_operators::{CurvedTangent, TangentOperator};
use crate::triple::Triple;
use crate::{Matrix3, Matrix6, Vector3, Vector6};

#[inline]
fn twist(v: &Vector6) -> DualVector<f64> {
    DualVector::from_twist(v.into())
}

#[inline]
fn wrench(w: &Vector6) -> DualVector<f64> {
    DualVector::from_wrench(w.into())
}

/// The tangent operator at one twist, or its inverse, with all coefficients computed once for several uses.
#[derive(Clone, Copy, Debug)]
pub struct ScrewTangent(TangentOperator<f64>);

impl ScrewTangent {
    /// `T(d)` at the twist `d`.
    #[inline]
    pub fn new(d: &Vector6) -> Self {
        Self(TangentOperator::new(d.into()))
    }

    /// `T(d)⁻¹` at the twist `d`, `|θ| < 2π`; all methods then refer to the inverse.
    #[inline]
    pub fn inverse(d: &Vector6) -> Self {
        Self(TangentOperator::inverse(d.into()))
    }

    /// The 6 x 6 matrix `T`.
    #[inline]
    pub fn matrix(&self) -> Matrix6 {
        self.0.matrix().to_twist_matrix()
    }

    /// `T a` of a twist `a`.
    #[inline]
    pub fn times(&self, a: &Vector6) -> Vector6 {
        self.0.times(a.into()).into()
    }

    /// `Tᵀ w` of a wrench `w`.
    #[inline]
    pub fn transpose_times(&self, w: &Vector6) -> Vector6 {
        self.0.transpose_times(w.into()).into()
    }

    /// `∂(T a)/∂d`.
    #[inline]
    pub fn derivative(&self, a: &Vector6) -> Matrix6 {
        self.0.derivative(a.into()).to_twist_matrix()
    }

    /// `(∂(T a)/∂d)ᵀ w`, the gradient of the power `wᵀ T a` by `d`, without the matrix.
    #[inline]
    pub fn derivative_transpose_times(&self, a: &Vector6, w: &Vector6) -> Vector6 {
        self.0.derivative_transpose_times(a.into(), w.into()).into()
    }

    /// `∂(Tᵀ w)/∂d`: rows (force; moment), columns (translation; rotation); not symmetric.
    #[inline]
    pub fn transpose_derivative(&self, w: &Vector6) -> Matrix6 {
        self.0.transpose_derivative(w.into()).to_wrench_matrix()
    }

    /// `Ṫ a = (∂(T a)/∂d) ḋ`.
    #[inline]
    pub fn rate_times(&self, d_rate: &Vector6, a: &Vector6) -> Vector6 {
        self.0.rate_times(d_rate.into(), a.into()).into()
    }
}

#[inline]
fn rotation_argument(theta: &Vector3) -> DualVector<f64> {
    DualVector { real: theta.into(), dual: Triple::new(0.0, 0.0, 0.0) }
}

/// `T(θ)` of SO(3): `vee(exp(θ̃)ᵀ δexp(θ̃)) = T(θ) δθ`.
#[inline]
pub fn rotation_tangent(theta: &Vector3) -> Matrix3 {
    let d = rotation_argument(theta);
    operator::matrix(d, Pair::of_tangent(d.dot(d))).real.into()
}

/// `T(θ)⁻¹` of SO(3), `|θ| < 2π`.
#[inline]
pub fn rotation_inverse_tangent(theta: &Vector3) -> Matrix3 {
    let d = rotation_argument(theta);
    operator::matrix(d, Pair::of_inverse(d.dot(d))).real.into()
}

/// `T(d)` of SE(3): `vee(exp(d)⁻¹ δexp(d)) = T(d) δd`.
#[inline]
pub fn tangent(d: &Vector6) -> Matrix6 {
    let d = twist(d);
    operator::matrix(d, Pair::of_tangent(d.dot(d))).to_twist_matrix()
}

/// `T(d)⁻¹`, `|θ| < 2π`.
#[inline]
pub fn inverse_tangent(d: &Vector6) -> Matrix6 {
    let d = twist(d);
    operator::matrix(d, Pair::of_inverse(d.dot(d))).to_twist_matrix()
}

/// `T(d) a` of a twist `a`.
#[inline]
pub fn tangent_times(d: &Vector6, a: &Vector6) -> Vector6 {
    Screw::from(d).tangent_times(a.into()).into()
}

/// `T(d)⁻¹ a` of a twist `a`, `|θ| < 2π`.
#[inline]
pub fn inverse_tangent_times(d: &Vector6, a: &Vector6) -> Vector6 {
    Screw::from(d).inverse_tangent_times(a.into()).into()
}

/// `T(d)ᵀ w` of a wrench `w`.
#[inline]
pub fn tangent_transpose_times(d: &Vector6, w: &Vector6) -> Vector6 {
    Screw::from(d).tangent_transpose_times(w.into()).into()
}

/// `T(d)⁻ᵀ w` of a wrench `w`, `|θ| < 2π`.
#[inline]
pub fn inverse_tangent_transpose_times(d: &Vector6, w: &Vector6) -> Vector6 {
    Screw::from(d).inverse_tangent_transpose_times(w.into()).into()
}

/// `∂(T(d) a)/∂d`.
#[inline]
pub fn tangent_derivative(d: &Vector6, a: &Vector6) -> Matrix6 {
    ScrewTangent::new(d).derivative(a)
}

/// `(∂(T(d) a)/∂d)ᵀ w` without the matrix.
#[inline]
pub fn tangent_derivative_transpose_times(d: &Vector6, a: &Vector6, w: &Vector6) -> Vector6 {
    ScrewTangent::new(d).derivative_transpose_times(a, w)
}

/// `∂(T(d)ᵀ w)/∂d`.
#[inline]
pub fn tangent_transpose_derivative(d: &Vector6, w: &Vector6) -> Matrix6 {
    ScrewTangent::new(d).transpose_derivative(w)
}

/// `∂²(wᵀ T(d) a)/∂d∂d`, symmetric.
#[inline]
pub fn tangent_hessian(d: &Vector6, a: &Vector6, w: &Vector6) -> Matrix6 {
    CurvedTangent::new(d.into()).hessian(a.into(), w.into()).to_wrench_matrix()
}

/// `Ṫ a = (∂(T(d) a)/∂d) ḋ`.
#[inline]
pub fn tangent_rate_times(d: &Vector6, d_rate: &Vector6, a: &Vector6) -> Vector6 {
    ScrewTangent::new(d).rate_times(d_rate, a)
}

/// `Ṫ` as `d` changes at `d_rate`.
#[inline]
pub fn tangent_rate(d: &Vector6, d_rate: &Vector6) -> Matrix6 {
    CurvedTangent::new(d.into()).rate(d_rate.into()).to_twist_matrix()
}

/// The rate of `∂(T(d) a)/∂d` as `d` and `a` change at `d_rate` and `a_rate`.
#[inline]
pub fn tangent_derivative_rate(d: &Vector6, (a, a_rate): (&Vector6, &Vector6), d_rate: &Vector6) -> Matrix6 {
    CurvedTangent::new(d.into()).derivative_rate((a.into(), a_rate.into()), d_rate.into()).to_twist_matrix()
}

/// `∂(T(d)⁻¹ a)/∂d`, `|θ| < 2π`.
#[inline]
pub fn inverse_tangent_derivative(d: &Vector6, a: &Vector6) -> Matrix6 {
    ScrewTangent::inverse(d).derivative(a)
}

/// `(∂(T(d)⁻¹ a)/∂d)ᵀ w` without the matrix, `|θ| < 2π`.
#[inline]
pub fn inverse_tangent_derivative_transpose_times(d: &Vector6, a: &Vector6, w: &Vector6) -> Vector6 {
    ScrewTangent::inverse(d).derivative_transpose_times(a, w)
}

/// `∂(T(d)⁻ᵀ w)/∂d`, `|θ| < 2π`.
#[inline]
pub fn inverse_tangent_transpose_derivative(d: &Vector6, w: &Vector6) -> Matrix6 {
    ScrewTangent::inverse(d).transpose_derivative(w)
}

/// `∂²(wᵀ T(d)⁻¹ a)/∂d∂d`, symmetric, `|θ| < 2π`.
#[inline]
pub fn inverse_tangent_hessian(d: &Vector6, a: &Vector6, w: &Vector6) -> Matrix6 {
    let d = twist(d);
    let pairs = operator::inverse_pairs::<f64, 4, 3>(d.dot(d));
    operator::hessian(d, pairs, twist(a), wrench(w)).to_wrench_matrix()
}
