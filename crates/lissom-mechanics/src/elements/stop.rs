//! Stops at the ends of a joint's range, with the law of Hunt and Crossley, see `contact::compliance`. The law determines the relation between restitution and
//! impact velocity: slower impacts dissipate less.

use super::contribution::Contribution;
use super::coordinate_spring::Elongation;
use super::force_law::Response;
use super::initial_model::InitialModel;
use super::kind::{Attached, ElementKind};
use super::over_measure::{MeasuredLaw, OverMeasure};
use super::{Limit, LimitKind};
use crate::compliance::{Compliance, MIN_RESTITUTION, relative_dissipation};
use crate::evaluation::switch_states::is_on_upper_branch;
use crate::kinematics::{Quantity, Switch};
use crate::ports::Ports;
use crate::registry::ParameterType::{NotNegative, Positive};
use crate::registry::{COORDINATE, ParameterError, ParameterType, Parameters, optional, required, unitless};

/// Registry entry of the stop of a rotation.
pub const TORSIONAL: ElementKind = ElementKind {
    name: "torsional_stop",
    summary: "Stops at the ends of the range of a joint's relative rotation.",
    sample: "range = [-0.1, 1.57]\nstiffness = 1e4",
    parameters: &[
        required(
            "range",
            ParameterType::Range,
            "rad",
            "Rotations of the two stops; none at an infinite end.",
        ),
        required("stiffness", Positive, "N m/rad^n", "Moment at a penetration of 1 rad."),
        unitless("exponent", Positive, "Exponent n, at least 1.").or_number(1.0),
        optional("dissipation", NotNegative, "s/rad", "Factor a of the penetration rate.").or_number(0.0),
        optional("damping", NotNegative, "N m s/rad", "Moment per penetration rate, while in contact.")
            .or_number(0.0),
        unitless(
            "restitution",
            Positive,
            "Instead of `dissipation`: rate after an impact over that before, 0.01 to 1, at `impact_velocity`.",
        ),
        optional("impact_velocity", Positive, "rad/s", "Rate of that impact."),
        COORDINATE,
    ],
    ports: Ports::ROTATION,
    build: |model, attached, parameters| add(model, attached, parameters, Quantity::Angle),
};

/// Registry entry of the stop of a displacement.
pub const AXIAL: ElementKind = ElementKind {
    name: "axial_stop",
    summary: "Stops at the ends of the range of a joint's relative displacement.",
    sample: "range = [-0.1, 0.05]\nstiffness = 1e6",
    parameters: &[
        required(
            "range",
            ParameterType::Range,
            "m",
            "Displacements of the two stops; none at an infinite end.",
        ),
        required("stiffness", Positive, "N/m^n", "Force at a penetration of 1 m."),
        unitless("exponent", Positive, "Exponent n, at least 1.").or_number(1.0),
        optional("dissipation", NotNegative, "s/m", "Factor a of the penetration rate.").or_number(0.0),
        optional("damping", NotNegative, "N s/m", "Force per penetration rate, while in contact.")
            .or_number(0.0),
        unitless(
            "restitution",
            Positive,
            "Instead of `dissipation`: velocity after an impact over that before, 0.01 to 1, at `impact_velocity`.",
        ),
        optional("impact_velocity", Positive, "m/s", "Velocity of that impact."),
        COORDINATE,
    ],
    ports: Ports::DISPLACEMENT,
    build: |model, attached, parameters| add(model, attached, parameters, Quantity::Length),
};

/// Length or angle to which a stop with one end at zero is compared [m or rad].
const MIN_RANGE: f64 = 0.1;

/// Force of the stops at both ends of a range.
#[derive(Clone, Debug)]
struct Stops {
    range: [f64; 2],
    compliance: Compliance,
    /// Factor a and damping c.
    dissipation: [f64; 2],
}

