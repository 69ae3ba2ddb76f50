//! Contacts of all pairs of solids: derivatives, energy and gradients of what they report.

use std::sync::Arc;

use lissom_contact::elastic::resistance::ContactResistance;
use lissom_contact::elastic::{Contact, ContactFriction, Dissipation};
use lissom_contact::geometry::curves::Segment;
use lissom_contact::geometry::gap::Pair;
use lissom_contact::geometry::pairs::{CurveOnSurface, EllipsoidsOnSurface, PointOnSurface};
use lissom_contact::geometry::surfaces::{Cuboid, HalfSpace, Ring, Rod, Surface};
use lissom_contact::law::Coulomb;
use lissom_contact::point::MovingSurface;
use lissom_mechanics::compliance::Compliance;
use lissom_mechanics::elements::Contribution;
use lissom_mechanics::kinematics::{CarriedFrame, CoordinateId, Freedoms, GROUND, Switch};
use lissom_motion::{Motion, Vector3};
use lissom_system::{Builder, State, System};

use crate::derivatives::check;
use crate::derivatives::configuration::{Configuration, Random, difference};

/// Pairs of solids, and where the tip is in the axes of the base, so that they overlap.
pub(super) fn pairs() -> Vec<(Arc<dyn Pair>, Vector3)> {
    let point =
        |surface: Arc<dyn Surface>| -> Arc<dyn Pair> { Arc::new(PointOnSurface { rounding: 3.0, surface }) };
    let segment = |surface: Arc<dyn Surface>| -> Arc<dyn Pair> {
        Arc::new(CurveOnSurface { curve: Arc::new(Segment::new(12.0)), rounding: 3.0, surface })
    };
    let rim = |surface: Arc<dyn Surface>| -> Arc<dyn Pair> {
        let semi_axes = vec![EllipsoidsOnSurface::rim(4.5)];
        Arc::new(EllipsoidsOnSurface { semi_axes, rounding: 0.5, depth: 9.0, surface })
    };
    vec![
        (point(Arc::new(HalfSpace)), Vector3::new(0.2, 0.1, 2.3)),
        (point(Arc::new(Rod { half_length: 0.0, radius: 4.0 })), Vector3::new(3.0, 2.5, 3.5)),
        (point(Arc::new(Rod { half_length: 15.0, radius: 4.0 })), Vector3::new(3.5, 3.5, 2.0)),
        (point(Arc::new(Cuboid { half_sides: [2.0, 2.0, 15.0] })), Vector3::new(4.0, 3.5, 1.5)),
        (point(Arc::new(Ring { radii: [0.0, 16.0], half_length: 25.0 })), Vector3::new(14.0, 10.5, 2.0)),
        (point(Arc::new(Ring { radii: [16.0, 30.0], half_length: 25.0 })), Vector3::new(12.0, 8.0, 1.5)),
        (rim(Arc::new(HalfSpace)), Vector3::new(1.0, 0.5, 2.0)),
        (segment(Arc::new(HalfSpace)), Vector3::new(0.2, 0.1, 9.0)),
        (segment(Arc::new(Rod { half_length: 15.0, radius: 4.0 })), Vector3::new(3.5, 3.5, 2.0)),
        (segment(Arc::new(Cuboid { half_sides: [2.0, 2.0, 15.0] })), Vector3::new(3.0, 3.5, 1.5)),
    ]
}

/// Two bodies with a contact, which dissipates where `is_rough`.
fn with_contact(
    seed: u64,
    (pair, place): (Arc<dyn Pair>, Vector3),
    is_rough: bool,
) -> (System, State, Random) {
    let mut random = Random::new(seed);
    let mut builder = Builder::new();
    let base = builder.add_node("base", random.motion(), Freedoms::Full);
    let frame = random.motion();
    let tip_frame = builder.initial_frame(base) * frame * Motion::translation(place);
    let tip = builder.add_node("tip", tip_frame * random.motion(), Freedoms::Full);
    let of_tip = tip_frame.relative_to(&builder.initial_frame(tip));
    let turn = Vector3::new(0.9, 0.5, 0.0) + 0.2 * random.vector();
    let turn = Motion::exponential(&lissom_motion::screw(&Vector3::zeros(), &turn));
    let frames =
        [CarriedFrame { node: base, offset: frame }, CarriedFrame { node: tip, offset: of_tip * turn }];
    let mut contribution = Contribution::to(builder.model());
    let friction = is_rough.then(|| ContactFriction {
        bristles: (0..3).map(|k| contribution.add_state(format!("bristle {k}"), 0.1, 1.0)).collect(),
        law: Coulomb { sliding: 0.4, at_rest: 0.7, stribeck: 40.0 },
        deflection: 4.0,
    });
    let dissipation = Dissipation::Factor(if is_rough { 0.1 } else { 0.0 });
    let exponent = if seed.is_multiple_of(2) { 1.0 } else { 1.5 };
    let law = (Compliance { stiffness: 3.0, exponent }, dissipation);
    let resistance = is_rough.then(|| {
        let states = (0..3).map(|k| contribution.add_state(format!("angle {k}"), 0.2, 1.0));
        let (sliding, at_rest) = (1.0, 1.0);
        let bristles = states.collect();
        let bristles =
            ContactFriction { bristles, law: Coulomb { sliding, at_rest, stribeck: 30.0 }, deflection: 3.0 };
        ContactResistance { bristles, rolling: 0.6, spinning: 0.9 }
    });
    let mut contact = Contact::new(frames, pair, law, friction);
    if let Some(resistance) = resistance {
        contact = contact.with_resistance(resistance);
        let surface = MovingSurface { is_tip: seed.is_multiple_of(2), velocity: 20.0 * random.vector() };
        contact = contact.with_surface(surface);
    }
    builder.add(contribution.with(contact));
    let (system, state) = builder.build(0.0).expect("valid");
    (system, state, random)
}

