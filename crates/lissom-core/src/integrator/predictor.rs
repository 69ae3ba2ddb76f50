//! Predictor of the increments and multipliers of a step: the extrapolation of the scheme plus an estimate of its error from the
//! errors of earlier steps, by linear prediction [Makhoul 1975] with the same coefficients for all unknowns. It reproduces every
//! sequence with a linear recurrence: polynomials, and oscillations of stiff members, several at once.
//!
//! ```text
//! d_n  error of the scheme's extrapolation at step n (solution - extrapolation)
//! d_{n+1} ≈ Σ_{j<K} c_j d_{n-j},   c = argmin Σ_m φ^m |d_{n-m} - Σ_j c_j d_{n-m-1-j}|²
//! ```
//!
//! If the correction did not reduce the error of a step, for example at a jump of the motion, the next step uses the scheme's
//! extrapolation only.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Block, WIDTH};
use serde::{Deserialize, Serialize};

use super::corrections::{Processor, sum};
use crate::round_off;
use crate::tuning::{Tuning, TuningParameter};

/// Maximum order of the linear prediction, K.
const MAX_STEPS: usize = 8;
/// A prediction is rejected if it would have left more than this fraction of the error of the scheme's extrapolation. After a jump
/// of the motion, or where constraints lose rank, it leads to other solution branches.
const CREDIBLE: f64 = 0.5;

/// Linear prediction of a set of unknowns.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Predictor {
    /// Squared weight of each unknown's error, zero in the padding of a stage's last block.
    weights: Vec<Block>,
    /// Errors d of the last steps: a ring buffer per block of unknowns.
    missed: Vec<[Block; MAX_STEPS]>,
    /// Ring buffer slot of the oldest error, which the next one replaces.
    oldest: usize,
    /// Weighted inner products of the errors, `[i][j]` = d_{n-i} · d_{n-j}.
    products: [[f64; MAX_STEPS]; MAX_STEPS],
    /// Matrix and right-hand side of the normal equations.
    matrix: [[f64; MAX_STEPS]; MAX_STEPS],
    vector: [f64; MAX_STEPS],
    /// Coefficients c by age of the error, and by ring buffer slot (zero while the prediction is rejected).
    coefficients: [f64; MAX_STEPS],
    shares: [f64; MAX_STEPS],
    /// Sizes of the last two steps, relative to the next.
    lengths: [f64; 2],
    /// Whether the coefficients have been used for a step. They are renewed every second step.
    is_used: bool,
    /// Order of the prediction: few unknowns determine few coefficients.
    most: usize,
    #[serde(skip)]
    processor: Processor,
}

impl Predictor {
    /// An empty history, for `stages` stages of unknowns whose errors have these weights.
    pub(crate) fn new(stages: usize, weights: &[f64]) -> Self {
        let blocks = weights.len().div_ceil(WIDTH);
        let squares: Vec<f64> = weights.iter().map(|weight| weight * weight).collect();
        let of_stage: Vec<Block> = (0..blocks).map(|block| numbers(&squares, block)).collect();
        Self {
            weights: of_stage.repeat(stages),
            missed: vec![[[0.0; WIDTH]; MAX_STEPS]; stages * blocks],
            oldest: 0,
            products: [[0.0; MAX_STEPS]; MAX_STEPS],
            matrix: [[0.0; MAX_STEPS]; MAX_STEPS],
            vector: [0.0; MAX_STEPS],
            coefficients: [0.0; MAX_STEPS],
            shares: [0.0; MAX_STEPS],
            lengths: [1.0; 2],
            is_used: true,
            most: MAX_STEPS.min(2 + 2 * stages * weights.len()),
            processor: Processor::default(),
        }
    }

    /// Discards the history: the step size changes, or the motion is interrupted.
    pub(crate) fn forget(&mut self) {
        self.missed.fill([[0.0; WIDTH]; MAX_STEPS]);
        (self.products, self.matrix) = ([[0.0; MAX_STEPS]; MAX_STEPS], [[0.0; MAX_STEPS]; MAX_STEPS]);
        (self.vector, self.coefficients, self.shares) =
            ([0.0; MAX_STEPS], [0.0; MAX_STEPS], [0.0; MAX_STEPS]);
        self.is_used = true;
    }

