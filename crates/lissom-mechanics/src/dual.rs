//! Numbers with their first derivatives along several directions [Clifford 1873]: formulas written over [`Number`]
//! return values, or values and exact derivatives.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number, or a number with derivatives.
pub trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// A constant.
    fn constant(value: f64) -> Self;

    /// The value alone.
    fn value(self) -> f64;

    /// A function of it, from its value and derivative there.
    #[must_use]
    fn composed(self, value: f64, derivative: f64) -> Self;

    /// Times a constant.
    #[must_use]
    fn scaled(self, factor: f64) -> Self {
        self.composed(self.value() * factor, factor)
    }

    /// Plus a constant.
    #[must_use]
    fn plus(self, term: f64) -> Self {
        self.composed(self.value() + term, 1.0)
    }

    /// The square root.
    #[must_use]
    fn square_root(self) -> Self {
        let root = self.value().sqrt();
        self.composed(root, 0.5 / root)
    }

    /// A real power of a positive number.
    #[must_use]
    fn power(self, exponent: f64) -> Self {
        let value = self.value().powf(exponent);
        self.composed(value, exponent * value / self.value())
    }

    /// The hyperbolic tangent.
    #[must_use]
    fn hyperbolic_tangent(self) -> Self {
        let value = self.value().tanh();
        self.composed(value, 1.0 - value * value)
    }

    /// Sine and cosine.
    fn sine_cosine(self) -> (Self, Self) {
        let (sine, cosine) = self.value().sin_cos();
        (self.composed(sine, cosine), self.composed(cosine, -sine))
    }

    /// The arc tangent.
    #[must_use]
    fn arc_tangent(self) -> Self {
        let value = self.value();
        self.composed(value.atan(), 1.0 / (1.0 + value * value))
    }
}

impl Number for f64 {
    fn constant(value: f64) -> Self {
        value
    }

    fn value(self) -> f64 {
        self
    }

    fn composed(self, value: f64, _: f64) -> Self {
        value
    }
}

/// A number with its derivatives along `N` directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const N: usize> {
    /// The value.
    pub value: f64,
    /// Derivatives of the value.
    pub by: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// The variable of this direction.
    pub fn variable(value: f64, direction: usize) -> Self {
        let mut by = [0.0; N];
        by[direction] = 1.0;
        Self { value, by }
    }

    /// A function of two numbers, from its value and its derivatives with respect to both.
    fn combined(self, value: f64, by_this: f64, (other, by_other): (&Self, f64)) -> Self {
        Self { value, by: std::array::from_fn(|k| by_this * self.by[k] + by_other * other.by[k]) }
    }
}

impl<const N: usize> Number for Dual<N> {
    fn constant(value: f64) -> Self {
        Self { value, by: [0.0; N] }
    }

    fn value(self) -> f64 {
        self.value
    }

    fn composed(self, value: f64, derivative: f64) -> Self {
        Self { value, by: self.by.map(|by| derivative * by) }
    }
}

impl<const N: usize> Add for Dual<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, by: std::array::from_fn(|k| self.by[k] + other.by[k]) }
    }
}

impl<const N: usize> Sub for Dual<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, by: std::array::from_fn(|k| self.by[k] - other.by[k]) }
    }
}

impl<const N: usize> Mul for Dual<N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.combined(self.value * other.value, other.value, (&other, self.value))
    }
}

impl<const N: usize> Div for Dual<N> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        self.combined(value, 1.0 / other.value, (&other, -value / other.value))
    }
}

impl<const N: usize> Neg for Dual<N> {
    type Output = Self;
    fn neg(self) -> Self {
        self.composed(-self.value, -1.0)
    }
}

/// The angle of the point (x, y): its derivative is (x δy - y δx)/(x² + y²).
pub fn arc_tangent_of_ratio<T: Number>(y: T, x: T) -> T {
    let (b, a) = (y.value(), x.value());
    let square = a * a + b * b;
    // The values of both terms cancel: only derivatives remain.
    (y.scaled(a / square) - x.scaled(b / square)).composed(b.atan2(a), 1.0)
}

/// Three components.
pub type Three<T> = [T; 3];

/// a·b.
pub fn dot<T: Number>(a: Three<T>, b: Three<T>) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a × b.
pub fn cross<T: Number>(a: Three<T>, b: Three<T>) -> Three<T> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// a + b.
pub fn sum<T: Number>(a: Three<T>, b: Three<T>) -> Three<T> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// A vector times a number.
pub fn times<T: Number>(a: Three<T>, factor: T) -> Three<T> {
    a.map(|component| component * factor)
}

#[cfg(test)]
#[path = "../tests/unit/dual.rs"]
mod tests;
