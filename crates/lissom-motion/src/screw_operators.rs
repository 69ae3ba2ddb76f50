//! The Lie bracket and the tangent operator applied to twists and wrenches.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use crate::dual::{Dual, DualMatrix, DualVector};
use crate::operator::{self, Pair};
use crate::real::Real;
use crate::screw::Screw;
use crate::{Matrix6, Vector6};

/// The matrix `ad_V = [[θ̃, ũ], [0, θ̃]]` of the twist `V = (u; θ)`.
#[inline]
pub fn lie_bracket_matrix(v: &Vector6) -> Matrix6 {
    DualMatrix::skew(DualVector::from_twist(v.into())).to_twist_matrix()
}

/// The Lie bracket of two twists, `ad_V W = (θ_v × u_w + u_v × θ_w; θ_v × θ_w)`.
#[inline]
pub fn lie_bracket(v: &Vector6, w: &Vector6) -> Vector6 {
    Screw::from(v).lie_bracket(w.into()).into()
}

/// The coadjoint action `ad_Vᵀ W` of the twist `v` on the wrench `w = (n; m)`: `(n × θ; n × u + m × θ)`.
#[inline]
pub fn coadjoint_times(v: &Vector6, w: &Vector6) -> Vector6 {
    Screw::from(v).coadjoint_times(w.into()).into()
}

/// The matrix `X(W) = [[0, ñ], [ñ, m̃]]` of the wrench `w = (n; m)` with `ad_Vᵀ W = X(W) V`.
#[inline]
pub fn coadjoint_matrix(w: &Vector6) -> Matrix6 {
    DualMatrix::skew(DualVector::from_wrench(w.into())).to_wrench_matrix()
}

impl<R: Real> Screw<R> {
    /// The Lie bracket of two twists, `ad_V W`.
    #[inline(always)]
    pub fn lie_bracket(self, other: Self) -> Self {
        DualVector::from_twist(self).cross(DualVector::from_twist(other)).to_twist()
    }

    /// `ad_Vᵀ W` of this twist and the wrench `w`.
    #[inline(always)]
    pub fn coadjoint_times(self, w: Self) -> Self {
        DualVector::from_wrench(w).cross(DualVector::from_twist(self)).to_wrench()
    }

    /// `T(d) a` of the twists `d` (this one) and `a`.
    #[inline(always)]
    pub fn tangent_times(self, a: Self) -> Self {
        let d = DualVector::from_twist(self);
        operator::times(d, Pair::of_tangent(d.dot(d)), DualVector::from_twist(a)).to_twist()
    }

    /// `T(d)ᵀ w` of a wrench `w`.
    #[inline(always)]
    pub fn tangent_transpose_times(self, w: Self) -> Self {
        let d = DualVector::from_twist(self);
        operator::times(d, Pair::of_tangent(d.dot(d)).transposed(), DualVector::from_wrench(w)).to_wrench()
    }

    /// `T(d)⁻¹ a` of a twist `a`, `|θ| < 2π`.
    #[inline(always)]
    pub fn inverse_tangent_times(self, a: Self) -> Self {
        InverseTangent::new(self).times(a)
    }

    /// `T(d)⁻ᵀ w` of a wrench `w`, `|θ| < 2π`.
    #[inline(always)]
    pub fn inverse_tangent_transpose_times(self, w: Self) -> Self {
        InverseTangent::new(self).transpose_times(w)
    }
}

/// `T(d)`, or its inverse, at one twist, with all coefficients computed once for several uses.
#[derive(Clone, Copy, Debug)]
pub struct TangentOperator<R> {
    pub(crate) d: DualVector<R>,
    pub(crate) value: Pair<R>,
    pub(crate) slope: Pair<R>,
}

impl<R: Real> TangentOperator<R> {
    /// `T(d)` at the twist `d`.
    #[inline(always)]
    pub fn new(d: Screw<R>) -> Self {
        let d = DualVector::from_twist(d);
        let [value, slope] = operator::tangent_pairs::<R, 3, 2>(d.dot(d));
        Self { d, value, slope }
    }

    /// `T(d)⁻¹` at the twist `d`, `|θ| < 2π`; all methods then refer to the inverse.
    #[inline(always)]
    pub fn inverse(d: Screw<R>) -> Self {
        let d = DualVector::from_twist(d);
        let [value, slope] = operator::inverse_pairs::<R, 3, 2>(d.dot(d));
        Self { d, value, slope }
    }

    /// `T a` of a twist `a`.
    #[inline(always)]
    pub fn times(&self, a: Screw<R>) -> Screw<R> {
        operator::times(self.d, self.value, DualVector::from_twist(a)).to_twist()
    }

    /// `Tᵀ w` of a wrench `w`.
    #[inline(always)]
    pub fn transpose_times(&self, w: Screw<R>) -> Screw<R> {
        operator::times(self.d, self.value.transposed(), DualVector::from_wrench(w)).to_wrench()
    }

