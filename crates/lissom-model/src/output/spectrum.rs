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
mod tests {
    use super::*;

    #[test]
    fn sines_are_found_whatever_the_steps() {
        let value = |t: f64| 5.0 + 0.7 * (TAU * 12.0 * t).sin() + 0.02 * (TAU * 40.0 * t + 1.0).cos();
        let equal: Vec<f64> = (0..=2000).map(|k| 3.0 + 1e-3 * f64::from(k)).collect();
        // Steps that differ by a factor of three.
        let unequal: Vec<f64> = equal.iter().map(|t| t + 0.159 * (TAU * (t - 3.0) / 2.0).sin()).collect();
        for times in [equal, unequal] {
            let values: Vec<f64> = times.iter().map(|t| value(*t)).collect();
            let spectrum = Spectrum::of(&times, &values).unwrap();
            let at = |frequency: f64| {
                let near = |line: &&(f64, f64)| (line.0 - frequency).abs() < 0.1;
                spectrum.lines.iter().find(near).unwrap().1
            };
            assert!((at(12.0) - 0.7).abs() < 2e-3, "{}", at(12.0));
            assert!((at(40.0) - 0.02).abs() < 1e-3, "{}", at(40.0));
            assert!(at(25.0) < 2e-3 && at(1.0) < 2e-3, "{} {}", at(25.0), at(1.0));
            assert!((spectrum.nyquist - 500.0).abs() < 1e-6);
        }
    }

    #[test]
    fn too_little_gives_nothing() {
        assert!(Spectrum::of(&[0.0, 1.0, 2.0], &[1.0; 3]).is_none());
        assert!(Spectrum::of(&[0.0, 1.0, 2.0, 3.0], &[1.0, f64::NAN, 1.0, 1.0]).is_none());
        assert!(Spectrum::of(&[0.0; 4], &[1.0; 4]).is_none());
        assert!(Spectrum::of(&[0.0, 2.0, 1.0, 3.0], &[1.0; 4]).is_none());
    }

    /// Integral over the rows, by trapezoids between neighbouring rows.
    fn integral(times: &[f64], values: impl Fn(usize) -> f64) -> f64 {
        (1..times.len())
            .map(|row| 0.5 * (times[row] - times[row - 1]) * (values(row) + values(row - 1)))
            .sum()
    }

    /// Odd and even numbers of rows, equal and unequal steps, a start that is not zero, a jump at one time.
    #[test]
    fn amplitudes_are_the_windowed_integrals() {
        for rows in [4, 5, 16, 17] {
            for skew in [0.0, 0.3] {
                let mut times: Vec<f64> =
                    (0..rows).map(f64::from).map(|k| 2.5 + 0.2 * k + skew * 0.2 * (1.9 * k).sin()).collect();
                if rows > 6 {
                    times[5] = times[4];
                }
                let values: Vec<f64> =
                    (0..rows).map(f64::from).map(|k| 3.0 + (1.3 * k).sin() + 0.1 * k * k).collect();
                let spectrum = Spectrum::of(&times, &values).unwrap();
                let last = times.len() - 1;
                let duration = times[last] - times[0];
                let window = |row: usize| 1.0 - (TAU * (times[row] - times[0]) / duration).cos();
                let whole = integral(&times, window);
                let mean = integral(&times, |row| window(row) * values[row]) / whole;
                assert!((spectrum.nyquist - 0.5 * last as f64 / duration).abs() < 1e-12);
                assert_eq!(spectrum.lines.len(), last / 2, "{rows} rows");
                assert!((spectrum.end() - (last / 2) as f64 / duration).abs() < 1e-12);
                for (line, &(frequency, amplitude)) in (1..).map(f64::from).zip(&spectrum.lines) {
                    assert!((frequency - line / duration).abs() < 1e-12, "{rows} rows: {frequency}");
                    let part = |phase: f64| {
                        integral(&times, |row| {
                            window(row) * (values[row] - mean) * (TAU * frequency * times[row] + phase).cos()
                        })
                    };
                    let wanted = 2.0 * part(0.0).hypot(part(0.25 * TAU)) / whole;
                    assert!(
                        (amplitude - wanted).abs() < 1e-12,
                        "{rows} rows, line {line}: {amplitude} {wanted}"
                    );
                }
            }
        }
    }

    #[test]
    fn the_number_of_lines_is_limited() {
        let times: Vec<f64> = (0..8100).map(|k| 0.5 * f64::from(k)).collect();
        let values: Vec<f64> = times.iter().map(|time| (3.0 * time).sin()).collect();
        let spectrum = Spectrum::of(&times, &values).unwrap();
        assert_eq!(spectrum.lines.len(), MAX_LINES);
        assert!(spectrum.end() < 0.99 * spectrum.nyquist);
    }

    #[test]
    fn values_beyond_the_times_are_left_out() {
        let times = [0.0, 1.0, 2.0, 3.0, 4.0];
        let of = |count: usize| Spectrum::of(&times[..count], &[1.0, -1.0, 2.0, 0.5, 3.0, 7.0]);
        assert_eq!(of(5), Spectrum::of(&times, &[1.0, -1.0, 2.0, 0.5, 3.0]));
        assert!(of(4).is_some() && of(3).is_none());
    }
}
