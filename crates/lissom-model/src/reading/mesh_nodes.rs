//! Nodes of a mesh by sets and places: those of shells and solids.

use std::sync::Arc;

use lissom_mechanics::kinematics::NodeId;
use lissom_mesh::MeshedPart;
use lissom_motion::Vector3;

use super::node_reference::{MeshPlace, NodeReference};
use crate::format::suggest;
use crate::text::report::{Located, Problem};

/// The set of all nodes.
pub(crate) const ALL: &str = "all";

/// What a part is in messages.
pub(crate) fn word(mesh: &MeshedPart) -> &'static str {
    if mesh.coordinates == 2 { "shell" } else { "solid" }
}

/// Nodes of the part called `name` that a reference means: one by `u,v` or the name of a set.
///
/// # Errors
/// What is wrong, and the remedy.
pub(crate) fn nodes_at(
    mesh: &MeshedPart,
    name: &str,
    place: &MeshPlace,
) -> Result<Vec<usize>, (String, String)> {
    let word = word(mesh);
    let wanted = match place {
        MeshPlace::Set(set) => {
            return mesh.sets.get(set).cloned().ok_or_else(|| {
                let known: Vec<&str> = mesh.sets.keys().map(String::as_str).collect();
                let message = format!("{word} `{name}` has no set of nodes called `{set}`");
                (message, format!("its sets are {}", suggest::list(known)))
            });
        }
        MeshPlace::Fractions(wanted) => wanted,
    };
    let distance = |own: &[f64]| own.iter().zip(wanted).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    let nearest = (0..mesh.positions.len())
        .filter_map(|node| mesh.place(node).map(|own| (node, own, distance(own))))
        .min_by(|a, b| a.2.total_cmp(&b.2));
    match nearest {
        None => {
            let message = format!("{word} `{name}` is a mesh, which has no u and v");
            Err((message, "name a node in `sets`, as `tip = { near = [x, y, z] }`".to_owned()))
        }
        Some((_, own, _)) if own.len() != wanted.len() => {
            let message = format!("{word} `{name}` has {} coordinates, not {}", own.len(), wanted.len());
            let example = ["0.5,1", "0.5,1,0"][own.len() - 2];
            Err((message, format!("write for example \"{name}@{example}\"")))
        }
        Some((node, _, distance)) if distance < 1e-6 => Ok(vec![node]),
        Some((_, own, _)) => {
            let place = MeshPlace::Fractions(wanted.clone()).to_string();
            let own: Vec<String> = own.iter().map(|value| format!("{value:.6}")).collect();
            let help = format!("the nearest is at {}; or choose `divisions` to suit", own.join(","));
            Err((format!("{word} `{name}` has no node at {}", place.trim_start_matches('@')), help))
        }
    }
}

/// Nodes of a reference, with faults reported where it is.
///
/// # Errors
/// What is wrong, and the remedy.
pub(crate) fn nodes_of(mesh: &MeshedPart, reference: &Located<NodeReference>) -> Result<Vec<usize>, Problem> {
    let NodeReference::Mesh { part, place } = &reference.value else { return Ok(Vec::new()) };
    nodes_at(mesh, part, place).map_err(|(message, help)| {
        Problem::error(reference.span, message).label("nothing can be attached here").help(help)
    })
}

/// The mean position of the nodes that a reference means [m].
pub(crate) fn position_of(mesh: &MeshedPart, place: &MeshPlace) -> Option<Vector3> {
    let nodes = nodes_at(mesh, "", place).ok().filter(|nodes| !nodes.is_empty())?;
    Some(nodes.iter().map(|&node| mesh.positions[node]).sum::<Vector3>() / nodes.len() as f64)
}

/// Nodes of a shell or solid as built.
#[derive(Clone)]
pub struct BuiltNodes {
    /// As the model describes them.
    pub mesh: Arc<MeshedPart>,
    /// Corresponding nodes of the system.
    pub nodes: Vec<NodeId>,
}

impl BuiltNodes {
    /// Indices of the nodes that a reference to the part means.
    pub(crate) fn indices(&self, reference: &Located<NodeReference>) -> Result<Vec<usize>, Problem> {
        nodes_of(&self.mesh, reference)
    }

    /// The only node that a reference to the part means.
    pub(crate) fn one(&self, reference: &Located<NodeReference>) -> Result<NodeId, Problem> {
        self.one_index(reference).map(|index| self.nodes[index])
    }

    /// Index of the only node that a reference means.
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
    pub(crate) fn middle(&self, place: &MeshPlace) -> Option<NodeId> {
        let indices = nodes_at(&self.mesh, "", place).ok()?;
        let mean = position_of(&self.mesh, place)?;
        let distance = |index: usize| (self.mesh.positions[index] - mean).norm();
        let nearest = indices.into_iter().min_by(|&a, &b| distance(a).total_cmp(&distance(b)))?;
        Some(self.nodes[nearest])
    }

    /// The only node at a place; none for several.
    pub fn node_at(&self, place: &MeshPlace) -> Option<NodeId> {
        match nodes_at(&self.mesh, "", place).ok()?[..] {
            [index] => Some(self.nodes[index]),
            _ => None,
        }
    }
}
