//! Units of other programs. Those with samples have held values for inputs and outputs. Those with equations have states, and signals for
//! their inputs and for each of their values: a group of values that depend on the same inputs is added where it is first named, after
//! the signals that these inputs name.

use lissom_mechanics::kinematics::Subject;
use lissom_mechanics::signals::coordinate::{Coordinate, Of};
use lissom_mechanics::signals::event::{Direction, Event};
use lissom_mechanics::signals::unit_ports::{Coupling, EquationPorts, SampledPorts, UnitPorts, UnitValue};
use lissom_mechanics::signals::{Argument, DiscreteValueId, Function, Sampling, Signal, SignalId};
use lissom_system::Builder;

use super::names::Names;
use super::signal_references::AddedUnit;
use super::signals::{Reader, add_formula, formula};
use crate::document::{Document, UnitEntry, UnitEquations};
use crate::text::report::Problem;

/// Adds what expressions may name before the unit is added: outputs at samples, or states. Its `index` is among all units.
pub(super) fn declare(builder: &mut Builder, names: &mut Names, index: usize, unit: &UnitEntry) {
    let Some(equations) = &unit.equations else {
        for (output, _) in &unit.outputs {
            let name = unit.output_name(output);
            let held = builder.add_reading(&name);
            names.signals.insert(name, Argument::Held(held));
        }
        return;
    };
    let name = &unit.name.value;
    let (mut states, mut arguments) = (Vec::new(), Vec::new());
    for (state, magnitude) in &equations.states {
        // The unit has the values at the start.
        let coordinate = builder.add_state(&format!("{name}.{state}"), 0.0, *magnitude);
        states.push(coordinate);
        let measured = builder.add_measurement(Coordinate::new(coordinate, Of::Value));
        arguments.push(Argument::Measured(measured));
    }
    let added = AddedUnit {
        index,
        states,
        arguments,
        inputs: vec![None; unit.inputs.len()],
        groups: vec![None; equations.groups.len()],
        open: Vec::new(),
    };
    names.references.units.insert(name.clone(), added);
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
    let Some(equations) = &unit.equations else { return Ok(()) };
    let Some(added) = names.references.units.get_mut(name) else { return Ok(()) };
    if added.groups[group].is_some() {
        return Ok(());
    }
    if added.open.contains(&group) {
        let message = format!("outputs of the unit `{name}` form an algebraic loop through its inputs");
        return Err(Problem::error(unit.name.span, message)
            .help("let the input depend on a state, a delayed or a sampled signal instead of the output"));
    }
    added.open.push(group);
    let (index_of_unit, mut arguments) = (added.index, added.arguments.clone());
    let members = &equations.groups[group];
    for &index in &members.inputs {
        let signal = input(document, builder, names, (unit, index))?;
        arguments.push(Argument::Signal(signal));
    }
    let own = members.outputs.iter().map(|&output| unit.outputs[output].0.clone());
    let (states, indicators) =
        if members.has_derivatives { (&*equations.states, equations.indicators) } else { (&[][..], 0) };
    let derivatives = states.iter().map(|(state, _)| format!("der({state})"));
    let all =
        own.chain(derivatives).chain((1..=indicators).map(|number| format!("event indicator {number}")));
    let mut signals = Vec::new();
    for (index, what) in all.enumerate() {
        let signal = Signal {
            subject: Subject::new("unit", name).component(&what),
            text: "a value of the unit".to_owned(),
            function: Function::OfUnit(UnitValue { unit: index_of_unit, group, index }),
            arguments: arguments.clone(),
            sampling: None,
        };
        let signal = builder.add_signal(signal);
        signals.push(signal.map_err(|error| Problem::error(unit.name.span, error.to_string()))?);
    }
    for (&output, &signal) in members.outputs.iter().zip(&signals) {
        names.signals.insert(unit.output_name(&unit.outputs[output].0), Argument::Signal(signal));
    }
    if let Some(added) = names.references.units.get_mut(name) {
        added.groups[group] = Some(signals);
        added.open.retain(|open| *open != group);
    }
    Ok(())
}

