//! Work that springs, loads, drives and friction have put into the rest of the model since the start.

use std::sync::Arc;

use lissom_system::accumulated::{AcceptedStep, Accumulated};

use super::Build;
use super::frames::name_of;
use super::power::{Actor, actor};
use crate::outputs::kinds::{Declaration, Feature, Subject};

/// Registry entry.
pub(crate) const WORK: Declaration = Declaration {
    word: "work",
    summary: "Work that a spring, a load, a drive or the friction of a joint has delivered to the rest of the model.",
    subject: Subject::Actor,
    features: &[Feature::Accumulated],
    components: &[("work", "J")],
    build: Build::Accumulated(|output, system, subjects| {
        let of = actor(name_of(output)?, system, subjects.names)?;
        Ok(Arc::new(Work { name: output.name.value.clone(), of }))
    }),
};
/// Work of what acts on a model.
struct Work {
    name: String,
    of: Actor,
}

impl Accumulated for Work {
    fn name(&self) -> &str {
        &self.name
    }

    fn depends_on_multipliers(&self) -> bool {
        matches!(self.of, Actor::Drive(_))
    }

    fn after(&self, step: &AcceptedStep<'_>, before: f64) -> f64 {
        let work = match &self.of {
            Actor::Elements(elements) => elements.iter().map(|&element| step.work_of_element(element)).sum(),
            Actor::Drive(drive) => step.work_of_drive(*drive),
            // It moves nothing while it is engaged.
            Actor::Latch(_) => 0.0,
        };
        before + work
    }
}
