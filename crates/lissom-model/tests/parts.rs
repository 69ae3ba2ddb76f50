//! Parts that repeat: names, positions, parameters and mistakes of what is included, copied and counted.

use std::sync::Arc;

use lissom_model::document::{Attachment, Document, NodeReference};
use lissom_model::lower::registry::registry;
use lissom_model::{Library, ModelText, Report};
use lissom_motion::{Matrix3, Rotation, Vector3};

const ARM: &str = r#"
lissom = 1
title = "A pendulum"

[parameters]
length = 1
half = "length/2"

[points]
end = [0, 0, "-length"]

[bodies.rod]
mass = "2*length"
inertia = [0.1, 0.1, 0.01]
position = [0, 0, "-half"]

[joints.pin]
kind = "revolute"
base = "frame"
tip = "rod"
at = [0, 0, 0]
axis = [0, 1, 0]

[loads.push]
kind = "force"
on = "rod"
at = "end"
vector = [1, 0, 0]
scale = "gain*pin.rate + length"

[signals]
gain = "3*tip.x"

[outputs.tip]
kind = "position"
of = "rod"
point = "end"
"#;

const ANALYSIS: &str = "[analysis]\nkind = \"dynamics\"\nend = 1\nstep = 0.01\n";

fn read_with(text: &str, files: &[(&str, &str)], overrides: &[(&str, &str)]) -> Result<Document, Report> {
    let own = |pair: &(&str, &str)| (pair.0.to_owned(), pair.1.to_owned());
    let overrides: Vec<_> = overrides.iter().map(own).collect();
    let library = Arc::new(Library::of_texts(files.iter().map(own)));
    let text = format!("lissom = 1\n{text}\n{ANALYSIS}");
    ModelText::read_with(&text, "models/model.toml", &overrides, library)?.document(&registry(), &[])
}

fn read(text: &str) -> Document {
    read_with(text, &[("arm.toml", ARM)], &[]).map_err(|report| report.render(false)).unwrap()
}

/// The report on a model that is wrong.
fn reported(text: &str, files: &[(&str, &str)], overrides: &[(&str, &str)]) -> String {
    read_with(text, files, overrides).expect_err("it is wrong").render(false)
}

fn position(document: &Document, body: &str) -> Vector3 {
    document.bodies.iter().find(|known| known.name.value == body).unwrap().position
}

#[test]
fn an_included_part_has_names_parameters_and_a_place_of_its_own() {
    let document = read(
        "parameters = { length = 7, size = 3 }\nbodies.frame = { mass = 1, inertia = [1, 1, 1] }\n\
         [parts.left]\ninclude = \"arm.toml\"\nposition = [1, 2, 3]\nrotation = [0, 0, \"pi/2\"]\n\
         parameters = { length = \"2*size\" }\nnames = { frame = \"frame\" }\n\
         [parts.right]\ninclude = \"arm.toml\"\nnames = { frame = \"ground\" }\n",
    );
    let names: Vec<&str> = document.bodies.iter().map(|body| body.name.value.as_str()).collect();
    assert_eq!(names, ["frame", "left.rod", "right.rod"]);
    // Parameters of the model are not those of the file: only what is handed in counts.
    assert_eq!((document.bodies[1].mass, document.bodies[2].mass), (12.0, 2.0));
    assert_eq!(document.parameters.len(), 2);
    assert!((position(&document, "left.rod") - Vector3::new(1.0, 2.0, 0.0)).norm() < 1e-15);
    assert_eq!(position(&document, "right.rod"), Vector3::new(0.0, 0.0, -0.5));
    assert!((document.points["left.end"] - Vector3::new(1.0, 2.0, -3.0)).norm() < 1e-14);
    let Attachment { nodes, axes, .. } = &document.joints[0].attachment;
    assert_eq!(nodes[0].node.value, NodeReference::Body("frame".to_owned()));
    assert_eq!(nodes[1].node.value, NodeReference::Body("left.rod".to_owned()));
    assert!((nodes[0].at.unwrap() - Vector3::new(1.0, 2.0, 3.0)).norm() < 1e-15);
    assert!((axes[0].value + Vector3::x()).norm() < 1e-15, "{axes:?}");
    // The force turns with the part, and its size names the part's own joint and signal.
    let push = document.loads[0].parameters.vector("vector").unwrap();
    assert!((push - Vector3::y()).norm() < 1e-15, "{push}");
    let (_, size) = document.loads[0].signal.as_ref().unwrap();
    let named: Vec<&str> = size.value.arguments().iter().map(|name| name.text.as_str()).collect();
    assert_eq!(named, ["left.gain", "left.pin.rate"]);
    assert_eq!(document.signals[1].value.value.arguments()[0].text, "right.tip.x");
    assert_eq!(document.outputs[1].name.value, "right.tip");
}

