//! Solids of a model file: those that determine the inertia of a part, are drawn of it, and touch others.

use std::sync::Arc;

use lissom_motion::{Motion, Rotation, Vector3};

use crate::keys::{Key, Shape};
use crate::library::joined;
use crate::reader::Reader;
use crate::report::Problem;
use crate::solid::{Form, PlacedSolid, Solid};
use crate::surface::Surface;
use crate::text::{Node, Value};

/// Kinds of solids with their dimensions.
const KINDS: [(&str, &[&str]); 7] = [
    ("box", &["sides"]),
    ("cylinder", &["radius", "length", "axis"]),
    ("tube", &["radius", "inner_radius", "length", "axis"]),
    ("sphere", &["radius"]),
    ("capsule", &["radius", "length", "axis"]),
    ("plane", &["normal"]),
    ("mesh", &["file", "scale"]),
];
/// All dimensions; those that may be omitted.
const DIMENSIONS: [&str; 8] =
    ["sides", "radius", "inner_radius", "length", "axis", "normal", "file", "scale"];
const OPTIONAL: [&str; 3] = ["axis", "normal", "scale"];
/// Kinds whose name may be the key of their dimensions instead.
const SHORT: [&str; 4] = ["box", "cylinder", "tube", "sphere"];

/// The solid of a table, the value of `key`.
pub(super) fn solid(reader: &Reader<'_, '_>, node: &Node, key: &str) -> Option<Solid> {
    let what = reader.words(key);
    let own = opened(reader, node, &what, Shape::solid_keys())?;
    let kind = kind(&own, node, &what)?;
    read(&own, node, kind)
}

/// What a part consists of: its surface for drawings, and the solids with which it touches others.
#[derive(Clone, Debug, Default)]
pub(super) struct Body {
    pub(super) surface: Option<Arc<Surface>>,
    pub(super) solids: Vec<PlacedSolid>,
}

/// The shape of a part, empty if it is not specified; none stands for an error.
pub(super) fn shape(reader: &Reader<'_, '_>, center: &Vector3) -> Option<Body> {
    let context = reader.context;
    match (reader.node("shape"), reader.node("mesh")) {
        (None, None) => Some(Body::default()),
        (Some(node), None) => {
            let what = reader.words("shape");
            let entries = match &node.value {
                Value::List(list) => list.as_slice(),
                _ => std::slice::from_ref(node),
            };
            if entries.is_empty() {
                return context.fail(
                    node.span,
                    format!("{what} is empty"),
                    "give at least one solid, or remove it",
                );
            }
            let (mut surface, mut solids) = (Surface::default(), Vec::new());
            for entry in entries {
                let what = if entries.len() > 1 { format!("each entry of {what}") } else { what.clone() };
                let (drawn, solid) = drawn(reader, entry, &what, center)?;
                surface.append(&drawn);
                solids.extend(solid);
            }
            let surface = (!surface.triangles.is_empty()).then(|| Arc::new(surface));
            Some(Body { surface, solids })
        }
        (None, Some(node)) => Some(Body { surface: file(reader, node, "mesh")?, solids: Vec::new() }),
        (Some(_), Some(node)) => {
            let message = format!("{} has both `shape` and `mesh`", reader.what);
            context.fail(node.span, message, "remove one of them")
        }
    }
}

/// The surface of a file that `key` names; none where no files are looked for.
#[expect(clippy::option_option, reason = "a mistake, or no file looked for")]
fn file(reader: &Reader<'_, '_>, node: &Node, key: &str) -> Option<Option<Arc<Surface>>> {
    let context = reader.context;
    let name = reader.text(key)?.value;
    let path = joined(context.sources.file(node.span), name);
    match context.library.surface(&path) {
        Ok(surface) => Some(surface),
        Err(error) => {
            let problem = Problem::error(node.span, format!("{}: {}", reader.words(key), error.message));
            context.report(problem.label("named here").maybe_help(error.help));
            None
        }
    }
}

/// The surface of a solid or a file at its position in the body, and the solid.
fn drawn(
    reader: &Reader<'_, '_>,
    node: &Node,
    what: &str,
    center: &Vector3,
) -> Option<(Surface, Option<PlacedSolid>)> {
    let own = opened(reader, node, what, Shape::drawn_keys())?;
    let kind = kind(&own, node, what)?;
    let vector = |key: &str, default: Vector3| {
        if own.has(key) { own.vector(key).map(|vector| vector.value) } else { Some(default) }
    };
    // Files have axes of their own, solids their centre.
    let origin = if kind == "mesh" { Vector3::zeros() } else { *center };
    let frame = Motion::new(
        Rotation::exponential(&vector("rotation", Vector3::zeros())?),
        vector("position", origin)?,
    );
    if kind == "mesh" {
        let scale = vector("scale", Vector3::repeat(1.0))?;
        let surface = file(&own, own.node("file")?, "file")?;
        return Some((surface.map_or_else(Surface::default, |surface| surface.moved(&frame, &scale)), None));
    }
    if kind == "plane" {
        let normal = direction(&own, "normal")?;
        let frame = frame * Motion::new(turned_to(&normal), Vector3::zeros());
        return Some((Surface::default(), Some(PlacedSolid { form: Form::HalfSpace, frame })));
    }
    let solid = read(&own, node, kind)?;
    let surface = Surface::of_solid(&solid, &Vector3::zeros()).moved(&frame, &Vector3::repeat(1.0));
    let turn = match solid {
        Solid::Tube { axis, .. } | Solid::Capsule { axis, .. } => turned_to(&axis),
        Solid::Box(_) | Solid::Sphere(_) => Rotation::IDENTITY,
    };
    let placed = PlacedSolid { form: Form::Solid(solid), frame: frame * Motion::new(turn, Vector3::zeros()) };
    Some((surface, Some(placed)))
}

