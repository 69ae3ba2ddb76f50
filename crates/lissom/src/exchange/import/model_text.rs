//! A robot as the text of a model file.
//!
//! Links connected by fixed joints are one body, with the frame of the link nearest to the root. With C₁ … Cₙ the centres of
//! mass and C the common one:
//!
//! ```text
//! J = Σ_i [R_i J_i R_iᵀ + m_i (d_i·d_i I - d_i d_iᵀ)],      d_i = C_i - C
//! ```

use std::collections::BTreeSet;
use std::fmt::Write;

use lissom_motion::{Matrix3, Motion, Rotation, Vector3, Vector6, rotation_part, screw, translation_part};

use super::contacts::{Contacts, TouchingBody};
use super::joint_text::{
    Placed, write_armature, write_closure, write_follower, write_joint, write_resistance,
};
use super::massless::{Massless, without_mass};
use super::motors::{Motors, write_motors};
use super::sensors::{Mount, write_sensors};
use super::start::{Start, prefix};
use super::{Closure, Freedom, ImportError, LinkInertia, Pose, Robot, list};

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
#[expect(clippy::struct_excessive_bools, reason = "each is an option of the command by itself")]
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
    /// Whether bodies touch each other.
    pub contacts: bool,
    /// Treatment of motors.
    pub motors: Motors,
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
            contacts: true,
            motors: Motors::Omitted,
            unsupported: Unsupported::Refused,
        }
    }
}

/// Largest distance of the two points of a closure, and entry of its relative rotation [m, 1].
const CLOSED: f64 = 1e-9;
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
    /// Entries of its shape; an empty one draws nothing. None for a link without visuals.
    shapes: Option<Vec<String>>,
    /// Links of the body.
    links: Vec<usize>,
}

impl Group {
    fn has_mass(&self) -> bool {
        self.mass.is_some_and(|mass| mass.mass > 0.0)
    }

    /// The line of its shape in the model file.
    fn shape_line(&self) -> String {
        match self.shapes.as_deref() {
            None => String::new(),
            Some([]) => "shape = []\n".to_owned(),
            Some(shapes) => format!("shape = [\n    {},\n]\n", shapes.join(",\n    ")),
        }
    }
}

/// The model file of `robot` with its joints at `pose`, with a fixed or floating root. Links without mass between joints are
/// bodies without mass.
///
/// # Errors
/// All of these at once: [obstacles](Robot::obstacles) of the description, elements that act on the robot and cannot be modelled, joints
/// that move no mass, links with mass and without inertia, loops that are open, positions that refer to an unknown joint or
/// exceed a range.
pub fn model_text(robot: &Robot, pose: &Pose, options: Options) -> Result<String, ImportError> {
    let start = Start::of(robot, pose, options);
    let (mut groups, number, frames) = grouped(robot, &start.pose, options);
    let mut obstacles = robot.obstacles.clone();
    obstacles.extend(unsupported(robot, options));
    obstacles.extend(start.obstacles.iter().cloned());
    // The bodies of a description with faults are incomplete.
    if robot.obstacles.is_empty() {
        obstacles.extend(wrong_masses(robot, &groups, &number, &frames, options));
        obstacles.extend(open_loops(robot, &frames));
    }
    if !obstacles.is_empty() {
        return Err(ImportError::of(&obstacles));
    }
    let names = Names::of(robot);
    let contacts = if options.contacts {
        Contacts::of(robot, &touching_bodies(robot, &groups, &number))
    } else {
        Contacts::none(robot)
    };
    draw(robot, &mut groups, &frames, &contacts);
    let mut text = header(robot, options, &start, &contacts);
    for group in &groups {
        write_group(&mut text, group, &names.links[group.link], &robot.links[group.link].name);
    }
    let group_name = |link: usize| groups[number[link]].name.as_str();
    let placed: Vec<Placed> = robot
        .joints
        .iter()
        .enumerate()
        .map(|(index, joint)| {
            let frame = &frames[joint.child];
            Placed {
                own: names.joints[index].clone(),
                value: start.pose.values.get(&joint.name).copied().unwrap_or(joint.reference),
                at: frame.transform_point(&joint.anchor),
                axis: frame.rotation.apply(&joint.axis),
            }
        })
        .collect();
    for (joint, place) in robot.joints.iter().zip(&placed) {
        write_joint(&mut text, joint, place, [group_name(joint.parent), group_name(joint.child)], options);
    }
    for (closure, name) in robot.closures.iter().zip(&names.closures) {
        let [base, tip] = closure.links.map(group_name);
        // Within one body it is closed anyway.
        if base != tip {
            let at = frames[closure.links[0]].transform_point(&closure.anchor);
            write_closure(&mut text, name, closure, &at, [base, tip]);
        }
    }
    let index = robot.joint_index();
    for (joint, place) in robot.joints.iter().zip(&placed) {
        write_resistance(&mut text, joint, place, options);
        write_armature(&mut text, joint, place);
        if let Some((leader, factor, _)) = joint.follows.as_ref().filter(|_| options.mimic)
            && let Some(leader) = index.get(leader.as_str())
        {
            write_follower(&mut text, place, &placed[*leader], *factor);
        }
    }
    if options.motors == Motors::Written {
        write_motors(&mut text, robot, &placed);
    }
    write_tendons(&mut text, robot, &placed, options);
    write_ropes(&mut text, robot, &frames, &group_name);
    write_compensations(&mut text, robot, &frames, &groups, &number);
    text.push_str(&contacts.text);
    let mut taken = placed.iter().map(|own| own.own.clone()).collect();
    text.push_str(&outputs(robot, &placed, &contacts, &mut taken));
    write_sensors(&mut text, robot, (&placed, &mut taken), |link, frame| {
        let group = &groups[number[link]];
        // The ground has the global axes, wherever the root is.
        let pose = if group.name == "ground" { Motion::identity() } else { group.frame };
        Mount { body: &group.name, pose, sensor: frames[link] * *frame }
    });
    text.push_str(&analysis(robot, &contacts));
    Ok(text)
}

