//! Tests of `output::round_off`, a module of it.

use super::*;

/// Columns of constants over two seconds.
fn record(columns: &[(&str, &str, &str, f64)]) -> Record {
    Record {
        columns: columns
            .iter()
            .map(|(output, quantity, unit, _)| Column::new(output, "", quantity, unit))
            .collect(),
        times: vec![0.0, 2.0],
        values: columns.iter().map(|(.., value)| vec![0.0, -value]).collect(),
    }
}

#[test]
fn values_are_compared_with_their_unit_and_with_the_sizes_of_others() {
    let of = |columns: &[_]| record(columns).round_off();
    let beside = [("a", "reaction", "N", 1e3), ("b", "reaction", "N", 9e-11), ("c", "reaction", "N", 2e-10)];
    assert_eq!(of(&beside), [false, true, false]);
    // A rotation is compared with one radian, its rate with a radian from row to row, and a moment with force times length.
    let alone = [
        ("turn", "angle", "rad", 9e-11),
        ("rate", "angular velocity", "rad/s", 4e-11),
        ("force", "reaction", "N", 100.0),
        ("place", "position", "m", 2.0),
        ("moment", "reaction", "N m", 1.9e-8),
        ("speed", "velocity", "m/s", 0.9e-10),
    ];
    assert_eq!(of(&alone), [true, true, false, false, true, true]);
    let real = [
        ("turn", "angle", "rad", 2e-10),
        ("moment", "reaction", "N m", 1e-9),
        ("speed", "velocity", "m/s", 1e-12),
    ];
    assert_eq!(of(&real), [false; 3], "without forces and lengths nothing follows for moments and speeds");
    // Differences that a model defines are drawn as they are.
    let defined =
        [("error", "error", "rad", 1e-12), ("force", "reaction", "N", 1e3), ("drift", "drift", "N", 1e-9)];
    assert_eq!(of(&defined), [false; 3]);
    assert_eq!(of(&[("a", "", "", 1e9), ("b", "", "", 1e-6)]), [false; 2], "units are not known");
    assert_eq!(of(&[("nothing", "angle", "rad", f64::NAN), ("zero", "depth", "", 0.0)]), [true, true]);
}
