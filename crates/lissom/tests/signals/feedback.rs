//! Feedback: sizes of loads that depend on the motion, first-order states, samples, inputs. Solutions are compared
//! with closed forms and with recursions.

use crate::support::refused;
use crate::support::sessions;

use refused::refused;
use sessions::{finished, session};

/// Moment of inertia of the arm about its hinge: 0.1 + 2 · 0.5² [kg m²].
const INERTIA: f64 = 0.6;

const ARM: &str = r#"
lissom = 1
[bodies.bar]
mass = 2
inertia = [0.1, 0.1, 0.1]
position = [0.5, 0, 0]
[joints.arm]
kind = "revolute"
base = "ground"
tip = "bar"
at = [0, 0, 0]
axis = [0, 0, 1]
[outputs.tip]
kind = "position"
of = "bar"
point = [1, 0, 0]
[outputs.speed]
kind = "velocity"
of = "bar"
point = [1, 0, 0]
[outputs.arm]
kind = "relative"
of = "arm"
[analysis]
kind = "dynamics"
"#;

/// The arm with more tables, and keys of its analysis.
fn arm(tables: &str, analysis: &str) -> String {
    format!(
        "{}\n{tables}",
        ARM.replace("kind = \"dynamics\"\n", &format!("kind = \"dynamics\"\n{analysis}\n"))
    )
}

const CONTROL: &str = r#"
[loads.motor]
kind = "joint_torque"
joint = "arm"
torque = "-200*(arm.rotation - 0.5*sin(t)) - 10*arm.rate"
"#;

/// θ'' + 2 δ θ' + ω² θ = ω² a sin t from rest: the forced solution and a decaying one that makes the start.
fn controlled(time: f64) -> f64 {
    let (a, delta, square) = (0.5, 0.5 * 10.0 / INERTIA, 200.0 / INERTIA);
    let (p, q) = (square - 1.0, 2.0 * delta);
    let n = p * p + q * q;
    // Forced: b sin t + c cos t.
    let (b, c) = (square * a * p / n, -square * a * q / n);
    let frequency = (square - delta * delta).sqrt();
    let (u, v) = (-c, (-b - delta * c) / frequency);
    let decay = (-delta * time).exp();
    b * time.sin() + c * time.cos() + decay * (u * (frequency * time).cos() + v * (frequency * time).sin())
}

#[test]
fn a_controlled_arm_moves_as_its_linear_equation_says() {
    let end = 0.4;
    for (scheme, step, most) in [
        ("radau-iia", 2.5e-4, 1e-8),
        ("radau-iia-5", 2.5e-4, 1e-8),
        ("energy-decaying", 2.5e-4, 1e-8),
        ("generalized-alpha", 2e-5, 1e-8),
        ("hht", 2e-5, 1e-8),
    ] {
        let analysis = format!("scheme = \"{scheme}\"\nend = {end}\nstep = {step}\ntolerance = 1e-10");
        let session = finished(&arm(CONTROL, &analysis));
        let error = (session.value("arm.angle").unwrap() - controlled(end)).abs();
        assert!(error < most, "{scheme}: {error:e}");
    }
}

/// The same through signals, a moment on the body and the motion of a point gives the same motion.
#[test]
fn components_of_points_are_fed_back_as_well() {
    let tables = r#"
[parameters]
k = 200
[inputs]
amplitude = 0.5
[signals]
error = "atan2(tip.y, tip.x) - amplitude*sin(t)"
damping = "10*(tip.x*speed.v2 - tip.y*speed.v1)"
[loads.motor]
kind = "moment"
on = "bar"
vector = [0, 0, 1]
scale = "-k*error - damping"
[outputs.error]
kind = "signal"
of = "error"
"#;
    let session =
        finished(&arm(tables, "scheme = \"radau-iia\"\nend = 0.4\nstep = 2.5e-4\ntolerance = 1e-10"));
    let error = (session.value("arm.angle").unwrap() - controlled(0.4)).abs();
    assert!(error < 1e-8, "{error:e}");
    let signal = session.value("error").unwrap();
    assert!((signal - (controlled(0.4) - 0.5 * 0.4_f64.sin())).abs() < 1e-8, "{signal}");
    assert_eq!(session.value("error.value"), Some(signal));
    assert_eq!(session.value("amplitude"), Some(0.5));
    assert_eq!(session.value("nothing"), None);
}

/// x' = -2 x + sin 3t, and a stiff feedback through a state.
#[test]
fn states_are_integrated_with_the_order_of_the_scheme() {
    let tables = r#"
[states]
filtered = { derivative = "-2*filtered + sin(3*t)", start = 0.7 }
[outputs.filtered]
kind = "signal"
of = "filtered"
"#;
    let exact = |t: f64| {
        let forced = |t: f64| (2.0 * (3.0 * t).sin() - 3.0 * (3.0 * t).cos()) / 13.0;
        forced(t) + (0.7 - forced(0.0)) * (-2.0 * t).exp()
    };
    for (scheme, order) in [
        ("generalized-alpha", 2.0),
        ("generalized-alpha\"\nspectral_radius = 0\n#\"", 2.0),
        ("generalized-alpha\"\nspectral_radius = 1\n#\"", 2.0),
        ("hht", 2.0),
        ("hht\"\nalpha = -0.3\n#\"", 2.0),
        ("radau-iia", 3.0),
        ("radau-iia-5", 5.0),
        ("energy-decaying", 3.0),
    ] {
        let error = |step: f64| {
            let analysis = format!("end = 2\nstep = {step}\ntolerance = 1e-12\nscheme = \"{scheme}\"");
            (finished(&arm(tables, &analysis)).value("filtered").unwrap() - exact(2.0)).abs()
        };
        let (coarse, fine) = (error(0.02), error(0.01));
        let found = (coarse / fine).log2();
        assert!((found - order).abs() < 0.2, "{scheme}: {coarse:e} {fine:e}, order {found}");
    }
}

