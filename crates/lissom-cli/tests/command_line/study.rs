//! `lissom study` as scripts see it: exit codes, tables, files.

use crate::support::{CANTILEVER, Folder, example, lissom, summary};

#[test]
fn convergence_leaves_table_and_plot() {
    let folder = Folder::new("convergence");
    let mut arguments = vec!["study".to_owned(), "convergence".to_owned(), example("pendulum")];
    let schemes = ["--schemes", "radau-iia,hht(-0.3)", "--steps", "2e-2,1e-2", "--output", "bob"];
    let reference = ["--reference", "radau-iia:2e-3", "--set", "analysis.end=0.2", "--out", "tables/c.csv"];
    arguments.extend(schemes.iter().chain(&reference).map(|&word| word.to_owned()));
    let run = lissom(&arguments, folder.path());
    assert_eq!((run.code, run.errors.as_str()), (0, ""));
    assert!(run.output.contains("10 instants up to 0.2 s"), "{}", run.output);
    let csv = std::fs::read_to_string(folder.path().join("tables/c.csv")).unwrap();
    let lines: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(lines[0], ["scheme", "step_size", "error", "order"]);
    let heads: Vec<_> = lines[1..].iter().map(|line| (line[0], line[1], line[3].is_empty())).collect();
    let expected =
        [("radau-iia", "2e-2"), ("radau-iia", "1e-2"), ("hht(-0.3)", "2e-2"), ("hht(-0.3)", "1e-2")];
    assert_eq!(heads, expected.map(|(scheme, step)| (scheme, step, step == "2e-2")));
    for file in ["c.svg", "c.png"] {
        assert!(folder.path().join("tables").join(file).is_file(), "{file}");
    }
}

#[test]
fn a_run_that_fails_is_reported_in_its_row() {
    let folder = Folder::new("convergence-failure");
    // Two iterations are enough for small steps only, and not for the parts of a large one.
    let mut arguments = vec!["study".to_owned(), "convergence".to_owned(), example("pendulum")];
    let runs = ["--schemes", "hht(-0.3)", "--steps", "1,1e-3", "--output", "bob"];
    let limits = ["analysis.end=1", "analysis.max_iterations=2"];
    arguments.extend(runs.iter().map(|&word| word.to_owned()));
    arguments.extend(["--reference", "hht(-0.3):5e-4"].map(str::to_owned));
    arguments.extend(limits.iter().flat_map(|set| ["--set".to_owned(), (*set).to_owned()]));
    let run = lissom(&arguments, folder.path());
    assert_eq!(run.code, 3, "{}", run.errors);
    assert!(run.errors.contains(": hht(-0.3), step_size 1: "), "{}", run.errors);
    let csv = std::fs::read_to_string(folder.path().join("out/study-convergence/pendulum.csv")).unwrap();
    assert!(csv.contains("\nhht(-0.3),1,,\nhht(-0.3),1e-3,"), "{csv}");
}

#[test]
fn mistakes_have_their_exit_codes() {
    let folder = Folder::new("study-mistakes");
    let model = example("pendulum");
    for arguments in [
        &["study", "convergence", &model, "--schemes", "radau-iia", "--steps", "1e-2", "--output", "bob"][..],
        &["study"],
    ] {
        let run = lissom(arguments, folder.path());
        assert_eq!(run.code, 2, "{arguments:?}: {}", run.errors);
    }
    for (schemes, steps, reference, words) in [
        ("newmark", "1e-2", "radau-iia:1e-3", "`newmark` is not a scheme"),
        ("hht(0.5)", "1e-2", "radau-iia:1e-3", "outside"),
        ("radau-iia", "never", "radau-iia:1e-3", "never"),
        ("radau-iia", "1e-2,6e-3", "radau-iia:1e-3", "6e-3 s does not divide the largest"),
        ("radau-iia", "1e-2", "radau-iia:2e-2", "larger than a step"),
        ("radau-iia", "1e-2", "radau-iia", "SCHEME:STEP"),
    ] {
        let arguments = ["study", "convergence", &model, "--output", "bob", "--schemes", schemes];
        let run =
            lissom(&[&arguments[..], &["--steps", steps, "--reference", reference]].concat(), folder.path());
        assert_eq!(run.code, 2, "{schemes} {steps} {reference}: {}", run.errors);
        assert!(run.errors.contains(words), "{words}: {}", run.errors);
    }
    folder.write("bar.toml", CANTILEVER);
    let arguments = ["study", "convergence", "bar.toml", "--output", "bob", "--schemes", "radau-iia"];
    let run = lissom(
        &[&arguments[..], &["--steps", "0.1", "--reference", "radau-iia:0.05"]].concat(),
        folder.path(),
    );
    assert_eq!(run.code, 2, "{}", run.errors);
}

