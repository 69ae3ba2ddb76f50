//! Which steps are examined for quantities that last: all at first, as short runs have few, then one in some.

use serde::{Deserialize, Serialize};

/// So many steps are all examined.
const ALL_UNTIL: usize = 64;
/// Steps from one that is examined to the next afterwards: a strain or a section force costs a few per cent of a step.
const STRIDE: usize = 16;

/// Position in the sequence of steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct SampledSteps(usize);

impl SampledSteps {
    /// Counts a step. Whether it is examined.
    pub(super) fn is_due(&mut self) -> bool {
        self.0 += 1;
        self.0 <= ALL_UNTIL || self.0.is_multiple_of(STRIDE)
    }
}
