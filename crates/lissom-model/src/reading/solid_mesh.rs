//! Nodes and elements of a solid, as the model describes them.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use lissom_flexible::solid::pressure::area_shares;
use lissom_flexible::solid::shape::{
    HEXAHEDRON_EDGES, HEXAHEDRON_FACES, TETRAHEDRON_EDGES, TETRAHEDRON_FACES,
};
use lissom_flexible::solid::volume::{hexahedron_shares, tetrahedron_shares};
use lissom_motion::Vector3;

use super::mesh_nodes::NodeSets;

/// Nodes and elements of a solid. Elements have their nodes in the order of Abaqus.
#[derive(Clone, Debug, Default)]
pub struct SolidMesh {
    /// Positions of the nodes [m].
    pub positions: Vec<Vector3>,
    /// u, v and w of each node of a block, from 0 to 1; none for a mesh from a file.
    pub places: Option<Vec<[f64; 3]>>,
    /// Tetrahedra of second order.
    pub tetrahedra: Vec<[usize; 10]>,
    /// Hexahedra of second order.
    pub hexahedra: Vec<[usize; 20]>,
    /// Outer faces of tetrahedra: corners counterclockwise seen from outside, then the middles of the sides.
    pub triangles: Vec<[usize; 6]>,
    /// The same of hexahedra.
    pub quadrilaterals: Vec<[usize; 8]>,
    /// Sets of nodes by name.
    pub sets: BTreeMap<String, Vec<usize>>,
}

/// The middle node of each edge, by its corners in ascending order.
pub(crate) type Middles = HashMap<[usize; 2], usize>;

/// An edge, whichever its direction.
pub(crate) fn edge<T: Ord + Copy>([a, b]: [T; 2]) -> [T; 2] {
    [a.min(b), a.max(b)]
}

/// The nodes of a first-order element and of the middles of its edges; new nodes are added between corners that have none.
pub(crate) fn raised<const CORNERS: usize, const EDGES: usize, const NODES: usize>(
    corners: [usize; CORNERS],
    edges: &[[usize; 2]; EDGES],
    (positions, middles): (&mut Vec<Vector3>, &mut Middles),
) -> [usize; NODES] {
    let mut nodes = [0; NODES];
    nodes[..CORNERS].copy_from_slice(&corners);
    for (k, ends) in edges.iter().enumerate() {
        let ends = ends.map(|end| corners[end]);
        nodes[CORNERS + k] = *middles.entry(edge(ends)).or_insert_with(|| {
            positions.push(0.5 * (positions[ends[0]] + positions[ends[1]]));
            positions.len() - 1
        });
    }
    nodes
}

/// Faces that belong to one element only.
fn outer<const NODES: usize>(faces: impl Iterator<Item = [usize; NODES]> + Clone) -> Vec<[usize; NODES]> {
    let corners = |face: &[usize; NODES]| {
        let mut corners = face[..NODES / 2].to_vec();
        corners.sort_unstable();
        corners
    };
    let mut counts: HashMap<Vec<usize>, usize> = HashMap::new();
    faces.clone().for_each(|face| *counts.entry(corners(&face)).or_default() += 1);
    faces.filter(|face| counts[&corners(face)] == 1).collect()
}

impl SolidMesh {
    /// Finds the outer faces of its elements.
    pub(crate) fn find_faces(&mut self) {
        let faces = TETRAHEDRON_FACES;
        self.triangles =
            outer(self.tetrahedra.iter().flat_map(|own| faces.map(|face| face.map(|node| own[node]))));
        let faces = HEXAHEDRON_FACES;
        self.quadrilaterals =
            outer(self.hexahedra.iter().flat_map(|own| faces.map(|face| face.map(|node| own[node]))));
    }

