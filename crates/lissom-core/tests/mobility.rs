//! Degrees of freedom and redundant constraints.

use lissom_core::consistent::mobility;
use lissom_core::elements::inertia::Inertia;
use lissom_core::joints;
use lissom_core::kinematics::{Freedoms, NodeId};
use lissom_core::registry::Parameters;
use lissom_core::system::{Builder, Placement};
use lissom_motion::{Matrix3, Motion, Vector3};

fn body(builder: &mut Builder, name: &str, place: Vector3) -> NodeId {
    let node = builder.add_node(name, Motion::translation(place), Freedoms::Full);
    builder.add_inertia(node, &Inertia::of_rigid_body(1.0, &Vector3::zeros(), &Matrix3::identity()));
    node
}

fn revolute(builder: &mut Builder, name: &str, nodes: [NodeId; 2], at: Vector3, axis: Vector3) {
    let kind = joints::KINDS.iter().find(|kind| kind.name == "revolute").expect("registered");
    let placement = Placement { nodes, at, at_tip: None, axis: Some(axis), second_axis: None };
    builder.add_joint(name, kind, &placement, &Parameters::new()).expect("valid");
}

/// A planar four-bar of revolutes has one freedom and three redundant equations.
#[test]
fn four_bar_repeats_three_equations_of_its_last_joint() {
    let mut builder = Builder::new();
    let places = [Vector3::zeros(), Vector3::y(), Vector3::new(1.0, 1.0, 0.0), Vector3::x()];
    let bars: Vec<NodeId> =
        (0..3).map(|k| body(&mut builder, &format!("bar {k}"), 0.5 * (places[k] + places[k + 1]))).collect();
    let ground = builder.ground();
    let ends = [[ground, bars[0]], [bars[0], bars[1]], [bars[1], bars[2]], [bars[2], ground]];
    for (k, nodes) in ends.into_iter().enumerate() {
        revolute(&mut builder, &format!("joint {k}"), nodes, places[k], Vector3::z());
    }
    let (system, state) = builder.build(0.0).expect("valid");
    let found = mobility::mobility(&system, &state);
    assert_eq!((found.coordinates, found.constraints), (18 + 4, 24));
    assert_eq!(found.freedoms, 1);
    assert_eq!(found.redundant.len(), 3);
    for redundant in &found.redundant {
        assert_eq!(redundant.joint, "joint 3");
        assert_eq!(redundant.among.len(), 3, "{redundant:?}");
    }
}

#[test]
fn a_spatial_chain_has_one_freedom_per_joint() {
    let mut builder = Builder::new();
    let mut base = builder.ground();
    for k in 0..20 {
        let tip = body(&mut builder, &format!("link {k}"), Vector3::new(f64::from(k) + 0.5, 0.0, 0.0));
        let axis = if k % 2 == 0 { Vector3::y() } else { Vector3::z() };
        revolute(
            &mut builder,
            &format!("joint {k}"),
            [base, tip],
            Vector3::new(f64::from(k), 0.0, 0.0),
            axis,
        );
        base = tip;
    }
    let (system, state) = builder.build(0.0).expect("valid");
    let found = mobility::mobility(&system, &state);
    assert_eq!((found.freedoms, found.redundant.len()), (20, 0));
}
