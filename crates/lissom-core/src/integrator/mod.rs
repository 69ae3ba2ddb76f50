//! Solves steps: from a state and a step size to the state at the end of the step. It neither chooses the size nor accepts
//! the result.

pub(crate) mod anderson;
mod attempt;
mod contacts;
mod corrections;
mod defect;
pub(crate) mod dense;
mod descent;
pub(crate) mod equations;
pub(crate) mod error_estimate;
mod error_of_forces;
mod history;
mod impacts;
pub(crate) mod predictor;
pub(crate) mod projection;
pub(crate) mod workspace;

pub(crate) use attempt::Attempt;
pub(crate) use history::IntegratorHistory;

use lissom_solver::{FactorError, SolverKind};

use crate::consistent::initial_conditions::visit_rates;
use crate::consistent::redundancy::Redundancy;
use crate::errors::StepError;
use crate::errors::step_error::{describe, lost_pivot_hint, undetermined_hint};
use crate::integrator::dense::{DenseOutput, SolvedStages};
use crate::integrator::equations::StepEquations;
use crate::integrator::projection::Projection;
use crate::integrator::workspace::Workspace;
use crate::kinematics::{Kinematics, Layout, MotionChange};
use crate::newton::{self, Equations, Failure, JacobianState, Outcome};
use crate::round_off;
use crate::saddle_point::TangentValues;
use crate::scaling::{Representative, ScaleBy, Scaled};
use crate::schemes::{Combination, StageSystem};
use crate::settings::{Problem, Settings, Stopwatch, Unwatched};
use crate::solver_features::SolverFeature;
use crate::system::{State, System, Threads};

/// The state at which a step begins, and the one before the last step; both are equal before the first step.
#[derive(Clone, Copy)]
pub(crate) struct Start<'s> {
    pub(crate) previous: &'s State,
    pub(crate) state: &'s State,
}

/// Solves steps of one simulation, with data that are reused from step to step.
pub(crate) struct Integrator {
    pub(crate) representative: Representative,
    /// The scaling of the tangent in use, for the size of the last attempt.
    pub(crate) scaled: Scaled,
    pub(crate) work: Box<Workspace>,
    /// The middle of a step, where its defect is evaluated.
    middle: Box<defect::Middle>,
    /// The estimated error of an attempt, filtered twice, by row.
    refiltered: Vec<f64>,
    pub(crate) jacobian_state: JacobianState,
    /// For schemes whose memory depends on the step size.
    pub(crate) history: Option<IntegratorHistory>,
    /// For schemes whose velocities deviate slightly from the constraints.
    projection: Option<Projection>,
    /// Whether its workspace still contains the step that ended at the state of the simulation.
    pub(crate) has_last_step: bool,
}

impl Integrator {
    /// At the start of a simulation.
    pub(crate) fn new(
        Problem { system, settings }: Problem<'_>,
        state: &State,
        (representative, redundancy): (Representative, Redundancy),
    ) -> Self {
        let scheme = &settings.scheme;
        let scaled = Scaled::new(&settings.scaling, &representative, settings.step_size);
        let equilibrated = settings.scaling.equilibrates();
        let mut work = Workspace::new(
            (system, state),
            scheme,
            (&representative, redundancy),
            (settings.solver, equilibrated),
        );
        (work.options.disabled, work.options.tuning) = (settings.limits.disabled, settings.limits.tuning);
        if !work.options.disabled.allows(SolverFeature::StillAxes) {
            work.unit.spins.clear();
        }
        work.evaluation.threads = Threads::new(system.starts_of_batches(), settings.threads);
        work.tangent.matrices.set_threads(settings.threads);
        work.tangent = work.tangent.falling_back(settings.solver);
        let has_constraints = !system.layout().multiplier_rows().is_empty();
        let projection = scheme
            .tableau
            .filter(|tableau| !tableau.is_stiffly_accurate() && has_constraints)
            .map(|tableau| Projection::new(system, state, &representative, settings.solver, tableau));
        let remembers = scheme.dynamic && scheme.algorithmic != Combination::default();
        let history = remembers.then(|| {
            let solver = pivoting_unless_augmented(settings);
            IntegratorHistory::new(system, state, &representative, solver, settings.step_size)
        });
        Self {
            representative,
            scaled,
            work: Box::new(work),
            middle: Box::new(defect::Middle::new(state)),
            refiltered: vec![0.0; system.layout().size()],
            jacobian_state: JacobianState::default(),
            history,
            projection,
            has_last_step: false,
        }
    }

