//! Every registered element and joint: its tangents are the derivatives of its forces.

mod beam_contacts;
mod breakpoints;
mod configuration;
mod contacts;
mod departures;
mod energies;
mod feedback;
mod joint_lanes;
mod local_loads;
mod locks;
mod nearest_contacts;
mod neighbours;
mod ports;
mod rigid_contacts;
mod rolling;
mod shell_contacts;
mod shells;
mod solids;
mod superelement;

use configuration::{Configuration, Random, difference, sample_parameters};
use lissom_flexible::beam::{Beam, SectionLaw};
use lissom_mechanics::elements::tyre::magic_formula::COEFFICIENTS;
use lissom_mechanics::elements::{LOADS, SPRINGS};
use lissom_mechanics::joints::constraint::violation_rates;
use lissom_mechanics::joints::derivatives::IncrementTangent;
use lissom_mechanics::joints::evaluation_point::Chart;
use lissom_mechanics::joints::starts::JointStarts;
use lissom_mechanics::joints::{self, Build};
use lissom_mechanics::kinematics::{Freedoms, Kinematics};
use lissom_mechanics::ports::PortType;
use lissom_mechanics::registry::Value;
use lissom_motion::{Matrix6, Motion, Vector3, Vector6};
use lissom_system::{
    Blend, Builder, Linearization, Placement, Scratch, State, Sum, System, TangentAssembler,
};
use ports::two_bodies;
use std::collections::BTreeMap;

/// Compares all blocks of the linearisation with differences of the residual.
fn check(name: &str, system: &System, state: &State, size: f64, random: &mut Random) {
    const TOLERANCE: f64 = 2e-8;
    let here = Configuration::random(system, state, size, random);
    departures::check(name, system, Configuration::random(system, state, size, random));
    let layout = system.layout();
    let pattern = system.pattern();
    for chart in [false, true] {
        let mut linearization = system.empty_linearization();
        let tangents: Vec<_> = here.node_increments.iter().map(IncrementTangent::new).collect();
        let unknowns = if chart { Chart::Increments(&tangents) } else { Chart::Body };
        system.linearize(&here.point(0.0), unknowns, &mut linearization);
        check_sum(name, (system, &linearization), |receiver| {
            system.assemble_tangent(&here.point(0.0), unknowns, &mut Scratch::default(), receiver);
        });
        for column in 0..layout.size() {
            let by_place =
                difference(|step| here.displaced(system, column, step, chart).residual(system, 0.0));
            let by_rate = difference(|step| here.accelerated(system, column, step, 1).residual(system, 0.0));
            let by_acceleration =
                difference(|step| here.accelerated(system, column, step, 2).residual(system, 0.0));
            for row in 0..layout.size() {
                let at = |values: &[f64]| pattern.position(row, column).map_or(0.0, |p| values[p]);
                let forces =
                    [&linearization.stiffness, &linearization.constraint, &linearization.by_multiplier];
                let mut place: f64 = forces.map(|values| at(values)).iter().sum();
                let mut rate = at(&linearization.damping);
                if layout.velocity_rows().any(|own| own == row) && column < layout.coordinate_count() {
                    // B v, where a violation lapses in one second.
                    let gradient = at(&linearization.constraint);
                    (place, rate) = (place - gradient, rate + gradient);
                }
                for (what, exact, found) in [
                    ("stiffness", place, by_place[row]),
                    ("damping", rate, by_rate[row]),
                    ("mass", at(&linearization.mass), by_acceleration[row]),
                ] {
                    let scale = 1.0 + exact.abs().max(found.abs());
                    assert!(
                        (exact - found).abs() < TOLERANCE * scale,
                        "{name}: {what} of {} by {} (charts {chart}): {exact} but difference {found}",
                        layout.name_of(row),
                        layout.name_of(column),
                    );
                }
            }
        }
        // BᵀWB belongs to the same B (columns through the chart, rows not).
        for row in 0..layout.coordinate_count() {
            for column in 0..layout.coordinate_count() {
                let get = |r, c, values: &[f64]| pattern.position(r, c).map_or(0.0, |p| values[p]);
                let product: f64 = layout
                    .multiplier_rows()
                    .filter(|m| !layout.is_of_velocities(m - layout.coordinate_count()))
                    .map(|m| {
                        get(row, m, &linearization.constraint)
                            * here.point(0.0).augmentation.relative(layout.quantities()[m])
                            * get(m, column, &linearization.constraint)
                    })
                    .sum();
                let gram = get(row, column, &linearization.gram);
                assert!((product - gram).abs() < 1e-12 * (1.0 + gram.abs()), "{name}: BᵀWB");
            }
        }
    }
}

