//! Residual of the whole system at both stages of a step, for schemes that integrate strains and violations.
//! Knows no scheme and no scaling.

use nalgebra::SVector;

use super::{Drive, System};
use crate::joints::attached::AttachedJoint;
use crate::joints::derivatives::LOCAL;
use crate::joints::evaluation_point::{Augmentation, Increments};
use crate::joints::{Equations, MOST_EQUATIONS};
use crate::kinematics::LOCKED;
use crate::kinematics::step_stages::{STAGES, StepStages};

/// Where the residuals of a step are evaluated.
#[derive(Clone, Copy, Debug)]
pub struct StepPoint<'a> {
    /// The motion.
    pub step: StepStages<'a>,
    /// What has changed since the start, at the stages and at the end.
    pub increments: [Increments<'a>; STAGES + 1],
    /// Multipliers by stage [N, N m].
    pub multipliers: [&'a [f64]; STAGES],
    /// Violations at the start.
    pub violations: &'a [f64],
    /// The augmented Lagrangian term.
    pub augmentation: Augmentation,
}

impl System {
    /// Residuals at the stages of `point`: left-hand sides of the equations of motion in the rows of the
    /// coordinates, integrated violations in the rows of the multipliers.
    pub fn step_residuals(&self, point: &StepPoint<'_>, out: &mut [Vec<f64>]) {
        for residual in out.iter_mut() {
            residual.fill(0.0);
        }
        for batch in &self.batches {
            batch.stage_forces(&point.step, out);
        }
        for (index, joint) in self.joints.iter().enumerate() {
            joint_residuals(joint, self.rows_of_joint(index), point, out);
        }
        for drive in &self.drives {
            let rows = self.rows_of_drive(drive);
            let quantity = self.layout.quantities[self.layout.coordinate_count + drive.multiplier];
            let weight = point.augmentation.weight * point.augmentation.relative(quantity);
            for (stage, violation) in drive_violations(drive, point).into_iter().enumerate() {
                out[stage][rows[1]] = violation;
                out[stage][rows[0]] += point.multipliers[stage][drive.multiplier] + weight * violation;
            }
        }
        self.add_coupling_stages(point, out);
        self.add_slider_stages(point, out);
    }
}

fn joint_residuals(joint: &AttachedJoint, rows: &[u32], point: &StepPoint<'_>, out: &mut [Vec<f64>]) {
    let own = joint.first_multiplier..joint.first_multiplier + joint.equations();
    let mut before = Equations::default();
    before[..joint.equations()].copy_from_slice(&point.violations[own.clone()]);
    let visits = joint.visits(&point.step, &point.increments, &before);
    for (stage, visit) in visits.iter().enumerate() {
        let mut mu = SVector::<f64, MOST_EQUATIONS>::zeros();
        for (k, multiplier) in point.multipliers[stage][own.clone()].iter().enumerate() {
            let relative = point.augmentation.relative(joint.joint().equation_quantity(k));
            mu[k] = multiplier + point.augmentation.weight * relative * visit.violation[k];
        }
        let forces = visit.rows.tr_mul(&mu);
        for (&row, force) in rows[..LOCAL].iter().zip(forces.iter()) {
            if row != LOCKED {
                out[stage][row as usize] += force;
            }
        }
        for (&row, value) in rows[LOCAL..].iter().zip(visit.violation.iter()) {
            out[stage][row as usize] = *value;
        }
    }
}

/// c_i = γ_i (c_start - ρ) + Δφ_i - Σ_j d_ij ḟ_j with ρ = Δf - Σ_j D_j ḟ_j: the rate of φ follows that of f at
/// both stages, but for the small ρ, which makes the violation vanish at the end.
fn drive_violations(drive: &Drive, point: &StepPoint<'_>) -> [f64; STAGES] {
    let StepStages { stages, end, .. } = point.step;
    let value = &drive.prescribed.value;
    let rates = stages.map(|at| value.first_derivative(at.time));
    let missed = -drive.prescribed.violation_change(0.0, end.time, end.elapsed) - point.step.whole(rates);
    let whole: f64 = point.step.lasting.iter().sum();
    let rate = (point.violations[drive.multiplier] - missed) / whole;
    let behind = point.step.at_stages(0.0, rates.map(|of| rate - of));
    std::array::from_fn(|i| point.increments[i].coordinates[drive.prescribed.coordinate] + behind[i])
}
