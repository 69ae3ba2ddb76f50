//! All combinations of the values; the last path varies fastest.

use super::{Draw, SamplingKind};
use crate::sweep::MAX_MEMBERS;

pub(super) const KIND: SamplingKind = SamplingKind {
    name: "grid",
    summary: "All combinations of the values; the last path varies fastest.",
    draw: Draw::Indices(indices),
};

fn indices(counts: &[usize]) -> Result<Vec<usize>, String> {
    let product = counts.iter().try_fold(1_usize, |product, count| product.checked_mul(*count));
    let members = product
        .filter(|members| *members <= MAX_MEMBERS)
        .ok_or_else(|| format!("the grid has more than {MAX_MEMBERS} members"))?;
    let mut all = vec![0; members * counts.len()];
    for member in 0..members {
        let mut rest = member;
        for path in (0..counts.len()).rev() {
            all[member * counts.len() + path] = rest % counts[path];
            rest /= counts[path];
        }
    }
    Ok(all)
}

#[cfg(test)]
#[path = "../../../tests/unit/sweep/sampling/grid.rs"]
mod tests;
