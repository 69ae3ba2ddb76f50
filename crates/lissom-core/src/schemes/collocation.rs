//! Schemes of several stages from the inverse of their Runge-Kutta matrix, with one tangent for all stages.
//!
//! Legend: D_i increment at stage i, relative to extrapolation with the velocity at the start; (λ, v, u) an eigenvalue of A⁻¹
//! with its column v and row u, u v = 1.
//!
//! ```text
//! q' = Σ (A⁻¹)_ij D_j,   q'' = Σ (A⁻²)_ij D_j
//! (A⁻² ⊗ M + A⁻¹ ⊗ C + I ⊗ K) D = r   ⇔   D = Σ_λ v ⊗ (λ² M + λ C + K)⁻¹ (u ⊗ I) r
//! ```
//!
//! The sum over the eigenvalues has a real system per real eigenvalue and a complex one per pair of conjugates, each of the size of one
//! stage [Hairer and Wanner 1996, IV.8]. Its real form must not be eliminated stage by stage without pivoting: in Radau IIA with two
//! stages (A⁻²)₁₁ = 0.

use nalgebra::SMatrix;
use num_complex::Complex64;

use super::scheme::{
    Combination, Coupling, Decoupled, Increments, MAX_STAGES, Scheme, Stage, StageSystem, Weights,
};

use crate::round_off;

/// A stiffly accurate scheme with stages at these abscissae, the last of them 1, from A⁻¹. Its constants for step control have to
/// be set.
pub(super) fn collocation<const S: usize>(name: String, abscissae: [f64; S], rate: [[f64; S]; S]) -> Scheme {
    let matrix = SMatrix::<f64, S, S>::from_fn(|i, j| rate[i][j]);
    let curvature = matrix * matrix;
    let row = |of: &SMatrix<f64, S, S>, i: usize| {
        let increments = std::array::from_fn(|j| if j < S { of[(i, j)] } else { 0.0 });
        Combination { increments, ..Combination::default() }
    };
    let stages = (0..S).map(|i| Stage {
        abscissa: abscissae[i],
        rate: row(&matrix, i),
        curvature: row(&curvature, i),
        prediction: Combination { curvature: 0.5 * abscissae[i] * abscissae[i], ..Combination::default() },
    });
    Scheme {
        name,
        stages: stages.collect(),
        algorithmic: Combination::default(),
        increments: Increments::Departure,
        coupling: decouple(&matrix),
        tableau: None,
        memory_delay: 0.0,
        error_constant: 1.0,
        controlled_order: 2,
        planned_share: 1.0,
        dynamic: true,
    }
}

/// Eigenvalues with their right and left eigenvectors.
fn decouple<const S: usize>(matrix: &SMatrix<f64, S, S>) -> Coupling {
    let eigenvalues = nalgebra::DMatrix::from_fn(S, S, |i, j| matrix[(i, j)]).complex_eigenvalues();
    let mut systems = Vec::new();
    for &eigenvalue in eigenvalues.iter().filter(|value| value.im > -round_off::COUPLING * value.norm()) {
        let is_real = eigenvalue.im.abs() <= round_off::COUPLING * eigenvalue.norm();
        let value = if is_real { Complex64::new(eigenvalue.re, 0.0) } else { eigenvalue };
        let column = null_vector(matrix, value);
        let row = null_vector(&matrix.transpose(), value);
        let product: Complex64 = (0..S).map(|i| row[i] * column[i]).sum();
        let factor = if is_real { 1.0 } else { 2.0 };
        let left: [Complex64; MAX_STAGES] =
            std::array::from_fn(|i| if i < S { row[i] / product } else { 0.0.into() });
        let right: [Complex64; MAX_STAGES] =
            std::array::from_fn(|i| if i < S { factor * column[i] } else { 0.0.into() });
        systems.push(if is_real {
            StageSystem::Real(Decoupled {
                weights: Weights { rate: value.re, curvature: value.re * value.re },
                left: left.map(|number| number.re),
                right: right.map(|number| number.re),
            })
        } else {
            StageSystem::Complex(Decoupled {
                weights: Weights { rate: value, curvature: value * value },
                left,
                right,
            })
        });
    }
    // The real system first: its factors filter error estimates.
    systems.sort_by_key(|system| matches!(system, StageSystem::Complex(_)));
    Coupling { systems }
}

/// The vector with first entry 1 that (M - λ) maps to zero: by inverse iteration, exact after a few steps since λ is an eigenvalue to
/// round-off.
fn null_vector<const S: usize>(matrix: &SMatrix<f64, S, S>, value: Complex64) -> [Complex64; S] {
    /// Number of solutions with the nearly singular matrix, each of which adds nearly all digits.
    const STEPS: usize = 3;
    let shift = value * (1.0 + 1e-9);
    let shifted = nalgebra::DMatrix::from_fn(S, S, |i, j| {
        Complex64::from(matrix[(i, j)]) - if i == j { shift } else { 0.0.into() }
    })
    .lu();
    let mut vector = nalgebra::DVector::from_element(S, Complex64::new(1.0, 0.0));
    for _ in 0..STEPS {
        if let Some(solved) = shifted.solve(&vector) {
            let first = solved[0];
            vector = solved / first;
        }
    }
    std::array::from_fn(|i| vector[i])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::schemes::{radau_iia, radau_iia_5};

    /// The decoupled systems solve the coupled real system A⁻² ⊗ m + A⁻¹ ⊗ d + I ⊗ k.
    #[test]
    fn decoupled_systems_solve_the_coupled_stages() {
        for scheme in [radau_iia::two_stages(), radau_iia_5::three_stages()] {
            let count = scheme.stages.len();
            let (m, d, k) = (1.3, 0.2, 5.0);
            let solution = [0.7, -0.4, 0.3];
            let residual: Vec<f64> = (0..count)
                .map(|i| {
                    let stage = &scheme.stages[i];
                    let entry = |j: usize| {
                        let identity = if i == j { k } else { 0.0 };
                        m * stage.curvature.increments[j] + d * stage.rate.increments[j] + identity
                    };
                    (0..count).map(|j| entry(j) * solution[j]).sum()
                })
                .collect();
            let mut found = [0.0; MAX_STAGES];
            for system in &scheme.coupling.systems {
                match system {
                    StageSystem::Real(Decoupled { weights, left, right }) => {
                        let jacobian = weights.curvature * m + weights.rate * d + k;
                        let w = (0..count).map(|i| left[i] * residual[i]).sum::<f64>() / jacobian;
                        (0..count).for_each(|i| found[i] += right[i] * w);
                    }
                    StageSystem::Complex(Decoupled { weights, left, right }) => {
                        let jacobian = weights.curvature * m + weights.rate * d + k;
                        let w = (0..count).map(|i| left[i] * residual[i]).sum::<Complex64>() / jacobian;
                        (0..count).for_each(|i| found[i] += (right[i] * w).re);
                    }
                }
            }
            for i in 0..count {
                assert!((found[i] - solution[i]).abs() < 1e-13, "{}: {found:?}", scheme.name);
            }
        }
    }
}
