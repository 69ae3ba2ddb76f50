//! Rotors on supports that are not the same in all directions, against Coleman's equations of ground resonance.

use lissom::AnalysisWarning;
use std::f64::consts::TAU;
use std::fmt::Write;

use lissom::Model;
use lissom::analyses::campbell::{CampbellRequest, campbell};
use lissom::analyses::modes::{ModeRequest, OperatingPoint, modes};
use num_complex::Complex64;

const HINGE: f64 = 0.2;
const ARM: f64 = 0.6;
const BLADE: [f64; 2] = [1.0, 0.08];
const SPRING: f64 = 3.0;
const SUPPORT: [f64; 2] = [6.0, 2.0];
const STIFFNESS: [f64; 2] = [4000.0, 9000.0];

/// Blades with hinges of lag, at equal angles on a hub that is driven, on a support that slides both ways.
fn rotor(blades: usize, speed: f64) -> String {
    let mut text = format!(
        r#"
lissom = 1
[parameters]
speed = {speed:?}
[bodies.saddle]
mass = 1.5
inertia = [1, 1, 1]
[bodies.support]
mass = {:?}
inertia = [1, 1, 1]
[joints.one]
kind = "prismatic"
base = "ground"
tip = "saddle"
axis = [1, 0, 0]
[springs.one]
kind = "axial"
joint = "one"
stiffness = {:?}
[joints.other]
kind = "prismatic"
base = "saddle"
tip = "support"
axis = [0, 1, 0]
[springs.other]
kind = "axial"
joint = "other"
stiffness = {:?}
[bodies.hub]
mass = {:?}
inertia = [0.1, 0.1, 0.2]
angular_velocity = [0, 0, "speed"]
[joints.bearing]
kind = "revolute"
base = "support"
tip = "hub"
axis = [0, 0, 1]
[joints.drive]
kind = "prescribed_rotation"
joint = "bearing"
rotation = "speed*t"
[analysis]
kind = "dynamics"
end = 1
step = 1e-3
"#,
        SUPPORT[0], STIFFNESS[0], STIFFNESS[1], SUPPORT[1]
    );
    for k in 0..blades {
        let angle = TAU * k as f64 / blades as f64;
        let (sine, cosine) = angle.sin_cos();
        let [x, y] = [HINGE + ARM, HINGE].map(|r| (r * cosine, r * sine));
        let tangential =
            [-(HINGE + ARM) * sine, (HINGE + ARM) * cosine].map(|part| format!("\"{part:?}*speed\""));
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "[bodies.blade{k}]\nmass = {:?}\ninertia = [0.001, {i:?}, {i:?}]\nposition = [{:?}, {:?}, 0]\n\
             rotation = [0, 0, {angle:?}]\n\
             velocity = [{}, {}, 0]\nangular_velocity = [0, 0, \"speed\"]\n\
             [joints.hinge{k}]\nkind = \"revolute\"\nbase = \"hub\"\ntip = \"blade{k}\"\nat = [{:?}, {:?}, 0]\naxis = [0, 0, 1]\n\
             [springs.hinge{k}]\nkind = \"torsional\"\njoint = \"hinge{k}\"\nstiffness = {SPRING:?}\n",
            BLADE[0],
            x.0,
            x.1,
            tangential[0],
            tangential[1],
            y.0,
            y.1,
            i = BLADE[1]
        );
    }
    text
}

/// Determinant of Coleman's equations: x with the sine part of the lag angles, y with their cosine part, for N ≥ 3 blades
/// [Coleman and Feingold 1958].
fn determinant(blades: f64, speed: f64, s: Complex64) -> Complex64 {
    let (static_moment, inertia) = (BLADE[0] * ARM, BLADE[1] + BLADE[0] * ARM * ARM);
    let stiffness = SPRING + speed * speed * HINGE * static_moment;
    let masses = [1.5 + SUPPORT[0], SUPPORT[0]].map(|mass| mass + SUPPORT[1] + blades * BLADE[0]);
    let own = inertia * (s * s - speed * speed) + stiffness;
    let turning = 2.0 * inertia * speed * s;
    let across = static_moment * s * s;
    let [x, y] = [0, 1].map(|k| masses[k] * s * s + STIFFNESS[k]);
    // [own, turning; -turning, own] [c; d] = across [-y; x],  X x = N/2 across d,  Y y = -N/2 across c
    let (p, q) = (0.5 * blades * across * across / x, 0.5 * blades * across * across / y);
    ((own - q) * (own - p) + turning * turning) * x * y
}

