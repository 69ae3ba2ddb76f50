//! A robot as the text of a model file.
//!
//! Links connected by fixed joints are one body, with the frame of the link nearest to the root. With C₁ … Cₙ the centres of
//! mass and C the common one:
//!
//! ```text
//! J = Σ_i [R_i J_i R_iᵀ + m_i (d_i·d_i I - d_i d_iᵀ)],      d_i = C_i - C
//! ```

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use lissom_motion::{Matrix3, Motion, Rotation, Vector3, Vector6, rotation_part, screw, translation_part};

use super::chains::{Composite, composites};
use super::joint_text::{Placed, write_follower, write_joint, write_resistance, write_rotor};
use super::{Freedom, ImportError, LinkInertia, Pose, Robot};

/// Treatment of the root.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Root {
    /// It is fixed to the ground.
    #[default]
    Held,
    /// It moves freely.
    Floating,
}

/// Treatment of elements that act on a robot and cannot be modelled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Unsupported {
    /// The robot is rejected.
    #[default]
    Refused,
    /// They are omitted, with a comment in the model.
    LeftOut,
}

/// Contents of the model file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Treatment of the root.
    pub root: Root,
    /// Whether joints have stops at their limits.
    pub limits: bool,
    /// Whether joints include damping and friction.
    pub friction: bool,
    /// Whether mimic joints follow others.
    pub mimic: bool,
    /// Treatment of elements that act on the robot and cannot be modelled.
    pub unsupported: Unsupported,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            root: Root::Held,
            limits: true,
            friction: true,
            mimic: true,
            unsupported: Unsupported::Refused,
        }
    }
}

/// Stiffness of stops [N m/rad, N/m].
const STOPS: f64 = 1e4;

/// Links that move as one body.
struct Group {
    /// The link whose frame it has, the nearest to the root.
    link: usize,
    /// Name of its body, or of the ground for fixed links.
    name: String,
    /// Initial frame of that link and its twist in its own axes.
    frame: Motion,
    twist: Vector6,
    mass: Option<LinkInertia>,
    /// Entries of its shape.
    shapes: Vec<String>,
}

/// The model file of `robot` with its joints at `pose`, with a fixed or floating root.
///
/// # Errors
/// If a moving link has no mass, if the pose refers to an unknown joint or exceeds a range, or if an element acts on the robot
/// that cannot be modelled.
pub fn model_text(robot: &Robot, pose: &Pose, options: Options) -> Result<String, ImportError> {
    check_support(robot, options)?;
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
            groups.push(Group {
                link,
                name,
                frame: frames[link],
                twist: twists[link],
                mass: None,
                shapes: Vec::new(),
            });
        }
        number[link] = number[group_of[link]];
        let group = &mut groups[number[link]];
        let offset = frames[link].relative_to(&frames[group.link]);
        group.shapes.extend(own.visuals.iter().filter_map(|visual| visual.text(&offset)));
        if let Some(mass) = &own.inertia {
            group.mass = Some(together(group.mass.as_ref(), &carried(mass, &offset)));
        }
    }
    let massive: Vec<bool> =
        groups.iter().map(|group| group.mass.is_some_and(|mass| mass.mass > 0.0)).collect();
    let composites = composites(robot, &frames, &number, &massive)?;
    let inner: BTreeSet<usize> =
        composites.iter().flat_map(|composite| composite.inner_groups.iter().copied()).collect();
    let mut text = header(robot, options);
    for (_, group) in
        groups.iter().enumerate().filter(|(number, group)| group.name != "ground" && !inner.contains(number))
    {
        let link = &robot.links[group.link].name;
        let mass = group.mass.filter(|mass| mass.mass > 0.0).ok_or_else(|| {
            ImportError::new(format!(
                "link `{link}` moves, but neither it nor the links fixed to it have mass: add an <inertial>, or fix it"
            ))
        })?;
        write_body(&mut text, group, &mass, names.links[group.link] != *link, link);
    }
    let group_name = |link: usize| groups[number[link]].name.as_str();
    let placed: Vec<Placed> = (0..robot.joints.len())
        .map(|index| placed(robot, pose, &names, &composites, (index, &frames)))
        .collect();
    for (joint, place) in robot.joints.iter().zip(&placed) {
        let composite = composites.iter().find(|composite| composite.joints.contains(&place.index));
        match composite {
            Some(composite) if composite.joints.last() == Some(&place.index) => {
                let base = robot.joints[composite.joints[0]].parent;
                composite.write(
                    &mut text,
                    &robot.joints,
                    &place.joint,
                    [group_name(base), group_name(joint.child)],
                    &placed,
                );
            }
            Some(_) => {}
            None => write_joint(&mut text, joint, place, [group_name(joint.parent), group_name(joint.child)]),
        }
    }
    for (joint, place) in robot.joints.iter().zip(&placed) {
        write_resistance(&mut text, joint, place, options);
        write_rotor(&mut text, joint, place, &robot.gravity);
        if let Some((leader, factor, _)) = joint.follows.as_ref().filter(|_| options.mimic) {
            let leader = robot.joints.iter().position(|own| own.name == *leader).ok_or_else(|| {
                ImportError::new(format!("a joint mimics `{leader}`, which does not exist"))
            })?;
            write_follower(&mut text, place, &placed[leader], *factor);
        }
    }
    text.push_str(&footer(robot, &placed));
    Ok(text)
}

