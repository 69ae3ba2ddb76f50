//! Units of other programs in models. The library of the units is compiled by `rustc` for the tests, so that no other program is needed.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use std::time::{Duration, Instant};

use flate2::Crc;
use lissom::Record;

use super::support::{Ended, Folder, Run, lissom, wait_for};

/// The shared library of the units.
static LIBRARY: LazyLock<Vec<u8>> = LazyLock::new(|| library("unit.rs.txt"));

/// Compiles a library of units.
pub(super) fn library(source: &str) -> Vec<u8> {
    let folder = Folder::new(source);
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/command_line/units").join(source);
    let target = folder.path().join("unit");
    let compiler = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned());
    let mut command = std::process::Command::new(compiler);
    command
        .args(["--edition", "2024", "--crate-name", "unit", "--crate-type", "cdylib", "-o"])
        .arg(&target)
        .arg(source);
    let compiled = command.output().unwrap();
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
    std::fs::read(target).unwrap()
}

/// An archive of files without compression.
fn zip(files: &[(&str, &[u8])]) -> Vec<u8> {
    let (mut archive, mut central) = (Vec::new(), Vec::new());
    for (name, content) in files {
        let mut crc = Crc::new();
        crc.update(content);
        let length = content.len() as u32;
        let mut facts = [20_u16, 0, 0, 0, 33].map(u16::to_le_bytes).concat();
        facts.extend([crc.sum(), length, length].map(u32::to_le_bytes).concat());
        facts.extend([name.len() as u16, 0].map(u16::to_le_bytes).concat());
        let offset = archive.len() as u32;
        archive.extend([b"PK\x03\x04", &*facts, name.as_bytes(), content].concat());
        central.extend(
            [b"PK\x01\x02\x14\0", &*facts, &[0; 10], &offset.to_le_bytes(), name.as_bytes()].concat(),
        );
    }
    let count = (files.len() as u16).to_le_bytes();
    let places = [central.len() as u32, archive.len() as u32].map(u32::to_le_bytes).concat();
    archive.extend([&*central, b"PK\x05\x06\0\0\0\0", &count, &count, &places, &[0; 2]].concat());
    archive
}

/// The description of the unit.
fn description(version: u8, more: &str) -> String {
    let state = if version == 2 { "canGetAndSetFMUstate" } else { "canGetAndSetFMUState" };
    let serialize = if version == 2 { "canSerializeFMUstate" } else { "canSerializeFMUState" };
    let token = if version == 2 { "guid" } else { "instantiationToken" };
    let variable = |name: &str, reference: usize, causality: &str, types: [&str; 2], start: &str| {
        let start = if start.is_empty() { String::new() } else { format!(" start=\"{start}\"") };
        let facts = format!("name=\"{name}\" valueReference=\"{reference}\" causality=\"{causality}\"");
        match version {
            2 => format!("<ScalarVariable {facts}><{}{start}/></ScalarVariable>", types[0]),
            _ => format!("<{} {facts}{start}/>", types[1]),
        }
    };
    let real = ["Real", "Float64"];
    let variables = [
        variable("u", 1, "input", real, "0"),
        variable("gain[1]", 2, "parameter", real, "1"),
        variable("ki", 3, "parameter", real, "1"),
        variable("mode", 4, "parameter", real, "0"),
        variable("y", 5, "output", real, ""),
        variable("state.x", 6, "local", real, ""),
        variable("count", 7, "output", ["Integer", "Int32"], ""),
        variable("flag", 8, "parameter", ["Boolean", "Boolean"], "false"),
        variable("words", 9, "parameter", ["String", "String"], "a"),
    ];
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription fmiVersion=\"{version}.0\" modelName=\"pi\" {token}=\"{{1}}\">\
         <CoSimulation modelIdentifier=\"pi\" {state}=\"true\" {serialize}=\"true\"{more}/><ModelVariables>{}</ModelVariables>\
         <ModelStructure/></fmiModelDescription>",
        variables.concat()
    )
}

/// Folder of libraries for this platform.
fn platform(version: u8) -> String {
    let system = if cfg!(target_os = "macos") { "darwin" } else { std::env::consts::OS };
    match (version, std::env::consts::ARCH) {
        (2, "x86_64") => format!("{system}64"),
        (_, processor) => format!("{processor}-{system}"),
    }
}

