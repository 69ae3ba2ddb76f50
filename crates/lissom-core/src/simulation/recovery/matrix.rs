//! Saddle-point matrix of a recovery, M + τ D + τ² K with the constraints, assembled and factored at a recorded instant; D and K belong to
//! elements that may be stiff.
//!
//! ```text
//! [M + τ D + τ² K + s BᵀWB, s Bᵀ; s B, 0] [x; λ/s] = [b + s BᵀW c; s c]
//! ```
//!
//! s is a mass, and W converts radians to lengths. Solutions are not refined: right-hand sides are residuals evaluated at the present
//! state, so that the error is a fraction of a correction.

use lissom_solver::{Pattern, SolverKind};

use super::stiff_parts::StiffParts;
use crate::consistent::redundancy::Redundancy;
use crate::consistent::rigid::{Known, WELL_CONDITIONED};
use crate::joints::evaluation_point::{Augmentation, Chart, Increments, Point};
use crate::joints::starts::JointStarts;
use crate::kinematics::{Kinematics, Layout, MotionChange};
use crate::saddle_point::{Matrix, SaddlePoint};
use crate::scaling::Representative;
use crate::system::{Blend, Scratch, State, Sum, System, TangentAssembler};

/// Relative change of velocities by the filter below which it is omitted: steps resolve such vibrations, so that their forces are more exact
/// without it.
const NEGLIGIBLE_FILTER: f64 = 1e-6;

/// Inertias of coordinates change less than by this factor from record to record.
const CERTAIN: f64 = 10.0;

/// Consecutive entries of a column in consecutive rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub(super) column: usize,
    pub(super) row: usize,
    pub(super) position: usize,
    pub(super) length: usize,
}

/// The matrix, its factors, and the data of the residuals.
pub(super) struct RecoveryMatrix {
    saddle: SaddlePoint<Matrix<f64>>,
    redundancy: Redundancy,
    /// The matrix of rigid parts without stiffness. It was factored last if `is_rigid`.
    rigid: Known,
    is_rigid: bool,
    /// Elements that may be stiff, if there are any.
    stiff: Option<StiffParts>,
    /// Scratch memory of the assembly.
    scratch: Option<Box<Scratch>>,
    /// s.
    scale: f64,
    augmentation: Augmentation,
    /// W by multiplier.
    weights: Vec<f64>,
    still: Vec<MotionChange>,
    unchanged: Vec<f64>,
    zero: Vec<f64>,
    starts: JointStarts,
    /// Whether a row is an equation of rates.
    is_of_rates: Vec<bool>,
    /// Entries between motions, and those of Bᵀ.
    between_motions: Vec<Run>,
    of_constraints: Vec<Run>,
}

impl RecoveryMatrix {
    /// Storage for the matrices of `system`.
    pub(super) fn new(
        (system, state): (&System, &State),
        (representative, redundancy): (&Representative, Redundancy),
        kind: &'static SolverKind,
    ) -> Self {
        let (layout, pattern) = (system.layout(), &system.structure().pattern);
        let count = layout.coordinate_count();
        let augmentation = Augmentation::of_lengths(representative.length);
        let mut is_of_rates = vec![false; layout.size()];
        layout.states().for_each(|(row, ..)| is_of_rates[row] = true);
        let is_motion = |row: usize| row < count && !is_of_rates[row];
        let structure = system.structure();
        let matrix = Matrix::new((kind.real)(structure), structure);
        let mut saddle = SaddlePoint::new(matrix, count);
        saddle.omit(redundancy.omitted());
        // Elimination without row exchanges does not need it unless constraints are redundant.
        if !redundancy.is_empty() || saddle.matrices.solver.exchanges_rows() {
            saddle = saddle.equilibrated(structure.pattern.size());
        }
        Self {
            saddle,
            redundancy,
            rigid: Known::default(),
            is_rigid: false,
            stiff: system.has_stiff_elements().then(|| StiffParts::new((system, &state.kinematics))),
            scratch: None,
            scale: if representative.mass > 0.0 { representative.mass } else { 1.0 },
            augmentation,
            // Constraints of velocities are not augmented.
            weights: layout.quantities()[count..]
                .iter()
                .enumerate()
                .map(|(k, own)| if layout.is_of_velocities(k) { 0.0 } else { augmentation.relative(*own) })
                .collect(),
            still: vec![MotionChange::none(); state.kinematics.nodes.len()],
            unchanged: vec![0.0; state.kinematics.coordinates.len()],
            zero: vec![0.0; layout.multiplier_count],
            starts: JointStarts::default(),
            between_motions: runs(pattern, (0..count).filter(|&column| is_motion(column)), is_motion),
            of_constraints: runs(pattern, count..pattern.size(), |row| row < count),
            is_of_rates,
        }
    }

