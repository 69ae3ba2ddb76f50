//! LDLᵀ of symmetric matrices: solves, agrees with LU, names what cannot be factored, does not allocate more.

use std::sync::Arc;

use crate::samples::{Model, Sample, backward_error, chain, closed_loop, grid, right_hand_side, tree};
use lissom_solver::{FactorError, Kernels, LinearSolver, Multifrontal, Pattern, Structure, Symmetric, kind};
use num_complex::Complex64;

fn symmetric_values<S: Sample>(model: &Model, pattern: &Pattern, penalty: f64) -> Vec<S> {
    let values: Vec<S> = model.values(pattern, 3, penalty);
    let mut out = values.clone();
    for column in 0..pattern.size() {
        for position in pattern.column_starts()[column]..pattern.column_starts()[column + 1] {
            let mirror = pattern.position(column, pattern.row_indices()[position]).unwrap();
            out[position] = (values[position] + values[mirror]) * S::from_real(0.5);
        }
    }
    out
}

fn solves<S: Sample + Kernels>() {
    for model in [chain(300), chain(30), tree(400), grid(600), grid(3000), closed_loop(250)] {
        let structure = model.structure();
        let pattern = &structure.pattern;
        let values: Vec<S> = symmetric_values(&model, pattern, 1.0);
        let b: Vec<S> = right_hand_side(model.size, 4);
        let mut ldlt = Symmetric::<S>::new(&structure);
        let mut lu = Multifrontal::<S>::new(&structure);
        assert!(ldlt.factor_entries() < lu.factor_entries() * 2 / 3);
        let report = ldlt.factor(&values).unwrap();
        let of_lu = lu.factor(&values).unwrap();
        let close = |a: f64, b: f64| (a - b).abs() < 1e-8 * b;
        assert!(close(report.smallest_pivot, of_lu.smallest_pivot), "{report:?} {of_lu:?}");
        assert!(close(report.worst_cancellation, of_lu.worst_cancellation), "{report:?} {of_lu:?}");
        assert_eq!(report.smallest_pivot_unknown, of_lu.smallest_pivot_unknown);
        for transposed in [false, true] {
            let mut x = b.clone();
            if transposed {
                ldlt.solve_transposed(&mut x);
            } else {
                ldlt.solve(&mut x);
            }
            let error = backward_error(pattern, &values, &x, &b, transposed);
            assert!(error < 1e-12, "{error:e}");
        }
    }
}

#[test]
fn symmetric_matrices_are_solved() {
    solves::<f64>();
    solves::<Complex64>();
}

#[test]
fn only_the_later_row_of_each_pair_is_read() {
    let model = tree(300);
    let structure = model.structure();
    let pattern = &structure.pattern;
    let values: Vec<f64> = symmetric_values(&model, pattern, 1.0);
    let mut places = vec![0; model.size];
    let order = lissom_solver::minimum_degree_order(&structure);
    let unknowns = order.iter().flat_map(|&group| &structure.groups[group].unknowns);
    // Within a front the order of groups is that of elimination, and between fronts too.
    for (place, &unknown) in unknowns.enumerate() {
        places[unknown] = place;
    }
    let mut spoiled = values.clone();
    for column in 0..model.size {
        for position in pattern.column_starts()[column]..pattern.column_starts()[column + 1] {
            if places[pattern.row_indices()[position]] < places[column] {
                spoiled[position] = 0.0;
            }
        }
    }
    let solution = |values: &[f64]| {
        let mut solver = Symmetric::<f64>::new(&structure);
        solver.factor(values).unwrap();
        let mut x = right_hand_side(model.size, 5);
        solver.solve(&mut x);
        x
    };
    assert_eq!(solution(&values), solution(&spoiled));
}

#[test]
fn a_vanishing_pivot_is_named() {
    let model = chain(300);
    let structure = model.structure();
    let values: Vec<f64> = symmetric_values(&model, &structure.pattern, 0.0);
    match Symmetric::<f64>::new(&structure).factor(&values) {
        Err(FactorError::ZeroPivot { unknown, .. }) => assert!(model.massless.contains(&unknown)),
        other => panic!("{other:?}"),
    }
}

#[test]
fn threads_change_no_bit() {
    let model = tree(20_000);
    let structure = model.structure();
    let values: Vec<f64> = symmetric_values(&model, &structure.pattern, 1.0);
    let b: Vec<f64> = right_hand_side(model.size, 4);
    let mut solver = Symmetric::<f64>::new(&structure);
    let solved = [1, 2, 3].map(|threads| {
        solver.set_threads(threads);
        let report = solver.factor(&values).unwrap();
        let mut x = b.clone();
        solver.solve(&mut x);
        (report, x)
    });
    assert!(solved[0] == solved[1] && solved[0] == solved[2]);
}

/// The second difference on a line, less a shift: its eigenvalues are 2 - 2 cos(k π/(n + 1)) less the shift.
#[test]
fn negative_pivots_count_negative_eigenvalues() {
    let size = 400;
    let pairs = (1..size).map(|row| (row, row - 1));
    let pattern = Arc::new(Pattern::from_entries(size, pairs));
    let structure = Structure::ungrouped(Arc::clone(&pattern));
    let mut solvers: Vec<Box<dyn LinearSolver<f64>>> =
        vec![Box::new(Symmetric::new(&structure)), Box::new(Multifrontal::new(&structure))];
    for shift in [-0.1, 0.003, 0.5, 1.7, 3.1, 4.1] {
        let mut values = Vec::new();
        for column in 0..size {
            let entry = |&row: &usize| if row == column { 2.0 - shift } else { -1.0 };
            values.extend(pattern.column(column).iter().map(entry));
        }
        let eigenvalue = |k: usize| 2.0 - 2.0 * (k as f64 * std::f64::consts::PI / (size + 1) as f64).cos();
        let wanted = (1..=size).filter(|&k| eigenvalue(k) < shift).count();
        for solver in &mut solvers {
            let report = solver.factor(&values).unwrap();
            assert_eq!(report.negative_pivots, Some(wanted), "{} at {shift}", solver.name());
        }
    }
}

/// Every equation has a negative pivot where all directions it leaves are stable.
#[test]
fn saddle_points_have_a_negative_pivot_for_each_equation() {
    for model in [chain(300), tree(400), grid(3000), closed_loop(250)] {
        let structure = model.structure();
        let values: Vec<f64> = symmetric_values(&model, &structure.pattern, 1.0);
        let count = |solver: &mut dyn LinearSolver<f64>| solver.factor(&values).unwrap().negative_pivots;
        let equations = model.constraints.iter().map(|constraint| constraint.multipliers.len()).sum();
        let expected = Some(equations);
        assert_eq!(count(&mut Symmetric::new(&structure)), expected);
        assert_eq!(count(&mut Multifrontal::new(&structure)), expected);
        let mut pivoting = (kind("pivoting").unwrap().real)(&structure);
        assert_eq!(count(&mut *pivoting), None);
        let complex: Vec<Complex64> = values.iter().map(|&value| value.into()).collect();
        let report = Symmetric::<Complex64>::new(&structure).factor(&complex).unwrap();
        assert_eq!(report.negative_pivots, None);
    }
}
