//! Beams of a model file: their lines, which may depend on each other, and the sections along them.

use std::collections::BTreeMap;
use std::sync::Arc;

use lissom_motion::{Motion, Rotation, Vector3};

use super::entries::each;
use super::places::PlaceOrNode;
use super::temperatures::check_expansion;
use super::{
    Beam, Body, DistributedForce, NodeReference, PointMass, Section, Station, Superelement, interface_name,
};
use crate::expression::Expression;
use crate::format::keys::Shape;
use crate::line::Line;
use crate::parts::context::Context;
use crate::reading::mesh_nodes::{nodes_of, position_of};
use crate::reading::reader::Reader;
use crate::text::report::{Located, Problem, Span};
use crate::text::{Node, Value};
use lissom_mesh::MeshedPart;

/// A beam whose ends have no positions yet.
struct Draft {
    name: Located<String>,
    form: Form,
    line_span: Span,
    stations: Vec<Station>,
    elements: Located<usize>,
    order: usize,
    up: Option<Located<Vector3>>,
    twist: Expression,
    distributed: Vec<DistributedForce>,
    temperature: Expression,
    temperature_slope: [f64; 2],
    /// The frame in which it is written.
    frame: Motion,
}

enum Form {
    Ends { from: PlaceOrNode, through: Option<Located<Vector3>>, to: PlaceOrNode },
    Curve(Box<[Expression; 3]>),
}

/// Shells and solids by name.
type Meshes = BTreeMap<String, Arc<MeshedPart>>;
/// Positions of parts whose nodes beams may share, and shells and solids.
type Fixed<'f> = (&'f BTreeMap<String, Vector3>, &'f Meshes);

pub(super) fn beams(
    context: &Context<'_>,
    bodies: &[Body],
    point_masses: &[PointMass],
    sections: &[Section],
    (meshes, superelements): (&Meshes, &[Superelement]),
) -> Vec<Beam> {
    let drafts: Vec<Draft> = each(context, "beams", |reader, name| {
        let form = form(reader, name);
        let stations = stations(reader);
        let (elements, order, up) = (reader.count("elements"), reader.count("order"), reader.vector("up"));
        let profile = |key: &str| match reader.node(key) {
            None => Some(Expression::of_constant(0.0)),
            Some(node) => reader.context.profile(node, &reader.words(key)),
        };
        let (twist, temperature) = (profile("twist"), profile("temperature"));
        let slope = match reader.node("temperature_slope") {
            None => Some([0.0; 2]),
            Some(node) => reader.context.numbers::<2>(node, &reader.words("temperature_slope")),
        };
        let distributed = super::distributed::read(reader);
        let line_span = reader.node("curve").or(reader.node("to")).map_or(reader.name, |node| node.span);
        let stations = stations?;
        let named = |own: &&Section| stations.iter().any(|at| at.section.value == own.name.value);
        let expands = sections.iter().filter(named).any(|own| own.properties.expansion != 0.0);
        for key in ["temperature", "temperature_slope"] {
            check_expansion(reader, key, expands)?;
        }
        Some(Draft {
            name: Located::new(name.to_owned(), reader.name),
            form: form?,
            line_span,
            stations,
            elements: elements?,
            order: order?.value,
            up,
            twist: twist?,
            distributed: distributed?,
            temperature: temperature?,
            temperature_slope: slope?,
            frame: reader.context.frame(reader.scope)?,
        })
    });
    let mut fixed = BTreeMap::new();
    for body in bodies {
        fixed.insert(body.name.value.clone(), body.position);
    }
    for mass in point_masses {
        fixed.insert(mass.name.value.clone(), mass.position);
    }
    for element in superelements {
        let name = &element.name.value;
        for own in &element.interfaces {
            fixed.extend(element.place_of(&own.name).map(|place| (interface_name(name, &own.name), place)));
        }
    }
    place(context, drafts, (&fixed, meshes))
}

