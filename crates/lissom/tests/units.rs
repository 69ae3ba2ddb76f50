//! The same mechanism in other units and on another level of mass takes the same iterations and gives the same motion.
//! In other units positions are rounded elsewhere, which decides a few iterations. So are those of a mechanism far from the origin.

use std::path::Path;

use lissom::Model;

/// Result of a run: iterations, tangents, and the last record with its columns' units.
struct Run {
    iterations: usize,
    tangents: usize,
    last: Vec<(String, String, f64)>,
}

fn run(scheme: &[(&str, &str)], changes: &[(&str, String)]) -> Run {
    let path = format!("{}/../../examples/tip-crank.toml", env!("CARGO_MANIFEST_DIR"));
    let model = Model::read(Path::new(&path)).unwrap();
    let mut overrides: Vec<(String, String)> =
        changes.iter().map(|(path, value)| ((*path).to_owned(), value.clone())).collect();
    overrides.extend(scheme.iter().map(|(path, value)| ((*path).to_owned(), (*value).to_owned())));
    let mut session = model.with_overrides(&overrides).session().unwrap();
    while !session.is_finished() {
        session.advance().unwrap();
    }
    let mut values = Vec::new();
    session.values(&mut values);
    let last = session
        .columns()
        .iter()
        .zip(values)
        .map(|(column, value)| (column.name(), column.unit.clone(), value));
    let totals = session.simulation().totals();
    Run { iterations: totals.newton_iterations, tangents: totals.factorizations, last: last.collect() }
}

/// Lengths in mm, masses in t: forces stay in N, moments and energies are in N mm.
fn in_millimetres_and_tonnes() -> Vec<(&'static str, String)> {
    [
        ("materials.aluminium.E", "73e3"),
        ("materials.aluminium.density", "2.7e-9"),
        ("materials.steel.E", "210e3"),
        ("materials.steel.density", "7.8e-9"),
        ("sections.strip.width", "2.5"),
        ("sections.strip.height", "100"),
        ("sections.tube.outer_radius", "15"),
        ("sections.tube.thickness", "10"),
        ("points.tip", "[1000, 0, 0]"),
        ("points.C", "[1000, 5, 0]"),
        ("points.L", "[1000, 5, -500]"),
        ("points.G", "[970, 5, -500]"),
    ]
    .map(|(path, value)| (path, value.to_owned()))
    .into()
}

/// All masses and stiffnesses times `factor`.
fn heavier(factor: f64) -> Vec<(&'static str, String)> {
    [
        ("materials.aluminium.E", 73e9),
        ("materials.aluminium.density", 2700.0),
        ("materials.steel.E", 210e9),
        ("materials.steel.density", 7800.0),
    ]
    .map(|(path, value)| (path, format!("{:e}", value * factor)))
    .into()
}

/// Factor of a unit: lengths, and forces; moments and energies are both together.
fn factor(unit: &str, length: f64, force: f64) -> f64 {
    match unit {
        "m" => length,
        "N" => force,
        "N m" | "J" => force * length,
        other => panic!("no unit known for {other}"),
    }
}

fn compare(reference: &Run, other: &Run, length: f64, force: f64) {
    assert_eq!(reference.tangents, other.tangents);
    let (ours, theirs) = (reference.iterations, other.iterations);
    let most = if length == 1.0 { 0 } else { ours / 100 };
    assert!(ours.abs_diff(theirs) <= most, "{ours} and {theirs} iterations");
    for unit in ["m", "N", "N m", "J"] {
        let in_unit = |run: &Run| -> Vec<f64> {
            run.last.iter().filter(|(_, kind, _)| kind == unit).map(|(.., value)| *value).collect()
        };
        let (ours, theirs) = (in_unit(reference), in_unit(other));
        assert!(!ours.is_empty(), "{unit}");
        let largest = ours.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        for (a, b) in ours.iter().zip(theirs) {
            let error = (a - b / factor(unit, length, force)).abs() / largest;
            assert!(error < 1e-9, "{unit}: {a:e}, {b:e}");
        }
    }
}

#[test]
fn units_and_mass_levels_do_not_show() {
    for scheme in [
        &[("analysis.end", "0.05")][..],
        &[
            ("analysis.scheme", "\"hht\""),
            ("analysis.alpha", "-0.3"),
            ("analysis.step", "1e-3"),
            ("analysis.end", "0.1"),
        ],
    ] {
        let reference = run(scheme, &[]);
        compare(&reference, &run(scheme, &in_millimetres_and_tonnes()), 1e3, 1.0);
        for factor in [1e6, 1e-6] {
            compare(&reference, &run(scheme, &heavier(factor)), 1.0, factor);
        }
    }
}

/// A double pendulum on a spring, and a body in flight, `shift` m away from the origin: steps and the last positions relative to it.
fn shifted(body: &str, shift: f64) -> (usize, Vec<f64>) {
    let text = format!(
        "lissom = 1\ngravity = [0, 0, -9.81]\nparameters.far = {shift:e}\n\
         analysis = {{ kind = \"dynamics\", end = 1 }}\n{body}\n"
    );
    let mut session = Model::from_text("model.toml", &text).session().unwrap();
    while !session.is_finished() {
        session.advance().unwrap();
    }
    let steps = session.simulation().totals().steps;
    let nodes = session.simulation().state().kinematics.nodes.iter().skip(1);
    let [x, y, z] = [shift, -shift / 2.0, shift / 4.0];
    let positions = nodes.map(|node| node.frame.position);
    (steps, positions.flat_map(|place| [place.x - x, place.y - y, place.z - z]).collect())
}

#[test]
fn distances_from_the_origin_do_not_show() {
    let pendulum = r#"
        [bodies]
        a = { mass = 2, inertia = { box = [0.6, 0.05, 0.05] }, position = ["far + 0.3", "-far/2", "far/4"] }
        b = { mass = 1, inertia = { box = [0.4, 0.05, 0.05] }, position = ["far + 0.8", "-far/2", "far/4"] }
        [joints]
        h = { kind = "revolute", base = "ground", tip = "a", at = ["far", "-far/2", "far/4"], axis = "y" }
        k = { kind = "spherical", base = "a", tip = "b", at = ["far + 0.6", "-far/2", "far/4"] }
        [springs.spring]
        kind = "point"
        base = "ground"
        tip = "b"
        at_base = ["far + 1.2", "0.3 - far/2", "far/4"]
        at_tip = ["far + 1.0", "-far/2", "far/4"]
        stiffness = 60
        length = 0.3"#;
    let arm = r#"
        [bodies]
        arm = { mass = 2, inertia = { box = [0.6, 0.05, 0.05] }, position = ["far + 0.3", "-far/2", "far/4"] }
        [joints]
        h = { kind = "revolute", base = "ground", tip = "arm", at = ["far", "-far/2", "far/4"], axis = "y" }"#;
    let flight = r#"
        [bodies.stone]
        mass = 2
        inertia = { box = [0.6, 0.05, 0.04] }
        position = ["far", "-far/2", "far/4"]
        velocity = [3, 0, 1]
        angular_velocity = [1, 0.2, 4]"#;
    for body in [pendulum, arm, flight] {
        let (steps, wanted) = shifted(body, 0.0);
        for shift in [1e3, 1e6, 5e6] {
            let (others, found) = shifted(body, shift);
            assert!(steps.abs_diff(others) <= steps / 5, "{shift:e} m: {others} steps, not {steps}");
            for (found, wanted) in found.iter().zip(&wanted) {
                assert!((found - wanted).abs() < 1e-5, "{shift:e} m: {found} instead of {wanted}");
            }
        }
    }
}
