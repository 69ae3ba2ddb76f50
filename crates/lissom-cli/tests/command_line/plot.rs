//! `lissom plot` and `lissom explain` as their users see them.

use std::fs;

use crate::support::{CANTILEVER, Folder, example, lissom, summary};

/// Pictures of hundreds of outputs take longer than their run: it draws the first ones and names the others.
#[test]
fn a_run_draws_at_most_twenty_outputs() {
    let folder = Folder::new("plot-many");
    let outputs: Vec<String> =
        (1..=23).map(|k| format!("[outputs.o{k}]\nkind = \"position\"\nof = \"ball\"\n")).collect();
    let ball = "lissom = 1\n[bodies.ball]\nmass = 1\ninertia = [1, 1, 1]\nvelocity = [1, 0, 0]\n";
    let analysis = "[analysis]\nkind = \"dynamics\"\nend = 0.1\nstep = 0.01\n";
    folder.write("many.toml", &[ball, &outputs.concat(), analysis].concat());
    let drawn = || {
        let files = fs::read_dir(folder.path().join("out")).unwrap().map(|file| file.unwrap().path());
        files.filter(|path| path.extension() == Some("svg".as_ref())).count()
    };
    let run = lissom(&["run", "many.toml", "--out", "out"], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    let words = "plots       20 of 23 outputs; `lissom plot out` also draws the other 3: o21 … o23";
    assert!(run.output.contains(words) && drawn() == 20, "{}", run.output);
    let plot = lissom(&["plot", "out"], folder.path());
    assert!(plot.code == 0 && drawn() == 23, "{}", plot.errors);
}

#[test]
fn paths_spectra_and_several_results_are_drawn() {
    let folder = Folder::new("plot-asked");
    let model = example("pendulum");
    for (step, out) in [("1e-2", "coarse"), ("5e-3", "fine")] {
        let step = format!("analysis.step={step}");
        let run = lissom(&["run", &model, "--set", &step, "--out", out, "-q"], folder.path());
        assert_eq!(run.code, 0, "{}", run.errors);
    }
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    let path = lissom(&["plot", "coarse", "--of", "bob.y", "--over", "bob.x"], folder.path());
    assert_eq!(path.code, 0, "{}", path.errors);
    assert_eq!(path.output, "coarse/plot-bob.y-over-bob.x.svg\ncoarse/plot-bob.y-over-bob.x.png\n");
    let svg = read("coarse/plot-bob.y-over-bob.x.svg");
    for words in ["bob.x [m]", "position [m]", "bob.y over bob.x"] {
        assert!(svg.contains(words), "{words}");
    }
    let spectrum = lissom(&["plot", "fine", "--of", "arm", "--spectrum", "--out", "spectra"], folder.path());
    assert_eq!(spectrum.code, 0, "{}", spectrum.errors);
    let svg = read("spectra/plot-arm-spectrum.svg");
    for words in ["frequency [Hz]", "relative rotation [mrad]", "relative angular velocity [rad/s]"] {
        assert!(svg.contains(words), "{words}");
    }
    assert!(!svg.contains("relative [rad]"));
    // Former names of columns are understood, as in expressions.
    for args in [["--of", "arm.rotation", "--over", "bob.x"], ["--of", "bob.x", "--over", "arm.rotation"]] {
        let plot = lissom(&[&["plot", "fine", "--out", "former"], &args[..]].concat(), folder.path());
        assert_eq!(plot.code, 0, "{args:?}: {}", plot.errors);
    }
    assert!(read("former/plot-arm.rotation-over-bob.x.svg").contains("relative rotation"));
    let both = lissom(&["plot", "coarse", "fine", "--out", "both"], folder.path());
    assert_eq!(both.code, 0, "{}", both.errors);
    let svg = read("both/plot-bob.svg");
    for words in [">x, coarse<", ">x, fine<", ">y, fine<"] {
        assert!(svg.contains(words), "{words}");
    }
    assert_eq!(fs::read_dir(folder.path().join("both")).unwrap().count(), 2 * 4, "all four outputs");
    // A table that belongs to another model.
    folder.write("bar.toml", CANTILEVER);
    assert_eq!(lissom(&["run", "bar.toml", "--out", "bar", "-q"], folder.path()).code, 0);
    for (args, words) in [
        (vec!["plot", "coarse", "--of", "bob.q"], "it has bob.x, bob.y"),
        (vec!["plot", "coarse", "--of", "bob", "--over", "arm"], "no column or output `arm`"),
        (vec!["plot", "coarse", "bar"], "no output in common"),
        (vec!["plot", "coarse", "bar", "--of", "bob"], "`bar` has no column"),
        (vec!["plot", "bar", "--spectrum", "--of", "tip", "--over", "tip.u1"], "cannot be used with"),
        (vec!["plot", "nowhere"], "history.csv"),
        (vec!["plot"], "required"),
    ] {
        let plot = lissom(&args, folder.path());
        assert_eq!(plot.code, 2, "{args:?}");
        assert!(plot.errors.contains(words), "{args:?} {}", plot.errors);
    }
    // Units that differ are not drawn on one axis.
    let path = folder.path().join("fine/summary.json");
    let text = fs::read_to_string(&path).unwrap();
    let quantity = "\"quantity\": \"position\",\n      \"unit\": \"m\"";
    assert!(text.contains(quantity), "{text}");
    fs::write(&path, text.replace(quantity, &quantity.replace("\"m\"", "\"mm\""))).unwrap();
    let plot = lissom(&["plot", "coarse", "fine", "--of", "bob"], folder.path());
    assert!(
        plot.code == 2 && plot.errors.contains("in m in one of the results, and in mm"),
        "{}",
        plot.errors
    );
    // Plots requested for a former run would lie beside new ones.
    let run = lissom(&["run", &model, "--out", "coarse", "-q"], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(!folder.path().join("coarse/plot-bob.y-over-bob.x.svg").exists());
}

#[test]
fn what_was_reported_is_explained() {
    let folder = Folder::new("explain");
    let all = lissom(&["explain"], folder.path());
    assert_eq!(all.code, 0);
    assert!(
        all.output.contains("energy-surplus") && all.output.contains("did not converge"),
        "{}",
        all.output
    );
    let one = lissom(&["explain", "jump"], folder.path());
    assert_eq!((one.code, one.output.lines().count()), (0, 3), "{}", one.output);
    assert!(one.output.contains("limit point"), "{}", one.output);
    let words = lissom(&["explain", "did", "not", "converge"], folder.path());
    assert!(words.code == 0 && words.output.contains("snap-through"), "{}", words.output);
    let unknown = lissom(&["explain", "jumpp"], folder.path());
    assert!(unknown.code == 2 && unknown.errors.contains("did you mean `jump`?"), "{}", unknown.errors);
    // A column beyond its buckling load: the run warns, and its folder is explained.
    let model = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/command_line/silent/column-beyond-euler.toml");
    let run = lissom(&["run", model, "--out", "column", "-q"], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    let reported = summary(&folder.path().join("column"))["warnings"].to_string();
    assert!(reported.contains("unstable-equilibrium"), "{reported}");
    let of_run = lissom(&["explain", "column"], folder.path());
    assert!(
        of_run.code == 0 && of_run.output.contains("disturb it, or constrain the free parts"),
        "{}",
        of_run.output
    );
    assert_eq!(lissom(&["explain", "."], folder.path()).code, 2, "a folder without a run");
}

#[test]
fn programs_can_read_checks_and_kinds() {
    let folder = Folder::new("for-programs");
    let value = |text: &str| serde_json::from_str::<serde_json::Value>(text).unwrap();
    let check = lissom(&["check", &example("four-bar"), "--json"], folder.path());
    assert_eq!(check.code, 0, "{}", check.errors);
    let facts = value(&check.output);
    assert_eq!((&facts["ok"], &facts["beams"], &facts["joints"]), (&true.into(), &3.into(), &5.into()));
    assert_eq!(
        facts["unknowns"].as_u64().unwrap(),
        facts["coordinates"].as_u64().unwrap() + facts["constraints"].as_u64().unwrap()
    );
    folder.write("bad.toml", &CANTILEVER.replace("kind = \"clamp\"", "kind = \"clmap\""));
    let check = lissom(&["check", "bad.toml", "--json"], folder.path());
    assert_eq!(check.code, 2);
    let facts = value(&check.output);
    assert_eq!(facts["ok"], false);
    let problem = &facts["problems"][0];
    let line = 1 + CANTILEVER.lines().position(|line| line.contains("clamp")).unwrap();
    assert_eq!((problem["severity"].as_str(), problem["line"].as_u64()), (Some("error"), Some(line as u64)));
    assert!(problem["message"].as_str().unwrap().contains("clmap"), "{problem}");
    let kinds = lissom(&["kinds", "revolute", "--json"], folder.path());
    assert_eq!(kinds.code, 0, "{}", kinds.errors);
    let kinds = value(&kinds.output);
    assert_eq!(kinds["joints"][0]["name"], "revolute");
    assert!(kinds["joints"][0]["acts_on"].as_str().unwrap().contains("axis"));
    assert_eq!(lissom(&["kinds", "no_such_kind", "--json"], folder.path()).code, 2);
}
