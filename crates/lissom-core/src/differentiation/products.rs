//! Products of the linearised equations with variations, for several model parameters at once.
//!
//! ```text
//! K η + D ν + M α      in the rows of the coordinates,      B η      in those of the multipliers
//! ```

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Block, WIDTH};
use lissom_solver::Pattern;

use crate::system::Linearization;

/// An entry of D and M.
#[derive(Clone, Copy, Debug)]
struct Inertial {
    column: u32,
    by_rate: f64,
    by_acceleration: f64,
}

/// The linearised equations at a stage, stored by rows so that the sums of a row stay in registers.
#[derive(Clone, Debug, Default)]
pub(super) struct Products {
    /// Position of the transposed entry of every entry: the pattern is symmetric, and values are stored by columns.
    mirrored: Vec<u32>,
    /// K, and B in the rows of the multipliers, by rows.
    by_place: Vec<f64>,
    /// Nonzero entries of D and M, which are few, and the end of each row's entries.
    inertial: Vec<Inertial>,
    ends: Vec<u32>,
}

impl Products {
    /// Copies a linearisation.
    pub(super) fn enter(&mut self, pattern: &Pattern, parts: &Linearization) {
        if self.mirrored.is_empty() {
            self.mirrored = mirrored(pattern);
        }
        let Self { mirrored, by_place, inertial, ends } = self;
        let value = |&position: &u32| {
            let position = position as usize;
            parts.stiffness[position] + parts.constraint[position]
        };
        by_place.clear();
        by_place.extend(mirrored.iter().map(value));
        inertial.clear();
        ends.clear();
        for row in 0..pattern.size() {
            let range = pattern.column_starts()[row]..pattern.column_starts()[row + 1];
            for (&column, &position) in pattern.column(row).iter().zip(&mirrored[range]) {
                let [by_rate, by_acceleration] =
                    [parts.damping[position as usize], parts.mass[position as usize]];
                if by_rate != 0.0 || by_acceleration != 0.0 {
                    inertial.push(Inertial { column: column as u32, by_rate, by_acceleration });
                }
            }
            ends.push(inertial.len() as u32);
        }
    }

    /// Adds the products with variations of positions, rates, accelerations and multipliers to `out`.
    pub(super) fn add(
        &self,
        processor: pulp::Arch,
        pattern: &Pattern,
        variation: [&[Block]; 3],
        multipliers: &[Block],
        out: &mut [Block],
    ) {
        processor.dispatch(Add { products: self, pattern, variation, multipliers, out });
    }
}

/// Position of the transposed entry of every entry of a symmetric pattern.
fn mirrored(pattern: &Pattern) -> Vec<u32> {
    let mut next = pattern.column_starts().to_vec();
    let mut mirrored = vec![0; pattern.entries()];
    // Columns ascend, and so do the rows of the transposed entries.
    for column in 0..pattern.size() {
        for position in pattern.column_starts()[column]..pattern.column_starts()[column + 1] {
            let row = pattern.row_indices()[position];
            mirrored[next[row]] = position as u32;
            next[row] += 1;
        }
    }
    mirrored
}

struct Add<'a> {
    products: &'a Products,
    pattern: &'a Pattern,
    variation: [&'a [Block]; 3],
    multipliers: &'a [Block],
    out: &'a mut [Block],
}

impl pulp::WithSimd for Add<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) {
        let Add { products, pattern, variation: [place, rate, acceleration], multipliers, out } = self;
        let (starts, columns) = (pattern.column_starts(), pattern.row_indices());
        let mut first = 0;
        for (row, (sum, &end)) in out.iter_mut().zip(&products.ends).enumerate() {
            let mut own = *sum;
            let range = starts[row]..starts[row + 1];
            for (&column, &entry) in columns[range.clone()].iter().zip(&products.by_place[range]) {
                let value =
                    if column < place.len() { &place[column] } else { &multipliers[column - place.len()] };
                for lane in 0..WIDTH {
                    own[lane] += entry * value[lane];
                }
            }
            for entry in &products.inertial[first..end as usize] {
                let (rate, acceleration) =
                    (&rate[entry.column as usize], &acceleration[entry.column as usize]);
                for lane in 0..WIDTH {
                    own[lane] += entry.by_rate * rate[lane] + entry.by_acceleration * acceleration[lane];
                }
            }
            first = end as usize;
            *sum = own;
        }
    }
}
