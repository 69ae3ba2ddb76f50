//! The smooth surface of a shell element that solids touch: it passes through the nodes, and is perpendicular to the directors.
//!
//! Legend: P_a positions of the nodes, d_a directors, N_a bilinear functions of r and s, W = Σ ½ N_a d_a d_aᵀ.
//!
//! ```text
//! x = Σ N_a P_a,      e_a = d_a·(x - P_a),      X = x - ½ Σ N_a e_a d_a,      n = Σ N_a d_a / |Σ N_a d_a|
//! δX = Σ (N_a - N_a W + ½ N_a d_a d_aᵀ) δP_a - ½ Σ N_a ((x - P_a)·δd_a d_a + e_a δd_a)
//! ```
//!
//! Surfaces of second degree are reproduced. An edge depends on its two nodes only, so that neighbours meet at it; their tangent planes
//! there differ by the third derivatives of the surface, of second order in the size of the elements.

use crate::least_distance::Square;
use lissom_flexible::shell::quadrilateral::{CORNERS, NODES};
use lissom_mechanics::dual::{Number, Three, dot, sum, times};

/// a - b.
pub(super) fn difference<T: Number>(a: Three<T>, b: Three<T>) -> Three<T> {
    sum(a, b.map(|component| -component))
}

/// a + b factor.
pub(super) fn plus<T: Number>(a: Three<T>, b: Three<T>, factor: T) -> Three<T> {
    sum(a, times(b, factor))
}

/// The part of a vector across a unit vector.
pub(super) fn across<T: Number>(a: Three<T>, unit: Three<T>) -> Three<T> {
    plus(a, unit, -dot(a, unit))
}

/// Zero.
pub(super) fn none<T: Number>() -> Three<T> {
    [T::constant(0.0); 3]
}

/// P_a and d_a, global axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patch<T> {
    pub(super) positions: [Three<T>; NODES],
    pub(super) directors: [Three<T>; NODES],
}

/// A point of the surface.
pub(super) struct Spot<T> {
    /// N_a.
    shapes: [T; NODES],
    /// X, X_r, X_s, and X_rr, X_rs, X_ss.
    pub(super) place: Three<T>,
    pub(super) along: [Three<T>; 2],
    pub(super) bend: [Three<T>; 3],
    /// x - P_a and e_a.
    offsets: [Three<T>; NODES],
    heights: [T; NODES],
    /// n, n_r and n_s, and |Σ N_a d_a|.
    pub(super) normal: Three<T>,
    pub(super) normal_by: [Three<T>; 2],
    length: T,
}

impl<T: Number> Patch<T> {
    /// Point of the patch at r and s.
    pub(super) fn at(&self, [r, s]: [T; 2]) -> Spot<T> {
        let linear = CORNERS.map(|(a, b)| [r.scaled(0.5 * a).plus(0.5), s.scaled(0.5 * b).plus(0.5)]);
        let shapes = linear.map(|[u, v]| u * v);
        let by: [[T; 2]; NODES] = std::array::from_fn(|a| {
            [linear[a][1].scaled(0.5 * CORNERS[a].0), linear[a][0].scaled(0.5 * CORNERS[a].1)]
        });
        // N_rs.
        let saddle = CORNERS.map(|(a, b)| T::constant(0.25 * a * b));
        let weighted = |vectors: &[Three<T>; NODES], weight: &dyn Fn(usize) -> T| {
            (0..NODES).fold(none(), |all, a| plus(all, vectors[a], weight(a)))
        };
        let place = weighted(&self.positions, &|a| shapes[a]);
        let along = [0, 1].map(|k| weighted(&self.positions, &|a| by[a][k]));
        let twist = weighted(&self.positions, &|a| saddle[a]);
        let offsets = self.positions.map(|position| difference(place, position));
        let heights: [T; NODES] = std::array::from_fn(|a| dot(self.directors[a], offsets[a]));
        let slopes: [[T; 2]; NODES] =
            std::array::from_fn(|a| along.map(|along| dot(self.directors[a], along)));
        let bulge = |start: Three<T>, weight: &dyn Fn(usize) -> T| {
            (0..NODES).fold(start, |all, a| plus(all, self.directors[a], weight(a).scaled(-0.5)))
        };
        let first = |k: usize| bulge(along[k], &|a| by[a][k] * heights[a] + shapes[a] * slopes[a][k]);
        let second = |k: usize| bulge(none(), &|a| (by[a][k] * slopes[a][k]).scaled(2.0));
        let mixed = bulge(twist, &|a| {
            saddle[a] * heights[a]
                + by[a][0] * slopes[a][1]
                + by[a][1] * slopes[a][0]
                + shapes[a] * dot(self.directors[a], twist)
        });
        let mean = weighted(&self.directors, &|a| shapes[a]);
        let length = dot(mean, mean).square_root();
        let inverse = T::constant(1.0) / length;
        let normal = times(mean, inverse);
        let turned = |k: usize| times(across(weighted(&self.directors, &|a| by[a][k]), normal), inverse);
        Spot {
            shapes,
            place: bulge(place, &|a| shapes[a] * heights[a]),
            along: [first(0), first(1)],
            bend: [second(0), mixed, second(1)],
            offsets,
            heights,
            normal,
            normal_by: [turned(0), turned(1)],
            length,
        }
    }
}

