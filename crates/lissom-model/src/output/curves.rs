//! Requested plots: chosen columns of one or several results over time, over another column or over frequency.

use super::plot::{Axis, Figure, Panel, file_name, quantity_of};
use super::spectrum::Spectrum;
use super::{Column, Record};
use lissom_mechanics::diagnostics::Diagnose;

/// Results with the name that distinguishes them.
#[derive(Clone, Copy, Debug)]
pub struct Source<'a> {
    /// Name; empty where there is one.
    pub name: &'a str,
    /// The results.
    pub record: &'a Record,
}

/// Abscissa of curves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Over<'a> {
    /// Time.
    Time,
    /// The column of this name.
    Column(&'a str),
    /// Frequency.
    Frequency,
}

/// Curves that cannot be drawn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", self.diagnostic())]
#[non_exhaustive]
pub enum CurveError {
    /// There is no such column.
    Unknown {
        /// The request.
        name: String,
        /// Which results.
        source_name: String,
        /// Columns that there are.
        known: String,
    },
    /// Columns of one name have several units.
    Units {
        /// The column.
        name: String,
        /// A unit.
        first: String,
        /// Another one.
        second: String,
    },
    /// Results have nothing in common.
    NothingShared,
    /// There is no spectrum.
    NoSpectrum(String),
}

/// Figures, and messages about omitted curves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plots {
    /// The figures.
    pub figures: Vec<Figure>,
    /// Omitted curves.
    pub left_out: Vec<String>,
}

/// One figure for each name of `of`, which is a plot, an output or a column; of all plots that the results share if it is empty.
///
/// # Errors
/// If a column is missing, units differ, or nothing is left.
pub fn plots(
    sources: &[Source<'_>],
    of: &[String],
    over: Over<'_>,
    title: &str,
) -> Result<Plots, CurveError> {
    let mut plots = Plots::default();
    let names = if of.is_empty() { shared(sources, &mut plots.left_out) } else { of.to_vec() };
    if names.is_empty() {
        return Err(CurveError::NothingShared);
    }
    let round_off: Vec<Vec<bool>> = sources.iter().map(|source| source.record.round_off()).collect();
    for name in &names {
        let mut panels: Vec<Panel> = Vec::new();
        let mut cut = false;
        for (source, is_round_off) in sources.iter().zip(&round_off) {
            let columns = columns(source, name)?;
            for index in columns {
                let column = &source.record.columns[index];
                let points = match over {
                    Over::Time => source.record.drawn(index, is_round_off[index]),
                    Over::Column(x) => {
                        let x = one(source, x)?;
                        source.record.values[x]
                            .iter()
                            .copied()
                            .zip(source.record.values[index].iter().copied())
                            .collect()
                    }
                    Over::Frequency => {
                        let found = Spectrum::of(&source.record.times, &source.record.values[index])
                            .ok_or_else(|| CurveError::NoSpectrum(column.name()))?;
                        if found.end() < 0.99 * found.nyquist && !cut {
                            cut = true;
                            plots.left_out.push(format!(
                                "the spectrum of `{name}` ends at {} Hz; the rows contain more, up to {} Hz",
                                found.end(),
                                found.nyquist
                            ));
                        }
                        found.lines
                    }
                };
                let label = if column.name() == *name {
                    column.output.clone()
                } else {
                    column.label(&source.record.columns)
                };
                push(&mut panels, (column, label), source.name, points)?;
            }
        }
        let (axis, suffix, words) = match over {
            Over::Time => (Axis::time(), String::new(), String::new()),
            Over::Frequency => (Axis::frequency(), "-spectrum".to_owned(), " (amplitudes)".to_owned()),
            Over::Column(x) => {
                let source = &sources[0];
                let column = &source.record.columns[one(source, x)?];
                let same = |other: &Source<'_>| {
                    let other = &other.record.columns[one(other, x)?];
                    unit_of(x, &column.unit, &other.unit)
                };
                sources.iter().try_for_each(|other| same(other).map(drop))?;
                let unit = if column.unit.is_empty() { String::new() } else { format!(" [{}]", column.unit) };
                let words = format!(" over {x}");
                (Axis::column(&format!("{x}{unit}")), format!("-over-{}", file_name(x)), words)
            }
        };
        let title =
            if title.is_empty() { format!("{name}{words}") } else { format!("{title}: {name}{words}") };
        let file = format!("plot-{}{suffix}", file_name(name));
        plots.figures.push(Figure::of(&file, &title, axis, panels));
    }
    Ok(plots)
}

