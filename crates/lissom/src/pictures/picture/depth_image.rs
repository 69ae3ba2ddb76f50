//! A model as pixels, with smooth shading of round surfaces.

use lissom_model::output::{Corner, DepthBuffer, Image};
use lissom_motion::{Motion as Pose, Vector3};

use super::painter::{normal, shade_of};
use super::view::Projection;
use crate::pictures::geometry::{Geometry, Mesh};

/// Cosine of the angle [36°] between faces up to which their common edge is round.
const ROUND: f64 = 0.81;

/// A model at poses of its nodes and a time [s], on white. `place` returns pixels for projected positions.
pub(super) fn depth_image(
    (geometry, projection): (&Geometry, &Projection),
    (poses, time): (&[Pose], f64),
    size: [u32; 2],
    place: impl Fn(&[f64; 2]) -> [f64; 2],
) -> Image {
    let mut buffer = DepthBuffer::new(size);
    for piece in &geometry.pieces {
        let Some(mesh) = piece.at(poses, time) else { continue };
        let shade = shade_of(piece.colour);
        let flat: Vec<[f64; 3]> = (mesh.points.iter())
            .map(|point| {
                let [x, y] = place(&projection.flat(point));
                [x, y, projection.near(point)]
            })
            .collect();
        let normals: Vec<Option<Vector3>> = mesh.faces.iter().map(|face| normal_of(&mesh, face)).collect();
        let around = faces_around(&mesh);
        for (face, own) in mesh.faces.iter().zip(&normals) {
            let Some(own) = own.filter(|own| own.dot(&projection.away) > 0.0) else { continue };
            let corner = |&point: &u32| -> Corner {
                let others = around[point as usize].iter().filter_map(|face| normals[*face as usize]);
                let sum: Vector3 = others.filter(|other| other.dot(&own) > ROUND).sum();
                let smooth = sum.try_normalize(0.0).unwrap_or(own);
                let [x, y, near] = flat[point as usize];
                [x, y, near, projection.brightness(&smooth, &geometry.up)]
            };
            let corners: Vec<Corner> = face.iter().map(corner).collect();
            buffer.draw(&corners, shade);
        }
    }
    buffer.image()
}

fn normal_of(mesh: &Mesh, face: &[u32]) -> Option<Vector3> {
    normal(&face.iter().map(|point| mesh.points[*point as usize]).collect::<Vec<_>>())
}

/// The faces around every point of a mesh.
fn faces_around(mesh: &Mesh) -> Vec<Vec<u32>> {
    let mut around = vec![Vec::new(); mesh.points.len()];
    for (index, face) in mesh.faces.iter().enumerate() {
        for point in face {
            around[*point as usize].push(index as u32);
        }
    }
    around
}
