//! Superelements: derivatives, invariance under rigid motion, conservation, and what matrices are rejected.

use lissom_flexible::superelement::{
    Damping, GeometricMatrices, InterfacePlace, ReducedMatrices, Shortening, Superelement,
    SuperelementDescription, TurningMatrices, superelement,
};
use lissom_mechanics::elements::inertia::Gravity;
use lissom_mechanics::elements::{Deformable, LimitKind, Place, Validity};
use lissom_mechanics::kinematics::{Freedoms, NodeId};
use lissom_motion::{Motion, Vector3};
use lissom_system::{Builder, State, System};
use nalgebra::{DMatrix, DVector};

use crate::derivatives::check;
use crate::derivatives::configuration::{Configuration, Random};

/// A symmetric positive matrix.
fn positive(size: usize, random: &mut Random) -> DMatrix<f64> {
    let root = DMatrix::from_fn(size, size, |_, _| random.number());
    &root * root.transpose() + DMatrix::identity(size, size)
}

/// Second-order matrices that are symmetric where they must be, and nothing else.
fn second_order(interfaces: usize, size: usize, random: &mut Random) -> GeometricMatrices {
    // Small, so that third derivatives do not spoil differences.
    let mut any = || DMatrix::from_fn(size, size, |_, _| 0.2 * random.number());
    let mut symmetric = || {
        let own = any();
        &own + own.transpose()
    };
    let moment = [0, 1, 2].map(|_| symmetric());
    let inertia = [(); 2].map(|()| [0, 1, 2, 3, 4, 5].map(|_| symmetric()));
    let matrices: Vec<_> = (0..interfaces).map(|_| symmetric()).collect();
    let momentum = [(); 2].map(|()| [0, 1, 2].map(|_| any()));
    let shortening = matrices
        .into_iter()
        .map(|matrix| Shortening { direction: DVector::from_fn(size, |_, _| 0.3 * random.number()), matrix });
    let shortening = shortening.collect();
    let slopes = [(); 2].map(|()| DMatrix::from_fn(6, size, |_, _| random.number()));
    let [points, sections] = [0, 1].map(|k| TurningMatrices {
        slope: slopes[k].clone(),
        inertia: inertia[k].clone(),
        momentum: momentum[k].clone(),
    });
    GeometricMatrices { moment, points, sections, shortening }
}

fn system_with(
    (interfaces, modes, frame): (usize, usize, usize),
    is_geometric: bool,
    random: &mut Random,
) -> (System, State) {
    let mut builder = Builder::new();
    builder.set_gravity(random.vector());
    let part = random.motion();
    let places: Vec<Vector3> = (0..interfaces).map(|_| random.vector()).collect();
    let nodes = places.iter().enumerate().map(|(i, place)| {
        let near = part * Motion::translation(*place) * Motion::exponential(&(0.2 * random.screw()));
        builder.add_node(&format!("interface {i}"), near, Freedoms::Full)
    });
    let nodes = nodes.collect();
    let size = 6 * interfaces + modes;
    let matrices = ReducedMatrices {
        mass: positive(size, random),
        stiffness: positive(size, random),
        damping: Damping::Matrix(positive(size, random)),
        preload: (0..size).map(|_| random.number()).collect(),
        geometric: is_geometric.then(|| Box::new(second_order(interfaces, size, random))),
    };
    let coordinates = (0..modes).map(|k| builder.add_state(&format!("mode {k}"), 0.1, 1.0)).collect();
    let gravity = Gravity::constant(random.vector());
    builder.add_element(Superelement::new((nodes, coordinates), (frame, &places), matrices, gravity));
    builder.build(0.0).expect("valid")
}

#[test]
fn derivatives_of_superelements() {
    for (interfaces, modes, frame) in [(1, 0, 0), (2, 2, 0), (3, 1, 1), (1, 2, 0)] {
        for is_geometric in [false, true] {
            let mut random = Random::new(interfaces as u64);
            let (system, state) = system_with((interfaces, modes, frame), is_geometric, &mut random);
            check("superelement", &system, &state, 0.2, &mut random);
        }
    }
}

/// The elastic forces are the gradient of the energy: without motion and damping all of the residual is.
#[test]
fn forces_at_rest_are_the_gradient_of_the_energy() {
    for is_geometric in [false, true] {
        let mut random = Random::new(5);
        let (system, state) = system_with((3, 2, 2), is_geometric, &mut random);
        is_the_gradient(&system, &state, &mut random);
    }
}

