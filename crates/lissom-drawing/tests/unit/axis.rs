//! Tests of `axis`, a module of it.

use super::*;

fn words(axis: &Axis, range: [f64; 2], most: usize) -> Vec<String> {
    axis.ticks(range, most).into_iter().map(|(_, text)| text).collect()
}

#[test]
fn ticks_are_round_numbers_with_the_digits_they_need() {
    let axis = Axis::new("");
    assert_eq!(
        words(&axis, [0.0, 0.4], 5),
        ["0.0", "0.1", "0.2", "0.3", "0.4"].map(|t| if t == "0.0" { "0" } else { t })
    );
    assert_eq!(words(&axis, [-1.1, 1.1], 5), ["-1.0", "-0.5", "0", "0.5", "1.0"]);
    assert_eq!(words(&axis, [0.0, 2.5e6], 5), ["0", "5e5", "1.0e6", "1.5e6", "2.0e6", "2.5e6"]);
    assert_eq!(words(&axis, [99.9, 100.1], 4), ["99.90", "99.95", "100.00", "100.05", "100.10"]);
    assert_eq!(words(&axis, [0.0, 3e-7], 3), ["0", "1e-7", "2e-7", "3e-7"]);
    for range in [[-1e300, 1e300], [1e-300, 2e-300], [-1e-12, 1.0], [f64::MIN, f64::MAX]] {
        let ticks = axis.ticks(range, 6);
        assert!(ticks.len() < 9 && ticks.iter().all(|tick| tick.0.is_finite()), "{ticks:?}");
    }
}

#[test]
fn decades_are_thinned_out_or_divided() {
    let axis = Axis::logarithmic("");
    assert_eq!(words(&axis, [1e-2, 1e2], 6), ["0.01", "0.1", "1", "10", "100"]);
    assert_eq!(words(&axis, [1.0, 10.0], 6), ["1", "2", "5", "10"]);
    let ticks = words(&axis, [1e-20, 1e20], 6);
    assert!(ticks.len() <= 7 && ticks.contains(&"1".to_owned()), "{ticks:?}");
}

#[test]
fn constants_and_given_ranges_have_an_extent() {
    let axis = Axis::new("");
    assert_eq!(axis.extent([0.0, 0.0].into_iter(), 0.05), [-1.0, 1.0]);
    assert_eq!(axis.extent([-20.0].into_iter(), 0.05), [-22.0, -18.0]);
    let noise = axis.extent([5.0, 5.0 + 4e-10].into_iter(), 0.05);
    assert!(noise[0] < 4.6 && noise[1] > 5.4, "round-off of a constant is not enlarged: {noise:?}");
    assert!(axis.extent([5.0, 5.0 + 1e-8].into_iter(), 0.05)[1] < 5.0 + 2e-8);
    assert_eq!(axis.extent([0.0, 10.0].into_iter(), 0.05), [-0.5, 10.5]);
    assert_eq!(Axis { range: Some([1.0, 2.0]), ..axis }.extent([0.0].into_iter(), 0.05), [1.0, 2.0]);
    let decades = Axis::logarithmic("").extent([2.0, 300.0].into_iter(), 0.05);
    assert!((decades[0] - 1.0).abs() < 1e-12 && (decades[1] - 1000.0).abs() < 1e-9, "{decades:?}");
}
