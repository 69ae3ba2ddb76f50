//! How loads and rotation change the stiffness of superelements.

use super::*;

/// A beam that spins about its end under its weight, damped until it is at rest: the deflection of the end, and the warnings.
fn spinning(model: &Model, speed: f64) -> (f64, Vec<(String, f64)>) {
    let overrides = [set("parameters.speed", &speed.to_string())];
    let mut session = model.with_overrides(&overrides).session().unwrap_or_else(|error| panic!("{error}"));
    let record = session.run().unwrap();
    let warnings = session.warnings().filter_map(|warning| match warning {
        lissom_core::errors::Warning::LoadStiffness { largest, .. } => {
            Some((warning.code().to_owned(), 0.5 * largest))
        }
        lissom_core::errors::Warning::TurnsFast { .. } => None,
        other => Some((other.code().to_owned(), 0.0)),
    });
    (last(&record, "end", "u3"), warnings.collect())
}

const SPIN: &str = "[joints.hinge]\nkind = \"prescribed_motion\"\nbase = \"ground\"\ntip = \"START\"\nrz = \"speed*t\"\n\
     [initial]\nangular_velocity = [0, 0, \"speed\"]\n\
     [outputs.end]\nkind = \"displacement\"\nof = \"END\"\n\
     [analysis]\nkind = \"dynamics\"\nend = 0.4\nstep = 1e-3\nscheme = \"radau-iia\"\n";

/// The damped beam that spins under its weight, and what it is reduced to.
fn spinning_models(damped: &str, report: &ReduceReport) -> (Model, Model) {
    let weighed = |text: &str, start: &str, end: &str| {
        // Gravity and parameters are above all tables.
        let text =
            text.replace("lissom = 1\n", "lissom = 1\ngravity = [0, 0, -0.5]\n[parameters]\nspeed = 1\n");
        let text = text.replace(MODES, "");
        Model::from_text("model.toml", &format!("{text}{}", SPIN.replace("START", start).replace("END", end)))
    };
    let (_, table) = report.files.last().expect("the table");
    let texts: BTreeMap<String, String> = report.files.iter().cloned().collect();
    let own = weighed(table, "part.bar_start", "part.bar_end").with_known(texts);
    (weighed(damped, "bar.start", "bar.end"), own)
}

/// Spinning beam of a hub and a tip, over speeds: an error of 1 % of the deflection causes a warning, and one of 0.1 % does not.
#[test]
fn stiffness_that_rotation_changes_is_reported() {
    let damped = beam(MODES).replace("[beams.bar]", "damping = 0.01\n[beams.bar]");
    let report = bare(&reduced(&damped, &["bar.start", "bar.end"], 4));
    let (exact, own) = spinning_models(&damped, &report);
    let mut sides = [0, 0];
    for speed in [0.5, 1.0, 2.0, 4.0, 7.0, 10.0, 15.0] {
        let (bent, none) = spinning(&exact, speed);
        assert!(none.is_empty(), "{none:?}");
        let (found, warnings) = spinning(&own, speed);
        let error = (found / bent - 1.0).abs();
        match warnings.as_slice() {
            [] => assert!(error < 0.005, "{speed} rad/s: {error} without a warning"),
            [(code, share)] => {
                assert_eq!(code, "load-stiffness");
                assert!(
                    error > 0.001 && (0.5..5.0).contains(&(0.01 * share / error)),
                    "{speed}: {error} {share}"
                );
            }
            more => panic!("{more:?}"),
        }
        sides[usize::from(error > 0.01)] += 1;
    }
    assert!(sides[0] > 2 && sides[1] > 2, "{sides:?}");
}

/// The rod of the slider crank, over speeds: the same.
#[test]
fn stiffness_that_axial_forces_change_is_reported() {
    let (exact, model) = slider_cranks();
    let model = model.without("superelements.rod.geometric");
    for speed in [100, 250, 500, 1000] {
        let overrides = [set("parameters.speed", &format!("{speed}*2*pi/60"))];
        let (error, _) = rod_error(&exact, &model, &overrides);
        let mut session = model.with_overrides(&overrides).session().expect("a good model");
        assert!(session.run().is_ok());
        let codes: Vec<&str> = session.warnings().map(lissom_core::errors::Warning::code).collect();
        match codes.as_slice() {
            [] => assert!(error < 0.005, "{speed} 1/min: {error} without a warning"),
            ["load-stiffness"] => assert!(error > 0.001, "{speed} 1/min: {error}"),
            more => panic!("{more:?}"),
        }
        assert_eq!(codes.is_empty(), speed < 300, "{speed} 1/min: {error}");
    }
}

