//! Time steps and load steps: `Simulation::step` is the table of contents of a step.

use lissom_solver::{FactorError, FactorReport, SolverKind};

use super::approach;
use super::decaying::{DecayingEquations, DecayingWorkspace};
use super::equations::{StepEquations, Workspace};
use super::initial::{Initial, InitialError};
use super::phase::{Phase, Stopwatch, Unwatched};
use super::step_error::{StepError, pivot_hint};
use crate::newton::{self, Failure, Limits, Memory};
use crate::scaling::{Representative, Scaled, ScalingChoice};
use crate::schemes::{Coupling, Scheme};
use crate::system::{Augmentation, Chart, Kinematics, Linearization, MotionChange, Point, State, System};

/// What a simulation is told besides system and state.
#[derive(Clone)]
pub struct Settings {
    /// Time scheme.
    pub scheme: Scheme,
    /// Step size [s]; in statics, the step of the load parameter.
    pub step_size: f64,
    /// Scaling and augmented term.
    pub scaling: ScalingChoice,
    /// When Newton's iterations stop.
    pub limits: Limits,
    /// Linear solver.
    pub solver: &'static SolverKind,
}

/// What a step took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepReport {
    /// Newton iterations.
    pub iterations: usize,
    /// Tangents factored.
    pub factorizations: usize,
    /// Size of the last correction [-].
    pub correction: f64,
    /// Whether iterations ended at round-off rather than at the tolerance.
    pub stagnated: bool,
}

/// Sums over all steps so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Totals {
    /// Steps completed.
    pub steps: usize,
    /// Steps given up and tried again.
    pub rejected_steps: usize,
    /// Newton iterations.
    pub newton_iterations: usize,
    /// Tangents factored.
    pub factorizations: usize,
    /// Steps whose iterations ended at round-off.
    pub stagnated_steps: usize,
    /// Smallest pivot over largest diagonal entry, over all factorisations.
    pub smallest_relative_pivot: f64,
    /// Largest carried violation of a constraint [m, rad].
    pub max_constraint_violation: f64,
    /// The unknown whose pivot vanished, so that the run went on with a pivoting solver.
    pub fell_back_at: Option<usize>,
}

/// Tolerance of schemes whose promise holds for the exact solution of their equations.
const EXACT: f64 = 1e-12;

/// A system on its way through time.
pub struct Simulation {
    system: System,
    state: State,
    next: State,
    settings: Settings,
    representative: Representative,
    scaled: Scaled,
    engine: Engine,
    memory: Memory,
    totals: Totals,
    velocity_correction: f64,
    /// Whether the engine still holds the step that led to the state.
    is_last_step_known: bool,
}

impl Simulation {
    /// Prepares a simulation: representative values, consistent initial velocities, accelerations and
    /// multipliers.
    ///
    /// # Errors
    /// If consistent initial values do not exist.
    pub fn new(system: System, state: State, settings: Settings) -> Result<Self, InitialError> {
        let mut state = state;
        let representative = representative(&system, &state);
        let mut velocity_correction = 0.0;
        let pivoting = lissom_solver::kind("pivoting").unwrap_or(settings.solver);
        if settings.scheme.dynamic {
            let kind = if settings.scaling.augmented { settings.solver } else { pivoting };
            let mut initial = Initial::new(&system, &state, &representative, kind);
            velocity_correction = initial.velocities(&system, &mut state)?;
            initial.accelerations(&system, &mut state)?;
            let delay = settings.scheme.memory_delay * settings.step_size;
            state.algorithmic = initial.delayed_accelerations(&system, &state, delay)?;
        }
        let mut violations = vec![0.0; system.layout().multiplier_count];
        system.violations(&state.kinematics, &mut violations);
        state.violations = violations;
        let scaled = Scaled::new(&settings.scaling, &representative, settings.step_size);
        let engine = Engine::new(&system, &state, &settings, &representative);
        Ok(Self {
            next: state.clone(),
            system,
            state,
            settings,
            representative,
            scaled,
            engine,
            memory: Memory::default(),
            totals: Totals { smallest_relative_pivot: f64::INFINITY, ..Totals::default() },
            velocity_correction,
            is_last_step_known: false,
        })
    }

