//! A coordinate driven as a function of time, as a constraint of the system: c = φ - f(t).

use super::constraint::{Constraint, Port};
use super::evaluation_point::Increments;
use super::prescribed::Prescribed;
use crate::kinematics::work::along;
use crate::kinematics::{Kinematics, Quantity};

/// A driven coordinate with its location among the multipliers.
#[derive(Debug)]
pub struct Drive {
    /// Name in the model.
    pub name: String,
    /// The prescribed coordinate and its function.
    pub prescribed: Prescribed,
    /// The quantity of its coordinate.
    pub quantity: Quantity,
    /// Multiplier of the drive, its moment or force, among all multipliers.
    pub multiplier: usize,
}

impl Constraint for Drive {
    fn name(&self) -> &str {
        &self.name
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
        Port::Coordinate(self.prescribed.coordinate)
    }

    fn violation(&self, at: &Kinematics, out: &mut [f64]) {
        let value = at.coordinates[self.prescribed.coordinate].value;
        out[0] = self.prescribed.violation(value, at.time);
    }

    fn violation_change(&self, increments: &Increments<'_>, (time, elapsed): (f64, f64), out: &mut [f64]) {
        let change = increments.coordinates[self.prescribed.coordinate.index()];
        out[0] = self.prescribed.violation_change(change, time, elapsed);
    }

    fn gradient(&self, _at: &Kinematics, out: &mut [f64]) {
        out[0] = 1.0;
    }

    fn constraint_hessian(&self, _at: &Kinematics, _multipliers: &[f64], _out: &mut [f64]) {}

    fn time_derivative(&self, at: &Kinematics, out: &mut [f64]) {
        out[0] = -self.prescribed.value.first_derivative(at.time);
    }

    fn acceleration(&self, at: &Kinematics, out: &mut [f64]) {
        out[0] = -self.prescribed.value.second_derivative(at.time);
    }

    fn may_depend_on_time(&self) -> bool {
        true
    }

    fn depends_on_time(&self, _at: &Kinematics) -> bool {
        true
    }

    fn work(&self, from: (&Kinematics, &[f64]), to: (&Kinematics, &[f64])) -> f64 {
        let [start, end] = [from.0, to.0].map(|at| at.coordinates[self.prescribed.coordinate]);
        let forces = [from.1, to.1].map(|multipliers| -multipliers[self.multiplier]);
        along(forces, end.value - start.value, [start.rate, end.rate], to.0.time - from.0.time)
    }

    fn power(&self, at: &Kinematics, multipliers: &[f64]) -> f64 {
        -multipliers[self.multiplier] * at.coordinates[self.prescribed.coordinate].rate
    }

    fn breakpoints(&self) -> Vec<f64> {
        self.prescribed.value.breakpoints()
    }
}
