//! Rigid contacts of all pairs of solids, in all modes: derivatives of constraints and friction.

use lissom_contact::rigid::{Mode, RigidLaw};
use lissom_mechanics::joints::constraint::violation_rates;
use lissom_mechanics::kinematics::{CarriedFrame, Freedoms, Kinematics};
use lissom_motion::{Motion, Vector3};
use lissom_system::{Builder, State, System};

use crate::derivatives::check;
use crate::derivatives::configuration::{Random, difference};
use crate::derivatives::contacts::pairs;

/// Two bodies with a contact in this mode.
fn with_contact(index: usize, mode: Mode, friction: f64) -> (System, State, Random) {
    let (pair, place) = pairs().swap_remove(index);
    let mut random = Random::new(index as u64 + 700);
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
    // A velocity of rest of the size of the velocities, so that the direction of sliding is smooth.
    let law = RigidLaw { restitution: 0.5, friction, rest_velocity: 2e4 };
    let contact = builder.add_rigid_contact("contact", frames, pair, law);
    let (system, mut state) = builder.build(0.0).expect("valid");
    state.kinematics.held[contact.held.mode.index()] = mode.number();
    for (held, value) in contact.held.direction.iter().zip(random.vector().iter()) {
        state.kinematics.held[held.index()] = *value;
    }
    (system, state, random)
}

#[test]
fn derivatives_of_rigid_contacts_are_those_of_differences() {
    for index in 0..pairs().len() {
        for (mode, friction) in [
            (Mode::Open, 0.7),
            (Mode::Sliding, 0.0),
            (Mode::Sliding, 0.7),
            (Mode::Sticking, 0.7),
            (Mode::Saturated, 0.7),
        ] {
            let (system, state, mut random) = with_contact(index, mode, friction);
            check(&format!("rigid contact {index} {mode:?} {friction}"), &system, &state, 0.02, &mut random);
        }
    }
}

/// The state after a time along its motion.
fn moved(at: &Kinematics, time: f64) -> Kinematics {
    let mut moved = at.clone();
    for node in &mut moved.nodes {
        node.frame =
            node.frame * Motion::exponential(&(time * (node.twist + 0.5 * time * node.acceleration)));
        node.twist += time * node.acceleration;
    }
    moved
}

/// The rate of the gap is that of the normal velocity, and accelerations are derivatives of velocities along the motion.
#[test]
fn rates_of_rigid_contacts_are_those_along_the_motion() {
    for index in 0..pairs().len() {
        for mode in [Mode::Sliding, Mode::Sticking] {
            let (system, state, mut random) = with_contact(index, mode, 0.7);
            let mut at = state.kinematics.clone();
            for node in system.layout().nodes() {
                at.nodes[node].twist = random.screw();
                at.nodes[node].acceleration = random.screw();
            }
            at.nodes[lissom_mechanics::kinematics::GROUND] =
                state.kinematics.nodes[lissom_mechanics::kinematics::GROUND];
            let contact = system.rigid_contacts().next().expect("there is one");
            let slope = difference(|time| vec![contact.touching(&moved(&at, time)).gap.value])[0];
            let rate = contact.touching(&at).rate();
            assert!((slope - rate).abs() < 1e-7 * (1.0 + rate.abs()), "{index}: {slope} {rate}");
            for constraint in system.constraints().filter(|own| !own.is_released(&at)) {
                let count = constraint.equations();
                let of = |at: &Kinematics| {
                    let mut gradient = vec![0.0; count * constraint.size()];
                    let (mut rates, mut accelerations) = (vec![0.0; count], vec![0.0; count]);
                    violation_rates(constraint, at, &mut gradient, [&mut rates, &mut accelerations]);
                    (rates, accelerations)
                };
                let slopes = difference(|time| of(&moved(&at, time)).0);
                for (slope, found) in slopes.iter().zip(of(&at).1) {
                    assert!(
                        (slope - found).abs() < 1e-6 * (1.0 + found.abs()),
                        "{index} {mode:?}: {slope} {found}"
                    );
                }
            }
        }
    }
}
