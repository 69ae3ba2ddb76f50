//! What real robot files contain: included files, limits that exclude zero, attributes without effect; and obstacles, all in one
//! message with the line of the source.

use lissom::exchange::import::{
    Freedom, ImportError, Motors, Options, Pose, Robot, chosen_starts, from_description, from_file,
    model_text, omissions,
};

use crate::support::folder::Folder;

fn refused(robot: &Robot) -> ImportError {
    model_text(robot, &Pose::default(), Options::default()).unwrap_err()
}

#[test]
fn included_files_take_the_place_of_their_element() {
    let folder = Folder::new("included");
    std::fs::create_dir_all(folder.path().join("common")).unwrap();
    folder.write(
        "walker.xml",
        "<mujoco><include file='./common/settings.xml'/>\n<worldbody>\n<body name='trunk'><freejoint/><geom size='0.2'/>\n\
         <include file='common/leg.xml'/></body></worldbody></mujoco>",
    );
    folder.write(
        "common/settings.xml",
        "<mujocoinclude>\n<compiler angle='radian'/><include file='defaults.xml'/></mujocoinclude>",
    );
    folder.write(
        "common/defaults.xml",
        "<mujoco><default><joint damping='2' axis='0 1 0'/></default></mujoco>",
    );
    let leg = "<mujocoinclude>\n<body name='leg' pos='0 0 -0.3'>\n<joint name='hip' range='-1 2'/><geom size='0.1'/></body></mujocoinclude>";
    folder.write("common/leg.xml", leg);
    let path = folder.path().join("walker.xml");
    let robot = from_file(&path).expect("a robot");
    let hip = robot.joints.iter().find(|joint| joint.name == "hip").expect("there");
    assert_eq!((hip.damping, hip.axis.y, hip.range), (2.0, 1.0, Some([-1.0, 2.0])));
    assert_eq!((hip.parent, hip.source.as_str()), (1, "line 3 of common/leg.xml"));
    assert_eq!(
        robot.links[1].source, "line 3",
        "behind an included file the lines are those of the robot's own"
    );
    model_text(&robot, &Pose::default(), Options::default()).expect("a model");

    folder.write("common/leg.xml", &leg.replace("axis", "axes").replace("range", "rnge"));
    let found = refused(&from_file(&path).expect("a robot")).message;
    assert!(found.contains("line 3 of common/leg.xml: <joint> `hip`: the attribute `rnge`"), "{found}");
    for (text, words) in [
        (
            "<mujocoinclude>\n<include file='leg.xml'/></mujocoinclude>",
            "line 2 of common/leg.xml: <include>: the file `leg.xml` is included twice",
        ),
        ("<mujocoinclude><include file='none.xml'/></mujocoinclude>", "`none.xml` is not there"),
        ("<mujocoinclude>", "common/leg.xml: this is no XML"),
        (
            "<mujocoinclude><include file='a.xml'><include file='b.xml'/></include></mujocoinclude>",
            "line 1 of common/leg.xml: <include>: it has content, which would be lost",
        ),
    ] {
        folder.write("common/leg.xml", text);
        let found = from_file(&path).unwrap_err().message;
        assert!(found.contains(words), "{found}");
    }
}

#[test]
fn nesting_beyond_what_readers_bear_is_refused() {
    let nested = |depth: usize| {
        let begin = "<body><joint/><inertial mass='1' pos='0 0 0' diaginertia='1 1 1'/>\n".repeat(depth);
        format!("<mujoco><worldbody>{begin}{}</worldbody></mujoco>", "</body>".repeat(depth))
    };
    let found = from_description(&nested(20_000)).unwrap_err().message;
    assert!(
        found.contains("line 299: more than 300 elements contain each other one in the other"),
        "{found}"
    );
    assert_eq!(from_description(&nested(60)).expect("a robot").joints.len(), 60);

    let folder = Folder::new("nested-includes");
    folder.write("robot.xml", "<mujoco><include file='0.xml'/></mujoco>");
    for file in 0..600 {
        folder.write(&format!("{file}.xml"), &format!("<mujoco><include file='{}.xml'/></mujoco>", file + 1));
    }
    let found = from_file(&folder.path().join("robot.xml")).unwrap_err().message;
    assert!(found.contains("files include each other one in the other"), "{found}");
}

