//! Independent draws.

use super::random::fraction;
use super::{Draw, SamplingKind};

pub(super) const KIND: SamplingKind = SamplingKind {
    name: "monte-carlo",
    summary: "Independent random values; an increase of `members` does not change the first ones.",
    draw: Draw::Fractions(fractions),
};

// The signature is that of all samplings.
#[allow(clippy::unnecessary_wraps)]
fn fractions(paths: usize, members: usize, seed: u64) -> Result<Vec<f64>, String> {
    let of = |member| (0..paths).map(move |path| fraction(seed, path as u64, member as u64));
    Ok((0..members).flat_map(of).collect())
}

#[cfg(test)]
#[path = "../../../tests/unit/sweep/sampling/monte_carlo.rs"]
mod tests;
