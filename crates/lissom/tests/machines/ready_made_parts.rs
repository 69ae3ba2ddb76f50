//! Ready-made parts in small models, against closed forms.

use std::f64::consts::{PI, TAU};

use lissom::Model;
use lissom::analyses::modes::{ModeRequest, modes};
use lissom::model::files::ready_made::PARTS;
use lissom_motion::{Matrix3, Vector3};

use crate::support::runs::{column, last, run, run_without_warnings};

fn close(found: f64, wanted: f64, relative: f64, what: &str) {
    assert!((found - wanted).abs() <= relative * wanted.abs(), "{what}: {found}, not {wanted}");
}

/// The comment of a part lists its names and outputs, and its parameters have comments.
#[test]
fn parts_explain_themselves() {
    for part in PARTS {
        for word in ["\n# names ", "\n# outputs "] {
            assert!(part.text.contains(word), "{}: {word:?}", part.name);
        }
        let (_, parameters) = part.text.split_once("[parameters]\n").unwrap();
        let (parameters, _) = parameters.split_once("\n\n").unwrap();
        // Quantities that follow from others have an expression instead of a comment.
        for line in parameters.lines() {
            assert!(line.contains(" # ") || line.contains(" = \""), "{}: {line}", part.name);
        }
    }
}

/// A shaft J = 0.5 kg m² under a load of 2 N m, brought to 50 rad/s by at most 10 N m.
const DRIVE: &str = r#"
lissom = 1
bodies.rotor = { mass = 4, inertia = [0.5, 0.5, 0.5] }
joints.shaft = { kind = "revolute", base = "ground", tip = "rotor", axis = [0, 0, 1] }
inputs.target = 50
loads.brake = { kind = "joint_torque", joint = "shaft", torque = -2 }
outputs.shaft = { kind = "relative", of = "shaft" }
analysis = { kind = "dynamics", end = 5 }
[parts.drive]
include = "lissom:speed-drive"
names = { shaft = "shaft", reference = "target" }
parameters = { inertia = 0.5, limit = 10, bandwidth = 20, tracking_time = 1e-4 }
"#;

/// At its limit the drive accelerates by a = (10 - 2)/J = 16 rad/s². If the integral follows without delay, the demand
/// k e + I leaves the limit where its rate k e' + k_i e is zero: at e = a k/k_i = 2 a/λ with k = 2 J λ, k_i = J λ². From there
/// J e'' + k e' + k_i e = 0 has the solution e = a (2/λ + τ) exp(-λ τ), which does not overshoot.
#[test]
fn a_speed_drive_reaches_its_reference_without_overshoot() {
    let (acceleration, bandwidth) = (16.0, 20.0);
    let leaves = (50.0 - 2.0 * acceleration / bandwidth) / acceleration;
    let during = run(DRIVE, &[("analysis.end", "3")]);
    close(last(&during, "shaft", "rate"), 3.0 * acceleration, 1e-9, "rate at the limit");
    close(last(&during, "drive.motor", "value"), 10.0, 1e-12, "torque at the limit");
    let after = run(DRIVE, &[("analysis.end", &(leaves + 0.1).to_string())]);
    let wanted = acceleration * (2.0 / bandwidth + 0.1) * (-0.1 * bandwidth).exp();
    close(last(&after, "drive.error", "value"), wanted, 5e-3, "error after the limit");
    let record = run(DRIVE, &[]);
    close(last(&record, "shaft", "rate"), 50.0, 1e-9, "steady rate");
    close(last(&record, "drive.motor", "value"), 2.0, 1e-9, "steady torque");
    close(last(&record, "drive.power", "power"), 100.0, 1e-9, "steady power");
    assert!(column(&record, "shaft", "rate").iter().all(|rate| *rate < 50.0 + 1e-6), "overshoot");
    // The default time of tracking.
    let spread = run(DRIVE, &[("parts.drive.parameters.tracking_time", "0.002")]);
    assert!(column(&spread, "shaft", "rate").iter().all(|rate| *rate < 50.0 + 1e-6), "overshoot");
}

/// A quarter of a car of 300 kg, at a height of the road that is an input.
const QUARTER: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]
bodies.car = { mass = 300, inertia = [10, 10, 10], position = [0, 0, 1.8] }
joints.guide = { kind = "prismatic", base = "ground", tip = "car", axis = [0, 0, 1] }
inputs.road = 1
loads.cargo = { kind = "force", on = "car", vector = [0, 0, -1], scale = 1000 }
outputs.car = { kind = "displacement", of = "car" }
analysis = { kind = "statics", steps = 1 }
[parts.wheel]
include = "lissom:suspended-wheel"
position = [0, 0, 1.31]
names = { chassis = "car", road = "road" }
parameters = { load = "300*9.81", mass = 40, stiffness = 25e3, tyre_stiffness = 200e3, bump = 0.08, stop_stiffness = 5e5, damping = 0 }
"#;

