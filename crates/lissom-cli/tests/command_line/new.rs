//! `lissom new`, `parts`, `import`, `completions` and `man`: what they write can be used.

use std::fs;

use lissom::core::motion::Vector3;

use crate::support::{Folder, lissom, summary};

#[test]
fn a_new_model_runs_as_it_is() {
    let folder = Folder::new("new");
    let made = lissom(&["new", "press"], folder.path());
    assert_eq!((made.code, made.errors.as_str()), (0, ""));
    assert!(made.output.contains("lissom view press.toml --open"), "{}", made.output);
    // The first line names a schema for editors, which is there.
    let text = fs::read_to_string(folder.path().join("press.toml")).unwrap();
    let schema = text.lines().next().unwrap().strip_prefix("#:schema ./").unwrap();
    let schema = fs::read_to_string(folder.path().join(schema)).unwrap();
    assert_eq!(schema, lissom(&["schema"], folder.path()).output);
    let check = lissom(&["check", "press.toml"], folder.path());
    assert_eq!((check.code, check.errors.as_str()), (0, ""), "{}", check.output);
    let run = lissom(&["run", "press.toml", "--no-plots", "--quiet"], folder.path());
    assert_eq!((run.code, run.errors.as_str()), (0, ""));
    let facts = summary(&folder.path().join("out/press"));
    assert_eq!((facts["title"].as_str(), facts["stopped"].as_str()), (Some("press"), Some("end")));
    // The slider goes to and fro by twice the radius of the crank.
    let table = fs::read_to_string(folder.path().join("out/press/history.csv")).unwrap();
    let record = lissom::Record::from_csv(&table).unwrap();
    let x = record.column("slider", "x").unwrap();
    let ends =
        x.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(*x), high.max(*x)]);
    assert!((ends[1] - ends[0] - 0.2).abs() < 1e-3, "{ends:?}");
    let across = ["y", "z"].map(|letter| record.column("slider", letter).unwrap());
    assert!(across.iter().all(|values| values.iter().all(|value| value.abs() < 1e-9)));
    assert!(Vector3::new(ends[0], 0.0, 0.0).norm() > 0.2);
    // It starts in equilibrium: while the motor is slow the rod hangs through as at the start.
    let sag = record.column("bending", "u3").unwrap();
    assert!(
        sag[0] < -1e-5 && sag[..5].iter().all(|value| (value - sag[0]).abs() < 0.05 * sag[0].abs()),
        "{:?}",
        &sag[..5]
    );
}

#[test]
fn ready_made_parts_are_listed_and_copied_once() {
    let folder = Folder::new("parts");
    let list = lissom(&["parts"], folder.path());
    assert!(list.code == 0 && list.output.starts_with("  speed-drive           motor"), "{}", list.output);
    let printed = lissom(&["parts", "belt-drive"], folder.path());
    assert!(printed.code == 0 && printed.output.starts_with("# A belt between two pulleys"));
    let copy = ["parts", "belt-drive", "--out", "belt.toml"];
    assert_eq!(lissom(&copy, folder.path()).code, 0);
    assert_eq!(fs::read_to_string(folder.path().join("belt.toml")).unwrap(), printed.output);
    let again = lissom(&copy, folder.path());
    assert!(again.code == 2 && again.errors.contains("is not overwritten"), "{}", again.errors);
    let unknown = lissom(&["parts", "belt-driv"], folder.path());
    assert!(unknown.code == 2 && unknown.errors.contains("did you mean `belt-drive`?"), "{}", unknown.errors);
}

