//! Robots in SDF: poses of named frames, joints against closed forms, worlds with several models, included models, and what is not
//! supported.

use lissom::exchange::import::{
    Freedom, Options, Pose, Robot, RobotJoint, Root, Unsupported, VisualShape, from_description, from_file,
    model_text,
};
use lissom_motion::Vector3;

use crate::support::folder::Folder;
use crate::support::runs::{column, last, run};

const SHORT: [(&str, &str); 2] = [("analysis.end", "1e-3"), ("analysis.step", "1e-4")];
const FINE: [(&str, &str); 2] = [("analysis.scheme", "radau-iia"), ("analysis.step", "1e-3")];
const MASS: &str =
    "<inertial><mass>2</mass><inertia><ixx>0.1</ixx><iyy>0.2</iyy><izz>0.3</izz></inertia></inertial>";

fn described(content: &str) -> Robot {
    let text = format!("<sdf version='1.9'>{content}</sdf>");
    from_description(&text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn model(robot: &Robot, values: &[(&str, f64)], rates: &[(&str, f64)]) -> String {
    let by_name =
        |all: &[(&str, f64)]| all.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    let pose = Pose { values: by_name(values), rates: by_name(rates), ..Pose::default() };
    model_text(robot, &pose, Options::default()).unwrap_or_else(|error| panic!("{error}"))
}

fn rejected(content: &str) -> String {
    let robot = match from_description(&format!("<sdf version='1.9'>{content}</sdf>")) {
        Ok(robot) => robot,
        Err(error) => return error.message,
    };
    model_text(&robot, &Pose::default(), Options::default()).unwrap_err().message
}

fn joint<'a>(robot: &'a Robot, name: &str) -> &'a RobotJoint {
    robot.joints.iter().find(|joint| joint.name == name).unwrap_or_else(|| panic!("no joint {name}"))
}

fn is_near(found: &Vector3, wanted: [f64; 3]) {
    assert!((found - Vector3::from(wanted)).norm() < 1e-12, "{found:?} {wanted:?}");
}

fn acceleration(text: &str, joint: &str) -> f64 {
    let text = format!("{text}\n[outputs.a]\nkind = \"relative_acceleration\"\nof = \"{joint}\"\n");
    column(&run(&text, &SHORT), "a", "a")[0]
}

fn position(text: &str, body: &str, end: &str) -> Vector3 {
    let text = format!("{text}\n[outputs.at]\nkind = \"position\"\nof = \"{body}\"\n");
    let record = run(&text, &[FINE[0], FINE[1], ("analysis.end", end)]);
    Vector3::from(["x", "y", "z"].map(|letter| last(&record, "at", letter)))
}

