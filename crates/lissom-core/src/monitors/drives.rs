//! Drives that jump: however short the step, a prescribed position that jumps is reached with an undefined speed.

use super::monitor::{Accepted, Beginning, Monitor};
use crate::errors::Warning;
use crate::errors::warn;
use crate::kinematics::{Kinematics, Quantity};
use crate::round_off;
use crate::scaling::Representative;
use crate::settings::Problem;
use crate::system::System;

/// A drive jumps if it moves in a step by more than this multiple of its larger rate at both ends times the step.
const MAX_RATIO: f64 = 2.0;

/// Has no state.
struct Drives;

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let Problem { system, settings } = beginning.problem;
    (settings.scheme.dynamic && !system.drives().is_empty()).then(|| Box::new(Drives) as Box<dyn Monitor>)
}

impl Monitor for Drives {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        let ends = (&step.start.kinematics, &step.end.kinematics);
        if let Some(warning) = jump(step.problem.system, &step.integrator.representative, ends) {
            warn(warnings, warning);
        }
    }
}

/// The first drive that jumps between two instants.
fn jump(
    system: &System,
    representative: &Representative,
    (from, to): (&Kinematics, &Kinematics),
) -> Option<Warning> {
    let elapsed = to.time - from.time;
    let quantities = system.layout().quantities();
    let jumping = system.drives().iter().find_map(|drive| {
        let function = &drive.prescribed.value;
        let way = (function.value(to.time) - function.value(from.time)).abs();
        let rate = function.first_derivative(from.time).abs().max(function.first_derivative(to.time).abs());
        let row = system.layout().row_of_coordinate(drive.prescribed.coordinate);
        let unit = if quantities[row] == Quantity::Length { representative.length } else { 1.0 };
        (way > round_off::NEGLIGIBLE * unit && way > MAX_RATIO * elapsed * rate)
            .then(|| (drive.name.clone(), way))
    });
    jumping.map(|(drive, way)| Warning::DriveJumps { time: to.time, drive, way })
}
