//! Tests of `elements::shape`, a module of it.

use super::*;

#[test]
fn polynomials_up_to_the_degree_are_reproduced_with_their_slope() {
    let nodes = gauss_lobatto(4);
    for degree in 0..4 {
        for xi in [-1.0, -0.7, 0.1, 0.9] {
            let (n, dn) = lagrange::<4>(xi);
            let value: f64 = (0..4).map(|i| n[i] * nodes[i].0.powi(degree)).sum();
            let slope: f64 = (0..4).map(|i| dn[i] * nodes[i].0.powi(degree)).sum();
            assert!((value - xi.powi(degree)).abs() < 1e-14);
            let exact = if degree == 0 { 0.0 } else { f64::from(degree) * xi.powi(degree - 1) };
            assert!((slope - exact).abs() < 1e-13);
        }
    }
}