    /// Assembles and factors the matrix at these positions; none if it is singular. K is used by `solutions` that follow each other.
    pub(super) fn factor(
        &mut self,
        (system, at): (&System, &Kinematics),
        time: f64,
        solutions: usize,
    ) -> Option<()> {
        system.begin_step(at, &mut self.starts);
        if self.redundancy.follow(system, at) {
            self.saddle.omit(self.redundancy.omitted());
            self.rigid = Known::default();
        }
        let limit = NEGLIGIBLE_FILTER.powf(1.0 / solutions as f64);
        if let Some(stiff) = &mut self.stiff {
            stiff.linearize((system, at), self.scratch.get_or_insert_default());
        }
        self.is_rigid = self.factor_rigid((system, at), (time, limit)).is_some();
        if self.is_rigid {
            return Some(());
        }
        self.assemble((system, at), (time, limit));
        self.saddle.factor(system.structure(), self.scale).ok()?;
        Some(())
    }

    /// Factors the matrix of rigid parts; none if there are others, or stiffness is not negligible.
    fn factor_rigid(&mut self, (system, at): (&System, &Kinematics), limits: (f64, f64)) -> Option<()> {
        let Self { rigid, redundancy, stiff, between_motions: runs, .. } = self;
        // Stiffness between nodes is known before gradients are, and nearly that of joints: whether a run was resumed must not matter.
        let (time, limit) = limits;
        let certain = if rigid.is_some() { CERTAIN * limit } else { limit };
        let is_stiff = |own: &mut StiffParts| own.has_effect_with(runs, (time, certain), std::iter::empty());
        if rigid.has_none(system, at) || stiff.as_mut().is_some_and(is_stiff) {
            return None;
        }
        let rigid = rigid.renewed((system, at), redundancy.omitted())?;
        if let Some(stiff) = stiff {
            let coordinates = rigid.inertias_of_coordinates();
            if stiff.has_effect_with(runs, limits, coordinates) {
                return None;
            }
        }
        rigid.factor()
    }

    fn assemble(&mut self, (system, at): (&System, &Kinematics), (time, limit): (f64, f64)) {
        let (layout, pattern) = (system.layout(), &system.structure().pattern);
        let mut values = std::mem::take(&mut self.saddle.matrices.values);
        let mut scratch = self.scratch.take().unwrap_or_default();
        values.fill(0.0);
        let scale = self.scale;
        system.linearize_elements(false, at, &mut scratch, &mut inertial(scale, &mut values));
        if let Some(stiff) = &mut self.stiff {
            stiff.add(&self.between_motions, (time, limit), &mut values);
        }
        let point = self.point(at, &self.zero);
        system.linearize_constraints(
            &point,
            Chart::Body,
            &mut scratch.joint,
            &mut inertial(scale, &mut values),
        );
        // States have no inertia: a unit diagonal decouples them.
        for (row, ..) in layout.states() {
            if let Some(diagonal) = pattern.position(row, row) {
                values[diagonal] += 1.0;
            }
        }
        self.saddle.matrices.values = values;
        self.scratch = Some(scratch);
    }

    /// Solves in place for motions and multipliers.
    pub(super) fn solve(&mut self, right: &mut [f64]) {
        let count = right.len() - self.zero.len();
        self.redundancy.remove_misfit(&mut right[count..]);
        if let Some(rigid) = self.rigid.matrix().filter(|_| self.is_rigid) {
            rigid.solve(right);
            return;
        }
        right[count..].iter_mut().for_each(|value| *value *= self.scale);
        self.saddle.scale(right);
        let (motions, constraints) = right.split_at_mut(count);
        // The entries of B in the matrix are equilibrated like the right-hand side.
        let factors = self.saddle.row_factors();
        for run in &self.of_constraints {
            let k = run.column - count;
            let factor = factors.map_or(1.0, |factors| factors[run.column]);
            let weighted = self.weights[k] * constraints[k] / (self.scale * factor * factor);
            let entries = &self.saddle.matrices.values[run.position..run.position + run.length];
            for (value, entry) in motions[run.row..run.row + run.length].iter_mut().zip(entries) {
                *value += entry * weighted;
            }
        }
        self.saddle.solve_equilibrated(right);
        self.saddle.scale(right);
        right[count..].iter_mut().for_each(|value| *value *= self.scale);
    }

