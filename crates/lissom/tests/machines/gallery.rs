//! The models of `docs/gallery.md`, each against a formula.

use std::f64::consts::{PI, TAU};

use lissom::Model;
use lissom::analyses::modes::{ModeRequest, OperatingPoint, modes};

use crate::support::runs::{column, last, run, session};

macro_rules! model {
    ($name:literal) => {
        include_str!(concat!("../../../../examples/", $name, ".toml"))
    };
}

const GRAVITY: f64 = 9.81;

fn close(found: f64, wanted: f64, tolerance: f64, what: &str) {
    assert!((found - wanted).abs() < tolerance, "{what}: {found}, not {wanted}");
}

/// x = r cos θ + (l² - r² sin² θ)^½, and at the outer dead centre x'' = -r ω² (1 + r/l).
#[test]
fn the_piston_moves_as_its_mechanism_says() {
    let record = run(model!("slider-crank-3500rpm"), &[]);
    let (crank, rod, speed) = (0.045, 0.15, 3500.0 * 2.0 * PI / 60.0);
    let place = column(&record, "piston", "x");
    for (time, x) in record.times.iter().zip(place) {
        let (sine, cosine) = (speed * time).sin_cos();
        let wanted = crank * cosine + (rod * rod - (crank * sine).powi(2)).sqrt();
        close(*x, wanted, 1e-10, "piston");
    }
    let acceleration = column(&record, "piston_acceleration", "a1");
    let wanted = -crank * speed * speed * (1.0 + crank / rod);
    for turn in 0..4 {
        // Within what 200 steps per turn resolve: 6.7e-4, a quarter of that with half the step.
        close(acceleration[turn * 200], wanted, 7e-4 * wanted.abs(), "acceleration at the dead centre");
    }
}

/// The springs keep pulling at the latches: k_s (3π/4 - φ) = k (φ - π/2). Nothing turns the satellite from outside.
#[test]
fn booms_latch_and_the_angular_momentum_stays_zero() {
    // Records are interpolated within the steps, and the momentum with them.
    let record = run(model!("satellite-latching-booms"), &[("analysis.relative_tolerance", "1e-9")]);
    let wanted = (0.4 * 0.75 * PI + 4e3 * 0.5 * PI) / 4000.4;
    for hinge in ["left_hinge", "right_hinge"] {
        close(last(&record, hinge, "angle"), wanted, 1e-7, hinge);
        close(last(&record, hinge, "rate"), 0.0, 1e-7, hinge);
    }
    let momentum = column(&record, "momentum", "l3");
    assert!(momentum.iter().all(|l| l.abs() < 1e-7), "{momentum:?}");
    // The hub has turned against the booms.
    assert!(last(&record, "hub", "r3").abs() > 0.01);
}

#[test]
fn a_load_in_a_slack_cable_jerks_as_its_energy_says() {
    let record = run(model!("crane-slack-cable"), &[]);
    let force = column(&record, "cable", "force");
    let (mass, stiffness, drop) = (500.0, 4e5, 0.6);
    let weight = mass * GRAVITY;
    let wanted = weight * (1.0 + (1.0 + 2.0 * stiffness * drop / weight).sqrt());
    let most = force.iter().fold(0.0_f64, |most, force| most.max(*force));
    // Records do not meet the peak itself.
    close(most, wanted, 1e-3 * wanted, "jerk");
    assert!(force.iter().all(|force| *force >= 0.0), "a cable does not push");
    for ((time, z), force) in record.times.iter().zip(column(&record, "load", "z")).zip(force) {
        if *time < (2.0 * drop / GRAVITY).sqrt() {
            close(*z, -7.4 - 0.5 * GRAVITY * time * time, 1e-8, "free fall");
            assert!(*force == 0.0, "slack at {time}");
        }
    }
}

#[test]
fn rotors_rattle_in_their_backlash_with_the_period_of_the_formula() {
    let record = run(model!("gearbox-backlash"), &[]);
    let (play, speed, inertia, stiffness) = (0.05_f64, 1.0, 0.02_f64, 2e4);
    let wanted = 2.0 * play / speed + 2.0 * PI * (inertia / (2.0 * stiffness)).sqrt();
    let (times, rate) = (&record.times, column(&record, "coupling", "rate"));
    let rising: Vec<f64> = (1..rate.len())
        .filter(|&k| rate[k - 1] < 0.0 && rate[k] >= 0.0)
        .map(|k| times[k] - rate[k] * (times[k] - times[k - 1]) / (rate[k] - rate[k - 1]))
        .collect();
    assert!(rising.len() > 8, "{rising:?}");
    let period = (rising[rising.len() - 1] - rising[0]) / (rising.len() - 1) as f64;
    close(period, wanted, 5e-5 * wanted, "period");
    let sum = last(&record, "driver", "w3") + last(&record, "driven", "w3");
    close(sum, speed, 1e-9, "angular momentum");
}

