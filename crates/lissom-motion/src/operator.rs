//! The operator `I + β d̃ + γ d̃²` over dual numbers, with `β`, `γ` functions of `q = d·d`, and its derivatives. It
//! applies to any functions `β` and `γ`: the tangent, its inverse and their transposes all have this form.
//!
//! Legend: `d` argument, `a` vector acted upon, `w` vector (or wrench) contracted with the result, `p = d × a`,
//! `r = d × (d × a) = d (d·a) - q a`. The transpose has `-β` in place of `β`.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::ops::Neg;

use crate::coefficients::{exponential_coefficients, inverse_coefficients};
use crate::dual::{Dual, DualMatrix, DualVector};
use crate::real::Real;

/// The coefficients `β` of `d̃` and `γ` of `d̃²`, or one of their derivatives with respect to `q`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair<R> {
    pub(crate) linear: Dual<R>,
    pub(crate) quadratic: Dual<R>,
}

impl<R: Real> Pair<R> {
    /// A function given by value and slope at the real part of `q`, extended to the dual number: `f(q₀ + ε q₁) =
    /// f(q₀) + ε q₁ f'(q₀)`.
    #[inline(always)]
    fn lift(value: [R; 2], slope: [R; 2], q: Dual<R>) -> Self {
        Self {
            linear: Dual::new(value[0], slope[0] * q.dual),
            quadratic: Dual::new(value[1], slope[1] * q.dual),
        }
    }

    /// The coefficients of `T`, `q = d·d`.
    #[inline(always)]
    pub(crate) fn of_tangent(q: Dual<R>) -> Self {
        let [value] = tangent_pairs::<R, 2, 1>(q);
        value
    }

    /// The coefficients of `T⁻¹`.
    #[inline(always)]
    pub(crate) fn of_inverse(q: Dual<R>) -> Self {
        let [value] = inverse_pairs::<R, 2, 1>(q);
        value
    }

    /// The coefficients of the transposed operator.
    #[inline(always)]
    pub(crate) fn transposed(self) -> Self {
        Self { linear: self.linear.neg(), quadratic: self.quadratic }
    }
}

/// The coefficients of `T = I - b d̃ + c d̃²` and their derivatives with respect to `q = d·d`.
#[inline(always)]
pub(crate) fn tangent_pairs<R: Real, const ORDERS: usize, const PAIRS: usize>(
    q: Dual<R>,
) -> [Pair<R>; PAIRS] {
    const { assert!(ORDERS == PAIRS + 1, "a dual value takes one derivative more") };
    let mut k = exponential_coefficients::<R, ORDERS>(q.real);
    for m in 0..ORDERS {
        k[m][0] = -k[m][0];
    }
    let mut pairs = [Pair::lift(k[0], k[1], q); PAIRS];
    for m in 1..PAIRS {
        pairs[m] = Pair::lift(k[m], k[m + 1], q);
    }
    pairs
}

/// The coefficients of `T⁻¹ = I + d̃/2 + e d̃²` and their derivatives with respect to `q = d·d`.
#[inline(always)]
pub(crate) fn inverse_pairs<R: Real, const ORDERS: usize, const PAIRS: usize>(
    q: Dual<R>,
) -> [Pair<R>; PAIRS] {
    const { assert!(ORDERS == PAIRS + 1, "a dual value takes one derivative more") };
    let e = inverse_coefficients::<R, ORDERS>(q.real);
    let zero = q.real.like(0.0);
    let mut pairs = [Pair::lift([q.real.like(0.5), e[0]], [zero, e[1]], q); PAIRS];
    for m in 1..PAIRS {
        pairs[m] = Pair::lift([zero, e[m]], [zero, e[m + 1]], q);
    }
    pairs
}

/// `I + β d̃ + γ d̃²`.
#[inline(always)]
pub(crate) fn matrix<R: Real>(d: DualVector<R>, value: Pair<R>) -> DualMatrix<R> {
    let one = Dual::new(d.real.x.like(1.0), d.real.x.like(0.0));
    let diagonal = one - value.quadratic * d.dot(d);
    DualMatrix::diagonal(diagonal)
        + DualMatrix::skew(d) * value.linear
        + DualMatrix::outer(d, d) * value.quadratic
}

