//! Elastic solids of a model file: their meshes, laws, sets of nodes and pressures.

use std::collections::BTreeSet;
use std::sync::Arc;

use lissom_flexible::solid::SolidMaterial;
use lissom_flexible::solid::law::{SolidLaw, SolidModel};
use lissom_mesh::{ConnectionFault, Mesh, MeshedPart, block};
use lissom_motion::{Motion, Vector3};

use super::Material;
use super::entries::each;
use super::meshes::{divisions, file, formula, one_of, sets};
use super::temperatures::{self, check_expansion};
use crate::expression::Formula;
use crate::format::keys::{Key, Shape, optional, required, unitless};
use crate::format::part_tables::placed_in;
use crate::parts::context::Context;
use crate::reading::mesh_nodes::{ALL, nodes_at};
use crate::reading::node_reference::MeshPlace;
use crate::reading::reader::Reader;
use crate::text::Node;
use crate::text::report::{Located, Problem, Span};

/// Poisson's ratio above which the default law locks.
const MAX_POISSON: f64 = 0.48;
/// Poisson's ratio above which the bulk modulus loses the digits of the others.
const MAX_POISSON_OF_RUBBER: f64 = 0.499_99;

/// An elastic solid.
#[derive(Clone, Debug)]
pub struct ElasticSolid {
    /// Name.
    pub name: Located<String>,
    /// Nodes and elements of the solid.
    pub mesh: Arc<MeshedPart>,
    /// What it consists of.
    pub material: SolidMaterial,
    /// Pressures on its faces.
    pub pressures: Vec<FacePressure>,
    /// Strain without stress at each node; none if there is none.
    pub free_strains: Vec<f64>,
}

/// Pressure on the faces of a set of nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct FacePressure {
    /// Corners of each face, counterclockwise seen from outside, and middles of its sides.
    pub faces: Vec<Vec<usize>>,
    /// Force per area against the outward normal, over t, x, y and z [Pa].
    pub value: Formula,
    /// Axes of x, y and z.
    pub axes: Motion,
    /// Where it is.
    pub span: Span,
}

/// Keys of a solid.
pub(super) fn keys() -> Vec<Key> {
    vec![
        placed_in(),
        optional("size", Shape::Vector, "m", "of a box along the axes: its lengths"),
        optional(
            "origin",
            Shape::Place,
            "m",
            "of a box: its corner with the lowest coordinates; default the origin",
        ),
        optional(
            "volume",
            Shape::Volume,
            "m",
            "instead of `size`: x, y and z over u, v and w from 0 to 1, which are right-handed",
        ),
        unitless(
            "divisions",
            Shape::VolumeDivisions,
            "of `size` and `volume`: numbers of elements along u, v and w",
        ),
        unitless(
            "mesh",
            Shape::Text,
            "instead of `size`: a Gmsh (.msh) or Abaqus (.inp) file; path relative to this file",
        ),
        unitless("group", Shape::Text, "of a mesh: the set of its elements to be used; default all solids"),
        unitless("scale", Shape::Positive, "of a mesh: factor to metres").or_number(1.0),
        unitless(
            "join",
            Shape::Flag,
            "whether nodes at the same position are one, as along the seam of a ring",
        )
        .or_flag(false),
        required("material", Shape::Name("materials"), "", "the material"),
        unitless(
            "model",
            Shape::Choice(["st-venant-kirchhoff", "neo-hookean", "mooney-rivlin"].as_slice().into()),
            "law of elasticity: for small strains, or for rubber",
        )
        .or_word("st-venant-kirchhoff"),
        optional(
            "c01",
            Shape::NotNegative,
            "Pa",
            "second constant of `model = \"mooney-rivlin\"`; the first one is E/(4 (1 + nu)) - c01",
        ),
        optional("damping", Shape::NotNegative, "s", "damping in proportion to the stiffness").or_number(0.0),
        optional(
            "pressure",
            Shape::Table,
            "Pa",
            "force per area against the outward normal, which it follows: `{ SET = expression }` of t and of the present place x, y, z",
        ),
        unitless(
            "sets",
            Shape::Table,
            "named nodes: `{ near = [x, y, z] }`, `{ center = [x, y, z], radius = r }` or `{ from = [x, y, z], to = [x, y, z] }`",
        ),
        temperatures::key(),
    ]
}

