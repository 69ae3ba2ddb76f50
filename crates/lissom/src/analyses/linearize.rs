//! The linear model as files of matrices: M, D, K and the constraints, inputs and outputs, and first-order equations
//! A, B, C, D of small models.

use std::collections::BTreeMap;
use std::fmt::Write;

use lissom_core::diagnostics::{Diagnose, Diagnostic};
use lissom_core::kinematics::Quantity;
use lissom_core::linearized::{LinearModel, OutputDerivatives, StateSpace, StateSpaceError};
use lissom_model::Document;
use lissom_model::output::{full_matrix, quoted, sparse_matrix};
use serde::Deserialize;
use serde_json::{Value, json};

use crate::analyses::interface::{Analysis, AnalysisReport};
use crate::analyses::modes::ModesError;
use crate::analyses::operating_point::{self, LinearizationPoint, OperatingPoint};
use crate::analyses::ports::{self, Input, Observed};
use crate::analyses::response::FrequencyError;
use crate::analysis_warning::AnalysisWarning;
use crate::model_text::Model;
use crate::session::Session;

/// Write the matrices of the model linearised about a state.
///
/// The results go to a folder, in the Matrix Market format: mass `M.mtx`, damping `D.mtx`, stiffness `K.mtx`, gradient of the
/// constraints `G.mtx`, `inputs.mtx`, `outputs-*.mtx`, `unknowns.csv` (names of the rows). For models with up to 600
/// coordinates also `state-space-A.mtx` … `state-space-D.mtx` with `states.csv`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[cfg_attr(
    feature = "clap",
    derive(clap::Args),
    command(after_help = "\
Examples:
  lissom linearize examples/tip-crank.toml
  lissom linearize examples/tip-crank.toml --input drive --output midspan

An input is an entry of [inputs], a load (per unit of its size) or a prescribed motion (per m or rad), such as `motor`, or
`loads.motor` if several entries have the same name.
Exit code: 0 success; 2 wrong model or command line; 3 no state to linearise about.")
)]
pub struct LinearizeRequest {
    /// Inputs: entries of [inputs], loads or prescribed motions.
    #[cfg_attr(
        feature = "clap",
        arg(long = "input", visible_alias = "by", value_name = "NAME,…", value_delimiter = ',')
    )]
    pub inputs: Vec<String>,
    /// Outputs, or columns of them.
    #[cfg_attr(
        feature = "clap",
        arg(long = "output", visible_alias = "of", value_name = "NAME,…", value_delimiter = ',')
    )]
    pub outputs: Vec<String>,
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

impl Analysis for LinearizeRequest {
    const NAME: &'static str = "linearize";
    const FOLDER: &'static str = "linear";
    type Report = LinearizeReport;
    type Error = FrequencyError;

    fn compute(&self, model: &Model) -> Result<LinearizeReport, FrequencyError> {
        linearize(model, self)
    }
}

/// A linear model as texts of matrices.
#[derive(Clone, Debug)]
pub struct LinearizeReport {
    /// Names of files and their texts.
    pub files: Vec<(String, String)>,
    /// First-order equations, or the reason for their absence.
    pub state_space: Result<StateSpace, StateSpaceError>,
    /// Names of the inputs.
    pub inputs: Vec<String>,
    /// Columns of the outputs.
    pub outputs: Vec<String>,
    /// The state, in words.
    pub about: String,
    /// Number of coordinates and of multipliers.
    pub unknowns: [usize; 2],
    /// Warnings about it.
    pub warnings: Vec<AnalysisWarning>,
}

/// Linearises `model`.
///
/// # Errors
/// If the request is invalid for the model, or the state cannot be reached.
pub fn linearize(model: &Model, request: &LinearizeRequest) -> Result<LinearizeReport, FrequencyError> {
    let document = model.document().map_err(FrequencyError::Model)?;
    let mut report = request.about.linearized(&document, |reached| -> Result<_, FrequencyError> {
        let inputs = ports::inputs(&document, &reached, &request.inputs)?;
        let outputs = ports::outputs(&reached, &request.outputs)?;
        report_of(reached, &inputs, &outputs)
    })?;
    report.about = request.about.name();
    Ok(report)
}

