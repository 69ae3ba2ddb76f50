//! Latin hypercube [McKay, Beckman and Conover 1979]: every path has one member in each of as many equal parts.

use super::random::{fraction, permutation};
use super::{Draw, SamplingKind};

pub(super) const KIND: SamplingKind = SamplingKind {
    name: "latin-hypercube",
    summary: "Latin hypercube: the range of every path is divided into intervals of equal probability, with one member in each.",
    draw: Draw::Fractions(fractions),
};

// The signature is that of all samplings.
#[allow(clippy::unnecessary_wraps)]
fn fractions(paths: usize, members: usize, seed: u64) -> Result<Vec<f64>, String> {
    let mut all = vec![0.0; paths * members];
    for path in 0..paths {
        let parts = permutation(members, seed, 2 * path as u64);
        for (member, part) in parts.into_iter().enumerate() {
            let within = fraction(seed, 2 * path as u64 + 1, member as u64);
            // The largest number below 1 represents one that would be rounded to it.
            let value = (part as f64 + within) / members as f64;
            all[member * paths + path] = value.min(1.0 - f64::EPSILON / 2.0);
        }
    }
    Ok(all)
}

#[cfg(test)]
#[path = "../../../tests/unit/sweep/sampling/latin_hypercube.rs"]
mod tests;
