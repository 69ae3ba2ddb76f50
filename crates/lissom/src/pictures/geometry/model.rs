//! Geometry of a whole model: its parts, symbols and loads as pieces fixed to nodes.

use lissom_model::output::Shade;
use lissom_model::scene::{Anchor, Body, Load, Scene, Surface, Symbol, Table, Tone};
use lissom_motion::{Motion as Pose, Rotation, Vector3};

use super::mesh::{Mesh, turn_to};
use super::sweep::{Sweep, between};
use crate::motion::Motion;
use lissom_core::kinematics::{GROUND, NodeId};

/// Minimum half thickness of a section in a picture, relative to the model.
const MIN_THICKNESS: f64 = 0.0045;
/// Minimum half thickness for true dimensions: sections of zero thickness have no surface.
const MIN_TRUE: f64 = 1e-4;
/// Minimum side of a box of a body, relative to the model.
const MIN_SIDE: f64 = 0.003;
/// Boxes whose second side exceeds the reach of the attachments by this factor are drawn smaller.
const BULKY: f64 = 2.5;
/// Size of a model of one body, relative to the body.
const ABOUT_BODIES: f64 = 1.5;
/// Turns of the coil of a spring.
const TURNS: f64 = 9.0;

/// Kinds of joints that slide along their first axis.
const SLIDING: [&str; 2] = ["prismatic", "cylindrical"];
/// Half length of their symbol, width of a rail, and side and thickness of the plates at its ends, in radii of the symbol.
const HALF_SLIDER: f64 = 2.3;
const RAIL: f64 = 0.4;
const RAIL_PLATE: [f64; 2] = [2.2, 0.35];
/// Length of a rail at most, relative to the model: a longer one would make the picture of a vehicle as wide as its travel.
const LONGEST_RAIL: f64 = 6.0;
/// Side and thickness of the plate at the end of a spring on the ground, relative to the model.
const SPRING_PLATE: [f64; 2] = [0.055, 0.009];

/// Role of a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// A beam.
    Beam,
    /// A shell.
    Shell,
    /// An elastic solid.
    Solid,
    /// A rigid body.
    Body,
    /// A point mass.
    PointMass,
    /// A joint, a drive or a relation.
    Joint,
    /// A spring.
    Spring,
    /// A force or moment.
    Load,
}

/// Colour of a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    /// The part of this index: beams, shells, solids, bodies and point masses are numbered consecutively.
    Part(usize),
    /// The tone of a symbol.
    Tone(Tone),
    /// The ground.
    Ground,
    /// A colour of its own: red, green and blue.
    Own(Shade),
}

/// Motion of a piece.
#[derive(Clone, Debug, PartialEq)]
pub enum Carrier {
    /// That of a node, in whose frame the mesh is given.
    Node(NodeId),
    /// That of a beam: the mesh is in the configuration of the model file.
    Sections(Sweep),
    /// That of nodes, one at each point: the mesh is in the configuration of the model file.
    Nodes(Vec<NodeId>),
    /// Between two positions; the mesh has unit length along its second axis.
    Span([Anchor; 2]),
    /// A load: the mesh has unit length along its second axis and begins at the origin.
    Arrow(Arrow),
}

/// An arrow whose length shows the magnitude of a load.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrow {
    anchor: Anchor,
    follower: bool,
    /// Vectors at equal intervals from the start to the end of the analysis.
    vectors: Vec<Vector3>,
    span: [f64; 2],
    /// The largest vector of the load.
    most: f64,
    /// Length at the largest vector [m].
    length: f64,
    /// Whether it ends at its position.
    ends_there: bool,
}

/// A surface with its role and its motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// Name of the part, joint, spring or load.
    pub name: String,
    /// Role of the piece.
    pub role: Role,
    /// Colour of the piece.
    pub colour: Colour,
    /// Surface of the piece, before it is moved.
    pub mesh: Mesh,
    /// Motion of the piece.
    pub carrier: Carrier,
}

