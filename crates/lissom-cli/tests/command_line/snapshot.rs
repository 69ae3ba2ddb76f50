//! `lissom snapshot` as its users see it: pictures that show what the table says, and refusals.

use std::fs;

use lissom::core::motion::Vector3;
use lissom::pictures::geometry::{Colour, Geometry, Role, poses_at};
use lissom::pictures::picture::{Paint, Projection, RecordedForces, View, painted};
use lissom::{Record, ResultFolder};

use crate::support::{CANTILEVER, Folder, example, lissom};

#[test]
fn a_strip_shows_instants_and_is_gone_after_another_run() {
    let folder = Folder::new("snapshot-strip");
    let model = example("tip-crank");
    let short = ["--set", "analysis.end=0.2", "-q"];
    let snapshot = lissom(&[&["snapshot", &model, "--strip", "3"][..], &short].concat(), folder.path());
    assert_eq!(snapshot.code, 0, "{}", snapshot.errors);
    let picture = folder.path().join("out/tip-crank/snapshot.svg");
    let svg = fs::read_to_string(&picture).unwrap();
    for words in ["Beam actuated by a tip crank", "t = 0 s", "t = 0.1 s", "t = 0.2 s", " mm<"] {
        assert!(svg.contains(words), "{words}");
    }
    assert!(svg.matches("<path").count() > 500 && svg.len() < 2_000_000, "{}", svg.len());
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
    let png =
        lissom(&["snapshot", "out/tip-crank", "--at", "0.05,0.15", "--out", "crank.PNG"], folder.path());
    assert_eq!((png.code, png.output.trim()), (0, "crank.PNG"), "{}", png.errors);
    assert!(fs::read(folder.path().join("crank.PNG")).unwrap().starts_with(b"\x89PNG"));
    let run = lissom(&[&["run", &model][..], &short].concat(), folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(!picture.exists(), "a picture of a former run would lie");
}

#[test]
fn point_masses_are_drawn_by_the_shapes_that_the_model_gives() {
    let folder = Folder::new("snapshot-point-mass");
    let extent = |drawn: &str| {
        let text = format!(
            "lissom = 1\n[point_masses.load]\nmass = 1\nposition = [3, 0, 0]\n{drawn}\n\
             [analysis]\nkind = \"dynamics\"\nend = 1\nstep = 0.1\n"
        );
        fs::write(folder.path().join("load.toml"), text).unwrap();
        let run = lissom(&["run", "load.toml", "-q"], folder.path());
        assert_eq!(run.code, 0, "{}", run.errors);
        let run = ResultFolder::recorded(&folder.path().join("out/load")).unwrap();
        let geometry = Geometry::new(&run.scene, &run.motion, true);
        let piece = geometry.pieces.iter().find(|piece| piece.role == Role::PointMass).unwrap();
        let high = piece.mesh.points.iter().fold(Vector3::repeat(f64::NEG_INFINITY), |high, at| high.sup(at));
        [0, 1, 2].map(|k| (1e4 * high[k]).round() / 1e4)
    };
    assert_eq!(extent("shape = { box = [0.2, 0.4, 0.6] }"), [0.1, 0.2, 0.3]);
    let [x, y, z] = extent("");
    assert!(x > 0.0 && x == y && y == z, "a ball");
}

#[test]
fn shapes_are_drawn_in_their_colours() {
    let folder = Folder::new("snapshot-colours");
    let text = "lissom = 1\n[ground]\nshape = { kind = \"plane\" }\n[bodies.cart]\nmass = 1\ninertia = { box = [1, 1, 1] }\n\
                shape = [{ box = [0.2, 0.4, 0.6], colour = \"#D1495b\" }, { box = [3, 0.1, 0.1] }, \
                { sphere = 0.1, position = [0, 0, 1], colour = \"#00ff07\" }]\n\
                [analysis]\nkind = \"dynamics\"\nend = 1\nstep = 0.1\n";
    fs::write(folder.path().join("cart.toml"), text).unwrap();
    let run = lissom(&["run", "cart.toml", "-q"], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    let run = ResultFolder::recorded(&folder.path().join("out/cart")).unwrap();
    let geometry = Geometry::new(&run.scene, &run.motion, true);
    let drawn = |colour: Colour| {
        let mut pieces = geometry.pieces.iter().filter(|piece| piece.colour == colour);
        let (piece, other) = (pieces.next().expect("a piece of this colour"), pieces.next());
        assert_eq!(other, None);
        let high = piece.mesh.points.iter().fold(Vector3::repeat(f64::NEG_INFINITY), |high, at| high.sup(at));
        (piece.name.as_str(), [0, 1, 2].map(|k| (1e4 * high[k]).round() / 1e4))
    };
    assert_eq!(drawn(Colour::Own([0xd1, 0x49, 0x5b])), ("cart", [0.1, 0.2, 0.3]));
    assert_eq!(drawn(Colour::Part(0)), ("cart", [1.5, 0.05, 0.05]));
    assert_eq!(drawn(Colour::Own([0, 0xff, 7])).1[2], 1.1);
    assert_eq!(drawn(Colour::Ground).0, "ground");
    let faces: usize = geometry.pieces.iter().map(|piece| piece.mesh.faces.len()).sum();
    let surfaces = run.scene.bodies[0].surface.iter().chain(&run.scene.point_masses[0].surface);
    assert_eq!(
        faces,
        surfaces.map(|surface| surface.triangles.len()).sum::<usize>(),
        "each face is drawn once"
    );
}

#[test]
fn recorded_forces_are_arrows_at_contacts_and_along_springs() {
    let folder = Folder::new("snapshot-forces");
    let recorded = |name: &str, set: &[&str]| {
        let run = lissom(&[&["run", &example(name), "-q", "--out", name][..], set].concat(), folder.path());
        assert_eq!(run.code, 0, "{}", run.errors);
        let run = ResultFolder::recorded(&folder.path().join(name)).unwrap();
        let forces = RecordedForces::of(&run.scene, &run.record);
        (run, forces)
    };
    // The force on a disc acts at its radius from the centre, in the plane of the floor.
    let (run, forces) = recorded("rolling-disc", &["--set", "analysis.end=1"]);
    for time in [0.0, 0.4, 1.0] {
        let poses = poses_at(&run.motion, time).unwrap();
        let [(at, force)] = forces.at(&poses, time)[..] else { panic!("one force at {time} s") };
        let centre = poses[run.scene.bodies[0].node].position;
        assert!(
            at.z.abs() < 1e-4 && ((at - centre).norm() - 0.2).abs() < 1e-4 && force.z > 0.0,
            "{at} {force}"
        );
    }
    let (run, forces) = recorded("crane-slack-cable", &[]);
    let at = |time: f64| forces.at(&poses_at(&run.motion, time).unwrap(), time);
    assert!(at(0.1).is_empty(), "slack");
    let tension = run.record.column("cable", "force").unwrap();
    let row = (0..tension.len()).max_by(|a, b| tension[*a].total_cmp(&tension[*b])).unwrap();
    let [(_, force)] = at(run.record.times[row])[..] else { panic!("one force") };
    assert!((force.z / tension[row] - 1.0).abs() < 1e-9 && forces.most() == tension[row], "{force}");
    let drawn = lissom(&["snapshot", "rolling-disc", "--forces", "--out", "disc.svg", "-q"], folder.path());
    assert_eq!(drawn.code, 0, "{}", drawn.errors);
    let text = fs::read_to_string(folder.path().join("disc.svg")).unwrap();
    assert!(text.contains("N per m of arrow") && text.contains("#d1495b"));
    let none = lissom(&["snapshot", &example("gearbox-backlash"), "--forces", "-q"], folder.path());
    assert!(none.code == 2 && none.errors.contains("no force is recorded"), "{}", none.errors);
}

/// A body that drives 90 m has symbols in proportion to itself, and its drag acts at its node.
#[test]
fn symbols_scale_with_the_model_and_local_loads_act_at_their_node() {
    let folder = Folder::new("snapshot-travel");
    let model = "lissom = 1\n[bodies.car]\nmass = 1000\ninertia = { box = [4, 1.6, 0.6] }\nvelocity = [30, 0, 0]\n\
                 [joints.car]\nkind = \"prismatic\"\nbase = \"ground\"\ntip = \"car\"\naxis = \"x\"\n\
                 [local_loads.drag]\non = \"car\"\nforce = [\"-0.1*v1\", 0, 0]\n\
                 [outputs.drag]\nkind = \"local_load\"\nof = \"drag\"\n\
                 [analysis]\nkind = \"dynamics\"\nend = 3\nstep = 0.1\n";
    fs::write(folder.path().join("car.toml"), model).unwrap();
    let run = lissom(&["run", "car.toml", "-q", "--out", "car"], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    let run = ResultFolder::recorded(&folder.path().join("car")).unwrap();
    let geometry = Geometry::new(&run.scene, &run.motion, true);
    assert!(geometry.extent() > 85.0 && (geometry.size - 1.5 * 4.35).abs() < 0.1, "{}", geometry.size);
    let body = geometry.pieces.iter().find(|piece| piece.role == Role::Body).unwrap();
    let reach = body.mesh.points.iter().fold(0.0, |most: f64, point| most.max(point.x));
    assert!((reach - 2.0).abs() < 1e-6, "the solid of the inertia: {reach}");
    let poses = poses_at(&run.motion, 3.0).unwrap();
    let forces = RecordedForces::of(&run.scene, &run.record);
    let [(at, force)] = forces.at(&poses, 3.0)[..] else { panic!("one force") };
    assert!((at.x - 90.0).abs() < 0.1 && (force.x + 3.0).abs() < 0.01, "{at} {force}");
}

#[test]
fn moving_pictures_hold_so_many_frames_of_one_size() {
    let folder = Folder::new("snapshot-moving");
    let model = example("pendulum");
    let moving = lissom(&["snapshot", &model, "--animate", "1.5", "-q"], folder.path());
    assert_eq!(moving.code, 0, "{}", moving.errors);
    let file = folder.path().join("out/pendulum/snapshot.png");
    let bytes = fs::read(&file).unwrap();
    assert!(bytes.starts_with(b"\x89PNG"));
    let count = |kind: &[u8]| bytes.windows(4).filter(|window| *window == kind).count();
    let at = bytes.windows(4).position(|window| window == b"acTL").unwrap();
    assert_eq!(bytes[at + 4..at + 8], [0, 0, 0, 30], "20 pictures in a second");
    assert_eq!((count(b"fcTL"), count(b"fdAT"), count(b"IEND")), (30, 29, 1));
    let moving =
        lissom(&["snapshot", "out/pendulum", "--animate", "1", "--out", "moving.gif", "-q"], folder.path());
    assert_eq!(moving.code, 0, "{}", moving.errors);
    let bytes = fs::read(folder.path().join("moving.gif")).unwrap();
    assert!(bytes.starts_with(b"GIF89a"));
    // Each frame has a control block, here with a delay of five hundredths of a second.
    let controls = bytes
        .windows(3)
        .zip(bytes[4..].iter())
        .filter(|(head, delay)| *head == [0x21, 0xf9, 4] && **delay == 5);
    assert_eq!(controls.count(), 20);
    for (options, message) in [
        (["--animate", "1", "--out", "moving.svg"], "must end in .png"),
        (["--strip", "2", "--out", "strip.gif"], "must end in .svg or .png"),
        (["--animate", "1000", "--out", "moving.png"], "must be from 0.1 to 30"),
    ] {
        let refused = lissom(&[&["snapshot", "out/pendulum"][..], &options].concat(), folder.path());
        assert!(refused.code == 2 && refused.errors.contains(message), "{}", refused.errors);
    }
}

#[test]
fn bodies_are_drawn_by_the_shapes_and_meshes_that_the_model_gives() {
    let folder = Folder::new("snapshot-shapes");
    let model = |drawn: &str| {
        format!(
            "lissom = 1\n[bodies.part]\nmass = 1\ninertia = [1, 1, 1]\ncenter_of_mass = [0, 0, 1]\n{drawn}\n\
             [analysis]\nkind = \"dynamics\"\nend = 1\nstep = 0.1\n"
        )
    };
    let scene = |drawn: &str| {
        fs::write(folder.path().join("part.toml"), model(drawn)).unwrap();
        let run = lissom(&["run", "part.toml", "-q"], folder.path());
        assert_eq!(run.code, 0, "{}", run.errors);
        ResultFolder::recorded(&folder.path().join("out/part")).unwrap()
    };
    let extent = |drawn: &str| {
        let run = scene(drawn);
        let geometry = Geometry::new(&run.scene, &run.motion, true);
        let piece = geometry.pieces.iter().find(|piece| piece.role == Role::Body).unwrap();
        let (mut low, mut high) = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
        for point in &piece.mesh.points {
            (low, high) = (low.inf(point), high.sup(point));
        }
        [low, high].map(|corner| [0, 1, 2].map(|k| (1e4 * corner[k]).round() / 1e4))
    };
    let box_ = "shape = { box = [0.2, 0.4, 0.6] }";
    assert_eq!(extent(box_), [[-0.1, -0.2, 0.7], [0.1, 0.2, 1.3]], "about the centre of mass");
    assert_eq!(extent("shape = { cylinder = [0.1, 2], axis = \"x\" }")[1], [1.0, 0.1, 1.1]);
    let facet = "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 0.5 0 0 vertex 0 0.25 0 endloop endfacet";
    fs::write(folder.path().join("part.stl"), format!("solid part {facet} endsolid")).unwrap();
    assert_eq!(extent("mesh = \"part.stl\""), [[0.0; 3], [0.5, 0.25, 0.0]], "in body axes");
    let page = lissom(&["view", "out/part", "--html", "page.html", "-q"], folder.path());
    assert_eq!(page.code, 0, "{}", page.errors);
    assert!(fs::read_to_string(folder.path().join("page.html")).unwrap().contains("\"triangles\":[[0,1,2]]"));
    // What `lissom export` writes can be a part of another model.
    let export = lissom(&["export", "out/part", "--format", "gltf"], folder.path());
    assert_eq!(export.code, 0, "{}", export.errors);
    fs::rename(folder.path().join("out/part/motion.glb"), folder.path().join("part.glb")).unwrap();
    assert_eq!(extent("mesh = \"part.glb\""), [[0.0, 0.0, -0.25], [0.5, 0.0, 0.0]], "its y is upward");
    let apart = r#"{"asset":{"version":"2.0"},"buffers":[{"uri":"part.bin","byteLength":4}]}"#;
    fs::write(folder.path().join("part.gltf"), apart).unwrap();
    fs::write(folder.path().join("empty.stl"), "solid nothing facet endsolid").unwrap();
    for (drawn, message) in [
        ("mesh = \"missing.stl\"", "`missing.stl` cannot be read"),
        ("mesh = \"empty.stl\"", "holds no triangles"),
        ("mesh = \"part.toml\"", "it is neither a glTF file nor an STL file"),
        ("mesh = \"part.gltf\"", "its buffer `part.bin` cannot be read"),
        ("mesh = \"part.stl\"\nshape = { sphere = 1 }", "both `shape` and `mesh`"),
        ("shape = { box = [1, 0, 1] }", "is not a valid solid"),
    ] {
        fs::write(folder.path().join("wrong.toml"), model(drawn)).unwrap();
        let wrong = lissom(&["check", "wrong.toml"], folder.path());
        assert!(wrong.code == 2 && wrong.errors.contains(message), "{drawn}: {}", wrong.errors);
    }
}

#[test]
fn what_is_drawn_lies_where_the_table_says() {
    let folder = Folder::new("snapshot-places");
    let model = example("pendulum");
    let run = lissom(&["run", &model, "--out", "out", "-q"], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    let out = folder.path().join("out");
    let run = ResultFolder::recorded(&out).unwrap();
    let table = Record::from_csv(&fs::read_to_string(out.join("history.csv")).unwrap()).unwrap();
    let mut geometry = Geometry::new(&run.scene, &run.motion, true);
    geometry.pieces.retain(|piece| piece.role == Role::PointMass);
    assert_eq!(geometry.pieces.len(), 1);
    for view in [View::Chosen, View::Oblique, View::Front, View::Side, View::Top] {
        let projection = Projection::of(&geometry, view);
        for row in [0, table.times.len() / 3, table.times.len() - 1] {
            let time = table.times[row];
            let place = Vector3::from(["x", "y", "z"].map(|name| table.column("bob", name).unwrap()[row]));
            let poses = poses_at(&run.motion, time).unwrap();
            let seen = painted((&geometry, &Paint::default()), &projection, &poses, time);
            let expected = projection.flat(&place);
            // The middle of the disc that a ball is seen as.
            for k in 0..2 {
                let all = || seen.iter().flat_map(|face| &face.points).map(|point| point[k]);
                let middle =
                    0.5 * (all().fold(f64::INFINITY, f64::min) + all().fold(f64::NEG_INFINITY, f64::max));
                assert!(
                    (middle - expected[k]).abs() < 0.002 * geometry.size,
                    "{view:?} {time}: {middle} {expected:?}"
                );
            }
        }
        // The directions to the right, upward and towards the viewer are a right-handed system.
        let [x, y, z] = [0, 1, 2].map(|k| Vector3::ith(k, 1.0));
        let column = |v: &Vector3| {
            let [right, above] = projection.flat(v);
            Vector3::new(right, above, projection.near(v))
        };
        assert!((column(&x).cross(&column(&y)) - column(&z)).norm() < 1e-12);
    }
    assert!(poses_at(&run.motion, 1.1).is_none() && poses_at(&run.motion, -0.1).is_none());
}

#[test]
fn a_failed_run_is_drawn_up_to_there_and_still_fails() {
    let folder = Folder::new("snapshot-failed");
    folder.write("bar.toml", CANTILEVER);
    let args = [
        "snapshot",
        "bar.toml",
        "--set",
        "loads.tip.scale=1e9*t",
        "--set",
        "analysis.max_iterations=3",
        "-q",
    ];
    let snapshot = lissom(&args, folder.path());
    assert_eq!(snapshot.code, 3, "{}", snapshot.errors);
    let svg = fs::read_to_string(folder.path().join("out/bar/snapshot.svg")).unwrap();
    assert!(svg.contains(">load 0<"), "statics know loads, no times");
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let folder = Folder::new("snapshot-refused");
    folder.write("bar.toml", CANTILEVER);
    let initial = lissom(&["snapshot", "bar.toml", "--initial", "--view", "front"], folder.path());
    assert_eq!((initial.code, initial.output.trim()), (0, "out/bar/snapshot.svg"), "{}", initial.errors);
    let modes = lissom(&["modes", "bar.toml", "--out", "modes", "-q"], folder.path());
    assert_eq!(modes.code, 0, "{}", modes.errors);
    assert_eq!(lissom(&["run", "bar.toml", "--no-plots", "-q", "--out", "plain"], folder.path()).code, 0);
    fs::remove_file(folder.path().join("plain/motion.bin")).unwrap();
    assert_eq!(lissom(&["run", "bar.toml", "-q", "--out", "out"], folder.path()).code, 0);
    for (args, words) in [
        (vec!["snapshot", "bar.toml", "--out", "bar.jpg"], ".svg or .png"),
        (vec!["snapshot", "out", "--at", "0.5,1.5"], "recorded from 0 s to 1 s"),
        (vec!["snapshot", "out", "--at", "nan"], "is not a valid time"),
        (vec!["snapshot", "out", "--strip", "0"], "0 is not in 1..=100"),
        (vec!["snapshot", "out", "--strip", "2", "--at", "1"], "cannot be used with"),
        (vec!["snapshot", "out", "--initial"], "folder of results"),
        (vec!["snapshot", "modes", "--strip", "3"], "natural modes"),
        (vec!["snapshot", "out", "--mode", "1"], "contains no natural modes"),
        (vec!["snapshot", "plain"], "without recorded motion"),
        (vec!["snapshot", "nowhere"], "there is no such file"),
    ] {
        let snapshot = lissom(&args, folder.path());
        assert_eq!(snapshot.code, 2, "{args:?} {}", snapshot.errors);
        assert!(snapshot.errors.contains(words), "{args:?} {}", snapshot.errors);
    }
    let scene = folder.path().join("out/scene.json");
    let text = fs::read_to_string(&scene).unwrap();
    for (damaged, words) in [
        (text.replace("\"lissom_scene\":3", "\"lissom_scene\":1"), "version 1"),
        (text[..text.len() / 2].to_owned(), "does not describe a scene"),
        (text.replace("\"node\":9", "\"node\":90"), "damaged"),
    ] {
        assert_ne!(damaged, text);
        fs::write(&scene, damaged).unwrap();
        let snapshot = lissom(&["snapshot", "out"], folder.path());
        assert!(snapshot.code == 2 && snapshot.errors.contains(words), "{}", snapshot.errors);
    }
}
