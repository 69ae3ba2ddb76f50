//! Derivatives of recorded quantities with respect to the unknowns of the linear model.
//!
//! ```text
//! δy = c_q δq + c_v δv + c_a δa + c_λ δλ + c_u δu
//! ```
//!
//! q positions (body variations and coordinates), v twists and rates, a their derivatives, λ multipliers, u held values. About a
//! moving state the unknowns are departures η from extrapolation, δv = η̇ + ad_V η and δa = η̈ + ad_V η̇ + ad_V̇ η.

use std::collections::BTreeMap;

use lissom_motion::{Vector6, lie_bracket_matrix};

use super::model::LinearModel;
use crate::kinematics::{LOCKED, NodeId};

pub use crate::system::OutputDerivatives;

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
