//! Prescribed relative displacement: a joint's displacement is a function of time; the multiplier is the drive's force.

use super::kind::{Build, JointKind};
use crate::ports::Ports;
use crate::registry::{COORDINATE, ParameterType, required};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "prescribed_displacement",
    summary: "Prescribes a joint's relative displacement as a function of time.",
    sample: "displacement = \"0.1*sin(2*pi*t)\"",
    parameters: &[
        required(
            "displacement",
            ParameterType::Function,
            "m",
            "The relative displacement as a function of time.",
        ),
        COORDINATE,
    ],
    ports: Ports::DISPLACEMENT,
    build: Build::Coordinate(|parameters| parameters.function("displacement")),
};
