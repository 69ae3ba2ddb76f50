//! Equations of motion in joint coordinates against closed forms, and sessions that start with given joint coordinates.

use lissom::{JointCoordinateError, JointDynamics, Model, Prepared};

/// A double pendulum of two uniform bars in a vertical plane, with a torque at each joint; angles from the downward vertical, the
/// second relative to the first.
const DOUBLE_PENDULUM: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]
[inputs]
first = 0.3
second = -0.2
[bodies.upper]
mass = 1.5
inertia = [0.2, 0.12, 0.1]
position = [0, 0, -0.4]
[bodies.lower]
mass = 0.7
inertia = [0.06, 0.05, 0.07]
position = [0, 0, -1.25]
[joints]
shoulder = { kind = "revolute", base = "ground", tip = "upper", at = [0, 0, 0], axis = [0, -1, 0] }
elbow = { kind = "revolute", base = "upper", tip = "lower", at = [0, 0, -0.9], axis = [0, -1, 0] }
[loads]
first = { kind = "joint_torque", joint = "shoulder", torque = "first" }
second = { kind = "joint_torque", joint = "elbow", torque = "2*second" }
wind = { kind = "force", on = "lower", vector = [1.5, 0, 0] }
[springs]
damper = { kind = "torsional", joint = "elbow", damping = 0.4 }
[outputs]
lower = { kind = "position", of = "lower" }
speed = { kind = "velocity", of = "lower" }
support = { kind = "reaction", of = "shoulder" }
[analysis]
kind = "dynamics"
end = 1
step = 1e-3
"#;

const LENGTH: f64 = 0.9;
const CENTERS: [f64; 2] = [0.4, 0.35];
const MASSES: [f64; 2] = [1.5, 0.7];
const INERTIAS: [f64; 2] = [0.12, 0.05];

/// Mass matrix and bias of textbooks, with gravity, wind and the damper.
fn closed_form([a, b]: [f64; 2], [u, v]: [f64; 2]) -> ([[f64; 2]; 2], [f64; 2]) {
    let coupled = MASSES[1] * LENGTH * CENTERS[1];
    let own = INERTIAS[1] + MASSES[1] * CENTERS[1].powi(2);
    let off = own + coupled * b.cos();
    let first = INERTIAS[0]
        + MASSES[0] * CENTERS[0].powi(2)
        + own
        + MASSES[1] * LENGTH.powi(2)
        + 2.0 * coupled * b.cos();
    let second_weight = 9.81 * MASSES[1] * CENTERS[1] * (a + b).sin() - 1.5 * CENTERS[1] * (a + b).cos();
    let weight = 9.81 * (MASSES[0] * CENTERS[0] + MASSES[1] * LENGTH) * a.sin() - 1.5 * LENGTH * a.cos()
        + second_weight;
    let bias = [
        -coupled * b.sin() * (2.0 * u * v + v * v) + weight,
        coupled * b.sin() * u * u + second_weight + 0.4 * v,
    ];
    ([[first, off], [off, own]], bias)
}

fn prepared(text: &str) -> Prepared {
    Model::from_text("model.toml", text).prepare().expect("valid")
}

fn named(values: [f64; 2]) -> Vec<(String, f64)> {
    ["shoulder.angle", "elbow.angle"].map(str::to_owned).into_iter().zip(values).collect()
}

fn assert_close(found: f64, expected: f64, what: &str) {
    assert!(
        (found - expected).abs() < 1e-10 * (1.0 + expected.abs()),
        "{what}: {found} instead of {expected}"
    );
}

