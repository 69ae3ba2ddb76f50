//! Brush model of a tread with a parabola of pressure [Pacejka 2012, chapter 3].
//!
//! Legend: κ and tan α slips, γ camber, c stiffness per slip and normal force N, μ friction, t trail, f rolling resistance.
//!
//! ```text
//! q = (c₁ κ, -c₂ tan α - c_γ sin γ),    p = |q|/(3 μ),    F = N q (3 - 3 p + p²)/3,   beyond p = 1 μ N q/|q|
//! t = t₀ (1 - p)³/(1 - p + p²/3),    M_n = -t F₂ (direction of travel),    M_a = -f N R (direction of rotation)
//! ```
//!
//! The parabola of pressure makes the sum of forces of a brush this cubic, and the force of the tread acts behind the centre of contact.

use super::tread::{Slip, Tread};
use crate::dual::Number;
use crate::registry::{ParameterError, Parameters};

/// Forces of a brush over its slip.
#[derive(Clone, Copy, Debug)]
pub(super) struct Brush {
    /// k and d.
    pub(super) normal: [f64; 2],
    /// μ, and its decrease with the normal force.
    pub(super) friction: [f64; 2],
    /// c₁, c₂ and c_γ.
    pub(super) slip: [f64; 3],
    /// t₀.
    pub(super) trail: f64,
    /// σ.
    pub(super) relaxation: [f64; 2],
    /// f R.
    pub(super) resistance: f64,
}

impl Brush {
    pub(super) fn new(radius: f64, parameters: &Parameters) -> Result<Self, ParameterError> {
        let number = |key| parameters.number(key);
        Ok(Self {
            normal: [number("stiffness")?, number("damping")?],
            friction: [number("friction_coefficient")?, number("load_sensitivity")?],
            slip: [number("slip_stiffness")?, number("cornering_stiffness")?, number("camber_stiffness")?],
            trail: parameters.number_or("pneumatic_trail", 0.1 * radius)?,
            relaxation: [
                parameters.number_or("longitudinal_relaxation_length", 0.5 * radius)?,
                parameters.number_or("relaxation_length", radius)?,
            ],
            resistance: number("rolling_resistance")? * radius,
        })
    }

    /// μ under a normal force.
    pub(super) fn friction<T: Number>(&self, normal: T) -> T {
        T::constant(self.friction[0]) / normal.scaled(self.friction[1]).plus(1.0)
    }

    pub(super) fn tread<T: Number>(&self, slip: &Slip<T>) -> Tread<T> {
        let [along, across, camber] = self.slip;
        let normal = slip.normal;
        let pull = [slip.along.scaled(along), -slip.across.scaled(across) - slip.lean.scaled(camber)];
        let size = (pull[0] * pull[0] + pull[1] * pull[1]).plus(1e-24).square_root();
        let friction = self.friction(normal);
        let part = size / friction.scaled(3.0);
        let zero = T::constant(0.0);
        let resisting = (normal * slip.turning).scaled(-self.resistance);
        let tread = |force: [T; 2], aligning| Tread {
            along: force[0],
            across: force[1],
            overturning: zero,
            resisting,
            aligning,
        };
        if part.value() >= 1.0 {
            return tread(pull.map(|pull| normal * friction * pull / size), zero);
        }
        let share = (part * part - part.scaled(3.0)).plus(3.0).scaled(1.0 / 3.0);
        let force = pull.map(|pull| normal * pull * share);
        let rest = T::constant(1.0) - part;
        let trail = (rest * rest * rest / (rest + (part * part).scaled(1.0 / 3.0))).scaled(self.trail);
        tread(force, -trail * force[1] * slip.forwards)
    }
}