fn form(reader: &Reader<'_, '_>, name: &str) -> Option<Form> {
    let context = reader.context;
    if let Some(node) = reader.node("curve") {
        if let Some(other) = ["from", "to", "through"].iter().find_map(|key| reader.node(key)) {
            let message = format!("{} has both a curve and ends", reader.what);
            return context.fail(other.span, message, "remove `curve`, or `from`, `to` and `through`");
        }
        let what = reader.words("curve");
        let list = context.list(node, 3, &what)?;
        let read: Vec<Option<Expression>> = list.iter().map(|entry| context.profile(entry, &what)).collect();
        let read: Vec<Expression> = read.into_iter().collect::<Option<_>>()?;
        return Some(Form::Curve(Box::new(read.try_into().ok()?)));
    }
    let end = |key| {
        let Some(node) = reader.node(key) else {
            let message = format!("{} lacks `{key}`", reader.what);
            let help = "write `from` and `to`, or a `curve` of three expressions of s";
            return context.fail(reader.name, message, help);
        };
        let end = context.place_or_node(node, &reader.words(key))?;
        match &end {
            PlaceOrNode::Node(node) if node.value == NodeReference::Ground => {
                let message =
                    format!("{} cannot start or end at `ground`, which has no position", reader.what);
                context.fail(
                    node.span,
                    message,
                    "name a point here and add a joint of kind \"clamp\" to the ground",
                )
            }
            PlaceOrNode::Node(node) if matches!(&node.value, NodeReference::Beam { beam, .. } if beam == name) =>
            {
                let message = format!("{} refers to itself for its end", reader.what);
                context.fail(node.span, message, "name a point or a node of another part")
            }
            _ => Some(end),
        }
    };
    let (from, to) = (end("from"), end("to"));
    let through = match reader.node("through") {
        None => None,
        Some(node) => Some(context.place(node, &reader.words("through"))?),
    };
    Some(Form::Ends { from: from?, through, to: to? })
}

fn stations(reader: &Reader<'_, '_>) -> Option<Vec<Station>> {
    let context = reader.context;
    let Some(node) = reader.node("stations") else {
        if reader.has("section") {
            return reader.name_in("section").map(|section| vec![Station { at: 0.0, section }]);
        }
        let message = format!("{} lacks `section`", reader.what);
        return context.fail(
            reader.name,
            message,
            "add `section = \"…\"`, or `stations` for a varying section",
        );
    };
    if reader.has("section") {
        let message = format!("{} has both `section` and `stations`", reader.what);
        return context.fail(node.span, message, "remove one of them");
    }
    let what = reader.words("stations");
    let Value::List(list) = &node.value else {
        return context.wrong_type(node, &what, "a list of { at = …, section = \"…\" }");
    };
    let read: Vec<Option<(Station, Span)>> = list.iter().map(|entry| station(reader, entry, &what)).collect();
    let read: Vec<(Station, Span)> = read.into_iter().collect::<Option<_>>()?;
    let help = "the first is at 0, the last at 1, each is behind the one before, or two are at one place where the section changes at once";
    let elements = reader.count("elements")?.value as f64;
    let mut begun = 0.0;
    for (index, (own, place)) in read.iter().enumerate().skip(1) {
        let before = read[index - 1].0.at;
        if own.at < before || (own.at == before && (own.at == begun || own.at == 1.0)) {
            let message = format!("{what} must ascend, but {} comes after {before}", own.at);
            return context.fail(*place, message, help);
        }
        if own.at == before {
            begun = own.at;
            let boundary = own.at * elements;
            if (boundary - boundary.round()).abs() > 1e-9 {
                let message = format!(
                    "{what} change at once at {}, which is inside of one of its {elements} elements",
                    own.at
                );
                let help = "choose `elements` so that one ends there: for 0.25 a multiple of 4";
                return context.fail(*place, message, help);
            }
        }
    }
    let ends = read.first().map(|(first, _)| first.at).zip(read.last().map(|(last, _)| last.at));
    if read.len() < 2 || ends != Some((0.0, 1.0)) {
        return context.fail(node.span, format!("{what} must go from 0 to 1"), help);
    }
    Some(read.into_iter().map(|(station, _)| station).collect())
}

