//! Dual numbers `a + ε b` with `ε² = 0`, and vectors and matrices of them.
//! A twist `(u; θ)` is the dual vector `θ + ε u`, a wrench `(n; m)` the dual vector `n + ε m`.
//! Knows no rotation and no exponential.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::ops::{Add, Mul, Neg, Sub};

use crate::real::Real;
use crate::screw::Screw;
use crate::triple::Triple;
use crate::{Matrix3, Matrix6, Vector3, skew};

/// The scalar `real + ε dual`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dual<R> {
    pub(crate) real: R,
    pub(crate) dual: R,
}

/// The vector `real + ε dual`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DualVector<R> {
    pub(crate) real: Triple<R>,
    pub(crate) dual: Triple<R>,
}

/// The matrix `real + ε dual`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DualMatrix {
    pub(crate) real: Matrix3,
    pub(crate) dual: Matrix3,
}

impl<R: Real> Dual<R> {
    #[inline(always)]
    pub(crate) fn new(real: R, dual: R) -> Self {
        Self { real, dual }
    }

    /// `self + a b`.
    #[inline(always)]
    pub(crate) fn plus_product(self, a: Self, b: Self) -> Self {
        Self {
            real: self.real.plus_product(a.real, b.real),
            dual: self.dual.plus_product(a.real, b.dual).plus_product(a.dual, b.real),
        }
    }

    /// `self - a b`.
    #[inline(always)]
    pub(crate) fn minus_product(self, a: Self, b: Self) -> Self {
        Self {
            real: self.real.minus_product(a.real, b.real),
            dual: self.dual.minus_product(a.real, b.dual).minus_product(a.dual, b.real),
        }
    }

    #[inline(always)]
    pub(crate) fn scaled(self, factor: f64) -> Self {
        Self { real: self.real.scaled(factor), dual: self.dual.scaled(factor) }
    }
}

impl<R: Real> DualVector<R> {
    /// `θ + ε u` of the twist `(u; θ)`.
    #[inline(always)]
    pub(crate) fn from_twist(v: Screw<R>) -> Self {
        Self { real: v.rotation, dual: v.translation }
    }

    /// `n + ε m` of the wrench `(n; m)`.
    #[inline(always)]
    pub(crate) fn from_wrench(w: Screw<R>) -> Self {
        Self { real: w.translation, dual: w.rotation }
    }

    #[inline(always)]
    pub(crate) fn to_twist(self) -> Screw<R> {
        Screw::new(self.dual, self.real)
    }

    #[inline(always)]
    pub(crate) fn to_wrench(self) -> Screw<R> {
        Screw::new(self.real, self.dual)
    }

    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> Dual<R> {
        Dual::new(self.real.dot(other.real), self.real.dot(other.dual) + self.dual.dot(other.real))
    }

    #[inline(always)]
    pub(crate) fn cross(self, other: Self) -> Self {
        Self {
            real: self.real.cross(other.real),
            dual: self.real.cross(other.dual).plus_cross(self.dual, other.real),
        }
    }

    #[inline(always)]
    pub(crate) fn scaled(self, factor: f64) -> Self {
        Self { real: self.real.scaled(factor), dual: self.dual.scaled(factor) }
    }

    /// `self + v factor`.
    #[inline(always)]
    pub(crate) fn plus_scaled(self, v: Self, factor: Dual<R>) -> Self {
        Self {
            real: self.real.plus_scaled(v.real, factor.real),
            dual: self.dual.plus_scaled(v.dual, factor.real).plus_scaled(v.real, factor.dual),
        }
    }
}

impl DualMatrix {
    #[inline]
    pub(crate) fn diagonal(value: Dual<f64>) -> Self {
        Self {
            real: Matrix3::from_diagonal_element(value.real),
            dual: Matrix3::from_diagonal_element(value.dual),
        }
    }

    #[inline]
    pub(crate) fn skew(v: DualVector<f64>) -> Self {
        Self { real: skew(&v.real.into()), dual: skew(&v.dual.into()) }
    }

    /// `a bᵀ`.
    #[inline]
    pub(crate) fn outer(a: DualVector<f64>, b: DualVector<f64>) -> Self {
        let [real_a, dual_a, real_b, dual_b] = [a.real, a.dual, b.real, b.dual].map(Vector3::from);
        Self {
            real: real_a * real_b.transpose(),
            dual: real_a * dual_b.transpose() + dual_a * real_b.transpose(),
        }
    }

    /// The 6 x 6 matrix from twists to twists: `[[A, B], [0, A]]` of `A + ε B`.
    #[inline]
    pub(crate) fn to_twist_matrix(self) -> Matrix6 {
        let mut matrix = Matrix6::zeros();
        matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&self.real);
        matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&self.dual);
        matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&self.real);
        matrix
    }

    /// The 6 x 6 matrix from twists to wrenches: `[[0, A], [A, B]]` of `A + ε B`.
    #[inline]
    pub(crate) fn to_wrench_matrix(self) -> Matrix6 {
        let mut matrix = Matrix6::zeros();
        matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&self.real);
        matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(&self.real);
        matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&self.dual);
        matrix
    }
}

macro_rules! linear_operations {
    ($kind:ty, $number:ty $(, $parameter:ident)?) => {
        impl$(<$parameter: Real>)? Add for $kind {
            type Output = Self;
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                Self { real: self.real + other.real, dual: self.dual + other.dual }
            }
        }
        impl$(<$parameter: Real>)? Sub for $kind {
            type Output = Self;
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                Self { real: self.real - other.real, dual: self.dual - other.dual }
            }
        }
        impl$(<$parameter: Real>)? Neg for $kind {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self { real: -self.real, dual: -self.dual }
            }
        }
        impl$(<$parameter: Real>)? Mul<Dual<$number>> for $kind {
            type Output = Self;
            #[inline(always)]
            fn mul(self, factor: Dual<$number>) -> Self {
                Self {
                    real: self.real * factor.real,
                    dual: self.dual * factor.real + self.real * factor.dual,
                }
            }
        }
    };
}

linear_operations!(Dual<R>, R, R);
linear_operations!(DualVector<R>, R, R);
linear_operations!(DualMatrix, f64);