impl Piece {
    /// The surface at poses of the nodes and a time [s]; none for a load that is then zero.
    pub fn at(&self, poses: &[Pose], time: f64) -> Option<Mesh> {
        match &self.carrier {
            Carrier::Node(node) => Some(self.mesh.clone().moved(&poses[*node])),
            Carrier::Sections(sweep) => Some(sweep.mesh(poses)),
            Carrier::Nodes(nodes) => {
                let points = nodes.iter().map(|node| poses[*node].position).collect();
                Some(Mesh { points, ..self.mesh.clone() })
            }
            Carrier::Span(anchors) => {
                let (pose, length) = span(anchors, poses);
                Some(self.mesh.clone().stretched(&Vector3::new(1.0, length, 1.0)).moved(&pose))
            }
            Carrier::Arrow(arrow) => {
                let (pose, length) = arrow.at(poses, time)?;
                Some(self.mesh.clone().stretched(&Vector3::new(1.0, length, 1.0)).moved(&pose))
            }
        }
    }
}

/// Centre and direction of the segment between two positions, and its length [m].
pub(crate) fn span(anchors: &[Anchor; 2], poses: &[Pose]) -> (Pose, f64) {
    let [a, b] = anchors.map(|anchor| place(&anchor, poses));
    let length = (b - a).norm();
    let direction = (b - a).try_normalize(0.0).unwrap_or_else(Vector3::y);
    (Pose::new(turn_to(&direction), 0.5 * (a + b)), length)
}

fn place(anchor: &Anchor, poses: &[Pose]) -> Vector3 {
    poses[anchor.node].transform_point(&Vector3::from(anchor.position))
}

impl Arrow {
    /// Origin, direction and length of the arrow [m]; none if the load is zero.
    fn at(&self, poses: &[Pose], time: f64) -> Option<(Pose, f64)> {
        let [start, end] = self.span;
        let last = self.vectors.len() - 1;
        let x =
            if end > start { ((time - start) / (end - start)).clamp(0.0, 1.0) * last as f64 } else { 0.0 };
        let k = (x.floor() as usize).min(last.saturating_sub(1));
        let (a, b) = (self.vectors[k], self.vectors[(k + 1).min(last)]);
        let vector = a + (b - a) * (x - k as f64);
        let share = vector.norm() / self.most;
        if share.is_nan() || share < 1e-3 {
            return None;
        }
        let direction = vector.normalize();
        let direction =
            if self.follower { poses[self.anchor.node].rotation.apply(&direction) } else { direction };
        let length = self.length * (0.25 + 0.75 * share);
        let at = place(&self.anchor, poses);
        let begin = if self.ends_there { at - direction * length } else { at };
        Some((Pose::new(turn_to(&direction), begin), length))
    }
}

/// A model as pieces, and its extent over its motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Geometry {
    /// The pieces, parts first.
    pub pieces: Vec<Piece>,
    /// Lower bounds of positions of nodes over the motion [m].
    pub low: Vector3,
    /// Upper bounds of positions of nodes over the motion [m].
    pub high: Vector3,
    /// Size of the model at one instant, without its travel: measure of symbols [m].
    pub size: f64,
    /// The upward direction.
    pub up: Vector3,
}

impl Geometry {
    /// Distance between the bounds [m].
    pub fn extent(&self) -> f64 {
        (self.high - self.low).norm()
    }

    /// The pieces of a scene with this motion. If `is_picture`, thin sections are drawn thicker and loads are drawn;
    /// otherwise sections are true down to 2e-4 of the model.
    pub fn new(scene: &Scene, motion: &Motion, is_picture: bool) -> Self {
        let (low, high, size) = bounds(scene, motion);
        let mut geometry = Self { pieces: Vec::new(), low, high, size, up: scene.up() };
        geometry.parts(scene, motion, if is_picture { MIN_THICKNESS * size } else { MIN_TRUE * size });
        geometry.symbols(scene, motion);
        geometry.springs(scene, motion);
        if is_picture {
            geometry.loads(scene);
        }
        geometry
    }

