//! First guesses of a step: the scheme's own, plus what it will miss, extrapolated from what it missed at the
//! steps before. How far back to look is decided by what would have been best at the last steps.
//!
//! ```text
//! d_n  what the scheme's guess missed at step n,   ∇ backward differences over steps of one size
//! guess of order k:  d_{n+1} ≈ Σ_{j<k} ∇^j d_n,    which misses ∇^k d_{n+1}
//! ```

/// Highest order of extrapolation.
const MOST: usize = 4;
/// What is left of an error at the next step, when orders are compared: one lucky step decides nothing.
const FADING: f64 = 0.5;

/// Numbers that are guessed together.
#[derive(Clone, Debug)]
pub(crate) struct Guess {
    /// ∇^j d of the last step, by number.
    differences: [Vec<f64>; MOST],
    /// What each order has missed of late; the order zero is the scheme's own guess.
    missed: [f64; MOST + 1],
    /// Steps in memory.
    known: usize,
}

impl Guess {
    /// Nothing in memory, for `count` numbers.
    pub(crate) fn new(count: usize) -> Self {
        Self { differences: std::array::from_fn(|_| vec![0.0; count]), missed: [0.0; MOST + 1], known: 0 }
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

    /// Adds to the scheme's guess, given from number `first` on, what it is expected to miss.
    pub(crate) fn improve(&self, first: usize, guess: &mut [f64]) {
        for differences in &self.differences[..self.order()] {
            for (value, difference) in guess.iter_mut().zip(&differences[first..]) {
                *value += difference;
            }
        }
    }

    /// Takes note of what the scheme's guess has missed; `weigh` gives the weight of a number's error.
    pub(crate) fn learn(&mut self, missed: impl Iterator<Item = f64>, weigh: impl Fn(usize) -> f64) {
        let mut errors = [0.0_f64; MOST + 1];
        let depth = self.known.min(MOST);
        for (number, mut difference) in missed.enumerate() {
            let weight = weigh(number);
            for order in 0..MOST {
                errors[order] = errors[order].max(weight * difference.abs());
                let before = std::mem::replace(&mut self.differences[order][number], difference);
                difference -= before;
            }
            errors[MOST] = errors[MOST].max(weight * difference.abs());
        }
        for (order, missed) in self.missed.iter_mut().enumerate() {
            // Orders that had no full memory yet are not to be chosen at the next step by their luck.
            let error = if order <= depth { errors[order] } else { f64::INFINITY };
            *missed = if missed.is_finite() { error.max(FADING * *missed) } else { error };
        }
        self.known += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn guessed(of: impl Fn(usize) -> f64, steps: usize) -> f64 {
        let mut guess = Guess::new(1);
        for step in 0..steps {
            guess.learn(std::iter::once(of(step)), |_| 1.0);
        }
        let mut value = [0.0];
        guess.improve(0, &mut value);
        value[0]
    }

    #[test]
    fn polynomials_are_continued() {
        let cubic = |step: usize| 1.0 + 0.1 * (step as f64).powi(3);
        assert!((guessed(cubic, 12) - cubic(12)).abs() < 1e-9);
        assert!((guessed(|step| step as f64, 6) - 6.0).abs() < 1e-12);
    }

    #[test]
    fn what_goes_to_and_fro_is_not_extrapolated() {
        let alternating = |step: usize| if step.is_multiple_of(2) { 1.0 } else { -1.0 };
        assert_eq!(guessed(alternating, 20), 0.0);
    }

    #[test]
    fn nothing_is_known_at_the_start() {
        assert_eq!(guessed(|_| 1.0, 0), 0.0);
        let mut guess = Guess::new(1);
        for _ in 0..5 {
            guess.learn(std::iter::once(1.0), |_| 1.0);
        }
        guess.forget();
        let mut value = [0.0];
        guess.improve(0, &mut value);
        assert_eq!(value, [0.0]);
    }
}