/// The last value of a column of a template that runs to `end` [s] without a warning.
fn template(folder: &Folder, name: &str, end: &str, columns: &[&str]) -> Vec<f64> {
    let made = lissom(&["new", name, "--template", name], folder.path());
    assert_eq!((made.code, made.errors.as_str()), (0, ""), "{name}");
    let (file, end) = (format!("{name}.toml"), format!("analysis.end={end}"));
    let run = lissom(&["run", &file, "--no-plots", "--quiet", "--set", &end], folder.path());
    assert_eq!((run.code, run.errors.as_str()), (0, ""), "{name}");
    let folder = folder.path().join("out").join(name);
    let facts = summary(&folder);
    assert_eq!((facts["warnings"].as_array().map(Vec::len), facts["title"].as_str()), (Some(0), Some(name)));
    let record = lissom::Record::from_csv(&fs::read_to_string(folder.join("history.csv")).unwrap()).unwrap();
    let last = |name: &&str| {
        let (output, component) = name.rsplit_once('.').unwrap();
        *record.column(output, component).unwrap().last().unwrap()
    };
    columns.iter().map(last).collect()
}

/// Each machine does in its first second what it is made for.
#[test]
fn templates_run_as_they_are() {
    let folder = Folder::new("templates");
    let near = |found: f64, wanted: f64, part: f64| {
        assert!((found - wanted).abs() < part * wanted.abs(), "{found} for {wanted}");
    };
    // 300 N m on two wheels of 0.31 m push a car of about 1400 kg.
    let car = template(&folder, "vehicle", "0.8", &["velocity.v1", "car.z", "front_left.f3"]);
    near(car[0], 12.0 + 0.8 * 300.0 / 0.31 / 1430.0, 0.005);
    near(car[1], 0.55, 0.02);
    near(car[2], 3394.0, 0.1);
    let robot = template(&folder, "robot", "3", &["base.angle", "shoulder.angle", "elbow.angle"]);
    near(robot[0], 1.2, 1e-3);
    near(robot[1], 0.9, 1e-3);
    near(robot[2], -1.4, 1e-3);
    // The weight of crane and load, 2000 + 250 + 9000 kg and the tubes.
    let crane = template(&folder, "crane", "1", &["foot.f3", "rope.force"]);
    let tubes = 7850.0 * std::f64::consts::PI * ((0.36 - 0.588 * 0.588) * 30.0 + (0.16 - 0.39 * 0.39) * 25.0);
    near(crane[0], 9.81 * (11_250.0 + tubes), 1e-3);
    near(crane[1], 9.81 * 2000.0, 1e-3);
    let rotor = template(&folder, "rotor", "0.2", &["left.f3", "right.f3"]);
    let shaft = 7850.0 * std::f64::consts::PI * 0.015 * 0.015 * 0.8;
    near(rotor[0] + rotor[1], 9.81 * (8.0 + shaft), 0.05);
    let wing = template(&folder, "wing", "0.9", &["air.f3", "tip.u3", "at_75_percent.alpha"]);
    near(wing[0], 0.5 * 1.225 * 22.0 * 22.0 * 0.4 * 6.0 * 2.0 * std::f64::consts::PI * 0.05, 0.1);
    assert!(wing[1] > 0.1 && wing[2] > 0.03 && wing[2] < 0.06, "{wing:?}");
    // Power and thrust of an actuator disc with an induction of 0.27, less losses; all of the wind's power goes to the generator.
    let columns =
        ["blade1", "blade2", "blade3"].map(|blade| [format!("{blade}.air.f1"), format!("{blade}.air.power")]);
    let columns: Vec<&str> =
        columns.iter().flatten().map(String::as_str).chain(["generator.power"]).collect();
    let turbine = template(&folder, "turbine", "6", &columns);
    let disc = 0.5 * 1.225 * std::f64::consts::PI * 21.0 * 21.0 * 81.0;
    near(turbine[0] + turbine[2] + turbine[4], disc * 4.0 * 0.27 * 0.73, 0.02);
    near(turbine[1] + turbine[3] + turbine[5], disc * 9.0 * 0.48, 0.05);
    near(-turbine[6], disc * 9.0 * 0.48, 0.05);
    let refused = lissom(&["new", "x", "--template", "submarine"], folder.path());
    assert!(refused.code == 2 && refused.errors.contains("slider-crank"), "{}", refused.errors);
}

