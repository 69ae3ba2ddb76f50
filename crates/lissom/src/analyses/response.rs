//! Frequency response: amplitudes of outputs for harmonic inputs of unit amplitude, without time integration.

use lissom_core::catalogued;
use lissom_core::diagnostics::{Diagnose, Diagnostic};
use std::f64::consts::TAU;
use std::fmt::Write;

use lissom_core::linearized::{FrequencyResponse, LinearModel, Mode, ModeKind, ModeOptions, ResponseError};
use lissom_core::number::Written;
use lissom_model::output::{BodePlot, Column, FigureError, Graphic, quoted};
use lissom_model::{Document, Report};
use num_complex::Complex64;
use serde::Deserialize;
use serde_json::{Value, json};

use crate::analyses::interface::{Analysis, AnalysisError, AnalysisReport, Origin};
use crate::analyses::modes::ModesError;
use crate::analyses::operating_point::{LinearizationPoint, OperatingPoint};
use crate::analyses::ports::{self, Input, Observed, PortError};
use crate::analysis_warning::AnalysisWarning;
use crate::model_text::Model;

/// Default number of frequencies.
pub const DEFAULT_POINTS: usize = 400;
/// Natural frequencies that are computed, so that no peak is missed.
const MODES: usize = 40;
/// A frequency is inserted between two others if a response changes by more than this fraction of itself …
const CHANGE: f64 = 0.15;
/// … or than this fraction of its largest magnitude, if that is more …
const SMALL: f64 = 1e-4;
/// … or than this fraction of its terms, …
const ROUND_OFF: f64 = 1e-9;
/// … at most this many times, …
const DEPTH: usize = 10;
/// … and up to this number of frequencies.
const MAX_FREQUENCIES: usize = 20_000;
/// Distance from an undamped natural frequency, relative to it.
const BESIDE: f64 = 1e-4;
/// Damping ratios below this are considered zero.
const UNDAMPED: f64 = 1e-9;

/// Compute the response of outputs to harmonic inputs, for the model linearised about a state.
///
/// The results go to a folder: `response.csv` (frequency, then magnitude, phase in degrees, real and imaginary part of each
/// output per unit of each input), `response.svg` and `response.png` (Bode plot) and `summary.json`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[cfg_attr(
    feature = "clap",
    derive(clap::Args),
    command(after_help = "\
Examples:
  lissom response examples/tip-crank.toml --input drive --output midspan.u3 --from 0.1 --to 100

An input is an entry of [inputs], a load (per unit of its size) or a prescribed motion (per m or rad), such as `motor`, or
`loads.motor` if several entries have the same name.
Exit code: 0 success; 2 wrong model or command line; 3 no state to linearise about, or no response.")
)]
pub struct ResponseRequest {
    /// Inputs: entries of [inputs], loads or prescribed motions.
    #[cfg_attr(
        feature = "clap",
        arg(
            long = "input",
            visible_alias = "by",
            value_name = "NAME,…",
            value_delimiter = ',',
            required = true
        )
    )]
    pub inputs: Vec<String>,
    /// Outputs, or columns of them.
    #[cfg_attr(
        feature = "clap",
        arg(
            long = "output",
            visible_alias = "of",
            value_name = "NAME,…",
            value_delimiter = ',',
            required = true
        )
    )]
    pub outputs: Vec<String>,
    /// First frequency [Hz].
    #[cfg_attr(feature = "clap", arg(long, value_name = "HZ", allow_negative_numbers = true))]
    pub from: f64,
    /// Last frequency [Hz].
    #[cfg_attr(feature = "clap", arg(long, value_name = "HZ", allow_negative_numbers = true))]
    pub to: f64,
    /// Number of frequencies, spaced logarithmically; more are added where a response changes rapidly.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N", default_value_t = DEFAULT_POINTS, value_parser = crate::analyses::interface::counts(2..=1_000_000)))]
    pub points: usize,
    /// State to linearise about: `static` (default), `undeformed`, `rotation` or a time of the model's analysis [s].
    #[cfg_attr(
        feature = "clap",
        arg(
            long,
            value_name = "STATE|TIME",
            default_value = "static",
            hide_default_value = true,
            allow_negative_numbers = true
        )
    )]
    pub about: OperatingPoint,
}

