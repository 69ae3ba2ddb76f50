//! Newton's method for both stages of a coupled pair together, each with a linearisation of its own: for steps so
//! long that one tangent does not serve both. With body variations δh of the nodes at stage i, and increments D,
//!
//! ```text
//! δh_i = T(D_i) δD_i,      δV_i = (T δD)'_i + ad_V T δD_i,      (T δD)'_i = Ṫ δD_i + T Σ_k (A⁻¹)_ik δD_k / h
//! ```
//!
//! the row of stage i has K_i δh_i + D_i δV_i + M_i δV̇_i. Strains and violations that are integrated count as if
//! they were evaluated where the stage is. Of a group of unknowns those of the last stage are eliminated first, for
//! the other way round the first pivots would vanish: (A⁻²)₁₁ = 0 for Radau IIA.

use std::ops::Range;
use std::sync::Arc;

use lissom_motion::{Matrix6, Vector6, lie_bracket_matrix, tangent, tangent_rate_times};
use lissom_solver::{
    FactorError, FactorReport, Group, LinearSolver, Pattern, SolverKind, Structure, condition_estimate,
};

use super::equations::{StepEquations, joint_changes};
use super::phase::Phase;
use super::workspace::Workspace;
use crate::elements::passage::{Passage, Variation};
use crate::mechanisms::Mechanism;
use crate::scaling::Scaled;
use crate::schemes::Tableau;
use crate::system::{Chart, Course, LOCKED, Linearization, System};

/// Stages of a pair.
pub(super) const STAGES: usize = 2;
/// Steps with the tangent of both stages after one for which the simplified one did not do, at first, and the most
/// after it has failed again and again.
pub(super) const FIRST_COUPLED: usize = 4;
const MOST_COUPLED: usize = 256;

/// Where an entry of a single stage's pattern stands, by stage of the row and of the column.
type Places = [[usize; STAGES]; STAGES];

/// The tangent of both stages.
pub(crate) struct Coupled {
    single: Arc<Pattern>,
    structure: Structure,
    /// By position in the single pattern.
    pub(super) places: Vec<Places>,
    solver: Box<dyn LinearSolver<f64>>,
    pub(super) values: Vec<f64>,
    right_hand_side: Vec<f64>,
    linearizations: [Linearization; STAGES],
    /// By node; then of an algebraic coordinate, in the first entries.
    pub(super) transports: Vec<[Transport; STAGES]>,
}

/// Variations of a node at a stage by the increments of both stages.
#[derive(Clone, Copy)]
pub(super) struct Transport {
    /// δh by the stage's own increment.
    pub(super) place: Matrix6,
    /// δV and δV̇ by the increments of each stage.
    pub(super) rate: [Matrix6; STAGES],
    acceleration: [Matrix6; STAGES],
}

impl Transport {
    fn none() -> Self {
        let zeros = Matrix6::zeros();
        Self { place: zeros, rate: [zeros; STAGES], acceleration: [zeros; STAGES] }
    }
}

/// A⁻¹/h and A⁻²/h².
#[derive(Clone, Copy)]
struct Weights {
    rate: [[f64; STAGES]; STAGES],
    curvature: [[f64; STAGES]; STAGES],
}

impl Coupled {
    pub(crate) fn new(system: &System, kind: &SolverKind) -> Self {
        let (structure, places) = doubled(system);
        let entries = structure.pattern.entries();
        Self {
            single: system.pattern(),
            places,
            solver: (kind.real)(&structure),
            values: vec![0.0; entries],
            right_hand_side: vec![0.0; structure.pattern.size()],
            linearizations: [Linearization::new(system), Linearization::new(system)],
            transports: vec![[Transport::none(); STAGES]; system.layout().node_count() + 1],
            structure,
        }
    }

    /// Goes on with another solver.
    pub(crate) fn replace_solver(&mut self, kind: &SolverKind) {
        self.solver = (kind.real)(&self.structure);
    }

    /// Factors what has been assembled. Unknowns in the answer are those of a single stage.
    pub(crate) fn factor(&mut self) -> Result<FactorReport, FactorError> {
        let size = self.right_hand_side.len() / STAGES;
        match self.solver.factor(&self.values) {
            Ok(mut report) => {
                report.smallest_pivot_unknown %= size;
                report.worst_cancellation_unknown %= size;
                Ok(report)
            }
            Err(FactorError::ZeroPivot { unknown, pivot, largest }) => {
                Err(FactorError::ZeroPivot { unknown: unknown % size, pivot, largest })
            }
            Err(FactorError::NotFinite { unknown }) => {
                Err(FactorError::NotFinite { unknown: unknown % size })
            }
        }
    }

