//! Tests of `wheels::wheel_on_plane`, a module of it.

use std::f64::consts::TAU;

use lissom_motion::Rotation;

use super::*;

/// Number of spheres that represent a rim, at equal angles about the axis.
const SPHERES: usize = 20_000;

/// Smallest height of the rim over the plane, and its lowest position relative to the wheel's centre, in the tip's
/// axes.
fn lowest(contact: &Contact, rotation: &Matrix3, position: &Vector3) -> (f64, Vector3) {
    let up = contact.side * rotation.row(2).transpose();
    let across = contact.axis.cross(&up).normalize();
    let along = across.cross(&contact.axis);
    let spheres = (0..SPHERES).map(|k| {
        let (sine, cosine) = (TAU * k as f64 / SPHERES as f64).sin_cos();
        let place = contact.radius * (cosine * across + sine * along) - contact.rim * up;
        (contact.side * position.z + up.dot(&place), place)
    });
    spheres.min_by(|one, other| one.0.total_cmp(&other.0)).expect("there are some")
}

/// A leaning wheel, on both sides of the plane: gap, its derivative, and sliding velocities are those of the lowest point.
#[test]
fn the_gap_is_that_of_the_lowest_point_of_the_rim() {
    let turn = Rotation::exponential(&Vector3::new(0.3, -0.2, 0.5)).matrix();
    let axis = Vector3::new(0.2, 0.9, -0.4).normalize();
    for (side, radius, rim) in [(1.0, 0.4, 0.0), (1.0, 0.4, 0.15), (-1.0, 0.3, 0.1)] {
        let contact = Contact { axis, side, radius, rim, friction: f64::INFINITY, creep: 0.0 };
        let position = Vector3::new(0.1, -0.3, side * 0.7);
        let (gap, by) = contact.gap(&turn, &position);
        let (wanted, place) = lowest(&contact, &turn, &position);
        assert!((gap - wanted).abs() < 1e-7 && gap > 0.1, "{side} {rim}: {gap}, lowest {wanted}");
        for k in 0..6 {
            let moved = |step: f64| {
                let mut change = [Vector3::zeros(); 2];
                change[k / 3][k % 3] = step;
                let rotation = turn * Rotation::exponential(&change[1]).matrix();
                contact.gap(&rotation, &(position + turn * change[0])).0
            };
            let slope = (moved(1e-5) - moved(-1e-5)) / 2e-5;
            assert!((by[k] - slope).abs() < 1e-9, "{side} {rim}, {k}: {} and {slope}", by[k]);
        }
        let (linear, angular) = (Vector3::new(0.5, -0.7, 0.2), Vector3::new(1.1, 0.6, -0.8));
        let there = turn * (linear + angular.cross(&place));
        for (k, row) in contact.rows(&turn, 0.0).iter().enumerate() {
            let sliding = row.dot(&screw(&linear, &angular));
            assert!((sliding - there[k]).abs() < 1e-3, "{side} {rim}, {k}: {sliding} and {}", there[k]);
        }
    }
}
