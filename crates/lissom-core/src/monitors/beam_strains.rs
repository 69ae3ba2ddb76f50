//! Whether beams are strained more than a beam can be.

use super::monitor::{Accepted, Beginning, Monitor};
use super::sampled_steps::SampledSteps;
use crate::bytes::{read_bytes, to_bytes};
use crate::errors::{Warning, report_since};

/// Strains of the line above this are reported [-].
const NOTEWORTHY: f64 = 0.1;

/// The largest strain so far.
#[derive(Default)]
struct BeamStrains {
    steps: SampledSteps,
    largest: f64,
}

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let has_beams = !beginning.problem.system.beams.elements.is_empty();
    has_beams.then(|| Box::<BeamStrains>::default() as Box<dyn Monitor>)
}

impl Monitor for BeamStrains {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        if !self.steps.is_due(step.problem.settings.scheme.dynamic) {
            return;
        }
        let at = &step.end.kinematics;
        for (beam, elements) in &step.problem.system.beams.elements {
            let strain = elements.iter().map(|element| element.largest_strain(at)).fold(0.0, f64::max);
            if strain > self.largest.max(NOTEWORTHY) {
                self.largest = strain;
                report_since!(warnings, at.time, true, LargeStrain { beam: beam.clone(), strain });
            }
        }
    }

    fn save(&self) -> Vec<u8> {
        to_bytes(&(self.steps, self.largest))
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        read_bytes(saved).map(|learned| (self.steps, self.largest) = learned).is_some()
    }
}
