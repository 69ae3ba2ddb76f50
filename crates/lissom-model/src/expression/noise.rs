//! Pseudo-random numbers that are functions of a seed and a counter, so that they are the same after a restart, in any order and on any
//! machine. The bits are those of the generator of Steele, Lea and Flood [2014], started from seed and counter.

use std::f64::consts::TAU;

/// Largest magnitude of [`normal`], by the smallest uniform number.
pub(super) const MAX_NORMAL: f64 = 8.7;
/// Weight of a bit among 53.
const UNIT: f64 = 1.0 / (1_u64 << 53) as f64;

/// The whole number nearest to `x`; between two of them the larger one.
pub(super) fn counter(x: f64) -> f64 {
    (x + 0.5).floor()
}

/// Whether the counter is the same within an interval.
pub(super) fn is_one([low, high]: [f64; 2]) -> bool {
    counter(low) == counter(high)
}

/// Scrambled bits of a number.
fn mixed(bits: u64) -> u64 {
    let bits = bits.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

/// Number of a stream in (0, 1).
fn unit(seed: f64, counter: f64, stream: u64) -> f64 {
    // Zero has one sign.
    let [seed, counter] = [seed, counter].map(|own| (own + 0.0).to_bits());
    let bits = mixed(mixed(mixed(seed ^ stream)).wrapping_add(counter));
    ((bits >> 11) as f64 + 0.5) * UNIT
}

/// Uniform between 0 and 1; not a number unless both arguments are finite.
pub(crate) fn uniform(seed: f64, counter: f64) -> f64 {
    if seed.is_finite() && counter.is_finite() { unit(seed, counter, 0) } else { f64::NAN }
}

/// Normal with mean 0 and variance 1 [Box and Muller 1958].
pub(super) fn normal(seed: f64, counter: f64) -> f64 {
    (-2.0 * uniform(seed, counter).ln()).sqrt() * (TAU * unit(seed, counter, 1)).cos()
}

#[cfg(test)]
#[path = "../../tests/unit/expression/noise.rs"]
mod tests;