/// An integrator in the loop: the orders hold for the motion it drives.
#[test]
fn a_state_in_the_loop_keeps_the_order() {
    let tables = r#"
[states.integral]
derivative = "arm.rotation - 0.3"
[loads.motor]
kind = "joint_torque"
joint = "arm"
torque = "-60*(arm.rotation - 0.3) - 8*arm.rate - 90*integral - 2*integral^3"
"#;
    for (scheme, order) in [
        ("generalized-alpha", 2.0),
        ("hht", 2.0),
        ("radau-iia", 3.0),
        ("radau-iia-5", 5.0),
        ("energy-decaying", 3.0),
    ] {
        let value = |step: f64| {
            let analysis = format!("scheme = \"{scheme}\"\nend = 0.5\nstep = {step}\ntolerance = 1e-12");
            let session = finished(&arm(tables, &analysis));
            [session.value("arm.angle").unwrap(), session.value("integral").unwrap()]
        };
        let [coarse, middle, fine] = [0.01, 0.005, 0.0025].map(value);
        for k in 0..2 {
            let found = ((coarse[k] - middle[k]) / (middle[k] - fine[k])).abs().log2();
            assert!((found - order).abs() < 0.35, "{scheme} {k}: order {found}");
        }
    }
}

/// With chosen steps a state of its own decides about them where nothing moves.
#[test]
fn chosen_steps_resolve_states() {
    let tables = "[states]\nspike = { derivative = \"-spike + 50*exp(-2000*(t - 0.5)^2)\", start = 1 }\n";
    // A fine run of fixed steps is the reference.
    let fixed = finished(&arm(tables, "scheme = \"radau-iia\"\nend = 1\nstep = 2e-4\ntolerance = 1e-12"));
    let wanted = fixed.value("spike").unwrap();
    for (tolerance, most) in [(1e-4, 2e-3), (1e-6, 2e-5)] {
        let analysis = format!("scheme = \"radau-iia\"\nend = 1\nrelative_tolerance = {tolerance}");
        let error = (finished(&arm(tables, &analysis)).value("spike").unwrap() - wanted).abs();
        assert!(error < most, "{tolerance}: {error:e}");
    }
}

const SAMPLED: &str = r#"
[signals]
measured = { value = "arm.rotation", sample = 0.01 }
sum = { value = "sum + 0.01*(0.2 - measured)", sample = 0.01 }
torque = "4*(0.2 - measured) + 3*sum"
[loads.motor]
kind = "joint_torque"
joint = "arm"
torque = "torque"
"#;

/// Between samples the torque is constant, so that the motion is a parabola: θ, ω by recursion.
fn sampled(samples: usize) -> [f64; 3] {
    let (mut angle, mut rate, mut sum, period) = (0.0, 0.0, 0.0, 0.01);
    for _ in 0..samples {
        sum += 0.01 * (0.2 - angle);
        let acceleration = (4.0 * (0.2 - angle) + 3.0 * sum) / INERTIA;
        angle += period * rate + 0.5 * period * period * acceleration;
        rate += period * acceleration;
    }
    [angle, rate, sum]
}

#[test]
fn samples_are_held_and_steps_land_on_them() {
    // Steps that divide the period, do not fit it, and are longer; and chosen ones.
    for step in ["step = 2.5e-3", "step = 7e-3", "step = 0.035", "relative_tolerance = 1e-6"] {
        for scheme in ["radau-iia", "radau-iia-5", "energy-decaying", "generalized-alpha", "hht"] {
            let analysis = format!("scheme = \"{scheme}\"\nend = 0.6\n{step}\ntolerance = 1e-11");
            let session = finished(&arm(SAMPLED, &analysis));
            let [angle, rate, _] = sampled(60);
            for (name, wanted) in [("arm.angle", angle), ("arm.rate", rate)] {
                let found = session.value(name).unwrap();
                assert!((found - wanted).abs() < 1e-9, "{scheme}, {step}: {name} {found} {wanted}");
            }
            // At the end the sample of the end is taken.
            let sum = sampled(60)[2] + 0.01 * (0.2 - angle);
            assert!((session.value("sum").unwrap() - sum).abs() < 1e-9, "{step}");
        }
    }
}

