//! A relation between coordinates of joints, c(q, t) = 0: gears, cams, equations. The forces on the coordinates are
//! -μ ∂c/∂q; their total work is zero if c does not depend explicitly on time.
//!
//! ```text
//! ċ = ∂c/∂q q̇ + ∂c/∂t,      c̈ = ∂c/∂q q̈ + d²c/dε² (q + ε q̇, t + ε)
//! ```
//!
//! Derivatives are computed by second-order jets along directions: d²c/dε² along u + v, u and v gives the mixed one of u
//! and v.

use std::sync::Arc;

use super::constraint::{Constraint, Port, Visit};
use super::evaluation_point::Increments;
use crate::kinematics::step_stages::{STAGES, StepStages, above_round_off};
use crate::kinematics::{CoordinateId, Kinematics, Quantity};
use crate::law::VisitLaw;
pub use crate::relation::{Coupled, MAX_COUPLED, Relation, RelationPoint};
use crate::round_off;

/// A relation with its location in the system.
#[derive(Debug)]
pub struct Coupling {
    /// Name in the model.
    pub name: String,
    /// Coordinates of the coupling.
    pub coordinates: Vec<CoordinateId>,
    /// The quantity of each of them.
    pub quantities: Vec<Quantity>,
    /// The quantity of its equation.
    pub quantity: Quantity,
    /// Multiplier of the equation among all.
    pub multiplier: usize,
    /// Equation of the coupling.
    pub relation: Arc<dyn Relation>,
    /// Factor of the equation, so that its largest derivative at the start is 1.
    pub scale: f64,
}

impl Coupling {
    /// Number of coordinates.
    pub fn count(&self) -> usize {
        self.coordinates.len()
    }

    fn values(&self, at: &Kinematics) -> Coupled {
        self.each(|coordinate| at.coordinates[coordinate].value)
    }

    /// Rates of its coordinates.
    pub fn rates(&self, at: &Kinematics) -> Coupled {
        self.each(|coordinate| at.coordinates[coordinate].rate)
    }

    /// Values of its coordinates.
    pub fn each(&self, of: impl Fn(CoordinateId) -> f64) -> Coupled {
        let mut out = Coupled::default();
        for (value, &coordinate) in out.iter_mut().zip(&self.coordinates) {
            *value = of(coordinate);
        }
        out
    }

    fn jet(&self, at: &Kinematics, (time, direction): (f64, &Coupled)) -> [f64; 3] {
        let count = self.count();
        let values = self.values(at);
        self.relation
            .jet((at.time, &values[..count]), (time, &direction[..count]))
            .map(|value| self.scale * value)
    }

    /// ∂c/∂q.
    pub fn slopes(&self, at: &Kinematics) -> Coupled {
        self.by_coordinate(|unit| self.jet(at, (0.0, unit))[1])
    }

    /// ∂c/∂t.
    pub fn by_time(&self, at: &Kinematics) -> f64 {
        self.jet(at, (1.0, &Coupled::default()))[1]
    }

    /// ∂²c/∂q² times `direction` and `time` times ∂²c/∂q∂t.
    pub fn second(&self, at: &Kinematics, (time, direction): (f64, &Coupled)) -> Coupled {
        let own = self.jet(at, (time, direction))[2];
        self.by_coordinate(|unit| {
            let mut both = *direction;
            both.iter_mut().zip(unit).for_each(|(value, unit)| *value += unit);
            0.5 * (self.jet(at, (time, &both))[2] - own - self.jet(at, (0.0, unit))[2])
        })
    }

    /// Unit vector by unit vector.
    fn by_coordinate(&self, of: impl Fn(&Coupled) -> f64) -> Coupled {
        let mut out = Coupled::default();
        for (k, value) in out.iter_mut().enumerate().take(self.count()) {
            let mut unit = Coupled::default();
            unit[k] = 1.0;
            *value = of(&unit);
        }
        out
    }

    /// ∂²c/∂q² as columns.
    pub fn hessian(&self, at: &Kinematics) -> [Coupled; MAX_COUPLED] {
        let mut out = [Coupled::default(); MAX_COUPLED];
        for (k, column) in out.iter_mut().enumerate().take(self.count()) {
            let mut unit = Coupled::default();
            unit[k] = 1.0;
            *column = self.second(at, (0.0, &unit));
        }
        out
    }

    /// Forces on its coordinates for the multiplier `mu` [N, N m].
    pub fn forces(&self, at: &Kinematics, mu: f64) -> impl Iterator<Item = f64> {
        self.slopes(at).into_iter().take(self.count()).map(move |by| -mu * by)
    }
}

