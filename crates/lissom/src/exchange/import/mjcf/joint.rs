//! Joints of MJCF.

use lissom_motion::{Motion, Vector3};

use super::super::{Freedom, ImportError, RobotJoint};
use super::element::Element;
use super::frame::direction;
use super::tree::Settings;

const USED: &[&str] = &[
    "type",
    "pos",
    "axis",
    "springdamper",
    "stiffness",
    "range",
    "limited",
    "actuatorfrcrange",
    "actuatorfrclimited",
    "ref",
    "springref",
    "armature",
    "damping",
    "frictionloss",
];
const HARMLESS: &[&str] = &[
    "group",
    "solreflimit",
    "solimplimit",
    "solreffriction",
    "solimpfriction",
    "margin",
    "user",
    "actuatorgravcomp",
    "align",
];

/// A joint from link `parent` to link `child`, the child's frame at `origin` at its reference value.
pub(super) fn joint(
    element: &Element,
    settings: &Settings,
    (name, parent, child, origin): (String, usize, usize, Motion),
) -> Result<RobotJoint, ImportError> {
    element.check_known(USED, HARMLESS)?;
    let (angles, autolimits) = (&settings.angles, settings.autolimits);
    let kind = if element.has_tag("freejoint") { "free" } else { element.text("type").unwrap_or("hinge") };
    let freedom = match kind {
        "hinge" => Freedom::Rotation,
        "slide" => Freedom::Displacement,
        "ball" => Freedom::Ball,
        "free" => Freedom::Floating,
        other => {
            return Err(element
                .fault(format!("its type `{other}` is unknown: it must be free, ball, slide or hinge")));
        }
    };
    let unit = if freedom == Freedom::Displacement { 1.0 } else { angles.unit };
    let mut joint = RobotJoint::new(name, freedom, parent, child, origin);
    joint.spring.stiffness = element.not_negative("stiffness")?;
    joint.damping = element.not_negative("damping")?;
    joint.friction = element.not_negative("frictionloss")?;
    joint.armature = element.not_negative("armature")?;
    element.location().clone_into(&mut joint.source);
    // Free joints inherit `limited` of a default class without being limited, as in MuJoCo.
    if freedom != Freedom::Floating {
        let range = limits(element, ("range", "limited"), autolimits)?;
        joint.range = range.map(|ends| ends.map(|end| end * unit));
    }
    joint.anchor = Vector3::from(element.numbers::<3>("pos")?.unwrap_or_default());
    if joint.moves() {
        joint.axis = direction(element, "axis", element.numbers::<3>("axis")?.unwrap_or([0.0, 0.0, 1.0]))?;
        joint.reference = unit * element.number("ref", 0.0)?;
        joint.spring.rest = unit * element.number("springref", 0.0)?;
        joint.rating.effort = limits(element, ("actuatorfrcrange", "actuatorfrclimited"), autolimits)?;
    }
    if joint.freedom == Freedom::Floating && joint.spring.stiffness > 0.0 {
        return Err(
            element.fault("the stiffness of a free joint is not supported: add a spring to the model")
        );
    }
    Ok(joint)
}

/// The range, if it is enabled by its flag or by being given.
pub(super) fn limits(
    element: &Element,
    (key, word): (&str, &str),
    autolimits: bool,
) -> Result<Option<[f64; 2]>, ImportError> {
    let range = element.numbers::<2>(key)?;
    let counts = match element.text(word).unwrap_or("auto") {
        "true" => true,
        "false" => false,
        "auto" if autolimits || range.is_none() => range.is_some(),
        "auto" => return Err(element.fault(format!("`{key}` requires `{word}`, because of `autolimits`"))),
        other => return Err(element.fault(format!("`{word}` must be true, false or auto, not `{other}`"))),
    };
    match range.filter(|_| counts) {
        None if counts => Err(element.fault(format!("`{word}` without `{key}`"))),
        Some([low, high]) if low > high => Err(element.fault(format!("`{key}`: {low} is above {high}"))),
        range => Ok(range),
    }
}