fn is_the_gradient(system: &System, state: &State, random: &mut Random) {
    let mut here = Configuration::random(system, state, 0.3, random);
    for node in &mut here.at.nodes {
        node.twist.fill(0.0);
        node.acceleration.fill(0.0);
    }
    for coordinate in &mut here.at.coordinates {
        (coordinate.rate, coordinate.acceleration) = (0.0, 0.0);
    }
    let forces = here.residual(system, 0.0);
    for (row, force) in forces.iter().enumerate() {
        let slope = crate::derivatives::configuration::difference(|step| {
            vec![system.energy(&here.displaced(system, row, step, false).at).total()]
        })[0];
        assert!((force - slope).abs() < 1e-8 * (1.0 + force.abs()), "row {row}: {force}, slope {slope}");
    }
}

/// Power of the inertial forces is the change of the kinetic energy, and they sum up to the change of momentum.
#[test]
fn inertial_forces_change_energy_and_momentum() {
    for is_geometric in [false, true] {
        inertial_forces_change_both(is_geometric);
    }
}

fn inertial_forces_change_both(is_geometric: bool) {
    let mut random = Random::new(6);
    let mut builder = Builder::new();
    let places = [Vector3::zeros(), Vector3::new(1.0, 0.2, -0.1)];
    let nodes: Vec<_> = places
        .iter()
        .map(|place| {
            let near = Motion::translation(*place) * Motion::exponential(&(0.3 * random.screw()));
            builder.add_node("interface", near, Freedoms::Full)
        })
        .collect();
    let matrices = ReducedMatrices {
        mass: positive(12, &mut random),
        stiffness: DMatrix::zeros(12, 12),
        damping: Damping::None,
        preload: Vec::new(),
        geometric: is_geometric.then(|| Box::new(second_order(2, 12, &mut random))),
    };
    let gravity = Gravity::constant(Vector3::zeros());
    builder.add_element(Superelement::new((nodes, Vec::new()), (1, &places), matrices, gravity));
    let (system, state) = builder.build(0.0).expect("valid");
    let here = Configuration::random(&system, &state, 0.3, &mut random);
    let along = |time: f64| {
        let mut at = here.at.clone();
        for node in &mut at.nodes {
            // The twist changes linearly: to second order in time the increment is t V + ½ t² V̇.
            let psi = time * node.twist + 0.5 * time * time * node.acceleration;
            node.frame = node.frame * Motion::exponential(&psi);
            node.twist += time * node.acceleration;
        }
        let (linear, angular) = system.momentum(&at);
        let mut numbers = vec![system.energy(&at).kinetic];
        numbers.extend(linear.iter().chain(angular.iter()));
        numbers
    };
    // Second order in time is enough for the first derivative at zero.
    let step = 1e-5;
    let (plus, minus) = (along(step), along(-step));
    let found: Vec<f64> = plus.iter().zip(&minus).map(|(a, b)| (a - b) / (2.0 * step)).collect();
    let forces = here.residual(&system, 0.0);
    let mut expected = [0.0; 7];
    for node in system.layout().nodes().skip(1) {
        let rows = system.layout().rows_of_node(node);
        let part = |first: usize| Vector3::from_fn(|k, _| forces[rows[first + k] as usize]);
        let motion = &here.at.nodes[node];
        for k in 0..6 {
            expected[0] += forces[rows[k] as usize] * motion.twist[k];
        }
        let (force, moment) = (motion.frame.rotation.apply(&part(0)), motion.frame.rotation.apply(&part(3)));
        let moment = moment + motion.frame.position.cross(&force);
        for k in 0..3 {
            expected[1 + k] += force[k];
            expected[4 + k] += moment[k];
        }
    }
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-6 * (1.0 + expected.abs()), "{found}, expected {expected}");
    }
}

/// Three interfaces, undeformed and somewhere in space; the second carries the floating frame, and the third is the farthest: 5 m.
fn three_interfaces() -> (Superelement, State) {
    let mut random = Random::new(12);
    let places = [Vector3::new(2.0, 0.0, 0.0), Vector3::zeros(), Vector3::new(0.0, 4.0, 3.0)];
    let mut builder = Builder::new();
    let part = random.motion();
    let nodes: Vec<_> = (places.iter())
        .map(|place| builder.add_node("interface", part * Motion::translation(*place), Freedoms::Full))
        .collect();
    let matrices = ReducedMatrices {
        mass: positive(18, &mut random),
        stiffness: positive(18, &mut random),
        damping: Damping::None,
        preload: Vec::new(),
        geometric: None,
    };
    let gravity = Gravity::constant(Vector3::zeros());
    let element = Superelement::new((nodes, Vec::new()), (1, &places), matrices, gravity);
    builder.add_element(element.clone());
    let (_, state) = builder.build(0.0).expect("valid");
    (element, state)
}

