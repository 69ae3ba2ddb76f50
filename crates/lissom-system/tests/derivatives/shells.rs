//! Shells: their tangents are the derivatives of their forces, these are the gradient of their energy, and nothing but rigid motions is free of
//! energy.

use std::sync::Arc;

use lissom_flexible::pressure::{FacePressure, Pressure, face_points};
use lissom_flexible::shell::Shell;
use lissom_flexible::shell::damping::ShellDamping;
use lissom_flexible::shell::section::{Ply, ShellLaw};
use lissom_mechanics::elements::inertia::Gravity;
use lissom_mechanics::elements::mass_distribution::MassDistribution;
use lissom_mechanics::elements::{Element, OwnInertia, Tangents};
use lissom_mechanics::kinematics::{Freedoms, Kinematics, NodeId};
use lissom_motion::{Motion, Vector3};
use lissom_system::{Builder, State, System};
use nalgebra::DMatrix;

use super::check;
use super::configuration::{Configuration, Random, Wave, difference};

/// A warped element of two layers at an angle.
fn shell(random: &mut Random) -> (System, State, Shell) {
    let mut builder = Builder::new();
    let whole = random.motion();
    let places = [[0.0, 0.0, 0.0], [1.1, 0.1, 0.05], [1.3, 0.9, -0.04], [-0.1, 0.8, 0.1]].map(Vector3::from);
    let frames =
        places.map(|place| whole * Motion::translation(place) * Motion::exponential(&random.screw()));
    let nodes: [NodeId; 4] =
        std::array::from_fn(|i| builder.add_node(&format!("node {i}"), frames[i], Freedoms::Full));
    let normal = |tilt: [f64; 2]| whole.rotation.apply(&Vector3::new(tilt[0], tilt[1], 1.0).normalize());
    let normals = [[0.0, 0.1], [0.1, 0.0], [-0.1, 0.1], [0.05, 0.0]].map(normal);
    let ply = Ply {
        thickness: 0.2,
        angle: 0.4,
        young: [3.0, 1.0],
        poisson: 0.25,
        shear: [0.6, 0.5, 0.4],
        density: 1.0,
        initial: [0.0; 3],
    };
    let law = ShellLaw::laminate(&[ply, Ply { angle: -0.9, ..ply }], 0.07);
    let shell = Shell::new(nodes, &frames, &normals, None, ShellLaw { drilling: 0.05, ..law });
    builder.add_element(shell.clone());
    let (system, state) = builder.build(0.0).expect("valid");
    (system, state, shell)
}

#[test]
fn tangents_of_pressure_are_the_derivatives_of_its_forces() {
    let mut random = Random::new(9);
    let mut builder = Builder::new();
    let nodes =
        std::array::from_fn(|i| builder.add_node(&format!("node {i}"), random.motion(), Freedoms::Full));
    builder.add_element(FacePressure::<4>::new(nodes, face_points(), Pressure::Uniform(Arc::new(Wave))));
    let (system, state) = builder.build(0.0).expect("valid");
    check("pressure", &system, &state, 0.4, &mut random);
}

fn at_rest(mut at: Kinematics) -> Kinematics {
    for node in &mut at.nodes {
        node.twist.fill(0.0);
        node.acceleration.fill(0.0);
    }
    at
}

#[test]
fn tangents_are_the_derivatives_of_forces() {
    let mut random = Random::new(5);
    let (system, state, _) = shell(&mut random);
    check("shell", &system, &state, 0.4, &mut random);
}

#[test]
fn tangents_of_damping_are_the_derivatives_of_its_forces() {
    let mut random = Random::new(8);
    let (_, _, shell) = shell(&mut random);
    let mut builder = Builder::new();
    for _ in 0..4 {
        builder.add_node("node", random.motion(), Freedoms::Full);
    }
    builder.add_element(ShellDamping::new(Arc::new(shell), 0.3));
    let (system, state) = builder.build(0.0).expect("valid");
    check("damping of a shell", &system, &state, 0.4, &mut random);
}

#[test]
fn forces_are_the_gradient_of_the_energy() {
    let mut random = Random::new(6);
    let (system, state, shell) = shell(&mut random);
    assert!(shell.energy(&state.kinematics).strain.abs() < 1e-28);
    let here = Configuration::random(&system, &state, 0.3, &mut random);
    let mut forces = vec![0.0; 24];
    shell.forces(&at_rest(here.at.clone()), &mut forces);
    for (column, force) in forces.iter().enumerate() {
        let slope =
            difference(|step| vec![shell.energy(&here.displaced(&system, column, step, false).at).strain])[0];
        assert!((force - slope).abs() < 1e-8 * (1.0 + force.abs()), "{column}: {force}, {slope}");
    }
}

