//! Tests of `files::matrix_market`, a module of it.

use super::*;

#[test]
fn entries_are_counted_from_one_and_zeros_left_out() {
    let text = sparse_matrix("mass", [2, 3], [(0, 0, 1.5), (1, 1, 0.0), (1, 2, -2e-30)].into_iter());
    assert_eq!(text, "%%MatrixMarket matrix coordinate real general\n% mass\n2 3 2\n1 1 1.5\n2 3 -2e-30\n");
}

#[test]
fn full_matrices_go_column_by_column() {
    let text = full_matrix("A", [2, 2], |row, column| (10 * row + column) as f64);
    assert_eq!(text, "%%MatrixMarket matrix array real general\n% A\n2 2\n0.0\n10.0\n1.0\n11.0\n");
}
