//! Gaps of the points of two parts that remain large while the parts move little.
//!
//! Legend: (R, p) frame of one part relative to the other, r its radius; a gap changes by no more than its points move,
//!
//! ```text
//! |Δg| ≤ |Δp| + r ‖ΔR‖,      ‖ΔR‖ = 2 sin(θ/2)
//! ```
//!
//! The way between two evaluations is taken from the places of both. A motion that is continued elsewhere is thus a long way, and
//! nothing has to be forgotten.

use lissom_motion::{Motion, Vector3};

/// Gaps of the points of two parts.
pub(super) struct KnownGaps {
    /// Frame of the bounded part relative to the other one at the last evaluation.
    relative: Motion,
    /// Way of the farthest point of the bounded part since the first one [m].
    way: f64,
    /// By point: the last gap that was evaluated plus the way until then [m]; -∞ if it must be evaluated.
    gaps: Vec<f64>,
}

impl KnownGaps {
    /// Gaps of `count` points, of which none has been evaluated.
    pub(super) fn new(count: usize) -> Self {
        Self { relative: Motion::identity(), way: 0.0, gaps: vec![f64::NEG_INFINITY; count] }
    }

    /// Adds the way to parts with these frames and radii [m].
    pub(super) fn follow(&mut self, [base, tip]: [Motion; 2], radii: [f64; 2]) {
        let (relative, radius) = if radii[1] <= radii[0] {
            (tip.relative_to(&base), radii[1])
        } else {
            (base.relative_to(&tip), radii[0])
        };
        let before = std::mem::replace(&mut self.relative, relative);
        let turn = Vector3::from_column_slice(&relative.relative_to(&before).rotation.quaternion()[1..]);
        self.way += (relative.position - before.position).norm() + 2.0 * radius * turn.norm();
    }

    /// Whether the gap of a point is known to be larger than `reach` [m].
    pub(super) fn exceeds(&self, point: usize, reach: f64) -> bool {
        self.gaps[point] - self.way > reach
    }

    /// Records an evaluated gap [m] that is large.
    pub(super) fn insert(&mut self, point: usize, gap: f64) {
        self.gaps[point] = gap + self.way;
    }
}
