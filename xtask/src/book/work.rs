//! Work against error: steps chosen by their error beside steps of one size, for all schemes.

use std::time::Duration;

use lissom::{Model, Override};
use lissom_model::output::Record;

use super::fragment::Fragment;
use super::numbers::one;
use super::{BookError, Studio};
use crate::bench::processor_time;

/// A mass between two springs that are nearly in line and snap through under a load that grows.
const SNAP_THROUGH: &str = r#"
lissom = 1
[bodies.mass]
mass = 1
inertia = [1e-3, 1e-3, 1e-3]
position = [0, 0, 0.1]
[joints.guide]
kind = "prismatic"
base = "ground"
tip = "mass"
at = [0, 0, 0.1]
axis = [0, 0, 1]
[springs.left]
kind = "point"
base = "ground"
tip = "mass"
at_base = [-1, 0, 0]
stiffness = 1e5
damping = 30
[springs.right]
kind = "point"
base = "ground"
tip = "mass"
at_base = [1, 0, 0]
stiffness = 1e5
damping = 30
[loads.weight]
kind = "force"
on = "mass"
vector = [0, 0, -60]
scale = "t"
[outputs.mass]
kind = "position"
of = "mass"
[analysis]
kind = "dynamics"
end = 2
step = 1e-3
"#;

/// A model whose error is measured at records.
struct Problem {
    title: &'static str,
    /// Below the project's folder; or the model's text.
    path: Result<&'static str, &'static str>,
    end: f64,
    /// Time from record to record [s].
    record: f64,
    /// Names of the outputs whose values are compared, and of their components, all where none is given.
    outputs: &'static [&'static str],
    components: &'static [&'static str],
    /// Steps of one size between two records.
    steps: &'static [usize],
    tolerances: &'static [f64],
    /// Tolerance of the run that others are compared with.
    reference: f64,
}

const TOLERANCES: &[f64] = &[1e-3, 1e-4, 1e-5, 1e-6];

const PROBLEMS: &[Problem] = &[
    Problem {
        title: "Andrews' mechanism",
        path: Ok("benches/scenes/andrews.toml"),
        end: 0.03,
        record: 1.5e-3,
        outputs: &["beta", "theta", "gamma", "delta", "phi", "epsilon", "omega"],
        components: &["angle"],
        steps: &[8, 12, 16, 24, 32, 48, 64, 96, 128, 256, 512, 1024],
        tolerances: TOLERANCES,
        reference: 1e-8,
    },
    Problem {
        title: "car axis",
        path: Ok("verification/car-axis/model.toml"),
        end: 3.0,
        record: 0.15,
        outputs: &["left", "right"],
        components: &["x", "y"],
        steps: &[8, 16, 32, 64, 128, 256, 512, 1024],
        tolerances: TOLERANCES,
        reference: 1e-8,
    },
    Problem {
        title: "two four-bars",
        path: Ok("verification/four-bar-n2/model.toml"),
        end: 2.0,
        record: 0.1,
        outputs: &["B"],
        components: &[],
        steps: &[4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048],
        tolerances: TOLERANCES,
        // All bars lie in one line once: round-off decides there which runs at 1e-8 come through.
        reference: 3e-8,
    },
    Problem {
        title: "tip crank",
        path: Ok("examples/tip-crank.toml"),
        end: 0.4,
        record: 0.01,
        outputs: &["midspan"],
        components: &[],
        steps: &[4, 8, 16, 32, 64, 128, 256],
        tolerances: &[1e-2, 1e-3, 1e-4, 1e-5],
        reference: 1e-6,
    },
    Problem {
        title: "right-angle cantilever",
        path: Ok("verification/right-angle-cantilever/model.toml"),
        end: 30.0,
        record: 0.5,
        outputs: &["tip"],
        components: &[],
        steps: &[2, 4, 8, 16, 32, 64, 128, 256],
        tolerances: TOLERANCES,
        reference: 1e-8,
    },
    Problem {
        title: "snap-through",
        path: Err(SNAP_THROUGH),
        end: 2.0,
        record: 0.1,
        outputs: &["mass"],
        components: &["z"],
        steps: &[8, 16, 32, 64, 128, 256, 512, 1024, 2048],
        tolerances: TOLERANCES,
        reference: 1e-9,
    },
    Problem {
        title: "bouncing mass",
        path: Ok("examples/bouncing-mass.toml"),
        end: 1.0,
        record: 0.05,
        outputs: &["guide"],
        components: &["displacement"],
        steps: &[64, 256, 1024, 4096, 16384],
        tolerances: TOLERANCES,
        reference: 1e-9,
    },
];

const SCHEMES: [&str; 4] = ["radau-iia", "energy-decaying", "generalized-alpha", "hht"];

/// Result of a run.
struct Run {
    values: Vec<f64>,
    steps: usize,
    iterations: usize,
    busy: Duration,
}