impl Analysis for ResponseRequest {
    const NAME: &'static str = "response";
    type Report = ResponseReport;
    type Error = FrequencyError;

    fn compute(&self, model: &Model) -> Result<ResponseReport, FrequencyError> {
        response(model, self)
    }
}

/// Why no response was found.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[error("{}", self.diagnostic())]
pub enum FrequencyError {
    /// The model is invalid.
    #[error(transparent)]
    Model(Report),
    /// There is no state to linearise about.
    #[error(transparent)]
    State(ModesError),
    /// An input or output does not exist.
    #[error(transparent)]
    Port(#[from] PortError),
    /// The frequencies are not a range.
    Range {
        /// First frequency [Hz].
        from: f64,
        /// Last frequency [Hz].
        to: f64,
    },
    /// Wheels are rolling.
    RollsOn,
    /// A solve failed.
    Response {
        /// The frequency [Hz].
        frequency: f64,
        /// The error.
        error: ResponseError,
    },
}

impl From<ModesError> for FrequencyError {
    fn from(error: ModesError) -> Self {
        match error {
            ModesError::Model(report) => Self::Model(report),
            other => Self::State(other),
        }
    }
}

impl AnalysisError for FrequencyError {
    fn origin(&self) -> Origin<'_> {
        match self {
            Self::Model(report) => Origin::Model(report),
            Self::Port(_) | Self::Range { .. } | Self::State(ModesError::Time { .. }) => Origin::Request,
            _ => Origin::Computation,
        }
    }
}

/// Amplitudes of an output for one input.
#[derive(Clone, Debug, PartialEq)]
pub struct Transfer {
    /// Name of the input.
    pub input: String,
    /// The output's column.
    pub output: Column,
    /// Output per input at each frequency.
    pub amplitudes: Vec<Complex64>,
}

impl Transfer {
    /// Names of output and input, such as `tip.u3/motor`.
    pub fn name(&self) -> String {
        format!("{}/{}", self.output.name(), self.input)
    }
}

/// Responses, with warnings.
#[derive(Clone, Debug)]
pub struct ResponseReport {
    /// Frequencies [Hz], ascending.
    pub frequencies: Vec<f64>,
    /// One for each pair of input and output.
    pub transfers: Vec<Transfer>,
    /// Natural frequencies [Hz] and damping ratios between the first and the last frequency.
    pub natural: Vec<(f64, f64)>,
    /// The state, in words.
    pub about: String,
    /// Number of coordinates and of multipliers.
    pub unknowns: [usize; 2],
    /// Warnings about them.
    pub warnings: Vec<AnalysisWarning>,
}

/// Frequency response of `model`.
///
/// # Errors
/// If the request is invalid for the model, the state cannot be reached, or a solve fails.
pub fn response(model: &Model, request: &ResponseRequest) -> Result<ResponseReport, FrequencyError> {
    let &ResponseRequest { from, to, .. } = request;
    if !(from > 0.0 && to > from && to.is_finite()) {
        return Err(FrequencyError::Range { from, to });
    }
    let document = model.document().map_err(FrequencyError::Model)?;
    let mut report = request.about.linearized(&document, |reached| of_state(&document, reached, request))?;
    report.about = request.about.name();
    Ok(report)
}

