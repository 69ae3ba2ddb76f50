//! Masses of the shapes of MJCF, homogeneous solids.

use std::f64::consts::PI;

use lissom_motion::{Matrix3, Motion, Vector3};

use super::super::{ImportError, LinkInertia, from_z};
use super::element::Element;
use super::frame::{self, Angles};

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
    "pos",
    "quat",
    "axisangle",
    "xyaxes",
    "zaxis",
    "euler",
];
const HARMLESS: &[&str] = &[
    "condim",
    "priority",
    "material",
    "rgba",
    "friction",
    "solmix",
    "solref",
    "solimp",
    "margin",
    "gap",
    "hfield",
    "mesh",
    "fitscale",
    "fluidshape",
    "fluidcoef",
    "user",
];
/// Default density [kg/m³].
const DENSITY: f64 = 1000.0;

/// A shape.
pub(super) struct Geom {
    /// Group of the shape.
    pub(super) group: f64,
    /// Whether it may collide with others.
    pub(super) touches: bool,
    element: Element,
}

impl Geom {
    pub(super) fn read(element: Element) -> Result<Self, ImportError> {
        element.check_known(USED, HARMLESS)?;
        let touches = element.number("contype", 1.0)? != 0.0 || element.number("conaffinity", 1.0)? != 0.0;
        Ok(Self { group: element.number("group", 0.0)?, touches, element })
    }

    /// Mass of the shape in the axes of its body, if it has any.
    ///
    /// # Errors
    /// If the mass is that of a mesh or of a shell.
    pub(super) fn mass(&self, angles: &Angles) -> Result<Option<LinkInertia>, ImportError> {
        let element = &self.element;
        let kind = element.text("type").unwrap_or("sphere");
        let mass = element.numbers::<1>("mass")?.map(|[mass]| mass);
        let density = element.number("density", DENSITY)?;
        if mass.is_some_and(|mass| mass < 0.0) || density < 0.0 {
            return Err(element.fault("its mass or density is negative"));
        }
        if matches!(kind, "plane" | "hfield") || mass.unwrap_or(density) == 0.0 {
            return Ok(None);
        }
        if element.flag("shellinertia", false)? {
            return Err(
                element.fault("the inertia of a shell is not supported: add an <inertial> to the body")
            );
        }
        if matches!(kind, "mesh" | "sdf") {
            let message = format!(
                "the mass of a {kind} is not supported: add an <inertial> to the body, or mass=\"0\" to the geom"
            );
            return Err(element.fault(message));
        }
        let (placed, sizes) = self.placed(kind, angles)?;
        let (volume, own) = solid(kind, sizes)
            .ok_or_else(|| element.fault(format!("its type `{kind}` is unknown: {}", KINDS.join(", "))))?;
        let mass = mass.unwrap_or(density * volume);
        let turn = placed.rotation.matrix();
        let inertia = turn * Matrix3::from_diagonal(&(mass * own)) * turn.transpose();
        Ok(Some(LinkInertia { mass, centre: placed.position, inertia }))
    }

    /// Frame and dimensions of the shape; for shapes between two points the length is along z.
    fn placed(&self, kind: &str, angles: &Angles) -> Result<(Motion, [f64; 3]), ImportError> {
        let element = &self.element;
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

const KINDS: [&str; 8] = ["plane", "hfield", "sphere", "capsule", "ellipsoid", "cylinder", "box", "mesh"];

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
