//! Modes without damping and gyroscopic terms: K x + Bᵀ μ = λ M x, B x = 0, by shift and invert.
//!
//! The operator x ↦ (K - σM)⁻¹ M x on the constraints is symmetric in the inner product of M; its eigenvalues are 1/(λ - σ).
//! One multiplication by it removes the components of infinite eigenvalues [Ericsson and Ruhe 1980; Nour-Omid et al. 1987].
//! With the shift below all eigenvalues its pivots show that none is lower; a second factorisation above the last mode counts
//! the modes (Sylvester), so that none is missed.

use lissom_solver::FactorError;
use nalgebra::{DMatrix, SymmetricEigen};

use super::krylov::{Krylov, Operator, product};
use super::mode::{Completeness, ModeOptions};
use super::model::{LinearError, LinearModel};
use super::shifted::{RealShift, START_RATE};
use super::{ADDITIONAL_MODES, krylov};
use crate::interrupt;
use crate::round_off;

/// Eigenvalues closer than this, relative to their distance from the shift, are considered one cluster.
const CLUSTER: f64 = 1e-5;
/// Squared rates below this fraction of the small one that represents zero are not distinguished from rigid modes in the choice
/// of the shift.
const NEAREST: f64 = 1e-4;
/// Shifts at which modes are counted if none is found, in units of the shift.
const FAR_AWAY: [f64; 3] = [1e2, 1e5, 1e8];
/// Round-off of a solve, relative to the eigenvalue's distance from the shift.
const SOLVED: f64 = 1e-10;
/// A shape that violates a constraint by more than this fraction of the terms of the constraints is not a mode.
pub(super) const VIOLATED: f64 = 1e-5;

/// An eigenvalue λ [1/s²] and its shape, normalised to unit modal mass.
pub(super) struct Pair {
    pub(super) square: f64,
    pub(super) shape: Vec<f64>,
    /// Round-off of the eigenvalue: below it a mode is considered rigid [1/s²].
    pub(super) round_off: f64,
    pub(super) residual: f64,
}

pub(super) struct Found {
    pub(super) pairs: Vec<Pair>,
    pub(super) completeness: Completeness,
}

struct Inverse<'m, 's, 'a> {
    model: &'m LinearModel<'a>,
    solver: &'s mut RealShift<'a>,
    room: Vec<f64>,
    weighted: Vec<f64>,
}

impl Inverse<'_, '_, '_> {
    fn multiply(&mut self, values: &[f64], vector: &[f64], result: &mut [f64]) {
        let count = vector.len();
        self.room[..count].copy_from_slice(vector);
        self.room[count..].fill(0.0);
        self.model.pattern().multiply(values, &self.room, &mut self.weighted);
        result.copy_from_slice(&self.weighted[..count]);
    }
}

impl Operator<f64> for Inverse<'_, '_, '_> {
    fn size(&self) -> usize {
        self.model.coordinate_count()
    }

    fn apply(&mut self, vector: &[f64], image: &mut [f64]) {
        let model = self.model;
        self.multiply(&model.parts.mass, vector, image);
        let count = image.len();
        self.room[..count].copy_from_slice(image);
        self.room[count..].fill(0.0);
        self.solver.solve(&mut self.room);
        image.copy_from_slice(&self.room[..count]);
    }

    fn weigh(&mut self, vector: &[f64], weighted: &mut [f64]) {
        let model = self.model;
        self.multiply(&model.parts.mass, vector, weighted);
    }
}

/// Eigenvalues 1/(λ - σ) of the operator in the present basis, with coefficients and residuals, in descending order of magnitude.
pub(super) fn ritz(krylov: &Krylov<f64>) -> Vec<(f64, Vec<f64>, f64)> {
    let order = krylov.order();
    if order == 0 {
        return Vec::new();
    }
    let matrix = DMatrix::from_fn(order, order, |row, column| {
        0.5 * (krylov.entry(row, column) + krylov.entry(column, row))
    });
    let SymmetricEigen { eigenvectors, eigenvalues } = SymmetricEigen::new(matrix);
    let mut all: Vec<(f64, Vec<f64>, f64)> = (0..order)
        .map(|k| {
            let weights: Vec<f64> = eigenvectors.column(k).iter().copied().collect();
            let residual = krylov.residual(&weights);
            (eigenvalues[k], weights, residual)
        })
        .collect();
    all.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
    all
}

