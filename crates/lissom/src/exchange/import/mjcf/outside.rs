//! Sections of an MJCF file other than bodies: those that are converted, and those that are reported.

use std::collections::BTreeMap;

use lissom_motion::{Motion, Vector3};

use super::super::xml::counted;
use super::super::{Closure, ImportError, JointTendon, Keyframe, Motor, Robot, Rope};
use super::element::Element;
use super::joint::limits;
use super::touching;
use super::tree::Node;

/// Sites by name: the link, and the frame of the site in it.
pub(super) type Sites = BTreeMap<String, (usize, Motion)>;

/// Sections that do not affect the motion.
const SHOWN: [&str; 7] = ["size", "visual", "statistic", "asset", "custom", "sensor", "extension"];
/// Settings of a compiler that change masses, and their values without effect.
const MASS_SETTINGS: [(&str, &[&str]); 3] =
    [("boundmass", &["0"]), ("boundinertia", &["0"]), ("balanceinertia", &["false"])];
/// Forces that flags of the options can disable.
const FORCES: [&str; 8] =
    ["constraint", "equality", "frictionloss", "limit", "passive", "spring", "damper", "clampctrl"];

/// Reports unknown settings of the compiler.
pub(super) fn check_compiler(compiler: &Element) -> Result<(), ImportError> {
    if compiler.text("coordinate").is_some_and(|word| word != "local") {
        return Err(compiler.fault("only coordinate=\"local\" is known"));
    }
    for (key, harmless) in MASS_SETTINGS {
        let value = compiler.text(key);
        if value.is_some_and(|value| !harmless.contains(&value) && value.parse() != Ok(0.0)) {
            return Err(compiler.fault(format!("`{key}` is not supported: write the actual masses")));
        }
    }
    Ok(())
}

/// Gravity from `<option>` [m/s²].
pub(super) fn gravity(root: &Node) -> Result<Vector3, ImportError> {
    let mut gravity = [0.0, 0.0, -9.81];
    for node in root.of("option") {
        let option = &node.element;
        gravity = option.numbers::<3>("gravity")?.unwrap_or(gravity);
        if node.of("flag").any(|flag| flag.attribute("gravity") == Some("disable")) {
            gravity = [0.0; 3];
        }
    }
    Ok(gravity.into())
}

/// Scales masses and inertias to the total mass `settotalmass` of the compiler [kg], if it is positive.
pub(super) fn set_total_mass(compiler: &Element, robot: &mut Robot) -> Result<(), ImportError> {
    let wanted = compiler.number("settotalmass", -1.0)?;
    let found: f64 = robot.links.iter().filter_map(|link| link.inertia).map(|inertia| inertia.mass).sum();
    if wanted > 0.0 && found > 0.0 {
        for inertia in robot.links.iter_mut().filter_map(|link| link.inertia.as_mut()) {
            inertia.mass *= wanted / found;
            inertia.inertia *= wanted / found;
        }
    }
    Ok(())
}

/// Reads all sections except bodies into `robot`.
pub(super) fn read(root: &Node, sites: &Sites, robot: &mut Robot) {
    let handled = ["compiler", "default", "worldbody", "option", "tendon", "actuator"];
    let (mut others, mut actuators, mut without_force) = (Vec::new(), 0, 0);
    let disabled = robot.keep(disabled_groups(root)).unwrap_or_else(|| Some(Vec::new()));
    for node in &root.children {
        match node.tag() {
            "option" => {
                let read = option(node, robot);
                robot.keep(read);
            }
            "equality" => {
                for inner in &node.children {
                    let read = equality(inner, robot);
                    robot.keep(read);
                }
            }
            "contact" => {
                for inner in &node.children {
                    let read = touching::contact(inner, robot);
                    robot.keep(read);
                }
            }
            "actuator" => {
                for own in &node.children {
                    match robot.keep(motor(own, actuators, robot)) {
                        _ if is_disabled(own, disabled.as_ref()) => without_force += 1,
                        Some(Some(motor)) => robot.motors.push(motor),
                        _ => others.push(own.tag().to_owned()),
                    }
                    actuators += 1;
                }
            }
            "keyframe" => {
                for own in &node.children {
                    let read = keyframe(own, robot);
                    robot.keep(read);
                }
            }
            "include" => {
                // Files are read where the description is one.
                let file = node.attribute("file").unwrap_or_default();
                let fault =
                    node.element.fault(format!("the file `{file}` is not read from a text without a folder"));
                robot.obstacles.push(fault.message);
            }
            tag if handled.contains(&tag) || SHOWN.contains(&tag) => {}
            "deformable" if node.children.iter().all(|own| own.has_tag("skin")) => {
                robot.left_out.push(format!("skins of {}", node.element.words()));
            }
            _ => robot.unsupported.push(node.element.words()),
        }
    }
    for node in root.within("tendon") {
        let read = tendon(node, sites, robot);
        robot.keep(read);
    }
    if without_force > 0 {
        robot.left_out.push(format!("{without_force} actuators that the options disable"));
    }
    let all = counted(others.into_iter());
    if !all.is_empty() {
        robot.left_out.push(format!(
            "actuators, also their forces without a command: {}; joints are driven by loads and signals",
            all.join(", ")
        ));
    }
}

