//! A robot as a text of the model file.
//!
//! Links that fixed joints hold together are one body, with the frame of the link nearest to the root. With C₁ … Cₙ the centres
//! of mass and C the common one:
//!
//! ```text
//! J = Σ_i [R_i J_i R_iᵀ + m_i (d_i·d_i I - d_i d_iᵀ)],      d_i = C_i - C
//! ```

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use lissom_motion::{Matrix3, Motion, Rotation, Vector3, Vector6, rotation_part, screw, translation_part};

use super::{Freedom, ImportError, LinkInertia, Pose, Robot, RobotJoint};

/// What becomes of the root.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Root {
    /// It is held to the ground.
    #[default]
    Held,
    /// It moves freely.
    Floating,
}

/// What is written, and how.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// What becomes of the root.
    pub root: Root,
    /// Whether joints have stops at their limits.
    pub limits: bool,
    /// Whether joints have their damping and friction.
    pub friction: bool,
    /// Whether joints follow others where they mimic them.
    pub mimic: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self { root: Root::Held, limits: true, friction: true, mimic: true }
    }
}

/// Stiffness of stops [N m/rad, N/m].
const STOPS: f64 = 1e4;

/// Links that move as one.
struct Group {
    /// The link whose frame it has, the nearest to the root.
    link: usize,
    /// Name of its body; of the ground for what is held.
    name: String,
    /// Frame of that link and its twist in its own axes at the start.
    frame: Motion,
    twist: Vector6,
    mass: Option<LinkInertia>,
}

/// The model file of `robot` with its joints at `pose`, held to the ground at its root or floating.
///
/// # Errors
/// If a link that moves has no mass, if the pose names no joint of the robot, or leaves the range of one.
pub fn model_text(robot: &Robot, pose: &Pose, options: Options) -> Result<String, ImportError> {
    check_pose(robot, pose, options)?;
    let names = Names::of(robot);
    let (frames, twists, group_of) =
        places(robot, pose, if options.root == Root::Floating { pose.root_twist } else { Vector6::zeros() });
    let mut groups: Vec<Group> = Vec::new();
    let mut number = vec![0; robot.links.len()];
    for (link, own) in robot.links.iter().enumerate() {
        if group_of[link] == link {
            number[link] = groups.len();
            let is_ground = link == 0 && options.root == Root::Held;
            let name = if is_ground { "ground".to_owned() } else { names.links[link].clone() };
            groups.push(Group { link, name, frame: frames[link], twist: twists[link], mass: None });
        }
        number[link] = number[group_of[link]];
        let group = &mut groups[number[link]];
        if let Some(mass) = &own.inertia {
            let offset = frames[link].relative_to(&frames[group.link]);
            group.mass = Some(together(group.mass.as_ref(), &carried(mass, &offset)));
        }
    }
    let mut text = header(robot, options);
    for group in groups.iter().filter(|group| group.name != "ground") {
        let link = &robot.links[group.link].name;
        let mass = group.mass.filter(|mass| mass.mass > 0.0).ok_or_else(|| {
            ImportError::new(format!(
                "link `{link}` moves and has no mass, nor have the links fixed to it: give it an <inertial>, or fix it"
            ))
        })?;
        write_body(&mut text, group, &mass, names.links[group.link] != *link, link);
    }
    for (index, joint) in robot.joints.iter().enumerate() {
        let ends = [joint.parent, joint.child].map(|link| groups[number[link]].name.as_str());
        let name = &names.joints[index];
        let value = pose.values.get(&joint.name).copied().unwrap_or(0.0);
        write_joint(&mut text, joint, (name, ends), &frames[joint.child], value);
        write_resistance(&mut text, joint, name, options);
        if let Some((leader, factor, _)) = joint.follows.as_ref().filter(|_| options.mimic) {
            let leader = names.of_joint(robot, leader)?;
            let _ = write!(
                text,
                "\n[joints.{name}_follows]\nkind = \"gear\"\njoint = \"{leader}\"\nother = \"{name}\"\nratio = {factor:?}\n"
            );
        }
    }
    text.push_str(&footer(robot, &names));
    Ok(text)
}

