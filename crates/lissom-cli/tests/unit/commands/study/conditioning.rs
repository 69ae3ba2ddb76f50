//! Tests of `commands::study::conditioning`, a module of it.

use super::*;

#[test]
fn variations_are_read() {
    let (path, values) = parse_variation(" point_masses.bob.mass = 1, 1e2").unwrap();
    assert_eq!((path.as_str(), values.len(), values[1].as_str()), ("point_masses.bob.mass", 2, "1e2"));
    for wrong in ["mass", "=1", "mass=", "mass=1,,2"] {
        assert!(parse_variation(wrong).is_err(), "{wrong}");
    }
}
