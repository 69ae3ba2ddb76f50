//! Models of Exudyn and MBDyn that contacts, local loads, forces between points and discrete filters made expressible, in our words.
//! Each has the name of the original file, the quantity, and how its number was obtained: by Exudyn 1.13.6 with ever smaller steps and
//! extrapolation, or by a formula. `docs/coverage.md` lists them.

use std::f64::consts::{PI, TAU};

use lissom::Model;
use lissom::analyses::modes::{ModeRequest, OperatingPoint, modes};

/// A model of another program.
struct Peer {
    /// The original file, and the text of the model with its analysis.
    file: &'static str,
    text: &'static str,
    /// What is compared, the last value of the output `value`.
    quantity: &'static str,
    /// The converged number, and the largest difference from it.
    number: f64,
    within: f64,
    /// How the number was obtained.
    source: &'static str,
}

const PEERS: &[Peer] = &[
    Peer {
        file: "TestModels/createContactSphereSphere.py",
        text: include_str!("two-balls.toml"),
        quantity: "position of the first ball after the impact [m]",
        number: -0.217_048_802_71,
        within: 2e-10,
        source: "Exudyn, steps of 5e-6 to 1.25e-6 s, extrapolated at second order",
    },
    Peer {
        file: "TestModels/contactSphereSphereTest.py",
        text: include_str!("bouncing-ball.toml"),
        quantity: "position after six impacts [m]",
        number: 0.324_146_0,
        within: 3e-7,
        source: "Exudyn, steps of 2e-6 to 5e-7 s, extrapolated at second order",
    },
    Peer {
        file: "Examples/newtonsCradle.py",
        text: include_str!("newtons-cradle.toml"),
        quantity: "displacement of the first ball at 0.5 s, for a coefficient of restitution of 1 [m]",
        number: -0.245_875_25,
        within: 1e-7,
        source: "Exudyn, mean of steps of 6.25e-6 and 3.125e-6 s, which differ by 1e-7",
    },
    Peer {
        file: "Examples/camFollowerExample.py",
        text: include_str!("cam.toml"),
        quantity: "displacement of the follower at 0.53 s [m]",
        number: -0.006_810_127_358,
        within: 1e-10,
        source: "Exudyn, steps of 1.25e-5 and 6.25e-6 s, extrapolated at second order; the face of the follower is one segment, because \
                 the stiffness there is proportional to the length of the segments that a disc touches",
    },
    Peer {
        file: "TestModels/contactCurveExample.py",
        text: include_str!("lever-in-a-tray.toml"),
        quantity: "angle of the lever in the tray at 1 s [rad]",
        number: 2.236_783,
        within: 3e-6,
        source: "Exudyn, steps of 2e-5 to 5e-6 s, which differ by 4e-6",
    },
    Peer {
        file: "TestModels/generalContactImplicit2.py",
        text: include_str!("sliding-ball.toml"),
        quantity: "distance at rest [m]",
        number: 0.5 + 0.5e-8,
        within: 1e-9,
        source: "(v₀² + v_s²)/(2 μ g), with v₀ = 1 m/s, μ g = 1 m/s² and the velocity v_s = 1e-4 m/s below which friction is proportional to \
                 the velocity; Exudyn with steps of 6e-6 s: 0.5000000045",
    },
    Peer {
        file: "TestModels/rotatingTableTest.py",
        text: include_str!("wheel-on-a-turntable.toml"),
        quantity: "angle of the turntable at 2.4 s, with the wheel on a compliant contact of 1e8 N/m [rad]",
        number: 0.186_731_60,
        within: 4e-7,
        source: "Exudyn, steps of 2.5e-4 s, its second variant with a hundred times the stiffness; with 1, 10 and 100 times the stiffness \
                 the difference is 2.2e-5, 2.2e-6 and 2.2e-7: a pressed wheel rolls on a smaller radius here",
    },
    Peer {
        file: "TestModels/hydraulicActuatorSimpleTest.py",
        text: include_str!("hydraulic-arm.toml"),
        quantity: "angle of the arm at 0.4 s [rad]",
        number: 0.024_583_595_76,
        within: 1e-10,
        source: "Exudyn, steps of 2.5e-4 to 6.25e-5 s, extrapolated at first and second order, because its valves follow a step late",
    },
    Peer {
        file: "Examples/HydraulicActuator2Arms.py",
        text: include_str!("two-hydraulic-arms.toml"),
        quantity: "horizontal displacement of the second arm at 2 s [m]",
        number: 0.061_321_416_5,
        within: 2e-10,
        source: "Exudyn, steps of 2.5e-4 to 6.25e-5 s, extrapolated at first and second order",
    },
    Peer {
        file: "TestModels/ANCFcontactCircleTest.py",
        text: include_str!("cable-on-rollers.toml"),
        quantity: "vertical displacement of the end in equilibrium [m]",
        number: -0.466_4,
        within: 1e-3,
        source: "Exudyn, 64 instead of 8 elements, with the same stiffness per length; 48 elements: -0.46695",
    },
    Peer {
        file: "tests/drives/drivecallers/discretefilter (MBDyn)",
        text: include_str!("filtered-force.toml"),
        quantity: "displacement at 1 s [m]",
        number: 0.573_821_381_527_984,
        within: 1e-10,
        source: "difference equation of the filter, and the exact motion of the oscillator between two samples",
    },
];

