//! A ball and the smooth surface of an element where they are nearest, over numbers or numbers with derivatives.
//!
//! Legend: c centre of the ball, X point of the surface, n its normal, p = (r, s), A = X_p·X_p.
//!
//! ```text
//! |c - X| least:   δp = (A - (c - X)·X_pp)⁻¹ δ((c - X)·X_p)
//! c - X = λ n:     q = p + (A + λ X_p·n_p)⁻¹ ((c - X)·X_p - λ n·X_p),   λ = (c - X)·n
//! share of an element: χ(q) = Π ρ(½ + (1 ∓ q)/(2ω)) over the edges with a neighbour,   ρ(u) = 3u² - 2u³ between 0 and 1
//! ```
//!
//! Directors are the same on both sides of an edge: so are the points q where the ball is above it along a director, and shares of
//! neighbours add up to 1. The nearest points need not: tangent planes of neighbours differ.

use super::patch::{Patch, Spot, difference, square};
use crate::least_distance::{Least, PARALLEL, least};
use lissom_mechanics::dual::{Number, Three, dot, times};
use lissom_mechanics::round_off;

/// Overlap with a neighbour at an edge; none without a neighbour.
#[derive(Clone, Copy, Debug)]
pub(super) struct Overlap {
    /// Half its width ω, in r or s.
    pub(super) width: f64,
    /// Whether the edge itself belongs to this element.
    pub(super) has_edge: bool,
}

/// Overlaps at the edges r = -1, 1 and s = -1, 1.
pub(super) type Overlaps = [[Option<Overlap>; 2]; 2];

/// The point of an element that is nearest to a centre.
pub(super) struct Foot {
    /// r and s.
    parameters: [f64; 2],
    /// ∂p by (c - X)·X_p: of parameters at an edge zero.
    inverse: [[f64; 2]; 2],
    /// Whether the element has a neighbour beyond, or the nearest point is not at an edge.
    continues: [bool; 2],
    /// |c - X| [m].
    pub(super) distance: f64,
}

/// The inverse of a symmetric matrix of some parameters; zero for others and if it has none.
fn inverse<T: Number>([[a, b], [_, d]]: [[T; 2]; 2], are_free: [bool; 2]) -> [[T; 2]; 2] {
    let zero = T::constant(0.0);
    let determinant = a * d - b * b;
    let one = T::constant(1.0);
    match are_free {
        [true, true] if a.value() > 0.0 && determinant.value() > PARALLEL * a.value() * d.value() => {
            [[d / determinant, -b / determinant], [-b / determinant, a / determinant]]
        }
        [true, false] if a.value() > 0.0 => [[one / a, zero], [zero; 2]],
        [false, true] if d.value() > 0.0 => [[zero; 2], [zero, one / d]],
        _ => [[zero; 2]; 2],
    }
}

/// The point of a patch that is nearest to a centre, up to a quarter of an element beyond edges with a neighbour.
pub(super) fn foot(patch: &Patch<f64>, centre: Three<f64>, overlaps: &Overlaps) -> Foot {
    let end = |overlap: Option<Overlap>| if overlap.is_some() { 1.5 } else { 1.0 };
    let ends = overlaps.map(|[before, after]| [-end(before), end(after)]);
    let of = |parameters: [f64; 2]| square(&patch.at(parameters), centre);
    let Least { parameters, is_free } = least(ends, of);
    let there = of(parameters);
    let continues =
        [0, 1].map(|k: usize| is_free[k] || overlaps[k][usize::from(parameters[k] > 0.0)].is_some());
    let distance = (2.0 * there.value).sqrt();
    Foot { parameters, inverse: inverse(there.bend, is_free), continues, distance }
}

/// A ball at a foot.
pub(super) struct Touch<T> {
    pub(super) spot: Spot<T>,
    /// |c - X| [m].
    pub(super) distance: T,
    /// From the surface to the centre.
    pub(super) outwards: Three<T>,
    /// χ.
    pub(super) share: T,
    /// How far q is within the overlaps, in r or s: the share is zero where this is negative.
    pub(super) within: f64,
    /// Whether the element has more of the contact than its neighbours.
    pub(super) is_own: bool,
    /// 1 on the side of the normal, otherwise -1.
    pub(super) side: f64,
}

impl Foot {
    /// The touch, with the foot that moves.
    pub(super) fn touch<T: Number>(
        &self,
        patch: &Patch<T>,
        centre: Three<T>,
        overlaps: &Overlaps,
    ) -> Touch<T> {
        let fixed = self.parameters.map(T::constant);
        let start = patch.at(fixed);
        let away = difference(centre, start.place);
        let slopes = start.along.map(|along| dot(away, along));
        let parameters = [0, 1].map(|k: usize| {
            let moved = slopes[0].scaled(self.inverse[k][0]) + slopes[1].scaled(self.inverse[k][1]);
            // Only its derivatives: the slopes of free parameters are zero.
            moved.composed(self.parameters[k], 1.0)
        });
        let spot = patch.at(parameters);
        let away = difference(centre, spot.place);
        let distance = dot(away, away).square_root();
        let (share, within, is_own) = self.share(&spot, away, (parameters, overlaps));
        let side = if dot(away, spot.normal).value() < 0.0 { -1.0 } else { 1.0 };
        Touch {
            distance,
            outwards: times(away, T::constant(1.0) / distance),
            share,
            within,
            is_own,
            side,
            spot,
        }
    }

    fn share<T: Number>(
        &self,
        spot: &Spot<T>,
        away: Three<T>,
        (parameters, overlaps): ([T; 2], &Overlaps),
    ) -> (T, f64, bool) {
        let Spot { along, normal, normal_by, .. } = spot;
        let height = dot(away, *normal);
        let metric = |j: usize, k: usize| dot(along[j], along[k]) + height * dot(along[j], normal_by[k]);
        let mixed = metric(0, 1);
        let inverse = inverse([[metric(0, 0), mixed], [mixed, metric(1, 1)]], self.continues);
        let slopes = along.map(|along| dot(away, along) - height * dot(*normal, along));
        let (mut share, mut within, mut is_own) = (T::constant(1.0), f64::INFINITY, true);
        for k in 0..2 {
            let place = parameters[k] + inverse[k][0] * slopes[0] + inverse[k][1] * slopes[1];
            for (overlap, sign) in overlaps[k].into_iter().zip([-1.0, 1.0]) {
                let Some(Overlap { width, has_edge }) = overlap else { continue };
                let inside = place.scaled(-sign).plus(1.0);
                within = within.min(inside.value() + width);
                // Within round-off an edge belongs to one of both elements.
                is_own &= inside.value() > if has_edge { -round_off::POSITION } else { round_off::POSITION };
                let u = inside.scaled(0.5 / width).plus(0.5);
                let clamped = u.value().clamp(0.0, 1.0);
                share = share
                    * u.composed(clamped * clamped * (3.0 - 2.0 * clamped), 6.0 * clamped * (1.0 - clamped));
            }
        }
        (share, within, is_own)
    }
}
