//! Nodes and elements of a shell, as the model describes them.

use std::collections::{BTreeMap, BTreeSet};

use lissom_motion::Vector3;

use super::node_reference::ShellPlace;
use crate::format::suggest;

/// All nodes of a shell.
pub(crate) const ALL: &str = "all";

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
    /// Nodes of the shell called `name` that a reference means: one by `u,v` or the name of a set.
    ///
    /// # Errors
    /// What is wrong, and the remedy.
    pub fn nodes_at(&self, name: &str, place: &ShellPlace) -> Result<Vec<usize>, (String, String)> {
        match place {
            ShellPlace::Set(set) => self.sets.get(set).cloned().ok_or_else(|| {
                let known: Vec<&str> = self.sets.keys().map(String::as_str).collect();
                let message = format!("shell `{name}` has no set of nodes called `{set}`");
                (message, format!("its sets are {}", suggest::list(known)))
            }),
            ShellPlace::Fractions([u, v]) => {
                let Some(places) = &self.places else {
                    let message = format!("shell `{name}` is a mesh, which has no u and v");
                    return Err((
                        message,
                        "name a node in `sets`, as `tip = { near = [x, y, z] }`".to_owned(),
                    ));
                };
                let distance = |own: &[f64; 2]| (own[0] - u).hypot(own[1] - v);
                let found = places.iter().enumerate().min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)));
                match found {
                    Some((node, own)) if distance(own) < 1e-6 => Ok(vec![node]),
                    Some((_, own)) => Err((
                        format!("shell `{name}` has no node at {u},{v}"),
                        format!(
                            "the nearest is at {:.6},{:.6}; or choose `divisions` to suit",
                            own[0], own[1]
                        ),
                    )),
                    None => Err((format!("shell `{name}` has no node"), String::new())),
                }
            }
        }
    }

    /// The mean position of the nodes that a reference means [m].
    pub fn position_of(&self, place: &ShellPlace) -> Option<Vector3> {
        let nodes = self.nodes_at("", place).ok().filter(|nodes| !nodes.is_empty())?;
        Some(nodes.iter().map(|&node| self.positions[node]).sum::<Vector3>() / nodes.len() as f64)
    }

    /// Mean u and v of an element; the mean of the range for a mesh.
    pub fn middle(&self, element: usize) -> [f64; 2] {
        let Some(places) = &self.places else { return [0.5; 2] };
        let own = self.elements[element].map(|node| places[node]);
        [0, 1].map(|k| own.iter().map(|place| place[k]).sum::<f64>() / 4.0)
    }

    /// Share of each of these nodes in something that is spread over them: by area where they span elements, otherwise by length along edges,
    /// otherwise equal. The sum is 1.
    pub fn shares(&self, nodes: &[usize]) -> Vec<f64> {
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
        let shares = shares.unwrap_or_else(|| vec![1.0; nodes.len()]);
        let whole: f64 = shares.iter().sum();
        shares.into_iter().map(|share| share / whole).collect()
    }
}
