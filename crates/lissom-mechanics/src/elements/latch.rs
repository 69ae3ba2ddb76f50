//! A latch: locks a coordinate of a joint at its value while an input is set, and leaves it free otherwise.
//!
//! Legend: q the coordinate, Λ an impulse, a coordinate without mass whose rate is the force of the latch, see `rolling`.
//!
//! ```text
//! row of q: Λ̇       row of Λ: q̇ = 0 where it holds,   Λ̇ = 0 where it does not
//! ```
//!
//! The impact without rebound at the instant of latching is computed by `Simulation::change_held_values`.

use super::contribution::Contribution;
use super::initial_model::InitialModel;
use super::kind::{Attached, Attachment, ElementKind};
use super::{Capabilities, Element, Spring, Tangents, Unknowns};
use crate::kinematics::{CoordinateId, DiscreteValueId, Kinematics, Quantity};
use crate::registry::{COORDINATE, Parameter, ParameterError, ParameterType, Parameters};
use crate::signals::measurement::Gradient;

const PARAMETERS: &[Parameter] = &[
    COORDINATE,
    Parameter::required(
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
    attachment: Attachment::Coordinate(Quantity::Length),
    build,
};

/// Registry entry for rotations.
pub const TORSIONAL: ElementKind = ElementKind {
    name: "torsional_latch",
    summary: "Locks a joint's relative rotation at its current value while an input is set: latches and releases.",
    attachment: Attachment::Coordinate(Quantity::Angle),
    ..AXIAL
};

/// A latch on a coordinate.
#[derive(Clone, Copy, Debug)]
pub struct Latch {
    /// The joint's coordinate, and the impulse.
    coordinates: [CoordinateId; 2],
    engaged: DiscreteValueId,
}

fn build(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
) -> Result<Contribution, ParameterError> {
    let coordinate = attached.coordinate()?;
    let engaged = parameters.input("engaged")?;
    let mut contribution = Contribution::to(model);
    let name = format!("{}, latched", model.coordinate_name(coordinate));
    let impulse = contribution.add_impulse(name, Vec::new(), vec![coordinate]);
    contribution.latches.push(engaged);
    Ok(contribution.with(Latch { coordinates: [coordinate, impulse], engaged }))
}

/// Whether an input of this value engages a latch.
pub fn holds(input: f64) -> bool {
    input > 0.5
}

impl Latch {
    fn holds(&self, at: &Kinematics) -> bool {
        at.held.get(self.engaged.index()).is_some_and(|&input| holds(input))
    }
}

impl Element for Latch {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_coordinates(&self.coordinates)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let [own, impulse] = self.coordinates.map(|coordinate| at.coordinates[coordinate].rate);
        out[0] += impulse;
        out[1] += if self.holds(at) { own } else { impulse };
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let [by_own, by_impulse] = if self.holds(at) { [1.0, 0.0] } else { [0.0, 1.0] };
        out.damping[1] += 1.0;
        out.damping[2] += by_own;
        out.damping[3] += by_impulse;
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { spring: Some(self), ..Capabilities::default() }
    }
}

impl Spring for Latch {
    fn spring_motion(&self, at: &Kinematics) -> [f64; 3] {
        let [own, impulse] = self.coordinates.map(|coordinate| at.coordinates[coordinate]);
        [own.value, own.rate, impulse.rate]
    }

    fn spring_gradients(&self, _: &Kinematics) -> [Gradient; 3] {
        let ([value, rate], [_, force]) = (Gradient::of_unknown(0), Gradient::of_unknown(1));
        [value, rate, force]
    }
}

#[cfg(test)]
mod tests {
    use super::holds;

    #[test]
    fn inputs_above_one_half_hold() {
        for (input, wanted) in
            [(0.0, false), (0.5, false), (0.5_f64.next_up(), true), (1.0, true), (f64::NAN, false)]
        {
            assert_eq!(holds(input), wanted, "{input}");
        }
    }
}