/// Derivatives summed at once are those kept apart, summed.
fn check_sum(
    name: &str,
    (system, apart): (&System, &Linearization),
    hand: impl Fn(&mut TangentAssembler<'_>),
) {
    let blend = Blend {
        place: 0.7,
        rate: 1.9,
        acceleration: -0.6,
        augmented: 0.3,
        constraint: 1.3,
        slip: 1.7,
        turning: -0.4,
        slip_augmented: 0.0,
    };
    let (pattern, layout) = (system.pattern(), system.layout());
    let mut is_slip = vec![false; pattern.entries()];
    for row in layout.velocity_rows() {
        let columns = pattern.column(row).iter().filter(|&&column| column < layout.coordinate_count());
        columns.filter_map(|&column| pattern.position(row, column)).for_each(|k| is_slip[k] = true);
    }
    let mut values = vec![f64::NAN; apart.mass.len()];
    hand(&mut TangentAssembler::Real(Sum { blend, values: &mut values, stiffness: &mut [] }));
    for (k, found) in values.iter().enumerate() {
        let (by_gradient, by_place) =
            if is_slip[k] { (blend.slip, blend.turning) } else { (blend.constraint, blend.place) };
        let wanted = by_place * apart.stiffness[k]
            + blend.rate * apart.damping[k]
            + blend.acceleration * apart.mass[k]
            + blend.augmented * apart.gram[k]
            + by_gradient * apart.constraint[k]
            + blend.constraint * apart.by_multiplier[k];
        assert!((found - wanted).abs() < 1e-12 * (1.0 + wanted.abs()), "{name}: sum {found}, {wanted} apart");
    }
}

#[test]
fn springs_and_loads() {
    for (seed, kind) in SPRINGS.iter().chain(LOADS).chain([&ports::OVER_SHEAVES]).enumerate() {
        for flag in [false, true] {
            // A tyre rolls at a velocity at which differences are exact enough: with a small one its relaxation has a kink.
            let start = if kind.name == "tyre" { 173 } else { seed as u64 + 3 };
            let mut random = Random::new(start);
            let (mut builder, nodes) = two_bodies(&mut random);
            // What latches are engaged by.
            builder.add_held("input", if flag { 1.0 } else { 0.0 });
            // So that the first of all coordinates is not what it acts on.
            ports::two_coordinates(&mut builder);
            let mut parameters = sample_parameters(kind.parameters, flag, &mut random);
            if kind.name == "tyre" {
                // So that it is pressed, and adheres or slides.
                parameters.insert("radius", Value::Number(6.0));
                parameters.insert("friction_coefficient", Value::Number(if flag { 50.0 } else { 0.01 }));
                // Its law is steep for a wheel of this size.
                parameters.insert("rolling_resistance", Value::Number(0.01));
            }
            let attached = ports::attached(&mut builder, kind, nodes, &mut random);
            builder.add_of_kind(kind, attached, &parameters).expect("valid");
            let (system, state) = builder.build(0.0).expect("valid");
            check(kind.name, &system, &state, 0.4, &mut random);
            check_inertia(kind.name, &system, &state);
        }
    }
}

/// Inertias are the same in every motion, unless an element has a mass matrix of its own: records take them once.
fn check_inertia(name: &str, system: &System, state: &State) {
    let mut moved = state.kinematics.clone();
    let motion = Vector6::new(0.1, -0.2, 0.05, 0.3, 0.2, -0.1);
    for node in &mut moved.nodes {
        node.frame = node.frame * Motion::exponential(&motion);
        (node.twist, node.acceleration) = (2.0 * motion, 3.0 * motion);
    }
    for coordinate in &mut moved.coordinates {
        coordinate.value += 0.1;
        (coordinate.rate, coordinate.acceleration) = (0.2, 0.3);
    }
    let mut matrices = Vec::new();
    for inertia in system.elements_with(|element| element.inertia.filter(|_| !element.is_body_inertia)) {
        inertia.mass(&moved, &mut matrices);
    }
    let [first, then] = [&state.kinematics, &moved].map(|at| system.linearization_at(at).mass);
    assert!(!matrices.is_empty() || first == then, "{name}: its inertia depends on the motion");
}

#[test]
fn tyres_with_the_magic_formula() {
    let kind = SPRINGS.iter().find(|kind| kind.name == "tyre").expect("a kind");
    // With coefficients of combined slip, and with the ellipse.
    for flag in [false, true] {
        let mut random = Random::new(170);
        let (mut builder, nodes) = two_bodies(&mut random);
        ports::two_coordinates(&mut builder);
        let mut coefficients: BTreeMap<String, f64> = COEFFICIENTS
            .iter()
            .map(|name| {
                ((*name).to_owned(), f64::from(u8::from(name.starts_with('L'))) + 0.1 * random.number())
            })
            .collect();
        for (name, value) in [
            ("UNLOADED_RADIUS", 9.0),
            ("FNOMIN", 10.0),
            ("VERTICAL_STIFFNESS", 2.0),
            ("VERTICAL_DAMPING", 0.1),
            ("QFZ1", if flag { 1.2 } else { 0.0 }),
            ("QFZ2", 0.3),
            ("LONGVL", 3.0),
            ("FZMIN", 1e-3),
            ("FZMAX", 1e3),
            ("KPUMIN", -1e3),
            ("KPUMAX", 1e3),
            ("PCX1", 1.5),
            ("PDX1", 1.0),
            ("PKX1", 2.0),
            ("PCY1", 1.3),
            ("PDY1", 0.9),
            ("PKY1", -2.0),
            ("PKY2", 2.0),
            ("RBX1", if flag { 1.2 } else { 0.0 }),
            ("RBY1", 0.8),
            ("QCZ1", 1.1),
            ("BREFF", 1.0),
            ("DREFF", 0.2),
            ("PTX1", 1.1),
            ("PTY1", 0.7),
            ("PTY2", 1.8),
        ] {
            coefficients.insert(name.to_owned(), value);
        }
        let parameters = sample_parameters(kind.parameters, flag, &mut random)
            .without(
                kind.parameters
                    .iter()
                    .map(|own| own.name)
                    .filter(|name| !["normal", "wheel_axis", "road"].contains(name)),
            )
            .with("magic_formula", Value::Coefficients(coefficients));
        let attached = ports::attached(&mut builder, kind, nodes, &mut random);
        builder.add_of_kind(kind, attached, &parameters).expect("valid");
        let (system, state) = builder.build(0.0).expect("valid");
        check("tyre with the magic formula", &system, &state, 0.4, &mut random);
    }
}

#[test]
fn inertia_with_gravity() {
    let mut random = Random::new(7);
    let mut builder = Builder::new();
    builder.set_gravity(random.vector());
    let node = builder.add_node("body", random.motion(), Freedoms::Full);
    let root = Matrix6::from_fn(|_, _| random.number());
    builder.add_inertia(node, &(root * root.transpose()));
    let (system, state) = builder.build(0.0).expect("valid");
    check("inertia", &system, &state, 0.4, &mut random);
}

fn beam<const N: usize>(damping: f64, offsets: bool, random: &mut Random) -> (System, State) {
    let mut builder = Builder::new();
    let sections: [Motion; N] = std::array::from_fn(|i| {
        let along = Motion::translation(Vector3::new(0.4 * i as f64, 0.0, 0.0));
        along * Motion::exponential(&(0.2 * random.screw()))
    });
    let offset: [Option<Motion>; N] =
        std::array::from_fn(|i| (offsets && i % 2 == 0).then(|| random.motion()));
    let nodes = std::array::from_fn(|i| {
        let frame = offset[i].map_or(sections[i], |offset| sections[i] * offset.inverse());
        builder.add_node(&format!("node {i}"), frame, Freedoms::Full)
    });
    let root = Matrix6::from_fn(|_, _| random.number());
    let stiffness = root * root.transpose() + Matrix6::identity();
    builder.add_element(Beam::<N>::new(nodes, offset, &sections, |xi| SectionLaw {
        stiffness: stiffness * (1.0 + 0.3 * xi),
        damping,
        free: Vector6::zeros(),
    }));
    builder.build(0.0).expect("valid")
}

#[test]
fn beams_of_two_three_and_four_nodes() {
    for (damping, offsets) in [(0.0, false), (0.0, true), (0.2, false), (0.2, true)] {
        let mut random = Random::new(11);
        let (system, state) = beam::<2>(damping, offsets, &mut random);
        check("beam of 2 nodes", &system, &state, 0.3, &mut random);
        let (system, state) = beam::<3>(damping, offsets, &mut random);
        check("beam of 3 nodes", &system, &state, 0.3, &mut random);
        let (system, state) = beam::<4>(damping, offsets, &mut random);
        check("beam of 4 nodes", &system, &state, 0.3, &mut random);
    }
}

#[test]
fn all_joints() {
    let mut on_points = 0;
    for (seed, kind) in joints::KINDS.iter().enumerate() {
        for (size, planar) in [(0.0, false), (0.5, false), (0.3, true)] {
            let mut random = Random::new(seed as u64 + 3);
            let (mut builder, mut nodes) = two_bodies(&mut random);
            let axis = if planar { Vector3::z() } else { random.vector() };
            if planar {
                nodes[0] = builder.ground();
                nodes[1] =
                    builder.add_node("point", Motion::translation(random.vector()), Freedoms::Planar(0, 1));
            }
            let placement = Placement {
                nodes,
                // Only joints fixed to two nodes are at a point mass.
                at: if planar { builder.initial_frame(nodes[1]).position } else { random.vector() },
                at_tip: None,
                axis: Some(axis),
                second_axis: Some(random.vector()),
            };
            let needs_rotation = |port: &lissom_mechanics::ports::PortDeclaration| {
                matches!(
                    port.holds,
                    PortType::Coordinate(_) | PortType::OnlyCoordinate(_) | PortType::NamedCoordinates
                )
            };
            if planar && kind.ports.0.iter().any(needs_rotation) {
                continue;
            }
            let parameters = sample_parameters(kind.parameters, true, &mut random);
            let attachment = ports::joint_attachment(&mut builder, kind, &placement, &mut random);
            let added = builder.add_joint_of_kind("constraint", kind, attachment, &parameters);
            // What needs the rotation of the point is rejected.
            if planar && added.is_err() {
                continue;
            }
            on_points += usize::from(planar);
            added.expect("valid");
            let (system, state) = builder.build(0.0).expect("valid");
            check_names(kind.name, &system);
            check(kind.name, &system, &state, size, &mut random);
        }
    }
    assert!(on_points >= 4, "{on_points} kinds at a point mass");
}

/// Every equation has words of its own.
fn check_names(kind: &str, system: &System) {
    let layout = system.layout();
    let mut names: Vec<String> = layout.multiplier_rows().map(|own| layout.name_of(own)).collect();
    assert!(names.iter().all(|name| !name.contains("()")), "{kind}: {names:?}");
    let count = names.len();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), count, "{kind}: {names:?}");
}

