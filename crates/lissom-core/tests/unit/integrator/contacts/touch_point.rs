//! Tests of `integrator::contacts::touch_point`, a module of it.

use super::*;
use crate::compliance::Compliance;
use crate::contact::forms::{Form, PlacedSolid, Solid};
use crate::contact::law::Coulomb;
use crate::contact::set::{ContactRule, ContactSet, TouchingPart};
use crate::kinematics::{GROUND, NodeMotion};

/// A ball that touches a plane, with a law.
fn point(impact: Impact, exponent: f64, size: f64) -> TouchPoint {
    let placed = |form| vec![PlacedSolid { form, frame: Motion::IDENTITY }];
    let parts = vec![
        TouchingPart::new(GROUND, placed(Form::HalfSpace)),
        TouchingPart::new(NodeId::new(1), placed(Form::Solid(Solid::Sphere(0.1)))),
    ];
    let compliance = Compliance { stiffness: 1e5, exponent };
    let friction = Some(Coulomb { sliding: 0.3, at_rest: 0.3, stribeck: 0.01 });
    let law = TouchLaw { compliance, impact, friction, surface: None };
    let rules = vec![ContactRule {
        name: "floor".to_owned(),
        parts: vec![0, 1],
        groups: Vec::new(),
        law,
        materials: None,
    }];
    let set = ContactSet { parts, rules };
    let above = Motion::translation(Vector3::new(0.0, 0.0, 0.099));
    let at = Kinematics {
        time: 0.0,
        elapsed: 0.0,
        nodes: [Motion::identity(), above].map(NodeMotion::at_rest).to_vec(),
        coordinates: Vec::new(),
        held: Vec::new(),
        multipliers: Vec::new(),
        units: Vec::new(),
    };
    let meetings = set.meetings_of(0, [0, 1]).expect("solids").expect("they touch");
    let (meeting, law) = &meetings[0];
    let step = StepOfPoint { size, planned: size, compliance: 2.0, radius: 0.1, is_first: true };
    let nodes = [GROUND, NodeId::new(1)];
    let place = Place::of(meeting, nodes.map(|node| at.nodes[node].frame), 0.1).expect("near");
    TouchPoint::at((TouchKey::default(), meeting, law), nodes, (&at, step), (place, None))
}

/// Slopes are those of differences, sticking and sliding, resolved and near-rigid, and never negative.
#[test]
fn slopes_are_those_of_differences() {
    let restitution = Impact::Restitution { coefficient: 0.5, relative: 1.0, rest_velocity: 1e-3 };
    for (impact, exponent) in
        [(Impact::Dissipation(0.5), 1.0), (Impact::Dissipation(0.2), 1.5), (restitution, 1.0)]
    {
        for (d, slips) in [(Vector3::new(1e-8, -2e-8, 1e-7), false), (Vector3::new(1e-3, -2e-3, -1e-5), true)]
        {
            let mut point = point(impact, exponent, 1e-3);
            let state = point.evaluate_with_bound(&d);
            assert!(state.force.z > 0.0 && state.slips == slips, "{impact:?} {d:?} {state:?}");
            let force = state.force.xy().norm();
            assert!(force <= 0.3 * state.force.z * (1.0 + 1e-12), "{force}");
            let step = 1e-10;
            for k in 0..3 {
                let aside = step * Vector3::ith(k, 1.0);
                let difference = (point.force(&(d - aside)) - point.force(&(d + aside))) / (2.0 * step);
                let error = (difference - state.slope.column(k)).norm();
                assert!(error < 1e-5 * state.slope.norm(), "{impact:?} {k} {error}");
            }
            assert!(state.slope.symmetric_eigenvalues().min() >= -1e-9 * state.slope.norm());
        }
    }
}