/// The train turns as one body under the torque, and its two rotors swing against each other about that.
#[test]
fn a_drive_train_turns_and_swings_as_two_oscillators() {
    let record = run(model!("drive-train"), &[]);
    let (motor, torque, shaft, ratio) = (0.02_f64, 2.0, 800.0, 0.25_f64);
    let load = 0.05 + ratio * ratio * 0.8;
    let frequency = (shaft * (1.0 / motor + 1.0 / load)).sqrt();
    let at_rest = torque / (motor * frequency * frequency);
    for (row, &time) in record.times.iter().enumerate() {
        let mean = 0.5 * torque / (motor + load) * time * time;
        let twist = at_rest * (1.0 - (frequency * time).cos());
        let wanted = [mean + load / (motor + load) * twist, mean - motor / (motor + load) * twist];
        for (k, wanted) in wanted.into_iter().enumerate() {
            let found = column(&record, "train", &format!("angle{}", k + 1))[row];
            close(found, wanted, 1e-4, "rotor");
        }
        close(column(&record, "hinge", "angle")[row], ratio * wanted[1], 2.5e-5, "arm");
    }
}

/// Deflection of the middle under a force that moves at constant speed [Fryba 1999, chapter 1].
#[test]
fn a_force_crosses_a_bridge_as_the_series_says() {
    let record = run(model!("bridge-crossing"), &[]);
    let (length, speed, force, per_length, bending) = (12.0_f64, 12.0, 2000.0, 60.0_f64, 8e6_f64);
    let at_rest = force * length.powi(3) / (48.0 * bending);
    for (time, found) in record.times.iter().zip(column(&record, "middle", "u3")) {
        let wave = |n: u32| {
            let number = f64::from(n) * PI / length;
            let (own, passing) = (number * number * (bending / per_length).sqrt(), number * speed);
            let moved = (passing * time).sin() - passing / own * (own * time).sin();
            2.0 * force / (per_length * length) * (0.5 * number * length).sin() * moved
                / (own * own - passing * passing)
        };
        let wanted: f64 = (1..40).map(wave).sum();
        close(-found, wanted, 5e-3 * at_rest, "deflection");
    }
    let place = last(&record, "wheel", "x");
    close(place, speed * 0.99, 1e-2, "place of the wheel");
}

/// I ζ'' + c ζ' + Ω² e S ζ = 0, for swings of a hundredth.
#[test]
fn a_blade_swings_in_lag_as_the_linear_formula_says() {
    let record = run(model!("rotor-lag-damper"), &[]);
    let (mass, length, offset, speed, damper, start) = (40.0_f64, 4.75, 0.25, 30.0, 1000.0, 0.01);
    let (inertia, moment) = (mass * length * length / 3.0, mass * length / 2.0);
    let decay = damper / (2.0 * inertia);
    let own = (speed * speed * offset * moment / inertia - decay * decay).sqrt();
    for (time, lag) in record.times.iter().zip(column(&record, "lag", "angle")) {
        let (sine, cosine) = (own * time).sin_cos();
        let wanted = start * (-decay * time).exp() * (cosine + decay / own * sine);
        close(*lag, wanted, 3e-7, "lag");
    }
}

/// After one turn of the precession the disc is where it began; its centre has stayed on its height.
#[test]
fn a_coin_comes_back_after_one_turn() {
    let record = run(model!("rolling-disc"), &[]);
    for (axis, wanted) in [("x", 0.0), ("y", 0.0), ("z", 0.2 * 1.1_f64.sin())] {
        close(last(&record, "disc", axis), wanted, 1e-6, axis);
    }
    let sideways = column(&record, "disc", "x");
    let reach = sideways.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    // Twice the radius r |n|/Ω of the circle.
    let (sine, cosine) = 1.1_f64.sin_cos();
    let spin = (0.2 * 9.0 * sine * cosine - 4.0 * GRAVITY * cosine) / (6.0 * 0.2 * 3.0 * sine);
    close(reach, 2.0 * 0.2 * spin.abs() / 3.0, 1e-6, "across its circle");
}

