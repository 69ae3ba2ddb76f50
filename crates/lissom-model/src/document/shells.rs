//! Shells of a model file: their surfaces, sections, sets of nodes and loads per area.

use std::collections::BTreeMap;
use std::sync::Arc;

use lissom_flexible::shell::section::Ply;
use lissom_mesh::{Mesh, MeshFaultKind, MeshShape, Severity};
use lissom_motion::{Motion, Vector3};

use super::Material;
use super::entries::each;
use crate::expression::Formula;
use crate::format::keys::{Key, Shape, optional, required};
use crate::format::part_tables::placed_in;
use crate::format::suggest;
use crate::parts::context::Context;
use crate::reading::mesh_nodes::ALL;
use crate::reading::reader::Reader;
use crate::reading::shell_mesh::ShellMesh;
use crate::text::report::{Located, Problem, Span};
use crate::text::{Node, Value};

/// Names of the sides of a patch: u = 0 and 1, v = 0 and 1.
const SIDES: [&str; 4] = ["west", "east", "south", "north"];
/// Relative distance of nodes that count as one.
const SAME: f64 = 1e-9;

/// A shell.
#[derive(Clone, Debug)]
pub struct Shell {
    /// Name.
    pub name: Located<String>,
    /// Its nodes and elements.
    pub mesh: Arc<ShellMesh>,
    /// Layers from the bottom to the top, without thickness.
    pub layers: Vec<Layer>,
    /// Direction that is projected on the surface to be the first local axis.
    pub direction: Option<Vector3>,
    /// Largest angle between elements that count as one smooth surface [rad].
    pub fold_angle: f64,
    /// Place of the middle of its thickness along the normal [m].
    pub offset: f64,
    /// Damping in proportion to the stiffness [s].
    pub damping: f64,
    /// Loads per area.
    pub loads: Vec<AreaLoad>,
}

/// A layer of a shell.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// Thickness over u and v, its only arguments [m].
    pub thickness: Formula,
    /// Where it is.
    pub span: Span,
    /// All the rest; its thickness is that at the first element.
    pub ply: Ply,
}

/// A load per area of a shell.
#[derive(Clone, Debug, PartialEq)]
pub struct AreaLoad {
    /// Of a pressure one, of a force per area three components over u, v and t.
    pub components: Vec<Formula>,
    /// Whether a pressure acts on the face of the normal.
    pub is_on_top: bool,
    /// Rotation of the axes of three components.
    pub axes: Motion,
    /// Where it is.
    pub span: Span,
}

impl Shell {
    /// Layers of an element.
    pub fn plies(&self, element: usize) -> Vec<Ply> {
        let middle = self.mesh.middle(element);
        self.layers.iter().map(|layer| Ply { thickness: layer.thickness_at(middle), ..layer.ply }).collect()
    }

    /// Whole thickness at an element [m].
    pub fn thickness(&self, element: usize) -> f64 {
        let middle = self.mesh.middle(element);
        self.layers.iter().map(|layer| layer.thickness_at(middle)).sum()
    }
}

impl Layer {
    fn thickness_at(&self, place: [f64; 2]) -> f64 {
        value_at(&self.thickness, place)
    }
}

/// Arguments of an expression of u and v, in its order.
pub(crate) fn area_arguments(formula: &Formula, place: [f64; 2]) -> Vec<f64> {
    formula.arguments().iter().map(|name| place[usize::from(name.text == "v")]).collect()
}

fn value_at(formula: &Formula, place: [f64; 2]) -> f64 {
    formula.with_arguments(&area_arguments(formula, place)).value(0.0)
}

