//! Sensors of MJCF that measure coordinates of joints and the motion of frames.

use lissom_motion::Motion;

use super::super::xml::counted;
use super::super::{Measured, MotionKind, Robot, Sensor};
use super::outside::Sites;
use super::tree::Node;

/// Attributes that change what a sensor measures.
const CHANGING: [&str; 5] = ["cutoff", "reftype", "refname", "delay", "interval"];

/// Reads all sensors; those that are not converted are reported together.
pub(super) fn read(root: &Node, sites: &Sites, robot: &mut Robot) {
    let mut others = Vec::new();
    for node in root.within("sensor") {
        if let Some(quantity) = quantity(node, sites, robot) {
            let count = robot.sensors.len() + 1;
            let name = node.name().map_or_else(|| format!("{}{count}", node.tag()), str::to_owned);
            robot.sensors.push(Sensor { name, quantity });
        } else {
            let site = node.element.text("site").filter(|site| !sites.contains_key(*site));
            let missing =
                site.map_or_else(String::new, |site| format!(" of the site `{site}`, which is not there"));
            others.push(format!("{}{missing}", node.tag()));
        }
    }
    let all = counted(others.into_iter());
    if !all.is_empty() {
        robot.left_out.push(format!("sensors that are not converted to outputs: {}", all.join(", ")));
    }
}

/// The quantity of a sensor; none if it is not converted, or what it measures is not in the model.
fn quantity(node: &Node, sites: &Sites, robot: &Robot) -> Option<Measured> {
    let own = &node.element;
    let is_zero = |text: &str| text.split_whitespace().all(|word| word.parse() == Ok(0.0));
    if CHANGING.iter().any(|key| own.text(key).is_some_and(|text| !is_zero(text))) {
        return None;
    }
    let joint = || {
        let name = own.text("joint")?;
        robot.joints.iter().position(|joint| joint.name == name && joint.moves())
    };
    let site = |key: &str| sites.get(own.text(key)?).copied();
    let body = || {
        let name = own.text("objname")?;
        robot.links.iter().position(|link| link.name == name)
    };
    let of = |kind: MotionKind, (link, frame): (usize, Motion)| Some(Measured::Motion { kind, link, frame });
    let kind = match node.tag() {
        "jointpos" => return joint().map(Measured::Coordinate),
        "jointvel" => return joint().map(Measured::Rate),
        "accelerometer" => return of(MotionKind::SpecificForce, site("site")?),
        "gyro" => return of(MotionKind::OwnAngularVelocity, site("site")?),
        "velocimeter" => return of(MotionKind::OwnVelocity, site("site")?),
        "framepos" => MotionKind::Position,
        "framelinvel" => MotionKind::Velocity,
        "frameangvel" => MotionKind::AngularVelocity,
        _ => return None,
    };
    match own.text("objtype")? {
        "site" => of(kind, site("objname")?),
        "xbody" => of(kind, (body()?, Motion::identity())),
        // The frame of a `body` is at its centre of mass.
        "body" => {
            let link = body()?;
            let centre = robot.links[link].inertia.map(|inertia| inertia.centre).unwrap_or_default();
            of(kind, (link, Motion::translation(centre)))
        }
        _ => None,
    }
}