#[test]
fn an_imported_robot_runs_as_it_is() {
    let folder = Folder::new("import");
    folder.write("arm.urdf", include_str!("../../../lissom/tests/machines/robots/two_links.urdf"));
    let made = lissom(&["import", "arm.urdf", "--position", "elbow=0.5"], folder.path());
    assert_eq!((made.code, made.errors.as_str()), (0, ""));
    assert!(made.output.contains("2 moving joints"), "{}", made.output);
    let run =
        lissom(&["run", "arm.toml", "--no-plots", "--quiet", "--set", "analysis.end=0.05"], folder.path());
    assert_eq!((run.code, run.errors.as_str()), (0, ""));
    let table = fs::read_to_string(folder.path().join("out/arm/history.csv")).unwrap();
    let record = lissom::Record::from_csv(&table).unwrap();
    assert!((record.column("elbow", "angle").unwrap()[0] - 0.5).abs() < 1e-12);
    let again = lissom(&["import", "arm.urdf"], folder.path());
    assert_eq!(again.code, 2);
    assert!(again.errors.contains("already exists"), "{}", again.errors);
    let wrong = lissom(&["import", "arm.urdf", "--out", "b.toml", "--position", "knee=1"], folder.path());
    assert_eq!(wrong.code, 2);
    assert!(wrong.errors.contains("no moving joint `knee`"), "{}", wrong.errors);
    assert!(!folder.path().join("b.toml").exists());
}

/// A folder is a table: what opens, what is left out, and why others do not.
#[test]
fn a_folder_of_descriptions_is_a_table() {
    let folder = Folder::new("import-folder");
    let robots = folder.path().join("robots");
    fs::create_dir(&robots).unwrap();
    let write = |name: &str, text: &str| fs::write(robots.join(name), text).unwrap();
    write("arm.urdf", include_str!("../../../lissom/tests/machines/robots/two_links.urdf"));
    write("empty.urdf", "<robot name='none'/>");
    write("readme.txt", "no description");
    let site = "<mujoco><worldbody><body name='a'><joint name='j'/><geom size='0.1'/><geom type='box' size='1' contype='0' conaffinity='0' mass='0'/></body></worldbody>\
        <actuator><motor name='push' joint='j'/></actuator><sensor><accelerometer site='nowhere'/></sensor></mujoco>";
    write("site.xml", site);
    let shown = lissom(&["import", "robots"], folder.path());
    let rows: Vec<&str> = shown.output.lines().collect();
    assert_eq!((shown.code, rows.len()), (2, 4), "{}", shown.output);
    assert!(rows[0].starts_with("arm.urdf    opens: 3 links"), "{}", rows[0]);
    assert!(rows[1].contains("not: it has no <link>"), "{}", rows[1]);
    assert!(rows[2].contains("the site `nowhere`, which is not there"), "{}", rows[2]);
    assert!(rows[2].contains("a shape that is not drawn"), "{}", rows[2]);
    assert_eq!(rows[3], "2 of 3 descriptions open");
    let written = lissom(&["import", "robots", "--motors", "--out", "models"], folder.path());
    assert_eq!(written.code, 2);
    let model = fs::read_to_string(folder.path().join("models/site.toml")).unwrap();
    assert!(model.contains("push = 0\n") && model.contains("[loads.push]"), "{model}");
    let again = lissom(&["import", "robots", "--out", "models"], folder.path());
    assert!(again.output.contains("not written: `models/arm.toml` already exists"), "{}", again.output);
}

