//! Reduced blades with `geometric` matrices against the beams of which they were made.

use std::fs;

use crate::defects::results::{Results, largest, model, near};
use crate::support::program::lissom;

/// Comparison of a column of a superelement with that of the beam, relative to the largest magnitude of the beam's.
fn assert_like_beam(superelement: &Results, beam: &Results, name: &str, tolerance: f64) {
    let [found, expected] = [superelement, beam].map(|results| largest(&results.column(name)));
    near(name, found, expected, tolerance * expected);
}

#[test]
fn super_reaction_default_scheme() {
    let found = Results::clean("super_reaction_default_scheme.toml", &[]);
    let moments = found.column("root.m2");
    for moment in &moments {
        assert!((5930.0..6260.0).contains(moment), "root.m2: {moment}");
    }
    let beam = Results::clean("super_reaction_default_scheme_beam.toml", &[]);
    for name in ["root.f1", "root.f2", "root.f3", "root.m3"] {
        assert_like_beam(&found, &beam, name, 0.03);
    }
    assert_like_beam(&found, &beam, "root.m2", 0.05);
}

#[test]
fn super_axial_jolt() {
    let found = Results::clean("super_axial_jolt.toml", &[]);
    let beam = Results::clean("super_axial_jolt_beam.toml", &[]);
    assert_like_beam(&found, &beam, "root.f1", 0.02);
    // Vibrations that the start at the undeformed shape excites: their size, not their course.
    for (name, bound) in [("root.f3", 1000.0), ("root.m2", 2000.0)] {
        let force = largest(&found.column(name));
        assert!(force < bound, "{name}: {force}, that of the beam {}", largest(&beam.column(name)));
    }
}

/// A blade that is hinged at its root and swings down from rest pulls on its hinge all the time.
#[test]
fn a_reduced_blade_that_swings_pulls_on_its_hinge() {
    const SWING: &str = r#"
gravity = [0, 0, -9.81]
[joints.hinge]
kind = "revolute"
base = "ground"
tip = "blade.START"
at = [0, 0, 0]
axis = [0, 1, 0]
[outputs.hinge]
kind = "reaction"
of = "hinge"
axes = "tip"
[outputs.swing]
kind = "relative"
of = "hinge"
[analysis]
kind = "dynamics"
end = 1
output_step = 0.01
"#;
    let swinging = |file: &str, part: &str, start: &str| {
        let text = fs::read_to_string(model(file)).unwrap();
        let (_, blade) = text.split_once(part).unwrap();
        let (blade, _) = blade.split_once("[loads.thrust]").unwrap();
        let matrices = model("mtx/");
        let blade = blade.replace("mtx/", &matrices);
        let folder = crate::support::Folder::new(&format!("swing-{start}"));
        folder.write("swing.toml", &format!("lissom = 1\n{}\n{part}{blade}", SWING.replace("START", start)));
        let ended = lissom(&["run", "swing.toml", "--out", "o", "--no-plots"], folder.path());
        Results { folder, ended }
    };
    let beam = swinging("super_axial_jolt_beam.toml", "[materials.g]", "start");
    let found = swinging("super_axial_jolt.toml", "[superelements.blade]", "blade_start");
    beam.assert_done();
    found.assert_done();
    near("swing.angle", found.last("swing.angle"), beam.last("swing.angle"), 0.01);
    let weight = 9.81 * 20.0 * 0.9 * 0.3 * 1900.0;
    let pull = found.column("hinge.f1").into_iter().fold(f64::NEG_INFINITY, f64::max);
    assert!(pull < 0.01 * weight, "it pushes with {pull} N");
    assert_like_beam(&found, &beam, "hinge.f1", 0.02);
}

/// Reduces a free blade, and compares frequencies of the superelement with those of the beam.
fn reduced(file: &str) {
    let results = Results::of("reduce", file, &["--interfaces", "blade.start,blade.end", "--modes", "6"]);
    results.assert_done();
    results.assert_silent();
    let part = fs::read_to_string(results.path(file)).unwrap();
    let path = results.path("free.toml");
    fs::write(&path, format!("{part}\n[analysis]\nkind = \"modes\"\nabout = \"undeformed\"\n")).unwrap();
    let frequencies = |path: &str| {
        let all =
            Results::of("modes", path, &["--count", "12", "--no-plots"]).column_of("modes.csv", "frequency");
        all.into_iter().filter(|frequency| *frequency > 0.01).take(4).collect::<Vec<_>>()
    };
    let found = frequencies(path.to_str().unwrap());
    let exact = frequencies(&model(file));
    assert_eq!(found.len(), 4, "{found:?}");
    for (found, exact) in found.iter().zip(&exact) {
        near("frequency", *found, *exact, 0.01 * exact);
    }
}

#[test]
fn reduce_refuses_free_beam_along_y() {
    reduced("reduce_refuses_free_beam_along_y.toml");
}

#[test]
fn reduce_refuses_free_blade() {
    reduced("reduce_refuses_free_blade.toml");
}
