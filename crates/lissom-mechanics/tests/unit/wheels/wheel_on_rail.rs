//! Tests of `wheels::wheel_on_rail`, a module of it.

use std::f64::consts::TAU;
use std::sync::Arc;

use lissom_motion::Rotation;

use super::*;
use crate::registry::TimeFunction;

/// A wave with a drift, of amplitude and length [m] and slope: several positions of a wheel are close to its rail.
#[derive(Debug)]
struct Waves(f64, f64, f64);

impl TimeFunction for Waves {
    fn value(&self, y: f64) -> f64 {
        self.2 * y + self.0 * (TAU * y / self.1).cos()
    }
    fn first_derivative(&self, y: f64) -> f64 {
        self.2 - self.0 * TAU / self.1 * (TAU * y / self.1).sin()
    }
    fn second_derivative(&self, y: f64) -> f64 {
        -self.0 * (TAU / self.1).powi(2) * (TAU * y / self.1).cos()
    }
}

/// -y²/(2 R).
#[derive(Debug)]
struct Head(f64);

impl TimeFunction for Head {
    fn value(&self, y: f64) -> f64 {
        -0.5 * y * y / self.0
    }
    fn first_derivative(&self, y: f64) -> f64 {
        -y / self.0
    }
    fn second_derivative(&self, _: f64) -> f64 {
        -1.0 / self.0
    }
}

/// A waved wheel on a rounded rail, on both sides, rolled and shifted: of all its positions the position of contact is
/// closest to the rail.
#[test]
fn given_profiles_touch_where_they_are_nearest() {
    let mut places = Vec::new();
    // Parabolas, and a circle of 1 m whose tangent at u = 0 rises by 0.02 rad.
    let circle = RailProfile::Circle { radius: 1.0, cant: 0.02 };
    let over_circle = |x: f64, y: f64| (x - 0.02_f64.sin()).hypot(y + 0.02_f64.cos()) - 1.0;
    for (side, drift, is_circle) in [
        (1.0, 0.023, false),
        (1.0, -0.023, false),
        (-1.0, 0.023, false),
        (-1.0, -0.023, false),
        (1.0, 0.023, true),
        (-1.0, -0.023, true),
    ] {
        let parabola = RailProfile::Given(Arc::new(Head(1.0)), 0.1);
        let contact = RailContact {
            axis: Vector3::x(),
            side,
            offset: 0.1,
            radius: 0.5,
            wheel: WheelProfile::Given(Arc::new(Waves(4e-4, 0.02, drift)), 0.1),
            rail: if is_circle { circle.clone() } else { parabola },
            tread: [-0.09, 0.07],
        };
        for (roll, shift) in [(0.0, 0.0), (0.012, 0.003), (-0.018, -0.004)] {
            let turn = Rotation::exponential(&Vector3::new(0.0, 0.0, roll)).matrix();
            let position = Vector3::new(shift - 0.1, side * 0.503, 0.2);
            let pose = Pose::new(&turn, &position);
            let [low, high] = contact.tread;
            let cleared = (0..=100_000).map(|k| {
                let along = low + (high - low) * f64::from(k) / 1e5;
                let radius = 0.5 + Waves(4e-4, 0.02, drift).value(along);
                let place = position + turn * Vector3::new(0.1 + along, -side * radius, 0.0);
                let (x, y) = (place.x, side * place.y);
                (if is_circle { over_circle(x, y) } else { y + 0.5 * x * x }, along)
            });
            let (_, wanted) = cleared.min_by(|one, other| one.0.total_cmp(&other.0)).expect("there are some");
            let Found { place, is_common_normal } = contact.place(&pose);
            assert!(is_common_normal, "{side} {drift} {roll}");
            places.push((place.along, wanted));
        }
    }
    for (found, wanted) in &places {
        assert!((found - wanted).abs() < 5e-5, "{found}, nearest {wanted}");
    }
    // Several positions were found.
    let is_there = |low: f64, high: f64| places.iter().any(|(found, _)| (low..high).contains(found));
    assert!(is_there(-0.05, -0.03) && is_there(-0.01, 0.01) && is_there(0.05, 0.07), "{places:?}");
}

/// K and E by Simpson's rule.
fn integrals(ratio: f64) -> [f64; 2] {
    let parts = 2000;
    let square = |angle: f64| (1.0 - (1.0 - ratio * ratio) * angle.sin().powi(2)).sqrt();
    let width = 0.25 * TAU / parts as f64;
    let simpson = |of: &dyn Fn(f64) -> f64| {
        let part = |k: usize| {
            let [a, b] = [k, k + 1].map(|k| width * k as f64);
            width / 6.0 * (of(a) + 4.0 * of(0.5 * (a + b)) + of(b))
        };
        (0..parts).map(part).sum::<f64>()
    };
    [simpson(&|angle| square(angle).recip()), simpson(&square)]
}

/// Curvatures computed from a known ellipse reproduce it, whichever of them is larger.
#[test]
fn hertzs_ellipse_has_the_curvatures_that_it_belongs_to() {
    for ratio in [0.05, 0.3, 0.711_521_8, 0.99] {
        let [first, second] = integrals(ratio);
        let curvatures = (second / (ratio * ratio) - first) / (first - second);
        for found in [hertz_ellipse(2.0 * curvatures, 2.0), hertz_ellipse(0.5, 0.5 * curvatures)] {
            let error = (found[0] / second - 1.0).abs().max((found[1] / ratio - 1.0).abs());
            assert!(error < 1e-9, "{ratio}: {found:?}, E {second}");
        }
    }
    assert_eq!(hertz_ellipse(3.0, 3.0), [0.25 * TAU, 1.0]);
}

/// A cone on a circle needs no iteration: both normals coincide at once, with zero distance along the tangent.
#[test]
fn a_cone_touches_a_circle_at_the_foot_of_its_centre() {
    for (side, cone_angle, cant) in [(1.0, 0.1, 0.1), (1.0, 0.4, 0.2), (-1.0, -0.3, 0.0)] {
        let contact = RailContact {
            axis: Vector3::new(0.99, 0.1, -0.05).normalize(),
            side,
            offset: 0.7,
            radius: 0.4,
            wheel: WheelProfile::Cone(-f64::tan(cone_angle)),
            rail: RailProfile::Circle { radius: 0.3, cant },
            tread: [-0.2, 0.2],
        };
        for turn in [Vector3::zeros(), Vector3::new(0.3, 0.1, -0.05), Vector3::new(-0.2, -0.15, 0.1)] {
            let turn = Rotation::exponential(&turn).matrix();
            let pose = Pose::new(&turn, &Vector3::new(-0.7, side * 0.45, 0.1));
            let (away, _) = contact.equations(&pose, &contact.foot(&pose));
            assert!(away.iter().all(|value| value.abs() < 1e-14), "{side} {cone_angle} {cant}: {away:?}");
        }
    }
}
