//! Inputs, signals and states: resolves names in expressions to discrete values, earlier signals and measurements.

use std::collections::BTreeMap;
use std::sync::Arc;

use lissom_mechanics::kinematics::{CoordinateId, Quantity, Subject};
use lissom_mechanics::registry::ParameterError;
use lissom_mechanics::signals::coordinate::{Coordinate, Of};
use lissom_mechanics::signals::event::Event;
use lissom_mechanics::signals::{Argument, Function, Sampling, Signal, SignalId};
use lissom_system::Builder;

use super::delay;
use super::discrete_filter;
use super::measurements::{Fault, Measured, measure};
use super::names::Names;
use super::order::by_name;
use super::over_argument::OverArgument;
use super::signal_references::NamedComponent;
use super::units;
use crate::document::{Document, EventEntry, SignalEntry, UnitEntry};
use crate::expression::{Formula, Line, Name, OverTime};
use crate::format::suggest;
use crate::outputs::channel_components::coordinate_components;
use crate::outputs::entry::{Output, OutputSource};
use crate::parts::PREVIOUS_SAMPLE;
use crate::text::report::{Located, Problem};

/// Adds all inputs, signals and states.
pub(super) fn add(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    problems: &mut Vec<Problem>,
) {
    for (name, value) in by_name(&document.inputs, |(name, _)| &name.value) {
        let held = builder.add_held(&name.value, *value);
        names.signals.insert(name.value.clone(), Argument::Held(held));
    }
    for (index, unit) in by_name(&document.units, |unit| &unit.name.value).into_iter().enumerate() {
        units::declare(builder, names, index, unit);
    }
    let mut states = Vec::new();
    let sorted_states = by_name(&document.states, |state| &state.name.value);
    for state in &sorted_states {
        let (name, start, magnitude) = (&state.name.value, state.start, state.magnitude);
        let (coordinate, of) = if state.is_balance {
            (builder.add_unknown(name, start, magnitude), Of::Rate)
        } else {
            (builder.add_state(name, start, magnitude), Of::Value)
        };
        let measured = builder.add_measurement(Coordinate::new(coordinate, of));
        if let Some(subject) = &state.positive_of {
            builder.limit_below(subject.clone(), measured, 0.0);
        }
        names.signals.insert(state.name.value.clone(), Argument::Measured(measured));
        states.push(coordinate);
    }
    let mut delayed = Vec::new();
    for entry in by_name(&document.signals, |entry| &entry.name.value) {
        let Some(own) = &entry.delay else { continue };
        match delay::add(document, builder, names, (entry, own)) {
            Ok(signal) => delayed.push((entry, signal)),
            Err(problem) => problems.push(problem),
        }
    }
    if !problems.is_empty() {
        return;
    }
    let mut order = Order { document, marks: BTreeMap::new(), path: Vec::new(), sorted: Vec::new() };
    for entry in by_name(&document.signals, |entry| &entry.name.value) {
        if entry.delay.is_some() {
            continue;
        }
        if let Err(problem) = order.visit(entry) {
            problems.push(problem);
            // Expressions that refer to a signal of a loop would be wrong as well.
            return;
        }
    }
    let sorted = order.sorted;
    for (entry, (_, start)) in sorted.iter().filter_map(|entry| Some((entry, entry.sampling?))) {
        let held = builder.add_held(&entry.name.value, start);
        names.references.samples.insert(entry.name.value.clone(), held);
    }
    for entry in sorted {
        if let Err(problem) = add_signal(document, builder, names, entry) {
            problems.push(problem);
            // Later expressions that name it are not to be reported.
            let instead = builder.add_held(&entry.name.value, 0.0);
            names.signals.insert(entry.name.value.clone(), Argument::Held(instead));
        }
    }
    for entry in delayed {
        if let Err(problem) = delay::add_source(document, builder, names, entry) {
            problems.push(problem);
        }
    }
    if !problems.is_empty() {
        return;
    }
    for (state, coordinate) in sorted_states.into_iter().zip(states) {
        let subject = Subject::new("state", &state.name.value).component("`derivative`");
        match add_formula(document, builder, names, &subject, &state.derivative) {
            Ok(signal) if state.is_balance => builder.balance(coordinate, signal),
            Ok(signal) => builder.drive_state(coordinate, signal),
            Err(problem) => problems.push(problem),
        }
    }
    for unit in by_name(&document.units, |unit| &unit.name.value) {
        if let Err(problem) = units::add(document, builder, names, unit) {
            problems.push(problem);
        }
    }
    for event in by_name(&document.events, |event| &event.name.value) {
        if let Err(problem) = add_event(document, builder, names, event) {
            problems.push(problem);
        }
    }
}

