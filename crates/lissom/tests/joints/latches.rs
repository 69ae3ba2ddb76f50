//! Latches and releases against formulas: what is taken at the instant of latching, and what goes on afterwards.

use lissom::Model;

use crate::support::on_one_line::refused_on_one_line;
use crate::support::refused::refused;
use crate::support::runs::{column, run, session};

/// Two discs on one axis, the second hinged to the first; events latch and release the hinge between them.
const DISCS: &str = r#"
lissom = 1
gravity = [0, 0, 0]

[inputs]
latched = 0

[bodies.first]
mass = 1
inertia = [1, 1, 3]

[bodies.second]
mass = 1
inertia = [1, 1, 2]

[joints.axle]
kind = "revolute"
base = "ground"
tip = "first"
axis = [0, 0, 1]

[joints.hinge]
kind = "revolute"
base = "first"
tip = "second"
axis = [0, 0, 1]

[springs.latch]
kind = "torsional_latch"
joint = "hinge"
engaged = "latched"

[events.snap]
zero_of = "hinge.rotation - 0.5"
direction = "rising"
set = { latched = 1 }

[events.release]
zero_of = "t - 1.2"
set = { latched = 0 }

[loads.motor]
kind = "joint_torque"
joint = "axle"
torque = "step(t - 0.6)*4"

[initial.second]
parts = ["second"]
angular_velocity = [0, 0, 1]

[outputs.axle]
kind = "relative"
of = "axle"
[outputs.hinge]
kind = "relative"
of = "hinge"
[outputs.latch]
kind = "spring"
of = "latch"
[outputs.momentum]
kind = "momentum"

