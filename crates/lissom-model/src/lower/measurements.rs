//! Components of outputs and of joints' coordinates that expressions name, as measurements.

use lissom_core::kinematics::{CoordinateId, GROUND, NodeId};
use lissom_core::signals::coordinate::Coordinate;
use lissom_core::signals::{MeasurementId, point, rotation};
use lissom_core::system::Builder;
use lissom_motion::Vector3;

use super::Names;
use super::signals::relative_components;
use crate::document::{Document, Feature, NodeReference, Output, OutputKind, OutputSource, interface_name};
use crate::suggest;

/// Why a name cannot be measured.
pub(super) struct Fault {
    pub(super) message: String,
    pub(super) help: Option<String>,
}

fn fault<T>(message: String, help: Option<String>) -> Result<T, Fault> {
    Err(Fault { message, help })
}

/// Adds the measurement of a component of an output, or of a joint where no output is called so.
pub(super) fn measure(
    document: &Document,
    builder: &mut Builder,
    names: &Names,
    owner: &str,
    component: &str,
) -> Result<MeasurementId, Fault> {
    let output = document.outputs.iter().find(|output| output.name.value == owner);
    let coordinates = names.coordinates.get(owner);
    match (output, coordinates) {
        (Some(output), None) => of_output(output, builder, names, component),
        (None, Some(coordinates)) => of_coordinates(owner, coordinates, builder, component),
        (Some(output), Some(coordinates)) => {
            let same = matches!((&output.kind, &output.source),
                (OutputKind::Relative, OutputSource::Joint(joint)) if joint.value == owner);
            let is_of_joint =
                relative_components(coordinates, builder).iter().any(|(known, ..)| known == component);
            if is_of_joint && !same {
                let message = format!("`{owner}.{component}` may mean the joint or the output `{owner}`");
                return fault(message, Some("give the output another name".to_owned()));
            }
            if is_of_joint {
                of_coordinates(owner, coordinates, builder, component)
            } else {
                of_output(output, builder, names, component)
            }
        }
        (None, None) => {
            let known: Vec<&str> = (document.outputs.iter().map(|output| output.name.value.as_str()))
                .chain(names.coordinates.keys().map(String::as_str))
                .collect();
            let help = suggest::help(owner, known);
            fault(format!("there is no output or joint called `{owner}`"), help)
        }
    }
}

fn unknown_component<T>(owner: &str, component: &str, known: &[String]) -> Result<T, Fault> {
    let message = format!("`{owner}` has no component `{component}`");
    fault(message, suggest::help(component, known.iter().map(String::as_str)))
}

fn of_coordinates(
    owner: &str,
    coordinates: &[CoordinateId],
    builder: &mut Builder,
    component: &str,
) -> Result<MeasurementId, Fault> {
    let components = relative_components(coordinates, builder);
    if components.is_empty() {
        return fault(format!("joint `{owner}` has no relative coordinate"), None);
    }
    if let Some((_, coordinate, of)) = components.iter().find(|(known, ..)| known == component) {
        return Ok(builder.add_measurement(Coordinate::new(*coordinate, *of)));
    }
    let known: Vec<String> = components.into_iter().map(|(known, ..)| known).collect();
    unknown_component(owner, component, &known)
}