#[test]
fn every_run_reports_how_well_its_tangent_is_conditioned() {
    let folder = Folder::new("telemetry");
    let condition = |name: &str, scaling: &str| {
        let set = format!("analysis.scaling={scaling}");
        let model = example(name);
        let run =
            lissom(&["run", &model, "--set", "analysis.end=0.1", "--set", &set, "--no-plots"], folder.path());
        assert_eq!(run.code, 0, "{}", run.errors);
        let tangent = summary(&folder.path().join("out").join(name))["tangent"].clone();
        for part in ["smallest_relative_pivot", "scale", "penalty"] {
            assert!(tangent[part].as_f64().is_some_and(|value| value > 0.0), "{part}");
        }
        let estimate = |when: &str| tangent["condition_estimate"][when].as_f64().unwrap();
        (estimate("start"), estimate("end"))
    };
    let (start, end) = condition("pendulum", "physical");
    assert!(start < 1e3 && end < 1e3, "{start:e} {end:e}");
    let (start, end) = condition("pendulum", "none");
    assert!(start > 1e8 && end > 1e8, "{start:e} {end:e}");
    let (start, end) = condition("energy", "physical");
    assert!(start > 1.0 && end > 1.0 && start < 1e12 && end < 1e12, "{start:e} {end:e}");
}

#[test]
fn results_of_studies_are_not_overwritten() {
    let folder = Folder::new("study-again");
    let model = example("pendulum");
    let study = |more: &[&str]| {
        let runs =
            ["--schemes", "radau-iia", "--steps", "1e-2", "--reference", "radau-iia:5e-3", "--output", "bob"];
        let arguments = [&["study", "convergence", &model], &runs[..], more].concat();
        lissom(&arguments, folder.path())
    };
    for name in ["pendulum.csv", "pendulum-2.csv", "pendulum-3.csv"] {
        let run = study(&[]);
        assert_eq!(run.code, 0, "{}", run.errors);
        assert!(run.output.contains(&format!("results in out/study-convergence/{name}")), "{}", run.output);
        assert!(folder.path().join("out/study-convergence").join(name).is_file());
    }
    assert_eq!(study(&["--out", "table.csv"]).code, 0);
    let again = study(&["--out", "table.csv"]);
    assert_eq!(again.code, 2);
    assert!(again.errors.contains("not overwritten"), "{}", again.errors);
}

#[test]
fn condition_numbers_of_a_model_are_tabulated_with_their_exponents() {
    let folder = Folder::new("study-conditioning");
    let model = example("pendulum");
    let arguments =
        ["study", "conditioning", &model, "--steps", "1e-2,1e-3,1e-4", "--set", "analysis.end=0.01"];
    let run = lissom(&arguments, folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(run.output.contains("exponent of the step size [s]:  none -4.00  unit 0.00"), "{}", run.output);
    let table = std::fs::read_to_string(folder.path().join("out/study-conditioning/pendulum.csv")).unwrap();
    assert!(table.starts_with("step_size,none,unit,physical,equilibrated\n1e-2,"), "{table}");
    assert_eq!(table.lines().count(), 4);
    assert!(folder.path().join("out/study-conditioning/pendulum.svg").is_file());
    // Over a value of the model, at one step; and with a run that fails.
    let vary = ["--steps", "1e-2", "--vary", "point_masses.bob.mass=1,1e2,1e4"];
    let run = lissom(&[&arguments[..3], &vary[..]].concat(), folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(run.output.contains("exponent of the point_masses.bob.mass:  none 2.0"), "{}", run.output);
    let failing = ["--steps", "1e-2,1e-3", "--set", "analysis.max_iterations=1"];
    let run = lissom(&[&arguments[..3], &failing[..]].concat(), folder.path());
    assert_eq!(run.code, 3, "{}", run.output);
    assert!(run.errors.contains("max_iterations") && run.output.contains("failed"), "{}", run.errors);
}
