//! Tests of `format::suggest`, a module of it.

use super::*;

#[test]
fn slips_are_found_and_strangers_are_not() {
    let known = ["aluminium", "steel", "E"];
    assert_eq!(nearest("aluminum", known), Some("aluminium"));
    assert_eq!(nearest("Steel", known), Some("steel"));
    assert_eq!(nearest("setel", known), Some("steel"));
    assert_eq!(nearest("copper", known), None);
    assert_eq!(nearest("q", known), None);
    assert_eq!(nearest("e", known), Some("E"));
    assert_eq!(nearest("sinn", ["sign", "sin"]), Some("sin"));
    assert_eq!(nearest("", known), None);
}

#[test]
fn lists_read_as_english() {
    assert_eq!(list(["a"]), "`a`");
    assert_eq!(list(["a", "b", "c"]), "`a`, `b` and `c`");
    assert_eq!(help("copper", ["steel"]).as_deref(), Some("known here: `steel`"));
}
