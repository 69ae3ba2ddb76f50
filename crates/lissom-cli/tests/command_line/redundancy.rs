//! What the program reports about redundant constraints: redundant everywhere, or at one position.

use super::support::{Ended, Folder, example, lissom, summary};

/// A parallelogram of four revolutes, driven: two bars of length `a`, `l` apart, turned by `a0` at the start.
const PARALLELOGRAM: &str = r#"
lissom = 1

[parameters]
a = 0.3
l = 1.0
a0 = 1.0

[bodies.crank]
mass = 1.0
inertia = [1e-3, 0.02, 0.02]
position = ["0.5*a*cos(a0)", "0.5*a*sin(a0)", 0]

[bodies.coupler]
mass = 2.0
inertia = [1e-3, 0.1, 0.1]
position = ["a*cos(a0)+0.5*l", "a*sin(a0)", 0]

[bodies.rocker]
mass = 1.0
inertia = [1e-3, 0.02, 0.02]
position = ["l+0.5*a*cos(a0)", "0.5*a*sin(a0)", 0]

[joints.A]
kind = "revolute"
base = "ground"
tip = "crank"
at = [0, 0, 0]
axis = [0, 0, 1]

[joints.B]
kind = "revolute"
base = "crank"
tip = "coupler"
at = ["a*cos(a0)", "a*sin(a0)", 0]
axis = [0, 0, 1]

[joints.C]
kind = "revolute"
base = "coupler"
tip = "rocker"
at = ["l+a*cos(a0)", "a*sin(a0)", 0]
axis = [0, 0, 1]

[joints.D]
kind = "revolute"
base = "ground"
tip = "rocker"
at = ["l", 0, 0]
axis = [0, 0, 1]

[joints.drive]
kind = "prescribed_rotation"
joint = "A"
rotation = "6*t"

[outputs.forces]
kind = "reaction"
of = "D"

[outputs.coupler]
kind = "position"
of = "coupler"

[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 1.0
step = 2e-3
"#;

/// A parallelogram's run, and its facts.
fn run(folder: &Folder, set: &[&str]) -> (Ended, serde_json::Value) {
    folder.write("parallelogram.toml", PARALLELOGRAM);
    let set = set.iter().flat_map(|value| ["--set", value]);
    let words: Vec<&str> =
        ["run", "parallelogram.toml", "--out", "out", "--no-plots"].into_iter().chain(set).collect();
    let run = lissom(&words, folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    let facts = summary(&folder.path().join("out"));
    (run, facts)
}

/// The warning of this code in a summary.
fn warning<'a>(facts: &'a serde_json::Value, code: &str) -> Option<&'a str> {
    let all = facts["warnings"].as_array().unwrap().iter().filter_map(serde_json::Value::as_str);
    all.into_iter().find(|words| words.starts_with(code))
}

#[test]
fn repeated_directions_are_reported_in_words_and_reactions_flagged() {
    let folder = Folder::new("redundancy-words");
    let (_, facts) = run(&folder, &["analysis.end=0.01"]);
    let checked = lissom(&["check", "parallelogram.toml"], folder.path());
    assert_eq!(checked.code, 0);
    for words in ["translation along z", "rotation about x", "rotation about y"] {
        let line = format!("of joint `D` follows from `A`, `B`, `C`: it repeats {words}");
        assert!(checked.errors.contains(&line), "{}", checked.errors);
    }
    let columns = facts["columns"].as_array().unwrap();
    let doubtful: Vec<&str> = columns
        .iter()
        .filter(|column| column["unique"] == false)
        .map(|column| column["name"].as_str().unwrap())
        .collect();
    assert_eq!(doubtful, ["forces.f3", "forces.m1", "forces.m2"]);
    let reported = warning(&facts, "reactions-not-unique").unwrap();
    for words in
        ["forces.f3, forces.m1, forces.m2 are", "`D` repeats rotation about y, given by `A`, `B`, `C`"]
    {
        assert!(reported.contains(words), "{reported}");
    }
}

#[test]
fn a_direction_aslant_is_reported_by_its_components() {
    let folder = Folder::new("redundancy-aslant");
    let text = PARALLELOGRAM.replace("axis = [0, 0, 1]", "axis = [0, 0.6, 0.8]");
    // All hinges in the plane of their axes: the loop is one of bars turned about x.
    let turned = text.replace(
        "position = [\"0.5*a*cos(a0)\", \"0.5*a*sin(a0)\", 0]",
        "position = [\"0.5*a*cos(a0)\", \"0.4*a*sin(a0)\", \"-0.3*a*sin(a0)\"]",
    );
    let turned = turned.replace("\"a*sin(a0)\", 0]", "\"0.8*a*sin(a0)\", \"-0.6*a*sin(a0)\"]");
    folder.write("aslant.toml", &turned);
    let checked = lissom(&["check", "aslant.toml"], folder.path());
    assert_eq!(checked.code, 0, "{}", checked.errors);
    assert!(checked.errors.contains("it repeats translation along (0, 0.6, 0.8)"), "{}", checked.errors);
}