fn of_state(
    document: &Document,
    reached: LinearizationPoint<'_, '_>,
    request: &ResponseRequest,
) -> Result<ResponseReport, FrequencyError> {
    let inputs = ports::inputs(document, &reached, &request.inputs)?;
    let outputs = ports::outputs(&reached, &request.outputs)?;
    ports::check_effect(&inputs, &outputs)?;
    let LinearizationPoint { model, mut warnings, .. } = reached;
    if model.rolls_on() {
        return Err(FrequencyError::RollsOn);
    }
    if !model.is_at_rest() {
        warnings.push(AnalysisWarning::ResponseOfMotion);
    }
    let natural = natural_frequencies(model, request, &mut warnings);
    let mut table = Table::new(model, &inputs, &outputs);
    let mut first = frequencies(request, &natural);
    first.sort_by(f64::total_cmp);
    first.dedup();
    table.fill(&first)?;
    if table.rows.len() >= MAX_FREQUENCIES {
        warnings.push(AnalysisWarning::TooManyFrequencies { limit: MAX_FREQUENCIES });
    }
    let layout = model.system().layout();
    let unknowns = [layout.coordinate_count(), layout.multiplier_rows().len()];
    let rows = table.rows;
    let pairs = inputs.iter().flat_map(|input| outputs.iter().map(move |output| (input, output)));
    let transfer = |(index, (input, output)): (usize, (&Input, &Observed))| Transfer {
        input: input.name.clone(),
        output: output.column.clone(),
        amplitudes: rows.iter().map(|row| row.amplitudes[index]).collect(),
    };
    Ok(ResponseReport {
        frequencies: rows.iter().map(|row| row.frequency).collect(),
        transfers: pairs.enumerate().map(transfer).collect(),
        natural,
        about: String::new(),
        unknowns,
        warnings,
    })
}

/// Natural frequencies within the range, near which peaks are searched for.
fn natural_frequencies(
    model: &LinearModel<'_>,
    request: &ResponseRequest,
    warnings: &mut Vec<AnalysisWarning>,
) -> Vec<(f64, f64)> {
    let found = match model.modes(&ModeOptions { count: MODES, shift: None }) {
        Ok(found) => found.modes,
        Err(error) => {
            warnings.push(AnalysisWarning::PeaksUnknown { reason: error.to_string() });
            return Vec::new();
        }
    };
    let growing = found.iter().filter(|mode| mode.kind.is_unstable()).count();
    if growing > 0 {
        warnings.push(AnalysisWarning::UnstableResponse { modes: growing });
    }
    let last = found.last().map_or(0.0, |mode| mode.frequency);
    if found.len() >= MODES && last < request.to {
        warnings.push(AnalysisWarning::PeaksAbove { frequency: last });
    }
    let inside = |mode: &&Mode| {
        matches!(mode.kind, ModeKind::Oscillation | ModeKind::Flutter)
            && (request.from..=request.to).contains(&mode.frequency)
    };
    let natural: Vec<(f64, f64)> =
        found.iter().filter(inside).map(|mode| (mode.frequency, mode.damping)).collect();
    let undamped = natural.iter().filter(|(_, damping)| damping.abs() < UNDAMPED).count();
    if undamped > 0 {
        warnings.push(AnalysisWarning::Undamped { count: undamped });
    }
    natural
}

/// Frequencies in equal ratios, and around each natural one.
fn frequencies(request: &ResponseRequest, natural: &[(f64, f64)]) -> Vec<f64> {
    let last = request.points.max(2) - 1;
    let ratio = (request.to / request.from).ln();
    let mut all: Vec<f64> = (0..=last)
        .map(|k| match k {
            0 => request.from,
            k if k == last => request.to,
            k => request.from * (ratio * k as f64 / last as f64).exp(),
        })
        .collect();
    for &(frequency, damping) in natural {
        let beside = damping.abs().max(BESIDE);
        all.extend(
            [1.0 - 3.0 * beside, 1.0 - beside, 1.0 + beside, 1.0 + 3.0 * beside].map(|f| f * frequency),
        );
        if damping.abs() >= UNDAMPED {
            all.push(frequency);
        }
    }
    all.retain(|&frequency| (request.from..=request.to).contains(&frequency));
    all
}

