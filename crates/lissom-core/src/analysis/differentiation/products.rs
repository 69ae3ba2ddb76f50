//! Products of the linearised equations with variations, several numbers of the model side by side.
//!
//! ```text
//! K η + D ν + M α      in the rows of the coordinates,      B η      in those of the multipliers
//! ```

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Block, WIDTH};
use lissom_solver::Pattern;

use super::variation::NOTHING;
use crate::system::Linearization;

/// An entry of D and M.
#[derive(Clone, Copy, Debug)]
struct Inertial {
    row: u32,
    column: u32,
    by_rate: f64,
    by_acceleration: f64,
}

/// The linearised equations at a stage, ready for products.
#[derive(Clone, Debug, Default)]
pub(super) struct Products {
    /// K, and B in the rows of the multipliers.
    by_place: Vec<f64>,
    /// What is not zero of D and M, which is little.
    inertial: Vec<Inertial>,
    /// Bᵀ times changes of multipliers is left out in the columns from here on, unless they are given.
    coordinates: usize,
}

impl Products {
    /// Takes over a linearisation.
    pub(super) fn enter(&mut self, pattern: &Pattern, coordinates: usize, parts: &Linearization) {
        self.coordinates = coordinates;
        self.by_place.clear();
        self.by_place.extend(parts.stiffness.iter().zip(&parts.constraint).map(|(k, b)| k + b));
        self.inertial.clear();
        for column in 0..coordinates {
            for position in pattern.column_starts()[column]..pattern.column_starts()[column + 1] {
                let (by_rate, by_acceleration) = (parts.damping[position], parts.mass[position]);
                if by_rate != 0.0 || by_acceleration != 0.0 {
                    let row = pattern.row_indices()[position] as u32;
                    self.inertial.push(Inertial { row, column: column as u32, by_rate, by_acceleration });
                }
            }
        }
    }

    /// Adds the products with places, rates, accelerations and, in a second part of the places, multipliers.
    pub(super) fn add(
        &self,
        processor: pulp::Arch,
        pattern: &Pattern,
        variation: [&[Block]; 3],
        multipliers: Option<&[Block]>,
        out: &mut [Block],
    ) {
        processor.dispatch(Add { products: self, pattern, variation, multipliers, out });
    }
}

struct Add<'a> {
    products: &'a Products,
    pattern: &'a Pattern,
    variation: [&'a [Block]; 3],
    multipliers: Option<&'a [Block]>,
    out: &'a mut [Block],
}

impl pulp::WithSimd for Add<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) {
        let Add { products, pattern, variation: [place, rate, acceleration], multipliers, out } = self;
        let all = place.iter().chain(multipliers.unwrap_or_default());
        for (column, value) in all.enumerate() {
            if *value == NOTHING {
                continue;
            }
            let range = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
            for (&row, &entry) in pattern.row_indices()[range.clone()].iter().zip(&products.by_place[range]) {
                let sum = &mut out[row];
                for lane in 0..WIDTH {
                    sum[lane] += entry * value[lane];
                }
            }
        }
        for entry in &products.inertial {
            let (rate, acceleration) = (&rate[entry.column as usize], &acceleration[entry.column as usize]);
            let sum = &mut out[entry.row as usize];
            for lane in 0..WIDTH {
                sum[lane] += entry.by_rate * rate[lane] + entry.by_acceleration * acceleration[lane];
            }
        }
    }
}
