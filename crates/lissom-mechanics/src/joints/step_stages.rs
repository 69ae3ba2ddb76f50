//! A joint over a step: violations integrated from their rates, and forces that do no work.
//!
//! ```text
//! c_i = γ_i c_start + Σ_j d_ij B̃_j V_j,      γ_i = Σ_j d_ij / Σ_j D_j,      forces at stage i: B̃_iᵀ μ_i
//! ```
//!
//! c_i = 0 at both stages means B̃_j V_j = -c_start/h at each: no power, and no violation at the end. See
//! `kinematics::step_stages` for B̃.

use nalgebra::SVector;

use super::attached::{AttachedJoint, LocalGradient};
use super::derivatives::{LOCAL, OWN, TIP};
use super::{Equations, MAX_EQUATIONS};
use crate::joints::evaluation_point::Increments;
use crate::kinematics::Quantity;
use crate::kinematics::step_stages::{STAGES, StepStages, above_round_off, weigh};
use crate::round_off;

/// Velocities and violations of a joint at a stage.
pub struct Visit {
    /// B̃.
    pub rows: LocalGradient,
    /// Integrated violation.
    pub violation: SVector<f64, MAX_EQUATIONS>,
}

impl AttachedJoint {
    /// Gradients and integrated violations at the stages of `step`. `increments` are those of the stages and
    /// of the end, `before` is the violation at the start.
    pub fn visits(
        &self,
        step: &StepStages<'_>,
        increments: &[Increments<'_>; STAGES + 1],
        before: &Equations,
    ) -> [Visit; STAGES] {
        let mut rows = [LocalGradient::zeros(); STAGES];
        let mut rates = [SVector::<f64, MAX_EQUATIONS>::zeros(); STAGES];
        let mut weights = [SVector::<f64, LOCAL>::zeros(); STAGES];
        let mut squares = [0.0; STAGES];
        let mut way = 0.0_f64;
        for j in 0..STAGES {
            let configuration = self.configuration(&increments[j]);
            rows[j] = self.gradient_at(&configuration);
            let speeds = self.speeds(step.stages[j]);
            rates[j] = rows[j] * speeds;
            let terms = rows[j].abs() * speeds.abs();
            way = way.max(step.lasting[j].abs() * terms.max());
            let variation = self.variation(&configuration.0);
            let relative = variation * speeds;
            let weighted = weigh(&relative, step.length);
            weights[j] = variation.tr_mul(&weighted);
            squares[j] = relative.dot(&weighted);
            for (k, coordinate) in self.joint().coordinates().iter().enumerate() {
                let unit = match coordinate.quantity {
                    Quantity::Length | Quantity::State => 1.0,
                    Quantity::Angle => step.length,
                };
                weights[j][OWN + k] = unit * unit * speeds[OWN + k];
                squares[j] += weights[j][OWN + k] * speeds[OWN + k];
            }
        }
        let (relative, own) = self.configuration(&increments[STAGES]);
        let change = self.joint().violation_change(&relative, &own);
        let missed = SVector::<f64, MAX_EQUATIONS>::from_column_slice(&change) - step.whole(rates);
        let (mut inverse, mut shares) = step.shares(squares);
        if self.is_rigid() {
            // No relative motion remains: the rates and their error are round-off.
            inverse = 0.0;
        }
        let whole: f64 = step.lasting.iter().sum();
        if inverse == 0.0 {
            shares = [1.0 / whole; STAGES];
        }
        // A value below round-off is included in the violations but would be noise in the forces.
        let known = missed.map(|value| value * above_round_off(value.abs(), round_off::RIGID_MOTION * way));
        let before = SVector::<f64, MAX_EQUATIONS>::from_column_slice(before);
        let violations =
            step.at_stages(SVector::zeros(), [0, 1].map(|j| rates[j] + shares[j] * missed + before / whole));
        [0, 1].map(|j| Visit {
            rows: rows[j] + inverse * known * weights[j].transpose(),
            violation: violations[j],
        })
    }

    /// Whether it allows no relative motion: six equations and no coordinate of its own.
    fn is_rigid(&self) -> bool {
        self.joint().equations().len() == 6 && self.joint().coordinates().is_empty()
    }

    /// Velocities of the local unknowns.
    pub fn speeds(&self, at: &crate::kinematics::Kinematics) -> SVector<f64, LOCAL> {
        let mut speeds = SVector::<f64, LOCAL>::zeros();
        for (frame, first) in self.frames.iter().zip([0, TIP]) {
            speeds.fixed_rows_mut::<6>(first).copy_from(&at.nodes[frame.node].twist);
        }
        for (k, &coordinate) in self.coordinates.iter().enumerate() {
            speeds[OWN + k] = at.coordinates[coordinate].rate;
        }
        speeds
    }
}
