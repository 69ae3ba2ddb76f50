//! Linear models with constraints between velocities, against closed forms: wheels that roll, at rest and in steady motion,
//! and latches.

use std::f64::consts::TAU;

use lissom::Model;
use lissom::analyses::linearize::{LinearizeRequest, linearize};
use lissom::analyses::modes::{ModeReport, ModeRequest, OperatingPoint, modes};
use lissom::analyses::response::{ResponseRequest, response};
use lissom_core::linearized::{Completeness, ModeKind};

use crate::support::paths::near;

const GRAVITY: f64 = 9.81;

fn find(text: &str, count: usize) -> ModeReport {
    let request =
        ModeRequest { count: Some(count), about: Some(OperatingPoint::Time(0.0)), ..ModeRequest::default() };
    modes(&Model::from_text("model.toml", text), &request).unwrap_or_else(|error| panic!("{error}"))
}

/// A ball on a plane, held by springs along x and y at its centre.
fn ball(rest: &str) -> String {
    format!(
        r#"
lissom = 1
gravity = [0, 0, -{GRAVITY}]

[bodies.ball]
mass = 2
inertia = [0.02, 0.02, 0.02]
position = [0, 0, 0.1]

[joints.floor]
kind = "rolling"
base = "ground"
tip = "ball"
at = [0, 0, 0]
axis = [0, 0, 1]
wheel_axis = [0, 1, 0]
radius = 0
rim = 0.1
{rest}

[springs.centre]
kind = "bushing"
base = "ground"
tip = "ball"
stiffness = [300, 500, 0, 0, 0, 0]

[outputs.floor]
kind = "reaction"
of = "floor"

[outputs.ball]
kind = "position"
of = "ball"

[analysis]
kind = "dynamics"
end = 1
step = 1e-2
"#
    )
}

/// ω² = k/(m + J/r²), and spin about the vertical, which nothing holds.
#[test]
fn a_ball_on_springs_rolls_to_and_fro() {
    let report = find(&ball(""), 5);
    assert_eq!(report.completeness, Completeness::Counted);
    let found: Vec<f64> = report.modes.iter().map(|mode| mode.frequency).collect();
    assert_eq!(found.len(), 3, "{found:?}");
    assert_eq!(report.modes[0].kind, ModeKind::Rigid);
    for (frequency, stiffness) in found[1..].iter().zip([300.0_f64, 500.0]) {
        near(*frequency, (stiffness / 4.0).sqrt() / TAU, 1e-12);
    }
}

/// A push f at the centre: x = f/(k - ω² (m + J/r²)), and the plane holds the ball by J/r² ω² x against its rolling.
#[test]
fn a_ball_on_springs_responds_as_a_heavier_mass() {
    let push = "\n[loads.push]\nkind = \"force\"\non = \"ball\"\nvector = [3, 0, 0]\nscale = \"0*t\"";
    let request = ResponseRequest {
        about: OperatingPoint::Time(0.0),
        inputs: vec!["push".to_owned()],
        outputs: vec!["ball.x".to_owned(), "floor.f1".to_owned()],
        from: 0.1,
        to: 1.2,
        points: 20,
    };
    let report = response(&Model::from_text("model.toml", &ball(push)), &request)
        .unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(report.transfers.len(), 2);
    for (k, frequency) in report.frequencies.iter().enumerate() {
        let square = (TAU * frequency).powi(2);
        let wanted = 3.0 / (300.0 - 4.0 * square);
        let [position, force] = [0, 1].map(|transfer: usize| report.transfers[transfer].amplitudes[k]);
        assert!(
            (position.re - wanted).abs() < 1e-9 * wanted.abs() && position.im.abs() < 1e-9 * wanted.abs()
        );
        near(force.norm(), 2.0 * square * wanted.abs(), 1e-8);
    }
}

/// With dampers modes are sought without counting: the real part is d/(2 (m + J/r²)).
#[test]
fn a_damped_ball_rolls_to_and_fro() {
    let damped = ball("").replace("stiffness =", "damping = [0.8, 0, 0, 0, 0, 0]\nstiffness =");
    let report = find(&damped, 3);
    let first = report.modes.iter().find(|mode| mode.kind == ModeKind::Oscillation).expect("there");
    near(first.eigenvalue.re, -0.1, 1e-8);
    near(first.eigenvalue.norm(), 75.0_f64.sqrt(), 1e-8);
}