/// Puts a curve to those of its unit.
fn push(
    panels: &mut Vec<Panel>,
    (column, label): (&Column, String),
    source: &str,
    points: Vec<(f64, f64)>,
) -> Result<(), CurveError> {
    let label = match (column.component.as_str(), source) {
        (_, "") => label,
        ("", source) => source.to_owned(),
        (_, source) => format!("{label}, {source}"),
    };
    let name = column.name();
    // The same column of other results, whose unit may not be known.
    for panel in panels.iter_mut() {
        if panel.names.contains(&name) {
            panel.unit = unit_of(&name, &panel.unit, &column.unit)?;
            panel.curves.push((label, points));
            return Ok(());
        }
    }
    match panels.iter_mut().find(|panel| panel.takes(column)) {
        Some(panel) => {
            panel.names.push(name);
            panel.add_quantity(&quantity_of(column));
            panel.curves.push((label, points));
        }
        None => panels.push(Panel {
            quantity: quantity_of(column),
            unit: column.unit.clone(),
            names: vec![name],
            curves: vec![(label, points)],
        }),
    }
    Ok(())
}

/// The unit of two, where one may not be known.
fn unit_of(name: &str, first: &str, second: &str) -> Result<String, CurveError> {
    match (first, second) {
        ("", unit) | (unit, "") => Ok(unit.to_owned()),
        (first, second) if first == second => Ok(first.to_owned()),
        (first, second) => {
            let [name, first, second] = [name, first, second].map(str::to_owned);
            Err(CurveError::Units { name, first, second })
        }
    }
}

/// Columns of a plot or an output, or the one of that name, which may be one of its other names.
fn columns(source: &Source<'_>, name: &str) -> Result<Vec<usize>, CurveError> {
    let all = &source.record.columns;
    let with = |of: fn(&Column) -> &str| -> Vec<usize> {
        (0..all.len()).filter(|&index| of(&all[index]) == name).collect()
    };
    let of_plot = with(|column| &column.plot);
    let found = if of_plot.is_empty() { with(|column| &column.output) } else { of_plot };
    if found.is_empty() { Ok(vec![one(source, name)?]) } else { Ok(found) }
}

/// The column of a name.
fn one(source: &Source<'_>, name: &str) -> Result<usize, CurveError> {
    Column::named(&source.record.columns, name).ok_or_else(|| unknown(source, name))
}

fn unknown(source: &Source<'_>, name: &str) -> CurveError {
    let mut known: Vec<String> = source.record.columns.iter().map(Column::name).collect();
    let count = known.len();
    known.truncate(12);
    let more = if count > known.len() { format!(" and {} more", count - known.len()) } else { String::new() };
    let source_name = if source.name.is_empty() { "history.csv" } else { source.name };
    CurveError::Unknown {
        name: name.to_owned(),
        source_name: source_name.to_owned(),
        known: format!("{}{more}", known.join(", ")),
    }
}

/// Plots that all results have, in the order of the first.
fn shared(sources: &[Source<'_>], left_out: &mut Vec<String>) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for column in sources.iter().flat_map(|source| &source.record.columns) {
        if !names.contains(&column.plot) {
            names.push(column.plot.clone());
        }
    }
    let has =
        |source: &Source<'_>, name: &String| source.record.columns.iter().any(|column| column.plot == *name);
    names.retain(|name| match sources.iter().find(|source| !has(source, name)) {
        None => true,
        Some(source) => {
            left_out.push(format!("`{name}` is not in `{}`", source.name));
            false
        }
    });
    names
}

#[cfg(test)]
#[path = "../../tests/unit/output/curves.rs"]
mod tests;
