//! Nonlinear equations of one step for Newton's method.

use std::f64::consts::PI;

use lissom_motion::Vector6;
use lissom_solver::{FactorError, FactorReport};

use super::corrections::{Add, Measure, Multiply};
use super::workspace::{EvaluationSpace, Workspace};
use crate::iterate;
use crate::joints::derivatives::IncrementTangent;
use crate::joints::evaluation_point::{self, Chart, Point};
use crate::joints::starts::JointStarts;
use crate::kinematics::step_stages::StepStages;
use crate::kinematics::{Kinematics, LOCKED, NodeId, Quantity, Stressed, Subject};
use crate::newton::{Correction, Equations, Failure};
use crate::round_off;
use crate::saddle_point::{REDUNDANT, TangentValues};
use crate::scaling::{Representative, Scaled, ScalingChoice, StageIncrements, StageMotion, state_rows};
use crate::schemes::{MAX_STAGES, Parametrization, Scheme, Stage, Tableau};
use crate::settings::{Phase, Stopwatch};
use crate::solver_features::SolverFeature;
use crate::spin::{Axes, Spins};
use crate::system::{State, StepPoint, System, TangentAssembler};

/// Iterates with a last correction above this, of the representative length or of a longer predicted increment, are far from equilibrium [-].
pub(crate) const FAR_FROM_EQUILIBRIUM: f64 = 1e-3;
/// Smallest reference of increments, relative to the drift, for the convergence of first-order states [-].
const MIN_DEPARTURE: f64 = 1e-5;
/// Condition number of an equilibrated tangent above which it is singular except for round-off.
const SINGULAR: f64 = 1e13;

/// Largest number of decoupled systems: pairs of stages, and one real system.
const MAX_SYSTEMS: usize = MAX_STAGES.div_ceil(2);

/// One step from `start`.
pub(crate) struct StepEquations<'a> {
    pub(crate) system: &'a System,
    pub(crate) scheme: &'a Scheme,
    pub(crate) scaled: Scaled,
    /// Inputs of the scaling of a new tangent.
    pub(crate) scaling: (&'a ScalingChoice, &'a Representative),
    pub(crate) start: &'a State,
    pub(crate) work: &'a mut Workspace,
    pub(crate) watch: &'a mut dyn Stopwatch,
}

