//! Receives the rows of a run and stores the data of the collected statistics, and requested histories.

use std::io;

use lissom_model::Document;
use lissom_model::output::{Column, Writer};
use lissom_model::sweep::{
    Accumulator, Collected, OF_FATIGUE, SweepFile, TimeWindow, WindowContext, WindowError, WindowedHistory,
};

use super::SweepError;
use crate::encodings::parquet::{Values, parquet};

/// Maximum number of columns that are listed in a message.
const FEW: usize = 40;

/// Reports the first collected item that is not among `columns`.
pub(super) fn check(file: &SweepFile, columns: &[Column], events: &[&str]) -> Result<(), SweepError> {
    let names: Vec<String> = columns.iter().map(Column::name).collect();
    let of_events = file.collect.iter().filter(|collected| collected.is_of_event());
    if let Some(missing) =
        of_events.into_iter().find(|collected| !events.contains(&collected.column.as_str()))
    {
        let known = match events {
            [] => "it has no events: add a table [events.…]".to_owned(),
            known => format!("its events are {}", known.join(", ")),
        };
        return Err(SweepError::Event { name: missing.name.clone(), event: missing.column.clone(), known });
    }
    let collected = file.collect.iter().filter(|collected| !collected.is_of_event());
    let wanted = collected.map(|collected| (&collected.name, &collected.column));
    let all = wanted.chain(file.histories.iter().map(|column| (column, column)));
    let uncounted = file.collect.iter().find(|collected| {
        let own = Column::named(columns, &collected.column).map(|index| &columns[index]);
        collected.statistic == OF_FATIGUE && own.is_some_and(|column| column.fatigue.is_none())
    });
    if let Some(collected) = uncounted {
        let (name, column) = (collected.name.clone(), collected.column.clone());
        return Err(SweepError::NoExponent { name, column });
    }
    let Some((name, column)) = all.into_iter().find(|(_, column)| Column::named(columns, column).is_none())
    else {
        return Ok(());
    };
    let known = match names.len() {
        0 => "it has no outputs: add a table [outputs.…]".to_owned(),
        count if count <= FEW => format!("its columns are {}", names.join(", ")),
        count => format!("its {count} columns have the names in the heading of a run's history.csv"),
    };
    Err(SweepError::Column { name: name.clone(), column: column.clone(), known })
}

/// The windows of all collected items with the numbers of `document`, or the first item whose window cannot be used.
pub(super) fn windows<'f>(
    file: &'f SweepFile,
    document: &Document,
) -> Result<Vec<TimeWindow>, (&'f Collected, WindowError)> {
    let context = WindowContext {
        events: &document.event_names(),
        parameters: &document.parameters,
        start: document.analysis.start,
        end: document.analysis.end,
    };
    let of =
        |collected: &'f Collected| collected.window.resolve(&context).map_err(|error| (collected, error));
    file.collect.iter().map(of).collect()
}

/// The whole histories of some columns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History {
    /// Times of the records [s].
    pub times: Vec<f64>,
    /// Names of the columns, and their values, one per record.
    pub columns: Vec<(String, Vec<f64>)>,
}

impl History {
    /// The histories of `member` as a Parquet file with the columns `member`, `time` and the requested ones.
    ///
    /// # Errors
    /// If they exceed the limits of the format.
    pub fn parquet(&self, member: usize) -> io::Result<Vec<u8>> {
        let number = i64::try_from(member).unwrap_or(i64::MAX);
        let mut columns = vec![
            ("member".to_owned(), Values::Whole(vec![number; self.times.len()])),
            ("time".to_owned(), Values::Numbers(self.times.clone())),
        ];
        columns.extend(
            self.columns.iter().map(|(name, values)| (name.clone(), Values::Numbers(values.clone()))),
        );
        parquet(&columns, &[])
    }
}

/// A writer of statistics.
pub(super) struct Collector<'a> {
    file: &'a SweepFile,
    /// For each collected item, the index of its column; none for an event.
    indices: Vec<Option<usize>>,
    windows: Vec<TimeWindow>,
    histories: Vec<WindowedHistory>,
    /// Indices of the stored columns.
    kept_indices: Vec<usize>,
    kept: History,
}

impl<'a> Collector<'a> {
    pub(super) fn new(file: &'a SweepFile, windows: Vec<TimeWindow>) -> Self {
        Self {
            file,
            indices: Vec::new(),
            histories: windows.iter().map(|window| WindowedHistory::new(window.clone(), None)).collect(),
            windows,
            kept_indices: Vec::new(),
            kept: History {
                times: Vec::new(),
                columns: file.histories.iter().map(|name| (name.clone(), Vec::new())).collect(),
            },
        }
    }

    /// Receives the events that have happened, with their times [s].
    pub(super) fn take_events<'e>(&mut self, events: impl Iterator<Item = (&'e str, f64)>) {
        for (event, time) in events {
            for (collected, history) in self.file.collect.iter().zip(&mut self.histories) {
                if collected.is_of_event() && collected.column == event {
                    history.add(time, time);
                }
            }
        }
    }

    /// The stored histories, if any.
    pub(super) fn history(self) -> Option<History> {
        (!self.kept.columns.is_empty()).then_some(self.kept)
    }

    /// The collected values of a run in which `events` happened, with their times [s], or the error.
    pub(super) fn values(&self, events: &[(&str, f64)]) -> Result<Vec<f64>, String> {
        let value = |(collected, history): (&Collected, &WindowedHistory)| {
            let history = match history.close(events) {
                Ok(history) => history,
                Err(_) if collected.window.is_whole() => Accumulator::default(),
                Err(error) => {
                    let (statistic, column) = (collected.statistic, &collected.column);
                    return Err(format!("`{statistic}` of `{column}`: {}; {}", error.message, error.remedy));
                }
            };
            let history = &history;
            collected.kind().of(history).ok_or_else(|| match history.fault() {
                None if collected.is_of_event() => format!("event `{}` has not happened", collected.column),
                Some(time) => format!(
                    "`{}` is not a finite number at t = {} s",
                    collected.column,
                    lissom_core::number::Written(time)
                ),
                None => format!("`{}` of `{}` is not a finite number", collected.statistic, collected.column),
            })
        };
        self.file.collect.iter().zip(&self.histories).map(value).collect()
    }
}

impl Writer for Collector<'_> {
    fn begin(&mut self, columns: &[Column]) -> io::Result<()> {
        let index = |name: &String| {
            let found = Column::named(columns, name);
            found.ok_or_else(|| io::Error::other(format!("the model does not record `{name}`")))
        };
        let of = |collected: &Collected| {
            if collected.is_of_event() { Ok(None) } else { index(&collected.column).map(Some) }
        };
        self.indices = self.file.collect.iter().map(of).collect::<io::Result<_>>()?;
        let of = |(window, index): (&TimeWindow, &Option<usize>)| {
            WindowedHistory::new(window.clone(), index.and_then(|index| columns[index].fatigue))
        };
        self.histories = self.windows.iter().zip(&self.indices).map(of).collect();
        self.kept_indices = self.file.histories.iter().map(index).collect::<io::Result<_>>()?;
        Ok(())
    }

    fn row(&mut self, time: f64, values: &[f64]) -> io::Result<()> {
        for (history, index) in self.histories.iter_mut().zip(&self.indices) {
            if let Some(index) = index {
                history.add(time, values[*index]);
            }
        }
        if !self.kept_indices.is_empty() {
            self.kept.times.push(time);
            for ((_, kept), index) in self.kept.columns.iter_mut().zip(&self.kept_indices) {
                kept.push(values[*index]);
            }
        }
        Ok(())
    }
}
