//! `cargo xtask mutants`: mutation tests. Each seed draws a sample of the mutants, whose first part is a sample too. All samples are
//! built at once, and an environment variable selects one mutant for each run.

mod build;
mod copy;
mod place;
mod replacement;
mod switch;
mod table;
mod trial;

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use build::Built;
use place::Mutant;
use switch::Files;
use trial::{Outcome, Trials};

use crate::random::draw::Draw;
use crate::verify::root;

/// Largest share of survivors with which the command succeeds.
const MAX_SURVIVORS: f64 = 0.03;

/// Options of the command.
#[derive(clap::Args)]
pub(crate) struct MutantsArguments {
    /// Seeds of the samples, separated by commas; they are fresh if no test was written for their survivors
    #[arg(long, value_delimiter = ',', required = true)]
    seed: Vec<u64>,
    /// Number of mutants in the sample of each seed
    #[arg(long, default_value_t = 120)]
    sample: usize,
    /// Start no trial after this many minutes; the same command continues from there
    #[arg(long)]
    minutes: Option<f64>,
    /// Restrict the samples to mutants whose name contains this text, for example `joints/`
    #[arg(long, default_value = "")]
    only: String,
    /// Print the samples without trying them
    #[arg(long)]
    list: bool,
    /// Try the survivors of the samples again; the figures of the seeds are kept
    #[arg(long)]
    survivors: bool,
    /// Folder for the mutated copy, its build and the outcomes
    #[arg(long, default_value = "target/mutants")]
    folder: PathBuf,
    /// Tests to build and run, as arguments of `cargo test`, as `-- --lib`; what they do not notice stays unknown
    #[arg(last = true)]
    targets: Vec<String>,
}

/// Where files cannot be handled or programs not be run.
#[derive(Debug, thiserror::Error)]
pub(crate) enum MutantsError {
    /// A file or program.
    #[error("{what}: {error}")]
    System {
        /// The file, or the program.
        what: String,
        /// The error of the system.
        error: std::io::Error,
    },
    /// A file of the project is no Rust.
    #[error("{file}: {what}")]
    Source {
        /// The file.
        file: String,
        /// The error.
        what: String,
    },
    /// Tests fail in code that is not broken.
    #[error("the tests fail without a mutant, so their results with mutants are meaningless:\n{0}")]
    Baseline(String),
    /// Something else than a mutant keeps the tests from being built.
    #[error("the tests cannot be built:\n{0}")]
    Build(String),
    /// The stored results cannot be read or written.
    #[error("{what}: {error}")]
    Json {
        /// The file.
        what: String,
        /// The error.
        error: serde_json::Error,
    },
}

impl MutantsError {
    /// An error of the system about something.
    fn about(what: impl std::fmt::Display) -> impl FnOnce(std::io::Error) -> Self {
        let what = what.to_string();
        move |error| Self::System { what, error }
    }

    /// An error in a file about something.
    fn json(what: impl std::fmt::Display) -> impl FnOnce(serde_json::Error) -> Self {
        let what = what.to_string();
        move |error| Self::Json { what, error }
    }
}

