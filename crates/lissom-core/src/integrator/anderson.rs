//! Secant updates of a reused tangent (Anderson acceleration). An outdated tangent leaves a fraction of each correction to the next
//! ones, in a few directions that are the same from iteration to iteration and from step to step. These errors are estimated from
//! earlier corrections and removed [Anderson 1965; Fang and Saad 2009, type II].
//!
//! ```text
//! d_k  correction by the reused tangent,   s_k  correction applied,   Δ_i = d_{i+1} - d_i,   P_i = s_i + Δ_i
//! s_k = d_k - Σ γ_i P_i,   γ = argmin |d_k - Σ γ_i Δ_i|
//! ```
//!
//! If the tangent is exact, P = 0 and the correction is not changed.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use serde::{Deserialize, Serialize};

use super::corrections::{Processor, processor, product};
use crate::tuning::{Tuning, TuningParameter};

/// Maximum number of secants.
const MAX_SECANTS: usize = 5;
/// Smallest pivot of a secant relative to its squared norm; secants below it depend linearly on newer ones and are skipped.
const INDEPENDENT: f64 = 3e-4;
/// Largest ratio of a correction to a secant for which the secant is used: its round-off is amplified by this ratio.
const REACH: f64 = 10.0;
/// Corrections below this are not checked for contradicting secants: they may be round-off, and an error of this size is small
/// [scaled].
const MIN_EXAMINED: f64 = 1e-10;
/// Smallest fraction of a correction that may remain after the secants are subtracted.
const MIN_REMAINING: f64 = 0.1;

/// History of corrections, of all stages together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Anderson {
    /// Weights of the coordinates.
    sizes: Vec<f64>,
    /// Δ, weighted, by stage and coordinate.
    changes: [Vec<f64>; MAX_SECANTS],
    /// P, by stage and row: error of the tangent along a correction.
    departures: [Vec<f64>; MAX_SECANTS],
    /// Weighted norms of P.
    departure_sizes: [f64; MAX_SECANTS],
    /// Inner products of the Δ.
    products: [[f64; MAX_SECANTS]; MAX_SECANTS],
    /// Maximum number of secants in use, limited by the number of coordinates.
    most: usize,
    /// Number of stored secants, and slot of the next one.
    known: usize,
    next: usize,
    /// Whether the next correction continues the last one, so that their difference is a secant.
    goes_on: bool,
    /// d - s of the last correction, by stage and row.
    taken: Vec<f64>,
    /// Weighted d of the last and of the present correction.
    last_weighted: Vec<f64>,
    weighted: Vec<f64>,
    #[serde(skip)]
    processor: Processor,
}

impl Anderson {
    /// No secants, for `stages` stages of `size` rows, of which the first are coordinates with the weights `sizes`.
    pub(crate) fn new(stages: usize, size: usize, sizes: &[f64]) -> Self {
        let (rows, coordinates) = (stages * size, stages * sizes.len());
        Self {
            sizes: sizes.to_vec(),
            changes: std::array::from_fn(|_| vec![0.0; coordinates]),
            departures: std::array::from_fn(|_| vec![0.0; rows]),
            departure_sizes: [0.0; MAX_SECANTS],
            products: [[0.0; MAX_SECANTS]; MAX_SECANTS],
            most: MAX_SECANTS.min(2 + sizes.len() / 4),
            known: 0,
            next: 0,
            goes_on: false,
            taken: vec![0.0; rows],
            last_weighted: vec![0.0; coordinates],
            weighted: vec![0.0; coordinates],
            processor: Processor(processor(size)),
        }
    }

    /// Discards all secants: the tangent has changed.
    pub(crate) fn forget(&mut self) {
        self.known = 0;
        self.next = 0;
        self.goes_on = false;
    }

    /// Copies the secants of another history.
    pub(crate) fn restore(&mut self, from: &Self) {
        let processor = self.processor;
        self.clone_from(from);
        self.processor = processor;
    }

    /// Marks that the next correction is not the continuation of the last one.
    pub(crate) fn interrupt(&mut self) {
        self.goes_on = false;
    }

    /// Improves the corrections of all stages in place.
    pub(crate) fn improve(&mut self, corrections: &mut [Vec<f64>], tuning: &Tuning) {
        self.processor.0.dispatch(Improve { secants: self, corrections, tuning });
    }

    #[inline(always)]
    fn run(&mut self, corrections: &mut [Vec<f64>], tuning: &Tuning) {
        let rows = corrections[0].len();
        self.weigh(corrections);
        if self.goes_on {
            self.note(corrections, tuning.of(TuningParameter::SecantCredible));
        }
        self.goes_on = true;
        std::mem::swap(&mut self.last_weighted, &mut self.weighted);
        let shares = self.shares();
        self.take(&shares);
        if self.contradict_each_other(&shares) {
            self.known = 0;
            self.taken.fill(0.0);
        }
        for (corrections, taken) in corrections.iter_mut().zip(self.taken.chunks(rows)) {
            for (value, taken) in corrections.iter_mut().zip(taken) {
                *value -= taken;
            }
        }
    }

