//! Whether a motion starts with the given initial conditions.

use lissom_motion::Vector3;

use crate::errors::InitialError;
use crate::errors::Warning;
use crate::kinematics::{CoordinateId, GROUND, Kinematics, NodeId, NodeMotion, Quantity, Subject, split};
use crate::round_off;
use crate::scaling::Representative;
use crate::system::System;

/// Changes of given velocities below this fraction of the largest are round-off of given numbers.
const NOTEWORTHY: f64 = 1e-3;
/// If less than this fraction of the given kinetic energy remains, the given velocities are considered lost.
const NOTHING: f64 = 1e-4;

/// Drives are named in a conflict of velocities from this fraction of the largest violation on: those of a loop that has a
/// transmission may be violated by much less than its joints.
const DRIVES_IN_CONFLICT: f64 = 1e-3;
/// Deformation rates below this are round-off of a model at rest [1/s].
const RATE_AT_REST: f64 = 1e-9;

/// Speed below which displacements within `duration` [s] are round-off of positions.
pub(crate) fn negligible(representative: &Representative, duration: f64) -> f64 {
    f64::EPSILON * representative.length / duration
}

/// Speed of a node; a rotation counts as the arc at `length`.
fn speed(twist: &lissom_motion::Vector6, length: f64) -> f64 {
    let (velocity, angular) = split(twist);
    velocity.norm() + length * angular.norm()
}

/// Compares the given velocities with those that satisfy the constraints.
///
/// # Errors
/// If nothing of the given velocities remains.
pub(crate) fn velocities(
    system: &System,
    representative: &Representative,
    specified: &Kinematics,
    used: &Kinematics,
    negligible: f64,
) -> Result<Vec<Warning>, InitialError> {
    let length = representative.length;
    let are_given = representative.largest_speed(system, specified) > negligible;
    let given = &specified.nodes;
    let largest = given.iter().chain(&used.nodes).map(|node| speed(&node.twist, length)).fold(0.0, f64::max);
    let of_coordinates =
        if are_given { rates_of_coordinates(system, (length, largest), specified, used)? } else { None };
    let mut warnings: Vec<Warning> = of_coordinates.into_iter().collect();
    let changed = |node: NodeId| {
        let is_given = are_given && given[node].twist.norm_squared() > 0.0;
        if is_given { speed(&(used.nodes[node].twist - given[node].twist), length) } else { 0.0 }
    };
    let worst = system.layout().nodes().max_by(|&a, &b| changed(a).total_cmp(&changed(b))).unwrap_or(GROUND);
    if changed(worst) > NOTEWORTHY * largest {
        let part = Subject::new("node", system.layout().name_of_node(worst));
        let energy = |nodes: &[NodeMotion]| -> f64 {
            let of = |inertia: &crate::elements::inertia::Inertia| {
                let twist = nodes[inertia.node()].twist;
                twist.dot(&(inertia.mass() * twist))
            };
            let mut sum: f64 = system.inertias().iter().map(of).sum();
            system.masses(used, &mut |mass| {
                // Modal coordinates start at rest.
                let mut rates: Vec<f64> =
                    mass.nodes.iter().flat_map(|&node| nodes[node].twist.iter().copied()).collect();
                rates.resize(mass.rows.len(), 0.0);
                mass.times(&rates, |row, momentum| sum += rates[row] * momentum);
            });
            sum
        };
        let (given_words, used_words) = (words(&given[worst]), words(&used.nodes[worst]));
        if energy(&used.nodes) < NOTHING * energy(given) {
            return Err(InitialError::VelocityImpossible { part, given: given_words });
        }
        warnings.push(Warning::VelocityReplaced { part, given: given_words, used: used_words });
    }
    if let Some((rate, node)) = sudden_deformation(system, representative, [specified, used]) {
        warnings.push(Warning::StartsWithJolt { part: system.layout().name_of_node(node).to_owned(), rate });
    }
    Ok(warnings)
}

/// The largest deformation rate of an element [1/s] and one of its nodes, if it is significantly larger with the velocities used
/// than with those given.
pub(crate) fn sudden_deformation(
    system: &System,
    representative: &Representative,
    [given, used]: [&Kinematics; 2],
) -> Option<(f64, NodeId)> {
    let length = representative.length;
    let nodes = given.nodes.iter().chain(&used.nodes);
    let largest = nodes.map(|node| speed(&node.twist, length)).fold(0.0, f64::max);
    let before = Kinematics { nodes: given.nodes.clone(), ..used.clone() };
    let (most, (known, _)) = deformation_rate(system, used).zip(deformation_rate(system, &before))?;
    (most.0 - known > (NOTEWORTHY * largest / length).max(RATE_AT_REST)).then_some(most)
}