/// Poses by frames: the child `b` is turned by a right angle about z against the base, 1 above a frame at (1, 2, 0).
#[test]
fn poses_are_relative_to_named_frames() {
    let robot = described(
        "<model name='m'><link name='base'><pose>1 0 0 0 0 0</pose></link>
         <frame name='f' attached_to='base'><pose degrees='true'>0 2 0 0 0 90</pose></frame>
         <link name='b'><pose relative_to='f' rotation_format='quat_xyzw'>0 0 1 0 0 0 1</pose></link>
         <joint name='j' type='revolute'><pose>0.5 0 0 0 0 0</pose><parent>f</parent><child>b</child>
          <axis><xyz expressed_in='base'>1 0 0</xyz></axis></joint>
         <joint name='k' type='prismatic'><parent>b</parent><child>inner::__model__</child><axis><xyz expressed_in='__model__'>0 2 0</xyz></axis></joint>
         <model name='inner' placement_frame='tip'><pose relative_to='b'>3 0 0 0 0 0</pose><link name='c'><pose>0 1 0 0 0 0</pose></link>
          <link name='d'/><joint name='weld' type='fixed'><parent>c</parent><child>d</child></joint>
          <frame name='tip' attached_to='c'><pose>0 0 1 0 0 0</pose></frame></model></model>",
    );
    let names: Vec<&str> = robot.links.iter().map(|link| link.name.as_str()).collect();
    assert_eq!(names, ["base", "b", "inner::c", "inner::d"]);
    assert!(!robot.is_root_the_world() && robot.may_float());
    is_near(&robot.root.pose().position, [1.0, 0.0, 0.0]);
    let hinge = joint(&robot, "j");
    is_near(&hinge.origin.position, [0.0, 2.0, 1.0]);
    is_near(&hinge.origin.rotation.logarithm(), [0.0, 0.0, std::f64::consts::FRAC_PI_2]);
    is_near(&hinge.anchor, [0.5, 0.0, 0.0]);
    is_near(&hinge.axis, [0.0, -1.0, 0.0]);
    // The frame `tip`, 1 above and beside the origin of the inner model, is 3 along x of `b`; its link c is 1 below.
    let slide = joint(&robot, "k");
    is_near(&slide.origin.position, [3.0, 0.0, -1.0]);
    is_near(&slide.axis, [1.0, 0.0, 0.0]);
    is_near(&joint(&robot, "inner::weld").origin.position, [0.0, -1.0, 0.0]);
    // Axes of old versions are in the frame of the model.
    let old = "<sdf version='1.4'><model name='m'><link name='a'/><link name='b'><pose>0 0 0 0 0 1.5707963267948966</pose></link>
        <joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>1 0 0</xyz></axis></joint></model></sdf>";
    is_near(&joint(&from_description(old).expect("a robot"), "j").axis, [0.0, -1.0, 0.0]);
}

/// A pendulum with the default inertia and gravity: α = (m g c cos q - k (q - q₀) - d q') / (1 + m c²).
#[test]
fn hinges_have_springs_limits_and_default_masses() {
    let robot = described(
        "<model name='m'><link name='arm'><inertial><pose>0.5 0 0 0 0 0</pose></inertial></link>
         <joint name='j' type='revolute'><parent>world</parent><child>arm</child><axis><xyz>0 3 0</xyz>
          <limit><lower>-1e16</lower><upper>2</upper><effort>-1</effort><velocity>-1</velocity></limit>
          <dynamics><damping>0.4</damping><friction>0</friction><spring_stiffness>3</spring_stiffness><spring_reference>0.1</spring_reference>
          </dynamics></axis></joint></model>",
    );
    let own = joint(&robot, "j");
    assert_eq!(
        (own.range, own.rating.effort, own.rating.speed),
        (Some([f64::NEG_INFINITY, 2.0]), None, None)
    );
    assert!(robot.is_root_the_world(), "the joint to the world holds it");
    let text = model(&robot, &[("j", 0.3)], &[("j", 0.7)]);
    let wanted = (9.8 * 0.5 * 0.3_f64.cos() - 3.0 * 0.2 - 0.4 * 0.7) / 1.25;
    let found = acceleration(&text, "j");
    assert!((found - wanted).abs() < 1e-9, "{found} {wanted}");
    let beyond = Pose { values: [("j".to_owned(), 2.1)].into(), ..Pose::default() };
    assert!(
        model_text(&robot, &beyond, Options::default())
            .unwrap_err()
            .message
            .contains("outside of its limits")
    );
}

