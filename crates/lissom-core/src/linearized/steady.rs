//! Steady rotation: the positions at which a model continues to rotate without any change in the axes of its nodes.
//!
//! The initial velocity field of each node is fixed in space, or to the node that carries its axis; the solution is positions at which the equations of motion are
//! satisfied with constant body twists. Newton's method with the linear model about the state, in increments relative to extrapolation:
//!
//! ```text
//! (s² M + s D + K) δ + Bᵀ δμ = -r(V̇ = 0),    B δ = -c,    δV = ad_V (δ - δ of the carrier in the axes of the node)
//! ```
//!
//! with a small s, so that free rotations do not contribute to the corrections.

use lissom_motion::{Motion, Vector3, Vector6, rotation_part};
use lissom_solver::SolverKind;
use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use super::carried_fields::CarriedFields;
use super::krylov::{Noise, product};
use super::mode::Mode;
use super::model::{LinearError, LinearModel, stopped};
use super::shifted::ComplexShift;
use super::velocity_constraints::refuse;
use super::{SLOW_RATE, averaged};
use crate::consistent::initial_conditions::ConsistentInitialConditions;
use crate::diagnostics::diagnostics;
use crate::kinematics::{CoordinateId, LOCKED, NodeId, NodeMotion, Quantity};
use crate::round_off;
use crate::scaling::Representative;
use crate::system::{State, System};
use crate::tuning::MAX_ITERATIONS;

/// Rotation of a state for the check of constant coefficients [rad].
const TURN: f64 = 0.7;
/// The shift of this check, relative to the eigenvalue.
pub(super) const RELATIVE_SHIFT: f64 = 0.9;
/// Largest correction at once, in angles and fractions of the model's length: forces of constraints from a longer one are so wrong
/// that their geometric stiffness makes the next tangent singular.
const MAX_CORRECTION: f64 = 0.05;
/// Number of samples of the effect of round-off on a mode.
const SAMPLES: usize = 3;

/// Deviation of a mode from one of another model, over its magnitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeDeviation {
    /// The deviation.
    pub size: f64,
    /// The deviation due to round-off in the terms of the mode's own equations.
    pub round_off: f64,
}

diagnostics! {
    /// Why there is no steady rotation.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    Failure SteadyError {
        /// Nothing rotates.
        AtRest {} => "nothing-rotates" {
            cause: ("nothing rotates at the start"),
            remedy: "specify the angular velocity of parts, or use the static equilibrium",
            meaning: "A steady rotation was requested, but all parts are at rest at the start.",
        }
        /// No positions were found.
        NotConverged {
            /// Size of the last correction over the length of the model.
            correction: f64,
            /// Power of all forces in the given rotation, at the positions of the file \[W\].
            power: f64,
        } => "steady-rotation-not-found" {
            cause: ("no steady rotation was found from the positions of the file: the last correction was {correction:.1e} of the model's \
                    length, and there loads do {power:.1e} W in the rotation, which must be zero"),
            remedy: "prescribe the rotation of its joint by a drive of kind `prescribed_rotation`, or give the torque or the pitch that balances \
                the loads at this speed; else check the velocities at the start, which must be those of a steady rotation",
            meaning: "No positions were found at which the model rotates steadily: without a drive the loads must balance at this speed.",
        }
    }
    wraps {
        /// Velocities or the linear model do not exist.
        Linear(LinearError), (error) => error.diagnostic(),
    }
}

impl From<LinearError> for SteadyError {
    fn from(error: LinearError) -> Self {
        Self::Linear(error)
    }
}

/// The state of steady rotation with the velocities of `state`, which may be corrected for the constraints.
///
/// # Errors
/// If nothing rotates, or there are no such positions.
pub fn steady(system: &System, state: &State, solver: &SolverKind) -> Result<State, SteadyError> {
    steady_over(system, state, solver, &[0.0])
}

/// The mean state of a rotation whose loads change with the azimuth, such as gravity across the axis: the mean of the residual over a turn
/// vanishes.
///
/// # Errors
/// If nothing rotates, or there are no such positions.
pub fn steady_on_average(system: &System, state: &State, solver: &SolverKind) -> Result<State, SteadyError> {
    steady_over(system, state, solver, &averaged::azimuths())
}

