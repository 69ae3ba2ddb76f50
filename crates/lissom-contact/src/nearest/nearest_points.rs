//! The nearest points of two curves.
//!
//! Legend: s, t parameters of the tip's curve x and the base's curve y, D = x - y.
//!
//! ```text
//! ½ |D|² is least:   D·x' = 0,   D·y' = 0,   or s or t at an end from which it falls outwards
//! ```

use lissom_motion::Vector3;

use super::carried_curve::{CarriedCurve, Weights};
use crate::least_distance::{Least, Square, least};
use lissom_mechanics::joints::centerline::SUPPORT;

/// Smaller part of an interval of the golden section.
const GOLDEN: f64 = 0.381_966_011_250_105_1;

/// A point of a curve with its derivatives by the parameter.
#[derive(Clone, Copy, Debug)]
pub(super) struct OnCurve {
    pub(super) parameter: f64,
    pub(super) weights: Weights,
    /// x, x' and x''.
    pub(super) place: [Vector3; 3],
}

/// The nearest points of tip and base, and which parameters are between the ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nearest {
    pub(super) on: [OnCurve; 2],
    pub(super) is_free: [bool; 2],
}

/// A curve with the present positions of its points.
pub(super) struct Placed<'c> {
    pub(super) curve: &'c CarriedCurve,
    pub(super) points: [Vector3; SUPPORT],
}

impl Placed<'_> {
    fn at(&self, parameter: f64) -> OnCurve {
        let weights = self.curve.weights(parameter);
        let sum = |order: usize| -> Vector3 {
            let count = self.curve.points().len();
            weights.0[order].iter().zip(&self.points[..count]).map(|(weight, point)| *weight * point).sum()
        };
        OnCurve { parameter, weights, place: [0, 1, 2].map(sum) }
    }
}

fn square([tip, base]: &[OnCurve; 2]) -> Square {
    let d = tip.place[0] - base.place[0];
    let ([_, x1, x2], [_, y1, y2]) = (tip.place, base.place);
    let mixed = -x1.dot(&y1);
    let straight = [[x1.norm_squared(), mixed], [mixed, y1.norm_squared()]];
    let bend = [[straight[0][0] + d.dot(&x2), mixed], [mixed, straight[1][1] - d.dot(&y2)]];
    Square { value: 0.5 * d.norm_squared(), slope: [d.dot(&x1), -d.dot(&y1)], bend, straight }
}

/// The nearest points of two curves.
pub(super) fn nearest(curves: &[Placed<'_>; 2]) -> Nearest {
    let ends = [0, 1].map(|k| curves[k].curve.ends());
    let both = |parameters: [f64; 2]| [0, 1].map(|k| curves[k].at(parameters[k]));
    let Least { parameters, is_free } = least(ends, |parameters| square(&both(parameters)));
    Nearest { on: both(parameters), is_free }
}

/// The distance between two straight lines from their ends: that of the tip to the origin and `to`.
pub(super) fn chord_distance([from, to]: [Vector3; 2], base_end: &Vector3) -> f64 {
    // Where the distance of a point of the tip from the base is least: it is a convex function.
    let distance = |s: f64| {
        let x = from + s * (to - from);
        let square = base_end.norm_squared();
        let t = if square > 0.0 { (x.dot(base_end) / square).clamp(0.0, 1.0) } else { 0.0 };
        (x - t * base_end).norm()
    };
    let (mut low, mut high) = (0.0, 1.0);
    let (mut a, mut b) = (GOLDEN, 1.0 - GOLDEN);
    let (mut of_a, mut of_b) = (distance(a), distance(b));
    // To 1e-8 of the length of the line.
    for _ in 0..38 {
        if of_a < of_b {
            (high, b, of_b) = (b, a, of_a);
            a = low + GOLDEN * (high - low);
            of_a = distance(a);
        } else {
            (low, a, of_a) = (a, b, of_b);
            b = high - GOLDEN * (high - low);
            of_b = distance(b);
        }
    }
    of_a.min(of_b).min(distance(0.0)).min(distance(1.0))
}