/// The acceleration that a sample reads is that before its torque acts: s₀ = 0.3/I, s_k = (0.3 - 0.5 s_{k-1})/I.
#[test]
fn samples_read_accelerations_before_they_act() {
    const READ: &str = r#"
[outputs.second]
kind = "relative_acceleration"
of = "arm"
[outputs.hinge]
kind = "reaction"
of = "arm"
[signals]
seen = { value = "second.a", sample = 0.01 }
twice = { value = "2*moment.value", sample = 0.01 }
[outputs.moment]
kind = "expression"
value = "hinge.f1*0.1 + second.a"
[loads.motor]
kind = "joint_torque"
joint = "arm"
torque = "0.3 - 0.5*seen"
"#;
    for scheme in ["radau-iia", "generalized-alpha", "energy-decaying"] {
        let analysis = format!("scheme = \"{scheme}\"\nend = 0.2\nstep = 2.5e-3\ntolerance = 1e-12");
        let session = finished(&arm(READ, &analysis));
        let (mut seen, mut rate) = (0.3 / INERTIA, 0.0);
        for _ in 0..20 {
            let acceleration = (0.3 - 0.5 * seen) / INERTIA;
            rate += 0.01 * acceleration;
            seen = acceleration;
        }
        for (name, wanted) in [("arm.rate", rate), ("seen", seen)] {
            let found = session.value(name).unwrap();
            assert!((found - wanted).abs() < 1e-9, "{scheme}: {name} {found} {wanted}");
        }
        assert!(session.value("twice").unwrap().is_finite(), "{scheme}");
    }
}

/// A torque of 0.3 N m makes the kinetic energy 0.075 t² J: it passes 0.003 J at 0.2 s, which a sample sees.
#[test]
fn events_of_sampled_energies_happen_at_samples() {
    const READ: &str = r#"
[outputs.all]
kind = "energy"
[signals]
energy = { value = "all.kinetic", sample = 0.03 }
[events.enough]
zero_of = "energy - 0.003"
stop = true
[loads.motor]
kind = "joint_torque"
joint = "arm"
torque = 0.3
"#;
    let mut session = session(&arm(READ, "scheme = \"radau-iia\"\nend = 0.5\nstep = 0.01"));
    let _ = session.run();
    let time = session.simulation().state().kinematics.time;
    // The step that begins at the sample ends at once.
    assert!((time - 0.21).abs() < 1e-6, "{time}");
}

/// A spring is fed by quantities of frames: the arm as a pendulum on cardan angles is that on its coordinate.
#[test]
fn quantities_of_frames_feed_loads_as_coordinates_do() {
    let with = |torque: &str| {
        let tables = format!(
            "[outputs.axes]\nkind = \"cardan_angles\"\nof = \"bar\"\n\
             [outputs.own]\nkind = \"relative_motion\"\nof = \"arm\"\n\
             [outputs.quaternion]\nkind = \"quaternion\"\nof = \"bar\"\n\
             [outputs.sum]\nkind = \"expression\"\nvalue = \"0.5*axes.gamma + 0.5*own.r3\"\n\
             [loads.motor]\nkind = \"joint_torque\"\njoint = \"arm\"\ntorque = \"{torque}\"\n"
        );
        let session =
            finished(&arm(&tables, "scheme = \"radau-iia\"\nend = 0.5\nstep = 0.01\ntolerance = 1e-12"));
        session.value("arm.angle").unwrap()
    };
    let wanted = with("3*(0.4 - arm.angle)");
    for angle in ["axes.gamma", "own.r3", "2*asin(quaternion.q3)", "sum.value"] {
        let found = with(&format!("3*(0.4 - {angle})"));
        assert!((found - wanted).abs() < 1e-10, "{angle}: {found} {wanted}");
    }
}

/// A table over a measurement acts like the expression through its rows, with its derivative in the tangent.
#[test]
fn a_table_over_a_measurement_acts_like_the_expression_through_its_rows() {
    let table = "[signals]\nlift = { of = \"2*arm.rotation\", table = [[-1, 50], [0, 0], [0.5, -25]], \
                 extrapolation = \"linear\" }\n";
    let load = "[loads.motor]\nkind = \"joint_torque\"\njoint = \"arm\"\ntorque = \"lift + 20\"\n";
    for scheme in ["radau-iia", "radau-iia-5", "energy-decaying", "generalized-alpha", "hht"] {
        let analysis = format!("scheme = \"{scheme}\"\nend = 0.3\nstep = 5e-3\ntolerance = 1e-11");
        let session = finished(&arm(&format!("{table}{load}"), &analysis));
        let expression = load.replace("lift", "-100*arm.rotation");
        let wanted = finished(&arm(&expression, &analysis)).value("arm.angle").unwrap();
        let angle = session.value("arm.angle").unwrap();
        assert!(wanted.abs() > 0.1 && (angle - wanted).abs() < 1e-10, "{scheme}: {angle} {wanted}");
        let lift = session.value("lift").unwrap();
        assert!((lift + 100.0 * angle).abs() < 1e-10, "{scheme}: {lift}");
    }
}

