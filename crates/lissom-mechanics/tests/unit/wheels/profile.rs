//! Tests of `wheels::profile`, a module of it.

use std::sync::Arc;

use super::*;
use crate::registry::TimeFunction;

/// -y²/(2 R) + y/50.
#[derive(Debug)]
struct Head(f64);

impl TimeFunction for Head {
    fn value(&self, y: f64) -> f64 {
        0.02 * y - 0.5 * y * y / self.0
    }
    fn first_derivative(&self, y: f64) -> f64 {
        0.02 - y / self.0
    }
    fn second_derivative(&self, _: f64) -> f64 {
        -1.0 / self.0
    }
}

/// A point at a given distance along the normal has that clearance, negative if it is inside.
#[test]
fn clearances_are_distances_along_the_normal() {
    let circle = RailProfile::Circle { radius: 0.3, cant: 0.05 };
    let given = RailProfile::Given(Arc::new(Head(0.3)), 0.05);
    for (rail, error) in [(circle, 1e-14), (given, 2e-6)] {
        for place in [-0.02, 0.0, 0.015] {
            for off in [1e-3, 0.0, -1e-3] {
                let ([x, y], [across, up]) = (rail.point(place), rail.normal(place));
                let (clearance, under) = rail.clearance([x + off * across, y + off * up]);
                assert!((clearance - off).abs() < error, "{rail:?} {place} {off}: {clearance}");
                assert!((under - place).abs() < 1e-4, "{rail:?} {place} {off}: {under}");
            }
        }
    }
}
