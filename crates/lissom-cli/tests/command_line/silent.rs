//! Models that once ended with a wrong answer and exit code 0, or cost far too much: each is rejected, warned about, or right.

use std::path::Path;
use std::time::{Duration, Instant};

use crate::support::{self, Ended, Folder, Run, lissom, summary};

fn model(name: &str) -> String {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/command_line/silent").join(format!("{name}.toml"));
    path.to_str().expect("a path is a text").to_owned()
}

/// Runs a model without plots, reporting only warnings and errors.
fn run(name: &str, folder: &Folder) -> Ended {
    lissom(&["run", &model(name), "--out", "out", "--no-plots", "--quiet"], folder.path())
}

/// The run and its check are rejected with these words.
fn refused(name: &str, code: i32, words: &[&str]) {
    let folder = Folder::new(name);
    let run = run(name, &folder);
    assert_eq!(run.code, code, "{name}: {}", run.errors);
    for word in words {
        assert!(run.errors.contains(word), "{name} lacks `{word}`: {}", run.errors);
    }
    let check = lissom(&["check", &model(name)], folder.path());
    assert_eq!(check.code, 2, "{name}: what a run rejects at its start, the check rejects: {}", check.errors);
}

/// The run fails on the way with these words.
fn fails(name: &str, words: &[&str]) {
    let folder = Folder::new(name);
    let run = run(name, &folder);
    assert_eq!(run.code, 3, "{name}: {}", run.errors);
    for word in words {
        assert!(run.errors.contains(word), "{name} lacks `{word}`: {}", run.errors);
    }
}

/// The run ends well, with a warning of this code that has these words, on the terminal and in the summary.
fn warned(name: &str, code: &str, words: &[&str]) {
    let folder = Folder::new(name);
    let run = run(name, &folder);
    assert_eq!(run.code, 0, "{name}: {}", run.errors);
    let facts = summary(&folder.path().join("out"));
    let warnings: Vec<&str> =
        facts["warnings"].as_array().unwrap().iter().map(|w| w.as_str().unwrap()).collect();
    let warning = warnings.iter().find(|warning| warning.starts_with(&format!("{code}: ")));
    let warning = warning.unwrap_or_else(|| panic!("{name}: {warnings:?}"));
    for word in words {
        assert!(warning.contains(word), "{name} lacks `{word}`: {warning}");
        assert!(run.errors.contains(word), "{name}: the terminal lacks `{word}`: {}", run.errors);
    }
}

/// Facts of a run that ends well, without a warning.
fn right(name: &str) -> serde_json::Value {
    let folder = Folder::new(name);
    let run = run(name, &folder);
    assert_eq!(run.code, 0, "{name}: {}", run.errors);
    let facts = summary(&folder.path().join("out"));
    assert_eq!(facts["warnings"], serde_json::json!([]), "{name}");
    facts
}

fn last_row(folder: &Folder) -> Vec<f64> {
    let text = std::fs::read_to_string(folder.path().join("out/history.csv")).unwrap();
    text.lines().last().unwrap().split(',').map(|value| value.parse().unwrap()).collect()
}

#[test]
fn what_is_hardly_meant_is_reported_in_quiet_runs_too() {
    let folder = Folder::new("inertia-of-no-body");
    let run = run("inertia-of-no-body", &folder);
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(run.errors.contains("belongs to no body"), "{}", run.errors);
}

#[test]
fn expressions_without_a_number_are_reported() {
    warned("output-never-finite", "never-finite", &["`depth` is not finite at any record"]);
    // One that is a number at first is data.
    let folder = Folder::new("output-never-finite");
    let run = run("output-never-finite", &folder);
    assert!(!run.errors.contains("`late`"), "{}", run.errors);
}

#[test]
fn positions_without_a_square_are_refused() {
    refused("far-position", 2, &["`position` of body `a` has the number 1e300", "in m"]);
}

#[test]
fn lists_of_heights_have_a_limit() {
    let folder = Folder::new("road-of-lists");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/command_line/failures/road-not-finite.toml");
    let text = std::fs::read_to_string(path).unwrap();
    for road in [format!("[{}]", "0, ".repeat(17)), "[0, [0]]".to_owned()] {
        folder.write("m.toml", &text.replace("\"sqrt(x - 5)\"", &road));
        let run = lissom(&["run", "m.toml", "--quiet"], folder.path());
        assert_eq!(run.code, 2, "{road}: {}", run.errors);
        assert!(
            run.errors.contains("is a list of more than 16 heights, or of lists"),
            "{road}: {}",
            run.errors
        );
    }
}