#[test]
fn only_rigid_motions_are_without_energy() {
    let mut random = Random::new(7);
    let (_, state, shell) = shell(&mut random);
    let mut tangents = Tangents::new(24);
    shell.linearize(&state.kinematics, &mut tangents);
    let stiffness = DMatrix::from_row_slice(24, 24, &tangents.stiffness);
    assert!((&stiffness - stiffness.transpose()).amax() < 1e-14 * stiffness.amax());
    let mut values: Vec<f64> = stiffness.symmetric_eigenvalues().iter().copied().collect();
    values.sort_by(f64::total_cmp);
    assert!(values[..6].iter().all(|value| value.abs() < 1e-14 * values[23]), "{values:?}");
    assert!(values[6] > 1e-4 * values[23], "{values:?}");
}

#[test]
fn a_rigid_motion_changes_nothing() {
    let mut random = Random::new(8);
    let (system, state, shell) = shell(&mut random);
    let here = at_rest(Configuration::random(&system, &state, 0.3, &mut random).at);
    let motion = random.motion();
    let mut there = here.clone();
    for node in &mut there.nodes {
        node.frame = motion * node.frame;
    }
    let forces = |at: &Kinematics| {
        let mut forces = vec![0.0; 24];
        shell.forces(at, &mut forces);
        forces
    };
    let (one, other) = (forces(&here), forces(&there));
    let largest = one.iter().fold(0.0_f64, |most, force| most.max(force.abs()));
    assert!(one.iter().zip(&other).all(|(a, b)| (a - b).abs() < 1e-13 * largest), "{one:?}\n{other:?}");
}

/// A mass matrix on points beside the nodes.
fn distribution(nodes: [NodeId; 4], random: &mut Random) -> MassDistribution<4, 6> {
    let points = std::array::from_fn(|k| (k % 4, random.vector()));
    let mut matrix = Box::new([[0.0; 6]; 6]);
    for i in 0..6 {
        for j in 0..=i {
            let entry = random.number();
            (matrix[i][j], matrix[j][i]) = (entry, entry);
        }
    }
    let gravity = Gravity { acceleration: random.vector(), factor: Some(Arc::new(Wave)) };
    MassDistribution::new(nodes, points, matrix, &std::array::from_fn(|_| random.number()), gravity)
}

#[test]
fn tangents_of_a_mass_distribution_are_the_derivatives_of_its_forces() {
    let mut random = Random::new(11);
    let mut builder = Builder::new();
    let nodes =
        std::array::from_fn(|i| builder.add_node(&format!("node {i}"), random.motion(), Freedoms::Full));
    builder.add_element(distribution(nodes, &mut random));
    let (system, state) = builder.build(0.0).expect("valid");
    check("distribution of mass", &system, &state, 0.4, &mut random);
}

/// The kinetic energy is that of the mass matrix, which is the derivative of the forces by the accelerations.
#[test]
fn a_mass_distribution_has_one_mass_matrix() {
    let mut random = Random::new(12);
    let mut builder = Builder::new();
    let nodes =
        std::array::from_fn(|i| builder.add_node(&format!("node {i}"), random.motion(), Freedoms::Full));
    let element = distribution(nodes, &mut random);
    let (system, state) = builder.build(0.0).expect("valid");
    let at = Configuration::random(&system, &state, 0.3, &mut random).at;
    let (mut matrix, mut tangents) = (Vec::new(), Tangents::new(24));
    element.mass(&at, &mut matrix);
    element.linearize(&at, &mut tangents);
    assert!(matrix.iter().zip(&tangents.mass).all(|(one, other)| (one - other).abs() < 1e-14));
    let rates: Vec<f64> = element.unknowns().rates(&at).collect();
    let matrix = DMatrix::from_row_slice(24, 24, &matrix);
    let rates = nalgebra::DVector::from_vec(rates);
    let expected = 0.5 * rates.dot(&(&matrix * &rates));
    let found = element.energy(&at).kinetic;
    assert!((found - expected).abs() < 1e-13 * expected.abs().max(1.0), "{found}, {expected}");
}

/// Free strains that are the same everywhere are those at every point of a flat element of any shape.
#[test]
fn free_strains_are_uniform_in_a_flat_element() {
    let places = [[0.0, 0.0, 0.0], [1.1, 0.1, 0.0], [1.3, 0.9, 0.0], [-0.1, 0.8, 0.0]].map(Vector3::from);
    let mut builder = Builder::new();
    let frames = places.map(Motion::translation);
    let nodes = std::array::from_fn(|i| builder.add_node(&format!("node {i}"), frames[i], Freedoms::Full));
    let ply = Ply { initial: [0.1, -0.05, 0.02], ..Ply::isotropic(0.2, 3.0, 0.3, 1.0) };
    let law = ShellLaw::laminate(&[ply, Ply::isotropic(0.1, 2.0, 0.1, 1.0)], 0.07);
    let free = law.free;
    let shell = Shell::new(nodes, &frames, &[Vector3::z(); 4], None, law);
    let (_, state) = builder.build(0.0).expect("valid");
    for place in [(0.0, 0.0), (0.7, -0.3), (-1.0, 1.0)] {
        let strains = shell.strains_at(&state.kinematics, place);
        for (k, free) in free.iter().enumerate() {
            assert!((strains[k] + free).abs() < 1e-15, "{strains:?}, {free:?}");
        }
    }
}
