//! The results folder of a run: `history.csv`, `summary.json`, the motion with its scene, and the plots. Independent of
//! simulations.

use lissom_core::diagnostics::Diagnose;
use std::fs::{File, Metadata, TryLockError};
use std::io::{BufWriter, Error, ErrorKind, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use lissom_model::files::{self, FileError};
use lissom_model::output::{
    CsvWriter, CurveRecord, Figure, FigureError, Graphic, Record, RecordError, Summary, figures,
    figures_of_curves,
};
use lissom_model::scene::{Scene, SceneError};
use serde_json::Value;

use super::checkpoint::{CHECKPOINT, Checkpoint};
use crate::exchange::export;
use crate::motion::{Motion, MotionError};

/// Name of the table in the folder.
pub(crate) const HISTORY: &str = "history.csv";
/// Name of the summary in the folder.
pub(crate) const SUMMARY: &str = "summary.json";
/// Name of the motion file in the folder.
pub(crate) const MOTION: &str = "motion.bin";
/// Name of the description of the scene.
pub(crate) const SCENE: &str = "scene.json";
/// Name of the page that shows the results.
const PAGE: &str = "view.html";
/// Names of the picture of the mechanism.
const PICTURES: [&str; 2] = ["snapshot.svg", "snapshot.png"];
/// Instants at which events happened.
pub(crate) const EVENTS: &str = "events.csv";
/// Names of the tables of natural modes.
pub(crate) const MODES: &str = "modes.csv";
pub(crate) const SHAPES: &str = "shapes.csv";
/// Name of the table of a Campbell diagram.
pub(crate) const CAMPBELL: &str = "campbell.csv";
/// Files of analyses of linear models.
const OF_LINEAR_MODELS: [&str; 25] = [
    "shapes.svg",
    "energy.csv",
    "participation.csv",
    "response.csv",
    "response.svg",
    "response.png",
    CAMPBELL,
    "campbell.svg",
    "campbell.png",
    "unknowns.csv",
    "states.csv",
    "M.mtx",
    "D.mtx",
    "K.mtx",
    "G.mtx",
    "inputs.mtx",
    "outputs-place.mtx",
    "outputs-rate.mtx",
    "outputs-acceleration.mtx",
    "outputs-multiplier.mtx",
    "outputs-input.mtx",
    "state-space-A.mtx",
    "state-space-B.mtx",
    "state-space-C.mtx",
    "state-space-D.mtx",
];
/// Name of the file with the telemetry of the steps' tangents.
const TELEMETRY: &str = "telemetry.json";
/// Name of the file that a run locks.
const LOCK: &str = ".lock";

/// Why results cannot be written or read.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.diagnostic())]
#[non_exhaustive]
pub enum FolderError {
    /// A file or folder cannot be written.
    File(#[from] FileError),
    /// The table of results is invalid.
    Record {
        /// The file.
        path: String,
        /// The error.
        error: RecordError,
    },
    /// The motion file is invalid.
    Motion {
        /// The file.
        path: String,
        /// The error.
        error: MotionError,
    },
    /// The scene is invalid.
    Scene {
        /// The file.
        path: String,
        /// The error.
        error: SceneError,
    },
    /// There are no results at the given path.
    NoResults {
        /// The folder or file.
        path: String,
        /// Actual content of the folder or file.
        is: &'static str,
    },
    /// There are only folders of results in the given one.
    Several {
        /// The folder.
        path: String,
        /// The first of the folders in it.
        first: String,
        /// Names of the folders in it.
        folders: String,
    },
    /// There is no motion to be shown.
    NoMotion {
        /// The folder.
        path: String,
        /// Actual content of the folder.
        holds: &'static str,
        /// The remedy.
        remedy: &'static str,
    },
    /// A plot cannot be drawn.
    Figure(#[from] FigureError),
}

/// Locks a folder.
fn lock(path: &Path) -> Result<File, FileError> {
    let file = path.join(LOCK);
    let refuse = |source| files::failure(files::Action::Write, &file, source);
    let lock = files::open_to_continue(&file)?;
    match lock.try_lock() {
        Err(TryLockError::WouldBlock) => Err(refuse(Error::new(
            ErrorKind::ResourceBusy,
            "another run is writing to this folder: wait for it, or choose another folder with `--out`",
        ))),
        // If files cannot be locked, runs are distinguished only by their folders.
        _ => Ok(lock),
    }
}

/// Whether two descriptions are of different folders, where the system numbers them.
fn is_other(one: &Metadata, other: &Metadata) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        (one.dev(), one.ino()) != (other.dev(), other.ino())
    }
    #[cfg(not(unix))]
    {
        one.is_dir() != other.is_dir()
    }
}

/// Protects the results in a folder that a command reads against being overwritten by it.
pub fn protect_results(folder: &Path) {
    for name in [HISTORY, SUMMARY, MOTION, SCENE, EVENTS, MODES, SHAPES, CAMPBELL] {
        files::protect(&folder.join(name));
    }
}

/// Whether a file has a name of results: a table, a summary, or a plot of any output.
fn is_result(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let ending = path.extension().unwrap_or_default();
    let fixed = [HISTORY, SUMMARY, TELEMETRY, MOTION, SCENE, PAGE, EVENTS, MODES, SHAPES, LOCK, CHECKPOINT];
    ending == "svg" || ending == "png" || fixed.contains(&&*name) || OF_LINEAR_MODELS.contains(&&*name)
}

/// Number of folders that a message names.
const MAX_NAMED: usize = 8;

/// The error that names the folders of results in a folder; none if there is no such folder.
fn results_below(path: &Path) -> Option<FolderError> {
    let has_results =
        |folder: &PathBuf| [HISTORY, MODES, CAMPBELL].iter().any(|name| folder.join(name).is_file());
    let mut folders: Vec<PathBuf> = files::entries(path).filter(has_results).collect();
    folders.sort();
    let first = folders.first()?.display().to_string();
    let name = |folder: &PathBuf| format!("`{}`", folder.file_name().unwrap_or_default().to_string_lossy());
    let mut names: Vec<String> = folders.iter().take(MAX_NAMED).map(name).collect();
    if folders.len() > MAX_NAMED {
        names.push(format!("and {} others", folders.len() - MAX_NAMED));
    }
    Some(FolderError::Several { path: path.display().to_string(), first, folders: names.join(", ") })
}

/// A folder of results.
#[derive(Debug)]
pub struct ResultFolder {
    path: PathBuf,
    /// Locked while a run writes into the folder; the system releases it when the program ends in any way.
    _lock: Option<File>,
    /// The folder that the run has begun to write to.
    begun: Option<Metadata>,
}

impl ResultFolder {
    /// The folder, created with its parents if it does not exist, for a run that will write into it. Earlier results
    /// remain until [`begin`](Self::begin).
    ///
    /// # Errors
    /// If it cannot be created, or another run is writing into it.
    pub fn create(path: &Path) -> Result<Self, FileError> {
        files::create_folder(path)?;
        // Before anything is written or removed.
        files::entries(path)
            .filter(|entry| is_result(entry))
            .try_for_each(|entry| files::check_target(&entry))?;
        let lock = lock(path)?;
        Ok(Self { path: path.to_owned(), _lock: Some(lock), begun: std::fs::metadata(path).ok() })
    }

    /// Whether there are earlier results.
    pub fn has_results(&self) -> bool {
        self.path.join(HISTORY).exists()
    }

    /// Removes earlier results, which would be wrong beside new ones.
    ///
    /// # Errors
    /// If a file cannot be removed.
    pub fn clear(&self) -> Result<(), FileError> {
        let mut stale = [HISTORY, SUMMARY, TELEMETRY, MOTION, SCENE, PAGE, EVENTS, MODES, SHAPES]
            .map(|name| self.path.join(name))
            .to_vec();
        stale.extend(PICTURES.map(|name| self.path.join(name)));
        stale.extend(OF_LINEAR_MODELS.map(|name| self.path.join(name)));
        if let Ok((_, record, title)) = Self::open(&self.path) {
            for figure in figures(&record, &title) {
                stale.extend(["svg", "png"].map(|kind| self.path.join(format!("{}.{kind}", figure.name))));
            }
        }
        stale.extend(self.asked_for());
        stale.iter().try_for_each(|file| files::remove(file))
    }

    /// Requested plots and exports of an earlier run.
    fn asked_for(&self) -> Vec<PathBuf> {
        let is_plot = |path: &PathBuf| {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let ending = path.extension().unwrap_or_default();
            name.starts_with("plot-") && (ending == "svg" || ending == "png") || files::is_unfinished(&name)
        };
        files::entries(&self.path).filter(is_plot).chain(export::files_in(&self.path)).collect()
    }

    /// Removes earlier results and returns a writer of the table, after a run has started successfully.
    ///
    /// # Errors
    /// If a file cannot be removed or created.
    pub fn begin(&self) -> Result<CsvWriter<BufWriter<File>>, FileError> {
        self.clear()?;
        self.history()
    }

    /// A folder of an earlier run: its table and its title. Units and quantities are those of the summary; if that is
    /// missing, for example after a crash, columns have none.
    ///
    /// # Errors
    /// If there is no table, or it is invalid.
    pub fn open(path: &Path) -> Result<(Self, Record, String), FolderError> {
        let history = path.join(HISTORY);
        if path.is_file() {
            return Err(FolderError::NoResults { path: path.display().to_string(), is: "is a file" });
        }
        if !history.exists()
            && let Some(several) = results_below(path)
        {
            return Err(several);
        }
        let text = files::read_text(&history)?;
        let mut record = Record::from_csv(&text)
            .map_err(|error| FolderError::Record { path: history.display().to_string(), error })?;
        let summary = files::read_text(&path.join(SUMMARY)).unwrap_or_default();
        let summary: Value = serde_json::from_str(&summary).unwrap_or_default();
        for column in &mut record.columns {
            let name = column.name();
            let known = summary["columns"].as_array().into_iter().flatten();
            if let Some(known) = known.into_iter().find(|known| known["name"] == name.as_str()) {
                let word = |fact: &str| known[fact].as_str().unwrap_or_default().to_owned();
                (column.quantity, column.unit) = (word("quantity"), word("unit"));
                if let Some(plot) = known["plot"].as_str() {
                    plot.clone_into(&mut column.plot);
                }
            }
        }
        let title = summary["title"].as_str().unwrap_or_default().to_owned();
        Ok((Self { path: path.to_owned(), _lock: None, begun: None }, record, title))
    }

    /// Path of the folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// A writer of its table, emptied.
    fn history(&self) -> Result<CsvWriter<BufWriter<File>>, FileError> {
        files::create_file(&self.path.join(HISTORY)).map(CsvWriter::new)
    }

    /// Path of its table.
    pub fn history_path(&self) -> PathBuf {
        self.path.join(HISTORY)
    }

    /// Path of its motion file.
    pub fn motion_path(&self) -> PathBuf {
        self.path.join(MOTION)
    }

    /// Motion file of the folder, emptied.
    ///
    /// # Errors
    /// If the file cannot be created.
    pub fn motion(&self) -> Result<File, FileError> {
        files::create(&self.motion_path())
    }

    /// Motion file of the folder, to be continued from `checkpoint`, and the time of its last frame [s].
    ///
    /// # Errors
    /// If it is missing, shorter than stated in the checkpoint, or not a motion file.
    pub fn resumed_motion(&self, checkpoint: &Checkpoint) -> Result<(File, Option<f64>), FolderError> {
        let path = self.motion_path();
        let mut file = checkpoint.open_motion(&path)?;
        let unreadable = |error| files::failure(files::Action::Read, &path, error);
        let bytes = files::read(&path).map_err(unreadable)?;
        let last = Motion::time_to_continue_from(&bytes)
            .map_err(|error| FolderError::Motion { path: path.display().to_string(), error })?;
        file.seek(SeekFrom::End(0)).map_err(unreadable)?;
        Ok((file, last))
    }

    /// Writes the scene.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write_scene(&self, scene: &Scene) -> Result<(), FileError> {
        files::write(&self.path.join(SCENE), scene.to_json().as_bytes())
    }

    /// The folder of a run that is resumed from a checkpoint, and the rows recorded before it.
    ///
    /// # Errors
    /// If the table is missing or shorter than stated in the checkpoint.
    pub fn resume(path: &Path, checkpoint: &Checkpoint) -> Result<(Self, Record), FolderError> {
        let history = path.join(HISTORY);
        checkpoint.open_history(&history)?;
        let lock = lock(path)?;
        let (folder, record, _) = Self::open(path)?;
        Ok((Self { _lock: Some(lock), begun: std::fs::metadata(path).ok(), ..folder }, record))
    }

    /// A writer that appends to its table.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn resumed_history(&self, checkpoint: &Checkpoint) -> Result<CsvWriter<BufWriter<File>>, FileError> {
        checkpoint.open_history(&self.history_path()).map(|file| CsvWriter::new(BufWriter::new(file)))
    }

    /// Writes another table of results under its name.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write_table(&self, name: &str, text: &str) -> Result<(), FileError> {
        files::write(&self.path.join(name), text.as_bytes())
    }

    /// Writes an archive of arrays under its name.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write_archive(&self, name: &str, bytes: &[u8]) -> Result<(), FileError> {
        files::write(&self.path.join(name), bytes)
    }

    /// Writes names and times [s] of events.
    ///
    /// # Errors
    /// If they cannot be written.
    pub fn write_events<'e>(&self, events: impl Iterator<Item = (&'e str, f64)>) -> Result<(), FileError> {
        let row = |(name, time): (&str, f64)| {
            let has_signs = name.contains([',', '"', '\n']);
            let name = if has_signs { format!("\"{}\"", name.replace('"', "\"\"")) } else { name.to_owned() };
            format!("{time},{name}\n")
        };
        let rows: String = events.map(row).collect();
        self.write_table(EVENTS, &format!("time,event\n{rows}"))
    }

    /// Whether another folder has replaced the one that the run has begun to write to.
    fn is_replaced(&self) -> bool {
        let present = std::fs::metadata(&self.path).ok();
        self.begun.as_ref().zip(present.as_ref()).is_some_and(|(begun, present)| is_other(begun, present))
    }

    /// Writes the summary.
    ///
    /// # Errors
    /// If it cannot be written, or the folder was replaced by another one, in which the other results are not.
    pub fn write_summary(&self, summary: &Summary) -> Result<(), FileError> {
        if self.is_replaced() {
            let reason = "another folder has replaced it during the run: the results are where the first one has been moved";
            return Err(files::failure(files::Action::Write, &self.path, Error::other(reason)));
        }
        files::write(&self.path.join(SUMMARY), summary.to_json().as_bytes())
    }

    /// Writes the telemetry of the steps' tangents.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write_telemetry(&self, telemetry: &Value) -> Result<(), FileError> {
        files::write(&self.path.join(TELEMETRY), format!("{telemetry}\n").as_bytes())
    }

    /// Writes a graphic to a folder, as SVG and as PNG, and returns the paths of both.
    ///
    /// # Errors
    /// If it cannot be drawn or written.
    pub fn write_graphic(folder: &Path, graphic: &Graphic) -> Result<[PathBuf; 2], FolderError> {
        let paths = ["svg", "png"].map(|kind| folder.join(format!("{}.{kind}", graphic.name())));
        files::write(&paths[0], graphic.svg()?.as_bytes())?;
        files::write(&paths[1], &graphic.png()?)?;
        Ok(paths)
    }

    /// Draws requested figures into a folder, as SVG and as PNG, and returns their paths.
    ///
    /// # Errors
    /// If the folder or a figure cannot be made.
    pub fn write_figures(folder: &Path, figures: &[Figure]) -> Result<Vec<PathBuf>, FolderError> {
        files::create_folder(folder)?;
        let mut written = Vec::new();
        for figure in figures {
            written.extend(Self::write_graphic(folder, &figure.draw()?)?);
        }
        Ok(written)
    }

    /// Draws the first `count` outputs of `record`, as SVG and as PNG. A failure of one plot does not prevent the others.
    ///
    /// # Errors
    /// The error of the first plot that could not be drawn or written.
    pub fn write_plots(&self, record: &CurveRecord, title: &str, count: usize) -> Result<(), FolderError> {
        let mut first = Ok(());
        for figure in figures_of_curves(record, title, count) {
            let drawn = figure.draw().map_err(FolderError::from);
            first = first.and(drawn.and_then(|drawn| Self::write_graphic(&self.path, &drawn)).map(drop));
        }
        first
    }
}
