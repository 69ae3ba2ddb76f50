//! MJCF, the robot description of MuJoCo: bodies with joints, inertia given or computed from shapes, default classes, gravity, contacts,
//! generated elements, sensors. Unknown elements that affect the motion are rejected.

mod element;
mod expand;
mod frame;
mod geom;
mod joint;
mod mesh;
mod outside;
mod sensor;
mod touching;
mod tree;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::rc::Rc;

use lissom_motion::{Matrix3, Motion, Vector3};

use self::element::Element;
use self::geom::Geom;
use self::mesh::Meshes;
use self::outside::Sites;
use self::tree::{Inertias, Node, Settings};
use super::model_text::{carried, together};
use super::xml;
use super::{
    ContactRules, Freedom, ImportError, Link, LinkInertia, Robot, RobotJoint, RobotRoot, WeightCompensation,
    from_z,
};

/// Elements of a body that are only drawn or measured.
const SEEN: [&str; 3] = ["site", "camera", "light"];
/// Elements that generate deformable parts, and elements of forces, which are not read.
const DEFORMABLE: [&str; 4] = ["flexcomp", "composite", "skin", "plugin"];

/// Reads a robot from the text of an MJCF file, without files that it names.
///
/// # Errors
/// If it is not MJCF, a number is invalid, or it contains unknown elements that affect the motion.
pub fn from_mjcf(text: &str) -> Result<Robot, ImportError> {
    in_folder(text, None)
}

/// Reads a robot from the text of an MJCF file in a folder, where meshes and attached models are.
pub(super) fn in_folder(text: &str, folder: Option<&Path>) -> Result<Robot, ImportError> {
    let document = xml::parse(text)?;
    let root = document.root_element();
    if !root.has_tag_name("mujoco") {
        let message = format!("this is not MJCF: its root is <{}>, not <mujoco>", root.tag_name().name());
        return Err(ImportError::new(message));
    }
    let mut obstacles = Vec::new();
    let root = Node::read(&document, folder, &mut obstacles)?;
    let root = expand::expanded(root, &mut obstacles);
    let settings = Rc::clone(&root.settings);
    let mut reader = Reader {
        meshes: Meshes::of(&root),
        seen: Vec::new(),
        sites: Sites::new(),
        softened: BTreeMap::new(),
        robot: Robot {
            name: root.attribute("model").unwrap_or("robot").to_owned(),
            gravity: outside::gravity(&root)?,
            links: vec![Link::new("world".to_owned(), None, String::new())],
            root: RobotRoot::World,
            contacts: ContactRules { filters_parents: true, ..ContactRules::default() },
            obstacles,
            ..Robot::default()
        },
    };
    for world in root.of("worldbody") {
        let place =
            Context { offset: Motion::identity(), is_world: true, needs_geoms: false, is_frame: false };
        let mut content = Content::default();
        reader.content(world, &place, &mut content);
        reader.keep_content(0, &mut content);
        reader.carried(world, 0, &place);
    }
    let Reader { mut robot, seen, mut meshes, sites, softened } = reader;
    robot.left_out.extend(softened.iter().map(|(words, count)| format!("{words} of {count} geoms")));
    outside::set_total_mass(&settings.compiler, &mut robot)?;
    outside::read(&root, &sites, &mut robot);
    sensor::read(&root, &sites, &mut robot);
    let seen = xml::counted(seen.into_iter());
    if !seen.is_empty() {
        robot.left_out.push(format!("elements: {}", seen.join(", ")));
    }
    robot.left_out.append(&mut meshes.notes);
    robot.unsupported = summarized(std::mem::take(&mut robot.unsupported));
    let named = check_names(&robot);
    robot.keep(named);
    Ok(robot)
}

struct Reader {
    meshes: Meshes,
    /// Tags of elements that are only drawn or measured.
    seen: Vec<String>,
    sites: Sites,
    /// Properties of touches that are omitted, with the number of geoms that have them.
    softened: BTreeMap<&'static str, usize>,
    robot: Robot,
}

/// Contents of a body.
#[derive(Default)]
struct Content {
    joints: Vec<(Element, Rc<Settings>)>,
    inertial: Option<LinkInertia>,
    geoms: Option<LinkInertia>,
    visuals: Vec<super::Visual>,
    sites: Vec<(String, Motion)>,
}

/// Context of elements that are read.
#[derive(Clone)]
struct Context {
    /// Enclosing frame relative to the body's.
    offset: Motion,
    is_world: bool,
    /// Whether the body has the mass of its geoms.
    needs_geoms: bool,
    /// Whether they are within a frame of a body.
    is_frame: bool,
}

impl Reader {
    /// Reads the contents of a body, or of a frame of it, except nested bodies.
    fn content(&mut self, node: &Node, place: &Context, content: &mut Content) {
        for child in &node.children {
            let read = self.entry(child, place, content);
            self.robot.keep(read);
        }
    }