fn of_output(
    output: &Output,
    builder: &mut Builder,
    names: &Names,
    component: &str,
) -> Result<MeasurementId, Fault> {
    let owner = &output.name.value;
    if output.seen_in.is_some() || output.relative_to.is_some() {
        let message = format!("`{owner}` is expressed in moving axes, which signals cannot depend on");
        return fault(message, Some("name an output without `in` and `relative_to`".to_owned()));
    }
    match output.kind {
        OutputKind::Relative => {
            let OutputSource::Joint(joint) = &output.source else {
                return fault(format!("output `{owner}` belongs to no joint"), None);
            };
            let coordinates = names.coordinates.get(&joint.value).map_or(&[][..], Vec::as_slice);
            return of_coordinates(owner, coordinates, builder, component);
        }
        OutputKind::Signal => {
            let message = format!("output `{owner}` records a signal");
            return fault(message, Some("name the signal itself".to_owned()));
        }
        kind if !kind.has(Feature::Measurable) => return not_measurable(owner, kind),
        _ => {}
    }
    let words = output.kind.components().iter().map(|(word, _)| (*word).to_owned());
    let words: Vec<String> = words.collect();
    let Some(index) = words.iter().position(|word| word == component) else {
        return unknown_component(owner, component, &words);
    };
    let OutputSource::Node { node, point } = &output.source else {
        return fault(format!("output `{owner}` belongs to no node"), None);
    };
    let (node, offset) = carried(owner, &node.value, point.as_ref(), builder, names)?;
    let frame = builder.initial_frame(node);
    let axis = Vector3::ith(index, 1.0);
    let point = |of| point::Point::new(node, offset, axis, of);
    Ok(match output.kind {
        OutputKind::Rotation => {
            let of = rotation::Of::RotationFrom(frame.rotation);
            builder.add_measurement(rotation::Turn::new(node, axis, of))
        }
        OutputKind::AngularVelocity => {
            builder.add_measurement(rotation::Turn::new(node, axis, rotation::Of::AngularVelocity))
        }
        OutputKind::Velocity => builder.add_measurement(point(point::Of::Velocity)),
        OutputKind::Displacement => {
            builder.add_measurement(point(point::Of::PositionFrom(frame.transform_point(&offset))))
        }
        OutputKind::Position => builder.add_measurement(point(point::Of::PositionFrom(Vector3::zeros()))),
        kind => return not_measurable(owner, kind),
    })
}

fn not_measurable<T>(owner: &str, kind: OutputKind) -> Result<T, Fault> {
    let message = format!("`{owner}` is a {}, which signals cannot depend on", kind.name());
    let measurable = OutputKind::all().filter(|kind| kind.has(Feature::Measurable));
    let words: Vec<&str> = measurable.map(OutputKind::name).collect();
    let help = format!("name a joint, or an output of one of these kinds: {}", words.join(", "));
    fault(message, Some(help))
}

/// The node that carries an output's place, and the place in its axes [m].
fn carried(
    owner: &str,
    node: &NodeReference,
    point: Option<&Vector3>,
    builder: &Builder,
    names: &Names,
) -> Result<(NodeId, Vector3), Fault> {
    let unknown = |name: &str| Fault { message: format!("there is no part called `{name}`"), help: None };
    let at = |node: NodeId| {
        point.map_or_else(Vector3::zeros, |point| builder.initial_frame(node).inverse_transform_point(point))
    };
    match node {
        NodeReference::Ground => Ok((GROUND, at(GROUND))),
        NodeReference::Body(name) | NodeReference::PointMass(name) => {
            names.nodes.get(name).map(|&node| (node, at(node))).ok_or_else(|| unknown(name))
        }
        NodeReference::Interface { superelement, interface } => {
            let name = interface_name(superelement, interface);
            names.nodes.get(&name).map(|&node| (node, at(node))).ok_or_else(|| unknown(&name))
        }
        NodeReference::Beam { beam, fraction } => {
            let line = names.lines.get(beam).ok_or_else(|| unknown(beam))?;
            let Some(node) = line.node_at(*fraction) else {
                let message = format!("`{owner}` lies between nodes of beam `{beam}`");
                let help =
                    "measure at a node, such as the beam's start or end, or change the number of elements";
                return fault(message, Some(help.to_owned()));
            };
            // The node may be another part's: the section's place counts.
            let index = line.nodes.iter().position(|&other| other == node).unwrap_or(0);
            Ok((node, if point.is_some() { at(node) } else { line.offsets[index].position }))
        }
    }
}
