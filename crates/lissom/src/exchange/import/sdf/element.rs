//! Elements of SDF with their content, in a tree of their own; included models take the place of `<include>`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use lissom_model::files;
use lissom_motion::{Motion, Rotation, Vector3};

use super::super::ImportError;
use super::super::urdf::fixed_axes;
use super::super::xml::{self, Lines};

/// Largest number of files that include each other one in the other.
const MAX_INCLUDED: usize = 20;
/// Largest number of elements of included models.
const MAX_ELEMENTS: usize = 500_000;
/// The version from which axes are in the frame of their joint.
const AXES_IN_JOINTS: u32 = 5;

/// An element with its content.
#[derive(Clone, Default)]
pub(super) struct Element {
    /// Tag, with the prefix of its namespace if it has one.
    pub(super) tag: String,
    pub(super) attributes: BTreeMap<String, String>,
    pub(super) text: String,
    pub(super) children: Vec<Element>,
    /// Location, such as `line 3 of arm.sdf`.
    pub(super) source: String,
}

impl Element {
    /// The root of a text; `file` is named in locations unless it is empty.
    pub(super) fn read(text: &str, file: &str) -> Result<Self, ImportError> {
        let document = xml::parse(text)?;
        let root = document.root_element();
        if !root.has_tag_name("sdf") {
            let message = format!("this is not SDF: its root is <{}>, not <sdf>", root.tag_name().name());
            return Err(ImportError::new(message));
        }
        let mut root = Self::of(root, &Lines::of(text), file);
        let version = root.attribute("version").unwrap_or_default();
        let numbers: Vec<Option<u32>> = version.split('.').map(|part| part.parse().ok()).collect();
        match numbers[..] {
            [Some(1), Some(minor)] if minor < AXES_IN_JOINTS => root.mark_axes(),
            [Some(1), Some(_)] => {}
            _ => return Err(root.fault(format!("its version `{version}` is unknown: 1.4 to 1.12 are read"))),
        }
        Ok(root)
    }

    fn of(node: roxmltree::Node<'_, '_>, lines: &Lines, file: &str) -> Self {
        let name = node.tag_name();
        let prefix = name.namespace().and_then(|space| node.lookup_prefix(space));
        let tag = prefix.map_or_else(|| name.name().to_owned(), |prefix| format!("{prefix}:{}", name.name()));
        let of = if file.is_empty() { String::new() } else { format!(" of {file}") };
        Self {
            tag,
            attributes: node
                .attributes()
                .map(|own| (own.name().to_owned(), own.value().trim().to_owned()))
                .collect(),
            text: node.text().unwrap_or_default().trim().to_owned(),
            children: node
                .children()
                .filter(roxmltree::Node::is_element)
                .map(|child| Self::of(child, lines, file))
                .collect(),
            source: lines.location(node) + &of,
        }
    }

    /// Axes of old versions are in the frame of the model.
    fn mark_axes(&mut self) {
        if matches!(self.tag.as_str(), "axis" | "axis2") {
            let mark =
                Self { tag: "use_parent_model_frame".to_owned(), text: "true".to_owned(), ..Self::default() };
            self.children.push(mark);
        }
        self.children.iter_mut().for_each(Self::mark_axes);
    }

    /// An attribute that is not empty.
    pub(super) fn attribute(&self, key: &str) -> Option<&str> {
        self.attributes.get(key).map(String::as_str).filter(|value| !value.is_empty())
    }

    pub(super) fn name(&self) -> Result<&str, ImportError> {
        self.attribute("name").ok_or_else(|| self.fault("it has no name"))
    }

    pub(super) fn child(&self, tag: &str) -> Option<&Self> {
        self.children.iter().find(|child| child.tag == tag)
    }

    /// The element at the end of a path of tags.
    pub(super) fn within(&self, tags: &[&str]) -> Option<&Self> {
        tags.iter().try_fold(self, |own, tag| own.child(tag))
    }

    /// Text of a child that is not empty.
    pub(super) fn word(&self, tag: &str) -> Option<&str> {
        self.child(tag).map(|child| child.text.as_str()).filter(|text| !text.is_empty())
    }

