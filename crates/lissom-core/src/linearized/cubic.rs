//! The cubic elastic energy of shapes, in terms of shortenings: the energy is a square, and includes the effect of loads through
//! omitted shapes.
//!
//! Legend: y unknowns with the first interface fixed, K and M their stiffness and mass; T_ijk third derivatives of the elastic
//! energy; z natural modes of K and M, y = V z, with the squares λ of their frequencies.
//!
//! ```text
//! V = ½ (y + h)·K (y + h),      h = Σ V_i h_i,      h_i = ½ z·D_i z,      D_i,jk = T_ijk / λ_i · p_i / (p_i + p_j + p_k)
//! p_i = λ_i² (ε + r_i)²,      r_i ~ Σ_j T_ijj² / (λ_i λ_j²),  at most 1
//! ```
//!
//! The energy has the third derivatives T, because the three weights of a term have the sum 1, and is not negative. A term should
//! be assigned to the mode that is stretched by the other two, which bend: with a weight on a bending mode, terms of fourth order
//! would be as large as the bending itself. A stretched mode changes the stiffness of all others, which r measures: a mode that
//! bends a straight part has r = 0, because both sides are equal. Among equal modes the stiffest one is used.
//!
//! A steady rotation loads the part between the interfaces, and also displaces the omitted modes. Their static displacement is
//! w_d, and K_g = Σ w_d T_d with the same weights acts on the retained modes, as part of the inertia about the frame. The
//! retained modes are unknowns themselves, and their T is in h: it must not be counted twice.
//!
//! The same for accelerations would be momenta of first order in the deformation: without the corresponding second-order energy
//! the kinetic energy would not remain positive. They are omitted; forces under accelerations are those of the retained modes.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use crate::flexible::superelement::{GeometricMatrices, Shortening};
use crate::round_off;

/// ε: minimum weight of bending modes.
const BENDING: f64 = 1e-3;

/// The static state under a load of the floating frame, with fixed interfaces.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LoadState {
    /// K_g of the part that no mode resolves.
    pub(super) remainder: DMatrix<f64>,
    /// Displacements of the modes.
    pub(super) response: DVector<f64>,
}

impl LoadState {
    pub(super) fn combine(&mut self, other: &Self, factor: f64) {
        self.remainder += &other.remainder * factor;
        self.response += &other.response * factor;
    }

    pub(super) fn scale(&mut self, factor: f64) {
        self.remainder *= factor;
        self.response *= factor;
    }
}

/// Second-order terms over all shapes, before the reduction to the retained ones.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SecondOrder {
    /// Inertial terms.
    pub(super) direct: GeometricMatrices,
    /// T_k of each shape.
    pub(super) cubic: Vec<DMatrix<f64>>,
    /// States under steady rotation, angular acceleration and acceleration; those of a rotation are scaled as in A.
    pub(super) turning: Vec<LoadState>,
    pub(super) spun: Vec<LoadState>,
    pub(super) pushed: Vec<LoadState>,
}

/// Natural modes of the retained unknowns, with the first interface fixed.
struct Modes {
    /// V over all rows, and its inverse over all columns.
    shapes: DMatrix<f64>,
    inverse: DMatrix<f64>,
    squares: DVector<f64>,
    /// p.
    stretches: DVector<f64>,
}

impl Modes {
    fn of(mass: &DMatrix<f64>, stiffness: &DMatrix<f64>) -> Option<Self> {
        let size = mass.nrows();
        let count = size.checked_sub(6).filter(|count| *count > 0)?;
        let held = |matrix: &DMatrix<f64>| matrix.view((6, 6), (count, count)).into_owned();
        let lower = held(mass).cholesky()?.l();
        let half = lower.solve_lower_triangular(&held(stiffness))?;
        let scaled = lower.solve_lower_triangular(&half.transpose())?;
        let SymmetricEigen { eigenvectors, eigenvalues } =
            SymmetricEigen::new(0.5 * (&scaled + scaled.transpose()));
        let own = lower.transpose().solve_upper_triangular(&eigenvectors)?;
        let mut shapes = DMatrix::zeros(size, count);
        shapes.rows_mut(6, count).copy_from(&own);
        let mut inverse = DMatrix::zeros(count, size);
        inverse.columns_mut(6, count).copy_from(&(eigenvectors.transpose() * lower.transpose()));
        let least = round_off::EIGENVALUE * eigenvalues.amax();
        let squares = eigenvalues.map(|square| if square > least { square } else { 0.0 });
        let stretches = DVector::zeros(count);
        Some(Self { shapes, inverse, squares, stretches })
    }

