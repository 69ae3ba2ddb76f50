//! Relations between coordinates of joints against closed forms.

use lissom::Record;

use crate::support::refused::refused;
use crate::support::runs;
use runs::{SCHEMES, column, goes_on_from_a_snapshot, last, run};

/// Sun (20 teeth), three planets' one (15) on a carrier, and a ring (50), all about z; each with an inertia of its own.
const PLANETARY: &str = r#"
lissom = 1
[bodies.sun]
mass = 1
inertia = [0.01, 0.01, 0.02]
[bodies.carrier]
mass = 1
inertia = [0.02, 0.02, 0.05]
[bodies.planet]
mass = 0.5
inertia = [0.004, 0.004, 0.003]
position = [0.35, 0, 0]
[bodies.ring]
mass = 2
inertia = [0.1, 0.1, 0.4]
[joints.s]
kind = "revolute"
base = "ground"
tip = "sun"
at = [0, 0, 0]
axis = [0, 0, 1]
[joints.c]
kind = "revolute"
base = "ground"
tip = "carrier"
at = [0, 0, 0]
axis = [0, 0, 1]
[joints.p]
kind = "revolute"
base = "carrier"
tip = "planet"
axis = [0, 0, 1]
[joints.r]
kind = "revolute"
base = "ground"
tip = "ring"
at = [0, 0, 0]
axis = [0, 0, 1]
[joints.inner]
kind = "equation"
equation = "20*(s.angle - c.angle) + 15*p.angle"
[joints.outer]
kind = "equation"
equation = "50*(r.angle - c.angle) - 15*p.angle"
[loads.motor]
kind = "moment"
on = "sun"
vector = [0, 0, 0.01]
[outputs.s]
kind = "relative"
of = "s"
[outputs.c]
kind = "relative"
of = "c"
[outputs.p]
kind = "relative"
of = "p"
[outputs.r]
kind = "relative"
of = "r"
[outputs.inner]
kind = "reaction"
of = "inner"
[outputs.outer]
kind = "reaction"
of = "outer"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 1.0
step = 0.01
"#;

/// Accelerations and tooth forces by Lagrange: two degrees of freedom, s and c, with p = -(20/15)(s - c), r = c + (15/50) p.
fn planetary(held: bool) -> [f64; 4] {
    let (sun, carrier, planet, ring) = (0.02, 0.05 + 0.5 * 0.35 * 0.35, 0.003, 0.4);
    // Rows (s, c): absolute spin of the planet, of the ring.
    let of_planet = [-4.0 / 3.0, 1.0 + 4.0 / 3.0];
    let of_ring = [-0.4, 1.4];
    if held {
        // The ring stands: 1.4 c = 0.4 s.
        let c = 0.4 / 1.4;
        let planet_spin = of_planet[0] + of_planet[1] * c;
        let inertia = sun + carrier * c * c + planet * planet_spin * planet_spin;
        let s = 1.0 / inertia;
        return [s, c * s, -4.0 / 3.0 * (s - c * s), 0.0];
    }
    let entry = |i: usize, j: usize| planet * of_planet[i] * of_planet[j] + ring * of_ring[i] * of_ring[j];
    let (a, b, d) = (sun + entry(0, 0), entry(0, 1), carrier + entry(1, 1));
    let determinant = a * d - b * b;
    let (s, c) = (d / determinant, -b / determinant);
    let p = -4.0 / 3.0 * (s - c);
    [s, c, p, c + 0.3 * p]
}

