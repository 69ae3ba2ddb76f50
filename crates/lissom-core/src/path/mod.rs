//! Equilibrium paths under loads multiplied by a load factor, through limit points and snap-back, by arc-length continuation
//! [Riks 1979; Crisfield 1981].
//!
//! The residual at load factor Λ is (1 - Λ) r₀ + Λ r₁, where r₀ is the residual without gravity and loads and r₁ the full
//! residual: loads do not depend on the factor. Along a model parameter the residual is that of the system for its value, and the
//! derivative by it a finite difference; statements on Λ apply to the parameter, too. Distances along the path are root mean
//! squares of rotations and of displacements over the model's length; multipliers do not contribute.

mod branch;
mod critical;
mod equations;
mod systems;

use std::sync::Arc;

use lissom_solver::SolverKind;

use crate::diagnostics::{Value, diagnostics};
use crate::errors::StepError;
use crate::kinematics::Subject;
use crate::newton::{self, JacobianState, Limits};
use crate::round_off;
use crate::scaling::ScalingChoice;
use crate::simulation::ArcControl;
use crate::system::{State, System};
pub use branch::BranchChoice;
use branch::BranchPoint;
pub use critical::{CriticalKind, CriticalPoint};
use equations::{Condition, PathEquations, PathWork};
pub use systems::Family;
use systems::{PathSystems, are_alike};

/// A path whose load factor has not exceeded this fraction of its end value has not left the unloaded model.
const UNRESISTED: f64 = 1e-3;

/// Largest distance of the last equilibrium, relative to the step that passed the end.
const FARTHER: f64 = 1.1;

/// Options of a path, except its systems and its start.
#[derive(Clone, Copy)]
pub struct PathSettings {
    /// First step of the load factor, or of the parameter; its sign is the initial direction of the path.
    pub first: f64,
    /// Load factor, or value of the parameter, at which the path ends.
    pub end: f64,
    /// Maximum number of steps.
    pub most_steps: usize,
    /// Branch to follow.
    pub branch: BranchChoice,
    /// Scaling and augmented term.
    pub scaling: ScalingChoice,
    /// Convergence limits of Newton's method.
    pub limits: Limits,
    /// Linear solver.
    pub solver: &'static SolverKind,
}

