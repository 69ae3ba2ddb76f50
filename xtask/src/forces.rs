//! `cargo xtask forces`: reactions and accelerations that random mechanisms record with default settings, against those of a
//! finer solution by another scheme.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::panic::{AssertUnwindSafe, catch_unwind};

use lissom::{Model, Override, Record};

use crate::cases::results;
use crate::random;

/// What is compared.
#[derive(clap::Args)]
pub(crate) struct ForcesArguments {
    /// Mechanisms to try
    #[arg(long, default_value_t = 300)]
    count: u64,
    /// Seed of all
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Number of the first mechanism
    #[arg(long, default_value_t = 0)]
    first: u64,
    /// Relative tolerance of the steps that are tried; default that of the program
    #[arg(long)]
    tolerance: Option<f64>,
    /// Scheme that is tried; default that of the program
    #[arg(long)]
    scheme: Option<String>,
    /// Errors that determine the steps that are tried (`forces`, for example); default that of the program
    #[arg(long)]
    control: Option<String>,
    /// Largest median, 95th percentile and maximum of the errors of a quantity, relative to its largest value
    #[arg(long, num_args = 3, default_values_t = [1e-6, 1e-5, 1e-3])]
    within: Vec<f64>,
    /// Mechanisms that run at the same time
    #[arg(long, default_value_t = 2)]
    threads: usize,
    /// Print the text of the first mechanism, and try nothing
    #[arg(long)]
    text: bool,
    /// Print the errors of every mechanism
    #[arg(long, short)]
    verbose: bool,
}

/// The finer solution.
const REFERENCE: [(&str, &str); 2] =
    [("analysis.scheme", "\"radau-iia-5\""), ("analysis.relative_tolerance", "1e-9")];

/// Forces and accelerations that are smaller are nothing [N, N m, m/s²].
const NOTHING: f64 = 1e-6;

/// Mechanisms whose parts move less are at rest [m].
const AT_REST: f64 = 1e-9;

/// Quantities that are smaller than this fraction of the largest of their kind are not compared: their errors are those of the
/// larger ones.
const SMALLEST: f64 = 1e-3;