/// The root of the determinant near `s`, by secants.
fn root_near(blades: f64, speed: f64, s: Complex64) -> Complex64 {
    let (mut last, mut here) = (s * 1.0001, s);
    let (mut of_last, mut of_here) = (determinant(blades, speed, last), determinant(blades, speed, here));
    for _ in 0..30 {
        let change = of_here * (here - last) / (of_here - of_last);
        if change.norm().is_nan() || change.norm() <= 1e-14 * here.norm() {
            break;
        }
        (last, of_last) = (here, of_here);
        here -= change;
        of_here = determinant(blades, speed, here);
    }
    here
}

#[test]
fn blades_on_a_support_of_two_stiffnesses_resonate_as_coleman_says() {
    for blades in [3, 4, 5] {
        let mut has_flutter = false;
        for speed in [3.0, 12.0, 20.0, 24.0, 40.0] {
            let text = rotor(blades, speed);
            let ask = ModeRequest {
                count: Some(8),
                about: Some(OperatingPoint::Rotation),
                ..ModeRequest::default()
            };
            let found = modes(&Model::from_text("model.toml", &text), &ask)
                .unwrap_or_else(|error| panic!("{blades} blades at {speed}: {error}"));
            assert!(found.warnings.contains(&AnalysisWarning::AxesAtRest), "{:?}", found.warnings);
            // Two of the support, two of the lag that it feels; those that it does not feel: N - 2 of the blade alone.
            let alone = {
                let (moment, inertia) = (BLADE[0] * ARM, BLADE[1] + BLADE[0] * ARM * ARM);
                ((SPRING + speed * speed * HINGE * moment) / inertia).sqrt()
            };
            let mut felt = 0;
            for mode in &found.modes {
                let s = mode.eigenvalue;
                // Of five blades two patterns go round twice as fast.
                let patterns = [0.0, 2.0, -2.0].map(|turns| (alone + turns * speed).abs());
                if patterns.iter().any(|seen| (s.im - seen).abs() < 1e-6 * alone) && s.re.abs() < 1e-6 * alone
                {
                    continue;
                }
                let exact = root_near(blades as f64, speed, s);
                assert!(
                    (s - exact).norm() < 1e-6 * exact.norm(),
                    "{blades} blades at {speed}: {s} for {exact}"
                );
                felt += 1;
                has_flutter |= s.re > 1e-3 * s.norm();
            }
            assert!(felt >= 4, "{blades} blades at {speed}: {}", found.csv());
        }
        assert!(has_flutter, "{blades} blades: ground resonance is met at one of these speeds");
    }
}

#[test]
fn modes_of_two_blades_are_left_out_with_the_reason() {
    let ask = ModeRequest { count: Some(6), about: Some(OperatingPoint::Rotation), ..ModeRequest::default() };
    // Both blades against each other do not move the hub: that mode alone has constant coefficients.
    let found = modes(&Model::from_text("model.toml", &rotor(2, 12.0)), &ask).expect("one mode is constant");
    assert_eq!(found.modes.len(), 1, "{}", found.csv());
    let reason = "a rotor of two blades has no constant coefficients";
    assert!(
        found
            .warnings
            .iter()
            .map(ToString::to_string)
            .any(|words| words.starts_with("3 of 4 modes are omitted") && words.contains(reason))
    );
    assert!(!found.warnings.iter().any(|own| own.code() == "linearization-kink"), "{:?}", found.warnings);
    // Three blades of which one has a stiffer hinge are where equal ones do: what is found there is put to the test.
    let uneven = rotor(3, 12.0).replacen("stiffness = 3.0", "stiffness = 30.0", 1);
    let words = match modes(&Model::from_text("model.toml", &uneven), &ask) {
        Err(error) => error.to_string(),
        Ok(found) => found.warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"),
    };
    assert!(words.contains("they also change in multi-blade coordinates"), "{words}");
}

#[test]
fn a_diagram_has_the_frequencies_at_rest() {
    let ask = CampbellRequest {
        vary: "parameters.speed=2:12:6".parse().unwrap(),
        count: 8,
        shift: None,
        averaged: false,
        rays: vec![1],
    };
    let found = campbell(&Model::from_text("model.toml", &rotor(3, 2.0)), &ask)
        .unwrap_or_else(|error| panic!("{error}"));
    for point in &found.points {
        let mut whirls = 0;
        for of in &point.modes {
            let seen = of.seen().expect("one frequency in axes at rest");
            assert!((seen - of.mode.frequency).abs() <= 1e-12 * seen);
            whirls += usize::from(of.whirl.name() != "none");
        }
        assert!(whirls >= 4, "{}", found.csv());
    }
}