/// Velocity relative to the floating frame over the size of the part, and angular velocity, of the interface with the largest sum.
#[test]
fn rates_of_deformation_are_those_of_the_fastest_interface() {
    let (element, state) = three_interfaces();
    let mut at = state.kinematics;
    let spatial = Random::new(13).screw();
    for node in &mut at.nodes[1..] {
        node.twist = node.frame.adjoint_inverse_times(&spatial);
    }
    let (rate, _) = element.deformation_rate(&at).expect("it bends");
    assert!(rate < 1e-13, "as a rigid body: {rate:e}");
    at.nodes[1].twist += lissom_motion::screw(&Vector3::new(0.3, 0.0, 0.4), &Vector3::zeros());
    let (rate, node) = element.deformation_rate(&at).expect("it bends");
    assert!((rate - 0.5 / 5.0).abs() < 1e-13 && node.index() == 1, "{rate} of {node:?}");
    at.nodes[3].twist += lissom_motion::screw(&Vector3::new(0.0, 12.0, 0.0), &Vector3::new(0.0, 0.0, -0.7));
    let (rate, node) = element.deformation_rate(&at).expect("it bends");
    assert!((rate - (12.0 / 5.0 + 0.7)).abs() < 1e-12 && node.index() == 3, "{rate} of {node:?}");
}

/// Displacements count by the size of the part, rotations by the angle, and each has its limit of 0.3.
#[test]
fn the_linear_range_is_that_of_the_interface_that_deforms_most() {
    let (element, state) = three_interfaces();
    let at = state.kinematics;
    let used = |at: &_| {
        let own = element.limit(LimitKind::Deformation, [at; 2]).expect("it is linear");
        let Place::Node(node) = own.place else { panic!("it is at an interface") };
        [own.value / own.limit, node.index() as f64]
    };
    assert!(used(&at)[0] < 1e-13);
    let mut moved = at.clone();
    moved.nodes[1].frame = moved.nodes[1].frame * Motion::translation(Vector3::new(0.0, -0.6, 0.8));
    let [part, node] = used(&moved);
    assert!((part - 1.0 / 0.75).abs() < 1e-13 && node == 1.0, "{part} at {node}");
    let turn = Motion::exponential(&lissom_motion::screw(&Vector3::zeros(), &Vector3::new(0.0, 0.0, -0.32)));
    moved.nodes[3].frame = moved.nodes[3].frame * turn;
    let [part, node] = used(&moved);
    assert!((part - 1.6).abs() < 1e-13 && node == 3.0, "{part} at {node}");
    let (cosine, pair) = element.max_relative_rotation(&moved).expect("it turns");
    assert!(
        (cosine.abs() - 0.16_f64.cos()).abs() < 1e-14 && pair == [2, 3].map(NodeId::new),
        "{cosine} {pair:?}"
    );
}

/// What a rigid motion of the whole changes: nothing in the axes of the nodes.
#[test]
fn superelements_do_not_see_rigid_motion() {
    let mut random = Random::new(8);
    let (system, state) = system_with((3, 2, 1), true, &mut random);
    let here = Configuration::random(&system, &state, 0.2, &mut random);
    // Weight is not invariant.
    let still = |here: &Configuration| {
        let mut forces = here.residual(&system, 0.0);
        let mut weightless = here.at.clone();
        for node in &mut weightless.nodes {
            node.twist.fill(0.0);
            node.acceleration.fill(0.0);
        }
        forces.push(system.energy(&here.at).kinetic + system.energy(&here.at).strain);
        forces
    };
    let motion = Motion::translation(Vector3::new(3.0, -2.0, 5.0));
    let mut moved = Configuration::random(&system, &state, 0.2, &mut Random::new(9));
    moved.at = here.at.clone();
    for node in moved.at.nodes.iter_mut().skip(1) {
        node.frame = motion * node.frame;
    }
    let (one, other) = (still(&here), still(&moved));
    for (one, other) in one.iter().zip(&other) {
        assert!((one - other).abs() < 1e-12 * (1.0 + one.abs()), "{one} {other}");
    }
}

