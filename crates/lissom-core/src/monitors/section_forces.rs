//! Whether the elements of a beam resolve the section forces that are recorded.

use super::monitor;
use super::monitor::{Accepted, Beginning, Monitor};
use super::sampled_steps::SampledSteps;
use crate::bytes::{read_bytes, to_bytes};
use crate::errors::{Warning, report_since};

/// Largest sizes and errors so far.
#[derive(Default)]
struct SectionForces {
    steps: SampledSteps,
    /// By section, of the axial and the shear force, or of the torsion and the bending moment.
    largest: Vec<[[f64; 2]; 2]>,
}

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let count = beginning.problem.system.beams.section_errors.len();
    let monitor = SectionForces { steps: SampledSteps::default(), largest: vec![[[0.0; 2]; 2]; count] };
    (count > 0).then(|| Box::new(monitor) as Box<dyn Monitor>)
}

impl Monitor for SectionForces {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        if !self.steps.is_due(step.problem.settings.scheme.dynamic) {
            return;
        }
        let at = &step.end.kinematics;
        let mut worst: Option<(f64, usize)> = None;
        let sections = &step.problem.system.beams.section_errors;
        for (index, (section, largest)) in sections.iter().zip(&mut self.largest).enumerate() {
            let Some(found) = section.of(at) else { continue };
            for (largest, found) in largest.iter_mut().zip(found) {
                largest.iter_mut().zip(found).for_each(|(largest, found)| *largest = largest.max(found));
            }
            let whole = largest[0][0].hypot(largest[1][0]);
            if whole == 0.0 {
                continue;
            }
            let part = largest
                .map(|[size, error]| error / size.max(monitor::MIN_FORCE * whole))
                .into_iter()
                .fold(0.0, f64::max);
            if worst.is_none_or(|(most, _)| part > most) {
                worst = Some((part, index));
            }
        }
        let Some((error, index)) = worst else { return };
        let (is_noteworthy, own) = (error > monitor::NOTEWORTHY, &sections[index]);
        let elements = own.element_count;
        report_since!(
            warnings,
            at.time,
            is_noteworthy,
            SectionForces { beam: own.beam.clone(), elements, error }
        );
    }

    fn save(&self) -> Vec<u8> {
        to_bytes(&(self.steps, &self.largest))
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        read_bytes(saved).map(|learned| (self.steps, self.largest) = learned).is_some()
    }
}
