//! What the program reports about an assembly: at the check, at the end of a run, in the summary.

use super::support::{Folder, lissom, summary};

/// A rod on a pin of the ground, drawn 0.1 m beside it, and a hanger that nothing has moved.
const ROD: &str = r#"
lissom = 1
gravity = [0, -9.81, 0]
[bodies.rod]
mass = 2
inertia = [0.1, 0.1, 0.1]
position = [0.5, 0.1, 0]
[joints.pin]
kind = "revolute"
base = "ground"
tip = "rod"
at = [0, 0, 0]
at_tip = [0, 0.1, 0]
axis = [0, 0, 1]
angle = 0
[assembly]
[outputs.rod]
kind = "displacement"
of = "rod"
[outputs.end]
kind = "position"
of = "rod"
point = [1, 0.1, 0]
[analysis]
kind = "dynamics"
end = 1e-3
step = 1e-3
"#;

#[test]
fn what_an_assembly_moved_is_reported_everywhere() {
    let folder = Folder::new("assembly");
    folder.write("rod.toml", ROD);
    let checked = lissom(&["check", "rod.toml"], folder.path());
    assert_eq!(checked.code, 0, "{}", checked.errors);
    let words = "moved `rod` by 0.1 m; closed `pin` by 0.1 m";
    assert!(checked.output.contains(words), "{}", checked.output);
    let ran = lissom(&["run", "rod.toml"], folder.path());
    assert!(ran.code == 0 && ran.output.contains(words), "{} {}", ran.output, ran.errors);
    let out = folder.path().join("out/rod");
    let reported = &summary(&out)["assembly"];
    assert_eq!(reported["moved"][0]["part"], "rod", "{reported}");
    assert!((reported["moved"][0]["distance"].as_f64().unwrap() - 0.1).abs() < 1e-12, "{reported}");
    assert_eq!(reported["closed"][0]["joint"], "pin", "{reported}");
    assert!(reported["left"].as_f64().unwrap() < 1e-12, "{reported}");
    // Displacements count from the assembled position; a point of the drawing stays on its part.
    let history = std::fs::read_to_string(out.join("history.csv")).unwrap();
    let first: Vec<f64> =
        history.lines().nth(1).unwrap().split(',').map(|value| value.parse().unwrap()).collect();
    assert_eq!(&first[1..4], &[0.0; 3], "{history}");
    let end = &first[first.len() - 3..];
    assert!((end[0] - 1.0).abs() < 1e-12 && end[1].abs() < 1e-12, "{history}");
}

#[test]
fn a_model_that_cannot_be_assembled_has_exit_code_2() {
    let folder = Folder::new("assembly-open");
    let held = ROD.replace("[assembly]", "[assembly]\nfixed = [\"rod\"]");
    folder.write("rod.toml", &held);
    for command in ["check", "run", "modes"] {
        let ended = lissom(&[command, "rod.toml"], folder.path());
        assert_eq!(ended.code, 2, "{command}: {}", ended.output);
        let words = ended.errors.contains("cannot be assembled") && ended.errors.contains("0.1 m");
        assert!(words && ended.errors.contains("`pin`"), "{command}: {}", ended.errors);
    }
    assert!(!folder.path().join("out/rod/history.csv").exists());
}
