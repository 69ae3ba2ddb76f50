//! What generates elements: `<replicate>`, copies of its content with an offset from each to the next, and `<attach>`, elements of
//! another model or of this one. Both become frames with the generated elements, whose names have a suffix or a prefix. Elements of other
//! sections that refer to generated elements are copied with them.

use std::collections::BTreeSet;
use std::path::Path;

use lissom_motion::Motion;

use super::super::{ImportError, include, xml};
use super::element::Element;
use super::frame;
use super::tree::Node;

/// Largest number of elements that a description may generate.
const MAX_ELEMENTS: usize = 500_000;
/// Largest number of models that attach each other one in the other.
const MAX_ATTACHED: usize = 20;
/// Sections whose elements refer to others, in an order in which each refers only to earlier ones and to bodies.
const REFERRING: [&str; 5] = ["tendon", "contact", "equality", "actuator", "sensor"];
/// Attributes whose value is the name of an element: the attribute, and what it names.
const REFERENCES: [(&str, &str); 20] = [
    ("joint", "joint"),
    ("joint1", "joint"),
    ("joint2", "joint"),
    ("jointinparent", "joint"),
    ("body", "body"),
    ("body1", "body"),
    ("body2", "body"),
    ("site", "site"),
    ("site1", "site"),
    ("site2", "site"),
    ("sidesite", "site"),
    ("refsite", "site"),
    ("cranksite", "site"),
    ("slidersite", "site"),
    ("geom", "geom"),
    ("geom1", "geom"),
    ("geom2", "geom"),
    ("tendon", "tendon"),
    ("tendon1", "tendon"),
    ("tendon2", "tendon"),
];

/// Names of elements, each with what it names.
type Named = BTreeSet<(&'static str, String)>;

/// A tree with the elements that it generates, and what could not be generated.
pub(super) fn expanded(mut root: Node, obstacles: &mut Vec<String>) -> Node {
    let original = root.clone();
    let mut expansion = Expansion { original, models: Vec::new(), depth: 0, count: root.size(), obstacles };
    expansion.models_of(&root);
    expansion.whole(&mut root);
    root
}

struct Expansion<'o> {
    /// The description before anything was generated.
    original: Node,
    /// Models that may be attached, by name.
    models: Vec<(String, Node)>,
    /// Number of models within each other.
    depth: usize,
    /// Number of elements.
    count: usize,
    obstacles: &'o mut Vec<String>,
}

