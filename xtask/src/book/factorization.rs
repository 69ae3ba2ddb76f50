//! Effects of scaling, augmented term and pivoting on the first tangent of the tip crank.

use std::ops::Range;

use lissom::Model;
use lissom::core::saddle_point::TangentValues;
use lissom::core::scaling::ScalingChoice;
use lissom::core::simulation::{NewtonTrial, Simulation};
use lissom_solver::{FactorError, FactorReport, LinearSolver, Pattern, Scalar, SolverKind, kind};

use super::conditioning::{SCALINGS, simulation};
use super::fragment::Fragment;
use super::numbers::{one, two};
use super::refinement::refined_solution;
use super::{BookError, Studio};

const EXAMPLE: &str = "tip-crank";
/// Number of Newton iterations, far more than convergence requires.
const ITERATIONS: usize = 15;
/// Solvers compared, by name.
const SOLVERS: [&str; 2] = ["sparse", "pivoting"];

/// Combination of scaling, augmented term and solver, and its result: a failure is the name of the unknown at which elimination stops.
pub(super) struct Case {
    pub(super) scaling: &'static str,
    pub(super) augmented: bool,
    pub(super) solver: &'static str,
    pub(super) outcome: Result<Factored, String>,
}

/// Properties of the first factorisation, and accuracy of Newton's method.
#[derive(Debug)]
pub(super) struct Factored {
    /// Ratio of the smallest to the largest pivot.
    pub(super) relative_pivot: f64,
    /// Growth of the entries during elimination.
    pub(super) growth: f64,
    /// Largest error of a coordinate's correction over the largest such correction, for a random solution.
    pub(super) coordinate_error: f64,
    /// Largest error of a multiplier's correction over the largest such correction, for a random solution.
    pub(super) multiplier_error: f64,
    /// Componentwise backward error: the smallest relative change of all entries of matrix and right-hand side for which the computed
    /// solution of that problem is exact [Oettli and Prager 1964]. Scaling of rows and columns does not change it.
    pub(super) backward_error: f64,
    /// Whether iterative refinement converged, so that the errors are known.
    pub(super) errors_known: bool,
    /// Last update relative to the increments of the step [-].
    pub(super) update: f64,
    /// Largest residual of an equation of motion [N, N m].
    pub(super) residual: f64,
    /// Largest violation of a constraint [m, rad].
    pub(super) violation: f64,
}

/// Every combination on the first step of a model with these values: each factors the same tangent, solves the same problem and iterates
/// the same equations.
pub(super) fn study(
    model: &Model,
    example: &'static str,
    set: &[(&str, &str)],
) -> Result<Vec<Case>, BookError> {
    let (simulation, _) = simulation(model, example, set)?;
    let penalty = simulation.settings().scaling.penalty;
    let mut cases = Vec::new();
    for (scaling, _, by, equilibrated) in SCALINGS {
        for augmented in [false, true] {
            for kind in SOLVERS.into_iter().filter_map(kind) {
                let choice = ScalingChoice { by, equilibrated, augmented, penalty };
                let outcome = examine(&simulation, &choice, kind);
                cases.push(Case { scaling, augmented, solver: kind.name, outcome });
            }
        }
    }
    Ok(cases)
}

/// The case of this scaling and solver with the augmented term, if it has factors.
pub(super) fn augmented<'a>(cases: &'a [Case], scaling: &str, solver: &str) -> Option<&'a Factored> {
    let wanted = |case: &&Case| case.augmented && case.solver == solver && case.scaling == scaling;
    cases.iter().find(wanted).and_then(|case| case.outcome.as_ref().ok())
}

fn examine(
    simulation: &Simulation,
    choice: &ScalingChoice,
    kind: &'static SolverKind,
) -> Result<Factored, String> {
    let layout = simulation.system().layout();
    let stopped = |error| {
        layout.name_of(match error {
            FactorError::ZeroPivot { unknown, .. } | FactorError::NotFinite { unknown } => unknown,
            FactorError::Interrupted => 0,
        })
    };
    let trial = simulation.try_newton(choice, kind, ITERATIONS).map_err(stopped)?;
    let structure = simulation.system().structure();
    let mut factored = Factored::of_trial(&trial);
    let ranges = [0..layout.coordinate_count(), layout.multiplier_rows()];
    for tangent in &trial.tangents {
        let (pattern, sizes) = (&structure.pattern, &trial.sizes[..]);
        let result = match tangent {
            TangentValues::Real(values) => {
                factored.add(&mut *(kind.real)(structure), (pattern, values), sizes, &ranges)
            }
            TangentValues::Complex(values) => {
                factored.add(&mut *(kind.complex)(structure), (pattern, values), sizes, &ranges)
            }
        };
        result.map_err(stopped)?;
    }
    Ok(factored)
}

