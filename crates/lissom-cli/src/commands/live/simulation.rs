//! The model of a live page: read again when its file or a slider changes, simulated, and passed to the waiting pages.

use std::collections::BTreeMap;
use std::fs::Metadata;
use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant, SystemTime};

use lissom::analyses::path::{PathEnd, PathSession, PathSessionError};
use lissom::model::document::AnalysisKind;
use lissom::model::scene::Scene;
use lissom::motion::MotionRecorder;
use lissom::pictures::view::{Notice, Results};
use lissom::start::lower_with_units;
use lissom::{Document, FileError, Model, Override, Record, Session, Writer, summary};
use serde::Serialize;
use serde_json::{Value, json};

use super::parameter_order::parameters_of;

/// Interval of checks of the file.
const LOOK: Duration = Duration::from_millis(5);
/// A file that was changed more recently than this may still be being written.
const SETTLED: Duration = Duration::from_millis(10);
/// An error in a file is reported if the file has been unchanged for this time: it may have been written only in part.
const SURE: Duration = Duration::from_millis(200);
/// Duration for which an empty file must be unchanged: files are empty for a moment while they are saved.
const SURE_TO_BE_EMPTY: Duration = Duration::from_secs(2);

/// Data for pages, and their requests.
#[derive(Default)]
pub(super) struct Shared {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
struct State {
    /// Number of reports; zero before the first.
    version: u64,
    /// As JSON.
    published: Arc<str>,
    /// Values of sliders.
    parameters: BTreeMap<String, f64>,
    /// Number of changes of the sliders.
    asked: u64,
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, State> {
        // A thread that panicked cannot have left a partial change: each change is one assignment.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The first report after `version`, as soon as there is one; none after `patience`.
    pub(super) fn wait_after(&self, version: u64, patience: Duration) -> Option<Arc<str>> {
        let is_old = |state: &mut State| state.version == version || state.version == 0;
        let waited = self.changed.wait_timeout_while(self.lock(), patience, is_old);
        let (state, timeout) = waited.unwrap_or_else(PoisonError::into_inner);
        (!timeout.timed_out()).then(|| Arc::clone(&state.published))
    }

    /// Sets values of sliders; omitted ones are reset to those of the file.
    pub(super) fn ask(&self, parameters: BTreeMap<String, f64>) {
        let mut state = self.lock();
        state.parameters = parameters;
        state.asked += 1;
        self.changed.notify_all();
    }

    fn publish(&self, mut message: Message) {
        let mut state = self.lock();
        state.version += 1;
        message.version = state.version;
        state.published = message.to_json().into();
        self.changed.notify_all();
    }
}

/// Data for a page.
#[derive(Default, Serialize)]
struct Message {
    version: u64,
    notice: Option<Notice>,
    /// None if the model is invalid.
    result: Option<Results>,
    parameters: Option<Vec<Value>>,
    /// Time for reading and simulating [s].
    seconds: f64,
}

impl Message {
    fn to_json(&self) -> String {
        serde_json::to_string(self).expect("plain numbers and texts can always be written as JSON")
    }
}

/// Simulates in a thread of its own as long as the program runs.
pub(super) fn start(model: PathBuf, set: Vec<Override>, shared: &Arc<Shared>) {
    let shared = Arc::clone(shared);
    std::thread::spawn(move || {
        let mut last = None;
        let mut bases = BTreeMap::new();
        let mut included = Vec::new();
        loop {
            let now = Seen::of(&model, &included, &shared);
            if last.as_ref() == Some(&now) || now.is_younger_than(SETTLED) {
                std::thread::sleep(LOOK);
                continue;
            }
            // The included files are known after the model has been read.
            if let Ok(text) = Model::read(&model) {
                let _ = text.with_overrides(&set).document();
                included = text.included_files();
            }
            // The files are read after their times: a change in between is detected in the next check.
            let now = Seen::of(&model, &included, &shared);
            let text = Model::read(&model);
            let is_current = || Seen::of(&model, &included, &shared) == now;
            let message = simulate(text, &set, &now.parameters, &mut bases, &is_current);
            let is_mistake = message.as_ref().is_some_and(|message| message.result.is_none());
            let sure = if now.has_empty_file() { SURE_TO_BE_EMPTY } else { SURE };
            while is_mistake && now.modified.is_some() && now.is_younger_than(sure) && is_current() {
                std::thread::sleep(LOOK);
            }
            // Results of an outdated model are not sent.
            if let Some(message) = message.filter(|_| is_current()) {
                shared.publish(message);
            }
            last = Some(now);
        }
    });
}

/// Inputs of a simulation.
#[derive(Clone, Debug, PartialEq)]
struct Seen {
    length: u64,
    modified: Option<SystemTime>,
    /// Lengths and times of the included files.
    included: Vec<(u64, Option<SystemTime>)>,
    asked: u64,
    parameters: BTreeMap<String, f64>,
}

impl Seen {
    fn of(model: &Path, included: &[PathBuf], shared: &Shared) -> Self {
        let look = |path: &Path| {
            let file = std::fs::metadata(path).ok();
            let length = file.as_ref().map_or(0, Metadata::len);
            (length, file.and_then(|file| file.modified().ok()))
        };
        let (length, modified) = look(model);
        let state = shared.lock();
        Self {
            length,
            modified,
            included: included.iter().map(|path| look(path)).collect(),
            asked: state.asked,
            parameters: state.parameters.clone(),
        }
    }

    /// Whether the model or a file that it includes is empty.
    fn has_empty_file(&self) -> bool {
        self.length == 0 || self.included.iter().any(|(length, _)| *length == 0)
    }

