//! A number with its first and second derivative in time.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::real::Real;

/// A function of time at an instant, by its value and its first two derivatives.
#[derive(Clone, Copy, Debug)]
pub struct Jet<R> {
    /// The value.
    pub value: R,
    /// The first derivative.
    pub first: R,
    /// The second derivative.
    pub second: R,
}

impl<R: Real> Jet<R> {
    /// A constant.
    #[inline(always)]
    pub fn constant(value: R) -> Self {
        let zero = value.like(0.0);
        Self { value, first: zero, second: zero }
    }
}

impl<R: Real> Add for Jet<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            first: self.first + other.first,
            second: self.second + other.second,
        }
    }
}

impl<R: Real> Sub for Jet<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self {
            value: self.value - other.value,
            first: self.first - other.first,
            second: self.second - other.second,
        }
    }
}

impl<R: Real> Mul for Jet<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let cross = self.first * other.first;
        Self {
            value: self.value * other.value,
            first: (self.value * other.first).plus_product(self.first, other.value),
            second: (cross + cross)
                .plus_product(self.value, other.second)
                .plus_product(self.second, other.value),
        }
    }
}

impl<R: Real> Div for Jet<R> {
    type Output = Self;
    /// From q b = a: q' b = a' - q b', q'' b = a'' - 2 q' b' - q b''.
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        let first = self.first.minus_product(value, other.first) / other.value;
        let cross = first * other.first;
        let second = (self.second - cross - cross).minus_product(value, other.second) / other.value;
        Self { value, first, second }
    }
}

impl<R: Real> Neg for Jet<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { value: -self.value, first: -self.first, second: -self.second }
    }
}

impl<R: Real> Real for Jet<R> {
    #[inline(always)]
    fn like(self, value: f64) -> Self {
        Self::constant(self.value.like(value))
    }

    #[inline(always)]
    fn scaled(self, factor: f64) -> Self {
        Self {
            value: self.value.scaled(factor),
            first: self.first.scaled(factor),
            second: self.second.scaled(factor),
        }
    }

    /// From r r = a: 2 r r' = a', 2 r r'' = a'' - 2 r' r'.
    #[inline(always)]
    fn square_root(self) -> Self {
        let value = self.value.square_root();
        let first = self.first.scaled(0.5) / value;
        let second = self.second.scaled(0.5).minus_product(first, first) / value;
        Self { value, first, second }
    }

    #[inline(always)]
    fn all_below(self, limit: f64) -> bool {
        self.value.all_below(limit)
    }

    /// # Panics
    /// Always: the derivatives of such functions are unknown.
    fn one_by_one<const K: usize, const M: usize, const N: usize>(
        _arguments: [Self; K],
        _function: fn([f64; K]) -> [[f64; N]; M],
    ) -> [[Self; N]; M] {
        unreachable!("functions without derivatives are not evaluated in time")
    }
}
