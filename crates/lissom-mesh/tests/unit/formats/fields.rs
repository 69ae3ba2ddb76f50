//! Tests of `fields`, a module of it.

use super::*;

#[test]
fn numbers_are_finite_and_labels_positive() {
    assert_eq!(real(1, "1.5D-3"), Ok(1.5e-3));
    for bad in ["", "nan", "inf", "1e999", "x", "1,5"] {
        assert!(real(1, bad).is_err(), "{bad}");
    }
    assert_eq!(label(1, "9007199254740992"), Ok(LARGEST_LABEL));
    for bad in ["0", "-1", "9007199254740993", "1.0", "99999999999999999999999"] {
        assert!(label(1, bad).is_err(), "{bad}");
    }
}

#[test]
fn long_texts_are_quoted_in_part() {
    assert_eq!(quote("a b"), "`a b`");
    assert_eq!(quote(&"ä".repeat(1000)).chars().count(), 63);
}