#[test]
fn sliders_whose_tips_turn_with_the_line() {
    for (seed, orientation) in [(78, "tangent"), (79, "section")] {
        for size in [0.0, 0.1, 0.5] {
            let mut random = Random::new(seed);
            let mut builder = Builder::new();
            let tip = builder.add_node("tip", random.motion(), Freedoms::Full);
            ports::add_slider(&mut builder, tip, orientation, &mut random);
            let (system, state) = builder.build(0.0).expect("valid");
            check("slider", &system, &state, size, &mut random);
        }
    }
}

/// Two bodies and a joint of a kind that is between two nodes.
fn joined(kind: &joints::JointKind, random: &mut Random) -> (System, State) {
    let (mut builder, nodes) = two_bodies(random);
    let placement = Placement {
        nodes,
        at: random.vector(),
        at_tip: None,
        axis: Some(random.vector()),
        second_axis: Some(random.vector()),
    };
    let mut parameters = sample_parameters(kind.parameters, true, random);
    if kind.name == "rolling"
        && let Some(normal) = placement.axis
    {
        // Upright: the lower a wheel leans the less differences of finite width say of it.
        let wheel_axis = normal.cross(&random.vector());
        parameters.insert("wheel_axis", Value::Vector(wheel_axis));
    }
    builder.add_joint("joint", kind, &placement, &parameters).expect("valid");
    builder.build(0.0).expect("valid")
}

