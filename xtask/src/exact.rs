//! `cargo xtask exact`: random models whose results are known exactly: solids dropped into rest, parts that slide over seams, belts
//! beside other contacts, friction of rotors that turn at the start, and laws at rest. A seed determines every case.

use lissom::Model;

use crate::cases::{CaseArguments, results};
use crate::random::draw::Draw;

/// Weight of a mass of 1 kg [N].
const GRAVITY: f64 = 9.81;
/// More steps than this show that a law at rest limits them.
const MOST_STEPS: usize = 2000;

/// A random model.
struct Case {
    text: String,
    /// Column, value at the end, and allowed difference.
    expected: Vec<(String, f64, f64)>,
    most_steps: usize,
}

impl Case {
    fn new(seed: u64, index: u64) -> Self {
        let draw = &mut Draw::new(seed ^ 0xe8ac7, index);
        match index % 5 {
            0 => drop(draw),
            1 => seam(draw),
            2 => belt(draw),
            3 => rotor(draw),
            _ => rest(draw),
        }
    }

    fn of(text: String, expected: Vec<(String, f64, f64)>) -> Self {
        Self { text, expected, most_steps: usize::MAX }
    }
}

/// The analysis of a set with steps of random size.
fn set(draw: &mut Draw, end: f64, steps: [f64; 2]) -> String {
    let step = draw.size(steps[0], steps[1]);
    format!("[analysis]\nkind = \"dynamics\"\nend = {end}\nscheme = \"backward-euler\"\nstep = {step}\n")
}

/// A solid of each form falls on a plane or a box, tilted and spinning, and rests: N/k deep at most at each of its points.
fn drop(draw: &mut Draw) -> Case {
    let size = draw.size(0.02, 1.0);
    let length = size * draw.between(0.3, 1.5);
    let shape = match draw.below(6) {
        0 => format!("{{ kind = \"cylinder\", radius = {size}, length = {length} }}"),
        1 => format!(
            "{{ kind = \"tube\", outer_radius = {size}, inner_radius = {}, length = {length} }}",
            0.6 * size
        ),
        2 => format!("{{ box = [{size}, {}, {length}] }}", 0.8 * size),
        3 => format!("{{ kind = \"sphere\", radius = {size} }}"),
        4 => format!("{{ kind = \"capsule\", radius = {}, length = {size} }}", 0.3 * size),
        _ => format!("{{ kind = \"ellipsoid\", semi_axes = [{size}, {size}, {}] }}", 0.5 * size),
    };
    let is_tube = shape.contains("tube");
    let ground = if is_tube || draw.chance(0.5) {
        "{ kind = \"plane\" }"
    } else {
        "{ box = [40, 40, 2], position = [0, 0, -1] }"
    };
    let mass = 2000.0 * size.powi(3);
    let weight = mass * GRAVITY;
    let stiffness = weight / (size * draw.size(1e-5, 3e-4));
    let moment = 0.4 * mass * size * size;
    let turn = [draw.between(-0.4, 0.4), draw.between(-0.4, 0.4), draw.between(-1.0, 1.0)];
    let spin = [draw.between(-1.0, 1.0), draw.between(-1.0, 1.0), draw.between(-6.0, 6.0)];
    let analysis = set(draw, 3.0, [2e-4, 5e-3]);
    let text = format!(
        "lissom = 1\ngravity = [0, 0, -{GRAVITY}]\n[ground]\nshape = {ground}\n[bodies.c]\nmass = {mass}\ninertia = [{moment}, {moment}, {}]\n\
         shape = {shape}\nposition = [0, 0, {}]\nrotation = {turn:?}\nangular_velocity = {spin:?}\n[contacts.f]\nbase = \"ground\"\ntip = \"c\"\n\
         stiffness = {stiffness}\nrestitution = {}\nfriction = {}\n[outputs.f]\nkind = \"contact_force\"\nof = \"f\"\n{analysis}",
        1.2 * moment,
        1.8 * size,
        draw.between(0.0, 0.5),
        draw.between(0.1, 0.8),
    );
    let allowed = 3.0 * weight / stiffness + 1e-4 * size;
    Case::of(text, vec![("f.gap".to_owned(), 0.0, allowed)])
}

