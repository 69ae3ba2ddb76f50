//! Spring and damper on a joint's relative rotation: moment k (φ - φ₀) + c φ̇.

use super::interval::Interval;
use super::{Attached, Attachment, Element, ElementKind, Energy, Tangents};
use crate::registry::{COORDINATE, Parameter, ParameterError, ParameterType, Parameters};
use crate::system::{Builder, CoordinateId, Kinematics, NodeId};

/// Registry entry.
pub const KIND: ElementKind = ElementKind {
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
    attachment: Attachment::Coordinate,
    build,
};

/// Spring and damper on an algebraic coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct TorsionalSpring {
    coordinate: [CoordinateId; 1],
    stiffness: f64,
    damping: f64,
    angle: f64,
}

fn build(builder: &mut Builder, attached: Attached, parameters: &Parameters) -> Result<(), ParameterError> {
    builder.add_element(TorsionalSpring {
        coordinate: [attached.coordinate()?],
        stiffness: parameters.number_or("stiffness", 0.0)?,
        damping: parameters.number_or("damping", 0.0)?,
        angle: parameters.number_or("angle", 0.0)?,
    });
    Ok(())
}

impl Element for TorsionalSpring {
    fn nodes(&self) -> &[NodeId] {
        &[]
    }

    fn coordinates(&self) -> &[CoordinateId] {
        &self.coordinate
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let coordinate = &at.coordinates[self.coordinate[0]];
        out[0] += self.stiffness * (coordinate.value - self.angle) + self.damping * coordinate.rate;
    }

    fn mean_forces(&self, interval: &Interval<'_>, out: &mut [f64]) {
        let coordinate = self.coordinate[0];
        let [from, to] = [interval.from, interval.to].map(|at| at.coordinates[coordinate].value);
        let change = interval.coordinate_increments[coordinate];
        out[0] += self.stiffness * (0.5 * (from + to) - self.angle + interval.dissipation * change)
            + self.damping * interval.rate() * change;
    }

    fn linearize(&self, _: &Kinematics, out: &mut Tangents) {
        out.stiffness[0] += self.stiffness;
        out.damping[0] += self.damping;
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        let angle = at.coordinates[self.coordinate[0]].value - self.angle;
        Energy { strain: 0.5 * self.stiffness * angle * angle, ..Energy::default() }
    }
}