/// The shortest rotation of the third axis to a unit vector.
fn turned_to(axis: &Vector3) -> Rotation {
    let across = Vector3::z().cross(axis);
    let sine = across.norm();
    let angle = sine.atan2(axis.z);
    let turn = if sine > 0.0 { across * (angle / sine) } else { angle * Vector3::x() };
    Rotation::exponential(&turn)
}

/// A direction in body axes, by default the third.
fn direction(own: &Reader<'_, '_>, key: &str) -> Option<Vector3> {
    own.node(key).map_or(Some(Vector3::z()), |axis| {
        own.context.own_direction(axis, &own.words(key)).map(|axis| axis.normalize())
    })
}

fn opened<'c, 'a>(
    reader: &Reader<'c, 'a>,
    node: &'c Node,
    what: &str,
    keys: Vec<Key>,
) -> Option<Reader<'c, 'a>> {
    Reader::open(reader.context, node, (what.to_owned(), node.span), keys)
}

/// The kind of a solid, which has its dimensions and no others.
fn kind(own: &Reader<'_, '_>, node: &Node, what: &str) -> Option<&'static str> {
    let context = own.context;
    let short: Vec<&'static str> = SHORT.into_iter().filter(|key| own.has(key)).collect();
    let given = usize::from(own.has("kind")) + short.len();
    if given != 1 {
        let message = format!("{what} must name one solid, not {given}");
        let help = "write `kind = \"box\"` with its `sides`, or `cylinder`, `tube`, `sphere` or `capsule` with a `radius` …";
        return context.fail(node.span, message, help);
    }
    let named = own.choice("kind").map(|kind| kind.value);
    let (kind, dimensions) = match short.first() {
        Some(short) => (*short, &["axis"][..]),
        None => *KINDS.iter().find(|(kind, _)| Some(*kind) == named)?,
    };
    let has_no_axis = matches!(kind, "box" | "sphere");
    let misses = |key: &&&str| !dimensions.contains(key) || (**key == "axis" && has_no_axis);
    if let Some(strange) = DIMENSIONS.iter().filter(misses).find(|key| own.has(key)) {
        return context.fail(node.span, format!("a {kind} has no `{strange}`"), "remove it");
    }
    let is_needed = |key: &&&str| !OPTIONAL.contains(key) && !own.has(key);
    if let Some(missing) = dimensions.iter().find(is_needed) {
        return context.fail(
            node.span,
            format!("{what} lacks `{missing}`"),
            "a solid needs all of its dimensions",
        );
    }
    Some(kind)
}

/// The solid of a kind that is no file.
fn read(own: &Reader<'_, '_>, node: &Node, kind: &str) -> Option<Solid> {
    let context = own.context;
    let number = |key: &str| own.number(key).map(|number| number.value);
    let axis = direction(own, "axis")?;
    let short = own.node(kind).filter(|_| !own.has("kind"));
    let solid = match (kind, short) {
        ("box", None) => Solid::Box(own.vector("sides")?.value.into()),
        ("box", Some(value)) => Solid::Box(context.numbers::<3>(value, &own.words(kind))?),
        ("cylinder", None) => {
            Solid::Tube { outer: number("radius")?, inner: 0.0, length: number("length")?, axis }
        }
        ("cylinder", Some(value)) => {
            let [radius, length] = context.numbers::<2>(value, &own.words(kind))?;
            Solid::Tube { outer: radius, inner: 0.0, length, axis }
        }
        ("tube", None) => Solid::Tube {
            outer: number("radius")?,
            inner: number("inner_radius")?,
            length: number("length")?,
            axis,
        },
        ("tube", Some(value)) => {
            let [outer, inner, length] = context.numbers::<3>(value, &own.words(kind))?;
            Solid::Tube { outer, inner, length, axis }
        }
        ("capsule", _) => Solid::Capsule { radius: number("radius")?, length: number("length")?, axis },
        (_, None) => Solid::Sphere(number("radius")?),
        (_, Some(_)) => Solid::Sphere(number("sphere")?),
    };
    if solid.is_solid() {
        return Some(solid);
    }
    let message = format!(
        "{} is not a valid solid: lengths must be greater than zero, and the outer radius must exceed the inner one",
        own.what
    );
    context.fail(short.unwrap_or(node).span, message, "check the order of the numbers")
}
