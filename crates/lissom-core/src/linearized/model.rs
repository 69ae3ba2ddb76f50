//! Mass, damping, stiffness and constraints of a system at a state, as sparse values on the tangent's pattern.

use std::sync::Arc;

use lissom_motion::{Matrix6, Vector3, Vector6, lie_bracket_matrix};
use lissom_solver::{FactorError, Pattern, Scalar, SolverKind, Structure};

use super::generator::Generator;
use super::shifted::{GeneralShift, RealShift, small_square};
use super::velocity_constraints::{move_to_rates, refuse};
use super::{SLOW_RATE, rolling_axes};
use crate::consistent::initial_conditions::ConsistentInitialConditions;
use crate::consistent::redundancy::Redundancy;
use crate::diagnostics::diagnostics;
use crate::errors::InitialError;
use crate::errors::StepError;
use crate::interrupt::{self, Interrupted};
use crate::iterate::hold_unbalanced_forces;
use crate::joints::evaluation_point::{Augmentation, Chart, Increments, Point};
use crate::kinematics::{CoordinateId, Kinematics, LOCKED, MotionChange, NodeId, Quantity, Subject};
use crate::round_off;
use crate::saddle_point::potential::{self, has_potential};
use crate::scaling::{Representative, Scaled};
use crate::schemes::Weights;
use crate::system::{Linearization, State, System};

/// Transposed entries are different if they differ by more than this fraction of the larger one, and by more than round-off of their
/// rows.
const ASYMMETRY: f64 = 1e-9;

/// Squared rates below this fraction of the small one that represents zero are zero.
pub(super) const NEUTRAL: f64 = 1e-6;

diagnostics! {
    /// A linear model that does not exist.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    Failure LinearError {
        /// Signals are sampled.
        Sampled {} => "linear-sampled-signals" {
            cause: ("there is no linear model of a system with sampled signals, which change at instants only"),
            remedy: "remove their `sample` for this analysis, as if they were sampled continuously",
            meaning: "Sampled signals change at instants only and have no linear model.",
        }
        /// Signals are delayed.
        Delayed {
            /// The first of them.
            signal: Subject,
        } => "linear-delayed-signals" {
            subject: signal,
            cause: ("the {signal} is delayed, and a system with delays has infinitely many eigenvalues, which the linear model of this \
                    analysis does not have"),
            remedy: "remove its `delay` for this analysis, approximate it by states, such as `x' = (u - x)/delay`, or simulate the motion",
            meaning: "A system with delayed signals has no linear model with finitely many eigenvalues.",
        }
        /// Constraints between velocities.
        Rolls {
            /// Name of the joint.
            joint: String,
        } => "linear-rolling" {
            subject: Subject::new("joint", joint),
            cause: ("`{joint}` rolls, which is a constraint between velocities, and this analysis supports constraints between positions \
                    only"),
            remedy: "use another joint for the wheel, or simulate the motion",
            meaning: "The analysis does not support rolling, which is a constraint between velocities.",
        }
        /// A latch, which is a constraint between velocities.
        Latched {
            /// Name of its coordinate.
            coordinate: String,
        } => "linear-latch" {
            subject: Subject::new("coordinate", coordinate),
            cause: ("a latch (`{coordinate}`) is a constraint between velocities, and this analysis supports constraints between positions \
                    only"),
            remedy: "remove the latch, or lock its joint by a stiff spring",
            meaning: "The analysis does not support latches, which are constraints between velocities.",
        }
        /// A rigid contact.
        RigidContact {
            /// Name of the contact.
            contact: String,
        } => "linear-rigid-contact" {
            subject: Subject::new("contact", contact),
            cause: ("the contact `{contact}` is rigid: it opens and closes, and has no linear model"),
            remedy: "give the contact a `stiffness` instead of `rigid`",
            meaning: "The analysis does not support rigid contacts, which open and close.",
        }
        /// A pivot vanished or a number is not finite.
        Factor {
            /// Time of the state [s].
            time: f64,
            /// Name of the unknown.
            unknown: Subject,
            /// The pivot, relative to its terms; not a number if it is not finite.
            pivot: f64,
        } => "linear-zero-pivot" {
            time: *time,
            subject: unknown,
            cause: ("the linear model at t = {time} s: elimination stops at the {unknown} (pivot {pivot:.1e})"),
            remedy: "add mass, stiffness or a joint",
            meaning: "A coordinate of the linear model has neither mass nor stiffness, or a number is not finite.",
        }
    }
    wraps {
        /// Accelerations and multipliers of a moving state do not exist.
        Accelerations {
            /// Time of the state [s].
            time: f64,
            /// The cause.
            error: InitialError,
        }, { time, error } => {
            error.diagnostic().within(&format!("the linear model at t = {} s", crate::number::Written(*time))).at(*time)
        },
        /// It was interrupted.
        Interrupted(Interrupted), (_) => StepError::Interrupted { time: f64::NAN }.diagnostic(),
    }
}