fn station<'c>(reader: &Reader<'c, '_>, node: &'c Node, what: &str) -> Option<(Station, Span)> {
    let inner = Reader::open(
        reader.context,
        node,
        (format!("an entry of {what}"), node.span),
        Shape::station_keys(),
    )?;
    let (at, section) = (inner.number("at"), inner.name_in("section"));
    let at = at?;
    Some((Station { at: at.value, section: section? }, at.span))
}

impl Context<'_> {
    /// A number or an expression of `s`, finite from 0 to 1.
    fn profile(&self, node: &Node, what: &str) -> Option<Expression> {
        let expression = self.expression(node, Some("s"), what)?;
        let bad = (0..=32).map(|i| f64::from(i) / 32.0).find(|s| !expression.jet(*s).value.is_finite());
        let Some(s) = bad else { return Some(expression) };
        self.fail(node.span, format!("{what} is not a finite number at s = {s}"), "s runs from 0 to 1")
    }
}

/// Determines the lines of beams whose ends are known, until none is left. The remaining ones depend on each other in a cycle.
fn place(context: &Context<'_>, mut drafts: Vec<Draft>, fixed: Fixed<'_>) -> Vec<Beam> {
    let order: BTreeMap<String, usize> =
        drafts.iter().enumerate().map(|(index, draft)| (draft.name.value.clone(), index)).collect();
    let mut lines: BTreeMap<String, Option<Line>> = BTreeMap::new();
    let mut beams = Vec::new();
    loop {
        let count = drafts.len();
        let mut waiting = Vec::new();
        for draft in drafts {
            let known = |end: &PlaceOrNode| match end {
                PlaceOrNode::Node(Located { value: NodeReference::Beam { beam, .. }, .. }) => {
                    // A beam that could not even be drafted has been complained about.
                    lines.contains_key(beam) || !order.contains_key(beam)
                }
                _ => true,
            };
            let ready = match &draft.form {
                Form::Ends { from, to, .. } => known(from) && known(to),
                Form::Curve(_) => true,
            };
            if ready {
                let line = line(context, &draft, &lines, fixed);
                lines.insert(draft.name.value.clone(), line.clone());
                beams.extend(line.and_then(|line| finish(context, draft, line)));
            } else {
                waiting.push(draft);
            }
        }
        if waiting.is_empty() || waiting.len() == count {
            circle(context, &waiting);
            break;
        }
        drafts = waiting;
    }
    beams.sort_by_key(|beam: &Beam| order.get(&beam.name.value));
    beams
}

fn circle(context: &Context<'_>, waiting: &[Draft]) {
    let Some(first) = waiting.first() else { return };
    let names: Vec<&str> = waiting.iter().map(|draft| draft.name.value.as_str()).collect();
    let message = format!(
        "the ends of the beams {} refer to each other in a cycle",
        crate::format::suggest::list(names)
    );
    context.fail::<()>(first.name.span, message, "specify the ends of one of them as positions");
}

