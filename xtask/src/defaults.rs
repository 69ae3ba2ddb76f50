//! `cargo xtask defaults`: which scheme and which tolerance a model gets that names neither. Runs short scenes, examples and
//! random mechanisms with steps chosen by their error, with every scheme and tolerance, and prints how far the positions are
//! from those of fine runs, the warnings, and the cost. Knows no mechanics.

use lissom::{Override, Record, Session};
use lissom_model::document::AnalysisKind;

use crate::bench::processor_time;
use crate::subjects::{self, Subject};
use crate::verify::VerifyError;

/// Schemes that are tried.
const SCHEMES: [&str; 6] =
    ["radau-iia", "radau-iia-5", "radau-iia-9", "energy-decaying", "generalized-alpha", "hht"];
/// Tolerances that are tried.
const TOLERANCES: [f64; 4] = [1e-3, 1e-4, 1e-5, 1e-6];
/// Reference of costs: a model with default settings.
const DEFAULT: (usize, usize) = (0, 2);
/// Tolerances of the two runs that the others are compared with.
const FINE: [f64; 2] = [1e-8, 1e-9];
/// Where the fine runs differ by more than this fraction of the way, nothing is compared.
const TRUSTED: f64 = 1e-4;
/// Results further from the fine ones than this fraction of the way are wrong.
const WRONG: f64 = 0.01;
/// Models that go less far are compared with what can be seen of them [m, rad, 1].
const MIN_DISPLACEMENT: f64 = 1e-4;
/// Records of a run.
const RECORDS: f64 = 20.0;

/// Runs to perform.
#[derive(clap::Args)]
pub(crate) struct DefaultsArguments {
    /// Parts of the names of models to run; all if none is given
    names: Vec<String>,
    /// Random mechanisms beside scenes and examples
    #[arg(long, default_value_t = 200)]
    random: u64,
}

/// A run that reached its end.
struct Ran {
    record: Record,
    is_warned: bool,
    /// Processor time [s].
    seconds: f64,
}

/// Results of a scheme with a tolerance over all models.
#[derive(Default)]
struct Tally {
    failed: Vec<String>,
    errors: Vec<(f64, String)>,
    reported: usize,
    unreported: Vec<String>,
    /// Logarithms of the processor time over that of the default.
    costs: Vec<f64>,
}

/// Runs everything and prints the table.
///
/// # Errors
/// If the examples cannot be read.
pub(crate) fn defaults(arguments: &DefaultsArguments) -> Result<bool, VerifyError> {
    let mut subjects = subjects::short();
    subjects.extend(subjects::examples()?);
    subjects.extend(subjects::random(arguments.random));
    if !arguments.names.is_empty() {
        subjects.retain(|subject| arguments.names.iter().any(|name| subject.name.contains(name.as_str())));
    }
    let mut tallies: [[Tally; TOLERANCES.len()]; SCHEMES.len()] = Default::default();
    let (mut compared, mut left_out) = (0, Vec::new());
    for subject in &subjects {
        let Some(duration) = duration(subject) else { continue };
        let fine = FINE.map(|tolerance| run(subject, duration, SCHEMES[DEFAULT.0], tolerance));
        let [Some(rough), Some(fine)] = &fine else {
            left_out.push(&*subject.name);
            continue;
        };
        if distance(&rough.record, &fine.record).is_none_or(|gap| gap > TRUSTED) {
            left_out.push(&*subject.name);
            continue;
        }
        compared += 1;
        let runs =
            SCHEMES.map(|scheme| TOLERANCES.map(|tolerance| run(subject, duration, scheme, tolerance)));
        let usual = runs[DEFAULT.0][DEFAULT.1].as_ref().map(|ran| ran.seconds);
        for (tally, ran) in tallies.iter_mut().flatten().zip(runs.iter().flatten()) {
            tally.note(&subject.name, ran.as_ref(), &fine.record, usual);
        }
    }
    println!("{compared} models; without a result that can be trusted: {}\n", list(&left_out));
    println!(
        "| scheme | τ | failed | error, median | of nine in ten | largest | above 1 %, with warning | without | cost |\n\
         |---|---|---|---|---|---|---|---|---|"
    );
    for (scheme, tallies) in SCHEMES.iter().zip(&mut tallies) {
        for (tolerance, tally) in TOLERANCES.iter().zip(tallies) {
            println!("| {scheme} | {tolerance:.0e} | {}", tally.row());
        }
    }
    Ok(true)
}

