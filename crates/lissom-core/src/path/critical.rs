//! Critical points: limit points, where the load factor has an extremum, and bifurcations, where the stiffness is singular without one.
//!
//! Legend: s distance from the last equilibrium, Λ load factor, K stiffness on the constraints. At a limit point dΛ/ds = 0 and the
//! number of negative pivots changes by one; at a bifurcation the number of negative pivots changes while dΛ/ds is not zero.

use super::equations::Condition;
use super::{EquilibriumPath, Solution};
use crate::errors::StepError;
use crate::round_off;
use crate::system::State;
use crate::tuning::MAX_ITERATIONS;

/// Load rate at which a search ends, relative to the rates at the ends of the step.
const FLAT: f64 = 1e-11;

/// Width of the bracket within which the signature is linear, as a step fraction; the relative error of its zero is the square.
const STRAIGHT: f64 = 1e-4;

/// Largest signature at the ends of the bracket of a singular stiffness, relative to the ends of the step.
const CONTINUOUS: f64 = 1e-2;

/// Accuracy of a critical point that counts as located: relative load rate or signature, or step fraction.
const LOCATED: f64 = 1e-6;

/// Kind of a critical point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CriticalKind {
    /// The load factor has an extremum along the path.
    Limit,
    /// Another path crosses.
    Bifurcation,
}

impl CriticalKind {
    /// Name of the kind in `summary.json`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Limit => "limit",
            Self::Bifurcation => "bifurcation",
        }
    }
}

/// An equilibrium with a singular stiffness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CriticalPoint {
    /// Kind of the point.
    pub kind: CriticalKind,
    /// Load factor.
    pub load_factor: f64,
    /// Length of the path up to it.
    pub arc: f64,
    /// Number of unstable directions before and after it.
    pub unstable: [usize; 2],
    /// Whether the point is located accurately. If not, the search ended early, and the point is somewhere in the step.
    pub is_located: bool,
}

/// Evaluated point of a search: distance, load factor, load rate, number of unstable directions, signature.
#[derive(Clone, Copy)]
struct Trial {
    distance: f64,
    load_factor: f64,
    rate: f64,
    unstable: usize,
    signature: f64,
}

/// A change of the number of unstable directions.
struct ChangeOfCount {
    at: Trial,
    /// The nearest evaluated point beyond it.
    beyond: Trial,
    is_located: bool,
    /// Whether the bracket is narrow enough for other changes to be outside.
    is_split: bool,
}

/// Interpolated point between two, with the cubic of the load factor through their values and rates.
fn between(low: Trial, high: Trial, part: f64) -> Trial {
    let width = high.distance - low.distance;
    let change = high.load_factor - low.load_factor;
    let bend = [width * low.rate - change, change - width * high.rate];
    let load_factor =
        low.load_factor + part * change + part * (1.0 - part) * ((1.0 - part) * bend[0] + part * bend[1]);
    Trial {
        distance: low.distance + part * width,
        load_factor,
        rate: low.rate + part * (high.rate - low.rate),
        unstable: low.unstable,
        signature: 0.0,
    }
}

impl EquilibriumPath {
    /// Critical points between the present equilibrium and `found`, at the distance `length`.
    pub(super) fn critical_points(
        &mut self,
        start: &State,
        length: f64,
        found: &Solution,
        iterations: &mut usize,
    ) -> Vec<CriticalPoint> {
        let own = &self.tangent;
        let first = Trial {
            distance: 0.0,
            load_factor: self.load_factor,
            rate: own.load_rate,
            unstable: own.unstable,
            signature: own.signature,
        };
        let last = Trial {
            distance: length,
            load_factor: found.load_factor,
            rate: found.tangent.load_rate,
            unstable: found.tangent.unstable,
            signature: found.tangent.signature,
        };
        let mut points = Vec::new();
        let mut changes = last.unstable.abs_diff(first.unstable);
        if first.rate * last.rate < 0.0 {
            let (at, is_located) = self.zero_of_rate(start, (first, last), iterations);
            changes = changes.saturating_sub(1);
            let after = if changes == 0 { last.unstable } else { at.unstable };
            points.push(self.point(CriticalKind::Limit, (at, is_located), [first.unstable, after]));
        }
        // Several bifurcations in one step are distinguished by the number of unstable directions between them.
        let mut low = first;
        while changes > 0 {
            let found = self.change_of_count(start, (low, last), iterations);
            let after = if found.is_split && low.unstable.abs_diff(found.beyond.unstable) < changes {
                found.beyond
            } else {
                last
            };
            let unstable = [low.unstable, after.unstable];
            points.push(self.point(CriticalKind::Bifurcation, (found.at, found.is_located), unstable));
            changes = changes.saturating_sub(low.unstable.abs_diff(after.unstable).max(1));
            low = after;
        }
        points.sort_by(|a, b| a.arc.total_cmp(&b.arc));
        points
    }

