//! Which steps of planned size are examined: at intervals, two consecutive ones of one size, a pair.

use serde::{Deserialize, Serialize};

/// Steps or parts from one pair to the next: with the two estimates in sixteen steps a chain of ten rigid bodies took four per
/// cent more instructions.
pub(super) const STRIDE: u32 = 64;
/// Steps or parts before the first pair.
pub(super) const FIRST: u32 = 4;

/// Position in the sequence of steps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Pairs {
    /// Steps and parts until the next pair.
    wait: u32,
    /// Whether the last step is the first one of a pair.
    pub(super) has_first: bool,
    /// Size of the last step over that of a planned one.
    pub(super) fraction: f64,
}

impl Pairs {
    pub(super) fn new() -> Self {
        Self { wait: FIRST, has_first: false, fraction: 0.0 }
    }

    /// Counts a step that is this fraction of a planned step. Returns whether it is examined.
    pub(super) fn is_due(&mut self, fraction: f64) -> bool {
        self.wait = self.wait.saturating_sub(1);
        self.has_first &= fraction == self.fraction;
        self.fraction = fraction;
        self.wait == 0
    }

    /// Records that a step was examined. Whether it completes a pair.
    pub(super) fn is_complete(&mut self) -> bool {
        let is_complete = std::mem::replace(&mut self.has_first, true);
        if is_complete {
            (self.has_first, self.wait) = (false, STRIDE - 1);
        }
        is_complete
    }
}
