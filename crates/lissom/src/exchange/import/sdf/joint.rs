//! Joints of SDF: one coordinate each, or two in series through a link without mass.

use lissom_motion::{Motion, Vector3};

use super::super::urdf::NO_LIMIT;
use super::super::{Freedom, ImportError, JointSpring, MotorRating, RobotJoint};
use super::element::Element;

/// Limits that are none [rad, m].
const NO_RANGE: f64 = 1e16;
/// Contents of a joint that are read, or have no effect.
const KNOWN: [&str; 11] = [
    "parent",
    "child",
    "axis",
    "axis2",
    "pose",
    "physics",
    "sensor",
    "thread_pitch",
    "screw_thread_pitch",
    "gearbox_ratio",
    "gearbox_reference_body",
];
/// Contents of an axis that are read, or have no effect.
const OF_AXES: [&str; 6] =
    ["xyz", "dynamics", "limit", "mimic", "use_parent_model_frame", "initial_position"];

/// The pose of a joint and the directions of its axes.
pub(super) struct Placed<'r> {
    /// Pose of the child in the parent.
    pub(super) origin: Motion,
    /// A point of its axes in the child's frame [m].
    pub(super) anchor: Vector3,
    /// The rotation from the axes of a direction to those of the child: of the elements `axis` and `axis2`.
    pub(super) turn: &'r dyn Fn(&Element) -> Result<Motion, ImportError>,
    /// Name in the model of the joint of this name in the description.
    pub(super) leader: &'r dyn Fn(&str) -> Option<String>,
}

/// The joints that an element describes, each along the next; between them are links without mass. Parents and children are those of
/// the whole.
pub(super) fn joints(
    element: &Element,
    (name, parent, child): (&str, usize, usize),
    placed: &Placed<'_>,
    unsupported: &mut Vec<String>,
) -> Result<Vec<RobotJoint>, ImportError> {
    let of = |name: String, freedom: Freedom| RobotJoint {
        anchor: placed.anchor,
        source: element.source.clone(),
        ..RobotJoint::new(name, freedom, parent, child, placed.origin)
    };
    let mut along = |tag: &str, name: String, freedom: Freedom| {
        // Without one it is z.
        let none = Element { tag: tag.to_owned(), source: element.source.clone(), ..Element::default() };
        with_axis(of(name, freedom), element.child(tag).unwrap_or(&none), placed, unsupported)
    };
    let kind = element.attribute("type").ok_or_else(|| element.fault("it has no `type`"))?;
    let joints = match kind {
        "fixed" => vec![of(name.to_owned(), Freedom::Fixed)],
        "ball" => vec![of(name.to_owned(), Freedom::Ball)],
        "revolute" => vec![along("axis", name.to_owned(), Freedom::Rotation)?],
        "continuous" => {
            vec![RobotJoint { range: None, ..along("axis", name.to_owned(), Freedom::Rotation)? }]
        }
        "prismatic" => vec![along("axis", name.to_owned(), Freedom::Displacement)?],
        "universal" | "revolute2" => vec![
            along("axis", name.to_owned(), Freedom::Rotation)?,
            along("axis2", format!("{name}_axis2"), Freedom::Rotation)?,
        ],
        "screw" => {
            let turn = along("axis", name.to_owned(), Freedom::Rotation)?;
            let lead =
                match (element.numbers::<1>("screw_thread_pitch")?, element.numbers::<1>("thread_pitch")?) {
                    (Some([pitch]), _) => pitch / std::f64::consts::TAU,
                    // Radians per metre, of a left-handed thread.
                    (None, Some([pitch])) if pitch != 0.0 => -1.0 / pitch,
                    _ => return Err(element.fault("it needs a <screw_thread_pitch>")),
                };
            let slide = of(format!("{name}_slide"), Freedom::Displacement);
            vec![RobotJoint { axis: turn.axis, follows: Some((turn.name.clone(), lead, 0.0)), ..slide }, turn]
        }
        other => {
            return Err(element.fault(format!(
                "its type `{other}` is unknown: it must be revolute, continuous, prismatic, ball, fixed, universal, revolute2 or screw"
            )));
        }
    };
    let unknown = element.children.iter().filter(|child| !KNOWN.contains(&child.tag.as_str()));
    unsupported.extend(unknown.map(|child| format!("{} of joint `{name}`", child.words())));
    if let Some(physics) = element.within(&["physics", "ode"]) {
        for tag in ["velocity", "max_force"] {
            if physics.number(tag, 0.0)? != 0.0 {
                unsupported.push(format!("the motor by `{tag}` of {}", element.words()));
            }
        }
        if let Some(suspension) = physics.child("suspension") {
            unsupported.push(format!("{} of joint `{name}`", suspension.words()));
        }
    }
    Ok(joints)
}

