//! Tests of `elements::coordinate_dynamics`, a module of it.

use super::*;

#[test]
fn negative_eigenvalues_are_recognised_whatever_the_units() {
    let matrix = |values: [f64; 4]| DMatrix::from_row_slice(2, 2, &values);
    for values in [[1.0, 0.0, 0.0, 0.0], [0.0; 4], [1.0, 1.0, 1.0, 1.0], [1e-9, 0.9, 0.9, 1e9]] {
        assert!(!is_indefinite(&matrix(values)), "{values:?}");
    }
    for values in [[0.0, 1.0, 1.0, 0.0], [1.0, 0.0, 0.0, -1e-3], [1e-9, 1.1, 1.1, 1e9], [-1.0, 0.0, 0.0, 0.0]]
    {
        assert!(is_indefinite(&matrix(values)), "{values:?}");
    }
}
