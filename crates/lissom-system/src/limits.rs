//! Elements beyond their limits.

use std::sync::Arc;

use lissom_mechanics::elements::{Limit, LimitKind, Validity};
use lissom_mechanics::evaluation::batch::AnyBatch;
use lissom_mechanics::kinematics::{GROUND, Kinematics};

use super::System;

impl System {
    /// All elements of kinds with a kind of limits.
    pub fn elements_with_limit(&self, kind: LimitKind) -> impl Iterator<Item = &dyn Validity> {
        let has = move |batch: &&Arc<dyn AnyBatch>| {
            batch.capabilities().validity.is_some_and(|own| own.limits().contains(&kind))
        };
        self.batches.iter().filter(has).flat_map(|batch| batch.elements_with(|own| own.validity))
    }

    /// The element that exceeds a multiple of its limit of a kind most, in a step between two configurations.
    pub fn exceeded<'s>(
        &'s self,
        (kind, multiple): (LimitKind, f64),
        step: [&'s Kinematics; 2],
    ) -> Option<(&'s dyn Validity, Limit<'s>)> {
        let limits = self.elements_with_limit(kind).filter_map(|own| Some((own, own.limit(kind, step)?)));
        let beyond = limits.filter(|(_, own)| own.value > multiple * own.limit);
        beyond.reduce(
            |most, own| {
                if own.1.value * most.1.limit > most.1.value * own.1.limit { own } else { most }
            },
        )
    }

    /// Names of the parts of an element.
    pub fn parts_of(&self, element: &dyn Validity) -> Vec<String> {
        let parts = element.unknowns().nodes.iter().filter(|&&node| node != GROUND);
        parts.map(|&node| self.layout().name_of_node(node).to_owned()).collect()
    }
}
