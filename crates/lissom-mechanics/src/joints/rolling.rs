//! Rolling: a wheel, disc or ball touches a plane of the base, and its point of contact does not slide.
//!
//! Legend: n normal of the plane, in the tip's axes N = ±Rᵀe₃ towards the wheel; a axis of the wheel, in the tip's axes; r
//! radius of the circle of the rim's middle, ρ radius of its rounding; x centre of the wheel over the plane; u = N·a,
//! S = (1 - u²)^½.
//!
//! ```text
//! c = ±x₃ - r S - ρ = 0,      ∂c/∂η = (N, r u/S a × N)
//! ```
//!
//! This equation maintains the distance. That the point of contact does not slide is a velocity constraint, see
//! [`super::contact`] and `elements::rolling`.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Motion, Real, Rotation, Screw, Triple, Vector3};

use super::base_axes::row;
use super::kind::{Build, Geometry, JointKind};
use super::relative_increment::{CoordinateIncrement, RelativeIncrement};
use super::{EquationCount, Joint, MAX_CONSTANTS, MAX_COORDINATES, MAX_EQUATIONS};
use crate::ports::Ports;
use crate::registry::ParameterType::{NotNegative, Positive};
use crate::registry::{ParameterError, ParameterType, Parameters, optional, required, unitless};
use crate::round_off;
use crate::wheels::wheel_on_plane::{Contact, upright};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "rolling",
    summary: "A wheel, disc or ball rolls on a plane of the base without sliding or lifting off.",
    sample: "axis = [0.0, 0.0, 1.0]\nwheel_axis = [0.0, 1.0, 0.0]",
    parameters: &[
        required(
            "wheel_axis",
            ParameterType::Direction,
            "",
            "Axis of the wheel at the start, global axes, through the tip's position, the wheel's centre.",
        ),
        optional(
            "radius",
            NotNegative,
            "m",
            "Radius of the wheel, without the rounding of its rim; default: the one with which it touches the plane at the start; 0 for \
            a ball of radius `rim`.",
        ),
        optional(
            "rim",
            NotNegative,
            "m",
            "Rounding radius of the rim; zero for a sharp edge.",
        )
        .or_number(0.0),
        unitless(
            "friction_coefficient",
            Positive,
            "Coefficient of friction; a warning reports when rolling requires more; default: no limit.",
        ),
        optional(
            "creep",
            NotNegative,
            "m/(N s)",
            "Sliding velocity per force, a linear law of creep. It makes the forces of several wheels on one axle, which \
             constrain each other, unique.",
        )
        .or_number(0.0),
    ],
    ports: Ports::ARM,
    build: Build::Relative(|parameters, geometry| {
        Ok(Box::new(Rolling { contact: contact(parameters, geometry)?, centre: geometry.span }))
    }),
};

fn contact(parameters: &Parameters, geometry: &Geometry) -> Result<Contact, ParameterError> {
    let axis = parameters.vector("wheel_axis")?;
    let axis = geometry
        .axes
        .apply_inverse(&axis)
        .try_normalize(0.0)
        .ok_or_else(|| ParameterError::new("wheel_axis", "has no direction: all its numbers are zero"))?;
    let rim = parameters.number("rim")?;
    let height = geometry.span.z.abs();
    if height <= 0.0 {
        let problem =
            "is in the plane: its position must be the centre of the wheel, and `at` a point of the plane";
        return Err(ParameterError::new("tip", problem));
    }
    let mut contact = Contact {
        axis,
        side: geometry.span.z.signum(),
        radius: 0.0,
        rim,
        friction: parameters.number_or("friction_coefficient", f64::INFINITY)?,
        creep: parameters.number("creep")?,
    };
    let upright = upright(axis.z);
    let fitting = (height - rim) / upright;
    contact.radius = parameters.number_or("radius", fitting)?;
    if contact.radius > 0.0 && upright < 1e-3 {
        let problem = "is perpendicular to the plane: the wheel is flat on it and cannot roll";
        return Err(ParameterError::new("wheel_axis", problem));
    }
    let reach = contact.radius * upright + rim;
    if !parameters.has("radius") && fitting < 0.0 {
        let problem = format!("is {rim} m, but the wheel's centre is {height} m from the plane at the start");
        return Err(ParameterError::new("rim", problem));
    }
    if (reach - height).abs() > round_off::GIVEN * height.max(reach) {
        let problem = format!(
            "implies that the wheel's centre is {reach:.9} m from the plane, but at the start it is {height:.9} m from it: \
             move the wheel or the plane's point `at`, or leave `radius` out"
        );
        return Err(ParameterError::new("radius", problem));
    }
    Ok(contact)
}

/// The distance of a wheel from a plane.
#[derive(Clone, Copy, Debug)]
pub struct Rolling {
    contact: Contact,
    /// The wheel's centre at the start, in the base's axes [m].
    centre: Vector3,
}

impl Joint for Rolling {
    const EQUATIONS: EquationCount = EquationCount { lengths: 1, angles: 0 };

    fn equations(&self) -> &'static [&'static str] {
        &["distance from the plane"]
    }

    fn contact(&self) -> Option<Contact> {
        Some(self.contact)
    }

    /// Side of the plane, radius, axis.
    fn constants(&self) -> [f64; MAX_CONSTANTS] {
        let Contact { axis, side, radius, .. } = self.contact;
        let mut constants = [0.0; MAX_CONSTANTS];
        constants[..5].copy_from_slice(&[side, radius, axis.x, axis.y, axis.z]);
        constants
    }

    fn initial(&self) -> ([f64; MAX_COORDINATES], Motion) {
        ([0.0; MAX_COORDINATES], Motion::new(Rotation::identity(), self.centre))
    }

    #[inline(always)]
    fn violation_change<R: Real>(
        increment: &RelativeIncrement<R>,
        _: &CoordinateIncrement<R>,
        constants: &[R; MAX_CONSTANTS],
    ) -> [R; MAX_EQUATIONS] {
        let [side, radius, x, y, z, ..] = *constants;
        let axis = Triple::new(x, y, z);
        let before = row(&increment.start_rotation, 2).dot(axis);
        let change = row(&increment.rotation_change, 2).dot(axis);
        let after = before + change;
        // ΔS = -(u₀ + u) Δu/(S₀ + S)
        let lower = radius * (before + after) * change / (upright(before) + upright(after));
        let zero = change.like(0.0);
        [side * increment.position_change.z + lower, zero, zero, zero, zero, zero]
    }

    #[inline(always)]
    fn wrench<R: Real>(
        increment: &RelativeIncrement<R>,
        _: &CoordinateIncrement<R>,
        constants: &[R; MAX_CONSTANTS],
        mu: &[R; MAX_EQUATIONS],
    ) -> (Screw<R>, [R; MAX_COORDINATES]) {
        let [side, radius, x, y, z, ..] = *constants;
        let axis = Triple::new(x, y, z);
        let normal = row(&increment.rotation(), 2);
        let cosine = normal.dot(axis);
        let lever = mu[0] * radius * cosine / upright(cosine);
        let zero = mu[0].like(0.0);
        (Screw::new(normal * (side * mu[0]), axis.cross(normal) * lever), [zero; MAX_COORDINATES])
    }
}
