//! Defect of the equations of motion between the ends of a step: Newton correction within the dense output.
//!
//! Legend: x step fraction in the middle of the widest gap between stages, or 1/2; q(x) dense output, with accelerations and
//! multipliers; C constraint violations; J the step's tangent with constraints; δ defect as a displacement.
//!
//! ```text
//! J [δ; ·] = [M a + f(q, v, t) + Bᵀ λ; C(q(x)) - (C_start + C_end)/2]
//! ```
//!
//! A solution satisfies the equations at the stages only. A long step can jump between branches of equilibria where they are close
//! to each other, for example where the links of a loop are aligned. Residual and error estimate at the ends of the step are then
//! correct although no path between them exists, and only the motion in between violates the equations. For a smooth motion δ is the
//! error of the dense output: O(h^(S+1)) with S stages, O(h⁴) for the cubic. Constraint violations at the ends are not a defect of
//! the step. Neither is the correction of the violations at the start, which does not decrease with the step size: defects up to its
//! size are reported as zero.

use super::error_estimate::relative_size;
use super::{Integrator, dense_output};
use crate::joints::evaluation_point::{Increments, Point};
use crate::kinematics::MotionChange;
use crate::settings::Problem;
use crate::spin::Axes;
use crate::system::State;

/// Defects below this multiple of the relative violation at the start are attributed to its correction: the accelerations make the
/// dense output overshoot by a fraction of it, and one constraint affects several coordinates.
const CORRECTED: f64 = 10.0;

/// Storage for the state within a step.
pub(super) struct Middle {
    state: State,
    unmoved: Vec<MotionChange>,
    unchanged: Vec<f64>,
}

impl Middle {
    /// Storage for states such as this one.
    pub(super) fn new(state: &State) -> Self {
        let kinematics = &state.kinematics;
        Self {
            state: state.clone(),
            unmoved: vec![MotionChange::none(); kinematics.nodes.len()],
            unchanged: vec![0.0; kinematics.coordinates.len()],
        }
    }
}

impl Integrator {
    /// Largest scaled displacement of the defect within the last attempt, from one of these states to the other, over the allowed
    /// ones of [`relative_size`]. NaN if the residual is not finite.
    pub(crate) fn defect(
        &mut self,
        Problem { system, settings }: Problem<'_>,
        (from, to): (&State, &State),
        allowed: [f64; 2],
    ) -> f64 {
        let Self { middle, work, scaled, .. } = self;
        let Middle { state, unmoved, unchanged } = &mut **middle;
        let dense = dense_output(work, Problem { system, settings }, (from, to));
        let share = dense.least_determined();
        dense.at(share, state);
        system.violations(&state.kinematics, &mut state.violations);
        let ends = from.violations.iter().zip(&to.violations);
        for (violation, (start, end)) in state.violations.iter_mut().zip(ends) {
            *violation -= 0.5 * (start + end);
        }
        let at = &state.kinematics;
        let point = Point {
            at,
            stressed: at.into(),
            increments: Increments { start: at, nodes: unmoved, coordinates: unchanged, joints: None },
            multipliers: &state.multipliers,
            violations: &state.violations,
            augmentation: scaled.augmentation(),
        };
        let mut residuals = std::mem::take(&mut work.residuals);
        let axes = Axes::Body(share * (to.kinematics.time - from.kinematics.time));
        for residual in &mut residuals {
            system.residual(&point, residual);
            work.unit.spins.turn(residual, [axes, Axes::Tangent]);
            residual.iter_mut().zip(work.row_factors()).for_each(|(value, factor)| *value *= factor);
        }
        work.tangent.matrices.solve(&settings.scheme.coupling, &mut residuals);
        let length = self.representative.length;
        let corrected = system.layout().relative_violations(&from.violations, length).fold(0.0, f64::max);
        if let Some(last) = residuals.last_mut() {
            work.tangent.scale(last);
            work.unit.spins.turn(last, [Axes::Tangent, axes]);
        }
        let sizes = &work.units.coordinates;
        let size = |allowed| {
            let last = residuals.last().map_or(&[][..], Vec::as_slice);
            relative_size(system, at, |row| last[row] * sizes[row], allowed)
        };
        let (largest, relative) = (size([1.0; 2]), size(allowed));
        work.residuals = residuals;
        if largest <= CORRECTED * corrected { 0.0 } else { relative }
    }
}
