//! Tests of `files::library`, a module of it.

use super::*;

#[test]
fn paths_have_one_name() {
    assert_eq!(joined("", "leg.toml"), "leg.toml");
    assert_eq!(joined("parts/arm.toml", "./leg.toml"), "parts/leg.toml");
    assert_eq!(joined("parts/arm.toml", "../leg.toml"), "leg.toml");
    assert_eq!(joined("arm.toml", "../../leg.toml"), "../../leg.toml");
    assert_eq!(joined("parts/arm.toml", "/a/b/../leg.toml"), "/a/leg.toml");
}
