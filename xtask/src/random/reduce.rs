//! Reduces a mechanism to the tables that a finding requires.

use super::mechanism::Mechanism;
use super::trial::{Finding, trial};

/// The mechanism with as few tables as show a finding of the same kind and scheme.
pub(super) fn reduced(mechanism: Mechanism, finding: &Finding) -> Mechanism {
    let scheme = |finding: &Finding| finding.words().split(':').next().unwrap_or_default().to_owned();
    let is_same = |other: &Finding| other.word() == finding.word() && scheme(other) == scheme(finding);
    let mut smallest = mechanism;
    let mut index = smallest.tables.len();
    while index > 0 {
        index -= 1;
        if ["[analysis]", "[outputs.energy]", "[outputs.momentum]"]
            .iter()
            .any(|head| smallest.tables[index].starts_with(head))
        {
            continue;
        }
        let mut trial_model = smallest.clone();
        trial_model.tables.remove(index);
        if trial(&trial_model).iter().any(is_same) {
            smallest = trial_model; // Tables that referred to the omitted one may now be omitted.
            index = smallest.tables.len().min(index + 3);
        }
    }
    smallest
}
