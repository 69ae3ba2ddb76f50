//! Ports of joints, springs and loads: nodes, locations, directions, coordinates and beams, read as their kind declares them.

use lissom_mechanics::elements::Sheave;
use lissom_mechanics::ports::{PortDeclaration, PortType, Ports};
use lissom_mechanics::registry::ModelAxis;
use lissom_motion::Vector3;

use super::connections::Places;
use super::{Attachment, Component, CoordinateName, NodeLocation, NodeReference};
use crate::expression::Formula;
use crate::format::keys::Shape;
use crate::line::are_parallel;
use crate::parts::context::Context;
use crate::reading::node_reference::MeshPlace;
use crate::reading::reader::Reader;
use crate::text::ScopeId;
use crate::text::report::{Located, Problem};
use crate::text::{Node, Value};

/// What the entry called `name` is attached to; `formula` is the expression that names coordinates, if there is one. None if
/// a port is missing or invalid.
pub(super) fn read(
    reader: &Reader<'_, '_>,
    name: &str,
    (ports, formula): (Ports, Option<&Located<Formula>>),
    places: &Places,
) -> Option<Attachment> {
    let mut own = Attachment::default();
    let mut is_complete = true;
    for port in ports.0 {
        let PortDeclaration { key, required, .. } = *port;
        let read = match port.holds {
            PortType::Node { moves, .. } => add_node(reader, key, moves, &mut own.nodes),
            PortType::Set => add_set(reader, key, &mut own.nodes),
            // With a missing node its own error is enough.
            PortType::Location { .. } if !is_complete => None,
            PortType::Location { of, default } => location(reader, key, (ports, default), &own.nodes, places)
                .map(|at| of.iter().for_each(|key| own.nodes[ports.node(key)].at = at.place())),
            PortType::Direction(default) => {
                direction(reader, key, (ports, default), &own.axes).map(|direction| own.axes.push(direction))
            }
            PortType::Locations => locations(reader, key, places).map(|(nodes, coordinates)| {
                (own.nodes, own.coordinates) = (nodes, coordinates);
            }),
            PortType::Coordinate(_) => {
                joint(reader, key, name).map(|joint| own.coordinates.push((joint, None)))
            }
            PortType::OnlyCoordinate(_) => {
                reader.name_in(key).map(|joint| own.coordinates.push((joint, None)))
            }
            PortType::Coordinates => match reader.node(key) {
                None => (!required).then_some(()),
                Some(node) => coordinates(reader, (key, node)).map(|all| own.coordinates.extend(all)),
            },
            PortType::NamedCoordinates => {
                own.coordinates = formula.map(named).unwrap_or_default();
                Some(())
            }
            PortType::Beams => names_of_beams(reader, key).map(|beams| own.beams = beams),
        };
        is_complete &= read.is_some();
    }
    is_complete.then_some(own)
}

/// Adds the node that a key names, which differs from those before.
fn add_node(reader: &Reader<'_, '_>, key: &str, moves: bool, nodes: &mut Vec<NodeLocation>) -> Option<()> {
    let node = reader.node(key).and_then(|node| reader.context.node(node, &reader.words(key)))?;
    if moves && node.value == NodeReference::Ground {
        let message = format!("{} acts on the ground, which does not move", reader.what);
        return reader.context.fail(node.span, message, "specify the node of a body or beam");
    }
    if let Some(base) = nodes.iter().find(|base| base.node.value == node.value) {
        let message = format!("{} connects a node to itself", reader.what);
        let problem = Problem::error(node.span, message).label("the same").also(base.node.span, "base");
        reader.context.report(problem.help("`base` and `tip` must be different nodes"));
        return None;
    }
    nodes.push(NodeLocation { node, at: None, sheave: None });
    Some(())
}

