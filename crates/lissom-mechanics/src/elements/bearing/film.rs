//! Short journal bearing and squeeze-film damper: the film of a lubricant between a journal and a bushing, with the pressure of the
//! Reynolds equation without gradients around the circumference [Ocvirk 1952], where it is positive (ruptured film) or everywhere.
//!
//! Legend: c clearance, R radius, L length, μ viscosity, (y, z) displacement of the journal over c, s speed of rotation of the journal
//! relative to the bushing, h film thickness over c at the angle ψ, n = (cos ψ, sin ψ), κ = μ R L³/(2 c²).
//!
//! ```text
//! h = 1 - n·(y, z),      p ~ -(s ∂h/∂ψ + 2 ∂h/∂t)/h³ = D sin(ψ - α)/h³
//! D cos α = -(s y - 2 ż),      D sin α = -(s z + 2 ẏ)
//! force on the journal  -κ D ∫ sin u n/h³ du,      u = ψ - α from 0 to π, or to 2π
//! ```
//!
//! With a and b the displacements along the directions α and α + π/2, e² = a² + b², w = √(1 - e²) [Capone 1986]:
//!
//! ```text
//! G = 2/w (π/2 + arctan(b/w)),      V = (2 + b G)/(1 - e²),      S = a/(1 - a²)
//! ∫ sin u cos u/h³ du = (3 a V - 2 S)/(2 (1 - e²)),      ∫ sin² u/h³ du = (3 b V + G)/(2 (1 - e²))      from 0 to π
//! ```

use std::sync::Arc;

use lissom_motion::{Rotation, Vector3};
use nalgebra::{Matrix5, Vector5};

use super::{BearingLaw, Response, ShaftMotion, contribution};
use crate::dual::{Dual, Number};
use crate::elements::bushing::AXIS;
use crate::elements::contribution::Contribution;
use crate::elements::initial_model::InitialModel;
use crate::elements::kind::{Attached, ElementKind};
use crate::ports::Ports;
use crate::registry::ParameterType::Positive;
use crate::registry::{ModelAxis, ParameterError, ParameterType, Parameters, required, unitless};

/// Names of the films.
const FILMS: [&str; 2] = ["ruptured", "full"];

/// Registry entry.
pub(crate) const KIND: ElementKind = ElementKind {
    name: "journal_bearing",
    summary: "Short journal bearing with a fluid film, or squeeze-film damper of a shaft that does not rotate in it.",
    sample: "at_tip = [0.0, 0.0, 0.0]\nradius = 0.02\nlength = 0.01\nclearance = 5e-5\nviscosity = 0.02",
    parameters: &[
        required("radius", Positive, "m", "Radius of the journal."),
        required("length", Positive, "m", "Length along the shaft, short against the diameter."),
        required("clearance", Positive, "m", "Radial clearance."),
        required("viscosity", Positive, "Pa s", "Dynamic viscosity of the lubricant."),
        unitless(
            "film",
            ParameterType::Choice(&FILMS),
            "Film where the pressure is positive (\"ruptured\"), or everywhere (\"full\").",
        )
        .or_word(FILMS[0]),
        AXIS,
    ],
    ports: Ports::TWO_FRAMES,
    build,
};

/// A film.
#[derive(Debug)]
struct Film {
    /// c [m].
    clearance: f64,
    /// κ [N s].
    factor: f64,
    is_full: bool,
}

fn build(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
) -> Result<Contribution, ParameterError> {
    let (clearance, length) = (parameters.number("clearance")?, parameters.number("length")?);
    if length > 2.0 * parameters.number("radius")? {
        let problem = "is greater than the diameter: such a film has gradients around the circumference, which a short bearing neglects";
        return Err(ParameterError::new("length", problem));
    }
    let viscous = 0.5 * parameters.number("viscosity")? * parameters.number("radius")?;
    let film = Film {
        clearance,
        factor: viscous * length.powi(3) / clearance.powi(2),
        is_full: parameters.word("film")? == FILMS[1],
    };
    let first = parameters.vector_or("axis", ModelAxis::X.direction())?;
    // The film is the same in all directions across the shaft.
    let across = Vector3::ith(first.iamin(), 1.0);
    let axes = Rotation::from_axis_and_reference(&first, &across)
        .ok_or_else(|| ParameterError::new("axis", "has no direction"))?;
    contribution(model, attached, axes, (Arc::new(film), Some(clearance)))
}

/// The two integrals from 0 to π.
fn integrals<N: Number>(a: N, b: N) -> [N; 2] {
    let square = (-(a * a + b * b)).plus(1.0);
    let root = square.square_root();
    let g = (b / root).arc_tangent().plus(std::f64::consts::FRAC_PI_2).scaled(2.0) / root;
    let v = (b * g).plus(2.0) / square;
    let s = a / (-(a * a)).plus(1.0);
    let half = square.scaled(2.0);
    [(a * v.scaled(3.0) - s.scaled(2.0)) / half, (b * v.scaled(3.0) + g) / half]
}

impl Film {
    /// Force on the bushing along axes 2 and 3, over κ, of the displacement over c, its rate and the speed.
    fn force<N: Number>(&self, [y, z, y_rate, z_rate, speed]: [N; 5]) -> [N; 2] {
        let cosine = -(speed * y - z_rate.scaled(2.0));
        let sine = -(speed * z + y_rate.scaled(2.0));
        let square = cosine * cosine + sine * sine;
        // At rest the derivatives are those of a concentric journal; the film has a kink there.
        let amplitude = square.plus(f64::MIN_POSITIVE).square_root();
        let (cosine, sine) = (cosine / amplitude, sine / amplitude);
        let (a, b) = (y * cosine + z * sine, z * cosine - y * sine);
        let mut along = integrals(a, b);
        if self.is_full {
            let opposite = integrals(-a, -b);
            along = [along[0] + opposite[0], along[1] + opposite[1]];
        }
        let [first, second] = along.map(|own| own * amplitude);
        [first * cosine - second * sine, first * sine + second * cosine]
    }
}

impl BearingLaw for Film {
    fn response(&self, motion: &ShaftMotion) -> Response {
        let scale = 1.0 / self.clearance;
        let values = [
            scale * motion.q[1],
            scale * motion.q[2],
            scale * motion.rate[1],
            scale * motion.rate[2],
            motion.speed,
        ];
        let mut variables = [Dual::constant(0.0); 5];
        for (k, (variable, value)) in variables.iter_mut().zip(values).enumerate() {
            *variable = Dual::<5>::variable(value, k);
        }
        let mut out = Response {
            force: Vector5::zeros(),
            by_q: Matrix5::zeros(),
            by_rate: Matrix5::zeros(),
            by_speed: Vector5::zeros(),
        };
        for (row, force) in (1..).zip(self.force(variables)) {
            out.force[row] = self.factor * force.value;
            for k in 0..2 {
                out.by_q[(row, 1 + k)] = self.factor * scale * force.by[k];
                out.by_rate[(row, 1 + k)] = self.factor * scale * force.by[2 + k];
            }
            out.by_speed[row] = self.factor * force.by[4];
        }
        out
    }
}

#[cfg(test)]
#[path = "../../../tests/unit/elements/bearing/film.rs"]
mod tests;