/// Links that move as one body, the group of each link, and the frames of all links.
fn grouped(robot: &Robot, pose: &Pose, options: Options) -> (Vec<Group>, Vec<usize>, Vec<Motion>) {
    let names = Names::of(robot);
    let root = if options.root == Root::Floating { pose.root_twist } else { Vector6::zeros() };
    let (frames, twists, group_of) = places(robot, pose, root);
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
                shapes: None,
                links: Vec::new(),
            });
        }
        number[link] = number[group_of[link]];
        let group = &mut groups[number[link]];
        let offset = frames[link].relative_to(&frames[group.link]);
        group.links.push(link);
        if let Some(mass) = &own.inertia {
            group.mass = Some(together(group.mass.as_ref(), &carried(mass, &offset)));
        }
    }
    (groups, number, frames)
}

/// The bodies of a model as far as they touch each other. Links between several joints of one body are part of none.
fn touching_bodies(robot: &Robot, groups: &[Group], number: &[usize]) -> Vec<TouchingBody> {
    let mut into = vec![None; robot.links.len()];
    robot.joints.iter().for_each(|joint| into[joint.child] = Some(joint.parent));
    let parent_of = |group: &Group| {
        let mut link = into[group.link]?;
        while robot.links[link].is_between {
            link = into[link]?;
        }
        Some(number[link])
    };
    let of = |group: &Group| TouchingBody {
        name: group.name.clone(),
        is_ground: group.name == "ground",
        links: group.links.clone(),
        parent: parent_of(group),
    };
    groups.iter().map(of).collect()
}

/// Adds the shapes of all bodies.
fn draw(robot: &Robot, groups: &mut [Group], frames: &[Motion], contacts: &Contacts) {
    for group in groups {
        for &link in &group.links {
            let own = &robot.links[link];
            if own.visuals.is_empty() {
                continue;
            }
            // The ground has the global axes, wherever the root is.
            let offset = match group.name.as_str() {
                "ground" => frames[link],
                _ => frames[link].relative_to(&group.frame),
            };
            let is_of_visuals = std::ptr::eq(own.drawn().as_ptr(), own.visuals.as_ptr());
            let touches = |index: usize| {
                !contacts.are_there() || is_of_visuals && contacts.touches[link].get(index) == Some(&true)
            };
            let drawn = own.drawn().iter().enumerate();
            let drawn = drawn.filter_map(|(index, visual)| visual.text(&offset, touches(index)));
            group.shapes.get_or_insert_default().extend(drawn);
        }
    }
}

