//! Columns whose values are round-off: beside others of their unit, or beside the size that other units imply.

use super::{Column, Record};

/// Largest round-off beside values of the same unit, and beside sizes that follow from other units.
const SAME_UNIT: f64 = 1e-13;
const OTHER_UNITS: f64 = 1e-10;
/// Values below this have no size in any unit.
const NOTHING: f64 = 1e-30;

impl Record {
    /// Which columns are round-off, and are drawn as zero. Expressions and signals are compared with their own unit only,
    /// because they may be differences.
    pub fn round_off(&self) -> Vec<bool> {
        let most: Vec<f64> = self.values.iter().map(|values| largest(values.iter().copied())).collect();
        let ends = [self.times.first(), self.times.last()].map(|end| end.copied().unwrap_or(0.0));
        round_off(&self.columns, &most, (ends[1] - ends[0], self.times.len()))
    }

    /// Points of a column over time, zero if it is round-off.
    pub(super) fn drawn(&self, column: usize, is_round_off: bool) -> Vec<(f64, f64)> {
        let factor = if is_round_off { 0.0 } else { 1.0 };
        self.times.iter().copied().zip(self.values[column].iter().map(|value| factor * value)).collect()
    }
}

/// Which columns with these largest magnitudes are round-off, with the duration and the number of rows.
pub(super) fn round_off(columns: &[Column], most: &[f64], (duration, rows): (f64, usize)) -> Vec<bool> {
    let sizes = Sizes { columns, most, duration, rows };
    let is_round_off = |(column, most): (&Column, &f64)| {
        // Columns without a unit may be anything.
        let same = if column.unit.is_empty() { 0.0 } else { SAME_UNIT * sizes.of(&column.unit) };
        let is_expression = column.quantity == column.output;
        let implied = if is_expression { 0.0 } else { OTHER_UNITS * sizes.implied(&column.unit) };
        *most <= same.max(implied).max(NOTHING)
    };
    columns.iter().zip(most).map(is_round_off).collect()
}

/// Largest magnitude of finite values.
pub(super) fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.filter(|value| value.is_finite()).fold(0.0, |most, value| value.abs().max(most))
}

/// Largest values of the columns, by unit.
struct Sizes<'a> {
    columns: &'a [Column],
    most: &'a [f64],
    duration: f64,
    rows: usize,
}

impl Sizes<'_> {
    fn of(&self, unit: &str) -> f64 {
        let all = self.columns.iter().zip(self.most);
        all.filter(|(column, _)| column.unit == unit).fold(0.0, |largest, (_, most)| most.max(largest))
    }

    /// The size of a unit that follows from those of other units: a rotation is of the size of one radian. Zero if it is unknown.
    fn implied(&self, unit: &str) -> f64 {
        let length = self.of("m");
        let over = |value: f64, divisor: f64| if divisor > 0.0 { value / divisor } else { 0.0 };
        let per_time = |value: f64| over(value, self.duration);
        match unit {
            "rad" => 1.0,
            // The round-off of angles differs from row to row.
            "rad/s" => per_time(self.rows.saturating_sub(1) as f64),
            "m/s" => per_time(length),
            "m/s²" => per_time(per_time(length)),
            "N" => over(self.of("N m").max(self.of("J")), length),
            "N m" => self.of("J").max(self.of("N") * length),
            "J" => self.of("N m").max(self.of("N") * length),
            "W" => per_time(self.of("J")),
            _ => 0.0,
        }
    }
}

#[cfg(test)]
#[path = "../../tests/unit/output/round_off.rs"]
mod tests;
