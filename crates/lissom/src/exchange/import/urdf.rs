//! URDF, the robot description of ROS: links with inertia, joints with axes, limits, friction, and what is drawn of links.
//! Shapes for collisions, colours, transmissions and extensions of simulators are omitted.

use std::collections::{BTreeMap, BTreeSet};

use lissom_motion::{Matrix3, Motion, Rotation, Vector3};
use roxmltree::Node;

use super::xml::{self, children, line};
use super::{Freedom, ImportError, Link, LinkInertia, Robot, RobotJoint, Visual, VisualShape};

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
    let links = children(root, "link").map(link).collect::<Result<Vec<_>, _>>()?;
    let mut numbers = BTreeMap::new();
    for (number, link) in links.iter().enumerate() {
        if numbers.insert(link.name.clone(), number).is_some() {
            return Err(ImportError::new(format!("two links are called `{}`", link.name)));
        }
    }
    // Transmissions and simulators have elements of the same name elsewhere: only those of the robot itself are
    // joints.
    let joints = children(root, "joint").map(|node| joint(node, &numbers)).collect::<Result<Vec<_>, _>>()?;
    let name = root.attribute("name").unwrap_or("robot").to_owned();
    let mut left_out = left_out(root);
    let limited = joints.iter().filter(|joint| joint.speed.is_some()).count();
    if limited > 0 {
        let joints = if limited == 1 { "1 joint".to_owned() } else { format!("{limited} joints") };
        left_out.push(format!("speed limits of {joints} (`velocity`), which are not enforced"));
    }
    in_order(Robot {
        name,
        gravity: GRAVITY,
        links,
        is_root_the_world: false,
        joints,
        left_out,
        unsupported: Vec::new(),
    })
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
        || ImportError::new(format!("line {}: <{}> has no name", line(node), node.tag_name().name()));
    node.attribute("name").map(str::to_owned).ok_or_else(missing)
}

/// Numbers of an attribute.
fn numbers<const N: usize>(node: Node<'_, '_>, key: &str) -> Result<Option<[f64; N]>, ImportError> {
    let Some(text) = node.attribute(key) else { return Ok(None) };
    xml::finite_numbers(text).and_then(|values| values.try_into().ok()).map(Some).ok_or_else(|| {
        let message = format!("line {}: `{key}` must be {N} finite numbers, not `{text}`", line(node));
        ImportError::new(message)
    })
}

fn number(node: Node<'_, '_>, key: &str) -> Result<Option<f64>, ImportError> {
    Ok(numbers::<1>(node, key)?.map(|[value]| value))
}

fn required(node: Node<'_, '_>, key: &str) -> Result<f64, ImportError> {
    number(node, key)?.ok_or_else(|| {
        ImportError::new(format!("line {}: <{}> has no `{key}`", line(node), node.tag_name().name()))
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

fn link(node: Node<'_, '_>) -> Result<Link, ImportError> {
    let name = name(node)?;
    let visuals = children(node, "visual").map(|node| visual(node, &name)).collect::<Result<Vec<_>, _>>()?;
    let visuals = visuals.into_iter().flatten().collect();
    let Some(inertial) = child(node, "inertial") else { return Ok(Link { name, inertia: None, visuals }) };
    let missing = |tag: &str| ImportError::new(format!("link `{name}`: its <inertial> has no <{tag}>"));
    let mass = required(child(inertial, "mass").ok_or_else(|| missing("mass"))?, "value")?;
    let tensor = child(inertial, "inertia").ok_or_else(|| missing("inertia"))?;
    let [xx, yy, zz] = [required(tensor, "ixx")?, required(tensor, "iyy")?, required(tensor, "izz")?];
    let [xy, xz, yz] = [
        number(tensor, "ixy")?.unwrap_or(0.0),
        number(tensor, "ixz")?.unwrap_or(0.0),
        number(tensor, "iyz")?.unwrap_or(0.0),
    ];
    if mass < 0.0 {
        return Err(ImportError::new(format!("link `{name}` has a negative mass, {mass} kg")));
    }
    let frame = origin(inertial)?;
    let turn = frame.rotation.matrix();
    let own = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    if mass == 0.0 && own.iter().all(|value| *value == 0.0) {
        return Ok(Link { name, inertia: None, visuals });
    }
    let inertia = turn * own * turn.transpose();
    Ok(Link { name, inertia: Some(LinkInertia { mass, centre: frame.position, inertia }), visuals })
}

/// What is drawn of a link; none for a geometry that the format does not define.
fn visual(node: Node<'_, '_>, link: &str) -> Result<Option<Visual>, ImportError> {
    let Some(geometry) = child(node, "geometry") else {
        return Err(ImportError::new(format!("link `{link}`: a <visual> has no <geometry>")));
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
        VisualShape::Mesh { .. } => Vec::new(),
    };
    if lengths.iter().any(|length| *length <= 0.0) {
        return Err(ImportError::new(format!(
            "link `{link}`: the shape of its <visual> has a length that is not positive"
        )));
    }
    Ok(Some(Visual { shape, origin: origin(node)? }))
}

fn joint(node: Node<'_, '_>, links: &BTreeMap<String, usize>) -> Result<RobotJoint, ImportError> {
    let name = name(node)?;
    let fault = |message: String| ImportError::new(format!("joint `{name}`: {message}"));
    let kind = node.attribute("type").ok_or_else(|| fault("it has no `type`".to_owned()))?;
    let freedom = match kind {
        "fixed" => Freedom::Fixed,
        "revolute" | "continuous" => Freedom::Rotation,
        "prismatic" => Freedom::Displacement,
        "floating" => Freedom::Floating,
        other => {
            return Err(fault(format!(
                "its type `{other}` is unknown: it must be fixed, revolute, continuous, prismatic or floating"
            )));
        }
    };
    let end = |tag: &'static str| {
        let link = child(node, tag).and_then(|node| node.attribute("link"));
        let link = link.ok_or_else(|| fault(format!("it has no <{tag} link=…>")))?;
        links.get(link).copied().ok_or_else(|| fault(format!("there is no link `{link}`")))
    };
    let (parent, child_link) = (end("parent")?, end("child")?);
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
    let (mut range, mut effort, mut speed) = (None, None, None);
    if let Some(limit) = limit {
        effort = number(limit, "effort")?;
        speed = number(limit, "velocity")?.filter(|speed| *speed < NO_LIMIT);
        if kind != "continuous" {
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
    let (damping, friction) = (of_dynamics("damping")?, of_dynamics("friction")?);
    let joint = RobotJoint::new(name, freedom, parent, child_link, origin(node)?);
    Ok(RobotJoint { axis, range, effort, speed, damping, friction, follows, ..joint })
}