    fn add(&mut self, name: &str, (role, colour): (Role, Colour), mesh: Mesh, carrier: Carrier) {
        self.pieces.push(Piece { name: name.to_owned(), role, colour, mesh, carrier });
    }

    /// Adds a part, divided by the colours of its surface; the mesh begins with the triangles of the surface.
    fn add_painted(
        &mut self,
        name: &str,
        (role, colour): (Role, Colour),
        (mut mesh, surface): (Mesh, Option<&Surface>),
        node: NodeId,
    ) {
        // The last first: indices of the others stay as they are.
        for own in surface.iter().flat_map(|surface| surface.colours.iter().rev()) {
            let end = (own.first as usize + own.count as usize).min(mesh.faces.len());
            let faces: Vec<Vec<u32>> = mesh.faces.drain((own.first as usize).min(end)..end).collect();
            let painted = mesh.with_faces(faces);
            self.add(name, (role, Colour::Own(own.shade)), painted, Carrier::Node(node));
        }
        let rest = std::mem::take(&mut mesh.faces);
        if !rest.is_empty() {
            self.add(name, (role, colour), mesh.with_faces(rest), Carrier::Node(node));
        }
    }

    fn parts(&mut self, scene: &Scene, motion: &Motion, least: f64) {
        let mut number = 0;
        let mut next = || {
            number += 1;
            Colour::Part(number - 1)
        };
        for beam in &scene.beams {
            let sweep = Sweep::new(beam, motion.reference(), least);
            let mesh = sweep.mesh(motion.reference());
            self.add(&beam.name, (Role::Beam, next()), mesh, Carrier::Sections(sweep));
        }
        let shells = scene.shells.iter().map(|own| (Role::Shell, &own.name, &own.nodes, &own.elements));
        let solids =
            scene.elastic_solids.iter().map(|own| (Role::Solid, &own.name, &own.nodes, &own.elements));
        for (role, name, nodes, elements) in shells.chain(solids) {
            let points = nodes.iter().map(|node| motion.reference()[*node].position).collect();
            let faces = elements.iter().map(|corners| corners.map(|node| node as u32).to_vec()).collect();
            // Solids are painted as shells are: with fields, and divided where they are curved.
            let mesh = Mesh { points, faces, is_open: true };
            self.add(name, (role, next()), mesh, Carrier::Nodes(nodes.clone()));
        }
        for body in &scene.bodies {
            let mesh = self.body(body, &attached(scene, body.node));
            self.add_painted(&body.name, (Role::Body, next()), (mesh, body.surface.as_ref()), body.node);
        }
        let heaviest = scene.point_masses.iter().map(|mass| mass.mass).fold(0.0, f64::max);
        for mass in &scene.point_masses {
            let ball = || Mesh::ball(self.size * (0.012 + 0.016 * (mass.mass / heaviest).cbrt()));
            let mesh = mass.surface.as_ref().map_or_else(ball, Mesh::of_surface);
            let colour = if mass.node == GROUND { Colour::Ground } else { next() };
            self.add_painted(&mass.name, (Role::PointMass, colour), (mesh, mass.surface.as_ref()), mass.node);
        }
    }

