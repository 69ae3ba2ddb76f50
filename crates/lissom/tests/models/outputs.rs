//! What outputs are measured relative to, their units and their plots.

use crate::support::runs::{last, run, session};

/// Two bodies turned about one axis, by different angles.
const TURNED: &str = r#"
lissom = 1
[bodies.frame]
mass = 1
inertia = [1, 1, 1]
rotation = [0, 0, 0.5]
[bodies.body]
mass = 1
inertia = [1, 1, 1]
rotation = [0, 0, 0.9]
[outputs.angles]
kind = "cardan_angles"
of = "body"
relative_to = "frame"
[outputs.quaternion]
kind = "quaternion"
of = "body"
relative_to = "frame"
[outputs.force]
kind = "expression"
value = "2e-3*angles.gamma"
unit = "kN"
plot = "both"
[outputs.speed]
kind = "angular_velocity"
of = "body"
plot = "both"
[analysis]
kind = "dynamics"
end = 0.1
"#;

#[test]
fn orientations_are_relative_to_an_observer() {
    let record = run(TURNED, &[]);
    for (output, component, exact) in [
        ("angles", "alpha", 0.0),
        ("angles", "gamma", 0.4),
        ("quaternion", "q0", 0.2_f64.cos()),
        ("quaternion", "q3", 0.2_f64.sin()),
    ] {
        let found = last(&record, output, component);
        assert!((found - exact).abs() < 1e-14, "{output}.{component}: {found}");
    }
}

#[test]
fn expressions_have_units_and_outputs_share_plots() {
    let session = session(TURNED, &[]);
    let columns = session.columns();
    let of = |name: &str| columns.iter().find(|column| column.name() == name).unwrap();
    let force = of("force.value");
    assert_eq!([&*force.unit, &*force.quantity, &*force.plot], ["kN", "force", "both"]);
    assert_eq!([force.label(columns), of("speed.w3").label(columns)], ["force", "speed.w3"]);
    assert_eq!([of("angles.beta").label(columns), of("angles.beta").plot.clone()], ["beta", "angles"]);
}