diagnostics! {
    /// Failure to follow a path.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    Failure PathError {
        /// The systems without and with loads have different unknowns.
        NotAlike {} => "path-unlike-models" {
            cause: ("the model without its loads has other unknowns than with them"),
            remedy: "omit loads that add coordinates or states",
            meaning: "The model without its loads has other unknowns than with them.",
        }
        /// Loads depend on the motion through signals, or there are first-order states.
        Feedback {} => "path-feedback" {
            cause: ("a system with feedback has no equilibrium path"),
            remedy: "remove loads and states whose signals depend on the motion",
            meaning: "The path of a system with feedback is not defined.",
        }
        /// There are constraints between velocities, which a path has none of.
        VelocityConstraint {
            /// The first of them.
            constraint: Subject,
        } => "path-velocity-constraint" {
            subject: constraint,
            cause: ("an equilibrium path has no velocities, which the {constraint} relates"),
            remedy: "replace rolling joints by others, and remove latches or lock their joints",
            meaning: "Rolling joints and latches are constraints between velocities, of which an equilibrium path has none.",
        }
        /// No load acts.
        NoLoad {} => "path-without-load" {
            cause: ("no load and no gravity acts at the time `start`, so a load factor has no effect"),
            remedy: "specify loads that are not zero there",
            meaning: "No load acts at the time `start`, so a load factor has no effect.",
        }
        /// The parameter has no effect.
        NoEffect {
            /// Name of the parameter.
            name: String,
            /// Value of the parameter at the start.
            value: f64,
        } => "path-without-effect" {
            cause: ("a small change of `{name}` does not change the equilibrium at {value}, where the path starts, so there is no path \
                    along it"),
            remedy: "vary a number that forces, stiffnesses or lengths depend on",
            meaning: "The varied number does not change the equilibrium.",
        }
        /// The value at the start of the path is invalid.
        NoSystem {
            /// Name of the parameter.
            name: String,
            /// Value of the parameter.
            value: f64,
            /// The reason.
            problem: String,
        } => "path-without-model" {
            cause: ("`{name}` cannot be {value}, where the path starts: {problem}"),
            remedy: "start the path at another value",
            meaning: "The model is not valid at the value at which the path begins.",
        }
        /// The parameter has no valid values beyond the last equilibrium.
        Beyond {
            /// Name of the parameter.
            name: String,
            /// Value of the parameter at the last equilibrium.
            value: f64,
            /// Length of the path up to there.
            arc: f64,
            /// Why the model is invalid beyond.
            problem: String,
        } => "path-leaves-model" {
            cause: ("the path ends at {name} {value}, {arc:.3e} along it: the model is invalid beyond ({problem})"),
            remedy: "end the path before that value, or follow it in the opposite direction",
            meaning: "The model is not valid beyond the reported value of the varied number.",
        }
        /// No step has a solution, however short.
        Lost {
            /// Name of the path parameter.
            name: String,
            /// Load factor of the last equilibrium.
            load_factor: f64,
            /// Length of the path up to there.
            arc: f64,
            /// Failure of the last attempt.
            error: StepError,
        } => "path-lost" {
            cause: ("the path ends at {name} {load_factor}, {arc:.3e} along it: no equilibrium is found nearby ({error})"),
            remedy: "",
            meaning: "No equilibrium was found near the last one, however short the step.",
            advice: "See the failure in parentheses; try a smaller first `step`.",
        }
        /// A path along the load factor does not leave the unloaded model.
        NothingResists {
            /// Steps taken.
            steps: usize,
            /// Load factor reached.
            load_factor: f64,
            /// Largest load factor so far.
            most: f64,
            /// Why it was not exceeded.
            reason: String,
        } => "path-without-resistance" {
            cause: ("after {steps} steps the load factor is {load_factor} and has never been larger than {most:.1e} ({reason}): \
                    small loads meet almost no resistance, as in a cable without tension"),
            remedy: "apply tension, follow a path along a number of the loaded model (`vary`), whose first equilibrium is found by \
                relaxation, or use \
                a smaller first `step`",
            meaning: "Small loads meet almost no resistance, as in a cable without tension.",
        }
        /// The path has fewer bifurcations than the number of the requested one.
        NoBifurcation {
            /// Name of the path parameter.
            name: String,
            /// Steps taken.
            steps: usize,
            /// Load factor reached.
            load_factor: f64,
            /// Bifurcations passed.
            met: usize,
            /// Number of the requested bifurcation.
            wanted: usize,
        } => "path-without-bifurcation" {
            cause: ("after {steps} steps the {name} is {load_factor}, and the path has met {met} bifurcation(s), not the {wanted} that \
                    `branch` requests"),
            remedy: "set more `steps`, a smaller first `step`, or another `branch`",
            meaning: "The path has met fewer bifurcations than `branch` requests.",
        }
        /// No branch was found at a bifurcation.
        NoBranchThere {
            /// Name of the path parameter.
            name: String,
            /// Load factor of the bifurcation.
            load_factor: f64,
            /// Result of the attempts.
            reason: String,
        } => "path-without-branch" {
            cause: ("no branch is found at the bifurcation at {name} {load_factor}: {reason}"),
            remedy: "disturb the model slightly, so that its path continues on a branch, or omit `branch`",
            meaning: "No branch was found at the bifurcation.",
        }
        /// The maximum number of steps is reached.
        TooManySteps {
            /// Name of the path parameter.
            name: String,
            /// Steps taken.
            steps: usize,
            /// Load factor reached.
            load_factor: f64,
            /// Load factor at the end of the path.
            end: f64,
        } => "path-too-long" {
            cause: ("after {steps} steps the {name} is {load_factor} and has not reached {end}"),
            remedy: "set more `steps`, or an `end` that the path reaches",
            meaning: "The path has not reached its end in the given number of steps.",
        }
    }
    wraps {
        /// There is no equilibrium at the start of a path along a parameter.
        StartAlong {
            /// Name of the parameter.
            name: String,
            /// Value of the parameter.
            value: f64,
            /// Failure of the search for the equilibrium.
            error: StepError,
        }, { name, value, error } => {
            error.diagnostic().within(&format!("no equilibrium at {name} {value} at the start of the path"))
        },
        /// There is no equilibrium without loads.
        Start(StepError), (error) => {
            error.diagnostic().within("no equilibrium without loads at the start of the path")
        },
    }
}

impl From<&StepError> for Value {
    fn from(error: &StepError) -> Self {
        Self::Text(error.to_string())
    }
}

/// Tangent of the path at an equilibrium.
#[derive(Clone, Debug)]
struct Tangent {
    /// Displacements and multipliers by row, per unit of path length.
    direction: Vec<f64>,
    /// dΛ/ds.
    load_rate: f64,
    /// Largest displacement over the model's length, or rotation, per unit of path length.
    turn: f64,
    /// Number of unstable directions of the equilibrium, from negative pivots.
    unstable: usize,
    /// Quantity that changes sign where the stiffness is singular.
    signature: f64,
}

