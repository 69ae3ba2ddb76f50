//! Output of results: columns of numbers over time, to tables, summaries and plots. Independent of mechanics.

mod bode;
pub(crate) mod component;
mod csv;
mod curve_record;
mod curves;
mod log_plot;
mod plot;
mod record;
mod round_off;
mod spectrum;
mod summary;
mod sweep_plot;

use std::io;

use component::component_position;

pub use crate::files::matrix_market::{full_matrix, sparse_matrix};
pub use crate::text::number::number_text;
pub use bode::BodePlot;
pub use csv::{CsvWriter, quoted};
pub use curve_record::CurveRecord;
pub use curves::{CurveError, Over, Plots, Source, plots};
pub use lissom_drawing::{
    Align, Axis, Chart, Corner, Curve, DepthBuffer, Drawing, DrawingError, Format, Image, Mark, Panel, Shade,
    animation, title_lines,
};
pub use log_plot::LogFigure;
pub use plot::{Figure, FigureError, Graphic, drawn_outputs, figures, figures_of_curves, quantity_of};
pub use record::{Record, RecordError};
pub use spectrum::Spectrum;
pub use summary::Summary;
pub use sweep_plot::{SweepAxis, SweepPlot};

use crate::sweep::Fatigue;

/// Content of a column of results.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Name of the output it belongs to, such as `midspan`.
    pub output: String,
    /// Name of the plot in which it is drawn: that of the output, unless several outputs are drawn together.
    pub plot: String,
    /// Component, such as `x`; empty for the only one.
    pub component: String,
    /// Quantity in words, such as `displacement`.
    pub quantity: String,
    /// Unit, such as `m`; empty for none.
    pub unit: String,
    /// How its cycles are counted, if they are.
    pub fatigue: Option<Fatigue>,
}

impl Column {
    /// A column.
    pub fn new(output: &str, component: &str, quantity: &str, unit: &str) -> Self {
        let [output, component, quantity, unit] = [output, component, quantity, unit].map(str::to_owned);
        Self { plot: output.clone(), output, component, quantity, unit, fatigue: None }
    }

    /// This column in the plot of this name, if one is given.
    #[must_use]
    pub fn in_plot(self, plot: Option<String>) -> Self {
        Self { plot: plot.unwrap_or_else(|| self.output.clone()), ..self }
    }

    /// Label of the column in a legend among `others`: the component, and the output where other outputs are drawn in the same plot.
    pub fn label(&self, others: &[Self]) -> String {
        let is_shared = others.iter().any(|other| other.plot == self.plot && other.output != self.output);
        match self.component.as_str() {
            "" | "value" => self.output.clone(),
            _ if is_shared => self.name(),
            component => component.to_owned(),
        }
    }

    /// This column, with its cycles counted.
    #[must_use]
    pub fn with_fatigue(self, fatigue: Option<Fatigue>) -> Self {
        Self { fatigue, ..self }
    }

    /// Position of the column of `output` and `component`, which may also have one of its other names.
    pub fn of(columns: &[Self], output: &str, component: &str) -> Option<usize> {
        let own: Vec<usize> = (0..columns.len()).filter(|&index| columns[index].output == output).collect();
        let known = own.iter().map(|&index| columns[index].component.as_str());
        component_position(known, component).map(|position| own[position])
    }

    /// Position of the column that is called `name`, such as `midspan.x`.
    pub fn named(columns: &[Self], name: &str) -> Option<usize> {
        let exact = columns.iter().position(|column| column.name() == name);
        let other =
            || name.rsplit_once('.').and_then(|(output, component)| Self::of(columns, output, component));
        exact.or_else(other)
    }

    /// Name of output and component, such as `midspan.x`.
    pub fn name(&self) -> String {
        let dot = if self.component.is_empty() { "" } else { "." };
        format!("{}{dot}{}", self.output, self.component)
    }
}

/// Receives results row by row.
pub trait Writer {
    /// Starts with the columns after the time.
    ///
    /// # Errors
    /// If it cannot be written.
    fn begin(&mut self, columns: &[Column]) -> io::Result<()>;
    /// Receives the values of all columns at `time` [s].
    ///
    /// # Errors
    /// If it cannot be written.
    fn row(&mut self, time: f64, values: &[f64]) -> io::Result<()>;

    /// Ends: nothing is left in a buffer. Default: there is none.
    ///
    /// # Errors
    /// If it cannot be written.
    fn finish(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Returns an error unless there is a value for each column.
fn check_count(values: &[f64], columns: &[Column]) -> io::Result<()> {
    if values.len() == columns.len() {
        return Ok(());
    }
    let message = format!("{} values for {} columns", values.len(), columns.len());
    Err(io::Error::new(io::ErrorKind::InvalidInput, message))
}
