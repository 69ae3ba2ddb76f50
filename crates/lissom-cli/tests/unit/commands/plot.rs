//! Tests of `commands::plot`, a module of it.

use super::*;

#[test]
fn names_are_as_long_as_they_must_be() {
    let of = |folders: &[&str]| names(&folders.iter().map(PathBuf::from).collect::<Vec<_>>());
    assert_eq!(of(&["out/coarse", "out/fine"]), ["coarse", "fine"]);
    assert_eq!(of(&["a/crank", "b/crank"]), ["a/crank", "b/crank"]);
    assert_eq!(of(&["crank", "crank"]), ["crank (1)", "crank (2)"]);
}