/// With the second order that `lissom reduce` writes, the spinning superelement bends as the beam does, without a warning.
#[test]
fn geometric_stiffness_is_that_of_the_beam() {
    let damped = beam(MODES).replace("[beams.bar]", "damping = 0.01\n[beams.bar]");
    let report = reduced(&damped, &["bar.start", "bar.end"], 12);
    assert!(report.files.iter().any(|(name, _)| name == "part-geometric.mtx"));
    let (exact, own) = spinning_models(&damped, &report);
    for speed in [5.0, 15.0, 30.0, 49.0] {
        let (bent, _) = spinning(&exact, speed);
        let (found, warnings) = spinning(&own, speed);
        let error = (found / bent - 1.0).abs();
        assert!(error < 0.005 && warnings.is_empty(), "{speed} rad/s: {error:e}, {warnings:?}");
    }
}

/// Frequencies of a beam that turns about its end, with rotation up to its first frequency: flapping and in the plane.
#[test]
fn frequencies_in_rotation_are_those_of_the_beam() {
    let report = reduced(&beam(MODES), &["bar.start", "bar.end"], 8);
    for hub in [0.0, 0.3] {
        let rest = |start: &str, speed: f64| {
            format!(
                "[bodies.hub]\nmass = 1\ninertia = [1, 1, 1]\nposition = [{0}, 0, 0]\n\
                 [joints.hinge]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"hub\"\naxis = [0, 0, 1]\nat = [{0}, 0, 0]\n\
                 [joints.spin]\nkind = \"prescribed_rotation\"\njoint = \"hinge\"\nrotation = \"{speed}*t\"\n\
                 [joints.root]\nkind = \"clamp\"\nbase = \"hub\"\ntip = \"{start}\"\n\
                 [initial]\nangular_velocity = [0, 0, {speed}]\nabout = [{0}, 0, 0]\n[analysis]\nkind = \"modes\"\n",
                -hub
            )
        };
        for speed in [10.0, 25.0, 49.0] {
            let request = ModeRequest {
                count: Some(4),
                about: Some(OperatingPoint::Rotation),
                ..ModeRequest::default()
            };
            let of = |model: &Model| -> Vec<f64> {
                let found = modes(model, &request).unwrap_or_else(|error| panic!("{error}"));
                found.modes.iter().map(|mode| mode.frequency).collect()
            };
            let text = beam(MODES).replace(MODES, "");
            let exact = of(&Model::from_text("model.toml", &format!("{text}{}", rest("bar.start", speed))));
            let found = of(&using(&report, &rest("part.bar_start", speed)));
            for (found, exact) in found.iter().zip(&exact) {
                assert!(
                    (found / exact - 1.0).abs() < 0.002,
                    "hub {hub} m, {speed} rad/s: {found}, beam {exact}"
                );
            }
        }
    }
}

/// The slider crank's rod with its geometric stiffness: what is left is of the fourth power of the speed.
#[test]
fn geometric_stiffness_of_the_rod_is_that_of_the_beam() {
    let (exact, model) = slider_cranks();
    for (speed, allowed) in [(250, 1e-4), (500, 5e-4), (1000, 0.002), (2000, 0.015)] {
        let overrides = [set("parameters.speed", &format!("{speed}*2*pi/60"))];
        let (error, _) = rod_error(&exact, &model, &overrides);
        assert!(error < allowed, "{speed} 1/min: {error}");
        let mut session = model.with_overrides(&overrides).session().expect("a good model");
        assert!(session.run().is_ok());
        assert_eq!(session.warnings().count(), 0, "{speed} 1/min");
    }
}