/// `a + β p + γ r`.
#[inline(always)]
pub(crate) fn times<R: Real>(d: DualVector<R>, value: Pair<R>, a: DualVector<R>) -> DualVector<R> {
    let p = d.cross(a);
    let r = d.cross(p);
    a.plus_scaled(p, value.linear).plus_scaled(r, value.quadratic)
}

/// `a + half p + γ r` with `half` 1/2 for `T⁻¹` and -1/2 for its transpose, and `γ = e`.
#[inline(always)]
pub(crate) fn inverse_times<R: Real>(
    d: DualVector<R>,
    half: f64,
    quadratic: Dual<R>,
    a: DualVector<R>,
) -> DualVector<R> {
    let p = d.cross(a);
    (a + p.scaled(half)).plus_scaled(d.cross(p), quadratic)
}

/// The derivative of `a + β p + γ r` by `d`:
/// `-β ã + γ [(d·a) I + d aᵀ - 2 a dᵀ] + 2 (β' p + γ' r) dᵀ`.
#[inline(always)]
pub(crate) fn derivative<R: Real>(
    d: DualVector<R>,
    value: Pair<R>,
    slope: Pair<R>,
    a: DualVector<R>,
) -> DualMatrix<R> {
    let p = d.cross(a);
    let r = d.cross(p);
    let column = p * slope.linear + r * slope.quadratic - a * value.quadratic;
    DualMatrix::diagonal(value.quadratic * d.dot(a)) - DualMatrix::skew(a * value.linear)
        + DualMatrix::outer(d * value.quadratic, a)
        + DualMatrix::outer(column.scaled(2.0), d)
}

/// The derivative of [`times`] by `d`, applied to `rate`.
#[inline(always)]
pub(crate) fn derivative_times<R: Real>(
    d: DualVector<R>,
    value: Pair<R>,
    slope: Pair<R>,
    a: DualVector<R>,
    rate: DualVector<R>,
) -> DualVector<R> {
    let p = d.cross(a);
    let r = d.cross(p);
    let p_rate = rate.cross(a);
    let r_rate = rate.cross(p) + d.cross(p_rate);
    let along = (p * slope.linear).plus_scaled(r, slope.quadratic);
    (p_rate * value.linear).plus_scaled(r_rate, value.quadratic).plus_scaled(along, d.dot(rate).scaled(2.0))
}

/// The rate of [`matrix`] as `d` changes at `rate`, with `q̇ = 2 d·ḋ`, `β̇ = β' q̇`, `γ̇ = γ' q̇`:
/// `-(γ̇ q + γ q̇) I + (β ḋ + β̇ d)~ + γ (ḋ dᵀ + d ḋᵀ) + γ̇ d dᵀ`.
#[inline(always)]
pub(crate) fn matrix_rate<R: Real>(
    d: DualVector<R>,
    value: Pair<R>,
    slope: Pair<R>,
    rate: DualVector<R>,
) -> DualMatrix<R> {
    let q_rate = d.dot(rate).scaled(2.0);
    let (linear, quadratic) = (slope.linear * q_rate, slope.quadratic * q_rate);
    let diagonal = quadratic * d.dot(d) + value.quadratic * q_rate;
    let along = (rate * value.quadratic).plus_scaled(d, quadratic);
    DualMatrix::skew((rate * value.linear).plus_scaled(d, linear)) - DualMatrix::diagonal(diagonal)
        + DualMatrix::outer(along, d)
        + DualMatrix::outer(d * value.quadratic, rate)
}