/// Writes a unit.
fn write_unit(at: &Path, version: u8, description: &str) {
    write_unit_with(at, version, description, &LIBRARY);
}

/// Writes a unit with a library.
pub(super) fn write_unit_with(at: &Path, version: u8, description: &str, library: &[u8]) {
    let name = format!("binaries/{}/pi{}", platform(version), std::env::consts::DLL_SUFFIX);
    let files = [("modelDescription.xml", description.as_bytes()), (&*name, library)];
    std::fs::write(at, zip(&files)).unwrap();
}

/// A pendulum with the torque of a controller.
fn model(units: &str, torque: &str) -> String {
    format!(
        r#"lissom = 1
[bodies.bob]
mass = 1
inertia = [0.01, 0.01, 0.01]
position = [0.5, 0, 0]
[joints.arm]
kind = "revolute"
base = "ground"
tip = "bob"
at = [0, 0, 0]
axis = [0, 0, 1]
[loads.motor]
kind = "joint_torque"
joint = "arm"
torque = "{torque} - 0.3*arm.rate"
{units}
[outputs.arm]
kind = "relative"
of = "arm"
[outputs.torque]
kind = "expression"
value = "{torque}"
[analysis]
kind = "dynamics"
end = 0.1
step = 0.002
"#
    )
}

const UNIT: &str = r#"
[units.pid]
file = "pi.fmu"
sample = 5e-3
inputs = { u = "0.5 - arm.angle" }
outputs = { y = "y", n = "count", flag = "flag" }
parameters = { "gain[1]" = 2, ki = 3, flag = 1 }
"#;

/// Signals of the same controller: each sample has the input of the sample before.
const SIGNALS: &str = r#"
[signals]
u = { value = "0.5 - arm.angle", sample = 5e-3, start = 0.5 }
x = { value = "x + 5e-3*3*u.last", sample = 5e-3, start = -7.5e-3 }
y = { value = "2*u.last + x", sample = 5e-3 }
"#;

pub(super) fn run(folder: &Folder, model: &str, more: &[&str]) -> Ended {
    folder.write("model.toml", model);
    lissom(&[&["run", "model.toml", "--quiet", "--no-plots", "--out", "out"], more].concat(), folder.path())
}

pub(super) fn column(folder: &Folder, output: &str, component: &str) -> Vec<f64> {
    let table = std::fs::read_to_string(folder.path().join("out/history.csv")).unwrap();
    Record::from_csv(&table).unwrap().column(output, component).unwrap().to_vec()
}

/// A folder with the unit of a version of the standard.
fn folder_with(name: &str, version: u8) -> Folder {
    let folder = Folder::new(name);
    write_unit(&folder.path().join("pi.fmu"), version, &description(version, ""));
    folder
}

#[test]
fn a_unit_is_equal_to_the_same_controller_as_signals() {
    for version in [2, 3] {
        // Fixed steps that the samples divide, and adaptive ones, of which some are rejected.
        for steps in ["analysis.step=0.002", "analysis.relative_tolerance=1e-8"] {
            let folder = folder_with("units-equal", version);
            let set: &[&str] = if steps.contains("step") {
                &["--set", steps]
            } else {
                &["--unset", "analysis.step", "--set", steps, "--set", "analysis.output_step=0.002"]
            };
            let ended = run(&folder, &model(SIGNALS, "y"), set);
            assert_eq!((ended.code, &*ended.errors), (0, ""));
            let expected = [column(&folder, "arm", "angle"), column(&folder, "torque", "value")];
            let ended = run(&folder, &model(UNIT, "pid.y"), set);
            assert_eq!((ended.code, &*ended.errors), (0, ""));
            let found = [column(&folder, "arm", "angle"), column(&folder, "torque", "value")];
            assert!(expected[0].last().unwrap().abs() > 1e-3);
            for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
                assert!(
                    (found - expected).abs() < 1e-12,
                    "FMI {version}.0, {steps}: {found}, not {expected}"
                );
            }
            assert_eq!(found[0].len(), expected[0].len());
        }
    }
}

