//! Tests of `pictures::geometry::mesh`, a module of it.

use super::*;

/// Six times the volume, to which faces that point inward contribute negatively.
fn volume(mesh: &Mesh) -> f64 {
    let tetrahedron = |[a, b, c]: [u32; 3]| {
        let [a, b, c] = [a, b, c].map(|k| mesh.points[k as usize]);
        a.dot(&b.cross(&c)) / 6.0
    };
    mesh.triangles().into_iter().map(tetrahedron).sum()
}

#[test]
fn faces_look_outward_and_enclose_their_volume() {
    let round = ROUND as f64 / TAU * (TAU / ROUND as f64).sin();
    let cases = [
        (Mesh::cylinder(0.5, 3.0), PI * 0.25 * 3.0 * round, 1e-12),
        (Mesh::cone(0.5, 3.0), PI * 0.25 * round, 2e-3),
        (Mesh::ball(2.0), PI * 4.0 / 3.0 * 8.0, 0.05),
        (Mesh::block([1.0, 2.0, 3.0]), 6.0, 1e-12),
        (Mesh::octahedron(1.0), 4.0 / 3.0, 1e-12),
        (Mesh::ring(3.0, 0.5), 2.0 * PI * PI * 3.0 * 0.25, 0.15),
        (Mesh::plinth(1.0, 2.0, 3.0), 3.0 / 3.0 * (2.0 + 8.0 + 4.0), 1e-12),
    ];
    for (mesh, expected, tolerance) in cases {
        let found = volume(&mesh);
        assert!((found - expected).abs() <= tolerance * expected, "{found} {expected}");
    }
    assert!(volume(&Mesh::coil(1.0, 0.1, 5.0, 10.0)) > 0.0);
}

#[test]
fn the_shortest_turn_leads_there() {
    for direction in [[0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.6, 0.0, 0.8], [0.0, 0.8, -0.6]] {
        let direction = Vector3::from(direction);
        assert!((turn_to(&direction).apply(&Vector3::y()) - direction).norm() < 1e-12);
    }
}