    /// Notes the touches at the start of a motion with steps of `size` [s].
    pub(crate) fn note_touches(&mut self, system: &System, state: &mut State, size: f64) {
        if let Some(contacts) = self.work.contacts.as_mut().filter(|_| state.touches.is_empty()) {
            contacts.begin(system, (state, true), [size; 2]);
            contacts.write_first_touches(&mut state.touches);
        }
    }

    /// Time to the first touch of parts that move far in a step of `size` [s] `from` a state, if it is within the step [s]: the step ends there.
    pub(crate) fn first_touch(&mut self, system: &System, from: &State, size: f64) -> Option<f64> {
        self.work.contacts.as_mut()?.near.first_touch(system, from, size)
    }

    /// Solves a step of `size` [s] and stores the result in `attempt`.
    ///
    /// # Errors
    /// If Newton's iterations do not converge, the tangent cannot be factorised, or a value at the end is not finite.
    pub(crate) fn attempt(
        &mut self,
        problem: Problem<'_>,
        from: Start<'_>,
        size: f64,
        watch: &mut dyn Stopwatch,
        attempt: &mut Attempt,
    ) -> Result<(), StepError> {
        self.begin(problem, from, size, attempt)?;
        let settings = problem.settings;
        let start = attempt.start(from.state);
        self.work.prediction.extrapolates = settings.scheme.dynamic;
        let time = start.kinematics.time;
        let mut equations =
            step_equations(problem, start, &self.representative, self.scaled, &mut self.work, watch);
        equations.restart();
        let result = if equations.begin_contacts(settings) {
            newton::descend(&mut equations).and_then(|outcome| equations.resolve_impacts().map(|()| outcome))
        } else {
            newton::solve(&mut equations, &settings.limits, &mut self.jacobian_state)
        };
        let result = sufficient(result, settings.scheme.tableau.is_some());
        let end_time = time + equations.scaled.step_size();
        let result = result.map_err(|failure| describe_failure(&equations, settings, failure, end_time));
        self.scaled = equations.scaled;
        if result.is_err() {
            self.jacobian_state = JacobianState::default();
        }
        let outcome = result?;
        self.finish(problem, from.state, attempt)?;
        attempt.outcome = outcome;
        Ok(())
    }

    /// Changes to steps of `size` [s], and converts the start of one to a step of unit length.
    pub(crate) fn begin(
        &mut self,
        Problem { system, settings }: Problem<'_>,
        Start { previous, state }: Start<'_>,
        size: f64,
        attempt: &mut Attempt,
    ) -> Result<(), StepError> {
        if size != self.scaled.step_size() {
            self.resize(Problem { system, settings }, size);
        }
        if self.work.redundancy.follow(system, &state.kinematics) {
            self.work.tangent.omit(self.work.redundancy.omitted());
            self.work.unit.spins.omit(self.work.redundancy.omitted());
            self.jacobian_state = JacobianState::default();
        }
        attempt.size = size;
        attempt.is_converted = false;
        if let Some(history) = self.history.as_mut().filter(|history| !history.is_of(size)) {
            let Attempt { converted, end, .. } = attempt;
            let delay = settings.scheme.memory_delay;
            let time = state.kinematics.time;
            history
                .convert(system, delay, (previous, state, end), size, converted)
                .map_err(|error| StepError::Velocities { time, error })?;
            attempt.is_converted = true;
        }
        let start = attempt.start(state);
        self.scaled.to_unit_step(system.layout(), &settings.scheme, start, &mut self.work.unit);
        self.work.round_off.travel = None;
        self.work.start_change.fill(0.0);
        system.begin_step(&start.kinematics, &mut self.work.evaluation.joint_starts);
        Ok(())
    }

    /// Changes the step size and rescales all retained data.
    pub(crate) fn resize(&mut self, Problem { system, settings }: Problem<'_>, size: f64) {
        self.work.rescale_predictions(size / self.scaled.step_size());
        self.scaled = self.scaled.resized(&settings.scaling, size);
        // Scaled tangents of motions hardly depend on the step size; those of load steps and unscaled ones do.
        if !settings.scheme.dynamic || settings.scaling.by == ScaleBy::None {
            self.jacobian_state = JacobianState::default();
        }
        self.work.note_scales(system.layout(), &self.scaled);
    }

