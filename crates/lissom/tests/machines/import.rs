//! Robots from URDF files against a closed form and Pinocchio 4.1: accelerations, kinetic energy and mass; a passive fall; what is
//! rejected.
//!
//! `robots/pinocchio.json` has what Pinocchio says of robots of the package example-robot-data 6.0.0. Their files are read where the
//! variable `LISSOM_REFERENCES` names a folder that has them in `urdf/`, and omitted otherwise.

use std::fmt::Write;

use lissom::exchange::import::{Motors, Options, Pose, Root, Unsupported, from_mjcf, from_urdf, model_text};
use lissom_motion::Vector6;
use serde_json::Value;

use crate::support::runs::{SCHEMES, column, last, run};

const REFERENCE: &str = include_str!("robots/pinocchio.json");
const ROBOTS: [&str; 5] = ["double_pendulum", "ur5", "panda", "z1", "solo12"];
const TWO_LINKS: &str = include_str!("robots/two_links.urdf");
const BARE: Options = Options {
    root: Root::Held,
    limits: false,
    friction: false,
    mimic: false,
    contacts: false,
    motors: Motors::Omitted,
    unsupported: Unsupported::Refused,
};

/// Name and description of the robots that are at hand.
fn robots() -> Vec<(&'static str, String)> {
    let Some(folder) = std::env::var_os("LISSOM_REFERENCES") else { return Vec::new() };
    let folder = std::path::Path::new(&folder).join("urdf");
    let read = |name| std::fs::read_to_string(folder.join(format!("{name}.urdf"))).ok();
    ROBOTS.iter().filter_map(|name| Some((*name, read(name)?))).collect()
}

struct Known {
    /// Joints that move, without the floating one.
    joints: Vec<String>,
    q: Vec<f64>,
    v: Vec<f64>,
    torques: Vec<f64>,
    accelerations: Vec<f64>,
    kinetic_energy: f64,
    fall: Option<Vec<f64>>,
    root_twist: Vector6,
}

fn known(robot: &str) -> Known {
    let reference: Value = serde_json::from_str(REFERENCE).expect("JSON");
    let of = &reference[robot];
    let numbers = |value: &Value| -> Vec<f64> {
        value.as_array().map_or_else(Vec::new, |list| list.iter().filter_map(Value::as_f64).collect())
    };
    let names = of["joint_names"].as_array().expect("names").iter().filter_map(Value::as_str);
    let joints: Vec<String> =
        names.filter(|name| !["universe", "root_joint"].contains(name)).map(str::to_owned).collect();
    let tail = |key: &str| {
        let all = numbers(&of[key]);
        all[all.len() - joints.len()..].to_vec()
    };
    let floats = numbers(&of["v"]).len() > joints.len();
    let root_twist =
        if floats { Vector6::from_column_slice(&numbers(&of["v"])[..6]) } else { Vector6::zeros() };
    Known {
        q: tail("q"),
        v: tail("v"),
        torques: tail("tau"),
        accelerations: tail("forward_dynamics_acc"),
        kinetic_energy: of["kinetic_energy"].as_f64().expect("a number"),
        fall: of.get("fall_end").map(numbers),
        root_twist,
        joints,
    }
}

fn pose(known: &Known, moves: bool) -> Pose {
    let by_name = |values: &[f64]| known.joints.iter().cloned().zip(values.iter().copied()).collect();
    let rates = if moves { by_name(&known.v) } else { std::collections::BTreeMap::new() };
    Pose { values: by_name(&known.q), rates, root_twist: known.root_twist }
}

