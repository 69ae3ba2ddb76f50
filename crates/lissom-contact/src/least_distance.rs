//! The smallest distance over two bounded parameters: of two curves, or of a point from a surface.
//!
//! Legend: D distance vector, p parameters.
//!
//! ```text
//! ½ |D|² is least:   ∂(½ |D|²)/∂p = 0,   or p at an end where it falls outwards
//! ```

use lissom_mechanics::round_off;

/// Iterations after which the nearest points are known to all digits.
const MAX_ITERATIONS: usize = 60;
/// Halvings of a step that does not approach.
const MAX_HALVINGS: usize = 30;
/// Curves are parallel, and their parameters not free, where the determinant of the second derivatives is below this fraction of the
/// product of its diagonal.
pub(super) const PARALLEL: f64 = 1e-10;

/// D·D/2, its gradient, and its second derivatives.
pub(super) struct Square {
    pub(super) value: f64,
    pub(super) slope: [f64; 2],
    pub(super) bend: [[f64; 2]; 2],
    /// The second derivatives without curvature, never negative.
    pub(super) straight: [[f64; 2]; 2],
}

/// Parameters of the smallest distance, and which of them are between their ends.
pub(super) struct Least {
    pub(super) parameters: [f64; 2],
    pub(super) is_free: [bool; 2],
}

/// The solution of a symmetric system of the free parameters; none if it is not positive definite.
fn solved(matrix: &[[f64; 2]; 2], slope: [f64; 2], is_free: [bool; 2]) -> Option<[f64; 2]> {
    let [[a, b], [_, d]] = *matrix;
    match is_free {
        [true, true] => {
            let determinant = a * d - b * b;
            (a > 0.0 && determinant > PARALLEL * a * d).then(|| {
                [(b * slope[1] - d * slope[0]) / determinant, (b * slope[0] - a * slope[1]) / determinant]
            })
        }
        [true, false] => (a > 0.0).then(|| [-slope[0] / a, 0.0]),
        [false, true] => (d > 0.0).then(|| [0.0, -slope[1] / d]),
        [false, false] => Some([0.0; 2]),
    }
}

/// The smallest distance between these ends of both parameters, from their middle on.
pub(super) fn least(ends: [[f64; 2]; 2], square: impl Fn([f64; 2]) -> Square) -> Least {
    let clamped =
        |parameters: [f64; 2]| [0, 1].map(|k: usize| f64::clamp(parameters[k], ends[k][0], ends[k][1]));
    let mut here = ends.map(|[low, high]| 0.5 * (low + high));
    let mut at = square(here);
    let mut is_free = [false; 2];
    for _ in 0..MAX_ITERATIONS {
        is_free = [0, 1].map(|k| {
            let [low, high] = ends[k];
            low < high && !(here[k] <= low && at.slope[k] >= 0.0) && !(here[k] >= high && at.slope[k] <= 0.0)
        });
        // Of parallel lines one parameter after the other.
        let step = solved(&at.bend, at.slope, is_free)
            .or_else(|| solved(&at.straight, at.slope, is_free))
            .or_else(|| solved(&at.straight, at.slope, [is_free[0], false]))
            .unwrap_or([0.0; 2]);
        let mut share = 1.0;
        let mut next = clamped([here[0] + step[0], here[1] + step[1]]);
        let mut there = square(next);
        for _ in 0..MAX_HALVINGS {
            if there.value <= at.value * (1.0 + round_off::SQUARED_DISTANCE) {
                break;
            }
            share *= 0.5;
            next = clamped([here[0] + share * step[0], here[1] + share * step[1]]);
            there = square(next);
        }
        let changes = [0, 1].map(|k| (next[k] - here[k]).abs());
        let is_small = |k: usize| {
            changes[k] <= round_off::CURVE_PARAMETER * (ends[k][1] - ends[k][0] + ends[k][1].abs())
        };
        if is_small(0) && is_small(1) {
            break;
        }
        (here, at) = (next, there);
    }
    Least { parameters: here, is_free }
}
