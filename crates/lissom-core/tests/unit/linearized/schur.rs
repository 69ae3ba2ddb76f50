//! Tests of `linearized::schur`, a module of it.

use super::*;
use crate::linearized::krylov::Noise;

fn check(matrix: &DMatrix<Complex64>) {
    let (q, t) = schur(matrix.clone()).expect("converges");
    let again = &q * &t * q.adjoint();
    assert!((again - matrix).norm() <= 1e-13 * matrix.norm().max(f64::MIN_POSITIVE));
    for row in 1..t.nrows() {
        assert!((0..row).all(|column| t[(row, column)] == Complex64::default()));
    }
}

#[test]
fn full_and_nilpotent_matrices_have_a_schur_form() {
    let mut noise = Noise(3);
    let mut number = || Complex64::new(noise.number(), noise.number());
    check(&DMatrix::from_fn(30, 30, |_, _| number()));
    // Half of the eigenvalues are zero, in chains of two.
    let left = DMatrix::from_fn(24, 24, |_, _| number());
    let inverse = left.clone().try_inverse().expect("regular");
    let chains = DMatrix::from_fn(24, 24, |row, column| match (row, column) {
        (row, column) if row < 12 && column == row + 1 && row % 2 == 0 => Complex64::new(1.0, 0.0),
        (row, column) if row == column && row >= 12 => Complex64::new(row as f64, 1.0),
        _ => Complex64::default(),
    });
    check(&(left * chains * inverse));
    check(&DMatrix::zeros(5, 5));
}

#[test]
fn a_cyclic_permutation_needs_exceptional_shifts() {
    check(&DMatrix::from_fn(8, 8, |row, column| {
        if row == (column + 1) % 8 { Complex64::new(1.0, 0.0) } else { Complex64::default() }
    }));
}

#[test]
fn what_is_not_finite_has_no_schur_form() {
    assert!(schur(DMatrix::from_element(3, 3, Complex64::new(f64::NAN, 0.0))).is_none());
}
