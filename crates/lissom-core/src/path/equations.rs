//! Nonlinear equations of a step along an equilibrium path: equilibrium, constraints, and one equation for the load factor. The
//! bordered matrix is solved with the factors of the stiffness and two right-hand sides.

use std::sync::Arc;

use lissom_motion::{Motion, Vector6};
use lissom_solver::{FactorError, Pattern};

use super::systems::PathSystems;
use super::{PathSettings, Solution, Tangent};
use crate::consistent::redundancy::Redundancy;
use crate::errors::StepError;
use crate::errors::step_error::{NO_STEP_HELPS, pivot_hint};
use crate::integrator::equations::FAR_FROM_EQUILIBRIUM;
use crate::integrator::workspace::sizes;
use crate::iterate;
use crate::joints::evaluation_point::{Chart, Increments, Point};
use crate::kinematics::{Kinematics, LOCKED, MotionChange, Stressed};
use crate::newton::{Correction, Equations, Failure};
use crate::saddle_point::potential::{self, has_potential};
use crate::saddle_point::{Matrix, SaddlePoint};
use crate::scaling::{Representative, Scaled};
use crate::schemes::Weights;
use crate::system::{Scratch, State, Sum, System, TangentAssembler};
use crate::tuning::INVERSE_ITERATIONS;

/// Largest correction; larger ones are scaled down [-, rad].
const MAX_CORRECTION: f64 = 0.5;

/// Largest asymmetry of the equilibrated tangent of a conservative system.
const ASYMMETRY: f64 = 1e-7;

/// The equation for the load factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Condition {
    /// Prescribed distance from the start of the step.
    Arc(f64),
    /// Prescribed load factor.
    Load(f64),
    /// Prescribed component of the displacement along the tangent at the start of the step.
    Along(f64),
}

/// Increment of the scaled displacements and multipliers, by row, and of the load factor.
#[derive(Clone, Debug)]
struct Change {
    rows: Vec<f64>,
    load: f64,
}

/// Storage of a step, allocated once.
pub(super) struct PathWork {
    scaled: Scaled,
    saddle: SaddlePoint<Matrix<f64>>,
    redundancy: Redundancy,
    /// Whether the last factored tangent is symmetric. Otherwise its negative pivots only determine the sign of its determinant.
    is_symmetric: bool,
    /// Whether the antisymmetric part of the stiffness does no work under the constraints; none as long as there is none.
    has_potential: Option<bool>,
    other_values: Vec<f64>,
    scratch: Scratch,
    iterate: Iterate,
    forces: Forces,
    last: Change,
    before: Change,
    correction: f64,
    norms: Norms,
    /// Pseudo-random right-hand side.
    probe: Vec<f64>,
}

/// The point at which the equations are evaluated.
struct Iterate {
    at: Kinematics,
    /// Before the last correction.
    previous: Kinematics,
    changes: Vec<MotionChange>,
    coordinate_changes: Vec<f64>,
    multipliers: Vec<f64>,
    load_factor: f64,
    /// Violations at the start of the step, of the system in use.
    violations: Vec<f64>,
    /// Sum of all increments since the start of the step.
    total: Vec<f64>,
}

/// Residuals, and their derivatives by the load factor.
struct Forces {
    residual: Vec<f64>,
    /// Residual of the other system.
    other: Vec<f64>,
    load: Vec<f64>,
    /// Displacements per unit of the load factor, at the last tangent.
    response: Vec<f64>,
}

/// Measures of vectors.
struct Norms {
    /// Square root of the weight of each row in the distance along the path.
    weights: Vec<f64>,
    /// Scale factor of each row.
    sizes: Vec<f64>,
}

