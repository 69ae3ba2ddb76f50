//! Round-off of an output at tiny steps: its error after a few steps, and its noise from step to step.

use crate::start::Lowered;
use lissom_model::output::LogFigure;

use super::members::{Effort, in_parallel};
use super::observed::{History, check_output, difference, observe, prepared, square, with_step};
use super::{StudyError, Watch, csv_line};
use crate::model_text::Model;

/// Tolerance of Newton's iteration, unless the user sets one or the model has a smaller one: below round-off [-].
pub const TOLERANCE: f64 = 1e-12;
/// Number of steps for every step size.
pub const STEPS: usize = 50;
/// Number of last steps whose noise is measured.
pub const NOISY_STEPS: usize = 20;
/// Ratios of the step size to that of the reference, and to that of the run that shows the accuracy of the reference.
pub const FINER: [usize; 2] = [8, 4];

/// The request. Numbers are strings, so that they are passed to the model unchanged.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Request {
    /// Step sizes [s].
    pub steps: Vec<String>,
    /// Name of the observed output.
    pub output: String,
}

/// One step size.
#[derive(Debug)]
pub struct Row {
    /// Step size, as written [s].
    pub step: String,
    /// Step size [s].
    pub step_size: f64,
    /// Result of the measurement.
    pub outcome: Result<Measured, StudyError>,
}

/// Result of a step size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// Difference after [`STEPS`] steps from the same time reached in eight times as many, relative to the magnitude
    /// of the output there [-].
    pub error: f64,
    /// Difference after [`STEPS`] steps from the time reached in four times as many: the accuracy of the reference [-].
    pub doubt: f64,
    /// Largest second difference over the last [`NOISY_STEPS`] steps, relative to the largest magnitude of the output
    /// there [-]. It decreases as h² if the output is smooth; the remainder is round-off.
    pub noise: f64,
}

/// All step sizes.
#[derive(Debug)]
pub struct Table {
    /// Name of the scheme.
    pub scheme: String,
    /// One row each.
    pub rows: Vec<Row>,
}

impl Measured {
    /// Whether the reference is no more accurate than the compared runs.
    pub fn is_doubtful(&self) -> bool {
        self.doubt > 0.5 * self.error
    }
}

impl Request {
    /// The model with the first step size.
    pub fn first(&self, model: &Model) -> Model {
        self.steps.first().map_or_else(|| model.clone(), |step| with_step(model, step))
    }
}

/// Takes [`STEPS`] steps of every size from the start, and reaches the same time in four and eight times as many, in
/// parallel. The rows of failed step sizes contain the reason.
///
/// # Errors
/// If the model or the request is invalid, or if the study is interrupted.
pub fn study(model: &Model, request: &Request, watch: Watch<'_>) -> Result<Table, StudyError> {
    let mut sizes = Vec::with_capacity(request.steps.len());
    let mut scheme = String::new();
    for step in &request.steps {
        let lowered = prepared(model, step, TOLERANCE)?;
        check_output(&lowered, &request.output)?;
        sizes.push(lowered.settings.step_size);
        scheme.clone_from(&lowered.settings.scheme.name);
    }
    let planned = STEPS * (1 + FINER.iter().sum::<usize>()) * sizes.len();
    let effort = Effort::new(watch, planned);
    let outcomes = in_parallel(sizes.len(), |index| {
        let history = |finer: usize| {
            let mut lowered: Lowered = prepared(model, &request.steps[index], TOLERANCE)?;
            lowered.settings.step_size /= finer as f64;
            observe(lowered, &request.output, (finer * STEPS, finer), &effort)
        };
        let (own, reference, other) = (history(1)?, history(FINER[0])?, history(FINER[1])?);
        measure(&own, &reference, &other).ok_or_else(|| StudyError::NothingToCompare(request.output.clone()))
    });
    if outcomes.iter().any(|outcome| matches!(outcome, Err(StudyError::Interrupted))) {
        return Err(StudyError::Interrupted);
    }
    let row =
        |((step, step_size), outcome): ((&String, f64), _)| Row { step: step.clone(), step_size, outcome };
    let rows = request.steps.iter().zip(sizes).zip(outcomes).map(row).collect();
    Ok(Table { scheme, rows })
}

/// Error, doubt and noise; none if the output is zero.
fn measure(own: &History, reference: &History, other: &History) -> Option<Measured> {
    let (own_end, exact, near) = (own.last()?, reference.last()?, other.last()?);
    let size = square(exact).sqrt();
    let last = &own[own.len().saturating_sub(NOISY_STEPS + 1)..];
    let largest = last.iter().map(|values| square(values).sqrt()).fold(0.0, f64::max);
    if !(size > 0.0 && largest > 0.0) {
        return None;
    }
    let second = |three: &[Vec<f64>]| {
        let bend = difference(&difference(&three[2], &three[1]), &difference(&three[1], &three[0]));
        square(&bend).sqrt()
    };
    Some(Measured {
        error: square(&difference(own_end, exact)).sqrt() / size,
        doubt: square(&difference(near, exact)).sqrt() / size,
        noise: last.windows(3).map(second).fold(0.0, f64::max) / largest,
    })
}

impl Table {
    /// As comma-separated values: `step_size,error,noise`. Failed step sizes have empty fields.
    pub fn csv(&self) -> String {
        let mut text = csv_line(["step_size", "error", "noise"]);
        for row in &self.rows {
            let of = |pick: fn(&Measured) -> f64| {
                row.outcome.as_ref().map_or(String::new(), |measured| format!("{:e}", pick(measured)))
            };
            text += &csv_line([row.step.as_str(), &of(|m| m.error), &of(|m| m.noise)]);
        }
        text
    }

    /// The drawing: error and noise over the step size.
    pub fn figure(&self, title: &str) -> LogFigure {
        let curve = |name: &str, pick: fn(&Measured) -> f64| {
            let point = |row: &Row| row.outcome.as_ref().ok().map(|measured| (row.step_size, pick(measured)));
            (name.to_owned(), self.rows.iter().filter_map(point).collect())
        };
        LogFigure {
            name: "roundoff".to_owned(),
            title: title.to_owned(),
            x_label: "step size [s]".to_owned(),
            y_label: "relative error and noise [-]".to_owned(),
            curves: vec![curve("error", |m| m.error), curve("noise", |m| m.noise)],
            guides: Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_the_second_difference_and_slopes_are_none() {
        let line = |jump: f64| -> History {
            (0..=50).map(|i| vec![3.0 + if i == 40 { jump } else { 0.0 }, 4.0]).collect()
        };
        let measured = measure(&line(0.0), &line(0.0), &line(0.0)).unwrap();
        assert_eq!((measured.error, measured.noise), (0.0, 0.0));
        let measured = measure(&line(1e-6), &line(0.0), &line(0.0)).unwrap();
        // The value in the middle counts twice; the magnitude is 5.
        assert!((measured.noise - 2e-6 / 5.0).abs() < 1e-12, "{}", measured.noise);
        let slope: History = (0..=50).map(|i| vec![f64::from(i)]).collect();
        assert_eq!(measure(&slope, &slope, &slope).unwrap().noise, 0.0);
        assert_eq!(measure(&vec![vec![0.0]; 3], &vec![vec![0.0]; 3], &vec![vec![0.0]; 3]), None);
    }
}
