//! `cargo xtask bench`: runs scenes without outputs and prints their time by function. Independent of mechanics.

use std::fmt::Write;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Duration;

use lissom::{Model, Override, RunReport, Seconds, Session};
use lissom_model::document::AnalysisKind;
use lissom_model::output::LogFigure;

use crate::BenchArguments;
use crate::peers;
use crate::scenes::{self, Scene};

/// A chore that cannot be carried out.
#[derive(Debug, thiserror::Error)]
pub(crate) enum BenchError {
    /// There is no such scene.
    #[error("there is no scene `{0}`; `cargo xtask scenes --list` names them")]
    Unknown(String),
    /// A scene is wrong or has no solution.
    #[error("{name}: {message}")]
    Failed {
        /// The scene.
        name: String,
        /// Why.
        message: String,
    },
    /// A file cannot be written.
    #[error("{path}: {error}")]
    File {
        /// The file or folder.
        path: PathBuf,
        /// The error of the system.
        error: std::io::Error,
    },
}

/// Result of a scene.
struct Measured {
    name: String,
    unknowns: usize,
    report: RunReport,
    /// Patterns of touching parts that were analysed.
    analyses: usize,
    /// Processor time of the steps [s].
    steps: f64,
    /// Increase of the peak memory of the process in bytes.
    bytes: Option<u64>,
}

/// Writes the stored scenes, and the large ones if requested.
pub(crate) fn write(root: &Path, large: bool) -> Result<(), BenchError> {
    let folder = root.join("benches/scenes");
    let file = |path: &Path| {
        let path = path.to_owned();
        move |error| BenchError::File { path, error }
    };
    std::fs::create_dir_all(&folder).map_err(file(&folder))?;
    let more = if large { scenes::LARGE } else { &[] };
    for name in scenes::KEPT.iter().chain(more) {
        let scene = find(name)?;
        let path = folder.join(format!("{name}.toml"));
        std::fs::write(&path, scene.text).map_err(file(&path))?;
        println!("{}", path.display());
    }
    Ok(())
}

fn find(name: &str) -> Result<Scene, BenchError> {
    scenes::scene(name).ok_or_else(|| BenchError::Unknown(name.to_owned()))
}

/// Runs scenes and prints the table.
pub(crate) fn bench(arguments: &BenchArguments) -> Result<(), BenchError> {
    if arguments.errors {
        return errors(arguments);
    }
    if let Some(folder) = &arguments.scale {
        return scale(folder);
    }
    let named: Vec<&str> = arguments.names.iter().map(String::as_str).collect();
    let names = if named.is_empty() { scenes::KEPT.to_vec() } else { named };
    let mut table = String::from(HEADING);
    print!("{HEADING}");
    for name in names {
        let scene = find(name)?;
        let measured = fastest(&scene, &arguments.overrides(), arguments.repeat)?;
        let line = line(&measured);
        print!("{line}");
        table.push_str(&line);
    }
    if let Some(path) = &arguments.out {
        std::fs::write(path, table).map_err(|error| BenchError::File { path: path.clone(), error })?;
    }
    Ok(())
}

const HEADING: &str = "| scene | unknowns | steps | iterations per step | tangents | analyses | µs per step | \
evaluation | linearisation | factorisation | solve | rest | output | start [s] | \
fastest peer [µs] | ratio |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";

fn fastest(scene: &Scene, overrides: &[Override], repeat: usize) -> Result<Measured, BenchError> {
    let mut best = run(scene, overrides)?;
    for _ in 1..repeat {
        let measured = run(scene, overrides)?;
        if measured.steps < best.steps {
            best = Measured { bytes: best.bytes, ..measured };
        }
    }
    Ok(best)
}

