//! A form of each kind.

use std::sync::Arc;

use lissom_motion::Vector3;

use super::{Form, FormKind, Solid, Triangles};
use crate::geometry::curves::Spline;
use crate::geometry::surfaces::{HeightField, Mesh, Outline, Polygon};

/// A form of a kind, about as large as 1 m.
pub(crate) fn sample(kind: FormKind) -> Form {
    let axis = Vector3::z();
    let corners = [[-0.5, -0.4, -0.3], [0.6, -0.4, -0.3], [0.1, 0.7, -0.3], [0.0, 0.0, 0.6]];
    let hull = Mesh::hull(&corners.map(Vector3::from)).expect("a tetrahedron");
    match kind {
        FormKind::Plane => Form::HalfSpace,
        FormKind::Sphere => Form::Solid(Solid::Sphere(0.4)),
        FormKind::Capsule => Form::Solid(Solid::Capsule { radius: 0.2, length: 0.6, axis }),
        FormKind::Cylinder => Form::Solid(Solid::Tube { outer: 0.6, inner: 0.0, length: 0.8, axis }),
        FormKind::Tube => Form::Solid(Solid::Tube { outer: 0.6, inner: 0.3, length: 0.8, axis }),
        FormKind::Box => Form::Solid(Solid::Box([0.6, 1.0, 1.6])),
        FormKind::Ellipsoid => Form::Solid(Solid::Ellipsoid([0.3, 0.6, 0.2])),
        FormKind::Hull => Form::Hull(Arc::new(hull)),
        FormKind::Mesh => {
            let (points, triangles) = (hull.corners().collect(), hull.triangles().to_vec());
            Form::Mesh(Arc::new(Triangles { points, triangles }))
        }
        FormKind::Polygon => {
            let corners = [[-0.5, -0.4], [0.6, -0.5], [0.1, 0.1], [0.0, 0.7]];
            Form::Polygon(Arc::new(Polygon::new(&corners).expect("valid")))
        }
        FormKind::Outline => {
            let egg = |k: i32| {
                let (s, c) = (std::f64::consts::TAU * f64::from(k) / 60.0).sin_cos();
                [0.6 * c, 0.4 * s + 0.1 * c * c]
            };
            let curve = Spline::new(&(0..60).map(egg).collect::<Vec<_>>()).expect("valid");
            Form::Outline(Arc::new(Outline::new(curve)))
        }
        FormKind::HeightField => {
            let height = |i: i32, j: i32| 0.03 * (f64::from(i) * 0.7 + f64::from(j)).sin();
            let heights = (0..13).map(|j| (0..11).map(|i| height(i, j)).collect()).collect();
            Form::HeightField(Arc::new(HeightField::new(heights, [3.0, 3.0]).expect("valid")))
        }
    }
}
