//! Tests of `analyses::gradient::confirmation`, a module of it.

use super::*;

const NUMBERS: [f64; 3] = [2.0, -3.0, 1e6];

/// A measure of three numbers, the last with little effect, and its derivatives.
fn value(numbers: &[f64; 3]) -> f64 {
    let [a, b, c] = *numbers;
    (3.0 * a).sin() * b * b + 1e-9 * c
}

fn derivatives() -> [f64; 3] {
    let [a, b, _] = NUMBERS;
    [3.0 * (3.0 * a).cos() * b * b, 2.0 * b * (3.0 * a).sin(), 1e-9]
}

fn asked(
    derivatives: [f64; 3],
    of: impl Fn(&[f64; 3]) -> Option<f64>,
) -> Result<Confirmation, GradientError> {
    let carried: Vec<DirectDerivative> = NUMBERS
        .iter()
        .zip(derivatives)
        .map(|(&number, derivative)| DirectDerivative { number, derivative })
        .collect();
    confirm(&carried, (value(&NUMBERS), 10.0), &mut |changes| {
        let changed = std::array::from_fn(|k| NUMBERS[k] + changes[k]);
        of(&changed).ok_or(GradientError::InParts(0.0))
    })
}

#[test]
fn right_derivatives_are_confirmed_by_a_run_or_two() {
    let found = asked(derivatives(), |at| Some(value(at))).unwrap();
    let Confirmation::Confirmed { missed, runs } = found else { panic!("{found:?}") };
    assert!(missed < MISSED && runs <= 2, "{found:?}");
}

#[test]
fn every_wrong_derivative_is_denied() {
    for index in 0..3 {
        for factor in [0.0, 0.97, -1.0, 2.0] {
            let mut wrong = derivatives();
            wrong[index] *= factor;
            let found = asked(wrong, |at| Some(value(at)));
            assert!(matches!(found, Err(GradientError::Denied { .. })), "{index} times {factor}: {found:?}");
        }
    }
}

#[test]
fn what_is_below_round_off_or_fails_is_reported_as_such() {
    let unconfirmed = |found: Result<Confirmation, GradientError>| {
        assert!(matches!(found, Ok(Confirmation::Untold { .. })), "{found:?}");
    };
    unconfirmed(asked([1e-12, 0.0, 0.0], |_| Some(value(&NUMBERS))));
    unconfirmed(asked(derivatives(), |_| None));
    // Differences of a rough function depend on the distance.
    unconfirmed(asked(derivatives(), |at| Some(value(at) + 1e-4 * (1e9 * at[0] + 1.0).sin())));
}