/// The largest deformation rate of an element [1/s], with one of its nodes; none if no element is deformable.
fn deformation_rate(system: &System, at: &Kinematics) -> Option<(f64, NodeId)> {
    let rates =
        system.elements_with(|own| own.deformation).filter_map(|element| element.deformation_rate(at));
    rates.reduce(|most, rate| if rate.0 > most.0 { rate } else { most })
}

/// The coordinate whose given rate is changed most, if that is significant compared with the `largest` speed of a
/// node.
fn rates_of_coordinates(
    system: &System,
    (length, largest): (f64, f64),
    specified: &Kinematics,
    used: &Kinematics,
) -> Result<Option<Warning>, InitialError> {
    let change = |k: &CoordinateId| {
        let (given, used) = (specified.coordinates[*k].rate, used.coordinates[*k].rate);
        let arm = if system.layout().coordinate_quantity(*k) == Quantity::Angle { length } else { 1.0 };
        if arm * given.abs() <= round_off::GIVEN * largest { 0.0 } else { (used - given).abs() / given.abs() }
    };
    let worst = system.layout().coordinates().max_by(|a, b| change(a).total_cmp(&change(b)));
    let Some(worst) = worst.filter(|worst| change(worst) > NOTEWORTHY) else { return Ok(None) };
    let unit = match system.layout().coordinate_quantity(worst) {
        Quantity::Length => "m/s",
        Quantity::Angle => "rad/s",
        Quantity::State => "1/s",
    };
    let [given, used] = [specified, used].map(|at| at.coordinates[worst].rate);
    let part = Subject::new("coordinate", system.layout().coordinate_name(worst));
    let words = |rate: f64| format!("{rate:.6} {unit}");
    if used.abs() < NOTHING * given.abs() {
        return Err(InitialError::VelocityImpossible { part, given: words(given) });
    }
    Ok(Some(Warning::VelocityReplaced { part, given: words(given), used: words(used) }))
}

/// Velocity in inertial axes and angular velocity in body axes, as in the model file.
fn words(node: &NodeMotion) -> String {
    let vector = |v: Vector3| format!("({:.6}, {:.6}, {:.6})", v.x, v.y, v.z);
    let (velocity, angular) = split(&node.twist);
    format!("{} m/s, {} rad/s", vector(node.frame.rotation.apply(&velocity)), vector(angular))
}

/// Fails if the rates of constraints cannot all vanish.
pub(crate) fn rates(
    system: &System,
    representative: &Representative,
    (rates, largest, negligible): (&[f64], f64, f64),
) -> Result<(), InitialError> {
    let layout = system.layout();
    let quantities = &layout.quantities()[layout.coordinate_count()..];
    let relative = |k: usize| match quantities[k] {
        Quantity::Length | Quantity::State => rates[k].abs(),
        Quantity::Angle => rates[k].abs() * representative.length,
    };
    let worst = (0..rates.len()).map(relative).fold(0.0, f64::max);
    if worst <= (super::NOTEWORTHY_VIOLATION * largest).max(negligible) {
        return Ok(());
    }
    // Drives first: they are what contradicts, the joints between them only carry it.
    let is_drive = |k: &usize| system.drives().iter().any(|drive| drive.multiplier == *k);
    let mut violated: Vec<Subject> = Vec::new();
    let mut drives_in_conflict = 0;
    for (wants_drives, share) in [(true, DRIVES_IN_CONFLICT), (false, 0.1)] {
        let most = violated.len() + super::MAX_LISTED;
        for k in (0..rates.len()).filter(|k| is_drive(k) == wants_drives && relative(*k) > share * worst) {
            let (joint, equation) = layout.constraint_name(k);
            let name = Subject::new("joint", joint).called(format!("`{joint}` ({equation})"));
            if violated.len() < most && !violated.contains(&name) {
                violated.push(name);
                drives_in_conflict += usize::from(wants_drives);
            }
        }
    }
    let [cause, remedy] = if system.drives().is_empty() {
        ["because the joints exclude each other's motion", "remove one, or look at their axes"]
    } else if drives_in_conflict < 2 {
        [
            "because the joints exclude the prescribed motion",
            "look at the axes of these joints, or change the prescribed motion",
        ]
    } else {
        [
            "because two drives prescribe the same motion differently, or one prescribes what the joints exclude",
            "remove one, or change the prescribed motion",
        ]
    };
    Err(InitialError::RatesContradict { violated: Subject::list(violated), cause, remedy })
}

impl Representative {
    /// Speed of the fastest node; a rotation counts as the arc at the representative length [m/s].
    pub(crate) fn largest_speed(&self, system: &System, at: &Kinematics) -> f64 {
        let is_motion =
            |&(k, _): &(CoordinateId, _)| system.layout().coordinate_quantity(k) != Quantity::State;
        let coordinates =
            CoordinateId::enumerate(&at.coordinates).filter(is_motion).map(|(_, own)| own.rate.abs());
        at.nodes.iter().map(|node| speed(&node.twist, self.length)).chain(coordinates).fold(0.0, f64::max)
    }
}
