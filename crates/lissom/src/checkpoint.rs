//! A run that can go on after it was cut off: the file `checkpoint.lissom` in its folder holds the model, what was asked
//! for and a snapshot. It is replaced as a whole, so that there is one at any moment.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::time::{Duration, Instant};

use lissom_model::files::{self, FileError};
use serde::{Deserialize, Serialize};

use crate::model::Override;
use crate::sealed;
use crate::session::{Checkpoints, SessionSnapshot};

/// Name of the file.
pub(crate) const CHECKPOINT: &str = "checkpoint.lissom";

/// How often a run leaves a checkpoint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CheckpointEvery {
    /// After so much time on the clock.
    Time(Duration),
    /// After so many steps.
    Steps(usize),
}

impl FromStr for CheckpointEvery {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || "it must be a time as `10s` or a number of steps as `1000steps`".to_owned();
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

/// What the file holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Path of the model file, as it was given.
    pub model: String,
    /// Its text.
    pub text: String,
    /// The texts of the files it includes, by their paths.
    pub included: std::collections::BTreeMap<String, String>,
    /// What was changed in it.
    pub overrides: Vec<Override>,
    /// What was omitted from it.
    pub left_out: Vec<String>,
    /// Whether plots are wanted.
    pub plots: bool,
    /// How often checkpoints are left, as it was given.
    pub every: String,
    /// Bytes of the table that belong to the run so far.
    pub history_length: u64,
    /// Bytes of the motion file that belong to the run so far; zero where there is none.
    pub motion_length: u64,
    /// Where the run is.
    pub session: SessionSnapshot,
}

/// A folder whose run cannot go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// There is no checkpoint.
    #[error(
        "there is no checkpoint in `{0}`: the run has ended, or was started without `--checkpoint-every`; \
         run the model again"
    )]
    Missing(String),
    /// The file is none, or of another version.
    #[error("`{0}` is no checkpoint of this version of the program: run the model again")]
    Unreadable(String),
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
}

impl Checkpoint {
    /// The checkpoint that a run left in `folder`.
    ///
    /// # Errors
    /// If there is none, or another program's.
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

    /// The table the run left, cut to where the checkpoint was taken, to be written on.
    ///
    /// # Errors
    /// If it is missing or cannot be written.
    pub fn open_history(&self, path: &Path) -> Result<File, FileError> {
        cut(path, self.history_length, "rows are missing that were written")
    }

    /// The motion file the run left, cut to where the checkpoint was taken, to be written on.
    ///
    /// # Errors
    /// If it is missing or cannot be written.
    pub fn open_motion(&self, path: &Path) -> Result<File, FileError> {
        cut(path, self.motion_length, "frames are missing that were written")
    }
}

/// A file cut to `length`, to be written on.
fn cut(path: &Path, length: u64, missing: &str) -> Result<File, FileError> {
    files::open_cut(path, length, missing)
}

/// Leaves checkpoints in the folder of a run.
pub struct CheckpointFile {
    folder: PathBuf,
    history: PathBuf,
    motion: Option<PathBuf>,
    every: CheckpointEvery,
    /// What all checkpoints of the run have in common.
    frame: Box<dyn Fn(SessionSnapshot, [u64; 2]) -> Checkpoint>,
    last: Instant,
}

impl CheckpointFile {
    /// For a run whose results are in `folder`, whose table is `history` and whose motion, if it is recorded, is in
    /// `motion`; `frame` adds to a snapshot and to the lengths of both files what else a checkpoint holds.
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

    /// Removes what a former run has left: it is over.
    pub fn remove(folder: &Path) {
        // If there is none there is nothing to do.
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
        // Rows must be on the disk before a checkpoint counts on them.
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
mod tests {
    use super::*;

    #[test]
    fn times_and_steps_are_distinguished() {
        let read = |text: &str| text.parse::<CheckpointEvery>();
        assert_eq!(read("10s"), Ok(CheckpointEvery::Time(Duration::from_secs(10))));
        assert_eq!(read("1000steps"), Ok(CheckpointEvery::Steps(1000)));
        for wrong in ["", "10", "0s", "-1s", "0steps", "s", "steps", "1e99s"] {
            assert!(read(wrong).is_err(), "{wrong}");
        }
    }
}
