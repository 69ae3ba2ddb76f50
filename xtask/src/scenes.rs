//! The scenes that speed is measured on, as texts of model files by name. Independent of simulation.
//!
//! Dimensions and initial motions are those of published comparisons of multibody programs, so that the names
//! mean the same everywhere.

use std::fmt::Write;

/// A scene in a few words, and its text.
pub(crate) struct Scene {
    /// Name of its file, without the ending.
    pub(crate) name: String,
    /// The model file.
    pub(crate) text: String,
}

/// Names of the scenes that are kept as files.
pub(crate) const KEPT: &[&str] = &[
    "planar-pendulum",
    "chain-s-10",
    "chain-s-100",
    "chain-r-10",
    "chain-r-100",
    "soft-beam-8",
    "soft-beam-64",
    "soft-beam-512",
    "soft-beam-cubic-3",
    "soft-beam-cubic-21",
    "soft-beam-cubic-171",
    "aluminium-8",
    "aluminium-64",
    "aluminium-512",
    "aluminium-cubic-3",
    "aluminium-cubic-21",
    "aluminium-cubic-171",
    "tip-crank-1e-3",
    "tip-crank-1e-4",
    "tip-crank-1e-5",
    "rotor",
    "loops-4",
    "beam-net-4",
    "andrews",
];

/// Names of the larger scenes, made on request.
pub(crate) const LARGE: &[&str] =
    &["chain-s-1000", "chain-s-10000", "chain-r-1000", "chain-r-10000", "loops-30", "beam-net-100"];

/// The scene of that name; none where the name means nothing.
pub(crate) fn scene(name: &str) -> Option<Scene> {
    let text = match name {
        "planar-pendulum" => pendulum(),
        "andrews" => andrews(),
        "rotor" => rotor(),
        _ => {
            if let Some(step) = name.strip_prefix("tip-crank-") {
                tip_crank(step)?
            } else {
                let (family, size) = name.rsplit_once('-')?;
                of_family(family, size.parse().ok().filter(|size| *size > 0)?)?
            }
        }
    };
    Some(Scene { name: name.to_owned(), text })
}

fn of_family(family: &str, size: usize) -> Option<String> {
    match family {
        "chain-s" => Some(chain(false, size)),
        "chain-r" => Some(chain(true, size)),
        "soft-beam" => Some(beam(&SOFT, size, 1)),
        "soft-beam-cubic" => Some(beam(&SOFT, size, 3)),
        "aluminium" => Some(beam(&ALUMINIUM, size, 1)),
        "aluminium-cubic" => Some(beam(&ALUMINIUM, size, 3)),
        "loops" => Some(loops(size)),
        "beam-net" => Some(beam_net(size)),
        "pile" => Some(pile(size)),
        _ => None,
    }
}

/// A text under construction. Writing to a string cannot fail.
struct Text(String);

impl Text {
    fn new(comment: &str, title: &str) -> Self {
        Self(format!("# {comment}\nlissom = 1\ntitle = \"{title}\"\n"))
    }

    fn add(&mut self, part: std::fmt::Arguments<'_>) {
        let _ = self.0.write_fmt(part);
    }

    fn position_of(&mut self, name: &str, node: &str) {
        self.add(format_args!("\n[outputs.{name}]\nkind = \"position\"\nof = \"{node}\"\n"));
    }

    /// Second order, as the programs it is compared with. Iterations end at a millionth of what a step finds out,
    /// far below the error of the step.
    fn generalized_alpha(mut self, step: &str, end: f64, every: usize) -> String {
        self.add(format_args!(
            "\n[analysis]\nkind = \"dynamics\"\nscheme = \"generalized-alpha\"\nspectral_radius = 0.8\n\
             end = {end:?}\nstep = {step}\ntolerance = 1e-6\noutput_every = {every}\n",
        ));
        self.0
    }
}