#[test]
fn accelerations_are_those_of_pinocchio() {
    for (name, text) in robots() {
        let (robot, known) = (from_urdf(&text).expect("a robot"), known(name));
        let root = if name == "solo12" { Root::Floating } else { Root::Held };
        let options = Options { root, ..BARE };
        let mut model = model_text(&robot, &pose(&known, true), options).expect("a model");
        // The torques of the root are no loads of joints: without them the whole robot would be pulled.
        let is_free = name == "solo12";
        for (joint, torque) in known.joints.iter().zip(&known.torques) {
            let freedom = robot.joints.iter().find(|own| own.name == *joint).expect("there").freedom;
            let (kind, key) = match freedom {
                lissom::exchange::import::Freedom::Displacement => ("joint_force", "force"),
                _ => ("joint_torque", "torque"),
            };
            let _ = write!(
                model,
                "\n[loads.of_{joint}]\nkind = \"{kind}\"\njoint = \"{joint}\"\n{key} = {torque:?}\n\
                 [outputs.a_{joint}]\nkind = \"relative_acceleration\"\nof = \"{joint}\"\n"
            );
        }
        let record = run(&model, &[("analysis.end", "1e-3"), ("analysis.step", "1e-4")]);
        let kinetic = column(&record, "energy", "kinetic")[0];
        assert!(
            (kinetic - known.kinetic_energy).abs() < 1e-10 * known.kinetic_energy,
            "{name}: {kinetic} {}",
            known.kinetic_energy
        );
        if is_free {
            continue;
        }
        let largest = known.accelerations.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        for (joint, wanted) in known.joints.iter().zip(&known.accelerations) {
            let found = column(&record, &format!("a_{joint}"), "a")[0];
            assert!((found - wanted).abs() < 1e-9 * largest, "{name}, {joint}: {found} {wanted}");
        }
    }
}

/// Two links in the plane, with angles q and torques τ: M q'' = τ + G - C.
#[test]
fn accelerations_of_two_links_are_those_of_lagrange() {
    let robot = from_urdf(TWO_LINKS).expect("a robot");
    let (q, v, torques) = ([0.4_f64, -0.9_f64], [1.3, -2.1], [3.0, -1.5]);
    let by_name =
        |values: [f64; 2]| ["shoulder", "elbow"].map(str::to_owned).into_iter().zip(values).collect();
    let pose = Pose { values: by_name(q), rates: by_name(v), ..Pose::default() };
    let mut model = model_text(&robot, &pose, BARE).expect("a model");
    for (joint, torque) in ["shoulder", "elbow"].iter().zip(torques) {
        let _ = write!(
            model,
            "\n[loads.of_{joint}]\nkind = \"joint_torque\"\njoint = \"{joint}\"\ntorque = {torque:?}\n\
             [outputs.a_{joint}]\nkind = \"relative_acceleration\"\nof = \"{joint}\"\n"
        );
    }
    let record = run(&model, &[("analysis.end", "1e-3"), ("analysis.step", "1e-4")]);
    let (upper, lower) = ((2.5, 0.35, 0.12), (1.2, 0.2, 0.03));
    let own = lower.2 + lower.0 * lower.1 * lower.1;
    let coupled = lower.0 * 0.8 * lower.1;
    let (sine, cosine) = q[1].sin_cos();
    let corner = own + coupled * cosine;
    let first = upper.2 + upper.0 * upper.1 * upper.1 + lower.0 * 0.8 * 0.8 + own + 2.0 * coupled * cosine;
    let (along, beyond) = (q[0].cos(), (q[0] + q[1]).cos());
    let weight = 9.81 * lower.0 * lower.1 * beyond;
    let forces = [
        torques[0]
            + 9.81 * (upper.0 * upper.1 + lower.0 * 0.8) * along
            + weight
            + coupled * sine * (2.0 * v[0] * v[1] + v[1] * v[1]),
        torques[1] + weight - coupled * sine * v[0] * v[0],
    ];
    let determinant = first * own - corner * corner;
    let wanted = [
        (own * forces[0] - corner * forces[1]) / determinant,
        (first * forces[1] - corner * forces[0]) / determinant,
    ];
    for (joint, wanted) in ["shoulder", "elbow"].iter().zip(wanted) {
        let found = column(&record, &format!("a_{joint}"), "a")[0];
        assert!((found / wanted - 1.0).abs() < 1e-10, "{joint}: {found} {wanted}");
    }
}

