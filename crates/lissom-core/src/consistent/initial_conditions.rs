//! Consistent initial values: velocities that satisfy the first derivative of the constraints, accelerations and multipliers that
//! satisfy the equations of motion and the second derivative.
//!
//! ```text
//! [M Bᵀ; B 0] [Δv; ·] = [0; -(B v + ∂c/∂t)],      [M Bᵀ; B 0] [v̇; λ] = [-f; -(Ḃ v + ∂²c/∂t²)]
//! ```
//!
//! solved in scaled and augmented form, like a step.

use lissom_motion::{Motion, Vector6};
use lissom_solver::{FactorError, SolverKind};
use nalgebra::{DMatrix, DVector};

use super::open_trees;
use super::redundancy::Redundancy;
use super::rigid::Known;
use crate::errors::InitialError;
use crate::errors::step_error::pivot_hint;
use crate::interrupt::Interrupted;
use crate::joints::evaluation_point::{Augmentation, Chart, Increments, Point};
use crate::joints::starts::JointStarts;
use crate::kinematics::{Kinematics, LOCKED, Layout, MotionChange, Quantity};
use crate::round_off;
use crate::saddle_point::{Matrix, SaddlePoint};
use crate::scaling::Representative;
use crate::system::{GivenVelocities, Linearization, State, System};
use crate::tuning::MAX_ITERATIONS;

/// Factor of the inertias of parts whose velocity is given beside those that follow them.
const EMPHASIS: f64 = 1e4;
/// Projections with it: what remains after three is round-off.
const EMPHASISED_PROJECTIONS: usize = 3;

/// Inertias that define the metric of a projection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Inertias {
    /// All of them.
    All,
    /// Inertias of parts and generalised coordinates, without those on joint coordinates.
    OfParts,
}

/// Solves for initial values.
pub struct ConsistentInitialConditions {
    saddle: SaddlePoint<Matrix<f64>>,
    redundancy: Redundancy,
    pub(crate) linearization: Linearization,
    scale: f64,
    /// Length that converts radians to lengths [m].
    radian: f64,
    still: Vec<MotionChange>,
    unchanged: Vec<f64>,
    /// Values of the inertia matrix that defines the metric.
    pub(crate) weights: Vec<f64>,
    /// Initial values of joints for the differentiation of constraints.
    starts: JointStarts,
    /// Positions of the factor; none if it is not that of all inertias.
    factored_at: Option<Kinematics>,
    /// The matrix of rigid parts.
    rigid: Known,
}

impl ConsistentInitialConditions {
    /// Storage for initial values of `system`.
    pub fn new(system: &System, state: &State, representative: &Representative, kind: &SolverKind) -> Self {
        let (layout, structure) = (system.layout(), system.structure());
        let matrix = Matrix::new((kind.real)(structure), structure);
        let count = layout.coordinate_count();
        let redundancy = Redundancy::of_rates(system, &state.kinematics, representative.length);
        let mut saddle = SaddlePoint::new(matrix, count).equilibrated(layout.size());
        saddle.omit(redundancy.omitted());
        Self {
            saddle,
            redundancy,
            linearization: system.empty_linearization(),
            scale: if representative.mass > 0.0 { representative.mass } else { 1.0 },
            radian: representative.length,
            still: vec![MotionChange::none(); state.kinematics.nodes.len()],
            unchanged: vec![0.0; state.kinematics.coordinates.len()],
            weights: Vec::new(),
            starts: JointStarts::default(),
            factored_at: None,
            rigid: Known::default(),
        }
    }

    pub(crate) fn factor(
        &mut self,
        system: &System,
        state: &State,
        inertias: Inertias,
    ) -> Result<(), InitialError> {
        let at = &state.kinematics;
        if inertias == Inertias::All
            && self.factored_at.as_ref().is_some_and(|factored| has_constraints_of(factored, at))
        {
            return Ok(());
        }
        if self.redundancy.follow(system, at) {
            self.saddle.omit(self.redundancy.omitted());
            self.rigid = Known::default();
        }
        let zero = vec![0.0; system.layout().multiplier_count];
        let mut linearization = std::mem::take(&mut self.linearization);
        system.linearize(&self.point(at, &zero), Chart::Body, &mut linearization);
        self.linearization = linearization;
        self.weigh(system, inertias);
        self.factor_weights(system)?;
        self.factored_at = Some(at.clone()).filter(|_| inertias == Inertias::All);
        Ok(())
    }

