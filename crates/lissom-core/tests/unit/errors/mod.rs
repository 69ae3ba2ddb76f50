//! Tests of `errors`, a module of it.

use super::*;

/// Every step returns one of them: a large error is copied although nothing has failed.
#[test]
fn errors_are_small() {
    for size in [size_of::<StepError>(), size_of::<InitialError>()] {
        assert!(size < 128, "{size} bytes: give a message instead of further parts");
    }
}
