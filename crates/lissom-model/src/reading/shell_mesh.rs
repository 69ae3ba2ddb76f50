//! Nodes and elements of a shell, as the model describes them.

use std::collections::{BTreeMap, BTreeSet};

use lissom_motion::Vector3;

use super::mesh_nodes::NodeSets;

/// Nodes and elements of a shell.
#[derive(Clone, Debug)]
pub struct ShellMesh {
    /// Positions of the nodes [m].
    pub positions: Vec<Vector3>,
    /// u and v of each node of a patch, from 0 to 1; none for a mesh from a file.
    pub places: Option<Vec<[f64; 2]>>,
    /// Unit normals at the nodes, where they are known.
    pub normals: Option<Vec<Vector3>>,
    /// Nodes of each element, counterclockwise about the normal.
    pub elements: Vec<[usize; 4]>,
    /// Sets of nodes by name.
    pub sets: BTreeMap<String, Vec<usize>>,
}

impl ShellMesh {
    /// Mean u and v of an element; the mean of the range for a mesh.
    pub fn middle(&self, element: usize) -> [f64; 2] {
        let Some(places) = &self.places else { return [0.5; 2] };
        let own = self.elements[element].map(|node| places[node]);
        [0, 1].map(|k| own.iter().map(|place| place[k]).sum::<f64>() / 4.0)
    }
}

impl NodeSets for ShellMesh {
    fn word(&self) -> &'static str {
        "shell"
    }

    fn positions(&self) -> &[Vector3] {
        &self.positions
    }

    fn sets(&self) -> &BTreeMap<String, Vec<usize>> {
        &self.sets
    }

    fn fractions(&self, node: usize) -> Option<&[f64]> {
        self.places.as_ref().map(|places| places[node].as_slice())
    }

    /// By area where the nodes span elements, otherwise by length along edges.
    fn sizes(&self, nodes: &[usize]) -> Vec<f64> {
        let index: BTreeMap<usize, usize> = nodes.iter().enumerate().map(|(k, &node)| (node, k)).collect();
        let (mut by_area, mut by_length) = (vec![0.0; nodes.len()], vec![0.0; nodes.len()]);
        let mut edges = BTreeSet::new();
        for element in &self.elements {
            let p = element.map(|node| self.positions[node]);
            let area = 0.5 * (p[2] - p[0]).cross(&(p[3] - p[1])).norm();
            let own = element.map(|node| index.get(&node).copied());
            if own.iter().all(Option::is_some) {
                own.iter().flatten().for_each(|&k| by_area[k] += 0.25 * area);
            }
            for i in 0..4 {
                let j = (i + 1) % 4;
                let (Some(a), Some(b)) = (own[i], own[j]) else { continue };
                if edges.insert((a.min(b), a.max(b))) {
                    let length = (p[j] - p[i]).norm();
                    by_length[a] += 0.5 * length;
                    by_length[b] += 0.5 * length;
                }
            }
        }
        let shares = [by_area, by_length].into_iter().find(|own| own.iter().any(|&share| share > 0.0));
        shares.unwrap_or_else(|| vec![1.0; nodes.len()])
    }
}
