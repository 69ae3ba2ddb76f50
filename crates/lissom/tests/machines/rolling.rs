//! Wheels, discs and balls that roll, against closed forms.

use crate::support::refused::refused;
use crate::support::runs::{SCHEMES, column, goes_on_from_a_snapshot, last, run};

/// Lagrange's steady precession of a thin disc: its axis leans by α from the vertical and turns about it at Ω, and it spins
/// by n about its axis, with 6 r Ω n sin α - r Ω² sin α cos α + 4 g cos α = 0. Its centre runs around a circle of radius
/// r |n|/Ω at r |n|.
struct Precession {
    radius: f64,
    lean: f64,
    rate: f64,
    spin: f64,
}

const GRAVITY: f64 = 9.81;

impl Precession {
    fn new(radius: f64, lean: f64, rate: f64) -> Self {
        let (sine, cosine) = lean.sin_cos();
        let spin =
            (radius * rate * rate * sine * cosine - 4.0 * GRAVITY * cosine) / (6.0 * radius * rate * sine);
        Self { radius, lean, rate, spin }
    }

    /// Axis 3 along the disc's axis, axis 1 horizontal, axis 2 up the disc.
    fn model(&self, analysis: &str) -> String {
        let Self { radius, lean, rate, spin } = *self;
        let (sine, cosine) = lean.sin_cos();
        // v = ω × r e₂ = -r n e₁, with e₁ = y so that e₂ = (-cos α, 0, sin α) and e₃ = (sin α, 0, cos α).
        format!(
            "
lissom = 1
gravity = [0, 0, -{GRAVITY}]
[bodies.disc]
mass = 1.7
inertia = [{a}, {a}, {c}]
position = [0.4, -0.2, {height}]
axes = [[0, 1, 0], [{up_x}, 0, {sine}]]
velocity = [0, {speed}, 0]
angular_velocity = [0, {tilting}, {spin}]
[joints.floor]
kind = \"rolling\"
base = \"ground\"
tip = \"disc\"
at = [3, 2, 0]
axis = [0, 0, 1]
wheel_axis = [{sine}, 0, {cosine}]
radius = {radius}
[outputs.place]
kind = \"position\"
of = \"disc\"
[outputs.turn]
kind = \"quaternion\"
of = \"disc\"
[outputs.velocity]
kind = \"velocity\"
of = \"disc\"
[outputs.floor]
kind = \"reaction\"
of = \"floor\"
[outputs.energy]
kind = \"energy\"
[analysis]
kind = \"dynamics\"
end = 2.0
{analysis}
",
            a = 0.25 * 1.7 * radius * radius,
            c = 0.5 * 1.7 * radius * radius,
            height = radius * sine,
            up_x = -cosine,
            speed = -radius * spin,
            tilting = rate * sine,
        )
    }

    /// Position of the centre after a time.
    fn place(&self, time: f64) -> [f64; 3] {
        // v = -r n e₁ with e₁ turning at Ω from y on.
        let speed = -self.radius * self.spin;
        let angle = self.rate * time;
        let circle = speed / self.rate;
        [0.4 - circle * (1.0 - angle.cos()), -0.2 + circle * angle.sin(), self.radius * self.lean.sin()]
    }

