//! Tests of `sweep::sampling::sobol`, a module of it.

use super::*;

/// The first points as other programs print them.
#[test]
fn the_first_points_are_known() {
    let first =
        |dimension| points(dimension, 8).map(|point| f64::from(point) / 2.0_f64.powi(32)).collect::<Vec<_>>();
    assert_eq!(first(0), [0.0, 0.5, 0.75, 0.25, 0.375, 0.875, 0.625, 0.125]);
    assert_eq!(first(1), [0.0, 0.5, 0.25, 0.75, 0.375, 0.875, 0.125, 0.625]);
    assert_eq!(first(2), [0.0, 0.5, 0.25, 0.75, 0.625, 0.125, 0.875, 0.375]);
}

#[test]
fn every_dimension_has_one_point_in_each_part() {
    for dimension in 0..=POLYNOMIALS.len() {
        let mut parts: Vec<u32> = points(dimension, 256).map(|point| point >> 24).collect();
        parts.sort_unstable();
        assert!(parts.iter().enumerate().all(|(index, part)| index == *part as usize), "{dimension}");
    }
}

/// Mean of a product over all dimensions: exact to a few 1e-3 for 4096 points of a good sequence, where
/// independent draws would miss by ten times that.
#[test]
fn dimensions_do_not_repeat_each_other() {
    let (paths, members) = (21, 4096);
    let all = fractions(paths, members, 3).unwrap();
    for a in 0..paths {
        for b in 0..a {
            let product = |member| (all[member * paths + a] - 0.5) * (all[member * paths + b] - 0.5);
            let mean = (0..members).map(product).sum::<f64>() / members as f64;
            assert!(mean.abs() < 1e-3, "{a}, {b}: {mean}");
        }
    }
    assert!(fractions(22, 4, 0).unwrap_err().contains("21"));
}
