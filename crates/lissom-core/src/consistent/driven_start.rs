//! Initial velocities of flexible parts that are set in motion by drives: those that satisfy the constraints with the least deformation
//! rates.
//!
//! ```text
//! [M + w K  Bᵀ; B  0] [Δv; ·] = [-w K v; -(B v + ∂c/∂t)],      v ← v + Δv
//! ```
//!
//! iterated. K is the stiffness of beams and superelements in axes of the nodes, in which rigid motions cause no forces. If the
//! constraints permit rigid motions, the limit is the one with the least kinetic energy.

use super::initial_conditions::{ConsistentInitialConditions, Inertias, gather_rates};
use crate::joints::evaluation_point::Chart;
use crate::kinematics::{Kinematics, Quantity};
use crate::round_off;
use crate::system::{State, System};
use crate::tuning::MAX_ITERATIONS;

/// Largest ratio of w K and M on a diagonal: with larger ones M is lost in round-off, smaller ones require more iterations.
const STIFF: f64 = 1e11;

impl ConsistentInitialConditions {
    /// Velocities that satisfy the constraints with the least deformation rates of flexible parts, starting from the `given` state.
    /// Parts that are connected to a given velocity are excluded. None if the equations cannot be solved.
    pub(crate) fn least_deforming(&mut self, system: &System, given: &State) -> Option<State> {
        let mut state = given.clone();
        self.factor(system, &state, Inertias::OfParts)
            .or_else(|_| self.factor(system, &state, Inertias::All))
            .ok()?;
        let stiffness = self.stiffness_of_driven(system, &state.kinematics);
        let (layout, pattern) = (system.layout(), &system.structure().pattern);
        let count = layout.coordinate_count();
        let lengths = (0..count).filter(|&row| layout.quantities()[row] == Quantity::Length);
        let diagonal = lengths.filter_map(|row| pattern.position(row, row));
        let ratios = diagonal.filter(|&k| self.weights[k] > 0.0).map(|k| stiffness[k] / self.weights[k]);
        let fastest = ratios.fold(0.0, f64::max);
        if fastest == 0.0 {
            return None;
        }
        let weight = STIFF / fastest;
        for (value, stiffness) in self.weights.iter_mut().zip(&stiffness) {
            *value += weight * stiffness;
        }
        self.factor_weights(system).ok()?;
        let mut rates = vec![0.0; layout.size()];
        let mut impulses = vec![0.0; layout.size()];
        let mut largest = 0.0_f64;
        for _ in 0..MAX_ITERATIONS {
            gather_rates(layout, &state.kinematics, &mut rates);
            pattern.multiply(&stiffness, &rates, &mut impulses);
            for impulse in &mut impulses {
                *impulse *= -weight;
            }
            let change = self.project(system, &mut state, &impulses);
            largest = largest.max(change);
            if change <= round_off::ITERATION * largest {
                break;
            }
        }
        largest.is_finite().then_some(state)
    }

    /// Stiffness of beams and superelements that are not connected to a part with a given velocity.
    fn stiffness_of_driven(&self, system: &System, at: &Kinematics) -> Vec<f64> {
        let (layout, pattern) = (system.layout(), &system.structure().pattern);
        let kinds: Vec<bool> =
            system.batches.iter().map(|batch| batch.capabilities().deformation.is_some()).collect();
        let zero = vec![0.0; layout.multiplier_count];
        let mut flexible = system.empty_linearization();
        system.linearize_kinds(&kinds, &self.point(at, &zero), Chart::Body, &mut flexible);
        let mut rates = vec![0.0; layout.size()];
        gather_rates(layout, at, &mut rates);
        let mut reached: Vec<usize> = (0..rates.len()).filter(|&row| rates[row] != 0.0).collect();
        let mut is_given = vec![false; rates.len()];
        while let Some(row) = reached.pop() {
            if !std::mem::replace(&mut is_given[row], true) {
                reached.extend(pattern.column(row));
            }
        }
        for column in (0..rates.len()).filter(|&column| is_given[column]) {
            let range = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
            flexible.stiffness[range].fill(0.0);
        }
        flexible.stiffness
    }
}
