//! Tables of rows (argument, value), interpolated: functions of time, and forces over an elongation.

use lissom_mechanics::law::{EVERYTHING, Interval, hull};
use lissom_mechanics::registry::{ForceFunction, TimeFunction};

/// How a table is read between its rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// Straight lines: the first derivative jumps at the rows, the second is zero.
    Linear,
    /// Natural cubic spline: continuous second derivative, zero at both ends.
    Spline,
    /// Cubic polynomials that rise and fall with the rows: continuous first derivative, no overshoot.
    Monotone,
}

/// Extrapolation of a table before its first and after its last row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extrapolation {
    /// Constant, with the values of the ends.
    Constant,
    /// Straight lines with the slopes at the ends.
    Linear,
    /// The rows again and again: the last one is the first of the next period.
    Periodic,
}

/// A table that is no function of time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TableError {
    /// Fewer than two rows.
    #[error("a table needs at least two rows")]
    TooShort,
    /// Times do not ascend from this row to the next.
    #[error("the first column must ascend, but row {} is before row {}", .0 + 2, .0 + 1)]
    NotAscending(usize),
    /// This row and the next have the same time.
    #[error("rows {} and {} have the same argument", .0 + 1, .0 + 2)]
    Repeated(usize),
    /// A number is not finite in this row.
    #[error("row {} has a number that is not finite", .0 + 1)]
    NotFinite(usize),
    /// A periodic table ends with another value than it begins with.
    #[error("after a period it must have the value of its first row")]
    NotClosed,
    /// The rows of a periodic table are longer than the period.
    #[error("its rows are longer than its period")]
    TooLong,
}

impl TableError {
    /// What to change.
    pub(crate) fn remedy(self) -> &'static str {
        match self {
            Self::TooShort => "write at least two rows [argument, value]",
            Self::NotAscending(_) => "sort the rows by their first column",
            Self::Repeated(_) => {
                "remove one of them; a jump needs an expression, such as `step(t - 2)`, or two arguments close to each other"
            }
            Self::NotFinite(_) => "write finite numbers",
            Self::NotClosed => "let the last row have the value of the first one",
            Self::TooLong => "give a longer `period`, or remove rows",
        }
    }
}

/// A table of arguments and values.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    arguments: Vec<f64>,
    values: Vec<f64>,
    between: Between,
    extrapolation: Extrapolation,
    /// Whether arguments beyond the rows are to be reported.
    is_bounded: bool,
}

/// Coefficients of a polynomial between two rows.
#[derive(Clone, Debug, PartialEq)]
enum Between {
    Lines,
    /// Second derivatives at the rows.
    Curvatures(Vec<f64>),
    /// First derivatives at the rows.
    Slopes(Vec<f64>),
}

