//! Whether the motion crosses singular positions of closed loops.

use super::monitor::{Accepted, Beginning, Monitor};
use crate::bytes::{from_bytes, to_bytes};
use crate::consistent::singular_positions::SingularPositions;
use crate::errors::StepError;
use crate::errors::{Warning, warn};
use crate::kinematics::Kinematics;
use crate::settings::Problem;

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let system = beginning.problem.system;
    let singular =
        SingularPositions::new(system, &beginning.state.kinematics, beginning.representative.length);
    (!singular.is_empty()).then(|| Box::new(singular) as Box<dyn Monitor>)
}

impl Monitor for SingularPositions {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        let Problem { system, settings } = step.problem;
        let (before, at) = (&step.start.kinematics, &step.end.kinematics);
        let representative = &step.integrator.representative;
        // Load steps have no velocities; each is checked.
        let way = if settings.scheme.dynamic && representative.length > 0.0 {
            representative.largest_speed(system, at) / representative.length * (at.time - before.time)
        } else {
            f64::INFINITY
        };
        if let Some(warning) = self.look(system, at, way) {
            warn(warnings, warning);
        }
    }

    fn cause(&mut self, problem: Problem<'_>, at: &Kinematics, time: f64) -> Option<StepError> {
        let (joints, beside) = self.closest(problem.system, at)?;
        Some(StepError::LoopIsSingular { time, joints, beside: beside.to_degrees() })
    }

    fn save(&self) -> Vec<u8> {
        to_bytes(&self.known)
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        let mut known = Vec::new();
        let is_read = from_bytes(saved, &mut known) && known.len() == self.known.len();
        if is_read {
            self.known = known;
        }
        is_read
    }
}