impl Constraint for Coupling {
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
        self.count()
    }

    fn port(&self, _arrangement: usize, index: usize) -> Port {
        Port::Coordinate(self.coordinates[index])
    }

    fn laws(&self, at: &Kinematics, visit: &mut VisitLaw<'_>) {
        let (values, count) = (self.values(at), self.count());
        let here = values.map(|value| [value; 2]);
        if self.relation.bounds([at.time; 2], &here[..count]).is_some() {
            visit(&&*self.relation, &values[..count]);
        }
    }

    fn violation(&self, at: &Kinematics, out: &mut [f64]) {
        out[0] = self.jet(at, (0.0, &Coupled::default()))[0];
    }

    fn violation_change(&self, increments: &Increments<'_>, (time, elapsed): (f64, f64), out: &mut [f64]) {
        let count = self.count();
        let values = self.values(increments.start);
        let changes = self.each(|coordinate| increments.coordinates[coordinate.index()]);
        out[0] =
            self.scale * self.relation.change((time - elapsed, &values[..count]), elapsed, &changes[..count]);
    }

    fn gradient(&self, at: &Kinematics, out: &mut [f64]) {
        out.copy_from_slice(&self.slopes(at)[..self.count()]);
    }

    fn constraint_hessian(&self, at: &Kinematics, multipliers: &[f64], out: &mut [f64]) {
        let count = self.count();
        for (j, column) in self.hessian(at).iter().enumerate().take(count) {
            for (i, value) in column.iter().enumerate().take(count) {
                out[i * count + j] = multipliers[0] * value;
            }
        }
    }

    fn time_derivative(&self, at: &Kinematics, out: &mut [f64]) {
        out[0] = self.by_time(at);
    }

    fn acceleration(&self, at: &Kinematics, out: &mut [f64]) {
        out[0] = self.jet(at, (1.0, &self.rates(at)))[2];
    }

    fn may_depend_on_time(&self) -> bool {
        self.relation.depends_on_time()
    }

    fn depends_on_time(&self, at: &Kinematics) -> bool {
        self.by_time(at) != 0.0
    }

    fn work(&self, from: (&Kinematics, &[f64]), to: (&Kinematics, &[f64])) -> f64 {
        0.5 * (to.0.time - from.0.time) * (self.power(from.0, from.1) + self.power(to.0, to.1))
    }

    /// μ ∂c/∂t.
    fn power(&self, at: &Kinematics, multipliers: &[f64]) -> f64 {
        multipliers[self.multiplier] * self.by_time(at)
    }

    /// As for joints: forces do no work except that of ∂c/∂t.
    fn visit(&self, step: &StepStages<'_>, end: &Increments<'_>, before: &[f64], out: &mut Visit<'_>) {
        let mut rows = step.stages.map(|at| self.slopes(at));
        let mut rates = [0.0; STAGES];
        let mut weights = [Coupled::default(); STAGES];
        let mut squares = [0.0; STAGES];
        let mut way = 0.0_f64;
        for (j, at) in step.stages.iter().enumerate() {
            let speeds = self.rates(at);
            rates[j] = self.by_time(at);
            let mut terms = rates[j].abs();
            for (k, quantity) in self.quantities.iter().enumerate() {
                let unit = match quantity {
                    Quantity::Length | Quantity::State => 1.0,
                    Quantity::Angle => step.length,
                };
                rates[j] += rows[j][k] * speeds[k];
                terms += (rows[j][k] * speeds[k]).abs();
                weights[j][k] = unit * unit * speeds[k];
                squares[j] += weights[j][k] * speeds[k];
            }
            way = way.max(step.lasting[j].abs() * terms);
        }
        self.violation_change(end, (step.end.time, step.end.elapsed), out.changes);
        let missed = out.changes[0] - step.whole(rates);
        let (inverse, mut shares) = step.shares(squares);
        let whole: f64 = step.lasting.iter().sum();
        if inverse == 0.0 {
            shares = [1.0 / whole; STAGES];
        }
        // A value below round-off is included in the violations but would be noise in the forces.
        let known = missed * above_round_off(missed.abs(), round_off::OPERATIONS * way);
        let violations =
            step.at_stages(0.0, [0, 1].map(|j| rates[j] + shares[j] * missed + before[0] / whole));
        for j in 0..STAGES {
            for k in 0..self.count() {
                rows[j][k] += inverse * known * weights[j][k];
            }
            out.rows[j].copy_from_slice(&rows[j][..self.count()]);
            out.violations[j][0] = violations[j];
        }
    }
}

#[cfg(test)]
#[path = "../../tests/unit/joints/coupling.rs"]
mod tests;
