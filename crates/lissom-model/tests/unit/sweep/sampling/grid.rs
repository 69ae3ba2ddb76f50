//! Tests of `sweep::sampling::grid`, a module of it.

use super::*;

#[test]
fn all_combinations_come_once() {
    assert_eq!(indices(&[2, 3]).unwrap(), [0, 0, 0, 1, 0, 2, 1, 0, 1, 1, 1, 2]);
    assert!(indices(&[100_000, 100_000, 100_000, 100_000, 100_000]).is_err());
}