    /// The surface of a body if it has one; otherwise its box, with arms to the points of attachment.
    fn body(&self, body: &Body, anchors: &[Vector3]) -> Mesh {
        let center = Vector3::from(body.shape.center);
        if let Some(surface) = &body.surface {
            let mut mesh = Mesh::of_surface(surface);
            let margin = Vector3::repeat(0.02 * self.size);
            let low = mesh.points.iter().fold(Vector3::repeat(f64::INFINITY), |low, at| low.inf(at)) - margin;
            let high =
                mesh.points.iter().fold(Vector3::repeat(-f64::INFINITY), |high, at| high.sup(at)) + margin;
            // Points of attachment beyond the surface hang on arms.
            for at in anchors.iter().filter(|at| (0..3).any(|k| at[k] < low[k] || at[k] > high[k])) {
                mesh.append(self.arm(&center, at));
            }
            return mesh;
        }
        let reach = anchors.iter().map(|at| (at - center).norm()).fold(0.0, f64::max);
        // Boxes much larger than the body's attachments, for example in planar models, must not hide the rest.
        let usual = if reach > 0.02 * self.size { reach } else { 0.375 * self.size };
        let mut sides = body.shape.sides;
        sides.sort_by(f64::total_cmp);
        let share = if sides[1] > BULKY * usual { 0.28 * usual / sides[1] } else { 1.0 };
        let least = MIN_SIDE * self.size;
        let drawn = body.shape.sides.map(|side| (share * side).max(least));
        let axes = Rotation::from_quaternion(body.shape.quaternion).unwrap_or_default();
        let mut mesh = Mesh::block(drawn).moved(&Pose::new(axes, center));
        for at in anchors {
            if (at - center).norm() > 0.5 * least {
                mesh.append(self.arm(&center, at));
            }
        }
        mesh
    }

    /// A rod from the centre of a body to a point of attachment.
    fn arm(&self, center: &Vector3, at: &Vector3) -> Mesh {
        let along = at - center;
        let direction = along.try_normalize(0.0).unwrap_or_else(Vector3::y);
        let pose = Pose::new(turn_to(&direction), center + 0.5 * along);
        Mesh::cylinder(0.0055 * self.size, along.norm()).moved(&pose)
    }

    fn symbols(&mut self, scene: &Scene, motion: &Motion) {
        let role = |table: Option<Table>| match table {
            Some(Table::Springs) => Role::Spring,
            Some(Table::Loads) => Role::Load,
            _ => Role::Joint,
        };
        for symbol in &scene.symbols {
            let role = role(symbol.table);
            let radius = symbol.unit.unwrap_or_else(|| self.radius(symbol.around));
            let at = Pose::translation(Vector3::from(symbol.anchor.position));
            // Solids of one colour are one piece.
            let mut tones: Vec<Tone> = Vec::new();
            for solid in &symbol.solids {
                if !tones.contains(&solid.tone) {
                    tones.push(solid.tone);
                }
            }
            for tone in tones {
                let mut mesh = Mesh::default();
                for solid in symbol.solids.iter().filter(|solid| solid.tone == tone) {
                    mesh.append(Mesh::of_solid(solid, radius));
                }
                let carrier = Carrier::Node(symbol.anchor.node);
                self.add(&symbol.name, (role, Colour::Tone(tone)), mesh.moved(&at), carrier);
            }
        }
        // A plinth is drawn below every joint on the ground.
        for joint in &scene.joints {
            let Some([base, tip]) = joint.anchors.filter(|[base, _]| base.node == GROUND) else { continue };
            let symbol = symbols_of(scene, &joint.name, Table::Joints).next();
            // What rolls on the ground is no support.
            if symbol.is_some_and(|symbol| symbol.unit.is_some()) {
                continue;
            }
            let radius = self.radius(symbol.map_or(0.0, |symbol| symbol.around));
            let pose = Pose::new(turn_to(&self.up), Vector3::from(base.position) - 1.15 * radius * self.up);
            let mesh = Mesh::plinth(0.55 * radius, 1.75 * radius, 1.9 * radius).moved(&pose);
            self.add(&joint.name, (Role::Joint, Colour::Ground), mesh, Carrier::Node(GROUND));
            if let Some(axis) = joint.axes.first().filter(|_| SLIDING.contains(&joint.kind.as_str())) {
                self.rail(&joint.name, ([base, tip], Vector3::from(*axis)), radius, motion);
            }
        }
        for rod in &scene.rods {
            let mesh = Mesh::cylinder(rod.radius.unwrap_or_else(|| 0.35 * self.radius(0.0)), 1.0);
            let paint = (role(rod.table), Colour::Tone(Tone::Dark));
            self.add(&rod.name, paint, mesh, Carrier::Span(rod.anchors));
        }
    }

