//! `cargo xtask verify`: finds the cases, runs them side by side, and writes the report.

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use crate::VerifyArguments;
use crate::case::{Case, CaseError};
use crate::outcome::{Outcome, Row, Verdict};
use crate::runs::Runs;
use crate::{compare, curves, digits, invariants, refine, report, stale, warnings};

/// A verification that cannot be carried out.
#[derive(Debug, thiserror::Error)]
pub(crate) enum VerifyError {
    /// A case is wrong.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// There is no such case.
    #[error("there is no case `{0}` in verification/")]
    Unknown(String),
    /// A file cannot be read or written.
    #[error("{path}: {error}")]
    File {
        /// The file or folder.
        path: PathBuf,
        /// The error of the system.
        error: std::io::Error,
    },
}

impl VerifyError {
    /// An error about a file.
    pub(crate) fn file(path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.to_owned();
        move |error| Self::File { path, error }
    }
}

/// The project's folder: that of the run if cargo reports it, otherwise that of the build.
pub(crate) fn root() -> PathBuf {
    let chores =
        std::env::var("CARGO_MANIFEST_DIR").unwrap_or_else(|_| env!("CARGO_MANIFEST_DIR").to_owned());
    Path::new(&chores).parent().map_or_else(PathBuf::new, Path::to_owned)
}

/// Runs the request; whether it succeeded.
pub(crate) fn verify(arguments: &VerifyArguments) -> Result<bool, VerifyError> {
    let began = Instant::now();
    let root = root();
    let folder = root.join("verification");
    let cases = cases(&folder, arguments)?;
    let other_digits = digits::differences(&folder, &cases)?;
    for words in &other_digits {
        println!("DIFFERS from verification/references: {words}");
    }
    let outcomes = run_all(&root, &cases, arguments);
    for outcome in &outcomes {
        print_outcome(&cases[outcome.index], outcome, arguments.verbose);
    }
    let elapsed = began.elapsed();
    // A report without the cases that need data of third parties is not the report.
    let is_complete =
        outcomes.iter().flat_map(|outcome| &outcome.rows).all(|row| row.verdict.word() != "skipped");
    let whole = arguments.names.is_empty() && !arguments.quick && is_complete;
    report::write(&root, &cases, &outcomes, elapsed, whole)?;
    let failed = outcomes.iter().filter(|outcome| outcome.has_failed()).count();
    let path = root.join("docs").join(report::NAME);
    let report = std::fs::read_to_string(&path).map_err(VerifyError::file(&path))?;
    let old = stale::differences(&report, &cases, &outcomes);
    for words in &old {
        println!("OLD in docs/verification.md, which `cargo xtask verify` makes anew: {words}");
    }
    println!("{} cases in {:.1} s, {failed} failed", outcomes.len(), elapsed.as_secs_f64());
    Ok(failed == 0 && other_digits.is_empty() && (old.is_empty() || !arguments.fresh))
}

/// Folders of the cases, in order.
pub(crate) fn folders(folder: &Path) -> Result<Vec<PathBuf>, VerifyError> {
    let entries = std::fs::read_dir(folder).map_err(VerifyError::file(folder))?;
    let mut folders: Vec<PathBuf> = entries
        .filter_map(|entry| entry.ok().map(|entry| entry.path()))
        .filter(|path| path.join("case.toml").is_file())
        .collect();
    folders.sort();
    Ok(folders)
}

fn cases(folder: &Path, arguments: &VerifyArguments) -> Result<Vec<Case>, VerifyError> {
    let folders = folders(folder)?;
    let named = |path: &Path, name: &str| path.file_name().is_some_and(|file| file == name);
    if let Some(name) = arguments.names.iter().find(|name| !folders.iter().any(|path| named(path, name))) {
        return Err(VerifyError::Unknown(name.clone()));
    }
    let wanted =
        |path: &&PathBuf| arguments.names.is_empty() || arguments.names.iter().any(|name| named(path, name));
    let mut cases = Vec::new();
    for path in folders.iter().filter(wanted) {
        let case = Case::read(path)?;
        if case.quick || !arguments.quick {
            cases.push(case);
        }
    }
    Ok(cases)
}

