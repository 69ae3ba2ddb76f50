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
mod tests {
    use lissom_core::kinematics::GROUND;
    use lissom_motion::Vector3;

    use super::*;
    use crate::pictures::geometry::{Carrier, Colour, Mesh, Piece, Role};
    use crate::pictures::picture::View;

    /// Red values of the pixels of four tilted squares, from above.
    fn pixels(is_open: bool, is_reversed: bool) -> Vec<u8> {
        let points = (0..9).map(|k| Vector3::new(f64::from(k % 3), f64::from(k / 3), 0.2 * f64::from(k / 3)));
        let face = |first: u32| {
            let mut face = vec![first, first + 1, first + 4, first + 3];
            if is_reversed {
                face.reverse();
            }
            face
        };
        let mesh = Mesh { points: points.collect(), faces: [0, 1, 3, 4].map(face).to_vec(), is_open };
        let piece = Piece {
            name: "sheet".to_owned(),
            role: Role::Shell,
            colour: Colour::Part(1),
            mesh,
            carrier: Carrier::Node(GROUND),
        };
        let (low, high) = (Vector3::zeros(), Vector3::new(2.0, 2.0, 0.4));
        let geometry = Geometry { pieces: vec![piece], low, high, size: 2.0, up: Vector3::z() };
        let projection = Projection::of(&geometry, View::Top);
        let model = (&geometry, &Paint::default(), &projection);
        let place = |[x, y]: &[f64; 2]| [20.0 + 30.0 * x, 80.0 - 30.0 * y];
        let image = depth_image(model, (&[Pose::identity()], 0.0), [100, 100], place);
        image.pixels.iter().map(|shade| shade[0]).collect()
    }

    #[test]
    fn open_surfaces_are_seen_from_both_sides_and_have_edges() {
        let at = |image: &[u8], x: usize, y: usize| image[100 * y + x];
        let [front, back] = [false, true].map(|is_reversed| pixels(true, is_reversed));
        for (a, b) in front.iter().zip(&back) {
            assert!(a == b && *a == 255 || b < a && *a < 255, "the back is darker: {a} {b}");
        }
        let (face, inner, border) = (at(&front, 35, 65), at(&front, 50, 65), at(&front, 20, 65));
        assert!(border < inner && inner < face && face < 255, "{border} {inner} {face}");
        assert_eq!((at(&front, 10, 65), at(&front, 90, 65)), (255, 255));
        // A closed surface is not seen from inside, and has no lines.
        assert!(pixels(false, true).iter().all(|pixel| *pixel == 255));
        let closed = pixels(false, false);
        assert_eq!(at(&closed, 50, 65), at(&closed, 35, 65));
    }
}
