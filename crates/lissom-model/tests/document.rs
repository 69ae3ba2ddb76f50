//! Good model files are read, bad ones are rejected with the message their first line asks for.

use crate::support;

use std::fs;
use std::path::{Path, PathBuf};

use lissom_model::document::{AnalysisKind, Document, NodeReference, OutputSource};
use lissom_model::{Report, Severity};
use lissom_motion::Vector3;

use support::registry;

fn files(folder: &str) -> Vec<(PathBuf, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(folder);
    let mut paths: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths.into_iter().map(|path| (path.clone(), fs::read_to_string(path).unwrap())).collect()
}

fn good(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/good").join(name);
    fs::read_to_string(path).unwrap()
}

fn read(name: &str) -> Document {
    Document::parse(&good(name), name, &registry()).map_err(|report| report.render(false)).unwrap()
}

fn read_with(name: &str, overrides: &[(&str, &str)]) -> Result<Document, Report> {
    let overrides: Vec<_> = overrides.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect();
    Document::parse_with(&good(name), name, &registry(), &overrides)
}

#[test]
fn good_files_are_read_without_warnings() {
    let files = files("good");
    assert!(files.len() >= 4);
    for (path, text) in files {
        match Document::parse(&text, "good.toml", &registry()) {
            Ok(document) => {
                assert!(
                    document.warnings.is_empty(),
                    "{}\n{}",
                    path.display(),
                    document.warnings.render(false)
                );
            }
            Err(report) => panic!("{}\n{}", path.display(), report.render(false)),
        }
    }
}