/// A screw under its own weight: (m + J (2π/p)²) z'' = -m g; a universal joint at rest turns about each of its axes.
#[test]
fn screws_and_universal_joints_are_two_joints_in_series() {
    let of = |kind: &str, inside: &str| {
        described(&format!(
            "<model name='m'><link name='arm'>{MASS}</link><joint name='j' type='{kind}'><pose>0.5 0 0 0 0 0</pose><parent>world</parent>
             <child>arm</child>{inside}</joint></model>"
        ))
    };
    for (pitch, lead) in [
        ("<screw_thread_pitch>0.5</screw_thread_pitch>", 0.5 / std::f64::consts::TAU),
        ("<thread_pitch>4</thread_pitch>", -0.25),
    ] {
        let text = model(&of("screw", &format!("{pitch}<axis/>")), &[], &[]);
        // The centre of mass is 0.5 beside the axis.
        let wanted = -2.0 * 9.8 / (2.0 + (0.3 + 0.5) / (lead * lead));
        let found = [acceleration(&text, "j_slide"), acceleration(&text, "j") * lead];
        assert!(found.iter().all(|found| (found - wanted).abs() < 1e-9), "{found:?} {wanted}");
    }
    let axes = "<axis><xyz>0 1 0</xyz></axis><axis2><xyz>1 0 0</xyz><dynamics><spring_stiffness>4</spring_stiffness></dynamics></axis2>";
    for kind in ["universal", "revolute2"] {
        let text = model(&of(kind, axes), &[("j_axis2", 0.2)], &[]);
        let found = [acceleration(&text, "j"), acceleration(&text, "j_axis2")];
        // About y: the weight at -0.5 along x; about x: the spring. The second axis is principal, and so is the first at this angle
        // up to its turn: J = 0.2 cos² + 0.3 sin² + m c².
        let inertia = 0.2 * 0.2_f64.cos().powi(2) + 0.3 * 0.2_f64.sin().powi(2) + 0.5;
        let wanted = [-9.8 / inertia, -4.0 * 0.2 / 0.1];
        assert!(
            found.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-9),
            "{found:?} {wanted:?}"
        );
    }
}

/// A follower at q = multiplier (leader - reference) + offset.
#[test]
fn joints_mimic_with_a_reference() {
    let robot = described(&format!(
        "<model name='m'><link name='a'>{MASS}</link><link name='b'>{MASS}</link>
         <joint name='j' type='continuous'><parent>world</parent><child>a</child><axis><limit><lower>1</lower><upper>2</upper></limit></axis></joint>
         <joint name='k' type='revolute'><parent>a</parent><child>b</child><axis><mimic joint='j'><multiplier>-2</multiplier><offset>0.3</offset>
          <reference>0.1</reference></mimic></axis></joint></model>"
    ));
    assert_eq!(joint(&robot, "j").range, None, "a continuous joint has no limits");
    let text = model(&robot, &[("j", 0.4)], &[("j", 1.0)]);
    let record = run(&text, &SHORT);
    let at = |joint: &str| column(&record, joint, "angle")[0];
    assert!((at("k") - (-2.0 * 0.3 + 0.3)).abs() < 1e-12 && (at("j") - 0.4).abs() < 1e-12);
}

/// A lone model that floats falls along the global z axis from its pose, however its root is turned.
#[test]
fn lone_models_keep_their_pose() {
    let robot = described(&format!(
        "<model name='m'><pose>0 0 3 1.1 0.2 0.3</pose><link name='base'><pose>0 0 0 0.5 0 0</pose>{MASS}</link>
         <link name='arm'><gravity>false</gravity>{MASS}</link>
         <joint name='j' type='fixed'><parent>base</parent><child>arm</child></joint></model>"
    ));
    assert_eq!(robot.compensations[0].link, 1);
    let options = Options { root: Root::Floating, ..Options::default() };
    let text = model_text(&robot, &Pose::default(), options).expect("a model");
    let found = position(&text, "base", "0.5");
    // Half of the mass has no weight.
    is_near(&Vector3::new(found.x, found.y, 0.0), [0.0; 3]);
    assert!((found.z - (3.0 - 0.5 * 4.9 * 0.25)).abs() < 1e-9, "{found:?}");
}

