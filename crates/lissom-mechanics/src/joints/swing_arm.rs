//! Revolute-spherical link: a massless rigid link, hinged to the base, that carries the tip's point. The angle of the
//! link is an algebraic coordinate: x = Q(φ) a, with Q the rotation about the hinge's axis.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Motion, Real, Rotation, Screw, Triple, Vector3};

use super::base_axes::force_wrench;
use super::kind::{Build, JointKind};
use super::primitives::{elementary, elementary_of};
use super::relative_increment::{CoordinateIncrement, RelativeIncrement};
use super::{Coordinate, EquationCount, Joint, MAX_CONSTANTS, MAX_COORDINATES, MAX_EQUATIONS};
use crate::ports::Ports;
use crate::registry::ParameterType::Number;
use crate::registry::{ParameterError, optional};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "swing_arm",
    summary: "A massless link with a revolute joint at the base and a spherical joint at the tip.",
    sample: "axis = [0.0, 0.0, 1.0]",
    parameters: &[optional(
        "angle",
        Number,
        "rad",
        "Value of the link's angle in the given positions; moves no part, except with `[assembly]`.",
    )
    .or_number(0.0)],
    ports: Ports::ARM,
    build: Build::Relative(|parameters, geometry| {
        let angle = parameters.number("angle")?;
        let arm = elementary(2, angle).tr_mul(&geometry.span);
        if arm.x.hypot(arm.y) == 0.0 {
            return Err(ParameterError::new("tip", "is on the hinge's axis: the link has no length"));
        }
        Ok(Box::new(SwingArm { arm, angle, equations: if geometry.planar { 2 } else { 3 } }))
    }),
};

/// A hinged massless link.
#[derive(Clone, Copy, Debug)]
pub struct SwingArm {
    /// The vector a of the link at φ = 0, in the base's joint frame [m].
    arm: Vector3,
    /// φ at the start [rad].
    angle: f64,
    /// Three, or two if the tip can move only in the plane of the hinge.
    equations: usize,
}

impl Joint for SwingArm {
    const COORDINATES: &'static [Coordinate] = &[Coordinate::rotation("angle")];
    const EQUATIONS: EquationCount = EquationCount { lengths: 3, angles: 0 };

    fn equations(&self) -> &'static [&'static str] {
        &["position 1", "position 2", "position 3"][..self.equations]
    }

    /// The vector of the link, and 1 if there is a third equation.
    fn constants(&self) -> [f64; MAX_CONSTANTS] {
        let mut constants = [0.0; MAX_CONSTANTS];
        constants[..3].copy_from_slice(self.arm.as_slice());
        constants[3] = if self.equations == 3 { 1.0 } else { 0.0 };
        constants
    }

    fn initial(&self) -> ([f64; MAX_COORDINATES], Motion) {
        let span = elementary(2, self.angle) * self.arm;
        ([self.angle, 0.0], Motion::new(Rotation::identity(), span))
    }

    #[inline(always)]
    fn violation_change<R: Real>(
        increment: &RelativeIncrement<R>,
        own: &CoordinateIncrement<R>,
        constants: &[R; MAX_CONSTANTS],
    ) -> [R; MAX_EQUATIONS] {
        let (_, turn) = elementary_of(2, &own.angles[0]);
        let change =
            increment.position_change - turn.times(Triple::new(constants[0], constants[1], constants[2]));
        let zero = change.x.like(0.0);
        [change.x, change.y, change.z * constants[3], zero, zero, zero]
    }

    #[inline(always)]
    fn wrench<R: Real>(
        increment: &RelativeIncrement<R>,
        own: &CoordinateIncrement<R>,
        constants: &[R; MAX_CONSTANTS],
        mu: &[R; MAX_EQUATIONS],
    ) -> (Screw<R>, [R; MAX_COORDINATES]) {
        let force = Triple::new(mu[0], mu[1], mu[2] * constants[3]);
        let (rotation, _) = elementary_of(2, &own.angles[0]);
        let arm = rotation.times(Triple::new(constants[0], constants[1], constants[2]));
        let zero = mu[0].like(0.0);
        let swing = arm.y * force.x - arm.x * force.y;
        (force_wrench(increment, force), [swing, zero])
    }
}
