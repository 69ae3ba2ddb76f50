//! The operator `I + β d̃ + γ d̃²` over dual numbers, with `β`, `γ` functions of `q = d·d`, and its derivatives.
//! Does not know which functions `β` and `γ` are: the tangent, its inverse and their transposes all have this form.
//!
//! Legend: `d` argument, `a` vector acted upon, `w` vector (or wrench) contracted with the result, `p = d × a`,
//! `r = d × (d × a) = d (d·a) - q a`. The transpose has `-β` in place of `β`.

use std::ops::Neg;

use crate::dual::{Dual, DualMatrix, DualVector};

/// The coefficients `β` of `d̃` and `γ` of `d̃²`, or one of their derivatives by `q`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    pub(crate) linear: Dual,
    pub(crate) quadratic: Dual,
}

impl Pair {
    /// A function known by value and slope at the real part of `q`, continued to the dual number:
    /// `f(q₀ + ε q₁) = f(q₀) + ε q₁ f'(q₀)`.
    #[inline]
    pub(crate) fn lift(value: [f64; 2], slope: [f64; 2], q: Dual) -> Self {
        Self {
            linear: Dual::new(value[0], slope[0] * q.dual),
            quadratic: Dual::new(value[1], slope[1] * q.dual),
        }
    }

    /// The coefficients of the transposed operator.
    #[inline]
    pub(crate) fn transposed(self) -> Self {
        Self { linear: self.linear.neg(), quadratic: self.quadratic }
    }
}

/// `I + β d̃ + γ d̃²`.
#[inline]
pub(crate) fn matrix(d: DualVector, value: Pair) -> DualMatrix {
    let diagonal = Dual::new(1.0, 0.0) - value.quadratic * d.dot(d);
    DualMatrix::diagonal(diagonal)
        + DualMatrix::skew(d) * value.linear
        + DualMatrix::outer(d, d) * value.quadratic
}

/// `a + β p + γ r`.
#[inline]
pub(crate) fn times(d: DualVector, value: Pair, a: DualVector) -> DualVector {
    let p = d.cross(a);
    let r = d.cross(p);
    a + p * value.linear + r * value.quadratic
}

/// The derivative of `a + β p + γ r` by `d`:
/// `-β ã + γ [(d·a) I + d aᵀ - 2 a dᵀ] + 2 (β' p + γ' r) dᵀ`.
#[inline]
pub(crate) fn derivative(d: DualVector, value: Pair, slope: Pair, a: DualVector) -> DualMatrix {
    let p = d.cross(a);
    let r = d.cross(p);
    let column = (p * slope.linear + r * slope.quadratic - a * value.quadratic) * 2.0;
    DualMatrix::diagonal(value.quadratic * d.dot(a)) - DualMatrix::skew(a * value.linear)
        + DualMatrix::outer(d * value.quadratic, a)
        + DualMatrix::outer(column, d)
}

/// The derivative of [`times`] by `d`, applied to `rate`.
#[inline]
pub(crate) fn derivative_times(
    d: DualVector,
    value: Pair,
    slope: Pair,
    a: DualVector,
    rate: DualVector,
) -> DualVector {
    let p = d.cross(a);
    let r = d.cross(p);
    let p_rate = rate.cross(a);
    let r_rate = rate.cross(p) + d.cross(p_rate);
    p_rate * value.linear
        + r_rate * value.quadratic
        + (p * slope.linear + r * slope.quadratic) * (d.dot(rate) * 2.0)
}

/// The gradient of `w·(a + β p + γ r)` by `d`:
/// `β a × w + γ [w (d·a) + a (d·w) - 2 d (a·w)] + 2 d (β' w·p + γ' w·r)`.
#[inline]
pub(crate) fn gradient(d: DualVector, value: Pair, slope: Pair, a: DualVector, w: DualVector) -> DualVector {
    let g = a.cross(w);
    let (d_a, d_w, a_w, q) = (d.dot(a), d.dot(w), a.dot(w), d.dot(d));
    let w_p = d.dot(g);
    let w_r = d_a * d_w - q * a_w;
    let along_d = w_p * slope.linear + w_r * slope.quadratic - a_w * value.quadratic;
    g * value.linear + (w * d_a + a * d_w) * value.quadratic + d * (along_d * 2.0)
}

/// The Hessian of `w·(a + β p + γ r)` by `d`. With `g = a × w`, `s = w·p = d·g`, `k = w·r`,
/// `∇k = w (d·a) + a (d·w) - 2 d (a·w)`:
/// `γ (w aᵀ + a wᵀ) + (2 β' s + 2 γ' k - 2 γ a·w) I + h dᵀ + d hᵀ + (4 β'' s + 4 γ'' k) d dᵀ`,
/// `h = 2 β' g + 2 γ' ∇k`.
#[inline]
pub(crate) fn hessian(
    d: DualVector,
    [value, slope, bend]: [Pair; 3],
    a: DualVector,
    w: DualVector,
) -> DualMatrix {
    let g = a.cross(w);
    let (d_a, d_w, a_w, q) = (d.dot(a), d.dot(w), a.dot(w), d.dot(d));
    let s = d.dot(g);
    let k = d_a * d_w - q * a_w;
    let k_gradient = w * d_a + a * d_w - d * (a_w * 2.0);
    let diagonal = (s * slope.linear + k * slope.quadratic - a_w * value.quadratic) * 2.0;
    let square = (s * bend.linear + k * bend.quadratic) * 2.0;
    let h = (g * slope.linear + k_gradient * slope.quadratic) * 2.0 + d * square;
    let (scaled_a, outer) = (a * value.quadratic, DualMatrix::outer);
    DualMatrix::diagonal(diagonal) + outer(w, scaled_a) + outer(scaled_a, w) + outer(h, d) + outer(d, h)
}
