//! Derivatives of a recorded quantity with respect to the unknowns of the linear model.
//!
//! ```text
//! δy = c_q δq + c_v δv + c_a δa + c_λ δλ + c_u δu
//! ```
//!
//! q positions (body variations and coordinates), v twists and rates, a their derivatives, λ multipliers, u held values. About a
//! moving state the unknowns are departures η from extrapolation, δv = η̇ + ad_V η and δa = η̈ + ad_V η̇ + ad_V̇ η.

use std::collections::BTreeMap;

use lissom_motion::{Vector6, lie_bracket_matrix};
use num_complex::Complex64;

use super::model::LinearModel;
use crate::kinematics::{LOCKED, NodeId};
use crate::signals::DiscreteValueId;

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

impl LinearModel<'_> {
    /// Derivatives with respect to the unknowns of this model, from those with respect to positions, twists and
    /// accelerations.
    #[must_use]
    pub fn along_departures(&self, mut output: OutputDerivatives) -> OutputDerivatives {
        if self.is_at_rest() {
            return output;
        }
        let layout = self.system.layout();
        for (node, motion) in NodeId::enumerate(&self.at.nodes) {
            let rows = layout.rows_of_node(node);
            let own = |of: &BTreeMap<usize, f64>| {
                Vector6::from_fn(|k, _| of.get(&(rows[k] as usize)).copied().unwrap_or(0.0))
            };
            let (by_rate, by_acceleration) = (own(&output.by_rate), own(&output.by_acceleration));
            if by_rate == Vector6::zeros() && by_acceleration == Vector6::zeros() {
                continue;
            }
            let turning = lie_bracket_matrix(&motion.twist);
            let to_place =
                turning.tr_mul(&by_rate) + lie_bracket_matrix(&motion.acceleration).tr_mul(&by_acceleration);
            let to_rate = turning.tr_mul(&by_acceleration);
            for (k, &row) in rows.iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
                *output.by_place.entry(row as usize).or_insert(0.0) += to_place[k];
                *output.by_rate.entry(row as usize).or_insert(0.0) += to_rate[k];
            }
        }
        output
    }
}
