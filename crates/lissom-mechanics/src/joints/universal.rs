//! Universal joint: two nodes share a point; the tip rotates about an axis of the base, then about an axis of its
//! own. Both angles are algebraic coordinates.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::Real;

use super::Coordinate;
use super::held::Held;
use super::kind::{Build, JointKind};
use super::primitives::JointRotation;
use super::relative_increment::Angle;
use crate::ports::Ports;

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "universal",
    summary: "Two nodes share a point; two perpendicular axes, one fixed in each; both rotations are coordinates.",
    sample: "axis = [1.0, 0.0, 0.0]\nsecond_axis = [0.0, 1.0, 0.0]",
    parameters: &[],
    ports: Ports::TWO_AXES,
    build: Build::Relative(|_, _| Ok(Box::new(Universal))),
};

/// A shared point and a cross.
#[derive(Clone, Copy, Debug)]
pub struct Universal;

impl Held for Universal {
    const COORDINATES: &'static [Coordinate] =
        &[Coordinate::rotation("first angle"), Coordinate::rotation("second angle")];

    #[inline(always)]
    fn rotation<R: Real>(_: R, angle: impl Fn(usize) -> Angle<R>) -> JointRotation<R> {
        JointRotation::about_first_and_second_axis(&[angle(0), angle(1)])
    }
}