/// A position of all joints, and inputs of all actuators. Velocities and activations are omitted.
fn keyframe(node: &Node, robot: &mut Robot) -> Result<(), ImportError> {
    let own = &node.element;
    own.check_known(&["name", "qpos", "qvel", "ctrl"], &["time", "act", "mpos", "mquat"])?;
    let name = own.text("name").map_or_else(|| format!("key{}", robot.keyframes.len()), str::to_owned);
    if own.list("qvel")?.unwrap_or_default().iter().any(|value| *value != 0.0) {
        robot.left_out.push(format!("the velocities of key frame `{name}`"));
    }
    let positions = own.list("qpos")?.unwrap_or_default();
    let inputs = own.list("ctrl")?.unwrap_or_default();
    robot.keyframes.push(Keyframe { name, positions, inputs, source: own.location().to_owned() });
    Ok(())
}

fn option(node: &Node, robot: &mut Robot) -> Result<(), ImportError> {
    let option = &node.element;
    for key in ["density", "viscosity"] {
        if option.number(key, 0.0)? != 0.0 {
            robot.unsupported.push(format!("fluid forces, `{key}` of {}", option.words()));
        }
    }
    if option.list("wind")?.unwrap_or_default().iter().any(|value| *value != 0.0) {
        robot.left_out.push(format!("the wind of {}, which acts by a fluid", option.words()));
    }
    robot.contacts.step = option.numbers::<1>("timestep")?.map(|[step]| step).or(robot.contacts.step);
    for flag in node.of("flag") {
        let is_off = |word: &str| flag.attribute(word) == Some("disable");
        for word in FORCES.iter().filter(|word| is_off(word)) {
            robot.unsupported.push(format!("the flag {word}=\"disable\" of {}", option.words()));
        }
        robot.contacts.filters_parents &= !is_off("filterparent");
        robot.contacts.is_disabled |= is_off("contact");
    }
    Ok(())
}

/// Groups of actuators that the options disable; none for all groups.
fn disabled_groups(root: &Node) -> Result<Option<Vec<f64>>, ImportError> {
    let mut groups = Vec::new();
    for node in root.of("option") {
        if node.of("flag").any(|flag| flag.attribute("actuation") == Some("disable")) {
            return Ok(None);
        }
        groups = node.element.list("actuatorgroupdisable")?.unwrap_or(groups);
    }
    Ok(Some(groups))
}

/// Whether an actuator exerts no force because of the options.
fn is_disabled(actuator: &Node, disabled: Option<&Vec<f64>>) -> bool {
    let group = actuator.attribute("group").and_then(|group| group.parse().ok()).unwrap_or(0.0);
    disabled.is_none_or(|groups| groups.contains(&group))
}

