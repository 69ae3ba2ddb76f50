//! Revolute joint: two nodes share a point and an axis; the relative rotation about the axis is an
//! algebraic coordinate, so that springs, drives and outputs can use it.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Motion, Real, Screw, Vector3};

use super::clamp::EQUATIONS;
use super::kind::{Build, Frames, JointKind};
use super::moved::{Moved, OwnMoved};
use super::primitives::{JointRotation, coincident, coincident_curvature, coincident_gradient, elementary};
use super::{
    Coordinate, Curvature, Equations, Gradient, Joint, MOST_COORDINATES, MOST_EQUATIONS, MOST_NUMBERS, Own,
    Relative,
};
use crate::registry::ANGLE_AT_START;

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "revolute",
    summary: "Two nodes share a point and an axis; the relative rotation is a coordinate.",
    sample: "axis = [0.0, 0.0, 1.0]",
    parameters: &[ANGLE_AT_START],
    build: Build::Relative(Frames::Axis, |parameters, _| {
        Ok(Box::new(Revolute { angle: parameters.number_or("angle", 0.0)? }))
    }),
};

/// A shared point and axis.
#[derive(Clone, Copy, Debug)]
pub struct Revolute {
    /// Relative rotation at the start [rad].
    angle: f64,
}

impl Joint for Revolute {
    const COORDINATES: &'static [Coordinate] = &[Coordinate::rotation("angle")];

    fn equations(&self) -> &'static [&'static str] {
        &EQUATIONS
    }

    fn initial(&self) -> ([f64; MOST_COORDINATES], Motion) {
        let rotation = lissom_motion::Rotation::from_matrix(&elementary(2, self.angle));
        ([self.angle, 0.0], Motion::new(rotation, Vector3::zeros()))
    }

    fn violation(&self, relative: &Relative, own: &Own) -> Equations {
        let mut out = Equations::default();
        coincident(relative, 0, &mut out);
        JointRotation::about_third_axis(&own.angle(0)).matches(relative, 3, &mut out);
        out
    }

    #[inline(always)]
    fn violation_change<R: Real>(
        moved: &Moved<R>,
        own: &OwnMoved<R>,
        _: &[R; MOST_NUMBERS],
    ) -> [R; MOST_EQUATIONS] {
        JointRotation::about_third_axis(&own.angles[0]).held_change(moved)
    }

    #[inline(always)]
    fn wrench<R: Real>(
        moved: &Moved<R>,
        own: &OwnMoved<R>,
        _: &[R; MOST_NUMBERS],
        mu: &[R; MOST_EQUATIONS],
    ) -> (Screw<R>, [R; MOST_COORDINATES]) {
        JointRotation::about_third_axis(&own.angles[0]).held_wrench(moved, mu)
    }

    fn gradient(&self, relative: &Relative, own: &Own, out: &mut Gradient) {
        coincident_gradient(relative, 0, out);
        JointRotation::about_third_axis(&own.angle(0)).matches_gradient(relative, 3, out);
    }

    fn curvature(&self, relative: &Relative, own: &Own, mu: &Equations, out: &mut Curvature) {
        coincident_curvature(relative, &Vector3::new(mu[0], mu[1], mu[2]), out);
        JointRotation::about_third_axis(&own.angle(0)).matches_curvature(
            relative,
            &Vector3::new(mu[3], mu[4], mu[5]),
            out,
        );
    }
}