    /// Writes the end of `attempt`, which began at `state`, from the increments and multipliers found.
    pub(crate) fn finish(
        &mut self,
        problem: Problem<'_>,
        state: &State,
        attempt: &mut Attempt,
    ) -> Result<(), StepError> {
        let Problem { system, settings } = problem;
        let start = if attempt.is_converted { &attempt.converted } else { state };
        let end = &mut attempt.end;
        step_equations(problem, start, &self.representative, self.scaled, &mut self.work, &mut Unwatched)
            .final_violations(&mut end.violations);
        let work = &*self.work;
        let (Some(reached), Some(multipliers)) =
            (work.motions.last(), last_stage(settings, &work.multipliers))
        else {
            unreachable!("every scheme has a stage")
        };
        copy_motion(&reached.at, &mut end.kinematics);
        end.multipliers.copy_from_slice(multipliers);
        end.kinematics.show_multipliers(&end.multipliers);
        if let Some(contacts) = &work.contacts {
            contacts.write_touches(&mut end.touches);
            if let Some(change) = contacts.impacts.change() {
                add_impacts(system.layout(), (change, self.scaled.step_size()), end);
            }
        }
        let (algorithmic, memory) = (&settings.scheme.algorithmic, &mut end.algorithmic);
        self.scaled.memory_from_unit_step(algorithmic, &work.unit, &work.increments, memory);
        compensate(start, &reached.changes, end);
        if let Some(projection) = &mut self.projection {
            let time = end.kinematics.time;
            projection.apply(system, end).map_err(|error| StepError::Velocities { time, error })?;
        }
        system.signals().check(&end.kinematics).map_err(StepError::Signal)
    }

    /// The motion of the last attempt, which led from one of these states to the other.
    pub(crate) fn dense<'s>(&'s self, problem: Problem<'s>, ends: (&'s State, &'s State)) -> DenseOutput<'s> {
        dense_output(&self.work, problem, ends)
    }

    /// Updates the retained data after an accepted attempt, which began with these multipliers.
    pub(crate) fn learn(&mut self, settings: &Settings, multipliers: &[f64]) {
        if settings.scheme.dynamic {
            self.work.learn(&settings.scheme, self.scaled.step_size(), multipliers);
        }
        if let Some(history) = &mut self.history {
            history.renew(self.scaled.step_size());
        }
    }

    /// Reassembles the tangent at the solution of the step that began at `start`, and uses it from then on.
    ///
    /// # Errors
    /// If the tangent cannot be factorised.
    pub(crate) fn renew_at_solution(
        &mut self,
        problem: Problem<'_>,
        start: &State,
    ) -> Result<(), FactorError> {
        problem.system.begin_step(&start.kinematics, &mut self.work.evaluation.joint_starts);
        let (representative, work, watch) = (&self.representative, &mut self.work, &mut Unwatched);
        let mut equations = step_equations(problem, start, representative, self.scaled, work, watch);
        equations.work.newton.correction = 0.0;
        let result = equations.renew_tangent();
        self.scaled = equations.scaled;
        result
    }

    /// The tangent at the solution of the step that began at `start`, with another scaling.
    pub(crate) fn tangent_at_solution(
        &mut self,
        problem: Problem<'_>,
        start: &State,
        scaled: Scaled,
        of: &StageSystem,
    ) -> TangentValues {
        problem.system.begin_step(&start.kinematics, &mut self.work.evaluation.joint_starts);
        let (representative, work, watch) = (&self.representative, &mut self.work, &mut Unwatched);
        let mut equations = step_equations(problem, start, representative, scaled, work, watch);
        let mut values = TangentValues::zeros(of, problem.system.structure().pattern.entries());
        equations.assemble_tangent(&mut values.receiver(&scaled, of, &mut []));
        values
    }
}

/// The motion of the last attempt, which led from one of these states to the other.
fn dense_output<'s>(
    work: &'s Workspace,
    Problem { system, settings }: Problem<'s>,
    (from, to): (&'s State, &'s State),
) -> DenseOutput<'s> {
    let stages = settings.scheme.dense.as_ref().map(|polynomial| SolvedStages {
        polynomial,
        table: &settings.scheme.stages,
        layout: system.layout(),
        increments: &work.increments,
        start_change: &work.start_change,
        multipliers: &work.multipliers,
        spins: &work.unit.spins,
    });
    DenseOutput { from, to, stages }
}

/// The equations of a step from `start`.
pub(crate) fn step_equations<'e>(
    Problem { system, settings }: Problem<'e>,
    start: &'e State,
    representative: &'e Representative,
    scaled: Scaled,
    work: &'e mut Workspace,
    watch: &'e mut dyn Stopwatch,
) -> StepEquations<'e> {
    let scaling = (&settings.scaling, representative);
    StepEquations { system, scheme: &settings.scheme, scaled, scaling, start, work, watch }
}

