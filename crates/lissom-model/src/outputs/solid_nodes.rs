//! Elastic solids as built: their meshes, nodes and elements.

use std::sync::Arc;

use lissom_flexible::solid::volume::SolidVolume;

use crate::reading::mesh_nodes::BuiltNodes;
use crate::reading::solid_mesh::SolidMesh;

/// An elastic solid as built.
#[derive(Clone)]
pub struct BuiltSolid {
    /// As the model describes it.
    pub mesh: Arc<SolidMesh>,
    /// Its nodes and elements.
    pub volume: SolidVolume,
}

impl BuiltSolid {
    /// Its nodes.
    pub fn nodes(&self) -> BuiltNodes<'_> {
        BuiltNodes { mesh: &*self.mesh, nodes: &self.volume.nodes }
    }
}