/// Five-stage Radau IIA applied to the equations of Simeon, Fuehrer and Rentrop 1991.
#[test]
fn a_wheelset_hunts_as_its_published_equations_say() {
    let record = run(model!("wheelset"), &[]);
    for (output, component, wanted, tolerance) in [
        ("centre", "x", 6.352_810_191_808_55e-3, 1e-6),
        ("theta", "value", -1.237_512_572_701_34e-2, 2e-6),
        ("phi", "value", 1.125_033_043_872_30e-3, 2e-7),
        ("beta", "value", -1.834_646_352_315_05e-1, 5e-5),
    ] {
        close(last(&record, output, component), wanted, tolerance, output);
    }
}

#[test]
fn a_mass_on_a_shaking_table_swings_at_both_rates() {
    let record = run(model!("shaking-table"), &[]);
    let (own, ground, amplitude) = (12.0_f64, 8.0_f64, 0.01);
    for (time, x) in record.times.iter().zip(column(&record, "mass", "x")) {
        let ratio = ground / own;
        let swing = (ground * time).sin() - ratio * (own * time).sin();
        close(x - 0.5, amplitude * swing / (1.0 - ratio * ratio), 1e-6, "mass");
    }
}

/// The errors of both joints decay as e₀ (1 + w t) exp(-w t), whatever the motion.
#[test]
fn computed_torque_leaves_the_errors_of_a_linear_equation() {
    let record = run(model!("computed-torque"), &[]);
    let w = 8.0_f64;
    for (joint, miss, amplitude, rate) in [("shoulder", 0.3, 0.6, 3.0_f64), ("elbow", -0.2, -0.9, 4.0)] {
        for (time, angle) in record.times.iter().zip(column(&record, joint, "angle")) {
            let wanted = amplitude * (1.0 - (rate * time).cos());
            close(angle - wanted, miss * (1.0 + w * time) * (-w * time).exp(), 1e-6, joint);
        }
    }
    let torque = column(&record, "torque", "value");
    assert!(torque.iter().any(|torque| torque.abs() > 20.0), "it has work to do");
}

/// Equal and parallel wishbones only shift the wheel. At rest the tyre carries all, and with φ the angle of the wishbones, the spring's
/// force S and its length l(φ): (W - m_w g) a cos φ - (m_l + m_u) g a/2 cos φ = S dl/dφ.
#[test]
fn a_suspension_comes_to_rest_on_its_kerb_by_virtual_work() {
    let record = run(model!("double-wishbone"), &[]);
    for axis in ["r1", "r2", "r3"] {
        let turn = column(&record, "wheel_turn", axis);
        assert!(turn.iter().all(|angle| angle.abs() < 1e-9), "{axis}");
    }
    let weight = 442.0 * GRAVITY;
    close(last(&record, "tyre", "value"), weight, 1e-4 * weight, "load of the tyre");
    close(last(&record, "wheel", "z"), 0.06 + 0.322 - weight / 2e5, 1e-6, "height of the wheel");
    let free = 0.12_f64.hypot(0.4) + 6500.0 / 4.5e4;
    let unbalanced = |angle: f64| {
        let (sine, cosine) = angle.sin_cos();
        let (across, upward) = (0.22 * cosine - 0.1, 0.22 * sine - 0.4);
        let length = across.hypot(upward);
        let change = 0.22 * (upward * cosine - across * sine) / length;
        (weight - 35.0 * GRAVITY) * 0.35 * cosine
            - 7.0 * GRAVITY * 0.175 * cosine
            - 4.5e4 * (length - free) * change
    };
    let (mut low, mut high) = (-0.3, 0.3);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if unbalanced(low) * unbalanced(middle) <= 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    close(last(&record, "lower_hinge", "angle"), low, 2e-5, "angle of the wishbones");
    let stop = column(&record, "bump_stop", "force");
    let most = stop.iter().fold(0.0_f64, |most, force| most.min(*force));
    assert!(
        most < -1000.0 && stop[0] == 0.0 && stop[stop.len() - 1] == 0.0,
        "the kerb meets the bump stop: {most}"
    );
}

