//! Analyses of kind `path`, as scripts see them.

use lissom::ResultFolder;

use super::support::{Folder, lissom, summary};
use super::truss::truss;

/// Two springs lean on each other, and snap through under a load.
fn shallow_truss() -> String {
    truss(0.3, -1, "[analysis]\nkind = \"path\"\nend = 60\n")
}

#[test]
fn a_path_leaves_its_load_factor_and_its_limits() {
    let folder = Folder::new("path");
    folder.write("truss.toml", &shallow_truss());
    let run = lissom(&["run", "truss.toml"], folder.path());
    assert_eq!((run.code, run.errors.as_str()), (0, ""));
    assert!(run.output.contains("limit        load factor"), "{}", run.output);
    let out = folder.path().join("out/truss");
    let text = std::fs::read_to_string(out.join("history.csv")).unwrap();
    assert_eq!(text.lines().next().unwrap(), "time,load_factor,unstable,top.x,top.y,top.z");
    assert!(text.lines().last().unwrap().split(',').nth(1).unwrap().starts_with("60"), "{text}");
    assert!(out.join("top.svg").is_file() && out.join("load_factor.svg").is_file());
    let facts = summary(&out);
    assert_eq!(facts["stopped"], "end");
    let points = facts["critical_points"].as_array().unwrap();
    assert_eq!(points.len(), 2);
    assert!(points.iter().all(|point| point["kind"] == "limit"));
    let factor = |index: usize| points[index]["load_factor"].as_f64().unwrap();
    assert!(factor(0) > 0.0 && (factor(0) + factor(1)).abs() < 1e-8);
    let check = lissom(&["check", "truss.toml"], folder.path());
    assert!(check.output.contains("equilibrium path to load factor 60"), "{}", check.output);
}

#[test]
fn a_path_that_ends_early_has_an_exit_code() {
    let folder = Folder::new("short-path");
    folder.write("truss.toml", &shallow_truss());
    let run = lissom(&["run", "truss.toml", "--set", "analysis.steps=4", "--quiet"], folder.path());
    assert_eq!((run.code, run.output.as_str()), (3, ""));
    assert!(run.errors.contains("has not reached 60"), "{}", run.errors);
    let out = folder.path().join("out/truss");
    assert_eq!(summary(&out)["stopped"], "failed");
    assert_eq!(std::fs::read_to_string(out.join("history.csv")).unwrap().lines().count(), 6);
    let run = lissom(&["run", "truss.toml", "--set", "loads.down.scale=0"], folder.path());
    assert_eq!(run.code, 3);
    assert!(run.errors.contains("load factor has no effect"), "{}", run.errors);
    let run = lissom(&["run", "truss.toml", "--set", "analysis.end=0"], folder.path());
    assert_eq!(run.code, 2, "{}", run.errors);
}

#[test]
fn a_path_is_seen_by_its_load_factors() {
    let folder = Folder::new("path-seen");
    folder.write("truss.toml", &shallow_truss());
    let view = lissom(&["view", "truss.toml", "--quiet"], folder.path());
    assert_eq!(view.code, 0, "{}", view.errors);
    let out = folder.path().join("out/truss");
    let run = ResultFolder::recorded(&out).unwrap();
    // A frame for every equilibrium, at the length of the path, where the table says.
    assert_eq!(run.motion.times(), run.record.times);
    let top = run.motion.node("top").unwrap();
    for (frame, y) in run.record.column("top", "y").unwrap().iter().enumerate() {
        assert!((run.motion.pose(frame, top).position.y - y).abs() < 1e-6);
    }
    let path = run.scene.path.as_ref().unwrap();
    assert_eq!(
        (path.name.as_str(), &path.values[..]),
        ("load factor", run.record.column("load_factor", "").unwrap())
    );
    // The arrow of the load grows with the factor, and turns where it is below zero.
    let scale = &run.scene.loads[0].scale;
    let last = *path.values.last().unwrap();
    assert!((scale[0], *scale.last().unwrap()) == (0.0, last) && scale.iter().any(|factor| *factor < 0.0));
    let picture = lissom(&["snapshot", "out/truss", "--strip", "3"], folder.path());
    assert_eq!(picture.code, 0, "{}", picture.errors);
    let drawn = std::fs::read_to_string(out.join("snapshot.svg")).unwrap();
    assert!(drawn.contains("load factor 0") && drawn.contains("load factor 60"), "{drawn}");
    // Along another number loads may be of any size: none is drawn.
    let along = shallow_truss().replace("end = 60", "end = 2000\nvary = \"springs.left.stiffness\"");
    folder.write("stiffer.toml", &along);
    let view = lissom(&["view", "stiffer.toml", "--quiet"], folder.path());
    assert_eq!(view.code, 0, "{}", view.errors);
    let stiffer = ResultFolder::recorded(&folder.path().join("out/stiffer")).unwrap();
    let path = stiffer.scene.path.unwrap();
    assert_eq!((path.name.as_str(), path.values.last()), ("springs.left.stiffness", Some(&2000.0)));
    assert!(stiffer.scene.loads.is_empty());
    // The motion is also recorded without plots.
    let bare = lissom(&["run", "truss.toml", "--no-plots", "-q"], folder.path());
    assert!(bare.code == 0 && out.join("motion.bin").exists());
    assert_eq!(lissom(&["snapshot", "out/truss"], folder.path()).code, 0);
    std::fs::remove_file(out.join("motion.bin")).unwrap();
    assert_eq!(lissom(&["snapshot", "out/truss"], folder.path()).code, 2);
}
