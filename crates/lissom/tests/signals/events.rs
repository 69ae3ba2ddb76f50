//! Events, and forces with kinks: instants against closed forms, what happens there, and what is rejected.

use crate::support::rail;
use crate::support::refused;
use crate::support::sessions;

use lissom::Session;
use rail::force;
use refused::refused;
use sessions::{finished, session};

const SCHEMES: [&str; 5] = ["radau-iia", "radau-iia-5", "generalized-alpha", "hht", "energy-decaying"];

/// A mass of 1 kg on a rail along x, thrown with 0.5 m/s; `tables` and keys of the analysis are added.
fn rail(tables: &str, analysis: &str) -> String {
    rail::rail(1.0, 0.5, tables, analysis)
}

fn failure(text: &str) -> String {
    let mut session = session(text);
    let (_, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    report.error().map_or_else(|| panic!("the run reaches its end"), ToString::to_string)
}

fn value(session: &Session, name: &str) -> f64 {
    session.value(name).unwrap_or_else(|| panic!("there is no {name}"))
}

/// Contact lasts 0.3 ms, and no step sees it coming: a step that went on into it would keep the position and lose the velocity.
#[test]
fn a_stiff_contact_gives_the_velocity_back_with_every_scheme() {
    let spring = |keys: &str| format!("[springs.stop]\njoint = \"rail\"\nstiffness = 1e8\n{keys}\n");
    for stop in [
        force("-1e8*max(0, rail.displacement - 0.1)"),
        force("-1e8*if(rail.displacement > 0.1, rail.displacement - 0.1, 0)"),
        spring("kind = \"axial_stop\"\nrange = [-10, 0.1]"),
        spring("kind = \"axial\"\nside = \"tension\"\ndisplacement = 0.1"),
        spring("kind = \"axial\"\nbacklash = 10.2\ndisplacement = -5"),
    ] {
        for scheme in SCHEMES {
            for (tolerance, allowed) in [("1e-4", 0.03), ("1e-6", 2e-3)] {
                let analysis = format!("relative_tolerance = {tolerance}\nscheme = \"{scheme}\"");
                let session = finished(&rail(&stop, &analysis));
                let velocity = value(&session, "rail.velocity");
                assert!((velocity + 0.5).abs() < 0.5 * allowed, "{stop}{scheme}, {tolerance}: {velocity}");
                assert!(session.simulation().totals().steps < 1000, "{stop}{scheme}, {tolerance}");
            }
        }
    }
}

/// The apex is 1 mm above the level: both roots are in the first quarter of a step, or in the last one.
#[test]
fn roots_between_two_checked_instants_are_found_once_each() {
    // x = t/2 - t²/2.
    for (step, level) in [(0.45, 0.124), (0.55, 0.124), (0.6, 0.1249)] {
        let tables = format!("{}[events.passage]\nzero_of = \"rail.displacement - {level}\"\n", force("-1"));
        let half = (0.25_f64 - 2.0 * level).sqrt();
        for scheme in SCHEMES {
            let session = finished(&rail(&tables, &format!("step = {step}\nscheme = \"{scheme}\"")));
            let found: Vec<f64> = session.events().map(|(_, time)| time).collect();
            assert_eq!(found.len(), 2, "{scheme}, {step}: {found:?}");
            for (time, wanted) in found.iter().zip([0.5 - half, 0.5 + half]) {
                assert!((time - wanted).abs() < 1e-6, "{scheme}, {step}: {time} instead of {wanted}");
            }
        }
    }
}

#[test]
fn events_are_found_where_closed_forms_have_them() {
    // x = t/2 - t².
    let tables = format!(
        "{}[events.passage]\nzero_of = \"rail.displacement - 0.05\"\n\
         [events.back]\nzero_of = \"rail.displacement\"\ndirection = \"falling\"\n",
        force("-2")
    );
    let root = (1.0_f64 / 16.0 - 0.05).sqrt();
    for scheme in SCHEMES {
        for (analysis, allowed) in
            [("relative_tolerance = 1e-8", 1e-7), ("step = 0.01", 1e-4), ("step = 0.3", 0.05)]
        {
            let session = finished(&rail(&tables, &format!("{analysis}\nscheme = \"{scheme}\"")));
            let found: Vec<(&str, f64)> = session.events().collect();
            let wanted = [("passage", 0.25 - root), ("passage", 0.25 + root), ("back", 0.5)];
            assert_eq!(found.len(), 3, "{scheme}, {analysis}: {found:?}");
            for ((name, time), (wanted_name, wanted)) in found.iter().zip(wanted) {
                assert_eq!(*name, wanted_name);
                assert!(
                    (time - wanted).abs() < allowed,
                    "{scheme}, {analysis}: {name} at {time}, not {wanted}"
                );
            }
        }
    }
}

/// Radau solves parabolas exactly, so that the root shows how well it is located.
#[test]
fn roots_are_located_to_a_part_in_ten_thousand_million_of_the_step() {
    let event = "[events.fast]\nzero_of = \"rail.velocity^3 + rail.displacement - 1\"\n";
    for analysis in ["step = 0.25", "relative_tolerance = 1e-3"] {
        let session = finished(&rail(
            &format!("{}{event}", force("2")),
            &format!("{analysis}\nscheme = \"radau-iia\""),
        ));
        let (_, time) = session.events().next().expect("it happens");
        let at = |t: f64| (0.5 + 2.0 * t).powi(3) + 0.5 * t + t * t - 1.0;
        assert!(at(time).abs() < 1e-9, "{analysis}: {:e} at {time}", at(time));
    }
}

/// What jumps where another number passes through zero, from either side and to a small value or a large one, has its event there; what
/// only touches zero has none.
#[test]
fn numbers_that_jump_are_located_like_those_that_pass() {
    let spring = force("-40*rail.displacement - 300*rail.displacement^3");
    let times = |zero_of: &str, analysis: &str| {
        let event = format!("[events.passage]\nzero_of = \"{zero_of}\"\n");
        let session = finished(&rail(&format!("{spring}{event}"), analysis));
        session.events().map(|(_, time)| time).collect::<Vec<f64>>()
    };
    for scheme in SCHEMES {
        for (analysis, step) in [("step = 0.03", 0.03), ("relative_tolerance = 1e-5", 0.1)] {
            let analysis = format!("{analysis}\nscheme = \"{scheme}\"");
            let wanted = times("rail.displacement - 0.03", &analysis);
            assert!(wanted.len() >= 2, "{wanted:?}");
            for zero_of in [
                "sign(rail.displacement - 0.03)",
                "sign(rail.displacement - 0.03) + 0.2",
                "if(rail.displacement > 0.03, 1, -1e-3)",
                "if(rail.displacement > 0.03, 1e-3, -1)",
                "step(rail.displacement - 0.03) - 0.5 + 0.1*rail.displacement",
            ] {
                let found = times(zero_of, &analysis);
                assert_eq!(found.len(), wanted.len(), "{zero_of}, {analysis}: {found:?}, not {wanted:?}");
                // The first: later ones follow other steps, since events end steps.
                assert!(
                    (found[0] - wanted[0]).abs() < 1e-9 * step,
                    "{zero_of}, {analysis}: {found:?}, not {wanted:?}"
                );
            }
            for zero_of in ["max(rail.displacement - 0.03, 0)", "abs(rail.displacement - 0.03)"] {
                let found = times(zero_of, &analysis);
                assert!(found.is_empty(), "{zero_of}, {analysis}: {found:?}");
            }
        }
    }
}

/// Uniform motion and even steps: every root is at the end of a step except for round-off, which hides its sign.
#[test]
fn roots_at_ends_of_steps_happen_there_and_once() {
    for scheme in SCHEMES {
        for (step, parts) in [("0.01", 100_u32), ("0.03125", 32), ("0.1", 10), ("0.25", 4)] {
            for scale in [1.0, 1e-3, 1e3] {
                let events = (1..parts).map(|k| {
                    format!(
                        "[events.e{k}]\nzero_of = \"{scale:?}*(rail.displacement - 0.5*{k}/{parts})\"\n\
                         [events.f{k}]\nzero_of = \"rail.displacement - 0.5*{k}/{parts}\"\ndirection = \"falling\"\n"
                    )
                });
                let session = finished(&rail(
                    &events.collect::<String>(),
                    &format!("step = {step}\nscheme = \"{scheme}\""),
                ));
                let found: Vec<(&str, f64)> = session.events().collect();
                assert_eq!(found.len() as u32, parts - 1, "{scheme}, {step}, {scale}: {found:?}");
                for (k, (name, time)) in (1..parts).zip(&found) {
                    assert_eq!(*name, format!("e{k}"));
                    let late = time - f64::from(k) / f64::from(parts);
                    assert!(
                        late.abs() < 1e-10 / f64::from(parts),
                        "{scheme}, {step}, {scale}: {late:e} late"
                    );
                }
            }
        }
    }
}

/// A value that reaches zero at the end of a step and turns back is no event; one that does so shortly before is located.
#[test]
fn numbers_that_turn_back_at_the_end_of_a_step_do_not_pass() {
    // x = t/2 - t²: its rate is zero at 0.25 s, where x is 1/16.
    let touched = format!("{}[events.top]\nzero_of = \"rail.displacement - 0.0625 - 1e-12\"\n", force("-2"));
    for step in ["0.05", "0.125", "0.25"] {
        let session = finished(&rail(&touched, &format!("step = {step}\nscheme = \"radau-iia\"")));
        assert_eq!(session.events().count(), 0, "{step}");
    }
    for (before, allowed) in [(1e-4, 1e-12), (1e-6, 1e-12), (1e-8, 1e-12), (1e-11, 2e-12), (0.0, 1e-12)] {
        let event = format!(
            "[events.half]\nzero_of = \"rail.displacement - 0.25*(1 - {before:?})\"\nset = {{ push = 1 }}\n"
        );
        let tables = format!("[inputs]\npush = 0\n{}{event}", force("push"));
        let session = finished(&rail(&tables, "step = 0.01\nscheme = \"radau-iia\""));
        let found: Vec<f64> = session.events().map(|(_, time)| time).collect();
        assert_eq!(found.len(), 1, "{before:e}: {found:?}");
        assert!((found[0] - 0.5 * (1.0 - before)).abs() < allowed, "{before:e}: {found:?}");
    }
}

#[test]
fn an_event_that_stops_ends_the_run_there() {
    let event = "[events.half]\nzero_of = \"rail.displacement - 0.123\"\nstop = true\n";
    for analysis in ["step = 0.01", "relative_tolerance = 1e-6"] {
        let mut session = session(&rail(event, &format!("{analysis}\nscheme = \"radau-iia\"")));
        let (record, report) = session.run().unwrap().into_parts();
        assert_eq!(session.stopped_by(), Some("half"));
        assert!((report.time - 0.246).abs() < 1e-9, "{}", report.time);
        assert_eq!(record.times.last(), Some(&report.time));
        assert!((value(&session, "rail.displacement") - 0.123).abs() < 1e-10);
        // Rows before it are where they were planned.
        if analysis == "step = 0.01" {
            assert_eq!(record.times.len(), 26);
            assert!((record.times[24] - 0.24).abs() < 1e-12);
        }
        // It can be driven on, beyond the event and to the end.
        session.step_to(0.5).unwrap();
        assert!((value(&session, "rail.displacement") - 0.25).abs() < 1e-9);
        assert_eq!(session.stopped_by(), None);
    }
}

/// Thrust until a speed of 1 m/s is reached at 0.25 s, then less, then a brake from 0.5 m on.
const STAGES: &str = r#"
[inputs]
thrust = 2
brake = 0
[events.fast]
zero_of = "rail.velocity - 1"
direction = "rising"
set = { thrust = 0.5 }
[events.far]
zero_of = "rail.displacement - 0.5"
set = { brake = "thrust + 4*rail.velocity" }
"#;

#[test]
fn events_set_inputs() {
    let tables = format!("{}{STAGES}", force("thrust - brake"));
    // Radau and the energy-decaying scheme solve parabolas exactly, but the first event lies at the end of a planned step,
    // and no step is shorter than a millionth of it. The others err in second order.
    for (scheme, allowed) in SCHEMES.into_iter().zip([1e-7, 1e-4, 1e-4, 1e-7]) {
        let session = finished(&rail(&tables, &format!("step = 0.01\nscheme = \"{scheme}\"")));
        // From 0.1875 m at 0.25 s with 1 m/s on, 0.5 m is reached with this speed, and the brake takes 4 v.
        let speed = 1.3125_f64.sqrt();
        let rest = 1.0 - (0.25 + 2.0 * (speed - 1.0));
        let velocity = value(&session, "rail.velocity");
        assert!((velocity - speed * (1.0 - 4.0 * rest)).abs() < 10.0 * allowed, "{scheme}: {velocity}");
        let place = 0.5 + speed * (rest - 2.0 * rest * rest);
        let found = value(&session, "rail.displacement");
        assert!((found - place).abs() < allowed, "{scheme}: {found}, not {place}");
        assert_eq!(session.events().count(), 2, "{scheme}: {:?}", session.events().collect::<Vec<_>>());
    }
}

#[test]
fn a_restored_session_goes_on_to_the_last_bit() {
    let tables = format!("{}{STAGES}", force("thrust - brake - 1e6*max(0, rail.displacement - 0.55)"));
    for analysis in ["step = 0.01", "relative_tolerance = 1e-6"] {
        let text = rail(&tables, &format!("{analysis}\nscheme = \"radau-iia\""));
        let mut whole = session(&text);
        let mut kept = None;
        while !whole.is_finished() {
            if kept.is_none() && whole.progress().time > 0.4 {
                kept = Some(whole.snapshot());
            }
            whole.advance().unwrap();
        }
        let mut restored = session(&text);
        restored.restore(&kept.expect("it passes 0.4 s")).unwrap();
        while !restored.is_finished() {
            restored.advance().unwrap();
        }
        assert_eq!(whole.snapshot(), restored.snapshot());
        assert!(whole.events().count() >= 2);
        assert_eq!(whole.events().collect::<Vec<_>>(), restored.events().collect::<Vec<_>>());
    }
}

/// Dry friction as a jump of sign cannot hold a mass: the force switches to and fro.
#[test]
fn what_slides_along_its_switch_is_reported() {
    let message = failure(&rail(&force("-2*sign(rail.velocity)"), "relative_tolerance = 1e-5"));
    assert!(message.contains("a thousand times") || message.contains("relative_tolerance"), "{message}");
}

#[test]
fn events_that_make_no_sense_are_refused() {
    let unknown =
        rail("[inputs]\nmotor = 0\n[events.x]\nzero_of = \"t - 0.5\"\nset = { moter = 1 }\n", "step = 0.1");
    let message = refused(&unknown);
    assert!(message.contains("`moter`, which is not an input") && message.contains("motor"), "{message}");
    let statics = rail("[events.x]\nzero_of = \"t - 0.5\"\n", "steps = 2").replace("dynamics", "statics");
    assert!(refused(&statics).contains("no motion in time"), "{}", refused(&statics));
    let name = rail("[events.x]\nzero_of = \"rail.displacment\"\n", "step = 0.1");
    assert!(refused(&name).contains("displacment"), "{}", refused(&name));
}