/// The largest error of a joint at the end of a second's fall.
fn error_of_fall(name: &str, text: &str, scheme: &str, step: &str) -> f64 {
    let (robot, known) = (from_urdf(text).expect("a robot"), known(name));
    let model = model_text(&robot, &pose(&known, false), BARE).expect("a model");
    let record = run(&model, &[("analysis.scheme", scheme), ("analysis.step", step)]);
    let fall = known.fall.expect("a fall");
    let errors = known.joints.iter().zip(&fall).map(|(joint, wanted)| {
        let freedom = robot.joints.iter().find(|own| own.name == *joint).expect("there").freedom;
        let slides = freedom == lissom::exchange::import::Freedom::Displacement;
        (last(&record, joint, if slides { "displacement" } else { "angle" }) - wanted).abs()
    });
    errors.fold(0.0, f64::max)
}

/// Radau IIA converges with order 3 to what Pinocchio and an integrator of high order find. The fingers of the panda are so light that
/// its fall would take long.
#[test]
fn a_passive_fall_ends_where_it_should() {
    for (name, text) in &robots() {
        let bound = match *name {
            "ur5" => 5e-8,
            "z1" => 1e-4,
            _ => continue,
        };
        let errors = ["1e-3", "5e-4"].map(|step| error_of_fall(name, text, "radau-iia", step));
        assert!(errors[1] < bound && errors[0] / errors[1] > 7.0, "{name}: {errors:?}");
    }
    for (name, text) in robots().iter().filter(|(name, _)| *name == "ur5") {
        for scheme in SCHEMES {
            let error = error_of_fall(name, text, scheme, "1e-3");
            assert!(error < 1e-3, "{scheme}: {error}");
        }
    }
}

#[test]
fn limits_damping_and_friction_become_springs_and_followers_gears() {
    let robot = from_urdf(
        "<robot name='gripper'><link name='palm'/>\
         <link name='left finger'><inertial><mass value='0.1'/><inertia ixx='1e-4' iyy='1e-4' izz='1e-4'/></inertial></link>\
         <link name='pad'><inertial><origin xyz='0.05 0 0.1'/><mass value='0.1'/><inertia ixx='1e-5' iyy='1e-5' izz='1e-5'/>\
         </inertial></link>\
         <link name='right'><inertial><mass value='0.2'/><inertia ixx='1e-4' iyy='1e-4' izz='1e-4'/></inertial></link>\
         <joint name='glue' type='fixed'><parent link='left finger'/><child link='pad'/><origin xyz='0 0 0.1'/></joint>\
         <joint name='a' type='revolute'><parent link='palm'/><child link='left finger'/><axis xyz='0 1 0'/>\
         <limit lower='-0.5' upper='0.7' effort='3' velocity='1'/><dynamics damping='0.02' friction='0.001'/></joint>\
         <joint name='b' type='prismatic'><parent link='palm'/><child link='right'/><origin xyz='0 0.1 0'/>\
         <axis xyz='1 0 0'/><mimic joint='a' multiplier='-0.1' offset='0.02'/></joint></robot>",
    )
    .expect("a robot");
    assert_eq!(robot.left_out, ["speed limits of 1 joint (`velocity`), which are not enforced"]);
    let pose = Pose { values: [("b".to_owned(), 0.03)].into(), ..Pose::default() };
    let refused = model_text(&robot, &pose, Options::default()).unwrap_err().to_string();
    assert!(refused.contains("must start at 0.02"), "{refused}");
    let text = model_text(&robot, &Pose::default(), Options::default()).expect("a model");
    for line in [
        "[bodies.left_finger]   # link left finger",
        "mass = 0.2",
        "center_of_mass = [0.025",
        "kind = \"torsional_stop\"",
        "range = [-0.5, 0.7]",
        "damping = 0.02",
        "coulomb = 0.001",
        "kind = \"gear\"",
        "ratio = -0.1",
        "# the motor of a exerts at most 3.0 N m",
        "# the speed limit of a is 1.0 rad/s; it is not enforced",
        "# Omitted: speed limits of 1 joint",
    ] {
        assert!(text.contains(line), "{line} is not in\n{text}");
    }
    assert!(!text.contains("[bodies.pad]"), "what is fixed is part of what it is fixed to");
    let record = run(&text, &[("analysis.end", "0.05")]);
    let [a, b] = [last(&record, "a", "angle"), last(&record, "b", "displacement")];
    assert!((b - 0.02 + 0.1 * a).abs() < 1e-9 && a.abs() > 1e-3, "{a} {b}");
}

