//! Motors of a robot: an input for each, and the torque or the force that it exerts.

use std::fmt::Write;

use super::joint_text::Placed;
use super::{Freedom, Robot};

/// A motor on a joint's coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Motor {
    /// Index of its joint.
    pub joint: usize,
    /// Torque or force per unit of its input [N m, N].
    pub gear: f64,
    /// Limits of its input, if it has any.
    pub input: Option<[f64; 2]>,
    /// Limits of its torque or force [N m, N], if it has any.
    pub effort: Option<[f64; 2]>,
}

/// Treatment of motors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motors {
    /// They are omitted.
    Omitted,
    /// Each has an input and a load.
    Written,
}

impl Robot {
    /// A motor for each moving joint with an effort that follows no other, where the description lists no motors.
    pub(super) fn motors_by_effort(&mut self) {
        let of = |(joint, own): (usize, &super::RobotJoint)| {
            let effort =
                own.rating.effort.filter(|effort| *effort > 0.0 && own.moves() && own.follows.is_none())?;
            Some(Motor { joint, gear: 1.0, input: None, effort: Some([-effort, effort]) })
        };
        self.motors = self.joints.iter().enumerate().filter_map(of).collect();
    }
}

/// Inputs and loads of all motors.
pub(super) fn write_motors(text: &mut String, robot: &Robot, placed: &[Placed]) {
    if robot.motors.is_empty() {
        return;
    }
    text.push_str("\n# Motors: an input is zero until a program or an event sets it.\n[inputs]\n");
    let mut names: Vec<String> = Vec::new();
    for motor in &robot.motors {
        let mut name = format!("{}_motor", placed[motor.joint].own);
        while names.contains(&name) {
            name.push('_');
        }
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name} = 0");
        names.push(name);
    }
    for (motor, name) in robot.motors.iter().zip(&names) {
        let joint = &placed[motor.joint].own;
        let (kind, key) = match robot.joints[motor.joint].freedom {
            Freedom::Rotation => ("joint_torque", "torque"),
            _ => ("joint_force", "force"),
        };
        let limited = |words: String, limits: Option<[f64; 2]>| match limits {
            Some([low, high]) => format!("clamp({words}, {low:?}, {high:?})"),
            None => words,
        };
        let input = limited(name.clone(), motor.input);
        let scaled = if motor.gear == 1.0 { input } else { format!("{:?}*{input}", motor.gear) };
        let size = limited(scaled, motor.effort);
        let _ =
            write!(text, "\n[loads.{name}]\nkind = \"{kind}\"\njoint = \"{joint}\"\n{key} = \"{size}\"\n");
    }
}