/// Rows of a table over a line of time end steps, so that the motion is exact; a sampled one is constant in between.
#[test]
fn a_table_over_time_is_exact_and_a_sampled_one_is_constant_in_between() {
    let table = "of = \"1 - 2*t\", table = [[0, 3], [0.754, 3], [1, 0]]";
    let load = "[loads.motor]\nkind = \"joint_torque\"\njoint = \"arm\"\ntorque = \"push\"\n";
    let analysis = "scheme = \"radau-iia\"\nend = 0.3\nstep = 1e-2\ntolerance = 1e-12";
    // It rises to 3 until 1 - 2 t = 0.754.
    let kink = 0.5 * (1.0 - 0.754);
    let exact = finished(&arm(&format!("[signals]\npush = {{ {table} }}\n{load}"), analysis));
    let wanted = 3.0 * (0.3 - 0.5 * kink) / INERTIA;
    assert!((exact.value("arm.rate").unwrap() - wanted).abs() < 1e-10);
    let sampled = format!("[signals]\npush = {{ {table}, sample = 0.1, start = 7 }}\n{load}");
    let mut session = session(&arm(&sampled, analysis));
    for (time, at) in [(0.05, 0.0), (0.15, 0.1), (0.25, 0.2)] {
        session.step_to(time).unwrap();
        let wanted = 3.0 * (at / kink).min(1.0);
        assert!((session.value("push").unwrap() - wanted).abs() < 1e-12, "{time}");
    }
    let wanted = 0.1 * 3.0 * 0.1 / kink + 0.05 * 3.0;
    assert!((session.value("arm.rate").unwrap() - wanted / INERTIA).abs() < 1e-10);
}

#[test]
fn a_session_restored_in_the_middle_goes_on_to_the_last_bit() {
    let tables = format!("{SAMPLED_STATE}\n{SAMPLED}");
    for scheme in ["generalized-alpha", "radau-iia", "energy-decaying"] {
        let text = arm(&tables, &format!("scheme = \"{scheme}\"\nend = 0.5\nstep = 4e-3"));
        let mut whole = session(&text);
        whole.step_to(0.2).unwrap();
        whole.set_input("push", 1.5).unwrap();
        whole.step_to(0.25).unwrap();
        let kept = whole.snapshot().to_bytes();
        whole.step_to(0.5).unwrap();
        let mut other = session(&text);
        other.restore(&lissom::SessionSnapshot::from_bytes(&kept).unwrap()).unwrap();
        assert_eq!(other.value("push"), Some(1.5));
        other.step_to(0.5).unwrap();
        assert_eq!(whole.simulation().state(), other.simulation().state(), "{scheme}");
        assert_ne!(whole.value("lag"), Some(0.0));
    }
}

/// A session half a sample period after each of the first samples, to evaluate signals at samples.
fn at_samples(tables: &str, period: f64, count: usize, mut check: impl FnMut(usize, &lissom::Session)) {
    let mut session = session(&arm(tables, "end = 1\nstep = 7e-3"));
    for k in 0..count {
        session.step_to((k as f64 + 0.5) * period).unwrap();
        check(k, &session);
    }
}

/// y_k = p y_(k-1) + (1 - p) u_(k-1): 1 - p^k for u = 1, whatever the first coefficient of the denominator.
#[test]
fn the_step_response_of_a_discrete_lag_is_a_geometric_series() {
    let p: f64 = 0.8;
    for first in [1.0, -4.0] {
        let tables = format!(
            "[signals]\nlag = {{ value = \"1\", sample = 0.01, numerator = [0, {}], denominator = [{first}, {}] }}\n",
            first * (1.0 - p),
            -first * p
        );
        at_samples(&tables, 0.01, 20, |k, session| {
            let wanted = 1.0 - p.powf(k as f64);
            assert!((session.value("lag").unwrap() - wanted).abs() < 1e-14, "{first}, {k}");
        });
    }
}

#[test]
fn a_moving_average_is_that_of_two_samples() {
    let tables = "[signals]\nmean = { value = \"t\", sample = 0.01, numerator = [0.5, 0.5], start = 9 }\n";
    at_samples(tables, 0.01, 10, |k, session| {
        let wanted = if k == 0 { 0.0 } else { 0.01 * (k as f64 - 0.5) };
        assert!((session.value("mean").unwrap() - wanted).abs() < 1e-14, "{k}");
    });
}

/// A filter of third order over a table of a sampled signal, against its recursion.
#[test]
fn a_discrete_filter_follows_its_recursion() {
    let (b, a) = ([0.3, -0.2, 0.5, 0.1], [-1.1, 0.6, -0.25]);
    let tables = "[signals]\nsource = { value = \"sin(40*t)\", sample = 0.01 }\n\
         y = { of = \"source + 0.1*y\", table = [[-1, -3], [0, 0], [1, 3]], extrapolation = \"linear\", sample = 0.01, \
         start = 2, numerator = [0.3, -0.2, 0.5, 0.1], denominator = [1, -1.1, 0.6, -0.25] }\n";
    let (mut u, mut y) = ([0.0; 4], [2.0; 3]);
    at_samples(tables, 0.01, 30, |k, session| {
        u.rotate_right(1);
        u[0] = 3.0 * ((0.4 * k as f64).sin() + 0.1 * y[0]);
        let sum =
            |weights: &[f64], values: &[f64]| -> f64 { weights.iter().zip(values).map(|(w, v)| w * v).sum() };
        let next = sum(&b, &u) - sum(&a, &y);
        y.rotate_right(1);
        y[0] = next;
        assert!((session.value("y").unwrap() - next).abs() < 1e-12 * next.abs().max(1.0), "{k}: {next}");
    });
}

