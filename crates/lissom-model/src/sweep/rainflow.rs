//! Cycles of a history by rainflow counting, and the range of the cycles of one size that damage as much.
//!
//! Counting as in ASTM E1049-85 (2017), section 5.4.4: X is the newest range between two reversals, Y the one before it. Where X is
//! not less than Y, Y is a cycle, or half a one where it begins at the first reversal there still is. Ranges that remain at the end count half.
//!
//! Legend: S range of a cycle, n how often it counts, m exponent of Woehler's line, N number of cycles of the equivalent range:
//!
//! ```text
//! S_eq = (Σ n S^m / N)^(1/m)
//! ```

use serde::{Deserialize, Serialize};

/// How a history is judged as fatigue.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fatigue {
    /// Exponent of Woehler's line.
    pub exponent: f64,
    /// Number of cycles of the equivalent range; none for one per second of the history.
    pub cycles: Option<f64>,
}

/// Counts cycles while a history is gone through.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Rainflow {
    exponent: f64,
    /// Reversals that belong to no cycle yet; the last one is the latest value, which may not be one.
    reversals: Vec<f64>,
    /// Σ n S^m of the cycles so far.
    damage: f64,
}

impl Rainflow {
    pub(crate) fn new(exponent: f64) -> Self {
        Self { exponent, reversals: Vec::new(), damage: 0.0 }
    }
    /// Adds the next value.
    pub(crate) fn add(&mut self, value: f64) {
        match self.reversals[..] {
            [.., last] if last == value => return,
            [.., before, last] if (last > before) == (value > last) => {
                self.reversals.pop();
            }
            _ => self.close(&mut |_, _| ()),
        }
        self.reversals.push(value);
    }

    /// Counts the cycles closed by the reversals, and passes ranges and counts to `count_cycle`.
    fn close(&mut self, count_cycle: &mut dyn FnMut(f64, f64)) {
        while let [.., a, b, c] = self.reversals[..] {
            let range = (b - a).abs();
            if (c - b).abs() < range {
                break;
            }
            if self.reversals.len() == 3 {
                self.count(range, 0.5, count_cycle);
                self.reversals.remove(0);
            } else {
                self.count(range, 1.0, count_cycle);
                self.reversals.truncate(self.reversals.len() - 3);
                self.reversals.push(c);
            }
        }
    }

    fn count(&mut self, range: f64, count: f64, count_cycle: &mut dyn FnMut(f64, f64)) {
        self.damage += count * range.powf(self.exponent);
        count_cycle(range, count);
    }

    /// Σ n S^m, where remaining ranges count half.
    fn damage(&self, count_cycle: &mut dyn FnMut(f64, f64)) -> f64 {
        let mut rest = self.clone();
        rest.close(count_cycle);
        for pair in std::mem::take(&mut rest.reversals).windows(2) {
            rest.count((pair[1] - pair[0]).abs(), 0.5, count_cycle);
        }
        rest.damage
    }

    /// The range of `cycles` equal cycles that damage as much.
    pub(crate) fn equivalent_range(&self, cycles: f64) -> f64 {
        (self.damage(&mut |_, _| ()) / cycles).powf(self.exponent.recip())
    }
}

#[cfg(test)]
#[path = "../../tests/unit/sweep/rainflow.rs"]
mod tests;
