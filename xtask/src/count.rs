//! `cargo xtask count`: instructions of inner loops and of whole examples, counted by valgrind's callgrind and compared with those
//! kept in benches/instructions.toml. A slow-down is detected without timing noise. Independent of mechanics.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use lissom::core::simulation::Simulation;
use lissom::start::lower;
use lissom::{Model, Session};
use serde::{Deserialize, Serialize};

use crate::{cases, scenes, verify};

/// Scenes whose steps are counted, each with other kernels in front.
const COUNTED: &[&str] =
    &["planar-pendulum", "chain-s-10", "chain-r-10", "soft-beam-8", "soft-beam-cubic-3", "andrews"];
/// Scenes whose records are counted, one after every step, with the outputs that are added.
const RECORDED: &[(&str, &str)] = &[
    (
        "chain-r-2",
        "[outputs.velocity]\nkind = \"velocity\"\nof = \"b1\"\n[outputs.energy]\nkind = \"energy\"\n\
         [outputs.reaction]\nkind = \"reaction\"\nof = \"j0\"\n",
    ),
    (
        "chain-s-10",
        "[outputs.velocity]\nkind = \"velocity\"\nof = \"b9\"\n[outputs.energy]\nkind = \"energy\"\n\
         [outputs.reaction]\nkind = \"reaction\"\nof = \"j0\"\n",
    ),
    ("andrews", "[outputs.velocity]\nkind = \"velocity\"\nof = \"k7\"\n"),
    (
        "soft-beam-64",
        "[outputs.velocity]\nkind = \"velocity\"\nof = \"rod.end\"\n[outputs.energy]\nkind = \"energy\"\n\
         [outputs.reaction]\nkind = \"reaction\"\nof = \"root\"\n",
    ),
];
/// Marks a count of records, after the name of the scene.
const RECORDS: &str = "+records";
/// Marks a count of inputs that are set before every step: torques of all joints.
const INPUTS: &str = "+inputs";
/// Marks a count of a whole run with adaptive steps, from reading the model on.
const ADAPTIVE: &str = "+adaptive";
/// Scenes of those, with the end of the run [s].
const DRIVEN: &[&str] = &["chain-r-7"];
const WHOLE: &[(&str, &str)] = &[("andrews", "0.03"), ("chain-r-2", "0.1")];
/// Examples whose runs are counted with all records, from reading the model on, with the end of the run [s].
const EXAMPLES: &[(&str, &str)] = &[
    ("bouncing-mass", "2"),
    ("bridge-crossing", "0.12"),
    ("cam-follower", "0.05"),
    ("computed-torque", "2"),
    ("contacts/ball-bearing", "0.01"),
    ("contacts/pile-of-spheres", "0.25"),
    ("contacts/break", "0.2"),
    ("controlled-arm", "1"),
    ("crane-slack-cable", "1.2"),
    ("delta-robot", "0.5"),
    ("double-wishbone", "0.5"),
    ("drive-train", "0.4"),
    ("energy", "0.06"),
    ("excavator-arm", "4"),
    ("four-bar", "0.4"),
    ("gearbox-backlash", "0.5"),
    ("geneva-drive", "0.5"),
    ("mecanum-platform", "0.8"),
    ("newtons-cradle", "0.1"),
    ("oil-whirl", "0.006"),
    ("pendulum", "1"),
    ("rattleback", "0.1"),
    ("rolling-disc", "1"),
    ("rotor-lag-damper", "1"),
    ("satellite-latching-booms", "8"),
    ("shaking-table", "0.8"),
    ("shells/leaf-spring", "1"),
    ("slider-crank-3500rpm", "0.03"),
    ("slider-crank-elastic", "0.005"),
    ("solids/crane-hook", "1"),
    ("tip-crank", "0.04"),
    ("tip-crank-2016", "0.02"),
    ("top", "0.7"),
    ("turbine-rotor", "0.4"),
    ("turning-chatter", "0.3"),
    ("walking-linkage", "0.05"),
    ("wheelset", "0.1"),
    ("wing-flutter", "0.02"),
];
/// Marks an example, before its name.
const EXAMPLE: &str = "example ";
/// Steps before the count begins, and steps counted.
const STEPS: [usize; 2] = [20, 50];
/// Counts at the same time, which does not affect them.
const THREADS: usize = 2;
/// Counts may differ by this share.
const TOLERANCE: f64 = 0.02;