    fn error(&self, model: &str, scheme: &str, step: &str) -> f64 {
        let overrides = [("analysis.scheme", scheme), ("analysis.step", step)];
        let record = run(model, &overrides);
        let wanted = self.place(2.0);
        let found = ["x", "y", "z"].map(|axis| last(&record, "place", axis));
        found.iter().zip(wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }
}

#[test]
fn a_disc_precesses_as_lagrange_found() {
    let motion = Precession::new(0.2, 1.1, 3.0);
    let model = motion.model("step = 1e-3");
    for (scheme, bound, order) in [
        ("radau-iia", 5e-7, 2.9),
        ("generalized-alpha", 3e-5, 1.9),
        ("hht", 3e-5, 1.9),
        ("energy-decaying", 1e-5, 1.9),
    ] {
        let errors = ["2e-3", "1e-3"].map(|step| motion.error(&model, scheme, step));
        println!("{scheme}: {errors:?}, order {}", (errors[0] / errors[1]).log2());
        assert!(errors[1] < bound, "{scheme}: {errors:?}");
        assert!((errors[0] / errors[1]).log2() > order || errors[1] < 1e-9, "{scheme}: {errors:?}");
    }
}

#[test]
fn steps_of_chosen_size_follow_it() {
    let motion = Precession::new(0.2, 1.1, 3.0);
    for (tolerance, bound) in [("1e-5", 1e-3), ("1e-8", 3e-6)] {
        for scheme in SCHEMES {
            let model = motion.model(&format!("scheme = \"{scheme}\"\nrelative_tolerance = {tolerance}"));
            let record = run(&model, &[]);
            let found = ["x", "y", "z"].map(|axis| last(&record, "place", axis));
            let wanted = motion.place(2.0);
            let error = found.iter().zip(wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            println!("{scheme} {tolerance}: {error:e} in {} steps", record.times.len() - 1);
            assert!(error < bound, "{scheme} {tolerance}: {error:e}");
        }
    }
}

#[test]
fn a_rolling_disc_goes_on_from_a_snapshot_to_the_last_bit() {
    goes_on_from_a_snapshot(&Precession::new(0.2, 1.1, 3.0).model("step = 1e-3"), [0.3, 0.6]);
}

/// The force on the disc is what accelerates its centre: m v²/ρ towards the middle of the circle, and the weight.
#[test]
fn the_reaction_holds_the_disc_on_its_circle() {
    let motion = Precession::new(0.2, 1.1, 3.0);
    for scheme in SCHEMES {
        let record = run(&motion.model("step = 1e-3"), &[("analysis.scheme", scheme)]);
        let force = 1.7 * motion.radius * motion.spin.abs() * motion.rate.abs();
        let ends = [0, record.times.len() - 1];
        let [fx, fy, fz] = ["f1", "f2", "f3"].map(|name| column(&record, "floor", name));
        for end in ends {
            let found = fx[end].hypot(fy[end]);
            assert!((found - force).abs() < 2e-3 * force, "{scheme}: {found} {force}");
            assert!((fz[end] - 1.7 * GRAVITY).abs() < 1e-3 * 1.7 * GRAVITY, "{scheme}: {}", fz[end]);
        }
        // Forces of rolling do no work.
        let energy = column(&record, "energy", "total");
        assert!((energy[0] - energy[ends[1]]).abs() < 1e-4 * energy[0].abs(), "{scheme}: {energy:?}");
    }
}

/// A ball on a turning table runs around a circle, at 2/7 of the table's rate for a solid one.
#[test]
fn a_ball_circles_on_a_turntable() {
    let model = "
lissom = 1
gravity = [0, 0, -9.81]
[bodies.table]
mass = 5
inertia = [1, 1, 1]
position = [0, 0, 0]
[joints.axle]
kind = \"revolute\"
base = \"ground\"
tip = \"table\"
axis = [0, 0, 1]
[joints.motor]
kind = \"prescribed_rotation\"
joint = \"axle\"
rotation = \"2*t\"
[bodies.ball]
mass = 0.3
inertia = [0.012, 0.012, 0.012]
position = [0.5, 0, 0.316227766016838]
velocity = [0.1, 0.4, 0]
[joints.contact]
kind = \"rolling\"
base = \"table\"
tip = \"ball\"
at = [0, 0, 0]
axis = [0, 0, 1]
wheel_axis = [0, 1, 0]
radius = 0
rim = 0.316227766016838
[outputs.ball]
kind = \"position\"
of = \"ball\"
[outputs.velocity]
kind = \"velocity\"
of = \"ball\"
[analysis]
kind = \"dynamics\"
end = 4.0
step = 2e-3
";
    for scheme in SCHEMES {
        let record = run(model, &[("analysis.scheme", scheme)]);
        // What the ball starts with follows from its inertia: the velocity turns at 2/7 of 2 rad/s from there on.
        let [x, y, vx, vy] = [("ball", "x"), ("ball", "y"), ("velocity", "v1"), ("velocity", "v2")]
            .map(|(output, component)| column(&record, output, component));
        let rate = 4.0 / 7.0;
        let middle = [x[0] - vy[0] / rate, y[0] + vx[0] / rate];
        let circle = vx[0].hypot(vy[0]) / rate;
        let start = (y[0] - middle[1]).atan2(x[0] - middle[0]);
        let (sine, cosine) = (start + rate * 4.0).sin_cos();
        let wanted = [middle[0] + circle * cosine, middle[1] + circle * sine];
        let error = (x[x.len() - 1] - wanted[0]).hypot(y[y.len() - 1] - wanted[1]);
        println!("{scheme}: {error:e}");
        let bound = if scheme.starts_with("radau-iia") { 2e-6 } else { 2e-4 };
        assert!(error < bound, "{scheme}: {error:e}");
    }
}

#[test]
fn a_wheel_that_does_not_touch_is_refused() {
    let model = Precession::new(0.2, 1.1, 3.0).model("step = 1e-3");
    let said = refused(&model.replace("radius = 0.2", "radius = 0.21"));
    assert!(said.contains("from the plane"), "{said}");
    let statics =
        model.replace("kind = \"dynamics\"", "kind = \"statics\"").replace("step = 1e-3", "steps = 4");
    let Err(error) = lissom::Model::from_text("statics.toml", &statics).session() else {
        panic!("not rejected")
    };
    assert!(error.to_string().contains("rolling"), "{error}");
}

/// A disc that lies on the plane cannot roll; a ball has no axis that could.
#[test]
fn a_wheel_that_lies_flat_is_refused() {
    let model = Precession::new(0.2, 1.1, 3.0).model("step = 1e-3");
    let axis = model.lines().find(|line| line.starts_with("wheel_axis")).expect("a wheel");
    let flat = model.replace(axis, "wheel_axis = [0, 0, 1]");
    let said = refused(&flat.replace("radius = 0.2", ""));
    assert!(said.contains("is flat"), "{said}");
    let leaning = format!("wheel_axis = [{}, 0, 1]", 2e-3);
    let session = |model: &str| lissom::Model::from_text("wheel.toml", model).session().map(|_| ());
    session(&model.replace(axis, &leaning).replace("radius = 0.2", "")).expect("it stands on its rim");
    let height = 0.2 * 1.1_f64.sin();
    let ball = format!("radius = 0\nrim = {height}");
    session(&flat.replace("radius = 0.2", &ball)).expect("a ball has no lying side");
}

/// A disc that needs more friction than there is, and one that the plane would have to hold down, are reported.
#[test]
fn a_wheel_that_would_slide_or_lift_is_reported() {
    let warnings = |model: &str| {
        let mut session = lissom::Model::from_text("wheel.toml", model).session().expect("a model");
        session.run().unwrap();
        session.warnings().map(|warning| warning.code().to_owned()).collect::<Vec<_>>()
    };
    let model = Precession::new(0.2, 1.1, 3.0).model("step = 5e-3");
    assert!(warnings(&model).is_empty());
    let slippery = model.replace("radius = 0.2", "radius = 0.2\nfriction_coefficient = 0.1");
    assert_eq!(warnings(&slippery), ["wheel-slides"]);
    let hanging = model.replace("gravity = [0, 0, -9.81]", "gravity = [0, 0, 9.81]");
    assert!(warnings(&hanging).contains(&"wheel-lifts".to_owned()));
}

/// A disc that lies nearly flat and precesses steadily turns at 3 rad/s, but its point of contact travels at 62 rad/s: steps of
/// Steps of 10 ms resolve the one and not the other, which is reported; shorter and adaptive ones give no warning.
#[test]
fn a_point_of_contact_that_runs_round_in_few_steps_is_reported() {
    let disc = Precession::new(0.2, 0.05, 62.0);
    let warnings = |analysis: &str| {
        let mut session =
            lissom::Model::from_text("flat.toml", &disc.model(analysis)).session().expect("a model");
        session.run().unwrap();
        session.warnings().map(|warning| (warning.code().to_owned(), warning.to_string())).collect::<Vec<_>>()
    };
    let reported = warnings("step = 1e-2");
    let (_, words) = reported.iter().find(|(code, _)| code == "contact-runs-round").expect("a warning");
    assert!(words.contains("`floor`") && words.contains(" 0.6"), "{words}");
    for quiet in ["step = 1e-3", "step = 1e-2\nrelative_tolerance = 1e-5"] {
        assert!(warnings(quiet).iter().all(|(code, _)| code != "contact-runs-round"), "{quiet}");
    }
}

/// Two wheels on one axle prevent the same sliding along it: their forces there are not unique unless they creep. The axle rolls down a slope
/// as one body: a = g sin β m/(m + J/r²).
#[test]
fn two_wheels_on_an_axle_roll_down_a_slope() {
    let model = |creep: &str| {
        format!(
            "
lissom = 1
gravity = [2.0, 0, -9.0]
[bodies.axle]
mass = 3
inertia = [0.2, 0.05, 0.2]
position = [0, 0, 0.25]
[bodies.right]
mass = 1
inertia = [0.02, 0.016666666666666666, 0.02]
position = [0, -0.5, 0.25]
[joints.bearing]
kind = \"revolute\"
base = \"axle\"
tip = \"right\"
at = [0, -0.5, 0.25]
axis = [0, 1, 0]
[joints.left_wheel]
kind = \"rolling\"
base = \"ground\"
tip = \"axle\"
at = [0, 0, 0]
axis = [0, 0, 1]
wheel_axis = [0, 1, 0]
{creep}
[joints.right_wheel]
kind = \"rolling\"
base = \"ground\"
tip = \"right\"
at = [0, 0, 0]
axis = [0, 0, 1]
wheel_axis = [0, 1, 0]
{creep}
[outputs.axle]
kind = \"position\"
of = \"axle\"
[analysis]
kind = \"dynamics\"
end = 1.0
step = 2e-3
"
        )
    };
    let wanted = 0.5 * 2.0 * 3.0 / (3.0 + 0.05 / 0.0625);
    for creep in ["", "creep = 1e-6"] {
        for scheme in SCHEMES {
            let record = run(&model(creep), &[("analysis.scheme", scheme)]);
            let found = last(&record, "axle", "x");
            assert!((found - wanted).abs() < 1e-4, "{scheme} {creep}: {found} {wanted}");
            assert!((last(&record, "axle", "z") - 0.25).abs() < 1e-9, "{scheme}");
        }
    }
    // Only one of two forces along the axle is determined.
    let with_reaction = format!("{}[outputs.right]\nkind = \"reaction\"\nof = \"right_wheel\"\n", model(""));
    let session = lissom::Model::from_text("axle.toml", &with_reaction).session().expect("valid");
    let warnings: Vec<String> = session.warnings().map(ToString::to_string).collect();
    let is_named = |text: &String| text.contains("right.f2") && text.contains("translation along y");
    assert!(warnings.iter().any(is_named), "{warnings:?}");
}