    /// Solves for the corrections of both stages: residuals in, corrections out.
    pub(crate) fn solve(&mut self, stages: &mut [Vec<f64>]) {
        let size = self.right_hand_side.len() / STAGES;
        for (part, stage) in self.right_hand_side.chunks_exact_mut(size).zip(stages.iter()) {
            part.copy_from_slice(stage);
        }
        self.solver.solve(&mut self.right_hand_side);
        for (part, stage) in self.right_hand_side.chunks_exact(size).zip(stages) {
            stage.copy_from_slice(part);
        }
    }

    /// Estimates the condition number of the tangent factored last, in the 1-norm.
    pub(crate) fn condition_estimate(&mut self) -> f64 {
        condition_estimate(&mut *self.solver, &self.structure.pattern, &self.values)
    }

    /// Assembles what has been linearised; `course` where violations are integrated.
    fn assemble(&mut self, system: &System, scaled: &Scaled, course: Option<(&Course<'_>, &Tableau)>) {
        let layout = system.layout();
        self.values.fill(0.0);
        for (node, rows) in layout.node_rows.iter().enumerate() {
            let mut free = [(0, 0); 6];
            let mut count = 0;
            for (k, &row) in rows.iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
                free[count] = (k, row as usize);
                count += 1;
            }
            self.add_columns(&free[..count], node, scaled);
        }
        for &row in &layout.coordinate_rows {
            self.add_columns(&[(0, row as usize)], layout.node_count(), scaled);
        }
        for column in layout.multiplier_rows() {
            for position in self.positions(column) {
                for stage in 0..STAGES {
                    let value = scaled.scale() * self.linearizations[stage].constraint[position];
                    self.values[self.places[position][stage][stage]] += value;
                }
            }
        }
        if let Some((course, tableau)) = course {
            self.add_constraints(system, course, tableau, scaled);
            self.add_strains(system, course, scaled);
        }
    }

    fn add_strains(&mut self, system: &System, course: &Course<'_>, scaled: &Scaled) {
        let variations: Vec<[Variation; STAGES]> = self
            .transports
            .iter()
            .map(|stages| stages.map(|Transport { place, rate, .. }| Variation { place, rate }))
            .collect();
        let (values, places) = (&mut self.values, &self.places);
        let dynamic = scaled.dynamic_factor();
        system.linearize_integrated(course, &variations, &mut |position, stage, other, value| {
            values[places[position][stage][other]] += dynamic * value;
        });
    }

    /// Positions of a column of the single pattern.
    fn positions(&self, column: usize) -> Range<usize> {
        let starts = self.single.column_starts();
        starts[column]..starts[column + 1]
    }

    /// Adds the columns of one node's free unknowns, given as places in its six and columns. All of them have
    /// the same rows.
    fn add_columns(&mut self, free: &[(usize, usize)], node: usize, scaled: &Scaled) {
        let Some(&(_, first)) = free.first() else { return };
        let dynamic = scaled.dynamic_factor();
        for offset in 0..self.positions(first).len() {
            for stage in 0..STAGES {
                let linearization = &self.linearizations[stage];
                let mut by_place = Vector6::zeros();
                let mut by_rate = Vector6::zeros();
                let mut by_acceleration = Vector6::zeros();
                for &(k, column) in free {
                    let position = self.single.column_starts()[column] + offset;
                    by_place[k] = dynamic * linearization.stiffness[position]
                        + scaled.augmented_factor() * linearization.gram[position]
                        + scaled.scale() * linearization.constraint[position];
                    by_rate[k] = dynamic * linearization.damping[position];
                    by_acceleration[k] = dynamic * linearization.mass[position];
                }
                let transport = &self.transports[node][stage];
                for other in 0..STAGES {
                    let mut row = transport.rate[other].tr_mul(&by_rate)
                        + transport.acceleration[other].tr_mul(&by_acceleration);
                    if other == stage {
                        row += transport.place.tr_mul(&by_place);
                    }
                    for &(k, column) in free {
                        let position = self.single.column_starts()[column] + offset;
                        let place = self.places[position][stage][other];
                        self.values[place] += row[k];
                    }
                }
            }
        }
    }
}

