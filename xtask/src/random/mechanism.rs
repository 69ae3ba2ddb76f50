//! A random mechanism as the text of a model: bodies and beams in a tree of joints, loops, couplings, drives, springs,
//! friction, stops and loads. It starts at rest, so that nothing has to agree with the joints but zero.

mod bearings;
mod oscillators;
mod runners;

use std::fmt::Write as _;

use super::draw::Draw;

/// A mechanism.
#[derive(Clone, Debug)]
pub(super) struct Mechanism {
    /// Tables of the model, which can be omitted one by one as long as nothing names them.
    pub(super) tables: Vec<String>,
    /// Whether energy is conserved.
    pub(super) is_conservative: bool,
    /// Whether nothing touches the ground and nothing pulls from outside.
    pub(super) is_free: bool,
}

impl Mechanism {
    /// The model's text.
    pub(super) fn text(&self) -> String {
        let mut text = String::from("lissom = 1\n");
        for table in &self.tables {
            text.push('\n');
            text.push_str(table);
        }
        text
    }
}

/// A coordinate of a joint.
#[derive(Clone, Debug)]
struct Coordinate {
    joint: String,
    number: usize,
    component: &'static str,
    is_angle: bool,
}

/// Nodes to which later parts can be connected.
struct Node {
    name: String,
    place: [f64; 3],
}

struct Maker {
    draw: Draw,
    tables: Vec<String>,
    nodes: Vec<Node>,
    coordinates: Vec<Coordinate>,
    /// Names of beams, their starts and ends.
    beams: Vec<(String, [f64; 3], [f64; 3])>,
    is_conservative: bool,
    has_rotor: bool,
    has_latch: bool,
}

/// Joints of a tree; the first ones leave few degrees of freedom and are drawn more often.
const JOINTS: [&str; 18] = [
    "revolute",
    "revolute",
    "revolute",
    "cylindrical",
    "prismatic",
    "universal",
    "spherical",
    "spherical",
    "clamp",
    "rigid_link",
    "planar",
    "screw",
    "constant_velocity",
    "swing_arm",
    "generic",
    "parallel_axes",
    "point_on_line",
    "distance",
];
/// Joints that close a loop, and those that hardly hold.
const LOOPS: [&str; 6] =
    ["distance", "distance", "spherical", "point_in_plane", "inline", "perpendicular_axes"];

/// Turn a seed into those of the kinds which came later. The last three leave the cases of seed 7 as they are that the manual lists.
const LATER: u64 = 0x5bd1_e995;
const LATEST: u64 = 0x1b87_3593;
const OF_COORDINATES: u64 = 0xbf58_476d;
const OF_RUNNERS: u64 = 0xe6d5_c622;
const OF_BEARINGS: u64 = 0x2545_f491;

/// The mechanism of case `index` of `seed`.
pub(super) fn mechanism(seed: u64, index: u64) -> Mechanism {
    let mut maker = Maker {
        draw: Draw::new(seed, index),
        tables: Vec::new(),
        nodes: Vec::new(),
        coordinates: Vec::new(),
        beams: Vec::new(),
        is_conservative: true,
        has_rotor: false,
        has_latch: false,
    };
    let is_free = maker.draw.chance(0.08);
    if !is_free {
        let gravity = maker.draw.of(&["[0, 0, -9.81]", "[0, -9.81, 0]", "[3.0, 0, -5.0]", "[0, 0, 0]"]);
        maker.tables.push(format!("gravity = {gravity}\n"));
    }
    maker.parts(is_free);
    maker.loops();
    maker.couplings();
    maker.springs();
    maker.loads(is_free);
    if !is_free {
        // Kinds that came later draw numbers of their own, so that the cases of a seed stay what they were.
        maker.draw = Draw::new(seed ^ LATER, index);
        maker.wheel();
        maker.table();
        maker.draw = Draw::new(seed ^ LATEST, index);
        maker.rope();
        for of in maker.coordinates.clone() {
            maker.latch(&of);
        }
        maker.draw = Draw::new(seed ^ OF_COORDINATES, index);
        maker.oscillators();
        maker.draw = Draw::new(seed ^ OF_RUNNERS, index);
        maker.slipping_wheel();
        maker.bead();
        maker.draw = Draw::new(seed ^ OF_BEARINGS, index);
        maker.bearing();
        maker.strut();
    }
    for part in maker.nodes.iter().filter(|node| node.name != "ground").map(|node| &node.name) {
        let plain = part.replace(['.', '@'], "_");
        maker.tables.push(format!("[outputs.at_{plain}]\nkind = \"position\"\nof = \"{part}\"\n"));
        maker.tables.push(format!("[outputs.turn_{plain}]\nkind = \"quaternion\"\nof = \"{part}\"\n"));
        maker.tables.push(format!("[outputs.spin_{plain}]\nkind = \"angular_velocity\"\nof = \"{part}\"\n"));
    }
    maker.tables.push("[outputs.energy]\nkind = \"energy\"\n".to_owned());
    maker.tables.push("[outputs.momentum]\nkind = \"momentum\"\n".to_owned());
    maker
        .tables
        .push("[analysis]\nkind = \"dynamics\"\nend = 0.4\nstep = 1e-3\noutput_every = 20\n".to_owned());
    // The momentum that is recorded is that of the masses: a rotor's own is not in it.
    let is_free = is_free && !maker.has_rotor;
    Mechanism { tables: maker.tables, is_conservative: maker.is_conservative, is_free }
}

