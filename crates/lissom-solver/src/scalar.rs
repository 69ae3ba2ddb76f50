//! The two number fields the solvers work in: `f64` and `Complex64`. Knows arithmetic only.

#![expect(clippy::inline_always, reason = "only code inlined into a dispatched caller uses its vectors")]

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use num_complex::Complex64;

mod sealed {
    /// What kernels need and nobody else should see.
    pub trait Arithmetic: Sized {
        /// `a b + c`. With `FUSED` each product is rounded together with its sum: one instruction where the
        /// processor is known to have it, a slow library call elsewhere.
        fn multiply_add<const FUSED: bool>(a: Self, b: Self, c: Self) -> Self;
    }
}

/// A real or complex number in double precision. Sealed: `f64` and `Complex64` are all there is.
pub trait Scalar:
    sealed::Arithmetic
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

impl sealed::Arithmetic for f64 {
    #[inline(always)]
    fn multiply_add<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
        if FUSED { a.mul_add(b, c) } else { a * b + c }
    }
}

impl Scalar for f64 {
    #[inline(always)]
    fn zero() -> Self {
        0.0
    }
    #[inline(always)]
    fn one() -> Self {
        1.0
    }
    #[inline(always)]
    fn from_real(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn magnitude(self) -> f64 {
        self.abs()
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }
}

impl sealed::Arithmetic for Complex64 {
    #[inline(always)]
    fn multiply_add<const FUSED: bool>(a: Complex64, b: Complex64, c: Complex64) -> Complex64 {
        let real = f64::multiply_add::<FUSED>(a.re, b.re, c.re);
        let imaginary = f64::multiply_add::<FUSED>(a.im, b.re, c.im);
        Complex64::new(
            f64::multiply_add::<FUSED>(-a.im, b.im, real),
            f64::multiply_add::<FUSED>(a.re, b.im, imaginary),
        )
    }
}

impl Scalar for Complex64 {
    #[inline(always)]
    fn zero() -> Self {
        Complex64::new(0.0, 0.0)
    }
    #[inline(always)]
    fn one() -> Self {
        Complex64::new(1.0, 0.0)
    }
    #[inline(always)]
    fn from_real(value: f64) -> Self {
        Complex64::new(value, 0.0)
    }
    #[inline(always)]
    fn magnitude(self) -> f64 {
        self.re.abs() + self.im.abs()
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        self.re.is_finite() && self.im.is_finite()
    }
}
