//! The number of threads changes times, not a bit of what comes out.

use crate::samples::{
    Model, Sample, backward_error, closed_loop, grid, right_hand_side, spherical_chain, tree,
};
use lissom_solver::{FactorError, FactorReport, LinearSolver, Structure, kind};
use num_complex::Complex64;

/// With more factors than one thread is enough for.
fn models() -> [Model; 4] {
    [tree(20_000), spherical_chain(30_000), closed_loop(20_000), grid(15_000)]
}

type Outcome<S> = (Result<FactorReport, FactorError>, Vec<S>, Vec<S>);

/// What a solver with so many threads makes of a matrix: its report, and solutions, also transposed.
fn outcome<S: Sample>(solver: &mut dyn LinearSolver<S>, threads: usize, values: &[S], b: &[S]) -> Outcome<S> {
    solver.set_threads(threads);
    let report = solver.factor(values);
    let (mut x, mut transposed) = (b.to_vec(), b.to_vec());
    if report.is_ok() {
        solver.solve(&mut x);
        solver.solve_transposed(&mut transposed);
    }
    (report, x, transposed)
}

type Make<S> = fn(&Structure) -> Box<dyn LinearSolver<S>>;

fn all_agree<S: Sample>(make: Make<S>, model: &Model, penalty: f64) {
    let structure = model.structure();
    let values = model.values::<S>(&structure.pattern, 1, penalty);
    let b = right_hand_side::<S>(model.size, 2);
    let mut solver = make(&structure);
    let alone = outcome(&mut *solver, 1, &values, &b);
    assert_eq!(alone.0.is_ok(), penalty > 0.0, "massless coordinates need the penalty");
    if alone.0.is_ok() {
        let error = backward_error(&structure.pattern, &values, &alone.1, &b, false);
        assert!(error < 1e-12, "{error:e}");
    }
    for threads in [2, 3] {
        assert!(outcome(&mut *solver, threads, &values, &b) == alone, "{threads} threads");
    }
}

#[test]
fn real_numbers_are_the_same_to_the_last_bit() {
    for model in &models() {
        all_agree(kind("sparse").unwrap().real, model, 1.0);
    }
}

#[test]
fn complex_numbers_are_the_same_to_the_last_bit() {
    for model in &models()[..2] {
        all_agree::<Complex64>(kind("sparse").unwrap().complex, model, 1.0);
    }
}

#[test]
fn a_refusal_names_the_same_pivot() {
    for model in &models()[..1] {
        all_agree(kind("sparse").unwrap().real, model, 0.0);
    }
}

#[test]
fn a_number_that_is_none_is_named() {
    let model = tree(20_000);
    let structure = model.structure();
    let mut values = model.values::<f64>(&structure.pattern, 1, 1.0);
    let unknown = 19_000;
    let entry = structure.pattern.position(unknown, unknown).unwrap();
    values[entry] = f64::NAN;
    for threads in [1, 2, 3] {
        let mut solver = (kind("sparse").unwrap().real)(&structure);
        solver.set_threads(threads);
        assert_eq!(solver.factor(&values), Err(FactorError::NotFinite { unknown }));
    }
}