/// Result of a step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PathStep {
    /// Newton iterations, including those of rejected attempts and of the search for critical points.
    pub iterations: usize,
    /// Rejected attempts.
    pub rejected: usize,
    /// Limit points and bifurcations passed.
    pub critical: Vec<CriticalPoint>,
}

/// An equilibrium path and its present end.
pub struct EquilibriumPath {
    systems: PathSystems,
    settings: PathSettings,
    state: State,
    load_factor: f64,
    arc: f64,
    tangent: Tangent,
    control: ArcControl,
    work: PathWork,
    steps: usize,
    /// Largest magnitude of the load factor so far.
    most: f64,
    /// Bifurcations passed.
    bifurcations: usize,
    /// The bifurcation at which the path has arrived and is to be left.
    branch_point: Option<BranchPoint>,
    is_finished: bool,
}

/// Why a path has no start.
enum NoStart {
    /// No equilibrium was found.
    Failed(StepError),
    /// The path parameter has no effect.
    Nothing,
}

/// A solution: state, load factor, and tangent of the path there.
struct Solution {
    state: State,
    load_factor: f64,
    tangent: Tangent,
    iterations: usize,
}

/// Rejects constraints between velocities.
fn refuse_velocities(system: &System) -> Result<(), PathError> {
    let constraint = system.layout().velocity_rows().next().map(|row| system.layout().subject_of(row));
    constraint.map_or(Ok(()), |constraint| Err(PathError::VelocityConstraint { constraint }))
}

impl EquilibriumPath {
    /// Starts a path: equilibrium at load factor zero near `state`. `unloaded` is `loaded` without gravity and loads.
    ///
    /// # Errors
    /// If there is no such equilibrium, or no load.
    pub fn new(
        unloaded: Arc<System>,
        loaded: Arc<System>,
        state: State,
        settings: PathSettings,
    ) -> Result<Self, PathError> {
        if unloaded.has_signal_feedback() || loaded.has_signal_feedback() {
            return Err(PathError::Feedback {});
        }
        refuse_velocities(&loaded)?;
        if !are_alike(&unloaded, &loaded) {
            return Err(PathError::NotAlike {});
        }
        Self::of_systems(PathSystems::Loads([unloaded, loaded]), 0.0, state, settings).map_err(|failed| {
            match failed {
                NoStart::Failed(error) => PathError::Start(error),
                NoStart::Nothing => PathError::NoLoad {},
            }
        })
    }

    /// Starts a path along the parameter `name` of the systems of `family`: equilibrium near `state` with the value `from` of the
    /// parameter.
    ///
    /// # Errors
    /// If there is no such equilibrium, or the parameter has no effect.
    pub fn along(
        (name, family): (String, Box<dyn Family>),
        from: f64,
        state: State,
        settings: PathSettings,
    ) -> Result<Self, PathError> {
        let systems = PathSystems::of_number(name.clone(), family, [from, settings.end])?;
        if systems.any().has_signal_feedback() {
            return Err(PathError::Feedback {});
        }
        refuse_velocities(systems.any())?;
        Self::of_systems(systems, from, state, settings).map_err(|failed| match failed {
            NoStart::Failed(error) => PathError::StartAlong { name, value: from, error },
            NoStart::Nothing => PathError::NoEffect { name, value: from },
        })
    }

    fn of_systems(
        systems: PathSystems,
        from: f64,
        mut state: State,
        mut settings: PathSettings,
    ) -> Result<Self, NoStart> {
        settings.limits.tolerance = settings.limits.tolerance.min(round_off::ITERATION);
        state.kinematics.stop();
        state.multipliers.fill(0.0);
        let mut violations = vec![0.0; state.multipliers.len()];
        systems.any().violations(&state.kinematics, &mut violations);
        state.violations = violations;
        let work = PathWork::new(&systems, &state, &settings);
        let empty = Tangent { direction: Vec::new(), load_rate: 1.0, turn: 0.0, unstable: 0, signature: 0.0 };
        let mut path = Self {
            systems,
            settings,
            state,
            load_factor: from,
            arc: 0.0,
            tangent: empty,
            control: ArcControl::new(1.0),
            work,
            steps: 0,
            most: 0.0,
            bifurcations: 0,
            branch_point: None,
            is_finished: false,
        };
        let start = path.state.clone();
        let found = path.solve(&start, from, None, Condition::Load(from)).map_err(NoStart::Failed)?;
        path.take(found, 0.0);
        let rate = path.tangent.load_rate.abs();
        if !rate.is_finite() || path.work.load_is_zero() {
            return Err(NoStart::Nothing);
        }
        if (path.tangent.load_rate > 0.0) != (path.settings.first > 0.0) {
            path.tangent.reverse();
        }
        path.control = ArcControl::new(path.settings.first.abs() / rate);
        Ok(path)
    }

