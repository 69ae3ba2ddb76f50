//! Solids: their tangents are the derivatives of their forces, these are the gradient of their energy, and nothing but rigid motions is free of
//! energy.

use std::sync::Arc;

use lissom_flexible::pressure::{FacePressure, Pressure, face_points};
use lissom_flexible::solid::damping::SolidDamping;
use lissom_flexible::solid::law::{SolidLaw, SolidModel};
use lissom_flexible::solid::{Solid, SolidElement};
use lissom_mechanics::elements::{Deformable, Element, Tangents};
use lissom_mechanics::kinematics::{Freedoms, Kinematics, NodeId, Stressed};
use lissom_mesh::kinds::face::area_shares;
use lissom_mesh::kinds::{SOLID_KINDS, SolidKind};
use lissom_motion::{Motion, Rotation, Vector3};
use lissom_system::{Builder, State, System};
use nalgebra::DMatrix;

use super::check;
use super::configuration::{Configuration, Random, Wave, difference};

/// Models with Poisson's ratios and shares of the second term in the shear modulus.
const LAWS: [(SolidModel, f64, f64); 4] = [
    (SolidModel::StVenantKirchhoff, 0.3, 0.0),
    (SolidModel::Rubber, 0.35, 0.0),
    (SolidModel::Rubber, 0.45, 0.0),
    (SolidModel::Rubber, 0.45, 0.4),
];

fn law_of((model, poisson, second): (SolidModel, f64, f64)) -> SolidLaw {
    let law = SolidLaw::new(model, 3.0, poisson);
    SolidLaw { second: second * law.shear, ..law }
}

fn nodes<const NODES: usize>(builder: &mut Builder, positions: &[Vector3; NODES]) -> [NodeId; NODES] {
    std::array::from_fn(|i| {
        builder.add_node(&format!("node {i}"), Motion::translation(positions[i]), Freedoms::Translations)
    })
}

/// An element with distorted positions and curved edges.
fn solid<const NODES: usize, const POINTS: usize>(
    kind: usize,
    random: &mut Random,
    law: (SolidModel, f64, f64),
    expansion: f64,
) -> (System, State, Solid<NODES, POINTS>) {
    let kind: &'static SolidKind = SOLID_KINDS[kind];
    let mut builder = Builder::new();
    let positions = std::array::from_fn(|i| Vector3::from(kind.node(i)) + 0.05 * random.vector());
    let free = std::array::from_fn(|i| expansion * i as f64);
    let solid =
        Solid::new(kind, nodes(&mut builder, &positions), (&positions, &free), law_of(law)).expect("valid");
    builder.add_element(solid.clone());
    let (system, state) = builder.build(0.0).expect("valid");
    (system, state, solid)
}

fn hexahedron(random: &mut Random, law: (SolidModel, f64, f64)) -> (System, State, Solid<20, 21>) {
    solid(1, random, law, 0.0)
}

/// Calls a function with all shapes and laws.
macro_rules! for_all {
    ($random:ident, $check:ident) => {
        for_all!($random, $check, 0.0)
    };
    ($random:ident, $check:ident, $expansion:expr) => {
        for law in LAWS {
            let (system, state, own) = solid::<10, 4>(0, &mut $random, law, $expansion);
            $check(&system, &state, &own, &mut $random);
            let (system, state, own) = solid::<20, 21>(1, &mut $random, law, $expansion);
            $check(&system, &state, &own, &mut $random);
            let (system, state, own) = solid::<15, 9>(2, &mut $random, law, $expansion);
            $check(&system, &state, &own, &mut $random);
        }
    };
}

fn deformed(system: &System, state: &State, random: &mut Random) -> Kinematics {
    let mut at = Configuration::random(system, state, 0.04, random).at;
    for node in &mut at.nodes {
        node.twist.fill(0.0);
        node.acceleration.fill(0.0);
    }
    at
}

fn forces(solid: &impl Element, at: &Kinematics) -> Vec<f64> {
    let mut forces = vec![0.0; solid.unknowns().force_count()];
    solid.forces(at, &mut forces);
    forces
}

#[test]
fn tangents_are_the_derivatives_of_forces() {
    fn derivatives(system: &System, state: &State, _: &impl Element, random: &mut Random) {
        check("solid", system, state, 0.04, random);
    }
    let mut random = Random::new(5);
    for_all!(random, derivatives);
    // Hot ones.
    for_all!(random, derivatives, 0.01);
}

