//! Shells and solids as built: parts whose nodes are named by places and sets.

use std::collections::BTreeMap;
use std::sync::Arc;

use lissom_flexible::shell::Shell;
use lissom_flexible::shell::section::Ply;
use lissom_flexible::solid::SolidElement;

use crate::reading::mesh_nodes::BuiltNodes;

/// A shell as built.
#[derive(Clone)]
pub struct BuiltShell {
    /// Nodes of the shell.
    pub nodes: BuiltNodes,
    /// Area that belongs to each node [m²].
    pub(crate) areas: Vec<f64>,
    /// Elements of the shell.
    pub elements: Vec<Arc<Shell>>,
    /// Layers of each element; one for all if they are the same.
    pub(crate) plies: Vec<Arc<[Ply]>>,
    /// Place of the middle of its thickness along the normal [m].
    pub(crate) offset: f64,
}

impl BuiltShell {
    /// Layers of an element.
    pub(crate) fn plies_of(&self, element: usize) -> Arc<[Ply]> {
        Arc::clone(self.plies.get(element).unwrap_or(&self.plies[0]))
    }
}

/// An elastic solid as built.
#[derive(Clone)]
pub struct BuiltSolid {
    /// Nodes of the solid.
    pub nodes: BuiltNodes,
    /// Elements of the solid.
    pub elements: Vec<Arc<dyn SolidElement>>,
}

/// Shells and solids by name.
#[derive(Clone, Default)]
pub struct BuiltMeshes {
    /// Nodes and elements of each shell.
    pub shells: BTreeMap<String, BuiltShell>,
    /// Nodes and elements of each solid.
    pub solids: BTreeMap<String, BuiltSolid>,
}

impl BuiltMeshes {
    /// The nodes of a shell or solid.
    pub fn nodes_of(&self, name: &str) -> Option<&BuiltNodes> {
        let of_solid = || self.solids.get(name).map(|own| &own.nodes);
        self.shells.get(name).map(|own| &own.nodes).or_else(of_solid)
    }

    /// Nodes of all shells and solids, with their names.
    pub fn all(&self) -> impl Iterator<Item = (&str, &BuiltNodes)> {
        let shells = self.shells.iter().map(|(name, own)| (name.as_str(), &own.nodes));
        shells.chain(self.solids.iter().map(|(name, own)| (name.as_str(), &own.nodes)))
    }
}