/// The violation carried over a step equals the one evaluated from absolute positions, and joints start satisfied.
#[test]
fn violation_changes_agree_with_violations() {
    for (seed, kind) in joints::KINDS.iter().enumerate() {
        let Build::Relative(_) = kind.build else { continue };
        let mut random = Random::new(seed as u64 + 20);
        let (system, state) = joined(kind, &mut random);
        let count = state.multipliers.len();
        let mut violations = vec![0.0; count];
        system.violations(&state.kinematics, &mut violations);
        assert!(
            violations.iter().all(|value| value.abs() < 1e-14),
            "{}: not satisfied at the start",
            kind.name
        );
        let here = Configuration::random(&system, &state, 0.5, &mut random);
        let mut carried = vec![0.0; count];
        system.stage_violations(&here.point(0.0), &mut carried);
        let mut absolute = vec![0.0; count];
        system.violations(&here.at, &mut absolute);
        for (a, b) in carried.iter().zip(&absolute) {
            assert!((a - b).abs() < 1e-13, "{}: {a} carried, {b} absolute", kind.name);
        }
    }
}

/// Likewise of a slider that passes a node, and its second derivative along a motion.
#[test]
fn a_slider_carries_its_violation_past_nodes() {
    let orientations = [("free", 3), ("tangent", 5), ("section", 6)];
    for (size, (orientation, count)) in
        [0.02, 0.2, 3.0].into_iter().flat_map(|size| orientations.map(|own| (size, own)))
    {
        let mut random = Random::new(60);
        let mut builder = Builder::new();
        let tip = builder.add_node("tip", random.motion(), Freedoms::Full);
        ports::add_slider(&mut builder, tip, orientation, &mut random);
        let (system, state) = builder.build(0.0).expect("valid");
        let mut violations = vec![0.0; count];
        system.violations(&state.kinematics, &mut violations);
        assert!(violations.iter().all(|value| value.abs() < 1e-14), "not satisfied at the start");
        let here = Configuration::random(&system, &state, size, &mut random);
        let (mut carried, mut absolute) = (vec![0.0; count], vec![0.0; count]);
        system.stage_violations(&here.point(0.0), &mut carried);
        system.violations(&here.at, &mut absolute);
        for (a, b) in carried.iter().zip(&absolute) {
            assert!((a - b).abs() < 1e-13, "{a} carried, {b} absolute");
        }
        if size > 1.0 {
            continue;
        }
        let mut exact = vec![0.0; count];
        constraint_accelerations(&system, &here.at, &mut exact);
        let moved = |time: f64| {
            let mut at = here.at.clone();
            for node in &mut at.nodes {
                node.frame = node.frame * Motion::exponential(&(time * node.twist));
            }
            at.coordinates[0].value += time * at.coordinates[0].rate;
            let mut out = vec![0.0; count];
            system.violations(&at, &mut out);
            out
        };
        let found = difference(|time| difference(|step| moved(time + step)));
        for (a, b) in exact.iter().zip(&found) {
            assert!((a - b).abs() < 1e-6 * (1.0 + a.abs()), "{a} exact, {b} by differences");
        }
    }
}