impl Table {
    /// A table of rows (argument, value).
    ///
    /// # Errors
    /// If there are fewer than two rows, or the arguments do not ascend strictly, or a number is not finite.
    pub fn new(
        rows: &[(f64, f64)],
        interpolation: Interpolation,
        extrapolation: Extrapolation,
    ) -> Result<Self, TableError> {
        if rows.len() < 2 {
            return Err(TableError::TooShort);
        }
        if let Some(row) = rows.iter().position(|(x, y)| !(x.is_finite() && y.is_finite())) {
            return Err(TableError::NotFinite(row));
        }
        // A row that is out of order is the cause where a repeated argument may be its consequence.
        if let Some(row) = rows.windows(2).position(|pair| pair[0].0 > pair[1].0) {
            return Err(TableError::NotAscending(row));
        }
        if let Some(row) = rows.windows(2).position(|pair| pair[0].0 == pair[1].0) {
            return Err(TableError::Repeated(row));
        }
        let (arguments, values): (Vec<f64>, Vec<f64>) = rows.iter().copied().unzip();
        let between = |arguments: &[f64], values: &[f64]| match interpolation {
            Interpolation::Linear => Between::Lines,
            Interpolation::Spline => Between::Curvatures(natural_curvatures(arguments, values)),
            Interpolation::Monotone => Between::Slopes(monotone_slopes(arguments, values)),
        };
        let between = if extrapolation == Extrapolation::Periodic {
            let last = rows.len() - 1;
            if values[last] != values[0] {
                return Err(TableError::NotClosed);
            }
            // Of rows that are repeated on both sides, the inner ones know nothing of the ends.
            let beyond = REPEATED.div_ceil(last);
            let period = arguments[last] - arguments[0];
            let repeated = (0..=2 * beyond).flat_map(|turn| {
                let shift = (turn as f64 - beyond as f64) * period;
                rows[..last].iter().map(move |row| (row.0 + shift, row.1))
            });
            let (all, repeated): (Vec<f64>, Vec<f64>) = repeated.unzip();
            let own = beyond * last..=(beyond + 1) * last;
            match between(&all, &repeated) {
                Between::Lines => Between::Lines,
                Between::Curvatures(found) => Between::Curvatures(found[own].to_vec()),
                Between::Slopes(found) => Between::Slopes(found[own].to_vec()),
            }
        } else {
            between(&arguments, &values)
        };
        Ok(Self { arguments, values, between, extrapolation, is_bounded: false })
    }

    /// A table that repeats itself after `period`: its rows are those of one period, with or without the first one of the next.
    ///
    /// # Errors
    /// As [`new`](Self::new), and if the rows do not fit the period.
    pub fn periodic(
        rows: &[(f64, f64)],
        interpolation: Interpolation,
        period: f64,
    ) -> Result<Self, TableError> {
        let (Some(first), Some(last)) = (rows.first(), rows.last()) else { return Err(TableError::TooShort) };
        let (end, mut rows) = ((first.0 + period, first.1), rows.to_vec());
        if (last.0 - end.0).abs() <= ROUNDED * period {
            let largest = rows.iter().fold(0.0_f64, |most, row| most.max(row.1.abs()));
            if (last.1 - end.1).abs() > ROUNDED * largest {
                return Err(TableError::NotClosed);
            }
            rows.pop();
        } else if last.0 > end.0 {
            return Err(TableError::TooLong);
        }
        rows.push(end);
        Self::new(&rows, interpolation, Extrapolation::Periodic)
    }

    /// A table with arguments beyond the rows to be reported: their values were not chosen.
    #[must_use]
    pub fn bounded(self) -> Self {
        Self { is_bounded: self.extrapolation != Extrapolation::Periodic, ..self }
    }

    /// First and last argument.
    fn ends(&self) -> Interval {
        [self.arguments[0], self.arguments[self.arguments.len() - 1]]
    }

    /// The interval by whole periods closer to the rows, so that it begins among them; the same one if the table is not periodic.
    fn reduced(&self, [from, to]: Interval) -> Interval {
        let [first, last] = self.ends();
        let turns = match self.extrapolation {
            Extrapolation::Periodic => ((from - first) / (last - first)).floor() * (last - first),
            Extrapolation::Constant | Extrapolation::Linear => 0.0,
        };
        [from - turns, to - turns]
    }

    /// Value, first and second derivative.
    fn evaluate(&self, argument: f64) -> [f64; 3] {
        let [argument, _] = self.reduced([argument; 2]);
        let [first, last] = self.ends();
        let inside = argument.clamp(first, last);
        if inside != argument {
            let [value, slope, _] = self.inside(inside);
            return match self.extrapolation {
                Extrapolation::Constant => [value, 0.0, 0.0],
                Extrapolation::Linear => [value + slope * (argument - inside), slope, 0.0],
                // By round-off.
                Extrapolation::Periodic => self.inside(inside),
            };
        }
        self.inside(argument)
    }