const WORLD: &str = "<world name='hall'><gravity>0 0 -5</gravity><physics><max_step_size>0.004</max_step_size></physics>
    <model name='floor'><static>true</static><link name='link'><collision name='c'><geometry><plane/></geometry>
     <surface><friction><ode><mu>0.8</mu></ode></friction><contact><collide_bitmask>0x02</collide_bitmask></contact></surface></collision></link></model>
    <model name='cart'><pose>0 0 1 0 0 0</pose><link name='wheel'>MASS<collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry>
     </collision></link><link name='body'><gravity>0</gravity>MASS<collision name='c'><geometry><box><size>1 1 1</size></box></geometry>
     <surface><friction><ode><mu>0.3</mu></ode></friction></surface></collision>
     <visual name='v'><geometry><box><size>1 1 1</size></box></geometry><material><diffuse>1 0 0</diffuse></material></visual></link>
     <joint name='j' type='prismatic'><parent>body</parent><child>wheel</child><axis/></joint></model>
    <model name='stone'><pose>5 0 9 0 0 0</pose><link name='link'>MASS</link></model></world>";

#[test]
fn worlds_have_free_and_static_models_that_touch() {
    let robot = described(&WORLD.replace("MASS", MASS));
    assert!(robot.is_root_the_world() && robot.links[0].name == "world");
    let link = |name: &str| robot.links.iter().position(|link| link.name == name).expect("there");
    let into = |name: &str| robot.joints.iter().find(|joint| joint.child == link(name)).expect("carried");
    assert_eq!(into("floor::link").freedom, Freedom::Fixed);
    assert_eq!(
        (into("cart::body").freedom, into("cart::wheel").parent),
        (Freedom::Floating, link("cart::body"))
    );
    // Links are sorted by their joints, and what refers to them is, too.
    assert_eq!(robot.compensations[0].link, link("cart::body"));
    let text = model(&robot, &[], &[]);
    // The lower coefficient of friction counts.
    for words in ["friction = 0.3", "friction = 0.8", "step = 0.004", "colour = \"#ff0000\""] {
        assert!(text.contains(words), "{words}: {text}");
    }
    assert_eq!(text.matches("kind = \"box\"").count(), 1, "a shape that is drawn and touches is one: {text}");
    is_near(&position(&text, "stone__link", "0.1"), [5.0, 0.0, 9.0 - 0.5 * 5.0 * 0.01]);
    let blind = WORLD.replace("MASS", MASS).replace("0x02", "0");
    assert!(!model(&described(&blind), &[], &[]).contains("[contacts."), "bitmasks exclude contacts");
    // Joints of a static model do nothing, and may have the name of a link.
    let arm = "<static>1</static><link name='link'/><link name='arm'/><joint name='arm' type='revolute'><parent>link</parent><child>arm</child>
        <axis/></joint>";
    let still = described(
        &WORLD
            .replace("MASS", MASS)
            .replace("<static>true</static>", arm)
            .replace("<model name='floor'>", "<model name='old'>"),
    );
    assert!(
        still.obstacles.len() == 1 && still.obstacles[0].contains("same name, `old::link`"),
        "{:?}",
        still.obstacles
    );
    let robot = described(
        &WORLD
            .replace("MASS", MASS)
            .replace("<static>true</static>", &arm.replace("<link name='link'/>", "")),
    );
    assert!(
        robot.unsupported.is_empty() && robot.joints.iter().all(|joint| !joint.name.ends_with("arm_joint"))
    );
    // Links of a model touch each other only by `self_collide`, and not if a joint connects them.
    let joint = "<joint name='j' type='prismatic'><parent>body</parent><child>wheel</child><axis/></joint>";
    for (collide, removed, wanted) in
        [("false", joint, false), ("true", "none", false), ("true", joint, true)]
    {
        let wheel = format!("<link name='wheel'><self_collide>{collide}</self_collide>");
        let world = WORLD.replace("MASS", MASS).replace("<link name='wheel'>", &wheel).replace(removed, "");
        let text = model(&described(&world), &[], &[]);
        let touches = |entry: &str| entry.contains("cart__wheel") && entry.contains("cart__body");
        let found = text
            .split("\n[contacts.")
            .skip(1)
            .any(|entry| touches(entry.split("\n[").next().unwrap_or(entry)));
        assert_eq!(found, wanted, "{collide} {removed}: {text}");
    }
}