#[test]
fn derivatives_of_contacts_are_those_of_differences() {
    for (index, pair) in pairs().into_iter().enumerate() {
        for seed in [2 * index as u64, 2 * index as u64 + 1] {
            for is_rough in [false, true] {
                let (system, state, mut random) = with_contact(seed + 40, pair.clone(), is_rough);
                assert!(system.energy(&state.kinematics).strain > 0.0, "{index}");
                check(&format!("contact {index}"), &system, &state, 0.02, &mut random);
            }
        }
    }
}

/// A contact that is frozen apart has neither force nor energy wherever its solids are, and its bristles keep their deflection.
#[test]
fn contacts_frozen_apart_are_idle() {
    for (index, pair) in pairs().into_iter().enumerate() {
        for is_rough in [false, true] {
            let (system, mut state, mut random) = with_contact(index as u64 + 120, pair.clone(), is_rough);
            state.kinematics.held[system.signals().first_side()] = -1.0;
            assert_eq!(system.energy(&state.kinematics).strain, 0.0, "{index}");
            let here = Configuration::random(&system, &state, 0.02, &mut random);
            let mut wanted = vec![0.0; system.layout().size()];
            for (coordinate, motion) in CoordinateId::enumerate(&here.at.coordinates) {
                wanted[system.layout().row_of_coordinate(coordinate)] = motion.rate;
            }
            assert_eq!(here.residual(&system, 0.0), wanted, "{index}");
            check(&format!("contact {index} apart"), &system, &state, 0.02, &mut random);
        }
    }
}

/// Without friction the forces at rest are the gradient of the energy.
#[test]
fn normal_forces_are_the_gradient_of_their_energy() {
    for (index, pair) in pairs().into_iter().enumerate() {
        let (system, state, mut random) = with_contact(index as u64 + 80, pair, false);
        let mut here = Configuration::random(&system, &state, 0.02, &mut random);
        for node in &mut here.at.nodes {
            node.twist.fill(0.0);
            node.acceleration.fill(0.0);
        }
        let energy = |at: &Configuration| vec![system.energy(&at.at).total()];
        for (row, force) in here.residual(&system, 0.0).iter().enumerate() {
            let slope = difference(|step| energy(&here.displaced(&system, row, step, false)))[0];
            assert!((force - slope).abs() < 1e-7 * (1.0 + force.abs()), "{index} {row}: {force} {slope}");
        }
    }
}

/// While an event is located, functions that are not near zero keep their values.
#[test]
fn wanted_switches_alone_are_updated() {
    let mut builder = Builder::new();
    for k in 1..4 {
        let place = Motion::translation(f64::from(k) * Vector3::z());
        let ball = builder.add_node(&format!("ball {k}"), place, Freedoms::Full);
        let pair = Arc::new(PointOnSurface { rounding: 0.5, surface: Arc::new(HalfSpace) });
        let law = (Compliance { stiffness: 1.0, exponent: 1.0 }, Dissipation::Factor(0.0));
        let contact = Contact::new([GROUND, ball].map(CarriedFrame::of_node), pair, law, None);
        let contribution = Contribution::to(builder.model()).with(contact);
        builder.add(contribution);
    }
    let (system, state) = builder.build(0.0).expect("valid");
    let mut values = vec![Switch::from(7.0); 4];
    system.update_switches(&state.kinematics, (1, &[true, false, true, false]), &mut values);
    assert_eq!(values, [7.0, 7.0, -1.5, 7.0].map(Switch::from));
}
