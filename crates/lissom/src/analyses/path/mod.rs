//! Equilibrium paths of a model: its systems along the path, the table of equilibria, the critical points.

mod number;
mod pictures;

use lissom_core::diagnostics::Diagnose;
use std::io::{self, Write};
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::start::{Lowered, lower};
use lissom_core::errors::Warning;
use lissom_core::interrupt;
use lissom_core::path::{BranchChoice, CriticalPoint, EquilibriumPath, Family, PathError, PathSettings};
use lissom_core::settings::Settings;
use lissom_core::simulation::equilibrium::at_rest;
use lissom_core::system::{State, System};
use lissom_model::channels::Channel;
use lissom_model::document::{AnalysisKind, OutputKind};
use lissom_model::output::{Column, Record, Summary, Writer};
use lissom_model::scene::Scene;
use lissom_model::{Document, Report};
use serde_json::{Value, json};

use crate::diagnostic;
use crate::model_text::Model;
use crate::session::columns;
use number::Varied;
pub use number::varied_number;
use pictures::PathPictures;

/// Default first step of a path, as a fraction of its range.
const FIRST_OF_PATH: f64 = 0.02;
/// Maximum number of steps to the loads of a model whose number is varied.
const MAX_STEPS_TO_LOADS: usize = 1000;

/// If the path to the loads ends or has a critical point below this fraction of them, the model has no stiffness
/// initially.
const UNRESISTED: f64 = 1e-2;

