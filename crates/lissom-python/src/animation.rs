//! The page of an animation, as written by `lissom view`, as a text.

use std::io::{self, Write};
use std::num::NonZero;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use lissom::analyses::modes::ModeRequest;
use lissom::analyses::{self, Analysis};
use lissom::motion::MotionRecorder;
use lissom::pictures::view::Results;
use lissom::start::lower_with_units;
use lissom::{Record, ResultFolder, Session, summary};
use lissom_model::scene::Scene;
use pyo3::prelude::*;

use crate::errors::{self, SolutionError, of_analysis, of_report, solution};
use crate::model::NativeModel;
use crate::watch::{Watch, interruptible};

/// Bytes of a motion, shared with the recorder that a session owns.
#[derive(Clone, Default)]
struct Bytes(Arc<Mutex<Vec<u8>>>);

impl Bytes {
    fn take(&self) -> Vec<u8> {
        std::mem::take(&mut *self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Write for Bytes {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

fn of_motion(error: &dyn std::fmt::Display) -> PyErr {
    SolutionError::new_err(error.to_string())
}

/// Runs the model with its motion recorded, and gives the page. A run that fails on its way is shown up to there, and
/// the page shows the cause of the failure.
#[pyfunction]
pub(crate) fn animation(
    model: &NativeModel,
    py: Python<'_>,
    threads: Option<NonZero<usize>>,
) -> PyResult<String> {
    py.detach(|| {
        let document = model.document()?;
        NativeModel::in_time(&document)?;
        let mut lowered = lower_with_units(&document).map_err(|report| of_report(&report))?;
        lowered.settings.threads = crate::model::threads_or_all(threads).get();
        let bytes = Bytes::default();
        let recorder =
            MotionRecorder::new(&lowered, document.analysis.records.frames_per_second, bytes.clone());
        let scene = Scene::of(&document, &lowered.placed());
        let mut facts = summary::of_model(&model.model, &document, &lowered);
        let mut session = Session::start(lowered).map_err(|error| solution(&error))?;
        session.write_states_to(Box::new(recorder));
        let (mut record, mut watch) = (Record::default(), Watch::new(None));
        let report = session.run_with(&mut [&mut record], &mut |_| watch.ask(0.0, 0.0));
        watch.finish()?;
        summary::of_run(&mut facts, &session, &report);
        let facts = serde_json::from_str(&facts.to_json()).map_err(|error| of_motion(&error))?;
        let results = Results::new(model.model.name()).with_summary(&facts).with_record(&record);
        let results = results.with_scene(&scene, &bytes.take()).map_err(|error| of_motion(&error))?;
        Ok(results.page())
    })
}

/// The page of the natural modes in the tables `modes.csv` and `shapes.csv`, for a request as a TOML value.
#[pyfunction]
pub(crate) fn modes_animation(model: &NativeModel, py: Python<'_>, request: &str) -> PyResult<String> {
    let request: ModeRequest = analyses::request(request).map_err(|error| of_analysis(&error))?;
    let model = model.clone();
    interruptible(py, move || {
        let document = model.document()?;
        let found = request.compute(&model.model).map_err(|error| of_analysis(&error))?;
        let lowered = lower_with_units(&document).map_err(|report| of_report(&report))?;
        let scene = Scene::of(&document, &lowered.placed());
        let bytes = Bytes::default();
        let mut recorder = MotionRecorder::new(&lowered, None, bytes.clone());
        recorder.write_still(&found.state).map_err(|error| of_motion(&error))?;
        let results = Results::new(model.model.name())
            .with_title(document.title.as_deref().unwrap_or_default())
            .with_scene(&scene, &bytes.take())
            .map_err(|error| of_motion(&error))?;
        let shown = results.with_modes(&found.csv(), &found.shapes_csv(), found.names());
        shown.map(|results| results.page()).ok_or_else(|| of_motion(&"the modes are not those of the model"))
    })
}

/// The page of a folder of results.
#[pyfunction]
pub(crate) fn folder_animation(py: Python<'_>, folder: PathBuf) -> PyResult<String> {
    py.detach(|| {
        let results = ResultFolder::results(&folder).map_err(|error| errors::of_folder(&error))?;
        Ok(results.page())
    })
}