/// The coordinate of a robot's joint in the model.
fn placed(
    robot: &Robot,
    pose: &Pose,
    names: &Names,
    composites: &[Composite],
    (index, frames): (usize, &[Motion]),
) -> Placed {
    let joint = &robot.joints[index];
    let frame = &frames[joint.child];
    let value = pose.values.get(&joint.name).copied().unwrap_or(joint.reference);
    let own = names.joints[index].clone();
    let of = composites.iter().find(|composite| composite.joints.contains(&index));
    let (joint_name, coordinate) = match of {
        // A joint that replaces several has the name of the last one.
        Some(composite) => {
            let last = composite.joints[composite.joints.len() - 1];
            (names.joints[last].clone(), composite.coordinate(index))
        }
        None => (own.clone(), None),
    };
    // Joints without an initial value have the zero of their coordinates at the start.
    let start = if of.is_some_and(Composite::counts_from_the_start) { 0.0 } else { value };
    Placed {
        index,
        own,
        joint: joint_name,
        coordinate,
        value: start,
        shift: start - value,
        rate: pose.rates.get(&joint.name).copied().unwrap_or(0.0),
        at: frame.transform_point(&joint.anchor),
        axis: frame.rotation.apply(&joint.axis),
    }
}

/// Rejects elements that cannot be modelled.
fn check_support(robot: &Robot, options: Options) -> Result<(), ImportError> {
    if robot.is_root_the_world && options.root == Root::Floating {
        return Err(ImportError::new(
            "the root of this description is the world, which cannot move: free bodies must have a <freejoint/>",
        ));
    }
    if options.unsupported == Unsupported::Refused && !robot.unsupported.is_empty() {
        let message = format!(
            "the model would move otherwise than the robot: {}; take it out of the description, or leave it out by `--without \
             unsupported`",
            robot.unsupported.join("; ")
        );
        return Err(ImportError::new(message));
    }
    for joint in robot.joints.iter().filter(|joint| !joint.moves()) {
        if options.limits && joint.range.is_some() {
            let message = format!(
                "joint `{}`: limits of a ball joint are not supported: use `--without limits`",
                joint.name
            );
            return Err(ImportError::new(message));
        }
        if options.friction && (joint.damping > 0.0 || joint.friction > 0.0) {
            let message = format!(
                "joint `{}`: damping and friction of ball and free joints are not supported: use `--without friction`",
                joint.name
            );
            return Err(ImportError::new(message));
        }
    }
    Ok(())
}

/// Rejects values for unknown joints or beyond a limit, and values of mimic joints that contradict their leader.
fn check_pose(robot: &Robot, pose: &Pose, options: Options) -> Result<(), ImportError> {
    for name in pose.values.keys().chain(pose.rates.keys()) {
        if !robot.joints.iter().any(|joint| joint.name == *name && joint.moves()) {
            let known: Vec<&str> =
                robot.joints.iter().filter(|joint| joint.moves()).map(|joint| joint.name.as_str()).collect();
            let message =
                format!("there is no moving joint `{name}`; moving joints are {}", known.join(", "));
            return Err(ImportError::new(message));
        }
    }
    let reference = |name: &str| {
        robot.joints.iter().find(|joint| joint.name == name).map_or(0.0, |joint| joint.reference)
    };
    let value = |of: &BTreeMap<String, f64>, name: &str| {
        let default = if std::ptr::eq(of, &raw const pose.values) { reference(name) } else { 0.0 };
        of.get(name).copied().unwrap_or(default)
    };
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
                        "joint `{}` mimics `{leader}` and must start at {wanted}, not {own}: specify this value",
                        joint.name
                    );
                    return Err(ImportError::new(message));
                }
            }
        }
    }
    Ok(())
}

