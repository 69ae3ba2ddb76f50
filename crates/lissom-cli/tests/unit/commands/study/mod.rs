//! Tests of `commands::study`, a module of it.

use super::*;

#[test]
fn columns_are_aligned() {
    let lines =
        [vec!["h", "none"], vec!["0.01", "3e8"]].map(|line| line.iter().map(|&c| c.to_owned()).collect());
    assert_eq!(aligned(&lines, 1), "  h     none\n  0.01   3e8\n");
}

#[test]
fn tables_have_a_place() {
    let path = table_path(None, "convergence", Path::new("models/arm.toml")).ok().unwrap();
    assert_eq!(path, Path::new("out/study-convergence/arm.csv"));
    let path =
        table_path(Some(&PathBuf::from("a/b.csv")), "convergence", Path::new("arm.toml")).ok().unwrap();
    assert_eq!(path, Path::new("a/b.csv"));
}
