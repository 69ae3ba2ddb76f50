//! Radau IIA with two stages, third order, stiffly accurate [Hairer and Wanner 1996, sections IV.5, IV.8].
//!
//! Legend: D_i increment at stage i, relative to extrapolation with the velocity at the start, so that q' = Σ
//! (A⁻¹)_ij D_j and q'' = Σ (A⁻²)_ij D_j without terms of the start.
//!
//! ```text
//! A = [5/12 -1/12; 3/4 1/4],   c = (1/3, 1),   A⁻¹ = [3/2 1/2; -9/2 5/2],   A⁻² = [0 2; -18 4]
//! ```
//!
//! A⁻¹ = T diag(μ, μ̄) T⁻¹ with μ = 2 + i√2: with one tangent for both stages the linear systems decouple into one
//! complex system of the size of a single stage. Its real form must not be eliminated stage by stage without
//! pivoting, because (A⁻²)₁₁ = 0.

use super::collocation::collocation;
use super::scheme::{Scheme, SchemeKind};

/// The error of the prediction is a sixth of the third derivative; the scheme's own error is of fourth order. With
/// this fraction of the prediction error, errors at the end of a run are near the tolerance.
const ERROR_CONSTANT: f64 = 0.5;
/// With a constant step size the scheme's error is one order smaller than that fraction: measured, a quarter of the sum if
/// it is some per cent.
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
    two_stage_collocation("radau-iia".to_owned(), [[1.5, 0.5], [-4.5, 2.5]])
}

/// A scheme of two stages at 1/3 and 1 from A⁻¹, whose eigenvalues are complex.
pub(super) fn two_stage_collocation(name: String, rate: [[f64; 2]; 2]) -> Scheme {
    Scheme {
        error_constant: ERROR_CONSTANT,
        planned_share: PLANNED_SHARE,
        controlled_order: 3,
        ..collocation(name, [1.0 / 3.0, 1.0], rate)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::schemes::Combination;

    /// Velocities and accelerations of quadratics are exact.
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
