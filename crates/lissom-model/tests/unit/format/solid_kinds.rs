//! Tests of `format::solid_kinds`, a module of it.

use super::*;

/// Every key of a solid belongs to a kind, except the short forms that name kind and dimensions at once.
#[test]
fn all_keys_belong_to_kinds() {
    let short = ["kind", "box", "cylinder", "tube", "sphere"];
    for key in Shape::drawn_keys().iter().filter(|key| !short.contains(&key.name)) {
        let is_known = SOLID_KINDS.iter().any(|kind| kind.all_keys().iter().any(|own| own.name == key.name));
        assert!(is_known, "{}", key.name);
    }
    for kind in &SOLID_KINDS {
        assert_eq!(kind.all_keys().len(), kind.keys.len() + COMMON.len(), "{}", kind.word);
    }
}
