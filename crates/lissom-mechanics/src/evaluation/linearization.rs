//! Derivatives of the equations of motion of the whole system.

use super::element::Tangents;
use crate::joints::derivatives::Derivatives;
use crate::kinematics::USUAL_UNKNOWNS;

/// Derivatives of the equations of motion in SI, each on the values of the tangent's pattern.
#[derive(Clone, Debug, Default)]
pub struct Linearization {
    /// ∂/∂ position, constraint forces at constant multipliers included.
    pub stiffness: Vec<f64>,
    /// ∂/∂ twist.
    pub damping: Vec<f64>,
    /// ∂/∂ acceleration.
    pub mass: Vec<f64>,
    /// BᵀWB: the augmented Lagrangian term for weight 1 of lengths.
    pub gram: Vec<f64>,
    /// B and Bᵀ in the multipliers' rows and columns.
    pub constraint: Vec<f64>,
    /// Derivatives of elements' forces with respect to multipliers, in the multipliers' columns.
    pub by_multiplier: Vec<f64>,
    /// Memory for the assembly of these derivatives.
    pub scratch: Option<Box<Scratch>>,
}

/// Storage for derivatives of one element or joint at a time.
#[derive(Clone, Debug)]
pub struct Scratch {
    /// Derivatives of an element.
    pub local: Tangents,
    /// Derivatives of a joint.
    pub joint: Derivatives,
}

impl Default for Scratch {
    fn default() -> Self {
        Self { local: Tangents::new(USUAL_UNKNOWNS), joint: Derivatives::new() }
    }
}

impl Linearization {
    /// Zeros, the given number for each matrix.
    pub fn zeros(entries: usize) -> Self {
        let zeros = vec![0.0; entries];
        Self {
            stiffness: zeros.clone(),
            damping: zeros.clone(),
            mass: zeros.clone(),
            gram: zeros.clone(),
            constraint: zeros.clone(),
            by_multiplier: zeros,
            scratch: None,
        }
    }

    /// Adds derivatives with respect to multipliers to those of the constraints, Bᵀ in their columns: B remains in
    /// their rows.
    pub fn fold_multipliers(&mut self) {
        for (entry, value) in self.constraint.iter_mut().zip(&mut self.by_multiplier) {
            *entry += std::mem::take(value);
        }
    }

    /// Sets all values to zero.
    pub fn clear(&mut self) {
        for values in [
            &mut self.stiffness,
            &mut self.damping,
            &mut self.mass,
            &mut self.gram,
            &mut self.constraint,
            &mut self.by_multiplier,
        ] {
            values.fill(0.0);
        }
    }
}
