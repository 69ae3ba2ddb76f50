//! Prismatic joint: the tip slides along an axis of the base without relative rotation. The displacement along the
//! axis is an algebraic coordinate: x = d e₃ in the joint frame, R = I.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Motion, Real, Rotation, Screw, Vector3};

use super::clamp::EQUATIONS;
use super::kind::{Build, JointKind};
use super::primitives::{JointRotation, coincident_gradient, coincident_hessian, on_third_axis};
use super::relative_increment::{CoordinateIncrement, RelativeIncrement};
use super::{
    ConstraintHessian, Coordinate, Equations, Gradient, Joint, JointCoordinates, MAX_CONSTANTS,
    MAX_COORDINATES, MAX_EQUATIONS, Relative,
};
use crate::ports::Ports;
use crate::registry::{DISPLACEMENT_AT_START, VELOCITY_AT_START};

/// Index of the displacement among the coordinates.
const SLIDE: usize = 0;

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "prismatic",
    summary: "The tip slides along an axis without rotation; the displacement is a coordinate.",
    sample: "axis = [1.0, 0.0, 0.0]",
    parameters: &[DISPLACEMENT_AT_START, VELOCITY_AT_START],
    ports: Ports::AXIS,
    build: Build::Relative(|parameters, _| {
        Ok(Box::new(Prismatic { displacement: parameters.number("displacement")? }))
    }),
};

/// A prismatic joint.
#[derive(Clone, Copy, Debug)]
pub struct Prismatic {
    /// Relative displacement at the start [m].
    displacement: f64,
}

impl Joint for Prismatic {
    const COORDINATES: &'static [Coordinate] = &[Coordinate::displacement("displacement")];

    fn equations(&self) -> &'static [&'static str] {
        &EQUATIONS
    }

    fn initial(&self) -> ([f64; MAX_COORDINATES], Motion) {
        let place = Motion::new(Rotation::identity(), self.displacement * Vector3::z());
        ([self.displacement, 0.0], place)
    }

    fn violation(&self, relative: &Relative, own: &JointCoordinates) -> Equations {
        let mut out = Equations::default();
        on_third_axis(relative, own.value[SLIDE], 0, &mut out);
        JointRotation::none(0.0).matches(relative, 3, &mut out);
        out
    }

    #[inline(always)]
    fn violation_change<R: Real>(
        increment: &RelativeIncrement<R>,
        own: &CoordinateIncrement<R>,
        _: &[R; MAX_CONSTANTS],
    ) -> [R; MAX_EQUATIONS] {
        let mut change = JointRotation::none(increment.place.x).held_change(increment);
        change[2] = change[2] - own.change[SLIDE];
        change
    }

    #[inline(always)]
    fn wrench<R: Real>(
        increment: &RelativeIncrement<R>,
        _: &CoordinateIncrement<R>,
        _: &[R; MAX_CONSTANTS],
        mu: &[R; MAX_EQUATIONS],
    ) -> (Screw<R>, [R; MAX_COORDINATES]) {
        let (wrench, mut own) = JointRotation::none(mu[0]).held_wrench(increment, mu);
        own[SLIDE] = -mu[2];
        (wrench, own)
    }

    fn gradient(&self, relative: &Relative, _: &JointCoordinates, out: &mut Gradient) {
        coincident_gradient(relative, 0, out);
        out.own[(2, SLIDE)] = -1.0;
        JointRotation::none(0.0).matches_gradient(relative, 3, out);
    }

    fn constraint_hessian(
        &self,
        relative: &Relative,
        _: &JointCoordinates,
        mu: &Equations,
        out: &mut ConstraintHessian,
    ) {
        coincident_hessian(relative, &Vector3::new(mu[0], mu[1], mu[2]), out);
        JointRotation::none(0.0).matches_hessian(relative, &Vector3::new(mu[3], mu[4], mu[5]), out);
    }
}
