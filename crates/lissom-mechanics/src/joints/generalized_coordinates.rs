//! Generalised coordinates without a position in space: springs, loads, relations and the matrices of
//! `elements::coordinate_dynamics` act on them as on the coordinates of joints. They have no equations of their own.

use super::Coordinate;
use super::kind::{Build, JointKind};
use crate::kinematics::Quantity;
use crate::ports::Ports;
use crate::registry::{ParameterError, ParameterType, Parameters, optional, required, unitless};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "generalized_coordinates",
    summary: "Generalised coordinates that belong to no part, for springs, loads, gears and `coordinate_dynamics`.",
    sample: "start = [0.1, 0.0]\n[springs.my_masses]\nkind = \"coordinate_dynamics\"\ncoordinates = [\"my_joint\"]\nmass = [2.0, 1.0]",
    parameters: &[
        required(
            "start",
            ParameterType::Numbers,
            "m or rad",
            "Values at the start: as many as there are coordinates.",
        ),
        optional(
            "rate",
            ParameterType::Numbers,
            "m/s or rad/s",
            "Rates at the start, as many as in `start`; default zeros.",
        ),
        unitless(
            "rotations",
            ParameterType::Flag,
            "Whether they are rotations [rad] instead of displacements [m].",
        )
        .or_flag(false),
    ],
    ports: Ports::NONE,
    build: Build::Free(read),
};

/// A coordinate of no joint between two nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeCoordinate {
    /// Name and quantity of the coordinate.
    pub coordinate: Coordinate,
    /// At the start [m, rad].
    pub value: f64,
    /// Rate of the coordinate at the start [m/s, rad/s].
    pub rate: f64,
}

fn read(parameters: &Parameters) -> Result<Vec<FreeCoordinate>, ParameterError> {
    let values = parameters.numbers("start")?;
    let rates = if parameters.has("rate") { parameters.numbers("rate")? } else { &[] };
    if parameters.has("rate") && rates.len() != values.len() {
        let problem = format!("has {} numbers, but `start` has {}", rates.len(), values.len());
        return Err(ParameterError::new("rate", problem));
    }
    let quantity = if parameters.flag("rotations")? { Quantity::Angle } else { Quantity::Length };
    let coordinate = Coordinate { name: quantity.relative(), quantity };
    let read = |(k, &value): (usize, &f64)| FreeCoordinate {
        coordinate,
        value,
        rate: rates.get(k).copied().unwrap_or(0.0),
    };
    Ok(values.iter().enumerate().map(read).collect())
}
