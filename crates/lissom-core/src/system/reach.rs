//! What a number of the model changes in its equations where nothing moves otherwise: the derivative of residuals by the
//! number at given motion and multipliers. Knows no scheme and no scaling.
//!
//! Legend: θ the number, f forces of elements and joints, c violations.
//!
//! ```text
//! ∂f/∂θ = Σ w_i f(θ_i),      ∂c/∂θ likewise
//! ```
//!
//! with the weights w_i of a difference over neighbouring models, of those parts alone that differ between them. Where forces are proportional to what differs, as to a stiffness
//! or a mass, the difference is taken of that once, and not of the forces at every instant.

use std::sync::Arc;

use super::System;
use super::batch::{AnyBatch, Changed};
use crate::elements::is_same;
use crate::joints::Equations;
use crate::joints::derivatives::LOCAL;
use crate::kinematics::{Kinematics, LOCKED};

/// What differs between models of the same unknowns.
pub(crate) struct Reach {
    /// The models, each with its weight.
    systems: Vec<(Arc<System>, f64)>,
    /// Elements whose forces are the derivative.
    derivatives: Vec<Box<dyn AnyBatch>>,
    /// Elements to be compared, by batch.
    elements: Vec<(usize, Vec<usize>)>,
    joints: Vec<usize>,
    drives: Vec<usize>,
    couplings: Vec<usize>,
    sliders: Vec<usize>,
}

impl Reach {
    /// Of neighbouring models with the weights of a difference. None where it cannot be determined what differs.
    pub(crate) fn of(systems: Vec<(Arc<System>, f64)>) -> Option<Self> {
        let (first, _) = systems.first()?;
        let is_alike = |other: &System| {
            first.batches.len() == other.batches.len()
                && first.joints.len() == other.joints.len()
                && first.drives.len() == other.drives.len()
                && first.couplings.len() == other.couplings.len()
                && first.sliders.len() == other.sliders.len()
        };
        if !systems.iter().all(|(other, _)| is_alike(other)) {
            return None;
        }
        let (mut derivatives, mut elements) = (Vec::new(), Vec::new());
        for (index, batch) in first.batches.iter().enumerate() {
            let neighbours: Vec<(&dyn AnyBatch, f64)> =
                systems.iter().map(|(other, weight)| (&*other.batches[index], *weight)).collect();
            match batch.changed(&neighbours, &first.layout)? {
                Changed::Nothing => {}
                Changed::Derivative(batch) => derivatives.push(batch),
                Changed::Items(items) => elements.push((index, items)),
            }
        }
        let differing = |is_changed: &dyn Fn(&System, usize) -> bool, count: usize| -> Vec<usize> {
            let is_any = |&index: &usize| systems.iter().any(|(other, _)| is_changed(other, index));
            (0..count).filter(is_any).collect()
        };
        let is_other = |other: &System, k: usize| !is_same(&first.joints[k], &other.joints[k]);
        let joints = differing(&is_other, first.joints.len());
        let is_other = |other: &System, k: usize| !is_same(&first.drives[k], &other.drives[k]);
        let drives = differing(&is_other, first.drives.len());
        let is_other = |other: &System, k: usize| !is_same(&first.couplings[k], &other.couplings[k]);
        let couplings = differing(&is_other, first.couplings.len());
        let is_other = |other: &System, k: usize| !is_same(&first.sliders[k], &other.sliders[k]);
        let sliders = differing(&is_other, first.sliders.len());
        Some(Self { systems, derivatives, elements, joints, drives, couplings, sliders })
    }

    /// Adds the derivatives of forces and violations by the number, by row.
    pub(crate) fn add(&self, at: &Kinematics, multipliers: &[f64], scratch: &mut [f64], out: &mut [f64]) {
        for batch in &self.derivatives {
            batch.forces(at, out);
        }
        let has_differences = !(self.elements.is_empty()
            && self.joints.is_empty()
            && self.drives.is_empty()
            && self.couplings.is_empty()
            && self.sliders.is_empty());
        if !has_differences {
            return;
        }
        for (system, weight) in &self.systems {
            scratch.fill(0.0);
            for (batch, items) in &self.elements {
                let batch = &system.batches[*batch];
                if items.len() == batch.len() {
                    batch.forces(at, scratch);
                } else {
                    batch.forces_of(items, at, scratch);
                }
            }
            self.add_constraints(system, at, multipliers, scratch);
            for (sum, value) in out.iter_mut().zip(&*scratch) {
                *sum += weight * value;
            }
        }
    }

    fn add_constraints(&self, system: &System, at: &Kinematics, multipliers: &[f64], out: &mut [f64]) {
        let layout = &system.layout;
        for &index in &self.joints {
            let joint = &system.joints[index];
            let own = joint.first_multiplier..joint.first_multiplier + joint.equations();
            let mut mu = Equations::default();
            mu[..own.len()].copy_from_slice(&multipliers[own.clone()]);
            let configuration = joint.outright(at);
            let forces = joint.forces(&configuration, &mu);
            let rows = system.rows_of_joint(index);
            for (&row, force) in rows[..LOCAL].iter().zip(forces.iter()) {
                if row != LOCKED {
                    out[row as usize] += force;
                }
            }
            let violation = joint.joint().violation(&configuration.0, &configuration.1);
            out[layout.coordinate_count..][own].copy_from_slice(&violation[..joint.equations()]);
        }
        for &index in &self.drives {
            let drive = &system.drives[index];
            let value = at.coordinates[drive.prescribed.coordinate].value;
            out[layout.coordinate_count + drive.multiplier] = drive.prescribed.violation(value, at.time);
        }
        for &index in &self.couplings {
            let coupling = &system.couplings[index];
            let mu = multipliers[coupling.multiplier];
            for (&coordinate, by) in coupling.coordinates.iter().zip(&coupling.gradient(at)) {
                out[layout.row_of_coordinate(coordinate)] += by * mu;
            }
            out[layout.coordinate_count + coupling.multiplier] = coupling.violation(at);
        }
        for &index in &self.sliders {
            system.add_slider_outright(index, at, multipliers, out);
        }
    }
}