#[test]
fn models_of_other_programs_have_their_converged_numbers() {
    let mut wrong = Vec::new();
    for peer in PEERS {
        let Peer { file, text, quantity, number, within, source } = peer;
        let model = Model::from_text("model.toml", text);
        let mut session = model.session().unwrap_or_else(|error| panic!("{file}: {error}"));
        let record = session.run().unwrap();
        let found = *record.column("value", "value").expect("an output `value`").last().expect("a record");
        let missed = (found - number).abs();
        // Not a number is wrong, too.
        if missed.is_nan() || missed > *within {
            wrong.push(format!(
                "{file}: {quantity}: {found:e}, {number:e} by {source}: {missed:.1e} for {within:.0e}"
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The filter's difference equation, and the oscillator z'' + z = -f: exactly for the sine, and from sample to sample for the filtered force.
#[test]
fn the_number_of_the_filtered_force_is_that_of_its_difference_equation() {
    const STEP: f64 = 1e-3;
    let omega = 20.0 * PI;
    let feedback = [1.911_197_067_426_073, -0.914_975_834_801_434];
    let feed = [0.000_944_691_843_840, 0.001_889_383_687_680, 0.000_944_691_843_840];
    let (cosine, sine) = (STEP.cos(), STEP.sin());
    let (mut position, mut velocity) = (0.0, 1.0);
    let (mut earlier, mut filtered) = ([0.0; 2], [0.0; 2]);
    for k in 0..1000 {
        let force = 10.0 * (omega * STEP * f64::from(k)).sin();
        let output = feed[0] * force
            + feed[1] * earlier[0]
            + feed[2] * earlier[1]
            + feedback[0] * filtered[0]
            + feedback[1] * filtered[1];
        earlier = [force, earlier[0]];
        filtered = [output, filtered[0]];
        let departure = position + output;
        (position, velocity) =
            (departure * cosine + velocity * sine - output, velocity * cosine - departure * sine);
    }
    let direct = 10.0 / (omega * omega - 1.0) * (omega.sin() - omega * 1.0_f64.sin());
    let peer = PEERS.iter().find(|peer| peer.file.contains("discretefilter")).expect("the filter");
    assert!((position + direct - peer.number).abs() < 1e-12, "{}", position + direct);
}

/// `tests/eig/divergence-beams2` and `-beams3` of MBDyn at Mach 0.6: ω² = ((2 n - 1) π/2)² K/J - q e c c_L', with the slope of the lift
/// that the original states there. With five elements it obtains 27.2488 and 27.3011 Hz instead of 27.32918.
#[test]
fn a_wing_that_can_only_twist_vibrates_more_slowly_in_the_wind() {
    let model = Model::from_text("wing.toml", include_str!("diverging-wing.toml"));
    let request = ModeRequest {
        count: Some(3),
        about: Some(OperatingPoint::Static),
        no_plots: true,
        ..ModeRequest::default()
    };
    let report = modes(&model, &request).unwrap_or_else(|error| panic!("{error}"));
    let dynamic_pressure = 0.5 * 1.225 * (0.6_f64 * 340.0).powi(2);
    for (mode, number) in report.modes.iter().zip([1.0, 3.0, 5.0]) {
        let wanted =
            ((0.5 * PI * number).powi(2) * 2e4 - dynamic_pressure * 0.1 * 7.792_226_013_779_20).sqrt() / TAU;
        assert!((mode.frequency - wanted).abs() < 2e-6 * wanted, "{} for {wanted}", mode.frequency);
    }
}