#[test]
fn units_pass_values_to_each_other_and_integers_are_numbers() {
    let folder = folder_with("units-series", 3);
    let second = UNIT.replace("[units.pid]", "[units.after]").replace("0.5 - arm.angle", "pid.y");
    let second = second.replace("n = \"count\", flag = \"flag\"", "x = \"state.x\"");
    let outputs = "[outputs.first]\nkind = \"signal\"\nof = \"pid.y\"\n[outputs.n]\nkind = \"signal\"\nof = \"pid.n\"\n\
                   [outputs.flag]\nkind = \"expression\"\nvalue = \"2*pid.flag\"\n[outputs.x]\nkind = \"signal\"\nof = \"after.x\"\n";
    let units = format!("{UNIT}{second}{outputs}").replace("0.5 - arm.angle", "cos(10*t)");
    let ended = run(&folder, &model(&units, "after.y").replace("step = 0.002", "step = 0.005"), &[]);
    assert_eq!((ended.code, &*ended.errors), (0, ""));
    // At the start each unit has its input of the start; afterwards that of the sample before.
    let (gain, rate) = (2.0, 3.0 * 5e-3);
    let [mut u, mut first, mut second] = [1.0, 0.0, 0.0];
    let mut y = gain * u;
    let mut last = y;
    for (k, row) in column(&folder, "first", "value").iter().enumerate() {
        if k > 0 {
            first += rate * u;
            second += rate * last;
            let next = gain * u + first;
            (y, last) = (next, next);
        }
        assert!((row - y).abs() < 1e-12, "sample {k}: {row}, not {y}");
        assert!((column(&folder, "x", "value")[k] - second).abs() < 1e-12);
        assert_eq!(column(&folder, "n", "value")[k], k as f64);
        u = (10.0 * k as f64 * 5e-3).cos();
    }
    assert!(column(&folder, "flag", "value").iter().all(|flag| *flag == 2.0));
}

/// Rows of the results and the message of a run whose unit fails at 0.05 s.
fn failure(mode: u8, version: u8, more: &str) -> (usize, String, Duration) {
    let folder = folder_with("units-fail", version);
    let unit = UNIT.replace("ki = 3", &format!("ki = 3, mode = {mode}")) + more;
    let began = Instant::now();
    let ended = run(&folder, &model(&unit, "pid.y"), &[]);
    assert_eq!(ended.code, 3, "{}", ended.errors);
    assert!(ended.errors.is_ascii() && !ended.errors.contains('\x1b'), "{}", ended.errors);
    let rows = column(&folder, "arm", "angle").len();
    let summary = std::fs::read_to_string(folder.path().join("out/summary.json")).unwrap();
    assert!(summary.contains("unit-failed"), "{summary}");
    (rows, ended.errors, began.elapsed())
}

#[test]
fn a_unit_that_fails_ends_the_run_with_its_results_so_far() {
    for version in [2, 3] {
        for (mode, words) in [
            (1, "signal 6 (abort)"),
            (3, "DoStep` returned Error: [31mthe valve is stuck[0m"),
            (4, "its output `y` is NaN"),
            (5, "DoStep` returned Discard"),
        ] {
            let (rows, errors, _) = failure(mode, version, "");
            assert!(errors.contains(words), "{mode}: {errors}");
            assert!(errors.contains("the unit `pid` failed in its step to t = 0.05"), "{errors}");
            // Records up to the one before the failure, every 2 ms.
            assert!((25..=28).contains(&rows), "{rows} rows");
        }
    }
    let (_, errors, _) = failure(6, 3, "");
    assert!(errors.contains("it ended the simulation"), "{errors}");
    // Its child keeps the connection open.
    let (_, errors, time) = failure(7, 3, "");
    assert!(errors.contains("signal 6 (abort)"), "{errors}");
    assert!(time < Duration::from_secs(30), "{time:?}");
    let (rows, errors, time) = failure(2, 3, "timeout = 0.5\n");
    assert!(errors.contains("did not answer within 0.5 s") && errors.contains("`timeout`"), "{errors}");
    assert!(rows >= 25 && time < Duration::from_secs(60), "{rows} rows, {time:?}");
}

