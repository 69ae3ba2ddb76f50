//! Tests of `geometry::surfaces::mesh`, a module of it.

use super::*;

/// The faces of the inset of a hull are those of the hull, moved inwards, and the edges of the hull end within its faces.
#[test]
fn an_inset_moves_all_faces_inwards() {
    let random = |k: u32, of: f64| (1e4 * (f64::from(k) * of).sin()).fract();
    let point = |k: u32| Vector3::new(random(k, 0.754_877), random(k, 0.569_840), random(k, 0.430_159));
    let cube = |k: u32| Vector3::from_fn(|axis, _| f64::from(k >> axis & 1) - 0.3);
    let star = |k: u32| Vector3::ith(k as usize % 3, if k < 3 { 1.0 } else { -0.7 });
    let clouds: [Vec<Vector3>; 4] = [
        (0..8).map(cube).collect(),
        (0..6).map(star).collect(),
        (1..200).map(point).collect(),
        (1..200).map(|k| 0.4 * point(k).normalize()).collect(),
    ];
    for cloud in clouds {
        let hull = Mesh::hull(&cloud).expect("a hull");
        let by = 0.04 * hull.depth();
        let inset = hull.inset(by).expect("an inset");
        let height = |own: Vector3| hull.planes().map(move |(point, normal)| normal.dot(&(own - point)));
        let edges = hull.edges(by);
        let ends = edges.iter().flatten().copied();
        for place in inset.corners().chain(ends) {
            let highest = height(place).fold(f64::NEG_INFINITY, f64::max);
            assert!((highest + by).abs() < 1e-6 * by, "{highest} {by} {}", cloud.len());
        }
        for (point, normal) in hull.planes() {
            let highest = inset.corners().map(|own| normal.dot(&(own - point)));
            let highest = highest.fold(f64::NEG_INFINITY, f64::max);
            assert!((highest + by).abs() < 1e-6 * by, "{highest} {by} {}", cloud.len());
        }
        assert!(cloud.len() > 8 || edges.len() == 12, "{}", edges.len());
    }
}
