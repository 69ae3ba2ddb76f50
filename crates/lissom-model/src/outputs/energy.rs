//! Energies of the whole model.

use std::sync::Arc;

use lissom_system::OutputDerivatives;

use super::derivatives::{add_scaled, of_slopes};
use super::{Build, Evaluation, OutputQuantity, WHOLE_MODEL};
use crate::outputs::kinds::{Declaration, Feature, Subject};

/// Registry entry.
pub(crate) const ENERGY: Declaration = Declaration {
    word: "energy",
    summary: "Kinetic, strain, gravity and total energy of the model.",
    subject: Subject::Model,
    features: &[Feature::Velocities],
    components: &[("kinetic", "J"), ("strain", "J"), ("potential", "J"), ("total", "J")],
    build: Build::System(WHOLE_MODEL, |_, _, _| Ok(Arc::new(Energy))),
};
struct Energy;

impl OutputQuantity for Energy {
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        let energy = at.system.energy_of(at.state);
        out.extend([energy.kinetic, energy.strain, energy.potential, energy.total()]);
    }

    fn derivatives(&self, at: &Evaluation<'_>, _: f64) -> Option<Vec<OutputDerivatives>> {
        let mut all = at.system.energy_slopes(at.motion()).each_ref().map(of_slopes).to_vec();
        let mut total = OutputDerivatives::default();
        for own in &all {
            add_scaled(&mut total, own, 1.0);
        }
        all.push(total);
        Some(all)
    }
}
