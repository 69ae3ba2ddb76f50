//! Sensors of a robot as outputs of the model file.
//!
//! Legend: x, v, ω, a position, velocity, angular velocity and acceleration of the sensor's origin, g gravity, R and S rotations from
//! the axes of the body and of the sensor to the global ones
//!
//! ```text
//! global axes    x,  v,  ω               sensor axes    Sᵀ v,  Sᵀ ω,  Sᵀ (a - g)
//! ```
//!
//! SᵀR is constant. Where it is not the identity, or gravity is included, the components are expressions of outputs in body axes, with
//! Rᵀ g from the quaternion of the body.

use std::collections::BTreeSet;
use std::fmt::Write;

use lissom_motion::{Matrix3, Motion, Vector3};

use super::joint_text::Placed;
use super::model_text::free_name;
use super::{Freedom, Robot, list};

/// A sensor that becomes outputs.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    /// Name of the sensor.
    pub name: String,
    /// The measured quantity.
    pub quantity: Measured,
}

/// A quantity that a sensor measures.
#[derive(Clone, Debug, PartialEq)]
pub enum Measured {
    /// The coordinate of the joint with this index [rad, m].
    Coordinate(usize),
    /// The rate of its coordinate [rad/s, m/s].
    Rate(usize),
    /// A quantity of a frame that is fixed to a link.
    Motion {
        /// The quantity.
        kind: MotionKind,
        /// Index of the link.
        link: usize,
        /// Frame of the sensor in that of the link.
        frame: Motion,
    },
}

/// A quantity of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionKind {
    /// The position of its origin in global axes [m].
    Position,
    /// The velocity of its origin in global axes [m/s].
    Velocity,
    /// The angular velocity in global axes [rad/s].
    AngularVelocity,
    /// The velocity of its origin in its own axes [m/s].
    OwnVelocity,
    /// The angular velocity in its own axes [rad/s].
    OwnAngularVelocity,
    /// The acceleration of its origin less gravity, in its own axes [m/s²].
    SpecificForce,
}

impl MotionKind {
    /// Kind of the output, the letter of its components and their unit; none has the unit of the kind.
    fn output(self) -> (&'static str, &'static str, &'static str) {
        match self {
            Self::Position => ("position", "", "m"),
            Self::Velocity | Self::OwnVelocity => ("velocity", "v", "m/s"),
            Self::AngularVelocity | Self::OwnAngularVelocity => ("angular_velocity", "w", "rad/s"),
            Self::SpecificForce => ("acceleration", "a", "m/s^2"),
        }
    }

    fn is_global(self) -> bool {
        matches!(self, Self::Position | Self::Velocity | Self::AngularVelocity)
    }
}

/// A body with a sensor: its name, and the poses of the body and of the sensor at the start.
pub(super) struct Mount<'a> {
    pub(super) body: &'a str,
    pub(super) pose: Motion,
    pub(super) sensor: Motion,
}

/// Outputs of all sensors, besides those with names that are `taken`; `mount` gives the body of a frame in a link.
pub(super) fn write_sensors<'a>(
    text: &mut String,
    robot: &Robot,
    (placed, taken): (&[Placed], &mut BTreeSet<String>),
    mount: impl Fn(usize, &Motion) -> Mount<'a>,
) {
    for sensor in &robot.sensors {
        let name = free_name(&sensor.name, taken);
        match &sensor.quantity {
            Measured::Coordinate(joint) | Measured::Rate(joint) => {
                let is_rate = matches!(sensor.quantity, Measured::Rate(_));
                let (word, unit) = match (robot.joints[*joint].freedom, is_rate) {
                    (Freedom::Rotation, false) => ("angle", "rad"),
                    (Freedom::Rotation, true) => ("rate", "rad/s"),
                    (_, false) => ("displacement", "m"),
                    (_, true) => ("velocity", "m/s"),
                };
                write_expression(text, &name, &format!("{}.{word}", placed[*joint].own), unit);
            }
            Measured::Motion { kind, link, frame } => {
                let mount = mount(*link, frame);
                write_motion(text, &name, *kind, &mount, &robot.gravity, taken);
            }
        }
    }
}

