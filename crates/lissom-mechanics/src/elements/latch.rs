//! Kinds of latches, which are constraints: see `joints::latch`.

use super::contribution::Contribution;
use super::initial_model::InitialModel;
use super::kind::{Attached, ElementKind};
use crate::ports::Ports;
use crate::registry::{COORDINATE, Parameter, ParameterError, ParameterType, Parameters, required};

const PARAMETERS: &[Parameter] = &[
    COORDINATE,
    required(
        "engaged",
        ParameterType::Input,
        "",
        "Input that engages it: locked above 0.5, otherwise free; set by events.",
    ),
];

/// Registry entry for displacements.
pub const AXIAL: ElementKind = ElementKind {
    name: "axial_latch",
    summary: "Locks a joint's relative displacement at its current value while an input is set: latches and releases.",
    sample: "engaged = \"my_input\"",
    parameters: PARAMETERS,
    ports: Ports::DISPLACEMENT,
    build,
};

/// Registry entry for rotations.
pub const TORSIONAL: ElementKind = ElementKind {
    name: "torsional_latch",
    summary: "Locks a joint's relative rotation at its current value while an input is set: latches and releases.",
    ports: Ports::ROTATION,
    ..AXIAL
};

fn build(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
) -> Result<Contribution, ParameterError> {
    let mut contribution = Contribution::to(model);
    contribution.latches.push((attached.coordinate()?, parameters.input("engaged")?));
    Ok(contribution)
}