/// Least and greatest corner of what is drawn of a body.
fn extent(body: &lissom_model::document::Body) -> [[f32; 3]; 2] {
    let points = &body.surface.as_ref().expect("a shape").points;
    [f32::min as fn(f32, f32) -> f32, f32::max]
        .map(|of| std::array::from_fn(|k| points.iter().map(|point| point[k]).reduce(of).expect("points")))
}

#[test]
fn shapes_and_meshes_of_links_are_drawn() {
    let folder = crate::support::folder::Folder::new("visuals");
    let meshes = folder.path().join("robots/arm_description/meshes");
    std::fs::create_dir_all(&meshes).unwrap();
    let facet = "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1000 0 0 vertex 0 500 0 endloop endfacet";
    folder.write("robots/arm_description/meshes/plate.stl", &format!("solid plate\n{facet}\nendsolid"));
    let text = "<robot name='arm'><link name='base'><visual><geometry><sphere radius='1'/></geometry></visual></link>\
         <link name='upper'><inertial><origin xyz='9 9 9'/><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial>\
         <visual><origin xyz='0.5 0 0' rpy='0 0 1.5707963267948966'/><geometry><box size='0.2 1 0.4'/></geometry>\
         <material name='red'/></visual>\
         </link>\
         <link name='hand'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial>\
         <visual><geometry><mesh filename='hand.dae'/></geometry></visual>\
         <collision><geometry><box size='0.2 0.4 0.6'/></geometry></collision></link>\
         <material name='red'><color rgba='1 0.5 0 1'/></material>\
         <link name='bolt'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial>\
         <visual><geometry><mesh filename='bolt.dae'/></geometry></visual></link>\
         <joint name='c' type='continuous'><parent link='base'/><child link='hand'/></joint>\
         <joint name='d' type='continuous'><parent link='base'/><child link='bolt'/></joint>\
         <link name='tool'><visual><geometry><cylinder radius='0.1' length='2'/></geometry></visual></link>\
         <link name='plate'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial>\
         <visual><geometry><mesh filename='package://arm_description/meshes/plate.stl' scale='0.001 -0.001 0.001'/></geometry></visual></link>\
         <joint name='a' type='continuous'><parent link='base'/><child link='upper'/></joint>\
         <joint name='glue' type='fixed'><parent link='upper'/><child link='tool'/><origin xyz='2 0 0'/></joint>\
         <joint name='b' type='continuous'><parent link='tool'/><child link='plate'/></joint></robot>";
    let description = folder.path().join("robots/arm_description/urdf/arm.urdf");
    std::fs::create_dir_all(description.parent().unwrap()).unwrap();
    let mut robot = from_urdf(text).expect("a robot");
    let model = folder.path().join("arm.toml");
    robot.locate_meshes(&description, &model);
    let text = model_text(&robot, &Pose::default(), Options::default()).expect("a model");
    assert!(
        text.contains(
            "# Omitted: meshes, which must be STL or glTF files in the folders of the description: bolt.dae and 1 more; shapes"
        ),
        "{text}"
    );
    assert!(text.contains("file = \"robots/arm_description/meshes/plate.stl\""), "{text}");
    let registry = lissom_model::lower::registry::registry();
    let document =
        lissom_model::Document::parse(&text, &model.display().to_string(), &registry).expect("a model");
    let body = |name: &str| document.bodies.iter().find(|body| body.name.value == name).expect("there");
    let is_near = |found: [[f32; 3]; 2], wanted: [[f32; 3]; 2]| {
        let near = found.iter().flatten().zip(wanted.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-6);
        assert!(near, "{found:?} is not {wanted:?}");
    };
    // The box, turned by a quarter about z, and the cylinder of the tool, which is fixed 2 m away.
    is_near(extent(body("upper")), [[0.0, -0.1, -1.0], [2.1, 0.1, 1.0]]);
    is_near(extent(body("hand")), [[-0.1, -0.2, -0.3], [0.1, 0.2, 0.3]]);
    assert!(
        body("bolt").surface.as_ref().is_some_and(|surface| surface.points.is_empty()),
        "nothing is drawn of it"
    );
    assert!(text.contains("[ground]\nshape = [\n    { kind = \"sphere\""), "the root is drawn: {text}");
    is_near(extent(body("plate")), [[0.0, -0.5, 0.0], [1.0, 0.0, 0.0]]);
    let painted = &body("upper").surface.as_ref().expect("drawn").colours;
    let box_alone = lissom_model::scene::Painted { first: 0, count: 12, shade: [255, 128, 0] };
    assert_eq!(painted[..], [box_alone], "a material that is described elsewhere");
}