fn line(
    context: &Context<'_>,
    draft: &Draft,
    lines: &BTreeMap<String, Option<Line>>,
    (fixed, meshes): Fixed<'_>,
) -> Option<Line> {
    let what = format!("beam `{}`", draft.name.value);
    let at = |end: &PlaceOrNode| match end {
        PlaceOrNode::Place(place) => Some(place.value),
        PlaceOrNode::Node(node) => match &node.value {
            NodeReference::Ground => None,
            NodeReference::Body(name) | NodeReference::PointMass(name) => fixed.get(name).copied(),
            NodeReference::Interface { superelement, interface } => {
                fixed.get(&interface_name(superelement, interface)).copied()
            }
            NodeReference::Mesh { part, place } => {
                let mesh = meshes.get(part)?;
                nodes_of(mesh, node).map_err(|problem| context.report(problem)).ok()?;
                position_of(mesh, place)
            }
            NodeReference::Beam { beam, fraction } => {
                lines.get(beam)?.as_ref().map(|line| line.position(*fraction))
            }
        },
    };
    let line = match &draft.form {
        Form::Curve(curve) => Line::Curve(curve.clone()).moved(&draft.frame),
        Form::Ends { from, through, to } => {
            let (from, to) = (at(from)?, at(to)?);
            if (to - from).norm() <= 1e-12 * from.norm().max(to.norm()) {
                let message = format!("{what} has no length: it starts and ends at the same position");
                return context.fail(
                    draft.line_span,
                    message,
                    "specify different positions for `from` and `to`",
                );
            }
            match through {
                None => Line::Straight { from, to },
                Some(through) => match Line::arc(from, through.value, to) {
                    Ok(arc) => arc,
                    Err(error) => {
                        let message = format!("{what} is not a circular arc: {error}");
                        return context.fail(through.span, message, "remove `through` for a straight beam");
                    }
                },
            }
        }
    };
    if let Some(s) = line.fault() {
        let message = format!(
            "{what} has no direction at s = {s}: the derivative of its curve is zero or not finite there"
        );
        return context.fail(
            draft.line_span,
            message,
            "the derivative of the curve must not vanish from s = 0 to s = 1",
        );
    }
    Some(line)
}

fn finish(context: &Context<'_>, draft: Draft, line: Line) -> Option<Beam> {
    let up = match draft.up {
        // The same direction in each of many parts, however they are turned.
        None => {
            let own = line.clone().moved(&draft.frame.inverse());
            let inside = own.default_up();
            if let Some(s) = own.parallel_at(&inside) {
                let message = format!(
                    "beam `{}` has no default for `up`: its line is parallel to x, y and z at some positions, where axis 3 would reverse",
                    draft.name.value
                );
                let help = format!(
                    "specify an `up` that is nowhere parallel to the line; the default is z, parallel near s = {s:.3}"
                );
                return context.fail(draft.line_span, message, help);
            }
            if draft.frame.rotation == Rotation::IDENTITY {
                inside
            } else {
                draft.frame.rotation.apply(&inside)
            }
        }
        Some(up) if line.is_parallel_somewhere(&up.value) => {
            let message = match line.parallel_at(&up.value) {
                Some(s) if s > 0.0 => format!(
                    "`up` of beam `{}` is parallel to the beam near s = {s:.3}, where axis 3 would reverse",
                    draft.name.value
                ),
                _ => format!("`up` of beam `{}` is parallel to the beam", draft.name.value),
            };
            let problem = Problem::error(up.span, message).label("along the beam");
            context.report(
                problem.help(
                    "axis 3 is oriented towards `up`: choose a direction across the beam, or remove it",
                ),
            );
            return None;
        }
        Some(up) => up.value,
    };
    let node = |end: PlaceOrNode| match end {
        PlaceOrNode::Place(_) => None,
        PlaceOrNode::Node(node) => Some(node),
    };
    let (shared_start, shared_end) = match draft.form {
        Form::Ends { from, to, .. } => (node(from), node(to)),
        Form::Curve(_) => (None, None),
    };
    for shared in shared_start.iter().chain(&shared_end) {
        if let NodeReference::PointMass(name) = &shared.value {
            let message =
                format!("beam `{}` cannot share the node of the point mass `{name}`", draft.name.value);
            let help = "a point mass has no rotation: specify the end as a position and add a joint of kind \"spherical\"";
            return context.fail(shared.span, message, help);
        }
        if let NodeReference::Mesh { part, .. } = &shared.value
            && context.has("solids", part)
        {
            let message = format!("beam `{}` cannot share a node of the solid `{part}`", draft.name.value);
            let help =
                "nodes of solids have no rotation: specify the end as a position, and clamp both to a body";
            return context.fail(shared.span, message, help);
        }
    }
    Some(Beam {
        name: draft.name,
        stations: draft.stations,
        line,
        line_span: draft.line_span,
        shared_start,
        shared_end,
        elements: draft.elements,
        order: draft.order,
        up,
        twist: draft.twist,
        distributed: draft.distributed,
        temperature: draft.temperature,
        temperature_slope: draft.temperature_slope,
    })
}
