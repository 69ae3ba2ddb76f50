//! Tests of `sweep::statistic`, a module of it.

use super::*;

fn all(history: &[(f64, f64)]) -> Vec<Option<f64>> {
    let mut accumulator = Accumulator::with_fatigue(Some(Fatigue { exponent: 2.0, cycles: Some(4.0) }));
    for (time, value) in history {
        accumulator.add(*time, *value);
    }
    STATISTICS.iter().map(|statistic| statistic.of(&accumulator)).collect()
}

#[test]
fn statistics_are_those_of_the_history() {
    // Uneven steps: means are over time, not over records.
    let values = all(&[(1.0, -3.0), (1.5, 1.0), (3.0, 1.0)]);
    let [duration, mean, square] = [2.0_f64, 0.25 * -2.0 + 1.5, 0.25 * (9.0 + 1.0) + 1.5];
    let (mean, rms) = (mean / duration, (square / duration).sqrt());
    // Half a cycle from -3 to 1.
    let equivalent = (0.5 * 16.0 / 4.0_f64).sqrt();
    let wanted = [1.0, -3.0, 3.0, 1.5, 1.0, mean, rms, -3.0, 1.0, equivalent, 1.0];
    assert_eq!(values, wanted.map(Some));
    let wanted = [-2.0, -2.0, 2.0, 0.0, 0.0, -2.0, 2.0, -2.0, -2.0, 0.0, 0.0];
    assert_eq!(all(&[(0.0, -2.0)]), wanted.map(Some));
}

#[test]
fn what_is_not_finite_is_never_passed_over() {
    let history = [(0.0, 1.0), (0.1, f64::NAN), (0.2, 2.0)];
    assert!(all(&history).iter().all(Option::is_none));
    assert!(all(&[]).iter().all(Option::is_none));
    let mut accumulator = Accumulator::default();
    for (time, value) in history {
        accumulator.add(time, value);
    }
    assert_eq!(accumulator.fault(), Some(0.1));
}
