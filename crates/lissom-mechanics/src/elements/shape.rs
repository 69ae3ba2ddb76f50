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
#[path = "../../tests/unit/elements/shape.rs"]
mod tests;
