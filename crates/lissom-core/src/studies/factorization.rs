//! Effect of scaling, augmented term and pivoting on the first step: every combination factors the same tangent, solves the same
//! problem and iterates the same equations.

use lissom_solver::{FactorError, FactorReport, LinearSolver, Pattern, Scalar, SolverKind, refined_solution};

use crate::integrator::equations::StepEquations;
use crate::integrator::workspace::Workspace;
use crate::kinematics::Layout;
use crate::newton::Equations;
use crate::saddle_point::stage_tangents::{FactoredSystem, StageTangents};
use crate::scaling::{ScaleBy, Scaled, ScalingChoice};
use crate::settings::Unwatched;
use crate::simulation::Simulation;

/// Number of Newton iterations, far more than convergence requires.
pub const ITERATIONS: usize = 15;

/// Solvers compared, by name.
pub const SOLVERS: [&str; 3] = ["skyline", "sparse", "pivoting"];

/// Combination of scaling, augmented term and solver.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// Scaling of the equations.
    pub scaling: ScaleBy,
    /// Whether the scaled tangent is also equilibrated.
    pub equilibrated: bool,
    /// Whether the augmented term is included.
    pub augmented: bool,
    /// Name of the solver.
    pub solver: &'static str,
    /// Result of the factorisation.
    pub outcome: Result<Factored, Stopped>,
}

/// Failure of the first factorisation.
#[derive(Clone, Debug, PartialEq)]
pub struct Stopped {
    /// Name of the unknown at which elimination stops.
    pub unknown: String,
    /// Error of the factorisation.
    pub error: FactorError,
}

/// Properties of the first factorisation, and its result.
#[derive(Clone, Debug, PartialEq)]
pub struct Factored {
    /// Pivots and growth.
    pub report: FactorReport,
    /// Name of the unknown with the smallest pivot.
    pub smallest_pivot: String,
    /// Largest error of a coordinate's correction over the largest such correction, for a random solution.
    pub coordinate_error: f64,
    /// Largest error of a multiplier over the largest multiplier.
    pub multiplier_error: f64,
    /// Componentwise backward error: the smallest relative change of all entries of matrix and right-hand side for which the computed
    /// solution of that problem is exact [Oettli and Prager 1964]. Scaling of rows and columns does not change it.
    pub backward_error: f64,
    /// Whether iterative refinement converged, so that the errors are known.
    pub errors_known: bool,
    /// Accuracy attained by Newton's method.
    pub newton: Attained,
}

/// Accuracy of Newton's method after [`ITERATIONS`] iterations, each with a new tangent.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attained {
    /// Iterations made.
    pub iterations: usize,
    /// Last update relative to the increments of the step [-].
    pub update: f64,
    /// Largest residual of an equation of motion [N, N m].
    pub residual: f64,
    /// Largest violation of a constraint [m, rad].
    pub violation: f64,
    /// Name of the unknown at which the factorisation of a later tangent stopped.
    pub stopped_at: Option<String>,
}

/// Evaluates all combinations on the next step of `simulation`, which is not changed.
pub fn factorization_study(simulation: &Simulation) -> Vec<Case> {
    let penalty = simulation.settings().scaling.penalty;
    let mut cases = Vec::new();
    let scalings = [
        (ScaleBy::None, false),
        (ScaleBy::Unit, false),
        (ScaleBy::Physical, false),
        (ScaleBy::Physical, true),
    ];
    for (scaling, equilibrated) in scalings {
        for augmented in [false, true] {
            for kind in SOLVERS.iter().filter_map(|name| lissom_solver::kind(name)) {
                let choice = ScalingChoice { by: scaling, equilibrated, augmented, penalty };
                let outcome = examine(simulation, &choice, kind);
                cases.push(Case { scaling, equilibrated, augmented, solver: kind.name, outcome });
            }
        }
    }
    cases
}

fn examine(
    simulation: &Simulation,
    choice: &ScalingChoice,
    kind: &'static SolverKind,
) -> Result<Factored, Stopped> {
    let (system, state, settings) = (simulation.system(), simulation.state(), simulation.settings());
    let representative = simulation.representative();
    let layout = system.layout();
    let equilibrated = choice.equilibrates();
    let mut work = Workspace::new(
        (system, state),
        &settings.scheme,
        (representative, simulation.redundancy().clone()),
        (kind, equilibrated),
    );
    let scaled = Scaled::new(choice, representative, settings.step_size);
    scaled.to_unit_step(layout, &settings.scheme, state, &mut work.unit);
    system.begin_step(&state.kinematics, &mut work.evaluation.joint_starts);
    let mut equations = StepEquations {
        system,
        scheme: &settings.scheme,
        scaled,
        scaling: (choice, representative),
        start: state,
        work: &mut work,
        watch: &mut Unwatched,
    };
    equations.predict();
    equations.renew_tangent().map_err(|error| stopped(layout, error))?;
    let report = *equations.work.tangent.report().expect("a factorisation that went through has a report");
    let physical = ScalingChoice { by: ScaleBy::Physical, ..*choice };
    let physical = Scaled::new(&physical, representative, settings.step_size);
    let multiplier_size = physical.multiplier_factor() / scaled.multiplier_factor();
    let mut sizes = vec![1.0; layout.size()];
    sizes[layout.coordinate_count()..].fill(multiplier_size);
    if let Some(factors) = equations.work.tangent.row_factors() {
        sizes.iter_mut().zip(factors).for_each(|(size, factor)| *size /= factor);
    }
    let [coordinate_error, multiplier_error, backward_error, known] =
        forward_errors(&mut equations.work.tangent.matrices, &system.pattern(), layout, &sizes);
    Ok(Factored {
        smallest_pivot: layout.name_of(report.smallest_pivot_unknown),
        report,
        coordinate_error,
        multiplier_error,
        backward_error,
        errors_known: known > 0.0,
        newton: iterate(&mut equations),
    })
}