/// The rate of [`derivative`] as `d` changes at `rate` and `a` does not change:
/// `-(β̇ a)~ + (γ̇ d·a + γ ḋ·a) I + (γ ḋ + γ̇ d) aᵀ + 2 (ċ dᵀ + c ḋᵀ)`, `c = β' p + γ' r - γ a`.
#[inline(always)]
pub(crate) fn derivative_rate<R: Real>(
    d: DualVector<R>,
    [value, slope, bend]: [Pair<R>; 3],
    a: DualVector<R>,
    rate: DualVector<R>,
) -> DualMatrix<R> {
    let q_rate = d.dot(rate).scaled(2.0);
    let (linear, quadratic) = (slope.linear * q_rate, slope.quadratic * q_rate);
    let p = d.cross(a);
    let r = d.cross(p);
    let p_rate = rate.cross(a);
    let r_rate = rate.cross(p) + d.cross(p_rate);
    let column = p * slope.linear + r * slope.quadratic - a * value.quadratic;
    let column_rate = (p_rate * slope.linear)
        .plus_scaled(p, bend.linear * q_rate)
        .plus_scaled(r_rate, slope.quadratic)
        .plus_scaled(r, bend.quadratic * q_rate)
        - a * quadratic;
    DualMatrix::diagonal(quadratic * d.dot(a) + value.quadratic * rate.dot(a)) - DualMatrix::skew(a * linear)
        + DualMatrix::outer((rate * value.quadratic).plus_scaled(d, quadratic), a)
        + DualMatrix::outer(column_rate.scaled(2.0), d)
        + DualMatrix::outer(column.scaled(2.0), rate)
}

/// The gradient of `w·(a + β p + γ r)` by `d`:
/// `β a × w + γ [w (d·a) + a (d·w) - 2 d (a·w)] + 2 d (β' w·p + γ' w·r)`.
#[inline(always)]
pub(crate) fn gradient<R: Real>(
    d: DualVector<R>,
    value: Pair<R>,
    slope: Pair<R>,
    a: DualVector<R>,
    w: DualVector<R>,
) -> DualVector<R> {
    let g = a.cross(w);
    let (d_a, d_w, a_w, q) = (d.dot(a), d.dot(w), a.dot(w), d.dot(d));
    let w_p = d.dot(g);
    let w_r = (d_a * d_w).minus_product(q, a_w);
    let along_d = (w_p * slope.linear).plus_product(w_r, slope.quadratic).minus_product(a_w, value.quadratic);
    (g * value.linear)
        .plus_scaled((w * d_a).plus_scaled(a, d_w), value.quadratic)
        .plus_scaled(d, along_d.scaled(2.0))
}

/// The Hessian of `w·(a + β p + γ r)` by `d`. With `g = a × w`, `s = w·p = d·g`, `k = w·r`,
/// `∇k = w (d·a) + a (d·w) - 2 d (a·w)`:
/// `γ (w aᵀ + a wᵀ) + (2 β' s + 2 γ' k - 2 γ a·w) I + h dᵀ + d hᵀ + (4 β'' s + 4 γ'' k) d dᵀ`,
/// `h = 2 β' g + 2 γ' ∇k`.
#[inline(always)]
pub(crate) fn hessian<R: Real>(
    d: DualVector<R>,
    [value, slope, bend]: [Pair<R>; 3],
    a: DualVector<R>,
    w: DualVector<R>,
) -> DualMatrix<R> {
    let g = a.cross(w);
    let (d_a, d_w, a_w, q) = (d.dot(a), d.dot(w), a.dot(w), d.dot(d));
    let s = d.dot(g);
    let k = d_a * d_w - q * a_w;
    let k_gradient = w * d_a + a * d_w - d * a_w.scaled(2.0);
    let diagonal = (s * slope.linear + k * slope.quadratic - a_w * value.quadratic).scaled(2.0);
    let square = (s * bend.linear + k * bend.quadratic).scaled(2.0);
    let h = (g * slope.linear + k_gradient * slope.quadratic).scaled(2.0) + d * square;
    let scaled_a = a * value.quadratic;
    // Symmetric: the sum of an outer product and its transpose, twice.
    let half = DualMatrix::outer(w, scaled_a) + DualMatrix::outer(h, d);
    DualMatrix::diagonal(diagonal) + half + half.transposed()
}