/// The mass of a rigid body with a spring between two halves, as matrices over two interfaces.
fn two_halves() -> ([Vector3; 2], ReducedMatrices) {
    let places = [Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)];
    let mass = DMatrix::from_diagonal(&DVector::from_vec(vec![
        1.0, 1.0, 1.0, 0.1, 0.2, 0.3, 1.5, 1.5, 1.5, 0.1, 0.2, 0.3,
    ]));
    // u of the second interface from the first: r = x₂ - x₁ + L × θ₁.
    let mut relative = DMatrix::zeros(6, 12);
    for k in 0..6 {
        relative[(k, 6 + k)] = 1.0;
        relative[(k, k)] = -1.0;
    }
    relative[(1, 5)] = -2.0;
    relative[(2, 4)] = 2.0;
    let springs = DMatrix::from_diagonal(&DVector::from_vec(vec![1e4, 2e4, 3e4, 1e3, 2e3, 3e3]));
    let stiffness = relative.transpose() * springs * &relative;
    (
        places,
        ReducedMatrices { mass, stiffness, damping: Damping::None, preload: Vec::new(), geometric: None },
    )
}

/// Seen from a frame that moves on steadily, nothing is different: also for modes that carry momentum.
#[test]
fn a_steady_translation_changes_no_force() {
    let mut random = Random::new(12);
    let (places, mut matrices) = two_halves();
    let size = 14;
    for matrix in [&mut matrices.mass, &mut matrices.stiffness] {
        *matrix = matrix.clone().resize(size, size, 0.0);
        for k in 12..size {
            matrix[(k, k)] = 1.5;
        }
    }
    for row in 0..12 {
        for mode in 12..size {
            let coupling = 0.05 * random.number();
            matrices.mass[(row, mode)] = coupling;
            matrices.mass[(mode, row)] = coupling;
        }
    }
    matrices.damping = Damping::OfStiffness(1e-3);
    let interfaces = [0, 1].map(|k| InterfacePlace { name: format!("part.{k}"), place: places[k] });
    let mut builder = Builder::new();
    builder.set_gravity(random.vector());
    let description = SuperelementDescription {
        name: "part",
        frame: random.motion(),
        interfaces: &interfaces,
        floating: 1,
        matrices: matrices.check(&places).expect("good matrices"),
    };
    let (contribution, _) = superelement(builder.model(), &description).expect("small enough");
    builder.add(contribution);
    let (system, state) = builder.build(0.0).expect("valid");
    let here = Configuration::random(&system, &state, 0.2, &mut random);
    let mut moved = Configuration::random(&system, &state, 0.2, &mut Random::new(9));
    moved.at = here.at.clone();
    let speed = Vector3::new(30.0, -20.0, 10.0);
    for node in moved.at.nodes.iter_mut().skip(1) {
        let own = node.frame.rotation.apply_inverse(&speed);
        let spin = Vector3::new(node.twist[3], node.twist[4], node.twist[5]);
        let turning = -spin.cross(&own);
        for k in 0..3 {
            node.twist[k] += own[k];
            node.acceleration[k] += turning[k];
        }
    }
    let (one, other) = (here.residual(&system, 0.0), moved.residual(&system, 0.0));
    let largest = one.iter().fold(0.0_f64, |most, force| most.max(force.abs()));
    for (one, other) in one.iter().zip(&other) {
        assert!((one - other).abs() < 1e-11 * largest, "{one} at rest, {other} at speed");
    }
}

#[test]
fn matrices_that_are_those_of_no_free_part_are_refused() {
    let (places, good) = two_halves();
    good.clone().check(&places).expect("good matrices");
    let error_of = |change: &dyn Fn(&mut ReducedMatrices)| {
        let mut matrices = good.clone();
        change(&mut matrices);
        matrices.check(&places).expect_err("bad matrices").to_string()
    };
    for (words, change) in [
        (
            "holds a rigid",
            &(|m: &mut ReducedMatrices| m.stiffness[(1, 1)] += 100.0) as &dyn Fn(&mut ReducedMatrices),
        ),
        ("not symmetric", &|m| m.stiffness[(0, 6)] *= 1.1),
        ("no positive entry", &|m| m.mass[(3, 3)] = -0.1),
        ("not positive definite", &|m| {
            m.mass[(0, 6)] = 1.3;
            m.mass[(6, 0)] = 1.3;
        }),
        ("not that of a rigid body", &|m| m.mass[(7, 7)] = 1.6),
        ("is not finite", &|m| m.mass[(7, 7)] = f64::NAN),
        ("has a negative eigenvalue", &|m| m.stiffness *= -1.0),
        ("has 11 rows and 11 columns", &|m| m.stiffness = DMatrix::zeros(11, 11)),
        ("has 3 rows", &|m| m.preload = vec![0.0; 3]),
    ] {
        let error = error_of(change);
        assert!(error.contains(words), "{words}: {error}");
    }
    let swapped = [places[1], places[0]];
    assert!(good.clone().check(&swapped).is_err(), "interfaces in another order");
}

