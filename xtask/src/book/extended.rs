//! Numbers of twice double precision, as unevaluated sums of two doubles: some 32 digits with the range of a double.
//! Slow, for measuring the errors of double precision; no solver computes with them.
//!
//! Error-free sums and products [Dekker 1971; Knuth 1969, section 4.2.2], arithmetic after Hida, Li and Bailey
//! 2001 with the error bounds of Joldes, Muller and Popescu 2017.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The number `high + low`, with `|low|` at most half a unit in the last place of `high`. Relative errors of
/// single operations stay below 1e-31.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Extended {
    high: f64,
    low: f64,
}

/// `a + b` and its rounding error.
#[inline]
fn sum(a: f64, b: f64) -> (f64, f64) {
    let total = a + b;
    let second = total - a;
    (total, (a - (total - second)) + (b - second))
}

/// `a + b` and its rounding error for `|a| ≥ |b|`.
#[inline]
fn ordered_sum(a: f64, b: f64) -> (f64, f64) {
    let total = a + b;
    (total, b - (total - a))
}

/// `a b` and its rounding error.
#[inline]
fn product(a: f64, b: f64) -> (f64, f64) {
    let total = a * b;
    (total, a.mul_add(b, -total))
}

impl Extended {
    /// Zero.
    pub(super) const ZERO: Self = Self { high: 0.0, low: 0.0 };
    /// One.
    pub(super) const ONE: Self = Self { high: 1.0, low: 0.0 };

    /// The double next to this number.
    #[inline]
    pub(super) fn to_f64(self) -> f64 {
        self.high
    }

    /// Magnitude.
    #[inline]
    pub(super) fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    /// Square root; not a number below zero.
    #[inline]
    pub(super) fn sqrt(self) -> Self {
        if self.high == 0.0 {
            return Self::ZERO;
        }
        // One step of Newton's method from the root in double precision.
        let root = self.high.sqrt();
        let rest = self - Self::product_of(root, root);
        let (high, low) = ordered_sum(root, rest.high / (2.0 * root));
        Self { high, low }
    }

    /// Product of two doubles, without error.
    #[inline]
    pub(super) fn product_of(a: f64, b: f64) -> Self {
        let (high, low) = product(a, b);
        Self { high, low }
    }
}

impl From<f64> for Extended {
    #[inline]
    fn from(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }
}

impl PartialOrd for Extended {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match self.high.partial_cmp(&other.high) {
            Some(Ordering::Equal) => self.low.partial_cmp(&other.low),
            ordering => ordering,
        }
    }
}

impl Neg for Extended {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Add for Extended {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        let (high, low) = sum(self.high, other.high);
        let (next, last) = sum(self.low, other.low);
        let (high, low) = ordered_sum(high, low + next);
        let (high, low) = ordered_sum(high, low + last);
        Self { high, low }
    }
}

impl Sub for Extended {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Extended {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let (high, low) = product(self.high, other.high);
        let (high, low) = ordered_sum(high, low + (self.high * other.low + self.low * other.high));
        Self { high, low }
    }
}

impl Div for Extended {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        // Long division with three digits of base 2^53.
        let first = self.high / other.high;
        let rest = self - other * Self::from(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::from(second);
        let (high, low) = ordered_sum(first, second);
        Self { high, low } + Self::from(rest.high / other.high)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const ROUND_OFF: f64 = 1e-31;

    fn number() -> impl Strategy<Value = Extended> {
        (-1e8..1e8_f64, -1.0..1.0_f64)
            .prop_filter("not near zero", |(high, _)| high.abs() > 1e-8)
            .prop_map(|(high, low)| Extended::from(high) + Extended::from(low * high * 1e-17))
    }

    fn close(a: Extended, b: Extended, size: f64) -> bool {
        (a - b).to_f64().abs() <= ROUND_OFF * size
    }

    #[test]
    fn digits_beyond_double_precision_are_kept() {
        let third = Extended::ONE / Extended::from(3.0);
        let one = third + third + third;
        assert!(close(one, Extended::ONE, 1.0));
        let tiny = Extended::from(1e-25);
        assert_eq!(((Extended::ONE + tiny) - Extended::ONE).to_f64(), 1e-25);
        // √2 to 32 digits: the double next to it and the rest.
        let root = Extended::from(2.0).sqrt();
        assert_eq!(root.high, std::f64::consts::SQRT_2);
        assert!((root.low - -9.667_293_313_452_913e-17).abs() < 1e-31);
        // (1 + 2^-30)² needs 61 bits.
        let number = 1.0 + 2.0_f64.powi(-30);
        let square = Extended::product_of(number, number);
        assert_eq!((square - Extended::from(1.0 + 2.0_f64.powi(-29))).to_f64(), 2.0_f64.powi(-60));
    }

    #[test]
    fn order_looks_at_both_parts() {
        let above = Extended::ONE + Extended::from(1e-20);
        assert!(above > Extended::ONE && -above < Extended::ONE && (-above).abs() == above);
        assert!(Extended::from(-1.0).sqrt().to_f64().is_nan());
        assert_eq!(Extended::ZERO.sqrt(), Extended::ZERO);
    }

    proptest! {
        #[test]
        fn operations_undo_one_another(a in number(), b in number()) {
            let (x, y) = (a.to_f64().abs(), b.to_f64().abs());
            prop_assert!(close((a + b) - b, a, x.max(y)));
            prop_assert!(close((a * b) / b, a, 8.0 * x));
            prop_assert!(close((a * a).sqrt(), a.abs(), 8.0 * x));
        }

        #[test]
        fn products_distribute(a in number(), b in number(), c in number()) {
            let size = a.to_f64().abs() * (b.to_f64().abs() + c.to_f64().abs());
            prop_assert!(close(a * (b + c), a * b + a * c, 4.0 * size));
        }
    }
}