pub(super) fn is_converged((value, _, residual): &(f64, Vec<f64>, f64)) -> bool {
    *residual <= round_off::ITERATED_EIGENVALUE * value.abs()
}

/// Computes the lowest modes, or those nearest to a given frequency.
pub(super) fn find(model: &LinearModel<'_>, options: &ModeOptions) -> Result<Found, LinearError> {
    let mut solver = RealShift::new(model.system, &model.representative);
    let (shift, below_shift) = match options.shift {
        Some(frequency) => {
            let square = (std::f64::consts::TAU * frequency).powi(2);
            factor_near(model, &mut solver, square)?
        }
        None => shift_below(model, &mut solver)?,
    };
    search(model, solver, options, shift, below_shift)
}

/// Factorises at `shift` or, if an eigenvalue is there, close to it.
fn factor_near(
    model: &LinearModel<'_>,
    solver: &mut RealShift<'_>,
    shift: f64,
) -> Result<(f64, usize), LinearError> {
    let mut last = None;
    for change in [0.0, 1e-6, -3e-6, 1e-5, -1e-4] {
        let shifted = shift + change * shift.abs().max(f64::MIN_POSITIVE);
        match solver.factor(&model.parts, shifted) {
            Ok(below) => return Ok((shifted, below)),
            Err(error) => last = Some(error),
        }
    }
    Err(model.stopped(&last.unwrap_or(FactorError::NotFinite { unknown: 0 })))
}

/// A shift below all eigenvalues, near the lowest nonzero ones.
fn shift_below<'a>(model: &LinearModel<'a>, solver: &mut RealShift<'a>) -> Result<(f64, usize), LinearError> {
    let mut square = solver.small_square();
    let mut below = 1;
    // Unstable modes are below zero.
    for _ in 0..60 {
        below = factor_near(model, solver, -square)?.1;
        if below == 0 {
            break;
        }
        square *= 4.0;
    }
    if below > 0 {
        return Ok((-square, below));
    }
    // A short search finds the lowest modes that are not rigid.
    let mut krylov = Krylov::new(model.coordinate_count());
    let lowest = {
        let mut operator = inverse(model, solver);
        krylov.start(&mut operator, krylov::BLOCK, 2);
        for _ in 0..4 * krylov::BLOCK {
            if !krylov.step(&mut operator) {
                break;
            }
        }
        let estimates = ritz(&krylov);
        let elastic = estimates.iter().filter_map(|(value, weights, _)| {
            let lambda = value.recip() - square;
            let shape = krylov.combine(weights);
            // A rigid mode without strain has only the round-off of the solve.
            let noise = round_off(model, &shape, 1.0) + SOLVED * value.recip().abs();
            (lambda > noise.max(NEAREST * square)).then_some(lambda)
        });
        elastic.fold(f64::INFINITY, f64::min)
    };
    if !lowest.is_finite() {
        return Ok((-square, 0));
    }
    if lowest >= square {
        // A mode so near to zero would be as stiff as a constraint.
        return factor_near(model, solver, -lowest);
    }
    // Unstable modes remain above the shift.
    let mut nearer = lowest;
    while nearer < square {
        // Too near to zero the pivots of rigid modes vanish.
        if let Ok((shift, 0)) = factor_near(model, solver, -nearer) {
            return Ok((shift, 0));
        }
        nearer *= 4.0;
    }
    factor_near(model, solver, -square)
}

fn inverse<'m, 's, 'a>(model: &'m LinearModel<'a>, solver: &'s mut RealShift<'a>) -> Inverse<'m, 's, 'a> {
    let size = model.system.layout().size();
    Inverse { model, solver, room: vec![0.0; size], weighted: vec![0.0; size] }
}