    /// Converts the history to steps that are `ratio` times as long, with errors that are larger by `ratio` to the power of `order`.
    /// Coefficients are valid for one step size only, so the last two errors are kept and extrapolated linearly.
    ///
    /// Legend: h_n size of the next step, J_n error of step n divided by the power of its size, at about a quarter of the step.
    ///
    /// ```text
    /// J_n ≈ J_{n-1} + ρ (J_{n-1} - J_{n-2}),   ρ = (h_n + 3 h_{n-1})/(h_{n-1} + 3 h_{n-2})
    /// ```
    pub(crate) fn rescale(&mut self, ratio: f64, order: i32) {
        self.lengths.iter_mut().for_each(|length| *length /= ratio);
        let was_credible =
            self.shares.iter().any(|share| *share != 0.0) || self.coefficients == [0.0; MAX_STEPS];
        let [last, before] = [self.place(0), self.place(1)];
        let factor = ratio.powi(order);
        for missed in &mut self.missed {
            let kept = [missed[last], missed[before]].map(|block| block.map(|value| factor * value));
            *missed = [[0.0; WIDTH]; MAX_STEPS];
            [missed[last], missed[before]] = kept;
        }
        let products = self.products;
        (self.products, self.matrix, self.vector) =
            ([[0.0; MAX_STEPS]; MAX_STEPS], [[0.0; MAX_STEPS]; MAX_STEPS], [0.0; MAX_STEPS]);
        for i in 0..2 {
            for j in 0..2 {
                self.products[i][j] = factor * factor * products[i][j];
            }
        }
        let [one, two] = self.lengths;
        // Only one step size is available before the second step.
        let further = if self.products[1][1] > 0.0 { (1.0 + 3.0 * one) / (one + 3.0 * two) } else { 0.0 };
        (self.coefficients, self.shares) = ([0.0; MAX_STEPS], [0.0; MAX_STEPS]);
        (self.coefficients[0], self.coefficients[1]) = (1.0 + further, -further);
        if was_credible {
            (self.shares[last], self.shares[before]) = (1.0 + further, -further);
        }
        self.is_used = true;
    }

    /// Copies the history of another predictor.
    pub(crate) fn restore(&mut self, from: &Self) {
        self.clone_from(from);
    }

    /// Adds the predicted error to the scheme's extrapolation, given by stage.
    pub(crate) fn improve(&self, guess: &mut [Vec<f64>]) {
        self.processor.0.dispatch(Improve { memory: self, guess });
    }

    /// Records the error of the scheme's extrapolation from the solution, both by stage, and updates the coefficients.
    pub(crate) fn learn<'a>(
        &mut self,
        found: &[Vec<f64>],
        guessed: impl Fn(usize) -> &'a [f64],
        tuning: &Tuning,
    ) {
        let mut products = [0.0; MAX_STEPS + 1];
        let mut first = 0;
        for (stage, found) in found.iter().enumerate() {
            let guessed = guessed(stage);
            let more = self.processor.0.dispatch(Note { memory: self, first, found, guessed });
            for (product, more) in products.iter_mut().zip(more) {
                *product += more;
            }
            first += found.len().div_ceil(WIDTH);
        }
        self.processor.0.dispatch(Learn { memory: self, products, tuning });
    }

    /// |d - Σ c_j d_j|² of a step with error d, from the products of d with earlier errors (`toward`) and with itself (`whole`).
    #[inline(always)]
    fn left(&self, toward: &[f64; MAX_STEPS], whole: f64) -> f64 {
        let mut left = whole;
        for (i, &share) in self.coefficients.iter().enumerate() {
            let predicted: f64 =
                self.coefficients.iter().zip(&self.products[i]).map(|(other, product)| other * product).sum();
            left += share * (predicted - 2.0 * toward[i]);
        }
        left
    }

    /// Ring buffer slot of the error that is `ago` steps older than the latest.
    #[inline(always)]
    fn place(&self, ago: usize) -> usize {
        (self.oldest + MAX_STEPS - 1 - ago) % MAX_STEPS
    }
}

/// Block of eight values, padded with zeros.
#[inline(always)]
fn numbers(of: &[f64], block: usize) -> Block {
    let rest = &of[block * WIDTH..];
    if let Some(block) = rest.first_chunk() {
        return *block;
    }
    let mut block = [0.0; WIDTH];
    block[..rest.len()].copy_from_slice(rest);
    block
}

struct Improve<'a> {
    memory: &'a Predictor,
    guess: &'a mut [Vec<f64>],
}

impl pulp::WithSimd for Improve<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) {
        let shares = self.memory.shares;
        let mut blocks = self.memory.missed.iter();
        for stage in self.guess {
            for (values, missed) in stage.chunks_mut(WIDTH).zip(&mut blocks) {
                let mut missing = [0.0; WIDTH];
                for place in 0..MAX_STEPS {
                    for k in 0..WIDTH {
                        missing[k] += shares[place] * missed[place][k];
                    }
                }
                for (value, missing) in values.iter_mut().zip(missing) {
                    *value += missing;
                }
            }
        }
    }
}

