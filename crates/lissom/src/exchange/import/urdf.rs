//! URDF, the robot description of ROS: links with inertia, joints with axes, limits, friction, and what is drawn of links.
//! Shapes for collisions, colours, transmissions and extensions of simulators are omitted.

use std::collections::{BTreeMap, BTreeSet};

use lissom_model::output::Shade;
use lissom_motion::{Matrix3, Motion, Rotation, Vector3};
use roxmltree::Node;

use super::visuals::shade;
use super::xml::{self, children, location};
use super::{
    Freedom, ImportError, Link, LinkInertia, MotorRating, Robot, RobotJoint, Visual, VisualShape, from_z,
};

/// Gravity as in ROS [m/s²].
const GRAVITY: Vector3 = Vector3::new(0.0, 0.0, -9.81);

/// Value of a required limit if there is none [rad/s, m/s, N, N m].
pub(super) const NO_LIMIT: f64 = 1e9;

/// Reads a robot from the text of a URDF file.
///
/// # Errors
/// If it is not URDF, a number is invalid, a link is missing, or the joints do not form a tree.
pub fn from_urdf(text: &str) -> Result<Robot, ImportError> {
    let document = xml::parse(text)?;
    let root = document.root_element();
    if !root.has_tag_name("robot") {
        let message = format!("this is not URDF: its root is <{}>, not <robot>", root.tag_name().name());
        return Err(ImportError::new(message));
    }
    let mut notes = Notes { left_out: left_out(root), ..Notes::default() };
    let mut links = Vec::new();
    for node in children(root, "link") {
        links.push(link(node, &mut notes.obstacles)?);
    }
    let mut numbers = BTreeMap::new();
    for (number, link) in links.iter().enumerate() {
        if numbers.insert(link.name.clone(), number).is_some() {
            return Err(ImportError::new(format!("two links are called `{}`", link.name)));
        }
    }
    // Transmissions and simulators have elements of the same name elsewhere: only those of the robot itself are
    // joints.
    let mut joints = Vec::new();
    for node in children(root, "joint") {
        joints.push(joint(node, &numbers, &mut notes)?);
    }
    let Notes { obstacles, mut left_out, planar } = notes;
    let name = root.attribute("name").unwrap_or("robot").to_owned();
    let limited = joints.iter().filter(|joint| joint.rating.speed.is_some()).count();
    if limited > 0 {
        let joints = if limited == 1 { "1 joint".to_owned() } else { format!("{limited} joints") };
        left_out.push(format!("speed limits of {joints} (`velocity`), which are not enforced"));
    }
    let robot = in_order(Robot {
        name,
        gravity: GRAVITY,
        links,
        is_root_the_world: false,
        joints,
        closures: Vec::new(),
        ropes: Vec::new(),
        tendons: Vec::new(),
        contacts: super::ContactRules::default(),
        compensations: Vec::new(),
        keyframes: Vec::new(),
        motors: Vec::new(),
        left_out,
        unsupported: Vec::new(),
        obstacles,
    })?;
    let mut robot = with_planar_joints(robot, &planar);
    fix_massless_ends(&mut robot);
    robot.motors_by_effort();
    Ok(robot)
}

/// What is found besides links and joints.
#[derive(Default)]
struct Notes {
    obstacles: Vec<String>,
    left_out: Vec<String>,
    /// Names of planar joints.
    planar: BTreeSet<String>,
}

/// Splits planar joints into two displacements in their plane and the rotation about its normal, through links without mass. The
/// rotation has the name of the joint, the displacements `_x` and `_y` behind it: along the axes that the smallest rotation
/// from z to the normal makes of x and y.
fn with_planar_joints(mut robot: Robot, planar: &BTreeSet<String>) -> Robot {
    let mut all = Vec::new();
    for joint in std::mem::take(&mut robot.joints) {
        if !planar.contains(&joint.name) {
            all.push(joint);
            continue;
        }
        let turn = from_z(&joint.axis);
        let (mut parent, mut origin) = (joint.parent, joint.origin);
        for (letter, axis) in [("x", Vector3::x()), ("y", Vector3::y())] {
            let (name, source) = (format!("{}_{letter}", joint.name), joint.source.clone());
            let child = robot.links.len();
            robot.links.push(Link::new(
                format!("{} behind {name}", robot.links[joint.child].name),
                None,
                source.clone(),
            ));
            let slide = RobotJoint::new(name, Freedom::Displacement, parent, child, origin);
            all.push(RobotJoint { axis: turn.apply(&axis), source, ..slide });
            (parent, origin) = (child, Motion::identity());
        }
        all.push(RobotJoint { parent, origin, ..joint });
    }
    Robot { joints: all, ..robot }
}

