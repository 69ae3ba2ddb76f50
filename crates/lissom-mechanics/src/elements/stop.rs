//! Stops at the ends of a joint's range, with the contact law of Hunt and Crossley [1975].
//!
//! Legend: δ penetration beyond an end of the range, k stiffness, n exponent, a dissipation factor, e restitution, v
//! velocity of impact.
//!
//! ```text
//! f = k δⁿ max(0, 1 + a δ̇),      P = k δⁿ⁺¹/(n + 1)
//! A (1 + e) = ln((1 + A)/(1 - e A)),      a = A/v
//! ```
//!
//! The second line is exact for a body that meets the stop at v under no other force: m δ̇ dδ̇/(1 + a δ̇) = -k δⁿ dδ over
//! the whole contact, for any m, k and n. The force is continuous at touch and never pulls. The law determines the relation
//! between e and the impact velocity: slower impacts dissipate less.

use super::contribution::Contribution;
use super::force_law::Response;
use super::initial_model::InitialModel;
use super::kind::{Attached, Attachment, ElementKind};
use super::{Element, Energy, Tangents};
use crate::evaluation::switch_states::{SwitchStates, is_on_upper_branch};
use crate::kinematics::{CoordinateId, Kinematics, NodeId, Quantity, Switch};
use crate::registry::{COORDINATE, Parameter, ParameterError, ParameterType, Parameters};
use crate::signals::measurement::Gradient;

/// Smallest restitution of a contact.
const MIN_RESTITUTION: f64 = 0.01;

/// Registry entry of the stop of a rotation.
pub const TORSIONAL: ElementKind = ElementKind {
    name: "torsional_stop",
    summary: "Stops at the ends of the range of a joint's relative rotation.",
    sample: "range = [-0.1, 1.57]\nstiffness = 1e4",
    parameters: &[
        Parameter::required(
            "range",
            ParameterType::Range,
            "rad",
            "Rotations of the two stops; none at an infinite end.",
        ),
        Parameter::required(
            "stiffness",
            ParameterType::Positive,
            "N m/rad^n",
            "Moment at a penetration of 1 rad.",
        ),
        Parameter::optional("exponent", ParameterType::Positive, "", "Exponent n, at least 1; default 1."),
        Parameter::optional(
            "dissipation",
            ParameterType::NotNegative,
            "s/rad",
            "Factor a of the penetration rate; default 0.",
        ),
        Parameter::optional(
            "restitution",
            ParameterType::Positive,
            "",
            "Instead of `dissipation`: rate after an impact over that before, 0.01 to 1, at `impact_velocity`.",
        ),
        Parameter::optional("impact_velocity", ParameterType::Positive, "rad/s", "Rate of that impact."),
        COORDINATE,
    ],
    attachment: Attachment::Coordinate(Quantity::Angle),
    build: |model, attached, parameters| add(model, attached, parameters, Quantity::Angle),
};

/// Registry entry of the stop of a displacement.
pub const AXIAL: ElementKind = ElementKind {
    name: "axial_stop",
    summary: "Stops at the ends of the range of a joint's relative displacement.",
    sample: "range = [-0.1, 0.05]\nstiffness = 1e6",
    parameters: &[
        Parameter::required(
            "range",
            ParameterType::Range,
            "m",
            "Displacements of the two stops; none at an infinite end.",
        ),
        Parameter::required("stiffness", ParameterType::Positive, "N/m^n", "Force at a penetration of 1 m."),
        Parameter::optional("exponent", ParameterType::Positive, "", "Exponent n, at least 1; default 1."),
        Parameter::optional(
            "dissipation",
            ParameterType::NotNegative,
            "s/m",
            "Factor a of the penetration rate; default 0.",
        ),
        Parameter::optional(
            "restitution",
            ParameterType::Positive,
            "",
            "Instead of `dissipation`: velocity after an impact over that before, 0.01 to 1, at `impact_velocity`.",
        ),
        Parameter::optional("impact_velocity", ParameterType::Positive, "m/s", "Velocity of that impact."),
        COORDINATE,
    ],
    attachment: Attachment::Coordinate(Quantity::Length),
    build: |model, attached, parameters| add(model, attached, parameters, Quantity::Length),
};

/// Stops on an algebraic coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Stop {
    coordinate: [CoordinateId; 1],
    range: [f64; 2],
    stiffness: f64,
    exponent: f64,
    dissipation: f64,
    switch_states: SwitchStates,
}

fn add(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
    acts_on: Quantity,
) -> Result<Contribution, ParameterError> {
    let coordinate = attached.coordinate()?;
    model.check_quantity(coordinate, acts_on)?;
    let exponent = parameters.number_or("exponent", 1.0)?;
    if exponent < 1.0 {
        return Err(ParameterError::new("exponent", "must be 1 or greater: the stiffness would be infinite"));
    }
    let range = parameters.range("range")?.ok_or_else(|| ParameterError::new("range", "is missing"))?;
    let stop = Stop {
        coordinate: [coordinate],
        range,
        stiffness: parameters.number("stiffness")?,
        exponent,
        dissipation: dissipation(parameters)?,
        switch_states: SwitchStates::default(),
    };
    Ok(Contribution::of(model, stop))
}