pub(super) fn elastic_solids(context: &Context<'_>, materials: &[Material]) -> Vec<ElasticSolid> {
    each(context, "solids", |reader, name| {
        let (mesh, material) = (mesh_of(reader), material(reader, materials));
        let (mut mesh, (material, expansion)) = (mesh?, material?);
        mesh.find_faces();
        check(reader, mesh.connection_fault())?;
        joined(reader, &mut mesh)?;
        check(reader, mesh.volume_fault())?;
        sets(reader, &mut mesh)?;
        let pressures = pressures(reader, name, &mesh)?;
        check_expansion(reader, "temperature", expansion != 0.0)?;
        let temperatures = temperatures::temperatures(reader, &mesh)?;
        let free_strains = temperatures.into_iter().map(|value| expansion * value).collect();
        let name = Located::new(name.to_owned(), reader.name);
        Some(ElasticSolid { name, mesh: Arc::new(mesh), material, pressures, free_strains })
    })
}

/// What it consists of, and its strain per change of temperature.
fn material(reader: &Reader<'_, '_>, materials: &[Material]) -> Option<(SolidMaterial, f64)> {
    let name = reader.name_in("material")?;
    let material = materials.iter().find(|known| known.name.value == name.value)?.constants;
    let chosen = reader.choice("model")?.value;
    let is_rubber = chosen != "st-venant-kirchhoff";
    let (model, most) = if is_rubber {
        (SolidModel::Rubber, MAX_POISSON_OF_RUBBER)
    } else {
        (SolidModel::StVenantKirchhoff, MAX_POISSON)
    };
    let poisson = material.poisson();
    if poisson > most {
        let message =
            format!("{} has nu = {poisson:.6}: the law of its `model` needs {most} or less", reader.what);
        let help = if is_rubber {
            "write for example `nu = 0.4995` in the material; rubber has 0.4985 to 0.4999"
        } else {
            "write `model = \"neo-hookean\"`, which suits materials that are almost incompressible"
        };
        return reader.context.fail(name.span, message, help);
    }
    let mut law = SolidLaw::new(model, material.young, poisson);
    let second = reader.node("c01").map(|node| Some((node.span, reader.number("c01")?.value)));
    match (chosen == "mooney-rivlin", second) {
        (true, Some(own)) => {
            let (span, constant) = own?;
            law.second = 2.0 * constant;
            if law.second >= law.shear {
                let most = 0.5 * law.shear;
                let message =
                    format!("`c01` of {} must be below E/(4 (1 + nu)) = {most:.4e} Pa", reader.what);
                let help = "the first constant, which is the rest, must be greater than zero";
                return reader.context.fail(span, message, help);
            }
        }
        (true, None) => {
            let message = format!("{} lacks `c01`", reader.what);
            let help =
                "add `c01 = …` in Pa, the second constant; E of the material is 4 (1 + nu) (c10 + c01)";
            return reader.context.fail(reader.name, message, help);
        }
        (false, Some(own)) => {
            let message = format!("{} has `c01`, which only `model = \"mooney-rivlin\"` uses", reader.what);
            return reader.context.fail(own?.0, message, "remove it, or choose this model");
        }
        (false, None) => {}
    }
    let damping = reader.number("damping")?.value;
    Some((SolidMaterial { law, density: material.density, damping }, material.expansion))
}

/// Elements of a block: systems of a few million unknowns need more memory than there is.
const MAX_ELEMENTS: usize = 1_000_000;

