//! What the program reads, it does not write over, whatever path or link leads there; and it opens regular files only.

use std::fs;
use std::path::Path;

use crate::support::{CANTILEVER, Folder, Run, lissom, summary, wait_for};

const SPINNING: &str = r#"
lissom = 1
[bodies.w]
mass = 1
inertia = [1, 1, 1]
angular_velocity = [0, 0, 1]
[joints.h]
kind = "revolute"
base = "ground"
tip = "w"
axis = [0, 0, 1]
[outputs.h]
kind = "relative"
of = "h"
[loads.l]
kind = "joint_torque"
joint = "h"
torque = { file = "DATA", columns = ["time", "torque"] }
[analysis]
kind = "dynamics"
end = 0.1
step = 0.05
"#;

const TABLE: &str = "time,torque\n0,1\n10,2\n";

fn refused(args: &[&str], folder: &Path, kept: &[&str]) {
    let before: Vec<_> = kept.iter().map(|name| fs::read(folder.join(name)).unwrap()).collect();
    let listed = |folder: &Path| {
        let names = fs::read_dir(folder).unwrap().flatten().map(|entry| entry.file_name());
        names.filter(|name| name != "out").collect::<std::collections::BTreeSet<_>>()
    };
    let names = listed(folder);
    let ended = lissom(args, folder);
    assert!(ended.code == 2 || ended.code == 3, "{args:?}: {}\n{}", ended.code, ended.errors);
    assert!(
        ended.errors.contains("would be lost") && ended.errors.contains("--out"),
        "{args:?}: {}",
        ended.errors
    );
    for (name, bytes) in kept.iter().zip(before) {
        assert_eq!(fs::read(folder.join(name)).unwrap(), bytes, "{args:?}: {name}");
    }
    assert_eq!(listed(folder), names, "{args:?}: something was written");
}

#[test]
fn runs_do_not_replace_what_their_model_is_made_of() {
    // Tables under names that results have.
    for name in ["history.csv", "events.csv", "shapes.csv"] {
        let folder = Folder::new(&format!("inputs-{}", name.replace('.', "-")));
        folder.write(name, TABLE);
        folder.write("m.toml", &SPINNING.replace("DATA", name));
        refused(&["run", "m.toml", "--out", "."], folder.path(), &["m.toml", name]);
        refused(&["view", "m.toml", "--out", "."], folder.path(), &["m.toml", name]);
    }
    let folder = Folder::new("inputs-model");
    folder.write("data.csv", TABLE);
    for name in ["summary.json", "history.csv", "view.html", "h.svg"] {
        folder.write(name, &SPINNING.replace("DATA", "data.csv"));
        refused(&["run", name, "--out", "."], folder.path(), &[name]);
        fs::remove_file(folder.path().join(name)).unwrap();
    }
    // Beside other files results are welcome, again and again.
    folder.write("m.toml", &SPINNING.replace("DATA", "data.csv"));
    for _ in 0..2 {
        assert_eq!(lissom(&["run", "m.toml", "--out", "."], folder.path()).code, 0);
    }
    assert_eq!(fs::read_to_string(folder.path().join("data.csv")).unwrap(), TABLE);
}

#[cfg(unix)]
#[test]
fn links_lead_to_no_input() {
    let folder = Folder::new("inputs-links");
    folder.write("data.csv", TABLE);
    folder.write("m.toml", &SPINNING.replace("DATA", "data.csv"));
    let out = folder.path().join("o");
    for (name, target) in [("history.csv", "data.csv"), ("summary.json", "m.toml"), ("h.svg", "data.csv")] {
        for is_hard in [false, true] {
            fs::create_dir_all(&out).unwrap();
            let (target, link) = (folder.path().join(target), out.join(name));
            if is_hard { fs::hard_link(&target, &link) } else { std::os::unix::fs::symlink(&target, &link) }
                .unwrap();
            refused(&["run", "m.toml", "--out", "o"], folder.path(), &["data.csv", "m.toml"]);
            fs::remove_dir_all(&out).unwrap();
        }
    }
}

