//! Twists and wrenches over any [`Real`].
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::ops::{Add, Mul, Neg, Sub};

use crate::real::Real;
use crate::triple::Triple;
use crate::{Vector6, rotation_part, translation_part};

/// A twist (translation; rotation) or a wrench (force; moment).
#[derive(Clone, Copy, Debug)]
pub struct Screw<R> {
    /// Translation of a twist, force of a wrench.
    pub translation: Triple<R>,
    /// Rotation of a twist, moment of a wrench.
    pub rotation: Triple<R>,
}

impl<R: Real> Screw<R> {
    /// From both parts.
    #[inline(always)]
    pub fn new(translation: Triple<R>, rotation: Triple<R>) -> Self {
        Self { translation, rotation }
    }

    /// From six components.
    #[inline(always)]
    pub fn from_components(components: [R; 6]) -> Self {
        let [a, b, c, d, e, f] = components;
        Self::new(Triple::new(a, b, c), Triple::new(d, e, f))
    }

    /// Six components of the screw.
    #[inline(always)]
    pub fn components(self) -> [R; 6] {
        let (u, theta) = (self.translation, self.rotation);
        [u.x, u.y, u.z, theta.x, theta.y, theta.z]
    }

    /// Zero; `kind` only determines the type of number.
    #[inline(always)]
    pub fn zero(kind: R) -> Self {
        Self::from_components([kind.like(0.0); 6])
    }

    /// Times a constant.
    #[inline(always)]
    pub fn scaled(self, factor: f64) -> Self {
        Self::new(self.translation.scaled(factor), self.rotation.scaled(factor))
    }

    /// `self + v factor`.
    #[inline(always)]
    pub fn plus_scaled(self, v: Self, factor: R) -> Self {
        Self::new(
            self.translation.plus_scaled(v.translation, factor),
            self.rotation.plus_scaled(v.rotation, factor),
        )
    }
}

impl<R: Real> Add for Screw<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.translation + other.translation, self.rotation + other.rotation)
    }
}

impl<R: Real> Sub for Screw<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.translation - other.translation, self.rotation - other.rotation)
    }
}

impl<R: Real> Neg for Screw<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.translation, -self.rotation)
    }
}

impl<R: Real> Mul<R> for Screw<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: R) -> Self {
        Self::new(self.translation * factor, self.rotation * factor)
    }
}

impl From<&Vector6> for Screw<f64> {
    #[inline(always)]
    fn from(v: &Vector6) -> Self {
        Self::new((&translation_part(v)).into(), (&rotation_part(v)).into())
    }
}

impl From<Screw<f64>> for Vector6 {
    #[inline(always)]
    fn from(v: Screw<f64>) -> Self {
        let [a, b, c, d, e, f] = v.components();
        Self::new(a, b, c, d, e, f)
    }
}
