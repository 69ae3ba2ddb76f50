//! SDF, the description of Gazebo and Drake: models in a world, poses relative to named frames, included models. A description of one
//! model has its link without a parent as root; several models, static ones and those in a `<world>` have the world.

mod element;
mod frames;
mod joint;
mod link;
mod shape;

use std::path::Path;

use lissom_motion::Motion;

use self::element::Element;
use self::frames::{Carrier, Frames, Scope};
use self::joint::Placed;
use self::link::is_inertial_unit;
use super::xml;
use super::{Closure, ContactRules, Freedom, ImportError, Link, Robot, RobotJoint, RobotRoot};

/// Gravity of a world without a value [m/s²].
const GRAVITY: [f64; 3] = [0.0, 0.0, -9.8];
/// Elements that neither act nor are drawn, or that are drawn around the links.
const SHOWN: [&str; 17] = [
    "audio",
    "gui",
    "scene",
    "light",
    "atmosphere",
    "magnetic_field",
    "spherical_coordinates",
    "wind",
    "road",
    "sensor",
    "projector",
    "audio_sink",
    "audio_source",
    "battery",
    "particle_emitter",
    "actor",
    "gripper",
];
/// Elements that are read with the element around them, or have no effect.
const READ_AROUND: [&str; 11] = [
    "pose",
    "static",
    "self_collide",
    "allow_auto_disable",
    "must_be_base_link",
    "inertial",
    "visual",
    "collision",
    "gravity",
    "physics",
    "velocity_decay",
];
/// Parts of names of plugins that exert forces without a command.
const FORCES: [&str; 6] = ["buoyancy", "hydrodynamic", "lift", "drag", "wind", "spring"];

/// Reads a robot from the text of an SDF file, without files that it includes.
///
/// # Errors
/// If it is not SDF of version 1.4 to 1.12, has several worlds, or its joints do not form a tree with closed loops.
pub fn from_sdf(text: &str) -> Result<Robot, ImportError> {
    in_folder(text, None)
}

/// Reads a robot from the text of an SDF file in a folder, in and beside which included models are.
pub(super) fn in_folder(text: &str, folder: Option<&Path>) -> Result<Robot, ImportError> {
    let mut root = Element::read(text, "")?;
    root.include(folder, 0, &mut 0)?;
    let worlds: Vec<&Element> = root.children.iter().filter(|child| child.tag == "world").collect();
    let top = match worlds[..] {
        [] => &root,
        [world] => world,
        _ => return Err(worlds[1].fault("the description has several worlds: keep one")),
    };
    let mut reader = Reader {
        frames: Frames::new(),
        links: Vec::new(),
        joints: Vec::new(),
        models: Vec::new(),
        shown: Vec::new(),
        surfaces: 0,
        robot: Robot {
            name: top.attribute("name").unwrap_or("robot").to_owned(),
            gravity: GRAVITY.into(),
            root: if worlds.is_empty() { RobotRoot::default() } else { RobotRoot::World },
            contacts: ContactRules {
                filters_parents: true,
                takes_lower_friction: true,
                ..ContactRules::default()
            },
            ..Robot::default()
        },
    };
    // Beside a world nothing is read.
    for child in root.children.iter().filter(|child| !worlds.is_empty() && child.tag != "world") {
        reader.other(child);
    }
    let read = reader.world(top);
    reader.robot.keep(read);
    reader.content(top, &Around { scope: 0, is_static: false, collides: false, model: None });
    reader.assembled()
}

/// Context of the content of a model or of the world.
#[derive(Clone, Copy)]
struct Around {
    scope: usize,
    is_static: bool,
    /// Whether links of the model touch each other.
    collides: bool,
    /// Number of the outermost model.
    model: Option<usize>,
}

/// A link of the description.
struct Body<'a> {
    element: &'a Element,
    frame: usize,
    around: Around,
}

/// A joint of the description, with the links that it joins; none for the world.
struct Joined<'a> {
    element: &'a Element,
    frame: usize,
    parent: Option<usize>,
    child: usize,
}

struct Reader<'a> {
    frames: Frames,
    links: Vec<Body<'a>>,
    joints: Vec<(&'a Element, usize)>,
    /// Names of the outermost models.
    models: Vec<&'a str>,
    /// Tags of elements that are only drawn or measured.
    shown: Vec<String>,
    /// Number of surfaces with properties that are omitted.
    surfaces: usize,
    robot: Robot,
}

