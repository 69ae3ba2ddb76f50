//! Rotors whose motion is computed in axes that do not spin: what they cost, and that they move as in their own axes.

use std::path::Path;

use lissom::Model;
use lissom::core::settings::Totals;
use lissom::model::output::Record;

use crate::support::example;

/// Results, effort, and the number of rotors.
fn run_of(model: &Model) -> (Record, Totals, usize) {
    let mut session = model.session().unwrap_or_else(|error| panic!("{error}"));
    let rotors = session.simulation().system().layout().rotors.len();
    let results = session.run().unwrap_or_else(|error| panic!("{error}"));
    let (record, report) = results.into_parts();
    (record, report.totals, rotors)
}

fn run(text: &str) -> (Record, Totals, usize) {
    run_of(&Model::from_text("model.toml", text))
}

fn column<'r>(record: &'r Record, name: &str, component: &str) -> &'r [f64] {
    record.column(name, component).unwrap_or_else(|| panic!("no {name}.{component}"))
}

/// Largest difference of a column of two records with the same times.
fn difference(one: &Record, other: &Record, name: &str, component: &str) -> f64 {
    let pairs = column(one, name, component).iter().zip(column(other, name, component));
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// A balanced wheel on a sprung upright, whose motion does not depend on its spin.
fn wheel(spin: f64, [base, tip]: [&str; 2], analysis: &str) -> String {
    format!(
        r#"
lissom = 1
gravity = [0, 0, -9.81]
[bodies.upright]
mass = 14
inertia = [0.1, 0.1, 0.1]
position = [0, 0, 0]
[bodies.wheel]
mass = 18
inertia = [0.54, 0.9, 0.54]
position = [0, 0, 0]
angular_velocity = [0, {spin}, 0]
[joints.slide]
kind = "prismatic"
base = "ground"
tip = "upright"
axis = [0, 0, 1]
[joints.axle]
kind = "revolute"
base = "{base}"
tip = "{tip}"
axis = [0, 1, 0]
[springs.spring]
kind = "point"
base = "ground"
tip = "upright"
at_base = [0, 0, 1]
at_tip = [0, 0, 0]
stiffness = 5000
damping = 0
preload = 0
[outputs.z]
kind = "displacement"
of = "upright"
[outputs.turn]
kind = "relative"
of = "axle"
[outputs.axle]
kind = "reaction"
of = "axle"
[outputs.energy]
kind = "energy"
[analysis]
kind = "dynamics"
end = 5
output_step = 0.1
{analysis}
"#
    )
}

/// The bar of a wheel that spins: 1.2 times the steps at rest. It needed 20 and 150 times as many.
#[test]
fn a_wheel_costs_at_any_spin_what_it_costs_at_rest() {
    let (still, at_rest, _) = run(&wheel(0.0, ["upright", "wheel"], "relative_tolerance = 1e-4"));
    for order in [["upright", "wheel"], ["wheel", "upright"]] {
        for spin in [10.0, 72.0, 300.0, 3000.0] {
            let (record, totals, rotors) = run(&wheel(spin, order, "relative_tolerance = 1e-4"));
            assert_eq!(rotors, 1);
            assert!(totals.steps * 5 <= at_rest.steps * 6, "{spin}: {} of {}", totals.steps, at_rest.steps);
            assert!(totals.factorizations <= 5, "{spin}: {}", totals.factorizations);
            let places = difference(&still, &record, "z", "u3");
            assert!(places < 2e-4 * 0.13, "{order:?} at {spin} rad/s: {places}");
            let sign = if order[0] == "wheel" { -1.0 } else { 1.0 };
            let turned = *column(&record, "turn", "angle").last().unwrap();
            assert!((turned - sign * 5.0 * spin).abs() < 1e-7 * spin, "{turned}");
            let energy = column(&record, "energy", "total");
            let change = (energy[energy.len() - 1] - energy[0]).abs();
            assert!(change < 2e-3 + 1e-10 * 0.45 * spin * spin, "{spin}: {change}");
        }
    }
}

/// With planned steps, in which the wheel turns by up to 60 rad, too, the upright moves as with a wheel at rest.
#[test]
fn planned_steps_do_not_see_the_spin() {
    for scheme in ["radau-iia", "radau-iia-5", "radau-iia-9"] {
        for step in ["0.02", "0.005"] {
            let analysis = format!("scheme = \"{scheme}\"\nstep = {step}\n");
            let of = |spin: f64| {
                let text = wheel(spin, ["upright", "wheel"], &analysis);
                run(&text.replace("output_step = 0.1\n", "").replace("end = 5", "end = 2"))
            };
            let (still, at_rest, _) = of(0.0);
            for spin in [70.0, 3000.0] {
                let (record, totals, _) = of(spin);
                let error = difference(&still, &record, "z", "u3");
                assert!(error < 1e-8, "{scheme} at {step} and {spin} rad/s: {error}");
                assert!(totals.factorizations <= at_rest.factorizations + 3, "{}", totals.factorizations);
            }
        }
    }
}

/// A gyroscope in three rings, its rotor at 400 rad/s with its centre beside that of the rings.
const RINGS: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]
[bodies.outer]
mass = 1
inertia = [0.02, 0.01, 0.02]
position = [0, 0, 0]
[bodies.inner]
mass = 0.5
inertia = [0.005, 0.01, 0.005]
position = [0, 0, 0]
[bodies.rotor]
mass = 2
inertia = [0.004, 0.0025, 0.0025]
position = [0.01, 0, 0]
angular_velocity = [400, 0, 0]
[joints.vertical]
kind = "revolute"
base = "ground"
tip = "outer"
axis = [0, 0, 1]
[joints.across]
kind = "revolute"
base = "outer"
tip = "inner"
axis = [0, 1, 0]
[joints.bearing]
kind = "revolute"
base = "inner"
tip = "rotor"
at = [0, 0, 0]
axis = [1, 0, 0]
[outputs.heading]
kind = "relative"
of = "vertical"
[outputs.tilt]
kind = "relative"
of = "across"
[outputs.bearing]
kind = "reaction"
of = "bearing"
[outputs.energy]
kind = "energy"
[analysis]
kind = "dynamics"
end = 3
output_step = 0.05
relative_tolerance = 1e-6
"#;

