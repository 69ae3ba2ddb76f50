//! Sliders that hold the tangent of a beam, or its sections.

use lissom::{Model, SessionError};

use super::{SCHEMES, column, run, session};

/// A stiff quarter of a circle of 2 m about the origin, and a body on it at 30 degrees with 1.5 m/s that turns with it.
const ARC: &str = r#"
lissom = 1
gravity = [0, 0, 0]
[parameters]
speed = 1.5
begin = "pi/6"
[sections.bar]
shape = "general"
stiffness = [1e10, 1e10, 1e10, 1e9, 1e9, 1e9]
mass = { per_length = 1, inertia = [2e-3, 1e-3, 1e-3] }
[beams.arc]
section = "bar"
curve = ["2*cos(s*pi/2)", "2*sin(s*pi/2)", "0"]
elements = 12
order = 3
[joints.wall]
kind = "clamp"
base = "ground"
tip = "arc.start"
[joints.other]
kind = "clamp"
base = "ground"
tip = "arc.end"
[bodies.car]
mass = 0.7
inertia = [0.2, 0.3, 0.4]
position = ["2*cos(begin)", "2*sin(begin)", 0]
velocity = ["-speed*sin(begin)", "speed*cos(begin)", 0]
angular_velocity = [0, 0, "speed/2"]
[joints.slide]
kind = "slider"
beams = ["arc"]
tip = "car"
orientation = "ORIENTATION"
[outputs.slide]
kind = "relative"
of = "slide"
[outputs.spin]
kind = "angular_velocity"
of = "car"
[outputs.turn]
kind = "angle"
of = "car"
axis = [0, 0, 1]
[outputs.force]
kind = "reaction"
of = "slide"
[outputs.energy]
kind = "energy"
[analysis]
kind = "dynamics"
end = 1
step = 2e-3
"#;

/// It turns by s/R at the rate v/R, and the beam presses on it with m v²/R.
#[test]
fn a_body_that_follows_an_arc_turns_with_it() {
    for orientation in ["tangent", "section"] {
        let text = ARC.replace("ORIENTATION", orientation);
        for scheme in SCHEMES {
            // Steps of chosen size resolve the fast vibrations, which cost as much in every tenth of a second.
            for (steps, end) in
                [(("analysis.step", "2e-3"), "1"), (("analysis.relative_tolerance", "1e-6"), "0.3")]
            {
                let record = run(&text, &[("analysis.scheme", scheme), steps, ("analysis.end", end)]);
                let shown = format!("{orientation} {scheme} {steps:?}");
                for (row, time) in record.times.iter().enumerate() {
                    let at = |output, component| column(&record, output, component)[row];
                    let turned = at("turn", "angle") - 0.75 * time;
                    assert!(turned.abs() < 1e-4, "{shown} t = {time}: {turned}");
                    assert!((at("slide", "velocity") - 1.5).abs() < 2e-3, "{shown} t = {time}");
                    assert!(
                        (at("spin", "w3") - 0.75).abs() < 5e-3,
                        "{shown} t = {time}: {}",
                        at("spin", "w3")
                    );
                    // What turns fast in the line while the car is taken up goes on vibrating with steps that resolve it.
                    if *time > 0.1 && steps.0 == "analysis.step" {
                        let force = at("force", "f1").hypot(at("force", "f2"));
                        assert!((force - 0.7 * 1.5 * 1.5 / 2.0).abs() < 0.05, "{shown} t = {time}: {force}");
                    }
                }
                let energy = column(&record, "energy", "total");
                let last = energy[energy.len() - 1];
                assert!((last / energy[0] - 1.0).abs() < 1e-4, "{shown}: {} {last}", energy[0]);
            }
        }
        let mut whole = session(&text, &[]);
        whole.step_to(0.5).unwrap();
        let snapshot = whole.snapshot();
        whole.step_to(0.8).unwrap();
        let mut again = session(&text, &[]);
        again.restore(&snapshot).unwrap();
        again.step_to(0.8).unwrap();
        let (mut values, mut others) = (Vec::new(), Vec::new());
        whole.values(&mut values);
        again.values(&mut others);
        assert_eq!(values, others, "{orientation}");
    }
}