#[test]
fn a_double_pendulum_has_the_equations_of_textbooks() {
    let prepared = prepared(DOUBLE_PENDULUM);
    let names = ["shoulder.angle", "elbow.angle"].map(str::to_owned);
    let coordinates = prepared.joint_coordinates(Some(&names)).expect("two degrees of freedom");
    for (angles, rates) in [([0.3, -0.7], [1.2, -2.5]), ([-2.4, 1.9], [0.0, 3.0]), ([0.0, 0.0], [0.0, 0.0])] {
        let session = prepared.session_at(&named(angles), Some(&coordinates), &named(rates)).expect("closed");
        let mut dynamics = JointDynamics::new(&session, coordinates.clone());
        let [found_angles, found_rates] = dynamics.values_and_rates(&session);
        let motion = dynamics.motion(&session).expect("independent");
        let (mass, bias) = closed_form(angles, rates);
        for i in 0..2 {
            assert_close(found_angles[i], angles[i], "angle");
            assert_close(found_rates[i], rates[i], "rate");
            assert_close(motion.bias[i], bias[i], "bias");
            for j in 0..2 {
                assert_close(motion.mass[(i, j)], mass[i][j], "mass");
            }
        }
        // The accelerations of the start are those of the torques that the inputs have.
        let accelerations: Vec<f64> =
            session.state().kinematics.coordinates.iter().map(|own| own.acceleration).collect();
        let layout = session.simulation().system().layout();
        let of = |name: &str| {
            let own = layout.coordinates().find(|&own| layout.coordinate_name(own) == name).expect("known");
            accelerations[own.index()]
        };
        let torques =
            dynamics.inverse_dynamics(&session, &names.each_ref().map(|name| of(name))).expect("independent");
        assert_close(torques[0], 0.3, "torque");
        assert_close(torques[1], -0.4, "torque");
        // Position and velocity have the same Jacobian.
        let [a, b] = angles;
        let along = |angle: f64, length: f64| [length * angle.cos(), 0.0, length * angle.sin()];
        let (upper, lower) = (along(a, LENGTH), along(a + b, CENTERS[1]));
        for output in ["lower", "speed"] {
            let (_, jacobian) = dynamics.jacobian(&session, output).expect("a motion");
            for axis in 0..3 {
                assert_close(jacobian[axis][0], upper[axis] + lower[axis], output);
                assert_close(jacobian[axis][1], lower[axis], output);
            }
        }
    }
}

#[test]
fn requests_without_an_answer_are_refused() {
    let prepared = prepared(DOUBLE_PENDULUM);
    let coordinates = prepared.joint_coordinates(None).expect("two actuators");
    let mut names = coordinates.names().to_vec();
    let session = prepared.session().expect("consistent");
    let mut dynamics = JointDynamics::new(&session, coordinates);
    let refused = dynamics.jacobian(&session, "support").expect_err("no motion");
    assert!(matches!(refused, JointCoordinateError::NoJacobian(_)), "{refused}");
    let refused = dynamics.jacobian(&session, "hand").expect_err("no output");
    assert!(refused.to_string().contains("lower, "), "{refused}");
    names[0] = names[1].clone();
    let twice = prepared.joint_coordinates(Some(&names)).expect("two");
    let refused = JointDynamics::new(&session, twice).motion(&session).expect_err("they are the same");
    assert!(refused.to_string().contains("independently"), "{refused}");
    names.pop();
    let refused = prepared.joint_coordinates(Some(&names)).expect_err("one is missing");
    assert!(refused.to_string().contains("2 degrees of freedom, but 1"), "{refused}");
}

/// A crank and slider: the mass that the crank feels, and a dead point.
const CRANK_AND_SLIDER: &str = r#"
lissom = 1
[bodies]
crank = { mass = 1, inertia = [0.1, 0.1, 0.1], position = [0, 0, 0] }
coupler = { mass = 0.5, inertia = [0.1, 0.2, 0.1], position = [0.75, 0, 0.5] }
slider = { mass = 2, inertia = [0.1, 0.1, 0.1], position = [1.5, 0, 0] }
[joints]
crank = { kind = "revolute", base = "ground", tip = "crank", at = [0, 0, 0], axis = [0, 1, 0] }
pin = { kind = "revolute", base = "crank", tip = "coupler", at = [0, 0, 1], axis = [0, 1, 0] }
wrist = { kind = "spherical", base = "coupler", tip = "slider", at = [1.5, 0, 0] }
rail = { kind = "prismatic", base = "ground", tip = "slider", axis = [1, 0, 0] }
[analysis]
kind = "dynamics"
end = 1
step = 1e-3
"#;