/// Ḃ v + d/dt ∂c/∂t by multiplier.
fn constraint_accelerations(system: &System, at: &Kinematics, out: &mut [f64]) {
    for constraint in system.constraints() {
        let first = constraint.first_multiplier();
        constraint.acceleration(at, &mut out[first..first + constraint.equations()]);
    }
}

/// Rates and accelerations of violations, several joints at a time and by the rows of each.
fn rates_in_lanes_are_those_one_by_one(system: &System, at: &Kinematics, kind: &str) {
    let mut starts = JointStarts::default();
    system.begin_step(at, &mut starts);
    let count = system.layout().multiplier_count;
    let [mut rates, mut accelerations] = [vec![0.0; count], vec![0.0; count]];
    system.violation_rates(at, &starts, [&mut rates, &mut accelerations]);
    let [mut by_rows, mut accelerated] = [vec![0.0; count], vec![0.0; count]];
    for constraint in system.constraints() {
        let own = constraint.first_multiplier()..constraint.first_multiplier() + constraint.equations();
        let mut gradient = vec![0.0; constraint.equations() * constraint.size()];
        let out = [&mut by_rows[own.clone()], &mut accelerated[own]];
        violation_rates(constraint, at, &mut gradient, out);
    }
    for (a, b) in rates.iter().chain(&accelerations).zip(by_rows.iter().chain(&accelerated)) {
        assert!((a - b).abs() < 1e-12 * (1.0 + b.abs()), "{kind}: {a} in lanes, {b} one by one");
    }
}