#[test]
fn mistakes_in_a_unit_are_underlined() {
    let folder = folder_with("units-bad", 3);
    let check = |from: &str, to: &str, words: &[&str]| {
        let unit = UNIT.replace(from, to);
        assert_ne!(unit, UNIT, "{from}");
        let ended = run(&folder, &model(&unit, "pid.y"), &[]);
        assert_eq!(ended.code, 2, "{to}: {}", ended.errors);
        for words in words.iter().chain(&["model.toml:"]) {
            assert!(ended.errors.contains(words), "{to}: {words}\n{}", ended.errors);
        }
    };
    check("pi.fmu", "none.fmu", &["there is no such file"]);
    check("y = \"y\"", "y = \"yy\"", &["no variable `yy`", "`y`"]);
    check("y = \"y\", ", "", &["the unit `pid` has no output `y`"]);
    check("u = \"0.5", "v = \"0.5", &["no variable `v`", "`u`"]);
    check("u = \"0.5 - arm.angle\"", "", &["has the input `u`", "u\" = 0"]);
    check("u = \"0.5", "y = \"0.5", &["`y` of unit `pid` cannot be set"]);
    check("ki = 3", "kj = 3", &["no variable `kj`", "`ki`"]);
    check("ki = 3", "words = 3", &["of type String"]);
    check("ki = 3", "y = 3", &["`y` of unit `pid` cannot be set"]);
    check("sample = 5e-3", "sample = 0", &["greater than zero"]);
    check("sample = 5e-3", "", &["lacks `sample`"]);
    check("[units.pid]", "[units.arm]", &["name of a joint"]);
    for (name, content, words) in [
        ("text.fmu", &b"no archive"[..], "no ZIP archive"),
        ("empty.fmu", &zip(&[("a", b"")]), "no `modelDescription.xml`"),
        ("outside.fmu", &zip(&[("../a", b"")]), "outside of the folder"),
        (
            "first.fmu",
            &zip(&[("modelDescription.xml", b"<fmiModelDescription fmiVersion=\"1.0\"/>")]),
            "versions 2.0 and 3.0",
        ),
        (
            "exchange.fmu",
            &zip(&[(
                "modelDescription.xml",
                description(3, "").replace("CoSimulation", "ScheduledExecution").as_bytes(),
            )]),
            "supports scheduled execution only (a class of PythonFMU3 needs the base `CoSimulation`)",
        ),
        (
            "bare.fmu",
            &zip(&[("modelDescription.xml", description(2, "").as_bytes()), ("binaries/vms/pi.so", b"")]),
            "platforms are: vms",
        ),
    ] {
        std::fs::write(folder.path().join(name), content).unwrap();
        check("pi.fmu", name, &[words, name]);
    }
    let damaged = folder.path().join("damaged.fmu");
    let files = [
        ("modelDescription.xml", description(3, "")),
        (&*format!("binaries/{}/pi{}", platform(3), std::env::consts::DLL_SUFFIX), "no library".to_owned()),
    ];
    std::fs::write(&damaged, zip(&files.each_ref().map(|(name, text)| (*name, text.as_bytes())))).unwrap();
    let ended = run(&folder, &model(&UNIT.replace("pi.fmu", "damaged.fmu"), "pid.y"), &[]);
    assert_eq!(ended.code, 3, "{}", ended.errors);
    assert!(
        ended.errors.contains("the unit `pid` cannot start: its library cannot be loaded"),
        "{}",
        ended.errors
    );
}

#[test]
fn analyses_without_time_reject_units() {
    let folder = folder_with("units-other", 3);
    folder.write("model.toml", &model(UNIT, "pid.y"));
    for command in ["modes", "linearize", "gradient", "response", "campbell", "reduce", "fmu"] {
        let more: &[&str] = match command {
            "gradient" => &["--of", "arm.angle", "--by", "bodies.bob.mass"],
            "response" => &["--input", "loads.motor", "--output", "arm.angle", "--from", "1", "--to", "2"],
            "campbell" => &["--vary", "bodies.bob.mass=1:2:3"],
            "reduce" => &["--interfaces", "bob"],
            "fmu" => &["--library", "pi.fmu"],
            _ => &[],
        };
        let ended = lissom(&[&[command, "model.toml"], more].concat(), folder.path());
        assert_eq!(ended.code, 2, "{command}: {}", ended.errors);
        let is_rejected = ended.errors.contains("the unit `pid` has outputs only in a simulation in time");
        assert!(is_rejected, "{command}: {}", ended.errors);
    }
    let statics =
        model(UNIT, "pid.y").replace("kind = \"dynamics\"\nend = 0.1\nstep = 0.002", "kind = \"statics\"");
    let rest = model(UNIT, "pid.y") + "[initial]\nequilibrium = true\n";
    for (text, words) in [(statics, "statics"), (rest, "a start from equilibrium")] {
        let ended = run(&folder, &text, &[]);
        assert_eq!(ended.code, 2, "{}", ended.errors);
        assert!(
            ended.errors.contains(&format!("{words} has no sampling times, so the unit `pid`")),
            "{}",
            ended.errors
        );
    }
}