/// A count that cannot be made.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CountError {
    /// There is no such scene.
    #[error("there is no scene `{0}`")]
    Unknown(String),
    /// A scene is wrong or has no solution.
    #[error("{0}")]
    Failed(String),
    /// A program cannot be run, or its output is unexpected.
    #[error("{program}: {message}")]
    Program {
        /// The program.
        program: &'static str,
        /// The error.
        message: String,
    },
    /// A file cannot be read or written.
    #[error("{path}: {message}")]
    File {
        /// The file.
        path: PathBuf,
        /// The error of the system.
        message: String,
    },
}

/// Stored counts.
#[derive(Debug, Default, Serialize, Deserialize, PartialEq, Eq)]
struct Kept {
    /// The compiler the counts were made with.
    compiler: String,
    /// Instructions by scene or example.
    instructions: BTreeMap<String, u64>,
}

/// Counts all; whether none has grown or shrunk by more than allowed.
pub(crate) fn count(root: &Path, update: bool) -> Result<bool, CountError> {
    let version = |program: &'static str| {
        let output = Command::new(program).arg("--version").output().ok()?;
        Some(String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    if version("valgrind").is_none() {
        let message =
            "it is not installed: no instructions are counted; install the package `valgrind`".to_owned();
        return Err(CountError::Program { program: "valgrind", message });
    }
    let compiler = version("rustc").unwrap_or_default();
    let names = names();
    let counted =
        cases::results(0..names.len() as u64, THREADS, None, |k| instructions_of(&names[k as usize]));
    let instructions = names.iter().cloned().zip(counted.into_values());
    let instructions = instructions.map(|(name, counted)| Ok((name, counted?)));
    let instructions: BTreeMap<String, u64> = instructions.collect::<Result<_, CountError>>()?;
    let path = root.join("benches/instructions.toml");
    let fail =
        |error: &dyn std::error::Error| CountError::File { path: path.clone(), message: error.to_string() };
    let found = Kept { compiler, instructions };
    if update {
        let text = toml::to_string(&found).map_err(|error| fail(&error))?;
        let heading = "# Instructions of 50 steps of each scene, of a record or of inputs at each, of a whole adaptive run, or of an example's first part with its records; `cargo xtask count --update` writes this file.\n";
        std::fs::write(&path, format!("{heading}{text}")).map_err(|error| fail(&error))?;
        return Ok(true);
    }
    let text = std::fs::read_to_string(&path).map_err(|error| fail(&error))?;
    let kept: Kept = toml::from_str(&text).map_err(|error| fail(&error))?;
    let same = compare(&kept, &found);
    if kept.compiler != found.compiler {
        println!("counted with {}, kept with {}: nothing is concluded", found.compiler, kept.compiler);
        return Ok(true);
    }
    Ok(same)
}

/// Names of all counts.
fn names() -> Vec<String> {
    let steps = COUNTED.iter().map(|&name| name.to_owned());
    let records = RECORDED.iter().map(|(name, _)| format!("{name}{RECORDS}"));
    let inputs = DRIVEN.iter().map(|name| format!("{name}{INPUTS}"));
    let runs = WHOLE.iter().map(|(name, _)| format!("{name}{ADAPTIVE}"));
    let examples = EXAMPLES.iter().map(|(name, _)| format!("{EXAMPLE}{name}"));
    steps.chain(records).chain(inputs).chain(runs).chain(examples).collect()
}

/// Prints the table; whether all counts are as kept.
fn compare(kept: &Kept, found: &Kept) -> bool {
    let mut same = true;
    println!("| scene | instructions | kept | change |\n|---|---|---|---|");
    for (name, &now) in &found.instructions {
        let Some(&before) = kept.instructions.get(name) else {
            println!("| `{name}` | {now} | – | new |");
            same = false;
            continue;
        };
        let change = now as f64 / before as f64 - 1.0;
        let mark = if change.abs() > TOLERANCE { " (!)" } else { "" };
        println!("| `{name}` | {now} | {before} | {:+.2} %{mark} |", 100.0 * change);
        same &= change.abs() <= TOLERANCE;
    }
    if !same {
        println!(
            "counts differ by more than {:.0} %: if that is meant, run `cargo xtask count --update`",
            100.0 * TOLERANCE
        );
    }
    same
}

/// Instructions of the steps of a scene, from a run of this program under callgrind.
fn instructions_of(name: &str) -> Result<u64, CountError> {
    let fail = |message: String| CountError::Program { program: "valgrind", message };
    let program = std::env::current_exe().map_err(|error| fail(error.to_string()))?;
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null", "--toggle-collect=*counted_work*"])
        .arg(program)
        .args(["steps", name])
        .output()
        .map_err(|error| fail(error.to_string()))?;
    let output_text = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        return Err(fail(output_text.into_owned()));
    }
    collected(&output_text).ok_or_else(|| fail(format!("no count in: {output_text}")))
}

