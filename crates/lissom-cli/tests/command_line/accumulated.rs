//! Outputs that depend on the whole way: work, angles that go on, and cycles of fatigue, against formulas.

use std::fs;

use lissom::analyses::gradient::gradient;
use lissom::{Model, Record, Session, SessionSnapshot};
use serde_json::Value;

use crate::support::rail::force;
use crate::support::{Folder, lissom, summary};

/// A cart on a rail with a spring, a damper and a force, beside a disc that a drive speeds up.
const MODEL: &str = r#"
lissom = 1
gravity = [0, 0, 0]

[bodies.cart]
mass = 2
inertia = [1, 1, 1]

[bodies.disc]
mass = 1
inertia = [1, 1, 3]
position = [5, 0, 0]

[joints.rail]
kind = "prismatic"
base = "ground"
tip = "cart"
axis = [1, 0, 0]

[joints.axle]
kind = "revolute"
base = "ground"
tip = "disc"
axis = [0, 0, 1]

[joints.motor]
kind = "prescribed_rotation"
joint = "axle"
rotation = "2*t^2"

[springs.spring]
kind = "axial"
joint = "rail"
stiffness = 50
force = "40*elongation^3"

[springs.damper]
kind = "axial"
joint = "rail"
damping = 3

[loads.push]
kind = "joint_force"
joint = "rail"
force = "20*sin(5*t)"

[loads.feedback]
kind = "joint_force"
joint = "rail"
force = "-4*rail.displacement"

[outputs.spring]
kind = "work"
of = "spring"
[outputs.damper]
kind = "work"
of = "damper"
[outputs.push]
kind = "work"
of = "push"
[outputs.feedback]
kind = "work"
of = "feedback"
[outputs.motor]
kind = "work"
of = "motor"
[outputs.sum]
kind = "expression"
value = "spring.work + damper.work + push.work + feedback.work"
[outputs.rail]
kind = "relative"
of = "rail"
[outputs.turned]
kind = "angle"
of = "disc"
axis = [0, 0, 1]
[outputs.behind]
kind = "angle"
of = "cart"
axis = [0, 0, -2]
relative_to = "disc"
[outputs.pull]
kind = "spring"
of = "spring"
woehler_exponent = 4
reference_cycles = 100

