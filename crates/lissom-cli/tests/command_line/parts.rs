//! Models of parts, as scripts see them.

use std::fs;
use std::path::Path;

use lissom::core::motion::{Rotation, Vector3};
use lissom::{Model, Record};

use crate::support::{CANTILEVER, Folder, example, lissom, summary};

fn history(folder: &Path) -> Record {
    Record::from_csv(&fs::read_to_string(folder.join("history.csv")).unwrap()).unwrap()
}

fn vectors(record: &Record, output: &str, names: [&str; 3]) -> Vec<Vector3> {
    let columns = names.map(|name| record.column(output, name).unwrap_or_else(|| panic!("{output}.{name}")));
    (0..record.times.len()).map(|row| Vector3::from_fn(|i, _| columns[i][row])).collect()
}

#[test]
fn a_delta_robot_is_one_leg_file() {
    let folder = Folder::new("parts-delta");
    let ended = lissom(&["run", &example("delta-robot"), "--out", "out", "--no-plots"], folder.path());
    assert_eq!(ended.code, 0, "{}", ended.errors);
    let record = history(&folder.path().join("out"));
    let platform = vectors(&record, "platform", ["x", "y", "z"]);
    let turn = vectors(&record, "turn", ["r1", "r2", "r3"]);
    assert!(record.times.len() > 400);
    // The platform goes a long way and does not turn; each of its rods keeps its length.
    let largest = platform.iter().map(|place| (place - platform[0]).norm()).fold(0.0, f64::max);
    assert!(largest > 0.05, "{largest}");
    for leg in 1..=3 {
        let angle = 2.0 * std::f64::consts::PI * f64::from(leg - 1) / 3.0;
        let about = Rotation::exponential(&Vector3::new(0.0, 0.0, angle));
        let elbows = vectors(&record, &format!("leg{leg}.elbow"), ["x", "y", "z"]);
        for (row, elbow) in elbows.iter().enumerate() {
            let wrist = platform[row] + about.apply(&Vector3::new(0.06, 0.05, 0.0));
            assert!(((elbow - wrist).norm() - 0.6).abs() < 1e-9, "leg {leg} at {}", record.times[row]);
            assert!(turn[row].norm() < 1e-9, "{}", turn[row]);
        }
    }
}

#[test]
fn a_rotor_of_three_blades_has_the_energy_of_its_formula() {
    let folder = Folder::new("parts-rotor");
    let args = ["run", &example("turbine-rotor"), "--out", "out", "--no-plots", "--set", "analysis.end=0.5"];
    let ended = lissom(&args, folder.path());
    assert_eq!(ended.code, 0, "{}", ended.errors);
    let record = history(&folder.path().join("out"));
    // Mass and moments of the sections are linear along the blade; the section turns from 0.25 to 0.05 rad.
    let (density, root, length, speed) = (1900.0, 0.5, 10.0, 40.0 * std::f64::consts::TAU / 60.0);
    let moment = |s: f64| {
        let mix = |inner: f64, outer: f64| inner + (outer - inner) * s;
        let area = mix(0.6 * 0.12, 0.3 * 0.04);
        // Second moments for distances along axes 3 and 2.
        let across = mix(0.6 * 0.12_f64.powi(3), 0.3 * 0.04_f64.powi(3)) / 12.0;
        let along = mix(0.12 * 0.6_f64.powi(3), 0.04 * 0.3_f64.powi(3)) / 12.0;
        let twist = 0.05 + 0.2 * (1.0 - s);
        // About the shaft along x, which axis 3 leans to: the distance along axis 2, seen across x.
        let lateral = along * twist.cos().powi(2) + across * twist.sin().powi(2);
        density * (area * (root + length * s).powi(2) + lateral) * length
    };
    let simpson: f64 = (0..1000)
        .map(|k| {
            let (a, h) = (f64::from(k) / 1000.0, 1e-3);
            (moment(a) + 4.0 * moment(a + h / 2.0) + moment(a + h)) * h / 6.0
        })
        .sum();
    let wanted = 0.5 * (150.0 + 3.0 * simpson) * speed * speed;
    let found = record.column("energy", "kinetic").unwrap()[0];
    assert!((found / wanted - 1.0).abs() < 1e-6, "{found} {wanted}");
    // Three equal blades: gravity does no work in sum, so that the speed stays.
    let rate = record.column("shaft", "rate").unwrap();
    assert!(rate.iter().all(|rate| (rate / speed - 1.0).abs() < 1e-3));
}

