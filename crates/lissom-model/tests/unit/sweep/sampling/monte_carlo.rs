//! Tests of `sweep::sampling::monte_carlo`, a module of it.

use super::*;

#[test]
fn more_members_leave_the_first_ones() {
    let few = fractions(3, 10, 5).unwrap();
    assert_eq!(fractions(3, 20, 5).unwrap()[..30], few);
    assert_ne!(fractions(3, 10, 6).unwrap(), few);
}
