//! Constant-velocity joint: two nodes share a point, and the shafts along the third axes rotate by the same angle,
//! whatever the angle between them: c = axial(R)·e₃.
//!
//! With the input rotated by α, the output by β, and the tip's shaft bent by θ about any perpendicular axis, R_21 -
//! R_12 = (1 + cos θ) sin(β - α): the equation is satisfied with β = α up to θ = π.

use lissom_motion::{Rotation, Vector3};

use super::Branch;
use super::kind::{Build, JointKind};
use super::product::{Product, Turn};
use crate::ports::Ports;
use crate::registry::{ParameterError, ParameterType, unitless};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "constant_velocity",
    summary: "Two shafts with a common point and any angle between them rotate by the same angle.",
    sample: "axis = [1.0, 0.0, 0.0]\ntip_axis = [0.9, 0.4, 0.0]",
    parameters: &[unitless(
        "tip_axis",
        ParameterType::Direction,
        "Direction of the tip's shaft at the start, global axes; default: `axis`, the direction of the base's shaft.",
    )],
    ports: Ports::AXIS,
    build: Build::Relative(|parameters, geometry| {
        let shaft = geometry.axes.apply(&Vector3::z());
        let tip = parameters.vector_or("tip_axis", shaft)?;
        let tip = geometry.axes.apply_inverse(&tip).normalize();
        // The sense of a shaft is arbitrary: the direction with the smaller angle is used.
        let tip = tip * tip.z.signum();
        if tip.z.abs() < 1e-6 {
            return Err(ParameterError::new(
                "tip_axis",
                "is perpendicular to `axis`: such a joint cannot rotate",
            ));
        }
        Ok(Box::new(ConstantVelocity { tip }))
    }),
};

/// A shared point, and equal rotation of bent shafts.
#[derive(Clone, Copy, Debug)]
pub struct ConstantVelocity {
    /// The tip's shaft at the start, a unit vector in the base's joint frame.
    tip: Vector3,
}

impl Product for ConstantVelocity {
    const TURN: Turn = Turn::Shafts;

    /// The tip's third axis is its shaft, rotated from the base's about their common normal.
    fn start(&self) -> Rotation {
        let across = Vector3::z().cross(&self.tip);
        let angle = across.norm().atan2(self.tip.z);
        let axis = across.try_normalize(0.0).unwrap_or_else(Vector3::x);
        Rotation::exponential(&(angle * axis))
    }

    /// R_11 + R_22 = (1 + cos θ) cos(β - α): the equation is also satisfied with β = α + π.
    fn branch(&self) -> Option<Branch> {
        Some(|relative| relative.rotation[(0, 0)] + relative.rotation[(1, 1)])
    }
}
