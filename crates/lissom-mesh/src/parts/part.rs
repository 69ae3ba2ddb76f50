//! A part of a mesh: elements of a set and of some shapes, with their nodes.

use std::collections::BTreeMap;

use crate::error::MeshError;
use crate::mesh::{Mesh, MeshShape};

impl Mesh {
    /// The elements of a set, or all, of the shapes for which `keep` is true, with the nodes that they use. Sets keep
    /// their remaining members; sets without any, and sections of these, are left out.
    ///
    /// # Errors
    /// There is no set of this name, or no element of it has such a shape.
    pub fn part(
        &self,
        element_set: Option<&str>,
        keep: impl Fn(MeshShape) -> bool,
    ) -> Result<Mesh, MeshError> {
        let candidates = match element_set {
            None => (0..self.elements.len()).collect(),
            Some(name) => self.element_sets.get(name).cloned().ok_or_else(|| self.unknown_set(name))?,
        };
        let is_kept = |index: &usize| keep(self.elements[*index].shape);
        let kept: Vec<usize> = candidates.iter().copied().filter(is_kept).collect();
        if kept.is_empty() {
            let from = element_set.map_or("the mesh".to_owned(), |name| format!("the set `{name}`"));
            return Err(MeshError::Empty { from, shapes: self.shapes_of(&candidates) });
        }
        let nodes = self.nodes_of(&kept);
        let new_nodes = inverse(&nodes, self.positions.len());
        let new_elements = inverse(&kept, self.elements.len());
        let elements = kept.iter().map(|&index| {
            let mut element = self.elements[index].clone();
            element.nodes = element.nodes.iter().filter_map(|&node| new_nodes[node]).collect();
            element
        });
        let element_sets = remaining(&self.element_sets, &new_elements);
        let sections = self.sections.iter().filter(|section| element_sets.contains_key(&section.element_set));
        Ok(Mesh {
            positions: nodes.iter().map(|&node| self.positions[node]).collect(),
            node_numbers: nodes.iter().map(|&node| self.node_numbers[node]).collect(),
            elements: elements.collect(),
            node_sets: remaining(&self.node_sets, &new_nodes),
            sections: sections.cloned().collect(),
            element_sets,
            materials: self.materials.clone(),
            notes: self.notes.clone(),
        })
    }

    fn unknown_set(&self, name: &str) -> MeshError {
        const MOST: usize = 20;
        let mut names: Vec<String> =
            self.element_sets.keys().take(MOST).map(|name| format!("`{name}`")).collect();
        if self.element_sets.len() > MOST {
            names.push(format!("and {} more", self.element_sets.len() - MOST));
        }
        let known = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
        MeshError::Set { name: name.to_owned(), known }
    }

    fn shapes_of(&self, elements: &[usize]) -> String {
        let mut counts: BTreeMap<MeshShape, usize> = BTreeMap::new();
        for &index in elements {
            *counts.entry(self.elements[index].shape).or_default() += 1;
        }
        let shapes: Vec<String> = counts.iter().map(|(shape, count)| format!("{count} {shape:?}")).collect();
        if shapes.is_empty() { "none".to_owned() } else { shapes.join(", ") }
    }
}

/// Where each of `count` indices is in an ascending list.
fn inverse(kept: &[usize], count: usize) -> Vec<Option<usize>> {
    let mut result = vec![None; count];
    for (new, &old) in kept.iter().enumerate() {
        result[old] = Some(new);
    }
    result
}

/// Sets that have members left, with the new indices.
fn remaining(sets: &BTreeMap<String, Vec<usize>>, new: &[Option<usize>]) -> BTreeMap<String, Vec<usize>> {
    let renumbered = sets
        .iter()
        .map(|(name, set)| (name.clone(), set.iter().filter_map(|&old| new[old]).collect::<Vec<usize>>()));
    renumbered.filter(|(_, set)| !set.is_empty()).collect()
}

#[cfg(test)]
#[path = "../../tests/unit/parts/part.rs"]
mod tests;
