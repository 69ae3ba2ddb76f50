//! Amplitudes over frequency of a column of results, whose rows need not lie at equal distances.
//!
//! Legend: w Hann's window, T duration, x̄ mean of x under the window.
//!
//! ```text
//! w(t) = 1 - cos 2π(t - t₀)/T,      A(f) = 2 |∫ w (x - x̄) exp(-2πi f t) dt| / ∫ w dt
//! ```
//!
//! Integrals are taken by the trapezoidal rule over the rows as they are. A sine of amplitude a, frequency f and many
//! periods has A(f) = a.

use std::f64::consts::TAU;

/// Most frequencies.
const MAX_LINES: usize = 4000;
/// Most products of rows and frequencies.
const MAX_WORK: usize = 400_000_000;

/// Amplitudes at frequencies that are multiples of 1/T.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// Frequencies [Hz] and amplitudes in the unit of the column.
    pub lines: Vec<(f64, f64)>,
    /// Half the mean frequency of rows [Hz]: nothing is known beyond.
    pub nyquist: f64,
}

impl Spectrum {
    /// Spectrum of values at ascending times; none where there are fewer than four rows, or numbers that are not finite.
    pub fn of(times: &[f64], values: &[f64]) -> Option<Self> {
        let rows = times.len().min(values.len());
        let is_known = times.iter().chain(values).all(|number| number.is_finite());
        let is_ascending = times.windows(2).all(|pair| pair[0] <= pair[1]);
        if rows < 4 || !is_known || !is_ascending {
            return None;
        }
        let (start, duration) = (times[0], times[rows - 1] - times[0]);
        if duration <= 0.0 {
            return None;
        }
        // Weights of the trapezoidal rule times the window.
        let weight = |row: usize| {
            let before = if row > 0 { times[row] - times[row - 1] } else { 0.0 };
            let after = if row + 1 < rows { times[row + 1] - times[row] } else { 0.0 };
            0.5 * (before + after) * (1.0 - (TAU * (times[row] - start) / duration).cos())
        };
        let weights: Vec<f64> = (0..rows).map(weight).collect();
        let whole: f64 = weights.iter().sum();
        let mean = weights.iter().zip(values).map(|(weight, value)| weight * value).sum::<f64>() / whole;
        let nyquist = 0.5 * (rows - 1) as f64 / duration;
        let count = ((rows - 1) / 2).min(MAX_LINES).min((MAX_WORK / rows).max(1));
        let amplitude = |line: usize| {
            let (mut cosines, mut sines) = (0.0, 0.0);
            for ((time, value), weight) in times.iter().zip(values).zip(&weights) {
                let (sine, cosine) = (TAU * line as f64 * ((time - start) / duration)).sin_cos();
                cosines += weight * (value - mean) * cosine;
                sines += weight * (value - mean) * sine;
            }
            (line as f64 / duration, 2.0 * cosines.hypot(sines) / whole)
        };
        Some(Self { lines: (1..=count).map(amplitude).collect(), nyquist })
    }

    /// Largest frequency of the range [Hz].
    pub fn end(&self) -> f64 {
        self.lines.last().map_or(0.0, |line| line.0)
    }
}

#[cfg(test)]
#[path = "../../tests/unit/output/spectrum.rs"]
mod tests;
