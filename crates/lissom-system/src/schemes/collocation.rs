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

use super::dense_polynomial::DensePolynomial;
use super::scheme::{
    Combination, Coupling, Decoupled, ErrorEstimate, MAX_STAGES, Parametrization, Scheme, Stage, StageSystem,
    Weights,
};

use crate::tuning::{Tuning, TuningParameter};
use lissom_mechanics::round_off;

/// Factor of the phase at which a single oscillation has the allowed error. Motions consist of several oscillations, and errors
/// grow with a higher power of the frequency than their estimates.
const MARGIN: f64 = 0.6;

/// A stiffly accurate scheme with stages at these abscissae, the last of them 1, from A⁻¹.
#[expect(clippy::cast_possible_wrap, reason = "stages are few")]
pub(super) fn collocation<const S: usize>(name: String, abscissae: [f64; S], rate: [[f64; S]; S]) -> Scheme {
    let matrix = SMatrix::<f64, S, S>::from_fn(|i, j| rate[i][j]);
    let square = matrix * matrix;
    let row = |of: &SMatrix<f64, S, S>, i: usize| {
        Combination::of_increments(&std::array::from_fn::<f64, S, _>(|j| of[(i, j)]))
    };
    let stages: Vec<Stage> = (0..S)
        .map(|i| Stage {
            abscissa: abscissae[i],
            velocity: row(&matrix, i),
            acceleration: row(&square, i),
            prediction: Combination {
                acceleration: 0.5 * abscissae[i] * abscissae[i],
                ..Combination::default()
            },
        })
        .collect();
    let dense = DensePolynomial::new(&abscissae);
    let errors = estimates(&abscissae, &stages, &dense);
    Scheme {
        name,
        algorithmic: Combination::default(),
        parametrization: Parametrization::RelativeToDrift,
        coupling: decouple(&matrix),
        tableau: None,
        memory_delay: 0.0,
        order: 2 * S as i32 - 1,
        planned_share: planned_share(S, &errors[0]),
        errors: errors.into(),
        quadrature: quadrature(&matrix),
        dense: Some(dense),
        dynamic: true,
        stages,
    }
}

/// The last row b of A, the end of the step being the last stage: bᵀA⁻¹ = (0, …, 0, 1).
fn quadrature<const S: usize>(inverse: &SMatrix<f64, S, S>) -> Vec<f64> {
    let last = nalgebra::DVector::from_fn(S, |i, _| if i + 1 == S { 1.0 } else { 0.0 });
    let transposed = nalgebra::DMatrix::from_fn(S, S, |i, j| inverse[(j, i)]);
    transposed.lu().solve(&last).map_or_else(Vec::new, |weights| weights.iter().copied().collect())
}

/// Error of a step for an oscillation of unit amplitude, divided by its phase per step to the power 2 S: for position and
/// velocity, and for a first-order state. It is the error of Radau's quadrature with S points.
fn error_constants(stages: usize) -> [f64; 2] {
    let factorial = |n: usize| (1..=n).map(|k| k as f64).product::<f64>();
    let quadrature = 0.5 * stages as f64 * factorial(stages - 1).powi(4) / factorial(2 * stages - 1).powi(3);
    [(2 * stages - 1) as f64 * quadrature, quadrature]
}

/// Error estimates: the differences at the start between the polynomials through the stages and the state, for accelerations and
/// for velocities. In an oscillation one is large where the other vanishes. Scaled for an oscillation whose steps each have half
/// the error that is proportional to the tolerance at the end:
///
/// ```text
/// f₁ (q''_0 - Σ_j w_j'(0) (A⁻¹ D)_j) ≈ f₁ Π c_i/(S + 1)! q^(S+2),      f₂ Σ_j w_j'(0) D_j ≈ f₂ Π c_i/(S + 1)! q^(S+1),      C φ^(2 S) = 1/2
/// ```
#[expect(clippy::cast_possible_wrap, reason = "stages are few")]
fn estimates(abscissae: &[f64], stages: &[Stage], dense: &DensePolynomial) -> [ErrorEstimate; 2] {
    let count = abscissae.len();
    let product: f64 = abscissae.iter().product();
    let missed = product / (1..=count + 1).map(|k| k as f64).product::<f64>();
    let constants = error_constants(count);
    let allowed = Tuning::default().of(TuningParameter::ShareOfStep);
    let scaled = |combination: Combination, order: usize, constant: f64| {
        let phase = MARGIN * (allowed / constant).powf(0.5 / count as f64);
        let of_oscillation = allowed / phase.powi(order as i32);
        ErrorEstimate {
            combination: combination.times(of_oscillation / missed),
            order: order as i32,
            of_oscillation,
        }
    };
    let accelerations = stages.iter().zip(dense.slopes_at_start());
    let accelerations = accelerations
        .fold(Combination { acceleration: 1.0, ..Combination::default() }, |sum, (stage, slope)| {
            sum.plus(&stage.velocity.times(-slope))
        });
    let slopes: Vec<f64> = dense.slopes_at_start().collect();
    let rates = Combination::of_increments(&slopes);
    [scaled(accelerations, count + 2, constants[0]), scaled(rates, count + 1, constants[1])]
}

/// Error at the end of a run with constant step size, as a fraction of the sum of the estimated errors. Both have different
/// orders in the step size; the fraction is evaluated where errors become noteworthy.
fn planned_share(stages: usize, error: &ErrorEstimate) -> f64 {
    /// Error of a step that becomes noteworthy after some hundred steps.
    const NOTEWORTHY: f64 = 1e-5;
    /// Part of the sum that remains at the end, as with one stage.
    const REMAINING: f64 = 0.8;
    let [constant, _] = error_constants(stages);
    let phase = (NOTEWORTHY / constant).powf(0.5 / stages as f64);
    REMAINING * NOTEWORTHY / (error.of_oscillation * phase.powi(error.order))
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
                weights: Weights::of_motion(value.re, value.re * value.re),
                left: left.map(|number| number.re),
                right: right.map(|number| number.re),
            })
        } else {
            StageSystem::Complex(Decoupled { weights: Weights::of_motion(value, value * value), left, right })
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
#[path = "../../tests/unit/schemes/collocation.rs"]
mod tests;
