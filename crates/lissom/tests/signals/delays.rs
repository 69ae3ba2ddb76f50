//! Delayed signals. Solutions are compared with the method of steps, with stability borders and with other models.

use std::f64::consts::{FRAC_PI_2, PI};

use lissom::analyses::gradient::{GradientError, gradient};
use lissom::analyses::modes::{ModeRequest, OperatingPoint, modes};
use lissom::{Model, SessionSnapshot};

use crate::support::refused::refused;
use crate::support::sessions::{finished, session};

/// A mass on a rail, which moves freely.
const CARRIER: &str = r#"
lissom = 1
[bodies.mass]
mass = 1
inertia = [1, 1, 1]
position = [0, 0, 0]
velocity = [1, 0, 0]
[joints.rail]
kind = "prismatic"
base = "ground"
tip = "mass"
at = [0, 0, 0]
axis = [1, 0, 0]
[outputs.rail]
kind = "relative"
of = "rail"
[analysis]
kind = "dynamics"
"#;

/// The mass with more tables, and keys of its analysis.
fn model(tables: &str, analysis: &str) -> String {
    let analysis = format!("kind = \"dynamics\"\n{analysis}\n");
    format!("{}\n{tables}", CARRIER.replace("kind = \"dynamics\"\n", &analysis))
}

/// Error of a quantity at the end of a run.
fn error(tables: &str, analysis: &str, name: &str, wanted: f64) -> f64 {
    (finished(&model(tables, analysis)).value(name).unwrap() - wanted).abs()
}

const RETARDED: &str = r#"
[signals]
late = { value = "x", delay = 1 }
[states]
x = { derivative = "-late", start = 1 }
"#;

/// x' = -x(t - 1), x = 1 before 0, by the method of steps: Σ (-1)^k (t - k + 1)^k/k!, k = 0 … floor(t) + 1.
fn retarded(time: f64) -> f64 {
    let (mut sum, mut factor) = (1.0, 1.0);
    for k in 1..=20 {
        let order = f64::from(k);
        factor /= -order;
        sum += factor * (time - order + 1.0).max(0.0).powi(k);
    }
    sum
}

#[test]
fn the_method_of_steps_is_met_with_the_order_of_the_scheme() {
    for (scheme, order) in
        [("generalized-alpha", 2.0), ("hht", 2.0), ("radau-iia", 3.0), ("energy-decaying", 3.0)]
    {
        let error = |step: f64| {
            let analysis = format!("end = 4.5\nstep = {step}\ntolerance = 1e-12\nscheme = \"{scheme}\"");
            error(RETARDED, &analysis, "x", retarded(4.5))
        };
        let (coarse, fine) = (error(0.05), error(0.025));
        let found = (coarse / fine).log2();
        assert!((found - order).abs() < 0.1, "{scheme}: {coarse:e} {fine:e}, order {found}");
    }
    // In each interval the solution is a polynomial, which three stages integrate exactly; steps that do not fit into the delay, or are
    // longer than it, are divided.
    for (step, end) in [(0.1, 1.0), (0.1, 2.0), (0.1, 3.0), (0.07, 3.0), (0.5, 3.0), (3.0, 3.0)] {
        let analysis = format!("end = 3\nstep = {step}\nscheme = \"radau-iia-5\"\ntolerance = 1e-12");
        let mut session = session(&model(RETARDED, &analysis));
        session.step_to(end).unwrap();
        let time = session.progress().time;
        let error = (session.value("x").unwrap() - retarded(time)).abs();
        assert!(error < 1e-14, "{step} {end}: {error:e}");
    }
    for (analysis, most) in [
        ("relative_tolerance = 1e-6", 2e-7),
        ("relative_tolerance = 1e-8", 2e-9),
        ("relative_tolerance = 1e-6\nscheme = \"generalized-alpha\"", 2e-6),
    ] {
        let error = error(RETARDED, &format!("end = 6.3\n{analysis}"), "x", retarded(6.3));
        assert!(error < most, "{analysis}: {error:e}");
    }
}

