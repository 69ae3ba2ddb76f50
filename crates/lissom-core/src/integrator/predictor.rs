//! First guesses of a step: the scheme's own, plus what it will miss, as far as that follows from what it missed at the
//! steps before: linear prediction [Makhoul 1975], with the same coefficients for all numbers. It continues whatever
//! obeys a linear recurrence: polynomials, and the oscillations of stiff members as well, several at once.
//!
//! ```text
//! d_n  what the scheme's guess missed at step n
//! d_{n+1} ≈ Σ_{j<K} c_j d_{n-j},   c = argmin Σ_m φ^m |d_{n-m} - Σ_j c_j d_{n-m-1-j}|²
//! ```
//!
//! After a step that this did not help, as where a motion jumps, the next guess is the scheme's alone.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use serde::{Deserialize, Serialize};

use super::corrections::{Processor, SIDE_BY_SIDE, sum};
use crate::round_off;
use crate::tuning::{Tuning, TuningParameter};

/// Steps that are looked back at most, K.
const MAX_STEPS: usize = 8;
/// A prediction that would have left more than this fraction of what the scheme's own guess missed is not followed: where
/// motion has just jumped, or constraints lose their rank, it leads to other branches.
const CREDIBLE: f64 = 0.5;

type Block = [f64; SIDE_BY_SIDE];

/// Numbers that are guessed together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Predictor {
    /// Squared weight of each number's error, zero beyond the last number of a stage.
    weights: Vec<Block>,
    /// What was missed at the last steps, each at its place in turn.
    missed: Vec<[Block; MAX_STEPS]>,
    /// Where the oldest stands, and the next one goes.
    oldest: usize,
    /// Products of what was missed so many steps ago and so many.
    products: [[f64; MAX_STEPS]; MAX_STEPS],
    /// Left-hand and right-hand sides of the normal equations.
    matrix: [[f64; MAX_STEPS]; MAX_STEPS],
    vector: [f64; MAX_STEPS],
    /// c, by steps ago, and by place.
    coefficients: [f64; MAX_STEPS],
    shares: [f64; MAX_STEPS],
    /// Lengths of the last two steps, in lengths of the next.
    lengths: [f64; 2],
    /// Whether these coefficients have served a step: they serve two.
    is_used: bool,
    /// Steps that are looked back: a few numbers determine few coefficients.
    most: usize,
    #[serde(skip)]
    processor: Processor,
}

impl Predictor {
    /// Nothing in memory, for stages of numbers whose errors have these weights.
    pub(crate) fn new(stages: usize, weights: &[f64]) -> Self {
        let blocks = weights.len().div_ceil(SIDE_BY_SIDE);
        let squares: Vec<f64> = weights.iter().map(|weight| weight * weight).collect();
        let of_stage: Vec<Block> = (0..blocks).map(|block| numbers(&squares, block)).collect();
        Self {
            weights: of_stage.repeat(stages),
            missed: vec![[[0.0; SIDE_BY_SIDE]; MAX_STEPS]; stages * blocks],
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

    /// Forgets everything: the step size changes, or the motion is interrupted.
    pub(crate) fn forget(&mut self) {
        self.missed.fill([[0.0; SIDE_BY_SIDE]; MAX_STEPS]);
        (self.products, self.matrix) = ([[0.0; MAX_STEPS]; MAX_STEPS], [[0.0; MAX_STEPS]; MAX_STEPS]);
        (self.vector, self.coefficients, self.shares) =
            ([0.0; MAX_STEPS], [0.0; MAX_STEPS], [0.0; MAX_STEPS]);
        self.is_used = true;
    }

    /// Goes over to steps that are `ratio` times as long, which miss `ratio` to the power of `order` times as much.
    /// Coefficients belong to steps of one size: of what was missed the last two are kept, and continued in a straight line.
    ///
    /// Legend: h_n size of the next step, J_n what step n misses over the power of its size, found about a quarter after its
    /// start.
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
            *missed = [[0.0; SIDE_BY_SIDE]; MAX_STEPS];
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
        // Before the second step there is one length only.
        let further = if self.products[1][1] > 0.0 { (1.0 + 3.0 * one) / (one + 3.0 * two) } else { 0.0 };
        (self.coefficients, self.shares) = ([0.0; MAX_STEPS], [0.0; MAX_STEPS]);
        (self.coefficients[0], self.coefficients[1]) = (1.0 + further, -further);
        if was_credible {
            (self.shares[last], self.shares[before]) = (1.0 + further, -further);
        }
        self.is_used = true;
    }

    /// Takes over what another one has learned.
    pub(crate) fn restore(&mut self, from: &Self) {
        self.clone_from(from);
    }

    /// Adds to the scheme's guess, given stage by stage, what it is expected to miss.
    pub(crate) fn improve(&self, guess: &mut [Vec<f64>]) {
        self.processor.0.dispatch(Improve { memory: self, guess });
    }

    /// Records the solution, and so the error of the scheme's guess, given by stage.
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
            first += found.len().div_ceil(SIDE_BY_SIDE);
        }
        self.processor.0.dispatch(Learn { memory: self, products, tuning });
    }

    /// |d - Σ c_j d_j|² of a step that has missed d, by the products of d with what was missed before, and with itself.
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

    /// Place of what was missed so many steps before the last one.
    #[inline(always)]
    fn place(&self, ago: usize) -> usize {
        (self.oldest + MAX_STEPS - 1 - ago) % MAX_STEPS
    }
}