#[test]
fn loops_are_closed_by_their_constraints() {
    let prepared = prepared(CRANK_AND_SLIDER);
    let names = ["crank.angle".to_owned()];
    let coordinates = prepared.joint_coordinates(Some(&names)).expect("one degree of freedom");
    // From the upright crank, a turn about y moves its pin along x.
    let length = 3.25_f64.sqrt();
    for (turn, rate) in [(0.0_f64, 2.0), (0.6, -1.0), (-0.4, 0.5)] {
        let given = |value| vec![(names[0].clone(), value)];
        let session = prepared.session_at(&given(turn), Some(&coordinates), &given(rate)).expect("it closes");
        let mut dynamics = JointDynamics::new(&session, coordinates.clone());
        // x = sin q + L cos p, L sin p = cos q, p the inclination of the coupler.
        let (sine, cosine) = turn.sin_cos();
        let lean = (cosine / length).asin();
        let lean_rate = -sine / (length * lean.cos());
        let slide = cosine - length * lean.sin() * lean_rate;
        let middle = [cosine - 0.5 * length * lean.sin() * lean_rate, -0.5 * sine];
        let mass = 0.1
            + 2.0 * slide.powi(2)
            + 0.2 * lean_rate.powi(2)
            + 0.5 * (middle[0].powi(2) + middle[1].powi(2));
        assert_close(dynamics.motion(&session).expect("independent").mass[(0, 0)], mass, "mass");
        let kinetic = session.simulation().system().energy_of(session.state()).kinetic;
        assert_close(kinetic, 0.5 * mass * rate * rate, "energy");
    }
    // Where crank and coupler are in line, the slider cannot drive.
    let rail =
        prepared.joint_coordinates(Some(&["rail.displacement".to_owned()])).expect("one degree of freedom");
    let in_line = [(names[0].clone(), std::f64::consts::FRAC_PI_2)];
    let session = prepared.session_at(&in_line, None, &[]).expect("it closes");
    let refused = JointDynamics::new(&session, rail).motion(&session).expect_err("a dead point");
    assert!(refused.to_string().contains("rail.displacement"), "{refused}");
}

/// A trunk that floats, with a leg of two parts and a ball beside it.
const FLOATING: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]
[inputs]
hip = 3
knee = -2
[bodies.ball]
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [5, 5, 0]
[bodies.trunk]
mass = 4
inertia = [0.3, 0.2, 0.25]
position = [0.1, -0.2, 1]
center_of_mass = [0.05, 0.02, -0.03]
[bodies.thigh]
mass = 1.2
inertia = [0.05, 0.04, 0.02]
position = [0.3, -0.2, 0.8]
[bodies.shank]
mass = 0.6
inertia = [0.03, 0.03, 0.01]
position = [0.3, -0.2, 0.4]
[joints]
hip = { kind = "revolute", base = "trunk", tip = "thigh", at = [0.3, -0.2, 1], axis = [0, 1, 0.2] }
knee = { kind = "revolute", base = "thigh", tip = "shank", at = [0.3, -0.2, 0.6], axis = [0, 1, 0] }
[loads]
hip = { kind = "joint_torque", joint = "hip", torque = "hip" }
knee = { kind = "joint_torque", joint = "knee", torque = "knee" }
wind = { kind = "force", on = "shank", vector = [1.5, 0, 0.4] }
[outputs]
foot = { kind = "position", of = "shank", point = [0.3, -0.2, 0.2] }
speed = { kind = "velocity", of = "shank", point = [0.3, -0.2, 0.2] }
[analysis]
kind = "dynamics"
end = 1
step = 1e-3
"#;

fn pairs(names: &[String], values: &[f64]) -> Vec<(String, f64)> {
    names.iter().cloned().zip(values.iter().copied()).collect()
}

