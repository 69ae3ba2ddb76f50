//! Tests of `impacts`, a module of it.

use super::*;

/// The share that is found, and the number of solutions.
fn search(
    lost: f64,
    tolerances: [f64; 2],
    solutions: usize,
    returned: impl Fn(f64) -> f64,
) -> (Option<f64>, usize) {
    let mut rebounds = Rebounds::new(lost, tolerances, solutions);
    let mut count = 0;
    while let Some(share) = rebounds.next_share() {
        count += 1;
        let is_best = rebounds.record(returned(share));
        assert_eq!(is_best, returned(share) - lost <= tolerances[0]);
    }
    (rebounds.found(), count)
}

#[test]
fn rebounds_that_gain_no_energy_are_whole() {
    assert_eq!(search(1.0, [0.0; 2], 7, |share| 0.3 * share), (Some(1.0), 1));
}

#[test]
fn rebounds_return_what_was_lost() {
    for energy in [1.1, 2.0, 50.0] {
        let returned = |share: f64| energy * share * share * (1.0 + 0.2 * share);
        let (share, count) = search(1.0, [1e-12; 2], 50, returned);
        let share = share.expect("small rebounds return little");
        assert!((returned(share) - 1.0).abs() <= 1e-12 && count < 30, "{share} {count}");
        let (share, count) = search(1.0, [1e-12, 1e-3], 7, returned);
        let found = returned(share.expect("small rebounds return little"));
        assert!(found <= 1.0 + 1e-12 && found > 0.9 && count <= 7, "{found} {count}");
    }
}

/// Friction that begins to stick makes the energy jump.
#[test]
fn jumps_of_the_energy_are_not_passed() {
    let (share, _) = search(1.0, [1e-12; 2], 50, |share| if share < 0.4 { share } else { 2.0 + share });
    assert!((0.35..0.4).contains(&share.expect("a share")), "{share:?}");
}

#[test]
fn rebounds_that_always_gain_energy_are_none() {
    assert_eq!(search(0.0, [0.0; 2], 7, |_| 1.0), (None, 7));
}
