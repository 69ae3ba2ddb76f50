//! Modes of rotors under loads that change with the azimuth, averaged over a turn.

use lissom::Model;
use lissom::analyses::campbell::{CampbellRequest, Variation, campbell};
use lissom::analyses::modes::{ModeReport, ModeRequest, ModesError, OperatingPoint, modes};
use lissom::analyses::response::{ResponseRequest, response};

use super::campbell::{peak, turbine};

/// Three blades about the axis z under this gravity; not in steady rotation at the start.
fn under_gravity(gravity: &str) -> String {
    turbine()
        .replace("steady_rotation = true\n", "")
        .replace("[parameters]", &format!("gravity = {gravity}\n[parameters]"))
}

fn of(text: &str, about: OperatingPoint) -> Result<ModeReport, ModesError> {
    let ask = ModeRequest { count: Some(12), about: Some(about), ..ModeRequest::default() };
    modes(&Model::from_text("model.toml", text), &ask)
}

fn assert_equal(one: &ModeReport, other: &ModeReport, tolerance: f64) {
    for mode in &one.modes {
        let apart = |own: &lissom_core::linearized::Mode| (own.eigenvalue - mode.eigenvalue).norm();
        let least = other.modes.iter().map(apart).fold(f64::INFINITY, f64::min);
        assert!(least <= tolerance * mode.eigenvalue.norm().max(1.0), "{}\n{}", one.csv(), other.csv());
    }
}

/// Gravity across the axis has no mean in the axes of the blades, and its component along the axis is constant: the mean over the azimuth is
/// the steady rotation under this component.
#[test]
fn of_gravity_across_the_axis_the_component_along_it_remains() {
    let along = of(&under_gravity("[0, 0, -9.81]"), OperatingPoint::Rotation).unwrap();
    assert!(of(&under_gravity("[3, 0, -9.81]"), OperatingPoint::Rotation).is_err());
    let tilted = of(&under_gravity("[3, 0, -9.81]"), OperatingPoint::AveragedRotation).unwrap();
    let no_gravity = of(&under_gravity("[0, 0, 0]"), OperatingPoint::AveragedRotation).unwrap();
    // In axes at rest the frequencies of whirling modes differ by the rotation; collective ones do not.
    let collective = |found: &ModeReport| found.modes.iter().map(|own| own.frequency).fold(0.0, f64::max);
    assert!(collective(&tilted) > 0.0 && collective(&no_gravity) > 0.0);
    let mean_along = of(&under_gravity("[0, 0, -9.81]"), OperatingPoint::AveragedRotation).unwrap();
    assert_equal(&tilted, &mean_along, 1e-7);
    // The sag by the constant component is visible in the modes.
    let largest = tilted.modes.iter().map(|mode| {
        let apart = no_gravity.modes.iter().map(|own| (own.eigenvalue - mode.eigenvalue).norm());
        apart.fold(f64::INFINITY, f64::min) / mode.eigenvalue.norm().max(1.0)
    });
    assert!(largest.fold(0.0, f64::max) > 1e-5);
    // Every frequency in the axes of the blades is found at rest with, against or without the rotation.
    for mode in along.modes.iter().filter(|own| own.frequency > 0.1) {
        let seen = |rate: f64| {
            [0.0, 20.0, -20.0].iter().any(|turn| {
                mean_along
                    .modes
                    .iter()
                    .any(|own| ((rate + turn).abs() - own.eigenvalue.im).abs() < 1e-5 * rate)
            })
        };
        assert!(seen(mode.eigenvalue.im), "{}\n{}", along.csv(), mean_along.csv());
    }
}

