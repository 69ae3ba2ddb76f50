//! What wheels that roll ask of the plane: no more than it can give; and of steps of planned size: that they are short beside
//! the time in which the point of contact runs round.

use super::Warning;
use crate::contact::wheel_on_rail::Pose;
use crate::elements::rolling::Rolling;
use crate::joints::attached::AttachedJoint;
use crate::kinematics::Kinematics;
use crate::system::{State, System};

/// Forces below this part of the largest multiplier are round-off.
const ROUND_OFF: f64 = 1e-9;
/// A point of contact that runs round by this angle in a step is not resolved: all schemes miss a twelfth of its third power
/// in a step, here 1 % of the circle's radius [rad].
const MAX_RUN: f64 = 0.5;

/// The first wheel on a plane whose point of contact runs round by more in a step than the step resolves, as where the wheel
/// has nearly fallen flat. No part turns as fast as that.
pub(crate) fn runs_round(system: &System, (from, to): (&Kinematics, &Kinematics)) -> Option<Warning> {
    system.joints().iter().find_map(|joint| {
        let contact = joint.joint().contact()?;
        let [before, after] = [from, to].map(|at| contact.down(&joint.evaluate_absolute(at).0.rotation));
        let angle = before.cross(&after).norm().atan2(before.dot(&after));
        let is_seen = contact.radius > 0.0 && angle > MAX_RUN;
        is_seen.then(|| Warning::ContactRunsRound { time: to.time, joint: joint.name.clone(), angle })
    })
}

/// Adds the first wheel that the plane would have to pull, or that would slide, if there is none yet.
pub(crate) fn check(system: &System, state: &State, warnings: &mut Vec<Warning>) {
    if let Some(doubt) = doubt(system, state)
        && warnings.iter().all(|known| known.code() != doubt.code())
    {
        warnings.push(doubt);
    }
}

fn doubt(system: &System, state: &State) -> Option<Warning> {
    let largest = || state.multipliers.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let on_rails = system.joints().iter().find_map(|joint| {
        joint.joint().rail_contact()?;
        rail_doubt(joint, state, ROUND_OFF * largest())
    });
    on_rails.or_else(|| on_planes(system, state, &largest))
}

/// The first doubt about a wheel on a rail.
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
        if normal < -ROUND_OFF * largest() {
            return Some(Warning::WheelLifts { time, joint: joint_name, force: -normal });
        }
        if contact.friction.is_infinite() {
            return None;
        }
        let wrench = Rolling::new(joint.frames, joint.impulses.clone(), contact).wrench(&state.kinematics);
        let friction = wrench.fixed_rows::<3>(0).norm();
        let is_round_off = friction <= ROUND_OFF * largest();
        (friction > contact.friction * normal && !is_round_off).then_some(Warning::WheelSlides {
            time,
            joint: joint_name,
            friction,
            normal,
        })
    })
}
