//! What a factorisation says when it cannot go through, and when it can only just.

use std::sync::Arc;

use crate::samples::{Model, chain, tree};
use lissom_solver::{FactorError, FactorReport, Group, KINDS, Pattern, Structure, kind};

const WITHOUT_PIVOTING: [&str; 1] = ["sparse"];

fn factor(name: &str, structure: &Structure, values: &[f64]) -> Result<FactorReport, FactorError> {
    (kind(name).unwrap().real)(structure).factor(values)
}

/// Multipliers, which have hosts.
fn multipliers(model: &Model) -> Vec<usize> {
    model.constraints.iter().flat_map(|constraint| constraint.multipliers.clone()).collect()
}

#[test]
fn a_coordinate_without_stiffness_is_named_when_nothing_augments_it() {
    for model in [chain(300), tree(300)] {
        let structure = model.structure();
        let values = model.values::<f64>(&structure.pattern, 5, 0.0);
        for name in WITHOUT_PIVOTING {
            match factor(name, &structure, &values) {
                Err(FactorError::ZeroPivot { unknown, pivot, largest }) => {
                    assert!(model.massless.contains(&unknown), "{name}: {unknown}");
                    assert_eq!((pivot, largest), (0.0, 0.0), "{name}");
                }
                other => panic!("{name}: {other:?}"),
            }
        }
        // The matrix is regular: a solver that pivots has no difficulty.
        factor("pivoting", &structure, &values).unwrap();
        // With the augmented term it goes through.
        let values = model.values::<f64>(&structure.pattern, 5, 1.0);
        for name in WITHOUT_PIVOTING {
            factor(name, &structure, &values).unwrap();
        }
    }
}

#[test]
fn a_constraint_stated_twice_is_named() {
    let mut model = chain(200);
    let first = model.constraints[0].coordinates.clone();
    let joint = model.groups.iter().find(|group| !group.hosts.is_empty()).unwrap();
    let hosts = joint.hosts.clone();
    model.constrain(&hosts, 6);
    let structure = model.structure();
    let pattern = &structure.pattern;
    let mut values = model.values::<f64>(pattern, 6, 1.0);
    let original = model.constraints[0].multipliers.clone();
    let copy = model.constraints.last().unwrap().multipliers.clone();
    for (&original, &copy) in original.iter().zip(&copy) {
        for &coordinate in &first {
            values[pattern.position(copy, coordinate).unwrap()] =
                values[pattern.position(original, coordinate).unwrap()];
            values[pattern.position(coordinate, copy).unwrap()] =
                values[pattern.position(coordinate, original).unwrap()];
        }
    }
    for name in WITHOUT_PIVOTING {
        match factor(name, &structure, &values) {
            Err(FactorError::ZeroPivot { unknown, pivot, largest }) => {
                assert!(multipliers(&model).contains(&unknown), "{name}: {unknown}");
                assert!(pivot < 1e-12 * largest, "{name}: {pivot:e} of {largest:e}");
            }
            other => panic!("{name}: {other:?}"),
        }
    }
}

#[test]
fn numbers_that_are_not_finite_are_found() {
    let model = chain(100);
    let structure = model.structure();
    let pattern = &structure.pattern;
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for unknown in [0, 50, model.size - 1] {
            let mut values = model.values::<f64>(pattern, 7, 1.0);
            values[pattern.column_starts()[unknown]] = bad;
            for kind in KINDS {
                let error = factor(kind.name, &structure, &values).unwrap_err();
                assert_eq!(error, FactorError::NotFinite { unknown }, "{}", kind.name);
            }
        }
    }
}

#[test]
fn overflow_on_the_way_is_found() {
    let pattern = Arc::new(Pattern::from_cliques(2, [&[0, 1][..]]));
    let structure = Structure::ungrouped(pattern);
    for name in WITHOUT_PIVOTING {
        let error = factor(name, &structure, &[1e-200, 1e200, 1e200, 1.0]).unwrap_err();
        assert!(matches!(error, FactorError::NotFinite { .. }), "{name}: {error}");
    }
}

#[test]
fn a_solver_recovers_from_a_failure() {
    let model = chain(200);
    let structure = model.structure();
    let good = model.values::<f64>(&structure.pattern, 8, 1.0);
    let bad = model.values::<f64>(&structure.pattern, 8, 0.0);
    let b = crate::samples::right_hand_side::<f64>(model.size, 9);
    for name in WITHOUT_PIVOTING {
        let mut solver = (kind(name).unwrap().real)(&structure);
        solver.factor(&good).unwrap();
        let mut expected = b.clone();
        solver.solve(&mut expected);
        solver.factor(&bad).unwrap_err();
        solver.factor(&good).unwrap();
        let mut x = b.clone();
        solver.solve(&mut x);
        assert_eq!(x, expected, "{name}");
    }
}

#[test]
fn good_pivots_of_any_size_are_accepted() {
    // Rows and columns scaled so that pivots lie 30 powers of ten apart: nothing cancels more than before.
    let model = chain(200);
    let structure = model.structure();
    let pattern = &structure.pattern;
    let values = model.values::<f64>(pattern, 10, 1.0);
    let scale = |unknown: usize| if unknown.is_multiple_of(2) { 1.0 } else { 2.0_f64.powi(-50) };
    let mut scaled = values.clone();
    for column in 0..model.size {
        let start = pattern.column_starts()[column];
        for (offset, &row) in pattern.column(column).iter().enumerate() {
            scaled[start + offset] *= scale(row) * scale(column);
        }
    }
    for name in WITHOUT_PIVOTING {
        let plain = factor(name, &structure, &values).unwrap();
        let report = factor(name, &structure, &scaled).unwrap();
        assert_eq!(report.worst_cancellation, plain.worst_cancellation, "{name}");
        assert!(report.relative_pivot() < 1e-27, "{name}");
    }
}

#[test]
fn the_report_is_that_of_the_small_example() {
    // [4 1; 1 1/2]: pivots 4 and 1/4; the second is 1/4 left of 1/2 + 1/4.
    let structure = Structure::new(
        Arc::new(Pattern::from_cliques(2, [&[0, 1][..]])),
        vec![Group { unknowns: vec![0, 1], hosts: vec![] }],
    )
    .unwrap();
    for name in WITHOUT_PIVOTING {
        let report = factor(name, &structure, &[4.0, 1.0, 1.0, 0.5]).unwrap();
        assert_eq!(
            report,
            FactorReport {
                smallest_pivot: 0.25,
                smallest_pivot_unknown: 1,
                largest_diagonal: 4.0,
                growth: 1.0,
                worst_cancellation: 0.25 / 0.75,
                worst_cancellation_unknown: 1,
                negative_pivots: Some(0),
            },
            "{name}"
        );
    }
}
