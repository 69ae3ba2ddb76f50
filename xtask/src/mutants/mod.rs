//! `cargo xtask mutants`: breaks the code on purpose, one place at a time, and tells what no test notices. A seed chooses a
//! sample of the places, whose first part is a sample too; all of them are built at once, and one is chosen for each run.

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

/// What is broken.
#[derive(clap::Args)]
pub(crate) struct MutantsArguments {
    /// Mutants to choose
    #[arg(long, default_value_t = 300)]
    sample: usize,
    /// Seed of the choice
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Begin no trial after so many minutes; the same command goes on from there
    #[arg(long)]
    minutes: Option<f64>,
    /// Part of the names of mutants to choose from, as `joints/`
    #[arg(long, default_value = "")]
    only: String,
    /// Print the mutants chosen, and try none
    #[arg(long)]
    list: bool,
    /// Try again those that survived
    #[arg(long)]
    survivors: bool,
    /// Folder for the copy that is broken, its build, and what is known
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
        /// What the system says.
        error: std::io::Error,
    },
    /// A file of the project is no Rust.
    #[error("{file}: {what}")]
    Source {
        /// The file.
        file: String,
        /// What is wrong.
        what: String,
    },
    /// Tests fail in code that is not broken.
    #[error("the tests fail without a mutant, so that they tell nothing of mutants:\n{0}")]
    Baseline(String),
    /// Something else than a mutant keeps the tests from being built.
    #[error("the tests cannot be built:\n{0}")]
    Build(String),
    /// What is known cannot be read or written.
    #[error("{what}: {error}")]
    Json {
        /// What is read.
        what: String,
        /// What is wrong.
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

/// Tries mutants; whether all were noticed.
///
/// # Errors
/// If the copy cannot be made or run, or the tests fail in code that is not broken.
pub(crate) fn mutants(arguments: &MutantsArguments) -> Result<bool, MutantsError> {
    let root = root();
    let sample = sample(place::list(&root)?, arguments);
    if arguments.list {
        for mutant in &sample {
            println!("{}", mutant.name());
        }
        return Ok(true);
    }
    let folder = root.join(&arguments.folder);
    let mut known = Known::read(&folder)?;
    let trials = trials(&root, &folder, &sample, &arguments.targets, &mut known)?;
    let began = Instant::now();
    let limit = arguments.minutes.map(|minutes| Duration::from_secs_f64(60.0 * minutes.max(0.0)));
    for (number, mutant) in &sample_with_numbers(&sample) {
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
        let outcome = trials.try_mutant(*number)?;
        println!("{:5.0} s  {}: {}", began.elapsed().as_secs_f64(), mutant.name(), outcome.words());
        // Other tests may notice it.
        if arguments.targets.is_empty() || !outcome.is_survivor() {
            known.note(mutant, outcome);
            known.write(&folder)?;
        }
    }
    // Up to the first that is not known: those behind it that are would be the ones that are noticed soonest.
    let tried: Vec<(&Mutant, &Outcome)> =
        sample.iter().map_while(|mutant| Some((mutant, known.outcome(mutant)?))).collect();
    let figures = table::Figures::of(&tried, sample.len(), arguments.seed);
    println!("{}", figures.words());
    if arguments.only.is_empty() && arguments.targets.is_empty() {
        table::write(&root.join("docs/mutants.md"), &figures, &tried)?;
    }
    Ok(figures.survived == 0)
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
                    known.note(&sample[number - 1], Outcome::NotBuilt);
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

/// Mutants in the order in which they are tried. Each has its own random number, so that the others stay in the sample
/// when code is added or removed.
fn sample(mut all: Vec<Mutant>, arguments: &MutantsArguments) -> Vec<Mutant> {
    all.retain(|mutant| mutant.name().contains(&arguments.only));
    let number = |mutant: &Mutant| Draw::new(arguments.seed, place::mark(&mutant.key())).fraction();
    all.sort_by(|a, b| number(a).total_cmp(&number(b)));
    all.truncate(arguments.sample);
    all
}

/// What is known of mutants, by key. A mutant whose function has changed since is not known.
#[derive(Default, serde::Serialize, serde::Deserialize)]
struct Known(std::collections::BTreeMap<String, (u64, Outcome)>);

impl Known {
    fn path(folder: &Path) -> PathBuf {
        folder.join("known.json")
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
        let (mark, outcome) = self.0.get(&mutant.key())?;
        (*mark == mutant.mark).then_some(outcome)
    }

    fn note(&mut self, mutant: &Mutant, outcome: Outcome) {
        self.0.insert(mutant.key(), (mutant.mark, outcome));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arguments(sample: usize, seed: u64) -> MutantsArguments {
        MutantsArguments {
            sample,
            seed,
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
            let chosen = super::sample(all.to_vec(), &arguments(sample, seed));
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
        known.note(&mutant, Outcome::Survived);
        assert!(known.outcome(&mutant).is_some());
        let mut changed = mutant;
        changed.mark += 1;
        assert!(known.outcome(&changed).is_none());
    }
}
