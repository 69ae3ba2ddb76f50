//! Revolute joint: two nodes share a point and an axis; the relative rotation about the axis is an algebraic
//! coordinate, which springs, drives and outputs can use.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Motion, Real, Rotation, Vector3};

use super::held::Held;
use super::kind::{Build, JointKind};
use super::primitives::{JointRotation, elementary};
use super::relative_increment::Angle;
use super::{Coordinate, MAX_COORDINATES};
use crate::ports::Ports;
use crate::registry::{ANGLE_AT_START, RATE_AT_START};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "revolute",
    summary: "The tip rotates about an axis through a common point; the relative rotation is a coordinate.",
    sample: "axis = [0.0, 0.0, 1.0]",
    parameters: &[ANGLE_AT_START, RATE_AT_START],
    ports: Ports::AXIS,
    build: Build::Relative(|parameters, _| Ok(Box::new(Revolute { angle: parameters.number("angle")? }))),
};

/// A shared point and axis.
#[derive(Clone, Copy, Debug)]
pub struct Revolute {
    /// Relative rotation at the start [rad].
    angle: f64,
}

impl Held for Revolute {
    const COORDINATES: &'static [Coordinate] = &[Coordinate::rotation("angle")];

    fn initial(&self) -> ([f64; MAX_COORDINATES], Motion) {
        let rotation = Rotation::from_matrix(&elementary(2, self.angle));
        ([self.angle, 0.0], Motion::new(rotation, Vector3::zeros()))
    }

    #[inline(always)]
    fn rotation<R: Real>(_: R, angle: impl Fn(usize) -> Angle<R>) -> JointRotation<R> {
        JointRotation::about_third_axis(&angle(0))
    }
}