impl<'a> Reader<'a> {
    /// Reads what acts on all models.
    fn world(&mut self, top: &'a Element) -> Result<(), ImportError> {
        let old = top.child("physics").map_or(Ok(None), |physics| physics.numbers::<3>("gravity"))?;
        self.robot.gravity = top.numbers::<3>("gravity")?.or(old).unwrap_or(GRAVITY).into();
        if let Some(physics) = top.child("physics") {
            self.robot.contacts.step = Some(physics.positive("max_step_size", 1e-3)?);
        }
        Ok(())
    }

    fn content(&mut self, element: &'a Element, around: &Around) {
        // Joints of old versions may have the name of another element, which counts.
        let (joints, others): (Vec<_>, Vec<_>) =
            element.children.iter().partition(|child| child.tag == "joint");
        for child in others.into_iter().chain(joints) {
            let read = self.entry(child, around);
            self.robot.keep(read);
        }
    }

    fn entry(&mut self, child: &'a Element, around: &Around) -> Result<(), ImportError> {
        let Around { scope, .. } = *around;
        let own = self.frames.scopes[scope].own;
        match child.tag.as_str() {
            "model" => self.model(child, around)?,
            "link" => {
                let carrier = Carrier::Link(self.links.len());
                let frame = self.frames.add(child, scope, child.name()?, (Err(own), carrier))?;
                self.links.push(Body { element: child, frame, around: *around });
                self.content_of_link(child)?;
            }
            "joint" => {
                let moved = child.word("child").ok_or_else(|| child.fault("it has no <child>"))?.to_owned();
                let carrier = Carrier::Named(moved.clone());
                let name = child.name()?.to_owned();
                let taken = self.frames.find(scope, &name);
                let is_taken = taken.is_some_and(|own| self.joints.iter().all(|(_, joint)| *joint != own));
                let name = if is_taken { format!("{name}_joint") } else { name };
                let frame = self.frames.add(child, scope, &name, (Ok(moved), carrier))?;
                self.joints.push((child, frame));
            }
            "frame" => {
                let attached = child.attribute("attached_to").map(str::to_owned);
                let carrier = attached.clone().map_or(Carrier::Frame(own), Carrier::Named);
                self.frames.add(child, scope, child.name()?, (attached.ok_or(own), carrier))?;
            }
            _ => self.other(child),
        }
        Ok(())
    }

    /// What may be in a world, a model or a link, and is not converted.
    fn other(&mut self, child: &Element) {
        let words = child.words();
        match child.tag.as_str() {
            "plugin" => {
                let name = format!("{:?}", child.attributes).to_lowercase();
                let acts = FORCES.iter().any(|word| name.contains(word));
                let all = if acts { &mut self.robot.unsupported } else { &mut self.robot.left_out };
                all.push(format!("{words}, with its forces and commands"));
            }
            "enable_wind" | "kinematic" => {
                if !matches!(child.text.as_str(), "false" | "0") {
                    self.robot.unsupported.push(words);
                }
            }
            // Softness of contacts and colours for Drake.
            "drake:proximity_properties"
            | "drake:perception_properties"
            | "drake:illustration_properties" => {
                self.robot.left_out.push(words);
            }
            tag if SHOWN.contains(&tag) => self.shown.push(tag.to_owned()),
            tag if READ_AROUND.contains(&tag) => {}
            _ => self.robot.unsupported.push(words),
        }
    }

    fn content_of_link(&mut self, link: &Element) -> Result<(), ImportError> {
        if let Some(decay) = link.child("velocity_decay")
            && (decay.number("linear", 0.0)? != 0.0 || decay.number("angular", 0.0)? != 0.0)
        {
            self.robot.unsupported.push(decay.words());
        }
        for child in link.children.iter().filter(|child| !is_inertial_unit(child)) {
            self.other(child);
        }
        Ok(())
    }

    fn model(&mut self, element: &'a Element, around: &Around) -> Result<(), ImportError> {
        let name = element.name()?;
        let is_merged = element.attribute("merge").is_some_and(|word| matches!(word, "true" | "1"));
        // Names of a merged model are those of the model around it.
        let (own, inner) = if is_merged {
            (format!("_merged__{name}__model__"), String::new())
        } else {
            (name.to_owned(), format!("{name}::"))
        };
        let is_static = around.is_static || element.flag("static")?;
        let first = |tag: &str| element.child(tag).and_then(|child| child.attribute("name"));
        let canonical =
            element.attribute("canonical_link").or_else(|| first("link")).or_else(|| first("model"));
        let carrier = match canonical.filter(|_| !is_static) {
            Some(canonical) => Carrier::Named(format!("{inner}{canonical}")),
            None => Carrier::World,
        };
        let outer = self.frames.scopes[around.scope].own;
        let frame = self.frames.add(element, around.scope, &own, (Err(outer), carrier))?;
        let prefix = format!("{}{inner}", self.frames.scopes[around.scope].prefix);
        let scope = self.frames.scopes.len();
        self.frames.scopes.push(Scope { prefix, own: frame });
        if let Some(placed) = element.attribute("placement_frame") {
            self.frames.place(frame, scope, placed);
        }
        let model = around.model.unwrap_or(self.models.len());
        if around.model.is_none() {
            self.models.push(name);
        }
        let collides = if element.child("self_collide").is_some() {
            element.flag("self_collide")?
        } else {
            around.collides
        };
        self.content(element, &Around { scope, is_static, collides, model: Some(model) });
        Ok(())
    }

