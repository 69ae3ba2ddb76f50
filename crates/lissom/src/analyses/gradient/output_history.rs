//! One column along a run: its values, and its derivatives if the measure needs them.

use super::Measure;
use crate::session::Session;

/// Times, values, and derivatives by number of a column.
pub(super) struct OutputHistory {
    measure: Measure,
    times: Vec<f64>,
    values: Vec<f64>,
    /// At the times at which they are needed; none at others.
    derivatives: Vec<Vec<f64>>,
    largest: usize,
}

impl OutputHistory {
    pub(super) fn new(measure: Measure) -> Self {
        Self { measure, times: Vec::new(), values: Vec::new(), derivatives: Vec::new(), largest: 0 }
    }

    /// Steps so far.
    pub(super) fn steps(&self) -> usize {
        self.times.len() - 1
    }

    /// Records the state of `session`. `derivatives` computes those of the column.
    pub(super) fn note(
        &mut self,
        session: &Session,
        column: usize,
        derivatives: &mut dyn FnMut(usize) -> Vec<f64>,
    ) {
        let mut values = Vec::new();
        session.values(&mut values);
        let value = values[column];
        let is_largest = self.values.get(self.largest).is_none_or(|most| value > *most);
        if is_largest {
            self.largest = self.values.len();
        }
        self.times.push(session.progress().time);
        self.values.push(value);
        let is_needed = match self.measure {
            Measure::End | Measure::Time(_) => session.is_finished(),
            Measure::Max => is_largest,
            Measure::Rms => true,
        };
        self.derivatives.push(if is_needed { derivatives(column) } else { Vec::new() });
    }

    /// The largest magnitude of the column.
    pub(super) fn largest(&self) -> f64 {
        self.values.iter().fold(0.0, |most, value| most.max(value.abs()))
    }

    /// Value, its time, and its derivatives.
    pub(super) fn measured(&self) -> (f64, Option<f64>, Vec<f64>) {
        let last = self.steps();
        let at =
            |index: usize| (self.values[index], Some(self.times[index]), self.derivatives[index].clone());
        match self.measure {
            Measure::End | Measure::Time(_) => at(last),
            Measure::Max => at(self.largest),
            Measure::Rms => {
                let duration = self.times[last] - self.times[0];
                let mean = |of: &dyn Fn(usize) -> f64| {
                    let part = |k: usize| 0.5 * (self.times[k + 1] - self.times[k]) * (of(k) + of(k + 1));
                    (0..last).map(part).sum::<f64>() / duration
                };
                let value = mean(&|k| self.values[k].powi(2)).sqrt();
                let of = |number: usize| mean(&|k| self.values[k] * self.derivatives[k][number]) / value;
                let derivatives = (0..self.derivatives[last].len()).map(of).collect();
                (value, None, derivatives)
            }
        }
    }
}