/// a_k = b_(k-1) and b_k = a_(k-1) + b_(k-1), which name each other, are the Fibonacci numbers.
#[test]
fn previous_samples_of_other_signals_are_delays_and_no_loops() {
    let tables = "[signals]\na = { value = \"b.last\", sample = 0.01 }\n\
                  b = { value = \"a.last + b.last\", sample = 0.01, start = 1 }\n\
                  c = { value = \"a + b.last\", sample = 0.02 }\n\
                  [outputs.b]\nkind = \"signal\"\nof = \"b\"\n";
    let mut fibonacci = vec![0.0, 1.0];
    at_samples(tables, 0.01, 30, |k, session| {
        fibonacci.push(fibonacci[k] + fibonacci[k + 1]);
        let values = ["a", "b", "c"].map(|name| session.value(name).unwrap());
        // The slower one adds the present a to what b was immediately before.
        let slow = k - k % 2;
        assert_eq!(values, [fibonacci[k + 1], fibonacci[k + 2], 2.0 * fibonacci[slow + 1]], "{k}");
    });
}

/// A loop through a filter and a previous sample goes on from a snapshot between two samples to the last bit.
#[test]
fn filters_go_on_from_a_snapshot_to_the_last_bit() {
    let tables = "[signals]\nsmooth = { value = \"arm.rotation\", sample = 0.01, numerator = [0.2, 0.1, 0.05], \
                  denominator = [1, -0.9, 0.25] }\n\
                  push = { value = \"4*(0.2 - smooth) - 0.2*smooth.last\", sample = 0.01 }\n\
                  [loads.motor]\nkind = \"joint_torque\"\njoint = \"arm\"\ntorque = \"push\"\n";
    for scheme in ["generalized-alpha", "radau-iia"] {
        let text = arm(tables, &format!("scheme = \"{scheme}\"\nend = 0.5\nstep = 4e-3"));
        let mut whole = session(&text);
        whole.step_to(0.252).unwrap();
        let kept = whole.snapshot().to_bytes();
        whole.step_to(0.5).unwrap();
        let mut other = session(&text);
        other.restore(&lissom::SessionSnapshot::from_bytes(&kept).unwrap()).unwrap();
        other.step_to(0.5).unwrap();
        assert_eq!(whole.simulation().state(), other.simulation().state(), "{scheme}");
        // The last samples were taken of another motion than the first.
        assert!(whole.value("arm.angle").unwrap() > 0.05, "{scheme}");
    }
}

const SAMPLED_STATE: &str = r#"
[inputs]
push = 0
[states.lag]
derivative = "20*(push - lag)"
[loads.push]
kind = "force"
on = "bar"
vector = [0, 0.1, 0]
scale = "lag"
"#;

#[test]
fn inputs_act_from_when_they_are_set() {
    let tables = "[inputs]\ntorque = 0.3\n[loads.motor]\nkind = \"joint_torque\"\njoint = \"arm\"\ntorque = \"torque\"\n";
    for scheme in ["generalized-alpha", "radau-iia"] {
        let mut session =
            session(&arm(tables, &format!("scheme = \"{scheme}\"\nend = 1\nstep = 1e-2\ntolerance = 1e-11")));
        session.set_input("torque", 0.6).unwrap();
        session.step_to(0.5).unwrap();
        // From the first step on: θ = τ t²/(2 J).
        let wanted = 0.6 * 0.125 / INERTIA;
        assert!((session.value("arm.angle").unwrap() - wanted).abs() < 1e-9, "{scheme}");
        session.set_input("torque", -0.6).unwrap();
        assert_eq!(session.value("torque"), Some(-0.6));
        session.step_to(1.0).unwrap();
        let rate = session.value("arm.rate").unwrap();
        assert!(rate.abs() < 1e-9, "{scheme}: {rate:e}");
        let unknown = session.set_input("torqe", 0.0).unwrap_err().to_string();
        assert!(unknown.contains("`torqe`") && unknown.contains("torque"), "{unknown}");
        assert!(session.set_input("torque", f64::NAN).is_err());
    }
}

/// Arms on top of each other, each turned about another axis than the one below, with torques as inputs.
fn tower(count: usize) -> String {
    let arm = |k: usize| {
        let (foot, axis) = (0.3 * k as f64, if k.is_multiple_of(2) { "[0, 0, 1]" } else { "[0, 1, 0]" });
        let base = if k == 0 { "ground".to_owned() } else { format!("b{}", k - 1) };
        format!(
            "[bodies.b{k}]\nmass = 2\ninertia = [0.02, 0.02, 0.01]\nposition = [0, 0, {}]\n\
             [joints.j{k}]\nkind = \"revolute\"\nbase = \"{base}\"\ntip = \"b{k}\"\nat = [0, 0, {foot}]\naxis = {axis}\n\
             [loads.u{k}]\nkind = \"joint_torque\"\njoint = \"j{k}\"\ntorque = \"u{k}\"\n\
             [outputs.q{k}]\nkind = \"relative\"\nof = \"j{k}\"\n",
            foot + 0.15
        )
    };
    let inputs: Vec<String> = (0..count).map(|k| format!("u{k} = 0.0\n")).collect();
    let arms: Vec<String> = (0..count).map(arm).collect();
    format!(
        "lissom = 1\ngravity = [0, 0, -9.81]\n[inputs]\n{}{}[analysis]\nkind = \"dynamics\"\nend = 0.5\nstep = 1e-3\n",
        inputs.concat(),
        arms.concat()
    )
}