fn run(scene: &Scene, overrides: &[Override]) -> Result<Measured, BenchError> {
    let fail = |message: String| failed(&scene.name, message);
    let before = resident();
    let model = Model::from_text(&scene.name, &scene.text);
    let document = model.with_overrides(overrides).document().map_err(|report| fail(report.render(false)))?;
    let mut session = Session::new(&document).map_err(|error| fail(error.to_string()))?;
    drop(document);
    let bytes = resident().zip(before).map(|(after, before)| after.saturating_sub(before));
    let (wall, busy) = (std::time::Instant::now(), processor_time());
    let report = session.run_with(&mut [], &mut |_| ControlFlow::Continue(()));
    let wall = wall.elapsed();
    // The share of the wall time in which this thread had a processor.
    let busy = processor_time().zip(busy).map_or(wall, |(now, then)| now.saturating_sub(then));
    let share = (busy.as_secs_f64() / wall.as_secs_f64()).min(1.0);
    if let Some(error) = report.error() {
        return Err(fail(format!("at {} s: {error}", report.time)));
    }
    let system = session.simulation().system();
    Ok(Measured {
        name: scene.name.clone(),
        unknowns: system.layout().size(),
        analyses: session.simulation().pattern_analyses(),
        steps: share * report.solving.as_secs_f64(),
        report,
        bytes,
    })
}

/// Processor time of this thread, where the system reports it. It is brought up to date at every tick of some
/// milliseconds, and when the processor is offered to others.
pub(crate) fn processor_time() -> Option<Duration> {
    std::thread::yield_now();
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split_whitespace().next()?.parse().ok().map(Duration::from_nanos)
}

/// Bytes of memory in use, where the system reports it.
fn resident() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/statm").ok()?;
    let pages: u64 = text.split_whitespace().nth(1)?.parse().ok()?;
    Some(4096 * pages)
}

/// Prints the bytes that a scene takes, ready to run. In a process of its own no memory is used again.
pub(crate) fn print_bytes(name: &str) -> Result<(), BenchError> {
    let measured = run(&find(name)?, &[("analysis.end".to_owned(), "1e-3".to_owned())])?;
    println!("{}", measured.bytes.unwrap_or(0));
    Ok(())
}

fn bytes_apart(name: &str) -> Option<u64> {
    let program = std::env::current_exe().ok()?;
    let output = std::process::Command::new(program).args(["bytes", name]).output().ok()?;
    String::from_utf8_lossy(&output.stdout).trim().parse().ok().filter(|bytes| *bytes > 0)
}

fn line(measured: &Measured) -> String {
    let Measured { name, unknowns, report, steps, .. } = measured;
    let totals = &report.totals;
    let count = totals.steps.max(1) as f64;
    let per_step = 1e6 * steps / count;
    let Seconds { start, evaluation, linearisation, factorisation, solve, rest, output } = report.seconds;
    let whole = report.seconds.steps() + output;
    let share = |part: f64| format!("{:.0} %", 100.0 * part / whole);
    let peer = peers::fastest(name);
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "| `{name}` | {unknowns} | {} | {:.2} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {start:.3} | {} | {} |",
        totals.steps,
        totals.newton_iterations as f64 / count,
        totals.factorizations,
        measured.analyses,
        digits(per_step),
        share(evaluation),
        share(linearisation),
        share(factorisation),
        share(solve),
        share(rest),
        share(output),
        peer.as_ref().map_or("–".to_owned(), |peer| format!(
            "{} ({})",
            digits(peer.microseconds),
            peer.program
        )),
        peer.as_ref().map_or("–".to_owned(), |peer| format!("{:.1}", peer.microseconds / per_step)),
    );
    text
}

