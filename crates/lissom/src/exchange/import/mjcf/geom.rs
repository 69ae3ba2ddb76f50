//! Shapes of MJCF: homogeneous solids with their masses, what is drawn of them, and how they touch others.

use std::f64::consts::PI;
use std::rc::Rc;

use lissom_motion::{Matrix3, Motion, Vector3};

use super::super::model_text::carried;
use super::super::visuals::shade;
use super::super::{ImportError, LinkInertia, Visual, VisualShape, from_z};
use super::element::Element;
use super::frame;
use super::mesh::{Density, Meshes};
use super::touching;
use super::tree::{Node, Settings};

const USED: &[&str] = &[
    "type",
    "size",
    "fromto",
    "mass",
    "density",
    "shellinertia",
    "group",
    "contype",
    "conaffinity",
    "condim",
    "priority",
    "friction",
    "solmix",
    "solref",
    "solimp",
    "margin",
    "gap",
    "mesh",
    "surfacevel",
    "adhesion",
    "pos",
    "quat",
    "axisangle",
    "xyaxes",
    "zaxis",
    "euler",
];
const HARMLESS: &[&str] =
    &["material", "rgba", "hfield", "fitscale", "fluidshape", "fluidcoef", "user", "dclass"];
/// Default density [kg/m³].
const DENSITY: f64 = 1000.0;
/// Largest group that is drawn by default.
const LAST_DRAWN_GROUP: f64 = 2.0;

/// A shape.
pub(super) struct Geom {
    /// Group of the shape.
    pub(super) group: f64,
    /// Type of the shape.
    pub(super) kind: String,
    element: Element,
    settings: Rc<Settings>,
}

impl Geom {
    pub(super) fn read(node: &Node) -> Result<Self, ImportError> {
        let element = node.element.clone();
        element.check_known(USED, HARMLESS)?;
        let kind = element.text("type").unwrap_or("sphere").to_owned();
        if !KINDS.contains(&kind.as_str()) {
            return Err(element.fault(format!("its type `{kind}` is unknown: {}", KINDS.join(", "))));
        }
        let settings = Rc::clone(&node.settings);
        Ok(Self { group: element.number("group", 0.0)?, kind, element, settings })
    }

    /// What acts at its touches besides elasticity and friction, each in words.
    pub(super) fn unsupported(&self) -> Result<Vec<String>, ImportError> {
        let acts = |key: &str| -> Result<bool, ImportError> {
            Ok(self.element.list(key)?.unwrap_or_default().iter().any(|value| *value != 0.0))
        };
        let words = self.element.words();
        let moving = acts("surfacevel")?.then(|| format!("the surface of {words}, which moves along itself"));
        let sticky = acts("adhesion")?.then(|| format!("the adhesion of {words}"));
        Ok(moving.into_iter().chain(sticky).collect())
    }

    /// Mass of the shape in the axes of its body, if it has any.
    ///
    /// # Errors
    /// If the mass is that of a shell, or of a mesh that cannot be read.
    pub(super) fn mass(&self, meshes: &mut Meshes) -> Result<Option<LinkInertia>, ImportError> {
        let (element, kind) = (&self.element, self.kind.as_str());
        let mass = element.numbers::<1>("mass")?.map(|[mass]| mass);
        let density = element.number("density", DENSITY)?;
        if mass.is_some_and(|mass| mass < 0.0) || density < 0.0 {
            return Err(element.fault("its mass or density is negative"));
        }
        if matches!(kind, "plane" | "hfield" | "sdf") || mass.unwrap_or(density) == 0.0 {
            return Ok(None);
        }
        let is_shell = element.flag("shellinertia", false)?;
        if kind == "mesh" {
            let mesh = meshes.of_geom(element)?;
            let wanted = mass.map_or(Density::Uniform(density), Density::Total);
            let own = mesh.inertia(element, is_shell, wanted)?;
            return Ok(Some(carried(&own, &frame::frame(element, &self.settings.angles)?)));
        }
        if is_shell {
            return Err(
                element.fault("the inertia of a shell is not supported: add an <inertial> to the body")
            );
        }
        let (placed, sizes) = self.placed()?;
        let (volume, own) = solid(kind, sizes)
            .ok_or_else(|| element.fault(format!("its type `{kind}` is unknown: {}", KINDS.join(", "))))?;
        let mass = mass.unwrap_or(density * volume);
        let turn = placed.rotation.matrix();
        let inertia = turn * Matrix3::from_diagonal(&(mass * own)) * turn.transpose();
        Ok(Some(LinkInertia { mass, centre: placed.position, inertia }))
    }

