//! Every query of the one interface of constraints, applied to every kind that adds one.

use lissom_core::consistent::mobility;
use lissom_core::elements::inertia::Inertia;
use lissom_core::joints::attached::AttachedJoint;
use lissom_core::joints::constraint::{Constraint, Level, Port, rates, violation_rates};
use lissom_core::joints::{Equations, JointKind, KINDS};
use lissom_core::kinematics::{GROUND, Kinematics, LOCKED, NodeId};
use lissom_core::linearized::LinearModel;
use lissom_core::newton::Limits;
use lissom_core::ports::Ports;
use lissom_core::registry::{Parameters, Value};
use lissom_core::scaling::ScalingChoice;
use lissom_core::schemes::radau_iia;
use lissom_core::settings::Settings;
use lissom_core::simulation::Simulation;
use lissom_core::system::{Builder, JointAttachment, Placement, State, System};
use lissom_motion::{Matrix3, Motion, Vector3, Vector6};

use super::configuration::{Configuration, Random, difference, sample_parameters};
use super::ports::{joint_attachment, two_bodies};

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
            check_hessian(&what, constraint, &here.at, &mut random);
            if constraint.level() == Level::Velocity {
                check_velocities(&what, constraint, &here.at);
                continue;
            }
            let violation = |at: &Kinematics| numbers(count, |out| constraint.violation(at, out));

            let gradient = numbers(count * size, |out| constraint.gradient(&here.at, out));
            for local in 0..size {
                let column: Vec<f64> = gradient.iter().skip(local).step_by(size).copied().collect();
                let found = difference(|step| violation(&moved(constraint, &here.at, local, step)));
                assert_close(&what("gradient"), &column, &found, 1e-8);
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

/// The Hessian is the derivative of the gradient.
fn check_hessian(
    what: &dyn Fn(&str) -> String,
    constraint: &dyn Constraint,
    at: &Kinematics,
    random: &mut Random,
) {
    let (count, size) = (constraint.equations(), constraint.size());
    let multipliers: Vec<f64> = (0..count).map(|_| random.number()).collect();
    let hessian = numbers(size * size, |out| constraint.constraint_hessian(at, &multipliers, out));
    for local in 0..size {
        let column: Vec<f64> = hessian.iter().skip(local).step_by(size).copied().collect();
        let found = difference(|step| {
            let at = moved(constraint, at, local, step);
            let gradient = numbers(count * size, |out| constraint.gradient(&at, out));
            let of = |row: usize| (0..count).map(|e| gradient[e * size + row] * multipliers[e]).sum();
            (0..size).map(of).collect()
        });
        assert_close(&what("curvature"), &column, &found, 1e-8);
    }
}

/// The queries of a constraint of velocities are derivatives of B v.
fn check_velocities(what: &dyn Fn(&str) -> String, constraint: &dyn Constraint, at: &Kinematics) {
    let (count, size) = (constraint.equations(), constraint.size());
    let speeds =
        |at: &Kinematics| numbers(count, |out| rates(constraint, at, &mut vec![0.0; count * size], out));
    let turning = numbers(count * size, |out| constraint.rate_derivatives(at, out));
    for local in 0..size {
        let column: Vec<f64> = turning.iter().skip(local).step_by(size).copied().collect();
        let found = difference(|step| speeds(&moved(constraint, at, local, step)));
        assert_close(&what("rate by place"), &column, &found, 1e-8);
    }
    let second = numbers(count, |out| constraint.acceleration(at, out));
    assert_close(&what("acceleration"), &second, &difference(|time| speeds(&later(at, time))), 1e-8);
    assert_eq!(
        numbers(count, |out| constraint.violation(at, out)),
        vec![0.0; count],
        "{}",
        what("violation")
    );
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
        let count = system.layout().multiplier_count;
        assert!(!mobility::has_loops(&system), "{}: alone", kind.name);
        assert_eq!(alone.redundant, [], "{}: alone", kind.name);

        let mut scene = Scene::of(kind, seed as u64 + 300);
        let Scene { builder, parameters, attachment, .. } = &mut scene;
        builder.add_joint_of_kind("again", kind, attachment.clone(), parameters).expect("valid");
        let (system, state, _) = scene.build();
        let twice = mobility::mobility(&system, &state);
        if system.layout().multiplier_count - count == twice.coordinates - alone.coordinates {
            // A rod of variable length: the coordinate of the copy follows.
            assert_eq!(
                (twice.freedoms, twice.redundant),
                (alone.freedoms, alone.redundant),
                "{}: twice",
                kind.name
            );
            continue;
        }
        assert!(mobility::has_loops(&system), "{}: twice", kind.name);
        assert_eq!(twice.freedoms, alone.freedoms, "{}: twice", kind.name);
        let added = system.layout().multiplier_count - count;
        let taken = twice.coordinates - alone.coordinates;
        assert_eq!(twice.redundant.len(), added - taken, "{}: twice", kind.name);
        assert!(!twice.redundant.is_empty(), "{}: twice", kind.name);
    }
}