#[test]
fn no_command_replaces_what_it_has_read() {
    let folder = Folder::new("inputs-commands");
    folder.write("bar.toml", CANTILEVER);
    let path = folder.path();
    refused(&["view", "bar.toml", "--html", "bar.toml"], path, &["bar.toml"]);
    refused(&["view", "bar.toml", "--initial", "--html", "./bar.toml"], path, &["bar.toml"]);
    assert_eq!(lissom(&["run", "bar.toml", "--out", "r", "--quiet"], path).code, 0);
    let results = ["r/history.csv", "r/motion.bin", "r/summary.json", "r/scene.json"];
    for name in results {
        refused(&["view", "r", "--html", name], path, &results);
        refused(&["export", "r", "--format", "gltf", "--out", name], path, &results);
    }
    folder.write(
        "arm.toml",
        "lissom = 1\ngravity = [0, 0, -9.81]\n[bodies.w]\nmass = 1\ninertia = [1, 1, 1]\n[joints.h]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"w\"\n\
         axis = [0, 0, 1]\n[analysis]\nkind = \"dynamics\"\nend = 1\n",
    );
    refused(&["export", "arm.toml", "--format", "urdf", "--out", "arm.toml"], path, &["arm.toml"]);
}

#[cfg(unix)]
#[test]
fn pipes_and_devices_are_refused() {
    let folder = Folder::new("pipes");
    folder.write("m.toml", CANTILEVER);
    let pipe = |name: &str| {
        let path = folder.path().join(name);
        assert!(std::process::Command::new("mkfifo").arg(&path).status().unwrap().success());
        path
    };
    fs::create_dir(folder.path().join("o")).unwrap();
    for name in ["o/history.csv", "o/.lock", "o/summary.json", "o/motion.bin"] {
        let path = pipe(name);
        let ended = lissom(&["run", "m.toml", "--out", "o"], folder.path());
        assert!(ended.code == 3 && ended.errors.contains("not a regular file"), "{name}: {}", ended.errors);
        fs::remove_file(path).unwrap();
    }
    pipe("model.toml");
    let ended = lissom(&["check", "model.toml"], folder.path());
    assert!(ended.code == 2 && ended.errors.contains("not a regular file"), "{}", ended.errors);
    for data in ["/dev/random", "/dev/zero", "model.toml"] {
        folder.write("d.toml", &SPINNING.replace("DATA", data));
        let ended = lissom(&["check", "d.toml"], folder.path());
        assert!(ended.code == 2 && ended.errors.contains("not a regular file"), "{data}: {}", ended.errors);
    }
    let ended = lissom(&["view", "m.toml", "--html", "/dev/null"], folder.path());
    assert!(ended.code == 3 && ended.errors.contains("not a regular file"), "{}", ended.errors);
}

#[test]
fn names_too_long_for_files_are_errors_of_the_model_and_spoil_no_folder() {
    let folder = Folder::new("long");
    let long = "a".repeat(250);
    folder.write("long.toml", &CANTILEVER.replace("[outputs.", &format!("[outputs.{long}")));
    let ended = lissom(&["check", "long.toml"], folder.path());
    assert!(ended.code == 2 && ended.errors.contains("longer than"), "{}", ended.errors);
    // A table that another program left there, with a column that no file can be called by.
    fs::create_dir(folder.path().join("o")).unwrap();
    folder.write("o/history.csv", &format!("time,{long}{long}.x\n0,1\n"));
    folder.write("m.toml", CANTILEVER);
    let ended = lissom(&["run", "m.toml", "--out", "o"], folder.path());
    assert_eq!(ended.code, 0, "{}", ended.errors);
    assert!(summary(&folder.path().join("o"))["steps"].as_u64().unwrap() > 0);
}

#[cfg(target_os = "linux")]
#[test]
fn memory_that_will_not_suffice_is_reported() {
    let folder = Folder::new("memory");
    folder.write("m.toml", &CANTILEVER.replace("elements = 4", "elements = 100000"));
    let program = env!("CARGO_BIN_EXE_lissom");
    let command = format!("ulimit -v 2000000; '{program}' run m.toml");
    let ended =
        std::process::Command::new("sh").args(["-c", &command]).current_dir(folder.path()).output().unwrap();
    let errors = String::from_utf8_lossy(&ended.stderr);
    assert_eq!(ended.status.code(), Some(2), "{errors}");
    assert!(errors.contains("memory") && errors.contains("elements"), "{errors}");
}

