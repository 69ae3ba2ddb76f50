//! Time steps and load steps: `Simulation::step` is the table of contents of a step.

use lissom_solver::{FactorError, SolverKind};

use super::equations::{StepEquations, Workspace};
use super::factorization::Factorization;
use super::initial::{Initial, InitialError};
use super::step_error::{StepError, pivot_hint};
use crate::newton::{self, Failure, Limits, Memory};
use crate::scaling::{Representative, Scaled, ScalingChoice};
use crate::schemes::Scheme;
use crate::system::{Chart, Kinematics, Linearization, MotionChange, Point, State, System};

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
}

/// A system on its way through time.
pub struct Simulation {
    system: System,
    state: State,
    next: State,
    settings: Settings,
    representative: Representative,
    scaled: Scaled,
    work: Workspace,
    memory: Memory,
    totals: Totals,
    velocity_correction: f64,
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
            velocity_correction = initial.velocities(&mut state)?;
            initial.accelerations(&mut state)?;
            let delay = settings.scheme.memory_delay * settings.step_size;
            state.algorithmic = initial.delayed_accelerations(&state, delay)?;
        }
        let mut violations = vec![0.0; system.layout().multiplier_count];
        system.violations(&state.kinematics, &mut violations);
        state.violations = violations;
        let scaled = Scaled::new(&settings.scaling, &representative, settings.step_size);
        let work = Workspace::new(&system, &state, &settings.scheme, &representative, settings.solver);
        Ok(Self {
            next: state.clone(),
            system,
            state,
            settings,
            representative,
            scaled,
            work,
            memory: Memory::default(),
            totals: Totals { smallest_relative_pivot: f64::INFINITY, ..Totals::default() },
            velocity_correction,
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
        self.work.factorization.entries()
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
    /// failed.
    pub(super) fn linearize_last_step(&mut self) -> Option<&Linearization> {
        let reached = self.work.motions.last().map(|motion| motion.at.time);
        if self.totals.steps == 0 || reached != Some(self.state.kinematics.time) {
            return None;
        }
        let mut equations = StepEquations {
            system: &self.system,
            scheme: &self.settings.scheme,
            scaled: self.scaled,
            start: &self.next,
            work: &mut self.work,
        };
        equations.linearize();
        Some(&self.work.linearization)
    }

    /// The tangent factored last, if it is still in use.
    pub(super) fn factored_tangent(&mut self) -> Option<&mut Factorization> {
        self.memory.has_tangent.then_some(&mut self.work.factorization)
    }

    /// Takes one step. On failure the state stays where it was.
    ///
    /// # Errors
    /// If Newton's iterations do not converge or the tangent has no factorisation.
    pub fn step(&mut self) -> Result<StepReport, StepError> {
        self.scaled.enter(self.system.layout(), &self.state, &mut self.work.unit);
        let mut equations = StepEquations {
            system: &self.system,
            scheme: &self.settings.scheme,
            scaled: self.scaled,
            start: &self.state,
            work: &mut self.work,
        };
        equations.predict();
        let outcome = match newton::solve(&mut equations, &self.settings.limits, &mut self.memory) {
            Ok(outcome) => outcome,
            Err(failure) => {
                let error = describe(&failure, &equations, &self.settings);
                self.memory = Memory::default();
                return Err(error);
            }
        };
        equations.final_violations(&mut self.next.violations);
        self.finish();
        let report = StepReport {
            iterations: outcome.iterations,
            factorizations: outcome.factorizations,
            correction: outcome.correction,
            stagnated: outcome.stagnated,
        };
        self.count(&report);
        Ok(report)
    }

    /// Makes the end of the step the new state.
    fn finish(&mut self) {
        let last = self.settings.scheme.stages.len() - 1;
        let work = &mut self.work;
        copy_motion(&work.motions[last].at, &mut self.next.kinematics);
        self.next.kinematics.elapsed = 0.0;
        self.next.multipliers.copy_from_slice(&work.multipliers[last]);
        for (row, value) in self.next.algorithmic.iter_mut().enumerate() {
            let memory = work.unit.combine(&self.settings.scheme.algorithmic, &work.increments, row);
            *value = self.scaled.leave(memory);
        }
        compensate_positions(&self.state, &work.motions[last].changes, &mut self.next);
        std::mem::swap(&mut self.state, &mut self.next);
    }

    fn count(&mut self, report: &StepReport) {
        let totals = &mut self.totals;
        totals.steps += 1;
        totals.newton_iterations += report.iterations;
        totals.factorizations += report.factorizations;
        totals.stagnated_steps += usize::from(report.stagnated);
        if let Some(factor) = &self.work.report {
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
    to.time = from.time;
    to.nodes.copy_from_slice(&from.nodes);
    to.coordinates.copy_from_slice(&from.coordinates);
}

/// Adds each node's displacement to its position with the remainder of earlier roundings, so that many
/// small steps do not lose digits [Kahan 1965].
fn compensate_positions(start: &State, changes: &[MotionChange], next: &mut State) {
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
        increments: crate::joints::attached::Increments {
            start: &state.kinematics,
            nodes: &still,
            coordinates: &unchanged,
        },
        multipliers: &zero,
        violations: &zero,
        augmentation: 0.0,
    };
    let mut linearization = Linearization::new(system);
    system.linearize(&point, Chart::Body, &mut linearization);
    Representative::of(system, &state.kinematics, &linearization)
}

fn describe(failure: &Failure, equations: &StepEquations<'_>, settings: &Settings) -> StepError {
    let time = equations.start.kinematics.time + settings.step_size;
    let layout = equations.system.layout();
    match failure {
        Failure::NotConverged { iterations, correction } => StepError::NotConverged {
            time,
            iterations: *iterations,
            correction: *correction,
            worst: equations.worst_unknown(),
        },
        Failure::NotFinite { iterations } => {
            StepError::NotFinite { time, iterations: *iterations, worst: equations.worst_unknown() }
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