/// Records the errors of one stage, whose first block is `first`. Returns the products of the new errors with the earlier ones, by
/// slot, and with themselves.
struct Note<'a> {
    memory: &'a mut Predictor,
    first: usize,
    found: &'a [f64],
    guessed: &'a [f64],
}

impl pulp::WithSimd for Note<'_> {
    type Output = [f64; MAX_STEPS + 1];

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) -> Self::Output {
        let Note { memory, first, found, guessed } = self;
        let oldest = memory.oldest;
        let mut sums = [[0.0; WIDTH]; MAX_STEPS + 1];
        let blocks = memory.weights[first..].iter().zip(&mut memory.missed[first..]);
        for (block, (weights, missed)) in blocks.enumerate().take(found.len().div_ceil(WIDTH)) {
            let (found, guessed) = (numbers(found, block), numbers(guessed, block));
            let mut latest = [0.0; WIDTH];
            let mut weighted = [0.0; WIDTH];
            for k in 0..WIDTH {
                latest[k] = found[k] - guessed[k];
                weighted[k] = weights[k] * latest[k];
                sums[MAX_STEPS][k] += weighted[k] * latest[k];
            }
            for place in 0..MAX_STEPS {
                for k in 0..WIDTH {
                    sums[place][k] += weighted[k] * missed[place][k];
                }
            }
            missed[oldest] = latest;
        }
        std::array::from_fn(|place| sum(&sums[place]))
    }
}

/// Updates the coefficients for the next step.
struct Learn<'a> {
    memory: &'a mut Predictor,
    products: [f64; MAX_STEPS + 1],
    tuning: &'a Tuning,
}

impl pulp::WithSimd for Learn<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) {
        let Learn { memory, products, tuning } = self;
        let fading = tuning.of(TuningParameter::PredictionFading);
        memory.lengths = [1.0, memory.lengths[0]];
        // The oldest error is still part of these products; it is overwritten afterwards.
        let toward: [f64; MAX_STEPS] = std::array::from_fn(|ago| products[memory.place(ago)]);
        for i in 0..MAX_STEPS {
            memory.vector[i] = fading * memory.vector[i] + toward[i];
            for j in 0..MAX_STEPS {
                memory.matrix[i][j] = fading * memory.matrix[i][j] + memory.products[i][j];
            }
        }
        let is_credible =
            memory.left(&toward, products[MAX_STEPS]) <= CREDIBLE * CREDIBLE * products[MAX_STEPS];
        let before = memory.products;
        memory.products[0][0] = products[MAX_STEPS];
        for i in 1..MAX_STEPS {
            memory.products[0][i] = toward[i - 1];
            memory.products[i][0] = toward[i - 1];
            memory.products[i][1..].copy_from_slice(&before[i - 1][..MAX_STEPS - 1]);
        }
        memory.oldest = (memory.oldest + 1) % MAX_STEPS;
        if memory.is_used {
            memory.coefficients = coefficients(&memory.matrix, &memory.vector, memory.most);
        }
        memory.is_used = !memory.is_used;
        for ago in 0..MAX_STEPS {
            memory.shares[memory.place(ago)] = if is_credible { memory.coefficients[ago] } else { 0.0 };
        }
    }
}

/// Solves the normal equations for the first `most` coefficients by elimination. Coefficients with negligible pivots are zero, as are
/// the others.
#[inline(always)]
fn coefficients(
    matrix: &[[f64; MAX_STEPS]; MAX_STEPS],
    vector: &[f64; MAX_STEPS],
    most: usize,
) -> [f64; MAX_STEPS] {
    let (mut rows, mut values) = (*matrix, *vector);
    let mut solved = [0.0; MAX_STEPS];
    for k in 0..most {
        if rows[k][k] > round_off::PREDICTION * matrix[k][k] {
            let inverse = 1.0 / rows[k][k];
            let (row, value) = (rows[k].map(|entry| entry * inverse), values[k] * inverse);
            for i in 0..MAX_STEPS {
                let factor = rows[i][k];
                for j in 0..MAX_STEPS {
                    rows[i][j] -= factor * row[j];
                }
                values[i] -= factor * value;
            }
            (rows[k], values[k]) = (row, value);
            solved[k] = 1.0;
        }
    }
    let result: [f64; MAX_STEPS] = std::array::from_fn(|k| if solved[k] > 0.0 { values[k] } else { 0.0 });
    if result.iter().all(|value| value.is_finite()) { result } else { [0.0; MAX_STEPS] }
}

#[cfg(test)]
#[path = "../../tests/unit/integrator/predictor.rs"]
mod tests;