/// What is printed is a result, so that a full disk is an error.
#[cfg(target_os = "linux")]
#[test]
fn output_that_is_cut_is_an_error() {
    let folder = Folder::new("output-cut");
    folder.write("m.toml", &SPINNING.replace("{ file = \"DATA\", columns = [\"time\", \"torque\"] }", "1"));
    for args in [&["schema"][..], &["completions", "bash"], &["check", "m.toml"], &["run", "m.toml"]] {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_lissom"));
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let ended = command.args(args).current_dir(folder.path()).stdout(full).output().unwrap();
        let errors = String::from_utf8(ended.stderr).unwrap();
        assert_eq!(ended.status.code(), Some(3), "{args:?}: {errors}");
        assert!(errors.contains("the standard output is incomplete: No space left"), "{args:?}: {errors}");
    }
}

#[cfg(unix)]
#[test]
fn a_folder_that_is_replaced_during_the_run_is_an_error() {
    let folder = Folder::new("folder-replaced");
    let text = SPINNING.replace("{ file = \"DATA\", columns = [\"time\", \"torque\"] }", "1");
    folder.write("m.toml", &text.replace("end = 0.1", "end = 2e3"));
    let run = Run::start(&["run", "m.toml", "--out", "o"], folder.path());
    let path = |name: &str| folder.path().join(name);
    wait_for(|| path("o/summary.json").exists());
    fs::rename(path("o"), path("moved")).unwrap();
    fs::create_dir(path("o")).unwrap();
    let ended = run.finish();
    assert_eq!(ended.code, 3, "{}", ended.errors);
    assert!(ended.errors.contains("another folder has replaced it during the run"), "{}", ended.errors);
    assert!(!path("o/summary.json").exists());
}

#[test]
fn results_of_a_killed_run_are_shown_with_a_warning() {
    let folder = Folder::new("killed-run-shown");
    let text = SPINNING.replace("{ file = \"DATA\", columns = [\"time\", \"torque\"] }", "1");
    folder.write("m.toml", &text.replace("end = 0.1", "end = 1e5"));
    let mut run =
        Run::start(&["run", "m.toml", "--out", "o", "--checkpoint-every", "100steps"], folder.path());
    let size = |name: &str| fs::metadata(folder.path().join("o").join(name)).map_or(0, |file| file.len());
    wait_for(|| size("history.csv") > 20_000 && size("motion.bin") > 500 && size("checkpoint.lissom") > 0);
    run.0.kill().unwrap();
    run.0.wait().unwrap();
    for args in [&["view", "o"][..], &["plot", "o"], &["snapshot", "o"], &["export", "o", "--format", "npz"]]
    {
        let ended = lissom(args, folder.path());
        assert_eq!(ended.code, 0, "{args:?}: {}", ended.errors);
        let words = "warning: `o`: The run is incomplete: it was killed, or is still in progress.";
        assert!(ended.errors.contains(words), "{args:?}: {}", ended.errors);
    }
    let page = fs::read_to_string(folder.path().join("o/view.html")).unwrap();
    assert!(page.contains("The run is incomplete"));
    // A summary that is damaged does not state how the run has ended.
    for text in ["", "{\"version\":", "{}"] {
        fs::write(folder.path().join("o/summary.json"), text).unwrap();
        for args in [["view", "o"], ["plot", "o"]] {
            let ended = lissom(&args, folder.path());
            let words = "There is no summary, or it is damaged: the run is incomplete or still in progress.";
            assert!(ended.errors.contains(words), "{args:?} {text}: {}", ended.errors);
        }
        let page = fs::read_to_string(folder.path().join("o/view.html")).unwrap();
        assert!(page.contains("or it is damaged"), "{text}");
    }
}
