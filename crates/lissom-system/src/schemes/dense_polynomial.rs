//! The motion within a step of a collocation scheme.
//!
//! Legend: c_i abscissae, D_i increments of the stages, w_j polynomial of degree S that is 1 at c_j and 0 at the others and at
//! the start (c_0 = 0), A⁻¹ matrix of the velocities, λ multipliers.
//!
//! ```text
//! q'(x) = q'_0 + Σ_j w_j(x) (A⁻¹ D)_j,      D(x) = ∫_0^x (q' - q'_0),      q''(x) = Σ_j w_j(x) q''_j,   λ(x) = Σ_j w_j(x) λ_j,   j = 0 … S
//! ```
//!
//! Position and velocity are those of the step at both ends, since the quadrature of the scheme is exact for polynomials of degree
//! 2 S - 2. Between them positions of unconstrained motions have an error of order S + 2 in the step size. Equations of motion are
//! satisfied at the stages and at the start.
//!
//! In constrained directions the velocity at the start has the error of the *previous* step, which a shorter step does not reduce: with
//! it positions would err in proportion to h. There positions use the velocity that the stages imply, q'_0 + Σ_j w_j'(0) D_j, and have an
//! error of order S + 1.

use super::scheme::{Combination, MAX_STAGES, Stage};

/// The motion within a step.
#[derive(Clone, Debug, PartialEq)]
pub struct DensePolynomial {
    /// w_j by powers of the step fraction, the start first.
    basis: Vec<Vec<f64>>,
}

/// Motion at a step fraction, as linear combinations of the increments and the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DenseWeights {
    /// The increment.
    pub place: Combination,
    /// q' minus that at the start.
    pub velocity: Combination,
    /// q''.
    pub acceleration: Combination,
    /// Weights of the multipliers at the start and at the stages.
    pub multipliers: [f64; MAX_STAGES + 1],
}

impl DensePolynomial {
    /// Through the start and stages at these abscissae.
    pub fn new(abscissae: &[f64]) -> Self {
        let knots: Vec<f64> = std::iter::once(0.0).chain(abscissae.iter().copied()).collect();
        let basis = |own: usize| {
            let mut powers = vec![1.0];
            for other in (0..knots.len()).filter(|&other| other != own) {
                let distance = knots[own] - knots[other];
                let shifted = powers.iter().map(|power| -knots[other] * power / distance);
                let mut product: Vec<f64> = shifted.chain([0.0]).collect();
                product[1..].iter_mut().zip(&powers).for_each(|(value, power)| *value += power / distance);
                powers = product;
            }
            powers
        };
        Self { basis: (0..knots.len()).map(basis).collect() }
    }

    /// Derivatives of w_1 … w_S at the start.
    pub fn slopes_at_start(&self) -> impl Iterator<Item = f64> {
        self.basis[1..].iter().map(|powers| powers[1])
    }

    /// The motion at a step fraction, of the scheme with these stages.
    pub fn at(&self, x: f64, stages: &[Stage]) -> DenseWeights {
        let mut weights = DenseWeights::default();
        for (knot, powers) in self.basis.iter().enumerate() {
            let value = powers.iter().rev().fold(0.0, |sum, power| sum * x + power);
            weights.multipliers[knot] = value;
            let terms = powers.iter().enumerate().rev();
            let integral = terms.fold(0.0, |sum, (degree, power)| (sum + power / (degree + 1) as f64) * x);
            let Some(stage) = knot.checked_sub(1).map(|stage| &stages[stage]) else {
                weights.acceleration.acceleration = value;
                weights.place.velocity = integral;
                continue;
            };
            weights.place = weights.place.plus(&stage.velocity.times(integral));
            weights.velocity = weights.velocity.plus(&stage.velocity.times(value));
            weights.acceleration = weights.acceleration.plus(&stage.acceleration.times(value));
        }
        weights
    }
}
