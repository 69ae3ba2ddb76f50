//! Takes the rows of a run and keeps what the collected statistics need. No history is stored.

use std::io;

use lissom_model::output::{Column, Writer};
use lissom_model::sweep::{Accumulator, Collected};

use super::SweepError;

/// The columns there may be so many of that naming them all helps nobody.
const FEW: usize = 40;

/// Complains about the first thing to collect that is not among `columns`.
pub(super) fn check(collect: &[Collected], columns: &[Column]) -> Result<(), SweepError> {
    let names: Vec<String> = columns.iter().map(Column::name).collect();
    let Some(missing) = collect.iter().find(|collected| !names.contains(&collected.column)) else {
        return Ok(());
    };
    let known = match names.len() {
        0 => "it has no outputs: add a table [outputs.…]".to_owned(),
        count if count <= FEW => format!("its columns are {}", names.join(", ")),
        count => format!("its {count} columns are named as in the heading of a run's history.csv"),
    };
    Err(SweepError::Column { name: missing.name.clone(), column: missing.column.clone(), known })
}

/// A writer of statistics.
pub(super) struct Collector<'a> {
    collect: &'a [Collected],
    /// Of each thing to collect, the index of its column.
    indices: Vec<usize>,
    histories: Vec<Accumulator>,
}

impl<'a> Collector<'a> {
    pub(super) fn new(collect: &'a [Collected]) -> Self {
        Self { collect, indices: Vec::new(), histories: vec![Accumulator::default(); collect.len()] }
    }

    /// What was collected, or what is wrong with it.
    pub(super) fn values(&self) -> Result<Vec<f64>, String> {
        let value = |(collected, history): (&Collected, &Accumulator)| {
            collected.kind().of(history).ok_or_else(|| match history.fault() {
                Some(time) => format!("`{}` is not a finite number at t = {time:.6e} s", collected.column),
                None => format!("`{}` of `{}` is not a finite number", collected.statistic, collected.column),
            })
        };
        self.collect.iter().zip(&self.histories).map(value).collect()
    }
}

impl Writer for Collector<'_> {
    fn begin(&mut self, columns: &[Column]) -> io::Result<()> {
        let index = |collected: &Collected| {
            let found = columns.iter().position(|column| column.name() == collected.column);
            found.ok_or_else(|| io::Error::other(format!("the model does not record `{}`", collected.column)))
        };
        self.indices = self.collect.iter().map(index).collect::<io::Result<_>>()?;
        Ok(())
    }

    fn row(&mut self, time: f64, values: &[f64]) -> io::Result<()> {
        for (history, index) in self.histories.iter_mut().zip(&self.indices) {
            history.add(time, values[*index]);
        }
        Ok(())
    }

    fn finish(&mut self) -> io::Result<()> {
        Ok(())
    }
}
