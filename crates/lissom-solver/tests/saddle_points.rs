//! Every kind of solver on saddle-point systems of chains, trees, grids and closed loops.

use crate::samples::{Model, Sample, backward_error, chain, closed_loop, grid, right_hand_side, tree};
use lissom_solver::{KINDS, LinearSolver, SolverKind, Structure, kind};
use num_complex::Complex64;

const TOLERANCE: f64 = 1e-12;

fn models() -> Vec<(&'static str, Model)> {
    vec![
        ("chain", chain(300)),
        ("short chain", chain(30)),
        ("tree", tree(400)),
        ("grid", grid(600)),
        ("closed loop", closed_loop(250)),
    ]
}

trait Build: Sample {
    fn build(kind: &SolverKind, structure: &Structure) -> Box<dyn LinearSolver<Self>>;
}
impl Build for f64 {
    fn build(kind: &SolverKind, structure: &Structure) -> Box<dyn LinearSolver<f64>> {
        (kind.real)(structure)
    }
}
impl Build for Complex64 {
    fn build(kind: &SolverKind, structure: &Structure) -> Box<dyn LinearSolver<Complex64>> {
        (kind.complex)(structure)
    }
}

fn solves_everything<S: Build>() {
    for (name, model) in models() {
        let structure = model.structure();
        let pattern = &structure.pattern;
        for kind in KINDS {
            let mut solver = S::build(kind, &structure);
            assert!(kind.is_strict || solver.name() == kind.name, "{}", solver.name());
            assert!(solver.factor_entries() >= pattern.entries());
            for seed in 0..3 {
                let values: Vec<S> = model.values(pattern, seed, 1.0);
                let report =
                    solver.factor(&values).unwrap_or_else(|error| panic!("{}, {name}: {error}", kind.name));
                assert!(
                    (report.growth < 100.0 || kind.name == "pivoting") && report.relative_pivot() > 1e-8,
                    "{}, {name}: {report:?}",
                    kind.name
                );
                let b: Vec<S> = right_hand_side(model.size, seed + 100);
                let mut x = b.clone();
                solver.solve(&mut x);
                let error = backward_error(pattern, &values, &x, &b, false);
                assert!(error < TOLERANCE, "{}, {name}: {error:e}", kind.name);
                let mut x = b.clone();
                solver.solve_transposed(&mut x);
                let error = backward_error(pattern, &values, &x, &b, true);
                assert!(error < TOLERANCE, "{}, {name}, transposed: {error:e}", kind.name);
            }
        }
    }
}

#[test]
fn real_systems_are_solved() {
    solves_everything::<f64>();
}

#[test]
fn complex_systems_are_solved() {
    solves_everything::<Complex64>();
}

#[test]
fn larger_fronts_are_solved() {
    // Fronts wider than one block of the kernels, and without pivots in multiples of four.
    let mut model = Model::default();
    let groups: Vec<usize> = (0..9).map(|_| model.group(17, &[])).collect();
    model.element(&groups);
    let more: Vec<usize> = (0..4).map(|_| model.group(11, &[])).collect();
    model.element(&[&groups[3..], &more[..]].concat());
    model.constrain(&more, 5);
    let structure = model.structure();
    for kind in KINDS {
        let values: Vec<f64> = model.values(&structure.pattern, 3, 1.0);
        let mut solver = (kind.real)(&structure);
        solver.factor(&values).unwrap();
        let b: Vec<f64> = right_hand_side(model.size, 4);
        for transposed in [false, true] {
            let mut x = b.clone();
            if transposed {
                solver.solve_transposed(&mut x);
            } else {
                solver.solve(&mut x);
            }
            let error = backward_error(&structure.pattern, &values, &x, &b, transposed);
            assert!(error < TOLERANCE, "{}: {error:e}", kind.name);
        }
    }
}

#[test]
fn solvers_agree_with_the_one_that_pivots() {
    for (name, model) in models() {
        let structure = model.structure();
        let values: Vec<f64> = model.values(&structure.pattern, 11, 1.0);
        let b: Vec<f64> = right_hand_side(model.size, 12);
        let mut pivoting = (kind("pivoting").unwrap().real)(&structure);
        pivoting.factor(&values).unwrap();
        let mut expected = b.clone();
        pivoting.solve(&mut expected);
        let scale = expected.iter().fold(0.0, |scale: f64, x| scale.max(x.abs()));
        for kind in KINDS {
            let mut solver = (kind.real)(&structure);
            solver.factor(&values).unwrap();
            let mut x = b.clone();
            solver.solve(&mut x);
            for (x, expected) in x.iter().zip(&expected) {
                assert!((x - expected).abs() < 1e-9 * scale, "{}, {name}: {x} for {expected}", kind.name);
            }
        }
    }
}
