//! Springs and dampers on a joint's relative rotation or displacement: moment or force k (φ - φ₀) + c φ̇, or
//! another law of φ - φ₀ and φ̇.

use super::contribution::Contribution;
use super::force_law::{ForceLaw, PRELOAD_FORCE, PRELOAD_MOMENT, SIDE_OF_ANGLE, SIDE_OF_LENGTH};
use super::initial_model::InitialModel;
use super::kind::{Attached, ElementKind};
use super::{Capabilities, Element, Energy, ForceLaws, Load, Spring, Tangents, Unknowns};
use crate::evaluation::switch_states::SwitchStates;
use crate::kinematics::{CoordinateId, Kinematics, Quantity, Switch};
use crate::law::VisitLaw;
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

/// Spring and damper on an algebraic coordinate.
#[derive(Clone, Debug)]
pub(crate) struct CoordinateSpring {
    coordinate: [CoordinateId; 1],
    law: ForceLaw,
    /// Coordinate at zero force.
    rest: f64,
    switch_states: SwitchStates,
}

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
    Ok(Contribution::of(
        model,
        CoordinateSpring { coordinate: [coordinate], law, rest, switch_states: SwitchStates::default() },
    ))
}

impl CoordinateSpring {
    /// Elongation and its rate.
    fn motion(&self, at: &Kinematics) -> [f64; 2] {
        let coordinate = &at.coordinates[self.coordinate[0]];
        [coordinate.value - self.rest, coordinate.rate]
    }
}

impl Element for CoordinateSpring {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_coordinates(&self.coordinate)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let [elongation, rate] = self.motion(at);
        out[0] += self.law.evaluate(elongation, rate, self.switch_states.of(at)).force;
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let [elongation, rate] = self.motion(at);
        let response = self.law.evaluate(elongation, rate, self.switch_states.of(at));
        out.stiffness[0] += response.stiffness;
        out.damping[0] += response.damping;
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        Energy { strain: self.law.energy(self.motion(at)[0]), ..Energy::default() }
    }

    fn switch_states(&mut self) -> Option<&mut SwitchStates> {
        Some(&mut self.switch_states)
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { load: Some(self), spring: Some(self), laws: Some(self), ..Capabilities::default() }
    }
}

impl Load for CoordinateSpring {
    fn is_active(&self) -> bool {
        self.law.is_active()
    }
}

impl Spring for CoordinateSpring {
    fn dissipates(&self) -> bool {
        self.law.depends_on_rate()
    }

    fn spring_motion(&self, at: &Kinematics) -> [f64; 3] {
        let [elongation, rate] = self.motion(at);
        [elongation, rate, self.law.evaluate(elongation, rate, self.switch_states.of(at)).force]
    }

    fn spring_gradients(&self, at: &Kinematics) -> [Gradient; 3] {
        let [elongation, rate] = self.motion(at);
        self.law.evaluate(elongation, rate, self.switch_states.of(at)).gradients(Gradient::of_unknown(0))
    }
}

impl ForceLaws for CoordinateSpring {
    fn switch_count(&self) -> usize {
        self.law.switch_count()
    }

    fn switches(&self, at: &Kinematics, out: &mut Vec<Switch>) {
        let [elongation, rate] = self.motion(at);
        self.law.switches(elongation, rate, self.switch_states.of(at), out);
    }

    fn laws(&self, at: &Kinematics, visit: &mut VisitLaw<'_>) {
        if !self.law.is_linear() {
            visit(&self.law, &self.motion(at));
        }
    }
}