#[test]
fn fixed_and_ball_joints_close_loops() {
    let of = |kind: &str| {
        format!(
            "<model name='m'><link name='a'>{MASS}</link><link name='b'>{MASS}</link>
             <joint name='i' type='ball'><parent>world</parent><child>a</child></joint>
             <joint name='k' type='ball'><parent>a</parent><child>b</child><pose>0.3 0 0 0 0 0</pose></joint>
             <joint name='l' type='{kind}'><parent>world</parent><child>b</child><pose>0 0 0.2 0 0 0</pose><axis/></joint></model>"
        )
    };
    let robot = described(&of("ball"));
    assert_eq!((robot.closures[0].links, robot.closures[0].locks_rotation), ([0, 2], false));
    is_near(&robot.closures[0].anchor, [0.0, 0.0, 0.2]);
    assert!(
        model(&robot, &[], &[]).contains("[joints.l]\nkind = \"spherical\"\nbase = \"ground\"\ntip = \"b\"")
    );
    assert!(described(&of("fixed")).closures[0].locks_rotation);
    // A joint that leads back to its own ancestor closes a loop, too.
    let ring = described(
        "<model name='m'><link name='a'/><link name='b'/><joint name='i' type='ball'><parent>a</parent><child>b</child></joint>
         <joint name='k' type='ball'><parent>b</parent><child>a</child><pose>1 0 0 0 0 0</pose></joint></model>",
    );
    assert!(!ring.is_root_the_world() && ring.links[0].name == "a");
    assert_eq!((ring.joints.len(), ring.closures[0].links), (1, [1, 0]));
    let found = rejected(&of("revolute"));
    assert!(found.contains("the revolute joint <joint> `l` (line 4), whose child is also"), "{found}");
}

#[test]
fn models_are_included_from_folders_beside_the_description() {
    let folder = Folder::new("sdf-included");
    for name in ["scene", "arm"] {
        std::fs::create_dir_all(folder.path().join(name)).unwrap();
    }
    folder.write(
        "arm/model.sdf",
        "<sdf version='1.7'><model name='any'><pose>9 9 9 0 0 0</pose>\n<link name='base'/><frame name='top'><pose>0 0 2 0 0 0</pose></frame></model></sdf>",
    );
    let include = "<include><uri>model://arm</uri><name>left</name><pose>1 0 0 0 0 0</pose><placement_frame>top</placement_frame></include>";
    folder.write(
        "scene/world.sdf",
        &format!(
            "<sdf version='1.9'><world name='w'>{include}<include><uri>../arm</uri></include></world></sdf>"
        ),
    );
    let path = folder.path().join("scene/world.sdf");
    let robot = from_file(&path).expect("a robot");
    let names: Vec<&str> = robot.links.iter().map(|link| link.name.as_str()).collect();
    assert_eq!(names, ["world", "left::base", "any::base"]);
    is_near(&robot.joints[0].origin.position, [1.0, 0.0, -2.0]);
    is_near(&robot.joints[1].origin.position, [9.0, 9.0, 9.0]);
    assert_eq!(robot.links[1].source, "line 2 of model://arm");
    // The links of merged models are those of the model around them.
    let merged = "<sdf version='1.9'><model name='m'><include merge='true'><uri>model://arm</uri><pose>0 0 1 0 0 0</pose></include>
        <joint name='j' type='fixed'><parent>world</parent><child>base</child></joint></model></sdf>";
    folder.write("scene/world.sdf", merged);
    let robot = from_file(&path).expect("a robot");
    assert_eq!(robot.links[1].name, "base");
    is_near(&robot.joints[0].origin.position, [0.0, 0.0, 1.0]);
    for (uri, words) in [
        ("model://leg", "line 1: <include>: the model `model://leg` is not there"),
        ("world.sdf", "20 files include each other"),
    ] {
        folder.write(
            "scene/world.sdf",
            &format!("<sdf version='1.9'><model name='m'><include><uri>{uri}</uri></include></model></sdf>"),
        );
        let found = from_file(&path).unwrap_err().message;
        assert!(found.contains(words), "{found}");
    }
}

