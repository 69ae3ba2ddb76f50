//! Models as URDF: what comes back of the description moves as the model does; what the format cannot say is named.

use std::collections::BTreeMap;

use lissom::Model;
use lissom::exchange::import::{Options, Pose, Robot, Root, from_model, from_urdf, model_text, to_urdf};

use crate::support::runs::run;

/// An arm with axes of its own, an offset centre of mass, a tool that is clamped on, a slide, a follower, friction and damping.
const ARM: &str = r#"
lissom = 1
title = "arm <of> \"several\" & parts"
gravity = [0, 0, -9.81]
[bodies.upper]
mass = 2.5
inertia = [[0.02, 0.001, 0], [0.001, 0.12, 0.002], [0, 0.002, 0.11]]
position = [0.1, 0.2, 0.9]
rotation = [0.3, -0.4, 1.2]
center_of_mass = [0.2, 0.03, -0.01]
[bodies.slider]
mass = 1.2
inertia = [0.004, 0.03, 0.03]
position = [0.6, 0.1, 0.8]
rotation = [0, 1.5707963267948966, 0]
[bodies.tool]
mass = 0.3
inertia = [1e-3, 2e-3, 2e-3]
position = [0.7, 0.1, 0.7]
rotation = [0, 0, 0.5]
[bodies.finger]
mass = 0.1
inertia = [1e-4, 2e-4, 2e-4]
position = [0.75, 0.1, 0.65]
[joints.shoulder]
kind = "revolute"
base = "ground"
tip = "upper"
at = [0, 0, 1]
axis = [0, 2, 1]
angle = 0.4
[joints.rail]
kind = "prismatic"
base = "slider"
tip = "upper"
at = [0.5, 0.1, 0.9]
axis = [1, 0.2, 0]
displacement = 0.15
[joints.glue]
kind = "clamp"
base = "slider"
tip = "tool"
[joints.grip]
kind = "revolute"
base = "tool"
tip = "finger"
at = [0.72, 0.1, 0.68]
axis = [0, 0, 1]
angle = -0.2
[joints.belt]
kind = "gear"
joint = "rail"
other = "grip"
ratio = -3
[springs.oil]
kind = "axial"
joint = "rail"
damping = 4
[springs.bearing]
kind = "torsional"
joint = "shoulder"
damping = 0.2
[springs.rub]
kind = "torsional_friction"
joint = "shoulder"
coulomb = 0.7
viscous = 0.1
[outputs.shoulder]
kind = "relative"
of = "shoulder"
[outputs.rail]
kind = "relative"
of = "rail"
[outputs.grip]
kind = "relative"
of = "grip"
[outputs.shoulder_acceleration]
kind = "relative_acceleration"
of = "shoulder"
[outputs.rail_acceleration]
kind = "relative_acceleration"
of = "rail"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 0.3
step = 1e-3
"#;

fn robot(text: &str) -> Result<(Robot, Vec<(String, f64)>), String> {
    let document = Model::from_text("model.toml", text).document().map_err(|report| report.render(false))?;
    let found = from_model(&document).map_err(|error| error.to_string())?;
    Ok((found.robot, found.values))
}

#[test]
fn what_comes_back_moves_as_the_model_does() {
    let (first, values) = robot(ARM).expect("a robot");
    assert_eq!(first.unsupported, [""; 0]);
    let values: BTreeMap<String, f64> = values.into_iter().collect();
    assert_eq!(values.len(), 3);
    let again = from_urdf(&to_urdf(&first)).expect("a description");
    assert_eq!(again.name, "arm <of> \"several\" & parts");
    let pose = Pose { values, ..Pose::default() };
    let text =
        model_text(&again, &pose, Options { root: Root::Held, ..Options::default() }).expect("a model");
    let text = text
        + "\n[outputs.shoulder_acceleration]\nkind = \"relative_acceleration\"\nof = \"shoulder\"\n\
           [outputs.rail_acceleration]\nkind = \"relative_acceleration\"\nof = \"rail\"\n";
    let there =
        run(&text, &[("analysis.end", "0.3"), ("analysis.step", "1e-3"), ("analysis.scheme", "radau-iia")]);
    let here = run(ARM, &[]);
    for (output, component) in [
        ("shoulder_acceleration", "a"),
        ("rail_acceleration", "a"),
        ("shoulder", "angle"),
        ("rail", "displacement"),
        ("grip", "angle"),
    ] {
        let of = |record: &lissom::Record| record.column(output, component).expect("a column").to_vec();
        let (here, there) = (of(&here), of(&there));
        let most = here.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let missed = here.iter().zip(&there).fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs()));
        assert!(missed < 1e-8 * most && most > 0.0, "{output}: {missed:e} of {most}");
        assert!((here[0] - there[0]).abs() < 1e-10 * most, "{output} at the start");
    }
    // What has come back says the same again.
    let (second, _) = robot(&text).expect("a robot");
    assert_eq!(second.joints.len() + 1, first.joints.len(), "clamped parts are one body now");
}

