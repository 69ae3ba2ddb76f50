//! Natural strains of a shell element in a configuration, over one number or several lanes.
//!
//! Legend: x positions, d = t₃ directors, t₁, t₂ the other vectors of the nodes' triads; x_r … d_s mean derivatives; an edge goes from
//! node I to node J, c = x_J - x_I; `,1` and `,2` derivatives along the local axes at a Gauss point.
//!
//! ```text
//! membrane   c·c/8 at four edges,    x_r·x_s/2
//! bending    g c·(d_J - d_I)/4,      (x_r·d_s + x_s·d_r)/2,     g = 1 + q/24 + 3q²/640 + 5q³/7168,   q = |d_J - d_I|²
//! shear      c·(d_I + d_J)/4
//! drilling   t₁·x,2 - t₂·x,1 at four Gauss points
//! ```
//!
//! all without their values in the stress-free state. g makes the curvature of an edge that is bent to an arc exact: it is half the angle
//! over its sine. All strains depend on differences of positions and on vectors that the nodes carry, so that a rigid motion
//! changes nothing.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Pose, Real, Screw, Triple};

use super::constants::{Constants, SHAPES};
use super::quadrilateral::{EDGES, NODES, POINTS, STRAINS};

/// ∂x_r/∂x_I and ∂x_s/∂x_I.
pub(super) const BY_NODE: [(f64, f64); NODES] = [(-0.25, -0.25), (0.25, -0.25), (0.25, 0.25), (-0.25, 0.25)];

/// An edge of a deformed element.
#[derive(Clone, Copy)]
pub(super) struct Edge<R> {
    /// x_J - x_I.
    pub(super) chord: Triple<R>,
    /// d_J - d_I.
    pub(super) difference: Triple<R>,
    /// d_I + d_J.
    pub(super) sum: Triple<R>,
    /// c·(d_J - d_I)/4.
    pub(super) bending: R,
    /// g, g', g''.
    pub(super) arc: [R; 3],
}

/// A Gauss point of a deformed element.
#[derive(Clone, Copy)]
pub(super) struct Drilling<R> {
    /// x,1 and x,2.
    pub(super) slopes: [Triple<R>; 2],
    /// t₁ and t₂.
    pub(super) triad: [Triple<R>; 2],
    /// ∂x,1/∂x_I and ∂x,2/∂x_I.
    pub(super) by_node: [[R; 2]; NODES],
}

/// A deformed element, global axes.
#[derive(Clone, Copy)]
pub(super) struct Deformed<R> {
    pub(super) triads: [[Triple<R>; 3]; NODES],
    pub(super) edges: [Edge<R>; 4],
    /// x_r, x_s.
    pub(super) position: [Triple<R>; 2],
    /// d_r, d_s.
    pub(super) director: [Triple<R>; 2],
    pub(super) points: [Drilling<R>; POINTS],
}

/// g and its first two derivatives.
#[inline(always)]
pub(super) fn arc<R: Real>(q: R) -> [R; 3] {
    let one = q.like(1.0);
    let value = one.plus_product(
        q,
        q.like(1.0 / 24.0).plus_product(q, q.like(3.0 / 640.0).plus_product(q, q.like(5.0 / 7168.0))),
    );
    let slope =
        q.like(1.0 / 24.0).plus_product(q, q.like(6.0 / 640.0).plus_product(q, q.like(15.0 / 7168.0)));
    [value, slope, q.like(6.0 / 640.0).plus_product(q, q.like(30.0 / 7168.0))]
}

impl<R: Real> Deformed<R> {
    /// The element with its nodes at `frames`.
    #[inline(always)]
    pub(super) fn at<C: Constants<R>>(constants: &C, frames: &[Pose<R>; NODES]) -> Self {
        let origin = frames[0].position;
        let zero = origin.x.like(0.0);
        let none = Triple::new(zero, zero, zero);
        let mut positions = [none; NODES];
        let mut triads = [[none; 3]; NODES];
        for i in 0..NODES {
            positions[i] = frames[i].position - origin;
            for k in 0..3 {
                triads[i][k] = frames[i].rotation.apply(constants.director(i, k));
            }
        }
        Self::of(constants, &positions, &triads)
    }

