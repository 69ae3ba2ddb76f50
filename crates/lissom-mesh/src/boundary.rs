//! Boundaries of a surface.

use std::collections::BTreeMap;

use crate::edges::{edges, shared};
use crate::mesh::Mesh;

impl Mesh {
    /// Edges of one triangle or quadrilateral only, as chains of nodes. The first node of a closed chain is also its
    /// last one. Chains end at nodes where more or fewer than two such edges meet. A chain has the direction of the
    /// element of its first edge, which is on its left.
    pub fn boundary(&self) -> Vec<Vec<usize>> {
        let edges = edges(self);
        let directions: Vec<[usize; 2]> =
            shared(&edges).filter(|own| own.len() == 1).map(|own| own[0].direction()).collect();
        let mut meeting: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (index, direction) in directions.iter().enumerate() {
            for &node in direction {
                meeting.entry(node).or_default().push(index);
            }
        }
        let mut is_used = vec![false; directions.len()];
        let mut chains = Vec::new();
        // From ends and crossings first; what remains is closed.
        for from_ends in [true, false] {
            for (&start, own) in meeting.iter().filter(|(_, own)| !from_ends || own.len() != 2) {
                for &first in own {
                    if !is_used[first] {
                        chains.push(chain(start, first, &directions, &meeting, &mut is_used));
                    }
                }
            }
        }
        chains
    }
}

/// The chain that begins at a node with an edge.
fn chain(
    start: usize,
    first: usize,
    directions: &[[usize; 2]],
    meeting: &BTreeMap<usize, Vec<usize>>,
    is_used: &mut [bool],
) -> Vec<usize> {
    let (mut nodes, mut next) = (vec![start], Some(first));
    let mut node = start;
    while let Some(edge) = next {
        is_used[edge] = true;
        let [from, to] = directions[edge];
        node = if from == node { to } else { from };
        nodes.push(node);
        let own = meeting.get(&node).filter(|own| own.len() == 2);
        next = own.and_then(|own| own.iter().copied().find(|&other| !is_used[other]));
    }
    if directions[first][0] != start {
        nodes.reverse();
    }
    nodes
}

#[cfg(test)]
mod tests {
    use crate::obj;

    #[test]
    fn a_plate_with_a_hole_has_two_closed_chains() {
        let vertices = (0..16).map(|k| format!("v {} {} 0\n", k % 4, k / 4));
        let corners = [1, 2, 3, 5, 7, 9, 10, 11];
        let faces = corners.map(|k| format!("f {k} {} {} {}\n", k + 1, k + 5, k + 4));
        let text: Vec<String> = vertices.chain(faces).collect();
        let chains = obj::read(&text.concat()).expect("valid").boundary();
        // Counterclockwise outside, clockwise inside.
        assert_eq!(chains, [vec![0, 1, 2, 3, 7, 11, 15, 14, 13, 12, 8, 4, 0], vec![5, 9, 10, 6, 5]]);
    }

    #[test]
    fn a_closed_surface_has_no_boundary_and_a_crossing_divides_chains() {
        let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv -1 0 0\nv 0 -1 0\n";
        let closed = obj::read(&format!("{vertices}f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")).expect("valid");
        assert!(closed.boundary().is_empty());
        // Two triangles that share a corner.
        let touching = obj::read(&format!("{vertices}f 1 2 3\nf 3 5 6\n")).expect("valid");
        assert_eq!(touching.boundary(), [vec![2, 0, 1, 2], vec![2, 4, 5, 2]]);
        // A branch: the edge of three triangles is no boundary.
        let branch = obj::read(&format!("{vertices}f 1 2 3\nf 1 2 4\nf 1 2 6\n")).expect("valid");
        assert!(branch.boundary().iter().all(|chain| chain.len() == 3 && chain[0] != chain[2]));
        assert_eq!(branch.boundary().len(), 3);
    }
}