impl<T: Number> Spot<T> {
    /// δX, or δ(X + offset n), for displacements of the nodes and changes of the directors.
    pub(super) fn moved(&self, patch: &Patch<T>, by: &Patch<T>, offset: T) -> Three<T> {
        let [mut mean, mut turned] = [none(); 2];
        for a in 0..NODES {
            mean = plus(mean, by.positions[a], self.shapes[a]);
            turned = plus(turned, by.directors[a], self.shapes[a]);
        }
        let mut all = plus(mean, across(turned, self.normal), offset / self.length);
        for a in 0..NODES {
            let director = patch.directors[a];
            let height =
                dot(by.directors[a], self.offsets[a]) + dot(director, difference(mean, by.positions[a]));
            let half = self.shapes[a].scaled(-0.5);
            all = plus(plus(all, director, half * height), by.directors[a], half * self.heights[a]);
        }
        all
    }

    /// A force at X, or at X + offset n, in terms of forces on the nodes and of vectors F_a with the work F_a·δd_a.
    pub(super) fn spread(&self, patch: &Patch<T>, force: Three<T>, offset: T) -> Patch<T> {
        let along = patch.directors.map(|director| dot(director, force));
        let mut shared = force;
        for a in 0..NODES {
            shared = plus(shared, patch.directors[a], (self.shapes[a] * along[a]).scaled(-0.5));
        }
        let turning = times(across(force, self.normal), offset / self.length);
        let half = self.shapes.map(|shape| shape.scaled(0.5));
        Patch {
            positions: std::array::from_fn(|a| {
                plus(times(shared, self.shapes[a]), patch.directors[a], half[a] * along[a])
            }),
            directors: std::array::from_fn(|a| {
                let bulge = plus(times(self.offsets[a], along[a]), force, self.heights[a]);
                plus(times(turning, self.shapes[a]), bulge, -half[a])
            }),
        }
    }
}

/// Half the square of the distance between a point of the surface and another point.
pub(super) fn square(spot: &Spot<f64>, centre: Three<f64>) -> Square {
    let away = difference(centre, spot.place);
    let [r, s] = spot.along;
    let straight = [[dot(r, r), dot(r, s)], [dot(r, s), dot(s, s)]];
    let [rr, rs, ss] = spot.bend.map(|bend| dot(away, bend));
    let bend = [[straight[0][0] - rr, straight[0][1] - rs], [straight[1][0] - rs, straight[1][1] - ss]];
    Square { value: 0.5 * dot(away, away), slope: [-dot(away, r), -dot(away, s)], bend, straight }
}