fn steady_over(
    system: &System,
    state: &State,
    solver: &SolverKind,
    azimuths: &[f64],
) -> Result<State, SteadyError> {
    let given = state;
    let mut state = state.clone();
    let layout = system.layout();
    refuse(system)?;
    let count = layout.coordinate_count();
    let time = state.kinematics.time;
    let unloaded = system.linearization_at(&state.kinematics);
    let representative = Representative::of(system, &state.kinematics, &unloaded);
    let mut initial = ConsistentInitialConditions::new(system, &state, &representative, solver);
    initial.velocities(system, &mut state).map_err(|error| LinearError::Accelerations { time, error })?;
    if rate_of(&state) == 0.0 {
        return Err(SteadyError::AtRest {});
    }
    // Parts without given velocities receive those imposed by the drives.
    if rate_of(given) == 0.0
        && let Some(driven) = initial.least_deforming(system, given)
    {
        state = driven;
    }
    let rate = rate_of(&state);
    let fields = CarriedFields::new(system, &state.kinematics);
    for node in &mut state.kinematics.nodes {
        node.acceleration.fill(0.0);
    }
    for coordinate in &mut state.kinematics.coordinates {
        coordinate.acceleration = 0.0;
    }
    let zeros = vec![0.0; layout.multiplier_rows().len()];
    let (mut start, mut violations) = (zeros.clone(), zeros.clone());
    system.violations(&state.kinematics, &mut start);
    state.multipliers.clone_from(&zeros);
    let mut parts = system.empty_linearization();
    let mut shifted = ComplexShift::new(system, &representative);
    let mut residual = vec![0.0; layout.size()];
    let mut power = 0.0;
    let (mut last, mut right) = (f64::INFINITY, vec![Complex64::default(); layout.size()]);
    for _ in 0..MAX_ITERATIONS {
        system.violations(&state.kinematics, &mut violations);
        for (violation, start) in violations.iter_mut().zip(&start) {
            *violation -= start;
        }
        averaged::mean_equations(system, &state, &violations, azimuths, (&mut residual, &mut parts));
        if last.is_infinite() {
            power = power_of(system, &state, &residual);
        }
        shifted
            .factor(&parts, Complex64::from(SLOW_RATE * rate))
            .map_err(|error| stopped(system, time, &error))?;
        for (value, residual) in right.iter_mut().zip(&residual) {
            *value = Complex64::from(-residual);
        }
        shifted.solve(&mut right);
        follow_supports(&mut shifted, fields.columns(system, &state.kinematics, &parts), &mut right);
        let size = size_of(system, &right, representative.length);
        let part = (MAX_CORRECTION / size).min(1.0);
        correct(system, &mut state, (part, &right), &fields);
        for (multiplier, change) in state.multipliers.iter_mut().zip(&right[count..]) {
            *multiplier += part * shifted.multiplier_factor() * change.re;
        }
        if size <= round_off::CORRECTION || (size <= round_off::STEADY_MOTION && size >= last) {
            return Ok(state);
        }
        if !size.is_finite() {
            return Err(SteadyError::NotConverged { correction: size, power });
        }
        last = size;
    }
    if last <= round_off::STEADY_MOTION {
        Ok(state)
    } else {
        Err(SteadyError::NotConverged { correction: last, power })
    }
}

/// Adds `columns`, each with the row of its factor, to the factored matrix, of which `solution` is a solution (Sherman, Morrison and Woodbury).
fn follow_supports(
    shifted: &mut ComplexShift<'_>,
    mut columns: Vec<(usize, Vec<Complex64>)>,
    solution: &mut [Complex64],
) {
    if columns.is_empty() {
        return;
    }
    for (_, column) in &mut columns {
        shifted.solve(column);
    }
    let entry = |i: usize, j: usize| columns[j].1[columns[i].0] + f64::from(u8::from(i == j));
    let matrix = DMatrix::from_fn(columns.len(), columns.len(), entry);
    let factors = DVector::from_iterator(columns.len(), columns.iter().map(|(row, _)| solution[*row]));
    let Some(factors) = matrix.lu().solve(&factors) else { return };
    for ((_, column), factor) in columns.iter().zip(&factors) {
        for (value, entry) in solution.iter_mut().zip(column) {
            *value -= factor * entry;
        }
    }
}

/// Largest angular velocity of a node [rad/s].
fn rate_of(state: &State) -> f64 {
    state.kinematics.nodes.iter().map(|node| rotation_part(&node.twist).norm()).fold(0.0, f64::max)
}

/// Magnitude of a correction in angles and fractions of `length`; infinite if an entry is not finite.
fn size_of(system: &System, change: &[Complex64], length: f64) -> f64 {
    let unit = |quantity: Quantity| match quantity {
        Quantity::Length => 1.0 / length,
        Quantity::Angle | Quantity::State => 1.0,
    };
    let layout = system.layout();
    let sizes = change.iter().zip(&layout.quantities()[..layout.coordinate_count()]);
    let sizes = sizes.map(|(value, &quantity)| value.re.abs() * unit(quantity));
    sizes.fold(0.0, |most, size| if size.is_finite() { most.max(size) } else { f64::INFINITY })
}

/// Power of all forces but those of constraints in the motion of `state` [W]: `residual` is what they lack.
fn power_of(system: &System, state: &State, residual: &[f64]) -> f64 {
    let layout = system.layout();
    let nodes = NodeId::enumerate(state.kinematics.nodes.iter()).map(|(node, motion)| {
        let rows = layout.rows_of_node(node).iter().zip(&motion.twist);
        rows.map(|(&row, velocity)| if row == LOCKED { 0.0 } else { residual[row as usize] * velocity }).sum()
    });
    let coordinates = CoordinateId::enumerate(state.kinematics.coordinates.iter())
        .map(|(own, motion)| residual[layout.row_of_coordinate(own)] * motion.rate);
    -nodes.chain(coordinates).sum::<f64>()
}