    fn point(
        &self,
        kind: CriticalKind,
        (at, is_located): (Trial, bool),
        unstable: [usize; 2],
    ) -> CriticalPoint {
        let Trial { load_factor, distance, .. } = at;
        CriticalPoint { kind, load_factor, arc: self.arc + distance, unstable, is_located }
    }

    fn trial(&mut self, start: &State, distance: f64, iterations: &mut usize) -> Result<Trial, StepError> {
        let found = self.solve_along(start, Condition::Arc(distance))?;
        *iterations += found.iterations;
        Ok(Trial {
            distance,
            load_factor: found.load_factor,
            rate: found.tangent.load_rate,
            unstable: found.tangent.unstable,
            signature: found.tangent.signature,
        })
    }

    /// Zero of the load rate by the Illinois variant of the false position, and whether it is located accurately.
    fn zero_of_rate(
        &mut self,
        start: &State,
        (first, last): (Trial, Trial),
        iterations: &mut usize,
    ) -> (Trial, bool) {
        let (mut low, mut high) = (first, last);
        let scale = first.rate.abs().max(last.rate.abs());
        let mut weights = [1.0, 1.0];
        let mut best = if low.rate.abs() < high.rate.abs() { low } else { high };
        for _ in 0..MAX_ITERATIONS {
            let (a, b) = (weights[0] * low.rate, weights[1] * high.rate);
            let distance = low.distance - a * (high.distance - low.distance) / (b - a);
            // At the limit point itself the stiffness is singular.
            let Ok(next) = self.trial(start, distance, iterations) else { break };
            if next.rate.abs() < best.rate.abs() {
                best = next;
            }
            if next.rate.abs() <= FLAT * scale
                || high.distance - low.distance <= round_off::ROOT * last.distance
            {
                break;
            }
            if next.rate * low.rate > 0.0 {
                weights = [1.0, 0.5 * weights[1]];
                low = next;
            } else {
                weights = [0.5 * weights[0], 1.0];
                high = next;
            }
        }
        (best, best.rate.abs() <= LOCATED * scale)
    }

    /// Locates a change of the number of unstable directions: the zero of the signature between the two counts.
    fn change_of_count(
        &mut self,
        start: &State,
        (first, last): (Trial, Trial),
        iterations: &mut usize,
    ) -> ChangeOfCount {
        let (mut low, mut high) = (first, last);
        let mut failures = 0;
        for trial in 0..MAX_ITERATIONS {
            let width = high.distance - low.distance;
            if width <= round_off::ROOT * last.distance {
                break;
            }
            let mut part = low.signature / (low.signature - high.signature);
            // Every third time bisect: the signature may be strongly nonlinear.
            if !(part > 0.0 && part < 1.0) || trial % 3 == 2 {
                part = 0.5;
            }
            let part = part.clamp(1e-3, 1.0 - 1e-3);
            // At the bifurcation itself the stiffness is singular: evaluate to the left of it, then to the right.
            let part = match failures {
                0 => part,
                1 => 0.5 * part,
                _ => 0.5 * (1.0 + part),
            };
            let Ok(next) = self.trial(start, low.distance + part * width, iterations) else {
                failures += 1;
                // All three have failed.
                if failures > 2 {
                    break;
                }
                continue;
            };
            failures = 0;
            if next.unstable == first.unstable { low = next } else { high = next }
        }
        let width = high.distance - low.distance;
        let largest = first.signature.abs().max(last.signature.abs());
        let is_singular = low.signature.abs().min(high.signature.abs()) <= LOCATED * largest;
        // If the count changes although the stiffness is not singular, the search has jumped to another path.
        let is_continuous = low.signature.abs().max(high.signature.abs()) <= CONTINUOUS * largest;
        let is_straight = low.signature * high.signature < 0.0 && width <= STRAIGHT * last.distance;
        let is_located = is_singular || (is_continuous && (is_straight || width <= LOCATED * last.distance));
        let is_split = width <= STRAIGHT * last.distance;
        // The signature is proportional to the vanishing eigenvalue, and linear over so short a distance.
        let at = if low.signature * high.signature < 0.0 && width > 0.0 {
            let part = low.signature / (low.signature - high.signature);
            between(low, high, part)
        } else if low.signature.abs() < high.signature.abs() {
            low
        } else {
            high
        };
        ChangeOfCount { at, beyond: high, is_located, is_split }
    }
}
