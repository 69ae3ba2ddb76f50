//! Checks that the contact of rolling wheels can transmit their forces, and that steps of planned size are short compared
//! with the time in which the point of contact travels round.

use super::monitor::{Accepted, Beginning, Monitor};
use crate::errors::Warning;
use crate::errors::warn;
use crate::joints::Equations;
use crate::joints::attached::AttachedJoint;
use crate::kinematics::Kinematics;
use crate::round_off;
use crate::system::{State, System};
use crate::wheels::wheel_on_rail::Pose;

/// A point of contact that travels by this angle in a step is not resolved: the error of all schemes is a twelfth of its
/// third power in a step, here 1 % of the circle's radius [rad].
const MAX_RUN: f64 = 0.5;

/// The first wheel on a plane whose point of contact travels by more in a step than the step resolves, such as a wheel that
/// has nearly fallen flat. No part rotates as fast as that.
pub(crate) fn runs_round(system: &System, (from, to): (&Kinematics, &Kinematics)) -> Option<Warning> {
    system.joints().iter().find_map(|joint| {
        let contact = joint.joint().contact()?;
        let [before, after] = [from, to].map(|at| contact.down(&joint.evaluate_absolute(at).0.rotation));
        let angle = before.cross(&after).norm().atan2(before.dot(&after));
        let is_seen = contact.radius > 0.0 && angle > MAX_RUN;
        is_seen.then(|| Warning::ContactRunsRound { time: to.time, joint: joint.name.clone(), angle })
    })
}

/// Whether contacts can transmit the forces of wheels. Has no state.
struct Contact;

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    has_wheels(beginning.problem.system).then(|| Box::new(Contact) as Box<dyn Monitor>)
}

impl Monitor for Contact {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        if let Some(warning) = doubt(step.problem.system, step.end) {
            warn(warnings, warning);
        }
    }
}

/// Whether points of contact travel slowly compared with steps of planned size. Has no state.
struct ContactRun;

pub(super) fn begin_run(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let runs = beginning.is_planned_motion() && has_wheels(beginning.problem.system);
    runs.then(|| Box::new(ContactRun) as Box<dyn Monitor>)
}

impl Monitor for ContactRun {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        let ends = (&step.start.kinematics, &step.end.kinematics);
        if let Some(warning) = runs_round(step.problem.system, ends) {
            warn(warnings, warning);
        }
    }
}

fn doubt(system: &System, state: &State) -> Option<Warning> {
    let largest = || state.multipliers.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let on_rails = system.joints().iter().find_map(|joint| {
        joint.joint().rail_contact()?;
        rail_doubt(joint, state, round_off::FORCE * largest())
    });
    on_rails.or_else(|| on_planes(system, state, &largest))
}

/// The first limit exceeded by a wheel on a rail.
fn rail_doubt(joint: &AttachedJoint, state: &State, round_off: f64) -> Option<Warning> {
    let contact = joint.joint().rail_contact()?;
    let normal = -state.multipliers[joint.first_multiplier];
    let (time, name) = (state.kinematics.time, joint.name.clone());
    if normal < -round_off {
        return Some(Warning::WheelLifts { time, joint: name, force: -normal });
    }
    let (relative, _) = joint.evaluate_absolute(&state.kinematics);
    let doubt = contact.doubt(&Pose::new(&relative.rotation, &relative.position))?;
    Some(Warning::RailContact { time, joint: name, doubt })
}

fn on_planes(system: &System, state: &State, largest: &dyn Fn() -> f64) -> Option<Warning> {
    system.joints().iter().find_map(|joint| {
        let contact = joint.joint().contact()?;
        // The multiplier is the force that pulls the wheel to the plane.
        let normal = -state.multipliers[joint.first_multiplier];
        let (time, joint_name) = (state.kinematics.time, joint.name.clone());
        if normal < -round_off::FORCE * largest() {
            return Some(Warning::WheelLifts { time, joint: joint_name, force: -normal });
        }
        if contact.friction.is_infinite() {
            return None;
        }
        let mut mu = Equations::default();
        mu[..joint.reacting().len()].copy_from_slice(&state.multipliers[joint.reacting()]);
        let wrench = joint.force_of_plane(&state.kinematics, &mu);
        let friction = wrench.fixed_rows::<3>(0).norm();
        let is_round_off = friction <= round_off::FORCE * largest();
        (friction > contact.friction * normal && !is_round_off).then_some(Warning::WheelSlides {
            time,
            joint: joint_name,
            friction,
            normal,
        })
    })
}

fn has_wheels(system: &System) -> bool {
    let rolls =
        |joint: &AttachedJoint| joint.joint().contact().is_some() || joint.joint().rail_contact().is_some();
    system.joints().iter().any(rolls)
}