/// Moves the state by a part of a correction.
fn correct(system: &System, state: &mut State, (part, change): (f64, &[Complex64]), fields: &CarriedFields) {
    let layout = system.layout();
    for (node, motion) in NodeId::enumerate(state.kinematics.nodes.iter_mut()) {
        let rows = layout.rows_of_node(node);
        let by = |row: u32| if row == LOCKED { 0.0 } else { part * change[row as usize].re };
        let psi = Vector6::from_fn(|k, _| by(rows[k]));
        motion.frame = motion.frame * Motion::exponential(&psi);
    }
    fields.apply(&mut state.kinematics);
    for (coordinate, motion) in CoordinateId::enumerate(&mut state.kinematics.coordinates) {
        motion.value += part * change[layout.row_of_coordinate(coordinate)].re;
    }
}

impl<'a> LinearModel<'a> {
    /// Largest angular velocity of a node, as a vector [rad/s], in global axes.
    pub fn spin(&self) -> Vector3 {
        let spins = self.at.nodes.iter().map(NodeMotion::angular_velocity);
        spins.fold(Vector3::zeros(), |most, spin| if spin.norm() > most.norm() { spin } else { most })
    }

    /// The model a fraction of a turn later, if it moves steadily: each node is moved by its own twist.
    ///
    /// # Errors
    /// If there is no linear model there.
    pub fn turned(&self) -> Result<LinearModel<'a>, LinearError> {
        self.rotated_by(TURN)
    }

    /// Deviation of a mode of this model from a solution of `other`, the model after a fraction of a turn. It is 0 if the
    /// coefficients are constant.
    ///
    /// # Errors
    /// If the matrices cannot be factorised.
    pub fn deviation_of(&self, mode: &Mode, other: &LinearModel<'_>) -> Result<ModeDeviation, LinearError> {
        self.deviation_at(mode, other, TURN)
    }

    /// Deviation of a mode from a solution of `other`, the model after a rotation by `angle`.
    pub(super) fn deviation_at(
        &self,
        mode: &Mode,
        other: &LinearModel<'_>,
        angle: f64,
    ) -> Result<ModeDeviation, LinearError> {
        let s = mode.eigenvalue;
        if s.norm() == 0.0 {
            return Ok(ModeDeviation { size: 0.0, round_off: 0.0 });
        }
        let mut shifted = ComplexShift::new(other.system, &other.representative);
        shifted.factor(&other.parts, RELATIVE_SHIFT * s).map_err(|error| other.stopped(&error))?;
        let pattern = other.pattern();
        let mut right = vec![Complex64::default(); pattern.size()];
        // Sums of the magnitudes of the terms of each row.
        let mut terms = vec![0.0; pattern.size()];
        let count = self.coordinate_count();
        let [places, rates, accelerations] = match self.generator() {
            Some(generator) => generator.in_nodes(mode, angle),
            None => [0, 1, 2].map(|power| mode.shape.iter().map(|value| value * s.powi(power)).collect()),
        };
        for column in 0..count {
            for at in pattern.column_starts()[column]..pattern.column_starts()[column + 1] {
                let row = pattern.row_indices()[at];
                let of_places = if row < count { 0.0 } else { other.parts.constraint[at] };
                let parts = [
                    accelerations[column] * other.parts.mass[at],
                    rates[column] * other.parts.damping[at],
                    places[column] * (other.parts.stiffness[at] + of_places),
                ];
                for part in parts {
                    right[row] += part;
                    terms[row] += part.norm();
                }
            }
        }
        let size = |values: &[Complex64]| product(values, values).re.sqrt();
        let whole = size(&mode.shape);
        let mut deviation_by = |mut forces: Vec<Complex64>| {
            shifted.solve(&mut forces);
            size(&forces[..count]) / whole
        };
        let mut noise = Noise(5);
        let mut round_off = 0.0_f64;
        for _ in 0..SAMPLES {
            let forces = terms
                .iter()
                .map(|term| Complex64::new(noise.number(), noise.number()) * (round_off::SUM * term));
            round_off = round_off.max(deviation_by(forces.collect()));
        }
        Ok(ModeDeviation { size: deviation_by(right), round_off })
    }

    /// Modal assurance criterion of two shapes, weighted with the mass of this model: 1 for equal, 0 for orthogonal ones.
    pub fn assurance(&self, one: &Mode, other: &Mode) -> f64 {
        let pattern = self.pattern();
        let weighed = |shape: &[Complex64]| {
            let mut sum = vec![Complex64::default(); pattern.size()];
            for (column, value) in shape.iter().enumerate() {
                for at in pattern.column_starts()[column]..pattern.column_starts()[column + 1] {
                    sum[pattern.row_indices()[at]] += value * self.parts.mass[at];
                }
            }
            sum.truncate(shape.len());
            sum
        };
        let (a, b) = (weighed(&one.shape), weighed(&other.shape));
        let sizes = product(&one.shape, &a).re * product(&other.shape, &b).re;
        let mirrored: Vec<Complex64> = one.shape.iter().map(Complex64::conj).collect();
        let most = product(&one.shape, &b).norm_sqr().max(product(&mirrored, &b).norm_sqr());
        if sizes > 0.0 { most / sizes } else { 0.0 }
    }
}