    /// Whether there are elements that are stiff at these positions.
    pub(super) fn is_stiff(&self) -> bool {
        self.stiff.as_ref().is_some_and(|stiff| stiff.has_effect)
    }

    /// Replaces multipliers by those of least norm that are in equilibrium with the same loads.
    pub(super) fn reduce_to_least_norm(&self, multipliers: &mut [f64]) {
        self.redundancy.reduce_to_least_norm(multipliers);
    }

    /// Whether a solution is accurate to round-off of a correction: the matrix contains no damping, which is not part of the equations
    /// of motion, and no pivot has lost digits.
    pub(super) fn is_exact(&self) -> bool {
        let report = self.saddle.report();
        self.is_rigid
            || !self.stiff.as_ref().is_some_and(StiffParts::has_damping)
                && report.is_some_and(|report| report.worst_cancellation > WELL_CONDITIONED)
    }

    /// out += K x over motions, x by row; equations of rates have no stiffness.
    pub(super) fn add_stiffness_product(&self, x: impl Fn(usize) -> f64, out: &mut [f64]) {
        let Some(StiffParts { derivatives: stiff, .. }) = &self.stiff else { return };
        for run in &self.between_motions {
            let value = x(run.column);
            let entries = &stiff.stiffness[run.position..run.position + run.length];
            for (out, entry) in out[run.row..run.row + run.length].iter_mut().zip(entries) {
                *out += value * entry;
            }
        }
    }

    /// Rates and accelerations of the constraints' violations at the motion `at`, at the positions of the matrix.
    pub(super) fn violation_rates(&self, system: &System, at: &Kinematics, out: [&mut [f64]; 2]) {
        system.violation_rates(at, &self.starts, out);
    }

    /// Left-hand sides of the equations of motion in the coordinate rows; zero in the other rows.
    pub(super) fn residual(&self, system: &System, at: &Kinematics, multipliers: &[f64], out: &mut [f64]) {
        system.residual(&self.point(at, multipliers), out);
        out[system.layout().coordinate_count()..].fill(0.0);
        self.clear_rates(system.layout(), out);
    }

    /// Sets the rows of equations of rates to zero.
    pub(super) fn clear_rates(&self, layout: &Layout, out: &mut [f64]) {
        if layout.state_count() > 0 {
            out.iter_mut().zip(&self.is_of_rates).filter(|(_, is)| **is).for_each(|(value, _)| *value = 0.0);
        }
    }

    fn point<'b>(&'b self, at: &'b Kinematics, multipliers: &'b [f64]) -> Point<'b> {
        Point {
            at,
            stressed: at.into(),
            increments: Increments {
                start: at,
                nodes: &self.still,
                coordinates: &self.unchanged,
                joints: Some(&self.starts),
            },
            multipliers,
            violations: &self.zero,
            augmentation: self.augmentation,
        }
    }
}

/// Adds derivatives with respect to accelerations, and constraints by this scale.
fn inertial(scale: f64, values: &mut [f64]) -> TangentAssembler<'_> {
    let blend = Blend {
        place: 0.0,
        rate: 0.0,
        acceleration: 1.0,
        augmented: scale,
        constraint: scale,
        slip: scale,
        turning: 0.0,
        slip_augmented: 0.0,
    };
    TangentAssembler::Real(Sum { blend, values, stiffness: &mut [] })
}

/// Entries of these columns in the rows for which `is_wanted` is true, as runs of consecutive entries.
fn runs(
    pattern: &Pattern,
    columns: impl Iterator<Item = usize>,
    is_wanted: impl Fn(usize) -> bool,
) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for column in columns {
        let first = pattern.column_starts()[column];
        let mut last: Option<Run> = None;
        for (k, &row) in pattern.column(column).iter().enumerate().filter(|(_, row)| is_wanted(**row)) {
            let position = first + k;
            match &mut last {
                Some(run) if run.row + run.length == row && run.position + run.length == position => {
                    run.length += 1;
                }
                _ => runs.extend(last.replace(Run { column, row, position, length: 1 })),
            }
        }
        runs.extend(last);
    }
    runs
}