impl StepEquations<'_> {
    /// Predicts the increments by the scheme, improved by the error history if extrapolation was requested.
    pub(crate) fn predict(&mut self) {
        let work = &mut *self.work;
        work.newton.correction = f64::INFINITY;
        let extrapolates = std::mem::take(&mut work.prediction.extrapolates);
        for (i, stage) in self.scheme.stages.iter().enumerate() {
            work.unit.predict(&stage.prediction, &mut work.increments[i]);
            work.multipliers[i].copy_from_slice(&self.start.multipliers);
        }
        if extrapolates && work.options.disabled.allows(SolverFeature::Prediction) {
            let [of_increments, _] = &work.prediction.predictors;
            of_increments.improve(&mut work.increments);
            self.turn_multipliers(|_| Axes::Body(0.0), |_| Axes::Still);
            let work = &mut *self.work;
            let [_, of_multipliers] = &work.prediction.predictors;
            of_multipliers.improve(&mut work.multipliers);
            self.turn_multipliers(|_| Axes::Still, Axes::Body);
        } else {
            self.turn_multipliers(|_| Axes::Body(0.0), Axes::Body);
        }
        self.update_motions();
    }

    /// Computes the motions at all stages from the increments.
    pub(crate) fn update_motions(&mut self) {
        self.watch.begin(Phase::Evaluation);
        let layout = self.system.layout();
        let last = self.scheme.stages.len() - 1;
        let Workspace { motions, evaluation, .. } = &mut *self.work;
        if let Some(previous) = &mut evaluation.previous {
            previous.nodes.copy_from_slice(&motions[last].at.nodes);
        }
        for i in 0..=last {
            let increments = StageIncrements { all: &self.work.increments, stage: i };
            self.scaled.stage_motion(
                layout,
                self.scheme,
                self.start,
                &self.work.unit,
                &increments,
                &mut self.work.motions[i],
            );
        }
        // The motion after the last stage is the end of the step; it has the multipliers of the last stage.
        let Workspace { motions, multipliers, .. } = &mut *self.work;
        for (i, motion) in motions.iter_mut().enumerate() {
            motion.at.show_multipliers(&multipliers[i.min(multipliers.len() - 1)]);
        }
        if let Some(tableau) = &self.scheme.tableau {
            let work = &mut *self.work;
            self.scaled.integrate_velocities(
                layout,
                tableau,
                self.start,
                &work.increments,
                &mut work.motions,
            );
        }
        self.watch.begin(Phase::Rest);
    }

    /// Evaluation point of the whole step, for elements and joints whose strains and violations are integrated.
    pub(crate) fn step_point(&self, tableau: &Tableau) -> Option<StepPoint<'_>> {
        let work = &*self.work;
        let [first, second, end] = &work.motions[..] else { return None };
        let (durations, lasting) = self.scaled.durations(tableau);
        let start = &self.start.kinematics;
        Some(StepPoint {
            step: StepStages {
                start,
                stages: [&first.at, &second.at],
                end: &end.at,
                changes: &end.changes,
                durations,
                lasting,
                reached: tableau.reached,
                length: work.units.length,
            },
            increments: [first, second, end]
                .map(|motion| joint_changes(start, motion, &work.evaluation.joint_starts)),
            multipliers: [&work.multipliers[0], &work.multipliers[1]],
            violations: &self.start.violations,
            augmentation: self.scaled.augmentation(),
        })
    }

    pub(crate) fn point(&self, stage: usize) -> Point<'_> {
        let work = &*self.work;
        let motion = &work.motions[stage];
        Point {
            at: &motion.at,
            stressed: Stressed { at: &motion.at, previous: work.evaluation.previous.as_ref() },
            increments: joint_changes(&self.start.kinematics, motion, &work.evaluation.joint_starts),
            multipliers: &work.multipliers[stage],
            violations: &self.start.violations,
            augmentation: self.scaled.augmentation(),
        }
    }

    /// Constraint violations at the end of the step, from the final increments.
    pub(crate) fn final_violations(&self, out: &mut [f64]) {
        let last = self.scheme.stages.len() - 1;
        let mut point = self.point(last);
        if let Some(end) = self.work.motions.last() {
            point.at = &end.at;
            point.increments = joint_changes(&self.start.kinematics, end, &self.work.evaluation.joint_starts);
        }
        self.system.stage_violations(&point, out);
    }

    /// Residuals of all stages, in SI.
    pub(crate) fn evaluate(&mut self) {
        if let Some(tableau) = &self.scheme.tableau {
            let mut residuals = std::mem::take(&mut self.work.residuals);
            if let Some(point) = self.step_point(tableau) {
                self.system.step_residuals(&point, &mut residuals);
            }
            self.work.residuals = residuals;
            return;
        }
        for stage in 0..self.scheme.stages.len() {
            let mut residual = std::mem::take(&mut self.work.residuals[stage]);
            let mut threads = self.work.evaluation.threads.take();
            match &mut threads {
                Some(threads) => {
                    self.system.residual_side_by_side(&self.point(stage), threads, &mut residual);
                }
                None => self.system.residual(&self.point(stage), &mut residual),
            }
            self.work.evaluation.threads = threads;
            self.work.residuals[stage] = residual;
        }
    }

    /// Round-off of forces [N]: that of positions times the largest stiffness, since strains are computed from positions.
    fn force_round_off(&self) -> f64 {
        let layout = self.system.layout();
        let stiffness = (0..layout.coordinate_count())
            .filter(|&row| layout.quantities()[row] == Quantity::Length)
            .fold(0.0_f64, |most, row| most.max(self.work.round_off.stiffness[row].abs()));
        let nodes = &self.start.kinematics.nodes;
        let far = nodes.iter().fold(0.0_f64, |most, node| most.max(node.frame.position.amax()));
        round_off::OPERATIONS * far * stiffness
    }

    /// Linearises at the last stage: stores the tangent values of all decoupled systems, before equilibration.
    pub(crate) fn linearize(&mut self) {
        let mut stiffness = std::mem::take(&mut self.work.round_off.stiffness);
        let scheme = self.scheme;
        let systems = &scheme.coupling.systems;
        let take = |index: usize| match systems.get(index) {
            Some(_) => self.work.tangent.matrices.take_values(index),
            None => TangentValues::Real(Vec::new()),
        };
        let mut values: [TangentValues; MAX_SYSTEMS] = std::array::from_fn(take);
        let scaled = self.scaled;
        let mut pairs = values.iter_mut().zip(systems);
        // The first one receives the stiffness, too.
        let mut stiffness_once = &mut stiffness[..];
        let mut receivers: [TangentAssembler<'_>; MAX_SYSTEMS] =
            std::array::from_fn(|_| match pairs.next() {
                Some((own, system)) => own.receiver(&scaled, system, std::mem::take(&mut stiffness_once)),
                None => TangentAssembler::Each(&mut []),
            });
        self.assemble_tangent(&mut TangentAssembler::Each(&mut receivers));
        if self.corrects_at_iterate()
            && self.is_far()
            && let Some(TangentValues::Real(values)) = values.first_mut()
        {
            let pattern = &self.system.structure().pattern;
            iterate::hold_unbalanced_forces(self.system.layout(), pattern, values);
        }
        for (index, own) in values.into_iter().enumerate().take(systems.len()) {
            self.work.tangent.matrices.set_values(index, own);
        }
        self.work.round_off.stiffness = stiffness;
    }

    /// Passes the derivatives at the last stage to `out`.
    pub(crate) fn assemble_tangent(&mut self, out: &mut TangentAssembler<'_>) {
        let last = self.scheme.stages.len() - 1;
        let mut scratch = self.work.evaluation.scratch.take().unwrap_or_default();
        let mut tangents = std::mem::take(&mut self.work.evaluation.node_tangents);
        let mut drifts = std::mem::take(&mut self.work.evaluation.drifts);
        let time = self.scheme.stages[last].abscissa * self.scaled.step_size();
        self.work.unit.spins.write_drifts(time, &mut drifts);
        let chart = match self.scheme.parametrization {
            _ if self.corrects_at_iterate() => Chart::Body,
            Parametrization::FromStart | Parametrization::Inertial => {
                self.whole_increments(last, &mut tangents);
                Chart::Increments(&tangents)
            }
            Parametrization::RelativeToDrift => Chart::RelativeToDrift(&self.start.kinematics.nodes, &drifts),
        };
        let mut point = self.point(last);
        if self.is_far() {
            point.stressed.at = &self.start.kinematics;
        }
        // The initial guess is no correction.
        if self.work.newton.correction == f64::INFINITY {
            point.stressed.previous = None;
        }
        self.system.assemble_tangent(&point, chart, &mut scratch, out);
        self.work.evaluation.node_tangents = tangents;
        self.work.evaluation.drifts = drifts;
        self.work.evaluation.scratch = Some(scratch);
    }

    /// Removes what redundant and dependent equations cannot satisfy from the residuals.
    pub(super) fn omit_redundant(&mut self) {
        let work = &mut *self.work;
        let count = work.units.coordinates.len();
        for residual in &mut work.residuals {
            work.redundancy.remove_misfit(&mut residual[count..]);
            work.tangent.omitted().iter().for_each(|&row| residual[row] = 0.0);
        }
        let factor = self.scaled.multiplier_factor() * self.scaled.scale();
        for (residual, multipliers) in work.residuals.iter_mut().zip(&work.multipliers) {
            for (row, compliance) in work.tangent.compliances(self.scaled.scale()) {
                residual[row] -= compliance * multipliers[row - count] / factor;
            }
        }
    }

    /// Turns multipliers of rotors from one kind of axes to another, at the time of each stage after the start [s].
    fn turn_multipliers(&mut self, from: impl Fn(f64) -> Axes, to: impl Fn(f64) -> Axes) {
        let Workspace { unit, multipliers, .. } = &mut *self.work;
        let stages = (self.scheme, self.scaled.step_size());
        at_stages(&unit.spins, stages, multipliers, |spins, multipliers, time| {
            spins.turn_multipliers(multipliers, [from(time), to(time)]);
        });
    }

    /// Turns residuals or corrections of rotors likewise.
    fn turn_residuals(&mut self, from: impl Fn(f64) -> Axes, to: impl Fn(f64) -> Axes) {
        let Workspace { unit, residuals, .. } = &mut *self.work;
        let stages = (self.scheme, self.scaled.step_size());
        at_stages(&unit.spins, stages, residuals, |spins, residual, time| {
            spins.turn(residual, [from(time), to(time)]);
        });
    }

    /// Replaces residuals in SI by corrections, of rotors in axes that do not spin.
    pub(super) fn solve_for_corrections(&mut self) {
        self.turn_residuals(Axes::Body, |_| Axes::Tangent);
        let work = &mut *self.work;
        for values in &mut work.residuals {
            work.evaluation.processor.dispatch(Multiply { values, factors: &work.units.rows });
        }
        self.watch.begin(Phase::Solve);
        work.tangent.matrices.solve(&self.scheme.coupling, &mut work.residuals);
        self.watch.begin(Phase::Rest);
        if let Some(factors) = work.tangent.row_factors() {
            for values in &mut work.residuals {
                work.evaluation.processor.dispatch(Multiply { values, factors });
            }
        }
        self.turn_residuals(|_| Axes::Tangent, |_| Axes::Still);
    }

    /// Turns corrections of multipliers of rotors into the axes of the stages.
    fn turn_corrections(&mut self) {
        let count = self.system.layout().coordinate_count();
        let Workspace { unit, residuals, .. } = &mut *self.work;
        let stages = (self.scheme, self.scaled.step_size());
        at_stages(&unit.spins, stages, residuals, |spins, corrections, time| {
            spins.turn_multipliers(&mut corrections[count..], [Axes::Still, Axes::Body(time)]);
        });
    }

    /// Whether corrections move the nodes of the iterate along their axes, see [`iterate`], instead of being added to their increments.
    fn corrects_at_iterate(&self) -> bool {
        self.work.evaluation.previous.is_some() && !self.scheme.dynamic
    }

    /// Whether the iterate is far from equilibrium.
    pub(crate) fn is_far(&self) -> bool {
        self.work.newton.correction > FAR_FROM_EQUILIBRIUM
            && self.work.options.disabled.allows(SolverFeature::StartStresses)
    }

    /// Tangent operators of the nodes' total increments since the start of the step, drift included.
    fn whole_increments(&self, stage: usize, nodes: &mut [IncrementTangent]) {
        let work = &*self.work;
        let straight = if self.scheme.dynamic { self.scheme.stages[stage].abscissa } else { 0.0 };
        for (rows, tangent) in self.system.layout().node_rows.iter().zip(nodes) {
            let mut psi = Vector6::zeros();
            for (k, &row) in rows.iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
                let row = row as usize;
                psi[k] = straight * work.unit.velocity[row] + work.increments[stage][row];
            }
            *tangent = match self.scheme.parametrization {
                Parametrization::Inertial => IncrementTangent::inertial(&psi),
                _ => IncrementTangent::new(&psi),
            };
        }
    }

    /// Applies the corrections. Positions are measured by the largest scaled correction; multipliers by their largest correction
    /// relative to the largest multiplier, in the same units, because they may still change after the positions have converged.
    fn add_corrections(&mut self) -> Correction {
        let places = self.measure_places();
        if self.work.newton.correction.is_infinite() {
            // A free flight of many representative lengths, as predicted, has corrections of that size.
            self.work.newton.reach = places.reference.max(1.0);
        }
        let largest = self.work.newton.reach;
        // Corrections of positions below their round-off change no force: two in a row leave multipliers to the round-off of stiff strains,
        // which is large beside the reactions of a thin shell at rest.
        let at_rest = places.size.max(self.work.newton.correction * largest) < f64::EPSILON;
        let at_rest = at_rest && self.work.evaluation.previous.is_some();
        self.work.newton.correction = places.size / largest;
        if !places.size.is_finite() {
            return places;
        }
        // Larger corrections of rotations are scaled down to a radian, and displacements with them; with stresses that are predicted over
        // the correction, to half a turn.
        let most = if self.work.evaluation.previous.is_some() { PI * largest } else { largest };
        if places.size > most {
            self.work.newton.anderson.interrupt();
            let cut = most / places.size;
            self.work.residuals.iter_mut().flatten().for_each(|value| *value *= cut);
        }
        let corrections = std::mem::take(&mut self.work.residuals);
        self.apply(&corrections, -1.0);
        self.work.residuals = corrections;
        let (mut change, mut largest) = (0.0_f64, 0.0_f64);
        let work = &*self.work;
        for (corrections, multipliers) in work.residuals.iter().zip(&work.multipliers) {
            let Correction { size, reference } = work.evaluation.processor.dispatch(Measure {
                sizes: &work.units.multipliers,
                corrections: &corrections[work.units.coordinates.len()..],
                increments: multipliers,
            });
            change = change.max(self.scaled.multiplier_factor() * size);
            largest = largest.max(reference);
        }
        let Correction { size, reference } = places;
        // Without loads, for example before the arrival of the first wave or in free flight, multipliers are only round-off: of
        // strains, and of the forces that accelerate the masses.
        let inertial = self.scaled.multiplier_factor() * reference * self.scaling.1.length;
        let round_off = work.round_off.force.max(self.roundings() * f64::EPSILON * inertial);
        let is_known = largest > 0.0 && change > round_off;
        let multipliers = if is_known { change / largest * reference } else { 0.0 };
        // Relative increments at joints are rounded like the whole displacement in the step, to which accelerations contribute.
        let is_travel = multipliers > size && change <= self.travel_round_off();
        let multipliers = if is_travel || at_rest { 0.0 } else { multipliers };
        self.with_states(Correction { size: size.max(multipliers), reference })
    }

    /// Round-off of multipliers from the drift of the parts in the step.
    fn travel_round_off(&mut self) -> f64 {
        let round_off = self.work.round_off.travel.unwrap_or_else(|| self.round_off_of_travel());
        self.work.round_off.travel = Some(round_off);
        round_off * self.scaled.multiplier_factor() * self.scaling.1.length
    }

    /// Scaled round-off of displacements from the drift of the parts in the step.
    fn round_off_of_travel(&self) -> f64 {
        let work = &*self.work;
        let travel = work
            .units
            .coordinates
            .iter()
            .zip(&work.unit.velocity)
            .fold(0.0_f64, |most, (size, rate)| most.max((size * rate).abs()));
        self.roundings() * f64::EPSILON * travel
    }

    /// Accumulated round-off factor of an acceleration: the sum of the weights of the increments.
    fn roundings(&self) -> f64 {
        let weights =
            |stage: &Stage| stage.acceleration.increments.iter().map(|weight| weight.abs()).sum::<f64>();
        self.scheme.stages.iter().map(weights).fold(round_off::OPERATIONS / f64::EPSILON, f64::max)
    }

    /// Extends the convergence measure to first-order states: corrections relative to the increment of the state in the step, scaled
    /// to the reference of the positions.
    fn with_states(&self, places: Correction) -> Correction {
        let layout = self.system.layout();
        if layout.state_count() == 0 {
            return places;
        }
        let least = MIN_DEPARTURE;
        let reference = places.reference.max(least);
        let mut size = places.size;
        for (row, coordinate, magnitude) in layout.states() {
            let magnitude = magnitude.max(self.start.kinematics.coordinates[coordinate].value.abs());
            let of = |stages: &[Vec<f64>]| {
                stages.iter().fold(0.0_f64, |most, values| most.max(values[row].abs())) / magnitude
            };
            let departure = of(&self.work.increments).max(least);
            size = size.max(of(&self.work.residuals) / departure * reference);
        }
        Correction { size, reference }
    }

    /// Adds the corrections of all stages times `share`.
    pub(super) fn apply(&mut self, corrections: &[Vec<f64>], share: f64) {
        let factor = self.scaled.multiplier_factor();
        let at_iterate = self.corrects_at_iterate();
        let Workspace {
            increments,
            multipliers,
            evaluation: EvaluationSpace { processor, .. },
            units,
            redundancy,
            ..
        } = &mut *self.work;
        for (stage, corrections) in corrections.iter().enumerate() {
            let (motion, constraints) = corrections.split_at(units.coordinates.len());
            let increments = &mut increments[stage];
            if at_iterate {
                iterate::subtract_corrections(self.system.layout(), (motion, -share), increments);
            } else {
                processor.dispatch(Add { share, corrections: motion, values: increments });
            }
            processor.dispatch(Add {
                share: share * factor,
                corrections: constraints,
                values: &mut multipliers[stage],
            });
            redundancy.reduce_to_least_norm(&mut multipliers[stage]);
        }
    }

    pub(super) fn measure_places(&self) -> Correction {
        let work = &*self.work;
        let mut largest = Correction { size: 0.0, reference: 0.0 };
        for (corrections, increments) in work.residuals.iter().zip(&work.increments) {
            let sizes = &work.units.coordinates;
            let corrections = &corrections[..sizes.len()];
            let found = work.evaluation.processor.dispatch(Measure { sizes, corrections, increments });
            if found.size.is_nan() {
                return found;
            }
            largest.size = largest.size.max(found.size);
            largest.reference = largest.reference.max(found.reference);
        }
        largest
    }

    /// Stores the scaling of the tangent in use.
    pub(super) fn note_scales(&mut self) {
        self.work.note_scales(self.system.layout(), &self.scaled);
    }

    /// Replaces a failure after a fallback to the pivoting solver by the vanished pivot that caused the fallback.
    pub(crate) fn unforgiven(&self, failure: Failure) -> Failure {
        match self.work.tangent.fell_back() {
            Some((unknown, pivot)) if failure != Failure::Interrupted => {
                Failure::Factor(FactorError::ZeroPivot { unknown, pivot, largest: f64::NAN })
            }
            _ => failure,
        }
    }

    /// Whether an unknown is a multiplier whose equation does not depend on others at the last iterate.
    pub(crate) fn is_independent(&self, unknown: usize) -> bool {
        let (work, count) = (&*self.work, self.system.layout().coordinate_count());
        let at = &work.motions[self.scheme.stages.len() - 1].at;
        unknown >= count && !work.redundancy.is_dependent(self.system, at, unknown - count)
    }

    /// Rejects a stiffness that is singular except for round-off because an elastic solid can move freely: no pivot vanishes exactly. Lines
    /// and sheets without tension are singular, too, and find their equilibrium.
    fn check_resistance(&mut self, report: &FactorReport) -> Result<(), FactorError> {
        let tangent = &mut self.work.tangent;
        let (unknown, pivot) =
            tangent.fell_back().unwrap_or((report.worst_cancellation_unknown, report.smallest_pivot));
        let layout = self.system.layout();
        let is_there = |node: &NodeId| {
            let rows = layout.rows_of_node(*node);
            rows[3..].iter().all(|row| *row == LOCKED) && rows[..3].iter().any(|row| *row as usize == unknown)
        };
        let is_of_solid = || {
            let mut elements = self.system.elements_with(|own| own.deformation);
            elements.any(|element| element.unknowns().nodes.iter().any(is_there))
        };
        if report.worst_cancellation < REDUNDANT
            && is_of_solid()
            && tangent.matrices.condition_estimate(&self.system.structure().pattern, &state_rows(layout))
                > SINGULAR
        {
            return Err(FactorError::ZeroPivot { unknown, pivot, largest: report.largest_diagonal });
        }
        Ok(())
    }

    /// First signal or function of a load that is not finite at the last iterate, if any.
    pub(crate) fn signal_error(&self) -> Option<crate::signals::SignalError> {
        self.work.motions.iter().find_map(|motion| self.system.check_functions(&motion.at).err())
    }

    /// Name of the unknown with the largest entry in the last corrections, or the first that is not finite.
    pub(crate) fn worst_unknown(&self) -> Subject {
        let layout = self.system.layout();
        let corrections = self.work.residuals.iter().flat_map(|residual| {
            residual[..layout.coordinate_count()]
                .iter()
                .enumerate()
                .map(|(row, value)| (row, self.work.units.coordinates[row] * value.abs()))
        });
        let mut worst = (0, -1.0);
        // States are measured relative to their own increments, as in `with_states`.
        let least = MIN_DEPARTURE;
        let states: Vec<(usize, f64)> = layout
            .states()
            .map(|(row, coordinate, magnitude)| {
                let magnitude = magnitude.max(self.start.kinematics.coordinates[coordinate].value.abs());
                let of = |stages: &[Vec<f64>]| {
                    stages.iter().fold(0.0_f64, |most, values| most.max(values[row].abs())) / magnitude
                };
                (row, of(&self.work.residuals) / of(&self.work.increments).max(least))
            })
            .collect();
        let is_state = |row: usize| states.iter().any(|(state, _)| *state == row);
        let corrections = corrections.filter(|(row, _)| !is_state(*row)).chain(states.iter().copied());
        for (row, size) in corrections {
            if !size.is_finite() {
                return layout.subject_of(row);
            }
            if size > worst.1 {
                worst = (row, size);
            }
        }
        layout.subject_of(worst.0)
    }
}