fn add_event(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    entry: &EventEntry,
) -> Result<(), Problem> {
    let event = Subject::new("event", &entry.name.value);
    let what = event.clone().component("`zero_of`");
    let root = add_formula(document, builder, names, &what, &entry.zero_of)?;
    let mut sets = Vec::new();
    for (input, becomes) in &entry.set {
        let what = event.clone().component(&format!("`set.{}`", input.value));
        let signal = add_formula(document, builder, names, &what, becomes)?;
        if let Some(&Argument::Held(held)) = names.signals.get(&input.value) {
            sets.push((held, signal));
        }
    }
    let event =
        Event { name: entry.name.value.clone(), root, direction: entry.direction, stops: entry.stop, sets };
    builder.add_event(event).map_err(|error| Problem::error(entry.name.span, error.to_string()))
}

/// Sorts signals such that each follows those to which it refers.
struct Order<'d> {
    document: &'d Document,
    /// Whether a signal that was met is done.
    marks: BTreeMap<&'d str, bool>,
    path: Vec<&'d str>,
    sorted: Vec<&'d SignalEntry>,
}

impl<'d> Order<'d> {
    fn visit(&mut self, entry: &'d SignalEntry) -> Result<(), Problem> {
        let name = entry.name.value.as_str();
        match self.marks.get(name) {
            Some(true) => return Ok(()),
            Some(false) => return Err(self.a_loop(entry)),
            None => {}
        }
        self.marks.insert(name, false);
        self.path.push(name);
        for argument in entry.value.value.arguments() {
            let is_sampled = |name: &str| {
                self.document.signals.iter().any(|own| own.name.value == name && own.sampling.is_some())
            };
            if entry.sampling.is_some() && previous_sample(&argument.text, name).is_some_and(is_sampled) {
                continue;
            }
            let named = signals_named(self.document, &argument.text, &mut Vec::new());
            for named in named.into_iter().filter(|named| named.delay.is_none()) {
                self.visit(named)?;
            }
        }
        self.path.pop();
        self.marks.insert(name, true);
        self.sorted.push(entry);
        Ok(())
    }

    fn a_loop(&self, entry: &SignalEntry) -> Problem {
        let name = entry.name.value.as_str();
        let from = self.path.iter().position(|known| *known == name).unwrap_or(0);
        let names: Vec<String> =
            self.path[from..].iter().chain([&name]).map(|name| format!("`{name}`")).collect();
        let message = format!("signals form an algebraic loop: {}", names.join(" names "));
        Problem::error(entry.name.span, message).label("needs its own value").help(
            "make one of them a state, delay one, or use the previous sample of a sampled one: `NAME.last`",
        )
    }
}

/// The sampled signal whose previous sample a name means in the expression of the sampled signal `own`: `NAME.last`, or
/// its own name.
fn previous_sample<'n>(name: &'n str, own: &str) -> Option<&'n str> {
    if name == own {
        return Some(name);
    }
    name.rsplit_once('.').filter(|(_, component)| *component == PREVIOUS_SAMPLE).map(|(owner, _)| owner)
}

fn add_signal(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    entry: &SignalEntry,
) -> Result<(), Problem> {
    let name = &entry.name.value;
    let held = names.references.samples.get(name).copied();
    let own = entry.sampling.zip(held).map(|((period, start), held)| (Sampling { held, period }, start));
    let subject = Subject::new("signal", name).called(name);
    let reader = Reader {
        subject: &subject,
        expression: &entry.value,
        is_sampled: own.is_some(),
        own_sample: own.map(|_| name.as_str()),
    };
    let invalid = |error: ParameterError| Problem::error(entry.value.span, error.to_string());
    let (mut signal, line) = of_entry(document, builder, names, entry, (&reader, own.map(|own| own.0)))?;
    match (&entry.filter, own) {
        (Some(filter), Some(own)) => {
            signal = discrete_filter::filtered(builder, filter, signal, own).map_err(invalid)?;
        }
        _ => signal.sampling = own.map(|(own, _)| own),
    }
    let signal = builder.add_signal(signal).map_err(invalid)?;
    names.signals.insert(name.clone(), Argument::Signal(signal));
    // Between samples it is constant, with a value that is not known in advance.
    names.references.lines_of_time.extend(line.filter(|_| own.is_none()).map(|line| (signal, line)));
    Ok(())
}

