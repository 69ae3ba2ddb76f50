//! Joints, drives, springs and loads, by way of the registry.

use std::borrow::Cow;
use std::sync::Arc;

use lissom_mechanics::elements::{self, Attached, ElementKind, LOADS, SPRINGS};
use lissom_mechanics::joints::{self, Build, JointKind};
use lissom_mechanics::kinematics::{CoordinateId, Quantity, Subject};
use lissom_mechanics::registry::{Function, Parameter, ParameterType, Parameters, Value};
use lissom_mechanics::signals::Argument;
use lissom_system::{Builder, JointAttachment, PlaceOnTip};

use super::names::{Names, parameter_problem};
use super::order::by_name;
use super::ports;
use crate::document::{Component, Document, OnTip};
use crate::functions::Ramp;
use crate::text::report::Problem;

/// Adds all connections: joints between nodes first, then drives of their coordinates, then relations between them.
pub(super) fn add(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    problems: &mut Vec<Problem>,
) {
    let sorted_joints = by_name(&document.joints, |component| &component.name.value);
    let mut known: Vec<(&Component, &JointKind)> = Vec::new();
    for &component in &sorted_joints {
        match joints::KINDS.iter().find(|kind| kind.name == component.kind.value) {
            Some(kind) => known.push((component, kind)),
            None => problems.push(unknown_kind(component)),
        }
    }
    known.sort_by_key(|(_, kind)| kind.ports.level());
    for (component, kind) in known {
        name_functions("joint", component, builder);
        problems.extend(joint(document, (component, kind), builder, names).err());
    }
    super::signals::add(document, builder, names, problems);
    if !problems.is_empty() {
        // Expressions that refer to an unreadable signal would be wrong as well.
        return;
    }
    for component in sorted_joints {
        let latched = super::latches::add(document, component, builder, names);
        problems.extend([friction(component, builder, names), latched].into_iter().filter_map(Result::err));
    }
    for (components, kinds, is_load) in [(&document.springs, SPRINGS, false), (&document.loads, LOADS, true)]
    {
        for component in by_name(components, |component| &component.name.value) {
            let Some(kind) = kinds.iter().find(|kind| kind.name == component.kind.value) else {
                problems.push(unknown_kind(component));
                continue;
            };
            name_functions(if is_load { "load" } else { "spring" }, component, builder);
            let ramp = document.analysis.ramp.then_some((document.analysis.start, document.analysis.end));
            let ramp = ramp.filter(|_| is_load);
            if let Err(problem) = element(document, (component, kind), (&mut *builder, &mut *names), ramp) {
                problems.push(problem);
            }
        }
    }
    for entry in by_name(&document.local_loads, |entry| &entry.name.value) {
        match super::local_loads::add(document, entry, names, builder) {
            Ok(points) => drop(names.local_loads.insert(entry.name.value.clone(), points)),
            Err(problem) => problems.push(problem),
        }
    }
    for entry in by_name(&document.contacts, |entry| &entry.name.value) {
        problems.extend(super::contacts::add(document, entry, names, builder).err());
    }
    super::measurements::bind(document, builder, names, problems);
}

/// Lets failures name the functions of time of a component.
fn name_functions(what: &'static str, component: &Component, builder: &mut Builder) {
    for (parameter, function) in
        component.parameters.functions().filter(|(_, function)| !function.is_constant())
    {
        let subject = Subject::new(what, &component.name.value).component(&format!("`{parameter}`"));
        builder.name_function(subject, Function::clone(function));
    }
}

fn unknown_kind(component: &Component) -> Problem {
    Problem::error(component.kind.span, format!("unknown kind `{}`", component.kind.value))
}

