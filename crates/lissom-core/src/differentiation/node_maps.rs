//! Variations of a node at a stage as linear functions of those at the start of the step and of the increments: the derivatives of
//! `node_motion`.
//!
//! Legend: η, ν, α variations of pose, twist and its time derivative, at the start η₀, ν₀; z increment, V₀ twist at the start, t time
//! since the start; ζ rate and κ second derivative of the increment, A = Ad(exp(-z)), E = exp(V₀ t), T tangent operator, U = A V₀.
//!
//! ```text
//! from the start:  η = Ad(exp(-ψ)) η₀ + T(ψ) (t ν₀ + δz),  ψ = V₀ t + z,      ν = ν₀ + δζ,      α = δκ
//! departures:      e = T(z) δz,      η = A (Ad(E⁻¹) η₀ + T(V₀ t) t ν₀) + e
//!                  δU = A ν₀ + ad_U e,     δW = T δζ + ∂(T ζ)/∂z δz,     ν = δU + δW
//!                  α = T δκ + ∂(T κ + Ṫ ζ)/∂z δz + ∂(Ṫ ζ)/∂ζ δζ + ad_U δW - ad_W δU
//! ```

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{
    Block, Matrix6, Motion, ScrewTangent, Vector6, WIDTH, lie_bracket_matrix, tangent,
    tangent_derivative_rate, tangent_rate,
};

use super::variation::NOTHING;
use crate::schemes::Parametrization;

/// Six components of a node, each for all lanes.
pub(super) type Six = [Block; 6];

/// A node's motion at a stage.
pub(super) struct NodeStage {
    /// V₀.
    pub(super) twist: Vector6,
    /// t [s].
    pub(super) ahead: f64,
    /// z, ζ, κ.
    pub(super) increment: Vector6,
    pub(super) rate: Vector6,
    pub(super) curvature: Vector6,
}

/// Variations at the start of the step and of the increments: the arguments of the map.
pub(super) struct Given {
    pub(super) place: Six,
    pub(super) twist: Six,
    pub(super) increment: Six,
    pub(super) rate: Six,
    pub(super) curvature: Six,
}

/// Linear map from the given variations to those of a node at a stage.
#[derive(Clone, Debug)]
pub(super) struct NodeMap {
    /// Derivatives of the pose by η₀, ν₀ and z.
    place: [Matrix6; 3],
    /// Derivatives of the twist by ν₀, z and ζ, and of the acceleration by ν₀, z, ζ and κ, for increments relative to the drift.
    departure: Option<Box<([Matrix6; 3], [Matrix6; 4])>>,
}

impl NodeMap {
    pub(super) fn new(parametrization: Parametrization, stage: &NodeStage) -> Self {
        let NodeStage { twist, ahead, increment, rate, curvature } = stage;
        let straight = twist * *ahead;
        if parametrization == Parametrization::FromStart {
            let psi = straight + increment;
            let by_increment = tangent(&psi);
            return Self { place: [carry(&psi), by_increment * *ahead, by_increment], departure: None };
        }
        let back = carry(increment);
        let operator = ScrewTangent::new(increment);
        let by_increment = operator.matrix();
        let carried = back * twist;
        let bracket = lie_bracket_matrix(&carried);
        let gained = operator.times(rate);
        let by_gain = lie_bracket_matrix(&gained);
        // Derivatives of U by ν₀ and z, of W by z and ζ.
        let (seen, turned) = (back, bracket * by_increment);
        let (bent, grown) = (operator.derivative(rate), by_increment);
        let rates = [seen, turned + bent, grown];
        // Derivative of T κ + Ṫ ζ, where Ṫ ζ = (∂(T b)/∂z) ζ at b = ζ.
        let by_place = tangent_derivative_rate(increment, (rate, curvature), rate);
        let by_rate = bent + tangent_rate(increment, rate);
        let accelerations = [
            -by_gain * seen,
            by_place + bracket * bent - by_gain * turned,
            by_rate + bracket * grown,
            by_increment,
        ];
        let places = [back * carry(&straight), back * tangent(&straight) * *ahead, by_increment];
        Self { place: places, departure: Some(Box::new((rates, accelerations))) }
    }

    /// Variations of pose, twist and acceleration at the stage.
    #[inline(always)]
    pub(super) fn apply(&self, given: &Given) -> [Six; 3] {
        let mut place = [NOTHING; 6];
        for (matrix, six) in self.place.iter().zip([&given.place, &given.twist, &given.increment]) {
            add_product(matrix, six, &mut place);
        }
        let Some(departure) = &self.departure else {
            let mut rate = given.twist;
            for (sum, value) in rate.iter_mut().flatten().zip(given.rate.iter().flatten()) {
                *sum += value;
            }
            return [place, rate, given.curvature];
        };
        let (rates, accelerations) = &**departure;
        let (mut rate, mut acceleration) = ([NOTHING; 6], [NOTHING; 6]);
        let parts = [&given.twist, &given.increment, &given.rate, &given.curvature];
        for (matrix, six) in rates.iter().zip(parts) {
            add_product(matrix, six, &mut rate);
        }
        for (matrix, six) in accelerations.iter().zip(parts) {
            add_product(matrix, six, &mut acceleration);
        }
        [place, rate, acceleration]
    }
}

/// Ad(exp(-ψ)).
fn carry(psi: &Vector6) -> Matrix6 {
    Motion::exponential(psi).inverse().adjoint()
}

#[inline(always)]
fn add_product(matrix: &Matrix6, six: &Six, out: &mut Six) {
    for (k, value) in six.iter().enumerate() {
        for (i, sum) in out.iter_mut().enumerate() {
            let entry = matrix[(i, k)];
            for lane in 0..WIDTH {
                sum[lane] += entry * value[lane];
            }
        }
    }
}
