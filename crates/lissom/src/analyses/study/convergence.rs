//! Convergence of schemes: the error of one output against a reference run, over the step size, as in figure 2.4 of
//! [Epple 2008], for any model.

use std::collections::BTreeMap;

use crate::start::Lowered;
use lissom_core::schemes::Scheme;
use lissom_model::output::LogFigure;

use super::members::{Effort, in_parallel};
use super::observed::{History, check_output, difference, observe, prepared, square, with_step};
use super::scheme_words::scheme_of;
use super::{StudyError, Watch, csv_line};
use crate::model_text::Model;

/// Tolerance of Newton's iteration, unless the user sets one or the model has a smaller one [-].
pub const TOLERANCE: f64 = 1e-10;
/// A ratio of steps this close to an integer, relative to it, is an integer.
const WHOLE: f64 = 1e-9;
/// A last step shorter by this fraction of it is a whole step.
const ROUNDED: f64 = 1e-6;

/// Distance of a guide below the first point of a curve, as a factor.
const GUIDE: f64 = 0.4;

/// A run with this error is unrelated to the reference [-].
const FAR: f64 = 0.5;

/// The request. Numbers are strings, so that they are passed to the model unchanged.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Request {
    /// Schemes, such as `radau-iia` or `hht(-0.3)`.
    pub schemes: Vec<String>,
    /// Step sizes [s].
    pub steps: Vec<String>,
    /// Scheme and step size [s] of the reference run.
    pub reference: (String, String),
    /// Name of the compared output.
    pub output: String,
}

/// One run.
#[derive(Debug)]
pub struct Row {
    /// Scheme, as written.
    pub scheme: String,
    /// Step size, as written [s].
    pub step: String,
    /// Step size [s].
    pub step_size: f64,
    /// Relative error [-].
    pub outcome: Result<f64, StudyError>,
    /// Observed order between the previous step size of the scheme and this one.
    pub order: Option<f64>,
}

/// All runs.
#[derive(Debug)]
pub struct Table {
    /// The runs, ordered by scheme, then by step size.
    pub rows: Vec<Row>,
    /// Number of compared instants, without the start.
    pub instants: usize,
    /// The last of them [s].
    pub end: f64,
}

/// A planned run.
struct Member {
    scheme: Scheme,
    step: String,
    step_size: f64,
    /// Number of steps, and number of steps between compared instants.
    counts: (usize, usize),
}

impl Request {
    /// The model with the first step size.
    pub fn first(&self, model: &Model) -> Model {
        self.steps.first().map_or_else(|| model.clone(), |step| with_step(model, step))
    }
}

/// Runs the model with every scheme and step size, in parallel, and compares `output` with the reference run at the
/// instants of the largest step. The error is the root of the mean square of the difference of all components over
/// all instants, over that of the reference. The rows of failed runs contain the reason.
///
/// # Errors
/// If the model or the request is invalid, if a step does not divide the largest, if the reference run fails, is
/// coarser than a run or remains zero, or if the study is interrupted.
pub fn study(model: &Model, request: &Request, watch: Watch<'_>) -> Result<Table, StudyError> {
    let (members, instants, end) = plan(model, request)?;
    let effort = Effort::new(watch, members.iter().map(|member| member.counts.0).sum());
    // The longest first, so that no thread has to finish it alone at the end.
    let mut order: Vec<usize> = (0..members.len()).collect();
    order.sort_by_key(|&index| std::cmp::Reverse(members[index].counts.0));
    let outcomes = in_parallel(order.len(), |place| {
        let member = &members[order[place]];
        let mut lowered = prepared(model, &member.step, TOLERANCE)?;
        lowered.settings.scheme = member.scheme.clone();
        observe(lowered, &request.output, member.counts, &effort)
    });
    let mut outcomes: Vec<_> = order.into_iter().zip(outcomes).collect();
    outcomes.sort_by_key(|&(index, _)| index);
    let mut histories: Vec<Result<History, StudyError>> =
        outcomes.into_iter().map(|(_, outcome)| outcome).collect();
    if histories.iter().any(|history| matches!(history, Err(StudyError::Interrupted))) {
        return Err(StudyError::Interrupted);
    }
    // The reference is the last member.
    let reference = histories.pop().unwrap_or(Err(StudyError::Interrupted))?;
    let size: f64 = reference[1..].iter().map(|values| square(values)).sum();
    if !(size > 0.0 && size.is_finite()) {
        return Err(StudyError::NothingToCompare(request.output.clone()));
    }
    let error = |history: History| {
        let apart = history.iter().zip(&reference).skip(1).map(|(a, b)| square(&difference(a, b)));
        (apart.sum::<f64>() / size).sqrt()
    };
    let mut rows: Vec<Row> = Vec::with_capacity(histories.len());
    for (index, (member, history)) in members.into_iter().zip(histories).enumerate() {
        let mut row = Row {
            scheme: request.schemes[index / request.steps.len()].clone(),
            step: member.step,
            step_size: member.step_size,
            outcome: history.map(error),
            order: None,
        };
        row.order =
            rows.last().filter(|last| last.scheme == row.scheme).and_then(|last| order_of(last, &row));
        rows.push(row);
    }
    Ok(Table { rows, instants, end })
}

