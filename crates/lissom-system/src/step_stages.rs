//! Residual of the whole system at both stages of a step, for schemes that integrate strains and violations.
//! Independent of scheme and scaling.

use nalgebra::SVector;

use super::System;
use lissom_mechanics::joints::attached::AttachedJoint;
use lissom_mechanics::joints::derivatives::LOCAL;
use lissom_mechanics::joints::evaluation_point::{Augmentation, Increments};
use lissom_mechanics::joints::{Equations, MAX_EQUATIONS};
use lissom_mechanics::kinematics::LOCKED;
use lissom_mechanics::kinematics::step_stages::{STAGES, StepStages};

/// Evaluation point of the residuals of a step.
#[derive(Clone, Copy, Debug)]
pub struct StepPoint<'a> {
    /// The motion.
    pub step: StepStages<'a>,
    /// Changes since the start, at the stages and at the end.
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
        for (index, joint) in self.constraints.joints.iter().enumerate() {
            joint_residuals(joint, self.rows_of_joint(index), point, out);
        }
        self.add_stages_of_others(point, out);
    }
}

fn joint_residuals(joint: &AttachedJoint, rows: &[u32], point: &StepPoint<'_>, out: &mut [Vec<f64>]) {
    let own = joint.first_multiplier..joint.first_multiplier + joint.equations();
    let mut before = Equations::default();
    before[..joint.equations()].copy_from_slice(&point.violations[own.clone()]);
    let visits = joint.visits(&point.step, &point.increments, &before);
    for (stage, visit) in visits.iter().enumerate() {
        let mut mu = SVector::<f64, MAX_EQUATIONS>::zeros();
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
