//! Values side by side: member k has the k-th value of every path.

use super::{Draw, SamplingKind};

pub(super) const KIND: SamplingKind = SamplingKind {
    name: "list",
    summary: "Member k has the k-th value of every path; all lists have the same length.",
    draw: Draw::Indices(indices),
};

fn indices(counts: &[usize]) -> Result<Vec<usize>, String> {
    let members = counts.first().copied().unwrap_or(0);
    if let Some(other) = counts.iter().find(|count| **count != members) {
        return Err(format!(
            "all lists must have the same number of values, not {members} for one path and {other} for another"
        ));
    }
    Ok((0..members).flat_map(|member| counts.iter().map(move |_| member)).collect())
}

#[cfg(test)]
#[path = "../../../tests/unit/sweep/sampling/list.rs"]
mod tests;
