//! A step for strains, violations or potentials that are integrated from their rates at two stages.
//!
//! ```text
//! e_i = e_start + Σ_j d_ij ė_j,      e_end = e_start + Σ_j D_j ė_j,      ė_j = B̃_j V_j
//! B̃_j = B_j + r (W σ_j)ᵀ / Q,        Q = Σ_j D_j σ_j·W σ_j,              r = Δe - Σ_j D_j B_j V_j
//! ```
//!
//! d_ij, D_j durations; B_j gradient at stage j and V_j the velocities there; σ_j ⊂ V_j the part that vanishes in
//! rigid motions, W a metric. So e_end is exactly the strain of the configuration at the end; r is of fourth order in
//! the step.
//! Forces B̃ᵀ C e at the stages do the work of an algebraically stable method, see
//! `docs/theory/energy-decaying.md`.

use std::ops::{Add, Mul};

use lissom_motion::Vector6;

use crate::kinematics::{Kinematics, MotionChange};

/// Relative motions of an element's nodes that change by less than this [rad, element lengths] lose digits in a difference; for
/// these the formulas for small changes are accurate to round-off.
pub const SMALL_CHANGE: f64 = 1e-3;
/// Stages of a step.
pub const STAGES: usize = 2;

/// From the start of a step through two stages to its end.
#[derive(Clone, Copy, Debug)]
pub struct StepStages<'a> {
    /// Start of the step.
    pub start: &'a Kinematics,
    /// Positions, velocities and accelerations at the stages.
    pub stages: [&'a Kinematics; STAGES],
    /// End of the step.
    pub end: &'a Kinematics,
    /// Change of every node's motion from start to end.
    pub changes: &'a [MotionChange],
    /// Integration time of the rates of stage j up to stage i: `durations[i][j]` [s]; may be negative.
    pub durations: [[f64; STAGES]; STAGES],
    /// Integration times up to the end [s].
    pub lasting: [f64; STAGES],
    /// Weights of the stages' changes of position in that at the end.
    pub reached: [f64; STAGES],
    /// A length of the system, to compare translations with rotations [m].
    pub length: f64,
}

impl StepStages<'_> {
    /// Values at the stages, integrated from `start` with the rates there.
    pub fn at_stages<T>(&self, start: T, rates: [T; STAGES]) -> [T; STAGES]
    where
        T: Copy + Add<Output = T> + Mul<f64, Output = T>,
    {
        self.durations.map(|[first, second]| start + rates[0] * first + rates[1] * second)
    }

    /// Change over the whole step with the rates at the stages.
    pub fn whole<T>(&self, rates: [T; STAGES]) -> T
    where
        T: Copy + Add<Output = T> + Mul<f64, Output = T>,
    {
        rates[0] * self.lasting[0] + rates[1] * self.lasting[1]
    }

    /// 1/Q and the rates σ·Wσ/Q by which a remainder is distributed to the stages, from their squares σ·Wσ. Without
    /// motion nothing is distributed.
    pub fn shares(&self, squares: [f64; STAGES]) -> (f64, [f64; STAGES]) {
        let whole = self.whole(squares);
        if whole > f64::MIN_POSITIVE {
            (1.0 / whole, squares.map(|square| square / whole))
        } else {
            (0.0, [0.0; STAGES])
        }
    }
}

/// Weight of a remainder of the given size: 1 well above round-off, and smoothly 0 below, where the remainder is
/// noise that would be divided by rates that may be small themselves.
pub fn above_round_off(size: f64, round_off: f64) -> f64 {
    let ratio = (size / round_off).powi(4);
    if ratio.is_finite() { ratio / (1.0 + ratio) } else { 1.0 }
}

/// A twist with rotations multiplied by a length, so that the sum has one unit.
pub fn weigh(twist: &Vector6, length: f64) -> Vector6 {
    let mut weighted = *twist;
    for k in 3..6 {
        weighted[k] *= length * length;
    }
    weighted
}
