//! `cargo xtask ablate`: switches off one feature of the nonlinear solver at a time, over all scenes, examples,
//! verification models and random mechanisms, and prints what that costs. A feature without which nothing fails and nothing becomes
//! more expensive is removed. With `--numbers` it halves and doubles instead each tuning parameter of these and of step-size control. Knows no
//! mechanics.

use std::collections::BTreeSet;
use std::ops::ControlFlow;

use lissom::core::solver_features::SOLVER_FEATURES;
use lissom::core::tuning::{TUNING_PARAMETERS, Tuning, TuningParameter};
use lissom::start::lower;
use lissom::{Override, Session};

use crate::AblateArguments;
use crate::bench::processor_time;
use crate::subjects::{self, Subject};
use crate::verify::VerifyError;

/// Outputs below this are nothing [m, rad, ...].
const NOTHING: f64 = 1e-6;
/// Tolerance of the runs that others are compared with.
const FINE: &str = "1e-11";

/// Result of a run.
struct Finished {
    failure: Option<String>,
    iterations: f64,
    tangents: f64,
    rejected: f64,
    /// Processor time of the steps [s].
    seconds: f64,
    values: Vec<f64>,
}

/// Runs everything with everything, then without each feature, and prints the table.
pub(crate) fn ablate(arguments: &AblateArguments) -> Result<bool, VerifyError> {
    let mut subjects = subjects::with_further_schemes();
    subjects.extend(subjects::examples()?);
    subjects.extend(subjects::cases()?);
    subjects.extend(subjects::hard_random(arguments.random));
    if arguments.numbers {
        subjects.extend(subjects::chosen_random(arguments.random));
    }
    if !arguments.names.is_empty() {
        subjects.retain(|subject| arguments.names.iter().any(|name| subject.name.contains(name.as_str())));
    }
    let whole: Vec<Finished> =
        subjects.iter().map(|subject| run(subject, &Change::None, arguments.repeat)).collect();
    let finer = Change::Key(("analysis.tolerance".to_owned(), FINE.to_owned()));
    let fine: Vec<Finished> = subjects.iter().map(|subject| run(subject, &finer, 1)).collect();
    let failing: BTreeSet<&str> =
        subjects.iter().zip(&whole).filter(|(_, run)| run.failure.is_some()).map(|(s, _)| &*s.name).collect();
    println!("{} models; failing with everything: {failing:?}\n", subjects.len());
    println!(
        "| {} | fail | are saved | time | counted | most | iterations | tangents | given up | error × |\n\
         |---|---|---|---|---|---|---|---|---|---|",
        if arguments.numbers { "changed" } else { "without" }
    );
    print_row("nothing", &subjects, (&whole, &whole, &fine));
    for (title, change) in changes(arguments.numbers) {
        let runs: Vec<Finished> =
            subjects.iter().map(|subject| run(subject, &change, arguments.repeat)).collect();
        print_row(&title, &subjects, (&runs, &whole, &fine));
    }
    Ok(true)
}

