//! Jumps of accelerations and multipliers where held values change between two steps, with the matrix of positions near them.
//!
//! A matrix serves until joints have turned: a control loop changes inputs at every step. Its positions follow from the sequence of steps
//! alone and are part of snapshots, so that restarts continue to the last bit.
//!
//! Legend: r left-hand sides of the equations of motion, g̈ accelerations of the violations, ' with the new values, S matrix of the
//! inertias and the constraints.
//!
//! ```text
//! S (Δa, Δλ) = (r(a, λ) - r'(a + Δa, λ + Δλ),  g̈(a) - g̈'(a + Δa)),     repeated
//! ```

use super::corrections::Corrections;
use super::matrix::RecoveryMatrix;
use crate::consistent::initial_conditions::gather_accelerations;
use crate::kinematics::{GROUND, Kinematics, LOCKED, Layout, Quantity};
use crate::simulation::Simulation;
use crate::system::{State, System};

/// Half the sine of the turn of a joint from which other positions are chosen.
const MAX_TURN: f64 = 0.05;

/// Finds jumps.
pub(crate) struct AccelerationJump {
    matrix: RecoveryMatrix,
    corrections: Corrections,
    at: Kinematics,
    /// Residuals with the former values, by row.
    before: Vec<f64>,
    accelerations: Vec<f64>,
    violation_rates: [Vec<f64>; 2],
    jump: Vec<f64>,
}

impl AccelerationJump {
    pub(crate) fn of(simulation: &Simulation) -> Self {
        let (layout, kinematics) = (simulation.system().layout(), &simulation.state().kinematics);
        let by_row = || vec![0.0; layout.size()];
        let by_multiplier = || vec![0.0; layout.multiplier_count];
        let matrix = RecoveryMatrix::of(simulation, false);
        Self {
            corrections: Corrections::new(simulation, &matrix),
            matrix,
            at: kinematics.clone(),
            before: by_row(),
            accelerations: by_row(),
            violation_rates: [by_multiplier(), by_multiplier()],
            jump: by_row(),
        }
    }

    /// The jump by row at a change to `held`, with the change of the rates of first-order states; none if it does not converge. Forces
    /// must not depend on multipliers.
    pub(crate) fn find(
        &mut self,
        system: &System,
        state: &State,
        (held, near): (&[f64], &Kinematics),
    ) -> Option<&mut [f64]> {
        let Self { matrix, corrections, at, before, accelerations, violation_rates, jump } = self;
        let (layout, count) = (system.layout(), system.layout().coordinate_count());
        matrix.prepare((system, &state.kinematics, Some(near)), 0.0, 1)?;
        at.clone_from(&state.kinematics);
        gather_accelerations(layout, at, accelerations);
        let mut residuals =
            |at: &Kinematics, multipliers: &[f64], out: &mut [f64], matrix: &RecoveryMatrix| {
                matrix.residual_with_rates(system, at, multipliers, out);
                let [rates, found] = &mut *violation_rates;
                matrix.violation_rates(system, at, [rates, found]);
                out[count..].copy_from_slice(found);
            };
        residuals(at, &state.multipliers, before, matrix);
        at.held.copy_from_slice(held);
        residuals(at, &state.multipliers, jump, matrix);
        jump.iter_mut().zip(&*before).for_each(|(jump, before)| *jump = before - *jump);
        // Rates of states, which the matrix leaves alone, follow from their equations at once.
        let wanted = |change: &[f64], right: &mut [f64], matrix: &RecoveryMatrix, seen: &mut [f64]| {
            accelerate(layout, (accelerations, change), at);
            let multipliers = state.multipliers.iter().zip(&change[count..]);
            seen.iter_mut().zip(multipliers).for_each(|(sum, (own, change))| *sum = own + change);
            residuals(at, seen, right, matrix);
            right.iter_mut().zip(&*before).for_each(|(right, before)| *right = before - *right);
            matrix.clear_rates(layout, right);
        };
        corrections.solve(matrix, jump, wanted)?;
        matrix.reduce_to_least_norm(&mut jump[count..]);
        Some(jump)
    }
}

impl Simulation {
    /// Chooses the present positions for the matrix of jumps if joints have turned.
    pub(crate) fn follow_turn(&mut self) {
        if self.held_values.is_none() || self.system.sees_multipliers() {
            return;
        }
        let at = &self.state.kinematics;
        match &mut self.near {
            Some(near) if turn(&self.system, [near, at]) <= MAX_TURN => {}
            Some(near) => near.clone_from(at),
            none => *none = Some(at.clone()),
        }
    }
}

/// Largest half sine of the turn of a tip against a base that moves, between two positions: constraints change by it.
fn turn(system: &System, positions: [&Kinematics; 2]) -> f64 {
    let joints = system.joints().iter().map(|joint| joint.frames.map(|frame| frame.node));
    let turns = joints.filter(|[base, _]| *base != GROUND).map(|nodes| {
        let [before, after] = positions.map(|at| {
            let [base, tip] = nodes.map(|node| &at.nodes[node.index()].frame.rotation);
            base.inverse() * *tip
        });
        let [_, vector @ ..] = (before.inverse() * after).quaternion();
        vector.iter().map(|own| own * own).sum::<f64>()
    });
    turns.fold(0.0, f64::max).sqrt()
}

/// Sets accelerations to the given ones and their changes, except those of first-order states.
fn accelerate(layout: &Layout, (own, changes): (&[f64], &[f64]), at: &mut Kinematics) {
    let of = |row: u32| own[row as usize] + changes[row as usize];
    for (coordinate, &row) in at.coordinates.iter_mut().zip(&layout.coordinate_rows) {
        if layout.quantities()[row as usize] != Quantity::State {
            coordinate.acceleration = of(row);
        }
    }
    for (rows, node) in layout.node_rows.iter().zip(&mut at.nodes) {
        for (k, &row) in rows.iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
            node.acceleration[k] = of(row);
        }
    }
}
