//! Solids of a model file: those that determine the inertia of a part, are drawn of it, and touch others.

use std::sync::Arc;

use lissom_contact::forms::{Form, PlacedSolid, Solid, Triangles};
use lissom_contact::geometry::curves::Spline;
use lissom_contact::geometry::surfaces::{HeightField, Mesh, Outline, Polygon};
use lissom_drawing::Shade;
use lissom_motion::{Motion, Rotation, Vector3};

use crate::files::library::joined;
use crate::format::keys::{Key, Shape};
use crate::format::solid_kinds::SOLID_KINDS;
use crate::reading::reader::Reader;
use crate::surface::Surface;
use crate::text::report::Problem;
use crate::text::{Node, Value};

/// Dimensions that may be omitted.
const OPTIONAL: [&str; 4] = ["axis", "normal", "smooth", "scale"];
/// Most corners of a hull: with each of them it may touch a plane.
const MAX_CORNERS: usize = 200;
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
            let (mut surface, mut solids) = (Surface::default(), Vec::new());
            let mut positioned = Vec::new();
            for entry in entries {
                let what = if entries.len() > 1 { format!("each entry of {what}") } else { what.clone() };
                let own = opened(reader, entry, &what, Shape::drawn_keys())?;
                let touches = own.flag("touches")?.value;
                positioned.push(own.has("position"));
                let (drawn, solid) = drawn((&own, entry), &what, center)?;
                surface.append(&drawn.painted(colour(&own)?));
                solids.extend(touches.then_some(solid));
            }
            if *center != Vector3::zeros() && positioned.contains(&true) && positioned.contains(&false) {
                let message =
                    format!("some solids of {what} have no `position`: they are at the centre of mass");
                let help =
                    "give each of them a `position`, which is measured from the body's reference point";
                context.report(Problem::warning(node.span, message).help(help));
            }
            // Without entries nothing is drawn; without files that were looked for, the solid with its inertia.
            let is_drawn = entries.is_empty() || !surface.triangles.is_empty();
            Some(Body { surface: is_drawn.then(|| Arc::new(surface)), solids })
        }
        (None, Some(node)) => Some(Body { surface: file(reader, node, "mesh")?, solids: Vec::new() }),
        (Some(_), Some(node)) => {
            let message = format!("{} has both `shape` and `mesh`", reader.what);
            context.fail(node.span, message, "remove one of them")
        }
    }
}

/// The colour of a solid, none for that of its part.
#[expect(clippy::option_option, reason = "a mistake, or no colour")]
fn colour(own: &Reader<'_, '_>) -> Option<Option<Shade>> {
    let Some(node) = own.node("colour") else { return Some(None) };
    let digits = own
        .text("colour")?
        .value
        .strip_prefix('#')
        .filter(|digits| digits.len() == 6 && digits.bytes().all(|digit| digit.is_ascii_hexdigit()));
    if own.text("kind").is_some_and(|kind| kind.value == "plane") {
        let message = format!("{}: a plane is drawn in the colour of the ground", own.what);
        return own.context.fail(node.span, message, "remove `colour`");
    }
    if let Some(Ok(number)) = digits.map(|digits| u32::from_str_radix(digits, 16)) {
        let [_, red, green, blue] = number.to_be_bytes();
        return Some(Some([red, green, blue]));
    }
    let message = format!("{} is no colour", own.words("colour"));
    own.context.fail(
        node.span,
        message,
        "write red, green and blue as six hexadecimal digits, such as \"#d1495b\"",
    )
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
    (own, node): (&Reader<'_, '_>, &Node),
    what: &str,
    center: &Vector3,
) -> Option<(Surface, PlacedSolid)> {
    let kind = kind(own, node, what)?;
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
        let scale = own.vector("scale")?.value;
        let surface = file(own, own.node("file")?, "file")?;
        let scaled = surface.map_or_else(Surface::default, |own| own.moved(&Motion::IDENTITY, &scale));
        let points = scaled.points.iter().map(|point| Vector3::from(point.map(f64::from))).collect();
        let form = Form::Mesh(Arc::new(Triangles { points, triangles: scaled.triangles.clone() }));
        let placed = PlacedSolid { form, frame };
        return Some((scaled.moved(&frame, &Vector3::repeat(1.0)), placed));
    }
    let other = match kind {
        "plane" => Some((Form::HalfSpace, direction(own, "normal")?)),
        "outline" => Some((outline(own)?, direction(own, "axis")?)),
        "hull" => Some((hull(own)?, Vector3::z())),
        "height_field" => Some((height_field(own)?, Vector3::z())),
        _ => None,
    };
    if let Some((form, axis)) = other {
        let length = if kind == "outline" { own.number("length")?.value } else { 0.0 };
        let frame = frame * Motion::new(turned_to(&axis), Vector3::zeros());
        let surface = Surface::of_form(&form, length).moved(&frame, &Vector3::repeat(1.0));
        return Some((surface, PlacedSolid { form, frame }));
    }
    let solid = read(own, node, kind)?;
    let surface = Surface::of_solid(&solid, &Vector3::zeros()).moved(&frame, &Vector3::repeat(1.0));
    let turn = match solid {
        Solid::Tube { axis, .. } | Solid::Capsule { axis, .. } => turned_to(&axis),
        Solid::Box(_) | Solid::Sphere(_) | Solid::Ellipsoid(_) => Rotation::IDENTITY,
    };
    let placed = PlacedSolid { form: Form::Solid(solid), frame: frame * Motion::new(turn, Vector3::zeros()) };
    Some((surface, placed))
}

