//! Tests of `sweep::sampling::list`, a module of it.

use super::*;

#[test]
fn members_take_values_side_by_side() {
    assert_eq!(indices(&[2, 2, 2]).unwrap(), [0, 0, 0, 1, 1, 1]);
    assert!(indices(&[2, 3]).unwrap_err().contains("2 for one path and 3"));
}
