//! Solids in metres, for kinds whose data state dimensions: wheels, tyres, rails, gears and drums.

use lissom_mechanics::elements::reeving;
use lissom_motion::Vector3;

use super::places::{Anchor, Places};
use super::solids::{Axes, Form, Solid, Tone};
use super::symbols::{End, joint_ends};
use crate::document::{Attachment, Component, Document};

/// Number of slices of a profile.
const SLICES: i32 = 8;
/// Number of teeth of a gear.
const TEETH: u32 = 24;

/// Solids at their positions; none where the data of the component state no dimensions.
pub(super) fn solids(
    component: &Component,
    document: &Document,
    places: &Places<'_>,
    ends: &[End],
) -> Vec<(Anchor, Vec<Solid>)> {
    let found = match component.kind.value.as_str() {
        "rolling" => disc(component, places, ends, 0.05),
        "rolling_contact" => disc(component, places, ends, 0.16),
        "tyre" => disc(component, places, ends, 0.4),
        "wheel_on_rail" => wheel_and_rail(component, places, ends),
        "gear" => gears(component, document, places),
        "rope" => Some(drums(component, document, places)),
        _ => None,
    };
    found.unwrap_or_default()
}

/// Whether the solids replace the symbol of the kind.
pub(super) fn replace_symbol(component: &Component) -> bool {
    component.kind.value != "rope"
}

/// A disc with a rim and a bar across it, which shows how it turns. `tube` is the radius of the rim over that of the wheel.
fn disc(
    component: &Component,
    places: &Places<'_>,
    ends: &[End],
    tube: f64,
) -> Option<Vec<(Anchor, Vec<Solid>)>> {
    let [(base, normal), (wheel, axes)] = ends.first_chunk::<2>()?;
    let parameters = &component.parameters;
    let rim = parameters.number_or("rim", 0.0).ok()?;
    // By default the wheel touches the plane at the start.
    let up = match parameters.vector("normal") {
        Ok(normal) => normal.normalize(),
        Err(_) => global(places, base, &normal.0[0]),
    };
    let Some(at) = component.attachment.nodes[0].at.filter(|_| component.ports.have_one_location()) else {
        let radius = parameters.number("radius").ok()?;
        return Some(vec![(*wheel, wheel_solids(axes, radius + rim, tube))]);
    };
    let height = (position(places, wheel) - at).dot(&up).abs();
    let lean = global(places, wheel, &axes.0[0]).dot(&up);
    let touching = (height - rim) / (1.0 - lean * lean).max(1e-6).sqrt();
    let radius = parameters.number_or("radius", touching).ok()? + rim;
    (radius > 0.0).then(|| vec![(*wheel, wheel_solids(axes, radius, tube))])
}

fn wheel_solids(axes: &Axes, radius: f64, tube: f64) -> Vec<Solid> {
    let tube = tube * radius;
    vec![
        axes.ring(radius - tube, tube, 0.0, Tone::Dark),
        axes.cylinder(0, radius - tube, 0.5 * tube, Tone::Light),
        axes.block([1.7 * radius, tube, 0.12 * radius], [0.0; 3], Tone::Dark),
    ]
}