fn add(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
    acts_on: Quantity,
) -> Result<Contribution, ParameterError> {
    let coordinate = attached.coordinate()?;
    model.check_quantity(coordinate, acts_on)?;
    let exponent = parameters.number("exponent")?;
    if exponent < 1.0 {
        return Err(ParameterError::new("exponent", "must be 1 or greater: the stiffness would be infinite"));
    }
    let range = parameters.range("range")?.ok_or_else(|| ParameterError::new("range", "is missing"))?;
    let stops = Stops {
        range,
        compliance: Compliance { stiffness: parameters.number("stiffness")?, exponent },
        dissipation: [dissipation(parameters)?, parameters.number("damping")?],
    };
    Ok(OverMeasure::contribution(model, Elongation { coordinate: [coordinate], rest: 0.0 }, stops))
}

/// The factor a, given or computed from the restitution.
fn dissipation(parameters: &Parameters) -> Result<f64, ParameterError> {
    if !parameters.has("restitution") {
        if parameters.has("impact_velocity") {
            return Err(ParameterError::new("impact_velocity", "has no meaning without `restitution`"));
        }
        return parameters.number("dissipation");
    }
    if parameters.has("dissipation") {
        return Err(ParameterError::new(
            "dissipation",
            "and `restitution` are alternatives: remove one of them",
        ));
    }
    if parameters.has("damping") {
        let problem = "and `restitution` are alternatives: remove one of them, the damping would reduce the restitution";
        return Err(ParameterError::new("damping", problem));
    }
    let restitution = parameters.number("restitution")?;
    if !(MIN_RESTITUTION..=1.0).contains(&restitution) {
        return Err(ParameterError::new("restitution", format!("must be from {MIN_RESTITUTION} to 1")));
    }
    if !parameters.has("impact_velocity") {
        let problem = "requires `impact_velocity`, for which it is valid: slower impacts lose less";
        return Err(ParameterError::new("restitution", problem));
    }
    Ok(relative_dissipation(restitution) / parameters.number("impact_velocity")?)
}

impl Stops {
    /// Penetration and its rate, and the direction of the force on the left-hand side.
    fn contact(&self, [value, rate]: [f64; 2], sides: &[f64]) -> Option<(f64, f64, f64)> {
        let [past_high, past_low] = self.depths(value);
        if is_on_upper_branch(sides.first(), past_high) {
            Some((past_high, rate, 1.0))
        } else if is_on_upper_branch(sides.get(1), past_low) {
            Some((past_low, -rate, -1.0))
        } else {
            None
        }
    }

    /// Penetration of the upper and the lower end of its range.
    fn depths(&self, value: f64) -> [f64; 2] {
        [value - self.range[1], self.range[0] - value]
    }
}

impl MeasuredLaw for Stops {
    const SUPPLIES: bool = false;

    fn is_active(&self) -> bool {
        false
    }

    fn response(&self, motion: [f64; 2], sides: &[f64]) -> Response {
        let Some((depth, rate, direction)) = self.contact(motion, sides) else { return Response::default() };
        let [force, stiffness, damping] = self.compliance.damped_force(depth, rate, self.dissipation);
        Response { force: direction * force, stiffness, damping }
    }

    fn energy(&self, value: f64, sides: &[f64]) -> f64 {
        self.contact([value, 0.0], sides).map_or(0.0, |(depth, ..)| self.compliance.energy(depth))
    }

    fn dissipates(&self) -> bool {
        self.dissipation.iter().any(|of| *of > 0.0)
    }

    fn switch_count(&self) -> usize {
        2
    }

    fn add_switches(&self, [value, _]: [f64; 2], _: &[f64], out: &mut Vec<Switch>) {
        out.extend(self.depths(value).map(Switch::from));
    }

    const LIMITS: &'static [LimitKind] = &[LimitKind::Stop];

    fn limit(&self, value: f64) -> Option<Limit<'_>> {
        let [low, high] = self.range;
        let finite = [low, high].map(|end| if end.is_finite() { end.abs() } else { 0.0 });
        let range =
            if (high - low).is_finite() { high - low } else { finite[0].max(finite[1]).max(MIN_RANGE) };
        let depth = self.depths(value).into_iter().fold(0.0, f64::max);
        (depth > 0.0).then(|| Limit::of_element(depth, range))
    }
}
