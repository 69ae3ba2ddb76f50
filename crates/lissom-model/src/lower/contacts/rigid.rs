//! Rigid contacts: the points of the solids that may touch, and the events at which their modes change.

use std::sync::Arc;

use lissom_contact::rigid::{RigidContact, RigidLaw};
use lissom_contact::rigid_friction::{ContactGuard, Guard};
use lissom_mechanics::kinematics::Subject;
use lissom_mechanics::registry::ParameterError;
use lissom_mechanics::signals::event::{Direction, Event};
use lissom_mechanics::signals::{Argument, Function, Signal};
use lissom_system::Builder;

use super::super::names::Names;
use super::super::straight_line::Line;
use super::pairs::points_of_solids;
use crate::document::{ContactEntry, Document};
use crate::outputs::contact_point::RigidPoint;
use crate::text::report::Problem;

/// Adds a rigid contact.
pub(super) fn add(
    document: &Document,
    (entry, law): (&ContactEntry, RigidLaw),
    names: &Names,
    builder: &mut Builder,
) -> Result<Vec<RigidPoint>, Problem> {
    let name = &entry.name.value;
    let mut all: Vec<RigidPoint> = Vec::new();
    for point in points_of_solids(document, entry, names)? {
        let own = if all.is_empty() { name.clone() } else { format!("{name} {}", all.len() + 1) };
        let contact = builder.add_rigid_contact(&own, point.frames, point.pair, law);
        guards(&contact, builder)
            .map_err(|error| Problem::error(entry.name.span, format!("contact `{name}`: {error}")))?;
        all.push(RigidPoint { contact, sign: point.sign });
    }
    Ok(all)
}

/// The events at which its mode may change.
fn guards(contact: &Arc<RigidContact>, builder: &mut Builder) -> Result<(), ParameterError> {
    let all = [
        (Guard::Touch, "touch", "gap"),
        (Guard::Release, "release", "normal force"),
        (Guard::Slip, "slip", "friction"),
    ];
    for (guard, word, text) in all {
        if guard == Guard::Slip && !contact.has_friction() {
            continue;
        }
        let measured = builder.add_measurement(ContactGuard::new(Arc::clone(contact), guard));
        let root = builder.add_signal(Signal {
            subject: Subject::new("contact", &contact.name).component(word),
            text: text.to_owned(),
            function: Function::Own(Arc::new(Line { at_zero: 0.0, slope: 1.0 })),
            arguments: vec![Argument::Measured(measured)],
            sampling: None,
        })?;
        builder.add_contact_event(Event {
            name: format!("{}, {word}", contact.name),
            root,
            direction: Direction::Falling,
            stops: false,
            sets: Vec::new(),
        })?;
    }
    Ok(())
}
