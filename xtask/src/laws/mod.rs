//! `cargo xtask laws`: random laws with narrow features, jumps and kinks through the same path as a user's model file, with default
//! settings, against references that resolve them. A seed determines every case.

mod model;
mod reference;

use std::path::PathBuf;
use std::time::Instant;

use lissom::Model;
use model::Case;
use reference::{Reference, reference};

use crate::cases::results;

/// The default tolerance of adaptive steps.
const DEFAULT: f64 = 1e-5;
/// What is tried.
#[derive(clap::Args)]
pub(crate) struct LawsArguments {
    /// Laws to try
    #[arg(long, default_value_t = 200)]
    count: u64,
    /// Seed of all
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Number of the first law
    #[arg(long, default_value_t = 0)]
    first: u64,
    /// Relative tolerance of the steps; default that of the program
    #[arg(long)]
    tolerance: Option<f64>,
    /// Errors of up to this multiple of the tolerance are accurate
    #[arg(long, default_value_t = 10.0)]
    within: f64,
    /// Laws that run at the same time
    #[arg(long, default_value_t = 2)]
    threads: usize,
    /// Folder for the models with wrong results
    #[arg(long, default_value = "out/laws")]
    keep: PathBuf,
    /// Print the text of the first law, and try nothing
    #[arg(long)]
    text: bool,
}

/// Result of a case.
enum Outcome {
    /// Accurate and without a warning.
    Accurate { error: f64, steps: usize },
    /// Reported by a warning or an error.
    Reported { error: Option<f64>, words: String },
    /// Inaccurate by no more than the motion amplifies changes of its start.
    Sensitive { error: f64, growth: f64 },
    /// Inaccurate and not reported; with the growth of changes of its start.
    Wrong { error: f64, growth: f64 },
    /// No reference was found.
    Unknown,
}

/// Tries laws; whether none ended well with a wrong result.
///
/// # Errors
/// If a model cannot be kept.
pub(crate) fn laws(arguments: &LawsArguments) -> std::io::Result<bool> {
    let analysis =
        arguments.tolerance.map_or(String::new(), |value| format!("relative_tolerance = {value}\n"));
    if arguments.text {
        print!("{}", Case::new(arguments.seed, arguments.first).text(&analysis));
        return Ok(true);
    }
    let began = Instant::now();
    let tolerance = arguments.tolerance.unwrap_or(DEFAULT);
    let allowed = arguments.within * tolerance;
    let range = arguments.first..arguments.first.saturating_add(arguments.count);
    let found = results(range, arguments.threads, None, |index| {
        trial(&Case::new(arguments.seed, index), &analysis, [tolerance, allowed])
    });
    let (mut errors, mut false_alarms, mut reported, mut sensitive) = (Vec::new(), 0, 0, 0);
    let (mut wrong, mut unknown) = (0, 0);
    let mut most_steps = 0;
    for (index, outcome) in &found {
        let case = Case::new(arguments.seed, *index);
        let what = format!("{index}: {} in {:?}", case.kind, case.holder);
        match outcome {
            Outcome::Accurate { error, steps } => {
                errors.push(*error);
                most_steps = most_steps.max(*steps);
            }
            Outcome::Reported { error, words } => {
                reported += 1;
                false_alarms += usize::from(error.is_some_and(|error| error <= allowed));
                println!(
                    "{what}: reported, {}: {words}",
                    error.map_or("no result".to_owned(), |e| format!("{e:.1e}"))
                );
            }
            Outcome::Sensitive { error, growth } => {
                sensitive += 1;
                println!("{what}: sensitive, {error:.1e}; a change of the start grows by {growth:.1}");
            }
            Outcome::Wrong { error, growth } => {
                wrong += 1;
                println!(
                    "{what}: errs by {error:.1e} without a warning; a change of the start grows by {growth:.1}"
                );
                std::fs::create_dir_all(&arguments.keep)?;
                let path = arguments.keep.join(format!("{}-{index}.toml", arguments.seed));
                std::fs::write(path, case.text(&analysis))?;
            }
            Outcome::Unknown => unknown += 1,
        }
    }
    errors.sort_by(f64::total_cmp);
    let median = errors.get(errors.len() / 2).copied().unwrap_or_default();
    let largest = errors.last().copied().unwrap_or_default();
    println!(
        "{} laws of seed {} in {:.0} s: {} accurate (median {median:.1e}, largest {largest:.1e}, up to {most_steps} steps), {sensitive} sensitive, {reported} \
         reported, of which {false_alarms} are accurate, {unknown} without a reference, {wrong} wrong",
        found.len(),
        arguments.seed,
        began.elapsed().as_secs_f64(),
        errors.len(),
    );
    Ok(wrong == 0)
}

/// Runs a case, and compares its end with the reference.
fn trial(case: &Case, analysis: &str, [tolerance, allowed]: [f64; 2]) -> Outcome {
    let Some(exact) = reference(case, 1.0) else { return Outcome::Unknown };
    let text = case.text(analysis);
    let mut session = match Model::from_text("model.toml", &text).session() {
        Ok(session) => session,
        Err(error) => return Outcome::Reported { error: None, words: error.to_string() },
    };
    let (_, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    if !report.is_complete() {
        return Outcome::Reported { error: None, words: format!("{:?}", report.stopped) };
    }
    let value = |name: &str| session.value(name).unwrap_or(f64::NAN);
    let miss = |k: usize, name: &str| (value(name) - exact.end[k]).abs() / exact.largest[k];
    let error = miss(0, "s.displacement").max(miss(1, "s.velocity"));
    let error = if error.is_nan() { f64::INFINITY } else { error };
    if let Some(warning) = session.warnings().next() {
        return Outcome::Reported { error: Some(error), words: warning.code().to_owned() };
    }
    if error <= allowed {
        return Outcome::Accurate { error, steps: session.simulation().totals().steps };
    }
    // By how much the motion amplifies a change of its initial velocity by the tolerance.
    let changed = reference(case, 1.0 + tolerance);
    let change = |of: &Reference, k: usize| (of.end[k] - exact.end[k]).abs() / exact.largest[k] / tolerance;
    let growth = changed.map_or(f64::INFINITY, |of| change(&of, 0).max(change(&of, 1)));
    if error <= allowed * growth {
        Outcome::Sensitive { error, growth }
    } else {
        Outcome::Wrong { error, growth }
    }
}