#[test]
fn a_dead_position_is_reported_with_its_time_and_joints() {
    let folder = Folder::new("singular");
    // The bars lie in one line at a turn of π.
    let dead = (std::f64::consts::PI - 1.0) / 6.0;
    for (scheme, step) in [
        ("radau-iia", 2e-3),
        ("radau-iia-5", 2e-3),
        ("generalized-alpha", 2e-3),
        ("hht", 2e-2),
        ("energy-decaying", 5e-3),
    ] {
        let set = [format!("analysis.scheme={scheme}"), format!("analysis.step={step}")];
        let (run, facts) = run(&folder, &set.each_ref().map(String::as_str));
        let reported =
            warning(&facts, "singular-position").unwrap_or_else(|| panic!("{scheme}: {}", run.errors));
        assert!(run.errors.contains("singular position"), "{}", run.errors);
        assert!(reported.contains("`A`, `B`, `C`, `D`"), "{reported}");
        let time = reported.split("t = ").nth(1).and_then(|rest| rest.split(' ').next()).unwrap();
        let time: f64 = time.parse().unwrap();
        assert!((time - dead).abs() < 2e-3, "{scheme}: {time} instead of {dead}");
    }
    // Up to shortly before it nothing is reported.
    let (_, facts) = run(&folder, &["analysis.end=0.35", "analysis.step=2e-3"]);
    assert_eq!(warning(&facts, "singular-position"), None);
}

#[test]
fn a_start_in_a_dead_position_is_reported() {
    let folder = Folder::new("singular-start");
    let (_, facts) = run(&folder, &["parameters.a0=3.141592653589793", "analysis.end=0.2"]);
    let reported = warning(&facts, "singular-position").unwrap();
    assert!(reported.contains("at t = 0 s"), "{reported}");
}

#[test]
fn loops_that_only_come_near_are_not_reported() {
    let folder = Folder::new("singular-not");
    for model in ["four-bar", "slider-crank-3500rpm", "delta-robot"] {
        let run = lissom(&["run", &example(model), "--no-plots", "--out", model], folder.path());
        assert_eq!(run.code, 0, "{}", run.errors);
        assert_eq!(warning(&summary(&folder.path().join(model)), "singular-position"), None, "{model}");
    }
}

/// Bennett's linkage moves though its four hinges are neither parallel nor meet: three of its equations repeat the others at
/// every position, not always the same ones, and no position is singular.
#[test]
fn loops_that_repeat_equations_everywhere_are_not_singular() {
    let text = r#"
lissom = 1
[bodies.crank]
mass = 1
inertia = [0.1, 0.1, 0.1]
[bodies.coupler]
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [-0.6, 0, 0.1]
[bodies.rocker]
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [-1, 0, 0]
[joints.A]
kind = "revolute"
base = "ground"
tip = "crank"
at = [0.6216099682706644, 0.7833269096274834, 0]
axis = [0.4422996437289516, -0.3509873899713574, 0.8253356149096783]
[joints.B]
kind = "revolute"
base = "crank"
tip = "coupler"
at = [-0.6277174189495001, -0.14074973093745313, 0.27653939311451]
axis = [-0.17520713350995581, 0.492067729423123, 0.8527436953901194]
[joints.C]
kind = "revolute"
base = "coupler"
tip = "rocker"
at = [-1.5783569285938728, 0, 0]
axis = [0, 0.8912073600614354, 0.45359612142557737]
[joints.D]
kind = "revolute"
base = "ground"
tip = "rocker"
at = [0, 0, 0]
axis = [0, 0, 1]
[joints.drive]
kind = "prescribed_rotation"
joint = "A"
rotation = "t"
[analysis]
kind = "dynamics"
end = 6.283185307179586
step = 0.01
"#;
    let folder = Folder::new("singular-bennett");
    folder.write("bennett.toml", text);
    let run = lissom(&["run", "bennett.toml", "--no-plots", "--out", "out"], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    assert_eq!(warning(&summary(&folder.path().join("out")), "singular-position"), None, "{}", run.errors);
}
