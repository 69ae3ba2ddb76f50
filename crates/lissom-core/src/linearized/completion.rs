//! Modes missed by a search in a Krylov basis, from the eigenvalues of the first-order equations of small models.
//!
//! Far from the shift the digits of an eigenvector are lost in comparison with those of nearer ones. In this case the eigenvalue
//! of the full matrix is the shift of an inverse iteration, which computes its eigenvector to round-off.

use nalgebra::linalg::balancing;
use num_complex::Complex64;

use super::arnoldi::{Field, inverse, mode_of};
use super::krylov::{Noise, Operator, product};
use super::mode::{Mode, OVERDAMPED};
use super::model::LinearModel;
use super::shifted::GeneralShift;
use super::{EIGENVALUE_TOLERANCE, EQUAL};

use crate::round_off;
use crate::tuning::INVERSE_ITERATIONS;

/// Maximum number of states of a model whose eigenvalues are all computed.
const MAX_STATES: usize = 200;
/// Distance of its shift from the eigenvalue, relative to it.
const RELATIVE_SHIFT: f64 = 1e-5;
/// Allowed remainder of a vector that is a combination of known ones, relative to its norm.
const KNOWN: f64 = 1e-3;

/// Eigenvalues of a small model.
pub(super) struct Spectrum {
    /// All of them.
    pub(super) values: Vec<Complex64>,
    largest: f64,
}

impl Spectrum {
    /// The spectrum of `model`; none if it is large, or if velocities are not states.
    pub(super) fn of(model: &LinearModel<'_>, rate: f64) -> Option<Self> {
        let mut a = model.first_order(MAX_STATES, rate)?;
        if a.nrows() == 0 {
            return Some(Self { values: Vec::new(), largest: 0.0 });
        }
        balancing::balance_parlett_reinsch(&mut a);
        let (_, triangle) = f64::schur(&a)?;
        let values: Vec<Complex64> = triangle.diagonal().iter().copied().collect();
        let largest = values.iter().fold(0.0, |most: f64, value| most.max(value.norm()));
        Some(Self { values, largest })
    }

    /// Distance below which eigenvalues are equal.
    fn tolerance(&self, value: Complex64) -> f64 {
        EQUAL * value.norm() + round_off::MATRIX_ENTRY * self.largest
    }

    /// Adds to `modes` those near `shift` that are missing among the `count` nearest ones.
    pub(super) fn complete(
        &self,
        model: &LinearModel<'_>,
        modes: &mut Vec<Mode>,
        shift: Complex64,
        count: usize,
    ) {
        let mut wanted: Vec<Complex64> = self
            .values
            .iter()
            .copied()
            .filter(|value| value.im >= -round_off::MATRIX_ENTRY * self.largest)
            .filter(|value| value.norm() > round_off::PREDICTION.sqrt() * self.largest)
            .collect();
        let distance = |value: Complex64| (value - shift).norm();
        wanted.sort_by(|a, b| distance(*a).total_cmp(&distance(*b)));
        // Rigid modes are computed by the search, and included in the count.
        let rigid = modes.iter().filter(|mode| mode.eigenvalue == Complex64::default()).count();
        let has_states = model.system.layout().states().next().is_some();
        let mut left = count.saturating_sub(rigid);
        wanted.retain(|value| {
            let is_wanted = left > 0;
            let is_decay = has_states && -value.re >= OVERDAMPED * value.norm();
            left -= usize::from(is_wanted && !is_decay);
            is_wanted
        });
        let mut is_matched = vec![false; modes.len()];
        let mut missing = Vec::new();
        for value in wanted {
            let free = (0..modes.len()).filter(|&k| !is_matched[k]);
            let nearest = free
                .map(|k| (k, (modes[k].eigenvalue - value).norm()))
                .min_by(|a, b| a.1.total_cmp(&b.1))
                .filter(|&(_, apart)| apart <= self.tolerance(value));
            match nearest {
                Some((k, _)) => is_matched[k] = true,
                None => missing.push(value),
            }
        }
        for value in missing {
            if let Some(mode) = self.mode_at(model, modes, value) {
                modes.push(mode);
            }
        }
        modes.sort_by(|a, b| distance(a.eigenvalue).total_cmp(&distance(b.eigenvalue)));
    }

    /// The mode whose eigenvalue is nearest to `value`, if it is not among `known`: the eigenvalues of the full matrix have
    /// errors.
    fn mode_at(&self, model: &LinearModel<'_>, known: &[Mode], value: Complex64) -> Option<Mode> {
        let mut solver =
            GeneralShift::<Complex64>::on(model.system, model.structure(), &model.representative);
        let shift = value * Complex64::new(1.0 + RELATIVE_SHIFT, RELATIVE_SHIFT);
        let mut operator = inverse(model, &mut solver, shift).ok()?;
        let mut noise = Noise(7);
        let mut vector: Vec<Complex64> =
            (0..operator.size()).map(|_| Complex64::new(noise.number(), noise.number())).collect();
        let mut image = vec![Complex64::default(); vector.len()];
        let alike: Vec<Vec<Complex64>> = known
            .iter()
            .filter(|mode| (mode.eigenvalue - value).norm() <= self.tolerance(value))
            .map(|mode| operator.vector_of(mode))
            .collect();
        for _ in 0..INVERSE_ITERATIONS {
            operator.apply(&vector, &mut image);
            std::mem::swap(&mut vector, &mut image);
            normalise(&mut vector)?;
            let mut basis: Vec<Vec<Complex64>> = Vec::new();
            for own in &alike {
                let mut own = own.clone();
                remove(&mut own, &basis);
                if normalise(&mut own).is_some_and(|left| left > KNOWN) {
                    basis.push(own);
                }
            }
            remove(&mut vector, &basis);
            if normalise(&mut vector)? <= KNOWN {
                return None;
            }
        }
        operator.apply(&vector, &mut image);
        let quotient = product(&vector, &image);
        let found = operator.shift + quotient.inv();
        let is_known = known.iter().any(|mode| {
            let is_alike = (mode.eigenvalue - value).norm() <= self.tolerance(value);
            !is_alike
                && (mode.eigenvalue - found).norm()
                    <= EIGENVALUE_TOLERANCE * found.norm() + round_off::MATRIX_ENTRY * self.largest
        });
        let is_settled = {
            let rest = image.iter().zip(&vector).map(|(image, own)| (image - quotient * own).norm_sqr());
            rest.sum::<f64>().sqrt() <= EIGENVALUE_TOLERANCE * quotient.norm()
        };
        let is_new = is_settled && !is_known && found.im >= -EIGENVALUE_TOLERANCE * found.norm();
        is_new.then(|| mode_of(model, &mut operator, vector, quotient)).flatten()
    }
}

/// Removes the components along an orthonormal basis.
fn remove(vector: &mut [Complex64], basis: &[Vec<Complex64>]) {
    for known in basis {
        let part = product(known, vector);
        for (value, own) in vector.iter_mut().zip(known) {
            *value -= part * own;
        }
    }
}

/// Scales a vector to unit norm; returns its norm, none if it is zero.
fn normalise(vector: &mut [Complex64]) -> Option<f64> {
    let size = product(vector, vector).re.sqrt();
    if !(size.is_finite() && size > 0.0) {
        return None;
    }
    for value in vector {
        *value /= size;
    }
    Some(size)
}
