//! Cylindrical joint: the tip slides along an axis of the base and rotates about it. Rotation and displacement are
//! algebraic coordinates: x = d e₃ in the joint frame, R = Q(φ).
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Motion, Real, Rotation, Vector3};

use super::held::Held;
use super::kind::{Build, JointKind};
use super::primitives::{JointRotation, elementary};
use super::relative_increment::Angle;
use super::{Coordinate, MAX_COORDINATES};
use crate::ports::Ports;
use crate::registry::{ANGLE_AT_START, DISPLACEMENT_AT_START, RATE_AT_START, VELOCITY_AT_START};

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

impl Held for Cylindrical {
    const COORDINATES: &'static [Coordinate] =
        &[Coordinate::rotation("angle"), Coordinate::displacement("displacement")];
    const SLIDE: Option<usize> = Some(1);

    fn initial(&self) -> ([f64; MAX_COORDINATES], Motion) {
        let rotation = Rotation::from_matrix(&elementary(2, self.angle));
        ([self.angle, self.displacement], Motion::new(rotation, self.displacement * Vector3::z()))
    }

    #[inline(always)]
    fn rotation<R: Real>(_: R, angle: impl Fn(usize) -> Angle<R>) -> JointRotation<R> {
        JointRotation::about_third_axis(&angle(0))
    }
}
