//! Whether balls in hollows touch one side only: their contact has a force on the nearest side alone.

use super::monitor::{Accepted, Beginning, Monitor, NOTEWORTHY};
use crate::errors::{Warning, warn};
use crate::kinematics::{Kinematics, Subject};
use crate::system::System;

/// Reports the first contact that touches a second side. Has no state.
struct Hollows;

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let mut springs = beginning.problem.system.elements_with(|own| own.spring);
    let is_contact = springs.any(|spring| spring.least_elongation().is_some());
    is_contact.then(|| Box::new(Hollows) as Box<dyn Monitor>)
}

impl Monitor for Hollows {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        if let Some(warning) = in_hollow(step.problem.system, &step.end.kinematics) {
            warn(warnings, warning);
        }
    }
}

/// The first contact that neglects a second side: one that the force on the nearest side does not push it away from.
fn in_hollow(system: &System, at: &Kinematics) -> Option<Warning> {
    system.elements_with(|own| own.spring).find_map(|spring| {
        let (name, hollow) = spring.hollow(at)?;
        let is_neglected = hollow.remaining > NOTEWORTHY * hollow.depth;
        is_neglected.then(|| Warning::ContactInHollow {
            time: at.time,
            contact: Subject::new("contact", name),
            depth: hollow.remaining,
        })
    })
}
