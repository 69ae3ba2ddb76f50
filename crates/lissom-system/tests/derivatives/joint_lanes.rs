//! Joints evaluated several at a time: the same forces and violations as one at a time.

use lissom_mechanics::joints::derivatives::LOCAL;
use lissom_mechanics::joints::evaluation_point::Point;
use lissom_mechanics::joints::starts::JointStarts;
use lissom_mechanics::joints::{self, Build};
use lissom_mechanics::kinematics::{Freedoms, LOCKED};
use lissom_mechanics::registry::ParameterError;
use lissom_motion::{Motion, Vector3};
use lissom_system::{Builder, Placement, State, System};

use crate::derivatives::configuration::{Configuration, Random, sample_parameters};

/// Two blocks of eight and a part of a third.
const JOINTS: usize = 19;

/// Joints of one kind, each between two nodes of its own; some at the ground, some of a plane, some along their nodes'
/// axes.
fn many(kind: &joints::JointKind, random: &mut Random) -> (System, State) {
    let mut builder = Builder::new();
    for index in 0..JOINTS {
        let is_planar = index % 5 == 3;
        let is_plain = is_planar || (8..16).contains(&index);
        let frame = |random: &mut Random| {
            if is_plain { Motion::translation(random.vector()) } else { random.motion() }
        };
        let base = if index % 4 == 1 {
            builder.ground()
        } else {
            builder.add_node("base", frame(random), Freedoms::Full)
        };
        let parameters = sample_parameters(kind.parameters, true, random);
        let axis = if is_plain { Vector3::z() } else { random.vector() };
        let mut added = Err(ParameterError::new("tip", "has no rotation"));
        // Joints that need a rotation reject the point mass, and have a body instead.
        for freedoms in [Freedoms::Planar(0, 1), Freedoms::Full].into_iter().skip(usize::from(!is_planar)) {
            let tip = builder.add_node("tip", frame(random), freedoms);
            let at = if freedoms.is_point() { builder.initial_frame(tip).position } else { random.vector() };
            let placement = Placement {
                nodes: [base, tip],
                at,
                at_tip: None,
                axis: Some(axis),
                second_axis: Some(random.vector()),
            };
            added = builder.add_joint("joint", kind, &placement, &parameters);
            if added.is_ok() {
                break;
            }
        }
        added.expect("valid");
    }
    builder.build(0.0).expect("valid")
}

/// Forces and violations one joint at a time.
fn one_by_one(system: &System, point: &Point<'_>) -> Vec<f64> {
    let layout = system.layout();
    let mut out = vec![0.0; layout.size()];
    for joint in system.joints() {
        let (relative, own) = joint.configuration(&point.increments);
        let change = joint.joint().violation_change(&relative, &own);
        let mut mu = [0.0; 6];
        for k in 0..joint.equations() {
            let multiplier = joint.first_multiplier + k;
            let violation = point.violations[multiplier] + change[k];
            let weight =
                point.augmentation.weight * point.augmentation.relative(joint.joint().equation_quantity(k));
            mu[k] = point.multipliers[multiplier] + weight * violation;
            out[layout.multiplier_rows().start + multiplier] = violation;
        }
        let forces = joint.forces(&(relative, own), &mu);
        let mut rows = [LOCKED; LOCAL];
        for (side, frame) in joint.frames.iter().enumerate() {
            rows[8 * side..8 * side + 6].copy_from_slice(layout.rows_of_node(frame.node));
        }
        for (k, &coordinate) in joint.coordinates.iter().enumerate() {
            rows[14 + k] = layout.row_of_coordinate(coordinate) as u32;
        }
        for (&row, force) in rows.iter().zip(forces.iter()).filter(|&(&row, _)| row != LOCKED) {
            out[row as usize] += force;
        }
    }
    out
}

#[test]
fn many_joints_at_a_time_are_as_one_by_one() {
    for (seed, kind) in joints::KINDS.iter().enumerate() {
        let Build::Relative(_) = kind.build else { continue };
        for (round, size) in [1e-9, 1e-3, 0.1, 0.9, 4.0].into_iter().enumerate() {
            let mut random = Random::new((100 * round + seed) as u64 + 60);
            let (system, state) = many(kind, &mut random);
            let mut here = Configuration::random(&system, &state, size, &mut random);
            // Constraints of velocities are no equations of the joint.
            let layout = system.layout();
            layout.of_velocities.iter().for_each(|&multiplier| here.multipliers[multiplier] = 0.0);
            let slides: Vec<usize> = layout.velocity_rows().collect();
            let mut point = here.point(0.7);
            let wanted = one_by_one(&system, &point);
            let mut found = vec![f64::NAN; wanted.len()];
            system.residual(&point, &mut found);
            let compared = found.iter().zip(&wanted).enumerate().filter(|(row, _)| !slides.contains(row));
            for (row, (a, b)) in compared {
                let name = system.layout().name_of(row);
                assert!((a - b).abs() < 1e-13 * (1.0 + b.abs()), "{} {size}: {name}: {a}, {b}", kind.name);
            }
            // What is known at the start of the step changes nothing.
            let mut starts = JointStarts::default();
            system.begin_step(&here.start, &mut starts);
            point.increments.joints = Some(&starts);
            let mut known = vec![f64::NAN; wanted.len()];
            system.residual(&point, &mut known);
            assert_eq!(found, known, "{}", kind.name);
            let mut violations = vec![f64::NAN; state.multipliers.len()];
            system.stage_violations(&point, &mut violations);
            for (multiplier, violation) in violations.iter().enumerate() {
                let row = layout.multiplier_rows().start + multiplier;
                assert!(slides.contains(&row) || *violation == known[row], "{}", kind.name);
            }
        }
    }
}