/// x' = -a x(t - 1): x tends to 2 Re(c e^(λt)) of its first root λ, x = 1 before 0.
fn first_mode(a: f64, time: f64) -> f64 {
    let (mut re, mut im) = (0.0_f64, FRAC_PI_2);
    // Newton's method for λ + a e^(-λ) = 0.
    for _ in 0..50 {
        let (size, (sin, cos)) = (a * (-re).exp(), im.sin_cos());
        let value = (re + size * cos, im - size * sin);
        let slope = (1.0 - size * cos, size * sin);
        let step = divide(value, slope);
        (re, im) = (re - step.0, im - step.1);
    }
    // c = (1 - a (1 - e^(-λ))/λ)/(1 - a e^(-λ)), with a e^(-λ) = -λ.
    let factor = divide((a + re, im), (re, im));
    let c = divide((1.0 - factor.0, -factor.1), (1.0 + re, im));
    let (sin, cos) = (im * time).sin_cos();
    2.0 * (re * time).exp() * (c.0 * cos - c.1 * sin)
}

fn divide(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    let square = b.0 * b.0 + b.1 * b.1;
    ((a.0 * b.0 + a.1 * b.1) / square, (a.1 * b.0 - a.0 * b.1) / square)
}

/// At a = π/2 the amplitude remains, with a period of 4; below it decays, above it grows.
#[test]
fn the_stability_border_of_a_delayed_state_is_met() {
    for (a, time) in [(FRAC_PI_2, 40.3), (1.4, 30.0), (1.7, 30.0)] {
        let tables = RETARDED.replace("-late", &format!("-{a}*late"));
        let wanted = first_mode(a, time);
        for (analysis, most) in [
            ("step = 0.05\nscheme = \"radau-iia-5\"\ntolerance = 1e-12", 1e-7),
            ("relative_tolerance = 1e-7", 5e-6),
        ] {
            let error = error(&tables, &format!("end = {time}\n{analysis}"), "x", wanted);
            assert!(error < most, "{a} {analysis}: {error:e} of {wanted}");
        }
    }
    let amplitude = first_mode(FRAC_PI_2, 40.0).hypot(first_mode(FRAC_PI_2, 41.0));
    assert!((amplitude - first_mode(FRAC_PI_2, 80.0).hypot(first_mode(FRAC_PI_2, 81.0))).abs() < 1e-12);
}

/// A mass with delayed position control, q'' + c q' + k q(t - τ) = 0, on its border ω² = k cos ωτ, c ω = k sin ωτ.
#[test]
fn a_mass_with_delayed_feedback_oscillates_on_its_stability_border() {
    let (delay, frequency) = (0.1, 2.5 * PI);
    let angle = frequency * delay;
    let (k, c) = (frequency * frequency / angle.cos(), frequency * angle.tan());
    let tables = format!(
        "[signals]\nlate = {{ value = \"rail.displacement\", delay = {delay} }}\n[loads.motor]\nkind = \"joint_force\"\njoint = \
         \"rail\"\nforce = \"-{k}*late - {c}*rail.velocity\"\n"
    );
    // q tends to 2 Re(e^(iωt)/h'(iω)), h = λ² + c λ + k e^(-λτ), from q = 0 with the velocity 1.
    let time = 8.03_f64;
    let slope = (c - k * delay * angle.cos(), 2.0 * frequency + k * delay * angle.sin());
    let (sin, cos) = (frequency * time).sin_cos();
    let wanted = 2.0 * divide((cos, sin), slope).0;
    for (scheme, step, most) in [
        ("radau-iia-5", "step = 0.005\ntolerance = 1e-12", 1e-10),
        ("radau-iia", "step = 0.0025", 1e-6),
        ("generalized-alpha", "step = 0.0005", 1e-5),
        ("radau-iia-9", "relative_tolerance = 1e-7", 1e-7),
    ] {
        let analysis = format!("end = {time}\n{step}\nscheme = \"{scheme}\"");
        let error = error(&tables, &analysis, "rail.displacement", wanted);
        assert!(error < most, "{scheme} {step}: {error:e} of {wanted}");
    }
    for (scheme, order) in [("generalized-alpha", 2.0), ("radau-iia", 3.0), ("radau-iia-5", 5.0)] {
        let value = |step: f64| {
            let analysis = format!("end = 0.8\nstep = {step}\ntolerance = 1e-12\nscheme = \"{scheme}\"");
            finished(&model(&tables, &analysis)).value("rail.displacement").unwrap()
        };
        let [coarse, middle, fine] = [0.02, 0.01, 0.005].map(value);
        let found = ((coarse - middle) / (middle - fine)).abs().log2();
        assert!((found - order).abs() < 0.2, "{scheme}: order {found}");
    }
}

