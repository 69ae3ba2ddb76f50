//! One random mechanism, run by several schemes and steps, and the conclusions: whether a run ended well with a wrong
//! answer, failed, or warned without need.

use std::panic::{AssertUnwindSafe, catch_unwind};

use lissom::{Model, Override, Record, Session};

use super::mechanism::Mechanism;

/// Two results further apart than this fraction of the way that the model goes differ: one of them is wrong.
const WRONG: f64 = 0.01;
/// The references have to agree ten times as well.
const TRUSTED: f64 = 1e-3;
/// Turning by more than this in a step is not resolved well enough to ask for the angle [rad].
const FAST: f64 = 0.2;
/// The step of the schemes that are tried [s].
const STEP: f64 = 1e-3;
/// Drift of energy or momentum, over what is turned over, that counts as wrong.
const DRIFT: f64 = 0.01;

/// Result of a trial.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Finding {
    /// All schemes agree.
    Agreed,
    /// Nothing was to be compared: the references differ from each other, as where a motion is sensitive.
    Sensitive(String),
    /// The model was rejected, with the reason.
    Refused(String),
    /// No scheme reached the end.
    Unsolved(String),
    /// This scheme failed where others ran, with the reason.
    Failed(String),
    /// This scheme ended well beside the reference without a warning.
    Wrong(String),
    /// This scheme ended well beside the reference where something turns so fast that the step does not resolve it.
    Coarse(String),
    /// This scheme warned though it was right.
    FalseAlarm(String),
    /// Something panicked.
    Panicked(String),
}

impl Finding {
    /// One word.
    pub(super) fn word(&self) -> &'static str {
        match self {
            Self::Agreed => "agreed",
            Self::Sensitive(_) => "sensitive",
            Self::Refused(_) => "refused",
            Self::Unsolved(_) => "unsolved",
            Self::Failed(_) => "failed",
            Self::Wrong(_) => "wrong",
            Self::Coarse(_) => "coarse",
            Self::FalseAlarm(_) => "false alarm",
            Self::Panicked(_) => "panicked",
        }
    }
    /// The message.
    pub(super) fn words(&self) -> &str {
        match self {
            Self::Agreed => "",
            Self::Sensitive(words)
            | Self::Refused(words)
            | Self::Unsolved(words)
            | Self::Failed(words)
            | Self::Wrong(words)
            | Self::Coarse(words)
            | Self::FalseAlarm(words)
            | Self::Panicked(words) => words,
        }
    }

    /// Whether the trial found something that must not be.
    pub(super) fn is_defect(&self) -> bool {
        matches!(self, Self::Wrong(_) | Self::Panicked(_))
    }
}

/// How a scheme is run, as overrides of the model.
struct Way {
    name: &'static str,
    set: &'static [(&'static str, &'static str)],
}

/// The schemes that are tried.
const TRIED: [Way; 3] = [
    Way { name: "generalized-alpha", set: &[("analysis.scheme", "\"generalized-alpha\"")] },
    Way { name: "radau-iia", set: &[("analysis.scheme", "\"radau-iia\"")] },
    Way { name: "energy-decaying", set: &[("analysis.scheme", "\"energy-decaying\"")] },
];
/// A quarter of the step, and steps by their error.
const REFERENCES: [Way; 2] = [
    Way {
        name: "radau-iia at a quarter of the step",
        set: &[
            ("analysis.scheme", "\"radau-iia\""),
            ("analysis.step", "2.5e-4"),
            ("analysis.output_every", "80"),
            ("analysis.tolerance", "1e-10"),
        ],
    },
    Way {
        name: "radau-iia by its error",
        set: &[
            ("analysis.scheme", "\"radau-iia\""),
            ("analysis.relative_tolerance", "1e-7"),
            ("analysis.step", "1e-4"),
            ("analysis.output_step", "0.02"),
            ("analysis.output_every", "1"),
        ],
    },
];

/// A run that reached its end.
struct Ran {
    record: Record,
    warnings: Vec<String>,
    violation: f64,
}

/// Why a run gave nothing.
enum NotRan {
    Refused(String),
    Failed(String),
    Panicked(String),
}