#[test]
fn previous_samples_are_those_of_the_parts_own_signals() {
    let signals = "[parts.left.signals]\nslow = { value = \"fast.last\", sample = 0.1 }\n\
                   fast = { value = \"slow.last + 1\", sample = 0.1 }\n";
    let document = read(&format!("[parts.left.bodies.rod]\nmass = 1\ninertia = [1, 1, 1]\n{signals}"));
    let named: Vec<&str> =
        document.signals.iter().map(|own| own.value.value.arguments()[0].text.as_str()).collect();
    assert_eq!(named, ["left.fast.last", "left.slow.last"]);
}

#[test]
fn arrays_count_and_names_are_numbered() {
    let document = read(
        "[parts.link]\ncount = 4\nposition = [\"index - 1\", 0, 0]\n\
         [parts.link.bodies.rod]\nmass = \"index*count\"\ninertia = [1, 1, 1]\nposition = [0.5, 0, 0]\n\
         [parts.pin]\ncount = 3\n\
         [parts.pin.joints.hinge]\nkind = \"revolute\"\nbase = \"link{index}.rod\"\ntip = \"link{index + 1}.rod\"\n\
         at = [\"index\", 0, 0]\naxis = [0, 1, 0]\n",
    );
    assert_eq!(document.bodies.len(), 4);
    assert_eq!(document.bodies[2].mass, 12.0);
    assert_eq!(position(&document, "link4.rod"), Vector3::new(3.5, 0.0, 0.0));
    let hinge = &document.joints[2];
    assert_eq!(hinge.name.value, "pin3.hinge");
    let nodes = &hinge.attachment.nodes;
    assert_eq!(nodes[0].node.value, NodeReference::Body("link3.rod".to_owned()));
    assert_eq!(nodes[1].node.value, NodeReference::Body("link4.rod".to_owned()));
    assert_eq!(nodes[0].at, Some(Vector3::new(3.0, 0.0, 0.0)));
    let names: Vec<&str> = document.bodies.iter().map(|body| body.name.value.as_str()).collect();
    assert_eq!(names, ["link1.rod", "link2.rod", "link3.rod", "link4.rod"], "in the order of the array");
}

