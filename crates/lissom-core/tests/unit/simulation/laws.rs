//! Tests of `simulation::laws`, a module of it.

use super::*;

/// A law of time and one argument, with bounds.
struct Law(fn(f64, f64) -> f64, fn(Interval, Interval) -> Interval);

impl ScalarLaw for Law {
    fn value(&self, time: f64, arguments: &[f64]) -> f64 {
        (self.0)(time, arguments[0])
    }

    fn bounds(&self, time: Interval, arguments: &[Interval]) -> Option<Interval> {
        Some((self.1)(time, arguments[0]))
    }
}

fn peak(distance: f64) -> f64 {
    (-(distance / 1e-4).powi(2)).exp()
}

fn peak_over([from, to]: Interval) -> Interval {
    let [one, other] = [from, to].map(peak);
    [one.min(other), if from < 0.0 && to > 0.0 { 1.0 } else { one.max(other) }]
}

/// exp(-((x - 1)/1e-4)²), and the same over time.
const BY_MOTION: Law = Law(|_, x| peak(x - 1.0), |_, x| peak_over(x.map(|x| x - 1.0)));
const BY_TIME: Law = Law(|t, _| peak(t - 1.0), |t, _| peak_over(t.map(|t| t - 1.0)));
const JUMP: Law = Law(|_, x| f64::from(u8::from(x > 0.3)), |_, x| x.map(|x| f64::from(u8::from(x > 0.3))));

fn course<'l>(law: &'l Law, cubic: &'l [Cubic; 1]) -> Course<'l> {
    Course { law, time: [0.0, 1.0], arguments: cubic }
}

#[test]
fn peaks_in_time_or_motion_are_found() {
    // x = 2 σ: the peak is at σ = 0.5.
    let moving = [[0.0, 2.0, 0.0, 0.0]];
    let by_motion = course(&BY_MOTION, &moving);
    assert_eq!(by_motion.everywhere().value, 1.0);
    assert_eq!(by_motion.found([0.0, 1.0], 1.0, DEPARTURE), Found::Hidden);
    assert_eq!(by_motion.found([0.0, 0.4995], 1.0, DEPARTURE), Found::Nothing);
    assert_eq!(by_motion.found([0.499_99, 0.500_005], 1.0, DEPARTURE), Found::Nothing);
    assert_eq!(by_motion.longest([0.0, 1.0], 1.0, DEPARTURE), 0.25);
    assert!(by_motion.exceeds_its_ends([0.0, 1.0], 1.0) && !by_motion.exceeds_its_ends([0.0, 0.5], 1.0));
    let by_time = course(&BY_TIME, &moving);
    assert_eq!(by_time.found([0.0, 1.7], 1.0, DEPARTURE), Found::Hidden);
    assert_eq!(by_time.found([0.0, 0.999], 1.0, DEPARTURE), Found::Nothing);
    // At rest there is no feature.
    assert_eq!(course(&BY_MOTION, &[[0.2, 0.0, 0.0, 0.0]]).found([0.0, 1.0], 1.0, DEPARTURE), Found::Nothing);
}

#[test]
fn jumps_are_found_to_the_last_bit() {
    let unit = [[0.0, 1.0, 0.0, 0.0]];
    assert_eq!(course(&JUMP, &unit).found([0.0, 1.0], 1.0, DEPARTURE), Found::Jump(0.3_f64.next_up()));
}

#[test]
fn cubics_pass_through_their_samples_within_their_range() {
    let cubic = through(SAMPLES.map(|x| 1.0 - 2.0 * x + 5.0 * x * x - 4.0 * x * x * x));
    for (found, wanted) in cubic.iter().zip([1.0, -2.0, 5.0, -4.0]) {
        assert!((found - wanted).abs() < 1e-13, "{cubic:?}");
    }
    for [from, to] in [[0.0, 1.0], [0.2, 0.3], [0.6, 0.61]] {
        let [low, high] = range(&cubic, [from, to]);
        for k in 0..=20 {
            let value = at(&cubic, from + f64::from(k) / 20.0 * (to - from));
            assert!((low - 1e-12..=high + 1e-12).contains(&value));
        }
        assert!(high - low < 4.0 * (to - from), "{low} {high}");
    }
}
