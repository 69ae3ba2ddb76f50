//! St-Venant's torsion constant of the rectangle.

use std::f64::consts::PI;

/// Torsion constant [m⁴] of a solid rectangle with sides [m], in any order.
///
/// `J = (h w³/3) [1 - (192 w/(π⁵ h)) Σ_{n odd} tanh(nπh/(2w))/n⁵]` with w the smaller side
/// (de Saint-Venant 1855; Timoshenko and Goodier, Theory of Elasticity, article 109).
pub fn rectangle_torsion_constant(one: f64, other: f64) -> f64 {
    let (w, h) = (one.min(other), one.max(other));
    // Terms fall as n⁻⁵: the first omitted, n = 1001, is below 1e-15 of the sum. Smallest first.
    let term = |n: u32| (f64::from(n) * PI * h / (2.0 * w)).tanh() / f64::from(n).powi(5);
    let series: f64 = (1..=999).rev().step_by(2).map(term).sum();
    h * w.powi(3) / 3.0 * (1.0 - 192.0 * w / (PI.powi(5) * h) * series)
}

#[cfg(test)]
#[path = "../../tests/unit/sections/torsion.rs"]
mod tests;