/// Eight numbers, zeros beyond the last.
#[inline(always)]
fn numbers(of: &[f64], block: usize) -> Block {
    let rest = &of[block * SIDE_BY_SIDE..];
    if let Some(block) = rest.first_chunk() {
        return *block;
    }
    let mut block = [0.0; SIDE_BY_SIDE];
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
            for (values, missed) in stage.chunks_mut(SIDE_BY_SIDE).zip(&mut blocks) {
                let mut missing = [0.0; SIDE_BY_SIDE];
                for place in 0..MAX_STEPS {
                    for k in 0..SIDE_BY_SIDE {
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

/// Records one stage, whose first block is `first`; returns the products of what was missed now with what was
/// missed before, by place, and with itself.
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
        let mut sums = [[0.0; SIDE_BY_SIDE]; MAX_STEPS + 1];
        let blocks = memory.weights[first..].iter().zip(&mut memory.missed[first..]);
        for (block, (weights, missed)) in blocks.enumerate().take(found.len().div_ceil(SIDE_BY_SIDE)) {
            let (found, guessed) = (numbers(found, block), numbers(guessed, block));
            let mut latest = [0.0; SIDE_BY_SIDE];
            let mut weighted = [0.0; SIDE_BY_SIDE];
            for k in 0..SIDE_BY_SIDE {
                latest[k] = found[k] - guessed[k];
                weighted[k] = weights[k] * latest[k];
                sums[MAX_STEPS][k] += weighted[k] * latest[k];
            }
            for place in 0..MAX_STEPS {
                for k in 0..SIDE_BY_SIDE {
                    sums[place][k] += weighted[k] * missed[place][k];
                }
            }
            missed[oldest] = latest;
        }
        std::array::from_fn(|place| sum(&sums[place]))
    }
}

/// Finds the coefficients for the next step.
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
        // The oldest was looked back at for the last time.
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

/// Solves the normal equations for the first `most` coefficients, the others are zero.
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
mod tests {
    use super::*;

    fn guessed(of: impl Fn(usize) -> f64, steps: usize) -> f64 {
        let mut guess = Predictor::new(1, &[1.0]);
        for step in 0..steps {
            guess.learn(&[vec![of(step)]], |_| &[0.0], &Tuning::default());
        }
        let mut value = [vec![0.0]];
        guess.improve(&mut value);
        value[0][0]
    }

    #[test]
    fn polynomials_are_continued() {
        let cubic = |step: usize| 1.0 + 0.1 * (step as f64).powi(3);
        assert!((guessed(cubic, 40) / cubic(40) - 1.0).abs() < 1e-6);
        assert!((guessed(|step| step as f64, 6) - 6.0).abs() < 1e-6);
    }

    #[test]
    fn each_number_is_continued_alone() {
        let of = |number: usize, step: usize| (number * step) as f64;
        for stages in [1, 2] {
            for count in [1, 7, 8, 19] {
                let values = |step: usize| -> Vec<Vec<f64>> {
                    (0..stages)
                        .map(|stage| (0..count).map(|k| of(stage * count + k, step)).collect())
                        .collect()
                };
                let mut guess = Predictor::new(stages, &vec![1.0; count]);
                for step in 0..6 {
                    guess.learn(&values(step), |_| &[0.0; 19][..count], &Tuning::default());
                }
                let mut next = vec![vec![0.0; count]; stages];
                guess.improve(&mut next);
                for (next, value) in next.iter().flatten().zip(values(6).iter().flatten()) {
                    assert!((next - value).abs() <= 1e-6 * value, "{stages} {count}: {next} {value}");
                }
            }
        }
    }

    #[test]
    fn oscillations_are_continued() {
        let alternating = |step: usize| if step.is_multiple_of(2) { 1.0 } else { -1.0 };
        assert!((guessed(alternating, 20) - 1.0).abs() < 1e-9);
        // Two frequencies that two numbers have different shares of.
        let of = |step: f64| vec![(0.9 * step).cos() + (2.2 * step).sin(), (0.9 * step + 0.3).cos()];
        let mut guess = Predictor::new(1, &[1.0, 3.0]);
        for step in 0..40 {
            guess.learn(&[of(f64::from(step))], |_| &[0.0, 0.0], &Tuning::default());
        }
        let mut next = [vec![0.0, 0.0]];
        guess.improve(&mut next);
        for (next, value) in next[0].iter().zip(of(40.0)) {
            assert!((next - value).abs() < 1e-6, "{next} {value}");
        }
    }

    #[test]
    fn what_is_missed_goes_over_to_steps_of_other_sizes() {
        // Two stages that miss h³ (10 + t + h/4) and eight times that.
        let miss = |time: f64, size: f64| size.powi(3) * (10.0 + time + 0.25 * size);
        let mut guess = Predictor::new(2, &[1.0; 9]);
        let (mut time, mut size) = (0.0, 1.0);
        for next in [1.0, 1.0, 0.5, 0.3, 1.5, 1.0] {
            let found = miss(time, size);
            guess.learn(&[vec![found; 9], vec![8.0 * found; 9]], |_| &[0.0; 9], &Tuning::default());
            time += size;
            guess.rescale(next / size, 3);
            size = next;
            if time > 1.5 {
                let mut values = [vec![0.0; 9], vec![0.0; 9]];
                guess.improve(&mut values);
                let expected = miss(time, size);
                assert!(values[0].iter().all(|value| (value - expected).abs() < 1e-12 * expected));
                assert!((values[1][8] - 8.0 * expected).abs() < 1e-11 * expected, "{values:?} {expected}");
            }
        }
    }

    #[test]
    fn nothing_is_continued_after_a_jump() {
        let jumping = |step: usize| if step == 12 { -1000.0 } else { step as f64 };
        assert_eq!(guessed(jumping, 13), 0.0);
        assert!((guessed(jumping, 12) - 12.0).abs() < 1e-6);
        assert!((guessed(jumping, 60) - 60.0).abs() < 1e-3);
    }

    #[test]
    fn nothing_is_known_at_the_start() {
        assert_eq!(guessed(|_| 1.0, 0), 0.0);
        let mut guess = Predictor::new(1, &[1.0]);
        for _ in 0..5 {
            guess.learn(&[vec![1.0]], |_| &[0.0], &Tuning::default());
        }
        guess.forget();
        let mut value = [vec![0.0]];
        guess.improve(&mut value);
        assert_eq!(value[0], [0.0]);
    }
}
