//! The motion file holds the positions that the table holds, and is read up to where a crash has cut it.

use std::fs;
use std::path::Path;

use lissom::Record;
use lissom::core::motion::Vector3;
use lissom::motion::{Motion, MotionError, NodeId};
use serde_json::Value;

use crate::support::{CANTILEVER, Folder, example, lissom, summary};

/// Runs a model with its motion. The text is that of the table.
fn run(folder: &Folder, model: &str, more: &[&str]) -> (Motion, Value, Record) {
    let mut args = vec!["run", model, "--out", "out", "--quiet"];
    args.extend(more.iter().flat_map(|set| ["--set", set]));
    let ended = lissom(&args, folder.path());
    assert_eq!(ended.code, 0, "{}", ended.errors);
    let out = folder.path().join("out");
    let read = |name: &str| fs::read_to_string(out.join(name)).unwrap();
    let scene = serde_json::from_str(&read("scene.json")).unwrap();
    let motion = Motion::from_bytes(&fs::read(out.join("motion.bin")).unwrap()).unwrap();
    (motion, scene, Record::from_csv(&read("history.csv")).unwrap())
}

fn vector(value: &Value) -> Vector3 {
    Vector3::from_fn(|k, _| value[k].as_f64().unwrap())
}

/// Compares every position and displacement of the table with the motion at the same instants. How many were compared.
fn compare(motion: &Motion, scene: &Value, record: &Record) -> usize {
    let mut compared = 0;
    for output in scene["outputs"].as_array().unwrap() {
        let (name, kind) = (output["name"].as_str().unwrap(), output["kind"].as_str().unwrap());
        let letters = match kind {
            "position" => ["x", "y", "z"],
            "displacement" => ["u1", "u2", "u3"],
            _ => continue,
        };
        let node = NodeId::new(output["point"]["node"].as_u64().unwrap() as usize);
        let point = vector(&output["point"]["position"]);
        let columns = letters.map(|letter| record.column(name, letter).unwrap());
        let start = motion.reference()[node].transform_point(&point);
        for (frame, time) in motion.times().iter().enumerate() {
            let Some(row) = record.times.iter().position(|at| (at - time).abs() < 1e-12) else { continue };
            let wanted = Vector3::from_fn(|k, _| columns[k][row]);
            let place = motion.pose(frame, node).transform_point(&point);
            let found = if kind == "position" { place } else { place - start };
            assert!((found - wanted).norm() < 1e-6, "{name} at {time} s: {found} for {wanted}");
            compared += 1;
        }
    }
    compared
}

#[test]
fn places_are_those_of_the_table() {
    let folder = Folder::new("motion-places");
    folder.write("cantilever.toml", CANTILEVER);
    let cases: [(&str, &[&str], usize); 4] = [
        ("cantilever.toml", &[], 5),
        (&example("four-bar"), &["analysis.end=3"], 600),
        (&example("tip-crank"), &["analysis.end=0.1"], 200),
        // The steps are chosen: longer than the distance of frames.
        (&example("pendulum"), &["analysis.relative_tolerance=1e-6", "outputs.bob.kind=position"], 20),
    ];
    for (model, more, least) in cases {
        let (motion, scene, record) = run(&folder, model, more);
        let compared = compare(&motion, &scene, &record);
        assert!(compared >= least, "{model}: {compared} places were compared");
        let times = motion.times();
        assert!(times.is_sorted_by(|a, b| a < b) && times.len() < 1300, "{model}: {} frames", times.len());
        assert_eq!(times.first(), record.times.first());
        let ends = [times.last().unwrap(), record.times.last().unwrap()];
        assert!((ends[0] - ends[1]).abs() < 1e-9, "{model}: {ends:?}");
    }
}

#[test]
fn section_forces_are_those_of_statics() {
    let folder = Folder::new("motion-forces");
    folder.write("cantilever.toml", CANTILEVER);
    let (motion, _, _) = run(&folder, "cantilever.toml", &["loads.tip.scale=3"]);
    let points = &motion.header().force_points[0];
    assert_eq!((points.beam.as_str(), points.at.len()), ("bar", 8));
    let last = motion.times().len() - 1;
    for (point, at) in points.at.iter().enumerate() {
        let forces = motion.section_forces(last, point);
        // The load is small, and the force is across the beam: bending about axis 2, none beyond the tip.
        let lever = 1.0 - at;
        assert!((forces[2] - 3.0).abs() < 1e-3, "{forces}");
        assert!((forces[4].abs() - 3.0 * lever).abs() < 2e-3, "{at}: {forces}");
    }
}