/// A run under gravity across the axis has the averaged frequencies: its blades are struck, and nothing is averaged in time.
#[test]
fn a_struck_rotor_under_gravity_has_the_averaged_frequencies() {
    let text = under_gravity("[0, -9.81, 0]");
    let found = of(&text, OperatingPoint::AveragedRotation).unwrap();
    assert!(found.warnings.is_empty(), "{:?}", found.warnings);
    let record = Model::from_text("model.toml", &text).session().unwrap().run().unwrap().into_record();
    let from = record.times.iter().position(|&time| time > 0.4).unwrap();
    // Flap of all blades together is at the same frequency in both axes.
    let signal = &record.column("tip", "z").unwrap()[from..];
    let (seen, nearest) = found
        .modes
        .iter()
        .filter(|own| own.frequency > 3.5)
        .map(|own| (own.eigenvalue.im, peak(signal, 4e-3, own.eigenvalue.im)))
        .map(|(rate, (seen, [there, beside]))| (seen / rate - 1.0, there / beside))
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .unwrap();
    assert!(seen.abs() < 2e-3 && nearest > 10.0, "{seen} {nearest} in {}", found.csv());
}

/// Diagrams with and without gravity across the axis are equal here, and a rotor that a mean moment accelerates has none.
#[test]
fn diagrams_are_averaged_on_request_and_a_driven_rotor_that_turns_freely_has_none() {
    let ask = |averaged| CampbellRequest {
        vary: Variation { path: "parameters.speed".to_owned(), from: 15.0, to: 25.0, values: 2 },
        count: 5,
        shift: None,
        averaged,
        rays: vec![1],
    };
    let diagram = |gravity: &str, averaged| {
        campbell(&Model::from_text("model.toml", &under_gravity(gravity)), &ask(averaged))
    };
    let (with, without) = (diagram("[9.81, 0, 0]", true).unwrap(), diagram("[0, 0, 0]", true).unwrap());
    for (with, without) in with.points.iter().zip(&without.points) {
        for (with, without) in with.modes.iter().zip(&without.modes) {
            assert!(
                (with.mode.frequency - without.mode.frequency).abs() < 1e-6,
                "{} {}",
                with.mode.frequency,
                without.mode.frequency
            );
        }
    }
    let refused = diagram("[9.81, 0, 0]", false).expect_err("it is not steady").to_string();
    assert!(refused.contains("averaged"), "{refused}");
    let driven = under_gravity("[9.81, 0, 0]")
        + "[loads.motor]\nkind = \"joint_torque\"\njoint = \"bearing\"\ntorque = 5\n";
    let error = of(&driven, OperatingPoint::AveragedRotation).expect_err("it accelerates").to_string();
    assert!(error.contains("steady rotation"), "{error}");
}

/// Loads that do not balance at the speed are named by their power.
#[test]
fn a_rotor_out_of_balance_names_its_power() {
    let text = "lissom = 1\n[bodies.disc]\nmass = 1\ninertia = [1, 1, 2]\nangular_velocity = [0, 0, 3]\n\
        [joints.bearing]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"disc\"\naxis = \"z\"\n\
        [loads.motor]\nkind = \"joint_torque\"\njoint = \"bearing\"\ntorque = 5\n[analysis]\nkind = \"dynamics\"\nend = 1\n";
    let error = of(text, OperatingPoint::Rotation).expect_err("it accelerates").to_string();
    assert!(error.contains("loads do 15 W") && error.contains("prescribed_rotation"), "{error}");
}

/// A mean over the azimuth is no state, and two blades have no coordinates for it.
#[test]
fn what_has_no_mean_is_reported() {
    let text = under_gravity("[0, -9.81, 0]");
    let model = Model::from_text("model.toml", &text);
    let ask: ResponseRequest = serde_json::from_str(
        r#"{"inputs": ["strike"], "outputs": ["tip.x"], "from": 1, "to": 2, "points": 2, "about": "averaged-rotation"}"#,
    )
    .unwrap();
    let error = response(&model, &ask).expect_err("it has no state").to_string();
    assert!(error.contains("modes are computed only"), "{error}");
    let lump = "[bodies.lump]\nmass = 0.1\nposition = [0.1, 0, 0]\ninertia = [1e-3, 1e-3, 1e-3]\n\
                [joints.lump]\nkind = \"clamp\"\nbase = \"hub\"\ntip = \"lump\"\n";
    match of(&(text + lump), OperatingPoint::AveragedRotation) {
        Err(ModesError::NoMean(reason)) => assert!(reason.contains("periodic"), "{reason}"),
        other => panic!("{:?}", other.map(|found| found.csv())),
    }
}