/// Adds the set of nodes that a key names.
fn add_set(reader: &Reader<'_, '_>, key: &str, nodes: &mut Vec<NodeLocation>) -> Option<()> {
    add_node(reader, key, true, nodes)?;
    let node = &nodes.last()?.node;
    if matches!(node.value, NodeReference::Mesh { place: MeshPlace::Set(_), .. }) {
        return Some(());
    }
    let message = format!("{} of {} is no set of nodes", reader.words(key), reader.what);
    let help =
        "name a side or set of a shell or solid, such as \"block.east\"; one node is joined by a `clamp`";
    reader.context.fail(node.span, message, help)
}

/// The nodes `base` and `tip`, which differ.
pub(super) fn two_nodes(reader: &Reader<'_, '_>) -> Option<[Located<NodeReference>; 2]> {
    let mut nodes = Vec::new();
    let [base, tip] = ["base", "tip"].map(|key| add_node(reader, key, false, &mut nodes));
    base.and(tip)?;
    Some(<[NodeLocation; 2]>::try_from(nodes).ok()?.map(|own| own.node))
}

/// Where something is attached.
enum LocatedAt {
    Place(Vector3),
    /// At each node of a set.
    EachNode,
}

impl LocatedAt {
    fn place(&self) -> Option<Vector3> {
        match self {
            Self::Place(place) => Some(*place),
            Self::EachNode => None,
        }
    }
}

/// The location of a key, or that of the first node of `default` that is not the ground.
fn location(
    reader: &Reader<'_, '_>,
    key: &str,
    (ports, default): (Ports, &[&str]),
    nodes: &[NodeLocation],
    places: &Places,
) -> Option<LocatedAt> {
    if let Some(place) = reader.node(key) {
        return reader.context.place(place, &reader.words(key)).map(|place| LocatedAt::Place(place.value));
    }
    let mut all = default.iter().map(|key| &nodes[ports.node(key)].node);
    let first = all.clone().next()?;
    let node = all.find(|node| node.value != NodeReference::Ground).unwrap_or(first);
    if matches!(node.value, NodeReference::Mesh { place: MeshPlace::Set(_), .. }) {
        return Some(LocatedAt::EachNode);
    }
    own_place(reader.context, reader.scope, node, places).map(LocatedAt::Place)
}

/// Nodes in a sequence, each with its location, and the coordinates of joints of drums among them.
fn locations(
    reader: &Reader<'_, '_>,
    key: &str,
    places: &Places,
) -> Option<(Vec<NodeLocation>, Vec<CoordinateName>)> {
    let (context, node) = (reader.context, reader.node(key)?);
    let Value::List(list) = &node.value else {
        return context.wrong_type(node, &reader.words(key), "a list of positions");
    };
    let mut coordinates = Vec::new();
    let read = |(index, entry): (usize, &Node)| {
        let what = format!("position {} of {}", index + 1, reader.words(key));
        let own = Reader::open(context, entry, (what, entry.span), Shape::place_keys())?;
        let node = context.node(own.node("on")?, &own.words("on"))?;
        let at = match own.node("at") {
            Some(place) => context.place(place, &own.words("at")).map(|place| place.value),
            None => own_place(context, reader.scope, &node, places),
        };
        let is_end = index == 0 || index + 1 == list.len();
        let sheave = sheave(&own, is_end, &mut coordinates)?;
        Some(NodeLocation { node, at: Some(at?), sheave })
    };
    let all: Vec<_> = list.iter().enumerate().map(read).collect();
    Some((all.into_iter().collect::<Option<_>>()?, coordinates))
}