/// All modes of the free part have the ratio asked for, and rigid motions are not damped.
#[test]
fn modal_damping_is_that_of_every_mode() {
    let (_, matrices) = two_halves();
    let damping = matrices.modal_damping(0.03).expect("positive mass");
    let inverse = matrices.mass.clone().try_inverse().expect("positive");
    let root = (&inverse * &matrices.stiffness).complex_eigenvalues();
    let rates: Vec<f64> = root.iter().map(|value| value.re.max(0.0).sqrt()).collect();
    let damped = (&inverse * &damping).complex_eigenvalues();
    let mut expected: Vec<f64> = rates.iter().map(|rate| 0.06 * rate).collect();
    let mut found: Vec<f64> = damped.iter().map(|value| value.re).collect();
    expected.sort_by(f64::total_cmp);
    found.sort_by(f64::total_cmp);
    for (found, expected) in found.iter().zip(&expected) {
        assert!((found - expected).abs() < 1e-6 * expected.max(1.0), "{found} {expected}");
    }
}

/// One interface without modes: a rigid body.
#[test]
fn a_single_interface_is_a_rigid_body() {
    let places = [Vector3::zeros()];
    let mass = DMatrix::from_diagonal(&DVector::from_vec(vec![2.0, 2.0, 2.0, 0.1, 0.2, 0.3]));
    let stiffness = DMatrix::zeros(6, 6);
    let matrices =
        ReducedMatrices { mass, stiffness, damping: Damping::None, preload: Vec::new(), geometric: None };
    let mut builder = Builder::new();
    let description = SuperelementDescription {
        name: "part",
        frame: Motion::identity(),
        interfaces: &[InterfacePlace { name: "part.only".to_owned(), place: places[0] }],
        floating: 0,
        matrices: matrices.check(&places).expect("good matrices"),
    };
    let (contribution, _) = superelement(builder.model(), &description).expect("small enough");
    builder.add(contribution);
    let (system, mut state) = builder.build(0.0).expect("valid");
    state.kinematics.nodes[1].twist[4] = 3.0;
    let kinetic = system.energy(&state.kinematics).kinetic;
    assert!((kinetic - 0.5 * 0.2 * 9.0).abs() < 1e-14, "{kinetic}");
}

#[test]
fn modal_coordinates_have_the_mass_of_the_part() {
    let (places, mut matrices) = two_halves();
    for matrix in [&mut matrices.mass, &mut matrices.stiffness] {
        let (size, last) = (matrix.nrows(), matrix[(11, 11)]);
        *matrix = matrix.clone().resize(size + 1, size + 1, 0.0);
        matrix[(12, 12)] = 1e-4 * last;
    }
    let interfaces = [0, 1].map(|k| InterfacePlace { name: format!("part.{k}"), place: places[k] });
    let mut builder = Builder::new();
    let description = SuperelementDescription {
        name: "part",
        frame: Motion::identity(),
        interfaces: &interfaces,
        floating: 0,
        matrices: matrices.check(&places).expect("good matrices"),
    };
    let (contribution, unknowns) = superelement(builder.model(), &description).expect("small enough");
    builder.add(contribution);
    let coordinates: Vec<_> = unknowns.coordinates().collect();
    let (system, mut state) = builder.build(0.0).expect("valid");
    assert_eq!(system.layout().coordinate_name(coordinates[0]), "part.mode1");
    state.kinematics.coordinates[coordinates[0]].rate = 2.0;
    let kinetic = system.energy(&state.kinematics).kinetic;
    assert!((kinetic - 0.5 * 2.5 * 4.0).abs() < 1e-12, "{kinetic}");
}