#[test]
fn chains_of_delays_add_up() {
    let chain = r#"
[signals]
late = { value = "0 + half", delay = 0.4 }
half = { value = "x", delay = 0.6 }
[states]
x = { derivative = "-late", start = 1 }
[outputs.late]
kind = "signal"
of = "late"
"#;
    for analysis in ["step = 0.1\nscheme = \"radau-iia-5\"\ntolerance = 1e-12", "relative_tolerance = 1e-8"] {
        let error = error(chain, &format!("end = 4.2\n{analysis}"), "x", retarded(4.2));
        assert!(error < 1e-9, "{error:e}");
    }
    let session = finished(&model(chain, "end = 3.2\nstep = 0.1\nscheme = \"radau-iia-5\""));
    let late = session.value("late.value").unwrap();
    assert!((late - retarded(2.2)).abs() < 1e-8);
    assert_eq!(session.value("late"), Some(late));
}

/// A kink that passes several delays remains one of the slope.
#[test]
fn chains_of_delays_keep_kinks() {
    let tables = r#"
[signals]
a = { value = "1 + max(t - 0.3, 0)", delay = 0.4 }
b = { value = "a", delay = 0.4 }
c = { value = "b", delay = 0.4 }
d = { value = "c", delay = 0.4 }
[states]
sum = { derivative = "d", start = 0 }
"#;
    let error = error(tables, "end = 2.5\nstep = 0.07\nscheme = \"radau-iia\"", "sum", 2.5 + 0.5 * 0.6 * 0.6);
    assert!(error < 1e-11, "{error:e}");
}

/// a(t) = a(t - 1)/2 + 1 is constant between the delays: a delay breaks an algebraic loop, and its jumps never end.
#[test]
fn a_delay_breaks_a_loop_of_signals() {
    let tables = r#"
[signals]
a = "0.5*late + 1"
late = { value = "a", delay = 1, start = 0 }
[states]
sum = { derivative = "a", start = 0 }
"#;
    // a = 2 - 2^-k from k to k + 1.
    let wanted = 14.0 - (2.0 - 0.5_f64.powi(6)) + 0.5 * (2.0 - 0.5_f64.powi(7));
    for analysis in ["step = 0.3", "step = 0.3\nscheme = \"generalized-alpha\"", "relative_tolerance = 1e-6"]
    {
        let error = error(tables, &format!("end = 7.5\n{analysis}"), "sum", wanted);
        assert!(error < 1e-12, "{analysis}: {error:e}");
    }
    let without = tables.replace(", start = 0 }\n[states]", " }\n[states]");
    let message = refused(&model(&without, "end = 1\nstep = 0.1"));
    assert!(message.contains("before the start is not determined"), "{message}");
}

/// The past of a sampled signal and of an input jumps where they do.
#[test]
fn jumps_of_the_past_are_jumps_after_the_delay() {
    let tables = r#"
[inputs]
u = 1
[signals]
count = { value = "count + 1", sample = 0.3 }
late = { value = "count*u", delay = 0.5, start = 0 }
[states]
sum = { derivative = "late", start = 0 }
"#;
    for analysis in [
        "step = 0.07",
        "step = 0.4",
        "step = 0.1\nscheme = \"generalized-alpha\"",
        "relative_tolerance = 1e-5",
    ] {
        let mut session = session(&model(tables, &format!("end = 2.4\n{analysis}")));
        session.step_to(1.4).unwrap();
        let time = session.progress().time;
        session.set_input("u", -2.0).unwrap();
        while !session.is_finished() {
            session.advance().unwrap();
        }
        // Between 0.5 and 2.4 count is 1 to 7; from the input on it counts -2 times.
        let integral = |until: f64| (0..7).map(|k| (until - 0.3 * f64::from(k)).max(0.0)).sum::<f64>();
        let wanted = 3.0 * integral(time) - 2.0 * integral(1.9);
        let error = (session.value("sum").unwrap() - wanted).abs();
        assert!(error < 1e-12, "{analysis}: {error:e}");
    }
}