impl From<Interrupted> for LinearError {
    fn from(interrupted: Interrupted) -> Self {
        Self::Interrupted(interrupted)
    }
}

/// Coefficients of the linearised equations, each on the values of the tangent's pattern.
pub struct LinearModel<'a> {
    pub(super) system: &'a System,
    pub(super) at: Kinematics,
    pub(super) parts: Linearization,
    pub(super) representative: Representative,
    /// Whether there is no damping and no gyroscopic term, and the stiffness is symmetric.
    pub(super) is_conservative: bool,
    is_at_rest: bool,
    imbalance: f64,
    released: f64,
    unsteadiness: f64,
    multipliers: Vec<f64>,
    /// Number of redundant equations, which are omitted.
    pub(super) redundant: usize,
    /// Solver for accelerations.
    pub(super) solver: &'a SolverKind,
    /// The transformation to axes at rest, and the structure of the matrices there; none in the axes of the nodes.
    at_rest: Option<(Generator, Structure)>,
}

impl<'a> LinearModel<'a> {
    /// Linearises `system` at `state`. Accelerations and multipliers are recomputed: those that balance the state, at
    /// rest if all its velocities are zero.
    ///
    /// # Errors
    /// If they cannot be computed.
    pub fn of(system: &'a System, state: &State, solver: &'a SolverKind) -> Result<Self, LinearError> {
        interrupt::check()?;
        if system.signals().has_samples() {
            return Err(LinearError::Sampled {});
        }
        if let Some(signal) = system.signals().delayed() {
            return Err(LinearError::Delayed { signal });
        }
        if let Some(contact) = system.rigid_contacts().next() {
            return Err(LinearError::RigidContact { contact: contact.name.clone() });
        }
        let mut state = state.clone();
        let is_at_rest = is_at_rest(&state.kinematics);
        let zeros = vec![0.0; system.layout().multiplier_rows().len()];
        let mut unloaded = system.linearization_at(&state.kinematics);
        let representative = Representative::of(system, &state.kinematics, &unloaded);
        let redundancy = Redundancy::new(system, &state.kinematics, representative.length);
        redundancy.omit_from(system, &mut unloaded.constraint);
        let time = state.kinematics.time;
        let ([mut imbalance, mut released], mut unsteadiness) = ([0.0; 2], 0.0);
        if is_at_rest {
            for node in &mut state.kinematics.nodes {
                node.acceleration.fill(0.0);
            }
            for coordinate in &mut state.kinematics.coordinates {
                coordinate.acceleration = 0.0;
            }
            [imbalance, released] = hold(system, &mut state, &unloaded, &representative, &zeros)?;
            redundancy.reduce_to_least_norm(&mut state.multipliers);
        } else {
            let mut initial = ConsistentInitialConditions::new(system, &state, &representative, solver);
            initial
                .accelerations(system, &mut state)
                .map_err(|error| LinearError::Accelerations { time, error })?;
            unsteadiness = unsteadiness_of(system, &state.kinematics, representative.length);
        }
        let mut parts = unloaded;
        let (still, unchanged) = nothing(&state.kinematics);
        let point = point(&state.kinematics, (&still, &unchanged), &state.multipliers, &zeros);
        let chart =
            if is_at_rest { Chart::Body } else { Chart::RelativeToDrift(&state.kinematics.nodes, &[]) };
        system.linearize(&point, chart, &mut parts);
        parts.fold_multipliers();
        redundancy.omit_from(system, &mut parts.constraint);
        if is_at_rest && system.has_loads_of_motion() && !system.has_signal_feedback() {
            symmetrise(system, &representative, &mut parts);
        }
        if !is_at_rest {
            move_to_rates(system, &mut parts);
            if unsteadiness > round_off::STEADY_MOTION {
                let displaced = displacement_by_inertia(system, &state.kinematics, (&parts, &representative));
                unsteadiness =
                    displaced.filter(|&size| size <= round_off::STEADY_MOTION).unwrap_or(unsteadiness);
            }
            add_accelerated_mass(system, &state.kinematics, &mut parts);
        }
        let is_conservative =
            parts.damping.iter().all(|&value| value == 0.0) && is_symmetric(system, &representative, &parts);
        Ok(Self {
            system,
            at: state.kinematics,
            parts,
            representative,
            is_conservative,
            is_at_rest,
            imbalance,
            released,
            unsteadiness,
            multipliers: state.multipliers,
            redundant: redundancy.omitted().len(),
            solver,
            at_rest: None,
        })
    }