/// The middle of a coupler is where circles about the crank's pin and the rocker's pivot meet; its end is as far beyond. More than half
/// of the legs stand, within a millimetre of their line.
#[test]
fn forty_legs_step_as_their_circles_say() {
    let record = run(model!("walking-linkage"), &[]);
    let mut standing = vec![0; record.times.len()];
    for leg in 1..=40 {
        let [x, z] = ["x", "z"].map(|axis| column(&record, &format!("leg{leg}.middle"), axis));
        for (row, time) in record.times.iter().enumerate() {
            let angle = TAU * (f64::from(leg - 1) / 40.0 + time);
            let pin = [0.1 * angle.cos(), -0.1 * angle.sin()];
            let (along, upward) = (-0.2 - pin[0], -pin[1]);
            let apart = along.hypot(upward);
            let height = (0.25 * 0.25 - 0.25 * apart * apart).sqrt();
            // The rocker's pivot is on the left of every pin: above is on the right of the way there.
            let wanted = [
                pin[0] + 0.5 * along + height * upward / apart,
                pin[1] + 0.5 * upward - height * along / apart,
            ];
            close(x[row], wanted[0], 1e-10, "across");
            close(z[row], wanted[1], 1e-10, "upward");
            let end = 2.0 * z[row] - pin[1];
            assert!(end > 0.4 - 1e-9, "no foot goes below the ground");
            standing[row] += usize::from((end - 0.4).abs() < 1e-3);
        }
    }
    assert!(standing.iter().all(|count| *count > 20), "{standing:?}");
}

/// Every bar of the mast has the slope φ: the middle of the topmost is at 99.5 l sin φ. At rest the drive carries dV/dφ with
/// V = m g l n² sin φ.
#[test]
fn a_mast_of_200_members_grows_as_its_scissors_open() {
    let record = run(model!("deployable-mast"), &[]);
    let smooth = |x: f64| {
        let x = x.clamp(0.0, 1.0);
        x.powi(3) * (10.0 + x * (6.0 * x - 15.0))
    };
    let [x, z] = ["x", "z"].map(|axis| column(&record, "top", axis));
    for (row, time) in record.times.iter().enumerate() {
        let slope = 0.08 + 0.95 * smooth(time / 4.0);
        close(x[row], 0.5 * slope.cos(), 1e-8, "across");
        close(z[row], 99.5 * slope.sin(), 1e-8, "height");
    }
    let wanted = 0.5 * GRAVITY * 100.0 * 100.0 * 1.03_f64.cos();
    close(last(&record, "drive", "moment"), wanted, 1e-6 * wanted, "moment of the drive");
}

/// The belt carries the fan along, up to its stretch. Contacts never pull, and friction is at most 1.25 μ times the normal
/// force, which bristles reach while they begin to slip.
#[test]
fn a_belt_carries_the_fan_along() {
    let record = run(model!("belt-drive"), &[]);
    let [motor, fan] = ["motor", "fan"].map(|name| column(&record, name, "angle"));
    for (motor, fan) in motor.iter().zip(fan) {
        close(*fan, *motor, 0.2, "angle of the fan");
    }
    assert!(last(&record, "fan", "angle") > 2.7);
    let contacts = ["motor_left", "motor_lower", "motor_upper", "fan_right", "fan_lower", "fan_upper"];
    for name in contacts {
        let [normal, friction] = ["normal", "friction"].map(|component| column(&record, name, component));
        for (normal, friction) in normal.iter().zip(friction) {
            assert!(*normal >= -1e-9 && *friction <= 0.625 * normal + 1e-9, "{name}");
        }
    }
}

/// A plate in the wind: stable at 20 m/s, unstable at 21 m/s, and above it a limit cycle, because the lift saturates.
#[test]
fn a_wing_flutters_with_a_limited_amplitude() {
    for (speed, is_stable) in [("20", true), ("21", false)] {
        let set = vec![("parameters.wind".to_owned(), speed.to_owned())];
        let request = ModeRequest {
            count: Some(6),
            shift: Some(20.0),
            about: Some(OperatingPoint::Undeformed),
            ..ModeRequest::default()
        };
        let model = Model::from_text("wing-flutter.toml", model!("wing-flutter"));
        let report = modes(&model.with_overrides(&set), &request).unwrap();
        // States of points whose air hardly moves the wing decay, and are no rigid motions.
        assert!(report.modes.iter().all(|mode| mode.frequency > 0.1));
        let least = report.modes.iter().map(|mode| mode.damping).fold(f64::INFINITY, f64::min);
        assert_eq!(least > 0.0, is_stable, "{speed}: {least}");
    }
    let record = run(model!("wing-flutter"), &[]);
    let twist = column(&record, "twist", "r3");
    let largest = |from: f64, to: f64| {
        let rows = record.times.iter().zip(twist).filter(|(time, _)| (from..to).contains(*time));
        rows.fold(0.0_f64, |most, (_, twist)| most.max(twist.abs()))
    };
    close(largest(1.0, 2.0), largest(2.0, 3.0), 0.02, "amplitude of the limit cycle");
    assert!(largest(2.0, 3.0) > 0.2);
}