/// The base has its pose and velocities, energies and Jacobians are those of the rates, and the accelerations of a start are those of
/// the torques, with nothing that holds the base.
#[test]
fn a_base_that_floats_has_six_equations_more() {
    let prepared = prepared(FLOATING);
    let coordinates = prepared.joint_coordinates(None).expect("a base and two joints");
    assert_eq!(coordinates.names(), ["trunk", "hip.angle", "knee.angle"]);
    let (of_values, of_rates) = (coordinates.value_names(), coordinates.rate_names());
    let values = [0.4, -0.3, 2.0, 0.5, -0.5, 0.5, 0.5, 0.7, -0.9];
    let rates = [0.3, -0.2, 0.6, 1.1, -0.4, 0.8, 1.5, -2.0];
    let session = prepared
        .session_at(&pairs(&of_values, &values), Some(&coordinates), &pairs(&of_rates, &rates))
        .expect("it closes");
    let mut dynamics = JointDynamics::new(&session, coordinates.clone());
    let [found, speeds] = dynamics.values_and_rates(&session);
    for (found, given) in found.iter().chain(&speeds).zip(values.iter().chain(&rates)) {
        assert_close(*found, *given, "state");
    }
    let motion = dynamics.motion(&session).expect("independent");
    let (system, state) = (session.simulation().system(), session.state());
    for k in 0..3 {
        assert_close(motion.mass[(k, k)], 5.8, "mass");
    }
    let ball = system.energy_of(state).kinetic;
    let energy: f64 = (0..8)
        .flat_map(|i| (0..8).map(move |j| (i, j)))
        .map(|(i, j)| motion.mass[(i, j)] * rates[i] * rates[j])
        .sum();
    assert_close(0.5 * energy, ball, "energy");

    let trunk =
        system.layout().nodes().find(|&node| system.layout().node_name(node) == "trunk").expect("there");
    let at = &state.kinematics;
    let own = ["hip.angle", "knee.angle"].map(|name| {
        let layout = system.layout();
        let own = layout.coordinates().find(|&own| layout.coordinate_name(own) == name).expect("known");
        at.coordinates[own].acceleration
    });
    let accelerations: Vec<f64> = at.nodes[trunk].acceleration.iter().copied().chain(own).collect();
    let forces = motion.forces(&accelerations);
    for (found, wanted) in forces.iter().zip([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 3.0, -2.0]) {
        assert_close(*found, wanted, "force");
    }
    let (_, of_foot) = dynamics.jacobian(&session, "foot").expect("a motion");
    let (_, of_speed) = dynamics.jacobian(&session, "speed").expect("a motion");
    for (foot, speed) in of_foot.iter().zip(&of_speed) {
        for (foot, speed) in foot.iter().zip(speed) {
            assert_close(*foot, *speed, "Jacobian");
        }
    }
}

/// A joint moves the child and what it carries, and leaves the base and free parts beside it.
#[test]
fn joints_of_a_base_that_floats_leave_it_where_it_is() {
    let prepared = prepared(FLOATING);
    let coordinates = prepared.joint_coordinates(None).expect("a base and two joints");
    let knee = vec![("knee.angle".to_owned(), 0.5)];
    let session = prepared.session_at(&knee, Some(&coordinates), &[]).expect("it closes");
    let (before, after) = (&prepared.state().kinematics, &session.state().kinematics);
    let layout = prepared.system().layout();
    for node in layout.nodes() {
        let moved = (before.nodes[node].frame.position - after.nodes[node].frame.position).norm();
        let is_moved = layout.node_name(node) == "shank";
        assert_eq!(moved > 1e-9, is_moved, "{}: {moved}", layout.node_name(node));
    }
    let lifted = vec![("trunk.z".to_owned(), 3.0)];
    let session = prepared.session_at(&lifted, Some(&coordinates), &[]).expect("it closes");
    for node in layout.nodes() {
        let moved = session.state().kinematics.nodes[node].frame.position - before.nodes[node].frame.position;
        let is_lifted = ["trunk", "thigh", "shank"].contains(&layout.node_name(node));
        assert_close(moved.z, if is_lifted { 2.0 } else { 0.0 }, layout.node_name(node));
    }
    let none: Vec<_> = ["q0", "q1", "q2", "q3"].iter().map(|own| (format!("trunk.{own}"), 0.0)).collect();
    let refused = prepared.session_at(&none, Some(&coordinates), &[]).err().expect("no rotation");
    assert!(refused.to_string().contains("`trunk`"), "{refused}");
    let chosen = ["thigh", "hip.angle", "knee.angle"].map(str::to_owned);
    assert_eq!(prepared.joint_coordinates(Some(&chosen)).expect("another base").names()[0], "thigh");
    assert!(prepared.joint_coordinates(Some(&chosen[1..])).is_err());
}