/// The title of a model is one line.
#[test]
fn names_with_ends_of_lines_are_titles_of_one_line() {
    let robot = from_description(&GRIPPER.replace("name='r'", "name='two&#10;lines'")).expect("a robot");
    let text = model_text(&robot, &Pose::default(), Options::default()).expect("a model");
    assert!(text.contains("title = \"two lines\""), "{text}");
}

const GRIPPER: &str = "<robot name='r'><link name='base'/>
    <link name='a'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial></link>
    <link name='b'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial></link>
    <link name='c'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial></link>
    <joint name='elbow' type='revolute'><parent link='base'/><child link='a'/><limit lower='-3' upper='-0.07' effort='1' velocity='2'/></joint>
    <joint name='grip' type='prismatic'><parent link='base'/><child link='b'/><limit lower='0' upper='0.04' effort='1' velocity='2'/></joint>
    <joint name='other' type='prismatic'><parent link='base'/><child link='c'/><limit lower='-0.03' upper='-0.01' effort='1' velocity='2'/>
    <mimic joint='grip' multiplier='-1'/></joint></robot>";

#[test]
fn joints_whose_limits_exclude_zero_start_at_the_nearest_position() {
    let robot = from_description(GRIPPER).expect("a robot");
    let of = |pose: &Pose, options| -> Vec<(String, f64)> {
        chosen_starts(&robot, pose, options).into_iter().map(|own| (own.joint, own.value)).collect()
    };
    let chosen = of(&Pose::default(), Options::default());
    assert_eq!(chosen, [("elbow".to_owned(), -0.07), ("grip".to_owned(), 0.01)]);
    let text = model_text(&robot, &Pose::default(), Options::default()).expect("a model");
    for words in
        ["angle = -0.07", "displacement = 0.01", "displacement = -0.01", "# joint `elbow` starts at -0.07"]
    {
        assert!(text.contains(words), "{words}: {text}");
    }
    assert_eq!(of(&Pose::default(), Options { limits: false, ..Options::default() }), []);
    let given = Pose { values: [("elbow".to_owned(), -1.0)].into(), ..Pose::default() };
    assert_eq!(of(&given, Options::default()), [("grip".to_owned(), 0.01)]);
    // Given positions are not moved; all that are beyond limits are named.
    let given =
        Pose { values: [("elbow".to_owned(), 0.5), ("grip".to_owned(), 0.04)].into(), ..Pose::default() };
    let found = model_text(&robot, &given, Options::default()).unwrap_err().message;
    for words in [
        "2 obstacles",
        "line 5: joint `elbow` starts at 0.5, outside of its limits -3 … -0.07",
        "line 7: joint `other` starts at -0.04",
    ] {
        assert!(found.contains(words), "{found}");
    }
    let robot = from_description(&GRIPPER.replace("upper='0.04'", "upper='0.005'")).expect("a robot");
    let found = refused(&robot).message;
    assert!(
        found.contains("joint `grip`: no position is within its limits and those of the joints"),
        "{found}"
    );
    let robot =
        from_description(&GRIPPER.replace("mimic joint='grip'", "mimic joint='other'")).expect("a robot");
    assert!(refused(&robot).message.contains("joint `other` mimics itself"));
}