/// Keys of a shell.
pub(super) fn keys() -> Vec<Key> {
    vec![
        placed_in(),
        optional(
            "corners",
            Shape::Corners,
            "m",
            "four corners of a patch, counterclockwise about its normal: u = v = 0; u = 1; u = v = 1; v = 1",
        ),
        optional("surface", Shape::Surface, "m", "instead of `corners`: x, y and z over u and v from 0 to 1"),
        optional("divisions", Shape::Divisions, "", "of a patch: numbers of elements along u and v"),
        optional(
            "mesh",
            Shape::Text,
            "",
            "instead of `corners`: a Gmsh (.msh), Abaqus (.inp) or Wavefront (.obj) file; path relative to this file",
        ),
        optional(
            "group",
            Shape::Text,
            "",
            "of a mesh: the set of its elements to be used; default all surfaces",
        ),
        optional("scale", Shape::Positive, "", "of a mesh: factor to metres").or_number(1.0),
        optional(
            "join",
            Shape::Flag,
            "",
            "whether nodes at the same position are one, as along the seam of a tube",
        )
        .or_flag(false),
        optional(
            "thickness",
            Shape::Thickness,
            "m",
            "a number or an expression of u and v; it or `plies` is required, unless the file of the mesh has one section for all elements",
        ),
        optional("material", Shape::Name("materials"), "", "of `thickness`, and of plies without their own"),
        optional(
            "offset",
            Shape::Number,
            "m",
            "place of the middle of the thickness along the normal of the surface",
        )
        .or_number(0.0),
        optional("damping", Shape::NotNegative, "s", "damping in proportion to the stiffness").or_number(0.0),
        optional("plies", Shape::Plies, "", "layers of a laminate from the bottom to the top of the normal"),
        optional(
            "direction",
            Shape::Direction,
            "",
            "projected on the surface, the first local axis, from which angles of plies count; default the direction of u of a patch, global x of a mesh",
        ),
        optional(
            "fold_angle",
            Shape::Between(0.0, 3.2),
            "rad",
            "largest angle between elements of a mesh that count as one smooth surface",
        )
        .or_number(0.52),
        optional(
            "pressure",
            Shape::AreaSize,
            "Pa",
            "force per area along the normal, which it follows, as on the face opposite to it: an expression of u, v and t",
        ),
        optional(
            "pressure_on_top",
            Shape::AreaSize,
            "Pa",
            "force per area on the face of the normal, against the normal, as `top` in `pressure` of a solid: an expression of u, v and t",
        ),
        optional(
            "force_per_area",
            Shape::AreaDistribution,
            "Pa",
            "in global axes, fixed in direction: three numbers or expressions of u, v and t",
        ),
        optional(
            "sets",
            Shape::Table,
            "",
            "named nodes: `{ near = [x, y, z] }`, `{ center = [x, y, z], radius = r }` or `{ from = [x, y, z], to = [x, y, z] }`",
        ),
    ]
}

