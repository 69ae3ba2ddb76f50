//! Tests of `control::load`, a module of it.

use super::*;

#[test]
fn a_linear_range_is_taken_in_few_steps_that_end_with_it() {
    let mut control = LoadControl::new(0.1);
    let (mut at, mut sizes) = (0.0, Vec::new());
    while at < 1.0 - 1e-12 {
        let size = control.propose(1.0 - at, 0.25);
        control.accept(size, 2, (0.0, 0.01), &Tuning::default());
        at += size;
        sizes.push(size);
    }
    assert!((at - 1.0).abs() < 1e-12 && sizes.len() <= 6, "{sizes:?}");
}

#[test]
fn what_halving_does_not_explain_is_taken() {
    let mut control = LoadControl::new(0.1);
    let mut attempts = Attempts::default();
    assert!(control.refuses(0.1, 0.3, 0.01, &mut attempts), "it may be the length");
    assert!(!control.refuses(0.05, 0.28, 0.01, &mut attempts), "it is not");
    let mut attempts = Attempts::default();
    assert!(control.refuses(0.1, 0.3, 0.01, &mut attempts));
    assert!(!control.refuses(0.05, 0.005, 0.01, &mut attempts), "it was");
}