#[test]
fn contradicting_constraints_are_refused_by_name() {
    refused("contradicting-drives", 3, &["`d1` (rotation)", "`d2` (rotation)", "contradict each other"]);
    refused("drive-beyond-reach", 3, &["`S`", "`A`", "contradict each other"]);
}

#[test]
fn a_drive_that_asks_for_more_than_the_links_reach_fails_on_the_way() {
    // The links of 1 m are at a right angle: the slider, at 1.414 m, is pulled beyond 2 m.
    let folder = Folder::new("reach");
    let text = std::fs::read_to_string(model("drive-beyond-reach")).unwrap();
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let text = text
        .replace("position=[0.5, 0.0, 0]", &format!("position=[{}, {}, 0]", half / 2.0, half / 2.0))
        .replace("position=[1.5, 0.0, 0]", &format!("position=[{}, {}, 0]", 1.5 * half, half / 2.0))
        .replace("position=[2, 0, 0]", &format!("position=[{}, 0, 0]", 2.0 * half))
        .replace("at=[1, 0, 0]", &format!("at=[{half}, {half}, 0]"))
        .replace("at=[2, 0, 0]", &format!("at=[{}, 0, 0]", 2.0 * half))
        .replace("0.5*t", "t");
    std::fs::write(folder.path().join("reach.toml"), text).unwrap();
    let run = lissom(&["run", "reach.toml", "--out", "out", "--no-plots", "--quiet"], folder.path());
    assert_eq!(run.code, 3, "{}", run.errors);
    let time = last_row(&folder)[0];
    assert!((0.57..0.59).contains(&time), "the links are straight at 0.5858 s, it ended at {time}");
}

#[test]
fn drives_start_where_their_joints_are() {
    refused(
        "drive-jumps-at-start",
        2,
        &["`d1` starts at 0.5 rad", "its joint is at 0 rad", "let it start at 0"],
    );
    refused("prescribed-offset", 2, &["`d` starts at 0.5 rad"]);
}

#[test]
fn given_velocities_that_are_replaced_are_reported() {
    warned(
        "given-velocity-replaced",
        "velocity-replaced",
        &["`top`", "(0.000000, 150.000000, -4.615380)", "133.56"],
    );
    warned("silent-velocity-jump", "starts-with-jolt", &["rod", "bends it"]);
}

#[test]
fn beams_that_turn_too_far_within_an_element_fail() {
    fails(
        "twist-wraps",
        &["beam element between `c.start` and `c@0.2500`", "half a revolution", "use more elements"],
    );
}

#[test]
fn energy_from_nowhere_is_reported_or_fails() {
    // The motion is chaos: how much energy the steps make, and so whether the run fails, depends on the last digits.
    let folder = Folder::new("mass-ratio-energy");
    let reported = run("mass-ratio-energy", &folder);
    assert!(reported.code == 3 || reported.code == 0, "{}", reported.errors);
    for word in ["energy exceeds the work of loads and drives", "relative_tolerance"] {
        assert!(reported.errors.contains(word), "{word}: {}", reported.errors);
    }
    if reported.code == 0 {
        let warnings = &summary(&folder.path().join("out"))["warnings"];
        assert!(warnings.to_string().contains("energy-surplus: "), "{warnings}");
    }
    warned(
        "energy-spike-generalized-alpha",
        "energy-surplus",
        &["energy exceeds the work of loads and drives"],
    );
}

#[test]
fn a_chain_of_very_different_masses_keeps_its_energy_to_a_few_per_cent() {
    let folder = Folder::new("random-chain");
    assert_eq!(run("random-chain-energy-1", &folder).code, 0);
    let energy = &summary(&folder.path().join("out"))["energy"];
    let change = energy["largest_change"].as_f64().unwrap();
    assert!(change < 0.05 * energy["turned_over"].as_f64().unwrap(), "{energy}");
}

#[test]
fn steps_too_long_for_the_rotation_are_divided() {
    let facts = right("radau-many-turns-per-step");
    let (start, end) = (facts["energy"]["start"]["total"].as_f64(), facts["energy"]["end"]["total"].as_f64());
    assert!((end.unwrap() / start.unwrap() - 1.0).abs() < 1e-9, "{facts}");
    // What is left of the steps does not resolve the pendulum, which swings once in 2.4 s.
    warned("pendulum-too-large-step", "unresolved-motion", &["node `b`", "relative_tolerance"]);
}