#[test]
fn a_part_is_like_another_turned_and_shifted() {
    let document = read(
        "materials.steel = { E = 2e11, nu = 0.3, density = 7800 }\n\
         sections.bar = { shape = \"circle\", material = \"steel\", radius = 0.01 }\n\
         bodies.hub = { mass = 1, inertia = [1, 1, 1] }\n\
         [parts.blade1]\nposition = [0, 0, 0.5]\nparameters = { r = 2 }\n\
         [parts.blade1.beams.beam]\nsection = \"bar\"\nfrom = [0, 0, 0]\nto = [0, 0, \"r\"]\nelements = 1\n\
         [parts.blade1.joints.root]\nkind = \"clamp\"\nbase = \"hub\"\ntip = \"beam.start\"\n\
         [parts.blade2]\nlike = \"blade1\"\nrotation = [\"2*pi/3\", 0, 0]\n\
         [parts.blade3]\nlike = \"blade2\"\nrotation = [\"2*pi/3\", 0, 0]\nparameters = { r = 3 }\n",
    );
    let end = |name: &str| document.beam(name).unwrap().line.position(1.0);
    let turn = Rotation::exponential(&Vector3::new(2.0 * std::f64::consts::FRAC_PI_3, 0.0, 0.0));
    assert_eq!(end("blade1.beam"), Vector3::new(0.0, 0.0, 2.5));
    // The position of the original is turned, too.
    assert!((end("blade2.beam") - turn.apply(&Vector3::new(0.0, 0.0, 2.5))).norm() < 1e-14);
    assert!((end("blade3.beam") - turn.apply(&turn.apply(&Vector3::new(0.0, 0.0, 3.5)))).norm() < 1e-14);
    // Sections are in each blade as in the first.
    let frame = |name: &str| document.beam(name).unwrap().frame(0.5);
    let turned: Matrix3 = turn.matrix() * frame("blade1.beam");
    assert!((turned - frame("blade2.beam")).norm() < 1e-14, "{}", frame("blade2.beam"));
    assert!(document.warnings.is_empty(), "{}", document.warnings.render(false));
}

#[test]
fn axes_that_are_not_given_are_those_of_the_part() {
    let document = read(
        "[parts.a]\nrotation = [0, 0, \"pi/2\"]\n[parts.a.bodies.b]\nmass = 1\ninertia = [1, 1, 1]\n\
         [parts.a.joints.slide]\nkind = \"generic\"\nbase = \"ground\"\ntip = \"b\"\nlocked = [\"x\", \"rx\"]\n",
    );
    let axes = &document.joints[0].attachment.axes;
    assert!((axes[0].value - Vector3::y()).norm() < 1e-15);
    assert!((axes[1].value + Vector3::x()).norm() < 1e-15);
}

#[test]
fn laws_of_springs_and_data_files_work_in_parts() {
    let part = "[bodies.b]\nmass = 1\ninertia = [1, 1, 1]\nposition = [1, 0, 0]\n\
        [springs.law]\nkind = \"point\"\nbase = \"ground\"\ntip = \"b\"\nforce = \"100*elongation + 2*rate\"\n\
        [loads.push]\nkind = \"force\"\non = \"b\"\nvector = [1, 0, 0]\nscale = { file = \"push.csv\" }\n";
    let files = [("sub/part.toml", part), ("sub/push.csv", "time,force\n0,1\n1,3\n")];
    let text = "[parts.a]\ninclude = \"sub/part.toml\"\nrotation = [0, 0, 1]\n";
    let document = read_with(text, &files, &[]).map_err(|report| report.render(false)).unwrap();
    assert_eq!(document.loads[0].parameters.function("scale").unwrap().value(0.5), 2.0);
    let law = document.springs[0].parameters.force("force").unwrap().unwrap();
    assert_eq!(law.evaluate(0.1, 3.0)[0], 16.0);
}

#[test]
fn events_of_a_part_set_its_own_inputs() {
    let part = "inputs.gain = 1\n[bodies.b]\nmass = 1\ninertia = [1, 1, 1]\n\
        [outputs.place]\nkind = \"position\"\nof = \"b\"\n\
        [events.floor]\nzero_of = \"place.z + gain\"\nset = { gain = 2 }\n";
    let text = "inputs.gain = 5\n[parts.a]\ninclude = \"part.toml\"\n";
    let document =
        read_with(text, &[("part.toml", part)], &[]).map_err(|report| report.render(false)).unwrap();
    let event = &document.events[0];
    assert_eq!((event.name.value.as_str(), event.set[0].0.value.as_str()), ("a.floor", "a.gain"));
    let text = "inputs.gain = 5\n[parts.a]\ninclude = \"part.toml\"\n";
    let part = part.replace("inputs.gain = 1\n", "").replace(" + gain", "");
    let shown = reported(text, &[("part.toml", &part)], &[]);
    assert!(shown.contains("sets `gain`, which is not an input"), "the model's input is another: {shown}");
}