/// Linearises the model of `document` at the state of `session`, which runs it: the result of [`linearize`] about
/// that time. `inputs` and `outputs` are named as in [`LinearizeRequest`].
///
/// # Errors
/// If an input or output does not exist, or the state is at rest without being in equilibrium.
pub fn linearize_session(
    session: &Session,
    document: &Document,
    inputs: &[String],
    outputs: &[String],
) -> Result<LinearizeReport, FrequencyError> {
    let mut report = operating_point::now(session, document, |reached| -> Result<_, FrequencyError> {
        let inputs = ports::inputs(document, &reached, inputs)?;
        let outputs = ports::outputs(&reached, outputs)?;
        report_of(reached, &inputs, &outputs)
    })?;
    report.about = OperatingPoint::Time(session.progress().time).name();
    Ok(report)
}

/// Derivatives with respect to unknowns of one type.
type Part = fn(&OutputDerivatives) -> &BTreeMap<usize, f64>;

fn report_of(
    reached: LinearizationPoint<'_, '_>,
    inputs: &[Input],
    outputs: &[Observed],
) -> Result<LinearizeReport, FrequencyError> {
    let LinearizationPoint { model, warnings, .. } = reached;
    model.check_positions_alone().map_err(ModesError::from)?;
    let layout = model.system().layout();
    let (count, multipliers) = (layout.coordinate_count(), layout.multiplier_rows().len());
    let parts = model.parts();
    let square = |name: &str, comment: &str, values: &[f64]| {
        let entries = entries(model, values).filter(|&(row, column, _)| row < count && column < count);
        (name.to_owned(), sparse_matrix(comment, [count, count], entries))
    };
    let constraint = entries(model, &parts.constraint)
        .filter(|&(row, column, _)| row >= count && column < count)
        .map(|(row, column, value)| (row - count, column, value));
    let mut files = vec![
        ("unknowns.csv".to_owned(), unknowns(model)),
        square("M.mtx", "mass: derivative of the forces by accelerations", &parts.mass),
        square("D.mtx", "damping: derivative of the forces by velocities", &parts.damping),
        square("K.mtx", "stiffness: derivative of the forces by positions", &parts.stiffness),
        ("G.mtx".to_owned(), sparse_matrix("gradient of the constraints", [multipliers, count], constraint)),
    ];
    if !inputs.is_empty() {
        let of_inputs = inputs.iter().enumerate().flat_map(|(column, input)| {
            input.right.iter().enumerate().map(move |(row, &value)| (row, column, value))
        });
        let comment = "right-hand sides for unit inputs, those of the constraints last";
        let size = [count + multipliers, inputs.len()];
        files.push(("inputs.mtx".to_owned(), sparse_matrix(comment, size, of_inputs)));
    }
    let kinds: [(&str, &str, Part, usize, usize); 4] = [
        ("outputs-place.mtx", "outputs by positions", |output| &output.by_place, 0, count),
        ("outputs-rate.mtx", "outputs by velocities", |output| &output.by_rate, 0, count),
        ("outputs-acceleration.mtx", "outputs by accelerations", |output| &output.by_acceleration, 0, count),
        (
            "outputs-multiplier.mtx",
            "outputs by multipliers",
            |output| &output.by_multiplier,
            count,
            multipliers,
        ),
    ];
    for (name, comment, part, first, columns) in kinds.into_iter().filter(|_| !outputs.is_empty()) {
        let entries = outputs.iter().enumerate().flat_map(|(row, output)| {
            part(&output.derivatives).iter().map(move |(&column, &value)| (row, column - first, value))
        });
        files.push((name.to_owned(), sparse_matrix(comment, [outputs.len(), columns], entries)));
    }
    let direct = |output: &Observed| inputs.iter().map(|input| output.direct(input)).collect::<Vec<f64>>();
    if !outputs.is_empty() && !inputs.is_empty() {
        let values: Vec<Vec<f64>> = outputs.iter().map(direct).collect();
        let size = [outputs.len(), inputs.len()];
        let text =
            full_matrix("outputs by inputs, the motion omitted", size, |row, column| values[row][column]);
        files.push(("outputs-input.mtx".to_owned(), text));
    }
    let right: Vec<Vec<f64>> = inputs.iter().map(|input| input.right.clone()).collect();
    let observed: Vec<_> =
        outputs.iter().map(|output| (output.derivatives.clone(), direct(output))).collect();
    let state_space = model.state_space(&right, &observed);
    if let Ok(found) = &state_space {
        for (name, matrix) in [("A", &found.a), ("B", &found.b), ("C", &found.c), ("D", &found.d)] {
            let comment = format!("{name} of x' = A x + B u, y = C x + D u");
            let text =
                full_matrix(&comment, [matrix.nrows(), matrix.ncols()], |row, column| matrix[(row, column)]);
            files.push((format!("state-space-{name}.mtx"), text));
        }
        let rows: String = found.states.iter().map(|state| quoted(state) + "\n").collect();
        files.push(("states.csv".to_owned(), format!("state\n{rows}")));
    }
    Ok(LinearizeReport {
        files,
        state_space,
        inputs: inputs.iter().map(|input| input.name.clone()).collect(),
        outputs: outputs.iter().map(|output| output.column.name()).collect(),
        about: String::new(),
        unknowns: [count, multipliers],
        warnings,
    })
}

