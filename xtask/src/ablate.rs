//! `cargo xtask ablate`: leaves out one mechanism of the search for a step's solution at a time, over all scenes, examples
//! and verification models, and prints what that costs. A mechanism without which nothing fails and nothing becomes
//! dearer is to go. Knows no mechanics.

use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::path::Path;

use lissom::core::mechanisms::MECHANISMS;
use lissom::{Model, Override, Session};
use lissom_model::document::AnalysisKind;

use crate::AblateArguments;
use crate::bench::processor_time;
use crate::case::Case;
use crate::scenes;
use crate::verify::{self, VerifyError, root};

/// Schemes that scenes are run with beside their own.
const FURTHER_SCHEMES: [&str; 2] = ["radau-iia", "energy-decaying"];
/// How much longer than a scene's own the steps are that are tried as well: those that resolve little are hard.
const LONGER: [f64; 2] = [10.0, 50.0];
/// Outputs below this are nothing [m, rad, ...].
const NOTHING: f64 = 1e-6;
/// Scenes that every scheme and longer steps are tried on: the others take long.
const SHORT: [&str; 6] = ["chain-s-10", "chain-r-10", "soft-beam-8", "tip-crank-1e-3", "rotor", "andrews"];
/// Tolerance of the runs that others are compared with.
const FINE: &str = "1e-11";

/// A model that is run again and again.
struct Subject {
    name: String,
    model: Model,
    overrides: Vec<Override>,
}

/// What a run came to.
struct Finished {
    failure: Option<String>,
    iterations: f64,
    tangents: f64,
    rejected: f64,
    /// Processor time of the steps [s].
    seconds: f64,
    values: Vec<f64>,
}

/// Runs everything with everything, then without each mechanism, and prints the table.
pub(crate) fn ablate(arguments: &AblateArguments) -> Result<bool, VerifyError> {
    let mut subjects = subjects()?;
    if !arguments.names.is_empty() {
        subjects.retain(|subject| arguments.names.iter().any(|name| subject.name.contains(name.as_str())));
    }
    let whole: Vec<Finished> = subjects.iter().map(|subject| run(subject, &[], arguments.repeat)).collect();
    let fine: Vec<Finished> = subjects
        .iter()
        .map(|subject| run(subject, &[("analysis.tolerance".to_owned(), FINE.to_owned())], 1))
        .collect();
    let failing: BTreeSet<&str> =
        subjects.iter().zip(&whole).filter(|(_, run)| run.failure.is_some()).map(|(s, _)| &*s.name).collect();
    println!("{} models; failing with everything: {failing:?}\n", subjects.len());
    println!(
        "| without | fail | are saved | time | most | iterations | tangents | given up | error × |\n\
         |---|---|---|---|---|---|---|---|---|"
    );
    print_row("nothing", &subjects, (&whole, &whole, &fine));
    for (_, word, _) in MECHANISMS {
        let without = ("analysis.without".to_owned(), format!("[\"{word}\"]"));
        let runs: Vec<Finished> = subjects
            .iter()
            .map(|subject| run(subject, std::slice::from_ref(&without), arguments.repeat))
            .collect();
        print_row(word, &subjects, (&runs, &whole, &fine));
    }
    Ok(true)
}

