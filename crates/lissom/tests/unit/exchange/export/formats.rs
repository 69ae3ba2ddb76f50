//! Tests of `exchange::export::formats`, a module of it.

use super::*;

#[test]
fn formats_are_distinguished() {
    for (k, format) in FORMATS.iter().enumerate() {
        assert!(!format.summary.is_empty());
        for other in &FORMATS[..k] {
            assert!(format.name != other.name && format.target != other.target);
        }
    }
}