#[test]
fn tangents_of_damping_are_the_derivatives_of_its_forces() {
    fn damped<const NODES: usize, const POINTS: usize>(
        positions: &[Vector3; NODES],
        solid: &Solid<NODES, POINTS>,
        random: &mut Random,
    ) {
        let mut builder = Builder::new();
        nodes(&mut builder, positions);
        builder.add_element(SolidDamping::new(solid.clone(), 0.4));
        let (system, state) = builder.build(0.0).expect("valid");
        check("damping", &system, &state, 0.04, random);
        // A rigid rotation about the origin.
        let mut at = deformed(&system, &state, random);
        let spin = random.vector();
        at.nodes.iter_mut().for_each(|node| {
            node.twist.fixed_rows_mut::<3>(0).copy_from(&spin.cross(&node.frame.position));
        });
        let forces = forces(&SolidDamping::new(solid.clone(), 0.4), &at);
        assert!(forces.iter().all(|force| force.abs() < 1e-13), "{forces:?}");
    }
    let mut random = Random::new(12);
    for law in LAWS {
        let (_, state, own) = solid::<10, 4>(0, &mut random, law, 0.0);
        damped(&own.positions(&state.kinematics), &own, &mut random);
        let (_, state, own) = solid::<20, 21>(1, &mut random, law, 0.0);
        damped(&own.positions(&state.kinematics), &own, &mut random);
    }
}

#[test]
fn tangents_of_pressure_are_the_derivatives_of_its_forces() {
    let mut random = Random::new(9);
    let mut builder = Builder::new();
    let places: [Vector3; 14] = std::array::from_fn(|_| random.vector());
    let all = nodes(&mut builder, &places);
    builder.add_element(FacePressure::<6>::new(
        std::array::from_fn(|i| all[i]),
        face_points(),
        Pressure::Uniform(Arc::new(Wave)),
    ));
    builder.add_element(FacePressure::<8>::new(
        std::array::from_fn(|i| all[6 + i]),
        face_points(),
        Pressure::Uniform(Arc::new(Wave)),
    ));
    let (system, state) = builder.build(0.0).expect("valid");
    check("pressure", &system, &state, 0.4, &mut random);
}

#[test]
fn forces_are_the_gradient_of_the_energy() {
    fn gradient(system: &System, state: &State, solid: &impl Element, random: &mut Random) {
        assert!(solid.energy(&state.kinematics).strain.abs() < 1e-28);
        let mut here = Configuration::random(system, state, 0.04, random);
        here.at.nodes.iter_mut().for_each(|node| node.twist.fill(0.0));
        let forces = forces(solid, &here.at);
        let largest = forces.iter().fold(0.0_f64, |most, force| most.max(force.abs()));
        assert!(largest > 0.01);
        for column in 0..system.layout().size() {
            let slope =
                difference(|step| vec![solid.energy(&here.displaced(system, column, step, false).at).strain])
                    [0];
            let force = forces[6 * (column / 3) + column % 3];
            assert!((force - slope).abs() < 1e-8 * largest, "{column}: {force}, {slope}");
        }
    }
    let mut random = Random::new(6);
    for_all!(random, gradient);
}

#[test]
fn only_rigid_motions_are_without_energy() {
    fn modes(_: &System, state: &State, solid: &impl Element, _: &mut Random) {
        let size = solid.unknowns().force_count();
        let mut tangents = Tangents::new(size);
        solid.linearize(&state.kinematics, &mut tangents);
        let full = DMatrix::from_row_slice(size, size, &tangents.stiffness);
        let moving: Vec<usize> = (0..size).filter(|k| k % 6 < 3).collect();
        let stiffness = full.select_rows(&moving).select_columns(&moving);
        assert!((&stiffness - stiffness.transpose()).amax() < 1e-14 * stiffness.amax());
        let mut values: Vec<f64> = stiffness.symmetric_eigenvalues().iter().copied().collect();
        values.sort_by(f64::total_cmp);
        let largest = values[values.len() - 1];
        assert!(values[..6].iter().all(|value| value.abs() < 1e-14 * largest), "{values:?}");
        assert!(values[6] > 1e-4 * largest, "{values:?}");
    }
    let mut random = Random::new(7);
    for_all!(random, modes);
}

#[test]
fn a_rigid_motion_changes_nothing() {
    fn rigid(system: &System, state: &State, solid: &impl Element, random: &mut Random) {
        let here = deformed(system, state, random);
        let (turn, shift) = (Rotation::exponential(&(2.0 * random.vector())), random.vector());
        let mut there = here.clone();
        for node in &mut there.nodes {
            node.frame.position = shift + turn.apply(&node.frame.position);
        }
        let (one, other) = (forces(solid, &here), forces(solid, &there));
        let largest = one.iter().fold(0.0_f64, |most, force| most.max(force.abs()));
        for (one, other) in one.chunks_exact(6).zip(other.chunks_exact(6)) {
            let turned = turn.apply(&Vector3::new(one[0], one[1], one[2]));
            assert!((0..3).all(|k| (turned[k] - other[k]).abs() < 1e-13 * largest), "{one:?}\n{other:?}");
        }
        let energies = [&here, &there].map(|at| solid.energy(at).strain);
        assert!((energies[0] - energies[1]).abs() < 1e-13 * energies[0], "{energies:?}");
    }
    let mut random = Random::new(8);
    for_all!(random, rigid);
}

#[test]
fn stresses_are_predicted_to_first_order() {
    [LAWS[0], LAWS[2]].into_iter().for_each(predicted);
}

