//! `lissom modes` and analyses of kind `modes`, as scripts see them.

use lissom::ResultFolder;
use lissom::motion::NodeId;

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
    // A picture of each shape, with its frequency.
    let sheet = std::fs::read_to_string(out.join("shapes.svg")).unwrap();
    for mode in 1..=5 {
        assert!(sheet.contains(&format!("{mode}: {:.4} Hz", frequencies[mode - 1])), "{mode}");
    }
    let facts = summary(&out);
    assert_eq!((&facts["found"], &facts["completeness"]), (&5.into(), &"counted".into()));
    assert_eq!(facts["stopped"], "end");
    assert!((facts["modes"][0]["kinetic_shares"]["bar"].as_f64().unwrap() - 1.0).abs() < 1e-12);
    assert!(run.output.contains("none missed"), "{}", run.output);
}

/// A mass of 3 kg on a spring of 300 N/m that carries one of 2 kg on a spring of 100 N/m, both along x.
const CHAIN: &str = r#"
lissom = 1
[bodies.first]
mass = 3
inertia = [1, 1, 1]
position = [1, 0, 0]
[bodies.second]
mass = 2
inertia = [1, 1, 1]
position = [2, 0, 0]
[joints.rail]
kind = "prismatic"
base = "ground"
tip = "first"
axis = [1, 0, 0]
[joints.slide]
kind = "prismatic"
base = "first"
tip = "second"
axis = [1, 0, 0]
[springs.foot]
kind = "axial"
joint = "rail"
stiffness = 300
[springs.top]
kind = "axial"
joint = "slide"
stiffness = 100
[analysis]
kind = "modes"
count = 2
"#;

