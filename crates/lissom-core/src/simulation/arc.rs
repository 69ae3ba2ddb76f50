//! Step length control along an equilibrium path: limited by Newton's convergence, the rotation of nodes and the curvature of the path.

/// Newton iterations of a step of suitable length.
const EASY: f64 = 7.0;
/// Smallest and largest ratio of consecutive steps.
const CHANGE: (f64, f64) = (0.5, 1.7);
/// Longest step: largest displacement over the model's length, and rotation, of any node [-, rad].
const MAX_TURN: f64 = 0.2;
/// Cosine of the angle between the tangents of a step: below the first the next step is halved, below the second it is rejected.
const BENT: (f64, f64) = (0.96, 0.8);
/// Allowed angle between the chord of a step and the mean of its tangents: a fraction of the angle between these, plus a constant
/// [rad].
const OFF_THE_ARC: (f64, f64) = (0.3, 0.05);
/// Steps longer than this fraction of the longest one so far are refined if they contain several critical points.
const WORTH_REFINING: f64 = 1e-3;
/// Steps shorter than this fraction of the longest one so far are not tried.
const SHORTEST: f64 = 1e-9;

/// Length control [-].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ArcControl {
    size: f64,
    longest: f64,
}

impl ArcControl {
    /// Starts with the length of the first step.
    pub(crate) fn new(size: f64) -> Self {
        Self { size, longest: size }
    }

    /// Continues with another step length, on another path.
    pub(crate) fn restart(&mut self, size: f64) {
        self.size = size;
    }

    /// Length of the next step; `turn` is the largest displacement or rotation per unit of path length.
    pub(crate) fn propose(&self, turn: f64) -> f64 {
        self.size.min(MAX_TURN / turn)
    }

    /// Whether the angle between the tangents of a step, given by its cosine, is so large that the step may have changed paths.
    pub(crate) fn is_too_bent(cosine: f64) -> bool {
        cosine < BENT.1
    }

    /// Whether the chord of a step deviates from the mean of the tangents by more than the curvature of a smooth path explains.
    /// Given are the cosines of that angle and of the angle between the tangents.
    pub(crate) fn is_off_the_arc(of_chord: f64, of_tangents: f64) -> bool {
        let [chord, tangents] = [of_chord, of_tangents].map(|cosine| cosine.clamp(-1.0, 1.0).acos());
        chord > OFF_THE_ARC.0 * tangents + OFF_THE_ARC.1
    }

    /// Whether a step that contains several critical points is long enough to be refined.
    pub(crate) fn is_long(&self, size: f64) -> bool {
        size > WORTH_REFINING * self.longest
    }

    /// Records a converged step of this length and its number of iterations.
    pub(crate) fn accept(&mut self, size: f64, iterations: usize, cosine: f64) {
        let ease = (EASY / iterations.max(1) as f64).sqrt();
        let factor = if cosine < BENT.0 { ease.min(CHANGE.0) } else { ease };
        self.size = size * factor.clamp(CHANGE.0, CHANGE.1);
        self.longest = self.longest.max(self.size);
    }

    /// Records that a step of this length failed. Returns whether a shorter one may be tried.
    pub(crate) fn reject(&mut self, size: f64) -> bool {
        self.size = 0.5 * size;
        self.size > SHORTEST * self.longest
    }
}
