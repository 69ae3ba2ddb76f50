//! Wheels that slip: sliding with the friction that the law gives, the passage to rolling, the limit of rolling, lifting.

use crate::support::refused::refused;
use crate::support::runs::{column, run};

const SCHEMES: [&str; 5] = ["radau-iia", "radau-iia-5", "generalized-alpha", "hht", "energy-decaying"];
const GRAVITY: f64 = 9.81;
const RADIUS: f64 = 0.3;

/// A wheel of 4 kg and inertia m r²/2 about y, pressed down by its weight from the start on.
fn wheel(speed: f64, spin: f64, more: &str, law: &str) -> String {
    let (mass, stiffness) = (4.0, 1e6);
    let height = RADIUS - mass * GRAVITY / stiffness;
    format!(
        r#"
lissom = 1
gravity = [0, 0, -{GRAVITY}]
[bodies.wheel]
mass = {mass}
inertia = [0.09, 0.18, 0.09]
position = [0, 0, {height}]
velocity = [{speed}, 0, 0]
angular_velocity = [0, {spin}, 0]
[springs.road]
kind = "rolling_contact"
base = "ground"
tip = "wheel"
at_base = [0, 0, 0]
normal = [0, 0, 1]
wheel_axis = [0, 1, 0]
radius = {RADIUS}
stiffness = {stiffness}
{law}
{more}
[outputs.place]
kind = "position"
of = "wheel"
[outputs.velocity]
kind = "velocity"
of = "wheel"
[outputs.spin]
kind = "angular_velocity"
of = "wheel"
[outputs.road]
kind = "spring"
of = "road"
[outputs.energy]
kind = "energy"
[analysis]
kind = "dynamics"
end = 1.5
step = 2e-3
"#
    )
}

const LAW: &str = "friction_coefficient = 0.5\nslip_velocity = 1e-3";

/// v falls by μ g t and ω grows by 2 μ g t/r until v = ω r = 2 v₀/3 at t = v₀/(3 μ g); from then on it rolls.
#[test]
fn a_wheel_that_is_thrown_slides_and_then_rolls() {
    for (speed, spin) in [(5.0_f64, 0.0_f64), (0.0, 40.0)] {
        let text = wheel(speed, spin, "", LAW);
        let (slip, friction) = (speed - spin * RADIUS, 0.5 * GRAVITY);
        let rolls_from = slip.abs() / (3.0 * friction);
        let rolling = speed - slip / 3.0;
        for set in SCHEMES
            .map(|scheme| vec![("analysis.scheme", scheme)])
            .into_iter()
            // The force of the stiff contact is far below what errors of positions make of it.
            .chain([vec![("analysis.relative_tolerance", "1e-6"), ("analysis.control", "\"forces\"")]])
        {
            let record = run(&text, &set);
            for (row, &time) in record.times.iter().enumerate() {
                let (velocity, turning) =
                    (column(&record, "velocity", "v1")[row], column(&record, "spin", "w2")[row]);
                let slid = time.min(rolls_from);
                let wanted = speed - slip.signum() * friction * slid;
                let turned = spin + slip.signum() * 2.0 * friction / RADIUS * slid;
                assert!((velocity - wanted).abs() < 5e-3, "{set:?} t = {time}: {velocity} {wanted}");
                assert!(
                    (turning * RADIUS - turned * RADIUS).abs() < 3e-2,
                    "{set:?} t = {time}: {turning} {turned}"
                );
                let normal = column(&record, "road", "force")[row];
                assert!((normal / (4.0 * GRAVITY) - 1.0).abs() < 3e-2, "{set:?} t = {time}: {normal}");
            }
            let last = record.times.len() - 1;
            assert!((column(&record, "velocity", "v1")[last] - rolling).abs() < 5e-3, "{set:?}");
        }
    }
}

