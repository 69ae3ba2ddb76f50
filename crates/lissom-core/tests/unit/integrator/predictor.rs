//! Tests of `integrator::predictor`, a module of it.

use super::*;

fn guessed(of: impl Fn(usize) -> f64, steps: usize) -> f64 {
    let mut guess = Predictor::new(1, &[1.0]);
    for step in 0..steps {
        guess.learn(&[vec![of(step)]], |_| &[0.0], &Tuning::default());
    }
    let mut value = [vec![0.0]];
    guess.improve(&mut value);
    value[0][0]
}

#[test]
fn polynomials_are_continued() {
    let cubic = |step: usize| 1.0 + 0.1 * (step as f64).powi(3);
    assert!((guessed(cubic, 40) / cubic(40) - 1.0).abs() < 1e-6);
    assert!((guessed(|step| step as f64, 6) - 6.0).abs() < 1e-6);
}

#[test]
fn each_number_is_continued_alone() {
    let of = |number: usize, step: usize| (number * step) as f64;
    for stages in [1, 2] {
        for count in [1, 7, 8, 19] {
            let values = |step: usize| -> Vec<Vec<f64>> {
                (0..stages).map(|stage| (0..count).map(|k| of(stage * count + k, step)).collect()).collect()
            };
            let mut guess = Predictor::new(stages, &vec![1.0; count]);
            for step in 0..6 {
                guess.learn(&values(step), |_| &[0.0; 19][..count], &Tuning::default());
            }
            let mut next = vec![vec![0.0; count]; stages];
            guess.improve(&mut next);
            for (next, value) in next.iter().flatten().zip(values(6).iter().flatten()) {
                assert!((next - value).abs() <= 1e-6 * value, "{stages} {count}: {next} {value}");
            }
        }
    }
}

#[test]
fn oscillations_are_continued() {
    let alternating = |step: usize| if step.is_multiple_of(2) { 1.0 } else { -1.0 };
    assert!((guessed(alternating, 20) - 1.0).abs() < 1e-9);
    // Two frequencies with different amplitudes in the two unknowns.
    let of = |step: f64| vec![(0.9 * step).cos() + (2.2 * step).sin(), (0.9 * step + 0.3).cos()];
    let mut guess = Predictor::new(1, &[1.0, 3.0]);
    for step in 0..40 {
        guess.learn(&[of(f64::from(step))], |_| &[0.0, 0.0], &Tuning::default());
    }
    let mut next = [vec![0.0, 0.0]];
    guess.improve(&mut next);
    for (next, value) in next[0].iter().zip(of(40.0)) {
        assert!((next - value).abs() < 1e-6, "{next} {value}");
    }
}

#[test]
fn what_is_missed_goes_over_to_steps_of_other_sizes() {
    // Two stages with the errors h³ (10 + t + h/4) and eight times that.
    let miss = |time: f64, size: f64| size.powi(3) * (10.0 + time + 0.25 * size);
    let mut guess = Predictor::new(2, &[1.0; 9]);
    let (mut time, mut size) = (0.0, 1.0);
    for next in [1.0, 1.0, 0.5, 0.3, 1.5, 1.0] {
        let found = miss(time, size);
        guess.learn(&[vec![found; 9], vec![8.0 * found; 9]], |_| &[0.0; 9], &Tuning::default());
        time += size;
        guess.rescale(next / size, 3);
        size = next;
        if time > 1.5 {
            let mut values = [vec![0.0; 9], vec![0.0; 9]];
            guess.improve(&mut values);
            let expected = miss(time, size);
            assert!(values[0].iter().all(|value| (value - expected).abs() < 1e-12 * expected));
            assert!((values[1][8] - 8.0 * expected).abs() < 1e-11 * expected, "{values:?} {expected}");
        }
    }
}

#[test]
fn nothing_is_continued_after_a_jump() {
    let jumping = |step: usize| if step == 12 { -1000.0 } else { step as f64 };
    assert_eq!(guessed(jumping, 13), 0.0);
    assert!((guessed(jumping, 12) - 12.0).abs() < 1e-6);
    assert!((guessed(jumping, 60) - 60.0).abs() < 1e-3);
}

#[test]
fn nothing_is_known_at_the_start() {
    assert_eq!(guessed(|_| 1.0, 0), 0.0);
    let mut guess = Predictor::new(1, &[1.0]);
    for _ in 0..5 {
        guess.learn(&[vec![1.0]], |_| &[0.0], &Tuning::default());
    }
    guess.forget();
    let mut value = [vec![0.0]];
    guess.improve(&mut value);
    assert_eq!(value[0], [0.0]);
}
