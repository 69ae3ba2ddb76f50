//! A table over an argument as a function of signals and of local loads.

use lissom_mechanics::law::{Enclosure, Interval};
use lissom_mechanics::registry::ForceFunction;
use lissom_mechanics::signals::SignalFunction;

use crate::expression::Line;
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

fn second(arguments: &[f64]) -> f64 {
    arguments.get(1).copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::functions::table::{Extrapolation, Interpolation, Table};

    #[test]
    fn rows_are_breakpoints_where_the_argument_is_a_line_of_time() {
        let rows = [(0.0, 0.0), (1.0, 2.0), (2.0, 1.0), (3.0, 1.0)];
        let over = |interpolation, line| {
            OverArgument::new(Table::new(&rows, interpolation, Extrapolation::Constant).unwrap().into(), line)
        };
        assert_eq!(over(Interpolation::Linear, Some((3.0, -0.5))).breakpoints(), [2.0, 4.0]);
        for (interpolation, line) in [
            (Interpolation::Linear, None),
            (Interpolation::Linear, Some((1.0, 0.0))),
            (Interpolation::Spline, Some((0.0, 1.0))),
        ] {
            assert!(over(interpolation, line).breakpoints().is_empty(), "{interpolation:?}");
        }
        let mut slope = [0.0];
        over(Interpolation::Linear, None).gradient(0.0, &[1.5], &[], &mut slope);
        assert_eq!(slope, [-1.0]);
    }
}