/// An actuator on a joint, by its number; none for those with states, muscles, and those on other things.
fn motor(node: &Node, number: usize, robot: &Robot) -> Result<Option<Motor>, ImportError> {
    let own = &node.element;
    let Some(name) = own.text("joint") else { return Ok(None) };
    let Some(joint) = robot.joints.iter().position(|joint| joint.name == name && joint.moves()) else {
        return Ok(None);
    };
    let parameters = |key: &str, first: f64| -> Result<[f64; 3], ImportError> {
        let given = own.list(key)?.unwrap_or_default();
        let of = |k: usize| given.get(k).copied().unwrap_or(if k == 0 { first } else { 0.0 });
        Ok([0, 1, 2].map(of))
    };
    let (mut gain, mut bias) = ([1.0, 0.0, 0.0], [0.0; 3]);
    match node.tag() {
        "motor" => {}
        "position" if own.number("timeconst", 0.0)? == 0.0 && own.number("dampratio", 0.0)? == 0.0 => {
            let stiffness = own.number("kp", 1.0)?;
            (gain[0], bias) = (stiffness, [0.0, -stiffness, -own.number("kv", 0.0)?]);
        }
        "velocity" => {
            gain[0] = own.number("kv", 1.0)?;
            bias[2] = -gain[0];
        }
        "damper" => gain = [0.0, 0.0, -own.number("kv", 1.0)?],
        "general" if matches!(own.text("dyntype"), None | Some("none")) => {
            gain = match own.text("gaintype") {
                None | Some("fixed") => [parameters("gainprm", 1.0)?[0], 0.0, 0.0],
                Some("affine") => parameters("gainprm", 1.0)?,
                Some(_) => return Ok(None),
            };
            match own.text("biastype") {
                None | Some("none") => {}
                Some("affine") => bias = parameters("biasprm", 0.0)?,
                Some(_) => return Ok(None),
            }
        }
        _ => return Ok(None),
    }
    let gear = own.list("gear")?.and_then(|all| all.first().copied()).unwrap_or(1.0);
    let limits = |key: &str, word: &str| limits(own, (key, word), node.settings.autolimits);
    let mut input = limits("ctrlrange", "ctrllimited")?;
    if let (Some(share), Some([low, high])) = (own.numbers::<1>("inheritrange")?, robot.joints[joint].range) {
        let (middle, half) = (0.5 * (low + high), 0.5 * share[0] * (high - low));
        input = Some([middle - half, middle + half]).filter(|_| share[0] > 0.0).or(input);
    }
    let force = limits("forcerange", "forcelimited")?;
    let name = node.name().map(str::to_owned);
    Ok(Some(Motor { name, joint, number, gear, gain, bias, input, force, start: 0.0 }))
}

/// Joints that follow others become mimic joints; bodies that are connected close loops; other equalities are reported.
fn equality(node: &Node, robot: &mut Robot) -> Result<(), ImportError> {
    let own = &node.element;
    if !own.flag("active", true)? {
        robot.left_out.push(format!("an equality that is not active, {}", own.words()));
        return Ok(());
    }
    let tag = node.tag();
    let relative = own.list("relpose")?.unwrap_or_default();
    let is_relative = relative.iter().skip(3).any(|value| *value != 0.0);
    if let (true, Some(first)) = (matches!(tag, "connect" | "weld") && !is_relative, own.text("body1")) {
        let second = own.text("body2").unwrap_or("world");
        if let Some(message) = missing_body(&[first, second], own, robot)? {
            robot.unsupported.push(message);
            return Ok(());
        }
        let links =
            [first, second].map(|name| robot.links.iter().position(|link| link.name == name).unwrap_or(0));
        let anchor = own.numbers::<3>("anchor")?;
        if tag == "connect" && anchor.is_none() {
            return Err(own.fault("it has no `anchor`"));
        }
        let name =
            own.text("name").map_or_else(|| format!("{tag}{}", robot.closures.len() + 1), str::to_owned);
        robot.closures.push(Closure {
            name,
            locks_rotation: tag == "weld",
            links,
            // The point of a weld has no effect but on its softness.
            anchor: anchor.filter(|_| tag == "connect").map_or_else(Vector3::zeros, Vector3::from),
            source: own.location().to_owned(),
        });
        return Ok(());
    }
    let polynomial = own.list("polycoef")?.unwrap_or_else(|| vec![0.0, 1.0]);
    let is_linear = polynomial.iter().skip(2).all(|factor| *factor == 0.0);
    let (first, second) = (own.text("joint1"), own.text("joint2"));
    let (Some(first), Some(second)) = (first.filter(|_| tag == "joint" && is_linear), second) else {
        robot.unsupported.push(format!("{} of <equality>", own.words()));
        return Ok(());
    };
    let reference = |name: &str| {
        let found = robot.joints.iter().find(|joint| joint.name == name).map(|joint| joint.reference);
        found.ok_or_else(|| own.fault(format!("there is no joint `{name}`")))
    };
    // y - y₀ = a + b (x - x₀)
    let (a, b) = (polynomial.first().copied().unwrap_or(0.0), polynomial.get(1).copied().unwrap_or(0.0));
    let offset = reference(first)? + a - b * reference(second)?;
    for joint in robot.joints.iter_mut().filter(|joint| joint.name == first) {
        if !joint.moves() || joint.follows.is_some() || b == 0.0 {
            return Err(own.fault(format!("joint `{first}` cannot depend on `{second}` in this way")));
        }
        joint.follows = Some((second.to_owned(), b, offset));
    }
    Ok(())
}

