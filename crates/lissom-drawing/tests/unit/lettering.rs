//! Tests of `lettering`, a module of it.

use super::*;

#[test]
fn letters_have_outlines_and_widths() {
    assert!(FACE.is_some());
    assert!((width("m", 100.0) - 97.4).abs() < 1.0, "{}", width("m", 100.0));
    assert!((width("ii", 10.0) - 2.0 * width("i", 10.0)).abs() < 1e-9);
    assert!(outlines(" ", 10.0).is_none());
    let bounds = outlines("H", 100.0).unwrap().bounds();
    assert!((bounds.height() - 72.9).abs() < 1.0, "{bounds:?}");
    for letter in "µΩαωäß²·−–°".chars() {
        assert!(FACE.as_ref().unwrap().glyph_index(letter).is_some(), "{letter}");
    }
}
