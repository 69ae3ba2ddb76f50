use lissom_motion::{Motion, Rotation, Vector3, Vector6};

use super::{Axes, Departure, Spin, Spins};
use crate::kinematics::{Kinematics, NodeId, NodeMotion, Rotor, Triple};

const AXIS: [f64; 3] = [0.6, 0.0, 0.8];

fn ground() -> NodeMotion {
    NodeMotion { frame: Motion::identity(), twist: Vector6::zeros(), acceleration: Vector6::zeros() }
}

fn spins() -> Spins {
    let rotor = Rotor {
        node: NodeId::first(2).nth(1).unwrap(),
        axis: Vector3::from(AXIS),
        first: Rotation::exponential(&Vector3::new(0.3, -0.2, 0.5)),
        triples: vec![Triple { first_multiplier: 2, axis: Vector3::z() }],
    };
    let spin = Spin {
        rows: [0, 1, 2, 3, 4, 5],
        triples: vec![8],
        rotor,
        angle: 0.0,
        rate: 0.0,
        frame: Motion::identity(),
        still: ground(),
        of_tangent: 0.0,
        is_complete: true,
        is_still: true,
    };
    Spins { all: vec![spin], first_multiplier: 6 }
}

/// A node that spins at 40 rad/s about the axis.
fn start() -> Kinematics {
    let node = NodeMotion {
        frame: Motion::new(Rotation::exponential(&Vector3::new(0.5, 0.1, 0.2)), Vector3::new(1.0, 2.0, -1.0)),
        twist: Vector6::new(3.0, -1.0, 2.0, 24.1, -0.2, 32.0),
        acceleration: Vector6::new(0.4, 2.0, -1.0, 3.0, 1.0, -2.0),
    };
    Kinematics {
        time: 0.0,
        elapsed: 0.0,
        nodes: vec![ground(), node],
        coordinates: Vec::new(),
        held: Vec::new(),
        multipliers: Vec::new(),
        units: Vec::new(),
    }
}

/// Coefficients of powers of time in y.
fn departure(time: f64, curvature: &Vector6) -> Departure {
    let further = Vector6::new(0.3, -0.2, 0.5, 0.4, -0.1, 0.2);
    Departure {
        place: 0.5 * time * time * curvature + time.powi(3) * further,
        rate: time * curvature + 3.0 * time * time * further,
        curvature: curvature + 6.0 * time * further,
    }
}

#[test]
fn twist_and_acceleration_are_derivatives_of_the_place() {
    let (mut spins, at) = (spins(), start());
    spins.begin(&at, 0.1);
    let spin = spins.iter().next().unwrap();
    let from = &at.nodes[spin.node()];
    let curvature = *spin.start_curvature();
    let motion = |time: f64| spin.depart(time, &departure(time, &curvature)).0;
    let step = 1e-4;
    for time in [0.0, 0.03, 0.11, 0.4] {
        let [before, here, after] = [time - step, time, time + step].map(motion);
        let twist = (before.frame.inverse() * after.frame).logarithm() / (2.0 * step);
        assert!((twist - here.twist).norm() < 2e-4 * here.twist.norm(), "{time}: {twist} {}", here.twist);
        let acceleration = (after.twist - before.twist) / (2.0 * step);
        let error = (acceleration - here.acceleration).norm() / here.acceleration.norm();
        assert!(error < 1e-4, "{time}: {acceleration} {}", here.acceleration);
    }
    let begun = motion(0.0);
    assert!((begun.acceleration - from.acceleration).norm() < 1e-12, "{}", begun.acceleration);
    assert!((begun.twist - from.twist).norm() < 1e-12, "{}", begun.twist);
}

#[test]
fn components_turn_with_the_axes_in_which_they_are() {
    let (mut spins, at) = (spins(), start());
    spins.begin(&at, 0.1);
    spins.note_tangent(0.2);
    let given: Vec<f64> = (0..11).map(f64::from).collect();
    let mut values = given.clone();
    spins.turn(&mut values, [Axes::Body(0.1), Axes::Tangent]);
    let along = |values: &[f64]| Vector3::from(AXIS).dot(&Vector3::from_column_slice(&values[..3]));
    assert!((along(&values) - along(&given)).abs() < 1e-12);
    assert!((values[10] - given[10]).abs() < 1e-12, "the third axis of the joint is that of the rotor");
    assert_ne!(values[8], given[8]);
    assert_eq!(values[6..8], given[6..8], "other equations");
    spins.turn(&mut values, [Axes::Tangent, Axes::Still]);
    spins.turn(&mut values, [Axes::Still, Axes::Body(0.1)]);
    assert!(values.iter().zip(&given).all(|(one, other)| (one - other).abs() < 1e-12), "{values:?}");
    // A turn by the angle of the drift between two instants.
    let mut force = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    spins.turn(&mut force, [Axes::Body(0.0), Axes::Body(0.01)]);
    let rate = Vector3::from(AXIS).dot(&Vector3::new(24.1, -0.2, 32.0));
    let turned = Rotation::about_axis(&Vector3::from(AXIS), -0.01 * rate).apply(&Vector3::x());
    assert!((Vector3::from_column_slice(&force[..3]) - turned).norm() < 1e-12);
}

#[test]
fn an_omitted_equation_makes_a_rotor_an_ordinary_node_from_the_next_step_on() {
    let (mut spins, at) = (spins(), start());
    spins.begin(&at, 0.1);
    spins.omit(&[9]);
    assert_eq!(spins.iter().count(), 1);
    let mut values: Vec<f64> = (0..11).map(f64::from).collect();
    spins.turn(&mut values, [Axes::Body(0.1), Axes::Still]);
    assert_eq!(values[8..], [8.0, 9.0, 10.0]);
    spins.begin(&at, 0.1);
    assert_eq!(spins.iter().count(), 0);
    spins.omit(&[]);
    spins.begin(&at, 0.1);
    assert_eq!(spins.iter().count(), 1);
}

#[test]
fn derivatives_are_those_of_the_chart() {
    let (mut spins, at) = (spins(), start());
    spins.begin(&at, 0.1);
    let (time, step) = (0.13, 1e-6);
    let mut drifts = Vec::new();
    spins.write_drifts(time, &mut drifts);
    let [of_velocity, of_acceleration, of_place] = drifts[0].matrices();
    let spin = spins.iter().next().unwrap();
    let one = nalgebra::Matrix6::identity();
    let expected = [[of_velocity, of_place], [one, of_acceleration], [nalgebra::Matrix6::zeros(), one]];
    for (order, expected) in expected.iter().enumerate() {
        for k in 0..6 {
            let own = spin.rotor.turned(spin.angle_after(time), &Vector6::ith(k, step));
            let moved = |sign: f64| {
                let mut all = [Vector6::zeros(); 3];
                all[order] = sign * own;
                let [place, rate, curvature] = all;
                spin.depart(time, &Departure { place, rate, curvature }).0
            };
            let [before, after] = [-1.0, 1.0].map(moved);
            let found = [after.twist - before.twist, after.acceleration - before.acceleration];
            for (found, expected) in found.iter().zip(expected) {
                let error = (found / (2.0 * step) - expected.column(k)).norm();
                assert!(error < 1e-5 * (1.0 + expected.norm()), "{order} {k}: {error}");
            }
        }
    }
}
