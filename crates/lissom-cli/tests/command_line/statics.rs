//! What the program reports about load steps: limit points, and the stability of every equilibrium.

use super::support::{Folder, lissom, summary};
use super::truss::truss;

/// A shallow truss of two springs that snaps through at 9.95 N.
fn shallow_truss() -> String {
    truss(0.3, -40, "[analysis]\nkind = \"statics\"\n")
}

#[test]
fn chosen_load_steps_end_at_a_limit_point_and_say_so() {
    let folder = Folder::new("statics-limit");
    folder.write("truss.toml", &shallow_truss());
    let run = lissom(&["run", "truss.toml", "--out", "out", "--no-plots"], folder.path());
    assert_eq!(run.code, 3, "{}", run.errors);
    assert!(run.errors.contains("limit"), "{}", run.errors);
    let facts = summary(&folder.path().join("out"));
    // The limit is at 2000 (ℓ₀/ℓ - 1) y, ℓ³ = ℓ₀.
    let free = 1.09_f64.sqrt();
    let length = free.cbrt();
    let limit = 2000.0 * (free / length - 1.0) * (length * length - 1.0).sqrt() / 40.0;
    let reached = facts["time"].as_f64().unwrap();
    assert!(reached <= limit && reached > 0.99 * limit, "{reached} of {limit}");
    assert_eq!(facts["stopped"], "failed");
    assert!(facts["planned_steps"].is_null());
}

/// A column that is pushed along itself beyond its Euler load, π² EI/4 = 246.7 N at 0.617 of the load.
const COLUMN: &str = r#"
lissom = 1
[sections.strip]
shape = "general"
stiffness = [1e7, 1e7, 1e7, 1e4, 1e4, 100]
mass = [1, 1, 1, 1, 1, 1]
[beams.strip]
section = "strip"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 12
up = [0, 0, 1]
[joints.root]
kind = "clamp"
base = "ground"
tip = "strip.start"
[loads.end]
kind = "force"
on = "strip.end"
vector = [-400, 0, 0]
[analysis]
kind = "statics"
steps = 20
"#;

#[test]
fn the_stability_of_every_equilibrium_is_reported() {
    let folder = Folder::new("statics-stability");
    folder.write("column.toml", COLUMN);
    let run = lissom(&["run", "column.toml", "--out", "out", "--no-plots"], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    let facts = summary(&folder.path().join("out"));
    let reported = facts["stability"].as_array().unwrap();
    assert_eq!(reported.len(), 2, "{reported:?}");
    assert_eq!(
        (reported[0]["time"].as_f64().unwrap(), reported[0]["unstable_directions"].as_u64()),
        (0.05, Some(0))
    );
    assert!((reported[1]["time"].as_f64().unwrap() - 0.65).abs() < 1e-9, "{reported:?}");
    assert_eq!(reported[1]["unstable_directions"], 1);
}

/// A solid column of length 2 that is pushed along itself: its Euler load is π² EI/(4 ℓ²) = 51.4 N, at 0.64 of the load.
const SOLID_COLUMN: &str = r#"
lissom = 1
[materials.soft]
E = 1e7
nu = 0
density = 1000
[solids.bar]
size = [2, 0.1, 0.1]
divisions = [8, 1, 1]
material = "soft"
[joints.root]
kind = "clamp"
base = "ground"
tip = "bar.west"
[loads.end]
kind = "force"
on = "bar.east"
vector = [-80, 0, 0]
[analysis]
kind = "statics"
end = 1
steps = 5
"#;

#[test]
fn a_solid_column_is_unstable_beyond_its_euler_load() {
    let folder = Folder::new("statics-solid");
    folder.write("column.toml", SOLID_COLUMN);
    let run = lissom(&["run", "column.toml", "--out", "out", "--no-plots"], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    let facts = summary(&folder.path().join("out"));
    let reported = facts["stability"].as_array().unwrap();
    let fact =
        |k: usize| (reported[k]["time"].as_f64().unwrap(), reported[k]["unstable_directions"].as_u64());
    assert_eq!((fact(0), fact(1)), ((0.2, Some(0)), (0.8, Some(2))), "{reported:?}");
    assert!(run.errors.contains("unstable"), "{}", run.errors);
}
