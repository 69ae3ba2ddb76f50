//! Every registered spring: its forces at rest are the gradient of its energy, and the motion that it reports belongs to them. What
//! springs and loads report has exact gradients.

use lissom_mechanics::elements::tyre::REPORTED;
use lissom_mechanics::elements::{ElementKind, LOADS, SPRINGS};
use lissom_mechanics::evaluation::wrench::WrenchAxes;
use lissom_mechanics::kinematics::{Kinematics, LOCKED, Quantity};
use lissom_mechanics::registry::{ParameterType, Value};
use lissom_motion::Motion;
use lissom_system::element_quantity::Of;
use lissom_system::{ElementId, State, System};
use nalgebra::DMatrix;

use crate::derivatives::configuration::{
    Configuration, Random, Unknown, difference, sample_parameters, unknown,
};
use crate::derivatives::ports::{OVER_SHEAVES, attached, two_coordinates};
use crate::derivatives::two_bodies;

/// It holds what moves, and stores nothing.
const STORES_NOTHING: [&str; 2] = ["axial_latch", "torsional_latch"];

/// Those whose forces do work like those of a load.
const WITHOUT_ENERGY: [&str; 3] = ["bearing", "journal_bearing", "tyre"];

/// Those whose forces are no single force over one elongation.
const WITHOUT_MOTION: [&str; 4] = ["bearing", "bushing", "coordinate_dynamics", "journal_bearing"];

/// Those that exert a force and a moment on one tip.
const BETWEEN_FRAMES: [&str; 6] =
    ["bearing", "bushing", "journal_bearing", "point", "rolling_contact", "tyre"];

/// A spring of a kind alone between two bodies, and which element it is. Laws that may depend on the rate, and so have no energy, are
/// given where `is_damped`.
fn with_spring(
    kind: &ElementKind,
    is_damped: bool,
    random: &mut Random,
) -> (System, State, Option<ElementId>) {
    let (mut builder, nodes) = two_bodies(random);
    builder.add_held("input", if is_damped { 1.0 } else { 0.0 });
    let given: Vec<_> = (kind.parameters.iter())
        .filter(|parameter| is_damped || !matches!(parameter.holds, ParameterType::Force(_)))
        // Rolling friction works on another motion than the one that is reported.
        .filter(|parameter| !parameter.name.starts_with("rolling_"))
        .copied()
        .collect();
    let mut parameters = sample_parameters(&given, false, random);
    if kind.name == "coordinate_dynamics" && !is_damped {
        // What is not symmetric has no energy.
        let symmetric = DMatrix::from_row_slice(2, 2, &[2.0, -0.7, -0.7, 1.1]);
        parameters.insert("stiffness", Value::SquareMatrix(symmetric));
    }
    if ["rolling_contact", "tyre"].contains(&kind.name) {
        // So that it is pressed.
        parameters.insert("radius", Value::Number(6.0));
    }
    if kind.name == "tyre" {
        // So that no difference contains the end of adhesion, or the damping at small velocities.
        parameters.insert("friction_coefficient", Value::Number(50.0));
        parameters.insert("pneumatic_trail", Value::Number(0.0));
        parameters.insert("damping_time", Value::Number(1e-3));
    }
    two_coordinates(&mut builder);
    let attached = attached(&mut builder, kind, nodes, random);
    let element = builder.add_of_kind(kind, attached, &parameters).expect("valid");
    let (system, state) = builder.build(0.0).expect("valid");
    (system, state, element)
}

/// Friction has a bristle besides the coordinate: force on the coordinate at rest is the derivative of the energy by the bristle.
#[test]
fn forces_of_springs_at_rest_are_the_gradient_of_their_energy() {
    let with_energy =
        SPRINGS.iter().chain([&OVER_SHEAVES]).filter(|kind| !WITHOUT_ENERGY.contains(&kind.name));
    for (seed, kind) in with_energy.enumerate() {
        let mut random = Random::new(seed as u64 + 70);
        let (system, state, _) = with_spring(kind, false, &mut random);
        let mut here = Configuration::random(&system, &state, 0.3, &mut random);
        here.multipliers.fill(0.0);
        for node in &mut here.at.nodes {
            node.twist.fill(0.0);
            node.acceleration.fill(0.0);
        }
        for coordinate in &mut here.at.coordinates {
            (coordinate.rate, coordinate.acceleration) = (0.0, 0.0);
        }
        let stored = system.energy(&here.at).total();
        assert_eq!(stored != 0.0, !STORES_NOTHING.contains(&kind.name), "{}: {stored} J", kind.name);
        let forces = here.residual(&system, 0.0);
        let energy = |row| {
            difference(|step| vec![system.energy(&here.displaced(&system, row, step, false).at).total()])[0]
        };
        let rows = system.layout().coordinate_count();
        let mut slopes: Vec<f64> = (0..rows).map(energy).collect();
        if kind.name.ends_with("friction") {
            // The bristle is the last row, and the joint's coordinate the one before.
            slopes.swap(rows - 1, rows - 2);
        }
        for (row, (force, slope)) in forces.iter().zip(slopes).enumerate() {
            let name = system.layout().name_of(row);
            assert!(
                (force - slope).abs() < 1e-8 * (1.0 + force.abs()),
                "{}, {name}: {force}, but the energy grows by {slope}",
                kind.name
            );
        }
    }
}

