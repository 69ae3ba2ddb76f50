//! The two number fields the solvers work in: `f64` and `Complex64`. Knows arithmetic only.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use num_complex::Complex64;

mod sealed {
    pub trait Sealed {}
    impl Sealed for f64 {}
    impl Sealed for num_complex::Complex64 {}
}

/// A real or complex number in double precision. Sealed: `f64` and `Complex64` are all there is.
pub trait Scalar:
    sealed::Sealed
    + Copy
    + Debug
    + Default
    + PartialEq
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + 'static
{
    /// The neutral element of addition.
    fn zero() -> Self;
    /// The neutral element of multiplication.
    fn one() -> Self;
    /// A real number in this field.
    fn from_real(value: f64) -> Self;
    /// Size of the number: `|x|`, and `|re| + |im|` for a complex number, which is within a factor √2 of its
    /// modulus, cannot overflow early and costs no root.
    fn magnitude(self) -> f64;
    /// Whether no part is infinite or not a number.
    fn is_finite(self) -> bool;
}

impl Scalar for f64 {
    #[inline]
    fn zero() -> Self {
        0.0
    }
    #[inline]
    fn one() -> Self {
        1.0
    }
    #[inline]
    fn from_real(value: f64) -> Self {
        value
    }
    #[inline]
    fn magnitude(self) -> f64 {
        self.abs()
    }
    #[inline]
    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }
}

impl Scalar for Complex64 {
    #[inline]
    fn zero() -> Self {
        Complex64::new(0.0, 0.0)
    }
    #[inline]
    fn one() -> Self {
        Complex64::new(1.0, 0.0)
    }
    #[inline]
    fn from_real(value: f64) -> Self {
        Complex64::new(value, 0.0)
    }
    #[inline]
    fn magnitude(self) -> f64 {
        self.re.abs() + self.im.abs()
    }
    #[inline]
    fn is_finite(self) -> bool {
        self.re.is_finite() && self.im.is_finite()
    }
}
