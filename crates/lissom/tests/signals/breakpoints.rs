//! Kinks and jumps of loads over time, on steps and between them, with every scheme: against closed forms.

use crate::support::rail;
use crate::support::sessions;

use lissom::start::lower;
use lissom::{Model, Session};
use sessions::{finished, session};

const SCHEMES: [&str; 5] = ["radau-iia", "radau-iia-5", "generalized-alpha", "hht", "energy-decaying"];

/// A mass of 1 kg on a rail under a force [N].
fn rail(force: &str, analysis: &str) -> String {
    rail::rail(1.0, 0.0, &rail::force(force), analysis)
}

/// Errors of position and velocity at 1 s.
fn errors(force: &str, analysis: &str, [place, velocity]: [f64; 2]) -> [f64; 2] {
    let session = finished(&rail(force, analysis));
    let warnings: Vec<_> = session.warnings().collect();
    assert!(warnings.is_empty(), "{force}, {analysis}: {warnings:?}");
    let value = |name: &str| session.value(name).unwrap();
    [(value("rail.displacement") - place).abs(), (value("rail.velocity") - velocity).abs()]
}

/// What follows from a force that jumps from 0 to 1 N at `from`.
fn after_jump(from: f64) -> [f64; 2] {
    [0.5 * (1.0 - from).powi(2), 1.0 - from]
}

/// What follows from a force that grows by 1 N/s from `from` on.
fn after_kink(from: f64) -> [f64; 2] {
    [(1.0 - from).powi(3) / 6.0, 0.5 * (1.0 - from).powi(2)]
}

#[test]
fn planned_steps_end_at_jumps_and_kinks_of_loads() {
    for scheme in SCHEMES {
        let analysis = format!("scheme = \"{scheme}\"\nstep = 1e-2");
        // Without an end there the velocity errs by up to 5e-3 m/s.
        for from in [0.5035, 0.5, 0.509_999, 0.3] {
            let force = format!("step(t - {from})");
            let found = errors(&force, &analysis, after_jump(from));
            assert!(found.iter().all(|error| *error < 1e-9), "{scheme}, jump at {from}: {found:?}");
        }
        // Between two of them a constant force; the last table row is not on a step either.
        let force = "sign(t - 0.2024) + sign(0.4011 - t)";
        let velocity = 2.0 * (0.4011 - 0.2024);
        let found = errors(force, &analysis, [velocity * (1.0 - 0.5 * (0.2024 + 0.4011)), velocity]);
        assert!(found.iter().all(|error| *error < 1e-9), "{scheme}, a push: {found:?}");
        // Of second order where a scheme is.
        let allowed =
            if scheme.starts_with("radau-iia") || scheme == "energy-decaying" { 1e-12 } else { 2e-5 };
        for from in [0.5035, 0.5] {
            let found = errors(&format!("max(t - {from}, 0)"), &analysis, after_kink(from));
            assert!(found.iter().all(|error| *error < allowed), "{scheme}, kink at {from}: {found:?}");
        }
    }
}

#[test]
fn chosen_steps_end_at_jumps_at_the_times_of_outputs_too() {
    for scheme in SCHEMES {
        let analysis = format!("scheme = \"{scheme}\"\nrelative_tolerance = 1e-4\noutput_step = 0.1");
        for from in [0.5, 0.5035] {
            // A last stage that saw the jump made 1.2e-2 m/s of it.
            let found = errors(&format!("step(t - {from})"), &analysis, after_jump(from));
            assert!(found.iter().all(|error| *error < 1e-8), "{scheme}, jump at {from}: {found:?}");
        }
    }
}

#[test]
fn rows_keep_their_times_and_steps_their_number() {
    let text = rail("step(t - 0.5035) + step(t - 0.25)", "scheme = \"radau-iia\"\nstep = 1e-2");
    let session: Session = finished(&text);
    assert_eq!(session.simulation().state().kinematics.time, 1.0);
    // One step more for the jump between two steps, none for the one at the end of a step.
    assert_eq!(session.simulation().totals().steps, 101);
}

