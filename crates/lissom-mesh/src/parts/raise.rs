//! Solid elements of first order as those of second order.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use lissom_motion::{Motion, Vector3};

use crate::error::MeshError;
use crate::mesh::{Mesh, MeshElement};
use crate::parts::meshed_part::{Element, MeshedPart, positions};

/// Numbers of the nodes at the ends of the edges of the elements of each set.
type EdgesOfSets = BTreeMap<String, BTreeSet<[u64; 2]>>;

/// An edge, whichever its direction.
fn edge<T: Ord + Copy>([a, b]: [T; 2]) -> [T; 2] {
    [a.min(b), a.max(b)]
}

/// Pairs of corners of an element.
fn edges(element: &MeshElement) -> Vec<[usize; 2]> {
    let count = element.shape.corner_count();
    let around = || (0..count).map(|i| [i, (i + 1) % count]).collect();
    element.shape.solid_kind().map_or_else(around, |(kind, _)| kind.edges.to_vec())
}

fn edges_of_sets(mesh: &Mesh) -> EdgesOfSets {
    let of = |element: &usize| {
        let element = &mesh.elements[*element];
        let number = |node: usize| mesh.node_numbers[element.nodes[node]];
        edges(element).into_iter().map(move |ends| edge(ends.map(number))).collect::<Vec<_>>()
    };
    let sets = mesh.element_sets.iter();
    sets.map(|(name, elements)| (name.clone(), elements.iter().flat_map(of).collect())).collect()
}

impl MeshedPart {
    /// The solid elements of a set of a mesh, or of all. Those of first order get nodes at the middles of their edges, which are in the sets
    /// of their elements, or else in those of outer faces. Sets of elements are sets of their nodes.
    ///
    /// # Errors
    /// As of [`Mesh::part`].
    pub fn of_solid(
        mut mesh: Mesh,
        group: Option<&str>,
        (frame, scale): (&Motion, f64),
    ) -> Result<(Self, Mesh), MeshError> {
        let edges = edges_of_sets(&mesh);
        let of_elements: Vec<_> =
            mesh.element_sets.iter().map(|(name, own)| (name.clone(), mesh.nodes_of(own))).collect();
        for (name, nodes) in of_elements {
            mesh.node_sets.entry(name).or_insert(nodes);
        }
        let part = mesh.part(group, |shape| shape.dimension() == 3)?;
        Ok((raised(&part, &edges, positions(&part, frame, scale)), part))
    }
}

fn raised(mesh: &Mesh, edges: &EdgesOfSets, positions: Vec<Vector3>) -> MeshedPart {
    let given = positions.len();
    let mut part =
        MeshedPart { coordinates: 3, positions, sets: mesh.node_sets.clone(), ..MeshedPart::default() };
    let kind_of = |own: &MeshElement| own.shape.solid_kind();
    let mut middles: HashMap<[usize; 2], usize> = HashMap::new();
    for own in &mesh.elements {
        let Some((kind, true)) = kind_of(own) else { continue };
        let given = kind.edges.iter().zip(&own.nodes[kind.corners.len()..]);
        middles.extend(given.map(|(ends, &middle)| (edge(ends.map(|end| own.nodes[end])), middle)));
    }
    for own in &mesh.elements {
        let Some((kind, is_second)) = kind_of(own) else { continue };
        let mut nodes = own.nodes.clone();
        for ends in kind.edges.iter().filter(|_| !is_second) {
            let ends = ends.map(|end| own.nodes[end]);
            nodes.push(*middles.entry(edge(ends)).or_insert_with(|| {
                part.positions.push(0.5 * (part.positions[ends[0]] + part.positions[ends[1]]));
                part.positions.len() - 1
            }));
        }
        part.elements.push(Element { shape: kind.shapes[1], nodes });
    }
    if part.positions.len() == given {
        return part;
    }
    part.find_faces();
    for (name, nodes) in &mut part.sets {
        let set: BTreeSet<usize> = nodes.iter().copied().collect();
        // A set of nodes may have the name of a set of elements, of which it contains some nodes only.
        let is_of_elements = |ends: &[usize; 2]| {
            let numbers = ends.map(|end| mesh.node_numbers.get(end).copied().unwrap_or_default());
            ends.iter().all(|end| set.contains(end))
                && edges.get(name).is_some_and(|edges| edges.contains(&edge(numbers)))
        };
        let of_elements = middles.iter().filter(|(ends, _)| is_of_elements(ends));
        let mut added: BTreeSet<usize> = of_elements.map(|(_, &middle)| middle).collect();
        if !edges.contains_key(name) {
            for face in &part.faces {
                let (corners, sides) = face.split_at(face.len() / 2);
                if corners.iter().all(|node| set.contains(node)) {
                    added.extend(sides);
                }
            }
        }
        nodes.extend(added.into_iter().filter(|node| !set.contains(node)));
    }
    part
}
