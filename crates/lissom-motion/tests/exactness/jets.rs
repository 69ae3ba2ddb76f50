//! Numbers with their derivatives in time.

use lissom_motion::{Jet, Real};

#[test]
fn derivatives_are_those_of_known_functions() {
    // t and 1 + t² at t = 2.
    let t = Jet { value: 2.0, first: 1.0, second: 0.0 };
    let square = t.like(1.0).plus_product(t, t);
    assert_eq!((square.value, square.first, square.second), (5.0, 4.0, 2.0));
    // t/(1 + t²): first (1 - t²)/(1 + t²)², second 2 t (t² - 3)/(1 + t²)³.
    let ratio = t / square;
    for (found, wanted) in [(ratio.value, 0.4), (ratio.first, -3.0 / 25.0), (ratio.second, 4.0 / 125.0)] {
        assert!((found - wanted).abs() < 1e-15, "{found} instead of {wanted}");
    }
    // √(1 + t²): first t/√, second 1/√³.
    let root = square.square_root();
    let length = 5.0_f64.sqrt();
    for (found, wanted) in
        [(root.value, length), (root.first, 2.0 / length), (root.second, 1.0 / (5.0 * length))]
    {
        assert!((found - wanted).abs() < 1e-15, "{found} instead of {wanted}");
    }
    let difference = (-t).minus_product(t, t) - t.scaled(3.0);
    assert_eq!((difference.value, difference.first, difference.second), (-12.0, -8.0, -2.0));
    assert!(t.all_below(2.5) && !t.all_below(2.0));
}
