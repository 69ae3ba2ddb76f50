//! Tests of `superelement::left_out`, a module of it.

use nalgebra::DMatrix;

use super::*;
use crate::superelement::{Damping, ReducedMatrices};
use lissom_mechanics::elements::inertia::Gravity;
use lissom_mechanics::kinematics::{NodeId, NodeMotion};
use lissom_motion::Motion;

/// A rod with linear shapes: a quarter of its mass is omitted, and a sixth of it times the acceleration of its end is the
/// error.
#[test]
fn a_sudden_load_on_a_rod_with_linear_shapes_misses_a_quarter_of_its_mass() {
    let (total, length) = (12.0, 2.0);
    let mut mass = DMatrix::zeros(12, 12);
    let mut stiffness = DMatrix::zeros(12, 12);
    for k in 0..3 {
        for (i, j, own) in [(k, k, 2.0), (k, k + 6, 1.0), (k + 6, k, 1.0), (k + 6, k + 6, 2.0)] {
            mass[(i, j)] = own * total / 6.0;
        }
        mass[(k + 9, k + 9)] = 1e-3;
        stiffness[(k + 6, k + 6)] = 1e5;
        stiffness[(k + 9, k + 9)] = 1e5;
    }
    let matrices =
        ReducedMatrices { mass, stiffness, damping: Damping::None, preload: Vec::new(), geometric: None };
    let places = [Vector3::zeros(), Vector3::new(length, 0.0, 0.0)];
    let gravity = Gravity::constant(Vector3::zeros());
    let element = Part::new((NodeId::first(2).collect(), Vec::new()), (0, &places), matrices, gravity);
    let estimate = LeftOut::of(&element).expect("it moves");
    let share = |own: f64, of_base: f64| {
        let mut at = Kinematics {
            time: 0.0,
            elapsed: 0.0,
            nodes: places.iter().map(|place| NodeMotion::at_rest(Motion::translation(*place))).collect(),
            coordinates: Vec::new(),
            held: Vec::new(),
            multipliers: Vec::new(),
            units: Vec::new(),
        };
        at.nodes[0].acceleration[0] = of_base;
        at.nodes[1].acceleration[0] = of_base + own;
        estimate.share(&element, &at, &[0.0; 12])
    };
    // A base acceleration of 1 with an end acceleration of -3/2 relative to it: an error of 3 kg in 12.
    let found = share(-1.5, 1.0).expect("there are forces");
    assert!((found - 0.25).abs() < 1e-12, "{found}");
    assert_eq!(share(0.0, 1.0), Some(0.0));
    assert_eq!(share(0.0, 0.0), None);
}