/// The force that a spring reports, times the rate that it reports, is the power of its forces, and so its motion is of the joint or
/// of the positions that it acts on.
#[test]
fn springs_report_the_motion_that_their_forces_work_on() {
    // A tyre reports its deflection, and its tread works on the slip, too.
    let with_motion = SPRINGS.iter().chain([&OVER_SHEAVES]).filter(|kind| kind.name != "tyre");
    for (seed, kind) in with_motion.enumerate() {
        let mut random = Random::new(seed as u64 + 90);
        let (system, state, element) = with_spring(kind, true, &mut random);
        let mut here = Configuration::random(&system, &state, 0.3, &mut random);
        here.multipliers.fill(0.0);
        // Latches are constraints.
        let Some(element) = element else { continue };
        let motion = |at: &Kinematics| system.spring_motion(element, at);
        let reported = motion(&here.at);
        assert_eq!(reported.is_some(), !WITHOUT_MOTION.contains(&kind.name), "{}: {reported:?}", kind.name);
        let Some([value, rate, force]) = reported else { continue };
        let forces = here.residual(&system, 0.0);
        let power: f64 = (forces.iter().enumerate())
            .map(|(row, force)| match unknown(system.layout(), row) {
                Unknown::Node(node, k) => force * here.at.nodes[node].twist[k],
                Unknown::Coordinate(own) if system.layout().coordinate_quantity(own) == Quantity::State => {
                    0.0
                }
                Unknown::Coordinate(own) => force * here.at.coordinates[own].rate,
                Unknown::Multiplier(_) => 0.0,
            })
            .sum();
        // A contact reports what pushes apart.
        let force = if kind.name == "rolling_contact" { -force } else { force };
        assert!(
            (force * rate - power).abs() < 1e-12 * (1.0 + power.abs()),
            "{}: {reported:?} {power}",
            kind.name
        );
        // The rate is that of the value.
        let along = |time: f64| {
            let mut at = here.at.clone();
            for node in &mut at.nodes {
                node.frame = node.frame * Motion::exponential(&(time * node.twist));
            }
            for coordinate in &mut at.coordinates {
                coordinate.value += time * coordinate.rate;
            }
            at.time += time;
            vec![motion(&at).expect("as before")[0] - value]
        };
        let slope = difference(along)[0];
        assert!((rate - slope).abs() < 1e-8 * (1.0 + rate.abs()), "{}: {rate} {slope}", kind.name);
    }
}

/// Gradients of elongations, rates and forces of springs, of their forces and moments on the tip, and of powers of springs and loads.
#[test]
fn gradients_of_what_elements_report_are_those_of_differences() {
    for (seed, kind) in SPRINGS.iter().chain(LOADS).chain([&OVER_SHEAVES]).enumerate() {
        let mut random = Random::new(seed as u64 + 110);
        let (system, state, element) = with_spring(kind, true, &mut random);
        let here = Configuration::random(&system, &state, 0.3, &mut random);
        let Some(element) = element else { continue };
        let wrenches = [WrenchAxes::Ground, WrenchAxes::Base, WrenchAxes::Tip].map(Of::Wrench);
        for of in [Of::Spring, Of::Reported(REPORTED), Of::Power].into_iter().chain(wrenches) {
            let Some(quantity) = system.element_quantity(element, of) else {
                let is_absent = match of {
                    Of::Spring => system.spring_motion(element, &here.at).is_none(),
                    Of::Reported(_) => kind.name != "tyre",
                    Of::Power => false,
                    Of::Wrench(_) => !BETWEEN_FRAMES.contains(&kind.name),
                };
                assert!(is_absent, "{}: {of:?}", kind.name);
                continue;
            };
            let values =
                |here: &Configuration| quantity.values(&here.at)[..quantity.component_count()].to_vec();
            let layout = system.layout();
            let nodes = quantity.nodes().iter().flat_map(|&node| layout.rows_of_node(node).iter().copied());
            let coordinates = quantity.coordinates().iter().map(|&own| layout.row_of_coordinate(own) as u32);
            let rows: Vec<u32> = nodes.chain(coordinates).collect();
            for row in 0..layout.coordinate_count() {
                let found = [
                    difference(|step| values(&here.displaced(&system, row, step, false))),
                    difference(|step| values(&here.accelerated(&system, row, step, 1))),
                    difference(|step| values(&here.accelerated(&system, row, step, 2))),
                ];
                for component in 0..quantity.component_count() {
                    let gradient = quantity.gradient(component, &here.at);
                    let parts = [gradient.by_place, gradient.by_rate, gradient.by_acceleration];
                    for (order, (part, found)) in parts.iter().zip(&found).enumerate() {
                        let slots = rows.iter().zip(part).filter(|(own, _)| **own != LOCKED);
                        let exact: f64 =
                            slots.filter(|(own, _)| **own as usize == row).map(|(_, value)| value).sum();
                        assert!(
                            (exact - found[component]).abs() < 2e-8 * (1.0 + exact.abs()),
                            "{} {of:?} {component}, order {order}, {}: {exact} but difference {}",
                            kind.name,
                            layout.name_of(row),
                            found[component]
                        );
                    }
                }
            }
        }
    }
}