/// Fixes joints that move no mass, such as those of tools and frames of cameras: their motion is no motion of the robot.
fn fix_massless_ends(robot: &mut Robot) {
    let mut has_mass: Vec<bool> = robot.links.iter().map(|link| link.inertia.is_some()).collect();
    for joint in robot.joints.iter().rev() {
        has_mass[joint.parent] |= has_mass[joint.child];
    }
    if !has_mass.first().is_some_and(|has| *has) {
        return;
    }
    let leaders: BTreeSet<String> =
        robot.joints.iter().filter_map(|joint| Some(joint.follows.as_ref()?.0.clone())).collect();
    let is_end = |joint: &&mut RobotJoint| {
        joint.freedom != Freedom::Fixed && !has_mass[joint.child] && !leaders.contains(&joint.name)
    };
    let mut names = Vec::new();
    for joint in robot.joints.iter_mut().filter(is_end) {
        names.push(format!("`{}`", joint.name));
        joint.freedom = Freedom::Fixed;
        (joint.range, joint.follows, joint.rating) = (None, None, MotorRating::default());
        (joint.damping, joint.friction) = (0.0, 0.0);
    }
    if !names.is_empty() {
        robot
            .left_out
            .push(format!("the motion of joints that carry no mass, which are fixed: {}", names.join(", ")));
    }
}

/// Contents that are omitted from the model.
fn left_out(root: Node<'_, '_>) -> Vec<String> {
    let known = ["link", "joint"];
    let others = root
        .children()
        .filter(|child| child.is_element() && !known.iter().any(|tag| child.has_tag_name(*tag)));
    let mut words = xml::counted(others.map(|child| child.tag_name().name().to_owned()));
    let inside = |tag: &'static str, inner: &'static str| {
        children(root, tag).flat_map(move |own| children(own, inner)).count()
    };
    for (tag, inner) in [("link", "collision"), ("joint", "safety_controller"), ("joint", "calibration")] {
        match inside(tag, inner) {
            0 => {}
            count => words.push(format!("{count} <{inner}>")),
        }
    }
    if words.is_empty() { Vec::new() } else { vec![format!("elements: {}", words.join(", "))] }
}

/// Moves the root to the front and joints after their parent joints.
fn in_order(robot: Robot) -> Result<Robot, ImportError> {
    let Robot { links, joints, .. } = &robot;
    let mut names = BTreeSet::new();
    let mut carrier: Vec<Option<usize>> = vec![None; links.len()];
    for (number, joint) in joints.iter().enumerate() {
        if !names.insert(&joint.name) {
            return Err(ImportError::new(format!("two joints are called `{}`", joint.name)));
        }
        if let Some(other) = carrier[joint.child].replace(number) {
            let message = format!(
                "link `{}` is a child of both `{}` and `{}`: a URDF is a tree",
                links[joint.child].name, joints[other].name, joint.name
            );
            return Err(ImportError::new(message));
        }
    }
    let roots: Vec<usize> = (0..links.len()).filter(|&link| carrier[link].is_none()).collect();
    let [root] = roots[..] else {
        let named: Vec<&str> = roots.iter().map(|&link| links[link].name.as_str()).collect();
        let message = match roots.len() {
            0 => "every link is a child of another one: there is no root".to_owned(),
            _ => format!("several links have no parent, but only one can be the root: {}", named.join(", ")),
        };
        return Err(ImportError::new(message));
    };
    let mut order = vec![root];
    let mut sorted = Vec::new();
    let mut next = 0;
    while let Some(&parent) = order.get(next) {
        for (number, joint) in joints.iter().enumerate().filter(|(_, joint)| joint.parent == parent) {
            order.push(joint.child);
            sorted.push(number);
        }
        next += 1;
    }
    if order.len() != links.len() {
        let lost = (0..links.len()).find(|link| !order.contains(link)).map_or("", |link| &links[link].name);
        return Err(ImportError::new(format!("link `{lost}` is its own ancestor in a loop of joints")));
    }
    let mut place = vec![0; links.len()];
    order.iter().enumerate().for_each(|(new, &old)| place[old] = new);
    let moved = |joint: &RobotJoint| RobotJoint {
        parent: place[joint.parent],
        child: place[joint.child],
        ..joint.clone()
    };
    let joints = sorted.iter().map(|&number| moved(&joints[number])).collect();
    let links = order.iter().map(|&link| links[link].clone()).collect();
    Ok(Robot { links, joints, ..robot })
}

