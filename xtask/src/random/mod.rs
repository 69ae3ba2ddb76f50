//! `cargo xtask random`: random mechanisms through the same path as a user's model file, each with several schemes and
//! steps, against energy, momentum, a quarter of the step and each other. A seed determines every case.

pub(crate) mod draw;
mod mechanism;
mod reduce;
mod trial;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use mechanism::mechanism;
use trial::{Finding, trial};

use crate::cases::results;

/// Options of the trials.
#[derive(clap::Args)]
pub(crate) struct RandomArguments {
    /// Mechanisms to try
    #[arg(long, default_value_t = 200)]
    count: u64,
    /// Seed of all
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Number of the first mechanism
    #[arg(long, default_value_t = 0)]
    first: u64,
    /// Stop after so many minutes
    #[arg(long)]
    minutes: Option<f64>,
    /// Mechanisms that run at the same time
    #[arg(long, default_value_t = 2)]
    threads: usize,
    /// Folder for the models in which something was found
    #[arg(long, default_value = "out/random")]
    keep: PathBuf,
    /// Reduce each model found to the tables that the finding requires
    #[arg(long)]
    reduce: bool,
    /// Print the text of the first mechanism, and try nothing
    #[arg(long)]
    text: bool,
    /// Print every finding, not only wrong answers and panics
    #[arg(long, short)]
    verbose: bool,
}

/// The text of a mechanism.
pub(crate) fn text(seed: u64, index: u64) -> String {
    mechanism(seed, index).text()
}

/// Tries mechanisms; whether none ended well with a wrong answer.
///
/// # Errors
/// If a model cannot be kept.
pub(crate) fn random(arguments: &RandomArguments) -> std::io::Result<bool> {
    if arguments.text {
        print!("{}", mechanism(arguments.seed, arguments.first).text());
        return Ok(true);
    }
    let began = Instant::now();
    let limit = arguments.minutes.map(|minutes| Duration::from_secs_f64(minutes.max(0.0) * 60.0));
    let deadline = limit.and_then(|limit| began.checked_add(limit));
    // A panic is a finding, and reported as one.
    std::panic::set_hook(Box::new(|_| {}));
    let range = arguments.first..arguments.first.saturating_add(arguments.count);
    let found = results(range, arguments.threads, deadline, |index| trial(&mechanism(arguments.seed, index)));
    let _ = std::panic::take_hook();
    print_findings(arguments, &found)?;
    let defects = found.values().filter(|findings| findings.iter().any(Finding::is_defect)).count();
    println!(
        "{} mechanisms of seed {} in {:.0} s: {defects} with a wrong answer or a panic",
        found.len(),
        arguments.seed,
        began.elapsed().as_secs_f64()
    );
    Ok(defects == 0)
}

/// Prints the findings, stores the models, and counts.
fn print_findings(arguments: &RandomArguments, found: &BTreeMap<u64, Vec<Finding>>) -> std::io::Result<()> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    let mut reasons: BTreeMap<String, (usize, u64)> = BTreeMap::new();
    for (index, findings) in found {
        for finding in findings {
            *counts.entry(finding.word()).or_default() += 1;
            if matches!(finding, Finding::Agreed) {
                continue;
            }
            let reason = format!("{}: {}", finding.word(), without_numbers(finding.words()));
            reasons.entry(reason).or_insert((0, *index)).0 += 1;
            if finding.is_defect() || arguments.verbose {
                println!("{index}: {}: {}", finding.word(), finding.words().trim_end());
            }
            if finding.is_defect() {
                let mut model = mechanism(arguments.seed, *index);
                if arguments.reduce {
                    model = reduce::reduced(model, finding);
                }
                std::fs::create_dir_all(&arguments.keep)?;
                let path = arguments.keep.join(format!("{}-{index}.toml", arguments.seed));
                let words = finding.words().replace('\n', " ");
                std::fs::write(&path, format!("# {}: {words}\n{}", finding.word(), model.text()))?;
                println!("    kept as {}", path.display());
            }
        }
    }
    let texts: String = found.keys().map(|index| mechanism(arguments.seed, *index).text()).collect();
    let missing = kinds_without(&texts);
    if !missing.is_empty() {
        println!("no mechanism has {}", missing.join(", "));
    }
    for (word, count) in &counts {
        println!("{count:6} {word}");
    }
    let mut reasons: Vec<_> = reasons.into_iter().collect();
    reasons.sort_by_key(|(_, (count, _))| std::cmp::Reverse(*count));
    for (reason, (count, first)) in reasons.iter().take(40) {
        println!("{count:6} × {reason} (first: {first})");
    }
    Ok(())
}

/// Kinds of joints, springs and loads that the texts do not have.
fn kinds_without(texts: &str) -> Vec<&'static str> {
    let registry = lissom_model::lower::registry::registry();
    let kinds = registry.joints.iter().chain(&registry.springs).chain(&registry.loads);
    kinds.map(|kind| kind.name).filter(|name| !texts.contains(&format!("kind = \"{name}\""))).collect()
}

/// The words without numbers and names, so that like reasons are counted together.
fn without_numbers(words: &str) -> String {
    let mut short = String::new();
    let mut is_quoted = false;
    for c in words.chars().take(260) {
        match c {
            '`' => {
                is_quoted = !is_quoted;
                short.push('`');
            }
            _ if is_quoted => {}
            '0'..='9' | '.' | '-' | '+' if short.ends_with('#') => {}
            '0'..='9' => short.push('#'),
            '\n' => short.push(' '),
            _ => short.push(c),
        }
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_determines_the_mechanism() {
        assert_eq!(mechanism(3, 5).text(), mechanism(3, 5).text());
        assert_ne!(mechanism(3, 5).text(), mechanism(3, 6).text());
        assert_ne!(mechanism(3, 5).text(), mechanism(4, 5).text());
    }

    /// Kinds that the generator does not make: a wheel on a rail needs the other rail, and runs off where it is not led; a tyre is tested
    /// against formulas alone; there are no meshes, whose sets have mean motions.
    const NOT_MADE: [&str; 3] = ["wheel_on_rail", "tyre", "mean_motion"];

    #[test]
    fn mechanisms_have_all_kinds_that_are_meant() {
        let text: String = (0..400).map(|index| mechanism(1, index).text()).collect();
        let missing: Vec<_> =
            kinds_without(&text).into_iter().filter(|kind| !NOT_MADE.contains(kind)).collect();
        assert!(missing.is_empty(), "no mechanism has {missing:?}");
        assert!(kinds_without("").len() > 30);
    }

    #[test]
    fn like_reasons_are_counted_together() {
        assert_eq!(
            without_numbers("step to t = 1.05e-3 s of `b1`"),
            without_numbers("step to t = 2.5e-3 s of `b12`")
        );
        assert_ne!(without_numbers("no"), without_numbers("yes"));
    }
}