#[test]
fn inputs_that_are_set_together_act_like_those_set_one_after_another() {
    let mut together = session(&tower(3));
    let mut apart = session(&tower(3));
    for step in 1..100 {
        let torque = |k: usize| 0.1 * ((step + k) as f64).sin();
        let all = [("u0", torque(0)), ("u1", torque(1)), ("u2", torque(2))];
        together.set_inputs(all).unwrap();
        for (name, torque) in all {
            apart.set_input(name, torque).unwrap();
        }
        for session in [&mut together, &mut apart] {
            session.step_to(1e-3 * step as f64).unwrap();
        }
    }
    for name in ["q0.angle", "q1.angle", "q2.rate"] {
        let [one, other] = [&together, &apart].map(|session| session.value(name).unwrap());
        assert!(one.abs() > 1e-7 && (one - other).abs() < 1e-9 * one.abs() + 1e-14, "{name}: {one}, {other}");
    }
    // If one of them is wrong none is set.
    assert!(together.set_inputs([("u0", 7.0), ("u9", 7.0)]).is_err());
    assert!(together.set_inputs([("u0", 7.0), ("u1", f64::NAN)]).is_err());
    assert_ne!(together.value("u0"), Some(7.0));
}

#[test]
fn rates_of_a_machine_at_rest_are_no_error() {
    let mut session = session(&tower(7));
    session.step_to(0.1).unwrap();
    let warnings: Vec<String> = session.warnings().map(ToString::to_string).collect();
    assert!(warnings.is_empty(), "{warnings:?}");
}

#[test]
fn mistakes_are_reported_with_their_place() {
    let load = |torque: &str| {
        format!("[loads.motor]\nkind = \"joint_torque\"\njoint = \"arm\"\ntorque = \"{torque}\"\n")
    };
    let analysis = "end = 1\nstep = 1e-2";
    for (tables, words) in [
        (load("2*arm.rotaton"), &["`arm` has no component `rotaton`", "did you mean `rotation`"][..]),
        (load("2*amr.rate"), &["no output or joint called `amr`", "did you mean `arm`"]),
        (
            load("2*comand") + "[signals]\ncommand = \"t\"\n",
            &["unknown name `comand`", "did you mean `command`"],
        ),
        (load("arm"), &["unknown name `arm`", "write a component"]),
        (load("sin(t"), &["closing parenthesis"]),
        (
            "[signals]\na = \"2*b\"\nb = \"c + 1\"\nc = \"a*t\"\n".to_owned(),
            &["algebraic loop: `a` names `b` names `c` names `a`"],
        ),
        ("[signals]\na = \"a + 1\"\n".to_owned(), &["algebraic loop: `a` names `a`"]),
        (
            "[signals]\na = { value = \"1\", sample = 0.1 }\nb = \"a.last\"\n".to_owned(),
            &["`a.last` is only known to sampled signals", "add `sample`"],
        ),
        (
            "[signals]\na = \"t\"\nb = { value = \"a.last\", sample = 0.1 }\n".to_owned(),
            &["`a` is not sampled", "add `sample` to `a`"],
        ),
        (
            "[signals]\na = { value = \"b\", sample = 0.1 }\nb = { value = \"a\", sample = 0.1 }\n"
                .to_owned(),
            &["algebraic loop: `a` names `b` names `a`", "`NAME.last`"],
        ),
        ("[signals]\na = 1\n[inputs]\na = 2\n".to_owned(), &["has the name of"]),
        ("[signals]\nt = 1\n".to_owned(), &["cannot be called `t`"]),
        ("[signals]\na = { value = \"t\" }\n".to_owned(), &["lacks `sample`"]),
        ("[states]\na = { start = 1 }\n".to_owned(), &["lacks `derivative`"]),
        (
            "[outputs.e]\nkind = \"signal\"\nof = \"erorr\"\n[signals]\nerror = 1\n".to_owned(),
            &["did you mean `error`"],
        ),
        (
            load("bend.total") + "[outputs.bend]\nkind = \"energy\"\n",
            &["`bend` is of kind `energy`", "only sampled"],
        ),
        (
            "[joints.drive]\nkind = \"prescribed_rotation\"\njoint = \"arm\"\nrotation = \"tip.x\"\n"
                .to_owned(),
            &["unknown name `tip.x`"],
        ),
    ] {
        let reported = refused(&arm(&tables, analysis));
        for words in words {
            assert!(reported.contains(words), "{tables}\n{reported}");
        }
    }
    // A joint and an output of one name: components that only one of them has are no mistake.
    let ambiguous = |source: &str| {
        let output = "[outputs.arm]\nkind = \"relative\"\nof = \"arm\"\n";
        let own = "[outputs.arm]\nkind = \"relative\"\nof = \"other\"\n\
                   [joints.other]\nkind = \"generalized_coordinates\"\nstart = [0]\n\
                   [springs.other]\nkind = \"coordinate_dynamics\"\ncoordinates = [\"other\"]\nmass = 1\n";
        let text = arm(&load(source), analysis);
        assert!(text.contains(output));
        text.replace(output, own)
    };
    assert!(refused(&ambiguous("arm.rotation")).contains("may mean the joint or the output `arm`"));
    assert!(lissom::Model::from_text("arm.toml", &ambiguous("arm.displacement1")).session().is_ok());
    let statics = arm("[states]\na = { derivative = \"1\" }\n", "").replace("\"dynamics\"", "\"statics\"");
    assert!(refused(&statics).contains("has no rates"));
}

