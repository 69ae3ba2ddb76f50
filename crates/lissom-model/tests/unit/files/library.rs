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

#[test]
fn ready_made_parts_are_texts_but_no_files() {
    let library = Library::beside(Path::new("machines/press.toml"));
    assert_eq!(joined("parts/arm.toml", "lissom:belt-drive"), "lissom:belt-drive");
    assert!(library.text("lissom:belt-drive").unwrap().contains("title = \"Belt drive\""));
    let missing = library.text("lissom:belt-driv").unwrap_err();
    assert_eq!(missing.help.as_deref(), Some("did you mean `belt-drive`?"));
    assert!(library.texts().contains_key("lissom:belt-drive") && library.files().is_empty());
}
