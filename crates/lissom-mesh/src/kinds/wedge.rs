//! Wedges: triangles that are extended along a third coordinate.

use lissom_motion::Vector3;

use super::SolidKind;
use super::functions::Natural;
use super::points::{on_line, on_triangle};
use crate::mesh::MeshShape;

/// The row of the table.
pub(super) static KIND: SolidKind = SolidKind {
    word: "wedge",
    shapes: [MeshShape::Wedge6, MeshShape::Wedge15],
    abaqus: [&["C3D6", "C3D6H"], &["C3D15", "C3D15H"]],
    gmsh: [6, 18],
    gmsh_edges: &[[0, 1], [0, 2], [0, 3], [1, 2], [1, 4], [2, 5], [3, 4], [3, 5], [4, 5]],
    corners: &[
        [0.0, 0.0, -1.0],
        [1.0, 0.0, -1.0],
        [0.0, 1.0, -1.0],
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 1.0],
        [0.0, 1.0, 1.0],
    ],
    edges: &[[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [0, 3], [1, 4], [2, 5]],
    faces: &[
        &[0, 2, 1, 8, 7, 6],
        &[3, 4, 5, 9, 10, 11],
        &[0, 1, 4, 3, 6, 13, 9, 12],
        &[1, 2, 5, 4, 7, 14, 10, 13],
        &[2, 0, 3, 5, 8, 12, 11, 14],
    ],
    functions,
    points: (point, 9),
    fine: (fine, 27),
    stress_points: (stress_point, 6),
    stress_share,
};

/// Serendipity functions: L ((2 L - 1)(1 ± t) - (1 - t²))/2 at corners, 2 L L' (1 ± t) at edges of the triangles, L (1 - t²) between them.
fn functions([x, y, t]: Natural, values: &mut [f64], slopes: &mut [Vector3]) {
    let area = [1.0 - x - y, x, y];
    let slope = [Vector3::new(-1.0, -1.0, 0.0), Vector3::x(), Vector3::y()];
    let bubble = 1.0 - t * t;
    for (end, sign) in [(0, -1.0), (1, 1.0)] {
        let linear = 1.0 + sign * t;
        for i in 0..3 {
            let own = area[i];
            values[3 * end + i] = 0.5 * own * ((2.0 * own - 1.0) * linear - bubble);
            slopes[3 * end + i] = 0.5 * ((4.0 * own - 1.0) * linear - bubble) * slope[i]
                + 0.5 * own * ((2.0 * own - 1.0) * sign + 2.0 * t) * Vector3::z();
            let j = (i + 1) % 3;
            let edge = 6 + 3 * end + i;
            values[edge] = 2.0 * own * area[j] * linear;
            slopes[edge] = 2.0 * linear * (area[j] * slope[i] + own * slope[j])
                + 2.0 * sign * own * area[j] * Vector3::z();
        }
    }
    for i in 0..3 {
        values[12 + i] = area[i] * bubble;
        slopes[12 + i] = bubble * slope[i] - 2.0 * t * area[i] * Vector3::z();
    }
}

/// Three points of the triangle, of second order.
fn in_triangle(i: usize) -> [f64; 2] {
    [1, 2].map(|corner| if i == corner { 2.0 / 3.0 } else { 1.0 / 6.0 })
}

/// Nine points: without any mode that has no energy.
fn point(k: usize) -> (Natural, f64) {
    let ([x, y], (t, weight)) = (in_triangle(k % 3), on_line()[k / 3]);
    ([x, y, t], weight / 6.0)
}

fn fine(k: usize) -> (Natural, f64) {
    let (([x, y, _], area), (t, weight)) = (on_triangle(k % 9), on_line()[k / 9]);
    ([x, y, t], area * weight)
}

/// Coordinate of the Gauss points along the third axis.
fn height() -> f64 {
    (1.0_f64 / 3.0).sqrt()
}

fn stress_point(k: usize) -> Natural {
    let [x, y] = in_triangle(k % 3);
    [x, y, if k < 3 { -height() } else { height() }]
}

/// Linear in the triangle and along the third coordinate.
fn stress_share(point: usize, [x, y, t]: Natural) -> f64 {
    let sign = if point < 3 { -1.0 } else { 1.0 };
    (2.0 * [1.0 - x - y, x, y][point % 3] - 1.0 / 3.0) * 0.5 * (1.0 + sign * t / height())
}