impl PathWork {
    pub(super) fn new(systems: &PathSystems, state: &State, settings: &PathSettings) -> Self {
        let (unloaded, loaded) = (systems.unloaded(), systems.any());
        let layout = loaded.layout();
        let (size, count) = (layout.size(), layout.coordinate_count());
        let entries = loaded.structure().pattern.entries();
        let linearization = unloaded.linearization_at(&state.kinematics);
        let representative = Representative::of(unloaded, &state.kinematics, &linearization);
        let sizes = sizes(layout, &representative);
        let matrix = Matrix::new((settings.solver.real)(loaded.structure()), loaded.structure());
        let redundancy = Redundancy::new(loaded, &state.kinematics, representative.length);
        let mut saddle = SaddlePoint::new(matrix, count).equilibrated(size);
        saddle.omit(redundancy.omitted());
        let mut noise = 1.0_f64;
        let zeros = vec![0.0; size];
        let nothing = Change { rows: zeros.clone(), load: 0.0 };
        Self {
            scaled: Scaled::new(&settings.scaling, &representative, 1.0),
            saddle,
            redundancy,
            is_symmetric: true,
            has_potential: None,
            other_values: vec![0.0; entries],
            scratch: Scratch::default(),
            iterate: Iterate {
                at: state.kinematics.clone(),
                previous: state.kinematics.clone(),
                changes: vec![MotionChange::none(); state.kinematics.nodes.len()],
                coordinate_changes: vec![0.0; state.kinematics.coordinates.len()],
                multipliers: state.multipliers.clone(),
                load_factor: 0.0,
                violations: state.violations.clone(),
                total: zeros.clone(),
            },
            forces: Forces {
                residual: zeros.clone(),
                other: zeros.clone(),
                load: zeros.clone(),
                response: zeros,
            },
            last: nothing.clone(),
            before: nothing,
            correction: 0.0,
            norms: Norms { weights: sizes.iter().map(|size| size / (count as f64).sqrt()).collect(), sizes },
            probe: (0..count)
                .map(|_| {
                    // Pseudo-random numbers [logistic map].
                    noise = (3.9 * 0.5 * noise * (1.0 - 0.5 * noise)).abs().max(1e-3) * 2.0;
                    noise - 1.0
                })
                .collect(),
        }
    }

    /// Inner product of two displacements in the metric of the path.
    pub(super) fn inner(&self, a: &[f64], b: &[f64]) -> f64 {
        self.norms.weights.iter().zip(a).zip(b).map(|((weight, a), b)| (weight * a) * (weight * b)).sum()
    }

    /// Distance between start and end of the last solution.
    pub(super) fn length_of_last(&self) -> f64 {
        self.inner(&self.iterate.total, &self.iterate.total).sqrt()
    }

    /// Total increment since the start of the last solution, by row.
    pub(super) fn total(&self) -> &[f64] {
        &self.iterate.total
    }

    /// Sign of the displacement or rotation with the largest scaled magnitude.
    pub(super) fn sense_of_largest(&self, values: &[f64]) -> f64 {
        let scaled = self.norms.sizes.iter().zip(values).map(|(size, value)| size * value);
        let largest = scaled.fold(0.0_f64, |most, value| if value.abs() > most.abs() { value } else { most });
        largest.signum()
    }

    /// Whether the response to the load is zero.
    pub(super) fn load_is_zero(&self) -> bool {
        self.forces.response.iter().all(|&value| value == 0.0)
    }

    fn largest(&self, values: &[f64]) -> f64 {
        self.norms.sizes.iter().zip(values).fold(0.0_f64, |most, (size, value)| {
            let scaled = (size * value).abs();
            if scaled <= most { most } else { scaled }
        })
    }
}

/// Whether the coordinate block (rows and columns below `count`) of equilibrated values on `pattern` is symmetric. The tangent of
/// follower loads, which are not conservative, is not.
fn is_symmetric(pattern: &Pattern, values: &[f64], count: usize) -> bool {
    let mut entries = pattern.mirrors().filter(|&(row, ..)| row < count);
    entries.all(|(_, _, [below, above])| (values[below] - values[above]).abs() <= ASYMMETRY)
}

/// One step from `start`.
pub(super) struct PathEquations<'a> {
    pub(super) systems: &'a mut PathSystems,
    pub(super) settings: &'a PathSettings,
    pub(super) start: &'a State,
    pub(super) start_factor: f64,
    /// Tangent of the path at the start; none for the first equilibrium.
    pub(super) tangent: Option<&'a Tangent>,
    pub(super) condition: Condition,
    pub(super) work: &'a mut PathWork,
}

