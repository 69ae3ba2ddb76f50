//! The short form of a latch: expands to an input, an event that sets it, and one that releases it.

use std::sync::Arc;

use lissom_mechanics::elements::{self, Attached};
use lissom_mechanics::kinematics::Subject;
use lissom_mechanics::registry::{Parameters, Value};
use lissom_mechanics::signals::coordinate::{Coordinate, Of};
use lissom_mechanics::signals::event::{Direction, Event};
use lissom_mechanics::signals::{Argument, Function, Signal};
use lissom_system::Builder;

use super::names::Names;
use super::straight_line::Line;
use crate::document::{Component, Document};
use crate::text::report::Problem;

/// Adds the latch of a joint that has one.
pub(super) fn add(
    document: &Document,
    component: &Component,
    builder: &mut Builder,
    names: &mut Names,
) -> Result<(), Problem> {
    let name = &component.name.value;
    let Some(span) =
        component.latch.as_ref().map(|at| at.span).or(component.release.as_ref().map(|release| release.span))
    else {
        return Ok(());
    };
    let coordinates = names.coordinates.get(name).map_or(&[][..], Vec::as_slice);
    let &[coordinate] = coordinates else {
        let message = match coordinates.len() {
            0 => format!("joint `{name}` has no relative coordinate for a latch"),
            count => format!("joint `{name}` has {count} coordinates: which is latched?"),
        };
        let help = "add springs of the kinds torsional_latch and axial_latch on its coordinates, and events that set their inputs";
        return Err(Problem::error(span, message).help(help));
    };
    let wanted = builder.coordinate_quantity(coordinate);
    let kinds = [elements::latch::TORSIONAL, elements::latch::AXIAL];
    let Some(kind) = kinds.iter().find(|kind| kind.ports.quantity() == Some(wanted)) else {
        return Err(Problem::error(span, format!("joint `{name}` can have no latch")));
    };
    let start = if component.latch.is_some() { 0.0 } else { 1.0 };
    let engaged = builder.add_held(&format!("{name}, latched"), start);
    let fault = |error| Problem::error(span, format!("latch of joint `{name}`: {error}"));
    let parameters = Parameters::new().with("engaged", Value::Input(engaged));
    builder.add_of_kind(kind, Attached::to_coordinates([coordinate]), &parameters).map_err(fault)?;
    // A released latch does not engage again, although its coordinate starts from the position at which it was locked.
    let released = builder.add_held(&format!("{name}, released"), 0.0);
    let becomes = |builder: &mut Builder, line: Line| {
        let signal = Signal {
            subject: Subject::new("joint", name).component("latch"),
            text: String::new(),
            function: Function::Own(Arc::new(line)),
            arguments: vec![Argument::Held(released)],
            sampling: None,
        };
        builder.add_signal(signal).map_err(fault)
    };
    if let Some(at) = &component.latch {
        let measured = builder.add_measurement(Coordinate::new(coordinate, Of::Value));
        let root = Signal {
            subject: Subject::new("joint", name).component("latch"),
            text: format!("{name} - {}", at.value),
            function: Function::Own(Arc::new(Line { at_zero: -at.value, slope: 1.0 })),
            arguments: vec![Argument::Measured(measured)],
            sampling: None,
        };
        let root = builder.add_signal(root).map_err(fault)?;
        let sets = vec![(engaged, becomes(builder, Line { at_zero: 1.0, slope: -1.0 })?)];
        let event =
            Event { name: format!("{name}, latch"), root, direction: Direction::Both, stops: false, sets };
        builder.add_event(event).map_err(fault)?;
    }
    if let Some(release) = &component.release {
        let what = Subject::new("joint", name).component("`release`");
        let root = super::signals::add_formula(document, builder, names, &what, release)?;
        let constant = |value| Line { at_zero: value, slope: 0.0 };
        let sets =
            vec![(engaged, becomes(builder, constant(0.0))?), (released, becomes(builder, constant(1.0))?)];
        let event = Event {
            name: format!("{name}, release"),
            root,
            direction: Direction::Rising,
            stops: false,
            sets,
        };
        builder.add_event(event).map_err(fault)?;
    }
    Ok(())
}