/// d/dt (B v) along a motion, against the exact Ḃ v.
#[test]
fn constraint_accelerations_are_second_derivatives() {
    for (seed, kind) in joints::KINDS.iter().enumerate() {
        let Build::Relative(_) = kind.build else { continue };
        let mut random = Random::new(seed as u64 + 40);
        let (system, state) = joined(kind, &mut random);
        let here = Configuration::random(&system, &state, 0.3, &mut random);
        let mut exact = vec![0.0; state.multipliers.len()];
        constraint_accelerations(&system, &here.at, &mut exact);
        rates_in_lanes_are_those_one_by_one(&system, &here.at, kind.name);
        // Constant twists: H(t) = H exp(t V).
        let rate = |time: f64| {
            difference(|step| {
                let mut at = here.at.clone();
                for node in &mut at.nodes {
                    let psi: Vector6 = (time + step) * node.twist;
                    node.frame = node.frame * Motion::exponential(&psi);
                }
                for coordinate in &mut at.coordinates {
                    coordinate.value += (time + step) * coordinate.rate;
                }
                let mut out = vec![0.0; exact.len()];
                system.violations(&at, &mut out);
                out
            })
        };
        let found = difference(rate);
        for (multiplier, (a, b)) in exact.iter().zip(&found).enumerate() {
            let is_close = (a - b).abs() < 1e-7 * (1.0 + a.abs());
            assert!(
                is_close || system.layout().is_of_velocities(multiplier),
                "{}: {a} exact, {b} by differences",
                kind.name
            );
        }
    }
}

/// Positions moved by one rigid motion leave every element's forces as they are in its own axes, and a beam
/// that is moved rigidly from its stress-free state feels none.
#[test]
fn rigid_motion_changes_no_force() {
    for (damping, offsets) in [(0.0, false), (0.3, true)] {
        let mut random = Random::new(17);
        let systems = [
            beam::<2>(damping, offsets, &mut random),
            beam::<3>(damping, offsets, &mut random),
            beam::<4>(damping, offsets, &mut random),
        ];
        for (system, state) in &systems {
            let moved = |here: &Configuration, turn: &Motion| {
                let mut there = here.displaced(system, 0, 0.0, false);
                for node in &mut there.at.nodes[1..] {
                    node.frame = *turn * node.frame;
                }
                there.residual(system, 0.0)
            };
            let turn = random.motion();
            let here = Configuration::random(system, state, 0.4, &mut random);
            let before = here.residual(system, 0.0);
            for (a, b) in before.iter().zip(moved(&here, &turn)) {
                assert!((a - b).abs() < 1e-11 * (1.0 + a.abs()), "{a} {b}");
            }
            let mut still = Configuration::random(system, state, 0.0, &mut random);
            // A rigid motion, rates included: every node has the same twist in space.
            let spatial = random.screw();
            for node in &mut still.at.nodes[1..] {
                node.twist = node.frame.adjoint_inverse_times(&spatial);
            }
            for force in moved(&still, &Motion::identity()).iter().chain(&still.residual(system, 0.0)) {
                assert!(force.abs() < 1e-12, "{force}");
            }
        }
    }
}

/// Forces of a beam are the gradient of its energy.
#[test]
fn beam_forces_are_the_gradient_of_the_energy() {
    let mut random = Random::new(23);
    let (system, state) = beam::<4>(0.0, true, &mut random);
    let here = Configuration::random(&system, &state, 0.4, &mut random);
    let forces = here.residual(&system, 0.0);
    for (row, force) in forces.iter().enumerate() {
        let slope =
            difference(|step| vec![system.energy(&here.displaced(&system, row, step, false).at).strain])[0];
        assert!((force - slope).abs() < 1e-9 * (1.0 + force.abs()), "row {row}: {force} {slope}");
    }
}