fn pendulum() -> String {
    let mut text = Text::new("A point mass in the plane on a rigid rod, released level.", "Planar pendulum");
    text.add(format_args!(
        "gravity = [0, -9.81, 0]\n\n\
         [point_masses.bob]\nmass = 1.0\nposition = [1, 0, 0]\nplane = \"xy\"\n\n\
         [joints.rod]\nkind = \"distance\"\nbase = \"ground\"\ntip = \"bob\"\nat_base = [0, 0, 0]\n"
    ));
    text.position_of("last", "bob");
    text.add(format_args!("\n[outputs.rod]\nkind = \"reaction\"\nof = \"rod\"\n"));
    // A hundred seconds without friction: what the iterations leave out adds up.
    text.generalized_alpha("1e-3", 100.0, 1000).replace("tolerance = 1e-6", "tolerance = 1e-8")
}

/// Time that a chain is followed, fewer steps for longer ones [s], and steps between records.
fn span_of_chain(bodies: usize) -> (f64, usize) {
    match bodies {
        0..1000 => (1.0, 100),
        1000..10_000 => (0.2, 20),
        10_000..100_000 => (0.05, 50),
        _ => (0.02, 20),
    }
}

/// `bodies` boxes of steel, end to end: spherical joints in a straight row that turns about z, or revolute
/// joints in a zigzag, the axes in turn across and along z.
fn chain(revolute: bool, bodies: usize) -> String {
    const SIZE: [f64; 3] = [0.1, 0.02, 0.01];
    let mass = 7800.0 * SIZE.iter().product::<f64>();
    let [x, y, z] = SIZE.map(|side| side * side * mass / 12.0);
    let (comment, title) = if revolute {
        ("Boxes joined by revolute joints in a zigzag, released from rest.", "Chain with revolute joints")
    } else {
        ("Boxes joined by spherical joints in a straight row that turns.", "Chain with spherical joints")
    };
    let mut text = Text::new(comment, &format!("{title}, {bodies} bodies"));
    text.add(format_args!("gravity = [0, 0, -9.81]\n"));
    if !revolute {
        text.add(format_args!("\n[initial]\nangular_velocity = [0, 0, {:?}]\n", 10.0 / bodies as f64));
    }
    let mut joints = Text(String::new());
    let mut start = [0.0_f64, 0.0];
    for body in 0..bodies {
        let even = body % 2 == 0;
        let angle = match (revolute, even) {
            (false, _) => 0.0,
            (true, true) => 20.0_f64.to_radians(),
            (true, false) => -20.0_f64.to_radians(),
        };
        let along = [SIZE[0] * angle.cos(), SIZE[0] * angle.sin()];
        text.add(format_args!(
            "\n[bodies.b{body}]\nmass = {mass:?}\ninertia = [{:?}, {:?}, {:?}]\nposition = [{:?}, {:?}, 0]\n",
            y + z,
            x + z,
            x + y,
            start[0] + 0.5 * along[0],
            start[1] + 0.5 * along[1],
        ));
        if revolute {
            text.add(format_args!("rotation = [0, 0, {angle:?}]\n"));
        }
        let base = if body == 0 { "ground".to_owned() } else { format!("b{}", body - 1) };
        let kind = if revolute { "revolute" } else { "spherical" };
        joints.add(format_args!(
            "\n[joints.j{body}]\nkind = \"{kind}\"\nbase = \"{base}\"\ntip = \"b{body}\"\n\
             at = [{:?}, {:?}, 0]\n",
            start[0], start[1]
        ));
        if revolute && even {
            joints.add(format_args!("axis = [{:?}, {:?}, 0]\n", -angle.sin(), angle.cos()));
        } else if revolute {
            joints.add(format_args!("axis = [0, 0, 1]\n"));
        }
        start = [start[0] + along[0], start[1] + along[1]];
    }
    text.add(format_args!("{}", joints.0));
    text.position_of("last", &format!("b{}", bodies - 1));
    let (end, every) = span_of_chain(bodies);
    text.generalized_alpha("1e-3", end, every)
}

/// A round beam, 1 m long, in gravity.
struct Round {
    title: &'static str,
    comment: &'static str,
    /// E [Pa], ν, density [kg/m³], shear coefficient.
    material: [f64; 4],
    joint: &'static str,
}

