//! Blades that `lissom reduce` makes of beams, in motions in which the shortening of what bends matters: interface forces against those
//! of the beam itself.

use super::*;

/// A blade of 20 m and 10 t, from the origin along an axis.
fn blade(axis: char, is_tapered: bool, is_twisted: bool) -> String {
    let [to, up] = match axis {
        'x' => ["[20, 0, 0]", "[0, 0, 1]"],
        'y' => ["[0, 20, 0]", "[0, 0, 1]"],
        _ => ["[0, 0, 20]", "[1, 0, 0]"],
    };
    let sections = if is_tapered {
        "stations = [{ at = 0, section = \"root\" }, { at = 1, section = \"end\" }]"
    } else {
        "section = \"root\""
    };
    let end = "[sections.end]\nshape = \"rectangle\"\nmaterial = \"glass\"\nwidth = 0.3\nheight = 0.08\n";
    let (end, twist) =
        (if is_tapered { end } else { "" }, if is_twisted { "twist = \"0.15*(1 - s)\"\n" } else { "" });
    format!(
        "lissom = 1\n[materials.glass]\nE = 30e9\nnu = 0.3\ndensity = 1900\n\
         [sections.root]\nshape = \"rectangle\"\nmaterial = \"glass\"\nwidth = 0.9\nheight = 0.3\n{end}\
         [beams.blade]\nfrom = [0, 0, 0]\nto = {to}\nup = {up}\n{sections}\n{twist}elements = 8\n"
    )
}

fn reduced_blade(blade: &str, modes: usize, corrections: bool) -> ReduceReport {
    let request = ReduceRequest {
        corrections,
        name: Some("blade".to_owned()),
        ..request(&["blade.start", "blade.end"], modes)
    };
    reduce(&Model::from_text("model.toml", &format!("{blade}{MODES}")), &request)
        .unwrap_or_else(|error| panic!("{error}"))
}

/// The model with the blade itself, and with what it was reduced to.
fn models(blade: &str, report: &ReduceReport, head: &str, rest: &str) -> [Model; 2] {
    let of = |blade: &str, [start, end]: [&str; 2]| {
        let rest = rest.replace("START", start).replace("END", end);
        Model::from_text(
            "model.toml",
            &format!("{}{rest}", blade.replace("lissom = 1\n", &format!("lissom = 1\n{head}\n"))),
        )
    };
    let (_, table) = report.files.last().expect("the table comes last");
    let texts: BTreeMap<String, String> = report.files.iter().cloned().collect();
    [
        of(blade, ["blade.start", "blade.end"]),
        of(table, ["blade.blade_start", "blade.blade_end"]).with_known(texts),
    ]
}

/// The value of a column at a time, between records.
fn at(record: &lissom::Record, component: &str, time: f64) -> f64 {
    let (times, values) = (&record.times, column(record, "root", component));
    let next = times.iter().position(|own| *own >= time).unwrap_or(times.len() - 1).max(1);
    let part = (time - times[next - 1]) / (times[next] - times[next - 1]);
    values[next - 1] + part * (values[next] - values[next - 1])
}

/// The largest difference of components of the root's reaction, in parts of the largest of them.
fn difference(exact: &lissom::Record, found: &lissom::Record, components: &[&str]) -> f64 {
    let end = exact.times.last().copied().expect("steps");
    let instants: Vec<f64> = (0..=200).map(|k| end * f64::from(k) / 200.0).collect();
    let largest = components
        .iter()
        .flat_map(|component| column(exact, "root", component))
        .fold(0.0_f64, |most, value| most.max(value.abs()));
    let wrong = components
        .iter()
        .flat_map(|component| instants.iter().map(move |time| (component, *time)))
        .map(|(component, time)| (at(exact, component, time) - at(found, component, time)).abs());
    wrong.fold(0.0, f64::max) / largest
}

/// A hub with a blade that is turned by a motor.
fn on_a_hub(axis: char, rotation: &str, speed: f64, rest: &str, end: f64) -> String {
    let (direction, spin, thrust) = if axis == 'z' {
        ("[1, 0, 0]", format!("[{speed}, 0, 0]"), "[300, 0, 0]")
    } else {
        ("[0, 0, 1]", format!("[0, 0, {speed}]"), "[0, 0, 300]")
    };
    format!(
        "[bodies.hub]\nmass = 500\ninertia = [100, 100, 100]\n\
         [joints.shaft]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"hub\"\naxis = {direction}\n\
         [joints.motor]\nkind = \"prescribed_rotation\"\njoint = \"shaft\"\nrotation = \"{rotation}\"\n\
         [joints.root]\nkind = \"clamp\"\nbase = \"hub\"\ntip = \"START\"\n\
         [loads.thrust]\nkind = \"force\"\non = \"END\"\nvector = {thrust}\n\
         [outputs.root]\nkind = \"reaction\"\nof = \"root\"\naxes = \"base\"\n\
         [initial]\nangular_velocity = {spin}\n{rest}\
         [analysis]\nkind = \"dynamics\"\nend = {end}\n"
    )
}

