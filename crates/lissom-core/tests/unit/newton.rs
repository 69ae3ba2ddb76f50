//! Tests of `newton`, a module of it.

use super::*;

/// x² = 2 with a tangent that is renewed only on request.
struct Root {
    x: f64,
    slope: f64,
    tangents: usize,
    last: f64,
    before: f64,
}

impl Root {
    fn new(x: f64, slope: f64) -> Self {
        Self { x, slope, tangents: 0, last: 0.0, before: 0.0 }
    }
}

impl Equations for Root {
    fn correct(&mut self) -> Correction {
        let change = -(self.x * self.x - 2.0) / self.slope;
        self.x += change;
        self.before = self.last;
        self.last = change;
        Correction { size: change.abs(), reference: 1.0 }
    }
    fn renew_tangent(&mut self) -> Result<(), FactorError> {
        self.slope = 2.0 * self.x;
        self.tangents += 1;
        Ok(())
    }
    fn restart(&mut self) {
        self.x = 1.0;
    }
    fn back_off(&mut self) {
        self.x -= self.last + 0.5 * self.before;
        self.before *= 0.5;
        self.last = self.before;
    }
}

#[test]
fn converges_and_keeps_the_tangent_for_the_next_solution() {
    let mut root = Root::new(1.0, 0.0);
    let mut jacobian = JacobianState::default();
    let limits = Limits { tolerance: 1e-10, max_iterations: 30, ..Limits::default() };
    solve(&mut root, &limits, &mut jacobian).expect("converges");
    assert!((root.x - 2.0_f64.sqrt()).abs() < 1e-10);
    let tangents = root.tangents;
    root.x += 1e-3;
    let outcome = solve(&mut root, &limits, &mut jacobian).expect("converges");
    assert_eq!(root.tangents, tangents);
    assert!(outcome.iterations <= 6 && outcome.factorizations == 0);
}

/// Two equations: one solved at once, the other, a million times smaller, with a tangent that contracts by 0.9
/// until it is renewed. Statics near a buckling load behaves similarly.
struct Pair {
    large: f64,
    small: f64,
    rate: f64,
}

impl Equations for Pair {
    fn correct(&mut self) -> Correction {
        let changes = [1.0 - self.large, (1.0 - self.rate) * (1e-6 - self.small)];
        self.large += changes[0];
        self.small += changes[1];
        Correction { size: changes[0].abs().max(changes[1].abs()), reference: 1.0 }
    }
    fn renew_tangent(&mut self) -> Result<(), FactorError> {
        self.rate = 0.0;
        Ok(())
    }
    fn restart(&mut self) {
        (self.large, self.small) = (0.0, 0.0);
    }
    fn back_off(&mut self) {}
}

#[test]
fn a_vanishing_correction_is_no_licence_for_the_next_solutions() {
    let mut root = Root::new(2.0_f64.sqrt(), 2.0 * 2.0_f64.sqrt());
    let mut jacobian =
        JacobianState { has_tangent: true, contraction: Some(0.5), ..JacobianState::default() };
    let limits = Limits { tolerance: 1e-12, max_iterations: 30, ..Limits::default() };
    // Nearly solved already: the corrections soon vanish.
    for _ in 0..3 {
        root.x += 1e-15;
        solve(&mut root, &limits, &mut jacobian).expect("converges");
    }
    // The next solution is elsewhere and has to be found.
    root.x = 1.5;
    solve(&mut root, &limits, &mut jacobian).expect("converges");
    assert!((root.x - 2.0_f64.sqrt()).abs() < 1e-11, "{}", root.x);
}

#[test]
fn a_small_slow_part_is_not_hidden_by_a_large_fast_one() {
    let mut pair = Pair { large: 0.0, small: 0.0, rate: 0.9 };
    let mut jacobian = JacobianState { has_tangent: true, ..JacobianState::default() };
    solve(&mut pair, &Limits { tolerance: 1e-10, max_iterations: 30, ..Limits::default() }, &mut jacobian)
        .expect("converges");
    assert!((pair.small - 1e-6).abs() < 1e-9, "{}", pair.small);
}

#[test]
fn a_tangent_that_leads_astray_is_renewed_from_the_first_guess() {
    let mut root = Root::new(1.0, 0.5);
    let mut jacobian = JacobianState { has_tangent: true, ..JacobianState::default() };
    solve(&mut root, &Limits { tolerance: 1e-10, max_iterations: 30, ..Limits::default() }, &mut jacobian)
        .expect("converges");
    assert!((root.x - 2.0_f64.sqrt()).abs() < 1e-9);
    assert!(root.tangents >= 1);
}
