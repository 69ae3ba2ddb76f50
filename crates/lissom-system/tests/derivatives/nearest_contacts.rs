//! Contacts of curves where they are nearest: derivatives and energy, within an interval and between two.

use std::sync::Arc;

use lissom_contact::nearest::{CarriedCurve, CarriedPoint, NearestContact};
use lissom_contact::reading::ContactElement;
use lissom_mechanics::compliance::Compliance;
use lissom_mechanics::elements::{Contribution, Element};
use lissom_mechanics::joints::centerline::Centerline;
use lissom_mechanics::kinematics::{Freedoms, GROUND};
use lissom_motion::Vector3;
use lissom_system::{Builder, State, System};

use crate::derivatives::check;
use crate::derivatives::configuration::{Configuration, Random, difference};

/// Sum of the radii.
const RADIUS: f64 = 20.0;

/// Nodes of a curved line near a point, whose frames have other origins.
fn line(
    builder: &mut Builder,
    name: &str,
    (middle, direction): (Vector3, Vector3),
    random: &mut Random,
) -> (Arc<Centerline>, Vec<CarriedPoint>) {
    let knots = vec![0.0, 11.0, 20.0, 32.0, 40.0, 51.0, 60.0];
    let points = knots.iter().enumerate().map(|(k, s)| {
        let place = middle + (s - 27.0) * direction + 0.3 * random.vector();
        let mut frame = random.motion();
        let offset = if k % 2 == 0 { 0.4 * random.vector() } else { Vector3::zeros() };
        frame.position = place - frame.rotation.apply(&offset);
        (builder.add_node(&format!("{name} {k}"), frame, Freedoms::Full), offset)
    });
    let points = points.collect();
    (Arc::new(Centerline::new(knots).expect("ascending")), points)
}

/// Curves of all kinds: of the base, and of the tip.
fn model(kind: usize, seed: u64, dissipation: f64) -> (System, State, NearestContact, Random) {
    let mut random = Random::new(seed);
    let mut builder = Builder::new();
    let upper = (Vector3::new(0.0, 0.0, 0.9 * RADIUS), Vector3::new(0.9, 0.3, 0.1));
    let (tip_line, tip_points) = line(&mut builder, "tip", upper, &mut random);
    let interval = |line: &Arc<Centerline>, k: usize, points: &[CarriedPoint]| {
        CarriedCurve::of_interval(line, k, points)
    };
    let tip = interval(&tip_line, 2, &tip_points);
    let (base, tip) = match kind {
        0 => {
            let lower = (Vector3::zeros(), Vector3::new(-0.2, 1.0, 0.1));
            let (line, points) = line(&mut builder, "base", lower, &mut random);
            (interval(&line, 2, &points), tip)
        }
        1 => (CarriedCurve::of_point((GROUND, Vector3::new(2.0, 1.0, 0.0))), tip),
        2 => {
            let body = builder.add_node("body", random.motion(), Freedoms::Full);
            let frame = builder.initial_frame(body);
            let ends =
                [-10.0, 12.0].map(|y| (body, frame.inverse_transform_point(&Vector3::new(1.0, y, 0.0))));
            (CarriedCurve::between(ends), tip)
        }
        _ => {
            let lower = (Vector3::zeros(), Vector3::new(-0.2, 1.0, 0.1));
            let (line, points) = line(&mut builder, "base", lower, &mut random);
            (interval(&line, 2, &points), CarriedCurve::on_line(&tip_line, 28.0, &tip_points))
        }
    };
    let compliance = Compliance { stiffness: 3.0, exponent: if seed.is_multiple_of(2) { 1.0 } else { 1.5 } };
    let contact = NearestContact::new([base, tip], [0.4 * RADIUS, 0.6 * RADIUS], (compliance, dissipation));
    builder.add(Contribution::of(builder.model(), contact.clone()));
    let (system, state) = builder.build(0.0).expect("valid");
    (system, state, contact, random)
}

#[test]
fn derivatives_of_nearest_contacts_are_those_of_differences() {
    for kind in 0..4 {
        for seed in [3, 4] {
            let (system, state, contact, mut random) = model(kind, seed + 10 * kind as u64, 0.1);
            assert!(contact.energy(&state.kinematics).strain > 1e-3, "{kind}");
            check(&format!("nearest contact {kind}"), &system, &state, 0.01, &mut random);
        }
    }
}

/// Without dissipation the forces at rest are the gradient of the energy.
#[test]
fn forces_of_nearest_contacts_are_the_gradient_of_their_energy() {
    for kind in 0..4 {
        let (system, state, _, mut random) = model(kind, 30 + kind as u64, 0.0);
        let mut here = Configuration::random(&system, &state, 0.01, &mut random);
        for node in &mut here.at.nodes {
            node.twist.fill(0.0);
            node.acceleration.fill(0.0);
        }
        let energy = |at: &Configuration| vec![system.energy(&at.at).total()];
        for (row, force) in here.residual(&system, 0.0).iter().enumerate() {
            let slope = difference(|step| energy(&here.displaced(&system, row, step, false)))[0];
            assert!((force - slope).abs() < 1e-7 * (1.0 + force.abs()), "{kind} {row}: {force} {slope}");
        }
    }
}

/// A ball that passes from one interval of a line to the next feels the same force, at the node as well as around it, to 5e-5
/// on a line that is as uneven as this.
#[test]
fn intervals_hand_a_contact_over() {
    let mut random = Random::new(5);
    let mut builder = Builder::new();
    let (line, points) = line(&mut builder, "line", (Vector3::zeros(), Vector3::x()), &mut random);
    let ball = builder.add_node("ball", random.motion(), Freedoms::Full);
    let intervals: Vec<_> = (0..line.intervals())
        .map(|k| {
            let curves = [
                CarriedCurve::of_point((ball, Vector3::zeros())),
                CarriedCurve::of_interval(&line, k, &points),
            ];
            let law = (Compliance { stiffness: 10.0, exponent: 1.0 }, 0.0);
            NearestContact::new(curves, [0.0, RADIUS], law)
        })
        .collect();
    let (_, state) = builder.build(0.0).expect("valid");
    let mut at = state.kinematics;
    for k in -400..=400 {
        let s = 32.0 + 1e-4 * f64::from(k);
        let place = |node: usize| at.nodes[points[node].0].frame.transform_point(&points[node].1);
        let [on_line, tangent] = [0, 1].map(|order| line.at(s).sum(order, place));
        let beside = tangent.cross(&Vector3::z()).normalize();
        at.nodes[ball].frame.position = on_line + 0.9 * RADIUS * beside;
        let force: Vector3 = intervals.iter().map(|own| own.reading(&at).force).sum();
        let wanted = -10.0 * 0.1 * RADIUS * beside;
        assert!((force - wanted).norm() < 1e-3, "{s}: {force} {wanted}");
    }
}
