//! A latch, a constraint of velocities: keeps a coordinate of a joint at its value while an input is set, and leaves it free otherwise.
//!
//! Legend: q the coordinate, μ the force of the latch.
//!
//! ```text
//! q̇ = 0 where it is engaged,      μ = 0 where it is not
//! ```
//!
//! The impact without rebound at the instant of latching is computed by `Simulation::switch_constraints`.

use super::constraint::{Constraint, Level, Port};
use super::evaluation_point::Increments;
use crate::kinematics::{CoordinateId, DiscreteValueId, Kinematics, Quantity};

/// A latch on a coordinate.
#[derive(Debug)]
pub struct Latch {
    /// Name of its coordinate in the model.
    pub name: String,
    /// The coordinate.
    pub coordinate: CoordinateId,
    /// Quantity of the coordinate.
    pub quantity: Quantity,
    /// The input.
    pub engaged: DiscreteValueId,
    /// Multiplier of the latch, the force on the coordinate on the left-hand side, among all multipliers.
    pub multiplier: usize,
}

/// Whether an input of this value engages a latch.
pub fn holds(input: f64) -> bool {
    input > 0.5
}

impl Constraint for Latch {
    fn name(&self) -> &str {
        &self.name
    }

    fn level(&self) -> Level {
        Level::Velocity
    }

    fn is_released(&self, at: &Kinematics) -> bool {
        !at.held.get(self.engaged.index()).is_some_and(|&input| holds(input))
    }

    fn first_multiplier(&self) -> usize {
        self.multiplier
    }

    fn quantity(&self, _equation: usize) -> Quantity {
        self.quantity
    }

    fn ports(&self) -> usize {
        1
    }

    fn port(&self, _arrangement: usize, _index: usize) -> Port {
        Port::Coordinate(self.coordinate)
    }

    fn violation(&self, _at: &Kinematics, out: &mut [f64]) {
        out[0] = 0.0;
    }

    fn violation_change(&self, _increments: &Increments<'_>, _time_elapsed: (f64, f64), out: &mut [f64]) {
        out[0] = 0.0;
    }

    fn gradient(&self, at: &Kinematics, out: &mut [f64]) {
        if !self.is_released(at) {
            out[0] = 1.0;
        }
    }

    fn constraint_hessian(&self, _at: &Kinematics, _multipliers: &[f64], _out: &mut [f64]) {}

    fn acceleration(&self, _at: &Kinematics, out: &mut [f64]) {
        out[0] = 0.0;
    }
}

#[cfg(test)]
#[path = "../../tests/unit/joints/latch.rs"]
mod tests;