/// The table of all problems.
pub(super) fn table(studio: &Studio) -> Result<Fragment, BookError> {
    let mut fragment = Fragment::default();
    let planned = PROBLEMS.len() * SCHEMES.len();
    let mut rows = Vec::new();
    for (index, problem) in PROBLEMS.iter().enumerate() {
        let reference = problem.controlled(studio, SCHEMES[0], problem.reference)?;
        let reference = reference.ok_or_else(|| problem.fail("the reference has no solution"))?.values;
        for (further, scheme) in SCHEMES.iter().enumerate() {
            studio.show(index * SCHEMES.len() + further, planned);
            let mut fixed = Vec::new();
            for &steps in problem.steps {
                let Some(run) = problem.planned(studio, scheme, steps)? else { continue };
                fixed.push((distance(&run.values, &reference), run));
            }
            for &tolerance in problem.tolerances {
                let mut row =
                    vec![problem.title.to_owned(), (*scheme).to_owned(), format!("{tolerance:.0e}")];
                match problem.controlled(studio, scheme, tolerance)? {
                    Some(run) => row.extend(beside(&run, distance(&run.values, &reference), &fixed)),
                    None => row.push("no solution".to_owned()),
                }
                rows.push(row);
            }
        }
    }
    let heading = ["problem", "scheme", "τ", "error", "steps", "iterations", "time [ms]"];
    let beside = ["steps of one size", "iterations ×", "time ×"];
    fragment.table(&[&heading[..], &beside[..]].concat(), &rows);
    Ok(fragment)
}

/// The cells of an adaptive run, and of the cheapest run with constant steps that is as accurate. The cost of the latter is
/// interpolated between two runs, by powers of the error.
fn beside(run: &Run, error: f64, fixed: &[(f64, Run)]) -> Vec<String> {
    let milliseconds = |run: &Run| 1e3 * run.busy.as_secs_f64();
    let mut cells = vec![
        one(error),
        run.steps.to_string(),
        run.iterations.to_string(),
        format!("{:.1}", milliseconds(run)),
    ];
    let Some(good) = fixed.iter().position(|(other, _)| *other <= error) else {
        return [cells, vec!["none so good".to_owned(), String::new(), String::new()]].concat();
    };
    let between = |of: &dyn Fn(&Run) -> f64| {
        let (found, last) = (of(&fixed[good].1), good.checked_sub(1).map(|before| &fixed[before]));
        let Some((worse, before)) = last else { return found };
        let share = (error / fixed[good].0).ln() / (worse / fixed[good].0).ln();
        if share.is_finite() { found * (of(before) / found).powf(share) } else { found }
    };
    let steps = between(&|run| run.steps as f64);
    let iterations = run.iterations as f64 / between(&|run| run.iterations as f64);
    let time = milliseconds(run) / between(&milliseconds);
    cells.extend([format!("{steps:.0}"), format!("{iterations:.2}"), format!("{time:.2}")]);
    cells
}

fn distance(values: &[f64], reference: &[f64]) -> f64 {
    values.iter().zip(reference).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()))
}

/// Newton's tolerance where a model names none; these do.
fn newton(scheme: &str, usual: f64) -> String {
    let registry = lissom_model::lower::registry::registry();
    let kind = registry.schemes.iter().find(|kind| kind.name == scheme);
    format!("{:e}", kind.and_then(|kind| kind.tolerance).unwrap_or(usual))
}

impl Problem {
    fn fail(&self, reason: &str) -> BookError {
        BookError::Run { example: self.title, reason: reason.to_owned() }
    }

    fn planned(&self, studio: &Studio, scheme: &str, steps: usize) -> Result<Option<Run>, BookError> {
        let size = self.record / steps as f64;
        let settings = [
            ("step", format!("{size:e}")),
            ("output_every", steps.to_string()),
            // The default; models of the verification require more.
            ("tolerance", newton(scheme, 1e-8)),
        ];
        self.run(studio, scheme, &settings)
    }

    fn controlled(&self, studio: &Studio, scheme: &str, tolerance: f64) -> Result<Option<Run>, BookError> {
        let first = 1e-4 * self.end;
        let settings = [
            ("relative_tolerance", format!("{tolerance:e}")),
            ("output_step", format!("{:e}", self.record)),
            ("step", format!("{first:e}")),
            ("tolerance", newton(scheme, 1e-2 * tolerance)),
        ];
        self.run(studio, scheme, &settings)
    }

    /// A run with these settings of the analysis, if it has a solution.
    fn run(
        &self,
        studio: &Studio,
        scheme: &str,
        settings: &[(&str, String)],
    ) -> Result<Option<Run>, BookError> {
        let model = match self.path {
            Ok(path) => Model::read(&studio.root.join(path))?,
            Err(text) => Model::from_text(self.title, text),
        };
        let mut overrides: Vec<Override> = Vec::new();
        let mut set = |key: &str, value: &str| overrides.push((format!("analysis.{key}"), value.to_owned()));
        set("scheme", scheme);
        set("end", &format!("{:e}", self.end));
        for (key, value) in settings {
            set(key, value);
        }
        let mut session =
            model.with_overrides(&overrides).session().map_err(|error| self.fail(&error.to_string()))?;
        let before = processor_time();
        let (record, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
        let busy =
            processor_time().zip(before).map_or(report.solving, |(now, then)| now.saturating_sub(then));
        if report.error().is_some() {
            return Ok(None);
        }
        Ok(Some(Run {
            values: self.values(&record),
            steps: report.totals.steps + report.totals.rejected_steps,
            iterations: report.totals.newton_iterations,
            busy,
        }))
    }

    /// The values that are compared, at the times of the records.
    fn values(&self, record: &Record) -> Vec<f64> {
        let is_meant = |output: &str, component: &str| {
            self.outputs.contains(&output)
                && (self.components.is_empty() || self.components.contains(&component))
        };
        let rows: Vec<usize> = (0..record.times.len())
            .filter(|&row| {
                let records = record.times[row] / self.record;
                (records - records.round()).abs() < 1e-6
            })
            .collect();
        let columns = record.columns.iter().zip(&record.values);
        columns
            .filter(|(column, _)| is_meant(&column.output, &column.component))
            .flat_map(|(_, values)| rows.iter().map(|&row| values[row]))
            .collect()
    }
}