/// On a straight beam the moment of a load does not turn the body: the beam holds it, across the line with `tangent`, about the
/// line as well with `section`.
#[test]
fn a_straight_beam_holds_what_it_orients() {
    for (orientation, holds_about) in [("tangent", false), ("section", true)] {
        let text = ARC
            .replace("ORIENTATION", orientation)
            .replace(
                "curve = [\"2*cos(s*pi/2)\", \"2*sin(s*pi/2)\", \"0\"]",
                "from = [0, 0, 0]\nto = [0, 3, 0]",
            )
            .replace("position = [\"2*cos(begin)\", \"2*sin(begin)\", 0]", "position = [0, 0.4, 0]")
            .replace(
                "velocity = [\"-speed*sin(begin)\", \"speed*cos(begin)\", 0]",
                "velocity = [0, \"speed\", 0]",
            )
            .replace("angular_velocity = [0, 0, \"speed/2\"]", "")
            .replace(
                "[analysis]",
                "[loads.moment]\nkind = \"moment\"\non = \"car\"\nvector = [0.3, 0.2, -0.5]\n[analysis]",
            );
        let record = run(&text, &[]);
        for (row, time) in record.times.iter().enumerate() {
            let at = |output, component| column(&record, output, component)[row];
            let [across, about] = [at("spin", "w1").hypot(at("spin", "w3")), at("spin", "w2")];
            let free = if holds_about { 0.0 } else { 0.2 * time / 0.3 };
            assert!(
                across < 1e-3 && (about - free).abs() < 1e-3,
                "{orientation} t = {time}: {across} {about}"
            );
        }
        // Loads come at once, and the beam goes on vibrating about what it holds.
        let held = if holds_about { -0.2 } else { 0.0 };
        for (component, wanted) in [("m1", -0.3), ("m2", held), ("m3", 0.5)] {
            let values = &column(&record, "force", component)[1..];
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            assert!((mean - wanted).abs() < 0.02, "{orientation} {component}: {mean}");
        }
    }
}

/// The sections of a straight beam are turned by 0.6 rad per metre: a body on them spins about it, one on the tangent does not.
#[test]
fn a_body_on_a_twisted_beam_spins_as_a_nut() {
    for (orientation, spin) in [("tangent", 0.0), ("section", 0.6 * 1.5)] {
        let text = ARC
            .replace("ORIENTATION", orientation)
            .replace(
                "curve = [\"2*cos(s*pi/2)\", \"2*sin(s*pi/2)\", \"0\"]",
                "from = [0, 0, 0]\nto = [0, 3, 0]\nup = [0, 0, 1]\ntwist = \"1.8*s\"",
            )
            .replace("position = [\"2*cos(begin)\", \"2*sin(begin)\", 0]", "position = [0, 0.4, 0]")
            .replace(
                "velocity = [\"-speed*sin(begin)\", \"speed*cos(begin)\", 0]",
                "velocity = [0, \"speed\", 0]",
            )
            .replace("angular_velocity = [0, 0, \"speed/2\"]", &format!("angular_velocity = [0, {spin}, 0]"));
        let record = run(&text, &[]);
        for (row, time) in record.times.iter().enumerate() {
            let at = |output, component| column(&record, output, component)[row];
            assert!((at("spin", "w2") - spin).abs() < 5e-3, "{orientation} t = {time}: {}", at("spin", "w2"));
            assert!((at("slide", "velocity") - 1.5).abs() < 2e-3, "{orientation} t = {time}");
        }
    }
}

/// Two beams of one line: a slider that turns with their sections needs them to agree where the beams meet.
#[test]
fn sections_that_are_turned_against_each_other_are_refused() {
    let text = |up: &str, orientation: &str| {
        let first = "from = [0, 0, 0]\nto = [0, 3, 0]\nup = [0, 0, 1]";
        ARC.replace("ORIENTATION", orientation)
            .replace("curve = [\"2*cos(s*pi/2)\", \"2*sin(s*pi/2)\", \"0\"]", first)
            .replace("tip = \"arc.end\"", "tip = \"more.end\"")
            .replace("beams = [\"arc\"]", "beams = [\"arc\", \"more\"]")
            .replace("position = [\"2*cos(begin)\", \"2*sin(begin)\", 0]", "position = [0, 0.4, 0]")
            + &format!(
                "[beams.more]\nsection = \"bar\"\nfrom = \"arc.end\"\nto = [0, 5, 0]\nup = {up}\nelements = 4\norder = 3\n"
            )
    };
    // By 1 and by 3 degrees; 2 are allowed.
    for (up, orientation, is_refused) in [
        ("[0, 0, 1]", "section", false),
        ("[0.01745, 0, 1]", "section", false),
        ("[0.05241, 0, 1]", "section", true),
        ("[1, 0, 0]", "section", true),
        ("[1, 0, 0]", "tangent", false),
        ("[1, 0, 0]", "free", false),
    ] {
        let said = match Model::from_text("slider.toml", &text(up, orientation)).session() {
            Ok(_) => String::new(),
            Err(SessionError::Model(report)) => report.render(false),
            Err(error) => error.to_string(),
        };
        assert_eq!(said.contains("differ in orientation"), is_refused, "{up}: {said}");
        assert_eq!(said.is_empty(), !is_refused, "{up} {orientation}: {said}");
    }
}
