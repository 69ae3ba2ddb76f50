//! Tests of `geometry::hollow`, a module of it.

use super::*;
use crate::geometry::curves::Spline;
use crate::geometry::surfaces::{HeightField, Mesh, Outline, Polygon};

/// A prism with a right-angled groove between two ridges of a height of 1, along the third axis.
const GROOVE: [[f64; 2]; 7] =
    [[-1.0, 1.0], [0.0, 0.0], [1.0, 1.0], [2.0, 1.0], [2.0, -1.0], [-2.0, -1.0], [-2.0, 1.0]];

fn mesh() -> Mesh {
    let ends = GROOVE.iter().flat_map(|&[x, y]| [Vector3::new(x, y, -1.0), Vector3::new(x, y, 1.0)]);
    let points: Vec<Vector3> = ends.collect();
    let count = GROOVE.len() as u32;
    let sides = (0..count).flat_map(|k| {
        let (a, b) = (2 * k, 2 * ((k + 1) % count));
        [[a, a + 1, b], [b, a + 1, b + 1]]
    });
    // Both ends from the triangles of the polygon.
    let caps = [[0, 5, 6], [0, 1, 5], [1, 4, 5], [1, 2, 4], [2, 3, 4]];
    let caps = caps
        .iter()
        .flat_map(|&[a, b, c]: &[u32; 3]| [[2 * a, 2 * b, 2 * c], [2 * a + 1, 2 * c + 1, 2 * b + 1]]);
    Mesh::new(&points, &sides.chain(caps).collect::<Vec<_>>()).expect("closed")
}

fn found(surface: &dyn Surface, y: [f64; 3], radius: f64) -> Option<Hollow> {
    hollow(surface, &Vector3::from(y), radius)
}

/// In a right angle the force on one side does not change the penetration of the other.
#[test]
fn a_ball_in_a_groove_touches_both_sides() {
    let polygon = Polygon::new(&GROOVE).expect("valid");
    let mesh = mesh();
    let surfaces: [&dyn Surface; 2] = [&polygon, &mesh];
    let (radius, root) = (0.1, 0.5_f64.sqrt());
    for (k, surface) in surfaces.into_iter().enumerate() {
        // Penetrations of both sides.
        for [one, two] in [[1e-3, 1e-3], [1e-3, 4e-4], [4e-4, 1e-3]] {
            let [a, b] = [radius - one, radius - two];
            let at = found(surface, [root * (a - b), root * (a + b), 0.1], radius).expect("a hollow");
            assert!((at.depth - one.max(two)).abs() < 1e-12, "{k} {at:?}");
            assert!((at.remaining - one.min(two)).abs() < 1e-12, "{k} {at:?}");
        }
        let touching = 2.0_f64.sqrt() * radius;
        for y in [
            // One side, far from the groove and beside it.
            [0.5 - root * 0.099, 0.5 + root * 0.099, 0.1],
            [root * -2e-3, touching, 0.1],
            // A ridge, and the plane beside it.
            [1.02, 1.08, 0.1],
            [1.0, 1.099, 0.1],
            [1.5, 1.099, 0.1],
            // Both not quite.
            [0.0, touching + 1e-6, 0.1],
        ] {
            assert_eq!(found(surface, y, radius), None, "{k} {y:?}");
        }
    }
}

/// Smooth surfaces have only the hollows that are narrower than the ball: here a cosine with a smallest radius of 1.
#[test]
fn smooth_hollows_are_those_narrower_than_the_ball() {
    let height = |x: f64| -0.1 * (10.0_f64.sqrt() * x).cos();
    let spacing = 0.01;
    let count = 200;
    let upper = (0..=count).rev().map(|k| spacing * (f64::from(k) - 100.0)).map(|x| [x, height(x)]);
    let lower = [[-1.0, -0.5], [-0.5, -0.6], [0.0, -0.6], [0.5, -0.6], [1.0, -0.5]];
    let points: Vec<[f64; 2]> = upper.chain(lower).collect();
    let outline = Outline::new(Spline::new(&points).expect("valid"));
    let heights: Vec<f64> = (0..=count).map(|k| height(spacing * (f64::from(k) - 100.0))).collect();
    let field = HeightField::new(vec![heights; 3], [2.0, 1.0]).expect("valid");
    // The radius of curvature at the bottom is 1.
    for (radius, is_hollow) in [(0.5, false), (0.9, false), (1.6, true)] {
        let least = |centre: f64| {
            let distance = |k: i32| (f64::from(k) * 1e-3, height(f64::from(k) * 1e-3) - centre);
            (-990..990).map(distance).map(|(x, y)| x.hypot(y)).fold(f64::INFINITY, f64::min)
        };
        let bottom = height(0.0);
        let centre = (0..10_000)
            .map(|k| bottom + radius - 5e-4 + 1e-4 * f64::from(k))
            .find(|&y| least(y) > radius - 1e-3);
        let centre = centre.expect("a ball above the hollow");
        let on_outline = found(&outline, [1e-4, centre, 0.0], radius).is_some();
        let on_field = found(&field, [1e-4, 0.05, centre], radius).is_some();
        assert_eq!([on_outline, on_field], [is_hollow; 2], "{radius} {centre}");
    }
}