/// The number in callgrind's line `Collected : 123`.
fn collected(output_text: &str) -> Option<u64> {
    let line = output_text.lines().find(|line| line.contains("Collected"))?;
    line.rsplit(':').next()?.trim().parse().ok()
}

/// Does the work that is counted under this name.
pub(crate) fn steps(name: &str) -> Result<(), CountError> {
    if let Some(name) = name.strip_suffix(RECORDS) {
        return records(name);
    }
    if let Some(name) = name.strip_suffix(INPUTS) {
        return inputs(name);
    }
    if let Some(name) = name.strip_suffix(ADAPTIVE) {
        return adaptive(name);
    }
    if let Some(name) = name.strip_prefix(EXAMPLE) {
        return example(name);
    }
    let lowered = lower(&document(&model(name, "")?)?).map_err(of_report)?;
    let mut simulation = Simulation::new(lowered.system, lowered.state, lowered.settings).map_err(failed)?;
    let [before, counted] = STEPS;
    for _ in 0..before {
        simulation.step().map_err(failed)?;
    }
    counted_work(|| (0..counted).try_for_each(|_| simulation.step().map(|_| ()))).map_err(failed)
}

/// Counts a record after every step.
fn records(name: &str) -> Result<(), CountError> {
    let found = RECORDED.iter().find(|(recorded, _)| *recorded == name);
    let (_, outputs) = found.ok_or_else(|| CountError::Unknown(name.to_owned()))?;
    let mut session = Session::new(&document(&model(name, outputs)?)?).map_err(failed)?;
    let mut values = Vec::new();
    let [before, counted] = STEPS;
    for step in 0..before + counted {
        session.advance().map_err(failed)?;
        values.clear();
        if step < before {
            session.values(&mut values);
        } else {
            counted_work(|| session.values(&mut values));
        }
        if !values.iter().all(|value| value.is_finite()) {
            return Err(CountError::Failed(format!("{name}: a recorded value is not finite")));
        }
    }
    Ok(())
}

/// Counts the inputs that are set before every step, which are torques of the chain's joints.
fn inputs(name: &str) -> Result<(), CountError> {
    let joints = name.rsplit('-').next().and_then(|count| count.parse().ok()).unwrap_or(0);
    let names: Vec<String> = (0..joints).map(|joint| format!("u{joint}")).collect();
    let inputs: Vec<String> = names.iter().map(|name| format!("{name} = 0.0\n")).collect();
    let load = |(joint, name): (usize, &String)| {
        format!("[loads.{name}]\nkind = \"joint_torque\"\njoint = \"j{joint}\"\ntorque = \"{name}\"\n")
    };
    let loads: Vec<String> = names.iter().enumerate().map(load).collect();
    let loads = format!("[inputs]\n{}{}", inputs.concat(), loads.concat());
    let mut session = Session::new(&document(&model(name, &loads)?)?).map_err(failed)?;
    let [before, counted] = STEPS;
    for step in 0..before + counted {
        let torque = 1e-3 * (step as f64).sin();
        let values = names.iter().map(|name| (&**name, torque));
        if step < before {
            session.set_inputs(values).map_err(failed)?;
        } else {
            counted_work(|| session.set_inputs(values)).map_err(failed)?;
        }
        session.advance().map_err(failed)?;
    }
    Ok(())
}

