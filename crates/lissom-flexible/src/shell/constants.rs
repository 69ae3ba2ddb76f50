//! Numbers of a shell element that do not change, of one element or of several in lanes.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::sync::Arc;

use lissom_motion::{Real, Triple, Vector3};
use nalgebra::Matrix2;

use super::condensed::Stiffness;
use super::quadrilateral::{GAUSS, NODES, POINTS, STRAINS};

/// Rows of the stiffness for membrane and bending.
const COUPLED: usize = 10;
/// First of the numbers for transverse shear.
const SHEAR: usize = COUPLED * (COUPLED + 1) / 2;
/// First of the numbers for drilling.
const DRILLING: usize = SHEAR + 10;
/// First of the strains in the stress-free state.
const NATURAL: usize = DRILLING + POINTS;
/// First of the triads' components.
const DIRECTORS: usize = NATURAL + STRAINS;
/// First of the inverse Jacobians.
const JACOBIANS: usize = DIRECTORS + 9 * NODES;
/// Number of constants of an element.
pub(super) const COUNT: usize = JACOBIANS + 4 * POINTS;

/// r, s and the bilinear functions of the nodes at the Gauss points.
pub(super) const SHAPES: [[[f64; 4]; 3]; POINTS] = {
    let mut shapes = [[[0.0; 4]; 3]; POINTS];
    let mut p = 0;
    while p < POINTS {
        let r = if p % 2 == 0 { -GAUSS } else { GAUSS };
        let s = if p < 2 { -GAUSS } else { GAUSS };
        shapes[p] = [
            [r; 4],
            [s; 4],
            [
                0.25 * (1.0 - r) * (1.0 - s),
                0.25 * (1.0 + r) * (1.0 - s),
                0.25 * (1.0 + r) * (1.0 + s),
                0.25 * (1.0 - r) * (1.0 + s),
            ],
        ];
        p += 1;
    }
    shapes
};

/// The constants of an element, or of one in each lane.
pub(super) trait Constants<R: Real> {
    /// The number at a place.
    fn number(&self, place: usize) -> R;

    /// A vector of a node's triad in the node's axes.
    #[inline(always)]
    fn director(&self, node: usize, k: usize) -> Triple<R> {
        let first = DIRECTORS + 9 * node + 3 * k;
        Triple::new(self.number(first), self.number(first + 1), self.number(first + 2))
    }

    /// Strain in the stress-free state.
    #[inline(always)]
    fn natural(&self, k: usize) -> R {
        self.number(NATURAL + k)
    }

    /// Inverse of the Jacobian at a Gauss point, row by row.
    #[inline(always)]
    fn inverse_jacobian(&self, point: usize) -> [R; 4] {
        let first = JACOBIANS + 4 * point;
        [self.number(first), self.number(first + 1), self.number(first + 2), self.number(first + 3)]
    }

    /// D times each column of `columns`.
    #[inline(always)]
    fn stiffness_times<const N: usize>(&self, columns: &[[R; N]; STRAINS], out: &mut [[R; N]; STRAINS]) {
        for k in 0..COUPLED {
            for l in k..COUPLED {
                let entry = self.number(k * COUPLED - k * (k + 1) / 2 + l);
                add(out, columns, (k, l), entry);
            }
        }
        for k in 0..4 {
            for l in k..4 {
                let entry = self.number(SHEAR + k * 4 - k * (k + 1) / 2 + l);
                add(out, columns, (COUPLED + k, COUPLED + l), entry);
            }
        }
        for k in 0..POINTS {
            let entry = self.number(DRILLING + k);
            add(out, columns, (COUPLED + 4 + k, COUPLED + 4 + k), entry);
        }
    }
}

/// Adds a symmetric entry.
#[inline(always)]
fn add<R: Real, const N: usize>(
    out: &mut [[R; N]; STRAINS],
    columns: &[[R; N]; STRAINS],
    (k, l): (usize, usize),
    entry: R,
) {
    for n in 0..N {
        out[k][n] = out[k][n].plus_product(entry, columns[l][n]);
        if k != l {
            out[l][n] = out[l][n].plus_product(entry, columns[k][n]);
        }
    }
}

/// The constants of one element, which copies share.
#[derive(Clone, Debug)]
pub(super) struct Numbers(pub(super) Arc<[f64; COUNT]>);

impl Numbers {
    /// From the stiffness, the triads in the axes of their nodes and the Jacobians at the Gauss points. Natural strains are zero.
    pub(super) fn new(
        stiffness: &Stiffness,
        triads: &[[Vector3; 3]; NODES],
        jacobians: &[Matrix2<f64>; POINTS],
    ) -> Self {
        let mut all = Vec::with_capacity(COUNT);
        for k in 0..COUPLED {
            all.extend((k..COUPLED).map(|l| stiffness[(k, l)]));
        }
        for k in COUPLED..COUPLED + 4 {
            all.extend((k..COUPLED + 4).map(|l| stiffness[(k, l)]));
        }
        all.extend((COUPLED + 4..STRAINS).map(|k| stiffness[(k, k)]));
        all.extend([0.0; STRAINS]);
        all.extend(triads.iter().flatten().flat_map(|vector| vector.iter().copied()));
        for jacobian in jacobians {
            let inverse = jacobian.try_inverse().unwrap_or_else(Matrix2::zeros);
            all.extend([inverse[(0, 0)], inverse[(0, 1)], inverse[(1, 0)], inverse[(1, 1)]]);
        }
        let mut numbers = [0.0; COUNT];
        for (number, value) in numbers.iter_mut().zip(all) {
            *number = value;
        }
        Self(numbers.into())
    }

    /// Constants with strains in the stress-free state.
    pub(super) fn with_natural(mut self, strains: &[f64; STRAINS]) -> Self {
        Arc::make_mut(&mut self.0)[NATURAL..NATURAL + STRAINS].copy_from_slice(strains);
        self
    }
}

impl Constants<f64> for Numbers {
    #[inline(always)]
    fn number(&self, place: usize) -> f64 {
        self.0[place]
    }
}
