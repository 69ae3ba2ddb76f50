//! What must hold to the last bit, and what to round-off only.

use std::sync::Arc;

use crate::samples::{Model, Random, chain, closed_loop, grid, right_hand_side, tree};
use lissom_solver::{KINDS, Pattern, Structure, condition_estimate, kind};
use num_complex::Complex64;
use proptest::prelude::*;

fn models() -> [Model; 4] {
    [chain(250), tree(250), grid(400), closed_loop(200)]
}

fn solved(name: &str, structure: &Structure, values: &[f64], b: &[f64]) -> Vec<f64> {
    let mut solver = (kind(name).unwrap().real)(structure);
    solver.factor(values).unwrap();
    let mut x = b.to_vec();
    solver.solve(&mut x);
    x
}

#[test]
fn scaling_by_a_power_of_two_changes_no_digit() {
    for model in models() {
        let structure = model.structure();
        let values = model.values::<f64>(&structure.pattern, 1, 1.0);
        let b = right_hand_side::<f64>(model.size, 2);
        for name in ["sparse", "pivoting"] {
            let x = solved(name, &structure, &values, &b);
            for exponent in [-300, -7, 40, 200] {
                let scale = 2.0_f64.powi(exponent);
                let scaled: Vec<f64> = values.iter().map(|value| value * scale).collect();
                let expected: Vec<f64> = x.iter().map(|x| x / scale).collect();
                assert_eq!(solved(name, &structure, &scaled, &b), expected, "{name}, 2^{exponent}");
            }
        }
    }
}

#[test]
fn rows_and_columns_scaled_by_powers_of_two_change_no_digit() {
    for model in models() {
        let structure = model.structure();
        let pattern = &structure.pattern;
        let values = model.values::<f64>(pattern, 3, 1.0);
        let b = right_hand_side::<f64>(model.size, 4);
        let mut random = Random(5);
        let scales: Vec<f64> = (0..model.size).map(|_| (random.number() * 30.0).round().exp2()).collect();
        let mut scaled = values.clone();
        for column in 0..model.size {
            let start = pattern.column_starts()[column];
            for (offset, &row) in pattern.column(column).iter().enumerate() {
                scaled[start + offset] *= scales[row] * scales[column];
            }
        }
        let scaled_b: Vec<f64> = b.iter().zip(&scales).map(|(b, scale)| b * scale).collect();
        let x = solved("sparse", &structure, &values, &b);
        let y = solved("sparse", &structure, &scaled, &scaled_b);
        let back: Vec<f64> = y.iter().zip(&scales).map(|(y, scale)| y * scale).collect();
        assert_eq!(x, back);
    }
}

#[test]
fn a_second_factorisation_remembers_nothing_of_the_first() {
    for model in models() {
        let structure = model.structure();
        let b = right_hand_side::<f64>(model.size, 2);
        let first = model.values::<f64>(&structure.pattern, 6, 3.0);
        let second = model.values::<f64>(&structure.pattern, 7, 1.0);
        for kind in KINDS {
            let mut solver = (kind.real)(&structure);
            solver.factor(&first).unwrap();
            let mut x = b.clone();
            solver.solve(&mut x);
            let report = solver.factor(&second).unwrap();
            let mut x = b.clone();
            solver.solve(&mut x);
            assert_eq!(x, solved(kind.name, &structure, &second, &b), "{}", kind.name);
            let again = (kind.real)(&structure).factor(&second).unwrap();
            assert_eq!(report.smallest_pivot, again.smallest_pivot);
            assert_eq!(report.worst_cancellation, again.worst_cancellation);
        }
    }
}

#[test]
fn growth_is_that_of_the_factorisation_at_hand() {
    for model in models() {
        let structure = model.structure();
        let values = model.values::<f64>(&structure.pattern, 7, 1.0);
        let huge: Vec<f64> = values.iter().map(|value| 1e9 * value).collect();
        let mut solver = (kind("sparse").unwrap().real)(&structure);
        let growth = solver.factor(&values).unwrap().growth;
        solver.factor(&huge).unwrap();
        assert_eq!(solver.factor(&values).unwrap().growth, growth);
    }
}

#[test]
fn real_values_in_complex_numbers_give_the_real_solution() {
    for model in models() {
        let structure = model.structure();
        let values = model.values::<f64>(&structure.pattern, 8, 1.0);
        let b = right_hand_side::<f64>(model.size, 9);
        let complex: Vec<Complex64> = values.iter().map(|&value| value.into()).collect();
        for kind in KINDS {
            let mut solver = (kind.complex)(&structure);
            solver.factor(&complex).unwrap();
            let mut x: Vec<Complex64> = b.iter().map(|&b| b.into()).collect();
            solver.solve(&mut x);
            for (x, expected) in x.iter().zip(solved(kind.name, &structure, &values, &b)) {
                assert!((x.re - expected).abs() < 1e-9 && x.im == 0.0, "{}: {x} for {expected}", kind.name);
            }
        }
    }
}