/// Tries mutants; returns whether at most [`MAX_SURVIVORS`] of each sample survive.
///
/// # Errors
/// If the copy cannot be made or run, or the tests fail without a mutant.
pub(crate) fn mutants(arguments: &MutantsArguments) -> Result<bool, MutantsError> {
    let root = root();
    let all = place::list(&root)?;
    let samples: Vec<Vec<Mutant>> =
        arguments.seed.iter().map(|&seed| sample(all.clone(), arguments, seed)).collect();
    if arguments.list {
        for mutant in samples.iter().flatten() {
            println!("{}", mutant.name());
        }
        return Ok(true);
    }
    let folder = root.join(&arguments.folder);
    let mut known = Known::read(&folder)?;
    let union = union(&samples);
    let trials = trials(&root, &folder, &union, &arguments.targets, &mut known)?;
    if !arguments.survivors {
        known.forget_survivors_of_other_builds(trials.built());
    }
    let began = Instant::now();
    let limit = arguments.minutes.map(|minutes| Duration::from_secs_f64(60.0 * minutes.max(0.0)));
    for (number, mutant) in sample_with_numbers(&union) {
        let is_due = match known.outcome(mutant) {
            None => !arguments.survivors,
            Some(outcome) => arguments.survivors && outcome.is_survivor(),
        };
        if !is_due {
            continue;
        }
        if limit.is_some_and(|limit| began.elapsed() >= limit) {
            break;
        }
        let outcome = trials.try_mutant(number)?;
        println!("{:5.0} s  {}: {}", began.elapsed().as_secs_f64(), mutant.name(), outcome.words());
        // The tests that were not selected may notice it.
        if arguments.targets.is_empty() || !outcome.is_survivor() {
            known.note(mutant, outcome, trials.built());
            known.write(&folder)?;
        }
    }
    let is_recorded = arguments.only.is_empty() && arguments.targets.is_empty();
    let mut is_good = true;
    for (&seed, sample) in arguments.seed.iter().zip(&samples) {
        // Up to the first unknown one: mutants that are noticed soon would be over-represented behind it.
        let tried: Vec<(&Mutant, &Outcome)> =
            sample.iter().map_while(|mutant| Some((mutant, known.outcome(mutant)?))).collect();
        let figures = table::Figures::of(&tried, sample.len(), seed);
        println!("{}", figures.words());
        is_good &= figures.share() <= MAX_SURVIVORS;
        if is_recorded {
            table::write(&root.join("docs/mutants.md"), &figures, &tried)?;
        }
    }
    Ok(is_good)
}

/// The mutants of all samples, without repetition. The first ones of each sample come first.
fn union(samples: &[Vec<Mutant>]) -> Vec<Mutant> {
    let longest = samples.iter().map(Vec::len).max().unwrap_or(0);
    let mut keys = std::collections::BTreeSet::new();
    (0..longest)
        .flat_map(|index| samples.iter().filter_map(move |sample| sample.get(index)))
        .filter(|mutant| keys.insert(mutant.key()))
        .cloned()
        .collect()
}

/// Builds all mutants that are programs, and runs the tests without one.
fn trials(
    root: &Path,
    folder: &Path,
    sample: &[Mutant],
    targets: &[String],
    known: &mut Known,
) -> Result<Trials, MutantsError> {
    let tree = folder.join("tree");
    loop {
        let mut numbered = sample_with_numbers(sample);
        numbered.retain(|(_, mutant)| known.outcome(mutant) != Some(&Outcome::NotBuilt));
        let Files { parts, texts } = switch::files(root, &numbered)?;
        copy::bring_up_to_date(root, &tree, &texts)?;
        match build::build(&tree, &folder.join("build"), targets, &parts)? {
            Built::Programs(programs) => return Trials::new(programs, folder),
            Built::Refused(numbers) => {
                for number in numbers {
                    println!("{}: {}", sample[number - 1].name(), Outcome::NotBuilt.words());
                    known.note(&sample[number - 1], Outcome::NotBuilt, 0);
                }
                known.write(folder)?;
            }
        }
    }
}

/// Mutants with the numbers that choose them, from 1 on.
fn sample_with_numbers(sample: &[Mutant]) -> Vec<(usize, &Mutant)> {
    (1..).zip(sample).collect()
}

/// The sample of a seed, in the order of the trials. Each mutant has its own random number, so that the others stay in the sample
/// when code is added or removed.
fn sample(mut all: Vec<Mutant>, arguments: &MutantsArguments, seed: u64) -> Vec<Mutant> {
    all.retain(|mutant| mutant.name().contains(&arguments.only));
    let number = |mutant: &Mutant| Draw::new(seed, place::mark(&mutant.key())).fraction();
    all.sort_by(|a, b| number(a).total_cmp(&number(b)));
    all.truncate(arguments.sample);
    all
}

/// Outcome of a trial.
#[derive(serde::Serialize, serde::Deserialize)]
struct Entry {
    /// Changes with the function.
    mark: u64,
    outcome: Outcome,
    /// When the tests were built [ns since 1970].
    built: u64,
}

/// Outcomes by the mutants' keys. The outcome of a mutant whose function has changed since is not known.
#[derive(Default, serde::Serialize, serde::Deserialize)]
struct Known(std::collections::BTreeMap<String, Entry>);