    /// The name in the model of the frame's element: without that of its model if there is no other.
    fn name(&self, frame: usize) -> String {
        let name = &self.frames.all[frame].name;
        let only = if self.models.len() == 1 { self.models.first() } else { None };
        let inner = only.and_then(|model| name.strip_prefix(model)?.strip_prefix("::"));
        inner.unwrap_or(name).to_owned()
    }

    /// The joint with the links of its ends.
    fn joined(&self, element: &'a Element, frame: usize) -> Result<Joined<'a>, ImportError> {
        let scope = self.frames.all[frame].scope;
        let end = |tag: &str| {
            let name = element.word(tag).ok_or_else(|| element.fault(format!("it has no <{tag}>")))?;
            self.frames.link(self.frames.required(scope, name, element)?)
        };
        let parent = end("parent")?;
        let child =
            end("child")?.ok_or_else(|| element.fault("its child is the world, which cannot move"))?;
        if parent == Some(child) {
            return Err(element.fault("its parent and its child are the same link"));
        }
        Ok(Joined { element, frame, parent, child })
    }

    /// The robot of all links and joints.
    fn assembled(mut self) -> Result<Robot, ImportError> {
        let (poses, faults) = self.frames.poses();
        self.robot.obstacles.extend(faults);
        let mut joints = Vec::new();
        for &(element, frame) in &self.joints {
            joints.extend(self.robot.keep(self.joined(element, frame)));
        }
        // A gear between two joints is none in the tree, and between immovable links joints have no effect.
        let is_static = |link: usize| self.links[link].around.is_static;
        joints.retain(|joint| !(is_static(joint.child) && joint.parent.is_none_or(is_static)));
        joints.retain(|joint| {
            let is_gear = joint.element.attribute("type") == Some("gearbox");
            self.robot.unsupported.extend(is_gear.then(|| format!("the gearbox {}", joint.element.words())));
            !is_gear
        });
        // The tree has the first joint of each link, unless it would lead back to the link: other joints close loops.
        let mut is_carried: Vec<bool> = self.links.iter().map(|link| link.around.is_static).collect();
        let mut parents: Vec<Option<usize>> = vec![None; self.links.len()];
        let mut closes = Vec::new();
        for joint in &joints {
            let leads_back = || {
                let mut above = std::iter::successors(joint.parent, |link| parents[*link]);
                above.any(|link| link == joint.child)
            };
            let is_closure = is_carried[joint.child] || leads_back();
            if !is_closure {
                (is_carried[joint.child], parents[joint.child]) = (true, joint.parent);
            }
            closes.push(is_closure);
        }
        let is_root_the_world = self.robot.is_root_the_world()
            || self.models.len() != 1
            || self.links.iter().any(|link| link.around.is_static)
            || joints.iter().any(|joint| joint.parent.is_none())
            || is_carried.iter().filter(|carried| !**carried).count() != 1;
        if is_root_the_world {
            self.robot.root = RobotRoot::World;
            self.robot.links.push(Link::new("world".to_owned(), None, String::new()));
        }
        let shift = usize::from(is_root_the_world);
        if let Some(name) = self.models.first().filter(|_| self.models.len() == 1) {
            (*name).clone_into(&mut self.robot.name);
        }
        for number in 0..self.links.len() {
            let link = self.link(number, &poses);
            self.robot.links.push(link);
        }
        let to_world = |reader: &Self, link: usize, freedom: Freedom| {
            let name = format!("{} on the world", reader.robot.links[link + shift].name);
            let origin = poses[reader.links[link].frame];
            RobotJoint {
                source: reader.links[link].element.source.clone(),
                ..RobotJoint::new(name, freedom, 0, link + shift, origin)
            }
        };
        for link in (0..self.links.len()).filter(|&link| self.links[link].around.is_static) {
            let fixed = to_world(&self, link, Freedom::Fixed);
            self.robot.joints.push(fixed);
        }
        for (joint, closes) in joints.iter().zip(closes) {
            if closes {
                self.close(joint, shift, &poses);
            } else {
                let read = self.join(joint, shift, &poses);
                self.robot.keep(read);
            }
        }
        for link in (0..self.links.len()).filter(|&link| !is_carried[link]) {
            if is_root_the_world {
                let free = to_world(&self, link, Freedom::Floating);
                self.robot.joints.push(free);
            } else {
                self.robot.root = RobotRoot::Link(poses[self.links[link].frame]);
            }
        }
        self.notes();
        if self.links.is_empty() {
            let none = vec!["the description has no link".to_owned()];
            return Err(ImportError::of(if self.robot.obstacles.is_empty() {
                &none
            } else {
                &self.robot.obstacles
            }));
        }
        // Faults of the description may leave links without a joint.
        let mut robot = if self.robot.obstacles.is_empty() { self.robot.in_order()? } else { self.robot };
        robot.fix_massless_ends();
        robot.motors_by_effort();
        Ok(robot)
    }

    /// What is omitted, in sentences.
    fn notes(&mut self) {
        let shown = xml::counted(std::mem::take(&mut self.shown).into_iter());
        if !shown.is_empty() {
            self.robot.left_out.push(format!("elements: {}", shown.join(", ")));
        }
        if self.surfaces > 0 {
            self.robot.left_out.push(format!(
                "properties of {} surfaces other than the friction `mu` and bitmasks, such as their softness",
                self.surfaces
            ));
        }
        self.robot.note_speed_limits();
    }

    /// Adds the joints of an element.
    fn join(&mut self, joint: &Joined<'_>, shift: usize, poses: &[Motion]) -> Result<(), ImportError> {
        let scope = self.frames.all[joint.frame].scope;
        let child_pose = poses[self.links[joint.child].frame];
        let parent_pose = joint.parent.map_or_else(Motion::identity, |link| poses[self.links[link].frame]);
        let in_child = |frame: usize| child_pose.inverse() * poses[frame];
        let turn = |axis: &Element| {
            let named = axis.child("xyz").and_then(|xyz| xyz.attribute("expressed_in"));
            Ok(in_child(match named {
                Some(name) => self.frames.required(scope, name, axis)?,
                None if axis.flag("use_parent_model_frame")? => self.frames.scopes[scope].own,
                None => joint.frame,
            }))
        };
        let leader = |name: &str| Some(self.name(self.frames.find(scope, name)?));
        let placed = Placed {
            origin: parent_pose.inverse() * child_pose,
            anchor: in_child(joint.frame).position,
            turn: &turn,
            leader: &leader,
        };
        let ends = (joint.parent.map_or(0, |link| link + shift), joint.child + shift);
        let name = self.name(joint.frame);
        let mut unsupported = Vec::new();
        let read = joint::joints(joint.element, (&name, ends.0, ends.1), &placed, &mut unsupported);
        let origin = placed.origin;
        self.robot.unsupported.extend(unsupported);
        // A joint with faults still holds its link, so that other faults are found.
        let read = read.inspect_err(|_| {
            self.robot.joints.push(RobotJoint::new(name.clone(), Freedom::Fixed, ends.0, ends.1, origin));
        })?;
        for sensor in joint.element.children.iter().filter(|child| child.tag == "sensor") {
            self.shown.push(sensor.tag.clone());
        }
        let (mut parent, mut origin, last) = (ends.0, origin, read.len() - 1);
        for (number, mut own) in read.into_iter().enumerate() {
            (own.parent, own.origin) = (parent, origin);
            if number < last {
                own.child = self.robot.links.len();
                let between = Link::new(format!("{name} between"), None, own.source.clone());
                self.robot.links.push(Link { is_between: true, ..between });
            }
            (parent, origin) = (own.child, Motion::identity());
            self.robot.joints.push(own);
        }
        Ok(())
    }

    /// Closes a loop by a joint whose child is already the child of another one.
    fn close(&mut self, joint: &Joined<'_>, shift: usize, poses: &[Motion]) {
        let kind = joint.element.attribute("type").unwrap_or_default();
        if !matches!(kind, "fixed" | "ball") {
            let words = joint.element.words();
            self.robot.unsupported.push(format!(
                "the {kind} joint {words}, whose child is also that of another joint: only fixed and ball joints close loops"
            ));
            return;
        }
        let parent_pose = joint.parent.map_or_else(Motion::identity, |link| poses[self.links[link].frame]);
        self.robot.closures.push(Closure {
            name: self.name(joint.frame),
            locks_rotation: kind == "fixed",
            links: [joint.parent.map_or(0, |link| link + shift), joint.child + shift],
            anchor: (parent_pose.inverse() * poses[joint.frame]).position,
            source: joint.element.source.clone(),
        });
    }
}