#[test]
fn frames_are_as_many_as_asked_for() {
    let folder = Folder::new("motion-rate");
    let pendulum = example("pendulum");
    let spread =
        |motion: &Motion| motion.times().windows(2).map(|pair| pair[1] - pair[0]).fold(0.0_f64, f64::max);
    let (motion, _, _) = run(&folder, &pendulum, &["analysis.end=1", "analysis.frames_per_second=25"]);
    assert_eq!(motion.times().len(), 26);
    assert!((spread(&motion) - 0.04).abs() < 1e-9);
    // Chosen steps are longer than a frame: what is between is interpolated, at most a frame apart.
    let (motion, _, _) = run(&folder, &pendulum, &["analysis.end=1", "analysis.relative_tolerance=1e-3"]);
    assert!(spread(&motion) <= 1.0 / 600.0 + 1e-12, "{}", spread(&motion));
    let ended = lissom(&["check", &pendulum, "--set", "analysis.frames_per_second=1e9"], folder.path());
    assert_eq!(ended.code, 2, "{}", ended.output);
    assert!(ended.errors.contains("frames of motion"), "{}", ended.errors);
}

#[test]
fn a_run_without_plots_replaces_the_motion_of_a_former_run() {
    let folder = Folder::new("motion-former");
    folder.write("cantilever.toml", CANTILEVER);
    run(&folder, "cantilever.toml", &[]);
    let out = folder.path().join("out");
    let former = fs::read(out.join("motion.bin")).unwrap();
    let set = ["--no-plots", "--set", "gravity=[0, 0, -1]"];
    let ended = lissom(&[&["run", "cantilever.toml", "--out", "out"], &set[..]].concat(), folder.path());
    assert_eq!(ended.code, 0, "{}", ended.errors);
    assert!(fs::read(out.join("motion.bin")).unwrap() != former && out.join("scene.json").exists());
    assert!(
        !fs::read_dir(&out).unwrap().any(|file| file.unwrap().path().extension() == Some("svg".as_ref()))
    );
    assert_eq!(summary(&out)["stopped"], "end");
}

#[test]
fn files_that_are_cut_or_foreign_are_reported() {
    let folder = Folder::new("motion-cut");
    folder.write("cantilever.toml", CANTILEVER);
    let (motion, _, _) = run(&folder, "cantilever.toml", &[]);
    let bytes = fs::read(Path::new(&folder.path().join("out/motion.bin"))).unwrap();
    let whole = motion.times().len();
    let cut = Motion::from_bytes(&bytes[..bytes.len() - 5]).unwrap();
    assert_eq!(cut.times(), &motion.times()[..whole - 1]);
    assert_eq!(Motion::last_time(&bytes[..bytes.len() - 5]).unwrap(), cut.times().last().copied());
    assert_eq!(Motion::from_bytes(&bytes[1..]), Err(MotionError::Foreign));
    assert_eq!(Motion::from_bytes(&bytes[..100]), Err(MotionError::Damaged));
    let mut other = bytes.clone();
    other[8] = 9;
    assert_eq!(Motion::from_bytes(&other), Err(MotionError::Version(9)));
    // No changed bit is another motion.
    let mut changed = bytes.clone();
    for bit in (0..8 * bytes.len()).step_by(641).chain(8 * (bytes.len() - 300)..8 * bytes.len()) {
        changed[bit / 8] ^= 1 << (bit % 8);
        assert!(Motion::from_bytes(&changed).is_err(), "bit {bit}");
        changed[bit / 8] = bytes[bit / 8];
    }
    let frame = motion.header().frame_bytes;
    changed[bytes.len() - frame + 12] ^= 1;
    assert_eq!(Motion::from_bytes(&changed), Err(MotionError::Altered(whole)));
    let mut earlier = unsealed(&bytes, frame);
    let read = Motion::from_bytes(&earlier).unwrap();
    assert_eq!((read.times(), read.reference()), (motion.times(), motion.reference()));
    assert_eq!(read.frame(whole - 1), motion.frame(whole - 1));
    // A time that is no number.
    let end = earlier.len();
    earlier[end - frame + 8..end - frame + 16].copy_from_slice(&f64::NAN.to_le_bytes());
    assert_eq!(Motion::from_bytes(&earlier), Err(MotionError::NotFinite(whole)));
}

/// A motion file as of version 1, without checksums.
fn unsealed(bytes: &[u8], frame: usize) -> Vec<u8> {
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    let header = std::str::from_utf8(&bytes[16..16 + length]).unwrap();
    let [now, before] = [frame, frame - 8].map(|length| format!("\"frame_bytes\":{length}"));
    let header = format!("{:length$}", header.trim_end().replace(&now, &before));
    let nodes = Motion::from_bytes(bytes).unwrap().reference().len();
    let poses = 16 + length + 56 * nodes;
    let mut earlier = [&bytes[..8], &[1, 0, 0, 0], &bytes[12..16], header.as_bytes()].concat();
    earlier.extend(&bytes[16 + length..poses]);
    for own in bytes[poses + 8..].chunks_exact(frame) {
        earlier.extend(&own[..frame - 8]);
    }
    earlier
}
