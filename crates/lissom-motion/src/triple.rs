//! Three components over any [`Real`], with the products that rotations need.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::ops::{Add, Mul, Neg, Sub};

use crate::Vector3;
use crate::real::Real;

/// A vector of three components.
#[derive(Clone, Copy, Debug)]
pub struct Triple<R> {
    /// First component.
    pub x: R,
    /// Second component.
    pub y: R,
    /// Third component.
    pub z: R,
}

impl<R: Real> Triple<R> {
    /// From components.
    #[inline(always)]
    pub fn new(x: R, y: R, z: R) -> Self {
        Self { x, y, z }
    }

    /// Times a constant.
    #[inline(always)]
    pub fn scaled(self, factor: f64) -> Self {
        Self::new(self.x.scaled(factor), self.y.scaled(factor), self.z.scaled(factor))
    }

    /// `self + v factor`.
    #[inline(always)]
    pub fn plus_scaled(self, v: Self, factor: R) -> Self {
        Self::new(
            self.x.plus_product(v.x, factor),
            self.y.plus_product(v.y, factor),
            self.z.plus_product(v.z, factor),
        )
    }

    /// `self · other`.
    #[inline(always)]
    pub fn dot(self, other: Self) -> R {
        (self.x * other.x).plus_product(self.y, other.y).plus_product(self.z, other.z)
    }

    /// `self · self`.
    #[inline(always)]
    pub fn norm_squared(self) -> R {
        self.dot(self)
    }

    /// `self × other`.
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self::new(
            (self.y * other.z).minus_product(self.z, other.y),
            (self.z * other.x).minus_product(self.x, other.z),
            (self.x * other.y).minus_product(self.y, other.x),
        )
    }

    /// `self + a × b`.
    #[inline(always)]
    pub fn plus_cross(self, a: Self, b: Self) -> Self {
        Self::new(
            self.x.plus_product(a.y, b.z).minus_product(a.z, b.y),
            self.y.plus_product(a.z, b.x).minus_product(a.x, b.z),
            self.z.plus_product(a.x, b.y).minus_product(a.y, b.x),
        )
    }
}

impl<R: Real> Add for Triple<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<R: Real> Sub for Triple<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<R: Real> Neg for Triple<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

impl<R: Real> Mul<R> for Triple<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: R) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

impl From<&Vector3> for Triple<f64> {
    #[inline(always)]
    fn from(v: &Vector3) -> Self {
        Self::new(v.x, v.y, v.z)
    }
}

impl From<Triple<f64>> for Vector3 {
    #[inline(always)]
    fn from(v: Triple<f64>) -> Self {
        Self::new(v.x, v.y, v.z)
    }
}
