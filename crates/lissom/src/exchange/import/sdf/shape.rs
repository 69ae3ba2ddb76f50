//! Shapes of links in SDF: what is drawn of them, and how they touch.

use lissom_motion::{Motion, Vector3};

use super::super::visuals::shade;
use super::super::{ImportError, Touch, TouchLaw, Visual, VisualShape, from_z};
use super::element::Element;

/// Coefficient of friction of what does not slide.
const NO_SLIDING: f64 = 100.0;
/// Bits of a bitmask without a value.
const BITS: u32 = 0xffff;
/// Contents of a surface that are read.
const SURFACE: [&[&str]; 5] = [
    &["friction", "ode", "mu"],
    &["friction", "bullet", "friction"],
    &["contact", "collide_bitmask"],
    &["contact", "category_bitmask"],
    &["contact", "collide_without_contact"],
];

/// Contents of a collision that are read, or have no effect.
const OF_COLLISIONS: [&str; 7] =
    ["pose", "geometry", "surface", "laser_retro", "max_contacts", "density", "material"];

/// The shape of a visual or collision at `origin` in its link; none for a geometry that cannot be drawn.
pub(super) fn shape(element: &Element, origin: Motion) -> Result<Option<Visual>, ImportError> {
    let geometry = element.child("geometry").ok_or_else(|| element.fault("it has no <geometry>"))?;
    let Some(own) = geometry.children.first() else { return Ok(None) };
    let mut turn = Motion::identity();
    let sizes = |tag: &str| -> Result<Vector3, ImportError> {
        let sizes = Vector3::from(own.numbers::<3>(tag)?.unwrap_or([1.0; 3]));
        if sizes.min() > 0.0 { Ok(sizes) } else { Err(own.fault(format!("`{tag}` must be positive"))) }
    };
    let shape = match own.tag.as_str() {
        "box" => VisualShape::Box(sizes("size")?),
        "sphere" => VisualShape::Sphere(own.positive("radius", 1.0)?),
        "cylinder" => VisualShape::Cylinder {
            radius: own.positive("radius", 1.0)?,
            length: own.positive("length", 1.0)?,
        },
        "capsule" => VisualShape::Capsule {
            radius: own.positive("radius", 0.5)?,
            length: own.positive("length", 1.0)?,
        },
        "ellipsoid" => VisualShape::Ellipsoid(sizes("radii")?),
        "plane" => {
            let normal = Vector3::from(own.numbers::<3>("normal")?.unwrap_or([0.0, 0.0, 1.0]));
            let normal = normal.try_normalize(0.0).ok_or_else(|| own.fault("its normal has no direction"))?;
            turn = Motion::new(from_z(&normal), Vector3::zeros());
            VisualShape::Plane
        }
        "mesh" => VisualShape::Mesh {
            name: own.word("uri").unwrap_or_default().to_owned(),
            scale: Vector3::from(own.numbers::<3>("scale")?.unwrap_or([1.0; 3])),
            path: None,
        },
        _ => return Ok(None),
    };
    let diffuse = element.child("material").map_or(Ok(None), colour)?;
    Ok(Some(Visual { shape, origin: origin * turn, touch: None, name: None, colour: diffuse.map(shade) }))
}

/// The diffuse colour of a material, which may have no opacity.
fn colour(material: &Element) -> Result<Option<[f64; 4]>, ImportError> {
    if material.word("diffuse").is_some_and(|text| text.split_whitespace().count() == 3) {
        return Ok(material.numbers::<3>("diffuse")?.map(|[red, green, blue]| [red, green, blue, 1.0]));
    }
    material.numbers::<4>("diffuse")
}

/// How a collision touches others, none if it exerts no force; shapes of one `group` do not touch each other.
pub(super) fn touch(element: &Element, group: Option<usize>) -> Result<Option<Touch>, ImportError> {
    let surface = element.child("surface");
    let within = |tags: &[&str]| surface.and_then(|own| own.within(tags));
    let contact = within(&["contact"]);
    if contact.map_or(Ok(false), |own| own.flag("collide_without_contact"))? {
        return Ok(None);
    }
    let mask = |tag: &str, default: u32| -> Result<u32, ImportError> {
        let Some(text) = contact.and_then(|own| own.word(tag)) else { return Ok(default) };
        let read = match text.to_lowercase().strip_prefix("0x") {
            Some(digits) => u32::from_str_radix(digits, 16),
            None => text.parse(),
        };
        read.map_err(|_| {
            element.fault(format!("`{tag}` must be a whole number or begin with 0x, not `{text}`"))
        })
    };
    let collide = mask("collide_bitmask", BITS)?;
    let category = mask("category_bitmask", collide)?;
    let friction = match (within(&["friction", "ode"]), within(&["friction", "bullet"])) {
        (Some(own), _) => own.number("mu", 1.0)?,
        (None, Some(own)) => own.number("friction", 1.0)?,
        _ => 1.0,
    };
    // The engine of the format reads a negative coefficient as one without a limit.
    let friction = if friction < 0.0 { NO_SLIDING } else { friction };
    Ok(Some(Touch {
        masks: [category, collide],
        priority: 0.0,
        mixing: 1.0,
        is_frictionless: false,
        group,
        law: TouchLaw::with_friction(friction),
    }))
}

/// Whether a collision has properties that are not read.
pub(super) fn has_other_properties(element: &Element) -> bool {
    fn leaves<'a>(element: &'a Element, path: &mut Vec<&'a str>) -> bool {
        if element.children.is_empty() {
            return !SURFACE.contains(&path.as_slice());
        }
        element.children.iter().any(|child| {
            path.push(&child.tag);
            let found = leaves(child, path);
            path.pop();
            found
        })
    }
    // Such as the properties of another program in a namespace.
    let has_unknown = element.children.iter().any(|child| !OF_COLLISIONS.contains(&child.tag.as_str()));
    has_unknown
        || element
            .child("surface")
            .is_some_and(|surface| !surface.children.is_empty() && leaves(surface, &mut Vec::new()))
}