    /// Rejects a moving system with constraints of velocities, for analyses that consider positions only.
    ///
    /// # Errors
    /// If there are such constraints.
    pub fn check_positions_alone(&self) -> Result<(), LinearError> {
        if self.is_at_rest { Ok(()) } else { refuse(self.system) }
    }

    /// This model with matrices in axes at rest.
    pub(super) fn with_generator(
        &self,
        parts: Linearization,
        structure: Structure,
        generator: Generator,
    ) -> Self {
        Self {
            system: self.system,
            at: self.at.clone(),
            parts,
            representative: self.representative,
            is_conservative: false,
            is_at_rest: self.is_at_rest,
            imbalance: self.imbalance,
            released: self.released,
            unsteadiness: self.unsteadiness,
            multipliers: self.multipliers.clone(),
            redundant: self.redundant,
            solver: self.solver,
            at_rest: Some((generator, structure)),
        }
    }

    /// The transformation to axes at rest, if the matrices refer to these.
    pub(super) fn generator(&self) -> Option<&Generator> {
        self.at_rest.as_ref().map(|(generator, _)| generator)
    }

    /// Pattern and groups of its matrices.
    pub(super) fn structure(&self) -> &Structure {
        self.at_rest.as_ref().map_or(self.system.structure(), |(_, structure)| structure)
    }

    /// The system.
    pub fn system(&self) -> &System {
        self.system
    }

    /// The state of the linearisation.
    pub fn kinematics(&self) -> &Kinematics {
        &self.at
    }

    /// Multipliers of the state, which cause geometric stiffness of constraints [N, N m].
    pub fn multipliers(&self) -> &[f64] {
        &self.multipliers
    }

    /// Mass, damping, stiffness and constraints on the pattern of the system.
    pub fn parts(&self) -> &Linearization {
        &self.parts
    }

    /// Whether it has neither damping nor gyroscopic terms and a symmetric stiffness: squares of eigenvalues are real.
    pub(crate) fn is_conservative(&self) -> bool {
        self.is_conservative
    }

    /// Number of directions at rest in which the energy decreases under the constraints; none if the stiffness derives
    /// from no energy or cannot be factorised.
    pub(crate) fn unstable_directions(&self) -> Option<usize> {
        if !self.is_at_rest || !is_symmetric(self.system, &self.representative, &self.parts) {
            return None;
        }
        let mut shifted = RealShift::new(self.system, &self.representative);
        // Just below zero, so that unconstrained directions without stiffness are not counted as unstable.
        let shift = -NEUTRAL * shifted.small_square();
        shifted.factor(&self.parts, shift).ok().filter(|_| shifted.is_accurate())
    }

    /// Representative length [m].
    pub fn length(&self) -> f64 {
        self.representative.length
    }

    /// Whether all velocities are zero.
    pub fn is_at_rest(&self) -> bool {
        self.is_at_rest
    }

    /// Deviation of a state at rest from equilibrium: the largest displacement, in units of the model's length, that
    /// the unbalanced forces cause [-]. Zero for a moving state.
    pub fn imbalance(&self) -> f64 {
        self.imbalance
    }

    /// Energy that the unbalanced forces of a state at rest release until equilibrium [J].
    pub(crate) fn released_energy(&self) -> f64 {
        self.released
    }

    /// How fast the twists of a moving state change in body axes, relative to the rate of rotation [-]. It is zero in a steady
    /// motion, whose linear model has constant coefficients.
    pub fn unsteadiness(&self) -> f64 {
        self.unsteadiness
    }

    pub(super) fn pattern(&self) -> Arc<Pattern> {
        Arc::clone(&self.structure().pattern)
    }

    pub(super) fn coordinate_count(&self) -> usize {
        self.system.layout().coordinate_count()
    }

