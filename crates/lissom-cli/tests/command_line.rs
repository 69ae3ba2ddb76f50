//! The program, as scripts see it: exit codes, files, columns and facts.

use crate::support;
use crate::support::truss;

mod accumulated;
mod assembly;
mod changes;
mod codes;
mod data_file;
mod determinism;
mod exchange_units;
mod export;
mod failures;
mod files;
mod fmu;
mod live;
mod modes;
mod motion;
mod new;
mod outputs;
mod page_fields;
mod parts;
mod path;
mod plot;
mod redundancy;
mod shell_pictures;
mod silent;
mod snapshot;
mod statics;
mod study;
mod sweep;
mod units;
mod view;

use std::path::Path;

use lissom::Record;
use support::{CANTILEVER, Folder, Run, example, lissom, summary};

#[test]
fn a_run_leaves_table_summary_and_plots() {
    let folder = Folder::new("files");
    let model = example("pendulum");
    let run = lissom(&["run", &model, "--set", "analysis.end=0.05"], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    // The default folder lies below the current one.
    let out = folder.path().join("out/pendulum");
    for file in ["history.csv", "summary.json", "bob.svg", "bob.png", "arm.svg", "force.png", "energy.svg"] {
        assert!(out.join(file).is_file(), "{file}");
    }
    let lines = run.output.lines().count();
    assert!((3..=8).contains(&lines) && run.output.contains("out/pendulum"), "{}", run.output);
    assert_eq!(run.errors, "", "no progress in a pipe");

    let facts = summary(&out);
    for name in [
        "model",
        "title",
        "version",
        "scheme",
        "step_size",
        "steps",
        "rejected_steps",
        "newton_iterations",
        "factorizations",
        "wall_seconds",
        "solve_seconds",
        "max_constraint_violation",
        "max_carried_violation",
        "solver",
        "unknowns",
        "bodies",
        "joints",
        "multipliers",
        "factor_entries",
        "smallest_relative_pivot",
        "stagnated_steps",
        "warnings",
    ] {
        assert!(facts.get(name).is_some_and(|fact| !fact.is_null()), "{name}");
    }
    for (name, parts) in [
        ("energy", &["start", "end", "largest_change"][..]),
        ("scaling", &["by", "augmented", "penalty", "scale"]),
        ("representative", &["mass", "damping", "stiffness", "length"]),
    ] {
        assert!(parts.iter().all(|part| !facts[name][*part].is_null()), "{name}");
    }
    for part in ["kinetic", "strain", "potential", "total"] {
        assert!(facts["energy"]["start"][part].is_number() && facts["energy"]["end"][part].is_number());
    }
    assert_eq!(facts["stopped"], "end");
    assert_eq!(facts["steps"], 5);
    assert_eq!(facts["unknowns"], 5);
    assert_eq!(facts["time"], 0.05);
    assert!(facts["max_constraint_violation"].as_f64().unwrap() < 1e-6);
}

#[test]
fn columns_are_named_as_promised() {
    let folder = Folder::new("columns");
    let args = ["run", &example("tip-crank"), "--set", "analysis.end=1e-3", "--no-plots", "--out", "here"];
    assert_eq!(lissom(&args, folder.path()).code, 0);
    let out = folder.path().join("here");
    let text = std::fs::read_to_string(out.join("history.csv")).unwrap();
    let heading = text.lines().next().unwrap();
    assert!(heading.starts_with("time,midspan.u1,midspan.u2,midspan.u3,tip.u1,"), "{heading}");
    assert!(heading.contains("root.f1,root.f2,root.f3,root.m1,root.m2,root.m3,drive.moment,energy.kinetic,"));
    assert_eq!(text.lines().count(), 4);
    assert!(!out.join("midspan.svg").exists(), "no plots were wanted");
}

#[test]
fn rows_come_every_so_often_and_at_the_last_step() {
    let folder = Folder::new("rows");
    let times = |overrides: &[&str]| {
        let mut args = vec!["run".to_owned(), example("pendulum"), "--no-plots".into(), "--quiet".into()];
        args.extend(overrides.iter().flat_map(|set| ["--set".to_owned(), (*set).to_owned()]));
        let run = lissom(&args, folder.path());
        assert_eq!((run.code, run.output.as_str(), run.errors.as_str()), (0, "", ""));
        history(&folder.path().join("out/pendulum")).times
    };
    assert_eq!(times(&["analysis.end=0.05"]), [0.0, 0.01, 0.02, 0.03, 0.04, 0.05]);
    // Seven steps, the last of them shorter.
    assert_eq!(times(&["analysis.end=0.065", "analysis.output_every=3"]), [0.0, 0.03, 0.06, 0.065]);
    assert_eq!(times(&["analysis.end=0.3", "analysis.step=0.1"]).last(), Some(&0.3));
    // Adaptive steps, each with several rows by default.
    let adaptive = ["analysis.end=1", "analysis.relative_tolerance=1e-6", "analysis.scheme=\"radau-iia-5\""];
    let sampled = times(&adaptive).len();
    let ends = times(&[&adaptive[..], &["analysis.output_every=1"]].concat()).len();
    assert!(sampled > 2 * ends, "{sampled} rows, {ends} at ends of steps");
}

#[test]
fn what_is_set_is_used() {
    let folder = Folder::new("set");
    let run = |set: &str| {
        let args = ["run", &example("pendulum"), "--no-plots", "--set", "analysis.end=0.1", "--set", set];
        assert_eq!(lissom(&args, folder.path()).code, 0);
        let out = folder.path().join("out/pendulum");
        (summary(&out), history(&out))
    };
    let (facts, record) = run("analysis.step=0.02");
    assert_eq!((&facts["step_size"], &facts["steps"]), (&0.02.into(), &5.into()));
    assert_eq!(facts["set"]["analysis.step"], "0.02");
    let (_, heavier) = run("point_masses.bob.mass=4");
    assert_eq!(heavier.column("energy", "kinetic").unwrap()[0], 2.0);
    assert_eq!(record.column("energy", "kinetic").unwrap()[0], 0.5);
}

#[test]
fn wrong_models_and_command_lines_end_with_2() {
    let folder = Folder::new("bad");
    let pendulum = example("pendulum");
    let ends_with_2 = |args: &[&str], words: &str| {
        let run = lissom(args, folder.path());
        assert_eq!(run.code, 2, "{args:?}: {}", run.errors);
        assert!(run.errors.contains(words), "{args:?}: {}", run.errors);
    };
    ends_with_2(&[], "Usage");
    ends_with_2(&["fly"], "fly");
    ends_with_2(&["run", &pendulum, "--set", "analysis.step"], "PATH=VALUE");
    ends_with_2(&["run", &pendulum, "--set", "analysis.stepp=1"], "stepp");
    ends_with_2(&["run", &pendulum, "--set", "analysis.step=-1"], "step");
    ends_with_2(&["check", &pendulum, "--set", "springs.spring.joint=\"leg\""], "leg");
    ends_with_2(&["run", "nothing.toml"], "nothing.toml");
    ends_with_2(&["check", "nothing.toml"], "no such file");
    ends_with_2(&["plot", "nothing"], "no such file");
    folder.write("broken.toml", "lissom = 1\n[bodies.a\n");
    ends_with_2(&["run", "broken.toml"], "broken.toml");
    assert!(!folder.path().join("out").exists(), "a wrong model leaves no results");
}

#[test]
fn results_before_a_failure_survive() {
    let folder = Folder::new("failure");
    // From 0.05 s on the crank is thrown round.
    let args = [
        "run",
        &example("four-bar"),
        "--set",
        "analysis.end=0.1",
        "--set",
        "joints.drive.rotation=\"5*t^2 + 1e7*max(t-0.05, 0)^3\"",
        "--set",
        "analysis.output_every=4",
    ];
    let run = lissom(&args, folder.path());
    assert_eq!(run.code, 3, "{}", run.errors);
    assert!(run.errors.contains(" t = ") && run.errors.contains("out/four-bar"), "{}", run.errors);
    let out = folder.path().join("out/four-bar");
    let facts = summary(&out);
    assert_eq!(facts["stopped"], "failed");
    assert!(facts["error"].as_str().unwrap().contains(" t = "));
    let reached = facts["time"].as_f64().unwrap();
    assert!(reached > 0.02 && reached < 0.1, "{reached}");
    let record = history(&out);
    assert_eq!(record.times.last(), Some(&reached), "the last good step is there");
    assert!(out.join("C.png").is_file());

    // No step at all: the start is there.
    let args = ["run", &example("pendulum"), "--set", "analysis.max_iterations=1", "--quiet"];
    let run = lissom(&args, folder.path());
    assert_eq!((run.code, run.output.as_str()), (3, ""));
    assert!(run.errors.contains("max_iterations"), "{}", run.errors);
    let out = folder.path().join("out/pendulum");
    assert_eq!(history(&out).times, [0.0]);
    assert_eq!(summary(&out)["steps"], 0);
}

#[test]
fn a_pendulum_swings_with_every_scheme_solver_and_scaling() {
    let folder = Folder::new("every");
    let registry = lissom::model::lower::registry::registry();
    let schemes = registry.schemes.iter().map(|entry| entry.name);
    let solvers = registry.solvers.iter().map(|entry| entry.name);
    let mut sets: Vec<Vec<String>> = Vec::new();
    for scheme in schemes {
        // The model's own parameter belongs to its own scheme.
        let mut text = std::fs::read_to_string(example("pendulum")).unwrap();
        text = text.replace("spectral_radius = 0.8\n", "");
        folder.write(&format!("{scheme}.toml"), &text.replace("generalized-alpha", scheme));
        let mut set = vec![format!("{scheme}.toml")];
        if scheme == "backward-euler" {
            set.push("analysis.step=1e-5".into());
        }
        sets.push(set);
    }
    sets.extend(solvers.map(|solver| vec!["radau-iia.toml".into(), format!("analysis.solver={solver}")]));
    for scaling in ["physical", "unit", "none"] {
        sets.push(vec!["radau-iia.toml".into(), format!("analysis.scaling={scaling}")]);
    }
    let mut places = Vec::new();
    for set in &sets {
        let mut args =
            vec!["run", &*set[0], "--quiet", "--no-plots", "--out", "out", "--set", "analysis.end=0.5"];
        args.extend(set[1..].iter().flat_map(|set| ["--set", set.as_str()]));
        let run = lissom(&args, folder.path());
        assert_eq!(run.code, 0, "{set:?}: {}", run.errors);
        let record = history(&folder.path().join("out"));
        places.push(*record.column("bob", "x").unwrap().last().unwrap());
    }
    assert!(places.len() >= 9);
    // Second-order schemes at 0.01 s are close to the third-order one, and that of first order with shorter steps.
    assert!(places.iter().all(|place| (place - places[0]).abs() < 1e-4), "{places:?}");
}

#[test]
fn a_vanishing_pivot_is_reported_and_a_pivoting_solver_goes_on() {
    let folder = Folder::new("pivot");
    let model = example("tip-crank");
    let run = lissom(
        &["run", &model, "--no-plots", "--set", "analysis.augmented=false", "--set", "analysis.end=2e-3"],
        folder.path(),
    );
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(run.output.contains("continued with the pivoting solver"), "{}", run.output);
    let facts = summary(&folder.path().join("out/tip-crank"));
    assert_eq!(facts["fell_back_at"], "multiplier of joint `G` (rotation 3)");
}

#[test]
fn the_strict_solver_shows_where_elimination_without_help_fails() {
    let folder = Folder::new("strict");
    let model = example("tip-crank");
    let run = |solver: &str, more: &[&str]| {
        let solver = format!("analysis.solver={solver}");
        let mut args = vec!["run", &model, "--no-plots", "--set", "analysis.end=2e-3", "--set", &solver];
        args.extend(more.iter().flat_map(|set| ["--set", *set]));
        lissom(&args, folder.path())
    };
    // Without the augmented term: the first tangent, its multiplier, the reason and the remedy.
    let plain = run("strict", &["analysis.augmented=false"]);
    assert_eq!(plain.code, 3, "{}", plain.output);
    for words in [
        "t = 0.0005 s",
        "multiplier of joint `G` (rotation 3)",
        "does not depend on others",
        "augmented = true",
    ] {
        assert!(plain.errors.contains(words), "{}", plain.errors);
    }
    let out = folder.path().join("out/tip-crank");
    assert_eq!(summary(&out)["steps"], 0);
    // With it, but unscaled: factors and converges with a condition number of 2e19, until its weight is round-off of a pivot.
    let unscaled = run("strict", &["analysis.scaling=none"]);
    assert_eq!(unscaled.code, 0, "{}", unscaled.errors);
    assert!(summary(&out)["smallest_relative_pivot"].as_f64().unwrap() < 1e-18, "{}", unscaled.output);
    let light = ["analysis.scaling=none", "analysis.penalty=1e-9"];
    let lost = run("strict", &light);
    assert_eq!(lost.code, 3, "{}", lost.output);
    for words in
        ["multiplier of joint `G` (rotation 3)", "which is their round-off", "scaling = \"physical\""]
    {
        assert!(lost.errors.contains(words), "{}", lost.errors);
    }
    // Scaled and augmented it needs no help; nor does the same weight.
    for penalty in ["1e-3", "1e-9"] {
        let scaled = run("strict", &[&format!("analysis.penalty={penalty}")]);
        assert_eq!(scaled.code, 0, "{}", scaled.errors);
    }
    // An ordinary run exchanges rows, and does not take a pivot that round-off has taken for a redundant constraint.
    let repaired = run("sparse", &light);
    assert_eq!(repaired.code, 0, "{}", repaired.errors);
    assert!(repaired.output.contains("continued with the pivoting solver"), "{}", repaired.output);
    assert!(!repaired.output.contains("redundant"), "{}", repaired.output);
}

#[test]
fn the_strict_solver_stops_at_redundant_constraints() {
    let folder = Folder::new("strict-redundant");
    let text = std::fs::read_to_string(example("top")).unwrap();
    let twice = "\n[joints.twin]\nkind = \"spherical\"\nbase = \"ground\"\ntip = \"top\"\nat = [0, 0, 0]\n";
    folder.write("twice.toml", &(text + twice));
    let run = |solver: &str| {
        lissom(
            &["run", "twice.toml", "--no-plots", "--set", &format!("analysis.solver={solver}")],
            folder.path(),
        )
    };
    assert_eq!(run("sparse").code, 0);
    let strict = run("strict");
    assert_eq!(strict.code, 3, "{}", strict.output);
    assert!(strict.errors.contains("redundant with those of other joints"), "{}", strict.errors);
}

#[test]
fn load_steps_lead_to_the_bent_cantilever() {
    let folder = Folder::new("statics");
    folder.write("cantilever.toml", CANTILEVER);
    let run = lissom(&["run", "cantilever.toml", "--no-plots", "--out", "."], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    let record = history(folder.path());
    assert_eq!(record.times, [0.0, 0.25, 0.5, 0.75, 1.0]);
    let tip = record.column("tip", "u3").unwrap();
    // F L³ / 3 EI + F L / GA
    let wanted = 3.0 / (3.0 * 200.0) + 3.0 / 4e5;
    assert!((tip[4] - wanted).abs() < 1e-4 * wanted, "{tip:?}");
    let root = record.column("root", "f3").unwrap();
    assert!((root[4].abs() - 3.0).abs() < 1e-6, "{root:?}");
    assert_eq!(summary(folder.path())["rejected_steps"], 0);
}

#[test]
fn load_steps_that_fail_are_halved_and_their_ends_still_met() {
    let folder = Folder::new("halves");
    folder.write("cantilever.toml", CANTILEVER);
    let hard = |iterations: u32| {
        let limit = format!("analysis.max_iterations={iterations}");
        let args = [
            "run",
            "cantilever.toml",
            "--no-plots",
            "--out",
            ".",
            "--set",
            "loads.tip.scale=\"3000*t\"",
            "--set",
            "analysis.steps=2",
            "--set",
            &limit,
        ];
        lissom(&args, folder.path())
    };
    let run = hard(60);
    assert_eq!(run.code, 0, "{}", run.errors);
    let easy = history(folder.path()).column("tip", "u3").unwrap().to_vec();
    let run = hard(5);
    assert_eq!(run.code, 0, "{}", run.errors);
    let facts = summary(folder.path());
    assert!(facts["rejected_steps"].as_u64().unwrap() > 0 && facts["steps"].as_u64().unwrap() > 2, "{facts}");
    let record = history(folder.path());
    assert_eq!(record.times, [0.0, 0.5, 1.0]);
    let tip = record.column("tip", "u3").unwrap();
    assert!((tip[2] - easy[2]).abs() < 1e-6, "{tip:?} {easy:?}");
    // One iteration is never enough: twelve halvings, then the end.
    let run = hard(1);
    assert_eq!(run.code, 3);
    assert_eq!(summary(folder.path())["rejected_steps"], 12);
}

#[test]
fn check_counts_freedoms_and_names_redundant_constraints() {
    let folder = Folder::new("check");
    let run = lissom(&["check", &example("pendulum")], folder.path());
    assert_eq!((run.code, run.errors.as_str()), (0, ""));
    for words in ["1 point mass", "5: 3 coordinates (1 algebraic), 2 multipliers", "1: 3 coordinates less 2"]
    {
        assert!(run.output.contains(words), "{}", run.output);
    }
    let text = std::fs::read_to_string(example("top")).unwrap();
    let twice = "\n[joints.twin]\nkind = \"spherical\"\nbase = \"ground\"\ntip = \"top\"\nat = [0, 0, 0]\n";
    folder.write("twice.toml", &(text + twice));
    let run = lissom(&["check", "twice.toml"], folder.path());
    assert_eq!(run.code, 0);
    assert_eq!(run.errors.matches("warning: redundant-constraint: ").count(), 3, "{}", run.errors);
    assert!(run.errors.contains("of joint `twin` follows from `pivot`"), "{}", run.errors);
    assert!(!folder.path().join("out").exists());
    // It runs, with the least forces that hold it, and says so.
    let run = lissom(&["run", "twice.toml", "--set", "analysis.end=0.01"], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(run.output.contains("joint `twin`"), "{}", run.output);
    let facts = summary(&folder.path().join("out/twice"));
    assert!(facts["yielded_at"].as_str().unwrap().contains("joint `twin`"));
}

#[test]
fn schema_kinds_and_version_are_reported() {
    let folder = Folder::new("reported");
    let run = lissom(&["schema"], folder.path());
    let schema: serde_json::Value = serde_json::from_str(&run.output).unwrap();
    assert_eq!(schema["title"], "Lissom model");
    let run = lissom(&["--version"], folder.path());
    assert_eq!(run.output.trim(), format!("lissom {}", lissom::VERSION));
    for args in [&["--help"][..], &["run", "--help"], &["check", "--help"], &["plot", "--help"]] {
        let run = lissom(args, folder.path());
        assert!(run.code == 0 && run.output.contains("Example"), "{args:?}");
    }
    assert_eq!(lissom(&["kinds", "nonsense"], folder.path()).code, 2);
}

/// What `lissom kinds` shows can be pasted into a model.
#[test]
fn samples_of_kinds_are_good_models() {
    const PARTS: &str = "lissom = 1\ninputs.my_input = 0\n\
        [bodies.my_body]\nmass = 1\ninertia = [1, 1, 1]\nposition = [1, 0, -1]\n\
        [joints.my_hinge]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"my_body\"\naxis = [1, 0, 0]\n\
        [bodies.my_slider]\nmass = 1\ninertia = [1, 1, 1]\nposition = [1, 0, -1]\n\
        [joints.my_slide]\nkind = \"prismatic\"\nbase = \"ground\"\ntip = \"my_slider\"\naxis = [1, 0, 0]\n\
        [sections.my_section]\nshape = \"general\"\nstiffness = [1e6, 1e6, 1e6, 1e3, 1e3, 1e3]\n\
        mass = { per_length = 1, inertia = [2e-3, 1e-3, 1e-3] }\n\
        [beams.my_beam]\nsection = \"my_section\"\nfrom = [0, 0, -1]\nto = [2, 0, -1]\nelements = 4\n\
        [materials.my_material]\nE = 1e9\nnu = 0.3\ndensity = 1000\n\
        [solids.my_solid]\nsize = [1, 1, 1]\ndivisions = [1, 1, 1]\nmaterial = \"my_material\"\n\
        [joints.my_wall]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"my_beam.start\"\n\
        [analysis]\nkind = \"dynamics\"\nend = 1\nstep = 0.1\n";
    let folder = Folder::new("samples");
    let run = lissom(&["kinds", "all"], folder.path());
    let mut samples: Vec<String> = Vec::new();
    let mut inside = false;
    for line in run.output.lines() {
        if let Some(heading) = line.strip_prefix("    sample ") {
            samples.push(heading.trim().to_owned() + "\n");
            inside = true;
        } else if let Some(entry) = line.strip_prefix("                ").filter(|_| inside) {
            samples.last_mut().unwrap().extend([entry, "\n"]);
        } else {
            inside = false;
        }
    }
    assert!(samples.len() >= 12, "{}", run.output);
    for sample in samples {
        folder.write("sample.toml", &format!("{PARTS}{sample}"));
        let run = lissom(&["check", "sample.toml"], folder.path());
        assert_eq!(run.code, 0, "{sample}{}", run.errors);
    }
    for entry in lissom::model::lower::registry::registry().schemes {
        assert!(run.output.contains(entry.summary));
    }
}

#[test]
fn plots_are_drawn_anew_from_the_table() {
    let folder = Folder::new("plot");
    let args = ["run", &example("pendulum"), "--set", "analysis.end=0.05", "--out", "out", "-q"];
    assert_eq!(lissom(&args, folder.path()).code, 0);
    let figure = folder.path().join("out/force.svg");
    let drawn = std::fs::read(&figure).unwrap();
    std::fs::remove_file(&figure).unwrap();
    assert_eq!(lissom(&["plot", "out"], folder.path()).code, 0);
    assert!(std::fs::read(&figure).unwrap() == drawn, "the same drawing, units and title included");
}

/// A first Ctrl-C ends the run after the step and keeps what there is.
#[cfg(unix)]
#[test]
fn ctrl_c_keeps_the_results() {
    let folder = Folder::new("interrupt");
    let sets = ["analysis.end=1e6", "analysis.output_every=1000"].map(|set| ["--set", set]).concat();
    let mut running =
        Run::start(&[&["run", &example("pendulum"), "--out", "."], &sets[..]].concat(), folder.path());
    let history_file = folder.path().join("history.csv");
    support::wait_for(|| std::fs::metadata(&history_file).is_ok_and(|file| file.len() > 1000));
    running.interrupt();
    let run = running.finish();
    assert_eq!(run.code, 130, "{}", run.errors);
    assert!(run.errors.contains("interrupted: results up to t ="), "{}", run.errors);
    let facts = summary(folder.path());
    assert_eq!(facts["stopped"], "interrupted");
    let record = history(folder.path());
    assert_eq!(record.times.last().copied(), facts["time"].as_f64());
    assert!(folder.path().join("bob.png").is_file());
}

fn history(folder: &Path) -> Record {
    let text = std::fs::read_to_string(folder.join("history.csv")).unwrap();
    assert!(text.ends_with('\n'), "complete lines only");
    Record::from_csv(&text).unwrap()
}