fn run_all(root: &Path, cases: &[Case], arguments: &VerifyArguments) -> Vec<Outcome> {
    let bar = ProgressBar::new(cases.len() as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg} ({elapsed})") {
        bar.set_style(style);
    }
    let next = AtomicUsize::new(0);
    let outcomes = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..arguments.threads.max(1) {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    let Some(case) = cases.get(index) else { return };
                    bar.set_message(case.name.clone());
                    let outcome = run(root, index, case, arguments.references.as_deref());
                    bar.inc(1);
                    if let Ok(mut outcomes) = outcomes.lock() {
                        outcomes.push(outcome);
                    }
                }
            });
        }
    });
    bar.finish_and_clear();
    let mut outcomes = outcomes.into_inner().unwrap_or_default();
    outcomes.sort_by_key(|outcome: &Outcome| outcome.index);
    outcomes
}

/// A case without numbers.
fn without_numbers(case: &Case, verdict: Verdict) -> Row {
    Row {
        quantity: case.title.clone(),
        against: case.source.clone(),
        reference: String::new(),
        ours: String::new(),
        difference: None,
        tolerance: String::new(),
        uncertainty: String::new(),
        grid: String::new(),
        wall: None,
        verdict,
        is_comparison: false,
    }
}

fn run(root: &Path, index: usize, case: &Case, references: Option<&Path>) -> Outcome {
    let mut outcome =
        Outcome { index, rows: Vec::new(), figures: Vec::new(), wall: Duration::ZERO, because: Vec::new() };
    if let Some(needed) = &case.needs
        && !references.is_some_and(|folder| folder.join(needed).exists())
    {
        let words = format!("needs `{needed}` below the folder given by --references");
        outcome.rows.push(without_numbers(case, Verdict::Skipped(words)));
        return outcome;
    }
    if let Some(reason) = &case.open {
        outcome.rows.push(without_numbers(case, Verdict::Open(reason.clone())));
    }
    let runs = Runs::new(references);
    for quantity in &case.quantity {
        outcome.rows.push(compare::quantity(case, quantity, &runs));
        outcome.because.extend(quantity.because.iter().map(|words| format!("{}: {words}", quantity.name)));
    }
    for curve in &case.curve {
        let (row, figures) = curves::curve(case, curve, &runs);
        outcome.rows.extend(row);
        outcome.figures.extend(figures);
        outcome.because.extend(curve.because.iter().map(|words| format!("{}: {words}", curve.name)));
    }
    for refinement in &case.refinement {
        outcome.rows.push(refine::refinement(case, refinement, &runs));
    }
    outcome.rows.extend(warnings::row(case, &runs.warnings()));
    outcome
        .because
        .extend(case.warns.iter().map(|warning| format!("warns that {}: {}", warning.says, warning.because)));
    let began = Instant::now();
    for invariant in &case.invariant {
        let row = invariants::invariant(root, invariant);
        outcome.because.extend(invariant.because.iter().map(|words| format!("{}: {words}", row.quantity)));
        outcome.rows.push(row);
    }
    outcome.wall = runs.wall() + if case.invariant.is_empty() { Duration::ZERO } else { began.elapsed() };
    outcome
}

fn print_outcome(case: &Case, outcome: &Outcome, verbose: bool) {
    let passed = outcome.rows.iter().filter(|row| row.verdict.word() == "pass").count();
    println!("{:32} {passed}/{} in {:.2} s", case.name, outcome.rows.len(), outcome.wall.as_secs_f64());
    for row in &outcome.rows {
        let words = match &row.verdict {
            Verdict::Pass => None,
            Verdict::Fail(words) => Some(format!("FAILS: {words}")),
            Verdict::Open(words) => Some(format!("open: {words}")),
            Verdict::PassesThoughOpen(words) => Some(format!("passes, although open: {words}")),
            Verdict::Skipped(words) => Some(format!("SKIPPED: {words}")),
        };
        if verbose || words.is_some() {
            let digits = row.digits().map_or(String::new(), |digits| format!("{digits:.1} digits"));
            println!(
                "    {} {digits} | ours {} | reference {} | {} | {}",
                row.quantity,
                row.ours,
                row.reference,
                row.grid,
                words.unwrap_or_else(|| "pass".to_owned())
            );
        }
    }
}