    /// Reads an element of a body.
    fn entry(&mut self, child: &Node, place: &Context, content: &mut Content) -> Result<(), ImportError> {
        let may_move = !place.is_world && !place.is_frame;
        let own = &child.element;
        match child.tag() {
            "body" => {}
            "frame" => self.content(child, &frame_of(child, place)?, content),
            "joint" | "freejoint" if may_move => {
                content.joints.push((own.clone(), Rc::clone(&child.settings)));
            }
            "inertial" if may_move => {
                let read = inertial(own, &frame::frame(own, &child.settings.angles)?)?;
                if content.inertial.replace(read).is_some() {
                    return Err(own.fault("the body has two"));
                }
            }
            "geom" => self.geom(child, place, content)?,
            tag if SEEN.contains(&tag) => {
                self.seen.push(tag.to_owned());
                if let Some(name) = child.name().filter(|_| tag == "site") {
                    let frame = match own.numbers::<6>("fromto")? {
                        Some([a, b, c, d, e, f]) => {
                            let along = frame::direction(own, "fromto", [d - a, e - b, f - c])?;
                            Motion::new(from_z(&along), 0.5 * Vector3::new(a + d, b + e, c + f))
                        }
                        None => frame::frame(own, &child.settings.angles)?,
                    };
                    content.sites.push((name.to_owned(), place.offset * frame));
                }
            }
            tag if DEFORMABLE.contains(&tag) => self.robot.unsupported.push(own.words()),
            tag => {
                let message = format!("<{tag}> is not supported here: write the elements that it generates");
                return Err(own.fault(message));
            }
        }
        Ok(())
    }

    /// Reads a geom: its mass, what is drawn of it, and how it touches others.
    fn geom(&mut self, child: &Node, place: &Context, content: &mut Content) -> Result<(), ImportError> {
        let geom = Geom::read(child)?;
        if geom.kind == "sdf" || child.of("plugin").next().is_some() {
            let words = format!("the signed distance function of {}", child.element.words());
            self.robot.unsupported.push(words);
            return Ok(());
        }
        self.robot.unsupported.extend(geom.unsupported()?);
        for (key, words, least) in
            [("condim", "friction against rolling and spinning (`condim`)", 3.0), ("margin", "`margin`", 0.0)]
        {
            if child.element.number(key, 0.0)? > least {
                *self.softened.entry(words).or_default() += 1;
            }
        }
        let groups = child.settings.groups;
        let counts = place.needs_geoms && (groups[0]..=groups[1]).contains(&geom.group);
        if counts && let Some(mass) = geom.mass(&mut self.meshes)? {
            let mass = carried(&mass, &place.offset);
            content.geoms = Some(together(content.geoms.as_ref(), &mass));
        }
        if let Some(mut visual) = geom.visual(&mut self.meshes)? {
            visual.origin = place.offset * visual.origin;
            content.visuals.push(visual);
        }
        Ok(())
    }

    /// Gives what was read of a body to its link.
    fn keep_content(&mut self, link: usize, content: &mut Content) {
        self.robot.links[link].visuals.append(&mut content.visuals);
        self.sites.extend(content.sites.drain(..).map(|(name, frame)| (name, (link, frame))));
    }

    /// Reads the child bodies of link `parent`.
    fn carried(&mut self, node: &Node, parent: usize, place: &Context) {
        for child in &node.children {
            if child.has_tag("frame") {
                // A frame that cannot be read is reported with the content of its body.
                if let Ok(place) = frame_of(child, place) {
                    self.carried(child, parent, &place);
                }
            } else if child.has_tag("body") {
                let read = self.body(child, parent, place);
                self.robot.keep(read);
            }
        }
    }