/// Counts a whole run with adaptive steps.
fn adaptive(name: &str) -> Result<(), CountError> {
    let found = WHOLE.iter().find(|(whole, _)| *whole == name);
    let (_, end) = found.ok_or_else(|| CountError::Unknown(name.to_owned()))?;
    let scene = scenes::scene(name).ok_or_else(|| CountError::Unknown(name.to_owned()))?;
    let begin = scene.text.find("[analysis]").ok_or_else(|| CountError::Unknown(name.to_owned()))?;
    let (before, own) = scene.text.split_at(begin);
    let after = own.find("\n[").map_or("", |next| &own[next..]);
    let text = format!("{before}[analysis]\nkind = \"dynamics\"\nrelative_tolerance = 1e-6\n{after}");
    counted_work(|| {
        let model = Model::from_text(&scene.name, &text);
        let set = [("analysis.end".to_owned(), (*end).to_owned())];
        let mut session =
            Session::new(&model.with_overrides(&set).document().map_err(of_report)?).map_err(failed)?;
        let report = session.run_with(&mut [], &mut |_| std::ops::ControlFlow::Continue(()));
        report.error().map_or(Ok(()), |error| Err(CountError::Failed(error.to_string())))
    })
}

/// Counts the run of an example with what it records.
fn example(name: &str) -> Result<(), CountError> {
    let found = EXAMPLES.iter().find(|(own, _)| *own == name);
    let (_, end) = found.ok_or_else(|| CountError::Unknown(name.to_owned()))?;
    let path = verify::root().join(format!("examples/{name}.toml"));
    counted_work(|| {
        let model = Model::read(&path).map_err(failed)?;
        let set = [("analysis.end".to_owned(), (*end).to_owned())];
        let mut session =
            Session::new(&model.with_overrides(&set).document().map_err(of_report)?).map_err(failed)?;
        let (_, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
        report.error().map_or(Ok(()), |error| Err(CountError::Failed(error.to_string())))
    })
}

/// A scene with more text.
fn model(name: &str, more: &str) -> Result<Model, CountError> {
    let scene = scenes::scene(name).ok_or_else(|| CountError::Unknown(name.to_owned()))?;
    Ok(Model::from_text(&scene.name, &format!("{}\n{more}", scene.text)))
}

fn document(model: &Model) -> Result<lissom::Document, CountError> {
    model.document().map_err(of_report)
}

#[expect(clippy::needless_pass_by_value, reason = "it is passed to map_err")]
fn of_report(report: lissom::Report) -> CountError {
    CountError::Failed(report.render(false))
}

fn failed(error: impl std::error::Error) -> CountError {
    CountError::Failed(error.to_string())
}

/// Function counted by callgrind, by name.
#[inline(never)]
fn counted_work<R>(work: impl FnOnce() -> R) -> R {
    work()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_count_is_read_from_what_callgrind_reports() {
        let output_text = "==12== Callgrind\n==12== Events    : Ir\n==12== Collected : 4711\n==12== \n";
        assert_eq!(collected(output_text), Some(4711));
        assert_eq!(collected("nothing"), None);
    }

    #[test]
    fn a_count_that_has_grown_is_seen() {
        let kept = |count| Kept {
            compiler: String::new(),
            instructions: BTreeMap::from([("scene".to_owned(), count)]),
        };
        assert!(compare(&kept(1000), &kept(1019)));
        assert!(!compare(&kept(1000), &kept(1021)));
        assert!(!compare(&kept(1000), &kept(979)));
        assert!(!compare(&Kept::default(), &kept(1)));
    }

    #[test]
    fn every_counted_scene_takes_its_steps() {
        for name in names() {
            steps(&name).unwrap_or_else(|error| panic!("{name}: {error}"));
        }
    }
}