const SOFT: Round = Round {
    title: "Soft beam pendulum",
    comment: "A soft round beam, pinned at one end and released level.",
    material: [5e6, 0.5, 1100.0, 1.0],
    joint: "spherical",
};

const ALUMINIUM: Round = Round {
    title: "Aluminium cantilever",
    comment: "A thin round cantilever, on which gravity acts from the start.",
    material: [70e9, 0.3, 2700.0, 0.9],
    joint: "clamp",
};

fn material(text: &mut Text, [young, poisson, density, shear]: [f64; 4], radius: f64) {
    text.add(format_args!(
        "\n[materials.rod]\nE = {young:e}\nnu = {poisson}\ndensity = {density}\n\n\
         [sections.rod]\nshape = \"circle\"\nmaterial = \"rod\"\nradius = {radius}\nshear = {shear:?}\n"
    ));
}

fn beam(of: &Round, elements: usize, order: usize) -> String {
    let mut text = Text::new(of.comment, &format!("{}, {elements} elements", of.title));
    text.add(format_args!("gravity = [0, -9.81, 0]\n"));
    material(&mut text, of.material, 0.005);
    text.add(format_args!(
        "\n[beams.rod]\nsection = \"rod\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = {elements}\norder = {order}\n\n\
         [joints.root]\nkind = \"{}\"\nbase = \"ground\"\ntip = \"rod.start\"\n",
        of.joint
    ));
    text.position_of("tip", "rod.end");
    let (end, every) = match elements * order {
        0..500 => (1.0, 100),
        500..3000 => (0.1, 100),
        _ => (0.02, 20),
    };
    text.generalized_alpha("1e-3", end, every)
}

/// Balls of 0.5 kg that fall into a box for one second, in layers that are shifted irregularly.
fn pile(balls: usize) -> String {
    const RADIUS: f64 = 0.05;
    let side = (balls as f64).cbrt().round().max(1.0) as usize;
    let mut text = Text::new("Balls fall into a box and rest in the end.", &format!("Pile of {balls} balls"));
    let wall = 1.1 * RADIUS * side as f64;
    let plane = |normal: &str, x: f64, y: f64| {
        format!("    {{ kind = \"plane\", normal = \"{normal}\", position = [{x:?}, {y:?}, 0] }},\n")
    };
    let walls = [("z", 0.0, 0.0), ("x", -wall, 0.0), ("-x", wall, 0.0), ("y", 0.0, -wall), ("-y", 0.0, wall)];
    let walls = walls.map(|(normal, x, y)| plane(normal, x, y)).concat();
    text.add(format_args!("gravity = [0, 0, -9.81]\n\n[ground]\nshape = [\n{walls}]\n"));
    for ball in 0..balls {
        let aside = |rate: f64| 0.04 * (rate * (ball + 1) as f64).sin();
        let across = |index: usize, rate: f64| 2.1 * (index as f64 - 0.5 * (side - 1) as f64) + aside(rate);
        let [x, y] = [across(ball % side, 12.9898), across(ball / side % side, 78.233)];
        let z = 2.3 * (ball / (side * side)) as f64 + 1.58 + aside(37.719);
        let [x, y, z] = [x, y, z].map(|place| RADIUS * place);
        text.add(format_args!(
            "\n[bodies.b{ball}]\nmass = 0.5236\ninertia = {{ sphere = {RADIUS} }}\nshape = {{ sphere = {RADIUS} }}\n\
             position = [{x:.6}, {y:.6}, {z:.6}]\n",
        ));
    }
    let others: Vec<String> = (1..balls).map(|ball| format!("\"b{ball}\"")).collect();
    text.add(format_args!(
        "\n[contacts.pile]\nbase = \"ground\"\ntip = \"b0\"\nothers = [{}]\nstiffness = 1e6\ndissipation = 0.3\n\
         friction = 0.4\n\n[analysis]\nkind = \"dynamics\"\nscheme = \"backward-euler\"\nstep = 1e-3\nend = 1\n",
        others.join(", "),
    ));
    text.0
}