/// A frequency and the responses there.
#[derive(Clone)]
struct Row {
    frequency: f64,
    amplitudes: Vec<Complex64>,
}

/// Responses by frequency, as they are computed.
struct Table<'p, 'm, 'a> {
    solver: FrequencyResponse<'m, 'a>,
    inputs: &'p [Input],
    outputs: &'p [Observed],
    right: Vec<Vec<f64>>,
    /// Changes of each response below these are ignored.
    small: Vec<f64>,
    rows: Vec<Row>,
}

impl<'p, 'm, 'a> Table<'p, 'm, 'a> {
    fn new(model: &'m LinearModel<'a>, inputs: &'p [Input], outputs: &'p [Observed]) -> Self {
        let right = inputs.iter().map(|input| input.right.clone()).collect();
        let small = vec![0.0; inputs.len() * outputs.len()];
        Self { solver: model.frequency_response(), inputs, outputs, right, small, rows: Vec::new() }
    }

    fn at(&mut self, frequency: f64) -> Result<Row, FrequencyError> {
        let s = Complex64::new(0.0, TAU * frequency);
        let failed = |error| FrequencyError::Response { frequency, error };
        let found = self.solver.amplitudes(s, &self.right).map_err(failed)?;
        let mut amplitudes = Vec::with_capacity(self.small.len());
        for (input, unknowns) in self.inputs.iter().zip(&found) {
            for output in self.outputs {
                let (amplitude, terms) = output.derivatives.amplitude(s, unknowns);
                let small = &mut self.small[amplitudes.len()];
                *small = small.max(SMALL * amplitude.norm()).max(ROUND_OFF * terms);
                amplitudes.push(amplitude + output.direct(input));
            }
        }
        Ok(Row { frequency, amplitudes })
    }

    /// Computes the rows of these frequencies, and of more between them where a response changes fast.
    fn fill(&mut self, frequencies: &[f64]) -> Result<(), FrequencyError> {
        let first = frequencies.iter().map(|&frequency| self.at(frequency)).collect::<Result<Vec<_>, _>>()?;
        for (index, row) in first.iter().enumerate() {
            if index > 0 {
                self.between(&first[index - 1], row, DEPTH)?;
            }
            self.rows.push(row.clone());
        }
        Ok(())
    }

    fn between(&mut self, low: &Row, high: &Row, depth: usize) -> Result<(), FrequencyError> {
        let changes = low
            .amplitudes
            .iter()
            .zip(&high.amplitudes)
            .zip(&self.small)
            .any(|((a, b), &small)| (a - b).norm() > CHANGE * a.norm().max(b.norm()).max(small));
        if !changes || depth == 0 || self.rows.len() >= MAX_FREQUENCIES {
            return Ok(());
        }
        let middle = self.at((low.frequency * high.frequency).sqrt())?;
        self.between(low, &middle, depth - 1)?;
        self.rows.push(middle.clone());
        self.between(&middle, high, depth - 1)
    }
}

impl ResponseReport {
    /// The table `response.csv`: frequency [Hz], then for each pair magnitude, phase [°], real and imaginary part of output per
    /// input.
    pub fn csv(&self) -> String {
        let mut text = "frequency".to_owned();
        for transfer in &self.transfers {
            for part in ["magnitude", "phase", "real", "imaginary"] {
                text.push(',');
                text.push_str(&quoted(&format!("{}.{part}", transfer.name())));
            }
        }
        text.push('\n');
        for (row, frequency) in self.frequencies.iter().enumerate() {
            // Writing to a string cannot fail.
            let _ = write!(text, "{frequency:?}");
            for transfer in &self.transfers {
                let value = transfer.amplitudes[row];
                let (magnitude, phase) = (value.norm(), value.arg().to_degrees());
                let _ = write!(text, ",{magnitude:?},{phase:?},{:?},{:?}", value.re, value.im);
            }
            text.push('\n');
        }
        text
    }

