//! Sections of an MJCF file other than bodies: those that are converted, and those that are reported.

use lissom_motion::Vector3;
use roxmltree::Node;

use super::super::xml::{children, counted};
use super::super::{Closure, ImportError, Motor, Robot};
use super::element::{Classes, Element};

/// Sections that do not affect the motion.
const SHOWN: [&str; 7] = ["size", "visual", "statistic", "asset", "custom", "sensor", "keyframe"];
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
pub(super) fn gravity(root: Node<'_, '_>) -> Result<Vector3, ImportError> {
    let mut gravity = [0.0, 0.0, -9.81];
    for node in children(root, "option") {
        let option = Element::bare(node);
        gravity = option.numbers::<3>("gravity")?.unwrap_or(gravity);
        if children(node, "flag").any(|flag| flag.attribute("gravity") == Some("disable")) {
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
pub(super) fn read(root: Node<'_, '_>, classes: &Classes, robot: &mut Robot) {
    let handled = ["compiler", "default", "worldbody", "option", "contact", "equality", "tendon", "actuator"];
    for node in root.children().filter(Node::is_element) {
        let tag = node.tag_name().name();
        match tag {
            "option" => {
                let read = option(node, robot);
                robot.keep(read);
            }
            "equality" => {
                for inner in inner(node) {
                    let read = equality(inner, classes, robot);
                    robot.keep(read);
                }
            }
            "tendon" => {
                let read = tendons(node, classes, robot);
                robot.keep(read);
            }
            "actuator" => {
                let (mut motors, mut others) = (Vec::new(), Vec::new());
                for own in inner(node) {
                    match robot.keep(motor(own, classes, robot)) {
                        Some(Some(motor)) => motors.push(motor),
                        _ => others.push(own.tag_name().name().to_owned()),
                    }
                }
                if !motors.is_empty() {
                    let words = match motors.len() {
                        1 => "the command of 1 motor: `--motors` writes an input".to_owned(),
                        count => format!("the commands of {count} motors: `--motors` writes inputs"),
                    };
                    robot.left_out.push(words);
                }
                robot.motors.extend(motors);
                let all = counted(others.into_iter());
                if !all.is_empty() {
                    let words = format!(
                        "actuators, also their forces without a command: {}; joints are driven by loads and signals",
                        all.join(", ")
                    );
                    robot.left_out.push(words);
                }
            }
            "keyframe" if inner(node).next().is_some() => {
                robot.left_out.push("key frames: initial values are specified by --position".to_owned());
            }
            "include" => {
                // Files are read where the description is one.
                let file = node.attribute("file").unwrap_or_default();
                let fault = Element::bare(node)
                    .fault(format!("the file `{file}` is not read from a text without a folder"));
                robot.obstacles.push(fault.message);
            }
            _ if handled.contains(&tag) || SHOWN.contains(&tag) => {}
            _ => robot.unsupported.push(Element::bare(node).words()),
        }
    }
}

fn inner<'a>(node: Node<'a, 'a>) -> impl Iterator<Item = Node<'a, 'a>> {
    node.children().filter(Node::is_element)
}

fn option(node: Node<'_, '_>, robot: &mut Robot) -> Result<(), ImportError> {
    let option = Element::bare(node);
    for key in ["density", "viscosity"] {
        if option.number(key, 0.0)? != 0.0 {
            robot.unsupported.push(format!("fluid forces, `{key}` of {}", option.words()));
        }
    }
    for flag in children(node, "flag") {
        for word in FORCES.iter().filter(|word| flag.attribute(**word) == Some("disable")) {
            robot.unsupported.push(format!("the flag {word}=\"disable\" of {}", option.words()));
        }
    }
    Ok(())
}

/// A `motor` on a joint; none for other actuators, whose forces follow from laws of their own.
fn motor(node: Node<'_, '_>, classes: &Classes, robot: &Robot) -> Result<Option<Motor>, ImportError> {
    let own = classes.element(node, None)?;
    let Some(name) = own.text("joint").filter(|_| own.has_tag("motor")) else { return Ok(None) };
    let Some(joint) = robot.joints.iter().position(|joint| joint.name == name && joint.moves()) else {
        return Ok(None);
    };
    let gear = own.list("gear")?.and_then(|all| all.first().copied()).unwrap_or(1.0);
    let limits = |key: &str, word: &str| -> Result<Option<[f64; 2]>, ImportError> {
        Ok(own.numbers::<2>(key)?.filter(|_| own.text(word) != Some("false")))
    };
    let (input, own_effort) = (limits("ctrlrange", "ctrllimited")?, limits("forcerange", "forcelimited")?);
    let of_joint = robot.joints[joint].rating.effort.map(|effort| [-effort, effort]);
    Ok(Some(Motor { joint, gear, input, effort: own_effort.or(of_joint) }))
}

/// Joints that follow others become mimic joints; bodies that are connected close loops; other equalities are reported.
fn equality(node: Node<'_, '_>, classes: &Classes, robot: &mut Robot) -> Result<(), ImportError> {
    let own = classes.element(node, None)?;
    if !own.flag("active", true)? {
        robot.left_out.push(format!("an equality that is not active, {}", own.words()));
        return Ok(());
    }
    let tag = node.tag_name().name();
    let relative = own.list("relpose")?.unwrap_or_default();
    let is_relative = relative.iter().skip(3).any(|value| *value != 0.0);
    if let (true, Some(first)) = (matches!(tag, "connect" | "weld") && !is_relative, own.text("body1")) {
        let body = |name: &str| {
            let found = robot.links.iter().position(|link| link.name == name);
            found.ok_or_else(|| own.fault(format!("there is no body `{name}`")))
        };
        let links = [body(first)?, body(own.text("body2").unwrap_or("world"))?];
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

/// Tendons that only transmit actuators have no effect of their own.
fn tendons(node: Node<'_, '_>, classes: &Classes, robot: &mut Robot) -> Result<(), ImportError> {
    for node in inner(node) {
        let own = classes.element(node, None)?;
        let acts = ["stiffness", "damping", "frictionloss", "armature", "range"].iter().any(|key| {
            own.text(key).is_some_and(|text| text.split_whitespace().any(|word| word.parse() != Ok(0.0)))
        });
        let name = own.text("name").unwrap_or("without a name");
        if acts {
            robot.unsupported.push(format!("the tendon `{name}` ({})", own.location()));
        } else {
            robot.left_out.push(format!("the tendon `{name}`, which serves only actuators"));
        }
    }
    Ok(())
}