/// Errors of a mechanism by kind of quantity, relative to its largest value; or why there are none.
type Errors = Result<Vec<(&'static str, f64, String)>, String>;

/// Compares forces; whether those of rigid parts are accurate.
pub(crate) fn forces(arguments: &ForcesArguments) -> bool {
    let text = |index| text(&random::text(arguments.seed, index));
    if arguments.text {
        print!("{}", text(arguments.first));
        return true;
    }
    let mut settings: Vec<(String, String)> = Vec::new();
    if let Some(tolerance) = arguments.tolerance {
        settings.push(("analysis.relative_tolerance".to_owned(), tolerance.to_string()));
    }
    if let Some(scheme) = &arguments.scheme {
        settings.push(("analysis.scheme".to_owned(), format!("\"{scheme}\"")));
    }
    if let Some(control) = &arguments.control {
        settings.push(("analysis.control".to_owned(), format!("\"{control}\"")));
    }
    let reference: Vec<Override> =
        REFERENCE.iter().map(|(path, value)| ((*path).to_owned(), (*value).to_owned())).collect();
    let range = arguments.first..arguments.first.saturating_add(arguments.count);
    let found = results(range, arguments.threads, None, |index| -> Errors {
        let text = text(index);
        compared(&run(&text, &settings)?, &run(&text, &reference)?)
    });
    let mut by_kind: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    let mut unknown = 0;
    for (index, errors) in &found {
        match errors {
            Ok(errors) => {
                let is_flexible = random::text(arguments.seed, *index).contains("[beams.");
                let of = if is_flexible { "with beams" } else { "of rigid parts" };
                for (kind, error, name) in errors {
                    by_kind.entry(format!("{kind} {of}")).or_default().push(*error);
                    if arguments.verbose && (*error > arguments.within[1] || error.is_nan()) {
                        println!("{index}: {name} errs by {error:.1e}");
                    }
                }
            }
            Err(reason) => {
                unknown += 1;
                if arguments.verbose {
                    println!("{index}: not compared: {reason}");
                }
            }
        }
    }
    let mut is_accurate = true;
    for (kind, errors) in &mut by_kind {
        errors.sort_by(f64::total_cmp);
        let at = |fraction: f64| errors[((errors.len() - 1) as f64 * fraction).round() as usize];
        let [median, most, largest] = [at(0.5), at(0.95), at(1.0)];
        let is_within =
            [median, most, largest].iter().zip(&arguments.within).all(|(error, limit)| error <= limit);
        // Forces of beams contain vibrations that steps chosen for positions do not resolve.
        is_accurate &= is_within || kind.starts_with("position") || kind.ends_with("with beams");
        println!(
            "{kind:30} {:5} quantities: median {median:.1e}, 95th percentile {most:.1e}, largest {largest:.1e}",
            errors.len()
        );
    }
    println!("{} mechanisms of seed {}, {unknown} not compared", found.len(), arguments.seed);
    is_accurate
}

/// A mechanism with default settings, and with outputs of its forces.
fn text(mechanism: &str) -> String {
    let mut text = String::new();
    let mut outputs = String::new();
    let is_setting = |line: &str| ["step =", "output_every ="].iter().any(|key| line.starts_with(key));
    for line in mechanism.lines().filter(|line| !is_setting(line)) {
        text.push_str(line);
        text.push('\n');
        let name = |table: &str| line.strip_prefix(table).and_then(|rest| rest.strip_suffix(']'));
        // Drives and couplings of generalised coordinates have no reaction between parts.
        if let Some(joint) = name("[joints.").filter(|name| *name != "own") {
            let _ = write!(outputs, "\n[outputs.reaction_{joint}]\nkind = \"reaction\"\nof = \"{joint}\"\n");
        }
        if let Some(body) = name("[bodies.") {
            let _ = write!(
                outputs,
                "\n[outputs.acceleration_{body}]\nkind = \"acceleration\"\nof = \"{body}\"\n"
            );
        }
        if let Some(beam) = name("[beams.") {
            let _ =
                write!(outputs, "\n[outputs.force_{beam}]\nkind = \"section_force\"\nof = \"{beam}@0.3\"\n");
        }
    }
    text.push_str("output_step = 0.02\n");
    text + &outputs
}

fn run(text: &str, settings: &[Override]) -> Result<Record, String> {
    let attempt = || -> Result<Record, String> {
        let model = Model::from_text("random.toml", text);
        let mut session = model.with_overrides(settings).session().map_err(|error| error.to_string())?;
        let (record, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
        report.error().map_or(Ok(record), |error| Err(error.to_string()))
    };
    catch_unwind(AssertUnwindSafe(attempt)).unwrap_or_else(|_| Err("a panic".to_owned()))
}

/// Errors of one record against another: of each output and unit, the largest of its components and instants.
fn compared(record: &Record, reference: &Record) -> Errors {
    const KINDS: [(&str, &str); 4] = [
        ("at_", "position"),
        ("reaction_", "reaction"),
        ("acceleration_", "acceleration"),
        ("force_", "section force"),
    ];
    let columns = reference.columns.iter().zip(&reference.values);
    let mut positions = columns.filter(|(column, _)| column.output.starts_with("at_"));
    if positions.all(|(_, values)| values.iter().all(|value| (value - values[0]).abs() < AT_REST)) {
        return Err("nothing moves".to_owned());
    }
    // Largest value and error of each quantity.
    let mut sizes: BTreeMap<(&'static str, &str, &str), [f64; 2]> = BTreeMap::new();
    for (column, values) in record.columns.iter().zip(&record.values) {
        let Some((_, kind)) = KINDS.iter().find(|(prefix, _)| column.output.starts_with(prefix)) else {
            continue;
        };
        let other = reference.column(&column.output, &column.component).ok_or("a column is missing")?;
        if other.len() != values.len() {
            return Err("the records have different instants".to_owned());
        }
        let [largest, error] = sizes.entry((kind, &column.unit, &column.output)).or_default();
        for (value, exact) in values.iter().zip(other) {
            *largest = largest.max(exact.abs());
            *error = error.max((value - exact).abs());
            if value.is_nan() != exact.is_nan() {
                *error = f64::NAN;
            }
        }
    }
    let mut largest: BTreeMap<(&str, &str), f64> = BTreeMap::new();
    for ((kind, unit, _), [size, _]) in &sizes {
        let most = largest.entry((kind, unit)).or_default();
        *most = most.max(*size);
    }
    let counted = sizes.iter().filter(|((kind, unit, _), [size, _])| {
        *size > SMALLEST * largest[&(*kind, *unit)] && *size > NOTHING
    });
    Ok(counted
        .map(|((kind, unit, name), [size, error])| (*kind, error / size, format!("{name} [{unit}]")))
        .collect())
}