/// Chains and beams from ten bodies or elements on: time and memory for each of them, in a table and a drawing.
fn scale(folder: &Path) -> Result<(), BenchError> {
    let file = |path: PathBuf| move |error| BenchError::File { path, error };
    println!(
        "| scene | bodies | unknowns | iterations per step | µs per step | µs per step and body | \
         ns per iteration and body | kB per body | start [s] |\n|---|---|---|---|---|---|---|---|---|"
    );
    let mut curves = Vec::new();
    for (family, label, sizes) in [
        ("chain-s", "rigid bodies, spherical joints", &[10, 100, 1000, 10_000, 100_000][..]),
        ("soft-beam-cubic", "cubic beam elements", &[10, 100, 1000, 10_000]),
    ] {
        let mut points = Vec::new();
        for &size in sizes {
            let repeat = if size < 1000 { 5 } else { 1 };
            let measured = fastest(&find(&format!("{family}-{size}"))?, &[], repeat)?;
            let totals = &measured.report.totals;
            let each = 1e6 * measured.steps / (totals.steps * size) as f64;
            let iterations = totals.newton_iterations as f64 / totals.steps as f64;
            println!(
                "| `{}` | {size} | {} | {iterations:.2} | {} | {each:.3} | {} | {} | {:.3} |",
                measured.name,
                measured.unknowns,
                digits(each * size as f64),
                digits(1e3 * each / iterations),
                // Below a thousand, pages of memory are too coarse a measure.
                Some(&measured.name)
                    .filter(|_| size >= 1000)
                    .and_then(|name| bytes_apart(name))
                    .map_or("–".to_owned(), |bytes| digits(1e-3 * bytes as f64 / size as f64)),
                measured.report.seconds.start,
            );
            points.push((size as f64, each));
        }
        curves.push((label.to_owned(), points));
    }
    let figure = LogFigure {
        name: "scale".to_owned(),
        title: "Time per step for each body or element".to_owned(),
        x_label: "bodies or elements".to_owned(),
        y_label: "time per step and body [µs]".to_owned(),
        curves,
        guides: Vec::new(),
    };
    let svg = figure
        .draw()
        .and_then(|drawn| drawn.svg())
        .map_err(|error| BenchError::Failed { name: figure.name.clone(), message: error.to_string() })?;
    let path = folder.join("scale.svg");
    std::fs::write(&path, svg).map_err(file(path))
}

/// Positions at the end, compared with those of far smaller steps and of iterations to the last digit.
fn errors(arguments: &BenchArguments) -> Result<(), BenchError> {
    println!("| scene | error of the step [m] | of that, by the iterations [m] |\n|---|---|---|");
    for name in &arguments.names {
        let scene = find(name)?;
        let fine = |text: &str| ("analysis.tolerance".to_owned(), text.to_owned());
        let model = Model::from_text(&scene.name, &scene.text);
        let document = model.document().map_err(|report| failed(name, report.render(false)))?;
        let AnalysisKind::Dynamics { step, .. } = document.analysis.kind else { continue };
        let short = ("analysis.step".to_owned(), format!("{:e}", step.value / REFINED));
        let end = |more: &[Override]| last_place(&model, &[&arguments.overrides()[..], more].concat());
        let (given, exact, reference) = (end(&[])?, end(&[fine("1e-11")])?, end(&[short, fine("1e-10")])?);
        let distance =
            |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        println!("| `{name}` | {:.1e} | {:.1e} |", distance(&given, &reference), distance(&given, &exact));
    }
    Ok(())
}

/// How much smaller the steps of a reference are.
const REFINED: f64 = 16.0;

/// The first output at the end.
fn last_place(model: &Model, overrides: &[Override]) -> Result<Vec<f64>, BenchError> {
    let document = model
        .with_overrides(overrides)
        .document()
        .map_err(|report| failed(model.name(), report.render(false)))?;
    let mut session = Session::new(&document).map_err(|error| failed(model.name(), error.to_string()))?;
    let report = session.run_with(&mut [], &mut |_| ControlFlow::Continue(()));
    if let Some(error) = report.error() {
        return Err(failed(model.name(), error.to_string()));
    }
    let mut values = Vec::new();
    session.values(&mut values);
    values.truncate(3);
    Ok(values)
}

fn failed(name: &str, message: String) -> BenchError {
    BenchError::Failed { name: name.to_owned(), message }
}

/// Three digits.
fn digits(value: f64) -> String {
    match value {
        0.0..1.0 => format!("{value:.3}"),
        1.0..10.0 => format!("{value:.2}"),
        10.0..100.0 => format!("{value:.1}"),
        _ => format!("{value:.0}"),
    }
}
