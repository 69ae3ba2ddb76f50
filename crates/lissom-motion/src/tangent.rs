//! The tangent operator `T(d)` of the exponential, its inverse, and the derivatives of both.
//! Chooses coefficients and packs twists and wrenches; the formulas stand in `operator`.
//!
//! `T = I - b d̃ + c d̃²` and `T⁻¹ = I + d̃/2 + e d̃²` with `d` the rotation vector for SO(3), and the twist read as a
//! dual vector for SE(3).

use crate::coefficients::{exponential_coefficients, inverse_coefficients};
use crate::dual::{Dual, DualVector};
use crate::operator::{self, Pair};
use crate::{Matrix3, Matrix6, Vector3, Vector6};

#[inline]
fn tangent_pairs<const ORDERS: usize, const PAIRS: usize>(q: Dual) -> [Pair; PAIRS] {
    const { assert!(ORDERS == PAIRS + 1, "a dual value takes one derivative more") };
    let k = exponential_coefficients::<ORDERS>(q.real).map(|[b, c]| [-b, c]);
    std::array::from_fn(|m| Pair::lift(k[m], k[m + 1], q))
}

#[inline]
fn inverse_pairs<const ORDERS: usize, const PAIRS: usize>(q: Dual) -> [Pair; PAIRS] {
    const { assert!(ORDERS == PAIRS + 1, "a dual value takes one derivative more") };
    let e = inverse_coefficients::<ORDERS>(q.real);
    let linear = |m: usize| if m == 0 { 0.5 } else { 0.0 };
    std::array::from_fn(|m| Pair::lift([linear(m), e[m]], [0.0, e[m + 1]], q))
}

#[inline]
fn tangent_value(d: DualVector) -> Pair {
    let [value] = tangent_pairs::<2, 1>(d.dot(d));
    value
}

#[inline]
fn inverse_value(d: DualVector) -> Pair {
    let [value] = inverse_pairs::<2, 1>(d.dot(d));
    value
}

/// The tangent operator at one twist, or its inverse, with all coefficients computed once for several uses.
#[derive(Clone, Copy, Debug)]
pub struct ScrewTangent {
    d: DualVector,
    value: Pair,
    slope: Pair,
}

impl ScrewTangent {
    /// `T(d)` at the twist `d`.
    #[inline]
    pub fn new(d: &Vector6) -> Self {
        let d = DualVector::from_twist(d);
        let [value, slope] = tangent_pairs::<3, 2>(d.dot(d));
        Self { d, value, slope }
    }

    /// `T(d)⁻¹` at the twist `d`, `|θ| < 2π`; all methods then refer to the inverse.
    #[inline]
    pub fn inverse(d: &Vector6) -> Self {
        let d = DualVector::from_twist(d);
        let [value, slope] = inverse_pairs::<3, 2>(d.dot(d));
        Self { d, value, slope }
    }

    /// The 6 x 6 matrix `T`.
    #[inline]
    pub fn matrix(&self) -> Matrix6 {
        operator::matrix(self.d, self.value).to_twist_matrix()
    }

    /// `T a` of a twist `a`.
    #[inline]
    pub fn times(&self, a: &Vector6) -> Vector6 {
        operator::times(self.d, self.value, DualVector::from_twist(a)).to_twist()
    }

    /// `Tᵀ w` of a wrench `w`.
    #[inline]
    pub fn transpose_times(&self, w: &Vector6) -> Vector6 {
        operator::times(self.d, self.value.transposed(), DualVector::from_wrench(w)).to_wrench()
    }

    /// `∂(T a)/∂d`.
    #[inline]
    pub fn derivative(&self, a: &Vector6) -> Matrix6 {
        operator::derivative(self.d, self.value, self.slope, DualVector::from_twist(a)).to_twist_matrix()
    }

    /// `(∂(T a)/∂d)ᵀ w`, the gradient of the power `wᵀ T a` by `d`, without the matrix.
    #[inline]
    pub fn derivative_transpose_times(&self, a: &Vector6, w: &Vector6) -> Vector6 {
        let (a, w) = (DualVector::from_twist(a), DualVector::from_wrench(w));
        operator::gradient(self.d, self.value, self.slope, a, w).to_wrench()
    }