#[test]
fn a_killed_run_continues_with_the_state_of_its_unit() {
    let folder = folder_with("units-resume", 3);
    let text = model(UNIT, "pid.y").replace("end = 0.1", "end = 4");
    let ended = run(&folder, &text, &[]);
    assert_eq!((ended.code, &*ended.errors), (0, ""));
    let expected = column(&folder, "arm", "angle");
    let arguments = ["run", "model.toml", "--no-plots", "--out", "out", "--checkpoint-every", "50steps"];
    let mut started = Run::start(&arguments, folder.path());
    let checkpoint = folder.path().join("out/checkpoint.lissom");
    // The first checkpoint is that of the start.
    let rows = || {
        std::fs::read_to_string(folder.path().join("out/history.csv"))
            .map_or(0, |table| table.lines().count())
    };
    wait_for(|| checkpoint.is_file() && rows() > 500);
    started.0.kill().unwrap();
    drop(started);
    assert!(checkpoint.is_file(), "the run was not killed before its end");
    // The same token, and another archive.
    let file = folder.path().join("pi.fmu");
    let unit = std::fs::read(&file).unwrap();
    std::fs::write(&file, [&unit[..], &[0]].concat()).unwrap();
    let ended = lissom(&["run", "--resume", "out", "--quiet"], folder.path());
    assert_eq!(ended.code, 3, "{}", ended.errors);
    let words = "the unit `pid` cannot return to its stored state: the file of the unit has changed";
    assert!(ended.errors.contains(words), "{}", ended.errors);
    std::fs::write(&file, unit).unwrap();
    let ended = lissom(&["run", "--resume", "out", "--quiet"], folder.path());
    assert_eq!((ended.code, &*ended.errors), (0, ""));
    assert_eq!(column(&folder, "arm", "angle"), expected);

    // A unit that cannot return its state.
    let cannot = description(3, "").replace("canSerializeFMUState=\"true\"", "");
    write_unit(&folder.path().join("pi.fmu"), 3, &cannot);
    let ended = lissom(&arguments, folder.path());
    assert_eq!(ended.code, 2, "{}", ended.errors);
    assert!(ended.errors.contains("the state of the unit `pid` cannot be stored"), "{}", ended.errors);
}

#[test]
fn sweeps_have_a_unit_for_each_run() {
    let folder = folder_with("units-sweep", 2);
    folder.write("model.toml", &model(UNIT, "pid.y"));
    folder.write("sweep.toml", "lissom_sweep = 1\nmodel = \"model.toml\"\nsampling = \"sobol\"\nmembers = 4\n[vary]\n\"units.pid.parameters.ki\" = { from = 0, to = 300 }\n\
         [collect]\nlast = \"final(arm.angle)\"\n");
    let ended = lissom(&["sweep", "sweep.toml", "--out", "out"], folder.path());
    assert_eq!(ended.code, 0, "{}", ended.errors);
    let table = std::fs::read_to_string(folder.path().join("out/sweep.csv")).unwrap();
    assert_eq!(table.lines().count(), 5, "{table}");
}

