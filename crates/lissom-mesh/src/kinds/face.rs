//! Faces: quadrilaterals with four nodes, and faces of solids with six and eight.

use lissom_motion::Vector3;

use super::functions::{Fill, Functions, Natural, Rule};
use super::hexahedron;
use super::points::{on_square, on_triangle};

/// Functions of a face over its first two natural coordinates and its rule, by its number of nodes: four, six or eight.
pub fn rule(nodes: usize) -> Option<(Fill, Rule)> {
    match nodes {
        4 => Some((square, (gauss, 4))),
        6 => Some((triangle, (on_triangle, 9))),
        8 => Some((quadrilateral, (on_square, 9))),
        _ => None,
    }
}

/// Signs of r and s at the nodes of a quadrilateral.
pub const CORNERS: [(f64, f64); 4] = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];

/// The bilinear functions of its nodes at (r, s), and their derivatives with respect to r and s.
pub fn bilinear(r: f64, s: f64) -> [[f64; 4]; 3] {
    let of = |value: &dyn Fn((f64, f64)) -> f64| CORNERS.map(value);
    [
        of(&|(a, b)| 0.25 * (1.0 + a * r) * (1.0 + b * s)),
        of(&|(a, b)| 0.25 * a * (1.0 + b * s)),
        of(&|(a, b)| 0.25 * b * (1.0 + a * r)),
    ]
}

fn square([r, s, _]: Natural, values: &mut [f64], slopes: &mut [Vector3]) {
    let [own, by_r, by_s] = bilinear(r, s);
    values.copy_from_slice(&own);
    slopes.iter_mut().zip(by_r).zip(by_s).for_each(|((slope, r), s)| *slope = Vector3::new(r, s, 0.0));
}

fn gauss(k: usize) -> (Natural, f64) {
    let far = (1.0_f64 / 3.0).sqrt();
    ([if k.is_multiple_of(2) { -far } else { far }, if k < 2 { -far } else { far }, 0.0], 1.0)
}

/// Quadratic functions of a triangle with six nodes, over r, s ≥ 0 with r + s ≤ 1.
fn triangle([x, y, _]: Natural, values: &mut [f64], slopes: &mut [Vector3]) {
    let area = [1.0 - x - y, x, y];
    let slope = [Vector3::new(-1.0, -1.0, 0.0), Vector3::x(), Vector3::y()];
    for i in 0..3 {
        let j = (i + 1) % 3;
        values[i] = area[i] * (2.0 * area[i] - 1.0);
        slopes[i] = (4.0 * area[i] - 1.0) * slope[i];
        values[3 + i] = 4.0 * area[i] * area[j];
        slopes[3 + i] = 4.0 * (area[j] * slope[i] + area[i] * slope[j]);
    }
}

/// Serendipity functions of a quadrilateral with eight nodes: those of a face of a hexahedron.
fn quadrilateral([r, s, _]: Natural, values: &mut [f64], slopes: &mut [Vector3]) {
    let solid = Functions::<20>::at(hexahedron::functions, [r, s, 1.0]);
    for (i, &node) in hexahedron::KIND.faces[1].iter().enumerate() {
        (values[i], slopes[i]) = (solid.values[node], solid.slopes[node]);
    }
}

/// Shares of the nodes in a force per area: the integrals of their functions [m²]. Those of corners of second order are zero or negative.
pub fn area_shares(positions: &[Vector3]) -> Vec<f64> {
    let Some((fill, (at, count))) = rule(positions.len()) else { return Vec::new() };
    let (mut values, mut slopes) = (vec![0.0; positions.len()], vec![Vector3::zeros(); positions.len()]);
    let mut shares = vec![0.0; positions.len()];
    for (place, weight) in (0..count).map(at) {
        fill(place, &mut values, &mut slopes);
        let [along, across] =
            [0, 1].map(|k| positions.iter().zip(&slopes).map(|(x, slope)| slope[k] * x).sum::<Vector3>());
        let area = weight * along.cross(&across).norm();
        shares.iter_mut().zip(&values).for_each(|(sum, value)| *sum += area * value);
    }
    shares
}