/// Change in a run.
enum Change {
    /// Nothing.
    None,
    /// A key of the model file.
    Key(Override),
    /// The tuning parameter of this word is multiplied by this factor.
    Parameter(&'static str, f64),
}

/// Changes in sequence, with the titles of their rows.
fn changes(of_numbers: bool) -> Vec<(String, Change)> {
    if of_numbers {
        let halved_and_doubled = TUNING_PARAMETERS.iter().flat_map(|&(_, word, ..)| {
            [
                (format!("½ {word}"), Change::Parameter(word, 0.5)),
                (format!("2 {word}"), Change::Parameter(word, 2.0)),
            ]
        });
        return halved_and_doubled.collect();
    }
    let without = |word: &str| Change::Key(("analysis.without".to_owned(), format!("[\"{word}\"]")));
    SOLVER_FEATURES.iter().map(|(_, word, _)| ((*word).to_owned(), without(word))).collect()
}

/// One line of the table: `runs` without a feature beside those with all, and fine ones.
fn print_row(word: &str, subjects: &[Subject], (runs, whole, fine): (&[Finished], &[Finished], &[Finished])) {
    let (mut fails, mut saved) = (Vec::new(), Vec::new());
    let (mut times, mut counts) = (Vec::new(), Vec::new());
    let mut most = (0.0, "");
    let mut sums = [[0.0; 3]; 2];
    let mut worst = (0.0, "");
    for (((subject, run), whole), fine) in subjects.iter().zip(runs).zip(whole).zip(fine) {
        match (&run.failure, &whole.failure) {
            (Some(_), None) => fails.push(&*subject.name),
            (None, Some(_)) => saved.push(&*subject.name),
            (Some(_), Some(_)) => {}
            (None, None) => {
                times.push((run.seconds.max(1e-6) / whole.seconds.max(1e-6)).ln());
                let ratio = counted(run) / counted(whole);
                counts.push(ratio.ln());
                if ratio > most.0 {
                    most = (ratio, &subject.name);
                }
                for (sums, run) in sums.iter_mut().zip([run, whole]) {
                    sums[0] += run.iterations / whole.iterations;
                    sums[1] += run.tangents / whole.tangents.max(1.0);
                    sums[2] += run.rejected;
                }
                if fine.failure.is_none() {
                    let error = distance(&run.values, &fine.values);
                    if error > worst.0 {
                        worst = (error, &subject.name);
                    }
                }
            }
        }
    }
    let count = times.len() as f64;
    println!(
        "| {word} | {} | {} | {:.3} | {:.3} | {:.2} ({}) | {:.3} | {:.2} | {} ({}) | {:.1e} ({}) |",
        list(&fails),
        list(&saved),
        (times.iter().sum::<f64>() / count).exp(),
        (counts.iter().sum::<f64>() / count).exp(),
        most.0,
        most.1,
        sums[0][0] / sums[1][0],
        sums[0][1] / sums[1][1],
        sums[0][2],
        sums[1][2],
        worst.0,
        worst.1,
    );
}

/// Iterations, and those that tangents cost.
fn counted(run: &Finished) -> f64 {
    run.iterations + run.tangents * Tuning::default().of(TuningParameter::TangentCost)
}

fn list(names: &[&str]) -> String {
    if names.is_empty() { "–".to_owned() } else { format!("{}: {}", names.len(), names.join(", ")) }
}

/// Largest difference of outputs relative to the largest of them.
fn distance(values: &[f64], others: &[f64]) -> f64 {
    let largest = others.iter().fold(NOTHING, |most, value| most.max(value.abs()));
    values.iter().zip(others).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs())) / largest
}

fn run(subject: &Subject, change: &Change, repeat: usize) -> Finished {
    let mut best = run_once(subject, change);
    for _ in 1..repeat {
        let next = run_once(subject, change);
        if next.seconds < best.seconds {
            best = next;
        }
    }
    best
}

fn run_once(subject: &Subject, change: &Change) -> Finished {
    let failed = |failure: String| Finished {
        failure: Some(failure),
        iterations: 0.0,
        tangents: 0.0,
        rejected: 0.0,
        seconds: 0.0,
        values: Vec::new(),
    };
    let mut overrides = subject.overrides.clone();
    if let Change::Key(further) = change {
        overrides.push(further.clone());
    }
    let document = subject.model.with_overrides(&overrides).document();
    let mut lowered = match document.and_then(|document| lower(&document)) {
        Ok(lowered) => lowered,
        Err(report) => return failed(report.render(false)),
    };
    if let Change::Parameter(word, factor) = change {
        lowered.settings.limits.tuning = Tuning::default().times([*word], *factor).unwrap_or_default();
    }
    let mut session = match Session::start(lowered) {
        Ok(session) => session,
        Err(error) => return failed(error.to_string()),
    };
    let before = processor_time();
    let report = session.run_with(&mut [], &mut |_| ControlFlow::Continue(()));
    let busy = processor_time().zip(before).map_or(report.solving, |(now, then)| now.saturating_sub(then));
    let mut values = Vec::new();
    session.values(&mut values);
    Finished {
        failure: report.error().map(ToString::to_string),
        iterations: report.totals.newton_iterations as f64,
        tangents: report.totals.factorizations as f64,
        rejected: report.totals.rejected_steps as f64,
        seconds: busy.as_secs_f64(),
        values,
    }
}