    /// Largest violation of a constraint by a displacement, relative to the possible violation by displacements of its
    /// magnitude.
    pub(super) fn violation<S: Scalar>(&self, shape: &[S]) -> f64 {
        let pattern = self.pattern();
        let count = self.coordinate_count();
        let quantities = self.system.layout().quantities();
        let unit = |row: usize| match quantities[row] {
            Quantity::Length | Quantity::State => 1.0,
            Quantity::Angle => self.representative.length,
        };
        let sizes = shape.iter().enumerate().map(|(row, value)| value.magnitude() * unit(row));
        let largest = sizes.fold(0.0, f64::max);
        let mut sums = vec![(S::zero(), 0.0); pattern.size() - count];
        for (column, &value) in shape.iter().enumerate().take(count) {
            let range = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
            let entries = pattern.row_indices()[range.clone()].iter().zip(&self.parts.constraint[range]);
            for (&row, &entry) in entries.filter(|&(&row, _)| row >= count) {
                let (sum, possible) = &mut sums[row - count];
                *sum += S::from_real(entry) * value;
                *possible += entry.abs() * largest / unit(column);
            }
        }
        let parts = sums.iter().map(|(sum, possible)| sum.magnitude() / possible.max(f64::MIN_POSITIVE));
        parts.fold(0.0, f64::max)
    }

    /// Error of a factorisation, with the name of the unknown.
    pub(super) fn stopped(&self, error: &FactorError) -> LinearError {
        stopped(self.system, self.at.time, error)
    }
}

pub(super) fn stopped(system: &System, time: f64, error: &FactorError) -> LinearError {
    let (unknown, pivot) = match *error {
        FactorError::ZeroPivot { unknown, pivot, largest } => (unknown, pivot / largest),
        FactorError::NotFinite { unknown } => (unknown, f64::NAN),
        FactorError::Interrupted => return LinearError::Interrupted(Interrupted),
    };
    LinearError::Factor { time, unknown: system.layout().subject_of(unknown), pivot }
}

/// Whether all velocities are zero.
pub(super) fn is_at_rest(at: &Kinematics) -> bool {
    at.nodes.iter().all(|node| node.twist == Vector6::zeros())
        && at.coordinates.iter().all(|motion| motion.rate == 0.0)
}

pub(super) fn nothing(at: &Kinematics) -> (Vec<MotionChange>, Vec<f64>) {
    (vec![MotionChange::none(); at.nodes.len()], vec![0.0; at.coordinates.len()])
}

pub(super) fn point<'b>(
    at: &'b Kinematics,
    (nodes, coordinates): (&'b [MotionChange], &'b [f64]),
    multipliers: &'b [f64],
    violations: &'b [f64],
) -> Point<'b> {
    Point {
        at,
        stressed: at.into(),
        increments: Increments { start: at, nodes, coordinates, joints: None },
        multipliers,
        violations,
        augmentation: Augmentation::none(),
    }
}

