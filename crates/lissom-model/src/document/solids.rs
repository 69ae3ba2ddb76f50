//! Solids of a model file: those that determine the inertia of a body, and what is drawn of it.

use std::sync::Arc;

use lissom_motion::{Motion, Rotation, Vector3};

use crate::keys::{Key, Shape};
use crate::library::joined;
use crate::reader::Reader;
use crate::report::Problem;
use crate::solid::Solid;
use crate::surface::Surface;
use crate::text::{Node, Value};

/// Kinds of solids with their dimensions.
const KINDS: [(&str, &[&str]); 5] = [
    ("box", &["sides"]),
    ("cylinder", &["radius", "length", "axis"]),
    ("tube", &["radius", "inner_radius", "length", "axis"]),
    ("sphere", &["radius"]),
    ("mesh", &["file", "scale"]),
];
/// All dimensions; those that may be omitted.
const DIMENSIONS: [&str; 7] = ["sides", "radius", "inner_radius", "length", "axis", "file", "scale"];
const OPTIONAL: [&str; 2] = ["axis", "scale"];
/// Kinds whose name may be the key of their dimensions instead.
const SHORT: [&str; 4] = ["box", "cylinder", "tube", "sphere"];

/// The solid of a table, the value of `key`.
pub(super) fn solid(reader: &Reader<'_, '_>, node: &Node, key: &str) -> Option<Solid> {
    let what = reader.words(key);
    let own = opened(reader, node, &what, Shape::solid_keys())?;
    let kind = kind(&own, node, &what)?;
    read(&own, node, kind)
}

/// Surface for drawings, if it is specified; the outer `None` stands for an error.
#[expect(clippy::option_option, reason = "a mistake, or nothing given")]
pub(super) fn surface(reader: &Reader<'_, '_>, center: &Vector3) -> Option<Option<Arc<Surface>>> {
    let context = reader.context;
    match (reader.node("shape"), reader.node("mesh")) {
        (None, None) => Some(None),
        (Some(node), None) => {
            let what = reader.words("shape");
            let Value::List(list) = &node.value else {
                return Some(Some(Arc::new(drawn(reader, node, &what, center)?)));
            };
            if list.is_empty() {
                return context.fail(
                    node.span,
                    format!("{what} is empty"),
                    "give at least one solid, or remove it",
                );
            }
            let mut whole = Surface::default();
            for entry in list {
                whole.append(&drawn(reader, entry, &format!("each entry of {what}"), center)?);
            }
            Some(Some(Arc::new(whole)))
        }
        (None, Some(node)) => file(reader, node, "mesh"),
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

/// The surface of a solid or a file, at its position in the body.
fn drawn(reader: &Reader<'_, '_>, node: &Node, what: &str, center: &Vector3) -> Option<Surface> {
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
    if kind != "mesh" {
        return Some(
            Surface::of_solid(&read(&own, node, kind)?, &Vector3::zeros())
                .moved(&frame, &Vector3::repeat(1.0)),
        );
    }
    let scale = vector("scale", Vector3::repeat(1.0))?;
    let surface = file(&own, own.node("file")?, "file")?;
    Some(surface.map_or_else(Surface::default, |surface| surface.moved(&frame, &scale)))
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
        let help =
            "write `kind = \"box\"` with its `sides`, or `cylinder`, `tube` or `sphere` with a `radius` …";
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
    let axis = match own.node("axis") {
        None => Vector3::z(),
        Some(axis) => context.own_direction(axis, &own.words("axis"))?.normalize(),
    };
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
