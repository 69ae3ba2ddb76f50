//! Tests of `monitors::impacts`, a module of it.

use super::*;

/// Whether the gap of a body that meets a spring of ω at a rate of 1 at the time 0 is reported, with steps of `step` the
/// first of which ends at `first`; the body moves into the spring and back.
fn is_reported(omega: f64, step: f64, first: f64, restitution: f64) -> bool {
    let contact = std::f64::consts::PI / omega;
    let gap = |time: f64| match time {
        time if time <= 0.0 => -time,
        time if time < contact => -(omega * time).sin() / omega,
        time => restitution * (time - contact),
    };
    let mut approach = Approach { value: gap(first - step), ..Approach::default() };
    (0..60).any(|k| approach.is_stopped(gap(first + f64::from(k) * step), step))
}

#[test]
fn contacts_shorter_than_steps_are_reported_whatever_the_phase_and_long_ones_are_not() {
    for phase in 0..10 {
        let first = -2.0 - 0.1 * f64::from(phase);
        for omega in [1.0, 2.0, 10.0, 1e3] {
            for restitution in [1.0, 0.5, 0.15] {
                assert!(is_reported(omega, 1.0, first, restitution), "{omega} {first} {restitution}");
            }
        }
        assert!(!is_reported(0.3, 1.0, first, 1.0), "{first}");
        assert!(!is_reported(0.1, 1.0, first, 1.0), "{first}");
    }
}

#[test]
fn a_slow_approach_is_no_longer_reported_beside_fast_ones_that_are_not_stopped() {
    let mut approach = Approach { value: 1e-3, ..Approach::default() };
    let is_reported = |approach: &Approach| {
        approach.stopped.is_some_and(|(rate, _)| rate >= SLOW_APPROACH * approach.fastest)
    };
    for (k, value) in [5e-4, 0.0, -5e-4, -5e-4].into_iter().enumerate() {
        approach.accept(value, 1.0, k as f64);
    }
    assert!(is_reported(&approach), "stopped at once: {approach:?}");
    (4..10).for_each(|k| approach.accept(-f64::from(k), 1.0, f64::from(k)));
    assert!(!is_reported(&approach), "{approach:?}");
}

/// A step that ends where the contact begins, and the remainder of the planned step, are no whole steps.
#[test]
fn steps_that_end_at_the_contact_are_not_counted() {
    for (remainder, omega) in [(0.01, 1.0), (0.25, 1.5), (0.5, 2.0), (0.9, 1.0)] {
        let gap = |time: f64| if time <= 0.0 { -time } else { -(omega * time).sin() / omega };
        let (mut approach, mut end) = (Approach { value: gap(-1.5), ..Approach::default() }, -1.5);
        let ends = [-0.5, 0.0, remainder, 1.0 + remainder, 2.0 + remainder];
        let is_reported = ends
            .into_iter()
            .any(|next| approach.is_stopped(gap(next), next - std::mem::replace(&mut end, next)));
        assert!(is_reported, "{remainder} {omega}: {approach:?}");
    }
}

#[test]
fn passing_on_is_not_reported() {
    let mut approach = Approach { value: 1.0, ..Approach::default() };
    assert!(!(0..50).any(|k| approach.is_stopped((0.2 * f64::from(k)).cos(), 0.1)));
}
