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
mod tests {
    use super::*;

    fn line() -> Centerline {
        Centerline::new(vec![0.0, 0.2, 0.3, 0.5, 0.7, 0.9, 1.2, 1.4, 1.5]).expect("ascending")
    }

    fn place(node: usize) -> Vector3 {
        let s = line().knots[node];
        Vector3::new(s, (2.0 * s).sin(), (1.0 + s).ln())
    }

    #[test]
    fn polynomials_of_the_fourth_degree_are_met_exactly() {
        let line = line();
        let quartic = |s: f64| {
            [
                1.0 + 2.0 * s - 0.7 * s.powi(3) + 0.4 * s.powi(4),
                2.0 - 2.1 * s * s + 1.6 * s.powi(3),
                -4.2 * s + 4.8 * s * s,
                -4.2 + 9.6 * s,
            ]
        };
        for k in 0..=30 {
            let s = -0.05 + 1.6 * f64::from(k) / 30.0;
            let support = line.at(s);
            for derivative in 0..4 {
                let weights = &support.weights[derivative][..support.count];
                let values = weights.iter().enumerate();
                let sum: f64 = values.map(|(k, w)| w * quartic(line.knots[support.first + k])[0]).sum();
                assert!((sum - quartic(s)[derivative]).abs() < 1e-9, "{s} {derivative}: {sum}");
            }
        }
    }

    /// The curvature of a sine falls with the third power of the distance of the nodes, between nodes and at both ends.
    #[test]
    fn curvature_converges_with_the_third_power() {
        let miss = |count: usize| {
            let knots: Vec<f64> = (0..=count).map(|k| 2.0 * k as f64 / count as f64).collect();
            let line = Centerline::new(knots.clone()).expect("ascending");
            let sine = |node: usize| Vector3::new(knots[node].sin(), 0.0, 0.0);
            let misses = (0..=400).map(|k| 0.005 * f64::from(k));
            misses.map(|s| (line.at(s).sum(2, sine).x + s.sin()).abs()).fold(0.0, f64::max)
        };
        let [coarse, fine] = [16, 32].map(miss);
        assert!(fine < 3e-4 && coarse / fine > 7.0, "{coarse:e}, {fine:e}");
    }

    /// The line turns twice, so that several of its points are nearest within their surroundings: samples of every interval decide.
    #[test]
    fn the_nearest_position_of_a_winding_line_is_found_in_every_interval() {
        let knots: Vec<f64> = [0.0, 0.5, 1.1, 1.5, 2.2, 2.9, 3.3, 4.0].to_vec();
        let line = Centerline::new(knots.clone()).expect("ascending");
        let place = |node: usize| {
            let s: f64 = knots[node];
            Vector3::new((1.6 * s).sin(), 0.2 * s, 0.1 * (1.6 * s).cos())
        };
        for k in 0..=80 {
            let s = 0.05 * f64::from(k);
            let support = line.at(s);
            let [on_line, tangent] = [0, 1].map(|derivative| support.sum(derivative, place));
            let beside = tangent.cross(&Vector3::z()).normalize();
            let found = line.nearest(&(on_line + 0.01 * beside), place);
            assert!((found - s).abs() < 1e-9, "{found}, not {s}");
        }
    }

    /// A straight line is reproduced by two or more nodes, with its arc length and its tangent.
    #[test]
    fn straight_lines_of_two_and_more_nodes_are_met_exactly() {
        for knots in [vec![0.4, 1.7], vec![0.4, 1.0, 1.7], vec![0.4, 0.7, 1.1, 1.7]] {
            let line = Centerline::new(knots.clone()).expect("ascending");
            for s in [0.3, 0.4, 0.6, 1.05, 1.7, 1.9] {
                let support = line.at(s);
                let expected = [3.0 - 2.0 * s, -2.0, 0.0, 0.0];
                for (weights, expected) in support.weights.iter().zip(expected) {
                    let weights = weights[..support.count].iter().enumerate();
                    let sum: f64 = weights.map(|(k, w)| w * (3.0 - 2.0 * knots[support.first + k])).sum();
                    assert!((sum - expected).abs() < 1e-12, "{knots:?} {s}: {sum}, {expected}");
                }
            }
        }
    }

    #[test]
    fn place_tangent_and_curvature_go_on_across_nodes() {
        let line = line();
        for node in 1..line.knots.len() - 1 {
            let s = line.knots[node];
            let [before, after] = [line.within(node - 1, s), line.within(node, s)];
            for derivative in 0..3 {
                let jump = before.sum(derivative, place) - after.sum(derivative, place);
                assert!(jump.norm() < 1e-12, "{node} {derivative}: {jump}");
            }
        }
        for s in [-0.1, 0.1, 0.31, 0.69, 1.0, 1.3, 1.6] {
            let step = 1e-4;
            for derivative in 0..3 {
                let [a, b] = [s - step, s + step].map(|at| line.at(at).sum(derivative, place));
                let exact = line.at(s).sum(derivative + 1, place);
                assert!(((b - a) / (2.0 * step) - exact).norm() < 1e-5, "{s} {derivative}");
            }
        }
    }

    #[test]
    fn changes_are_differences_and_keep_their_digits() {
        let line = line();
        for (from, change) in [(0.1, 0.05), (0.1, 1.3), (1.45, -1.4), (0.3, 0.4), (-0.1, 1.8)] {
            let wanted = line.at(from + change).sum(0, place) - line.at(from).sum(0, place);
            let miss = (line.change(0, (from, change), place) - wanted).norm();
            assert!(miss < 1e-14, "{from} {change}: {miss:e}");
            let wanted = line.at(from + change).sum(1, place) - line.at(from).sum(1, place);
            let miss = (line.change(1, (from, change), place) - wanted).norm();
            assert!(miss < 1e-13, "{from} {change}: {miss:e}");
        }
        let tiny = line.change(0, (0.5, 1e-9), place);
        let tangent = line.at(0.5).sum(1, place);
        assert!((tiny / 1e-9 - tangent).norm() < 1e-8);
    }

    #[test]
    fn the_nearest_place_is_found() {
        let line = line();
        for s in [0.0, 0.2, 0.7, 1.1, 1.5] {
            let found = line.nearest(&line.at(s).sum(0, place), place);
            assert!((found - s).abs() < 1e-12, "{s}: {found}");
        }
        // Points near an arc, up to four fifths of its radius on the inner side.
        let on_arc = |node: usize| Vector3::new(line.knots[node].cos(), line.knots[node].sin(), 0.0);
        for (s, share) in [(0.2, 0.5), (0.5, 0.8), (0.9, 0.8), (1.1, -2.0)] {
            let [on_line, tangent, curvature] = [0, 1, 2].map(|order| line.at(s).sum(order, on_arc));
            let across = curvature - tangent * (curvature.dot(&tangent) / tangent.norm_squared());
            let found = line.nearest(&(on_line + share * across.normalize()), on_arc);
            assert!((found - s).abs() < 1e-10, "{s} {share}: {found}");
        }
        assert_eq!(Centerline::new(vec![0.0]), None);
        assert_eq!(Centerline::new(vec![0.0, 1.0, 1.0]), None);
    }
}