/// A joint along an axis, with its limits, spring and friction.
fn with_axis(
    joint: RobotJoint,
    axis: &Element,
    placed: &Placed<'_>,
    unsupported: &mut Vec<String>,
) -> Result<RobotJoint, ImportError> {
    let fault = |message: String| axis.fault(format!("joint `{}`: {message}", joint.name));
    let direction = Vector3::from(axis.numbers::<3>("xyz")?.unwrap_or([0.0, 0.0, 1.0]));
    let direction =
        direction.try_normalize(0.0).ok_or_else(|| fault("its axis has no direction".to_owned()))?;
    let direction = (placed.turn)(axis)?.rotation.apply(&direction);
    let (mut range, mut rating) = (None, MotorRating::default());
    if let Some(limit) = axis.child("limit") {
        let end = |tag: &str, none: f64| -> Result<f64, ImportError> {
            Ok(limit.limit(tag)?.filter(|value| value.abs() < NO_RANGE).unwrap_or(none))
        };
        let [low, high] = [end("lower", f64::NEG_INFINITY)?, end("upper", f64::INFINITY)?];
        if low > high {
            return Err(fault(format!("its lower limit {low} is above the upper one {high}")));
        }
        range = Some([low, high]).filter(|ends| ends.iter().any(|end| end.is_finite()));
        let given = |tag: &str| -> Result<Option<f64>, ImportError> {
            Ok(limit.limit(tag)?.filter(|value| (0.0..NO_LIMIT).contains(value)))
        };
        rating = MotorRating {
            effort: given("effort")?.map(|effort| [-effort, effort]),
            speed: given("velocity")?,
        };
    }
    let (mut spring, mut damping, mut friction) = (JointSpring::default(), 0.0, 0.0);
    if let Some(own) = axis.child("dynamics") {
        (damping, friction) = (own.not_negative("damping")?, own.not_negative("friction")?);
        spring = JointSpring {
            stiffness: own.not_negative("spring_stiffness")?,
            rest: own.number("spring_reference", 0.0)?,
        };
    }
    let mut follows = None;
    if let Some(mimic) = axis.child("mimic") {
        let name = mimic.attribute("joint").ok_or_else(|| mimic.fault("it names no joint"))?;
        let leader =
            (placed.leader)(name).ok_or_else(|| mimic.fault(format!("there is no joint `{name}`")))?;
        let leader = match mimic.attribute("axis").unwrap_or("axis") {
            "axis" => leader,
            "axis2" => format!("{leader}_axis2"),
            other => return Err(mimic.fault(format!("`axis` must be axis or axis2, not `{other}`"))),
        };
        let factor = mimic.number("multiplier", 1.0)?;
        let offset = mimic.number("offset", 0.0)? - factor * mimic.number("reference", 0.0)?;
        follows = Some((leader, factor, offset));
    }
    if axis.number("initial_position", 0.0)? != 0.0 {
        unsupported.push(format!("the initial position of joint `{}` ({})", joint.name, axis.source));
    }
    let unknown = axis.children.iter().filter(|child| !OF_AXES.contains(&child.tag.as_str()));
    unsupported.extend(unknown.map(|child| format!("{} of joint `{}`", child.words(), joint.name)));
    Ok(RobotJoint { axis: direction, range, rating, spring, damping, friction, follows, ..joint })
}
