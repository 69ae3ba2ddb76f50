//! Builds the tests of the copy once, with all mutants in them, and reports those that do not compile.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::UNIX_EPOCH;

use serde_json::Value;

use super::MutantsError;
use super::switch::Switched;

/// The module with tests of the source text, which has changed with all mutants.
const OF_THE_TEXT: &str = "house_rules";
/// All tests but those of the chores.
const ALL: [&str; 3] = ["--lib", "--test", "*"];
/// Settings of cargo.
const INCREMENTAL: [&str; 5] = [
    "profile.release.incremental=true",
    "profile.release.package.lissom-core.codegen-units=64",
    "profile.release.package.lissom-mechanics.codegen-units=64",
    "profile.release.package.lissom-flexible.codegen-units=64",
    "profile.release.package.lissom-contact.codegen-units=64",
];
/// Lines of the compiler that are shown.
const SHOWN: usize = 40;

/// A program with tests, or one module of it.
#[derive(Clone, Debug)]
pub(super) struct TestProgram {
    /// Crate and name of the program, and the name of the module.
    pub(super) name: String,
    pub(super) executable: PathBuf,
    /// The folder in which it runs.
    pub(super) folder: PathBuf,
    /// The tests of the module; empty for the whole program.
    pub(super) tests: Vec<String>,
}

impl TestProgram {
    /// The modules at the root of the program, each as a program of its own, without that of the source text. Threads that a test
    /// starts, and programs that it runs, cannot be attributed to the test: a mutant that they execute is tried with all tests of
    /// the module.
    fn modules(self) -> Result<Vec<Self>, MutantsError> {
        let mut command = Command::new(&self.executable);
        command.args(["--list", "--format", "terse"]).current_dir(&self.folder);
        let output = command.output().map_err(MutantsError::about(&self.name))?;
        let mut modules: BTreeMap<String, Vec<String>> = BTreeMap::new();
        for test in
            String::from_utf8_lossy(&output.stdout).lines().filter_map(|line| line.strip_suffix(": test"))
        {
            let module = test.split_once("::").map_or("", |(module, _)| module);
            if module != OF_THE_TEXT {
                modules.entry(module.to_owned()).or_default().push(test.to_owned());
            }
        }
        let program =
            |(module, tests)| Self { name: format!("{} {module}", self.name), tests, ..self.clone() };
        Ok(modules.into_iter().map(program).collect())
    }
}

/// All tests.
#[derive(Debug)]
pub(super) struct TestPrograms {
    pub(super) tests: Vec<TestProgram>,
    /// Programs that tests start, by name.
    pub(super) started: BTreeMap<String, PathBuf>,
}

impl TestPrograms {
    /// When a program, or one that it may start, was built last [ns since 1970].
    pub(super) fn built(&self, test: &TestProgram) -> u64 {
        let time = |path: &PathBuf| std::fs::metadata(path).and_then(|found| found.modified());
        let times = self.started.values().chain([&test.executable]).filter_map(|path| time(path).ok());
        times
            .filter_map(|time| Some(time.duration_since(UNIX_EPOCH).ok()?.as_nanos() as u64))
            .max()
            .unwrap_or(0)
    }
}

/// Result of a build.
pub(super) enum Built {
    Programs(TestPrograms),
    /// Numbers of mutants that the compiler rejects.
    Refused(BTreeSet<usize>),
}