    /// Assembles the inertia matrix from the linearisation.
    fn weigh(&mut self, system: &System, inertias: Inertias) {
        let (layout, pattern) = (system.layout(), &system.structure().pattern);
        let (weights, linearization) = (&mut self.weights, &self.linearization);
        weights.clone_from(&linearization.mass);
        // States have no inertia: a unit diagonal decouples them.
        for (row, ..) in layout.states() {
            if let Some(diagonal) = pattern.position(row, row) {
                weights[diagonal] += 1.0;
            }
        }
        if inertias == Inertias::OfParts {
            let coordinates = system.joints().iter().flat_map(|joint| &joint.coordinates);
            for row in coordinates.map(|&coordinate| layout.row_of_coordinate(coordinate)) {
                for &other in pattern.column(row) {
                    for (row, column) in [(row, other), (other, row)] {
                        if let Some(position) = pattern.position(row, column) {
                            weights[position] = 0.0;
                        }
                    }
                }
            }
        }
    }

    pub(crate) fn factor_weights(&mut self, system: &System) -> Result<(), InitialError> {
        self.factored_at = None;
        let layout = system.layout();
        let Linearization { gram, constraint, .. } = &self.linearization;
        for (i, value) in self.saddle.matrices.values.iter_mut().enumerate() {
            *value = self.weights[i] + self.scale * (gram[i] + constraint[i]);
        }
        let result = self.saddle.factor(system.structure(), self.scale).map(|_| ());
        result.map_err(|error| match error {
            FactorError::ZeroPivot { unknown, pivot, .. } => InitialError::ZeroPivot {
                pivot,
                unknown: layout.subject_of(unknown),
                hint: pivot_hint(unknown, layout, true),
            },
            FactorError::NotFinite { unknown } => {
                InitialError::NotFinite { unknown: layout.subject_of(unknown) }
            }
            FactorError::Interrupted => InitialError::Interrupted(Interrupted),
        })
    }

    fn augmentation(&self) -> Augmentation {
        Augmentation::of_lengths(self.radian)
    }

