//! Tests of `elements::reeving`, a module of it.

use lissom_motion::{Motion, Rotation};
use nalgebra::SVector;

use super::*;
use crate::kinematics::{CoordinateMotion, NodeId, NodeMotion};

fn sheave(radius: f64, axis: [f64; 3], is_positive: Option<bool>) -> Sheave {
    Sheave { radius, axis: axis.into(), is_positive, turns: None }
}

fn line(places: Vec<(Option<usize>, Vector3)>, nodes: usize) -> Polyline<MAX_PLACES> {
    let length: Function = Arc::new(Constant(3.0));
    let nodes = (1..=nodes).map(NodeId::new).collect();
    Polyline { nodes, places, length, drums: Vec::new(), pays_out: Vec::new(), frames: None }
}

fn length(centres: &[[f64; 3]], sheaves: &[(usize, Sheave)]) -> f64 {
    let line = line(centres.iter().map(|own| (None, Vector3::from(*own))).collect(), 0);
    let points = line.points(|_| unreachable!("all points are on the ground"));
    let reeving = Reeving::new(&points, line, sheaves, Vec::new()).unwrap();
    reeving.initial_length(&points)
}

/// Belts around two wheels of 0.5 m and 0.2 m, 1.3 m apart, open and
/// crossed, and a rope over one wheel.
#[test]
fn lengths_of_belts_are_those_of_formulas() {
    let y = [0.0, -1.0, 0.0];
    let over = length(&[[-0.5, 0.0, -2.0], [0.0, 0.0, 0.0], [0.5, 0.0, -3.0]], &[(1, sheave(0.5, y, None))]);
    assert!((over - (5.0 + 0.5 * PI)).abs() < 1e-12, "{over}");
    // From the top of the first wheel onto the top of the second and down, or onto its bottom and up.
    for (is_crossed, sum) in [(false, 0.5 - 0.2), (true, 0.5 + 0.2_f64)] {
        let wheels = [(1, sheave(0.5, y, Some(false))), (2, sheave(0.2, y, Some(is_crossed)))];
        let up = if is_crossed { 1.0 } else { -1.0 };
        let all = length(&[[-2.0, 0.0, 0.5], [0.0; 3], [1.3, 0.0, 0.0], [1.5, 0.0, up]], &wheels);
        let angle = (sum / 1.3_f64).asin();
        let arcs = 0.5 * angle + 0.2 * (0.5 * PI + up * angle);
        let wanted = 3.0 + (1.3_f64 * 1.3 - sum * sum).sqrt() + arcs;
        assert!((all - wanted).abs() < 1e-12, "{is_crossed}: {all} {wanted}");
    }
}

/// A configuration of three moving nodes with sheaves in different planes, drums at both ends, and a sheave on the ground.
fn tilted() -> (Reeving, Kinematics) {
    let poses: [([f64; 3], [f64; 3]); 4] = [
        ([0.0; 3], [0.0; 3]),
        ([0.1, 0.2, 0.0], [0.3, -0.2, 0.5]),
        ([1.9, -0.1, 0.2], [-0.4, 0.6, 0.2]),
        ([3.1, 0.3, 1.2], [0.2, 0.1, -0.7]),
    ];
    let nodes: Vec<NodeMotion> = (poses.iter().enumerate())
        .map(|(k, (position, turn))| NodeMotion {
            frame: Motion::new(Rotation::exponential(&Vector3::from(*turn)), Vector3::from(*position)),
            twist: if k == 0 {
                Vector6::zeros()
            } else {
                Vector6::from_fn(|i, _| 0.3 * ((i + 7 * k) as f64).sin())
            },
            acceleration: Vector6::zeros(),
        })
        .collect();
    let offset = |k: f64| Vector3::new(0.05 * k, -0.02, 0.03 * k);
    let places = vec![
        (Some(0), offset(1.0)),
        (None, Vector3::new(0.9, 0.1, 1.5)),
        (Some(1), offset(2.0)),
        (Some(1), Vector3::new(0.4, 0.2, -0.3)),
        (Some(2), offset(-1.0)),
    ];
    let sheaves = [
        (0, Sheave { turns: Some(-1.0), ..sheave(0.21, [0.1, 1.0, 0.05], Some(true)) }),
        (1, sheave(0.17, [0.0, 1.0, 0.1], None)),
        (2, sheave(0.26, [-0.1, -1.0, 0.15], None)),
        (4, sheave(0.12, [0.2, 0.9, 0.1], Some(false))),
    ];
    let line = line(places, 3);
    let points = line.points(|node| &nodes[node.index()]);
    let reeving = Reeving::new(&points, line, &sheaves, vec![(CoordinateId::new(0), 0.4)]).unwrap();
    let coordinate = CoordinateMotion { value: 0.4, ..CoordinateMotion::default() };
    let at = Kinematics {
        time: 0.0,
        elapsed: 0.0,
        nodes,
        coordinates: vec![coordinate],
        held: Vec::new(),
        multipliers: Vec::new(),
        units: Vec::new(),
    };
    (reeving, at)
}