/// What connects bodies of deformable parts, which are not generated; none if all bodies are there.
///
/// # Errors
/// If a body is not there and nothing could generate it.
pub(super) fn missing_body(
    names: &[&str],
    own: &Element,
    robot: &Robot,
) -> Result<Option<String>, ImportError> {
    let is_there = |name: &str| robot.links.iter().any(|link| link.name == name);
    let Some(name) = names.iter().find(|name| !is_there(name)) else { return Ok(None) };
    let is_generated = robot
        .unsupported
        .iter()
        .any(|what| what.starts_with("<flexcomp>") || what.starts_with("<composite>"));
    if is_generated {
        return Ok(Some(format!("{}, which connects the body `{name}` of a deformable part", own.words())));
    }
    Err(own.fault(format!("there is no body `{name}`")))
}

/// Tendons with springs and limits; those that only transmit actuators have no effect of their own.
fn tendon(node: &Node, sites: &Sites, robot: &mut Robot) -> Result<(), ImportError> {
    let own = &node.element;
    let acts = |keys: &[&str]| {
        keys.iter().any(|key| {
            own.text(key).is_some_and(|text| text.split_whitespace().any(|word| word.parse() != Ok(0.0)))
        })
    };
    let name = own
        .text("name")
        .map_or_else(|| format!("tendon{}", robot.ropes.len() + robot.tendons.len() + 1), str::to_owned);
    if !acts(&["stiffness", "damping", "frictionloss", "armature", "range"]) {
        robot.left_out.push(format!("the tendon `{name}`, which serves only actuators"));
        return Ok(());
    }
    let limited = match own.text("limited").unwrap_or("auto") {
        "true" => true,
        "auto" => node.settings.autolimits,
        _ => false,
    };
    let range = own.numbers::<2>("range")?.filter(|_| limited);
    let stiffness = own.not_negative("stiffness")?;
    let damping = own.not_negative("damping")?;
    let rest = own.list("springlength")?.filter(|rest| rest.first().is_some_and(|first| *first >= 0.0));
    let rest = rest.map(|rest| [rest[0], rest.get(1).copied().unwrap_or(rest[0])]);
    let acts_otherwise = damping > 0.0 || acts(&["frictionloss", "armature"]);
    let tendon = Springy { name: name.clone(), range, stiffness, rest };
    let is_known = match node.tag() {
        _ if acts_otherwise => false,
        "fixed" => fixed(node, tendon, robot)?,
        "spatial" => spatial(node, sites, tendon, robot)?,
        _ => false,
    };
    if !is_known {
        let name = own.text("name").unwrap_or("without a name");
        robot.unsupported.push(format!("the tendon `{name}` ({})", own.location()));
    }
    Ok(())
}

/// Limits and spring of a tendon.
struct Springy {
    name: String,
    range: Option<[f64; 2]>,
    stiffness: f64,
    /// Lengths between which its spring is free of force, if they are given.
    rest: Option<[f64; 2]>,
}

/// A tendon over joint coordinates; false if it cannot be modelled.
fn fixed(node: &Node, own: Springy, robot: &mut Robot) -> Result<bool, ImportError> {
    let mut terms = Vec::new();
    for term in node.of("joint") {
        let joint = term.attribute("joint").unwrap_or_default();
        let Some(index) = robot.joints.iter().position(|own| own.name == joint && own.moves()) else {
            return Err(term.element.fault(format!("there is no hinge or slide `{joint}`")));
        };
        terms.push((index, term.element.number("coef", 1.0)?));
    }
    if terms.is_empty() {
        return Ok(false);
    }
    let reference = terms.iter().map(|(joint, factor)| factor * robot.joints[*joint].reference).sum();
    let tendon = JointTendon {
        name: own.name,
        terms,
        range: own.range,
        stiffness: own.stiffness,
        rest: own.rest.unwrap_or([reference; 2]),
    };
    robot.tendons.push(tendon);
    Ok(true)
}

/// A tendon over sites that only pulls, as a rope; false for others.
fn spatial(node: &Node, sites: &Sites, tendon: Springy, robot: &mut Robot) -> Result<bool, ImportError> {
    let mut along = Vec::new();
    for own in &node.children {
        let Some(site) = own.attribute("site").filter(|_| own.has_tag("site")) else { return Ok(false) };
        let found = sites.get(site).map(|(link, frame)| (*link, frame.position));
        along.push(found.ok_or_else(|| own.element.fault(format!("there is no site `{site}`")))?);
    }
    // Limits pull only; so does a spring that is free of force from the length zero on.
    let (length, stiffness) = match (tendon.range, tendon.rest) {
        (Some([low, high]), _) if low <= 0.0 && tendon.stiffness == 0.0 => (high, None),
        (None, Some([low, high])) if low == 0.0 && high > 0.0 => (high, Some(tendon.stiffness)),
        _ => return Ok(false),
    };
    if along.len() < 2 {
        return Ok(false);
    }
    robot.ropes.push(Rope { name: tendon.name, along, length, stiffness });
    Ok(true)
}