/// Initial frames and twists of all links, and the link at the root of the group of each.
fn places(robot: &Robot, pose: &Pose, root: Vector6) -> (Vec<Motion>, Vec<Vector6>, Vec<usize>) {
    let count = robot.links.len();
    let mut frames = vec![Motion::identity(); count];
    let mut twists = vec![root; count];
    let mut group_of: Vec<usize> = (0..count).collect();
    for joint in &robot.joints {
        let value = pose.values.get(&joint.name).copied().unwrap_or(joint.reference) - joint.reference;
        let rate = pose.rates.get(&joint.name).copied().unwrap_or(0.0);
        let (step, own) = match joint.freedom {
            Freedom::Rotation => {
                let turn = Motion::new(Rotation::about_axis(&joint.axis, value), Vector3::zeros());
                let anchor = Motion::translation(joint.anchor);
                let spin = rate * joint.axis;
                (anchor * turn * anchor.inverse(), screw(&joint.anchor.cross(&spin), &spin))
            }
            Freedom::Displacement => {
                (Motion::translation(value * joint.axis), screw(&(rate * joint.axis), &Vector3::zeros()))
            }
            Freedom::Fixed | Freedom::Ball | Freedom::Floating => (Motion::identity(), Vector6::zeros()),
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

/// The mass of a link whose frame is at `offset` in another.
pub(super) fn carried(mass: &LinkInertia, offset: &Motion) -> LinkInertia {
    let turn = offset.rotation.matrix();
    LinkInertia {
        mass: mass.mass,
        centre: offset.transform_point(&mass.centre),
        inertia: turn * mass.inertia * turn.transpose(),
    }
}

/// The mass of two links that move as one body.
pub(super) fn together(one: Option<&LinkInertia>, other: &LinkInertia) -> LinkInertia {
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

/// Names in the model file.
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
}

/// A name that can be used in expressions: letters, digits and underscores.
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
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "lissom = 1\ntitle = \"{title}\"\ngravity = {}\n\n\
         # Imported from a robot description. Bodies have the frames of its links, with those that are fixed to them.",
        list(&robot.gravity)
    );
    if options.limits {
        text.push_str("\n# Stiffness of stops [N m/rad, N/m], which the description does not specify.");
    }
    for what in robot.left_out.iter().cloned().chain(robot.meshes_left_out()).chain(robot.unsupported.clone())
    {
        let _ = write!(text, "\n# Omitted: {}.", what.escape_debug());
    }
    text.push('\n');
    if options.limits && robot.joints.iter().any(|joint| joint.range.is_some()) {
        let _ = write!(text, "\n[parameters]\nstop_stiffness = {STOPS:?}\n");
    }
    text
}

fn footer(robot: &Robot, placed: &[Placed]) -> String {
    let mut text = String::new();
    let mut recorded = BTreeSet::new();
    for (joint, place) in robot.joints.iter().zip(placed) {
        if joint.moves() && recorded.insert(&place.joint) {
            let _ = write!(text, "\n[outputs.{0}]\nkind = \"relative\"\nof = \"{0}\"\n", place.joint);
        }
    }
    text + "\n[outputs.energy]\nkind = \"energy\"\n\n[analysis]\nkind = \"dynamics\"\nend = 1.0\n"
}

/// Numbers for the model file, without the sign of negative zeros.
pub(super) fn list(vector: &Vector3) -> String {
    let [x, y, z] = [vector.x + 0.0, vector.y + 0.0, vector.z + 0.0];
    format!("[{x:?}, {y:?}, {z:?}]")
}

fn write_body(text: &mut String, group: &Group, mass: &LinkInertia, renamed: bool, link: &str) {
    let note = if renamed { format!("   # link {}", link.escape_debug()) } else { String::new() };
    // Exactly symmetric, as required for a matrix of inertia.
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
    if !group.shapes.is_empty() {
        let _ = write!(text, "shape = [\n    {},\n]\n", group.shapes.join(",\n    "));
    }
    if group.twist != Vector6::zeros() {
        let velocity = group.frame.rotation.apply(&translation_part(&group.twist));
        let angular = rotation_part(&group.twist);
        let _ = write!(text, "velocity = {}\nangular_velocity = {}\n", list(&velocity), list(&angular));
    }
}
