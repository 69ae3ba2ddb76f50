//! A robot as a URDF text.

use std::fmt::Write;

use lissom_motion::{Motion, Rotation, Vector3};

use super::urdf::NO_LIMIT;
use super::{Freedom, LinkInertia, Robot, RobotJoint};

/// Range required by the format for a prismatic joint without limits [m].
const FAR: f64 = 1e6;

/// The description of `robot`, with frames at zero values of all joints. Numbers have the fewest digits that reproduce them
/// exactly.
pub fn to_urdf(robot: &Robot) -> String {
    let mut text = String::from("<?xml version=\"1.0\"?>\n");
    // Writing to a string cannot fail.
    for what in robot.left_out.iter().chain(&robot.unsupported) {
        // Two hyphens would end the comment.
        let _ = writeln!(text, "<!-- Omitted: {}. -->", escaped(what).replace("--", "- -"));
    }
    let _ = writeln!(text, "<robot name=\"{}\">", escaped(&robot.name));
    for link in &robot.links {
        match &link.inertia {
            None => {
                let _ = writeln!(text, "  <link name=\"{}\"/>", escaped(&link.name));
            }
            Some(mass) => {
                let _ =
                    writeln!(text, "  <link name=\"{}\">\n{}  </link>", escaped(&link.name), inertial(mass));
            }
        }
    }
    for joint in &robot.joints {
        write_joint(&mut text, robot, joint);
    }
    text + "</robot>\n"
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

fn three(vector: &Vector3) -> String {
    let [x, y, z] = [vector.x + 0.0, vector.y + 0.0, vector.z + 0.0];
    format!("{x:?} {y:?} {z:?}")
}

fn inertial(mass: &LinkInertia) -> String {
    let j = 0.5 * (mass.inertia + mass.inertia.transpose());
    format!(
        "    <inertial>\n      <origin xyz=\"{}\" rpy=\"0 0 0\"/>\n      <mass value=\"{:?}\"/>\n      \
         <inertia ixx=\"{:?}\" ixy=\"{:?}\" ixz=\"{:?}\" iyy=\"{:?}\" iyz=\"{:?}\" izz=\"{:?}\"/>\n    </inertial>\n",
        three(&mass.centre),
        mass.mass,
        j[(0, 0)],
        j[(0, 1)],
        j[(0, 2)],
        j[(1, 1)],
        j[(1, 2)],
        j[(2, 2)]
    )
}

/// Roll, pitch and yaw: rotations about the fixed axes x, y, z in this order. Yaw is computed first, so that pitch and roll
/// are also accurate near a pitch of a quarter turn.
fn roll_pitch_yaw(rotation: &Rotation) -> Vector3 {
    let own = rotation.matrix();
    let yaw = own[(1, 0)].atan2(own[(0, 0)]);
    let rest = (Rotation::about_axis(&Vector3::z(), yaw).inverse() * *rotation).matrix();
    let pitch = (-rest[(2, 0)]).atan2(rest[(0, 0)]);
    let roll = (-rest[(1, 2)]).atan2(rest[(1, 1)]);
    Vector3::new(roll, pitch, yaw)
}

fn origin(frame: &Motion) -> String {
    format!(
        "<origin xyz=\"{}\" rpy=\"{}\"/>",
        three(&frame.position),
        three(&roll_pitch_yaw(&frame.rotation))
    )
}

fn write_joint(text: &mut String, robot: &Robot, joint: &RobotJoint) {
    let kind = match joint.freedom {
        Freedom::Rotation if joint.range.is_some() => "revolute",
        Freedom::Rotation => "continuous",
        Freedom::Displacement => "prismatic",
        Freedom::Fixed => "fixed",
        Freedom::Ball | Freedom::Floating => "floating",
    };
    let name = |link: usize| escaped(&robot.links[link].name);
    let _ = write!(
        text,
        "  <joint name=\"{}\" type=\"{kind}\">\n    {}\n    <parent link=\"{}\"/>\n    <child link=\"{}\"/>\n",
        escaped(&joint.name),
        origin(&joint.origin),
        name(joint.parent),
        name(joint.child)
    );
    if joint.moves() {
        let _ = writeln!(text, "    <axis xyz=\"{}\"/>", three(&joint.axis));
        let range = joint.range.or((joint.freedom == Freedom::Displacement).then_some([-FAR, FAR]));
        if let Some([low, high]) = range {
            // Torque and rate are required; a model has no such limits.
            let effort = joint.rating.effort.map_or(NO_LIMIT, |[_, high]| high);
            let speed = joint.rating.speed.unwrap_or(NO_LIMIT);
            let _ = writeln!(
                text,
                "    <limit lower=\"{low:?}\" upper=\"{high:?}\" effort=\"{effort:?}\" velocity=\"{speed:?}\"/>"
            );
        }
        if joint.damping != 0.0 || joint.friction != 0.0 {
            let _ = writeln!(
                text,
                "    <dynamics damping=\"{:?}\" friction=\"{:?}\"/>",
                joint.damping, joint.friction
            );
        }
        if let Some((leader, factor, offset)) = &joint.follows {
            let _ = writeln!(
                text,
                "    <mimic joint=\"{}\" multiplier=\"{factor:?}\" offset=\"{offset:?}\"/>",
                escaped(leader)
            );
        }
    }
    text.push_str("  </joint>\n");
}