impl Expansion<'_> {
    /// Reads the models that may be attached.
    fn models_of(&mut self, root: &Node) {
        for own in root.within("asset").filter(|own| own.has_tag("model")) {
            match self.model(own) {
                Ok(model) => self.models.push(model),
                Err(error) => self.obstacles.push(error.message),
            }
        }
    }

    fn model(&mut self, own: &Node) -> Result<(String, Node), ImportError> {
        let element = &own.element;
        let file = element.text("file").ok_or_else(|| element.fault("it has no `file`"))?;
        if self.depth >= MAX_ATTACHED {
            let message =
                format!("{MAX_ATTACHED} models attach each other one in the other: attach them side by side");
            return Err(element.fault(message));
        }
        let folder = own.settings.folder.as_ref().ok_or_else(|| {
            element.fault(format!("the file `{file}` is not read from a text without a folder"))
        })?;
        let path = folder.join(file);
        if !path.is_file() {
            let message = format!("the file `{file}` is not there: put it in the folder of the description");
            return Err(element.fault(message));
        }
        let within = |error: ImportError| element.fault(format!("`{file}`: {}", error.message));
        let text = include::with_included(&path).map_err(within)?;
        let document = xml::parse(&text).map_err(within)?;
        let name = element.text("name").or(document.root_element().attribute("model")).unwrap_or(file);
        let mut obstacles = Vec::new();
        let mut root = Node::read(&document, path.parent().or(Some(Path::new(""))), &mut obstacles)
            .map_err(|error| element.fault(format!("`{file}`: {}", error.message)))?;
        root.each_mut(&mut |element| {
            if !element.location.contains(" of ") {
                element.location = format!("{} of {file}", element.location);
            }
        });
        let mut inner = Expansion {
            original: root.clone(),
            models: Vec::new(),
            depth: self.depth + 1,
            count: self.count,
            obstacles: &mut obstacles,
        };
        inner.models_of(&root);
        inner.whole(&mut root);
        self.obstacles.extend(obstacles);
        Ok((name.to_owned(), root))
    }

    /// Expands all bodies of a root.
    fn whole(&mut self, root: &mut Node) {
        let mut sections: Vec<Node> = std::mem::take(&mut root.children);
        let mut rest: Vec<Node> = Vec::new();
        let mut worlds: Vec<Node> = Vec::new();
        for section in sections.drain(..) {
            if section.has_tag("worldbody") { worlds.push(section) } else { rest.push(section) }
        }
        for world in &mut worlds {
            let children = std::mem::take(&mut world.children);
            world.children = self.content(children, &mut rest, 0);
        }
        rest.append(&mut worlds);
        root.children = rest;
    }

    /// The content of a body or frame, `depth` elements deep; references to it are in `sections`.
    fn content(&mut self, children: Vec<Node>, sections: &mut Vec<Node>, depth: usize) -> Vec<Node> {
        let mut all = Vec::with_capacity(children.len());
        for mut child in children {
            match child.tag() {
                "replicate" => match self.replicate(child, sections, depth) {
                    Ok(copies) => all.extend(copies),
                    Err(error) => self.obstacles.push(error.message),
                },
                "attach" => match self.attach(&child, sections, depth) {
                    Ok(attached) => all.push(attached),
                    Err(error) => self.obstacles.push(error.message),
                },
                "body" | "frame" => {
                    let inner = std::mem::take(&mut child.children);
                    child.children = self.content(inner, sections, depth + 1);
                    all.push(child);
                }
                _ => all.push(child),
            }
        }
        all
    }

    /// Counts elements that are about to be generated.
    fn count(&mut self, element: &Element, more: usize) -> Result<(), ImportError> {
        self.count = self.count.saturating_add(more);
        if self.count > MAX_ELEMENTS {
            let message = format!(
                "the description generates more than {MAX_ELEMENTS} elements: reduce `count`, or write a description with fewer"
            );
            self.count = self.count.saturating_sub(more);
            return Err(element.fault(message));
        }
        Ok(())
    }

    fn replicate(
        &mut self,
        mut node: Node,
        sections: &mut Vec<Node>,
        depth: usize,
    ) -> Result<Vec<Node>, ImportError> {
        let inner = std::mem::take(&mut node.children);
        let inner = self.content(inner, sections, depth + 1);
        let element = &node.element;
        element.check_known(&["count", "sep", "offset", "euler"], &["childclass"])?;
        let count = element.numbers::<1>("count")?.ok_or_else(|| element.fault("it has no `count`"))?[0];
        if count.fract() != 0.0 || !(1.0..1e9).contains(&count) {
            return Err(element.fault(format!("`count` must be a positive integer, not {count}")));
        }
        let count = count as usize;
        let size: usize = inner.iter().map(Node::size).sum();
        self.count(element, size.saturating_mul(count))?;
        let offset = element.numbers::<3>("offset")?.unwrap_or_default();
        let mut step_element = Element::empty("replicate");
        if let Some(euler) = element.text("euler") {
            step_element.set("euler", euler.to_owned());
        }
        let turn = frame::frame(&step_element, &node.settings.angles)?.rotation;
        let step = Motion::new(turn, offset.into());
        let digits = count.ilog10() as usize + 1;
        let suffix = |index: usize| format!("{}{index:0digits$}", element.text("sep").unwrap_or_default());
        let mut names = Named::new();
        for own in &inner {
            names_in(own, &mut names);
        }
        let mut all = Vec::new();
        let mut place = Motion::identity();
        for index in 0..count {
            let rename = |name: &str| format!("{name}{}", suffix(index));
            let copy = inner.iter().map(|own| renamed(own, &names, &rename)).collect();
            all.push(frame_at(&node, &place, copy));
            place = place * step;
        }
        for tag in REFERRING {
            let mut added = Named::new();
            let mut more = 0;
            for section in sections.iter_mut().filter(|section| section.has_tag(tag)) {
                let mut entries = Vec::new();
                for own in std::mem::take(&mut section.children) {
                    if !refers(&own, &names) {
                        entries.push(own);
                        continue;
                    }
                    more += own.size() * count;
                    name_of(&own, tag, &mut added);
                    for index in 0..count {
                        let rename = |name: &str| format!("{name}{}", suffix(index));
                        let mut copy = referring(&own, &names, &rename);
                        if let Some(name) = own.name() {
                            copy.element.set("name", rename(name));
                        }
                        entries.push(copy);
                    }
                }
                section.children = entries;
            }
            self.count(&node.element, more)?;
            names.append(&mut added);
        }
        Ok(all)
    }

    fn attach(&mut self, node: &Node, sections: &mut Vec<Node>, depth: usize) -> Result<Node, ImportError> {
        let element = &node.element;
        element.check_known(&["model", "body", "frame", "prefix"], &[])?;
        let prefix = element.text("prefix").unwrap_or_default().to_owned();
        let source = match element.text("model") {
            None => self.original.clone(),
            Some(name) => {
                let known = self.models.iter().find(|(known, _)| known == name);
                let found = known.map(|(_, model)| model.clone());
                found
                    .ok_or_else(|| element.fault(format!("there is no <model> `{name}` among the assets")))?
            }
        };
        let (tag, wanted) = match (element.text("body"), element.text("frame")) {
            (Some(_), Some(_)) => return Err(element.fault("it names both a body and a frame: remove one")),
            (Some(body), None) => ("body", Some(body)),
            (None, frame) => ("frame", frame),
        };
        let worlds = || source.of("worldbody");
        let found: Vec<Node> = match wanted {
            Some(name) => {
                let found = worlds().find_map(|world| world.find(tag, name)).cloned();
                vec![found.ok_or_else(|| element.fault(format!("there is no {tag} `{name}` to attach")))?]
            }
            None if element.text("model").is_none() => {
                return Err(element.fault("it names no `model`, and no `body` or `frame` of this one"));
            }
            None => worlds().flat_map(|world| world.children.iter().cloned()).collect(),
        };
        let (size, own_depth) =
            (found.iter().map(Node::size).sum(), found.iter().map(Node::depth).max().unwrap_or(0));
        if depth + own_depth > xml::MAX_DEPTH {
            let message =
                format!("more than {} elements contain each other one in the other", xml::MAX_DEPTH);
            return Err(element.fault(message));
        }
        self.count(element, size)?;
        // Models are complete; what is copied from this one may itself generate elements.
        let found = if element.text("model").is_none() {
            if self.depth >= MAX_ATTACHED {
                return Err(element.fault("the attached elements attach themselves"));
            }
            self.depth += 1;
            let found = self.content(found, &mut Vec::new(), depth + 1);
            self.depth -= 1;
            found
        } else {
            found
        };
        let mut names = Named::new();
        for own in &found {
            names_in(own, &mut names);
        }
        let rename = |name: &str| format!("{prefix}{name}");
        let copy: Vec<Node> = found.iter().map(|own| renamed(own, &names, &rename)).collect();
        let is_other = element.text("model").is_some();
        for tag in REFERRING {
            let entries: Vec<Node> = source.within(tag).cloned().collect();
            for own in &entries {
                if !refers(own, &names) || !refers_only(own, &names) {
                    continue;
                }
                name_of(own, tag, &mut names);
                let mut copy = referring(own, &names, &rename);
                if let Some(name) = own.name() {
                    copy.element.set("name", rename(name));
                }
                self.count(element, copy.size())?;
                match sections.iter_mut().find(|section| section.has_tag(tag)) {
                    Some(section) => section.children.push(copy),
                    None => sections.push(node.generated(tag, &[], vec![copy])),
                }
            }
        }
        let mut attached = node.generated("frame", &[], copy);
        if is_other {
            let assets: Vec<Node> = source
                .within("asset")
                .filter(|own| own.has_tag("mesh") || own.has_tag("hfield"))
                .map(|own| {
                    let mut copy = own.clone();
                    let name = asset_name(own);
                    copy.element.set("name", rename(&name));
                    copy
                })
                .collect();
            if !assets.is_empty() && !has_assets(sections, &assets) {
                sections.push(node.generated("asset", &[], assets));
            }
            attached.each_mut(&mut |own| {
                for key in ["mesh", "hfield"] {
                    if let Some(name) = own.text(key).map(str::to_owned) {
                        own.set(key, rename(&name));
                    }
                }
            });
        }
        Ok(attached)
    }
}

