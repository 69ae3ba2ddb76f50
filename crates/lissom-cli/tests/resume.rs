//! A run that was killed goes on from its checkpoint, and leaves what an undisturbed one leaves, byte for byte.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use serde_json::Value;

/// A folder of its own for each test, gone afterwards.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("lissom-resume-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn example(name: &str) -> PathBuf {
    let folder = if name == DELAYED { "tests/support" } else { "../../examples" };
    Path::new(env!("CARGO_MANIFEST_DIR")).join(folder).join(format!("{name}.toml"))
}

/// A model with delayed signals, whose past a checkpoint contains.
const DELAYED: &str = "delayed";

fn lissom() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lissom"));
    command.arg("run").arg("--quiet").stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

/// The summary without times of the clock.
fn facts(folder: &Path) -> Value {
    let mut facts: Value =
        serde_json::from_str(&fs::read_to_string(folder.join("summary.json")).unwrap()).unwrap();
    for name in ["wall_seconds", "solve_seconds", "seconds"] {
        facts.as_object_mut().unwrap().remove(name);
    }
    facts
}

fn started(model: &str, more: &[&str], out: &Path) -> Command {
    let mut command = started_with_plots(model, more, out);
    command.arg("--no-plots");
    command
}

fn started_with_plots(model: &str, more: &[&str], out: &Path) -> Command {
    let mut command = lissom();
    command.arg(example(model)).arg("--out").arg(out);
    command.args(["--checkpoint-every", "7steps"]);
    for set in more {
        command.args(["--set", set]);
    }
    command
}

/// Runs to the end; a run that does not finish within minutes is killed, and the test fails.
fn finished(command: &mut Command) -> Output {
    let mut child = command.spawn().unwrap();
    let began = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if began.elapsed() > Duration::from_secs(300) {
            let _ = child.kill();
            panic!("{command:?} has not ended after {:?}", began.elapsed());
        }
        sleep(Duration::from_millis(1));
    }
    child.wait_with_output().unwrap()
}

/// Kills the run after `patience` and again until it has ended. How often it was killed.
fn killed(start: &dyn Fn() -> Command, out: &Path, patience: Duration) -> usize {
    let mut kills = 0;
    let mut command = start();
    loop {
        let mut child = command.spawn().unwrap();
        sleep(patience + patience.mul_f64(0.35 * kills as f64));
        // SIGKILL: the program cannot notice.
        let _ = child.kill();
        let output = child.wait_with_output().unwrap();
        if output.status.success() {
            return kills;
        }
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code().is_none(), "{command:?}: {errors}");
        kills += 1;
        assert!(kills < 500, "{command:?} does not finish");
        // Killed before the first checkpoint there is nothing to go on with.
        command = if out.join("checkpoint.lissom").is_file() {
            let mut command = lissom();
            command.arg("--resume").arg(out);
            command
        } else {
            start()
        };
    }
}

/// Kills that runs are put through, and those with a motion.
const KILLS: usize = 200;
const KILLS_WITH_MOTION: usize = 40;

#[test]
fn runs_that_are_killed_again_and_again_leave_the_same_bytes() {
    let folder = Folder::new("kill");
    let cases: [(&str, &[&str]); 7] = [
        (DELAYED, &[]),
        (DELAYED, &["analysis.relative_tolerance=1e-4"]),
        ("tip-crank", &["analysis.end=0.1"]),
        ("tip-crank", &["analysis.end=0.1", "analysis.scheme=hht", "analysis.step=5e-4"]),
        ("four-bar", &["analysis.end=1"]),
        ("four-bar", &["analysis.end=1", "analysis.relative_tolerance=1e-5"]),
        ("tip-crank", &["analysis.end=0.1", "analysis.scheme=energy-decaying"]),
    ];
    let mut kills = 0;
    // Each round waits longer before it kills than the one before; a fast machine comes through with fewer kills.
    for (index, (model, more)) in cases.into_iter().cycle().take(40 * cases.len()).enumerate() {
        if kills >= KILLS && index >= cases.len() {
            break;
        }
        let (whole, parts) = (folder.0.join(format!("whole{index}")), folder.0.join(format!("parts{index}")));
        let output = finished(&mut started(model, more, &whole));
        assert!(output.status.success(), "{model} {more:?}: {}", String::from_utf8_lossy(&output.stderr));
        let patience = Duration::from_micros(2000 + 137 * index as u64);
        kills += killed(&|| started(model, more, &parts), &parts, patience);
        let read = |folder: &Path| fs::read(folder.join("history.csv")).unwrap();
        assert!(read(&whole) == read(&parts), "{model} {more:?}: histories differ");
        assert_eq!(facts(&whole), facts(&parts), "{model} {more:?}");
        assert!(!parts.join("checkpoint.lissom").exists(), "a run that has ended leaves no checkpoint");
    }
    println!("{kills} kills");
    assert!(kills >= KILLS, "{kills}");
}

