//! Functions of time: expressions and tables, as the simulator sees them.
//! Knows neither where they are used nor how they are written in a file.

use std::sync::Arc;

use lissom_core::registry::{Constant, Function, TimeFunction};

use crate::expression::Expression;

impl TimeFunction for Expression {
    fn value(&self, time: f64) -> f64 {
        self.jet(time).value
    }
    fn first_derivative(&self, time: f64) -> f64 {
        self.jet(time).first
    }
    fn second_derivative(&self, time: f64) -> f64 {
        self.jet(time).second
    }
    fn kinks(&self) -> Vec<f64> {
        Self::kinks(self)
    }
}

/// An expression as a shared function of time; one that does not depend on time becomes a [`Constant`].
pub fn of_expression(expression: Expression) -> Function {
    match expression.constant() {
        Some(value) => Arc::new(Constant(value)),
        None => Arc::new(expression),
    }
}

/// How a table is read between its rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// Straight lines: the first derivative jumps at the rows, the second is zero.
    Linear,
    /// Natural cubic spline: continuous second derivative, zero at both ends.
    Spline,
}

/// A table that is no function of time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TableError {
    /// Fewer than two rows.
    #[error("a table needs at least two rows")]
    TooShort,
    /// Times do not ascend from this row to the next.
    #[error("times must ascend strictly, but row {} is not later than row {}", .0 + 2, .0 + 1)]
    NotAscending(usize),
}

/// A table of times and values. Before the first and after the last row the end values hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    times: Vec<f64>,
    values: Vec<f64>,
    /// Second derivatives at the rows; all zero for straight lines.
    curvatures: Vec<f64>,
}

impl Table {
    /// A table of rows `(time [s], value)`.
    ///
    /// # Errors
    /// If there are fewer than two rows, or the times do not ascend strictly.
    pub fn new(rows: &[(f64, f64)], interpolation: Interpolation) -> Result<Self, TableError> {
        if rows.len() < 2 {
            return Err(TableError::TooShort);
        }
        // Written so that a NaN is refused too.
        if let Some(row) = rows.windows(2).position(|pair| !matches!(pair, [a, b] if a.0 < b.0)) {
            return Err(TableError::NotAscending(row));
        }
        let (times, values): (Vec<f64>, Vec<f64>) = rows.iter().copied().unzip();
        let curvatures = match interpolation {
            Interpolation::Linear => vec![0.0; times.len()],
            Interpolation::Spline => natural_curvatures(&times, &values),
        };
        Ok(Self { times, values, curvatures })
    }

    /// Value, first and second derivative at `time`.
    ///
    /// Legend: h length of the interval, a and b the weights of its two ends, y values, m curvatures:
    /// `f = a y₀ + b y₁ + (h²/6)[(a³ - a) m₀ + (b³ - b) m₁]`.
    fn evaluate(&self, time: f64) -> [f64; 3] {
        let last = self.times.len() - 1;
        if time < self.times[0] {
            return [self.values[0], 0.0, 0.0];
        }
        if time > self.times[last] {
            return [self.values[last], 0.0, 0.0];
        }
        let i = self.times.partition_point(|row| *row <= time).clamp(1, last) - 1;
        let (y0, y1) = (self.values[i], self.values[i + 1]);
        let (m0, m1) = (self.curvatures[i], self.curvatures[i + 1]);
        let h = self.times[i + 1] - self.times[i];
        let b = (time - self.times[i]) / h;
        let a = 1.0 - b;
        let value = a * y0 + b * y1 + h * h / 6.0 * ((a * a * a - a) * m0 + (b * b * b - b) * m1);
        let first = (y1 - y0) / h + h / 6.0 * ((3.0 * b * b - 1.0) * m1 - (3.0 * a * a - 1.0) * m0);
        [value, first, a * m0 + b * m1]
    }
}

impl TimeFunction for Table {
    fn value(&self, time: f64) -> f64 {
        self.evaluate(time)[0]
    }
    fn first_derivative(&self, time: f64) -> f64 {
        self.evaluate(time)[1]
    }
    fn second_derivative(&self, time: f64) -> f64 {
        self.evaluate(time)[2]
    }
    fn kinks(&self) -> Vec<f64> {
        if self.curvatures.iter().any(|curvature| *curvature != 0.0) {
            return Vec::new();
        }
        let slope = |i: usize| (self.values[i + 1] - self.values[i]) / (self.times[i + 1] - self.times[i]);
        let jumps = |&i: &usize| {
            let (before, after) = (slope(i - 1), slope(i));
            (after - before).abs() > SAME_SLOPE * before.abs().max(after.abs())
        };
        (1..self.times.len() - 1).filter(jumps).map(|i| self.times[i]).collect()
    }
}

/// Slopes that differ by less than this part are the same but for the digits of a text.
const SAME_SLOPE: f64 = 1e-3;

/// A constant that grows from nothing, in a straight line from the first time to the last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ramp {
    /// Value at the end.
    pub value: f64,
    /// From when to when [s].
    pub span: (f64, f64),
}