/// Whether assets of the same names are known.
fn has_assets(sections: &[Node], assets: &[Node]) -> bool {
    let known = |name: &str| {
        let mut all = sections.iter().filter(|section| section.has_tag("asset"));
        all.any(|section| section.children.iter().any(|own| own.name() == Some(name)))
    };
    assets.iter().all(|own| own.name().is_some_and(known))
}

/// Name of an asset: its own, or that of its file without folder and extension.
pub(super) fn asset_name(own: &Node) -> String {
    let of_file = || {
        let file = own.attribute("file").unwrap_or_default();
        let stem = Path::new(file).file_stem().unwrap_or_default();
        stem.to_string_lossy().into_owned()
    };
    own.name().map_or_else(of_file, str::to_owned)
}

/// A frame at `place` with these elements, instead of `node`.
fn frame_at(node: &Node, place: &Motion, children: Vec<Node>) -> Node {
    let quaternion = place.rotation.quaternion();
    let words = |values: &[f64]| {
        let all: Vec<String> = values.iter().map(|value| format!("{value:?}")).collect();
        all.join(" ")
    };
    let position = [place.position.x, place.position.y, place.position.z];
    node.generated("frame", &[("pos", words(&position)), ("quat", words(&quaternion))], children)
}

/// What an element of a body is in references to it.
fn kind_of(element: &Element) -> Option<&'static str> {
    match element.tag() {
        "body" => Some("body"),
        "joint" | "freejoint" => Some("joint"),
        "geom" => Some("geom"),
        "site" => Some("site"),
        "frame" => Some("frame"),
        "camera" => Some("camera"),
        "light" => Some("light"),
        _ => None,
    }
}

