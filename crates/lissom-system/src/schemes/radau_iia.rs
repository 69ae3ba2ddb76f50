//! Radau IIA with two, three, five or seven stages, stiffly accurate [Hairer and Wanner 1996, sections IV.5, IV.8; 1999].
//!
//! Legend: S number of stages, c_i abscissae, P Legendre polynomial, D_i increment at stage i, relative to extrapolation with the
//! velocity at the start, so that q' = Σ (A⁻¹)_ij D_j and q'' = Σ (A⁻²)_ij D_j without terms of the start.
//!
//! ```text
//! P_S(2 c_i - 1) = P_(S-1)(2 c_i - 1),      (A⁻¹)_ij = ℓ_j'(c_i),      ℓ_j(c_k) = δ_jk,   ℓ_j(0) = 0
//! S = 2:   A = [5/12 -1/12; 3/4 1/4],   c = (1/3, 1),   A⁻¹ = [3/2 1/2; -9/2 5/2],   A⁻² = [0 2; -18 4]
//! ```
//!
//! Positions are of order 2 S - 1, in constrained motion velocities of order S and multipliers of order S - 1 [Hairer, Lubich and
//! Roche 1989]; what is recorded follows from the positions. For even S all eigenvalues of A are complex.

use super::collocation::collocation;
use super::scheme::{ContactSolution, Scheme, SchemeKind};

/// Registry entry of two stages.
pub const KIND: SchemeKind = SchemeKind {
    name: "radau-iia",
    summary: "Two-stage Radau IIA: third order, strongly damping.",
    tolerance: None,
    contacts: ContactSolution::Elements,
    parameters: &[],
    build: |_| Ok(two_stages()),
};

/// Registry entry of three stages.
pub const FIFTH_ORDER_KIND: SchemeKind = SchemeKind {
    name: "radau-iia-5",
    summary: "Three-stage Radau IIA: fifth order, strongly damping; for adaptive steps and small errors.",
    tolerance: None,
    contacts: ContactSolution::Elements,
    parameters: &[],
    build: |_| Ok(three_stages()),
};

/// Registry entry of five stages.
pub const NINTH_ORDER_KIND: SchemeKind = SchemeKind {
    name: "radau-iia-9",
    summary: "Five-stage Radau IIA: ninth order, strongly damping; for smooth motions with very small errors.",
    tolerance: None,
    contacts: ContactSolution::Elements,
    parameters: &[],
    build: |_| Ok(five_stages()),
};

/// Registry entry of seven stages.
pub const THIRTEENTH_ORDER_KIND: SchemeKind = SchemeKind {
    name: "radau-iia-13",
    summary: "Seven-stage Radau IIA: thirteenth order, strongly damping; for smooth motions with errors near round-off.",
    tolerance: None,
    contacts: ContactSolution::Elements,
    parameters: &[],
    build: |_| Ok(seven_stages()),
};

/// Third order.
pub fn two_stages() -> Scheme {
    radau::<2>("radau-iia")
}

/// Fifth order.
pub fn three_stages() -> Scheme {
    radau::<3>("radau-iia-5")
}

/// Ninth order.
pub fn five_stages() -> Scheme {
    radau::<5>("radau-iia-9")
}

/// Thirteenth order.
pub fn seven_stages() -> Scheme {
    radau::<7>("radau-iia-13")
}

fn radau<const S: usize>(name: &str) -> Scheme {
    let abscissae = abscissae::<S>();
    collocation(name.to_owned(), abscissae, differentiation(&abscissae))
}

/// Zeros of P_S - P_(S-1) over 0 … 1, ascending, by Newton's method from those of the Chebyshev-Radau polynomial.
fn abscissae<const S: usize>() -> [f64; S] {
    /// Iterations; each doubles the number of digits.
    const ITERATIONS: usize = 8;
    let count = S as f64;
    std::array::from_fn(|i| {
        if i + 1 == S {
            return 1.0;
        }
        let mut x = -(2.0 * std::f64::consts::PI * (i + 1) as f64 / (2.0 * count - 1.0)
            - std::f64::consts::PI / (2.0 * count - 1.0))
            .cos();
        for _ in 0..ITERATIONS {
            let [(before, slope_before), (last, slope_last)] = legendre(S, x);
            x -= (last - before) / (slope_last - slope_before);
        }
        0.5 * (1.0 + x)
    })
}

/// Values and derivatives of P_(n-1) and P_n at x, n ≥ 1.
fn legendre(n: usize, x: f64) -> [(f64, f64); 2] {
    let (mut before, mut last) = ((1.0, 0.0), (x, 1.0));
    for k in 1..n {
        let k = k as f64;
        let value = ((2.0 * k + 1.0) * x * last.0 - k * before.0) / (k + 1.0);
        let slope = ((2.0 * k + 1.0) * (last.0 + x * last.1) - k * before.1) / (k + 1.0);
        (before, last) = (last, (value, slope));
    }
    [before, last]
}

/// A⁻¹: derivatives at the abscissae of the polynomials that are one at an abscissa, and zero at the others and at the start.
fn differentiation<const S: usize>(abscissae: &[f64; S]) -> [[f64; S]; S] {
    let c = abscissae;
    // Products over all other knots, the start included.
    let weight = |i: usize| c[i] * (0..S).filter(|&k| k != i).map(|k| c[i] - c[k]).product::<f64>();
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            if i == j {
                1.0 / c[i] + (0..S).filter(|&k| k != i).map(|k| 1.0 / (c[i] - c[k])).sum::<f64>()
            } else {
                weight(i) / (weight(j) * (c[i] - c[j]))
            }
        })
    })
}

#[cfg(test)]
#[path = "../../tests/unit/schemes/radau_iia.rs"]
mod tests;
