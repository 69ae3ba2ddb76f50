//! Conversion of a model of rigid bodies to a robot description, if possible.

use crate::start::lower;
use lissom_model::Document;
use lissom_model::document::{Attachment, Body, Component, NodeLocation, NodeReference};
use lissom_motion::{Motion, Rotation, Vector3};

use super::{Freedom, ImportError, Link, LinkInertia, Robot, RobotJoint};

/// Gravity implied by a description [m/s²].
const GRAVITY: Vector3 = Vector3::new(0.0, 0.0, -9.81);

/// A robot and the initial values of its joints.
#[derive(Clone, Debug)]
pub struct ModelRobot {
    /// The robot, with frames at zero values of all joints.
    pub robot: Robot,
    /// Names of joints and their nonzero initial values [rad, m].
    pub values: Vec<(String, f64)>,
}

/// The robot described by a model: a tree of rigid bodies from the ground, or from one free body. Links have the axes of their
/// bodies, and their origins at their parent joints.
///
/// Entries that cannot be expressed in a description and act on the bodies (loads, springs, drives, another gravity)
/// are in [`Robot::unsupported`].
///
/// # Errors
/// If the model is not a tree of rigid bodies with revolute, prismatic and clamped joints: the first part that violates this.
pub fn from_model(document: &Document) -> Result<ModelRobot, ImportError> {
    refuse_parts(document)?;
    let mut robot = Robot {
        name: document.title.clone().unwrap_or_else(|| "robot".to_owned()),
        gravity: document.gravity,
        ..Robot::default()
    };
    let lowered = lower(document).map_err(|report| ImportError::new(report.to_string()))?;
    let frame_of = |body: &Body| {
        let node = lowered.names.nodes.get(&body.name.value);
        node.map(|&node| lowered.state.kinematics.nodes[node].frame)
    };
    let mut tree = Tree { placed: vec![None; document.bodies.len()], frames: Vec::new(), values: Vec::new() };

    // The root: the ground if anything is joined to it, otherwise the only body without a parent.
    let links: Vec<&Component> =
        document.joints.iter().filter(|joint| joint.ports.have_one_location()).collect();
    let is_on_ground = links.iter().any(|joint| ends(joint).contains(&&NodeReference::Ground));
    if is_on_ground || document.bodies.is_empty() {
        robot.links.push(Link::new("world".to_owned(), None, String::new()));
        tree.frames.push(Motion::identity());
    } else {
        let body = &document.bodies[0];
        let frame = frame_of(body).ok_or_else(|| unknown(&body.name.value))?;
        robot.links.push(link(body, &Motion::identity()));
        tree.frames.push(frame);
        tree.placed[0] = Some(0);
        // A description does not contain a position of its root.
        if frame.position.norm() > 0.0 || frame.rotation.logarithm().norm() > 0.0 {
            robot.left_out.push(format!("the position of body `{}` at the start", body.name.value));
        }
    }
    let mut rest: Vec<&Component> = links;
    while !rest.is_empty() {
        let reached = |node: &NodeReference| match node {
            NodeReference::Ground => is_on_ground.then_some(0),
            NodeReference::Body(name) => {
                let index = document.bodies.iter().position(|body| body.name.value == *name)?;
                tree.placed[index]
            }
            _ => None,
        };
        let next = rest.iter().position(|joint| ends(joint).into_iter().any(|node| reached(node).is_some()));
        let Some(next) = next else {
            let names: Vec<&str> = rest.iter().map(|joint| joint.name.value.as_str()).collect();
            let message = format!(
                "the joints {} are not connected to the root: a description has only one",
                names.join(", ")
            );
            return Err(ImportError::new(message));
        };
        let joint = rest.remove(next);
        let [base, tip] = ends(joint);
        let (carrier, carried, is_turned) = match (reached(base), reached(tip)) {
            (Some(_), Some(_)) => {
                let message =
                    format!("joint `{}` closes a loop, but a description is a tree", joint.name.value);
                return Err(ImportError::new(message));
            }
            (Some(carrier), None) => (carrier, tip, false),
            (None, Some(carrier)) => (carrier, base, true),
            (None, None) => continue,
        };
        let NodeReference::Body(name) = carried else { continue };
        let index = document.bodies.iter().position(|body| body.name.value == *name);
        let index = index.ok_or_else(|| unknown(name))?;
        let body = &document.bodies[index];
        let frame = frame_of(body).ok_or_else(|| unknown(name))?;
        tree.placed[index] = Some(robot.links.len());
        tree.add(&mut robot, joint, (body, &frame), (carrier, is_turned))?;
    }
    if let Some(index) = tree.placed.iter().position(Option::is_none) {
        let name = &document.bodies[index].name.value;
        let message = format!("body `{name}` has no joint: in a description only the root can move freely");
        return Err(ImportError::new(message));
    }
    couplings(document, &tree, &mut robot)?;
    for spring in &document.springs {
        resistance(spring, &mut robot);
    }
    report_omissions(document, &mut robot);
    let values = tree.values.into_iter().filter(|(_, value)| *value != 0.0).collect();
    Ok(ModelRobot { robot, values })
}