fn child<'a>(node: Node<'a, 'a>, tag: &'static str) -> Option<Node<'a, 'a>> {
    children(node, tag).next()
}

fn name(node: Node<'_, '_>) -> Result<String, ImportError> {
    let missing =
        || ImportError::new(format!("{}: <{}> has no name", location(node), node.tag_name().name()));
    node.attribute("name").map(str::to_owned).ok_or_else(missing)
}

/// Numbers of an attribute.
fn numbers<const N: usize>(node: Node<'_, '_>, key: &str) -> Result<Option<[f64; N]>, ImportError> {
    let Some(text) = node.attribute(key) else { return Ok(None) };
    xml::finite_numbers(text).and_then(|values| values.try_into().ok()).map(Some).ok_or_else(|| {
        let message = format!("{}: `{key}` must be {N} finite numbers, not `{text}`", location(node));
        ImportError::new(message)
    })
}

fn number(node: Node<'_, '_>, key: &str) -> Result<Option<f64>, ImportError> {
    Ok(numbers::<1>(node, key)?.map(|[value]| value))
}

fn required(node: Node<'_, '_>, key: &str) -> Result<f64, ImportError> {
    number(node, key)?.ok_or_else(|| {
        ImportError::new(format!("{}: <{}> has no `{key}`", location(node), node.tag_name().name()))
    })
}

/// A frame from `xyz` and `rpy`: rotations about the fixed axes x, y, z in this order.
fn origin(node: Node<'_, '_>) -> Result<Motion, ImportError> {
    let Some(node) = child(node, "origin") else { return Ok(Motion::identity()) };
    let [roll, pitch, yaw] = numbers::<3>(node, "rpy")?.unwrap_or_default();
    let position = Vector3::from(numbers::<3>(node, "xyz")?.unwrap_or_default());
    let rotation = Rotation::about_axis(&Vector3::z(), yaw)
        * Rotation::about_axis(&Vector3::y(), pitch)
        * Rotation::about_axis(&Vector3::x(), roll);
    Ok(Motion::new(rotation, position))
}

/// A link; what is wrong with it becomes an obstacle.
fn link(node: Node<'_, '_>, obstacles: &mut Vec<String>) -> Result<Link, ImportError> {
    let name = name(node)?;
    let mut keep = |error: ImportError| obstacles.push(error.message);
    let mut shapes = |tag: &'static str| -> Vec<Visual> {
        children(node, tag)
            .filter_map(|own| {
                visual(own, &name).unwrap_or_else(|error| {
                    keep(error);
                    None
                })
            })
            .collect()
    };
    let (visuals, collisions) = (shapes("visual"), shapes("collision"));
    let inertia = inertia(node, &name).unwrap_or_else(|error| {
        keep(error);
        None
    });
    Ok(Link { visuals, collisions, ..Link::new(name, inertia, location(node)) })
}