/// Why a path has no start.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[error("{}", self.diagnostic())]
pub enum PathSessionError {
    /// The model is invalid.
    #[error(transparent)]
    Model(#[from] Report),
    /// The analysis is of another kind.
    NotAPath(&'static str),
    /// There is no equilibrium to start from, or no load.
    #[error(transparent)]
    Start(#[from] PathError),
    /// The loads are larger than a critical load before the number is varied.
    AlreadyCritical {
        /// Path to the number.
        path: String,
        /// Load factor of the first critical point.
        load_factor: f64,
    },
    /// The loads were not reached before the number is varied.
    NotLoaded {
        /// Path to the number.
        path: String,
        /// Why.
        error: PathError,
    },
}

/// Why a path ended early.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PathRunError {
    /// The path cannot be continued.
    #[error(transparent)]
    Path(#[from] PathError),
    /// The model is invalid for a number with an equilibrium.
    #[error(transparent)]
    Model(#[from] Report),
    /// A writer failed.
    #[error("{}", self.diagnostic())]
    Write(#[from] io::Error),
}

/// End of a path.
#[derive(Debug)]
pub enum PathEnd {
    /// At its load factor.
    Reached,
    /// Because it was interrupted.
    Interrupted,
    /// Because of a failure.
    Failed(PathRunError),
}

impl PathEnd {
    fn name(&self) -> &'static str {
        match self {
            Self::Reached => "end",
            Self::Interrupted => "interrupted",
            Self::Failed(_) => "failed",
        }
    }
}

/// Result of a path.
#[derive(Debug)]
pub struct PathReport {
    /// How it ended.
    pub end: PathEnd,
    /// Limit points and bifurcations, in their order along the path.
    pub critical: Vec<CriticalPoint>,
    /// The varied quantity: `load factor`, or the path of a number of the model file.
    pub name: String,
    /// Last load factor, or value of the number.
    pub load_factor: f64,
    /// Length of the path [-].
    pub arc: f64,
    /// Equilibria recorded.
    pub records: usize,
    /// Steps accepted, and attempts rejected.
    pub steps: [usize; 2],
    /// Newton iterations.
    pub iterations: usize,
    /// Wall-clock time.
    pub wall: Duration,
}

/// A model on an equilibrium path.
pub struct PathSession {
    path: EquilibriumPath,
    /// The varied number, unless it is the load factor.
    varied: Option<Varied>,
    /// The system of the last equilibrium, with its channels.
    system: Arc<System>,
    channels: Vec<Channel>,
    columns: Vec<Column>,
    unknowns: [usize; 2],
    began: Instant,
    pictures: PathPictures,
    /// Warnings about the start.
    doubts: Vec<Warning>,
}

impl PathSession {
    /// At load factor zero, or at the value of the varied number in the model file.
    ///
    /// # Errors
    /// If the model is invalid, has no load or no equilibrium without one, or the number has no effect.
    pub fn new(model: &Model) -> Result<Self, PathSessionError> {
        let began = Instant::now();
        let document = model.document()?;
        let AnalysisKind::Path { first, end, most_steps, branch } = document.analysis.kind else {
            return Err(PathSessionError::NotAPath(document.analysis.kind.name()));
        };
        let lowered = lower(&document)?;
        let pictures = PathPictures::new(&document, &lowered);
        let Lowered { system, state, settings, channels, .. } = lowered;
        let varied = Varied::of(model, &document, &state)?;
        let from = varied.as_ref().map_or(0.0, |varied| varied.from);
        let unloaded = lower(&document.without_loads())?.system;
        let layout = system.layout();
        let unknowns = [layout.coordinate_count(), layout.multiplier_rows().len()];
        let of_equilibrium = settings.clone();
        let settings = PathSettings {
            first: first.unwrap_or(FIRST_OF_PATH * (end - from).abs()).copysign(end - from),
            end,
            most_steps,
            branch: BranchChoice { number: branch.unsigned_abs() as usize, is_reversed: branch < 0 },
            scaling: settings.scaling,
            limits: settings.limits,
            solver: settings.solver,
        };
        let own = Arc::clone(&system);
        let mut doubts = Vec::new();
        let (path, column) = match &varied {
            None => {
                let column = Column::new("load_factor", "", "load factor", "");
                (EquilibriumPath::new(unloaded, system, state, settings)?, column)
            }
            Some(varied) => {
                let (state, found) =
                    under_loads(varied, [unloaded, system], state, (&settings, &of_equilibrium))?;
                doubts = found;
                let along: (String, Box<dyn Family>) = (varied.path.clone(), Box::new(varied.clone()));
                (
                    EquilibriumPath::along(along, from, state, settings)?,
                    Column::new(&varied.path, "", "value", ""),
                )
            }
        };
        let mut all = vec![column, Column::new("unstable", "", "unstable directions", "")];
        all.extend(columns(&channels));
        let pictures = pictures.along(path.name(), varied.is_none());
        Ok(Self { path, varied, system: own, channels, columns: all, unknowns, began, pictures, doubts })
    }

    /// Writes every equilibrium as a frame of a motion file, with the arc length of the path as its time.
    #[must_use]
    pub fn with_motion(self, to: Box<dyn Write + Send>) -> Self {
        Self { pictures: self.pictures.writing_to(to), ..self }
    }

    /// The scene of the model along the path so far.
    pub fn scene(&self) -> Scene {
        self.pictures.scene()
    }

    /// The recorded columns: the load factor or the varied number, the number of unstable directions, then the outputs.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The path.
    pub fn path(&self) -> &EquilibriumPath {
        &self.path
    }

    /// Warnings about the equilibrium at the start of a path along a parameter.
    pub fn warnings(&self) -> &[Warning] {
        &self.doubts
    }

    /// The values of all columns at the last equilibrium.
    pub fn values(&self, out: &mut Vec<f64>) {
        let factor = self.path.load_factor();
        out.extend([factor, self.path.unstable() as f64]);
        for channel in &self.channels {
            let first = out.len();
            channel.evaluate(&self.system, self.path.state(), out);
            // The potential of gravity increases with the load factor.
            if channel.kind == OutputKind::Energy && self.varied.is_none() {
                let mut without = Vec::new();
                channel.evaluate(self.path.unloaded(), self.path.state(), &mut without);
                for (value, without) in out[first..].iter_mut().zip(without) {
                    *value = without + factor * (*value - without);
                }
            }
        }
    }

    /// Follows the path to its end. `writers` receive a row at the start and after every step, with the arc length of the
    /// path as the time; `watch` decides after every step whether to continue.
    pub fn run(
        &mut self,
        writers: &mut [&mut dyn Writer],
        watch: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> PathReport {
        let mut report = PathReport {
            end: PathEnd::Reached,
            critical: Vec::new(),
            name: self.path.name().to_owned(),
            load_factor: 0.0,
            arc: 0.0,
            records: 0,
            steps: [0; 2],
            iterations: 0,
            wall: Duration::ZERO,
        };
        let end = match self.follow(writers, watch, &mut report) {
            Ok(ControlFlow::Continue(())) => PathEnd::Reached,
            Ok(ControlFlow::Break(())) => PathEnd::Interrupted,
            Err(error) => PathEnd::Failed(error),
        };
        let finished =
            writers.iter_mut().try_for_each(|writer| writer.finish()).and_then(|()| self.pictures.flush());
        report.end = match (end, finished) {
            (PathEnd::Failed(error), _) => PathEnd::Failed(error),
            (_, Err(error)) => PathEnd::Failed(error.into()),
            (end, Ok(())) => end,
        };
        report.load_factor = self.path.load_factor();
        report.arc = self.path.arc();
        report.wall = self.began.elapsed();
        report
    }

    /// Follows the path to its end and stores the results in memory.
    pub fn record(&mut self) -> (Record, PathReport) {
        let mut record = Record::default();
        let report = self.run(&mut [&mut record], &mut || ControlFlow::Continue(()));
        (record, report)
    }

    fn follow(
        &mut self,
        writers: &mut [&mut dyn Writer],
        watch: &mut dyn FnMut() -> ControlFlow<()>,
        report: &mut PathReport,
    ) -> Result<ControlFlow<()>, PathRunError> {
        for writer in writers.iter_mut() {
            writer.begin(&self.columns)?;
        }
        let mut values = Vec::new();
        loop {
            values.clear();
            self.values(&mut values);
            let length = self.path.arc();
            writers.iter_mut().try_for_each(|writer| writer.row(length, &values))?;
            self.pictures.push((length, self.path.load_factor()), &self.path.state().kinematics)?;
            report.records += 1;
            if self.path.is_finished() {
                return Ok(ControlFlow::Continue(()));
            }
            if watch().is_break() {
                return Ok(ControlFlow::Break(()));
            }
            let step = match self.path.advance() {
                Err(_) if interrupt::is_asked() => return Ok(ControlFlow::Break(())),
                step => step?,
            };
            report.steps[0] += 1;
            report.steps[1] += step.rejected;
            report.iterations += step.iterations;
            report.critical.extend(step.critical);
            if let Some(varied) = &self.varied {
                // Outputs may also depend on the number.
                let lowered = varied.at(self.path.load_factor())?;
                self.pictures.read_elements_of(&lowered);
                Lowered { system: self.system, channels: self.channels, .. } = lowered;
            }
        }
    }

    /// The contents of `summary.json`.
    pub fn summary(&self, mut summary: Summary, report: &PathReport) -> Summary {
        crate::results::summary::add_warnings(&mut summary, &self.doubts);
        let mut insert = |name: &str, fact: Value| crate::results::summary::insert(&mut summary, name, fact);
        insert("stopped", json!(report.end.name()));
        if let PathEnd::Failed(error) = &report.end {
            insert("error", json!(error.to_string()));
            insert("failure", diagnostic::facts(error));
        }
        let value = if self.varied.is_some() { "value" } else { "load_factor" };
        insert("varied", json!(report.name));
        insert(value, json!(report.load_factor));
        insert("arc", json!(report.arc));
        insert("records", json!(report.records));
        insert("steps", json!(report.steps[0]));
        insert("rejected_steps", json!(report.steps[1]));
        insert("newton_iterations", json!(report.iterations));
        insert("unknowns", json!(self.unknowns[0] + self.unknowns[1]));
        insert("multipliers", json!(self.unknowns[1]));
        let point = |point: &CriticalPoint| {
            json!({
                "kind": point.kind.name(),
                value: point.load_factor,
                "arc": point.arc,
                "unstable_before": point.unstable[0],
                "unstable_after": point.unstable[1],
                "located": point.is_located,
            })
        };
        insert("critical_points", report.critical.iter().map(point).collect());
        let column = |column: &Column| json!({ "name": column.name(), "quantity": column.quantity, "unit": column.unit });
        insert("columns", self.columns.iter().map(column).collect());
        insert("wall_seconds", json!(report.wall.as_secs_f64()));
        summary
    }
}

/// The equilibrium under the loads of a model whose number has its first value: loads increase from zero, so that it is the
/// one of the loaded model. If the model has no stiffness initially, it is computed by relaxation, with warnings.
fn under_loads(
    varied: &Varied,
    [unloaded, loaded]: [Arc<System>; 2],
    state: State,
    (settings, of_equilibrium): (&PathSettings, &Settings),
) -> Result<(State, Vec<Warning>), PathSessionError> {
    let settings = PathSettings {
        first: 0.25,
        end: 1.0,
        most_steps: MAX_STEPS_TO_LOADS,
        branch: BranchChoice::default(),
        ..*settings
    };
    let mut path = match EquilibriumPath::new(unloaded, Arc::clone(&loaded), state.clone(), settings) {
        Ok(path) => path,
        // Stresses may be caused by springs only.
        Err(PathError::NoLoad {}) => return Ok((state, Vec::new())),
        Err(error) => return Err(error.into()),
    };
    while !path.is_finished() {
        let name = varied.path.clone();
        let (factor, problem) = match path.advance() {
            Ok(step) => match step.critical.first() {
                None => continue,
                Some(CriticalPoint { load_factor, .. }) => (
                    *load_factor,
                    PathSessionError::AlreadyCritical { path: name, load_factor: *load_factor },
                ),
            },
            Err(error) => (path.load_factor(), PathSessionError::NotLoaded { path: name, error }),
        };
        if factor > UNRESISTED {
            return Err(problem);
        }
        let relaxed = at_rest(loaded, state, of_equilibrium);
        return relaxed.map(|(_, state, doubts)| (state, doubts)).map_err(|_| problem);
    }
    Ok((path.state().clone(), Vec::new()))
}

/// Contents that are known before the first step.
pub fn of_request(model: &Model, document: &Document) -> Summary {
    crate::results::summary::of_request("path", model, document)
}