#[test]
fn steps_that_are_all_divided_are_judged_too() {
    let folder = Folder::new("divided");
    let top = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/top.toml");
    for scheme in ["generalized-alpha", "hht", "radau-iia", "radau-iia-5", "energy-decaying"] {
        for step in ["0.011", "0.02", "0.04"] {
            let [scheme, step] = [format!("analysis.scheme={scheme}"), format!("analysis.step={step}")];
            let reported =
                lissom(&["run", top, "--no-plots", "--set", &scheme, "--set", &step], folder.path());
            assert!(
                reported.errors.contains("the steps are too long for the motion"),
                "{scheme} {step}: {}",
                reported.errors
            );
        }
    }
}

#[test]
fn the_angle_of_many_turns_is_right() {
    let folder = Folder::new("turns");
    assert_eq!(run("radau-many-turns-per-step", &folder).code, 0);
    assert!((last_row(&folder)[1] - 3150.0).abs() < 1e-6);
}

#[test]
fn unstable_equilibria_and_jumps_are_reported() {
    warned("equilibrium-upside-down", "unstable-equilibrium", &["1 direction"]);
    warned("column-beyond-euler", "unstable-equilibrium", &["t = 0.15", "the one at t = 0.1 ", "buckling"]);
    fails("limit-point-jump", &["limit point", "kind = \"path\""]);
}

#[test]
fn an_equilibrium_with_a_free_direction_is_refused_by_the_check() {
    refused("equilibrium-free-spin", 3, &["initial equilibrium", "rotation 3 of node `load`"]);
}