#[test]
fn curved_beams_turn_with_their_part() {
    let document = read(
        "materials.steel = { E = 2e11, nu = 0.3, density = 7800 }\n\
         sections.bar = { shape = \"circle\", material = \"steel\", radius = 0.01 }\n\
         [parts.a]\nposition = [1, 0, 0]\nrotation = [0, 0, \"pi/2\"]\n\
         [parts.a.beams.curved]\nsection = \"bar\"\ncurve = [\"2*s\", \"s^2\", 0]\nelements = 2\n\
         [parts.a.beams.arc]\nsection = \"bar\"\nfrom = [1, 0, 0]\nthrough = [\"sqrt(0.5)\", \"sqrt(0.5)\", 0]\nto = [0, 1, 0]\nelements = 2\n",
    );
    let line = |name: &str| &document.beam(name).unwrap().line;
    assert!((line("a.curved").position(0.5) - Vector3::new(0.75, 1.0, 0.0)).norm() < 1e-14);
    assert!((line("a.curved").derivative(0.5) - Vector3::new(-1.0, 2.0, 0.0)).norm() < 1e-14);
    assert!((line("a.arc").position(1.0) - Vector3::new(0.0, 0.0, 0.0)).norm() < 1e-14);
    assert!((line("a.arc").length() - std::f64::consts::FRAC_PI_2).abs() < 1e-14);
}

#[test]
fn places_are_relative_to_the_part_that_in_names() {
    let document = read(
        "[bodies.upper]\nmass = 1\ninertia = [1, 1, 1]\nposition = [1, 0, 0]\nrotation = [0, 0, \"pi/2\"]\n\
         [bodies.fore]\nin = \"upper\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [2, 0, 0]\nrotation = [0, 0, \"pi/2\"]\n\
         velocity = [1, 0, 0]\n\
         [points]\nhand = { in = \"fore\", at = [1, 0, 0] }\nwrist = { in = \"fore\" }\n\
         [joints.elbow]\nkind = \"revolute\"\nbase = \"upper\"\ntip = \"fore\"\nin = \"fore\"\nat = [-0.5, 0, 0]\naxis = [0, 1, 0]\n\
         [joints.hold]\nkind = \"spherical\"\nbase = \"ground\"\ntip = \"fore\"\nat = \"hand\"\n\
         [parts.gripper]\nin = \"fore\"\nposition = [1, 0, 0]\n\
         [parts.gripper.bodies.jaw]\nmass = 1\ninertia = [1, 1, 1]\nposition = [0, 0.1, 0]\n\
         [parts.gripper.joints.weld]\nkind = \"clamp\"\nbase = \"fore\"\ntip = \"jaw\"\n",
    );
    let near = |found: Vector3, wanted: [f64; 3]| {
        assert!((found - Vector3::from(wanted)).norm() < 1e-14, "{found} {wanted:?}");
    };
    near(position(&document, "fore"), [1.0, 2.0, 0.0]);
    near(document.bodies[1].axes * Vector3::x(), [-1.0, 0.0, 0.0]);
    near(document.bodies[1].velocity.unwrap().value, [0.0, 1.0, 0.0]);
    near(document.points["hand"], [0.0, 2.0, 0.0]);
    near(document.points["wrist"], [1.0, 2.0, 0.0]);
    let Attachment { nodes, axes, .. } = &document.joints[0].attachment;
    near(nodes[0].at.unwrap(), [1.5, 2.0, 0.0]);
    near(axes[0].value, [0.0, -1.0, 0.0]);
    near(position(&document, "gripper.jaw"), [0.0, 1.9, 0.0]);
    let around = "bodies.a = { in = \"b\", mass = 1, inertia = [1, 1, 1] }\nbodies.b = { in = \"a\", mass = 1, inertia = [1, 1, 1] }\n";
    assert!(reported(around, &[], &[]).contains("relative to itself, in a circle"));
    let text = reported("bodies.a = { in = \"c\", mass = 1, inertia = [1, 1, 1] }\n", &[], &[]);
    assert!(text.contains("`in` names `c`, which is no body and no part"), "{text}");
}