/// Joints that move no mass, and masses without inertia.
fn wrong_masses(
    robot: &Robot,
    groups: &[Group],
    number: &[usize],
    frames: &[Motion],
    options: Options,
) -> Vec<String> {
    let moving = || groups.iter().filter(|group| group.name != "ground");
    let mut obstacles = Vec::new();
    for group in moving().filter(|group| group.has_mass()) {
        let moments = group.mass.map_or_else(Vector3::zeros, |mass| {
            (0.5 * (mass.inertia + mass.inertia.transpose())).symmetric_eigenvalues()
        });
        if moments.min() <= 0.0 {
            // The link that has the mass may be one that is fixed to the body.
            let has_mass = |link: &&usize| robot.links[**link].inertia.is_some_and(|own| own.mass > 0.0);
            let link = &robot.links[*group.links.iter().find(has_mass).unwrap_or(&group.link)];
            obstacles.push(format!(
                "{}link `{}` has the mass {:?} kg, but principal moments of inertia that are not positive, {}: \
                 correct its inertia, for example 2/5 m r² for a ball",
                prefix(&link.source),
                link.name,
                group.mass.map_or(0.0, |mass| mass.mass),
                list(&moments)
            ));
        }
    }
    // Loops may constrain links without mass further; the initial state of the model shows whether they do.
    if moving().all(Group::has_mass) || !robot.closures.is_empty() {
        return obstacles;
    }
    let stops: Vec<bool> =
        number.iter().map(|group| groups[*group].has_mass() || groups[*group].name == "ground").collect();
    let mut alone = BTreeSet::new();
    for massless in without_mass(robot, frames, &stops, options.mimic) {
        match massless {
            Massless::Alone(index) if alone.insert(index) => {
                let (joint, link) = (&robot.joints[index], &robot.links[robot.joints[index].child]);
                obstacles.push(format!(
                    "{}link `{}` moves, but neither it nor the links fixed to it have mass, nor those that joint `{}` moves: add an \
                     <inertial>, or fix it",
                    prefix(&link.source),
                    link.name,
                    joint.name
                ));
            }
            Massless::Alone(_) => {}
            Massless::Together(joints) => {
                let first = joints.first().map_or("", |&index| robot.joints[index].source.as_str());
                let names: Vec<String> =
                    joints.iter().map(|&index| format!("`{}`", robot.joints[index].name)).collect();
                obstacles.push(format!(
                    "{}the joints {} can move together in this position without moving a mass: their axes repeat each other. Remove \
                     one, add mass to a link between them, or start from another position",
                    prefix(first),
                    names.join(", ")
                ));
            }
        }
    }
    obstacles
}

/// Closures whose two points or frames differ at the start.
fn open_loops(robot: &Robot, frames: &[Motion]) -> Vec<String> {
    let (reference, _, _) = places(robot, &Pose::default(), Vector6::zeros());
    let is_open = |closure: &&Closure| {
        let [one, other] = closure.links;
        let anchor = Motion::translation(closure.anchor);
        let wanted = reference[other].inverse() * reference[one] * anchor;
        let found = frames[other].inverse() * frames[one] * anchor;
        let turned = (found.rotation.matrix() - wanted.rotation.matrix()).amax();
        (found.position - wanted.position).norm() > CLOSED || closure.locks_rotation && turned > CLOSED
    };
    let sentence = |closure: &Closure| {
        format!(
            "{}the loop of `{}` is open at these start positions: give those at which it is closed by `--position`",
            prefix(&closure.source),
            closure.name
        )
    };
    robot.closures.iter().filter(is_open).map(sentence).collect()
}

