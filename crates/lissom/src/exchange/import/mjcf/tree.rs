//! Elements of MJCF in a tree of their own: with the defaults of their classes, their location, and the settings of their file. What
//! generates elements changes this tree before it is converted.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use roxmltree::Document;

use super::super::ImportError;
use super::super::xml::SOURCE;
use super::element::{Classes, Element};
use super::frame::Angles;
use super::outside;

/// Source of the inertia of a body.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Inertias {
    Given,
    GivenOrGeoms,
    Geoms,
}

impl Inertias {
    pub(super) fn read(compiler: &Element) -> Result<Self, ImportError> {
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

/// Settings of a file, which differ between a model and those that it attaches.
pub(super) struct Settings {
    pub(super) angles: Angles,
    pub(super) autolimits: bool,
    pub(super) from_geoms: Inertias,
    /// Groups of geoms from which inertia is computed.
    pub(super) groups: [f64; 2],
    /// Folders of meshes; empty if the text has no folder.
    pub(super) mesh_folders: Vec<PathBuf>,
    /// Folder of the file, if it has one.
    pub(super) folder: Option<PathBuf>,
    /// The settings as they were written.
    pub(super) compiler: Element,
}

impl Settings {
    fn read(document: &Document<'_>, folder: Option<&Path>) -> Result<Self, ImportError> {
        let root = document.root_element();
        let compilers = root.children().filter(|child| child.has_tag_name("compiler"));
        let compiler = compilers.map(Element::bare).reduce(Element::merged);
        let compiler = compiler.unwrap_or_else(|| Element::empty("compiler"));
        outside::check_compiler(&compiler)?;
        let own = compiler.text("meshdir").or(compiler.text("assetdir")).unwrap_or_default();
        Ok(Self {
            angles: Angles::read(&compiler)?,
            autolimits: compiler.flag("autolimits", true)?,
            from_geoms: Inertias::read(&compiler)?,
            groups: compiler.numbers::<2>("inertiagrouprange")?.unwrap_or([0.0, 5.0]),
            mesh_folders: folder.map(|folder| vec![folder.join(own), folder.to_owned()]).unwrap_or_default(),
            folder: folder.map(Path::to_owned),
            compiler,
        })
    }
}

/// An element with its content.
#[derive(Clone)]
pub(super) struct Node {
    pub(super) element: Element,
    pub(super) children: Vec<Node>,
    pub(super) settings: Rc<Settings>,
}

impl Node {
    /// The tree of a document. Faults of its default classes are obstacles.
    ///
    /// # Errors
    /// If settings of its compiler are not supported, or default classes are incomplete.
    pub(super) fn read(
        document: &Document<'_>,
        folder: Option<&Path>,
        obstacles: &mut Vec<String>,
    ) -> Result<Self, ImportError> {
        let settings = Rc::new(Settings::read(document, folder)?);
        let classes = Classes::read(document.root_element())?;
        let text = document.input_text();
        let mut position = Position { text, at: 0, line: 1, file: String::new() };
        // Instructions before the root state the file of its first elements.
        for child in document.root().children() {
            position.pass(child);
        }
        let mut builder = Builder { settings, classes, position, obstacles };
        Ok(builder.node(document.root_element(), None, ""))
    }

    /// An element that is generated at the place of another.
    pub(super) fn generated(&self, tag: &str, attributes: &[(&str, String)], children: Vec<Self>) -> Self {
        let mut element = Element::empty(tag);
        self.element.location().clone_into(&mut element.location);
        for (key, value) in attributes {
            element.set(key, value.clone());
        }
        Self { element, children, settings: Rc::clone(&self.settings) }
    }

    pub(super) fn has_tag(&self, tag: &str) -> bool {
        self.element.has_tag(tag)
    }

    pub(super) fn tag(&self) -> &str {
        self.element.tag()
    }

    pub(super) fn attribute(&self, key: &str) -> Option<&str> {
        self.element.text(key)
    }

    pub(super) fn name(&self) -> Option<&str> {
        self.element.text("name")
    }

    /// Children of this tag.
    pub(super) fn of<'a>(&'a self, tag: &'a str) -> impl Iterator<Item = &'a Self> {
        self.children.iter().filter(move |child| child.has_tag(tag))
    }

    /// Children of children of this tag, such as the joints of all sections `equality`.
    pub(super) fn within<'a>(&'a self, tag: &'a str) -> impl Iterator<Item = &'a Self> {
        self.of(tag).flat_map(|section| &section.children)
    }

    /// Number of elements, with this one.
    pub(super) fn size(&self) -> usize {
        1 + self.children.iter().map(Self::size).sum::<usize>()
    }

    /// Number of elements that contain each other one in the other.
    pub(super) fn depth(&self) -> usize {
        1 + self.children.iter().map(Self::depth).max().unwrap_or(0)
    }

    /// Calls `visit` with this element and all within it.
    pub(super) fn each_mut(&mut self, visit: &mut impl FnMut(&mut Element)) {
        visit(&mut self.element);
        self.children.iter_mut().for_each(|child| child.each_mut(visit));
    }

    /// Calls `visit` with this element and all within it.
    pub(super) fn each<'a>(&'a self, visit: &mut impl FnMut(&'a Self)) {
        visit(self);
        self.children.iter().for_each(|child| child.each(visit));
    }

    /// The element with this tag and name, within this one.
    pub(super) fn find(&self, tag: &str, name: &str) -> Option<&Self> {
        if self.has_tag(tag) && self.name() == Some(name) {
            return Some(self);
        }
        self.children.iter().find_map(|child| child.find(tag, name))
    }
}

/// A position in a text with all included files in it.
struct Position<'a> {
    text: &'a str,
    at: usize,
    line: usize,
    file: String,
}

impl Position<'_> {
    /// Moves to the begin of an element, or behind an instruction, which states file and line.
    fn pass(&mut self, node: roxmltree::Node<'_, '_>) {
        if let Some(own) = node.pi().filter(|own| own.target == SOURCE) {
            let (line, file) =
                own.value.unwrap_or_default().split_once(' ').unwrap_or((own.value.unwrap_or_default(), ""));
            self.line = line.parse().unwrap_or(self.line);
            file.clone_into(&mut self.file);
            self.at = node.range().end;
        } else if node.is_element() && node.range().start >= self.at {
            self.line += self.text[self.at..node.range().start].matches('\n').count();
            self.at = node.range().start;
        }
    }