fn joint(
    document: &Document,
    (component, kind): (&Component, &JointKind),
    builder: &mut Builder,
    names: &mut Names,
) -> Result<(), Problem> {
    let name = &component.name.value;
    let (coordinates, parameters) = match super::couplings::equation(document, component, builder, names)? {
        Some((coordinates, parameters)) => (coordinates, Cow::Owned(parameters)),
        None => (ports::coordinates(component, builder, names)?, Cow::Borrowed(&component.parameters)),
    };
    if matches!(kind.build, Build::MeanOfSet) {
        let (nodes, shares) = ports::set_and_node(component, names)?;
        let attachment = JointAttachment { nodes, shares, ..JointAttachment::default() };
        let added = builder.add_joint_of_kind(name, kind, attachment, &parameters);
        return added.map(drop).map_err(|error| parameter_problem(component, &error));
    }
    let mut all = Vec::new();
    for nodes in ports::of_sets(component, builder, names)? {
        if let [(base, _), (tip, _)] = nodes[..]
            && base == tip
        {
            let message = format!("joint `{name}` joins a node with itself");
            return Err(Problem::error(component.name.span, message)
                .help("beams that share a node are joined already"));
        }
        let place = (nodes, coordinates.clone());
        all.extend(joint_between(document, (component, kind), place, &parameters, (builder, names))?);
    }
    // A relation has no coordinates.
    if !kind.ports.relate_coordinates() {
        names.coordinates.insert(name.clone(), all);
    }
    Ok(())
}

fn joint_between(
    document: &Document,
    (component, kind): (&Component, &JointKind),
    (nodes, coordinates): (ports::NodesOfJoint, Vec<CoordinateId>),
    parameters: &Parameters,
    (builder, names): (&mut Builder, &Names),
) -> Result<Vec<CoordinateId>, Problem> {
    let on_tip = component.on_tip.as_ref().map(|place| &place.value);
    let attachment = JointAttachment {
        nodes,
        axes: component.attachment.axes.iter().map(|axis| axis.value).collect(),
        on_tip: on_tip.map(|&OnTip { at, axis, second_axis }| PlaceOnTip { at, axis, second_axis }),
        coordinates,
        beams: ports::beam_chain(document, component, builder, names)?,
        ..JointAttachment::default()
    };
    builder
        .add_joint_of_kind(&component.name.value, kind, attachment, parameters)
        .map_err(|error| parameter_problem(component, &error))
}

/// Adds the friction of a joint with one coordinate.
fn friction(component: &Component, builder: &mut Builder, names: &mut Names) -> Result<(), Problem> {
    let Some(friction) = &component.friction else { return Ok(()) };
    let name = &component.name.value;
    let coordinates = names.coordinates.get(name).map_or(&[][..], Vec::as_slice);
    let [coordinate] = coordinates else {
        let message = match coordinates.len() {
            0 => format!("joint `{name}` has no relative coordinate for friction to act on"),
            count => format!("joint `{name}` has {count} coordinates: which has this friction?"),
        };
        let help = "add springs of the kinds torsional_friction and axial_friction on its coordinates";
        return Err(Problem::error(friction.span, message).help(help));
    };
    let wanted = builder.coordinate_quantity(*coordinate);
    let kinds = [elements::friction::TORSIONAL, elements::friction::AXIAL];
    let Some(kind) = kinds.iter().find(|kind| kind.ports.quantity() == Some(wanted)) else {
        return Err(Problem::error(friction.span, format!("joint `{name}` can have no friction")));
    };
    let element = builder
        .add_of_kind(kind, Attached::to_coordinates([*coordinate]), &friction.value)
        .map_err(|error| Problem::error(friction.span, format!("friction of joint `{name}`: {error}")))?;
    names.powers.extend(element.map(|element| (name.clone(), vec![element])));
    Ok(())
}

fn element(
    document: &Document,
    (component, kind): (&Component, &ElementKind),
    (builder, names): (&mut Builder, &mut Names),
    ramp: Option<(f64, f64)>,
) -> Result<(), Problem> {
    if let Some(spread) = ports::spread(component, builder, names)? {
        return spread_load(document, (component, kind), spread, (builder, names), ramp);
    }
    let attached = ports::attached(component, builder, names)?;
    let coordinate = kind.ports.quantity().and_then(|_| attached.coordinates.first().copied());
    // A size that depends on the motion is no constant load.
    let ramp = ramp.filter(|_| component.signal.is_none());
    let ramped = ramp.and_then(|span| ramped_parameters(kind, &component.parameters, span));
    let parameters = ramped.as_ref().unwrap_or(&component.parameters);
    let with_inputs = with_inputs(kind, parameters, component, names)?;
    let parameters = with_inputs.as_ref().unwrap_or(parameters);
    let fault = |error| parameter_problem(component, &error);
    let latches = builder.latch_count();
    let element = match &component.signal {
        None => builder.add_of_kind(kind, attached, parameters).map_err(fault)?,
        Some((key, formula)) => {
            let subject = Subject::new("load", &component.name.value).component(&format!("`{key}`"));
            let signal = super::signals::add_formula(document, builder, names, &subject, formula)?;
            let load = kind.contribution(builder.model(), attached, parameters).map_err(fault)?;
            builder.add_driven(signal, load)
        }
    };
    if builder.latch_count() > latches {
        names.latches.insert(component.name.value.clone(), latches);
    }
    let is_spring = SPRINGS.iter().any(|spring| spring.name == kind.name);
    names.powers.extend(element.map(|element| (component.name.value.clone(), vec![element])));
    names.actuators.extend(coordinate.filter(|_| !is_spring).map(|coordinate| (coordinate, element)));
    if let Some(element) = element.filter(|_| is_spring) {
        let quantity = kind.ports.quantity().unwrap_or(Quantity::Length);
        names.springs.insert(component.name.value.clone(), (element, quantity));
    }
    Ok(())
}