    pub(crate) fn point<'b>(&'b self, at: &'b Kinematics, multipliers: &'b [f64]) -> Point<'b> {
        Point {
            at,
            stressed: at.into(),
            increments: Increments {
                start: at,
                nodes: &self.still,
                coordinates: &self.unchanged,
                joints: None,
            },
            multipliers,
            violations: multipliers,
            augmentation: self.augmentation(),
        }
    }

    /// Solves [M Bᵀ; B 0] [x; λ] = [motion; constraint], given as one vector, in place. The multipliers are those of least norm.
    pub(crate) fn solve(&mut self, system: &System, right: &mut [f64]) {
        let layout = system.layout();
        let count = layout.coordinate_count();
        self.redundancy.remove_misfit(&mut right[count..]);
        let original = right.to_vec();
        let mut solution = vec![0.0; right.len()];
        // Rows scaled as s B, and the augmented term s Bᵀ W B x = s Bᵀ W c on both sides; refined once.
        for _ in 0..2 {
            let mut rest = original.clone();
            self.subtract_product(system, &solution, &mut rest);
            self.solve_scaled(system, &mut rest);
            solution.iter_mut().zip(&rest).for_each(|(solution, change)| *solution += change);
        }
        right.copy_from_slice(&solution);
        self.redundancy.reduce_to_least_norm(&mut right[count..]);
    }

    /// Solves as [`solve`](Self::solve) at the motion of `state`, by the multipliers alone where parts are rigid.
    ///
    /// # Errors
    /// If constraints are redundant, or a coordinate has neither mass nor constraint.
    pub(super) fn solve_at(
        &mut self,
        system: &System,
        state: &State,
        right: &mut [f64],
    ) -> Result<(), InitialError> {
        let (at, count) = (&state.kinematics, system.layout().coordinate_count());
        if self.redundancy.follow(system, at) {
            self.saddle.omit(self.redundancy.omitted());
            (self.rigid, self.factored_at) = (Known::default(), None);
        }
        let rigid = self.rigid.renewed((system, at), self.redundancy.omitted());
        if let Some(rigid) = rigid
            && rigid.factor().is_some()
        {
            self.redundancy.remove_misfit(&mut right[count..]);
            rigid.solve(right);
            self.redundancy.reduce_to_least_norm(&mut right[count..]);
            return Ok(());
        }
        self.factor(system, state, Inertias::All)?;
        self.solve(system, right);
        Ok(())
    }

    fn solve_scaled(&mut self, system: &System, right: &mut [f64]) {
        let count = system.layout().coordinate_count();
        let constraints: Vec<f64> = right[count..].to_vec();
        self.add_transposed(system, &constraints, right);
        right[count..].iter_mut().for_each(|value| *value *= self.scale);
        self.saddle.solve(right);
        right[count..].iter_mut().for_each(|value| *value *= self.scale);
    }

    /// M x of the last linearisation.
    pub(crate) fn multiply_mass(&self, system: &System, x: &[f64], out: &mut [f64]) {
        system.structure().pattern.multiply(&self.linearization.mass, x, out);
    }

    /// rest -= [M Bᵀ; B 0] x.
    pub(crate) fn subtract_product(&self, system: &System, x: &[f64], rest: &mut [f64]) {
        let pattern = &system.structure().pattern;
        // The first solution is refined from zero.
        for (column, &factor) in x.iter().enumerate().filter(|(_, factor)| **factor != 0.0) {
            let range = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
            let entries = self.weights[range.clone()].iter().zip(&self.linearization.constraint[range]);
            for (&row, (weight, constraint)) in pattern.column(column).iter().zip(entries) {
                rest[row] -= (weight + constraint) * factor;
            }
        }
    }

    /// motion += s Bᵀ W c.
    fn add_transposed(&self, system: &System, constraints: &[f64], rest: &mut [f64]) {
        let pattern = &system.structure().pattern;
        let count = system.layout().coordinate_count();
        for (k, violation) in constraints.iter().enumerate() {
            // Constraints of velocities are not augmented.
            if system.layout().is_of_velocities(k) {
                continue;
            }
            let column = count + k;
            let violation = self.augmentation().relative(system.layout().quantities()[column]) * violation;
            let factor = self.scale * violation;
            let range = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
            let entries = pattern.column(column).iter().zip(&self.linearization.constraint[range]);
            entries.filter(|&(&row, _)| row < count).for_each(|(&row, entry)| rest[row] += entry * factor);
        }
    }

    /// Makes velocities consistent with the constraints by the smallest change in the norm of the kinetic energy. Returns the largest
    /// change of a node's twist [m/s, rad/s].
    ///
    /// # Errors
    /// If constraints are redundant, or a coordinate has neither mass nor constraint.
    pub fn velocities(&mut self, system: &System, state: &mut State) -> Result<f64, InitialError> {
        self.factor(system, state, Inertias::All)?;
        Ok(self.project(system, state, &[]))
    }

    /// Like [`velocities`](Self::velocities), for given velocities of parts and joint coordinates: those that were not given, which
    /// are zero, follow from them whatever their mass. Rates of joints in open trees that nothing determines remain zero.
    ///
    /// # Errors
    /// If constraints are redundant, or a coordinate has neither mass nor constraint.
    pub fn given_velocities(&mut self, system: &System, state: &mut State) -> Result<f64, InitialError> {
        let mut is_given = self.given_rows(system, &state.kinematics);
        if is_given.iter().all(|given| *given) || !is_given.contains(&true) {
            if !system.coordinate_masses.is_empty() && self.factor(system, state, Inertias::OfParts).is_ok() {
                return Ok(self.project(system, state, &[]));
            }
            return self.velocities(system, state);
        }
        for row in open_trees::undetermined(system, &is_given) {
            is_given[row] = true;
        }
        let factor = |own: &mut Self| {
            own.factor(system, state, Inertias::OfParts)?;
            own.emphasise(system, &is_given);
            own.factor_weights(system)
        };
        if factor(self).is_err() {
            return self.velocities(system, state);
        }
        let given = state.kinematics.clone();
        let mut rates = vec![0.0; system.layout().size()];
        gather_rates(system.layout(), &given, &mut rates);
        let mut change = self.project(system, state, &[]);
        // Consistent velocities are reached to EMPHASIS^-k: each time the given ones are restored, and what is left is corrected.
        for _ in 1..EMPHASISED_PROJECTIONS {
            restore(system.layout(), (&is_given, &rates), &mut state.kinematics);
            self.project(system, state, &[]);
        }
        for (node, before) in state.kinematics.nodes.iter().zip(&given.nodes) {
            change = change.max((node.twist - before.twist).amax());
        }
        Ok(change)
    }

    /// Rows of the nodes and joint coordinates with a given velocity: one that is not zero beside the largest, or that the model has.
    fn given_rows(&self, system: &System, at: &Kinematics) -> Vec<bool> {
        let layout = system.layout();
        let count = layout.coordinate_count();
        let mut rates = vec![0.0; layout.size()];
        gather_rates(layout, at, &mut rates);
        let speed = |row: usize| match layout.quantities()[row] {
            Quantity::Length => rates[row].abs(),
            Quantity::Angle => rates[row].abs() * self.radian,
            Quantity::State => 0.0,
        };
        let largest = (0..count).map(speed).fold(0.0, f64::max);
        let is_fast = |row: usize| speed(row) > round_off::GIVEN * largest;
        let mut is_given: Vec<bool> = (0..count).map(is_fast).collect();
        let GivenVelocities { nodes, coordinates } = &system.given_velocities;
        let of_nodes = nodes.iter().flat_map(|&node| layout.rows_of_node(node)).filter(|&&row| row != LOCKED);
        let of_nodes = of_nodes.map(|&row| row as usize);
        let of_coordinates = coordinates.iter().map(|&coordinate| layout.row_of_coordinate(coordinate));
        of_nodes.chain(of_coordinates).for_each(|row| is_given[row] = true);
        for rows in &layout.node_rows {
            let own = || rows.iter().filter(|&&row| row != LOCKED).map(|&row| row as usize);
            if own().any(|row| is_given[row]) {
                own().for_each(|row| is_given[row] = true);
            }
        }
        is_given
    }

    /// Multiplies the inertias of some rows, which keep their velocities then; those of joint coordinates are of the size of the
    /// model's.
    fn emphasise(&mut self, system: &System, is_given: &[bool]) {
        let (layout, pattern) = (system.layout(), &system.structure().pattern);
        let factor = |row: usize| if is_given.get(row) == Some(&true) { EMPHASIS } else { 1.0 };
        for column in 0..is_given.len() {
            for position in pattern.column_starts()[column]..pattern.column_starts()[column + 1] {
                let row = pattern.row_indices()[position];
                self.weights[position] *= (factor(row) * factor(column)).sqrt();
            }
        }
        let coordinates = system.joints().iter().flat_map(|joint| &joint.coordinates);
        for row in coordinates.map(|&coordinate| layout.row_of_coordinate(coordinate)) {
            if is_given[row]
                && let Some(diagonal) = pattern.position(row, row)
            {
                let arm = if layout.quantities()[row] == Quantity::Angle { self.radian } else { 1.0 };
                self.weights[diagonal] += EMPHASIS * self.scale * arm * arm;
            }
        }
    }

    /// Adds the change of velocities that satisfies the constraints and is caused by `impulses`, by row; none if empty. Returns the
    /// largest change of a twist.
    pub(crate) fn project(&mut self, system: &System, state: &mut State, impulses: &[f64]) -> f64 {
        let layout = system.layout();
        let count = layout.coordinate_count();
        let mut speeds = vec![0.0; layout.size()];
        gather_rates(layout, &state.kinematics, &mut speeds);
        let mut right = vec![0.0; layout.size()];
        // -(B v + ∂c/∂t): only the rows of the constraints are kept.
        self.subtract_product(system, &speeds, &mut right);
        right[..count].fill(0.0);
        for (value, impulse) in right[..count].iter_mut().zip(impulses) {
            *value += impulse;
        }
        let mut explicit = vec![0.0; layout.multiplier_count];
        system.constraint_velocities(&state.kinematics, &mut explicit);
        for (value, rate) in right[count..].iter_mut().zip(&explicit) {
            *value -= rate;
        }
        self.solve(system, &mut right);
        add_rates(layout, (1.0, &right), &mut state.kinematics);
        let of_nodes = layout.node_rows.iter().flatten().filter(|&&row| row != LOCKED);
        of_nodes.fold(0.0, |largest, &row| largest.max(right[row as usize].abs()))
    }

    /// Rates of the constraints at the velocities of `state`, by multiplier, with the last linearisation.
    pub(crate) fn constraint_rates(&self, system: &System, state: &State) -> Vec<f64> {
        let layout = system.layout();
        let count = layout.coordinate_count();
        let mut speeds = vec![0.0; layout.size()];
        gather_rates(layout, &state.kinematics, &mut speeds);
        let mut rates = vec![0.0; layout.size()];
        self.subtract_product(system, &speeds, &mut rates);
        let mut explicit = vec![0.0; layout.multiplier_count];
        system.constraint_velocities(&state.kinematics, &mut explicit);
        rates[count..].iter().zip(&explicit).map(|(product, rate)| rate - product).collect()
    }

    /// Computes accelerations and multipliers in equilibrium with positions and velocities.
    ///
    /// # Errors
    /// If constraints are redundant, or a coordinate has neither mass nor constraint.
    pub fn accelerations(&mut self, system: &System, state: &mut State) -> Result<(), InitialError> {
        self.factor(system, state, Inertias::All)?;
        self.factored_accelerations(system, state)
    }

    fn factored_accelerations(&mut self, system: &System, state: &mut State) -> Result<(), InitialError> {
        let right = self.acceleration_with_factors(system, state)?;
        let layout = system.layout();
        scatter_accelerations(layout, &right, &mut state.kinematics);
        state.multipliers.copy_from_slice(&right[layout.coordinate_count()..]);
        state.kinematics.show_multipliers(&state.multipliers);
        Ok(())
    }

    /// Sets the rates of first-order states from their equations x' - f = 0, and algebraic unknowns from their balances.
    ///
    /// # Errors
    /// If a balance has no unique solution near the present values.
    pub(crate) fn set_state_rates(&self, system: &System, at: &mut Kinematics) -> Result<(), InitialError> {
        let layout = system.layout();
        if system.has_balances() {
            return self.solve_state_rates(system, at);
        }
        if layout.state_count() == 0 {
            return Ok(());
        }
        for (_, coordinate, _) in layout.states() {
            at.coordinates[coordinate].rate = 0.0;
        }
        let zero = vec![0.0; layout.multiplier_count];
        let mut residual = vec![0.0; layout.size()];
        system.residual(&self.point(at, &zero), &mut residual);
        for (row, coordinate, _) in layout.states() {
            at.coordinates[coordinate].rate = -residual[row];
        }
        Ok(())
    }

    /// Solves the equations of all states for their rates by Newton's method, with shorter steps where they do not help.
    fn solve_state_rates(&self, system: &System, at: &mut Kinematics) -> Result<(), InitialError> {
        let (layout, pattern) = (system.layout(), &system.structure().pattern);
        let states: Vec<_> = layout.states().collect();
        let zero = vec![0.0; layout.multiplier_count];
        let mut residual = vec![0.0; layout.size()];
        let mut linearization = system.empty_linearization();
        let mut equations = |at: &Kinematics| {
            residual.fill(0.0);
            system.residual(&self.point(at, &zero), &mut residual);
            DVector::from_iterator(states.len(), states.iter().map(|&(row, ..)| residual[row]))
        };
        let mut tangent = |at: &Kinematics| {
            system.linearize(&self.point(at, &zero), Chart::Body, &mut linearization);
            DMatrix::from_fn(states.len(), states.len(), |i, j| {
                let entry = pattern.position(states[i].0, states[j].0);
                entry.map_or(0.0, |entry| linearization.damping[entry])
            })
        };
        let relative = |change: &DVector<f64>, at: &Kinematics| {
            let own = states.iter().zip(change.iter());
            own.map(|(&(_, own, magnitude), change)| {
                change.abs() / magnitude.max(at.coordinates[own].rate.abs())
            })
            .fold(0.0_f64, f64::max)
        };
        let mut found = equations(&*at);
        let mut last = f64::INFINITY;
        for _ in 0..MAX_ITERATIONS {
            let tangent = tangent(at).lu();
            let Some(change) = tangent.solve(&found).filter(|own| own.iter().all(|own| own.is_finite()))
            else {
                break;
            };
            let size = relative(&change, at);
            if size <= round_off::SOLUTION || (size <= round_off::ITERATION && size >= last) {
                return Ok(());
            }
            last = size;
            let mut share = 1.0;
            loop {
                let mut moved = at.clone();
                for (&(_, own, _), change) in states.iter().zip(change.iter()) {
                    moved.coordinates[own].rate -= share * change;
                }
                let there = equations(&moved);
                let further = tangent.solve(&there).map_or(f64::INFINITY, |own| relative(&own, at));
                if further < size || share < round_off::ITERATION {
                    (*at, found) = (moved, there);
                    break;
                }
                share *= 0.5;
            }
        }
        // The first unknown on which no equation depends.
        let tangent = tangent(at);
        let is_free = |column: usize| tangent.column(column).iter().all(|entry| *entry == 0.0);
        let free = (0..states.len()).find(|&column| is_free(column)).unwrap_or(0);
        Err(InitialError::Unbalanced { unknown: layout.subject_of(states[free].0) })
    }

    /// Computes second derivatives of first-order states by a central difference of their rates over `delay` [s] before and after the
    /// state, along the motion.
    pub(crate) fn accelerate_states(&self, system: &System, state: &mut State, delay: f64) {
        let states: Vec<_> = system.layout().states().map(|(_, coordinate, _)| coordinate).collect();
        if states.is_empty() {
            return;
        }
        for &coordinate in &states {
            state.kinematics.coordinates[coordinate].acceleration = 0.0;
        }
        let [after, before] = [delay, -delay].map(|delay| {
            let mut moved = moved(state, delay).kinematics;
            // Beside a state that is balanced others are, or their rates are not differentiated.
            let _ = self.set_state_rates(system, &mut moved);
            moved.coordinates
        });
        for coordinate in states {
            let difference = after[coordinate].rate - before[coordinate].rate;
            let acceleration = difference / (2.0 * delay);
            // If its expression is undefined nearby, a state starts with zero.
            let own = &mut state.kinematics.coordinates[coordinate];
            own.acceleration = if acceleration.is_finite() { acceleration } else { 0.0 };
        }
    }

    /// Accelerations and multipliers by row. The rows of first-order states contain the residuals of their rates.
    pub(crate) fn acceleration_at(
        &mut self,
        system: &System,
        state: &State,
    ) -> Result<Vec<f64>, InitialError> {
        self.factor(system, state, Inertias::All)?;
        self.acceleration_with_factors(system, state)
    }

    /// Like [`acceleration_at`](Self::acceleration_at), with the last factorisation.
    pub(crate) fn acceleration_with_factors(
        &mut self,
        system: &System,
        state: &State,
    ) -> Result<Vec<f64>, InitialError> {
        self.repeated(system, without_accelerations(system.layout(), state))
    }

    /// Accelerations and multipliers without known accelerations. If forces depend on multipliers, fixed-point iteration is used, because
    /// friction is small compared with normal forces.
    pub(super) fn repeated(&mut self, system: &System, mut at: Kinematics) -> Result<Vec<f64>, InitialError> {
        let count = system.layout().coordinate_count();
        let (mut change, mut solution) = (f64::INFINITY, Vec::new());
        let mut relaxation = 1.0;
        for _ in 0..MAX_ITERATIONS {
            let mut right = self.right_side(system, &at);
            self.solve(system, &mut right);
            if !system.sees_multipliers() {
                return Ok(right);
            }
            let (seen, found) = (&mut at.multipliers, &right[count..]);
            let both = seen.iter().chain(found);
            let largest = both.fold(0.0_f64, |most, value| most.max(value.abs()));
            let changes = seen.iter().zip(found).map(|(seen, found)| (seen - found).abs());
            let last =
                std::mem::replace(&mut change, changes.fold(0.0, f64::max) / largest.max(f64::MIN_POSITIVE));
            if change == 0.0 || (change < round_off::ITERATION && change >= last) {
                return Ok(right);
            }
            if change >= last && last.is_finite() {
                // Friction that relieves its contact by more than half of the normal force.
                relaxation *= 0.5;
            }
            seen.iter_mut().zip(found).for_each(|(seen, found)| *seen += relaxation * (found - *seen));
            solution = right;
        }
        if change < round_off::ITERATION { Ok(solution) } else { Err(InitialError::NormalForces { change }) }
    }

    /// [-f; -(Ḃ v + ∂²c/∂t²)] at a motion without accelerations.
    fn right_side(&mut self, system: &System, at: &Kinematics) -> Vec<f64> {
        let mut right = self.left_side(system, at, &vec![0.0; system.layout().multiplier_count]);
        for value in &mut right {
            *value = -*value;
        }
        right
    }

    /// Left-hand sides of the equations of motion, and accelerations of the violations.
    pub(super) fn left_side(&mut self, system: &System, at: &Kinematics, multipliers: &[f64]) -> Vec<f64> {
        let layout = system.layout();
        let mut left = vec![0.0; layout.size()];
        system.residual(&self.point(at, multipliers), &mut left);
        let mut rates = vec![0.0; layout.multiplier_count];
        system.begin_step(at, &mut self.starts);
        let accelerations = &mut left[layout.coordinate_count()..];
        system.violation_rates(at, &self.starts, [&mut rates, accelerations]);
        left
    }

    /// Accelerations by row `delay` [s] after (or before) the state, for schemes whose history starts there: v̇ + delay v̈, with v̈ from a
    /// central difference along the motion, or a difference to one side where the other one has no forces.
    ///
    /// # Errors
    /// If the equations cannot be solved nearby.
    pub fn delayed_accelerations(
        &mut self,
        system: &System,
        state: &State,
        delay: f64,
    ) -> Result<Vec<f64>, InitialError> {
        let layout = system.layout();
        let count = layout.coordinate_count();
        let mut now = vec![0.0; layout.size()];
        gather_accelerations(layout, &state.kinematics, &mut now);
        now.truncate(count);
        if delay == 0.0 {
            return Ok(now);
        }
        let mut near = |size: f64| self.acceleration_at(system, &moved(state, size));
        let sides = [near(delay)?, near(-delay)?];
        // Data such as a wind may begin with the motion.
        let is_finite = sides.each_ref().map(|side| side.iter().all(|value| value.is_finite()));
        let between = |row: usize| match is_finite {
            [true, true] => 0.5 * sides[0][row] - 0.5 * sides[1][row],
            [true, false] => sides[0][row] - now[row],
            [false, true] => now[row] - sides[1][row],
            [false, false] => 0.0,
        };
        let mut difference: Vec<f64> = (0..count).map(between).collect();
        // Rates of states are in equilibrium already and are not extrapolated.
        let mut compared = now.clone();
        for (row, ..) in layout.states() {
            (compared[row], difference[row]) = (0.0, 0.0);
        }
        let size = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        // If accelerations change by more than their magnitude, the step does not resolve them, and their extrapolation would only
        // excite the oscillation.
        if size(&difference) <= size(&compared) {
            for (value, change) in now.iter_mut().zip(&difference) {
                *value += change;
            }
        }
        Ok(now)
    }
}

