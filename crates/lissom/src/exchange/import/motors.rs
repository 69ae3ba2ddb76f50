//! Motors of a robot: an input for each, and the torque or the force that it exerts.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use lissom_core::number::Written;

use super::joint_text::Placed;
use super::{Freedom, Robot};

/// A motor or a servo on a joint's coordinate.
///
/// Legend: u input, q coordinate, g gear, a and b gain and bias
///
/// ```text
/// ℓ = g q,   f = clamp((a₀ + a₁ ℓ + a₂ ℓ̇) u + b₀ + b₁ ℓ + b₂ ℓ̇),   torque or force of the joint g f
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motor {
    /// Name in the description, if it has one.
    pub name: Option<String>,
    /// Index of its joint.
    pub joint: usize,
    /// Number of the motor among all actuators of the description.
    pub number: usize,
    /// Length of the motor per coordinate.
    pub gear: f64,
    /// Force per input, and its change with length and rate.
    pub gain: [f64; 3],
    /// Force without input, and its change with length and rate.
    pub bias: [f64; 3],
    /// Limits of its input, if it has any.
    pub input: Option<[f64; 2]>,
    /// Limits of its force, before the gear, if it has any.
    pub force: Option<[f64; 2]>,
    /// Input at the start.
    pub start: f64,
}

impl Motor {
    /// A motor whose input is its torque or force [N m, N].
    pub(super) fn direct(joint: usize) -> Self {
        Self { joint, gear: 1.0, gain: [1.0, 0.0, 0.0], ..Self::default() }
    }

    /// The torque or force of its joint over the input and the coordinate, without the limits of the joint.
    fn law(&self, input: &str, coordinate: &str, rate: &str) -> String {
        let sum = |[constant, by_length, by_rate]: [f64; 3]| {
            let scaled = [(constant, ""), (self.gear * by_length, coordinate), (self.gear * by_rate, rate)];
            let terms =
                scaled.iter().filter(|(factor, _)| *factor != 0.0).map(|(factor, name)| match *name {
                    "" => format!("{factor:?}"),
                    name => format!("{factor:?}*{name}"),
                });
            terms.collect::<Vec<_>>().join(" + ").replace("+ -", "- ")
        };
        let input = limited(input.to_owned(), self.input);
        let driven = match (self.gain, sum(self.gain)) {
            ([1.0, 0.0, 0.0], _) => input,
            (_, none) if none.is_empty() => String::new(),
            ([_, 0.0, 0.0], factor) => format!("{factor}*{input}"),
            (_, factor) => format!("({factor})*{input}"),
        };
        let all: Vec<String> = [driven, sum(self.bias)].into_iter().filter(|term| !term.is_empty()).collect();
        let sum = if all.is_empty() { "0".to_owned() } else { all.join(" + ").replace("+ -", "- ") };
        let is_product = self.force.is_some() || !sum.contains(' ');
        let force = limited(sum, self.force);
        match self.gear {
            1.0 => force,
            gear if is_product => format!("{gear:?}*{force}"),
            gear => format!("{gear:?}*({force})"),
        }
    }
}

fn limited(words: String, limits: Option<[f64; 2]>) -> String {
    match limits {
        Some([low, high]) => format!("clamp({words}, {low:?}, {high:?})"),
        None => words,
    }
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
            let [_, effort] = own.rating.effort?;
            (effort > 0.0 && own.moves() && own.follows.is_none()).then(|| Motor::direct(joint))
        };
        self.motors = self.joints.iter().enumerate().filter_map(of).collect();
    }

    /// Reports limits of the speed of joints, which are only written as comments.
    pub(super) fn note_speed_limits(&mut self) {
        let joints = match self.joints.iter().filter(|joint| joint.rating.speed.is_some()).count() {
            0 => return,
            1 => "1 joint".to_owned(),
            count => format!("{count} joints"),
        };
        self.left_out.push(format!("speed limits of {joints} (`velocity`), which are not enforced"));
    }
}

/// Inputs and loads of all motors.
pub(super) fn write_motors(text: &mut String, robot: &Robot, placed: &[Placed]) {
    if robot.motors.is_empty() {
        return;
    }
    text.push_str("\n# Motors: an input keeps its value until a program or an event sets it.\n[inputs]\n");
    let (mut names, mut taken) = (Vec::new(), BTreeSet::new());
    for motor in &robot.motors {
        let given = motor.name.as_ref().map(|name| name.replace(|c: char| !c.is_ascii_alphanumeric(), "_"));
        // Expressions know joints and inputs by one name.
        let given = given.filter(|name| {
            name.starts_with(|c: char| c.is_ascii_alphabetic())
                && placed.iter().all(|joint| joint.own != *name)
        });
        let mut name = given.unwrap_or_else(|| format!("{}_motor", placed[motor.joint].own));
        while !taken.insert(name.clone()) {
            name.push('_');
        }
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name} = {}", Written(motor.start));
        names.push(name);
    }
    let mut of_joint = BTreeMap::<usize, Vec<usize>>::new();
    for (number, motor) in robot.motors.iter().enumerate() {
        of_joint.entry(motor.joint).or_default().push(number);
    }
    for (number, (motor, name)) in robot.motors.iter().zip(&names).enumerate() {
        let joint = &placed[motor.joint].own;
        let (kind, key, coordinate, rate) = match robot.joints[motor.joint].freedom {
            Freedom::Rotation => ("joint_torque", "torque", "angle", "rate"),
            _ => ("joint_force", "force", "displacement", "velocity"),
        };
        let law = |motor: &Motor, name: &str| {
            motor.law(name, &format!("{joint}.{coordinate}"), &format!("{joint}.{rate}"))
        };
        let law = match (robot.joints[motor.joint].rating.effort, &of_joint[&motor.joint][..]) {
            (None, _) => law(motor, name),
            // The limits of a joint hold for the sum of its motors, which the first of them exerts.
            (effort, all @ [first, ..]) if *first == number => {
                let sum: Vec<String> = all.iter().map(|&own| law(&robot.motors[own], &names[own])).collect();
                limited(sum.join(" + ").replace("+ -", "- "), effort)
            }
            _ => continue,
        };
        let _ = write!(text, "\n[loads.{name}]\nkind = \"{kind}\"\njoint = \"{joint}\"\n{key} = \"{law}\"\n");
    }
}
