//! The car of the examples against the formulas of vehicle dynamics.

use std::f64::consts::PI;

use lissom::Record;

use crate::support::runs::{column, last, run, run_without_warnings};

const CAR: &str = include_str!("../../../../examples/car.toml");
const GRAVITY: f64 = 9.81;
/// Between the axles and between the wheels, and from the rear axle to the origin [m].
const SIZES: [f64; 3] = [2.6, 1.5, 1.4];
/// Straight ahead without driver and engine.
const STRAIGHT: [(&str, &str); 3] =
    [("parameters.driver", "0"), ("parameters.cruise", "0"), ("inputs.clutch", "0")];

fn close(found: f64, wanted: f64, relative: f64, what: &str) {
    assert!((found - wanted).abs() <= relative * wanted.abs(), "{what}: {found}, not {wanted}");
}

/// The car with these values.
fn drive(more: &[(&str, &str)]) -> Record {
    run_without_warnings(CAR, &[&STRAIGHT[..], more].concat())
}

/// Column of a tyre's force.
fn tyre<'r>(record: &'r Record, wheel: usize, axis: &str) -> &'r [f64] {
    column(record, &format!("tyre{wheel}.road"), axis)
}

/// Mass, and its moments along and upwards about the contact of the rear wheels: body, wheels with uprights and wishbones, rack, two bars.
fn masses() -> [f64; 3] {
    let parts = [
        (1200.0, 0.0, 0.55),
        (80.0, 1.2, 0.31),
        (80.0, -1.4, 0.31),
        (3.0, 1.08, 0.258),
        (4.0, 1.3, 0.36),
        (4.0, -1.3, 0.36),
    ];
    parts.iter().fold([0.0; 3], |[mass, along, upwards], (own, x, z)| {
        [mass + own, along + own * (x + SIZES[2]), upwards + own * z]
    })
}

#[test]
fn the_wheels_of_a_car_carry_its_weight_by_its_levers() {
    let record = drive(&[("analysis.end", "3")]);
    let [mass, along, _] = masses();
    let front = along * GRAVITY / SIZES[0];
    for (wheel, wanted) in [front, front, mass * GRAVITY - front, mass * GRAVITY - front].iter().enumerate() {
        let load = *tyre(&record, wheel + 1, "f3").last().expect("rows");
        close(load, wanted / 2.0, 2e-3, &format!("load of wheel {}", wheel + 1));
        let travel = last(&record, &format!("corner{}.travel", wheel + 1), "value");
        assert!(travel.abs() < 1e-3, "design position: {travel}");
    }
}

/// Side slip angles are m V r (b + t)/(L C_f) and m V r (a - t)/(L C_r), because tyres pull behind their contacts by their trail t; the
/// steering angles of the wheels, with those by roll and by the column, are their difference and L r/V.
#[test]
fn a_car_turns_as_the_single_track_model() {
    let record = drive(&[("parameters.steering", "0.02"), ("analysis.end", "4")]);
    let [mass, along, _] = masses();
    let (rear, trail) = (along / mass, 0.0325);
    let front = SIZES[0] - rear;
    let weights = [front, rear].map(|lever| mass * GRAVITY * lever / SIZES[0]);
    let gradient =
        mass / SIZES[0] * ((rear + trail) / (15.0 * weights[1]) - (front - trail) / (17.0 * weights[0]));
    let toe = |wheel: usize| last(&record, &format!("corner{wheel}.toe"), "value");
    let steer = 0.5 * (toe(2) - toe(1)) - 0.5 * (toe(4) - toe(3));
    let speed = last(&record, "velocity", "v1").hypot(last(&record, "velocity", "v2"));
    let curvature = last(&record, "turn", "w3") / speed;
    close(curvature, steer / (SIZES[0] + gradient * speed * speed), 5e-3, "curvature");
    assert!(gradient * speed * speed > 0.3 && steer > 1e-3, "{gradient} {steer}");
}

