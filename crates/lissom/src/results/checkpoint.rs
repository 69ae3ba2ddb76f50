//! Resumption of an interrupted run: the file `checkpoint.lissom` in its folder contains the model, the options and a
//! snapshot. It is replaced as a whole, so that there is one at any moment.

use lissom_core::diagnostics::Diagnose;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::time::{Duration, Instant};

use lissom_model::files::{self, FileError};
use serde::{Deserialize, Serialize};

use crate::encodings::sealed;
use crate::model_text::Override;
use crate::session::{Checkpoints, SessionSnapshot};

/// Name of the file.
pub(crate) const CHECKPOINT: &str = "checkpoint.lissom";

/// Interval of checkpoints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CheckpointEvery {
    /// Wall-clock time.
    Time(Duration),
    /// Number of steps.
    Steps(usize),
}

impl FromStr for CheckpointEvery {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || "it must be a time such as `10s` or a number of steps such as `1000steps`".to_owned();
        if let Some(number) = text.strip_suffix("steps") {
            let steps: usize = number.trim().parse().map_err(|_| wrong())?;
            return if steps > 0 { Ok(Self::Steps(steps)) } else { Err(wrong()) };
        }
        let number = text.strip_suffix('s').ok_or_else(wrong)?;
        let seconds: f64 = number.trim().parse().map_err(|_| wrong())?;
        let time = Duration::try_from_secs_f64(seconds).map_err(|_| wrong())?;
        if time.is_zero() { Err(wrong()) } else { Ok(Self::Time(time)) }
    }
}

/// Contents of the file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Path of the model file, as it was given.
    pub model: String,
    /// Text of the model file.
    pub text: String,
    /// The texts of included files, by path.
    pub included: std::collections::BTreeMap<String, String>,
    /// Overrides of the model.
    pub overrides: Vec<Override>,
    /// What was omitted from it.
    pub left_out: Vec<String>,
    /// Whether plots are requested.
    pub plots: bool,
    /// Interval of checkpoints, as it was given.
    pub every: String,
    /// Length of the table of the run so far [bytes].
    pub history_length: u64,
    /// Length of the motion file of the run so far [bytes]; zero if there is none.
    pub motion_length: u64,
    /// State of the run.
    pub session: SessionSnapshot,
}

/// Why the run of a folder cannot be resumed.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.diagnostic())]
#[non_exhaustive]
pub enum CheckpointError {
    /// There is no checkpoint.
    Missing(String),
    /// The file is not a checkpoint, or one of another version.
    Unreadable(String),
    /// A file cannot be read or written.
    File(#[from] FileError),
}

impl Checkpoint {
    /// The checkpoint of the run in `folder`.
    ///
    /// # Errors
    /// If there is none, or one of another program.
    pub fn read(folder: &Path) -> Result<Self, CheckpointError> {
        let path = folder.join(CHECKPOINT);
        let bytes = match files::read(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                return Err(CheckpointError::Missing(folder.display().to_string()));
            }
            Err(error) => return Err(files::failure(files::Action::Read, &path, error).into()),
            Ok(bytes) => bytes,
        };
        sealed::from_bytes(&bytes).ok_or_else(|| CheckpointError::Unreadable(path.display().to_string()))
    }

    /// The table of the run, truncated to its length at the checkpoint, for appending.
    ///
    /// # Errors
    /// If it is missing or cannot be written.
    pub fn open_history(&self, path: &Path) -> Result<File, FileError> {
        cut(path, self.history_length, "rows are missing that were written")
    }

    /// The motion file of the run, truncated to its length at the checkpoint, for appending.
    ///
    /// # Errors
    /// If it is missing or cannot be written.
    pub fn open_motion(&self, path: &Path) -> Result<File, FileError> {
        cut(path, self.motion_length, "frames are missing that were written")
    }
}

/// A file truncated to `length`, for appending.
fn cut(path: &Path, length: u64, missing: &str) -> Result<File, FileError> {
    files::open_cut(path, length, missing)
}

/// Writes checkpoints to the folder of a run.
pub struct CheckpointFile {
    folder: PathBuf,
    history: PathBuf,
    motion: Option<PathBuf>,
    every: CheckpointEvery,
    /// The common contents of all checkpoints of the run.
    frame: Box<dyn Fn(SessionSnapshot, [u64; 2]) -> Checkpoint>,
    last: Instant,
}

impl CheckpointFile {
    /// For a run whose results are in `folder`, whose table is `history` and whose motion, if it is recorded, is in
    /// `motion`; `frame` makes a checkpoint of a snapshot and the lengths of both files.
    pub fn new(
        folder: &Path,
        history: &Path,
        motion: Option<PathBuf>,
        every: CheckpointEvery,
        frame: impl Fn(SessionSnapshot, [u64; 2]) -> Checkpoint + 'static,
    ) -> Self {
        let (folder, history) = (folder.to_owned(), history.to_owned());
        Self { folder, history, motion, every, frame: Box::new(frame), last: Instant::now() }
    }

    /// Removes the checkpoint of an earlier run: it is complete.
    pub fn remove(folder: &Path) {
        // If there is none, nothing needs to be done.
        let _ = files::remove(&folder.join(CHECKPOINT));
    }
}

impl Checkpoints for CheckpointFile {
    fn are_wanted(&self) -> bool {
        true
    }

    fn is_due(&mut self, steps: usize) -> bool {
        match self.every {
            CheckpointEvery::Steps(every) => steps.is_multiple_of(every),
            CheckpointEvery::Time(every) => self.last.elapsed() >= every,
        }
    }

    fn keep(&mut self, snapshot: &SessionSnapshot) -> io::Result<()> {
        // Rows must be on the disk before a checkpoint refers to them.
        let synced = |path: &PathBuf| files::synchronized_length(path);
        let lengths = [synced(&self.history)?, self.motion.as_ref().map_or(Ok(0), synced)?];
        let checkpoint = (self.frame)(snapshot.clone(), lengths);
        let bytes = sealed::to_bytes(&checkpoint).map_err(io::Error::other)?;
        files::write_durably(&self.folder.join(CHECKPOINT), &bytes).map_err(|error| error.source)?;
        self.last = Instant::now();
        Ok(())
    }
}

#[cfg(test)]
#[path = "../../tests/unit/results/checkpoint.rs"]
mod tests;