fn names_in(node: &Node, names: &mut Named) {
    node.each(&mut |own| {
        if let (Some(kind), Some(name)) = (kind_of(&own.element), own.name()) {
            names.insert((kind, name.to_owned()));
        }
    });
}

/// Adds the name of an element of a section to which others refer.
fn name_of(node: &Node, section: &str, names: &mut Named) {
    if let (Some(name), "tendon") = (node.name(), section) {
        names.insert(("tendon", name.to_owned()));
    }
}

/// A copy of elements of a body with new names.
fn renamed(node: &Node, names: &Named, rename: &impl Fn(&str) -> String) -> Node {
    let mut copy = referring(node, names, rename);
    copy.each_mut(&mut |element| {
        if kind_of(element).is_some()
            && let Some(name) = element.text("name").map(rename)
        {
            element.set("name", name);
        }
    });
    copy
}

/// A copy of an element whose references are to the new names.
fn referring(node: &Node, names: &Named, rename: &impl Fn(&str) -> String) -> Node {
    let mut copy = node.clone();
    copy.each_mut(&mut |element| {
        for (key, kind) in REFERENCES {
            let Some(name) = element.text(key).map(str::to_owned) else { continue };
            if names.contains(&(kind, name.clone())) {
                element.set(key, rename(&name));
            }
        }
    });
    copy
}

/// Names to which an element refers, with those within it.
fn references(node: &Node) -> Vec<(&'static str, String)> {
    let mut found = Vec::new();
    node.each(&mut |own| {
        for (key, kind) in REFERENCES {
            found.extend(own.attribute(key).map(|name| (kind, name.to_owned())));
        }
    });
    found
}

fn refers(node: &Node, names: &Named) -> bool {
    references(node).iter().any(|own| names.contains(own))
}

/// Whether an element refers to nothing else, except the world.
fn refers_only(node: &Node, names: &Named) -> bool {
    references(node).iter().all(|own| names.contains(own) || own.1 == "world")
}
