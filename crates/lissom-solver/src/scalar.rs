//! The two number fields of the solvers: `f64` and `Complex64`.

#![expect(clippy::inline_always, reason = "only code inlined into a dispatched caller uses its vectors")]

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use num_complex::Complex64;

mod sealed {
    /// Operations for kernels only.
    pub trait Arithmetic: Sized {
        /// `a b + c`. With `FUSED` each product is rounded together with its sum: one instruction if the processor is
        /// known to support it, a slow library call otherwise.
        fn multiply_add<const FUSED: bool>(a: Self, b: Self, c: Self) -> Self;

        /// Whether a number has an imaginary part.
        const COMPLEX: bool;

        /// `Σ_p A[.., p] B[.., p]ᵀ` for `ROWS` rows and `COLUMNS` columns of two panels, given as slices and strides.
        fn tile<const FUSED: bool, const ROWS: usize, const COLUMNS: usize>(
            a: (&[Self], usize),
            b: (&[Self], usize),
            depth: usize,
        ) -> [[Self; ROWS]; COLUMNS];
    }
}

/// `COUNT` numbers of a slice, from a position on.
#[inline(always)]
pub(crate) fn array<S, const COUNT: usize>(slice: &[S], at: usize) -> &[S; COUNT] {
    slice[at..at + COUNT].try_into().expect("a slice of that length")
}

/// `COUNT` mutable numbers of a slice, from a position on.
#[inline(always)]
pub(crate) fn array_mut<S, const COUNT: usize>(slice: &mut [S], at: usize) -> &mut [S; COUNT] {
    (&mut slice[at..at + COUNT]).try_into().expect("a slice of that length")
}

/// A real or complex number in double precision. Sealed: implemented only for `f64` and `Complex64`.
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
    /// Size of the number: `|x|`, and `|re| + |im|` for a complex number, which is within a factor √2 of its modulus,
    /// cannot overflow early and needs no square root.
    fn magnitude(self) -> f64;
    /// Whether no part is infinite or not a number.
    fn is_finite(self) -> bool;
    /// Real and imaginary part.
    fn parts(self) -> [f64; 2];
    /// From real and imaginary part; a real number ignores the imaginary part.
    fn from_parts(real: f64, imaginary: f64) -> Self;
}

impl sealed::Arithmetic for f64 {
    #[inline(always)]
    fn multiply_add<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
        if FUSED { a.mul_add(b, c) } else { a * b + c }
    }

    const COMPLEX: bool = false;

    #[inline(always)]
    fn tile<const FUSED: bool, const ROWS: usize, const COLUMNS: usize>(
        (a, a_stride): (&[f64], usize),
        (b, b_stride): (&[f64], usize),
        depth: usize,
    ) -> [[f64; ROWS]; COLUMNS] {
        let mut sums = [[0.0; ROWS]; COLUMNS];
        for p in 0..depth {
            let left: &[f64; ROWS] = array(a, p * a_stride);
            let right: &[f64; COLUMNS] = array(b, p * b_stride);
            for j in 0..COLUMNS {
                for i in 0..ROWS {
                    sums[j][i] = f64::multiply_add::<FUSED>(left[i], right[j], sums[j][i]);
                }
            }
        }
        sums
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
    #[inline(always)]
    fn parts(self) -> [f64; 2] {
        [self, 0.0]
    }
    #[inline(always)]
    fn from_parts(real: f64, _imaginary: f64) -> Self {
        real
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

    const COMPLEX: bool = true;

    /// Products with the real and with the imaginary part of B are summed separately, so that the parts of A remain
    /// interleaved as in memory; they are combined once, at the end.
    #[inline(always)]
    fn tile<const FUSED: bool, const ROWS: usize, const COLUMNS: usize>(
        (a, a_stride): (&[Complex64], usize),
        (b, b_stride): (&[Complex64], usize),
        depth: usize,
    ) -> [[Complex64; ROWS]; COLUMNS] {
        let mut by_real = [[[0.0; 2]; ROWS]; COLUMNS];
        let mut by_imaginary = [[[0.0; 2]; ROWS]; COLUMNS];
        for p in 0..depth {
            let left: &[Complex64; ROWS] = array(a, p * a_stride);
            let left = left.map(|value| [value.re, value.im]);
            let right: &[Complex64; COLUMNS] = array(b, p * b_stride);
            for j in 0..COLUMNS {
                for i in 0..ROWS {
                    for part in 0..2 {
                        let (real, imaginary) = (&mut by_real[j][i][part], &mut by_imaginary[j][i][part]);
                        *real = f64::multiply_add::<FUSED>(left[i][part], right[j].re, *real);
                        *imaginary = f64::multiply_add::<FUSED>(left[i][part], right[j].im, *imaginary);
                    }
                }
            }
        }
        let mut sums = [[Complex64::new(0.0, 0.0); ROWS]; COLUMNS];
        for j in 0..COLUMNS {
            for i in 0..ROWS {
                let (real, imaginary) = (by_real[j][i], by_imaginary[j][i]);
                sums[j][i] = Complex64::new(real[0] - imaginary[1], real[1] + imaginary[0]);
            }
        }
        sums
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
    #[inline(always)]
    fn parts(self) -> [f64; 2] {
        [self.re, self.im]
    }
    #[inline(always)]
    fn from_parts(real: f64, imaginary: f64) -> Self {
        Complex64::new(real, imaginary)
    }
}
