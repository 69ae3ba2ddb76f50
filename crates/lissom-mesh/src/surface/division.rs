//! Division of triangles into quadrilaterals.

use std::collections::{BTreeMap, HashMap};

use crate::mesh::{Mesh, MeshElement, MeshShape};
use crate::vectors::mean;

impl Mesh {
    /// Divides every triangle into three quadrilaterals, from its centre to the middles of its sides, and every quadrilateral with
    /// nodes on its sides into four. If there is one, other quadrilaterals are divided into four and lines into two, so that neighbours
    /// still share their nodes; otherwise the mesh remains as it is. Solids are left out with a note.
    ///
    /// Parts of an element are in its sets. A new node is in those sets of nodes that contain all ends of its edge, or
    /// all corners of its element. The first part of an element keeps its number; others have numbers above all others.
    pub fn divided_into_quadrilaterals(&self) -> Mesh {
        let is_whole = |own: &MeshElement| !own.shape.is_surface() || own.shape == MeshShape::Quadrilateral4;
        if self.elements.iter().all(is_whole) {
            return self.clone();
        }
        let mut division = Division::new(self);
        // Nodes that are on sides already.
        for element in self.elements.iter().filter(|own| own.shape.dimension() < 3) {
            let (corners, others) = element.nodes.split_at(element.shape.corner_count());
            for (side, &middle) in others.iter().take(corners.len()).enumerate() {
                let [from, to] = [corners[side], corners[(side + 1) % corners.len()]];
                division.middles.insert([from.min(to), from.max(to)], middle);
            }
        }
        for element in &self.elements {
            division.divide(element);
        }
        let Division { mut mesh, children, .. } = division;
        let solids = children.iter().filter(|own| own.is_empty()).count();
        if solids > 0 {
            mesh.notes.push(format!("{solids} solid elements are left out when triangles are divided"));
        }
        for (name, set) in &self.element_sets {
            let parts = set.iter().flat_map(|&element| children[element].clone());
            mesh.element_sets.insert(name.clone(), parts.collect());
        }
        mesh
    }
}

struct Division<'a> {
    /// The result.
    mesh: Mesh,
    /// Names and indices of the sets of nodes.
    names: Vec<&'a str>,
    /// Indices of the sets of each node of the original, ascending.
    sets: Vec<Vec<usize>>,
    /// The node in the middle of an edge.
    middles: HashMap<[usize; 2], usize>,
    /// Parts of each element.
    children: Vec<std::ops::Range<usize>>,
    next_node: u64,
    next_element: u64,
}

impl<'a> Division<'a> {
    fn new(original: &'a Mesh) -> Self {
        let mut sets = vec![Vec::new(); original.positions.len()];
        for (index, set) in original.node_sets.values().enumerate() {
            for &node in set {
                sets[node].push(index);
            }
        }
        let mesh = Mesh { elements: Vec::new(), element_sets: BTreeMap::new(), ..original.clone() };
        let numbers = original.elements.iter().map(|element| element.number);
        Self {
            mesh,
            names: original.node_sets.keys().map(String::as_str).collect(),
            sets,
            middles: HashMap::new(),
            children: Vec::new(),
            next_node: original.node_numbers.iter().max().map_or(1, |last| last.saturating_add(1)),
            next_element: numbers.max().map_or(1, |last| last.saturating_add(1)),
        }
    }

    fn divide(&mut self, element: &MeshElement) {
        let start = self.mesh.elements.len();
        let (nodes, others) = element.nodes.split_at(element.shape.corner_count());
        match element.shape.dimension() {
            1 => {
                let middle = self.middle([nodes[0], nodes[1]]);
                self.add(element, start, vec![nodes[0], middle]);
                self.add(element, start, vec![middle, nodes[1]]);
            }
            2 => {
                let count = nodes.len();
                let middles: Vec<usize> =
                    (0..count).map(|side| self.middle([nodes[side], nodes[(side + 1) % count]])).collect();
                let centre = match others.get(count) {
                    Some(&centre) => centre,
                    None => self.centre(nodes, others),
                };
                for corner in 0..count {
                    let before = middles[(corner + count - 1) % count];
                    self.add(element, start, vec![nodes[corner], middles[corner], centre, before]);
                }
            }
            _ => {}
        }
        self.children.push(start..self.mesh.elements.len());
    }

    /// A new node at the centre of a triangle or quadrilateral, where functions of second order are if there are nodes on its sides.
    fn centre(&mut self, corners: &[usize], middles: &[usize]) -> usize {
        let centre = self.node_between(corners);
        if !middles.is_empty() {
            let [of_corners, of_middles] =
                if corners.len() == 3 { [-1.0 / 9.0, 4.0 / 9.0] } else { [-0.25, 0.5] };
            let weighted = corners
                .iter()
                .map(|own| (own, of_corners))
                .chain(middles.iter().map(|own| (own, of_middles)));
            let sum = |axis: usize| {
                weighted.clone().map(|(&own, weight)| weight * self.mesh.positions[own][axis]).sum()
            };
            self.mesh.positions[centre] = [sum(0), sum(1), sum(2)];
        }
        centre
    }

    /// Adds a part of an element whose first part has the index `start`.
    fn add(&mut self, element: &MeshElement, start: usize, nodes: Vec<usize>) {
        let mut number = element.number;
        if self.mesh.elements.len() > start {
            number = self.next_element;
            self.next_element = number.saturating_add(1);
        }
        let shape = if nodes.len() == 2 { MeshShape::Line2 } else { MeshShape::Quadrilateral4 };
        self.mesh.elements.push(MeshElement { number, shape, nodes });
    }

    fn middle(&mut self, [from, to]: [usize; 2]) -> usize {
        let edge = [from.min(to), from.max(to)];
        if let Some(&known) = self.middles.get(&edge) {
            return known;
        }
        let middle = self.node_between(&edge);
        self.middles.insert(edge, middle);
        middle
    }

    /// A new node in the mean position of nodes, in the sets that contain all of them.
    fn node_between(&mut self, nodes: &[usize]) -> usize {
        let index = self.mesh.positions.len();
        self.mesh.positions.push(mean(nodes.iter().map(|&node| self.mesh.positions[node])));
        self.mesh.node_numbers.push(self.next_node);
        self.next_node = self.next_node.saturating_add(1);
        let [first, others @ ..] = nodes else { return index };
        for set in &self.sets[*first] {
            if others.iter().all(|&node| self.sets[node].binary_search(set).is_ok())
                && let Some(members) = self.mesh.node_sets.get_mut(self.names[*set])
            {
                members.push(index);
            }
        }
        index
    }
}

#[cfg(test)]
#[path = "../../tests/unit/surface/division.rs"]
mod tests;