/// A cargo F deflects the suspension by F/k from its preloaded position, and the tyre carries the weight of all. Beyond the bump at b
/// the stop is parallel to the spring: x = b + (W - k b)/(k + k_s) without preload. The frequencies are those of the 2 x 2 problem.
#[test]
fn a_suspended_wheel_deflects_and_oscillates_as_a_quarter_of_a_car() {
    let (sprung, wheel, spring, tyre) = (300.0, 40.0, 25e3, 200e3);
    let weight = 340.0 * 9.81 + 1000.0;
    let record = run(QUARTER, &[]);
    close(last(&record, "wheel.suspension", "displacement"), 1000.0 / spring, 1e-9, "suspension");
    close(last(&record, "wheel.spring", "force"), 300.0 * 9.81 + 1000.0, 1e-9, "spring");
    close(last(&record, "wheel.tyre", "value"), weight, 1e-9, "tyre");
    close(last(&record, "wheel.hub", "z"), 1.31 - weight / tyre, 1e-12, "hub");
    let record = run(QUARTER, &[("parts.wheel.parameters.load", "0")]);
    let beyond = (300.0 * 9.81 + 1000.0 - spring * 0.08) / (spring + 5e5);
    close(last(&record, "wheel.suspension", "displacement"), 0.08 + beyond, 1e-9, "bump");
    close(last(&record, "wheel.stop", "force"), 5e5 * beyond, 1e-9, "stop");
    let model = Model::from_text("quarter.toml", QUARTER).with("loads.cargo.scale", 0.0);
    let report = modes(&model, &ModeRequest::default()).unwrap();
    // det(K - ω² M) = m_s m_w ω⁴ - (m_s (k + k_t) + m_w k) ω² + k k_t.
    let (a, b, c) = (sprung * wheel, sprung * (spring + tyre) + wheel * spring, spring * tyre);
    for (mode, sign) in report.modes.iter().zip([-1.0, 1.0]) {
        let squared = (b + sign * (b * b - 4.0 * a * c).sqrt()) / (2.0 * a);
        close(mode.frequency, squared.sqrt() / TAU, 1e-6, "frequency");
    }
    // Over a hole everything falls, without a pull of the tyre.
    let falls = [
        ("inputs.road", "0"),
        ("loads.cargo.scale", "0"),
        ("parts.wheel.parameters.load", "0"),
        ("analysis", r#"{ kind = "dynamics", end = 0.2 }"#),
    ];
    let record = run(QUARTER, &falls);
    close(last(&record, "car", "u3"), -0.5 * 9.81 * 0.04, 1e-9, "fall");
    assert!(column(&record, "wheel.tyre", "value").iter().all(|force| *force == 0.0));
}

const ROTOR: &str = r#"
lissom = 1
analysis = { kind = "dynamics", end = 1 }
[parts.rotor]
include = "lissom:unbalanced-rotor"
names = { housing = "ground" }
parameters = { density = 1, run_up = 0.3, damping = 2e3 }
"#;

/// The whirl of a rotor without tilt, of a disc m with the unbalance U: U Ω²/|k - m Ω²|, with the compliance 1/k of two bearings
/// 2 (k_b + i Ω c) and of the shaft, L³/(48 E I) by bending and L/(4 κ G A) by shear. Of the shaft's mass 0.3 g are left.
#[test]
fn an_unbalanced_rotor_whirls_by_its_dynamic_stiffness() {
    let (length, diameter, nu, mass, unbalance) = (0.6_f64, 0.025_f64, 0.3, 5.0, 5e-4);
    let kappa = 6.0 * (1.0 + nu) / (7.0 + 6.0 * nu);
    // A flexible shaft below its critical speed, and an almost rigid one in soft bearings above it.
    for (young, bearing, damping, speed) in [(210e9, 1e6, 2e3, 200.0), (2.1e13, 1e5, 500.0, 400.0)] {
        let (inertia, area) = (PI * diameter.powi(4) / 64.0, PI * diameter.powi(2) / 4.0);
        let shear = young / (2.0 * (1.0 + nu)) * kappa * area;
        let shaft = length.powi(3) / (48.0 * young * inertia) + length / (4.0 * shear);
        // 1/(a + i b) = (a - i b)/(a² + b²), twice.
        let (a, b) = (2.0 * bearing, 2.0 * damping * speed);
        let compliance = [shaft + a / (a * a + b * b), -b / (a * a + b * b)];
        let squared = compliance[0].powi(2) + compliance[1].powi(2);
        let dynamic = [compliance[0] / squared - mass * speed * speed, -compliance[1] / squared];
        let wanted = unbalance * speed * speed / dynamic[0].hypot(dynamic[1]);
        let text = |number: f64| number.to_string();
        let record = run(
            ROTOR,
            &[
                ("parts.rotor.parameters.E", &text(young)),
                ("parts.rotor.parameters.stiffness", &text(bearing)),
                ("parts.rotor.parameters.damping", &text(damping)),
                ("parts.rotor.parameters.speed", &text(speed)),
            ],
        );
        let found = last(&record, "rotor.disc", "u2").hypot(last(&record, "rotor.disc", "u3"));
        close(found, wanted, 1e-4, "amplitude");
    }
}

/// A ball that slides freely along y, 5 mm from the middle of the gripper.
const GRIPPER: &str = r#"
lissom = 1
inputs.opening = 0
bodies.hand = { mass = 1, inertia = [1, 1, 1], position = [0, 0, 0.1] }
bodies.ball = { mass = 0.2, inertia = { sphere = 0.02 }, shape = { sphere = 0.02 }, position = [0, 5e-3, 0] }
joints.hand = { kind = "clamp", base = "ground", tip = "hand" }
joints.slide = { kind = "prismatic", base = "ground", tip = "ball", axis = [0, 1, 0], friction = { coulomb = 0.01, viscous = 1 } }
contacts.left = { base = "gripper.left", tip = "ball", stiffness = 1e5, dissipation = 5 }
contacts.right = { base = "gripper.right", tip = "ball", stiffness = 1e5, dissipation = 5 }
outputs.ball = { kind = "position", of = "ball" }
outputs.left = { kind = "contact_force", of = "left" }
outputs.right = { kind = "contact_force", of = "right" }
analysis = { kind = "dynamics", end = 3 }
[parts.gripper]
include = "lissom:parallel-gripper"
names = { hand = "hand", opening = "opening" }
parameters = { grip_force = 5, start = 0.08, bandwidth = 60, stop_damping = 10 }
"#;

/// Each finger presses with the force of the drive on an object of diameter 2 r, which it centres: the gap is 2 r less the penetrations
/// F/k. Without an object the gap approaches the opening as that of a critically damped oscillator, (1 + λ t) exp(-λ t).
#[test]
fn a_parallel_gripper_centres_and_holds_with_its_force() {
    let record = run(GRIPPER, &[]);
    for side in ["left", "right"] {
        // Friction of the slide is all that may remain between them.
        assert!((last(&record, side, "normal") - 5.0).abs() < 0.011, "{side}");
    }
    close(last(&record, "gripper.gap", "value"), 0.04 - 2.0 * 5.0 / 1e5, 1e-4, "gap");
    assert!(last(&record, "ball", "y").abs() < 1e-6);
    close(last(&record, "gripper.drive", "value"), 5.0, 1e-12, "drive");
    let record = run(GRIPPER, &[("inputs.opening", "0.078"), ("analysis.end", "0.05")]);
    let wanted = 0.078 + 0.002 * (1.0 + 3.0) * f64::exp(-3.0);
    close(last(&record, "gripper.gap", "value"), wanted, 1e-6, "opening");
}

/// A mass of 200 kg on a cylinder of piston area A and rod-side area a, with equal forces of both pressures at the start.
const CYLINDER: &str = r#"
lissom = 1
parameters.load = 0
points = { foot = [0, 0, 0], eye = [0.8, 0.6, 0] }
bodies.slide = { mass = 200, inertia = [1, 1, 1], position = [0.8, 0.6, 0] }
joints.guide = { kind = "prismatic", base = "ground", tip = "slide", axis = [0.8, 0.6, 0] }
inputs.valve = 0.5
loads.load = { kind = "joint_force", joint = "guide", force = "-load" }
outputs.guide = { kind = "relative", of = "guide" }
outputs.oil_a = { kind = "signal", of = "oil_a" }
outputs.oil_b = { kind = "signal", of = "oil_b" }
analysis = { kind = "dynamics", end = 0.5 }
states.oil_a = { derivative = "exp(cylinder.pressure_a/1.2e9)*cylinder.flow_a", magnitude = 1e-4 }
states.oil_b = { derivative = "exp(cylinder.pressure_b/1.2e9)*cylinder.flow_b", magnitude = 1e-4 }
[parts.cylinder]
include = "lissom:hydraulic-cylinder"
names = { base = "ground", tip = "slide", foot = "foot", eye = "eye", command = "valve" }
parameters = { start_a = 2e6, start_b = 3.125e6, friction = 2e3, stroke = 0.4, extension = 0.15 }
"#;

/// With p_A = p_s - (A v/k)², p_B = p_T + (a v/k)² and A p_A - a p_B = F the speed is v = k ((A p_s - a p_T - F)/(A³ + a³))^½,
/// k the flow per root of the drop. The oil in a volume V is conserved: the integral of e^(p/E) q is the change of V e^(p/E).
/// At the end of the stroke the force is A p_s - a p_T or its counterpart, and what leaks flows through the valve. With a closed valve
/// the oil is a spring, E (A²/V_A + a²/V_B).
#[test]
fn a_hydraulic_cylinder_moves_stalls_and_oscillates() {
    let (piston, rod_side) = (PI * 0.05_f64.powi(2) / 4.0, PI * (0.05_f64.powi(2) - 0.03_f64.powi(2)) / 4.0);
    let [supply, tank, bulk] = [160e5, 2e5, 1.2e9];
    let flow = 5e-4 / 35e5_f64.sqrt();
    let volumes = |moved: f64| [1e-4 + piston * (0.15 + moved), 1e-4 + rod_side * (0.25 - moved)];
    for load in [0.0, 1e4] {
        let record = run_without_warnings(CYLINDER, &[("parameters.load", &load.to_string())]);
        let speed = last(&record, "guide", "velocity");
        let force = load + 2e3 * speed;
        let squared = (piston * supply - rod_side * tank - force) / (piston.powi(3) + rod_side.powi(3));
        close(speed, 0.5 * flow * squared.sqrt(), 1e-4, "speed");
        let [before, after] = [0.0, last(&record, "cylinder.rod", "displacement")].map(volumes);
        for (index, (side, start)) in [("a", 2e6), ("b", 3.125e6)].into_iter().enumerate() {
            let pressure = last(&record, &format!("cylinder.pressure_{side}"), "value");
            let oil = after[index] * (pressure / bulk).exp() - before[index] * f64::exp(start / bulk);
            close(last(&record, &format!("oil_{side}"), "value"), oil, 1e-6, side);
        }
    }
    let stalls =
        [("1", piston * supply - rod_side * tank, 0.25), ("-1", piston * tank - rod_side * supply, -0.15)];
    for (valve, force, end) in stalls {
        let record = run(CYLINDER, &[("inputs.valve", valve), ("analysis.end", "4")]);
        close(last(&record, "cylinder.force", "value"), force, 1e-6, "stall");
        close(last(&record, "cylinder.rod", "displacement"), end + force / 2e8, 1e-6, "end of the stroke");
    }
    let leaks =
        [("inputs.valve", "1"), ("analysis.end", "4"), ("parts.cylinder.parameters.leakage", "1e-11")];
    let record = run(CYLINDER, &leaks);
    let of = |name: &str| last(&record, &format!("cylinder.{name}"), "value");
    let leak = 1e-11 * (of("pressure_a") - of("pressure_b"));
    close(of("flow_a"), leak, 1e-6, "leak");
    close(of("flow_b"), -leak, 1e-6, "leak");
    let model = Model::from_text("cylinder.toml", CYLINDER)
        .with("inputs.valve", 0.0)
        .with("parts.cylinder.parameters.friction", 0.0);
    let report = modes(&model, &ModeRequest::default()).unwrap();
    let [a, b] = volumes(0.0);
    let stiffness = bulk * (piston.powi(2) / a + rod_side.powi(2) / b);
    let frequency = report.modes.last().unwrap().frequency;
    close(frequency, (stiffness / 200.0).sqrt() / TAU, 1e-6, "spring of the oil");
}

/// A fan of 0.01 kg m² with a pulley of 0.1 m, driven by one of 0.05 m at a distance of 0.4 m.
const BELT: &str = r#"
lissom = 1
bodies.motor = { mass = 1, inertia = [0.01, 0.01, 0.01] }
bodies.fan = { mass = 1, inertia = [0.01, 0.01, 0.01], position = [0.4, 0, 0] }
joints.motor = { kind = "revolute", base = "ground", tip = "motor", axis = [0, 0, 1] }
joints.fan = { kind = "revolute", base = "ground", tip = "fan", axis = [0, 0, 1] }
joints.speed = { kind = "prescribed_rotation", joint = "motor", rotation = "10*t^3/(t^2 + 1)" }
loads.brake = { kind = "joint_torque", joint = "fan", torque = "-10*smoothstep(t) - 20*smoothstep(5*(t - 2))" }
outputs.motor = { kind = "relative", of = "motor" }
outputs.fan = { kind = "relative", of = "fan" }
outputs.acceleration = { kind = "relative_acceleration", of = "fan" }
analysis = { kind = "dynamics", end = 2 }
[parts.belt]
include = "lissom:belt-drive"
names = { driver = "motor", driven = "fan" }
parameters = { pretension = 200, friction = 0.5, axial_stiffness = 2e5 }
"#;

/// Below the limit the rates have the ratio of the radii. The elongation of the belt follows from its stiffness k (1 - F/F_l) with two
/// runs side by side, x = -(F_l/k) ln(1 - F/F_l). Beyond the limit 2 F₀ (e^(μα) - 1)/(e^(μα) + 1) the fan accelerates by the
/// difference of limit and brake.
#[test]
fn a_belt_transmits_stretches_and_slips() {
    let wrap = PI - 2.0 * (0.05_f64 / 0.4).asin();
    let grip = (0.5 * wrap).exp();
    let limit = 2.0 * 200.0 * (grip - 1.0) / (grip + 1.0);
    let still = [("joints.speed.rotation", "0")];
    let record = run(BELT, &still);
    close(last(&record, "belt.force", "force"), 100.0, 1e-4, "force");
    let stiffness = 2.0 * 2e5 / (0.4_f64.powi(2) - 0.05_f64.powi(2)).sqrt();
    let elongation = -limit / stiffness * (1.0 - 100.0 / limit).ln();
    close(last(&record, "belt.slip", "value"), elongation, 1e-3, "elongation");
    let record = run(BELT, &[]);
    // The driver still accelerates a little: its rate follows from the rotation.
    close(last(&record, "fan", "rate"), 0.5 * last(&record, "motor", "rate"), 1e-4, "rate");
    let torque = 10.0 + 0.01 * last(&record, "acceleration", "a1");
    close(last(&record, "belt.torque", "value"), torque, 1e-6, "torque");
    let record = run(BELT, &[("analysis.end", "2.5")]);
    close(last(&record, "belt.force", "force"), limit, 1e-5, "limit");
    close(last(&record, "acceleration", "a1"), (0.1 * limit - 30.0) / 0.01, 1e-4, "deceleration");
}

/// Zero of a function between two arguments of different signs.
fn zero(function: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> f64 {
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if function(low) * function(middle) <= 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    0.5 * (low + high)
}

/// Two uprights on vertical kingpins 0.12 m ahead of the ends of the tie rods, with a moment on each.
const STEERING: &str = r#"
lissom = 1
inputs.wheel = 1.5
bodies.left = { mass = 10, inertia = [1, 1, 1], position = [0.12, 0.7, 0] }
bodies.right = { mass = 10, inertia = [1, 1, 1], position = [0.12, -0.7, 0] }
joints.left = { kind = "revolute", base = "ground", tip = "left", axis = [0, 0, 1] }
joints.right = { kind = "revolute", base = "ground", tip = "right", axis = [0, 0, 1] }
loads.left = { kind = "joint_torque", joint = "left", torque = -30 }
loads.right = { kind = "joint_torque", joint = "right", torque = -10 }
outputs.left = { kind = "relative", of = "left" }
outputs.right = { kind = "relative", of = "right" }
analysis = { kind = "statics", steps = 10 }
[parts.steering]
include = "lissom:steering-rack"
names = { chassis = "ground", left = "left", right = "right", steering = "wheel" }
parameters = { radius = -8e-3, outer = 0.66, outer_z = 0.01 }
"#;

/// The length of a tie rod determines the angle of its upright over the displacement of the rack; virtual work the torque of the driver, and
/// the column is twisted by it.
#[test]
fn a_steering_rack_steers_by_its_triangles_and_carries_moments_to_the_driver() {
    let record = run_without_warnings(STEERING, &[]);
    let [inner, outer, arm] = [0.35_f64, 0.66, 0.12];
    let length = (outer - inner).hypot(0.01);
    // The end of the tie rod of the side, relative to the kingpin at (arm, 0.7 side), turned by the angle.
    let angle = |side: f64, rack: f64| {
        let own = |angle: f64| {
            let (sine, cosine) = angle.sin_cos();
            let (x, y) = (-arm, side * (outer - 0.7));
            let end = [arm + x * cosine - y * sine, side * 0.7 + x * sine + y * cosine];
            end[0].hypot(end[1] - side * inner - rack).hypot(0.01) - length
        };
        zero(own, [-0.3, 0.3])
    };
    let rack = last(&record, "steering.rack", "displacement");
    assert!(rack < -0.01, "{rack}");
    let step = 1e-5;
    let mut torque = 0.0;
    for (name, side, moment) in [("left", 1.0, -30.0), ("right", -1.0, -10.0)] {
        let found = last(&record, name, "angle");
        assert!(found > 0.08, "to the left: {found}");
        close(found, angle(side, rack), 1e-9, name);
        let slope = (angle(side, rack + step) - angle(side, rack - step)) / (2.0 * step);
        torque -= moment * slope * -8e-3;
        // The rod's force about the kingpin.
        let [fx, fy] = ["f1", "f2"].map(|axis| last(&record, &format!("steering.{name}_rod"), axis));
        let (sine, cosine) = found.sin_cos();
        let (x, y) = (-arm, side * (outer - 0.7));
        let own = (x * cosine - y * sine) * fy - (x * sine + y * cosine) * fx;
        close(own, -moment, 1e-9, name);
    }
    close(last(&record, "steering.torque", "value"), torque, 1e-6, "torque of the driver");
    close(rack, -8e-3 * (1.5 - torque / 1000.0), 1e-9, "twist of the column");
}

/// Two bodies on vertical slides with springs, at the lower ends of the drop links.
const BAR: &str = r#"
lissom = 1
bodies.left = { mass = 10, inertia = [1, 1, 1], position = [0.2, 0.45, -0.15] }
bodies.right = { mass = 10, inertia = [1, 1, 1], position = [0.2, -0.45, -0.15] }
joints.left = { kind = "prismatic", base = "ground", tip = "left", axis = [0, 0, 1] }
joints.right = { kind = "prismatic", base = "ground", tip = "right", axis = [0, 0, 1] }
springs.left = { kind = "axial", joint = "left", stiffness = 2e4 }
springs.right = { kind = "axial", joint = "right", stiffness = 2e4 }
parameters = { left = 800, right = -800 }
loads.left = { kind = "joint_force", joint = "left", force = "left" }
loads.right = { kind = "joint_force", joint = "right", force = "right" }
outputs.left = { kind = "relative", of = "left" }
outputs.right = { kind = "relative", of = "right" }
analysis = { kind = "statics", steps = 5 }
[parts.bar]
include = "lissom:anti-roll-bar"
names = { chassis = "ground", left_end = "left", right_end = "right" }
"#;

/// Equal loads deflect the springs alone. Opposite ones work against both: F = k_s z + dV/dz with V = k φ²/2, φ the difference of the
/// angles at which the links have their length; for small deflections F = (k_s + 2 k/a²) z.
#[test]
fn an_anti_roll_bar_resists_roll_and_not_heave() {
    let (arm, link) = (0.2_f64, 0.15);
    let stiffness = 79e9 * PI * 0.022_f64.powi(4) / 32.0 / 0.9;
    let angle = |height: f64| {
        let gap = |angle: f64| (arm * (angle.cos() - 1.0)).hypot(arm * angle.sin() + link - height) - link;
        zero(gap, [-0.5, 0.5])
    };
    for arm_sign in ["0.2", "-0.2"] {
        let mirrored = [
            ("parts.bar.parameters.arm", arm_sign),
            ("parts.bar.position", if arm_sign == "0.2" { "[0, 0, 0]" } else { "[0.4, 0, 0]" }),
        ];
        let heave = [mirrored[0], mirrored[1], ("parameters.right", "800")];
        let record = run_without_warnings(BAR, &heave);
        close(last(&record, "left", "displacement"), 0.04, 1e-9, "heave");
        assert!(last(&record, "bar.bar", "value").abs() < 1e-9, "no torque in heave");
        let record = run_without_warnings(BAR, &mirrored);
        let [left, right] = ["left", "right"].map(|name| last(&record, name, "displacement"));
        let twist = angle(left) - angle(right);
        close(last(&record, "bar.bar", "value"), stiffness * twist, 1e-7, "torque");
        let step = 1e-6;
        for (height, load) in [(left, 800.0), (right, -800.0)] {
            let slope = (angle(height + step) - angle(height - step)) / (2.0 * step);
            let torque = stiffness * twist * if load > 0.0 { slope } else { -slope };
            close(2e4 * height + torque, load, 1e-5, "equilibrium");
        }
        close(left, 800.0 / (2e4 + 2.0 * stiffness / arm.powi(2)), 5e-3, "small angles");
    }
}

/// Wheels of 0.5 and 2 kg m² on a shaft with 100 N m.
const DIFFERENTIAL: &str = r#"
lissom = 1
bodies.left = { mass = 10, inertia = [0.5, 0.5, 0.5], position = [0, 0.7, 0] }
bodies.right = { mass = 10, inertia = [2, 2, 2], position = [0, -0.7, 0] }
joints.left = { kind = "revolute", base = "ground", tip = "left", axis = [0, 1, 0], rate = 4 }
joints.right = { kind = "revolute", base = "ground", tip = "right", axis = [0, 1, 0], rate = 4 }
loads.shaft = { kind = "joint_torque", joint = "gears.shaft", torque = 100 }
outputs.left = { kind = "relative", of = "left" }
outputs.right = { kind = "relative", of = "right" }
analysis = { kind = "dynamics", end = 2, scheme = "radau-iia-5" }
[parts.gears]
include = "lissom:differential"
names = { left = "left", right = "right" }
parameters = { inertia = 0.05, rate = 14 }
"#;

/// Open: both wheels have half of n λ, with λ = T/(1 + J n²/4 (1/J₁ + 1/J₂)). With a locking torque that suffices both accelerate by
/// n T/(J₁ + J₂ + n² J), for which the slower one needs L = (J₂ - J₁)/2 of that; c Δ and L₀ tanh(Δ/w) are this torque.
#[test]
fn a_differential_halves_the_torque_or_locks() {
    let (ratio, shaft, left, right, torque) = (3.5, 0.05, 0.5, 2.0, 100.0);
    let record = run_without_warnings(DIFFERENTIAL, &[]);
    let passed = torque / (1.0 + shaft * ratio * ratio / 4.0 * (1.0 / left + 1.0 / right));
    let rates = ["left", "right"].map(|name| last(&record, name, "rate"));
    for (k, inertia) in [left, right].into_iter().enumerate() {
        close(rates[k], 4.0 + ratio * passed / 2.0 / inertia * 2.0, 1e-9, "rate");
        let moment = last(&record, "gears.torques", &format!("moment{}", k + 2));
        close(moment, ratio * passed / 2.0, 1e-9, "half of the torque");
    }
    close(last(&record, "gears.torques", "moment1"), -passed, 1e-9, "torque of the shaft");
    close(last(&record, "gears.shaft", "rate"), ratio / 2.0 * (rates[0] + rates[1]), 1e-12, "mean");
    let together = ratio * torque / (left + right + ratio * ratio * shaft);
    let locking = (right - left) / 2.0 * together;
    let laws = [("damping", "20", locking / 20.0), ("preload", "120", 0.1 * (locking / 120.0_f64).atanh())];
    for (parameter, value, difference) in laws {
        let record =
            run_without_warnings(DIFFERENTIAL, &[(&format!("parts.gears.parameters.{parameter}"), value)]);
        let [fast, slow] = ["left", "right"].map(|name| last(&record, name, "rate"));
        close(fast - slow, difference, 1e-6, parameter);
        close(last(&record, "gears.locking", "value"), locking, 1e-6, parameter);
        let momentum = left * fast + right * slow + ratio * shaft * last(&record, "gears.shaft", "rate");
        let wanted = 4.0 * (left + right + ratio * ratio * shaft) + ratio * torque * 2.0;
        close(momentum, wanted, 1e-9, "momentum");
    }
}

/// Two wheels of 40 kg m² in all, as of a car, and the engine of the defaults.
const DRIVELINE: &str = r#"
lissom = 1
inputs = { throttle = 1, clutch = 1, gear = 2 }
bodies.left = { mass = 10, inertia = [50, 50, 50], position = [0, 0.7, 0] }
bodies.right = { mass = 10, inertia = [50, 50, 50], position = [0, -0.7, 0] }
joints.left = { kind = "revolute", base = "ground", tip = "left", axis = [0, 1, 0] }
joints.right = { kind = "revolute", base = "ground", tip = "right", axis = [0, 1, 0] }
outputs.left = { kind = "relative", of = "left" }
outputs.right = { kind = "relative", of = "right" }
analysis = { kind = "dynamics", end = 1, scheme = "radau-iia-5" }
[parts.drive]
include = "lissom:driveline"
names = { left = "left", right = "right", throttle = "throttle", clutch = "clutch", gear = "gear" }
"#;

/// Up to its largest torque T at ω_p the engine has 0.6 T + 0.4 T ω/ω_p: ω = 1.5 ω_p (exp(λ t) - 1), λ = 0.4 T/(ω_p J) with
/// J = J_e + J_s/g² + 2 J_w/(g n)². The clutch transmits (J - J_e) ω' and slips by w artanh of it over its capacity. Without throttle and clutch
/// ω decays by c/J_e; beyond the rated rate it ends where full load is zero.
#[test]
fn a_driveline_accelerates_by_its_full_load_and_coasts_by_its_drag() {
    let (torque, peak, engine, gear, last_ratio) = (250.0_f64, 250.0, 0.15, 2.0, 3.5);
    let record = run_without_warnings(DRIVELINE, &[]);
    let other = 0.02 / (gear * gear) + 2.0 * 50.0 / (gear * gear * last_ratio * last_ratio);
    let growth = 0.4 * torque / (peak * (engine + other));
    let rate = last(&record, "drive.engine", "rate");
    let passed = other * 1.5 * peak * growth * growth.exp();
    close(last(&record, "drive.clutch_torque", "value"), passed, 2e-3, "clutch");
    let slip = rate - gear * last_ratio * last(&record, "left", "rate");
    close(slip, 0.5 * (passed / 500.0).atanh(), 5e-3, "slip of the clutch");
    // Without the slip both would have the rate of their common momentum.
    let common = rate - slip * other / (engine + other);
    close(common, 1.5 * peak * (growth.exp() - 1.0), 5e-4, "rate of the engine");
    close(last(&record, "left", "rate"), last(&record, "right", "rate"), 1e-9, "both wheels");
    close(last(&record, "drive.power", "value"), torque * (0.6 + 0.4 * rate / peak) * rate, 1e-9, "power");
    let coasting = [
        ("inputs.throttle", "0"),
        ("inputs.clutch", "0"),
        ("parts.drive.parameters.rate", "300"),
        ("parts.drive.parameters.shaft_rate", "0"),
    ];
    let record = run_without_warnings(DRIVELINE, &coasting);
    close(last(&record, "drive.engine", "rate"), 300.0 * f64::exp(-0.1 / engine), 1e-6, "coasting");
    let racing = [("inputs.clutch", "0"), ("analysis.end", "5")];
    close(last(&run(DRIVELINE, &racing), "drive.engine", "rate"), 650.0, 1e-6, "racing");
}

/// A corner whose lower wishbone turns from 0.25 rad below to 0.25 rad above its position, with a rod for its steering.
const CORNER: &str = r#"
lissom = 1
inputs.brake = 0
joints.turn = { kind = "prescribed_rotation", joint = "corner.lower_hinge", rotation = "side*0.25*sin(2*pi*t)" }
springs.axle = { kind = "torsional", joint = "corner.axle", stiffness = 1 }
outputs.hinge = { kind = "relative", of = "corner.lower_hinge" }
analysis = { kind = "statics", steps = 40 }
parameters.side = 1
[joints.rod]
kind = "distance"
base = "ground"
tip = "corner.upright"
at_base = [-0.12, "-side*0.43", -0.04]
at_tip = [-0.13, "-side*0.07", -0.05]
[parts.corner]
include = "lissom:double-wishbone-corner"
names = { chassis = "ground", brake = "brake" }
parameters = { side = "side" }
"#;

/// A point at the given distances from three others, on the side of the first guess.
fn trilaterate(centres: [Vector3; 3], distances: [f64; 3], near: Vector3) -> Vector3 {
    let [origin, second, third] = centres;
    let first_axis = (second - origin).normalize();
    let along = first_axis.dot(&(third - origin));
    let across = third - origin - first_axis * along;
    let (second_axis, width) = (across.normalize(), across.norm());
    let length = (second - origin).norm();
    let [a, b, c] = distances.map(|distance| distance * distance);
    let x = (a - b + length * length) / (2.0 * length);
    let y = (a - c + along * along + width * width - 2.0 * along * x) / (2.0 * width);
    let third_axis = first_axis.cross(&second_axis);
    let z = (a - x * x - y * y).sqrt() * third_axis.dot(&(near - origin)).signum();
    origin + first_axis * x + second_axis * y + third_axis * z
}

/// Orthonormal axes of a triangle.
fn axes(points: [Vector3; 3]) -> Matrix3 {
    let first = (points[1] - points[0]).normalize();
    let normal = first.cross(&(points[2] - points[0])).normalize();
    Matrix3::from_columns(&[first, normal, normal.cross(&first)])
}

/// The upper ball joint is at given distances from the lower one and from two points of its hinge; the end of the rod from both and from its
/// inner end. These three points move the wheel. The right side is the mirror image of the left one.
#[test]
fn a_double_wishbone_moves_its_wheel_as_its_spheres_meet() {
    let left = run_without_warnings(CORNER, &[]);
    let right = run_without_warnings(CORNER, &[("parameters.side", "-1")]);
    let [lower_inner, lower, upper_inner, upper, rod_inner, rod, centre] = [
        [0.0, -0.42, -0.11],
        [0.005, -0.06, -0.12],
        [0.0, -0.38, 0.12],
        [-0.015, -0.10, 0.15],
        [-0.12, -0.43, -0.04],
        [-0.13, -0.07, -0.05],
        [0.0, 0.0, 0.0],
    ]
    .map(Vector3::from);
    let (spring_top, seat) = (Vector3::new(0.0, -0.30, 0.35), Vector3::new(0.0, -0.15, -0.1175));
    let ahead = Vector3::new(0.2, 0.0, 0.0);
    let start = axes([lower, upper, rod]);
    let mut largest = [0.0_f64; 4];
    for (row, angle) in column(&left, "hinge", "angle").iter().enumerate() {
        let turned = |point: Vector3| {
            let (sine, cosine) = angle.sin_cos();
            let arm = point - lower_inner;
            lower_inner + Vector3::new(arm.x, arm.y * cosine - arm.z * sine, arm.y * sine + arm.z * cosine)
        };
        let ball = turned(lower);
        let hinge = [upper_inner - ahead, upper_inner + ahead];
        let top = trilaterate(
            [ball, hinge[0], hinge[1]],
            [lower, hinge[0], hinge[1]].map(|point| (upper - point).norm()),
            upper,
        );
        let end = trilaterate(
            [ball, top, rod_inner],
            [lower, upper, rod_inner].map(|point| (rod - point).norm()),
            rod,
        );
        let rotation = axes([ball, top, end]) * start.transpose();
        let hub = ball + rotation * (centre - lower);
        let axle = rotation.column(1);
        // The lowest point of a wheel: from its centre against z without the part along the axle.
        let down = (axle * axle.z - Vector3::z()).normalize();
        let wanted = [
            ("travel", hub.z),
            ("camber", -axle.z.asin()),
            ("toe", (axle.x / axle.y).atan()),
            ("track", hub.y + 0.31 * down.y),
        ];
        for (k, (name, wanted)) in wanted.into_iter().enumerate() {
            let name = format!("corner.{name}");
            let [left, right] = [&left, &right].map(|record| column(record, &name, "value")[row]);
            assert!((left - wanted).abs() < 1e-9, "{name} at {angle}: {left}, not {wanted}");
            assert!(
                (right - left).abs() < 1e-9,
                "{name} at {angle}: {right} on the right, {left} on the left"
            );
            largest[k] = largest[k].max(wanted.abs());
        }
        let length = (spring_top - turned(seat)).norm() - (spring_top - seat).norm();
        let force = column(&left, "corner.spring", "force")[row];
        assert!((force - (-5000.0 + 45e3 * length)).abs() < 1e-5, "{force}");
    }
    assert!(largest[0] > 0.08 && largest[1] > 0.02 && largest[2] > 1e-3 && largest[3] > 1e-3, "{largest:?}");
}
