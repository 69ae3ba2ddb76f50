//! What shells and solids share as entries: files of meshes, numbers of elements, sets of nodes, expressions of places.

use lissom_mesh::{Mesh, MeshError, MeshedPart, Region};
use lissom_motion::Vector3;

use crate::expression::Formula;
use crate::format::keys::{Key, Shape, optional};
use crate::format::suggest;
use crate::reading::mesh_nodes::ALL;
use crate::reading::reader::Reader;
use crate::text::Node;
use crate::text::report::Problem;

impl Shape {
    /// Keys of a set of nodes.
    fn set_keys() -> Vec<Key> {
        vec![
            optional("near", Self::Place, "m", "the nearest node"),
            optional("center", Self::Place, "m", "nodes within `radius` of it"),
            optional("radius", Self::Positive, "m", "of a ball of nodes"),
            optional("from", Self::Place, "m", "corner of a box of nodes along the axes"),
            optional("to", Self::Place, "m", "the opposite corner"),
        ]
    }
}

/// The only key of several that says where elements are.
pub(super) fn one_of<'k>(
    reader: &Reader<'_, '_>,
    (keys, noun): ([&'k str; 3], &str),
    help: &str,
) -> Option<&'k str> {
    let given: Vec<&str> = keys.into_iter().filter(|key| reader.has(key)).collect();
    match given[..] {
        [key] => Some(key),
        [] => reader.context.fail(reader.name, format!("{} has no {noun}", reader.what), help),
        [_, second, ..] => {
            let span = reader.node(second).map_or(reader.name, |node| node.span);
            reader.context.fail(span, format!("{} has several {noun}s", reader.what), help)
        }
    }
}

/// Usual sizes of parts from files [m].
const SIZES: std::ops::Range<f64> = 1e-4..100.0;

/// The mesh of the file of an entry, and what `take` makes of it with the set that `group` names. Reports what of the file was not read.
pub(super) fn file<T>(
    reader: &Reader<'_, '_>,
    (page, whole): (&str, &str),
    take: impl FnOnce(Mesh, Option<&str>) -> Result<(T, Mesh), MeshError>,
) -> Option<(T, Mesh)> {
    let (context, node) = (reader.context, reader.node("mesh")?);
    let path = reader.text("mesh")?;
    let what = reader.words("mesh");
    let text = context.file_text(node, path.value, &what)?;
    let extension = path.value.rsplit_once('.').map_or("", |(_, extension)| extension);
    let group = reader.text("group").map(|group| group.value.to_owned());
    let read = lissom_mesh::read(text.as_bytes(), extension).and_then(|mesh| take(mesh, group.as_deref()));
    let (taken, mesh) = match read {
        Ok(read) => read,
        Err(error) => {
            let help = format!("see docs/{page} for what is read of meshes");
            return context.fail(node.span, format!("{what}: {error}"), help);
        }
    };
    if let Some((first, others)) = mesh.notes.split_first() {
        let more =
            if others.is_empty() { String::new() } else { format!("; {} more are left out", others.len()) };
        let problem = Problem::warning(node.span, format!("{what} is read in part: {first}{more}"));
        let help = format!("check that nothing of the {whole} is missing: `lissom view --initial`");
        context.report(problem.help(help));
    }
    let scale = reader.number("scale")?.value;
    let positions = || mesh.positions.iter().map(|position| scale * Vector3::from(*position));
    let size = positions()
        .next()
        .map_or(0.0, |first| positions().map(|position| (position - first).norm()).fold(0.0, f64::max));
    if !SIZES.contains(&size) {
        let problem = Problem::warning(node.span, format!("{what} is {size:.1e} m large"));
        let help = "write `scale = 1e-3` for a file in millimetres, and lengths of the model in m";
        context.report(problem.help(help));
    }
    Some((taken, mesh))
}

/// Most elements along one side of a patch.
const MAX_DIVISIONS: f64 = 2000.0;

/// Numbers of elements along each coordinate.
pub(super) fn divisions<const COUNT: usize>(
    reader: &Reader<'_, '_>,
    node: &Node,
    example: &str,
) -> Option<[usize; COUNT]> {
    let what = reader.words("divisions");
    let numbers = reader.context.numbers::<COUNT>(node, &what)?;
    if let Some(wrong) = numbers.iter().find(|n| n.fract() != 0.0 || !(1.0..=MAX_DIVISIONS).contains(*n)) {
        let message = format!("{what} must be whole numbers from 1 to {MAX_DIVISIONS}, not {wrong}");
        let help = format!("write for example `divisions = {example}`");
        return reader.context.fail(node.span, message, help);
    }
    Some(numbers.map(|number| number as usize))
}

