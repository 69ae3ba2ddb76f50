//! A model as pixels, with smooth shading of round surfaces.

use lissom_model::output::{Corner, DepthBuffer, Image};
use lissom_motion::Motion as Pose;

use super::lines::lines;
use super::paint::Paint;
use super::view::Projection;
use crate::pictures::geometry::{Geometry, Normals};

/// Distance of edges from their surface towards the viewer, relative to the model.
const ABOVE: f64 = 2e-3;

/// A model at poses of its nodes and a time [s], on white. `place` returns pixels for projected positions.
pub(super) fn depth_image(
    (geometry, paint, projection): (&Geometry, &Paint, &Projection),
    (poses, time): (&[Pose], f64),
    size: [u32; 2],
    place: impl Fn(&[f64; 2]) -> [f64; 2],
) -> Image {
    let mut buffer = DepthBuffer::new(size);
    for piece in &geometry.pieces {
        let Some(mesh) = piece.at(poses, time) else { continue };
        let shades = paint.shades(piece, &mesh, poses);
        let flat: Vec<[f64; 3]> = (mesh.points.iter())
            .map(|point| {
                let [x, y] = place(&projection.flat(point));
                [x, y, projection.near(point)]
            })
            .collect();
        let normals = Normals::of(&mesh);
        for (index, face) in mesh.faces.iter().enumerate() {
            let Some(own) = normals.face(index) else { continue };
            let facing = own.dot(&projection.away);
            if facing == 0.0 || facing < 0.0 && !mesh.is_open {
                continue;
            }
            let corner = |&point: &u32| -> Corner {
                let [x, y, near] = flat[point as usize];
                [x, y, near, projection.brightness_of_side(&own, &normals.at(point, &own), &geometry.up)]
            };
            let corners: Vec<Corner> = face.iter().map(corner).collect();
            buffer.draw(&corners, shades[index]);
        }
        for line in lines(&mesh, (geometry, projection)) {
            let ends = line.ends.map(|point| flat[point as usize]);
            let corners = strip(ends, line.width, ABOVE * geometry.size);
            buffer.draw(&corners.map(|[x, y, near]| [x, y, near, line.bright]), shades[line.face]);
        }
    }
    buffer.image()
}

/// A line of this width as a face in front of it.
fn strip([a, b]: [[f64; 3]; 2], width: f64, front: f64) -> [[f64; 3]; 4] {
    let along = [b[0] - a[0], b[1] - a[1]];
    let half = 0.5 * width / along[0].hypot(along[1]).max(f64::MIN_POSITIVE);
    let beside = |[x, y, near]: [f64; 3], side: f64| {
        [x - side * half * along[1], y + side * half * along[0], near + front]
    };
    [beside(a, -1.0), beside(b, -1.0), beside(b, 1.0), beside(a, 1.0)]
}

#[cfg(test)]
#[path = "../../../tests/unit/pictures/picture/depth_image.rs"]
mod tests;
