//! Every query of the one interface of constraints, applied to every kind that adds one.

use lissom_core::consistent::mobility;
use lissom_core::joints::constraint::{Constraint, Port};
use lissom_core::joints::{JointKind, KINDS};
use lissom_core::kinematics::{GROUND, Kinematics, LOCKED};
use lissom_core::ports::Ports;
use lissom_core::registry::{Parameters, Value};
use lissom_core::system::{Builder, JointAttachment, Placement, State, System};
use lissom_motion::{Motion, Vector6};

use super::configuration::{Configuration, Random, difference, sample_parameters};
use super::ports::joint_attachment;
use super::two_bodies;

/// A scene with a constraint of this kind, and what it acts on.
struct Scene {
    builder: Builder,
    parameters: Parameters,
    random: Random,
    attachment: JointAttachment,
}

impl Scene {
    fn of(kind: &JointKind, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let (mut builder, nodes) = two_bodies(&mut random);
        let placement = Placement {
            nodes,
            at: random.vector(),
            at_tip: None,
            axis: Some(random.vector()),
            second_axis: Some(random.vector()),
        };
        let mut parameters = sample_parameters(kind.parameters, true, &mut random);
        if kind.name == "rolling"
            && let Some(normal) = placement.axis
        {
            parameters.insert("wheel_axis", Value::Vector(normal.cross(&random.vector())));
        }
        let attachment = joint_attachment(&mut builder, kind, &placement, &mut random);
        builder.add_joint_of_kind("constraint", kind, attachment.clone(), &parameters).expect("valid");
        Self { builder, parameters, random, attachment }
    }

    fn build(self) -> (System, State, Random) {
        let (system, state) = self.builder.build(0.0).expect("valid");
        (system, state, self.random)
    }
}

fn numbers(count: usize, of: impl Fn(&mut [f64])) -> Vec<f64> {
    let mut out = vec![0.0; count];
    of(&mut out);
    out
}

/// The configuration with local unknown `local` of a constraint moved by a body variation.
fn moved(constraint: &dyn Constraint, at: &Kinematics, local: usize, change: f64) -> Kinematics {
    let arrangement = constraint.arrangement(at);
    let mut moved = at.clone();
    let mut first = 0;
    for port in (0..constraint.ports()).map(|index| constraint.port(arrangement, index)) {
        if let Some(own) = local.checked_sub(first)
            && own < port.width()
        {
            match port {
                Port::Node(node) => {
                    let variation = Motion::exponential(&(change * Vector6::ith(own, 1.0)));
                    moved.nodes[node].frame = moved.nodes[node].frame * variation;
                }
                Port::Coordinate(coordinate) => moved.coordinates[coordinate].value += change,
                Port::NoNode => {}
            }
        }
        first += port.width();
    }
    moved
}

/// The configuration some time later, with constant body velocities.
fn later(at: &Kinematics, time: f64) -> Kinematics {
    let mut moved = at.clone();
    moved.time += time;
    for node in &mut moved.nodes {
        node.frame = node.frame * Motion::exponential(&(time * node.twist));
    }
    for coordinate in &mut moved.coordinates {
        coordinate.value += time * coordinate.rate;
    }
    moved
}

fn assert_close(what: &str, exact: &[f64], found: &[f64], tolerance: f64) {
    assert_eq!(exact.len(), found.len(), "{what}");
    for (k, (a, b)) in exact.iter().zip(found).enumerate() {
        assert!((a - b).abs() < tolerance * (1.0 + a.abs()), "{what} {k}: {a}, but {b}");
    }
}

