//! Results as they are drawn: curves of a bounded number of points, however many rows there are. Of every stretch of rows
//! the extremes are kept; where stretches become too many, neighbours are joined.

use std::io;

use super::round_off::{largest, round_off};
use super::{Column, Record, Writer, check_count};

/// Stretches of a curve: twice as many become half of them. A drawing shows fewer.
const STRETCHES: usize = 4096;

/// A point (time, value).
type Point = (f64, f64);

/// The extremes of some consecutive rows, in the order of their times.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Stretch([Point; 2]);

impl Stretch {
    /// Both stretches, one behind the other.
    fn joined(self, other: Self) -> Self {
        let points = [self.0[0], self.0[1], other.0[0], other.0[1]];
        let by_value = |a: &&Point, b: &&Point| a.1.total_cmp(&b.1);
        let first = points[0];
        let least = points.iter().min_by(by_value).copied().unwrap_or(first);
        // Of equal values the first is kept, as for the minimum.
        let most = points.iter().rev().max_by(by_value).copied().unwrap_or(first);
        Self(if least.0 <= most.0 { [least, most] } else { [most, least] })
    }
}

/// Curves of the columns of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CurveRecord {
    columns: Vec<Column>,
    curves: Vec<Vec<Stretch>>,
    /// First and last row.
    ends: Option<[(f64, Vec<f64>); 2]>,
    /// Rows of a whole stretch.
    rows: usize,
    /// Rows of the last stretch.
    begun: usize,
}

impl CurveRecord {
    /// Content of each column.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Sets the contents of the columns: a table read from a file has only their names.
    pub fn set_columns(&mut self, columns: &[Column]) {
        self.columns = columns.to_vec();
    }

    /// The points of a column's curve, in the order of time: all of them where there are few, else the extremes of every
    /// stretch of time, and both ends.
    pub fn points(&self, column: usize) -> Vec<Point> {
        let mut points: Vec<Point> = Vec::new();
        let end = |which: usize| self.ends.as_ref().map(|ends| (ends[which].0, ends[which].1[column]));
        points.extend(end(0));
        for stretch in self.curves.get(column).into_iter().flatten() {
            points.extend(stretch.0);
        }
        points.extend(end(1));
        points.dedup();
        points
    }

    /// Which columns are round-off, as [`Record::round_off`].
    pub(super) fn round_off(&self) -> Vec<bool> {
        let most: Vec<f64> = (0..self.columns.len())
            .map(|column| largest(self.points(column).into_iter().map(|point| point.1)))
            .collect();
        let duration = self.ends.as_ref().map_or(0.0, |[first, last]| last.0 - first.0);
        let rows = self.curves.first().map_or(0, |curve| curve.len() * self.rows);
        round_off(&self.columns, &most, (duration, rows))
    }

    fn push(&mut self, time: f64, values: &[f64]) {
        match &mut self.ends {
            None => self.ends = Some([(time, values.to_vec()), (time, values.to_vec())]),
            Some([_, (last, row)]) => {
                *last = time;
                row.copy_from_slice(values);
            }
        }
        let begins = self.begun == 0;
        for (curve, &value) in self.curves.iter_mut().zip(values) {
            // Values that are not numbers are not drawn; here they would hide the extremes.
            let point = (time, value);
            match curve.last_mut() {
                Some(last) if !begins && !value.is_nan() => {
                    *last = if last.0[0].1.is_nan() {
                        Stretch([point; 2])
                    } else {
                        last.joined(Stretch([point; 2]))
                    };
                }
                Some(_) if !begins => {}
                _ => curve.push(Stretch([point; 2])),
            }
        }
        self.begun += 1;
        if self.begun < self.rows {
            return;
        }
        self.begun = 0;
        if self.curves.first().is_some_and(|curve| curve.len() >= 2 * STRETCHES) {
            self.rows *= 2;
            self.curves.iter_mut().for_each(halve);
        }
    }
}

/// Joins neighbours.
fn halve(curve: &mut Vec<Stretch>) {
    let pairs = curve.chunks(2).map(|pair| match pair {
        [first, second] if first.0[0].1.is_nan() => *second,
        [first, second] if second.0[0].1.is_nan() => *first,
        [first, second] => first.joined(*second),
        pair => pair[0],
    });
    *curve = pairs.collect();
}

impl From<&Record> for CurveRecord {
    fn from(record: &Record) -> Self {
        let mut curves = Self::of(&record.columns);
        for (index, &time) in record.times.iter().enumerate() {
            let row: Vec<f64> = record.values.iter().map(|values| values[index]).collect();
            curves.push(time, &row);
        }
        curves
    }
}

impl CurveRecord {
    fn of(columns: &[Column]) -> Self {
        Self {
            columns: columns.to_vec(),
            curves: vec![Vec::new(); columns.len()],
            ends: None,
            rows: 1,
            begun: 0,
        }
    }
}

impl Writer for CurveRecord {
    fn begin(&mut self, columns: &[Column]) -> io::Result<()> {
        *self = Self::of(columns);
        Ok(())
    }

    fn row(&mut self, time: f64, values: &[f64]) -> io::Result<()> {
        check_count(values, &self.columns)?;
        self.push(time, values);
        Ok(())
    }
}

#[cfg(test)]
#[path = "../../tests/unit/output/curve_record.rs"]
mod tests;
