//! Content of the page of a results folder: a run with its motion, natural modes, or a Campbell diagram.

use std::io::ErrorKind;
use std::path::Path;

use lissom_model::files;
use lissom_model::scene::Scene;
use serde_json::Value;

use super::folder::{
    CAMPBELL, EVENTS, FolderError, HISTORY, MODES, MOTION, ResultFolder, SCENE, SHAPES, SUMMARY,
};
use crate::motion::{Motion, MotionError, RecordedRun};
use crate::pictures::view::{Notice, Results};

impl ResultFolder {
    /// A run with its motion.
    ///
    /// # Errors
    /// If the folder contains no table or no motion, or if table, motion or scene are invalid.
    pub fn recorded(path: &Path) -> Result<RecordedRun, FolderError> {
        for (file, holds, remedy) in [
            (MODES, "natural modes", "show their shapes by `lissom view` or `lissom snapshot`"),
            (CAMPBELL, "a Campbell diagram", "show it by `lissom view`"),
        ] {
            if path.join(file).is_file() {
                return Err(FolderError::NoMotion { path: path.display().to_string(), holds, remedy });
            }
        }
        let (_, record, title) = Self::open(path)?;
        let Some((_, bytes)) = drawn(path)? else {
            let holds = "a run without recorded motion";
            let remedy = "run the model again";
            return Err(FolderError::NoMotion { path: path.display().to_string(), holds, remedy });
        };
        let scene = read_scene(&path.join(SCENE))?;
        let motion = Motion::from_bytes(&bytes).map_err(|error| foreign(&path.join(MOTION), error))?;
        // A scene of another model would be misleading.
        let count = motion.reference().len();
        if scene.most_node().index() >= count || motion.header().point_count() > 0 && scene.beams.is_empty() {
            return Err(foreign(&path.join(SCENE), MotionError::Damaged));
        }
        Ok(RecordedRun { title, scene, motion, record })
    }

    /// A sentence about a run that did not reach its end, such as one that was killed; none of complete results.
    pub fn incomplete(path: &Path) -> Option<String> {
        let summary = Self::summary(path);
        let notice = Notice::of_end(&summary).or_else(|| of_unknown_end(path, &summary));
        notice.map(|notice| notice.text().to_owned())
    }

    fn summary(path: &Path) -> Value {
        let summary = files::read_text(&path.join(SUMMARY)).unwrap_or_default();
        serde_json::from_str(&summary).unwrap_or_default()
    }

    /// Content of the page of a folder with a run, natural modes, or a Campbell diagram.
    ///
    /// # Errors
    /// If there is no table, or if table, motion or scene are invalid.
    pub fn results(path: &Path) -> Result<Results, FolderError> {
        let summary = Self::summary(path);
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
        let results = Results::new(&name).with_summary(&summary);
        if path.join(MODES).is_file() {
            return with_modes(path, results, &summary);
        }
        let diagram = path.join(CAMPBELL);
        if diagram.is_file() {
            let table = files::read_text(&diagram)?;
            return results
                .with_campbell(&table, &summary)
                .ok_or_else(|| foreign(&diagram, MotionError::Damaged));
        }
        let (_, record, _) = Self::open(path)?;
        let mut results = results.with_record(&record);
        if let Ok(events) = files::read_text(&path.join(EVENTS)) {
            results = results.with_events(&events);
        }
        if let Some(notice) = of_unknown_end(path, &summary) {
            results = results.with_notice(notice);
        }
        let Some((scene, motion)) = drawn(path)? else {
            let text = "No motion was recorded: run the model again to see an animation.";
            return Ok(results.with_notice(Notice::warning(text)));
        };
        let last = Motion::last_time(&motion).map_err(|error| foreign(&path.join(MOTION), error))?;
        // A table that continues after the end of the motion is from another run, or from one that was resumed
        // without it.
        if let (Some(frame), Some(row)) = (last, record.times.last())
            && (frame - row).abs() > 0.01 * (row - record.times[0]).abs()
        {
            let text = format!("The motion ends at t = {frame} s, the table at t = {row} s.");
            results = results.with_notice(Notice::warning(text));
        }
        results.with_scene(&scene, &motion).map_err(|error| foreign(&path.join(MOTION), error))
    }
}

/// A run whose summary does not state how it has ended.
fn of_unknown_end(path: &Path, summary: &Value) -> Option<Notice> {
    let is_run =
        path.join(HISTORY).is_file() && ![MODES, CAMPBELL].iter().any(|name| path.join(name).is_file());
    let text = "There is no summary, or it is damaged: the run is incomplete or still in progress.";
    (is_run && !summary["stopped"].is_string()).then(|| Notice::warning(text))
}

/// Scene and motion, if they exist.
fn drawn(path: &Path) -> Result<Option<(Scene, Vec<u8>)>, FolderError> {
    let motion = path.join(MOTION);
    let bytes = match lissom_model::files::read(&motion) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(files::failure(files::Action::Read, &motion, error).into()),
    };
    // An invalid motion file is reported before a missing scene.
    Motion::last_time(&bytes).map_err(|error| foreign(&motion, error))?;
    Ok(Some((read_scene(&path.join(SCENE))?, bytes)))
}

pub(crate) fn read_scene(path: &Path) -> Result<Scene, FolderError> {
    Scene::from_json(&files::read_text(path)?)
        .map_err(|error| FolderError::Scene { path: path.display().to_string(), error })
}

fn with_modes(path: &Path, results: Results, summary: &Value) -> Result<Results, FolderError> {
    let (modes, shapes) = (files::read_text(&path.join(MODES))?, files::read_text(&path.join(SHAPES))?);
    let damaged = || foreign(&path.join(SHAPES), MotionError::Damaged);
    let (scene, motion) = drawn(path)?.ok_or_else(|| foreign(&path.join(MOTION), MotionError::Damaged))?;
    let results = results.with_scene(&scene, &motion).map_err(|error| foreign(&path.join(MOTION), error))?;
    let listed = summary["modes"].as_array().into_iter().flatten();
    let names = listed.map(|mode| mode["name"].as_str().unwrap_or_default().to_owned()).collect();
    results.with_modes(&modes, &shapes, names).ok_or_else(damaged)
}

pub(crate) fn foreign(path: &Path, error: MotionError) -> FolderError {
    FolderError::Motion { path: path.display().to_string(), error }
}