/// The tip crank of the examples with as many cubic elements as make 24 intervals between nodes.
fn tip_crank(step: &str) -> Option<String> {
    let size: f64 = step.parse().ok().filter(|size| *size > 0.0)?;
    let text = include_str!("../../examples/tip-crank.toml");
    let (model, _) = text.split_once("[outputs.").unwrap_or((text, ""));
    let model = ["8", "2", "4", "2"].iter().zip(["4", "1", "2", "1"]).fold(
        (String::new(), model),
        |(done, rest), (from, to)| {
            let from = format!("elements = {from}\n");
            match rest.split_once(from.as_str()) {
                Some((before, after)) => (format!("{done}{before}elements = {to}\n"), after),
                None => (done, rest),
            }
        },
    );
    let mut text = Text(format!("{}{}", model.0, model.1));
    text.add(format_args!("[outputs.midspan]\nkind = \"displacement\"\nof = \"beam@0.5\"\n"));
    let every = (1e-2 / size).round() as usize;
    Some(text.generalized_alpha(step, 0.4, every))
}

/// Four cantilevers on a hub that turns ten times.
fn rotor() -> String {
    let mut text = Text::new("Four blades clamped to a hub that is driven through ten revolutions.", "Rotor");
    material(&mut text, [70e9, 0.3, 2700.0, 0.9], 0.02);
    text.add(format_args!(
        "\n[bodies.hub]\nmass = 5.0\ninertia = [0.1, 0.1, 0.1]\n\n\
         [joints.bearing]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"hub\"\nat = [0, 0, 0]\naxis = [0, 0, 1]\n\n\
         [joints.drive]\nkind = \"prescribed_rotation\"\njoint = \"bearing\"\n\
         rotation = \"40*pi/3*(max(t-1, 0) + 0.5*(min(t, 1) - sin(pi*min(t, 1))/pi))\"\n"
    ));
    for (k, [x, y]) in [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]].into_iter().enumerate() {
        text.add(format_args!(
            "\n[beams.blade{k}]\nsection = \"rod\"\nfrom = [{:?}, {:?}, 0]\nto = [{x:?}, {y:?}, 0]\nelements = 3\n\n\
             [joints.root{k}]\nkind = \"clamp\"\nbase = \"hub\"\ntip = \"blade{k}.start\"\n",
            0.1 * x,
            0.1 * y
        ));
    }
    text.position_of("tip", "blade0.end");
    text.generalized_alpha("1e-3", 2.0, 100)
}

/// A level net of rigid bars with square meshes, hung at one corner: every mesh is a closed loop.
fn loops(cells: usize) -> String {
    const SIDE: f64 = 0.1;
    let mut text = Text::new(
        "A level net of rigid bars joined by spherical joints, hung at one corner: every mesh closes a loop.",
        &format!("Net of bars, {cells} x {cells} meshes"),
    );
    text.add(format_args!("gravity = [0, 0, -9.81]\n"));
    let mut joints = Text(String::new());
    // The first bar that ends in a knot carries the others.
    let mut carriers = vec![None::<String>; (cells + 1) * (cells + 1)];
    carriers[0] = Some("ground".to_owned());
    let mut last = String::new();
    for i in 0..=cells {
        for j in 0..=cells {
            for across in [false, true] {
                let (k, l) = if across { (i, j + 1) } else { (i + 1, j) };
                if k > cells || l > cells {
                    continue;
                }
                let name = format!("{}{i}_{j}", if across { "y" } else { "x" });
                let middle = [i + k, j + l].map(|sum| 0.5 * SIDE * sum as f64);
                let turn = if across { std::f64::consts::FRAC_PI_2 } else { 0.0 };
                text.add(format_args!(
                    "\n[bodies.{name}]\nmass = 0.1\ninertia = [1e-5, 1e-4, 1e-4]\n\
                     position = [{:?}, {:?}, 0]\nrotation = [0, 0, {turn:?}]\n",
                    middle[0], middle[1]
                ));
                for (a, b) in [(i, j), (k, l)] {
                    let carrier = &mut carriers[a * (cells + 1) + b];
                    if let Some(base) = carrier {
                        joints.add(format_args!(
                            "\n[joints.{name}_{a}_{b}]\nkind = \"spherical\"\nbase = \"{base}\"\ntip = \"{name}\"\n\
                             at = [{:?}, {:?}, 0]\n",
                            SIDE * a as f64,
                            SIDE * b as f64
                        ));
                    } else {
                        *carrier = Some(name.clone());
                    }
                }
                last = name;
            }
        }
    }
    text.add(format_args!("{}", joints.0));
    text.position_of("last", &last);
    let end = if cells < 10 { 0.5 } else { 0.1 };
    text.generalized_alpha("1e-3", end, 100)
}

