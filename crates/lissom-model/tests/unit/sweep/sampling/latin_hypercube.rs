//! Tests of `sweep::sampling::latin_hypercube`, a module of it.

use super::*;

#[test]
fn every_part_has_one_member() {
    let (paths, members) = (3, 50);
    let all = fractions(paths, members, 11).unwrap();
    for path in 0..paths {
        let mut parts: Vec<usize> =
            (0..members).map(|member| (all[member * paths + path] * members as f64) as usize).collect();
        assert!(!parts.is_sorted(), "shuffled");
        parts.sort_unstable();
        assert!(parts.iter().enumerate().all(|(index, part)| index == *part));
    }
}
