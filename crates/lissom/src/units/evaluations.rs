//! The last evaluations of a unit with equations: all loads, states, laws and records at one point share them.

use std::sync::Arc;

use lissom_core::units::{GroupPoint, UnitValues};

/// Largest number of evaluations that are kept: stages of a step, each with few groups. Values of one point are found while it is
/// iterated.
const MAX_KEPT: usize = 24;

/// The last evaluations, the oldest first.
#[derive(Debug, Default)]
pub(super) struct Evaluations {
    kept: Vec<Evaluation>,
}

#[derive(Debug)]
struct Evaluation {
    group: usize,
    time: f64,
    arguments: Vec<f64>,
    found: Arc<UnitValues>,
}

impl Evaluations {
    /// The values of a group at a point, with derivatives if these are required.
    pub(super) fn find(&self, at: GroupPoint<'_>, differentiates: bool) -> Option<Arc<UnitValues>> {
        let is_there = |own: &&Evaluation| {
            let is_complete = !differentiates || !own.found.derivatives.is_empty();
            own.group == at.group && own.time == at.time && own.arguments == at.arguments && is_complete
        };
        self.kept.iter().rev().find(is_there).map(|own| Arc::clone(&own.found))
    }

    /// Keeps values, and forgets the oldest ones if there are too many.
    pub(super) fn keep(&mut self, at: GroupPoint<'_>, found: &Arc<UnitValues>) {
        if self.kept.len() == MAX_KEPT {
            self.kept.remove(0);
        }
        let GroupPoint { group, time, arguments } = at;
        let (arguments, found) = (arguments.to_vec(), Arc::clone(found));
        self.kept.push(Evaluation { group, time, arguments, found });
    }

    /// Forgets all values.
    pub(super) fn clear(&mut self) {
        self.kept.clear();
    }
}
