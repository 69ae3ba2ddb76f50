//! Swing arm: a massless rigid arm, hinged to the base, that carries the tip's point. The angle of the
//! arm is an algebraic coordinate: x = Q(φ) a, with Q the rotation about the hinge's axis.

use lissom_motion::{Motion, Rotation, Vector3, skew};

use super::primitives::{POINT_EQUATIONS, elementary, elementary_change};
use super::{
    Build, Coordinate, Curvature, Equations, Frames, Gradient, Joint, JointKind, MOST_COORDINATES, Own,
    Relative,
};
use crate::registry::{Parameter, ParameterError, ParameterType};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "swing_arm",
    summary: "A massless arm, hinged to the base about an axis, carries the tip's point.",
    sample: "axis = [0.0, 0.0, 1.0]",
    parameters: &[Parameter::optional(
        "angle",
        ParameterType::Number,
        "rad",
        "Value of the arm's angle at the start; default 0.",
    )],
    build: Build::Relative(Frames::SpanWithAxis, |parameters, geometry| {
        let angle = parameters.number_or("angle", 0.0)?;
        let arm = elementary(2, angle).tr_mul(&geometry.span);
        if arm.x.hypot(arm.y) == 0.0 {
            return Err(ParameterError::new("tip", "lies on the hinge's axis: the arm has no length"));
        }
        Ok(Box::new(SwingArm { arm, angle, equations: if geometry.planar { 2 } else { 3 } }))
    }),
};

/// A hinged massless arm.
#[derive(Clone, Copy, Debug)]
pub struct SwingArm {
    /// The arm at φ = 0, in the base's joint frame [m].
    arm: Vector3,
    /// φ at the start [rad].
    angle: f64,
    /// Three, or two where the tip can only move in the plane of the hinge.
    equations: usize,
}

impl SwingArm {
    /// Multipliers as a vector, zero where there is no equation.
    fn forces(&self, mu: &Equations) -> Vector3 {
        Vector3::new(mu[0], mu[1], if self.equations == 3 { mu[2] } else { 0.0 })
    }

    fn rows(&self, vector: &Vector3) -> Equations {
        let mut out = Equations::default();
        out[..self.equations].copy_from_slice(&vector.as_slice()[..self.equations]);
        out
    }
}

impl Joint for SwingArm {
    fn equations(&self) -> &'static [&'static str] {
        &POINT_EQUATIONS[..self.equations]
    }

    fn coordinates(&self) -> &'static [Coordinate] {
        const { &[Coordinate::rotation("angle")] }
    }

    fn initial(&self) -> ([f64; MOST_COORDINATES], Motion) {
        let span = elementary(2, self.angle) * self.arm;
        ([self.angle, 0.0], Motion::new(Rotation::identity(), span))
    }

    fn violation(&self, relative: &Relative, own: &Own) -> Equations {
        self.rows(&(relative.position - elementary(2, own.value[0]) * self.arm))
    }

    fn violation_change(&self, relative: &Relative, own: &Own) -> Equations {
        let turn = elementary_change(2, own.value[0], own.change[0]);
        self.rows(&(relative.position_change - turn * self.arm))
    }

    fn gradient(&self, relative: &Relative, own: &Own, out: &mut Gradient) {
        let swing = Vector3::z().cross(&(elementary(2, own.value[0]) * self.arm));
        for i in 0..self.equations {
            for j in 0..3 {
                out.relative[(i, j)] = relative.rotation[(i, j)];
            }
            out.own[(i, 0)] = -swing[i];
        }
    }

    fn curvature(&self, relative: &Relative, own: &Own, mu: &Equations, out: &mut Curvature) {
        let force = self.forces(mu);
        let turning = skew(&relative.rotation.tr_mul(&force));
        let mut view = out.fixed_view_mut::<3, 3>(0, 3);
        view += turning;
        let arm = elementary(2, own.value[0]) * self.arm;
        out[(6, 6)] -= force.dot(&Vector3::z().cross(&Vector3::z().cross(&arm)));
    }
}