impl Tally {
    fn note(&mut self, name: &str, ran: Option<&Ran>, fine: &Record, usual: Option<f64>) {
        let Some(ran) = ran else {
            self.failed.push(name.to_owned());
            return;
        };
        let error = distance(&ran.record, fine).unwrap_or(f64::INFINITY);
        match (error <= WRONG, ran.is_warned) {
            (true, _) => {}
            (false, true) => self.reported += 1,
            (false, false) => self.unreported.push(name.to_owned()),
        }
        self.errors.push((error, name.to_owned()));
        self.costs.extend(usual.map(|usual| (ran.seconds / usual).ln()));
    }

    /// The rest of a line of the table.
    fn row(&mut self) -> String {
        self.errors.sort_by(|one, other| one.0.total_cmp(&other.0));
        let at = |part: f64| {
            let last = self.errors.len().saturating_sub(1);
            self.errors.get((part * last as f64).round() as usize).map_or((f64::NAN, ""), |(e, n)| (*e, n))
        };
        let cost = (self.costs.iter().sum::<f64>() / self.costs.len() as f64).exp();
        format!(
            "{} | {:.0e} | {:.0e} | {:.0e} ({}) | {} | {} | {cost:.2} |",
            list(&self.failed),
            at(0.5).0,
            at(0.9).0,
            at(1.0).0,
            at(1.0).1,
            self.reported,
            list(&self.unreported),
        )
    }
}

fn list<T: AsRef<str>>(names: &[T]) -> String {
    let words: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
    if words.is_empty() { "–".to_owned() } else { format!("{}: {}", words.len(), words.join(", ")) }
}

/// How long the motion is [s], where the model is one of motion.
fn duration(subject: &Subject) -> Option<f64> {
    let document = subject.model.with_overrides(&subject.overrides).document().ok()?;
    match document.analysis.kind {
        AnalysisKind::Dynamics { .. } => Some(document.analysis.end - document.analysis.start),
        _ => None,
    }
}

fn run(subject: &Subject, duration: f64, scheme: &str, tolerance: f64) -> Option<Ran> {
    let set = |path: &str, value: String| -> Override { (format!("analysis.{path}"), value) };
    let mut overrides = subject.overrides.clone();
    overrides.extend([
        set("scheme", format!("\"{scheme}\"")),
        set("relative_tolerance", format!("{tolerance:e}")),
        set("output_step", format!("{:e}", duration / RECORDS)),
        set("output_every", "1".to_owned()),
    ]);
    let document = subject.model.with_overrides(&overrides).document().ok()?;
    let mut session = Session::new(&document).ok()?;
    let before = processor_time();
    let (record, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    let busy = processor_time().zip(before).map_or(report.solving, |(now, then)| now.saturating_sub(then));
    let is_warned = session.warnings().next().is_some();
    report.error().is_none().then(|| Ran { record, is_warned, seconds: busy.as_secs_f64().max(1e-6) })
}

/// The largest difference of positions at common instants over how far such positions go; none where there are no positions or
/// other instants.
fn distance(one: &Record, other: &Record) -> Option<f64> {
    if one.times.len() != other.times.len() {
        return None;
    }
    let mut worst = None;
    for unit in ["m", "rad", ""] {
        let columns = one.columns.iter().enumerate().filter(|(_, column)| is_place(&column.quantity, unit));
        let (mut way, mut gap) = (0.0_f64, 0.0_f64);
        for (index, _) in columns {
            for (a, b) in one.values[index].iter().zip(&other.values[index]) {
                let apart = (a - b).abs();
                // A quaternion and its opposite are the same turn.
                gap = gap.max(if unit.is_empty() { apart.min((a + b).abs()) } else { apart });
                way = way.max((b - other.values[index][0]).abs());
            }
        }
        if way > 0.0 {
            worst = Some(worst.unwrap_or(0.0_f64).max(gap / way.max(MIN_DISPLACEMENT)));
        }
    }
    worst
}

/// Whether a column is a position, in this unit.
fn is_place(quantity: &str, unit: &str) -> bool {
    match quantity {
        "position" | "displacement" => unit == "m",
        "angle" | "rotation" => unit == "rad",
        "quaternion" => unit.is_empty(),
        _ => false,
    }
}
