//! Cost of elimination without pivoting beside elimination with it, on tangents of models of several sizes.

use std::time::{Duration, Instant};

use lissom::Model;
use lissom::core::saddle_point::TangentValues;
use lissom_solver::{LinearSolver, Scalar, SolverKind, Structure, kind};

use super::conditioning::simulation;
use super::factorization::Factored;
use super::fragment::Fragment;
use super::numbers::{one, two};
use super::{BookError, Studio};

/// Solvers compared, by name: without pivoting, and with it.
const SOLVERS: [&str; 2] = ["sparse", "pivoting"];
/// Time spent on each measurement.
const PATIENCE: Duration = Duration::from_millis(100);

/// Name, model, and the value that makes it larger, with its path.
type Family = (&'static str, &'static str, &'static str, &'static [&'static str]);
/// A chain of nodes, and a net of them.
const FAMILIES: [Family; 2] = [
    ("tip crank", "examples/tip-crank.toml", "beams.beam.elements", &["8", "80", "800"]),
    ("sheet", "xtask/src/book/sheet.toml", "shells.sheet.divisions", &["[4,4]", "[12,12]", "[36,36]"]),
];
/// Schemes with a real tangent, and with a complex one as well.
const SCHEMES: [&str; 2] = ["generalized-alpha", "radau-iia"];

/// A tangent, factored by both solvers.
pub(super) struct Compared {
    pub(super) family: &'static str,
    pub(super) scheme: &'static str,
    pub(super) unknowns: usize,
    /// Seconds of a factorisation and a solve, by solver.
    pub(super) seconds: [f64; 2],
    /// Stored numbers, by solver.
    pub(super) entries: [usize; 2],
    /// Growth of entries without pivoting.
    pub(super) growth: f64,
    /// Componentwise backward error, by solver.
    pub(super) backward_error: [f64; 2],
}

/// The first tangents of all models.
pub(super) fn compared(studio: &Studio) -> Result<Vec<Compared>, BookError> {
    let mut all = Vec::new();
    for (family, path, value, sizes) in FAMILIES {
        let model = Model::read(&studio.root.join(path))?;
        for (scheme, size) in SCHEMES.iter().flat_map(|scheme| sizes.iter().map(move |size| (scheme, size))) {
            all.push(compare(&model, (family, scheme), (value, size))?);
        }
    }
    Ok(all)
}

fn compare(
    model: &Model,
    (family, scheme): (&'static str, &'static str),
    set: (&str, &str),
) -> Result<Compared, BookError> {
    let (simulation, _) = simulation(model, family, &[("analysis.scheme", scheme), set])?;
    let (system, choice) = (simulation.system(), simulation.settings().scaling);
    let (structure, layout) = (system.structure(), system.layout());
    let kinds: Vec<&SolverKind> = SOLVERS.into_iter().filter_map(kind).collect();
    let trial =
        simulation.try_newton(&choice, simulation.settings().solver, 1).map_err(BookError::run(family))?;
    let ranges = [0..layout.coordinate_count(), layout.multiplier_rows()];
    let mut compared = Compared {
        family,
        scheme,
        unknowns: layout.size(),
        seconds: [0.0; 2],
        entries: [0; 2],
        growth: 0.0,
        backward_error: [0.0; 2],
    };
    for (index, kind) in kinds.into_iter().enumerate() {
        let mut factored = Factored::of_trial(&trial);
        for tangent in &trial.tangents {
            let pattern = &structure.pattern;
            let (seconds, entries) = match tangent {
                TangentValues::Real(values) => {
                    let mut solver = (kind.real)(structure);
                    let added = factored.add(&mut *solver, (pattern, values), &trial.sizes, &ranges);
                    added.map_err(BookError::run(family))?;
                    cost(&mut *solver, structure, values)
                }
                TangentValues::Complex(values) => {
                    let mut solver = (kind.complex)(structure);
                    let added = factored.add(&mut *solver, (pattern, values), &trial.sizes, &ranges);
                    added.map_err(BookError::run(family))?;
                    cost(&mut *solver, structure, values)
                }
            };
            compared.seconds[index] += seconds;
            compared.entries[index] += entries;
        }
        compared.backward_error[index] = factored.backward_error;
        if index == 0 {
            compared.growth = factored.growth;
        }
    }
    Ok(compared)
}

/// Shortest time of a factorisation and a solve [s], which other work on the machine does not disturb, and stored numbers.
fn cost<S: Scalar>(solver: &mut dyn LinearSolver<S>, structure: &Structure, values: &[S]) -> (f64, usize) {
    let mut vector = vec![S::one(); structure.pattern.size()];
    let (began, mut shortest, mut runs) = (Instant::now(), f64::INFINITY, 0);
    while runs < 3 || began.elapsed() < PATIENCE {
        let start = Instant::now();
        vector.fill(S::one());
        // It was factored before.
        if solver.factor(values).is_ok() {
            solver.solve(&mut vector);
        }
        shortest = shortest.min(start.elapsed().as_secs_f64());
        runs += 1;
    }
    (shortest, solver.factor_entries())
}

/// All models, with both solvers.
pub(super) fn table(studio: &Studio) -> Result<Fragment, BookError> {
    let mut fragment = Fragment::default();
    let heading = [
        "model",
        "scheme",
        "unknowns",
        "numbers stored: sparse",
        "pivoting",
        "factorisation and solve [ms]: sparse",
        "pivoting",
        "ratio",
        "growth: sparse",
        "backward error: sparse",
        "pivoting",
    ];
    let rows: Vec<Vec<String>> = compared(studio)?
        .iter()
        .map(|compared| {
            let [ours, other] = compared.seconds;
            vec![
                compared.family.to_owned(),
                compared.scheme.to_owned(),
                compared.unknowns.to_string(),
                compared.entries[0].to_string(),
                compared.entries[1].to_string(),
                two(1e3 * ours),
                two(1e3 * other),
                two(other / ours),
                two(compared.growth),
                one(compared.backward_error[0]),
                one(compared.backward_error[1]),
            ]
        })
        .collect();
    fragment.table(&heading, &rows);
    Ok(fragment)
}