impl Known {
    fn path(folder: &Path) -> PathBuf {
        folder.join("outcomes.json")
    }

    fn read(folder: &Path) -> Result<Self, MutantsError> {
        let path = Self::path(folder);
        if !path.is_file() {
            return Ok(Self::default());
        }
        let text = std::fs::read_to_string(&path).map_err(MutantsError::about(path.display()))?;
        serde_json::from_str(&text).map_err(MutantsError::json(path.display()))
    }

    fn write(&self, folder: &Path) -> Result<(), MutantsError> {
        let path = Self::path(folder);
        let text = serde_json::to_string_pretty(self).map_err(MutantsError::json(path.display()))?;
        std::fs::write(&path, text).map_err(MutantsError::about(path.display()))
    }

    fn outcome(&self, mutant: &Mutant) -> Option<&Outcome> {
        let entry = self.0.get(&mutant.key())?;
        (entry.mark == mutant.mark).then_some(&entry.outcome)
    }

    fn note(&mut self, mutant: &Mutant, outcome: Outcome, built: u64) {
        self.0.insert(mutant.key(), Entry { mark: mutant.mark, outcome, built });
    }

    /// Forgets the survivors of tests that have been rebuilt: newer tests may notice them.
    fn forget_survivors_of_other_builds(&mut self, built: u64) {
        self.0.retain(|_, entry| entry.built == built || !entry.outcome.is_survivor());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arguments(sample: usize) -> MutantsArguments {
        MutantsArguments {
            sample,
            seed: Vec::new(),
            minutes: None,
            only: String::new(),
            list: false,
            survivors: false,
            folder: PathBuf::new(),
            targets: Vec::new(),
        }
    }

    #[test]
    fn a_sample_begins_with_every_shorter_one_changes_with_the_seed_and_outlives_changes_of_the_code() {
        let all: Vec<Mutant> =
            (0..1000).map(|number| Mutant::named("file.rs", number, &number.to_string())).collect();
        let of = |all: &[Mutant], sample, seed| -> Vec<String> {
            let chosen = super::sample(all.to_vec(), &arguments(sample), seed);
            chosen.into_iter().map(|mutant| mutant.name()).collect()
        };
        let names = |sample, seed| of(&all, sample, seed);
        let long = names(300, 7);
        assert_eq!(names(20, 7), long[..20]);
        assert_ne!(names(300, 8), long);
        let different: std::collections::BTreeSet<&String> = long.iter().collect();
        assert_eq!(different.len(), 300);
        assert_eq!(names(5000, 7).len(), 1000);
        let fewer: Vec<String> = long.iter().filter(|name| !name.ends_with('3')).cloned().collect();
        let left: Vec<Mutant> = all.iter().filter(|mutant| !mutant.what.ends_with('3')).cloned().collect();
        assert_eq!(of(&left, fewer.len(), 7), fewer);
    }

    #[test]
    fn what_is_known_of_a_function_that_has_changed_is_forgotten() {
        let mut known = Known::default();
        let mutant = Mutant::named("file.rs", 1, "a");
        known.note(&mutant, Outcome::Survived, 7);
        assert!(known.outcome(&mutant).is_some());
        let mut changed = mutant;
        changed.mark += 1;
        assert!(known.outcome(&changed).is_none());
    }

    #[test]
    fn survivors_of_older_tests_are_tried_again() {
        let [a, b] = ["a", "b"].map(|what| Mutant::named("file.rs", 1, what));
        let mut known = Known::default();
        known.note(&a, Outcome::Unreached, 7);
        known.note(&b, Outcome::Hung, 7);
        known.forget_survivors_of_other_builds(7);
        assert!(known.outcome(&a).is_some());
        known.forget_survivors_of_other_builds(8);
        assert!(known.outcome(&a).is_none() && known.outcome(&b).is_some());
    }

    #[test]
    fn samples_are_united_without_repetition() {
        let sample = |names: &[&str]| names.iter().map(|what| Mutant::named("file.rs", 1, what)).collect();
        let all = union(&[sample(&["a", "b", "c"]), sample(&["b", "d"])]);
        let names: Vec<&str> = all.iter().map(|mutant| mutant.what.as_str()).collect();
        assert_eq!(names, ["a", "b", "d", "c"]);
    }
}