/// From rest up to speed, smoothly: reactions of the root under weight and thrust, by every scheme, are those of the beam.
#[test]
fn reactions_in_a_smooth_start_are_those_of_the_beam() {
    let rotation = "2.5*4*((t/4)^4*(2.5 - 3*(t/4) + (t/4)^2))";
    for (axis, is_tapered, modes) in [('x', false, 4), ('y', true, 0), ('z', true, 6)] {
        let text = blade(axis, is_tapered, is_tapered);
        let report = reduced_blade(&text, modes, true);
        let rest = on_a_hub(axis, rotation, 0.0, "equilibrium = true\n", 1.0);
        let [exact, own] = models(&text, &report, "gravity = [0, -9.81, 0]", &rest);
        let exact = ran(&exact, &[]);
        for scheme in SCHEMES {
            let found = ran(&own, &[set("analysis.scheme", scheme)]);
            for components in [["f1", "f2", "f3"], ["m1", "m2", "m3"]] {
                let error = difference(&exact, &found, &components);
                assert!(error < 0.02, "{axis}, {modes} modes, {scheme}, {components:?}: {error}");
            }
        }
    }
    // The moment of the thrust alone, which is a hundredth of that of the weight.
    let text = blade('x', false, false);
    let rest = on_a_hub('x', rotation, 0.0, "equilibrium = true\n", 1.0);
    let report = reduced_blade(&text, 4, true);
    let [exact, own] = models(&text, &report, "gravity = [0, -9.81, 0]", &rest);
    let exact = ran(&exact, &[]);
    for scheme in SCHEMES {
        let error = difference(&exact, &ran(&own, &[set("analysis.scheme", scheme)]), &["m2"]);
        assert!(error < 0.02, "{scheme}: {error}");
    }
}

/// A blade that turns from the start on is not stretched yet: it is then stretched to and fro by up to twice the centrifugal
/// force. That must not shake it across.
#[test]
fn an_axial_jolt_does_not_shake_a_blade_across() {
    let text = blade('x', false, false);
    let rest = on_a_hub('x', "2.5*t", 2.5, "", 0.2);
    for (modes, corrections) in [(0, false), (4, true), (10, true)] {
        let report = reduced_blade(&text, modes, corrections);
        let [exact, own] = models(&text, &report, "", &rest);
        let exact = ran(&exact, &[]);
        let mut session = own.session().unwrap_or_else(|error| panic!("{error}"));
        let found = session.run().unwrap();
        let codes: Vec<&str> = session.warnings().map(lissom_core::errors::Warning::code).collect();
        assert_eq!(codes.contains(&"modes-left-out"), modes == 0, "{modes} modes: {codes:?}");
        for (component, allowed) in [("f3", 2.5), ("m2", 2.5), ("f1", 1.05)] {
            let [exact, found] = [&exact, &found].map(|record| {
                column(record, "root", component).iter().fold(0.0_f64, |most, own| most.max(own.abs()))
            });
            assert!(found < allowed * exact, "{modes} modes, {component}: {found}, beam {exact}");
        }
        // With modes that follow the wave, it is the beam's.
        if modes == 10 {
            let error = difference(&exact, &found, &["f1", "f2", "f3"]);
            assert!(error < 0.02, "{error}");
        }
    }
}

/// A blade hinged at its root that swings under its weight pulls at its hinge as the beam does, with any number of modes, with corrections
/// and without, and keeps its energy.
#[test]
fn a_swinging_blade_never_pushes_on_its_hinge() {
    let rest = "[joints.root]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"START\"\naxis = [0, 1, 0]\n\
         [outputs.root]\nkind = \"reaction\"\nof = \"root\"\naxes = \"base\"\n\
         [outputs.energy]\nkind = \"energy\"\n\
         [analysis]\nkind = \"dynamics\"\nend = 12\nstep = 0.01\n";
    let text = blade('x', false, false);
    let mut exact = None;
    for modes in [0, 2, 4, 6, 10, 20] {
        for corrections in [true, false] {
            let report = reduced_blade(&text, modes, corrections);
            let [beam, own] = models(&text, &report, "gravity = [0, 0, -9.81]", rest);
            let exact = exact.get_or_insert_with(|| ran(&beam, &[]));
            let found = ran(&own, &[]);
            // Few modes alone are stiffer and drift in phase: the largest force counts.
            for component in ["f1", "f2"] {
                let [exact, found] = [&*exact, &found].map(|record| {
                    column(record, "root", component).iter().fold(0.0_f64, |most, own| most.max(own.abs()))
                });
                assert!(
                    found < 1.3 * exact,
                    "{modes} modes, corrections {corrections}, {component}: {found}, beam {exact}"
                );
            }
            let energy = column(&found, "energy", "total");
            let most = column(&found, "energy", "kinetic").iter().copied().fold(0.0, f64::max);
            let drift = energy.iter().map(|own| (own - energy[0]).abs()).fold(0.0, f64::max);
            assert!(drift < 1e-3 * most, "{modes} modes, corrections {corrections}: {drift} of {most}");
        }
    }
}