    /// Whether a file was changed within this time.
    fn is_younger_than(&self, limit: Duration) -> bool {
        let times = std::iter::once(self.modified).chain(self.included.iter().map(|(_, modified)| *modified));
        times.flatten().filter_map(|modified| modified.elapsed().ok()).any(|age| age < limit)
    }
}

/// Simulates the model once; none if it has changed in the meantime. `bases` are the file's own values of the
/// parameters.
fn simulate(
    model: Result<Model, FileError>,
    set: &[Override],
    sliders: &BTreeMap<String, f64>,
    bases: &mut BTreeMap<String, f64>,
    is_current: &dyn Fn() -> bool,
) -> Option<Message> {
    let began = Instant::now();
    let failed = |notice: Notice| Some(Message { notice: Some(notice), ..Message::default() });
    let model = match model {
        Ok(model) => model.with_overrides(set),
        Err(error) => return failed(Notice::of(&error)),
    };
    match model.document() {
        Ok(document) => *bases = document.parameters,
        Err(report) => return failed(wrong(&report)),
    }
    let sliders_of_model = sliders.iter().filter(|(name, _)| bases.contains_key(*name));
    let varied = sliders_of_model
        .fold(model.clone(), |model, (name, value)| model.with(&format!("parameters.{name}"), *value));
    let mut named: Vec<(&String, &f64)> = bases.iter().collect();
    let order = parameters_of(model.text());
    let place = |name: &str| order.iter().position(|(known, _)| known == name).unwrap_or(usize::MAX);
    named.sort_by_key(|(name, _)| place(name));
    let parameters: Vec<Value> = named
        .into_iter()
        .map(|(name, base)| {
            let comment = order.get(place(name)).map_or("", |(_, comment)| comment);
            json!({ "name": name, "base": base, "value": sliders.get(name).unwrap_or(base), "comment": comment })
        })
        .collect();
    match results(&varied, is_current) {
        Ok(None) => None,
        Ok(result) => Some(Message {
            result,
            parameters: Some(parameters),
            seconds: began.elapsed().as_secs_f64(),
            ..Message::default()
        }),
        Err(notice) => failed(notice),
    }
}

/// Errors of the model, underlined.
fn wrong(report: &lissom::Report) -> Notice {
    Notice::error(report.render(false)).with_code()
}

/// A run in memory, or why there is none. None if the model has changed in the meantime.
fn results(model: &Model, is_current: &dyn Fn() -> bool) -> Result<Option<Results>, Notice> {
    let document = model.document().map_err(|report| wrong(&report))?;
    match &document.analysis.kind {
        AnalysisKind::Dynamics { .. } | AnalysisKind::Statics { .. } => {}
        AnalysisKind::Path { .. } => return path(model, &document, is_current),
        kind => {
            let text =
                format!("An analysis of kind `{}` is not simulated here: use `lissom run`.", kind.name());
            return Err(Notice::error(text));
        }
    }
    let lowered = lower_with_units(&document).map_err(|report| wrong(&report))?;
    let scene = Scene::of(&document, &lowered.placed());
    let mut summary = summary::of_model(model, &document, &lowered);
    let motion = Buffer::default();
    let recorder = MotionRecorder::new(&lowered, document.analysis.records.frames_per_second, motion.clone());
    let mut session = Session::start(lowered).map_err(|error| Notice::of(&error))?;
    session.write_states_to(Box::new(recorder));
    let mut record = Record::default();
    let mut looked = Instant::now();
    let mut watch = |_: &lissom::Progress| {
        if looked.elapsed() < LOOK {
            return ControlFlow::Continue(());
        }
        looked = Instant::now();
        if is_current() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    };
    let report = session.run_with(&mut [&mut record as &mut dyn Writer], &mut watch);
    if !report.is_complete() && report.error().is_none() {
        return Ok(None);
    }
    summary::of_run(&mut summary, &session, &report);
    let facts: Value = serde_json::from_str(&summary.to_json()).unwrap_or_default();
    let results = Results::new(model.name()).packed_soon().with_summary(&facts).with_record(&record);
    results.with_scene(&scene, &motion.take()).map(Some).map_err(|error| Notice::of(&error))
}

/// An equilibrium path in memory. None if the model has changed in the meantime.
fn path(
    model: &Model,
    document: &Document,
    is_current: &dyn Fn() -> bool,
) -> Result<Option<Results>, Notice> {
    let motion = Buffer::default();
    let session = match PathSession::new(model) {
        Err(PathSessionError::Model(report)) => return Err(wrong(&report)),
        other => other.map_err(|error| Notice::of(&error))?,
    };
    let mut session = session.with_motion(Box::new(motion.clone()));
    let mut record = Record::default();
    let mut watch = || if is_current() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
    let report = session.run(&mut [&mut record as &mut dyn Writer], &mut watch);
    if matches!(report.end, PathEnd::Interrupted) {
        return Ok(None);
    }
    let summary = session.summary(lissom::analyses::path::of_request(model, document), &report);
    let facts: Value = serde_json::from_str(&summary.to_json()).unwrap_or_default();
    let results = Results::new(model.name()).packed_soon().with_summary(&facts).with_record(&record);
    results.with_scene(&session.scene(), &motion.take()).map(Some).map_err(|error| Notice::of(&error))
}

/// Bytes in memory with two owners.
#[derive(Clone, Default)]
struct Buffer(Arc<Mutex<Vec<u8>>>);

impl Buffer {
    fn take(&self) -> Vec<u8> {
        std::mem::take(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Write for Buffer {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
