//! Which steps are examined for quantities that last: all load steps, and of a motion the first ones, then one in some.

use serde::{Deserialize, Serialize};

/// Steps from one that is examined to the next, and number of the first ones: the strains of a beam cost a twentieth of its
/// step.
const STRIDE: usize = 16;

/// Position in the sequence of steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct SampledSteps(usize);

impl SampledSteps {
    /// Counts a step. Whether it is examined.
    pub(super) fn is_due(&mut self, is_motion: bool) -> bool {
        self.0 += 1;
        !is_motion || self.0 <= STRIDE || self.0.is_multiple_of(STRIDE)
    }
}