    fn count(&self) -> usize {
        self.squares.len()
    }

    /// Change of the stiffness of other modes by a mode: r before division by the largest one.
    fn stretch(&self, cubic: &DMatrix<f64>, square: f64) -> f64 {
        if square <= 0.0 {
            return 0.0;
        }
        let of = |j: usize| if self.squares[j] > 0.0 { cubic[(j, j)] / self.squares[j] } else { 0.0 };
        (0..self.count()).map(|j| of(j) * of(j)).sum::<f64>() / square
    }

    /// A matrix over natural modes with the weights of a mode with this p.
    fn weighted(&self, matrix: &DMatrix<f64>, own: f64) -> DMatrix<f64> {
        DMatrix::from_fn(self.count(), self.count(), |j, k| {
            if own > 0.0 { matrix[(j, k)] * own / (own + self.stretches[j] + self.stretches[k]) } else { 0.0 }
        })
    }

    /// Transforms from natural modes back to the unknowns.
    fn back(&self, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        self.inverse.tr_mul(&(matrix * &self.inverse))
    }
}

impl SecondOrder {
    /// Total effect of steady loads, and the shortening along the directions to the interfaces: for the choice of shapes.
    pub(super) fn of_loads(&self) -> [Vec<DMatrix<f64>>; 2] {
        let whole = |(direct, state): (&DMatrix<f64>, &LoadState)| {
            let mut sum = direct + &state.remainder;
            for (cubic, factor) in
                self.cubic.iter().zip(state.response.iter()).filter(|(_, own)| **own != 0.0)
            {
                sum.zip_apply(cubic, |sum, value| *sum += factor * value);
            }
            sum
        };
        let direct = self.direct.turning();
        let turning = direct.inertia.iter().zip(&self.turning).chain(direct.momentum.iter().zip(&self.spun));
        let pushed = self.direct.moment.iter().zip(&self.pushed);
        [turning.map(whole).collect(), pushed.map(whole).collect()]
    }

    /// K_g of the state of all shapes.
    pub(super) fn stressed(&self, state: &DVector<f64>) -> DMatrix<f64> {
        let size = state.len();
        let mut sum = DMatrix::zeros(size, size);
        for (cubic, factor) in self.cubic.iter().zip(state.iter()).filter(|(_, own)| **own != 0.0) {
            sum.zip_apply(cubic, |sum, value| *sum += factor * value);
        }
        sum
    }

