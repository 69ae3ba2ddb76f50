//! Surfaces as shaded polygons in painting order, and the edges of open ones as lines above them.

use lissom_model::output::Shade;
use lissom_model::scene::Tone;
use lissom_motion::{Motion as Pose, Vector3};

use super::lines::lines;
use super::paint::{Look, Paint};
use super::view::Projection;
use super::visible::{self, ItemBuffer, Laid};
use crate::pictures::geometry::{Colour, Geometry, Mesh, normal};

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
        Colour::Own(shade) => shade,
        Colour::Ground => [0xa9, 0xb2, 0xbe],
        Colour::Tone(Tone::Light) => [0xf1, 0xb4, 0x34],
        Colour::Tone(Tone::Dark) => [0x4d, 0x56, 0x63],
        Colour::Tone(Tone::Drive | Tone::Load) => [0xd1, 0x49, 0x5b],
        Colour::Tone(Tone::Spring) => [0x5b, 0x8c, 0x5a],
        Colour::Tone(Tone::Stop) => [0x8a, 0x6d, 0x3b],
        Colour::Tone(Tone::Moment) => [0x8e, 0x5b, 0xb5],
    }
}

/// A projected face or edge: points to the right and upward [m], and its colour.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    /// Points of the face.
    pub points: Vec<[f64; 2]>,
    /// Shaded colour of the face.
    pub shade: Shade,
    /// Width of an edge [pixels]; none for a face.
    pub width: Option<f64>,
}

/// The faces of a model at poses of its nodes and a time [s], in painting order: first the partly hidden ones, divided
/// into small faces, the farthest first; then those that are fully visible; last the visible edges of open surfaces.
pub fn painted(
    (geometry, paint): (&Geometry, &Paint),
    projection: &Projection,
    poses: &[Pose],
    time: f64,
) -> Vec<Seen> {
    let (mut laid, mut shades, mut is_open, mut edges) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for piece in &geometry.pieces {
        let Some(mesh) = piece.at(poses, time) else { continue };
        let (divided, looks) =
            if mesh.is_open { paint.surface(piece, &mesh, poses) } else { Default::default() };
        let plain = shade_of(piece.colour);
        let drawn = if mesh.is_open { &divided } else { &mesh };
        faces(drawn, projection, |index, face, normal| {
            let look = looks.get(index).copied().unwrap_or(Look { shade: plain, normal });
            laid.push(face);
            is_open.push(mesh.is_open);
            shades
                .push(shaded(look.shade, projection.brightness_of_side(&normal, &look.normal, &geometry.up)));
        });
        let own = if mesh.is_open { paint.shades(piece, &mesh, poses) } else { Vec::new() };
        for line in lines(&mesh, (geometry, projection)) {
            let ends = line.ends.map(|point| laid_at(projection, &mesh.points[point as usize]));
            edges.push((ends, shaded(own[line.face], line.bright), line.width));
        }
    }
    let buffer = ItemBuffer::of(&laid, geometry.extent());
    let (mut partly, mut wholly) = (Vec::new(), Vec::new());
    for (number, face) in laid.iter().enumerate() {
        match buffer.seen(face, number) {
            // A gap in an open surface would show what is behind it.
            visible::Seen::Hidden if is_open[number] && buffer.is_missed(face) => {
                partly.push((mean_near(face), seen(face, shades[number])));
            }
            visible::Seen::Hidden => {}
            visible::Seen::Wholly => wholly.push(seen(face, shades[number])),
            visible::Seen::Partly => {
                let mut rest = vec![face.clone()];
                while let Some(face) = rest.pop() {
                    if let Some(halves) = halved(&face, LONGEST * buffer.size()) {
                        rest.extend(halves);
                    } else if buffer.seen(&face, number) != visible::Seen::Hidden {
                        partly.push((mean_near(&face), seen(&face, shades[number])));
                    }
                }
            }
        }
    }
    partly.sort_by(|a, b| a.0.total_cmp(&b.0));
    let lines = edges.into_iter().flat_map(|(ends, shade, width)| {
        let line = move |points: [[f64; 2]; 2]| Seen { points: points.to_vec(), shade, width: Some(width) };
        buffer.seen_parts(ends).into_iter().map(line)
    });
    partly.into_iter().map(|(_, face)| face).chain(wholly).chain(lines).collect()
}

fn mean_near(face: &Laid) -> f64 {
    face.iter().map(|point| point[2]).sum::<f64>() / face.len() as f64
}

fn shaded(shade: Shade, bright: f64) -> Shade {
    shade.map(|part| (f64::from(part) * bright).round().clamp(0.0, 255.0) as u8)
}

fn laid_at(projection: &Projection, point: &Vector3) -> [f64; 3] {
    let [right, above] = projection.flat(point);
    [right, above, projection.near(point)]
}

fn seen(face: &Laid, shade: Shade) -> Seen {
    Seen { points: face.iter().map(|[x, y, _]| [*x, *y]).collect(), shade, width: None }
}

/// The faces of a surface towards the viewer, and their normals. Those of a closed surface away from the viewer are hidden; of an
/// open one they show their other side.
fn faces(mesh: &Mesh, projection: &Projection, mut visit: impl FnMut(usize, Laid, Vector3)) {
    for (index, face) in mesh.faces.iter().enumerate() {
        let mut points: Vec<Vector3> = face.iter().map(|k| mesh.points[*k as usize]).collect();
        let Some(normal) = normal(&points) else { continue };
        let facing = normal.dot(&projection.away);
        if facing < 0.0 && mesh.is_open {
            points.reverse();
        }
        if facing > 0.0 || facing < 0.0 && mesh.is_open {
            let laid = points.iter().map(|point| laid_at(projection, point)).collect();
            visit(index, laid, normal);
        }
    }
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