/// A wheel of slices of its profile with a flange inside, on a rail of slices of its own.
fn wheel_and_rail(
    component: &Component,
    places: &Places<'_>,
    ends: &[End],
) -> Option<Vec<(Anchor, Vec<Solid>)>> {
    let [(rail_at, rail), (wheel_at, wheel)] = ends.first_chunk::<2>()?;
    let parameters = &component.parameters;
    let outwards = global(places, rail_at, &rail.0[0]).dot(&global(places, wheel_at, &wheel.0[0])).signum();
    let above =
        (position(places, wheel_at) - position(places, rail_at)).dot(&global(places, rail_at, &rail.0[1]));
    let radius = parameters.number_or("radius", above.abs()).ok()?;
    let cone = parameters.number("cone_angle").ok()?;
    let head = parameters.number_or("head_radius", 0.5 * radius).ok()?;
    let cant = parameters.number_or("cant", cone).ok()?;
    let [inner, outer] = parameters.range("tread").ok()?.map_or([-0.2 * radius, 0.2 * radius], |range| range);
    let profile = parameters.function("wheel_profile").ok();
    let tread = |y: f64| profile.as_ref().map_or(-cone.tan() * y, |profile| profile.value(y));
    let slice = (outer - inner) / f64::from(SLICES);
    let mut turned: Vec<Solid> = (0..SLICES)
        .map(|k| {
            let y = inner + (f64::from(k) + 0.5) * slice;
            wheel.solid(
                Form::Cylinder,
                [radius + tread(y), slice, 0.0],
                (0, [outwards * y, 0.0, 0.0]),
                Tone::Dark,
            )
        })
        .collect();
    let flange = 0.08 * radius;
    let inside = outwards * (inner - 0.5 * flange);
    turned.push(wheel.solid(
        Form::Cylinder,
        [1.12 * radius, flange, 0.0],
        (0, [inside, 0.0, 0.0]),
        Tone::Dark,
    ));
    // Shows how the wheel turns.
    turned.push(wheel.block(
        [1.6 * radius, outer - inner + 0.02 * radius, 0.1 * radius],
        [outwards * 0.5 * (inner + outer), 0.0, 0.0],
        Tone::Light,
    ));
    let half = (0.6 * head).min(0.25 * radius);
    let given = parameters.function("rail_profile").ok();
    let circle = |y: f64| {
        let across = y - head * cant.sin();
        (head * head - across * across).max(0.0).sqrt() - head * cant.cos()
    };
    let height = |y: f64| given.as_ref().map_or_else(|| circle(y), |profile| profile.value(y));
    let up = above.signum();
    let (length, depth) = (12.0 * radius, 0.8 * half);
    let strip = 2.0 * half / f64::from(SLICES);
    let mut rolled: Vec<Solid> = (0..SLICES)
        .map(|k| {
            let y = (f64::from(k) + 0.5) * strip - half;
            let top = height(y);
            rail.block([depth + top, strip, length], [y, up * 0.5 * (top - depth), 0.0], Tone::Light)
        })
        .collect();
    let below = |from: f64| -up * (depth + from * half);
    rolled.push(rail.block([1.6 * half, 0.5 * half, length], [0.0, below(0.8), 0.0], Tone::Light));
    rolled.push(rail.block([0.4 * half, 3.0 * half, length], [0.0, below(1.8), 0.0], Tone::Light));
    Some(vec![(*rail_at, rolled), (*wheel_at, turned)])
}

/// Toothed wheels whose radii have the ratio, where the axes of both joints are parallel and apart.
fn gears(
    component: &Component,
    document: &Document,
    places: &Places<'_>,
) -> Option<Vec<(Anchor, Vec<Solid>)>> {
    let [(joint, _), (other, _)] = component.attachment.coordinates.as_slice() else { return None };
    let of = |name: &str| {
        let turns = |joint: &&Component| {
            joint.name.value == name && matches!(joint.kind.value.as_str(), "revolute" | "cylindrical")
        };
        joint_ends(document.joints.iter().find(turns)?, document, places)?.get(1).copied()
    };
    let [(first, axes), (second, others)] = [of(&joint.value)?, of(&other.value)?];
    let axis = global(places, &first, &axes.0[0]);
    let same = axis.dot(&global(places, &second, &others.0[0]));
    let between = position(places, &second) - position(places, &first);
    let distance = (between - axis * between.dot(&axis)).norm();
    let ratio = component.parameters.number("ratio").ok()?;
    let size = ratio.abs();
    let is_external = ratio * same < 0.0;
    let scale = if is_external { 1.0 + size } else { (1.0 - size).abs() };
    if same.abs() < 0.99 || distance <= 0.0 || scale < 1e-3 || size <= 0.0 {
        return None;
    }
    let radius = distance / scale;
    Some(vec![(first, toothed(&axes, size * radius)), (second, toothed(&others, radius))])
}

