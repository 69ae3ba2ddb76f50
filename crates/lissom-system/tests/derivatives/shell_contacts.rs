//! Contacts of balls with elements of shells: derivatives, energy and momentum, within an element, between elements, at edges and corners.

use lissom_contact::elastic::ContactFriction;
use lissom_contact::law::Coulomb;
use lissom_contact::of_shells::{ShellContact, contact_patches};
use lissom_flexible::shell::section::{Ply, ShellLaw};
use lissom_flexible::shell::surface::{ShellSection, SurfaceDescription, shell_surface};
use lissom_mechanics::compliance::Compliance;
use lissom_mechanics::elements::{Contribution, Element};
use lissom_mechanics::kinematics::{Freedoms, GROUND, Kinematics};
use lissom_mesh::{MeshShape, MeshedPart};
use lissom_motion::{Motion, Vector3};
use lissom_system::{Builder, State, System};

use crate::derivatives::check;
use crate::derivatives::configuration::{Configuration, Random, difference};

/// Radius of the ball, thickness of the shell, and size of an element.
const RADIUS: f64 = 4.0;
const THICKNESS: f64 = 1.0;
const SIZE: f64 = 90.0;

/// Height of a curved surface.
fn height(x: f64, y: f64) -> f64 {
    -0.0001 * x * x + 0.00006 * x * y - 0.00004 * y * y
}

/// Four elements, and a ball on one of their sides that touches at a point, in the direction of the normal or inclined to it. The forces of the
/// shell itself are small.
fn model(
    [x, y, side, tilt]: [f64; 4],
    (seed, is_fixed): (u64, bool),
    friction: Option<ContactFriction>,
) -> (System, State, Vec<ShellContact>, Random) {
    let mut random = Random::new(seed);
    let mut builder = Builder::new();
    let depth = 1.5;
    let above = RADIUS + 0.5 * THICKNESS - depth;
    let normal = Vector3::new(0.0002 * x - 0.00006 * y, 0.00008 * y - 0.00006 * x, 1.0).normalize();
    let direction = (side * normal + tilt * Vector3::new(1.0, 0.3, 0.0)).normalize();
    let centre = Vector3::new(x, y, height(x, y)) + above * direction;
    let (ball, own) = if is_fixed {
        (GROUND, centre)
    } else {
        let mut frame = random.motion();
        let own = random.vector();
        frame.position = centre - frame.rotation.apply(&own);
        (builder.add_node("ball", frame, Freedoms::Full), own)
    };
    let grid: Vec<Vector3> = (0..9)
        .map(|k| {
            // Not quite a regular mesh.
            let wave = [0.0, 6.3, -4.5][k % 3];
            let [u, v] = [k % 3, k / 3].map(|i| SIZE * (i as f64 - 1.0));
            let [u, v] = [u + if k == 4 { 5.4 } else { 0.0 }, v + wave];
            Vector3::new(u, v, height(u, v))
        })
        .collect();
    let elements = [[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]];
    let elements =
        elements.map(|own| lissom_mesh::Element { shape: MeshShape::Quadrilateral4, nodes: own.to_vec() });
    let mesh = MeshedPart { positions: grid, elements: elements.to_vec(), ..MeshedPart::default() };
    let ply = Ply {
        thickness: 1e-3,
        angle: 0.0,
        young: [1e-3; 2],
        poisson: 0.2,
        shear: [1e-3; 3],
        density: 1.0,
        initial: [0.0; 3],
    };
    let (contribution, surface) = shell_surface(
        builder.model(),
        &SurfaceDescription {
            mesh: &mesh,
            names: &|node| format!("node {node}"),
            fold_angle: 0.5,
            direction: None,
            damping: 0.0,
            section: &|_| ShellSection {
                law: ShellLaw::laminate(&[ply], 0.0),
                mass: 1e-3,
                center: 0.0,
                inertia: 1e-3,
                tension: 0.0,
            },
        },
    );
    builder.add(contribution);
    let friction = friction.map(|law| {
        let mut contribution = Contribution::to(builder.model());
        let law = law.with_bristles("bristle", &mut contribution);
        builder.add(contribution);
        law
    });
    let compliance = Compliance { stiffness: 3.0, exponent: if seed.is_multiple_of(2) { 1.0 } else { 1.5 } };
    let law = (compliance, if friction.is_some() { 0.1 } else { 0.0 });
    let contacts: Vec<ShellContact> = contact_patches(builder.model(), &surface.elements)
        .into_iter()
        .enumerate()
        .map(|(k, patch)| {
            let friction = friction.as_ref().map(|law| (law, k == 0));
            ShellContact::new(((ball, own), RADIUS), (patch, THICKNESS), law, friction)
        })
        .collect();
    for contact in &contacts {
        builder.add(Contribution::of(builder.model(), contact.clone()));
    }
    let (system, state) = builder.build(0.0).expect("valid");
    (system, state, contacts, random)
}

