//! Search for faults of a surface mesh.

use std::collections::HashMap;

use crate::mesh::{Mesh, MeshElement, MeshShape};
use crate::surface::edges::{Edge, edges, shared, sides};
use crate::surface::fault::{MeshFault, MeshFaultKind};
use crate::surface::node_tree::{NodeTree, along};
use crate::vectors::{cross, difference, dot, length, mean};

/// Distance of nodes at the same position, relative to the size of the mesh.
const SAME_POSITION: f64 = 1e-9;
/// Distance of a hanging node from an edge, relative to the length of the edge. Files often have seven digits.
const ON_EDGE: f64 = 1e-6;
/// Area of an element without one, relative to the square of its longest side.
const NO_AREA: f64 = 1e-9;
/// Sine of an angle that differs from 180 degrees by less than what a file can state.
const STRAIGHT: f64 = 1e-6;
/// Largest length by width without a warning.
const SLENDER: f64 = 20.0;
/// Largest warp without a warning, in degrees.
const WARPED: f64 = 15.0;

impl Mesh {
    /// Faults of the triangles and quadrilaterals without nodes on their sides, errors first. Other elements only count as users of nodes.
    pub fn surface_faults(&self) -> Vec<MeshFault> {
        let mut faults = Vec::new();
        self.faults_of_elements(&mut faults);
        let edges = edges(self);
        self.faults_of_edges(&edges, &mut faults);
        self.faults_of_boundaries(&edges, &mut faults);
        self.unused_nodes(&mut faults);
        faults.sort_by_key(MeshFault::severity);
        faults
    }

    fn fault(&self, kind: MeshFaultKind, elements: &[usize], nodes: &[usize]) -> MeshFault {
        let corners = elements.iter().flat_map(|&element| self.elements[element].nodes.iter());
        let corners: Vec<usize> = if nodes.is_empty() { corners.copied().collect() } else { nodes.to_vec() };
        MeshFault {
            kind,
            elements: elements.iter().map(|&element| self.elements[element].number).collect(),
            nodes: nodes.iter().map(|&node| self.node_numbers[node]).collect(),
            position: mean(corners.iter().map(|&node| self.positions[node])),
        }
    }

    fn faults_of_elements(&self, faults: &mut Vec<MeshFault>) {
        let mut known: HashMap<Vec<usize>, usize> = HashMap::new();
        for (index, element) in self.elements.iter().enumerate() {
            if !element.shape.has_corners_only() {
                continue;
            }
            let mut ascending = element.nodes.clone();
            ascending.sort_unstable();
            if let Some(pair) = ascending.windows(2).find(|pair| pair[0] == pair[1]) {
                faults.push(self.fault(MeshFaultKind::RepeatedNode, &[index], &pair[..1]));
                continue;
            }
            let first = *known.entry(ascending).or_insert(index);
            if first != index {
                faults.push(self.fault(MeshFaultKind::SameElement, &[first, index], &[]));
            }
            faults.extend(
                self.faults_of_shape(element).map(|(kind, nodes)| self.fault(kind, &[index], &nodes)),
            );
        }
    }

    /// Kinds of faults of the shape of an element, with the nodes concerned.
    fn faults_of_shape(&self, element: &MeshElement) -> impl Iterator<Item = (MeshFaultKind, Vec<usize>)> {
        let lengths: Vec<f64> = sides(element)
            .map(|[from, to]| length(difference(self.positions[to], self.positions[from])))
            .collect();
        let longest = lengths.iter().copied().fold(0.0, f64::max);
        let shortest = lengths.iter().copied().fold(f64::INFINITY, f64::min);
        let normal = self.area_vector(element);
        let area = length(normal);
        if area <= NO_AREA * longest * longest {
            return vec![(MeshFaultKind::ZeroArea, Vec::new())].into_iter();
        }
        let mut found = Vec::new();
        // Of an equilateral triangle length by height is 2/√3.
        let is_triangle = element.shape == MeshShape::Triangle3;
        let of_area = longest * longest / area * if is_triangle { 0.75_f64.sqrt() / 2.0 } else { 1.0 };
        let ratio = if is_triangle { of_area } else { of_area.max(longest / shortest) };
        if ratio > SLENDER {
            found.push((MeshFaultKind::AspectRatio { ratio }, Vec::new()));
        }
        if let &[a, b, c, d] = element.nodes.as_slice() {
            let corners = [[d, a, b], [a, b, c], [b, c, d], [c, d, a]];
            let normals = corners.map(|corner| self.normal(corner));
            let concave = (0..4).find(|&corner| {
                let [before, after] = [lengths[(corner + 3) % 4], lengths[corner]];
                dot(normals[corner], normal) <= STRAIGHT * before * after * area
            });
            if let Some(corner) = concave {
                found.push((MeshFaultKind::NotConvex, vec![corners[corner][1]]));
            } else {
                // Corners opposite to each other are the triangles beside a diagonal.
                let warps = [0, 1].map(|corner| angle(normals[corner], normals[corner + 2]));
                let degrees = warps[0].max(warps[1]).to_degrees();
                if degrees > WARPED {
                    found.push((MeshFaultKind::Warp { degrees }, Vec::new()));
                }
            }
        }
        found.into_iter()
    }