fn mesh_of(reader: &Reader<'_, '_>) -> Option<MeshedPart> {
    let context = reader.context;
    let help = "write `size` or `volume` with `divisions`, or a `mesh`";
    let given = one_of(reader, (["size", "volume", "mesh"], "volume"), help)?;
    let unused: &[&str] = match given {
        "mesh" => &["divisions", "origin"],
        "size" => &["group", "scale"],
        _ => &["group", "origin", "scale"],
    };
    if let Some((key, node)) = unused.iter().find_map(|key| Some((key, reader.node(key)?))) {
        let message = format!("{} has `{key}`, which is not used with `{given}`", reader.what);
        return context.fail(node.span, message, format!("remove `{key}`"));
    }
    if given == "mesh" {
        return mesh(reader);
    }
    let Some(node) = reader.node("divisions") else {
        let message = format!("{} lacks `divisions`", reader.what);
        return context.fail(reader.name, message, "add `divisions = [8, 2, 2]`: elements along u, v and w");
    };
    let divisions = divisions::<3>(reader, node, "[8, 2, 2]")?;
    let count: usize = divisions.iter().product();
    if count > MAX_ELEMENTS {
        let message = format!("{} has {count} elements, more than {MAX_ELEMENTS}", reader.what);
        return context.fail(node.span, message, "use fewer `divisions`");
    }
    let position = if given == "size" { size(reader)? } else { volume(reader)? };
    match block(position, divisions) {
        Ok(mesh) => Some(mesh),
        Err([u, v, w]) => {
            let message =
                format!("{} is not finite at u = {u:.4}, v = {v:.4}, w = {w:.4}", reader.words("volume"));
            context.fail(reader.name, message, "check the expressions there")
        }
    }
}

/// Position at u, v and w.
type PointOf = Box<dyn Fn([f64; 3]) -> Vector3>;

fn size(reader: &Reader<'_, '_>) -> Option<PointOf> {
    let node = reader.node("size")?;
    let size = reader.vector("size")?.value;
    if size.iter().any(|length| *length <= 0.0) {
        let message = format!("{} must be three lengths greater than zero", reader.words("size"));
        return reader.context.fail(node.span, message, "give the position by `origin`");
    }
    let frame = reader.context.frame(reader.scope)?;
    let origin = match reader.node("origin") {
        Some(node) => reader.context.place(node, &reader.words("origin"))?.value,
        None => frame.position,
    };
    Some(Box::new(move |place| origin + frame.rotation.apply(&Vector3::from(place).component_mul(&size))))
}

fn volume(reader: &Reader<'_, '_>) -> Option<PointOf> {
    let (context, node) = (reader.context, reader.node("volume")?);
    let what = reader.words("volume");
    let known = ["u", "v", "w"];
    let read = context.list(node, 3, &what)?.iter().map(|entry| formula(reader, entry, &what, &known));
    let formulas: Vec<Formula> = read.collect::<Vec<_>>().into_iter().collect::<Option<_>>()?;
    let frame = context.frame(reader.scope)?;
    Some(Box::new(move |place| {
        let value = |formula: &Formula| {
            let argument = |name: &str| place[known.iter().position(|own| *own == name).unwrap_or(0)];
            let arguments: Vec<f64> = formula.arguments().iter().map(|name| argument(&name.text)).collect();
            formula.with_arguments(&arguments).value(0.0)
        };
        frame.transform_point(&Vector3::from_fn(|k, _| value(&formulas[k])))
    }))
}