#[test]
fn a_signal_that_is_not_finite_ends_the_run_with_its_name() {
    let load = "[loads.motor]\nkind = \"joint_torque\"\njoint = \"arm\"\ntorque = \"-5 + 0*sqrt(0.1 + arm.rotation)\"\n";
    let alone = "[signals]\nlost = \"sqrt(0.3 - t)\"\n";
    for (tables, name) in [(load, "`torque` of load `motor`"), (alone, "lost")] {
        let mut session = session(&arm(tables, "end = 1\nstep = 1e-2"));
        let (_, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
        let lissom::Stopped::Failed(error) = &report.stopped else { panic!("{report:?}") };
        let reported = error.to_string();
        assert!(
            reported.contains(name) && reported.contains("sqrt") && reported.contains("t = "),
            "{reported}"
        );
        assert!(!report.is_complete());
    }
    let at_start = refused(&arm("[signals]\nlost = \"ln(t)\"\n", "end = 1\nstep = 1e-2"));
    assert!(at_start.contains("lost = ln(t)"), "{at_start}");
}

/// A state of its own does not change the motion, whatever its size and unit.
#[test]
fn states_beside_a_motion_do_not_disturb_it() {
    let analysis = "scheme = \"radau-iia\"\nend = 0.4\nstep = 1e-2\ntolerance = 1e-10";
    let plain = finished(&arm(CONTROL, analysis)).value("arm.angle").unwrap();
    for scale in [1e-9, 1.0, 1e9] {
        let state = format!(
            "[states]\nx = {{ derivative = \"{scale}*cos(20*t) - x^3/{scale}^2\", start = {scale}, magnitude = {scale} }}\n"
        );
        let session = finished(&arm(&(CONTROL.to_owned() + &state), analysis));
        assert!((session.value("arm.angle").unwrap() - plain).abs() < 1e-12, "{scale}");
        let x = session.value("x").unwrap() / scale;
        let reference =
            finished(&arm("[states]\nx = { derivative = \"cos(20*t) - x^3\", start = 1 }\n", analysis));
        assert!((x - reference.value("x").unwrap()).abs() < 1e-9, "{scale}: {x}");
    }
}

const SLIDER: &str = r#"
lissom = 1
[bodies.block]
mass = 2
inertia = [0.1, 0.1, 0.1]
velocity = [0.5, 0, 0]
[joints.slide]
kind = "prismatic"
base = "ground"
tip = "block"
axis = [1, 0, 0]
[outputs.slide]
kind = "relative"
of = "slide"
[analysis]
kind = "dynamics"
"#;

fn slider(tables: &str, analysis: &str) -> String {
    format!(
        "{}\n{tables}",
        SLIDER.replace("kind = \"dynamics\"\n", &format!("kind = \"dynamics\"\n{analysis}\n"))
    )
}

/// With dry friction F the amplitude of an oscillator falls by 2 F/k per half swing, until it sticks.
#[test]
fn the_amplitude_of_an_oscillator_with_dry_friction_falls_by_a_constant() {
    let tables = r#"
[springs.spring]
kind = "axial"
joint = "slide"
stiffness = 200
[springs.friction]
kind = "axial_friction"
joint = "slide"
coulomb = 0.8
deflection = 1e-6
damping = 20
"#;
    // The first two of them oscillate while the bristle bends at the start.
    for (scheme, most) in [
        ("generalized-alpha", 1e-4),
        ("hht", 1e-4),
        ("radau-iia", 2e-5),
        ("radau-iia-5", 2e-5),
        ("energy-decaying", 2e-5),
    ] {
        let text = slider(tables, &format!("scheme = \"{scheme}\"\nend = 4\nstep = 2e-4"));
        let mut session = session(&text);
        let record = session.run().unwrap();
        let places = record.column("slide", "displacement").unwrap();
        let peaks: Vec<f64> = places
            .windows(3)
            .filter(|three| (three[1] - three[0]) * (three[2] - three[1]) < 0.0)
            .map(|three| three[1].abs())
            .filter(|peak| *peak > 6e-3)
            .collect();
        // From ½ m v² = ½ k a² + F a.
        let first = (-0.8 + (0.8_f64 * 0.8 + 200.0 * 2.0 * 0.25).sqrt()) / 200.0;
        assert!(peaks.len() >= 3, "{scheme}: {peaks:?}");
        for (k, peak) in peaks.iter().enumerate() {
            let wanted = first - 2.0 * 0.8 / 200.0 * k as f64;
            assert!((peak - wanted).abs() < most, "{scheme}: peak {k} {peak} {wanted}");
        }
        // It sticks within F/k of the middle.
        let last = places[places.len() - 1];
        assert!(last.abs() < 0.8 / 200.0 + 1e-5, "{scheme}: {last}");
        assert!((last - places[places.len() - 500]).abs() < 1e-7, "{scheme}");
    }
}

/// A block on a slope below the limit of friction sticks, and does not creep in 10⁵ steps.
#[test]
fn a_block_sticks_on_a_slope_without_creeping() {
    let tables = r#"
[springs.friction]
kind = "axial_friction"
joint = "slide"
coulomb = 10
damping = 200
"#;
    let text = slider(tables, "scheme = \"radau-iia\"\nend = 100\nstep = 1e-3")
        .replace("lissom = 1", "lissom = 1\ngravity = [4.5, 0, -8.7]")
        .replace("velocity = [0.5, 0, 0]\n", "");
    let mut session = session(&text);
    session.step_to(2.0).unwrap();
    let settled = session.value("slide.displacement").unwrap();
    // Released at once it slips a little until the bristle holds 9 N of 10 N.
    assert!(settled > 0.9e-4 && settled < 1e-3, "{settled}");
    session.step_to(100.0).unwrap();
    let crept = session.value("slide.displacement").unwrap() - settled;
    assert!(crept.abs() < 1e-12, "{crept:e}");
    // Above the limit it slides; while the bristle bends it gains F_c times its deflection at most, 1e-5 J.
    let slips =
        text.replace("coulomb = 10", "coulomb = 8\ndeflection = 1e-6").replace("end = 100", "end = 1");
    let slid = finished(&slips).value("slide.displacement").unwrap();
    assert!((slid - 0.5 * (9.0 - 8.0) / 2.0).abs() < 4e-3, "{slid}");
}

#[test]
fn friction_has_no_equation_in_statics() {
    let tables = "[springs.friction]\nkind = \"axial_friction\"\njoint = \"slide\"\ncoulomb = 1\n";
    let statics =
        slider(tables, "").replace("\"dynamics\"", "\"statics\"").replace("velocity = [0.5, 0, 0]\n", "");
    assert!(refused(&statics).contains("have no rates"));
}

/// A load that repeats the moment of a spring and damper doubles it, with every scheme, and events and powers follow the spring.
#[test]
fn moments_and_powers_of_springs_are_fed_back() {
    let spring = |stiffness: f64, damping: f64| {
        format!(
            "[springs.bar]\nkind = \"torsional\"\njoint = \"arm\"\nangle = 0.3\n\
             stiffness = {stiffness}\ndamping = {damping}\n\
             [outputs.pull]\nkind = \"spring\"\nof = \"bar\"\n[outputs.flow]\nkind = \"power\"\nof = \"bar\"\n"
        )
    };
    let repeated = "[loads.again]\nkind = \"joint_torque\"\njoint = \"arm\"\ntorque = \"-pull.moment\"\n\
                    [signals]\ngain = \"2*flow.power\"\n";
    for scheme in ["radau-iia", "radau-iia-5", "energy-decaying", "generalized-alpha", "hht"] {
        let analysis = format!("scheme = \"{scheme}\"\nend = 0.3\nstep = 1e-3\ntolerance = 1e-10");
        let twice = finished(&arm(&format!("{}{repeated}", spring(100.0, 4.0)), &analysis));
        let once = finished(&arm(&spring(200.0, 8.0), &analysis));
        let twice_angle = twice.value("arm.angle").unwrap();
        let once_angle = once.value("arm.angle").unwrap();
        assert!((twice_angle - once_angle).abs() < 1e-9, "{scheme}: {twice_angle} {once_angle}");
        assert!(
            (twice.value("pull.moment").unwrap() * 2.0 - once.value("pull.moment").unwrap()).abs() < 1e-7
        );
        let power = -twice.value("pull.moment").unwrap() * twice.value("pull.rate").unwrap();
        // The signal is what acts; the output is recovered from the positions.
        assert!((twice.value("gain").unwrap() - 2.0 * power).abs() < 1e-5, "{scheme}: {power}");
    }
    // θ = 0.3 (1 - cos ωt): the moment vanishes after a quarter of a period.
    let event = "[events.slack]\nzero_of = \"pull.moment\"\nstop = true\n";
    let session = finished(&arm(
        &format!("{}{event}", spring(200.0, 0.0)),
        "scheme = \"radau-iia-5\"\nend = 1\nstep = 1e-3",
    ));
    let quarter = 0.5 * std::f64::consts::PI / (200.0 / INERTIA).sqrt();
    let time = session.progress().time;
    assert!((time - quarter).abs() < 1e-6, "{time} {quarter}");
    // A name that is no component.
    let wrong = format!("{}[signals]\nbad = \"pull.force\"\n", spring(200.0, 0.0));
    assert!(refused(&arm(&wrong, "end = 1\nstep = 1e-3")).contains("`pull` has no component `force`"));
}
