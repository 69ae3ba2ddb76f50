//! Statistics of a history: one number from a column of values over time. A new statistic is a line in
//! [`STATISTICS`].

use serde::{Deserialize, Serialize};

use super::rainflow::{Fatigue, Rainflow};

/// One number of a history.
#[derive(Debug)]
pub struct Statistic {
    /// Word in the sweep file.
    pub name: &'static str,
    /// One sentence.
    pub summary: &'static str,
    of: fn(&Accumulator) -> f64,
}

/// All of them.
pub static STATISTICS: [Statistic; 11] = [
    Statistic { name: "max", summary: "Largest recorded value.", of: |history| history.most.1 },
    Statistic { name: "min", summary: "Smallest recorded value.", of: |history| history.least.1 },
    Statistic {
        name: "max_abs",
        summary: "Largest recorded magnitude.",
        of: |history| history.most.1.max(-history.least.1),
    },
    Statistic {
        name: "time_of_max",
        summary: "Time of the first largest value [s].",
        of: |history| history.most.0,
    },
    Statistic {
        name: "time_of_min",
        summary: "Time of the first smallest value [s].",
        of: |history| history.least.0,
    },
    Statistic {
        name: "mean",
        summary: "Mean over time, by the trapezoidal rule.",
        of: |history| history.means()[0],
    },
    Statistic {
        name: "rms",
        summary: "Root of the mean square over time, by the trapezoidal rule.",
        of: |history| history.means()[1].sqrt(),
    },
    Statistic { name: "initial", summary: "First recorded value.", of: |history| history.first.1 },
    Statistic { name: "final", summary: "Last recorded value.", of: |history| history.last.1 },
    Statistic {
        name: OF_FATIGUE,
        summary: "Damage equivalent range, by rainflow counting, of outputs with `woehler_exponent`.",
        of: Accumulator::damage_equivalent,
    },
    Statistic {
        name: OF_EVENTS,
        summary: "Time at which an event first happens [s].",
        of: |history| history.first.0,
    },
];

/// The statistic of events, whose argument is not a column.
pub(super) const OF_EVENTS: &str = "time_of_event";

/// The statistic of fatigue, of columns whose output has an exponent of Woehler's line.
pub const OF_FATIGUE: &str = "damage_equivalent";

/// The statistic called `name`.
pub(super) fn find(name: &str) -> Option<&'static Statistic> {
    STATISTICS.iter().find(|known| known.name == name)
}

impl Statistic {
    /// Unit of the statistic of a column in `unit`.
    pub fn unit<'u>(&self, unit: &'u str) -> &'u str {
        if self.name.starts_with("time_of_") { "s" } else { unit }
    }

    /// Value of the statistic for a history; none if there is no record, or one that is not finite.
    pub fn of(&self, history: &Accumulator) -> Option<f64> {
        let value = (self.of)(history);
        (history.records > 0 && history.fault.is_none() && value.is_finite()).then_some(value)
    }
}

/// Accumulates the data of all statistics over a history, record by record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Accumulator {
    records: usize,
    first: (f64, f64),
    last: (f64, f64),
    most: (f64, f64),
    least: (f64, f64),
    /// Integrals over time of the value and of its square.
    integrals: [f64; 2],
    fault: Option<f64>,
    fatigue: Option<(Fatigue, Rainflow)>,
}

impl Default for Accumulator {
    fn default() -> Self {
        let nothing = (0.0, 0.0);
        Self {
            records: 0,
            first: nothing,
            last: nothing,
            most: nothing,
            least: nothing,
            integrals: [0.0; 2],
            fault: None,
            fatigue: None,
        }
    }
}

impl Accumulator {
    /// Accumulator of a column whose cycles are counted.
    pub fn with_fatigue(fatigue: Option<Fatigue>) -> Self {
        Self { fatigue: fatigue.map(|fatigue| (fatigue, Rainflow::new(fatigue.exponent))), ..Self::default() }
    }

    /// Adds the value at `time` [s].
    pub fn add(&mut self, time: f64, value: f64) {
        let now = (time, value);
        if !value.is_finite() && self.fault.is_none() {
            self.fault = Some(time);
        }
        if self.records == 0 {
            (self.first, self.last, self.most, self.least) = (now, now, now, now);
        }
        self.records += 1;
        let half = 0.5 * (time - self.last.0);
        self.integrals[0] += half * (self.last.1 + value);
        self.integrals[1] += half * (self.last.1 * self.last.1 + value * value);
        self.last = now;
        if let Some((_, rainflow)) = &mut self.fatigue {
            rainflow.add(value);
        }
        if value > self.most.1 {
            self.most = now;
        }
        if value < self.least.1 {
            self.least = now;
        }
    }

    /// Whether it has no record.
    pub fn is_empty(&self) -> bool {
        self.records == 0
    }

    /// Time of the first value that was not finite, if any [s].
    pub fn fault(&self) -> Option<f64> {
        self.fault
    }

    /// Range of the equivalent cycles; not a number where they are not counted, or the history has no length.
    fn damage_equivalent(&self) -> f64 {
        let Some((fatigue, rainflow)) = &self.fatigue else { return f64::NAN };
        rainflow.equivalent_range(fatigue.cycles.unwrap_or(self.last.0 - self.first.0))
    }

    /// Means over time of the value and of its square.
    fn means(&self) -> [f64; 2] {
        let duration = self.last.0 - self.first.0;
        let value = self.last.1;
        if duration > 0.0 {
            self.integrals.map(|integral| integral / duration)
        } else {
            [value, value * value]
        }
    }
}

#[cfg(test)]
#[path = "../../tests/unit/sweep/statistic.rs"]
mod tests;
