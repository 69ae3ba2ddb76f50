//! Sessions in memory: many at once, step by step, and interrupted.

use std::ops::ControlFlow;

use lissom::{Document, Model, Record, Session, Stopped};

const SPRING: &str = r#"
lissom = 1
[point_masses.weight]
mass = 1
position = [1, 0, 0]
velocity = [0.3, 0, 0]
[springs.spring]
kind = "point"
base = "ground"
tip = "weight"
at_base = [0, 0, 0]
stiffness = 100
[outputs.weight]
kind = "position"
of = "weight"
[analysis]
scheme = "radau-iia"
kind = "dynamics"
end = 0.5
step = 0.01
"#;

fn set(path: &str, value: impl std::fmt::Display) -> (String, String) {
    (path.to_owned(), format!("{value}"))
}

#[test]
fn sessions_may_go_to_other_threads() {
    fn is_send<T: Send>() {}
    fn is_sync<T: Sync>() {}
    is_send::<Session>();
    is_send::<Document>();
    is_sync::<Document>();
    is_sync::<Model>();
}

/// A study of convergence: sessions at several step sizes in parallel threads.
#[test]
fn errors_shrink_with_the_step_as_the_scheme_promises() {
    let model = Model::from_text("spring.toml", SPRING);
    let exact = 1.0 + 0.03 * 5.0_f64.sin();
    for (scheme, order) in [("radau-iia", 3), ("generalized-alpha", 2)] {
        let error = |step: f64| {
            let overrides = [set("analysis.step", step), set("analysis.scheme", scheme)];
            let record = model.with_overrides(&overrides).session().unwrap().run().unwrap();
            assert_eq!(record.times.last(), Some(&0.5));
            (record.column("weight", "x").unwrap().last().unwrap() - exact).abs()
        };
        let [coarse, fine] = std::thread::scope(|scope| {
            let threads = [0.01, 0.005].map(|step| scope.spawn(move || error(step)));
            threads.map(|thread| thread.join().unwrap())
        });
        let ratio = coarse / fine;
        assert!((ratio.log2() - f64::from(order)).abs() < 0.3, "{scheme}: {coarse:e} {fine:e}");
    }
}

#[test]
fn a_session_goes_step_by_step() {
    let model = Model::from_text("spring.toml", SPRING);
    let mut session = model.with_overrides(&[set("analysis.end", 0.055)]).session().unwrap();
    assert_eq!(session.columns()[1].name(), "weight.y");
    let mut steps = 0;
    while !session.is_finished() {
        session.advance().unwrap();
        steps += 1;
    }
    assert_eq!(steps, 6);
    assert_eq!(session.progress().time, 0.055);
    let mut values = Vec::new();
    session.values(&mut values);
    assert!((values[0] - 1.0 - 0.03 * 0.55_f64.sin()).abs() < 1e-6, "{values:?}");
    // The clock inside agrees.
    assert!((session.simulation().state().kinematics.time - 0.055).abs() < 1e-15);
}