    /// The system.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// The state after the last step.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Sums over all steps.
    pub fn totals(&self) -> &Totals {
        &self.totals
    }

    /// The settings.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Representative mass, damping, stiffness and length.
    pub fn representative(&self) -> &Representative {
        &self.representative
    }

    /// The scaling in force.
    pub fn scaled(&self) -> &Scaled {
        &self.scaled
    }

    /// Stored numbers of the tangent's factors.
    pub fn factor_entries(&self) -> usize {
        self.engine.factor_entries()
    }

    /// Largest change made to the given initial twists to satisfy the constraints [m/s, rad/s].
    pub fn velocity_correction(&self) -> f64 {
        self.velocity_correction
    }

    /// Changes the step size; the tangent is made anew.
    pub fn set_step_size(&mut self, step_size: f64) {
        if step_size != self.settings.step_size {
            self.settings.step_size = step_size;
            self.scaled = Scaled::new(&self.settings.scaling, &self.representative, step_size);
            self.memory = Memory::default();
        }
    }

    /// Linearises anew at the solution of the last step; none before the first step and after one that
    /// failed, and none for a scheme without the tangent of a stage. `scaled` weighs the augmented term.
    pub(super) fn linearize_last_step(&mut self, scaled: Scaled) -> Option<&Linearization> {
        let Engine::Collocation(work) = &mut self.engine else { return None };
        if !self.is_last_step_known {
            return None;
        }
        let mut equations = StepEquations {
            system: &self.system,
            scheme: &self.settings.scheme,
            scaled,
            rescale: &|_| scaled,
            start: &self.next,
            work,
            watch: &mut Unwatched,
        };
        equations.linearize();
        Some(&work.linearization)
    }

    /// Estimates the condition number of the tangent factored last, in the 1-norm, if it is still in use.
    pub(super) fn factored_condition(&mut self) -> Option<f64> {
        let value = match &mut self.engine {
            Engine::Collocation(work) => {
                let pattern = &self.system.structure().pattern;
                self.memory.has_tangent.then(|| work.factorization.condition_estimate(pattern))
            }
            Engine::Decaying(work) => self.memory.has_tangent.then(|| work.condition_estimate()),
        };
        value.map(|value| value.max(1.0))
    }

    /// Smallest pivot over largest diagonal entry of the tangent factored last.
    pub fn relative_pivot(&self) -> Option<f64> {
        self.engine.report().map(FactorReport::relative_pivot)
    }

    /// Takes one step. On failure the state stays where it was.
    ///
    /// # Errors
    /// If Newton's iterations do not converge or the tangent has no factorisation.
    pub fn step(&mut self) -> Result<StepReport, StepError> {
        self.step_watched(&mut Unwatched)
    }