/// A run whose unit waits in its step, with its temporary files in `temporary`.
fn waiting(folder: &Folder, temporary: &Path) -> Run {
    std::fs::create_dir_all(temporary).unwrap();
    let unit = UNIT.replace("ki = 3", "ki = 3, mode = 2") + "timeout = 200\n";
    folder.write("model.toml", &model(&unit, "pid.y"));
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_lissom"));
    command.args(["run", "model.toml", "--no-plots", "--out", "out"]).current_dir(folder.path());
    let mut run = Run(command.env("TMPDIR", temporary).spawn().unwrap());
    // Rows are written as they are buffered: the step that waits begins within a moment.
    wait_for(|| folder.path().join("out/summary.json").is_file());
    std::thread::sleep(Duration::from_millis(500));
    assert!(run.0.try_wait().unwrap().is_none());
    run
}

#[test]
fn an_interruption_does_not_wait_for_a_unit() {
    let folder = folder_with("units-interrupt", 3);
    let mut run = waiting(&folder, &folder.path().join("temporary"));
    let began = Instant::now();
    run.interrupt();
    let status = run.0.wait().unwrap();
    assert!(began.elapsed() < Duration::from_secs(5), "{:?}", began.elapsed());
    assert_eq!(status.code(), Some(130));
    let rows = column(&folder, "arm", "angle").len();
    assert!((25..=28).contains(&rows), "{rows} rows");
    let summary = std::fs::read_to_string(folder.path().join("out/summary.json")).unwrap();
    assert!(summary.contains("\"interrupted\""), "{summary}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_killed_run_leaves_no_process_and_no_folder() {
    let folder = folder_with("units-killed", 3);
    let temporary = folder.path().join("temporary");
    let mut run = waiting(&folder, &temporary);
    let left =
        || std::fs::read_dir(&temporary).unwrap().map(|entry| entry.unwrap().path()).collect::<Vec<_>>();
    let [place] = &left()[..] else { panic!("{:?}", left()) };
    // The process of the unit works in its folder.
    let works = || {
        let processes = std::fs::read_dir("/proc").unwrap().flatten();
        processes.filter_map(|own| std::fs::read_link(own.path().join("cwd")).ok()).any(|own| own == *place)
    };
    assert!(works());
    run.0.kill().unwrap();
    run.0.wait().unwrap();
    wait_for(|| !works());
    assert!(place.is_dir());
    let ended = lissom_in(&folder, &temporary);
    assert!(ended.success());
    assert!(left().is_empty(), "{:?}", left());
}

/// Runs a model with a unit that does not fail.
fn lissom_in(folder: &Folder, temporary: &Path) -> std::process::ExitStatus {
    folder.write("model.toml", &model(UNIT, "pid.y"));
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_lissom"));
    command.args(["run", "model.toml", "--quiet", "--no-plots"]).current_dir(folder.path());
    command.env("TMPDIR", temporary).status().unwrap()
}

#[test]
fn folders_and_equal_files_of_an_archive_count_once() {
    let folder = folder_with("units-twice", 3);
    let text = description(3, "");
    let name = format!("binaries/{}/pi{}", platform(3), std::env::consts::DLL_SUFFIX);
    let files: [(&str, &[u8]); 5] = [
        ("modelDescription.xml", text.as_bytes()),
        (&name, &LIBRARY),
        ("extra/", b""),
        ("extra/", b""),
        (&name, &LIBRARY),
    ];
    std::fs::write(folder.path().join("pi.fmu"), zip(&files)).unwrap();
    let ended = run(&folder, &model(UNIT, "pid.y"), &[]);
    assert_eq!((ended.code, &*ended.errors), (0, ""));
    let files: [(&str, &[u8]); 2] =
        [("modelDescription.xml", text.as_bytes()), ("modelDescription.xml", b"")];
    std::fs::write(folder.path().join("pi.fmu"), zip(&files)).unwrap();
    let ended = run(&folder, &model(UNIT, "pid.y"), &[]);
    assert_eq!(ended.code, 2, "{}", ended.errors);
    assert!(ended.errors.contains("it contains `modelDescription.xml` twice"), "{}", ended.errors);
}

#[test]
fn temporary_files_are_removed() {
    let folder = folder_with("units-files", 3);
    let temporary = folder.path().join("temporary");
    std::fs::create_dir(&temporary).unwrap();
    assert!(lissom_in(&folder, &temporary).success());
    let left: Vec<PathBuf> =
        std::fs::read_dir(&temporary).unwrap().map(|entry| entry.unwrap().path()).collect();
    assert!(left.is_empty(), "{left:?}");
}