/// A wheel of inertia m r²/2 decelerates by 2 ρ g/(3 r) until it stands, and stays.
#[test]
fn rolling_friction_stops_a_wheel() {
    let arm = 0.01;
    let deceleration = 2.0 / 3.0 * GRAVITY * arm / RADIUS;
    let law = format!("{LAW}\nrolling_friction = {arm}\nrolling_rate = 1e-3");
    for (speed, scheme) in [5.0, -5.0].into_iter().flat_map(|speed| SCHEMES.map(|scheme| (speed, scheme))) {
        let record = run(&wheel(speed, speed / RADIUS, "", &law), &[("analysis.scheme", scheme)]);
        let velocity = column(&record, "velocity", "v1");
        let wanted = speed - speed.signum() * deceleration * 1.5;
        assert!(
            (velocity[velocity.len() - 1] - wanted).abs() < 3e-3,
            "{scheme}: {} {wanted}",
            velocity[velocity.len() - 1]
        );
    }
    let record = run(&wheel(0.2, 0.2 / RADIUS, "", &law), &[]);
    let (place, spin) = (column(&record, "place", "x"), column(&record, "spin", "w2"));
    let last = place.len() - 1;
    let wanted = 0.04 / (2.0 * deceleration);
    assert!((place[last] / wanted - 1.0).abs() < 1e-2, "{} {wanted}", place[last]);
    assert!(spin[last].abs() < 1e-4, "{}", spin[last]);
}

/// A moment N c ω: the velocity decays with 2 g c/(3 r²).
#[test]
fn rolling_damping_slows_a_wheel_exponentially() {
    let damping = 0.01;
    let decay = 2.0 / 3.0 * GRAVITY * damping / (RADIUS * RADIUS);
    let law = format!("{LAW}\nrolling_damping = {damping}");
    let record = run(&wheel(5.0, 5.0 / RADIUS, "", &law), &[]);
    for (velocity, time) in column(&record, "velocity", "v1").iter().zip(&record.times) {
        let wanted = 5.0 * (-decay * time).exp();
        assert!((velocity - wanted).abs() < 6e-3, "{time}: {velocity} {wanted}");
    }
}

/// Rolling friction of a ball acts in every direction, and not against its spin about the normal.
#[test]
fn rolling_friction_of_a_ball_acts_in_the_plane() {
    let (arm, spin) = (0.01, 7.0);
    let law = format!("{LAW}\nrim = {RADIUS}\nrolling_friction = {arm}\nrolling_rate = 1e-3");
    let turning = format!("[{}, {}, {spin}]", -4.0 / RADIUS, 3.0 / RADIUS);
    let set = [
        ("springs.road.radius", "0"),
        ("bodies.wheel.inertia", "[0.18, 0.18, 0.18]"),
        ("bodies.wheel.velocity", "[3, 4, 0]"),
        ("bodies.wheel.angular_velocity", turning.as_str()),
        ("analysis.relative_tolerance", "1e-7"),
    ];
    let record = run(&wheel(1.0, 1.0, "", &law), &set);
    let speed = 5.0 - 2.0 / 3.0 * GRAVITY * arm / RADIUS * 1.5;
    let last = record.times.len() - 1;
    for (component, share) in [("v1", 0.6), ("v2", 0.8)] {
        let velocity = column(&record, "velocity", component)[last];
        assert!((velocity - share * speed).abs() < 1e-3, "{component}: {velocity}");
    }
    assert!((column(&record, "spin", "w3")[last] - spin).abs() < 1e-4);
    let lonely = format!("{LAW}\nrolling_rate = 1");
    let text = refused(&wheel(1.0, 1.0, "", &lonely));
    assert!(text.contains("has no meaning without `rolling_friction`"), "{text}");
}

/// A wheel that is dropped on a linear spring and damper: see the same test of stops.
#[test]
fn a_damped_wheel_has_the_restitution_of_the_linear_oscillator() {
    let (ratio, mass, stiffness) = (0.2_f64, 4.0_f64, 1e6_f64);
    let damping = 2.0 * ratio * (mass * stiffness).sqrt();
    let decay = ratio / (1.0 - ratio * ratio).sqrt();
    let restitution = (-decay * (std::f64::consts::PI - 2.0 * ratio.asin())).exp();
    let set = [
        ("gravity", "[0, 0, 0]"),
        ("bodies.wheel.position", "[0, 0, 0.31]"),
        ("bodies.wheel.velocity", "[0, 0, -1]"),
        ("analysis.end", "0.03"),
        ("analysis.step", "5e-5"),
    ];
    for scheme in SCHEMES {
        let set: Vec<_> = set.into_iter().chain([("analysis.scheme", scheme)]).collect();
        let record = run(&wheel(0.0, 0.0, "", &format!("damping = {damping}")), &set);
        let found = *column(&record, "velocity", "v3").last().expect("a record");
        assert!((found / restitution - 1.0).abs() < 1e-2, "{scheme}: {found} {restitution}");
    }
}

