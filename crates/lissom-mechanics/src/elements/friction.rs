//! Dry friction on a joint's relative rotation or displacement, by a bristle that deflects before it slips [Canudas
//! de Wit, Olsson, Åström and Lischinsky 1995].
//!
//! Legend: v rate of the coordinate, z deflection of the bristle (a first-order state), F_c Coulomb and F_s static friction,
//! v_s Stribeck's velocity, σ₀ = F_c/z_c stiffness with the deflection z_c at slip, σ₁ damping, σ₂ viscous friction.
//!
//! ```text
//! z' = v - σ₀ |v| z/g(v),      g = F_c + (F_s - F_c) exp(-(v/v_s)²),      F = σ₀ z + σ₁ z' + σ₂ v
//! ```

use super::contribution::Contribution;
use super::initial_model::InitialModel;
use super::kind::{Attached, ElementKind};
use super::{Bristle, Capabilities, Element, Energy, Spring, StrainSlopes, Tangents, Unknowns};
use crate::kinematics::{CoordinateId, Kinematics, Quantity};
use crate::ports::Ports;
use crate::registry::ParameterType::{NotNegative, Positive};
use crate::registry::{COORDINATE, ParameterError, Parameters, optional, required};
use crate::signals::measurement::Gradient;

/// Default deflection at which the bristle slips [rad, m].
const DEFLECTION: f64 = 1e-4;
/// Path of the first step over the deflection at slip beyond which a bristle begins in its steady state: a shorter step resolves a part
/// of the way there.
const SUDDEN_START: f64 = 20.0;
/// Path of a step over the deflection at slip beyond which stages do not resolve the bristle.
const UNRESOLVED: f64 = 0.3;
/// Distance of the deflection from that of steady sliding, relative to it, below which its work is that of stages.
const STEADY: f64 = 1e-3;

/// Registry entry of friction on a rotation.
pub const TORSIONAL: ElementKind = ElementKind {
    name: "torsional_friction",
    summary: "Dry and viscous friction on a joint's relative rotation; sticking is free of creep.",
    sample: "coulomb = 0.5",
    parameters: &[
        required("coulomb", Positive, "N m", "Moment of sliding friction."),
        optional("breakaway", Positive, "N m", "Additional moment of friction at rest; default none."),
        optional("stribeck", Positive, "rad/s", "Rate at which the additional moment has fallen to 1/e.")
            .or_number(0.01),
        optional("viscous", NotNegative, "N m s/rad", "Additional moment per rate.").or_number(0.0),
        optional("deflection", Positive, "rad", "Elastic rotation before it slips.").or_number(DEFLECTION),
        optional("damping", NotNegative, "N m s/rad", "Damping of the elastic rotation.").or_number(0.0),
        COORDINATE,
    ],
    ports: Ports::ROTATION,
    build: |model, attached, parameters| add(model, attached, parameters, Quantity::Angle),
};

/// Registry entry of friction on a displacement.
pub const AXIAL: ElementKind = ElementKind {
    name: "axial_friction",
    summary: "Dry and viscous friction on a joint's relative displacement; sticking is free of creep.",
    sample: "coulomb = 5.0",
    parameters: &[
        required("coulomb", Positive, "N", "Force of sliding friction."),
        optional("breakaway", Positive, "N", "Additional force of friction at rest; default none."),
        optional("stribeck", Positive, "m/s", "Velocity at which the additional force has fallen to 1/e.")
            .or_number(0.01),
        optional("viscous", NotNegative, "N s/m", "Additional force per velocity.").or_number(0.0),
        optional("deflection", Positive, "m", "Elastic displacement before it slips.").or_number(DEFLECTION),
        optional("damping", NotNegative, "N s/m", "Damping of the elastic displacement.").or_number(0.0),
        COORDINATE,
    ],
    ports: Ports::DISPLACEMENT,
    build: |model, attached, parameters| add(model, attached, parameters, Quantity::Length),
};

/// Friction on an algebraic coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Friction {
    /// The joint's coordinate, then the bristle's deflection.
    coordinates: [CoordinateId; 2],
    coulomb: f64,
    breakaway: f64,
    stribeck: f64,
    viscous: f64,
    stiffness: f64,
    damping: f64,
}

fn add(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
    acts_on: Quantity,
) -> Result<Contribution, ParameterError> {
    let coordinate = attached.coordinate()?;
    model.check_quantity(coordinate, acts_on)?;
    let coulomb = parameters.number("coulomb")?;
    let deflection = parameters.number("deflection")?;
    let name = format!("{}, friction", model.coordinate_name(coordinate));
    let mut contribution = Contribution::to(model);
    let bristle = contribution.add_state(name, 0.0, deflection);
    Ok(contribution.with(Friction {
        coordinates: [coordinate, bristle],
        coulomb,
        breakaway: parameters.number_or("breakaway", 0.0)?,
        stribeck: parameters.number("stribeck")?,
        viscous: parameters.number("viscous")?,
        stiffness: coulomb / deflection,
        damping: parameters.number("damping")?,
    }))
}