#[test]
fn the_condition_estimate_is_close_to_the_truth() {
    for model in [chain(60), grid(54), closed_loop(80)] {
        let structure = model.structure();
        let pattern = &structure.pattern;
        let values = model.values::<f64>(pattern, 3, 1.0);
        for kind in KINDS {
            let mut solver = (kind.real)(&structure);
            solver.factor(&values).unwrap();
            let sum = |column: &[f64]| column.iter().map(|x| x.abs()).sum();
            let (mut inverse_norm, mut norm) = (0.0_f64, 0.0_f64);
            for unknown in 0..model.size {
                let mut column = vec![0.0; model.size];
                column[unknown] = 1.0;
                let mut product = vec![0.0; model.size];
                pattern.multiply(&values, &column, &mut product);
                norm = norm.max(sum(&product));
                solver.solve(&mut column);
                inverse_norm = inverse_norm.max(sum(&column));
            }
            let estimate = condition_estimate(&mut *solver, pattern, &values, &[]);
            let exact = norm * inverse_norm;
            assert!(estimate <= exact * (1.0 + 1e-9) && estimate > exact / 3.0, "{estimate:e} for {exact:e}");
        }
    }
}

#[test]
fn the_condition_estimate_does_not_depend_on_the_units_of_free_unknowns() {
    let model = chain(60);
    let structure = model.structure();
    let pattern = &structure.pattern;
    let values = model.values::<f64>(pattern, 3, 1.0);
    let free: Vec<usize> = (0..model.size).step_by(3).collect();
    let estimate = |values: &[f64], free: &[usize]| {
        let mut solver = (kind("sparse").unwrap().real)(&structure);
        solver.factor(values).unwrap();
        condition_estimate(&mut *solver, pattern, values, free)
    };
    // Newtons beside megapascals: equations have the units of their unknowns.
    let unit = |unknown: usize| if free.contains(&unknown) { 1e6 } else { 1.0 };
    let (starts, rows) = (pattern.column_starts(), pattern.row_indices());
    let entries =
        (0..model.size).flat_map(|column| (starts[column]..starts[column + 1]).map(move |k| (k, column)));
    let scaled: Vec<f64> = entries.map(|(k, column)| values[k] * unit(rows[k]) / unit(column)).collect();
    let (given, rescaled) = (estimate(&values, &free), estimate(&scaled, &free));
    // Sweeps that balance are few.
    assert!((rescaled / given - 1.0).abs() < 1e-3, "{given:e} and {rescaled:e}");
    assert!(given < 3.0 * estimate(&values, &[]), "{given:e}");
    assert!(estimate(&scaled, &[]) > 1e3 * given);
}

#[test]
fn the_complex_condition_estimate_is_close_to_the_truth() {
    for model in [chain(60), closed_loop(80)] {
        let structure = model.structure();
        let pattern = &structure.pattern;
        let mut twist = 0.0;
        let turned = |value: &f64| {
            twist += 0.1;
            value * Complex64::new(1.0, 0.3 * f64::sin(twist))
        };
        let values: Vec<Complex64> = model.values::<f64>(pattern, 3, 1.0).iter().map(turned).collect();
        let mut solver = (kind("sparse").unwrap().complex)(&structure);
        solver.factor(&values).unwrap();
        let norm_of = |column: &[Complex64]| column.iter().map(|x| x.norm()).sum::<f64>();
        let mut inverse_norm = 0.0_f64;
        for unknown in 0..model.size {
            let mut column = vec![Complex64::default(); model.size];
            column[unknown] = Complex64::new(1.0, 0.0);
            solver.solve(&mut column);
            inverse_norm = inverse_norm.max(norm_of(&column));
        }
        let starts = pattern.column_starts();
        let norm =
            (0..model.size).map(|j| norm_of(&values[starts[j]..starts[j + 1]])).fold(0.0_f64, f64::max);
        let estimate = condition_estimate(&mut *solver, pattern, &values, &[]);
        let exact = norm * inverse_norm;
        assert!(estimate <= exact * (1.0 + 1e-9) && estimate > exact / 3.0, "{estimate:e} for {exact:e}");
    }
}

#[test]
fn nothing_to_solve_is_no_difficulty() {
    let structure = Structure::ungrouped(Arc::new(Pattern::from_entries(0, [])));
    for kind in KINDS {
        let mut solver = (kind.real)(&structure);
        solver.factor(&[]).unwrap();
        solver.solve(&mut []);
        solver.solve_transposed(&mut []);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn the_numbering_of_groups_matters_to_round_off_only(seed: u64) {
        let model = closed_loop(120);
        let structure = model.structure();
        let values = model.values::<f64>(&structure.pattern, seed, 1.0);
        let b = right_hand_side::<f64>(model.size, seed ^ 1);
        let mut numbers: Vec<usize> = (0..structure.groups.len()).collect();
        Random(seed).shuffle(&mut numbers);
        let mut groups = structure.groups.clone();
        for (old, group) in structure.groups.iter().enumerate() {
            groups[numbers[old]] = group.clone();
            for host in &mut groups[numbers[old]].hosts {
                *host = numbers[*host];
            }
        }
        let shuffled = Structure::new(Arc::clone(&structure.pattern), groups).unwrap();
        for name in ["sparse", "pivoting"] {
            let x = solved(name, &structure, &values, &b);
            let y = solved(name, &shuffled, &values, &b);
            let scale = x.iter().fold(0.0, |scale: f64, x| scale.max(x.abs()));
            for (x, y) in x.iter().zip(&y) {
                prop_assert!((x - y).abs() < 1e-8 * scale);
            }
        }
    }
}
