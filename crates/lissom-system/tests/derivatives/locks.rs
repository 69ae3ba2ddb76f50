//! Every way to lock some of six relative degrees of freedom: derivatives, and the freedom that is left.

use lissom_mechanics::joints;
use lissom_mechanics::registry::{Parameters, Value};
use lissom_motion::Vector6;
use lissom_system::{Placement, State, System};

use crate::derivatives::configuration::{Configuration, Random};
use crate::derivatives::{check, two_bodies};

const WORDS: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

fn locked(mask: usize, random: &mut Random) -> (System, State) {
    let kind = joints::KINDS.iter().find(|kind| kind.name == "generic").expect("there");
    let words = (0..6).filter(|k| mask >> k & 1 == 1).map(|k| WORDS[k].to_owned()).collect();
    let parameters = Parameters::new().with("locked", Value::Words(words));
    let (mut builder, nodes) = two_bodies(random);
    let placement = Placement {
        nodes,
        at: random.vector(),
        at_tip: None,
        axis: Some(random.vector()),
        second_axis: Some(random.vector()),
    };
    builder.add_joint("joint", kind, &placement, &parameters).expect("valid");
    builder.build(0.0).expect("valid")
}

#[test]
fn derivatives_of_every_way_to_lock() {
    for mask in 1..64 {
        let mut random = Random::new(mask as u64 + 300);
        let (system, state) = locked(mask, &mut random);
        check(&format!("generic {mask:06b}"), &system, &state, 0.5, &mut random);
        let here = Configuration::random(&system, &state, 0.5, &mut random);
        let mut carried = vec![0.0; state.multipliers.len()];
        system.stage_violations(&here.point(0.0), &mut carried);
        let mut absolute = vec![0.0; carried.len()];
        system.violations(&here.at, &mut absolute);
        for (a, b) in carried.iter().zip(&absolute) {
            assert!((a - b).abs() < 1e-13, "{mask:06b}: {a} carried, {b} absolute");
        }
    }
}

/// At the start the equations are the locked components of the relative motion, in this order, with their signs.
#[test]
fn equations_are_the_locked_components() {
    for mask in 1..64_usize {
        let mut random = Random::new(mask as u64 + 400);
        let (system, state) = locked(mask, &mut random);
        let joint = &system.joints()[0];
        let small = 1e-7 * random.screw();
        let mut at = state.kinematics.clone();
        let tip = joint.frames[1];
        at.nodes[tip.node].frame = at.nodes[tip.node].frame
            * tip.offset
            * lissom_motion::Motion::exponential(&small)
            * tip.offset.inverse();
        let mut found = vec![0.0; state.multipliers.len()];
        system.violations(&at, &mut found);
        let wanted: Vec<f64> = (0..6).filter(|k| mask >> k & 1 == 1).map(|k| small[k]).collect();
        assert_eq!(found.len(), wanted.len());
        for (a, b) in found.iter().zip(&wanted) {
            assert!((a - b).abs() < 1e-13, "{mask:06b}: {found:?} {wanted:?}");
        }
    }
}

/// Small motions of the degrees of freedom that are left do not violate the equations, large turns about a free axis included.
#[test]
fn what_is_not_locked_is_free() {
    let turn = |k: usize, size: f64| {
        let mut screw = Vector6::zeros();
        screw[k] = size;
        lissom_motion::Motion::exponential(&screw)
    };
    for mask in 1..64_usize {
        let mut random = Random::new(mask as u64 + 500);
        let (system, state) = locked(mask, &mut random);
        let joint = &system.joints()[0];
        let [base, tip] = joint.frames;
        let start = joint.relative_motion(&state.kinematics);
        assert!(start.position.norm() < 1e-14 && (start.rotation.matrix().trace() - 3.0).abs() < 1e-13);
        for k in (0..6).filter(|k| mask >> k & 1 == 0) {
            let mut at = state.kinematics.clone();
            let frame = at.nodes[base.node].frame * base.offset;
            at.nodes[tip.node].frame = frame * turn(k, 0.8) * tip.offset.inverse();
            let mut found = vec![0.0; state.multipliers.len()];
            system.violations(&at, &mut found);

            assert!(found.iter().all(|value| value.abs() < 1e-14), "{mask:06b} by {k}: {found:?}");
        }
    }
}