#[test]
fn an_interrupted_session_can_go_on() {
    let model = Model::from_text("spring.toml", SPRING);
    let whole = model.session().unwrap().run().unwrap();
    let mut session = model.session().unwrap();
    let mut first = lissom::Record::default();
    let report = session.run_with(&mut [&mut first], &mut |progress| {
        if progress.done == 20 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert!(matches!(report.stopped, Stopped::Interrupted));
    assert_eq!((report.time, first.times.len()), (0.2, 21));
    let rest = session.run().unwrap();
    assert_eq!(rest.times.len(), 31);
    assert_eq!(rest.column("weight", "x").unwrap().last(), whole.column("weight", "x").unwrap().last());
}

#[test]
fn wrong_models_are_distinguished_from_failing_ones() {
    let model = Model::from_text("spring.toml", SPRING);
    let error = model.with_overrides(&[set("analysis.step", 0)]).session().err().unwrap();
    assert!(matches!(error, lissom::SessionError::Model(_)), "{error}");
    let (record, report) = model
        .with_overrides(&[set("analysis.max_iterations", 1)])
        .session()
        .unwrap()
        .run()
        .unwrap_or_else(lissom::Results::from)
        .into_parts();
    assert!(report.error().is_some() && !report.is_complete());
    assert_eq!(record.times, [0.0]);
}

#[test]
fn telemetry_counts_every_iteration_and_stays_short() {
    for (steps, most) in [(50, 50), (5000, 512)] {
        let step = 0.5 / f64::from(steps);
        let mut session = Model::from_text("spring", SPRING)
            .with_overrides(&[set("analysis.step", step)])
            .session()
            .expect("the model is right");
        let (_, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
        let telemetry = session.telemetry();
        let samples = telemetry.samples();
        assert!(samples.len() <= most && samples.len() >= most / 2, "{}", samples.len());
        let iterations: usize = samples.iter().map(|sample| sample.iterations).sum();
        let tangents: usize = samples.iter().map(|sample| sample.factorizations).sum();
        let open = report.totals.steps - samples[samples.len() - 1].step;
        assert!(report.totals.newton_iterations - iterations <= 20 * open);
        assert!(tangents >= 1 && tangents <= report.totals.factorizations);
        assert!(samples.iter().all(|sample| sample.condition.is_some_and(|value| value >= 1.0)));
        assert!(samples.iter().all(|sample| sample.relative_pivot.is_some_and(|value| value > 0.0)));
        let (least, most) = telemetry.condition_range().expect("there is an estimate");
        assert!(least <= most);
    }
}

const HANGING: &str = r#"
lissom = 1
gravity = [9.81, 0, 0]
[initial]
equilibrium = true
[bodies.weight]
mass = 1
inertia = [1, 1, 1]
position = [1, 0, 0]
[joints.slide]
kind = "prismatic"
base = "ground"
tip = "weight"
axis = [1, 0, 0]
[springs.spring]
kind = "axial"
joint = "slide"
stiffness = 100
[outputs.slide]
kind = "relative"
of = "slide"
[analysis]
kind = "dynamics"
end = 0.5
step = 0.01
"#;

/// A weight on a spring, at rest where the spring bears it, stays there.
#[test]
fn a_start_from_equilibrium_stays_at_rest() {
    let document = Model::from_text("hanging.toml", HANGING).document().unwrap();
    let (record, report) =
        Session::new(&document).unwrap().run().unwrap_or_else(lissom::Results::from).into_parts();
    assert!(report.error().is_none());
    let place = record.column("slide", "displacement").unwrap();
    assert!(place.iter().all(|x| (x - 0.0981).abs() < 1e-12), "{place:?}");
    // What nothing holds has no equilibrium.
    let free = set("springs.spring.stiffness", 0.0);
    let document = Model::from_text("hanging.toml", HANGING).with_overrides(&[free]).document().unwrap();
    assert!(Session::new(&document).is_err());
}

/// A weight is driven along its slide; the drive bears its weight and accelerates it.
#[test]
fn a_displacement_is_prescribed() {
    let driven = HANGING.replace(
        "[springs.spring]\nkind = \"axial\"\njoint = \"slide\"\nstiffness = 100\n",
        "[joints.drive]\nkind = \"prescribed_displacement\"\njoint = \"slide\"\ndisplacement = \"0.5*t^2\"\n\
         [outputs.drive]\nkind = \"reaction\"\nof = \"drive\"\n",
    );
    let document = Model::from_text("driven.toml", &driven).document().unwrap();
    let (record, report) =
        Session::new(&document).unwrap().run().unwrap_or_else(lissom::Results::from).into_parts();
    assert!(report.error().is_none());
    let last = record.times.len() - 1;
    assert!((record.column("slide", "displacement").unwrap()[last] - 0.125).abs() < 1e-12);
    assert!((record.column("slide", "velocity").unwrap()[last] - 0.5).abs() < 1e-6);
    let force = record.column("drive", "force").unwrap()[last];
    assert!((force - (1.0 - 9.81)).abs() < 1e-6, "{force}");
    // A rotation cannot be prescribed here.
    let wrong = driven
        .replace("prescribed_displacement", "prescribed_rotation")
        .replace("displacement =", "rotation =");
    let document = Model::from_text("wrong.toml", &wrong).document().unwrap();
    assert!(Session::new(&document).is_err());
}

/// A tip load is put on at once: for the first steps the clamp bears nothing but round-off, which must not keep
/// Newton's iterations from ending.
#[test]
fn reactions_that_are_round_off_do_not_keep_a_step_from_converging() {
    let model = r#"
lissom = 1
[sections.box]
shape = "general"
stiffness = [1368170.0, 88560.0, 38780.0, 16960.0, 59120.0, 141470.0]
mass = [8.538e-2, 8.538e-2, 8.538e-2, 1.4433e-2, 0.4097e-2, 1.0336e-2]
[beams.beam]
section = "box"
from = [0, 0, 0]
to = [10, 0, 0]
elements = 16
[joints.root]
kind = "clamp"
base = "ground"
tip = "beam.start"
[loads.tip]
kind = "force"
on = "beam.end"
vector = [0, 0, 150.0]
[outputs.root]
kind = "reaction"
of = "root"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 1e-3
step = 2.5e-4
"#;
    let document = Model::from_text("sudden.toml", model).document().unwrap();
    let (_, report) =
        Session::new(&document).unwrap().run().unwrap_or_else(lissom::Results::from).into_parts();
    assert!(report.error().is_none(), "{:?}", report.error());
    assert!(report.totals.newton_iterations < 24, "{}", report.totals.newton_iterations);
}

const THROWN: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]
[point_masses.bob]
mass = 1
position = [1, 0, 0]
[joints.string]
kind = "distance"
base = "ground"
tip = "bob"
at_base = [0, 0, 0]
[outputs.bob]
kind = "position"
of = "bob"
[analysis]
kind = "dynamics"
end = 1
"#;

#[test]
fn a_model_that_names_no_step_chooses_its_own() {
    let model = Model::from_text("thrown.toml", THROWN);
    let mut session = model.session().unwrap();
    let (free, report) = session.run().unwrap().into_parts();
    assert_eq!(session.simulation().settings().scheme.name, "radau-iia-9");
    assert!(free.times.len() > 5 * report.totals.steps, "every step is sampled");
    let sizes: Vec<f64> = free.times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    assert!(sizes.iter().copied().fold(0.0, f64::max) > 3.0 * sizes[0], "{sizes:?}");
    assert_eq!(*free.times.last().unwrap(), 1.0);

    let at = |path: &str, value: &str| (path.to_owned(), value.to_owned());
    let mut fixed = model.with_overrides(&[at("analysis.step", "1e-4")]).session().unwrap();
    let fixed = fixed.run().unwrap();
    let end = |record: &Record| *record.column("bob", "z").unwrap().last().unwrap();
    assert!((end(&free) - end(&fixed)).abs() < 1e-4, "{} {}", end(&free), end(&fixed));

    let every = [at("analysis.relative_tolerance", "1e-6"), at("analysis.output_step", "0.25")];
    let even = model.with_overrides(&every).session().unwrap().run().unwrap();
    assert_eq!(even.times, [0.0, 0.25, 0.5, 0.75, 1.0]);
    assert!((end(&even) - end(&fixed)).abs() < 1e-5, "{} {}", end(&even), end(&fixed));
    let wrong = [at("analysis.step", "1e-3"), at("analysis.output_step", "0.25")];
    let reported = model.with_overrides(&wrong).document().unwrap_err().render(false);
    assert!(reported.contains("relative_tolerance"), "{reported}");
}

#[test]
fn a_session_is_driven_to_any_time() {
    let step = [("analysis.step".to_owned(), "0.01".to_owned())];
    let control = [("analysis.relative_tolerance".to_owned(), "1e-6".to_owned())];
    for overrides in [&step, &control] {
        let mut session =
            Model::from_text("thrown.toml", THROWN).with_overrides(overrides).session().unwrap();
        for time in [0.013, 0.013, 0.5, 0.77] {
            session.step_to(time).unwrap();
            assert!((session.progress().time - time).abs() < 1e-14, "{overrides:?} {time}");
        }
        session.step_to(0.1).unwrap();
        assert!((session.progress().time - 0.77).abs() < 1e-14, "time does not go back");
        let record = session.run().unwrap();
        assert!((record.times[0] - 0.77).abs() < 1e-14 && *record.times.last().unwrap() == 1.0);
    }
}

#[test]
fn a_very_short_step_disturbs_nothing() {
    for scheme in ["\"generalized-alpha\"", "\"hht\"", "\"radau-iia\""] {
        let overrides = [set("analysis.step", 1e-3), set("analysis.scheme", scheme)];
        let end = |stops: &[f64]| {
            let mut session =
                Model::from_text("thrown.toml", THROWN).with_overrides(&overrides).session().unwrap();
            for &time in stops {
                session.step_to(time).unwrap();
            }
            let mut values = Vec::new();
            session.values(&mut values);
            values
        };
        let (plain, disturbed) = (end(&[0.9]), end(&[0.3, 0.3 + 1e-9, 0.9]));
        let distance = plain.iter().zip(&disturbed).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // Below the error of the schemes of second order with such steps.
        assert!(distance < 1e-5, "{scheme}: {distance:e}");
    }
}
