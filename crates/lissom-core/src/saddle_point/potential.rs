//! Stiffness of loads with a potential. Pressure on a closed surface, or on one whose rim is held, has a potential, although its stiffness has
//! an antisymmetric part at the rim: this does no work in motions that satisfy the constraints.
//!
//! ```text
//! yᵀ (A - Aᵀ) x = 0 for all x, y with B x = B y = 0
//! ```
//!
//! It is checked for random x and y. A can then be replaced by its symmetric part, which has the same solutions x.

use lissom_solver::{Pattern, Structure, Symmetric};

use super::{Matrix, SaddlePoint};

/// Increase of the diagonal, over its size, by which all motions get similar magnitudes.
const HEAVIER: f64 = 10.0;
/// Antisymmetric work over the sum of the magnitudes of its terms that counts as zero.
const NO_WORK: f64 = 1e-5;
/// Displacement over the largest one, below which it is round-off of the constraints.
const NOISE: f64 = 1e-6;

/// Whether the antisymmetric part of `values` in the first `count` rows does no work under the constraints. Multipliers of
/// `omitted` equations are zero.
pub(crate) fn has_potential(
    structure: &Structure,
    (values, count): (&[f64], usize),
    scale: f64,
    omitted: &[usize],
) -> bool {
    let pattern = &*structure.pattern;
    // Its lower half: any matrix yields motions that satisfy the constraints.
    let matrix = Matrix::new(Box::new(Symmetric::new(structure)), structure);
    let mut saddle = SaddlePoint::new(matrix, count).equilibrated(pattern.size());
    saddle.omit(omitted);
    saddle.matrices.values.copy_from_slice(values);
    for row in 0..count {
        if let Some(diagonal) = pattern.position(row, row) {
            saddle.matrices.values[diagonal] += HEAVIER * values[diagonal].abs();
        }
    }
    if saddle.factor(structure, scale).is_err() {
        return false;
    }
    let mut noise = Noise(1);
    let mut motion = || {
        let mut vector = vec![0.0; pattern.size()];
        vector[..count].iter_mut().for_each(|value| *value = noise.number());
        saddle.solve(&mut vector);
        vector.truncate(count);
        vector
    };
    // Two pairs, since one may have no work by chance.
    let [w, x, y, z] = [(); 4].map(|()| motion());
    [[w, x], [y, z]].iter().all(|[one, other]| {
        let [work, terms] = antisymmetric_work(pattern, values, [one, other]);
        work.abs() <= NO_WORK * terms
    })
}

/// yᵀ (A - Aᵀ) x, and the sum of the magnitudes of its terms.
fn antisymmetric_work(pattern: &Pattern, values: &[f64], [x, y]: [&[f64]; 2]) -> [f64; 2] {
    let noise = |own: &[f64]| NOISE * own.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let (of_x, of_y) = (noise(x), noise(y));
    let mut sums = [0.0; 2];
    for (row, column, [below, above]) in pattern.mirrors().filter(|&(row, ..)| row < x.len()) {
        let rest = values[below] - values[above];
        for (rest, row, column) in [(rest, row, column), (-rest, column, row)] {
            sums[0] += y[row] * rest * x[column];
            sums[1] += (y[row].abs() + of_y) * rest.abs() * (x[column].abs() + of_x);
        }
    }
    sums
}

/// Replaces the first `count` rows and columns by their symmetric part.
pub(crate) fn symmetrise(pattern: &Pattern, values: &mut [f64], count: usize) {
    for (_, _, [below, above]) in pattern.mirrors().filter(|&(row, ..)| row < count) {
        let mean = 0.5 * (values[below] + values[above]);
        (values[below], values[above]) = (mean, mean);
    }
}

/// Pseudo-random numbers in (-1, 1), the same in every run (SplitMix64, Steele et al. 2014).
pub(crate) struct Noise(pub(crate) u64);

impl Noise {
    pub(crate) fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ (bits >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}