fn unknown(name: &str) -> ImportError {
    ImportError::new(format!("body `{name}` has no node"))
}

/// Base and tip of a joint between nodes.
fn ends(joint: &Component) -> [&NodeReference; 2] {
    match joint.attachment.nodes.as_slice() {
        [base, tip] => [&base.node.value, &tip.node.value],
        _ => [&NodeReference::Ground, &NodeReference::Ground],
    }
}

/// Rejects models with parts other than rigid bodies.
fn refuse_parts(document: &Document) -> Result<(), ImportError> {
    let beam = document.beams.first().map(|beam| format!("beam `{}` is flexible", beam.name.value));
    let shell = document.shells.first().map(|shell| format!("shell `{}` is flexible", shell.name.value));
    let solid =
        document.elastic_solids.first().map(|solid| format!("solid `{}` is flexible", solid.name.value));
    let element = document.superelements.first();
    let element = element.map(|element| format!("superelement `{}` is flexible", element.name.value));
    let mass = document.point_masses.first();
    let mass = mass.map(|mass| format!("point mass `{}` has no axes: make it a body", mass.name.value));
    let assembled = document
        .assembly
        .as_ref()
        .map(|_| "[assembly] determines the positions of its parts: write these positions".to_owned());
    match beam.or(shell).or(solid).or(element).or(mass).or(assembled) {
        Some(words) => Err(ImportError::new(format!(
            "the model has features that a description cannot express: {words}"
        ))),
        None => Ok(()),
    }
}

/// The link of a body whose frame is at `offset` in the link's.
fn link(body: &Body, offset: &Motion) -> Link {
    let turn = offset.rotation.matrix();
    let inertia = turn * body.inertia * turn.transpose();
    let centre = offset.transform_point(&body.center_of_mass);
    let inertia = (body.mass > 0.0).then_some(LinkInertia { mass: body.mass, centre, inertia });
    Link::new(body.name.value.clone(), inertia, String::new())
}

struct Tree {
    /// Link of each body that has been placed.
    placed: Vec<Option<usize>>,
    /// Initial frames of the links.
    frames: Vec<Motion>,
    /// Initial value of each joint.
    values: Vec<(String, f64)>,
}

impl Tree {
    /// Adds a joint from link `carrier` and the body beyond it, whose frame is at `frame`. If `is_turned`, the carrier is on the
    /// joint's tip.
    fn add(
        &mut self,
        robot: &mut Robot,
        joint: &Component,
        (body, frame): (&Body, &Motion),
        (carrier, is_turned): (usize, bool),
    ) -> Result<(), ImportError> {
        let name = &joint.name.value;
        let Attachment { nodes, axes, .. } = &joint.attachment;
        let [NodeLocation { at: Some(at), .. }, _] = nodes.as_slice() else { return Ok(()) };
        let (freedom, key) = match joint.kind.value.as_str() {
            "revolute" => (Freedom::Rotation, "angle"),
            "prismatic" => (Freedom::Displacement, "displacement"),
            "clamp" | "rigid_link" => (Freedom::Fixed, ""),
            other => {
                let message = format!(
                    "joint `{name}` is of kind `{other}`: a description supports revolute, prismatic and clamped joints"
                );
                return Err(ImportError::new(message));
            }
        };
        if joint.on_tip.is_some() {
            return Err(ImportError::new(format!(
                "joint `{name}` is closed by [assembly]: write the positions that it determines"
            )));
        }
        let value =
            joint.parameters.number_or(key, 0.0).map_err(|error| ImportError::new(error.to_string()))?;
        // The origin of the link is at the joint.
        let link_frame = Motion::new(frame.rotation, *at);
        let along = axes.first().map_or_else(Vector3::z, |axis| axis.value.normalize());
        let own = frame.rotation.apply_inverse(&along) * if is_turned { -1.0 } else { 1.0 };
        let step = match freedom {
            Freedom::Rotation => Motion::new(Rotation::about_axis(&own, value), Vector3::zeros()),
            Freedom::Displacement => Motion::translation(value * own),
            _ => Motion::identity(),
        };
        let origin = link_frame.relative_to(&self.frames[carrier]) * step.inverse();
        let child = robot.links.len();
        robot.links.push(link(body, &frame.relative_to(&link_frame)));
        self.frames.push(link_frame);
        self.values.push((name.clone(), value));
        let mut of = RobotJoint::new(name.clone(), freedom, carrier, child, origin);
        of.axis = own;
        if let Some(friction) = &joint.friction {
            let given = |key: &str| friction.value.number_or(key, 0.0).unwrap_or(f64::NAN);
            of.friction = given("coulomb");
            of.damping = given("viscous");
            if ["static", "breakaway", "stribeck"].iter().any(|key| friction.value.has(key)) {
                robot.unsupported.push(format!("friction at rest of joint `{name}`"));
            }
        }
        robot.joints.push(of);
        Ok(())
    }
}