    /// Normal of a triangle, as long as twice its area.
    fn normal(&self, [a, b, c]: [usize; 3]) -> [f64; 3] {
        let [a, b, c] = [a, b, c].map(|node| self.positions[node]);
        cross(difference(b, a), difference(c, b))
    }

    fn faults_of_edges(&self, edges: &[Edge], faults: &mut Vec<MeshFault>) {
        for own in shared(edges) {
            let elements: Vec<usize> = own.iter().map(|edge| edge.element).collect();
            let kind = match own {
                [first, second] if first.is_forward == second.is_forward => {
                    MeshFaultKind::OppositeOrientation
                }
                [_, _, _, ..] => MeshFaultKind::Branch,
                _ => continue,
            };
            faults.push(self.fault(kind, &elements, &own[0].nodes));
        }
    }

    fn faults_of_boundaries(&self, edges: &[Edge], faults: &mut Vec<MeshFault>) {
        let boundary: Vec<&Edge> = shared(edges).filter(|own| own.len() == 1).map(|own| &own[0]).collect();
        // An element at each node of the boundary.
        let mut element_of: HashMap<usize, usize> = HashMap::new();
        for edge in &boundary {
            for node in edge.nodes {
                element_of.entry(node).or_insert(edge.element);
            }
        }
        let mut nodes: Vec<usize> = element_of.keys().copied().collect();
        nodes.sort_unstable();
        let tree = NodeTree::new(&self.positions, nodes.clone());
        let tolerance = SAME_POSITION * self.size();
        for &node in &nodes {
            let position = self.positions[node];
            tree.near_line([position; 2], tolerance, |other| {
                let is_same =
                    other < node && length(difference(self.positions[other], position)) <= tolerance;
                if is_same {
                    let elements = [element_of[&other], element_of[&node]];
                    let elements = if elements[0] == elements[1] { &elements[..1] } else { &elements };
                    faults.push(self.fault(MeshFaultKind::TornMesh, elements, &[other, node]));
                }
                is_same
            });
        }
        for edge in boundary {
            let ends = edge.nodes.map(|node| self.positions[node]);
            let full = length(difference(ends[1], ends[0]));
            let tolerance = ON_EDGE * full;
            if full == 0.0 {
                continue;
            }
            tree.near_line(ends, tolerance, |node| {
                let (parameter, distance) = along(self.positions[node], ends);
                let is_within = distance <= tolerance && parameter > ON_EDGE && parameter < 1.0 - ON_EDGE;
                if is_within && !self.elements[edge.element].nodes.contains(&node) {
                    let elements = [edge.element, element_of[&node]];
                    faults.push(self.fault(MeshFaultKind::HangingNode, &elements, &[node]));
                }
                false
            });
        }
    }

    fn unused_nodes(&self, faults: &mut Vec<MeshFault>) {
        let mut is_used = vec![false; self.positions.len()];
        for &node in self.elements.iter().flat_map(|element| &element.nodes) {
            is_used[node] = true;
        }
        let unused = (0..is_used.len()).filter(|&node| !is_used[node]);
        faults.extend(unused.map(|node| self.fault(MeshFaultKind::UnusedNode, &[], &[node])));
    }
}

/// Angle between two vectors in radians.
fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    length(cross(a, b)).atan2(dot(a, b))
}

#[cfg(test)]
#[path = "../../tests/unit/surface/faults.rs"]
mod tests;
