//! Whether the tests notice a mutant: those that reach it run, the shortest first, until one fails.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufRead, BufReader};
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::MutantsError;
use super::build::{TestProgram, TestPrograms};
use super::switch::{REACHED, RECORD, VARIABLE};

/// A program that takes so many times as long as without a mutant hangs,
const PATIENCE: f64 = 5.0;
/// at the least so long [s]: the machine may be busy otherwise.
const SHORTEST: f64 = 30.0;
/// Bytes of addresses that a program may have: an endless loop may store something in each round.
const ADDRESSES: &str = "--as=12000000000";
/// What `timeout` exits with where it has ended a program, or killed it.
const TIMED_OUT: [i32; 2] = [124, 137];

/// Outcome of a mutant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Outcome {
    /// A test failed, this one first.
    Caught(String),
    /// The tests did not finish.
    Hung,
    /// It is no program.
    NotBuilt,
    /// No test noticed.
    Survived,
    /// No test reaches it.
    Unreached,
}

impl Outcome {
    pub(super) fn is_survivor(&self) -> bool {
        matches!(self, Self::Survived | Self::Unreached)
    }

    pub(super) fn words(&self) -> String {
        match self {
            Self::Caught(test) => format!("noticed by {test}"),
            Self::Hung => "noticed: the tests hang".to_owned(),
            Self::NotBuilt => "does not compile".to_owned(),
            Self::Survived => "NOT NOTICED".to_owned(),
            Self::Unreached => "NOT REACHED by any test".to_owned(),
        }
    }
}

/// Data of a program with tests when no mutant is chosen.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Unbroken {
    /// When it was built [ns since 1970].
    built: u64,
    /// How long it runs [s].
    seconds: f64,
    /// Tests of the program.
    tests: BTreeSet<String>,
    /// Threads that reach a mutant, by its number. Each test runs in a thread of its name.
    reached: BTreeMap<usize, BTreeSet<String>>,
    /// Whether it cannot be recorded, so that it is not known which mutants it reaches.
    is_unknown: bool,
}

impl Unbroken {
    /// The tests that reach a mutant; an empty list for all.
    fn tests_at(&self, number: usize) -> Option<Vec<String>> {
        if self.is_unknown {
            return Some(Vec::new());
        }
        let threads = self.reached.get(&number)?;
        Some(if threads.is_subset(&self.tests) { threads.iter().cloned().collect() } else { Vec::new() })
    }

    /// About how long so many of its tests take [s].
    fn cost(&self, tests: usize) -> f64 {
        let share = if tests == 0 { 1.0 } else { tests as f64 / self.tests.len() as f64 };
        self.seconds * share
    }
}

/// Outcome of one program.
struct Run {
    outcome: Outcome,
    tests: BTreeSet<String>,
    seconds: f64,
    output: String,
}

/// The tests, with their data.
pub(super) struct Trials {
    programs: TestPrograms,
    unbroken: BTreeMap<String, Unbroken>,
}

impl Trials {
    /// Runs all tests without a mutant, but those programs that have been run since they were built. What is known is kept
    /// in `folder`.
    ///
    /// # Errors
    /// If a test fails, or a program cannot be run.
    pub(super) fn new(programs: TestPrograms, folder: &Path) -> Result<Self, MutantsError> {
        let path = folder.join("reached.json");
        let text = std::fs::read_to_string(&path).unwrap_or_else(|_| "{}".to_owned());
        let unbroken = serde_json::from_str(&text).map_err(MutantsError::json(path.display()))?;
        let mut trials = Self { programs, unbroken };
        for program in trials.programs.tests.clone() {
            let built = trials.programs.built(&program);
            if trials.unbroken.get(&program.name).is_some_and(|known| known.built == built) {
                continue;
            }
            let known = trials.unbroken(&program, built, &folder.join("reached.txt"))?;
            println!("{:5.0} s without a mutant: {}", known.seconds, program.name);
            trials.unbroken.insert(program.name, known);
            let text = serde_json::to_string(&trials.unbroken).map_err(MutantsError::json(path.display()))?;
            std::fs::write(&path, text).map_err(MutantsError::about(path.display()))?;
        }
        Ok(trials)
    }