/// Whether inertias and constraints of two motions are the same: those of the same positions.
fn has_constraints_of(one: &Kinematics, other: &Kinematics) -> bool {
    let frames = |at: &Kinematics| at.nodes.iter().map(|node| node.frame).collect::<Vec<_>>();
    let values = |at: &Kinematics| at.coordinates.iter().map(|own| own.value).collect::<Vec<_>>();
    one.time == other.time
        && one.held == other.held
        && values(one) == values(other)
        && frames(one) == frames(other)
}

/// The motion of a state with accelerations of zero.
pub(super) fn without_accelerations(layout: &Layout, state: &State) -> Kinematics {
    let mut at = state.kinematics.clone();
    scatter_accelerations(layout, &vec![0.0; layout.size()], &mut at);
    at
}

/// The state extrapolated along its motion over a short time [s], to second order.
pub(crate) fn moved(state: &State, time: f64) -> State {
    let mut moved = state.clone();
    moved.kinematics.time += time;
    for node in &mut moved.kinematics.nodes {
        let psi = time * (node.twist + 0.5 * time * node.acceleration);
        node.frame = node.frame * Motion::exponential(&psi);
        node.twist += time * node.acceleration;
    }
    for coordinate in &mut moved.kinematics.coordinates {
        coordinate.value += time * (coordinate.rate + 0.5 * time * coordinate.acceleration);
        coordinate.rate += time * coordinate.acceleration;
    }
    moved
}