impl Equations for StepEquations<'_> {
    fn correct(&mut self) -> Correction {
        self.work.newton.effort.iterations += 1;
        if !std::mem::take(&mut self.work.newton.backed_off) {
            std::mem::swap(&mut self.work.residuals, &mut self.work.newton.before);
        }
        self.watch.begin(Phase::Evaluation);
        self.evaluate();
        self.watch.begin(Phase::Rest);
        self.omit_redundant();
        self.solve_for_corrections();
        let work = &mut *self.work;
        if work.options.disabled.allows(SolverFeature::Secants) {
            work.newton.anderson.improve(&mut work.residuals, &work.options.tuning);
        }
        self.turn_corrections();
        self.watch.begin(Phase::Rest);
        let correction = self.add_corrections();
        self.update_motions();
        correction
    }

    fn renew_tangent(&mut self) -> Result<(), FactorError> {
        self.work.newton.effort.factorizations += 1;
        let (choice, representative) = self.scaling;
        self.scaled = Scaled::new(choice, representative, self.scaled.step_size());
        self.watch.begin(Phase::Linearisation);
        self.work.newton.anderson.forget();
        self.linearize();
        let step = self.scaled.step_size();
        let Workspace { redundancy, tangent, motions, unit, .. } = &mut *self.work;
        unit.spins.note_tangent(self.scheme.stages.last().map_or(0.0, |stage| stage.abscissa * step));
        if let Some(reached) = motions.get(self.scheme.stages.len() - 1)
            && redundancy.follow_iterate(self.system, &reached.at)
        {
            tangent.omit(redundancy.omitted());
            unit.spins.omit(redundancy.omitted());
        }
        self.work.round_off.force = self.force_round_off();
        self.watch.begin(Phase::Factorisation);
        let Workspace { redundancy, tangent, motions, .. } = &mut *self.work;
        let (system, count) = (self.system, self.system.layout().coordinate_count());
        let reached = &motions[self.scheme.stages.len() - 1].at;
        let mut is_dependent = |unknown: usize| redundancy.is_dependent(system, reached, unknown - count);
        let report = tangent.renew(system.structure(), self.scaled.scale(), &mut is_dependent)?;
        if !self.scheme.dynamic {
            self.check_resistance(&report)?;
        }
        self.note_scales();
        self.watch.begin(Phase::Rest);
        Ok(())
    }

    fn restart(&mut self) {
        self.work.newton.anderson.interrupt();
        self.predict();
    }

    fn leads_elsewhere(&self) -> bool {
        self.work.evaluation.previous.is_some() && self.is_far()
    }

    fn is_wanted_exactly(&self) -> bool {
        self.scheme.tableau.is_some()
    }

    fn round_off(&self) -> f64 {
        self.round_off_of_travel()
    }

    fn back_off(&mut self) {
        self.work.newton.anderson.forget();
        let last = std::mem::take(&mut self.work.residuals);
        let mut before = std::mem::take(&mut self.work.newton.before);
        // A correction that is not finite was not applied.
        if last.iter().flatten().all(|value| value.is_finite()) {
            self.apply(&last, 1.0);
        }
        self.apply(&before, 0.5);
        for value in before.iter_mut().flatten() {
            *value *= 0.5;
        }
        self.work.residuals = last;
        self.work.newton.before = before;
        self.work.newton.backed_off = true;
        self.update_motions();
    }
}

/// Passes the values of every stage with its time after the start [s], if there are rotors.
fn at_stages(
    spins: &Spins,
    (scheme, step): (&Scheme, f64),
    values: &mut [Vec<f64>],
    turn: impl Fn(&Spins, &mut [f64], f64),
) {
    if spins.is_empty() {
        return;
    }
    for (stage, values) in scheme.stages.iter().zip(values) {
        turn(spins, values, stage.abscissa * step);
    }
}

/// Increments at a stage as used by joints.
pub(crate) fn joint_changes<'a>(
    start: &'a Kinematics,
    motion: &'a StageMotion,
    joints: &'a JointStarts,
) -> evaluation_point::Increments<'a> {
    let StageMotion { changes, coordinate_changes, .. } = motion;
    evaluation_point::Increments {
        start,
        nodes: changes,
        coordinates: coordinate_changes,
        joints: Some(joints),
    }
}