#[test]
fn overrides_reach_into_parts() {
    let parts = "[parts.leg]\ninclude = \"arm.toml\"\ncount = 2\nposition = [\"index\", 0, 0]\nnames = { frame = \"ground\" }\n";
    let files = [("arm.toml", ARM), ("long.toml", &ARM.replace("length = 1", "length = 9"))];
    let read = |overrides: &[(&str, &str)]| {
        read_with(parts, &files, overrides).map_err(|report| report.render(false))
    };
    let document =
        read(&[("leg2.rod.mass", "\"length + 0.5\""), ("leg1.rod.position", "[0, 0, 1]")]).unwrap();
    assert_eq!((document.bodies[0].mass, document.bodies[1].mass), (2.0, 1.5), "the part's own parameter");
    assert_eq!(position(&document, "leg1.rod"), Vector3::new(1.0, 0.0, 1.0), "in the part's axes");
    let document = read(&[("parts.leg.parameters.length", "5"), ("bodies.\"leg1.rod\".mass", "4")]).unwrap();
    assert_eq!((document.bodies[0].mass, document.bodies[1].mass), (4.0, 10.0));
    let document = read(&[("parts.leg.include", "long.toml"), ("parts.leg.count", "1")]).unwrap();
    assert_eq!((document.bodies.len(), document.bodies[0].mass), (1, 18.0));
    for (path, wanted) in [
        ("leg3.rod.mass", "nothing in the model is called as `leg3.rod.mass` begins"),
        ("leg2.rood.mass", "did you mean `leg2.rod`?"),
        ("leg2.rod.mas", "did you mean `mass`?"),
        ("bodies.\"leg9.rod\".mass", "the model has no `bodies.leg9.rod` to override"),
    ] {
        let text = read(&[(path, "1")]).unwrap_err();
        assert!(text.contains(wanted) && text.contains("override"), "{text}");
    }
}

#[test]
fn mistakes_are_shown_in_the_included_file_and_where_it_is_included() {
    let parts = "[parts.leg]\ninclude = \"sub/arm.toml\"\ncount = 3\nnames = { frame = \"ground\" }\n";
    let wrong = ARM.replace("mass = \"2*length\"", "mass = \"2*lenght\"");
    let text = reported(parts, &[("sub/arm.toml", &wrong)], &[]);
    assert!(text.contains("[models/sub/arm.toml:13:11]"), "the line of the file: {text}");
    assert!(text.contains("this is in the part `leg1`; the same in 2 more parts, `leg3` the last"), "{text}");
    assert!(text.contains("[models/model.toml:2:8]"), "the line of the model: {text}");
    assert_eq!(text.matches("unknown name").count(), 1, "reported once: {text}");
    // Two levels.
    let middle = "[parts.inner]\ninclude = \"sub/arm.toml\"\nnames = { frame = \"ground\" }\n";
    let text = reported(
        "[parts.outer]\ninclude = \"middle.toml\"\n",
        &[("middle.toml", middle), ("sub/arm.toml", &wrong)],
        &[],
    );
    for wanted in [
        "[models/sub/arm.toml:13:11]",
        "`outer.inner`",
        "[models/middle.toml:1:8]",
        "`outer`",
        "[models/model.toml:2:8]",
    ] {
        assert!(text.contains(wanted), "{wanted}: {text}");
    }
    // A name that the part expects.
    let text = reported("[parts.leg]\ninclude = \"sub/arm.toml\"\n", &[("sub/arm.toml", ARM)], &[]);
    assert!(text.contains("pass it by `names = { frame = \"…\" }`"), "{text}");
    // A text that is not TOML.
    let text = reported(parts, &[("sub/arm.toml", "a = = 1\n")], &[]);
    assert!(text.contains("not TOML") && text.contains("[models/sub/arm.toml:1:5]"), "{text}");
}

