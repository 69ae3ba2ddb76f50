//! Scenes in MJCF: generated elements, masses of meshes, contacts of geoms, tendons that act, compensated weights.

use std::fmt::Write;

use lissom::exchange::import::{
    LinkInertia, Motors, Options, Pose, Robot, Unsupported, from_description, from_file, model_text,
    omissions,
};
use lissom_motion::{Matrix3, Vector3};

use crate::support::folder::Folder;
use crate::support::runs::{column, last, run};

fn described(text: &str) -> Robot {
    from_description(text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn scene(world: &str) -> Robot {
    described(&format!("<mujoco><worldbody>{world}</worldbody></mujoco>"))
}

fn model(robot: &Robot) -> String {
    model_text(robot, &Pose::default(), Options::default()).unwrap_or_else(|error| panic!("{error}"))
}

fn refused(text: &str) -> String {
    let robot = match from_description(text) {
        Ok(robot) => robot,
        Err(error) => return error.message,
    };
    model_text(&robot, &Pose::default(), Options::default()).unwrap_err().message
}

fn position_of(body: &str) -> String {
    format!("\n[outputs.at]\nkind = \"position\"\nof = \"{body}\"\n")
}

/// The example of MuJoCo's reference: names have the suffix of the inner element first, and positions follow each other.
#[test]
fn copies_follow_each_other() {
    let robot = scene(
        "<replicate count='2' offset='0 1 0' euler='90 0 0'><replicate count='2' sep='-' offset='1 0 0' euler='0 90 0'>
         <body name='Alice'><freejoint/><geom size='.1'/></body></replicate></replicate>",
    );
    let half = std::f64::consts::FRAC_PI_2;
    for (name, position, axis, angle) in [
        ("Alice-00", [0.0, 0.0, 0.0], [1.0, 0.0, 0.0], 0.0),
        ("Alice-10", [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], half),
        ("Alice-01", [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], half),
    ] {
        let link = robot.links.iter().position(|link| link.name == name).expect("a copy");
        let origin = robot.joints.iter().find(|joint| joint.child == link).expect("its joint").origin;
        assert!((origin.position - Vector3::from(position)).norm() < 1e-14, "{name}: {:?}", origin.position);
        let turn = origin.rotation.logarithm() - angle * Vector3::from(axis);
        assert!(turn.norm() < 1e-14, "{name}: {turn:?}");
    }
    // Indices have as many digits as the number of copies; a rotation turns later offsets.
    let ring = scene(
        "<replicate count='12' euler='0 0 30'><body name='b' pos='2 0 0'><freejoint/><geom size='.1'/></body></replicate>",
    );
    let third = ring.links.iter().position(|link| link.name == "b03").expect("a copy");
    let origin = ring.joints.iter().find(|joint| joint.child == third).expect("its joint").origin;
    assert!((origin.position - Vector3::new(0.0, 2.0, 0.0)).norm() < 1e-14, "{:?}", origin.position);
}

/// What refers to copies is copied with them: motors, excluded pairs, tendons.
#[test]
fn references_to_copies_are_copied() {
    let robot = described(
        "<mujoco><worldbody><site name='hook' pos='0 0 1'/><replicate count='3' offset='1 0 0'>
         <body name='arm'><joint name='j' axis='0 1 0'/><geom size='.1' pos='.3 0 0'/><site name='s'/>
         <body name='hand' pos='.6 0 0'><joint name='k' axis='0 1 0'/><geom size='.1' pos='.3 0 0'/></body></body></replicate></worldbody>
         <contact><exclude body1='arm' body2='hand'/></contact>
         <tendon><spatial name='t' range='0 2'><site site='hook'/><site site='s'/></spatial></tendon>
         <actuator><motor joint='j'/></actuator></mujoco>",
    );
    assert_eq!((robot.motors.len(), robot.contacts.excluded.len(), robot.ropes.len()), (3, 3, 3));
    assert_eq!(robot.ropes[1].name, "t1");
    assert_eq!(robot.ropes[1].along[0].0, 0, "the site of the world is one for all");
    assert_ne!(robot.ropes[1].along[1].0, robot.ropes[2].along[1].0);
}

#[test]
fn attached_models_keep_their_own_settings() {
    let folder = Folder::new("attached");
    folder.write(
        "leg.xml",
        "<mujoco model='leg'><compiler angle='radian'/><default><joint damping='3'/></default><worldbody>
         <body name='thigh' pos='0 0 1'><joint name='hip' axis='0 1 0' range='-1 1'/><geom size='.1'/>
         <body name='shank' pos='0 0 -.5'><joint name='knee' axis='0 1 0'/><geom size='.1'/></body></body></worldbody>
         <contact><exclude body1='thigh' body2='shank'/></contact><actuator><motor joint='knee'/></actuator></mujoco>",
    );
    folder.write(
        "robot.xml",
        "<mujoco><asset><model file='leg.xml'/></asset><worldbody><body name='trunk'><freejoint/><geom size='.2'/>
         <frame pos='1 0 0' euler='0 0 90'><attach model='leg' body='thigh' prefix='left_'/></frame>
         <attach model='leg' body='thigh' prefix='right_'/></body></worldbody></mujoco>",
    );
    let robot = from_file(&folder.path().join("robot.xml")).expect("a robot");
    let hip = robot.joints.iter().find(|joint| joint.name == "left_hip").expect("there");
    assert_eq!((hip.range, hip.damping), (Some([-1.0, 1.0]), 3.0));
    assert!((hip.origin.position - Vector3::new(1.0, 0.0, 1.0)).norm() < 1e-14);
    assert_eq!((robot.motors.len(), robot.contacts.excluded.len()), (2, 2));
    model(&robot);
    // A part of the description itself.
    let own = scene(
        "<frame name='f'><body name='b'><freejoint/><geom size='.1'/></body></frame><frame pos='2 0 0'><attach frame='f' prefix='n_'/></frame>",
    );
    assert!(own.links.iter().any(|link| link.name == "n_b"));
    folder.write("leg.xml", "<mujoco><asset><model file='robot.xml'/></asset></mujoco>");
    let found = model_text(
        &from_file(&folder.path().join("robot.xml")).unwrap(),
        &Pose::default(),
        Options::default(),
    );
    assert!(found.unwrap_err().message.contains("models attach each other one in the other"));
}

#[test]
fn generated_elements_have_bounds() {
    let ball = "<body><freejoint/><geom size='.1'/></body>";
    let many = (0..4).fold(ball.to_owned(), |inner, _| format!("<replicate count='100'>{inner}</replicate>"));
    let world = |inner: &str| format!("<mujoco><worldbody>{inner}</worldbody></mujoco>");
    assert!(refused(&world(&many)).contains("generates more than 500000 elements"));
    for (inner, words) in [
        ("<replicate count='0'><body/></replicate>".to_owned(), "must be a positive integer"),
        ("<replicate><body/></replicate>".to_owned(), "it has no `count`"),
        ("<frame name='f'><attach frame='f' prefix='a'/></frame>".to_owned(), "attach themselves"),
        ("<attach model='m' body='b'/>".to_owned(), "there is no <model> `m`"),
        (
            format!("{}{}", "<body>".repeat(2800), "</body>".repeat(2800)),
            "more than 300 elements contain each other",
        ),
    ] {
        let found = refused(&world(&inner));
        assert!(found.contains(words), "{words}: {found}");
    }
}

/// Tetrahedron and cube in closed form, by all ways of the format.
#[test]
fn meshes_have_the_mass_of_their_solid() {
    let inertia = |asset: &str, geom: &str| -> LinkInertia {
        let text = format!(
            "<mujoco><asset>{asset}</asset><worldbody><body><joint/><geom type='mesh' {geom}/></body></worldbody></mujoco>"
        );
        described(&text).links[1].inertia.expect("a mass")
    };
    let near = |found: &Matrix3, wanted: &Matrix3| (found - wanted).amax() < 1e-12 * wanted.amax();
    // Of the tetrahedron on three axes: ∫x² = 1/60, ∫xy = 1/120 about the corner, V = 1/6, centre at 1/4.
    let corner = "vertex='0 0 0 1 0 0 0 1 0 0 0 1'";
    for way in ["convex", "exact", "legacy"] {
        let found = inertia(&format!("<mesh name='t' inertia='{way}' {corner}/>"), "mesh='t' density='6'");
        let (square, product) = (0.1 - 1.0 / 16.0, 0.05 - 1.0 / 16.0);
        let wanted = Matrix3::from_fn(|i, j| if i == j { 2.0 * square } else { -product });
        assert!((found.mass - 1.0).abs() < 1e-12 && near(&found.inertia, &wanted), "{way}: {found:?}");
        assert!((found.centre - Vector3::repeat(0.25)).norm() < 1e-12);
    }
    // A cube of the sides 0.2, 0.4, 0.6 in a file, turned and shifted.
    let folder = Folder::new("meshes");
    let corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];
    let faces = [[4, 3, 2, 1], [5, 6, 7, 8], [1, 2, 6, 5], [2, 3, 7, 6], [3, 4, 8, 7], [4, 1, 5, 8]];
    let mut obj = String::new();
    for [x, y, z] in corners {
        let _ = writeln!(obj, "v {x} {y} {z}");
    }
    for [a, b, c, d] in faces {
        let _ = writeln!(obj, "f {a} {b} {c} {d}");
    }
    folder.write("cube.obj", &obj);
    let mut stl = String::from("solid cube\n");
    for [a, b, c, d] in faces {
        for triangle in [[a, b, c], [a, c, d]] {
            stl += "facet normal 0 0 0\nouter loop\n";
            for corner in triangle {
                let [x, y, z] = corners[corner as usize - 1];
                let _ = writeln!(stl, "vertex {x} {y} {z}");
            }
            stl += "endloop\nendfacet\n";
        }
    }
    folder.write("box.stl", &stl);
    for (file, name) in [("cube.obj", "cube"), ("box.stl", "box")] {
        let text = format!(
            "<mujoco><asset><mesh file='{file}' scale='.2 .4 .6' refpos='.1 .2 .3' inertia='exact'/></asset><worldbody><body>
             <freejoint/><geom type='mesh' mesh='{name}' pos='1 0 0' euler='0 0 90' mass='3'/></body></worldbody></mujoco>"
        );
        folder.write("scene.xml", &text);
        let robot = from_file(&folder.path().join("scene.xml")).expect("a robot");
        let found = robot.links[1].inertia.expect("a mass");
        let wanted =
            Matrix3::from_diagonal(&Vector3::new(0.04 + 0.36, 0.16 + 0.36, 0.16 + 0.04)) * 3.0 / 12.0;
        assert!((found.mass - 3.0).abs() < 1e-12 && near(&found.inertia, &wanted), "{file}: {found:?}");
        assert!((found.centre - Vector3::x()).norm() < 1e-9);
        assert!(model(&robot).contains("kind = \"hull\""));
    }
    // A shell: 2/3 of six sides about each axis, for a cube of the side 2: J = m a²/6 · 5/3, a = 2.
    let shell = "vertex='-1 -1 -1 1 -1 -1 1 1 -1 -1 1 -1 -1 -1 1 1 -1 1 1 1 1 -1 1 1'";
    let found = inertia(&format!("<mesh name='s' inertia='shell' {shell}/>"), "mesh='s' mass='1'");
    assert!(near(&found.inertia, &(Matrix3::identity() * 10.0 / 9.0)), "{found:?}");

    folder.write("scene.xml", "<mujoco><asset><mesh file='none.stl'/></asset><worldbody><body><freejoint/><geom type='mesh' mesh='none'/></body></worldbody></mujoco>");
    let robot = from_file(&folder.path().join("scene.xml")).expect("a robot");
    let found = model_text(&robot, &Pose::default(), Options::default()).unwrap_err().message;
    assert!(found.contains("the file `none.stl` of the mesh is not there"), "{found}");
}

/// Solids that are dropped rest at the height of their geometry.
#[test]
fn dropped_solids_rest_on_a_plane() {
    for (geom, height) in [
        ("size='.1'", 0.1),
        ("type='box' size='.1 .2 .15'", 0.15),
        ("type='capsule' size='.1 .2' euler='0 90 0'", 0.1),
        ("type='cylinder' size='.1 .2'", 0.2),
        ("type='ellipsoid' size='.2 .2 .1'", 0.1),
    ] {
        let robot = scene(&format!(
            "<geom type='plane' size='1 1 1'/><body name='b' pos='0 0 {}'><freejoint/><geom {geom}/></body>",
            height + 0.05
        ));
        let record = run(&(model(&robot) + &position_of("b")), &[("analysis.end", "2")]);
        let z = last(&record, "at", "z");
        let crept = z - column(&record, "at", "z")[column(&record, "at", "z").len() / 2];
        assert!((z - height).abs() < 1e-3 && crept.abs() < 1e-5, "{geom}: {z}, {crept:e}");
    }
}

/// A box on a slope: g (sin α - μ cos α) with the larger of both coefficients, and sticking below the friction angle.
#[test]
fn a_box_slides_on_a_slope() {
    let angle = 30_f64.to_radians();
    for (friction, acceleration) in [(0.3, 9.81 * (angle.sin() - 0.3 * angle.cos())), (0.7, 0.0)] {
        let robot = scene(&format!(
            "<frame euler='0 30 0'><geom type='plane' size='1 1 1' friction='{friction}'/><body name='b' pos='0 0 .0998'><freejoint/>
             <geom type='box' size='.2 .2 .1' friction='.1'/></body></frame>"
        ));
        let text = model(&robot) + "\n[outputs.v]\nkind = \"velocity\"\nof = \"b\"\n";
        let record = run(&text, &[("analysis.end", "1")]);
        let along = column(&record, "v", "v1")
            .iter()
            .zip(column(&record, "v", "v3"))
            .map(|(x, z)| x * angle.cos() - z * angle.sin());
        let along: Vec<f64> = along.collect();
        let half = along.len() / 2;
        let found = (along[along.len() - 1] - along[half]) / 0.5;
        assert!((found - acceleration).abs() < 1e-3 * 9.81, "{friction}: {found} {acceleration}");
    }
}

/// What touches what: masks, neighbours, excluded bodies; in as few entries as possible.
#[test]
fn contacts_are_written_as_one_would() {
    let robot = |geom: &str, contact: &str| {
        described(&format!(
            "<mujoco><default><geom {geom}/></default><worldbody><geom type='plane' size='1 1 1'/>
             <body name='trunk' pos='0 0 1'><freejoint/><geom size='.1'/>
             <body name='arm' pos='.3 0 0'><joint axis='0 1 0'/><geom size='.1'/>
             <body name='hand' pos='.3 0 0'><joint axis='0 1 0'/><joint axis='1 0 0' pos='0 .05 0'/><geom size='.1' pos='.1 0 0'/></body></body></body>
             <body name='ball' pos='0 0 3'><freejoint/><geom size='.1'/></body></worldbody>{contact}</mujoco>"
        ))
    };
    let text = model(&robot("", ""));
    for words in [
        "base = \"ground\"\ntip = \"trunk\"\nothers = [\"arm\", \"hand\", \"ball\"]\nexcept = [[\"trunk\", \"arm\"], [\"arm\", \"hand\"]]",
        "friction = 1.0",
        "scheme = \"backward-euler\"",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    assert_eq!(text.matches("[contacts.").count(), 1);
    run(&text, &[("analysis.end", "0.05")]);
    // Bodies that touch the ground alone.
    let text = model(&robot("contype='1' conaffinity='0'", "").clone());
    assert!(!text.contains("[contacts."), "{text}");
    let floor = robot("conaffinity='2'", "");
    assert!(!model(&floor).contains("[contacts."));
    let text = model(&robot("", "<contact><exclude body1='ball' body2='hand'/></contact>"));
    assert!(text.contains("[\"hand\", \"ball\"]"), "{text}");
    // Without contacts it is said, and nothing is left of them.
    let options = Options { contacts: false, ..Options::default() };
    let free = robot("", "");
    let text = model_text(&free, &Pose::default(), options).expect("a model");
    assert!(!text.contains("[contacts.") && !text.contains("touches"), "{text}");
    assert!(omissions(&free, options).iter().any(|what| what.contains("bodies pass through each other")));
    assert!(!omissions(&free, Options::default()).iter().any(|what| what.contains("contacts")));
    // Pairs that are named touch in any case, by their own friction.
    let paired = described(
        "<mujoco><default><geom contype='0' conaffinity='0'/></default><worldbody><geom name='floor' type='plane' size='1 1 1'/>
         <body name='b' pos='0 0 .3'><freejoint/><geom name='g' size='.1'/></body><body name='c' pos='0 0 3'><freejoint/><geom size='.1'/></body>
         </worldbody><contact><pair geom1='floor' geom2='g' friction='.25'/></contact></mujoco>",
    );
    let text = model(&paired);
    assert!(
        text.contains("base = \"ground\"\ntip = \"b\"\nstiffness") && text.contains("friction = 0.25"),
        "{text}"
    );
    assert!(text.contains("touches = false"), "{text}");
}

/// Stiffness of the manual: at rest the penetration is g (1 - d) T² ζ², or g (1 - d)/s for the direct numbers.
#[test]
fn softness_yields_the_penetration_of_the_manual() {
    for (softness, depth) in [
        ("", 9.81 * 0.05 * 0.02_f64.powi(2)),
        ("solref='.03 .8' solimp='.8 .8 .001'", 9.81 * 0.2 * (0.03_f64 * 0.8).powi(2)),
        ("solref='-2000 -100' solimp='.9 .9 .001'", 9.81 * 0.1 / 2000.0),
    ] {
        let robot = scene(&format!(
            "<geom type='plane' size='1 1 1' {softness}/><body name='b' pos='0 0 .1'><freejoint/><geom size='.1' {softness}/></body>"
        ));
        let record = run(&(model(&robot) + &position_of("b")), &[("analysis.end", "3")]);
        let found = 0.1 - last(&record, "at", "z");
        assert!((found / depth - 1.0).abs() < 0.01, "{softness}: {found:e} {depth:e}");
    }
}

/// A weight on a rope hangs at its length; a tendon of two joints stops their sum; compensated bodies float.
#[test]
fn tendons_and_compensated_weights_act() {
    let hung = described(
        "<mujoco><worldbody><site name='hook' pos='0 0 2'/><body name='b' pos='0 0 1.9'><joint type='slide' axis='0 0 1' damping='50'/>
         <geom size='.1'/><site name='s'/></body></worldbody>
         <tendon><spatial range='0 1'><site site='hook'/><site site='s'/></spatial></tendon></mujoco>",
    );
    let record = run(&(model(&hung) + &position_of("b")), &[("analysis.end", "5")]);
    let z = last(&record, "at", "z");
    assert!((z - 1.0).abs() < 5e-3, "{z}");

    let sum = |tendon: &str| {
        described(&format!(
            "<mujoco><compiler angle='radian'/><option gravity='0 0 -9.81'/><worldbody>
             <body><joint name='a' axis='0 1 0' damping='2'/><geom size='.1' pos='.3 0 0' contype='0' conaffinity='0'/></body>
             <body pos='0 2 0'><joint name='b' axis='0 1 0' damping='2'/><geom size='.1' pos='.3 0 0' contype='0' conaffinity='0'/></body>
             </worldbody><tendon><fixed name='t' {tendon}><joint joint='a' coef='1'/><joint joint='b' coef='2'/></fixed></tendon></mujoco>"
        ))
    };
    let text = model(&sum("range='-9 1.2'"));
    let record =
        run(&text, &[("analysis.end", "20"), ("analysis.step", "5e-3"), ("analysis.scheme", "radau-iia")]);
    let [a, b] = ["a", "b"].map(|joint| last(&record, joint, "angle"));
    // At rest m g l cos a = F and m g l cos b = 2 F.
    assert!((a + 2.0 * b - 1.2).abs() < 2e-3 && (b.cos() - 2.0 * a.cos()).abs() < 1e-2, "{a} {b}");

    let floating = scene(
        "<body name='b' gravcomp='1'><freejoint/><geom type='box' size='.1 .2 .3' pos='.5 0 0'/></body>",
    );
    let record = run(&(model(&floating) + &position_of("b")), &[("analysis.end", "1")]);
    assert!(last(&record, "at", "z").abs() < 1e-9);
}

/// Damping of a ball joint: about a fixed axis a spin decays by exp(-c t/J).
#[test]
fn damped_balls_slow_down() {
    let robot = described(
        "<mujoco><option gravity='0 0 0'/><worldbody><body name='b'><joint type='ball' damping='.3'/>
         <inertial pos='0 0 0' mass='1' diaginertia='.2 .2 .2'/></body></worldbody></mujoco>",
    );
    let text = model(&robot).replace("[bodies.b]\n", "[bodies.b]\nangular_velocity = [0, 2, 0]\n")
        + "\n[outputs.w]\nkind = \"angular_velocity\"\nof = \"b\"\n";
    let record =
        run(&text, &[("analysis.scheme", "radau-iia"), ("analysis.step", "1e-3"), ("analysis.end", "1")]);
    let found = column(&record, "w", "w2").last().copied().unwrap_or_default();
    assert!((found - 2.0 * f64::exp(-1.5)).abs() < 1e-6, "{found}");
}

/// The model has the mass of the description, and lists no motors as omitted that it has.
#[test]
fn the_model_is_what_the_description_says() {
    let robot = described(
        "<mujoco><worldbody><replicate count='4' offset='1 0 0'><body name='a'><joint name='j' axis='0 1 0'/><geom size='.1' mass='2'/>
         <body pos='.5 0 0'><geom type='box' size='.1 .1 .1' mass='.5'/></body></body></replicate></worldbody>
         <actuator><motor joint='j'/></actuator></mujoco>",
    );
    let options = Options { motors: Motors::Written, ..Options::default() };
    let text = model_text(&robot, &Pose::default(), options).expect("a model");
    let masses = text.lines().filter_map(|line| line.strip_prefix("mass = ")?.parse::<f64>().ok());
    assert!((masses.sum::<f64>() - 10.0).abs() < 1e-12, "{text}");
    assert!(!text.contains("--motors") && text.matches("_motor = 0").count() == 4, "{text}");
    assert!(model(&robot).contains("the commands of 4 motors"));
    // Deformable parts are omitted on request, with what connects them.
    let soft = "<mujoco><worldbody><body name='b'><freejoint/><geom size='.1'/></body><flexcomp name='f'/></worldbody>
        <equality><weld body1='b' body2='f_0'/></equality></mujoco>";
    assert!(refused(soft).contains("<flexcomp> `f`") || refused(soft).contains("<flexcomp>"));
    let options = Options { unsupported: Unsupported::LeftOut, ..Options::default() };
    model_text(&described(soft), &Pose::default(), options).expect("a model");
}

/// A key frame has the coordinates of all joints in the order of the description: a free body, a ball joint about a point beside its
/// frame, a slide and a hinge.
#[test]
fn robots_start_at_key_frames() {
    let text = "<mujoco><compiler angle='radian'/><worldbody>
        <body name='box' pos='0 0 1'><freejoint/><geom size='.1'/></body>
        <body name='post'><joint name='lift' type='slide' axis='0 0 1'/><geom size='.1'/>
         <body name='bob' pos='1 0 0'><joint name='ball' type='ball' pos='-1 0 0'/><geom size='.1'/>
          <body name='flap' pos='0 0 1'><joint name='hinge' axis='0 1 0'/><geom size='.1' pos='.3 0 0'/></body></body></body>
        </worldbody><keyframe>
        <key name='up' qpos='1 2 3 0 0 0 1 0.25 0.7071067811865476 0 0 0.7071067811865476 0.4'/><key/><key qpos='1 2'/>
        </keyframe></mujoco>";
    let mut robot = described(text);
    let values = robot.start_at("up").expect("a key frame");
    let pose = Pose { values, ..Pose::default() };
    let options = Options { contacts: false, ..Options::default() };
    let written = model_text(&robot, &pose, options).expect("a model");
    let outputs: String =
        ["box", "bob", "flap"].map(|name| position_of(name).replace(".at]", &format!(".{name}]"))).concat();
    let results = run(&format!("{written}{outputs}"), &[("analysis.end", "0.01")]);
    let start = |name: &str| ["x", "y", "z"].map(|axis| column(&results, name, axis)[0]);
    // The ball turns the bob by a quarter about the vertical through the post, which is lifted.
    for (name, wanted) in [("box", [1.0, 2.0, 3.0]), ("bob", [0.0, 1.0, 0.25]), ("flap", [0.0, 1.0, 1.25])] {
        let found = start(name);
        assert!((0..3).all(|k| (found[k] - wanted[k]).abs() < 1e-9), "{name}: {found:?}");
    }
    assert!((column(&results, "hinge", "angle")[0] - 0.4).abs() < 1e-12);
    assert!(robot.start_at("key1").expect("the position of the description").is_empty());
    let fault = |name: &str| robot.clone().start_at(name).unwrap_err().message;
    assert!(fault("key2").contains("it has 2 coordinates, and the joints 13"), "{}", fault("key2"));
    assert!(fault("down").contains("up, key1, key2"), "{}", fault("down"));
}