fn toothed(axes: &Axes, radius: f64) -> Vec<Solid> {
    let pitch = std::f64::consts::TAU / f64::from(TEETH);
    let (side, width) = (0.5 * pitch * radius, 0.2 * radius);
    let tooth = |k: u32| {
        let (sine, cosine) = (f64::from(k) * pitch).sin_cos();
        axes.block([side, width, side], [0.0, radius * cosine, radius * sine], Tone::Dark)
    };
    let body = axes.cylinder(0, radius - 0.25 * side, 0.9 * width, Tone::Dark);
    std::iter::once(body).chain((0..TEETH).map(tooth)).collect()
}

/// Cylinders at the joints of drums of a rope, and at its sheaves.
fn drums(component: &Component, document: &Document, places: &Places<'_>) -> Vec<(Anchor, Vec<Solid>)> {
    let radii = component.parameters.numbers("drum_radii").unwrap_or_default();
    let drum = |(name, radius): (&str, &f64)| {
        let joint = document.joints.iter().find(|joint| joint.name.value == name)?;
        let (anchor, axes) = *joint_ends(joint, document, places)?.get(1)?;
        let radius = radius.abs();
        let bar = axes.block([1.6 * radius, 1.02 * radius, 0.15 * radius], [0.0; 3], Tone::Light);
        Some((anchor, vec![axes.cylinder(0, radius, radius, Tone::Dark), bar]))
    };
    let Attachment { nodes, coordinates, .. } = &component.attachment;
    let with_radius = nodes.iter().filter(|own| own.sheave.is_some_and(|own| own.turns.is_some())).count();
    let drums = coordinates.iter().skip(with_radius);
    let of_joints = drums.map(|(drum, _)| drum.value.as_str()).zip(radii).filter_map(drum);
    let sheaves = nodes.iter().filter_map(|own| {
        let sheave = own.sheave?;
        let anchor = places.anchor(&own.node, &own.at?)?;
        let axes = Axes::of(&places.frame(anchor.node).rotation.apply_inverse(&sheave.axis), None);
        let bar = axes.block(
            [0.5 * sheave.radius, 1.02 * sheave.radius, 0.15 * sheave.radius],
            [0.0; 3],
            Tone::Light,
        );
        Some((anchor, vec![axes.cylinder(0, sheave.radius, 0.3 * sheave.radius, Tone::Dark), bar]))
    });
    of_joints.chain(sheaves).collect()
}

/// Positions along a rope over sheaves, with arcs as at the start; none if it has no sheaves. Those on a drum belong to the part that
/// carries it, as they do not turn with the drum.
pub(super) fn rope_line(
    component: &Component,
    document: &Document,
    places: &Places<'_>,
) -> Option<Vec<Anchor>> {
    let Attachment { nodes, coordinates, .. } = &component.attachment;
    let sheaves: Vec<_> =
        nodes.iter().enumerate().filter_map(|(index, own)| Some((index, own.sheave?))).collect();
    if sheaves.is_empty() {
        return None;
    }
    let points: Vec<Vector3> = nodes.iter().map(|own| own.at).collect::<Option<_>>()?;
    let mut joints = coordinates.iter();
    let mut line = Vec::new();
    for (own, arc) in nodes.iter().zip(reeving::path(&points, &sheaves)?) {
        let mut carrier = &own.node;
        if own.sheave.is_some_and(|own| own.turns.is_some()) {
            let (name, _) = joints.next()?;
            let joint = document.joints.iter().find(|joint| joint.name.value == name.value)?;
            let ends = &joint.attachment.nodes;
            carrier = &ends.iter().find(|end| end.node.value != own.node.value)?.node;
        }
        for at in &arc {
            line.push(places.anchor(carrier, at)?);
        }
    }
    Some(line)
}

fn position(places: &Places<'_>, anchor: &Anchor) -> Vector3 {
    places.frame(anchor.node).transform_point(&Vector3::from(anchor.position))
}

fn global(places: &Places<'_>, anchor: &Anchor, direction: &Vector3) -> Vector3 {
    places.frame(anchor.node).rotation.apply(direction)
}

#[cfg(test)]
#[path = "../../tests/unit/scene/dimensions.rs"]
mod tests;