    /// Adds the rail on the ground along which a joint slides over the motion, with a plate at each end, unless the joint does
    /// not leave its symbol or travels far, or another part comes across.
    fn rail(
        &mut self,
        name: &str,
        ([base, tip], axis): ([Anchor; 2], Vector3),
        radius: f64,
        motion: &Motion,
    ) {
        let (base, tip_at) = (Vector3::from(base.position), Vector3::from(tip.position));
        let slide = |frame| axis.dot(&(motion.pose(frame, tip.node).transform_point(&tip_at) - base));
        let (least, most) = (0..motion.times().len())
            .map(slide)
            .fold((0.0_f64, 0.0_f64), |(least, most), place| (least.min(place), most.max(place)));
        let half = HALF_SLIDER * radius;
        if most.max(-least) < half || most - least > LONGEST_RAIL * self.size {
            return;
        }
        let (low, high) = (least - half, most + half);
        // Along a connecting rod its plates would look like collars: other parts, away from the one that slides.
        let crosses = |frame: usize, node: NodeId| {
            let moved = &motion.frame(frame)[3 * node.index()..];
            let start = motion.reference()[node].position - base;
            let way = start + Vector3::from_fn(|k, _| f64::from(moved[k]));
            let place = axis.dot(&way);
            let is_across = (way - place * axis).norm() < RAIL_PLATE[0] * radius;
            is_across && (low..high).contains(&place) && (place - slide(frame)).abs() > 2.0 * half
        };
        let others = || (1..motion.header().nodes.len()).map(NodeId::new).filter(|node| *node != tip.node);
        let frames = motion.times().len();
        if (0..frames)
            .step_by(frames.div_ceil(50).max(1))
            .any(|frame| others().any(|node| crosses(frame, node)))
        {
            return;
        }
        let at = |place: f64| Pose::new(turn_to(&axis), base + place * axis);
        let [side, thickness] = RAIL_PLATE.map(|share| share * radius);
        let mut plates = Mesh::block([side, thickness, side]).moved(&at(low));
        plates.append(Mesh::block([side, thickness, side]).moved(&at(high)));
        let rail = Mesh::block([RAIL * radius, high - low, RAIL * radius]).moved(&at(0.5 * (low + high)));
        self.add(name, (Role::Joint, Colour::Tone(Tone::Dark)), rail, Carrier::Node(GROUND));
        self.add(name, (Role::Joint, Colour::Ground), plates, Carrier::Node(GROUND));
    }

    /// Radius of a symbol that is not hidden by sections of this half thickness.
    fn radius(&self, around: f64) -> f64 {
        (1.45 * around).min(0.04 * self.size).max(0.0135 * self.size)
    }

    fn springs(&mut self, scene: &Scene, motion: &Motion) {
        let has_symbol = |name: &str| symbols_of(scene, name, Table::Springs).next().is_some();
        for spring in scene.springs.iter().filter(|spring| !has_symbol(&spring.name)) {
            let Some(anchors) = spring.anchors else { continue };
            let (_, length) = span(&anchors, motion.reference());
            let length = if length > 0.0 { length } else { self.size };
            let mesh = if spring.cable.is_some() {
                Mesh::cylinder(0.0025 * self.size, 1.0)
            } else {
                Mesh::coil(0.016 * self.size, 0.0035 * self.size, TURNS, length)
            };
            self.add(&spring.name, (Role::Spring, Colour::Tone(Tone::Spring)), mesh, Carrier::Span(anchors));
            self.plates(&spring.name, anchors, motion);
        }
    }

