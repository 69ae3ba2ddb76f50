//! Spring and damper between two points of two nodes, along the line that joins them.
//!
//! ```text
//! Δ = x_B - x_A,   ℓ = |Δ|,   u = Δ/ℓ,   F = k (ℓ - ℓ₀) + c ℓ̇, or another law of ℓ - ℓ₀ and ℓ̇
//! ```

use super::contribution::Contribution;
use super::force_law::{ForceLaw, PRELOAD_FORCE, SIDE_OF_LENGTH};
use super::initial_model::InitialModel;
use super::kind::{Attached, ElementKind};
use super::over_measure::OverMeasure;
use super::polyline::Polyline;
use crate::number::Written;
use crate::ports::Ports;
use crate::registry::ParameterType::NotNegative;
use crate::registry::{Constant, ParameterError, ParameterType, Parameters, optional};

/// Registry entry.
pub(crate) const KIND: ElementKind = ElementKind {
    name: "point",
    summary: "Spring and damper between two points, along the line through them.",
    sample: "stiffness = 100.0\ndamping = 1.0",
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
        optional("length", NotNegative, "m", "Free length; default: the length at the start."),
        PRELOAD_FORCE,
    ],
    ports: Ports::TWO_LOCATIONS,
    build,
};

fn build(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
) -> Result<Contribution, ParameterError> {
    let (nodes, points) = attached.two_nodes()?;
    let [a, b] = [0, 1].map(|i| model.frame(nodes[i]).transform_point(&points[i]));
    let distance = (b - a).norm();
    if distance == 0.0 {
        return Err(ParameterError::new(
            "tip",
            "is at the same position as `base`: the spring has no direction",
        ));
    }
    let law = ForceLaw::new(parameters, ["force", "damper_force"])?;
    let length = law.rest(parameters, "length", [distance; 2])?;
    if length < 0.0 {
        let problem =
            format!("needs a length without force of {} m: give a larger `stiffness`", Written(length));
        return Err(ParameterError::new("preload", problem));
    }
    let line = Polyline::<2>::between(nodes, points, std::sync::Arc::new(Constant(length)));
    Ok(OverMeasure::contribution(model, line, law))
}
