//! Numbers of about 31 digits: the unevaluated sum of two doubles.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// An unevaluated sum of two doubles (Dekker 1971, Knuth's exact sum, Veltkamp's split).
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Wide {
    pub(crate) high: f64,
    pub(crate) low: f64,
}

fn exact_sum(a: f64, b: f64) -> Wide {
    let high = a + b;
    let virtual_b = high - a;
    Wide { high, low: (a - (high - virtual_b)) + (b - virtual_b) }
}

fn exact_product(a: f64, b: f64) -> Wide {
    let high = a * b;
    Wide { high, low: a.mul_add(b, -high) }
}

impl Wide {
    pub(crate) fn new(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }

    pub(crate) fn value(self) -> f64 {
        self.high + self.low
    }
}

impl Add for Wide {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let high = exact_sum(self.high, other.high);
        let low = exact_sum(self.low, other.low);
        let first = exact_sum(high.high, high.low + low.high);
        exact_sum(first.high, first.low + low.low)
    }
}

impl Neg for Wide {
    type Output = Self;
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Sub for Wide {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Wide {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = exact_product(self.high, other.high);
        exact_sum(product.high, product.low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for Wide {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::new(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::new(second);
        let sum = exact_sum(first, second);
        exact_sum(sum.high, sum.low + rest.high / other.high)
    }
}