/// Precession at m g r/(J Ω), and the reactions of its bearing.
#[test]
fn a_gyroscope_in_rings_precesses() {
    let (record, totals, rotors) = run(RINGS);
    assert_eq!(rotors, 1);
    let (reference, before, _) = run(&format!("{RINGS}without = [\"still-axes\"]\n"));
    assert!(totals.steps * 5 < before.steps, "{} {}", totals.steps, before.steps);
    for (name, component, size) in [
        ("heading", "angle", 0.6),
        ("tilt", "angle", 0.6),
        ("bearing", "f3", 20.0),
        ("bearing", "f1", 20.0),
        ("bearing", "m2", 1.0),
    ] {
        let error = difference(&record, &reference, name, component);
        assert!(error < 1e-4 * size, "{name}.{component}: {error}");
    }
    let precession = column(&record, "heading", "angle");
    let rate = precession[precession.len() - 1] / 3.0;
    let expected = 2.0 * 9.81 * 0.01 / (0.004 * 400.0);
    assert!((rate.abs() - expected).abs() < 0.02 * expected, "{rate} {expected}");
}

/// Bodies that are not round, have something beside the axis, or whose joint is held twice move in their own axes.
#[test]
fn what_is_not_symmetric_stays_as_it_is() {
    let of = |from: &str, to: &str| RINGS.replace(from, to);
    let force = "[loads.push]\nkind = \"force\"\non = \"rotor\"\nat = [0, 0.05, 0]\nvector = [0, 0, 1]\n[outputs.heading]";
    let event = "[events.up]\nzero_of = \"sin(bearing.angle) - 0.5\"\ndirection = \"rising\"\nstop = true\n[outputs.heading]";
    let axial = "[loads.push]\nkind = \"moment\"\non = \"rotor\"\nvector = [1, 0, 0]\nfollower = true\n[outputs.heading]";
    for (text, rotors) in [
        (of("[0.004, 0.0025, 0.0025]", "[0.004, 0.0025, 0.0026]"), 0),
        (of("position = [0.01, 0, 0]", "position = [0.01, 0.001, 0]"), 0),
        (of("[outputs.heading]", force), 0),
        (of("[outputs.heading]", event).replace("[outputs.bearing]", "[outputs.held]"), 0),
        (of("[outputs.heading]", axial), 1),
        (RINGS.to_owned(), 1),
    ] {
        assert_eq!(run(&text.replace("end = 3", "end = 0.1")).2, rotors, "{text}");
    }
}

#[test]
fn a_restored_session_continues_to_the_last_bit() {
    for analysis in ["relative_tolerance = 1e-5", "scheme = \"radau-iia\"\nstep = 5e-3"] {
        let text = RINGS.replace("output_step = 0.05\nrelative_tolerance = 1e-6", analysis);
        let session = || Model::from_text("model.toml", &text).session().unwrap();
        let mut whole = session();
        whole.step_to(0.77).unwrap();
        let kept = whole.snapshot().to_bytes();
        whole.step_to(1.5).unwrap();
        let mut other = session();
        other.restore(&lissom::SessionSnapshot::from_bytes(&kept).unwrap()).unwrap();
        other.step_to(1.5).unwrap();
        assert_eq!(whole.simulation().state(), other.simulation().state(), "{analysis}");
    }
}

/// The car turns its wheels by six radians in a step; loads of its tyres are those of steps that resolve them.
#[test]
fn forces_of_a_car_follow_from_long_steps() {
    let car = Model::read(Path::new(&example("car"))).unwrap().with("analysis.end", 3.0);
    let at = |tolerance: f64| run_of(&car.with("analysis.relative_tolerance", tolerance));
    let (record, totals, rotors) = at(1e-4);
    let (fine, ..) = at(1e-7);
    assert!(rotors == 4 && totals.steps < 120, "{rotors} {}", totals.steps);
    for wheel in ["tyre1.road", "tyre3.road"] {
        for component in ["f1", "f2", "f3"] {
            let size =
                column(&fine, wheel, component).iter().fold(0.0_f64, |most, value| most.max(value.abs()));
            let error = difference(&record, &fine, wheel, component);
            assert!(error < 2e-3 * size, "{wheel}.{component}: {error} of {size}");
        }
    }
}
