//! Codes of failures and warnings on the terminal and in summaries.

use super::support::{Folder, example, lissom, summary};

/// Code in the last line of a message of failure.
fn code_of(errors: &str) -> Option<&str> {
    let line = errors.lines().last()?.trim();
    line.strip_prefix("`lissom explain ")?.strip_suffix("` explains it")
}

/// A command of each kind that fails, and the code of its failure.
const FAILURES: &[(&str, &str)] = &[
    ("run none.toml", "file"),
    ("run bad.toml", "model-file"),
    ("run --resume empty", "checkpoint-missing"),
    ("plot bar.toml", "no-results"),
    ("view out", "several-results"),
    ("plot damaged", "table-line"),
    ("plot out/bar --of none", "plot-column"),
    ("export damaged --format npz", "table-line"),
    ("view empty", "file"),
    ("view empty --initial", "request"),
    ("snapshot bar.toml --out bar.jpg", "request"),
    ("snapshot out/bar --at 1e9", "picture-time"),
    ("import robot.urdf --out robot.toml", "import"),
    ("import none.urdf", "file"),
    (
        "study convergence bar.toml --schemes radau-iia --steps 1e-2 --reference radau-iia:1e-3 --output none",
        "study-output",
    ),
    ("sweep bar.toml", "model-file"),
    ("kinds nonexistent", "request"),
    ("explain nonexistent", "request"),
    ("new bar", "request"),
    ("modes bar.toml --about 99", "linearization-time"),
    ("response bar.toml --by none --of bob --from 1 --to 2", "port-input"),
    ("gradient bar.toml --of none.x --by bodies.bob.mass", "gradient-column"),
    ("man nonexistent", "request"),
];

#[test]
fn every_failure_of_a_command_has_its_code() {
    let folder = Folder::new("codes");
    let model = std::fs::read_to_string(example("pendulum")).unwrap();
    folder.write("bar.toml", &model);
    let run = lissom(&["run", "bar.toml", "--set", "analysis.end=0.01"], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    folder.write("bad.toml", "lissom = 1\nbodys = 1\n");
    folder.write("robot.urdf", "<house/>");
    std::fs::create_dir_all(folder.path().join("empty")).unwrap();
    std::fs::create_dir_all(folder.path().join("damaged")).unwrap();
    folder.write("damaged/history.csv", "time,a\n0,1\n1\n");
    for &(args, code) in FAILURES {
        let args: Vec<&str> = args.split(' ').collect();
        let ended = lissom(&args, folder.path());
        assert_ne!(ended.code, 0, "{args:?}");
        assert_eq!(code_of(&ended.errors), Some(code), "{args:?}: {}", ended.errors);
        assert_eq!(lissom(&["explain", code], folder.path()).code, 0, "{code}");
    }
}

#[test]
fn warnings_of_analyses_have_their_codes() {
    let folder = Folder::new("codes-of-warnings");
    let model = example("pendulum");
    let run = lissom(&["modes", &model, "--count", "50", "--out", "out"], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    let code = "fewer-modes: ";
    assert!(run.errors.contains(&format!("warning: {code}")), "{}", run.errors);
    let facts = summary(&folder.path().join("out"));
    let warnings = facts["warnings"].as_array().unwrap();
    assert!(warnings.iter().any(|warning| warning.as_str().unwrap().starts_with(code)), "{facts}");
    let explained = lissom(&["explain", "out"], folder.path());
    assert!(explained.output.contains("fewer modes than requested"), "{}", explained.output);
}
