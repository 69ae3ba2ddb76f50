//! Derivatives of a recorded quantity.
//!
//! ```text
//! δy = c_q δq + c_v δv + c_a δa + c_λ δλ + c_u δu
//! ```
//!
//! q positions (body variations and coordinates), v twists and rates, a their derivatives, λ multipliers, u held values.

use std::collections::BTreeMap;

use lissom_mechanics::signals::DiscreteValueId;
use num_complex::Complex64;

/// Derivatives of a quantity by row; missing rows are zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OutputDerivatives {
    /// With respect to positions.
    pub by_place: BTreeMap<usize, f64>,
    /// With respect to twists and rates.
    pub by_rate: BTreeMap<usize, f64>,
    /// With respect to accelerations.
    pub by_acceleration: BTreeMap<usize, f64>,
    /// With respect to multipliers; rows as in the layout, after those of the coordinates.
    pub by_multiplier: BTreeMap<usize, f64>,
    /// With respect to held values.
    pub by_held: BTreeMap<DiscreteValueId, f64>,
}

impl OutputDerivatives {
    /// Amplitude of the quantity if the unknowns and multipliers are `amplitudes` times e^{st}, without held values, and the
    /// sum of the magnitudes of its terms.
    pub fn amplitude(&self, s: Complex64, amplitudes: &[Complex64]) -> (Complex64, f64) {
        let factors = [Complex64::from(1.0), s, s * s, Complex64::from(1.0)];
        let parts = [&self.by_place, &self.by_rate, &self.by_acceleration, &self.by_multiplier];
        let (mut sum, mut terms) = (Complex64::default(), 0.0);
        for (factor, part) in factors.into_iter().zip(parts) {
            for (&row, &derivative) in part {
                let term = factor * amplitudes[row] * derivative;
                sum += term;
                terms += term.norm();
            }
        }
        (sum, terms)
    }
}