    /// An error about this element.
    pub(super) fn fault(&self, message: impl std::fmt::Display) -> ImportError {
        let name = self.attribute("name").map(|name| format!(" `{name}`")).unwrap_or_default();
        ImportError::new(format!("{}: <{}>{name}: {message}", self.source, self.tag))
    }

    /// Tag, name and location, for reports of what is omitted.
    pub(super) fn words(&self) -> String {
        let name = self.attribute("name").map(|name| format!(" `{name}`")).unwrap_or_default();
        format!("<{}>{name} ({})", self.tag, self.source)
    }

    /// The finite numbers of a child, none if there is no such child.
    pub(super) fn numbers<const N: usize>(&self, tag: &str) -> Result<Option<[f64; N]>, ImportError> {
        let Some(child) = self.child(tag) else { return Ok(None) };
        let read = xml::finite_numbers(&child.text).and_then(|values| values.try_into().ok());
        read.map(Some)
            .ok_or_else(|| child.fault(format!("it must be {N} finite numbers, not `{}`", child.text)))
    }

    /// The number of a child, or its default.
    pub(super) fn number(&self, tag: &str, default: f64) -> Result<f64, ImportError> {
        Ok(self.numbers::<1>(tag)?.map_or(default, |[value]| value))
    }

    /// A number that must not be negative; default zero.
    pub(super) fn not_negative(&self, tag: &str) -> Result<f64, ImportError> {
        let value = self.number(tag, 0.0)?;
        if value < 0.0 { Err(self.fault(format!("`{tag}` is negative: {value}"))) } else { Ok(value) }
    }

    /// A number that must be positive; `default` without the child.
    pub(super) fn positive(&self, tag: &str, default: f64) -> Result<f64, ImportError> {
        let value = self.number(tag, default)?;
        if value > 0.0 {
            Ok(value)
        } else {
            Err(self.fault(format!("`{tag}` must be positive, not {value}")))
        }
    }

    /// The value of a child that may be infinite.
    pub(super) fn limit(&self, tag: &str) -> Result<Option<f64>, ImportError> {
        let Some(child) = self.child(tag) else { return Ok(None) };
        let value = child.text.parse::<f64>().ok().filter(|value| !value.is_nan());
        value.map(Some).ok_or_else(|| child.fault(format!("it must be a number, not `{}`", child.text)))
    }

    pub(super) fn flag(&self, tag: &str) -> Result<bool, ImportError> {
        match self.word(tag).map(str::to_lowercase).as_deref() {
            None | Some("false" | "0") => Ok(false),
            Some("true" | "1") => Ok(true),
            Some(other) => Err(self.fault(format!("`{tag}` must be true or false, not `{other}`"))),
        }
    }

    /// The pose of an element, and the frame to which it is relative if it names one.
    pub(super) fn pose(&self) -> Result<(Motion, Option<&str>), ImportError> {
        let Some(own) = self.child("pose") else { return Ok((Motion::identity(), None)) };
        let base = own.attribute("relative_to").or(own.attribute("frame"));
        if own.text.is_empty() {
            return Ok((Motion::identity(), base));
        }
        let unit = match own.attribute("degrees") {
            Some("true" | "1") => std::f64::consts::PI / 180.0,
            _ => 1.0,
        };
        let values = xml::finite_numbers(&own.text).unwrap_or_default();
        let pose = match (own.attribute("rotation_format").unwrap_or("euler_rpy"), &values[..]) {
            ("euler_rpy", &[x, y, z, roll, pitch, yaw]) => Some(Motion::new(
                fixed_axes([roll, pitch, yaw].map(|angle| unit * angle)),
                Vector3::new(x, y, z),
            )),
            ("quat_xyzw", &[x, y, z, a, b, c, w]) => {
                Rotation::from_quaternion([w, a, b, c]).map(|turn| Motion::new(turn, Vector3::new(x, y, z)))
            }
            _ => None,
        };
        let pose = pose.ok_or_else(|| {
            own.fault(format!(
                "it must be x y z roll pitch yaw, or x y z and a quaternion x y z w with `quat_xyzw`, not `{}`",
                own.text
            ))
        })?;
        Ok((pose, base))
    }

