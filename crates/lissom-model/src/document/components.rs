//! Joints, springs and loads of a model file: their attachment, and the parameters of their kind.

use lissom_core::registry::{Parameters, Value as Held};
use lissom_motion::Vector3;

use super::connections::Places;
use super::entries::each_of_kind;
use super::{Attachment, Component, CoordinateName, NodeReference, assembly};
use crate::context::Context;
use crate::keys::Shape;
use crate::line::are_parallel;
use crate::parts::ScopeId;
use crate::reader::Reader;
use crate::registry::{ActsOn, FrameRule, KindEntry, Registry};
use crate::report::{Located, Problem};
use crate::text::{Node, Value};

pub(super) fn read(
    context: &Context<'_>,
    table: &'static str,
    registry: &Registry,
    places: &Places,
) -> Vec<Component> {
    let kinds: &[KindEntry] = match table {
        "joints" => &registry.joints,
        "springs" => &registry.springs,
        _ => &registry.loads,
    };
    let named = named(context, table, kinds);
    let forms = named.as_ref().unwrap_or(registry);
    each_of_kind(context, table, forms, |reader, name, word| {
        let entry = kinds.iter().find(|entry| entry.name == word)?;
        let (parameters, parameter_spans) = reader.parameters(entry.parameters);
        let signal = reader.signal(entry.parameters);
        let attachment = attachment(reader, name, entry.acts_on, registry, places);
        let takes_friction =
            table == "joints" && !matches!(entry.acts_on, ActsOn::JointCoordinate(_) | ActsOn::Nothing);
        let friction = if takes_friction { friction(reader) } else { None };
        let latch = if takes_friction { latch(reader) } else { None };
        let release = if takes_friction { reader.formula("release") } else { None };
        let on_tip = match entry.acts_on {
            ActsOn::TwoNodes(rule) if table == "joints" => assembly::on_tip(reader, rule),
            _ => None,
        };
        let kind = reader.text("kind")?.map(str::to_owned);
        let name = Located::new(name.to_owned(), reader.name);
        let attachment = attachment?;
        Some(Component {
            name,
            kind,
            attachment,
            parameters,
            parameter_spans,
            signal,
            latch,
            release,
            friction,
            on_tip,
        })
    })
}

/// The kinds in use in `table`: building the forms of all kinds takes longer than reading the entries, which is significant in
/// sweeps. None if the kind of an entry is missing or unknown, so that the error message can list all of them.
fn named(context: &Context<'_>, table: &str, kinds: &[KindEntry]) -> Option<Registry> {
    let mut named: Vec<KindEntry> = Vec::new();
    for (_, _, node) in context.entries(table) {
        let Value::Table(entry) = &node.value else { return None };
        let Value::Text(word) = &entry.get("kind")?.node.value else { return None };
        if !named.iter().any(|kind| kind.name == word) {
            named.push(*kinds.iter().find(|kind| kind.name == word)?);
        }
    }
    let none = Registry::default();
    Some(match table {
        "joints" => Registry { joints: named, ..none },
        "springs" => Registry { springs: named, ..none },
        _ => Registry { loads: named, ..none },
    })
}

/// The key `friction` of a joint, as parameters of a friction element.
fn friction(reader: &Reader<'_, '_>) -> Option<Located<Parameters>> {
    let node = reader.node("friction")?;
    let context = reader.context;
    let own = Reader::open(context, node, (reader.words("friction"), node.span), Shape::friction_keys())?;
    let mut parameters = Parameters::new();
    for key in ["coulomb", "stribeck", "viscous", "deflection", "damping"] {
        if let Some(number) = own.number(key) {
            parameters.insert(key, Held::Number(number.value));
        }
    }
    let coulomb = own.number("coulomb")?.value;
    if let Some(at_rest) = own.number("static") {
        if at_rest.value < coulomb {
            let message = format!("`static` of {} is below `coulomb`", own.what);
            return context.fail(
                at_rest.span,
                message,
                "static friction must not be smaller than sliding friction",
            );
        }
        if at_rest.value > coulomb {
            parameters.insert("breakaway", Held::Number(at_rest.value - coulomb));
        }
    }
    Some(Located::new(parameters, node.span))
}

/// The key `latch` of a joint: where it engages.
fn latch(reader: &Reader<'_, '_>) -> Option<Located<f64>> {
    let node = reader.node("latch")?;
    let own = Reader::open(reader.context, node, (reader.words("latch"), node.span), Shape::latch_keys())?;
    own.number("at")
}