    /// The loaded system; along a parameter, that of a value near the last equilibrium's.
    pub fn system(&self) -> &System {
        self.systems.any()
    }

    /// Name of the path parameter.
    pub fn name(&self) -> &str {
        self.systems.name()
    }

    /// The system without gravity and loads; along a number, as [`system`](Self::system).
    pub fn unloaded(&self) -> &System {
        self.systems.unloaded()
    }

    /// The last equilibrium.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Load factor, or value of the parameter, of the last equilibrium.
    pub fn load_factor(&self) -> f64 {
        self.load_factor
    }

    /// Length of the path up to the last equilibrium.
    pub fn arc(&self) -> f64 {
        self.arc
    }

    /// Number of unstable directions of the last equilibrium, from negative pivots. With follower loads only its parity is meaningful.
    pub fn unstable(&self) -> usize {
        self.tangent.unstable
    }

    /// Steps taken.
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Whether the path has reached its end.
    pub fn is_finished(&self) -> bool {
        self.is_finished
    }

    /// Advances to the next equilibrium. On failure the path is unchanged.
    ///
    /// # Errors
    /// If no equilibrium is found nearby, or the maximum number of steps is reached.
    pub fn advance(&mut self) -> Result<PathStep, PathError> {
        let mut report = PathStep::default();
        if self.is_finished {
            return Ok(report);
        }
        if self.steps >= self.settings.most_steps {
            let (steps, load_factor, end) = (self.steps, self.load_factor, self.settings.end);
            let (met, wanted, name) =
                (self.bifurcations, self.settings.branch.number, self.name().to_owned());
            if met < wanted {
                return Err(PathError::NoBifurcation { name, steps, load_factor, met, wanted });
            }
            if let Some(unresisted) = self.unresisted(|| "no more `steps` are allowed".to_owned()) {
                return Err(unresisted);
            }
            return Err(PathError::TooManySteps { name, steps, load_factor, end });
        }
        if let Some(branch_point) = self.branch_point.take() {
            self.switch_branch(&branch_point, &mut report)?;
            return Ok(report);
        }
        loop {
            let size = self.control.propose(self.tangent.turn);
            let error = match self.attempt(size, &mut report) {
                Ok(true) => return Ok(report),
                Ok(false) => None,
                Err(error) => Some(error),
            };
            report.rejected += 1;
            if !self.control.reject(size) {
                let (load_factor, arc, name) = (self.load_factor, self.arc, self.name().to_owned());
                if let Some(problem) = self.systems.problem() {
                    let problem = problem.to_owned();
                    return Err(PathError::Beyond { name, value: load_factor, arc, problem });
                }
                let bent = StepError::NotConverged {
                    time: self.state.kinematics.time,
                    iterations: 0,
                    correction: 0.0,
                    worst: Subject::nameless("the path turns at once"),
                    hint: "use a smaller `step`",
                };
                let error = error.unwrap_or(bent);
                if let Some(unresisted) = self.unresisted(|| error.to_string()) {
                    return Err(unresisted);
                }
                return Err(PathError::Lost { name, load_factor, arc, error });
            }
        }
    }

    /// Error for a path that ends before it has left the unloaded model noticeably.
    fn unresisted(&self, reason: impl Fn() -> String) -> Option<PathError> {
        let is_along_loads = matches!(self.systems, PathSystems::Loads(_));
        (is_along_loads && self.most <= UNRESISTED * self.settings.end.abs()).then(|| {
            PathError::NothingResists {
                steps: self.steps,
                load_factor: self.load_factor,
                most: self.most,
                reason: reason(),
            }
        })
    }