/// One line of the table: `runs` without a mechanism beside those with all, and fine ones.
fn print_row(word: &str, subjects: &[Subject], (runs, whole, fine): (&[Finished], &[Finished], &[Finished])) {
    let (mut fails, mut saved) = (Vec::new(), Vec::new());
    let mut times = Vec::new();
    let mut most = (0.0, "");
    let mut sums = [[0.0; 3]; 2];
    let mut worst = (0.0, "");
    for (((subject, run), whole), fine) in subjects.iter().zip(runs).zip(whole).zip(fine) {
        match (&run.failure, &whole.failure) {
            (Some(_), None) => fails.push(&*subject.name),
            (None, Some(_)) => saved.push(&*subject.name),
            (Some(_), Some(_)) => {}
            (None, None) => {
                let ratio = run.seconds.max(1e-6) / whole.seconds.max(1e-6);
                times.push(ratio.ln());
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
        "| {word} | {} | {} | {:.3} | {:.2} ({}) | {:.3} | {:.2} | {} ({}) | {:.1e} ({}) |",
        list(&fails),
        list(&saved),
        (times.iter().sum::<f64>() / count).exp(),
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

fn list(names: &[&str]) -> String {
    if names.is_empty() { "–".to_owned() } else { format!("{}: {}", names.len(), names.join(", ")) }
}

/// Largest difference of outputs relative to the largest of them.
fn distance(values: &[f64], others: &[f64]) -> f64 {
    let largest = others.iter().fold(NOTHING, |most, value| most.max(value.abs()));
    values.iter().zip(others).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs())) / largest
}

fn run(subject: &Subject, further: &[Override], repeat: usize) -> Finished {
    let mut best = run_once(subject, further);
    for _ in 1..repeat {
        let next = run_once(subject, further);
        if next.seconds < best.seconds {
            best = next;
        }
    }
    best
}

fn run_once(subject: &Subject, further: &[Override]) -> Finished {
    let failed = |failure: String| Finished {
        failure: Some(failure),
        iterations: 0.0,
        tangents: 0.0,
        rejected: 0.0,
        seconds: 0.0,
        values: Vec::new(),
    };
    let overrides = [&subject.overrides[..], further].concat();
    let document = match subject.model.document(&overrides) {
        Ok(document) => document,
        Err(report) => return failed(report.render(false)),
    };
    let mut session = match Session::new(&document) {
        Ok(session) => session,
        Err(error) => return failed(error.to_string()),
    };
    let before = processor_time();
    let report = session.run(&mut [], &mut |_| ControlFlow::Continue(()));
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

/// Scenes with their own and with further schemes, examples, and the models of the verification.
fn subjects() -> Result<Vec<Subject>, VerifyError> {
    let mut all = Vec::new();
    for name in scenes::KEPT {
        let Some(scene) = scenes::scene(name) else { continue };
        let add = |all: &mut Vec<Subject>, scheme: Option<&str>| {
            let text = match scheme {
                None => scene.text.clone(),
                Some(scheme) => scene.text.replace(
                    "scheme = \"generalized-alpha\"\nspectral_radius = 0.8",
                    &format!("scheme = \"{scheme}\""),
                ),
            };
            let name = scheme.map_or((*name).to_owned(), |scheme| format!("{name} {scheme}"));
            let model = Model::from_text(&name, &text);
            if SHORT.contains(&scene.name.as_str()) {
                for longer in LONGER {
                    all.extend(with_longer_steps(&name, &model, longer));
                }
            }
            all.push(Subject { model, name, overrides: Vec::new() });
        };
        add(&mut all, None);
        if SHORT.contains(name) {
            for scheme in FURTHER_SCHEMES {
                add(&mut all, Some(scheme));
            }
        }
    }
    let root = root();
    for path in files(&root.join("examples"))? {
        let name = path.file_stem().map_or_else(String::new, |stem| format!("example {}", stem.display()));
        if let Ok(model) = Model::read(&path) {
            all.push(Subject { name, model, overrides: Vec::new() });
        }
    }
    for folder in verify::folders(&root.join("verification"))? {
        let case = Case::read(&folder)?;
        if case.needs.is_some() || case.open.is_some() || !case.quick {
            continue;
        }
        for (name, run) in &case.runs {
            let model = run.model(&case.folder)?;
            let overrides = run.overrides(&std::collections::BTreeMap::new());
            let Ok(document) = model.document(&overrides) else { continue };
            if matches!(document.analysis.kind, AnalysisKind::Dynamics { .. } | AnalysisKind::Statics { .. })
            {
                all.push(Subject { name: format!("{} {name}", case.name), model, overrides });
            }
        }
    }
    Ok(all)
}

/// The same model with steps that are so many times as long, each of them recorded.
fn with_longer_steps(name: &str, model: &Model, longer: f64) -> Option<Subject> {
    let document = model.document(&[]).ok()?;
    let AnalysisKind::Dynamics { step, .. } = document.analysis.kind else { return None };
    let set = |path: &str, value: String| (format!("analysis.{path}"), value);
    let overrides =
        vec![set("step", format!("{:e}", longer * step.value)), set("output_every", "1".to_owned())];
    Some(Subject { name: format!("{name} x{longer}"), model: model.clone(), overrides })
}

/// Model files of a folder, in order.
fn files(folder: &Path) -> Result<Vec<std::path::PathBuf>, VerifyError> {
    let entries = std::fs::read_dir(folder).map_err(VerifyError::file(folder))?;
    let mut files: Vec<_> = entries
        .filter_map(|entry| entry.ok().map(|entry| entry.path()))
        .filter(|path| path.extension().is_some_and(|ending| ending == "toml"))
        .collect();
    files.sort();
    Ok(files)
}