fn search<'a>(
    model: &LinearModel<'a>,
    mut solver: RealShift<'a>,
    options: &ModeOptions,
    shift: f64,
    below_shift: usize,
) -> Result<Found, LinearError> {
    let mut krylov = Krylov::new(model.coordinate_count());
    let mut wanted = options.count + ADDITIONAL_MODES;
    let mut is_exhausted = krylov.start(&mut inverse(model, &mut solver), krylov::BLOCK, 2) == 0;
    let mut restarts = 0;
    loop {
        let estimates = {
            let mut operator = inverse(model, &mut solver);
            let mut since = 0;
            loop {
                interrupt::check()?;
                let more = krylov.step(&mut operator);
                if !more && krylov.start(&mut operator, krylov::BLOCK, 2) == 0 {
                    is_exhausted = true;
                }
                is_exhausted |= krylov.order() >= model.coordinate_count();
                since += 1;
                if !is_exhausted && since < krylov::CHECK_INTERVAL.max(krylov.order() / 8) {
                    continue;
                }
                since = 0;
                let estimates = ritz(&krylov);
                let done = estimates.iter().take(wanted).all(is_converged) && estimates.len() >= wanted;
                if done || is_exhausted {
                    break estimates;
                }
            }
        };
        // The nearest ones, without dividing a cluster; shapes that violate the constraints belong to infinite
        // eigenvalues.
        let mut pairs: Vec<Pair> = estimates
            .iter()
            .filter(|estimate| estimate.0.abs() > round_off::PIVOT * estimates[0].0.abs())
            .filter(|estimate| is_exhausted || is_converged(estimate))
            .map(|(value, weights, residual)| {
                pair(model, &mut solver, &krylov, shift, (*value, weights, *residual))
            })
            .filter(|pair| model.violation(&pair.shape) < VIOLATED)
            .take(wanted)
            .collect();
        if pairs.len() < options.count && !is_exhausted {
            wanted += krylov::BLOCK;
            continue;
        }
        let distances: Vec<f64> = pairs.iter().map(|pair| (pair.square - shift).abs().recip()).collect();
        let keep = whole_clusters(&distances, options.count.min(distances.len()));
        if keep == wanted {
            // The cluster may have more modes than were searched for.
            wanted += krylov::BLOCK;
            continue;
        }
        let next = distances.get(keep).copied();
        pairs.truncate(keep);
        let are_all = next.is_none() && pairs.len() < options.count;
        let missing = if are_all && below_shift == 0 {
            missing_anywhere(model, &pairs, shift)
        } else {
            missing(model, &pairs, shift, below_shift, next)
        };
        let completeness = match missing {
            Count::None => Completeness::Counted,
            Count::Some(missing) if restarts == krylov::MAX_RESTARTS || is_exhausted => {
                Completeness::Missing(missing)
            }
            Count::Unknown if restarts == krylov::MAX_RESTARTS || is_exhausted => Completeness::Unknown,
            Count::Some(_) | Count::Unknown => {
                restarts += 1;
                let added = krylov.start(&mut inverse(model, &mut solver), krylov::BLOCK, 2);
                is_exhausted = added == 0;
                continue;
            }
        };
        pairs.sort_by(|a, b| (a.square - shift).abs().total_cmp(&(b.square - shift).abs()));
        pairs.truncate(options.count);
        pairs.sort_by(|a, b| a.square.total_cmp(&b.square));
        return Ok(Found { pairs, completeness });
    }
}

/// The number of leading values in descending order, at least `count`, that end at a gap.
pub(super) fn whole_clusters(values: &[f64], count: usize) -> usize {
    (count.max(1)..values.len())
        .find(|&keep| values[keep] < (1.0 - CLUSTER) * values[keep - 1])
        .unwrap_or(values.len())
}

/// The number of modes that the search has missed.
enum Count {
    None,
    Some(usize),
    Unknown,
}

/// Compares the number of modes found with the number of all eigenvalues above `shift`, if no more than those found are
/// expected.
fn missing_anywhere(model: &LinearModel<'_>, pairs: &[Pair], shift: f64) -> Count {
    let mut solver = RealShift::new(model.system, &model.representative);
    let farthest = pairs.iter().map(|pair| (pair.square - shift).abs()).fold(0.0, f64::max);
    let stiffest = solver.small_square() / START_RATE;
    let beyond = (3.0 * farthest).max(stiffest).max(shift.abs());
    let counts = FAR_AWAY.map(|far| solver.factor(&model.parts, shift + far * beyond).ok());
    match counts.into_iter().flatten().max().map(|count| count.checked_sub(pairs.len())) {
        Some(Some(0)) => Count::None,
        Some(Some(missing)) => Count::Some(missing),
        Some(None) | None => Count::Unknown,
    }
}