fn displaced(at: &Kinematics, node: usize, displacement: &Vector6) -> Kinematics {
    let mut at = at.clone();
    at.nodes[node].frame = at.nodes[node].frame * Motion::exponential(displacement);
    at
}

/// Central difference of fourth order along the unknown number `slot`.
fn difference<const N: usize>(
    at: &Kinematics,
    slot: usize,
    of: impl Fn(&Kinematics) -> SVector<f64, N>,
) -> SVector<f64, N> {
    let step = 1e-3;
    let value = |steps: f64| {
        let mut displacement = Vector6::zeros();
        displacement[slot % 6] = steps * step;
        of(&displaced(at, 1 + slot / 6, &displacement))
    };
    (8.0 * (value(1.0) - value(-1.0)) - (value(2.0) - value(-2.0))) / (12.0 * step)
}

/// Forces are the gradient of the length also where ropes leave the planes of sheaves; derivatives and rates are those of differences.
#[test]
fn derivatives_of_the_length_are_exact() {
    let (reeving, at) = tilted();
    let here = reeving.read(&at);
    assert!(
        here.exists
            && here
                .spans()
                .iter()
                .any(|span| { Vector3::from(span.directions[1]).dot(&Vector3::from(span.along)) < 0.999 }),
        "it leaves the planes"
    );
    let tension = 2.5;
    let forces = |at: &Kinematics| {
        let mut out = [0.0; 18];
        reeving.add_force(&reeving.read(at), tension, &mut out);
        SVector::<f64, 18>::from(out)
    };
    let exact = forces(&at);
    let mut bend = Tangents::new(18);
    reeving.add_bend(&here, tension, &mut bend);
    let [elongation, rate] = reeving.gradients(&here);
    for slot in 0..18 {
        let slope = difference(&at, slot, |at| {
            SVector::from([tension * reeving.read(at).motion[0], reeving.read(at).motion[1]])
        });
        assert!((slope[0] - exact[slot]).abs() < 1e-9, "{slot}: {} {}", slope[0], exact[slot]);
        assert!((elongation.by_place[slot] * tension - exact[slot]).abs() < 1e-12);
        assert!(
            (slope[1] - rate.by_place[slot]).abs() < 1e-9,
            "{slot}: {} {}",
            slope[1],
            rate.by_place[slot]
        );
        let column = difference(&at, slot, forces);
        for row in 0..18 {
            let found = bend.stiffness[row * 18 + slot];
            assert!((column[row] - found).abs() < 1e-8, "{row} {slot}: {} {found}", column[row]);
        }
    }
    // No resultant force and moment, together with that on the ground: a rigid motion of all changes nothing.
    let turn = Motion::exponential(&Vector6::new(0.3, 0.1, -0.2, 0.4, 0.9, -0.5));
    assert!((length_of(&reeving, &at, &turn) - here.motion[0]).abs() < 1e-12);
}

/// Elongation after a rigid motion of the nodes and of the points on the ground.
fn length_of(reeving: &Reeving, at: &Kinematics, turn: &Motion) -> f64 {
    let (mut own, mut at) = (reeving.clone(), at.clone());
    at.nodes.iter_mut().for_each(|node| node.frame = *turn * node.frame);
    for (place, wheel) in
        own.line.places.iter_mut().zip(&mut own.wheels).filter(|(place, _)| place.0.is_none())
    {
        place.1 = turn.transform_point(&place.1);
        let wheel = wheel.as_mut().unwrap();
        wheel.axis = turn.rotation.apply(&wheel.axis);
    }
    own.read(&at).motion[0]
}

/// A drum of 0.2 m that turns by many turns, with its coordinate: the rope is shorter by the arc. Without the coordinate, turns are lost.
#[test]
fn drums_count_their_turns() {
    let (mut reeving, at) = tilted();
    let start = reeving.read(&at).motion[0];
    let axis = reeving.wheels[0].as_ref().unwrap().axis;
    let centre = Vector3::new(0.05, -0.02, 0.03);
    for turned in [-40.0, -3.0, 0.5, 9.0, 77.0_f64] {
        let mut after = at.clone();
        let about = Motion::translation(centre)
            * Motion::new(Rotation::about_axis(&axis, turned), Vector3::zeros())
            * Motion::translation(-centre);
        after.nodes[1].frame = after.nodes[1].frame * about;
        after.coordinates[0].value -= turned;
        let longer = reeving.read(&after).motion[0] - start;
        assert!((longer + 0.21 * turned).abs() < 1e-11, "{turned}: {longer}");
        assert_eq!(reeving.off_sheave(&reeving.read(&after), |own| after.coordinates[own].value), None);
    }
    reeving.wheels[0].as_mut().unwrap().drum = None;
    let mut after = at.clone();
    after.nodes[1].frame = after.nodes[1].frame
        * Motion::translation(centre)
        * Motion::new(Rotation::about_axis(&axis, 3.0), Vector3::zeros())
        * Motion::translation(-centre);
    let (point, cause) =
        reeving.off_sheave(&reeving.read(&after), |own| after.coordinates[own].value).unwrap();
    assert!(point == 0 && cause.contains("without `joint`"), "{point} {cause}");
}
