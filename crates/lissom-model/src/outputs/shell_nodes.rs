//! Shells as built: their meshes, nodes and elements.

use std::sync::Arc;

use lissom_mechanics::elements::shell::section::Ply;
use lissom_mechanics::elements::shell::surface::ShellSurface;
use lissom_mechanics::kinematics::NodeId;

use crate::reading::node_reference::{NodeReference, ShellPlace};
use crate::reading::shell_mesh::ShellMesh;
use crate::text::report::{Located, Problem};

/// A shell as built.
#[derive(Clone)]
pub struct BuiltShell {
    /// As the model describes it.
    pub mesh: Arc<ShellMesh>,
    /// Its nodes and elements.
    pub surface: ShellSurface,
    /// Layers of each element; one for all if they are the same.
    pub(crate) plies: Vec<Arc<[Ply]>>,
    /// Place of the middle of its thickness along the normal [m].
    pub(crate) offset: f64,
}

impl BuiltShell {
    /// Indices of the nodes that a reference to the shell means.
    pub(crate) fn indices(&self, reference: &Located<NodeReference>) -> Result<Vec<usize>, Problem> {
        let NodeReference::Shell { shell, place } = &reference.value else { return Ok(Vec::new()) };
        self.mesh.nodes_at(shell, place).map_err(|(message, help)| {
            Problem::error(reference.span, message).label("nothing can be attached here").help(help)
        })
    }

    /// Layers of an element.
    pub(crate) fn plies_of(&self, element: usize) -> Arc<[Ply]> {
        Arc::clone(self.plies.get(element).unwrap_or(&self.plies[0]))
    }

    /// The only node that a reference to the shell means.
    pub(crate) fn one(&self, reference: &Located<NodeReference>) -> Result<NodeId, Problem> {
        self.one_index(reference).map(|index| self.surface.nodes[index])
    }

    /// Its index.
    pub(crate) fn one_index(&self, reference: &Located<NodeReference>) -> Result<usize, Problem> {
        match self.indices(reference)?[..] {
            [index] => Ok(index),
            ref several => {
                let message = format!("this names {} nodes, and one is needed", several.len());
                let help = "name one by u and v, as \"panel@0.5,1\", or by a set of one node: `{ near = [x, y, z] }`";
                Err(Problem::error(reference.span, message).label("several nodes").help(help))
            }
        }
    }

    /// The node nearest to the mean of those at a place.
    pub(crate) fn middle(&self, place: &ShellPlace) -> Option<NodeId> {
        let indices = self.mesh.nodes_at("", place).ok()?;
        let mean = self.mesh.position_of(place)?;
        let distance = |index: usize| (self.mesh.positions[index] - mean).norm();
        let nearest = indices.into_iter().min_by(|&a, &b| distance(a).total_cmp(&distance(b)))?;
        Some(self.surface.nodes[nearest])
    }

    /// The only node of a set.
    pub fn node_of_set(&self, set: &str) -> Option<NodeId> {
        self.node_at(&ShellPlace::Set(set.to_owned()))
    }

    /// The only node at a place; none for several.
    pub fn node_at(&self, place: &ShellPlace) -> Option<NodeId> {
        match self.mesh.nodes_at("", place).ok()?[..] {
            [index] => Some(self.surface.nodes[index]),
            _ => None,
        }
    }
}