/// Order observed between two runs: log(e₁/e₂) / log(h₁/h₂).
fn order_of(coarse: &Row, fine: &Row) -> Option<f64> {
    let (Ok(before), Ok(after)) = (&coarse.outcome, &fine.outcome) else { return None };
    let order = (before / after).ln() / (coarse.step_size / fine.step_size).ln();
    order.is_finite().then_some(order)
}

/// All runs, the reference last; the number of instants to compare, and the last of them.
fn plan(model: &Model, request: &Request) -> Result<(Vec<Member>, usize, f64), StudyError> {
    let schemes: Vec<Scheme> =
        request.schemes.iter().map(|scheme| scheme_of(scheme)).collect::<Result<_, _>>()?;
    let reference = scheme_of(&request.reference.0)?;
    let lowered = |step: &String| {
        let lowered = prepared(model, step, TOLERANCE)?;
        check_output(&lowered, &request.output)?;
        Ok::<_, StudyError>(lowered)
    };
    let all: Vec<Lowered> =
        request.steps.iter().chain([&request.reference.1]).map(lowered).collect::<Result<_, _>>()?;
    let sizes: Vec<f64> = all.iter().map(|lowered| lowered.settings.step_size).collect();
    let coarsest = sizes.iter().copied().fold(0.0, f64::max);
    let (finest, own) = (sizes[sizes.len() - 1], &sizes[..sizes.len() - 1]);
    if own.iter().any(|&size| size < finest * (1.0 - WHOLE)) {
        return Err(StudyError::CoarseReference(request.reference.1.clone()));
    }
    let start = all[0].plan.start;
    let instants = ((all[0].plan.end - start) / coarsest + ROUNDED).floor().max(1.0) as usize;
    let member = |scheme: &Scheme, step: &String, step_size: f64| {
        let quotient = coarsest / step_size;
        if (quotient - quotient.round()).abs() > WHOLE * quotient {
            return Err(StudyError::Steps { step: step.clone(), coarsest });
        }
        let every = quotient.round() as usize;
        let counts = (instants * every, every);
        Ok(Member { scheme: scheme.clone(), step: step.clone(), step_size, counts })
    };
    let mut members = Vec::new();
    for scheme in &schemes {
        for (step, &size) in request.steps.iter().zip(own) {
            members.push(member(scheme, step, size)?);
        }
    }
    members.push(member(&reference, &request.reference.1, finest)?);
    Ok((members, instants, start + instants as f64 * coarsest))
}

impl Table {
    /// As comma-separated values: `scheme,step_size,error,order`. Order is empty for the first step of a scheme,
    /// error and order for failed runs.
    pub fn csv(&self) -> String {
        let mut text = csv_line(["scheme", "step_size", "error", "order"]);
        for row in &self.rows {
            let error = row.outcome.as_ref().map_or(String::new(), |error| format!("{error:e}"));
            let order = row.order.map_or(String::new(), |order| order.to_string());
            text += &csv_line([row.scheme.as_str(), &row.step, &error, &order]);
        }
        text
    }

    /// Whether no run is near the reference: then the reference may be wrong.
    pub fn is_far_from_reference(&self) -> bool {
        let near = |row: &Row| row.outcome.as_ref().is_ok_and(|&error| error < FAR);
        !self.rows.iter().any(near)
    }

    /// The drawing: errors over the inverse of the step size.
    pub fn figure(&self, title: &str) -> LogFigure {
        let mut curves: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
        for row in &self.rows {
            let Ok(error) = row.outcome else { continue };
            let point = (1.0 / row.step_size, error);
            match curves.iter_mut().find(|curve| curve.0 == row.scheme) {
                Some(curve) => curve.1.push(point),
                None => curves.push((row.scheme.clone(), vec![point])),
            }
        }
        LogFigure {
            name: "convergence".to_owned(),
            title: title.to_owned(),
            x_label: "1 / step size [1/s]".to_owned(),
            y_label: "relative error [-]".to_owned(),
            guides: self.guides(&curves),
            curves,
        }
    }

    /// Lines of the slopes of the schemes' orders, below the curves. The order of a scheme is the median of those observed.
    fn guides(&self, curves: &[(String, Vec<(f64, f64)>)]) -> Vec<(String, Vec<(f64, f64)>)> {
        let floor =
            curves.iter().flat_map(|(_, points)| points).map(|point| point.1).fold(f64::INFINITY, f64::min);
        let mut starts: BTreeMap<i32, (f64, f64)> = BTreeMap::new();
        for (scheme, points) in curves {
            let mut orders: Vec<f64> =
                self.rows.iter().filter(|row| row.scheme == *scheme).filter_map(|row| row.order).collect();
            orders.sort_by(f64::total_cmp);
            let order = orders.get(orders.len() / 2).map_or(0, |order| order.round() as i32);
            let Some(&(x, y)) = points.first().filter(|_| order > 0) else { continue };
            let start = starts.entry(order).or_insert((x, GUIDE * y));
            start.1 = start.1.min(GUIDE * y);
        }
        let right = curves.iter().flat_map(|(_, points)| points).map(|point| point.0).fold(0.0, f64::max);
        // A guide ends within the range of the curves.
        let guide = |(order, (x, y)): (i32, (f64, f64))| {
            let end = right.min(x * (y / floor).powf(1.0 / f64::from(order)));
            (format!("order {order}"), vec![(x, y), (end, y * (x / end).powi(order))])
        };
        starts.into_iter().filter(|(_, (_, y))| *y > floor).map(guide).collect()
    }
}