/// In braking the front gains (m a h + Σ J ω' + Σ F 2 δ/3 + m g c β)/L: of the centre of mass, of the wheels' angular momentum, of forces that
/// act on the wheels at their effective radius R - δ/3, and of the body that moves ahead by its pitch β, c above the wheels.
#[test]
fn a_braked_car_shifts_its_weight_and_stays_in_the_circles_of_friction() {
    let braked = [("parameters.brake", "700"), ("analysis.end", "5.5")];
    let record = drive(&braked);
    let rows = record.times.len() - 1;
    let sum = |axis: &str, wheels: [usize; 2]| -> f64 {
        wheels.iter().map(|wheel| tyre(&record, *wheel, axis)[rows]).sum()
    };
    let [mass, along, upwards] = masses();
    let force = -(sum("f1", [1, 2]) + sum("f1", [3, 4]));
    let deceleration = force / mass;
    assert!((3.0..6.0).contains(&deceleration), "{deceleration}");
    let height = upwards + 1200.0 * (last(&record, "car", "z") - 0.55);
    let depths = [3596.0, 3129.0].map(|load| load / 2.2e5);
    let nose_down = last(&record, "angles", "beta");
    let moment = 1200.0 * GRAVITY * 0.24 * nose_down
        + deceleration * height
        + 4.0 * 0.9 * deceleration / 0.31
        + force * (depths[0] + depths[1]) / 3.0;
    let gained = sum("f3", [1, 2]) - along * GRAVITY / SIZES[0];
    close(gained, moment / SIZES[0], 0.01, "weight at the front");
    // In a turn the forces of both directions share the friction.
    let turn = [("parameters.brake", "1500"), ("parameters.steering", "0.6"), ("analysis.end", "4")];
    let record = drive(&turn);
    let mut largest = 0.0_f64;
    for wheel in 1..5 {
        let [along, across, load] = ["f1", "f2", "f3"].map(|axis| tyre(&record, wheel, axis));
        for ((along, across), load) in along.iter().zip(across).zip(load) {
            let used = along.hypot(*across) / load.max(1.0);
            assert!(used < 0.95 + 1e-3, "wheel {wheel}: {used}");
            largest = largest.max(used);
        }
    }
    assert!(largest > 0.9, "{largest}");
    assert!(tyre(&record, 2, "f2").iter().any(|force| *force > 1000.0), "it turns");
}

/// On ice the left wheel pulls with 0.1 N. Both wheels have half of the torque, F R + J α; a locking torque adds to the right and is
/// missing on the left.
#[test]
fn a_differential_pulls_on_one_sided_ice() {
    for locking in [0.0, 100.0] {
        let record = run(
            CAR,
            &[
                ("parameters.driver", "0"),
                ("parameters.speed", "5"),
                ("parameters.gear", "2"),
                ("parameters.cruise", "0"),
                ("signals.throttle", "0.8*smoothstep((t - 1)/0.5)"),
                (
                    "parts.tyre.springs.road.friction_coefficient",
                    "if(index < 3.5, if(index > 2.5, 0.1, 1), 1)",
                ),
                ("parts.drive.parameters.preload", &locking.to_string()),
                ("analysis.end", "1.8"),
            ],
        );
        let rows = record.times.len() - 1;
        let rate = |wheel: usize| column(&record, &format!("corner{wheel}.axle"), "rate");
        let torque = |wheel: usize| {
            let radius = 0.31 + (3129.0 - tyre(&record, wheel, "f3")[rows] / 3.0) / 2.2e5;
            let acceleration =
                (rate(wheel)[rows] - rate(wheel)[rows - 2]) / (record.times[rows] - record.times[rows - 2]);
            tyre(&record, wheel, "f1")[rows] * radius + 0.9 * acceleration
        };
        let [left, right] = [3, 4].map(torque);
        assert!(rate(3)[rows] > 1.3 * rate(4)[rows], "the left wheel spins");
        close(tyre(&record, 3, "f1")[rows], 0.1 * tyre(&record, 3, "f3")[rows], 0.02, "ice");
        assert!((right - left - 2.0 * locking).abs() < 8.0, "{left} {right} {locking}");
    }
}

