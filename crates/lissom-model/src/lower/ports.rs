//! What components are attached to: nodes, coordinates and beams of the system for the ports of their kind.

use lissom_mechanics::elements::Attached;
use lissom_mechanics::joints::slider::CarriedPoint;
use lissom_mechanics::kinematics::{CoordinateId, NodeId, Quantity};
use lissom_mechanics::ports::PortType;
use lissom_mechanics::signals::coordinate::Of;
use lissom_motion::Vector3;
use lissom_system::{BeamChain, Builder};

use super::names::{Names, parameter_problem};
use crate::document::{Beam, Component, CoordinateName, Document, NodeLocation};
use crate::reading::node_reference::{MeshPlace, NodeReference};
use crate::text::report::{Located, Problem};

/// Cosine of the largest angle at which two beams of a chain may meet, 2 degrees: the line through their nodes is smooth.
const SMOOTH: f64 = 0.999_39;

/// Nodes with points in their axes, and coordinates.
pub(super) fn attached(component: &Component, builder: &Builder, names: &Names) -> Result<Attached, Problem> {
    let mut attached = Attached::to_coordinates(coordinates(component, builder, names)?);
    let listed = &component.attachment;
    let turning = listed.nodes.iter().filter(|own| own.sheave.is_some_and(|own| own.turns.is_some())).count();
    if turning > 0 {
        for own in &listed.coordinates[..turning] {
            let found = all_of(component, std::slice::from_ref(own), builder, names)?.len();
            if found != 1 {
                let message = format!("joint `{}` has {found} coordinates", own.0.value);
                let help = "name the one that turns the drum, such as \"axle.angle\"";
                return Err(Problem::error(own.0.span, message).help(help));
            }
        }
    }
    for (index, own) in listed.nodes.iter().enumerate() {
        attached.sheaves.extend(own.sheave.map(|sheave| (index, sheave)));
        let node = names.node(&own.node)?;
        let local = |at: Vector3| builder.initial_frame(node).inverse_transform_point(&at);
        attached.nodes.push((node, own.at.map_or_else(Vector3::zeros, local)));
    }
    Ok(attached)
}

/// Nodes of a joint, each with its location; none for that of the node.
pub(super) type NodesOfJoint = Vec<(NodeId, Option<Vector3>)>;

/// Nodes with their locations, once for each joint that the component stands for: a joint of a set of nodes is one for each of them, of
/// two sets one for each node of the tip and the nearest of the base.
pub(super) fn of_sets(
    component: &Component,
    builder: &Builder,
    names: &Names,
) -> Result<Vec<NodesOfJoint>, Problem> {
    let listed = &component.attachment.nodes;
    let found = listed.iter().map(|own| names.nodes(&own.node)).collect::<Result<Vec<_>, Problem>>()?;
    let is_set = |k: usize| found[k].len() > 1;
    let place = |node: NodeId| builder.initial_frame(node).position;
    let Some(leading) = (0..found.len()).rev().find(|&k| is_set(k)) else {
        // A set of one node has the location of its node.
        let is_set = |own: &&NodeLocation| {
            matches!(own.node.value, NodeReference::Mesh { place: MeshPlace::Set(_), .. })
        };
        let set = listed.iter().position(|own| is_set(&own)).map(|k| place(found[k][0].0));
        let one = |(own, nodes): (&NodeLocation, &Vec<(NodeId, f64)>)| (nodes[0].0, own.at.or(set));
        return Ok(vec![listed.iter().zip(&found).map(one).collect()]);
    };
    let at_node = |&(node, _): &(NodeId, f64)| {
        let here = place(node);
        let nearest = |nodes: &Vec<(NodeId, f64)>| {
            let distance = |&(other, _): &(NodeId, f64)| (place(other) - here).norm();
            nodes.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).map_or(node, |&(other, _)| other)
        };
        let mut nodes_of_joint = Vec::with_capacity(listed.len());
        for (k, (own, nodes)) in listed.iter().zip(&found).enumerate() {
            let own_node = if k == leading { node } else { nearest(nodes) };
            nodes_of_joint.push((own_node, own.at.or(Some(here))));
        }
        nodes_of_joint
    };
    Ok(found[leading].iter().map(at_node).collect())
}

