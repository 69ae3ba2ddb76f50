//! A mesh while its file is read: elements may refer to nodes that follow later.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use crate::error::MeshError;
use crate::mesh::{Mesh, MeshElement, MeshShape};

#[derive(Default)]
pub(crate) struct Draft {
    pub(crate) mesh: Mesh,
    /// Index of each number of a node.
    pub(crate) nodes: HashMap<u64, usize>,
    /// Index of each number of an element.
    pub(crate) elements: HashMap<u64, usize>,
    /// Line and numbers of the nodes of each element.
    connections: Vec<(usize, Vec<u64>)>,
}

impl Draft {
    /// Adds a node, and returns its index. The same node twice is one.
    pub(crate) fn add_node(
        &mut self,
        line: usize,
        number: u64,
        position: [f64; 3],
    ) -> Result<usize, MeshError> {
        match self.nodes.entry(number) {
            Entry::Vacant(entry) => {
                entry.insert(self.mesh.positions.len());
                self.mesh.positions.push(position);
                self.mesh.node_numbers.push(number);
                Ok(self.mesh.positions.len() - 1)
            }
            Entry::Occupied(entry) if self.mesh.positions[*entry.get()] == position => Ok(*entry.get()),
            Entry::Occupied(_) => Err(MeshError::at(
                line,
                format!("node {number} is there twice, at different positions"),
                "give every node a number of its own",
            )),
        }
    }

    /// Adds an element, and returns its index. The same element twice is one.
    pub(crate) fn add_element(
        &mut self,
        line: usize,
        number: u64,
        shape: MeshShape,
        nodes: Vec<u64>,
    ) -> Result<usize, MeshError> {
        match self.elements.entry(number) {
            Entry::Vacant(entry) => {
                let index = self.connections.len();
                entry.insert(index);
                self.mesh.elements.push(MeshElement { number, shape, nodes: Vec::new() });
                self.connections.push((line, nodes));
                Ok(index)
            }
            Entry::Occupied(entry) => {
                let index = *entry.get();
                let (first, ref known) = self.connections[index];
                if self.mesh.elements[index].shape == shape && *known == nodes {
                    return Ok(index);
                }
                Err(MeshError::at(
                    line,
                    format!("element {number} is there twice, with other nodes in line {first}"),
                    "give every element a number of its own",
                ))
            }
        }
    }

    /// Index of a node.
    pub(crate) fn node(&self, line: usize, number: u64) -> Result<usize, MeshError> {
        self.nodes.get(&number).copied().ok_or_else(|| {
            MeshError::at(
                line,
                format!("node {number} is not in the file"),
                "export the nodes together with the elements",
            )
        })
    }

    /// Gives all elements the indices of their nodes, when all nodes are known. The last line of the file is for messages.
    pub(crate) fn connect(&mut self, last_line: usize) -> Result<(), MeshError> {
        if self.connections.is_empty() {
            let remedy = "export the mesh, not only the geometry";
            return Err(MeshError::at(last_line, "the file ends without any element", remedy));
        }
        for (index, (line, numbers)) in std::mem::take(&mut self.connections).into_iter().enumerate() {
            let nodes = numbers.iter().map(|&number| self.node(line, number));
            let nodes: Result<Vec<usize>, MeshError> = nodes.collect();
            self.mesh.elements[index].nodes = nodes?;
        }
        Ok(())
    }
}

#[cfg(test)]
#[path = "../../tests/unit/formats/draft.rs"]
mod tests;
