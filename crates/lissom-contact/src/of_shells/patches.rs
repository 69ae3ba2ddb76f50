//! The elements of a shell as parts of one surface that solids touch.

use std::collections::BTreeMap;
use std::sync::Arc;

use lissom_motion::{Rotation, Vector3};

use super::touch::{Overlap, Overlaps};
use lissom_flexible::shell::Shell;
use lissom_flexible::shell::quadrilateral::{EDGES, NODES};
use lissom_mechanics::elements::InitialModel;
use lissom_mechanics::kinematics::NodeId;

/// Overlap of two elements over the size of the smaller one.
const OVERLAP: f64 = 0.02;

/// An element of a shell with what its contact depends on.
#[derive(Clone, Debug)]
pub struct ContactPatch {
    pub(super) nodes: [NodeId; NODES],
    /// In the axes of the nodes.
    pub(super) directors: [Vector3; NODES],
    /// Initial rotation of the first node.
    pub(super) rotation: Rotation,
    pub(super) overlaps: Overlaps,
}

/// All elements of a surface. Those at both sides of an edge are neighbours if they have the same directors there: not at a fold.
pub fn contact_patches(model: &InitialModel, surface: &[Arc<Shell>]) -> Vec<ContactPatch> {
    let frame = |node: NodeId| model.frame(node);
    let director = |own: &Shell, i: usize| frame(own.nodes()[i]).rotation.apply(&own.director(i));
    // From the middle of an edge to the middle of the opposite one.
    let size = |own: &Shell, edge: usize| {
        let middle = |k: usize| -> Vector3 {
            let (i, j) = EDGES[k];
            0.5 * (frame(own.nodes()[i]).position + frame(own.nodes()[j]).position)
        };
        (middle(edge) - middle(edge ^ 1)).norm()
    };
    let mut sides: BTreeMap<[usize; 2], Vec<(usize, usize)>> = BTreeMap::new();
    for (index, own) in surface.iter().enumerate() {
        for (edge, (i, j)) in EDGES.into_iter().enumerate() {
            let [a, b] = [i, j].map(|k| own.nodes()[k].index());
            sides.entry([a.min(b), a.max(b)]).or_default().push((index, edge));
        }
    }
    let mut overlaps: Vec<Overlaps> = vec![[[None; 2]; 2]; surface.len()];
    for both in sides.values() {
        let &[(one, edge), (other, opposite)] = both.as_slice() else { continue };
        let elements = [&surface[one], &surface[other]];
        let is_smooth = [EDGES[edge].0, EDGES[edge].1].into_iter().all(|i| {
            let j = elements[1].nodes().iter().position(|node| *node == elements[0].nodes()[i]);
            j.is_some_and(|j| (director(elements[0], i) - director(elements[1], j)).norm() < 1e-9)
        });
        if is_smooth {
            let sizes = [size(elements[0], edge), size(elements[1], opposite)];
            let width = OVERLAP * sizes[0].min(sizes[1]);
            // Edges 0 and 1 are at s = -1 and 1, edges 2 and 3 at r = -1 and 1.
            let sides = [(one, edge, sizes[0], true), (other, opposite, sizes[1], false)];
            for (element, edge, size, has_edge) in sides {
                let overlap = Overlap { width: width / size, has_edge };
                overlaps[element][1 - edge / 2][edge % 2] = Some(overlap);
            }
        }
    }
    let patch = |(own, overlaps): (&Arc<Shell>, Overlaps)| ContactPatch {
        nodes: *own.nodes(),
        directors: std::array::from_fn(|i| own.director(i)),
        rotation: frame(own.nodes()[0]).rotation,
        overlaps,
    };
    surface.iter().zip(overlaps).map(patch).collect()
}