fn triple(v: [f64; 3]) -> String {
    format!("[{}, {}, {}]", short(v[0]), short(v[1]), short(v[2]))
}

/// Six digits after the point: texts and what is computed from them agree.
fn short(value: f64) -> f64 {
    let rounded = (value * 1e6).round() / 1e6;
    if rounded == 0.0 { 0.0 } else { rounded }
}

impl Maker {
    fn parts(&mut self, is_free: bool) {
        if !is_free {
            self.nodes.push(Node { name: "ground".to_owned(), place: [0.0; 3] });
        }
        let count = 1 + self.draw.below(6);
        let has_beam = self.draw.chance(0.25);
        if has_beam {
            self.tables.push(
                "[sections.bar]\nshape = \"general\"\nstiffness = [2e5, 8e4, 8e4, 40, 60, 60]\n\
                 mass = { per_length = 0.6, inertia = [4e-4, 2e-4, 2e-4] }\n"
                    .to_owned(),
            );
        }
        let mut beams = 0;
        for number in 1..=count {
            let parent = (!self.nodes.is_empty()).then(|| self.draw.below(self.nodes.len()));
            let from = parent.map_or([0.0; 3], |parent| self.nodes[parent].place);
            let step = [0, 1, 2].map(|_| {
                let size = self.draw.between(0.1, 0.5);
                if self.draw.chance(0.5) { size } else { -size }
            });
            let place = [0, 1, 2].map(|k| short(from[k] + step[k]));
            let node = if has_beam && beams < 2 && parent.is_some() && self.draw.chance(0.5) {
                beams += 1;
                self.beam(number, from, place, step)
            } else {
                self.body(number, place)
            };
            if let Some(parent) = parent {
                let base = self.nodes[parent].name.clone();
                let kind = self.draw.of(&JOINTS);
                let at = if node.1 && kind != "swing_arm" {
                    place_of_start(from, step)
                } else {
                    self.between(from, place)
                };
                self.joint(kind, &base, &node.0, at);
            }
            if node.1 {
                let name = node.0.replace(".start", ".end");
                self.nodes.push(Node { name, place });
            } else {
                self.nodes.push(Node { name: node.0, place });
            }
        }
    }

