//! Tests of `saddle_point`, a module of it.

use std::sync::Arc;

use num_complex::Complex64;

use super::*;

/// Two coordinates and their multipliers, all coupled.
fn structure(size: usize) -> Structure {
    let all: Vec<usize> = (0..size).collect();
    Structure::ungrouped(Arc::new(Pattern::from_cliques(size, [&all[..]])))
}

fn matrix<S: SolverOf>(structure: &Structure, values: &[f64], count: usize) -> SaddlePoint<Matrix<S>> {
    let kind = lissom_solver::kind("sparse").expect("the default solver");
    let mut matrix = Matrix::new(S::solver(kind, structure), structure);
    matrix.values = values.iter().map(|&value| S::from_real(value)).collect();
    SaddlePoint::new(matrix, count).equilibrated(structure.pattern.size())
}

/// Kept as it is, constrained twice by the same equation x - y = c, and loaded by (3, 1): x = (2, 2) + c (1, -1)/2, and the
/// remaining multiplier is what holds it.
fn repeats<S: SolverOf>() {
    let structure = structure(4);
    #[rustfmt::skip]
        let values = [
            1.0, 0.0, 1.0, 1.0,
            0.0, 1.0, -1.0, -1.0,
            1.0, -1.0, 0.0, 0.0,
            1.0, -1.0, 0.0, 0.0,
        ];
    let mut saddle = matrix::<S>(&structure, &values, 2);
    saddle.factor(&structure, 1.0).expect("one of them is omitted");
    assert!(saddle.redundant().is_some_and(|unknown| unknown >= 2));
    let mut right: Vec<S> = [3.0, 1.0, 0.2, 0.2].map(S::from_real).to_vec();
    saddle.solve(&mut right);
    let found: Vec<f64> = right.iter().map(|value| value.parts()[0]).collect();
    for (value, expected) in [(found[0], 2.1), (found[1], 1.9), (found[2] + found[3], 0.9)] {
        assert!((value - expected).abs() < 1e-14, "{value} instead of {expected}");
    }
    assert!(found[2].abs().min(found[3].abs()) < 1e-14, "the omitted equation has no multiplier: {found:?}");
}

#[test]
fn one_of_two_repeated_constraints_carries_the_force() {
    repeats::<f64>();
    repeats::<Complex64>();
}

#[test]
fn a_coordinate_without_a_pivot_of_its_own_is_solved_by_exchanges_of_rows() {
    let structure = structure(2);
    let values = [0.0, 1.0, 1.0, 0.0];
    let mut saddle = matrix::<f64>(&structure, &values, 2);
    assert!(matches!(saddle.factor(&structure, 1.0), Err(FactorError::ZeroPivot { .. })));
    let mut saddle = matrix::<f64>(&structure, &values, 2).falling_back(&lissom_solver::KINDS[0]);
    saddle.factor(&structure, 1.0).expect("exchanges of rows help");
    assert!(saddle.fell_back().is_some() && saddle.redundant().is_none());
    let mut right = [3.0, 5.0];
    saddle.solve(&mut right);
    assert!((right[0] - 5.0).abs() < 1e-14 && (right[1] - 3.0).abs() < 1e-14, "{right:?}");
}

/// A mass that a constraint couples to a coordinate which has hardly any weight, and another one prescribes.
#[test]
fn a_pivot_lost_to_round_off_is_no_redundancy() {
    let structure = structure(4);
    #[rustfmt::skip]
    let values = [
        1.0, 0.0, 1.0, 0.0,
        0.0, 1e-13, -1.0, 1.0,
        1.0, -1.0, 0.0, 0.0,
        0.0, 1.0, 0.0, 0.0,
    ];
    let mut saddle = matrix::<f64>(&structure, &values, 2).falling_back(&lissom_solver::KINDS[0]);
    saddle.renew(&structure, 1.0, &mut |_| false).expect("exchanges of rows help");
    assert!(saddle.fell_back().is_some_and(|(unknown, _)| unknown >= 2) && saddle.redundant().is_none());
    let mut right = [1.0, 0.0, 0.0, 2.0];
    saddle.solve(&mut right);
    // The equilibrated row of that coordinate has lost digits for exchanges of rows, too: further corrections recover them.
    for (value, expected) in right.iter().zip([2.0, 2.0, -1.0, -1.0]) {
        assert!((value - expected).abs() < 1e-3, "{right:?}");
    }
    let mut saddle = matrix::<f64>(&structure, &values, 2).falling_back(&lissom_solver::KINDS[0]);
    saddle.renew(&structure, 1.0, &mut |_| true).expect("one of them is compliant");
    assert!(saddle.fell_back().is_none() && saddle.redundant().is_some());
    // A strict solver neither exchanges rows nor omits an equation.
    let strict = lissom_solver::kind("strict").expect("a solver");
    let mut saddle = matrix::<f64>(&structure, &values, 2).falling_back(strict);
    saddle.renew(&structure, 1.0, &mut |_| true).expect("two digits are left");
    assert!(saddle.fell_back().is_none() && saddle.redundant().is_none());
}

#[test]
fn a_singular_matrix_is_reported_by_the_pivot_that_vanished_first() {
    let structure = structure(2);
    let mut saddle =
        matrix::<f64>(&structure, &[1.0, 1.0, 1.0, 1.0], 2).falling_back(&lissom_solver::KINDS[0]);
    let error = saddle.factor(&structure, 1.0).expect_err("it is singular");
    assert!(matches!(error, FactorError::ZeroPivot { unknown: 0 | 1, .. }), "{error}");
    assert!(saddle.report().is_none());
}

#[test]
fn numbers_that_are_not_finite_are_no_redundancy() {
    let structure = structure(2);
    let mut saddle =
        matrix::<f64>(&structure, &[1.0, f64::NAN, f64::NAN, 0.0], 1).falling_back(&lissom_solver::KINDS[0]);
    assert!(matches!(saddle.factor(&structure, 1.0), Err(FactorError::NotFinite { .. })));
    assert!(saddle.redundant().is_none() && saddle.fell_back().is_none());
}
