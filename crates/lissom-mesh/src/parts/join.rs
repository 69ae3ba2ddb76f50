//! Nodes at the same position.

use lissom_motion::Vector3;

use crate::parts::meshed_part::MeshedPart;

/// Relative distance of nodes that count as one.
const SAME: f64 = 1e-9;
/// Least product of unit normals of nodes that lie on one smooth surface.
const SMOOTH: f64 = 0.999;

/// Nodes at the same position as one: which are kept, and the new number of each.
fn coincident(positions: &[Vector3]) -> (Vec<usize>, Vec<usize>) {
    let size = positions.iter().fold(0.0_f64, |most, position| most.max(position.amax()));
    let near = SAME * size;
    let mut order: Vec<usize> = (0..positions.len()).collect();
    // Along no axis of a regular mesh, where many nodes would have one place.
    let along: Vec<f64> = positions.iter().map(|at| at.dot(&Vector3::new(0.571, 0.618, 0.539))).collect();
    order.sort_by(|&a, &b| along[a].total_cmp(&along[b]));
    let mut first: Vec<usize> = (0..positions.len()).collect();
    for (k, &node) in order.iter().enumerate() {
        for &other in &order[k + 1..] {
            let apart = positions[other] - positions[node];
            if along[other] - along[node] > near {
                break;
            }
            if apart.norm() <= near {
                let kept = first[node].min(first[other]);
                (first[node], first[other]) = (kept, kept);
            }
        }
    }
    let kept: Vec<usize> = (0..first.len()).filter(|&node| first[node] == node).collect();
    let mut renumbered = vec![0; first.len()];
    kept.iter().enumerate().for_each(|(new, &old)| renumbered[old] = new);
    (kept, first.iter().map(|&node| renumbered[node]).collect())
}

fn of<T: Copy>(all: &[T], kept: &[usize]) -> Vec<T> {
    kept.iter().map(|&node| all[node]).collect()
}

impl MeshedPart {
    /// The first node at whose position there is another one.
    pub fn repeated_position(&self) -> Option<usize> {
        let (kept, numbers) = coincident(&self.positions);
        (0..numbers.len()).find(|&node| kept[numbers[node]] != node)
    }

    /// Makes nodes at the same position one.
    pub fn join(&mut self) {
        let (kept, numbers) = coincident(&self.positions);
        if kept.len() == self.positions.len() {
            return;
        }
        let first = |node: usize| kept[numbers[node]];
        // Along a fold the normals of the two sides differ: then they are those of the elements.
        let is_smooth = |normals: &Vec<Vector3>| {
            (0..numbers.len()).all(|node| normals[node].dot(&normals[first(node)]) >= SMOOTH)
        };
        self.normals = self.normals.take().filter(is_smooth);
        let nodes = self.elements.iter_mut().map(|own| &mut own.nodes);
        nodes.chain(&mut self.faces).flatten().for_each(|node| *node = numbers[*node]);
        for set in self.sets.values_mut() {
            for node in set.iter_mut() {
                *node = numbers[*node];
            }
            set.sort_unstable();
            set.dedup();
        }
        self.positions = of(&self.positions, &kept);
        self.places = self.places.as_ref().map(|places| of(places, &kept));
        self.normals = self.normals.as_ref().map(|normals| of(normals, &kept));
        if !self.faces.is_empty() {
            self.find_faces();
        }
    }
}