/// Energy and momentum of a free part that turns and bends, with second-order matrices and every scheme.
#[test]
fn geometric_stiffness_keeps_energy_and_momentum() {
    let report = reduced(&beam(MODES), &["bar.start", "bar.end"], 6);
    let rest = "[initial]\nvelocity = [0.5, 0, 1]\nangular_velocity = [1, 8, 5]\n\
                [outputs.energy]\nkind = \"energy\"\n[outputs.momentum]\nkind = \"momentum\"\n\
                [analysis]\nkind = \"dynamics\"\nend = 0.2\nstep = 2e-4\n";
    for scheme in SCHEMES {
        let record = ran(&using(&report, rest), &[set("analysis.scheme", scheme)]);
        for component in ["p1", "p2", "p3", "l1", "l2", "l3"] {
            let values = column(&record, "momentum", component);
            let change = values.iter().map(|value| (value - values[0]).abs()).fold(0.0, f64::max);
            assert!(change < 1e-4, "{scheme}: {component} {change:e}");
        }
        let energy = column(&record, "energy", "total");
        let change = energy.iter().map(|value| (value / energy[0] - 1.0).abs()).fold(0.0, f64::max);
        assert!(change < 2e-3, "{scheme}: {change:e}");
    }
}

/// Files of second-order matrices that do not fit are rejected.
#[test]
fn geometric_matrices_that_do_not_fit_are_refused() {
    let report = reduced_to_modes(&beam(MODES), &["bar.start", "bar.end"], 2);
    let other = reduced_to_modes(
        &beam(MODES).replace("to = [1, 0, 0]", "to = [1.1, 0, 0]"),
        &["bar.start", "bar.end"],
        2,
    );
    let more = reduced_to_modes(&beam(MODES), &["bar.start", "bar.end"], 3);
    let message = |taken: &ReduceReport, change: (&str, &str)| {
        let mut mixed = report.clone();
        for ((name, text), (_, taken)) in mixed.files.iter_mut().zip(&taken.files) {
            if name.contains("geometric") {
                taken.clone_into(text);
            }
            *text = text.replace(change.0, change.1);
        }
        let text = using(&mixed, MODES).document().expect_err("does not match").render(false);
        text.replace('│', " ").split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let none = ("no such words", "");
    assert!(message(&other, none).contains("does not match the mass"), "{}", message(&other, none));
    assert!(message(&more, none).contains("needs 14 columns and 306 rows"), "{}", message(&more, none));
    let floating = ("geometric =", "floating = \"bar_end\"\ngeometric =");
    assert!(
        message(&report, floating).contains("are valid for the first interface"),
        "{}",
        message(&report, floating)
    );
}

/// The beam that spins at up to its first frequency: what modes that are omitted would do is made up for.
#[test]
fn corrections_make_up_for_modes_left_out() {
    let damped = beam(MODES).replace("[beams.bar]", "damping = 0.01\n[beams.bar]");
    let errors = |report: &ReduceReport| {
        let (exact, own) = spinning_models(&damped, report);
        [15.0, 30.0, 49.0].map(|speed| {
            let ((bent, _), (found, warnings)) = (spinning(&exact, speed), spinning(&own, speed));
            assert!(warnings.is_empty(), "{speed} rad/s: {warnings:?}");
            (found / bent - 1.0).abs()
        })
    };
    for modes in [0, 2, 6, 12] {
        let report = reduced(&damped, &["bar.start", "bar.end"], modes);
        assert_eq!(report.unknowns[1], 12 + modes + report.corrections);
        let [slow, fast, fastest] = errors(&report);
        println!("{modes} {} {slow:e} {fast:e} {fastest:e}", report.corrections);
        assert!(slow < 1e-4 && fast < 3e-4 && fastest < 1.5e-3, "{modes}: {slow:e} {fast:e} {fastest:e}");
        assert!((1..20).contains(&report.corrections), "{modes}: {}", report.corrections);
    }
    // The static response of modes that are omitted stiffens six modes alone, none of which stretches the beam.
    let [slow, fast, fastest] = errors(&reduced_to_modes(&damped, &["bar.start", "bar.end"], 6));
    println!("6 none {slow:e} {fast:e} {fastest:e}");
    assert!(fastest < 1.5e-3, "{fastest:e}");
}