#[test]
fn all_obstacles_are_in_one_message() {
    let robot = from_description(
        "<mujoco>
         <option density='1.2'/>
         <worldbody><body name='a'>
         <joint name='j' dampng='1'/><geom size='0.1'/>
         <body name='b'><joint/><geom type='mesh' mesh='m'/></body></body>
         <body name='c'><joint/><inertial pos='0 0 0' mass='1' diaginertia='0 0 0'/></body></worldbody>
         <tendon><spatial name='t' stiffness='3'/></tendon></mujoco>",
    )
    .expect("a robot");
    let found = refused(&robot).message;
    for words in
        ["4 obstacles", "line 4: <joint> `j`", "line 5: <geom>", "(line 2)", "the tendon `t` (line 7)"]
    {
        assert!(found.contains(words), "{words}: {found}");
    }
    // Masses are checked in descriptions without faults.
    let robot = from_description(
        "<robot name='r'><link name='base'/>
         <link name='arm'><inertial><mass value='1'/><inertia ixx='0' iyy='0' izz='0'/></inertial></link>
         <link name='tip'><inertial><mass value='2'/><inertia ixx='0' iyy='0' izz='0'/></inertial></link>
         <link name='tool'><inertial><mass value='3'/><inertia ixx='0' iyy='0' izz='0'/></inertial></link>
         <joint name='a' type='continuous'><parent link='base'/><child link='arm'/></joint>
         <joint name='b' type='continuous'><parent link='arm'/><child link='tip'/></joint>
         <joint name='c' type='continuous'><parent link='arm'/><child link='tool'/></joint></robot>",
    )
    .expect("a robot");
    let found = refused(&robot).message;
    for words in
        ["3 obstacles", "line 2: link `arm` has the mass 1.0 kg", "line 3: link `tip`", "line 4: link `tool`"]
    {
        assert!(found.contains(words), "{words}: {found}");
    }
}

#[test]
fn what_has_no_effect_is_ignored() {
    let robot = from_description(
        "<mujoco><compiler angle='radian'/><default><joint limited='true'/></default><compiler settotalmass='3'/>
         <worldbody><body><joint type='free'/><geom size='0.1' mass='1'/>
         <body><joint axis='0 1 0' range='-1 1'/><geom size='0.05' mass='0.2'/></body></body></worldbody></mujoco>",
    )
    .expect("a robot");
    assert_eq!((robot.joints[0].freedom, robot.joints[0].range), (Freedom::Floating, None));
    assert_eq!(robot.joints[1].range, Some([-1.0, 1.0]));
    // The total mass of the description.
    let masses: Vec<f64> = robot.links.iter().filter_map(|link| link.inertia).map(|own| own.mass).collect();
    assert!((masses[0] - 2.5).abs() < 1e-14 && (masses[1] - 0.5).abs() < 1e-14, "{masses:?}");
    let inertia = robot.links[1].inertia.expect("a mass").inertia;
    assert!((inertia[(0, 0)] - 0.4 * 2.5 * 0.01).abs() < 1e-15);
    model_text(&robot, &Pose::default(), Options::default()).expect("a model");

    let robot = from_description(
        "<robot name='r'><link name='base'/><link name='arm'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial>
         </link><link name='tool'/><joint name='j' type='continuous'><parent link='base'/><child link='arm'/></joint>
         <joint name='f' type='fixed'><parent link='arm'/><child link='tool'/><dynamics damping='100'/></joint></robot>",
    )
    .expect("a robot");
    let text = model_text(&robot, &Pose::default(), Options::default()).expect("a model");
    assert!(text.contains("# Omitted: damping and friction of the fixed joint `f` (line 3)"), "{text}");
}

