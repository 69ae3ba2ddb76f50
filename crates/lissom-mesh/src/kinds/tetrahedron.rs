//! Tetrahedra.

use lissom_motion::Vector3;

use super::functions::Natural;
use super::{SolidKind, hexahedron};
use crate::mesh::MeshShape;

const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];

/// The row of the table.
pub(super) static KIND: SolidKind = SolidKind {
    word: "tetrahedron",
    shapes: [MeshShape::Tetrahedron4, MeshShape::Tetrahedron10],
    abaqus: [&["C3D4", "C3D4H"], &["C3D10", "C3D10H", "C3D10M", "C3D10MH", "C3D10HS", "C3D10I", "C3D10T"]],
    gmsh: [4, 11],
    gmsh_edges: &[[0, 1], [1, 2], [2, 0], [3, 0], [2, 3], [1, 3]],
    corners: &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    edges: &EDGES,
    faces: &[&[0, 2, 1, 6, 5, 4], &[0, 1, 3, 4, 8, 7], &[1, 2, 3, 5, 9, 8], &[2, 0, 3, 6, 7, 9]],
    functions,
    points: (point, 4),
    fine: (fine, 27),
    stress_points: (|k| point(k).0, 4),
    stress_share,
};

/// Quadratic functions: L (2 L - 1) at corners, 4 L L' at edges.
fn functions([x, y, z]: Natural, values: &mut [f64], slopes: &mut [Vector3]) {
    let volume = [1.0 - x - y - z, x, y, z];
    let slope = [Vector3::repeat(-1.0), Vector3::x(), Vector3::y(), Vector3::z()];
    for i in 0..4 {
        values[i] = volume[i] * (2.0 * volume[i] - 1.0);
        slopes[i] = (4.0 * volume[i] - 1.0) * slope[i];
    }
    for (k, [i, j]) in EDGES.into_iter().enumerate() {
        values[4 + k] = 4.0 * volume[i] * volume[j];
        slopes[4 + k] = 4.0 * (volume[j] * slope[i] + volume[i] * slope[j]);
    }
}

/// The smaller volume coordinate of four points of second order; the other one is larger by √5/5.
fn near() -> f64 {
    (5.0 - 5.0_f64.sqrt()) / 20.0
}

fn point(i: usize) -> (Natural, f64) {
    let far = 1.0 - 3.0 * near();
    (std::array::from_fn(|k| if i == k + 1 { far } else { near() }), 1.0 / 24.0)
}

/// Linear between the points.
fn stress_share(point: usize, [x, y, z]: Natural) -> f64 {
    ([1.0 - x - y - z, x, y, z][point] - near()) / (1.0 - 4.0 * near())
}

/// Points of a hexahedron with a side of which one edge remains and an end of which one corner remains.
fn fine(k: usize) -> (Natural, f64) {
    let (place, weight) = hexahedron::fine(k);
    let [u, v, w] = place.map(|x| 0.5 * (1.0 + x));
    let (rest, left) = (1.0 - u, 1.0 - v);
    ([u, v * rest, w * rest * left], 0.125 * weight * rest * rest * left)
}