#[test]
fn energies_and_effective_masses_of_two_masses_are_those_of_their_matrices() {
    let folder = Folder::new("mode-energies");
    folder.write("chain.toml", CHAIN);
    let run = lissom(&["run", "chain.toml", "--out", "out"], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    let out = folder.path().join("out");
    let (energies, masses) = (rows(&out, "energy.csv"), rows(&out, "participation.csv"));
    assert_eq!(energies[0].join(","), "mode,part,kinetic,strain");
    assert_eq!(masses[0].join(","), "mode,x,y,z,rx,ry,rz");
    // 6 s⁴ + (200 + 300 + 600) s² + 30000 = 0 for M = diag(3, 2), K = [400, -100; -100, 100].
    let roots =
        [-1.0, 1.0].map(|sign| (1100.0 + sign * (1100.0_f64.powi(2) - 24.0 * 30_000.0).sqrt()) / 12.0);
    let number = |text: &str| -> f64 { text.parse().unwrap() };
    let mut whole = 0.0;
    for (mode, square) in roots.into_iter().enumerate() {
        let shape = [100.0, 400.0 - 3.0 * square];
        let modal = 3.0 * shape[0] * shape[0] + 2.0 * shape[1] * shape[1];
        let share = |part: &str, column: usize| {
            let row = energies.iter().find(|row| row[0] == (mode + 1).to_string() && row[1] == part);
            number(&row.unwrap_or_else(|| panic!("{part} in {energies:?}"))[column])
        };
        let kinetic = 3.0 * shape[0] * shape[0] / modal;
        assert!((share("first", 2) - kinetic).abs() < 1e-9, "{energies:?}");
        assert!((share("second", 2) - 1.0 + kinetic).abs() < 1e-9);
        let strain = [300.0 * shape[0] * shape[0], 100.0 * (shape[1] - shape[0]).powi(2)];
        let of_foot = strain[0] / (strain[0] + strain[1]);
        assert!((share("rail", 3) - of_foot).abs() < 1e-6, "{energies:?}");
        assert!((share("slide", 3) - 1.0 + of_foot).abs() < 1e-6);
        let effective = (3.0 * shape[0] + 2.0 * shape[1]).powi(2) / modal;
        assert!((number(&masses[mode + 1][1]) - effective).abs() < 1e-9, "{masses:?}");
        assert!(masses[mode + 1][2..4].iter().all(|value| number(value).abs() < 1e-12), "{masses:?}");
        whole += number(&masses[mode + 1][1]);
    }
    assert!((whole - 5.0).abs() < 1e-9, "{whole}");
    assert_eq!((masses[3][0].as_str(), number(&masses[3][1])), ("all", 5.0));
    // About z through the centre of mass at x = 1.4: 2 + 3·0.4² + 2·0.6².
    assert!((number(&masses[3][6]) - 3.2).abs() < 1e-12, "{masses:?}");
    let facts = summary(&out);
    assert!(
        (facts["modes"][0]["effective_masses"][0].as_f64().unwrap() - number(&masses[1][1])).abs() < 1e-12
    );
    assert!(facts["modes"][0]["strain_shares"]["slide"].as_f64().unwrap() > 0.0);
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
    // Without its clamp it has no equilibrium under its load, but modes without it; with a hinge and a moment about it, it turns.
    let start = CANTILEVER.find("[joints.root]").unwrap();
    let end = CANTILEVER.find("[loads.tip]").unwrap();
    let free = [&CANTILEVER[..start], &CANTILEVER[end..]]
        .concat()
        .replace("[outputs.root]\nkind = \"reaction\"\nof = \"root\"\n", "");
    let free = free.replace("3*t", "3").replace("kind = \"statics\"\nsteps = 4", "kind = \"modes\"");
    folder.write("free.toml", &free);
    assert_eq!(code(&["modes", "free.toml"], "free-part-under-load"), 0);
    let hinge = "\n[joints.hinge]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"bar.start\"\naxis = \"y\"\n\
        [loads.turn]\nkind = \"moment\"\non = \"bar.end\"\nvector = [0, 3, 0]\n";
    let free = free + hinge;
    folder.write("free.toml", &free);
    assert_eq!(code(&["modes", "free.toml"], "error"), 3);
    assert_eq!(summary(&folder.path().join("out/free-modes"))["stopped"], "failed");
}

#[test]
fn modes_are_drawn_as_shapes_and_as_oscillations() {
    let folder = Folder::new("mode-pictures");
    folder.write("bar.toml", CANTILEVER);
    assert_eq!(lissom(&["modes", "bar.toml", "--count", "3", "-q"], folder.path()).code, 0);
    let out = folder.path().join("out/bar-modes");
    let snapshot = |more: &[&str]| lissom(&[&["snapshot", "out/bar-modes"], more].concat(), folder.path());
    let all = snapshot(&[]);
    assert_eq!(all.code, 0, "{}", all.errors);
    let sheet = std::fs::read_to_string(out.join("snapshot.svg")).unwrap();
    let frequencies: Vec<f64> =
        rows(&out, "modes.csv")[1..].iter().map(|row| row[1].parse().unwrap()).collect();
    for (index, frequency) in frequencies.iter().enumerate() {
        assert!(sheet.contains(&format!("{}: {frequency:.4} Hz", index + 1)));
    }
    let period = snapshot(&["--mode", "2", "--strip", "3"]);
    assert_eq!(period.code, 0, "{}", period.errors);
    let sheet = std::fs::read_to_string(out.join("snapshot.svg")).unwrap();
    assert!(sheet.contains("mode 2: ") && sheet.contains("0.500 of its period"), "{sheet}");
    let moving = snapshot(&["--mode", "1", "--animate", "0.5"]);
    assert_eq!(moving.code, 0, "{}", moving.errors);
    assert!(std::fs::read(out.join("snapshot.png")).unwrap().windows(4).any(|word| word == b"acTL"));
    for (wrong, message) in [
        (&["--strip", "3"] as &[&str], "choose it with `--mode N`"),
        (&["--mode", "9"], "there is no mode 9"),
    ] {
        let refused = snapshot(wrong);
        assert!(refused.code == 2 && refused.errors.contains(message), "{}", refused.errors);
    }
    // The shape goes a twelfth of the model, along what the table says, and back in half a period.
    let modes = ResultFolder::recorded_modes(&out).unwrap();
    let motion = modes.oscillation(1, &[0.0, 0.25, 0.5]).unwrap();
    let still = ResultFolder::recorded_modes(&out).unwrap().oscillation(1, &[0.25]).unwrap();
    let tip = motion.reference().len() - 1;
    let node = NodeId::new(tip);
    let shift = |frame: usize| motion.pose(frame, node).position - still.pose(0, node).position;
    let length = motion.reference()[node].position.norm();
    assert!((shift(0).norm() / length - 1.0 / 12.0).abs() < 1e-4, "{} of {length}", shift(0));
    assert!((shift(0) + shift(2)).norm() < 1e-6 * length && shift(1).norm() < 1e-6 * length);
    let table = rows(&out, "shapes.csv");
    let last: Vec<f64> = table[tip].iter().skip(5).take(3).map(|text| text.parse().unwrap()).collect();
    let along = shift(0).normalize().dot(&nalgebra::Vector3::from_row_slice(&last).normalize());
    assert!((along - 1.0).abs() < 1e-6, "{along}");
}
