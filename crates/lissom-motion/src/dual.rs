//! Dual numbers `a + ε b` with `ε² = 0`, and vectors and matrices of them.
//! A twist `(u; θ)` is the dual vector `θ + ε u`, a wrench `(n; m)` the dual vector `n + ε m`. Independent of
//! rotations and the exponential.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::ops::{Add, Mul, Neg, Sub};

use crate::real::Real;
use crate::screw::Screw;
use crate::square::Square;
use crate::triple::Triple;
use crate::{Matrix3, Matrix6};

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

/// The matrix `real + ε dual` of dual numbers. As the twist matrix `[[A, B], [0, A]]` of `A + ε B` it maps twists to
/// twists, as the wrench matrix `[[0, A], [A, B]]` twists to wrenches.
#[derive(Clone, Copy, Debug)]
pub struct DualMatrix<R> {
    pub(crate) real: Square<R>,
    pub(crate) dual: Square<R>,
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

impl<R: Real> DualMatrix<R> {
    #[inline(always)]
    pub(crate) fn diagonal(value: Dual<R>) -> Self {
        Self { real: Square::diagonal(value.real), dual: Square::diagonal(value.dual) }
    }

    #[inline(always)]
    pub(crate) fn skew(v: DualVector<R>) -> Self {
        Self { real: Square::skew(v.real), dual: Square::skew(v.dual) }
    }

    /// `a bᵀ`.
    #[inline(always)]
    pub(crate) fn outer(a: DualVector<R>, b: DualVector<R>) -> Self {
        Self {
            real: Square::outer(a.real, b.real),
            dual: Square::outer(a.real, b.dual) + Square::outer(a.dual, b.real),
        }
    }

    /// The wrench matrix `X(W)` with `ad_Vᵀ W = X(W) V` of the wrench `w`.
    #[inline(always)]
    pub fn coadjoint(w: Screw<R>) -> Self {
        Self::skew(DualVector::from_wrench(w))
    }

    /// The twist matrix `ad_V` of the twist `v`.
    #[inline(always)]
    pub fn lie_bracket(v: Screw<R>) -> Self {
        Self::skew(DualVector::from_twist(v))
    }

    /// `self factor`.
    #[inline(always)]
    pub fn scaled_by(self, factor: R) -> Self {
        Self { real: self.real * factor, dual: self.dual * factor }
    }

    /// `self + m factor`.
    #[inline(always)]
    pub fn plus_scaled(self, m: Self, factor: R) -> Self {
        Self { real: self.real.plus_scaled(m.real, factor), dual: self.dual.plus_scaled(m.dual, factor) }
    }

    /// The transpose as a matrix of dual numbers; for a wrench matrix also its transpose.
    #[inline(always)]
    pub fn transposed(self) -> Self {
        Self { real: self.real.transposed(), dual: self.dual.transposed() }
    }

    /// `wᵀ M` of a wrench `w` and this twist matrix: a row of six, as `Mᵀ w` is a column.
    #[inline(always)]
    pub fn transpose_times(self, w: Screw<R>) -> Screw<R> {
        Screw::new(
            self.real.transpose_times(w.translation),
            self.dual.transpose_times(w.translation) + self.real.transpose_times(w.rotation),
        )
    }

    /// `W M` of a 6 x 6 matrix given by its rows and this twist matrix.
    #[inline(always)]
    pub fn times_from_right(self, rows: &[Screw<R>; 6]) -> [Screw<R>; 6] {
        let mut result = *rows;
        for i in 0..6 {
            result[i] = self.transpose_times(rows[i]);
        }
        result
    }

    /// `Mᵀ W` of this twist matrix and a 6 x 6 matrix given by its rows.
    #[inline(always)]
    pub fn transpose_times_rows(self, rows: &[Screw<R>; 6]) -> [Screw<R>; 6] {
        let (a, b) = (self.real.transposed(), self.dual.transposed());
        let mut result = *rows;
        for i in 0..3 {
            let Triple { x, y, z } = a.rows[i];
            result[i] = (rows[0] * x).plus_scaled(rows[1], y).plus_scaled(rows[2], z);
            result[3 + i] = (rows[3] * x).plus_scaled(rows[4], y).plus_scaled(rows[5], z);
            let Triple { x, y, z } = b.rows[i];
            result[3 + i] =
                result[3 + i].plus_scaled(rows[0], x).plus_scaled(rows[1], y).plus_scaled(rows[2], z);
        }
        result
    }

    /// Adds this wrench matrix to a 6 x 6 matrix given by its rows.
    #[inline(always)]
    pub fn add_to(self, rows: &mut [Screw<R>; 6]) {
        for i in 0..3 {
            rows[i].rotation = rows[i].rotation + self.real.rows[i];
            rows[3 + i].translation = rows[3 + i].translation + self.real.rows[i];
            rows[3 + i].rotation = rows[3 + i].rotation + self.dual.rows[i];
        }
    }
}

impl DualMatrix<f64> {
    /// The 6 x 6 matrix from twists to twists: `[[A, B], [0, A]]` of `A + ε B`.
    #[inline]
    pub(crate) fn to_twist_matrix(self) -> Matrix6 {
        let (real, dual) = (Matrix3::from(self.real), Matrix3::from(self.dual));
        let mut matrix = Matrix6::zeros();
        matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&real);
        matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&dual);
        matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&real);
        matrix
    }

    /// The 6 x 6 matrix from twists to wrenches: `[[0, A], [A, B]]` of `A + ε B`.
    #[inline]
    pub(crate) fn to_wrench_matrix(self) -> Matrix6 {
        let (real, dual) = (Matrix3::from(self.real), Matrix3::from(self.dual));
        let mut matrix = Matrix6::zeros();
        matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&real);
        matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(&real);
        matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&dual);
        matrix
    }
}

macro_rules! linear_operations {
    ($kind:ident) => {
        impl<R: Real> Add for $kind<R> {
            type Output = Self;
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                Self { real: self.real + other.real, dual: self.dual + other.dual }
            }
        }
        impl<R: Real> Sub for $kind<R> {
            type Output = Self;
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                Self { real: self.real - other.real, dual: self.dual - other.dual }
            }
        }
        impl<R: Real> Neg for $kind<R> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self { real: -self.real, dual: -self.dual }
            }
        }
        impl<R: Real> Mul<Dual<R>> for $kind<R> {
            type Output = Self;
            #[inline(always)]
            fn mul(self, factor: Dual<R>) -> Self {
                Self {
                    real: self.real * factor.real,
                    dual: self.dual * factor.real + self.real * factor.dual,
                }
            }
        }
    };
}

linear_operations!(Dual);
linear_operations!(DualVector);
linear_operations!(DualMatrix);