/// Compares the number of modes found with the number of eigenvalues between shifts below and above them.
fn missing(
    model: &LinearModel<'_>,
    pairs: &[Pair],
    shift: f64,
    below_shift: usize,
    next: Option<f64>,
) -> Count {
    let mut solver = RealShift::new(model.system, &model.representative);
    let Some(farthest) = pairs.iter().map(|pair| (pair.square - shift).abs()).reduce(f64::max) else {
        // No mode at all: then there is none below any frequency.
        let counts = FAR_AWAY.map(|far| solver.factor(&model.parts, shift + far * shift.abs()).ok());
        return match counts.iter().flatten().max() {
            Some(0) => Count::None,
            Some(&count) => Count::Some(count),
            None => Count::Unknown,
        };
    };
    let mut count = |side: f64| {
        // Half way to the next eigenvalue, or well beyond the last one; at another fraction if a pivot vanishes there.
        [0.5, 0.4, 0.6, 0.3, 0.7].iter().find_map(|part| {
            let distance =
                next.map_or((1.5 + part) * farthest, |next| farthest + part * (next.recip() - farthest));
            solver.factor(&model.parts, shift + side * distance).ok()
        })
    };
    let Some(above) = count(1.0) else { return Count::Unknown };
    let below = if below_shift == 0 { Some(0) } else { count(-1.0) };
    let Some(below) = below else { return Count::Unknown };
    match above.saturating_sub(below).checked_sub(pairs.len()) {
        Some(0) => Count::None,
        Some(missing) => Count::Some(missing),
        None => Count::Unknown,
    }
}

/// A mode from its coefficients, purified by one more multiplication.
fn pair<'a>(
    model: &LinearModel<'a>,
    solver: &mut RealShift<'a>,
    krylov: &Krylov<f64>,
    shift: f64,
    (value, weights, residual): (f64, &[f64], f64),
) -> Pair {
    let mut operator = inverse(model, solver);
    let vector = krylov.combine(weights);
    let mut shape = vec![0.0; vector.len()];
    operator.apply(&vector, &mut shape);
    let mut weighted = vec![0.0; vector.len()];
    operator.weigh(&shape, &mut weighted);
    let modal_mass = product(&weighted, &shape);
    let factor = modal_mass.sqrt().recip();
    for entry in &mut shape {
        *entry *= factor;
    }
    // The eigenvalue is computed by the more accurate of two formulas: one loses digits far from the shift, the other, Rayleigh's
    // quotient, where its stiffness terms nearly cancel.
    let of_quotient = round_off(model, &shape, 1.0);
    let of_shift = SOLVED * value.recip().abs();
    let square = if of_quotient < of_shift {
        let mut forces = vec![0.0; vector.len()];
        operator.multiply(&model.parts.stiffness, &shape, &mut forces);
        product(&forces, &shape)
    } else {
        shift + value.recip()
    };
    let round_off = of_quotient + of_shift;
    Pair { square, round_off, residual: residual / value.abs(), shape }
}

/// Round-off of xᵀKx over the modal mass: terms that would cancel in exact arithmetic.
pub(super) fn round_off(model: &LinearModel<'_>, shape: &[f64], modal_mass: f64) -> f64 {
    let pattern = model.pattern();
    let mut sum = 0.0;
    for (column, &value) in shape.iter().enumerate() {
        let range = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
        let terms: f64 = pattern.row_indices()[range.clone()]
            .iter()
            .zip(&model.parts.stiffness[range])
            .filter(|&(&row, _)| row < shape.len())
            .map(|(&row, entry)| (entry * shape[row]).abs())
            .sum();
        sum += terms * value.abs();
    }
    round_off::STIFFNESS * sum / modal_mass
}