#[test]
fn trees_of_included_models_have_a_limit() {
    let folder = Folder::new("sdf-tree");
    for level in 0..12 {
        let include =
            |number: usize| format!("<include><name>n{number}</name><uri>../b{}</uri></include>", level + 1);
        let inner: String =
            if level < 11 { (0..8).map(include).collect() } else { "<link name='x'/>".to_owned() };
        std::fs::create_dir_all(folder.path().join(format!("b{level}"))).unwrap();
        folder.write(
            &format!("b{level}/model.sdf"),
            &format!("<sdf version='1.9'><model name='c'>{inner}</model></sdf>"),
        );
    }
    let found = from_file(&folder.path().join("b0/model.sdf")).unwrap_err().message;
    assert!(found.contains("included models have more than 500000 elements"), "{found}");
}

#[test]
fn faults_and_what_is_not_supported_are_named() {
    let model = |inside: &str| format!("<model name='m'>{inside}</model>");
    let arm = |joint: &str| {
        model(&format!(
            "<link name='a'/><link name='b'/><joint name='j' {joint}<parent>a</parent><child>b</child></joint>"
        ))
    };
    for (text, words) in [
        (model(""), "has no link"),
        (model("<link name='a'/><link name='a'/>"), "<link> `a`: another element has the same name"),
        (model("<link name='a'><pose relative_to='g'/></link>"), "there is no frame `g`"),
        (
            model(
                "<link name='a'><pose relative_to='b'/></link><link name='b'><pose relative_to='a'/></link>",
            ),
            "relative to itself",
        ),
        (
            model(
                "<link name='a'/><frame name='f' attached_to='g'/><frame name='g' attached_to='f'/><joint name='j' type='fixed'><parent>f</parent><child>a</child></joint>",
            ),
            "attached to itself",
        ),
        (model("<link name='a'><pose>0 0 0</pose></link>"), "it must be x y z roll pitch yaw"),
        (model("<link name='a'><inertial auto='true'/></link>"), "inertia from shapes"),
        (model("<link name='a'><inertial><mass>-1</mass></inertial></link>"), "mass is negative"),
        (
            model(
                "<link name='a'><inertial><fluid_added_mass><xx>1</xx></fluid_added_mass></inertial></link>",
            ),
            "added mass",
        ),
        (
            model("<link name='a'><inertial><pose relative_to='b'/></inertial></link>"),
            "its pose cannot be relative to `b`",
        ),
        (
            model(
                "<link name='a'><collision name='c'><geometry><sphere><radius>-1</radius></sphere></geometry></collision></link>",
            ),
            "`radius` must be positive",
        ),
        (
            model(
                "<link name='a'/><joint name='j' type='fixed'><parent>a</parent><child>world</child></joint>",
            ),
            "its child is the world",
        ),
        (
            model("<link name='a'/><joint name='j' type='fixed'><parent>a</parent><child>c</child></joint>"),
            "there is no frame `c`",
        ),
        (arm("type='hinge'><axis/>"), "its type `hinge` is unknown"),
        (arm("type='revolute'><axis><xyz>0 0 0</xyz></axis>"), "no direction"),
        (
            arm("type='revolute'><axis><limit><lower>2</lower><upper>1</upper></limit></axis>"),
            "is above the upper",
        ),
        (arm("type='screw'><axis/>"), "it needs a <screw_thread_pitch>"),
        (arm("type='revolute'><axis><mimic joint='z'/></axis>"), "there is no joint `z`"),
        (arm("type='gearbox'><axis/>"), "the gearbox <joint> `j` (line 1): the model would move otherwise"),
        (
            arm("type='revolute'><axis/><physics><ode><max_force>1</max_force></ode></physics>"),
            "the motor by `max_force`",
        ),
        (
            model("<link name='a'><velocity_decay><linear>1</linear></velocity_decay></link>"),
            "<velocity_decay> (line 1)",
        ),
        (model("<link name='a'><kinematic>true</kinematic></link>"), "<kinematic>"),
        (model("<enable_wind>true</enable_wind><link name='a'/>"), "<enable_wind>"),
        (model("<link name='a'/><plugin name='p' filename='libBuoyancyPlugin.so'/>"), "<plugin> `p`"),
        (
            "<world name='w'><model name='m'><link name='a'/></model><state world_name='w'/></world>"
                .to_owned(),
            "<state>",
        ),
        (
            "<world name='w'><model name='m'><link name='a'/></model></world><model name='n'/>".to_owned(),
            "<model> `n` (line 1)",
        ),
        (
            model("<link name='a'/><link name='b'/><link name='c'/><joint name='j' type='fixed'><parent>a</parent><child>b</child></joint>
                <joint name='j' type='fixed'><parent>a</parent><child>c</child></joint>"),
            "<joint> `j`: another element has the same name",
        ),
        ("<world name='w'/><world name='v'/>".to_owned(), "several worlds"),
        (
            "<world name='w'><include><uri>model://a</uri></include></world>".to_owned(),
            "is not read from a text",
        ),
    ] {
        let found = rejected(&text);
        assert!(found.contains(words), "{text}\n{found}");
    }
}

/// Comments with two hyphens, a declaration behind one, axes that are z, friction without a limit, and shapes that only draw.
#[test]
fn what_other_programs_read_is_read() {
    let text = format!(
        "<!-- ran with --verbose -- ä\n --><?xml version='1.0'?><sdf version='1.9'><model name='m'><link name='a'>{MASS}\
         <visual name='v'><geometry><sphere><radius>-1</radius></sphere></geometry></visual>\
         <collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry>\
         <surface><friction><ode><mu>-1</mu></ode></friction></surface></collision></link>\
         <joint name='j' type='revolute'><parent>world</parent><child>a</child></joint></model></sdf>"
    );
    let robot = from_description(&text).unwrap();
    is_near(&joint(&robot, "j").axis, [0.0, 0.0, 1.0]);
    assert!(robot.left_out.iter().any(|own| own.contains("must be positive")), "{:?}", robot.left_out);
    let text = "<robot name='r'><link name='a'><visual><geometry><mesh filename='a.obj' scale='.5'/></geometry></visual>\
        <visual><geometry><box size='1 two 3'/></geometry></visual></link></robot>";
    let robot = from_description(text).unwrap();
    let VisualShape::Mesh { scale, .. } = &robot.links[0].visuals[0].shape else { panic!("{robot:?}") };
    is_near(scale, [0.5; 3]);
    assert!(robot.obstacles.is_empty() && robot.left_out.len() == 1, "{:?}", robot.left_out);
}

#[test]
fn omissions_are_listed_in_the_model() {
    for version in ["1", "2.0", "new"] {
        let found = from_description(&format!("<sdf version='{version}'/>")).unwrap_err().message;
        assert!(found.contains("is unknown: 1.4 to 1.12"), "{found}");
    }
    let robot = described(
        "<model name='m'><link name='a'><kinematic>1</kinematic><sensor name='s' type='camera'/><collision name='c'><geometry><box/></geometry><mesh_properties/></collision></link><plugin name='p' filename='x'/></model>",
    );
    let options = Options { unsupported: Unsupported::LeftOut, root: Root::Floating, ..Options::default() };
    let text = model_text(&robot, &Pose::default(), options).expect("a model");
    for words in [
        "# Omitted: <plugin> `p` (line 1), with its forces and commands.",
        "# Omitted: properties of 1 surfaces other than",
        "elements: 1 <sensor>",
        "<kinematic> (line 1)",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
}