    /// When the newest program was built [ns since 1970].
    pub(super) fn built(&self) -> u64 {
        self.programs.tests.iter().map(|program| self.programs.built(program)).max().unwrap_or(0)
    }

    fn unbroken(&self, program: &TestProgram, built: u64, file: &Path) -> Result<Unbroken, MutantsError> {
        std::fs::write(file, "").map_err(MutantsError::about(file.display()))?;
        let variables = [(VARIABLE, RECORD.to_owned()), (REACHED, file.display().to_string())];
        let mut run = self.run(program, &[], &variables, None)?;
        // Some count what is allocated, which recording does as well.
        let is_unknown = run.outcome != Outcome::Survived;
        if is_unknown {
            run = self.run(program, &[], &[(VARIABLE, "0".to_owned())], None)?;
        }
        if run.outcome != Outcome::Survived {
            return Err(MutantsError::Baseline(format!("{}\n{}", program.name, run.output)));
        }
        let text = std::fs::read_to_string(file).map_err(MutantsError::about(file.display()))?;
        let mut reached: BTreeMap<usize, BTreeSet<String>> = BTreeMap::new();
        for (number, thread) in text.lines().filter_map(|line| line.split_once(' ')) {
            reached.entry(number.parse().unwrap_or(0)).or_default().insert(thread.to_owned());
        }
        Ok(Unbroken { built, seconds: run.seconds, tests: run.tests, reached, is_unknown })
    }

    /// Runs the tests that reach a mutant until one fails.
    ///
    /// # Errors
    /// If a program cannot be run.
    pub(super) fn try_mutant(&self, number: usize) -> Result<Outcome, MutantsError> {
        let mut plan: Vec<(f64, &TestProgram, &Unbroken, Vec<String>)> = Vec::new();
        for program in &self.programs.tests {
            let unbroken = &self.unbroken[&program.name];
            if let Some(tests) = unbroken.tests_at(number) {
                plan.push((unbroken.cost(tests.len()), program, unbroken, tests));
            }
        }
        let is_reached = plan.iter().any(|(_, _, unbroken, _)| !unbroken.is_unknown);
        plan.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, program, unbroken, tests) in plan {
            let limit = SHORTEST + PATIENCE * unbroken.seconds;
            let run = self.run(program, &tests, &[(VARIABLE, number.to_string())], Some(limit))?;
            if run.outcome != Outcome::Survived {
                return Ok(run.outcome);
            }
        }
        Ok(if is_reached { Outcome::Survived } else { Outcome::Unreached })
    }

    /// Runs tests of a program, all of its own if none is named; with a limit [s] until one fails.
    fn run(
        &self,
        program: &TestProgram,
        tests: &[String],
        variables: &[(&str, String)],
        limit: Option<f64>,
    ) -> Result<Run, MutantsError> {
        // Programs that tests start end with it.
        let mut command = Command::new("prlimit");
        command.args([ADDRESSES, "timeout", "--kill-after=10", &limit.unwrap_or(0.0).to_string()]);
        let tests = if tests.is_empty() { &program.tests } else { tests };
        command.arg(&program.executable).args(tests);
        if !tests.is_empty() {
            command.arg("--exact");
        }
        command.current_dir(&program.folder).env("CARGO_MANIFEST_DIR", &program.folder);
        command.envs(variables.iter().map(|(name, value)| (name, value)));
        command
            .envs(self.programs.started.iter().map(|(name, path)| (format!("CARGO_BIN_EXE_{name}"), path)));
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::null());
        // A group of its own, so that all of it can be killed: what a test has started would keep the pipe open.
        command.process_group(0);
        let began = Instant::now();
        let mut child = command.spawn().map_err(MutantsError::about("prlimit timeout"))?;
        let (mut passed, mut failed, mut output) = (BTreeSet::new(), None, String::new());
        for line in child.stdout.take().into_iter().flat_map(|output| BufReader::new(output).split(b'\n')) {
            let line = line.map_err(MutantsError::about(&program.name))?;
            let line = String::from_utf8_lossy(&line);
            match result(&line) {
                Some((test, true)) => {
                    passed.insert(test.to_owned());
                }
                Some((test, false)) if failed.is_none() => {
                    failed = Some(test.to_owned());
                    if limit.is_some() {
                        let mut end = Command::new("kill");
                        end.args(["-KILL", "--", &format!("-{}", child.id())]);
                        end.status().map_err(MutantsError::about("kill"))?;
                    }
                }
                _ => {}
            }
            output += &line;
            output.push('\n');
        }
        let status = child.wait().map_err(MutantsError::about(&program.name))?;
        let outcome = match (failed, status.code()) {
            (Some(test), _) => Outcome::Caught(format!("`{test}`")),
            (None, Some(0)) => Outcome::Survived,
            (None, Some(code)) if TIMED_OUT.contains(&code) => Outcome::Hung,
            _ => Outcome::Caught(format!("{}, which breaks down", program.name)),
        };
        Ok(Run { outcome, tests: passed, seconds: began.elapsed().as_secs_f64(), output })
    }
}