/// Solves with stiffness and mass at a small shift. With signals and some loads both are unsymmetric, and states have only damping.
enum Holding<'a> {
    Symmetric(RealShift<'a>),
    General(GeneralShift<'a, f64>),
}

impl<'a> Holding<'a> {
    fn new(
        system: &'a System,
        unloaded: &Linearization,
        representative: &Representative,
    ) -> Result<Self, FactorError> {
        let is_symmetric = || is_symmetric(system, representative, unloaded);
        if system.has_signal_feedback() || (system.has_loads_of_motion() && !is_symmetric()) {
            let mut solver = GeneralShift::new(system, representative);
            solver.factor(unloaded, small_square(representative).sqrt())?;
            return Ok(Self::General(solver));
        }
        let mut solver = RealShift::new(system, representative);
        solver.factor(unloaded, -solver.small_square())?;
        Ok(Self::Symmetric(solver))
    }

    /// Solves for displacements, and multipliers in SI.
    fn solve(&mut self, right: &mut [f64], count: usize) {
        let factor = match self {
            Self::Symmetric(solver) => {
                solver.solve(right);
                solver.multiplier_factor()
            }
            Self::General(solver) => {
                solver.solve(right);
                solver.multiplier_factor()
            }
        };
        right[count..].iter_mut().for_each(|value| *value *= factor);
    }
}

/// Computes the multipliers that balance a state at rest, by a solve with stiffness and mass. Returns the remainder as a displacement,
/// and its energy.
fn hold(
    system: &System,
    state: &mut State,
    unloaded: &Linearization,
    representative: &Representative,
    zeros: &[f64],
) -> Result<[f64; 2], LinearError> {
    let time = state.kinematics.time;
    let layout = system.layout();
    let count = layout.coordinate_count();
    let mut solver =
        Holding::new(system, unloaded, representative).map_err(|error| stopped(system, time, &error))?;
    let length = representative.length;
    let mut units: Vec<f64> = layout.quantities()[..count]
        .iter()
        .map(|quantity| match quantity {
            Quantity::Length | Quantity::State => 1.0 / length,
            Quantity::Angle => 1.0,
        })
        .collect();
    for (row, _, magnitude) in layout.states() {
        units[row] = 1.0 / magnitude;
    }
    let (still, unchanged) = nothing(&state.kinematics);
    let mut residual = vec![0.0; layout.size()];
    let mut forces = vec![0.0; count];
    state.multipliers.fill(0.0);
    let (mut imbalance, mut released) = (0.0, 0.0);
    // Refined: multipliers are as accurate as forces.
    for _ in 0..3 {
        state.kinematics.show_multipliers(&state.multipliers);
        let at = point(&state.kinematics, (&still, &unchanged), &state.multipliers, zeros);
        system.residual(&at, &mut residual);
        // Positions are unchanged: violations are not considered here.
        residual[count..].fill(0.0);
        forces.copy_from_slice(&residual[..count]);
        solver.solve(&mut residual, count);
        released = 0.5 * forces.iter().zip(&residual).map(|(force, way)| force * way).sum::<f64>().abs();
        for (multiplier, change) in state.multipliers.iter_mut().zip(&residual[count..]) {
            *multiplier -= change;
        }
        let displacements = residual[..count].iter().zip(&units);
        imbalance = displacements.fold(0.0_f64, |most, (value, unit)| most.max((value * unit).abs()));
    }
    Ok([imbalance, released])
}

/// Whether forces act on a state at rest without multipliers, other than round-off of strains that vanish.
pub(crate) fn has_forces(system: &System, state: &State, representative: &Representative) -> bool {
    let (layout, length) = (system.layout(), representative.length);
    let mut at = state.kinematics.clone();
    at.stop();
    let zeros = vec![0.0; state.multipliers.len()];
    at.show_multipliers(&zeros);
    let (still, unchanged) = nothing(&at);
    let mut forces = vec![0.0; layout.size()];
    system.residual(&point(&at, (&still, &unchanged), &zeros, &zeros), &mut forces);
    let least = (f64::EPSILON * length).powi(2) * representative.stiffness;
    let unit = |row: usize| if layout.quantities()[row] == Quantity::Angle { 1.0 } else { length };
    // What is not a number is a force.
    !(0..layout.coordinate_count()).all(|row| forces[row].abs() * unit(row) <= least)
}

/// Largest change of a twist relative to the squares of the rates: in its node's axes, or in axes that do not spin with a wheel.
fn unsteadiness_of(system: &System, at: &Kinematics, length: f64) -> f64 {
    let size = |twist: &Vector6| {
        let (v, w) = (twist.fixed_rows::<3>(0).norm(), twist.fixed_rows::<3>(3).norm());
        (v / length).max(w)
    };
    let rate = at.nodes.iter().fold(0.0_f64, |most, node| most.max(size(&node.twist)));
    let spins = rolling_axes::spins(system, at);
    let changes = at.nodes.iter().zip(&spins).map(|(node, spin)| {
        let own = lissom_motion::screw(&Vector3::zeros(), spin);
        node.acceleration + lie_bracket_matrix(&own) * (node.twist - own)
    });
    let change = changes.fold(0.0_f64, |most, change| most.max(size(&change)));
    if rate > 0.0 { change / (rate * rate) } else { 0.0 }
}

/// The largest displacement, in angles and fractions of the model's length, due to the forces M V̇. Accelerations of parts much
/// lighter than their supports are only the round-off of forces over their mass, and not significant.
fn displacement_by_inertia(
    system: &System,
    at: &Kinematics,
    (parts, representative): (&Linearization, &Representative),
) -> Option<f64> {
    let layout = system.layout();
    let count = layout.coordinate_count();
    let rate = at.nodes.iter().map(|node| node.twist.fixed_rows::<3>(3).norm()).fold(0.0, f64::max);
    if rate == 0.0 {
        return None;
    }
    let mut accelerations = vec![0.0; layout.size()];
    for (node, motion) in NodeId::enumerate(&at.nodes) {
        for (k, &row) in layout.rows_of_node(node).iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
            accelerations[row as usize] = motion.acceleration[k];
        }
    }
    for (coordinate, motion) in CoordinateId::enumerate(&at.coordinates) {
        accelerations[layout.row_of_coordinate(coordinate)] = motion.acceleration;
    }
    let mut forces = vec![0.0; layout.size()];
    system.pattern().multiply(&parts.mass, &accelerations, &mut forces);
    forces[count..].fill(0.0);
    let mut solver = GeneralShift::<f64>::new(system, representative);
    solver.factor(parts, SLOW_RATE * rate).ok()?;
    solver.solve(&mut forces);
    let sizes = forces[..count].iter().zip(layout.quantities()).map(|(value, quantity)| match quantity {
        Quantity::Length => value.abs() / representative.length,
        Quantity::Angle | Quantity::State => value.abs(),
    });
    Some(sizes.fold(0.0, |most, size| if size.is_finite() { most.max(size) } else { f64::INFINITY }))
}