    /// `∂(Tᵀ w)/∂d`: rows (force; moment), columns (translation; rotation); not symmetric.
    #[inline]
    pub fn transpose_derivative(&self, w: &Vector6) -> Matrix6 {
        let (value, slope) = (self.value.transposed(), self.slope.transposed());
        operator::derivative(self.d, value, slope, DualVector::from_wrench(w)).to_wrench_matrix()
    }

    /// `Ṫ a = (∂(T a)/∂d) ḋ`.
    #[inline]
    pub fn rate_times(&self, d_rate: &Vector6, a: &Vector6) -> Vector6 {
        let (a, rate) = (DualVector::from_twist(a), DualVector::from_twist(d_rate));
        operator::derivative_times(self.d, self.value, self.slope, a, rate).to_twist()
    }
}

#[inline]
fn rotation_argument(theta: &Vector3) -> DualVector {
    DualVector { real: *theta, dual: Vector3::zeros() }
}

/// `T(θ)` of SO(3): `vee(exp(θ̃)ᵀ δexp(θ̃)) = T(θ) δθ`.
#[inline]
pub fn rotation_tangent(theta: &Vector3) -> Matrix3 {
    let d = rotation_argument(theta);
    operator::matrix(d, tangent_value(d)).real
}

/// `T(θ)⁻¹` of SO(3), `|θ| < 2π`.
#[inline]
pub fn rotation_inverse_tangent(theta: &Vector3) -> Matrix3 {
    let d = rotation_argument(theta);
    operator::matrix(d, inverse_value(d)).real
}

/// `T(d)` of SE(3): `vee(exp(d)⁻¹ δexp(d)) = T(d) δd`.
#[inline]
pub fn tangent(d: &Vector6) -> Matrix6 {
    let d = DualVector::from_twist(d);
    operator::matrix(d, tangent_value(d)).to_twist_matrix()
}

/// `T(d)⁻¹`, `|θ| < 2π`.
#[inline]
pub fn inverse_tangent(d: &Vector6) -> Matrix6 {
    let d = DualVector::from_twist(d);
    operator::matrix(d, inverse_value(d)).to_twist_matrix()
}

/// `T(d) a` of a twist `a`.
#[inline]
pub fn tangent_times(d: &Vector6, a: &Vector6) -> Vector6 {
    let d = DualVector::from_twist(d);
    operator::times(d, tangent_value(d), DualVector::from_twist(a)).to_twist()
}

/// `T(d)⁻¹ a` of a twist `a`, `|θ| < 2π`.
#[inline]
pub fn inverse_tangent_times(d: &Vector6, a: &Vector6) -> Vector6 {
    let d = DualVector::from_twist(d);
    operator::times(d, inverse_value(d), DualVector::from_twist(a)).to_twist()
}

/// `T(d)ᵀ w` of a wrench `w`.
#[inline]
pub fn tangent_transpose_times(d: &Vector6, w: &Vector6) -> Vector6 {
    let d = DualVector::from_twist(d);
    operator::times(d, tangent_value(d).transposed(), DualVector::from_wrench(w)).to_wrench()
}

/// `T(d)⁻ᵀ w` of a wrench `w`, `|θ| < 2π`.
#[inline]
pub fn inverse_tangent_transpose_times(d: &Vector6, w: &Vector6) -> Vector6 {
    let d = DualVector::from_twist(d);
    operator::times(d, inverse_value(d).transposed(), DualVector::from_wrench(w)).to_wrench()
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
    let d = DualVector::from_twist(d);
    let pairs = tangent_pairs::<4, 3>(d.dot(d));
    operator::hessian(d, pairs, DualVector::from_twist(a), DualVector::from_wrench(w)).to_wrench_matrix()
}

/// `Ṫ a = (∂(T(d) a)/∂d) ḋ`.
#[inline]
pub fn tangent_rate_times(d: &Vector6, d_rate: &Vector6, a: &Vector6) -> Vector6 {
    ScrewTangent::new(d).rate_times(d_rate, a)
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
    let d = DualVector::from_twist(d);
    let pairs = inverse_pairs::<4, 3>(d.dot(d));
    operator::hessian(d, pairs, DualVector::from_twist(a), DualVector::from_wrench(w)).to_wrench_matrix()
}