    /// Legend: h length of the interval, a and b the weights of its two ends, y values, m curvatures, d slopes:
    ///
    /// ```text
    /// f = a y₀ + b y₁ + (h²/6)[(a³ - a) m₀ + (b³ - b) m₁]          or
    /// f = a y₀ + b y₁ + h a b [a (d₀ - s) - b (d₁ - s)],      s = (y₁ - y₀)/h
    /// ```
    fn inside(&self, argument: f64) -> [f64; 3] {
        let last = self.arguments.len() - 1;
        let i = self.arguments.partition_point(|row| *row <= argument).clamp(1, last) - 1;
        let (y0, y1) = (self.values[i], self.values[i + 1]);
        let h = self.arguments[i + 1] - self.arguments[i];
        let b = (argument - self.arguments[i]) / h;
        let a = 1.0 - b;
        let (line, slope) = (a * y0 + b * y1, (y1 - y0) / h);
        match &self.between {
            Between::Lines => [line, slope, 0.0],
            Between::Curvatures(curvatures) => {
                let (m0, m1) = (curvatures[i], curvatures[i + 1]);
                let value = line + h * h / 6.0 * ((a * a * a - a) * m0 + (b * b * b - b) * m1);
                let first = slope + h / 6.0 * ((3.0 * b * b - 1.0) * m1 - (3.0 * a * a - 1.0) * m0);
                [value, first, a * m0 + b * m1]
            }
            Between::Slopes(slopes) => {
                let (p, q) = (slopes[i] - slope, slopes[i + 1] - slope);
                let value = line + h * a * b * (a * p - b * q);
                let first = slope + a * (a - 2.0 * b) * p + b * (b - 2.0 * a) * q;
                [value, first, ((6.0 * b - 4.0) * p + (6.0 * b - 2.0) * q) / h]
            }
        }
    }

    /// Bounds of the value between two arguments: those at their ends and at the rows between, and by how much cubic
    /// polynomials depart from straight lines, h²/8 times the largest curvature.
    fn bounds(&self, from: f64, to: f64) -> [f64; 2] {
        let ([from, to], [begin, over]) = (self.reduced([from, to]), self.ends());
        if self.extrapolation == Extrapolation::Periodic && to > over {
            let period = over - begin;
            return if to - from >= period {
                self.bounds_inside(begin, over)
            } else {
                hull(&[self.bounds_inside(from, over), self.bounds_inside(begin, to - period)].concat())
            };
        }
        self.bounds_inside(from, to)
    }

    fn bounds_inside(&self, from: f64, to: f64) -> [f64; 2] {
        let mut bounds = [f64::INFINITY, f64::NEG_INFINITY];
        let mut include = |value: f64| bounds = [bounds[0].min(value), bounds[1].max(value)];
        for end in [from, to] {
            include(self.evaluate(end)[0]);
        }
        let last = self.arguments.len() - 1;
        let [first, end] = [from, to]
            .map(|argument| self.arguments.partition_point(|row| *row <= argument).clamp(1, last) - 1);
        for i in first..=end {
            let span = [self.arguments[i].max(from), self.arguments[i + 1].min(to)];
            if span[0] >= span[1] {
                continue;
            }
            let h = self.arguments[i + 1] - self.arguments[i];
            let curvature = match &self.between {
                Between::Lines => 0.0,
                Between::Curvatures(curvatures) => curvatures[i].abs().max(curvatures[i + 1].abs()),
                Between::Slopes(slopes) => {
                    let slope = (self.values[i + 1] - self.values[i]) / h;
                    let (p, q) = (slopes[i] - slope, slopes[i + 1] - slope);
                    (4.0 * p + 2.0 * q).abs().max((2.0 * p + 4.0 * q).abs()) / h
                }
            };
            let beyond = 0.125 * (span[1] - span[0]).powi(2) * curvature;
            for at in span {
                // Within the interval, whose end belongs to the next one.
                let value = self.evaluate(at)[0];
                include(value - beyond);
                include(value + beyond);
            }
        }
        bounds
    }