    /// Adds a plate at each end of a spring on the ground, across the spring at the start.
    fn plates(&mut self, name: &str, anchors: [Anchor; 2], motion: &Motion) {
        if motion.times().is_empty() {
            return;
        }
        let start =
            |anchor: &Anchor| motion.pose(0, anchor.node).transform_point(&Vector3::from(anchor.position));
        let [base, tip] = anchors.each_ref().map(start);
        for (anchor, at, other) in [(anchors[0], base, tip), (anchors[1], tip, base)] {
            if anchor.node != GROUND {
                continue;
            }
            let outward = (at - other).try_normalize(0.0).unwrap_or(-self.up);
            let [side, thickness] = SPRING_PLATE.map(|share| share * self.size);
            let pose = Pose::new(turn_to(&outward), at + 0.5 * thickness * outward);
            let mesh = Mesh::block([side, thickness, side]).moved(&pose);
            self.add(name, (Role::Spring, Colour::Ground), mesh, Carrier::Node(GROUND));
        }
    }

    fn loads(&mut self, scene: &Scene) {
        let span = [scene.start, scene.end];
        for load in &scene.loads {
            let Some(vectors) = vectors(load) else { continue };
            let most = vectors.iter().fold(0.0, |most: f64, vector| most.max(vector.norm()));
            let is_moment = load.kind == "moment";
            let (anchor, follower, length) = (load.anchor, load.follower, 0.16 * self.size);
            let arrow = Arrow { anchor, follower, vectors, span, most, length, ends_there: !is_moment };
            let tone = if is_moment { Tone::Moment } else { Tone::Load };
            let mesh = arrow_mesh(0.0045 * self.size, length, if is_moment { 2 } else { 1 });
            self.add(&load.name, (Role::Load, Colour::Tone(tone)), mesh, Carrier::Arrow(arrow));
        }
        for load in &scene.beam_loads {
            let all = || load.vectors.iter().flatten().map(|vector| Vector3::from(*vector));
            let most = all().fold(0.0, |most: f64, vector| most.max(vector.norm()));
            for (k, anchor) in load.anchors.iter().enumerate() {
                let vectors = load.vectors.iter().map(|vectors| Vector3::from(vectors[k])).collect();
                let (length, follower) = (0.08 * self.size, load.follower);
                let arrow =
                    Arrow { anchor: *anchor, follower, vectors, span, most, length, ends_there: true };
                let mesh = arrow_mesh(0.0025 * self.size, length, 1);
                let paint = (Role::Load, Colour::Tone(Tone::Load));
                self.add(&load.beam, paint, mesh, Carrier::Arrow(arrow));
            }
        }
    }
}

/// Symbols of what has this name in a table; those of earlier versions by the name alone.
fn symbols_of<'a>(scene: &'a Scene, name: &'a str, table: Table) -> impl Iterator<Item = &'a Symbol> {
    scene.symbols.iter().filter(move |own| own.name == name && own.table.is_none_or(|other| other == table))
}

/// Vectors of a load at all sampled instants.
fn vectors(load: &Load) -> Option<Vec<Vector3>> {
    let vector = Vector3::from(load.vector?);
    Some(if load.scale.is_empty() {
        vec![vector]
    } else {
        load.scale.iter().map(|scale| vector * *scale).collect()
    })
}

/// An arrow of unit length along the second axis, whose heads are in proportion if it is stretched to `length`.
fn arrow_mesh(radius: f64, length: f64, heads: u32) -> Mesh {
    let head = 8.0 * radius / length;
    let shaft = 1.0 - head;
    let at = |y: f64| Pose::translation(Vector3::new(0.0, y, 0.0));
    let mut mesh = Mesh::cylinder(radius, shaft).moved(&at(0.5 * shaft));
    for k in 0..heads {
        mesh.append(Mesh::cone(2.9 * radius, head).moved(&at(1.0 - head * (0.5 + 0.8 * f64::from(k)))));
    }
    mesh
}