    /// The element with its nodes at `positions` relative to one of them, which carry the vectors `triads`.
    #[inline(always)]
    pub(super) fn of<C: Constants<R>>(
        constants: &C,
        positions: &[Triple<R>; NODES],
        triads: &[[Triple<R>; 3]; NODES],
    ) -> Self {
        let zero = positions[0].x.like(0.0);
        let none = Triple::new(zero, zero, zero);
        let mut edges = [Edge { chord: none, difference: none, sum: none, bending: zero, arc: [zero; 3] }; 4];
        for k in 0..4 {
            let (i, j) = EDGES[k];
            let chord = positions[j] - positions[i];
            let (from, to) = (triads[i][2], triads[j][2]);
            let (difference, sum) = (to - from, from + to);
            let bending = chord.dot(difference).scaled(0.25);
            edges[k] = Edge { chord, difference, sum, bending, arc: arc(difference.norm_squared()) };
        }
        let (mut position, mut director) = ([none; 2], [none; 2]);
        let mut twist = none;
        for i in 0..NODES {
            let (by_r, by_s) = BY_NODE[i];
            position[0] = position[0] + positions[i].scaled(by_r);
            position[1] = position[1] + positions[i].scaled(by_s);
            director[0] = director[0] + triads[i][2].scaled(by_r);
            director[1] = director[1] + triads[i][2].scaled(by_s);
            // x_d = (x₁ - x₂ + x₃ - x₄)/4.
            twist = twist + positions[i].scaled(16.0 * by_r * by_s * 0.25);
        }
        let mut points =
            [Drilling { slopes: [none; 2], triad: [none; 2], by_node: [[zero; 2]; NODES] }; POINTS];
        for p in 0..POINTS {
            let [r, s, ref shape] = SHAPES[p];
            let along = position[0] + twist.scaled(s[0]);
            let across = position[1] + twist.scaled(r[0]);
            let inverse = constants.inverse_jacobian(p);
            let own = &mut points[p];
            own.slopes[0] = (along * inverse[0]).plus_scaled(across, inverse[1]);
            own.slopes[1] = (along * inverse[2]).plus_scaled(across, inverse[3]);
            for i in 0..NODES {
                own.triad[0] = own.triad[0] + triads[i][0].scaled(shape[i]);
                own.triad[1] = own.triad[1] + triads[i][1].scaled(shape[i]);
                let (by_r, by_s) = BY_NODE[i];
                let saddle = 4.0 * by_r * by_s;
                let (by_r, by_s) = (by_r + saddle * s[0], by_s + saddle * r[0]);
                own.by_node[i][0] = inverse[0].scaled(by_r) + inverse[1].scaled(by_s);
                own.by_node[i][1] = inverse[2].scaled(by_r) + inverse[3].scaled(by_s);
            }
        }
        Self { triads: *triads, edges, position, director, points }
    }

    /// Rates of the strains where the nodes have these body-frame twists.
    #[inline(always)]
    pub(super) fn rates<C: Constants<R>>(
        &self,
        constants: &C,
        frames: &[Pose<R>; NODES],
        twists: &[Screw<R>; NODES],
    ) -> [R; STRAINS] {
        let zero = frames[0].position.x.like(0.0);
        let none = Triple::new(zero, zero, zero);
        let (mut velocities, mut turning) = ([none; NODES], [[none; 3]; NODES]);
        for i in 0..NODES {
            velocities[i] = frames[i].rotation.apply(twists[i].translation);
            for k in 0..3 {
                let carried = twists[i].rotation.cross(constants.director(i, k));
                turning[i][k] = frames[i].rotation.apply(carried);
            }
        }
        // All vectors are linear in those of the nodes, so that their rates are the same of velocities.
        self.rates_along(&Self::of(constants, &velocities, &turning))
    }