/// Torques are those of the inputs within the limits, and without them the robot is as before.
#[test]
fn motors_have_inputs_and_limits() {
    let urdf = "<robot name='r'><link name='base'/><link name='arm'><inertial><origin xyz='0.5 0 0'/><mass value='2'/>\
                <inertia ixx='0.1' iyy='0.1' izz='0.1' ixy='0' ixz='0' iyz='0'/></inertial></link>\
                <joint name='left-hip' type='continuous'><parent link='base'/><child link='arm'/><axis xyz='0 0 1'/>\
                <limit effort='3' velocity='5'/></joint></robot>";
    let mjcf = "<mujoco><option gravity='0 0 0'/><worldbody><body name='arm'><joint name='left-hip' axis='0 0 1'/>\
                <geom type='sphere' size='0.1' pos='0.5 0 0' mass='2'/></body></worldbody>\
                <actuator><motor joint='left-hip' gear='10' ctrlrange='-0.3 0.3'/><intvelocity joint='left-hip' kp='3'/></actuator></mujoco>";
    for (text, inertia) in [(urdf, 0.6), (mjcf, 0.508)] {
        let robot = from_description(text).expect("a robot");
        let plain = model_text(&robot, &Pose::default(), Options::default()).unwrap();
        assert!(!plain.contains("motor\"") && !plain.contains("[inputs]"), "{plain}");
        let options = Options { motors: Motors::Written, ..Options::default() };
        let driven = model_text(&robot, &Pose::default(), options).unwrap();
        for (input, torque) in [(0.1, if inertia == 0.6 { 0.1 } else { 1.0 }), (9.0, 3.0)] {
            let set = [("inputs.left_hip_motor", input.to_string()), ("analysis.end", "0.1".to_owned())];
            let set: Vec<(&str, &str)> = set.iter().map(|(path, value)| (*path, value.as_str())).collect();
            let record = crate::support::runs::run(&driven, &set);
            let rate = crate::support::runs::last(&record, "left_hip", "rate");
            assert!((rate - 0.1 * torque / inertia).abs() < 1e-6, "{input}: {rate}");
        }
    }
    let robot = from_description(mjcf).unwrap();
    let omitted = omissions(&robot, Options::default());
    assert!(omitted.iter().any(|what| what.contains("`--motors`")), "{omitted:?}");
    assert!(robot.left_out.iter().any(|what| what.contains("intvelocity")), "{:?}", robot.left_out);
}

/// Servos pull with the formulas of the format: force limits act before the gear, an input is a target or a rate.
#[test]
fn servos_have_the_forces_of_their_formulas() {
    let (inertia, options) = (0.5_f64, Options { motors: Motors::Written, ..Options::default() });
    // The start, the last angle and the last rate after `end`, by an actuator with an input on a hinge.
    let moved = |actuator: &str, start: f64, input: f64, end: f64| {
        let text = format!(
            "<mujoco><compiler angle='radian'/><default><general gear='2'/><position kp='8'/></default><option gravity='0 0 0'/><worldbody><body name='arm'>\
             <joint name='hip' axis='0 0 1' range='-1 3' limited='true'/><inertial mass='1' pos='0 0 0' diaginertia='1 1 {inertia}'/>\
             </body></worldbody><actuator>{actuator}</actuator></mujoco>"
        );
        let robot = from_description(&text).expect("a robot");
        let pose = Pose { values: [("hip".to_owned(), start)].into(), ..Pose::default() };
        let text = model_text(&robot, &pose, options).unwrap();
        let (input, end) = (input.to_string(), end.to_string());
        let set = [("inputs.hip_motor", &*input), ("analysis.end", &*end)];
        let record = crate::support::runs::run(&text, &set);
        [
            crate::support::runs::last(&record, "hip", "angle"),
            crate::support::runs::last(&record, "hip", "rate"),
        ]
    };
    let near = |found: f64, wanted: f64, what: &str| {
        assert!((found - wanted).abs() < 1e-6, "{what}: {found} for {wanted}");
    };
    // g² kp (u/g - q) turns the hinge as a cosine about u/g, with the rate √(g² kp / J).
    let rate = (4.0 * 8.0 / inertia).sqrt();
    let [angle, _] = moved("<position joint='hip'/>", 0.1, 0.5, 0.3);
    near(angle, 0.25 + (0.1 - 0.25) * (rate * 0.3_f64).cos(), "a position servo");
    // The rate approaches u/g exponentially: J ω' = g kv (u - g ω).
    let [_, found] = moved("<velocity joint='hip' kv='3' gear='0.5'/>", 0.0, 0.4, 0.3);
    near(found, 0.8 * (1.0 - (-0.25 * 3.0 / inertia * 0.3_f64).exp()), "a velocity servo");
    // At its limits a servo pulls with a constant force, times the gear.
    let [_, found] = moved("<position joint='hip' kp='1e5' forcerange='-3 3'/>", 0.0, 2.0, 0.05);
    near(found, 2.0 * 3.0 / inertia * 0.05, "a limited servo");
    let general = "<general joint='hip' gear='1' gaintype='affine' gainprm='2 3 0' biastype='affine' biasprm='0.5 0 -1'/>";
    let [angle, found] = moved(general, 0.0, 0.1, 1e-3);
    near(found, (0.2 + 0.5) * (1.0 - (-1e-3 / inertia).exp()), "gain and bias");
    assert!(angle > 0.0);
    // A spring and damper alone, with a gear: J q'' = g (-4 g q - g q') from 0.1.
    let alone = "<general joint='hip' gear='3' gainprm='0' biastype='affine' biasprm='0 -4 -1'/>";
    let [_, found] = moved(alone, 0.1, 7.0, 1e-4);
    near(found, -9.0 * 4.0 * 0.1 / inertia * 1e-4, "a bias without a gain");
    // The range of the joint limits the target.
    let [_, found] = moved("<position joint='hip' kp='8' gear='1' inheritrange='0.5'/>", 0.0, 100.0, 1e-3);
    near(found, 8.0 * 2.0 / inertia * 1e-3, "an inherited range");
}