/// The queries of the analyses, for every kind between bodies with mass: initial velocities and accelerations satisfy the derivatives of
/// the equations, steps satisfy the equations and what they leave of velocities, the state at rest has a linear model, and
/// derivatives of reactions are those of differences.
#[test]
fn every_kind_starts_moves_and_has_a_linear_model() {
    // Generalised coordinates have no mass of their own.
    for (seed, kind) in KINDS.iter().enumerate().filter(|(_, kind)| kind.ports != Ports::NONE) {
        let mut scene = Scene::of(kind, seed as u64 + 300);
        for node in NodeId::first(scene.builder.model().nodes.len()).skip(1) {
            let inertia =
                Inertia::of_rigid_body(1.3, &Vector3::zeros(), &Matrix3::from_diagonal_element(0.4));
            scene.builder.add_inertia(node, &inertia);
            scene.builder.set_twist(node, 0.3 * scene.random.screw());
        }
        let (system, state, mut random) = scene.build();
        // Cams that do not touch as they are drawn have no motion to start from.
        let mut drawn = vec![0.0; state.multipliers.len()];
        system.violations(&state.kinematics, &mut drawn);
        if drawn.iter().any(|own| own.abs() > 1e-9) {
            continue;
        }
        let settings = Settings {
            scheme: radau_iia::two_stages(),
            step_size: 1e-3,
            control: None,
            scaling: ScalingChoice::default(),
            limits: Limits { tolerance: 1e-11, ..Limits::default() },
            solver: lissom_solver::kind("sparse").expect("there"),
            threads: 1,
            from_equilibrium: false,
            follow_drives: true,
            energy_check: true,
        };
        let mut simulation = Simulation::new(system, state, settings).expect(kind.name);
        for step in 0..4 {
            let (system, state) = (simulation.system(), simulation.state());
            for constraint in system.constraints() {
                let (count, size) = (constraint.equations(), constraint.size());
                let [mut speeds, mut accelerations] = [0; 2].map(|_| vec![0.0; count]);
                let out = [&mut speeds[..], &mut accelerations[..]];
                violation_rates(constraint, &state.kinematics, &mut vec![0.0; count * size], out);
                // A scheme satisfies derivatives to its order.
                let tolerance = if step == 0 { 1e-9 } else { 1e-5 };
                let exact = if step == 0 || constraint.level() == Level::Velocity { 1e-9 } else { tolerance };
                assert!(speeds.iter().all(|speed| speed.abs() < exact), "{}, {step}: {speeds:?}", kind.name);
                let first = step == 0;
                assert!(!first || accelerations.iter().all(|own| own.abs() < 1e-8), "{}", kind.name);
                let violations = numbers(count, |out| constraint.violation(&state.kinematics, out));
                assert!(violations.iter().all(|own| own.abs() < 1e-8), "{}, {step}", kind.name);
            }
            simulation.step().expect(kind.name);
        }
        let system = simulation.system();
        let mut still = simulation.state().clone();
        still.kinematics.nodes.iter_mut().for_each(|node| node.twist.fill(0.0));
        still.kinematics.coordinates.iter_mut().for_each(|own| own.rate = 0.0);
        let solver = lissom_solver::kind("sparse").expect("there");
        LinearModel::of(system, &still, solver).expect(kind.name);
        for joint in system.joints() {
            check_reaction(
                kind.name,
                joint,
                &Configuration::random(system, &still, 0.1, &mut random).at,
                &mut random,
            );
        }
    }
}

fn check_reaction(kind: &str, joint: &AttachedJoint, at: &Kinematics, random: &mut Random) {
    let mut mu = Equations::default();
    let count = joint.reacting().len();
    mu[..count].iter_mut().for_each(|value| *value = random.number());
    let found = joint.reaction_derivatives(at, &mu, None);
    let reaction = |at: &Kinematics, mu: &Equations| joint.reaction(at, mu).as_slice().to_vec();
    for local in 0..12 + joint.coordinates.len() {
        let wanted = difference(|step| reaction(&moved(joint, at, local, step), &mu));
        assert_close(
            &format!("{kind}: reaction by {local}"),
            found.by_place[local].as_slice(),
            &wanted,
            1e-7,
        );
    }
    assert_eq!(found.by_multiplier.len(), count, "{kind}");
    for (k, column) in found.by_multiplier.iter().enumerate() {
        let wanted = difference(|step| {
            let mut mu = mu;
            mu[k] += step;
            reaction(at, &mu)
        });
        assert_close(&format!("{kind}: reaction by multiplier {k}"), column.as_slice(), &wanted, 1e-8);
    }
}
