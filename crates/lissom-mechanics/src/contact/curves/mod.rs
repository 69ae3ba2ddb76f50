//! Curves of solids with which they touch surfaces. A kind of curve is one file.

mod segment;

pub use segment::Segment;

use lissom_motion::Vector3;

/// A curve in the axes of a solid.
pub trait Curve: std::fmt::Debug + Send + Sync {
    /// The point c(t) [m], c' and c''.
    fn point(&self, t: f64) -> [Vector3; 3];

    /// Distance w by which the solid is thinner at t than at its thickest point [m], w' and w''. Default: none.
    fn crown(&self, _t: f64) -> [f64; 3] {
        [0.0; 3]
    }

    /// Ascending parameters between which the distance from a surface has at most one minimum; of an open curve with both ends. Two
    /// if the whole curve is such an interval.
    fn samples(&self) -> &[f64];

    /// Parameters around a sample between which it is the only one.
    fn beside(&self, sample: usize) -> (f64, f64) {
        let samples = self.samples();
        let last = samples.len() - 1;
        if self.is_closed() {
            let mean = (samples[last] - samples[0]) / last as f64;
            let before = if sample > 0 { samples[sample - 1] } else { samples[0] - mean };
            let after = if sample < last { samples[sample + 1] } else { samples[last] + mean };
            (before, after)
        } else {
            (samples[sample.saturating_sub(1)], samples[(sample + 1).min(last)])
        }
    }

    /// Whether it has no ends. Default: it has two.
    fn is_closed(&self) -> bool {
        false
    }

    /// Largest distance from the origin [m].
    fn reach(&self) -> f64;
}