/// The sheave at a position of a rope, if there is one; none if it is wrong. Adds the coordinate of its joint.
#[allow(clippy::option_option, reason = "the outer one is of errors, as everywhere in decoders")]
fn sheave(
    own: &Reader<'_, '_>,
    is_end: bool,
    coordinates: &mut Vec<CoordinateName>,
) -> Option<Option<Sheave>> {
    let context = own.context;
    if !own.has("radius") {
        let Some(key) = ["axis", "sense", "joint"].into_iter().find(|key| own.has(key)) else {
            return Some(None);
        };
        let message = format!("{} has `{key}`, but no `radius`", own.what);
        return context.fail(own.node(key)?.span, message, "add the `radius` of the sheave [m]");
    }
    let radius = own.number("radius")?.value;
    if !own.has("axis") {
        let message = format!("{} has a `radius`, but no `axis`", own.what);
        return context.fail(
            own.node("radius")?.span,
            message,
            "add the `axis` of the sheave, such as [0, 1, 0]",
        );
    }
    let axis = own.vector("axis")?.value;
    let is_positive = if own.has("sense") { Some(own.choice("sense")?.value == "positive") } else { None };
    if let Some(node) = own.node("joint") {
        if !is_end {
            let message = format!("{} has a `joint`, but is no end of the rope", own.what);
            let help =
                "a rope slides over sheaves between its ends; let two ropes end on a pulley that it turns";
            return context.fail(node.span, message, help);
        }
        coordinates.push(coordinate(context, node, &own.words("joint"))?);
    }
    // The sign of a joint is found when all joints are known.
    Some(Some(Sheave { radius, axis, is_positive, turns: own.has("joint").then_some(1.0) }))
}

/// Cosine between axes that count as perpendicular: digits of a text.
const PERPENDICULAR: f64 = 1e-5;

/// The direction of a key, which is perpendicular to those `before`.
fn direction(
    reader: &Reader<'_, '_>,
    key: &str,
    (ports, default): (Ports, Option<ModelAxis>),
    before: &[Located<Vector3>],
) -> Option<Located<Vector3>> {
    if default.is_some() && reader.node(key).is_none() {
        let directions = ports.0.iter().filter(|port| matches!(port.holds, PortType::Direction(_)));
        if let Some((other, given)) =
            directions.map(|port| port.key).find_map(|other| Some((other, reader.node(other)?)))
        {
            let message = format!("{} has `{other}`, but not `{key}`", reader.what);
            return reader.context.fail(given.span, message, "specify both axes, or none");
        }
    }
    let second = reader.vector(key)?;
    let Some(first) = before.first() else { return Some(second) };
    if are_parallel(&first.value, &second.value) {
        let message = format!("the two axes of {} are parallel", reader.what);
        let problem = Problem::error(second.span, message).label("parallel").also(first.span, "first axis");
        reader.context.report(problem.help("specify two different directions"));
        return None;
    }
    let cosine = first.value.normalize().dot(&second.value.normalize());
    if cosine.abs() > PERPENDICULAR {
        let across =
            second.value - first.value * (first.value.dot(&second.value) / first.value.norm_squared());
        let message = format!(
            "the two axes of {} are at {:.3} degrees to each other, not at 90",
            reader.what,
            cosine.acos().to_degrees()
        );
        let problem =
            Problem::error(second.span, message).label("not perpendicular").also(first.span, "first axis");
        reader.context.report(problem.help(format!(
            "the nearest perpendicular direction is [{}, {}, {}]",
            across.x, across.y, across.z
        )));
        return None;
    }
    Some(second)
}

/// The joint on whose coordinate the entry called `name` acts.
fn joint(reader: &Reader<'_, '_>, key: &str, name: &str) -> Option<Located<String>> {
    let joint = reader.name_in(key)?;
    let context = reader.context;
    // Only a joint can name itself: springs live in a table of their own.
    let is_joint = || context.names("joints").contains(&(name, reader.name));
    if joint.value == name && is_joint() {
        let message = format!("{} acts on itself", reader.what);
        return context.fail(joint.span, message, "specify the joint whose coordinate it prescribes");
    }
    Some(joint)
}

/// Names of beams, at least one.
fn names_of_beams(reader: &Reader<'_, '_>, key: &str) -> Option<Vec<Located<String>>> {
    let (context, node) = (reader.context, reader.node(key)?);
    let what = reader.words(key);
    let Value::List(list) = &node.value else {
        return context.wrong_type(node, &what, "a list of names of beams");
    };
    let read = |entry: &Node| {
        let Value::Text(text) = &entry.value else {
            return context.wrong_type(entry, &format!("each entry of {what}"), "the name of a beam");
        };
        let name = context.entry_named("beams", text, entry, &what)?;
        let is_known = context.is_known("beams", &name, entry.span, &what);
        is_known.then(|| Located::new(name, entry.span))
    };
    if list.is_empty() {
        return context.fail(node.span, format!("{what} is empty"), "name at least one beam");
    }
    let all: Vec<_> = list.iter().map(read).collect();
    all.into_iter().collect()
}