/// Frames of tools and elements of simulators do not stand in the way, and a thing without joints is free.
#[test]
fn robots_of_the_world_their_tools_and_things_are_imported() {
    let folder = Folder::new("import-things");
    let inertia = "<inertia ixx='0.1' iyy='0.1' izz='0.1'/>";
    let massive =
        |name: &str| format!("<link name='{name}'><inertial><mass value='2'/>{inertia}</inertial></link>");
    let joint = |kind: &str, name: &str, [parent, child]: [&str; 2]| {
        format!(
            "<joint name='{name}' type='{kind}'><parent link='{parent}'/><child link='{child}'/><axis xyz='0 1 0'/></joint>"
        )
    };
    let arm = [
        "<robot name='arm'><link name='world'/><link name='tool'/>".to_owned(),
        massive("base") + &massive("upper"),
        joint("fixed", "foot", ["world", "base"]) + &joint("continuous", "hip", ["base", "upper"]),
        joint("continuous", "wrist", ["upper", "tool"]),
        "<gazebo reference='upper'><mu1>0.2</mu1></gazebo><transmission name='t'/></robot>".to_owned(),
    ];
    for (name, text, words) in [
        ("arm", arm.concat(), &["1 moving joints", "which are fixed: `wrist`", "1 <gazebo>"][..]),
        (
            "held",
            arm.concat()
                .replace("<link name='world'/>", "")
                .replace(&joint("fixed", "foot", ["world", "base"]), ""),
            &["`base` is fixed to the ground; --floating"],
        ),
        ("cup", format!("<robot name='cup'>{}</robot>", massive("cup")), &["`cup` is a free body"]),
    ] {
        folder.write(&format!("{name}.urdf"), &text);
        let made = lissom(&["import", &format!("{name}.urdf")], folder.path());
        assert_eq!((made.code, made.errors.as_str()), (0, ""), "{name}");
        for words in words {
            assert!(made.output.contains(words), "{words}: {}", made.output);
        }
        let run = lissom(
            &["run", &format!("{name}.toml"), "--no-plots", "--quiet", "--set", "analysis.end=0.05"],
            folder.path(),
        );
        assert_eq!(run.code, 0, "{name}: {}", run.errors);
    }
}

/// The description of MuJoCo, by the same command: what is omitted is reported, what acts and is unknown is rejected.
#[test]
fn an_imported_robot_of_mujoco_runs_as_it_is() {
    let folder = Folder::new("import-mjcf");
    let robot = "<mujoco model='cart'><option gravity='0 0 -9.81'/><worldbody><light pos='0 0 3'/>
        <body name='cart'><joint name='rail' type='slide' axis='1 0 0' damping='0.5'/><geom type='box' size='0.2 0.1 0.1'/>
         <body name='pole'><joint name='hinge' axis='0 1 0' ref='0'/><geom type='capsule' size='0.02' fromto='0 0 0 0 0 0.6'/></body>
        </body></worldbody>TENDON<actuator><motor joint='rail'/></actuator></mujoco>";
    folder.write("cart.xml", &robot.replace("TENDON", ""));
    let made = lissom(&["import", "cart.xml", "--position", "hinge=0.1"], folder.path());
    assert_eq!((made.code, made.errors.as_str()), (0, ""));
    for words in ["3 links, 2 moving joints", "omitted: the command of 1 motor", "--motors", "1 <light>"] {
        assert!(made.output.contains(words), "{}", made.output);
    }
    let run =
        lissom(&["run", "cart.toml", "--no-plots", "--quiet", "--set", "analysis.end=0.05"], folder.path());
    assert_eq!((run.code, run.errors.as_str()), (0, ""));
    let table = fs::read_to_string(folder.path().join("out/cart/history.csv")).unwrap();
    let record = lissom::Record::from_csv(&table).unwrap();
    assert!((record.column("hinge", "angle").unwrap()[0] - 0.1).abs() < 1e-12);
    assert!(*record.column("hinge", "angle").unwrap().last().unwrap() > 0.1, "it falls");
    folder
        .write("held.xml", &robot.replace("TENDON", "<tendon><spatial name='rope' stiffness='3'/></tendon>"));
    let refused = lissom(&["import", "held.xml"], folder.path());
    assert_eq!(refused.code, 2);
    assert!(
        refused.errors.contains("the tendon `rope`") && refused.errors.contains("--without unsupported"),
        "{}",
        refused.errors
    );
    let reported = lissom(&["import", "held.xml", "--without", "unsupported"], folder.path());
    assert_eq!(reported.code, 0, "{}", reported.errors);
    assert!(reported.output.contains("omitted: the tendon `rope`"), "{}", reported.output);
}