impl Friction {
    /// g(v) and its derivative.
    fn limit(&self, rate: f64) -> (f64, f64) {
        let relative = rate / self.stribeck;
        let more = self.breakaway * (-relative * relative).exp();
        (self.coulomb + more, -2.0 * more * relative / self.stribeck)
    }
}

impl Element for Friction {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_coordinates(&self.coordinates)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let [rate, bristle] = self.coordinates.map(|coordinate| at.coordinates[coordinate]);
        let rate = rate.rate;
        let (limit, _) = self.limit(rate);
        out[0] += self.stiffness * bristle.value + self.damping * bristle.rate + self.viscous * rate;
        out[1] += bristle.rate - rate + self.stiffness * rate.abs() * bristle.value / limit;
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let [rate, bristle] = self.coordinates.map(|coordinate| at.coordinates[coordinate]);
        let (rate, value) = (rate.rate, bristle.value);
        let (limit, slope) = self.limit(rate);
        let sign = if rate == 0.0 { 0.0 } else { rate.signum() };
        out.stiffness[1] += self.stiffness;
        out.damping[0] += self.viscous;
        out.damping[1] += self.damping;
        out.damping[2] += self.stiffness * value * (sign - rate.abs() * slope / limit) / limit - 1.0;
        out.stiffness[3] += self.stiffness * rate.abs() / limit;
        out.damping[3] += 1.0;
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        let deflection = at.coordinates[self.coordinates[1]].value;
        Energy { strain: 0.5 * self.stiffness * deflection * deflection, ..Energy::default() }
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities {
            spring: Some(self),
            strain: Some(self),
            bristle: Some(self),
            ..Capabilities::default()
        }
    }
}

impl Spring for Friction {
    fn dissipates(&self) -> bool {
        true
    }

    fn spring_motion(&self, at: &Kinematics) -> [f64; 3] {
        let coordinate = at.coordinates[self.coordinates[0]];
        let mut forces = [0.0; 2];
        self.forces(at, &mut forces);
        [coordinate.value, coordinate.rate, forces[0]]
    }

    fn spring_gradients(&self, _: &Kinematics) -> Option<[Gradient; 3]> {
        let ([value, rate], [deflection, deflecting]) = (Gradient::of_unknown(0), Gradient::of_unknown(1));
        let elastic = Gradient::zero().plus(self.stiffness, &deflection).plus(self.damping, &deflecting);
        Some([value, rate, elastic.plus(self.viscous, &rate)])
    }
}

impl Bristle for Friction {
    fn steady_at_start(&self, at: &Kinematics, size: f64) -> Option<(CoordinateId, f64)> {
        let [coordinate, bristle] = self.coordinates.map(|coordinate| at.coordinates[coordinate]);
        let steady = self.limit(coordinate.rate).0 / self.stiffness * coordinate.rate.signum();
        let is_sudden = bristle.value == 0.0 && size * coordinate.rate.abs() > SUDDEN_START * steady.abs();
        is_sudden.then_some((self.coordinates[1], steady))
    }

    /// With g constant, the path s of the coordinate in one direction, the deflection z₀ at its start and that of steady sliding z_s = g/σ₀:
    ///
    /// ```text
    /// z(s) = z_s + (z₀ - z_s) exp(-s/z_s)
    /// ```
    fn unresolved_work(&self, from: &Kinematics, to: &Kinematics) -> Option<f64> {
        let [start, end] = [from, to].map(|at| at.coordinates[self.coordinates[0]]);
        let change = end.value - start.value;
        let path = change.abs();
        let limits = [start, end].map(|coordinate| self.limit(coordinate.rate).0);
        let steady = 0.5 * (limits[0] + limits[1]) / self.stiffness;
        let first = from.coordinates[self.coordinates[1]].value * change.signum();
        let turns = start.rate * change < 0.0 || end.rate * change < 0.0;
        let varies = (limits[1] - limits[0]).abs() > STEADY * limits[0];
        if turns || varies || path <= UNRESOLVED * steady || (first - steady).abs() <= STEADY * steady {
            return None;
        }
        let share = -(-path / steady).exp_m1();
        let elastic = self.stiffness * (steady * path + (first - steady) * steady * share);
        let damped = self.damping * start.rate.abs() * (steady - first) * share;
        let squares = (start.rate * start.rate + start.rate * end.rate + end.rate * end.rate) / 3.0;
        Some(-elastic - damped - self.viscous * (to.time - from.time) * squares)
    }
}

impl StrainSlopes for Friction {
    /// Slopes of the strain energy of the bristle alone: the force of the coordinate is that of the bristle.
    fn strain_slopes(&self, fall: &Kinematics, out: &mut [f64]) {
        out[1] += self.stiffness * fall.coordinates[self.coordinates[1]].value;
    }
}
