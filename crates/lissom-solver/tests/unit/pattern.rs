//! Tests of `pattern`, a module of it.

use super::*;

#[test]
fn cliques_and_entries_agree() {
    let cliques: [&[usize]; 3] = [&[0, 1, 4], &[4, 2], &[4, 1]];
    let by_cliques = Pattern::from_cliques(6, cliques);
    let pairs = cliques.iter().flat_map(|clique| {
        clique.iter().flat_map(move |&row| clique.iter().map(move |&column| (row, column)))
    });
    assert_eq!(by_cliques, Pattern::from_entries(6, pairs));
    assert_eq!(by_cliques.column(4), [0, 1, 2, 4]);
    assert_eq!(by_cliques.column(3), [3]);
    assert_eq!(by_cliques.position(1, 4), Some(by_cliques.column_starts()[4] + 1));
    assert_eq!(by_cliques.position(0, 2), None);
    assert_eq!(by_cliques.position(0, 9), None);
}

#[test]
fn empty_cliques_between_others_change_nothing() {
    let with: [&[usize]; 4] = [&[], &[0, 1], &[], &[1, 2]];
    let without: [&[usize]; 2] = [&[0, 1], &[1, 2]];
    assert_eq!(Pattern::from_cliques(3, with), Pattern::from_cliques(3, without));
}
