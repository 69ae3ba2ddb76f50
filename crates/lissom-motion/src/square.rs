//! 3 x 3 matrices over any [`Real`].
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::ops::{Add, Mul, Neg, Sub};

use crate::Matrix3;
use crate::real::Real;
use crate::triple::Triple;

/// A 3 x 3 matrix.
#[derive(Clone, Copy, Debug)]
pub struct Square<R> {
    /// Rows.
    pub rows: [Triple<R>; 3],
}

impl<R: Real> Square<R> {
    /// `value` on the diagonal.
    #[inline(always)]
    pub fn diagonal(value: R) -> Self {
        let zero = value.like(0.0);
        Self {
            rows: [
                Triple::new(value, zero, zero),
                Triple::new(zero, value, zero),
                Triple::new(zero, zero, value),
            ],
        }
    }

    /// `ṽ` with `ṽ w = v × w`.
    #[inline(always)]
    pub fn skew(v: Triple<R>) -> Self {
        let zero = v.x.like(0.0);
        Self {
            rows: [Triple::new(zero, -v.z, v.y), Triple::new(v.z, zero, -v.x), Triple::new(-v.y, v.x, zero)],
        }
    }

    /// `a bᵀ`.
    #[inline(always)]
    pub fn outer(a: Triple<R>, b: Triple<R>) -> Self {
        Self { rows: [b * a.x, b * a.y, b * a.z] }
    }

    /// `self + m factor`.
    #[inline(always)]
    pub fn plus_scaled(self, m: Self, factor: R) -> Self {
        let ([a, b, c], [x, y, z]) = (self.rows, m.rows);
        Self { rows: [a.plus_scaled(x, factor), b.plus_scaled(y, factor), c.plus_scaled(z, factor)] }
    }

    /// The transposed matrix.
    #[inline(always)]
    pub fn transposed(self) -> Self {
        let [a, b, c] = self.rows;
        Self { rows: [Triple::new(a.x, b.x, c.x), Triple::new(a.y, b.y, c.y), Triple::new(a.z, b.z, c.z)] }
    }

    /// `selfᵀ v`, which is also the row `vᵀ self`.
    #[inline(always)]
    pub fn transpose_times(self, v: Triple<R>) -> Triple<R> {
        let [a, b, c] = self.rows;
        (a * v.x).plus_scaled(b, v.y).plus_scaled(c, v.z)
    }

    /// `self other`.
    #[inline(always)]
    pub fn times(self, other: Self) -> Self {
        let [a, b, c] = self.rows;
        Self { rows: [other.transpose_times(a), other.transpose_times(b), other.transpose_times(c)] }
    }
}

impl<R: Real> Add for Square<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.rows, other.rows);
        Self { rows: [a + x, b + y, c + z] }
    }
}

impl<R: Real> Sub for Square<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.rows, other.rows);
        Self { rows: [a - x, b - y, c - z] }
    }
}

impl<R: Real> Neg for Square<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        let [a, b, c] = self.rows;
        Self { rows: [-a, -b, -c] }
    }
}

impl<R: Real> Mul<R> for Square<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: R) -> Self {
        let [a, b, c] = self.rows;
        Self { rows: [a * factor, b * factor, c * factor] }
    }
}

impl From<Square<f64>> for Matrix3 {
    #[inline(always)]
    fn from(m: Square<f64>) -> Self {
        let [a, b, c] = m.rows;
        Self::new(a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z)
    }
}
