//! Norms and updates of an iterate's corrections: vectorised loops over all unknowns. Sums are computed as [`WIDTH`] independent
//! partial sums, which hides the latency of the operations.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::WIDTH;

use crate::newton::Correction;

/// Systems with fewer unknowns use scalar code: the dispatch would cost more than vectorisation saves.
const FEW: usize = 24;

/// Instruction set for loops over `count` unknowns.
pub(crate) fn processor(count: usize) -> pulp::Arch {
    if count < FEW { pulp::Arch::Scalar } else { pulp::Arch::new() }
}

/// Instruction set in use. It is not part of a stored state: all values compare equal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Processor(pub(crate) pulp::Arch);

impl Default for Processor {
    fn default() -> Self {
        Self(pulp::Arch::new())
    }
}

impl PartialEq for Processor {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// Sum of the partial sums by pairwise addition: three dependent additions only.
#[inline(always)]
pub(crate) fn sum(values: &[f64; WIDTH]) -> f64 {
    let [a, b, c, d, e, f, g, h] = *values;
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}

/// Inner product Σ aᵢ bᵢ.
#[inline(always)]
pub(crate) fn product(a: &[f64], b: &[f64]) -> f64 {
    let (a_blocks, a_rest) = a.as_chunks::<WIDTH>();
    let (b_blocks, b_rest) = b.as_chunks::<WIDTH>();
    let mut sums = [0.0; WIDTH];
    for (a, b) in a_blocks.iter().zip(b_blocks) {
        for k in 0..WIDTH {
            sums[k] += a[k] * b[k];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    sum(&sums) + rest
}

/// Weighted maximum norm max |wᵢ vᵢ|, and whether all values are finite.
#[inline(always)]
pub(crate) fn largest(weights: &[f64], values: &[f64]) -> (f64, bool) {
    let (w_blocks, w_rest) = weights.as_chunks::<WIDTH>();
    let (v_blocks, v_rest) = values.as_chunks::<WIDTH>();
    let mut most = [0.0_f64; WIDTH];
    // 0 · v is 0 or NaN.
    let mut nothing = [0.0; WIDTH];
    for (w, v) in w_blocks.iter().zip(v_blocks) {
        for k in 0..WIDTH {
            let value = (w[k] * v[k]).abs();
            nothing[k] += 0.0 * value;
            most[k] = if value > most[k] { value } else { most[k] };
        }
    }
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    let [a, b, c, d, e, f, g, h] = most;
    let mut most = larger(larger(larger(a, e), larger(c, g)), larger(larger(b, f), larger(d, h)));
    let mut nothing = sum(&nothing);
    for (w, v) in w_rest.iter().zip(v_rest) {
        let value = (w * v).abs();
        nothing += 0.0 * value;
        most = larger(value, most);
    }
    (most, nothing == 0.0)
}

/// Multiplies values by factors, entry by entry.
pub(crate) struct Multiply<'a> {
    pub(crate) values: &'a mut [f64],
    pub(crate) factors: &'a [f64],
}

impl pulp::WithSimd for Multiply<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) {
        for (value, factor) in self.values.iter_mut().zip(self.factors) {
            *value *= factor;
        }
    }
}

/// Norm of the position corrections of one stage. The reference is the norm of the increments. NaN if a correction is not finite.
pub(crate) struct Measure<'a> {
    /// Scale factors of the rows.
    pub(crate) sizes: &'a [f64],
    pub(crate) corrections: &'a [f64],
    pub(crate) increments: &'a [f64],
}

impl pulp::WithSimd for Measure<'_> {
    type Output = Correction;

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) -> Correction {
        let (size, is_finite) = largest(self.sizes, self.corrections);
        let (reference, _) = largest(self.sizes, self.increments);
        Correction { size: if is_finite { size } else { f64::NAN }, reference }
    }
}

/// Adds corrections times the factor `share`.
pub(crate) struct Add<'a> {
    pub(crate) share: f64,
    pub(crate) corrections: &'a [f64],
    pub(crate) values: &'a mut [f64],
}

impl pulp::WithSimd for Add<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) {
        for (value, correction) in self.values.iter_mut().zip(self.corrections) {
            *value += self.share * correction;
        }
    }
}

#[cfg(test)]
#[path = "../../tests/unit/integrator/corrections.rs"]
mod tests;