    /// Reads a child body of link `parent`, and all its descendants.
    fn body(&mut self, node: &Node, parent: usize, around: &Context) -> Result<(), ImportError> {
        let own = &node.element;
        let known =
            own.check_known(&frame::ATTRIBUTES, &["childclass", "mocap", "gravcomp", "user", "sleep"]);
        self.robot.keep(known);
        let frame = self.robot.keep(frame::frame(own, &node.settings.angles)).unwrap_or_default();
        let mut origin = around.offset * frame;
        let name = own.text("name").map_or_else(|| format!("body{}", self.robot.links.len()), str::to_owned);
        let compensated = own.number("gravcomp", 0.0)?;
        if own.flag("mocap", false)? {
            self.robot.left_out.push(format!("the prescribed motion of body `{name}`, which is fixed"));
        }
        let has_inertial = node.of("inertial").next().is_some();
        let place = Context {
            offset: Motion::identity(),
            is_world: false,
            needs_geoms: match node.settings.from_geoms {
                Inertias::Given => false,
                Inertias::GivenOrGeoms => !has_inertial,
                Inertias::Geoms => true,
            },
            is_frame: false,
        };
        let mut content = Content::default();
        self.content(node, &place, &mut content);
        let inertia = if place.needs_geoms { content.geoms } else { content.inertial };

        // Several joints of a body are in series, through massless links.
        let (mut carrier, count) = (parent, content.joints.len());
        for (element, _) in &content.joints {
            if element.list("springdamper")?.unwrap_or_default().iter().any(|value| *value != 0.0) {
                let words =
                    format!("`springdamper` of {}, instead of `stiffness` and `damping`", element.words());
                self.robot.unsupported.push(words);
            }
        }
        for (number, (element, settings)) in content.joints.iter().enumerate() {
            let is_last = number + 1 == count;
            let child = self.robot.links.len();
            let joint_name = match element.text("name") {
                Some(name) => name.to_owned(),
                None if count == 1 => format!("{name}_joint"),
                None => format!("{name}_joint{}", number + 1),
            };
            let link = if is_last { name.clone() } else { format!("{name} behind {joint_name}") };
            let source = own.location().to_owned();
            let mut link = Link::new(link, inertia.filter(|_| is_last), source);
            link.is_between = !is_last;
            self.robot.links.push(link);
            let read = joint::joint(element, settings, (joint_name.clone(), carrier, child, origin));
            let fixed = || RobotJoint::new(joint_name, Freedom::Fixed, carrier, child, origin);
            let joint = self.robot.keep(read).unwrap_or_else(fixed);
            if joint.rating.effort.is_some() && element.flag("actuatorgravcomp", false)? {
                self.robot
                    .left_out
                    .push(format!("the weight compensation of `{}` in the limits of its motors", joint.name));
            }
            if joint.armature > 0.0 && !joint.moves() {
                // Default classes give it to the free joint of a robot whose hinges are meant.
                let (name, armature) = (&joint.name, joint.armature);
                self.robot
                    .left_out
                    .push(format!("the armature {armature} of `{name}`, which is no hinge or slide"));
            }
            if joint.freedom == Freedom::Floating && (count > 1 || parent > 0) {
                let fault =
                    element.fault("a body with a free joint can have no other joint and no parent body");
                self.robot.obstacles.push(fault.message);
            }
            self.robot.joints.push(joint);
            (carrier, origin) = (child, Motion::identity());
        }
        if count == 0 {
            let child = self.robot.links.len();
            self.robot.links.push(Link::new(name.clone(), inertia, own.location().to_owned()));
            let fixed = RobotJoint::new(format!("{name}_fixed"), Freedom::Fixed, parent, child, origin);
            self.robot.joints.push(fixed);
            carrier = child;
        }
        self.keep_content(carrier, &mut content);
        if compensated != 0.0 {
            self.robot.compensations.push(WeightCompensation { link: carrier, share: compensated });
        }
        self.carried(node, carrier, &place);
        Ok(())
    }
}

/// The context of the elements of a `<frame>`.
fn frame_of(node: &Node, around: &Context) -> Result<Context, ImportError> {
    node.element.check_known(&frame::ATTRIBUTES, &["childclass"])?;
    let offset = around.offset * frame::frame(&node.element, &node.settings.angles)?;
    Ok(Context { offset, is_frame: true, ..around.clone() })
}

/// The explicit inertia of a body.
fn inertial(own: &Element, placed: &Motion) -> Result<LinkInertia, ImportError> {
    own.check_known(&frame::ATTRIBUTES, &["mass", "diaginertia", "fullinertia"])?;
    let mass = own.numbers::<1>("mass")?.ok_or_else(|| own.fault("it has no `mass`"))?[0];
    let tensor = match (own.numbers::<3>("diaginertia")?, own.numbers::<6>("fullinertia")?) {
        (Some([x, y, z]), None) => Matrix3::from_diagonal(&[x, y, z].into()),
        (None, Some([xx, yy, zz, xy, xz, yz])) => Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
        _ => return Err(own.fault("specify either `diaginertia` or `fullinertia`")),
    };
    if mass < 0.0 {
        return Err(own.fault(format!("`mass` is negative: {mass}")));
    }
    let turn = placed.rotation.matrix();
    Ok(LinkInertia { mass, centre: placed.position, inertia: turn * tensor * turn.transpose() })
}

/// Sentences, each once with how often it occurs: what is generated has the line of its source.
fn summarized(all: Vec<String>) -> Vec<String> {
    let mut counts: Vec<(String, usize)> = Vec::new();
    for own in all {
        match counts.iter_mut().find(|(known, _)| *known == own) {
            Some((_, count)) => *count += 1,
            None => counts.push((own, 1)),
        }
    }
    let words = |(own, count): (String, usize)| if count > 1 { format!("{own}, {count} times") } else { own };
    counts.into_iter().map(words).collect()
}

/// Rejects names that occur twice.
fn check_names(robot: &Robot) -> Result<(), ImportError> {
    let twice = |names: Vec<&str>| {
        let mut seen = BTreeSet::new();
        names.into_iter().find(|name| !seen.insert(*name)).map(str::to_owned)
    };
    let joints = robot.joints.iter().filter(|joint| joint.freedom != Freedom::Fixed);
    let found = [
        ("bodies", twice(robot.links.iter().map(|link| link.name.as_str()).collect())),
        ("joints", twice(joints.map(|joint| joint.name.as_str()).collect())),
    ];
    match found.into_iter().find_map(|(what, name)| Some((what, name?))) {
        Some((what, name)) => Err(ImportError::new(format!("two {what} are called `{name}`"))),
        None => Ok(()),
    }
}
