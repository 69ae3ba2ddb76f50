//! Tests of `surface`, a module of it.

use super::*;
use lissom_contact::geometry::surfaces::Polygon;
use std::sync::Arc;

/// By the divergence theorem: positive where triangles are seen from outside.
fn volume(surface: &Surface) -> f64 {
    let place = |index: u32| Vector3::from(surface.points[index as usize].map(f64::from));
    surface.triangles.iter().map(|t| place(t[0]).dot(&place(t[1]).cross(&place(t[2]))) / 6.0).sum()
}

#[test]
fn surfaces_of_solids_enclose_their_volume() {
    for (solid, slack) in [
        (Solid::Box([0.1, 0.2, 0.3]), 1e-6),
        (Solid::Tube { outer: 0.1, inner: 0.0, length: 0.4, axis: Vector3::x() }, 0.01),
        (Solid::Tube { outer: 0.1, inner: 0.06, length: 0.4, axis: Vector3::new(0.48, -0.6, 0.64) }, 0.01),
        (Solid::Sphere(0.2), 0.02),
        (Solid::Ellipsoid([0.2, 0.1, 0.3]), 0.02),
    ] {
        let surface = Surface::of_solid(&solid, &Vector3::new(0.3, -0.1, 0.2));
        let ratio = volume(&surface) / solid.volume();
        assert!((ratio - 1.0).abs() < slack, "{solid:?}: {ratio}");
    }
}

#[test]
fn prisms_with_notches_enclose_their_volume() {
    let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.5], [0.0, 2.0]];
    let polygon = Polygon::new(&corners).expect("valid");
    let prism = Surface::of_form(&Form::Polygon(Arc::new(polygon)), 0.5);
    // The square without its notch.
    assert!((volume(&prism) - 0.5 * (4.0 - 1.5)).abs() < 1e-6, "{}", volume(&prism));
}

fn of_stl(bytes: &[u8]) -> Result<Surface, SurfaceError> {
    Surface::of_file(bytes, &|_| Err("STL files name no others".to_owned()))
}

#[test]
fn both_forms_of_stl_are_read() {
    let corners: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let (mut text, mut binary) = ("solid part\n".to_owned(), vec![0_u8; 80]);
    binary.extend(4_u32.to_le_bytes());
    for face in faces {
        text.push_str("facet normal 0 0 0\nouter loop\n");
        binary.extend([0; 12]);
        for corner in face.map(|index: usize| corners[index]) {
            text.extend([format!("vertex {} {} {:e}\n", corner[0], corner[1], corner[2])]);
            binary.extend(corner.iter().flat_map(|number| number.to_le_bytes()));
        }
        text.push_str("endloop\nendfacet\n");
        binary.extend([0; 2]);
    }
    text.push_str("endsolid part\n");
    let surface = of_stl(text.as_bytes()).unwrap();
    assert_eq!((surface.points.len(), surface.triangles.len()), (4, 4));
    assert!((volume(&surface) - 1.0 / 6.0).abs() < 1e-12);
    assert_eq!(of_stl(&binary).unwrap(), surface);
    assert_eq!(of_stl(&binary[..200]), Err(SurfaceError::Foreign));
    assert_eq!(of_stl(b"solid\nfacet\nendsolid"), Err(SurfaceError::Empty));
    assert_eq!(of_stl(b"solid\nfacet vertex 1 2 x"), Err(SurfaceError::Foreign));
    assert_eq!(
        of_stl(b"solid\nfacet vertex 1 2 nan vertex 0 0 0 vertex 1 0 0"),
        Err(SurfaceError::NotFinite(1))
    );
}