/// A corner without the car, moved by its lower hinge.
const CORNER: &str = r#"
lissom = 1
inputs.brake = 0
joints.turn = { kind = "prescribed_rotation", joint = "corner.lower_hinge", rotation = "0.02*sin(2*pi*t)" }
springs.axle = { kind = "torsional", joint = "corner.axle", stiffness = 1 }
outputs.hinge = { kind = "relative", of = "corner.lower_hinge" }
analysis = { kind = "statics", steps = 4 }
[joints.rod]
kind = "distance"
base = "ground"
tip = "corner.upright"
at_base = [-0.12, -0.41, -0.052]
at_tip = [-0.12, -0.07, -0.05]
[parts.corner]
include = "lissom:double-wishbone-corner"
names = { chassis = "ground", brake = "brake" }
"#;

/// The body rolls on its springs and bars by φ_s and the car on its tyres by φ_t, K_s φ_s = A (a + g φ) and K_t φ_t = B a + g (A φ_s + B φ_t) with
/// φ their sum. B is the moment of all masses about the road, A that of the body about the roll axis, at the heights T/2 dy/dz of both axles, and
/// of the wheels by their share 1 + T/2 dγ/dz of the roll, γ their camber; both with the gyroscopic moments of the wheels. K is the sum of T²/2 of the stiffness of each wheel,
/// F = S ds/dz + 2 k_bar (dx/dz/arm)² z with the force S of the spring and the height x of the drop link.
#[test]
fn a_car_rolls_by_its_springs_bars_and_tyres() {
    let record = drive(&[("parameters.steering", "0.2"), ("analysis.end", "5")]);
    let speed = last(&record, "velocity", "v1").hypot(last(&record, "velocity", "v2"));
    let acceleration = speed * last(&record, "turn", "w3");
    assert!((1.5..3.5).contains(&acceleration), "{acceleration}");
    let track = SIZES[1];
    // Moment of a spinning wheel in a turn over the lateral acceleration.
    let spin = 0.9 / 0.32;
    let (mut stiffness, mut axis, mut wheels) = (0.0, 0.0, 0.0);
    for (load, diameter, lever) in [("4725", 0.024_f64, 1.2), ("4052", 0.018, 1.4)] {
        let rig = run_without_warnings(CORNER, &[("parts.corner.parameters.load", load)]);
        let at = |output: &str, component: &str| {
            let column = column(&rig, output, component);
            [column[3], column[0], column[1]]
        };
        let [z, force, length, out, camber, angle] = [
            at("corner.travel", "value"),
            at("corner.spring", "force"),
            at("corner.spring", "elongation"),
            at("corner.track", "value"),
            at("corner.camber", "value"),
            at("hinge", "angle"),
        ];
        let slope = |column: [f64; 3], k: usize| (column[k + 1] - column[k]) / (z[k + 1] - z[k]);
        let pushes = [0, 1].map(|k| 0.5 * (force[k] + force[k + 1]) * slope(length, k));
        let spring = (pushes[1] - pushes[0]) / (0.5 * (z[2] - z[0]));
        let link = 0.22 * (angle[2] - angle[0]) / (z[2] - z[0]);
        let bar = 79e9 * PI * diameter.powi(4) / (64.0 * 0.55) / 0.04;
        let wheel = spring + 2.0 * bar * link * link;
        stiffness += 0.5 * track * track * wheel;
        let per_roll = |column: [f64; 3]| 0.5 * track * (column[2] - column[0]) / (z[2] - z[0]);
        axis += per_roll(out) * (SIZES[0] - lever) / SIZES[0];
        wheels += (80.0 * 0.31 + 2.0 * spin) * (1.0 + per_roll(camber));
    }
    let (tyres, all) = (track * track * 2.2e5, masses()[2] + 4.0 * spin);
    let body = 1200.0 * (0.55 - axis) + 11.0 * (0.33 - axis) + wheels;
    let (mut on_springs, mut on_tyres) = (0.0, 0.0);
    for _ in 0..50 {
        on_springs = body / stiffness * (acceleration + GRAVITY * (on_springs + on_tyres));
        on_tyres = (all * acceleration + GRAVITY * (body * on_springs + all * on_tyres)) / tyres;
    }
    close(last(&record, "roll", "value"), on_springs + on_tyres, 0.02, "roll");
}
