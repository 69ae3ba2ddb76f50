//! Bodies with the mean motion of a set of nodes: they spread forces, and do not stiffen.

use super::{BLOCK, CANTILEVER};
use crate::support::refused::refused;
use crate::support::runs::{last, run, run_without_warnings};

/// A part with a light body that follows its east side, at `at`, with a load of this kind and vector on it.
fn with_flange(text: &str, part: &str, at: [f64; 3], (kind, vector): (&str, [f64; 3])) -> String {
    let (model, rest) = text.split_once("[loads.").expect("a load");
    let (_, rest) = rest.split_once("\n[").expect("a table after it");
    format!(
        "{model}[bodies.flange]\nmass = 1e-3\ninertia = [1e-6, 1e-6, 1e-6]\nposition = {at:?}\n\
         [joints.mean]\nkind = \"mean_motion\"\nbase = \"{part}.east\"\ntip = \"flange\"\n\
         [loads.own]\nkind = \"{kind}\"\non = \"flange\"\nvector = {vector:?}\n\
         [outputs.flange]\nkind = \"displacement\"\nof = \"flange\"\n\
         [outputs.turned]\nkind = \"rotation\"\nof = \"flange\"\n\
         [outputs.held]\nkind = \"reaction\"\nof = \"mean\"\n[{rest}"
    )
}

/// A force on the body is spread as a uniform one over the side, which contracts freely: a clamp would prevent this.
#[test]
fn a_force_is_spread_uniformly_and_the_side_contracts() {
    let text = with_flange(BLOCK, "block", [2.0, 0.5, 0.5], ("force", [1e5, 0.0, 0.0]));
    let spread = run_without_warnings(&text, &[]);
    let direct = run_without_warnings(BLOCK, &[]);
    for (output, component) in [("end", "u1"), ("end", "u2"), ("middle", "u3"), ("stress", "s11")] {
        let [own, other] = [&spread, &direct].map(|record| last(record, output, component));
        assert!((own / other - 1.0).abs() < 1e-9, "{output}.{component}: {own} {other}");
    }
    assert!((last(&spread, "flange", "u1") / last(&direct, "end", "u1") - 1.0).abs() < 1e-9);
    // The mean of the side moves by half the contraction.
    assert!((last(&spread, "flange", "u2") / last(&direct, "end", "u2") - 0.5).abs() < 1e-9);
    assert!((last(&spread, "held", "f1") + 1e5).abs() < 1e-4, "{}", last(&spread, "held", "f1"));
    let clamped = run(&text.replace("mean_motion", "clamp"), &[]);
    assert!(last(&clamped, "end", "u2") / last(&direct, "end", "u2") < 0.1);
}

/// A moment bends a bar as one of beam theory does, and a force beside the mean of the set also has its moment.
#[test]
fn a_moment_turns_the_set() {
    let bending = 1e6 / 12.0;
    let turned = |load, at| run_without_warnings(&with_flange(CANTILEVER, "bar", at, load), &[]);
    let at_end = [10.0, 0.5, 0.5];
    let record = turned(("moment", [0.0, 10.0, 0.0]), at_end);
    let exact = 10.0 * 10.0 / bending;
    assert!((last(&record, "turned", "r2") / exact - 1.0).abs() < 0.01, "{}", last(&record, "turned", "r2"));
    assert!((last(&record, "held", "m2") + 10.0).abs() < 1e-5, "{}", last(&record, "held", "m2"));
    // The same wrench from a body that is beside the bar.
    let beside = turned(("force", [1.0, 0.0, 0.0]), [10.0, 0.5, 10.5]);
    assert!((last(&beside, "held", "m2") + 10.0).abs() < 0.02, "{}", last(&beside, "held", "m2"));
    assert!((last(&beside, "turned", "r2") / exact - 1.0).abs() < 0.01);
}

/// A stiff bar that swings from a body on a hinge is a pendulum; its energy is preserved.
const PENDULUM: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]
[materials.stiff]
E = 1e9
nu = 0.3
density = 1000
[solids.bar]
size = [1, 0.2, 0.2]
divisions = [4, 1, 1]
origin = [0, -0.1, -0.1]
material = "stiff"
[bodies.hub]
mass = 1
inertia = [0.01, 0.01, 0.01]
position = [0, 0, 0]
[joints.pin]
kind = "revolute"
base = "ground"
tip = "hub"
axis = [0, 1, 0]
[joints.mean]
kind = "mean_motion"
base = "bar.west"
tip = "hub"
[outputs.pin]
kind = "relative"
of = "pin"
[outputs.end]
kind = "position"
of = "bar@1,0.5,0"
[outputs.energy]
kind = "energy"
[analysis]
kind = "dynamics"
scheme = "radau-iia-5"
end = 0.6
step = 2e-3
"#;

#[test]
fn a_bar_swings_from_a_body_that_follows_it() {
    let record = run(PENDULUM, &[]);
    let rigid = run(&PENDULUM.replace("mean_motion", "clamp"), &[]);
    let angle = last(&record, "pin", "angle");
    assert!(angle > 1.5, "{angle}");
    assert!((angle - last(&rigid, "pin", "angle")).abs() < 2e-3, "{angle} {}", last(&rigid, "pin", "angle"));
    let total = last(&record, "energy", "total");
    assert!(total.abs() < 1e-3, "{total}");
    // The energy-decaying scheme, whose promise does not cover it: the energy stays near.
    let decaying = run(PENDULUM, &[("analysis.scheme", "energy-decaying"), ("analysis.step", "1e-3")]);
    assert!((last(&decaying, "pin", "angle") - angle).abs() < 1e-3);
    assert!(last(&decaying, "energy", "total") < 1e-3, "{}", last(&decaying, "energy", "total"));
}

#[test]
fn what_has_no_mean_rotation_is_named() {
    let line = BLOCK.replace(
        "[joints.x]",
        "[solids.block.sets]\nline = { from = [2, 0, 0], to = [2, 1, 0] }\n[joints.x]",
    );
    let flange = |base: &str| {
        with_flange(&line, "block", [2.0, 0.5, 0.5], ("force", [1.0, 0.0, 0.0]))
            .replace("block.east\"\ntip", &format!("{base}\"\ntip"))
    };
    let message = refused(&flange("block.line"));
    assert!(message.contains("on a line"), "{message}");
    let ends = |tip: &str| format!("base = \"bar.west\"\ntip = \"{tip}\"");
    let several = PENDULUM.replace(&ends("hub"), &ends("bar.east"));
    assert_ne!(several, PENDULUM);
    let message = refused(&several);
    assert!(message.contains("one is needed"), "{message}");
    for base in ["block@1,0,0", "ground"] {
        let message = refused(&flange(base));
        assert!(
            message.contains("no set of nodes") || message.contains("does not move"),
            "{base}: {message}"
        );
    }
}
