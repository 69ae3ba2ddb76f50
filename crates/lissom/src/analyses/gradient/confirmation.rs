//! Verification of direct derivatives by runs of neighbouring models, with all numbers changed at once.
//!
//! Legend: y the measure, θ_k numbers, g_k their derivatives, δ_k changes of the numbers with the signs of g_k.
//!
//! ```text
//! y(θ + δ) - y(θ) = Σ_k g_k δ_k + ...
//! ```
//!
//! All numbers contribute equally, as far as round-off and small changes allow, so no derivative is hidden by a larger one. One
//! run confirms correct derivatives. Otherwise a second run with the opposite change eliminates the quadratic term. If the two do
//! not confirm them either, two runs with smaller changes show whether such differences determine the derivative at all.

use super::GradientError;

/// Relative change of the number with the largest contribution.
const CHANGE: f64 = 1e-4;
/// The largest relative change of a number.
const MAX_CHANGE: f64 = 1e-3;
/// Ratio of the changes of the last runs to the first ones.
const NEARER: f64 = 0.125;
/// Allowed difference between runs and derivatives, relative to the predicted change.
const MISSED: f64 = 1e-3;
/// Round-off and iteration error in a difference of runs, relative to the largest value.
const ROUND_OFF: f64 = 1e-11;
/// Predicted changes below this multiple of the round-off cannot be measured.
const SEEN: f64 = 10.0;
/// Required contribution of a number, as a multiple of the round-off, if a sufficiently small change has it.
const CLEAR: f64 = 1e4;
/// Differences over both distances that agree to this fraction of their deviation contradict the derivatives.
const AGREES: f64 = 0.25;

/// Result of the verification.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Confirmation {
    /// The runs agree with the derivatives.
    Confirmed {
        /// The difference, relative to the predicted change.
        missed: f64,
        /// Number of runs.
        runs: usize,
    },
    /// The runs are inconclusive: the output changes less than the error of runs, or not smoothly.
    Untold {
        /// Number of runs.
        runs: usize,
    },
}

/// A number, and the derivative with respect to it.
pub(super) struct DirectDerivative {
    pub(super) number: f64,
    pub(super) derivative: f64,
}

/// Compares derivatives with runs. `measure` runs the model with its numbers changed by these amounts; `value` is the measure
/// without changes, and `scale` the largest value of the column.
///
/// # Errors
/// If the runs determine derivatives, and these are different.
pub(super) fn confirm(
    carried: &[DirectDerivative],
    (value, scale): (f64, f64),
    measure: &mut dyn FnMut(&[f64]) -> Result<f64, GradientError>,
) -> Result<Confirmation, GradientError> {
    let round_off = ROUND_OFF * scale.max(value.abs());
    let changes = changes(carried, round_off);
    let expected: f64 = carried.iter().zip(&changes).map(|(of, change)| of.derivative * change).sum();
    let mut runs = 0;
    let mut difference = |share: f64| {
        runs += 1;
        let changes: Vec<f64> = changes.iter().map(|change| share * change).collect();
        // A neighbouring model without a solution is inconclusive.
        let found = measure(&changes).map_or(f64::NAN, |changed| (changed - value) / share);
        (found, runs)
    };
    let is_near = |found: f64| (found - expected).abs() <= MISSED * expected.abs() + round_off;
    let confirmed = |(found, runs): (f64, usize)| {
        let size = expected.abs().max(f64::MIN_POSITIVE);
        Confirmation::Confirmed { missed: ((found - expected) / size).abs(), runs }
    };
    let above = difference(1.0);
    if expected.abs() <= SEEN * round_off {
        // Small derivatives with measurable changes are wrong, and are examined below.
        if is_near(above.0) {
            return Ok(Confirmation::Untold { runs: above.1 });
        }
    } else if is_near(above.0) {
        return Ok(confirmed(above));
    }
    let below = difference(-1.0);
    let both = (0.5 * (above.0 + below.0), below.1);
    if is_near(both.0) {
        return Ok(confirmed(both));
    }
    let sides = [NEARER, -NEARER].map(&mut difference);
    let nearby = (0.5 * (sides[0].0 + sides[1].0), sides[1].1);
    if is_near(nearby.0) {
        return Ok(confirmed(nearby));
    }
    let least = (both.0 - expected).abs().min((nearby.0 - expected).abs());
    if (both.0 - nearby.0).abs() <= AGREES * least {
        return Err(GradientError::Denied { expected, found: nearby.0 });
    }
    Ok(Confirmation::Untold { runs: nearby.1 })
}

/// Changes of the numbers, in the direction in which the measure increases. All contribute as much as the weakest one can, if
/// that is clearly above the round-off.
fn changes(carried: &[DirectDerivative], round_off: f64) -> Vec<f64> {
    let effect = |of: &DirectDerivative| (of.derivative * of.number).abs();
    let effects = || carried.iter().map(effect);
    let (least, most) = (effects().fold(f64::INFINITY, f64::min), effects().fold(0.0, f64::max));
    let each = (MAX_CHANGE * least).max(CLEAR * round_off).min(CHANGE * most);
    let change = |of: &DirectDerivative| {
        let share = if effect(of) > 0.0 { (each / effect(of)).min(MAX_CHANGE) } else { MAX_CHANGE };
        share * of.number.abs() * if of.derivative < 0.0 { -1.0 } else { 1.0 }
    };
    carried.iter().map(change).collect()
}

#[cfg(test)]
#[path = "../../../tests/unit/analyses/gradient/confirmation.rs"]
mod tests;
