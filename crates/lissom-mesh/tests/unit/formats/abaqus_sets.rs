//! Tests of `abaqus_sets`, a module of it.

use super::*;

fn resolve(lists: &Lists) -> Result<Resolved, MeshError> {
    let indices = (0..10).map(|index| (10 * (index as u64 + 1), index)).collect();
    lists.resolve("nodes", &indices, &Mesh::default(), &Lists::default())
}

#[test]
fn sets_are_generated_extended_and_combined() {
    let mut lists = Lists::default();
    lists.add_range(1, "Even", &["20", "85", "20"]).expect("valid");
    lists.add_line(2, "EVEN", &["10"]).expect("valid");
    lists.add_line(3, "both", &["even", "70", "70", "71"]).expect("valid");
    lists.add_range(4, "all", &["1", "999999999999"]).expect("valid");
    let (sets, notes) = resolve(&lists).expect("valid");
    assert_eq!(sets["Even"], [0, 1, 3, 5, 7]);
    assert_eq!(sets["both"], [0, 1, 3, 5, 6, 7]);
    assert_eq!(sets["all"].len(), 10);
    assert_eq!(sets.len(), 3);
    let note = "line 3: number 71 of the set of nodes `both` is not in the mesh and is left out";
    assert_eq!(notes, [note]);
}

#[test]
fn sets_that_name_a_large_one_again_and_again_cost_nothing() {
    let count = 100_000;
    let mut lists = Lists::default();
    lists.add_range(1, "whole", &["1", "100000"]).expect("valid");
    for line in 0..20_000 {
        lists.add_line(line, "again", &["whole"]).expect("valid");
    }
    lists.add_line(20_000, "whole", &["100001"]).expect("valid");
    lists.add_line(20_001, "again", &["whole"]).expect("valid");
    let indices: HashMap<u64, usize> = (0..=count).map(|index| (index as u64 + 1, index)).collect();
    let (sets, _) = lists.resolve("nodes", &indices, &Mesh::default(), &Lists::default()).expect("valid");
    assert_eq!(sets["again"].len(), count + 1, "a set that has grown is included again");
    for line in 0..300 {
        lists.add_line(line, &format!("copy {line}"), &["whole"]).expect("valid");
    }
    let error = lists.resolve("nodes", &indices, &Mesh::default(), &Lists::default()).unwrap_err();
    assert!(error.to_string().contains("more than 200 times members"), "{error}");
}

#[test]
fn lists_that_cannot_be_resolved_are_rejected() {
    let mut lists = Lists::default();
    lists.add_line(5, "a", &["b"]).expect("valid");
    let error = resolve(&lists).expect_err("no set b").to_string();
    assert!(error.starts_with("line 5: no set of nodes `b`"), "{error}");
    assert!(lists.add_range(6, "a", &["1", "2", "0"]).is_err());
    assert!(lists.add_range(6, "a", &["1", "2", "1", "1"]).is_err());
    assert!(lists.add_line(6, "a", &["-1"]).is_err());
}
