//! First guesses of a step: the scheme's own, plus what it will miss, extrapolated from what it missed at the
//! steps before. How far back to look is decided by what would have been best at the last steps.
//!
//! ```text
//! d_n  what the scheme's guess missed at step n,   ∇ backward differences over steps of one size
//! guess of order k:  d_{n+1} ≈ Σ_{j<k} ∇^j d_n,    which misses ∇^k d_{n+1}
//! ```

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use super::corrections::{Add, processor};

/// Highest order of extrapolation.
const MOST: usize = 4;
/// What is left of an error at the next step, when orders are compared: one lucky step decides nothing.
const FADING: f64 = 0.5;

/// Numbers that are looked at side by side.
const SIDE_BY_SIDE: usize = 8;

/// Numbers that are guessed together.
#[derive(Clone, Debug)]
pub(crate) struct Guess {
    /// Weight of each number's error.
    weights: Vec<f64>,
    /// ∇^j d of the last step, by number.
    differences: [Vec<f64>; MOST],
    /// What each order has missed of late; the order zero is the scheme's own guess.
    missed: [f64; MOST + 1],
    /// Steps in memory.
    known: usize,
    processor: pulp::Arch,
}

impl Guess {
    /// Nothing in memory, for numbers whose errors have these weights.
    pub(crate) fn new(weights: &[f64]) -> Self {
        Self {
            weights: weights.to_vec(),
            differences: std::array::from_fn(|_| vec![0.0; weights.len()]),
            missed: [0.0; MOST + 1],
            known: 0,
            processor: processor(weights.len()),
        }
    }

    /// Forgets everything: the step size changes, or the motion is interrupted.
    pub(crate) fn forget(&mut self) {
        self.known = 0;
        self.missed = [0.0; MOST + 1];
    }

    /// The order that has missed least.
    fn order(&self) -> usize {
        let orders = 1..=self.known.min(MOST);
        orders.fold(0, |best, order| if self.missed[order] < self.missed[best] { order } else { best })
    }

    /// Adds to the scheme's guess, given stage by stage, what it is expected to miss.
    pub(crate) fn improve(&self, guess: &mut [Vec<f64>]) {
        for differences in &self.differences[..self.order()] {
            let mut first = 0;
            for stage in guess.iter_mut() {
                let corrections = &differences[first..first + stage.len()];
                self.processor.dispatch(Add { share: 1.0, corrections, values: stage });
                first += stage.len();
            }
        }
    }

    /// Takes note of what was found, and so of what the scheme's guess, given by stage, has missed.
    pub(crate) fn learn<'a>(&mut self, found: &[Vec<f64>], guessed: impl Fn(usize) -> &'a [f64]) {
        let depth = self.known.min(MOST);
        let mut errors = [0.0_f64; MOST + 1];
        let mut first = 0;
        for (stage, found) in found.iter().enumerate() {
            let guessed = guessed(stage);
            let missed = self.processor.dispatch(Learn { memory: self, first, found, guessed });
            for (error, missed) in errors.iter_mut().zip(missed) {
                *error = error.max(missed);
            }
            first += found.len();
        }
        for (order, missed) in self.missed.iter_mut().enumerate() {
            // Orders that had no full memory yet are not to be chosen at the next step by their luck.
            let error = if order <= depth { errors[order] } else { f64::INFINITY };
            *missed = if missed.is_finite() { error.max(FADING * *missed) } else { error };
        }
        self.known += 1;
    }

    /// Differences of the numbers from `number` on; raises the errors of each order to theirs.
    #[inline(always)]
    fn note<const COUNT: usize>(
        &mut self,
        number: usize,
        mut difference: [f64; COUNT],
        errors: &mut [[f64; COUNT]; MOST + 1],
    ) {
        let weights: &[f64; COUNT] = numbers(&self.weights, number);
        for order in 0..=MOST {
            for k in 0..COUNT {
                let error = weights[k] * difference[k].abs();
                errors[order][k] = if error > errors[order][k] { error } else { errors[order][k] };
            }
            if order < MOST {
                let kept: &mut [f64; COUNT] =
                    self.differences[order][number..].first_chunk_mut().expect("numbers are counted");
                for k in 0..COUNT {
                    let before = std::mem::replace(&mut kept[k], difference[k]);
                    difference[k] -= before;
                }
            }
        }
    }
}

#[inline(always)]
fn numbers<const COUNT: usize>(of: &[f64], first: usize) -> &[f64; COUNT] {
    of[first..].first_chunk().expect("numbers are counted")
}

/// Takes note of one stage, whose first number is `first`; gives the largest error of each order.
struct Learn<'a> {
    memory: &'a mut Guess,
    first: usize,
    found: &'a [f64],
    guessed: &'a [f64],
}

impl pulp::WithSimd for Learn<'_> {
    type Output = [f64; MOST + 1];

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) -> Self::Output {
        let Learn { memory, first, found, guessed } = self;
        let mut errors = [[0.0; SIDE_BY_SIDE]; MOST + 1];
        let mut last = [[0.0]; MOST + 1];
        let whole = found.len() - found.len() % SIDE_BY_SIDE;
        for k in (0..whole).step_by(SIDE_BY_SIDE) {
            let (found, guessed) = (numbers::<SIDE_BY_SIDE>(found, k), numbers::<SIDE_BY_SIDE>(guessed, k));
            memory.note(first + k, std::array::from_fn(|i| found[i] - guessed[i]), &mut errors);
        }
        for k in whole..found.len() {
            memory.note(first + k, [found[k] - guessed[k]], &mut last);
        }
        std::array::from_fn(|order| errors[order].iter().fold(last[order][0], |most, &error| most.max(error)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn guessed(of: impl Fn(usize) -> f64, steps: usize) -> f64 {
        let mut guess = Guess::new(&[1.0]);
        for step in 0..steps {
            guess.learn(&[vec![of(step)]], |_| &[0.0]);
        }
        let mut value = [vec![0.0]];
        guess.improve(&mut value);
        value[0][0]
    }

    #[test]
    fn polynomials_are_continued() {
        let cubic = |step: usize| 1.0 + 0.1 * (step as f64).powi(3);
        assert!((guessed(cubic, 12) - cubic(12)).abs() < 1e-9);
        assert!((guessed(|step| step as f64, 6) - 6.0).abs() < 1e-12);
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
                let mut guess = Guess::new(&vec![1.0; stages * count]);
                for step in 0..6 {
                    guess.learn(&values(step), |_| &[0.0; 19][..count]);
                }
                let mut next = vec![vec![0.0; count]; stages];
                guess.improve(&mut next);
                assert_eq!(next, values(6), "{stages} {count}");
            }
        }
    }

    #[test]
    fn what_goes_to_and_fro_is_not_extrapolated() {
        let alternating = |step: usize| if step.is_multiple_of(2) { 1.0 } else { -1.0 };
        assert_eq!(guessed(alternating, 20), 0.0);
    }

    #[test]
    fn nothing_is_known_at_the_start() {
        assert_eq!(guessed(|_| 1.0, 0), 0.0);
        let mut guess = Guess::new(&[1.0]);
        for _ in 0..5 {
            guess.learn(&[vec![1.0]], |_| &[0.0]);
        }
        guess.forget();
        let mut value = [vec![0.0]];
        guess.improve(&mut value);
        assert_eq!(value[0], [0.0]);
    }
}