fn attachment(
    reader: &Reader<'_, '_>,
    name: &str,
    acts_on: ActsOn,
    registry: &Registry,
    places: &Places,
) -> Option<Attachment> {
    // A part that could not be read has no position; its own error is enough.
    let at = |key: &str, node: &Located<NodeReference>| match reader.node(key) {
        Some(place) => reader.context.place(place, &reader.words(key)).map(|place| place.value),
        None => own_place(reader.context, reader.scope, &node.value, places),
    };
    match acts_on {
        ActsOn::TwoNodes(rule) => {
            let nodes = two_nodes(reader);
            let (axis, second_axis) = axes(reader, rule)?;
            let (base, tip) = nodes?;
            // The ground has no position: if it is the tip, the position is that of the base node.
            let place = if tip.value == NodeReference::Ground { at("at", &base) } else { at("at", &tip) };
            Some(Attachment::TwoNodes { at: place?, base, tip, axis, second_axis })
        }
        ActsOn::TwoPlaces => {
            let (base, tip) = two_nodes(reader)?;
            let (at_base, at_tip) = (at("at_base", &base), at("at_tip", &tip));
            Some(Attachment::TwoPlaces { at_base: at_base?, at_tip: at_tip?, base, tip })
        }
        ActsOn::OneNode => {
            let on = reader.node("on").and_then(|node| reader.context.node(node, &reader.words("on")))?;
            if on.value == NodeReference::Ground {
                let message = format!("{} acts on the ground, which does not move", reader.what);
                return reader.context.fail(on.span, message, "specify the node of a body or beam");
            }
            Some(Attachment::OneNode { at: at("at", &on)?, on })
        }
        ActsOn::Places => {
            let (context, node) = (reader.context, reader.node("along")?);
            let Value::List(list) = &node.value else {
                return context.wrong_type(node, &reader.words("along"), "a list of positions");
            };
            let read = |(index, entry): (usize, &Node)| {
                let what = format!("position {} of {}", index + 1, reader.words("along"));
                let own = Reader::open(context, entry, (what, entry.span), Shape::place_keys())?;
                let on = context.node(own.node("on")?, &own.words("on"))?;
                let place = match own.node("at") {
                    Some(place) => context.place(place, &own.words("at")).map(|place| place.value),
                    None => own_place(context, reader.scope, &on.value, places),
                };
                Some((on, place?))
            };
            let all: Vec<_> = list.iter().enumerate().map(read).collect();
            let drums = match reader.node("drums") {
                Some(node) => coordinates(reader, ("drums", node))?,
                None => Vec::new(),
            };
            Some(Attachment::Places(all.into_iter().collect::<Option<_>>()?, drums))
        }
        ActsOn::JointCoordinate(_) => joint_coordinate(reader, name, registry),
        ActsOn::TwoJointCoordinates => {
            let (joint, other) = (reader.name_in("joint"), reader.name_in("other"));
            Some(Attachment::JointCoordinates { joint: joint?, other: other? })
        }
        ActsOn::NamedCoordinates => Some(Attachment::NamedCoordinates),
        ActsOn::Coordinates => {
            coordinates(reader, ("coordinates", reader.node("coordinates")?)).map(Attachment::Coordinates)
        }
        ActsOn::AlongBeams => {
            let context = reader.context;
            let beams = names_of_beams(reader);
            let tip = reader.node("tip").and_then(|node| context.node(node, &reader.words("tip")))?;
            Some(Attachment::AlongBeams { at: at("at", &tip)?, beams: beams?, tip })
        }
        ActsOn::Nothing => Some(Attachment::Nothing),
    }
}

/// Names of beams, at least one.
fn names_of_beams(reader: &Reader<'_, '_>) -> Option<Vec<Located<String>>> {
    let (context, node) = (reader.context, reader.node("beams")?);
    let what = reader.words("beams");
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
    let read = |entry: &Node| {
        let Value::Text(text) = &entry.value else {
            return context.wrong_type(entry, &format!("each entry of {what}"), "the name of a coordinate");
        };
        let whole = context.entry_named("joints", text, entry, &what)?;
        let (name, component) = match text.rsplit_once('.') {
            Some((owner, component)) if !context.has("joints", &whole) => {
                (context.entry_named("joints", owner, entry, &what)?, Some(component.to_owned()))
            }
            _ => (whole, None),
        };
        let is_known = context.is_known("joints", &name, entry.span, &what);
        is_known.then(|| (Located::new(name, entry.span), component))
    };
    if list.is_empty() {
        return context.fail(
            node.span,
            format!("{what} is empty"),
            "list coordinates, such as \"arm.angle\"",
        );
    }
    let all: Vec<_> = list.iter().map(read).collect();
    all.into_iter().collect()
}