/// A wheel that its brake holds slides v²/(2 μ g), and stays.
#[test]
fn a_wheel_that_is_held_stops_after_its_braking_distance() {
    let brake = "[joints.brake]\nkind = \"generic\"\nbase = \"ground\"\ntip = \"wheel\"\nlocked = [\"y\", \"rx\", \"ry\", \"rz\"]";
    let record = run(&wheel(5.0, 0.0, brake, LAW), &[]);
    let wanted = 25.0 / (2.0 * 0.5 * GRAVITY);
    let place = column(&record, "place", "x");
    assert!((place[place.len() - 1] / wanted - 1.0).abs() < 2e-3, "{} {wanted}", place[place.len() - 1]);
    // The law that is given as an expression is the same.
    let given = run(&wheel(5.0, 0.0, brake, "traction = \"0.5*tanh(slip/1e-3)\""), &[]);
    let other = column(&given, "place", "x");
    assert!((place[place.len() - 1] - other[other.len() - 1]).abs() < 1e-9);
    // With less grip at high slip, as of a tyre, the way is longer.
    let tyre = run(&wheel(5.0, 0.0, brake, "traction = \"0.5*sin(1.6*atan(20*slip))\""), &[]);
    let longer = column(&tyre, "place", "x");
    assert!(longer[longer.len() - 1] > 1.02 * wanted);
}

/// Lagrange's steady precession, in the limit of a stiff plane and little slip: 6 r Ω n sin α - r Ω² sin α cos α + 4 g cos α = 0.
#[test]
fn a_disc_precesses_as_if_it_rolled() {
    let (radius, lean, rate) = (0.2_f64, 1.1_f64, 3.0_f64);
    let (sine, cosine) = lean.sin_cos();
    let spin = (radius * rate * rate * sine * cosine - 4.0 * GRAVITY * cosine) / (6.0 * radius * rate * sine);
    let (mass, stiffness) = (1.7, 1e7);
    let text = format!(
        "
lissom = 1
gravity = [0, 0, -{GRAVITY}]
[bodies.disc]
mass = {mass}
inertia = [{a}, {a}, {c}]
position = [0.4, -0.2, {height}]
axes = [[0, 1, 0], [{up_x}, 0, {sine}]]
velocity = [0, {speed}, 0]
angular_velocity = [0, {tilting}, {spin}]
[springs.floor]
kind = \"rolling_contact\"
base = \"ground\"
tip = \"disc\"
at_base = [3, 2, 0]
normal = [0, 0, 1]
wheel_axis = [{sine}, 0, {cosine}]
radius = {radius}
stiffness = {stiffness}
friction_coefficient = 2
slip_velocity = 1e-4
[outputs.place]
kind = \"position\"
of = \"disc\"
[analysis]
kind = \"dynamics\"
end = 2.0
step = 1e-3
",
        a = 0.25 * mass * radius * radius,
        c = 0.5 * mass * radius * radius,
        height = radius * sine - mass * GRAVITY / stiffness,
        up_x = -cosine,
        speed = -radius * spin,
        tilting = rate * sine,
    );
    let record = run(&text, &[]);
    let (speed, angle) = (-radius * spin, rate * 2.0);
    let circle = speed / rate;
    let wanted = [0.4 - circle * (1.0 - angle.cos()), -0.2 + circle * angle.sin(), radius * sine];
    for (axis, wanted) in ["x", "y", "z"].into_iter().zip(wanted) {
        let found = *column(&record, "place", axis).last().unwrap();
        assert!((found - wanted).abs() < 1e-3, "{axis}: {found} {wanted}");
    }
}

/// A ball that falls on the plane bounces: no force without touch, and its energy is that of the fall.
#[test]
fn a_ball_lifts_and_falls_again() {
    let text = wheel(0.0, 0.0, "", "").replace("radius = 0.3\n", "radius = 0\nrim = 0.3\n");
    let text = text.replace("wheel_axis = [0, 1, 0]", "wheel_axis = [1, 0, 0]");
    let text = text
        .replace(&format!("position = [0, 0, {}]", RADIUS - 4.0 * GRAVITY / 1e6), "position = [0, 0, 0.5]");
    let record = run(&text, &[("analysis.relative_tolerance", "1e-7"), ("analysis.output_step", "5e-3")]);
    let (height, force) = (column(&record, "place", "z"), column(&record, "road", "force"));
    let energy = column(&record, "energy", "total");
    let bounce = (0.4 / GRAVITY).sqrt();
    for (row, &time) in record.times.iter().enumerate() {
        if time < 0.99 * bounce {
            assert!(force[row] == 0.0 && (height[row] - 0.5 + 0.5 * GRAVITY * time * time).abs() < 1e-7);
        }
        assert!((energy[row] / energy[0] - 1.0).abs() < 1e-3, "t = {time}: {}", energy[row]);
    }
    let most = (0..height.len()).filter(|&row| record.times[row] > 1.5 * bounce);
    let most = most.map(|row| height[row]).fold(0.0, f64::max);
    assert!((most - 0.5).abs() < 1e-3, "{most}");
    assert!(force.iter().any(|force| *force > 100.0));
}

