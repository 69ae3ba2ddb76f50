//! Tests of `forms::solid`, a module of it.

use super::*;

/// Sums over small cubes.
fn summed(is_inside: impl Fn(&Vector3) -> bool, size: f64) -> (f64, Vector3) {
    let count: i32 = 80;
    let width = size / f64::from(count);
    let (mut volume, mut moments) = (0.0, Vector3::zeros());
    for index in 0..count.pow(3) {
        let of = |k: i32| (f64::from(index / count.pow(k as u32) % count) + 0.5) * width - 0.5 * size;
        let x = Vector3::new(of(0), of(1), of(2));
        if is_inside(&x) {
            volume += width.powi(3);
            let square = x.component_mul(&x);
            moments += width.powi(3) * (Vector3::repeat(square.sum()) - square);
        }
    }
    (volume, moments / volume)
}

#[test]
fn volumes_and_moments_are_those_of_many_small_cubes() {
    let across = |x: &Vector3| x.y.hypot(x.z);
    let tube = Solid::Tube { outer: 0.5, inner: 0.2, length: 0.8, axis: Vector3::x() };
    let sides = [0.4, 0.7, 1.0];
    let rod = Solid::Capsule { radius: 0.25, length: 0.5, axis: Vector3::x() };
    let beyond = |x: &Vector3| (x - Vector3::new(x.x.clamp(-0.25, 0.25), 0.0, 0.0)).norm();
    for (solid, (volume, moments)) in [
        (rod, summed(|x| beyond(x) < 0.25, 1.0)),
        (Solid::Sphere(0.5), summed(|x| x.norm() < 0.5, 1.0)),
        (tube, summed(|x| x.x.abs() < 0.4 && (0.2..0.5).contains(&across(x)), 1.0)),
        (
            Solid::Ellipsoid([0.5, 0.3, 0.4]),
            summed(|x| (x.x / 0.5).powi(2) + (x.y / 0.3).powi(2) + (x.z / 0.4).powi(2) < 1.0, 1.0),
        ),
        (Solid::Box(sides), summed(|x| (0..3).all(|k| x[k].abs() < 0.5 * sides[k]), 1.0)),
    ] {
        assert!((solid.volume() - volume).abs() < 1e-2 * volume, "{solid:?} {volume}");
        let found = solid.inertia().diagonal();
        assert!((found - moments).norm() < 1e-2 * moments.norm(), "{solid:?} {moments}");
    }
    // About an oblique axis the moments of inertia are turned.
    let turn = lissom_motion::Rotation::exponential(&Vector3::new(0.3, -0.7, 1.1));
    let oblique = Solid::Tube { outer: 0.5, inner: 0.2, length: 0.8, axis: turn.apply(&Vector3::x()) };
    let turned = turn.matrix() * tube.inertia() * turn.matrix().transpose();
    assert!((oblique.inertia() - turned).norm() < 1e-15);
}
