//! Shells as built: their meshes, nodes and elements.

use std::sync::Arc;

use lissom_flexible::shell::section::Ply;
use lissom_flexible::shell::surface::ShellSurface;

use crate::reading::mesh_nodes::BuiltNodes;
use crate::reading::shell_mesh::ShellMesh;

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
    /// Its nodes.
    pub fn nodes(&self) -> BuiltNodes<'_> {
        BuiltNodes { mesh: &*self.mesh, nodes: &self.surface.nodes }
    }

    /// Layers of an element.
    pub(crate) fn plies_of(&self, element: usize) -> Arc<[Ply]> {
        Arc::clone(self.plies.get(element).unwrap_or(&self.plies[0]))
    }
}