    /// `(∂(T a)/∂d)ᵀ w`, the gradient of the power `wᵀ T a` by `d`.
    #[inline(always)]
    pub fn derivative_transpose_times(&self, a: Screw<R>, w: Screw<R>) -> Screw<R> {
        let (a, w) = (DualVector::from_twist(a), DualVector::from_wrench(w));
        operator::gradient(self.d, self.value, self.slope, a, w).to_wrench()
    }

    /// `Ṫ a = (∂(T a)/∂d) ḋ`.
    #[inline(always)]
    pub fn rate_times(&self, d_rate: Screw<R>, a: Screw<R>) -> Screw<R> {
        let (a, rate) = (DualVector::from_twist(a), DualVector::from_twist(d_rate));
        operator::derivative_times(self.d, self.value, self.slope, a, rate).to_twist()
    }
}

impl<R: Real> TangentOperator<R> {
    /// The twist matrix `T`.
    #[inline(always)]
    pub fn matrix(&self) -> DualMatrix<R> {
        operator::matrix(self.d, self.value)
    }

    /// The twist matrix `∂(T a)/∂d`.
    #[inline(always)]
    pub fn derivative(&self, a: Screw<R>) -> DualMatrix<R> {
        operator::derivative(self.d, self.value, self.slope, DualVector::from_twist(a))
    }

    /// The wrench matrix `∂(Tᵀ w)/∂d`.
    #[inline(always)]
    pub fn transpose_derivative(&self, w: Screw<R>) -> DualMatrix<R> {
        let (value, slope) = (self.value.transposed(), self.slope.transposed());
        operator::derivative(self.d, value, slope, DualVector::from_wrench(w))
    }
}

/// The operator of [`TangentOperator::new`], and second derivatives.
#[derive(Clone, Copy, Debug)]
pub struct CurvedTangent<R> {
    /// The operator `T(d)`.
    pub operator: TangentOperator<R>,
    bend: Pair<R>,
}

impl<R: Real> CurvedTangent<R> {
    /// `T(d)` at the twist `d`.
    #[inline(always)]
    pub fn new(d: Screw<R>) -> Self {
        let d = DualVector::from_twist(d);
        let [value, slope, bend] = operator::tangent_pairs::<R, 4, 3>(d.dot(d));
        Self { operator: TangentOperator { d, value, slope }, bend }
    }

    /// The symmetric wrench matrix `∂²(wᵀ T a)/∂d∂d`.
    #[inline(always)]
    pub fn hessian(&self, a: Screw<R>, w: Screw<R>) -> DualMatrix<R> {
        let TangentOperator { d, value, slope } = self.operator;
        let (a, w) = (DualVector::from_twist(a), DualVector::from_wrench(w));
        operator::hessian(d, [value, slope, self.bend], a, w)
    }

    /// The twist matrix `Ṫ` as `d` changes at `d_rate`.
    #[inline(always)]
    pub fn rate(&self, d_rate: Screw<R>) -> DualMatrix<R> {
        let TangentOperator { d, value, slope } = self.operator;
        operator::matrix_rate(d, value, slope, DualVector::from_twist(d_rate))
    }

    /// The rate of the twist matrix `∂(T a)/∂d` as `d` and `a` change at `d_rate` and `a_rate`.
    #[inline(always)]
    pub fn derivative_rate(&self, (a, a_rate): (Screw<R>, Screw<R>), d_rate: Screw<R>) -> DualMatrix<R> {
        let TangentOperator { d, value, slope } = self.operator;
        let (fixed, rate) = (DualVector::from_twist(a), DualVector::from_twist(d_rate));
        operator::derivative_rate(d, [value, slope, self.bend], fixed, rate)
            + self.operator.derivative(a_rate)
    }
}

/// `T(d)⁻¹` at one twist, `|θ| < 2π`, for products only.
#[derive(Clone, Copy, Debug)]
pub struct InverseTangent<R> {
    d: DualVector<R>,
    quadratic: Dual<R>,
}

impl<R: Real> InverseTangent<R> {
    /// At the twist `d`.
    #[inline(always)]
    pub fn new(d: Screw<R>) -> Self {
        let d = DualVector::from_twist(d);
        Self { d, quadratic: Pair::of_inverse(d.dot(d)).quadratic }
    }

    /// At the twist `d`, with given `e` and its derivative with respect to `θ²`.
    #[inline(always)]
    pub(crate) fn with_coefficients(d: Screw<R>, [e, slope]: [R; 2]) -> Self {
        let d = DualVector::from_twist(d);
        Self { d, quadratic: Dual::new(e, slope * d.dot(d).dual) }
    }

    /// `T⁻¹ a` of a twist `a`.
    #[inline(always)]
    pub fn times(&self, a: Screw<R>) -> Screw<R> {
        operator::inverse_times(self.d, 0.5, self.quadratic, DualVector::from_twist(a)).to_twist()
    }

    /// `T⁻ᵀ w` of a wrench `w`.
    #[inline(always)]
    pub fn transpose_times(&self, w: Screw<R>) -> Screw<R> {
        operator::inverse_times(self.d, -0.5, self.quadratic, DualVector::from_wrench(w)).to_wrench()
    }
}