/// A part without friction crosses the seams of flush plates.
fn seam(draw: &mut Draw) -> Case {
    let thickness = draw.size(0.005, 0.1);
    let width = draw.between(0.5, 1.2);
    let plates = (0..5).map(|k| {
        let (x, z) = ((f64::from(k) - 0.5) * width, -0.5 * thickness);
        format!("{{ box = [{width}, 2, {thickness}], position = [{x}, 0, {z}] }}")
    });
    let plates = plates.collect::<Vec<_>>().join(", ");
    let speed = draw.between(0.5, 5.0);
    let shape =
        draw.of(&["{ box = [0.2, 0.2, 0.1] }", "{ kind = \"cylinder\", radius = 0.1, length = 0.1 }"]);
    let turn = draw.between(-1.5, 1.5);
    let end = 2.5 * width / speed;
    let analysis = set(draw, end, [2e-4, 2e-3]);
    let text = format!(
        "lissom = 1\ngravity = [0, 0, -{GRAVITY}]\n[ground]\nshape = [{plates}]\n[bodies.c]\nmass = 1\ninertia = [0.01, 0.01, 0.01]\nshape = {shape}\n\
         position = [{}, 0, 0.05]\nvelocity = [{speed}, 0, 0]\nrotation = [0, 0, {turn}]\n[contacts.f]\nbase = \"ground\"\ntip = \"c\"\nstiffness = 1e6\n\
         friction = 0\ndissipation = 1\n[outputs.v]\nkind = \"velocity\"\nof = \"c\"\n{analysis}",
        -0.4 * width,
    );
    Case::of(text, vec![("v.v1".to_owned(), speed, 1e-3 * speed)])
}

/// A parcel on another one on a belt: v t - v²/(2 μ g), whatever the names of the contacts.
fn belt(draw: &mut Draw) -> Case {
    let [speed, friction] = [draw.between(0.2, 1.0), draw.between(0.15, 0.4)];
    let names = draw.of(&[["a", "b"], ["b", "a"]]);
    let masses = [draw.size(0.5, 5.0), draw.size(0.2, 2.0)];
    let body = |name: &str, mass: f64, z: f64| {
        format!(
            "[bodies.{name}]\nmass = {mass}\ninertia = {{ box = [0.4, 0.4, 0.1] }}\nshape = {{ box = [0.4, 0.4, 0.1] }}\nposition = [0, 0, {z}]\n"
        )
    };
    let text = format!(
        "lissom = 1\ngravity = [0, 0, -{GRAVITY}]\n[ground]\nshape = {{ kind = \"plane\" }}\n{}{}[contacts.{}]\nbase = \"ground\"\ntip = \"low\"\n\
         stiffness = 1e6\nfriction = {friction}\ndissipation = 1\nsurface_velocity = [{speed}, 0, 0]\n[contacts.{}]\nbase = \"low\"\ntip = \"high\"\n\
         stiffness = 1e6\nfriction = {}\ndissipation = 1\n[outputs.p]\nkind = \"position\"\nof = \"high\"\n[analysis]\nkind = \"dynamics\"\nend = 1\n",
        body("low", masses[0], 0.05),
        body("high", masses[1], 0.15),
        names[0],
        names[1],
        2.0 * friction + 0.1,
    );
    let way = speed - speed * speed / (2.0 * friction * GRAVITY);
    Case::of(text, vec![("p.x".to_owned(), way, 3e-4 * way.abs() + 2e-5)])
}

/// A rotor that turns at the start is braked: its angle and the work of friction.
fn rotor(draw: &mut Draw) -> Case {
    let scheme = draw.of(&["generalized-alpha", "hht", "radau-iia", "radau-iia-5", "energy-decaying"]);
    let [inertia, moment, rate] = [draw.size(1e-3, 10.0), draw.size(0.01, 10.0), draw.size(3.0, 1000.0)];
    let stop = inertia * rate / moment;
    let end = stop * draw.between(0.3, 0.8);
    let step = (end * draw.size(1e-4, 1e-2)).min(1.0 / rate);
    let text = format!(
        "lissom = 1\n[bodies.rotor]\nmass = 1\ninertia = [{inertia}, {inertia}, {inertia}]\n[joints.j]\nkind = \"revolute\"\nbase = \"ground\"\n\
         tip = \"rotor\"\naxis = [0, 0, 1]\nrate = {rate}\nfriction = {{ coulomb = {moment} }}\n[outputs.q]\nkind = \"relative\"\nof = \"j\"\n\
         [outputs.heat]\nkind = \"work\"\nof = \"j\"\n[analysis]\nkind = \"dynamics\"\nend = {end}\nscheme = \"{scheme}\"\nstep = {}\n",
        end / (end / step).ceil(),
    );
    let angle = rate * end - 0.5 * moment / inertia * end * end;
    // The bristle shifts the position by a deflection at most.
    let shift = 2e-4 + 2e-3 * angle;
    let expected =
        vec![("q.angle".to_owned(), angle, shift), ("heat.work".to_owned(), -moment * angle, moment * shift)];
    Case::of(text, expected)
}