/// Refuses values of joints that do not exist or lie beyond a limit, and followers that do not follow.
fn check_pose(robot: &Robot, pose: &Pose, options: Options) -> Result<(), ImportError> {
    for name in pose.values.keys().chain(pose.rates.keys()) {
        if !robot.joints.iter().any(|joint| joint.name == *name && joint.moves()) {
            let known: Vec<&str> =
                robot.joints.iter().filter(|joint| joint.moves()).map(|joint| joint.name.as_str()).collect();
            let message = format!("there is no joint `{name}` that moves; there are {}", known.join(", "));
            return Err(ImportError::new(message));
        }
    }
    let value = |of: &BTreeMap<String, f64>, name: &str| of.get(name).copied().unwrap_or(0.0);
    for joint in robot.joints.iter().filter(|joint| joint.moves()) {
        let own = value(&pose.values, &joint.name);
        if let Some([low, high]) = joint.range.filter(|_| options.limits)
            && !(low..=high).contains(&own)
        {
            let message = format!(
                "joint `{}` starts at {own}, outside of its limits {low} … {high}: give it another value at the start, or \
                 leave limits out",
                joint.name
            );
            return Err(ImportError::new(message));
        }
        if let Some((leader, factor, offset)) = joint.follows.as_ref().filter(|_| options.mimic) {
            for (of, offset) in [(&pose.values, *offset), (&pose.rates, 0.0)] {
                let (own, wanted) = (value(of, &joint.name), factor * value(of, leader) + offset);
                if (own - wanted).abs() > 1e-9 * (1.0 + wanted.abs()) {
                    let message = format!(
                        "joint `{}` follows `{leader}` and must start at {wanted}, but starts at {own}: give it this value",
                        joint.name
                    );
                    return Err(ImportError::new(message));
                }
            }
        }
    }
    Ok(())
}

/// Frames and twists of all links at the start, and the link at the root of the group of each.
fn places(robot: &Robot, pose: &Pose, root: Vector6) -> (Vec<Motion>, Vec<Vector6>, Vec<usize>) {
    let count = robot.links.len();
    let mut frames = vec![Motion::identity(); count];
    let mut twists = vec![root; count];
    let mut group_of: Vec<usize> = (0..count).collect();
    for joint in &robot.joints {
        let value = pose.values.get(&joint.name).copied().unwrap_or(0.0);
        let rate = pose.rates.get(&joint.name).copied().unwrap_or(0.0);
        let zero = Vector3::zeros();
        let (step, own) = match joint.freedom {
            Freedom::Rotation => (
                Motion::new(Rotation::about_axis(&joint.axis, value), zero),
                screw(&zero, &(rate * joint.axis)),
            ),
            Freedom::Displacement => {
                (Motion::translation(value * joint.axis), screw(&(rate * joint.axis), &zero))
            }
            Freedom::Fixed | Freedom::Floating => (Motion::identity(), Vector6::zeros()),
        };
        let offset = joint.origin * step;
        frames[joint.child] = frames[joint.parent] * offset;
        twists[joint.child] = offset.adjoint_inverse_times(&twists[joint.parent]) + own;
        if joint.freedom == Freedom::Fixed {
            group_of[joint.child] = group_of[joint.parent];
        }
    }
    (frames, twists, group_of)
}

/// The mass of a link whose frame lies at `offset` in another.
fn carried(mass: &LinkInertia, offset: &Motion) -> LinkInertia {
    let turn = offset.rotation.matrix();
    LinkInertia {
        mass: mass.mass,
        centre: offset.transform_point(&mass.centre),
        inertia: turn * mass.inertia * turn.transpose(),
    }
}

fn together(one: Option<&LinkInertia>, other: &LinkInertia) -> LinkInertia {
    let Some(one) = one else { return *other };
    let mass = one.mass + other.mass;
    if mass == 0.0 {
        return LinkInertia { inertia: one.inertia + other.inertia, ..*one };
    }
    let centre = (one.mass * one.centre + other.mass * other.centre) / mass;
    let about = |part: &LinkInertia| {
        let d = part.centre - centre;
        part.inertia + part.mass * (d.norm_squared() * Matrix3::identity() - d * d.transpose())
    };
    LinkInertia { mass, centre, inertia: about(one) + about(other) }
}

/// Names as the model file has them.
struct Names {
    links: Vec<String>,
    joints: Vec<String>,
}

impl Names {
    fn of(robot: &Robot) -> Self {
        let mut taken = BTreeSet::from(["ground".to_owned()]);
        let links = robot.links.iter().map(|link| free_name(&link.name, &mut taken)).collect();
        let mut taken = BTreeSet::new();
        let joints = robot.joints.iter().map(|joint| free_name(&joint.name, &mut taken)).collect();
        Self { links, joints }
    }

    fn of_joint(&self, robot: &Robot, name: &str) -> Result<&str, ImportError> {
        let index = robot.joints.iter().position(|joint| joint.name == name);
        index
            .map(|index| self.joints[index].as_str())
            .ok_or_else(|| ImportError::new(format!("a joint mimics `{name}`, which does not exist")))
    }
}

/// A name that can stand in expressions: letters, digits and underscores.
fn free_name(name: &str, taken: &mut BTreeSet<String>) -> String {
    let mut free: String =
        name.chars().map(|c| if c.is_ascii_alphanumeric() || c == '_' { c } else { '_' }).collect();
    if !free.starts_with(|c: char| c.is_ascii_alphabetic()) {
        free.insert_str(0, "part_");
    }
    while !taken.insert(free.clone()) {
        free.push('_');
    }
    free
}