fn stopped(layout: &Layout, error: FactorError) -> Stopped {
    let unknown = match error {
        FactorError::ZeroPivot { unknown, .. } | FactorError::NotFinite { unknown } => unknown,
        FactorError::Interrupted => 0,
    };
    Stopped { unknown: layout.name_of(unknown), error }
}

/// Full Newton's method from the present iterate.
fn iterate(equations: &mut StepEquations<'_>) -> Attained {
    let mut attained = Attained::default();
    while attained.iterations < ITERATIONS {
        // The tangent of the first iteration is already factored.
        if attained.iterations > 0
            && let Err(error) = equations.renew_tangent()
        {
            attained.stopped_at = Some(stopped(equations.system.layout(), error).unknown);
            break;
        }
        let correction = equations.correct();
        attained.iterations += 1;
        let reference = if correction.reference > 0.0 { correction.reference } else { 1.0 };
        attained.update = correction.size / reference;
        if !correction.size.is_finite() {
            break;
        }
    }
    (attained.residual, attained.violation) = residuals(equations);
    attained
}

/// Largest residual of an equation of motion and largest violation over all stages, in SI.
fn residuals(equations: &mut StepEquations<'_>) -> (f64, f64) {
    equations.evaluate();
    let count = equations.system.layout().coordinate_count();
    let (mut motion, mut violation) = (0.0, 0.0);
    for residual in &equations.work.residuals {
        motion = largest(motion, residual[..count].iter().copied());
        violation = largest(violation, residual[count..].iter().copied());
    }
    (motion, violation)
}

/// Like `max`, but keeps NaN.
fn largest(start: f64, values: impl Iterator<Item = f64>) -> f64 {
    values.fold(start, |most, value| if value.abs() <= most { most } else { value.abs() })
}

/// Errors of coordinates and multipliers for a problem with known solution, its backward error, and 1 if the errors are certain. The
/// problem is the same in SI whatever the scaling: each unknown is its entry of `sizes` times a number of order one.
fn forward_errors(
    tangents: &mut StageTangents,
    pattern: &Pattern,
    layout: &Layout,
    sizes: &[f64],
) -> [f64; 4] {
    let of = |system: &mut FactoredSystem| match system {
        FactoredSystem::Real(own) => forward_errors_of(&mut *own.solver, pattern, &own.values, layout, sizes),
        FactoredSystem::Complex(own) => {
            forward_errors_of(&mut *own.solver, pattern, &own.values, layout, sizes)
        }
    };
    let worst = |all: [f64; 4], own: [f64; 4]| {
        let [a, b, c] = std::array::from_fn(|place| largest(all[place], [own[place]].into_iter()));
        [a, b, c, all[3].min(own[3])]
    };
    tangents.systems.iter_mut().map(of).fold([0.0, 0.0, 0.0, 1.0], worst)
}

fn forward_errors_of<S: Scalar>(
    solver: &mut dyn LinearSolver<S>,
    pattern: &Pattern,
    values: &[S],
    layout: &Layout,
    sizes: &[f64],
) -> [f64; 4] {
    let count = layout.coordinate_count();
    let mut seed = 1;
    let known: Vec<S> =
        sizes.iter().map(|size| S::from_parts(size * number(&mut seed), size * number(&mut seed))).collect();
    let mut right_hand_side = vec![S::zero(); known.len()];
    pattern.multiply(values, &known, &mut right_hand_side);
    let refined = refined_solution(solver, pattern, values, &right_hand_side);
    let largest_of = |values: &[S], range: std::ops::Range<usize>| {
        largest(0.0, range.map(|row| values[row].magnitude() / sizes[row]))
    };
    let error = |range: std::ops::Range<usize>| {
        let solved = largest_of(&refined.solved, range.clone());
        if solved == 0.0 { 0.0 } else { largest_of(&refined.errors, range) / solved }
    };
    let backward = backward_error(pattern, values, &refined.solved, &right_hand_side);
    [error(0..count), error(layout.multiplier_rows()), backward, f64::from(u8::from(refined.converged))]
}

/// The largest of |b - A x| / (|A| |x| + |b|) over all rows.
fn backward_error<S: Scalar>(pattern: &Pattern, values: &[S], solved: &[S], right_hand_side: &[S]) -> f64 {
    let absolute = |values: &[S]| -> Vec<S> {
        values.iter().map(|value| S::from_parts(value.magnitude(), 0.0)).collect()
    };
    let (mut product, mut terms) = (vec![S::zero(); solved.len()], vec![S::zero(); solved.len()]);
    pattern.multiply(values, solved, &mut product);
    pattern.multiply(&absolute(values), &absolute(solved), &mut terms);
    let rows = right_hand_side.iter().zip(product).zip(terms);
    let errors = rows.map(|((&b, product), terms)| {
        let size = terms.magnitude() + b.magnitude();
        if size == 0.0 { 0.0 } else { (b - product).magnitude() / size }
    });
    largest(0.0, errors)
}

/// Next number in -1 … 1 of a linear congruential generator [Knuth 1981, section 3.3.4].
fn number(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}