impl Workspace {
    /// Goes over to the tangent of both stages, unless it is in use already.
    pub(super) fn begin_coupling(&mut self, system: &System) -> bool {
        // Constraints that yield do so in the other tangent only.
        if self.coupled_steps > 0 || self.yielding.is_some() || !self.without.has(Mechanism::CoupledTangent) {
            return false;
        }
        if self.coupled.is_none() {
            self.coupled = Some(Box::new(Coupled::new(system, self.solver)));
        }
        self.coupled_steps = self.coupled_next;
        self.coupled_next = (2 * self.coupled_next).min(MOST_COUPLED);
        true
    }

    /// Notes that a step is done, and says whether the tangent of both stages is given up after it.
    pub(crate) fn end_step(&mut self) -> bool {
        let was_coupled = self.coupled_steps > 0;
        self.coupled_steps = self.coupled_steps.saturating_sub(1);
        was_coupled && self.coupled_steps == 0
    }

    /// Estimates the condition number of the tangent factored last, in the 1-norm.
    pub(crate) fn condition_estimate(&mut self, pattern: &lissom_solver::Pattern) -> f64 {
        match &mut self.coupled {
            Some(coupled) if self.coupled_steps > 0 => coupled.condition_estimate(),
            _ => self.factorization.condition_estimate(pattern),
        }
    }
}

impl StepEquations<'_> {
    /// The step as those see it whose strains and violations are integrated.
    pub(super) fn course(&self, tableau: &Tableau) -> Option<Course<'_>> {
        let work = &*self.work;
        let [first, second, end] = &work.motions[..] else { return None };
        let (durations, lasting) = self.scaled.durations(tableau);
        let start = &self.start.kinematics;
        Some(Course {
            passage: Passage {
                start,
                stages: [&first.at, &second.at],
                end: &end.at,
                changes: &end.changes,
                durations,
                lasting,
                reached: tableau.reached,
                length: work.length,
            },
            increments: [first, second, end].map(|motion| joint_changes(start, motion, &work.joint_starts)),
            multipliers: [&work.multipliers[0], &work.multipliers[1]],
            violations: &self.start.violations,
            augmentation: self.scaled.augmentation(),
        })
    }

    /// Linearises and factors the tangent of both stages.
    pub(super) fn renew_coupled_tangent(&mut self, coupled: &mut Coupled) -> Result<(), FactorError> {
        self.watch.begin(Phase::Linearisation);
        self.linearize_coupled(coupled);
        self.watch.begin(Phase::Factorisation);
        let mut result = coupled.factor();
        if let Err(FactorError::ZeroPivot { unknown, pivot, .. }) = result
            && let Some(kind) = self.work.fall_back
        {
            self.work.fell_back = Some((unknown, pivot));
            coupled.replace_solver(kind);
            result = coupled.factor();
        }
        self.work.report = Some(result?);
        self.watch.begin(Phase::Rest);
        Ok(())
    }

    /// Linearises both stages, each at its own place.
    pub(super) fn linearize_coupled(&self, coupled: &mut Coupled) {
        let start = &self.start.kinematics;
        let tableau = self.scheme.tableau.as_ref();
        let course = tableau.and_then(|tableau| Some((self.course(tableau)?, tableau)));
        let course = course.as_ref().map(|(course, tableau)| (course, *tableau));
        for (stage, linearization) in coupled.linearizations.iter_mut().enumerate() {
            if let Some((course, _)) = course {
                let stressed = self.is_far().then_some(start);
                self.system.linearize_stage(course, stage, stressed, linearization);
            } else {
                let mut point = self.point(stage);
                if self.is_far() {
                    point.stressed = start;
                }
                self.system.linearize(&point, Chart::Body, linearization);
            }
        }
        let step = self.scaled.step_size();
        let of = |stage: usize, power: &dyn Fn(&crate::schemes::Stage) -> [f64; STAGES], scale: f64| {
            power(&self.scheme.stages[stage]).map(|weight| weight / scale)
        };
        let weights = Weights {
            rate: [0, 1].map(|stage| of(stage, &|stage| stage.rate.increments, step)),
            curvature: [0, 1].map(|stage| of(stage, &|stage| stage.curvature.increments, step * step)),
        };
        let identity = Matrix6::identity();
        let layout = self.system.layout();
        for (node, rows) in layout.node_rows.iter().enumerate() {
            coupled.transports[node] = self.transports(rows, node, weights);
        }
        coupled.transports[layout.node_count()] = [0, 1].map(|stage| Transport {
            place: identity,
            rate: weights.rate[stage].map(|weight| weight * identity),
            acceleration: weights.curvature[stage].map(|weight| weight * identity),
        });
        coupled.assemble(self.system, &self.scaled, course);
    }

    fn transports(&self, rows: &[u32; 6], node: usize, weights: Weights) -> [Transport; STAGES] {
        let step = self.scaled.step_size();
        let mut charts = [Matrix6::zeros(); STAGES];
        // Ṫ, and ad_V T, at each stage.
        let mut turning = [Matrix6::zeros(); STAGES];
        let mut seen = [Matrix6::zeros(); STAGES];
        let mut falling = [Matrix6::zeros(); STAGES];
        for stage in 0..STAGES {
            let mut psi = Vector6::zeros();
            let mut rate = Vector6::zeros();
            for (k, &row) in rows.iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
                let row = row as usize;
                psi[k] = self.work.increments[stage][row];
                let combination = &self.scheme.stages[stage].rate;
                rate[k] = self.work.unit.combine(combination, &self.work.increments, row) / step;
            }
            let at = &self.work.motions[stage].at.nodes[node];
            charts[stage] = tangent(&psi);
            turning[stage] = Matrix6::from_columns(&std::array::from_fn::<_, 6, _>(|k| {
                tangent_rate_times(&psi, &rate, &Matrix6::identity().column(k).into_owned())
            }));
            seen[stage] = lie_bracket_matrix(&at.twist) * charts[stage];
            falling[stage] = lie_bracket_matrix(&at.acceleration) * charts[stage];
        }
        let rate: [[Matrix6; STAGES]; STAGES] = std::array::from_fn(|i| {
            std::array::from_fn(|k| {
                let own = if i == k { turning[i] + seen[i] } else { Matrix6::zeros() };
                own + weights.rate[i][k] * charts[i]
            })
        });
        std::array::from_fn(|i| Transport {
            place: charts[i],
            rate: rate[i],
            acceleration: std::array::from_fn(|k| {
                if self.scheme.tableau.is_some() {
                    // h δV̇_i = Σ_j (A⁻¹)_ij δV_j
                    return weights.rate[i][0] * rate[0][k] + weights.rate[i][1] * rate[1][k];
                }
                let own = if i == k { falling[i] } else { Matrix6::zeros() };
                own + weights.curvature[i][k] * charts[i] + weights.rate[i][k] * (2.0 * turning[i] + seen[i])
            }),
        })
    }
}

