//! Lagrange polynomials through the Gauss-Lobatto points: a beam element's interpolation.

use super::quadrature::gauss_lobatto;

/// Values and derivatives with respect to ξ ∈ [-1, 1] of the `N` Lagrange polynomials at ξ.
pub fn lagrange<const N: usize>(xi: f64) -> ([f64; N], [f64; N]) {
    let nodes = gauss_lobatto(N);
    let mut values = [0.0; N];
    let mut slopes = [0.0; N];
    for i in 0..N {
        let mut value = 1.0;
        let mut slope = 0.0;
        for j in (0..N).filter(|&j| j != i) {
            let width = nodes[i].0 - nodes[j].0;
            let factor = (xi - nodes[j].0) / width;
            slope = slope * factor + value / width;
            value *= factor;
        }
        values[i] = value;
        slopes[i] = slope;
    }
    (values, slopes)
}

#[cfg(test)]
mod tests {
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
}
