//! Elements that represent a weighted sum of neighbouring elements: their forces are that sum, and there are none where forces are not
//! proportional to what differs.

use lissom_flexible::beam::{Beam, SectionLaw};
use lissom_mechanics::elements::Element;
use lissom_mechanics::elements::inertia::{Gravity, Inertia};
use lissom_mechanics::kinematics::{Freedoms, Kinematics, NodeId};
use lissom_motion::{Matrix6, Motion, Vector3, Vector6};
use lissom_system::Builder;

use crate::derivatives::configuration::{Configuration, Random};

/// Weights of a difference of the fourth order, and of something that is none.
const WEIGHTS: [[f64; 4]; 2] = [[1.0, -8.0, 8.0, -1.0], [0.3, 0.2, 0.1, -2.0]];

fn forces(element: &impl Element, at: &Kinematics) -> Vec<f64> {
    let mut out = vec![0.0; element.unknowns().force_count()];
    element.forces(at, &mut out);
    out
}

/// Asserts that the derivative of neighbours exists where it shall, with the sum of their forces.
fn check<E: Element + Sized>(shown: &str, neighbours: &[E; 4], is_proportional: bool, at: &Kinematics) {
    for weights in WEIGHTS {
        let weighed: Vec<(&E, f64)> = neighbours.iter().zip(weights).collect();
        let derivative = E::derivative(&weighed);
        assert_eq!(derivative.is_some(), is_proportional, "{shown}");
        let Some(derivative) = derivative else { continue };
        let mut wanted = vec![0.0; derivative.unknowns().force_count()];
        for (neighbour, weight) in weighed {
            for (sum, force) in wanted.iter_mut().zip(forces(neighbour, at)) {
                *sum += weight * force;
            }
        }
        let most = wanted.iter().fold(1.0, |most: f64, value| most.max(value.abs()));
        for (found, wanted) in forces(&derivative, at).iter().zip(&wanted) {
            assert!((found - wanted).abs() < 1e-11 * most, "{shown}: {found} {wanted}");
        }
    }
}

fn moving(nodes: usize, random: &mut Random) -> Kinematics {
    let mut builder = Builder::new();
    for k in 0..nodes {
        let along = Motion::translation(Vector3::new(0.4 * k as f64, 0.0, 0.0));
        builder.add_node("node", along * Motion::exponential(&(0.2 * random.screw())), Freedoms::Full);
    }
    let (system, state) = builder.build(0.0).expect("valid");
    Configuration::random(&system, &state, 0.1, random).at
}

fn beams<const N: usize>(random: &mut Random) {
    let at = moving(N + 1, random);
    let sections: [Motion; N] =
        std::array::from_fn(|k| Motion::translation(Vector3::new(0.4 * k as f64, 0.0, 0.0)));
    let root = Matrix6::from_fn(|_, _| random.number());
    let stiffness = root * root.transpose() + Matrix6::identity();
    let beam =
        |nodes: [NodeId; N], offset: Option<Motion>, sections: &[Motion; N], factor: f64, damping: f64| {
            Beam::<N>::new(nodes, [offset; N], sections, |xi| SectionLaw {
                stiffness: stiffness * (factor + 0.3 * xi),
                damping,
                free: Vector6::zeros(),
            })
        };
    // The ground is node 0.
    let nodes: [NodeId; N] = std::array::from_fn(|k| NodeId::new(k + 1));
    let factors = [0.8, 0.9, 1.1, 1.2];
    let offset = Motion::translation(Vector3::new(0.0, 0.1, 0.2));
    for damping in [0.0, 0.2] {
        let stiffer = factors.map(|factor| beam(nodes, None, &sections, factor, damping));
        check("stiffness", &stiffer, true, &at);
        let carried = factors.map(|factor| beam(nodes, Some(offset), &sections, factor, damping));
        check("stiffness with offsets", &carried, true, &at);
    }
    let damped = factors.map(|factor| beam(nodes, None, &sections, 1.0, factor));
    check("damping", &damped, false, &at);
    let longer = factors.map(|factor| {
        let sections = sections.map(|section| Motion::translation(factor * section.position));
        beam(nodes, None, &sections, 1.0, 0.0)
    });
    check("length", &longer, false, &at);
    let offsets = factors
        .map(|factor| beam(nodes, Some(Motion::translation(factor * offset.position)), &sections, 1.0, 0.0));
    check("offsets", &offsets, false, &at);
    let mut turned = nodes;
    turned.reverse();
    let others = [nodes, nodes, nodes, turned].map(|nodes| beam(nodes, None, &sections, 1.0, 0.0));
    check("nodes", &others, false, &at);
}

#[test]
fn forces_of_beams_are_proportional_to_stiffness_alone() {
    let mut random = Random::new(21);
    beams::<2>(&mut random);
    beams::<3>(&mut random);
    beams::<4>(&mut random);
}

#[test]
fn forces_of_masses_are_proportional_to_the_mass_alone() {
    let mut random = Random::new(22);
    let at = moving(2, &mut random);
    let gravity = Gravity::constant(random.vector());
    let mass = |factor: f64| {
        Inertia::of_rigid_body(factor, &Vector3::new(0.1, factor, 0.2), &lissom_motion::Matrix3::identity())
    };
    let heavier =
        [0.8, 0.9, 1.1, 1.2].map(|factor| Inertia::new(NodeId::new(1), mass(factor), gravity.clone()));
    check("mass", &heavier, true, &at);
    let other = [0.8, 0.9, 1.1, 1.2].map(|factor| {
        Inertia::new(NodeId::new(1), mass(1.0), Gravity::constant(Vector3::new(0.0, 0.0, -factor)))
    });
    check("gravity", &other, false, &at);
    let others = [1, 1, 2, 1].map(|node| Inertia::new(NodeId::new(node), mass(1.0), gravity.clone()));
    check("node", &others, false, &at);
}