/// The first line is `# message | help`, the second part optional; a file that is read with a warning counts too.
#[test]
fn bad_files_are_refused_with_their_message() {
    let files = files("bad");
    assert!(files.len() >= 40, "{}", files.len());
    let mut wrong = String::new();
    for (path, text) in &files {
        let wanted = text.lines().next().unwrap().trim_start_matches('#').trim();
        let (message, help) = wanted.split_once(" | ").unwrap_or((wanted, ""));
        let (report, warned) = match Document::parse(text, "bad.toml", &registry()) {
            Ok(document) => (document.warnings, true),
            Err(report) => (report, false),
        };
        let found = report.problems().any(|problem| {
            problem.message.contains(message) && problem.help.as_deref().unwrap_or("").contains(help)
        });
        let severity = if warned { Severity::Warning } else { Severity::Error };
        let single = report.problems().filter(|problem| problem.severity == severity).count() == 1;
        let helpful = report.problems().all(|problem| problem.help.is_some());
        let shown = report.render(false).contains("[bad.toml:");
        if !(found && helpful && shown && (single || path.ends_with("many_errors.toml"))) {
            let shown = report.render(false);
            wrong.extend([path.to_str().unwrap(), ": wanted ", wanted, "\n", &shown, "\n"]);
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn all_mistakes_of_a_file_are_reported_at_once() {
    let (_, text) = files("bad").into_iter().find(|(path, _)| path.ends_with("many_errors.toml")).unwrap();
    let report = Document::parse(&text, "many.toml", &registry()).unwrap_err();
    assert_eq!(report.len(), 9, "{}", report.render(false));
    assert_eq!(report.to_string(), "many.toml: 9 errors");
}

#[test]
fn the_tip_crank_is_what_its_file_says() {
    let document = read("tip_crank.toml");
    assert_eq!(document.beams.len(), 4);
    let connector = document.beam("connector").unwrap();
    let shared = &connector.shared_start.as_ref().unwrap().value;
    assert_eq!(*shared, NodeReference::Beam { beam: "beam".to_owned(), fraction: 1.0 });
    assert_eq!(connector.line.position(0.0), Vector3::new(1.0, 0.0, 0.0));
    assert_eq!(connector.line.position(1.0), Vector3::new(1.0, 0.005, 0.0));
    assert_eq!(document.beam("link").unwrap().order, 3);
    // The link is vertical: axis 3 leans to y.
    assert_eq!(document.beam("link").unwrap().up, Vector3::y());
    let stiffness = document.section("strip").unwrap().properties.stiffness;
    assert!((stiffness[(1, 1)] / (5.0 / 6.0 * 73e9 / 2.6 * 0.0025 * 0.1) - 1.0).abs() < 1e-14);
    let drive = document.joints.iter().find(|joint| joint.name.value == "drive").unwrap();
    let rotation = drive.parameters.function("rotation").unwrap();
    assert!((rotation.value(0.8) - 3.2).abs() < 1e-14);
    assert!((rotation.second_derivative(0.0) - 1.6 * (std::f64::consts::TAU / 1.6).powi(2)).abs() < 1e-12);
    let hinge = document.joints.iter().find(|joint| joint.name.value == "hinge").unwrap();
    assert_eq!(hinge.attachment.nodes[0].at, Some(Vector3::new(0.97, 0.005, -0.5)));
    assert_eq!(hinge.attachment.axes[0].value, -Vector3::y());
    let pin = document.joints.iter().find(|joint| joint.name.value == "pin").unwrap();
    assert_eq!(pin.attachment.nodes[1].at, Some(Vector3::new(1.0, 0.005, -0.5)));
    assert!(matches!(document.outputs[2].source, OutputSource::Joint(_)));
    assert!(
        matches!(document.analysis.kind, AnalysisKind::Dynamics { step, control: None } if step.value == 5e-4)
    );
    assert_eq!(document.analysis.scheme.unwrap().value, "radau-iia");
}

#[test]
fn everything_is_what_its_file_says() {
    let document = read("everything.toml");
    let taper = document.beam("taper").unwrap();
    assert_eq!(taper.stations.len(), 3);
    let at = |s| taper.properties(&document, s, 1.0).unwrap().stiffness[(0, 0)];
    let of = |name: &str| document.section(name).unwrap().properties.stiffness[(0, 0)];
    assert_eq!(at(0.0), of("round"));
    assert!((at(0.2) - 0.5 * (of("round") + of("two"))).abs() < 1e-9 * of("two"));
    assert!((at(0.4) - of("two")).abs() < 1e-9 * of("two"));
    assert_eq!(at(1.0), of("diagonal"));
    assert!((taper.twist.jet(1.0).value - 0.5).abs() < 1e-15);
    let plate = document.bodies.iter().find(|body| body.name.value == "plate").unwrap();
    assert_eq!(plate.position, Vector3::new(0.5, 0.0, 0.0));
    assert_eq!(plate.axes * Vector3::x(), Vector3::y());
    let top = &document.bodies[0];
    assert!((top.axes * Vector3::x() - Vector3::y()).norm() < 1e-14);
    let bob = document.point_masses.iter().find(|mass| mass.name.value == "bob").unwrap();
    assert_eq!(bob.position, -Vector3::z());
    let push = &document.loads[0].parameters;
    assert!((push.function("scale").unwrap().value(1.0) - 2.0).abs() < 1e-15);
    assert!(push.flag("follower").unwrap());
    assert_eq!(document.analysis.end, 2.0);
    assert_eq!(document.analysis.parameters.number("alpha").unwrap(), -1.0 / 3.0);
    assert_eq!(document.parameters["half"], 0.5);
    assert_eq!(document.materials[0].constants.density, 1000.0);
}

#[test]
fn overrides_change_values() {
    let changed = [
        ("analysis.step", "1e-4"),
        ("materials.steel.E", "2e11"),
        ("analysis.scaling", "none"),
        ("analysis.scheme", "hht"),
        ("analysis.alpha", "-0.1"),
        ("points.C", "[1, 0.01, 0]"),
        ("parameters.T", "2"),
        ("joints.drive.rotation", "T*t^2"),
        ("outputs.midspan.of", "beam@0.25"),
        ("title", "\"other\""),
    ];
    let document = read_with("tip_crank.toml", &changed).map_err(|report| report.render(false)).unwrap();
    assert!(
        matches!(document.analysis.kind, AnalysisKind::Dynamics { step, control: None } if step.value == 1e-4)
    );
    assert_eq!(document.materials[1].constants.young, 2e11);
    assert_eq!(document.points["C"].y, 0.01);
    assert_eq!(document.title.as_deref(), Some("other"));
    let drive = document.joints.last().unwrap();
    assert_eq!(drive.parameters.function("rotation").unwrap().second_derivative(0.0), 4.0);
}

#[test]
fn wrong_overrides_are_underlined() {
    for (path, value, message, help) in [
        ("analysis.stpe", "1", "unknown key `stpe`", "did you mean `step`?"),
        ("analysis.step", "-1", "greater than zero", ""),
        ("materials.stel.E", "1", "no `materials.stel`", "did you mean `steel`?"),
        ("material.steel.E", "1", "`material` is not a key", "did you mean `materials`?"),
        ("parameters.TT", "1", "no `parameters.TT`", ""),
        ("title.x", "1", "`title` is a value", ""),
        ("analysis..step", "1", "not a path", "analysis.step"),
        ("", "1", "not a path", ""),
        ("analysis.step", "1\nfoo = 2", "cannot be read", ""),
        ("points.C", "[1, 0.01", "not TOML", ""),
        ("analysis.scheme", "raudau-iia", "cannot be `raudau-iia`", "did you mean `radau-iia`?"),
        ("materials", "3", "must be a table", ""),
    ] {
        let report = read_with("tip_crank.toml", &[(path, value)]).unwrap_err();
        let problem = report.problems().next().unwrap();
        assert!(problem.message.contains(message), "{}", report.render(false));
        assert!(problem.help.as_deref().unwrap_or("").contains(help), "{}", report.render(false));
        assert!(report.render(false).contains("[override:"), "{}", report.render(false));
    }
}

#[test]
fn later_problems_can_be_underlined() {
    let document = read("planar.toml");
    let span = document.springs[0].span_of("stiffness");
    let report = document.report(vec![lissom_model::Problem::error(span, "too stiff")]);
    assert!(report.render(false).contains("[planar.toml:20:13]"), "{}", report.render(false));
}

/// A wheel with this inertia, on a beam of this section, with an axle along this axis.
fn wheel(inertia: &str, section: &str, axis: &str) -> Document {
    let text = format!(
        "lissom = 1\n[materials.steel]\nE = 210e9\nnu = 0.3\ndensity = 7850\n[sections.bar]\nmaterial = \"steel\"\n{section}\n\
         [beams.beam]\nsection = \"bar\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 2\n\
         [bodies.wheel]\nmass = {{ density = 1000 }}\ninertia = {inertia}\nshape = {inertia}\n\
         [joints.axle]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"wheel\"\naxis = {axis}\n\
         [analysis]\nkind = \"dynamics\"\nend = 1\nstep = 0.01\n"
    );
    Document::parse(&text, "wheel.toml", &registry())
        .unwrap_or_else(|report| panic!("{}", report.render(false)))
}

#[test]
fn solids_sections_and_axes_have_one_grammar() {
    let one = wheel(
        "{ tube = [0.3, 0.2, 0.1], axis = \"y\" }",
        "shape = \"rectangle\"\nwidth = 0.1\nheight = 0.2",
        "[0, -1, 0]",
    );
    let other = wheel(
        "{ kind = \"tube\", radius = 0.3, inner_radius = 0.2, length = 0.1, axis = [0, 2, 0] }",
        "shape = { kind = \"rectangle\", width = 0.1, height = 0.2 }",
        "\"-y\"",
    );
    let (body, same) = (&one.bodies[0], &other.bodies[0]);
    assert_eq!((body.mass, body.inertia, &body.surface), (same.mass, same.inertia, &same.surface));
    assert_eq!(one.sections[0].properties, other.sections[0].properties);
    let axis = |document: &Document| document.joints[0].attachment.axes[0].value;
    assert_eq!(axis(&one), axis(&other));
    for (short, long) in [
        ("{ box = [0.1, 0.2, 0.3] }", "{ kind = \"box\", sides = [0.1, 0.2, 0.3] }"),
        ("{ cylinder = [0.1, 0.3] }", "{ kind = \"cylinder\", radius = 0.1, length = 0.3 }"),
        ("{ sphere = 0.1 }", "{ kind = \"sphere\", radius = 0.1 }"),
    ] {
        let circle = "shape = \"circle\"\nradius = 0.1";
        let [short, long] = [short, long].map(|solid| wheel(solid, circle, "\"z\"").bodies[0].clone());
        assert_eq!((short.mass, short.inertia, short.surface), (long.mass, long.inertia, long.surface));
    }
}

#[test]
fn contacts_without_kind_have_the_one_of_their_parts_and_keys() {
    let text = r#"
lissom = 1
[ground]
shape = { kind = "plane" }
[bodies.ball]
mass = 1
inertia = { sphere = 0.1 }
shape = { sphere = 0.1 }
position = [0, 0, 0.3]
[materials.steel]
E = 2e11
nu = 0.3
density = 7800
[sections.rod]
shape = { kind = "circle", radius = 0.01 }
material = "steel"
[beams.rod]
section = "rod"
from = [0, 0, 1]
to = [1, 0, 1]
elements = 2
[shells.sheet]
material = "steel"
thickness = 0.01
corners = [[0, 0, 2], [1, 0, 2], [1, 1, 2], [0, 1, 2]]
divisions = [2, 2]
[contacts.touch]
KEYS
[analysis]
kind = "dynamics"
end = 0.1
"#;
    let cases = [
        ("compliant", "base = \"ground\"\ntip = \"ball\"\nstiffness = 1e6\nfriction = 0.3"),
        ("rigid", "base = \"ground\"\ntip = \"ball\"\nrigid = true"),
        ("along", "base = \"ground\"\ntip = \"rod\"\nstiffness_per_length = 1e6"),
        ("nearest", "base = \"ball\"\ntip = \"rod\"\nstiffness = 1e6"),
        ("nearest", "base = \"ball\"\ntip = \"sheet\"\nstiffness = 1e6"),
        ("nodes", "base = \"ground\"\ntip = \"sheet\"\nstiffness_per_area = 1e6"),
    ];
    for (kind, keys) in cases {
        let read = |keys: &str| {
            let text = text.replace("KEYS", keys);
            Document::parse(&text, "contact.toml", &registry()).map_err(|report| report.render(false))
        };
        let inferred = read(keys).unwrap().contacts[0].law.clone();
        // Spans differ, which are part of names only.
        let named = read(&format!("{keys}\nkind = \"{kind}\"")).unwrap().contacts[0].law.clone();
        assert_eq!(inferred, named, "{kind}");
        let others = cases.iter().filter(|(other, _)| *other != kind);
        for (other, _) in others.filter(|(other, _)| (*other, kind) != ("compliant", "nearest")) {
            assert!(read(&format!("{keys}\nkind = \"{other}\"")).is_err(), "{keys}: {other}");
        }
    }
}
