//! Tests of `elastic`, a module of it.

use std::sync::atomic::{AtomicUsize, Ordering};

use lissom_motion::Motion;

use super::*;
use crate::geometry::gap::Gap;
use lissom_mechanics::kinematics::{GROUND, NodeMotion};

/// A plane that counts how often a point is compared with it.
#[derive(Debug, Default)]
struct Counted(AtomicUsize);

impl Pair for Counted {
    fn gap(&self, x: &Vector3, _: &Matrix3) -> Gap {
        self.0.fetch_add(1, Ordering::Relaxed);
        let (normal, none) = (Vector3::z(), Matrix3x6::zeros());
        Gap { value: x.z, normal, point: *x, normal_by: none, point_by: none }
    }
    fn deepest(&self) -> f64 {
        f64::INFINITY
    }
    fn reach(&self) -> f64 {
        0.0
    }
}

/// Many possible contacts cost no more than those that touch.
#[test]
fn contacts_frozen_apart_are_not_evaluated() {
    let pair = Arc::new(Counted::default());
    let frames = [GROUND, NodeId::new(1)].map(CarriedFrame::of_node);
    let law = (Compliance { stiffness: 1.0, exponent: 1.0 }, Dissipation::Factor(0.0));
    let mut contact = Contact::new(frames, pair.clone(), law, None);
    contact.switch_states = SwitchStates::held_at(0, 1);
    let below = Motion::translation(Vector3::new(0.0, 0.0, -0.1));
    let mut at = Kinematics {
        time: 0.0,
        elapsed: 0.0,
        nodes: [Motion::identity(), below].map(NodeMotion::at_rest).to_vec(),
        coordinates: Vec::new(),
        held: vec![-1.0],
        multipliers: Vec::new(),
        units: Vec::new(),
    };
    let evaluate = |at: &Kinematics| {
        let (mut forces, mut tangents) = ([0.0; BRISTLES], Tangents::new(BRISTLES));
        contact.forces(at, &mut forces);
        contact.linearize(at, &mut tangents);
        let is_zero = forces.iter().chain(&tangents.stiffness).all(|value| *value == 0.0);
        (is_zero && contact.energy(at) == Energy::default(), contact.is_idle(at))
    };
    assert_eq!((evaluate(&at), pair.0.load(Ordering::Relaxed)), ((true, true), 0));
    at.held[0] = 1.0;
    assert_eq!(evaluate(&at), (false, false));
    assert!(pair.0.load(Ordering::Relaxed) > 0);
}

/// Bristles yield between the elastic limit and the deflection at slip, and return to it from beyond.
#[test]
fn derivatives_of_yielding_are_those_of_differences() {
    let friction = ContactFriction {
        bristles: Vec::new(),
        law: Coulomb { sliding: 0.4, at_rest: 0.5, stribeck: 0.1 },
        deflection: 2.0,
    };
    let sliding = Vector3::new(0.3, -0.2, 0.5);
    let step = 1e-6;
    for length in [1.0, 1.7, 1.9, 2.3] {
        let bristles = length * Vector3::new(0.5, 0.1, 0.6).normalize();
        let at = friction.yielding(&bristles, &sliding);
        assert_eq!(at.rate == Vector3::zeros(), length < 1.6, "{length}");
        for k in 0..3 {
            let aside = step * Vector3::ith(k, 1.0);
            let slope = |of: &dyn Fn(Vector3) -> Yielding| (of(aside).rate - of(-aside).rate) / (2.0 * step);
            let by_sliding = slope(&|aside| friction.yielding(&bristles, &(sliding + aside)));
            let by_bristles = slope(&|aside| friction.yielding(&(bristles + aside), &sliding));
            assert!((by_sliding - at.by_sliding.column(k)).norm() < 1e-8, "{length} {by_sliding}");
            assert!((by_bristles - at.by_bristles.column(k)).norm() < 1e-8, "{length} {by_bristles}");
        }
    }
    assert_eq!(friction.yielding(&Vector3::new(1.9, 0.0, 0.0), &-sliding).rate, Vector3::zeros());
}