/// Colours of MJCF: of the geom, before that of its material, and of its class; clear shapes that touch nothing are not drawn.
#[test]
fn geoms_have_colours() {
    let text = "<mujoco><default><geom rgba='0 0 1 1'/><default class='red'><geom rgba='1 0 0 1'/></default></default>\
         <asset><material name='green' rgba='0 0.2 0 1'/></asset><worldbody><body><freejoint/>\
         <geom type='box' size='1 1 1' rgba='1 1 0 0.5' material='green'/><geom size='2' class='red'/><geom size='3'/>\
         <geom size='4' rgba='1 0 1 0' contype='0' conaffinity='0'/></body></worldbody></mujoco>";
    let text = model_text(&from_mjcf(text).expect("a robot"), &Pose::default(), Options::default())
        .expect("a model");
    let colour_of =
        |words: &str| text.lines().find(|line| line.contains(words)).and_then(|line| line.split('#').nth(1));
    for (words, colour) in [("box", "ffff00"), ("radius = 2.0", "ff0000"), ("radius = 3.0", "0000ff")] {
        assert!(colour_of(words).is_some_and(|own| own.starts_with(colour)), "{words}: {text}");
    }
    assert!(!text.contains("radius = 4.0"), "{text}");
    let of_material = "<mujoco><asset><material name='green' rgba='0 0.2 0 1'/></asset><worldbody><body><freejoint/>\
         <geom size='1' material='green'/></body></worldbody></mujoco>";
    let robot = from_mjcf(of_material).expect("a robot");
    let text = model_text(&robot, &Pose::default(), Options::default()).expect("a model");
    assert!(text.contains("colour = \"#003300\""), "{text}");
}

#[test]
fn wrong_descriptions_are_reported() {
    let said = |text: &str| match from_urdf(text) {
        Ok(robot) => model_text(&robot, &Pose::default(), Options::default()).unwrap_err().to_string(),
        Err(error) => error.to_string(),
    };
    let link = "<link name='a'/>";
    for (text, words) in [
        ("<robot", "no XML"),
        ("<sdf/>", "not URDF"),
        ("<robot><link name='a'/><link name='a'/></robot>", "two links"),
        ("<robot><link name='a'/><link name='b'/></robot>", "have no parent"),
        (
            "<robot><link name='a'><inertial><mass value='one'/><inertia ixx='1' iyy='1' izz='1'/></inertial></link></robot>",
            "line 1",
        ),
    ] {
        assert!(said(text).contains(words), "{}", said(text));
    }
    let joined =
        |joint: &str| format!("<robot>{link}<link name='b'/><joint name='j' {joint}</joint></robot>");
    let ends = "<parent link='a'/><child link='b'/>";
    for (joint, words) in [
        (format!("type='revolute'>{ends}"), "neither it nor the links fixed to it have mass"),
        (format!("type='ball'>{ends}"), "its type `ball` is unknown"),
        (format!("type='revolute'>{ends}<axis xyz='0 0 0'/>"), "no direction"),
        ("type='fixed'><parent link='a'/><child link='c'/>".to_owned(), "no link `c`"),
        (format!("type='revolute'>{ends}<limit lower='1' upper='-1'/>"), "above the upper"),
    ] {
        let found = said(&joined(&joint));
        assert!(found.contains(words), "{found}");
    }
}
