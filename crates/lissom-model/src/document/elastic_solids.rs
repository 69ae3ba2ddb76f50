//! Elastic solids of a model file: their meshes, laws, sets of nodes and pressures.

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::sync::Arc;

use lissom_flexible::solid::law::{SolidLaw, SolidModel};
use lissom_flexible::solid::shape::{HEXAHEDRON_EDGES, TETRAHEDRON_EDGES, hexahedron_node};
use lissom_flexible::solid::volume::{hexahedron_shares, tetrahedron_shares};
use lissom_mesh::{Mesh, MeshShape};
use lissom_motion::{Motion, Vector3};

use super::Material;
use super::entries::each;
use super::shells::{coincident, divisions, formula, sets};
use crate::expression::Formula;
use crate::format::keys::{Key, Shape, optional, required};
use crate::format::part_tables::placed_in;
use crate::parts::context::Context;
use crate::reading::mesh_nodes::{ALL, NodeSets};
use crate::reading::node_reference::MeshPlace;
use crate::reading::reader::Reader;
use crate::reading::solid_mesh::{SolidMesh, edge, raised};
use crate::text::Node;
use crate::text::report::{Located, Problem, Span};

/// Names of the sides of a block: u = 0 and 1, v = 0 and 1, w = 0 and 1.
const SIDES: [&str; 6] = ["west", "east", "south", "north", "bottom", "top"];
/// Poisson's ratio above which the default law locks.
const MAX_POISSON: f64 = 0.48;
/// Poisson's ratio above which the bulk modulus loses the digits of the others.
const MAX_POISSON_OF_RUBBER: f64 = 0.499_99;

/// An elastic solid.
#[derive(Clone, Debug)]
pub struct ElasticSolid {
    /// Name.
    pub name: Located<String>,
    /// Its nodes and elements.
    pub mesh: Arc<SolidMesh>,
    /// Its elastic law.
    pub law: SolidLaw,
    /// Mass density [kg/m³].
    pub density: f64,
    /// Pressures on its faces.
    pub pressures: Vec<FacePressure>,
}

/// Pressure on the faces of a set of nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct FacePressure {
    /// Corners of triangles and middles of their sides, counterclockwise seen from outside.
    pub triangles: Vec<[usize; 6]>,
    /// The same of quadrilaterals.
    pub quadrilaterals: Vec<[usize; 8]>,
    /// Force per area against the outward normal, over t [Pa].
    pub value: Formula,
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
        optional(
            "divisions",
            Shape::VolumeDivisions,
            "",
            "of `size` and `volume`: numbers of elements along u, v and w",
        ),
        optional(
            "mesh",
            Shape::Text,
            "",
            "instead of `size`: a Gmsh (.msh) or Abaqus (.inp) file; path relative to this file",
        ),
        optional(
            "group",
            Shape::Text,
            "",
            "of a mesh: the set of its elements to be used; default all solids",
        ),
        optional("scale", Shape::Positive, "", "of a mesh: factor to metres").or_number(1.0),
        optional(
            "join",
            Shape::Flag,
            "",
            "whether nodes at the same position are one, as along the seam of a ring",
        )
        .or_flag(false),
        required("material", Shape::Name("materials"), "", "the material"),
        optional(
            "model",
            Shape::Choice(["st-venant-kirchhoff", "neo-hookean"].as_slice().into()),
            "",
            "law of elasticity: for small strains, or for rubber",
        )
        .or_word("st-venant-kirchhoff"),
        optional(
            "pressure",
            Shape::Table,
            "Pa",
            "force per area against the outward normal, which it follows: `{ SET = expression of t }`",
        ),
        optional(
            "sets",
            Shape::Table,
            "",
            "named nodes: `{ near = [x, y, z] }`, `{ center = [x, y, z], radius = r }` or `{ from = [x, y, z], to = [x, y, z] }`",
        ),
    ]
}