fn rough() -> ContactFriction {
    ContactFriction {
        bristles: Vec::new(),
        law: Coulomb { sliding: 0.4, at_rest: 0.7, stribeck: 40.0 },
        deflection: 4.0,
    }
}

/// Within an element on both sides, where two and four overlap, at an edge and at a corner of the surface.
const PLACES: [[f64; 4]; 6] = [
    [36.0, 27.0, 1.0, 0.0],
    [-27.0, 45.0, -1.0, 0.0],
    [3.1, 45.0, 1.0, 0.0],
    [5.4, 6.3, -1.0, 0.0],
    [90.0, 27.0, 1.0, 0.6],
    [90.0, 85.5, -1.0, 0.6],
];

#[test]
fn derivatives_of_shell_contacts_are_those_of_differences() {
    for (index, place) in PLACES.into_iter().enumerate() {
        for seed in [3, 4] {
            for friction in [None, Some(rough())] {
                let (system, state, contacts, mut random) = model(place, (seed, index == 1), friction);
                let strain: f64 = contacts.iter().map(|own| own.energy(&state.kinematics).strain).sum();
                assert!(strain > 0.05, "{index}: {strain}");
                check(&format!("shell contact {index}"), &system, &state, 0.002, &mut random);
            }
        }
    }
}

fn at_rest(mut here: Configuration) -> Configuration {
    for node in &mut here.at.nodes {
        node.twist.fill(0.0);
        node.acceleration.fill(0.0);
    }
    here
}

/// Without friction the forces at rest are the gradient of the energy; not where elements overlap, as the sum of the gradients of their
/// shares vanishes only if they have the same gap.
#[test]
fn normal_forces_on_shells_are_the_gradient_of_their_energy() {
    for (index, place) in PLACES.into_iter().enumerate().filter(|(index, _)| !(2..4).contains(index)) {
        let (system, state, _, mut random) = model(place, (30 + index as u64, false), None);
        let here = at_rest(Configuration::random(&system, &state, 0.02, &mut random));
        let energy = |at: &Configuration| vec![system.energy(&at.at).total()];
        for (row, force) in here.residual(&system, 0.0).iter().enumerate() {
            let slope = difference(|step| energy(&here.displaced(&system, row, step, false)))[0];
            assert!((force - slope).abs() < 1e-7 * (1.0 + force.abs()), "{index} {row}: {force} {slope}");
        }
    }
}

/// Forces and moments of a contact on all nodes have no sum, with friction as well.
#[test]
fn shell_contacts_keep_momentum() {
    for (index, place) in PLACES.into_iter().enumerate() {
        let (system, state, contacts, mut random) = model(place, (110 + index as u64, false), Some(rough()));
        let mut here = Configuration::random(&system, &state, 0.02, &mut random);
        // Slow, so that the ball does not leave.
        here.at.nodes.iter_mut().for_each(|node| node.twist *= 0.05);
        let at: &Kinematics = &here.at;
        let [mut force, mut moment, mut largest] = [Vector3::zeros(), Vector3::zeros(), Vector3::zeros()];
        for contact in &contacts {
            let mut out = [0.0; 33];
            contact.forces(at, &mut out);
            for (k, &node) in contact.unknowns().nodes.iter().enumerate() {
                let Motion { rotation, position } = at.nodes[node].frame;
                let own = |first: usize| rotation.apply(&Vector3::from_column_slice(&out[first..first + 3]));
                let (f, m) = (own(6 * k), own(6 * k + 3));
                force += f;
                moment += position.cross(&f) + m;
                largest = if f.norm() > largest.norm() { f } else { largest };
            }
        }
        assert!(largest.norm() > 0.1, "{index}");
        assert!(force.norm() < 1e-13 * (1.0 + largest.norm()), "{index}: {force}");
        assert!(moment.norm() < 1e-12 * (1.0 + largest.norm()), "{index}: {moment}");
    }
}
