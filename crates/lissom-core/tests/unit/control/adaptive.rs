//! Tests of `control::adaptive`, a module of it.

use super::*;

/// Steps over an interval where the longest allowed step is h₀(t).
fn sizes(of: impl Fn(f64) -> f64, end: f64) -> (Vec<f64>, usize) {
    let mut controller = Controller::new(1.0);
    let (mut time, mut rejected, mut taken) = (0.0, 0, Vec::new());
    while time < end {
        let size = controller.propose(end - time);
        let excess = size / of(time);
        if excess > 1.0 {
            controller.reject(size, excess, &Tuning::default());
            rejected += 1;
        } else {
            controller.accept(size, excess, (MAX_GROWTH, 10.0), &Tuning::default());
            time += size;
            taken.push(size);
        }
        assert!(rejected + taken.len() < 10_000);
    }
    (taken, rejected)
}

#[test]
fn steps_settle_below_what_is_allowed_and_end_where_they_must() {
    let (taken, rejected) = sizes(|_| 0.01, 2.0);
    assert!(rejected <= 6, "{rejected}");
    assert!((taken.iter().sum::<f64>() - 2.0).abs() < 1e-12);
    let settled = taken[taken.len() / 2];
    assert!((0.006..0.01).contains(&settled), "{settled}");
    // A constant problem is solved with one step size.
    assert!(taken[20..taken.len() - 3].iter().all(|size| *size == settled), "{taken:?}");
}

#[test]
fn bursts_are_met_with_few_rejected_steps() {
    let burst = |time: f64| if (1.0..1.1).contains(&(time % 2.0)) { 1e-4 } else { 0.05 };
    let (taken, rejected) = sizes(burst, 10.0);
    // Five bursts of some 1000 to 1300 steps each.
    assert!(taken.len() < 8000, "{}", taken.len());
    assert!(rejected < 60, "{rejected}");
}
