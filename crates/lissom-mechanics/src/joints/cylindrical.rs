//! Cylindrical joint: the tip slides along an axis of the base and rotates about it. Rotation and displacement are
//! algebraic coordinates: x = d e₃ in the joint frame, R = Q(φ).
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Motion, Real, Rotation, Screw, Vector3};

use super::clamp::EQUATIONS;
use super::kind::{Build, JointKind};
use super::primitives::{JointRotation, coincident_gradient, coincident_hessian, elementary, on_third_axis};
use super::relative_increment::{CoordinateIncrement, RelativeIncrement};
use super::{
    ConstraintHessian, Coordinate, Equations, Gradient, Joint, JointCoordinates, MAX_CONSTANTS,
    MAX_COORDINATES, MAX_EQUATIONS, Relative,
};
use crate::ports::Ports;
use crate::registry::{ANGLE_AT_START, DISPLACEMENT_AT_START, RATE_AT_START, VELOCITY_AT_START};

/// Index of the displacement among the coordinates, after the rotation.
const SLIDE: usize = 1;

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "cylindrical",
    summary: "The tip slides along an axis and rotates about it; rotation and displacement are coordinates.",
    sample: "axis = [1.0, 0.0, 0.0]",
    parameters: &[ANGLE_AT_START, RATE_AT_START, DISPLACEMENT_AT_START, VELOCITY_AT_START],
    ports: Ports::AXIS,
    build: Build::Relative(|parameters, _| {
        Ok(Box::new(Cylindrical {
            angle: parameters.number("angle")?,
            displacement: parameters.number("displacement")?,
        }))
    }),
};

/// A cylindrical joint.
#[derive(Clone, Copy, Debug)]
pub struct Cylindrical {
    /// Relative rotation at the start [rad].
    angle: f64,
    /// Relative displacement at the start [m].
    displacement: f64,
}

impl Joint for Cylindrical {
    const COORDINATES: &'static [Coordinate] =
        &[Coordinate::rotation("angle"), Coordinate::displacement("displacement")];

    fn equations(&self) -> &'static [&'static str] {
        &EQUATIONS
    }

    fn initial(&self) -> ([f64; MAX_COORDINATES], Motion) {
        let rotation = Rotation::from_matrix(&elementary(2, self.angle));
        ([self.angle, self.displacement], Motion::new(rotation, self.displacement * Vector3::z()))
    }

    fn violation(&self, relative: &Relative, own: &JointCoordinates) -> Equations {
        let mut out = Equations::default();
        on_third_axis(relative, own.value[SLIDE], 0, &mut out);
        JointRotation::about_third_axis(&own.angle(0)).matches(relative, 3, &mut out);
        out
    }

    #[inline(always)]
    fn violation_change<R: Real>(
        increment: &RelativeIncrement<R>,
        own: &CoordinateIncrement<R>,
        _: &[R; MAX_CONSTANTS],
    ) -> [R; MAX_EQUATIONS] {
        let mut change = JointRotation::about_third_axis(&own.angles[0]).held_change(increment);
        change[2] = change[2] - own.change[SLIDE];
        change
    }

    #[inline(always)]
    fn wrench<R: Real>(
        increment: &RelativeIncrement<R>,
        own: &CoordinateIncrement<R>,
        _: &[R; MAX_CONSTANTS],
        mu: &[R; MAX_EQUATIONS],
    ) -> (Screw<R>, [R; MAX_COORDINATES]) {
        let (wrench, mut own) = JointRotation::about_third_axis(&own.angles[0]).held_wrench(increment, mu);
        own[SLIDE] = -mu[2];
        (wrench, own)
    }

    fn gradient(&self, relative: &Relative, own: &JointCoordinates, out: &mut Gradient) {
        coincident_gradient(relative, 0, out);
        out.own[(2, SLIDE)] = -1.0;
        JointRotation::about_third_axis(&own.angle(0)).matches_gradient(relative, 3, out);
    }

    fn constraint_hessian(
        &self,
        relative: &Relative,
        own: &JointCoordinates,
        mu: &Equations,
        out: &mut ConstraintHessian,
    ) {
        coincident_hessian(relative, &Vector3::new(mu[0], mu[1], mu[2]), out);
        JointRotation::about_third_axis(&own.angle(0)).matches_hessian(
            relative,
            &Vector3::new(mu[3], mu[4], mu[5]),
            out,
        );
    }
}