impl Shape {
    /// Keys of a layer of a laminate.
    pub(crate) fn ply_keys() -> Vec<Key> {
        vec![
            required("thickness", Self::Thickness, "m", "a number or an expression of u and v"),
            optional("angle", Self::Number, "rad", "from the first local axis to its fibres").or_number(0.0),
            optional(
                "material",
                Self::Name("materials"),
                "",
                "isotropic material; default that of the shell",
            ),
            optional("E1", Self::Positive, "Pa", "Young's modulus along the fibres, instead of a material"),
            optional("E2", Self::Positive, "Pa", "Young's modulus across the fibres"),
            optional("nu12", Self::Number, "", "contraction across over extension along the fibres"),
            optional("G12", Self::Positive, "Pa", "shear modulus in the plane"),
            optional("G13", Self::Positive, "Pa", "transverse shear modulus along the fibres; default `G12`"),
            optional(
                "G23",
                Self::Positive,
                "Pa",
                "transverse shear modulus across the fibres; default `G12`",
            ),
            optional("density", Self::Positive, "kg/m³", "mass density"),
        ]
    }

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

pub(super) fn shells(context: &Context<'_>, materials: &[Material]) -> Vec<Shell> {
    each(context, "shells", |reader, name| {
        let mesh = mesh_of(reader);
        let direction = match reader.node("direction") {
            Some(_) => Some(reader.vector("direction")?.value),
            None => None,
        };
        let fold_angle = reader.number("fold_angle");
        let (offset, damping) = (reader.number("offset"), reader.number("damping"));
        let loads = loads(reader);
        let (mut mesh, layer) = mesh?;
        let is_patch = mesh.places.is_some();
        let layers = layers(reader, materials, layer)?;
        if reader.flag("join")?.value {
            join(&mut mesh);
        }
        sets(reader, &mesh.positions, &mut mesh.sets)?;
        let shell = Shell {
            name: Located::new(name.to_owned(), reader.name),
            mesh: Arc::new(mesh),
            layers,
            direction,
            fold_angle: fold_angle?.value,
            offset: offset?.value,
            damping: damping?.value,
            loads: loads?,
        };
        check(reader, &shell, is_patch)?;
        Some(shell)
    })
}

fn mesh_of(reader: &Reader<'_, '_>) -> Option<(ShellMesh, Option<Layer>)> {
    let context = reader.context;
    let given: Vec<&str> = ["corners", "surface", "mesh"].into_iter().filter(|key| reader.has(key)).collect();
    let help = "write `corners` or `surface` with `divisions`, or a `mesh`";
    match given[..] {
        ["mesh"] => {
            if let Some(node) = reader.node("divisions") {
                let message = format!("{} has a `mesh`, which has its own elements", reader.what);
                return context.fail(node.span, message, "remove `divisions`");
            }
            mesh(reader)
        }
        [key] => {
            if let Some((unused, node)) =
                ["group", "scale"].iter().find_map(|key| Some((key, reader.node(key)?)))
            {
                let message = format!("{} has `{unused}`, which is used with a `mesh` only", reader.what);
                return context.fail(node.span, message, format!("remove `{unused}`"));
            }
            let Some(node) = reader.node("divisions") else {
                let message = format!("{} lacks `divisions`", reader.what);
                return context.fail(
                    reader.name,
                    message,
                    "add `divisions = [8, 4]`: elements along u and v",
                );
            };
            let divisions = divisions::<2>(reader, node, "[8, 4]")?;
            let surface = if key == "corners" { corners(reader)? } else { expressions(reader)? };
            patch(reader, &surface, divisions).map(|mesh| (mesh, None))
        }
        [] => context.fail(reader.name, format!("{} has no surface", reader.what), help),
        [_, second, ..] => {
            let span = reader.node(second).map_or(reader.name, |node| node.span);
            context.fail(span, format!("{} has several surfaces", reader.what), help)
        }
    }
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

/// Position at u and v with its derivatives by both.
type PointOf = Box<dyn Fn(f64, f64) -> [Vector3; 3]>;

fn corners(reader: &Reader<'_, '_>) -> Option<PointOf> {
    let (context, node) = (reader.context, reader.node("corners")?);
    let what = reader.words("corners");
    let Value::List(list) = &node.value else {
        return context.wrong_type(node, &what, "a list of four positions");
    };
    if list.len() != 4 {
        let message = format!("{what} must be four positions, not {}", list.len());
        return context.fail(node.span, message, "list them counterclockwise about the normal");
    }
    let read: Vec<Option<Vector3>> =
        list.iter().map(|entry| context.place(entry, &what).map(|place| place.value)).collect();
    let p: Vec<Vector3> = read.into_iter().collect::<Option<_>>()?;
    Some(Box::new(move |u, v| {
        let along = (1.0 - v) * (p[1] - p[0]) + v * (p[2] - p[3]);
        let across = (1.0 - u) * (p[3] - p[0]) + u * (p[2] - p[1]);
        let south = (1.0 - u) * p[0] + u * p[1];
        let north = (1.0 - u) * p[3] + u * p[2];
        [(1.0 - v) * south + v * north, along, across]
    }))
}

fn expressions(reader: &Reader<'_, '_>) -> Option<PointOf> {
    let (context, node) = (reader.context, reader.node("surface")?);
    let what = reader.words("surface");
    let list = context.list(node, 3, &what)?;
    let read: Vec<Option<Formula>> =
        list.iter().map(|entry| formula(reader, entry, &what, &["u", "v"])).collect();
    let formulas: Vec<Formula> = read.into_iter().collect::<Option<_>>()?;
    let frame = context.frame(reader.scope)?;
    Some(Box::new(move |u, v| {
        let jet = |formula: &Formula, along: [f64; 2]| {
            let argument = |index: usize| {
                let k = usize::from(formula.arguments()[index].text == "v");
                ([u, v][k], along[k])
            };
            formula.jet((0.0, 0.0), argument)
        };
        let of = |along: [f64; 2], order: usize| Vector3::from_fn(|k, _| jet(&formulas[k], along)[order]);
        let slope = |along: [f64; 2]| frame.rotation.apply(&of(along, 1));
        [frame.transform_point(&of([0.0, 0.0], 0)), slope([1.0, 0.0]), slope([0.0, 1.0])]
    }))
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

fn patch(reader: &Reader<'_, '_>, surface: &PointOf, [m, n]: [usize; 2]) -> Option<ShellMesh> {
    let (mut positions, mut places, mut normals) = (Vec::new(), Vec::new(), Vec::new());
    for j in 0..=n {
        for i in 0..=m {
            let place = [i as f64 / m as f64, j as f64 / n as f64];
            let [position, along, across] = surface(place[0], place[1]);
            let normal = along.cross(&across);
            let size = along.norm() * across.norm();
            if !(normal.norm() > 1e-8 * size && position.iter().all(|x| x.is_finite())) {
                let message = format!(
                    "{} has no normal at u = {:.4}, v = {:.4}: its sides are parallel or have no length there",
                    reader.what, place[0], place[1]
                );
                let help = "elements have four corners: leave out the pole of a surface, or use a mesh";
                let span = ["surface", "corners"].iter().find_map(|key| reader.node(key));
                return reader.context.fail(span.map_or(reader.name, |node| node.span), message, help);
            }
            positions.push(position);
            places.push(place);
            normals.push(normal.normalize());
        }
    }
    let node = |i: usize, j: usize| j * (m + 1) + i;
    let element = |k: usize| {
        let (i, j) = (k % m, k / m);
        [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]
    };
    let sides: [Vec<usize>; 4] = [
        (0..=n).map(|j| node(0, j)).collect(),
        (0..=n).map(|j| node(m, j)).collect(),
        (0..=m).map(|i| node(i, 0)).collect(),
        (0..=m).map(|i| node(i, n)).collect(),
    ];
    let sets: BTreeMap<String, Vec<usize>> = SIDES.map(str::to_owned).into_iter().zip(sides).collect();
    let elements = (0..m * n).map(element).collect();
    Some(ShellMesh { positions, places: Some(places), normals: Some(normals), elements, sets })
}

fn mesh(reader: &Reader<'_, '_>) -> Option<(ShellMesh, Option<Layer>)> {
    let (context, node) = (reader.context, reader.node("mesh")?);
    let path = reader.text("mesh")?;
    let what = reader.words("mesh");
    let fail =
        |message: String, help: &str| context.fail::<()>(node.span, format!("{what}: {message}"), help);
    let text = context.file_text(node, path.value, &what)?;
    let extension = path.value.rsplit_once('.').map_or("", |(_, extension)| extension);
    let is_surface = |shape: MeshShape| matches!(shape, MeshShape::Triangle3 | MeshShape::Quadrilateral4);
    let group = reader.text("group").map(|group| group.value.to_owned());
    let read = lissom_mesh::read(text.as_bytes(), extension)
        .and_then(|mesh| mesh.part(group.as_deref(), is_surface));
    let mut mesh = match read {
        Ok(mesh) => mesh,
        Err(error) => {
            fail(error.to_string(), "see docs/shells.md for what is read of meshes");
            return None;
        }
    };
    if mesh.elements.is_empty() {
        fail("it has no triangles or quadrilaterals".to_owned(), "mesh the surface, or name another `group`");
        return None;
    }
    if let Some((first, others)) = mesh.notes.split_first() {
        let more =
            if others.is_empty() { String::new() } else { format!("; {} more are left out", others.len()) };
        let problem = Problem::warning(node.span, format!("{what} is read in part: {first}{more}"));
        context.report(problem.help("check that nothing of the surface is missing: `lissom view --initial`"));
    }
    let scale = reader.number("scale")?.value;
    // Other lengths than metres mean other units of its material.
    let layer = layer_of_file(&mesh, node.span).filter(|_| scale == 1.0);
    mesh.orient();
    let joins = reader.flag("join")?.value;
    for fault in mesh.surface_faults() {
        match fault.severity() {
            // Nodes at one position become one.
            Severity::Error if joins && fault.kind == MeshFaultKind::TornMesh => {}
            Severity::Error => {
                fail(fault.to_string(), "mend the mesh, or set `join = true` for nodes at the same position");
                return None;
            }
            Severity::Warning => context.report(Problem::warning(node.span, format!("{what}: {fault}"))),
            Severity::Note => {}
        }
    }
    if mesh.elements.iter().any(|element| element.shape == MeshShape::Triangle3) {
        mesh = mesh.divided_into_quadrilaterals();
    }
    let frame = context.frame(reader.scope)?;
    Some((of_mesh(&mesh, &frame, scale), layer))
}

/// The layer that a file gives to all elements of its mesh; none if it has no section, or several.
fn layer_of_file(mesh: &Mesh, span: Span) -> Option<Layer> {
    let [section] = mesh.sections.as_slice() else { return None };
    let is_whole = mesh.element_sets.get(&section.element_set)?.len() == mesh.elements.len();
    let material = mesh.materials.iter().find(|own| Some(&own.name) == section.material.as_ref())?;
    let ply = Ply::isotropic(1.0, material.young?, material.poisson?, material.density?);
    let thickness = Formula::of_constant(section.thickness?);
    is_whole.then_some(Layer { thickness, span, ply })
}

fn of_mesh(mesh: &Mesh, frame: &Motion, scale: f64) -> ShellMesh {
    let position = |own: &[f64; 3]| frame.transform_point(&(scale * Vector3::from(*own)));
    let mut sets: BTreeMap<String, Vec<usize>> = mesh.node_sets.clone();
    for (name, elements) in &mesh.element_sets {
        sets.entry(name.clone()).or_insert_with(|| mesh.nodes_of(elements));
    }
    let corners = |nodes: &[usize]| <[usize; 4]>::try_from(nodes).ok();
    ShellMesh {
        positions: mesh.positions.iter().map(position).collect(),
        places: None,
        normals: None,
        elements: mesh.elements.iter().filter_map(|element| corners(&element.nodes)).collect(),
        sets,
    }
}

/// Nodes at the same position as one: which are kept, and the new number of each.
pub(super) fn coincident(positions: &[Vector3]) -> (Vec<usize>, Vec<usize>) {
    let size = positions.iter().fold(0.0_f64, |most, position| most.max(position.amax()));
    let near = SAME * size;
    let mut order: Vec<usize> = (0..positions.len()).collect();
    // Along no axis of a regular mesh, where many nodes would have one place.
    let along: Vec<f64> = positions.iter().map(|at| at.dot(&Vector3::new(0.571, 0.618, 0.539))).collect();
    order.sort_by(|&a, &b| along[a].total_cmp(&along[b]));
    let mut first: Vec<usize> = (0..positions.len()).collect();
    for (k, &node) in order.iter().enumerate() {
        for &other in &order[k + 1..] {
            let apart = positions[other] - positions[node];
            if along[other] - along[node] > near {
                break;
            }
            if apart.norm() <= near {
                let kept = first[node].min(first[other]);
                (first[node], first[other]) = (kept, kept);
            }
        }
    }
    let kept: Vec<usize> = (0..first.len()).filter(|&node| first[node] == node).collect();
    let mut renumbered = vec![0; first.len()];
    kept.iter().enumerate().for_each(|(new, &old)| renumbered[old] = new);
    (kept, first.iter().map(|&node| renumbered[node]).collect())
}

/// Makes nodes at the same position one.
fn join(mesh: &mut ShellMesh) {
    let (kept, numbers) = coincident(&mesh.positions);
    let number = |node: usize| numbers[node];
    let first: Vec<usize> = numbers.iter().map(|&new| kept[new]).collect();
    // Along a fold the normals of the two sides differ: then they are those of the elements.
    if let Some(normals) = &mesh.normals
        && (0..first.len()).any(|node| normals[node].dot(&normals[first[node]]) < 0.999)
    {
        mesh.normals = None;
    }
    mesh.elements.iter_mut().flatten().for_each(|node| *node = number(*node));
    for set in mesh.sets.values_mut() {
        for node in set.iter_mut() {
            *node = number(*node);
        }
        set.sort_unstable();
        set.dedup();
    }
    mesh.positions = kept.iter().map(|&node| mesh.positions[node]).collect();
    if let Some(places) = &mut mesh.places {
        *places = kept.iter().map(|&node| places[node]).collect();
    }
    if let Some(normals) = &mut mesh.normals {
        *normals = kept.iter().map(|&node| normals[node]).collect();
    }
}

/// Adds the set of all nodes, and reads `sets` of nodes at these positions.
pub(super) fn sets(
    reader: &Reader<'_, '_>,
    positions: &[Vector3],
    sets: &mut BTreeMap<String, Vec<usize>>,
) -> Option<()> {
    let context = reader.context;
    let of_file = sets.insert(ALL.to_owned(), (0..positions.len()).collect());
    if let Some(count) = of_file.map(|own| own.len()).filter(|&count| count < positions.len()) {
        let all = positions.len();
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
        if let Some(present) = sets.get(name) {
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
        let (near, center, from, to) = (place("near")?, place("center")?, place("from")?, place("to")?);
        let all = positions.iter().enumerate();
        let found: Vec<usize> = match (near, center, from, to) {
            (Some(near), None, None, None) => {
                let distance = |position: &Vector3| (position - near).norm();
                let found = all.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)));
                found.map(|(node, _)| node).into_iter().collect()
            }
            (None, Some(center), None, None) => {
                let Some(radius) = own.number("radius") else {
                    return context.fail(
                        entry.node.span,
                        format!("{what} lacks `radius`"),
                        "add `radius = …`",
                    );
                };
                let is_within = |position: &Vector3| (position - center).norm() <= radius.value;
                all.filter(|(_, position)| is_within(position)).map(|(node, _)| node).collect()
            }
            (None, None, Some(from), Some(to)) => {
                // Along the axes in which it is written.
                let frame = context.frame(own.scope)?;
                let [from, to] = [from, to].map(|corner| frame.inverse_transform_point(&corner));
                let (low, high) = (from.inf(&to), from.sup(&to));
                let slack = 1e-6 * (high - low).norm();
                let is_within = |position: &Vector3| {
                    let position = frame.inverse_transform_point(position);
                    (0..3).all(|k| position[k] >= low[k] - slack && position[k] <= high[k] + slack)
                };
                all.filter(|(_, position)| is_within(position)).map(|(node, _)| node).collect()
            }
            _ => {
                let help = "write `near`, or `center` and `radius`, or `from` and `to`";
                return context.fail(entry.node.span, format!("{what} is not one region"), help);
            }
        };
        if found.is_empty() {
            return context.fail(entry.node.span, format!("{what} contains no node"), "make it larger");
        }
        sets.insert(name.clone(), found);
    }
    Some(())
}

/// The layers, by the keys or else as in the file of the mesh.
fn layers(reader: &Reader<'_, '_>, materials: &[Material], of_file: Option<Layer>) -> Option<Vec<Layer>> {
    let context = reader.context;
    let material = |own: &Reader<'_, '_>| {
        if own.node("material").is_none() {
            return Some(None);
        }
        let name = own.name_in("material")?;
        Some(Some(materials.iter().find(|known| known.name.value == name.value)?.constants))
    };
    let common = material(reader)?;
    let thickness = |own: &Reader<'_, '_>, node: &Node| {
        formula(own, node, &own.words("thickness"), &["u", "v"]).map(|formula| (formula, node.span))
    };
    match (reader.node("thickness"), reader.node("plies")) {
        (Some(node), None) => {
            let (thickness, span) = thickness(reader, node)?;
            let Some(own) = common else {
                let message = format!("{} lacks `material`", reader.what);
                return context.fail(reader.name, message, "add `material = \"…\"`, an entry of [materials]");
            };
            let ply = Ply::isotropic(1.0, own.young, own.poisson(), own.density);
            Some(vec![Layer { thickness, span, ply }])
        }
        (None, Some(node)) => {
            let what = reader.words("plies");
            let Value::List(list) = &node.value else {
                return context.wrong_type(node, &what, "a list of { thickness, angle, … }");
            };
            let read = |(index, entry): (usize, &Node)| {
                let what = format!("layer {} of {}", index + 1, reader.what);
                let own = Reader::open(context, entry, (what.clone(), entry.span), Shape::ply_keys())?;
                let (thickness, span) = thickness(&own, own.node("thickness")?)?;
                let angle = own.number("angle")?.value;
                let material = material(&own)?;
                let modulus = |key: &str| own.node(key).map(|_| own.number(key).map(|number| number.value));
                let ply = match (modulus("E1"), material.or(common)) {
                    (Some(along), _) => {
                        let needed = |key: &str| match modulus(key) {
                            Some(value) => value,
                            None => context.fail(
                                entry.span,
                                format!("{what} lacks `{key}`"),
                                "give E1, E2, nu12, G12 and density",
                            ),
                        };
                        let shear = needed("G12")?;
                        let or_shear = |key: &str| modulus(key).unwrap_or(Some(shear));
                        Ply {
                            thickness: 1.0,
                            angle,
                            young: [along?, needed("E2")?],
                            poisson: needed("nu12")?,
                            shear: [shear, or_shear("G13")?, or_shear("G23")?],
                            density: needed("density")?,
                        }
                    }
                    (None, Some(own)) => {
                        Ply { angle, ..Ply::isotropic(1.0, own.young, own.poisson(), own.density) }
                    }
                    (None, None) => {
                        return context.fail(
                            entry.span,
                            format!("{what} has no material"),
                            "add `material`, or E1, E2, nu12, G12 and density",
                        );
                    }
                };
                if ply.poisson * ply.poisson * ply.young[1] >= ply.young[0] {
                    let message = format!("{what} has no positive stiffness: nu12² must be below E1/E2");
                    return context.fail(
                        entry.span,
                        message,
                        "nu12 is the contraction across the fibres under tension along them",
                    );
                }
                Some(Layer { thickness, span, ply })
            };
            if list.is_empty() {
                return context.fail(node.span, format!("{what} is empty"), "list at least one layer");
            }
            let all: Vec<Option<Layer>> = list.iter().enumerate().map(read).collect();
            all.into_iter().collect()
        }
        (Some(_), Some(node)) => context.fail(
            node.span,
            format!("{} has both `thickness` and `plies`", reader.what),
            "remove one of them",
        ),
        (None, None) if of_file.is_some() && common.is_none() => Some(of_file.into_iter().collect()),
        (None, None) => {
            let message = format!("{} lacks `thickness`", reader.what);
            context.fail(reader.name, message, "add `thickness = …` and `material`, or `plies`")
        }
    }
}

fn loads(reader: &Reader<'_, '_>) -> Option<Vec<AreaLoad>> {
    let mut loads = Vec::new();
    let known = ["u", "v", "t"];
    for (key, is_on_top) in [("pressure", false), ("pressure_on_top", true)] {
        if let Some(node) = reader.node(key) {
            let components = vec![formula(reader, node, &reader.words(key), &known)?];
            loads.push(AreaLoad { components, is_on_top, axes: Motion::identity(), span: node.span });
        }
    }
    if let Some(node) = reader.node("force_per_area") {
        let what = reader.words("force_per_area");
        let list = reader.context.list(node, 3, &what)?;
        let read: Vec<_> = list.iter().map(|entry| formula(reader, entry, &what, &known)).collect();
        let components = read.into_iter().collect::<Option<_>>()?;
        loads.push(AreaLoad {
            components,
            is_on_top: false,
            axes: reader.context.frame(reader.scope)?,
            span: node.span,
        });
    }
    Some(loads)
}

/// Aspect ratio of an element above which it is inaccurate.
const MAX_ASPECT: f64 = 20.0;
/// Sine of the angle between the normals at opposite corners above which an element is inaccurate.
const MAX_WARP: f64 = 0.26;

fn check(reader: &Reader<'_, '_>, shell: &Shell, is_patch: bool) -> Option<()> {
    let context = reader.context;
    for (index, element) in shell.mesh.elements.iter().enumerate() {
        for layer in &shell.layers {
            let thickness = layer.thickness_at(shell.mesh.middle(index));
            if !(thickness > 0.0 && thickness.is_finite()) {
                let [u, v] = shell.mesh.middle(index);
                let message =
                    format!("the thickness of {} is {thickness} at u = {u:.4}, v = {v:.4}", reader.what);
                return context.fail(layer.span, message, "it must be greater than zero");
            }
        }
        let p = element.map(|node| shell.mesh.positions[node]);
        let normal = (p[2] - p[0]).cross(&(p[3] - p[1]));
        let is_wrong = |i: usize| {
            let [before, own, after] = [(i + 3) % 4, i, (i + 1) % 4].map(|k| p[k]);
            (after - own).cross(&(before - own)).dot(&normal) <= 1e-6 * normal.norm_squared()
        };
        if (0..4).any(is_wrong) {
            let centre = 0.25 * (p[0] + p[1] + p[2] + p[3]);
            let message = format!(
                "element {} of {} near [{:.4}, {:.4}, {:.4}] has no area or a corner that is not convex",
                index + 1,
                reader.what,
                centre.x,
                centre.y,
                centre.z
            );
            return context.fail(reader.name, message, "check `corners`, `surface` or the mesh there");
        }
        let is_across = |given: &Vector3| given.cross(&normal).norm() < 1.8e-3 * given.norm() * normal.norm();
        if let (Some(node), true) =
            (reader.node("direction"), shell.direction.as_ref().is_some_and(is_across))
        {
            let message = format!("`direction` of {} is normal to its element {}", reader.what, index + 1);
            let help = "choose a direction that has a projection on every element, or divide the shell";
            return context.fail(node.span, message, help);
        }
    }
    if is_patch {
        warn_of_shapes(reader, shell);
    }
    let longest = shell
        .mesh
        .positions
        .iter()
        .map(|position| (position - shell.mesh.positions[0]).norm())
        .fold(0.0, f64::max);
    let thickest = (0..shell.mesh.elements.len()).map(|k| shell.thickness(k)).fold(0.0, f64::max);
    if thickest > 0.3 * longest {
        let message =
            format!("{} is {thickest:.3} m thick and {longest:.3} m long: it is no shell", reader.what);
        let help = "strains are those of thin surfaces; check the units of `thickness`";
        context.report(Problem::warning(shell.layers[0].span, message).help(help));
    } else if thickest < 1e-6 * longest {
        let message = format!("{} is {:.1e} times as thick as it is long", reader.what, thickest / longest);
        let help = "at such a ratio bending loses digits; check the units of `thickness`";
        context.report(Problem::warning(shell.layers[0].span, message).help(help));
    }
    Some(())
}

/// Warns of elements of a patch that are long or warped; those of meshes are reported with their faults.
fn warn_of_shapes(reader: &Reader<'_, '_>, shell: &Shell) {
    let (mut aspect, mut warp) = (0.0_f64, 0.0_f64);
    for element in &shell.mesh.elements {
        let p = element.map(|node| shell.mesh.positions[node]);
        let sides = [0, 1, 2, 3].map(|i| (p[(i + 1) % 4] - p[i]).norm());
        aspect = aspect.max(
            sides.iter().fold(0.0_f64, |a, b| a.max(*b)) / sides.iter().fold(f64::MAX, |a, b| a.min(*b)),
        );
        let normal = |i: usize| (p[(i + 1) % 4] - p[i]).cross(&(p[(i + 3) % 4] - p[i])).normalize();
        warp = warp.max(normal(0).cross(&normal(2)).norm()).max(normal(1).cross(&normal(3)).norm());
    }
    let span = reader.node("divisions").map_or(reader.name, |node| node.span);
    if aspect > MAX_ASPECT {
        let message = format!("elements of {} are up to {aspect:.0} times as long as wide", reader.what);
        reader.context.report(
            Problem::warning(span, message).help("choose `divisions` so that they are nearly square"),
        );
    }
    if warp > MAX_WARP {
        let message = format!(
            "elements of {} are warped by up to {:.0} degrees",
            reader.what,
            warp.min(1.0).asin().to_degrees()
        );
        reader.context.report(
            Problem::warning(span, message).help("use more elements where the surface is curved twice"),
        );
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use crate::lower::registry::registry;
    use crate::{Document, Library, ModelText};

    const PLATE: &str = "*Node\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n*Element, type=S4, elset=P\n1, 1, 2, 3, 4\n\
                         *Shell section, elset=P, material=M\n0.01\n*Material, name=M\n*Elastic\n2e11, 0.3\n*Density\n7800\n";

    fn document(shell: &str, mesh: &str) -> Result<Document, String> {
        let text = format!(
            "lissom = 1\n[shells.p]\nmesh = \"p.inp\"\n{shell}\n[analysis]\nkind = \"dynamics\"\nend = 1\n"
        );
        let library = Library::of_texts([("p.inp".to_owned(), mesh.to_owned())]);
        let read = ModelText::read_with(&text, "model.toml", &[], Arc::new(library));
        let document = read.and_then(|text| text.document(&registry(), &[]));
        document.map_err(|report| report.render(false))
    }

    #[test]
    fn a_section_of_the_file_is_that_of_the_shell() {
        let shell = &document("", PLATE).expect("a good model").shells[0];
        assert_eq!((shell.thickness(0), shell.layers[0].ply.young), (0.01, [2e11; 2]));
        // Of a file in millimetres the units of the material are unknown.
        assert!(document("scale = 0.001", PLATE).expect_err("no section").contains("lacks `thickness`"));
        let part = PLATE.replace("elset=P\n1,", "elset=Q\n1,").replace("*Shell", "*Elset, elset=P\n*Shell");
        assert!(document("", &part).is_err());
    }

    #[test]
    fn what_is_not_read_of_a_mesh_is_reported() {
        let warnings = |mesh: &str| document("", mesh).expect("a good model").warnings.render(false);
        assert!(!warnings(PLATE).contains("read in part"));
        let more = PLATE.replace(
            "*Material",
            "*Element, type=B31, elset=B\n2, 1, 2\n*Element, type=MASS, elset=C\n3, 1\n*Material",
        );
        assert!(warnings(&more).contains("read in part"), "{}", warnings(&more));
    }

    #[test]
    fn sides_that_do_not_lie_at_each_other_are_reported() {
        let joint = |tip: &str| {
            let square = |name: &str, x: f64| {
                format!(
                    "[shells.{name}]\ncorners = [[{x}, 0, 0], [{0}, 0, 0], [{0}, 1, 0], [{x}, 1, 0]]\ndivisions = [2, 2]\nthickness = 0.01\nmaterial = \"m\"\n",
                    x + 1.0
                )
            };
            let text = format!(
                "lissom = 1\n[materials.m]\nE = 1e9\nnu = 0.3\ndensity = 1000\n{}{}[joints.j]\nkind = \"clamp\"\nbase = \"a.east\"\n\
                 tip = \"b.{tip}\"\n[analysis]\nkind = \"dynamics\"\nend = 1\n",
                square("a", 0.0),
                square("b", 1.0)
            );
            Document::parse(&text, "model.toml", &registry()).expect("a good model").warnings.render(false)
        };
        assert!(!joint("west").contains("rigid arms"));
        assert!(joint("east").contains("rigid arms"), "{}", joint("east"));
    }
}