/// Relations between coordinates: gears become mimic joints.
fn couplings(document: &Document, tree: &Tree, robot: &mut Robot) -> Result<(), ImportError> {
    let value =
        |name: &str| tree.values.iter().find(|(known, _)| known == name).map_or(0.0, |(_, value)| *value);
    for joint in &document.joints {
        let name = &joint.name.value;
        match (joint.attachment.coordinates.as_slice(), joint.kind.value.as_str()) {
            _ if joint.ports.have_one_location() => {}
            ([(leader, _), (other, _)], "gear") => {
                let ratio =
                    joint.parameters.number("ratio").map_err(|error| ImportError::new(error.to_string()))?;
                let offset = value(&other.value) - ratio * value(&leader.value);
                if joint.parameters.has("efficiency") {
                    robot.unsupported.push(format!("the friction of the gear `{name}`"));
                }
                let follower = robot.joints.iter_mut().find(|own| own.name == other.value);
                match follower.filter(|own| own.follows.is_none()) {
                    Some(own) => own.follows = Some((leader.value.clone(), ratio, offset)),
                    None => robot.unsupported.push(format!("the gear `{name}`, a second one on one joint")),
                }
            }
            (_, kind) => robot.unsupported.push(format!("`{name}`, of kind `{kind}`")),
        }
    }
    Ok(())
}

/// Dampers, friction and stops of joints; all other effects of springs are reported.
fn resistance(spring: &Component, robot: &mut Robot) {
    let name = &spring.name.value;
    let only = |known: &[&str]| spring.parameter_spans.iter().all(|(key, _)| known.contains(&key.as_str()));
    let number = |key: &str| spring.parameters.number_or(key, 0.0).unwrap_or(f64::NAN);
    let joint = spring.attachment.coordinates.first().filter(|_| spring.ports.quantity().is_some());
    let of_joint = joint.and_then(|(joint, _)| robot.joints.iter_mut().find(|own| own.name == joint.value));
    let unsupported = match (spring.kind.value.as_str(), of_joint) {
        ("torsional" | "axial", Some(joint)) if only(&["damping", "coordinate"]) => {
            joint.damping += number("damping");
            None
        }
        ("torsional_friction" | "axial_friction", Some(joint))
            if only(&["coulomb", "viscous", "deflection", "damping", "coordinate"])
                && joint.friction == 0.0 =>
        {
            joint.friction = number("coulomb");
            joint.damping += number("viscous");
            None
        }
        ("torsional_stop" | "axial_stop", Some(joint)) if joint.range.is_none() => {
            match spring.parameters.range("range") {
                Ok(Some([low, high])) if low.is_finite() && high.is_finite() => {
                    joint.range = Some([low, high]);
                    let words = format!("stiffness and losses of the stops `{name}`");
                    robot.left_out.push(words);
                    None
                }
                _ => Some(format!("the stop `{name}`, which has only one end")),
            }
        }
        (kind, _) => Some(format!("the spring `{name}`, of kind `{kind}`")),
    };
    robot.unsupported.extend(unsupported);
}

/// Entries that act on the bodies, and those that only observe.
fn report_omissions(document: &Document, robot: &mut Robot) {
    if document.gravity != GRAVITY {
        let [x, y, z] = document.gravity.into();
        robot.unsupported.push(format!("gravity of ({x}, {y}, {z}) m/s²; the format implies (0, 0, -9.81)"));
    }
    robot.unsupported.extend(document.loads.iter().map(|load| format!("the load `{}`", load.name.value)));
    robot.unsupported.extend(document.events.iter().map(|event| format!("the event `{}`", event.name.value)));
    let moves = |body: &&Body| {
        let turns = body.angular_velocity.as_ref().is_some_and(|given| given.value != Vector3::zeros());
        turns || body.velocity.as_ref().is_some_and(|given| given.value != Vector3::zeros())
    };
    if document.bodies.iter().any(|body| moves(&body)) || document.initial.is_some() {
        robot.left_out.push("velocities at the start".to_owned());
    }
    if !document.outputs.is_empty() {
        robot.left_out.push(format!("{} outputs, and the analysis", document.outputs.len()));
    }
}