/// Cylinders of prescribed length fix the position of the bucket; at rest their force follows from the potential energy by the length.
/// Stick and bucket do not turn against the boom at first: the work of their joints is round-off of their rates.
#[test]
fn joints_that_hold_still_need_no_tangents_if_energy_decays() {
    let text = model!("excavator-arm").replace("relative_tolerance = 1e-6", "step = 5e-3");
    let options = [("analysis.scheme", "energy-decaying"), ("analysis.end", "0.2")];
    let totals = session(&text, &options).run().unwrap().report().totals;
    assert!(totals.factorizations <= 3 && totals.newton_iterations <= 4 * totals.steps, "{totals:?}");
}

#[test]
fn an_excavator_holds_its_load() {
    let record = run(model!("excavator-arm"), &[]);
    close(last(&record, "lift", "displacement"), 0.3, 1e-8, "stroke");
    let force = last(&record, "force", "force");
    // Virtual work: the same pose with a little more stroke.
    let potential = |stroke: &str| {
        let stroke = [("joints.lift_stroke.displacement", stroke)];
        last(&run(model!("excavator-arm"), &stroke), "energy", "potential")
    };
    let step = 1e-3;
    let slope = (potential("\"(0.3 + 1e-3)*smoothstep(t/2)\"")
        - potential("\"(0.3 - 1e-3)*smoothstep(t/2)\""))
        / (2.0 * step);
    close(force.abs(), slope.abs(), 1e-3 * slope.abs(), "force of the cylinder");
    assert!(column(&record, "power", "power").iter().fold(0.0_f64, |most, own| most.max(*own)) > 1e3);
}

/// v = r s sideways, then r s/(a + b) about the vertical.
#[test]
fn a_platform_on_mecanum_wheels_goes_sideways_and_round() {
    let record = run(model!("mecanum-platform"), &[]);
    let at = |time: f64, output: &str, component: &str| {
        let row = record.times.iter().position(|own| *own >= time - 1e-9).expect("a row");
        column(&record, output, component)[row]
    };
    close(at(1.5, "velocity", "v2"), 0.5, 3e-3, "velocity sideways");
    close(at(1.5, "velocity", "v1"), 0.0, 3e-3, "velocity ahead");
    close(at(1.5, "turning", "w3"), 0.0, 1e-2, "turning while going sideways");
    close(last(&record, "turning", "w3"), 0.5 / 0.45, 2e-2, "turning");
}

/// At 900 rad/s the films drive a whirl at almost half of the speed, whose orbit stays within the clearance; at 400 rad/s the shaft rests.
#[test]
fn a_rotor_on_oil_films_whirls_at_half_of_its_speed() {
    let record = run(model!("oil-whirl"), &[]);
    let [y, z] = ["u2", "u3"].map(|component| column(&record, "left", component));
    let from = record.times.iter().position(|own| *own > 0.15).expect("rows");
    let mut turned = 0.0;
    let mut largest = 0.0_f64;
    for k in from..y.len() - 1 {
        turned += (y[k] * z[k + 1] - z[k] * y[k + 1]).atan2(y[k] * y[k + 1] + z[k] * z[k + 1]);
        largest = largest.max(y[k].hypot(z[k]));
    }
    let rate = turned / (record.times[y.len() - 1] - record.times[from]);
    assert!((0.45..0.51).contains(&(rate / 900.0)) && (0.5e-4..1e-4).contains(&largest), "{rate} {largest}");
    let slow = run(model!("oil-whirl"), &[("parameters.speed", "400")]);
    let [y, z] = ["u2", "u3"].map(|component| column(&slow, "left", component));
    let rows = y.len() - 50..y.len() - 1;
    let moved = rows.map(|k| (y[k] - y[k + 1]).hypot(z[k] - z[k + 1])).fold(0.0, f64::max);
    assert!(moved < 1e-6, "{moved}");
}

/// A tool that cuts the wave of the previous revolution chatters beyond the width 2 k ζ (1 + ζ)/K, if the revolution has the phase of the
/// smallest limit: 1.236 mm.
#[test]
fn a_lathe_chatters_beyond_its_limit() {
    for (width, grows) in [("1.21e-3", false), ("1.26e-3", true)] {
        let record = run(model!("turning-chatter"), &[("parameters.width", width)]);
        let displacement = column(&record, "tool", "displacement");
        let range = |from: f64, to: f64| {
            let rows = record.times.iter().zip(displacement).filter(|(time, _)| (from..to).contains(*time));
            let [least, most] =
                rows.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], (_, own)| [a.min(*own), b.max(*own)]);
            most - least
        };
        assert_eq!(range(1.2, 1.5) > range(0.2, 0.5), grows, "{width}");
    }
}