/// The factor a, given or computed from the restitution.
fn dissipation(parameters: &Parameters) -> Result<f64, ParameterError> {
    if !parameters.has("restitution") {
        if parameters.has("impact_velocity") {
            return Err(ParameterError::new("impact_velocity", "has no meaning without `restitution`"));
        }
        return parameters.number_or("dissipation", 0.0);
    }
    if parameters.has("dissipation") {
        return Err(ParameterError::new(
            "dissipation",
            "and `restitution` are alternatives: remove one of them",
        ));
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

/// A of a restitution e, by bisection between 0 and 1/e: A (1 + e) is below the logarithm only near 1/e.
fn relative_dissipation(restitution: f64) -> f64 {
    if restitution >= 1.0 {
        return 0.0;
    }
    let is_below = |a: f64| a * (1.0 + restitution) > (a.ln_1p() - (-restitution * a).ln_1p());
    let (mut low, mut high) = (0.0, 1.0 / restitution);
    // To the last digit of a value up to 100.
    for _ in 0..70 {
        let middle = 0.5 * (low + high);
        if is_below(middle) { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

impl Stop {
    /// Penetration and its rate, and the direction of the force on the left-hand side.
    fn contact(&self, at: &Kinematics) -> Option<(f64, f64, f64)> {
        let rate = at.coordinates[self.coordinate[0]].rate;
        let [past_high, past_low] = self.depths(at);
        let sides = self.switch_states.of(at);
        // A contact that lasts until the end of a step may end within it: its force is continued along a straight line,
        // if it is linear.
        let depth = |depth: f64| if self.exponent == 1.0 { depth } else { depth.max(0.0) };
        if is_on_upper_branch(sides.first(), past_high) {
            Some((depth(past_high), rate, 1.0))
        } else if is_on_upper_branch(sides.get(1), past_low) {
            Some((depth(past_low), -rate, -1.0))
        } else {
            None
        }
    }

    /// Penetration of the upper and the lower end of its range.
    fn depths(&self, at: &Kinematics) -> [f64; 2] {
        let value = at.coordinates[self.coordinate[0]].value;
        [value - self.range[1], self.range[0] - value]
    }

    fn force(&self, at: &Kinematics) -> f64 {
        self.contact(at).map_or(0.0, |(depth, rate, direction)| {
            direction * self.stiffness * depth.powf(self.exponent) * (1.0 + self.dissipation * rate).max(0.0)
        })
    }

    /// The force with its derivatives.
    fn response(&self, at: &Kinematics) -> Response {
        let mut response = Response { force: self.force(at), ..Response::default() };
        if let Some((depth, rate, _)) = self.contact(at) {
            let factor = 1.0 + self.dissipation * rate;
            if factor > 0.0 {
                let slope = self.exponent * depth.powf(self.exponent - 1.0);
                response.stiffness = self.stiffness * slope * factor;
                response.damping = self.stiffness * depth.powf(self.exponent) * self.dissipation;
            }
        }
        response
    }
}

impl Element for Stop {
    fn nodes(&self) -> &[NodeId] {
        &[]
    }

    fn coordinates(&self) -> &[CoordinateId] {
        &self.coordinate
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        out[0] += self.force(at);
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let response = self.response(at);
        out.stiffness[0] += response.stiffness;
        out.damping[0] += response.damping;
    }

    fn switch_count(&self) -> usize {
        2
    }

    fn freeze_switches(&mut self, switch_states: SwitchStates) {
        self.switch_states = switch_states;
    }

    fn switches(&self, at: &Kinematics, out: &mut Vec<Switch>) {
        out.extend(self.depths(at).map(Switch::from));
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        let strain = self.contact(at).map_or(0.0, |(depth, ..)| {
            self.stiffness * depth.powf(self.exponent + 1.0) / (self.exponent + 1.0)
        });
        Energy { strain, ..Energy::default() }
    }

    fn spring_motion(&self, at: &Kinematics) -> Option<[f64; 3]> {
        let coordinate = &at.coordinates[self.coordinate[0]];
        Some([coordinate.value, coordinate.rate, self.force(at)])
    }

    fn spring_gradients(&self, at: &Kinematics) -> [Gradient; 3] {
        self.response(at).gradients(Gradient::of_unknown(0))
    }
}

#[cfg(test)]
mod tests {
    use super::relative_dissipation;

    #[test]
    fn dissipation_follows_from_restitution() {
        for restitution in [0.05, 0.1, 0.5, 0.8, 0.99] {
            let a = relative_dissipation(restitution);
            let residual = a * (1.0 + restitution) - ((1.0 + a) / (1.0 - restitution * a)).ln();
            assert!(residual.abs() < 1e-9 * (1.0 + a) && a > 0.0, "{restitution}: {a} {residual:e}");
        }
        // 1/e, to all digits.
        assert!((relative_dissipation(0.01) - 100.0).abs() < 1e-9);
        // For small losses: 3 (1 - e)/2.
        assert!((relative_dissipation(0.999) - 1.5e-3).abs() < 5e-6);
        assert_eq!(relative_dissipation(1.0), 0.0);
    }
}