fn subject_of_input(unit: &UnitEntry, index: usize) -> Subject {
    let variable = &unit.inputs[index].0.value;
    Subject::new("unit", &unit.name.value).component(&format!("`inputs.{variable}`"))
}

/// The signal of an input, which is added if it is not there.
fn input(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    (unit, index): (&UnitEntry, usize),
) -> Result<SignalId, Problem> {
    let name = &unit.name.value;
    let known = names.references.units.get(name).and_then(|added| added.inputs[index]);
    if let Some(signal) = known {
        return Ok(signal);
    }
    let subject = subject_of_input(unit, index);
    let signal = add_formula(document, builder, names, &subject, &unit.inputs[index].1)?;
    if let Some(added) = names.references.units.get_mut(name) {
        added.inputs[index] = Some(signal);
    }
    Ok(signal)
}

/// Adds a unit after all signals.
///
/// # Errors
/// As [`add_group`].
pub(super) fn add(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    unit: &UnitEntry,
) -> Result<(), Problem> {
    let coupling = match &unit.equations {
        Some(equations) => Coupling::Equations(add_equations(document, builder, names, (unit, equations))?),
        None => Coupling::Sampled(add_samples(document, builder, names, unit)?),
    };
    builder.add_unit(UnitPorts { name: unit.name.value.clone(), coupling });
    Ok(())
}

/// Adds the inputs of a sampled unit.
fn add_samples(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    unit: &UnitEntry,
) -> Result<SampledPorts, Problem> {
    let mut inputs = Vec::new();
    let Some(period) = unit.sample.map(|sample| sample.value) else {
        let message = format!("the unit `{}` lacks `sample`", unit.name.value);
        return Err(Problem::error(unit.name.span, message).help("add `sample`, its step in seconds"));
    };
    for (index, (_, expression)) in unit.inputs.iter().enumerate() {
        let subject = subject_of_input(unit, index);
        let reader = Reader { subject: &subject, expression, is_sampled: true, own_sample: None };
        let (signal, _) = formula(document, builder, names, &reader)?;
        let held = builder.add_held(&subject.to_string(), 0.0);
        let sampling = Some(Sampling { held, period });
        builder
            .add_signal(Signal { sampling, ..signal })
            .map_err(|error| Problem::error(expression.span, error.to_string()))?;
        inputs.push(held);
    }
    let held = |output: &String| -> Option<(DiscreteValueId, String)> {
        match names.signals.get(&unit.output_name(output)) {
            Some(&Argument::Held(held)) => Some((held, output.clone())),
            _ => None,
        }
    };
    let outputs = unit.outputs.iter().filter_map(|(output, _)| held(output)).collect();
    Ok(SampledPorts { period, inputs, outputs })
}

/// Adds all groups of a unit with equations, derivatives of states, and events.
fn add_equations(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    (unit, equations): (&UnitEntry, &UnitEquations),
) -> Result<EquationPorts, Problem> {
    let name = &unit.name.value;
    for group in 0..equations.groups.len() {
        add_group(document, builder, names, (unit, group))?;
    }
    // Events may depend on inputs on which no value between them depends.
    let inputs = (0..unit.inputs.len()).map(|index| input(document, builder, names, (unit, index)));
    let inputs = inputs.collect::<Result<_, _>>()?;
    let first = builder.event_count();
    let (states, groups) = names
        .references
        .units
        .remove(name)
        .map_or_else(Default::default, |added| (added.states, added.groups));
    for (members, signals) in equations.groups.iter().zip(groups.into_iter().flatten()) {
        if !members.has_derivatives {
            continue;
        }
        let mut signals = signals.into_iter().skip(members.outputs.len());
        for (&state, signal) in states.iter().zip(&mut signals) {
            builder.drive_state(state, signal);
        }
        for (index, root) in signals.enumerate() {
            let name = format!("{name}.indicator{}", index + 1);
            let event = Event { name, root, direction: Direction::Both, stops: false, sets: Vec::new() };
            builder.add_event(event).map_err(|error| Problem::error(unit.name.span, error.to_string()))?;
        }
    }
    Ok(EquationPorts { states, inputs, indicators: first..builder.event_count() })
}
