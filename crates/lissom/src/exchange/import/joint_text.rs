//! Joints of a robot in the text of the model file, with springs, dampers, friction and stops.

use std::fmt::Write;

use lissom_motion::Vector3;

use super::model_text::Options;
use super::{Closure, Freedom, RobotJoint, list};

/// The coordinate of a robot's joint in the model.
pub(super) struct Placed {
    /// Name of the coordinate in the model.
    pub(super) own: String,
    /// The coordinate's initial value [rad, m].
    pub(super) value: f64,
    /// A point of its axis and its direction at the start, in global axes.
    pub(super) at: Vector3,
    pub(super) axis: Vector3,
}

/// A single joint between two bodies.
pub(super) fn write_joint(
    text: &mut String,
    joint: &RobotJoint,
    place: &Placed,
    [base, tip]: [&str; 2],
    options: Options,
) {
    let name = &place.own;
    let (kind, key) = match joint.freedom {
        Freedom::Rotation => ("revolute", "angle"),
        Freedom::Displacement => ("prismatic", "displacement"),
        Freedom::Ball => {
            // Writing to a string cannot fail.
            let _ = write!(
                text,
                "\n[joints.{name}]\nkind = \"spherical\"\nbase = \"{base}\"\ntip = \"{tip}\"\nat = {}\n",
                list(&place.at)
            );
            let resisting = |value: f64, key: &str| {
                if value > 0.0 {
                    format!("{key} = [0, 0, 0, {value:?}, {value:?}, {value:?}]\n")
                } else {
                    String::new()
                }
            };
            let damping = if options.friction { joint.damping } else { 0.0 };
            let resistance = resisting(joint.spring.stiffness, "stiffness") + &resisting(damping, "damping");
            if !resistance.is_empty() {
                let word = if joint.spring.stiffness > 0.0 { "stiffness" } else { "damping" };
                let _ = write!(
                    text,
                    "\n[springs.{}_{word}]\nkind = \"bushing\"\nbase = \"{base}\"\ntip = \"{tip}\"\nat_base = {at}\n\
                     at_tip = {at}\n{resistance}",
                    place.own,
                    at = list(&place.at)
                );
            }
            return;
        }
        Freedom::Fixed | Freedom::Floating => return,
    };
    let _ = write!(
        text,
        "\n[joints.{name}]\nkind = \"{kind}\"\nbase = \"{base}\"\ntip = \"{tip}\"\nat = {}\naxis = {}\n",
        list(&place.at),
        list(&place.axis),
    );
    if place.value != 0.0 {
        let _ = writeln!(text, "{key} = {:?}", place.value);
    }
    write_rating(text, joint);
}

/// The maximum torque and speed of a motor, as comments.
fn write_rating(text: &mut String, joint: &RobotJoint) {
    if let Some([low, high]) = joint.rating.effort {
        let unit = if joint.freedom == Freedom::Rotation { "N m" } else { "N" };
        let limits = if low == -high {
            format!("at most {high:?} {unit}")
        } else {
            format!("{low:?} to {high:?} {unit}")
        };
        let _ = writeln!(text, "# the motor of {} exerts {limits}", joint.name.escape_debug());
    }
    if let Some(speed) = joint.rating.speed {
        let unit = if joint.freedom == Freedom::Rotation { "rad/s" } else { "m/s" };
        let _ = writeln!(
            text,
            "# the speed limit of {} is {speed:?} {unit}; it is not enforced",
            joint.name.escape_debug()
        );
    }
}

/// Stops, springs, damping and friction of a joint with a coordinate.
pub(super) fn write_resistance(text: &mut String, joint: &RobotJoint, place: &Placed, options: Options) {
    let (word, rest_key) = match joint.freedom {
        Freedom::Rotation => ("torsional", "angle"),
        Freedom::Displacement => ("axial", "displacement"),
        Freedom::Fixed | Freedom::Ball | Freedom::Floating => return,
    };
    let own = &place.own;
    let mut entry = |name: &str, kind: &str, rest: &str| {
        let _ = write!(text, "\n[springs.{own}_{name}]\nkind = \"{word}{kind}\"\njoint = \"{own}\"\n{rest}");
    };
    if let Some([low, high]) = joint.range.filter(|_| options.limits && joint.has_stop()) {
        entry("limits", "_stop", &format!("range = [{low:?}, {high:?}]\nstiffness = \"stop_stiffness\"\n"));
    }
    if joint.spring.stiffness > 0.0 {
        entry(
            "stiffness",
            "",
            &format!("stiffness = {:?}\n{rest_key} = {:?}\n", joint.spring.stiffness, joint.spring.rest),
        );
    }
    if options.friction && joint.damping > 0.0 {
        entry("damping", "", &format!("damping = {:?}\n", joint.damping));
    }
    if options.friction && joint.friction > 0.0 {
        entry("friction", "_friction", &format!("coulomb = {:?}\n", joint.friction));
    }
}

/// The inertia of a rotor that acts on a coordinate only: ½ a q̇².
pub(super) fn write_armature(text: &mut String, joint: &RobotJoint, place: &Placed) {
    let word = match joint.freedom {
        Freedom::Rotation => "angle",
        Freedom::Displacement => "displacement",
        Freedom::Fixed | Freedom::Ball | Freedom::Floating => return,
    };
    if joint.armature > 0.0 {
        let own = &place.own;
        let _ = write!(
            text,
            "\n[springs.{own}_armature]\nkind = \"coordinate_dynamics\"\ncoordinates = [\"{own}.{word}\"]\nmass = {:?}\n",
            joint.armature
        );
    }
}

/// A coordinate that follows another.
pub(super) fn write_follower(text: &mut String, own: &Placed, leader: &Placed, factor: f64) {
    let _ = write!(
        text,
        "\n[joints.{}_follows]\nkind = \"gear\"\njoint = \"{}\"\nother = \"{}\"\nratio = {factor:?}\nrelative = true\n",
        own.own, leader.own, own.own,
    );
}

/// A joint that closes a loop at a point, global axes.
pub(super) fn write_closure(
    text: &mut String,
    name: &str,
    closure: &Closure,
    at: &Vector3,
    [base, tip]: [&str; 2],
) {
    let kind = if closure.locks_rotation { "clamp" } else { "spherical" };
    let _ = write!(
        text,
        "\n[joints.{name}]\nkind = \"{kind}\"\nbase = \"{base}\"\ntip = \"{tip}\"\nat = {}\n",
        list(at)
    );
}
