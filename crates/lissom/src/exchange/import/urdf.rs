//! URDF, the robot description of ROS: links with inertia, joints with axes, limits, friction, and what is drawn of links.
//! Shapes for collisions, colours, transmissions and extensions of simulators are omitted.

use std::collections::{BTreeMap, BTreeSet};

use lissom_model::output::Shade;
use lissom_motion::{Motion, Rotation, Vector3};
use roxmltree::Node;

use super::visuals::shade;
use super::xml::{self, Lines, children, is_foreign, location};
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
    let mut notes = Notes { left_out: left_out(root), lines: Lines::of(text), ..Notes::default() };
    let colours = colours(root);
    let mut links = Vec::new();
    for node in children(root, "link") {
        links.push(link(node, &colours, &mut notes)?);
    }
    // The ground has this name for some programs, without a link.
    let is_world = |joint| child(joint, "parent").and_then(|own| own.attribute("link")) == Some("world");
    if children(root, "joint").any(is_world) && !links.iter().any(|link| link.name == "world") {
        links.push(Link::new("world".to_owned(), None, String::new()));
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
    let Notes { obstacles, left_out, planar, .. } = notes;
    let name = root.attribute("name").unwrap_or("robot").to_owned();
    // Joints and springs of other programs, which the format does not have.
    let foreign = root.children().filter(|own| is_foreign(*own));
    let words = |own: Node<'_, '_>| {
        let prefix =
            own.tag_name().namespace().and_then(|space| own.lookup_prefix(space)).unwrap_or_default();
        format!("<{prefix}:{}> ({})", own.tag_name().name(), location(own))
    };
    let unsupported = foreign.filter(|own| !own.has_tag_name("collision_filter_group")).map(words).collect();
    let robot =
        Robot { name, gravity: GRAVITY, links, joints, left_out, unsupported, obstacles, ..Robot::default() };
    let mut robot = with_planar_joints(robot.in_order()?, &planar);
    robot.note_speed_limits();
    robot.fix_massless_ends();
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
    lines: Lines,
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

/// A frame from `xyz` and `rpy`.
fn origin(node: Node<'_, '_>) -> Result<Motion, ImportError> {
    let Some(node) = child(node, "origin") else { return Ok(Motion::identity()) };
    let rotation = fixed_axes(numbers::<3>(node, "rpy")?.unwrap_or_default());
    Ok(Motion::new(rotation, Vector3::from(numbers::<3>(node, "xyz")?.unwrap_or_default())))
}

/// Rotations about the fixed axes x, y, z in this order.
pub(super) fn fixed_axes([roll, pitch, yaw]: [f64; 3]) -> Rotation {
    Rotation::about_axis(&Vector3::z(), yaw)
        * Rotation::about_axis(&Vector3::y(), pitch)
        * Rotation::about_axis(&Vector3::x(), roll)
}

/// A link; what is wrong with it becomes an obstacle.
fn link<'a>(node: Node<'a, 'a>, colours: &Colours<'a>, notes: &mut Notes) -> Result<Link, ImportError> {
    let name = name(node)?;
    let shapes = |tag: &'static str, faults: &mut Vec<String>| -> Vec<Visual> {
        let read = |own| visual(own, &name, colours);
        children(node, tag)
            .filter_map(|own| read(own).map_err(|error| faults.push(error.message)).ok()?)
            .collect()
    };
    // What only draws is no reason to read nothing.
    let visuals = shapes("visual", &mut notes.left_out);
    let collisions = shapes("collision", &mut notes.obstacles);
    let inertia = inertia(node, &name).map_err(|error| notes.obstacles.push(error.message)).ok().flatten();
    Ok(Link { visuals, collisions, ..Link::new(name, inertia, notes.lines.location(node)) })
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
    Ok(LinkInertia::placed(mass, [xx, yy, zz, xy, xz, yz], &origin(inertial)?))
}

/// What is drawn of a link; none for a geometry that the format does not define.
fn visual<'a>(node: Node<'a, 'a>, link: &str, colours: &Colours<'a>) -> Result<Option<Visual>, ImportError> {
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
        // One number is that of all directions.
        let of_all = node
            .attribute("scale")
            .and_then(|text| text.trim().parse().ok().filter(|own: &f64| own.is_finite()));
        let scale = match of_all {
            Some(factor) => Vector3::repeat(factor),
            None => numbers::<3>(node, "scale")?.map_or(Vector3::repeat(1.0), Vector3::from),
        };
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
    if lengths.iter().any(|length| *length < 0.0) {
        return Err(ImportError::new(format!(
            "link `{link}`: the shape of its <visual> has a negative length"
        )));
    }
    // Exporters write shapes without extension where nothing is to be drawn.
    if lengths.contains(&0.0) {
        return Ok(None);
    }
    Ok(Some(Visual { shape, origin: origin(node)?, touch: None, name: None, colour: colour(node, colours)? }))
}

/// Elements `<color>` of materials by name, which shapes elsewhere refer to.
type Colours<'a> = BTreeMap<Option<&'a str>, Node<'a, 'a>>;

/// The first colour of each material of a description.
fn colours<'a>(root: Node<'a, 'a>) -> Colours<'a> {
    let mut colours = Colours::new();
    for material in root.descendants().filter(|own| own.has_tag_name("material")) {
        if let Some(own) = child(material, "color") {
            colours.entry(material.attribute("name")).or_insert(own);
        }
    }
    colours
}

/// The colour of a shape: that of its material, which may be another element's of the same name.
fn colour<'a>(node: Node<'a, 'a>, colours: &Colours<'a>) -> Result<Option<Shade>, ImportError> {
    let Some(material) = child(node, "material") else { return Ok(None) };
    let own = child(material, "color").or_else(|| colours.get(&material.attribute("name")).copied());
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
    let source = notes.lines.location(node);
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