#[test]
fn steps_end_at_jumps_that_no_line_of_time_reports_of() {
    // The root of t² - 0.2534 is no straight line, and jumps of the others have no argument with a root.
    let [from, angle] = [0.2534_f64.sqrt(), 40.0_f64];
    let to_and_fro = |end: f64| {
        let (mut time, mut place, mut velocity, mut force) = (0.0, 0.0, 0.0, 1.0);
        let mut turn = 0.0;
        while time < end {
            turn += std::f64::consts::PI / angle;
            let step = turn.min(end) - time;
            place += velocity * step + 0.5 * force * step * step;
            velocity += force * step;
            (time, force) = (turn, -force);
        }
        [place, velocity]
    };
    let saw = [(1..=10).map(|k| (0.05 * f64::from(10 - k) + 0.1 / 6.0) * 0.01).sum::<f64>(), 0.05];
    for scheme in SCHEMES {
        for steps in ["step = 1e-3", "relative_tolerance = 1e-6"] {
            let analysis = format!("scheme = \"{scheme}\"\n{steps}");
            for (force, exact) in [
                ("step(t^2 - 0.2534)", after_jump(from)),
                ("sign(sin(40*t))", to_and_fro(1.0)),
                ("mod(t, 0.1)", saw),
            ] {
                let found = errors(force, &analysis, exact);
                assert!(found.iter().all(|error| *error < 2e-6), "{scheme}, {steps}, {force}: {found:?}");
                let session = finished(&rail(force, &analysis));
                let energy_balance = session.simulation().energy_balance();
                let surplus = energy_balance.surplus;
                assert!(
                    surplus.abs() < 1e-5,
                    "{scheme}, {steps}, {force}: work is that behind the jump, not {surplus}"
                );
            }
        }
    }
}

/// The pulse 1000 exp(-((t - 0.5003)/1e-4)²) N: 0.1 √π N s.
const PULSE: &str = "1000*exp(-((t - 0.5003)/1e-4)^2)";
const IMPULSE: f64 = 0.177_245_385_090_551_6;

#[test]
fn chosen_steps_see_pulses_far_shorter_than_they_are() {
    for scheme in SCHEMES {
        let analysis = format!("scheme = \"{scheme}\"\nrelative_tolerance = 1e-6");
        for (force, more) in [(PULSE.to_owned(), 0.0), (format!("1 + {PULSE}"), 1.0)] {
            let exact = [IMPULSE * (1.0 - 0.5003) + 0.5 * more, IMPULSE + more];
            let found = errors(&force, &analysis, exact);
            assert!(found.iter().all(|error| *error < 1e-4), "{scheme}, {force}: {found:?}");
        }
    }
}

#[test]
fn planned_steps_that_do_not_see_what_a_load_does_are_reported() {
    let reported = |force: &str, step: f64| {
        let session = finished(&rail(force, &format!("scheme = \"generalized-alpha\"\nstep = {step}")));
        let reported: Vec<String> = session
            .warnings()
            .filter(|warning| warning.code() == "function-unseen")
            .map(ToString::to_string)
            .collect();
        reported
    };
    // The first two have the step as their period, or lie between the stages of steps.
    for force in ["sin(2000*pi*t + 0.5)", "1 + sin(2000*pi*t + 0.5)", PULSE] {
        let found = reported(force, 1e-3);
        assert!(found.len() == 1 && found[0].contains("load `"), "{force}: {found:?}");
        assert!(reported(force, 2e-5).is_empty(), "{force}");
    }
    for force in [
        "sin(200*pi*t)",
        "exp(-t) + 0.001*sin(2000*pi*t)",
        "smoothstep((t - 0.5)/1e-4)",
        "t*sin(20*t)/(1 + t^2)",
    ] {
        assert!(reported(force, 1e-3).is_empty(), "{force}");
    }
}