// Writing to a string cannot fail.
fn write_expression(text: &mut String, name: &str, value: &str, unit: &str) {
    let _ =
        write!(text, "\n[outputs.{name}]\nkind = \"expression\"\nvalue = \"{value}\"\nunit = \"{unit}\"\n");
}

fn write_motion(
    text: &mut String,
    name: &str,
    kind: MotionKind,
    Mount { body, pose, sensor }: &Mount<'_>,
    gravity: &Vector3,
    taken: &mut BTreeSet<String>,
) {
    let (word, letter, unit) = kind.output();
    let turn: Matrix3 = sensor.rotation.matrix().transpose() * pose.rotation.matrix();
    let has_weight = kind == MotionKind::SpecificForce && *gravity != Vector3::zeros();
    let is_plain = kind.is_global() || !has_weight && (turn - Matrix3::identity()).amax() < 1e-12;
    let own = if is_plain { name.to_owned() } else { free_name(&format!("{name}_in_body"), taken) };
    let _ = write!(text, "\n[outputs.{own}]\nkind = \"{word}\"\nof = \"{body}\"\n");
    if word != "angular_velocity" {
        let _ = writeln!(text, "point = {}", list(&sensor.position));
    }
    if !kind.is_global() {
        let _ = writeln!(text, "in = \"{body}\"");
    }
    if is_plain {
        return;
    }
    let mut values: Vec<String> = (1..4).map(|k| format!("{own}.{letter}{k}")).collect();
    let is_turned = (turn - Matrix3::identity()).amax() > 1e-12;
    if has_weight {
        let axes = free_name(&format!("{name}_axes"), taken);
        let _ = write!(text, "\n[outputs.{axes}]\nkind = \"quaternion\"\nof = \"{body}\"\n");
        for (k, value) in values.iter_mut().enumerate() {
            let weight: Vec<String> = (0..3)
                .filter(|axis| gravity[*axis] != 0.0)
                .map(|axis| format!("{:?}*{}", gravity[axis], inverse_entry(&axes, k, axis)))
                .collect();
            let name = format!("{name}{}_{}", if is_turned { "_body" } else { "" }, k + 1);
            let name = free_name(&name, taken);
            write_expression(text, &name, &format!("{value} - ({})", summed(&weight)), unit);
            *value = format!("{name}.value");
        }
    }
    for k in (0..3).filter(|_| is_turned) {
        let term = |axis: usize| {
            let factor = turn[(k, axis)];
            // Round-off of right angles.
            let nearest = factor.round();
            let factor = if (factor - nearest).abs() < 1e-14 { nearest } else { factor };
            match factor {
                0.0 => None,
                1.0 => Some(values[axis].clone()),
                _ => Some(format!("{factor:?}*{}", values[axis])),
            }
        };
        let terms: Vec<String> = (0..3).filter_map(term).collect();
        let name = free_name(&format!("{name}_{}", k + 1), taken);
        write_expression(text, &name, &summed(&terms), unit);
    }
}

fn summed(terms: &[String]) -> String {
    terms.join(" + ").replace("+ -", "- ")
}

/// An entry of the inverse of the rotation with the output `axes` as quaternion, Rᵀ = I + 2 (q̃² - q₀ q̃), counted from 0.
fn inverse_entry(axes: &str, row: usize, column: usize) -> String {
    let product = |first: usize, second: usize| format!("{axes}.q{first}*{axes}.q{second}");
    if row == column {
        let others: Vec<String> = (1..4).filter(|k| *k != row + 1).map(|k| product(k, k)).collect();
        return format!("(1 - 2*({}))", others.join(" + "));
    }
    let sign = if (row + 1) % 3 == column { '+' } else { '-' };
    format!("2*({} {sign} {})", product(row + 1, column + 1), product(0, 4 - row - column))
}