impl PathEquations<'_> {
    /// Sets the predictor along the tangent.
    pub(super) fn begin(&mut self) {
        let work = &mut *self.work;
        if work.redundancy.follow(self.systems.any(), &self.start.kinematics) {
            work.saddle.omit(work.redundancy.omitted());
        }
        work.iterate.at.nodes.copy_from_slice(&self.start.kinematics.nodes);
        work.iterate.previous.nodes.copy_from_slice(&self.start.kinematics.nodes);
        work.iterate.at.coordinates.copy_from_slice(&self.start.kinematics.coordinates);
        (work.iterate.at.time, work.iterate.at.elapsed) = (self.start.kinematics.time, 0.0);
        work.iterate.changes.fill(MotionChange::none());
        work.iterate.coordinate_changes.fill(0.0);
        work.iterate.multipliers.copy_from_slice(&self.start.multipliers);
        work.iterate.load_factor = self.start_factor;
        work.iterate.total.fill(0.0);
        work.correction = 0.0;
        let Some(tangent) = self.tangent else { return };
        let length = match self.condition {
            Condition::Arc(length) | Condition::Along(length) => length,
            Condition::Load(load) => (load - self.start_factor) / tangent.load_rate,
        };
        let guess = Change {
            rows: tangent.direction.iter().map(|value| length * value).collect(),
            load: length * tangent.load_rate,
        };
        self.apply(&guess, 1.0);
        self.work.correction = self.work.largest(&guess.rows);
    }

    fn apply(&mut self, change: &Change, share: f64) {
        let layout = self.systems.any().layout();
        let predicts_stresses = self.systems.any().predicts_stresses();
        let work = &mut *self.work;
        work.iterate.previous.nodes.copy_from_slice(&work.iterate.at.nodes);
        for (node, rows) in layout.node_rows.iter().enumerate() {
            let mut psi = Vector6::zeros();
            for (k, &row) in rows.iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
                psi[k] = share * change.rows[row as usize];
            }
            if psi == Vector6::zeros() {
                continue;
            }
            let motion = if predicts_stresses {
                iterate::correction(&psi, share < 0.0)
            } else {
                Motion::exponential(&psi)
            };
            work.iterate.changes[node] = work.iterate.changes[node].then(&MotionChange::of(&motion));
            work.iterate.at.nodes[node].frame = work.iterate.at.nodes[node].frame * motion;
        }
        for (coordinate, &row) in layout.coordinate_rows.iter().enumerate() {
            let value = share * change.rows[row as usize];
            work.iterate.coordinate_changes[coordinate] += value;
            work.iterate.at.coordinates[coordinate].value += value;
        }
        let factor = share * work.scaled.multiplier_factor();
        let count = layout.coordinate_count();
        for (multiplier, value) in work.iterate.multipliers.iter_mut().zip(&change.rows[count..]) {
            *multiplier += factor * value;
        }
        work.redundancy.reduce_to_least_norm(&mut work.iterate.multipliers);
        for (sum, value) in work.iterate.total.iter_mut().zip(&change.rows) {
            *sum += share * value;
        }
        work.iterate.load_factor += share * change.load;
    }

    fn point(&self, stressed_at_start: bool) -> Point<'_> {
        let work = &*self.work;
        Point {
            at: &work.iterate.at,
            stressed: Stressed {
                at: if stressed_at_start { &self.start.kinematics } else { &work.iterate.at },
                previous: Some(&work.iterate.previous),
            },
            increments: Increments {
                start: &self.start.kinematics,
                nodes: &work.iterate.changes,
                coordinates: &work.iterate.coordinate_changes,
                joints: None,
            },
            multipliers: &work.iterate.multipliers,
            violations: &work.iterate.violations,
            augmentation: work.scaled.augmentation(),
        }
    }

    /// Evaluates the residual, with loads also its derivative by the load factor. False if there is no system for the present value.
    fn evaluate(&mut self) -> bool {
        let value = self.work.iterate.load_factor;
        let system = match &mut *self.systems {
            PathSystems::Loads([_, loaded]) => {
                self.work.iterate.violations.copy_from_slice(&self.start.violations);
                Arc::clone(loaded)
            }
            PathSystems::Number(number) => {
                let Some(system) = number.at(value) else { return false };
                system.violations(&self.start.kinematics, &mut self.work.iterate.violations);
                system
            }
        };
        let mut residual = std::mem::take(&mut self.work.forces.residual);
        system.residual(&self.point(false), &mut residual);
        if let PathSystems::Loads([unloaded, _]) = &*self.systems {
            let mut other = std::mem::take(&mut self.work.forces.other);
            unloaded.residual(&self.point(false), &mut other);
            let work = &mut *self.work;
            for ((load, residual), unloaded) in work.forces.load.iter_mut().zip(&mut residual).zip(&other) {
                *load = *residual - unloaded;
                *residual = unloaded + value * *load;
            }
            work.forces.other = other;
        }
        self.work.forces.residual = residual;
        true
    }

    /// Evaluates the derivative of the residual by a model parameter, by differences. False if there are no systems for neighbouring
    /// values.
    fn differentiate(&mut self) -> bool {
        let PathSystems::Number(number) = &mut *self.systems else { return true };
        let Some([below, above]) = number.around(self.work.iterate.load_factor) else { return false };
        let own = self.work.iterate.violations.clone();
        let mut other = std::mem::take(&mut self.work.forces.other);
        let mut load = std::mem::take(&mut self.work.forces.load);
        for ((_, system), out) in [&below, &above].into_iter().zip([&mut other, &mut load]) {
            system.violations(&self.start.kinematics, &mut self.work.iterate.violations);
            system.residual(&self.point(false), out);
        }
        for (load, other) in load.iter_mut().zip(&other) {
            *load = (*load - other) / (above.0 - below.0);
        }
        (self.work.forces.other, self.work.forces.load, self.work.iterate.violations) = (other, load, own);
        true
    }

    /// Linearises at the iterate and factors the tangent, of loads with a potential the symmetric part if the iterate `is_converged`;
    /// then solves for the response to the load.
    fn factor(&mut self, stressed_at_start: bool, is_converged: bool) -> Result<(), FactorError> {
        if !(self.evaluate() && self.differentiate()) {
            return Err(FactorError::NotFinite { unknown: 0 });
        }
        let mut values = std::mem::take(&mut self.work.saddle.matrices.values);
        let mut other = std::mem::take(&mut self.work.other_values);
        let mut scratch = std::mem::take(&mut self.work.scratch);
        let blend = self.work.scaled.blend(Weights::AT_REST);
        let system = match &mut *self.systems {
            PathSystems::Loads([_, loaded]) => Some(Arc::clone(loaded)),
            PathSystems::Number(number) => number.at(self.work.iterate.load_factor),
        };
        let Some(system) = system else { return Err(FactorError::NotFinite { unknown: 0 }) };
        let point = self.point(stressed_at_start);
        let mut hand = |system: &System, values: &mut [f64]| {
            let mut receiver = TangentAssembler::Real(Sum { blend, values, stiffness: &mut [] });
            system.assemble_tangent(&point, Chart::Body, &mut scratch, &mut receiver);
        };
        hand(&system, &mut values);
        let has_loads = if let PathSystems::Loads([unloaded, _]) = &*self.systems {
            hand(unloaded, &mut other);
            true
        } else {
            false
        };
        let count = system.layout().coordinate_count();
        let work = &mut *self.work;
        if has_loads {
            for (value, unloaded) in values.iter_mut().zip(&other) {
                *value = unloaded + work.iterate.load_factor * (*value - unloaded);
            }
        }
        let structure = system.structure();
        if stressed_at_start && system.predicts_stresses() {
            iterate::hold_unbalanced_forces(system.layout(), &structure.pattern, &mut values);
        }
        let scale = work.scaled.scale();
        let may_have_potential = is_converged && system.has_loads_of_motion();
        if may_have_potential && work.has_potential == Some(true) {
            iterate::hold_unbalanced_forces(system.layout(), &structure.pattern, &mut values);
            potential::symmetrise(&structure.pattern, &mut values, count);
        }
        let raw = (may_have_potential && work.has_potential.is_none()).then(|| values.clone());
        (work.saddle.matrices.values, work.other_values, work.scratch) = (values, other, scratch);
        work.saddle.renew(structure, scale, &mut |_| true)?;
        work.is_symmetric = is_symmetric(&structure.pattern, &work.saddle.matrices.values, count);
        if let Some(mut values) = raw.filter(|_| !work.is_symmetric) {
            iterate::hold_unbalanced_forces(system.layout(), &structure.pattern, &mut values);
            let has_potential = has_potential(structure, (&values, count), scale, work.saddle.omitted());
            work.has_potential = Some(has_potential);
            if has_potential {
                potential::symmetrise(&structure.pattern, &mut values, count);
                work.saddle.matrices.values = values;
                work.saddle.renew(structure, scale, &mut |_| true)?;
                work.is_symmetric = true;
            }
        }
        let mut response = std::mem::take(&mut work.forces.response);
        for (value, load) in response.iter_mut().zip(&work.forces.load) {
            *value = -load;
        }
        self.solve(&mut response);
        self.work.forces.response = response;
        Ok(())
    }

    /// Solves with the factored tangent for a right-hand side in SI units.
    fn solve(&mut self, right: &mut [f64]) {
        let work = &mut *self.work;
        work.scaled.scale_residual(self.systems.any().layout(), right);
        work.saddle.solve(right);
    }

    /// The converged state, and the tangent of the path there.
    pub(super) fn finish(&mut self, iterations: usize) -> Result<Solution, StepError> {
        self.factor(false, true).map_err(|error| self.describe(&Failure::Factor(error)))?;
        let count = self.systems.any().layout().coordinate_count();
        let multiplier_count = self.work.iterate.multipliers.len();
        let mut probe = vec![0.0; count + multiplier_count];
        probe[..count].copy_from_slice(&self.work.probe);
        // Forces in units of the scaled equations: the length of the model corresponds to one radian.
        for (value, size) in probe.iter_mut().zip(&self.work.norms.sizes) {
            *value *= size;
        }
        let right = probe.clone();
        self.solve(&mut probe);
        let flexibility: f64 = probe[..count].iter().zip(&right).map(|(a, b)| a * b).sum();
        let work = &*self.work;
        let norm = work.inner(&work.forces.response, &work.forces.response).sqrt();
        let mut tangent = Tangent {
            direction: work.forces.response.iter().map(|value| value / norm).collect(),
            load_rate: norm.recip(),
            turn: 0.0,
            unstable: 0,
            signature: flexibility.recip(),
        };
        tangent.turn = work.largest(&tangent.direction[..count]);
        let negative =
            work.saddle.report().and_then(|report| report.negative_pivots).unwrap_or(multiplier_count);
        tangent.unstable = negative.saturating_sub(multiplier_count);
        if !work.is_symmetric {
            tangent.unstable = (negative + multiplier_count) % 2;
        }
        if let Some(before) = self.tangent
            && work.inner(&before.direction, &tangent.direction) < 0.0
        {
            tangent.reverse();
        }
        let mut state = self.start.clone();
        state.kinematics.clone_from(&work.iterate.at);
        state.kinematics.elapsed = 0.0;
        for node in &mut state.kinematics.nodes {
            node.frame.rotation = node.frame.rotation.normalized();
        }
        state.multipliers.copy_from_slice(&work.iterate.multipliers);
        let mut violations = vec![0.0; multiplier_count];
        // The system in use belongs to this value: it was linearised here.
        self.systems.any().stage_violations(&self.point(false), &mut violations);
        state.violations = violations;
        Ok(Solution { state, load_factor: self.work.iterate.load_factor, tangent, iterations })
    }

    /// Softest direction of the last factored stiffness, of length 1, by inverse iteration.
    pub(super) fn softest_direction(&mut self) -> Vec<f64> {
        let count = self.systems.any().layout().coordinate_count();
        let mut direction = vec![0.0; count + self.work.iterate.multipliers.len()];
        for ((value, probe), size) in direction.iter_mut().zip(&self.work.probe).zip(&self.work.norms.sizes) {
            *value = probe * size;
        }
        for _ in 0..INVERSE_ITERATIONS {
            direction[count..].fill(0.0);
            self.solve(&mut direction);
            let norm = self.work.inner(&direction, &direction).sqrt();
            for value in &mut direction {
                *value /= norm;
            }
        }
        direction
    }

    /// Records a zero increment; the last increment becomes the one before.
    fn note_nothing(&mut self) {
        let work = &mut *self.work;
        std::mem::swap(&mut work.before, &mut work.last);
        work.last.rows.fill(0.0);
        work.last.load = 0.0;
    }

    /// Error of a failure, with the names of the unknowns.
    pub(super) fn describe(&self, failure: &Failure) -> StepError {
        let layout = self.systems.any().layout();
        let time = self.start.kinematics.time;
        let work = &*self.work;
        let scaled = |row: usize| (work.norms.sizes[row] * work.last.rows[row]).abs();
        let worst = || {
            let largest = (0..work.norms.sizes.len()).max_by(|&a, &b| scaled(a).total_cmp(&scaled(b)));
            layout.subject_of(largest.unwrap_or(0))
        };
        let hint = NO_STEP_HELPS;
        match *failure {
            Failure::NotConverged { iterations, correction } => {
                StepError::NotConverged { time, iterations, correction, worst: worst(), hint }
            }
            Failure::NotFinite { iterations } => {
                StepError::NotFinite { time, iterations, worst: worst(), hint }
            }
            Failure::Factor(FactorError::ZeroPivot { unknown, pivot, .. }) => StepError::ZeroPivot {
                time,
                pivot,
                unknown: layout.subject_of(unknown),
                hint: pivot_hint(unknown, layout, self.settings.scaling.augmented),
                after_pivoting: false,
            },
            Failure::Factor(FactorError::NotFinite { unknown }) => {
                StepError::NotFinite { time, iterations: 0, worst: layout.subject_of(unknown), hint }
            }
            Failure::Factor(FactorError::Interrupted) | Failure::Interrupted => {
                StepError::Interrupted { time }
            }
        }
    }
}