const MECANUM: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]
[bodies.carrier]
mass = 3
inertia = [0.1, 0.1, 0.1]
position = [0, 0, 0.2999]
[joints.guide]
kind = "generic"
base = "ground"
tip = "carrier"
locked = ["rx", "ry", "rz"]
[bodies.wheel]
mass = 1
inertia = [0.02, 0.04, 0.02]
position = [0, 0, 0.2999]
angular_velocity = [0, 4, 0]
[joints.hub]
kind = "revolute"
base = "carrier"
tip = "wheel"
axis = [0, 1, 0]
[joints.motor]
kind = "prescribed_rotation"
joint = "hub"
rotation = "4*t"
[springs.road]
kind = "rolling_contact"
base = "ground"
tip = "wheel"
at_base = [0, 0, 0]
normal = [0, 0, 1]
wheel_axis = [0, 1, 0]
radius = 0.3
stiffness = 4e5
damping = 2000
friction_coefficient = 0.5
slip_velocity = 1e-3
roller_angle = 0
[outputs.velocity]
kind = "velocity"
of = "carrier"
[outputs.place]
kind = "position"
of = "carrier"
[analysis]
kind = "dynamics"
end = 1
step = 1e-3
"#;

/// Rollers at an angle γ drive a wheel along their axis d at r ω (t·d), with t the direction in which it would roll, and leave it free
/// across. For a wheel with rolled compression r is smaller by it.
#[test]
fn a_wheel_with_rollers_moves_along_their_axis() {
    for angle in [0.5_f64, std::f64::consts::FRAC_PI_4, -1.0, std::f64::consts::FRAC_PI_2] {
        let record = run(MECANUM, &[("springs.road.roller_angle", &format!("{angle:?}"))]);
        let last = |component: &str| *column(&record, "velocity", component).last().unwrap();
        // The axis of the wheel, y, turned by the angle about z.
        let along = [-angle.sin(), angle.cos()];
        let radius = *column(&record, "place", "z").last().unwrap();
        let speed = 4.0 * radius * along[0];
        for (component, along) in ["v1", "v2"].into_iter().zip(along) {
            let (found, wanted) = (last(component), speed * along);
            assert!((found - wanted).abs() < 1e-4, "{angle} {component}: {found} {wanted}");
        }
    }
    let ball = MECANUM
        .replace("radius = 0.3", "radius = 0\nrim = 0.3")
        .replace("wheel_axis = [0, 1, 0]", "wheel_axis = [0, 1, 0.1]");
    assert!(refused(&ball).contains("has no meaning for a ball"));
}

#[test]
fn laws_that_make_no_sense_are_refused() {
    for (law, wanted) in [
        ("traction = \"0.5\"", "must be zero there"),
        ("traction = \"-slip\"", "negative friction would drive"),
        ("traction = \"slip\"\nfriction_coefficient = 0.3", "remove one of them"),
    ] {
        let found = refused(&wheel(1.0, 0.0, "", law));
        assert!(found.contains(wanted), "{found}");
    }
    for (from, to, wanted) in [
        ("wheel_axis = [0, 1, 0]", "wheel_axis = [0, 0, 1]", "is flat"),
        ("wheel_axis = [0, 1, 0]", "wheel_axis = [0, 0, -1]", "is flat"),
        ("radius = 0.3", "rim = 0.4", "there is no wheel to roll"),
        ("radius = 0.3", "radius = 0", "there is no wheel to roll"),
        ("at_base = [0, 0, 0]", "at_base = [0, 0, 1]\nat_tip = [2, 0, 1]", "is in the plane"),
    ] {
        let text = wheel(1.0, 0.0, "", LAW);
        assert!(text.contains(from), "{from}");
        let found = refused(&text.replace(from, to));
        assert!(found.contains(wanted), "{found}");
    }
}