/// A pulse of the past is not skipped by steps that nothing else shortens.
#[test]
fn adaptive_steps_resolve_pulses_of_the_past() {
    let of_time = "exp(-((t - 1)/0.004)^2)";
    let of_motion = "exp(-((rail.displacement - 1)/0.004)^2)";
    for pulse in [of_time, of_motion] {
        let tables = format!(
            "[signals]\nlate = {{ value = \"{pulse}\", delay = 2 }}\n[states]\nsum = {{ derivative = \"late\", start = 0 }}\n"
        );
        let wanted = 0.004 * PI.sqrt();
        for (scheme, tolerance, most) in [
            ("radau-iia-5", 1e-4, 1e-5),
            ("radau-iia-5", 1e-6, 1e-8),
            ("radau-iia-5", 1e-8, 1e-8),
            ("generalized-alpha", 1e-4, 2e-5),
            ("generalized-alpha", 1e-6, 2e-7),
        ] {
            let analysis = format!("end = 5\nrelative_tolerance = {tolerance}\nscheme = \"{scheme}\"");
            let error = error(&tables, &analysis, "sum", wanted);
            assert!(error < most, "{pulse} {scheme} {tolerance}: {error:e}");
        }
    }
}

/// A large tolerance stores a pulse in few pieces, more of which a step may contain than it resolves.
#[test]
fn steps_of_large_tolerances_resolve_the_past() {
    let tables = "[signals]\nlate = { value = \"exp(-((t - 1)/0.02)^2)\", delay = 2 }\n[states]\nsum = { derivative = \"late\", start = \
                  0 }\n";
    let analysis = "end = 5\nrelative_tolerance = 1e-3\nscheme = \"radau-iia-9\"";
    let error = error(tables, analysis, "sum", 0.02 * PI.sqrt());
    assert!(error < 1e-3 * 0.002, "{error:e}");
}

/// Events on delayed signals happen at the instants of the expression plus the delay, also where the signal jumps.
#[test]
fn events_on_delayed_signals_are_located() {
    let tables = r#"
[signals]
late = { value = "rail.displacement", delay = 0.25 }
jump = { value = "rail.velocity + 1", delay = 0.4, start = 0 }
[events.pass]
zero_of = "late - 0.3"
[events.jumped]
zero_of = "jump - 1"
[events.end]
zero_of = "late - 0.5"
stop = true
"#;
    for analysis in
        ["step = 0.1\nscheme = \"radau-iia\"", "step = 0.1", "relative_tolerance = 1e-5", "step = 0.3"]
    {
        let session = finished(&model(tables, &format!("end = 2\n{analysis}")));
        let times: Vec<f64> = session.simulation().occurrences().iter().map(|own| own.time).collect();
        assert!((session.progress().time - 0.75).abs() < 1e-9, "{analysis}");
        assert_eq!(times.len(), 3, "{analysis} {times:?}");
        assert!((times[0] - 0.4).abs() < 1e-6 && (times[1] - 0.55).abs() < 1e-9, "{analysis} {times:?}");
    }
}

/// A kink or jump of the expression that a fixed step does not end at.
#[test]
fn features_within_fixed_steps_of_the_past_are_stored() {
    let tables = r#"
[signals]
late = { value = "abs(rail.displacement - 0.512)", delay = 0.5, start = 0 }
[states]
sum = { derivative = "late", start = 0 }
"#;
    let wanted = 0.5 * (0.512_f64.powi(2) + 0.488_f64.powi(2));
    for step in [0.1, 0.05, 0.025] {
        let analysis = format!("end = 1.5\nstep = {step}\nscheme = \"radau-iia\"");
        let error = error(tables, &analysis, "sum", wanted);
        assert!(error < step * step, "{step}: {error:e}");
    }
}

