//! Joints that lock a point and a rotation Q(φ) of their own, with or without a displacement along the third axis: six equations.
//!
//! ```text
//! Rᵀ x - d e₃ = 0,      axial(QᵀR) = 0
//! ```
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Motion, Real, Screw};

use super::primitives::JointRotation;
use super::relative_increment::{Angle, CoordinateIncrement, RelativeIncrement};
use super::{Coordinate, Joint, MAX_CONSTANTS, MAX_COORDINATES, MAX_EQUATIONS};

/// Names of the equations.
pub(super) const EQUATIONS: [&str; 6] =
    ["position 1", "position 2", "position 3", "rotation 1", "rotation 2", "rotation 3"];

/// What distinguishes such a joint from the others.
pub(crate) trait Held: Copy + Send + Sync + std::fmt::Debug + 'static {
    /// Its algebraic coordinates.
    const COORDINATES: &'static [Coordinate] = &[];
    /// Index of d among the coordinates; without it d is zero.
    const SLIDE: Option<usize> = None;

    /// Initial coordinates, and the relative motion for which they satisfy the equations.
    fn initial(&self) -> ([f64; MAX_COORDINATES], Motion) {
        ([0.0; MAX_COORDINATES], Motion::identity())
    }

    /// Q for the angles of the coordinates; `kind` only determines the type of number. Called often: inlined always.
    fn rotation<R: Real>(kind: R, angle: impl Fn(usize) -> Angle<R>) -> JointRotation<R>;
}

impl<J: Held> Joint for J {
    const COORDINATES: &'static [Coordinate] = J::COORDINATES;

    fn equations(&self) -> &'static [&'static str] {
        &EQUATIONS
    }

    fn initial(&self) -> ([f64; MAX_COORDINATES], Motion) {
        Held::initial(self)
    }

    #[inline(always)]
    fn violation_change<R: Real>(
        increment: &RelativeIncrement<R>,
        own: &CoordinateIncrement<R>,
        _: &[R; MAX_CONSTANTS],
    ) -> [R; MAX_EQUATIONS] {
        let mut change = J::rotation(increment.place.x, |k| own.angles[k]).held_change(increment);
        if let Some(slide) = J::SLIDE {
            change[2] = change[2] - own.change[slide];
        }
        change
    }

    #[inline(always)]
    fn wrench<R: Real>(
        increment: &RelativeIncrement<R>,
        own: &CoordinateIncrement<R>,
        _: &[R; MAX_CONSTANTS],
        mu: &[R; MAX_EQUATIONS],
    ) -> (Screw<R>, [R; MAX_COORDINATES]) {
        let (wrench, mut own) = J::rotation(mu[0], |k| own.angles[k]).held_wrench(increment, mu);
        if let Some(slide) = J::SLIDE {
            own[slide] = -mu[2];
        }
        (wrench, own)
    }
}