/// A mass oscillates on a law about its free length beside another one at rest, and beside a state at rest far from zero.
fn rest(draw: &mut Draw) -> Case {
    let [mass, stiffness, speed] = [draw.size(0.1, 10.0), draw.size(100.0, 1e4), draw.size(1e-3, 1.0)];
    let level = draw.of(&[0.0, 1e-3, 101_325.0, 1e9]);
    let rate = (stiffness / mass).sqrt();
    let end = 10.0 / rate;
    let slide = |name: &str, speed: f64| {
        format!(
            "[bodies.{name}]\nmass = {mass}\ninertia = [1, 1, 1]\n[joints.{name}]\nkind = \"prismatic\"\nbase = \"ground\"\ntip = \"{name}\"\naxis = [1, 0, 0]\n\
             velocity = {speed}\n[springs.{name}]\nkind = \"axial\"\njoint = \"{name}\"\nforce = \"{stiffness}*elongation\"\n"
        )
    };
    let text = format!(
        "lissom = 1\n{}{}[states.c]\nderivative = \"{rate}*({level} - c)*(1 + abs(c - {level}))\"\nstart = {level}\n[outputs.q]\nkind = \"relative\"\nof = \"a\"\n\
         [outputs.still]\nkind = \"relative\"\nof = \"b\"\n[outputs.c]\nkind = \"signal\"\nof = \"c\"\n[analysis]\nkind = \"dynamics\"\nend = {end}\n",
        slide("a", speed),
        slide("b", 0.0),
    );
    let amplitude = speed / rate;
    let expected = vec![
        ("q.displacement".to_owned(), amplitude * (rate * end).sin(), 2e-3 * amplitude),
        ("still.displacement".to_owned(), 0.0, 1e-9 * amplitude),
        ("c.value".to_owned(), level, 1e-9 * level),
    ];
    Case { most_steps: MOST_STEPS, ..Case::of(text, expected) }
}

/// Tries models; whether none ended well with a wrong result, and few were reported.
pub(crate) fn exact(arguments: &CaseArguments) -> bool {
    let case = |index| Case::new(arguments.seed, index);
    if arguments.text {
        print!("{}", case(arguments.first).text);
        return true;
    }
    let found = results(arguments.range(), arguments.threads, None, |index| trial(&case(index)));
    let (mut reported, mut wrong) = (0_u32, 0_u32);
    for (index, outcome) in &found {
        match outcome {
            Ok(()) => {}
            Err((true, words)) => {
                wrong += 1;
                println!("{index}: {words}");
            }
            Err((false, words)) => {
                reported += 1;
                println!("{index}: reported: {words}");
            }
        }
    }
    println!("{} models of seed {}: {reported} reported, {wrong} wrong", found.len(), arguments.seed);
    wrong == 0 && f64::from(reported) <= 0.05 * found.len() as f64
}

/// Whether a failure is a wrong result rather than a reported one, and what it is.
type Failure = (bool, String);

fn trial(case: &Case) -> Result<(), Failure> {
    let reported = |words: String| (false, words);
    let model = Model::from_text("model.toml", &case.text);
    let mut session = model.session().map_err(|error| reported(error.to_string()))?;
    let (record, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    if let Some(error) = report.error() {
        return Err(reported(error.to_string()));
    }
    if let Some(warning) = session.warnings().next() {
        return Err(reported(warning.code().to_owned()));
    }
    let steps = record.times.len();
    if steps > case.most_steps {
        return Err((true, format!("{steps} steps")));
    }
    for (column, value, allowed) in &case.expected {
        let (output, component) = column.split_once('.').expect("a column of an output");
        let found = record.column(output, component).and_then(|column| column.last().copied());
        let found = found.ok_or_else(|| reported(format!("no column `{column}`")))?;
        // A gap may be open, but not deep.
        let error = if column == "f.gap" { (-found).max(0.0) } else { (found - value).abs() };
        if error.is_nan() || error > *allowed {
            return Err((true, format!("`{column}` is {found} instead of {value}, beyond {allowed:.1e}")));
        }
    }
    Ok(())
}