    /// Whether the secants contradict each other: they leave a negligible fraction of the correction. A tangent whose iteration
    /// converges does not overestimate corrections so much. Secants of earlier equations, such as those of another step size, can be
    /// inconsistent with newer ones; the iteration would then stop although the residual is large.
    #[inline(always)]
    fn contradict_each_other(&self, shares: &[f64; MAX_SECANTS]) -> bool {
        let whole = product(&self.last_weighted, &self.last_weighted);
        let bound: f64 =
            shares.iter().zip(&self.departure_sizes).map(|(share, size)| share.abs() * size).sum();
        if whole < MIN_EXAMINED * MIN_EXAMINED || bound <= (1.0 - MIN_REMAINING) * whole.sqrt() {
            return false;
        }
        let (count, stages) = (self.sizes.len(), self.last_weighted.len() / self.sizes.len());
        let rows = self.taken.len() / stages;
        let mut remaining = 0.0;
        for (weighted, taken) in self.last_weighted.chunks(count).zip(self.taken.chunks(rows)) {
            let parts = weighted.iter().zip(taken).zip(&self.sizes);
            remaining += parts.map(|((all, taken), size)| (all - size * taken).powi(2)).sum::<f64>();
        }
        remaining < MIN_REMAINING * MIN_REMAINING * whole
    }

    /// Computes Σ γ P.
    #[inline(always)]
    fn take(&mut self, shares: &[f64; MAX_SECANTS]) {
        let mut is_first = true;
        for (departures, &share) in self.departures.iter().zip(shares).filter(|(_, share)| **share != 0.0) {
            if std::mem::take(&mut is_first) {
                for (taken, departure) in self.taken.iter_mut().zip(departures) {
                    *taken = share * departure;
                }
            } else {
                for (taken, departure) in self.taken.iter_mut().zip(departures) {
                    *taken += share * departure;
                }
            }
        }
        if is_first {
            self.taken.fill(0.0);
        }
    }

    #[inline(always)]
    fn weigh(&mut self, corrections: &[Vec<f64>]) {
        let count = self.sizes.len();
        for (stage, corrections) in corrections.iter().enumerate() {
            let weighted = &mut self.weighted[stage * count..(stage + 1) * count];
            for ((weighted, value), size) in weighted.iter_mut().zip(corrections).zip(&self.sizes) {
                *weighted = size * value;
            }
        }
    }

    /// Stores the secant between the last correction and this one.
    #[inline(always)]
    fn note(&mut self, corrections: &[Vec<f64>], credible: f64) {
        let slot = self.next;
        let change = &mut self.changes[slot];
        for ((change, value), last) in change.iter_mut().zip(&self.weighted).zip(&self.last_weighted) {
            *change = value - last;
        }
        let mut departure = 0.0;
        let (count, rows) = (self.sizes.len(), corrections[0].len());
        for (stage, corrections) in corrections.iter().enumerate() {
            let own = stage * rows..(stage + 1) * rows;
            let into = &mut self.departures[slot][own.clone()];
            for ((departure, taken), value) in into.iter_mut().zip(&self.taken[own]).zip(corrections) {
                *departure = value - taken;
            }
            // The last weighted corrections are no longer needed: reuse their storage.
            let weighted = &mut self.last_weighted[stage * count..(stage + 1) * count];
            for ((weighted, value), size) in weighted.iter_mut().zip(&*into).zip(&self.sizes) {
                *weighted = size * value;
            }
            departure += product(weighted, weighted);
        }
        self.departure_sizes[slot] = departure.sqrt();
        for other in 0..self.most {
            let product = product(&self.changes[slot], &self.changes[other]);
            self.products[slot][other] = product;
            self.products[other][slot] = product;
        }
        if departure < credible * credible * self.products[slot][slot] {
            self.next = (slot + 1) % self.most;
            self.known = (self.known + 1).min(self.most);
        } else if self.known == self.most {
            // The oldest secant has been overwritten.
            self.known = self.most - 1;
        }
    }

    /// γ by slot: least squares by a factorisation L D Lᵀ of the inner products, newest first.
    #[inline(always)]
    fn shares(&self) -> [f64; MAX_SECANTS] {
        let mut shares = [0.0; MAX_SECANTS];
        // L D, 1/D, and L⁻¹ of the right-hand side.
        let mut lower = [[0.0; MAX_SECANTS]; MAX_SECANTS];
        let mut inverse = [0.0; MAX_SECANTS];
        let mut forward = [0.0; MAX_SECANTS];
        let mut slots = [0; MAX_SECANTS];
        let mut used = 0;
        let smallest = product(&self.last_weighted, &self.last_weighted) / (REACH * REACH);
        for back in 1..=self.known {
            let slot = (self.next + self.most - back) % self.most;
            let own = self.products[slot][slot];
            if own < smallest {
                continue;
            }
            let mut row = [0.0; MAX_SECANTS];
            let (mut pivot, mut value) = (own, product(&self.changes[slot], &self.last_weighted));
            for k in 0..used {
                let mut sum = self.products[slot][slots[k]];
                for j in 0..k {
                    sum -= row[j] * inverse[j] * lower[k][j];
                }
                row[k] = sum;
                pivot -= sum * sum * inverse[k];
                value -= sum * inverse[k] * forward[k];
            }
            if pivot > INDEPENDENT * own {
                lower[used] = row;
                inverse[used] = 1.0 / pivot;
                forward[used] = value;
                slots[used] = slot;
                used += 1;
            }
        }
        for k in (0..used).rev() {
            let sum: f64 = (k + 1..used).map(|j| lower[j][k] * shares[slots[j]]).sum();
            shares[slots[k]] = (forward[k] - sum) * inverse[k];
        }
        if shares.iter().all(|share| share.is_finite()) { shares } else { [0.0; MAX_SECANTS] }
    }
}

struct Improve<'a> {
    secants: &'a mut Anderson,
    corrections: &'a mut [Vec<f64>],
    tuning: &'a Tuning,
}

impl pulp::WithSimd for Improve<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) {
        self.secants.run(self.corrections, self.tuning);
    }
}

#[cfg(test)]
#[path = "../../tests/unit/integrator/anderson.rs"]
mod tests;