    /// Near the middle of two positions, but not on their line: a rod between the two would be stretched there.
    fn between(&mut self, from: [f64; 3], to: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| short(f64::midpoint(from[k], to[k]) + self.draw.between(-0.08, 0.08)))
    }

    /// A body; its node's name, and that it is no beam.
    fn body(&mut self, number: usize, place: [f64; 3]) -> (String, bool) {
        let mass = self.draw.size(0.3, 3.0);
        let sides = [0, 1, 2].map(|_| self.draw.between(0.15, 0.5));
        let moment = |a: f64, b: f64| short(mass * (a * a + b * b) / 12.0);
        let inertia = [moment(sides[1], sides[2]), moment(sides[2], sides[0]), moment(sides[0], sides[1])];
        let mut text = format!(
            "[bodies.b{number}]\nmass = {mass}\ninertia = {}\nposition = {}\n",
            triple(inertia),
            triple(place)
        );
        if self.draw.chance(0.5) {
            let turn = [0, 1, 2].map(|_| self.draw.between(-1.5, 1.5));
            let _ = writeln!(text, "rotation = {}", triple(turn));
        }
        if self.draw.chance(0.3) {
            let aside = [0, 1, 2].map(|_| self.draw.between(-0.05, 0.05));
            let _ = writeln!(text, "center_of_mass = {}", triple(aside));
        }
        self.tables.push(text);
        (format!("b{number}"), false)
    }

    /// A beam over the last four fifths of the way; its first node's name.
    fn beam(&mut self, number: usize, from: [f64; 3], to: [f64; 3], step: [f64; 3]) -> (String, bool) {
        let start = place_of_start(from, step);
        let order = 1 + self.draw.below(3);
        let elements = 1 + self.draw.below(3);
        self.tables.push(format!(
            "[beams.b{number}]\nsection = \"bar\"\nfrom = {}\nto = {}\nelements = {elements}\norder = {order}\n",
            triple(start),
            triple(to)
        ));
        self.beams.push((format!("b{number}"), start, to));
        (format!("b{number}.start"), true)
    }

    fn joint(&mut self, kind: &'static str, base: &str, tip: &str, at: [f64; 3]) {
        let name = format!("j{}", self.tables.len());
        let axis = self.draw.direction();
        let place = format!("at = {}\n", triple(at));
        let along = format!("axis = {}\n", triple(axis));
        let second = |draw: &mut Draw| format!("second_axis = {}\n", nine_digits(draw.perpendicular(axis)));
        let (rotation, slide) = (("angle", true), ("displacement", false));
        let (further, coordinates): (String, Vec<(&'static str, bool)>) = match kind {
            "revolute" | "parallel_axes" | "planar" | "swing_arm" => (place + &along, vec![rotation]),
            "prismatic" | "point_on_line" => (place + &along, vec![slide]),
            "cylindrical" => (place + &along, vec![rotation, slide]),
            "screw" => {
                let lead = self.draw.between(0.05, 0.4);
                (format!("{place}{along}lead = {lead}\n"), vec![rotation])
            }
            "universal" => {
                let second = second(&mut self.draw);
                (place + &along + &second, vec![("angle1", true), ("angle2", true)])
            }
            "perpendicular_axes" => {
                let second = second(&mut self.draw);
                (along + &second, Vec::new())
            }
            "generic" => {
                let all = ["x", "y", "z", "rx", "ry", "rz"];
                let mut locked: Vec<&str> = all.into_iter().filter(|_| self.draw.chance(0.6)).collect();
                if locked.is_empty() {
                    locked.push("x");
                }
                (format!("{place}locked = {locked:?}\n"), Vec::new())
            }
            "constant_velocity" | "point_in_plane" | "inline" => (place + &along, Vec::new()),
            "spherical" => (place, Vec::new()),
            _ => (String::new(), Vec::new()),
        };
        self.tables.push(format!(
            "[joints.{name}]\nkind = \"{kind}\"\nbase = \"{base}\"\ntip = \"{tip}\"\n{further}"
        ));
        let of = |(number, (component, is_angle)): (usize, (&'static str, bool))| Coordinate {
            joint: name.clone(),
            number: number + 1,
            component,
            is_angle,
        };
        self.coordinates.extend(coordinates.into_iter().enumerate().map(of));
    }

    fn loops(&mut self) {
        let count = [0, 0, 0, 1, 1, 2][self.draw.below(6)];
        for _ in 0..count {
            if self.nodes.len() < 3 {
                return;
            }
            let [a, b] = [0, 1].map(|_| self.draw.below(self.nodes.len()));
            if a == b {
                continue;
            }
            let kind = self.draw.of(&LOOPS);
            let (base, tip) = (self.nodes[a].name.clone(), self.nodes[b].name.clone());
            if tip == "ground" {
                continue;
            }
            let (from, to) = (self.nodes[a].place, self.nodes[b].place);
            let at = self.between(from, to);
            self.joint(kind, &base, &tip, at);
        }
    }

    fn couplings(&mut self) {
        if self.coordinates.len() >= 2 && self.draw.chance(0.15) {
            let first = self.draw.below(self.coordinates.len());
            let second = self.draw.below(self.coordinates.len());
            if first != second {
                let (a, b) = (self.coordinates[first].clone(), self.coordinates[second].clone());
                let ratio = self.draw.between(0.2, 1.5) * if self.draw.chance(0.5) { 1.0 } else { -1.0 };
                let name = format!("c{}", self.tables.len());
                let which = format!("coordinate = {}\nother_coordinate = {}\n", a.number, b.number);
                let pair = format!("joint = \"{}\"\nother = \"{}\"\n{which}", a.joint, b.joint);
                self.tables.push(match self.draw.below(3) {
                    0 => format!("[joints.{name}]\nkind = \"gear\"\n{pair}ratio = {ratio}\n"),
                    1 => format!("[joints.{name}]\nkind = \"cam\"\n{pair}profile = \"{ratio}*x + 0.1*sin(x)^2\"\n"),
                    _ => format!(
                        "[joints.{name}]\nkind = \"equation\"\nequation = \"{}.{} - {ratio}*{}.{} + 0.2*{}.{}^2\"\n",
                        b.joint, b.component, a.joint, a.component, a.joint, a.component
                    ),
                });
                return;
            }
        }
        if !self.coordinates.is_empty() && self.draw.chance(0.15) {
            let index = self.draw.below(self.coordinates.len());
            let of = self.coordinates.remove(index);
            let name = format!("d{}", self.tables.len());
            let size = self.draw.between(0.1, if of.is_angle { 1.2 } else { 0.2 });
            let (kind, key) = if of.is_angle {
                ("prescribed_rotation", "rotation")
            } else {
                ("prescribed_displacement", "displacement")
            };
            let function = match self.draw.below(2) {
                0 => format!("{size}*smoothstep(t/0.3)"),
                _ => format!("{size}*(1 - cos(9*t))/2"),
            };
            self.tables.push(format!(
                "[joints.{name}]\nkind = \"{kind}\"\njoint = \"{}\"\ncoordinate = {}\n{key} = \"{function}\"\n",
                of.joint, of.number
            ));
            self.is_conservative = false;
        }
    }

    /// Seldom, a latch that snaps in where the coordinate has gone a little.
    fn latch(&mut self, of: &Coordinate) {
        if self.has_latch || !self.draw.chance(0.05) {
            return;
        }
        self.is_conservative = false;
        self.has_latch = true;
        let (kind, at) = if of.is_angle { ("torsional_latch", 0.03) } else { ("axial_latch", 0.01) };
        let (joint, number, passed) = (&of.joint, of.number, format!("{}.{} - {at}", of.joint, of.component));
        self.tables.push("[inputs]\nlatched = 0\n".to_owned());
        self.tables.push(format!(
            "[springs.latch]\nkind = \"{kind}\"\njoint = \"{joint}\"\ncoordinate = {number}\nengaged = \"latched\"\n"
        ));
        self.tables.push(format!("[events.latch]\nzero_of = \"{passed}\"\nset = {{ latched = 1 }}\n"));
    }

    /// Seldom, a rope from one part over another to a third, mostly taut.
    fn rope(&mut self) {
        let [a, over, b] = [0; 3].map(|_| self.draw.below(self.nodes.len()));
        if a == b || over == a || over == b || !self.draw.chance(0.15) {
            return;
        }
        // With hundreds of newtons per metre parts of a few hundred grams tumble faster than steps of 1 ms resolve.
        let stiffness = self.draw.size(3.0, 50.0);
        let along = [a, over, b].map(|node| format!("{{ on = \"{}\" }}", self.nodes[node].name));
        let length = if self.draw.chance(0.5) { "length = 0.1\n" } else { "" };
        // Where it goes slack, steps of one size miss when.
        self.is_conservative &= !length.is_empty();
        self.tables.push(format!(
            "[springs.rope]\nkind = \"rope\"\nalong = [{}]\nstiffness = {stiffness}\n{length}",
            along.join(", ")
        ));
    }

    fn springs(&mut self) {
        for of in self.coordinates.clone() {
            if self.draw.chance(0.4) {
                let name = format!("s{}", self.tables.len());
                let (kind, stiffness) = if of.is_angle {
                    ("torsional", self.draw.size(0.5, 15.0))
                } else {
                    ("axial", self.draw.size(20.0, 500.0))
                };
                let mut text = format!(
                    "[springs.{name}]\nkind = \"{kind}\"\njoint = \"{}\"\ncoordinate = {}\nstiffness = {stiffness}\n",
                    of.joint, of.number
                );
                if self.draw.chance(0.3) {
                    let _ = writeln!(text, "damping = {}", short(stiffness * self.draw.between(0.002, 0.02)));
                    self.is_conservative = false;
                }
                self.tables.push(text);
            }
            if self.draw.chance(0.08) {
                self.is_conservative = false;
                let name = format!("f{}", self.tables.len());
                let (kind, force) = if of.is_angle {
                    ("torsional_friction", self.draw.size(0.02, 0.5))
                } else {
                    ("axial_friction", self.draw.size(0.2, 5.0))
                };
                let deflection = self.draw.of(&[1e-2, 3e-3]);
                self.tables.push(format!(
                    "[springs.{name}]\nkind = \"{kind}\"\njoint = \"{}\"\ncoordinate = {}\ncoulomb = {force}\n\
                     deflection = {deflection}\nviscous = {}\n",
                    of.joint,
                    of.number,
                    short(force * 0.1)
                ));
            }
            if self.draw.chance(0.08) {
                self.is_conservative = false;
                let name = format!("e{}", self.tables.len());
                let (kind, stiffness, range) = if of.is_angle {
                    ("torsional_stop", self.draw.size(50.0, 500.0), [-0.3, 0.4])
                } else {
                    ("axial_stop", self.draw.size(2e3, 2e4), [-0.05, 0.08])
                };
                self.tables.push(format!(
                    "[springs.{name}]\nkind = \"{kind}\"\njoint = \"{}\"\ncoordinate = {}\nrange = {range:?}\n\
                     stiffness = {stiffness}\ndissipation = 0.5\n",
                    of.joint, of.number
                ));
            }
        }
        for _ in 0..self.draw.below(3) {
            let [a, b] = [0, 1].map(|_| self.draw.below(self.nodes.len()));
            if a == b {
                continue;
            }
            let name = format!("p{}", self.tables.len());
            let pair = format!("base = \"{}\"\ntip = \"{}\"\n", self.nodes[a].name, self.nodes[b].name);
            if self.draw.chance(0.75) {
                let stiffness = self.draw.size(10.0, 300.0);
                let damping = if self.draw.chance(0.3) { short(stiffness * 0.01) } else { 0.0 };
                self.is_conservative &= damping == 0.0;
                self.tables.push(format!(
                    "[springs.{name}]\nkind = \"point\"\n{pair}stiffness = {stiffness}\ndamping = {damping}\n"
                ));
            } else {
                self.is_conservative = false;
                let [k, c] = [self.draw.size(20.0, 300.0), self.draw.size(0.5, 10.0)];
                self.tables.push(format!(
                    "[springs.{name}]\nkind = \"bushing\"\n{pair}stiffness = [{k}, {k}, {k}, {c}, {c}, {c}]\n\
                     damping = [{d}, {d}, {d}, {e}, {e}, {e}]\n",
                    d = short(k * 0.01),
                    e = short(c * 0.01)
                ));
            }
        }
    }

    /// A part that is moved as a whole, with a spring to another, and at times a body on it.
    fn table(&mut self) {
        if !self.draw.chance(0.08) {
            return;
        }
        self.is_conservative = false;
        let place = [0, 1, 2].map(|_| self.draw.between(-0.5, 0.5));
        let (name, _) = self.body(91, place);
        let mut moved = String::new();
        for (key, size) in [("x", 0.05), ("y", 0.05), ("z", 0.05), ("rx", 0.3), ("ry", 0.2), ("rz", 0.3)] {
            if self.draw.chance(0.4) {
                let function = self.draw.of(&["smoothstep(t/0.3)", "(1 - cos(9*t))/2", "sin(6*t)^2"]);
                let _ = writeln!(moved, "{key} = \"{}*{function}\"", self.draw.between(-size, size));
            }
        }
        if moved.is_empty() {
            moved.push_str("x = \"0.1*sin(6*t)^2\"\n");
        }
        self.tables.push(format!(
            "[joints.moved]\nkind = \"prescribed_motion\"\nbase = \"ground\"\ntip = \"{name}\"\n{moved}"
        ));
        if self.draw.chance(0.5) {
            let further = [0, 1, 2].map(|k| short(place[k] + self.draw.between(0.1, 0.4)));
            let (body, _) = self.body(92, further);
            let kind = self.draw.of(&JOINTS);
            let at = self.between(place, further);
            self.joint(kind, &name, &body, at);
            self.nodes.push(Node { name: body, place: further });
        } else {
            self.pulled(&name);
        }
        self.nodes.push(Node { name, place });
    }

    /// A spring from any other part.
    fn pulled(&mut self, name: &str) {
        let from = self.draw.below(self.nodes.len());
        let (base, stiffness) = (self.nodes[from].name.clone(), self.draw.size(10.0, 300.0));
        self.tables.push(format!(
            "[springs.p{}]\nkind = \"point\"\nbase = \"{base}\"\ntip = \"{name}\"\nstiffness = {stiffness}\n",
            self.tables.len()
        ));
    }

    fn loads(&mut self, is_free: bool) {
        let parts: Vec<String> =
            self.nodes.iter().filter(|node| node.name != "ground").map(|node| node.name.clone()).collect();
        if !is_free && self.draw.chance(0.5) {
            self.is_conservative = false;
            let on = self.draw.of(&parts);
            let (kind, size) = self.draw.of(&[("force", 8.0), ("moment", 1.0)]);
            let vector = self.draw.direction().map(|part| short(part * size));
            let scale = self.draw.of(&["1", "sin(8*t)", "smoothstep(t/0.2)"]);
            let follower = self.draw.chance(0.4);
            let name = format!("l{}", self.tables.len());
            self.tables.push(format!(
                "[loads.{name}]\nkind = \"{kind}\"\non = \"{on}\"\nvector = {}\nscale = \"{scale}\"\nfollower = {follower}\n",
                triple(vector)
            ));
        }
        if !self.coordinates.is_empty() && (is_free || self.draw.chance(0.2)) {
            self.is_conservative = false;
            let of = self.draw.of(&self.coordinates.clone());
            let name = format!("l{}", self.tables.len());
            let (kind, key, size) =
                if of.is_angle { ("joint_torque", "torque", 1.0) } else { ("joint_force", "force", 8.0) };
            self.tables.push(format!(
                "[loads.{name}]\nkind = \"{kind}\"\njoint = \"{}\"\ncoordinate = {}\n{key} = \"{size}*sin(7*t)\"\n",
                of.joint, of.number
            ));
        }
        if self.draw.chance(0.06) {
            self.has_rotor = true;
            let on = self.draw.of(&parts);
            let axis = self.draw.direction();
            let name = format!("l{}", self.tables.len());
            self.tables.push(format!(
                "[loads.{name}]\nkind = \"gyrostat\"\non = \"{on}\"\naxis = {}\ninertia = 2e-3\nspin = 50\n",
                triple(axis)
            ));
        }
        if !is_free && parts.len() > 1 && self.draw.chance(0.1) {
            self.is_conservative = false;
            let [base, tip] = [0, 1].map(|_| self.draw.of(&parts));
            if base != tip {
                self.tables.push(format!(
                    "[loads.l{}]\nkind = \"force_between\"\nbase = \"{base}\"\ntip = \"{tip}\"\nforce = \"4*sin(5*t)\"\n",
                    self.tables.len()
                ));
            }
        }
    }
}

/// Nine digits: what has to be perpendicular is so to more than a model asks for.
fn nine_digits(v: [f64; 3]) -> String {
    format!("[{:.12}, {:.12}, {:.12}]", v[0], v[1], v[2])
}

fn place_of_start(from: [f64; 3], step: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| short(from[k] + step[k] / 5.0))
}
