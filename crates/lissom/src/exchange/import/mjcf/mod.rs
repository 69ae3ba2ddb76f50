//! MJCF, the robot description of MuJoCo: bodies with joints, inertia given or computed from shapes, default classes, gravity.
//! Contacts, actuators and sensors are omitted; unknown elements that affect the motion are rejected.

mod element;
mod frame;
mod geom;
mod joint;
mod outside;

use std::collections::BTreeSet;

use lissom_motion::{Matrix3, Motion};
use roxmltree::Node;

use self::element::{Classes, Element};
use self::frame::Angles;
use self::geom::Geom;
use super::model_text::{carried, together};
use super::xml::{self, children};
use super::{Freedom, ImportError, Link, LinkInertia, Robot, RobotJoint};

/// Elements of a body that are only drawn or measured.
const SEEN: [&str; 3] = ["site", "camera", "light"];

/// Reads a robot from the text of an MJCF file.
///
/// # Errors
/// If it is not MJCF, a number is invalid, or it contains unknown elements that affect the motion.
pub fn from_mjcf(text: &str) -> Result<Robot, ImportError> {
    let document = xml::parse(text)?;
    let root = document.root_element();
    if !root.has_tag_name("mujoco") {
        let message = format!("this is not MJCF: its root is <{}>, not <mujoco>", root.tag_name().name());
        return Err(ImportError::new(message));
    }
    let compiler = children(root, "compiler").map(Element::bare).reduce(Element::merged);
    let compiler = compiler.unwrap_or_else(|| Element::bare(root));
    outside::check_compiler(&compiler)?;
    let mut reader = Reader {
        angles: Angles::read(&compiler)?,
        autolimits: compiler.flag("autolimits", true)?,
        from_geoms: Inertias::read(&compiler)?,
        groups: compiler.numbers::<2>("inertiagrouprange")?.unwrap_or([0.0, 5.0]),
        classes: Classes::read(root)?,
        touching: 0,
        seen: Vec::new(),
        robot: Robot {
            name: root.attribute("model").unwrap_or("robot").to_owned(),
            gravity: outside::gravity(root)?,
            links: vec![Link::new("world".to_owned(), None, String::new())],
            is_root_the_world: true,
            joints: Vec::new(),
            closures: Vec::new(),
            motors: Vec::new(),
            left_out: Vec::new(),
            unsupported: Vec::new(),
            obstacles: Vec::new(),
        },
    };
    for world in children(root, "worldbody") {
        let class = world.attribute("childclass");
        let place = Context {
            offset: Motion::identity(),
            class,
            is_world: true,
            needs_geoms: false,
            is_frame: false,
        };
        reader.content(world, &place, &mut Content::default());
        reader.carried(world, 0, &place);
    }
    let Reader { mut robot, classes, seen, touching, .. } = reader;
    outside::set_total_mass(&compiler, &mut robot)?;
    outside::read(root, &classes, &mut robot);
    let seen = xml::counted(seen.into_iter());
    if !seen.is_empty() {
        robot.left_out.push(format!("elements: {}", seen.join(", ")));
    }
    if touching > 1 {
        robot.left_out.push("contacts: bodies pass through each other".to_owned());
    }
    let named = check_names(&robot);
    robot.keep(named);
    Ok(robot)
}

/// Source of the inertia of a body.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Inertias {
    Given,
    GivenOrGeoms,
    Geoms,
}

impl Inertias {
    fn read(compiler: &Element) -> Result<Self, ImportError> {
        match compiler.text("inertiafromgeom").unwrap_or("auto") {
            "auto" => Ok(Self::GivenOrGeoms),
            "true" => Ok(Self::Geoms),
            "false" => Ok(Self::Given),
            other => {
                Err(compiler.fault(format!("`inertiafromgeom` must be true, false or auto, not `{other}`")))
            }
        }
    }
}

struct Reader {
    angles: Angles,
    autolimits: bool,
    from_geoms: Inertias,
    groups: [f64; 2],
    classes: Classes,
    /// Number of geoms that may collide.
    touching: usize,
    /// Tags of elements that are only drawn or measured.
    seen: Vec<String>,
    robot: Robot,
}

/// Contents of a body.
#[derive(Default)]
struct Content {
    joints: Vec<Element>,
    inertial: Option<LinkInertia>,
    geoms: Option<LinkInertia>,
}

/// Context of elements that are read.
#[derive(Clone)]
struct Context<'a> {
    /// Enclosing frame relative to the body's.
    offset: Motion,
    /// Enclosing default class.
    class: Option<&'a str>,
    is_world: bool,
    /// Whether the body has the mass of its geoms.
    needs_geoms: bool,
    /// Whether they are within a frame of a body.
    is_frame: bool,
}

impl Reader {
    /// Reads the contents of a body, or of a frame of it, except nested bodies.
    fn content(&mut self, node: Node<'_, '_>, place: &Context<'_>, content: &mut Content) {
        for child in node.children().filter(Node::is_element) {
            let read = self.entry(child, place, content);
            self.robot.keep(read);
        }
    }