/// Joints, or coordinates of joints, by name.
fn coordinates(reader: &Reader<'_, '_>, (key, node): (&str, &Node)) -> Option<Vec<CoordinateName>> {
    let context = reader.context;
    let what = reader.words(key);
    let Value::List(list) = &node.value else {
        return context.wrong_type(node, &what, "a list of coordinates of joints");
    };
    if list.is_empty() {
        return context.fail(
            node.span,
            format!("{what} is empty"),
            "list coordinates, such as \"arm.angle\"",
        );
    }
    let all: Vec<_> = list.iter().map(|entry| coordinate(context, entry, &what)).collect();
    all.into_iter().collect()
}

/// A joint, or a coordinate of a joint, by name.
fn coordinate(context: &Context<'_>, entry: &Node, what: &str) -> Option<CoordinateName> {
    let Value::Text(text) = &entry.value else {
        return context.wrong_type(entry, &format!("each entry of {what}"), "the name of a coordinate");
    };
    let whole = context.entry_named("joints", text, entry, what)?;
    let (name, component) = match text.rsplit_once('.') {
        Some((owner, component)) if !context.has("joints", &whole) => {
            (context.entry_named("joints", owner, entry, what)?, Some(component.to_owned()))
        }
        _ => (whole, None),
    };
    let is_known = context.is_known("joints", &name, entry.span, what);
    is_known.then(|| (Located::new(name, entry.span), component))
}

/// Finds the signs with which joints turn the drums of ropes about their axes.
pub(super) fn turn_drums(context: &Context<'_>, joints: &[Component], springs: &mut [Component]) {
    for rope in springs {
        let Attachment { nodes, coordinates, .. } = &mut rope.attachment;
        let drums = nodes.iter_mut().filter(|own| own.sheave.is_some_and(|own| own.turns.is_some()));
        for (drum, (name, _)) in drums.zip(coordinates) {
            let Some(joint) = joints.iter().find(|joint| joint.name.value == name.value) else { continue };
            let own = &joint.attachment;
            let sign = match own.nodes.as_slice() {
                [base, _] if base.node.value == drum.node.value => -1.0,
                [_, tip] if tip.node.value == drum.node.value => 1.0,
                _ => {
                    let message = format!(
                        "rope `{}` is wound on a drum that joint `{}` does not turn",
                        rope.name.value, name.value
                    );
                    let problem = Problem::error(name.span, message).also(drum.node.span, "the drum");
                    context.report(
                        problem
                            .help("let the end be `on` the tip of the joint, or name the joint of the drum"),
                    );
                    continue;
                }
            };
            let Some(sheave) = &mut drum.sheave else { continue };
            let Some(axis) = own.axes.first().filter(|axis| are_parallel(&axis.value, &sheave.axis)) else {
                let message = format!(
                    "the `axis` of the drum of rope `{}` is not that of its joint `{}`",
                    rope.name.value, name.value
                );
                context.report(
                    Problem::error(name.span, message).help("specify the axis about which the joint turns"),
                );
                continue;
            };
            sheave.turns = Some(sign * axis.value.dot(&sheave.axis).signum());
        }
    }
}

/// Where a node is. The ground has its position where the part is that names it.
fn own_place(
    context: &Context<'_>,
    scope: ScopeId,
    node: &Located<NodeReference>,
    places: &Places,
) -> Option<Vector3> {
    if node.value == NodeReference::Ground {
        return context.frame(scope).map(|frame| frame.position);
    }
    places.required(context, node)
}

/// The coordinates that an expression names.
fn named(formula: &Located<Formula>) -> Vec<CoordinateName> {
    let names = formula.value.arguments().iter().filter_map(|name| name.text.rsplit_once('.'));
    names.map(|(joint, word)| (Located::new(joint.to_owned(), formula.span), Some(word.to_owned()))).collect()
}
