//! Couplings in the equations of the whole system: forces, violations and derivatives.

use super::receiver::Receiver;
use super::{StepPoint, System};
use crate::joints::coupling::{Coupled, Coupling, MOST_COUPLED};
use crate::joints::evaluation_point::Point;
use crate::joints::step_stages::ROUND_OFF;
use crate::kinematics::step_stages::{STAGES, above_round_off};
use crate::kinematics::{Kinematics, Quantity};

/// A coupling at a stage of a step whose violations are integrated, see `joints::step_stages`.
pub(crate) struct CouplingVisit {
    /// B̃.
    pub(crate) rows: Coupled,
    /// Integrated violation.
    pub(crate) violation: f64,
}

impl System {
    /// All relations between coordinates.
    pub fn couplings(&self) -> &[Coupling] {
        &self.couplings
    }

    /// Row of a coupling's multiplier.
    fn row_of_coupling(&self, coupling: &Coupling) -> usize {
        self.layout.coordinate_count() + coupling.multiplier
    }

    fn add_coupling_forces(&self, coupling: &Coupling, rows: &Coupled, mu: f64, out: &mut [f64]) {
        for (&coordinate, by) in coupling.coordinates.iter().zip(rows) {
            out[self.layout.row_of_coordinate(coordinate)] += by * mu;
        }
    }

    /// Adds forces and violations of all couplings to a residual.
    pub(super) fn add_couplings(&self, point: &Point<'_>, out: &mut [f64]) {
        for coupling in &self.couplings {
            let row = self.row_of_coupling(coupling);
            let violation = violation(coupling, point);
            let weight = point.augmentation.weight * point.augmentation.relative(self.layout.quantities[row]);
            let mu = point.multipliers[coupling.multiplier] + weight * violation;
            out[row] = violation;
            self.add_coupling_forces(coupling, &coupling.gradient(point.at), mu, out);
        }
    }

    /// Violations of all couplings at `point`, by multiplier.
    pub(super) fn coupling_violations(&self, point: &Point<'_>, out: &mut [f64]) {
        for coupling in &self.couplings {
            out[coupling.multiplier] = violation(coupling, point);
        }
    }

    /// Hands the derivatives of all couplings to `out`.
    pub(super) fn linearize_couplings(&self, point: &Point<'_>, out: &mut Receiver<'_>) {
        for coupling in &self.couplings {
            let quantity = self.layout.quantities[self.row_of_coupling(coupling)];
            let weight = point.augmentation.relative(quantity);
            let gradient = coupling.gradient(point.at);
            let hessian = coupling.hessian(point.at);
            let mu = point.multipliers[coupling.multiplier];
            out.add_coupling(coupling, (&gradient, weight), |i, j| mu * hessian[j][i]);
        }
    }

    /// Work of couplings that depend on the time itself, between two configurations with their multipliers [J]: the
    /// power is μ ∂c/∂t.
    pub(super) fn work_of_couplings(
        &self,
        (from, before): (&Kinematics, &[f64]),
        (to, after): (&Kinematics, &[f64]),
    ) -> f64 {
        let elapsed = to.time - from.time;
        let of = |coupling: &Coupling| {
            let rates = [from, to].map(|at| coupling.by_time(at));
            let forces = [before, after].map(|multipliers| multipliers[coupling.multiplier]);
            0.5 * elapsed * (forces[0] * rates[0] + forces[1] * rates[1])
        };
        self.couplings.iter().map(of).sum()
    }

    /// Whether a coupling depends on the time itself at a configuration.
    pub(crate) fn has_timed_coupling(&self, at: &Kinematics) -> bool {
        self.couplings.iter().any(|coupling| coupling.by_time(at) != 0.0)
    }

    /// Adds forces and integrated violations of all couplings to the residuals at the stages of `point`.
    pub(super) fn add_coupling_stages(&self, point: &StepPoint<'_>, out: &mut [Vec<f64>]) {
        for coupling in &self.couplings {
            let row = self.row_of_coupling(coupling);
            let weight = point.augmentation.weight * point.augmentation.relative(self.layout.quantities[row]);
            for (stage, visit) in self.coupling_visits(coupling, point).iter().enumerate() {
                let mu = point.multipliers[stage][coupling.multiplier] + weight * visit.violation;
                out[stage][row] = visit.violation;
                self.add_coupling_forces(coupling, &visit.rows, mu, &mut out[stage]);
            }
        }
    }

    /// Gradients and integrated violations of a coupling at the stages of `point`.
    pub(crate) fn coupling_visits(
        &self,
        coupling: &Coupling,
        point: &StepPoint<'_>,
    ) -> [CouplingVisit; STAGES] {
        let step = &point.step;
        let mut rows = step.stages.map(|at| coupling.gradient(at));
        let mut rates = [0.0; STAGES];
        let mut weights = [Coupled::default(); STAGES];
        let mut squares = [0.0; STAGES];
        let mut way = 0.0_f64;
        for (j, at) in step.stages.iter().enumerate() {
            let speeds = coupling.rates(at);
            rates[j] = coupling.by_time(at);
            let mut terms = rates[j].abs();
            for (k, &coordinate) in coupling.coordinates.iter().enumerate() {
                let unit = match self.layout.coordinate_quantity(coordinate) {
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
        let end = point.increments[STAGES];
        let change =
            coupling.violation_change(step.start, end.coordinates, (step.end.time, step.end.elapsed));
        let missed = change - step.whole(rates);
        let (inverse, mut shares) = step.shares(squares);
        let whole: f64 = step.lasting.iter().sum();
        if inverse == 0.0 {
            shares = [1.0 / whole; STAGES];
        }
        // What is below round-off counts in the violations but would be noise in the forces.
        let known = missed * above_round_off(missed.abs(), ROUND_OFF * way);
        let before = point.violations[coupling.multiplier];
        let violations = step.at_stages(0.0, [0, 1].map(|j| rates[j] + shares[j] * missed + before / whole));
        for j in 0..STAGES {
            for k in 0..coupling.count() {
                rows[j][k] += inverse * known * weights[j][k];
            }
        }
        [0, 1].map(|j| CouplingVisit { rows: rows[j], violation: violations[j] })
    }
}

impl Receiver<'_> {
    /// Adds a coupling's derivatives: the gradient to B and Bᵀ, its squares times a weight to BᵀWB, and the `stiffness`
    /// by row and column.
    fn add_coupling(
        &mut self,
        coupling: &Coupling,
        (gradient, weight): (&Coupled, f64),
        stiffness: impl Fn(usize, usize) -> f64,
    ) {
        let count = coupling.count();
        for (entry, &position) in coupling.positions.iter().enumerate() {
            let (i, j) = (entry % (count + 1), entry / (count + 1));
            let parts = match (i < count, j < count) {
                (true, true) => [stiffness(i, j), weight * gradient[i] * gradient[j], 0.0],
                (true, false) => [0.0, 0.0, gradient[i]],
                (false, true) => [0.0, 0.0, gradient[j]],
                (false, false) => continue,
            };
            self.add_constraint_entry(position, parts);
        }
    }
}

fn violation(coupling: &Coupling, point: &Point<'_>) -> f64 {
    let Point { at, increments, violations, .. } = point;
    let change = coupling.violation_change(increments.start, increments.coordinates, (at.time, at.elapsed));
    debug_assert!(coupling.count() <= MOST_COUPLED);
    violations[coupling.multiplier] + change
}
