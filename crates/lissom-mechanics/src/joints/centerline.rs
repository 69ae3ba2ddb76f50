//! A smooth line through the nodes of a beam, without kinks or jumps of curvature between elements.
//!
//! Legend: s arc length of the undeformed beam, s_k that of node k, x_k its position, Q_k the polynomial of the fourth degree through the
//! nodes k - 2 to k + 2, u = (s - s_k)/(s_{k+1} - s_k).
//!
//! ```text
//! x(s) = (1 - b) Q_k + b Q_{k+1} = Σ_k w_k(s) x_k,      b = 3u² - 2u³,      Σ w_k = 1,      Σ w_k s_k = s
//! ```
//!
//! Both polynomials pass through both nodes and b' vanishes there: position, tangent and curvature are continuous [cf. Overhauser
//! 1968, who blends parabolas with b = u, and Bauchau 2000 on sliding joints]. The curvature of a smooth curve is met with the third
//! power of the node distance (parabolas: with the first), and with it the force that guides a moving point. Near the
//! ends the polynomials are those of the five outermost nodes; a beam of fewer nodes has one polynomial through all of them.

use lissom_motion::Vector3;
use std::ops::Range;

/// Maximum number of nodes on which a position between two of them depends.
pub const SUPPORT: usize = 6;

/// Number of nodes that determine one polynomial.
const STENCIL: usize = 5;

/// Arc lengths of the nodes along a beam or a chain of beams.
#[derive(Clone, Debug, PartialEq)]
pub struct Centerline {
    knots: Vec<f64>,
}

/// Weights of nodes at a position, and their first three derivatives with respect to arc length.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Support {
    /// The first of the nodes.
    pub first: usize,
    /// How many there are.
    pub count: usize,
    /// By derivative, then by node.
    pub weights: [[f64; SUPPORT]; 4],
}

impl Support {
    /// Σ w_k x_k of a derivative, from positions by the index of the node.
    pub fn sum(&self, derivative: usize, place: impl Fn(usize) -> Vector3) -> Vector3 {
        (0..self.count).map(|k| self.weights[derivative][k] * place(self.first + k)).sum()
    }
}

impl Centerline {
    /// Through nodes at these arc lengths, ascending; none for fewer than two.
    pub fn new(knots: Vec<f64>) -> Option<Self> {
        let ascends = knots.windows(2).all(|pair| pair[1] > pair[0]);
        (knots.len() > 1 && ascends).then_some(Self { knots })
    }

    /// Total arc length [m].
    pub fn length(&self) -> f64 {
        self.knots[self.knots.len() - 1]
    }

    /// Number of intervals between nodes.
    pub fn intervals(&self) -> usize {
        self.knots.len() - 1
    }

    /// Arc lengths of both ends of an interval [m].
    pub fn ends(&self, interval: usize) -> [f64; 2] {
        [self.knots[interval], self.knots[interval + 1]]
    }

    /// The interval that contains `s`; beyond the ends the first or the last.
    pub fn interval(&self, s: f64) -> usize {
        let inner = &self.knots[1..self.knots.len() - 1];
        inner.partition_point(|&knot| knot <= s)
    }

    /// The first node of the polynomial about a node, and their number.
    fn stencil(&self, middle: usize) -> (usize, usize) {
        let count = self.knots.len().min(STENCIL);
        (middle.saturating_sub(STENCIL / 2).min(self.knots.len() - count), count)
    }

    /// The first node on which positions in an interval depend, and their number.
    pub fn nodes_of(&self, interval: usize) -> (usize, usize) {
        let (first, _) = self.stencil(interval);
        let (start, count) = self.stencil(interval + 1);
        (first, start + count - first)
    }

    /// Weights at `s`; the polynomials are extrapolated beyond the ends.
    pub fn at(&self, s: f64) -> Support {
        self.within(self.interval(s), s)
    }

    /// Weights at `s` by the formula of an interval.
    pub fn within(&self, interval: usize, s: f64) -> Support {
        let (first, count) = self.nodes_of(interval);
        let mut support = Support { first, count, ..Support::default() };
        let length = self.knots[interval + 1] - self.knots[interval];
        let u = (s - self.knots[interval]) / length;
        let blend = [
            u * u * (3.0 - 2.0 * u),
            6.0 * u * (1.0 - u) / length,
            (6.0 - 12.0 * u) / length.powi(2),
            -12.0 / length.powi(3),
        ];
        let rest = [1.0 - blend[0], -blend[1], -blend[2], -blend[3]];
        let same = self.stencil(interval) == self.stencil(interval + 1);
        let shares: &[_] = if same {
            &[(interval, [1.0, 0.0, 0.0, 0.0])]
        } else {
            &[(interval, rest), (interval + 1, blend)]
        };
        for &(middle, share) in shares {
            let (start, nodes) = self.stencil(middle);
            for own in start..start + nodes {
                let weights = product(share, self.lagrange(start..start + nodes, own, s));
                for (sum, weight) in support.weights.iter_mut().zip(weights) {
                    sum[own - first] += weight;
                }
            }
        }
        support
    }

