//! How geoms of MJCF touch: masks, friction and softness of each geom, and pairs that touch or do not touch by themselves.

use super::super::{ContactPair, ImportError, Robot, Touch, TouchLaw};
use super::element::Element;
use super::outside::missing_body;
use super::tree::Node;

/// Softness without other values: time constant [s] and damping ratio; largest impedance.
const SOLREF: [f64; 2] = [0.02, 1.0];
const IMPEDANCE: f64 = 0.95;
/// Sliding friction without another value.
const FRICTION: f64 = 1.0;
/// Least and greatest impedance.
const IMPEDANCES: [f64; 2] = [1e-4, 0.9999];

/// How a geom touches others; none if its masks exclude all.
pub(super) fn of_geom(element: &Element) -> Result<Option<Touch>, ImportError> {
    let mask = |key: &str| -> Result<u32, ImportError> {
        let value = element.number(key, 1.0)?;
        // Masks are 32 bits of an integer, which may be negative.
        Ok(value as i64 as u32)
    };
    let masks = [mask("contype")?, mask("conaffinity")?];
    if element.number("margin", 0.0)? < 0.0 {
        return Err(element.fault("`margin` is negative"));
    }
    Ok(Some(Touch {
        masks,
        priority: element.number("priority", 0.0)?,
        mixing: element
            .not_negative("solmix")
            .map(|own| if element.text("solmix").is_none() { 1.0 } else { own })?,
        group: None,
        is_frictionless: element.number("condim", 3.0)? == 1.0,
        law: law(element, [FRICTION, FRICTION], SOLREF, IMPEDANCE)?,
    }))
    .map(|touch| touch.filter(|touch| touch.masks != [0, 0]))
}

/// Friction and softness of an element, with defaults.
fn law(
    element: &Element,
    [friction, _]: [f64; 2],
    softness: [f64; 2],
    impedance: f64,
) -> Result<TouchLaw, ImportError> {
    let friction = element.list("friction")?.and_then(|all| all.first().copied()).unwrap_or(friction);
    if friction < 0.0 {
        return Err(element.fault(format!("`friction` is negative: {friction}")));
    }
    let mut given = softness;
    for (own, value) in given.iter_mut().zip(element.list("solref")?.unwrap_or_default()) {
        *own = value;
    }
    let is_time = given[0] > 0.0 && given[1] > 0.0;
    if !is_time && (given[0] > 0.0 || given[1] > 0.0) {
        return Err(element.fault("the numbers of `solref` must both be positive, or both not"));
    }
    let impedance = element.list("solimp")?.and_then(|all| all.get(1).copied()).unwrap_or(impedance);
    Ok(TouchLaw { friction, softness: given, impedance: impedance.clamp(IMPEDANCES[0], IMPEDANCES[1]) })
}

/// An element of `<contact>`: a pair of geoms that touch, or bodies that do not.
pub(super) fn contact(node: &Node, robot: &mut Robot) -> Result<(), ImportError> {
    let own = &node.element;
    let required = |key: &str| own.text(key).ok_or_else(|| own.fault(format!("it has no `{key}`")));
    match node.tag() {
        "exclude" => {
            let names = [required("body1")?, required("body2")?];
            if missing_body(&names, own, robot)?.is_some() {
                return Ok(());
            }
            let links = names.map(|name| robot.links.iter().position(|link| link.name == name).unwrap_or(0));
            robot.contacts.excluded.push(links);
        }
        "pair" => {
            let mut links = [0; 2];
            let mut laws = Vec::new();
            for (at, key) in links.iter_mut().zip(["geom1", "geom2"]) {
                let name = required(key)?;
                let is_it = |visual: &&super::super::Visual| visual.name.as_deref() == Some(name);
                let found = robot
                    .links
                    .iter()
                    .enumerate()
                    .find_map(|(link, own)| Some((link, own.visuals.iter().find(is_it)?)));
                let (link, visual) =
                    found.ok_or_else(|| own.fault(format!("there is no geom `{name}` that could touch")))?;
                *at = link;
                laws.push(visual.touch);
            }
            let friction = laws.iter().flatten().map(|own| own.law.friction).fold(f64::NAN, f64::max);
            let friction = if friction.is_nan() { FRICTION } else { friction };
            let mut law = law(own, [friction; 2], SOLREF, IMPEDANCE)?;
            if own.number("condim", 3.0)? == 1.0 {
                law.friction = 0.0;
            }
            // Geoms of pairs touch although their masks exclude all others.
            for (link, key) in links.into_iter().zip(["geom1", "geom2"]) {
                let name = own.text(key);
                for visual in robot.links[link].visuals.iter_mut().filter(|own| own.name.as_deref() == name) {
                    visual.touch.get_or_insert(Touch {
                        masks: [0, 0],
                        priority: 0.0,
                        mixing: 1.0,
                        is_frictionless: false,
                        group: None,
                        law,
                    });
                }
            }
            robot.contacts.pairs.push(ContactPair { links, law });
        }
        _ => return Err(own.fault("it is unknown here: <pair> or <exclude>")),
    }
    Ok(())
}