/// A servo that is omitted also pulls without a command; at a key frame inputs have its controls.
#[test]
fn servos_are_reported_and_start_at_the_controls_of_key_frames() {
    let text = "<mujoco><worldbody><body name='arm'><joint name='hip'/><inertial mass='1' pos='1 0 0' diaginertia='1 1 1'/></body></worldbody>\
                <actuator><muscle joint='hip'/><position joint='hip' kp='3'/></actuator>\
                <keyframe><key name='home' qpos='0.2' ctrl='7 0.2'/></keyframe></mujoco>";
    let mut robot = from_description(text).expect("a robot");
    let omitted = omissions(&robot, Options::default());
    assert!(omitted.iter().any(|what| what.contains("without a command, of 1 of them")), "{omitted:?}");
    assert!(robot.left_out.iter().any(|what| what.contains("muscle")), "{:?}", robot.left_out);
    robot.start_at("home").expect("a key frame");
    let options = Options { motors: Motors::Written, ..Options::default() };
    let text = model_text(&robot, &Pose::default(), options).unwrap();
    assert!(text.contains("hip_motor = 0.2\n"), "{text}");
}

/// Limits of a joint hold for the sum of its motors and may differ in both directions, as in MuJoCo 4.0, whose figures these are.
#[test]
fn motors_of_one_joint_share_its_limits() {
    let text = "<mujoco><option gravity='0 0 0'/><worldbody><body name='arm'><joint name='hip' actuatorfrcrange='-1 3'/>\
                <inertial mass='1' pos='0 0 0' diaginertia='1 1 0.5'/></body></worldbody>\
                <actuator><motor joint='hip'/><motor joint='hip' gear='2'/></actuator></mujoco>";
    let robot = from_description(text).expect("a robot");
    let options = Options { motors: Motors::Written, ..Options::default() };
    let text = model_text(&robot, &Pose::default(), options).unwrap();
    for (one, other, torque) in [("5", "-1", 3.0), ("-5", "-1", -1.0), ("0.5", "0.25", 1.0)] {
        let set = [("inputs.hip_motor", one), ("inputs.hip_motor_", other), ("analysis.end", "0.1")];
        let record = crate::support::runs::run(&text, &set);
        let rate = crate::support::runs::last(&record, "hip", "rate");
        assert!((rate - 0.1 * torque / 0.5).abs() < 1e-6, "{one}, {other}: {rate}");
    }
}

/// Actuators that options disable exert no force and keep their place among the controls of key frames.
#[test]
fn disabled_actuators_are_omitted() {
    for (option, count) in [
        ("<option actuatorgroupdisable='0 3'/>", 1),
        ("<option><flag actuation='disable'/></option>", 0),
        ("<option/>", 3),
    ] {
        let text = format!(
            "<mujoco>{option}<worldbody><body name='arm'><joint name='hip'/><inertial mass='1' pos='1 0 0' diaginertia='1 1 1'/>\
             </body></worldbody><actuator><motor joint='hip'/><position joint='hip' kp='3' group='3'/><motor joint='hip' group='2'/>\
             </actuator><keyframe><key name='home' ctrl='1 2 3'/></keyframe></mujoco>"
        );
        let mut robot = from_description(&text).expect("a robot");
        assert_eq!(robot.motors.len(), count, "{option}");
        let is_reported =
            robot.left_out.iter().any(|what| what.contains("actuators that the options disable"));
        assert_eq!(is_reported, count < 3, "{:?}", robot.left_out);
        robot.start_at("home").expect("a key frame");
        assert!(robot.motors.last().is_none_or(|motor| motor.start == 3.0), "{:?}", robot.motors);
    }
}

