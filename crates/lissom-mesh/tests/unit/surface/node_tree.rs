//! Tests of `node_tree`, a module of it.

use super::*;

#[test]
fn nodes_near_lines_are_found() {
    // A lattice of 10 by 10 by 10, in pseudo-random order.
    let lattice = |k: usize| [k / 100, k / 10 % 10, k % 10].map(|index| index as f64);
    let positions: Vec<[f64; 3]> = (0..1000).map(|k| lattice(k * 387 % 1000)).collect();
    let tree = NodeTree::new(&positions, (0..1000).collect());
    let ends = [[0.0, 0.0, 0.0], [9.0, 9.0, 4.5]];
    let is_near = |node: usize| along(positions[node], ends).1 < 1e-9;
    let (mut found, mut visited) = (Vec::new(), 0);
    tree.near_line(ends, 1e-9, |node| {
        visited += 1;
        found.extend(is_near(node).then_some(node));
        false
    });
    found.sort_unstable();
    assert_eq!(found, (0..1000).filter(|&node| is_near(node)).collect::<Vec<_>>());
    assert_eq!(found.len(), 5);
    assert!(visited < 300, "{visited}");
}

#[test]
fn a_search_ends_when_wanted() {
    let positions = vec![[1.0; 3]; 100];
    let tree = NodeTree::new(&positions, (0..100).collect());
    let mut visited = 0;
    tree.near_line([[1.0; 3]; 2], 0.0, |_| {
        visited += 1;
        visited == 3
    });
    assert_eq!(visited, 3);
    NodeTree::new(&positions, Vec::new()).near_line([[1.0; 3]; 2], 1.0, |_| panic!("there is none"));
}