    /// What is drawn of the shape, and how it touches others; none if it is neither.
    pub(super) fn visual(&self, meshes: &mut Meshes) -> Result<Option<Visual>, ImportError> {
        let element = &self.element;
        let touch = touching::of_geom(element)?;
        let name = element.text("name").map(str::to_owned);
        let colour = meshes.rgba(element)?;
        let is_clear = colour.is_some_and(|[.., opacity]| opacity == 0.0);
        if touch.is_none() && (is_clear || self.group > LAST_DRAWN_GROUP) {
            return Ok(None);
        }
        let colour = colour.map(shade);
        let framed = |shape, origin| Ok(Some(Visual { shape, origin, touch, name: name.clone(), colour }));
        match self.kind.as_str() {
            "plane" => {
                return framed(VisualShape::Plane, frame::frame(element, &self.settings.angles)?);
            }
            "hfield" => {
                meshes.notes.push(format!("the height field of {}: nothing touches it", element.words()));
                return Ok(None);
            }
            "mesh" => {
                let origin = frame::frame(element, &self.settings.angles)?;
                return match meshes.of_geom(element) {
                    Ok(mesh) => match mesh.shape(touch.is_some()) {
                        Some(shape @ VisualShape::Hull(_)) => {
                            meshes.note_corners(element, &mesh);
                            framed(shape, origin)
                        }
                        Some(shape) => framed(shape, origin),
                        None => Ok(None),
                    },
                    Err(error) => {
                        let message = error.message;
                        let what =
                            if touch.is_some() { "does not touch and is not drawn" } else { "is not drawn" };
                        meshes.notes.push(format!("a mesh that {what}: {message}"));
                        Ok(None)
                    }
                };
            }
            _ => {}
        }
        let (placed, [a, b, c]) = match self.placed() {
            Ok(placed) => placed,
            Err(error) if touch.is_none() => {
                meshes.notes.push(format!("a shape that is not drawn: {}", error.message));
                return Ok(None);
            }
            Err(error) => return Err(error),
        };
        let shape = match self.kind.as_str() {
            "sphere" => VisualShape::Sphere(a),
            "capsule" => VisualShape::Capsule { radius: a, length: 2.0 * b },
            "cylinder" => VisualShape::Cylinder { radius: a, length: 2.0 * b },
            "box" => VisualShape::Box(2.0 * Vector3::new(a, b, c)),
            "ellipsoid" => VisualShape::Ellipsoid(Vector3::new(a, b, c)),
            _ => return Ok(None),
        };
        framed(shape, placed)
    }

    /// Frame and dimensions of the shape; for shapes between two points the length is along z.
    fn placed(&self) -> Result<(Motion, [f64; 3]), ImportError> {
        let (element, kind, angles) = (&self.element, self.kind.as_str(), &self.settings.angles);
        let mut sizes = element.list("size")?.unwrap_or_default();
        let placed = match element.numbers::<6>("fromto")? {
            None => frame::frame(element, angles)?,
            Some(_) if kind == "sphere" => {
                return Err(element.fault("a sphere cannot lie between two points"));
            }
            Some([a, b, c, d, e, f]) => {
                let ends = [Vector3::new(a, b, c), Vector3::new(d, e, f)];
                let along = ends[1] - ends[0];
                let half = 0.5 * along.norm();
                let along = frame::direction(element, "fromto", along.into())?;
                sizes.truncate(1);
                if matches!(kind, "box" | "ellipsoid") {
                    sizes.extend_from_within(..);
                }
                sizes.push(half);
                Motion::new(from_z(&along), 0.5 * (ends[0] + ends[1]))
            }
        };
        let needed = match kind {
            "sphere" => 1,
            "capsule" | "cylinder" => 2,
            _ => 3,
        };
        if sizes.len() < needed || sizes[..needed].iter().any(|size| *size <= 0.0) {
            return Err(element.fault(format!("a {kind} needs {needed} sizes greater than zero")));
        }
        sizes.resize(3, 0.0);
        Ok((placed, [sizes[0], sizes[1], sizes[2]]))
    }
}

const KINDS: [&str; 9] =
    ["plane", "hfield", "sphere", "capsule", "ellipsoid", "cylinder", "box", "mesh", "sdf"];

/// Volume of a solid and its inertia per mass about its own axes; dimensions are radii and half lengths.
fn solid(kind: &str, [a, b, c]: [f64; 3]) -> Option<(f64, Vector3)> {
    let of = |along_x: f64, along_y: f64, along_z: f64| {
        Vector3::new(along_y + along_z, along_x + along_z, along_x + along_y)
    };
    Some(match kind {
        "sphere" => (4.0 / 3.0 * PI * a.powi(3), Vector3::repeat(0.4 * a * a)),
        "ellipsoid" => (4.0 / 3.0 * PI * a * b * c, of(a * a / 5.0, b * b / 5.0, c * c / 5.0)),
        "box" => (8.0 * a * b * c, of(a * a / 3.0, b * b / 3.0, c * c / 3.0)),
        "cylinder" => (2.0 * PI * a * a * b, of(a * a / 4.0, a * a / 4.0, b * b / 3.0)),
        "capsule" => {
            // A cylinder of the half length b, and two halves of a sphere with centres of mass 3/8 a beyond its ends.
            let (cylinder, sphere) = (2.0 * PI * a * a * b, 4.0 / 3.0 * PI * a.powi(3));
            let across = cylinder * a * a / 4.0 + sphere * a * a / 5.0;
            let along = cylinder * b * b / 3.0 + sphere * (a * a / 5.0 + b * b + 0.75 * a * b);
            let volume = cylinder + sphere;
            (volume, of(across / volume, across / volume, along / volume))
        }
        _ => return None,
    })
}
