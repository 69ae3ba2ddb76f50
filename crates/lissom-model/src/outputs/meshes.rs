//! Shells and solids as built: parts whose nodes are named by places and sets.

use std::collections::BTreeMap;

use super::shell_nodes::BuiltShell;
use super::solid_nodes::BuiltSolid;
use crate::reading::mesh_nodes::BuiltNodes;

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
    pub fn nodes_of(&self, name: &str) -> Option<BuiltNodes<'_>> {
        let of_solid = || self.solids.get(name).map(BuiltSolid::nodes);
        self.shells.get(name).map(BuiltShell::nodes).or_else(of_solid)
    }

    /// Those of all shells and solids, with their names.
    pub fn all(&self) -> impl Iterator<Item = (&str, BuiltNodes<'_>)> {
        let shells = self.shells.iter().map(|(name, own)| (name.as_str(), own.nodes()));
        shells.chain(self.solids.iter().map(|(name, own)| (name.as_str(), own.nodes())))
    }
}