#[test]
fn a_planetary_gear_has_its_ratios_and_torques() {
    for scheme in SCHEMES {
        let record = run(PLANETARY, &[("analysis.scheme", scheme)]);
        let [s, c, p, r] = planetary(false).map(|by_unit| 0.01 * by_unit);
        // The planet goes round in a circle, which steps approximate.
        let allowed = if scheme.starts_with("radau-iia") { 1e-9 } else { 1e-5 } * s;
        for (name, wanted) in [("s", s), ("c", c), ("p", p), ("r", r)] {
            let (angle, rate) = (last(&record, name, "angle"), last(&record, name, "rate"));
            assert!((angle - 0.5 * wanted).abs() < allowed, "{scheme} {name}: {angle} {wanted}");
            assert!((rate - wanted).abs() < 1e-5 * s, "{scheme} {name}: {rate} {wanted}");
        }
        // On the sun's joint: J s̈ = 0.01 + moment; in the proportions of the equation's factors on all three.
        let moment = |output: &str, k: usize| last(&record, output, &format!("moment{k}"));
        assert!((moment("inner", 1) - (0.02 * s - 0.01)).abs() < 1e-5 * s, "{scheme}");
        assert!((moment("inner", 2) + moment("inner", 1)).abs() < 1e-11, "{scheme}");
        assert!((moment("inner", 3) - 0.75 * moment("inner", 1)).abs() < 1e-11, "{scheme}");
        assert!((moment("outer", 1) - 0.4 * r).abs() < 1e-5 * s, "{scheme}");
    }
    let held = PLANETARY.replace(
        "[outputs.s]",
        "[joints.brake]\nkind = \"prescribed_rotation\"\njoint = \"r\"\nrotation = 0\n[outputs.s]",
    );
    let record = run(&held, &[]);
    let [s, c, ..] = planetary(true).map(|by_unit| 0.01 * by_unit);
    assert!((last(&record, "s", "angle") - 0.5 * s).abs() < 1e-9 * s);
    // Willis: with the ring held the carrier turns by z_sun / (z_sun + z_ring).
    for (sun, carrier) in column(&record, "s", "angle").iter().zip(column(&record, "c", "angle")) {
        assert!((carrier - sun * 20.0 / 70.0).abs() < 1e-12 * (1.0 + sun.abs()));
    }
    assert!((last(&record, "c", "rate") - c).abs() < 1e-5 * s);
}

/// A weight on a rack turns a wheel: with the radius r, z̈ = -g m / (m + J/r²).
#[test]
fn a_rack_pulls_its_wheel() {
    let text = r#"
lissom = 1
gravity = [0, 0, -9.81]
[bodies.wheel]
mass = 1
inertia = [0.01, 0.02, 0.01]
[bodies.rack]
mass = 3
inertia = [0.01, 0.01, 0.01]
position = [0.2, 0, 1]
[joints.axle]
kind = "revolute"
base = "ground"
tip = "wheel"
at = [0, 0, 0]
axis = [0, 1, 0]
angle = 0.4
[joints.guide]
kind = "prismatic"
base = "ground"
tip = "rack"
axis = [0, 0, 1]
[joints.mesh]
kind = "gear"
joint = "axle"
other = "guide"
ratio = -0.2
[outputs.rack]
kind = "position"
of = "rack"
[outputs.axle]
kind = "relative"
of = "axle"
[outputs.mesh]
kind = "reaction"
of = "mesh"
[outputs.energy]
kind = "energy"
[analysis]
kind = "dynamics"
end = 1.0
step = 0.01
"#;
    let acceleration = -9.81 * 3.0 / (3.0 + 0.02 / 0.04);
    for scheme in SCHEMES {
        let record = run(text, &[("analysis.scheme", scheme)]);
        let fall = last(&record, "rack", "z") - 1.0;
        assert!((fall - 0.5 * acceleration).abs() < 1e-9, "{scheme}: {fall} {}", 0.5 * acceleration);
        assert!((last(&record, "axle", "angle") - 0.4 - fall / -0.2).abs() < 1e-12, "{scheme}");
        let (moment, force) = (last(&record, "mesh", "moment1"), last(&record, "mesh", "force2"));
        assert!((force - 3.0 * (acceleration + 9.81)).abs() < 1e-7, "{scheme}: {force}");
        assert!((moment - 0.2 * force).abs() < 1e-11, "{scheme}: {moment} {force}");
    }
}

const CAM: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]
[bodies.cam]
mass = 1
inertia = [0.01, 0.02, 0.01]
[bodies.follower]
mass = 0.7
inertia = [0.01, 0.01, 0.01]
position = [0, 0, 1]
[joints.shaft]
kind = "revolute"
base = "ground"
tip = "cam"
at = [0, 0, 0]
axis = [0, 1, 0]
[joints.motor]
kind = "prescribed_rotation"
joint = "shaft"
rotation = "5*t + 0.3*sin(4*t)"
[joints.guide]
kind = "prismatic"
base = "ground"
tip = "follower"
axis = [0, 0, 1]
[joints.lift]
kind = "cam"
joint = "shaft"
other = "guide"
profile = "0.05*(1 - cos(x))"
[outputs.follower]
kind = "relative"
of = "guide"
[outputs.lift]
kind = "reaction"
of = "lift"
[outputs.motor]
kind = "reaction"
of = "motor"
[analysis]
kind = "dynamics"
end = 1.0
step = 0.002
"#;

