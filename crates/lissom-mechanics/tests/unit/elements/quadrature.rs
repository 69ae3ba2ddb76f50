//! Tests of `elements::quadrature`, a module of it.

use super::*;

fn integrate(rule: &[(f64, f64)], degree: i32) -> f64 {
    rule.iter().map(|(x, w)| w * x.powi(degree)).sum()
}

fn exact(degree: i32) -> f64 {
    if degree % 2 == 0 { 2.0 / f64::from(degree + 1) } else { 0.0 }
}

#[test]
fn rules_are_exact_to_their_degree_and_no_further() {
    for n in 1..=4_i32 {
        let rule = gauss_legendre(n as usize);
        for degree in 0..2 * n {
            assert!((integrate(rule, degree) - exact(degree)).abs() < 1e-14, "{n} {degree}");
        }
        assert!((integrate(rule, 2 * n) - exact(2 * n)).abs() > 1e-3);
    }
    for n in 2..=4_i32 {
        let rule = gauss_lobatto(n as usize);
        for degree in 0..2 * n - 2 {
            assert!((integrate(rule, degree) - exact(degree)).abs() < 1e-14, "{n} {degree}");
        }
        assert!((integrate(rule, 2 * n - 2) - exact(2 * n - 2)).abs() > 1e-3);
    }
}