/// Limits with two equal ends, as exporters write that know none, hold nothing: the joint moves freely, which is reported.
#[test]
fn limits_with_equal_ends_are_reported() {
    let text = "<robot name='r'><link name='base'/><link name='arm'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial></link>\
                <joint name='hip' type='revolute'><parent link='base'/><child link='arm'/><limit lower='0' upper='0'/></joint></robot>";
    let robot = from_description(text).expect("a robot");
    let text = model_text(&robot, &Pose::default(), Options::default()).unwrap();
    assert!(text.contains("two equal ends") && text.contains("`hip`"), "{text}");
    assert!(!text.contains("stop_stiffness") && !text.contains("Stiffness of stops"), "{text}");
}

/// Files of Drake: `world` is the ground without a link, prefixes are not declared, shapes may have no extension; joints that the format
/// does not have are named.
#[test]
fn descriptions_of_other_programs_are_read() {
    let text = "<robot name='r'><link name='arm'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial>\
                <visual><geometry><sphere radius='0'/></geometry></visual></link>\
                <joint name='hip' type='continuous'><parent link='world'/><child link='arm'/><axis xyz='0 1 0'/></joint>\
                FOREIGN</robot>";
    let folder = Folder::new("foreign");
    let path = folder.path().join("arm.urdf");
    let read = |foreign: &str| {
        std::fs::write(&path, text.replace("FOREIGN", foreign)).unwrap();
        from_file(&path)
    };
    let robot = read("").expect("a robot");
    assert!(robot.links[0].name == "world" && !robot.may_float());
    assert!(robot.links[1].visuals.is_empty());
    assert!(model_text(&robot, &Pose::default(), Options::default()).is_ok());
    let robot =
        read("<drake:joint name='ball' type='ball'><parent link='arm'/><child link='tip'/></drake:joint>")
            .expect("a robot");
    assert_eq!(robot.joints.len(), 1);
    let error = model_text(&robot, &Pose::default(), Options::default()).unwrap_err().to_string();
    assert!(error.contains("<drake:joint>"), "{error}");
    // Prefixes are declared at the root, whatever stands before it; a name of one program for all elements changes nothing.
    for (from, to) in
        [("<robot ", "<!-- <a> --><robot "), ("<robot ", "<robot xmlns='http://drake.mit.edu' ")]
    {
        std::fs::write(&path, text.replace("FOREIGN", "<drake:note/>").replace(from, to)).unwrap();
        assert_eq!(from_file(&path).expect("a robot").joints.len(), 1, "{to}");
    }
    let empty = from_description("<robot name='r'><link name='a'/></robot>").expect("a robot");
    let error = model_text(&empty, &Pose::default(), Options::default()).unwrap_err().to_string();
    assert!(error.contains("no link of the description has mass"), "{error}");
}

/// Outputs of joints, contacts, the energy and sensors have different names, whatever those of the description are.
#[test]
fn outputs_have_names_of_their_own() {
    let text = "<mujoco><worldbody><geom type='plane' size='1 1 1'/><body name='a' pos='0 0 1'><joint name='touching' type='slide' axis='0 0 1'/>\
                <geom size='0.1'/><body name='b' pos='1 0 0'><joint name='energy'/><geom size='0.1' pos='0.3 0 0'/></body></body></worldbody>\
                <sensor><jointpos name='touching_' joint='energy'/></sensor></mujoco>";
    let robot = from_description(text).expect("a robot");
    let text = model_text(&robot, &Pose::default(), Options::default()).unwrap();
    for kind in ["relative", "contact_force", "energy", "expression"] {
        assert!(text.contains(&format!("kind = \"{kind}\"")), "{kind}: {text}");
    }
    crate::support::runs::run(&text, &[("analysis.end", "0.01")]);
}