/// A disc that rolls straight on at the rate `spin`.
fn disc(spin: f64) -> String {
    format!(
        r#"
lissom = 1
gravity = [0, 0, -{GRAVITY}]

[bodies.disc]
mass = 1.7
inertia = ["1.7*0.2^2/4", "1.7*0.2^2/2", "1.7*0.2^2/4"]
position = [0, 0, 0.2]
velocity = [{}, 0, 0]
angular_velocity = [0, {spin}, 0]

[joints.floor]
kind = "rolling"
base = "ground"
tip = "disc"
at = [0, 0, 0]
axis = [0, 0, 1]
wheel_axis = [0, 1, 0]
radius = 0.2

[analysis]
kind = "dynamics"
end = 1
step = 1e-3
"#,
        0.2 * spin
    )
}

/// A disc that rolls straight on at the rate Ω: for lean and heading ω² = 12/5 Ω² - 4/5 g/r. Below Ω² = g/(3 r) it falls.
#[test]
fn a_rolling_disc_falls_below_its_critical_speed() {
    for spin in [8.0, 4.5, 3.0] {
        let square: f64 = 2.4 * spin * spin - 0.8 * GRAVITY / 0.2;
        let report = find(&disc(spin), 6);
        let sought = |mode: &&lissom_core::linearized::Mode| {
            (mode.eigenvalue.powi(2).re + square).abs() < 1e-5 * square.abs()
        };
        let found = report.modes.iter().find(sought);
        let all: Vec<_> = report.modes.iter().map(|mode| mode.eigenvalue).collect();
        assert!(found.is_some(), "{spin} rad/s: {square} 1/s² is not among {all:?}");
        let falls = report.modes.iter().any(|mode| mode.eigenvalue.re > 1e-3);
        assert_eq!(falls, square < 0.0, "{spin} rad/s: {all:?}");
        let others = all.iter().filter(|value| value.norm() > 1e-3).count();
        assert!(others <= 2, "{spin} rad/s: {all:?}");
    }
}

/// A coin that rolls in a circle, by Euler's equations in axes that do not spin with it: lean θ, rates (α, Ω, ω) along the tangent, in
/// the disc upwards, along its axis.
#[test]
fn a_coin_in_a_circle_has_the_frequency_of_eulers_equations() {
    let text =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/rolling-disc.toml"));
    let (radius, lean, precession) = (0.2_f64, 1.1_f64, 3.0_f64);
    let (sine, cosine) = lean.sin_cos();
    let turning = precession * sine;
    let spin = (radius * precession * turning * cosine - 4.0 * GRAVITY * cosine) / (6.0 * radius * turning);
    // Moments of inertia per mass: about a diameter, about the axis, and of the centre about the contact.
    let [a, c, r] = [0.25, 0.5, 1.0].map(|share| share * radius * radius);
    let slope_of_turning = c / a * spin - turning * cosine / sine;
    let slope_of_spin = r * turning / (c + r);
    let square = ((c + r) * (slope_of_turning * spin + turning * slope_of_spin)
        - 2.0 * a * turning * cosine / sine * slope_of_turning
        + a * (turning / sine).powi(2)
        - radius * GRAVITY * sine)
        / (a + r);
    let report = find(&text.expect("there"), 6);
    let found = report.modes.iter().find(|mode| (mode.frequency * TAU / square.sqrt() - 1.0).abs() < 1e-9);
    let all: Vec<_> = report.modes.iter().map(|mode| mode.eigenvalue).collect();
    assert!(found.is_some(), "{} rad/s is not among {all:?}", square.sqrt());
    assert!(
        !report.warnings.iter().any(|warning| warning.code() == "frozen-coefficients"),
        "{:?}",
        report.warnings
    );
}

