//! Tests of `sweep::sampling::random`, a module of it.

use super::*;

#[test]
fn streams_are_even_and_differ() {
    let count = 100_000;
    for stream in 0..3 {
        let mean: f64 = (0..count).map(|k| fraction(7, stream, k)).sum::<f64>() / count as f64;
        // Five standard deviations of the mean.
        assert!((mean - 0.5).abs() < 5.0 / (12.0 * count as f64).sqrt(), "{stream}: {mean}");
    }
    let product = |k| (fraction(7, 0, k) - 0.5) * (fraction(7, 1, k) - 0.5);
    assert!(((0..count).map(product).sum::<f64>() / count as f64).abs() < 5.0 / 12.0 / (count as f64).sqrt());
    assert_ne!(bits(1, 0, 0), bits(2, 0, 0));
}

#[test]
fn a_permutation_has_every_number_once() {
    let mut order = permutation(1000, 3, 1);
    assert_ne!(order, permutation(1000, 4, 1));
    order.sort_unstable();
    assert!(order.iter().enumerate().all(|(index, number)| index == *number));
}
