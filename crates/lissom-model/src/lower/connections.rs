//! Joints, drives, springs and loads, by way of the registry.

use std::sync::Arc;

use lissom_core::elements::{self, Attached, ElementKind, LOADS, SPRINGS};
use lissom_core::joints::{self, Build, JointKind};
use lissom_core::kinematics::{CoordinateId, NodeId, Quantity, Subject};
use lissom_core::registry::{Function, Parameter, ParameterType, Parameters, Value};
use lissom_core::signals::Argument;
use lissom_core::signals::coordinate::Of;
use lissom_core::system::{Builder, PlaceOnTip, Placement};
use lissom_motion::Vector3;

use super::order::by_name;
use super::{Names, parameter_problem};
use crate::document::{Attachment, Component, CoordinateName, Document, NodeReference, OnTip};
use crate::functions::Ramp;
use crate::report::{Located, Problem};

/// Adds all connections: joints between nodes first, then drives of their coordinates, then relations between them.
pub(super) fn add(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    problems: &mut Vec<Problem>,
) {
    let sorted_joints = by_name(&document.joints, |component| &component.name.value);
    for order in 0..3 {
        for &component in &sorted_joints {
            let Some(kind) = joints::KINDS.iter().find(|kind| kind.name == component.kind.value) else {
                problems.push(unknown_kind(component));
                continue;
            };
            let own = match kind.build {
                Build::Relative(..) | Build::Motion | Build::Free(_) | Build::AlongBeams => 0,
                Build::Coordinate(..) => 1,
                Build::Coupling(..) => 2,
            };
            if own == order {
                name_functions("joint", component, builder);
            }
            if own == order
                && let Err(problem) = joint(document, (component, kind), builder, names)
            {
                problems.push(problem);
            }
        }
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
    for entry in by_name(&document.contacts, |entry| &entry.name.value) {
        let nodes = entry.between.each_ref().map(|part| names.node(part));
        let [base, tip] = nodes;
        let added = base.and_then(|base| Ok([base, tip?]));
        match added.and_then(|nodes| super::contacts::add(document, entry, nodes, builder)) {
            Ok(points) => drop(names.contacts.insert(entry.name.value.clone(), points)),
            Err(problem) => problems.push(problem),
        }
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
    let fault = |error| parameter_problem(component, &error);
    let placement = match &component.attachment {
        Attachment::JointCoordinate { joint } => {
            let wanted = match kind.build {
                Build::Coordinate(wanted, _) => wanted,
                _ => Quantity::Angle,
            };
            let coordinate = coordinate(component, joint, wanted, builder, names)?;
            builder.add_drive(name, kind, coordinate, &component.parameters).map_err(fault)?;
            names.coordinates.insert(name.clone(), vec![coordinate]);
            return Ok(());
        }
        Attachment::TwoNodes { base, tip, at, axis, second_axis } => Placement {
            nodes: [names.node(base)?, names.node(tip)?],
            at: *at,
            at_tip: None,
            axis: axis.as_ref().map(|axis| axis.value),
            second_axis: second_axis.as_ref().map(|axis| axis.value),
        },
        Attachment::TwoPlaces { base, tip, at_base, at_tip } => Placement {
            nodes: [names.node(base)?, names.node(tip)?],
            at: *at_base,
            at_tip: Some(*at_tip),
            axis: None,
            second_axis: None,
        },
        Attachment::AlongBeams { beams, tip, at } => {
            return super::sliders::add(document, component, (beams, tip, at), (builder, names));
        }
        Attachment::Nothing => {
            let coordinates =
                builder.add_free_coordinates(name, kind, &component.parameters).map_err(fault)?;
            names.coordinates.insert(name.clone(), coordinates);
            return Ok(());
        }
        Attachment::Places(..) | Attachment::Coordinates(_) => {
            let message = format!("joint `{name}` joins two nodes, not positions");
            return Err(Problem::error(component.name.span, message));
        }
        Attachment::OneNode { on, .. } => {
            return Err(Problem::error(on.span, format!("joint `{name}` needs two nodes")));
        }
        Attachment::JointCoordinates { .. } | Attachment::NamedCoordinates => {
            return super::couplings::add(document, (component, kind), builder, names);
        }
    };
    if placement.nodes[0] == placement.nodes[1] {
        return Err(Problem::error(component.name.span, format!("joint `{name}` joins a node with itself"))
            .help("beams that share a node are joined already"));
    }
    let on_tip = component.on_tip.as_ref().map(|place| &place.value);
    let on_tip = on_tip.map(|&OnTip { at, axis, second_axis }| PlaceOnTip { at, axis, second_axis });
    let placed = (&placement, on_tip.as_ref());
    let parameters = &component.parameters;
    let added = match kind.build {
        Build::Motion if on_tip.is_some() => {
            let message = format!("the motion `{name}` begins where the parts are placed");
            return Err(
                Problem::error(component.name.span, message).help("leave out what is said of the tip")
            );
        }
        Build::Motion => builder.add_motion(name, &placement, parameters),
        _ => builder.add_joint_apart(name, kind, placed, parameters),
    };
    let coordinates = added.map_err(fault)?;
    names.coordinates.insert(name.clone(), coordinates);
    Ok(())
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
    let Some(kind) = kinds.iter().find(|kind| kind.attachment == elements::Attachment::Coordinate(wanted))
    else {
        return Err(Problem::error(friction.span, format!("joint `{name}` can have no friction")));
    };
    let element = builder
        .add_of_kind(kind, Attached::Coordinate(*coordinate), &friction.value)
        .map_err(|error| Problem::error(friction.span, format!("friction of joint `{name}`: {error}")))?;
    names.powers.extend(element.map(|element| (name.clone(), element)));
    Ok(())
}

/// Joint coordinate on which a drive or a spring acts: the specified one, or the first of the required kind.
fn coordinate(
    component: &Component,
    joint: &Located<String>,
    wanted: Quantity,
    builder: &Builder,
    names: &Names,
) -> Result<CoordinateId, Problem> {
    let coordinates = names.coordinates.get(&joint.value).map_or(&[][..], Vec::as_slice);
    let fits = |coordinate: &CoordinateId| builder.coordinate_quantity(*coordinate) == wanted;
    let Some(first) = coordinates.iter().position(fits) else {
        let message = format!("joint `{}` has no relative {}", joint.value, wanted.relative());
        let kinds = match wanted {
            Quantity::Angle => {
                "a revolute, universal, swing_arm, cylindrical, screw, planar or parallel_axes joint"
            }
            Quantity::Length | Quantity::State => {
                "a prismatic, cylindrical or point_on_line joint, or generalized coordinates"
            }
        };
        return Err(Problem::error(joint.span, message)
            .label("nothing to act on")
            .help(format!("name {kinds}")));
    };
    let number = component
        .parameters
        .number_or("coordinate", (first + 1) as f64)
        .map_err(|error| parameter_problem(component, &error))?;
    numbered(component, joint, ("coordinate", number), coordinates)
}

/// The coordinate of a joint that the number of a key means, counted from 1 on.
pub(super) fn numbered(
    component: &Component,
    joint: &Located<String>,
    (key, number): (&str, f64),
    coordinates: &[CoordinateId],
) -> Result<CoordinateId, Problem> {
    let index = number as usize;
    if index as f64 != number || index == 0 || index > coordinates.len() {
        let message = format!("joint `{}` has no coordinate {number}", joint.value);
        return Err(Problem::error(component.span_of(key), message)
            .help(format!("give a whole number from 1 to {}", coordinates.len())));
    }
    Ok(coordinates[index - 1])
}

/// The coordinates that a list of joints and of coordinates of joints means.
fn all_of(
    component: &Component,
    listed: &[CoordinateName],
    builder: &Builder,
    names: &Names,
) -> Result<Vec<CoordinateId>, Problem> {
    let mut all: Vec<CoordinateId> = Vec::new();
    for (joint, word) in listed {
        let own = names.coordinates.get(&joint.value).map_or(&[][..], Vec::as_slice);
        let components = super::signals::relative_components(own, builder);
        let found: Vec<CoordinateId> = match word {
            None => own.to_vec(),
            Some(word) => {
                let named = components.iter().filter(|(known, _, of)| known == word && *of == Of::Value);
                named.map(|(_, coordinate, _)| *coordinate).collect()
            }
        };
        if found.is_empty() {
            let values = components.iter().filter(|(.., of)| *of == Of::Value);
            let known: Vec<&str> = values.map(|(known, ..)| known.as_str()).collect();
            let message = match word {
                Some(word) => format!("joint `{}` has no coordinate `{word}`", joint.value),
                None => format!("joint `{}` has no relative coordinate", joint.value),
            };
            let help = (!known.is_empty()).then(|| format!("it has {}", known.join(", ")));
            return Err(Problem::error(joint.span, message).maybe_help(help));
        }
        if let Some(twice) = found.iter().find(|coordinate| all.contains(coordinate)) {
            let name = builder.coordinate_name(*twice);
            let message = format!("`{}` names the coordinate `{name}` twice", component.name.value);
            return Err(Problem::error(joint.span, message).help("name each coordinate once"));
        }
        all.extend(found);
    }
    Ok(all)
}

fn element(
    document: &Document,
    (component, kind): (&Component, &ElementKind),
    (builder, names): (&mut Builder, &mut Names),
    ramp: Option<(f64, f64)>,
) -> Result<(), Problem> {
    let local = |builder: &Builder, node: NodeId, place: &Vector3| {
        builder.initial_frame(node).inverse_transform_point(place)
    };
    let attached = match &component.attachment {
        Attachment::OneNode { on, at } => {
            let node = names.node(on)?;
            Attached::OneNode(node, local(builder, node, at))
        }
        Attachment::Places(along, drums) => {
            let place = |(on, at): &(Located<NodeReference>, Vector3)| {
                let node = names.node(on)?;
                Ok((node, local(builder, node, at)))
            };
            let places = along.iter().map(place).collect::<Result<_, Problem>>()?;
            Attached::Places(places, all_of(component, drums, builder, names)?)
        }
        Attachment::TwoPlaces { base, tip, at_base, at_tip } => {
            let nodes = [names.node(base)?, names.node(tip)?];
            Attached::TwoNodes(nodes, [local(builder, nodes[0], at_base), local(builder, nodes[1], at_tip)])
        }
        Attachment::TwoNodes { base, tip, at, .. } => {
            let nodes = [names.node(base)?, names.node(tip)?];
            Attached::TwoNodes(nodes, nodes.map(|node| local(builder, node, at)))
        }
        Attachment::JointCoordinates { joint: on, .. } => {
            return Err(Problem::error(
                on.span,
                format!("`{}` acts on one coordinate", component.name.value),
            ));
        }
        Attachment::Coordinates(listed) => Attached::Coordinates(all_of(component, listed, builder, names)?),
        Attachment::NamedCoordinates | Attachment::Nothing | Attachment::AlongBeams { .. } => {
            let message = format!("`{}` acts on nothing", component.name.value);
            return Err(Problem::error(component.name.span, message));
        }
        Attachment::JointCoordinate { joint } => {
            let wanted = match kind.attachment {
                elements::Attachment::Coordinate(wanted) => wanted,
                _ => Quantity::Angle,
            };
            Attached::Coordinate(coordinate(component, joint, wanted, builder, names)?)
        }
    };
    let coordinate = if let Attached::Coordinate(coordinate) = attached { Some(coordinate) } else { None };
    // A size that depends on the motion is no constant load.
    let ramp = ramp.filter(|_| component.signal.is_none());
    let ramped = ramp.and_then(|span| ramped(kind, &component.parameters, span));
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
            let load = (kind.build)(builder.model(), attached, parameters).map_err(fault)?;
            builder.add_driven(signal, load)
        }
    };
    if builder.latch_count() > latches {
        names.latches.insert(component.name.value.clone(), latches);
    }
    let is_spring = SPRINGS.iter().any(|spring| spring.name == kind.name);
    names.powers.extend(element.map(|element| (component.name.value.clone(), element)));
    names.actuators.extend(coordinate.filter(|_| !is_spring).map(|coordinate| (coordinate, element)));
    if let Some(element) = element.filter(|_| is_spring) {
        let quantity = match kind.attachment {
            elements::Attachment::Coordinate(quantity) => quantity,
            _ => Quantity::Length,
        };
        names.springs.insert(component.name.value.clone(), (element, quantity));
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
        let Some(Argument::Held(held)) = word.and_then(|word| names.signals.get(word)) else {
            let message = format!("`{name}` of `{}` names no input", component.name.value);
            return Err(Problem::error(component.span_of(name), message));
        };
        parameters.get_or_insert_with(|| given.clone()).insert(name, Value::Input(*held));
    }
    Ok(parameters)
}

/// The parameters of a load with its constant sizes growing from nothing over `span` [s]; none where nothing changes.
fn ramped(kind: &ElementKind, given: &Parameters, span: (f64, f64)) -> Option<Parameters> {
    let mut parameters: Option<Parameters> = None;
    let holds_size =
        |parameter: &&Parameter| matches!(parameter.holds, ParameterType::Function | ParameterType::Size);
    for parameter in kind.parameters.iter().filter(holds_size) {
        let constant = given.function_or(parameter.name, 1.0).ok().filter(|function| function.is_constant());
        if let Some(constant) = constant {
            let ramp: Function = Arc::new(Ramp { value: constant.value(span.0), span });
            parameters.get_or_insert_with(|| given.clone()).insert(parameter.name, Value::Function(ramp));
        }
    }
    parameters
}
