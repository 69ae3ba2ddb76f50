//! Equality of two instants: those of samples, breakpoints, records and ends of steps are computed in different ways and
//! differ by round-off. A step between two of them would be so short that its accelerations are round-off.

use crate::round_off;

/// Instants closer than this fraction of a step, or of a sample period, are equal [-].
pub const TIME_TOLERANCE: f64 = 1e-9;
/// Round-off accumulated in a clock may reach this fraction of its step before it is considered an intended difference.
const MAX_ACCUMULATED: f64 = 1e-3;

/// Distance below which two instants near `time` [s] are equal if steps, or sample periods, are `duration` [s] long.
pub fn tolerance(time: f64, duration: f64) -> f64 {
    TIME_TOLERANCE * duration + round_off::OPERATIONS * time.abs()
}

/// Distance below which instants are equal if one is `elapsed` [s] from the start in an external clock that has added steps of
/// `duration` [s]: the rounding errors of all additions may have one sign.
///
/// ```text
/// n = elapsed/duration additions, each with an error of at most ε |t|/2
/// ```
pub fn accumulated_tolerance(time: f64, elapsed: f64, duration: f64) -> f64 {
    let additions = (elapsed / duration).abs();
    let accumulated = 0.5 * f64::EPSILON * time.abs() * additions;
    tolerance(time, duration).max(accumulated.min(MAX_ACCUMULATED * duration))
}

/// Whether a sample is due at `time` [s], `elapsed` [s] after the first one.
pub fn is_due(time: f64, elapsed: f64, period: f64) -> bool {
    let nearest = (elapsed / period).round() * period;
    (elapsed - nearest).abs() <= tolerance(time, period)
}

#[cfg(test)]
#[path = "../tests/unit/instants.rs"]
mod tests;