/// The nodes of a component's set with their shares, and after them the one node that it also names.
pub(super) fn set_and_node(
    component: &Component,
    names: &Names,
) -> Result<(NodesOfJoint, Vec<f64>), Problem> {
    let [set, node] = component.attachment.nodes.as_slice() else { return Ok((Vec::new(), Vec::new())) };
    let (mut nodes, shares): (NodesOfJoint, Vec<f64>) =
        names.nodes(&set.node)?.into_iter().map(|(node, share)| ((node, None), share)).unzip();
    nodes.push((names.node(&node.node)?, None));
    Ok((nodes, shares))
}

/// Nodes of a set on which a component acts, each with its share; none if it acts on one node, or on something else.
pub(super) fn spread(
    component: &Component,
    builder: &Builder,
    names: &Names,
) -> Result<Option<Vec<(Attached, f64)>>, Problem> {
    let [own] = component.attachment.nodes.as_slice() else { return Ok(None) };
    let nodes = names.nodes(&own.node)?;
    if nodes.len() < 2 {
        return Ok(None);
    }
    let local = |node: NodeId| move |at: Vector3| builder.initial_frame(node).inverse_transform_point(&at);
    let of = |&(node, share): &(NodeId, f64)| {
        (Attached::to_nodes([(node, own.at.map_or_else(Vector3::zeros, local(node)))]), share)
    };
    Ok(Some(nodes.iter().map(of).collect()))
}

/// The coordinates of other joints that are named by keys.
pub(super) fn coordinates(
    component: &Component,
    builder: &Builder,
    names: &Names,
) -> Result<Vec<CoordinateId>, Problem> {
    let listed = &component.attachment.coordinates;
    if component.ports.joints() == 0 {
        return all_of(component, listed, builder, names);
    }
    let mut joints = listed.iter().map(|(joint, _)| joint);
    let mut all = Vec::new();
    for port in component.ports.0 {
        let found = match port.holds {
            PortType::Coordinate(wanted) => {
                joints.next().map(|joint| first(component, joint, wanted, builder, names))
            }
            PortType::OnlyCoordinate(number) => {
                joints.next().map(|joint| only(component, joint, number, names))
            }
            _ => None,
        };
        all.extend(found.transpose()?);
    }
    Ok(all)
}

/// Joint coordinate on which a drive or a spring acts: the specified one, or the first of the required kind.
fn first(
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
                "a prismatic, cylindrical, point_on_line or telescopic_rod joint, or generalized coordinates"
            }
        };
        return Err(Problem::error(joint.span, message)
            .label("nothing to act on")
            .help(format!("name {kinds}")));
    };
    // Those of one joint have different names.
    let mut of_joint: Vec<&str> = coordinates.iter().map(|&own| builder.coordinate_name(own)).collect();
    of_joint.sort_unstable();
    if of_joint.windows(2).any(|pair| pair[0] == pair[1]) && !component.parameters.has("coordinate") {
        let message = format!("joint `{}` consists of joints at each node of a set", joint.value);
        let help = "say which of them by `coordinate`, drive the edge by `prescribed_motion`, or clamp it to a body that has the joint";
        return Err(Problem::error(joint.span, message).label("several coordinates").help(help));
    }
    let number = component
        .parameters
        .number_or("coordinate", (first + 1) as f64)
        .map_err(|error| parameter_problem(component, &error))?;
    numbered(component, joint, ("coordinate", number), coordinates)
}