/// The expression of a signal, or its table over one, and the straight line of time that it is.
pub(super) fn of_entry(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    entry: &SignalEntry,
    (reader, own): (&Reader<'_>, Option<Sampling>),
) -> Result<(Signal, Line), Problem> {
    let Some(table) = &entry.table else { return formula(document, builder, names, reader) };
    let invalid = |error: ParameterError| Problem::error(entry.value.span, error.to_string());
    let subject = Subject::new(reader.subject.kind.clone(), &entry.name.value).component("`of`");
    let (argument, line) = formula(document, builder, names, &Reader { subject: &subject, ..*reader })?;
    let text = format!("a table over {}", argument.text);
    // The argument of a sampled table is sampled as well: between samples it has no effect.
    let sampling = own.map(|own| Sampling { held: builder.add_held(&subject.to_string(), 0.0), ..own });
    let argument = builder.add_signal(Signal { sampling, ..argument }).map_err(invalid)?;
    let function = Function::Own(Arc::new(OverArgument::new(table.clone().into(), line)));
    let arguments = vec![Argument::Signal(argument)];
    Ok((Signal { subject: reader.subject.clone(), text, function, arguments, sampling: None }, None))
}

/// Adds an expression that has no name in the model file as a signal; messages are about `subject`.
pub(super) fn add_formula(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    subject: &Subject,
    expression: &Located<Formula>,
) -> Result<SignalId, Problem> {
    let reader = Reader { subject, expression, is_sampled: false, own_sample: None };
    let (signal, _) = formula(document, builder, names, &reader)?;
    builder.add_signal(signal).map_err(|error| Problem::error(expression.span, error.to_string()))
}

/// An expression that names quantities.
#[derive(Clone, Copy)]
pub(super) struct Reader<'a> {
    /// Subject of messages.
    pub(super) subject: &'a Subject,
    pub(super) expression: &'a Located<Formula>,
    /// Whether it is evaluated at samples alone.
    pub(super) is_sampled: bool,
    /// Name of the sampled signal whose expression it is.
    pub(super) own_sample: Option<&'a str>,
}

/// An expression as a signal, and the straight line of time that it is.
pub(super) fn formula(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    reader: &Reader<'_>,
) -> Result<(Signal, Line), Problem> {
    let Reader { subject, expression, .. } = *reader;
    let mut arguments = Vec::new();
    for argument in expression.value.arguments() {
        let previous = reader.own_sample.and_then(|own| previous_sample(&argument.text, own));
        arguments.push(match previous.and_then(|name| names.references.samples.get(name)) {
            Some(held) => Argument::Held(*held),
            None => resolve(document, builder, names, reader, argument)?,
        });
    }
    let line = |argument: &Argument| match argument {
        Argument::Signal(signal) => names.references.lines_of_time.get(signal).copied(),
        Argument::Held(_) | Argument::Measured(_) => None,
    };
    let lines: Vec<Line> = arguments.iter().map(line).collect();
    let function = OverTime::new(expression.value.clone(), &lines);
    let line = function.line();
    let signal = Signal {
        subject: subject.clone(),
        text: expression.value.text().to_owned(),
        function: Function::Own(Arc::new(function)),
        arguments,
        sampling: None,
    };
    Ok((signal, line))
}