#[test]
fn runs_with_jumps_that_were_found_go_on_from_a_snapshot_to_the_last_bit() {
    for steps in ["step = 1e-3", "relative_tolerance = 1e-5"] {
        let text =
            rail(&format!("sign(sin(40*t)) + {PULSE}"), &format!("scheme = \"generalized-alpha\"\n{steps}"));
        let mut whole = session(&text);
        let mut parts = session(&text);
        for end in [0.07, 0.35, 0.5, 1.0] {
            let reach = |session: &mut Session| session.step_to(end).expect("it has a solution");
            reach(&mut whole);
            reach(&mut parts);
            let snapshot = parts.snapshot();
            parts = session(&text);
            parts.restore(&snapshot).expect("it is of this model");
            assert_eq!(whole.simulation().state(), parts.simulation().state(), "{steps}, {end} s");
        }
    }
}

#[test]
fn drives_that_jump_are_reported() {
    // Whether a run reaches its end, and whether it warns.
    let driven = |displacement: &str, analysis: &str| {
        let drive = "[joints.drive]\nkind = \"prescribed_displacement\"\njoint = \"rail\"";
        let text = format!("{}\n{drive}\ndisplacement = \"{displacement}\"\n", rail("0", analysis));
        let mut session = session(&text);
        let (_, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
        let warns = session.warnings().any(|warning| warning.code() == "drive-jumps");
        (report.is_complete(), warns)
    };
    let mut warned = 0;
    for scheme in ["generalized-alpha", "hht", "radau-iia", "radau-iia-5", "energy-decaying"] {
        let analysis = format!("scheme = \"{scheme}\"\nstep = 3e-3");
        // Where it jumps is no kink that can be known before. Some runs fail for energy out of nothing.
        let (is_complete, warns) = driven("0.1*sign(t^2 - 0.25) + 0.1", &analysis);
        assert!(warns || !is_complete, "{scheme}");
        warned += usize::from(warns);
        for smooth in ["0.3*t^3", "t^4", "0.1*(1 - cos(6*t))", "0.5*max(t - 0.5, 0)^2"] {
            assert_eq!(driven(smooth, &analysis), (true, false), "{scheme}: {smooth}");
        }
    }
    assert!(warned > 0);
}

/// A function of time as part of an expression that depends on the motion too, directly, by signals, and by a straight line
/// of time that signals name: tables beside the load, and its force. `function` is given what to call the time.
fn among_motion(function: impl Fn(&str) -> String) -> Vec<(String, String)> {
    let damped = "(1 - 0.1*rail.velocity)";
    let of_time = function("t");
    let signals = |tables: &str| format!("[signals]\n{tables}\n");
    let whole = signals(&format!("pushing = \"{of_time}*{damped}\""));
    vec![
        (String::new(), format!("{of_time}*{damped}")),
        (signals(&format!("pushing = \"{of_time}\"")), format!("pushing*{damped}")),
        (whole.clone(), "pushing".to_owned()),
        (whole, "pushing/4 + 0.75*pushing".to_owned()),
        (signals("twice = \"2*t\"\nclock = \"twice/2\""), format!("{}*{damped}", function("clock"))),
    ]
}

/// What follows from a force of (1 - 0.1 v) N, v the velocity, from `from` on.
fn after_damped_jump(from: f64) -> [f64; 2] {
    let [elapsed, gone] = [1.0 - from, 1.0 - (-0.1 * (1.0 - from)).exp()];
    [10.0 * (elapsed - 10.0 * gone), 10.0 * gone]
}

#[test]
fn steps_end_at_jumps_of_expressions_that_depend_on_the_motion_too() {
    for scheme in SCHEMES {
        // Without an end there planned steps of 1e-2 s left an error of up to 4e-3 m/s.
        for (sizes, allowed) in
            [("step = 1e-2", 1e-6), ("relative_tolerance = 1e-4\noutput_step = 0.1", 1e-6)]
        {
            let analysis = format!("scheme = \"{scheme}\"\n{sizes}");
            for from in [0.5035, 0.5, 0.509_999, 0.3] {
                for (tables, force) in among_motion(|time| format!("step({time} - {from})")) {
                    let text = rail::rail(1.0, 0.0, &format!("{}{tables}", rail::force(&force)), &analysis);
                    let session = finished(&text);
                    assert_eq!(session.warnings().count(), 0, "{text}");
                    let [place, velocity] = after_damped_jump(from);
                    let missed = [("rail.displacement", place), ("rail.velocity", velocity)]
                        .map(|(name, wanted)| (session.value(name).unwrap() - wanted).abs());
                    assert!(missed.iter().all(|error| *error < allowed), "{text}: {missed:?}");
                }
            }
        }
    }
}

#[test]
fn steps_of_states_end_at_jumps_too() {
    let state = "[states]\nlevel = { derivative = \"step(t - 0.5035)*(1 + 0*level)\" }\n\
         [outputs.level]\nkind = \"signal\"\nof = \"level\"\n";
    for scheme in SCHEMES {
        for sizes in ["step = 1e-2", "relative_tolerance = 1e-4"] {
            let session = finished(&rail::rail(1.0, 0.0, state, &format!("scheme = \"{scheme}\"\n{sizes}")));
            let error = (session.value("level.value").unwrap() - (1.0 - 0.5035)).abs();
            assert!(error < 1e-9, "{scheme}, {sizes}: {error}");
        }
    }
}

#[test]
fn events_find_a_jump_over_time_with_planned_steps() {
    for scheme in SCHEMES {
        let event = "[events.reached]\nzero_of = \"step(t - 0.5035)*(1 + 0*rail.velocity) - 0.5\"\n";
        let session = finished(&rail::rail(1.0, 0.0, event, &format!("scheme = \"{scheme}\"\nstep = 1e-2")));
        let occurrences = session.simulation().occurrences();
        assert_eq!(occurrences.len(), 1, "{scheme}");
        // At the end of the first millionth of the step behind it; the end of the whole step was 6.5e-3 s late.
        assert!((occurrences[0].time - 0.5035).abs() < 2e-8, "{scheme}: {}", occurrences[0].time);
    }
}

#[test]
fn jumps_of_what_is_sampled_or_only_recorded_end_no_steps() {
    let output = "[outputs.pushing]\nkind = \"signal\"\nof = \"pushing\"\n";
    for (value, force) in [
        ("\"step(t - 0.5035)*(1 + rail.velocity)\"", "1 + rail.velocity"),
        ("{ value = \"step(t - 0.5035)*(1 + 0*rail.velocity)\", sample = 0.1 }", "pushing"),
    ] {
        let tables = format!("{}[signals]\npushing = {value}\n{output}", rail::force(force));
        let session = finished(&rail::rail(1.0, 0.0, &tables, "scheme = \"radau-iia\"\nstep = 1e-2"));
        assert_eq!(session.simulation().totals().steps, 100, "{value}");
        assert!(session.value("pushing.value").unwrap() > 0.5);
        if force == "pushing" {
            assert!((session.value("rail.velocity").unwrap() - 0.4).abs() < 1e-12);
        }
    }
}

/// Prescribed motions whose position or speed jumps are reported before they run; those whose acceleration alone jumps are not, however long
/// the run is.
#[test]
fn prescribed_motions_that_jump_are_reported_at_once() {
    for (motion, end, is_reported) in [
        ("max(t - 0.5, 0)", "1", true),
        ("t + 1e-3*step(t - 0.5)", "1", true),
        ("t + step(t - 0.5)", "1e6", true),
        ("t + 0.5*max(t - 0.5, 0)^2", "1", false),
        ("5*max(t - 1, 0)^2", "1e6", false),
        ("sin(3*t)", "1e6", false),
    ] {
        let drive = format!(
            "[joints.drive]\nkind = \"prescribed_displacement\"\njoint = \"rail\"\ndisplacement = \"{motion}\"\n"
        );
        let text = rail::rail(1.0, 0.0, &drive, "step = 1e-2");
        let document = Model::from_text("model.toml", &text)
            .with_overrides(&[("analysis.end".to_owned(), end.to_owned())])
            .document();
        let lowered = document
            .and_then(|document| lower(&document))
            .unwrap_or_else(|report| panic!("{}", report.render(false)));
        let reported =
            lowered.warnings.iter().any(|warning| warning.to_string().contains("jumps in position or speed"));
        assert_eq!(reported, is_reported, "{motion}: {:?}", lowered.warnings);
    }
}

/// The warning names the first jump and how many follow. Speeds are compared with the largest one, wherever that is.
#[test]
fn warnings_of_drives_count_their_jumps() {
    for (motion, from, until, wanted) in [
        ("max(t - 0.25, 0)", "0", "1", Some("at t = 0.25 s:")),
        ("max(t - 0.25, 0) + max(t - 0.5, 0)", "0", "1", Some("at t = 0.25 s and 1 more times")),
        (
            "max(t - 0.25, 0) - max(t - 0.5, 0) + max(t - 0.75, 0)",
            "0",
            "1",
            Some("at t = 0.25 s and 2 more times"),
        ),
        // Beyond the run.
        ("max(t - 0.25, 0) + max(t - 1.5, 0)", "0", "1", Some("at t = 0.25 s:")),
        ("max(t - 1.5, 0)", "0", "1", None),
        ("t - 0.35 + max(t - 0.25, 0)", "0.3", "1", None),
        // A small jump beside a speed that is large there alone, right before a kink of another kind, or right after it.
        (
            "1e4*max(t - 0.5, 0)^4 - 1e4*max(t - 0.5, 0)^4*step(t - 0.505) + 6.25e-6*step(t - 0.505) + 1e-6*max(t - 0.25, 0)",
            "0",
            "1",
            Some("at t = 0.505 s:"),
        ),
        // A small jump beside a slow motion.
        ("1e-6*t + 1e-6*max(t - 0.25, 0)", "0", "1", Some("at t = 0.25 s:")),
        ("t + 1e-4*max(t - 0.25, 0)", "0", "1", None),
        ("t + 1e-2*max(t - 0.25, 0)", "0", "1", Some("at t = 0.25 s:")),
        // Large values without a jump, and a position that jumps while the speed does not.
        ("1e3*t + 50*max(t - 0.25, 0)^2", "0", "1", None),
        ("t - 1e-2*step(t - 0.25)", "0", "1", Some("at t = 0.25 s:")),
    ] {
        let drive = format!(
            "[joints.drive]\nkind = \"prescribed_displacement\"\njoint = \"rail\"\ndisplacement = \"{motion}\"\n"
        );
        let times = [("analysis.start", from), ("analysis.end", until)]
            .map(|(key, value)| (key.to_owned(), value.to_owned()));
        let document = Model::from_text("model.toml", &rail::rail(1.0, 0.0, &drive, "step = 1e-2"))
            .with_overrides(&times)
            .document();
        let lowered = document
            .and_then(|document| lower(&document))
            .unwrap_or_else(|report| panic!("{motion}: {}", report.render(false)));
        let warnings: Vec<String> = lowered.warnings.iter().map(ToString::to_string).collect();
        let found = warnings.iter().find(|warning| warning.contains("jumps in position or speed"));
        assert_eq!(found.is_some(), wanted.is_some(), "{motion}: {warnings:?}");
        assert!(
            found.is_none_or(|found| wanted.is_some_and(|wanted| found.contains(wanted))),
            "{motion}: {warnings:?}"
        );
    }
}