fn run(text: &str, way: &Way) -> Result<Ran, NotRan> {
    let attempt = || -> Result<Ran, NotRan> {
        let overrides: Vec<Override> =
            way.set.iter().map(|(path, value)| ((*path).to_owned(), (*value).to_owned())).collect();
        let model = Model::from_text("random.toml", text);
        let document = model.with_overrides(&overrides).document().map_err(|report| {
            let problems: Vec<&str> = report.problems().map(|problem| problem.message.as_str()).collect();
            NotRan::Refused(problems.join("; "))
        })?;
        let mut session = Session::new(&document).map_err(|error| NotRan::Refused(error.to_string()))?;
        let (record, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
        if let Some(error) = report.error() {
            return Err(NotRan::Failed(format!("at {:.4} s: {error}", report.time)));
        }
        // What a wheel would do is no question of accuracy.
        let is_of_wheel = |code: &str| matches!(code, "wheel-lifts" | "wheel-slides" | "rail-contact");
        let doubts = session.warnings().filter(|warning| !is_of_wheel(warning.code()));
        let warnings = doubts.map(ToString::to_string).collect();
        Ok(Ran { record, warnings, violation: report.violation })
    };
    catch_unwind(AssertUnwindSafe(attempt)).unwrap_or_else(|panic| {
        let words = panic.downcast_ref::<String>().cloned();
        let words = words.or_else(|| panic.downcast_ref::<&str>().map(|words| (*words).to_owned()));
        Err(NotRan::Panicked(words.unwrap_or_else(|| "a panic without words".to_owned())))
    })
}

/// Columns with positions of the parts.
fn places(record: &Record) -> Vec<usize> {
    let is_place = |index: &usize| {
        let output = &record.columns[*index].output;
        output.starts_with("at_") || output.starts_with("turn_")
    };
    (0..record.columns.len()).filter(is_place).collect()
}

/// The largest change of any position since the start [m, 1].
fn way_gone(record: &Record) -> f64 {
    let of = |index: usize| {
        let values = &record.values[index];
        values.iter().map(|value| (value - values[0]).abs()).fold(0.0, f64::max)
    };
    places(record).into_iter().map(of).fold(0.0, f64::max)
}

/// The largest component of an angular velocity [rad/s].
fn fastest_turn(record: &Record) -> f64 {
    let of_columns = record.columns.iter().zip(&record.values);
    let spins = of_columns.filter(|(column, _)| column.output.starts_with("spin_"));
    spins.flat_map(|(_, values)| values).fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// The largest difference of positions at common instants, and the column; none where instants are missing.
fn difference(one: &Record, other: &Record) -> Option<(f64, String)> {
    if one.times.len() != other.times.len()
        || one.times.iter().zip(&other.times).any(|(a, b)| (a - b).abs() > 1e-7)
    {
        return None;
    }
    let mut worst = (0.0, String::new());
    for index in places(one) {
        let column = &one.columns[index];
        let values = other.column(&column.output, &column.component)?;
        for (instant, (a, b)) in one.values[index].iter().zip(values).enumerate() {
            let mut gap = (a - b).abs();
            if column.output.starts_with("turn_") {
                // A quaternion and its opposite are the same turn.
                gap = gap.min((a + b).abs());
            }
            if gap > worst.0 || gap.is_nan() {
                worst =
                    (gap, format!("{}.{} at {:.2} s", column.output, column.component, one.times[instant]));
            }
        }
    }
    Some(worst)
}

/// Drift of what is kept, over what is turned over, in words where it is too large.
fn drift(mechanism: &Mechanism, record: &Record) -> Option<String> {
    let spread = |values: &[f64]| {
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        values.iter().copied().fold(f64::NEG_INFINITY, f64::max) - least
    };
    if mechanism.is_conservative {
        let total = spread(record.column("energy", "total")?);
        let turned = ["kinetic", "strain", "gravity"]
            .iter()
            .filter_map(|part| record.column("energy", part))
            .map(spread)
            .fold(0.0, f64::max);
        if total > DRIFT * turned && total > 1e-9 {
            return Some(format!("energy drifts by {total:.2e} J where {turned:.2e} J are turned over"));
        }
    }
    if mechanism.is_free {
        // At rest at the start, nothing from outside: there is no momentum.
        let speeds = record.column("energy", "kinetic")?.iter().copied().fold(0.0, f64::max);
        for column in record.columns.iter().filter(|column| column.output == "momentum") {
            let most =
                record.column("momentum", &column.component)?.iter().map(|p| p.abs()).fold(0.0, f64::max);
            if most > 1e-3 * speeds.sqrt() && most > 1e-7 {
                return Some(format!("momentum {} is {most:.2e} where nothing pulls", column.component));
            }
        }
    }
    None
}

/// Runs the mechanism in all ways.
pub(super) fn trial(mechanism: &Mechanism) -> Vec<Finding> {
    let text = mechanism.text();
    let mut tried = Vec::new();
    for way in &TRIED {
        match run(&text, way) {
            Err(NotRan::Panicked(words)) => return vec![Finding::Panicked(format!("{}: {words}", way.name))],
            // What the model's reader rejects, it rejects for every scheme.
            Err(NotRan::Refused(words)) => return vec![Finding::Refused(words)],
            ran => tried.push((way.name, ran)),
        }
    }
    let references: Vec<_> = REFERENCES.iter().map(|way| run(&text, way)).collect();
    let mut trusted = Vec::new();
    for (way, reference) in REFERENCES.iter().zip(references) {
        match reference {
            Ok(ran) => trusted.push(ran),
            Err(NotRan::Panicked(words)) => return vec![Finding::Panicked(format!("{}: {words}", way.name))],
            Err(NotRan::Refused(words) | NotRan::Failed(words)) => {
                tried.push((way.name, Err(NotRan::Failed(words))));
            }
        }
    }
    let mut findings = Vec::new();
    let some_ran = tried.iter().any(|(_, ran)| ran.is_ok()) || !trusted.is_empty();
    for (name, ran) in &tried {
        if let Err(NotRan::Failed(words)) = ran {
            let words = format!("{name}: {words}");
            findings.push(if some_ran { Finding::Failed(words) } else { Finding::Unsolved(words) });
        }
    }
    let [quarter, chosen] = trusted.as_slice() else { return findings };
    let way = way_gone(&quarter.record);
    // A model that hardly moves is compared with what can be seen of it.
    let scale = way.max(1e-4);
    match difference(&quarter.record, &chosen.record) {
        Some((gap, _)) if gap <= TRUSTED * scale => {}
        Some((gap, place)) => {
            let reported = [quarter, chosen].iter().any(|ran| !ran.warnings.is_empty());
            let words =
                format!("{:.1e} of the way between the references, {place}, warned: {reported}", gap / scale);
            findings.push(Finding::Sensitive(words));
            return findings;
        }
        None => {
            findings.push(Finding::Sensitive("the references have other instants".to_owned()));
            return findings;
        }
    }
    let is_fast = fastest_turn(&quarter.record) * STEP > FAST;
    let loses = |ran: &Ran| {
        drift(mechanism, &ran.record).or_else(|| {
            (ran.violation > 1e-6).then(|| format!("constraints are violated by {:.1e}", ran.violation))
        })
    };
    let held = |name: &str, ran: &Ran| {
        let words = loses(ran).filter(|_| ran.warnings.is_empty());
        words.map(|words| Finding::Wrong(format!("{name}: {words}")))
    };
    findings.extend(held(REFERENCES[0].name, quarter));
    for (name, ran) in &tried {
        let Ok(ran) = ran else { continue };
        let Some((gap, place)) = difference(&quarter.record, &ran.record) else { continue };
        let is_wrong = gap > WRONG * scale || gap.is_nan();
        if is_wrong && ran.warnings.is_empty() {
            let words = format!("{name}: {:.1e} of the way beside the reference, {place}", gap / scale);
            findings.push(if is_fast { Finding::Coarse(words) } else { Finding::Wrong(words) });
        } else if let Some(finding) = held(name, ran) {
            findings.push(finding);
        } else if !is_wrong && gap <= TRUSTED * scale && !ran.warnings.is_empty() && loses(ran).is_none() {
            findings.push(Finding::FalseAlarm(format!("{name}: {}", ran.warnings.join("; "))));
        }
    }
    if findings.is_empty() {
        findings.push(Finding::Agreed);
    }
    findings
}
