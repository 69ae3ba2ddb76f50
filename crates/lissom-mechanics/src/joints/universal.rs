//! Universal joint: two nodes share a point; the tip turns about an axis of the base, then about an
//! axis of its own. Both angles are algebraic coordinates.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Real, Screw, Vector3};

use super::clamp::EQUATIONS;
use super::kind::{Build, Frames, JointKind};
use super::moved::{Moved, OwnMoved};
use super::primitives::{JointRotation, coincident, coincident_curvature, coincident_gradient};
use super::{
    Coordinate, Curvature, Equations, Gradient, Joint, MOST_COORDINATES, MOST_EQUATIONS, MOST_NUMBERS, Own,
    Relative,
};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "universal",
    summary: "Two nodes share a point and a cross of two axes; both rotations are coordinates.",
    sample: "axis = [1.0, 0.0, 0.0]\nsecond_axis = [0.0, 1.0, 0.0]",
    parameters: &[],
    build: Build::Relative(Frames::TwoAxes, |_, _| Ok(Box::new(Universal))),
};

/// A shared point and a cross.
#[derive(Clone, Copy, Debug)]
pub struct Universal;

impl Joint for Universal {
    const COORDINATES: &'static [Coordinate] =
        &[Coordinate::rotation("first angle"), Coordinate::rotation("second angle")];

    fn equations(&self) -> &'static [&'static str] {
        &EQUATIONS
    }

    fn violation(&self, relative: &Relative, own: &Own) -> Equations {
        let mut out = Equations::default();
        coincident(relative, 0, &mut out);
        JointRotation::about_first_and_second_axis(&[own.angle(0), own.angle(1)])
            .matches(relative, 3, &mut out);
        out
    }

    #[inline(always)]
    fn violation_change<R: Real>(
        moved: &Moved<R>,
        own: &OwnMoved<R>,
        _: &[R; MOST_NUMBERS],
    ) -> [R; MOST_EQUATIONS] {
        JointRotation::about_first_and_second_axis(&own.angles).held_change(moved)
    }

    #[inline(always)]
    fn wrench<R: Real>(
        moved: &Moved<R>,
        own: &OwnMoved<R>,
        _: &[R; MOST_NUMBERS],
        mu: &[R; MOST_EQUATIONS],
    ) -> (Screw<R>, [R; MOST_COORDINATES]) {
        JointRotation::about_first_and_second_axis(&own.angles).held_wrench(moved, mu)
    }

    fn gradient(&self, relative: &Relative, own: &Own, out: &mut Gradient) {
        coincident_gradient(relative, 0, out);
        JointRotation::about_first_and_second_axis(&[own.angle(0), own.angle(1)])
            .matches_gradient(relative, 3, out);
    }

    fn curvature(&self, relative: &Relative, own: &Own, mu: &Equations, out: &mut Curvature) {
        coincident_curvature(relative, &Vector3::new(mu[0], mu[1], mu[2]), out);
        JointRotation::about_first_and_second_axis(&[own.angle(0), own.angle(1)]).matches_curvature(
            relative,
            &Vector3::new(mu[3], mu[4], mu[5]),
            out,
        );
    }
}