    /// Rates of the strains where the vectors have the rates `rate`.
    #[inline(always)]
    fn rates_along(&self, rate: &Self) -> [R; STRAINS] {
        let zero = self.edges[0].bending.like(0.0);
        let mut rates = [zero; STRAINS];
        for k in 0..4 {
            let (edge, own) = (&self.edges[k], &rate.edges[k]);
            rates[k] = edge.chord.dot(own.chord).scaled(0.25);
            let bending = own.chord.dot(edge.difference) + edge.chord.dot(own.difference);
            let square = edge.difference.dot(own.difference).scaled(2.0);
            rates[5 + k] =
                (bending.scaled(0.25) * edge.arc[0]).plus_product(edge.bending * edge.arc[1], square);
            rates[10 + k] = (own.chord.dot(edge.sum) + edge.chord.dot(own.sum)).scaled(0.25);
        }
        let ([x_r, x_s], [d_r, d_s]) = (self.position, self.director);
        let ([v_r, v_s], [w_r, w_s]) = (rate.position, rate.director);
        rates[4] = (v_r.dot(x_s) + x_r.dot(v_s)).scaled(0.5);
        rates[9] = (v_r.dot(d_s) + x_r.dot(w_s) + v_s.dot(d_r) + x_s.dot(w_r)).scaled(0.5);
        for p in 0..POINTS {
            let (point, own) = (&self.points[p], &rate.points[p]);
            rates[14 + p] = own.triad[0].dot(point.slopes[1]) + point.triad[0].dot(own.slopes[1])
                - own.triad[1].dot(point.slopes[0])
                - point.triad[1].dot(own.slopes[0]);
        }
        rates
    }

    /// The strains, with their values in the stress-free state still in them.
    #[inline(always)]
    pub(super) fn raw_strains(&self) -> [R; STRAINS] {
        let mut strains = [self.edges[0].bending; STRAINS];
        for k in 0..4 {
            let edge = &self.edges[k];
            strains[k] = edge.chord.norm_squared().scaled(0.125);
            strains[5 + k] = edge.bending * edge.arc[0];
            strains[10 + k] = edge.chord.dot(edge.sum).scaled(0.25);
        }
        let [x_r, x_s] = self.position;
        let [d_r, d_s] = self.director;
        strains[4] = x_r.dot(x_s).scaled(0.5);
        strains[9] = (x_r.dot(d_s) + x_s.dot(d_r)).scaled(0.5);
        for p in 0..POINTS {
            let Drilling { slopes, triad, .. } = &self.points[p];
            strains[14 + p] = triad[0].dot(slopes[1]) - triad[1].dot(slopes[0]);
        }
        strains
    }

    /// The strains.
    #[inline(always)]
    pub(super) fn strains<C: Constants<R>>(&self, constants: &C) -> [R; STRAINS] {
        let mut strains = self.raw_strains();
        for k in 0..STRAINS {
            strains[k] = strains[k] - constants.natural(k);
        }
        strains
    }
}

impl Deformed<f64> {
    /// Changes of the strains from this configuration to `end`, where the vectors change by `change`: products change by those of means and
    /// changes, so that nothing cancels.
    ///
    /// ```text
    /// Δ(x·t) = x̄·Δt + Δx·t̄,    Δ(b g) = ḡ Δb + b̄ Δg,    Δg = (1/24 + 3 (q₀ + q₁)/640 + 5 (q₀² + q₀ q₁ + q₁²)/7168) Δq
    /// ```
    pub(super) fn changes(&self, end: &Self, middle: &Self, change: &Self) -> [f64; STRAINS] {
        let mut changes = middle.rates_along(change);
        for k in 0..4 {
            let [from, to, mean, own] = [self, end, middle, change].map(|deformed| &deformed.edges[k]);
            let [q, r] = [from, to].map(|edge| edge.difference.norm_squared());
            let slope = 1.0 / 24.0 + 3.0 * (q + r) / 640.0 + 5.0 * (q * q + q * r + r * r) / 7168.0;
            let square = 2.0 * mean.difference.dot(own.difference);
            let bending = 0.25 * (own.chord.dot(mean.difference) + mean.chord.dot(own.difference));
            changes[5 + k] =
                0.5 * ((from.arc[0] + to.arc[0]) * bending + (from.bending + to.bending) * slope * square);
        }
        changes
    }
}
