//! Prescribed motion: displacements and rotations of the tip relative to the base are functions of time, such as those
//! of a shaking table or a platform on the ground.
//!
//! ```text
//! R = Rx(rx) Ry(ry) Rz(rz),      x = (x, y, z) in the base's axes
//! ```
//!
//! Consists of existing joints: prismatic joints along the axes, then revolute joints about them, in series with massless
//! frames between them, each with a drive. Components that are not given are locked, so that the reaction has all six
//! components.

use super::kind::{Build, JointKind};
use crate::kinematics::Quantity;
use crate::ports::Ports;
use crate::registry::{Parameter, ParameterType};

/// The components, in the order of their joints.
pub const COMPONENTS: [(&str, Quantity); 6] = [
    ("x", Quantity::Length),
    ("y", Quantity::Length),
    ("z", Quantity::Length),
    ("rx", Quantity::Angle),
    ("ry", Quantity::Angle),
    ("rz", Quantity::Angle),
];

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "prescribed_motion",
    summary: "Prescribes displacements and rotations of the tip as functions of time; omitted ones are zero.",
    sample: "x = \"0.01*(1 - cos(2*pi*t))\"\nrz = \"0.1*t^2\"",
    parameters: &[
        displacement("x", "Displacement along `axis` from the start."),
        displacement("y", "Displacement along `second_axis`."),
        displacement("z", "Displacement perpendicular to both."),
        rotation("rx", "Rotation about `axis` from the start."),
        rotation("ry", "Rotation about `second_axis` after its rotation by `rx`."),
        rotation("rz", "Rotation about the third axis after its rotations by `rx` and `ry`."),
    ],
    ports: Ports::AXES_OF_MODEL,
    build: Build::Motion,
};

const fn displacement(name: &'static str, summary: &'static str) -> Parameter {
    Parameter::optional(name, ParameterType::Function, "m", summary)
}

const fn rotation(name: &'static str, summary: &'static str) -> Parameter {
    Parameter::optional(name, ParameterType::Function, "rad", summary)
}