    /// Attempts a step. Returns false if the solution may be on another path.
    fn attempt(&mut self, size: f64, report: &mut PathStep) -> Result<bool, StepError> {
        let start = self.state.clone();
        let (from, end) = (self.load_factor, self.settings.end);
        let mut found = self.solve_along(&start, Condition::Arc(size))?;
        report.iterations += found.iterations;
        // Before the requested bifurcation the load factor may exceed its end value.
        let is_on_branch = self.bifurcations >= self.settings.branch.number;
        let is_last = is_on_branch && (from - end) * (found.load_factor - end) <= 0.0;
        if is_last {
            found = self.solve_along(&start, Condition::Load(end))?;
            report.iterations += found.iterations;
            // There may be several equilibria at this load factor.
            if self.work.length_of_last() > FARTHER * size {
                return Ok(false);
            }
        }
        let cosine = self.work.inner(&self.tangent.direction, &found.tangent.direction);
        let changes = found.tangent.unstable.abs_diff(self.tangent.unstable);
        let turns = found.tangent.load_rate * self.tangent.load_rate < 0.0;
        // A limit point changes the count by one; any other change means that the step contains a bifurcation as well. Along a
        // parameter the stiffness may be independent of it.
        let is_along_loads = matches!(self.systems, PathSystems::Loads(_));
        let are_mixed = changes > 2 || (turns && (changes == 2 || (changes == 0 && is_along_loads)));
        let is_long = self.control.is_long(size);
        if ArcControl::is_too_bent(cosine)
            || (is_long && (are_mixed || self.has_left_the_arc(&found, cosine)))
        {
            return Ok(false);
        }
        let length = self.work.length_of_last();
        let mut critical = Vec::new();
        if turns || changes > 0 {
            critical = self.critical_points(&start, length, &found, &mut report.iterations);
            // A change that no point within the step explains means that the step ended on another path.
            if is_long && critical.iter().any(|point| !point.is_located) {
                return Ok(false);
            }
        }
        if self.stop_at_bifurcation(&start, length, &mut critical)? {
            report.critical = critical;
            self.steps += 1;
            return Ok(true);
        }
        report.critical = critical;
        self.control.accept(size, found.iterations, cosine);
        self.take(found, length);
        self.steps += 1;
        self.is_finished = is_last;
        Ok(true)
    }

    /// Whether the chord of the last solution deviates from the mean of the tangents at its ends, which a smooth path excludes: the
    /// solution may be on another path.
    fn has_left_the_arc(&self, found: &Solution, cosine: f64) -> bool {
        let chord = self.work.total();
        let length = self.work.length_of_last();
        let (own, other) = (&self.tangent.direction, &found.tangent.direction);
        let along = self.work.inner(chord, own) + self.work.inner(chord, other);
        let of_mean = (2.0 + 2.0 * cosine.clamp(-1.0, 1.0)).sqrt();
        ArcControl::is_off_the_arc(along / (length * of_mean), cosine)
    }

    fn take(&mut self, found: Solution, length: f64) {
        let Solution { state, load_factor, tangent, .. } = found;
        (self.state, self.load_factor, self.tangent) = (state, load_factor, tangent);
        self.most = self.most.max(load_factor.abs());
        self.arc += length;
    }

    /// Solves from the present equilibrium along its tangent.
    fn solve_along(&mut self, start: &State, condition: Condition) -> Result<Solution, StepError> {
        let tangent = self.tangent.clone();
        self.solve(start, self.load_factor, Some(&tangent), condition)
    }

    /// Solves at a distance along the tangent. Also returns the softest direction of the stiffness there.
    fn solve_for_mode(&mut self, start: &State, distance: f64) -> Result<(Solution, Vec<f64>), StepError> {
        let found = self.solve_along(start, Condition::Arc(distance))?;
        let mut equations = PathEquations {
            systems: &mut self.systems,
            settings: &self.settings,
            start,
            start_factor: self.load_factor,
            tangent: Some(&self.tangent),
            condition: Condition::Arc(distance),
            work: &mut self.work,
        };
        Ok((found, equations.softest_direction()))
    }

    fn solve(
        &mut self,
        start: &State,
        load_factor: f64,
        tangent: Option<&Tangent>,
        condition: Condition,
    ) -> Result<Solution, StepError> {
        let mut equations = PathEquations {
            systems: &mut self.systems,
            settings: &self.settings,
            start,
            start_factor: load_factor,
            tangent,
            condition,
            work: &mut self.work,
        };
        equations.begin();
        let mut jacobian = JacobianState::default();
        let outcome = newton::solve(&mut equations, &self.settings.limits, &mut jacobian)
            .map_err(|failure| equations.describe(&failure))?;
        equations.finish(outcome.iterations)
    }
}

impl Tangent {
    fn reverse(&mut self) {
        self.load_rate = -self.load_rate;
        for value in &mut self.direction {
            *value = -*value;
        }
    }
}