impl Factored {
    /// Results of Newton's method; tangents are to be added.
    pub(super) fn of_trial(trial: &NewtonTrial) -> Self {
        Self {
            relative_pivot: f64::INFINITY,
            growth: 0.0,
            coordinate_error: 0.0,
            multiplier_error: 0.0,
            backward_error: 0.0,
            errors_known: true,
            update: trial.update,
            residual: trial.residual,
            violation: trial.violation,
        }
    }

    /// Factors a matrix and measures the errors for a problem with known solution. The problem is the same in SI whatever the scaling:
    /// each unknown is its entry of `sizes` times a number of order one.
    pub(super) fn add<S: Scalar>(
        &mut self,
        solver: &mut dyn LinearSolver<S>,
        (pattern, values): (&Pattern, &[S]),
        sizes: &[f64],
        [coordinates, multipliers]: &[Range<usize>; 2],
    ) -> Result<(), FactorError> {
        let report: FactorReport = solver.factor(values)?;
        if report.relative_pivot() < self.relative_pivot {
            (self.relative_pivot, self.growth) = (report.relative_pivot(), report.growth);
        }
        let mut seed = 1;
        let mut number = |size: f64| size * random(&mut seed);
        let known: Vec<S> = sizes.iter().map(|&size| S::from_parts(number(size), number(size))).collect();
        let mut right_hand_side = vec![S::zero(); known.len()];
        pattern.multiply(values, &known, &mut right_hand_side);
        let refined = refined_solution(solver, pattern, values, &right_hand_side);
        let largest_of = |values: &[S], range: &Range<usize>| {
            largest(range.clone().map(|row| values[row].magnitude() / sizes[row]))
        };
        let error = |range: &Range<usize>| {
            let solved = largest_of(&refined.solved, range);
            if solved == 0.0 { 0.0 } else { largest_of(&refined.errors, range) / solved }
        };
        let backward = backward_error(pattern, values, &refined.solved, &right_hand_side);
        self.coordinate_error = largest([self.coordinate_error, error(coordinates)]);
        self.multiplier_error = largest([self.multiplier_error, error(multipliers)]);
        self.backward_error = largest([self.backward_error, backward]);
        self.errors_known &= refined.converged;
        Ok(())
    }
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
    largest(rows.map(|((&b, product), terms)| {
        let size = terms.magnitude() + b.magnitude();
        if size == 0.0 { 0.0 } else { (b - product).magnitude() / size }
    }))
}

/// Largest value; not a number if a value is none.
fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |most, value| if value <= most { most } else { value })
}

/// Next number in -1 … 1 of a linear congruential generator [Knuth 1981, section 3.3.4].
fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// Every combination at the step of the model.
pub(super) fn tip_crank(studio: &Studio) -> Result<Fragment, BookError> {
    let mut fragment = Fragment::default();
    let table = study(&studio.example(EXAMPLE)?, EXAMPLE, &[])?;
    let heading = [
        "scaling",
        "augmented",
        "solver",
        "smallest / largest pivot",
        "growth",
        "error of coordinates",
        "error of multipliers",
        "backward error",
        "last update",
        "residual [N]",
        "violation [m]",
    ];
    let rows: Vec<_> = table.iter().map(line).collect();
    fragment.table(&heading, &rows);
    Ok(fragment)
}

fn line(case: &Case) -> Vec<String> {
    let augmented = if case.augmented { "yes" } else { "no" };
    let mut cells = vec![case.scaling.to_owned(), augmented.to_owned(), case.solver.to_owned()];
    match &case.outcome {
        Err(stopped) => {
            cells.push(format!("stops at the {stopped}"));
            cells.resize(11, String::new());
        }
        Ok(factored) => {
            let growth = factored.growth;
            cells.push(one(factored.relative_pivot));
            cells.push(if growth.is_nan() { String::new() } else { two(growth) });
            cells.extend([factored.coordinate_error, factored.multiplier_error].map(|e| error(factored, e)));
            cells.push(one(factored.backward_error));
            cells.extend([factored.update, factored.residual, factored.violation].map(one));
        }
    }
    cells
}

/// An error, with a mark where it is not known for sure.
fn error(factored: &Factored, value: f64) -> String {
    format!("{}{}", if factored.errors_known { "" } else { "~" }, one(value))
}