impl Equations for PathEquations<'_> {
    fn correct(&mut self) -> Correction {
        if !self.evaluate() {
            self.note_nothing();
            return Correction { size: f64::NAN, reference: 0.0 };
        }
        let mut rows = std::mem::take(&mut self.work.before.rows);
        rows.copy_from_slice(&self.work.forces.residual);
        let count = self.systems.any().layout().coordinate_count();
        let work = &mut *self.work;
        work.redundancy.remove_misfit(&mut rows[count..]);
        work.saddle.omitted().iter().for_each(|&row| rows[row] = 0.0);
        self.solve(&mut rows);
        for value in &mut rows {
            *value = -*value;
        }
        let work = &mut *self.work;
        let load = match self.condition {
            Condition::Load(load) => load - work.iterate.load_factor,
            Condition::Arc(length) => {
                let excess = 0.5 * (work.inner(&work.iterate.total, &work.iterate.total) - length * length);
                -(excess + work.inner(&work.iterate.total, &rows))
                    / work.inner(&work.iterate.total, &work.forces.response)
            }
            Condition::Along(length) => {
                let direction = self.tangent.map_or(&[][..], |tangent| &tangent.direction);
                let way = work.inner(direction, &work.iterate.total) + work.inner(direction, &rows);
                (length - way) / work.inner(direction, &work.forces.response)
            }
        };
        for (value, response) in rows.iter_mut().zip(&work.forces.response) {
            *value += load * response;
        }
        let size = work.largest(&rows[..count]);
        let mut change = Change { rows, load };
        if !(size.is_finite() && load.is_finite()) {
            work.before.rows = change.rows;
            self.note_nothing();
            return Correction { size: f64::NAN, reference: 0.0 };
        }
        if size > MAX_CORRECTION {
            let cut = MAX_CORRECTION / size;
            for value in &mut change.rows {
                *value *= cut;
            }
            change.load *= cut;
        }
        self.apply(&change, 1.0);
        let work = &mut *self.work;
        work.correction = size;
        work.before = std::mem::replace(&mut work.last, change);
        let reference = work.largest(&work.iterate.total[..count]);
        // The load factor is weighted like a displacement, relative to its magnitude.
        let of_load =
            work.iterate.load_factor.abs().max((work.iterate.load_factor - self.start_factor).abs());
        let load = if of_load > 0.0 { work.last.load.abs() / of_load * reference } else { 0.0 };
        Correction { size: size.max(load), reference }
    }

    fn renew_tangent(&mut self) -> Result<(), FactorError> {
        // The stresses of an iterate far from equilibrium are meaningless.
        let is_far = self.work.correction > FAR_FROM_EQUILIBRIUM;
        self.factor(is_far, false)
    }

    fn leads_elsewhere(&self) -> bool {
        self.work.correction > FAR_FROM_EQUILIBRIUM && self.systems.any().predicts_stresses()
    }

    fn restart(&mut self) {
        self.begin();
    }

    fn back_off(&mut self) {
        let last = self.work.last.clone();
        let mut before = self.work.before.clone();
        if last.rows.iter().all(|value| value.is_finite()) {
            self.apply(&last, -1.0);
        }
        self.apply(&before, -0.5);
        for value in &mut before.rows {
            *value *= 0.5;
        }
        before.load *= 0.5;
        // Half of the increment remains applied, and may be halved again.
        self.work.last = before;
    }
}