/// The coordinate of a joint that the number of a key means, counted from 1 on.
fn numbered(
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

/// The only coordinate of a joint, or the one specified by `key`.
fn only(
    component: &Component,
    joint: &Located<String>,
    key: &str,
    names: &Names,
) -> Result<CoordinateId, Problem> {
    let coordinates = names.coordinates.get(&joint.value).map_or(&[][..], Vec::as_slice);
    if coordinates.is_empty() {
        let message = format!("joint `{}` has no relative coordinate", joint.value);
        return Err(Problem::error(joint.span, message)
            .label("nothing to relate")
            .help("name a joint that has one, such as a revolute, screw, cylindrical or prismatic joint"));
    }
    if !component.parameters.has(key) {
        if coordinates.len() == 1 {
            return Ok(coordinates[0]);
        }
        let message = format!("joint `{}` has {} coordinates", joint.value, coordinates.len());
        let help = format!("give `{key}`, a whole number from 1 to {}", coordinates.len());
        return Err(Problem::error(joint.span, message).label("which one?").help(help));
    }
    let number = component.parameters.number(key).map_err(|error| parameter_problem(component, &error))?;
    numbered(component, joint, (key, number), coordinates)
}

/// The chain of the beams that a component is attached to; empty if it is attached to none.
pub(super) fn beam_chain(
    document: &Document,
    component: &Component,
    builder: &Builder,
    names: &Names,
) -> Result<BeamChain, Problem> {
    let (mut chain, mut last) = (BeamChain::default(), None::<&Beam>);
    let orientation = component.parameters.word("orientation").ok();
    for reference in &component.attachment.beams {
        let (Some(beam), Some(line)) = (document.beam(&reference.value), names.lines.get(&reference.value))
        else {
            return Err(Problem::error(
                reference.span,
                format!("there is no beam called `{}`", reference.value),
            ));
        };
        let points = line.nodes.iter().zip(&line.offsets);
        let mut own: Vec<CarriedPoint> =
            points.map(|(&node, offset)| CarriedPoint { node, point: offset.position }).collect();
        let from = chain.arc_lengths.last().copied().unwrap_or(0.0);
        let mut axes: Vec<Vector3> = (line.nodes.iter().zip(&line.places))
            .map(|(&node, &place)| {
                let axis = beam.frame(place).column(1).into_owned();
                builder.initial_frame(node).rotation.apply_inverse(&axis)
            })
            .collect();
        let mut lengths: Vec<f64> =
            arc_lengths(beam, &line.places).into_iter().map(|own| from + own).collect();
        if let (Some(before), Some(end)) = (last, chain.nodes.last()) {
            if end.node != own[0].node {
                let message = format!(
                    "beam `{}` does not start at the end of `{}`",
                    reference.value, before.name.value
                );
                return Err(Problem::error(reference.span, message)
                    .help("let it start at the node of the other, as `from = \"other.end\"`, and name them in order"));
            }
            let [one, other] =
                [before.frame(1.0).column(0).into_owned(), beam.frame(0.0).column(0).into_owned()];
            if one.dot(&other) < SMOOTH {
                let message = format!(
                    "beams `{}` and `{}` meet at {:.2} degrees: a slider would jolt there",
                    before.name.value,
                    reference.value,
                    one.dot(&other).clamp(-1.0, 1.0).acos().to_degrees()
                );
                return Err(Problem::error(reference.span, message)
                    .help("round the corner with a curved beam between them"));
            }
            let [one, other] = [before.frame(1.0), beam.frame(0.0)].map(|own| own.column(1).into_owned());
            if orientation == Some("section") && one.dot(&other) < SMOOTH {
                let message = format!(
                    "the sections of beams `{}` and `{}` differ in orientation at their common node",
                    before.name.value, reference.value
                );
                return Err(Problem::error(reference.span, message).help("specify the same `up` for both"));
            }
            own.remove(0);
            lengths.remove(0);
            axes.remove(0);
        }
        chain.sections.extend(axes);
        chain.nodes.extend(own);
        chain.arc_lengths.extend(lengths);
        last = Some(beam);
    }
    Ok(chain)
}

/// Arc length from the beam's start to each of the positions along it [m].
fn arc_lengths(beam: &Beam, places: &[f64]) -> Vec<f64> {
    const CHORDS: usize = 64;
    let mut lengths = vec![0.0; places.len()];
    for k in 1..places.len() {
        let at = |part: usize| {
            let share = part as f64 / CHORDS as f64;
            beam.line.position(places[k - 1] + share * (places[k] - places[k - 1]))
        };
        let chords: f64 = (0..CHORDS).map(|part| (at(part + 1) - at(part)).norm()).sum();
        lengths[k] = lengths[k - 1] + chords;
    }
    lengths
}
