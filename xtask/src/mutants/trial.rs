//! Whether the tests notice a mutant: they run in stages, those that are built soonest first, until one fails.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde::{Deserialize, Serialize};

use super::MutantsError;

/// A stage that takes longer [s] hangs.
const LONGEST: u32 = 3600;
/// What `timeout` exits with where it has ended a program.
const TIMED_OUT: i32 = 124;
/// Lines of a failure that are shown.
const SHOWN: usize = 40;

/// What became of a mutant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Outcome {
    /// A test failed, this one first.
    Caught(String),
    /// The tests did not come to an end.
    Hung,
    /// It is no program.
    NotBuilt,
    /// No test noticed.
    Survived,
}

impl Outcome {
    pub(super) fn is_survivor(&self) -> bool {
        *self == Self::Survived
    }

    pub(super) fn words(&self) -> String {
        match self {
            Self::Caught(test) => format!("noticed by {test}"),
            Self::Hung => "noticed: the tests hang".to_owned(),
            Self::NotBuilt => "does not compile".to_owned(),
            Self::Survived => "NOT NOTICED".to_owned(),
        }
    }
}

/// Tests in a copy of the project.
pub(super) struct Trials {
    tree: PathBuf,
    build: PathBuf,
    /// Targets of each stage, as arguments of `cargo test --workspace`, with the first crate whose code they see.
    stages: Vec<Vec<String>>,
}

impl Trials {
    /// Tests of the project in `tree`, built in `build`.
    ///
    /// # Errors
    /// If the tests cannot be listed.
    pub(super) fn new(tree: &Path, build: &Path) -> Result<Self, MutantsError> {
        let tests = |name: &str| -> Result<Vec<String>, MutantsError> {
            let names = test_targets(&tree.join("crates").join(name).join("tests"))?;
            Ok(names.into_iter().flat_map(|name| ["--test".to_owned(), name]).collect())
        };
        let units = |mut stage: Vec<String>, kind: &str| {
            stage.insert(0, kind.to_owned());
            stage
        };
        // What the model file means is seen by the later stages alone.
        let stages = vec![
            tests("lissom-core")?,
            units(tests("lissom-model")?, "--lib"),
            units(tests("lissom")?, "--bins"),
        ];
        Ok(Self { tree: tree.to_owned(), build: build.to_owned(), stages })
    }

    /// Runs all tests of the code as it is.
    ///
    /// # Errors
    /// If one fails.
    pub(super) fn baseline(&self) -> Result<(), MutantsError> {
        match self.stages(&self.stages)? {
            (Outcome::Survived, _) => Ok(()),
            (_, output) => Err(MutantsError::Baseline(output)),
        }
    }

    /// Runs the tests that may notice a change of `file` until one fails.
    ///
    /// # Errors
    /// If they cannot be run.
    pub(super) fn run(&self, file: &str) -> Result<Outcome, MutantsError> {
        let first = usize::from(!file.starts_with("crates/lissom-core/"));
        Ok(self.stages(&self.stages[first..])?.0)
    }

    fn stages(&self, stages: &[Vec<String>]) -> Result<(Outcome, String), MutantsError> {
        for stage in stages {
            let built = self.cargo(stage, true)?;
            if !built.status.success() {
                let output = tail(&String::from_utf8_lossy(&built.stderr));
                // A full disk, or a build that was ended, says nothing of the mutant.
                if output.contains("could not compile") {
                    return Ok((Outcome::NotBuilt, output));
                }
                return Err(MutantsError::Build(output));
            }
            let run = self.cargo(stage, false)?;
            let output = String::from_utf8_lossy(&run.stdout).into_owned();
            match run.status.code() {
                Some(0) => {}
                Some(TIMED_OUT) => return Ok((Outcome::Hung, tail(&output))),
                _ => return Ok((Outcome::Caught(first_failure(&output)), tail(&output))),
            }
        }
        Ok((Outcome::Survived, String::new()))
    }

    /// Builds the tests of a stage, or runs them.
    fn cargo(&self, stage: &[String], only_build: bool) -> Result<Output, MutantsError> {
        // The one that runs this program, if one does.
        let program = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        // Programs that tests start end with it.
        let mut command = Command::new("timeout");
        command.arg("--kill-after=10").arg(LONGEST.to_string()).arg(program);
        command.args(["test", "--quiet", "--workspace"]).args(stage);
        if only_build {
            command.arg("--no-run");
        }
        command.current_dir(&self.tree).env("CARGO_TARGET_DIR", &self.build);
        // Nobody looks at these programs with a debugger.
        command.env("CARGO_PROFILE_DEV_DEBUG", "0").env("CARGO_TERM_COLOR", "never");
        command.output().map_err(MutantsError::about("timeout cargo test"))
    }
}

/// Names of the test programs in a folder.
fn test_targets(folder: &Path) -> Result<Vec<String>, MutantsError> {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).map_err(MutantsError::about(folder.display()))? {
        let path = entry.map_err(MutantsError::about(folder.display()))?.path();
        let is_target = path.extension().is_some_and(|end| end == "rs") || path.join("main.rs").is_file();
        if let Some(name) = path.file_stem().and_then(|name| name.to_str()).filter(|_| is_target) {
            names.push(name.to_owned());
        }
    }
    names.sort();
    Ok(names)
}

/// Name of the test that failed first, from what `cargo test` writes.
fn first_failure(output: &str) -> String {
    let named = output.lines().find_map(|line| line.strip_prefix("---- ")?.strip_suffix(" stdout ----"));
    named.map_or_else(|| "a test program that broke down".to_owned(), |name| format!("`{name}`"))
}

/// The last lines.
fn tail(output: &str) -> String {
    let lines: Vec<&str> = output.lines().collect();
    lines[lines.len().saturating_sub(SHOWN)..].join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_test_that_fails_is_named() {
        let output =
            "running 3 tests\n.F.\nfailures:\n\n---- sections::tests::a_tube stdout ----\npanicked\n";
        assert_eq!(first_failure(output), "`sections::tests::a_tube`");
        assert_eq!(first_failure("Segmentation fault"), "a test program that broke down");
    }

    #[test]
    fn every_test_program_of_the_project_belongs_to_a_stage() {
        let trials = Trials::new(&crate::verify::root(), Path::new("")).expect("the tests are listed");
        let has = |stage: usize, name: &str| trials.stages[stage].iter().any(|argument| argument == name);
        assert!(has(0, "derivatives") && has(1, "schema") && has(2, "command_line"));
        assert!(has(1, "--lib") && has(2, "--bins") && !has(2, "support"));
    }
}
