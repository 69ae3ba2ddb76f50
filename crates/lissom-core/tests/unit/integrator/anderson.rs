//! Tests of `integrator::anderson`, a module of it.

use super::*;

/// Iterations for A x = b with the unit tangent, A = 1 + two rank-one terms, until `|d|` < 1e-12, for right-hand sides that
/// change from step to step.
fn iterations(improves: bool) -> Vec<usize> {
    let count = 12;
    let direction = |k: usize, row: usize| (1.0 + (k * 7 + row * (3 + k)) as f64).sin() / 2.0;
    let product = |x: &[f64]| -> Vec<f64> {
        let shares: Vec<f64> =
            (0..2).map(|k| (0..count).map(|row| 0.1 * direction(k, row) * x[row]).sum()).collect();
        (0..count).map(|row| x[row] + (0..2).map(|k| shares[k] * direction(k, row)).sum::<f64>()).collect()
    };
    let mut secants = Anderson::new(1, count + 1, &vec![1.0; count]);
    (0..6)
        .map(|step| {
            let wanted: Vec<f64> = (0..count).map(|row| ((row + step) as f64).cos()).collect();
            let mut x = vec![0.0; count];
            secants.interrupt();
            for iteration in 1..50 {
                let mut correction: Vec<f64> =
                    product(&x).iter().zip(product(&wanted)).map(|(have, want)| have - want).collect();
                // A multiplier, which has no weight.
                correction.push(1.0);
                let mut stages = [correction];
                if improves {
                    secants.improve(&mut stages, &Tuning::default());
                }
                for (x, correction) in x.iter_mut().zip(&stages[0]) {
                    *x -= correction;
                }
                if stages[0][..count].iter().all(|value| value.abs() < 1e-12) {
                    return iteration;
                }
            }
            50
        })
        .collect()
}

#[test]
fn what_a_tangent_does_not_know_is_learned_and_remembered() {
    let (plain, improved) = (iterations(false), iterations(true));
    assert!(plain.iter().all(|&count| count >= 12), "{plain:?}");
    assert!(improved[0] <= 5, "{improved:?}");
    assert!(improved[1..].iter().all(|&count| count <= 3), "{improved:?}");
}

/// A tangent that is exact at first and then leaves 0.4 of each correction in the same direction, as after a change of step size.
#[test]
fn secants_of_earlier_equations_do_not_stop_the_iteration() {
    let mut secants = Anderson::new(1, 12, &[1.0; 12]);
    let wanted: Vec<f64> = (0..12).map(|row| f64::from(row).cos()).collect();
    for stiffness in [1.0, 0.6] {
        let mut x = [0.0; 12];
        secants.interrupt();
        for _ in 0..30 {
            let residual = x.iter().zip(&wanted).map(|(x, wanted)| stiffness * (x - wanted));
            let mut stages = [residual.collect::<Vec<f64>>()];
            secants.improve(&mut stages, &Tuning::default());
            x.iter_mut().zip(&stages[0]).for_each(|(x, correction)| *x -= correction);
            if stages[0].iter().all(|value| value.abs() < 1e-12) {
                break;
            }
        }
        let worst = x.iter().zip(&wanted).map(|(x, wanted)| (x - wanted).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-11, "{stiffness}: {worst}");
    }
}

#[test]
fn an_exact_tangent_is_left_alone() {
    let mut secants = Anderson::new(1, 2, &[1.0, 1.0]);
    for (first, second) in [(1.0, 2.0), (0.0, 0.0), (3.0, 1.0)] {
        let mut stages = [vec![first, second]];
        secants.improve(&mut stages, &Tuning::default());
        assert_eq!(stages[0], [first, second]);
    }
}
