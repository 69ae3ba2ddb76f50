//! An interval between two configurations, for forces whose work over it equals the change of energy.

use lissom_motion::{Motion, Vector6};

use crate::system::{Kinematics, NodeId};

/// Two configurations joined by body-frame increments, H_to = H_from exp ψ.
#[derive(Clone, Copy, Debug)]
pub struct Interval<'a> {
    /// Where it begins.
    pub from: &'a Kinematics,
    /// Where it ends.
    pub to: &'a Kinematics,
    /// ψ of every node.
    pub increments: &'a [Vector6],
    /// Change of every algebraic coordinate.
    pub coordinate_increments: &'a [f64],
    /// Weight w of the dissipative stress: stresses are C [(ε_from + ε_to)/2 + w (ε_to - ε_from)].
    pub dissipation: f64,
    /// How long it lasts [s]; zero for a jump.
    pub duration: f64,
}

/// Weight of a remainder of the given size: 1 well above round-off, and smoothly 0 below, where the remainder
/// is noise that would be divided by increments that may be small themselves.
pub(crate) fn above_round_off(size: f64, round_off: f64) -> f64 {
    let ratio = (size / round_off).powi(4);
    if ratio.is_finite() { ratio / (1.0 + ratio) } else { 1.0 }
}

/// Gauss points and weights on 0 … 1 for means along the way: their remainder is of seventh order.
pub(crate) const ALONG: [(f64, f64); 3] =
    [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

impl Interval<'_> {
    /// Frame of a node on the way, τ from 0 to 1: H_from exp(τ ψ).
    pub(crate) fn frame(&self, node: NodeId, tau: f64) -> Motion {
        self.from.nodes[node].frame * Motion::exponential(&(tau * self.increments[node]))
    }

    /// Strain rate over the interval for a change of strain; zero over a jump.
    pub(crate) fn rate(&self) -> f64 {
        if self.duration > 0.0 { 1.0 / self.duration } else { 0.0 }
    }
}
