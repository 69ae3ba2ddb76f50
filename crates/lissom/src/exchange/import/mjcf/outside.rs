//! Sections of an MJCF file other than bodies: those that are converted, and those that are reported.

use std::collections::BTreeMap;

use lissom_motion::Vector3;
use roxmltree::Node;

use super::super::xml::{children, counted};
use super::super::{ImportError, Robot};
use super::element::{Classes, Element};

/// Sections that do not affect the motion.
const SHOWN: [&str; 7] = ["size", "visual", "statistic", "asset", "custom", "sensor", "keyframe"];
/// Settings of a compiler that change masses, and their values without effect.
const MASS_SETTINGS: [(&str, &[&str]); 4] = [
    ("boundmass", &["0"]),
    ("boundinertia", &["0"]),
    ("settotalmass", &["-1"]),
    ("balanceinertia", &["false"]),
];
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

/// Reads all sections except bodies into `robot`.
pub(super) fn read(root: Node<'_, '_>, classes: &Classes, robot: &mut Robot) -> Result<(), ImportError> {
    let handled = ["compiler", "default", "worldbody", "option", "contact", "equality", "tendon", "actuator"];
    for node in root.children().filter(Node::is_element) {
        let tag = node.tag_name().name();
        match tag {
            "option" => option(node, robot)?,
            "equality" => equality(node, classes, robot)?,
            "tendon" => tendons(node, classes, robot)?,
            "actuator" => {
                let all = counted(inner(node).map(|own| own.tag_name().name().to_owned()));
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
                let file = node.attribute("file").unwrap_or_default();
                return Err(Element::bare(node)
                    .fault(format!("the file `{file}` is not read: replace the <include> by its text")));
            }
            _ if handled.contains(&tag) || SHOWN.contains(&tag) => {}
            other => robot.unsupported.push(format!("<{other}>")),
        }
    }
    Ok(())
}

fn inner<'a>(node: Node<'a, 'a>) -> impl Iterator<Item = Node<'a, 'a>> {
    node.children().filter(Node::is_element)
}

fn option(node: Node<'_, '_>, robot: &mut Robot) -> Result<(), ImportError> {
    let option = Element::bare(node);
    for key in ["density", "viscosity"] {
        if option.number(key, 0.0)? != 0.0 {
            robot.unsupported.push(format!("fluid forces, `{key}` of <option>"));
        }
    }
    for flag in children(node, "flag") {
        for word in FORCES.iter().filter(|word| flag.attribute(**word) == Some("disable")) {
            robot.unsupported.push(format!("the flag {word}=\"disable\" of <option>"));
        }
    }
    Ok(())
}

/// Joints that follow others become mimic joints; other loop closures are reported.
fn equality(node: Node<'_, '_>, classes: &Classes, robot: &mut Robot) -> Result<(), ImportError> {
    for node in inner(node) {
        let own = classes.element(node, None)?;
        if !own.flag("active", true)? {
            robot.left_out.push("an equality that is not active".to_owned());
            continue;
        }
        let tag = node.tag_name().name();
        let polynomial = own.list("polycoef")?.unwrap_or_else(|| vec![0.0, 1.0]);
        let is_linear = polynomial.iter().skip(2).all(|factor| *factor == 0.0);
        let (first, second) = (own.text("joint1"), own.text("joint2"));
        let (Some(first), Some(second)) = (first.filter(|_| tag == "joint" && is_linear), second) else {
            robot.unsupported.push(format!("<{tag}> of <equality>"));
            continue;
        };
        let references: BTreeMap<&str, f64> =
            robot.joints.iter().map(|joint| (joint.name.as_str(), joint.reference)).collect();
        let reference = |name: &str| {
            references.get(name).copied().ok_or_else(|| own.fault(format!("there is no joint `{name}`")))
        };
        // y - y₀ = a + b (x - x₀)
        let (a, b) = (polynomial.first().copied().unwrap_or(0.0), polynomial.get(1).copied().unwrap_or(0.0));
        let offset = reference(first)? + a - b * reference(second)?;
        let follows = Some((second.to_owned(), b, offset));
        for joint in robot.joints.iter_mut().filter(|joint| joint.name == first) {
            if !joint.moves() || joint.follows.is_some() || b == 0.0 {
                return Err(own.fault(format!("joint `{first}` cannot depend on `{second}` in this way")));
            }
            joint.follows.clone_from(&follows);
        }
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
            robot.unsupported.push(format!("the tendon `{name}`"));
        } else {
            robot.left_out.push(format!("the tendon `{name}`, which serves only actuators"));
        }
    }
    Ok(())
}
