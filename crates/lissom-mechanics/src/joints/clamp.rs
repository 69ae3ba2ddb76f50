//! Clamp: two nodes, or a node and the ground, share position and rotation.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::Real;

use super::held::Held;
use super::kind::{Build, JointKind};
use super::primitives::JointRotation;
use super::relative_increment::Angle;
use crate::ports::Ports;

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "clamp",
    summary: "Locks all six relative degrees of freedom.",
    sample: "",
    parameters: &[],
    ports: Ports::POINT,
    build: Build::Relative(|_, _| Ok(Box::new(Clamp))),
};

/// No relative motion.
#[derive(Clone, Copy, Debug)]
pub struct Clamp;

impl Held for Clamp {
    #[inline(always)]
    fn rotation<R: Real>(kind: R, _: impl Fn(usize) -> Angle<R>) -> JointRotation<R> {
        JointRotation::none(kind)
    }
}