/// A model as URDF, and the model that comes back of it.
#[test]
fn a_model_goes_to_urdf_and_back() {
    let folder = Folder::new("export-urdf");
    folder.write("arm.urdf", include_str!("../../../lissom/tests/machines/robots/two_links.urdf"));
    assert_eq!(lissom(&["import", "arm.urdf", "--position", "elbow=0.5"], folder.path()).code, 0);
    let made = lissom(&["export", "arm.toml", "--format", "urdf", "--out", "again.urdf"], folder.path());
    assert_eq!((made.code, made.errors.as_str()), (0, ""));
    for words in [
        "again.urdf",
        "omitted: 3 outputs",
        "omitted: stiffness and losses of the stops",
        "--position elbow=0.5",
    ] {
        assert!(made.output.contains(words), "{}", made.output);
    }
    let back = lissom(&["import", "again.urdf", "--position", "elbow=0.5"], folder.path());
    assert_eq!(back.code, 0, "{}", back.errors);
    let tables = ["arm", "again"].map(|name| {
        let file = format!("{name}.toml");
        let run =
            lissom(&["run", &file, "--no-plots", "--quiet", "--set", "analysis.end=0.05"], folder.path());
        assert_eq!(run.code, 0, "{}", run.errors);
        let table = fs::read_to_string(folder.path().join(format!("out/{name}/history.csv"))).unwrap();
        lissom::Record::from_csv(&table).unwrap()
    });
    for joint in ["shoulder", "elbow"] {
        let [here, there] =
            tables.each_ref().map(|table| *table.column(joint, "angle").unwrap().last().unwrap());
        assert!((here - there).abs() < 1e-11, "{joint}: {here} {there}");
    }
    let text = fs::read_to_string(folder.path().join("arm.toml")).unwrap();
    folder.write(
        "spring.toml",
        &format!("{text}\n[springs.s]\nkind = \"torsional\"\njoint = \"elbow\"\nstiffness = 1\n"),
    );
    let refused = lissom(&["export", "spring.toml", "--format", "urdf"], folder.path());
    assert_eq!(refused.code, 2);
    assert!(
        refused.errors.contains("the spring `s`") && !folder.path().join("spring.urdf").exists(),
        "{}",
        refused.errors
    );
    let reported =
        lissom(&["export", "spring.toml", "--format", "urdf", "--without", "unsupported"], folder.path());
    assert!(reported.code == 0 && reported.output.contains("omitted: the spring `s`"), "{}", reported.output);
}

#[test]
fn what_is_there_is_not_overwritten() {
    let folder = Folder::new("new-there");
    folder.write("press.toml", "mine");
    let made = lissom(&["new", "press.toml"], folder.path());
    assert_eq!(made.code, 2);
    assert!(made.errors.contains("already exists"), "{}", made.errors);
    assert_eq!(fs::read_to_string(folder.path().join("press.toml")).unwrap(), "mine");
    assert_eq!(lissom(&["new", "a\"b"], folder.path()).code, 0);
    assert_eq!(lissom(&["check", "a\"b.toml"], folder.path()).code, 0);
    assert_eq!(lissom(&["new", "nowhere/press"], folder.path()).code, 3);
}

#[test]
fn shells_and_the_manual_know_all_commands() {
    let folder = Folder::new("completions");
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let made = lissom(&["completions", shell], folder.path());
        assert_eq!(made.code, 0, "{}", made.errors);
        for command in ["run", "view", "live", "study", "completions"] {
            assert!(made.output.contains(command), "{shell}: {command}");
        }
    }
    assert_eq!(lissom(&["completions", "cmd"], folder.path()).code, 2);
    let page = lissom(&["man"], folder.path());
    assert!(
        page.code == 0 && page.output.contains(".TH lissom 1") && page.output.contains("lissom\\-view"),
        "{}",
        page.output
    );
    let page = lissom(&["man", "view"], folder.path());
    assert!(page.code == 0 && page.output.contains("\\-\\-html"), "{}", page.output);
    assert_eq!(lissom(&["man", "nothing"], folder.path()).code, 2);
}
