//! Surfaces as shaded polygons in painting order.

use lissom_model::output::Shade;
use lissom_model::scene::Tone;
use lissom_motion::{Motion as Pose, Vector3};

use super::view::Projection;
use super::visible::{self, ItemBuffer, Laid};
use crate::pictures::geometry::{Colour, Geometry, Mesh};

/// Longest edge of a partly hidden face, relative to the model: long faces have no unique distance.
const LONGEST: f64 = 0.02;

/// Colours of parts that colour-blind viewers can distinguish.
const PARTS: [Shade; 8] = [
    [0x6f, 0x9b, 0xc8],
    [0xd9, 0x9a, 0x6c],
    [0x74, 0xb4, 0x9b],
    [0xc5, 0x9b, 0xbd],
    [0xd8, 0xbf, 0x6b],
    [0x8f, 0xb8, 0xd6],
    [0xa3, 0xa8, 0xb0],
    [0xb5, 0xa9, 0x8f],
];

/// The colour of a piece, as on the page.
pub fn shade_of(colour: Colour) -> Shade {
    match colour {
        Colour::Part(number) => PARTS[number % PARTS.len()],
        Colour::Ground => [0xa9, 0xb2, 0xbe],
        Colour::Tone(Tone::Light) => [0xf1, 0xb4, 0x34],
        Colour::Tone(Tone::Dark) => [0x4d, 0x56, 0x63],
        Colour::Tone(Tone::Drive | Tone::Load) => [0xd1, 0x49, 0x5b],
        Colour::Tone(Tone::Spring) => [0x5b, 0x8c, 0x5a],
        Colour::Tone(Tone::Stop) => [0x8a, 0x6d, 0x3b],
        Colour::Tone(Tone::Moment) => [0x8e, 0x5b, 0xb5],
    }
}

/// A projected face: points to the right and upward [m], and its colour.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    /// Its points.
    pub points: Vec<[f64; 2]>,
    /// Its shaded colour.
    pub shade: Shade,
}

/// The faces of a model at poses of its nodes and a time [s], in painting order: first the partly hidden ones, divided
/// into small faces, the farthest first; then those that are fully visible.
pub fn painted(geometry: &Geometry, projection: &Projection, poses: &[Pose], time: f64) -> Vec<Seen> {
    let (mut laid, mut shades) = (Vec::new(), Vec::new());
    for piece in &geometry.pieces {
        if let Some(mesh) = piece.at(poses, time) {
            let shade = shade_of(piece.colour);
            faces(&mesh, (geometry, projection), |face, bright| {
                laid.push(face);
                shades.push(shade.map(|part| (f64::from(part) * bright).round().clamp(0.0, 255.0) as u8));
            });
        }
    }
    let buffer = ItemBuffer::of(&laid, geometry.extent());
    let (mut partly, mut wholly) = (Vec::new(), Vec::new());
    for (number, face) in laid.iter().enumerate() {
        match buffer.seen(face, number) {
            visible::Seen::Hidden => {}
            visible::Seen::Wholly => wholly.push(seen(face, shades[number])),
            visible::Seen::Partly => {
                let mut rest = vec![face.clone()];
                while let Some(face) = rest.pop() {
                    if let Some(halves) = halved(&face, LONGEST * geometry.extent()) {
                        rest.extend(halves);
                    } else if buffer.seen(&face, number) != visible::Seen::Hidden {
                        let near = face.iter().map(|point| point[2]).sum::<f64>() / face.len() as f64;
                        partly.push((near, seen(&face, shades[number])));
                    }
                }
            }
        }
    }
    partly.sort_by(|a, b| a.0.total_cmp(&b.0));
    partly.into_iter().map(|(_, face)| face).chain(wholly).collect()
}

fn seen(face: &Laid, shade: Shade) -> Seen {
    Seen { points: face.iter().map(|[x, y, _]| [*x, *y]).collect(), shade }
}

/// The faces of a surface towards the viewer, and their brightness. Surfaces are closed: faces away from the viewer are
/// hidden.
fn faces(mesh: &Mesh, (geometry, projection): (&Geometry, &Projection), mut visit: impl FnMut(Laid, f64)) {
    for face in &mesh.faces {
        let points: Vec<Vector3> = face.iter().map(|k| mesh.points[*k as usize]).collect();
        let Some(normal) = normal(&points) else { continue };
        if normal.dot(&projection.away) <= 0.0 {
            continue;
        }
        let laid = |point: &Vector3| {
            let [right, above] = projection.flat(point);
            [right, above, projection.near(point)]
        };
        visit(points.iter().map(laid).collect(), projection.brightness(&normal, &geometry.up));
    }
}

/// The normal of a face by Newell's formula; none for a face without area.
pub(super) fn normal(points: &[Vector3]) -> Option<Vector3> {
    // Relative to the first point, so that positions far from the origin keep their digits.
    let from_first = |k: usize| points[k % points.len()] - points[0];
    let twice: Vector3 = (0..points.len()).map(|k| from_first(k).cross(&from_first(k + 1))).sum();
    twice.try_normalize(0.0)
}

/// A face of four corners, divided across an edge that is too long.
fn halved(face: &Laid, longest: f64) -> Option<[Laid; 2]> {
    let &[a, b, c, d] = face.as_slice() else { return None };
    let length = |p: [f64; 3], q: [f64; 3]| Vector3::from(p).metric_distance(&Vector3::from(q));
    let (along, across) = (length(a, b).max(length(d, c)), length(c, b).max(length(a, d)));
    if along.max(across) <= longest {
        return None;
    }
    let middle = |p: [f64; 3], q: [f64; 3]| std::array::from_fn(|k| 0.5 * (p[k] + q[k]));
    Some(if along >= across {
        let (m, n) = (middle(a, b), middle(c, d));
        [vec![a, m, n, d], vec![m, b, c, n]]
    } else {
        let (m, n) = (middle(b, c), middle(d, a));
        [vec![a, b, m, n], vec![n, m, c, d]]
    })
}