#[test]
fn a_floating_robot_keeps_its_root() {
    let text = ARM.replace("base = \"ground\"\ntip = \"upper\"", "base = \"finger\"\ntip = \"upper\"").replace(
        "[joints.grip]\nkind = \"revolute\"\nbase = \"tool\"\ntip = \"finger\"\nat = [0.72, 0.1, 0.68]\naxis = [0, 0, 1]\nangle = -0.2\n",
        "",
    );
    let text =
        text.replace("[joints.belt]\nkind = \"gear\"\njoint = \"rail\"\nother = \"grip\"\nratio = -3\n", "");
    let text = text.replace("[outputs.grip]\nkind = \"relative\"\nof = \"grip\"\n", "");
    let (robot, _) = robot(&text).expect("a robot");
    assert_eq!((robot.links[0].name.as_str(), robot.links.len(), robot.joints.len()), ("upper", 4, 3));
    let mass: f64 = robot.links.iter().filter_map(|link| link.inertia).map(|inertia| inertia.mass).sum();
    assert!((mass - 4.1).abs() < 1e-12);
}

#[test]
fn what_the_format_cannot_say_is_named() {
    let refused = |from: &str, to: &str| robot(&ARM.replacen(from, to, 1)).expect_err("refused");
    let glue = "kind = \"clamp\"\nbase = \"slider\"";
    for (from, to, words) in [
        (glue, "kind = \"spherical\"\nbase = \"slider\"", "`glue` is of kind `spherical`"),
        (
            "[joints.belt]",
            "[joints.loop]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"tool\"\nat = [0.7, 0.1, 0.7]\n[joints.belt]",
            "loop",
        ),
        ("[joints.shoulder]", "[point_masses.p]\nmass = 1\n[joints.shoulder]", "point mass `p`"),
        (
            "[joints.shoulder]",
            "[materials.m]\nE = 1e9\nnu = 0\ndensity = 1\n[shells.sail]\ncorners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]\n\
             divisions = [1, 1]\nthickness = 0.1\nmaterial = \"m\"\n[joints.shoulder]",
            "shell `sail` is flexible",
        ),
        (
            "[joints.shoulder]",
            "[bodies.stone]\nmass = 1\ninertia = [1, 1, 1]\n[joints.shoulder]",
            "body `stone` has no joint",
        ),
    ] {
        let found = refused(from, to);
        assert!(found.contains(words), "{words}: {found}");
    }
    let unsupported = |from: &str, to: &str| {
        let (robot, _) = robot(&ARM.replacen(from, to, 1)).expect("a robot");
        robot.unsupported.join("; ")
    };
    for (from, to, words) in [
        ("damping = 4", "damping = 4\nstiffness = 2", "the spring `oil`"),
        ("gravity = [0, 0, -9.81]", "gravity = [0, -9.81, 0]", "gravity of (0, -9.81, 0)"),
        ("coulomb = 0.7", "coulomb = 0.7\nbreakaway = 1", "the spring `rub`"),
        (
            "[outputs.shoulder]",
            "[loads.push]\nkind = \"joint_torque\"\njoint = \"shoulder\"\ntorque = 1\n[outputs.shoulder]",
            "the load `push`",
        ),
        (
            "[outputs.shoulder]",
            "[joints.drive]\nkind = \"prescribed_rotation\"\njoint = \"shoulder\"\nrotation = \"0.4\"\n[outputs.shoulder]",
            "`drive`, of kind `prescribed_rotation`",
        ),
    ] {
        let found = unsupported(from, to);
        assert!(found.contains(words), "{words}: {found}");
    }
    // Sliding friction alone can be said; what is omitted is not friction at rest.
    let grip = "angle = -0.2\n";
    assert_eq!(unsupported(grip, &format!("{grip}friction = {{ coulomb = 0.5 }}\n")), "");
    let found = unsupported(grip, &format!("{grip}friction = {{ coulomb = 0.5, stribeck = 0.1 }}\n"));
    assert!(found.contains("friction at rest of joint `grip`"), "{found}");
}

#[test]
fn friction_of_gears_is_named() {
    let text = ARM.replace("ratio = -3", "ratio = -3\nefficiency = 0.9");
    let (robot, _) = robot(&text).expect("a robot");
    assert_eq!(robot.unsupported, ["the friction of the gear `belt`"]);
}