impl TimeFunction for Ramp {
    fn value(&self, time: f64) -> f64 {
        let (start, end) = self.span;
        self.value * ((time - start) / (end - start))
    }
    fn first_derivative(&self, _: f64) -> f64 {
        let (start, end) = self.span;
        self.value / (end - start)
    }
    fn second_derivative(&self, _: f64) -> f64 {
        0.0
    }
}

/// Second derivatives of the natural cubic spline: continuity of the first derivative at the inner rows,
/// `h₀ m₀ + 2(h₀ + h₁) m₁ + h₁ m₂ = 6[(y₂ - y₁)/h₁ - (y₁ - y₀)/h₀]`, solved by elimination along the diagonal.
fn natural_curvatures(times: &[f64], values: &[f64]) -> Vec<f64> {
    let n = times.len();
    let step = |i: usize| times[i + 1] - times[i];
    let slope = |i: usize| (values[i + 1] - values[i]) / step(i);
    let (mut upper, mut right) = (vec![0.0; n], vec![0.0; n]);
    for i in 1..n - 1 {
        let pivot = 2.0 * (step(i - 1) + step(i)) - step(i - 1) * upper[i - 1];
        upper[i] = step(i) / pivot;
        right[i] = (6.0 * (slope(i) - slope(i - 1)) - step(i - 1) * right[i - 1]) / pivot;
    }
    for i in (1..n - 1).rev() {
        right[i] -= upper[i] * right[i + 1];
    }
    right
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[test]
    fn a_constant_expression_becomes_a_constant() {
        let read = |text| of_expression(Expression::parse(text, Some("t"), &BTreeMap::new()).unwrap());
        assert_eq!(format!("{:?}", read("2*3")), "Constant(6.0)");
        let drive = read("1.6*(1-cos(2*pi*t/1.6))");
        let rate = std::f64::consts::TAU / 1.6;
        // The tip-crank drive starts with the angular acceleration 1.6 (2π/1.6)² = 24.67 rad/s².
        assert!((drive.second_derivative(0.0) - 1.6 * rate * rate).abs() < 1e-12);
        assert!((drive.second_derivative(0.0) - 24.67).abs() < 5e-3);
        assert_eq!(drive.first_derivative(0.0), 0.0);
    }

    #[test]
    fn straight_lines_pass_through_the_rows_and_hold_the_ends() {
        let table = Table::new(&[(0.0, 1.0), (1.0, 3.0), (3.0, 0.0)], Interpolation::Linear).unwrap();
        for (time, value, first) in [
            (-1.0, 1.0, 0.0),
            (0.0, 1.0, 2.0),
            (0.5, 2.0, 2.0),
            (1.0, 3.0, -1.5),
            (3.0, 0.0, -1.5),
            (4.0, 0.0, 0.0),
        ] {
            assert_eq!((table.value(time), table.first_derivative(time)), (value, first), "{time}");
            assert_eq!(table.second_derivative(time), 0.0);
        }
    }

    #[test]
    fn a_spline_is_exact_for_straight_lines_and_fourth_order_inside() {
        let line = [(0.0, 1.0), (0.5, 2.0), (2.0, 5.0)];
        let spline = Table::new(&line, Interpolation::Spline).unwrap();
        assert!((spline.value(1.3) - 3.6).abs() < 1e-14);
        let sine = |n: usize| -> f64 {
            let at = |i: usize| std::f64::consts::PI * i as f64 / n as f64;
            let rows: Vec<_> = (0..=n).map(|i| (at(i), at(i).sin())).collect();
            // The sine's curvature vanishes at 0 and π, as the natural spline's does.
            let table = Table::new(&rows, Interpolation::Spline).unwrap();
            (0..1000)
                .map(|i| f64::from(i) * 3e-3)
                .map(|t| (table.value(t) - t.sin()).abs())
                .fold(0.0, f64::max)
        };
        let ratio = sine(10) / sine(20);
        assert!((14.0..18.0).contains(&ratio), "{ratio}");
    }

    #[test]
    fn the_derivatives_of_a_spline_are_its_derivatives() {
        let rows = [(0.0, 0.0), (1.0, 2.0), (1.5, -1.0), (4.0, 0.3), (5.0, 0.0)];
        let table = Table::new(&rows, Interpolation::Spline).unwrap();
        let h = 1e-5;
        for i in 1..100 {
            let t = 0.0499 * f64::from(i);
            let first = (table.value(t + h) - table.value(t - h)) / (2.0 * h);
            let second = (table.first_derivative(t + h) - table.first_derivative(t - h)) / (2.0 * h);
            assert!((table.first_derivative(t) - first).abs() < 1e-7, "{t}");
            assert!((table.second_derivative(t) - second).abs() < 2e-4, "{t}");
        }
    }

    #[test]
    fn bad_tables_are_refused() {
        let read = |rows: &[(f64, f64)]| Table::new(rows, Interpolation::Spline);
        assert_eq!(read(&[(0.0, 1.0)]), Err(TableError::TooShort));
        assert_eq!(read(&[(0.0, 1.0), (1.0, 1.0), (1.0, 2.0)]), Err(TableError::NotAscending(1)));
        assert_eq!(read(&[(0.0, 1.0), (f64::NAN, 1.0)]), Err(TableError::NotAscending(0)));
    }
}