/// The follower of a turning cam moves as by a drive of the same motion, and bears the same force.
#[test]
fn a_cam_is_as_the_drive_that_gives_its_motion() {
    let driven = CAM
        .replace(
            "kind = \"cam\"\njoint = \"shaft\"\nother = \"guide\"\nprofile",
            "kind = \"prescribed_displacement\"\njoint = \"guide\"\ndisplacement",
        )
        .replace("(1 - cos(x))", "(1 - cos(5*t + 0.3*sin(4*t)))");
    let equation = CAM.replace(
        "kind = \"cam\"\njoint = \"shaft\"\nother = \"guide\"\nprofile = \"0.05*(1 - cos(x))\"",
        "kind = \"equation\"\nequation = \"1000*(guide.displacement - 0.05*(1 - cos(shaft.angle)))\"",
    );
    for scheme in SCHEMES {
        let scheme = [("analysis.scheme", scheme)];
        let records = [CAM, &driven, &equation].map(|text| run(text, &scheme));
        for component in ["displacement", "velocity"] {
            let [cam, drive, equation] =
                records.each_ref().map(|record| column(record, "follower", component));
            for k in 0..cam.len() {
                // Schemes of one stage satisfy rates to their own order.
                let allowed = if component == "displacement" { 1e-13 } else { 1e-3 };
                assert!(
                    (cam[k] - drive[k]).abs() < allowed,
                    "{scheme:?} {component} {k}: {} {}",
                    cam[k],
                    drive[k]
                );
                assert!((cam[k] - equation[k]).abs() < 1e-11, "{scheme:?} {component} {k}");
            }
        }
        let wanted = last(&records[1], "lift", "force");
        let (cam, other) = (last(&records[0], "lift", "force2"), last(&records[2], "lift", "force1"));
        assert!((cam - wanted).abs() < 1e-2 * wanted.abs(), "{scheme:?}: {cam} {wanted}");
        assert!((cam - other).abs() < 1e-7 * wanted.abs(), "{scheme:?}: {cam} {other}");
        // The motor works against the follower: its moment is the force times the slope, and what turns the cam.
        let time: f64 = 1.0;
        let angle = 5.0 * time + 0.3 * (4.0 * time).sin();
        let turning = 0.02 * -4.8 * (4.0 * time).sin();
        let moment = last(&records[0], "motor", "moment");
        let from_follower = cam * 0.05 * angle.sin();
        assert!((moment - turning - from_follower).abs() < 1e-2 * moment.abs(), "{scheme:?}: {moment}");
    }
    // A spline through the same curve, closely.
    let rows: Vec<String> = (0..=400)
        .map(|k| {
            let x = -0.5 + 7.0 * f64::from(k) / 400.0;
            format!("[{x}, {}]", 0.05 * (1.0 - x.cos()))
        })
        .collect();
    let table = CAM.replace(
        "profile = \"0.05*(1 - cos(x))\"",
        &format!("profile = {{ table = [{}], interpolation = \"spline\" }}", rows.join(", ")),
    );
    let scheme = [("analysis.scheme", "radau-iia")];
    let (smooth, splined) = (run(CAM, &scheme), run(&table, &scheme));
    let difference = last(&smooth, "follower", "displacement") - last(&splined, "follower", "displacement");
    assert!(difference.abs() < 1e-8, "{difference}");
    // Straight lines have corners: the follower's speed would jump.
    let linear = table.replace(", interpolation = \"spline\"", "");
    assert!(refused(&linear).contains("kink"), "{}", refused(&linear));
}

/// Pendulums whose angles are tied by a curve, released: energy is kept by the energy-decaying scheme, chosen steps agree
/// with short ones, and a snapshot goes on to the last bit.
const TIED: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]
[bodies.a]
mass = 1
inertia = [0.01, 0.02, 0.01]
position = [0.5, 0, 0]
[bodies.b]
mass = 0.5
inertia = [0.01, 0.02, 0.01]
position = [2.3, 0, 0]
[joints.one]
kind = "revolute"
base = "ground"
tip = "a"
at = [0, 0, 0]
axis = [0, 1, 0]
[joints.two]
kind = "revolute"
base = "ground"
tip = "b"
at = [2, 0, 0]
axis = [0, 1, 0]
[joints.curve]
kind = "equation"
equation = "two.angle - 0.8*sin(one.angle) - 0.2*one.angle^2 + 0.1*one.angle*two.angle"
[outputs.one]
kind = "relative"
of = "one"
[outputs.two]
kind = "relative"
of = "two"
[outputs.energy]
kind = "energy"
[analysis]
kind = "dynamics"
end = 2.0
step = 2e-3
"#;