#[test]
fn mistakes_with_parts_are_reported() {
    let arm = |more: &str| format!("[parts.leg]\ninclude = \"arm.toml\"\n{more}\n");
    let held = "names = { frame = \"ground\" }\n";
    let turned = "[parts.p]\nrotation = [0.1, 0, 0]\n[parts.p.point_masses.m]\nmass = 1\nplane = \"xy\"\n";
    for (text, wanted) in [
        (arm(""), "names the node `frame`, which does not exist"),
        (arm("names = { frame = \"frame\" }"), "names the node `frame`, which does not exist"),
        (arm("names = { rod = \"ground\", frame = \"ground\" }"), "`rod` is handed to `leg`, which has something of this name"),
        (arm(&format!("{held}parameters = {{ lenght = 2 }}")), "has no parameter `lenght`"),
        (arm(&format!("{held}poition = [0, 0, 1]")), "unknown key `poition`"),
        (arm(&format!("{held}count = 0")), "must be a whole number from 1 to"),
        (arm(&format!("{held}count = \"n\"")), "must be a whole number from 1 to"),
        (arm(&format!("{held}like = \"arm\"")), "is made of two things"),
        ("[parts.leg]\ncount = 1\ninclude = \"arm.toml\"\n[parts.leg1]\ninclude = \"arm.toml\"\n".to_owned(), "there are two parts called `leg1`"),
        ("[parts.leg]\nposition = [0, 0, 1]\n".to_owned(), "is made of nothing"),
        ("[parts.leg]\ninclude = \"leg.toml\"\n".to_owned(), "`leg.toml` was not among the files"),
        ("[parts.leg]\nlike = \"lag\"\n".to_owned(), "is like `lag`, which is no other part"),
        ("[parts.a]\nlike = \"b\"\n[parts.b]\nlike = \"a\"\n".to_owned(), "is like itself"),
        (
            (0..40).map(|k| format!("[parts.p{k}]\nlike = \"p{}\"\n", k + 1)).collect::<Vec<_>>().concat() + "[parts.p40]\ninclude = \"arm.toml\"\n",
            "part `p0` is like another one through 32 others",
        ),
        ("[parts.a]\ninclude = \"self.toml\"\n".to_owned(), "`self.toml` includes itself: self.toml includes self.toml"),
        ("[parts.a]\ninclude = \"one.toml\"\n".to_owned(), "one.toml includes two.toml includes one.toml"),
        ("[parts.a]\ninclude = \"heavy.toml\"\n".to_owned(), "`gravity` is not allowed in an included file"),
        ("bodies.a = { mass = 1, inertia = [1, 1, 1] }\n[parts.a.bodies.b]\nmass = 1\ninertia = [1, 1, 1]\n".to_owned(), "the body `a` has the name of a part"),
        (turned.to_owned(), "is not a plane of global axes, because its part is rotated"),
        ("[parts.ground.bodies.b]\nmass = 1\ninertia = [1, 1, 1]\n".to_owned(), "`ground` cannot be the name of a part"),
        ("[parts.p.joints.j]\nkind = \"spherical\"\nbase = \"ground\"\ntip = \"x{index}\"\n".to_owned(), "unknown name `index`"),
        ("[parts.p]\n[parts.p.parameters]\nL = 1\n[parts.p.signals]\nL = \"t\"\n".to_owned(), "has the name of a parameter"),
    ] {
        let files = [
            ("arm.toml", ARM),
            ("self.toml", "[parts.again]\ninclude = \"self.toml\"\n"),
            ("one.toml", "[parts.again]\ninclude = \"two.toml\"\n"),
            ("two.toml", "[parts.again]\ninclude = \"one.toml\"\n"),
            ("heavy.toml", "gravity = [0, 0, -9.81]\n"),
        ];
        let shown = reported(&text, &files, &[]);
        // Long lines are broken.
        let joined = shown.split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ");
        assert!(joined.contains(wanted), "{wanted}: {shown}");
    }
}
