//! Prescribed motion: displacements and rotations of the tip relative to the base are functions of time, such as those
//! of a shaking table or a platform on the ground.
//!
//! ```text
//! R = Rx(rx) Ry(ry) Rz(rz),      x = (x, y, z) in the base's axes
//! ```
//!
//! Consists of existing joints: prismatic joints along the axes, then revolute joints about them, in series with massless
//! frames between them, each with a drive unless it is free. Components that are neither given nor free are locked, so that the
//! reaction has all six components. Three free rotations are a spherical joint.

use super::kind::{Build, JointKind};
use crate::kinematics::Quantity;
use crate::ports::Ports;
use crate::registry::{Parameter, ParameterType, optional, unitless};

/// The components, in the order of their joints.
pub const COMPONENTS: [(&str, Quantity); 6] = [
    ("x", Quantity::Length),
    ("y", Quantity::Length),
    ("z", Quantity::Length),
    ("rx", Quantity::Angle),
    ("ry", Quantity::Angle),
    ("rz", Quantity::Angle),
];

/// Names of the components that may be free.
const FREE: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "prescribed_motion",
    summary: "Prescribes displacements and rotations of the tip as functions of time; others are zero, or free.",
    sample: "x = \"0.01*(1 - cos(2*pi*t))\"\nrz = \"0.1*t^2\"",
    parameters: &[
        displacement("x", "Displacement along `axis` from the start."),
        displacement("y", "Displacement along `second_axis`."),
        displacement("z", "Displacement perpendicular to both."),
        rotation("rx", "Rotation about `axis` from the start."),
        rotation("ry", "Rotation about `second_axis` after its rotation by `rx`."),
        rotation("rz", "Rotation about the third axis after its rotations by `rx` and `ry`."),
        unitless(
            "free",
            ParameterType::Choices(&FREE),
            "Components that are neither prescribed nor locked; default none.",
        ),
    ],
    ports: Ports::AXES_OF_MODEL,
    build: Build::Motion,
};

const fn displacement(name: &'static str, summary: &'static str) -> Parameter {
    optional(name, ParameterType::Function, "m", summary)
}

const fn rotation(name: &'static str, summary: &'static str) -> Parameter {
    optional(name, ParameterType::Function, "rad", summary)
}