    /// The polynomial that is one at a node and zero at the others of a stencil, and its first three derivatives.
    fn lagrange(&self, stencil: Range<usize>, own: usize, s: f64) -> [f64; 4] {
        stencil.filter(|&other| other != own).fold([1.0, 0.0, 0.0, 0.0], |value, other| {
            let inverse = 1.0 / (self.knots[own] - self.knots[other]);
            product(value, [(s - self.knots[other]) * inverse, inverse, 0.0, 0.0])
        })
    }

    /// x(from + change) - x(from) for constant positions, or the same for a `derivative` of x, without cancellation: the integral
    /// of the next derivative over each interval, which is of the sixth degree at most.
    pub fn change(
        &self,
        derivative: usize,
        (from, change): (f64, f64),
        place: impl Fn(usize) -> Vector3,
    ) -> Vector3 {
        // Nodes and weights of four-point Gauss quadrature.
        const OFFSETS: [f64; 2] = [0.339_981_043_584_856_26, 0.861_136_311_594_052_6];
        const WEIGHTS: [f64; 2] = [0.326_072_577_431_273_07, 0.173_927_422_568_726_93];
        let over = |interval: usize, begin: f64, width: f64| {
            let mean = OFFSETS.into_iter().zip(WEIGHTS).flat_map(|(x, weight)| [(-x, weight), (x, weight)]);
            let mean = mean.map(|(x, weight)| {
                let support = self.within(interval, begin + 0.5 * (1.0 + x) * width);
                let origin = place(support.first);
                weight * support.sum(derivative + 1, |node| place(node) - origin)
            });
            width * mean.sum::<Vector3>()
        };
        let to = from + change;
        let (first, last) = (self.interval(from), self.interval(to));
        if first == last {
            return over(first, from, change);
        }
        let (mut sum, mut begin) = (Vector3::zeros(), from);
        if first < last {
            for interval in first..=last {
                let end = if interval == last { to } else { self.knots[interval + 1] };
                sum += over(interval, begin, end - begin);
                begin = end;
            }
        } else {
            for interval in (last..=first).rev() {
                let end = if interval == last { to } else { self.knots[interval] };
                sum += over(interval, begin, end - begin);
                begin = end;
            }
        }
        sum
    }

    /// Arc length at which the line through these positions is nearest to a point: by sampling, then by Newton's
    /// method.
    pub fn nearest(&self, point: &Vector3, place: impl Fn(usize) -> Vector3) -> f64 {
        const PER_INTERVAL: usize = 16;
        let steps = PER_INTERVAL * self.intervals();
        let at = |s: f64| self.at(s).sum(0, &place) - point;
        let trials = (0..=steps).map(|k| {
            let (interval, part) =
                ((k / PER_INTERVAL).min(self.intervals() - 1), k as f64 / PER_INTERVAL as f64);
            let [a, b] = [self.knots[interval], self.knots[interval + 1]];
            a + (part - interval as f64) * (b - a)
        });
        let mut best =
            trials.min_by(|a, b| at(*a).norm_squared().total_cmp(&at(*b).norm_squared())).unwrap_or(0.0);
        for _ in 0..20 {
            let support = self.at(best);
            let [away, tangent, curvature] = [0, 1, 2].map(|derivative| support.sum(derivative, &place));
            let away = away - point;
            let slope = tangent.norm_squared() + away.dot(&curvature);
            let size = if slope > 0.0 { slope } else { tangent.norm_squared() };
            if size <= 0.0 {
                break;
            }
            best = (best - away.dot(&tangent) / size).clamp(0.0, self.length());
        }
        best
    }
}

/// A product of two functions and its first three derivatives, from those of both.
fn product(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    [
        a[0] * b[0],
        a[0] * b[1] + a[1] * b[0],
        a[0] * b[2] + 2.0 * a[1] * b[1] + a[2] * b[0],
        a[0] * b[3] + 3.0 * (a[1] * b[2] + a[2] * b[1]) + a[3] * b[0],
    ]
}

#[cfg(test)]
#[path = "../../tests/unit/joints/centerline.rs"]
mod tests;