/// Elements that act on the robot and cannot be modelled.
fn unsupported(robot: &Robot, options: Options) -> Vec<String> {
    let mut obstacles = Vec::new();
    if robot.is_root_the_world() && options.root == Root::Floating {
        obstacles.push(
            "the root of this description is the world, which cannot move: bodies that move freely must be free in the \
             description"
                .to_owned(),
        );
    }
    if options.unsupported == Unsupported::Refused {
        obstacles.extend(robot.unsupported.iter().map(|what| {
            format!(
                "{what}: the model would move otherwise than the robot; remove it from the description, or omit it by `--without \
                 unsupported`"
            )
        }));
    }
    if robot.obstacles.is_empty() && robot.links.iter().all(|link| link.inertia.is_none()) {
        obstacles
            .push("no link of the description has mass: add an <inertial> to those that move".to_owned());
    }
    if robot.obstacles.is_empty() && obstacles.is_empty() && robot.is_root_the_world() && is_at_rest(robot) {
        obstacles.push("no body of the description moves: there is nothing to simulate".to_owned());
    }
    for joint in robot.joints.iter().filter(|joint| !joint.moves()) {
        let name = format!("{}joint `{}`", prefix(&joint.source), joint.name);
        if options.unsupported == Unsupported::LeftOut {
            continue;
        }
        if options.limits && joint.range.is_some() {
            obstacles
                .push(format!("{name}: limits of a ball joint are not supported: use `--without limits`"));
        }
        let is_damped = joint.damping > 0.0 && joint.freedom != Freedom::Ball;
        if options.friction && (is_damped || joint.friction > 0.0) {
            obstacles.push(format!(
                "{name}: friction of ball joints and damping of free joints are not supported: use `--without friction`"
            ));
        }
    }
    obstacles
}

/// Whether all links are fixed.
fn is_at_rest(robot: &Robot) -> bool {
    robot.joints.iter().all(|joint| joint.freedom == Freedom::Fixed)
}

/// Initial frames and twists of all links, and the link at the root of the group of each.
fn places(robot: &Robot, pose: &Pose, root: Vector6) -> (Vec<Motion>, Vec<Vector6>, Vec<usize>) {
    let count = robot.links.len();
    let mut frames = vec![robot.root.pose(); count];
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
    closures: Vec<String>,
}

impl Names {
    fn of(robot: &Robot) -> Self {
        let mut taken = BTreeSet::from(["ground".to_owned()]);
        let links = robot.links.iter().map(|link| free_name(&link.name, &mut taken)).collect();
        let mut taken = BTreeSet::new();
        let joints = robot.joints.iter().map(|joint| free_name(&joint.name, &mut taken)).collect();
        let closures = robot.closures.iter().map(|own| free_name(&own.name, &mut taken)).collect();
        Self { links, joints, closures }
    }
}

/// A name that can be used in expressions: letters, digits and underscores.
pub(super) fn free_name(name: &str, taken: &mut BTreeSet<String>) -> String {
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

fn header(robot: &Robot, options: Options, start: &Start, contacts: &Contacts) -> String {
    let title = robot.name.replace(char::is_control, " ").replace('\\', "\\\\").replace('"', "\\\"");
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "lissom = 1\ntitle = \"{title}\"\ngravity = {}\n\n\
         # Imported from a robot description. Bodies have the frames of its links, with those that are fixed to them.",
        list(&robot.gravity)
    );
    let has_stops = options.limits
        && (robot.joints.iter().any(super::RobotJoint::has_stop)
            || robot.tendons.iter().any(|own| own.range.is_some()));
    let has_stops = has_stops || robot.ropes.iter().any(|rope| rope.stiffness.is_none());
    if has_stops {
        text.push_str("\n# Stiffness of stops [N m/rad, N/m], which the description does not specify.");
    }
    for what in omissions(robot, options).into_iter().chain(contacts.notes.iter().cloned()) {
        let _ = write!(text, "\n# Omitted: {}.", what.escape_debug());
    }
    for chosen in &start.chosen {
        let _ = write!(text, "\n# {}.", chosen.sentence().escape_debug());
    }
    text.push('\n');
    if has_stops {
        let _ = write!(text, "\n[parameters]\nstop_stiffness = {STOPS:?}\n");
    }
    text
}

/// Outputs of all joints and contacts, and of the energy; `taken` are names of outputs.
fn outputs(robot: &Robot, placed: &[Placed], contacts: &Contacts, taken: &mut BTreeSet<String>) -> String {
    let mut text = String::new();
    for place in robot.joints.iter().zip(placed).filter(|(joint, _)| joint.moves()).map(|(_, place)| place) {
        let _ = write!(text, "\n[outputs.{0}]\nkind = \"relative\"\nof = \"{0}\"\n", place.own);
    }
    for name in &contacts.names {
        let own = free_name(name, taken);
        let _ = write!(text, "\n[outputs.{own}]\nkind = \"contact_force\"\nof = \"{name}\"\n");
    }
    let _ = write!(text, "\n[outputs.{}]\nkind = \"energy\"\n", free_name("energy", taken));
    text
}