/// Structure of both stages, and where the entries of the single pattern stand in it.
fn doubled(system: &System) -> (Structure, Vec<Places>) {
    let single = system.pattern();
    let (size, count) = (system.layout().size(), system.layout().coordinate_count());
    let pairs = || (0..STAGES).flat_map(|stage| (0..STAGES).map(move |other| (stage, other)));
    let mut entries = Vec::new();
    for column in 0..size {
        for &row in single.column(column) {
            entries.extend(pairs().map(|(stage, other)| (stage * size + row, other * size + column)));
        }
    }
    let pattern = Arc::new(Pattern::from_entries(STAGES * size, entries));
    let mut places = Vec::with_capacity(single.entries());
    for column in 0..size {
        for &row in single.column(column) {
            places.push(std::array::from_fn(|stage| {
                std::array::from_fn(|other| {
                    pattern
                        .position(stage * size + row, other * size + column)
                        .expect("the pattern was made from these entries")
                })
            }));
        }
    }
    let groups = system.structure().groups.iter().map(|group| {
        let (own, multipliers): (Vec<usize>, Vec<usize>) =
            group.unknowns.iter().partition(|&&unknown| unknown < count);
        let both = |rows: &[usize]| -> Vec<usize> {
            rows.iter().map(|row| row + size).chain(rows.iter().copied()).collect()
        };
        Group { unknowns: [both(&own), both(&multipliers)].concat(), hosts: group.hosts.clone() }
    });
    let groups = groups.collect();
    (Structure { pattern, groups }, places)
}