/// Adds a force or a moment on a set of nodes, to each its share.
fn spread_load(
    document: &Document,
    (component, kind): (&Component, &ElementKind),
    spread: Vec<(Attached, f64)>,
    (builder, names): (&mut Builder, &mut Names),
    ramp: Option<(f64, f64)>,
) -> Result<(), Problem> {
    let fault = |error| parameter_problem(component, &error);
    let Ok(whole) = component.parameters.vector("vector") else {
        let message = format!("`{}` cannot act on a set of nodes", component.name.value);
        let help = "forces and moments are spread over sets; name one node, or clamp a body to the set";
        return Err(Problem::error(component.name.span, message).help(help));
    };
    let ramped = ramp.filter(|_| component.signal.is_none());
    let ramped = ramped.and_then(|span| ramped_parameters(kind, &component.parameters, span));
    let mut parameters = ramped.unwrap_or_else(|| component.parameters.clone());
    let signal = match &component.signal {
        None => None,
        Some((key, formula)) => {
            let subject = Subject::new("load", &component.name.value).component(&format!("`{key}`"));
            Some(super::signals::add_formula(document, builder, names, &subject, formula)?)
        }
    };
    let mut elements = Vec::new();
    for (attached, share) in spread {
        parameters.insert("vector", Value::Vector(share * whole));
        match signal {
            None => elements.extend(builder.add_of_kind(kind, attached, &parameters).map_err(fault)?),
            Some(signal) => {
                let load = kind.contribution(builder.model(), attached, &parameters).map_err(fault)?;
                elements.extend(builder.add_driven(signal, load));
            }
        }
    }
    if !elements.is_empty() {
        names.powers.insert(component.name.value.clone(), elements);
    }
    Ok(())
}

/// The parameters with inputs in the place of their names; none where no input is named.
fn with_inputs(
    kind: &ElementKind,
    given: &Parameters,
    component: &Component,
    names: &Names,
) -> Result<Option<Parameters>, Problem> {
    let mut parameters: Option<Parameters> = None;
    for Parameter { name, .. } in kind.parameters.iter().filter(|own| own.holds == ParameterType::Input) {
        let word = given.word(name).map_err(|error| parameter_problem(component, &error))?;
        let Some(Argument::Held(held)) = names.signals.get(word) else {
            let message = format!("`{name}` of `{}` names no input", component.name.value);
            return Err(Problem::error(component.span_of(name), message));
        };
        parameters.get_or_insert_with(|| given.clone()).insert(name, Value::Input(*held));
    }
    Ok(parameters)
}

/// The parameters of a load with its constant sizes growing from nothing over `span` [s]; none where nothing changes.
fn ramped_parameters(kind: &ElementKind, given: &Parameters, span: (f64, f64)) -> Option<Parameters> {
    let mut parameters: Option<Parameters> = None;
    let holds_size =
        |parameter: &&Parameter| matches!(parameter.holds, ParameterType::Function | ParameterType::Size);
    for parameter in kind.parameters.iter().filter(holds_size) {
        let constant = given.function(parameter.name).ok().filter(|function| function.is_constant());
        if let Some(constant) = constant {
            let ramp: Function = Arc::new(Ramp { value: constant.value(span.0), span });
            parameters.get_or_insert_with(|| given.clone()).insert(parameter.name, Value::Function(ramp));
        }
    }
    parameters
}
