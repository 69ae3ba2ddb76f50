//! Whether coordinates remain within the tables over them: what is beyond, such as after the turn of a cam, was not specified.

use super::monitor::{Accepted, Beginning, Monitor};
use crate::errors::{Warning, warn};
use crate::kinematics::Kinematics;
use crate::system::System;

/// Deviation from the range of a table that is round-off and digits of a text, relative to the range.
const ROUNDED: f64 = 1e-6;

/// Reports the first relation whose table is left. Has no state.
struct TableRanges;

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let mut couplings = beginning.problem.system.couplings().iter();
    couplings.any(|own| own.relation.domain().is_some()).then(|| Box::new(TableRanges) as Box<dyn Monitor>)
}

impl Monitor for TableRanges {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        if let Some(warning) = beyond(step.problem.system, &step.end.kinematics) {
            warn(warnings, warning);
        }
    }
}

/// The first relation whose table does not contain its coordinate.
fn beyond(system: &System, at: &Kinematics) -> Option<Warning> {
    system.couplings().iter().find_map(|coupling| {
        let [first, last] = coupling.relation.domain()?;
        let value = at.coordinates[*coupling.coordinates.first()?].value;
        let rounded = ROUNDED * (last - first);
        (value < first - rounded || value > last + rounded).then(|| Warning::BeyondTable {
            time: at.time,
            joint: coupling.name.clone(),
            value,
            first,
            last,
        })
    })
}
