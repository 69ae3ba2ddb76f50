//! The law of impacts, whoever solves them.
//!
//! Legend: by contact, γ impulse on the tip along the normal (γ_n) and two tangents (γ_t), u velocity before (-) and after (+) the impact,
//! e restitution, μ friction; s share of the rebounds, E(s) kinetic energy that they return, E₀ energy that is lost without them.
//!
//! ```text
//! 0 ≤ γ_n ⊥ u_n⁺ - s e |u_n⁻| ≥ 0,      |γ_t| ≤ μ γ_n,   opposed to u_t⁺ where it is not zero
//! s the largest in [0, 1] with E(s) ≤ E₀
//! ```
//!
//! These are Signorini's condition with Newton's law of restitution, Coulomb's law, and a bound of the energy that restitution at some
//! contacts and friction at others would gain.
//!
//! There are two iterations. Rigid contacts are few, their compliance is dense and may be singular, and their forces decide between
//! modes: [`dense`] finds them to round-off. A set has many touches, and its matrix is sparse: `integrator/impacts.rs` finds velocities to
//! the accuracy of a step. Where contacts with friction repeat each other, impulses are not unique, and the iterations find different ones.

pub(crate) mod dense;

use lissom_motion::Vector3;

/// Two tangents that are orthogonal to a normal and to each other.
pub(crate) fn tangents(normal: &Vector3) -> [Vector3; 2] {
    let first = normal.cross(&Vector3::ith(normal.iamin(), 1.0)).normalize();
    [first, normal.cross(&first)]
}

/// Search for the share of the rebounds.
pub(crate) struct Rebounds {
    /// E₀ [J].
    lost: f64,
    /// Energies [J]: a gain that is round-off, and one that may remain unused.
    tolerances: [f64; 2],
    /// Solutions that may follow.
    remaining: usize,
    /// s and E(s): of the largest share that gains no energy, and of the smallest that does.
    low: [f64; 2],
    high: [f64; 2],
    share: f64,
}

impl Rebounds {
    /// With at most so many solutions.
    pub(crate) fn new(lost: f64, tolerances: [f64; 2], solutions: usize) -> Self {
        Self { lost, tolerances, remaining: solutions, low: [0.0; 2], high: [1.0, f64::INFINITY], share: 1.0 }
    }

    /// The share of the next solution; none at the end.
    pub(crate) fn next_share(&self) -> Option<f64> {
        (self.remaining > 0).then_some(self.share)
    }

    /// Records the energy that the rebounds of this share return [J]. Whether the solution is the best so far.
    pub(crate) fn record(&mut self, returned: f64) -> bool {
        let [gain, unused] = self.tolerances;
        self.remaining -= 1;
        let is_best = returned - self.lost <= gain;
        if is_best {
            self.low = [self.share, returned];
            if self.share == 1.0 || self.lost - returned < unused || self.remaining <= 1 {
                self.remaining = 0;
            }
        } else {
            self.high = [self.share, returned];
        }
        let missing = (self.lost - self.low[1]).max(0.0) / (self.high[1] - self.low[1]);
        let part = if self.low[0] > 0.0 { 0.9 * missing } else { 0.99 * missing.sqrt() };
        self.share = self.low[0] + (self.high[0] - self.low[0]) * part.clamp(0.05, 0.98);
        is_best
    }

    /// s; none if every rebound gains energy.
    pub(crate) fn found(&self) -> Option<f64> {
        (self.low[0] > 0.0).then_some(self.low[0])
    }
}

#[cfg(test)]
#[path = "../../tests/unit/impacts/mod.rs"]
mod tests;
