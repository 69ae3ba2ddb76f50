//! Energies of the whole model.

use std::sync::Arc;

use super::{Build, Evaluation, OutputQuantity, WITHOUT_GRADIENT};
use crate::document::{Declaration, Feature, Subject};

/// Registry entry.
pub(crate) const ENERGY: Declaration = Declaration {
    word: "energy",
    summary: "Kinetic, strain, gravity and total energy of the model.",
    subject: Subject::Model,
    features: &[Feature::Rates],
    components: &[("kinetic", "J"), ("strain", "J"), ("potential", "J"), ("total", "J")],
    build: Build::System(WITHOUT_GRADIENT, |_, _, _| Ok(Arc::new(Energy))),
};
struct Energy;

impl OutputQuantity for Energy {
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        let energy = at.system.energy(at.motion());
        out.extend([energy.kinetic, energy.strain, energy.potential, energy.total()]);
    }
}
