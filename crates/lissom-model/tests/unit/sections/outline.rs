//! Tests of `sections::outline`, a module of it.

use lissom_motion::{Matrix3, Vector3};

use super::super::mass_matrix;
use super::*;

#[test]
fn an_ellipse_comes_back_from_its_mass() {
    let (a, b, mass, center) = (0.02_f64, 0.05_f64, 3.0, [0.01, -0.03]);
    let inertia = Vector3::new(a * a + b * b, b * b, a * a) * (mass / 4.0);
    let mass = mass_matrix(mass, &Matrix3::from_diagonal(&inertia), center);
    let Outline::Ellipse { width, height, center: found } = Outline::of_mass(&mass) else {
        panic!("sections given by numbers are drawn as ellipses")
    };
    assert!((width - a).abs() < 1e-12 && (height - b).abs() < 1e-12, "{width} {height}");
    assert!((found[0] - center[0]).abs() < 1e-14 && (found[1] - center[1]).abs() < 1e-14);
}
