//! Tests of `schemes::collocation`, a module of it.

use super::*;
use crate::schemes::radau_iia;

/// The decoupled systems solve the coupled real system A⁻² ⊗ m + A⁻¹ ⊗ d + I ⊗ k.
#[test]
fn decoupled_systems_solve_the_coupled_stages() {
    for scheme in [
        radau_iia::two_stages(),
        radau_iia::three_stages(),
        radau_iia::five_stages(),
        radau_iia::seven_stages(),
    ] {
        let count = scheme.stages.len();
        let (m, d, k) = (1.3, 0.2, 5.0);
        let solution = [0.7, -0.4, 0.3, 0.5, -0.2, 0.6, 0.1];
        let residual: Vec<f64> = (0..count)
            .map(|i| {
                let stage = &scheme.stages[i];
                let entry = |j: usize| {
                    let identity = if i == j { k } else { 0.0 };
                    m * stage.acceleration.increments[j] + d * stage.velocity.increments[j] + identity
                };
                (0..count).map(|j| entry(j) * solution[j]).sum()
            })
            .collect();
        let mut found = [0.0; MAX_STAGES];
        for system in &scheme.coupling.systems {
            match system {
                StageSystem::Real(Decoupled { weights, left, right }) => {
                    let jacobian = weights.acceleration * m + weights.velocity * d + k;
                    let w = (0..count).map(|i| left[i] * residual[i]).sum::<f64>() / jacobian;
                    (0..count).for_each(|i| found[i] += right[i] * w);
                }
                StageSystem::Complex(Decoupled { weights, left, right }) => {
                    let jacobian = weights.acceleration * m + weights.velocity * d + k;
                    let w = (0..count).map(|i| left[i] * residual[i]).sum::<Complex64>() / jacobian;
                    (0..count).for_each(|i| found[i] += (right[i] * w).re);
                }
            }
        }
        // Eigenvectors of seven stages are nearly parallel.
        let round_off = if count > 3 { 1e-10 } else { 1e-13 };
        for i in 0..count {
            assert!((found[i] - solution[i]).abs() < round_off, "{}: {found:?}", scheme.name);
        }
    }
}
