//! A table over an argument as a function of signals and of local loads, and wind over three.

use std::sync::Arc;

use lissom_mechanics::law::{Enclosure, Interval};
use lissom_mechanics::registry::ForceFunction;
use lissom_mechanics::signals::SignalFunction;

use crate::expression::Line;
use crate::files::wind_box::WindBox;
use crate::functions::table_family::TableFamily;

/// A table over its argument, or tables over its first for values of its second.
#[derive(Debug)]
pub(super) struct OverArgument {
    table: TableFamily,
    breakpoints: Vec<f64>,
}

impl OverArgument {
    /// A table whose first argument is this straight line of time, none if it depends on more than time.
    pub(super) fn new(table: TableFamily, argument: Line) -> Self {
        let mut breakpoints = match argument {
            Some((start, rate)) if rate != 0.0 => {
                let rows = table.kinks().into_iter();
                rows.map(|row| (row - start) / rate).filter(|time| time.is_finite()).collect()
            }
            _ => Vec::new(),
        };
        breakpoints.sort_by(f64::total_cmp);
        Self { table, breakpoints }
    }
}

impl SignalFunction for OverArgument {
    fn value(&self, _: f64, arguments: &[f64], _: &[f64]) -> f64 {
        self.table.evaluate(arguments[0], second(arguments))[0]
    }

    fn gradient(&self, _: f64, arguments: &[f64], _: &[f64], out: &mut [f64]) {
        let [_, slopes @ ..] = self.table.evaluate(arguments[0], second(arguments));
        out.iter_mut().zip(slopes).for_each(|(own, slope)| *own = slope);
    }

    fn bounds(&self, _: Interval, arguments: &[Interval]) -> Option<Interval> {
        self.table.bounds(arguments[0], arguments.get(1).copied().unwrap_or_default())
    }

    fn enclosure(&self, _: &Enclosure, arguments: &[Enclosure]) -> Option<Enclosure> {
        let none = Enclosure::of_constant([0.0; 2]);
        self.table.enclosure(&arguments[0], arguments.get(1).unwrap_or(&none))
    }

    fn breakpoints(&self) -> &[f64] {
        &self.breakpoints
    }
}

/// A component of wind over y, z and time.
#[derive(Debug)]
pub(super) struct OverWind(pub(super) Arc<WindBox>, pub(super) usize);

impl SignalFunction for OverWind {
    fn value(&self, _: f64, arguments: &[f64], _: &[f64]) -> f64 {
        self.0.evaluate(self.1, [arguments[0], arguments[1], arguments[2]])[0]
    }

    fn gradient(&self, _: f64, arguments: &[f64], _: &[f64], out: &mut [f64]) {
        let [_, slopes @ ..] = self.0.evaluate(self.1, [arguments[0], arguments[1], arguments[2]]);
        out.copy_from_slice(&slopes);
    }
}

fn second(arguments: &[f64]) -> f64 {
    arguments.get(1).copied().unwrap_or_default()
}

#[cfg(test)]
#[path = "../../tests/unit/lower/over_argument.rs"]
mod tests;
