//! Equation: an arbitrary expression of joints' coordinates and of time vanishes, c = f(q, t).

use super::kind::{Build, JointKind};
use crate::ports::{PortDeclaration, PortType, Ports};
use crate::registry::{ParameterType, required};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "equation",
    summary: "An expression of joint coordinates and time is zero: planetary gears, differentials, curves.",
    sample: "equation = \"my_hinge.angle - 2*my_slide.displacement\"",
    parameters: &[required(
        "equation",
        ParameterType::Equation,
        "",
        "The expression that is zero, of coordinates such as `arm.angle` and `slide.displacement`, and of `t`.",
    )],
    ports: Ports(&[PortDeclaration::required(
        "",
        PortType::NamedCoordinates,
        "coordinates that its expression names",
    )
    .listed("the coordinates that its expression names")]),
    build: Build::Coupling(|parameters, _| parameters.relation("equation")),
};