/// Meaning of a name in an expression.
fn resolve(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    reader: &Reader<'_>,
    name: &Name,
) -> Result<Argument, Problem> {
    let Reader { subject: what, expression, is_sampled, .. } = *reader;
    if let Some(&known) = names.signals.get(&name.text) {
        return Ok(known);
    }
    let key = (name.text.clone(), is_sampled);
    if let Some(&known) = names.references.measured.get(&key) {
        return Ok(known);
    }
    let place = document.within(expression.span, expression.value.text(), &name.range);
    let problem =
        |message: String| Problem::error(place, format!("{what} cannot be read: {message}")).label("here");
    let Some((owner, component)) = name.text.rsplit_once('.') else {
        let (message, help) = unknown(document, names, &name.text);
        return Err(problem(message).maybe_help(help));
    };
    if component == PREVIOUS_SAMPLE
        && let Some(of) = document.signals.iter().find(|signal| signal.name.value == owner)
    {
        let (message, help) = if of.sampling.is_some() {
            let message = format!("`{}` is only known to sampled signals", name.text);
            (message, "add `sample` to the signal in whose expression it is".to_owned())
        } else {
            let message = format!("the signal `{owner}` is not sampled, so it has no previous sample");
            (message, format!("add `sample` to `{owner}`"))
        };
        return Err(problem(message).help(help));
    }
    if let Some(unit) = document.units.iter().find(|unit| unit.name.value == owner) {
        if let Some(group) = unit.group_of(component) {
            units::add_group(document, builder, names, (unit, group))?;
            return names.signals.get(&name.text).copied().ok_or_else(|| problem("it is unknown".to_owned()));
        }
        let help = suggest::help(component, unit.outputs.iter().map(|(output, _)| output.as_str()));
        let help =
            help.unwrap_or_else(|| format!("add it to `outputs` of the unit: {component} = \"VARIABLE\""));
        return Err(problem(format!("the unit `{owner}` has no output `{component}`")).help(help));
    }
    if let Some(part) = document.hydraulics.iter().find(|part| part.name.value == owner) {
        let help = suggest::help(component, part.components.iter().map(|(word, _)| *word));
        let message = format!("the hydraulic part `{owner}` has no component `{component}`");
        return Err(problem(message).maybe_help(help));
    }
    if let Some(of) = outputs_of_signals(document, owner) {
        let output = &of.name.value;
        if component != "value" {
            return Err(problem(format!("`{output}` has no component `{component}`"))
                .help("its only component is `value`"));
        }
        if names.references.open_expressions.contains(output) {
            return Err(problem(format!("the output `{output}` is an expression of itself"))
                .help("remove one of these names"));
        }
        names.references.open_expressions.push(output.clone());
        let found = output_value(document, builder, names, of, is_sampled);
        names.references.open_expressions.pop();
        let found =
            found.map_err(|fault| fault.unwrap_or_else(|| problem(format!("`{output}` is unknown"))))?;
        names.references.measured.insert(key, found);
        return Ok(found);
    }
    let measured = measure(document, builder, names, owner, component);
    let fault = match measured {
        Ok(Measured::By(measured)) => {
            names.references.measured.insert(key, Argument::Measured(measured));
            return Ok(Argument::Measured(measured));
        }
        Ok(Measured::Later) if !is_sampled => {
            let measurement = builder.add_later_measurement();
            names.references.later_measurements.push(NamedComponent {
                target: measurement,
                output: owner.to_owned(),
                component: component.to_owned(),
                place,
                reader: what.to_string(),
            });
            names.references.measured.insert(key, Argument::Measured(measurement));
            return Ok(Argument::Measured(measurement));
        }
        Ok(Measured::Later) => Fault { message: String::new(), help: None, is_of_solution: true },
        Err(fault) => fault,
    };
    if !(is_sampled && fault.is_of_solution) {
        return Err(problem(fault.message).maybe_help(fault.help));
    }
    let held = builder.add_reading(&name.text);
    names.references.readings.push(NamedComponent {
        target: held,
        output: owner.to_owned(),
        component: component.to_owned(),
        place,
        reader: what.to_string(),
    });
    names.references.measured.insert(key, Argument::Held(held));
    Ok(Argument::Held(held))
}

/// What is wrong with a name without a component that is unknown, and the remedy.
fn unknown(document: &Document, names: &Names, name: &str) -> (String, Option<String>) {
    let owners = document.outputs.iter().map(|output| output.name.value.as_str());
    let known = names.signals.keys().map(String::as_str).chain(["t", "pi"]);
    let known = known.chain(document.parameters.keys().map(String::as_str));
    let is_owner = owners.chain(names.coordinates.keys().map(String::as_str)).any(|owner| owner == name);
    let help = if is_owner {
        Some(format!("write a component, such as `{name}.rate` or `{name}.u1`"))
    } else {
        suggest::help(name, known)
    };
    (format!("unknown name `{name}`"), help)
}