#[test]
fn constant_loads_of_statics_are_applied_in_steps() {
    let folder = Folder::new("ramp");
    assert_eq!(run("statics-constant-load-not-ramped", &folder).code, 0);
    let text = std::fs::read_to_string(folder.path().join("out/history.csv")).unwrap();
    let deflections: Vec<f64> =
        text.lines().skip(1).map(|row| row.split(',').next_back().unwrap().parse().unwrap()).collect();
    // EI = 100: 30/(3 EI) = 0.1 at the end, a quarter of it after the first of four steps.
    assert!((deflections[1] - 0.025).abs() < 1e-3 && (deflections[4] - 0.1).abs() < 2e-3, "{deflections:?}");
    let all = ["run", &model("statics-constant-load-not-ramped"), "--out", "all", "--no-plots", "--quiet"];
    let run = lissom(&[&all[..], &["--set", "analysis.ramp=false"]].concat(), folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    let text = std::fs::read_to_string(folder.path().join("all/history.csv")).unwrap();
    let first: f64 = text.lines().nth(2).unwrap().split(',').next_back().unwrap().parse().unwrap();
    assert!((first - deflections[4]).abs() < 1e-9, "{first}");
}

#[test]
fn weight_of_statics_is_applied_in_steps() {
    let folder = Folder::new("weight");
    let text = std::fs::read_to_string(model("statics-constant-load-not-ramped")).unwrap();
    let text = text
        .replace("lissom = 1", "lissom = 1\ngravity = [0, 0, -40]")
        .replace("vector = [0,0,30]", "vector = [0,0,0]");
    std::fs::write(folder.path().join("m.toml"), text).unwrap();
    let run = lissom(&["run", "m.toml", "--out", "out", "--no-plots", "--quiet"], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    let text = std::fs::read_to_string(folder.path().join("out/history.csv")).unwrap();
    let deflections: Vec<f64> =
        text.lines().skip(1).map(|row| row.split(',').next_back().unwrap().parse().unwrap()).collect();
    // q l⁴/(8 EI) = 0.05 at the end.
    assert!(
        (deflections[1] + 0.0125).abs() < 5e-4 && (deflections[4] + 0.05).abs() < 1e-3,
        "{deflections:?}"
    );
}

#[test]
fn speeds_that_jump_are_reported() {
    warned("linear-table-drive-rings", "model", &["`d`", "t = 0.5 s", "spline"]);
    // No false alarm where the speed is zero on both sides.
    right("drive-comes-to-rest");
}

#[test]
fn axes_that_are_not_perpendicular_are_refused() {
    refused("universal-not-perpendicular", 2, &["45.000 degrees", "[1, 0, 0]"]);
}

#[test]
fn the_energy_decaying_scheme_runs_what_radau_runs() {
    for name in [
        "energy-decaying-clamp-stagnates",
        "energy-decaying-two-beams-clamped",
        "energy-decaying-free-beam",
        "satellite-stalls",
    ] {
        let folder = Folder::new(name);
        let end = if name == "satellite-stalls" { "10" } else { "0.2" };
        let set = format!("analysis.end={end}");
        let model = model(name);
        let of = |scheme: &str| {
            let scheme = format!("analysis.scheme={scheme}");
            let run = lissom(
                &["run", &model, "--out", "out", "--no-plots", "--quiet", "--set", &set, "--set", &scheme],
                folder.path(),
            );
            assert_eq!(run.code, 0, "{name}: {}", run.errors);
            summary(&folder.path().join("out"))
        };
        let (own, radau) = (of("energy-decaying"), of("radau-iia"));
        let count = |facts: &serde_json::Value, what: &str| facts[what].as_f64().unwrap();
        let surplus = own["energy"]["surplus"].as_f64().unwrap();
        assert!(surplus <= 1e-9 * own["energy"]["turned_over"].as_f64().unwrap(), "{name}: {surplus}");
        if name == "satellite-stalls" {
            continue;
        }
        assert!(
            count(&own, "newton_iterations") <= 2.5 * count(&radau, "newton_iterations") + 20.0,
            "{name}: {own:#}"
        );
        assert!(count(&own, "stagnated_steps") <= 0.01 * count(&own, "steps"), "{name}: {own:#}");
    }
}

#[test]
fn a_step_that_has_no_solution_costs_little() {
    let folder = Folder::new("costly");
    let args = ["run", &model("step-that-costs-seconds"), "--out", "out", "--no-plots", "--quiet"];
    let mut run = Run::start(&args, folder.path());
    support::wait_for(|| folder.path().join("out/history.csv").exists());
    let began = Instant::now();
    run.interrupt();
    let ended = run.finish();
    // One attempt at a step is all that may go on after Ctrl-C.
    assert!([130, 0, 3].contains(&ended.code), "{}", ended.errors);
    assert!(began.elapsed() < Duration::from_secs(20), "{:?}", began.elapsed());
}

#[test]
fn plots_of_names_that_files_do_not_distinguish_are_all_there() {
    let folder = Folder::new("names");
    let run = lissom(&["run", &model("plot-names-collide"), "--out", "out", "--quiet"], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    for name in ["a_b.svg", "a_b_2.svg"] {
        assert!(folder.path().join("out").join(name).is_file(), "{name}");
    }
}

#[test]
fn a_failed_start_leaves_former_results_and_two_runs_do_not_share_a_folder() {
    let folder = Folder::new("former");
    assert_eq!(run("plot-names-collide", &folder).code, 0);
    let history = folder.path().join("out/history.csv");
    let former = std::fs::read(&history).unwrap();
    let failed = run("contradicting-drives", &folder);
    assert_eq!(failed.code, 3);
    assert!(failed.errors.contains("are unchanged"), "{}", failed.errors);
    assert_eq!(std::fs::read(&history).unwrap(), former);
    assert_eq!(summary(&folder.path().join("out"))["stopped"], "end");

    let lock = std::fs::File::options().write(true).open(folder.path().join("out/.lock")).unwrap();
    lock.lock().unwrap();
    let second = run("plot-names-collide", &folder);
    assert_eq!(second.code, 3, "{}", second.errors);
    assert!(second.errors.contains("another run"), "{}", second.errors);
    assert_eq!(std::fs::read(&history).unwrap(), former);
}

#[test]
fn plots_of_a_former_run_do_not_stay_beside_new_results() {
    let folder = Folder::new("stale");
    let first = lissom(&["run", &model("plot-names-collide"), "--out", "out", "--quiet"], folder.path());
    assert_eq!(first.code, 0);
    assert_eq!(run("energy-decaying-clamp-stagnates", &folder).code, 0);
    assert!(!folder.path().join("out/a_b.svg").exists());
}

/// The first model with a rod that is shorter than its crank: no position of the drive's second quarter can be reached.
#[test]
fn rods_that_are_stretched_instead_of_moved_are_reported() {
    let folder = Folder::new("stretched");
    assert_eq!(lissom(&["new", "first.toml"], folder.path()).code, 0);
    for (length, is_reported) in [("0.05", true), ("0.35", false)] {
        let set = format!("parameters.length={length}");
        let run = lissom(&["run", "first.toml", "--no-plots", "--quiet", "--set", &set], folder.path());
        assert_eq!(run.code, 0, "{}", run.errors);
        let reports = run.errors.contains("large-strain") && run.errors.contains("beam `rod`");
        assert_eq!(reports, is_reported, "{length}: {}", run.errors);
    }
}

#[test]
fn redundant_constraints_hardly_yield() {
    let folder = Folder::new("yield");
    let run = lissom(&["run", &model("redundant-joints-yield"), "--no-plots", "--out", "."], folder.path());
    // The beam is in fact strained by 80 %.
    assert_eq!(run.code, 0, "{}", run.errors);
    let is_of_beam = |line: &str| line.contains("large-strain") || line.contains("node `b2.");
    assert!(run.errors.contains("large-strain") && run.errors.lines().all(is_of_beam), "{}", run.errors);
    let violation = summary(folder.path())["max_constraint_violation"].as_f64().unwrap();
    assert!(violation < 5e-7, "{violation}");
}

#[test]
fn steps_too_long_for_the_motion_are_reported_and_short_ones_are_not() {
    for name in ["unresolved-universal", "unresolved-vibration", "unresolved-spin"] {
        warned(name, "unresolved-motion", &["the steps are too long", "% at the end", "node `b"]);
        let folder = Folder::new(&format!("{name}-fine"));
        for sets in [
            ["analysis.step=1e-4", "analysis.output_every=200"],
            ["analysis.relative_tolerance=1e-4", "analysis.step=1e-4"],
        ] {
            let args = ["run", &model(name), "--no-plots", "--quiet", "--set", sets[0], "--set", sets[1]];
            let run = lissom(&args, folder.path());
            assert_eq!((run.code, run.errors.as_str()), (0, ""), "{name}: {sets:?}");
        }
    }
}

/// Positions that a drive prescribes are right with any step, and velocities that are recorded follow from them. Those that signals read
/// are the scheme's, and the rates of the joints show that steps are too long.
#[test]
fn steps_too_long_for_velocities_are_reported_and_short_ones_are_not() {
    let folder = Folder::new("rates");
    // x = r cos φ + √(ℓ² - r² sin² φ), φ = 6 t, r = 0.1, ℓ = 0.35.
    let velocity = |time: f64| {
        let (sine, cosine) = (6.0 * time).sin_cos();
        -6.0 * 0.1 * sine * (1.0 + 0.1 * cosine / (0.35_f64.powi(2) - (0.1 * sine).powi(2)).sqrt())
    };
    for (scheme, step, is_reported) in [
        ("generalized-alpha", "0.15", true),
        ("hht", "0.15", true),
        ("radau-iia", "0.15", false),
        ("generalized-alpha", "0.005", false),
        ("hht", "0.005", false),
        ("radau-iia", "0.005", false),
    ] {
        let sets = [format!("analysis.scheme={scheme}"), format!("analysis.step={step}")];
        let ran = |model: &str| {
            let args =
                ["run", model, "--no-plots", "--quiet", "--out", ".", "--set", &sets[0], "--set", &sets[1]];
            lissom(&args, folder.path())
        };
        let run = ran(&model("unresolved-rates"));
        assert_eq!((run.code, run.errors.as_str()), (0, ""));
        let table = std::fs::read_to_string(folder.path().join("history.csv")).unwrap();
        let missed = table.lines().skip(1).map(|line| {
            let mut row = line.split(',').map(|word| word.parse::<f64>().unwrap());
            let time = row.next().unwrap();
            (row.next().unwrap() - velocity(time)).abs() / 0.63
        });
        let worst = missed.fold(0.0_f64, f64::max);
        assert!(worst < 1e-6, "{scheme}, {step}: {worst}");
        let text = std::fs::read_to_string(model("unresolved-rates")).unwrap();
        let read = text.replace("[analysis]", "[signals]\nspeed = \"slider.v1\"\n[analysis]");
        std::fs::write(folder.path().join("read.toml"), read).unwrap();
        let run = ran("read.toml");
        let reports = run.errors.contains("the steps are too long for velocities and forces");
        assert_eq!((run.code, reports), (0, is_reported), "{scheme}, {step}: {}", run.errors);
    }
}