fn mesh(reader: &Reader<'_, '_>) -> Option<MeshedPart> {
    let (context, node) = (reader.context, reader.node("mesh")?);
    let what = reader.words("mesh");
    let (frame, scale) = (context.frame(reader.scope)?, reader.number("scale")?.value);
    let take = |mesh: Mesh, group: Option<&str>| MeshedPart::of_solid(mesh, group, (&frame, scale));
    let (mut part, mesh) = file(reader, ("solids.md", "solid"), take)?;
    // Between linear elements nodes were added that a set of all nodes in the file lacks.
    part.sets.retain(|name, _| name != ALL || mesh.node_sets[name].len() < mesh.positions.len());
    let materials: BTreeSet<_> = mesh.sections.iter().filter_map(|own| own.material.as_ref()).collect();
    if materials.len() > 1 {
        let message =
            format!("{what} has sections of {} materials, and all elements get one", materials.len());
        let help = "name the elements of one material by `group`, each in a solid of its own";
        context.report(Problem::warning(node.span, message).help(help));
    }
    Some(part)
}

/// Makes nodes at the same position one if that is wanted; otherwise they are a fault of a mesh.
fn joined(reader: &Reader<'_, '_>, mesh: &mut MeshedPart) -> Option<()> {
    if reader.flag("join")?.value {
        mesh.join();
        return Some(());
    }
    let Some(at) = mesh.repeated_position().map(|node| mesh.positions[node]) else { return Some(()) };
    let message = format!(
        "{} has two nodes at [{:.4}, {:.4}, {:.4}]: it is not connected there",
        reader.what, at.x, at.y, at.z
    );
    let help = "set `join = true` to make nodes at the same position one";
    reader.context.fail(reader.name, message, help)
}

/// Reports why the elements do not form a whole.
fn check(reader: &Reader<'_, '_>, fault: Option<ConnectionFault>) -> Option<()> {
    let what = &reader.what;
    let (message, at, help) = match fault {
        None => return Some(()),
        Some(ConnectionFault::SameElement { position }) => (
            format!("{what} has two elements with the same nodes"),
            position,
            "remove one of them from the mesh",
        ),
        Some(ConnectionFault::HangingCorner { position }) => (
            format!("{what} has an element with a corner at the middle of an edge of another"),
            position,
            "refine both alike: elements must share whole faces",
        ),
        Some(ConnectionFault::HalvedFace { position }) => (
            format!("{what} has a face of four corners on one of three"),
            position,
            "tetrahedra and hexahedra share no face: mesh with one of them and wedges, or join two solids by a body",
        ),
        Some(ConnectionFault::Inverted { element, position }) => (
            format!("element {} of {what} is inverted or has no volume", element + 1),
            position,
            "u, v and w must be right-handed, and elements convex: check the expressions or the mesh there",
        ),
        Some(ConnectionFault::UnusedNode { position }) => {
            (format!("no element of {what} uses its node"), position, "remove the node from the mesh")
        }
    };
    let message = format!("{message} at [{:.4}, {:.4}, {:.4}]", at.x, at.y, at.z);
    reader.context.fail(reader.name, message, help)
}

fn pressures(reader: &Reader<'_, '_>, name: &str, mesh: &MeshedPart) -> Option<Vec<FacePressure>> {
    let context = reader.context;
    let Some(node) = reader.node("pressure") else { return Some(Vec::new()) };
    let Some(table) = node.table() else {
        return context.wrong_type(node, &reader.words("pressure"), "a table such as { top = \"2e5*t\" }");
    };
    let read = |(set, entry): (&String, &Node)| {
        let nodes = match nodes_at(mesh, name, &MeshPlace::Set(set.clone())) {
            Ok(nodes) => nodes,
            Err((message, help)) => return context.fail(entry.span, message, help),
        };
        let faces = mesh.faces_in(&nodes);
        if faces.is_empty() {
            let message = format!("set `{set}` of {} contains no outer face", reader.what);
            return context.fail(entry.span, message, "name a set that contains all nodes of a face");
        }
        let value = formula(reader, entry, &format!("pressure on `{set}`"), &["t", "x", "y", "z"])?;
        let axes = context.frame(reader.scope)?;
        Some(FacePressure { faces, value, axes, span: entry.span })
    };
    table.iter().map(|(set, entry)| read((set, &entry.node))).collect()
}