/// The same digits follow from a snapshot in another session.
#[test]
fn a_snapshot_contains_the_past() {
    let tables = format!(
        "{RETARDED}[loads.motor]\nkind = \"joint_force\"\njoint = \"rail\"\nforce = \"late - 3*rail.displacement\"\n"
    );
    for analysis in [
        "step = 0.07",
        "relative_tolerance = 1e-5",
        "step = 0.03\nscheme = \"generalized-alpha\"",
        "step = 2.5",
    ] {
        let text = model(&tables, &format!("end = 6\n{analysis}"));
        let run = |from: Option<&SessionSnapshot>| {
            let mut session = session(&text);
            if let Some(snapshot) = from {
                session.restore(snapshot).unwrap();
            } else {
                while session.progress().time < 2.3 {
                    session.advance().unwrap();
                }
            }
            let snapshot = session.snapshot();
            while !session.is_finished() {
                session.advance().unwrap();
            }
            (
                snapshot,
                ["x", "late", "rail.displacement", "rail.velocity"]
                    .map(|name| session.value(name).unwrap().to_bits()),
            )
        };
        let (snapshot, whole) = run(None);
        let read = SessionSnapshot::from_bytes(&snapshot.to_bytes()).unwrap();
        assert_eq!(run(Some(&read)).1, whole, "{analysis}");
    }
}

#[test]
fn what_has_no_past_is_refused() {
    let analysis = "end = 1\nstep = 0.1";
    for (entry, words) in [
        ("late = { value = \"x\", delay = 0 }", "greater than zero"),
        ("late = { value = \"x\", delay = -1 }", "greater than zero"),
        ("late = { value = \"x\", delay = 1, sample = 0.1 }", "both `delay` and `sample`"),
        ("late = { value = \"x\", delay = 1, numerator = [1] }", "lacks `sample`"),
        ("late = { value = \"x\", start = 1 }", "or `delay = …`"),
        ("late = { value = \"y\", delay = 1 }", "unknown name `y`"),
        ("late = { value = \"late\", delay = 1 }", "add `start = …`"),
        (
            "late = { value = \"held\", delay = 1 }\nheld = { value = \"late\", sample = 0.1 }",
            "add `start = …`",
        ),
        ("late = { value = \"x\", delay = 5e-5 }", "below a thousandth of the step"),
        ("late = { value = \"1/(x - 1)\", delay = 1 }", "delayed signal `late` = 1/(x - 1) is inf"),
    ] {
        let message =
            refused(&model(&RETARDED.replace("late = { value = \"x\", delay = 1 }", entry), analysis));
        assert!(message.contains(words), "{entry}: {message}");
    }
}

#[test]
fn analyses_without_a_past_refuse_delays() {
    let tables = "[signals]\nlate = { value = \"rail.displacement\", delay = 1 }\n[loads.motor]\nkind = \"joint_force\"\njoint = \
                  \"rail\"\nforce = \"-late\"\n";
    let text = model(tables, "end = 1\nstep = 0.1");
    for (analysis, words) in [
        ("kind = \"statics\"", "statics has no past, so the delayed signal `late` has no value"),
        (
            "kind = \"path\"\nend = 2",
            "an equilibrium path has no past, so the delayed signal `late` has no value",
        ),
        (
            "kind = \"dynamics\"\nend = 1\nstep = 0.1\n[initial]\nequilibrium = true",
            "a start from equilibrium has no past, so the delayed signal `late` has no value",
        ),
    ] {
        let message = refused(&text.replace("kind = \"dynamics\"\nend = 1\nstep = 0.1", analysis));
        assert!(message.contains(words), "{message}");
    }
    let model = Model::from_text("model.toml", &text);
    let request = ModeRequest { about: Some(OperatingPoint::Undeformed), ..ModeRequest::default() };
    let message = modes(&model, &request).expect_err("it is delayed").to_string();
    assert!(message.contains("the signal `late` is delayed"), "{message}");
    let target = "rail.displacement".parse().expect("a target");
    let refused = gradient(&model, &target, &["signals.late.delay".to_owned()], true);
    assert!(matches!(refused, Err(GradientError::Feedback)), "{refused:?}");
}
