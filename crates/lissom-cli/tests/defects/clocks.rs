//! Sessions whose target times come from a clock that adds steps to a sum.

use lissom::Model;

use crate::support::sessions::session;

fn controlled_arm(analysis: &str) -> String {
    let text = include_str!("../../../../examples/controlled-arm.toml");
    let (model, _) = text.split_once("[analysis]").unwrap();
    format!("{model}\n[analysis]\nkind = \"dynamics\"\nend = 1.5\n{analysis}")
}

/// Largest difference of any value between a session with an accumulating clock and one with exact times.
fn difference(text: &str, step: f64, count: u32, compared: u32) -> f64 {
    let model = Model::from_text("model.toml", text);
    let [mut accumulated, mut exact] = [0, 1].map(|_| model.session().unwrap());
    let (mut clock, mut most) = (0.0, 0.0_f64);
    for k in 1..=count {
        clock += step;
        accumulated.step_to(clock).unwrap_or_else(|error| panic!("{step}: {error}"));
        exact.step_to(f64::from(k) * step).unwrap();
        if k.is_multiple_of(compared) {
            let values = [&accumulated, &exact].map(|session| {
                let mut values = Vec::new();
                session.values(&mut values);
                values
            });
            let pairs = values[0].iter().zip(&values[1]);
            most = pairs.fold(most, |most, (a, b)| most.max((a - b).abs() / (1.0 + b.abs())));
        }
    }
    assert!((accumulated.progress().time - clock).abs() < 1e-3 * step);
    most
}

/// Samples at 1 ms were missed by 1e-14 s, and steps of that size excited the scheme: the run failed after 8 s, or a command was
/// 32 % off.
#[test]
fn accumulated_times_meet_samples() {
    let steps = |analysis: &str, sizes: &[f64], end: f64| {
        for step in sizes {
            let found = difference(&controlled_arm(analysis), *step, (end / step) as u32, 10);
            assert!(found < 1e-5, "{analysis}, {step}: {found:e}");
        }
    };
    steps("step = 1e-3", &[0.01, 0.1, 1e-3], 10.0);
    steps("step = 1e-3", &[2e-3], 3.0);
    steps("relative_tolerance = 1e-4", &[0.1, 1e-3], 3.0);
    steps("scheme = \"generalized-alpha\"\nstep = 1e-3", &[0.01, 1e-3], 3.0);
}

/// A force that is switched every 10 ms by a sampled signal, and at a breakpoint of time: a million communication steps.
const SWITCHED: &str = r#"
lissom = 1
[point_masses.m]
mass = 1
[joints.s]
kind = "point_on_line"
base = "ground"
tip = "m"
axis = [1, 0, 0]
[signals]
command = { value = "sign(sin(3*t + 0.1))", sample = 0.01 }
[loads.push]
kind = "joint_force"
joint = "s"
force = "command - s.velocity + step(t - 700)"
[outputs.s]
kind = "relative"
of = "s"
[analysis]
kind = "dynamics"
end = 1000
step = 1e-3
"#;

#[test]
fn a_million_accumulated_steps_meet_samples() {
    let mut session = session(SWITCHED);
    let (mut clock, mut exact_velocity, mut least) = (0.0, 0.0, f64::INFINITY);
    for k in 1..=1_000_000_u32 {
        // The force of the last sample, and an exponential approach to it.
        let sample = f64::from((k - 1) / 10) * 0.01;
        let force = (3.0 * sample + 0.1).sin().signum() + f64::from(u8::from(k > 700_000));
        exact_velocity = force + (exact_velocity - force) * f64::exp(-1e-3);
        let before = session.simulation().state().kinematics.time;
        clock += 1e-3;
        session.step_to(clock).unwrap_or_else(|error| panic!("{clock}: {error}"));
        least = least.min(session.simulation().state().kinematics.time - before);
        if k.is_multiple_of(1000) {
            let velocity = session.value("s.velocity").unwrap();
            assert!((velocity - exact_velocity).abs() < 1e-6, "{clock}: {velocity} {exact_velocity}");
        }
    }
    // No step between two instants that are the same.
    assert!(least > 0.99e-3, "{least:e}");
    assert_eq!(session.simulation().totals().steps, 1_000_000);
}
