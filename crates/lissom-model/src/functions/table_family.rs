//! Tables over one argument for ascending values of a second one, such as polars of an aerofoil for several Reynolds numbers.

use lissom_mechanics::law::{Enclosure, Interval};
use lissom_mechanics::registry::{ForceFunction, TimeFunction};

use crate::functions::table::Table;

/// Tables over a first argument. Between two of them the values are linear in the second argument; beyond the ends they are constant.
#[derive(Clone, Debug, PartialEq)]
pub struct TableFamily {
    tables: Vec<(f64, Table)>,
}

impl TableFamily {
    /// Tables with ascending values of the second argument; none if there are none, or the values do not ascend strictly.
    pub(crate) fn new(tables: Vec<(f64, Table)>) -> Option<Self> {
        let ascends = tables.windows(2).all(|pair| pair[0].0 < pair[1].0);
        (!tables.is_empty() && ascends).then_some(Self { tables })
    }

    /// Values of the first argument at which its slope jumps; none known for several tables.
    pub(crate) fn kinks(&self) -> Vec<f64> {
        match self.tables.as_slice() {
            [(_, only)] => TimeFunction::breakpoints(only),
            _ => Vec::new(),
        }
    }

    /// Index of the lower one of the two tables between which the second argument is, and the weight of the upper one.
    fn weight(&self, second: f64) -> (usize, f64) {
        let last = self.tables.len() - 1;
        let lower = self.tables.partition_point(|(at, _)| *at <= second).clamp(1, last) - 1;
        let [from, to] = [lower, lower + 1].map(|index| self.tables[index].0);
        (lower, (second - from) / (to - from))
    }
}

impl From<Table> for TableFamily {
    /// One table for all values of the second argument.
    fn from(table: Table) -> Self {
        Self { tables: vec![(0.0, table)] }
    }
}

impl ForceFunction for TableFamily {
    fn evaluate(&self, first: f64, second: f64) -> [f64; 3] {
        if let [(_, only)] = self.tables.as_slice() {
            return ForceFunction::evaluate(only, first, second);
        }
        let (lower, weight) = self.weight(second);
        let inside = weight.clamp(0.0, 1.0);
        let [(from, below), (to, above)] = [lower, lower + 1].map(|index| {
            let (at, table) = &self.tables[index];
            (at, ForceFunction::evaluate(table, first, second))
        });
        let between = |k: usize| (1.0 - inside) * below[k] + inside * above[k];
        let across = if inside == weight { (above[0] - below[0]) / (to - from) } else { 0.0 };
        [between(0), between(1), across]
    }

    fn bounds(&self, first: Interval, second: Interval) -> Option<Interval> {
        if let [(_, only)] = self.tables.as_slice() {
            return ForceFunction::bounds(only, first, second);
        }
        // Between two tables the value is linear in the second argument: its bounds are those at the ends.
        let [(from, low), (to, high)] = second.map(|end| self.weight(end));
        let mut all = [f64::INFINITY, f64::NEG_INFINITY];
        for lower in from..=to {
            let ends = [if lower == from { low } else { 0.0 }, if lower == to { high } else { 1.0 }];
            let weights = ends.map(|weight| weight.clamp(0.0, 1.0));
            // A table without weight does not count.
            let of = |index: usize, counts: bool| {
                let table = &self.tables[index].1;
                if counts { ForceFunction::bounds(table, first, second) } else { Some([0.0; 2]) }
            };
            let below = of(lower, weights.iter().any(|weight| *weight < 1.0))?;
            let above = of(lower + 1, weights.iter().any(|weight| *weight > 0.0))?;
            for weight in weights {
                let [least, most] = [0, 1].map(|k| (1.0 - weight) * below[k] + weight * above[k]);
                all = [all[0].min(least), all[1].max(most)];
            }
        }
        Some(all)
    }

    fn enclosure(&self, first: &Enclosure, second: &Enclosure) -> Option<Enclosure> {
        match self.tables.as_slice() {
            [(_, only)] => ForceFunction::enclosure(only, first, second),
            _ => None,
        }
    }

    fn depends_on_second(&self) -> bool {
        self.tables.len() > 1
    }
}

#[cfg(test)]
#[path = "../../tests/unit/functions/table_family.rs"]
mod tests;