/// Entries of values on the pattern, by row and column.
fn entries<'m>(
    model: &'m LinearModel<'_>,
    values: &'m [f64],
) -> impl Iterator<Item = (usize, usize, f64)> + 'm {
    let pattern = model.system().pattern();
    (0..pattern.size()).flat_map(move |column| {
        let range = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
        let rows = pattern.row_indices()[range.clone()].to_vec();
        rows.into_iter().zip(values[range].iter().copied()).map(move |(row, value)| (row, column, value))
    })
}

/// The table of the unknowns: row from 1, name, unit.
fn unknowns(model: &LinearModel<'_>) -> String {
    let layout = model.system().layout();
    let mut text = "row,unknown,unit\n".to_owned();
    for row in 0..layout.size() {
        let is_multiplier = row >= layout.coordinate_count();
        let unit = match (layout.quantities()[row], is_multiplier) {
            (Quantity::State, _) => "",
            (Quantity::Length, false) => "m",
            (Quantity::Angle, false) => "rad",
            (Quantity::Length, true) => "N",
            (Quantity::Angle, true) => "N m",
        };
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{},{},{unit}", row + 1, quoted(&layout.name_of(row)));
    }
    text
}

impl AnalysisReport for LinearizeReport {
    fn tables(&self) -> Vec<(String, String)> {
        self.files.clone()
    }

    fn add_facts(&self, insert: &mut dyn FnMut(&str, Value)) {
        insert("about", json!(self.about));
        insert("unknowns", json!(self.unknowns[0] + self.unknowns[1]));
        insert("multipliers", json!(self.unknowns[1]));
        insert("inputs", json!(self.inputs));
        insert("outputs", json!(self.outputs));
        match &self.state_space {
            Ok(found) => insert("states", json!(found.states.len())),
            Err(reason) => insert("without_state_space", json!(reason.to_string())),
        }
        insert("files", self.files.iter().map(|(name, _)| json!(name)).collect());
    }

    fn warnings(&self) -> Vec<Diagnostic> {
        self.warnings.iter().map(Diagnose::diagnostic).collect()
    }

    fn text(&self, time: &str) -> String {
        let [coordinates, multipliers] = self.unknowns;
        let equations = match &self.state_space {
            Ok(matrices) => format!("first-order equations in {} states", matrices.states.len()),
            Err(reason) => format!("no first-order equations: {reason}"),
        };
        format!(
            "  linear model about {}: {coordinates} coordinates, {multipliers} multipliers, {} inputs, {} outputs, {time}\n  {equations}\n",
            self.about,
            self.inputs.len(),
            self.outputs.len()
        )
    }
}
