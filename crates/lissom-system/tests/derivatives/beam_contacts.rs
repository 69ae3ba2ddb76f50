//! Contacts of sections of beams with parts: derivatives, energy and gradients of what they report.

use std::sync::Arc;

use lissom_contact::elastic::ContactFriction;
use lissom_contact::geometry::gap::Pair;
use lissom_contact::geometry::pairs::PointOnSurface;
use lissom_contact::geometry::surfaces::{Cuboid, HalfSpace, Ring, Rod, Surface};
use lissom_contact::law::Coulomb;
use lissom_contact::of_beams::BeamContact;
use lissom_flexible::beam::SectionLaw;
use lissom_flexible::beam::line::{BeamLineDescription, beam_line};
use lissom_flexible::beam::section::Section;
use lissom_mechanics::compliance::Compliance;
use lissom_mechanics::elements::{Contribution, Element, Spring};
use lissom_mechanics::kinematics::{CarriedFrame, Freedoms, GROUND, Kinematics};
use lissom_motion::{Matrix6, Motion, Vector3, screw};
use lissom_system::{Builder, State, System};

use crate::derivatives::check;
use crate::derivatives::configuration::{Configuration, Random, difference};

/// Surfaces, and where the middle of the beam is in their axes, so that they overlap.
fn surfaces() -> Vec<(Arc<dyn Surface>, Vector3)> {
    vec![
        (Arc::new(HalfSpace), Vector3::new(0.2, 0.1, 1.7)),
        (Arc::new(Rod { half_length: 0.0, radius: 4.0 }), Vector3::new(3.0, 2.5, 3.2)),
        (Arc::new(Ring { radii: [0.0, 16.0], half_length: 25.0 }), Vector3::new(14.0, 10.5, 2.0)),
        (Arc::new(Ring { radii: [16.0, 30.0], half_length: 25.0 }), Vector3::new(12.0, 8.0, 1.5)),
        (Arc::new(Cuboid { half_sides: [2.0, 2.0, 15.0] }), Vector3::new(4.0, 3.5, 1.5)),
    ]
}

/// How the beam is attached: to a moving base; to the ground; by an end fixed to the base.
#[derive(Clone, Copy, PartialEq)]
enum Attachment {
    Base,
    Ground,
    OnBase,
}

/// A soft beam of one element against a surface.
fn model(
    seed: u64,
    (surface, place): (Arc<dyn Surface>, Vector3),
    (order, attachment, is_rough): (usize, Attachment, bool),
) -> (System, State, BeamContact, Random) {
    let mut random = Random::new(seed);
    let mut builder = Builder::new();
    let base = match attachment {
        Attachment::Ground => GROUND,
        _ => builder.add_node("base", random.motion(), Freedoms::Full),
    };
    let offset = random.motion();
    let turn = screw(&Vector3::zeros(), &Vector3::new(0.9, 0.5, 0.3));
    let middle =
        builder.initial_frame(base) * offset * Motion::translation(place) * Motion::exponential(&turn);
    let frame = |s: f64| {
        let along = screw(&Vector3::new(1.2, 0.1, 0.0), &Vector3::new(0.1, 0.6, 0.3));
        middle * Motion::exponential(&((s - 0.4) * along))
    };
    let end = match attachment {
        Attachment::OnBase => base,
        _ => builder.add_node("end", frame(1.0) * random.motion(), Freedoms::Full),
    };
    let description = BeamLineDescription {
        name: "beam",
        elements: 1,
        order,
        frame: &frame,
        law: &|_| SectionLaw::elastic(1e-3 * Matrix6::identity()),
        mass: &|_, _| 0.1 * Matrix6::identity(),
        ends: [None, Some(end)],
    };
    let (contribution, line) = beam_line(builder.model(), &description);
    builder.add(contribution);
    let mut contribution = Contribution::to(builder.model());
    let friction = is_rough.then(|| ContactFriction {
        bristles: (0..3).map(|k| contribution.add_state(format!("bristle {k}"), 0.1, 1.0)).collect(),
        law: Coulomb { sliding: 0.4, at_rest: 0.7, stribeck: 40.0 },
        deflection: 4.0,
    });
    let pair: Arc<dyn Pair> = Arc::new(PointOnSurface { rounding: 3.0, surface });
    let exponent = if seed.is_multiple_of(2) { 1.0 } else { 1.5 };
    let law = (Compliance { stiffness: 3.0, exponent }, if is_rough { 0.1 } else { 0.0 });
    let section = Section::of_line(&line, if order == 2 && is_rough { 0.5 } else { 0.4 });
    let contact = BeamContact::new(CarriedFrame { node: base, offset }, section, pair, law, friction);
    builder.add(contribution.with(contact.clone()));
    let (system, state) = builder.build(0.0).expect("valid");
    (system, state, contact, random)
}

fn cases() -> impl Iterator<Item = (usize, Attachment)> {
    let all = [Attachment::Base, Attachment::Ground, Attachment::OnBase];
    (1..=3).flat_map(move |order| all.into_iter().map(move |attachment| (order, attachment)))
}

#[test]
fn derivatives_of_beam_contacts_are_those_of_differences() {
    for (index, surface) in surfaces().into_iter().enumerate() {
        for (order, attachment) in cases() {
            for is_rough in [false, true] {
                let seed = (index + 10 * order) as u64;
                let (system, state, contact, mut random) =
                    model(seed + 7, surface.clone(), (order, attachment, is_rough));
                assert!(contact.energy(&state.kinematics).strain > 0.1, "{index}");
                check(&format!("beam contact {index} {order}"), &system, &state, 0.02, &mut random);
            }
        }
    }
}

/// Without friction the forces at rest are the gradient of the energy.
#[test]
fn normal_forces_on_beams_are_the_gradient_of_their_energy() {
    for (index, surface) in surfaces().into_iter().enumerate() {
        for (order, attachment) in cases() {
            let (system, state, _, mut random) =
                model(index as u64 + 80, surface.clone(), (order, attachment, false));
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
}

/// Gap, rate and force have the gradients that they report, if these have a place for all nodes.
#[test]
fn gradients_of_beam_contacts_are_those_of_differences() {
    for (index, surface) in surfaces().into_iter().enumerate() {
        for (order, attachment) in cases().filter(|case| *case != (3, Attachment::Base)) {
            let (system, state, contact, mut random) =
                model(index as u64 + 120, surface.clone(), (order, attachment, true));
            let here = Configuration::random(&system, &state, 0.02, &mut random);
            let gradients = contact.spring_gradients(&here.at).expect("few unknowns");
            let motion = |at: &Kinematics| contact.spring_motion(at).to_vec();
            for (slot, &node) in contact.unknowns().nodes.iter().enumerate() {
                for k in 0..6 {
                    let row = system.layout().rows_of_node(node)[k] as usize;
                    let by_place = difference(|step| motion(&here.displaced(&system, row, step, false).at));
                    let by_rate = difference(|step| motion(&here.accelerated(&system, row, step, 1).at));
                    for (component, gradient) in gradients.iter().enumerate() {
                        let [place, rate] =
                            [&gradient.by_place, &gradient.by_rate].map(|of| of[6 * slot + k]);
                        let allowed = 1e-7 * (1.0 + place.abs() + rate.abs());
                        let found = [by_place[component], by_rate[component]];
                        assert!((place - found[0]).abs() < allowed, "{index} {order}: {place} {found:?}");
                        assert!((rate - found[1]).abs() < allowed, "{index} {order}: {rate} {found:?}");
                    }
                }
            }
        }
    }
}
