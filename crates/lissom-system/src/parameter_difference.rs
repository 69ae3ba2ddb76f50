//! Derivative of the equations with respect to a model parameter, at given motion and multipliers. Independent of scheme
//! and scaling.
//!
//! Legend: θ the parameter, f forces of elements and joints, c violations.
//!
//! ```text
//! ∂f/∂θ = Σ w_i f(θ_i),      ∂c/∂θ likewise
//! ```
//!
//! with the weights w_i of a difference over neighbouring models, of those parts only that differ between them. If forces are
//! proportional to the parameter, such as a stiffness or a mass, the difference is computed once for the parameter, instead of
//! for the forces at every instant.

use std::sync::Arc;

use super::System;
use lissom_mechanics::elements::is_same;
use lissom_mechanics::evaluation::batch::{AnyBatch, Changed, scatter};
use lissom_mechanics::evaluation::scratch::with_scratch;
use lissom_mechanics::kinematics::Kinematics;

/// Difference between models with the same unknowns.
pub struct ParameterDifference {
    /// The models, each with its weight.
    systems: Vec<(Arc<System>, f64)>,
    /// Elements whose forces are the derivative.
    derivatives: Vec<Box<dyn AnyBatch>>,
    /// Elements to be compared, by batch.
    elements: Vec<(usize, Vec<usize>)>,
    constraints: Vec<usize>,
}

impl ParameterDifference {
    /// From neighbouring models with the weights of a difference. None if the difference cannot be determined.
    pub fn of(systems: Vec<(Arc<System>, f64)>) -> Option<Self> {
        let (first, _) = systems.first()?;
        let is_alike = |other: &System| {
            first.batches.len() == other.batches.len()
                && first.constraints.counts() == other.constraints.counts()
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
        let is_changed = |&index: &usize| {
            let own = first.constraints.get(index);
            systems.iter().any(|(other, _)| !is_same(own, other.constraints.get(index)))
        };
        let constraints = (0..first.constraints.counts().iter().sum()).filter(is_changed).collect();
        Some(Self { systems, derivatives, elements, constraints })
    }

    /// Adds the derivatives of forces and violations with respect to the parameter, by row.
    pub fn add(&self, at: &Kinematics, multipliers: &[f64], scratch: &mut [f64], out: &mut [f64]) {
        for batch in &self.derivatives {
            batch.forces(at, out);
        }
        if self.elements.is_empty() && self.constraints.is_empty() {
            return;
        }
        for (system, weight) in &self.systems {
            scratch.fill(0.0);
            for (batch, items) in &self.elements {
                let batch = &system.batches[*batch];
                if items.len() == batch.rows().count() {
                    batch.forces(at, scratch);
                } else {
                    add_forces_of(&**batch, items, at, scratch);
                }
            }
            for &constraint in &self.constraints {
                system.add_absolute(constraint, at, multipliers, scratch);
            }
            for (sum, value) in out.iter_mut().zip(&*scratch) {
                *sum += weight * value;
            }
        }
    }
}

/// Adds the forces of some items of a batch.
fn add_forces_of(batch: &dyn AnyBatch, items: &[usize], at: &Kinematics, out: &mut [f64]) {
    for &item in items {
        let Some(element) = batch.element(item) else { continue };
        let rows = batch.rows().of(item);
        with_scratch(rows.len(), |local| {
            element.forces(at, local);
            scatter(rows, local, out);
        });
    }
}