#[test]
fn the_motion_of_a_run_that_was_killed_is_that_of_an_undisturbed_one() {
    let folder = Folder::new("motion");
    let cases: [(&str, &[&str]); 2] = [
        ("tip-crank", &["analysis.end=0.1", "analysis.frames_per_second=1100"]),
        // Steps longer than the distance of frames: what is between is interpolated.
        ("four-bar", &["analysis.end=1", "analysis.relative_tolerance=1e-4"]),
    ];
    let mut kills = 0;
    // Each round waits longer before it kills than the one before; a fast machine comes through with fewer kills.
    for (index, (model, more)) in cases.into_iter().cycle().take(40 * cases.len()).enumerate() {
        if kills >= KILLS_WITH_MOTION && index >= cases.len() {
            break;
        }
        let (whole, parts) = (folder.0.join(format!("whole{index}")), folder.0.join(format!("parts{index}")));
        let output = started_with_plots(model, more, &whole).output().unwrap();
        assert!(output.status.success(), "{model} {more:?}: {}", String::from_utf8_lossy(&output.stderr));
        kills += killed(&|| started_with_plots(model, more, &parts), &parts, Duration::from_millis(25));
        let read = |folder: &Path, name: &str| fs::read(folder.join(name)).unwrap();
        for name in ["motion.bin", "scene.json", "history.csv"] {
            assert!(read(&whole, name) == read(&parts, name), "{model} {more:?}: {name} differs");
        }
    }
    assert!(kills > 2, "{kills}");
}

#[test]
fn what_cannot_go_on_is_reported() {
    let folder = Folder::new("missing");
    let output = lissom().arg("--resume").arg(&folder.0).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(errors.contains("there is no checkpoint"), "{errors}");
    fs::write(folder.0.join("checkpoint.lissom"), b"something else").unwrap();
    let output = lissom().arg("--resume").arg(&folder.0).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let output = lissom().output().unwrap();
    assert_eq!(output.status.code(), Some(2), "a model or a folder is wanted");
}

#[test]
fn a_session_goes_back_to_its_snapshot_and_repeats_itself() {
    let text = fs::read_to_string(example("four-bar")).unwrap();
    let model = lissom::Model::from_text("four-bar.toml", &text);
    let mut session = model.session().unwrap();
    session.step_to(0.3).unwrap();
    let snapshot = session.snapshot();
    let bytes = snapshot.to_bytes();
    let run = |session: &mut lissom::Session| {
        session.step_to(0.7).unwrap();
        let mut values = Vec::new();
        session.values(&mut values);
        (session.progress().time, values)
    };
    let first = run(&mut session);
    assert!((first.0 - 0.7).abs() < 1e-15);
    let read = lissom::SessionSnapshot::from_bytes(&bytes).unwrap();
    assert_eq!(read, snapshot);
    session.restore(&read).unwrap();
    assert!((session.progress().time - 0.3).abs() < 1e-15);
    assert_eq!(run(&mut session), first);
    // Another session of the same model, and one of another model.
    let mut other = model.session().unwrap();
    other.restore(&read).unwrap();
    assert_eq!(run(&mut other), first);
    let pendulum = fs::read_to_string(example("pendulum")).unwrap();
    let mut wrong = lissom::Model::from_text("pendulum.toml", &pendulum).session().unwrap();
    assert!(wrong.restore(&read).unwrap_err().to_string().contains("another model"));
    assert!(lissom::SessionSnapshot::from_bytes(&bytes[..bytes.len() / 2]).is_err());
}
