//! Rigid bodies and point masses of a model file.

use std::f64::consts::TAU;
use std::sync::Arc;

use lissom_contact::forms::Solid;
use lissom_motion::{Matrix3, Rotation, Vector3};

use super::entries::each;
use super::solids::{shape, solid};
use super::{Body, Plane, PointMass};
use crate::format::keys::Shape;
use crate::parts::body_axes;
use crate::parts::context::Context;
use crate::reading::reader::Reader;
use crate::surface::Surface;
use crate::text::report::Located;
use crate::text::{Node, Value};

pub(super) fn bodies(context: &Context<'_>) -> Vec<Body> {
    each(context, "bodies", |reader, name| {
        let mass_and_inertia = mass_and_inertia(reader);
        let (position, axes) = (position(reader), axes(reader));
        let (velocity, angular_velocity) = (reader.vector("velocity"), reader.vector("angular_velocity"));
        let center_of_mass = reader.vector("center_of_mass").map_or(Vector3::zeros(), |center| center.value);
        let shape = shape(reader, &center_of_mass);
        let ((mass, inertia, solid), shape) = (mass_and_inertia?, shape?);
        // Without a shape of its own a body looks like the solid of its inertia.
        let surface = shape.surface.or_else(|| Some(Arc::new(Surface::of_solid(&solid?, &center_of_mass))));
        Some(Body {
            name: Located::new(name.to_owned(), reader.name),
            mass,
            inertia,
            position: position?,
            axes: axes?,
            center_of_mass,
            surface,
            solids: shape.solids,
            velocity,
            angular_velocity,
        })
    })
}

/// Mass and inertia about the centre of mass, as numbers or those of a solid, and the solid.
fn mass_and_inertia(reader: &Reader<'_, '_>) -> Option<(f64, Matrix3, Option<Solid>)> {
    let context = reader.context;
    let solid = match reader.node("inertia") {
        Some(node @ Node { value: Value::Table(_), .. }) => Some(solid(reader, node, "inertia")?),
        _ => None,
    };
    let mass = match reader.node("mass") {
        Some(node @ Node { value: Value::Table(_), .. }) => {
            let what = reader.words("mass");
            let own = Reader::open(context, node, (what.clone(), node.span), Shape::density_keys())?;
            let density = own.number("density")?.value;
            let Some(solid) = &solid else {
                let message = format!("{what} has a density, but `inertia` names no solid");
                return context.fail(
                    node.span,
                    message,
                    "write inertia = { box = [a, b, c] }, or specify a mass",
                );
            };
            Some(density * solid.volume())
        }
        _ => reader.number("mass").map(|mass| mass.value),
    };
    let inertia = match (&solid, mass) {
        (Some(solid), Some(mass)) => Some(mass * solid.inertia()),
        (Some(_), None) => None,
        // A mass that could not be read is reported already.
        (None, mass) => reader.inertia("inertia", mass.unwrap_or(1.0)).map(|inertia| inertia.value),
    };
    Some((mass?, inertia?, solid))
}

/// The position `position`, the origin of the axes around it where it is not given.
pub(super) fn position(reader: &Reader<'_, '_>) -> Option<Vector3> {
    match reader.node("position") {
        None => reader.context.to_global(reader.scope, &Vector3::zeros()),
        Some(node) => reader.context.place(node, &reader.words("position")).map(|place| place.value),
    }
}

/// Body axes as columns in global axes.
pub(super) fn axes(reader: &Reader<'_, '_>) -> Option<Matrix3> {
    let own = body_axes(reader.context, (reader.node("rotation"), reader.node("axes")), &reader.what)?;
    if let Some(node) = reader.node("rotation") {
        let vector = reader.context.vector(node, &reader.words("rotation"));
        // A smaller rotation would have the same result.
        if let Some(angle) = vector.map(|vector| vector.norm()).filter(|&angle| angle > TAU * (1.0 + 1e-9)) {
            reader.warn_of_degrees("rotation", angle);
        }
    }
    let around = reader.context.frame(reader.scope)?.rotation;
    Some(if around == Rotation::IDENTITY { own } else { around.matrix() * own })
}

/// The plane of the global axes that `plane` of the axes around the point mass is.
fn global_plane(reader: &Reader<'_, '_>, plane: Plane) -> Option<Plane> {
    let normal = match plane {
        Plane::Xy => Vector3::z(),
        Plane::Yz => Vector3::x(),
        Plane::Zx => Vector3::y(),
    };
    let turned = reader.context.turned(reader.scope, &normal)?;
    let planes = [(Plane::Yz, turned.x), (Plane::Zx, turned.y), (Plane::Xy, turned.z)];
    let found = planes.into_iter().find(|(_, cosine)| cosine.abs() > 1.0 - 1e-12);
    found.map(|(plane, _)| plane).or_else(|| {
        let message = format!(
            "the plane of {} is not a plane of global axes, because its part is rotated",
            reader.what
        );
        reader.context.fail(reader.name, message, "remove `plane`, and constrain the point mass by a joint")
    })
}

pub(super) fn point_masses(context: &Context<'_>) -> Vec<PointMass> {
    each(context, "point_masses", |reader, name| {
        let (mass, position, velocity) = (reader.number("mass"), position(reader), reader.vector("velocity"));
        let plane = match reader.choice("plane").map(|plane| plane.value) {
            None => None,
            Some("xy") => Some(global_plane(reader, Plane::Xy)?),
            Some("yz") => Some(global_plane(reader, Plane::Yz)?),
            Some(_) => Some(global_plane(reader, Plane::Zx)?),
        };
        if let (Some(plane), Some(velocity)) = (plane, &velocity) {
            let across = match plane {
                Plane::Xy => velocity.value.z,
                Plane::Yz => velocity.value.x,
                Plane::Zx => velocity.value.y,
            };
            // A velocity that was turned has round-off across the plane.
            if across.abs() > 1e-12 * velocity.value.norm() {
                let message = format!("the velocity of {} leaves its plane", reader.what);
                let help = "the component across the plane must be 0";
                return context.fail(velocity.span, message, help);
            }
        }
        let name = Located::new(name.to_owned(), reader.name);
        let shape = shape(reader, &Vector3::zeros())?;
        Some(PointMass {
            name,
            mass: mass?.value,
            position: position?,
            plane,
            surface: shape.surface,
            solids: shape.solids,
            velocity,
        })
    })
}
