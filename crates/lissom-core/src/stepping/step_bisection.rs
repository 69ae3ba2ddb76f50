//! A planned step that has no solution is taken in parts: halves, as often as necessary. Knows no system.

use serde::{Deserialize, Serialize};

use crate::tuning::{MAX_HALVINGS, Tuning, TuningParameter};

/// Smallest parts a planned step may be cut into.
pub(crate) const MAX_PARTS: u32 = 1 << MAX_HALVINGS;

/// The place within a planned step. Places are whole multiples of the current part's size, so that the end of the
/// planned step is met exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct StepBisection {
    /// Parts done, of [`MAX_PARTS`].
    done: u32,
    /// Parts in the next attempt.
    size: u32,
    /// Parts taken in a row since the size last changed.
    taken: u32,
}

impl StepBisection {
    /// At the start of a planned step that is tried as a whole.
    pub(crate) fn whole() -> Self {
        Self { done: 0, size: MAX_PARTS, taken: 0 }
    }

    /// Fraction of the planned step that the next attempt takes.
    pub(crate) fn fraction(&self) -> f64 {
        f64::from(self.size) / f64::from(MAX_PARTS)
    }

    /// Back to the start of the planned step.
    pub(crate) fn restart(&mut self) {
        self.done = 0;
    }

    /// A part was taken. Whether the end of the planned step is reached.
    pub(crate) fn accept(&mut self, tuning: &Tuning) -> bool {
        self.done += self.size;
        let is_complete = self.done >= MAX_PARTS;
        if is_complete {
            self.done = 0;
        }
        self.taken += 1;
        // A doubled part must end where whole doubled parts end.
        if f64::from(self.taken) >= tuning.of(TuningParameter::StepsToGrow)
            && self.size < MAX_PARTS
            && self.done.is_multiple_of(2 * self.size)
        {
            self.size *= 2;
            self.taken = 0;
        }
        is_complete
    }

    /// A part failed. Whether it is to be tried again with half its size.
    pub(crate) fn halve(&mut self) -> bool {
        self.taken = 0;
        let can_halve = self.size > 1;
        if can_halve {
            self.size /= 2;
        }
        can_halve
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_halve_grow_back_and_meet_the_end_of_every_planned_step() {
        let mut bisection = StepBisection::whole();
        let (mut planned, mut time) = (0, 0.0);
        let mut sizes = Vec::new();
        while planned < 6 {
            let size = bisection.fraction();
            // Between 1.1 and 1.4 nothing longer than 0.1 is possible.
            if size > 0.1 && time + size > 1.1 && time < 1.4 {
                assert!(bisection.halve());
                continue;
            }
            sizes.push(size);
            time += size;
            if bisection.accept(&Tuning::default()) {
                planned += 1;
                assert_eq!(time, f64::from(planned));
            }
        }
        assert_eq!(sizes.iter().copied().fold(1.0, f64::min), 0.0625);
        assert_eq!(sizes.last(), Some(&1.0), "{sizes:?}");
    }

    #[test]
    fn twelve_halvings_are_the_end() {
        let mut bisection = StepBisection::whole();
        let halvings = (0..100).take_while(|_| bisection.halve()).count();
        assert_eq!(halvings, 12);
    }
}
