//! Springs and dampers on a joint's relative rotation or displacement: moment or force k (φ - φ₀) + c φ̇.

use super::{Attached, Attachment, Element, ElementKind, Energy, Tangents};
use crate::joints::Quantity;
use crate::registry::{COORDINATE, Parameter, ParameterError, ParameterType, Parameters};
use crate::system::{Builder, CoordinateId, Kinematics, NodeId};

/// Registry entry of the spring on a rotation.
pub const TORSIONAL: ElementKind = ElementKind {
    name: "torsional",
    summary: "Spring and damper on a joint's relative rotation.",
    sample: "stiffness = 10.0",
    parameters: &[
        Parameter::optional("stiffness", ParameterType::NotNegative, "N m/rad", "Stiffness; default 0."),
        Parameter::optional("damping", ParameterType::NotNegative, "N m s/rad", "Damping; default 0."),
        Parameter::optional(
            "angle",
            ParameterType::Number,
            "rad",
            "Relative rotation at which it is free of moment; default 0.",
        ),
        COORDINATE,
    ],
    attachment: Attachment::Coordinate(Quantity::Angle),
    build: |builder, attached, parameters| add(builder, attached, parameters, Quantity::Angle, "angle"),
};

/// Registry entry of the spring on a displacement.
pub const AXIAL: ElementKind = ElementKind {
    name: "axial",
    summary: "Spring and damper on a joint's relative displacement.",
    sample: "stiffness = 1000.0",
    parameters: &[
        Parameter::optional("stiffness", ParameterType::NotNegative, "N/m", "Stiffness; default 0."),
        Parameter::optional("damping", ParameterType::NotNegative, "N s/m", "Damping; default 0."),
        Parameter::optional(
            "displacement",
            ParameterType::Number,
            "m",
            "Relative displacement at which it is free of force; default 0.",
        ),
        COORDINATE,
    ],
    attachment: Attachment::Coordinate(Quantity::Length),
    build: |builder, attached, parameters| {
        add(builder, attached, parameters, Quantity::Length, "displacement")
    },
};

/// Spring and damper on an algebraic coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct CoordinateSpring {
    coordinate: [CoordinateId; 1],
    stiffness: f64,
    damping: f64,
    /// Where it is free of force.
    rest: f64,
}

fn add(
    builder: &mut Builder,
    attached: Attached,
    parameters: &Parameters,
    acts_on: Quantity,
    rest: &str,
) -> Result<(), ParameterError> {
    let coordinate = attached.coordinate()?;
    builder.check_quantity(coordinate, acts_on)?;
    builder.add_element(CoordinateSpring {
        coordinate: [coordinate],
        stiffness: parameters.number_or("stiffness", 0.0)?,
        damping: parameters.number_or("damping", 0.0)?,
        rest: parameters.number_or(rest, 0.0)?,
    });
    Ok(())
}

impl Element for CoordinateSpring {
    fn nodes(&self) -> &[NodeId] {
        &[]
    }

    fn coordinates(&self) -> &[CoordinateId] {
        &self.coordinate
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let coordinate = &at.coordinates[self.coordinate[0]];
        out[0] += self.stiffness * (coordinate.value - self.rest) + self.damping * coordinate.rate;
    }

    fn linearize(&self, _: &Kinematics, out: &mut Tangents) {
        out.stiffness[0] += self.stiffness;
        out.damping[0] += self.damping;
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        let stretch = at.coordinates[self.coordinate[0]].value - self.rest;
        Energy { strain: 0.5 * self.stiffness * stretch * stretch, ..Energy::default() }
    }
}