fn inertia(node: Node<'_, '_>, name: &str) -> Result<Option<LinkInertia>, ImportError> {
    let Some(inertial) = child(node, "inertial") else { return Ok(None) };
    let fault =
        |message: String| ImportError::new(format!("{}: link `{name}`: {message}", location(inertial)));
    let missing = |tag: &str| fault(format!("its <inertial> has no <{tag}>"));
    let mass = required(child(inertial, "mass").ok_or_else(|| missing("mass"))?, "value")?;
    let tensor = child(inertial, "inertia").ok_or_else(|| missing("inertia"))?;
    let [xx, yy, zz] = [required(tensor, "ixx")?, required(tensor, "iyy")?, required(tensor, "izz")?];
    let [xy, xz, yz] = [
        number(tensor, "ixy")?.unwrap_or(0.0),
        number(tensor, "ixz")?.unwrap_or(0.0),
        number(tensor, "iyz")?.unwrap_or(0.0),
    ];
    if mass < 0.0 {
        return Err(fault(format!("its mass is negative, {mass} kg")));
    }
    let frame = origin(inertial)?;
    let turn = frame.rotation.matrix();
    let own = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    if mass == 0.0 && own.iter().all(|value| *value == 0.0) {
        return Ok(None);
    }
    let inertia = turn * own * turn.transpose();
    Ok(Some(LinkInertia { mass, centre: frame.position, inertia }))
}

/// What is drawn of a link; none for a geometry that the format does not define.
fn visual(node: Node<'_, '_>, link: &str) -> Result<Option<Visual>, ImportError> {
    let Some(geometry) = child(node, "geometry") else {
        let tag = node.tag_name().name();
        return Err(ImportError::new(format!(
            "{}: link `{link}`: its <{tag}> has no <geometry>",
            location(node)
        )));
    };
    let attribute = |node, key: &str| {
        let missing = || ImportError::new(format!("link `{link}`: the shape of its <visual> has no `{key}`"));
        numbers::<3>(node, key)?.map(Vector3::from).ok_or_else(missing)
    };
    let shape = if let Some(node) = child(geometry, "box") {
        VisualShape::Box(attribute(node, "size")?)
    } else if let Some(node) = child(geometry, "cylinder") {
        VisualShape::Cylinder { radius: required(node, "radius")?, length: required(node, "length")? }
    } else if let Some(node) = child(geometry, "sphere") {
        VisualShape::Sphere(required(node, "radius")?)
    } else if let Some(node) = child(geometry, "mesh") {
        let scale = numbers::<3>(node, "scale")?.map_or(Vector3::repeat(1.0), Vector3::from);
        let name = node.attribute("filename").unwrap_or_default().to_owned();
        VisualShape::Mesh { name, scale, path: None }
    } else {
        return Ok(None);
    };
    let lengths = match &shape {
        VisualShape::Box(sides) => sides.iter().copied().collect(),
        VisualShape::Cylinder { radius, length } => vec![*radius, *length],
        VisualShape::Sphere(radius) => vec![*radius],
        _ => Vec::new(),
    };
    if lengths.iter().any(|length| *length <= 0.0) {
        return Err(ImportError::new(format!(
            "link `{link}`: the shape of its <visual> has a length that is not positive"
        )));
    }
    Ok(Some(Visual { shape, origin: origin(node)?, touch: None, name: None, colour: colour(node)? }))
}

/// The colour of a shape: that of its material, which may be another element's of the same name.
fn colour(node: Node<'_, '_>) -> Result<Option<Shade>, ImportError> {
    let Some(material) = child(node, "material") else { return Ok(None) };
    let is_same = |own: &Node<'_, '_>| {
        own.has_tag_name("material")
            && own.attribute("name") == material.attribute("name")
            && child(*own, "color").is_some()
    };
    let own = child(material, "color");
    let own = own.or_else(|| child(node.document().descendants().find(is_same)?, "color"));
    Ok(own.map_or(Ok(None), |own| numbers::<4>(own, "rgba"))?.map(shade))
}

/// A joint; what is wrong with it, except its links, becomes an obstacle.
fn joint(
    node: Node<'_, '_>,
    links: &BTreeMap<String, usize>,
    notes: &mut Notes,
) -> Result<RobotJoint, ImportError> {
    let name = name(node)?;
    let end = |tag: &'static str| {
        let fault =
            |message: String| ImportError::new(format!("{}: joint `{name}`: {message}", location(node)));
        let link = child(node, tag).and_then(|node| node.attribute("link"));
        let link = link.ok_or_else(|| fault(format!("it has no <{tag} link=…>")))?;
        links.get(link).copied().ok_or_else(|| fault(format!("there is no link `{link}`")))
    };
    let ends = [end("parent")?, end("child")?];
    Ok(moving(node, &name, ends, notes).unwrap_or_else(|error| {
        notes.obstacles.push(error.message);
        RobotJoint::new(name, Freedom::Fixed, ends[0], ends[1], Motion::identity())
    }))
}

