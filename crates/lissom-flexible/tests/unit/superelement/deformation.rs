//! Tests of `superelement::deformation`, a module of it.

use super::*;
use lissom_mechanics::kinematics::{CoordinateMotion, NodeMotion};

/// Three interfaces, the second of which carries the frame, and two modes with different units: u has as many rows as `size`.
#[test]
fn unknowns_are_those_of_the_matrices() {
    let places = vec![Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0), Vector3::new(0.0, 2.0, 0.0)];
    let deformation = Deformation {
        nodes: [1, 2, 3].map(NodeId::new).to_vec(),
        floating: 1,
        places: places.clone(),
        modes: vec![(CoordinateId::new(0), 2.0), (CoordinateId::new(1), 0.5)],
    };
    let shift = Vector3::new(0.0, 0.0, 0.25);
    let nodes = [Vector3::zeros(), places[0], places[1], places[2] + shift];
    let at = Kinematics {
        time: 0.0,
        elapsed: 0.0,
        nodes: nodes.iter().map(|place| NodeMotion::at_rest(Motion::translation(*place))).collect(),
        coordinates: [0.3, 0.4]
            .map(|value| CoordinateMotion { value, rate: -value, acceleration: 0.0 })
            .to_vec(),
        held: Vec::new(),
        multipliers: Vec::new(),
        units: Vec::new(),
    };
    let mut wanted = vec![0.0; 20];
    (wanted[14], wanted[18], wanted[19]) = (0.25, 0.6, 0.2);
    assert_eq!(deformation.unknowns(&at), wanted);
    assert_eq!(deformation.size(), wanted.len());
    assert_eq!(deformation.coordinates().collect::<Vec<_>>(), [0, 1].map(CoordinateId::new));
    let modal = deformation
        .modal()
        .map(|(own, factor)| [at.coordinates[own].value, at.coordinates[own].rate].map(|part| factor * part));
    assert_eq!(modal.collect::<Vec<_>>(), [[0.6, -0.6], [0.2, -0.2]]);
}
