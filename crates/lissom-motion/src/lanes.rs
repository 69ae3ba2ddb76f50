//! Several numbers side by side in the lanes of one vector register.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::ops::{Add, Div, Mul, Neg, Sub};

use pulp::Simd;

use crate::real::Real;

/// Numbers in a [`Block`].
pub const WIDTH: usize = 8;

/// As many numbers as the widest vector has lanes. Narrower vectors process a block in [`Lanes::PARTS`] parts, so
/// that data stored in blocks are independent of the processor.
pub type Block = [f64; WIDTH];

/// As many numbers side by side as the processor's vectors of kind `S` contain.
#[derive(Clone, Copy, Debug)]
pub struct Lanes<S: Simd> {
    simd: S,
    values: S::f64s,
}

impl<S: Simd> Lanes<S> {
    /// Vectors in a block.
    pub const PARTS: usize = WIDTH / S::F64_LANES;

    /// Lanes that all have one value.
    #[inline(always)]
    pub fn splat(simd: S, value: f64) -> Self {
        Self { simd, values: simd.splat_f64s(value) }
    }

    /// Loads one part of a block.
    ///
    /// # Panics
    /// If `part` is not below [`Self::PARTS`].
    #[inline(always)]
    pub fn load(simd: S, block: &Block, part: usize) -> Self {
        Self { simd, values: S::as_simd_f64s(block).0[part] }
    }

    /// Stores to one part of a block.
    ///
    /// # Panics
    /// If `part` is not below [`Self::PARTS`].
    #[inline(always)]
    pub fn store(self, block: &mut Block, part: usize) {
        S::as_mut_simd_f64s(block).0[part] = self.values;
    }
}

impl<S: Simd> Add for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { values: self.simd.add_f64s(self.values, other.values), ..self }
    }
}

impl<S: Simd> Sub for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { values: self.simd.sub_f64s(self.values, other.values), ..self }
    }
}

impl<S: Simd> Mul for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self { values: self.simd.mul_f64s(self.values, other.values), ..self }
    }
}

impl<S: Simd> Div for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self { values: self.simd.div_f64s(self.values, other.values), ..self }
    }
}

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { values: self.simd.neg_f64s(self.values), ..self }
    }
}

impl<S: Simd> Real for Lanes<S> {
    #[inline(always)]
    fn like(self, value: f64) -> Self {
        Self::splat(self.simd, value)
    }

    #[inline(always)]
    fn scaled(self, factor: f64) -> Self {
        self * self.like(factor)
    }

    #[inline(always)]
    fn plus_product(self, a: Self, b: Self) -> Self {
        Self { values: self.simd.mul_add_e_f64s(a.values, b.values, self.values), ..self }
    }

    #[inline(always)]
    fn minus_product(self, a: Self, b: Self) -> Self {
        Self { values: self.simd.negate_mul_add_e_f64s(a.values, b.values, self.values), ..self }
    }

    #[inline(always)]
    fn square_root(self) -> Self {
        Self { values: self.simd.sqrt_f64s(self.values), ..self }
    }

    #[inline(always)]
    fn all_below(self, limit: f64) -> bool {
        let below = self.simd.less_than_f64s(self.values, self.simd.splat_f64s(limit));
        self.simd.first_true_m64s(self.simd.not_m64s(below)) == S::F64_LANES
    }

    #[inline(always)]
    fn apart<T>(self, work: impl FnOnce() -> T) -> T {
        if const { S::F64_LANES == 1 } { separately(work) } else { self.simd.vectorize(work) }
    }

    #[inline(always)]
    fn one_by_one<const K: usize, const M: usize, const N: usize>(
        arguments: [Self; K],
        function: fn([f64; K]) -> [[f64; N]; M],
    ) -> [[Self; N]; M] {
        const { assert!(K > 0, "an argument selects the kind of vector") };
        let mut columns = [[0.0; WIDTH]; K];
        for k in 0..K {
            arguments[k].store(&mut columns[k], 0);
        }
        let mut results = [[[0.0; WIDTH]; N]; M];
        each_lane(S::F64_LANES, &columns, function, &mut results);
        let simd = arguments[0].simd;
        let mut lanes = [[Self::splat(simd, 0.0); N]; M];
        for m in 0..M {
            for n in 0..N {
                lanes[m][n] = Self::load(simd, &results[m][n], 0);
            }
        }
        lanes
    }
}

#[inline(never)]
fn separately<T>(work: impl FnOnce() -> T) -> T {
    work()
}

#[cold]
#[inline(never)]
fn each_lane<const K: usize, const M: usize, const N: usize>(
    lanes: usize,
    arguments: &[Block; K],
    function: fn([f64; K]) -> [[f64; N]; M],
    results: &mut [[Block; N]; M],
) {
    for lane in 0..lanes {
        let values = function(std::array::from_fn(|k| arguments[k][lane]));
        for m in 0..M {
            for n in 0..N {
                results[m][n][lane] = values[m][n];
            }
        }
    }
}