    fn words(&self) -> String {
        if self.file.is_empty() {
            format!("line {}", self.line)
        } else {
            format!("line {} of {}", self.line, self.file)
        }
    }
}

struct Builder<'a, 'o> {
    settings: Rc<Settings>,
    classes: Classes,
    position: Position<'a>,
    obstacles: &'o mut Vec<String>,
}

impl Builder<'_, '_> {
    /// The tree of a node in a section of the root, which is empty outside of all, within bodies of the default class `around`.
    fn node(&mut self, node: roxmltree::Node<'_, '_>, around: Option<&str>, section: &str) -> Node {
        self.position.pass(node);
        let location = self.position.words();
        let around = node.attribute("childclass").or(around);
        let tag = node.tag_name().name();
        let is_entry = node.parent_element().is_some_and(|parent| parent.has_tag_name(section));
        let keys: Vec<&str> = match section {
            "worldbody" if !matches!(tag, "worldbody" | "body" | "frame") => vec![tag],
            "asset" | "contact" => vec![tag],
            "equality" | "tendon" if is_entry => vec![section],
            "actuator" if is_entry => vec!["general", tag],
            _ => Vec::new(),
        };
        let mut attributes = BTreeMap::new();
        let class = node.attribute("class").or(around).filter(|_| !keys.is_empty());
        for key in keys {
            match self.classes.of(key, class) {
                Ok(own) => attributes.extend(own),
                Err(message) => self.obstacles.push(format!("{location}: {message}")),
            }
        }
        attributes.extend(node.attributes().map(|own| (own.name().to_owned(), own.value().to_owned())));
        let element = Element { tag: tag.to_owned(), location, attributes };
        let inner = match node.parent_element() {
            Some(parent) if parent.parent_element().is_none() => tag,
            _ => section,
        };
        let mut children = Vec::new();
        for child in node.children() {
            if child.is_element() {
                children.push(self.node(child, around, inner));
            } else {
                self.position.pass(child);
            }
        }
        Node { element, children, settings: Rc::clone(&self.settings) }
    }
}
