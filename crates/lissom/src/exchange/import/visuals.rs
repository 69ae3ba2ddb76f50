//! What is drawn of a robot's links: solids, and meshes in files of their own.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use lissom_model::output::Shade;
use lissom_model::toml_text::quoted;
use lissom_motion::{Motion, Vector3};

use super::{Link, Robot, Touch, list};

/// Formats of meshes that can be drawn.
const DRAWN: [&str; 3] = ["stl", "gltf", "glb"];

/// A shape at its position in the link.
#[derive(Clone, Debug, PartialEq)]
pub struct Visual {
    /// The shape.
    pub shape: VisualShape,
    /// Frame of the shape in that of the link.
    pub origin: Motion,
    /// How the solid touches others; none if it is only drawn.
    pub touch: Option<Touch>,
    /// Name of the shape, if the description has names.
    pub name: Option<String>,
    /// Colour of the shape, if the description has one.
    pub colour: Option<Shade>,
}

/// The shape of a visual.
#[derive(Clone, Debug, PartialEq)]
pub enum VisualShape {
    /// A box with these sides [m].
    Box(Vector3),
    /// A cylinder along z [m].
    Cylinder {
        /// Radius.
        radius: f64,
        /// Length.
        length: f64,
    },
    /// A sphere of this radius [m].
    Sphere(f64),
    /// A cylinder along z with half spheres as ends [m].
    Capsule {
        /// Radius.
        radius: f64,
        /// Length between the centres of its ends.
        length: f64,
    },
    /// An ellipsoid with these semi-axes [m].
    Ellipsoid(Vector3),
    /// The half-space below z = 0.
    Plane,
    /// The convex hull of these points [m].
    Hull(Vec<Vector3>),
    /// A file with triangles.
    Mesh {
        /// The file as the description names it.
        name: String,
        /// Factors along its axes, to metres.
        scale: Vector3,
        /// The file as the model names it; none before [`Robot::locate_meshes`], or if it cannot be drawn.
        path: Option<String>,
    },
}

impl Visual {
    /// The name of its file if it cannot be drawn.
    fn file(&self) -> Option<&str> {
        match &self.shape {
            VisualShape::Mesh { name, path: None, .. } => Some(name),
            _ => None,
        }
    }

    /// The entry of a body's `shape`, in the frame of the body; none for a mesh that is not drawn.
    pub(super) fn text(&self, link_in_body: &Motion, touches: bool) -> Option<String> {
        let mut text = match &self.shape {
            VisualShape::Box(sides) => format!("kind = \"box\", sides = {}", list(sides)),
            VisualShape::Cylinder { radius, length } => {
                format!("kind = \"cylinder\", radius = {radius:?}, length = {length:?}")
            }
            VisualShape::Sphere(radius) => format!("kind = \"sphere\", radius = {radius:?}"),
            VisualShape::Capsule { radius, length } => {
                format!("kind = \"capsule\", radius = {radius:?}, length = {length:?}")
            }
            VisualShape::Ellipsoid(axes) => format!("kind = \"ellipsoid\", semi_axes = {}", list(axes)),
            VisualShape::Plane => "kind = \"plane\"".to_owned(),
            VisualShape::Hull(points) => {
                let points: Vec<String> = points.iter().map(list).collect();
                format!("kind = \"hull\", points = [{}]", points.join(", "))
            }
            VisualShape::Mesh { scale, path, .. } => {
                let file = quoted(path.as_ref()?);
                format!("kind = \"mesh\", file = {file}, scale = {}", list(scale))
            }
        };
        let frame = *link_in_body * self.origin;
        // Writing to a string cannot fail.
        let _ = write!(text, ", position = {}", list(&frame.position));
        let rotation = frame.rotation.logarithm();
        if rotation != Vector3::zeros() && !matches!(self.shape, VisualShape::Sphere(_)) {
            let _ = write!(text, ", rotation = {}", list(&rotation));
        }
        if !touches {
            text.push_str(", touches = false");
        }
        if let Some([red, green, blue]) = self.colour.filter(|_| self.shape != VisualShape::Plane) {
            let _ = write!(text, ", colour = \"#{red:02x}{green:02x}{blue:02x}\"");
        }
        Some(format!("{{ {text} }}"))
    }
}

impl Link {
    /// Shapes that are drawn: those for collisions if a file of the visuals cannot be.
    pub(super) fn drawn(&self) -> &[Visual] {
        let is_drawn = |visual: &Visual| visual.file().is_none();
        let replaces = !self.visuals.iter().all(is_drawn) && self.collisions.iter().any(is_drawn);
        if replaces { &self.collisions } else { &self.visuals }
    }

    fn shapes_mut(&mut self) -> impl Iterator<Item = &mut Visual> {
        self.visuals.iter_mut().chain(&mut self.collisions)
    }
}

impl Robot {
    /// Looks for the files of meshes: beside the `description`, or for `package://name/…` in a folder `name` around it. Those that
    /// are found in a format that can be drawn are named relative to the folder of the `model` file, or absolutely if they are
    /// not in it.
    pub fn locate_meshes(&mut self, description: &Path, model: &Path) {
        let folder = |file: &Path| {
            let folder =
                file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
            folder.canonicalize().unwrap_or_else(|_| folder.to_owned())
        };
        let (around, of_model) = (folder(description), folder(model));
        for visual in self.links.iter_mut().flat_map(Link::shapes_mut) {
            let VisualShape::Mesh { name, path, .. } = &mut visual.shape else { continue };
            *path = found(name, &around).map(|file| {
                let named = file.strip_prefix(&of_model).unwrap_or(&file);
                named.to_string_lossy().replace('\\', "/")
            });
        }
    }

    /// The meshes that are not drawn, in a sentence.
    pub fn meshes_left_out(&self) -> Option<String> {
        let mut names: Vec<&str> =
            self.links.iter().flat_map(|link| &link.visuals).filter_map(Visual::file).collect();
        names.sort_unstable();
        names.dedup();
        let first = names.first()?;
        let more = if names.len() > 1 { format!(" and {} more", names.len() - 1) } else { String::new() };
        Some(format!(
            "meshes, which must be STL or glTF files in the folders of the description: {first}{more}; shapes for collisions are drawn \
             instead, or nothing"
        ))
    }
}

/// A colour from red, green, blue and opacity between 0 and 1.
pub(super) fn shade([red, green, blue, _]: [f64; 4]) -> Shade {
    [red, green, blue].map(|part| (255.0 * part.clamp(0.0, 1.0)).round() as u8)
}

/// The file of a mesh.
fn found(name: &str, around: &Path) -> Option<PathBuf> {
    let candidates: Vec<PathBuf> = match name.strip_prefix("package://").or(name.strip_prefix("model://")) {
        // The package is a folder around the description, or beside it.
        Some(inside) => {
            let own = inside.split_once('/').map_or("", |(_, own)| own);
            around.ancestors().flat_map(|folder| [folder.join(inside), folder.join(own)]).collect()
        }
        None => vec![around.join(name.strip_prefix("file://").unwrap_or(name))],
    };
    let is_drawn = |file: &PathBuf| {
        let ending = file.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        ending.is_some_and(|ending| DRAWN.contains(&ending.as_str())) && file.is_file()
    };
    candidates.into_iter().find(is_drawn)?.canonicalize().ok()
}
