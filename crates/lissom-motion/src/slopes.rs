//! A number with its derivatives with respect to several variables.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::array::from_fn;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::real::Real;

/// A function of `N` variables, by its value and its first derivatives.
#[derive(Clone, Copy, Debug)]
pub struct Slopes<R, const N: usize> {
    /// The value.
    pub value: R,
    /// The derivatives.
    pub by: [R; N],
}

impl<R: Real, const N: usize> Slopes<R, N> {
    /// A constant.
    #[inline(always)]
    pub fn constant(value: R) -> Self {
        Self { value, by: [value.like(0.0); N] }
    }
}

impl<R: Real, const N: usize> Add for Slopes<R, N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, by: from_fn(|k| self.by[k] + other.by[k]) }
    }
}

impl<R: Real, const N: usize> Sub for Slopes<R, N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, by: from_fn(|k| self.by[k] - other.by[k]) }
    }
}

impl<R: Real, const N: usize> Mul for Slopes<R, N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let by = from_fn(|k| (self.value * other.by[k]).plus_product(self.by[k], other.value));
        Self { value: self.value * other.value, by }
    }
}

impl<R: Real, const N: usize> Div for Slopes<R, N> {
    type Output = Self;
    /// From q b = a: q' b = a' - q b'.
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self { value, by: from_fn(|k| self.by[k].minus_product(value, other.by[k]) / other.value) }
    }
}

impl<R: Real, const N: usize> Neg for Slopes<R, N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { value: -self.value, by: self.by.map(|own| -own) }
    }
}

impl<R: Real, const N: usize> Real for Slopes<R, N> {
    #[inline(always)]
    fn like(self, value: f64) -> Self {
        Self::constant(self.value.like(value))
    }

    #[inline(always)]
    fn scaled(self, factor: f64) -> Self {
        Self { value: self.value.scaled(factor), by: self.by.map(|own| own.scaled(factor)) }
    }

    /// From r r = a: 2 r r' = a'.
    #[inline(always)]
    fn square_root(self) -> Self {
        let value = self.value.square_root();
        Self { value, by: self.by.map(|own| own.scaled(0.5) / value) }
    }

    #[inline(always)]
    fn all_below(self, limit: f64) -> bool {
        self.value.all_below(limit)
    }

    /// # Panics
    /// Always: the derivatives of such functions are unknown.
    fn one_by_one<const K: usize, const M: usize, const V: usize>(
        _arguments: [Self; K],
        _function: fn([f64; K]) -> [[f64; V]; M],
    ) -> [[Self; V]; M] {
        unreachable!("functions without derivatives are not differentiated")
    }
}
