//! Tests of `consistent::rigid`, a module of it.

use lissom_motion::{Matrix3, Motion, Vector3};

use super::*;
use crate::consistent::initial_conditions::{ConsistentInitialConditions, Inertias};
use crate::elements::inertia::Inertia;
use crate::joints::KINDS;
use crate::kinematics::Freedoms;
use crate::registry::{Parameters, Value};
use crate::scaling::Representative;
use crate::system::{Builder, Placement, State};

/// A crank, a rack that it moves by a gear, and a body on a ball joint between them with a rod of constant length to the rack.
fn rack() -> (System, State) {
    let mut builder = Builder::new();
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.2, 0.3, 0.4));
    let positions = [[0.3, 0.1, 0.0], [1.0, 0.5, 0.2], [0.5, 0.7, -0.3]];
    let nodes = positions.map(|position| {
        let node = builder.add_node("body", Motion::translation(Vector3::from(position)), Freedoms::Full);
        builder.add_inertia(node, &Inertia::of_rigid_body(2.0, &Vector3::new(0.1, 0.0, 0.2), &inertia));
        node
    });
    let ground = builder.ground();
    let mut joint = |kind: &str, nodes, at: [f64; 3], at_tip: Option<[f64; 3]>, axis: Option<Vector3>| {
        let kind = KINDS.iter().find(|own| own.name == kind).expect("there");
        let (at, at_tip) = (Vector3::from(at), at_tip.map(Vector3::from));
        let placement = Placement { nodes, at, at_tip, axis, second_axis: None };
        builder.add_joint("joint", kind, &placement, &Parameters::new()).expect("valid")
    };
    let turn = joint("revolute", [ground, nodes[0]], [0.0; 3], None, Some(Vector3::new(0.1, 0.2, 1.0)));
    let shift = joint("prismatic", [ground, nodes[1]], [1.0, 0.5, 0.0], None, Some(Vector3::x()));
    joint("spherical", [nodes[0], nodes[2]], [0.4, 0.4, -0.1], None, None);
    joint("distance", [nodes[2], nodes[1]], [0.6, 0.8, -0.2], Some([0.9, 0.4, 0.1]), None);
    let gear = KINDS.iter().find(|own| own.name == "gear").expect("there");
    let ratio = Parameters::new().with("ratio", Value::Number(0.2));
    builder.add_coupling("gear", gear, &[turn[0], shift[0]], &ratio).expect("valid");
    builder.build(0.0).expect("valid")
}

/// Solutions by the multipliers alone are those of the whole matrix, also of coordinates without inertia on which several constraints act.
#[test]
fn solutions_are_those_of_the_whole_matrix() {
    let (system, state) = rack();
    let linearization = system.linearization_at(&state.kinematics);
    let representative = Representative::of(&system, &state.kinematics, &linearization);
    let mut whole =
        ConsistentInitialConditions::new(&system, &state, &representative, &lissom_solver::KINDS[0]);
    whole.factor(&system, &state, Inertias::All).expect("regular");
    let mut kept = Known::default();
    let rigid = kept.renewed((&system, &state.kinematics), &[]).expect("rigid parts");
    assert_eq!(rigid.eliminated.len(), 2);
    rigid.factor().expect("independent");
    let right: Vec<f64> = (0..system.layout().size()).map(|row| (7.0 * row as f64).sin()).collect();
    let (mut found, mut expected) = (right.clone(), right);
    rigid.solve(&mut found);
    whole.solve(&system, &mut expected);
    for (row, (found, expected)) in found.iter().zip(&expected).enumerate() {
        assert!((found - expected).abs() < 1e-10 * (1.0 + expected.abs()), "{row}: {found} {expected}");
    }
}

/// A coordinate without inertia of its own has that of its parts, as if nothing else held them.
#[test]
fn a_coordinate_has_the_inertia_of_its_free_parts() {
    let (system, state) = rack();
    let mut kept = Known::default();
    let rigid = kept.renewed((&system, &state.kinematics), &[]).expect("rigid parts");
    let inertias: Vec<(usize, f64)> = rigid.inertias_of_coordinates().collect();
    let layout = system.layout();
    assert_eq!(inertias[0].0, layout.coordinate_rows[0] as usize);
    // That of the crank about its centre of mass at least, and at most the mass of the rack.
    assert!(inertias[0].1 > 0.2 && inertias[0].1 < 0.4, "{inertias:?}");
    assert!(inertias[1].1 > 0.5 && inertias[1].1 < 2.0 + 1e-12, "{inertias:?}");
}