[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 2
step = 1e-2
"#;

/// Latched at 0.5 s with ω = J₂/(J₁ + J₂), driven from 0.6 s on with 4/(J₁ + J₂), released at 1.2 s.
#[test]
fn discs_go_on_together_with_their_momentum_and_part_again() {
    let schemes = ["radau-iia", "radau-iia-5", "generalized-alpha", "hht", "energy-decaying"];
    let controlled = ("analysis.relative_tolerance", "1e-6");
    let runs = schemes.map(|scheme| vec![("analysis.scheme", scheme)]);
    for set in runs.into_iter().chain([vec![controlled], vec![controlled, ("analysis.scheme", "hht")]]) {
        let mut session = session(DISCS, &set);
        let (record, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
        assert!(report.is_complete(), "{set:?}");
        let (axle, hinge) = (column(&record, "axle", "rate"), column(&record, "hinge", "rate"));
        let (angle, torque) = (column(&record, "hinge", "angle"), column(&record, "latch", "moment"));
        for (row, &time) in record.times.iter().enumerate() {
            let driven = (time.clamp(0.6, 1.2) - 0.6) * 4.0 / 5.0 + (time - 1.2).max(0.0) * 4.0 / 3.0;
            let wanted = if time < 0.5 + 1e-6 { [0.0, 1.0] } else { [0.4 + driven, 0.0] };
            // At the instants themselves either side may be recorded, and forces that switch err there with steps of one size.
            if [0.5, 0.6, 1.2].iter().any(|instant: &f64| (time - instant).abs() < 0.011) {
                continue;
            }
            let freed = if time > 1.2 { -(time - 1.2) * 4.0 / 3.0 } else { 0.0 };
            // Where the torque jumps, schemes of one stage err in proportion to the step.
            let allowed = match set.len() {
                _ if !set.contains(&controlled) => 0.02,
                1 => 1e-4,
                _ => 1e-3,
            };
            assert!((axle[row] - wanted[0]).abs() < allowed, "{set:?} t = {time}: {}", axle[row]);
            assert!((hinge[row] - wanted[1] - freed).abs() < allowed, "{set:?} t = {time}: {}", hinge[row]);
            if (0.511..1.19).contains(&time) {
                assert!((angle[row] - 0.5).abs() < 1e-6, "{set:?} t = {time}: {}", angle[row]);
                // The latch speeds up the second disc alone.
                let pull = if time > 0.6 { 2.0 * 4.0 / 5.0 } else { 0.0 };
                assert!((torque[row] + pull).abs() < 1e-3, "{set:?} t = {time}: {} {pull}", torque[row]);
            } else {
                // Nothing but what Newton's iteration leaves of the largest torque, 1.6 N m.
                assert!(torque[row].abs() < 1e-6, "{set:?} t = {time}: {}", torque[row]);
            }
            if time < 0.59 {
                // The momentum is what it was, before and after.
                let momentum = column(&record, "momentum", "l3")[row];
                assert!((momentum - 2.0).abs() < 1e-9, "{set:?} t = {time}: {momentum}");
            }
        }
        // ½ J₁ J₂/(J₁ + J₂) Δω²
        let lost = session.simulation().energy_balance().latches;
        assert!((lost - 0.6).abs() < 1e-9, "{set:?}: {lost}");
        assert_eq!(session.events().count(), 2);
    }
}

#[test]
fn a_body_held_on_a_slope_slides_from_its_release_on() {
    let text = r#"
lissom = 1
gravity = [0, 0, -10]
inputs.held = 1
[bodies.sledge]
mass = 3
inertia = [1, 1, 1]
[joints.slope]
kind = "prismatic"
base = "ground"
tip = "sledge"
axis = [0.8, 0, -0.6]
[springs.hook]
kind = "axial_latch"
joint = "slope"
engaged = "held"
[events.release]
zero_of = "t - 0.73"
set = { held = 0 }
[outputs.slope]
kind = "relative"
of = "slope"
[outputs.hook]
kind = "spring"
of = "hook"
[outputs.power]
kind = "power"
of = "hook"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 2
step = 0.05
"#;
    let record = Model::from_text("slope.toml", text).session().unwrap().run().unwrap();
    let (places, force) = (column(&record, "slope", "displacement"), column(&record, "hook", "force"));
    for (row, &time) in record.times.iter().enumerate() {
        let slid = 0.5 * 6.0 * (time - 0.73).max(0.0).powi(2);
        assert!((places[row] - slid).abs() < 1e-9, "t = {time}: {}", places[row]);
        let held = if time < 0.73 { 18.0 } else { 0.0 };
        assert!((force[row] - held).abs() < 1e-6, "t = {time}: {}", force[row]);
        assert!(column(&record, "power", "power")[row].abs() < 1e-6);
    }
}

/// The short form does what the long form does; what is released lets go where its expression rises.
#[test]
fn the_short_form_is_the_long_form() {
    let set = [("analysis.relative_tolerance", "1e-7")];
    let long = run(DISCS, &set);
    let cut = |text: &str, from: &str, to: &str| {
        let (begin, end) = (text.find(from).unwrap(), text.find(to).unwrap());
        format!("{}{}", &text[..begin], &text[end..])
    };
    let text = cut(
        &cut(&cut(DISCS, "[inputs]", "[bodies.first]"), "[springs.latch]", "[loads.motor]"),
        "[outputs.latch]",
        "[outputs.momentum]",
    );
    let hinge = "tip = \"second\"\naxis = [0, 0, 1]\n";
    let short = text.replace(hinge, &format!("{hinge}latch = {{ at = 0.5 }}\nrelease = \"t - 1.2\"\n"));
    let mut session = session(&short, &set);
    let (record, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    assert!(report.is_complete());
    for (output, component) in [("axle", "rate"), ("hinge", "angle"), ("hinge", "rate"), ("momentum", "l3")] {
        let ends = [&record, &long].map(|record| *column(record, output, component).last().unwrap());
        assert!((ends[0] - ends[1]).abs() < 1e-4, "{output}.{component}: {ends:?}");
    }
    assert_eq!(
        session.events().map(|(name, _)| name).take(2).collect::<Vec<_>>(),
        ["hinge, latch", "hinge, release"]
    );
    let held = short.replace("latch = { at = 0.5 }\n", "").replace("t - 1.2", "0.7 - 0.5*t");
    let record = Model::from_text("held.toml", &held).session().unwrap().run().unwrap();
    assert!(
        column(&record, "hinge", "angle").iter().all(|angle| angle.abs() < 1e-9),
        "0.7 - 0.5 t falls: it never lets go"
    );
    let wrong =
        short.replace("kind = \"revolute\"\nbase = \"first\"", "kind = \"spherical\"\nbase = \"first\"");
    let wrong = wrong
        .replace(hinge, &hinge.replace("axis = [0, 0, 1]\n", ""))
        .replace("axis = [0, 0, 1]\nlatch", "latch");
    let found = refused(&wrong);
    assert!(found.contains("no relative coordinate"), "{found}");
}

/// A latch that is engaged from outside before the first step holds from the start on.
#[test]
fn a_latch_engaged_before_the_first_step_holds() {
    let text = DISCS.replace(
        "[events.snap]\nzero_of = \"hinge.rotation - 0.5\"\ndirection = \"rising\"\nset = { latched = 1 }\n",
        "",
    );
    assert!(!text.contains("snap"));
    for scheme in ["radau-iia", "radau-iia-5", "generalized-alpha", "hht", "energy-decaying"] {
        let mut session = session(&text, &[("analysis.scheme", scheme)]);
        session.set_input("latched", 1.0).unwrap();
        session.step_to(0.5).unwrap();
        // J₂ ω/(J₁ + J₂), at once.
        let rates = ["axle.rate", "hinge.rate"].map(|name| session.value(name).unwrap());
        assert!((rates[0] - 0.4).abs() < 1e-9 && rates[1].abs() < 1e-9, "{scheme}: {rates:?}");
        assert!(session.value("hinge.angle").unwrap().abs() < 1e-9, "{scheme}");
        assert!((session.simulation().energy_balance().latches - 0.6).abs() < 1e-9, "{scheme}");
    }
}

/// A pendulum that a latch at the lowest point stops, hung from a cart that is free: the cart takes the momentum over.
#[test]
fn what_a_latch_stops_gives_its_momentum_to_what_carries_it() {
    let text = r#"
lissom = 1
gravity = [0, 0, -10]
inputs.latched = 0
[bodies.cart]
mass = 4
inertia = [1, 1, 1]
[bodies.bob]
mass = 1
inertia = [0.02, 0.02, 0.02]
position = [0.5, 0, 0]
[joints.rail]
kind = "prismatic"
base = "ground"
tip = "cart"
axis = [1, 0, 0]
[joints.hinge]
kind = "revolute"
base = "cart"
tip = "bob"
at = [0, 0, 0]
axis = [0, 1, 0]
[springs.latch]
kind = "torsional_latch"
joint = "hinge"
engaged = "latched"
[events.snap]
zero_of = "hinge.rotation - pi/2"
set = { latched = 1 }
[outputs.rail]
kind = "relative"
of = "rail"
[outputs.hinge]
kind = "relative"
of = "hinge"
[outputs.momentum]
kind = "momentum"
[outputs.energy]
kind = "energy"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 1.5
step = 2e-3
"#;
    let mut session = Model::from_text("cart.toml", text).session().unwrap();
    let record = session.run().unwrap();
    // Nothing pushes along the rail: at rest together after the latch, as at the start.
    let speed = column(&record, "rail", "velocity").last().unwrap();
    let momentum = column(&record, "momentum", "p1").last().unwrap();
    assert!(speed.abs() < 1e-6 && momentum.abs() < 1e-6, "{speed} {momentum}");
    let hinge = column(&record, "hinge", "angle").last().unwrap();
    assert!((hinge - 0.5 * std::f64::consts::PI).abs() < 1e-8, "{hinge}");
    // All of the energy of the fall is lost: m g r.
    assert!((session.simulation().energy_balance().latches - 5.0).abs() < 1e-6);
    assert!(session.warnings().next().is_none());
}

#[test]
fn latches_go_on_from_a_snapshot_and_are_refused_where_they_cannot_be() {
    let model = Model::from_text("discs.toml", DISCS);
    let whole = model.session().unwrap().run().unwrap();
    let mut session = model.session().unwrap();
    session.step_to(0.83).unwrap();
    let bytes = session.snapshot().to_bytes();
    let mut again = model.session().unwrap();
    again.restore(&lissom::SessionSnapshot::from_bytes(&bytes).unwrap()).unwrap();
    while !again.is_finished() {
        again.advance().unwrap();
    }
    let rate = again.value("hinge.rate").unwrap();
    assert_eq!(rate.to_bits(), column(&whole, "hinge", "rate").last().unwrap().to_bits());
    for (from, to, wanted) in [
        ("engaged = \"latched\"", "engaged = \"locked\"", "names input `locked`, which does not exist"),
        ("engaged = \"latched\"\n", "", "lacks `engaged`"),
        ("\"torsional_latch\"", "\"axial_latch\"", "has no relative displacement"),
    ] {
        let found = refused_on_one_line(&DISCS.replacen(from, to, 1));
        assert!(found.contains(wanted), "{wanted}: {found}");
    }
    // First-order equations know no constraints between velocities.
    let request = lissom::analyses::linearize::LinearizeRequest {
        about: lissom::analyses::modes::OperatingPoint::Time(0.0),
        inputs: vec!["motor".to_owned()],
        outputs: vec!["axle".to_owned()],
    };
    let model = Model::from_text("discs.toml", DISCS);
    let error = lissom::analyses::linearize::linearize(&model, &request).map(|_| ()).unwrap_err();
    assert!(error.to_string().contains("a constraint between velocities"), "{error}");
}