    /// The middle nodes of the edges of all elements.
    pub(crate) fn middles(&self) -> Middles {
        let of = |own: &[usize], edges: &[[usize; 2]]| -> Vec<([usize; 2], usize)> {
            let corners = own.len() - edges.len();
            let middle = |(k, ends): (usize, &[usize; 2])| (edge(ends.map(|end| own[end])), own[corners + k]);
            edges.iter().enumerate().map(middle).collect()
        };
        let tetrahedra = self.tetrahedra.iter().flat_map(|own| of(own, &TETRAHEDRON_EDGES));
        tetrahedra.chain(self.hexahedra.iter().flat_map(|own| of(own, &HEXAHEDRON_EDGES))).collect()
    }

    /// Number of elements.
    pub fn element_count(&self) -> usize {
        self.tetrahedra.len() + self.hexahedra.len()
    }

    /// Outer faces with all their nodes in a set.
    pub fn faces_in(&self, nodes: &[usize]) -> (Vec<[usize; 6]>, Vec<[usize; 8]>) {
        let set: BTreeSet<usize> = nodes.iter().copied().collect();
        let is_in = |face: &[usize]| face.iter().all(|node| set.contains(node));
        let triangles = self.triangles.iter().copied().filter(|face| is_in(face));
        (triangles.collect(), self.quadrilaterals.iter().copied().filter(|face| is_in(face)).collect())
    }

    fn places_of<const NODES: usize>(&self, nodes: &[usize; NODES]) -> [Vector3; NODES] {
        nodes.map(|node| self.positions[node])
    }
}

impl NodeSets for SolidMesh {
    fn word(&self) -> &'static str {
        "solid"
    }

    fn positions(&self) -> &[Vector3] {
        &self.positions
    }

    fn sets(&self) -> &BTreeMap<String, Vec<usize>> {
        &self.sets
    }

    fn fractions(&self, node: usize) -> Option<&[f64]> {
        self.places.as_ref().map(|places| places[node].as_slice())
    }

    /// By volume where the nodes span elements, otherwise by area of outer faces, otherwise by length of their sides. Shares in areas are
    /// those of a uniform force per area, and so those of corners are zero or negative.
    fn sizes(&self, nodes: &[usize]) -> Vec<f64> {
        let index: HashMap<usize, usize> = nodes.iter().enumerate().map(|(k, &node)| (node, k)).collect();
        let is_in = |own: &[usize]| own.iter().all(|node| index.contains_key(node));
        let mut sizes = vec![0.0; nodes.len()];
        let mut add = |own: &[usize], shares: &[f64]| {
            own.iter().zip(shares).for_each(|(node, share)| sizes[index[node]] += share);
        };
        let (triangles, quadrilaterals) = self.faces_in(nodes);
        let mut has_elements = false;
        for own in self.tetrahedra.iter().filter(|own| is_in(*own)) {
            add(own, &tetrahedron_shares(&self.places_of(own)).unwrap_or_default());
            has_elements = true;
        }
        for own in self.hexahedra.iter().filter(|own| is_in(*own)) {
            add(own, &hexahedron_shares(&self.places_of(own)).unwrap_or_default());
            has_elements = true;
        }
        if has_elements {
            return sizes;
        }
        for own in &triangles {
            add(own, &area_shares(&self.places_of(own)));
        }
        for own in &quadrilaterals {
            add(own, &area_shares(&self.places_of(own)));
        }
        if !(triangles.is_empty() && quadrilaterals.is_empty()) {
            return sizes;
        }
        let mut seen = BTreeSet::new();
        let faces = self.triangles.iter().map(<[usize; 6]>::as_slice);
        for face in faces.chain(self.quadrilaterals.iter().map(<[usize; 8]>::as_slice)) {
            let corners = face.len() / 2;
            for i in 0..corners {
                let side = [face[i], face[corners + i], face[(i + 1) % corners]];
                if is_in(&side) && seen.insert(side[1]) {
                    let length = (self.positions[side[2]] - self.positions[side[0]]).norm();
                    add(&side, &[1.0, 4.0, 1.0].map(|share| share * length / 6.0));
                }
            }
        }
        if seen.is_empty() { vec![1.0; nodes.len()] } else { sizes }
    }
}