/// Points of a node at which joints, springs and loads are attached, in its frame.
fn attached(scene: &Scene, node: NodeId) -> Vec<Vector3> {
    let joints = scene.joints.iter().filter_map(|joint| joint.anchors);
    let springs = scene.springs.iter().filter_map(|spring| spring.anchors);
    let loads = scene.loads.iter().map(|load| load.anchor);
    let all = joints.chain(springs).flatten().chain(loads);
    all.filter(|anchor| anchor.node == node).map(|anchor| Vector3::from(anchor.position)).collect()
}

/// Bounds of the positions of all nodes except the ground over all frames, with attachments to the ground, and the size of
/// the model: that of its parts at one instant, without their travel. Attachments to the ground count at the start.
fn bounds(scene: &Scene, motion: &Motion) -> (Vector3, Vector3, f64) {
    let count = motion.reference().len();
    let frames = motion.times().len();
    let nothing = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
    let joints = scene.joints.iter().filter_map(|joint| joint.anchors);
    let springs = scene.springs.iter().filter_map(|spring| spring.anchors);
    let on_ground = joints.chain(springs).flatten().filter(|anchor| anchor.node == GROUND);
    let on_ground: Vec<Vector3> = on_ground.map(|anchor| Vector3::from(anchor.position)).collect();
    let with = |(low, high): (Vector3, Vector3), place: &Vector3| (low.inf(place), high.sup(place));
    let (mut all, mut size) = (on_ground.iter().fold(nothing, with), 0.0_f64);
    let stride = (frames * count / 400_000).max(1);
    for frame in (0..frames).step_by(stride) {
        let numbers = motion.frame(frame);
        let mut now = if frame == 0 { all } else { nothing };
        for node in usize::from(count > 1)..count {
            let shift = Vector3::from_fn(|k, _| f64::from(numbers[3 * node + k]));
            now = with(now, &(motion.reference()[node].position + shift));
        }
        size = size.max((now.1 - now.0).norm());
        all = (all.0.inf(&now.0), all.1.sup(&now.1));
    }
    let (low, high) = all;
    let travel = (high - low).norm();
    if travel > 0.0 && travel.is_finite() {
        let solid = |body: &Body| match &body.surface {
            None => Vector3::from(body.shape.sides).norm(),
            Some(surface) => {
                let points = surface.points.iter().map(|point| Vector3::from(point.map(f64::from)));
                let (low, high) = points.fold(nothing, |bounds, point| with(bounds, &point));
                (high - low).norm()
            }
        };
        let size = scene.bodies.iter().map(|body| ABOUT_BODIES * solid(body)).fold(size, f64::max);
        return (low, high, if size > 0.0 { size.min(travel) } else { travel });
    }
    // A single point gets space around it.
    let sides = scene.bodies.iter().flat_map(|body| body.shape.sides).fold(0.0, f64::max);
    let room = Vector3::repeat(if sides > 0.0 { 0.5 * sides } else { 0.5 });
    let (low, high) = if low.x.is_finite() { (low - room, high + room) } else { (-room, room) };
    (low, high, (high - low).norm())
}

/// Poses of all nodes at a time [s] within the motion: between two frames displacements are linear and rotations
/// uniform. None outside.
pub fn poses_at(motion: &Motion, time: f64) -> Option<Vec<Pose>> {
    let times = motion.times();
    let (first, last) = (*times.first()?, *times.last()?);
    let slack = 1e-9 * (last - first).abs();
    if !(first - slack..=last + slack).contains(&time) {
        return None;
    }
    let after = times.partition_point(|frame| *frame <= time).min(times.len() - 1);
    let before = after.saturating_sub(1);
    let duration = times[after] - times[before];
    let x = if duration > 0.0 { ((time - times[before]) / duration).clamp(0.0, 1.0) } else { 1.0 };
    let pose = |node: NodeId| {
        let (a, b) = (motion.pose(before, node), motion.pose(after, node));
        Pose::new(between(&a.rotation, &b.rotation, x), a.position + x * (b.position - a.position))
    };
    Some(NodeId::first(motion.reference().len()).map(pose).collect())
}