#[test]
fn every_query_of_every_kind_is_a_derivative_of_the_violation() {
    for (seed, kind) in KINDS.iter().enumerate() {
        let (system, state, mut random) = Scene::of(kind, seed as u64 + 300).build();
        let here = Configuration::random(&system, &state, 0.3, &mut random);
        for constraint in system.constraints() {
            let what = |query: &str| format!("{} of {}: {query}", constraint.name(), kind.name);
            let (count, size) = (constraint.equations(), constraint.size());
            let violation = |at: &Kinematics| numbers(count, |out| constraint.violation(at, out));

            let gradient = numbers(count * size, |out| constraint.gradient(&here.at, out));
            let multipliers: Vec<f64> = (0..count).map(|_| random.number()).collect();
            let hessian =
                numbers(size * size, |out| constraint.constraint_hessian(&here.at, &multipliers, out));
            for local in 0..size {
                let column: Vec<f64> = gradient.iter().skip(local).step_by(size).copied().collect();
                let found = difference(|step| violation(&moved(constraint, &here.at, local, step)));
                assert_close(&what("gradient"), &column, &found, 1e-8);

                let column: Vec<f64> = hessian.iter().skip(local).step_by(size).copied().collect();
                let found = difference(|step| {
                    let at = moved(constraint, &here.at, local, step);
                    let gradient = numbers(count * size, |out| constraint.gradient(&at, out));
                    let of = |row: usize| (0..count).map(|e| gradient[e * size + row] * multipliers[e]).sum();
                    (0..size).map(of).collect()
                });
                assert_close(&what("curvature"), &column, &found, 1e-8);
            }

            let still = |time: f64| Kinematics { time: here.at.time + time, ..here.at.clone() };
            let by_time = numbers(count, |out| constraint.time_derivative(&here.at, out));
            assert_close(&what("by time"), &by_time, &difference(|step| violation(&still(step))), 1e-8);
            let depends = by_time.iter().any(|rate| *rate != 0.0);
            assert!(!depends || constraint.depends_on_time(&here.at), "{}", what("depends on time"));
            assert!(
                !constraint.depends_on_time(&here.at) || constraint.may_depend_on_time(),
                "{}",
                what("may depend on time")
            );

            let second = numbers(count, |out| constraint.acceleration(&here.at, out));
            let found = difference(|time| difference(|step| violation(&later(&here.at, time + step))));
            assert_close(&what("acceleration"), &second, &found, 1e-6);

            let before =
                Kinematics { time: here.at.time - here.at.elapsed, elapsed: 0.0, ..here.start.clone() };
            let change = numbers(count, |out| {
                let increments = here.point(0.0).increments;
                constraint.violation_change(&increments, (here.at.time, here.at.elapsed), out);
            });
            let difference: Vec<f64> =
                violation(&here.at).iter().zip(violation(&before)).map(|(end, start)| end - start).collect();
            assert_close(&what("change"), &change, &difference, 1e-13);
        }
    }
}

/// What a constraint may act on is what its equations depend on, and its rows are among those of the system.
#[test]
fn every_kind_is_numbered_and_named() {
    for (seed, kind) in KINDS.iter().enumerate() {
        let (system, state, _) = Scene::of(kind, seed as u64 + 300).build();
        let layout = system.layout();
        let mut seen = vec![false; state.multipliers.len()];
        for constraint in system.constraints() {
            assert!(!constraint.name().is_empty());
            let first = constraint.first_multiplier();
            for (equation, seen) in seen[first..][..constraint.equations()].iter_mut().enumerate() {
                assert!(!std::mem::replace(seen, true), "{}: two constraints share an equation", kind.name);
                let quantity = layout.quantities()[layout.coordinate_count() + first + equation];
                assert_eq!(constraint.quantity(equation), quantity, "{}", kind.name);
                assert_eq!(layout.constraint_name(first + equation).0, constraint.name(), "{}", kind.name);
            }
        }
        assert!(seen.iter().all(|seen| *seen), "{}: an equation belongs to no constraint", kind.name);
        for joint in system.joints() {
            for frame in joint.frames {
                let is_free = layout.rows_of_node(frame.node).iter().any(|row| *row != LOCKED);
                assert!(is_free || frame.node == GROUND, "{}", kind.name);
            }
        }
    }
}

/// A constraint that is there twice leaves the same degrees of freedom, closes a loop, and each of its equations repeats others, except for
/// those that the coordinates of the copy take. One that is there once closes none.
#[test]
fn every_kind_that_is_there_twice_repeats_itself() {
    for (seed, kind) in KINDS.iter().enumerate() {
        if kind.ports == Ports::NONE {
            continue;
        }
        let (system, state, _) = Scene::of(kind, seed as u64 + 300).build();
        let alone = mobility::mobility(&system, &state);
        assert!(!mobility::has_loops(&system), "{}: alone", kind.name);
        assert_eq!(alone.redundant, [], "{}: alone", kind.name);

        let mut scene = Scene::of(kind, seed as u64 + 300);
        let Scene { builder, parameters, attachment, .. } = &mut scene;
        builder.add_joint_of_kind("again", kind, attachment.clone(), parameters).expect("valid");
        let (system, state, _) = scene.build();
        let twice = mobility::mobility(&system, &state);
        assert!(mobility::has_loops(&system), "{}: twice", kind.name);
        assert_eq!(twice.freedoms, alone.freedoms, "{}: twice", kind.name);
        let added = twice.constraints - alone.constraints;
        let taken = twice.coordinates - alone.coordinates;
        assert_eq!(twice.redundant.len(), added - taken, "{}: twice", kind.name);
        assert!(!twice.redundant.is_empty(), "{}: twice", kind.name);
    }
}
