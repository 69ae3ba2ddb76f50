//! A number, or several side by side: frequently evaluated formulas are written over this trait, and so only once.
//!
//! Everything that is generic over [`Real`] is inlined to the last function: only then does a caller compiled for
//! wider vectors use them. For the same reason it calls no closures, iterators or foreign vector types.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number, or several side by side.
pub trait Real:
    Copy
    + std::fmt::Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// `value` in each lane; `self` only determines the type.
    fn like(self, value: f64) -> Self;

    /// `self` times a constant.
    fn scaled(self, factor: f64) -> Self;

    /// `self + a b`, rounded once where the processor does so at no cost.
    #[inline(always)]
    fn plus_product(self, a: Self, b: Self) -> Self {
        self + a * b
    }

    /// `self - a b`, rounded once where the processor does so at no cost.
    #[inline(always)]
    fn minus_product(self, a: Self, b: Self) -> Self {
        self - a * b
    }

    /// The square root.
    fn square_root(self) -> Self;

    /// Whether all lanes are below `limit`; false if one is not a number.
    fn all_below(self, limit: f64) -> bool;

    /// A function evaluated one lane at a time, for arguments that are too rare for formulas of their own.
    fn one_by_one<const K: usize, const M: usize, const N: usize>(
        arguments: [Self; K],
        function: fn([f64; K]) -> [[f64; N]; M],
    ) -> [[Self; N]; M];

    /// Evaluates `work` in a separate function, for long formulas with many callers that are seldom evaluated; `self`
    /// only determines the type.
    #[inline(always)]
    fn apart<T>(self, work: impl FnOnce() -> T) -> T {
        work()
    }
}

impl Real for f64 {
    #[inline(always)]
    fn like(self, value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn scaled(self, factor: f64) -> Self {
        self * factor
    }

    #[inline(always)]
    fn square_root(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn all_below(self, limit: f64) -> bool {
        self < limit
    }

    #[inline(always)]
    fn one_by_one<const K: usize, const M: usize, const N: usize>(
        arguments: [Self; K],
        function: fn([f64; K]) -> [[f64; N]; M],
    ) -> [[Self; N]; M] {
        function(arguments)
    }
}
