//! Tests of `multifrontal`, a module of it.

use super::*;
use crate::samples::{Model, Sample, backward_error, chain, grid, right_hand_side, spherical_chain};
use num_complex::Complex64;

/// Every level of vector instructions this processor has, and none.
fn processors() -> Vec<pulp::Arch> {
    let mut processors = vec![pulp::Arch::Scalar, pulp::Arch::new()];
    #[cfg(target_arch = "x86_64")]
    processors.extend(pulp::x86::V3::try_new().map(pulp::Arch::V3));
    processors
}

fn solves<S: Sample + Kernels>(model: &Model) {
    let structure = model.structure();
    let values: Vec<S> = model.values(&structure.pattern, 1, 1.0);
    let b: Vec<S> = right_hand_side(model.size, 2);
    for processor in processors() {
        let mut solver = Multifrontal::<S>::on(processor, &structure, 2);
        solver.factor(&values).expect("a regular matrix");
        for transposed in [false, true] {
            let mut x = b.clone();
            solver.triangular(&mut x, if transposed { Way::Transposed } else { Way::Plain });
            let error = backward_error(&structure.pattern, &values, &x, &b, transposed);
            assert!(error < 1e-12, "{processor:?}: {error:e}");
        }
        let mut side_by_side: Vec<[S; SEVERAL]> = b
            .iter()
            .map(|&value| std::array::from_fn(|lane| value * S::from_real(lane as f64 - 2.5)))
            .collect();
        let asked = side_by_side.clone();
        solver.solve_several(&mut side_by_side);
        for lane in 0..SEVERAL {
            let [x, b] = [&side_by_side, &asked].map(|of| of.iter().map(|row| row[lane]).collect::<Vec<S>>());
            let error = backward_error(&structure.pattern, &values, &x, &b, false);
            assert!(error < 1e-12, "{processor:?}, lane {lane}: {error:e}");
        }
    }
}

/// Textbook elimination in the solver's order: smallest pivot, growth, worst cancellation.
fn monitor(solver: &Multifrontal<f64>, values: &[f64]) -> (f64, f64, f64) {
    assert_eq!(solver.symbolic.parts.len(), 1);
    let order: Vec<u32> = solver
        .symbolic
        .unknowns
        .iter()
        .copied()
        .filter(|&unknown| unknown != elimination_tree::NONE)
        .collect();
    let entry = |row: u32, column: u32| solver.pattern.position(row as usize, column as usize);
    let mut matrix: Vec<Vec<f64>> = order
        .iter()
        .map(|&row| order.iter().map(|&column| entry(row, column).map_or(0.0, |at| values[at])).collect())
        .collect();
    let mut terms: Vec<f64> = (0..order.len()).map(|step| matrix[step][step].abs()).collect();
    let (mut smallest, mut largest, mut cancellation) = (f64::INFINITY, 0.0_f64, f64::INFINITY);
    for step in 0..order.len() {
        let pivot_row = matrix[step].clone();
        smallest = smallest.min(pivot_row[step].abs());
        cancellation = cancellation.min(pivot_row[step].abs() / terms[step]);
        largest = pivot_row[step..].iter().fold(largest, |largest, value| largest.max(value.abs()));
        for row in step + 1..order.len() {
            let factor = matrix[row][step] / pivot_row[step];
            terms[row] += (factor * pivot_row[row]).abs();
            for column in step..order.len() {
                matrix[row][column] -= factor * pivot_row[column];
            }
        }
    }
    (
        smallest,
        largest / values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs())),
        cancellation,
    )
}

#[test]
fn the_report_is_that_of_plain_elimination() {
    for model in [chain(200), grid(400)] {
        let structure = model.structure();
        let values: Vec<f64> = model.values(&structure.pattern, 3, 1.0);
        let mut solver = Multifrontal::<f64>::new(&structure);
        assert!(solver.symbolic.fronts.len() > 3);
        let report = solver.factor(&values).expect("a regular matrix");
        let (smallest, growth, cancellation) = monitor(&solver, &values);
        let close = |a: f64, b: f64| (a - b).abs() < 1e-9 * b;
        assert!(close(report.smallest_pivot, smallest), "{report:?}: {smallest}");
        assert!(close(report.growth, growth), "{report:?}: {growth}");
        assert!(close(report.worst_cancellation, cancellation), "{report:?}: {cancellation}");
    }
}

#[test]
fn large_trees_are_shared_and_small_ones_are_not() {
    for (model, subtrees) in
        [(spherical_chain(2_000), 0..1), (spherical_chain(20_000), 2..3), (grid(20_000), 4..100)]
    {
        let mut solver = Multifrontal::<f64>::new(&model.structure());
        let found = solver.symbolic.parts.len() - 1;
        assert!(subtrees.contains(&found), "{found}");
        for threads in 1..4 {
            solver.set_threads(threads);
            let crews = if threads == 1 || found == 0 { 0 } else { threads.min(found) };
            assert_eq!(solver.crews.len(), crews);
            assert_eq!(solver.crews.iter().sum::<usize>(), if crews == 0 { 0 } else { found });
        }
    }
}

/// Each part has memory of its own.
#[test]
fn thousands_of_trees_are_few_parts() {
    let mut model = crate::samples::Model::default();
    for _ in 0..6000 {
        let node = model.node();
        model.element(&[node]);
    }
    let solver = Multifrontal::<f64>::new(&model.structure());
    let parts = solver.symbolic.parts.len();
    assert!((5..200).contains(&parts), "{parts}");
    solves::<f64>(&model);
}

#[test]
fn every_level_of_vector_instructions_solves() {
    for model in [chain(300), grid(600)] {
        solves::<f64>(&model);
        solves::<Complex64>(&model);
    }
}