/// Where a node is. The ground has its position where the part is that names it.
fn own_place(
    context: &Context<'_>,
    scope: ScopeId,
    node: &NodeReference,
    places: &Places,
) -> Option<Vector3> {
    if *node == NodeReference::Ground {
        return context.frame(scope).map(|frame| frame.position);
    }
    places.of(node)
}

pub(super) fn two_nodes(reader: &Reader<'_, '_>) -> Option<(Located<NodeReference>, Located<NodeReference>)> {
    let context = reader.context;
    let node = |key| reader.node(key).and_then(|node| context.node(node, &reader.words(key)));
    let (base, tip) = (node("base"), node("tip"));
    let (base, tip) = (base?, tip?);
    if base.value == tip.value {
        let message = format!("{} connects a node to itself", reader.what);
        let problem = Problem::error(tip.span, message).label("the same").also(base.span, "base");
        context.report(problem.help("`base` and `tip` must be different nodes"));
        return None;
    }
    Some((base, tip))
}

type Axes = (Option<Located<Vector3>>, Option<Located<Vector3>>);

/// Cosine between axes that count as perpendicular: digits of a text.
const PERPENDICULAR: f64 = 1e-5;

/// The directions required by the frame rule; `None` if one of them is invalid or missing.
fn axes(reader: &Reader<'_, '_>, rule: FrameRule) -> Option<Axes> {
    match rule {
        FrameRule::None => Some((None, None)),
        FrameRule::Axis => Some((Some(reader.vector("axis")?), None)),
        FrameRule::TwoAxes | FrameRule::GivenOrGlobal => {
            for (key, other) in [("axis", "second_axis"), ("second_axis", "axis")] {
                if let (FrameRule::GivenOrGlobal, None, Some(given)) =
                    (rule, reader.node(key), reader.node(other))
                {
                    let message = format!("{} has `{other}`, but not `{key}`", reader.what);
                    return reader.context.fail(given.span, message, "specify both axes, or none");
                }
            }
            let (first, second) = (reader.vector("axis"), reader.vector("second_axis"));
            let (first, second) = (first?, second?);
            if are_parallel(&first.value, &second.value) {
                let message = format!("the two axes of {} are parallel", reader.what);
                let problem =
                    Problem::error(second.span, message).label("parallel").also(first.span, "first axis");
                reader.context.report(problem.help("specify two different directions"));
                return None;
            }
            let cosine = first.value.normalize().dot(&second.value.normalize());
            if cosine.abs() > PERPENDICULAR {
                let across = second.value
                    - first.value * (first.value.dot(&second.value) / first.value.norm_squared());
                let message = format!(
                    "the two axes of {} are at {:.3} degrees to each other, not at 90",
                    reader.what,
                    cosine.acos().to_degrees()
                );
                let problem = Problem::error(second.span, message)
                    .label("not perpendicular")
                    .also(first.span, "first axis");
                reader.context.report(problem.help(format!(
                    "the nearest perpendicular direction is [{}, {}, {}]",
                    across.x, across.y, across.z
                )));
                return None;
            }
            Some((Some(first), Some(second)))
        }
    }
}

fn joint_coordinate(reader: &Reader<'_, '_>, name: &str, registry: &Registry) -> Option<Attachment> {
    let joint = reader.name_in("joint")?;
    let context = reader.context;
    // Only a joint can name itself: springs live in a table of their own.
    let is_joint = context.names("joints").contains(&(name, reader.name));
    if is_joint && joint.value == name {
        let message = format!("{} acts on itself", reader.what);
        return context.fail(joint.span, message, "specify the joint whose coordinate it prescribes");
    }
    let word = &context.entry("joints", &joint.value)?.table()?.get("kind")?.node;
    let Value::Text(kind) = &word.value else { return None };
    let entry = registry.joints.iter().find(|entry| entry.name == kind)?;
    if matches!(
        entry.acts_on,
        ActsOn::TwoNodes(FrameRule::Axis | FrameRule::TwoAxes) | ActsOn::Nothing | ActsOn::AlongBeams
    ) {
        return Some(Attachment::JointCoordinate { joint });
    }
    let message = format!("{} acts on `{}`, which has no relative coordinate", reader.what, joint.value);
    let problem = Problem::error(joint.span, message).label("no coordinate");
    let problem = problem.also(word.span, format!("a {kind} joint"));
    context.report(problem.help("specify a joint with an axis, such as a revolute joint"));
    None
}