    /// Replaces `<include>` by the models of their files, which are looked for in `folder` and beside it.
    ///
    /// # Errors
    /// If a file is not there, is not a file of one model, or files include each other too deeply or too often; `count` has the number of
    /// elements that are included so far.
    pub(super) fn include(
        &mut self,
        folder: Option<&Path>,
        depth: usize,
        count: &mut usize,
    ) -> Result<(), ImportError> {
        for child in &mut self.children {
            if child.tag == "include" {
                *child = child.included(folder, depth, count)?;
            } else if matches!(child.tag.as_str(), "model" | "world") {
                child.include(folder, depth, count)?;
            }
        }
        Ok(())
    }

    /// The model of a file, with what `<include>` replaces of it.
    fn included(&self, folder: Option<&Path>, depth: usize, count: &mut usize) -> Result<Self, ImportError> {
        let uri = self.word("uri").ok_or_else(|| self.fault("it has no <uri>"))?;
        let Some(folder) = folder else {
            return Err(self.fault(format!("the file `{uri}` is not read from a text without a folder")));
        };
        if depth >= MAX_INCLUDED {
            return Err(self.fault(format!("{depth} files include each other one in the other")));
        }
        let path = located(uri, folder).ok_or_else(|| {
            let message = format!("the model `{uri}` is not there: put its folder beside the description");
            self.fault(message)
        })?;
        let own = path.parent().unwrap_or(folder);
        let text = xml::without_comments(files::read_input_text(&path).map_err(|error| self.fault(error))?);
        let mut root = Self::read(&text, uri)?;
        *count += root.size();
        if *count > MAX_ELEMENTS {
            let message = format!(
                "included models have more than {MAX_ELEMENTS} elements: include fewer, or files that include less"
            );
            return Err(self.fault(message));
        }
        root.include(Some(own), depth + 1, count)?;
        let models: Vec<&Self> = root.children.iter().filter(|child| child.tag == "model").collect();
        let [model] = models[..] else {
            return Err(self.fault(format!("the file `{uri}` has {} models, not one", models.len())));
        };
        let mut model = model.clone();
        model.name_meshes(own);
        if let Some(name) = self.word("name") {
            model.attributes.insert("name".to_owned(), name.to_owned());
        }
        if let Some(merge) = self.attribute("merge") {
            model.attributes.insert("merge".to_owned(), merge.to_owned());
        }
        for key in ["pose", "static"] {
            if let Some(given) = self.child(key) {
                model.children.retain(|child| child.tag != key);
                model.children.push(given.clone());
            }
        }
        if let Some(given) = self.child("pose") {
            // The frame that is placed belongs to the pose.
            model.attributes.remove("placement_frame");
            if let Some(frame) = self.word("placement_frame") {
                model.attributes.insert("placement_frame".to_owned(), frame.to_owned());
            }
            given.source.clone_into(&mut model.source);
        }
        let known = ["uri", "name", "pose", "static", "placement_frame", "namespace"];
        model
            .children
            .extend(self.children.iter().filter(|child| !known.contains(&child.tag.as_str())).cloned());
        Ok(model)
    }

    /// Number of elements, with this one.
    fn size(&self) -> usize {
        1 + self.children.iter().map(Self::size).sum::<usize>()
    }

    /// Names meshes beside an included file by their whole path.
    fn name_meshes(&mut self, folder: &Path) {
        if self.tag == "mesh" {
            for uri in
                self.children.iter_mut().filter(|child| child.tag == "uri" && !child.text.contains("://"))
            {
                uri.text = folder.join(&uri.text).to_string_lossy().into_owned();
            }
        }
        self.children.iter_mut().for_each(|child| child.name_meshes(folder));
    }
}

/// The file of a model: named itself, or `model.sdf` in a folder.
fn located(uri: &str, folder: &Path) -> Option<PathBuf> {
    let name = ["model://", "package://", "file://"].iter().find_map(|scheme| uri.strip_prefix(scheme));
    let name = name.unwrap_or(uri);
    // A model may be a folder beside that of the description.
    let around = folder.canonicalize().ok()?;
    let folders = [Some(around.as_path()), around.parent()];
    let found = folders.into_iter().flatten().map(|folder| folder.join(name));
    found.map(|path| if path.is_dir() { path.join("model.sdf") } else { path }).find(|path| path.is_file())
}
