//! Tests of `scene::path_values`, a module of it.

use super::*;

#[test]
fn values_are_straight_between_equilibria() {
    let mut path = PathValues::new("load factor");
    assert_eq!(path.at(1.0), 0.0);
    for (length, value) in [(0.0, 0.0), (1.0, 4.0), (3.0, -2.0)] {
        path.push(length, value);
    }
    let found = [-1.0, 0.0, 0.5, 1.0, 2.0, 3.0, 9.0].map(|length| path.at(length));
    assert_eq!(found, [0.0, 0.0, 2.0, 4.0, 1.0, -2.0, -2.0]);
}
