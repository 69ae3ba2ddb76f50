//! `lissom modes` and analyses of kind `modes`, as scripts see them.

use super::support::{CANTILEVER, Folder, lissom, summary};

fn rows(folder: &std::path::Path, name: &str) -> Vec<Vec<String>> {
    let text = std::fs::read_to_string(folder.join(name)).unwrap();
    text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

#[test]
fn modes_leave_tables_and_a_summary() {
    let folder = Folder::new("modes");
    folder.write("bar.toml", CANTILEVER);
    let run = lissom(&["modes", "bar.toml", "--count", "5"], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    let out = folder.path().join("out/bar-modes");
    let table = rows(&out, "modes.csv");
    assert_eq!(table[0], ["mode", "frequency", "damping", "kind"]);
    assert_eq!(table.len(), 6);
    let frequencies: Vec<f64> = table[1..].iter().map(|row| row[1].parse().unwrap()).collect();
    // Nearly 3.516/(2π) √(EI/(ρA L⁴)).
    assert!((frequencies[0] - 7.91).abs() < 0.05, "{frequencies:?}");
    assert!(frequencies.windows(2).all(|pair| pair[0] <= pair[1]));
    assert_eq!(
        (table[1][0].as_str(), table[1][2].as_str(), table[1][3].as_str()),
        ("1", "0.0", "oscillation")
    );
    let shapes = rows(&out, "shapes.csv");
    assert_eq!(shapes[0].join(","), "mode,node,x,y,z,u1,u2,u3,r1,r2,r3");
    assert_eq!(shapes.len(), 1 + 5 * 9);
    let facts = summary(&out);
    assert_eq!((&facts["found"], &facts["completeness"]), (&5.into(), &"counted".into()));
    assert_eq!(facts["stopped"], "end");
    assert!((facts["modes"][0]["kinetic_shares"]["bar"].as_f64().unwrap() - 1.0).abs() < 1e-12);
    assert!(run.output.contains("none missed"), "{}", run.output);
}

#[test]
fn an_analysis_of_kind_modes_is_run() {
    let folder = Folder::new("kind-modes");
    let text = CANTILEVER
        .replace("kind = \"statics\"\nsteps = 4", "kind = \"modes\"\ncount = 3\nabout = \"undeformed\"");
    folder.write("bar.toml", &text);
    let run = lissom(&["run", "bar.toml", "--quiet"], folder.path());
    assert_eq!((run.code, run.output.as_str(), run.errors.as_str()), (0, "", ""));
    let out = folder.path().join("out/bar");
    assert_eq!(rows(&out, "modes.csv").len(), 4);
    assert_eq!(summary(&out)["about"], "undeformed");
    let check = lissom(&["check", "bar.toml"], folder.path());
    assert!(check.output.contains("3 natural modes about the undeformed state"), "{}", check.output);
}

#[test]
fn modes_that_mean_nothing_have_an_exit_code() {
    let folder = Folder::new("no-modes");
    folder.write("bar.toml", CANTILEVER);
    let code = |args: &[&str], words: &str| {
        let run = lissom(args, folder.path());
        assert!(run.errors.contains(words), "{args:?}: {}", run.errors);
        run.code
    };
    assert_eq!(code(&["modes", "bar.toml", "--about", "7"], "runs from 0 to 1 s"), 2);
    assert_eq!(code(&["modes", "bar.toml", "--about", "here"], "undeformed"), 2);
    assert_eq!(code(&["modes", "bar.toml", "--count", "0"], "count"), 2);
    assert_eq!(code(&["modes", "bar.toml", "--shift", "-1"], "negative"), 2);
    assert_eq!(code(&["modes", "nothing.toml"], "no such file"), 2);
    assert!(!folder.path().join("out").exists(), "a wrong question leaves no results");
    // Without its clamp, but with its load, the bar has no equilibrium.
    let start = CANTILEVER.find("[joints.root]").unwrap();
    let end = CANTILEVER.find("[loads.tip]").unwrap();
    let free = [&CANTILEVER[..start], &CANTILEVER[end..]]
        .concat()
        .replace("[outputs.root]\nkind = \"reaction\"\nof = \"root\"\n", "");
    let free = free.replace("3*t", "3").replace("kind = \"statics\"\nsteps = 4", "kind = \"modes\"");
    folder.write("free.toml", &free);
    assert_eq!(code(&["modes", "free.toml"], "error"), 3);
    assert_eq!(summary(&folder.path().join("out/free-modes"))["stopped"], "failed");
}