fn analysis(robot: &Robot, contacts: &Contacts) -> String {
    let mut text = "\n[analysis]\nkind = \"dynamics\"\n".to_owned();
    if contacts.are_there() {
        let _ = write!(text, "scheme = \"backward-euler\"\nstep = {:?}\n", robot.contact_step());
    }
    text + "end = 1.0\n"
}

/// Tendons over joint coordinates: the force of each is a signal, from which the torques and forces of its joints follow.
fn write_tendons(text: &mut String, robot: &Robot, placed: &[Placed], options: Options) {
    let coordinate = |joint: usize| match robot.joints[joint].freedom {
        Freedom::Rotation => format!("{}.angle", placed[joint].own),
        _ => format!("{}.displacement", placed[joint].own),
    };
    let beyond = |length: &str, [low, high]: [f64; 2]| {
        if low == high {
            format!("({length} - {low:?})")
        } else {
            format!("({length} - clamp({length}, {low:?}, {high:?}))")
        }
    };
    let mut taken: BTreeSet<String> = placed.iter().map(|own| own.own.clone()).collect();
    let (mut signals, mut loads) = (String::new(), String::new());
    for tendon in &robot.tendons {
        let terms: Vec<String> =
            tendon.terms.iter().map(|(joint, factor)| format!("{factor:?}*{}", coordinate(*joint))).collect();
        let length = format!("({})", terms.join(" + "));
        let mut forces = Vec::new();
        if let Some(range) = tendon.range.filter(|_| options.limits) {
            forces.push(format!("-stop_stiffness*{}", beyond(&length, range)));
        }
        if tendon.stiffness > 0.0 {
            forces.push(format!("-{:?}*{}", tendon.stiffness, beyond(&length, tendon.rest)));
        }
        if forces.is_empty() {
            continue;
        }
        let name = free_name(&format!("{}_force", tendon.name), &mut taken);
        // Writing to a string cannot fail.
        let _ = writeln!(signals, "{name} = \"{}\"", forces.join(" "));
        for (joint, factor) in &tendon.terms {
            let (kind, key) = match robot.joints[*joint].freedom {
                Freedom::Rotation => ("joint_torque", "torque"),
                _ => ("joint_force", "force"),
            };
            let own = &placed[*joint].own;
            let load = free_name(&format!("{name}_{own}"), &mut taken);
            let _ = write!(
                loads,
                "\n[loads.{load}]\nkind = \"{kind}\"\njoint = \"{own}\"\n{key} = \"{factor:?}*{name}\"\n"
            );
        }
    }
    if !signals.is_empty() {
        let _ = write!(text, "\n# Tendons over joint coordinates\n[signals]\n{signals}{loads}");
    }
}

/// Ropes over points of bodies.
fn write_ropes<'a>(
    text: &mut String,
    robot: &Robot,
    frames: &[Motion],
    group_name: &impl Fn(usize) -> &'a str,
) {
    let mut taken = BTreeSet::new();
    for rope in &robot.ropes {
        let name = free_name(&rope.name, &mut taken);
        let points: Vec<String> = rope
            .along
            .iter()
            .map(|(link, point)| {
                let at = frames[*link].transform_point(point);
                format!("{{ on = \"{}\", at = {} }}", group_name(*link), list(&at))
            })
            .collect();
        let stiffness = rope.stiffness.map_or("\"stop_stiffness\"".to_owned(), |own| format!("{own:?}"));
        let _ = write!(
            text,
            "\n[springs.{name}]\nkind = \"rope\"\nalong = [\n    {},\n]\nlength = {:?}\nstiffness = {stiffness}\n",
            points.join(",\n    "),
            rope.length
        );
    }
}