#[test]
fn curved_relations_keep_energy_and_hold() {
    let reference = run(TIED, &[("analysis.step", "2e-4"), ("analysis.scheme", "radau-iia")]);
    let near = |record: &Record, tolerance: f64, most: f64, what: &str| {
        let (a, b) = (last(record, "one", "angle"), last(&reference, "one", "angle"));
        assert!((a - b).abs() < tolerance, "{what}: {a} {b}");
        for (one, two) in column(record, "one", "angle").iter().zip(column(record, "two", "angle")) {
            let violation = two - 0.8 * one.sin() - 0.2 * one * one + 0.1 * one * two;
            assert!(violation.abs() < most, "{what}: {violation}");
        }
    };
    for scheme in SCHEMES {
        near(&run(TIED, &[("analysis.scheme", scheme)]), 2e-3, 1e-11, scheme);
    }
    let chosen = TIED.replace("step = 2e-3", "relative_tolerance = 1e-5");
    // Between the ends of steps, relations hold to the error of the interpolation; at the ends, as Newton's iterations stop.
    near(&run(&chosen, &[]), 1e-3, 1e-6, "chosen steps");
    near(&run(&chosen, &[("analysis.output_every", "2")]), 1e-3, 1e-10, "ends of chosen steps");
    for step in ["1e-3", "1e-2", "5e-2"] {
        let overrides = [
            ("analysis.scheme", "energy-decaying"),
            ("analysis.spectral_radius", "1.0"),
            ("analysis.step", step),
        ];
        let record = run(TIED, &overrides);
        let energy = column(&record, "energy", "total");
        let most = energy.iter().fold(0.0_f64, |most, value| most.max((value - energy[0]).abs()));
        assert!(most < 1e-9, "step {step}: energy changes by {most:e}");
    }
}

#[test]
fn relations_go_on_from_a_snapshot_to_the_last_bit() {
    for text in [TIED, CAM, PLANETARY] {
        goes_on_from_a_snapshot(text, [0.4, 0.8]);
    }
}

/// A relation may depend on the time: then it does work, which the energy balance contains.
#[test]
fn a_relation_that_moves_is_a_drive() {
    let moving = TIED.replace("+ 0.1*one.angle*two.angle", "+ 0.1*one.angle*two.angle - 0.3*t^2*(3 - 2*t/2)");
    let record = run(&moving, &[("analysis.scheme", "radau-iia"), ("analysis.end", "1.0")]);
    let (one, two) = (last(&record, "one", "angle"), last(&record, "two", "angle"));
    let violation = two - 0.8 * one.sin() - 0.2 * one * one + 0.1 * one * two - 0.6;
    assert!(violation.abs() < 1e-11, "{violation}");
}

#[test]
fn wrong_relations_are_reported() {
    let equation = "two.angle - 0.8*sin(one.angle) - 0.2*one.angle^2 + 0.1*one.angle*two.angle";
    for (instead, words) in [
        ("two.angle - one.angle - 0.3", "does not hold at the start: it misses by -0.3,"),
        ("two.angle - one.rate", "is a rate"),
        ("two.angel - one.angle", "no coordinate `angel`"),
        ("too.angle - one.angle", "no joint `too`"),
        ("two - one", "unknown name"),
        ("t - t", "at least one"),
        ("one.angle^2 + two.angle^2", "does not change with its coordinates"),
    ] {
        let found = refused(&TIED.replace(equation, instead));
        assert!(found.contains(words), "{instead}: {found}");
    }
    for (old, instead, words) in [
        ("other = \"guide\"", "other = \"motor\"", "same coordinate"),
        ("other = \"guide\"", "other = \"lift\"", "no relative coordinate"),
        ("other = \"guide\"", "other = \"giude\"", "giude"),
        ("profile = \"0.05*(1 - cos(x))\"", "profile = \"0.05*(1 - cos(t))\"", "`t`"),
        ("profile = \"0.05*(1 - cos(x))\"", "profile = \"0.01 + x\"", "does not hold at the start"),
        ("lissom = 1", "lissom = 1\n[parameters]\nx = 3", "parameter"),
        ("kind = \"prismatic\"", "kind = \"cylindrical\"", "which one?"),
        ("rotation = \"5*t", "coordinate = 2\nrotation = \"5*t", "joint `shaft` has no coordinate 2"),
        ("rotation = \"5*t", "coordinate = 0.5\nrotation = \"5*t", "joint `shaft` has no coordinate 0.5"),
        ("other = \"guide\"", "other = \"guide\"\nother_coordinate = 2", "joint `guide` has no coordinate 2"),
        (
            "other = \"guide\"",
            "other = \"guide\"\nother_coordinate = 1.5",
            "joint `guide` has no coordinate 1.5",
        ),
    ] {
        let found = refused(&CAM.replace(old, instead));
        assert!(found.contains(words), "{instead}: {found}");
    }
}
