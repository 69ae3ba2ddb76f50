//! Steps of one size. A step without solution is bisected as often as necessary. The properties of a scheme's step hold for its
//! parts, and so for the whole.

use serde::{Deserialize, Serialize};

use super::interface::Control;
use crate::bytes::{read_bytes, to_bytes};
use crate::integrator::Attempt;
use crate::tuning::{MAX_HALVINGS, Tuning};

/// After this number of consecutive parts of a planned step the next one is twice as long.
const PARTS_TO_GROW: u32 = 3;
/// If parts of a planned step as short as this have no solution either, a smaller step hardly helps [-].
const SHORT_PART: f64 = 1e-3;

/// Control of steps of one size.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Planned {
    /// Size of the planned steps [s].
    size: f64,
    /// Duration to the target of the present step [s].
    distance: f64,
    bisection: StepBisection,
    /// Whether steps may be bisected.
    may_bisect: bool,
}

impl Planned {
    /// At the start, with steps of `size` [s].
    pub(crate) fn new(size: f64, may_bisect: bool) -> Self {
        Self { size, distance: size, bisection: StepBisection::whole(), may_bisect }
    }
}

impl Control for Planned {
    fn longest(&self) -> f64 {
        self.size
    }

    fn set_planned(&mut self, size: f64) {
        if size != self.size {
            self.size = size;
            self.bisection = StepBisection::whole();
        }
    }

    fn planned(&self) -> Option<f64> {
        Some(self.size)
    }

    fn aim(&mut self, distance: f64, _: f64) {
        self.distance = distance;
        self.bisection.restart();
    }

    fn propose(&mut self) -> f64 {
        self.bisection.fraction() * self.distance
    }

    fn shorten(&mut self, _: f64, _: bool) -> bool {
        self.may_bisect && self.bisection.halve()
    }

    fn accept(&mut self, attempt: &Attempt, _: &Tuning) -> bool {
        attempt.size == self.propose() && self.bisection.accept()
    }

    fn restart(&mut self) {
        self.bisection = StepBisection::whole();
    }

    fn has_tried_shortest(&self) -> bool {
        self.bisection.fraction() <= SHORT_PART
    }

    fn fraction(&self, attempt: &Attempt) -> f64 {
        attempt.size / self.distance
    }

    fn save(&self) -> Vec<u8> {
        to_bytes(&(self.size, self.bisection))
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        read_bytes(saved).map(|learned| (self.size, self.bisection) = learned).is_some()
    }
}

/// Smallest parts of a planned step.
const MAX_PARTS: u32 = 1 << MAX_HALVINGS;

/// The position within a planned step. Positions are whole multiples of the size of the present part, so that the end
/// of the planned step is reached exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct StepBisection {
    /// Parts done, of [`MAX_PARTS`].
    done: u32,
    /// Size of the next attempt in parts.
    size: u32,
    /// Attempts accepted in a row since the size last changed.
    taken: u32,
}

impl StepBisection {
    /// At the start of a planned step that is tried as a whole.
    fn whole() -> Self {
        Self { done: 0, size: MAX_PARTS, taken: 0 }
    }

    /// Size of the next attempt as a fraction of the planned step.
    fn fraction(&self) -> f64 {
        f64::from(self.size) / f64::from(MAX_PARTS)
    }

    /// Back to the start of the planned step.
    fn restart(&mut self) {
        self.done = 0;
    }

    /// Records an accepted part. Whether the end of the planned step is reached.
    fn accept(&mut self) -> bool {
        self.done += self.size;
        let is_complete = self.done >= MAX_PARTS;
        if is_complete {
            self.done = 0;
        }
        self.taken += 1;
        // A doubled part must end at a multiple of its size.
        if self.taken >= PARTS_TO_GROW && self.size < MAX_PARTS && self.done.is_multiple_of(2 * self.size) {
            self.size *= 2;
            self.taken = 0;
        }
        is_complete
    }

    /// Records a failed part. Whether it is to be repeated with half its size.
    fn halve(&mut self) -> bool {
        self.taken = 0;
        let can_halve = self.size > 1;
        if can_halve {
            self.size /= 2;
        }
        can_halve
    }
}

#[cfg(test)]
#[path = "../../tests/unit/control/planned.rs"]
mod tests;
