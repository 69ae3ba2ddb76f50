//! Shells of a model file: their surfaces, sections, sets of nodes and loads per area.

use std::sync::Arc;

use lissom_flexible::shell::section::Ply;
use lissom_mesh::{Mesh, MeshFault, MeshFaultKind, MeshShape, MeshedPart, PatchFault, Severity, patch};
use lissom_motion::{Motion, Vector3};

use super::Material;
use super::entries::each;
use super::meshes::{divisions, file, formula, one_of, sets};
use super::temperatures::{self, check_expansion};
use crate::expression::Formula;
use crate::format::keys::{Key, Shape, optional, required, unitless};
use crate::format::part_tables::placed_in;
use crate::parts::context::Context;
use crate::reading::reader::Reader;
use crate::text::report::{Located, Problem, Span};
use crate::text::{Node, Value};

/// A shell.
#[derive(Clone, Debug)]
pub struct Shell {
    /// Name.
    pub name: Located<String>,
    /// Nodes and elements of the shell.
    pub mesh: Arc<MeshedPart>,
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
    /// Temperature of each node above that of the state without stress [K]; none if it is everywhere that.
    pub temperatures: Vec<f64>,
    /// Forces per length 11, 22, 12 in the local axes before any strain [N/m].
    pub prestress: [f64; 3],
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
    /// Strain along and across the fibres per change of temperature [1/K].
    pub expansion: [f64; 2],
}

/// A load per area of a shell.
#[derive(Clone, Debug, PartialEq)]
pub struct AreaLoad {
    /// Components: one of a pressure over u, v, t and x, y, z, three of a force per area over u, v and t.
    pub components: Vec<Formula>,
    /// Whether a pressure acts on the face of the normal.
    pub is_on_top: bool,
    /// Axes of x, y and z, and of three components.
    pub axes: Motion,
    /// Where it is.
    pub span: Span,
}

impl Shell {
    /// Layers of an element.
    pub fn plies(&self, element: usize) -> Vec<Ply> {
        let (middle, nodes) = (self.mesh.middle(element), &self.mesh.elements[element].nodes);
        let temperature = |&node: &usize| self.temperatures.get(node).copied().unwrap_or(0.0);
        let temperature = nodes.iter().map(temperature).sum::<f64>() / nodes.len() as f64;
        let whole = self.thickness(element);
        let ply = |layer: &Layer| {
            let initial = self.prestress.map(|force| force / whole);
            let ply = Ply { thickness: layer.thickness_at(middle), initial, ..layer.ply };
            // The strain of Green of a stretch 1 + α ΔT, as solids and beams have.
            ply.expanded(layer.expansion.map(|own| own * temperature * (1.0 + 0.5 * own * temperature)))
        };
        self.layers.iter().map(ply).collect()
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
        unitless("divisions", Shape::Divisions, "of a patch: numbers of elements along u and v"),
        unitless(
            "mesh",
            Shape::Text,
            "instead of `corners`: a Gmsh (.msh), Abaqus (.inp) or Wavefront (.obj) file; path relative to this file",
        ),
        unitless("group", Shape::Text, "of a mesh: the set of its elements to be used; default all surfaces"),
        unitless("scale", Shape::Positive, "of a mesh: factor to metres").or_number(1.0),
        unitless(
            "join",
            Shape::Flag,
            "whether nodes at the same position are one, as along the seam of a tube",
        )
        .or_flag(false),
        optional(
            "thickness",
            Shape::Thickness,
            "m",
            "a number or an expression of u and v; it or `plies` is required, unless the file of the mesh has one section for all elements",
        ),
        unitless("material", Shape::Name("materials"), "of `thickness`, and of plies without their own"),
        optional(
            "offset",
            Shape::Number,
            "m",
            "place of the middle of the thickness along the normal of the surface",
        )
        .or_number(0.0),
        optional("damping", Shape::NotNegative, "s", "damping in proportion to the stiffness").or_number(0.0),
        unitless("plies", Shape::Plies, "layers of a laminate from the bottom to the top of the normal"),
        unitless(
            "direction",
            Shape::Direction,
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
            "force per area along the normal, which it follows, as on the face opposite to it: an expression of u, v, t and the present place x, y, z",
        ),
        optional(
            "pressure_on_top",
            Shape::AreaSize,
            "Pa",
            "force per area on the face of the normal, against the normal, as `top` in `pressure` of a solid: an expression of u, v, t and the present place x, y, z",
        ),
        optional(
            "force_per_area",
            Shape::AreaDistribution,
            "Pa",
            "in global axes, fixed in direction: three numbers or expressions of u, v and t",
        ),
        unitless(
            "sets",
            Shape::Table,
            "named nodes: `{ near = [x, y, z] }`, `{ center = [x, y, z], radius = r }` or `{ from = [x, y, z], to = [x, y, z] }`",
        ),
        temperatures::key(),
        optional(
            "prestress",
            Shape::Vector,
            "N/m",
            "of a taut membrane: forces per length 11, 22 and 12 in the local axes before any strain",
        ),
    ]
}