/// Forces that compensate weights.
fn write_compensations(
    text: &mut String,
    robot: &Robot,
    frames: &[Motion],
    groups: &[Group],
    number: &[usize],
) {
    let mut taken = BTreeSet::new();
    for own in &robot.compensations {
        let link = &robot.links[own.link];
        let group = &groups[number[own.link]];
        let Some(inertia) = link.inertia.filter(|inertia| inertia.mass > 0.0 && group.name != "ground")
        else {
            continue;
        };
        let name = free_name(&format!("{}_weight", link.name), &mut taken);
        let _ = write!(
            text,
            "\n[loads.{name}]\nkind = \"force\"\non = \"{}\"\nat = {}\nvector = {}\n",
            group.name,
            list(&frames[own.link].transform_point(&inertia.centre)),
            list(&(-own.share * inertia.mass * robot.gravity))
        );
    }
}

/// What is omitted from the model of a robot, one sentence each; what its contacts cannot express is only in the model.
pub fn omissions(robot: &Robot, options: Options) -> Vec<String> {
    let mut all = robot.left_out.clone();
    if options.motors == Motors::Omitted && robot.is_root_the_world() {
        match robot.motors.len() {
            0 => {}
            1 => all.push("the command of 1 motor: `--motors` writes an input".to_owned()),
            count => all.push(format!("the commands of {count} motors: `--motors` writes inputs")),
        }
        let servos = robot.motors.iter().filter(|motor| motor.bias != [0.0; 3]).count();
        if servos > 0 {
            all.push(format!(
                "forces that motors have also without a command, of {servos} of them: `--motors` writes them"
            ));
        }
    }
    let is_omitted = |joint: &&super::RobotJoint| {
        !joint.moves() && (joint.friction > 0.0 || joint.damping > 0.0 && joint.freedom == Freedom::Floating)
    };
    let count = robot.joints.iter().filter(is_omitted).count();
    if count > 0 && options.friction && options.unsupported == Unsupported::LeftOut {
        all.push(format!("friction of ball joints and damping of free joints, of {count} joints"));
    }
    let without_range =
        |joint: &&super::RobotJoint| joint.moves() && joint.range.is_some() && !joint.has_stop();
    let free: Vec<String> =
        robot.joints.iter().filter(without_range).map(|joint| format!("`{}`", joint.name)).collect();
    if !free.is_empty() && options.limits {
        all.push(format!(
            "limits with two equal ends, so that these joints move freely: {}",
            free.join(", ")
        ));
    }
    let touches = |link: &super::Link| link.visuals.iter().any(|own| own.touch.is_some());
    if !options.contacts && robot.links.iter().any(touches) {
        all.push("contacts: bodies pass through each other".to_owned());
    }
    all.extend(robot.meshes_left_out());
    all.extend(robot.unsupported.iter().cloned());
    all
}

/// A body, or the shape of the ground; `own` is its name in the model, `link` in the description.
fn write_group(text: &mut String, group: &Group, own: &str, link: &str) {
    if group.name == "ground" {
        if group.shapes.as_ref().is_some_and(|shapes| !shapes.is_empty()) {
            let _ = write!(text, "\n[ground]\n{}", group.shape_line());
        }
        return;
    }
    let note = if own == link { String::new() } else { format!("   # link {}", link.escape_debug()) };
    let _ = write!(text, "\n[bodies.{}]{note}\n", group.name);
    match group.mass.filter(|_| group.has_mass()) {
        Some(mass) => {
            // Exactly symmetric, as required for a matrix of inertia.
            let inertia = 0.5 * (mass.inertia + mass.inertia.transpose());
            let rows: Vec<String> = (0..3).map(|k| list(&inertia.row(k).transpose())).collect();
            let _ = write!(
                text,
                "mass = {:?}\ninertia = [{}]\ncenter_of_mass = {}\n",
                mass.mass,
                rows.join(", "),
                list(&mass.centre)
            );
        }
        // A frame between joints.
        None => text.push_str("mass = 0\ninertia = [0, 0, 0]\n"),
    }
    let rotation = list(&group.frame.rotation.logarithm());
    let _ = write!(text, "position = {}\nrotation = {rotation}\n", list(&group.frame.position));
    text.push_str(&group.shape_line());
    if group.twist != Vector6::zeros() {
        let velocity = group.frame.rotation.apply(&translation_part(&group.twist));
        let angular = rotation_part(&group.twist);
        let _ = write!(text, "velocity = {}\nangular_velocity = {}\n", list(&velocity), list(&angular));
    }
}
