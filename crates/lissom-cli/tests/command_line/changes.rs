//! What is changed in a model from the command line: values put in, values omitted, and what is too large to be run.

use std::fmt::Write;

use crate::support::{CANTILEVER, Folder, example, lissom, summary};

#[test]
fn what_is_unset_counts_as_never_written() {
    let folder = Folder::new("unset");
    let run = |further: &[&str]| {
        let pendulum = example("pendulum");
        let mut args = vec!["run", &pendulum, "--no-plots", "--quiet", "--set", "analysis.end=0.05"];
        args.extend(further);
        lissom(&args, folder.path())
    };
    // Without a step, steps are chosen by their error, and by another scheme.
    let ended = run(&[
        "--unset",
        "analysis.step",
        "--unset",
        "analysis.scheme",
        "--unset",
        "analysis.spectral_radius",
    ]);
    assert_eq!((ended.code, ended.errors.as_str()), (0, ""));
    let facts = summary(&folder.path().join("out/pendulum"));
    assert_eq!(
        facts["unset"],
        serde_json::json!(["analysis.step", "analysis.scheme", "analysis.spectral_radius"])
    );
    assert_eq!(facts["planned_steps"], serde_json::Value::Null);
    assert!(
        facts["scheme"].as_str().is_some_and(|scheme| scheme.starts_with("radau")),
        "{}",
        facts["scheme"]
    );
    // Whole entries can be omitted; references to them are reported.
    assert_eq!(run(&["--unset", "outputs.force"]).code, 0);
    let ended = run(&["--unset", "joints.leg"]);
    assert!(ended.code == 2 && ended.errors.contains("no `leg` here"), "{}", ended.errors);
    let check = lissom(&["check", &example("pendulum"), "--unset", "point_masses.bob.mass"], folder.path());
    assert!(check.code == 2 && check.errors.contains("mass"), "{}", check.errors);
}

#[test]
fn another_scheme_takes_no_parameters_of_the_former_one() {
    let folder = Folder::new("another-scheme");
    let run = |sets: &[&str]| {
        let model = example("four-bar");
        let mut args = vec!["check", &model];
        args.extend(sets.iter().flat_map(|set| ["--set", *set]));
        lissom(&args, folder.path())
    };
    // The file has HHT with its α.
    let ended = run(&["analysis.scheme=radau-iia"]);
    assert_eq!((ended.code, ended.errors.as_str()), (0, ""));
    assert_eq!(run(&["analysis.scheme=generalized-alpha", "analysis.spectral_radius=0.5"]).code, 0);
    // A request on the command line is not ignored silently.
    let ended = run(&["analysis.scheme=radau-iia", "analysis.alpha=-0.2"]);
    assert!(ended.code == 2 && ended.errors.contains("no parameter `alpha`"), "{}", ended.errors);
    assert_eq!(run(&["analysis.spectral_radius=0.5"]).code, 2);
}

#[test]
fn what_is_too_large_is_refused_with_an_estimate_before_it_is_built() {
    let folder = Folder::new("too-large");
    folder.write("cantilever.toml", CANTILEVER);
    let refused = |model: &str, sets: &[&str], words: &[&str]| {
        for command in ["run", "check"] {
            let mut args = vec![command, model];
            args.extend(sets.iter().flat_map(|set| ["--set", *set]));
            let ended = lissom(&args, folder.path());
            assert_eq!(ended.code, 2, "{sets:?}: {}", ended.errors);
            assert!(words.iter().all(|word| ended.errors.contains(word)), "{sets:?}: {}", ended.errors);
        }
    };
    let many = ["beams.bar.elements=1000000000"];
    refused("cantilever.toml", &many, &["`elements` of beam `bar`", "from 1 to 100000"]);
    let pendulum = example("pendulum");
    refused(&pendulum, &["analysis.end=1", "analysis.step=1e-12"], &["steps", "hours", "larger `step`"]);
    refused(
        &pendulum,
        &["analysis.end=1", "analysis.step=1e-9"],
        &["rows of results", "GB", "`output_every`"],
    );
    let both = ["analysis.relative_tolerance=1e-5", "analysis.output_step=0.1", "analysis.output_every=2"];
    refused(&pendulum, &both, &["both `output_step` and `output_every`", "remove one"]);
    assert!(!folder.path().join("out").exists());
}

#[test]
fn of_thousands_of_mistakes_the_first_are_shown_and_the_rest_counted() {
    let folder = Folder::new("mistakes");
    let mut text = String::from("lissom = 1\n[analysis]\nkind = \"statics\"\n");
    for body in 0..8000 {
        writeln!(text, "[bodies.part{body}]\nmas = 1").unwrap();
    }
    folder.write("model.toml", &text);
    let ended = lissom(&["check", "model.toml"], folder.path());
    assert_eq!(ended.code, 2);
    let last = ended.errors.lines().rfind(|line| line.contains("more")).unwrap_or_default();
    assert!(last.contains("and ") && ended.errors.lines().count() < 1000, "{last}");
    assert!(ended.errors.contains("model.toml: "), "{last}");
}