    /// Takes one step as [`step`](Self::step) does and tells `watch` which part of the work begins. The
    /// energy-decaying scheme tells nothing.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn step_watched(&mut self, watch: &mut dyn Stopwatch) -> Result<StepReport, StepError> {
        watch.begin(Phase::Rest);
        self.is_last_step_known = false;
        let outcome = match &mut self.engine {
            Engine::Collocation(_) => self.collocate(watch),
            Engine::Decaying(_) => self.decay(),
        }?;
        std::mem::swap(&mut self.state, &mut self.next);
        self.is_last_step_known = true;
        let report = StepReport {
            iterations: outcome.iterations,
            factorizations: outcome.factorizations,
            correction: outcome.correction,
            stagnated: outcome.stagnated,
        };
        self.count(&report);
        Ok(report)
    }

    /// A step of a scheme with equilibrium at its stages.
    fn collocate(&mut self, watch: &mut dyn Stopwatch) -> Result<newton::Outcome, StepError> {
        let Engine::Collocation(work) = &mut self.engine else {
            unreachable!("chosen by the engine");
        };
        self.scaled.enter(self.system.layout(), &self.state, &mut work.unit);
        let Settings { scaling, step_size, .. } = &self.settings;
        let rescale = |share: f64| Scaled::new(scaling, &self.representative, share * step_size);
        let mut equations = StepEquations {
            system: &self.system,
            scheme: &self.settings.scheme,
            scaled: self.scaled,
            rescale: &rescale,
            start: &self.state,
            work,
            watch,
        };
        let outcome =
            approach::solve(&mut equations, &self.settings.limits, &mut self.memory).map_err(|failure| {
                self.memory = Memory::default();
                let failure = equations.unforgiven(failure);
                describe(&failure, &self.system, &self.state, &self.settings, &equations.worst_unknown())
            })?;
        equations.final_violations(&mut self.next.violations);

        let last = self.settings.scheme.stages.len() - 1;
        copy_motion(&work.motions[last].at, &mut self.next.kinematics);
        self.next.multipliers.copy_from_slice(&work.multipliers[last]);
        for (row, value) in self.next.algorithmic.iter_mut().enumerate() {
            let memory = work.unit.combine(&self.settings.scheme.algorithmic, &work.increments, row);
            *value = self.scaled.leave(memory);
        }
        compensate(&self.state, &work.motions[last].changes, &mut self.next);
        Ok(outcome)
    }

    /// A step of the energy-decaying scheme.
    fn decay(&mut self) -> Result<newton::Outcome, StepError> {
        let (Engine::Decaying(work), Coupling::Jump(scheme)) =
            (&mut self.engine, self.settings.scheme.coupling)
        else {
            unreachable!("chosen by the engine");
        };
        self.scaled.enter(self.system.layout(), &self.state, &mut work.unit);
        let Settings { scaling, step_size, .. } = &self.settings;
        let rescale = |share: f64| Scaled::new(scaling, &self.representative, share * step_size);
        let mut equations = DecayingEquations {
            system: &self.system,
            scheme,
            scaled: self.scaled,
            rescale: &rescale,
            start: &self.state,
            work,
        };
        // The energy is as good as the solution: to round-off.
        let limits = Limits { tolerance: self.settings.limits.tolerance.min(EXACT), ..self.settings.limits };
        let outcome = approach::solve(&mut equations, &limits, &mut self.memory).map_err(|failure| {
            self.memory = Memory::default();
            describe(&failure, &self.system, &self.state, &self.settings, &equations.worst_unknown())
        })?;
        let (end, changes, violations) = work.end();
        copy_motion(end, &mut self.next.kinematics);
        self.next.violations.copy_from_slice(violations);
        self.next.multipliers.copy_from_slice(&work.multipliers);
        compensate(&self.state, changes, &mut self.next);
        self.scaled.leave_rates(self.system.layout(), &self.state, &work.rate_end, &mut self.next);
        project_velocities(&self.system, scheme.alpha, &mut work.initial, &mut self.next)
            .map_err(|error| StepError::Velocities { time: self.next.kinematics.time, error })?;
        Ok(outcome)
    }

    fn count(&mut self, report: &StepReport) {
        let totals = &mut self.totals;
        totals.steps += 1;
        totals.newton_iterations += report.iterations;
        totals.factorizations += report.factorizations;
        totals.stagnated_steps += usize::from(report.stagnated);
        if let Engine::Collocation(work) = &self.engine {
            totals.fell_back_at = work.fell_back.map(|(unknown, _)| unknown);
        }
        if let Some(factor) = self.engine.report() {
            totals.smallest_relative_pivot = totals.smallest_relative_pivot.min(factor.relative_pivot());
        }
        for violation in &self.state.violations {
            totals.max_constraint_violation = totals.max_constraint_violation.max(violation.abs());
        }
    }

    /// Notes that a step was given up and will be tried again with another size.
    pub fn note_rejected(&mut self) {
        self.totals.rejected_steps += 1;
    }
}

fn copy_motion(from: &Kinematics, to: &mut Kinematics) {
    to.elapsed = from.elapsed;
    to.nodes.copy_from_slice(&from.nodes);
    to.coordinates.copy_from_slice(&from.coordinates);
}

/// Adds each node's displacement to its position, and the step to the time, with the remainders of earlier
/// roundings, so that many small steps do not lose digits [Kahan 1965].
fn compensate(start: &State, changes: &[MotionChange], next: &mut State) {
    let step = std::mem::take(&mut next.kinematics.elapsed) + start.time_remainder;
    let time = start.kinematics.time + step;
    next.time_remainder = step - (time - start.kinematics.time);
    next.kinematics.time = time;
    for (node, change) in changes.iter().enumerate() {
        let from = &start.kinematics.nodes[node].frame;
        let shift = from.rotation.apply(&change.shift) + start.position_remainders[node];
        let position = from.position + shift;
        next.position_remainders[node] = shift - (position - from.position);
        let frame = &mut next.kinematics.nodes[node].frame;
        frame.position = position;
        frame.rotation = frame.rotation.normalized();
    }
}