/// A wheel that is no body of revolution has no steady motion: its modes are rejected, and no wrong ones are given.
#[test]
fn modes_of_an_uneven_wheel_are_refused() {
    let text = disc(8.0).replace("\"1.7*0.2^2/4\", \"1.7*0.2^2/2\", \"1.7*0.2^2/4\"", "0.012, 0.03, 0.025");
    let request =
        ModeRequest { count: Some(6), about: Some(OperatingPoint::Time(0.0)), ..ModeRequest::default() };
    match modes(&Model::from_text("model.toml", &text), &request) {
        Err(error) => assert!(error.to_string().contains("change"), "{error}"),
        Ok(report) => {
            assert!(report.modes.iter().all(|mode| mode.kind == ModeKind::Rigid), "{:?}", report.modes);
        }
    }
}

/// Two bars on one axle with a spring on the first: together while the latch holds, each by itself while it is open.
#[test]
fn a_latch_that_holds_makes_one_body_of_two() {
    let bars = |engaged: u8| {
        format!(
            r#"
lissom = 1
gravity = [0, 0, 0]

[inputs]
held = {engaged}

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

[springs.axle]
kind = "torsional"
joint = "axle"
stiffness = 40

[springs.hinge]
kind = "torsional"
joint = "hinge"
stiffness = 30

[springs.latch]
kind = "torsional_latch"
joint = "hinge"
engaged = "held"

[analysis]
kind = "dynamics"
end = 1
step = 1e-2
"#
        )
    };
    let held = find(&bars(1), 3);
    assert_eq!(held.completeness, Completeness::Counted);
    assert_eq!(held.modes.len(), 1);
    near(held.modes[0].frequency, 8.0_f64.sqrt() / TAU, 1e-12);

    let open = find(&bars(0), 3);
    assert_eq!(open.completeness, Completeness::Counted);
    // det(K - λ M) with K = [70, -30; -30, 30], M = diag(3, 2).
    let (b, c): (f64, f64) = (70.0 / 3.0 + 30.0 / 2.0, (70.0 * 30.0 - 900.0) / 6.0);
    let root = (0.25 * b * b - c).sqrt();
    assert_eq!(open.modes.len(), 2);
    for (mode, square) in open.modes.iter().zip([0.5 * b - root, 0.5 * b + root]) {
        near(mode.frequency, square.sqrt() / TAU, 1e-12);
    }
}

/// An equilibrium path has no velocities, and says so.
#[test]
fn paths_reject_constraints_between_velocities() {
    let path = ball("").replace("kind = \"dynamics\"\nend = 1\nstep = 1e-2", "kind = \"path\"");
    let error = lissom::analyses::path::PathSession::new(&Model::from_text("model.toml", &path));
    let words = error.err().map(|error| error.to_string()).unwrap_or_default();
    assert!(words.contains("equilibrium path has no velocities") && words.contains("floor"), "{words}");
}

/// First-order equations at rest contain the force of a latch, which opposes the push while it is engaged and is zero while it is released.
#[test]
fn first_order_equations_contain_the_force_of_a_latch() {
    for (held, states, force) in [(1, 0, 3.0), (0, 2, 0.0)] {
        let text = format!(
            "lissom = 1\ninputs.held = {held}\n\
             [bodies.sledge]\nmass = 3\ninertia = [1, 1, 1]\n\
             [joints.slope]\nkind = \"prismatic\"\nbase = \"ground\"\ntip = \"sledge\"\naxis = [1, 0, 0]\n\
             [springs.spring]\nkind = \"axial\"\njoint = \"slope\"\nstiffness = 100\n\
             [springs.hook]\nkind = \"axial_latch\"\njoint = \"slope\"\nengaged = \"held\"\n\
             [loads.push]\nkind = \"force\"\non = \"sledge\"\nvector = [3, 0, 0]\nscale = \"0*t\"\n\
             [outputs.hook]\nkind = \"spring\"\nof = \"hook\"\n\
             [analysis]\nkind = \"dynamics\"\nend = 1\nstep = 1e-2\n"
        );
        let request = LinearizeRequest {
            about: OperatingPoint::Time(0.0),
            inputs: vec!["push".to_owned()],
            outputs: vec!["hook.force".to_owned()],
        };
        let report = linearize(&Model::from_text("model.toml", &text), &request)
            .unwrap_or_else(|error| panic!("{error}"));
        let equations = report.state_space.unwrap_or_else(|error| panic!("{held}: {error}"));
        assert_eq!(equations.a.nrows(), states, "{held}");
        assert!((equations.d[(0, 0)] - force).abs() < 1e-9, "{held}: {}", equations.d);
    }
}