/// Builds all tests in `tree`.
///
/// # Errors
/// If cargo cannot be run, or something else than a mutant is rejected.
pub(super) fn build(
    tree: &Path,
    folder: &Path,
    targets: &[String],
    parts: &BTreeMap<PathBuf, Switched>,
) -> Result<Built, MutantsError> {
    // The one that runs this program, if one does.
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.args(["test", "--workspace", "--release", "--no-run", "--message-format=json"]).args(targets);
    if targets.is_empty() {
        command.args(ALL);
    }
    command.current_dir(tree).env("CARGO_TARGET_DIR", folder);
    // The tests run some hundred times: optimised they take a third of the time. The checks of `cargo test` stay on. The next
    // sample changes a few functions of each crate, which an incremental build in several units compiles alone.
    for setting in INCREMENTAL {
        command.args(["--config", setting]);
    }
    command.env("CARGO_PROFILE_RELEASE_DEBUG_ASSERTIONS", "true");
    command.env("CARGO_PROFILE_RELEASE_OVERFLOW_CHECKS", "true");
    let output = command.output().map_err(MutantsError::about("cargo test"))?;
    let messages: Vec<Value> = output
        .stdout
        .split(|&byte| byte == b'\n')
        .filter_map(|line| serde_json::from_slice(line).ok())
        .collect();
    if output.status.success() {
        let mut built = programs(&messages);
        let (whole, with_modules) =
            built.tests.into_iter().partition(|program| !program.name.contains(": test "));
        built.tests = whole;
        for program in with_modules {
            built.tests.extend(program.modules()?);
        }
        return Ok(Built::Programs(built));
    }
    let errors =
        messages.iter().map(|message| &message["message"]).filter(|message| message["level"] == "error");
    let refused: BTreeSet<usize> = errors.clone().filter_map(|error| blamed(error, parts)).collect();
    if refused.is_empty() {
        let mut text: String = errors.filter_map(|error| error["rendered"].as_str()).collect();
        text += &String::from_utf8_lossy(&output.stderr);
        let lines: Vec<&str> = text.lines().take(SHOWN).collect();
        return Err(MutantsError::Build(lines.join("\n")));
    }
    Ok(Built::Refused(refused))
}

/// The mutant that an error is about.
fn blamed(error: &Value, parts: &BTreeMap<PathBuf, Switched>) -> Option<usize> {
    let mut spans: Vec<&Value> = error["spans"].as_array()?.iter().collect();
    spans.sort_by_key(|span| span["is_primary"] != true);
    spans.iter().find_map(|span| {
        let part = parts.get(Path::new(span["file_name"].as_str()?))?;
        let place = |name: &str| span[name].as_u64().map(|place| place as usize);
        part.blamed(&(place("byte_start")?..place("byte_end")?))
    })
}

/// The programs built.
fn programs(messages: &[Value]) -> TestPrograms {
    let mut programs = TestPrograms { tests: Vec::new(), started: BTreeMap::new() };
    for message in messages.iter().filter(|message| message["reason"] == "compiler-artifact") {
        let (Some(executable), Some(target), Some(manifest)) = (
            message["executable"].as_str(),
            message["target"]["name"].as_str(),
            message["manifest_path"].as_str().and_then(|path| Path::new(path).parent()),
        ) else {
            continue;
        };
        let (executable, folder) = (PathBuf::from(executable), manifest.to_owned());
        if message["profile"]["test"] == true {
            let of = folder.file_name().unwrap_or_default().to_string_lossy();
            let kind = message["target"]["kind"][0].as_str().unwrap_or_default();
            let name = format!("{of}: {kind} {target}");
            programs.tests.push(TestProgram { name, executable, folder, tests: Vec::new() });
        } else if message["target"]["kind"][0] == "bin" {
            programs.started.insert(target.to_owned(), executable);
        }
    }
    programs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn programs_with_tests_and_those_they_start_are_distinguished() {
        let artifact = |name: &str, kind: &str, is_test: bool| {
            serde_json::json!({
                "reason": "compiler-artifact", "executable": format!("/build/{name}"),
                "manifest_path": "/tree/crates/lissom-cli/Cargo.toml",
                "target": {"name": name, "kind": [kind]}, "profile": {"test": is_test},
            })
        };
        let built = programs(&[artifact("lissom", "bin", false), artifact("cable", "test", true)]);
        assert_eq!(built.tests.len(), 1);
        assert_eq!(built.tests[0].name, "lissom-cli: test cable");
        assert_eq!(built.tests[0].folder, Path::new("/tree/crates/lissom-cli"));
        assert!(built.started.contains_key("lissom"));
    }

    #[test]
    fn modules_of_a_program_are_programs() {
        let executable = std::env::current_exe().expect("a path");
        let own = TestProgram {
            name: "xtask: test own".to_owned(),
            executable,
            folder: ".".into(),
            tests: Vec::new(),
        };
        let modules = own.modules().expect("a list");
        let mutants =
            modules.iter().find(|module| module.name == "xtask: test own mutants").expect("this module");
        assert!(mutants.tests.iter().any(|test| test.ends_with("modules_of_a_program_are_programs")));
        assert!(mutants.tests.iter().all(|test| test.starts_with("mutants::")));
    }
}
