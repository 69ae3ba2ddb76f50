//! Units with equations: their states, and signals for their inputs and for each of their values. A group of values that depend on the
//! same inputs is added where it is first named, after the signals that these inputs name.

use std::sync::Arc;

use lissom_mechanics::kinematics::Subject;
use lissom_mechanics::signals::coordinate::{Coordinate, Of};
use lissom_mechanics::signals::event::{Direction, Event};
use lissom_mechanics::signals::exchange::{ExchangedUnit, UnitSlot, UnitValue};
use lissom_mechanics::signals::{Argument, Signal, SignalId};
use lissom_system::Builder;

use super::names::Names;
use super::signal_references::AddedUnit;
use super::signals::add_formula;
use crate::document::{Document, ExchangePorts, UnitEntry};
use crate::text::report::Problem;

/// Adds the states of a unit.
pub(super) fn add_states(builder: &mut Builder, names: &mut Names, unit: &UnitEntry, ports: &ExchangePorts) {
    let name = &unit.name.value;
    let (mut states, mut arguments) = (Vec::new(), Vec::new());
    for (state, magnitude) in &ports.states {
        // The unit has the values at the start.
        let coordinate = builder.add_state(&format!("{name}.{state}"), 0.0, *magnitude);
        states.push(coordinate);
        let measured = builder.add_measurement(Coordinate::new(coordinate, Of::Value));
        arguments.push(Argument::Measured(measured));
    }
    let added = AddedUnit {
        slot: Arc::new(UnitSlot::new(name)),
        states,
        arguments,
        inputs: vec![None; unit.inputs.len()],
        groups: vec![None; ports.groups.len()],
        open: Vec::new(),
    };
    names.references.exchanged.insert(name.clone(), added);
}

/// Adds the signals of a group of values, if they are not added, and of the inputs on which they depend.
///
/// # Errors
/// If an expression is wrong, or the group depends on itself.
pub(super) fn add_group(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    (unit, group): (&UnitEntry, usize),
) -> Result<(), Problem> {
    let name = &unit.name.value;
    let Some(ports) = &unit.exchange else { return Ok(()) };
    let Some(added) = names.references.exchanged.get_mut(name) else { return Ok(()) };
    if added.groups[group].is_some() {
        return Ok(());
    }
    if added.open.contains(&group) {
        let message = format!("outputs of the unit `{name}` form an algebraic loop through its inputs");
        return Err(Problem::error(unit.name.span, message)
            .help("let the input depend on a state, a delayed or a sampled signal instead of the output"));
    }
    added.open.push(group);
    let mut arguments = added.arguments.clone();
    let members = &ports.groups[group];
    for &index in &members.inputs {
        let signal = input(document, builder, names, (unit, index))?;
        arguments.push(Argument::Signal(signal));
    }
    let own = members.outputs.iter().map(|&output| unit.outputs[output].0.clone());
    let (states, indicators) =
        if members.has_derivatives { (&*ports.states, ports.indicators) } else { (&[][..], 0) };
    let derivatives = states.iter().map(|(state, _)| format!("der({state})"));
    let all =
        own.chain(derivatives).chain((1..=indicators).map(|number| format!("event indicator {number}")));
    let mut signals = Vec::new();
    for (index, what) in all.enumerate() {
        let Some(added) = names.references.exchanged.get(name) else { break };
        let signal = Signal {
            subject: Subject::new("unit", name).component(&what),
            text: "a value of the unit".to_owned(),
            function: Arc::new(UnitValue { slot: Arc::clone(&added.slot), group, index }),
            arguments: arguments.clone(),
            sampling: None,
        };
        let signal = builder.add_signal(signal);
        signals.push(signal.map_err(|error| Problem::error(unit.name.span, error.to_string()))?);
    }
    for (&output, &signal) in members.outputs.iter().zip(&signals) {
        names.signals.insert(unit.output_name(&unit.outputs[output].0), Argument::Signal(signal));
    }
    if let Some(added) = names.references.exchanged.get_mut(name) {
        added.groups[group] = Some(signals);
        added.open.retain(|open| *open != group);
    }
    Ok(())
}

/// The signal of an input, which is added if it is not there.
fn input(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    (unit, index): (&UnitEntry, usize),
) -> Result<SignalId, Problem> {
    let name = &unit.name.value;
    let known = names.references.exchanged.get(name).and_then(|added| added.inputs[index]);
    if let Some(signal) = known {
        return Ok(signal);
    }
    let (variable, expression) = &unit.inputs[index];
    let subject = Subject::new("unit", name).component(&format!("`inputs.{}`", variable.value));
    let signal = add_formula(document, builder, names, &subject, expression)?;
    if let Some(added) = names.references.exchanged.get_mut(name) {
        added.inputs[index] = Some(signal);
    }
    Ok(signal)
}

/// Adds the rest of a unit: all groups, derivatives of states, and events.
///
/// # Errors
/// As [`add_group`].
pub(super) fn add_unit(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    unit: &UnitEntry,
) -> Result<(), Problem> {
    let name = &unit.name.value;
    let Some(ports) = &unit.exchange else { return Ok(()) };
    for group in 0..ports.groups.len() {
        add_group(document, builder, names, (unit, group))?;
    }
    // Events may depend on inputs on which no value between them depends.
    let inputs = (0..unit.inputs.len()).map(|index| input(document, builder, names, (unit, index)));
    let inputs = inputs.collect::<Result<_, _>>()?;
    let Some(added) = names.references.exchanged.get(name).cloned() else { return Ok(()) };
    let first = builder.event_count();
    for (members, signals) in ports.groups.iter().zip(added.groups.into_iter().flatten()) {
        if !members.has_derivatives {
            continue;
        }
        let mut signals = signals.into_iter().skip(members.outputs.len());
        for (&state, signal) in added.states.iter().zip(&mut signals) {
            builder.drive_state(state, signal);
        }
        for (index, root) in signals.enumerate() {
            let name = format!("{name}.indicator{}", index + 1);
            let event = Event { name, root, direction: Direction::Both, stops: false, sets: Vec::new() };
            builder.add_event(event).map_err(|error| Problem::error(unit.name.span, error.to_string()))?;
        }
    }
    builder.add_exchanged_unit(ExchangedUnit {
        slot: added.slot,
        states: added.states,
        inputs,
        indicators: first..builder.event_count(),
    });
    Ok(())
}