pub(crate) fn gather_rates(layout: &Layout, at: &Kinematics, out: &mut [f64]) {
    gather(layout, at, out, |node| &node.twist, |coordinate| coordinate.rate);
}

pub(crate) fn gather_accelerations(layout: &Layout, at: &Kinematics, out: &mut [f64]) {
    gather(layout, at, out, |node| &node.acceleration, |coordinate| coordinate.acceleration);
}

fn gather(
    layout: &Layout,
    at: &Kinematics,
    out: &mut [f64],
    of_node: impl Fn(&crate::kinematics::NodeMotion) -> &Vector6,
    of_coordinate: impl Fn(&crate::kinematics::CoordinateMotion) -> f64,
) {
    for (rows, node) in layout.node_rows.iter().zip(&at.nodes) {
        for (k, &row) in rows.iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
            out[row as usize] = of_node(node)[k];
        }
    }
    for (&row, coordinate) in layout.coordinate_rows.iter().zip(&at.coordinates) {
        out[row as usize] = of_coordinate(coordinate);
    }
}

/// Calls `visit` with the row of each velocity, the velocity and its acceleration.
pub(crate) fn visit_rates(
    layout: &Layout,
    at: &mut Kinematics,
    mut visit: impl FnMut(usize, &mut f64, &mut f64),
) {
    for (rows, node) in layout.node_rows.iter().zip(&mut at.nodes) {
        for (k, &row) in rows.iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
            visit(row as usize, &mut node.twist[k], &mut node.acceleration[k]);
        }
    }
    for (&row, coordinate) in layout.coordinate_rows.iter().zip(&mut at.coordinates) {
        visit(row as usize, &mut coordinate.rate, &mut coordinate.acceleration);
    }
}

/// Sets twists and rates.
pub(crate) fn scatter_rates(layout: &Layout, values: &[f64], at: &mut Kinematics) {
    visit_rates(layout, at, |row, rate, _| *rate = values[row]);
}

/// Adds a factor times changes of twists and rates.
pub(crate) fn add_rates(layout: &Layout, (factor, changes): (f64, &[f64]), at: &mut Kinematics) {
    visit_rates(layout, at, |row, rate, _| *rate += factor * changes[row]);
}

/// Sets the rates of some rows.
fn restore(layout: &Layout, (is_given, rates): (&[bool], &[f64]), at: &mut Kinematics) {
    visit_rates(layout, at, |row, rate, _| {
        if is_given.get(row) == Some(&true) {
            *rate = rates[row];
        }
    });
}

pub(crate) fn scatter_accelerations(layout: &Layout, values: &[f64], at: &mut Kinematics) {
    visit_rates(layout, at, |row, _, acceleration| *acceleration = values[row]);
}