/// An expression that names nothing but these arguments and the parameters.
pub(super) fn formula(reader: &Reader<'_, '_>, node: &Node, what: &str, known: &[&str]) -> Option<Formula> {
    let formula = reader.context.own_formula(node, what)?;
    let unknown = formula.arguments().iter().find(|name| !known.contains(&name.text.as_str()));
    let is_of_time = formula.depends_on_time() && !known.contains(&"t");
    if unknown.is_none() && !is_of_time {
        return Some(formula);
    }
    let name = unknown.map_or("t", |name| name.text.as_str());
    let message = format!("{what} cannot name `{name}`");
    let help = format!("it may contain {} and the parameters", suggest::list(known.to_vec()));
    let near = suggest::help(name, known.iter().copied());
    reader
        .context
        .report(Problem::error(node.span, message).label("unknown here").help(help).maybe_help(near));
    None
}

/// Adds the set of all nodes, and reads `sets` of nodes.
pub(super) fn sets(reader: &Reader<'_, '_>, mesh: &mut MeshedPart) -> Option<()> {
    let context = reader.context;
    let all = mesh.positions.len();
    let of_file = mesh.sets.insert(ALL.to_owned(), (0..all).collect());
    if let Some(count) = of_file.map(|own| own.len()).filter(|&count| count < all) {
        let message =
            format!("the mesh of {} has a set `{ALL}` of {count} nodes, not of its {all}", reader.what);
        let help = "this name means all nodes: give the set in the file another one";
        return context.fail(reader.name, message, help);
    }
    let Some(node) = reader.node("sets") else { return Some(()) };
    let Some(table) = node.table() else {
        return context.wrong_type(node, &reader.words("sets"), "a table of sets");
    };
    for (name, entry) in table {
        let what = format!("set `{name}` of {}", reader.what);
        if let Some(present) = mesh.sets.get(name) {
            let of_all = if name == ALL { ", that of all its nodes" } else { "" };
            let count = present.len();
            let message = format!("{} has another set `{name}` of {count} nodes{of_all}", reader.what);
            return context.fail(entry.key, message, "give this one another name");
        }
        let own = Reader::open(context, &entry.node, (what.clone(), entry.node.span), Shape::set_keys())?;
        let place = |key: &str| match own.node(key) {
            Some(node) => context.place(node, &own.words(key)).map(|place| Some(place.value)),
            None => Some(None),
        };
        let region = match (place("near")?, place("center")?, place("from")?, place("to")?) {
            (Some(near), None, None, None) => Region::Near(near),
            (None, Some(center), None, None) => {
                let Some(radius) = own.number("radius") else {
                    let message = format!("{what} lacks `radius`");
                    return context.fail(entry.node.span, message, "add `radius = …`");
                };
                Region::Ball(center, radius.value)
            }
            // Along the axes in which it is written.
            (None, None, Some(from), Some(to)) => Region::Box([from, to], context.frame(own.scope)?),
            _ => {
                let help = "write `near`, or `center` and `radius`, or `from` and `to`";
                return context.fail(entry.node.span, format!("{what} is not one region"), help);
            }
        };
        let found = mesh.nodes_in(&region);
        if found.is_empty() {
            return context.fail(entry.node.span, format!("{what} contains no node"), "make it larger");
        }
        if let (Region::Near(place), [nearest]) = (&region, &found[..]) {
            let distance = (mesh.positions[*nearest] - place).norm();
            let corners = [Vector3::inf, Vector3::sup]
                .map(|of| mesh.positions.iter().copied().reduce(|a, b| of(&a, &b)));
            let size = corners[0].zip(corners[1]).map_or(0.0, |(low, high)| (high - low).norm());
            if distance > size {
                let message = format!(
                    "the node nearest to {what} is {distance:.3} m away, and the whole part is only {size:.3} m large"
                );
                let help = "positions are in metres, also of a mesh with a `scale`: is it in millimetres?";
                return context.fail(entry.node.span, message, help);
            }
        }
        mesh.sets.insert(name.clone(), found);
    }
    Some(())
}