/// A level net of soft beams with square meshes, clamped at two corners.
fn beam_net(cells: usize) -> String {
    const SIDE: f64 = 0.1;
    let mut text = Text::new(
        "A level net of soft beams, one element to the side of a mesh, clamped at two corners.",
        &format!("Net of beams, {cells} x {cells} meshes"),
    );
    text.add(format_args!("gravity = [0, 0, -9.81]\n"));
    material(&mut text, [5e6, 0.5, 1100.0, 1.0], 0.005);
    let length = SIDE * cells as f64;
    for i in 0..=cells {
        text.add(format_args!(
            "\n[beams.r{i}]\nsection = \"rod\"\nfrom = [0, {0:?}, 0]\nto = [{length:?}, {0:?}, 0]\n\
             elements = {cells}\norder = 1\nup = [0, 0, 1]\n",
            SIDE * i as f64
        ));
    }
    let fraction = |j: usize| match j {
        0 => ".start".to_owned(),
        j if j == cells => ".end".to_owned(),
        j => format!("@{:?}", j as f64 / cells as f64),
    };
    for i in 0..cells {
        for j in 0..=cells {
            text.add(format_args!(
                "\n[beams.c{i}_{j}]\nsection = \"rod\"\nfrom = \"r{i}{1}\"\nto = \"r{0}{1}\"\nelements = 1\norder = 1\n\
                 up = [0, 0, 1]\n",
                i + 1,
                fraction(j)
            ));
        }
    }
    text.add(format_args!(
        "\n[joints.left]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"r0.start\"\n\n\
         [joints.right]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"r0.end\"\n"
    ));
    text.position_of("last", &format!("r{cells}.end"));
    let end = if cells < 10 { 0.5 } else { 0.02 };
    text.generalized_alpha("1e-3", end, 20)
}

/// The mechanism of the verification at a step that gives six digits.
fn andrews() -> String {
    let text = include_str!("../../verification/andrews-squeezer/model.toml");
    let (model, _) = text.split_once("[analysis]").unwrap_or((text, ""));
    format!(
        "{model}[analysis]\nkind = \"dynamics\"\nscheme = \"radau-iia\"\nend = 0.03\nstep = 5e-5\noutput_every = 600\n\
         tolerance = 1e-6\n"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kept_files_are_what_the_generator_writes() {
        for name in KEPT {
            let path = format!("{}/../benches/scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
            let file = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
            assert_eq!(file, scene(name).unwrap().text, "{name}: run `cargo xtask scenes`");
        }
    }

    #[test]
    fn every_scene_is_a_model() {
        for name in KEPT.iter().chain(&["pile-12"]) {
            let scene = scene(name).unwrap();
            let model = lissom::Model::from_text(&scene.name, &scene.text);
            model.document().unwrap_or_else(|report| panic!("{name}: {}", report.render(false)));
        }
    }

    #[test]
    fn names_without_meaning_give_nothing() {
        for name in ["", "chain", "chain-s", "chain-s-0", "chain-t-3", "tip-crank-x"] {
            assert!(scene(name).is_none(), "{name}");
        }
    }
}
