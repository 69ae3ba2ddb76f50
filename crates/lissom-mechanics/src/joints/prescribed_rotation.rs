//! Prescribed relative rotation: a joint's angle is a function of time; the multiplier is the drive's moment.

use super::kind::{Build, JointKind};
use crate::ports::Ports;
use crate::registry::{COORDINATE, ParameterType, required};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "prescribed_rotation",
    summary: "Prescribes a joint's relative rotation as a function of time.",
    sample: "rotation = \"0.5*sin(2*pi*t)\"",
    parameters: &[
        required("rotation", ParameterType::Function, "rad", "The relative rotation as a function of time."),
        COORDINATE,
    ],
    ports: Ports::ROTATION,
    build: Build::Coordinate(|parameters| parameters.function("rotation")),
};