/// The motion of a motor that stops from `speed` [rad/s] within half a second.
fn stopped_from(speed: f64) -> String {
    let s = "((t - 0.2)/0.5)";
    format!("{speed}*if(t < 0.2, t, if(t < 0.7, 0.2 + 0.5*({s} - {s}^3 + 0.5*{s}^4), 0.45))")
}

/// A blade that is stopped hard bends by a fifth of its length, with any number of modes. Errors of its reactions are those of second
/// order: they grow with the square of the deflection.
#[test]
fn a_hard_stop_is_that_of_the_beam_to_second_order() {
    let text = blade('x', false, false);
    for modes in [0, 2, 4, 10, 20] {
        let report = reduced_blade(&text, modes, true);
        let speeds: &[(f64, f64, f64)] =
            if modes == 10 { &[(1.25, 0.007, 0.04), (2.5, 0.025, 0.15)] } else { &[(2.5, 0.025, 0.15)] };
        for &(speed, largest, difference_allowed) in speeds {
            let rest = on_a_hub('x', &stopped_from(speed), speed, "steady_rotation = true\n", 1.5);
            let [beam, own] = models(&text, &report, "", &rest);
            let exact = ran(&beam, &[]);
            let mut session = own.session().unwrap_or_else(|error| panic!("{error}"));
            let found = session.run().unwrap();
            let codes: Vec<&str> = session.warnings().map(lissom_core::errors::Warning::code).collect();
            assert_eq!(
                codes.contains(&"beyond-linear"),
                speed > 2.0,
                "{modes} modes, {speed} rad/s: {codes:?}"
            );
            for component in ["f1", "f2", "m3"] {
                let [exact, found] = [&exact, &found].map(|record| {
                    column(record, "root", component).iter().fold(0.0_f64, |most, own| most.max(own.abs()))
                });
                let error = (found / exact - 1.0).abs();
                assert!(error < largest, "{modes} modes, {speed} rad/s, {component}: {found}, beam {exact}");
            }
            for components in [&["f1", "f2", "f3"][..], &["m1", "m2", "m3"]] {
                let error = difference(&exact, &found, components);
                assert!(error < difference_allowed, "{modes} modes, {speed} rad/s, {components:?}: {error}");
            }
        }
    }
}

/// A blade that is bent beyond the range of its second-order matrices does not go on with a kinetic energy that is not positive.
#[test]
fn a_blade_bent_beyond_its_matrices_is_rejected() {
    let text = blade('x', false, false);
    let report = reduced_blade(&text, 10, true);
    let rest = on_a_hub('x', &stopped_from(6.0), 6.0, "steady_rotation = true\n", 0.7);
    let [_, own] = models(&text, &report, "", &rest);
    let mut session = own.session().unwrap_or_else(|error| panic!("{error}"));
    let (found, ended) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    let message = ended.error().map(ToString::to_string).unwrap_or_default();
    assert!(message.contains("kinetic energy is no longer positive"), "{message}");
    assert!(message.contains("--modes-alone"), "{message}");
    let codes: Vec<&str> = session.warnings().map(lissom_core::errors::Warning::code).collect();
    assert!(codes.contains(&"beyond-linear"), "{codes:?}");
    assert!(found.times.last().is_some_and(|time| *time > 0.3 && *time < 0.5), "{:?}", found.times.last());
}

/// Free blades along every axis can be reduced: residuals of rigid motions are compared with the norm of the stiffness.
#[test]
fn free_blades_are_reduced_along_every_axis() {
    for axis in ['x', 'y', 'z'] {
        for (is_tapered, is_twisted) in [(false, false), (true, false), (true, true)] {
            let text = blade(axis, is_tapered, is_twisted);
            let report = reduced_blade(&text, 4, true);
            let mass = if is_tapered { 5586.0 } else { 10260.0 };
            assert!((report.mass - mass).abs() < 1.0, "{axis}: {}", report.mass);
        }
    }
}

/// Matrices of the earlier form, whose loads count twice, are omitted with a warning.
#[test]
fn geometric_matrices_of_the_earlier_form_are_left_out() {
    let text = blade('x', false, false);
    let mut report = reduced_blade(&text, 1, false);
    let size = report.unknowns[1];
    for (name, file) in &mut report.files {
        if name.contains("geometric") {
            let zeros = "0\n".repeat((13 * size + 6) * size);
            *file = format!("%%MatrixMarket matrix array real general\n{} {size}\n{zeros}", 13 * size + 6);
        }
    }
    let document = using(&report, MODES).document().expect("a good model");
    assert!(document.superelements[0].matrices.geometric.is_none());
    let messages: Vec<String> = document.warnings.problems().map(|problem| problem.message.clone()).collect();
    assert!(messages.iter().any(|words| words.contains("counts loads twice")), "{messages:?}");
}
