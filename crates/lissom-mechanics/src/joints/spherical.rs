//! Spherical joint: two nodes share a point and turn freely about it.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Real, Screw, Triple, Vector3};

use super::kind::{Build, Frames, JointKind};
use super::moved::{Moved, OwnMoved};
use super::primitives::{
    POINT_EQUATIONS, coincident, coincident_change, coincident_curvature, coincident_gradient,
    coincident_wrench,
};
use super::{
    Curvature, Equations, Gradient, Joint, MOST_COORDINATES, MOST_EQUATIONS, MOST_NUMBERS, Own, Relative,
};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "spherical",
    summary: "Two nodes share a point and turn freely about it.",
    sample: "",
    parameters: &[],
    build: Build::Relative(Frames::Point, |_, _| Ok(Box::new(Spherical))),
};

/// A shared point.
#[derive(Clone, Copy, Debug)]
pub struct Spherical;

impl Joint for Spherical {
    const MOST: usize = 3;

    fn equations(&self) -> &'static [&'static str] {
        &POINT_EQUATIONS
    }

    fn violation(&self, relative: &Relative, _: &Own) -> Equations {
        let mut out = Equations::default();
        coincident(relative, 0, &mut out);
        out
    }

    #[inline(always)]
    fn violation_change<R: Real>(
        moved: &Moved<R>,
        _: &OwnMoved<R>,
        _: &[R; MOST_NUMBERS],
    ) -> [R; MOST_EQUATIONS] {
        let [a, b, c] = coincident_change(moved);
        let zero = a.like(0.0);
        [a, b, c, zero, zero, zero]
    }

    #[inline(always)]
    fn wrench<R: Real>(
        moved: &Moved<R>,
        _: &OwnMoved<R>,
        _: &[R; MOST_NUMBERS],
        mu: &[R; MOST_EQUATIONS],
    ) -> (Screw<R>, [R; MOST_COORDINATES]) {
        let wrench = coincident_wrench(moved, Triple::new(mu[0], mu[1], mu[2]));
        (wrench, [mu[0].like(0.0); MOST_COORDINATES])
    }

    fn gradient(&self, relative: &Relative, _: &Own, out: &mut Gradient) {
        coincident_gradient(relative, 0, out);
    }

    fn curvature(&self, relative: &Relative, _: &Own, mu: &Equations, out: &mut Curvature) {
        coincident_curvature(relative, &Vector3::new(mu[0], mu[1], mu[2]), out);
    }
}