    /// Reads an element of a body.
    fn entry(
        &mut self,
        child: Node<'_, '_>,
        place: &Context<'_>,
        content: &mut Content,
    ) -> Result<(), ImportError> {
        let may_move = !place.is_world && !place.is_frame;
        match child.tag_name().name() {
            "body" => {}
            "frame" => self.content(child, &self.frame(child, place)?, content),
            "joint" if may_move => content.joints.push(self.classes.element(child, place.class)?),
            "freejoint" if may_move => content.joints.push(Element::bare(child)),
            "inertial" if may_move => {
                let own = Element::bare(child);
                let read = inertial(&own, &frame::frame(&own, &self.angles)?)?;
                if content.inertial.replace(read).is_some() {
                    return Err(own.fault("the body has two"));
                }
            }
            "geom" => {
                let geom = Geom::read(self.classes.element(child, place.class)?)?;
                self.touching += usize::from(geom.touches);
                if place.needs_geoms
                    && (self.groups[0]..=self.groups[1]).contains(&geom.group)
                    && let Some(mass) = geom.mass(&self.angles)?
                {
                    let mass = carried(&mass, &place.offset);
                    content.geoms = Some(together(content.geoms.as_ref(), &mass));
                }
            }
            "plugin" => self.robot.unsupported.push(Element::bare(child).words()),
            tag if SEEN.contains(&tag) => self.seen.push(tag.to_owned()),
            tag => {
                let message = format!("<{tag}> is not supported here: write the elements that it generates");
                return Err(Element::bare(child).fault(message));
            }
        }
        Ok(())
    }

    /// The context of the elements of a `<frame>`.
    fn frame<'a>(&self, node: Node<'a, 'a>, around: &Context<'a>) -> Result<Context<'a>, ImportError> {
        let own = Element::bare(node);
        own.check_known(&frame::ATTRIBUTES, &["childclass"])?;
        let offset = around.offset * frame::frame(&own, &self.angles)?;
        let class = node.attribute("childclass").or(around.class);
        Ok(Context { offset, class, is_frame: true, ..around.clone() })
    }

    /// Reads the child bodies of link `parent`.
    fn carried(&mut self, node: Node<'_, '_>, parent: usize, place: &Context<'_>) {
        for child in node.children().filter(Node::is_element) {
            if child.has_tag_name("frame") {
                // A frame that cannot be read is reported with the content of its body.
                if let Ok(place) = self.frame(child, place) {
                    self.carried(child, parent, &place);
                }
            } else if child.has_tag_name("body") {
                let read = self.body(child, parent, place);
                self.robot.keep(read);
            }
        }
    }

    /// Reads a child body of link `parent`, and all its descendants.
    fn body(&mut self, node: Node<'_, '_>, parent: usize, around: &Context<'_>) -> Result<(), ImportError> {
        let own = Element::bare(node);
        let known =
            own.check_known(&frame::ATTRIBUTES, &["childclass", "mocap", "gravcomp", "user", "sleep"]);
        self.robot.keep(known);
        let frame = self.robot.keep(frame::frame(&own, &self.angles)).unwrap_or_default();
        let mut origin = around.offset * frame;
        let name = own.text("name").map_or_else(|| format!("body{}", self.robot.links.len()), str::to_owned);
        if own.number("gravcomp", 0.0)? != 0.0 {
            self.robot
                .unsupported
                .push(format!("the compensated weight of body `{name}` ({})", own.location()));
        }
        if own.flag("mocap", false)? {
            self.robot.left_out.push(format!("the prescribed motion of body `{name}`, which is fixed"));
        }
        let has_inertial = children(node, "inertial").next().is_some();
        let place = Context {
            offset: Motion::identity(),
            class: node.attribute("childclass").or(around.class),
            is_world: false,
            needs_geoms: match self.from_geoms {
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
        for (number, element) in content.joints.iter().enumerate() {
            let is_last = number + 1 == count;
            let child = self.robot.links.len();
            let joint_name = match element.text("name") {
                Some(name) => name.to_owned(),
                None if count == 1 => format!("{name}_joint"),
                None => format!("{name}_joint{}", number + 1),
            };
            let link = if is_last { name.clone() } else { format!("{name} behind {joint_name}") };
            let source = own.location().to_owned();
            self.robot.links.push(Link::new(link, inertia.filter(|_| is_last), source));
            let compiled = (&self.angles, self.autolimits);
            let read = joint::joint(element, compiled, (joint_name.clone(), carrier, child, origin));
            let fixed = || RobotJoint::new(joint_name, Freedom::Fixed, carrier, child, origin);
            let joint = self.robot.keep(read).unwrap_or_else(fixed);
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
        self.carried(node, carrier, &place);
        Ok(())
    }
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