/// Adds M ad_V̇ to the stiffness.
fn add_accelerated_mass(system: &System, at: &Kinematics, parts: &mut Linearization) {
    let pattern = system.pattern();
    for (node, motion) in NodeId::enumerate(&at.nodes) {
        let rows = system.layout().rows_of_node(node);
        // Nodes without rotations do not contribute.
        if rows.contains(&LOCKED) || motion.acceleration == Vector6::zeros() {
            continue;
        }
        let turning: Matrix6 = lie_bracket_matrix(&motion.acceleration);
        let starts = rows.map(|row| pattern.column_starts()[row as usize]);
        let first = pattern.column(rows[0] as usize);
        for (offset, &row) in first.iter().enumerate() {
            // The columns of a node have one pattern except for drives, which act on no node.
            let mass = starts.map(|start| parts.mass[start + offset]);
            debug_assert!(starts.iter().all(|&start| pattern.row_indices()[start + offset] == row));
            for j in 0..6 {
                parts.stiffness[starts[j] + offset] += (0..6).map(|i| mass[i] * turning[(i, j)]).sum::<f64>();
            }
        }
    }
}

/// Replaces the stiffness at rest by its symmetric part if the rest does no work under the constraints.
fn symmetrise(system: &System, representative: &Representative, parts: &mut Linearization) {
    if is_symmetric(system, representative, parts) {
        return;
    }
    let scaled = Scaled::at_rate(representative, small_square(representative).sqrt());
    let blend = scaled.blend(Weights::AT_REST);
    let (structure, count) = (system.structure(), system.layout().coordinate_count());
    let mut stiffness = parts.stiffness.clone();
    hold_unbalanced_forces(system.layout(), &structure.pattern, &mut stiffness);
    let value = |k: usize| {
        blend.place * stiffness[k] + blend.augmented * parts.gram[k] + blend.constraint * parts.constraint[k]
    };
    let values: Vec<f64> = (0..stiffness.len()).map(value).collect();
    if has_potential(structure, (&values, count), scaled.scale(), &[]) {
        potential::symmetrise(&structure.pattern, &mut stiffness, count);
        parts.stiffness = stiffness;
    }
}

/// Whether stiffness and mass are symmetric except for round-off.
pub(super) fn is_symmetric(system: &System, representative: &Representative, parts: &Linearization) -> bool {
    has_symmetric(system, representative, &parts.stiffness, representative.stiffness)
        && has_symmetric(system, representative, &parts.mass, 0.0)
}

/// Whether values on the tangent's pattern, usually of this size for lengths, are symmetric except for round-off.
pub(super) fn has_symmetric(
    system: &System,
    representative: &Representative,
    values: &[f64],
    usual: f64,
) -> bool {
    let pattern = system.pattern();
    let quantities = system.layout().quantities();
    let unit = |row: usize| match quantities[row] {
        Quantity::Length | Quantity::State => 1.0,
        Quantity::Angle => representative.length,
    };
    let range = |column: usize| pattern.column_starts()[column]..pattern.column_starts()[column + 1];
    let largest: Vec<f64> = (0..pattern.size())
        .map(|column| values[range(column)].iter().fold(0.0, |most: f64, value| most.max(value.abs())))
        .collect();
    pattern.mirrors().all(|(row, column, [below, above])| {
        let (value, mirror) = (values[below], values[above]);
        let difference = (value - mirror).abs();
        difference <= ASYMMETRY * value.abs().max(mirror.abs())
            || difference <= round_off::MATRIX_ENTRY * (largest[row] * largest[column]).sqrt()
            || difference <= f64::EPSILON * usual * unit(row) * unit(column)
    })
}