    /// Bounds of the second derivative between two arguments, if no row is between them: it is a straight line there.
    fn curvature(&self, ends: Interval) -> Interval {
        let ends = self.reduced(ends);
        let [first, last] = ends.map(|end| self.arguments.partition_point(|row| *row <= end));
        if first == last { hull(&ends.map(|end| self.evaluate(end)[2])) } else { EVERYTHING }
    }

    /// Inner rows, and the end rows beyond which the slope is another.
    fn breakpoint_rows(&self) -> Vec<f64> {
        if self.between != Between::Lines {
            return Vec::new();
        }
        let slope =
            |i: usize| (self.values[i + 1] - self.values[i]) / (self.arguments[i + 1] - self.arguments[i]);
        let jumps = |&i: &usize| {
            let (before, after) = (slope(i - 1), slope(i));
            (after - before).abs() > SAME_SLOPE * before.abs().max(after.abs())
        };
        (1..self.arguments.len() - 1).filter(jumps).map(|i| self.arguments[i]).collect()
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
    fn jet(&self, time: f64) -> [f64; 3] {
        self.evaluate(time)
    }
    fn breakpoints(&self) -> Vec<f64> {
        self.breakpoint_rows()
    }
    fn domain(&self) -> Option<Interval> {
        self.is_bounded.then(|| self.ends())
    }
    fn bounds(&self, from: f64, to: f64) -> Option<[f64; 2]> {
        Some(self.bounds(from, to))
    }
    fn curvature(&self, from: f64, to: f64) -> Option<[f64; 2]> {
        Some(self.curvature([from, to]))
    }
}

/// Over the first quantity alone.
impl ForceFunction for Table {
    fn evaluate(&self, first: f64, _: f64) -> [f64; 3] {
        let [value, slope, _] = Table::evaluate(self, first);
        [value, slope, 0.0]
    }

    fn bounds(&self, [from, to]: Interval, _: Interval) -> Option<Interval> {
        Some(Table::bounds(self, from, to))
    }

    fn breakpoints(&self) -> Vec<f64> {
        // Every row: the integral of a polynomial between two of them is exact.
        self.arguments.clone()
    }
}

/// Deviation of the last row of a period, relative to the period and to the largest value: digits of a text.
const ROUNDED: f64 = 1e-6;
/// Rows after which the end of a spline has no influence: it falls to a quarter with each of them.
const REPEATED: usize = 30;
/// Slopes that differ by less than this fraction are the same except for the digits of a text.
const SAME_SLOPE: f64 = 1e-3;

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

/// Slopes at the rows of cubic polynomials that are monotone where the rows are [Fritsch and Butland 1984]: zero at
/// extrema, between the slopes of the neighbouring intervals elsewhere.
fn monotone_slopes(arguments: &[f64], values: &[f64]) -> Vec<f64> {
    let n = arguments.len();
    let step = |i: usize| arguments[i + 1] - arguments[i];
    let slope = |i: usize| (values[i + 1] - values[i]) / step(i);
    if n == 2 {
        return vec![slope(0); 2];
    }
    let inner = |i: usize| {
        let (before, after) = (slope(i - 1), slope(i));
        if before * after <= 0.0 {
            return 0.0;
        }
        let (w0, w1) = (2.0 * step(i) + step(i - 1), step(i) + 2.0 * step(i - 1));
        (w0 + w1) / (w0 / before + w1 / after)
    };
    // At the ends the parabola through three rows, limited so that the polynomial stays monotone.
    let end = |h0: f64, h1: f64, s0: f64, s1: f64| {
        let slope = ((2.0 * h0 + h1) * s0 - h0 * s1) / (h0 + h1);
        if slope * s0 <= 0.0 {
            0.0
        } else if s0 * s1 <= 0.0 && slope.abs() > 3.0 * s0.abs() {
            3.0 * s0
        } else {
            slope
        }
    };
    let mut slopes = vec![end(step(0), step(1), slope(0), slope(1))];
    slopes.extend((1..n - 1).map(inner));
    slopes.push(end(step(n - 2), step(n - 3), slope(n - 2), slope(n - 3)));
    slopes
}