pub(super) fn elastic_solids(context: &Context<'_>, materials: &[Material]) -> Vec<ElasticSolid> {
    each(context, "solids", |reader, name| {
        let (mesh, law) = (mesh_of(reader), law(reader, materials));
        let (mut mesh, (law, density)) = (mesh?, law?);
        mesh.find_faces();
        check_connection(reader, &mesh)?;
        joined(reader, &mut mesh)?;
        check(reader, &mesh)?;
        mesh.find_faces();
        let mut own_sets = std::mem::take(&mut mesh.sets);
        sets(reader, &mesh.positions, &mut own_sets)?;
        mesh.sets = own_sets;
        let pressures = pressures(reader, name, &mesh)?;
        let name = Located::new(name.to_owned(), reader.name);
        Some(ElasticSolid { name, mesh: Arc::new(mesh), law, density, pressures })
    })
}

fn law(reader: &Reader<'_, '_>, materials: &[Material]) -> Option<(SolidLaw, f64)> {
    let name = reader.name_in("material")?;
    let material = materials.iter().find(|known| known.name.value == name.value)?.constants;
    let is_rubber = reader.choice("model")?.value == "neo-hookean";
    let (model, most) = if is_rubber {
        (SolidModel::NeoHookean, MAX_POISSON_OF_RUBBER)
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
    Some((SolidLaw::new(model, material.young, poisson), material.density))
}

/// Elements of a block: systems of a few million unknowns need more memory than there is.
const MAX_ELEMENTS: usize = 1_000_000;

fn mesh_of(reader: &Reader<'_, '_>) -> Option<SolidMesh> {
    let context = reader.context;
    let given: Vec<&str> = ["size", "volume", "mesh"].into_iter().filter(|key| reader.has(key)).collect();
    let help = "write `size` or `volume` with `divisions`, or a `mesh`";
    let unused: &[&str] = match given[..] {
        ["mesh"] => &["divisions", "origin"],
        ["size"] => &["group", "scale"],
        [_] => &["group", "origin", "scale"],
        [] => return context.fail(reader.name, format!("{} has no volume", reader.what), help),
        [_, second, ..] => {
            let span = reader.node(second).map_or(reader.name, |node| node.span);
            return context.fail(span, format!("{} has several volumes", reader.what), help);
        }
    };
    if let Some((key, node)) = unused.iter().find_map(|key| Some((key, reader.node(key)?))) {
        let message = format!("{} has `{key}`, which is not used with `{}`", reader.what, given[0]);
        return context.fail(node.span, message, format!("remove `{key}`"));
    }
    if given == ["mesh"] {
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
    let position = if given == ["size"] { size(reader)? } else { volume(reader)? };
    block(reader, &position, divisions)
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

/// Hexahedra with nodes at half divisions, of which those at the middles of faces and elements do not exist.
fn block(reader: &Reader<'_, '_>, position: &PointOf, divisions: [usize; 3]) -> Option<SolidMesh> {
    let [l, m, n] = divisions;
    let counts = divisions.map(|count| 2 * count + 1);
    let mut numbers = vec![usize::MAX; counts.iter().product()];
    let place = |[i, j, k]: [usize; 3]| (k * counts[1] + j) * counts[0] + i;
    let (mut mesh, mut places) = (SolidMesh::default(), Vec::new());
    for k in 0..counts[2] {
        for j in 0..counts[1] {
            for i in (0..counts[0]).filter(|i| i % 2 + j % 2 + k % 2 < 2) {
                let own: [f64; 3] = std::array::from_fn(|c| [i, j, k][c] as f64 / (counts[c] - 1) as f64);
                let position = position(own);
                if !position.iter().all(|x| x.is_finite()) {
                    let message = format!(
                        "{} is not finite at u = {:.4}, v = {:.4}, w = {:.4}",
                        reader.words("volume"),
                        own[0],
                        own[1],
                        own[2]
                    );
                    return reader.context.fail(reader.name, message, "check the expressions there");
                }
                for (c, [low, high]) in [[0, 1], [2, 3], [4, 5]].into_iter().enumerate() {
                    for (side, value) in [(low, 0.0), (high, 1.0)] {
                        if own[c] == value {
                            mesh.sets.entry(SIDES[side].to_owned()).or_default().push(mesh.positions.len());
                        }
                    }
                }
                numbers[place([i, j, k])] = mesh.positions.len();
                mesh.positions.push(position);
                places.push(own);
            }
        }
    }
    for element in 0..l * m * n {
        let first = [element % l, element / l % m, element / (l * m)];
        mesh.hexahedra.push(std::array::from_fn(|node| {
            let own = hexahedron_node(node);
            numbers[place(std::array::from_fn(|c| (2 * first[c] + 1).wrapping_add_signed(own[c] as isize)))]
        }));
    }
    mesh.places = Some(places);
    Some(mesh)
}

fn mesh(reader: &Reader<'_, '_>) -> Option<SolidMesh> {
    let (context, node) = (reader.context, reader.node("mesh")?);
    let path = reader.text("mesh")?;
    let what = reader.words("mesh");
    let text = context.file_text(node, path.value, &what)?;
    let extension = path.value.rsplit_once('.').map_or("", |(_, extension)| extension);
    let group = reader.text("group").map(|group| group.value.to_owned());
    let is_solid = |shape: MeshShape| shape.dimension() == 3;
    let read = lissom_mesh::read(text.as_bytes(), extension).and_then(|mut mesh| {
        // Groups of surfaces are sets of nodes of the solid.
        let edges = edges_of_sets(&mesh);
        let element_sets = mesh.element_sets.iter();
        let of_elements: Vec<_> =
            element_sets.map(|(name, elements)| (name.clone(), mesh.nodes_of(elements))).collect();
        for (name, nodes) in of_elements {
            mesh.node_sets.entry(name).or_insert(nodes);
        }
        let mut part = mesh.part(group.as_deref(), is_solid)?;
        // Between linear elements nodes are added that a set of all nodes in the file lacks.
        let count = part.positions.len();
        part.node_sets.retain(|name, nodes| name != ALL || nodes.len() < count);
        Ok((part, edges))
    });
    let (mesh, edges) = match read {
        Ok(read) => read,
        Err(error) => {
            let help = "see docs/solids.md for what is read of meshes";
            return context.fail(node.span, format!("{what}: {error}"), help);
        }
    };
    let materials: BTreeSet<_> = mesh.sections.iter().filter_map(|own| own.material.as_ref()).collect();
    if materials.len() > 1 {
        let message =
            format!("{what} has sections of {} materials, and all elements get one", materials.len());
        let help = "name the elements of one material by `group`, each in a solid of its own";
        context.report(Problem::warning(node.span, message).help(help));
    }
    if let Some((first, others)) = mesh.notes.split_first() {
        let more =
            if others.is_empty() { String::new() } else { format!("; {} more are left out", others.len()) };
        let problem = Problem::warning(node.span, format!("{what} is read in part: {first}{more}"));
        context.report(problem.help("check that nothing of the solid is missing: `lissom view --initial`"));
    }
    let frame = context.frame(reader.scope)?;
    Some(of_mesh(&mesh, &edges, &frame, reader.number("scale")?.value))
}

/// Numbers of the nodes at the ends of an edge in a file.
type FileEdges = BTreeMap<String, BTreeSet<[u64; 2]>>;

/// Edges of the elements of each set.
fn edges_of_sets(mesh: &Mesh) -> FileEdges {
    let of = |element: &usize| {
        let element = &mesh.elements[*element];
        let number = |node: usize| mesh.node_numbers[element.nodes[node]];
        let edges: Vec<[usize; 2]> = match element.shape {
            MeshShape::Tetrahedron4 | MeshShape::Tetrahedron10 => TETRAHEDRON_EDGES.to_vec(),
            MeshShape::Hexahedron8 | MeshShape::Hexahedron20 => HEXAHEDRON_EDGES.to_vec(),
            _ => {
                let count = element.nodes.len();
                (0..count).map(|i| [i, (i + 1) % count]).collect()
            }
        };
        edges.into_iter().map(move |ends| ends.map(number)).map(edge).collect::<Vec<_>>()
    };
    let sets = mesh.element_sets.iter();
    sets.map(|(name, elements)| (name.clone(), elements.iter().flat_map(of).collect())).collect()
}

/// A mesh of second order: elements of first order get nodes at the middles of their edges.
fn of_mesh(mesh: &Mesh, edges: &FileEdges, frame: &Motion, scale: f64) -> SolidMesh {
    let position = |own: &[f64; 3]| frame.transform_point(&(scale * Vector3::from(*own)));
    let mut solid =
        SolidMesh { positions: mesh.positions.iter().map(position).collect(), ..SolidMesh::default() };
    for element in &mesh.elements {
        match element.shape {
            MeshShape::Tetrahedron10 => solid.tetrahedra.extend(<[usize; 10]>::try_from(&*element.nodes)),
            MeshShape::Hexahedron20 => solid.hexahedra.extend(<[usize; 20]>::try_from(&*element.nodes)),
            _ => {}
        }
    }
    let mut middles = solid.middles();
    let given = solid.positions.len();
    for element in &mesh.elements {
        let into = (&mut solid.positions, &mut middles);
        if let (MeshShape::Tetrahedron4, Ok(corners)) =
            (element.shape, <[usize; 4]>::try_from(&*element.nodes))
        {
            solid.tetrahedra.push(raised(corners, &TETRAHEDRON_EDGES, into));
        } else if let (MeshShape::Hexahedron8, Ok(corners)) =
            (element.shape, <[usize; 8]>::try_from(&*element.nodes))
        {
            solid.hexahedra.push(raised(corners, &HEXAHEDRON_EDGES, into));
        }
    }
    solid.sets.clone_from(&mesh.node_sets);
    if solid.positions.len() > given {
        solid.find_faces();
        for (name, nodes) in &mut solid.sets {
            let set: BTreeSet<usize> = nodes.iter().copied().collect();
            // New nodes of edges of the set's elements, otherwise of outer faces with all their corners in the set.
            let of_elements = middles.iter().filter(|(ends, _)| {
                let numbers = ends.map(|end| mesh.node_numbers.get(end).copied().unwrap_or_default());
                // A set of nodes may have the name of a set of elements, of which it contains some nodes only.
                ends.iter().all(|end| set.contains(end))
                    && edges.get(name).is_some_and(|edges| edges.contains(&edge(numbers)))
            });
            let mut added: BTreeSet<usize> = of_elements.map(|(_, &middle)| middle).collect();
            let faces = solid.triangles.iter().map(<[usize; 6]>::as_slice);
            for face in faces.chain(solid.quadrilaterals.iter().map(<[usize; 8]>::as_slice)) {
                let (corners, sides) = face.split_at(face.len() / 2);
                if !edges.contains_key(name) && corners.iter().all(|node| set.contains(node)) {
                    added.extend(sides);
                }
            }
            nodes.extend(added.into_iter().filter(|node| !set.contains(node)));
        }
    }
    solid
}

/// Makes nodes at the same position one if that is wanted; otherwise they are a fault of a mesh.
fn joined(reader: &Reader<'_, '_>, mesh: &mut SolidMesh) -> Option<()> {
    let (kept, numbers) = coincident(&mesh.positions);
    if kept.len() == mesh.positions.len() {
        return Some(());
    }
    if !reader.flag("join")?.value {
        let twice = (0..numbers.len()).find(|&node| kept[numbers[node]] != node).unwrap_or_default();
        let at = mesh.positions[twice];
        let message = format!(
            "{} has two nodes at [{:.4}, {:.4}, {:.4}]: it is not connected there",
            reader.what, at.x, at.y, at.z
        );
        return reader.context.fail(
            reader.name,
            message,
            "set `join = true` to make nodes at the same position one",
        );
    }
    mesh.tetrahedra.iter_mut().flatten().for_each(|node| *node = numbers[*node]);
    mesh.hexahedra.iter_mut().flatten().for_each(|node| *node = numbers[*node]);
    for set in mesh.sets.values_mut() {
        for node in set.iter_mut() {
            *node = numbers[*node];
        }
        set.sort_unstable();
        set.dedup();
    }
    mesh.positions = kept.iter().map(|&node| mesh.positions[node]).collect();
    if let Some(places) = &mut mesh.places {
        *places = kept.iter().map(|&node| places[node]).collect();
    }
    Some(())
}

/// Checks that elements meet in whole faces: their displacements agree there.
fn check_connection(reader: &Reader<'_, '_>, mesh: &SolidMesh) -> Option<()> {
    let fault = |node: usize, message: &str, help: &str| {
        let at = mesh.positions[node];
        let message = format!("{} has {message} at [{:.4}, {:.4}, {:.4}]", reader.what, at.x, at.y, at.z);
        reader.context.fail::<()>(reader.name, message, help);
    };
    let mut known: HashSet<Vec<usize>> = HashSet::new();
    let (mut corners, mut middles) = (BTreeSet::<usize>::new(), BTreeSet::<usize>::new());
    let tetrahedra = mesh.tetrahedra.iter().map(|own| own.split_at(4));
    for (own, sides) in tetrahedra.chain(mesh.hexahedra.iter().map(|own| own.split_at(8))) {
        corners.extend(own);
        middles.extend(sides);
        let mut own = own.to_vec();
        own.sort_unstable();
        let first = own[0];
        if !known.insert(own) {
            fault(first, "two elements with the same nodes", "remove one of them from the mesh");
            return None;
        }
    }
    if let Some(&hanging) = corners.intersection(&middles).next() {
        let message = "an element with a corner at the middle of an edge of another";
        fault(hanging, message, "refine both alike: elements must share whole faces");
        return None;
    }
    let sorted = |mut three: [usize; 3]| {
        three.sort_unstable();
        three
    };
    let triangles: HashSet<[usize; 3]> =
        mesh.triangles.iter().map(|&[a, b, c, ..]| sorted([a, b, c])).collect();
    let halved = mesh.quadrilaterals.iter().find(|&&[a, b, c, d, ..]| {
        [[a, b, c], [b, c, d], [c, d, a], [d, a, b]]
            .into_iter()
            .any(|three| triangles.contains(&sorted(three)))
    });
    if let Some([corner, ..]) = halved {
        let help =
            "tetrahedra and hexahedra share no face: mesh with one of them, or join two solids by a body";
        fault(*corner, "a face of a hexahedron on that of a tetrahedron", help);
        return None;
    }
    Some(())
}

/// Checks that no element is inverted, and that elements use all nodes.
fn check(reader: &Reader<'_, '_>, mesh: &SolidMesh) -> Option<()> {
    let tetrahedra =
        mesh.tetrahedra.iter().map(|own| tetrahedron_shares(&own.map(|node| mesh.positions[node])).err());
    let hexahedra =
        mesh.hexahedra.iter().map(|own| hexahedron_shares(&own.map(|node| mesh.positions[node])).err());
    let mut faults = tetrahedra.chain(hexahedra).enumerate();
    if let Some((element, fault)) = faults.find_map(|(element, fault)| Some((element, fault?))) {
        let at = fault.position;
        let message = format!(
            "element {} of {} is inverted or has no volume at [{:.4}, {:.4}, {:.4}]",
            element + 1,
            reader.what,
            at.x,
            at.y,
            at.z
        );
        let help =
            "u, v and w must be right-handed, and elements convex: check the expressions or the mesh there";
        return reader.context.fail(reader.name, message, help);
    }
    let used: BTreeSet<usize> =
        mesh.tetrahedra.iter().flatten().chain(mesh.hexahedra.iter().flatten()).copied().collect();
    if let Some(unused) = (0..mesh.positions.len()).find(|node| !used.contains(node)) {
        let at = mesh.positions[unused];
        let message =
            format!("no element of {} uses its node at [{:.4}, {:.4}, {:.4}]", reader.what, at.x, at.y, at.z);
        return reader.context.fail(reader.name, message, "remove the node from the mesh");
    }
    Some(())
}

fn pressures(reader: &Reader<'_, '_>, name: &str, mesh: &SolidMesh) -> Option<Vec<FacePressure>> {
    let context = reader.context;
    let Some(node) = reader.node("pressure") else { return Some(Vec::new()) };
    let Some(table) = node.table() else {
        return context.wrong_type(node, &reader.words("pressure"), "a table such as { top = \"2e5*t\" }");
    };
    let read = |(set, entry): (&String, &Node)| {
        let nodes = match mesh.nodes_at(name, &MeshPlace::Set(set.clone())) {
            Ok(nodes) => nodes,
            Err((message, help)) => return context.fail(entry.span, message, help),
        };
        let (triangles, quadrilaterals) = mesh.faces_in(&nodes);
        if triangles.is_empty() && quadrilaterals.is_empty() {
            let message = format!("set `{set}` of {} contains no outer face", reader.what);
            return context.fail(entry.span, message, "name a set that contains all nodes of a face");
        }
        let value = formula(reader, entry, &format!("pressure on `{set}`"), &["t"])?;
        Some(FacePressure { triangles, quadrilaterals, value, span: entry.span })
    };
    table.iter().map(|(set, entry)| read((set, &entry.node))).collect()
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use crate::lower::registry::registry;
    use crate::{Document, Library, ModelText};

    /// Two cubes along x.
    const CUBES: &str = "*Node\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n8, 0, 1, 1\n\
                         9, 2, 0, 0\n10, 2, 1, 0\n11, 2, 0, 1\n12, 2, 1, 1\n\
                         *Element, type=C3D8, elset=A\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*Element, type=C3D8, elset=B\n2, 2, 9, 10, 3, 6, 11, 12, 7\n\
                         *Nset, nset=A\n1, 4, 5, 8\n";

    fn document(mesh: &str) -> Result<Document, String> {
        let text = "lissom = 1\n[materials.m]\nE = 1e9\nnu = 0.3\ndensity = 1000\n[solids.s]\nmesh = \"s.inp\"\nmaterial = \"m\"\n\
                    [analysis]\nkind = \"dynamics\"\nend = 1\n";
        let library = Library::of_texts([("s.inp".to_owned(), mesh.to_owned())]);
        let read = ModelText::read_with(text, "model.toml", &[], Arc::new(library));
        let document = read.and_then(|text| text.document(&registry(), &[]));
        document.map_err(|report| report.render(false))
    }

    /// As Abaqus writes a face: its nodes, and the elements behind it, by one name.
    #[test]
    fn nodes_of_a_face_are_those_of_the_set_of_nodes() {
        let document = document(CUBES).expect("a good model");
        let mesh = &document.elastic_solids[0].mesh;
        assert_eq!((mesh.sets["A"].len(), mesh.sets["B"].len()), (8, 20));
        assert!(mesh.sets["A"].iter().all(|&node| mesh.positions[node].x == 0.0));
    }

    #[test]
    fn elements_must_share_whole_faces() {
        let with = |more: &str| document(&format!("{CUBES}{more}")).expect_err("no good mesh");
        let twice = with("*Element, type=C3D8, elset=C\n3, 1, 2, 3, 4, 5, 6, 7, 8\n");
        assert!(twice.contains("two elements with the same nodes"), "{twice}");
        let tetrahedron = with("*Node\n13, 3, 0.5, 0.5\n*Element, type=C3D4, elset=C\n3, 9, 10, 11, 13\n");
        assert!(tetrahedron.contains("a face of a hexahedron on that of a tetrahedron"), "{tetrahedron}");
        // Of second order, the middle of whose edge is a corner of the cubes.
        let hanging = with(
            "*Node\n13, 0, 0, 3\n14, 0.5, 1, 2\n15, 0.5, 0.5, 2.5\n16, 0.25, 0.5, 1.5\n17, 0.25, 0.5, 2.5\n18, 0.5, 0.5, 1\n\
             *Element, type=C3D10, elset=C\n3, 1, 2, 14, 13, 5, 6, 16, 15, 17, 18\n",
        );
        assert!(hanging.contains("a corner at the middle of an edge"), "{hanging}");
    }

    #[test]
    fn several_materials_of_a_file_are_reported() {
        let sections = "*Solid section, elset=A, material=X\n*Solid section, elset=B, material=Y\n\
                        *Material, name=X\n*Elastic\n1e9, 0.3\n*Material, name=Y\n*Elastic\n2e9, 0.3\n";
        let warnings = |text: &str| document(text).expect("a good model").warnings.render(false);
        assert!(warnings(&format!("{CUBES}{sections}")).contains("sections of 2 materials"));
        assert!(!warnings(CUBES).contains("materials"));
    }
}