fn moving(
    node: Node<'_, '_>,
    name: &str,
    [parent, child_link]: [usize; 2],
    notes: &mut Notes,
) -> Result<RobotJoint, ImportError> {
    let source = location(node);
    let fault = |message: String| ImportError::new(format!("{source}: joint `{name}`: {message}"));
    let kind = node.attribute("type").ok_or_else(|| fault("it has no `type`".to_owned()))?;
    let freedom = match kind {
        "fixed" => Freedom::Fixed,
        "revolute" | "continuous" | "planar" => Freedom::Rotation,
        "prismatic" => Freedom::Displacement,
        "floating" => Freedom::Floating,
        other => {
            return Err(fault(format!(
                "its type `{other}` is unknown: it must be fixed, revolute, continuous, prismatic, planar or floating"
            )));
        }
    };
    let axis = match child(node, "axis") {
        Some(node) => Vector3::from(numbers::<3>(node, "xyz")?.unwrap_or([1.0, 0.0, 0.0])),
        None => Vector3::x(),
    };
    let moves = matches!(freedom, Freedom::Rotation | Freedom::Displacement);
    let axis = match axis.try_normalize(0.0) {
        Some(axis) => axis,
        None if moves => return Err(fault("its axis has no direction: all its numbers are zero".to_owned())),
        None => Vector3::x(),
    };
    let limit = child(node, "limit").filter(|_| moves);
    let (mut range, mut rating) = (None, MotorRating::default());
    if let Some(limit) = limit {
        rating.effort = number(limit, "effort")?.map(|effort| [-effort, effort]);
        rating.speed = number(limit, "velocity")?.filter(|speed| *speed < NO_LIMIT);
        if kind == "planar" {
            notes.left_out.push(format!(
                "limits of the planar joint `{name}` ({source}), which the format does not define"
            ));
        } else if kind != "continuous" {
            // Default zero, as specified by the format.
            let ends = [number(limit, "lower")?.unwrap_or(0.0), number(limit, "upper")?.unwrap_or(0.0)];
            if ends[0] > ends[1] {
                return Err(fault(format!("its lower limit {} is above the upper one {}", ends[0], ends[1])));
            }
            range = Some(ends);
        }
    }
    let dynamics = child(node, "dynamics");
    let of_dynamics = |key: &str| -> Result<f64, ImportError> {
        let value = dynamics.map_or(Ok(None), |node| number(node, key))?.unwrap_or(0.0);
        if value < 0.0 { Err(fault(format!("its {key} is negative: {value}"))) } else { Ok(value) }
    };
    let follows = match child(node, "mimic") {
        None => None,
        Some(mimic) => {
            let leader =
                mimic.attribute("joint").ok_or_else(|| fault("its <mimic> names no joint".to_owned()))?;
            let factor = number(mimic, "multiplier")?.unwrap_or(1.0);
            Some((leader.to_owned(), factor, number(mimic, "offset")?.unwrap_or(0.0)))
        }
    };
    let (mut damping, mut friction) = (of_dynamics("damping")?, of_dynamics("friction")?);
    let resists = damping > 0.0 || friction > 0.0;
    if freedom == Freedom::Fixed && resists {
        notes
            .left_out
            .push(format!("damping and friction of the fixed joint `{name}` ({source}), which cannot move"));
        (damping, friction) = (0.0, 0.0);
    }
    if kind == "planar" {
        notes.planar.insert(name.to_owned());
    }
    if kind == "planar" && (resists || follows.is_some()) {
        return Err(fault(
            "<dynamics> and <mimic> of a planar joint are not defined: write two prismatic joints and a \
             continuous one, with their own"
                .to_owned(),
        ));
    }
    let joint = RobotJoint::new(name.to_owned(), freedom, parent, child_link, origin(node)?);
    Ok(RobotJoint { axis, range, rating, damping, friction, follows, source, ..joint })
}