[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 4
step = 0.01
"#;

fn model(text: &str) -> Model {
    Model::from_text("work.toml", text)
}

fn last(record: &Record, output: &str, component: &str) -> f64 {
    *record.column(output, component).unwrap_or_else(|| panic!("{output}.{component}")).last().unwrap()
}

fn run(text: &str, set: &[(&str, &str)]) -> Record {
    let set: Vec<_> = set.iter().map(|(path, value)| ((*path).to_owned(), (*value).to_owned())).collect();
    model(text).with_overrides(&set).session().unwrap().run().unwrap().into_record()
}

/// What the works miss of the kinetic energy of the cart, over the largest work.
fn missing(set: &[(&str, &str)]) -> f64 {
    let record = run(MODEL, set);
    let speed = last(&record, "rail", "velocity");
    (last(&record, "sum", "value") - speed * speed).abs() / last(&record, "push", "work").abs()
}

/// At the instant of a jump a force has two values: the work is that of the one before it, and then that of the one after.
#[test]
fn the_work_of_a_force_that_jumps_is_the_kinetic_energy() {
    let before = MODEL.split("[springs.spring]").next().unwrap();
    for jump in ["(t > 1)", "(t >= 1)", "step(t - 1)"] {
        let text = format!(
            "{before}\n{}\
             [outputs.push]\nkind = \"work\"\nof = \"push\"\n[outputs.rail]\nkind = \"relative\"\nof = \"rail\"\n\
             [analysis]\nkind = \"dynamics\"\nscheme = \"radau-iia\"\nend = 2\nstep = 0.1\n",
            force(&format!("20*{jump} - 8"))
        );
        let record = run(&text, &[]);
        let speed = last(&record, "rail", "velocity");
        assert!((speed - 2.0).abs() < 1e-9, "{jump}: {speed}");
        let work = last(&record, "push", "work");
        assert!((work - speed * speed).abs() < 1e-9, "{jump}: {work}");
    }
}

#[test]
fn works_add_up_to_the_kinetic_energy_to_the_order_of_the_scheme() {
    for (scheme, most, ratio) in [("radau-iia", 2e-5, 6.5), ("generalized-alpha", 2e-3, 3.4)] {
        let of = |step: &str| missing(&[("analysis.scheme", scheme), ("analysis.step", step)]);
        let (coarse, fine) = (of("0.02"), of("0.01"));
        assert!(coarse > 1e-12 && fine < most && coarse / fine > ratio, "{scheme}: {coarse:.3e} {fine:.3e}");
    }
    assert!(missing(&[("analysis.relative_tolerance", "1e-7")]) < 1e-5);
    // A linear spring keeps what it takes: ½ k x², and the drive gives the disc ½ J ω².
    let linear = MODEL.replace("force = \"40*elongation^3\"\n", "");
    let record = run(&linear, &[]);
    let place = last(&record, "rail", "displacement");
    assert!((last(&record, "spring", "work") + 25.0 * place * place).abs() < 1e-5, "{place}");
    assert!((last(&record, "feedback", "work") + 2.0 * place * place).abs() < 1e-6, "{place}");
    assert!((last(&record, "motor", "work") - 0.5 * 3.0 * 16.0_f64.powi(2)).abs() < 1e-6);
    assert!(last(&record, "damper", "work") < 0.0);
}

#[test]
fn angles_go_on_beyond_half_a_turn() {
    let record = run(MODEL, &[]);
    let (turned, behind) =
        (record.column("turned", "angle").unwrap(), record.column("behind", "angle").unwrap());
    for (row, time) in record.times.iter().enumerate() {
        let exact = 2.0 * time * time;
        assert!((turned[row] - exact).abs() < 1e-9, "t = {time}: {} {exact}", turned[row]);
        assert!((behind[row] - exact).abs() < 1e-9, "t = {time}: {} {exact}", behind[row]);
    }
    // About an axis that is turned over there is no angle, which is reported.
    let tumbling = MODEL.replace("axis = [0, 0, 1]\n[outputs.behind]", "axis = [1, 0, 0]\n[outputs.behind]");
    assert_ne!(tumbling, MODEL);
    let mut session =
        model(&tumbling).with_overrides(&[("analysis.step".into(), "0.003".into())]).session().unwrap();
    let record = session.run().unwrap();
    assert!(last(&record, "turned", "angle").is_nan());
    assert!(session.warnings().any(|warning| warning.code() == "output-lost"));
}

#[test]
fn works_and_angles_go_on_from_a_snapshot_to_the_last_bit() {
    let whole = run(MODEL, &[]);
    let mut session = model(MODEL).session().unwrap();
    session.step_to(1.37).unwrap();
    let bytes = session.snapshot().to_bytes();
    let mut again: Session = model(MODEL).session().unwrap();
    again.restore(&SessionSnapshot::from_bytes(&bytes).unwrap()).unwrap();
    while !again.is_finished() {
        again.advance().unwrap();
    }
    let mut values = Vec::new();
    again.values(&mut values);
    for (column, value) in again.columns().iter().zip(values) {
        let wanted = last(&whole, &column.output, &column.component);
        assert_eq!(value.to_bits(), wanted.to_bits(), "{}", column.name());
    }
    // A snapshot of the model without them is one of another model.
    let without = MODEL.replace("[outputs.motor]\nkind = \"work\"", "[outputs.motor]\nkind = \"power\"");
    let other = model(&without).session().unwrap().snapshot();
    assert!(again.restore(&other).is_err());
}

/// W = F²t²/2m of a force that is constant: dW/dF = F t²/m.
#[test]
fn works_have_gradients() {
    let text = "lissom = 1\ngravity = [0, 0, 0]\n[bodies.cart]\nmass = 2\ninertia = [1, 1, 1]\n\
        [joints.rail]\nkind = \"prismatic\"\nbase = \"ground\"\ntip = \"cart\"\naxis = [1, 0, 0]\n\
        [loads.push]\nkind = \"joint_force\"\njoint = \"rail\"\nforce = 6\n\
        [outputs.push]\nkind = \"work\"\nof = \"push\"\n\
        [analysis]\nkind = \"dynamics\"\nscheme = \"radau-iia\"\nend = 3\nstep = 0.1\n";
    let target = "push.work".parse().unwrap();
    let found = gradient(&model(text), &target, &["loads.push.force".to_owned()], true).unwrap();
    assert!((found.value - 81.0).abs() < 1e-8, "{}", found.value);
    assert!((found.derivatives[0].value - 27.0).abs() < 1e-6, "{}", found.derivatives[0].value);
}

#[test]
fn the_work_of_load_steps_is_that_of_the_loads() {
    let text = r#"
lissom = 1
[bodies.cart]
mass = 2
inertia = [1, 1, 1]
[joints.rail]
kind = "prismatic"
base = "ground"
tip = "cart"
axis = [1, 0, 0]
[springs.spring]
kind = "axial"
joint = "rail"
stiffness = 50
[loads.push]
kind = "joint_force"
joint = "rail"
force = 20
[outputs.spring]
kind = "work"
of = "spring"
[outputs.push]
kind = "work"
of = "push"
[analysis]
kind = "statics"
steps = 4
"#;
    let record = run(text, &[]);
    // ½ F² / k
    assert!((last(&record, "push", "work") - 4.0).abs() < 1e-9);
    assert!((last(&record, "spring", "work") + 4.0).abs() < 1e-9);
}

#[test]
fn the_summary_has_the_range_of_equivalent_cycles() {
    let folder = Folder::new("fatigue");
    // ten cycles of an amplitude of 3 N on a spring of 50 N/m
    let text = MODEL.replace("force = \"40*elongation^3\"\n", "").replace(
        "[joints.motor]",
        "[joints.shaker]\nkind = \"prescribed_displacement\"\njoint = \"rail\"\ndisplacement = \
         \"0.06*sin(5*pi*t)\"\n\n[joints.motor]",
    );
    let file = folder.path().join("fatigue.toml");
    fs::write(&file, &text).unwrap();
    let ended = lissom(&["run", file.to_str().unwrap(), "--no-plots"], folder.path());
    assert_eq!(ended.code, 0, "{}", ended.errors);
    let facts = summary(&folder.path().join("out/fatigue"));
    let found = facts["statistics"]["pull.force"]["damage_equivalent"].as_f64().unwrap();
    // Nine and a half whole cycles of 6 N, and the two quarters at the ends, each half a cycle of 3 N.
    let wanted = 6.0 * ((9.5 + 2.0 * 0.5 * 0.5_f64.powi(4)) / 100.0).powf(0.25);
    assert!((found - wanted).abs() < 1e-6 * wanted, "{found} {wanted}");
    assert_eq!(facts["statistics"]["rail.displacement"]["damage_equivalent"], Value::Null);

    let sweep = folder.path().join("sweep.toml");
    let of = |column: &str| {
        let text = format!(
            "lissom_sweep = 1\nmodel = \"fatigue.toml\"\nvary.\"loads.push.force\" = [1, 2]\n\
             collect.range = \"damage_equivalent({column})\"\n"
        );
        fs::write(&sweep, text).unwrap();
        lissom(&["sweep", sweep.to_str().unwrap()], folder.path())
    };
    let ended = of("pull.force");
    assert_eq!(ended.code, 0, "{}", ended.errors);
    let ended = of("rail.displacement");
    assert!(ended.code == 2 && ended.errors.contains("woehler_exponent"), "{}", ended.errors);
}

#[test]
fn work_needs_a_motion_and_cycles_an_exponent() {
    for (from, to, wanted) in [
        ("woehler_exponent = 4\n", "", "reference_cycles"),
        ("of = \"motor\"", "of = \"axle\"", "no power to record"),
        ("\"-4*rail.displacement\"", "\"-4*push.work\"", "only sampled signals can depend on"),
        (
            "kind = \"dynamics\"\nscheme = \"radau-iia\"\nend = 4\nstep = 0.01",
            "kind = \"path\"",
            "adds up along",
        ),
    ] {
        let error = model(&MODEL.replacen(from, to, 1))
            .document()
            .and_then(|document| lissom::start::lower(&document).map(|_| ()));
        let shown = error.unwrap_err().render(false);
        let joined = shown.split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ");
        assert!(joined.contains(wanted), "{wanted}: {shown}");
    }
}