/// Without the augmented term massless coordinates need pivots.
pub(crate) fn pivoting_unless_augmented(settings: &Settings) -> &'static SolverKind {
    let pivoting = lissom_solver::kind("pivoting").unwrap_or(settings.solver);
    if settings.scaling.augmented { settings.solver } else { pivoting }
}

fn last_stage<'m>(settings: &Settings, multipliers: &'m [Vec<f64>]) -> Option<&'m Vec<f64>> {
    multipliers.get(settings.scheme.stages.len() - 1)
}

/// Accepts small last corrections for schemes that integrate velocities.
fn sufficient(result: Result<Outcome, Failure>, integrates_velocities: bool) -> Result<Outcome, Failure> {
    match result {
        Err(Failure::NotConverged { iterations, correction })
            if integrates_velocities && correction <= round_off::STEP =>
        {
            Ok(Outcome { iterations, correction, stagnated: true, ..Outcome::default() })
        }
        other => other,
    }
}

/// Describes a failure of Newton's method, with names, in a step to the time `end` [s].
fn describe_failure(
    equations: &StepEquations<'_>,
    settings: &Settings,
    failure: Failure,
    end: f64,
) -> StepError {
    let system = equations.system;
    if matches!(failure, Failure::NotFinite { .. } | Failure::Factor(FactorError::NotFinite { .. })) {
        if let Some(error) = equations.signal_error() {
            return StepError::Signal(error);
        }
        let instants = equations.work.motions.iter().map(|motion| motion.at.time);
        let found = instants.filter_map(|at| {
            let (what, value) = system.function_without_value(at)?;
            Some(StepError::FunctionNotFinite { time: end, what: what.clone(), value, at })
        });
        if let Some(error) = found.take(1).next() {
            return error;
        }
    }
    // With a pivoting solver a smaller step may succeed.
    let pivoted = !matches!(failure, Failure::Factor(_));
    let failure = equations.unforgiven(failure);
    let independent = match failure {
        Failure::Factor(FactorError::ZeroPivot { unknown, .. }) => equations.is_independent(unknown),
        _ => false,
    };
    if let Failure::Factor(FactorError::ZeroPivot { unknown, pivot, largest }) = failure
        && independent
        && settings.solver.is_strict
    {
        let (unknown, hint) =
            (system.layout().subject_of(unknown), lost_pivot_hint(settings.scaling.augmented));
        return StepError::PivotLost { time: end, pivot, terms: largest, unknown, hint };
    }
    let mut error = describe(&failure, system.layout(), end, settings, &equations.worst_unknown());
    if let StepError::ZeroPivot { after_pivoting, hint, .. } = &mut error {
        *after_pivoting = pivoted;
        if independent {
            *hint = undetermined_hint(settings.scaling.augmented);
        }
    }
    error
}

/// Adds changes of velocities and impulses of constraints, by row, that impacts cause in a step of `size` [s].
fn add_impacts(layout: &Layout, (change, size): (&[f64], f64), end: &mut State) {
    visit_rates(layout, &mut end.kinematics, |row, rate, acceleration| {
        *rate += change[row];
        *acceleration += change[row] / size;
    });
    for (multiplier, impulse) in end.multipliers.iter_mut().zip(&change[layout.coordinate_count()..]) {
        *multiplier += impulse / size;
    }
    end.kinematics.show_multipliers(&end.multipliers);
}

fn copy_motion(from: &Kinematics, to: &mut Kinematics) {
    to.elapsed = from.elapsed;
    to.nodes.copy_from_slice(&from.nodes);
    to.coordinates.copy_from_slice(&from.coordinates);
    to.held.copy_from_slice(&from.held);
}

/// Adds each node's displacement to its position, and the step to the time, with the remainders of earlier
/// roundings, so that many small steps do not lose digits [Kahan 1965].
fn compensate(start: &State, changes: &[MotionChange], end: &mut State) {
    let step = std::mem::take(&mut end.kinematics.elapsed) + start.time_remainder;
    let time = start.kinematics.time + step;
    end.time_remainder = step - (time - start.kinematics.time);
    end.kinematics.time = time;
    for (node, change) in changes.iter().enumerate() {
        let from = &start.kinematics.nodes[node].frame;
        let shift = from.rotation.apply(&change.shift) + start.position_remainders[node];
        let position = from.position + shift;
        end.position_remainders[node] = shift - (position - from.position);
        let frame = &mut end.kinematics.nodes[node].frame;
        frame.position = position;
        frame.rotation = frame.rotation.normalized();
    }
}