fn header(robot: &Robot, options: Options) -> String {
    let title = robot.name.replace('\\', "\\\\").replace('"', "\\\"");
    let mut text = String::new();
    let _ = write!(
        text,
        "lissom = 1\ntitle = \"{title}\"\ngravity = [0, 0, -9.81]\n\n\
         # Imported from a robot description. Bodies have the frames of its links, with those that are fixed to them."
    );
    if options.limits {
        text.push_str(
            "\n# Stops are as stiff as `stop_stiffness` [N m/rad, N/m], which the description does not have.",
        );
    }
    text.push('\n');
    if options.limits && robot.joints.iter().any(|joint| joint.range.is_some()) {
        let _ = write!(text, "\n[parameters]\nstop_stiffness = {STOPS:?}\n");
    }
    text
}

fn footer(robot: &Robot, names: &Names) -> String {
    let mut text = String::new();
    for (joint, name) in robot.joints.iter().zip(&names.joints) {
        if joint.moves() {
            let _ = write!(text, "\n[outputs.{name}]\nkind = \"relative\"\nof = \"{name}\"\n");
        }
    }
    text + "\n[outputs.energy]\nkind = \"energy\"\n\n[analysis]\nkind = \"dynamics\"\nend = 1.0\nstep = 1e-3\n"
}

fn list(vector: &Vector3) -> String {
    format!("[{:?}, {:?}, {:?}]", vector.x, vector.y, vector.z)
}

fn write_body(text: &mut String, group: &Group, mass: &LinkInertia, renamed: bool, link: &str) {
    let note = if renamed { format!("   # link {}", link.escape_debug()) } else { String::new() };
    // Symmetric to the last digit, as a matrix of inertia must be.
    let inertia = 0.5 * (mass.inertia + mass.inertia.transpose());
    let rows: Vec<String> = (0..3).map(|k| list(&inertia.row(k).transpose())).collect();
    let _ = write!(
        text,
        "\n[bodies.{}]{note}\nmass = {:?}\ninertia = [{}]\ncenter_of_mass = {}\nposition = {}\nrotation = {}\n",
        group.name,
        mass.mass,
        rows.join(", "),
        list(&mass.centre),
        list(&group.frame.position),
        list(&group.frame.rotation.logarithm()),
    );
    if group.twist != Vector6::zeros() {
        let velocity = group.frame.rotation.apply(&translation_part(&group.twist));
        let angular = rotation_part(&group.twist);
        let _ = write!(text, "velocity = {}\nangular_velocity = {}\n", list(&velocity), list(&angular));
    }
}

fn write_joint(
    text: &mut String,
    joint: &RobotJoint,
    (name, [base, tip]): (&str, [&str; 2]),
    frame: &Motion,
    value: f64,
) {
    let (kind, key) = match joint.freedom {
        Freedom::Rotation => ("revolute", "angle"),
        Freedom::Displacement => ("prismatic", "displacement"),
        Freedom::Fixed | Freedom::Floating => return,
    };
    let _ = write!(
        text,
        "\n[joints.{name}]\nkind = \"{kind}\"\nbase = \"{base}\"\ntip = \"{tip}\"\nat = {}\naxis = {}\n",
        list(&frame.position),
        list(&frame.rotation.apply(&joint.axis)),
    );
    if value != 0.0 {
        let _ = writeln!(text, "{key} = {value:?}");
    }
    if let Some(effort) = joint.effort {
        let unit = if joint.freedom == Freedom::Rotation { "N m" } else { "N" };
        let _ = writeln!(text, "# its motor gives at most {effort:?} {unit}");
    }
}

/// Stops, damping and friction of a joint.
fn write_resistance(text: &mut String, joint: &RobotJoint, name: &str, options: Options) {
    let word = match joint.freedom {
        Freedom::Rotation => "torsional",
        Freedom::Displacement => "axial",
        Freedom::Fixed | Freedom::Floating => return,
    };
    if let Some([low, high]) = joint.range.filter(|[low, high]| options.limits && low < high) {
        let _ = write!(
            text,
            "\n[springs.{name}_limits]\nkind = \"{word}_stop\"\njoint = \"{name}\"\nrange = [{low:?}, {high:?}]\n\
             stiffness = \"stop_stiffness\"\n"
        );
    }
    if options.friction && joint.damping > 0.0 {
        let _ = write!(
            text,
            "\n[springs.{name}_damping]\nkind = \"{word}\"\njoint = \"{name}\"\ndamping = {:?}\n",
            joint.damping
        );
    }
    if options.friction && joint.friction > 0.0 {
        let _ = write!(
            text,
            "\n[springs.{name}_friction]\nkind = \"{word}_friction\"\njoint = \"{name}\"\ncoulomb = {:?}\n",
            joint.friction
        );
    }
}