    /// Frequency [Hz] and magnitude at the largest magnitude of a response.
    pub fn peak(&self, transfer: &Transfer) -> (f64, f64) {
        let sizes = self.frequencies.iter().zip(&transfer.amplitudes).map(|(&f, value)| (f, value.norm()));
        sizes.reduce(|most, one| if one.1 > most.1 { one } else { most }).unwrap_or((0.0, 0.0))
    }
}

impl AnalysisReport for ResponseReport {
    fn tables(&self) -> Vec<(String, String)> {
        vec![("response.csv".to_owned(), self.csv())]
    }

    fn figure(&self, title: &str) -> Option<Result<Graphic, FigureError>> {
        let curve = |transfer: &Transfer| {
            let of = |part: fn(&Complex64) -> f64| transfer.amplitudes.iter().map(part).collect();
            (transfer.name(), of(|value| value.norm()), of(|value| value.arg()))
        };
        let plot = BodePlot {
            name: "response".to_owned(),
            title: title.to_owned(),
            frequencies: self.frequencies.clone(),
            curves: self.transfers.iter().map(curve).collect(),
        };
        Some(plot.draw())
    }

    fn add_facts(&self, insert: &mut dyn FnMut(&str, Value)) {
        insert("about", json!(self.about));
        insert("frequencies", json!(self.frequencies.len()));
        insert("unknowns", json!(self.unknowns[0] + self.unknowns[1]));
        insert("multipliers", json!(self.unknowns[1]));
        let natural =
            |&(frequency, damping): &(f64, f64)| json!({ "frequency": frequency, "damping": damping });
        insert("natural_frequencies", self.natural.iter().map(natural).collect());
        let peak = |transfer: &Transfer| {
            let (frequency, most) = self.peak(transfer);
            json!({
                "transfer": transfer.name(),
                "input": transfer.input,
                "output": transfer.output.name(),
                "unit": transfer.output.unit,
                "peak_frequency": frequency,
                "peak_magnitude": most,
            })
        };
        insert("transfers", self.transfers.iter().map(peak).collect());
    }

    fn warnings(&self) -> Vec<Diagnostic> {
        self.warnings.iter().map(Diagnose::diagnostic).collect()
    }

    fn text(&self, time: &str) -> String {
        let [coordinates, multipliers] = self.unknowns;
        let mut text = format!(
            "  response about {} at {} frequencies, {coordinates} coordinates, {multipliers} multipliers, {time}\n",
            self.about,
            self.frequencies.len()
        );
        for transfer in &self.transfers {
            let (frequency, most) = self.peak(transfer);
            let (name, unit) = (transfer.name(), &transfer.output.unit);
            // Writing to a string cannot fail.
            let _ = writeln!(text, "  {name}: largest {} {unit} at {} Hz", Written(most), Written(frequency));
        }
        text
    }
}

catalogued! {
    Failure FrequencyError {
        Range { from => from, to => to } => "response-range" {
            cause: "the frequencies are from {from} to {to} Hz",
            remedy: "specify two frequencies greater than zero, the smaller one first",
            meaning: "The range of a frequency response is empty, or not positive.",
        }
        RollsOn {} => "response-rolling" {
            cause: "wheels are rolling in this state: their contacts move relative to the axes of the parts, in which responses are \
                    computed",
            remedy: "use a state at rest, or `lissom modes`, which supports axes that do not spin with the wheels",
            meaning: "The linear equations of rolling wheels have constant coefficients only in axes that do not spin with them, which \
                      frequency responses do not support.",
            advice: "Linearise about a state at rest, or compute modes.",
        }
    } wraps {
        Model { 0 => report } => report.diagnostic(),
        State { 0 => error } => error.diagnostic(),
        Port { 0 => error } => error.diagnostic(),
        Response { frequency => frequency, error => error } => error.diagnostic().within(&format!("at {frequency} Hz")),
    }
}