impl Shape {
    /// Keys of a layer of a laminate.
    pub(crate) fn ply_keys() -> Vec<Key> {
        vec![
            required("thickness", Self::Thickness, "m", "a number or an expression of u and v"),
            optional("angle", Self::Number, "rad", "from the first local axis to its fibres").or_number(0.0),
            unitless("material", Self::Name("materials"), "isotropic material; default that of the shell"),
            optional("E1", Self::Positive, "Pa", "Young's modulus along the fibres, instead of a material"),
            optional("E2", Self::Positive, "Pa", "Young's modulus across the fibres"),
            unitless("nu12", Self::Number, "contraction across over extension along the fibres"),
            optional("G12", Self::Positive, "Pa", "shear modulus in the plane"),
            optional("G13", Self::Positive, "Pa", "transverse shear modulus along the fibres; default `G12`"),
            optional(
                "G23",
                Self::Positive,
                "Pa",
                "transverse shear modulus across the fibres; default `G12`",
            ),
            optional("density", Self::Positive, "kg/m³", "mass density"),
            optional("expansion1", Self::Number, "1/K", "strain along the fibres per change of temperature")
                .or_number(0.0),
            optional("expansion2", Self::Number, "1/K", "strain across the fibres per change of temperature")
                .or_number(0.0),
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
            mesh.join();
        }
        sets(reader, &mut mesh)?;
        let expands = layers.iter().any(|layer| layer.expansion != [0.0; 2]);
        check_expansion(reader, "temperature", expands)?;
        let prestress = match reader.node("prestress") {
            Some(_) => reader.vector("prestress")?.value.into(),
            None => [0.0; 3],
        };
        let shell = Shell {
            name: Located::new(name.to_owned(), reader.name),
            temperatures: temperatures::temperatures(reader, &mesh)?,
            prestress,
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

fn mesh_of(reader: &Reader<'_, '_>) -> Option<(MeshedPart, Option<Layer>)> {
    let context = reader.context;
    let help = "write `corners` or `surface` with `divisions`, or a `mesh`";
    let key = one_of(reader, (["corners", "surface", "mesh"], "surface"), help)?;
    if key == "mesh" {
        if let Some(node) = reader.node("divisions") {
            let message = format!("{} has a `mesh`, which has its own elements", reader.what);
            return context.fail(node.span, message, "remove `divisions`");
        }
        return mesh(reader);
    }
    if let Some((unused, node)) = ["group", "scale"].iter().find_map(|key| Some((key, reader.node(key)?))) {
        let message = format!("{} has `{unused}`, which is used with a `mesh` only", reader.what);
        return context.fail(node.span, message, format!("remove `{unused}`"));
    }
    let Some(node) = reader.node("divisions") else {
        let message = format!("{} lacks `divisions`", reader.what);
        return context.fail(reader.name, message, "add `divisions = [8, 4]`: elements along u and v");
    };
    let divisions = divisions::<2>(reader, node, "[8, 4]")?;
    let surface = if key == "corners" { corners(reader)? } else { expressions(reader)? };
    match patch(surface, divisions) {
        Ok(mesh) => Some((mesh, None)),
        Err(PatchFault([u, v])) => {
            let message = format!(
                "{} has no normal at u = {u:.4}, v = {v:.4}: its sides are parallel or have no length there",
                reader.what
            );
            let help = "elements have four corners: leave out the pole of a surface, or use a mesh";
            context.fail(reader.node(key)?.span, message, help)
        }
    }
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

fn mesh(reader: &Reader<'_, '_>) -> Option<(MeshedPart, Option<Layer>)> {
    let (context, node) = (reader.context, reader.node("mesh")?);
    let what = reader.words("mesh");
    let take = |mesh: Mesh, group: Option<&str>| {
        let part = mesh.part(group, MeshShape::is_surface)?;
        Ok(((), part))
    };
    let ((), mut mesh) = file(reader, ("shells.md", "surface"), take)?;
    let scale = reader.number("scale")?.value;
    // Other lengths than metres mean other units of its material.
    let layer = layer_of_file(&mesh, node.span).filter(|_| scale == 1.0);
    if mesh.has_nodes_on_sides() {
        mesh = mesh.divided_into_quadrilaterals();
    }
    mesh.orient();
    let joins = reader.flag("join")?.value;
    let faults = mesh.surface_faults();
    // Nodes at one position become one.
    let is_error = |fault: &&MeshFault| {
        fault.severity() == Severity::Error && !(joins && fault.kind == MeshFaultKind::TornMesh)
    };
    if let Some(fault) = faults.iter().find(is_error) {
        let help = "mend the mesh, or set `join = true` for nodes at the same position";
        return context.fail(node.span, format!("{what}: {fault}"), help);
    }
    for (fault, count) in MeshFault::worst_of_kinds(&faults, Severity::Warning) {
        let others = if count > 1 { format!(" (the worst of {count})") } else { String::new() };
        context.report(Problem::warning(node.span, format!("{what}: {fault}{others}")));
    }
    let mesh = mesh.divided_into_quadrilaterals();
    Some((MeshedPart::of_surface(&mesh, &context.frame(reader.scope)?, scale), layer))
}

/// The layer that a file gives to all elements of its mesh; none if it has no section, or several.
fn layer_of_file(mesh: &Mesh, span: Span) -> Option<Layer> {
    let [section] = mesh.sections.as_slice() else { return None };
    let is_whole = mesh.element_sets.get(&section.element_set)?.len() == mesh.elements.len();
    let material = mesh.materials.iter().find(|own| Some(&own.name) == section.material.as_ref())?;
    let ply = Ply::isotropic(1.0, material.young?, material.poisson?, material.density?);
    let thickness = Formula::of_constant(section.thickness?);
    is_whole.then_some(Layer { thickness, span, ply, expansion: [0.0; 2] })
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
            Some(vec![Layer { thickness, span, ply, expansion: [own.expansion; 2] }])
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
                let (ply, expansion) = match (modulus("E1"), material.or(common)) {
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
                        let ply = Ply {
                            thickness: 1.0,
                            angle,
                            young: [along?, needed("E2")?],
                            poisson: needed("nu12")?,
                            shear: [shear, or_shear("G13")?, or_shear("G23")?],
                            density: needed("density")?,
                            initial: [0.0; 3],
                        };
                        (ply, [own.number("expansion1")?.value, own.number("expansion2")?.value])
                    }
                    (None, Some(own)) => {
                        let ply = Ply::isotropic(1.0, own.young, own.poisson(), own.density);
                        (Ply { angle, ..ply }, [own.expansion; 2])
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
                Some(Layer { thickness, span, ply, expansion })
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
    let (known, axes) = (["u", "v", "t"], reader.context.frame(reader.scope)?);
    for (key, is_on_top) in [("pressure", false), ("pressure_on_top", true)] {
        if let Some(node) = reader.node(key) {
            let components =
                vec![formula(reader, node, &reader.words(key), &["u", "v", "t", "x", "y", "z"])?];
            loads.push(AreaLoad { components, is_on_top, axes, span: node.span });
        }
    }
    if let Some(node) = reader.node("force_per_area") {
        let what = reader.words("force_per_area");
        let list = reader.context.list(node, 3, &what)?;
        let read: Vec<_> = list.iter().map(|entry| formula(reader, entry, &what, &known)).collect();
        let components = read.into_iter().collect::<Option<_>>()?;
        loads.push(AreaLoad { components, is_on_top: false, axes, span: node.span });
    }
    Some(loads)
}

/// Aspect ratio of an element above which it is inaccurate.
const MAX_ASPECT: f64 = 20.0;
/// Sine of the angle between the normals at opposite corners above which an element is inaccurate.
const MAX_WARP: f64 = 0.26;

fn check(reader: &Reader<'_, '_>, shell: &Shell, is_patch: bool) -> Option<()> {
    let context = reader.context;
    for (index, element) in shell.mesh.quadrilaterals().enumerate() {
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
    for element in shell.mesh.quadrilaterals() {
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
