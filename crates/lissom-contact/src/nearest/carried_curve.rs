//! Curves of parts that touch where they are nearest: lines through nodes of a beam, straight lines and points of bodies.
//!
//! Legend: P_k points that nodes carry, s parameter, w_k(s) weights, a and b ends of the interval of a line through nodes, ε overlap of
//! two intervals, χ(s) share of an interval, which falls to zero between the interval and the next: the shares of both are 1.
//!
//! ```text
//! x(s) = Σ w_k(s) P_k,      χ = ρ((s - a + ε)/(2ε)) ρ((b + ε - s)/(2ε)),      ρ(u) = 3u² - 2u³ between 0 and 1
//! ```

use std::sync::Arc;

use lissom_motion::Vector3;

use lissom_mechanics::joints::centerline::{Centerline, SUPPORT};
use lissom_mechanics::kinematics::NodeId;

/// ε over the length of the shorter of two intervals.
const OVERLAP: f64 = 1e-3;

/// A point that a node carries: the node, and the point in its axes [m].
pub type CarriedPoint = (NodeId, Vector3);

/// A curve that nodes carry.
#[derive(Clone, Debug)]
pub struct CarriedCurve {
    /// P_k, at most [`SUPPORT`].
    points: Vec<CarriedPoint>,
    form: Form,
}

#[derive(Clone, Debug)]
enum Form {
    /// An interval of a line through nodes; the overlap at both ends, zero at an end of the line.
    Interval { line: Arc<Centerline>, interval: usize, overlaps: [f64; 2] },
    /// From the first point to the second.
    Straight,
    /// A point with constant weights.
    Point([f64; SUPPORT]),
}

/// Weights at a parameter and their first two derivatives.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Weights(pub(crate) [[f64; SUPPORT]; 3]);

impl CarriedCurve {
    /// A point of a body.
    pub fn of_point(point: CarriedPoint) -> Self {
        let mut weights = [0.0; SUPPORT];
        weights[0] = 1.0;
        Self { points: vec![point], form: Form::Point(weights) }
    }

    /// The straight line between two points of a body.
    pub fn between(ends: [CarriedPoint; 2]) -> Self {
        Self { points: ends.to_vec(), form: Form::Straight }
    }

    /// An interval of a line through nodes, which are given for the whole line.
    pub fn of_interval(line: &Arc<Centerline>, interval: usize, points: &[CarriedPoint]) -> Self {
        let (first, count) = line.nodes_of(interval);
        let length = |k: usize| line.ends(k)[1] - line.ends(k)[0];
        let overlap = |other: usize| OVERLAP * length(interval).min(length(other));
        let overlaps = [
            if interval > 0 { overlap(interval - 1) } else { 0.0 },
            if interval + 1 < line.intervals() { overlap(interval + 1) } else { 0.0 },
        ];
        Self {
            points: points[first..first + count].to_vec(),
            form: Form::Interval { line: line.clone(), interval, overlaps },
        }
    }

    /// The point at the arc length `s` of a line through nodes.
    pub fn on_line(line: &Centerline, s: f64, points: &[CarriedPoint]) -> Self {
        let support = line.at(s);
        Self {
            points: points[support.first..support.first + support.count].to_vec(),
            form: Form::Point(support.weights[0]),
        }
    }

    /// P_k.
    pub(crate) fn points(&self) -> &[CarriedPoint] {
        &self.points
    }

    /// Smallest and largest parameter; equal for a point.
    pub(crate) fn ends(&self) -> [f64; 2] {
        match &self.form {
            Form::Interval { line, interval, overlaps } => {
                let [a, b] = line.ends(*interval);
                [a - overlaps[0], b + overlaps[1]]
            }
            Form::Straight => [0.0, 1.0],
            Form::Point(_) => [0.0, 0.0],
        }
    }

    /// Indices of the points at its ends.
    pub(crate) fn end_points(&self) -> Option<[usize; 2]> {
        match &self.form {
            Form::Interval { line, interval, .. } => {
                let first = interval - line.nodes_of(*interval).0;
                Some([first, first + 1])
            }
            Form::Straight => Some([0, 1]),
            Form::Point(_) => None,
        }
    }

    /// w_k and its derivatives at s.
    pub(crate) fn weights(&self, s: f64) -> Weights {
        let mut own = Weights::default();
        match &self.form {
            Form::Interval { line, interval, .. } => {
                own.0.copy_from_slice(&line.within(*interval, s).weights[..3]);
            }
            Form::Straight => {
                (own.0[0][0], own.0[0][1]) = (1.0 - s, s);
                (own.0[1][0], own.0[1][1]) = (-1.0, 1.0);
            }
            Form::Point(weights) => own.0[0] = *weights,
        }
        own
    }

    /// χ and χ' at s.
    pub(crate) fn share(&self, s: f64) -> [f64; 2] {
        let Form::Interval { line, interval, overlaps } = &self.form else { return [1.0, 0.0] };
        let [a, b] = line.ends(*interval);
        let ramp = |distance: f64, overlap: f64, sign: f64| {
            if overlap == 0.0 {
                return [1.0, 0.0];
            }
            let u = (0.5 * (distance / overlap + 1.0)).clamp(0.0, 1.0);
            [u * u * (3.0 - 2.0 * u), sign * 6.0 * u * (1.0 - u) * 0.5 / overlap]
        };
        let [[before, before_by], [after, after_by]] =
            [ramp(s - a, overlaps[0], 1.0), ramp(b - s, overlaps[1], -1.0)];
        [before * after, before_by * after + before * after_by]
    }
}