/// The output of this name, if it is a signal or an expression.
fn outputs_of_signals<'d>(document: &'d Document, name: &str) -> Option<&'d Output> {
    let is_of_signals = |output: &&Output| {
        output.name.value == name
            && matches!(output.source, OutputSource::Signal(_) | OutputSource::Expression(_))
    };
    document.outputs.iter().find(is_of_signals)
}

/// Value of an output that is a signal or an expression; no problem where another one is reported of it.
fn output_value(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    output: &Output,
    is_sampled: bool,
) -> Result<Argument, Option<Problem>> {
    match &output.source {
        OutputSource::Signal(name) => {
            if let Some(of_unit) = group_named(document, &name.value) {
                units::add_group(document, builder, names, of_unit)?;
            }
            names.signals.get(&name.value).copied().ok_or(None)
        }
        OutputSource::Expression(expression) => {
            let subject = Subject::new("output", &output.name.value);
            let reader = Reader { subject: &subject, expression, is_sampled, own_sample: None };
            let (signal, line) = formula(document, builder, names, &reader)?;
            let signal = builder
                .add_signal(signal)
                .map_err(|error| Problem::error(expression.span, error.to_string()))?;
            names.references.lines_of_time.extend(line.map(|line| (signal, line)));
            Ok(Argument::Signal(signal))
        }
        _ => Err(None),
    }
}

/// The unit with equations and the group of the output that a name means.
fn group_named<'d>(document: &'d Document, name: &str) -> Option<(&'d UnitEntry, usize)> {
    let (owner, output) = name.rsplit_once('.')?;
    let unit = document.units.iter().find(|unit| unit.name.value == owner)?;
    Some((unit, unit.group_of(output)?))
}

/// The signals that a name in an expression means: one, or those that an output of signals or of a unit depends on.
pub(super) fn signals_named<'d>(
    document: &'d Document,
    name: &'d str,
    path: &mut Vec<&'d str>,
) -> Vec<&'d SignalEntry> {
    if let Some(own) = document.signals.iter().find(|other| other.name.value == name) {
        return vec![own];
    }
    if let Some((unit, group)) = group_named(document, name).filter(|_| !path.contains(&name)) {
        path.push(name);
        let groups = unit.equations.iter().map(|equations| &equations.groups[group]);
        let inputs = groups.flat_map(|group| &group.inputs).map(|&input| &unit.inputs[input].1.value);
        let arguments = inputs.flat_map(Formula::arguments);
        let found = arguments.flat_map(|argument| signals_named(document, &argument.text, path)).collect();
        path.pop();
        return found;
    }
    let owner = name.rsplit_once('.').and_then(|(owner, _)| outputs_of_signals(document, owner));
    let Some(output) = owner.filter(|output| !path.contains(&output.name.value.as_str())) else {
        return Vec::new();
    };
    path.push(&output.name.value);
    let found = match &output.source {
        OutputSource::Signal(of) => signals_named(document, &of.value, path),
        OutputSource::Expression(formula) => {
            let names = formula.value.arguments().iter();
            names.flat_map(|name| signals_named(document, &name.text, path)).collect()
        }
        _ => Vec::new(),
    };
    path.pop();
    found
}

/// Components of a joint's relative coordinates by the names that outputs have for them, and `rotation` for `angle`.
pub(super) fn relative_components(
    coordinates: &[CoordinateId],
    builder: &Builder,
) -> Vec<(String, CoordinateId, Of)> {
    let quantities: Vec<Quantity> =
        coordinates.iter().map(|&coordinate| builder.coordinate_quantity(coordinate)).collect();
    let mut components = Vec::new();
    for component in coordinate_components(&quantities) {
        let coordinate = coordinates[component.coordinate];
        let other = component.name.strip_prefix("angle").map(|number| format!("rotation{number}"));
        components.push((component.name, coordinate, component.of));
        components.extend(other.map(|name| (name, coordinate, component.of)));
    }
    components
}
