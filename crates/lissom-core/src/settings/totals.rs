//! What a step took, and all steps together.

use serde::{Deserialize, Serialize};

/// What a step took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepReport {
    /// Newton iterations, those of attempts that were given up included.
    pub iterations: usize,
    /// Tangents factored, likewise.
    pub factorizations: usize,
    /// Attempts given up.
    pub rejected: usize,
    /// Parts the step was taken in.
    pub parts: usize,
    /// Size of the last correction [-].
    pub correction: f64,
    /// Whether iterations ended at round-off rather than at the tolerance.
    pub stagnated: bool,
    /// Estimated error over the tolerance, with step-size control [-].
    pub error: Option<f64>,
}

/// Sums over all steps so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Totals {
    /// Steps completed; a planned step that was taken in parts counts as so many.
    pub steps: usize,
    /// Steps given up and tried again.
    pub rejected_steps: usize,
    /// Newton iterations.
    pub newton_iterations: usize,
    /// Tangents factored.
    pub factorizations: usize,
    /// Steps whose iterations ended at round-off.
    pub stagnated_steps: usize,
    /// Smallest pivot over largest diagonal entry, over all factorisations.
    pub smallest_relative_pivot: f64,
    /// Largest carried violation of a constraint [m, rad].
    pub max_constraint_violation: f64,
    /// The unknown whose pivot vanished, so that the run went on with a pivoting solver.
    pub fell_back_at: Option<usize>,
    /// The multiplier whose pivot vanished because its constraint repeats others, so that all of them yield a little.
    pub regularized_at: Option<usize>,
}
