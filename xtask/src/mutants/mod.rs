//! `cargo xtask mutants`: breaks the code on purpose, one place at a time, and tells what no test notices. What can be broken
//! lists cargo-mutants; a seed chooses a sample, whose first part is a sample too.

mod copy;
mod mutant;
mod table;
mod trial;

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use mutant::Mutant;
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
    /// Do not run the tests of the unbroken code first
    #[arg(long)]
    no_baseline: bool,
    /// Folder for the copy that is broken, its build, and what is known
    #[arg(long, default_value = "target/mutants")]
    folder: PathBuf,
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
    /// cargo-mutants is not there, or lists nothing.
    #[error("`cargo mutants --list` fails: `cargo install cargo-mutants` has it\n{0}")]
    List(String),
    /// Tests fail in code that is not broken.
    #[error("the tests fail without a mutant, so that they tell nothing of mutants:\n{0}")]
    Baseline(String),
    /// Something else than a mutant keeps the tests from being built.
    #[error("the tests cannot be built:\n{0}")]
    Build(String),
    /// The list of mutants, or what is known, is none.
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
}

/// Tries mutants; whether all were noticed.
///
/// # Errors
/// If the copy cannot be made or run, or the tests fail in code that is not broken.
pub(crate) fn mutants(arguments: &MutantsArguments) -> Result<bool, MutantsError> {
    let root = root();
    let all = mutant::list(&root)?;
    let sample = sample(all, arguments);
    if arguments.list {
        for mutant in &sample {
            println!("{}", mutant.name);
        }
        return Ok(true);
    }
    let folder = root.join(&arguments.folder);
    let mut known = Known::read(&folder)?;
    let tree = folder.join("tree");
    copy::bring_up_to_date(&root, &tree)?;
    let trials = Trials::new(&tree, &folder.join("build"))?;
    if !arguments.no_baseline {
        trials.baseline()?;
    }
    let began = Instant::now();
    let limit = arguments.minutes.map(|minutes| Duration::from_secs_f64(60.0 * minutes.max(0.0)));
    for mutant in &sample {
        let is_known =
            known.outcome(mutant).is_some_and(|outcome| !(arguments.survivors && outcome.is_survivor()));
        if is_known || (arguments.survivors && known.outcome(mutant).is_none()) {
            continue;
        }
        if limit.is_some_and(|limit| began.elapsed() >= limit) {
            break;
        }
        let outcome = mutant.broken(&tree, || trials.run(&mutant.file))??;
        println!("{:5.0} s  {}: {}", began.elapsed().as_secs_f64(), mutant.name, outcome.words());
        known.note(mutant, outcome);
        known.write(&folder)?;
    }
    let tried: Vec<(&Mutant, &Outcome)> =
        sample.iter().filter_map(|mutant| Some((mutant, known.outcome(mutant)?))).collect();
    let figures = table::Figures::of(&tried, sample.len(), arguments.seed);
    println!("{}", figures.words());
    if arguments.only.is_empty() {
        table::write(&root.join("docs/mutants.md"), &figures, &tried)?;
    }
    Ok(figures.survived == 0)
}

/// Mutants in the order in which they are tried.
fn sample(mut all: Vec<Mutant>, arguments: &MutantsArguments) -> Vec<Mutant> {
    all.retain(|mutant| mutant.name.contains(&arguments.only));
    let mut draw = Draw::new(arguments.seed, 0);
    let count = arguments.sample.min(all.len());
    for place in 0..count {
        let other = place + draw.below(all.len() - place);
        all.swap(place, other);
    }
    all.truncate(count);
    all
}

/// What is known of mutants, by name. A mutant whose file has changed since is not known.
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
        serde_json::from_str(&text)
            .map_err(|error| MutantsError::Json { what: path.display().to_string(), error })
    }

    fn write(&self, folder: &Path) -> Result<(), MutantsError> {
        let path = Self::path(folder);
        let text = serde_json::to_string_pretty(self)
            .map_err(|error| MutantsError::Json { what: path.display().to_string(), error })?;
        std::fs::write(&path, text).map_err(MutantsError::about(path.display()))
    }

    fn outcome(&self, mutant: &Mutant) -> Option<&Outcome> {
        let (mark, outcome) = self.0.get(&mutant.name)?;
        (*mark == mutant.mark).then_some(outcome)
    }

    fn note(&mut self, mutant: &Mutant, outcome: Outcome) {
        self.0.insert(mutant.name.clone(), (mutant.mark, outcome));
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
            no_baseline: false,
            folder: PathBuf::new(),
        }
    }

    #[test]
    fn a_sample_begins_with_every_shorter_one_and_changes_with_the_seed() {
        let all: Vec<Mutant> = (0..1000).map(|number| Mutant::named(&number.to_string())).collect();
        let names = |sample, seed| -> Vec<String> {
            let chosen = super::sample(all.clone(), &arguments(sample, seed));
            chosen.into_iter().map(|mutant| mutant.name).collect()
        };
        let long = names(300, 7);
        assert_eq!(names(20, 7), long[..20]);
        assert_ne!(names(300, 8), long);
        let different: std::collections::BTreeSet<&String> = long.iter().collect();
        assert_eq!(different.len(), 300);
        assert_eq!(names(5000, 7).len(), 1000);
    }

    #[test]
    fn what_is_known_of_a_file_that_has_changed_is_forgotten() {
        let mut known = Known::default();
        let mutant = Mutant::named("a");
        known.note(&mutant, Outcome::Survived);
        assert!(known.outcome(&mutant).is_some());
        let mut changed = mutant;
        changed.mark += 1;
        assert!(known.outcome(&changed).is_none());
    }
}
