//! Radau IIA with two stages, third order, stiffly accurate [Hairer and Wanner 1996, sections IV.5, IV.8].
//!
//! Legend: D_i increment at stage i, measured from going on with the rate at the start, so that
//! q' = Σ (A⁻¹)_ij D_j and q'' = Σ (A⁻²)_ij D_j without terms of the start.
//!
//! ```text
//! A = [5/12 -1/12; 3/4 1/4],   c = (1/3, 1),   A⁻¹ = [3/2 1/2; -9/2 5/2],   A⁻² = [0 2; -18 4]
//! ```
//!
//! A⁻¹ = T diag(μ, μ̄) T⁻¹ with μ = 2 + i√2: with one tangent for both stages the linear systems come
//! apart into one complex system of the size of a single stage. Its real form must not be eliminated first
//! stage first without pivoting, for (A⁻²)₁₁ = 0.

use num_complex::Complex64;

use super::{Combination, Coupling, Increments, Scheme, SchemeKind, Stage, Weights};

/// The prediction misses a sixth of the third derivative; the scheme's own error is of fourth order. With this part
/// of what is missed, errors at the end of a run are near the tolerance.
const ERROR_CONSTANT: f64 = 0.5;
/// With steps of one size the scheme errs by a power of the step less than that part: measured, a quarter of the sum where
/// it comes to some per cent.
const PLANNED_SHARE: f64 = 0.25;

/// Registry entry.
pub const KIND: SchemeKind = SchemeKind {
    name: "radau-iia",
    summary: "Two-stage Radau IIA: third order, strongly damping.",
    tolerance: None,
    build: |_| Ok(two_stages()),
};

/// The scheme.
pub fn two_stages() -> Scheme {
    collocation("radau-iia".to_owned(), [[1.5, 0.5], [-4.5, 2.5]])
}

/// A scheme of two stages at 1/3 and 1 from A⁻¹, whose eigenvalues are complex.
pub(super) fn collocation(name: String, rate: [[f64; 2]; 2]) -> Scheme {
    let curvature: [[f64; 2]; 2] =
        std::array::from_fn(|i| std::array::from_fn(|j| rate[i][0] * rate[0][j] + rate[i][1] * rate[1][j]));
    let abscissae = [1.0 / 3.0, 1.0];
    let stage = |i: usize| Stage {
        abscissa: abscissae[i],
        rate: Combination { increments: rate[i], ..Combination::default() },
        curvature: Combination { increments: curvature[i], ..Combination::default() },
        prediction: Combination { curvature: 0.5 * abscissae[i] * abscissae[i], ..Combination::default() },
    };
    let real = 0.5 * (rate[0][0] + rate[1][1]);
    let determinant = rate[0][0] * rate[1][1] - rate[0][1] * rate[1][0];
    let mu = Complex64::new(real, (determinant - real * real).sqrt());
    // Columns of T are (1, t): the first row of (A⁻¹ - μ) T = 0.
    let second = (mu - rate[0][0]) / rate[0][1];
    // T⁻¹ for T = [1 1; t t̄]: first row (t̄, -1) / (t̄ - t).
    let width = second.conj() - second;
    Scheme {
        name,
        stages: vec![stage(0), stage(1)],
        algorithmic: Combination::default(),
        increments: Increments::Departure,
        coupling: Coupling::Pair {
            weights: Weights { rate: mu, curvature: mu * mu },
            left: [second.conj() / width, -1.0 / width],
            right: [Complex64::new(2.0, 0.0), 2.0 * second],
        },
        tableau: None,
        memory_delay: 0.0,
        error_constant: ERROR_CONSTANT,
        planned_share: PLANNED_SHARE,
        dynamic: true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The complex form solves the coupled real system A⁻² ⊗ m + A⁻¹ ⊗ d + I ⊗ k.
    #[test]
    fn complex_form_solves_the_coupled_stages() {
        let scheme = two_stages();
        let Coupling::Pair { weights, left, right } = scheme.coupling else { panic!("two stages") };
        let (m, d, k) = (1.3, 0.2, 5.0);
        let solution = [0.7, -0.4];
        let residual: Vec<f64> = (0..2)
            .map(|i| {
                let stage = &scheme.stages[i];
                (0..2)
                    .map(|j| {
                        let identity = if i == j { k } else { 0.0 };
                        (m * stage.curvature.increments[j] + d * stage.rate.increments[j] + identity)
                            * solution[j]
                    })
                    .sum()
            })
            .collect();
        let jacobian = weights.curvature * m + weights.rate * d + k;
        let w = (left[0] * residual[0] + left[1] * residual[1]) / jacobian;
        for i in 0..2 {
            assert!(((right[i] * w).re - solution[i]).abs() < 1e-14);
        }
    }

    /// Rates and curvatures of quadratics are exact.
    #[test]
    fn quadratic_motion_is_reproduced() {
        let scheme = two_stages();
        let acceleration = -1.7;
        let place = |t: f64| 0.5 * acceleration * t * t;
        let increments = [place(1.0 / 3.0), place(1.0)];
        for stage in &scheme.stages {
            let combine = |c: &Combination| c.increments[0] * increments[0] + c.increments[1] * increments[1];
            assert!((combine(&stage.rate) - acceleration * stage.abscissa).abs() < 1e-14);
            assert!((combine(&stage.curvature) - acceleration).abs() < 1e-13);
        }
    }
}