fn predicted(law: (SolidModel, f64, f64)) {
    let mut random = Random::new(10);
    let (system, state, solid) = hexahedron(&mut random, law);
    let here = deformed(&system, &state, &mut random);
    let way: Vec<Vector3> = here.nodes.iter().map(|_| random.vector()).collect();
    // The tangent with stresses predicted over a distance differs from the exact one quadratically.
    let error = |distance: f64| {
        let mut there = here.clone();
        there.nodes.iter_mut().zip(&way).for_each(|(node, way)| node.frame.position += distance * way);
        let tangent = |previous: Option<&Kinematics>| {
            let mut tangents = Tangents::new(120);
            solid.linearize_stressed(&there, Stressed { at: &there, previous }, &mut tangents);
            DMatrix::from_row_slice(120, 120, &tangents.stiffness)
        };
        (tangent(Some(&here)) - tangent(None)).amax()
    };
    let errors = [1e-2, 1e-3].map(error);
    assert!(errors[0] > 1e-6 && (90.0..110.0).contains(&(errors[0] / errors[1])), "{errors:?}");
}

#[test]
fn forces_of_an_element_that_is_turned_inside_out_are_no_numbers() {
    fn inside_out(_: &System, state: &State, solid: &impl Element, _: &mut Random) {
        let mut at = state.kinematics.clone();
        at.nodes.iter_mut().for_each(|node| node.frame.position.z *= -1.0);
        assert!(forces(solid, &at)[0].is_nan());
    }
    let mut random = Random::new(11);
    for_all!(random, inside_out);
}

#[test]
fn shares_of_nodes_are_volumes_and_areas_of_a_uniform_load() {
    // Of corners and middles; those of a wedge are as of its triangle and its line.
    let corner_and_middle = [(-1.0 / 120.0, 1.0 / 30.0, 1e-14), (-1.0, 4.0 / 3.0, 1e-13)];
    for (kind, (corner, middle, tolerance)) in SOLID_KINDS.into_iter().zip(corner_and_middle) {
        let regular: Vec<Vector3> = (0..kind.node_count()).map(|i| kind.node(i).into()).collect();
        for (i, share) in kind.shares(&regular).expect("valid").iter().enumerate() {
            let expected = if i < kind.corners.len() { corner } else { middle };
            assert!((share - expected).abs() < tolerance, "{}: {i} {share}", kind.word);
        }
    }
    let [tetrahedron, hexahedron, _] = SOLID_KINDS;
    // Corners have a negative share in a square, and none in a triangle.
    let square: Vec<Vector3> = [4, 5, 6, 7, 12, 13, 14, 15].map(|i| hexahedron.node(i).into()).to_vec();
    let shares = area_shares(&square);
    for (i, share) in shares.iter().enumerate() {
        assert!((share - if i < 4 { -1.0 / 3.0 } else { 4.0 / 3.0 }).abs() < 1e-14, "{shares:?}");
    }
    let triangle: Vec<Vector3> = [0, 1, 2, 4, 5, 6].map(|i| tetrahedron.node(i).into()).to_vec();
    let shares = area_shares(&triangle);
    for (i, share) in shares.iter().enumerate() {
        assert!((share - if i < 3 { 0.0 } else { 1.0 / 6.0 }).abs() < 1e-14, "{shares:?}");
    }
}

#[test]
fn stresses_at_nodes_are_those_of_a_uniform_strain() {
    fn uniform(at: &Kinematics, stresses: &[lissom_motion::Matrix3]) {
        let exact = stresses[0];
        assert!(at.nodes.len() > 10 && exact.amax() > 0.01);
        assert!(stresses.iter().all(|own| (own - exact).amax() < 1e-13), "{stresses:?}");
    }
    let mut random = Random::new(13);
    for law in LAWS {
        let stretch =
            nalgebra::Matrix3::identity() + 0.05 * nalgebra::Matrix3::from_fn(|_, _| random.number());
        let strained = |state: &State| {
            let mut at = state.kinematics.clone();
            at.nodes.iter_mut().for_each(|node| node.frame.position = stretch * node.frame.position);
            at
        };
        let (_, state, own) = solid::<10, 4>(0, &mut random, law, 0.0);
        uniform(&strained(&state), &own.nodal_stresses(&own.positions(&strained(&state))));
        let (_, state, own) = solid::<15, 9>(2, &mut random, law, 0.0);
        uniform(&strained(&state), &own.nodal_stresses(&own.positions(&strained(&state))));
        let (_, state, solid) = hexahedron(&mut random, law);
        let at = strained(&state);
        uniform(&at, &solid.nodal_stresses(&solid.positions(&at)));
        // Work of the forces by virial: Σ f xᵀ = V σ.
        let forces = forces(&solid, &at);
        let virial: nalgebra::Matrix3<f64> = (0..20)
            .map(|i| {
                let force = Vector3::new(forces[6 * i], forces[6 * i + 1], forces[6 * i + 2]);
                force * at.nodes[solid.nodes()[i]].frame.position.transpose()
            })
            .sum();
        let stress = solid.nodal_stresses(&solid.positions(&at))[0] * stretch.determinant() * solid.volume();
        assert!((virial - stress).amax() < 1e-12, "{virial}{stress}");
    }
}