    /// Second-order matrices of the unknowns retained by `map`, with their mass and stiffness; `all` is the stiffness of all shapes, modes
    /// from row `first` on.
    pub(super) fn kept(
        &self,
        map: &DMatrix<f64>,
        [mass, stiffness, all]: [&DMatrix<f64>; 3],
        first: usize,
    ) -> GeometricMatrices {
        let mut own = self.direct.through(map);
        let Some(mut modes) = Modes::of(mass, stiffness) else { return own };
        // T over natural modes in its last two positions, and over all shapes in the first one.
        let among = map * &modes.shapes;
        let cubic: Vec<DMatrix<f64>> =
            self.cubic.iter().map(|matrix| among.tr_mul(&(matrix * &among))).collect();
        let natural: Vec<DMatrix<f64>> = (0..modes.count()).map(|i| over_mode(&cubic, &among, i)).collect();
        let of_natural: Vec<f64> = natural
            .iter()
            .zip(&modes.squares)
            .map(|(matrix, square)| modes.stretch(matrix, *square))
            .collect();
        let left_out = |k: usize| modes.stretch(&cubic[first + k], all[(first + k, first + k)]);
        let of_left_out: Vec<f64> = (0..all.nrows() - first).map(left_out).collect();
        let largest =
            of_natural.iter().chain(&of_left_out).fold(f64::MIN_POSITIVE, |most, own| most.max(*own));
        let counts = |stretch: f64, square: f64| (square * (BENDING + stretch / largest)).powi(2);
        let of_left_out: Vec<f64> = (of_left_out.iter().enumerate())
            .map(|(k, stretch)| counts(*stretch, all[(first + k, first + k)]))
            .collect();
        modes.stretches = DVector::from_fn(modes.count(), |i, _| counts(of_natural[i], modes.squares[i]));
        own.shortening = shortening(&modes, &natural);
        let tail = |matrix: &DMatrix<f64>| {
            let [rows, columns] = [matrix.nrows() - first, matrix.ncols() - first];
            matrix.view((first, first), (rows, columns)).into_owned()
        };
        let (tail_map, tail_all) = (tail(map), tail(all));
        let projected = tail_map.tr_mul(&(&tail_all * &tail_map)).cholesky();
        let of_load = |state: &LoadState| {
            let response = state.response.rows(first, tail_all.nrows()).into_owned();
            let resolved = projected
                .as_ref()
                .map(|factor| &tail_map * factor.solve(&tail_map.tr_mul(&(&tail_all * &response))));
            let missed = resolved.map_or_else(|| response.clone(), |resolved| &response - resolved);
            let mut sum = DMatrix::zeros(modes.count(), modes.count());
            for (k, factor) in missed.iter().enumerate() {
                sum += modes.weighted(&cubic[first + k], of_left_out[k]) * *factor;
            }
            let mut matrix = modes.back(&sum);
            matrix += map.tr_mul(&(&state.remainder * map));
            matrix
        };
        for (matrix, state) in own.sections.inertia.iter_mut().zip(&self.turning) {
            *matrix += of_load(state);
        }
        own
    }
}

/// T of a natural mode over natural modes; `cubic` has them only in its last two indices, and `among` maps the first one.
fn over_mode(cubic: &[DMatrix<f64>], among: &DMatrix<f64>, i: usize) -> DMatrix<f64> {
    let count = among.ncols();
    let mut sum = DMatrix::zeros(count, count);
    for (matrix, factor) in cubic.iter().zip(among.column(i).iter()).filter(|(_, own)| **own != 0.0) {
        sum.zip_apply(matrix, |sum, value| *sum += factor * value);
    }
    sum
}

/// h, one term for each natural mode with a nonzero one.
fn shortening(modes: &Modes, natural: &[DMatrix<f64>]) -> Vec<Shortening> {
    let count = modes.count();
    let terms: Vec<(usize, DMatrix<f64>)> = (0..count)
        .filter(|&i| modes.squares[i] > 0.0)
        .map(|i| (i, modes.weighted(&natural[i], modes.stretches[i])))
        .collect();
    let root = modes.squares.map(|square| if square > 0.0 { square.sqrt().recip() } else { 0.0 });
    let size = |(i, matrix): &(usize, DMatrix<f64>)| {
        let of = |j: usize, k: usize| (matrix[(j, k)] * root[j] * root[k] * root[*i]).abs();
        (0..count).flat_map(|j| (0..count).map(move |k| (j, k))).map(|(j, k)| of(j, k)).fold(0.0, f64::max)
    };
    let largest = terms.iter().map(size).fold(0.0, f64::max);
    terms
        .iter()
        .filter(|term| size(term) > round_off::NEGLIGIBLE * largest)
        .map(|(i, matrix)| Shortening {
            direction: modes.shapes.column(*i).into_owned(),
            matrix: modes.back(matrix) / modes.squares[*i],
        })
        .collect()
}

#[cfg(test)]
#[path = "../../tests/unit/linearized/cubic.rs"]
mod tests;