/// The test whose result a line reports, and whether it passed.
fn result(line: &str) -> Option<(&str, bool)> {
    let (test, result) = line.strip_prefix("test ")?.rsplit_once(" ... ")?;
    let test = test.strip_suffix(" - should panic").unwrap_or(test);
    match result {
        "ok" => Some((test, true)),
        "FAILED" => Some((test, false)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_read_from_the_lines_of_tests() {
        assert_eq!(result("test a::b ... ok"), Some(("a::b", true)));
        assert_eq!(result("test a::b - should panic ... ok"), Some(("a::b", true)));
        assert_eq!(result("test c ... FAILED"), Some(("c", false)));
        assert_eq!(result("test c ... ignored, takes hours"), None);
        assert_eq!(result("running 3 tests"), None);
    }

    #[test]
    fn only_tests_that_come_to_a_mutant_run() {
        let names = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect::<BTreeSet<String>>();
        let reached = [(1, names(&["a"])), (2, names(&["a", "main"]))].into();
        let known = Unbroken {
            seconds: 4.0,
            tests: names(&["a", "b"]),
            reached,
            is_unknown: false,
            ..Unbroken::default()
        };
        assert_eq!(known.tests_at(1), Some(vec!["a".to_owned()]));
        assert_eq!(known.tests_at(2), Some(Vec::new()));
        assert_eq!(known.tests_at(3), None);
        assert_eq!((known.cost(1), known.cost(0)), (2.0, 4.0));
        let unknown = Unbroken { is_unknown: true, ..known };
        assert_eq!(unknown.tests_at(3), Some(Vec::new()));
    }

    #[test]
    fn failures_and_programs_that_hang_are_noticed() {
        let program = TestProgram {
            name: "it".to_owned(),
            executable: "sh".into(),
            folder: std::env::temp_dir(),
            tests: Vec::new(),
        };
        let programs = TestPrograms { tests: Vec::new(), started: BTreeMap::new() };
        let trials = Trials { programs, unbroken: BTreeMap::new() };
        let outcome = |script: &str, limit: f64| {
            let (arguments, variables) = (["-c".to_owned(), script.to_owned()], [(VARIABLE, "7".to_owned())]);
            trials.run(&program, &arguments, &variables, Some(limit)).expect("the script runs").outcome
        };
        assert_eq!(outcome("echo test a ... ok", 60.0), Outcome::Survived);
        let failure = outcome("echo test a$LISSOM_MUTANT ... FAILED; sleep 600", 300.0);
        assert_eq!(failure, Outcome::Caught("`a7`".to_owned()));
        assert_eq!(outcome("sleep 600", 0.2), Outcome::Hung);
        assert!(matches!(outcome("kill -SEGV $$", 60.0), Outcome::Caught(_)));
    }
}
