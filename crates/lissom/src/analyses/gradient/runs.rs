//! Derivatives by differences of whole runs, if forces switch during the run: a stop that closes, a spring that goes slack, free
//! play that is used up. The instant of a switch depends on the numbers, which direct differentiation along fixed steps neglects.
//!
//! ```text
//! D(h) = (y(θ + h) - y(θ - h))/2h,      y' = (16 D(h/4) - D(h))/15 + O(h⁴)
//! ```

use super::GradientError;

/// The first distance, relative to the number.
const APART: f64 = 2e-3;
/// Ratio of the next distance to the previous one.
const NEARER: f64 = 0.25;
const DISTANCES: i32 = 4;
/// Differences over two distances that differ by less than this fraction confirm each other …
const AGREES: f64 = 2e-3;
/// … as do differences below this fraction of the largest value over the number, which are round-off.
const ROUND_OFF: f64 = 1e-8;

/// A derivative by runs.
pub(super) struct ByRuns {
    pub(super) value: f64,
    /// Difference between the results over two distances, relative to the derivative.
    pub(super) missed: f64,
    pub(super) runs: usize,
}

/// The derivative with respect to `number`; `measure` is the measure of a run with another value, `scale` the largest value
/// of the column.
///
/// # Errors
/// If differences over no two distances agree.
pub(super) fn by_runs(
    path: &str,
    number: f64,
    scale: f64,
    measure: &mut dyn FnMut(f64) -> Result<f64, GradientError>,
) -> Result<ByRuns, GradientError> {
    let mut last: Option<f64> = None;
    let mut failure = None;
    let mut runs = 0;
    for k in 0..DISTANCES {
        let apart = APART * number.abs() * NEARER.powi(k);
        let mut at = |value: f64| {
            runs += 1;
            measure(value)
        };
        let found = match (at(number + apart), at(number - apart)) {
            (Ok(above), Ok(below)) => (above - below) / (2.0 * apart),
            (Err(error), _) | (_, Err(error)) => {
                (last, failure) = (None, Some(error));
                continue;
            }
        };
        if let Some(before) = last {
            let difference = (found - before).abs();
            let round_off = ROUND_OFF * scale / number.abs();
            if difference <= AGREES * found.abs() + round_off {
                let share = NEARER * NEARER;
                let value = (found - share * before) / (1.0 - share);
                let missed = difference / value.abs().max(round_off).max(f64::MIN_POSITIVE);
                return Ok(ByRuns { value, missed, runs });
            }
        }
        last = Some(found);
    }
    Err(failure.unwrap_or_else(|| GradientError::NotSmooth { path: path.to_owned() }))
}

#[cfg(test)]
#[path = "../../../tests/unit/analyses/gradient/runs.rs"]
mod tests;
