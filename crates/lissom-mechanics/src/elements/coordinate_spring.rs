//! Springs and dampers on a joint's relative rotation or displacement: moment or force k (φ - φ₀) + c φ̇, or
//! another law of φ - φ₀ and φ̇.

use super::Unknowns;
use super::contribution::Contribution;
use super::force_law::{ForceLaw, PRELOAD_FORCE, PRELOAD_MOMENT, SIDE_OF_ANGLE, SIDE_OF_LENGTH};
use super::initial_model::InitialModel;
use super::kind::{Attached, ElementKind};
use super::over_measure::{Measure, OverMeasure};
use crate::kinematics::{CoordinateId, Kinematics, Quantity};
use crate::ports::Ports;
use crate::registry::ParameterType::{NotNegative, Number};
use crate::registry::{COORDINATE, ParameterError, ParameterType, Parameters, optional};
use crate::signals::measurement::Gradient;

/// Registry entry of the spring on a rotation.
pub(crate) const TORSIONAL: ElementKind = ElementKind {
    name: "torsional",
    summary: "Spring and damper on a joint's relative rotation.",
    sample: "stiffness = 10.0",
    parameters: &[
        optional("stiffness", NotNegative, "N m/rad", "Stiffness.").or_number(0.0),
        optional("damping", NotNegative, "N m s/rad", "Damping.").or_number(0.0),
        optional(
            "moment",
            ParameterType::Force(&["rotation", "rate"]),
            "N m",
            "Moment over `rotation` and `rate`, in addition to `stiffness`; a table is over `rotation`.",
        ),
        optional(
            "damper_moment",
            ParameterType::Force(&["rate", "rotation"]),
            "N m",
            "Moment over `rate` and `rotation`, in addition to `damping`; a table is over `rate`.",
        ),
        SIDE_OF_ANGLE,
        optional("limits", ParameterType::Range, "N m", "Minimum and maximum moment; default: none."),
        optional(
            "backlash",
            NotNegative,
            "rad",
            "Width of the backlash about the free rotation, without moment.",
        )
        .or_number(0.0),
        optional("angle", Number, "rad", "Relative rotation without moment.").or_number(0.0),
        PRELOAD_MOMENT,
        COORDINATE,
    ],
    ports: Ports::ROTATION,
    build: |model, attached, parameters| {
        add(model, attached, parameters, Quantity::Angle, ["angle", "moment", "damper_moment"])
    },
};

/// Registry entry of the spring on a displacement.
pub(crate) const AXIAL: ElementKind = ElementKind {
    name: "axial",
    summary: "Spring and damper on a joint's relative displacement.",
    sample: "stiffness = 1000.0",
    parameters: &[
        optional("stiffness", NotNegative, "N/m", "Stiffness.").or_number(0.0),
        optional("damping", NotNegative, "N s/m", "Damping.").or_number(0.0),
        optional(
            "force",
            ParameterType::Force(&["elongation", "rate"]),
            "N",
            "Force over `elongation` and `rate`, in addition to `stiffness`; a table is over `elongation`.",
        ),
        optional(
            "damper_force",
            ParameterType::Force(&["rate", "elongation"]),
            "N",
            "Force over `rate` and `elongation`, in addition to `damping`; a table is over `rate`.",
        ),
        SIDE_OF_LENGTH,
        optional("limits", ParameterType::Range, "N", "Minimum and maximum force; default: none."),
        optional("backlash", NotNegative, "m", "Width of the backlash about the free length, without force.")
            .or_number(0.0),
        optional("displacement", Number, "m", "Relative displacement without force.").or_number(0.0),
        PRELOAD_FORCE,
        COORDINATE,
    ],
    ports: Ports::DISPLACEMENT,
    build: |model, attached, parameters| {
        add(model, attached, parameters, Quantity::Length, ["displacement", "force", "damper_force"])
    },
};

fn add(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
    acts_on: Quantity,
    [rest, elastic, damper]: [&str; 3],
) -> Result<Contribution, ParameterError> {
    let coordinate = attached.coordinate()?;
    model.check_quantity(coordinate, acts_on)?;
    let law = ForceLaw::new(parameters, [elastic, damper])?;
    let rest = law.rest(parameters, rest, [model.coordinate_value(coordinate), 0.0])?;
    Ok(OverMeasure::contribution(model, Elongation { coordinate: [coordinate], rest }, law))
}

/// Change of a coordinate since it was at rest.
#[derive(Clone, Debug)]
pub(super) struct Elongation {
    pub(super) coordinate: [CoordinateId; 1],
    /// Coordinate without elongation.
    pub(super) rest: f64,
}

impl Measure for Elongation {
    type Reading = [f64; 2];

    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_coordinates(&self.coordinate)
    }

    fn read(&self, at: &Kinematics) -> [f64; 2] {
        let coordinate = &at.coordinates[self.coordinate[0]];
        [coordinate.value - self.rest, coordinate.rate]
    }

    fn motion(reading: &[f64; 2]) -> [f64; 2] {
        *reading
    }

    fn gradients(&self, _: &[f64; 2]) -> [Gradient; 2] {
        Gradient::of_unknown(0)
    }

    fn add_force(&self, _: &[f64; 2], force: f64, out: &mut [f64]) {
        out[0] += force;
    }
}