/// Whatever kinds a model is made of: turned and shifted as a part it moves as it did.
#[test]
fn a_model_that_is_a_part_moves_as_it_did() {
    for (name, outputs) in [
        ("four-bar", vec![("C", ["u1", "u2", "u3"])]),
        ("tip-crank", vec![("midspan", ["u1", "u2", "u3"])]),
        ("top", vec![("center", ["x", "y", "z"])]),
    ] {
        let text = fs::read_to_string(example(name)).unwrap();
        let (parts, analysis) = text.split_once("[analysis]").unwrap();
        let (parts, gravity): (Vec<&str>, Vec<&str>) =
            parts.lines().partition(|line| !line.starts_with("gravity"));
        let turn = Rotation::exponential(&Vector3::new(0.4, -0.7, 1.1));
        let shift = Vector3::new(0.3, -2.0, 0.7);
        let gravity = gravity.first().map_or(String::new(), |line| {
            let numbers = line.split(['[', ']']).nth(1).unwrap();
            let numbers: Vec<f64> = numbers.split(',').map(|number| number.trim().parse().unwrap()).collect();
            let turned = turn.apply(&Vector3::new(numbers[0], numbers[1], numbers[2]));
            format!("gravity = [{:?}, {:?}, {:?}]\n", turned.x, turned.y, turned.z)
        });
        let whole = format!(
            "lissom = 1\n{gravity}[parts.p]\ninclude = \"p.toml\"\nposition = [0.3, -2.0, 0.7]\n\
             rotation = [0.4, -0.7, 1.1]\n[analysis]{analysis}"
        );
        let set = [("analysis.end".to_owned(), "0.25".to_owned())];
        let model = Model::from_text("whole.toml", &whole)
            .with_included([("p.toml".to_owned(), parts.join("\n"))].into());
        let placed = model
            .with_overrides(&set)
            .session()
            .unwrap_or_else(|error| panic!("{name}: {error}"))
            .run()
            .unwrap();
        let alone =
            Model::from_text("alone.toml", &text).with_overrides(&set).session().unwrap().run().unwrap();
        for (output, names) in outputs {
            let as_was = vectors(&alone, output, names);
            let now = vectors(&placed, &format!("p.{output}"), names);
            let moved = |vector: &Vector3| {
                turn.apply(vector) + if names[0] == "x" { shift } else { Vector3::zeros() }
            };
            let largest = as_was.iter().map(Vector3::norm).fold(0.0, f64::max);
            assert!(largest > 0.0);
            for (a, b) in as_was.iter().zip(&now) {
                assert!((moved(a) - b).norm() < 1e-6 * largest, "{name}: {} {b}", moved(a));
            }
        }
    }
}

const PART: &str = "[analysis]";

/// The cantilever as a part in a file of its own.
fn split(folder: &Folder) {
    let (parts, _) = CANTILEVER.split_once(PART).unwrap();
    folder.write("bar.toml", parts);
    folder.write(
        "model.toml",
        "lissom = 1\n[parts.a]\ninclude = \"bar.toml\"\n[analysis]\nkind = \"statics\"\nsteps = 4\n",
    );
}

#[test]
fn values_inside_of_parts_can_be_set() {
    let folder = Folder::new("parts-set");
    split(&folder);
    let tip = |set: &str| {
        let ended = lissom(&["run", "model.toml", "--no-plots", "--out", "out", "--set", set], folder.path());
        assert_eq!(ended.code, 0, "{}", ended.errors);
        let record = history(&folder.path().join("out"));
        *record.column("a.tip", "u3").unwrap().last().unwrap()
    };
    // The load `a.tip` has a scale, the output of this name has none.
    let (once, twice) = (tip("a.tip.scale=3*t"), tip("loads.\"a.tip\".scale=6*t"));
    assert!((twice / once - 2.0).abs() < 1e-2, "{once} {twice}");
    let ended = lissom(&["check", "model.toml", "--set", "a.tip.kind=force"], folder.path());
    assert_eq!(ended.code, 2);
    assert!(ended.errors.contains("`a.tip` is a load and a output"), "{}", ended.errors);
    fs::remove_file(folder.path().join("bar.toml")).unwrap();
    let ended = lissom(&["check", "model.toml"], folder.path());
    assert_eq!(ended.code, 2);
    assert!(
        ended.errors.contains("there is no such file") && ended.errors.contains("model.toml:3:11"),
        "{}",
        ended.errors
    );
}

#[test]
fn a_sweep_knows_the_files_that_its_model_includes() {
    let folder = Folder::new("parts-sweep");
    split(&folder);
    folder.write(
        "sweep.toml",
        "lissom_sweep = 1\nmodel = \"model.toml\"\n[vary]\n\"a.bar.elements\" = [1, 2]\n[collect]\ntip = \"final(a.tip.u3)\"\n",
    );
    let sweep = || lissom(&["sweep", "sweep.toml", "--out", "out"], folder.path());
    assert_eq!(sweep().code, 0);
    assert_eq!(sweep().code, 0, "the same again");
    let bar = fs::read_to_string(folder.path().join("bar.toml")).unwrap();
    folder.write("bar.toml", &bar.replace("scale = \"3*t\"", "scale = \"4*t\""));
    let other = sweep();
    assert_ne!(other.code, 0);
    assert!(other.errors.contains("holds another sweep"), "{}", other.errors);
}

#[test]
fn a_run_goes_on_with_the_files_it_began_with() {
    let folder = Folder::new("parts-resume");
    let leg = fs::read_to_string(example("parts/delta-leg")).unwrap();
    let robot = fs::read_to_string(example("delta-robot")).unwrap();
    fs::create_dir_all(folder.path().join("parts")).unwrap();
    folder.write("parts/delta-leg.toml", &leg);
    folder.write("robot.toml", &robot);
    // A failure leaves its checkpoint: the run can go on from there, with what the model was.
    let args = ["run", "robot.toml", "--out", "out", "--no-plots", "--checkpoint-every", "20steps"];
    let failed =
        lissom(&[&args[..], &["--set", "leg1.motor.rotation=0.3*t/(1.001 - 4*t)"]].concat(), folder.path());
    assert_eq!(failed.code, 3, "{}", failed.errors);
    let steps = summary(&folder.path().join("out"))["steps"].as_u64().unwrap();
    assert!(steps > 40, "{steps}");
    folder.write("parts/delta-leg.toml", "mistake");
    let again = lissom(&["run", "--resume", "out"], folder.path());
    assert_eq!(again.code, 3, "it fails where it did: {}", again.errors);
    assert!(!again.errors.contains("TOML"), "{}", again.errors);
    assert_eq!(summary(&folder.path().join("out"))["steps"].as_u64().unwrap(), steps);
}