/// The sparse solver without pivoting at several steps: what is lost without scaling.
pub(super) fn steps(studio: &Studio) -> Result<Fragment, BookError> {
    let model = studio.example(EXAMPLE)?;
    let mut rows = Vec::new();
    for step in ["1e-2", "1e-3", "1e-4", "1e-5", "1e-6", "1e-7"] {
        let table = study(&model, EXAMPLE, &[("analysis.step", step), ("analysis.end", "0.01")])?;
        let mut line = vec![step.to_owned()];
        for scaling in ["none", "physical", "equilibrated"] {
            let [pivot, coordinates, multipliers, update] = sparse(&table, scaling);
            line.extend([pivot, format!("{coordinates}, {multipliers}"), update]);
        }
        rows.push(line);
    }
    let mut fragment = Fragment::default();
    let heading = [
        "h [s]",
        "none: pivots",
        "errors",
        "update",
        "s of (2.6): pivots",
        "errors",
        "update",
        "equilibrated: pivots",
        "errors",
        "update",
    ];
    fragment.table(&heading, &rows);
    Ok(fragment)
}

/// Where Newton's method ends in one step of any size, on three models.
pub(super) fn any_step(studio: &Studio) -> Result<Fragment, BookError> {
    let steps = ["1e-2", "1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8", "1e-9"];
    let examples = ["pendulum", "top", EXAMPLE];
    let mut rows: Vec<Vec<String>> = steps.map(|step| vec![step.to_owned()]).to_vec();
    for example in examples {
        let model = studio.example(example)?;
        for (step, row) in steps.iter().zip(&mut rows) {
            let set = [("analysis.step", *step), ("analysis.end", "0.01")];
            row.extend(attained(&study(&model, example, &set)?));
        }
    }
    let mut fragment = Fragment::default();
    let mut heading = vec!["h [s]".to_owned()];
    for example in examples {
        heading.extend([format!("{example}: residual [N]"), "violation [m]".to_owned()]);
    }
    let heading: Vec<&str> = heading.iter().map(String::as_str).collect();
    fragment.table(&heading, &rows);
    Ok(fragment)
}

/// Residual and violation of the combination that runs use.
fn attained(table: &[Case]) -> [String; 2] {
    match augmented(table, "equilibrated", "sparse") {
        Some(factored) => [one(factored.residual), one(factored.violation)],
        None => std::array::from_fn(|_| "none".to_owned()),
    }
}

/// Pivot ratio, errors of coordinates and multipliers and last update of the augmented, sparse combination.
fn sparse(table: &[Case], scaling: &str) -> [String; 4] {
    let Some(factored) = augmented(table, scaling, "sparse") else {
        return std::array::from_fn(|_| "none".to_owned());
    };
    [
        one(factored.relative_pivot),
        error(factored, factored.coordinate_error),
        error(factored, factored.multiplier_error),
        one(factored.update),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_the_augmented_term_elimination_stops_at_the_massless_rotation() {
        // With the penalty of the source's order, for which pivots do not grow.
        let model = Studio::silent().example(EXAMPLE).unwrap();
        let cases = study(&model, EXAMPLE, &[("analysis.penalty", "1")]).unwrap();
        assert_eq!(cases.len(), SCALINGS.len() * 2 * SOLVERS.len());
        for case in &cases {
            let name = format!("{} {} {}", case.scaling, case.augmented, case.solver);
            match (&case.outcome, case.augmented || case.solver == "pivoting") {
                (Err(stopped), false) => {
                    assert_eq!(stopped, "multiplier of joint `G` (rotation 3)");
                }
                (Ok(found), true) => {
                    assert!(
                        found.update < 1e-7 && found.residual < 1e-4 && found.violation < 1e-15,
                        "{name}: {found:?}"
                    );
                    assert!(found.errors_known, "{name}");
                    if case.scaling == "none" {
                        assert!(found.relative_pivot < 1e-15, "{name}: {found:?}");
                    } else {
                        assert!(found.relative_pivot > 1e-10, "{name}: {found:?}");
                        assert!(
                            found.coordinate_error < 1e-7 && found.multiplier_error < 1e-12,
                            "{name}: {found:?}"
                        );
                    }
                    assert!(case.solver == "pivoting" || found.growth < 10.0, "{name}: {found:?}");
                }
                (outcome, _) => panic!("{name}: {outcome:?}"),
            }
        }
    }

    #[test]
    fn one_step_of_any_size_is_solved_to_round_off() {
        let studio = Studio::silent();
        // Bounds are a few roundings of the largest forces: a weight, a top's gyroscopic moment, a strip's EA.
        for (example, bound) in [("pendulum", 1e-14), ("top", 2e-11), (EXAMPLE, 3e-5)] {
            let model = studio.example(example).unwrap();
            for step in ["1e-2", "1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8", "1e-9"] {
                let cases = study(&model, example, &[("analysis.step", step)]).unwrap();
                let found = augmented(&cases, "equilibrated", "sparse").unwrap();
                assert!(found.residual < bound && found.violation < 1e-15, "{example} {step}: {found:?}");
            }
        }
    }
}