/// Representative values from the linearisation at the start.
fn representative(system: &System, state: &State) -> Representative {
    let still = vec![MotionChange::none(); state.kinematics.nodes.len()];
    let unchanged = vec![0.0; state.kinematics.coordinates.len()];
    let zero = vec![0.0; system.layout().multiplier_count];
    let point = Point {
        at: &state.kinematics,
        stressed: &state.kinematics,
        increments: crate::joints::attached::Increments {
            start: &state.kinematics,
            nodes: &still,
            coordinates: &unchanged,
        },
        multipliers: &zero,
        violations: &zero,
        augmentation: Augmentation::none(),
    };
    let mut linearization = Linearization::new(system);
    system.linearize(&point, Chart::Body, &mut linearization);
    Representative::of(system, &state.kinematics, &linearization)
}

/// Takes the share α of the velocities' violation of the constraints away, as a projection that is
/// orthogonal in the kinetic energy, which therefore never grows: the constraints' own oscillation, which the
/// step leaves undamped.
fn project_velocities(
    system: &System,
    alpha: f64,
    initial: &mut Initial,
    state: &mut State,
) -> Result<(), InitialError> {
    if alpha == 0.0 || system.layout().multiplier_rows().is_empty() {
        return Ok(());
    }
    let given: Vec<_> = state.kinematics.nodes.iter().map(|node| node.twist).collect();
    initial.velocities(system, state)?;
    for (node, given) in state.kinematics.nodes.iter_mut().zip(given) {
        node.twist = given + alpha * (node.twist - given);
    }
    Ok(())
}

fn describe(
    failure: &Failure,
    system: &System,
    state: &State,
    settings: &Settings,
    worst: &str,
) -> StepError {
    let time = state.kinematics.time + settings.step_size;
    let layout = system.layout();
    match failure {
        Failure::NotConverged { iterations, correction } => StepError::NotConverged {
            time,
            iterations: *iterations,
            correction: *correction,
            worst: worst.to_owned(),
        },
        Failure::NotFinite { iterations } => {
            StepError::NotFinite { time, iterations: *iterations, worst: worst.to_owned() }
        }
        Failure::Factor(FactorError::ZeroPivot { unknown, pivot, .. }) => StepError::ZeroPivot {
            time,
            pivot: *pivot,
            unknown: layout.name_of(*unknown),
            hint: pivot_hint(*unknown >= layout.coordinate_count(), settings.scaling.augmented),
        },
        Failure::Factor(FactorError::NotFinite { unknown }) => {
            StepError::NotFinite { time, iterations: 0, worst: layout.name_of(*unknown) }
        }
    }
}

/// How steps are taken.
enum Engine {
    Collocation(Box<Workspace>),
    Decaying(Box<DecayingWorkspace>),
}

impl Engine {
    fn new(system: &System, state: &State, settings: &Settings, representative: &Representative) -> Self {
        if matches!(settings.scheme.coupling, Coupling::Jump(_)) {
            let work = DecayingWorkspace::new(system, state, representative, settings.solver);
            return Self::Decaying(Box::new(work));
        }
        let equilibrated = settings.scaling.equilibrates();
        let mut work =
            Workspace::new(system, state, &settings.scheme, representative, settings.solver, equilibrated);
        work.fall_back = lissom_solver::kind("pivoting").filter(|kind| kind.name != settings.solver.name);
        Self::Collocation(Box::new(work))
    }

    fn factor_entries(&self) -> usize {
        match self {
            Self::Collocation(work) => work.factorization.entries(),
            Self::Decaying(work) => work.factor_entries(),
        }
    }

    fn report(&self) -> Option<&FactorReport> {
        match self {
            Self::Collocation(work) => work.report.as_ref(),
            Self::Decaying(work) => work.report.as_ref(),
        }
    }
}