/// The outline of a prism.
fn outline(own: &Reader<'_, '_>) -> Option<Form> {
    let (context, node) = (own.context, own.node("points")?);
    let rows = context.number_rows(node, Some(2), &own.words("points"))?;
    let points: Vec<[f64; 2]> = rows.iter().map(|row| [row[0], row[1]]).collect();
    if let Some([first, second]) = crossing(&points) {
        let message = format!("{} cross themselves between {first:?} and {second:?}", own.words("points"));
        return context.fail(node.span, message, "give the points in their order around the outline");
    }
    let is_smooth = own.flag("smooth")?.value;
    let form = if is_smooth {
        Spline::new(&points).map(|curve| Form::Outline(Arc::new(Outline::new(curve))))
    } else {
        Polygon::new(&points).map(|polygon| Form::Polygon(Arc::new(polygon)))
    };
    form.or_else(|| {
        let message = format!("{} enclose no area", own.words("points"));
        context.fail(
            node.span,
            message,
            "give at least three points in their order, each one apart from the next",
        )
    })
}

/// The first points of two sides of a polygon that cross.
fn crossing(points: &[[f64; 2]]) -> Option<[[f64; 2]; 2]> {
    let count = points.len();
    let end = |k: usize| points[(k + 1) % count];
    // Twice the area of a triangle, positive counterclockwise.
    let area =
        |a: [f64; 2], b: [f64; 2], c: [f64; 2]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let separates = |[a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]| area(a, b, c) * area(a, b, d) < 0.0;
    for first in 0..count {
        for second in first + 2..count {
            let sides = [[points[first], end(first)], [points[second], end(second)]];
            if separates(sides[0], sides[1]) && separates(sides[1], sides[0]) {
                return Some([sides[0][0], sides[1][0]]);
            }
        }
    }
    None
}

/// The convex hull of points.
fn hull(own: &Reader<'_, '_>) -> Option<Form> {
    let (context, node) = (own.context, own.node("points")?);
    let rows = context.number_rows(node, Some(3), &own.words("points"))?;
    let points: Vec<Vector3> = rows.iter().map(|row| Vector3::from_column_slice(row)).collect();
    match Mesh::hull(&points) {
        Ok(mesh) if mesh.corners().count() <= MAX_CORNERS => Some(Form::Hull(Arc::new(mesh))),
        Ok(mesh) => {
            let message =
                format!("the hull of {} has {} corners", own.words("points"), mesh.corners().count());
            context.fail(node.span, message, format!("give points whose hull has at most {MAX_CORNERS}"))
        }
        Err(error) => {
            let message = format!("{} enclose no solid: {error}", own.words("points"));
            context.fail(node.span, message, "give at least four points that are not in a plane")
        }
    }
}

fn height_field(own: &Reader<'_, '_>) -> Option<Form> {
    let (context, node) = (own.context, own.node("heights")?);
    let heights = context.number_rows(node, None, &own.words("heights"))?;
    let [x, y] = context.numbers::<2>(own.node("extent")?, &own.words("extent"))?;
    let is_valid = x > 0.0 && y > 0.0;
    let field = HeightField::new(heights, [x, y]).filter(|_| is_valid);
    let field = field.map(|field| Form::HeightField(Arc::new(field)));
    field.or_else(|| {
        let message = format!("{} is no surface", own.what);
        context.fail(node.span, message, "give at least two rows of two heights, and sides greater than zero")
    })
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
        None => {
            SOLID_KINDS.iter().find(|kind| Some(kind.word) == named).map(|kind| (kind.word, kind.keys))?
        }
    };
    let has_no_axis = matches!(kind, "box" | "sphere");
    let all = SOLID_KINDS.iter().flat_map(|kind| kind.keys);
    let misses = |key: &&&str| !dimensions.contains(key) || (**key == "axis" && has_no_axis);
    if let Some(strange) = all.filter(misses).find(|key| own.has(key)) {
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
    let short = if own.has("kind") { None } else { own.node(kind) };
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
        ("ellipsoid", _) => Solid::Ellipsoid(own.vector("semi_axes")?.value.into()),
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
