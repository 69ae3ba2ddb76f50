//! Zeroed scratch vectors for the local forces of elements.

use std::cell::RefCell;

use crate::kinematics::USUAL_UNKNOWNS;
use crate::kinematics::step_stages::STAGES;

thread_local! {
    /// Scratch of elements with more unknowns than usual, for each work within another one.
    static LARGE_SCRATCH: RefCell<Vec<Vec<f64>>> = const { RefCell::new(Vec::new()) };
}

/// Calls `work` with the given number of zeros. Only the first large element of a thread allocates.
pub fn with_scratch<R>(size: usize, work: impl FnOnce(&mut [f64]) -> R) -> R {
    if size <= STAGES * USUAL_UNKNOWNS {
        return work(&mut [0.0; STAGES * USUAL_UNKNOWNS][..size]);
    }
    let mut scratch = LARGE_SCRATCH.with_borrow_mut(Vec::pop).unwrap_or_default();
    scratch.clear();
    scratch.resize(size, 0.0);
    let result = work(&mut scratch);
    LARGE_SCRATCH.with_borrow_mut(|all| all.push(scratch));
    result
}
